//! From the tree back to text: the formatter of `yont fmt` and the writer of `:save`. What it writes parses to the same
//! tree, and formatting it again changes nothing.
//!
//! Canonical style: one statement a line, keywords in upper case, `name = expression;`, spaces around loose operators and
//! none around `*`, `/` and `**`, blocks indented by two spaces, no line longer than it must be.

mod comments;
mod expression;

use self::comments::{Comments, Gap};
use self::expression::Writer;
use super::parse::{Mode, parse};
use super::tree::{Body, ExprKind, GeometricType, Parameter, Range, Statement, StatementKind};
use crate::diagnostic::Diagnostic;
use crate::limits::Limits;
use crate::source::{SourceId, SourceMap};

/// Columns before a long expression is broken into lines.
const WIDTH: usize = 100;
/// Spaces of one level of a block.
const INDENT: usize = 2;

/// The canonical form of a whole text, comments kept; blank lines are kept, several as one.
///
/// A statement with a comment in its middle is left as it is written.
///
/// # Errors
/// The messages of a text that does not parse.
pub fn format(sources: &SourceMap, id: SourceId, limits: &Limits) -> Result<String, Vec<Diagnostic>> {
    let parsed = parse(sources, id, limits, Mode::Prompt);
    if parsed.diagnostics.iter().any(Diagnostic::is_error) {
        return Err(parsed.diagnostics);
    }
    let text = sources.get(id).map_or("", |s| s.text.as_str());
    let comments = Comments::of(text);
    let mut printer = Printer { writer: Writer::with_source(text), comments: Some(&comments), indent: 0 };
    printer.sequence(&parsed.statements, 0, text.len());
    Ok(printer.writer.finish())
}

/// One statement in canonical form, with its `;`, without comments.
#[must_use]
pub fn statement(statement: &Statement) -> String {
    let mut printer = Printer { writer: Writer::default(), comments: None, indent: 0 };
    printer.statement(statement);
    printer.writer.push(";");
    printer.writer.finish()
}

/// An expression in canonical form on one line.
#[must_use]
pub fn expression(expr: &super::tree::Expr) -> String {
    let mut writer = Writer::default();
    writer.value(expr);
    writer.finish()
}

struct Printer<'t> {
    writer: Writer<'t>,
    comments: Option<&'t Comments<'t>>,
    indent: usize,
}

