//! Cuts a text into statements at each `;` that ends one, matches brackets and blocks, and measures nesting, all in one
//! pass without recursion, before the grammar sees anything.
//!
//! A `;` ends a statement unless an ELSE that belongs to it follows, or a block is open. Brackets never reach across a
//! `;`, so one that is forgotten spoils one statement only.

use super::scan::{Scanner, Token, TokenKind};

/// What is wrong with the shape of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A closing bracket that closes nothing.
    StrayClose,
    /// A closing bracket of the other kind than the one that is open, at the given byte.
    Mismatch(usize),
    /// An opening bracket that nothing closes; the statement ends at the given byte.
    Unclosed(usize),
    /// A BEGIN that no END closes.
    UnclosedBlock,
    /// An END that closes nothing.
    StrayEnd,
    /// A comment that nothing closes.
    UnclosedComment,
    /// A text that its line does not close.
    UnclosedText,
    /// A character that the language does not know.
    Bad,
    /// Nested deeper than the limit.
    TooDeep,
}

impl FaultKind {
    /// Whether it is about a bracket.
    #[must_use]
    pub fn is_bracket(self) -> bool {
        matches!(self, Self::StrayClose | Self::Mismatch(_) | Self::Unclosed(_))
    }
}

/// A fault and its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// What.
    pub kind: FaultKind,
    /// The first byte.
    pub start: usize,
    /// The byte after the last.
    pub end: usize,
}

/// One statement of the text, as far as brackets and `;` tell.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Chunk {
    /// The first byte of its first word.
    pub start: usize,
    /// The byte after its last word, before the `;`.
    pub end: usize,
    /// The byte after its `;`, or `None` if the text ends without one.
    pub semicolon: Option<usize>,
    /// What is wrong with its shape.
    pub faults: Vec<Fault>,
    /// The deepest nesting in it.
    pub depth: usize,
}

/// The statements of a text, its comments and what made the cutting stop.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    /// In the order of the text; empty statements are left out.
    pub chunks: Vec<Chunk>,
    /// The places of all comments, in order.
    pub comments: Vec<(usize, usize)>,
    /// Set when the nesting limit was passed: nothing after it was read.
    pub too_deep: Option<Fault>,
    /// Whether the text ends inside a bracket, a block or a comment, so that a prompt should ask for more.
    pub open: bool,
}

/// A bracket or block that is open, with what nests inside it without brackets.
#[derive(Clone, Copy)]
struct Level {
    opener: Token,
    block: bool,
    /// Prefix operators, powers and postfix brackets since the last plain operator.
    run: usize,
    /// IF, WHILE and FOR since the last `;` or `,`.
    governed: usize,
    /// How many of them are IFs that may still take an ELSE.
    ifs: usize,
}

impl Level {
    fn new(opener: Token, block: bool) -> Self {
        Self { opener, block, run: 0, governed: 0, ifs: 0 }
    }
}

struct Splitter<'t> {
    text: &'t str,
    limit: usize,
    levels: Vec<Level>,
    nested: usize,
    operand_before: bool,
    chunk: Option<Chunk>,
    pieces: Pieces,
}

/// Cuts `text` into statements; `limit` is the deepest nesting allowed.
#[must_use]
pub fn split(text: &str, limit: usize) -> Pieces {
    let bottom = Level::new(Token { kind: TokenKind::Semicolon, start: 0, end: 0 }, true);
    let mut splitter = Splitter {
        text,
        limit,
        levels: vec![bottom],
        nested: 0,
        operand_before: false,
        chunk: None,
        pieces: Pieces::default(),
    };
    let mut scanner = Scanner::new(text, 0, text.len());
    while let Some(token) = scanner.next() {
        if !splitter.take(token, &scanner) {
            return splitter.pieces;
        }
    }
    splitter.finish()
}

