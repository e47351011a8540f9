//! Gauges of many operands while one of them changes: ten thousand random edits against evaluation anew, and sessions in which an element of an
//! array or a parameter is defined again.

use std::sync::Arc;

use yont::field::folded::{How, folded};
use yont::field::{Coordinate, Graph, NodeId};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Choice, Format, Options, Output};
use yont::number::{Algebra, Binary, Ternary, Unary};
use yont::reuse::{Digest, Reuse};
use yont::surface::star::Gauge;
use yont::surface::star::folded::{Operand, Parts};
use yont::surface::star::guide::Solid;
use yont::surface::star::mesh::{Space, over};
use yont::syntax::Mode;
use yont::vm::{Demand, Points, Program};

use crate::conformance::Random;
use crate::session::session;

const AXES: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];

fn program(graph: &Graph, node: NodeId) -> Arc<Program> {
    Arc::new(Program::compile(graph, node, &AXES, Demand::Value, &Limits::default()).expect("a program"))
}

/// An operand of degree 1: an ellipsoid about the origin, or the positive part of a linear function, to some power.
fn operand(graph: &mut Graph, random: &mut Random, how: How) -> NodeId {
    let axes = AXES.map(|c| graph.coordinate(c));
    let mut scaled = |graph: &mut Graph, lo: f64| {
        axes.map(|x| {
            let by = graph.constant(random.between(lo, 3.0));
            graph.binary(Binary::Mul, by, x)
        })
    };
    if how == How::Sum {
        let [x, y, z] = scaled(graph, -3.0);
        let sum = graph.binary(Binary::Add, x, y);
        let minus = graph.unary(Unary::Neg, z);
        let sum = graph.binary(Binary::Max, sum, minus);
        let zero = graph.constant(0.0);
        let positive = graph.binary(Binary::Max, sum, zero);
        return graph.unary(Unary::Powi(8), positive);
    }
    let squares = scaled(graph, 0.3).map(|x| graph.unary(Unary::Powi(2), x));
    let sum = graph.binary(Binary::Max, squares[0], squares[1]);
    let sum = graph.binary(Binary::Max, sum, squares[2]);
    graph.unary(Unary::Sqrt, sum)
}

/// A gauge that joins these operands, with something around it.
fn joined(graph: &mut Graph, operands: &[NodeId], how: How) -> NodeId {
    let plus = |graph: &mut Graph, a, b| match how {
        How::Sum => graph.binary(Binary::Add, a, b),
        How::Least => graph.binary(Binary::Min, a, b),
        How::Largest => graph.binary(Binary::Max, a, b),
        How::Norm(p) => {
            let p = graph.constant(p);
            graph.ternary(Ternary::Norm, a, b, p)
        }
    };
    let whole = operands[1..].iter().fold(operands[0], |all, &next| plus(graph, all, next));
    let power = graph.constant(0.125);
    if how == How::Sum { graph.binary(Binary::Pow, whole, power) } else { whole }
}

/// The gauge of so many operands, with what a session finds of it.
fn gauge(graph: &Graph, root: NodeId) -> Gauge {
    let found = folded(graph, root, 8).expect("a fold");
    let of = |(graph, node, minus): (Graph, NodeId, bool)| {
        let program = program(&graph, node);
        let mut digest = Digest::of("operand");
        program.tell(&[], &mut digest);
        Operand { program, minus, key: digest.key() }
    };
    let inputs: Vec<Coordinate> = AXES.into_iter().chain([found.whole]).collect();
    let around = Program::compile(&found.around.0, found.around.1, &inputs, Demand::Value, &Limits::default());
    let parts = Parts {
        how: found.how,
        operands: found.operands.into_iter().map(of).collect(),
        around: Arc::new(around.expect("a program")),
    };
    Gauge {
        centre: vec![0.0; 3],
        gauge: program(graph, root),
        positive: None,
        single: None,
        finite: None,
        fixed: Vec::new(),
        parts: Some(Arc::new(parts)),
    }
}

const FOLDS: &[How] =
    &[How::Sum, How::Least, How::Largest, How::Norm(2.5), How::Norm(-6.0), How::Norm(1000.0), How::Norm(-300.0)];

