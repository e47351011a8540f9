//! Exponential, logarithms and general powers, without branches.

use super::double::{nearest, power_of_two, product, quick_sum, scaled};

/// ln 2 in two parts, the first of 32 bits.
const LN2: (f64, f64) = (6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10);

/// `x + extra = k ln 2 + r + lost`, |r| <= 0.35: r, lost and k.
#[inline(always)]
pub(super) fn reduced(x: f64, extra: f64) -> (f64, f64, u64) {
    let (n, k) = nearest(x * std::f64::consts::LOG2_E);
    let high = x - n * LN2.0;
    let low = n * LN2.1 - extra;
    let r = high - low;
    (r, (high - r) - low, k)
}

/// `e^r - 1 - r` for |r| <= 0.35.
#[inline(always)]
pub(super) fn beyond_linear(r: f64) -> f64 {
    let t = r * r;
    let p = -1.653_390_220_546_525_2e-6 + t * 4.138_136_797_057_238_5e-8;
    let p = 1.666_666_666_666_660_2e-1 + t * (-2.777_777_777_701_559_3e-3 + t * (6.613_756_321_437_934e-5 + t * p));
    let c = r - t * p;
    r * c / (2.0 - c)
}

/// `e^(x + extra) 2^shift`, the sum rounded almost once. `x` within [-750, 750].
#[inline(always)]
pub(super) fn exp_of(x: f64, extra: f64, shift: u64) -> f64 {
    let (r, lost, k) = reduced(x, extra);
    let (sum, rest) = quick_sum(1.0, r);
    scaled(sum + (rest + (beyond_linear(r) + lost)), k.wrapping_add(shift))
}

/// A number kept within the range where `e^x` is neither 0 nor infinite, with room.
#[inline(always)]
pub(super) fn kept(x: f64) -> f64 {
    let x = if x > 720.0 { 720.0 } else { x };
    if x < -750.0 { -750.0 } else { x }
}

/// e^x, within 1 unit in the last place; exp(0) = 1.
#[inline(always)]
#[must_use]
pub fn exp(x: f64) -> f64 {
    exp_of(kept(x), 0.0, 0)
}

/// The bits of sqrt(1/2): mantissas are taken from there to sqrt 2.
const LEAST: u64 = 0x3fe6_a09e_667f_3bcd;

/// `x = 2^k (1 + f)`, 1 + f from sqrt(1/2) to sqrt 2, for x > 0, subnormal ones too: f and k.
#[inline(always)]
fn decomposed(x: f64) -> (f64, f64) {
    let small = x < f64::MIN_POSITIVE;
    let (f, k) = split_normal(if small { x * power_of_two(54) } else { x });
    (f, k - if small { 54.0 } else { 0.0 })
}

/// The same for numbers that are not subnormal.
#[inline(always)]
pub(super) fn split_normal(x: f64) -> (f64, f64) {
    let shifted = x.to_bits().wrapping_add(0x3ff0_0000_0000_0000 - LEAST);
    let mantissa = (shifted & 0x000f_ffff_ffff_ffff).wrapping_add(LEAST);
    // The exponent's bits below those of 2^52 make it a double without a conversion.
    let k = f64::from_bits((shifted >> 52) | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 1023.0);
    (f64::from_bits(mantissa) - 1.0, k)
}

/// The parts of log(1 + f): s = f/(2 + f), f^2/2 and the rest of the series.
#[inline(always)]
fn series(f: f64) -> (f64, f64, f64) {
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w * (3.999_999_999_940_942e-1 + w * (2.222_219_843_214_978_4e-1 + w * 1.531_383_769_920_937_3e-1));
    let odd = 1.818_357_216_161_805e-1 + w * 1.479_819_860_511_658_6e-1;
    let odd = z * (6.666_666_666_666_735e-1 + w * (2.857_142_874_366_239e-1 + w * odd));
    (s, 0.5 * f * f, odd + even)
}

/// The logarithm `value` of x, put right at 0, infinity and where x has none.
#[inline(always)]
pub(super) fn at_the_ends(x: f64, value: f64) -> f64 {
    let value = if x > 0.0 { value } else { f64::NAN };
    let value = if x == 0.0 { f64::NEG_INFINITY } else { value };
    if x == f64::INFINITY { x } else { value }
}

