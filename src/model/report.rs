//! Questions about definitions: what depends on what, documentation, and the script that `:save` writes. Evaluates nothing.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustc_hash::FxHashSet;

use crate::field::Coordinates;
use crate::host::{Host, resolve, seen_from};
use crate::source::SourceMap;
use crate::syntax::scan::{Scanner, Token, TokenKind};
use crate::syntax::tree::StatementKind;

use super::definition::{Definition, DefinitionId, SystemInForce};
use super::names;
use super::session::{Deps, sorted};
use super::state::{Entry, State};

/// Both directions of a name's dependencies.
pub fn deps(state: &State, name: &str) -> Option<Deps> {
    let mut reads = state.get(name).map(reads);
    reads.iter_mut().for_each(|all| all.retain(|n| !state.is_library(n)));
    let live = state.live();
    let mut readers = Vec::new();
    let mut seen: FxHashSet<DefinitionId> = FxHashSet::default();
    let mut waiting: Vec<Arc<Definition>> = state.readers(name).collect();
    while let Some(definition) = waiting.pop() {
        if !live.contains(&definition.id) || !seen.insert(definition.id) {
            continue;
        }
        for output in &definition.outputs {
            if state.is_current_for(output, &definition) {
                readers.push(output.to_string());
                waiting.extend(state.readers(output));
            }
        }
        waiting.extend(state.dependents(definition.id));
    }
    match reads {
        None if readers.is_empty() => None,
        reads => Some(Deps { reads: reads.unwrap_or_default(), readers: sorted(readers) }),
    }
}

/// The names that a definition and those that it continues read, and those of the system in force.
fn reads(definition: &Arc<Definition>) -> Vec<String> {
    let mut all = Vec::new();
    let mut seen = FxHashSet::default();
    let mut waiting = vec![definition.clone()];
    while let Some(definition) = waiting.pop() {
        if seen.insert(definition.id) {
            all.extend(definition.reads.iter().map(|(n, _)| n.to_string()));
            waiting.extend(definition.links().cloned());
        }
    }
    sorted(all)
}

/// The sides of each Cartesian product that a definition and those that it continues are made with.
pub fn products(state: &State, name: &str) -> Vec<[Coordinates; 2]> {
    let mut all = Vec::new();
    let mut next = state.get(name);
    while let Some(definition) = next {
        for sides in state.products(definition.id) {
            if !all.contains(sides) {
                all.push(*sides);
            }
        }
        next = definition.bases.iter().find(|(n, _)| &**n == name).and_then(|(_, base)| base.as_ref());
    }
    all
}

/// The comment above a definition or above the one that it continues.
pub fn doc(state: &State, name: &str) -> Option<String> {
    let mut definition = state.get(name)?;
    loop {
        if !definition.statement.doc.is_empty() {
            return Some(definition.statement.doc.to_string());
        }
        let base = definition.bases.iter().find(|(n, _)| &**n == name)?;
        definition = base.1.as_ref()?;
    }
}

/// The text of a definition and of what it continues, oldest first.
pub fn definition(state: &State, sources: &SourceMap, name: &str) -> Option<String> {
    let mut parts = Vec::new();
    let mut next = state.get(name);
    while let Some(definition) = next {
        parts.push(text(definition, sources));
        next = definition.bases.iter().find(|(n, _)| &**n == name).and_then(|(_, base)| base.as_ref());
    }
    parts.reverse();
    Some(parts.join("\n"))
}

fn text(definition: &Definition, sources: &SourceMap) -> String {
    let text = sources.text(definition.statement.span).trim_end();
    if text.ends_with(';') { text.to_owned() } else { format!("{text};") }
}

/// What a text needs when it moves to another file.
pub struct Move<'a> {
    /// The disk, for folders.
    pub host: &'a dyn Host,
    /// The folder of the new file; none is the current one.
    pub folder: Option<&'a Path>,
    /// The data files that were read.
    pub known: &'a [PathBuf],
    /// The folders of all texts, each once: a file that is handed to a function is looked for beside the function.
    pub folders: &'a [PathBuf],
}

