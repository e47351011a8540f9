//! A session: what was defined, and the answers to questions about it. Every front end works over this and computes nothing itself.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustc_hash::FxHashSet;

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinates, Graph, NodeId};
use crate::host::Host;
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::reuse::Reuse;
use crate::source::{SourceId, SourceMap, Span};
use crate::syntax::Mode;
use crate::syntax::tree::Name;

use super::definition::{Definition, DefinitionId};
use super::input::Input;
use super::library::Library;
use super::lower::Files;
use super::request::Searched;
use super::stack::with_large_stack;
use super::state::{Change, Entry, Kept, State};
use super::value::{Scalar, Value};

/// Something that an accepted input did, in its order.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// It defined something: one line.
    Defined(String),
    /// A bare expression's value, and the number if it is one.
    Value {
        /// As shown.
        text: String,
        /// The number.
        number: Option<f64>,
        /// The name, if it is an object: [`UNNAMED`] for an expression of objects.
        object: Option<String>,
    },
    /// What PRINT printed.
    Printed(String),
}

/// What became of an input.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Whether it counts; otherwise nothing has changed.
    pub accepted: bool,
    /// Errors, warnings and notes, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
    /// What it did, if it was accepted.
    pub events: Vec<Event>,
}

/// What a name reads, and who reads it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Deps {
    /// The names that its definition reads.
    pub reads: Vec<String>,
    /// The names whose definitions depend on it, directly or not.
    pub readers: Vec<String>,
}

/// An accepted input with what takes it back.
struct Done {
    title: String,
    changes: Vec<Change>,
}

/// Definitions, their values, and the history of inputs.
pub struct Session {
    pub(super) host: Arc<dyn Host>,
    pub(super) limits: Limits,
    pub(super) interrupt: Interrupt,
    pub(super) sources: SourceMap,
    pub(super) state: State,
    pub(super) graph: Graph,
    pub(super) files: Files,
    /// Definitions that are known to fail, so that each is noted once.
    pub(super) failing: FxHashSet<DefinitionId>,
    undo: Vec<Done>,
    redo: Vec<Done>,
    next: u64,
    seen: FxHashSet<DefinitionId>,
    again: Vec<Name>,
    /// Nodes of the graph after it was last made anew.
    settled: usize,
    /// The object that the last bare expression made, if it has no name.
    pub(super) unnamed: Option<NodeId>,
    /// Modelling spaces that were found, of objects of this graph.
    pub(super) searched: Vec<Searched>,
    /// How often the graph was made anew: nodes of an earlier one mean nothing now.
    pub(super) graphs: u64,
}

/// The name under which requests find the object that the last bare expression made.
pub const UNNAMED: &str = "_";

/// Nodes that a session may leave behind before its graph is made anew.
const LEFT_BEHIND: usize = 1 << 20;

impl fmt::Debug for Session {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Session").field("names", &self.state.names().count()).finish_non_exhaustive()
    }
}

impl Session {
    /// A session that knows the library, and nothing of the user's yet.
    #[must_use]
    pub fn new(host: Arc<dyn Host>, limits: Limits, interrupt: Interrupt) -> Self {
        Self::over(Some(Library::shared()), host, limits, interrupt)
    }

    /// A session without the library: the "Empty Case" of \[P95\] 3.3, in which everything is still to be defined.
    #[must_use]
    pub fn bare(host: Arc<dyn Host>, limits: Limits, interrupt: Interrupt) -> Self {
        Self::over(None, host, limits, interrupt)
    }

    fn over(library: Option<&'static Library>, host: Arc<dyn Host>, limits: Limits, interrupt: Interrupt) -> Self {
        let reuse_bytes = limits.reuse_bytes;
        Self {
            host,
            limits,
            interrupt: interrupt.keeping(Reuse::within(reuse_bytes)),
            sources: library.map(Library::sources).unwrap_or_default(),
            state: State::over(library),
            graph: Graph::new(),
            files: Files::default(),
            failing: FxHashSet::default(),
            undo: Vec::new(),
            redo: Vec::new(),
            next: 0,
            seen: FxHashSet::default(),
            again: Vec::new(),
            settled: 0,
            unnamed: None,
            searched: Vec::new(),
            graphs: 0,
        }
    }

    /// Takes a script or a line of the prompt as one transaction. `name` is what messages call it; INCLUDE and data files are looked
    /// for beside it.
    pub fn input(&mut self, name: &str, text: &str, mode: Mode) -> Outcome {
        let id = self.sources.add(name, text);
        self.tidy();
        self.again.clear();
        self.transaction(id, mode, title_of(text))
    }

