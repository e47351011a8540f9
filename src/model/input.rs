//! One input, one transaction: its statements become definitions, everything is checked and lowered, and only then it counts.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::{Diagnostic, Severity};
use crate::field::Coordinate;
use crate::source::{SourceId, Span};
use crate::syntax::tree::{Expr, ExprKind, Ident, Name, Statement, StatementKind};
use crate::syntax::{self, Mode};

use super::check;
use super::definition::{Definition, DefinitionId, SystemInForce};
use super::errors;
use super::lower::{Fault, Lower, World};
use super::names;
use super::session::{Event, Outcome, Session, UNNAMED};
use super::state::{Declared, Entry, Kept};
use super::value::{Scalar, Value};

/// A statement to be worked off, or the ends of an included file. Nearly all are statements, so a box would save nothing.
#[allow(clippy::large_enum_variant)]
enum Item {
    Statement(Statement),
    Enter,
    Restore,
}

/// What is gathered while an input is worked off.
pub(super) struct Input<'s> {
    session: &'s mut Session,
    mode: Mode,
    diagnostics: Vec<Diagnostic>,
    told: FxHashSet<(&'static str, String, Option<Span>)>,
    pending: Vec<Pending>,
    fresh: Vec<(Arc<Definition>, names::Names)>,
    /// What statements read that are no definitions, for want of form.
    loose: Vec<(Name, Span)>,
    /// Names of statements that failed.
    excused: FxHashSet<Name>,
    /// Names that this input defines, with the place of the first definition.
    later: FxHashMap<Name, Span>,
    /// For each name that this input defined: where, and who read it since.
    defined: FxHashMap<Name, (Span, Option<Span>)>,
    /// The systems in force where included files began.
    systems: Vec<SystemInForce>,
    /// Turns that loops and calls have taken so far.
    turns: usize,
    /// Files included so far.
    included: usize,
}

/// Files within files.
const INCLUDE_DEPTH: usize = 64;
/// Files that one input may include.
const INCLUDES: usize = 10_000;

/// What will be told of a statement if the input is accepted.
enum Pending {
    Defined(Arc<Definition>),
    Event(Event),
}

impl<'s> Input<'s> {
    pub(super) fn new(session: &'s mut Session, mode: Mode) -> Self {
        Self {
            session,
            mode,
            diagnostics: Vec::new(),
            told: FxHashSet::default(),
            pending: Vec::new(),
            fresh: Vec::new(),
            loose: Vec::new(),
            excused: FxHashSet::default(),
            later: FxHashMap::default(),
            defined: FxHashMap::default(),
            systems: Vec::new(),
            turns: 0,
            included: 0,
        }
    }

    /// Works the text off. Nothing has changed if the outcome is not accepted.
    pub(super) fn run(mut self, id: SourceId) -> (Outcome, Vec<super::state::Change>) {
        let mark = self.session.state.mark();
        let failing = self.session.failing.clone();
        let parsed = self.parsed(id, self.mode);
        self.diagnostics.extend(parsed.diagnostics);
        let mut items = Vec::new();
        let mut files = self.file_of(id).into_iter().collect();
        self.flatten(parsed.statements, &mut files, &mut items);
        self.look_ahead(&items);
        let mut fault = None;
        for item in items {
            if let Err(stopped) = self.item(item) {
                fault = Some(stopped);
                break;
            }
        }
        let fresh: Vec<DefinitionId> = self.fresh.iter().map(|(d, _)| d.id).collect();
        let fault = match fault {
            None => {
                self.check();
                let stopped = self.lower_all(&fresh).err();
                self.check_extents();
                stopped
            }
            fault => fault,
        };
        if let Some(fault) = fault {
            self.tell(fault.diagnostic());
        }
        let accepted = !self.diagnostics.iter().any(Diagnostic::is_error);
        if !accepted {
            self.session.state.take_back(&mark);
            self.session.failing = failing;
            // What it would have broken works as before.
            self.diagnostics.retain(|d| d.code != "broken");
            let outcome = self.outcome(false, Vec::new());
            return (outcome, Vec::new());
        }
        let events = self.events();
        let changes = self.session.state.accept(&mark);
        (self.outcome(true, events), changes)
    }

    /// Lowers what a step through the history made stale; failures stay with their definitions.
    pub(super) fn settle(mut self) {
        // Interrupted work is found again when it is asked for.
        let _ = self.lower_all(&[]);
        let mark = self.session.state.mark();
        self.session.state.accept(&mark);
    }

