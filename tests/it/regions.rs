//! Loops that run at each point, and the searches of PROJECT and OFFSET_BALL: against the tree oracle, the walk over the graph, closed
//! forms and dense search.

use yont::field::{Coordinate, Graph, Node, NodeId, derivative, operations};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::oracle::{Oracle, Value as Plain};
use yont::model::value::Scalar;
use yont::model::{Event, Session, Value};
use yont::number::extremum::section::{self, Section};
use yont::number::{Dual, Duals, Interval, Intervals, Reals};
use yont::source::SourceMap;
use yont::surface::{Grid, extract};
use yont::syntax::{Mode, parse};
use yont::vm::reference;
use yont::vm::{Boxes, Demand, Gradients, Points, Program, Shape};

use crate::conformance::{Random, Singles, same};
use crate::mesh::compare_signs;
use crate::session::{messages, session};

const INPUTS: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];

/// A session that has accepted a script, and the node of `v` in it.
fn given(script: &str) -> (Session, NodeId) {
    let mut session = session();
    let outcome = session.input("regions.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}\n{}", messages(&outcome));
    let Some(Ok(Value::Scalar(scalar))) = session.value("v") else { panic!("{script}: v is no scalar") };
    let node = scalar.node(session.graph_mut());
    (session, node)
}

fn program(graph: &Graph, node: NodeId, demand: Demand) -> Program {
    Program::compile(graph, node, &INPUTS, demand, &Limits::default()).expect("small")
}

fn values(program: &Program, at: &[Vec<f64>; 3]) -> Vec<f64> {
    let mut out = vec![0.0; at[0].len()];
    Points::<f64>::new().eval(program, &[&at[0], &at[1], &at[2]], &mut out);
    out
}

fn scattered(random: &mut Random, count: usize, reach: f64) -> [Vec<f64>; 3] {
    std::array::from_fn(|_| (0..count).map(|_| random.between(-reach, reach)).collect())
}

fn regions(graph: &Graph) -> usize {
    graph.nodes().iter().filter(|node| matches!(node, Node::Region(..))).count()
}

/// Loops whose condition differs from point to point, in plain arithmetic, so that every evaluator gives the same bits.
const LOOPS: &[&str] = &[
    "a = 0; b = 0; n = 0; WHILE (a*a + b*b <= 4 AND n < 30) DO BEGIN t = a*a - b*b + x1; b = 2*a*b + x2; a = t; n = n + 1; END; \
     v = n - 10 + a;",
    "z = [x1, x2, x3]; n = 0; WHILE (DOT(z, z) < 9 AND n < 12) DO BEGIN z = [z[2], z[3], z[1]]*1.25 + 0.1; n = n + 1; END; \
     v = z[1] - z[3] + n;",
    // Within each other, the inner one begun anew each turn and ending by what the outer one knows.
    "s = 0; i = 0; WHILE (i < 5 AND s < x1) DO BEGIN j = 0; WHILE (j <= i AND j*j < x2) DO BEGIN s = s + 0.25; j = j + 1; END; i = i + 1; END; \
     v = s - x3;",
    // In a function, in a fold, below AT.
    "f(p, q) = BEGIN f = p; WHILE (f < q) DO f = f + 0.75; END; v = f(x1, x2) - f(x2, 1);",
    "f(p, q) = BEGIN f = p; WHILE (f < q) DO f = f + 0.75; END; v = SUM(i = 1 TO 3, f(x1, i*x2));",
    "z = x1; WHILE (z < x2) DO z = z + 0.5; v = (z AT (x2, x3)) - (z AT (x1 = z));",
    // Choices and counted loops within; a name that only the body gives; values of a branch alone.
    "z = x1; n = 0; WHILE (n < 8 AND z < 3) DO BEGIN IF (z > x2) THEN z = z + 1 ELSE BEGIN w = z*2; z = w + 0.5; END; n = n + 1; END; \
     v = z - n;",
    "z = x1; WHILE (z < 5) DO BEGIN last = z; FOR k = 1 TO 3 DO z = z + 0.25*k; END; v = last + z;",
    "z = 0; FOR k = 1 TO 6 DO IF (z < x1) THEN z = z + k*0.5 ELSE z = z - x2; v = z;",
    // The first turns do not depend on a coordinate; the condition is an object.
    "z = 0; n = 0; WHILE (z < 2) DO BEGIN z = z + 1; IF (n > 0) THEN z = z - ABS(x1)/4; n = n + 1; END; v = z + n;",
    "z = x1 - 4; WHILE (2 - z*z - x2 | z < 0) DO z = z + 0.5; v = z;",
    // Where it is undefined, the loop ends.
    "z = x1; n = 0; WHILE (SQRT(z) < 3 AND n < 9) DO BEGIN z = z - 0.5; n = n + 1; END; v = n + x1;",
    // An array that is chosen from by a variable.
    "a = [3, 1, 2]; i = 1; s = x1; WHILE (i <= 3 AND s < 4) DO BEGIN s = s + a[i]*x2; i = i + 1; END; v = s;",
];

