//! Where the comments of a text stand, for the formatter: between statements, behind one, or in the middle of one.

use crate::syntax::scan::{Scanner, Token, TokenKind};
use crate::syntax::tree::Statement;

/// The comments of a text.
pub struct Comments<'t> {
    /// The text.
    pub text: &'t str,
    /// Their places, in order.
    places: Vec<(usize, usize)>,
}

/// One thing between two statements.
pub enum Gap<'t> {
    /// A blank line.
    Blank,
    /// A comment behind a statement on its line.
    Trailing(&'t str),
    /// A comment on a line of its own.
    Own(&'t str),
}

impl<'t> Comments<'t> {
    /// Finds the comments of `text`.
    pub fn of(text: &'t str) -> Self {
        let comments = Scanner::new(text, 0, text.len()).filter(|t| t.kind == TokenKind::Comment);
        Self { text, places: comments.map(|t| (t.start, t.end)).collect() }
    }

    fn within(&self, from: usize, to: usize) -> &[(usize, usize)] {
        let first = self.places.partition_point(|c| c.0 < from);
        let last = self.places.partition_point(|c| c.0 < to);
        &self.places[first.min(last)..last]
    }

    /// How many comments stand in the middle of a statement.
    pub fn inside(&self, statement: &Statement) -> usize {
        self.within(statement.span.start as usize, statement.span.end as usize).len()
    }

    /// What stands between bytes `from` and `to`, where no statement is.
    pub fn gap(&self, from: usize, to: usize) -> Vec<Gap<'t>> {
        let mut items = Vec::new();
        let mut after = from;
        for &(start, end) in self.within(from, to) {
            let space = &self.text[after..start];
            // The first gap of a text has nothing to stand behind.
            let behind = after > 0 && newlines(space) == 0 && self.ends_line(end, to);
            if newlines(space) > 1 || ended(&items, space) {
                items.push(Gap::Blank);
            }
            let comment = self.text[start..end].trim_end();
            items.push(if behind { Gap::Trailing(comment) } else { Gap::Own(comment) });
            after = end;
        }
        let space = &self.text[after..to.max(after)];
        if newlines(space) > 1 || ended(&items, space) {
            items.push(Gap::Blank);
        }
        items
    }

    /// Whether nothing but comments follows `from` on its line.
    fn ends_line(&self, from: usize, to: usize) -> bool {
        let next = Scanner::new(self.text, from, self.text.len()).find(|t| t.kind != TokenKind::Comment);
        let next = next.map_or(self.text.len(), |t| t.start).min(to.max(from));
        next == self.text.len() || newlines(&self.text[from..next]) > 0
    }

    fn tokens(&self, from: usize, to: usize) -> impl Iterator<Item = Token> + use<'t> {
        Scanner::new(self.text, from, to).filter(|t| t.kind != TokenKind::Comment)
    }

    /// The bytes between the BEGIN before `first` and the END behind `last`, two statements of one block of `whole`;
    /// `None` if there is no BEGIN and END.
    pub fn block(&self, whole: &Statement, first: &Statement, last: &Statement) -> Option<(usize, usize)> {
        let (start, end) = (first.span.start as usize, last.span.end as usize);
        let begin = self.tokens(whole.span.start as usize, start).last().filter(|t| t.is_word(self.text, "BEGIN"))?;
        let after = self.tokens(end, whole.span.end as usize).find(|t| t.kind != TokenKind::Semicolon);
        let close = after.filter(|t| t.is_word(self.text, "END"))?;
        Some((begin.end, close.start))
    }

    /// How many comments begin between two bytes.
    pub fn between(&self, from: usize, to: usize) -> usize {
        self.within(from, to).len()
    }
}

/// Whether an empty statement parts a comment from what follows, which it then does not document. The formatter drops the statement, so a
/// blank line has to part them.
fn ended(before: &[Gap<'_>], space: &str) -> bool {
    matches!(before.last(), Some(Gap::Own(_))) && space.contains(';')
}

fn newlines(space: &str) -> usize {
    let feeds = space.matches('\n').count();
    if feeds > 0 { feeds } else { space.matches('\r').count() }
}
