//! The library: the files of `stdlib/`, embedded, in the order in which the prelude includes them. Names are found by a glance along the
//! lines; a file is parsed when one of its names is first asked for, once for all sessions. Never evaluates anything, and knows
//! nothing of what a user defines.

use std::sync::{Arc, LazyLock, OnceLock};

use indexmap::IndexMap;
use rustc_hash::FxHashMap;

use crate::diagnostic::Diagnostic;
use crate::limits::Limits;
use crate::source::{Source, SourceId, SourceMap};
use crate::syntax::tree::{Name, Statement, StatementKind};
use crate::syntax::{self, Mode};

use super::definition::{Definition, DefinitionId, SystemInForce};
use super::names;

mod files;

pub use files::{FILES, PRELUDE};

/// The library.
#[derive(Debug)]
pub struct Library {
    files: Vec<File>,
    /// The file of each name, in the order of the files.
    index: IndexMap<&'static str, usize>,
    shelf: Arc<[Source]>,
}

/// A file of the library and what it defines, once that was asked for.
#[derive(Debug)]
struct File {
    text: &'static str,
    parsed: OnceLock<Parsed>,
}

#[derive(Debug, Default)]
struct Parsed {
    names: FxHashMap<Name, Arc<Definition>>,
    diagnostics: Vec<Diagnostic>,
}

/// What the comment above a definition of the library says of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// `tr_shift(g, v)`
    pub signature: String,
    /// What it is, and what its parameters are.
    pub text: String,
    /// An expression that uses it, and its value as the prompt shows it.
    pub example: (String, String),
    /// Where it comes from: `[P95] (11)`; empty where it comes from nowhere.
    pub source: String,
    /// The file that it stands in, as `stdlib/shapes/solids.geo`.
    pub file: String,
}

static SHARED: LazyLock<Library> = LazyLock::new(|| Library::of(PRELUDE, FILES));

impl Library {
    /// The one library of the program.
    #[must_use]
    pub fn shared() -> &'static Self {
        &SHARED
    }

    /// The library of a prelude, whose lines include files by their names.
    fn of(prelude: &'static str, all: &[(&'static str, &'static str)]) -> Self {
        let included = prelude.lines().filter_map(|line| line.strip_prefix("INCLUDE \"")?.split('"').next());
        let files: Vec<(&str, &str)> =
            included.filter_map(|name| all.iter().find(|(known, _)| *known == name)).copied().collect();
        let mut index = IndexMap::default();
        for (file, (_, text)) in files.iter().enumerate() {
            defined(text).for_each(|name| {
                index.entry(name).or_insert(file);
            });
        }
        let shelf = files.iter().map(|(name, text)| Source { name: format!("stdlib/{name}"), text: (*text).into() });
        let shelf = shelf.collect();
        let files = files.into_iter().map(|(_, text)| File { text, parsed: OnceLock::new() }).collect();
        Self { files, index, shelf }
    }

    /// All its names, by file and within it in the order of the text.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.index.keys().copied()
    }

    /// Whether it defines the name.
    #[must_use]
    pub fn has(&self, name: &str) -> bool {
        self.index.contains_key(name)
    }

    /// A map of sources that has its texts on the shelf.
    #[must_use]
    pub fn sources(&self) -> SourceMap {
        SourceMap::with_shelf(self.shelf.clone())
    }

    /// The definition of a name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Arc<Definition>> {
        self.parsed(*self.index.get(name)?).names.get(name)
    }

    /// The text of the definition of a name.
    #[must_use]
    pub fn definition(&self, name: &str) -> Option<&'static str> {
        let span = self.get(name)?.statement.span;
        self.files[*self.index.get(name)?].text.get(span.range())
    }

    /// What there is to say of a name.
    #[must_use]
    pub fn entry(&self, name: &str) -> Option<Entry> {
        let definition = self.get(name)?;
        let file = self.shelf[*self.index.get(name)?].name.clone();
        Some(entry(&definition.statement, name, file))
    }

    /// The subjects, each with its names: the first line of each file says what it is about.
    #[must_use]
    pub fn subjects(&self) -> Vec<(&'static str, Vec<&'static str>)> {
        let of = |file: usize| self.index.iter().filter(move |(_, at)| **at == file).map(|(name, _)| *name).collect();
        let heading = |text: &'static str| text.lines().next().unwrap_or_default().trim_start_matches("//").trim();
        self.files.iter().enumerate().map(|(file, f)| (heading(f.text), of(file))).collect()
    }

    /// What is wrong with the library: nothing, or the tests say so.
    #[must_use]
    pub fn faults(&self) -> Vec<String> {
        let files = (0..self.files.len()).map(|file| self.parsed(file));
        let told = files.flat_map(|parsed| &parsed.diagnostics);
        told.map(|told| crate::diagnostic::render::short(told, &self.sources())).collect()
    }

    fn parsed(&self, file: usize) -> &Parsed {
        self.files[file].parsed.get_or_init(|| {
            let parsed = syntax::parse(&self.sources(), SourceId::on_shelf(file), &Limits::default(), Mode::Script);
            let mut all = Parsed { diagnostics: parsed.diagnostics, ..Parsed::default() };
            let mut system = SystemInForce::Plain;
            for (place, statement) in parsed.statements.into_iter().enumerate() {
                let StatementKind::Define { name, .. } = &statement.kind else { continue };
                let name = name.name.clone();
                let definition = Arc::new(definition(statement, DefinitionId::of_library(file, place), &system));
                if names::is_system(&name) {
                    system = SystemInForce::Set(definition);
                } else {
                    all.names.insert(name, definition);
                }
            }
            all
        })
    }
}

fn definition(statement: Statement, id: DefinitionId, system: &SystemInForce) -> Definition {
    let said = names::of_statement(&statement);
    let outputs = match &statement.kind {
        StatementKind::Define { name, .. } => vec![name.name.clone()],
        _ => Vec::new(),
    };
    Definition {
        id,
        outputs,
        bases: Vec::new(),
        reads: said.reads,
        system: system.clone(),
        uses_system: said.uses_system,
        statement,
    }
}

/// The names at the beginnings of lines, in front of a `(` or a `=`: that is where the library's definitions stand.
fn defined(text: &'static str) -> impl Iterator<Item = &'static str> {
    text.lines().filter_map(|line| {
        let end = line.find(|c: char| !c.is_ascii_alphanumeric() && c != '_')?;
        let rest = line[end..].trim_start();
        let is_name = end > 0 && (rest.starts_with('(') || rest.starts_with('=')) && !names::is_system(&line[..end]);
        is_name.then_some(&line[..end])
    })
}

/// The comment above a definition: paragraphs, then `Example: EXPRESSION // VALUE`, then `Source: WORDS`.
fn entry(statement: &Statement, name: &str, file: String) -> Entry {
    let signature = match &statement.kind {
        StatementKind::Define { parameters: Some(parameters), .. } => {
            let names: Vec<&str> = parameters.iter().map(|p| &*p.name.name).collect();
            format!("{name}({})", names.join(", "))
        }
        _ => name.to_owned(),
    };
    let (text, rest) = statement.doc.split_once("Example:").unwrap_or((&statement.doc, ""));
    let (example, source) = rest.split_once("Source:").unwrap_or((rest, ""));
    let (expression, value) = example.split_once("//").unwrap_or((example, ""));
    let joined = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    Entry { signature, text: joined(text), example: (joined(expression), joined(value)), source: joined(source), file }
}