fn oracle(text: &str) -> Oracle {
    let mut sources = SourceMap::default();
    let id = sources.add("regions.geo", text);
    Oracle::new(&parse(&sources, id, &Limits::default(), Mode::Script).statements)
}

#[test]
fn a_loop_at_each_point_means_the_same_to_all() {
    let mut random = Random(11);
    for script in LOOPS {
        let (session, node) = given(script);
        let graph = session.graph();
        let at = scattered(&mut random, 150, 2.5);
        let found = values(&program(graph, node, Demand::Value), &at);
        let tree = oracle(script);
        for (k, value) in found.iter().enumerate() {
            let point = [at[0][k], at[1][k], at[2][k]];
            let Ok(Plain::Number(plain)) = tree.value("v", &point) else {
                panic!("{script}: {:?}", tree.value("v", &point))
            };
            assert!(same(*value, plain), "{script} at {point:?}: {value} and not {plain}");
        }
        let used = LOOPS.iter().position(|s| s == script).is_some_and(|i| i != 8);
        assert_eq!(regions(graph) > 0, used, "{script}");
    }
}

/// Scripts of searches, whose value at any point is compared by every evaluator with the walk.
const SEARCHES: &[&str] = &[
    "v = PROJECT(1 - (x1 - x4)**2 - x2**2, x4, -1, 2);",
    "v = PROJECT(SIN(3*x4 + x1) - 0.1*x4**2*x2, x4, x2 - 2, ABS(x3) + 1);",
    "v = PROJECT(MIN(x4 - x1, x2 - x4), x4, -1, 1) + PROJECT(FLOOR(3*x4)*x3, x4, -1, x1);",
    "v = OFFSET_BALL(1 - x1**2 - 2*x2**2, 0.3);",
    "v = OFFSET_BALL(1 - x1**2 - x2*x3, -0.4*x1);",
    "z = x1; WHILE (z < x2) DO z = z + 0.75; v = PROJECT(z - x3, x1, -1, 1);",
];

#[test]
fn every_evaluator_of_regions_equals_the_walk() {
    let mut random = Random(12);
    for script in LOOPS.iter().chain(SEARCHES) {
        let (session, node) = given(script);
        let graph = session.graph();
        let compiled = program(graph, node, Demand::Value);
        let at =
            scattered(&mut random, 20, 2.0).map(|axis| axis.iter().map(|x| f64::from(*x as f32)).collect::<Vec<_>>());
        let found = values(&compiled, &at);
        let singles = at.each_ref().map(|axis| axis.iter().map(|x| *x as f32).collect::<Vec<f32>>());
        let mut rough = [0.0f32; 20];
        Points::<f32>::new().eval(&compiled, &[&singles[0], &singles[1], &singles[2]], &mut rough);
        let (mut again, mut slopes) = ([0.0; 20], [[0.0; 20]; 3]);
        let mut into: Vec<&mut [f64]> = slopes.iter_mut().map(|s| &mut s[..]).collect();
        Gradients::new().eval(&compiled, &[&at[0], &at[1], &at[2]], &[0, 1, 2], &mut again, &mut into);
        for k in 0..20 {
            let point = [at[0][k], at[1][k], at[2][k]];
            let pairs = [0, 1, 2].map(|i| (INPUTS[i], point[i]));
            let expected = reference::eval(&mut Reals, graph, node, &pairs);
            assert!(same(found[k], expected), "{script} at {point:?}: {} and not {expected}", found[k]);
            let variables = [0, 1, 2].map(|i| (INPUTS[i], Dual::<3>::variable(point[i], i)));
            let dual = reference::eval(&mut Duals::<3>, graph, node, &variables);
            assert!(same(again[k], found[k]) && same(dual.value, found[k]), "{script} at {point:?}: {}", again[k]);
            for (axis, slope) in slopes.iter().enumerate() {
                assert!(same(slope[k], dual.slope[axis]), "{script} at {point:?}: {} and not {dual:?}", slope[k]);
            }
            let expected = reference::eval(&mut Singles, graph, node, &pairs.map(|(c, x)| (c, x as f32)));
            assert!(same(f64::from(rough[k]), f64::from(expected)), "{script}: {} and not {expected}", rough[k]);
        }
    }
}

