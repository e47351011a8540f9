//! What each operation is called in POV-Ray's language of functions, and the small functions that it lacks. Decides nothing of the order
//! in which things are computed.
//!
//! That language knows `+ - * /`, comparisons, `&`, `|`, `select` and the elementary functions; it has no power operator. Its functions
//! evaluate each argument once.

use crate::number::{Binary, Ternary, Unary};

/// A function that is declared where it is needed: its name, and its declaration's parameters and value.
pub(super) struct Helper {
    pub(super) name: &'static str,
    pub(super) declaration: &'static str,
    /// Others that it calls, which must stand before it.
    pub(super) after: &'static [&'static str],
}

/// All of them, each after those that it calls.
pub(super) const HELPERS: &[Helper] = &[
    Helper { name: "Yont_Square", declaration: "(a) { a*a }", after: &[] },
    Helper { name: "Yont_Cbrt", declaration: "(a) { select(a, -pow(-a, 1/3), 0, pow(a, 1/3)) }", after: &[] },
    Helper { name: "Yont_Round", declaration: "(a) { select(a, ceil(a - 0.5), floor(a + 0.5)) }", after: &[] },
    Helper { name: "Yont_Mod", declaration: "(a, b) { a - b*floor(a/b) }", after: &[] },
    Helper { name: "Yont_Hypot", declaration: "(a, b) { sqrt(a*a + b*b) }", after: &[] },
    // The p-norm: the larger magnitude is factored out for p > 0, the smaller for p < 0.
    Helper {
        name: "Yont_Norm_Of",
        declaration: "(a, b, c) { select(a, 0, 0, a*pow(1 + pow(b, abs(c)), 1/c)) }",
        after: &[],
    },
    Helper {
        name: "Yont_Norm_Between",
        declaration: "(a, b, c) { select(b, 0, 0, select(c, Yont_Norm_Of(a, a/b, c), Yont_Norm_Of(b, a/b, c))) }",
        after: &["Yont_Norm_Of"],
    },
    Helper {
        name: "Yont_Norm",
        declaration: "(a, b, c) { Yont_Norm_Between(min(abs(a), abs(b)), max(abs(a), abs(b)), c) }",
        after: &["Yont_Norm_Between"],
    },
    // (s + r)/(1 + c), in the form in which nothing cancels: a and b are the operands, s their sum and r the root.
    Helper {
        name: "Yont_Joined",
        declaration: "(a, b, c, s, r) { select(s, 2*a*b/(s - r), (s + r)/(1 + c)) }",
        after: &[],
    },
    Helper {
        name: "Yont_Union",
        declaration: "(a, b) { Yont_Joined(a, b, 0, a + b, sqrt(a*a + b*b)) }",
        after: &["Yont_Joined"],
    },
    Helper { name: "Yont_Intersection", declaration: "(a, b) { -Yont_Union(-a, -b) }", after: &["Yont_Union"] },
    Helper {
        name: "Yont_Union_Alpha",
        declaration: "(a, b, c) { Yont_Joined(a, b, c, a + b, sqrt((a - c*b)*(a - c*b) + (1 - c)*(1 + c)*b*b)) }",
        after: &["Yont_Joined"],
    },
    Helper {
        name: "Yont_Intersection_Alpha",
        declaration: "(a, b, c) { -Yont_Union_Alpha(-a, -b, c) }",
        after: &["Yont_Union_Alpha"],
    },
    Helper {
        name: "Yont_Union_Smooth",
        declaration: "(a, b, c) { Yont_Union(a, b)*pow(a*a + b*b, c/2) }",
        after: &["Yont_Union"],
    },
    Helper {
        name: "Yont_Intersection_Smooth",
        declaration: "(a, b, c) { -Yont_Union_Smooth(-a, -b, c) }",
        after: &["Yont_Union_Smooth"],
    },
    // The linear light of a component of an sRGB colour.
    Helper {
        name: "Yont_Light",
        declaration: "(a) { select(a - 0.04045, max(0, a)/12.92, pow((min(1, a) + 0.055)/1.055, 2.4)) }",
        after: &[],
    },
];

