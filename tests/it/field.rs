//! Expression graphs: what building folds, the derivative as an expression, maps replaced.

use std::sync::Arc;

use crate::conformance::Product;
use yont::field::expand::expand;
use yont::field::{Coordinate, Graph, Node, NodeId, SharedLeaf, derivative, operations};
use yont::number::{Algebra, Binary, Dual, Duals, Real, Reals, Ternary, Unary};
use yont::vm::reference;

const X: Coordinate = Coordinate(1);
const Y: Coordinate = Coordinate(2);

fn at(graph: &Graph, node: NodeId, x: f64, y: f64) -> f64 {
    reference::eval(&mut Reals, graph, node, &[(X, x), (Y, y)])
}

#[test]
fn building_folds_numbers_and_what_changes_no_bit() {
    let mut g = Graph::new();
    let (x, y) = (g.coordinate(X), g.coordinate(Y));
    let [zero, below, one, two, alpha] = [0.0, -0.0, 1.0, 2.0, 0.5].map(|v| g.constant(v));
    let minus_x = g.unary(Unary::Neg, x);
    let not_x = g.unary(Unary::Not, x);
    let sum = g.binary(Binary::Add, x, y);
    let difference = g.binary(Binary::Sub, y, x);
    let half = g.binary(Binary::Mul, x, alpha);
    let (larger, smaller) = (g.binary(Binary::Max, x, y), g.binary(Binary::Min, x, y));
    let three = g.constant(3.0);
    let cases = [
        (g.binary(Binary::Add, one, two), three, "1 + 2"),
        (g.unary(Unary::Neg, minus_x), x, "-(-x)"),
        (g.binary(Binary::Add, y, x), sum, "y + x is x + y"),
        (g.binary(Binary::Add, x, below), x, "x + -0"),
        (g.binary(Binary::Sub, x, zero), x, "x - 0"),
        (g.binary(Binary::Add, minus_x, y), difference, "-x + y"),
        (g.binary(Binary::Mul, x, one), x, "x * 1"),
        (g.binary(Binary::Div, x, two), half, "x / 2"),
        (g.binary(Binary::Pow, x, one), x, "x ** 1"),
        (g.unary(Unary::Powi(1), x), x, "x ** 1, whole"),
        (g.binary(Binary::Max, x, x), x, "MAX(x, x)"),
        (g.ternary(Ternary::Select, one, x, y), x, "IF 1"),
        (g.ternary(Ternary::Select, zero, x, y), y, "IF 0"),
        (g.ternary(Ternary::Select, x, y, y), y, "IF x THEN y ELSE y"),
        (g.ternary(Ternary::Union, x, y, one), larger, "r_alpha = 1"),
        (g.ternary(Ternary::Intersection, x, y, one), smaller, "r_alpha = 1"),
        (g.binary(Binary::And, not_x, one), not_x, "truth AND 1"),
        (g.binary(Binary::Or, x, one), one, "x OR 1"),
        (g.map(x, &[(X, y)]), y, "x AT (x = y)"),
        (g.map(sum, &[(X, x), (Coordinate(3), one)]), sum, "a map that changes nothing"),
    ];
    for (made, expected, what) in cases {
        assert_eq!(made, expected, "{what}");
    }
    assert_eq!(operations(&g, sum), 1);
    // These look alike and are not: -0 + 0 is 0, and x may be undefined.
    for (a, b) in [(x, zero), (zero, x)] {
        assert_ne!(g.binary(Binary::Add, a, b), x);
        assert_ne!(g.binary(Binary::Mul, a, b), zero);
    }
    assert_ne!(g.binary(Binary::Sub, x, x), zero);
    assert_ne!(g.binary(Binary::Equal, x, x), one);
}

/// Each operation of x and y, by itself and with another inside, so that the chain rule runs.
fn samples(g: &mut Graph) -> Vec<(String, NodeId)> {
    let (x, y) = (g.coordinate(X), g.coordinate(Y));
    let inner = g.binary(Binary::Mul, x, y);
    let mut all = Vec::new();
    let powers = [2, 3, -2, 0, 7].map(Unary::Powi);
    for &op in Unary::ALL.iter().chain(&powers) {
        let node = g.unary(op, inner);
        all.push((format!("{op:?}"), node));
    }
    use Binary::*;
    for op in [Add, Sub, Mul, Div, Min, Max, Pow, Atan2, Hypot, Mod, Less] {
        let node = g.binary(op, inner, y);
        all.push((format!("{op:?}"), node));
        let node = g.binary(op, y, inner);
        all.push((format!("{op:?} reversed"), node));
    }
    for op in [
        Ternary::Select,
        Ternary::Union,
        Ternary::Intersection,
        Ternary::UnionSmooth,
        Ternary::IntersectionSmooth,
        Ternary::Norm,
    ] {
        let shifted = g.binary(Binary::Sub, inner, x);
        for parameter in [0.0, 0.5, 1.0] {
            let parameter = g.constant(parameter);
            let node = g.ternary(op, inner, shifted, parameter);
            all.push((format!("{op:?}"), node));
        }
        if matches!(op, Ternary::Union | Ternary::Intersection | Ternary::Norm) {
            let half = g.constant(0.5);
            let varying = g.unary(Unary::Sin, x);
            let varying = g.binary(Binary::Mul, varying, half);
            let node = g.ternary(op, inner, shifted, varying);
            all.push((format!("{op:?} with a varying parameter"), node));
        }
    }
    let data = g.leaf(SharedLeaf(Arc::new(Product)), &[inner, y]);
    all.push(("data".into(), g.unary(Unary::Sin, data)));
    let map = g.map(inner, &[(X, y), (Y, inner)]);
    let outer = g.unary(Unary::Sin, map);
    all.push(("a map".into(), g.map(outer, &[(X, inner)])));
    all
}