#[test]
fn ranges_of_regions_hold_the_values() {
    let mut random = Random(13);
    for script in LOOPS.iter().chain(SEARCHES) {
        let (session, node) = given(script);
        let graph = session.graph();
        for demand in [Demand::Value, Demand::Sign] {
            let compiled = program(graph, node, demand);
            let mut boxes = Boxes::new();
            let mut over: [Vec<Interval>; 3] = std::array::from_fn(|_| Vec::new());
            for _ in 0..12 {
                let size = [0.001, 0.1, 0.5, 2.0][random.below(4)];
                for axis in &mut over {
                    let lo = random.between(-2.0, 2.0);
                    axis.push(Interval::new(lo, lo + size * random.between(0.0, 1.0)));
                }
            }
            let mut ranges = [Interval::EMPTY; 12];
            boxes.eval(&compiled, &[&over[0], &over[1], &over[2]], &mut ranges);
            for (lane, range) in ranges.iter().enumerate() {
                let over = [over[0][lane], over[1][lane], over[2][lane]];
                let walk = reference::eval(&mut Intervals, graph, node, &[0, 1, 2].map(|i| (INPUTS[i], over[i])));
                let shorter = boxes.specialise(&compiled, lane);
                let at = over.map(|o| (0..4).map(|_| random.between(o.lo, o.hi).min(o.hi)).collect::<Vec<f64>>());
                let plain = program(graph, node, Demand::Value);
                let special = values(shorter.as_ref().unwrap_or(&compiled), &at);
                for (value, special) in values(&plain, &at).into_iter().zip(special) {
                    if demand == Demand::Value {
                        assert!(
                            range.contains(value) && walk.contains(value),
                            "{script}: {value} is not in {range:?} over {over:?}"
                        );
                        assert!(same(value, special), "{script}: {special} and not {value}");
                    } else {
                        assert!(!range.is_positive() || value >= 0.0, "{script}: {value} in {range:?}");
                        assert!(
                            !range.is_negative() || value.is_nan() || value < 0.0,
                            "{script}: {value} in {range:?}"
                        );
                        assert_eq!(value >= 0.0, special >= 0.0, "{script}");
                    }
                }
            }
        }
    }
}

/// The derivative as an expression against the one of duals, which the walk computes in another way.
#[test]
fn derivatives_of_regions_are_exact() {
    let mut random = Random(14);
    let second = ["v = DIFF(PROJECT(x1*x4 - x4**2 - x2*x4**3/9, x4, -2, 2), x1);"];
    for script in LOOPS.iter().chain(&SEARCHES[..2]).chain(&SEARCHES[3..5]).chain(&second) {
        let (mut session, node) = given(script);
        let slope = derivative(session.graph_mut(), node, INPUTS[0]);
        let (graph, at) = (session.graph(), scattered(&mut random, 30, 2.0));
        let found = values(&program(graph, slope, Demand::Value), &at);
        for (k, value) in found.into_iter().enumerate() {
            let point = [at[0][k], at[1][k], at[2][k]];
            let near = |x: f64| {
                reference::eval(
                    &mut Reals,
                    graph,
                    node,
                    &[(INPUTS[0], x), (INPUTS[1], point[1]), (INPUTS[2], point[2])],
                )
            };
            let (below, above) = (near(point[0] - 1e-6), near(point[0] + 1e-6));
            let rough = (above - below) / 2e-6;
            let smooth = (above - near(point[0])) - (near(point[0]) - below);
            // At a step or a crease a difference quotient says nothing.
            if !rough.is_nan() && smooth.abs() < 1e-9 {
                assert!(
                    (value - rough).abs() <= 2e-5 * rough.abs().max(1.0),
                    "{script} at {point:?}: {value} and not {rough}"
                );
            }
        }
    }
}

