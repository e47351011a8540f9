//! The tree of a program, with the span of every part. Says what was written, not what it means.
//!
//! Chains of one precedence level (`a + b - c`, `f | g \ h`) are flat, so that a sum of a million terms is not a tree a
//! million levels deep; the depth of a tree is bounded by `Limits::nesting`.

use std::sync::Arc;

use crate::source::Span;

/// A name as written. Cheap to clone.
pub type Name = Arc<str>;

/// A name at its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Ident {
    /// As written; user names tell upper from lower case.
    pub name: Name,
    /// Where.
    pub span: Span,
}

/// An expression with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// The whole of it, brackets included.
    pub span: Span,
}

/// Operators that make flat chains, left to right.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ChainOp {
    /// `OR`
    Or,
    /// `AND`
    And,
    /// `|`
    Union,
    /// `\`
    Subtract,
    /// `&`
    Intersect,
    /// `@`
    Product,
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
}

impl ChainOp {
    /// The level of language.md section 4: operators of one level share a chain; a larger number binds tighter.
    #[must_use]
    pub fn level(self) -> u8 {
        match self {
            Self::Or => 2,
            Self::And => 3,
            Self::Union | Self::Subtract => 6,
            Self::Intersect | Self::Product => 7,
            Self::Add | Self::Sub => 8,
            Self::Mul | Self::Div => 9,
        }
    }
}

/// Comparisons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompareOp {
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
    /// `=`, `==`
    Equal,
    /// `<>`, `!=`, `/=`
    NotEqual,
}

/// Prefix operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PrefixOp {
    /// `-`
    Minus,
    /// `+`
    Plus,
    /// `~`, complement
    Complement,
    /// `NOT`
    Not,
}

/// The folds over an index: `SUM(i = 1 TO n, e)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FoldOp {
    /// `SUM`
    Sum,
    /// `PRODUCT`
    Product,
    /// `UNION`
    Union,
    /// `INTERSECTION`
    Intersection,
    /// `MINIMUM`
    Minimum,
    /// `MAXIMUM`
    Maximum,
    /// `ARRAY`
    Array,
}

/// The kinds of expression.
#[expect(missing_docs, reason = "the form above each variant names its parts")]
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// `1.5e-3`
    Number(f64),
    /// `"..."`, without the quotes
    Text(Arc<str>),
    /// `x4` is `Coordinate(4)`; from 1 to 16
    Coordinate(u8),
    /// A name that is not called; `PI` in any case is `Pi`
    Name(Name),
    /// `PI`
    Pi,
    /// `INFINITY`, in any case
    Infinity,
    /// `[a, b]`
    Array(Vec<Expr>),
    /// `(e)`: kept for the formatter
    Paren(Box<Expr>),
    /// `first op e op e ...` of one level, left to right; the span is the operator's
    Chain { first: Box<Expr>, rest: Vec<(ChainOp, Span, Expr)> },
    /// `a < b <= c`: all of them hold
    Compare { first: Box<Expr>, rest: Vec<(CompareOp, Span, Expr)> },
    /// `-e`, `~e`, `NOT e`
    Prefix { op: PrefixOp, operand: Box<Expr> },
    /// `base ** exponent`
    Power { base: Box<Expr>, exponent: Box<Expr> },
    /// `e[i]`, `e[i, j]`
    Index { base: Box<Expr>, indices: Vec<Expr> },
    /// `name(a, b)`: a built-in (in any case), a user's function, or AT if the name has no parameters
    Call { callee: Ident, arguments: Vec<Expr> },
    /// `SUM(i = a TO b, body)`; a fold over an array, `SUM(a)`, is a `Call`
    Fold { op: FoldOp, index: Ident, from: Box<Expr>, to: Box<Expr>, body: Box<Expr> },
    /// `body AT (...)`
    At { body: Box<Expr>, mapping: Mapping },
    /// `IF c THEN a ELSE b`
    If { condition: Box<Expr>, then: Box<Expr>, otherwise: Option<Box<Expr>> },
    /// `e WHERE q = .., s = ..`
    Where { body: Box<Expr>, bindings: Vec<(Ident, Expr)> },
    /// `name = e` inside an argument list of a built-in that takes settings
    Setting { name: Ident, value: Box<Expr> },
}

