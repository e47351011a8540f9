//! Statements of the oracle: what a script or a body binds.

use std::cell::RefCell;
use std::rc::Rc;

use super::{Answer, Beyond, Binding, Function, Later, Node, Oracle, Point, Scope, Source, System, Value};
use crate::syntax::tree::{Body, Expr, ExprKind, Mapping, Name, Parameter, Statement, StatementKind};

/// Turns after which the oracle gives up on a loop.
const TURNS: usize = 1_000_000;

/// Reads the statements of a script, in order, into the oracle's table of names.
pub(super) fn collect(oracle: &mut Oracle, statements: &[Statement]) {
    let mut system = System::Alpha(None);
    for statement in statements {
        match &statement.kind {
            StatementKind::Define { name, parameters: None, body: Body::Expression(e), .. } => {
                choose(&mut system, &name.name, e);
                let scope =
                    if reads(e, &name.name) { own(oracle, &name.name, Scope::default()) } else { Scope::default() };
                let source = Source::Expr(Rc::new(e.clone()));
                oracle.names.insert(name.name.clone(), later(source, &scope, &system));
            }
            StatementKind::Define { name, parameters, body, .. } => {
                let f = function(&name.name, parameters.as_deref(), body, &Scope::default(), &system);
                oracle.names.insert(name.name.clone(), f);
            }
            StatementKind::Element { name, indices, value } => {
                let base = oracle.names.get(&name.name).cloned().unwrap_or(Binding::Nothing);
                let source = Source::Element { base, indices: indices.clone(), value: Rc::new(value.clone()) };
                let scope = own(oracle, &name.name, Scope::default());
                oracle.names.insert(name.name.clone(), later(source, &scope, &system));
            }
            StatementKind::If { .. } | StatementKind::While { .. } | StatementKind::For { .. } => {
                node(oracle, statement, &system);
            }
            StatementKind::Expression(e) => {
                let source = Source::Expr(Rc::new(e.clone()));
                oracle.last_expression = Some(later(source, &Scope::default(), &system));
            }
            _ => {}
        }
    }
}

fn choose(system: &mut System, name: &str, e: &Expr) {
    match name {
        "r_alpha" => *system = System::Alpha(Some(Rc::new(e.clone()))),
        "r_m" if e.kind == ExprKind::Number(0.0) => *system = System::Alpha(None),
        "r_m" => *system = System::Smooth(Some(Rc::new(e.clone()))),
        _ => {}
    }
}

fn own(oracle: &Oracle, name: &Name, scope: Scope) -> Scope {
    scope.with(name, oracle.names.get(name).cloned().unwrap_or(Binding::Nothing))
}

fn later(source: Source, scope: &Scope, system: &System) -> Binding {
    let later = Later { source, scope: scope.clone(), system: system.clone(), last: RefCell::new(None) };
    Binding::Later(Rc::new(later))
}

fn function(name: &Name, parameters: Option<&[Parameter]>, body: &Body, scope: &Scope, system: &System) -> Binding {
    let parameters = parameters.unwrap_or(&[]).iter().map(|p| p.name.name.clone()).collect();
    let body = Rc::new(body.clone());
    Binding::Function(Rc::new(Function {
        name: name.clone(),
        parameters,
        body,
        scope: scope.clone(),
        system: system.clone(),
    }))
}

fn node(oracle: &mut Oracle, statement: &Statement, system: &System) {
    let mut names = Vec::new();
    assigned(std::slice::from_ref(statement), &mut names);
    let start = names.iter().fold(Scope::default(), |scope, n| own(oracle, n, scope));
    let statement = Rc::new(statement.clone());
    for name in names {
        let node =
            Node { statement: statement.clone(), name: name.clone(), start: start.clone(), system: system.clone() };
        oracle.names.insert(name, Binding::Node(Rc::new(node)));
    }
}