/// What a script gives at a point, and the closed form of it.
type Closed = (&'static str, fn(f64, f64, f64) -> f64);

const CLOSED: &[Closed] = &[
    // A ball that moves along a line sweeps a capsule.
    ("v = PROJECT(1 - (x1 - x4)**2 - x2**2 - x3**2, x4, -1, 2);", |x, y, z| {
        let t = x.clamp(-1.0, 2.0);
        1.0 - (x - t) * (x - t) - y * y - z * z
    }),
    // A ball seen along x3 is a disc; also when the section is long and the ball small in it.
    ("v = PROJECT(4 - x1**2 - x2**2 - x3**2, x3, -3, 3);", |x, y, _| 4.0 - x * x - y * y),
    ("v = PROJECT(4 - x1**2 - x2**2 - (x3 - 77.7)**2, x3, -1000, 1000);", |x, y, _| 4.0 - x * x - y * y),
    // Both ends, bounds that move, bounds in the wrong order.
    ("v = PROJECT(x4*x1, x4, -2, 3);", |x, _, _| (3.0 * x).max(-2.0 * x)),
    ("v = PROJECT(x4, x4, x1, x2);", |x, y, _| if x <= y { y } else { f64::NAN }),
    ("v = PROJECT(x1 + x2, x4, x1, x2);", |x, y, _| if x <= y { x + y } else { f64::NAN }),
    ("v = PROJECT(SQRT(x4 - 1) - x1, x4, -5, x2);", |x, y, _| if y >= 1.0 { (y - 1.0).sqrt() - x } else { f64::NAN }),
    ("v = PROJECT(-ABS(x4 - x1), x4, -9, 9);", |_, _, _| 0.0),
    ("v = PROJECT(PROJECT(1 - (x1 - x4)**2 - (x2 - x5)**2, x4, -1, 1), x5, -1, 1);", |x, y, _| {
        1.0 - (x - x.clamp(-1.0, 1.0)).powi(2) - (y - y.clamp(-1.0, 1.0)).powi(2)
    }),
    // More values that do not change than a region has parameters.
    ("v = PROJECT(SUM(i = 1 TO 60, SIN(x1 + i)*x4), x4, 0, 1);", |x, _, _| {
        (1..=60).map(|i| (x + f64::from(i)).sin()).sum::<f64>().max(0.0)
    }),
    ("v = OFFSET_BALL(2*x1 - x2 + 2*x3, 0.5);", |x, y, z| 2.0 * x - y + 2.0 * z + 1.5),
    ("v = OFFSET_BALL(2*x1 - x2 + 2*x3, -0.5);", |x, y, z| 2.0 * x - y + 2.0 * z - 1.5),
    ("v = OFFSET_BALL(4 - x1**2 - x2**2 - x3**2, 0.75);", |x, y, z| {
        let r = (x * x + y * y + z * z).sqrt();
        4.0 - (r - 0.75).max(0.0).powi(2)
    }),
    ("v = OFFSET_BALL(4 - x1**2 - x2**2, -0.75);", |x, y, _| 4.0 - (x.hypot(y) + 0.75).powi(2)),
    ("v = OFFSET_BALL(1 - ABS(x1), 0.25);", |x, _, _| 1.0 - (x.abs() - 0.25).max(0.0)),
    ("v = OFFSET_BALL(4 - x1**2 - x2**2, x3);", |x, y, d| {
        let r = x.hypot(y);
        if d >= 0.0 { 4.0 - (r - d).max(0.0).powi(2) } else { 4.0 - (r - d).powi(2) }
    }),
];

#[test]
fn searches_find_the_closed_forms() {
    let mut random = Random(15);
    for (script, closed) in CLOSED {
        let (session, node) = given(script);
        let at = scattered(&mut random, 100, 2.5);
        for (k, value) in values(&program(session.graph(), node, Demand::Value), &at).into_iter().enumerate() {
            let expected = closed(at[0][k], at[1][k], at[2][k]);
            let right =
                (value - expected).abs() <= 1e-12 * expected.abs().max(1.0) || value.is_nan() && expected.is_nan();
            assert!(right, "{script} at {:?}: {value} and not {expected}", [at[0][k], at[1][k], at[2][k]]);
        }
    }
}

/// A box grows by a ball to one with round edges: in, on and out of the closed form.
#[test]
fn a_box_offset_by_a_ball_has_round_edges() {
    let (session, node) = given("v = OFFSET_BALL(MIN(1 - ABS(x1), 1 - ABS(x2), 1 - ABS(x3)), 0.5);");
    let mut random = Random(16);
    let at = scattered(&mut random, 300, 1.8);
    for (k, value) in values(&program(session.graph(), node, Demand::Value), &at).into_iter().enumerate() {
        let out = |axis: usize| (at[axis][k].abs() - 1.0).max(0.0);
        let distance = (out(0).powi(2) + out(1).powi(2) + out(2).powi(2)).sqrt();
        assert!((distance - 0.5).abs() < 1e-6 || (value >= 0.0) == (distance <= 0.5), "{distance} {value}");
    }
}

/// A peak so narrow that no sample meets it, which the ranges show all the same.
#[test]
fn a_narrow_peak_is_found() {
    let (session, node) = given("v = PROJECT(EXP(-(3000*(x4 - x1))**2) + 0.1*SIN(x4), x4, -3, 3);");
    let mut random = Random(17);
    let at = scattered(&mut random, 50, 2.9);
    for (k, value) in values(&program(session.graph(), node, Demand::Value), &at).into_iter().enumerate() {
        let least = 1.0 + 0.1 * at[0][k].sin();
        assert!(value >= least - 1e-9 && value < least + 1e-4, "{value} at {}", at[0][k]);
    }
    // Without a piece to look into, only samples are left.
    let limits = Limits { section_pieces: 0, ..Limits::default() };
    let blind = Program::compile(session.graph(), node, &INPUTS, Demand::Value, &limits).expect("small");
    assert!(values(&blind, &at).iter().any(|value| *value < 0.5));
}

/// The place of a maximum is known better than values can tell it.
#[test]
fn the_place_of_a_maximum_is_that_where_the_derivative_vanishes() {
    struct Cubic;
    impl Section for Cubic {
        fn slopes(&mut self, at: &[f64], values: &mut [f64], slopes: &mut [f64]) {
            for (i, t) in at.iter().enumerate() {
                (values[i], slopes[i]) = (t * (1.0 - t * t), 1.0 - 3.0 * t * t);
            }
        }
        fn ranges(&mut self, over: &[Interval], values: &mut [Interval], slopes: &mut [Interval]) {
            let (one, three) = (Interval::point(1.0), Interval::point(3.0));
            for (i, t) in over.iter().enumerate() {
                use yont::number::Binary::{Mul, Sub};
                let square = yont::number::Unary::Powi(2).interval(*t);
                values[i] = Mul.interval(*t, Sub.interval(one, square));
                slopes[i] = Sub.interval(one, Mul.interval(three, square));
            }
        }
        fn is_continuous(&self) -> bool {
            true
        }
    }
    let place = section::highest(&mut Cubic, 0.0, 2.0, 600);
    assert!((place - (1.0_f64 / 3.0).sqrt()).abs() < 1e-14, "{place}");
    let [value, at] = section::bounds(&mut Cubic, Interval::point(0.0), Interval::point(2.0));
    let top = 2.0 / 27.0_f64.sqrt();
    assert!(value.contains(top) && value.hi - value.lo < 0.1 && at.contains(place), "{value:?} {at:?}");
}

#[test]
fn a_loop_may_take_as_many_turns_as_allowed_and_no_more() {
    let (session, node) = given("n = 0; WHILE (n < x1) DO n = n + 1; v = n;");
    let limits = Limits { point_turns: 40, ..Limits::default() };
    let compiled = Program::compile(session.graph(), node, &INPUTS, Demand::Value, &limits).expect("small");
    let mut points = Points::<f64>::new();
    let mut out = [0.0; 3];
    points.eval(&compiled, &[&[39.5, 40.0, 40.5], &[0.0; 3], &[0.0; 3]], &mut out);
    assert!(out[0] == 40.0 && out[1] == 40.0 && out[2].is_nan(), "{out:?}");
    let counts = points.take_counts();
    assert_eq!((counts.endless, counts.turns), (1, 120), "{counts:?}");
    let mut range = [Interval::EMPTY; 2];
    let over = [Interval::new(38.5, 40.0), Interval::new(30.0, 50.0)];
    let still = [Interval::point(0.0); 2];
    Boxes::new().eval(&compiled, &[&over, &still, &still], &mut range);
    assert_eq!((range[0].lo, range[0].hi, range[0].undefined), (39.0, 40.0, false));
    assert!(range[1].undefined && range[1].contains(30.0), "{:?}", range[1]);
}

/// A loop that widens: the box never leaves as a whole, and yet its ranges are found.
#[test]
fn a_box_that_never_leaves_ends_all_the_same() {
    let (session, node) = given("z = x1; WHILE (z > 0.5) DO z = z*0.5 + x2; v = z;");
    let compiled = program(session.graph(), node, Demand::Value);
    let mut range = [Interval::EMPTY];
    Boxes::new().eval(
        &compiled,
        &[&[Interval::new(0.0, 4.0)], &[Interval::new(0.0, 1.0)], &[Interval::point(0.0)]],
        &mut range,
    );
    assert!(range[0].undefined && range[0].contains(0.5) && range[0].contains(0.25), "{:?}", range[0]);
}

#[test]
fn twelve_nested_doublings_stay_small() {
    let ball = "gob = 0.1 - x1**2 - x2**2 - x3**2;";
    let (session, node) = given(&format!("{ball} FOR k = 0 TO 11 DO gob = gob | gob AT (x1 = x1 + 2**k); v = gob;"));
    let nodes = session.graph().len();
    let compiled = program(session.graph(), node, Demand::Sign);
    eprintln!(
        "{nodes} nodes, {} operations of the graph, {} of the program",
        operations(session.graph(), node),
        compiled.len()
    );
    assert!(nodes < 1_000, "{nodes} nodes");
    let grid = Grid::new(&[[-20.0, 4.0], [-1.0, 1.0], [-1.0, 1.0]], 96).expect("a grid");
    let shape = Shape::new(compiled, 3, Vec::new());
    let extraction = extract(&shape, &grid, &Limits::default(), &Interrupt::default()).expect("a mesh");
    let pieces = yont::surface::check(&extraction.mesh).expect("closed").euler / 2;
    assert_eq!(pieces, 21, "balls at 0, -1 ... -19 and one that is cut");
}

#[test]
fn boxes_of_a_fractal_have_the_signs_of_dense_sampling() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/18_escape.geo");
    let script = std::fs::read_to_string(path).expect("the example");
    let (session, node) = given(&format!("{script} v = gob_escape AT (x4 = 0);"));
    let shape = |demand| Shape::new(program(session.graph(), node, demand), 3, Vec::new());
    let grid = Grid::new(&[[-1.1, 1.1]; 3], 48).expect("a grid");
    compare_signs("the fractal", &shape(Demand::Sign), &shape(Demand::Value), &grid);
    let found = extract(&shape(Demand::Sign), &grid, &Limits::default(), &Interrupt::default()).expect("a mesh");
    yont::surface::check(&found.mesh).expect("closed");
    let counters = found.report.counters;
    // Most boxes far from the fractal are decided as a whole, by the range of one compiled loop.
    let compiled = program(session.graph(), node, Demand::Sign);
    let (mut boxes, mut decided) = (Boxes::new(), 0);
    for k in 0..32 {
        let at = |i: usize| Interval::new(-1.1 + 2.2 * i as f64 / 32.0, -1.1 + 2.2 * (i + 1) as f64 / 32.0);
        for j in 0..16 {
            let mut range = [Interval::EMPTY; 32];
            let rows: Vec<Interval> = (0..32).map(at).collect();
            boxes.eval(&compiled, &[&rows, &[at(2 * j); 32], &[at(k); 32]], &mut range);
            decided += range.iter().filter(|r| r.is_negative() || r.is_positive()).count();
        }
    }
    let samples = found.report.samples;
    eprintln!("{} points of {samples} samples, {decided} of 16384 boxes decided", counters.points);
    assert!(decided > 16_384 / 4 && counters.regions.turns > counters.points, "{decided} {counters:?}");
}

