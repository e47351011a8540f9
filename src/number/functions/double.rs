//! Sums and products with what their rounding lost. Never uses a fused multiplication: halves of 26 bits multiply exactly.

/// a + b and its error; |a| >= |b| or a = 0.
#[inline(always)]
pub(super) fn quick_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// The upper half of the digits, and the rest; |a| below 1e300.
#[inline(always)]
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a;
    let high = c - (c - a);
    (high, a - high)
}

/// a b and its error.
#[inline(always)]
pub(super) fn product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((a, c), (b, d)) = (split(a), split(b));
    (p, ((a * b - p) + a * d + c * b) + c * d)
}

/// 1.5 * 2^52: adding it rounds to a whole number, which then stands in the lowest bits.
pub(super) const WHOLE: f64 = 6_755_399_441_055_744.0;

/// The nearest whole number of a number below 2^51 in magnitude, and the same in two's complement.
#[inline(always)]
pub(super) fn nearest(x: f64) -> (f64, u64) {
    let shifted = x + WHOLE;
    (shifted - WHOLE, shifted.to_bits().wrapping_sub(WHOLE.to_bits()))
}

/// `y 2^k` for y near 1 and |k| < 2048, in two steps, so that it is rounded once also among the subnormal numbers.
#[inline(always)]
pub(super) fn scaled(y: f64, k: u64) -> f64 {
    let half = (k.wrapping_add(2048) >> 1).wrapping_sub(1024);
    let rest = k.wrapping_sub(half);
    y * power_of_two(half) * power_of_two(rest)
}

/// `2^k` for |k| <= 1022.
#[inline(always)]
pub(super) fn power_of_two(k: u64) -> f64 {
    f64::from_bits(k.wrapping_add(1023) << 52)
}
