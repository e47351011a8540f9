//! From text to statements: the checks before the grammar, the grammar, and the way on after an error. The only user of
//! pest. Never fails halfway: what does not parse comes back as a failed statement beside the message about it.

mod expression;
mod statement;

use std::borrow::Cow;
use std::num::NonZeroUsize;
use std::sync::{Mutex, MutexGuard, PoisonError};

use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};
use pest::iterators::Pairs;

use super::explain::{self, Forgotten, Place};
use super::scan::is_space;
use super::split::{Chunk, Pieces, split};
use super::tree::{Statement, StatementKind};
use crate::diagnostic::Diagnostic;
use crate::limits::Limits;
use crate::source::{SourceId, SourceMap, Span};

/// The grammar as pest compiled it.
#[derive(pest_derive::Parser)]
#[grammar = "grammar/yont.pest"]
struct Grammar;

/// How a text arrives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// A file: each statement ends with `;`, only a bare expression at the very end may go without.
    Script,
    /// Code of the command line: a script whose last statement may go without its `;`.
    Code,
    /// The prompt: the last statement may go without its `;`, and what is not defined yet may still come.
    Prompt,
}

/// What a text holds.
#[derive(Clone, Debug, Default)]
pub struct Parsed {
    /// In the order of the text, failed ones included.
    pub statements: Vec<Statement>,
    /// What there is to say, in the order of the text; at most `Limits::errors` and one that counts the rest.
    pub diagnostics: Vec<Diagnostic>,
    /// Whether the only trouble is that the text stops too early (an open bracket, block or comment, a trailing
    /// operator), so that a prompt should ask for another line.
    pub incomplete: bool,
}

/// Nesting from which a statement is parsed on a stack of its own; below, any caller's stack is large enough.
const SHALLOW: usize = 40;
/// Bytes of stack for each level of nesting; the grammar's functions need less than half of it.
const STACK_PER_LEVEL: usize = 128 << 10;

/// Parses the whole of the text `id`.
///
/// A text of more than `limits.source_bytes` bytes, nested deeper than `limits.nesting` or not a text at all gives one
/// error and no statements.
#[must_use]
pub fn parse(sources: &SourceMap, id: SourceId, limits: &Limits, mode: Mode) -> Parsed {
    let Some(source) = sources.get(id) else { return Parsed::default() };
    let refused = |diagnostic| Parsed { diagnostics: vec![diagnostic], ..Parsed::default() };
    if let Some(diagnostic) = explain::refuse(&source.text, id, limits) {
        return refused(diagnostic);
    }
    let text = plain_spaces(&source.text);
    let pieces = split(&text, limits.nesting);
    if let Some(fault) = pieces.too_deep {
        return refused(explain::too_deep(Span::new(id, fault.start, fault.end), limits));
    }
    let mut driver = Driver { text: &text, id, mode, comments: &pieces.comments, parsed: Parsed::default() };
    driver.run(&pieces);
    driver.finish(limits)
}

/// The text with rare white space outside comments and texts turned into as many plain spaces as it has bytes.
fn plain_spaces(text: &str) -> Cow<'_, str> {
    let rare = |c: char| (!c.is_ascii() || matches!(c, '\u{b}' | '\u{c}')) && is_space(c);
    if !text.contains(rare) {
        return Cow::Borrowed(text);
    }
    let spaces = |c: char| if rare(c) { " ".repeat(c.len_utf8()) } else { c.to_string() };
    Cow::Owned(text.chars().map(spaces).collect())
}

/// pest keeps its call limit in one place for the whole process, so that one text parses at a time.
static CALL_LIMIT: Mutex<()> = Mutex::new(());

/// Why a text gave no tree.
#[derive(Clone, Copy, Debug)]
enum Stop {
    /// The grammar cannot go on at this byte.
    At(usize),
    /// A limit of pest was reached.
    GaveUp,
}

/// Statements up to that many bytes may make the same number of calls, so that they can be read at the same time.
const SHORT: usize = 512;

/// Takes the limit for a text of so many bytes, as long as the guard lives.
fn limit_calls(length: usize) -> MutexGuard<'static, ()> {
    let guard = CALL_LIMIT.lock().unwrap_or_else(PoisonError::into_inner);
    pest::set_call_limit(NonZeroUsize::new(200 * length.max(SHORT) + 10_000));
    guard
}