/// An escape-time solid of few turns: where boxes are small against it, whole boxes escape together, and with the root search on all
/// crossed edges included fewer points are evaluated than there are samples.
#[test]
fn an_escape_time_solid_is_culled_by_intervals() {
    let (session, node) = given(
        "z = [x1, x2, x3]; r = 0; n = 0; WHILE (n < 6 AND r <= 4) DO BEGIN \
         z = [z[1]**2 - z[2]**2 - z[3]**2 - 0.3, 2*z[1]*z[2] + 0.2, 2*z[1]*z[3] + 0.1]; r = DOT(z, z); n = n + 1; END; v = 4 - r;",
    );
    let shape = Shape::new(program(session.graph(), node, Demand::Sign), 3, Vec::new());
    let mut parts = Vec::new();
    for resolution in [64, 128] {
        let grid = Grid::new(&[[-1.5, 1.5]; 3], resolution).expect("a grid");
        let report = extract(&shape, &grid, &Limits::default(), &Interrupt::default()).expect("a mesh").report;
        let (points, boxes) = (report.counters.points, report.counters.boxes);
        eprintln!("{resolution}: {points} points and {boxes} boxes evaluated, {} samples", report.samples);
        parts.push(points as f64 / report.samples as f64);
    }
    assert!(parts[1] < 0.7 && parts[1] < 0.6 * parts[0], "{parts:?}");
}

