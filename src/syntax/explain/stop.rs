//! Why the grammar stopped where it did, in the user's words: from the tokens around the place, never from the grammar's
//! own list of what it expected.

use super::place::{Place, begins_statement, definition_head};
use crate::diagnostic::Diagnostic;
use crate::syntax::scan::{Token, TokenKind, coordinate_digits, is_reserved};

/// Where a statement ends without its `;` and the next begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Forgotten {
    /// The byte after the statement.
    pub after: usize,
    /// The first byte of the next.
    pub statement: usize,
}

/// A message, and whether it is about the end of the statement.
#[derive(Clone, Debug)]
pub struct Explained {
    /// What to say.
    pub diagnostic: Diagnostic,
    /// Whether the statement only stops too early.
    pub at_end: bool,
}

/// Tokens around a place: those before it, and the rest from it on.
struct Around<'t> {
    place: Place<'t>,
    tokens: Vec<Token>,
    at: usize,
}

impl<'t> Around<'t> {
    fn new(place: Place<'t>, byte: usize) -> Self {
        let tokens = place.tokens();
        let at = tokens.iter().position(|t| t.end > byte).unwrap_or(tokens.len());
        Self { place, tokens, at }
    }

    fn before(&self) -> Option<Token> {
        self.at.checked_sub(1).and_then(|n| self.tokens.get(n)).copied()
    }

    fn here(&self) -> Option<Token> {
        self.tokens.get(self.at).copied()
    }

    fn word(&self, token: Option<Token>) -> &'t str {
        token.map_or("", |t| t.text(self.place.text))
    }

    fn is(&self, token: Option<Token>, word: &str) -> bool {
        token.is_some_and(|t| t.is_word(self.place.text, word))
    }
}

/// The statement that follows without a `;` before it, if the grammar stopped at byte `at` because of that.
pub fn forgotten_semicolon(place: Place<'_>, at: usize) -> Option<Forgotten> {
    let around = Around::new(place, at);
    let (before, here) = (around.before()?, around.here()?);
    let apart = before.end < here.start || before.kind != TokenKind::Number;
    let ends = before.ends_operand(place.text) || before.is_word(place.text, "END");
    let begins = begins_statement(place.text, &around.tokens, around.at);
    (ends && begins && apart).then_some(Forgotten { after: before.end, statement: here.start })
}

/// The message about a forgotten `;`.
pub fn missing_semicolon(place: Place<'_>, next: Forgotten) -> Diagnostic {
    let tokens = Place { start: next.statement, ..place }.tokens();
    let first = tokens.first().copied();
    let name = first.map_or("", |t| t.text(place.text));
    let error = Diagnostic::error("missing-semicolon", "a `;` is missing at the end of this statement")
        .at(last_character(place, next.after), "`;` is missing behind this");
    match first {
        Some(token) => error.see(place.span(token), "the next statement begins here"),
        None => error,
    }
    .help(format!("write `;` before `{name}`"))
}

/// The message about a script whose last statement has no `;`.
pub fn missing_last_semicolon(place: Place<'_>) -> Diagnostic {
    Diagnostic::error("missing-semicolon", "a `;` is missing at the end of this statement")
        .at(last_character(place, place.end), "`;` is missing behind this")
        .help("end each statement of a script with `;`")
}

fn last_character(place: Place<'_>, end: usize) -> crate::source::Span {
    let length = place.text[..end].chars().next_back().map_or(0, char::len_utf8);
    place.range(end - length, end)
}

/// Why the grammar stopped at byte `at`.
pub fn unexpected(place: Place<'_>, at: usize) -> Explained {
    let around = Around::new(place, at);
    let at_end = around.here().is_none();
    let diagnostic = construct(&around)
        .or_else(|| head(&around))
        .or_else(|| keyword(&around))
        .or_else(|| between(&around))
        .unwrap_or_else(|| anything(&around));
    Explained { diagnostic, at_end }
}

fn error(code: &'static str, title: impl Into<String>) -> Diagnostic {
    Diagnostic::error(code, title)
}

