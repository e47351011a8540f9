//! What the session knows: which definition each name has, the values kept for them, and who reads what. Every change is written
//! down, so that an input that fails leaves no trace and an accepted one can be undone. Evaluates nothing.

use std::sync::{Arc, Weak};

use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::Diagnostic;
use crate::field::Coordinates;
use crate::syntax::tree::{GeometricType, Name};

use super::definition::{Definition, DefinitionId, SystemInForce};
use super::library::Library;
use super::value::Value;

/// The kept result of a definition.
#[derive(Clone, Debug)]
pub enum Kept {
    /// The value of its one name.
    One(Value),
    /// A value for each output; a name that was never assigned has none.
    Many(Arc<[Option<Value>]>),
    /// It failed, and why.
    Failed(Arc<Diagnostic>),
}

impl Kept {
    /// The result of a definition if one of its names had this value.
    #[must_use]
    pub fn with(definition: &Definition, name: &str, value: Value) -> Self {
        if definition.outputs.len() == 1 {
            return Self::One(value);
        }
        let pick = |n: &Name| (**n == *name).then(|| value.clone());
        Self::Many(definition.outputs.iter().map(pick).collect())
    }
}

/// A geometric type as declared.
#[derive(Clone, Debug)]
pub struct Declared {
    /// The type.
    pub kind: GeometricType,
    /// The statement, whose expressions are live.
    pub definition: Arc<Definition>,
}

/// One place of the state with the value that it does not have now: swapping both undoes and redoes.
#[derive(Debug)]
pub enum Change {
    /// The definition of a name.
    Name(Name, Option<Arc<Definition>>),
    /// The system of R-functions in force at the end.
    System(SystemInForce),
    /// A geometric type of a coordinate or an object, under its key.
    Type(Name, Option<Arc<Declared>>),
    /// Whether a name was set from outside and scripts do not change it.
    Pinned(Name, bool),
    /// A kept value. Only for taking back a failed input; accepted ones drop these.
    Kept(DefinitionId, Option<Kept>),
    /// The Cartesian products that a value is made with; the same holds.
    Products(DefinitionId, Vec<[Coordinates; 2]>),
    /// The end of the list of statements: its length and what stood beyond.
    Program(usize, Vec<Entry>),
}

/// A statement in the order in which it was given.
#[derive(Clone, Debug)]
pub enum Entry {
    /// A definition, `r_alpha` and geometric types among them.
    Definition(Arc<Definition>),
    /// The end of an INCLUDE that had set another system: the one in force before is in force again.
    Restore(SystemInForce),
}

/// Everything that an input may change.
#[derive(Debug, Default)]
pub struct State {
    names: FxHashMap<Name, Arc<Definition>>,
    types: FxHashMap<Name, Arc<Declared>>,
    system: SystemInForce,
    pinned: FxHashSet<Name>,
    kept: FxHashMap<DefinitionId, Kept>,
    program: Vec<Entry>,
    readers: FxHashMap<Name, Readers>,
    dependents: FxHashMap<DefinitionId, Readers>,
    journal: Vec<Change>,
    /// The coordinates of both sides of each `@` that a definition's value was made with.
    products: FxHashMap<DefinitionId, Vec<[Coordinates; 2]>>,
    /// Definitions whose values are to be found again, oldest first.
    stale: Vec<Arc<Definition>>,
    /// Kept results after the last sweep.
    swept: usize,
    /// The library, unless the session goes without.
    library: Option<&'static Library>,
}

/// Cartesian products that are remembered of one definition.
const MOST_PRODUCTS: usize = 16;

/// Definitions that read something. Dead ones are swept when the list has doubled.
#[derive(Debug, Default)]
struct Readers {
    all: Vec<Weak<Definition>>,
    swept: usize,
}

impl Readers {
    fn push(&mut self, reader: &Arc<Definition>) {
        if self.all.len() >= 16 + 2 * self.swept {
            self.all.retain(|r| r.strong_count() > 0);
            self.swept = self.all.len();
        }
        self.all.push(Arc::downgrade(reader));
    }

    fn iter(&self) -> impl Iterator<Item = Arc<Definition>> {
        self.all.iter().filter_map(Weak::upgrade)
    }
}

impl State {
    /// A state that knows nothing but the library, or nothing at all.
    #[must_use]
    pub fn over(library: Option<&'static Library>) -> Self {
        Self { library, ..Self::default() }
    }