/// Where only the sign is wanted a search over a ball may end early, and still tells the sign of the value; also below a complement.
#[test]
fn the_sign_of_an_offset_is_that_of_its_value() {
    let mut random = Random(18);
    for script in [
        "v = OFFSET_BALL(MIN(1 - ABS(x1), 1 - ABS(x2), 1 - ABS(x3)), 0.4);",
        "v = OFFSET_BALL(0.3 - (SQRT(x1**2 + x2**2) - 1)**2 - x3**2, -0.2);",
        "v = OFFSET_BALL(1 - x1**2 - x2**2 - x3**2, 0.3 - 0.2*x3) & -OFFSET_BALL(x1 - x2, 0.1);",
        "v = -(OFFSET_BALL(SIN(3*x1)*SIN(3*x2) - x3, 0.25) | OFFSET_BALL(SQRT(x1 - x2) - 1, 0.5));",
        "v = OFFSET_BALL(FLOOR(2*x1) + x2, 0.3) \\ PROJECT(1 - (x1 - x4)**2 - x2**2, x4, 0, 1);",
    ] {
        let (session, node) = given(script);
        let at = scattered(&mut random, 300, 2.0);
        let plain = values(&program(session.graph(), node, Demand::Value), &at);
        let signs = values(&program(session.graph(), node, Demand::Sign), &at);
        for (k, (value, sign)) in plain.iter().zip(&signs).enumerate() {
            let point = [at[0][k], at[1][k], at[2][k]];
            assert_eq!(*value >= 0.0, *sign >= 0.0, "{script} at {point:?}: {value}, {sign}");
        }
    }
}

