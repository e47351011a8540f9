//! How a line looks while it is typed: the colour of each word, and the bracket that belongs to the one at the cursor.
//! It never says what is right or wrong; that is `syntax`.

use std::ops::Range;

use crate::builtins;
use crate::syntax::scan::{Scanner, Token, TokenKind, coordinate_digits, is_reserved};

/// What a piece of text looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// `{ ... }`, `// ...`
    Comment,
    /// `"..."`
    Text,
    /// `1.5e-3`
    Number,
    /// `WHILE`
    Keyword,
    /// `SIN(`
    Builtin,
    /// `x4`
    Coordinate,
    /// `gob_a`, `pob_ball`, `tr_twist`, `rel_in`
    Object,
    /// Names, operators, blanks.
    Plain,
}

/// The pieces of a text, without gaps.
#[must_use]
pub fn pieces(text: &str) -> Vec<(Look, Range<usize>)> {
    let mut pieces = Vec::new();
    let mut end = 0;
    for token in Scanner::new(text, 0, text.len()) {
        if end < token.start {
            pieces.push((Look::Plain, end..token.start));
        }
        pieces.push((look(text, token), token.start..token.end));
        end = token.end;
    }
    if end < text.len() {
        pieces.push((Look::Plain, end..text.len()));
    }
    pieces
}

fn look(text: &str, token: Token) -> Look {
    match token.kind {
        TokenKind::Comment | TokenKind::UnclosedComment => Look::Comment,
        TokenKind::Text | TokenKind::UnclosedText => Look::Text,
        TokenKind::Number => Look::Number,
        TokenKind::Word => word(token.text(text), &text[token.end..]),
        _ => Look::Plain,
    }
}

fn word(word: &str, rest: &str) -> Look {
    let prefixed = ["gob_", "pob_", "tr_", "rel_"].iter().any(|prefix| word.starts_with(prefix));
    if is_reserved(word) || ["PI", "INFINITY"].iter().any(|w| word.eq_ignore_ascii_case(w)) {
        Look::Keyword
    } else if coordinate_digits(word).is_some() {
        Look::Coordinate
    } else if prefixed {
        Look::Object
    } else if rest.trim_start().starts_with('(') && builtins::find(word).is_some() {
        Look::Builtin
    } else {
        Look::Plain
    }
}

/// The bracket that belongs to the one at or just before `at`, if both are there. Brackets in comments and texts
/// do not count.
#[must_use]
pub fn partner(text: &str, at: usize) -> Option<usize> {
    let brackets: Vec<(usize, bool)> = Scanner::new(text, 0, text.len())
        .filter(|token| matches!(token.kind, TokenKind::Open | TokenKind::Close))
        .map(|token| (token.start, token.kind == TokenKind::Open))
        .collect();
    let position = |place: usize| brackets.iter().position(|(start, _)| *start == place);
    let here = position(at).or_else(|| position(at.checked_sub(1)?))?;
    let forward = brackets[here].1;
    let mut depth = 0usize;
    let closes = |(start, opens): &(usize, bool)| {
        depth = if *opens == forward { depth + 1 } else { depth.saturating_sub(1) };
        (depth == 0).then_some(*start)
    };
    if forward { brackets[here..].iter().find_map(closes) } else { brackets[..=here].iter().rev().find_map(closes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_belongs_to_one_piece() {
        for text in ["a = .5e-3; // end", " { open", "\"open", "x1**2 & \\ é ≤ \u{1F600} ", "1e", "1.e+5", ""] {
            let mut end = 0;
            for (_, range) in pieces(text) {
                assert_eq!(range.start, end);
                assert!(range.end > end);
                end = range.end;
            }
            assert_eq!(end, text.len(), "{text}");
        }
    }

    #[test]
    fn words_look_like_what_they_are() {
        use Look::{Builtin, Comment, Coordinate, Keyword, Number, Object, Text};
        let looks = pieces("while gob_a x12 {c} \"t\" 1e3 r1 sin(e");
        let looks: Vec<Look> = looks.into_iter().map(|piece| piece.0).filter(|look| *look != Look::Plain).collect();
        assert_eq!(looks, [Keyword, Object, Coordinate, Comment, Text, Number, Builtin]);
    }

    #[test]
    fn brackets_find_their_partners() {
        for (text, at, expected) in [
            ("(a[1])", 0, Some(5)),
            ("(a[1])", 6, Some(0)),
            ("(a[1])", 2, Some(4)),
            ("({)}", 0, None),
            ("a", 0, None),
            ("())", 3, None),
        ] {
            assert_eq!(partner(text, at), expected, "{text} at {at}");
        }
    }
}
