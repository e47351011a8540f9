//! From definitions to values: expressions become nodes of the session's graph. Drives the builder of `field`; reads files only
//! through the host; never changes what a name means.
//!
//! Definitions are lowered in an order found with a list, not by recursion, so that a chain of a hundred thousand is no deeper than
//! one; only brackets and calls recurse, and both are limited.

mod arrays;
mod call;
mod data;
mod expr;
mod extremum;
mod fit;
mod fold;
mod measured;
mod nearest;
mod operators;
mod outline;
mod questions;
mod repeat;
mod star;
mod statement;

use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, Graph, NodeId};
use crate::host::Host;
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::source::{SourceMap, Span};
use crate::syntax::tree::{Body, Expr, Name, Statement, StatementKind};

use super::definition::{Definition, DefinitionId, SystemInForce};
use super::errors;
use super::names;
use super::state::{Kept, State};
use super::value::{Active, Function, Scalar, Scalars, System, Value};

pub use data::Files;

/// Why an expression has no value.
#[derive(Clone, Debug)]
pub enum Fault {
    /// An error of its own.
    Told(Box<Diagnostic>),
    /// It reads something that failed, which is told there.
    Follows(Arc<Diagnostic>),
    /// Ctrl-C.
    Cancelled,
}

impl From<Diagnostic> for Fault {
    fn from(diagnostic: Diagnostic) -> Self {
        Self::Told(Box::new(diagnostic))
    }
}

impl From<crate::interrupt::Cancelled> for Fault {
    fn from(_: crate::interrupt::Cancelled) -> Self {
        Self::Cancelled
    }
}

impl Fault {
    /// The message that explains it.
    #[must_use]
    pub fn diagnostic(self) -> Diagnostic {
        match self {
            Self::Told(d) => *d,
            Self::Follows(d) => Arc::unwrap_or_clone(d),
            Self::Cancelled => cancelled(),
        }
    }
}

/// The message after Ctrl-C.
#[must_use]
pub fn cancelled() -> Diagnostic {
    Diagnostic::error("cancelled", "cancelled; nothing has changed").category(Category::Cancelled)
}

/// A value, or why there is none.
pub type Lowered<T> = Result<T, Fault>;

/// A name with a value of its own inside a body.
#[derive(Clone, Debug)]
enum Slot {
    /// Not assigned yet.
    Unset,
    /// It starts from a definition that failed.
    Failed(Arc<Diagnostic>),
    /// Its value.
    Is(Value),
}

#[derive(Clone, Debug)]
struct Local {
    name: Name,
    slot: Slot,
}

/// What stays the same while an input is answered.
pub struct World<'a> {
    /// The limits.
    pub limits: &'a Limits,
    /// The cancel token.
    pub interrupt: &'a Interrupt,
    /// The disk.
    pub host: &'a dyn Host,
    /// The texts, for the names of their files.
    pub sources: &'a SourceMap,
    /// Names that a statement which failed would have defined: reading them is no further error.
    pub excused: &'a FxHashSet<Name>,
    /// Names that this input defines further down, for PRINT.
    pub later: &'a FxHashMap<Name, Span>,
}

/// Deepest nesting of expressions in evaluation, calls included; the stack of [`super::stack`] holds it.
const DEPTH: usize = 20_000;

/// Evaluates definitions over a state.
pub struct Lower<'a> {
    world: World<'a>,
    state: &'a mut State,
    graph: &'a mut Graph,
    files: &'a mut Files,
    /// Definitions that were lowered, in order.
    pub lowered: Vec<Arc<Definition>>,
    /// Warnings met on the way.
    pub warnings: Vec<Diagnostic>,
    locals: Vec<Local>,
    frame: usize,
    active: Active,
    current: Option<Arc<Definition>>,
    /// The functions whose bodies are being run, innermost last.
    current_function: Vec<Arc<Function>>,
    /// Turns that loops and calls have taken for this input.
    pub turns: usize,
    depth: usize,
    calls: usize,
    /// The last coordinate that stands for something that no text can name, where the evaluation stands.
    variables: u8,
}

impl<'a> Lower<'a> {
    /// An evaluator for one input or question.
    #[must_use]
    pub fn new(world: World<'a>, state: &'a mut State, graph: &'a mut Graph, files: &'a mut Files) -> Self {
        Self {
            world,
            state,
            graph,
            files,
            lowered: Vec::new(),
            warnings: Vec::new(),
            locals: Vec::new(),
            frame: 0,
            active: Active::InForce(SystemInForce::Plain),
            current: None,
            current_function: Vec::new(),
            turns: 0,
            depth: 0,
            calls: 0,
            variables: Coordinate::NAMED as u8,
        }
    }