    fn parsed(&self, id: SourceId, mode: Mode) -> syntax::Parsed {
        let _phase = self.session.interrupt.phase("parse");
        syntax::parse(&self.session.sources, id, &self.session.limits, mode)
    }

    fn outcome(mut self, accepted: bool, events: Vec<Event>) -> Outcome {
        // In the order of the text; the ones without a place come last.
        self.diagnostics
            .sort_by_key(|d| d.labels.first().map_or((u32::MAX, u32::MAX), |l| (l.span.source.0, l.span.start)));
        let errors = self.diagnostics.iter().filter(|d| d.is_error()).count();
        let limit = self.session.limits.errors;
        if errors > limit {
            let mut left = limit;
            self.diagnostics.retain(|d| {
                left = left.saturating_sub(usize::from(d.is_error()));
                !d.is_error() || left > 0
            });
            self.diagnostics.push(Diagnostic::error("more-errors", format!("and {} more errors", errors - limit + 1)));
        }
        Outcome { accepted, diagnostics: self.diagnostics, events }
    }

    fn tell(&mut self, diagnostic: Diagnostic) {
        let place = diagnostic.labels.first().map(|l| l.span);
        if diagnostic.code != "excused" && self.told.insert((diagnostic.code, diagnostic.title.clone(), place)) {
            self.diagnostics.push(diagnostic);
        }
    }

    fn file_of(&self, id: SourceId) -> Option<(PathBuf, String)> {
        let name = &self.session.sources.get(id)?.name;
        Some((self.session.host.identity(Path::new(name)), name.clone()))
    }

    /// Puts the statements of included files in the place of their INCLUDE.
    fn flatten(&mut self, statements: Vec<Statement>, files: &mut Vec<(PathBuf, String)>, items: &mut Vec<Item>) {
        for statement in statements {
            match &statement.kind {
                StatementKind::Include { path, path_span } => {
                    let (path, span) = (path.clone(), *path_span);
                    self.include(&path, span, files, items);
                }
                _ => items.push(Item::Statement(statement)),
            }
        }
    }

    fn include(&mut self, path: &str, span: Span, files: &mut Vec<(PathBuf, String)>, items: &mut Vec<Item>) {
        let from = self.session.sources.get(span.source).map(|s| PathBuf::from(&s.name));
        let path = crate::host::resolve(from.as_deref(), Path::new(path));
        let identity = self.session.host.identity(&path);
        let shown = path.display().to_string();
        if let Some(start) = files.iter().position(|(f, _)| *f == identity) {
            let way: Vec<&str> = files[start..].iter().map(|(_, name)| &**name).chain([&*shown]).collect();
            self.tell(
                Diagnostic::error("include-circle", format!("INCLUDE goes round in a circle: {}", way.join(" -> ")))
                    .at(span, "leads back to a file that is being read")
                    .help("take one INCLUDE out of the circle, or move what both files need into a third"),
            );
            return;
        }
        // Files that include each other twice would be read twice to the power of their depth.
        self.included += 1;
        if files.len() > INCLUDE_DEPTH || self.included > INCLUDES {
            let title = format!("INCLUDEs nested deeper than {INCLUDE_DEPTH}, or more than {INCLUDES} in all");
            self.tell(Diagnostic::error("too-many-includes", title).at(span, ""));
            return;
        }
        let read = self.session.host.read(&path, self.session.limits.source_bytes);
        let text = match read.and_then(|bytes| crate::host::text(&path, bytes)) {
            Ok(text) => text,
            Err(error) => {
                self.tell(error.diagnostic().at(span, ""));
                return;
            }
        };
        let id = self.session.sources.add(path.display().to_string(), text);
        let parsed = self.parsed(id, Mode::Script);
        self.diagnostics.extend(parsed.diagnostics);
        files.push((identity, shown));
        items.push(Item::Enter);
        self.flatten(parsed.statements, files, items);
        files.pop();
        items.push(Item::Restore);
    }

    /// Which names this input will define.
    fn look_ahead(&mut self, items: &[Item]) {
        for item in items {
            let Item::Statement(statement) = item else { continue };
            match &statement.kind {
                StatementKind::Failed { defines, .. } => self.excused.extend(defines.iter().cloned()),
                StatementKind::Define { name, .. } => {
                    self.later.entry(name.name.clone()).or_insert(name.span);
                }
                StatementKind::If { .. } | StatementKind::While { .. } | StatementKind::For { .. } => {
                    for name in names::assigned(std::slice::from_ref(statement)) {
                        self.later.entry(name).or_insert(statement.span);
                    }
                }
                _ => {}
            }
        }
    }

