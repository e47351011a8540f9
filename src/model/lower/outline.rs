//! The built-ins that make functions of lists of points: POLYGON, CONTOURS and MEDIAL. Each becomes plain nodes of the graph, so that
//! everything else works on them; the geometry of polygons is decided in `data`.

use crate::builtins::Builtin;
use crate::data::polygon::{Polygon, PolygonError, Step};
use crate::diagnostic::Diagnostic;
use crate::field::Coordinate;
use crate::number::{Algebra, Binary, Unary};
use crate::source::Span;
use crate::syntax::tree::Expr;

use super::super::errors;
use super::super::value::{Scalar, Value};
use super::{Fault, Lower, Lowered};

/// Contours within each other and their order.
struct Nested {
    polygons: Vec<Polygon>,
    /// The contours right inside each contour; the last entry those in none.
    inside: Vec<Vec<usize>>,
}

impl Lower<'_> {
    /// `POLYGON(px, py)`
    pub(super) fn polygon(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [px, py] = arguments else { return Ok(Value::number(f64::NAN)) };
        let (x, y) = (self.numbers(builtin, px)?, self.numbers(builtin, py)?);
        if x.len() != y.len() {
            return Err(errors::lengths_differ(x.len(), y.len(), px.span, py.span).into());
        }
        let polygon = self.simple(&x, &y, span, "")?;
        self.half_planes(&polygon, span).map(Value::Scalar)
    }

    fn simple(&self, x: &[f64], y: &[f64], span: Span, of: &str) -> Lowered<Polygon> {
        let vertices: Vec<[f64; 2]> = x.iter().zip(y).map(|(&x, &y)| [x, y]).collect();
        Polygon::new(&vertices, self.world.interrupt).map_err(|why| refused(&why, span, of))
    }

    fn half_planes(&mut self, polygon: &Polygon, span: Span) -> Lowered<Scalar> {
        let steps = polygon.formula(self.world.interrupt).map_err(|why| refused(&why, span, ""))?;
        let place = [1, 2].map(|c| self.graph.coordinate(Coordinate(c)));
        let [x, y] = place.map(Scalar::Node);
        let mut stack = Vec::new();
        for step in steps {
            let value = match step {
                Step::HalfPlane(plane) => {
                    self.turn(span)?;
                    self.half_plane(plane, [x, y])
                }
                Step::Both | Step::Either => {
                    let (Some(b), Some(a)) = (stack.pop(), stack.pop()) else { continue };
                    if step == Step::Both { self.intersection(a, b, span)? } else { self.union(a, b, span)? }
                }
            };
            stack.push(value);
        }
        Ok(stack.pop().unwrap_or(Scalar::Number(f64::NAN)))
    }

    /// `a x + b y + c`
    fn half_plane(&mut self, [a, b, c]: [f64; 3], [x, y]: [Scalar; 2]) -> Scalar {
        let mut sum = Scalar::Number(c);
        for (factor, place) in [(b, y), (a, x)] {
            if factor != 0.0 {
                let part = self.scalars().binary(Binary::Mul, Scalar::Number(factor), place);
                sum = self.scalars().binary(Binary::Add, part, sum);
            }
        }
        sum
    }

    /// `CONTOURS([[px, py], ...])`: inside an odd number of them.
    pub(super) fn contours(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [list] = arguments else { return Ok(Value::number(f64::NAN)) };
        let shape = || errors::wrong_builtin_shape(builtin, "an array of contours, each [px, py]", list.span);
        let Value::Array(contours) = self.expr(list)? else { return Err(shape().into()) };
        let mut polygons = Vec::with_capacity(contours.items().len());
        for (i, contour) in contours.items().iter().enumerate() {
            let Value::Array(pair) = contour else { return Err(shape().into()) };
            let [x, y] = pair.items() else { return Err(shape().into()) };
            let (x, y) = (self.plain(x, &shape)?, self.plain(y, &shape)?);
            if x.len() != y.len() {
                return Err(errors::lengths_differ(x.len(), y.len(), list.span, list.span).into());
            }
            polygons.push(self.simple(&x, &y, span, &format!("contour {}: ", i + 1))?);
        }
        let nested = self.nest(polygons, span)?;
        let outer = nested.inside.last().cloned().unwrap_or_default();
        match self.odd(&nested, &outer, span)? {
            Some(value) => Ok(Value::Scalar(value)),
            None => Err(shape().into()),
        }
    }

    /// Which contour lies in which; two that meet are an error.
    fn nest(&mut self, polygons: Vec<Polygon>, span: Span) -> Lowered<Nested> {
        let corners: Vec<Vec<[f64; 2]>> = polygons.iter().map(Polygon::corners).collect();
        let n = polygons.len();
        let mut around = vec![Vec::new(); n];
        for i in 0..n {
            for j in 0..n {
                self.turn(span)?;
                if i < j {
                    let met = polygons[i].meets(&polygons[j], self.world.interrupt);
                    if let Some(met) = met.map_err(|why| refused(&why, span, ""))? {
                        return Err(contours_meet(i, j, met.first, met.second, met.at, span).into());
                    }
                }
                if i != j && polygons[j].contains(corners[i][0]) {
                    around[i].push(j);
                }
            }
        }
        let mut inside = vec![Vec::new(); n + 1];
        for i in 0..n {
            // The one right around it lies in all the others around it.
            let parent = around[i].iter().copied().max_by_key(|&j| around[j].len());
            inside[parent.unwrap_or(n)].push(i);
        }
        Ok(Nested { polygons, inside })
    }

    /// The union of some contours, each without what its inner ones hold.
    fn odd(&mut self, nested: &Nested, contours: &[usize], span: Span) -> Lowered<Option<Scalar>> {
        let mut all: Option<Scalar> = None;
        for &i in contours {
            self.turn(span)?;
            let mut own = self.half_planes(&nested.polygons[i], span)?;
            if let Some(inner) = self.odd(nested, &nested.inside[i], span)? {
                let outside = self.scalars().unary(Unary::Neg, inner);
                own = self.intersection(own, outside, span)?;
            }
            all = Some(match all {
                Some(all) => self.union(all, own, span)?,
                None => own,
            });
        }
        Ok(all)
    }

    /// `MEDIAL(P, R, edges)`
    pub(super) fn medial(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [points, radii, edges] = arguments else { return Ok(Value::number(f64::NAN)) };
        let places = self.rows(builtin, points)?;
        let r = self.numbers(builtin, radii)?;
        if places.len() != r.len() {
            return Err(errors::lengths_differ(places.len(), r.len(), points.span, radii.span).into());
        }
        if let Some(bad) = r.iter().position(|r| !(*r >= 0.0 && r.is_finite())) {
            return Err(errors::bad_radius(bad + 1, r[bad], radii.span).into());
        }
        let pairs = self.rows(builtin, edges)?;
        let mut all: Option<Scalar> = None;
        for (number, pair) in pairs.iter().enumerate() {
            self.turn(span)?;
            let ends =
                ends_of(pair, places.len()).ok_or_else(|| errors::bad_edge(number + 1, places.len(), edges.span))?;
            let value = self.rounded_cone(ends.map(|i| &places[i][..]), ends.map(|i| r[i]));
            all = Some(match all {
                Some(all) => self.scalars().binary(Binary::Max, all, value),
                None => value,
            });
        }
        Ok(Value::Scalar(all.unwrap_or(Scalar::Number(f64::NAN))))
    }

    /// `R(t)^2 - |X - X0(t)|^2` at its highest along a segment, t from 0 to 1. \[P98\] 2.3, with the highest place mended.
    fn rounded_cone(&mut self, [p, q]: [&[f64]; 2], [r, s]: [f64; 2]) -> Scalar {
        let away: Vec<Scalar> = p.iter().enumerate().map(|(i, &c)| self.from(i, c)).collect();
        let length: Vec<f64> = p.iter().zip(q).map(|(p, q)| q - p).collect();
        let steep = s - r;
        let divisor = length.iter().map(|l| l * l).sum::<f64>() - steep * steep;
        if divisor > 0.0 {
            let mut along = Scalar::Number(r * steep);
            for (&x, &l) in away.iter().zip(&length) {
                let part = self.scalars().binary(Binary::Mul, Scalar::Number(l), x);
                along = self.scalars().binary(Binary::Add, along, part);
            }
            let mut algebra = self.scalars();
            let t = algebra.binary(Binary::Div, along, Scalar::Number(divisor));
            let t = algebra.binary(Binary::Max, Scalar::Number(0.0), t);
            let t = algebra.binary(Binary::Min, Scalar::Number(1.0), t);
            return self.ball_at(&away, &length, (r, steep), t);
        }
        // One end's ball holds the other's, and the highest place is an end.
        let first = self.ball_at(&away, &length, (r, steep), Scalar::Number(0.0));
        let second = self.ball_at(&away, &length, (r, steep), Scalar::Number(1.0));
        self.scalars().binary(Binary::Max, first, second)
    }

    fn ball_at(&mut self, away: &[Scalar], length: &[f64], (r, steep): (f64, f64), t: Scalar) -> Scalar {
        let mut algebra = self.scalars();
        let grown = algebra.binary(Binary::Mul, t, Scalar::Number(steep));
        let radius = algebra.binary(Binary::Add, Scalar::Number(r), grown);
        let mut value = algebra.unary(Unary::Powi(2), radius);
        for (&x, &l) in away.iter().zip(length) {
            let gone = algebra.binary(Binary::Mul, t, Scalar::Number(l));
            let rest = algebra.binary(Binary::Sub, x, gone);
            let square = algebra.unary(Unary::Powi(2), rest);
            value = algebra.binary(Binary::Sub, value, square);
        }
        value
    }

    /// Coordinate number i, from 0, less a number.
    fn from(&mut self, i: usize, c: f64) -> Scalar {
        #[allow(clippy::cast_possible_truncation)]
        let x = self.graph.coordinate(Coordinate(i as u8 + 1));
        self.scalars().binary(Binary::Sub, Scalar::Node(x), Scalar::Number(c))
    }

    /// An argument that is an array of numbers.
    pub(super) fn numbers(&mut self, builtin: &Builtin, e: &Expr) -> Lowered<Vec<f64>> {
        let value = self.expr(e)?;
        self.plain(&value, &|| errors::wrong_builtin_shape(builtin, "an array of numbers", e.span))
    }

    fn plain(&self, value: &Value, shape: &dyn Fn() -> Diagnostic) -> Lowered<Vec<f64>> {
        let Value::Array(array) = value else { return Err(shape().into()) };
        let number = |item: &Value| match item {
            Value::Scalar(Scalar::Number(value)) => Ok(*value),
            _ => Err(Fault::from(shape())),
        };
        array.items().iter().map(number).collect()
    }

    /// An argument that is an array of rows of numbers, all of one length of 1 to 16.
    pub(super) fn rows(&mut self, builtin: &Builtin, e: &Expr) -> Lowered<Vec<Vec<f64>>> {
        let shape = || errors::wrong_builtin_shape(builtin, "an array of arrays of numbers, all of one length", e.span);
        let Value::Array(array) = self.expr(e)? else { return Err(shape().into()) };
        let rows: Lowered<Vec<Vec<f64>>> = array.items().iter().map(|row| self.plain(row, &shape)).collect();
        let rows = rows?;
        let width = rows.first().map_or(0, Vec::len);
        if !(1..=Coordinate::NAMED).contains(&width) || rows.iter().any(|row| row.len() != width) {
            return Err(shape().into());
        }
        Ok(rows)
    }
}