    /// Finds the values of a definition and of all that it reads, if they are not kept already. What fails is kept as failed.
    ///
    /// # Errors
    /// [`Fault::Cancelled`] only.
    pub fn ensure(&mut self, root: &Arc<Definition>) -> Lowered<()> {
        let mut path: Vec<(Arc<Definition>, Vec<Arc<Definition>>)> = Vec::new();
        let mut on_path: FxHashSet<DefinitionId> = FxHashSet::default();
        self.enter(root, &mut path, &mut on_path);
        while let Some((definition, below)) = path.last_mut() {
            if let Some(next) = below.pop() {
                if on_path.contains(&next.id) {
                    self.circle(&path, &next);
                } else {
                    self.enter(&next, &mut path, &mut on_path);
                }
                continue;
            }
            let definition = definition.clone();
            path.pop();
            on_path.remove(&definition.id);
            if self.state.kept(definition.id).is_none() {
                self.world.interrupt.tick()?;
                let kept = self.definition(&definition)?;
                self.state.keep(definition.id, kept);
                self.lowered.push(definition);
            }
        }
        Ok(())
    }

    fn enter(
        &self,
        definition: &Arc<Definition>,
        path: &mut Vec<(Arc<Definition>, Vec<Arc<Definition>>)>,
        on_path: &mut FxHashSet<DefinitionId>,
    ) {
        if self.state.kept(definition.id).is_none() {
            on_path.insert(definition.id);
            let names = definition.reads.iter().filter_map(|(name, _)| self.state.find_for(definition, name));
            let mut below: Vec<Arc<Definition>> = names.chain(definition.links()).cloned().collect();
            below.retain(|d| self.state.kept(d.id).is_none());
            below.reverse();
            path.push((definition.clone(), below));
        }
    }

    fn circle(&mut self, path: &[(Arc<Definition>, Vec<Arc<Definition>>)], again: &Arc<Definition>) {
        let start = path.iter().position(|(d, _)| d.id == again.id).unwrap_or(0);
        let circle: Vec<&Arc<Definition>> = path[start..].iter().map(|(d, _)| d).collect();
        // Functions may call each other: none needs the value of another before it is called, and calls have a limit.
        if circle.iter().all(|definition| definition.is_function()) {
            return;
        }
        let told = Arc::new(errors::circle(&circle));
        for definition in circle {
            self.state.keep(definition.id, Kept::Failed(told.clone()));
        }
    }

    /// Lowers one definition whose reads are kept already.
    fn definition(&mut self, definition: &Arc<Definition>) -> Lowered<Kept> {
        let locals = std::mem::take(&mut self.locals);
        let active = std::mem::replace(&mut self.active, Active::InForce(definition.system.clone()));
        let current = self.current.replace(definition.clone());
        let running = std::mem::take(&mut self.current_function);
        let (frame, depth, calls) = (self.frame, self.depth, self.calls);
        self.frame = 0;
        let result = self.formula(definition);
        (self.frame, self.depth, self.calls) = (frame, depth, calls);
        self.locals = locals;
        self.active = active;
        self.current = current;
        self.current_function = running;
        match result {
            Ok(kept) => Ok(kept),
            Err(Fault::Told(told)) => Ok(Kept::Failed(Arc::new(*told))),
            Err(Fault::Follows(told)) => Ok(Kept::Failed(told)),
            Err(Fault::Cancelled) => Err(Fault::Cancelled),
        }
    }

    /// The value of an expression of a definition by itself, as the definition sees names; none if it fails.
    pub fn part(&mut self, definition: &Arc<Definition>, e: &Expr) -> Option<Value> {
        self.active = Active::InForce(definition.system.clone());
        self.current = Some(definition.clone());
        for (name, base) in &definition.bases {
            let slot = base.as_ref().map_or(Slot::Unset, |base| self.base(base, name));
            self.locals.push(Local { name: name.clone(), slot });
        }
        let value = self.expr(e).ok();
        self.locals.clear();
        value
    }

