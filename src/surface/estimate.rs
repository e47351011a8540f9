//! Measured numbers with estimates of their errors, from three resolutions. Evaluates nothing.

/// A measured number and an estimate of its distance from the object's own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// An estimate, made from values at several resolutions, above which the error is in few cases; where the documentation of a measure
    /// says so, a bound.
    pub error: f64,
}

impl Estimate {
    /// From values at a resolution, at half of it and at a quarter, the last two if there are any; `floor` is what rounding does.
    ///
    /// Errors of smooth objects fall with the square of the cell. Where an object is smooth and the three values show that, the limit that
    /// they point to is the value (Richardson), and what the extrapolation of the two coarser ones would have missed is the error. Elsewhere the finest
    /// value stands, and its error is taken for somewhat more than the difference to the next, which for such an order of convergence is
    /// three times the error (Roache's grid convergence index).
    #[must_use]
    pub fn from([fine, half, quarter]: [Option<f64>; 3], is_smooth: bool, floor: f64) -> Self {
        let fine = fine.unwrap_or_default();
        let Some(half) = half else { return Self { value: fine, error: fine.abs().max(floor) } };
        let first = fine - half;
        let Some(quarter) = quarter else { return Self { value: fine, error: 1.5 * first.abs() + floor } };
        let second = half - quarter;
        let ratio = second / first;
        if is_smooth && (3.2..=5.0).contains(&ratio) {
            let (limit, coarse) = (fine + first / 3.0, half + second / 3.0);
            let error = (limit - coarse).abs().max(first.abs() / 16.0);
            return Self { value: limit, error: error + floor };
        }
        Self { value: fine, error: 1.5 * first.abs().max(second.abs() / 3.0) + floor }
    }

    /// The same with an error of at least that.
    #[must_use]
    pub fn at_least(self, error: f64) -> Self {
        Self { error: self.error.max(error), ..self }
    }

    /// The middle of a range, with half of its length: a bound.
    #[must_use]
    pub fn between(lo: f64, hi: f64) -> Self {
        Self { value: 0.5 * lo + 0.5 * hi, error: 0.5 * (hi - lo).abs() }
    }

    /// Whether a number is as near as the error says.
    #[must_use]
    pub fn holds(&self, exact: f64) -> bool {
        (self.value - exact).abs() <= self.error
    }
}

/// A curvature over a boundary, with errors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bend {
    /// Its integral over the smooth parts.
    pub integral: Estimate,
    /// Its average over them.
    pub average: Estimate,
    /// The least.
    pub least: Estimate,
    /// The largest.
    pub largest: Estimate,
}

impl Bend {
    /// From the sums at three resolutions.
    #[must_use]
    pub fn from(sums: [Option<super::curvature::Sum>; 3], is_smooth: bool) -> Option<Self> {
        use super::curvature::Sum;
        let [fine, half, quarter] = sums;
        let fine = fine?;
        let of = |part: fn(&Sum) -> f64| {
            let floor = 1e-9 * part(&fine).abs().max(fine.largest.abs().max(fine.least.abs()) * 1e-3);
            Estimate::from([Some(&fine), half.as_ref(), quarter.as_ref()].map(|sum| sum.map(part)), is_smooth, floor)
        };
        let (least, largest) = (of(|s| s.least), of(|s| s.largest));
        Some(Self { integral: of(|s| s.integral), average: of(|s| s.average), least, largest })
    }
}
