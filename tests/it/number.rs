//! Intervals, duals and elementary functions.

mod duals;
mod functions;
mod intervals;
mod rfunctions;

use std::sync::LazyLock;

use yont::number::Unary;

/// Every primitive of one operand, with some of the whole powers.
pub(crate) static UNARY: LazyLock<Vec<Unary>> = LazyLock::new(|| {
    let powers = [-3, -2, -1, 0, 1, 2, 3, 7, 10].map(Unary::Powi);
    Unary::ALL.iter().copied().chain(powers).collect()
});

/// A small random sequence (splitmix64), the same every time.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to below 1.
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// True once in `n` times.
    fn once_in(&mut self, n: u64) -> bool {
        self.bits().is_multiple_of(n)
    }

    fn one_of<T: Copy>(&mut self, from: &[T]) -> T {
        from[(self.bits() % from.len() as u64) as usize]
    }

    /// Small whole numbers, moderate, widely scaled and special numbers; never undefined.
    fn any(&mut self) -> f64 {
        match self.bits() % 16 {
            0..=2 => self.one_of(&[0.0, -0.0, 1.0, -1.0, 2.0, 0.5, -0.5, 3.0, -2.0]),
            3 => self.one_of(&[f64::INFINITY, f64::NEG_INFINITY, 5e-324, -5e-324, f64::MAX, f64::MIN, 1e308, -1e-310]),
            4 | 5 => self.within(-1.0, 1.0) * 2f64.powi((self.bits() % 2000) as i32 - 1000),
            6 | 7 => self.within(-1.0, 1.0) * 2f64.powi((self.bits() % 60) as i32 - 30),
            8 => self.within(-6.0, 6.0).round() * std::f64::consts::FRAC_PI_2,
            9..=11 => self.within(-1.2, 1.2),
            _ => self.within(-10.0, 10.0),
        }
    }
}
