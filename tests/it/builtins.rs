//! The table of built-ins: every entry's example runs.

use std::collections::HashSet;

use yont::builtins::{self, Meaning};
use yont::number::{Dual, Interval, Intervals, Reals};

/// The arguments of a call `NAME(a, b)` of numbers, PI, and products and quotients of the two.
fn arguments(source: &str) -> Vec<f64> {
    let inner = source.split_once('(').and_then(|(_, rest)| rest.strip_suffix(')'));
    let inner = inner.unwrap_or_else(|| panic!("{source} is no call"));
    inner.split(',').map(|text| quotient(text.trim())).collect()
}

fn quotient(text: &str) -> f64 {
    let number = |text: &str| match text {
        "PI" => std::f64::consts::PI,
        text => text.parse().unwrap_or_else(|_| panic!("{text} is no number")),
    };
    text.split('/').map(number).reduce(|a, b| a / b).expect("split gives at least one part")
}

#[test]
fn examples_of_functions_of_numbers_have_their_values() {
    for entry in builtins::all().filter(|e| !matches!(e.meaning, Meaning::Special(_))) {
        let (source, expected) = entry.example;
        assert!(source.starts_with(&format!("{}(", entry.name)), "{source} does not call {}", entry.name);
        let given = arguments(source);
        let value =
            entry.apply(&mut Reals, &given).expect("the example has the right count").expect("it is a function");
        assert!((value - expected).abs() <= 4e-16 * expected.abs(), "{source} gives {value:?}, not {expected:?}");
        let boxes: Vec<_> = given.iter().map(|&a| Interval::point(a)).collect();
        let range = entry.apply(&mut Intervals, &boxes).expect("the count is right").expect("it is a function");
        assert!(range.contains(value) && range.hi - range.lo < 1e-14 * value.abs().max(1.0), "{source}: {range:?}");
    }
}

#[test]
fn names_are_unique_and_found_in_any_case() {
    let mut seen = HashSet::new();
    for name in builtins::all().flat_map(builtins::Builtin::names) {
        assert!(seen.insert(name), "{name} stands twice");
        assert_eq!(name, name.to_ascii_uppercase());
        let found = builtins::find(&name.to_ascii_lowercase()).expect("every name is found");
        assert!(found.names().any(|n| n == name));
    }
    assert!(builtins::find("SINE").is_none());
}

#[test]
fn entries_are_documented() {
    for entry in builtins::all() {
        assert!(entry.doc.ends_with('.') && entry.doc.len() > 8, "{} has no doc", entry.name);
        assert!(entry.example.0.contains(entry.name), "{} does not occur in its example", entry.name);
        assert!(!entry.parameters.is_empty() && entry.signature().starts_with(entry.name));
        if let Meaning::Formula(term) = entry.meaning {
            assert_eq!(entry.parameters.len(), term.arguments(), "{}", entry.signature());
        }
    }
}

#[test]
fn a_wrong_count_is_refused_and_told() {
    for (name, given, words) in
        [("SIN", 2, "1 argument"), ("CLAMP", 2, "3 arguments"), ("MAX", 1, "2 or more arguments, or one array")]
    {
        let entry = builtins::find(name).expect("it is in the table");
        let error = entry.apply(&mut Reals, &vec![1.0; given]).expect_err("the count is wrong");
        assert_eq!((error.given, error.takes.to_string().as_str()), (given, words));
    }
}

#[test]
fn formulas_keep_undefined_arguments_undefined() {
    for entry in builtins::all() {
        let Meaning::Formula(term) = entry.meaning else { continue };
        // A comparison with an undefined operand is false: HEAVISIDE is one.
        if entry.name == "HEAVISIDE" {
            continue;
        }
        for place in 0..term.arguments() {
            let mut given = vec![0.5; term.arguments()];
            given[place] = f64::NAN;
            let value = entry.apply(&mut Reals, &given).expect("the count is right").expect("it is a function");
            assert!(value.is_nan(), "{} with undefined argument {place} gives {value}", entry.name);
        }
    }
}

#[test]
fn formulas_have_derivatives() {
    for (name, at, slope) in [
        ("SEC", vec![0.5], 0.5f64.sin() / 0.5f64.cos().powi(2)),
        ("LERP", vec![1.0, 3.0, 0.5], 0.5),
        ("SMOOTHSTEP", vec![0.5, 2.0, 1.0], -16.0 / 27.0),
    ] {
        let entry = builtins::find(name).expect("it is in the table");
        let given: Vec<Dual<1>> = at
            .iter()
            .enumerate()
            .map(|(i, &a)| if i == 0 { Dual::variable(a, 0) } else { Dual::constant(a) })
            .collect();
        let value =
            entry.apply(&mut yont::number::Duals::<1>, &given).expect("the count is right").expect("it is a function");
        assert!((value.slope[0] - slope).abs() < 1e-9, "{name}: {:?}", value.slope);
    }
}