fn grammar(rule: Rule, text: &str) -> Result<Pairs<'_, Rule>, Stop> {
    let guard = limit_calls(text.len());
    let result = limited(rule, text);
    drop(guard);
    result
}

/// The same by who holds the limit.
fn limited(rule: Rule, text: &str) -> Result<Pairs<'_, Rule>, Stop> {
    Grammar::parse(rule, text).map_err(|error| match (error.variant, error.location) {
        (ErrorVariant::CustomError { .. }, _) => Stop::GaveUp,
        (_, InputLocation::Pos(at) | InputLocation::Span((at, _))) => Stop::At(at),
    })
}

struct Driver<'t> {
    text: &'t str,
    id: SourceId,
    mode: Mode,
    comments: &'t [(usize, usize)],
    parsed: Parsed,
}

impl<'t> Driver<'t> {
    fn run(&mut self, pieces: &Pieces) {
        let mut ahead = self.ahead(&pieces.chunks).into_iter();
        for chunk in &pieces.chunks {
            self.chunk(chunk, ahead.next().flatten());
        }
        let last_fails =
            matches!(self.parsed.statements.last(), Some(s) if matches!(s.kind, StatementKind::Failed { .. }));
        self.parsed.incomplete |= pieces.open && last_fails;
    }

    fn finish(mut self, limits: &Limits) -> Parsed {
        // The faults of a block's brackets are found before the other errors in it.
        self.parsed.diagnostics.sort_by_key(|d| d.labels.iter().find(|l| l.primary).map(|l| l.span.start));
        let errors = self.parsed.diagnostics.len();
        if errors > limits.errors {
            self.parsed.diagnostics.truncate(limits.errors);
            self.parsed.diagnostics.push(explain::more_errors(errors - limits.errors));
        }
        self.parsed
    }

