//! Star solids of half-spaces as data: the control shape of \[A96\] eq. (3), a union of convex polyhedra with their blending parameters.
//! Powers are taken of quotients only, so that no parameter overflows. Never looks at a polyhedron that is not there.

use super::functions::{log, pow};
use super::interval::Interval;
use super::leaf::Leaf;

/// The largest number of coordinates of a half-space, that of a [`Leaf`]'s arguments.
pub const AXES: usize = 4;

/// A point, a direction or the coefficients of a half-space; what is beyond the solid's dimension is 0.
pub type Row = [f64; AXES];

/// A blending parameter p > 0, perhaps infinite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent {
    p: f64,
    /// p where it is a small whole number, else 0: then powers are products.
    whole: u32,
}

impl Exponent {
    /// The parameter; nothing unless p > 0.
    #[must_use]
    pub fn new(p: f64) -> Option<Self> {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let whole = if p.fract() == 0.0 && p <= 64.0 { p as u32 } else { 0 };
        (p > 0.0).then_some(Self { p, whole })
    }

    /// p itself.
    #[must_use]
    pub fn get(self) -> f64 {
        self.p
    }

    /// Whether only the largest counts.
    #[inline(always)]
    #[must_use]
    pub fn is_infinite(self) -> bool {
        self.p == f64::INFINITY
    }

    /// r^p for r from 0 to 1, within p + 1 units in the last place.
    #[inline(always)]
    #[must_use]
    pub fn power(self, r: f64) -> f64 {
        if self.whole == 0 {
            return if self.is_infinite() { f64::from(u8::from(r == 1.0)) } else { pow(r, self.p) };
        }
        let (mut result, mut square, mut rest) = (1.0, r, self.whole);
        loop {
            if rest & 1 == 1 {
                result *= square;
            }
            rest >>= 1;
            if rest == 0 {
                return result;
            }
            square *= square;
        }
    }

    /// s^(1/p)
    #[inline(always)]
    #[must_use]
    pub fn root(self, s: f64) -> f64 {
        match self.whole {
            1 => s,
            2 => s.sqrt(),
            4 => s.sqrt().sqrt(),
            _ => pow(s, 1.0 / self.p),
        }
    }
}

/// A p-norm of non-negative numbers in the making: its largest term and the sum of powers relative to it.
#[derive(Clone, Copy, Debug)]
pub struct Norm {
    ruler: f64,
    sum: f64,
}

impl Norm {
    /// That of nothing, 0.
    pub const ZERO: Self = Self { ruler: 0.0, sum: 1.0 };

    /// One more term, not negative; an infinite one makes the norm infinite.
    #[inline(always)]
    pub fn add(&mut self, term: f64, p: Exponent) {
        if term > self.ruler {
            self.sum = if self.ruler == 0.0 { 1.0 } else { self.sum * p.power(self.ruler / term) + 1.0 };
            self.ruler = term;
        } else if (term > 0.0) & (self.ruler < f64::INFINITY) {
            self.sum += p.power(term / self.ruler);
        }
    }

    /// The norm.
    #[inline(always)]
    #[must_use]
    pub fn value(self, p: Exponent) -> f64 {
        if p.is_infinite() | (self.sum == 1.0) { self.ruler } else { self.ruler * p.root(self.sum) }
    }
}

/// An intersection of half-spaces about the origin: `F = (sum H(L)^p)^(1/p)`, inside where `F <= 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyhedron {
    /// The half-spaces `a . x <= 1`.
    pub rows: Vec<Row>,
    /// The local blending parameter.
    pub p: Exponent,
}

/// The linear function of a half-space, `a . x`.
#[inline(always)]
#[must_use]
pub fn linear(row: &Row, at: &Row) -> f64 {
    (row[0] * at[0] + row[1] * at[1]) + (row[2] * at[2] + row[3] * at[3])
}

impl Polyhedron {
    /// F at a point: ray-linear and not negative.
    #[inline]
    #[must_use]
    pub fn value(&self, at: &Row) -> f64 {
        let mut norm = Norm::ZERO;
        for row in &self.rows {
            norm.add(linear(row, at), self.p);
        }
        norm.value(self.p)
    }

    /// How far the boundary is in the direction of `at`, in lengths of it: 1/F, infinite where nothing ends it.
    #[inline]
    #[must_use]
    pub fn reach(&self, at: &Row) -> f64 {
        1.0 / self.value(at)
    }

    /// F, and its gradient into `slope`.
    fn gradient(&self, at: &Row, slope: &mut Row) -> f64 {
        let value = self.value(at);
        *slope = [0.0; AXES];
        if value == 0.0 {
            return 0.0;
        }
        let mut open = true;
        for row in &self.rows {
            let l = linear(row, at);
            let by = if self.p.is_infinite() {
                // The first of several largest ones.
                let wins = open & (l == value);
                open &= !wins;
                f64::from(u8::from(wins))
            } else if l > 0.0 {
                pow(l / value, self.p.p - 1.0)
            } else {
                0.0
            };
            for (out, a) in slope.iter_mut().zip(row) {
                *out += if by == 0.0 { 0.0 } else { by * a };
            }
        }
        value
    }
}