/// Points at the token where the grammar stopped, or behind the last one.
fn here(around: &Around<'_>, text: &str) -> (crate::source::Span, String) {
    let span = match around.here() {
        Some(token) => around.place.span(token),
        None => last_character(around.place, around.before().map_or(around.place.end, |t| t.end)),
    };
    (span, text.to_owned())
}

/// The innermost IF, WHILE or FOR before the place that still waits for its word, and that word.
fn waiting(around: &Around<'_>) -> Option<(Token, &'static str)> {
    let mut open: Vec<(Token, &'static str)> = Vec::new();
    for token in &around.tokens[..around.at] {
        let is = |word| token.is_word(around.place.text, word);
        if is("IF") {
            open.push((*token, "THEN"));
        } else if is("WHILE") {
            open.push((*token, "DO"));
        } else if is("FOR") {
            open.push((*token, "TO"));
        } else if let Some(last) = open.last_mut() {
            match last.1 {
                "TO" if is("TO") => last.1 = "DO",
                wanted if is(wanted) => drop(open.pop()),
                _ => {}
            }
        }
    }
    open.pop()
}

/// A THEN, DO or TO that is missing: the operand before the place is complete and something else follows.
fn construct(around: &Around<'_>) -> Option<Diagnostic> {
    let (opener, wanted) = waiting(around)?;
    let complete = around.before().is_some_and(|t| t.ends_operand(around.place.text) && t != opener);
    let fits =
        around.here().is_none_or(|t| matches!(t.kind, TokenKind::Word | TokenKind::Number | TokenKind::Semicolon));
    let symbol_next = around.here().is_some_and(|t| t.kind == TokenKind::Symbol);
    if !complete || !(fits || symbol_next) {
        return None;
    }
    let name = opener.text(around.place.text).to_ascii_uppercase();
    let (span, text) = here(around, &format!("{wanted} is expected here"));
    let form = match name.as_str() {
        "IF" => "IF condition THEN ... ELSE ...",
        "WHILE" => "WHILE (condition) DO statement;",
        _ => "FOR i = first TO last DO statement;",
    };
    let code = match wanted {
        "THEN" => "missing-then",
        "DO" => "missing-do",
        _ => "missing-to",
    };
    let error = error(code, format!("{wanted} is missing in this {name}")).at(span, text);
    Some(error.see(around.place.span(opener), "").help(format!("write {form}")))
}

/// What is wrong with the word that a statement would define.
fn head(around: &Around<'_>) -> Option<Diagnostic> {
    let text = around.place.text;
    let token = around.here()?;
    let word = token.text(text);
    let assigned =
        |at: usize| around.tokens.get(at).is_some_and(|t| t.kind == TokenKind::Symbol && t.text(text) == "=");
    let span = around.place.span(token);
    let heads = token.kind == TokenKind::Word && definition_head(text, &around.tokens, around.at).is_some();
    if heads && coordinate_digits(word).is_some() && around.before().is_none_or(|t| !t.ends_operand(text)) {
        return Some(super::form::defined_coordinate(word, span));
    }
    if token.kind == TokenKind::Word && is_reserved(word) && assigned(around.at + 1) {
        return Some(reserved(around, token));
    }
    let before = around.before()?;
    let glued = before.kind == TokenKind::Number && before.end == token.start && token.kind == TokenKind::Word;
    if glued && around.at == 1 && definition_head(text, &around.tokens, 1).is_some() {
        let whole = around.place.range(before.start, token.end);
        let title = format!("a name cannot begin with a digit: `{}{word}`", before.text(text));
        return Some(error("name-begins-with-digit", title).at(whole, "").help("begin it with a letter or `_`"));
    }
    if before.is_word(text, before.text(text)) && is_reserved(before.text(text)) && word == "=" {
        return Some(reserved(around, before));
    }
    None
}

fn reserved(around: &Around<'_>, token: Token) -> Diagnostic {
    let word = token.text(around.place.text);
    let title = format!("`{word}` is a reserved word and cannot be a name");
    let help = format!("choose another name, `{word}_1` for one; reserved words are the same in upper and lower case");
    error("reserved-name", title).at(around.place.span(token), "").help(help)
}

/// A reserved word where none can stand.
fn keyword(around: &Around<'_>) -> Option<Diagnostic> {
    let token = around.here()?;
    let word = token.text(around.place.text);
    if token.kind != TokenKind::Word || !is_reserved(word) {
        return None;
    }
    let upper = word.to_ascii_uppercase();
    let span = around.place.span(token);
    let complete = around.before().is_some_and(|t| t.ends_operand(around.place.text));
    let built = match upper.as_str() {
        "IF" | "NOT" if !complete => {
            let title = format!("{upper} as an operand needs parentheses");
            error("needs-parentheses", title).at(span, "").help(format!("write ({upper} ...)"))
        }
        "WHERE" if complete => {
            error("misplaced-where", "WHERE stands only at the end of a definition or of its own parentheses")
                .at(span, "")
                .help("put the expression and its WHERE in parentheses: (e WHERE q = ...)")
        }
        "ELSE" => error("stray-else", "this ELSE has no IF")
            .at(span, "")
            .help("write IF condition THEN ... ELSE ...")
            .help("several statements between THEN and ELSE need BEGIN ... END"),
        "IN" => range_form(span),
        "BEGIN" => error("stray-begin", "this BEGIN belongs to nothing")
            .at(span, "")
            .help("a block stands behind THEN, ELSE, DO or `name(...) =`"),
        "THEN" | "DO" | "TO" | "END" if complete => {
            let opener = match upper.as_str() {
                "THEN" => "IF",
                "DO" => "WHILE or FOR",
                "TO" => "FOR or fold",
                _ => "BEGIN",
            };
            error("stray-keyword", format!("this {upper} has no {opener}"))
                .at(span, "")
                .help(format!("remove it, or add the {opener}"))
        }
        _ if complete => error("missing-operator", format!("{upper} cannot stand here"))
            .at(span, "")
            .help("end the statement before it with `;`, or put an operator between"),
        _ => {
            let title = format!("an expression is missing before {upper}");
            error("missing-expression", title).at(span, "an expression is expected here").help("write a value here")
        }
    };
    Some(built)
}

/// Two operands without an operator, or two operators without an operand.
fn between(around: &Around<'_>) -> Option<Diagnostic> {
    let text = around.place.text;
    let before = around.before();
    let complete = before.is_some_and(|t| t.ends_operand(text));
    let Some(token) = around.here() else { return Some(ends(around, complete)) };
    let span = around.place.span(token);
    let found = token.text(text);
    if complete && let Some(diagnostic) = separated(around, token) {
        return Some(diagnostic);
    }
    let operand = matches!(token.kind, TokenKind::Number | TokenKind::Word | TokenKind::Text)
        || (token.kind == TokenKind::Open && found == "(");
    if complete && operand {
        let last = before?;
        let title = format!("an operator is missing between `{}` and `{found}`", last.text(text));
        let help = separator(around, last, token);
        return Some(error("missing-operator", title).at(span, "").see(around.place.span(last), "").help(help));
    }
    if around.is(before, "AT") {
        return Some(
            error("at-form", "AT needs parentheses").at(span, "").help("write e AT (x1 + 1, x2) or e AT (x4 = 0.5)"),
        );
    }
    if around.is(before, "INCLUDE") {
        return Some(include_form(span));
    }
    if around.word(before) == ":" {
        return Some(type_word(around, token));
    }
    let closes = matches!(token.kind, TokenKind::Close | TokenKind::Comma | TokenKind::Semicolon | TokenKind::Symbol);
    if !complete && closes {
        let title = match before {
            Some(last) if last.kind == TokenKind::Symbol => {
                format!("an expression is missing between `{}` and `{found}`", last.text(text))
            }
            _ => format!("an expression is missing before `{found}`"),
        };
        let help = doubled(around.word(before), found).unwrap_or("write a value here");
        return Some(error("missing-expression", title).at(span, "an expression is expected here").help(help));
    }
    None
}

/// The bracket that is open at the place, and the word right before it.
fn enclosing<'t>(around: &Around<'t>) -> Option<(&'t str, &'t str)> {
    let mut depth = 0_usize;
    for (n, token) in around.tokens[..around.at].iter().enumerate().rev() {
        match token.kind {
            TokenKind::Close => depth += 1,
            TokenKind::Open if depth == 0 => {
                let before = n.checked_sub(1).map(|n| around.tokens[n]).filter(|t| t.kind == TokenKind::Word);
                return Some((token.text(around.place.text), around.word(before)));
            }
            TokenKind::Open => depth -= 1,
            _ => {}
        }
    }
    None
}