/// What stands after AT.
#[derive(Clone, Debug, PartialEq)]
pub enum Mapping {
    /// `AT (e1, ..., ek)`
    Positional(Vec<Expr>),
    /// `AT (x3 = u, x1 = v)`: coordinate, place of its name, expression
    Named(Vec<(u8, Span, Expr)>),
}

/// The kind that a parameter is declared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ParameterKind {
    /// `(gob/pob)`, `(gob)`, `(pob)`, `(real)`: any scalar expression
    Scalar,
    /// `(array)`
    Array,
    /// `(text)`
    Text,
    /// `(function)`
    Function,
}

/// A parameter of a definition.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: Ident,
    /// Its declared kind and, for the formatter, the words of it.
    pub kind: Option<(ParameterKind, Arc<str>)>,
}

/// What a definition's name stands for.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// `= e`
    Expression(Expr),
    /// `= BEGIN ... END`
    Block(Vec<Statement>),
}

/// `IN [lo, hi] STEP s` of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// Smallest value.
    pub lo: Expr,
    /// Largest value.
    pub hi: Expr,
    /// Step of the slider.
    pub step: Option<Expr>,
}

/// The geometric types.
#[derive(Clone, Debug, PartialEq)]
pub enum GeometricType {
    /// `X`
    X,
    /// `Y`
    Y,
    /// `Z`
    Z,
    /// `T`
    T,
    /// `V`
    V,
    /// `W`
    W,
    /// `C`
    C,
    /// `CONSTANT = e`
    Constant(Option<Expr>),
    /// `G = [..]`
    Group(Option<Expr>),
    /// `CENTER = [..]`
    Center(Option<Expr>),
    /// `COLOR = [r, g, b]`, `COLOR = e IN [lo, hi]`; also spelt COLOUR
    Color(Option<Expr>, Option<Box<[Expr; 2]>>),
}

impl GeometricType {
    /// The expressions behind it, in the order of the text.
    pub fn expressions(&self) -> impl Iterator<Item = &Expr> {
        let (value, range) = match self {
            Self::Constant(value) | Self::Group(value) | Self::Center(value) => (value.as_ref(), None),
            Self::Color(value, range) => (value.as_ref(), range.as_deref()),
            _ => (None, None),
        };
        value.into_iter().chain(range.into_iter().flatten())
    }
}

/// A statement with its place and documentation.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// What it is.
    pub kind: StatementKind,
    /// From its first word to its `;`.
    pub span: Span,
    /// The comment right above, without its braces; empty if none.
    pub doc: Arc<str>,
}

/// The kinds of statement.
#[expect(missing_docs, reason = "the form above each variant names its parts")]
#[derive(Clone, Debug, PartialEq)]
pub enum StatementKind {
    /// `name = e`, `name(p, q) = e`, `r1 = 4 IN [1, 8] STEP 0.5`
    Define { name: Ident, parameters: Option<Vec<Parameter>>, body: Body, range: Option<Range> },
    /// `a[i] = e`
    Element { name: Ident, indices: Vec<Expr>, value: Expr },
    /// `IF c THEN s ELSE s`; a block is its statements
    If { condition: Expr, then: Vec<Statement>, otherwise: Option<Vec<Statement>> },
    /// `WHILE (c) DO s`
    While { condition: Expr, body: Vec<Statement> },
    /// `FOR i = a TO b STEP k DO s`
    For { index: Ident, from: Expr, to: Expr, step: Option<Expr>, body: Vec<Statement> },
    /// `x4 : T`, `gob_a : G = [..]`; the subject of a coordinate is written `x4`
    Type { subject: Ident, kind: GeometricType },
    /// `INCLUDE "file.geo"`
    Include { path: Arc<str>, path_span: Span },
    /// `PRINT e, "text"`
    Print { items: Vec<Expr> },
    /// A bare expression: at the prompt, or the last of a script
    Expression(Expr),
    /// Did not parse; still counts as defining and reading these names, as far as its words tell. The condition is a WHILE's.
    Failed { defines: Vec<Name>, reads: Vec<Ident>, condition: Option<Span> },
}

impl StatementKind {
    /// What failed without a name.
    #[must_use]
    pub fn failed() -> Self {
        Self::Failed { defines: Vec::new(), reads: Vec::new(), condition: None }
    }
}