/// How an operation is written.
pub(super) enum Form {
    /// `(before a)`
    Prefix(&'static str),
    /// `(a between b)`
    Infix(&'static str),
    /// A function of the language, or one of [`HELPERS`].
    Call(&'static str),
    /// A function with more text behind its arguments.
    CallWith(&'static str, String),
}

pub(super) fn unary(op: Unary) -> Form {
    match op {
        Unary::Neg => Form::Prefix("-"),
        Unary::Abs => Form::Call("abs"),
        Unary::Sqrt => Form::Call("sqrt"),
        Unary::Cbrt => Form::Call("Yont_Cbrt"),
        Unary::Exp => Form::Call("exp"),
        Unary::Log => Form::Call("ln"),
        Unary::Log10 => Form::Call("log"),
        Unary::Sin => Form::Call("sin"),
        Unary::Cos => Form::Call("cos"),
        Unary::Tan => Form::Call("tan"),
        Unary::Asin => Form::Call("asin"),
        Unary::Acos => Form::Call("acos"),
        Unary::Atan => Form::Call("atan"),
        Unary::Sinh => Form::Call("sinh"),
        Unary::Cosh => Form::Call("cosh"),
        Unary::Tanh => Form::Call("tanh"),
        Unary::Asinh => Form::Call("asinh"),
        Unary::Acosh => Form::Call("acosh"),
        Unary::Atanh => Form::Call("atanh"),
        Unary::Floor => Form::Call("floor"),
        Unary::Ceil => Form::Call("ceil"),
        Unary::Round => Form::Call("Yont_Round"),
        Unary::Sign => Form::CallWith("select", "-1, 0, 1".into()),
        Unary::Not => Form::CallWith("select", "0, 1, 0".into()),
        Unary::Powi(2) => Form::Call("Yont_Square"),
        Unary::Powi(n) => Form::CallWith("pow", n.to_string()),
    }
}

pub(super) fn binary(op: Binary) -> Form {
    match op {
        Binary::Add => Form::Infix(" + "),
        Binary::Sub => Form::Infix(" - "),
        Binary::Mul => Form::Infix("*"),
        Binary::Div => Form::Infix("/"),
        Binary::Less => Form::Infix(" < "),
        Binary::LessEqual => Form::Infix(" <= "),
        Binary::Equal => Form::Infix(" = "),
        Binary::NotEqual => Form::Infix(" != "),
        Binary::And => Form::Infix(" & "),
        Binary::Or => Form::Infix(" | "),
        Binary::Min => Form::Call("min"),
        Binary::Max => Form::Call("max"),
        Binary::Pow => Form::Call("pow"),
        Binary::Atan2 => Form::Call("atan2"),
        Binary::Hypot => Form::Call("Yont_Hypot"),
        Binary::Mod => Form::Call("Yont_Mod"),
    }
}

/// The function of a set operation or norm; with `plain`, the parameter is 0 and left out. `IF` is written by itself.
pub(super) fn ternary(op: Ternary, plain: bool) -> &'static str {
    match (op, plain) {
        (Ternary::Select, _) => "select",
        (Ternary::Union, true) => "Yont_Union",
        (Ternary::Union, false) => "Yont_Union_Alpha",
        (Ternary::Intersection, true) => "Yont_Intersection",
        (Ternary::Intersection, false) => "Yont_Intersection_Alpha",
        (Ternary::UnionSmooth, _) => "Yont_Union_Smooth",
        (Ternary::IntersectionSmooth, _) => "Yont_Intersection_Smooth",
        (Ternary::Norm, _) => "Yont_Norm",
    }
}

/// A number as the language reads it: digits first, no bare sign.
pub(super) fn number(value: f64) -> String {
    let plain = match value.abs() {
        0.0 => "0".into(),
        1e-5..1e16 => value.abs().to_string(),
        size => format!("{size:e}"),
    };
    if value < 0.0 { format!("(-{plain})") } else { plain }
}