#[test]
fn the_derivative_as_an_expression_is_the_one_of_duals() {
    let mut g = Graph::new();
    for (name, node) in samples(&mut g) {
        let slopes = [derivative(&mut g, node, X), derivative(&mut g, node, Y)];
        for (x, y) in [(0.3, 0.7), (-0.4, 1.3), (1.5, 0.9), (-1.25, -1.1), (2.0, 3.0)] {
            let variables = [(X, Dual::<2>::variable(x, 0)), (Y, Dual::<2>::variable(y, 1))];
            let expected = reference::eval(&mut Duals::<2>, &g, node, &variables);
            if expected.value.is_nan() {
                continue;
            }
            for (slope, expected) in slopes.iter().zip(expected.slope) {
                let value = at(&g, *slope, x, y);
                let close = (value - expected).abs() <= 1e-12 * (1.0 + expected.abs());
                assert!(close || (value.is_nan() && expected.is_nan()), "{name} at ({x}, {y}): {value}, {expected}");
            }
        }
    }
}

#[test]
fn a_long_chain_has_a_derivative() {
    let mut g = Graph::new();
    let x = g.coordinate(X);
    let sum = (0..100_000).fold(x, |sum, i| {
        let number = g.constant(f64::from(i % 3));
        let term = g.binary(Binary::Mul, x, number);
        g.binary(Binary::Add, sum, term)
    });
    let slope = derivative(&mut g, sum, X);
    // 1 and 33,333 times 1 + 2; the last term counts 0.
    assert_eq!(at(&g, slope, 0.5, 0.0), 1.0 + 33_333.0 * 3.0);
}

/// Nested maps `f AT (x = x + f)`: the number of nodes stays small where parts are shared.
fn nested(g: &mut Graph, depth: usize) -> NodeId {
    let (x, y) = (g.coordinate(X), g.coordinate(Y));
    let start = g.binary(Binary::Add, x, y);
    (0..depth).fold(start, |body, i| {
        let number = g.constant(i as f64);
        let moved = g.binary(Binary::Sub, x, number);
        g.map(body, &[(X, moved)])
    })
}

#[test]
fn maps_are_replaced_within_a_budget_however_deep_they_nest() {
    let mut g = Graph::new();
    let root = nested(&mut g, 50_000);
    let (expanded, top) = expand(&g, &[root], 1_000_000).expect("within the budget").expect("there are maps");
    let top = top[0];
    assert_eq!(operations(&expanded, top), 50_000);
    let has_map = (0..expanded.len()).any(|i| matches!(expanded.node(NodeId(i as u32)), Node::Map(..)));
    assert!(!has_map);
    assert_eq!(at(&expanded, top, 0.25, 0.5).to_bits(), at(&g, root, 0.25, 0.5).to_bits());
    assert_eq!(expand(&g, &[root], 10_000).err(), Some(yont::field::expand::TooLarge { limit: 10_000 }));
    // Two copies in each: 2^40 nodes, if they were not refused.
    let mut body = g.coordinate(X);
    for i in 0..40 {
        let number = g.constant(f64::from(i));
        let sum = g.binary(Binary::Add, body, number);
        let x = g.coordinate(X);
        let other = g.unary(Unary::Sin, x);
        let mapped = g.map(sum, &[(X, other)]);
        body = g.binary(Binary::Mul, sum, mapped);
    }
    assert!(expand(&g, &[body], 100_000).is_ok(), "equal copies are one");
}

#[test]
fn a_map_replaces_all_coordinates_at_once() {
    let mut g = Graph::new();
    let (x, y) = (g.coordinate(X), g.coordinate(Y));
    let difference = g.binary(Binary::Sub, x, y);
    let swapped = g.map(difference, &[(X, y), (Y, x)]);
    assert_eq!(at(&g, swapped, 5.0, 2.0), -3.0);
    let (plain, top) = expand(&g, &[swapped], 100).expect("small").expect("a map");
    let top = top[0];
    assert_eq!(at(&plain, top, 5.0, 2.0), -3.0);
    let number = g.intern(Node::Constant(Real::new(4.0)));
    let section = g.map(difference, &[(Y, number)]);
    assert!(!g.coordinates(section).contains(Y) && g.coordinates(section).contains(X));
}