    fn formula(&mut self, definition: &Arc<Definition>) -> Lowered<Kept> {
        for (name, base) in &definition.bases {
            let slot = base.as_ref().map_or(Slot::Unset, |base| self.base(base, name));
            self.locals.push(Local { name: name.clone(), slot });
        }
        let statement = &definition.statement;
        let value = match &statement.kind {
            StatementKind::Define { name, parameters: Some(_), .. } => Value::Function(Arc::new(Function {
                definition: definition.clone(),
                name: name.name.clone(),
                local: None,
            })),
            StatementKind::Define { name, body: Body::Expression(e), range, .. } => {
                let value = self.expr(e)?;
                if let Some(range) = range {
                    self.check_range(&name.name, &value, range)?;
                }
                if names::is_system(&name.name) { self.system_value(&name.name, value, e.span)? } else { value }
            }
            StatementKind::Define { name, body: Body::Block(block), .. } => self.block_value(name, block)?,
            StatementKind::Element { name, indices, value } => {
                self.element(name, indices, value)?;
                self.local(&name.name, name.span)?
            }
            StatementKind::Expression(e) => self.expr(e)?,
            StatementKind::Print { items } => Value::Text(self.printed(items)?.into()),
            StatementKind::Type { kind, .. } => self.type_value(kind)?,
            _ => return self.outputs(definition),
        };
        if let Some(name) = definition.outputs.first() {
            errors::check_object(name, &value, definition.place())?;
        }
        Ok(Kept::One(value))
    }

    /// A loop or an IF: runs it and takes a value for each of its names.
    fn outputs(&mut self, definition: &Definition) -> Lowered<Kept> {
        self.exec(&definition.statement)?;
        let mut values = Vec::with_capacity(definition.outputs.len());
        for name in &definition.outputs {
            let slot = self.locals.iter().find(|l| l.name == *name).map(|l| &l.slot);
            let Some(Slot::Is(value)) = slot else {
                values.push(None);
                continue;
            };
            errors::check_object(name, value, definition.place())?;
            values.push(Some(value.clone()));
        }
        Ok(Kept::Many(values.into()))
    }

    fn base(&self, base: &Arc<Definition>, name: &Name) -> Slot {
        match self.value_of(base, name) {
            Some(Ok(value)) => Slot::Is(value),
            Some(Err(told)) => Slot::Failed(told),
            None => Slot::Unset,
        }
    }

    /// The kept value of one of a definition's names; none if it was never assigned.
    #[must_use]
    pub fn value_of(&self, definition: &Definition, name: &str) -> Option<Result<Value, Arc<Diagnostic>>> {
        match self.state.kept(definition.id)? {
            Kept::One(value) => Some(Ok(value.clone())),
            Kept::Failed(told) => Some(Err(told.clone())),
            Kept::Many(values) => {
                let place = definition.outputs.iter().position(|n| &**n == name)?;
                values.get(place)?.clone().map(Ok)
            }
        }
    }

    /// The value of a name where the evaluation stands.
    fn name(&mut self, name: &Name, span: Span) -> Lowered<Value> {
        if let Some(value) = self.find_local(name, span) {
            return value;
        }
        if names::is_system(name) {
            return self.system_in_force(name, span);
        }
        let Some(definition) = self.find(name) else { return Err(self.unknown(name, span)) };
        if self.state.kept(definition.id).is_none() {
            self.ensure(&definition)?;
        }
        match self.value_of(&definition, name) {
            Some(Ok(value)) => Ok(value),
            Some(Err(told)) => Err(Fault::Follows(told)),
            None => Err(errors::never_assigned(name, span, definition.statement.span).into()),
        }
    }

    /// The definition whose formula is being evaluated: that of the innermost function that runs, else the one that is asked for.
    fn reader(&self) -> Option<&Arc<Definition>> {
        self.current_function.last().map(|function| &function.definition).or(self.current.as_ref())
    }

    /// What a name means where the evaluation stands. A name of the user's that failed to be defined is not the library's.
    fn find(&self, name: &Name) -> Option<Arc<Definition>> {
        match self.reader() {
            Some(reader) if reader.is_library() => self.state.find_for(reader, name).cloned(),
            _ if self.world.excused.contains(name) => self.state.get(name).cloned(),
            _ => self.state.find(name).cloned(),
        }
    }

    fn unknown(&self, name: &Name, span: Span) -> Fault {
        if self.world.excused.contains(name) {
            return Fault::Follows(Arc::new(errors::excused(name)));
        }
        match self.world.later.get(name) {
            Some(place) => errors::defined_later(name, span, *place).into(),
            None => errors::unknown_name(self.state, name, &[span], false, self.world.excused).into(),
        }
    }

    fn find_local(&self, name: &Name, span: Span) -> Option<Lowered<Value>> {
        let local = self.locals[self.frame..].iter().rev().find(|l| l.name == *name)?;
        Some(match &local.slot {
            Slot::Is(value) => Ok(value.clone()),
            Slot::Failed(told) => Err(Fault::Follows(told.clone())),
            Slot::Unset => Err(errors::read_before_assigned(name, span).into()),
        })
    }

