//! A volume: samples on a regular grid of one to three axes, and where the grid lies in the world. Never evaluates anything.

use super::error::DataError;

/// The numbers of a volume, x1 fastest, in the smallest of three kinds that holds them exactly.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    /// Unsigned bytes.
    Bytes(Vec<u8>),
    /// What single precision holds exactly: signed bytes, 16-bit integers, singles.
    Singles(Vec<f32>),
    /// All else. 64-bit integers above 2^53 are rounded.
    Doubles(Vec<f64>),
}

impl Samples {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Bytes(all) => all.len(),
            Self::Singles(all) => all.len(),
            Self::Doubles(all) => all.len(),
        }
    }

    /// These, and behind them others of the same kind; others of another kind replace them.
    #[must_use]
    pub fn followed_by(self, next: Self) -> Self {
        match (self, next) {
            (Self::Bytes(mut all), Self::Bytes(next)) => {
                all.extend(next);
                Self::Bytes(all)
            }
            (Self::Singles(mut all), Self::Singles(next)) => {
                all.extend(next);
                Self::Singles(all)
            }
            (Self::Doubles(mut all), Self::Doubles(next)) => {
                all.extend(next);
                Self::Doubles(all)
            }
            (_, next) => next,
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The sample at `index` as a double; infinities count as undefined (NaN), so that interpolation never meets them.
    ///
    /// # Panics
    /// If `index` is not below [`Samples::len`].
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> f64 {
        let value = match self {
            Self::Bytes(all) => return f64::from(all[index]),
            Self::Singles(all) => f64::from(all[index]),
            Self::Doubles(all) => all[index],
        };
        if value.is_finite() { value } else { f64::NAN }
    }
}

/// Where the samples lie: sample i is at `origin + i * step` along the axes, or, for an oblique grid, at `origin + M i`.
#[derive(Clone, Debug, PartialEq)]
pub struct Placement {
    /// World coordinates of the first sample.
    pub origin: [f64; 3],
    /// For each axis of the grid, the step from a sample to the next, in world coordinates.
    pub directions: [[f64; 3]; 3],
}

impl Default for Placement {
    fn default() -> Self {
        Self::aligned([0.0; 3], [1.0; 3])
    }
}

impl Placement {
    /// A grid along the axes of the world.
    #[must_use]
    pub fn aligned(origin: [f64; 3], spacing: [f64; 3]) -> Self {
        let mut directions = [[0.0; 3]; 3];
        for axis in 0..3 {
            directions[axis][axis] = spacing[axis];
        }
        Self { origin, directions }
    }

    /// World coordinates of the sample with these indices.
    #[must_use]
    pub fn world(&self, index: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|k| self.origin[k] + (0..3).map(|axis| index[axis] * self.directions[axis][k]).sum::<f64>())
    }
}

/// Samples on a grid in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// The file's name, for messages.
    pub name: String,
    /// Number of axes, 1 to 3.
    pub dimension: usize,
    /// Samples along each axis; 1 beyond `dimension`.
    pub size: [usize; 3],
    /// Where they lie.
    pub placement: Placement,
    /// The numbers, x1 fastest: index `i + size[0] (j + size[1] k)`.
    pub samples: Samples,
}

impl Volume {
    /// A volume from its parts.
    ///
    /// # Errors
    /// A number of axes other than 1 to 3, an empty axis, a number of samples that is not the product of the sizes, directions
    /// that are not finite or do not span the space, no finite sample.
    pub fn new(name: &str, size: &[usize], placement: Placement, samples: Samples) -> Result<Self, DataError> {
        if size.is_empty() || size.len() > 3 {
            return Err(DataError::Dimensions { found: size.len() });
        }
        if let Some(axis) = size.iter().position(|&n| n == 0) {
            return Err(DataError::EmptyAxis { axis: axis + 1 });
        }
        let promised = size.iter().try_fold(1_usize, |product, &n| product.checked_mul(n)).unwrap_or(usize::MAX);
        if samples.len() < promised {
            return Err(DataError::TooFew { unit: "numbers", promised: promised as u64, found: samples.len() as u64 });
        }
        if samples.len() > promised {
            return Err(DataError::TooMany { unit: "numbers", promised: promised as u64 });
        }
        if !spans(&placement, size.len()) {
            return Err(DataError::FlatGrid);
        }
        let mut all = [1; 3];
        all[..size.len()].copy_from_slice(size);
        Ok(Self { name: name.to_owned(), dimension: size.len(), size: all, placement, samples })
    }

    /// The smallest box of the world that holds every sample: lowest and highest coordinate for each axis of the world.
    #[must_use]
    pub fn extent(&self) -> Vec<(f64, f64)> {
        let mut extent = vec![(f64::INFINITY, f64::NEG_INFINITY); self.dimension];
        for corner in 0..8_usize {
            let index = std::array::from_fn(|k| if corner >> k & 1 == 1 { self.size[k] as f64 - 1.0 } else { 0.0 });
            let at = self.placement.world(index);
            for (bound, at) in extent.iter_mut().zip(at) {
                *bound = (bound.0.min(at), bound.1.max(at));
            }
        }
        extent
    }
}

/// Whether the first `dimension` directions are finite and independent within the first `dimension` coordinates.
fn spans(placement: &Placement, dimension: usize) -> bool {
    let finite = placement.origin.iter().chain(placement.directions.iter().flatten()).all(|v| v.is_finite());
    finite && super::place::Locator::new(placement, dimension).is_some()
}
