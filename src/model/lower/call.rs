//! Calls: of the user's functions, of the built-in ones, and of objects at a mapped point.

use std::sync::Arc;

use crate::builtins::{self, Builtin, Meaning};
use crate::source::Span;
use crate::syntax::tree::{Body, CompareOp, Expr, ExprKind, Ident, Name, ParameterKind, Statement, StatementKind};

use super::super::errors;
use super::super::names;
use super::super::value::{Active, Function, LocalFunction, Scalar, Value};
use super::{Fault, Local, Lower, Lowered, Slot};

/// Functions captured within each other, at most so many levels.
const CAPTURES: usize = 100;

impl Lower<'_> {
    pub(super) fn call(&mut self, callee: &Ident, arguments: &[Expr], span: Span) -> Lowered<Value> {
        if let Some(builtin) = builtins::find(&callee.name) {
            return self.call_builtin(builtin, callee, arguments, span);
        }
        let value = match self.own_function(&callee.name) {
            Some(function) => Value::Function(function),
            None => self.name(&callee.name, callee.span)?,
        };
        match &value {
            Value::Function(function) => {
                let values = self.arguments(function, callee, arguments, span)?;
                self.call_function(function, values, span)
            }
            Value::Text(_) => Err(errors::not_callable(&callee.name, &value, callee.span).into()),
            _ if value.coordinates(self.graph).is_empty() => {
                Err(errors::not_callable(&callee.name, &value, callee.span).into())
            }
            _ => match named_coordinates(arguments) {
                Some(named) => self.at_named(&value, &named, span),
                None => self.at_positional(&value, arguments, span),
            },
        }
    }

    /// Inside a function, its own name with parentheses is recursion, also where the name holds the result.
    fn own_function(&self, name: &Name) -> Option<Arc<Function>> {
        let running = self.current_function.last().filter(|f| f.name == *name)?;
        let local = self.locals[self.frame..].iter().rev().find(|l| l.name == *name);
        match local.map(|l| &l.slot) {
            Some(Slot::Is(Value::Function(_))) => None,
            _ => Some(running.clone()),
        }
    }

    fn arguments(
        &mut self,
        function: &Arc<Function>,
        callee: &Ident,
        arguments: &[Expr],
        span: Span,
    ) -> Lowered<Vec<Value>> {
        let parameters = function.parameters();
        if parameters.len() != arguments.len() {
            return Err(errors::wrong_count(&function.signature(), parameters.len(), arguments.len(), span)
                .see(function.statement().span, "defined here")
                .into());
        }
        let mut values = Vec::with_capacity(arguments.len());
        for (parameter, e) in parameters.iter().zip(arguments) {
            let value = self.expr(e)?;
            if let Some((kind, _)) = &parameter.kind
                && !admits(*kind, &value)
            {
                return Err(errors::wrong_kind(&function.signature(), parameter, &value, e.span)
                    .see(callee.span, "")
                    .into());
            }
            values.push(value);
        }
        Ok(values)
    }

    pub(super) fn call_function(&mut self, function: &Arc<Function>, values: Vec<Value>, span: Span) -> Lowered<Value> {
        self.turn(span)?;
        if self.calls >= self.world.limits.call_depth {
            return Err(errors::too_many_calls(&function.name, self.world.limits.call_depth, span).into());
        }
        let (frame, before, warned) = (self.frame, self.locals.len(), self.warnings.len());
        self.frame = before;
        self.calls += 1;
        let system = match &function.local {
            Some(local) => {
                let captured = local.captured.iter();
                self.locals.extend(captured.map(|(name, v)| Local { name: name.clone(), slot: Slot::Is(v.clone()) }));
                local.system.clone()
            }
            None => Active::InForce(function.definition.system.clone()),
        };
        for (parameter, value) in function.parameters().iter().zip(values) {
            self.locals.push(Local { name: parameter.name.name.clone(), slot: Slot::Is(value) });
        }
        let active = std::mem::replace(&mut self.active, system);
        self.current_function.push(function.clone());
        let result = self.run_function(function);
        self.current_function.pop();
        self.active = active;
        self.calls -= 1;
        self.locals.truncate(before);
        self.frame = frame;
        if !span.source.is_on_shelf() {
            self.warnings[warned..].iter_mut().for_each(|told| errors::place_at_call(told, &function.name, span));
        }
        result.map_err(|fault| called_from(fault, &function.name, span))
    }

    fn run_function(&mut self, function: &Arc<Function>) -> Lowered<Value> {
        match &function.statement().kind {
            StatementKind::Define { body: Body::Expression(e), .. } => self.expr(e),
            StatementKind::Define { name, body: Body::Block(block), .. } => self.body(&name.name, name.span, block),
            _ => Err(errors::no_result(&function.name, function.statement().span).into()),
        }
    }

    /// Runs the statements of a body; the value is what they assign to `own`.
    pub(super) fn body(&mut self, own: &Name, place: Span, block: &[Statement]) -> Lowered<Value> {
        let before = self.locals.len();
        let system = self.active.clone();
        for name in names::assigned(block) {
            let parameter =
                self.locals[self.frame..].iter().any(|l| l.name == name) && !self.current_function.is_empty();
            if !parameter {
                self.locals.push(Local { name, slot: Slot::Unset });
            }
        }
        self.block(block)?;
        let value = match self.find_local(own, place) {
            Some(Ok(value)) => value,
            Some(Err(Fault::Follows(told))) => return Err(Fault::Follows(told)),
            _ => return Err(errors::no_result(own, place).into()),
        };
        self.active = system;
        self.locals.truncate(before);
        Ok(value)
    }

    /// A function defined inside a body: keeps the values around it.
    pub(super) fn local_function(&mut self, name: &Name, statement: &Statement) -> Lowered<Value> {
        let mut captured: Vec<(Name, Value)> = Vec::new();
        let mut depth = 0;
        let own = |n: &Name| n == name;
        for local in self.locals[self.frame..].iter().rev() {
            let seen = own(&local.name) || captured.iter().any(|(n, _)| *n == local.name);
            if let (Slot::Is(value), false) = (&local.slot, seen) {
                if let Value::Function(f) = value {
                    depth = depth.max(f.local.as_ref().map_or(0, |l| l.depth + 1));
                }
                captured.push((local.name.clone(), value.clone()));
            }
        }
        if depth > CAPTURES {
            return Err(errors::too_many_calls(name, CAPTURES, statement.span).into());
        }
        let Some(definition) = self.reader().cloned() else {
            return Err(errors::no_result(name, statement.span).into());
        };
        let local =
            LocalFunction { statement: Arc::new(statement.clone()), captured, system: self.active.clone(), depth };
        Ok(Value::Function(Arc::new(Function { definition, name: name.clone(), local: Some(local) })))
    }

    fn call_builtin(
        &mut self,
        builtin: &'static Builtin,
        callee: &Ident,
        arguments: &[Expr],
        span: Span,
    ) -> Lowered<Value> {
        let one_array = matches!(builtin.meaning, Meaning::Fold(_)) && arguments.len() == 1;
        if !one_array && !builtin.arity().admits(arguments.len()) {
            return Err(errors::wrong_builtin_count(builtin, arguments.len(), callee.span.to(span)).into());
        }
        if let Meaning::Special(form) = builtin.meaning {
            return self.special(form, builtin, arguments, span);
        }
        let mut values = Vec::with_capacity(arguments.len());
        for e in arguments {
            values.push(self.expr(e)?);
        }
        if one_array {
            values = match values.pop() {
                Some(Value::Array(array)) if !array.items().is_empty() => array.items().to_vec(),
                Some(other) => return Err(errors::wrong_builtin_kind(builtin, &other, "an array", span).into()),
                None => Vec::new(),
            };
        }
        let spans: Vec<Span> =
            if one_array { vec![span; values.len()] } else { arguments.iter().map(|e| e.span).collect() };
        self.apply(builtin, &values, &spans, span)
    }

    /// A function of numbers; by element where an argument is an array.
    fn apply(&mut self, builtin: &'static Builtin, values: &[Value], spans: &[Span], span: Span) -> Lowered<Value> {
        let mut length = None;
        for (value, at) in values.iter().zip(spans) {
            match value {
                Value::Array(array) => match length {
                    Some((n, _)) if n == array.items().len() => {}
                    Some((n, before)) => return Err(errors::lengths_differ(n, array.items().len(), before, *at).into()),
                    None => length = Some((array.items().len(), *at)),
                },
                Value::Scalar(_) => {}
                other => return Err(errors::wrong_builtin_kind(builtin, other, "a number", *at).into()),
            }
        }
        if let Some((n, _)) = length {
            let mut items = Vec::with_capacity(n);
            for i in 0..n {
                let row: Vec<Value> = values
                    .iter()
                    .map(|v| match v {
                        Value::Array(array) => array.items()[i].clone(),
                        other => other.clone(),
                    })
                    .collect();
                items.push(self.apply(builtin, &row, spans, span)?);
            }
            return self.array(items, span);
        }
        let scalars: Vec<Scalar> = values
            .iter()
            .filter_map(|v| match v {
                Value::Scalar(s) => Some(*s),
                _ => None,
            })
            .collect();
        let result = match builtin.apply(&mut self.scalars(), &scalars) {
            Ok(Some(result)) => result,
            Ok(None) | Err(_) => return Err(errors::wrong_builtin_count(builtin, values.len(), span).into()),
        };
        errors::check_defined(&scalars, result, || errors::applied(builtin.name, &scalars), span)?;
        Ok(Value::Scalar(result))
    }
}