    fn place(&self, start: usize, end: usize) -> Place<'t> {
        Place { text: self.text, id: self.id, start, end }
    }

    /// Reads the short statements of a long text by all threads; an entry for each chunk, or none at all. On threads of their own, not on
    /// rayon's: those would take up other work while they hold the limit, perhaps another text.
    fn ahead(&self, chunks: &[Chunk]) -> Vec<Option<Outcome>> {
        let threads = rayon::current_num_threads().min(chunks.len() / MANY);
        if threads < 2 {
            return Vec::new();
        }
        let (text, id, comments) = (self.text, self.id, self.comments);
        let read = move |chunk: &Chunk| {
            let short = chunk.end - chunk.start <= SHORT && chunk.depth < SHALLOW && chunk.faults.is_empty();
            let builder = Builder { text, id, base: chunk.start, comments, diagnostics: Vec::new() };
            short.then(|| builder.read(limited(Rule::single, &text[chunk.start..chunk.end])))
        };
        let guard = limit_calls(SHORT);
        let all = std::thread::scope(|scope| {
            let spawn = |part| {
                let builder = std::thread::Builder::new().stack_size(2 * SHALLOW * STACK_PER_LEVEL);
                builder.spawn_scoped(scope, move || <[Chunk]>::iter(part).map(read).collect::<Vec<_>>())
            };
            let threads: Vec<_> =
                chunks.chunks(chunks.len().div_ceil(threads)).map(|part| (part.len(), spawn(part))).collect();
            let outcomes = threads.into_iter().flat_map(|(count, thread)| {
                // What a thread could not do is left to the one that asked.
                let read = thread.ok().and_then(|thread| thread.join().ok());
                read.unwrap_or_else(|| (0..count).map(|_| None).collect())
            });
            outcomes.collect()
        });
        drop(guard);
        all
    }

    fn chunk(&mut self, chunk: &Chunk, ahead: Option<Outcome>) {
        if chunk.faults.is_empty() {
            self.statements(chunk, ahead);
            return;
        }
        let place = self.place(chunk.start, chunk.end);
        let diagnostics: Vec<_> =
            chunk.faults.iter().take(MENDINGS).map(|fault| explain::fault(place, *fault)).collect();
        self.parsed.diagnostics.extend(explain::gather(diagnostics));
        // What else is wrong in a block shows once the statements with the faults are out of the way.
        let mut mended = Mended::new(self.text, chunk);
        if chunk.faults.len() < MENDINGS && chunk.faults.iter().all(|fault| mended.blank(place, fault.start)) {
            self.further_errors(chunk, mended);
        }
        // Brackets say nothing against the words between them; after a text or comment without an end nothing is sure.
        let brackets = chunk.faults.iter().all(|f| f.kind.is_bracket());
        self.fail(chunk, chunk.start, if brackets { chunk.end } else { chunk.start });
    }

    /// Tells the errors of a block one after another, each time without the statement that had the last one.
    fn further_errors(&mut self, chunk: &Chunk, mut mended: Mended) {
        let mut last = None;
        for _ in 0..MENDINGS {
            let parsed = with_stack(chunk.depth, || grammar(Rule::single, &mended.text).map(drop));
            let Err(Stop::At(at)) = parsed else { return };
            if last.replace(at) == Some(at) {
                return;
            }
            let at = chunk.start + at;
            let place = self.place(chunk.start, chunk.end);
            let forgotten = explain::forgotten_semicolon(place, at);
            let diagnostic = match forgotten {
                Some(next) => explain::missing_semicolon(place, next),
                None => explain::unexpected(place, at).diagnostic,
            };
            let went_on = match forgotten {
                Some(next) => mended.end_statement(next),
                None => mended.blank(place, at),
            };
            self.parsed.diagnostics.push(diagnostic);
            if !went_on {
                return;
            }
        }
    }

    /// A statement that failed; its words count up to byte `sure`.
    fn fail(&mut self, chunk: &Chunk, start: usize, sure: usize) {
        let place = self.place(start, chunk.end);
        let defines = explain::defined_names(place);
        let (reads, condition) = explain::read_names(place, sure);
        self.push(StatementKind::Failed { defines, reads, condition }, chunk, start, chunk.end);
    }

    fn push(&mut self, kind: StatementKind, chunk: &Chunk, start: usize, end: usize) {
        let whole = if end == chunk.end { chunk.semicolon.unwrap_or(end) } else { end };
        let doc = explain::doc(self.text, self.comments, start);
        self.parsed.statements.push(Statement { kind, span: Span::new(self.id, start, whole), doc });
    }

    /// Parses the statements of a chunk: one, or several where a `;` was forgotten.
    fn statements(&mut self, chunk: &Chunk, ahead: Option<Outcome>) {
        let mut start = chunk.start;
        let mut done = match ahead {
            Some(outcome) => self.take(chunk, outcome, start, chunk.end),
            None => self.one(chunk, start, chunk.end),
        };
        // Each turn reads the rest again, so that a text without any `;` must not take as many turns as it has lines.
        let mut told = 0;
        while let Err(stop) = done {
            let place = self.place(start, chunk.end);
            let Stop::At(at) = stop else {
                let diagnostic = explain::gave_up(place);
                self.parsed.diagnostics.push(diagnostic);
                return self.fail(chunk, start, start);
            };
            let next = explain::forgotten_semicolon(place, at);
            told += 1;
            let Some(next) = next.filter(|next| told <= MENDINGS && self.one(chunk, start, next.after).is_ok()) else {
                return self.stuck(chunk, start, at);
            };
            let diagnostic = explain::missing_semicolon(self.place(start, chunk.end), next);
            self.parsed.diagnostics.push(diagnostic);
            start = next.statement;
            done = self.one(chunk, start, chunk.end);
        }
        if chunk.semicolon.is_none() && self.mode == Mode::Script {
            self.unfinished(chunk);
        }
    }

    /// A script's last statement without its `;`.
    fn unfinished(&mut self, chunk: &Chunk) {
        let last = self.parsed.statements.last();
        if !matches!(last, Some(s) if matches!(s.kind, StatementKind::Expression(_) | StatementKind::Failed { .. })) {
            let diagnostic = explain::missing_last_semicolon(self.place(chunk.start, chunk.end));
            self.parsed.diagnostics.push(diagnostic);
        }
    }

    fn stuck(&mut self, chunk: &Chunk, start: usize, at: usize) {
        let place = self.place(start, chunk.end);
        if explain::statement_in_block(place, at).is_some() {
            let rest = Chunk { start, ..chunk.clone() };
            self.further_errors(&rest, Mended::new(self.text, &rest));
        } else {
            let mut explained = explain::unexpected(place, at);
            if self.mode == Mode::Prompt && explained.diagnostic.code == "stray-else" {
                let help =
                    "at the prompt an IF that is complete ends with its line: leave ELSE at the end of that line";
                explained.diagnostic = explained.diagnostic.help(help);
            }
            self.parsed.incomplete |= explained.at_end && chunk.semicolon.is_none();
            self.parsed.diagnostics.push(explained.diagnostic);
        }
        self.fail(chunk, start, at);
    }

    /// Parses one statement of `start..end`; the error says where the grammar stopped.
    fn one(&mut self, chunk: &Chunk, start: usize, end: usize) -> Result<(), Stop> {
        let text = &self.text[start..end];
        let builder =
            Builder { text: self.text, id: self.id, base: start, comments: self.comments, diagnostics: Vec::new() };
        let outcome = with_stack(chunk.depth, || builder.read(grammar(Rule::single, text)));
        self.take(chunk, outcome, start, end)
    }

    /// Takes what became of `start..end`.
    fn take(&mut self, chunk: &Chunk, outcome: Outcome, start: usize, end: usize) -> Result<(), Stop> {
        let (kind, diagnostics) = outcome.map_err(|stop| match stop {
            Stop::At(at) => Stop::At(at + start),
            Stop::GaveUp => Stop::GaveUp,
        })?;
        let failed = diagnostics.iter().any(Diagnostic::is_error);
        self.parsed.diagnostics.extend(diagnostics);
        match kind {
            Some(_) if failed => self.fail(chunk, start, chunk.end),
            Some(kind) => self.push(kind, chunk, start, end),
            None => {}
        }
        Ok(())
    }
}

