//! The names of a part that did not parse, from its tokens alone: what it would define and what it would read. Never certain, so
//! that what may be bound in the part itself is left out.

use rustc_hash::FxHashSet;

use super::place::{Place, definition_head};
use crate::source::Span;
use crate::syntax::scan::{Token, TokenKind, coordinate_digits, is_reserved};
use crate::syntax::tree::{Ident, Name};

/// The names that the statements of a part would define, each once, in order. Only heads at the start of the part, of a
/// line, after `;`, BEGIN, THEN, ELSE and DO count, so that a comparison is not taken for a definition.
pub fn defined_names(place: Place<'_>) -> Vec<Name> {
    let tokens = place.tokens();
    let mut names: Vec<Name> = Vec::new();
    let mut seen = FxHashSet::default();
    for (at, _) in heads(place, &tokens) {
        let word = tokens[at].text(place.text);
        if coordinate_digits(word).is_none() && seen.insert(word) {
            names.push(Name::from(word));
        }
    }
    names
}

/// The definitions of a part: the token of the name, and the one after the `=`.
fn heads(place: Place<'_>, tokens: &[Token]) -> Vec<(usize, usize)> {
    let mut heads = Vec::new();
    let mut skip_to = 0;
    for (at, token) in tokens.iter().enumerate() {
        let begins = match at.checked_sub(1).map(|before| tokens[before]) {
            None => true,
            Some(before) if before.kind == TokenKind::Semicolon => true,
            Some(before) if before.kind == TokenKind::Word => {
                let word = before.text(place.text);
                ["BEGIN", "THEN", "ELSE", "DO"].iter().any(|k| k.eq_ignore_ascii_case(word))
            }
            Some(before) => place.line_between(before.end, token.start),
        };
        if !begins || at < skip_to {
            continue;
        }
        if let Some(after) = definition_head(place.text, tokens, at) {
            skip_to = after;
            heads.push((at, after));
        }
    }
    heads
}

/// The names that the words of a part before byte `sure` would read from outside, each once with its first place; and the
/// condition, if the part is a WHILE.
///
/// What is defined in the part, its parameters and whatever a `=` follows (the index of a fold, a name of WHERE) may be its own.
pub fn read_names(place: Place<'_>, sure: usize) -> (Vec<Ident>, Option<Span>) {
    let tokens = place.tokens();
    let text = place.text;
    if tokens.get(1).is_some_and(|t| t.text(text) == ":") {
        return (Vec::new(), None);
    }
    let heads = heads(place, &tokens);
    // What is no definition and begins with no keyword may be anything.
    if heads.is_empty() && !tokens.first().is_some_and(|t| is_reserved(t.text(text))) {
        return (Vec::new(), None);
    }
    let in_head = |at: usize| heads.iter().any(|(from, to)| (*from..*to).contains(&at));
    let binds = |at: usize| in_head(at) || tokens.get(at + 1).is_some_and(|t| t.text(text) == "=");
    let words = || tokens.iter().enumerate().filter(|(_, t)| t.kind == TokenKind::Word);
    let bound: FxHashSet<&str> = words().filter(|(at, _)| binds(*at)).map(|(_, t)| t.text(text)).collect();
    let mut seen = FxHashSet::default();
    let mut reads = Vec::new();
    for (at, token) in words().filter(|(_, t)| t.end <= sure) {
        let word = token.text(text);
        if !in_head(at) && !bound.contains(word) && is_name(word) && seen.insert(word) {
            reads.push(Ident { name: Name::from(word), span: place.span(*token) });
        }
    }
    (reads, condition(place, &tokens).filter(|c| c.end as usize <= sure))
}

fn is_name(word: &str) -> bool {
    let special = ["PI", "INFINITY", "STEP"].iter().any(|w| w.eq_ignore_ascii_case(word));
    !special && !is_reserved(word) && coordinate_digits(word).is_none()
}

fn condition(place: Place<'_>, tokens: &[Token]) -> Option<Span> {
    tokens.first().filter(|t| t.is_word(place.text, "WHILE"))?;
    let end = tokens.iter().position(|t| t.is_word(place.text, "DO"))?;
    let (first, last) = (tokens.get(1)?, tokens.get(end.checked_sub(1)?)?);
    (first.start < last.end).then(|| place.range(first.start, last.end))
}
