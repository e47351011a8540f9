//! Least squares by the method of Levenberg and Marquardt, the damping as Nielsen has it. Knows no expressions: it asks for residuals and
//! their exact derivatives.

/// Steps after which it is given up.
const STEPS: usize = 400;
/// A step shorter than this part of the parameters ends the search.
const SHORT: f64 = 1e-13;
/// The cosine between the residuals and each column of derivatives below which the residuals cannot be made smaller.
const ACROSS: f64 = 1e-7;
/// Damping beyond which no step can help.
const STIFF: f64 = 1e30;

/// What a search knows of a place.
#[derive(Clone, Debug, Default)]
pub struct Residuals {
    /// The residuals.
    pub values: Vec<f64>,
    /// For each parameter, the derivatives of the residuals by it.
    pub slopes: Vec<Vec<f64>>,
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Unfit {
    /// The residual with this number, from 0, or one of its derivatives is not finite at the start.
    Undefined(usize),
    /// No residual depends on the parameter with this number, from 0, at the start.
    Idle(usize),
    /// It ended at these parameters, where the residuals have this mean length, without having found the least.
    Diverges(Vec<f64>, f64),
}

/// The parameters for which the sum of the squared residuals is least, sought from `start`. `ask` gives the residuals at some
/// parameters; the number of them is always the same.
///
/// # Errors
/// [`Unfit`], or what `ask` fails with.
pub fn least_squares<E>(
    start: Vec<f64>,
    mut ask: impl FnMut(&[f64]) -> Result<Residuals, E>,
) -> Result<Result<Vec<f64>, Unfit>, E> {
    let mut at = start;
    let mut here = ask(&at)?;
    if let Some(bad) = undefined(&here) {
        return Ok(Err(Unfit::Undefined(bad)));
    }
    if let Some(idle) = here.slopes.iter().position(|column| column.iter().all(|s| *s == 0.0)) {
        return Ok(Err(Unfit::Idle(idle)));
    }
    let mut cost = dot(&here.values, &here.values);
    let (mut damping, mut factor) = (1e-3, 2.0);
    let mut scales = vec![0.0; at.len()];
    for _ in 0..STEPS {
        for (scale, column) in scales.iter_mut().zip(&here.slopes) {
            *scale = dot(column, column).max(*scale);
        }
        if cost == 0.0 {
            return Ok(Ok(at));
        }
        let Some(step) = step(&here, damping, &scales) else {
            damping *= factor;
            factor *= 2.0;
            if damping > STIFF {
                break;
            }
            continue;
        };
        let next: Vec<f64> = at.iter().zip(&step).map(|(p, d)| p + d).collect();
        let still = step.iter().zip(&at).all(|(d, p)| d.abs() <= SHORT * (p.abs() + SHORT));
        let there = ask(&next)?;
        let cost_there = if undefined(&there).is_some() { f64::INFINITY } else { dot(&there.values, &there.values) };
        // What the linear model promises: d . (damping D d - J^T r).
        let pulled = here.slopes.iter().map(|column| dot(column, &here.values));
        let promised: f64 =
            step.iter().zip(&scales).zip(pulled).map(|((d, scale), pull)| d * (damping * scale * d - pull)).sum();
        let gain = (cost - cost_there) / promised;
        if cost_there < cost && gain > 0.0 {
            (at, here, cost) = (next, there, cost_there);
            let u: f64 = 2.0 * gain - 1.0;
            damping *= (1.0 - u * u * u).max(1.0 / 3.0);
            factor = 2.0;
        } else {
            damping *= factor;
            factor *= 2.0;
        }
        if still || damping > STIFF {
            break;
        }
    }
    // Where the residuals stay large, their sum cannot tell places that differ in the last half of the digits; the pull still can.
    for _ in 0..3 {
        let Some(step) = step(&here, 0.0, &scales) else { break };
        let next: Vec<f64> = at.iter().zip(&step).map(|(p, d)| p + d).collect();
        let there = ask(&next)?;
        if undefined(&there).is_some() || pull(&there, &scales) >= pull(&here, &scales) {
            break;
        }
        (at, here) = (next, there);
    }
    #[allow(clippy::cast_precision_loss)]
    let mean = (cost / here.values.len() as f64).sqrt();
    if is_least(&at, &here, cost) { Ok(Ok(at)) } else { Ok(Err(Unfit::Diverges(at, mean))) }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// How strongly the residuals pull at the parameters, in units of the columns.
fn pull(here: &Residuals, scales: &[f64]) -> f64 {
    here.slopes.iter().zip(scales).map(|(column, scale)| dot(column, &here.values).powi(2) / scale).sum()
}

/// The first residual that is not finite, or whose derivatives are not.
fn undefined(of: &Residuals) -> Option<usize> {
    (0..of.values.len()).find(|&i| !(of.values[i].is_finite() && of.slopes.iter().all(|column| column[i].is_finite())))
}

/// Whether the residuals stand across all that the parameters can do, or are what rounding of the parameters makes.
fn is_least(at: &[f64], here: &Residuals, cost: f64) -> bool {
    let length = cost.sqrt();
    let own: Vec<f64> = here.slopes.iter().map(|column| dot(column, column).sqrt()).collect();
    let across = here
        .slopes
        .iter()
        .zip(&own)
        .all(|(column, own)| *own > 0.0 && dot(column, &here.values).abs() <= ACROSS * own * length);
    let rounding: f64 = own.iter().zip(at).map(|(own, p)| 64.0 * f64::EPSILON * own * p.abs()).sum();
    across || length <= rounding
}

/// The solution of `(J^T J + damping D) d = -J^T r` by Cholesky's method, in units of the columns; none if it is not positive definite.
fn step(here: &Residuals, damping: f64, scales: &[f64]) -> Option<Vec<f64>> {
    let n = scales.len();
    let units: Vec<f64> = scales.iter().map(|s| s.sqrt()).collect();
    let mut lower = vec![vec![0.0; n]; n];
    let mut right: Vec<f64> = (0..n).map(|i| -dot(&here.slopes[i], &here.values) / units[i]).collect();
    for i in 0..n {
        for j in 0..=i {
            let product = dot(&here.slopes[i], &here.slopes[j]) / units[i] / units[j];
            let whole = if i == j { product + damping } else { product };
            let rest = whole - dot(&lower[i][..j], &lower[j][..j]);
            lower[i][j] = if i == j { Some(rest.sqrt()).filter(|root| *root > 0.0)? } else { rest / lower[j][j] };
        }
    }
    for i in 0..n {
        right[i] = (right[i] - dot(&lower[i][..i], &right[..i])) / lower[i][i];
    }
    for i in (0..n).rev() {
        let done: f64 = (i + 1..n).map(|k| lower[k][i] * right[k]).sum();
        right[i] = (right[i] - done) / lower[i][i];
    }
    let step: Vec<f64> = right.iter().zip(units).map(|(d, unit)| d / unit).collect();
    step.iter().all(|d| d.is_finite()).then_some(step)
}
