//! Intervals rounded outward, with "may be undefined".

/// All values of an expression over a box: those in `lo..=hi`, and perhaps undefined ones.
///
/// `lo > hi` (namely `+inf > -inf`) holds no defined value: undefined everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower bound, never NaN.
    pub lo: f64,
    /// Upper bound, never NaN.
    pub hi: f64,
    /// Whether the value may be undefined (NaN) somewhere in the box.
    pub undefined: bool,
}

impl Interval {
    /// `lo..=hi`, defined everywhere.
    #[must_use]
    pub fn new(lo: f64, hi: f64) -> Self {
        Self { lo, hi, undefined: false }
    }
}
