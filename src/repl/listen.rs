//! Standard input that is no terminal: its lines, and which of them belong together. Answers nothing itself.

use std::collections::VecDeque;
use std::io::{BufRead, Read};
use std::path::Path;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::Duration;

use crate::host::{FileError, Reason, reason};
use crate::limits::Limits;
use crate::syntax::scan::{Scanner, Token, TokenKind};

use super::helper::is_incomplete;

/// How long an input that could stand as it is waits for a line that goes on with it. Files and pipes have the next line
/// at once; a program that talks with the prompt waits for its answer and sends none.
const PATIENCE: Duration = Duration::from_millis(100);
/// Bytes up to which an open input is looked at again with each line.
const SHORT: usize = 16 << 10;
/// Lines that are read ahead of the answers.
const AHEAD: usize = 64;

type Said = Result<String, Reason>;

/// The inputs of a stream, one after another.
#[derive(Debug)]
pub struct Inputs {
    lines: Receiver<Said>,
    ahead: VecDeque<Said>,
    limit: usize,
}

impl Inputs {
    /// Those of standard input.
    #[must_use]
    pub fn of_standard_input() -> Self {
        let limit = Limits::default().source_bytes;
        let (sender, lines) = sync_channel(AHEAD);
        std::thread::spawn(move || {
            let mut input = std::io::stdin().lock();
            while let Some(line) = next_line(&mut input, limit).transpose() {
                let failed = line.is_err();
                // Nobody listens any more when the prompt was left.
                if sender.send(line).is_err() || failed {
                    return;
                }
            }
        });
        Self { lines, ahead: VecDeque::new(), limit }
    }

    /// The next input; nothing at the end.
    ///
    /// # Errors
    /// [`FileError`] when the stream cannot be read, is no text, or one input is too large.
    pub fn next(&mut self) -> Result<Option<String>, FileError> {
        let fails = |reason| FileError::reading(Path::new("standard input"), reason);
        let (mut pending, mut again) = (String::new(), 0);
        while let Some(line) = self.ahead.pop_front().or_else(|| self.lines.recv().ok()) {
            pending.push_str(&line.map_err(fails)?);
            if pending.len() > self.limit {
                return Err(fails(Reason::TooLarge(self.limit)));
            }
            if pending.len() >= again && !is_incomplete(&pending) && !self.goes_on(&mut pending) {
                return Ok(Some(pending));
            }
            // A long input that stays open is looked at again only when it has grown by a part of itself: else a
            // pasted file with an open comment would be parsed once for each of its lines.
            again = pending.len() + pending.len().saturating_sub(SHORT) / 256;
        }
        Ok((!pending.is_empty()).then_some(pending))
    }

    /// Whether the next line with something in it goes on with a complete input; if so, it is put to it.
    fn goes_on(&mut self, pending: &mut String) -> bool {
        let Some(open) = Open::of(pending) else { return false };
        let mut k = 0;
        loop {
            if self.ahead.len() == k {
                match self.lines.recv_timeout(PATIENCE) {
                    Ok(line) => self.ahead.push_back(line),
                    Err(_) => return false,
                }
            }
            let Some(Ok(line)) = self.ahead.get(k) else { return false };
            k += 1;
            match Scanner::new(line, 0, line.len()).find(|token| token.kind != TokenKind::Comment) {
                None => {}
                Some(first) if !open.takes(line, first) => return false,
                Some(_) => break,
            }
        }
        // The last of them is taken as any other line is: what follows it may go on further.
        let between: Vec<String> = self.ahead.drain(..k - 1).filter_map(Result::ok).collect();
        between.iter().for_each(|line| pending.push_str(line));
        true
    }
}

/// What a complete input leaves open: with the next line it may say more.
#[derive(Clone, Copy, Debug)]
struct Open {
    /// Its last statement has no `;`.
    unended: bool,
    /// It defines something, so that without a `;` it is hardly meant to end here.
    defines: bool,
    /// It holds an IF.
    choice: bool,
}

impl Open {
    /// Nothing for a command, a question, a comment, and where `;` closes all.
    fn of(input: &str) -> Option<Self> {
        let trimmed = input.trim();
        if trimmed.starts_with(':') || trimmed.ends_with('?') {
            return None;
        }
        let (mut open, mut any) = (Self { unended: false, defines: false, choice: false }, false);
        for token in Scanner::new(input, 0, input.len()).filter(|token| token.kind != TokenKind::Comment) {
            any = true;
            open.unended = token.kind != TokenKind::Semicolon;
            open.defines |= token.text(input) == "=";
            open.choice |= token.is_word(input, "IF");
        }
        (any && (open.unended || open.choice)).then_some(open)
    }

    /// Whether a line that begins with this token goes on: it can begin no statement, or only a rare one.
    fn takes(self, line: &str, first: Token) -> bool {
        let word = |words: &[&str]| words.iter().any(|word| first.is_word(line, word));
        if word(&["ELSE"]) {
            return self.choice;
        }
        let is_indented = line.starts_with([' ', '\t']);
        self.unended
            && match first.kind {
                TokenKind::Word => word(&["THEN", "DO", "TO", "AND", "OR", "AT", "WHERE", "IN"]),
                TokenKind::Semicolon | TokenKind::Comma => true,
                TokenKind::Symbol => match first.text(line) {
                    "+" | "-" => self.defines || is_indented,
                    "~" | ":" | "?" => false,
                    _ => true,
                },
                _ => false,
            }
    }
}

/// A line with its end, as text; nothing at the end of the input.
fn next_line(input: &mut impl BufRead, limit: usize) -> Result<Option<String>, Reason> {
    let mut bytes = Vec::new();
    let count = input.take(limit as u64 + 1).read_until(b'\n', &mut bytes).map_err(|error| reason(&error))?;
    let text = String::from_utf8(bytes).map_err(|e| Reason::NotText(e.utf8_error().valid_up_to()))?;
    Ok((count > 0).then_some(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_begins_no_statement_goes_on() {
        for (input, line, goes_on) in [
            ("gob_a = x1", "  | x2;", true),
            ("gob_a = x1", "- x2;", true),
            ("a = 1;", "-a", false),
            ("a", "-a", false),
            ("a", "  - 3", true),
            ("a = 1", ":undo", false),
            ("a = 1", "b = 2", false),
            ("a = q", "WHERE q = 1;", true),
            ("a = 1;", "WHERE q = 1;", false),
            ("IF (c) THEN a = 1;", "else a = 2;", true),
            ("a = 1;", "ELSE a = 2;", false),
            ("a = 1 // = ;", "** 2", true),
            (":set size", "* 2", false),
            ("{ only }", "* 2", false),
            ("a = b", "~ 2", false),
            ("a = 1", ";", true),
        ] {
            let first = Scanner::new(line, 0, line.len()).next().expect("a token");
            assert_eq!(Open::of(input).is_some_and(|open| open.takes(line, first)), goes_on, "{input:?} {line:?}");
        }
    }
}