impl Printer<'_> {
    fn line(&mut self) {
        self.writer.line(self.indent);
    }

    /// The statements between bytes `from` and `to` of the text, each with its `;` and the comments around it.
    fn sequence(&mut self, statements: &[Statement], from: usize, to: usize) {
        let mut after = from;
        for statement in statements {
            let (start, end) = (statement.span.start as usize, statement.span.end as usize);
            self.gap(after, start, false);
            self.line();
            if !self.verbatim(statement) {
                self.statement(statement);
                self.writer.push(";");
            }
            after = end;
        }
        self.gap(after, to, true);
    }

    /// What stands between two statements: comments, each on its line or behind what it follows, and a blank line.
    fn gap(&mut self, from: usize, to: usize, last: bool) {
        let Some(comments) = self.comments else { return };
        for item in comments.gap(from, to) {
            match item {
                Gap::Blank => self.writer.blank(),
                Gap::Trailing(comment) => {
                    self.writer.push(" ");
                    self.writer.push(comment);
                }
                Gap::Own(comment) => {
                    self.line();
                    self.writer.push(comment);
                }
            }
        }
        if last {
            self.writer.drop_blank();
        }
    }

    /// Writes a statement as it stands in the text if a comment in its middle has no other place.
    fn verbatim(&mut self, statement: &Statement) -> bool {
        let Some(comments) = self.comments else { return false };
        let keep = comments.inside(statement) > blocks_inside(comments, statement);
        if keep {
            let written = &comments.text[statement.span.range()];
            self.writer.push(written);
            if !written.ends_with(';') {
                // A comment to the end of the line would swallow the `;`.
                self.line();
                self.writer.push(";");
            }
        }
        keep
    }

    fn statement(&mut self, statement: &Statement) {
        match &statement.kind {
            StatementKind::Define { name, parameters, body, range } => {
                self.writer.push(&name.name);
                self.parameters(parameters.as_deref());
                self.writer.push(" = ");
                match body {
                    Body::Expression(e) => self.writer.broken(e, self.indent + INDENT),
                    Body::Block(block) => self.block(block, statement),
                }
                self.range(range.as_ref());
            }
            StatementKind::Element { name, indices, value } => {
                self.writer.push(&name.name);
                self.writer.bracketed("[", indices, "]");
                self.writer.push(" = ");
                self.writer.broken(value, self.indent + INDENT);
            }
            StatementKind::If { condition, then, otherwise } => {
                self.if_(statement, condition, then, otherwise.as_deref())
            }
            StatementKind::While { condition, body } => {
                self.writer.push("WHILE ");
                self.writer.expr(condition);
                self.writer.push(" DO ");
                self.branch(body, statement, false);
            }
            StatementKind::For { index, from, to, step, body } => {
                self.writer.push("FOR ");
                self.writer.push(&index.name);
                self.writer.keyed(" = ", from);
                self.writer.keyed(" TO ", to);
                if let Some(step) = step {
                    self.writer.keyed(" STEP ", step);
                }
                self.writer.push(" DO ");
                self.branch(body, statement, false);
            }
            StatementKind::Type { subject, kind } => self.type_(&subject.name, kind),
            StatementKind::Include { path, .. } => self.writer.push(&format!("INCLUDE \"{path}\"")),
            StatementKind::Print { items } => {
                self.writer.push("PRINT");
                self.writer.bracketed(if items.is_empty() { "" } else { " " }, items, "");
            }
            StatementKind::Expression(e) => self.writer.broken(e, self.indent + INDENT),
            StatementKind::Failed { .. } => {}
        }
    }

    fn parameters(&mut self, parameters: Option<&[Parameter]>) {
        let Some(parameters) = parameters else { return };
        let one = |p: &Parameter| match &p.kind {
            Some((_, words)) => format!("({words}) {}", p.name.name),
            None => p.name.name.to_string(),
        };
        let parts: Vec<_> = parameters.iter().map(one).collect();
        self.writer.push(&format!("({})", parts.join(", ")));
    }

    fn range(&mut self, range: Option<&Range>) {
        let Some(range) = range else { return };
        self.writer.keyed(" IN [", &range.lo);
        self.writer.keyed(", ", &range.hi);
        self.writer.push("]");
        if let Some(step) = &range.step {
            self.writer.keyed(" STEP ", step);
        }
    }

    fn type_(&mut self, subject: &str, kind: &GeometricType) {
        let (word, value) = match kind {
            GeometricType::X => ("X", None),
            GeometricType::Y => ("Y", None),
            GeometricType::Z => ("Z", None),
            GeometricType::T => ("T", None),
            GeometricType::V => ("V", None),
            GeometricType::W => ("W", None),
            GeometricType::C => ("C", None),
            GeometricType::Constant(e) => ("CONSTANT", e.as_ref()),
            GeometricType::Group(e) => ("G", e.as_ref()),
            GeometricType::Center(e) => ("CENTER", e.as_ref()),
            GeometricType::Color(e, _) => ("COLOR", e.as_ref()),
        };
        self.writer.push(&format!("{subject} : {word}"));
        if let Some(value) = value {
            self.writer.keyed(" = ", value);
        }
        if let GeometricType::Color(_, Some(range)) = kind {
            self.writer.keyed(" IN [", &range[0]);
            self.writer.keyed(", ", &range[1]);
            self.writer.push("]");
        }
    }

    fn if_(
        &mut self,
        whole: &Statement,
        condition: &super::tree::Expr,
        then: &[Statement],
        otherwise: Option<&[Statement]>,
    ) {
        self.writer.push("IF ");
        self.writer.expr(condition);
        self.writer.push(" THEN ");
        self.branch(then, whole, otherwise.is_some());
        if let Some(otherwise) = otherwise {
            self.writer.push(" ELSE ");
            self.branch(otherwise, whole, false);
        }
    }

    /// One statement as it is, several as a block; `guarded` means an ELSE follows that must not belong to the inner one.
    fn branch(&mut self, statements: &[Statement], whole: &Statement, guarded: bool) {
        match statements {
            [one] if (!guarded || !takes_else(one)) && !self.commented(one, whole) => self.statement(one),
            _ => self.block(statements, whole),
        }
    }

    /// Whether `inner` has a block of its own with comments, which has to stay to hold them.
    fn commented(&self, inner: &Statement, whole: &Statement) -> bool {
        let held = |c: &Comments<'_>| c.block(whole, inner, inner).is_some_and(|(from, to)| c.between(from, to) > 0);
        self.comments.is_some_and(held)
    }

    fn block(&mut self, statements: &[Statement], whole: &Statement) {
        self.writer.push("BEGIN");
        self.indent += INDENT;
        let ends = statements.first().zip(statements.last());
        let range = self.comments.zip(ends).and_then(|(comments, (first, last))| {
            let (start, end) = (first.span.start as usize, last.span.end as usize);
            comments.block(whole, first, last).or(Some((start, end)))
        });
        let (from, to) = range.unwrap_or_default();
        self.sequence(statements, from, to);
        self.indent -= INDENT;
        self.line();
        self.writer.push("END");
    }
}

