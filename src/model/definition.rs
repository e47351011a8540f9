//! One statement of the model: a formula, what it stands on and what it reads. Immutable, linked by `Arc`; holds no value.

use std::sync::Arc;

use crate::source::Span;
use crate::syntax::tree::{Name, Statement, StatementKind};

/// A definition's number; never used twice in a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DefinitionId(pub u64);

/// The numbers of the library's definitions begin here: every session knows the same ones.
const LIBRARY: u64 = 1 << 63;

impl DefinitionId {
    /// The number of the definition at that place of that file of the library.
    #[must_use]
    pub fn of_library(file: usize, place: usize) -> Self {
        Self(LIBRARY | (file as u64) << 32 | place as u64)
    }
}

/// The system of R-functions in force where a statement stands; the formula is live.
#[derive(Clone, Debug, Default)]
pub enum SystemInForce {
    /// `r_alpha = 0`, nothing was set.
    #[default]
    Plain,
    /// Set by this `r_alpha = ...` or `r_m = ...`.
    Set(Arc<Definition>),
}

/// A statement that defines: one name, or the names that a loop or an IF assigns.
#[derive(Debug)]
pub struct Definition {
    /// Its number.
    pub id: DefinitionId,
    /// The formula.
    pub statement: Statement,
    /// The names that it defines; a plain definition has one, a bare expression or PRINT none.
    pub outputs: Vec<Name>,
    /// For each name that it continues, the definition just above.
    pub bases: Vec<(Name, Option<Arc<Definition>>)>,
    /// The names that mean whatever they are defined to be when asked, each with its first place.
    pub reads: Vec<(Name, Span)>,
    /// The system in force above it.
    pub system: SystemInForce,
    /// Whether the value depends on that system.
    pub uses_system: bool,
}

impl Definition {
    /// Whether it continues the definition above of its own name.
    #[must_use]
    pub fn extends(&self) -> bool {
        !self.bases.is_empty()
    }

    /// The definitions that it is linked to whatever is defined later: its bases and its system.
    pub fn links(&self) -> impl Iterator<Item = &Arc<Self>> {
        let system = match &self.system {
            SystemInForce::Set(definition) if self.uses_system => Some(definition),
            _ => None,
        };
        self.bases.iter().filter_map(|(_, base)| base.as_ref()).chain(system)
    }

    /// The place to underline: the defined name, or the whole statement.
    #[must_use]
    pub fn place(&self) -> Span {
        match &self.statement.kind {
            StatementKind::Define { name, .. } | StatementKind::Element { name, .. } => name.span,
            _ => self.statement.span,
        }
    }

    /// Whether it is one of the library's, which see the library's names only.
    #[must_use]
    pub fn is_library(&self) -> bool {
        self.id.0 & LIBRARY != 0
    }

    /// Whether it has parameters.
    #[must_use]
    pub fn is_function(&self) -> bool {
        matches!(&self.statement.kind, StatementKind::Define { parameters: Some(_), .. })
    }

    /// What messages call it: its name, or the kind of statement.
    #[must_use]
    pub fn title(&self) -> String {
        match (&self.outputs[..], &self.statement.kind) {
            ([name], _) => format!("`{name}`"),
            ([], _) => "the expression".to_owned(),
            (_, StatementKind::While { .. } | StatementKind::For { .. }) => "the loop".to_owned(),
            _ => "the statement".to_owned(),
        }
    }
}

impl Drop for Definition {
    /// A chain of a hundred thousand extensions would overflow the stack if each dropped the next.
    fn drop(&mut self) {
        let mut waiting: Vec<Arc<Self>> = Vec::new();
        unlink(self, &mut waiting);
        while let Some(link) = waiting.pop() {
            if let Some(mut last) = Arc::into_inner(link) {
                unlink(&mut last, &mut waiting);
            }
        }
    }
}

fn unlink(definition: &mut Definition, waiting: &mut Vec<Arc<Definition>>) {
    waiting.extend(definition.bases.drain(..).filter_map(|(_, base)| base));
    if let SystemInForce::Set(system) = std::mem::take(&mut definition.system) {
        waiting.push(system);
    }
}