    fn item(&mut self, item: Item) -> Result<(), Fault> {
        let statement = match item {
            Item::Statement(statement) => statement,
            Item::Enter => {
                self.systems.push(self.session.state.system().clone());
                return Ok(());
            }
            Item::Restore => {
                self.restore_system();
                return Ok(());
            }
        };
        match &statement.kind {
            StatementKind::Failed { defines, reads, condition } => {
                self.failed(defines, reads, *condition, statement.span);
                Ok(())
            }
            StatementKind::Include { .. } => Ok(()),
            StatementKind::Print { .. } | StatementKind::Expression(_) => self.ask(statement),
            _ => {
                self.define(statement);
                Ok(())
            }
        }
    }

    /// What a statement reads that did not parse: unknown names and a loop that cannot step are told all the same.
    fn failed(&mut self, defines: &[Name], reads: &[Ident], condition: Option<Span>, span: Span) {
        let own = |read: &&Ident| crate::builtins::find(&read.name).is_none() && !names::is_system(&read.name);
        let reads: Vec<(Name, Span)> = reads.iter().filter(own).map(|r| (r.name.clone(), r.span)).collect();
        let within = |c: Span| move |(_, at): &&(Name, Span)| c.start <= at.start && at.end <= c.end;
        if let Some(condition) = condition {
            let read: Vec<Name> = reads.iter().filter(within(condition)).map(|(n, _)| n.clone()).collect();
            if !read.is_empty() {
                self.tell(errors::loop_never_steps(&read, defines, condition, span));
            }
        }
        self.loose.extend(reads);
    }

    /// An INCLUDE restores the system of R-functions that it found.
    fn restore_system(&mut self) {
        let before = self.systems.pop().unwrap_or_default();
        let same = match (&before, self.session.state.system()) {
            (SystemInForce::Plain, SystemInForce::Plain) => true,
            (SystemInForce::Set(a), SystemInForce::Set(b)) => Arc::ptr_eq(a, b),
            _ => false,
        };
        if !same {
            self.session.state.push(Entry::Restore(before.clone()));
            self.session.state.set_system(before);
        }
    }

    /// Makes a definition of a statement, if its form allows.
    fn define(&mut self, statement: Statement) {
        let said = names::of_statement(&statement);
        if let Some(told) = check::form(&statement) {
            let own = check::defines(&statement);
            self.excused.extend(own);
            self.tell(told);
            self.loose.extend(said.reads);
            return;
        }
        if let StatementKind::Type { subject, .. } = &statement.kind
            && super::environment::coordinate(&subject.name).is_none()
        {
            self.loose.push((subject.name.clone(), subject.span));
        }
        if let StatementKind::Define { name, parameters: None, .. } = &statement.kind
            && let Some(setting) = super::environment::nearly_setting(&name.name)
        {
            self.tell(errors::nearly_setting(&name.name, &setting, name.span));
        }
        if !matches!(&statement.kind, StatementKind::Define { name, .. } if names::is_system(&name.name)) {
            let mut lost = Vec::new();
            check::lost_settings(std::slice::from_ref(&statement), &mut lost);
            lost.into_iter().for_each(|told| self.tell(told));
        }
        let Some(definition) = self.definition(statement, &said) else { return };
        let definition = Arc::new(definition);
        self.note_readers(&definition);
        let state = &mut self.session.state;
        state.register(&definition);
        match &definition.statement.kind {
            StatementKind::Define { name, .. } if names::is_system(&name.name) => {
                state.push(Entry::Definition(definition.clone()));
                state.add_stale(&definition);
                state.set_system(SystemInForce::Set(definition.clone()));
            }
            StatementKind::Type { subject, kind } => {
                let declared = Declared { kind: kind.clone(), definition: definition.clone() };
                state.declare(&subject.name, declared);
                state.push(Entry::Definition(definition.clone()));
                state.add_stale(&definition);
            }
            _ => {
                state.define(&definition);
                self.pending.push(Pending::Defined(definition.clone()));
            }
        }
        self.fresh.push((definition, said));
    }

