//! Messages about a text's shape: size, characters, brackets, blocks, comments and texts that nothing closes.

use super::names::defined_names;
use super::place::Place;
use crate::diagnostic::{Category, Diagnostic};
use crate::limits::Limits;
use crate::source::{SourceId, Span};
use crate::syntax::split::{Fault, FaultKind};

/// What keeps a text from being read at all: it is too large, or it is not a text.
pub fn refuse(text: &str, id: SourceId, limits: &Limits) -> Option<Diagnostic> {
    if text.len() > limits.source_bytes.min(u32::MAX as usize - 1) {
        let title = format!("the text has {} bytes; at most {} can be read", text.len(), limits.source_bytes);
        return Some(Diagnostic::error("source-too-large", title).at(Span::new(id, 0, 0), ""));
    }
    let nul = text.find('\0')?;
    let title = "this is not a text: it holds bytes that are no characters";
    let help = "a script is plain text; data files are read by INTERPOLATE and its like";
    Some(Diagnostic::error("not-a-text", title).at(Span::new(id, nul, nul + 1), "a NUL byte").help(help))
}

/// The text is nested deeper than the limit.
pub fn too_deep(span: Span, limits: &Limits) -> Diagnostic {
    let title = format!("brackets, blocks and operators are nested deeper than {} levels", limits.nesting);
    let help = "give the inner parts names of their own: name = part;";
    Diagnostic::error("nested-too-deep", title).at(span, "here").help(help)
}

/// How many errors were left out.
pub fn more_errors(count: usize) -> Diagnostic {
    let noun = if count == 1 { "message" } else { "messages" };
    Diagnostic::note("more-errors", format!("{count} more {noun} of this input are not shown"))
}

/// The message about one fault of a statement.
pub fn fault(place: Place<'_>, fault: Fault) -> Diagnostic {
    let span = place.range(fault.start, fault.end);
    let found = &place.text[fault.start..fault.end];
    match fault.kind {
        FaultKind::StrayClose => stray(place, span, found),
        FaultKind::Mismatch(open) => {
            let opener = &place.text[open..=open];
            let wanted = closing(opener);
            Diagnostic::error("mismatched-bracket", format!("`{found}` cannot close `{opener}`"))
                .at(span, format!("`{wanted}` is expected here"))
                .see(place.range(open, open + 1), "opened here")
                .help(format!("write `{wanted}`, or close `{opener}` before"))
        }
        FaultKind::Unclosed(end) => {
            let wanted = closing(found);
            Diagnostic::error("unclosed-bracket", format!("this `{found}` is never closed"))
                .at(span, "opened here")
                .see(place.range(end, end + usize::from(end < place.text.len())), "the statement ends here")
                .help(format!("add the `{wanted}` where it belongs, at the latest before the end of the statement"))
        }
        FaultKind::UnclosedBlock => Diagnostic::error("unclosed-block", "this BEGIN has no END")
            .at(span, "opened here")
            .help("add `END;` behind the last statement of the block"),
        FaultKind::StrayEnd => Diagnostic::error("stray-end", "this END closes nothing")
            .at(span, "no BEGIN is open here")
            .help("remove it, or add the BEGIN that it should close"),
        FaultKind::UnclosedComment => Diagnostic::error("unclosed-comment", "this comment is never closed")
            .at(place.range(fault.start, fault.start + 1), "opened here")
            .help("add `}` where the comment ends"),
        FaultKind::UnclosedText => Diagnostic::error("unclosed-text", "this text is not closed on its line")
            .at(place.range(fault.start, fault.start + 1), "opened here")
            .help("add `\"` where the text ends"),
        FaultKind::Bad | FaultKind::TooDeep => bad(place, span, found),
    }
    .category(Category::Program)
}

fn closing(opener: &str) -> &'static str {
    if opener == "[" { "]" } else { ")" }
}

fn stray(place: Place<'_>, span: Span, found: &str) -> Diagnostic {
    let opener = if found == "]" { "[" } else { "(" };
    let whole = Place { end: span.start as usize, ..place };
    let help = match defined_names(whole).last() {
        Some(name) => format!("remove it, or add the `{opener}` that it should close, maybe right behind `{name} =`"),
        None => format!("remove it, or add the `{opener}` that it should close"),
    };
    Diagnostic::error("stray-bracket", format!("this `{found}` closes nothing"))
        .at(span, format!("no `{opener}` is open here"))
        .help(help)
}

/// A character that the language does not know, with what may be meant.
fn bad(place: Place<'_>, span: Span, found: &str) -> Diagnostic {
    if place.tokens().first().is_some_and(|t| t.is_word(place.text, "INCLUDE")) {
        return super::stop::include_form(span);
    }
    let behind_name = place.text[..span.start as usize].ends_with(|c: char| c.is_alphabetic() || c == '_');
    let meant = match found {
        "\u{2212}" | "\u{2013}" | "\u{2014}" | "\u{2010}" | "\u{2011}" => "`-`",
        "\u{d7}" | "\u{b7}" | "\u{22c5}" => "`*`",
        "\u{f7}" => "`/`",
        "\u{2264}" => "`<=`",
        "\u{2265}" => "`>=`",
        "\u{2260}" => "`<>`",
        "\u{201c}" | "\u{201d}" | "\u{201e}" | "'" | "\u{2018}" | "\u{2019}" | "`" => "`\"` around a text",
        "\u{222a}" | "\u{2228}" => "`|`, the union",
        "\u{2229}" | "\u{2227}" => "`&`, the intersection",
        "\u{ac}" | "!" => "NOT, or `~` for the complement of an object",
        "%" => "MOD(a, b) for the remainder",
        "#" => "`// ...` or `{ ... }` for a comment",
        "}" => "`{` where the comment begins",
        "." if behind_name => "`_` in a name, or `[i]` for an element",
        "." => "a digit before or after the point",
        "?" => "IF c THEN a ELSE b",
        "\u{b2}" => "`**2`",
        "\u{b3}" => "`**3`",
        "\u{221a}" => "SQRT(...)",
        _ => "",
    };
    let shown = if found.chars().all(char::is_control) { found.escape_unicode().to_string() } else { found.to_owned() };
    let error = Diagnostic::error("unknown-character", format!("`{shown}` means nothing here")).at(span, "");
    match meant {
        "" => error.help("remove it"),
        _ => error.help(format!("write {meant}")),
    }
}

/// One message for brackets of one statement that stay open, and at most a few of the others.
pub fn gather(diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let mut gathered: Vec<Diagnostic> = Vec::new();
    for diagnostic in diagnostics {
        let same = gathered.iter_mut().find(|d| d.code == diagnostic.code && d.code == "unclosed-bracket");
        match same {
            Some(first) if first.labels.len() < 5 => {
                "these brackets are never closed".clone_into(&mut first.title);
                first.labels.extend(diagnostic.labels.into_iter().filter(|l| l.primary));
            }
            Some(_) => {}
            None => gathered.push(diagnostic),
        }
    }
    gathered
}
