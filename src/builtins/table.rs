//! What an entry of the table is, and how its meaning is applied to any kind of number. Never knows an entry by name.

use std::fmt;

use super::questions::Question;
use crate::number::{Algebra, Binary, Ternary, Unary};

/// A built-in function.
#[derive(Debug)]
pub struct Builtin {
    /// Its name, in capitals.
    pub name: &'static str,
    /// Other names for it, in capitals.
    pub aliases: &'static [&'static str],
    /// What it is about.
    pub subject: Subject,
    /// The names of its parameters, for the signature.
    pub parameters: &'static [&'static str],
    /// What it computes, in a sentence or two.
    pub doc: &'static str,
    /// An expression and its value.
    pub example: (&'static str, f64),
    /// What it means.
    pub meaning: Meaning,
}

/// The chapters of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// Functions of angles and their inverses.
    Trigonometry,
    /// Hyperbolic functions and their inverses.
    Hyperbolic,
    /// Exponentials, logarithms, powers and roots.
    Powers,
    /// Steps, choices, remainders and interpolation.
    Choices,
    /// Folds, arrays and vectors.
    Arrays,
    /// Derivatives, projections and offsets of functions.
    Functions,
    /// Functions given by data.
    Data,
    /// Questions about objects.
    Questions,
}

impl fmt::Display for Subject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Trigonometry => "angles",
            Self::Hyperbolic => "hyperbolic functions",
            Self::Powers => "powers and logarithms",
            Self::Choices => "steps and choices",
            Self::Arrays => "arrays and vectors",
            Self::Functions => "functions of functions",
            Self::Data => "data",
            Self::Questions => "questions about objects",
        })
    }
}

/// What a built-in means.
#[derive(Clone, Copy, Debug)]
pub enum Meaning {
    /// A primitive of one operand.
    Unary(Unary),
    /// A primitive of two operands.
    Binary(Binary),
    /// A primitive of two operands, folded from left to right over two or more, or over the elements of one array.
    Fold(Binary),
    /// A formula of the arguments.
    Formula(&'static Term),
    /// What the interpreter does itself, since an argument is more than a number.
    Special(Special),
}

/// The forms whose arguments are names, arrays, texts or whole expressions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Special {
    /// `SUM(i = a TO b, e)`, `SUM(a)`
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
    /// `ARRAY(i = a TO b, e)`
    Array,
    /// `JOIN(a, b)`
    Join,
    /// `LEN(a)`
    Len,
    /// `DOT(a, b)`
    Dot,
    /// `CROSS(a, b)`
    Cross,
    /// `NORM(a)`
    Norm,
    /// `PNORM(a, b, p)`, `PNORM(a, p)`
    PNorm,
    /// `STAR(P, p_local, p_global)`
    Star,
    /// `RANDOM(seed, i)`
    Random,
    /// `DIFF(e, x1)`
    Diff,
    /// `GRAD(e)`
    Grad,
    /// `PROJECT(e, x4, lo, hi)`
    Project,
    /// `OFFSET_BALL(e, d)`
    OffsetBall,
    /// `INTERPOLATE(kind, file, e1, ...)`
    Interpolate,
    /// `POLYGON(px, py)`
    Polygon,
    /// `CONTOURS([[px, py], ...])`
    Contours,
    /// `MEDIAL(P, R, edges)`
    Medial,
    /// `INTERSECTS(g1, g2)` and others
    Question(Question),
    /// `MESH(file)`, `MESH(file, e1, e2, e3)`
    Mesh,
    /// `SCATTER(points, values, smoothness, nx, ny, e1, e2)`
    Scatter,
    /// `HEIGHT(file, e1, e2)`
    Height,
    /// `FIT(residual, start, points)`
    Fit,
}