fn admits(kind: ParameterKind, value: &Value) -> bool {
    matches!(
        (kind, value),
        (ParameterKind::Scalar, Value::Scalar(_))
            | (ParameterKind::Array, Value::Array(_))
            | (ParameterKind::Text, Value::Text(_))
            | (ParameterKind::Function, Value::Function(_))
    )
}

/// `n(x4 = 0.5)` names coordinates; the parser cannot know that n is an object and reads comparisons.
fn named_coordinates(arguments: &[Expr]) -> Option<Vec<(u8, Span, &Expr)>> {
    let named = |e: &'_ Expr| -> Option<u8> {
        match &e.kind {
            ExprKind::Setting { name, .. } => super::super::environment::coordinate(&name.name),
            ExprKind::Compare { first, rest } => match (&first.kind, &rest[..]) {
                (ExprKind::Coordinate(c), [(CompareOp::Equal, _, _)]) => Some(*c),
                _ => None,
            },
            _ => None,
        }
    };
    let all: Option<Vec<_>> = arguments
        .iter()
        .map(|e| {
            let c = named(e)?;
            match &e.kind {
                ExprKind::Setting { name, value } => Some((c, name.span, &**value)),
                ExprKind::Compare { first, rest } => Some((c, first.span, &rest[0].2)),
                _ => None,
            }
        })
        .collect();
    all.filter(|all| !all.is_empty())
}

/// An error inside a function shows the call that led there; long ways are cut. One inside the library stands where the user called it.
fn called_from(fault: Fault, name: &str, span: Span) -> Fault {
    match fault {
        Fault::Told(mut told) if !span.source.is_on_shelf() && errors::is_in_library(&told) => {
            errors::place_at_call(&mut told, name, span);
            Fault::Told(told)
        }
        Fault::Told(told) if told.labels.len() < 3 && told.labels.iter().all(|l| l.span != span) => {
            Fault::Told(Box::new(told.see(span, "called here")))
        }
        other => other,
    }
}
