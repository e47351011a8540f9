//! Messages about what the grammar lets through and the language does not.

use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::syntax::tree::{Expr, ExprKind, Ident};

/// `1e999`
pub fn number_too_large(span: Span) -> Diagnostic {
    Diagnostic::error("number-too-large", "this number is too large")
        .at(span, "")
        .help("the largest number is about 1.8e308")
}

/// `x0`, `x17`, `x04`
pub fn no_such_coordinate(word: &str, span: Span) -> Diagnostic {
    Diagnostic::error("no-such-coordinate", format!("there is no coordinate `{word}`"))
        .at(span, "")
        .help("the coordinates are x1, x2, ... x16; a name of one's own cannot be x and digits")
}

/// `x1(2)`
pub fn called_coordinate(word: &str, span: Span) -> Diagnostic {
    Diagnostic::error("called-coordinate", format!("`{word}` is a coordinate, not a function"))
        .at(span, "")
        .help(format!("write `{word}*(...)` for a product"))
}

/// `SIN(i = 1 TO 2)`
pub fn misplaced_to(span: Span, callee: &Ident) -> Diagnostic {
    Diagnostic::error("misplaced-to", format!("`{}` does not run over an index", callee.name))
        .at(span, "")
        .see(callee.span, "")
        .help("the folds do: SUM(i = 1 TO n, ...), PRODUCT, UNION, INTERSECTION, MINIMUM, MAXIMUM, ARRAY")
}

/// `f AT (x1 = 1 TO 2)`, `SUM(i = 1 TO 2, a TO b)`
pub fn stray_to(span: Span) -> Diagnostic {
    Diagnostic::error("misplaced-to", "`TO` stands only behind the index of a fold or of FOR")
        .at(span, "")
        .help("write SUM(i = 1 TO n, ...) or FOR i = 1 TO n DO ...; here one expression is expected")
}

/// `SUM(i = 1 TO 3)`
pub fn fold_form(callee: &Ident, span: Span) -> Diagnostic {
    Diagnostic::error("fold-form", format!("`{}` over an index needs the index and one expression", callee.name))
        .at(span, "the index runs here")
        .help(format!("write {}(i = 1 TO n, expression)", callee.name))
}

/// `e AT ()`
pub fn empty_mapping(span: Span) -> Diagnostic {
    Diagnostic::error("empty-mapping", "AT maps no coordinate here")
        .at(span, "")
        .help("write AT (x1 + 1, x2) or AT (x4 = 0.5)")
}

/// `e AT (x1 = 2, 3)`
pub fn mixed_mapping(span: Span) -> Diagnostic {
    Diagnostic::error("mixed-mapping", "named and unnamed coordinates do not mix in AT")
        .at(span, "this one has no name")
        .help("name every one, AT (x1 = .., x2 = ..), or none")
}

/// `e AT (r = 2)`
pub fn mapped_name(name: &Ident) -> Diagnostic {
    Diagnostic::error("mapped-name", format!("AT maps coordinates; `{}` is none", name.name))
        .at(name.span, "")
        .help("write x1 = ..; to give a name a value use WHERE")
}

/// `e AT (x1 = 2, x1 = 3)`
pub fn mapped_twice(name: &Ident, first: Span) -> Diagnostic {
    Diagnostic::error("mapped-twice", format!("`{}` is mapped twice", name.name))
        .at(name.span, "again here")
        .see(first, "first here")
        .help("keep one of them")
}

/// `PI = 3`
pub fn defined_constant(name: &Ident, is: &str) -> Diagnostic {
    Diagnostic::error("reserved-name", format!("`{}` is {is} and cannot be defined", name.name))
        .at(name.span, "")
        .help("choose another name")
}

/// `f(a, a) = ...`
pub fn parameter_twice(name: &Ident, first: Span) -> Diagnostic {
    Diagnostic::error("parameter-twice", format!("there are two parameters `{}`", name.name))
        .at(name.span, "again here")
        .see(first, "first here")
        .help("rename one of them")
}

/// `f((solid) g) = ...`
pub fn unknown_kind(written: &str, span: Span) -> Diagnostic {
    Diagnostic::error("unknown-kind", format!("`({written})` is no kind of parameter"))
        .at(span, "")
        .help("the kinds are (gob/pob), (gob), (pob), (real), (array), (text) and (function)")
}

/// `a < b & c < d`
pub fn set_in_comparison(op: &str, at: Span, whole: Span) -> Diagnostic {
    let word = if matches!(op, "|" | "\\") { "OR" } else { "AND" };
    Diagnostic::error("set-in-comparison", format!("`{op}` binds tighter than the comparisons around it"))
        .at(at, "")
        .see(whole, "one chain of comparisons")
        .help(format!("write {word} to join the comparisons"))
        .help(format!("if `{op}` of two objects is meant, put it in parentheses"))
}

/// `a = b = 3`
pub fn equality_chain(whole: Span) -> Diagnostic {
    Diagnostic::warning("equality-chain", "this asks whether all three are equal; it defines nothing")
        .at(whole, "")
        .help("write `==` if that is meant; to define two names, write two statements")
}

/// `a = b = 3;` as a statement
pub fn equality_defined(name: &Ident, whole: Span) -> Diagnostic {
    let title = format!("`{}` becomes 1 or 0 here: whether the two sides are equal", name.name);
    Diagnostic::warning("equality-chain", title)
        .at(whole, "compared, not defined")
        .help("write `==` if that is meant; to define two names, write two statements")
}

/// `3 = a;`, `x1 = 3;`, `f(1) = 2;`: what stands before the `=` cannot be defined.
pub fn no_definition(text: &str, subject: &Expr) -> Diagnostic {
    let shown = &text[subject.span.range()];
    match &subject.kind {
        ExprKind::Coordinate(_) => defined_coordinate(shown, subject.span),
        ExprKind::Call { callee, arguments } => {
            let wrong =
                arguments.iter().find(|a| !matches!(a.kind, ExprKind::Name(_))).map_or(subject.span, |a| a.span);
            Diagnostic::error("parameter-form", format!("`{}` is no name of a parameter", &text[wrong.range()]))
                .at(wrong, "a name is expected here")
                .see(callee.span, "defined here")
                .help(format!("write {}(a, b) = expression; with names of your own", callee.name))
                .help("write `==` to ask whether two values are equal")
        }
        _ => Diagnostic::error("only-names", format!("`{shown}` cannot be defined"))
            .at(subject.span, "")
            .help("a definition begins with a name: name = expression;")
            .help("write `==` to ask whether two values are equal"),
    }
}

/// `x1 = 3;`
pub fn defined_coordinate(word: &str, span: Span) -> Diagnostic {
    Diagnostic::error("defined-coordinate", format!("`{word}` is a coordinate and cannot be defined"))
        .at(span, "")
        .help(format!("to fix it write `{word} : CONSTANT = 0.5;` or `... AT ({word} = 0.5)`"))
        .help(format!("its range is {word}min and {word}max"))
}
