//! Words, numbers, texts, comments and symbols of a source, one after another, without recursion and without a copy.
//!
//! This is what the checks before the grammar, the messages and the formatter walk over. It never fails: what is no part
//! of the language comes out as [`TokenKind::Bad`]. It builds no tree; that is the grammar's business.

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A name, a coordinate or a reserved word.
    Word,
    /// `1.5e-3`
    Number,
    /// `"..."`
    Text,
    /// A `"` whose line ends before the closing one.
    UnclosedText,
    /// `( [`
    Open,
    /// `) ]`
    Close,
    /// `;`
    Semicolon,
    /// `,`
    Comma,
    /// `+ - * / ** ^ | \ & @ ~ < <= > >= = == <> != /= :`
    Symbol,
    /// `{ ... }` or `// ...`
    Comment,
    /// A `{` that nothing closes.
    UnclosedComment,
    /// One character that the language does not know.
    Bad,
}

/// A token and its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// The first byte.
    pub start: usize,
    /// The byte after the last.
    pub end: usize,
}

impl Token {
    /// The characters of the token.
    #[must_use]
    pub fn text<'t>(&self, source: &'t str) -> &'t str {
        &source[self.start..self.end]
    }

    /// Whether the token is this reserved word, in any case.
    #[must_use]
    pub fn is_word(&self, source: &str, word: &str) -> bool {
        self.kind == TokenKind::Word && self.text(source).eq_ignore_ascii_case(word)
    }

    /// Whether an operand ends with this token.
    #[must_use]
    pub fn ends_operand(&self, source: &str) -> bool {
        match self.kind {
            TokenKind::Number | TokenKind::Text | TokenKind::Close => true,
            TokenKind::Word => !is_reserved(self.text(source)),
            _ => false,
        }
    }
}

/// The words that are never names, in upper case.
pub const RESERVED: [&str; 17] = [
    "IF", "THEN", "ELSE", "WHILE", "DO", "FOR", "TO", "BEGIN", "END", "AND", "OR", "NOT", "AT", "WHERE", "IN",
    "INCLUDE", "PRINT",
];

/// Whether `word` is reserved, in any case. `PI` is a value, not a keyword, and is not among these.
#[must_use]
pub fn is_reserved(word: &str) -> bool {
    word.len() <= 7 && RESERVED.iter().any(|r| r.eq_ignore_ascii_case(word))
}

/// The digits of `word` if it is written like a coordinate, `x` and digits in either case.
#[must_use]
pub fn coordinate_digits(word: &str) -> Option<&str> {
    let digits = word.strip_prefix(['x', 'X'])?;
    (!digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())).then_some(digits)
}

/// Walks over a source text.
#[derive(Clone, Debug)]
pub struct Scanner<'t> {
    text: &'t str,
    at: usize,
    end: usize,
}

impl<'t> Scanner<'t> {
    /// Starts at byte `start` and stops before byte `end`; both must be character boundaries.
    #[must_use]
    pub fn new(text: &'t str, start: usize, end: usize) -> Self {
        Self { text, at: start, end }
    }

    fn bytes(&self) -> &'t [u8] {
        &self.text.as_bytes()[..self.end]
    }

    fn byte(&self, at: usize) -> u8 {
        self.bytes().get(at).copied().unwrap_or(0)
    }

    fn skip_space(&mut self) {
        while self.at < self.end {
            let byte = self.byte(self.at);
            if byte.is_ascii_whitespace() || byte == 0x0b {
                self.at += 1;
            } else if byte >= 0x80 {
                match self.text[self.at..self.end].chars().next() {
                    Some(c) if is_space(c) => self.at += c.len_utf8(),
                    _ => return,
                }
            } else {
                return;
            }
        }
    }

    /// The first place from `from` on where `stop` holds, or the end.
    fn until(&self, from: usize, stop: impl Fn(u8) -> bool) -> usize {
        self.bytes()[from..].iter().position(|&b| stop(b)).map_or(self.end, |n| from + n)
    }

    fn digits(&self, from: usize) -> usize {
        self.until(from, |b| !b.is_ascii_digit())
    }

    fn number(&self) -> usize {
        let mut end = self.digits(self.at);
        if self.byte(end) == b'.' {
            end = self.digits(end + 1);
        }
        if self.byte(end).eq_ignore_ascii_case(&b'e') {
            let sign = usize::from(matches!(self.byte(end + 1), b'+' | b'-'));
            if self.byte(end + 1 + sign).is_ascii_digit() {
                end = self.digits(end + 1 + sign);
            }
        }
        end
    }

    fn word(&self) -> usize {
        let mut end = self.until(self.at, |b| !(b.is_ascii_alphanumeric() || b == b'_'));
        if self.byte(end) >= 0x80 {
            let rest = self.text[end..self.end].char_indices();
            let after = rest.into_iter().find(|(_, c)| !(c.is_alphabetic() || c.is_ascii_digit() || *c == '_'));
            end = after.map_or(self.end, |(n, _)| end + n);
        }
        end
    }

    fn symbol(&self) -> (TokenKind, usize) {
        let pair = [self.byte(self.at), self.byte(self.at + 1)];
        if matches!(&pair, b"**" | b"<=" | b">=" | b"<>" | b"==" | b"!=" | b"/=") {
            return (TokenKind::Symbol, 2);
        }
        let kind = match pair[0] {
            b'(' | b'[' => TokenKind::Open,
            b')' | b']' => TokenKind::Close,
            b';' => TokenKind::Semicolon,
            b',' => TokenKind::Comma,
            b'+' | b'-' | b'*' | b'/' | b'^' | b'|' | b'\\' | b'&' | b'@' | b'~' | b'<' | b'>' | b'=' | b':' => {
                TokenKind::Symbol
            }
            _ => TokenKind::Bad,
        };
        (kind, self.text[self.at..self.end].chars().next().map_or(1, char::len_utf8))
    }

    fn token(&self) -> (TokenKind, usize) {
        let byte = self.byte(self.at);
        match byte {
            b'{' => match self.until(self.at, |b| b == b'}') {
                end if end < self.end => (TokenKind::Comment, end + 1),
                end => (TokenKind::UnclosedComment, end),
            },
            b'/' if self.byte(self.at + 1) == b'/' => {
                (TokenKind::Comment, self.until(self.at, |b| b == b'\n' || b == b'\r'))
            }
            b'"' => match self.until(self.at + 1, |b| matches!(b, b'"' | b'\n' | b'\r')) {
                end if end < self.end && self.byte(end) == b'"' => (TokenKind::Text, end + 1),
                end => (TokenKind::UnclosedText, end),
            },
            b'0'..=b'9' => (TokenKind::Number, self.number()),
            b'.' if self.byte(self.at + 1).is_ascii_digit() => (TokenKind::Number, self.number()),
            b'_' | b'a'..=b'z' | b'A'..=b'Z' => (TokenKind::Word, self.word()),
            _ if byte >= 0x80 && self.text[self.at..].starts_with(char::is_alphabetic) => {
                (TokenKind::Word, self.word())
            }
            _ => {
                let (kind, length) = self.symbol();
                (kind, self.at + length)
            }
        }
    }
}

/// White space outside texts and comments, the byte order mark included.
#[must_use]
pub fn is_space(c: char) -> bool {
    c.is_whitespace() || c == '\u{feff}'
}

impl Iterator for Scanner<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        self.skip_space();
        if self.at >= self.end {
            return None;
        }
        let start = self.at;
        let (kind, end) = self.token();
        self.at = end;
        Some(Token { kind, start, end })
    }
}