    /// The library, unless the session goes without.
    #[must_use]
    pub fn library(&self) -> Option<&'static Library> {
        self.library
    }

    /// What a name means to the user: the user's own definition, else the library's.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&Arc<Definition>> {
        self.names.get(name).or_else(|| self.library?.get(name))
    }

    /// What a name means in the formula of a definition: the library's definitions see the library's names, whatever the user
    /// defines.
    #[must_use]
    pub fn find_for(&self, reader: &Definition, name: &str) -> Option<&Arc<Definition>> {
        if reader.is_library() { self.library?.get(name) } else { self.find(name) }
    }

    /// Whether the name is the library's, and not the user's.
    #[must_use]
    pub fn is_library(&self, name: &str) -> bool {
        !self.names.contains_key(name) && self.library.is_some_and(|library| library.has(name))
    }

    /// The user's definition of a name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Arc<Definition>> {
        self.names.get(name)
    }

    /// All names that the user defined, in no order.
    pub fn names(&self) -> impl Iterator<Item = &Name> {
        self.names.keys()
    }

    /// The statements in their order, those that no longer matter among them.
    #[must_use]
    pub fn program(&self) -> &[Entry] {
        &self.program
    }

    /// The system of R-functions in force at the end.
    #[must_use]
    pub fn system(&self) -> &SystemInForce {
        &self.system
    }

    /// The declared type of a coordinate (`x4`), or the level or levels of an object.
    #[must_use]
    pub fn declared(&self, subject: &str) -> Option<&Arc<Declared>> {
        self.types.get(subject)
    }

    /// The declared centre of an object.
    #[must_use]
    pub fn declared_center(&self, object: &str) -> Option<&Arc<Declared>> {
        self.types.get(beside(object, CENTER).as_str())
    }

    /// The declared colour of an object.
    #[must_use]
    pub fn declared_colour(&self, object: &str) -> Option<&Arc<Declared>> {
        self.types.get(beside(object, COLOUR).as_str())
    }

    /// Whether a statement is what declares that kind of type of the subject now.
    #[must_use]
    pub fn declares(&self, subject: &str, kind: &GeometricType, definition: &Arc<Definition>) -> bool {
        self.types.get(&type_key(subject, kind)).is_some_and(|d| Arc::ptr_eq(&d.definition, definition))
    }

    /// Whether the name was set from outside.
    #[must_use]
    pub fn is_pinned(&self, name: &str) -> bool {
        self.pinned.contains(name)
    }

    /// What is kept for a definition.
    #[must_use]
    pub fn kept(&self, id: DefinitionId) -> Option<&Kept> {
        self.kept.get(&id)
    }

    /// Whether a definition is what one of its names means now.
    #[must_use]
    pub fn is_current(&self, definition: &Arc<Definition>) -> bool {
        definition.outputs.iter().any(|n| self.is_current_for(n, definition))
    }

    /// Whether a definition is what this name means now.
    #[must_use]
    pub fn is_current_for(&self, name: &str, definition: &Arc<Definition>) -> bool {
        self.names.get(name).is_some_and(|d| Arc::ptr_eq(d, definition))
    }

    /// Makes a definition known to what it reads and what it is linked to.
    pub fn register(&mut self, definition: &Arc<Definition>) {
        for (name, _) in &definition.reads {
            self.readers.entry(name.clone()).or_default().push(definition);
        }
        for link in definition.links() {
            self.dependents.entry(link.id).or_default().push(definition);
        }
    }

    /// Marks a definition as one whose value is to be found.
    pub fn add_stale(&mut self, definition: &Arc<Definition>) {
        self.stale.push(definition.clone());
    }

    /// How many are marked, for [`State::stale_truncate`].
    #[must_use]
    pub fn stale_len(&self) -> usize {
        self.stale.len()
    }

    /// Forgets the marks beyond a number.
    pub fn stale_truncate(&mut self, length: usize) {
        self.stale.truncate(length);
    }

    /// Gives its names a new definition; what depends on them is stale.
    pub fn define(&mut self, definition: &Arc<Definition>) {
        for name in &definition.outputs {
            self.apply(Change::Name(name.clone(), Some(definition.clone())));
        }
        self.push(Entry::Definition(definition.clone()));
    }

    /// Adds to the list of statements.
    pub fn push(&mut self, entry: Entry) {
        self.program.push(entry);
    }

    /// Puts another system of R-functions in force.
    pub fn set_system(&mut self, system: SystemInForce) {
        self.apply(Change::System(system));
    }

    /// Declares a geometric type. An object's levels, centre and colour stand side by side.
    pub fn declare(&mut self, subject: &str, declared: Declared) {
        let key = type_key(subject, &declared.kind);
        self.apply(Change::Type(key, Some(Arc::new(declared))));
    }

    /// Marks a name as set from outside.
    pub fn pin(&mut self, name: Name) {
        self.apply(Change::Pinned(name, true));
    }

    /// Forgets every definition, type and setting.
    pub fn clear(&mut self) {
        let names: Vec<Name> = self.names.keys().cloned().collect();
        let types: Vec<Name> = self.types.keys().cloned().collect();
        let pinned: Vec<Name> = self.pinned.iter().cloned().collect();
        names.into_iter().for_each(|name| self.apply(Change::Name(name, None)));
        types.into_iter().for_each(|subject| self.apply(Change::Type(subject, None)));
        pinned.into_iter().for_each(|name| self.apply(Change::Pinned(name, false)));
        self.set_system(SystemInForce::Plain);
        self.apply(Change::Program(0, Vec::new()));
    }

    /// Keeps the result of a definition.
    pub fn keep(&mut self, id: DefinitionId, kept: Kept) {
        let before = self.kept.insert(id, kept);
        self.journal.push(Change::Kept(id, before));
    }

    /// Remembers that the value of a definition is made with a Cartesian product of objects in these coordinates.
    pub fn note_product(&mut self, id: DefinitionId, sides: [Coordinates; 2]) {
        let all = self.products.entry(id).or_default();
        if all.len() < MOST_PRODUCTS && !all.contains(&sides) {
            self.journal.push(Change::Products(id, all.clone()));
            all.push(sides);
        }
    }

    /// The Cartesian products that the value of a definition is made with, each kind once.
    #[must_use]
    pub fn products(&self, id: DefinitionId) -> &[[Coordinates; 2]] {
        self.products.get(&id).map(Vec::as_slice).unwrap_or_default()
    }

    /// Drops the result of one definition for a while, so that it is found anew under other circumstances.
    pub fn forget(&mut self, id: DefinitionId) {
        if let Some(kept) = self.kept.remove(&id) {
            self.journal.push(Change::Kept(id, Some(kept)));
        }
    }

    /// Drops all results, since the graph that they point into goes; all that is live is to be found again.
    pub fn forget_all(&mut self) {
        self.kept.clear();
        self.products.clear();
        self.stale.extend(self.names.values().cloned());
        self.stale.extend(self.types.values().map(|d| d.definition.clone()));
    }

    /// Drops the results of definitions that no longer matter, once these are in the majority.
    fn sweep(&mut self) {
        if self.kept.len() > 1_000 + 2 * self.swept {
            let live = self.live();
            self.kept.retain(|id, _| live.contains(id));
            self.products.retain(|id, _| live.contains(id));
            self.swept = self.kept.len();
        }
    }

    /// Everything whose value depends on a name loses its kept result. What holds none has no dependent that holds one, so the walk
    /// stops there.
    pub fn invalidate(&mut self, name: &str) {
        let mut waiting: Vec<Arc<Definition>> = self.readers.get(name).map(|r| r.iter().collect()).unwrap_or_default();
        while let Some(definition) = waiting.pop() {
            let Some(kept) = self.kept.remove(&definition.id) else { continue };
            let products = self.products.remove(&definition.id).unwrap_or_default();
            self.journal.push(Change::Products(definition.id, products));
            self.journal.push(Change::Kept(definition.id, Some(kept)));
            for output in &definition.outputs {
                if self.is_current_for(output, &definition) {
                    waiting.extend(self.readers.get(output).into_iter().flat_map(Readers::iter));
                }
            }
            waiting.extend(self.dependents.get(&definition.id).into_iter().flat_map(Readers::iter));
            self.stale.push(definition);
        }
    }

    /// The definitions that read a name or continue one of its definitions.
    pub fn readers(&self, name: &str) -> impl Iterator<Item = Arc<Definition>> {
        self.readers.get(name).into_iter().flat_map(Readers::iter)
    }

    /// Whether a definition or a type that matters reads a name.
    #[must_use]
    pub fn is_read(&self, name: &str) -> bool {
        let mut readers = self.readers(name).peekable();
        // Most names of settings are read by nothing, so that what matters need not be found.
        readers.peek().is_some() && {
            let live = self.live();
            self.readers(name).any(|reader| live.contains(&reader.id))
        }
    }

    /// The definitions that are linked to this one: its extensions, and those whose operators use the system that it sets.
    pub fn dependents(&self, id: DefinitionId) -> impl Iterator<Item = Arc<Definition>> {
        self.dependents.get(&id).into_iter().flat_map(Readers::iter)
    }

    /// The definitions that lost their values or are new since the last call, each once.
    pub fn take_stale(&mut self) -> Vec<Arc<Definition>> {
        let mut seen = FxHashSet::default();
        let mut all = std::mem::take(&mut self.stale);
        all.retain(|d| seen.insert(d.id));
        all.sort_by_key(|d| d.id);
        all
    }

    fn apply(&mut self, mut change: Change) {
        self.swap(&mut change);
        self.journal.push(change);
    }

    /// Exchanges the state's value for the change's.
    fn swap(&mut self, change: &mut Change) {
        match change {
            Change::Name(name, definition) => {
                self.stale.extend(definition.clone());
                *definition = match definition.take() {
                    Some(new) => self.names.insert(name.clone(), new),
                    None => self.names.remove(name),
                };
                let name = name.clone();
                self.invalidate(&name);
            }
            Change::System(system) => std::mem::swap(&mut self.system, system),
            Change::Type(subject, declared) => {
                self.stale.extend(declared.iter().map(|d| d.definition.clone()));
                *declared = match declared.take() {
                    Some(new) => self.types.insert(subject.clone(), new),
                    None => self.types.remove(subject),
                };
            }
            Change::Pinned(name, pinned) => {
                let before = self.pinned.contains(name);
                if *pinned {
                    self.pinned.insert(name.clone());
                } else {
                    self.pinned.remove(name);
                }
                *pinned = before;
            }
            Change::Kept(id, kept) => {
                *kept = match kept.take() {
                    Some(value) => self.kept.insert(*id, value),
                    None => self.kept.remove(id),
                };
            }
            Change::Products(id, products) => std::mem::swap(self.products.entry(*id).or_default(), products),
            Change::Program(length, beyond) => {
                let end = self.program.len();
                let cut = self.program.split_off((*length).min(end));
                self.program.append(beyond);
                *beyond = cut;
            }
        }
    }

    /// Where an input begins: the marks that [`State::take_back`] and [`State::accept`] need.
    #[must_use]
    pub fn mark(&self) -> Mark {
        Mark { journal: self.journal.len(), program: self.program.len() }
    }

    /// Takes back everything since the mark.
    pub fn take_back(&mut self, mark: &Mark) {
        self.restore(mark.journal);
        self.program.truncate(mark.program);
        self.stale.clear();
    }

    /// The length of the journal, for [`State::restore`].
    #[must_use]
    pub fn moment(&self) -> usize {
        self.journal.len()
    }

    /// Takes back the changes since a moment, kept values included.
    pub fn restore(&mut self, moment: usize) {
        let changes = self.journal.split_off(moment.min(self.journal.len()));
        for mut change in changes.into_iter().rev() {
            if let Change::Name(name, definition) = change {
                // The values are put back one by one by the journal itself: nothing is to be invalidated.
                match definition {
                    Some(old) => self.names.insert(name, old),
                    None => self.names.remove(&name),
                };
            } else {
                self.swap(&mut change);
            }
        }
    }

    /// Closes an accepted input and gives the changes that undo it.
    pub fn accept(&mut self, mark: &Mark) -> Vec<Change> {
        let mut changes = self.journal.split_off(mark.journal.min(self.journal.len()));
        changes.retain(|c| !matches!(c, Change::Kept(..) | Change::Products(..)));
        if self.program.len() > mark.program {
            changes.push(Change::Program(mark.program, Vec::new()));
        }
        self.sweep();
        changes
    }

    /// Undoes an accepted input; afterwards the same list, given to [`State::redo`], does it again.
    pub fn undo(&mut self, changes: &mut [Change]) {
        changes.iter_mut().rev().for_each(|c| self.swap(c));
        self.journal.clear();
    }

    /// Does again what [`State::undo`] took back.
    pub fn redo(&mut self, changes: &mut [Change]) {
        changes.iter_mut().for_each(|c| self.swap(c));
        self.journal.clear();
    }

    /// The definitions that still matter: what the names mean now, the types, the system in force, and all that these stand on.
    #[must_use]
    pub fn live(&self) -> FxHashSet<DefinitionId> {
        let mut live = FxHashSet::default();
        let mut waiting: Vec<Arc<Definition>> = self.names.values().cloned().collect();
        waiting.extend(self.types.values().map(|d| d.definition.clone()));
        if let SystemInForce::Set(d) = &self.system {
            waiting.push(d.clone());
        }
        while let Some(definition) = waiting.pop() {
            if live.insert(definition.id) {
                waiting.extend(definition.links().cloned());
            }
        }
        live
    }
}

const CENTER: &str = "CENTER";
const COLOUR: &str = "COLOR";

/// Under which name a type is kept.
fn type_key(subject: &str, kind: &GeometricType) -> Name {
    match kind {
        GeometricType::Center(_) => beside(subject, CENTER).into(),
        GeometricType::Color(..) => beside(subject, COLOUR).into(),
        _ => subject.into(),
    }
}

/// A key that is no name.
fn beside(subject: &str, word: &str) -> String {
    format!("{subject} : {word}")
}

/// The beginning of an input.
#[derive(Clone, Copy, Debug)]
pub struct Mark {
    journal: usize,
    program: usize,
}