    /// The function of the coordinates that an expression of objects is, as a node of the graph as it stands; nothing if it is a number.
    ///
    /// # Errors
    /// Messages for the user.
    pub(super) fn function_of(&mut self, name: &str, expression: &str) -> Result<Option<NodeId>, Vec<Diagnostic>> {
        let id = self.sources.add(name, expression);
        let before = self.unnamed;
        let outcome = self.transaction(id, Mode::Prompt, String::new());
        let found = std::mem::replace(&mut self.unnamed, before);
        if outcome.accepted { Ok(found) } else { Err(outcome.diagnostics) }
    }

    /// `-D NAME=EXPR`: gives a name another definition, also in scripts that are still to come.
    pub fn set(&mut self, name: &str, expression: &str) -> Outcome {
        let first = self.undo.iter().all(|done| done.title.starts_with("-D "));
        let known = first || self.state.find(name).is_some() || self.state.readers(name).next().is_some();
        let id = self.sources.add(format!("-D {name}"), format!("{name} = {expression};"));
        if !known {
            let span = crate::source::Span::new(id, 0, name.len());
            let told = super::errors::unknown_name(&self.state, name, &[span], false, &FxHashSet::default());
            return Outcome { accepted: false, diagnostics: vec![told], events: Vec::new() };
        }
        self.again.clear();
        let outcome = self.transaction(id, Mode::Prompt, format!("-D {name}={expression}"));
        if let (true, Some(done)) = (outcome.accepted, self.undo.last_mut()) {
            let mark = self.state.mark();
            self.state.pin(name.into());
            done.changes.extend(self.state.accept(&mark));
        }
        outcome
    }

    fn transaction(&mut self, id: SourceId, mode: Mode, title: String) -> Outcome {
        let (outcome, changes) = with_large_stack(|| Input::new(self, mode).run(id));
        if outcome.accepted && !changes.is_empty() {
            self.undo.push(Done { title, changes });
            if self.undo.len() > self.limits.undo_levels {
                self.undo.remove(0);
            }
            self.redo.clear();
        }
        outcome
    }

    /// Nodes are never removed from a graph, so a long session would gather those of all its former definitions: once they are in the
    /// majority, a new graph is built from what still matters.
    fn tidy(&mut self) {
        if self.graph.len() > LEFT_BEHIND + 2 * self.settled {
            self.graph = Graph::new();
            self.graphs += 1;
            self.searched.clear();
            self.unnamed = None;
            self.state.forget_all();
            self.settle();
            self.settled = self.graph.len();
        }
    }

    /// Data files are read again when they are next asked for: they may have changed.
    pub fn forget_files(&mut self) {
        self.files.clear();
        self.state.forget_all();
        self.settle();
    }

    pub(super) fn next_id(&mut self) -> DefinitionId {
        self.next += 1;
        DefinitionId(self.next)
    }

    pub(super) fn count_lowered(&mut self, lowered: &[Arc<Definition>]) {
        for definition in lowered {
            if !self.seen.insert(definition.id) {
                let current = definition.outputs.iter().filter(|n| self.state.is_current_for(n, definition));
                self.again.extend(current.cloned());
            }
        }
    }

    /// The names whose definitions, older than the last input, were lowered again for it; sorted, each once.
    #[must_use]
    pub fn lowered_again(&self) -> Vec<String> {
        sorted(self.again.iter().map(ToString::to_string).collect())
    }

    /// The texts of all inputs, for showing diagnostics.
    #[must_use]
    pub fn sources(&self) -> &SourceMap {
        &self.sources
    }

    /// The expression graph that objects point into.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The same, for building on what is there.
    pub fn graph_mut(&mut self) -> &mut Graph {
        &mut self.graph
    }

    /// The limits that the session keeps.
    #[must_use]
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Begins a question: results of earlier ones that it does not ask for may make room for its own.
    pub(super) fn turn(&self) {
        if let Some(reuse) = self.interrupt.reuse() {
            reuse.turn();
        }
    }

    /// The cancel token.
    #[must_use]
    pub fn interrupt(&self) -> &Interrupt {
        &self.interrupt
    }

    /// Takes back the last accepted input; gives its first line, or nothing if there is none.
    pub fn undo(&mut self) -> Option<String> {
        let mut done = self.undo.pop()?;
        self.state.undo(&mut done.changes);
        self.settle();
        let title = done.title.clone();
        self.redo.push(done);
        Some(title)
    }

    /// Forgets all definitions, as one step of the history: [`Session::undo`] brings them back.
    pub fn reset(&mut self) {
        let mark = self.state.mark();
        self.state.clear();
        let changes = self.state.accept(&mark);
        self.failing.clear();
        self.undo.push(Done { title: ":reset".into(), changes });
        self.redo.clear();
        self.settle();
    }

    /// Does again what was taken back last.
    pub fn redo(&mut self) -> Option<String> {
        let mut done = self.redo.pop()?;
        self.state.redo(&mut done.changes);
        self.settle();
        let title = done.title.clone();
        self.undo.push(done);
        Some(title)
    }

