//! FIT: the residual of the user's function becomes nodes of variables that nothing names, derived by each parameter and compiled; the
//! search itself is in `number`.

use crate::builtins::Builtin;
use crate::diagnostic::Diagnostic;
use crate::field::{self, Coordinate, NodeId};
use crate::number::fit::{Residuals, Unfit, least_squares};
use crate::source::Span;
use crate::syntax::tree::Expr;
use crate::vm::{Demand, Points, Program};

use super::super::errors;
use super::super::value::{self, Value};
use super::{Fault, Lower, Lowered};

/// One residual and its derivatives, as programs of the parameters and the point.
struct Compiled {
    value: Program,
    slopes: Vec<Program>,
}

impl Lower<'_> {
    /// `FIT(residual, start, points)`
    pub(super) fn fit(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [residual, start_at, points_at] = arguments else { return Ok(Value::number(f64::NAN)) };
        let start = self.numbers(builtin, start_at)?;
        let points = self.rows(builtin, points_at)?;
        if start.is_empty() {
            return Err(errors::wrong_builtin_shape(builtin, "an array of numbers, one or more", start_at.span).into());
        }
        let width = points.first().map_or(0, Vec::len);
        let bad = points.iter().position(|row| !row.iter().all(|c| c.is_finite()));
        if let Some(bad) = bad {
            let title = format!("point {} of FIT is not finite", bad + 1);
            return Err(Diagnostic::error("bad-fit", title).at(points_at.span, "").help("leave it out").into());
        }
        let (n, from) = (start.len(), self.variables);
        if usize::from(from) + n + width > Coordinate::MOST {
            return Err(errors::too_many_variables(span).into());
        }
        #[allow(clippy::cast_possible_truncation)]
        let inputs: Vec<Coordinate> = (1..=(n + width) as u8).map(|k| Coordinate(from + k)).collect();
        self.variables = inputs[n + width - 1].0;
        let compiled = self.compiled(builtin, residual, &inputs, n);
        self.variables = from;
        let compiled = compiled?;
        let count = compiled.len() * points.len();
        if count < n {
            let title = format!("{n} parameters cannot be found from {count} residuals");
            return Err(Diagnostic::error("bad-fit", title)
                .at(points_at.span, "")
                .help("give at least as many points as there are parameters")
                .into());
        }
        let columns: Vec<Vec<f64>> = (0..width).map(|k| points.iter().map(|row| row[k]).collect()).collect();
        let mut evaluator = Points::heeding(self.world.interrupt);
        let found = least_squares(start, |at| {
            self.world.interrupt.tick()?;
            Ok::<_, Fault>(residuals(&compiled, at, &columns, &mut evaluator))
        })?;
        match found {
            Ok(parameters) => {
                let items = parameters.into_iter().map(Value::number).collect();
                self.array(items, span)
            }
            Err(why) => Err(unfit(&why, points.len(), residual.span, start_at.span).into()),
        }
    }

    /// The residuals as programs, the first `n` inputs of which are the parameters.
    fn compiled(&mut self, builtin: &Builtin, e: &Expr, inputs: &[Coordinate], n: usize) -> Lowered<Vec<Compiled>> {
        let Value::Function(function) = self.expr(e)? else {
            return Err(errors::wrong_builtin_shape(builtin, "a function of the parameters and a point", e.span).into());
        };
        if function.parameters().len() != 2 {
            return Err(errors::wrong_count(&function.signature(), function.parameters().len(), 2, e.span)
                .see(function.statement().span, "defined here")
                .into());
        }
        let array = |lower: &mut Self, part: &[Coordinate]| {
            let items = part.iter().map(|c| lower.coordinate(c.0)).collect();
            lower.array(items, e.span)
        };
        let (parameters, point) = (array(self, &inputs[..n])?, array(self, &inputs[n..])?);
        let value = self.call_function(&function, vec![parameters, point], e.span)?;
        let nodes: Vec<NodeId> = match &value {
            Value::Scalar(scalar) => vec![scalar.node(self.graph)],
            Value::Array(items) => {
                let node = |lower: &mut Self, item: &Value| match item {
                    Value::Scalar(scalar) => Ok(scalar.node(lower.graph)),
                    _ => Err(errors::wrong_builtin_shape(
                        builtin,
                        "a function whose value is a number or an array of numbers",
                        e.span,
                    )),
                };
                items.items().iter().map(|item| node(self, item)).collect::<Result<_, _>>()?
            }
            _ => {
                let shape = "a function whose value is a number or an array of numbers";
                return Err(errors::wrong_builtin_shape(builtin, shape, e.span).into());
            }
        };
        nodes.into_iter().map(|node| self.compiled_one(node, e.span, inputs, n)).collect()
    }

    fn compiled_one(&mut self, node: NodeId, span: Span, inputs: &[Coordinate], n: usize) -> Lowered<Compiled> {
        if let Some(free) = self.graph.coordinates(node).iter().find(|c| !inputs.contains(c)) {
            let title = format!("the residual depends on {free}, which has no value here");
            return Err(Diagnostic::error("bad-fit", title)
                .at(span, "")
                .help("take objects at the point: `residual(q, p) = gob_a AT (p)`")
                .into());
        }
        let slopes: Vec<NodeId> = inputs[..n].iter().map(|c| field::derivative(self.graph, node, *c)).collect();
        let compile = |node| {
            Program::compile(self.graph, node, inputs, Demand::Value, self.world.limits).map_err(|_| {
                let title = "the residual is too long to be compiled";
                Diagnostic::error("bad-fit", title).at(span, "").help("make it of fewer operations")
            })
        };
        Ok(Compiled { value: compile(node)?, slopes: slopes.into_iter().map(compile).collect::<Result<_, _>>()? })
    }
}