/// The natural logarithm, within 1 unit in the last place; log(1) = 0.
#[inline(always)]
#[must_use]
pub fn log(x: f64) -> f64 {
    let (f, k) = decomposed(x);
    let (s, half, rest) = series(f);
    at_the_ends(x, s * (half + rest) + k * LN2.1 - half + f + k * LN2.0)
}

/// The logarithm to base 10, within 1 unit in the last place; exact for powers of 10.
#[inline(always)]
#[must_use]
pub fn log10(x: f64) -> f64 {
    const OVER_LN10: (f64, f64) = (4.342_944_818_781_689e-1, 2.508_294_671_164_527_5e-11);
    const LOG10_2: (f64, f64) = (3.010_299_956_636_117_7e-1, 3.694_239_077_158_931e-13);
    let (f, k) = decomposed(x);
    let (s, half, rest) = series(f);
    let high = f64::from_bits((f - half).to_bits() & 0xffff_ffff_0000_0000);
    let low = f - high - half + s * (half + rest);
    let most = high * OVER_LN10.0;
    let whole = k * LOG10_2.0;
    let least = k * LOG10_2.1 + (low + high) * OVER_LN10.1 + low * OVER_LN10.0;
    let sum = whole + most;
    at_the_ends(x, (least + ((whole - sum) + most)) + sum)
}

/// log(x) for a finite x > 0 as a sum of two numbers, relative error below 2^-65.
#[inline(always)]
fn log_double(x: f64) -> (f64, f64) {
    let (f, k) = decomposed(x);
    // s = f/(2 + f), then log(1 + f) = s (2 + z (2/3 + z tail)) with z = s^2.
    let (under, under_low) = quick_sum(2.0, f);
    let s = f / under;
    let (p, p_low) = product(s, under);
    let s_low = (((f - p) - p_low) - s * under_low) / under;
    let (z, z_low) = product(s, s);
    let z_low = z_low + 2.0 * s * s_low;
    let tail = 2.0 / 19.0 + z * (2.0 / 21.0 + z * (2.0 / 23.0 + z * (2.0 / 25.0)));
    let tail = 2.0 / 13.0 + z * (2.0 / 15.0 + z * (2.0 / 17.0 + z * tail));
    let tail = 2.0 / 5.0 + z * (2.0 / 7.0 + z * (2.0 / 9.0 + z * (2.0 / 11.0 + z * tail)));
    const THIRDS: (f64, f64) = (2.0 / 3.0, 3.700_743_415_417_188e-17);
    let (c, c_low) = quick_sum(THIRDS.0, z * tail);
    let c_low = c_low + THIRDS.1;
    let (w, w_low) = product(c, z);
    let w_low = w_low + (c * z_low + c_low * z);
    let (t, t_low) = quick_sum(2.0, w);
    let t_low = t_low + w_low;
    let (l, l_low) = product(s, t);
    let l_low = l_low + (s * t_low + s_low * t);
    let (sum, lost) = quick_sum(k * LN2.0, l);
    quick_sum(sum, lost + (l_low + k * LN2.1))
}

/// x to the power y as IEEE has it, but undefined if an operand is; within 1 unit in the last place.
#[inline(always)]
#[must_use]
pub fn pow(x: f64, y: f64) -> f64 {
    let size = x.abs();
    let (l, l_low) = log_double(size);
    // Beyond 2^65 every exponent gives 0, 1 or infinity, and the product is still finite.
    let bounded = if y > 4e19 { 4e19 } else { y };
    let bounded = if bounded < -4e19 { -4e19 } else { bounded };
    let (p, p_low) = product(bounded, l);
    let in_range = p.abs() < 720.0 + 30.0;
    let value = exp_of(kept(p), if in_range { p_low + bounded * l_low } else { 0.0 }, 0);
    // 0 and infinity have no logarithm here.
    let extreme = if (size == 0.0) == (y < 0.0) { f64::INFINITY } else { 0.0 };
    let value = if (size == 0.0) | (size == f64::INFINITY) { extreme } else { value };
    let value = if y == 0.0 { 1.0 } else { value };
    let whole = y == y.floor();
    let half = 0.5 * y;
    let odd = whole & (half != half.floor());
    let value = if (x < 0.0) & !whole & (size != f64::INFINITY) { f64::NAN } else { value };
    let value = if odd & x.is_sign_negative() { -value } else { value };
    if x.is_nan() | y.is_nan() { f64::NAN } else { value }
}
