//! The tree as a compact s-expression, for tests: places and parentheses left out unless they change the meaning.

use yont::syntax::tree::{
    Body, ChainOp, CompareOp, Expr, ExprKind, FoldOp, GeometricType, Mapping, Parameter, PrefixOp, Range, Statement,
    StatementKind,
};

/// All statements, one a line.
pub fn statements(statements: &[Statement]) -> String {
    let lines: Vec<_> = statements.iter().map(statement).collect();
    lines.join("\n")
}

fn list<T>(items: &[T], one: impl Fn(&T) -> String) -> String {
    items.iter().map(|i| format!(" {}", one(i))).collect()
}

fn optional(e: &Option<Expr>) -> String {
    e.as_ref().map_or(String::new(), |e| format!(" {}", expr(e)))
}

fn block(statements: &[Statement]) -> String {
    format!("{{{}}}", list(statements, statement).trim_start())
}

fn range(range: &Option<Range>) -> String {
    range.as_ref().map_or(String::new(), |r| format!(" (in {} {}{})", expr(&r.lo), expr(&r.hi), optional(&r.step)))
}

fn parameter(p: &Parameter) -> String {
    p.kind.as_ref().map_or(p.name.name.to_string(), |(kind, _)| format!("{}:{kind:?}", p.name.name))
}

/// Takes the documentation away, also that of inner statements.
pub fn strip_docs(statements: &mut [Statement]) {
    for s in statements {
        s.doc = "".into();
        match &mut s.kind {
            StatementKind::Define { body: Body::Block(b), .. } => strip_docs(b),
            StatementKind::While { body, .. } | StatementKind::For { body, .. } => strip_docs(body),
            StatementKind::If { then, otherwise, .. } => {
                strip_docs(then);
                strip_docs(otherwise.as_deref_mut().unwrap_or_default());
            }
            _ => {}
        }
    }
}

fn statement(s: &Statement) -> String {
    let doc = if s.doc.is_empty() { String::new() } else { format!("{:?} ", &*s.doc) };
    let text = match &s.kind {
        StatementKind::Define { name, parameters, body, range: r } => {
            let parameters = parameters.as_ref().map_or(String::new(), |p| format!(" ({})", list(p, parameter).trim()));
            let body = match body {
                Body::Expression(e) => expr(e),
                Body::Block(b) => block(b),
            };
            format!("(def {}{parameters} {body}{})", name.name, range(r))
        }
        StatementKind::Element { name, indices, value } => {
            format!("(elem {} [{}] {})", name.name, list(indices, expr).trim(), expr(value))
        }
        StatementKind::If { condition, then, otherwise } => {
            let otherwise = otherwise.as_ref().map_or(String::new(), |o| format!(" {}", block(o)));
            format!("(if {} {}{otherwise})", expr(condition), block(then))
        }
        StatementKind::While { condition, body } => format!("(while {} {})", expr(condition), block(body)),
        StatementKind::For { index, from, to, step, body } => {
            format!("(for {} {} {}{} {})", index.name, expr(from), expr(to), optional(step), block(body))
        }
        StatementKind::Type { subject, kind } => format!("(type {} {})", subject.name, geometric(kind)),
        StatementKind::Include { path, .. } => format!("(include {path:?})"),
        StatementKind::Print { items } => format!("(print{})", list(items, expr)),
        StatementKind::Expression(e) => expr(e),
        StatementKind::Failed { defines, .. } => format!("(failed{})", list(defines, ToString::to_string)),
    };
    format!("{doc}{text}")
}

fn geometric(kind: &GeometricType) -> String {
    match kind {
        GeometricType::Constant(e) => format!("CONSTANT{}", optional(e)),
        GeometricType::Group(e) => format!("G{}", optional(e)),
        GeometricType::Center(e) => format!("CENTER{}", optional(e)),
        GeometricType::Color(e, range) => {
            let range = range.iter().flat_map(|r| r.iter()).map(|e| format!(" in {}", expr(e))).collect::<String>();
            format!("COLOR{}{range}", optional(e))
        }
        axis => format!("{axis:?}"),
    }
}

fn chain_op(op: ChainOp) -> &'static str {
    match op {
        ChainOp::Or => "or",
        ChainOp::And => "and",
        ChainOp::Union => "|",
        ChainOp::Subtract => "\\",
        ChainOp::Intersect => "&",
        ChainOp::Product => "@",
        ChainOp::Add => "+",
        ChainOp::Sub => "-",
        ChainOp::Mul => "*",
        ChainOp::Div => "/",
    }
}

fn compare_op(op: CompareOp) -> &'static str {
    match op {
        CompareOp::Less => "<",
        CompareOp::LessEqual => "<=",
        CompareOp::Greater => ">",
        CompareOp::GreaterEqual => ">=",
        CompareOp::Equal => "=",
        CompareOp::NotEqual => "<>",
    }
}

fn mapping(m: &Mapping) -> String {
    match m {
        Mapping::Positional(parts) => list(parts, expr),
        Mapping::Named(parts) => list(parts, |(c, _, e)| format!("x{c}={}", expr(e))),
    }
}

fn fold(op: FoldOp) -> String {
    format!("{op:?}").to_lowercase()
}

pub fn expr(e: &Expr) -> String {
    match &e.kind {
        ExprKind::Number(n) => format!("{n:?}").trim_end_matches(".0").to_owned(),
        ExprKind::Text(t) => format!("{t:?}"),
        ExprKind::Coordinate(n) => format!("x{n}"),
        ExprKind::Name(n) => n.to_string(),
        ExprKind::Pi => "pi".to_owned(),
        ExprKind::Infinity => "infinity".to_owned(),
        ExprKind::Array(items) => format!("[{}]", list(items, expr).trim()),
        ExprKind::Paren(inner) => format!("(paren {})", expr(inner)),
        ExprKind::Chain { first, rest } => {
            let rest = list(rest, |(op, _, e)| format!("{} {}", chain_op(*op), expr(e)));
            format!("({}{rest})", expr(first))
        }
        ExprKind::Compare { first, rest } => {
            let rest = list(rest, |(op, _, e)| format!("{} {}", compare_op(*op), expr(e)));
            format!("(cmp {}{rest})", expr(first))
        }
        ExprKind::Prefix { op, operand } => {
            let op = match op {
                PrefixOp::Minus => "neg",
                PrefixOp::Plus => "pos",
                PrefixOp::Complement => "~",
                PrefixOp::Not => "not",
            };
            format!("({op} {})", expr(operand))
        }
        ExprKind::Power { base, exponent } => format!("(** {} {})", expr(base), expr(exponent)),
        ExprKind::Index { base, indices } => format!("(index {}{})", expr(base), list(indices, expr)),
        ExprKind::Call { callee, arguments } => format!("(call {}{})", callee.name, list(arguments, expr)),
        ExprKind::Fold { op, index, from, to, body } => {
            format!("({} {} {} {} {})", fold(*op), index.name, expr(from), expr(to), expr(body))
        }
        ExprKind::At { body, mapping: m } => format!("(at {}{})", expr(body), mapping(m)),
        ExprKind::If { condition, then, otherwise } => {
            let otherwise = otherwise.as_ref().map_or(String::new(), |o| format!(" {}", expr(o)));
            format!("(? {} {}{otherwise})", expr(condition), expr(then))
        }
        ExprKind::Where { body, bindings } => {
            format!("(where {}{})", expr(body), list(bindings, |(n, e)| format!("{}={}", n.name, expr(e))))
        }
        ExprKind::Setting { name, value } => format!("(set {} {})", name.name, expr(value)),
    }
}