    fn definition(&mut self, statement: Statement, said: &names::Names) -> Option<Definition> {
        let (outputs, own) = match &statement.kind {
            StatementKind::Define { name, parameters, .. } => {
                let reads = said.reads.iter().any(|(n, _)| *n == name.name) && parameters.is_none();
                (vec![name.name.clone()], if reads { vec![name.name.clone()] } else { Vec::new() })
            }
            StatementKind::Element { name, .. } => (vec![name.name.clone()], vec![name.name.clone()]),
            StatementKind::Type { .. } => (Vec::new(), Vec::new()),
            _ => {
                let outputs = names::assigned(std::slice::from_ref(&statement));
                (outputs.clone(), outputs)
            }
        };
        let state = &self.session.state;
        let bases: Vec<_> = own.iter().map(|n| (n.clone(), state.get(n).cloned())).collect();
        if let (StatementKind::Define { name, .. } | StatementKind::Element { name, .. }, [(_, None)]) =
            (&statement.kind, &bases[..])
        {
            let place = said.reads.iter().find(|(n, _)| *n == name.name).map_or(name.span, |(_, span)| *span);
            let excused = self.excused.contains(&name.name);
            let told = match &statement.kind {
                StatementKind::Element { .. } => errors::element_of_nothing(&name.name, name.span),
                _ => errors::extends_nothing(&name.name, place),
            };
            if !excused {
                self.excused.insert(name.name.clone());
                self.tell(told);
            }
            self.loose.extend(said.reads.iter().filter(|(n, _)| !own.contains(n)).cloned());
            return None;
        }
        let pinned = outputs.len() == 1 && own.is_empty() && self.mode != Mode::Prompt;
        if pinned && state.is_pinned(&outputs[0]) {
            self.check_pinned(&statement);
            return None;
        }
        let reads = said.reads.iter().filter(|(n, _)| !own.contains(n)).cloned().collect();
        let system = state.system().clone();
        let uses_system = said.uses_system;
        let id = self.session.next_id();
        Some(Definition { id, statement, outputs, bases, reads, system, uses_system })
    }

    /// The range of a parameter holds for the value that the command line gives it. Bounds that are known only further down
    /// are not looked at.
    fn check_pinned(&mut self, statement: &Statement) {
        if let StatementKind::Define { name, range: Some(range), .. } = &statement.kind
            && let Some(Ok(value)) = self.session.value(&name.name)
            && let Err(Fault::Told(told)) = self.with_lower(|lower| lower.check_range(&name.name, &value, range))
            && told.code != "unknown-name"
        {
            self.tell(*told);
        }
    }

    /// Keeps track of who read what since when, for the warning about two definitions with a reader between.
    fn note_readers(&mut self, definition: &Arc<Definition>) {
        for (name, span) in &definition.reads {
            if let Some((_, reader)) = self.defined.get_mut(name) {
                reader.get_or_insert(*span);
            }
        }
        for name in &definition.outputs {
            let place = definition.place();
            let before = self.defined.insert(name.clone(), (place, None));
            if let (Some((first, Some(reader))), true) =
                (before, definition.bases.is_empty() && self.mode != Mode::Prompt)
            {
                self.tell(errors::redefined(name, first, reader, place));
            }
        }
    }

    /// PRINT or a bare expression: evaluated where it stands.
    fn ask(&mut self, statement: Statement) -> Result<(), Fault> {
        let said = names::of_statement(&statement);
        let unknown = check::unknown(&self.session.state, &said, &self.excused, &self.later);
        if !unknown.is_empty() {
            unknown.into_iter().for_each(|d| self.tell(d));
            return Ok(());
        }
        let system = self.session.state.system().clone();
        let print = matches!(statement.kind, StatementKind::Print { .. });
        let definition = Arc::new(Definition {
            id: self.session.next_id(),
            statement,
            outputs: Vec::new(),
            bases: Vec::new(),
            reads: said.reads,
            system,
            uses_system: said.uses_system,
        });
        self.with_lower(|lower| lower.ensure(&definition))?;
        let kept = self.session.state.kept(definition.id).cloned();
        self.session.state.forget(definition.id);
        match kept {
            Some(Kept::One(value)) => {
                let event = self.shown(&definition, &value, print);
                self.pending.push(Pending::Event(event));
            }
            Some(Kept::Failed(told)) => self.tell(Arc::unwrap_or_clone(told)),
            _ => {}
        }
        Ok(())
    }

    fn shown(&mut self, definition: &Definition, value: &Value, print: bool) -> Event {
        self.session.unnamed = None;
        let object = match &definition.statement.kind {
            StatementKind::Expression(Expr { kind: ExprKind::Name(name), .. }) if name.starts_with("gob_") => {
                Some(name.to_string())
            }
            // Made of objects, it is one too, though it has no name yet.
            StatementKind::Expression(_) if definition.reads.iter().any(|(name, _)| names::is_geometric(name)) => {
                self.session.unnamed = value.varying().filter(|node| !self.session.graph.coordinates(*node).is_empty());
                self.session.unnamed.map(|_| UNNAMED.to_owned())
            }
            _ => None,
        };
        let text = match &object {
            Some(name) if name != UNNAMED => self.session.describe(name),
            _ => value.show(&self.session.graph),
        };
        if print {
            return Event::Printed(text);
        }
        let number = match value {
            Value::Scalar(Scalar::Number(n)) => Some(*n),
            _ => None,
        };
        Event::Value { text, number, object }
    }