    /// Finds the values that a step through the history made stale.
    fn settle(&mut self) {
        self.again.clear();
        with_large_stack(|| Input::new(self, Mode::Prompt).settle());
    }

    /// Finds a value that an interrupted step left out.
    pub(super) fn refresh(&mut self, name: &str) {
        let definition = self.state.get(name).filter(|d| self.state.kept(d.id).is_none()).cloned();
        if let Some(definition) = definition {
            self.state.add_stale(&definition);
            self.settle();
        }
    }

    /// What a name reads and who depends on it; nothing if it is unknown and nobody reads it.
    #[must_use]
    pub fn deps(&self, name: &str) -> Option<Deps> {
        super::report::deps(&self.state, name)
    }

    /// One line for each defined name, in the order of the text.
    #[must_use]
    pub fn definitions(&self) -> Vec<String> {
        self.names().iter().map(|name| self.describe(name)).collect()
    }

    /// The defined names in the order of the text.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        for entry in self.state.program() {
            let Entry::Definition(definition) = entry else { continue };
            let current = definition.outputs.iter().filter(|n| self.state.is_current_for(n, definition));
            names.extend(current.map(ToString::to_string));
        }
        names
    }

    /// The library that it stands on, unless it goes without.
    #[must_use]
    pub fn library(&self) -> Option<&'static Library> {
        self.state.library()
    }

    /// Whether the user defined the name.
    #[must_use]
    pub fn is_defined(&self, name: &str) -> bool {
        self.state.get(name).is_some()
    }

    /// The documentation of a name: the comment right above its definition, or above the one that this continues.
    #[must_use]
    pub fn doc(&self, name: &str) -> Option<String> {
        super::report::doc(&self.state, name)
    }

    /// The coordinates of both sides of each `@` that a definition is made with.
    #[must_use]
    pub fn cartesian(&self, name: &str) -> Vec<[Coordinates; 2]> {
        super::report::products(&self.state, name)
    }

    /// The text of a definition, what it continues included.
    #[must_use]
    pub fn definition(&self, name: &str) -> Option<String> {
        super::report::definition(&self.state, &self.sources, name)
    }

    /// A script that defines the same again, for the current folder.
    #[must_use]
    pub fn save(&self) -> String {
        self.save_in(None)
    }

    /// A script that defines the same again, for a file in `folder`: data files are named as seen from there.
    #[must_use]
    pub fn save_in(&self, folder: Option<&Path>) -> String {
        let known: Vec<PathBuf> = self.files.known().map(|(_, path, _)| path).collect();
        let folder_of = |name: &str| Path::new(name).parent().map(Path::to_path_buf).unwrap_or_default();
        let mut folders: Vec<PathBuf> = self.sources.names().map(folder_of).collect();
        folders.sort();
        folders.dedup();
        let to = super::report::Move { host: &*self.host, folder, known: &known, folders: &folders };
        super::report::save(&self.state, &self.sources, &to)
    }

    /// One line about a defined name: `r1 = 4`, `gob_ball: object of x1, x2, x3`.
    #[must_use]
    pub fn describe(&self, name: &str) -> String {
        match self.value(name) {
            Some(Ok(value)) => line(name, &value, &self.graph),
            Some(Err(told)) if told.code == "unknown-name" => format!("{name}: waits, {}", told.title),
            Some(Err(told)) => format!("{name}: fails, {}", told.title),
            None => format!("{name}: has no value"),
        }
    }

    /// Where a name is defined.
    #[must_use]
    pub fn place(&self, name: &str) -> Option<Span> {
        self.state.get(name).map(|definition| definition.place())
    }

    /// The value of a name, or why it has none; nothing if it is unknown.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<Result<Value, Arc<Diagnostic>>> {
        let definition = self.state.get(name)?;
        match self.state.kept(definition.id)? {
            Kept::One(value) => Some(Ok(value.clone())),
            Kept::Failed(told) => Some(Err(told.clone())),
            Kept::Many(values) => {
                let place = definition.outputs.iter().position(|n| &**n == name)?;
                values.get(place)?.clone().map(Ok)
            }
        }
    }
}

/// One line about a name and its value.
pub(super) fn line(name: &str, value: &Value, graph: &Graph) -> String {
    match value {
        Value::Scalar(Scalar::Node(id)) if name.starts_with("gob_") => {
            let names: Vec<String> = graph.coordinates(*id).iter().map(|c| c.to_string()).collect();
            format!("{name}: object of {}", names.join(", "))
        }
        Value::Function(f) => f.signature(),
        _ => format!("{name} = {}", value.show(graph)),
    }
}

fn title_of(text: &str) -> String {
    let line = text.lines().map(str::trim).find(|l| !l.is_empty()).unwrap_or_default();
    line.chars().take(80).collect()
}

/// Sorted, each once.
pub(super) fn sorted(mut names: Vec<String>) -> Vec<String> {
    names.sort();
    names.dedup();
    names
}
