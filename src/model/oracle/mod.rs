//! The tree oracle: walks the tree of a whole script with plain arithmetic at one point. Slow and obvious, it shares nothing with the
//! lowering, the expression graph or the compiler, so that it can say when they are wrong.
//!
//! It never reports errors well: it is asked only about scripts that the session has accepted. Data (INTERPOLATE) and searches
//! are beyond it and give [`Beyond`].

mod call;
mod expr;
mod run;

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;

use crate::syntax::tree::{Body, Expr, Name, Statement};

/// Why the oracle has no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Beyond {
    /// The value depends on a coordinate and no point was given.
    NeedsPoint,
    /// A form that the oracle does not know, or a wrong program.
    Unknown(String),
}

/// A value at one point.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// An array.
    Array(Vec<Value>),
    /// A text.
    Text(String),
}

/// The outcome of evaluating something.
pub type Answer<T = Value> = Result<T, Beyond>;

/// The point at which everything is evaluated: x1 ... x16, or none for what must not depend on one.
type Point = Option<Rc<[f64; 16]>>;

/// What a name is bound to in an environment.
#[derive(Clone)]
enum Binding {
    /// A value that depends on no coordinate.
    Known(Value),
    /// An expression, still to be evaluated at whatever point is current: names stand for objects.
    Later(Rc<Later>),
    /// A user's function, passed as an argument.
    Function(Rc<Function>),
    /// A loop or IF statement, for one of the names that it assigns.
    Node(Rc<Node>),
    /// Nothing yet: a name of a body that is read before it is assigned.
    Nothing,
}

/// An expression with what its names mean, remembered at the last point.
struct Later {
    source: Source,
    scope: Scope,
    system: System,
    last: RefCell<Option<(Point, Value)>>,
}

/// An expression of the tree, or an element put into an array.
enum Source {
    Expr(Rc<Expr>),
    Element { base: Binding, indices: Vec<Expr>, value: Rc<Expr> },
}

/// A statement that is run when one of its names is asked for.
struct Node {
    statement: Rc<Statement>,
    name: Name,
    start: Scope,
    system: System,
}

/// A chain of bindings, the newest first.
#[derive(Clone, Default)]
struct Scope(Option<Rc<Frame>>);

struct Frame {
    name: Name,
    binding: Binding,
    outer: Scope,
}

impl Scope {
    fn with(&self, name: &Name, binding: Binding) -> Self {
        Self(Some(Rc::new(Frame { name: name.clone(), binding, outer: self.clone() })))
    }

    fn find(&self, name: &str) -> Option<&Binding> {
        let mut at = self;
        while let Some(frame) = &at.0 {
            if &*frame.name == name {
                return Some(&frame.binding);
            }
            at = &frame.outer;
        }
        None
    }
}

impl Drop for Frame {
    /// A loop of many turns makes a long chain: it is taken apart link by link, not by recursion.
    fn drop(&mut self) {
        let mut next = self.outer.0.take();
        while let Some(frame) = next {
            match Rc::try_unwrap(frame) {
                Ok(mut last) => next = last.outer.0.take(),
                Err(_) => break,
            }
        }
    }
}

/// The system of R-functions in force: `r_alpha` as an expression, or `r_m`.
#[derive(Clone)]
enum System {
    Alpha(Option<Rc<Expr>>),
    Smooth(Option<Rc<Expr>>),
}

struct Function {
    name: Name,
    parameters: Vec<Name>,
    body: Rc<Body>,
    scope: Scope,
    system: System,
}

/// A script, ready to be asked for the values of its names.
pub struct Oracle {
    names: HashMap<Name, Binding>,
    depth: Cell<usize>,
    last_expression: Option<Binding>,
}

impl Oracle {
    /// Reads the definitions of a script. Loops and IF statements run when a name that they assign is asked for.
    #[must_use]
    pub fn new(statements: &[Statement]) -> Self {
        let mut oracle = Self { names: HashMap::new(), depth: Cell::new(0), last_expression: None };
        run::collect(&mut oracle, statements);
        oracle
    }

    /// The value of a name at a point; coordinates beyond the slice are 0.
    ///
    /// # Errors
    /// [`Beyond`] where the oracle has no answer.
    pub fn value(&self, name: &str, point: &[f64]) -> Answer {
        let mut all = [0.0; 16];
        all[..point.len()].copy_from_slice(point);
        self.name(name, &Some(Rc::new(all)))
    }

    /// The value of the script's last bare expression at a point.
    ///
    /// # Errors
    /// [`Beyond`] where the oracle has no answer.
    pub fn last(&self, point: &[f64]) -> Answer {
        let mut all = [0.0; 16];
        all[..point.len()].copy_from_slice(point);
        match &self.last_expression {
            Some(binding) => self.force(binding, &Some(Rc::new(all))),
            None => Err(Beyond::Unknown("no expression".into())),
        }
    }

    fn name(&self, name: &str, point: &Point) -> Answer {
        match self.names.get(name) {
            Some(binding) => self.force(binding, point),
            None => Err(Beyond::Unknown(format!("name {name}"))),
        }
    }

    fn force(&self, binding: &Binding, point: &Point) -> Answer {
        match binding {
            Binding::Known(value) => Ok(value.clone()),
            Binding::Later(later) => self.deeper(|| self.later(later, point)),
            Binding::Node(node) => self.deeper(|| {
                let end = self.run(std::slice::from_ref(&node.statement), &node.start, &node.system, point)?;
                self.force(end.find(&node.name).unwrap_or(&Binding::Nothing), point)
            }),
            Binding::Function(f) => Err(Beyond::Unknown(format!("function {} as a value", f.name))),
            Binding::Nothing => Err(Beyond::Unknown("a name read before it is assigned".into())),
        }
    }

    fn later(&self, later: &Later, point: &Point) -> Answer {
        if let Some((at, value)) = &*later.last.borrow()
            && same(at, point)
        {
            return Ok(value.clone());
        }
        let value = match &later.source {
            Source::Expr(e) => self.expr(e, &later.scope, &later.system, point)?,
            Source::Element { base, indices, value } => {
                let old = match base {
                    Binding::Nothing => Value::Array(Vec::new()),
                    base => self.force(base, point)?,
                };
                let at = self.indices(indices, &later.scope, &later.system, point)?;
                replace(old, &at, self.expr(value, &later.scope, &later.system, point)?)?
            }
        };
        *later.last.borrow_mut() = Some((point.clone(), value.clone()));
        Ok(value)
    }

    /// Runs `work` one level deeper, refusing to run out of stack.
    fn deeper<T>(&self, work: impl FnOnce() -> Answer<T>) -> Answer<T> {
        self.depth.set(self.depth.get() + 1);
        let answer = if self.depth.get() > 4_000 { Err(Beyond::Unknown("depth".into())) } else { work() };
        self.depth.set(self.depth.get() - 1);
        answer
    }
}

fn same(a: &Point, b: &Point) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => Rc::ptr_eq(a, b),
        (None, None) => true,
        _ => false,
    }
}

/// The array with the element at `indices` (from 1) replaced.
fn replace(old: Value, indices: &[usize], new: Value) -> Answer {
    let (Value::Array(mut elements), Some((&first, rest))) = (old, indices.split_first()) else {
        return Err(Beyond::Unknown("an element of what is no array".into()));
    };
    let place = elements.get_mut(first.wrapping_sub(1)).ok_or_else(|| Beyond::Unknown("index".into()))?;
    *place = if rest.is_empty() { new } else { replace(place.clone(), rest, new)? };
    Ok(Value::Array(elements))
}
