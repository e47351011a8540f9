//! STAR: unions of convex polyhedra about the origin. Of numbers alone it becomes data, whatever their number; where a coefficient or a
//! blending parameter varies, a chain of p-norms in the graph.

use std::sync::Arc;

use crate::builtins::Builtin;
use crate::field::{Coordinate, SharedLeaf};
use crate::number::star::{AXES, Exponent, Polyhedron, Row, StarSolid};
use crate::number::{Algebra, Binary, Ternary, Unary};
use crate::source::Span;
use crate::syntax::tree::Expr;

use super::super::errors;
use super::super::value::{Array, Scalar, Value};
use super::{Lower, Lowered};

/// A polyhedron as it was written: its rows and its blending parameter.
struct Part {
    rows: Vec<Vec<Scalar>>,
    p: Scalar,
}

impl Lower<'_> {
    /// `STAR(P, p_local, p_global)`: \[A96\] eq. (3).
    pub(super) fn star(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [polyhedra, local, global] = arguments else {
            return Err(errors::wrong_builtin_count(builtin, arguments.len(), span).into());
        };
        let value = self.expr(polyhedra)?;
        let Value::Array(array) = &value else {
            return Err(errors::wrong_builtin_kind(builtin, &value, "an array of polyhedra", polyhedra.span).into());
        };
        let p_local = self.expr(local)?;
        let p_global = self.scalar(global, "the global blending parameter")?;
        check_parameter(p_global, global.span)?;
        let parts = self.parts(array, polyhedra.span, (&p_local, local.span))?;
        let arity = parts[0].rows[0].len();
        let node = match data(arity, &parts, p_global) {
            Some(solid) => {
                #[allow(clippy::cast_possible_truncation)]
                let at: Vec<_> = (1..=arity as u8).map(|c| self.graph.coordinate(Coordinate(c))).collect();
                let leaf = self.graph.leaf(SharedLeaf(Arc::new(solid)), &at);
                self.wrap(leaf)
            }
            None => self.norms(&parts, p_global, span)?,
        };
        Ok(Value::Scalar(self.scalars().binary(Binary::Sub, Scalar::Number(1.0), node)))
    }

    /// The polyhedra, all of whose rows have one length, each with its parameter.
    fn parts(&mut self, array: &Array, at: Span, (local, local_at): (&Value, Span)) -> Lowered<Vec<Part>> {
        let count = array.items().len();
        let parameters: Vec<Scalar> = match local {
            Value::Scalar(p) => vec![*p; count],
            Value::Array(all) if all.items().len() == count => {
                let each = all.items().iter().map(|p| self.as_scalar(p, local_at, "a local blending parameter"));
                each.collect::<Lowered<_>>()?
            }
            Value::Array(all) => return Err(errors::star_parameters(count, all.items().len(), local_at).into()),
            other => return Err(errors::star_kind("a local blending parameter", other, local_at).into()),
        };
        parameters.iter().try_for_each(|p| check_parameter(*p, local_at))?;
        let mut length = None;
        let mut parts = Vec::with_capacity(count);
        for (i, (polyhedron, p)) in array.items().iter().zip(parameters).enumerate() {
            let Value::Array(rows) = polyhedron else {
                return Err(errors::star_kind(&format!("polyhedron {}", i + 1), polyhedron, at).into());
            };
            let mut part = Part { rows: Vec::with_capacity(rows.items().len()), p };
            for (j, row) in rows.items().iter().enumerate() {
                self.world.interrupt.tick()?;
                let Value::Array(row) = row else {
                    return Err(errors::star_row(i, j, row, at).into());
                };
                let row: Lowered<Vec<Scalar>> =
                    row.items().iter().map(|a| self.as_scalar(a, at, "a coefficient of a half-space")).collect();
                let row = row?;
                if !(1..=AXES).contains(&row.len()) || *length.get_or_insert(row.len()) != row.len() {
                    return Err(errors::star_length((i, j), length, row.len(), at).into());
                }
                if row.iter().any(|a| a.number().is_some_and(|a| !a.is_finite())) {
                    return Err(errors::star_coefficient(i, j, at).into());
                }
                part.rows.push(row);
            }
            if part.rows.is_empty() {
                return Err(errors::star_empty(Some(i), at).into());
            }
            parts.push(part);
        }
        if parts.is_empty() { Err(errors::star_empty(None, at).into()) } else { Ok(parts) }
    }

    /// F as a chain of p-norms over the coordinates.
    fn norms(&mut self, parts: &[Part], p_global: Scalar, span: Span) -> Lowered<Scalar> {
        let less = self.scalars().unary(Unary::Neg, p_global);
        let mut all: Option<Scalar> = None;
        for part in parts {
            let mut own: Option<Scalar> = None;
            for row in &part.rows {
                self.turn(span)?;
                let half = self.half_space(row);
                own = Some(match own {
                    None => half,
                    Some(own) => self.scalars().ternary(Ternary::Norm, own, half, part.p),
                });
            }
            all = match (all, own) {
                (Some(all), Some(own)) => Some(self.scalars().ternary(Ternary::Norm, all, own, less)),
                (all, own) => all.or(own),
            };
        }
        Ok(all.unwrap_or(Scalar::Number(0.0)))
    }

    /// `H(L) = (L + |L|)/2`: \[A96\] eq. (2).
    fn half_space(&mut self, row: &[Scalar]) -> Scalar {
        let mut sum = Scalar::Number(0.0);
        for (c, a) in (1..).zip(row) {
            let x = Scalar::Node(self.graph.coordinate(Coordinate(c)));
            let mut algebra = self.scalars();
            let term = algebra.binary(Binary::Mul, *a, x);
            sum = if sum == Scalar::Number(0.0) { term } else { algebra.binary(Binary::Add, sum, term) };
        }
        let mut algebra = self.scalars();
        let size = algebra.unary(Unary::Abs, sum);
        let twice = algebra.binary(Binary::Add, sum, size);
        algebra.binary(Binary::Mul, twice, Scalar::Number(0.5))
    }
}

fn check_parameter(p: Scalar, at: Span) -> Lowered<()> {
    match p.number() {
        Some(p) if Exponent::new(p).is_none() => Err(errors::star_exponent(p, at).into()),
        _ => Ok(()),
    }
}

/// The solid as data, if all is numbers.
fn data(arity: usize, parts: &[Part], p_global: Scalar) -> Option<StarSolid> {
    let exponent = |p: Scalar| p.number().and_then(Exponent::new);
    let row = |row: &Vec<Scalar>| {
        let mut all: Row = [0.0; AXES];
        row.iter().zip(&mut all).try_for_each(|(a, out)| a.number().map(|a| *out = a))?;
        Some(all)
    };
    let parts: Option<Vec<Polyhedron>> = parts
        .iter()
        .map(|part| Some(Polyhedron { rows: part.rows.iter().map(row).collect::<Option<_>>()?, p: exponent(part.p)? }))
        .collect();
    Some(StarSolid { arity, parts: parts?, p: exponent(p_global)? })
}