/// A formula over the primitives; `Argument(0)` is the first argument.
#[derive(Clone, Copy, Debug)]
pub enum Term {
    /// An argument by its place, from 0.
    Argument(usize),
    /// A number.
    Number(f64),
    /// A primitive of one term.
    One(Unary, &'static Term),
    /// A primitive of two terms.
    Two(Binary, &'static Term, &'static Term),
    /// A primitive of three terms.
    Three(Ternary, &'static Term, &'static Term, &'static Term),
}

impl Term {
    /// The term's value for these arguments.
    fn value<A: Algebra>(&self, algebra: &mut A, arguments: &[A::Number]) -> A::Number {
        match *self {
            Self::Argument(i) => arguments[i].clone(),
            Self::Number(value) => algebra.constant(value),
            Self::One(op, a) => {
                let a = a.value(algebra, arguments);
                algebra.unary(op, a)
            }
            Self::Two(op, a, b) => {
                let a = a.value(algebra, arguments);
                let b = b.value(algebra, arguments);
                algebra.binary(op, a, b)
            }
            Self::Three(op, a, b, c) => {
                let a = a.value(algebra, arguments);
                let b = b.value(algebra, arguments);
                let c = c.value(algebra, arguments);
                algebra.ternary(op, a, b, c)
            }
        }
    }

    /// The largest place of an argument in the term, plus 1.
    #[must_use]
    pub fn arguments(&self) -> usize {
        match *self {
            Self::Argument(i) => i + 1,
            Self::Number(_) => 0,
            Self::One(_, a) => a.arguments(),
            Self::Two(_, a, b) => a.arguments().max(b.arguments()),
            Self::Three(_, a, b, c) => a.arguments().max(b.arguments()).max(c.arguments()),
        }
    }
}

/// How many arguments a built-in takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arity {
    /// That many.
    Exactly(usize),
    /// That many or more; a single one must be an array.
    AtLeast(usize),
    /// From the first number to the second.
    Between(usize, usize),
}

impl Arity {
    /// Whether `count` arguments are right.
    #[must_use]
    pub fn admits(self, count: usize) -> bool {
        match self {
            Self::Exactly(n) => count == n,
            Self::AtLeast(n) => count >= n,
            Self::Between(lo, hi) => (lo..=hi).contains(&count),
        }
    }
}

impl fmt::Display for Arity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exactly(1) => f.write_str("1 argument"),
            Self::Exactly(n) => write!(f, "{n} arguments"),
            Self::AtLeast(n) => write!(f, "{n} or more arguments, or one array"),
            Self::Between(lo, hi) => write!(f, "{lo} to {hi} arguments"),
        }
    }
}

/// A built-in was given the wrong number of arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrongCount {
    /// What it takes.
    pub takes: Arity,
    /// What it was given.
    pub given: usize,
}

impl Builtin {
    /// Its name and its aliases.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        std::iter::once(self.name).chain(self.aliases.iter().copied())
    }

    /// How many arguments it takes. The folds over an index (`SUM(i = 1 TO n, e)`) count here as called with an array.
    #[must_use]
    pub fn arity(&self) -> Arity {
        use Special as S;
        match self.meaning {
            Meaning::Unary(_) => Arity::Exactly(1),
            Meaning::Binary(_) => Arity::Exactly(2),
            Meaning::Fold(_) => Arity::AtLeast(2),
            Meaning::Formula(term) => Arity::Exactly(term.arguments()),
            Meaning::Special(form) => match form {
                S::Sum | S::Product | S::Union | S::Intersection | S::Minimum | S::Maximum | S::Array => {
                    Arity::Exactly(1)
                }
                S::Len | S::Norm | S::Grad | S::Contours => Arity::Exactly(1),
                S::Join | S::PNorm => Arity::AtLeast(2),
                S::Dot | S::Cross | S::Random | S::Diff | S::OffsetBall | S::Polygon => Arity::Exactly(2),
                S::Star | S::Medial => Arity::Exactly(3),
                S::Project => Arity::Exactly(4),
                S::Interpolate => Arity::Between(3, 5),
                S::Question(question) => question.arity(),
                S::Mesh => Arity::Between(1, 4),
                S::Scatter => Arity::Exactly(7),
                S::Height | S::Fit => Arity::Exactly(3),
            },
        }
    }

    /// The call as the manual shows it: `CLAMP(a, lo, hi)`.
    #[must_use]
    pub fn signature(&self) -> String {
        format!("{}({})", self.name, self.parameters.join(", "))
    }

    /// Its value for numbers of any kind. `None` for the special forms, which only the interpreter can evaluate.
    ///
    /// # Errors
    /// If the number of arguments is wrong.
    pub fn apply<A: Algebra>(&self, algebra: &mut A, arguments: &[A::Number]) -> Result<Option<A::Number>, WrongCount> {
        let takes = self.arity();
        if !takes.admits(arguments.len()) {
            return Err(WrongCount { takes, given: arguments.len() });
        }
        Ok(match (self.meaning, arguments) {
            (Meaning::Unary(op), [a]) => Some(algebra.unary(op, a.clone())),
            (Meaning::Binary(op), [a, b]) => Some(algebra.binary(op, a.clone(), b.clone())),
            (Meaning::Fold(op), [first, rest @ ..]) => {
                Some(rest.iter().fold(first.clone(), |all, next| algebra.binary(op, all, next.clone())))
            }
            (Meaning::Formula(term), _) => Some(term.value(algebra, arguments)),
            _ => None,
        })
    }
}
