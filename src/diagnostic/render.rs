//! Diagnostics as text: for people, one line each for editors, JSON for programs. Gives strings; never prints.

use annotate_snippets::{Annotation, AnnotationKind, Element, Group, Level, Renderer, Snippet};
use serde::Serialize;

use super::{Category, Diagnostic, Label, Severity};
use crate::source::{Source, SourceId, SourceMap, Span};

/// Whether a rendering for people may use colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// No escape sequences.
    Plain,
    /// Escape sequences of a terminal.
    Ansi,
}

/// Columns that a rendering for people fills before it cuts a line of the source.
const WIDTH: usize = 120;

impl Severity {
    /// `error`, `warning` or `note`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

impl Category {
    /// `result`, `usage`, `program`, `file` or `cancelled`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Result => "result",
            Self::Usage => "usage",
            Self::Program => "program",
            Self::File => "file",
            Self::Cancelled => "cancelled",
        }
    }
}

/// For people: title, the lines with the place underlined, what to do, what explains it. Ends with a line's end.
#[must_use]
pub fn human(diagnostic: &Diagnostic, sources: &SourceMap, colour: Colour) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let mut group =
        level.primary_title(diagnostic.title.as_str()).id(diagnostic.code).elements(Vec::<Element<'_>>::new());
    for (source, labels) in by_source(diagnostic, sources) {
        group = group.element(snippet(source, &labels));
    }
    group = messages(group, &Level::HELP, &diagnostic.help);
    group = messages(group, &Level::NOTE, &diagnostic.notes);
    let renderer = match colour {
        Colour::Plain => Renderer::plain(),
        Colour::Ansi => Renderer::styled(),
    };
    format!("{}\n", renderer.term_width(WIDTH).render(&[group]))
}

fn messages<'a>(group: Group<'a>, level: &Level<'a>, texts: &'a [String]) -> Group<'a> {
    texts.iter().fold(group, |group, text| group.element(level.clone().message(text.as_str())))
}

/// The labels of each source text, that of the message first.
fn by_source<'d, 's>(diagnostic: &'d Diagnostic, sources: &'s SourceMap) -> Vec<(&'s Source, Vec<&'d Label>)> {
    let mut order: Vec<SourceId> = place(diagnostic).into_iter().map(|span| span.source).collect();
    for label in &diagnostic.labels {
        if !order.contains(&label.span.source) {
            order.push(label.span.source);
        }
    }
    let labels = |id| diagnostic.labels.iter().filter(|l| l.span.source == id).collect();
    order.into_iter().filter_map(|id| sources.get(id).map(|source| (source, labels(id)))).collect()
}

/// The place of the message: its first primary label, else its first.
fn place(diagnostic: &Diagnostic) -> Option<Span> {
    let primary = diagnostic.labels.iter().find(|l| l.primary);
    primary.or(diagnostic.labels.first()).map(|l| l.span)
}

/// Only the lines from the first label to the last are handed over, so that the cost does not grow with the text.
fn snippet<'s>(source: &'s Source, labels: &[&'s Label]) -> Snippet<'s, Annotation<'s>> {
    let text = source.text.as_str();
    let first = labels.iter().map(|l| bounded(text, l.span).start).min().unwrap_or(0);
    let last = labels.iter().map(|l| bounded(text, l.span).end).max().unwrap_or(0);
    let start = text[..first].rfind('\n').map_or(0, |n| n + 1);
    let end = text[last..].find('\n').map_or(text.len(), |n| last + n);
    let annotation = |label: &&'s Label| {
        let range = bounded(text, label.span);
        let kind = if label.primary { AnnotationKind::Primary } else { AnnotationKind::Context };
        let annotation = kind.span(range.start - start..range.end - start);
        if label.text.is_empty() { annotation } else { annotation.label(label.text.as_str()) }
    };
    Snippet::source(&text[start..end])
        .path(source.name.as_str())
        .line_start(text[..start].matches('\n').count() + 1)
        .annotations(labels.iter().map(annotation))
}