/// What may stand between two operands.
fn separator(around: &Around<'_>, last: Token, token: Token) -> &'static str {
    match enclosing(around) {
        _ if last.kind == TokenKind::Number && token.kind == TokenKind::Number && last.end == token.start => {
            "a number has one point"
        }
        _ if last.end == token.start => "for a product write `*` between",
        Some((bracket, word)) if bracket == "[" || !word.is_empty() => "put an operator or `,` between",
        Some(_) => "put an operator between",
        None => "put an operator or `;` between",
    }
}

/// `(1, 2)`, `IN [1]`, `4 STEP 3`: forms that are nearly right.
fn separated(around: &Around<'_>, token: Token) -> Option<Diagnostic> {
    let text = around.place.text;
    let span = around.place.span(token);
    if token.is_word(text, "STEP") {
        return Some(range_form(span));
    }
    match (token.text(text), enclosing(around)?) {
        ("]" | ",", ("[", word)) if word.eq_ignore_ascii_case("IN") => Some(range_form(span)),
        (",", ("(", word)) if word.is_empty() || is_reserved(word) => Some(
            error("unexpected", "`,` cannot stand in these parentheses").at(span, "").help("for an array write [1, 2]"),
        ),
        _ => None,
    }
}

fn range_form(span: crate::source::Span) -> Diagnostic {
    error("range-form", "a range is written IN [smallest, largest] STEP step")
        .at(span, "")
        .help("write r1 = 4 IN [1, 8] STEP 0.5;")
}

/// `INCLUDE file.geo`
pub fn include_form(span: crate::source::Span) -> Diagnostic {
    error("include-form", "INCLUDE needs a file name in quotes").at(span, "").help("write INCLUDE \"file.geo\";")
}

/// The grammar gave up, which only a text of monstrous shape can make it do.
pub fn gave_up(place: Place<'_>) -> Diagnostic {
    error("too-complex", "this statement is too complex to read")
        .at(place.range(place.start, place.start), "it begins here")
        .help("give parts of it names of their own")
}

/// What two symbols in a row may mean elsewhere.
fn doubled(first: &str, second: &str) -> Option<&'static str> {
    match (first, second) {
        ("&", "&") => Some("write AND for conditions, one `&` for objects"),
        ("|", "|") => Some("write OR for conditions, one `|` for objects"),
        (":", "=") => Some("write `=` to define"),
        ("=", ">") => Some("write `>=`"),
        ("=", "<") => Some("write `<=`"),
        ("<", ">") => Some("write `<>`"),
        _ => None,
    }
}

