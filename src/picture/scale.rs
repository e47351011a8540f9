//! How the values of a plot become the colours of bands. Evaluates nothing.

use super::palette::{Palette, linear};

/// Bands of equal width that cover all values but the outermost hundredth on each side, which poles make huge.
pub(super) struct Scale {
    first: f64,
    step: f64,
    count: f64,
}

impl Scale {
    pub(super) fn new(values: &[f64]) -> Self {
        let mut finite: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        finite.sort_by(f64::total_cmp);
        let Some(last) = finite.len().checked_sub(1) else { return Self { first: 0.0, step: 1.0, count: 1.0 } };
        let (lo, hi) = (finite[last / 100], finite[last - last / 100]);
        let rough = ((hi - lo) / 12.0).max(f64::MIN_POSITIVE);
        let power = libm::pow(10.0, libm::log10(rough).floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|&s| s >= rough).unwrap_or(rough);
        let first = (lo / step).floor();
        Self { first, step, count: ((hi / step).floor() - first + 1.0).max(1.0) }
    }

    pub(super) fn light(&self, value: f64, palette: Palette) -> [f32; 3] {
        let band = (value / self.step).floor() - self.first;
        let colour = palette.colour((band + 0.5) / self.count).map(linear);
        if value >= 0.0 { colour } else { colour.map(|v| v + 0.5 * (1.0 - v)) }
    }
}