#[test]
fn functions_may_call_each_other() {
    let cases = [
        (
            "even(n) = IF n = 0 THEN 1 ELSE odd(n - 1); odd(n) = IF n = 0 THEN 0 ELSE even(n - 1); PRINT even(10), odd(10);",
            "1 0",
        ),
        ("f(n) = IF n <= 0 THEN 0 ELSE g(n) + 1; g(n) = h(n - 1); h(n) = f(n - 1) + w; w = 2; PRINT f(4);", "6"),
    ];
    for (script, expected) in cases {
        let mut session = session();
        let outcome = session.input("test.geo", script, Mode::Script);
        assert_eq!(outcome.events.last(), Some(&Event::Printed(expected.into())), "{script}\n{}", messages(&outcome));
    }
    let mut session = session();
    let outcome = session.input("test.geo", "gob_a = f(1); f(n) = g(n); g(n) = gob_a + n;", Mode::Script);
    assert!(messages(&outcome).contains("circle"), "{}", messages(&outcome));
}

#[test]
fn a_number_has_no_search() {
    for script in ["v = PROJECT(3, x4, 0, 1);", "v = OFFSET_BALL(3, 1);", "v = PROJECT(x4, x4, 0, 3);"] {
        let (session, node) = given(script);
        assert_eq!(session.graph().number(node), Some(3.0), "{script}");
    }
    assert!(matches!(given("v = OFFSET_BALL(x1, 0);").0.value("v"), Some(Ok(Value::Scalar(Scalar::Node(_))))));
}