    fn local(&self, name: &Name, span: Span) -> Lowered<Value> {
        self.find_local(name, span).unwrap_or_else(|| Err(errors::read_before_assigned(name, span).into()))
    }

    fn set_local(&mut self, name: &Name, value: Value) {
        let frame = self.frame;
        match self.locals[frame..].iter_mut().rev().find(|l| l.name == *name) {
            Some(local) => local.slot = Slot::Is(value),
            None => self.locals.push(Local { name: name.clone(), slot: Slot::Is(value) }),
        }
    }

    /// Runs `f` with some names bound; an error leaves them to the definition, which clears all.
    fn bound<T>(&mut self, locals: Vec<Local>, f: impl FnOnce(&mut Self) -> Lowered<T>) -> Lowered<T> {
        let before = self.locals.len();
        self.locals.extend(locals);
        let result = f(self)?;
        self.locals.truncate(before);
        Ok(result)
    }

    /// Counts a turn of a loop or a call.
    fn turn(&mut self, span: Span) -> Lowered<()> {
        self.world.interrupt.tick()?;
        self.turns += 1;
        if self.turns > self.world.limits.loop_turns {
            return Err(errors::too_many_turns(self.world.limits.loop_turns, span).into());
        }
        if self.graph.len() > self.world.limits.graph_nodes {
            return Err(errors::too_many_nodes(self.world.limits.graph_nodes, span).into());
        }
        Ok(())
    }

    fn scalars(&mut self) -> Scalars<'_> {
        Scalars(self.graph)
    }

    fn wrap(&self, id: NodeId) -> Scalar {
        Scalar::of(self.graph, id)
    }

    /// The system of R-functions where the evaluation stands.
    fn system(&mut self, span: Span) -> Lowered<System> {
        let definition = match &self.active {
            Active::Is(system) => return Ok(*system),
            Active::InForce(SystemInForce::Plain) => return Ok(System::Alpha(Scalar::Number(0.0))),
            Active::InForce(SystemInForce::Set(definition)) => definition.clone(),
        };
        if self.state.kept(definition.id).is_none() {
            self.ensure(&definition)?;
        }
        let name = definition.outputs.first().cloned().unwrap_or_else(|| names::R_ALPHA.into());
        let value = match self.value_of(&definition, &name) {
            Some(Ok(value)) => value,
            Some(Err(told)) => return Err(Fault::Follows(told)),
            None => return Ok(System::Alpha(Scalar::Number(0.0))),
        };
        let system = system_of(&name, &value).ok_or_else(|| errors::bad_system(&name, &value, span))?;
        self.active = Active::Is(system);
        Ok(system)
    }

    fn system_in_force(&mut self, name: &str, span: Span) -> Lowered<Value> {
        let system = self.system(span)?;
        Ok(match (system, name == names::R_ALPHA) {
            (System::Alpha(alpha), true) => Value::Scalar(alpha),
            (System::Smooth(m), false) => Value::number(m),
            _ => Value::number(0.0),
        })
    }

    /// Checks the value of `r_alpha` or `r_m`.
    fn system_value(&mut self, name: &str, value: Value, span: Span) -> Lowered<Value> {
        match system_of(name, &value) {
            Some(_) => Ok(value),
            None => Err(errors::bad_system(name, &value, span).into()),
        }
    }

    /// Runs the statements of a definition without parameters; the value is what they assign to its name.
    fn block_value(&mut self, name: &crate::syntax::tree::Ident, block: &[Statement]) -> Lowered<Value> {
        let before = self.active.clone();
        let value = self.body(&name.name, name.span, block)?;
        self.active = before;
        Ok(value)
    }
}

fn system_of(name: &str, value: &Value) -> Option<System> {
    match (value, name == names::R_ALPHA) {
        (Value::Scalar(Scalar::Number(a)), true) => {
            (-1.0 < *a && *a <= 1.0).then_some(System::Alpha(Scalar::Number(*a)))
        }
        (Value::Scalar(alpha), true) => Some(System::Alpha(*alpha)),
        (Value::Scalar(Scalar::Number(m)), false) if *m == 0.0 => Some(System::Alpha(Scalar::Number(0.0))),
        (Value::Scalar(Scalar::Number(m)), false) => {
            (*m >= 1.0 && m.fract() == 0.0 && *m <= 64.0).then_some(System::Smooth(*m))
        }
        _ => None,
    }
}
