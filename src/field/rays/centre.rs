//! Guesses at the centre of a star: where the linear forms of an expression vanish, or where its linear terms do. Guesses cost nothing when
//! they are wrong: whoever uses one checks it.

use super::{Rays, Why};
use crate::field::{Coordinate, Graph, Node, NodeId};

/// Linear forms that are looked at.
const FORMS: usize = 10_000;

/// Points that may be centres of a function, the best first and none twice: the origin, where the linear forms vanish (or, if they do not all
/// vanish anywhere, where their squares are least: the middle of a block), where the terms of degree 1 vanish, and `hint`.
#[must_use]
pub fn centres(graph: &Graph, root: NodeId, axes: &[Coordinate], hint: Option<&[f64]>, limit: usize) -> Vec<Vec<f64>> {
    let origin = vec![0.0; axes.len()];
    let mut rays = Rays::new(graph, axes, &origin, limit);
    let form = rays.form(root);
    let mut all = vec![origin];
    let offer = |all: &mut Vec<Vec<f64>>, point: Option<Vec<f64>>| {
        if let Some(point) = point.filter(|p| p.iter().all(|c| c.is_finite()) && !all.contains(p)) {
            all.push(point);
        }
    };
    if matches!(&form, Err(broken) if matches!(broken.why, Why::Data | Why::Size)) {
        return all;
    }
    let linear = rays.linear(root);
    offer(&mut all, middle(&linear, axes.len()).map(rounded));
    offer(&mut all, rays.stationary(root).map(rounded));
    offer(&mut all, hint.map(<[f64]>::to_vec));
    all
}

/// Without the last digits, which are rounding: a centre is mostly a short number.
fn rounded(point: Vec<f64>) -> Vec<f64> {
    let short = |c: f64| format!("{c:.12e}").parse::<f64>().unwrap_or(c);
    let size = point.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    point.into_iter().map(|c| if c.abs() < 1e-14 * size { 0.0 } else { short(c) }).collect()
}

/// `a . x + b`: the factors and the number.
type Linear = (Vec<f64>, f64);

impl Rays<'_> {
    /// The linear forms that an expression is made of, as far as no larger part of it is linear too.
    fn linear(&self, root: NodeId) -> Vec<Linear> {
        let mut all: Vec<Linear> = Vec::new();
        let mut offer = |of: Option<Linear>| {
            if let Some(linear) = of.filter(|l| all.len() < FORMS && !all.contains(l)) {
                all.push(linear);
            }
        };
        for &(node, view) in &self.order {
            if self.affine((node, view)).is_some() {
                continue;
            }
            match self.source.node(node) {
                Node::Map(..) | Node::Coordinate(_) | Node::Constant(_) => {}
                plain => plain.for_each_operand(|e| offer(self.affine((e, view)))),
            }
        }
        if let Some(alone) = self.affine((root, 0)) {
            all.push(alone);
        }
        all
    }

    fn affine(&self, key: super::Key) -> Option<Linear> {
        let form = self.forms.get(&key)?.as_ref().ok()?;
        let mut factors = vec![0.0; self.axes.len()];
        let mut number = 0.0;
        for term in form.terms() {
            match term.degree.value {
                0.0 => number = self.sums.graph.number(term.coefficient)?,
                1.0 if term.degree.of.is_none() => {
                    for (product, factor) in self.sums.polynomial(term.coefficient, &self.axes)? {
                        let [axis] = product[..] else { return None };
                        factors[axis] += factor;
                    }
                }
                _ => return None,
            }
        }
        factors.iter().any(|f| *f != 0.0).then_some((factors, number))
    }

    /// Where the terms of degree 1 of a quadric vanish.
    fn stationary(&self, root: NodeId) -> Option<Vec<f64>> {
        let form = self.forms.get(&(root, 0))?.as_ref().ok()?;
        let n = self.axes.len();
        let of = |degree: f64| form.terms().iter().find(|t| t.degree.of.is_none() && t.degree.value == degree);
        let mut rows = vec![vec![0.0; n + 1]; n];
        for (product, factor) in self.sums.polynomial(of(2.0)?.coefficient, &self.axes)? {
            let [a, b] = product[..] else { return None };
            rows[a][b] += factor;
            rows[b][a] += factor;
        }
        for (product, factor) in self.sums.polynomial(of(1.0)?.coefficient, &self.axes)? {
            let [axis] = product[..] else { return None };
            rows[axis][n] = -factor;
        }
        solved(rows)
    }
}

/// The point where the sum of the squares of linear forms, each divided by the length of its factors, is least.
fn middle(forms: &[Linear], n: usize) -> Option<Vec<f64>> {
    let mut rows = vec![vec![0.0; n + 1]; n];
    for (factors, number) in forms {
        let square: f64 = factors.iter().map(|f| f * f).sum();
        for i in 0..n {
            for j in 0..n {
                rows[i][j] += factors[i] * factors[j] / square;
            }
            rows[i][n] -= factors[i] * number / square;
        }
    }
    // An axis that no form tells of stays at 0.
    for (i, row) in rows.iter_mut().enumerate() {
        if row.iter().all(|v| *v == 0.0) {
            row[i] = 1.0;
        }
    }
    solved(rows)
}

/// The solution of a small linear system, by elimination with the largest pivot; none if it has none or many.
fn solved(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let n = rows.len();
    for column in 0..n {
        let largest = (column..n).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))?;
        rows.swap(column, largest);
        let pivot = rows[column].clone();
        if pivot[column].abs() < 1e-12 {
            return None;
        }
        for (_, row) in rows.iter_mut().enumerate().filter(|(k, _)| *k != column) {
            let by = row[column] / pivot[column];
            row.iter_mut().zip(&pivot).for_each(|(v, p)| *v -= by * p);
        }
    }
    Some((0..n).map(|k| rows[k][n] / rows[k][k]).collect())
}
