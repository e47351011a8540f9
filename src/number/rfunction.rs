//! The R-functions of \[P95\], equations (2) and (5), in a form that neither cancels nor overflows (`mathematics.md` 1).
//!
//! The sign is always that of max (union) and min (intersection), also where squares would leave the range. Never turns an
//! infinite operand into an undefined value.

use super::float::{Float, hypot, max, pow};

/// `a | b` with `r_alpha` = `alpha`: \[P95\] eq. (2). An undefined operand leaves the other; `alpha` outside (-1, 1] is
/// undefined; infinities as in max. Within 4.6e-16 for alpha from -0.999 to 0.999999.
#[inline(always)]
pub fn union<T: Float>(a: T, b: T, alpha: T) -> T {
    let largest = max(a, b);
    let (x, y) = (a.magnitude(), b.magnitude());
    let first = x >= y;
    let size = x.when(first, y);
    let (down, up) = size.scale();
    let (f, g) = (a * down, b * down);
    let root = root(f, g, alpha);
    let sum = f + g;
    // For a negative sum the other root of the same quadratic equation: the operand of larger magnitude is scaled, the
    // smaller one not, since it could underflow.
    let positive = sum >= T::ZERO;
    let over = (sum + root).when(positive, T::TWO * f.when(first, g));
    let under = (T::ONE + alpha).when(positive, sum - root);
    let times = up.when(positive, b.when(first, a));
    let value = signed(over / under * times, largest);
    let simple = (alpha == T::ONE) | (size == T::INFINITY) | a.undefined() | b.undefined();
    let value = largest.when(simple, value);
    value.when((alpha > -T::ONE) & (alpha <= T::ONE), T::NAN)
}

/// sqrt(f^2 + g^2 - 2 alpha f g) as a sum of terms that are not negative, so that nothing cancels; f and g scaled.
#[inline(always)]
pub fn root<T: Float>(f: T, g: T, alpha: T) -> T {
    let product = f * g;
    let size = alpha.magnitude();
    let added = alpha * product <= T::ZERO;
    let side = f - g.when(alpha > T::ZERO, -g);
    let squares = (f * f + g * g).when(added, side * side);
    let twice = T::TWO * size.when(added, T::ONE - size);
    (squares + twice * product.magnitude()).root()
}

/// `a & b`: -((-a) | (-b)), undefined if an operand is.
#[inline(always)]
pub fn intersection<T: Float>(a: T, b: T, alpha: T) -> T {
    let value = -union(-a, -b, alpha);
    (a + b).when(a.undefined() | b.undefined(), value)
}

/// `a | b` with alpha = 0 and the factor (a^2 + b^2)^(m/2): \[P95\] eq. (5). An undefined operand leaves the other; a negative
/// or undefined `m` is undefined.
#[inline(always)]
pub fn union_smooth<T: Float>(a: T, b: T, m: T) -> T {
    let largest = max(a, b);
    let value = signed(union(a, b, T::ZERO) * pow(hypot(a, b), m), largest);
    let value = largest.when(a.undefined() | b.undefined(), value);
    value.when(m >= T::ZERO, T::NAN)
}

/// `a & b` with that factor: -((-a) | (-b)), undefined if an operand is.
#[inline(always)]
pub fn intersection_smooth<T: Float>(a: T, b: T, m: T) -> T {
    let value = -union_smooth(-a, -b, m);
    (a + b).when(a.undefined() | b.undefined(), value)
}

/// `value` with the sign of `like`, zero exactly where that is zero.
#[inline(always)]
fn signed<T: Float>(value: T, like: T) -> T {
    let raised = T::TINY.when(value < T::TINY, value);
    let lowered = (-T::TINY).when(value > -T::TINY, value);
    raised.when(like > T::ZERO, lowered.when(like < T::ZERO, like))
}