/// `YONT_CASES` says how many edits.
#[test]
fn folds_do_not_drift() {
    let edits: usize = std::env::var("YONT_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(2_000);
    let guide = Solid::Icosahedron.guide(1);
    let columns: [Vec<f64>; 3] = [0, 1, 2].map(|d| guide.directions.iter().map(|v| v[d]).collect());
    let space = Space { ranges: vec![[-1e30, 1e30]; 3] };
    for &how in FOLDS {
        let interrupt = Interrupt::default().keeping(Reuse::within(1 << 28));
        let (mut graph, mut random) = (Graph::new(), Random(5));
        let mut operands: Vec<NodeId> = (0..24).map(|_| operand(&mut graph, &mut random, how)).collect();
        let mut worst = 0.0_f64;
        for edit in 0..edits {
            let (place, new) = (random.below(operands.len()), operand(&mut graph, &mut random, how));
            match random.below(8) {
                0 if operands.len() < 40 => operands.insert(place, new),
                1 if operands.len() > 16 => drop(operands.remove(place)),
                _ => operands[place] = new,
            }
            let root = joined(&mut graph, &operands, how);
            let gauge = gauge(&graph, root);
            let mesh = over(&gauge, &space, &guide, false, &interrupt).expect("a mesh").boundary;
            if edit % 10 == 9 {
                let mut fresh = vec![0.0; guide.directions.len()];
                Points::new().eval(&gauge.gauge, &[&columns[0], &columns[1], &columns[2]], &mut fresh);
                for ((v, p), f) in guide.directions.iter().zip(&mesh.positions).zip(fresh) {
                    let far = (0..3).map(|d| (p[d] * f - v[d]).abs()).fold(0.0, f64::max);
                    worst = worst.max(far);
                }
            }
        }
        println!("{how:?}: {worst:.1e} from evaluation anew");
        assert!(worst < 1e-9, "{how:?}: {worst:e}");
        let kept = interrupt.costs().kept.edits;
        assert_eq!(kept as usize, edits - 1, "{how:?}: all but the first are edits");
    }
}

/// Objects of an array of parts or of a parameter, and inputs each of which is an edit.
const SESSIONS: &[(&str, &[&str])] = &[
    (
        "r = ARRAY(i = 1 TO 30, 1 + 0.2*SIN(i)); part = ARRAY(i = 1 TO 30, 1 - ((x1/r[i])**2 + (x2*COS(i) - x3*SIN(i))**2*4 + (x2*SIN(i) + x3*COS(i))**2*2)); \
         gob_a = UNION(i = 1 TO 30, part[i]);",
        &["part[3] = 1 - 0.6*x1**2 - x2**2 - x3**2;", "part[30] = 1 - x1**2 - 0.7*x2**2 - x3**2;"],
    ),
    (
        "k = 1; gob_a = INTERSECTION(i = 1 TO 40, 1 + 0.01*i - COS(i)*SIN(2*i)*x1 - SIN(i)*SIN(2*i)*x2 - COS(2*i)*x3) & k - x1 & k + x1 & k - x2 & k + x2 & k - x3 & 1 + x3;",
        &["k = 0.9;"],
    ),
    (
        "k = 2; gob_a = 1 - (SUM(i = 1 TO 40, ABS(COS(i)*x1 + SIN(i)*x2 + COS(3*i)*x3)**5) + k*ABS(x1)**5)**(1/5);",
        &["k = 3;", "k = 0.1;"],
    ),
    (
        "q = 2; gob_s = 1 - SQRT(x1**2 + q*x2**2 + x3**2); g = 1 - ABS(x1) - ABS(x2) - ABS(x3); i = 1; \
         WHILE (i <= 20) DO BEGIN g = tr_ricci_union(g, 1 - SQRT(x1**2*i + x2**2 + x3**2/i), 6); i = i + 1; END; \
         gob_a = tr_ricci_union(g, gob_s, 6);",
        &["q = 3;"],
    ),
];

fn corners(session: &mut Session) -> Vec<f32> {
    let mut options = Options::default();
    options.view.guide = Choice::read("icosahedron:3").expect("a guide");
    let (output, mut bytes) = (Output::parse("-", Format::by_extension("stl")).expect("a mesh"), Vec::new());
    request::write(session, &output, &options, &mut bytes).unwrap_or_else(|told| panic!("{told:?}"));
    let facet = |facet: &[u8]| -> Vec<f32> {
        (3..12).map(|k| f32::from_le_bytes(facet[4 * k..4 * k + 4].try_into().expect("four"))).collect()
    };
    bytes[84..].chunks_exact(50).flat_map(facet).collect()
}

#[test]
fn a_session_sees_edits_of_any_fold() {
    for (script, inputs) in SESSIONS {
        let begun = |more: &str| {
            let mut session = session();
            let outcome = session.input("a.geo", &format!("{script}\n{more}"), Mode::Script);
            assert!(outcome.accepted, "{script}: {}", crate::session::messages(&outcome));
            session
        };
        let mut edited = begun("");
        let mut before = corners(&mut edited);
        for (number, input) in inputs.iter().enumerate() {
            assert!(edited.input("a.geo", input, Mode::Script).accepted, "{input}");
            let after = corners(&mut edited);
            assert_eq!(edited.interrupt().costs().kept.edits as usize, number + 1, "{script}: {input}");
            let fresh = corners(&mut begun(&inputs[..=number].concat()));
            let far = after.iter().zip(&fresh).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(before != after && after.len() == fresh.len() && far < 1e-6, "{script}: {input}: {far} apart");
            before = after;
        }
    }
}