fn residuals(compiled: &[Compiled], at: &[f64], columns: &[Vec<f64>], evaluator: &mut Points<f64>) -> Residuals {
    let count = columns.first().map_or(0, Vec::len);
    let parameters: Vec<Vec<f64>> = at.iter().map(|p| vec![*p; count]).collect();
    let slices: Vec<&[f64]> = parameters.iter().chain(columns).map(Vec::as_slice).collect();
    let mut all = Residuals { values: Vec::new(), slopes: vec![Vec::new(); at.len()] };
    let mut add = |program: &Program, to: &mut Vec<f64>| {
        let first = to.len();
        to.resize(first + count, 0.0);
        evaluator.eval(program, &slices, &mut to[first..]);
    };
    for one in compiled {
        add(&one.value, &mut all.values);
        one.slopes.iter().zip(&mut all.slopes).for_each(|(program, to)| add(program, to));
    }
    all
}

fn unfit(why: &Unfit, points: usize, residual: Span, start: Span) -> Diagnostic {
    match why {
        Unfit::Undefined(at) => {
            let title =
                format!("the residual or its derivative is not finite at the start, at point {}", at % points + 1);
            Diagnostic::error("bad-fit", title)
                .at(residual, "")
                .see(start, "from here")
                .help("start elsewhere, or leave out points at which the function has no derivative")
        }
        Unfit::Idle(parameter) => {
            let title = format!("the residual does not depend on parameter {} at the start", parameter + 1);
            Diagnostic::error("bad-fit", title)
                .at(residual, "")
                .see(start, "from here")
                .help("start where a small change of each parameter makes a difference, or take that parameter away")
        }
        Unfit::Diverges(at, mean) => {
            let at: Vec<String> = at.iter().map(|p| value::number(*p)).collect();
            let mean = value::number(*mean);
            let title =
                format!("FIT found no least: it ended at [{}], with residuals of {mean} in the mean", at.join(", "));
            Diagnostic::error("no-fit", title)
                .at(residual, "")
                .see(start, "from here")
                .help("start nearer to what is sought, or use a smoother residual or fewer parameters")
        }
    }
}
