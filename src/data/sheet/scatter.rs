//! A smooth function through scattered values: finite elements of quadratic B-splines that make the mean squared distance from the values plus
//! `smoothness` times the bending energy of a thin plate least. \[P98\] uses such functions for reliefs.

use std::fmt;
use std::sync::Arc;

use super::grid::{Equations, Unsolved};
use super::{Sheet, basis};
use crate::data::Context;

/// The degree of the splines: the least with which bending energy is finite. The equations of cubic ones take four times as long.
const DEGREE: usize = 2;
/// Splines over an element.
const OVER: usize = DEGREE + 1;

/// Less smoothness than this leaves places without points undetermined.
pub const LEAST: f64 = 1e-12;

/// Why there is no function.
#[derive(Clone, Debug, PartialEq)]
pub enum ScatterError {
    /// Fewer than three points.
    TooFew(usize),
    /// A number of this point (from 1) is not finite or too large.
    NotFinite(usize),
    /// Two points (from 1) at one place have different values.
    Coincident([usize; 2]),
    /// All points lie on a line, or at one place.
    Flat,
    /// It would take more memory than the limit, in bytes.
    TooLarge {
        /// What it would take.
        bytes: usize,
        /// The limit.
        limit: usize,
    },
    /// The values differ too much in size for doubles.
    Singular,
    /// Stopped by the user.
    Cancelled,
}

impl fmt::Display for ScatterError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFew(found) => write!(f, "three points or more make a surface, and {found} are given"),
            Self::NotFinite(point) => write!(f, "point {point} is not finite, or larger than 1e100"),
            Self::Coincident([a, b]) => write!(f, "points {a} and {b} are at the same place and have different values"),
            Self::Flat => write!(f, "all points lie on one line"),
            Self::TooLarge { bytes, limit } => {
                write!(f, "so many elements would take {bytes} bytes; the limit is {limit}")
            }
            Self::Singular => write!(f, "the equations have no solution in double precision"),
            Self::Cancelled => f.write_str("stopped"),
        }
    }
}

impl ScatterError {
    /// What to do.
    #[must_use]
    pub fn help(&self) -> &'static str {
        match self {
            Self::TooFew(_) | Self::Flat => "give points all over the region where the function is wanted",
            Self::NotFinite(_) => "each point needs two finite numbers, and a finite value",
            Self::Coincident(_) => "leave one of them out, or give their mean",
            Self::TooLarge { .. } => "use fewer elements",
            Self::Singular => "raise the smoothness, or use fewer elements",
            Self::Cancelled => "",
        }
    }
}

/// The function over the points' box, of `elements` along each axis.
///
/// # Errors
/// See [`ScatterError`]. `values` is as long as `points`, there is an element along each axis, and `smoothness` is not negative.
pub fn sheet(
    points: &[[f64; 2]],
    values: &[f64],
    smoothness: f64,
    elements: [usize; 2],
    context: Context<'_>,
) -> Result<Arc<Sheet>, ScatterError> {
    let [lo, hi] = extent(points, values)?;
    let size = elements.map(|n| n.saturating_add(DEGREE));
    let (bytes, limit) = (Equations::bytes(size), context.limits.memory_bytes);
    if bytes > limit {
        return Err(ScatterError::TooLarge { bytes, limit });
    }
    // In lengths of the box's longer side the bending energy does not depend on units, nor does it in lengths of the largest value.
    let sides = [hi[0] - lo[0], hi[1] - lo[1]];
    let long = sides[0].max(sides[1]);
    let inverse = [0, 1].map(|k| elements[k] as f64 / sides[k]);
    let largest = values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let mut equations = Equations::new(size);
    bend(&mut equations, smoothness.max(LEAST), [0, 1].map(|k| sides[k] / long / elements[k] as f64));
    let weight = 1.0 / points.len() as f64;
    for (count, (p, value)) in points.iter().zip(values).enumerate() {
        if count % 1024 == 0 {
            context.interrupt.tick().map_err(|_| ScatterError::Cancelled)?;
        }
        let s = [0, 1].map(|k| (p[k] - lo[k]) * inverse[k]);
        let first = [0, 1].map(|k| (s[k] as usize).min(elements[k] - 1));
        let [wx, wy] = [0, 1].map(|k| basis(DEGREE, s[k] - first[k] as f64));
        for a in 0..OVER * OVER {
            let (i, j, own) = (first[0] + a % OVER, first[1] + a / OVER, weight * wx[a % OVER] * wy[a / OVER]);
            equations.right[i + size[0] * j] += own * (value / scale);
            for b in 0..OVER * OVER {
                equations.add([i, j], [first[0] + b % OVER, first[1] + b / OVER], own * wx[b % OVER] * wy[b / OVER]);
            }
        }
    }
    let solved = equations.solve(context.interrupt).map_err(|why| match why {
        Unsolved::Singular => ScatterError::Singular,
        Unsolved::Cancelled => ScatterError::Cancelled,
    })?;
    let coefficients: Vec<f64> = solved.into_iter().map(|c| c * scale).collect();
    if !coefficients.iter().all(|c| c.is_finite()) {
        return Err(ScatterError::Singular);
    }
    let domain = elements.map(|n| [0.0, n as f64]);
    Ok(Sheet::new("SCATTER", DEGREE, elements, lo, inverse, domain, coefficients))
}

