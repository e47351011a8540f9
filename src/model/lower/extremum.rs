//! The built-ins that search for a highest value: PROJECT and OFFSET_BALL. Never computes one: each becomes a region of the graph.

use crate::field::region::Refused;
use crate::field::{Coordinate, NodeId};
use crate::number::{Algebra, Binary, Ternary, Unary};
use crate::source::Span;
use crate::syntax::tree::{Expr, ExprKind};

use super::super::errors;
use super::super::value::{Scalar, Value};
use super::{Lower, Lowered};

impl Lower<'_> {
    /// `PROJECT(e, x4, lo, hi)`
    pub(super) fn project(&mut self, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [e, by, lo, hi] = arguments else { return Ok(Value::number(f64::NAN)) };
        let ExprKind::Coordinate(c) = by.kind else {
            return Err(errors::project_needs_coordinate(by.span).into());
        };
        let over = Coordinate(c);
        let value = self.expr(e)?;
        let (lo_value, hi_value) = (self.section_end(lo, over)?, self.section_end(hi, over)?);
        if let (Scalar::Number(a), Scalar::Number(b)) = (lo_value, hi_value)
            && !(a <= b)
        {
            return Err(errors::empty_range(a, b, lo.span.to(hi.span)).into());
        }
        let ends = (lo_value.node(self.graph), hi_value.node(self.graph));
        self.each(&value, e.span, &mut |lower, scalar| lower.section(scalar, over, ends, span))
    }

    fn section_end(&mut self, e: &Expr, over: Coordinate) -> Lowered<Scalar> {
        let bound = self.scalar(e, "a bound of PROJECT")?;
        if bound.coordinates(self.graph).contains(over) {
            return Err(errors::bound_depends(over, e.span).into());
        }
        match bound {
            Scalar::Number(value) if !value.is_finite() => Err(errors::endless_section(e.span).into()),
            _ => Ok(bound),
        }
    }

    /// The highest value of a scalar over a coordinate between two ends.
    fn section(&mut self, e: Scalar, over: Coordinate, (lo, hi): (NodeId, NodeId), span: Span) -> Lowered<Scalar> {
        match e {
            Scalar::Node(body) if self.graph.coordinates(body).contains(over) => {
                let limit = self.world.limits.program_operations;
                let id = self.graph.section(body, over, (lo, hi), limit).map_err(|r| refused("PROJECT", r, span))?;
                Ok(self.wrap(id))
            }
            // All sections are alike; there is none where the ends are in the wrong order.
            _ => {
                let holds = self.graph.binary(Binary::LessEqual, lo, hi);
                let holds = self.wrap(holds);
                Ok(self.undefined_unless(holds, e))
            }
        }
    }

    /// `OFFSET_BALL(e, d)`
    pub(super) fn offset_ball(&mut self, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [e, d] = arguments else { return Ok(Value::number(f64::NAN)) };
        let value = self.expr(e)?;
        let distance = self.scalar(d, "the distance of OFFSET_BALL")?;
        if let Scalar::Number(d) = distance
            && !d.is_finite()
        {
            return Err(errors::endless_offset(arguments[1].span).into());
        }
        self.each(&value, e.span, &mut |lower, scalar| match scalar {
            Scalar::Number(_) => Ok(scalar),
            Scalar::Node(body) => lower.offset(body, distance, span),
        })
    }

    fn offset(&mut self, body: NodeId, distance: Scalar, span: Span) -> Lowered<Scalar> {
        match distance {
            Scalar::Number(0.0) => Ok(self.wrap(body)),
            Scalar::Number(d) if d > 0.0 => self.grown(body, distance, span),
            Scalar::Number(d) => self.shrunk(body, Scalar::Number(-d), span),
            Scalar::Node(_) => {
                let radius = self.scalars().unary(Unary::Abs, distance);
                let grown = self.grown(body, radius, span)?;
                let shrunk = self.shrunk(body, radius, span)?;
                let mut algebra = self.scalars();
                let zero = Scalar::Number(0.0);
                let outward = algebra.binary(Binary::Less, zero, distance);
                let inward = algebra.binary(Binary::Less, distance, zero);
                let still = algebra.binary(Binary::Equal, distance, zero);
                let plain = algebra.ternary(Ternary::Select, still, Scalar::Node(body), Scalar::Number(f64::NAN));
                let other = algebra.ternary(Ternary::Select, inward, shrunk, plain);
                Ok(algebra.ternary(Ternary::Select, outward, grown, other))
            }
        }
    }

    fn shrunk(&mut self, body: NodeId, radius: Scalar, span: Span) -> Lowered<Scalar> {
        let negative = self.graph.unary(Unary::Neg, body);
        let grown = self.grown(negative, radius, span)?;
        Ok(self.scalars().unary(Unary::Neg, grown))
    }

    /// The highest value in the ball of that radius, in the coordinates that a text can name.
    fn grown(&mut self, body: NodeId, radius: Scalar, span: Span) -> Lowered<Scalar> {
        let over: Vec<Coordinate> =
            self.graph.coordinates(body).iter().filter(|c| usize::from(c.0) <= Coordinate::NAMED).collect();
        let radius = radius.node(self.graph);
        let limit = self.world.limits.program_operations;
        let id = match over[..] {
            [] => body,
            [c] => {
                let centre = self.graph.coordinate(c);
                let lo = self.graph.binary(Binary::Sub, centre, radius);
                let hi = self.graph.binary(Binary::Add, centre, radius);
                self.graph.section(body, c, (lo, hi), limit).map_err(|r| refused("OFFSET_BALL", r, span))?
            }
            _ => self.graph.ball(body, &over, radius, limit).map_err(|r| refused("OFFSET_BALL", r, span))?,
        };
        Ok(self.wrap(id))
    }
}

fn refused(name: &str, why: Refused, span: Span) -> super::Fault {
    errors::refused_search(name, why, span).into()
}
