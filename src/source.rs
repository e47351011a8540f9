//! Source texts and places in them. Knows no language and no disk: a text arrives with its name.

use std::sync::Arc;

/// The number of a text in its [`SourceMap`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SourceId(pub u32);

/// A range of bytes of one source text. `start <= end`, both on character boundaries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// The text.
    pub source: SourceId,
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

impl Span {
    /// The span of `start..end` in `source`.
    #[must_use]
    pub fn new(source: SourceId, start: usize, end: usize) -> Self {
        Self { source, start: clamp(start), end: clamp(end) }
    }

    /// The smallest span that holds both; `other` must be of the same text, else `self` comes back.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        if self.source != other.source {
            return self;
        }
        Self { source: self.source, start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// The bytes as a range for slicing.
    #[must_use]
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

fn clamp(offset: usize) -> u32 {
    u32::try_from(offset).unwrap_or(u32::MAX)
}

/// One source text: a file, an option's argument or an input at the prompt.
#[derive(Debug)]
pub struct Source {
    /// What messages call it: a path, `<input 3>`, `-D r1`.
    pub name: String,
    /// The whole text.
    pub text: String,
}

/// All texts of a session. Cheap to clone; texts are never removed, so that a span stays valid.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    sources: Vec<Arc<Source>>,
    shelf: Arc<[Source]>,
}

/// The number of the first text on the shelf; those that come one by one count from 0.
const SHELF: u32 = 1 << 31;

impl SourceId {
    /// The number of the text at this place of the shelf.
    #[must_use]
    pub fn on_shelf(place: usize) -> Self {
        Self(SHELF | clamp(place))
    }

    /// Whether the text came with the program and is nobody's input.
    #[must_use]
    pub fn is_on_shelf(self) -> bool {
        self.0 & SHELF != 0
    }
}

impl SourceMap {
    /// A map that has these texts before any comes, under numbers of their own: [`SourceId::on_shelf`].
    #[must_use]
    pub fn with_shelf(shelf: Arc<[Source]>) -> Self {
        Self { sources: Vec::new(), shelf }
    }

    /// Adds a text and gives its number.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> SourceId {
        let id = SourceId(clamp(self.sources.len()));
        self.sources.push(Arc::new(Source { name: name.into(), text: text.into() }));
        id
    }

    /// The text with that number.
    #[must_use]
    pub fn get(&self, id: SourceId) -> Option<&Source> {
        if id.is_on_shelf() {
            return self.shelf.get((id.0 & !SHELF) as usize);
        }
        self.sources.get(id.0 as usize).map(AsRef::as_ref)
    }

    /// The names of all texts that came, in their order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.sources.iter().map(|source| &*source.name)
    }

    /// The characters that a span covers; empty if the span is not of this map.
    #[must_use]
    pub fn text(&self, span: Span) -> &str {
        self.get(span.source).and_then(|s| s.text.get(span.range())).unwrap_or("")
    }

    /// Line and column (in characters) of the span's start, both counted from 1.
    #[must_use]
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        let before = self.get(span.source).and_then(|s| s.text.get(..span.start as usize)).unwrap_or("");
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    }
}