fn type_word(around: &Around<'_>, token: Token) -> Diagnostic {
    let found = token.text(around.place.text);
    let span = around.place.span(token);
    if found == "=" {
        return error("missing-expression", "`:=` is not an operator here").at(span, "").help("write `=` to define");
    }
    error("unknown-type", format!("`{found}` is no geometric type"))
        .at(span, "")
        .help("the types are X, Y, Z, T, V, W, C, CONSTANT = e, G = [...], CENTER = [...] and COLOR = [r, g, b]")
}

/// The statement stops too early.
fn ends(around: &Around<'_>, complete: bool) -> Diagnostic {
    let last = around.word(around.before());
    let (span, text) = here(around, "something is missing behind this");
    if complete {
        return error("unfinished-statement", format!("the statement is not finished after `{last}`"))
            .at(span, text)
            .help("write the rest of it");
    }
    error("missing-expression", format!("the statement ends after `{last}`, where an expression is expected"))
        .at(span, text)
        .help("write the missing value")
}

fn anything(around: &Around<'_>) -> Diagnostic {
    let found = around.word(around.here());
    let (span, _) = here(around, "");
    let error = error("unexpected", format!("`{found}` cannot stand here")).at(span, "");
    match around.before() {
        Some(last) => error.help(format!("look at what stands before it: `{}`", last.text(around.place.text))),
        None => error.help("a statement begins with a name, a coordinate, IF, WHILE, FOR, PRINT or INCLUDE"),
    }
}
