//! Data as a function: what a volume or a mesh must answer to be a leaf of an expression.

use std::fmt;

use super::interval::Interval;

/// A function of a few arguments that is given by data. Immutable and shared between threads.
pub trait Leaf: fmt::Debug + Send + Sync {
    /// A hash of the content: equal leaves have equal fingerprints.
    fn fingerprint(&self) -> u128;
    /// What messages call it: the file's name.
    fn name(&self) -> &str;
    /// Number of arguments, at most 4.
    fn arity(&self) -> usize;
    /// The value at a point; `at.len()` is the arity. NaN in, NaN out.
    fn value(&self, at: &[f64]) -> f64;
    /// The values at many points, to the bit as [`Leaf::value`] gives them; `at` has a slice for each argument, as long as `out`.
    fn values(&self, at: &[&[f64]], out: &mut [f64]) {
        let mut point = [0.0; 4];
        for (i, out) in out.iter_mut().enumerate() {
            point.iter_mut().zip(at).for_each(|(to, from)| *to = from[i]);
            *out = self.value(&point[..at.len()]);
        }
    }
    /// The value and its derivative by each argument (into `slope`).
    fn gradient(&self, at: &[f64], slope: &mut [f64]) -> f64;
    /// Bounds of all values over a box, the rounding of `value` included.
    fn bounds(&self, over: &[Interval]) -> Interval;
    /// Bounds of the derivative by one argument over a box, its rounding included; anything unless the leaf knows better.
    fn slope_bounds(&self, _axis: usize, _over: &[Interval]) -> Interval {
        Interval { undefined: true, ..Interval::WHOLE }
    }
    /// About how many operations a value takes.
    fn work(&self) -> usize {
        8
    }
    /// Whether `value` of t times a point is t times the value there, for t > 0, and never negative: \[A96\] definition 1.
    fn is_ray_linear(&self) -> bool {
        false
    }
    /// The star solid of half-spaces that it is, if it is one.
    fn star(&self) -> Option<&super::star::StarSolid> {
        None
    }
}