/// A line of the source with a place in it underlined, for texts that are no messages: two lines, the first with the file's name and
/// the line's number. A place of several lines is underlined to the end of its first.
#[must_use]
pub fn excerpt(span: Span, sources: &SourceMap) -> String {
    let Some(source) = sources.get(span.source) else { return String::new() };
    let text = source.text.as_str();
    let range = bounded(text, span);
    let start = text[..range.start].rfind('\n').map_or(0, |n| n + 1);
    let end = text[start..].find('\n').map_or(text.len(), |n| start + n);
    let line = text[start..end].trim_end();
    let indent = line.len() - line.trim_start().len();
    let head = format!("{}:{}: ", source.name, sources.line_column(span).0);
    let columns = |text: &str| text.chars().count();
    let before = columns(&head) + columns(text[start..range.start].get(indent..).unwrap_or_default());
    let marks = columns(&text[range.start..range.end.min(start + line.len()).max(range.start)]).max(1);
    format!("{head}{}\n{}{}", line.trim_start(), " ".repeat(before), "^".repeat(marks))
}

/// The bytes of a span, moved inward to what the text really has.
fn bounded(text: &str, span: Span) -> std::ops::Range<usize> {
    let floor = |at: u32| {
        let mut at = (at as usize).min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = floor(span.start);
    start..floor(span.end).max(start)
}

/// One line: `file:line:column: error[code]: title`, without the line's end.
#[must_use]
pub fn short(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let message = format!("{}[{}]: {}", diagnostic.severity.word(), diagnostic.code, diagnostic.title);
    match place(diagnostic).and_then(|span| sources.get(span.source).map(|source| (span, source))) {
        Some((span, source)) => {
            let (line, column) = sources.line_column(span);
            format!("{}:{line}:{column}: {message}", source.name)
        }
        None => message,
    }
}

#[derive(Serialize)]
struct JsonPlace<'a> {
    file: &'a str,
    line: usize,
    column: usize,
    end_line: usize,
    end_column: usize,
    start: u32,
    end: u32,
}

#[derive(Serialize)]
struct JsonLabel<'a> {
    text: &'a str,
    primary: bool,
    #[serde(flatten)]
    place: Option<JsonPlace<'a>>,
}

#[derive(Serialize)]
struct JsonDiagnostic<'a> {
    code: &'a str,
    severity: &'a str,
    category: &'a str,
    title: &'a str,
    #[serde(flatten)]
    place: Option<JsonPlace<'a>>,
    labels: Vec<JsonLabel<'a>>,
    help: &'a [String],
    notes: &'a [String],
}

fn json_place(span: Span, sources: &SourceMap) -> Option<JsonPlace<'_>> {
    let source = sources.get(span.source)?;
    let (line, column) = sources.line_column(span);
    let (end_line, end_column) = sources.line_column(Span { start: span.end, ..span });
    Some(JsonPlace { file: &source.name, line, column, end_line, end_column, start: span.start, end: span.end })
}

fn json_label<'a>(label: &'a Label, sources: &'a SourceMap) -> JsonLabel<'a> {
    JsonLabel { text: &label.text, primary: label.primary, place: json_place(label.span, sources) }
}

/// One JSON object on one line, without the line's end: `code`, `severity`, `category`, `title`, the place as `file`,
/// `line`, `column`, `end_line`, `end_column` (characters, from 1) and `start`, `end` (bytes, from 0), `labels` (each
/// with `text`, `primary` and a place), `help`, `notes`. The place is left out where a message has none.
#[must_use]
pub fn json(diagnostic: &Diagnostic, sources: &SourceMap) -> String {
    let whole = JsonDiagnostic {
        code: diagnostic.code,
        severity: diagnostic.severity.word(),
        category: diagnostic.category.word(),
        title: &diagnostic.title,
        place: place(diagnostic).and_then(|span| json_place(span, sources)),
        labels: diagnostic.labels.iter().map(|l| json_label(l, sources)).collect(),
        help: &diagnostic.help,
        notes: &diagnostic.notes,
    };
    serde_json::to_string(&whole).unwrap_or_default()
}