/// Two points by their numbers from 1.
fn ends_of(pair: &[f64], points: usize) -> Option<[usize; 2]> {
    let [a, b] = pair else { return None };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
    let place = |i: f64| (i.fract() == 0.0 && i >= 1.0 && i <= points as f64).then(|| i as usize - 1);
    Some([place(*a)?, place(*b)?])
}

fn refused(why: &PolygonError, span: Span, of: &str) -> Fault {
    if *why == PolygonError::Cancelled {
        return Fault::Cancelled;
    }
    let help = match why {
        PolygonError::TooFew(_) => "give three vertices or more that do not lie on one line",
        PolygonError::NotFinite(_) => "every vertex needs two finite numbers",
        _ => "change the order of the vertices, or move one, so that the edges meet at their common ends only",
    };
    Diagnostic::error("bad-polygon", format!("{of}{why}")).at(span, "").help(help).into()
}

fn contours_meet(
    i: usize,
    j: usize,
    [a, b]: [usize; 2],
    [c, d]: [usize; 2],
    [x, y]: [f64; 2],
    span: Span,
) -> Diagnostic {
    let (i, j) = (i + 1, j + 1);
    let title = format!(
        "contours {i} and {j} cross or touch: the edge from vertex {a} to {b} of contour {i} meets that from {c} to {d} of contour {j} at ({x:.6}, {y:.6})"
    );
    Diagnostic::error("contours-meet", title)
        .at(span, "")
        .help("make one polygon of both, or join two objects POLYGON(..) with `|`, `\\` or `&`")
}
