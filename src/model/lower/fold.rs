//! Folds over an index or an array, derivatives, and the table of the special forms.

use crate::builtins::{Builtin, Special};
use crate::field::{self, Coordinate};
use crate::number::{Algebra, Binary};
use crate::source::Span;
use crate::syntax::tree::{Expr, ExprKind, FoldOp, Ident, Name};

use super::super::errors;
use super::super::value::{Scalar, Value};
use super::{Lower, Lowered};

impl Lower<'_> {
    /// `SUM(i = a TO b, body)` and its like.
    pub(super) fn fold(
        &mut self,
        op: FoldOp,
        index: &Ident,
        (from, to): (&Expr, &Expr),
        body: &Expr,
        span: Span,
    ) -> Lowered<Value> {
        let first = self.number(from, "the first value of an index")?;
        let last = self.number(to, "the last value of an index")?;
        if !first.is_finite() || !last.is_finite() {
            return Err(errors::endless(span).into());
        }
        let mut values = Vec::new();
        let mut folded: Option<Value> = None;
        let mut i = first;
        while i <= last {
            self.turn(span)?;
            let value = self.let_in(&index.name, Value::number(i), |lower| lower.expr(body))?;
            if op == FoldOp::Array {
                values.push(value);
                if values.len() > self.world.limits.array_elements {
                    return Err(errors::array_too_large(self.world.limits.array_elements, span).into());
                }
            } else {
                folded = Some(match folded {
                    None => self.first_of(op, value, body.span)?,
                    Some(before) => self.fold_step(op, &before, &value, body.span)?,
                });
            }
            i += 1.0;
        }
        if op == FoldOp::Array {
            return if values.is_empty() { Err(errors::empty_fold(op, span).into()) } else { self.array(values, span) };
        }
        folded.map_or_else(|| empty(op, span), Ok)
    }

    /// `SUM(a)` and its like.
    fn fold_array(&mut self, op: FoldOp, builtin: &Builtin, e: &Expr, span: Span) -> Lowered<Value> {
        let value = self.expr(e)?;
        let Value::Array(array) = &value else {
            return Err(errors::wrong_builtin_kind(builtin, &value, "an array", e.span).into());
        };
        let mut folded: Option<Value> = None;
        for item in array.items() {
            folded = Some(match folded {
                None => self.first_of(op, item.clone(), e.span)?,
                Some(before) => self.fold_step(op, &before, item, e.span)?,
            });
        }
        folded.map_or_else(|| empty(op, span), Ok)
    }

    fn first_of(&mut self, op: FoldOp, value: Value, span: Span) -> Lowered<Value> {
        match (&value, op) {
            (Value::Scalar(_), _) | (Value::Array(_), FoldOp::Sum | FoldOp::Product) => Ok(value),
            _ => Err(errors::needs_scalar(errors::folded(op), &value, span).into()),
        }
    }

    fn fold_step(&mut self, op: FoldOp, a: &Value, b: &Value, span: Span) -> Lowered<Value> {
        let arithmetic = match op {
            FoldOp::Sum => Binary::Add,
            FoldOp::Product => Binary::Mul,
            _ => {
                let a = self.as_scalar(a, span, errors::folded(op))?;
                let b = self.as_scalar(b, span, errors::folded(op))?;
                return Ok(Value::Scalar(match op {
                    FoldOp::Union => self.union(a, b, span)?,
                    FoldOp::Intersection => self.intersection(a, b, span)?,
                    FoldOp::Minimum => self.scalars().binary(Binary::Min, a, b),
                    _ => self.scalars().binary(Binary::Max, a, b),
                }));
            }
        };
        self.arithmetic(arithmetic, a, b, span, span)
    }

    /// The built-ins whose arguments are more than numbers; their number is right already.
    pub(super) fn special(
        &mut self,
        form: Special,
        builtin: &'static Builtin,
        arguments: &[Expr],
        span: Span,
    ) -> Lowered<Value> {
        let op = match form {
            Special::Sum => FoldOp::Sum,
            Special::Product => FoldOp::Product,
            Special::Union => FoldOp::Union,
            Special::Intersection => FoldOp::Intersection,
            Special::Minimum => FoldOp::Minimum,
            Special::Maximum => FoldOp::Maximum,
            Special::Array => return Err(errors::array_needs_index(builtin, span).into()),
            Special::Join | Special::Len | Special::Dot | Special::Cross | Special::Norm => {
                return self.vectors(form, builtin, arguments, span);
            }
            Special::Star => return self.star(builtin, arguments, span),
            Special::PNorm => return self.p_norm(builtin, arguments, span),
            Special::Random => return self.random(builtin, arguments),
            Special::Diff => return self.diff(&arguments[0], &arguments[1]),
            Special::Grad => return self.grad(&arguments[0], span),
            Special::Project => return self.project(arguments, span),
            Special::OffsetBall => return self.offset_ball(arguments, span),
            Special::Polygon => return self.polygon(builtin, arguments, span),
            Special::Contours => return self.contours(builtin, arguments, span),
            Special::Medial => return self.medial(builtin, arguments, span),
            Special::Interpolate => return self.interpolate(builtin, arguments, span),
            Special::Question(question) => return self.question(question, arguments, span),
            Special::Mesh => return self.mesh(builtin, arguments, span),
            Special::Scatter => return self.scatter(builtin, arguments, span),
            Special::Height => return self.height(arguments),
            Special::Fit => return self.fit(builtin, arguments, span),
        };
        self.fold_array(op, builtin, &arguments[0], span)
    }

    fn diff(&mut self, e: &Expr, by: &Expr) -> Lowered<Value> {
        match &by.kind {
            ExprKind::Coordinate(c) => {
                let value = self.expr(e)?;
                self.slope(&value, Coordinate(*c), e.span)
            }
            ExprKind::Name(name) => self.diff_by_name(e, name, by.span),
            _ => Err(errors::bad_variable(by.span).into()),
        }
    }

    fn slope(&mut self, value: &Value, by: Coordinate, span: Span) -> Lowered<Value> {
        self.each(value, span, &mut |lower, s| match s {
            Scalar::Number(_) => Ok(Scalar::Number(0.0)),
            Scalar::Node(id) => {
                let slope = field::derivative(lower.graph, id, by);
                Ok(lower.wrap(slope))
            }
        })
    }

    fn grad(&mut self, e: &Expr, span: Span) -> Lowered<Value> {
        let value = self.scalar(e, "the argument of GRAD")?;
        let named = value.coordinates(self.graph).iter().filter(|c| usize::from(c.0) <= Coordinate::NAMED).last();
        let highest = named.ok_or_else(|| errors::no_coordinates("GRAD", e.span))?;
        let mut items = Vec::new();
        for c in 1..=highest.0 {
            items.push(self.slope(&Value::Scalar(value), Coordinate(c), e.span)?);
        }
        self.array(items, span)
    }

    /// The derivative by a parameter: the parameter becomes a coordinate that nothing names, and its value is put back afterwards.
    fn diff_by_name(&mut self, e: &Expr, name: &Name, span: Span) -> Lowered<Value> {
        let value = self.name(name, span)?;
        let value = self.as_scalar(&value, span, "the variable of DIFF")?;
        let Some(spare) = self.variables.checked_add(1).filter(|c| usize::from(*c) <= Coordinate::MOST) else {
            return Err(errors::too_many_variables(span).into());
        };
        self.variables = spare;
        let slope = self.diff_by_stand_in(e, name, Coordinate(spare));
        self.variables = spare - 1;
        let slope = slope?;
        let back = value.node(self.graph);
        self.each(&slope, span, &mut |lower, s| match s {
            Scalar::Number(_) => Ok(s),
            Scalar::Node(id) => {
                let id = lower.graph.map(id, &[(Coordinate(spare), back)]);
                Ok(lower.wrap(id))
            }
        })
    }

    fn diff_by_stand_in(&mut self, e: &Expr, name: &Name, spare: Coordinate) -> Lowered<Value> {
        let stand_in = self.coordinate(spare.0);
        let result = if self.locals[self.frame..].iter().any(|l| l.name == *name) {
            self.let_in(name, stand_in, |lower| lower.expr(e))?
        } else {
            self.with_definition_as(name, stand_in, e)?
        };
        self.slope(&result, spare, e.span)
    }

    /// The value of `e` if a definition had another value; everything is as before afterwards.
    fn with_definition_as(&mut self, name: &Name, value: Value, e: &Expr) -> Lowered<Value> {
        let Some(definition) = self.state.get(name).cloned() else {
            return self.expr(e);
        };
        let moment = self.state.moment();
        let (lowered, stale) = (self.lowered.len(), self.state.stale_len());
        self.state.invalidate(name);
        let kept = super::super::state::Kept::with(&definition, name, value);
        self.state.keep(definition.id, kept);
        let mut result = Ok(());
        for (read, _) in super::super::names::of_expression(e).reads {
            if let (Some(read), Ok(())) = (self.state.get(&read).cloned(), &result) {
                result = self.ensure(&read);
            }
        }
        let value = result.and_then(|()| self.expr(e));
        self.state.restore(moment);
        self.state.stale_truncate(stale);
        self.lowered.truncate(lowered);
        value
    }
}

fn empty(op: FoldOp, span: Span) -> Lowered<Value> {
    match op {
        FoldOp::Sum => Ok(Value::number(0.0)),
        FoldOp::Product => Ok(Value::number(1.0)),
        _ => Err(errors::empty_fold(op, span).into()),
    }
}