    /// Runs the evaluator and takes its warnings and its list of work.
    fn with_lower<T>(&mut self, f: impl FnOnce(&mut Lower<'_>) -> T) -> T {
        let interrupt = self.session.interrupt.clone();
        let _phase = interrupt.phase("lower");
        let session = &mut *self.session;
        let world = World {
            limits: &session.limits,
            interrupt: &session.interrupt,
            host: &*session.host,
            sources: &session.sources,
            excused: &self.excused,
            later: &self.later,
        };
        let mut lower = Lower::new(world, &mut session.state, &mut session.graph, &mut session.files);
        lower.turns = self.turns;
        let result = f(&mut lower);
        self.turns = lower.turns;
        let (lowered, warnings) = (std::mem::take(&mut lower.lowered), std::mem::take(&mut lower.warnings));
        drop(lower);
        session.count_lowered(&lowered);
        warnings.into_iter().for_each(|w| self.tell(w));
        result
    }

    /// What is known without evaluating anything.
    fn check(&mut self) {
        let fresh = std::mem::take(&mut self.fresh);
        let note = self.mode == Mode::Prompt;
        let reads = fresh.iter().flat_map(|(d, _)| &d.reads).chain(&self.loose).map(|(name, span)| (name, *span));
        for told in check::unknown_names(&self.session.state, reads, &self.excused, note) {
            self.tell(told);
        }
        for (definition, said) in &fresh {
            for told in check::bodies(&self.session.state, definition, said) {
                self.tell(told);
            }
        }
        self.fresh = fresh;
    }

    /// Warns of a modelling space that ends before it begins, if this input said where it does.
    fn check_extents(&mut self) {
        for c in (1..=16).map(Coordinate) {
            let names = [format!("{c}min"), format!("{c}max")];
            let value = |name: &String| match self.session.value(name) {
                Some(Ok(Value::Scalar(Scalar::Number(value)))) => Some(value),
                _ => None,
            };
            let said = self.fresh.iter().any(|(d, _)| d.outputs.iter().any(|n| names.iter().any(|name| **name == **n)));
            if let (true, [Some(lo), Some(hi)]) = (said, names.each_ref().map(value))
                && lo >= hi
            {
                let [lo_at, hi_at] = names.each_ref().map(|name| self.session.place(name));
                let told = errors::no_extent(c, (lo, lo_at), (hi, hi_at));
                self.tell(Diagnostic { severity: Severity::Warning, ..told });
            }
        }
    }

    /// Lowers what is new and what depends on it.
    fn lower_all(&mut self, fresh: &[DefinitionId]) -> Result<(), Fault> {
        let stale = self.session.state.take_stale();
        let live = |session: &Session, d: &Arc<Definition>| {
            d.outputs.is_empty() || names::is_system(&d.outputs[0]) || session.state.is_current(d)
        };
        let wanted: Vec<_> = stale.into_iter().filter(|d| live(self.session, d)).collect();
        self.with_lower(|lower| wanted.iter().try_for_each(|d| lower.ensure(d)))?;
        let fresh: FxHashSet<DefinitionId> = fresh.iter().copied().collect();
        for definition in wanted {
            let Some(Kept::Failed(told)) = self.session.state.kept(definition.id) else {
                self.session.failing.remove(&definition.id);
                continue;
            };
            let told = told.clone();
            let again = !self.session.failing.insert(definition.id);
            if told.code == "unknown-name" {
                continue;
            }
            if fresh.contains(&definition.id) {
                self.tell(Arc::unwrap_or_clone(told));
            } else if !again {
                self.tell(errors::broken(&definition, &told));
            }
        }
        Ok(())
    }

    fn events(&mut self) -> Vec<Event> {
        let pending = std::mem::take(&mut self.pending);
        let mut events = Vec::new();
        for one in pending {
            match one {
                Pending::Event(event) => events.push(event),
                Pending::Defined(definition) => {
                    for name in &definition.outputs {
                        let current = self.session.state.is_current_for(name, &definition);
                        if current && (self.mode == Mode::Prompt || name.starts_with("gob_")) {
                            events.push(Event::Defined(self.session.describe(name)));
                        }
                    }
                }
            }
        }
        events
    }
}