/// The points' box, if they are fit.
fn extent(points: &[[f64; 2]], values: &[f64]) -> Result<[[f64; 2]; 2], ScatterError> {
    if points.len() < 3 {
        return Err(ScatterError::TooFew(points.len()));
    }
    let fits = |v: &f64| v.abs() <= 1e100;
    let bad = points.iter().zip(values).position(|(p, v)| !(p.iter().all(fits) && fits(v)));
    if let Some(bad) = bad {
        return Err(ScatterError::NotFinite(bad + 1));
    }
    let mut order: Vec<usize> = (0..points.len()).collect();
    let by_place = |a: &usize, b: &usize| {
        let ([ax, ay], [bx, by]) = (points[*a], points[*b]);
        ax.total_cmp(&bx).then(ay.total_cmp(&by)).then(a.cmp(b))
    };
    order.sort_by(by_place);
    let same = order.windows(2).find(|w| points[w[0]] == points[w[1]] && values[w[0]] != values[w[1]]);
    if let Some(same) = same {
        return Err(ScatterError::Coincident([same[0] + 1, same[1] + 1]));
    }
    let (mut lo, mut hi) = (points[0], points[0]);
    for p in points {
        for k in 0..2 {
            lo[k] = lo[k].min(p[k]);
            hi[k] = hi[k].max(p[k]);
        }
    }
    // The farthest from the first, and the farthest from the line through both.
    let from = |p: &[f64; 2]| [p[0] - points[0][0], p[1] - points[0][1]];
    let far = |p: &&[f64; 2]| from(p)[0].hypot(from(p)[1]);
    let end = points.iter().max_by(|a, b| far(a).total_cmp(&far(b))).map_or([0.0; 2], from);
    let length = end[0].hypot(end[1]);
    let off = points.iter().map(|p| (from(p)[0] / length * end[1] - from(p)[1] / length * end[0]).abs());
    if !(length > 0.0 && off.fold(0.0, f64::max) > 1e-12 * length && hi[0] > lo[0] && hi[1] > lo[1]) {
        return Err(ScatterError::Flat);
    }
    Ok([lo, hi])
}

/// Adds `factor` times the bending energy of elements with these sides: the integral of `f_xx^2 + 2 f_xy^2 + f_yy^2`.
fn bend(equations: &mut Equations, factor: f64, sides: [f64; 2]) {
    let along = sides.map(|h| [0, 1, 2].map(|order| products(order, h)));
    let mut element = [[0.0; OVER * OVER]; OVER * OVER];
    for (a, row) in element.iter_mut().enumerate() {
        for (b, sum) in row.iter_mut().enumerate() {
            let (x, y) = (
                |order: usize| along[0][order][a % OVER][b % OVER],
                |order: usize| along[1][order][a / OVER][b / OVER],
            );
            *sum = factor * (x(2) * y(0) + 2.0 * x(1) * y(1) + x(0) * y(2));
        }
    }
    let [nx, ny] = equations.size.map(|n| n - DEGREE);
    for (i, j) in (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j))) {
        for (a, row) in element.iter().enumerate() {
            for (b, value) in row.iter().enumerate() {
                equations.add([i + a % OVER, j + a / OVER], [i + b % OVER, j + b / OVER], *value);
            }
        }
    }
}

/// The integrals over an element of length h of the products of the derivatives of one order.
fn products(order: usize, h: f64) -> [[f64; OVER]; OVER] {
    // Gauss with three places, exact to degree 5.
    const GAUSS: [(f64, f64); 3] =
        [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
    let at = |t: f64| match order {
        0 => basis(DEGREE, t),
        1 => super::slopes(DEGREE, t),
        _ => [1.0, -2.0, 1.0, 0.0],
    };
    let scale = h * h.powi(-2 * order as i32);
    let mut all = [[0.0; OVER]; OVER];
    for (t, weight) in GAUSS {
        let values = at(t);
        for a in 0..OVER {
            for b in 0..OVER {
                all[a][b] += weight * scale * values[a] * values[b];
            }
        }
    }
    all
}