/// What became of one statement: the tree, if there is anything at all, and messages about what the grammar lets through; places of errors
/// count from where it begins.
type Outcome = Result<(Option<StatementKind>, Vec<Diagnostic>), Stop>;

/// A thread of its own is worth it for that many statements.
const MANY: usize = 256;

/// How many errors of one statement or block are told, each of which reads it again.
const MENDINGS: usize = 20;

/// A copy of a statement in which what is wrong is blanked out, byte for byte, so that places stay what they are.
struct Mended {
    text: String,
    base: usize,
}

impl Mended {
    fn new(text: &str, chunk: &Chunk) -> Self {
        Self { text: text[chunk.start..chunk.end].to_owned(), base: chunk.start }
    }

    /// Blanks out the statement of a block that holds byte `at` of the whole text; false if there is none left.
    fn blank(&mut self, place: Place<'_>, at: usize) -> bool {
        let Some((start, end)) = explain::statement_in_block(place, at) else { return false };
        let (start, end) = (start - self.base, end - self.base);
        let fresh = !self.text[start..end].trim().is_empty();
        self.text.replace_range(start..end, &" ".repeat(end - start));
        fresh
    }

    /// Writes a `;` into the white space between two statements; false if there is none.
    fn end_statement(&mut self, forgotten: Forgotten) -> bool {
        let (from, to) = (forgotten.after - self.base, forgotten.statement - self.base);
        let white = |at: &usize| self.text.as_bytes()[*at].is_ascii_whitespace();
        let Some(at) = [from, to.saturating_sub(1)].into_iter().find(|at| from < to && white(at)) else { return false };
        self.text.replace_range(at..=at, ";");
        true
    }
}

/// Runs `work` on this stack, or on one that is large enough for `depth` levels of nesting.
fn with_stack<T: Send>(depth: usize, work: impl FnOnce() -> Result<T, Stop> + Send) -> Result<T, Stop> {
    if depth < SHALLOW {
        return work();
    }
    std::thread::scope(|scope| {
        let builder = std::thread::Builder::new().stack_size((depth + SHALLOW) * STACK_PER_LEVEL);
        match builder.spawn_scoped(scope, work) {
            Ok(handle) => handle.join().unwrap_or(Err(Stop::GaveUp)),
            Err(_) => Err(Stop::GaveUp),
        }
    })
}

/// Turns pest's pairs into the tree; messages about what the grammar lets through gather beside it.
struct Builder<'t> {
    text: &'t str,
    id: SourceId,
    /// Where the parsed part begins in the whole text.
    base: usize,
    comments: &'t [(usize, usize)],
    diagnostics: Vec<Diagnostic>,
}

impl<'t> Builder<'t> {
    /// The statement that the grammar found.
    fn read(mut self, pairs: Result<Pairs<'t, Rule>, Stop>) -> Outcome {
        let kind = pairs?.next().and_then(|single| self.single(single));
        Ok((kind, self.diagnostics))
    }
}
