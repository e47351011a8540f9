//! Colours of objects, which may differ from point to point: functions of the coordinates evaluated where the boundary is seen. Shades
//! nothing.

use super::palette::Palette;
use crate::reuse::Digest;
use crate::surface::sampler::Sampler;
use crate::vm::Shape;

/// The colour of an object.
#[derive(Clone, Debug)]
pub enum Paint {
    /// The same everywhere, sRGB.
    Plain([u8; 3]),
    /// Red, green and blue as functions of the coordinates, 0 to 1 each.
    Mix(Box<[Shape; 3]>),
    /// A function whose values a palette shows.
    Scale {
        /// The function.
        shape: Box<Shape>,
        /// The palette.
        palette: Palette,
        /// The values at the palette's two ends; the first may be the larger one.
        ends: [f64; 2],
    },
}

impl Paint {
    /// sRGB colours, each component 0 to 1, at points: one slice of equal length for each axis of the space. Where a component is
    /// undefined the colour is that of [`Palette::colour`] for NaN.
    #[must_use]
    pub fn at(&self, points: &[&[f64]]) -> Vec<[f64; 3]> {
        let count = points.first().map_or(0, |axis| axis.len());
        match self {
            Self::Plain(colour) => vec![unit(*colour); count],
            Self::Mix(mix) => {
                let [r, g, b] = [0, 1, 2].map(|k| values(&mix[k], points, count));
                let undefined = unit(Palette::Plain.colour(f64::NAN));
                let whole = |c: [f64; 3]| if c.iter().any(|v| v.is_nan()) { undefined } else { c };
                (0..count).map(|i| whole([r[i], g[i], b[i]]).map(|v| v.clamp(0.0, 1.0))).collect()
            }
            Self::Scale { shape, palette, ends: [lo, hi] } => {
                let shown = |v: f64| unit(palette.colour((v - lo) / (hi - lo)));
                values(shape, points, count).into_iter().map(shown).collect()
            }
        }
    }

    /// Tells all that the colours depend on.
    pub fn tell(&self, to: &mut Digest) {
        match self {
            Self::Plain(colour) => to.shown(&("plain", colour)),
            Self::Mix(mix) => {
                to.text("mix");
                mix.iter().for_each(|shape| shape.tell(to));
            }
            Self::Scale { shape, palette, ends } => {
                to.shown(&("scale", palette, ends));
                shape.tell(to);
            }
        }
    }

    /// The same colours with each function changed, set to another moment say.
    #[must_use]
    pub fn map(&self, change: impl Fn(&Shape) -> Shape) -> Self {
        match self {
            Self::Plain(colour) => Self::Plain(*colour),
            Self::Mix(mix) => Self::Mix(Box::new([0, 1, 2].map(|k| change(&mix[k])))),
            Self::Scale { shape, palette, ends } => {
                Self::Scale { shape: Box::new(change(shape)), palette: *palette, ends: *ends }
            }
        }
    }
}

fn values(shape: &Shape, points: &[&[f64]], count: usize) -> Vec<f64> {
    let mut values = vec![0.0; count];
    Sampler::new(shape).values(&shape.program, points, &mut values);
    values
}

fn unit(colour: [u8; 3]) -> [f64; 3] {
    colour.map(|v| f64::from(v) / 255.0)
}