impl Move<'_> {
    /// The statement of a definition with its data files named as seen from the new folder: those that were read, and what stands as the
    /// file of a built-in.
    fn text(&self, definition: &Definition, sources: &SourceMap) -> String {
        let text = text(definition, sources);
        let own = sources.get(definition.statement.span.source).map(|source| PathBuf::from(&source.name));
        let (mut moved, mut end) = (String::new(), 0);
        let tokens: Vec<Token> = Scanner::new(&text, 0, text.len()).collect();
        for (k, token) in tokens.iter().enumerate().filter(|(_, token)| token.kind == TokenKind::Text) {
            let words = text[token.start..token.end].trim_matches('"');
            let before = |back: usize, word: &str| k >= back && tokens[k - back].is_word(&text, word);
            let is_file = before(4, "INTERPOLATE") || before(2, "MESH") || before(2, "HEIGHT");
            let path = resolve(own.as_deref(), Path::new(words));
            let beside = self.folders.iter().map(|folder| folder.join(words));
            let Some(path) = [path].into_iter().chain(beside).find(|path| is_file || self.known.contains(path)) else {
                continue;
            };
            moved += &text[end..token.start];
            let _ = write!(moved, "\"{}\"", seen_from(self.host, self.folder, &path).display());
            end = token.end;
        }
        moved + &text[end..]
    }
}

/// A script that defines the same again: the statements that still matter in their order, with their comments, and the system of
/// R-functions where it changes.
pub fn save(state: &State, sources: &SourceMap, to: &Move<'_>) -> String {
    let live = state.live();
    let mut out = String::new();
    let mut wanted = SystemInForce::Plain;
    let mut written = SystemInForce::Plain;
    for entry in state.program() {
        let definition = match entry {
            Entry::Restore(system) => {
                wanted = system.clone();
                continue;
            }
            Entry::Definition(definition) => definition,
        };
        if is_system(definition) {
            wanted = SystemInForce::Set(definition.clone());
            continue;
        }
        let type_stands = match &definition.statement.kind {
            StatementKind::Type { subject, kind } => state.declares(&subject.name, kind, definition),
            _ => live.contains(&definition.id),
        };
        if !type_stands {
            continue;
        }
        if definition.uses_system && !same(&wanted, &written) {
            write_system(&mut out, &wanted, sources, to);
            written = wanted.clone();
        }
        write_definition(&mut out, definition, sources, to);
    }
    if !same(&wanted, &written) {
        write_system(&mut out, &wanted, sources, to);
    }
    out
}

fn is_system(definition: &Definition) -> bool {
    definition.outputs.first().is_some_and(|n| names::is_system(n))
}

fn same(a: &SystemInForce, b: &SystemInForce) -> bool {
    match (a, b) {
        (SystemInForce::Plain, SystemInForce::Plain) => true,
        (SystemInForce::Set(a), SystemInForce::Set(b)) => Arc::ptr_eq(a, b),
        _ => false,
    }
}

/// Writes the statement that sets a system, and those above that its formula reads.
fn write_system(out: &mut String, system: &SystemInForce, sources: &SourceMap, to: &Move<'_>) {
    let mut chain = Vec::new();
    let mut next = system;
    while let SystemInForce::Set(definition) = next {
        chain.push(definition);
        if !definition.uses_system {
            break;
        }
        next = &definition.system;
    }
    if chain.last().is_none_or(|d| d.uses_system) {
        out.push_str("r_alpha = 0;\n");
    }
    chain.iter().rev().for_each(|definition| write_definition(out, definition, sources, to));
}

fn write_definition(out: &mut String, definition: &Definition, sources: &SourceMap, to: &Move<'_>) {
    let doc = definition.statement.doc.trim();
    if !doc.is_empty() && !doc.contains('}') {
        let _ = writeln!(out, "{{ {doc} }}");
    } else {
        doc.lines().for_each(|line| {
            let _ = writeln!(out, "// {}", line.trim());
        });
    }
    out.push_str(&to.text(definition, sources));
    out.push('\n');
}
