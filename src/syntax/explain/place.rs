//! A part of a text as tokens: where its statements begin and end, what documents it.

use std::sync::Arc;

use crate::source::{SourceId, Span};
use crate::syntax::scan::{Scanner, Token, TokenKind, is_reserved};

/// A part of a text.
#[derive(Clone, Copy, Debug)]
pub struct Place<'t> {
    /// The whole text.
    pub text: &'t str,
    /// Its number.
    pub id: SourceId,
    /// Where the part begins.
    pub start: usize,
    /// Where it ends.
    pub end: usize,
}

impl<'t> Place<'t> {
    /// The tokens of the part without its comments.
    pub fn tokens(self) -> Vec<Token> {
        Scanner::new(self.text, self.start, self.end).filter(|t| t.kind != TokenKind::Comment).collect()
    }

    /// The span of a token.
    pub fn span(self, token: Token) -> Span {
        Span::new(self.id, token.start, token.end)
    }

    /// The span of one byte range.
    pub fn range(self, start: usize, end: usize) -> Span {
        Span::new(self.id, start, end)
    }

    /// Whether a line ends between the two bytes.
    pub fn line_between(self, from: usize, to: usize) -> bool {
        self.text[from..to].contains(['\n', '\r'])
    }
}

/// The index of the token after a head `name =`, `name(...) =` or `name[...] =` that begins at token `at`, if one does.
/// `:=` counts, since it is what other languages write.
pub fn definition_head(text: &str, tokens: &[Token], at: usize) -> Option<usize> {
    let word = tokens.get(at).filter(|t| t.kind == TokenKind::Word)?;
    if is_reserved(word.text(text)) {
        return None;
    }
    let mut next = at + 1;
    let mut depth = 0_usize;
    loop {
        let token = tokens.get(next)?;
        match token.kind {
            TokenKind::Open => depth += 1,
            TokenKind::Close => depth = depth.checked_sub(1)?,
            TokenKind::Semicolon => return None,
            _ if depth > 0 => {}
            _ if token.text(text) == ":" && tokens.get(next + 1).is_some_and(|t| t.text(text) == "=") => {}
            _ => return (token.kind == TokenKind::Symbol && token.text(text) == "=").then_some(next + 1),
        }
        next += 1;
    }
}

/// Whether token `at` can only begin a statement: `name =`, `x4 :`, WHILE, FOR, PRINT, INCLUDE.
pub fn begins_statement(text: &str, tokens: &[Token], at: usize) -> bool {
    let Some(token) = tokens.get(at).filter(|t| t.kind == TokenKind::Word) else { return false };
    let word = token.text(text);
    let keyword = ["WHILE", "FOR", "PRINT", "INCLUDE"].iter().any(|k| k.eq_ignore_ascii_case(word));
    let typed = tokens.get(at + 1).is_some_and(|t| t.text(text) == ":");
    keyword || (typed && !is_reserved(word)) || definition_head(text, tokens, at).is_some()
}

/// The comments right above byte `start`, without their marks; empty if there are none.
pub fn doc(text: &str, comments: &[(usize, usize)], start: usize) -> Arc<str> {
    let mut first = comments.partition_point(|c| c.1 <= start);
    let last = first;
    let mut below = start;
    while let Some(&(from, to)) = first.checked_sub(1).and_then(|n| comments.get(n)) {
        let between = &text[to..below];
        if !between.chars().all(char::is_whitespace) || lines(between) > 1 || trails(text, comments, first - 1, start) {
            break;
        }
        first -= 1;
        below = from;
    }
    let parts: Vec<_> = comments[first..last].iter().map(|&(from, to)| bare(&text[from..to])).collect();
    Arc::from(parts.join("\n").trim())
}

fn lines(between: &str) -> usize {
    between.matches('\n').count().max(between.matches('\r').count())
}

/// Whether comment number `at` stands behind something on its line, while `start` is on another line.
fn trails(text: &str, comments: &[(usize, usize)], at: usize, start: usize) -> bool {
    if !text[comments[at].0..start].contains(['\n', '\r']) {
        return false;
    }
    for &(from, _) in comments[..=at].iter().rev() {
        let before = text[..from].trim_end_matches([' ', '\t']);
        let comment_before = comments.binary_search_by_key(&before.len(), |c| c.1).is_ok();
        if !comment_before {
            return !(before.is_empty() || before.ends_with(['\n', '\r']));
        }
    }
    false
}

fn bare(comment: &str) -> &str {
    let inner = comment.strip_prefix('{').map(|c| c.strip_suffix('}').unwrap_or(c));
    inner.or_else(|| comment.strip_prefix("//")).unwrap_or(comment).trim()
}

/// The end of the last token of `start..end`.
pub fn last_token_end(text: &str, start: usize, end: usize) -> usize {
    let tokens = Scanner::new(text, start, end).filter(|t| t.kind != TokenKind::Comment);
    tokens.last().map_or(end, |t| t.end)
}

/// The byte after the `;` that follows `from`, if nothing else does before `end`; else `from`.
pub fn with_semicolon(text: &str, from: usize, end: usize) -> usize {
    let next = Scanner::new(text, from, end).find(|t| t.kind != TokenKind::Comment);
    next.filter(|t| t.kind == TokenKind::Semicolon).map_or(from, |t| t.end)
}

/// The statement of a block that holds byte `at`, as a range of bytes without its `;`; `None` outside blocks.
///
/// What an IF, WHILE or FOR governs belongs to its statement, so that blanking the range leaves a block that parses.
pub fn statement_in_block(place: Place<'_>, at: usize) -> Option<(usize, usize)> {
    let text = place.text;
    let tokens = place.tokens();
    let mut starts: Vec<usize> = Vec::new();
    for (n, token) in tokens.iter().enumerate() {
        let otherwise = tokens.get(n + 1).is_some_and(|t| t.is_word(text, "ELSE"));
        let ends = token.kind == TokenKind::Semicolon && !otherwise;
        let closes = token.is_word(text, "END");
        if token.start >= at && (ends || closes) && !starts.is_empty() {
            return starts.last().filter(|&&start| start <= at).map(|&start| (start, token.start));
        }
        if token.is_word(text, "BEGIN") {
            starts.push(token.end);
        } else if closes {
            starts.pop();
        } else if let Some(start) = starts.last_mut().filter(|_| ends) {
            *start = token.end;
        }
    }
    None
}