/// Whether an ELSE behind this statement would belong to it.
fn takes_else(statement: &Statement) -> bool {
    match &statement.kind {
        StatementKind::If { otherwise, .. } => match otherwise.as_deref() {
            None => true,
            Some([last]) => takes_else(last),
            Some(_) => false,
        },
        StatementKind::While { body, .. } | StatementKind::For { body, .. } => {
            matches!(body.as_slice(), [one] if takes_else(one))
        }
        StatementKind::Define { body: Body::Expression(e), range: None, .. }
        | StatementKind::Element { value: e, .. }
        | StatementKind::Expression(e) => open_if(e),
        StatementKind::Print { items } => items.last().is_some_and(open_if),
        StatementKind::Type { kind: GeometricType::Color(_, Some(_)), .. } => false,
        StatementKind::Type { kind, .. } => kind.expressions().last().is_some_and(open_if),
        _ => false,
    }
}

/// Whether an expression ends with an IF that has no ELSE.
fn open_if(e: &super::tree::Expr) -> bool {
    match &e.kind {
        ExprKind::If { otherwise: None, .. } => true,
        ExprKind::If { otherwise: Some(last), .. } => open_if(last),
        ExprKind::Where { bindings, .. } => bindings.last().is_some_and(|(_, e)| open_if(e)),
        _ => false,
    }
}

/// How many comments of a statement stand in its blocks, where the formatter keeps them.
fn blocks_inside(comments: &Comments<'_>, statement: &Statement) -> usize {
    let groups: Vec<&[Statement]> = match &statement.kind {
        StatementKind::Define { body: Body::Block(block), .. } => vec![block],
        StatementKind::If { then, otherwise, .. } => {
            std::iter::once(then.as_slice()).chain(otherwise.as_deref()).collect()
        }
        StatementKind::While { body, .. } | StatementKind::For { body, .. } => vec![body],
        _ => Vec::new(),
    };
    let in_group = |group: &[Statement]| {
        let (Some(first), Some(last)) = (group.first(), group.last()) else { return 0 };
        match comments.block(statement, first, last) {
            Some((from, to)) => comments.between(from, to),
            None => blocks_inside(comments, first),
        }
    };
    groups.into_iter().map(in_group).sum()
}