/// A union of convex polyhedra about the origin, smoothly blended: \[A96\] eq. (3). As a [`Leaf`] it is the ray-linear function F of
/// `arity` coordinates; the solid is `1 - F`.
#[derive(Clone, Debug, PartialEq)]
pub struct StarSolid {
    /// The number of coordinates, 1 to [`AXES`].
    pub arity: usize,
    /// The polyhedra.
    pub parts: Vec<Polyhedron>,
    /// The global blending parameter.
    pub p: Exponent,
}

impl StarSolid {
    /// How many half-spaces there are in all.
    #[must_use]
    pub fn half_spaces(&self) -> usize {
        self.parts.iter().map(|part| part.rows.len()).sum()
    }

    /// How far the boundary is in the direction of `at`, in lengths of it: the p-norm of the parts' reaches.
    #[must_use]
    pub fn reach(&self, at: &Row) -> f64 {
        let mut norm = Norm::ZERO;
        for part in &self.parts {
            norm.add(part.reach(at), self.p);
        }
        norm.value(self.p)
    }
}

/// The point with zeros behind; nothing where it is not finite.
fn filled(at: &[f64]) -> Option<Row> {
    let mut all = [0.0; AXES];
    all[..at.len()].copy_from_slice(at);
    all.iter().all(|x| x.is_finite()).then_some(all)
}

impl Leaf for StarSolid {
    fn fingerprint(&self) -> u128 {
        let mut hash: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
        let mut take =
            |bits: u64| hash = (hash ^ u128::from(bits)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b);
        take(self.arity as u64);
        take(self.p.p.to_bits());
        for part in &self.parts {
            take(part.p.p.to_bits());
            take(part.rows.len() as u64);
            part.rows.iter().flatten().for_each(|a| take(a.to_bits()));
        }
        hash ^ (hash >> 67)
    }

    fn name(&self) -> &str {
        "STAR"
    }

    fn arity(&self) -> usize {
        self.arity
    }

    fn value(&self, at: &[f64]) -> f64 {
        filled(at).map_or(f64::NAN, |at| 1.0 / self.reach(&at))
    }

    fn gradient(&self, at: &[f64], slope: &mut [f64]) -> f64 {
        slope.fill(0.0);
        let Some(at) = filled(at) else {
            slope.fill(f64::NAN);
            return f64::NAN;
        };
        let reach = self.reach(&at);
        let value = 1.0 / reach;
        if value == 0.0 {
            return value;
        }
        let mut open = true;
        for part in &self.parts {
            let mut own = [0.0; AXES];
            let f = part.gradient(&at, &mut own);
            // d F / d F_i = (F/F_i)^(p+1)
            let by = if self.p.is_infinite() {
                let wins = open & (1.0 / f == reach);
                open &= !wins;
                f64::from(u8::from(wins))
            } else {
                pow(value / f, self.p.p + 1.0)
            };
            for (out, a) in slope.iter_mut().zip(own) {
                *out += if by == 0.0 { 0.0 } else { by * a };
            }
        }
        value
    }

    fn bounds(&self, over: &[Interval]) -> Interval {
        if over.iter().any(|x| x.is_empty()) {
            return Interval::EMPTY;
        }
        let undefined = over.iter().any(|x| x.undefined || x.lo.is_infinite() || x.hi.is_infinite());
        if undefined {
            return Interval { lo: 0.0, hi: f64::INFINITY, undefined };
        }
        // F rises with each linear function, so the least and the largest of these give its bounds.
        let (mut least, mut most) = (Norm::ZERO, Norm::ZERO);
        for part in &self.parts {
            let (mut lo, mut hi) = (Norm::ZERO, Norm::ZERO);
            for row in &part.rows {
                let (a, b) = spread(row, over);
                lo.add(a, part.p);
                hi.add(b, part.p);
            }
            most.add(1.0 / lo.value(part.p), self.p);
            least.add(1.0 / hi.value(part.p), self.p);
        }
        let smallest = self.parts.iter().map(|part| part.p.p).fold(self.p.p, f64::min);
        #[allow(clippy::cast_precision_loss)]
        let room = (16.0 + (8.0 + self.half_spaces() as f64) / smallest.min(1.0)) * f64::EPSILON;
        let (lo, hi) = (1.0 / most.value(self.p), 1.0 / least.value(self.p));
        Interval::new(lo * (1.0 - room).max(0.0), hi * (1.0 + room) + f64::from_bits(1))
    }

    fn is_ray_linear(&self) -> bool {
        true
    }

    fn star(&self) -> Option<&StarSolid> {
        Some(self)
    }
}

/// The least and the largest value of a linear function over a box, with room for rounding.
fn spread(row: &Row, over: &[Interval]) -> (f64, f64) {
    let (mut lo, mut hi, mut size) = (0.0, 0.0, 0.0);
    for (a, x) in row.iter().zip(over) {
        let (p, q) = (a * x.lo, a * x.hi);
        lo += p.min(q);
        hi += p.max(q);
        size += p.abs().max(q.abs());
    }
    let room = size * 8.0 * f64::EPSILON;
    (lo - room, hi + room)
}

/// A bound of the relative error of a sum of powers whose terms are quotients of norms, in units of the machine's: what one
/// update adds (`log` of a quotient counts once for each unit of p).
#[must_use]
pub fn sum_error(p: Exponent) -> f64 {
    let size = if p.is_infinite() { 0.0 } else { p.p };
    (4.0 + 3.0 * size) * f64::EPSILON + if size > 0.0 { log(1.0 + 1.0 / size) * f64::EPSILON } else { 0.0 }
}