/// Adds the names that statements assign, each once, in order of appearance; a FOR's index is its own.
fn assigned(statements: &[Statement], names: &mut Vec<Name>) {
    for statement in statements {
        let mut inner = Vec::new();
        match &statement.kind {
            StatementKind::Define { name, .. } | StatementKind::Element { name, .. } => inner.push(name.name.clone()),
            StatementKind::If { then, otherwise, .. } => {
                assigned(then, &mut inner);
                assigned(otherwise.as_deref().unwrap_or(&[]), &mut inner);
            }
            StatementKind::While { body, .. } => assigned(body, &mut inner),
            StatementKind::For { body, index, .. } => {
                assigned(body, &mut inner);
                inner.retain(|n| *n != index.name);
            }
            _ => {}
        }
        for name in inner {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
}

impl Oracle {
    /// The bindings after the statements of a body, loop or branch have run at a point.
    pub(super) fn run<S: std::borrow::Borrow<Statement>>(
        &self,
        statements: &[S],
        scope: &Scope,
        system: &System,
        point: &Point,
    ) -> Answer<Scope> {
        let mut scope = scope.clone();
        let mut system = system.clone();
        for statement in statements {
            scope = self.step(statement.borrow(), scope, &mut system, point)?;
        }
        Ok(scope)
    }

    fn step(&self, statement: &Statement, scope: Scope, system: &mut System, point: &Point) -> Answer<Scope> {
        match &statement.kind {
            StatementKind::Define { name, parameters: None, body: Body::Expression(e), .. } => {
                choose(system, &name.name, e);
                let source = Source::Expr(Rc::new(e.clone()));
                Ok(scope.with(&name.name, self.settle(later(source, &scope, system))))
            }
            StatementKind::Define { name, parameters, body, .. } => {
                Ok(scope.with(&name.name, function(&name.name, parameters.as_deref(), body, &scope, system)))
            }
            StatementKind::Element { name, indices, value } => {
                let base = self.binding(&name.name, &scope).unwrap_or(Binding::Nothing);
                let indices = self.indices(indices, &scope, system, point)?;
                let constants = indices.iter().map(|&i| number_at(i, statement)).collect();
                let source = Source::Element { base, indices: constants, value: Rc::new(value.clone()) };
                Ok(scope.with(&name.name, self.settle(later(source, &scope, system))))
            }
            StatementKind::If { condition, then, otherwise } => {
                let branch = if self.holds(condition, &scope, system, point)? {
                    then
                } else {
                    otherwise.as_ref().unwrap_or(const { &Vec::new() })
                };
                self.run(branch, &scope, system, point)
            }
            StatementKind::While { condition, body } => self.turns(condition, body, scope, system, point),
            StatementKind::For { index, from, to, step, body } => {
                let a = self.number(from, &scope, system, point)?;
                let b = self.number(to, &scope, system, point)?;
                let k = step.as_ref().map_or(Ok(1.0), |s| self.number(s, &scope, system, point))?;
                self.count(&index.name, (a, b, k), body, scope, (system, point))
            }
            _ => Ok(scope),
        }
    }

    fn turns(
        &self,
        condition: &Expr,
        body: &[Statement],
        mut scope: Scope,
        system: &System,
        point: &Point,
    ) -> Answer<Scope> {
        for _ in 0..TURNS {
            if !self.holds(condition, &scope, system, point)? {
                return Ok(scope);
            }
            scope = self.run(body, &scope, system, point)?;
        }
        Err(Beyond::Unknown("a loop that does not end".into()))
    }

    fn count(
        &self,
        index: &Name,
        (a, b, k): (f64, f64, f64),
        body: &[Statement],
        mut scope: Scope,
        (system, point): (&System, &Point),
    ) -> Answer<Scope> {
        let before = scope.find(index).cloned();
        let mut turn = 0.0;
        while (k > 0.0 && a + turn * k <= b) || (k < 0.0 && a + turn * k >= b) {
            scope = scope.with(index, Binding::Known(Value::Number(a + turn * k)));
            scope = self.run(body, &scope, system, point)?;
            turn += 1.0;
        }
        Ok(match before {
            Some(binding) => scope.with(index, binding),
            None => scope.with(index, self.names.get(index).cloned().unwrap_or(Binding::Nothing)),
        })
    }

    /// A binding that depends on no coordinate becomes its value, so that counters do not grow chains.
    fn settle(&self, binding: Binding) -> Binding {
        match self.force(&binding, &None) {
            Ok(value) => Binding::Known(value),
            Err(_) => binding,
        }
    }

    /// What a name is bound to, here or at the top.
    pub(super) fn binding(&self, name: &str, scope: &Scope) -> Option<Binding> {
        scope.find(name).or_else(|| self.names.get(name)).cloned()
    }

    /// Whole numbers from 1 for indexing.
    pub(super) fn indices(
        &self,
        indices: &[Expr],
        scope: &Scope,
        system: &System,
        point: &Point,
    ) -> Answer<Vec<usize>> {
        indices.iter().map(|e| self.number(e, scope, system, point).map(|i| i as usize)).collect()
    }

    fn holds(&self, condition: &Expr, scope: &Scope, system: &System, point: &Point) -> Answer<bool> {
        let c = self.number(condition, scope, system, point)?;
        Ok(c != 0.0 && !c.is_nan())
    }
}

fn number_at(i: usize, statement: &Statement) -> Expr {
    Expr { kind: ExprKind::Number(i as f64), span: statement.span }
}

/// Whether an expression mentions a name.
fn reads(e: &Expr, name: &str) -> bool {
    let any = |list: &[Expr]| list.iter().any(|e| reads(e, name));
    match &e.kind {
        ExprKind::Name(n) => &**n == name,
        ExprKind::Number(_) | ExprKind::Text(_) | ExprKind::Coordinate(_) | ExprKind::Pi | ExprKind::Infinity => false,
        ExprKind::Array(list) => any(list),
        ExprKind::Paren(e) | ExprKind::Prefix { operand: e, .. } | ExprKind::Setting { value: e, .. } => reads(e, name),
        ExprKind::Chain { first, rest } => reads(first, name) || rest.iter().any(|(_, _, e)| reads(e, name)),
        ExprKind::Compare { first, rest } => reads(first, name) || rest.iter().any(|(_, _, e)| reads(e, name)),
        ExprKind::Power { base, exponent } => reads(base, name) || reads(exponent, name),
        ExprKind::Index { base, indices } => reads(base, name) || any(indices),
        ExprKind::Call { callee, arguments } => &*callee.name == name || any(arguments),
        ExprKind::Fold { index, from, to, body, .. } => {
            reads(from, name) || reads(to, name) || (&*index.name != name && reads(body, name))
        }
        ExprKind::At { body, mapping: Mapping::Positional(list) } => reads(body, name) || any(list),
        ExprKind::At { body, mapping: Mapping::Named(list) } => {
            reads(body, name) || list.iter().any(|(_, _, e)| reads(e, name))
        }
        ExprKind::If { condition, then, otherwise } => {
            reads(condition, name) || reads(then, name) || otherwise.as_ref().is_some_and(|e| reads(e, name))
        }
        ExprKind::Where { body, bindings } => {
            bindings.iter().any(|(_, e)| reads(e, name))
                || (bindings.iter().all(|(n, _)| &*n.name != name) && reads(body, name))
        }
    }
}
