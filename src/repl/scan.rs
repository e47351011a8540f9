//! A glance at unfinished text: words, numbers, comments and brackets, for colours and completion only. It never says
//! what is right or wrong; that is `syntax`.

use std::ops::Range;

use crate::builtins;

/// The reserved words of the language, as the manual writes them.
pub const KEYWORDS: &[&str] = &[
    "AND", "AT", "BEGIN", "DO", "ELSE", "END", "FOR", "IF", "IN", "INCLUDE", "NOT", "OR", "PI", "PRINT", "STEP", "THEN",
    "TO", "WHERE", "WHILE",
];

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
    /// Any other name.
    Name,
    /// Operators, brackets, blanks: one character.
    Other,
}

/// The pieces of a text, without gaps.
#[must_use]
pub fn pieces(text: &str) -> Vec<(Look, Range<usize>)> {
    let mut pieces = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let (look, length) = piece(&text[at..]);
        let look = if look == Look::Name { name(&text[at..at + length], &text[at + length..]) } else { look };
        pieces.push((look, at..at + length));
        at += length;
    }
    pieces
}

/// The look and length of the first piece of a text that is not empty.
fn piece(text: &str) -> (Look, usize) {
    let first = text.chars().next().unwrap_or(' ');
    let through = |end: Option<usize>| end.unwrap_or(text.len());
    let run = |keep: fn(char) -> bool| through(text.find(|c| !keep(c)));
    match first {
        '{' => (Look::Comment, through(text.find('}').map(|i| i + 1))),
        '/' if text.starts_with("//") => (Look::Comment, through(text.find('\n'))),
        '"' => (Look::Text, through(text[1..].find(['"', '\n']).map(|i| i + 2))),
        c if c.is_ascii_digit() => (Look::Number, number(text)),
        '.' if text[1..].starts_with(|c: char| c.is_ascii_digit()) => (Look::Number, number(text)),
        c if c.is_alphabetic() || c == '_' => (Look::Name, run(|c| c.is_alphanumeric() || c == '_')),
        c => (Look::Other, c.len_utf8()),
    }
}

fn number(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| from + bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
    let end = digits(0);
    if !matches!(bytes.get(end), Some(b'e' | b'E')) {
        return end;
    }
    let sign = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
    if bytes.get(sign).is_some_and(u8::is_ascii_digit) { digits(sign) } else { end }
}

fn name(word: &str, rest: &str) -> Look {
    let upper = word.to_ascii_uppercase();
    let prefixed = ["gob_", "pob_", "tr_", "rel_"].iter().any(|prefix| word.starts_with(prefix));
    if KEYWORDS.contains(&upper.as_str()) {
        Look::Keyword
    } else if is_coordinate(word) {
        Look::Coordinate
    } else if prefixed {
        Look::Object
    } else if rest.trim_start().starts_with('(') && builtins::find(word).is_some() {
        Look::Builtin
    } else {
        Look::Name
    }
}

fn is_coordinate(word: &str) -> bool {
    let digits = word.strip_prefix(['x', 'X']).unwrap_or("");
    !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
}

/// The bracket that belongs to the one at or just before `at`, if both are there. Brackets in comments and texts
/// do not count.
#[must_use]
pub fn partner(text: &str, at: usize) -> Option<usize> {
    let brackets: Vec<(usize, u8)> = pieces(text)
        .into_iter()
        .filter(|(look, _)| *look == Look::Other)
        .map(|(_, range)| (range.start, text.as_bytes()[range.start]))
        .filter(|(_, byte)| b"()[]".contains(byte))
        .collect();
    let here = brackets.iter().position(|(i, _)| *i == at).or_else(|| {
        let before = at.checked_sub(1)?;
        brackets.iter().position(|(i, _)| *i == before)
    })?;
    let opens = |byte: u8| byte == b'(' || byte == b'[';
    let mut depth = 0usize;
    let mut follow = |(i, byte): &(usize, u8), inward: bool| {
        depth = if opens(*byte) == inward { depth + 1 } else { depth.saturating_sub(1) };
        (depth == 0).then_some(*i)
    };
    if opens(brackets[here].1) {
        brackets[here..].iter().find_map(|bracket| follow(bracket, true))
    } else {
        brackets[..=here].iter().rev().find_map(|bracket| follow(bracket, false))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_belongs_to_one_piece() {
        for text in ["a = .5e-3; // ende", "{ offen", "\"offen", "x1**2 & \\ é ≤ \u{1F600}", "1e", "1.e+5", ""] {
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
        let looks = |text: &str| pieces(text).into_iter().map(|p| p.0).filter(|l| *l != Look::Other).collect::<Vec<_>>();
        use Look::{Comment, Coordinate, Keyword, Name, Number, Object, Text};
        assert_eq!(looks("while gob_a x12 {c} \"t\" 1e3 r1 e"), [
            Keyword, Object, Coordinate, Comment, Text, Number, Name, Name
        ]);
    }

    #[test]
    fn brackets_find_their_partners() {
        for (text, at, partner_at) in [
            ("(a[1])", 0, Some(5)),
            ("(a[1])", 6, Some(0)),
            ("(a[1])", 2, Some(4)),
            ("({)}", 0, None),
            ("a", 0, None),
            ("())", 3, None),
        ] {
            assert_eq!(partner(text, at), partner_at, "{text} at {at}");
        }
    }
}