impl Splitter<'_> {
    /// Takes one token; false once the nesting limit is passed.
    fn take(&mut self, token: Token, rest: &Scanner<'_>) -> bool {
        match token.kind {
            TokenKind::Comment => self.pieces.comments.push((token.start, token.end)),
            TokenKind::Semicolon => self.semicolon(token, rest),
            _ => {
                let chunk = self.chunk.get_or_insert_with(|| Chunk { start: token.start, ..Chunk::default() });
                chunk.end = token.end;
                self.inside(token);
            }
        }
        self.measure(token)
    }

    fn measure(&mut self, token: Token) -> bool {
        let depth = self.levels.len() - 1 + self.nested;
        if let Some(chunk) = &mut self.chunk {
            chunk.depth = chunk.depth.max(depth);
        }
        if depth > self.limit {
            self.pieces.too_deep = Some(Fault { kind: FaultKind::TooDeep, start: token.start, end: token.end });
            self.pieces.chunks.extend(self.chunk.take());
        }
        depth <= self.limit
    }

    fn fault(&mut self, kind: FaultKind, token: Token) {
        if let Some(chunk) = &mut self.chunk {
            chunk.faults.push(Fault { kind, start: token.start, end: token.end });
        }
    }

    fn level(&mut self) -> &mut Level {
        let last = self.levels.len() - 1;
        &mut self.levels[last]
    }

    fn nest(&mut self) {
        self.level().run += 1;
        self.nested += 1;
    }

    fn end_run(&mut self) {
        self.nested -= std::mem::take(&mut self.level().run);
    }

    fn end_part(&mut self) {
        self.end_run();
        self.nested -= std::mem::take(&mut self.level().governed);
        self.level().ifs = 0;
    }

    fn pop(&mut self) {
        self.end_part();
        if self.levels.len() > 1 {
            self.levels.pop();
        }
    }

    fn inside(&mut self, token: Token) {
        let operand_before = self.operand_before;
        self.operand_before = token.ends_operand(self.text);
        match token.kind {
            TokenKind::Open => {
                if operand_before {
                    self.nest();
                }
                self.levels.push(Level::new(token, false));
            }
            TokenKind::Close => self.close(token),
            TokenKind::Comma if self.level().block => self.end_run(),
            TokenKind::Comma => self.end_part(),
            TokenKind::Symbol => match token.text(self.text) {
                "**" | "^" => self.nest(),
                "-" | "+" | "~" if !operand_before => self.nest(),
                _ => self.end_run(),
            },
            TokenKind::Word => self.word(token),
            TokenKind::UnclosedText => self.fault(FaultKind::UnclosedText, token),
            TokenKind::UnclosedComment => {
                self.pieces.open = true;
                self.fault(FaultKind::UnclosedComment, token);
            }
            TokenKind::Bad => self.fault(FaultKind::Bad, token),
            TokenKind::Number | TokenKind::Text | TokenKind::Semicolon | TokenKind::Comment => {}
        }
    }

    fn word(&mut self, token: Token) {
        let mut upper = [0; 7];
        let word = token.text(self.text);
        let Some(upper) = upper.get_mut(..word.len()) else { return };
        upper.copy_from_slice(word.as_bytes());
        upper.make_ascii_uppercase();
        match &*upper {
            b"IF" => {
                self.level().ifs += 1;
                self.govern();
            }
            b"WHILE" | b"FOR" => self.govern(),
            b"ELSE" => {
                let level = self.level();
                level.ifs = level.ifs.saturating_sub(1);
                self.end_run();
            }
            b"NOT" | b"AT" => self.nest(),
            b"THEN" | b"DO" | b"AND" | b"OR" | b"WHERE" | b"TO" | b"IN" => self.end_run(),
            b"BEGIN" => self.levels.push(Level::new(token, true)),
            b"END" => self.end_block(token),
            _ => {}
        }
    }

    fn govern(&mut self) {
        self.level().governed += 1;
        self.nested += 1;
    }

    fn close(&mut self, token: Token) {
        let level = *self.level();
        let open = if token.text(self.text) == ")" { "(" } else { "[" };
        if level.block {
            self.fault(FaultKind::StrayClose, token);
        } else if level.opener.text(self.text) == open {
            self.pop();
        } else {
            self.fault(FaultKind::Mismatch(level.opener.start), token);
            self.pop();
        }
    }

    /// Closes the brackets that are still open where a statement or block ends at byte `end`.
    fn close_brackets(&mut self, end: usize) {
        while !self.level().block {
            let opener = self.level().opener;
            self.fault(FaultKind::Unclosed(end), opener);
            self.pop();
        }
    }

    fn end_block(&mut self, token: Token) {
        self.close_brackets(token.start);
        if self.levels.len() == 1 {
            self.fault(FaultKind::StrayEnd, token);
        } else {
            self.pop();
        }
    }

    /// Whether an IF of the statement at hand may still take an ELSE.
    fn awaits_else(&self) -> bool {
        let inner = self.levels.iter().rposition(|l| l.block).unwrap_or(0);
        self.levels[inner..].iter().any(|l| l.ifs > 0)
    }

    fn semicolon(&mut self, token: Token, rest: &Scanner<'_>) {
        self.operand_before = false;
        let next = rest.clone().find(|t| t.kind != TokenKind::Comment);
        let otherwise = next.is_some_and(|t| t.is_word(self.text, "ELSE"));
        if otherwise && self.awaits_else() {
            while self.level().ifs == 0 {
                let opener = self.level().opener;
                self.fault(FaultKind::Unclosed(token.start), opener);
                self.pop();
            }
            self.end_run();
            return;
        }
        self.close_brackets(token.start);
        self.end_part();
        if self.levels.len() > 1 {
            return;
        }
        if let Some(mut chunk) = self.chunk.take() {
            chunk.semicolon = Some(token.end);
            self.pieces.chunks.push(chunk);
        }
    }

    fn finish(mut self) -> Pieces {
        let end = self.text.len();
        while self.levels.len() > 1 {
            self.pieces.open = true;
            let level = *self.level();
            let kind = if level.block { FaultKind::UnclosedBlock } else { FaultKind::Unclosed(end) };
            self.fault(kind, level.opener);
            self.pop();
        }
        self.pieces.chunks.extend(self.chunk.take());
        self.pieces
    }
}
