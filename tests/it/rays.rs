//! Ray forms and stars: the verdicts on expressions of all kinds, and random expressions checked against dense search along rays.

use std::sync::Arc;

use expect_test::expect_file;
use yont::field::rays::Rays;
use yont::field::{Coordinate, Graph, NodeId};
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request;
use yont::number::{Algebra, Binary, Reals, Ternary, Unary};
use yont::surface::star::{Gauge, prove};
use yont::syntax::Mode;
use yont::vm::{Demand, Program, reference};

const AXES: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];

/// What `info` says of an expression, in two lines.
fn verdict(expression: &str) -> String {
    let script = format!("gob_a = {expression};\nx1min=-4;x1max=4;x2min=-4;x2max=4;x3min=-4;x3max=4;");
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("a.geo", &script, Mode::Script);
    if !outcome.accepted {
        return format!("    refused: {}", outcome.diagnostics[0].code);
    }
    let all = request::info(&mut session, Some("gob_a")).expect("an object");
    let info = all[0].json();
    let reason = info["reason"].as_str().expect("a reason");
    let form = info["equations"][0].as_str().and_then(|line| line.split_once(" = ")).map_or("", |(_, form)| form);
    if info["route"] == "star" {
        let centre = reason.split_once("from ").and_then(|(_, rest)| rest.split_once(')')).expect("a centre").0;
        let parts = reason.split_once("its ").map_or("1 part", |(_, rest)| rest.trim_end_matches(" say"));
        let form = if info["equations"].as_array().is_some_and(|all| all.len() > 1) { form } else { "" };
        return format!("    star {centre}), {parts}: {form}");
    }
    let reason = reason.split_once("a star: ").expect("why it is none").1;
    let part = info["broken_by"].as_str().map_or(String::new(), |part| format!(" | {part}"));
    let form = if form.is_empty() { String::new() } else { format!("\n        {form}") };
    format!("    no: {reason}{part}{form}")
}

/// The list is read by eye: what is a star is one, what is none says why, and the part that breaks it is the first.
#[test]
fn two_hundred_verdicts() {
    let text = include_str!("rays/verdicts.txt");
    let mut out = String::new();
    let mut count = 0;
    for line in text.lines().filter(|line| !line.starts_with("    ")) {
        out += line;
        out.push('\n');
        if !line.starts_with('#') {
            count += 1;
            out += &verdict(line);
            out.push('\n');
        }
    }
    assert!(count >= 200, "{count}");
    expect_file!["rays/verdicts.txt"].assert_eq(&out);
}

/// Whole numbers that look random.
struct Noise(u64);

impl Noise {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % n
    }

    fn number(&mut self) -> f64 {
        const NUMBERS: [f64; 9] = [1.0, 2.0, 0.5, -1.0, 3.0, -0.25, 1.5, 4.0, 0.1];
        NUMBERS[self.below(9) as usize]
    }

    fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.below(1 << 30) as f64 / f64::from(1 << 30)
    }
}

/// A random linear form, mostly about the origin.
fn linear(graph: &mut Graph, noise: &mut Noise) -> NodeId {
    let axis = AXES[noise.below(3) as usize];
    let x = graph.coordinate(axis);
    match noise.below(5) {
        0 => {
            let c = graph.constant(noise.number() / 4.0);
            graph.binary(Binary::Sub, x, c)
        }
        1 => {
            let y = graph.coordinate(AXES[noise.below(3) as usize]);
            let c = graph.constant(noise.number());
            let y = graph.binary(Binary::Mul, y, c);
            graph.binary(Binary::Add, x, y)
        }
        2 => {
            let c = graph.constant(noise.number());
            graph.binary(Binary::Mul, x, c)
        }
        _ => x,
    }
}

/// A random part: mostly of one degree.
fn part(graph: &mut Graph, noise: &mut Noise, depth: u32) -> NodeId {
    if depth == 0 {
        return linear(graph, noise);
    }
    let mut one = |graph: &mut Graph| part(graph, noise, depth - 1);
    let (a, b) = (one(graph), one(graph));
    match noise.below(16) {
        0..=3 => squares(graph, noise),
        4 => graph.unary(Unary::Abs, a),
        5 => graph.unary(Unary::Sqrt, a),
        6 => graph.binary(Binary::Max, a, b),
        7 => graph.binary(Binary::Min, a, b),
        8 => graph.binary(Binary::Add, a, b),
        9 => graph.binary(Binary::Mul, a, b),
        10 => graph.unary(Unary::Powi(noise.below(4) as i32 + 1), a),
        11 => {
            let exponent = graph.constant(noise.number() / 2.0);
            let size = graph.unary(Unary::Abs, a);
            graph.binary(Binary::Pow, size, exponent)
        }
        12 => graph.binary(Binary::Hypot, a, b),
        13 => {
            let zero = graph.constant(0.0);
            let c = linear(graph, noise);
            let condition = graph.binary(Binary::Less, zero, c);
            graph.ternary(Ternary::Select, condition, a, b)
        }
        14 => {
            let ratio = graph.binary(Binary::Div, a, b);
            let wave = graph.unary(if noise.below(2) == 0 { Unary::Sin } else { Unary::Atan }, ratio);
            let half = graph.constant(0.5);
            let wave = graph.binary(Binary::Mul, wave, half);
            let one = graph.constant(1.0);
            graph.binary(Binary::Add, one, wave)
        }
        _ => {
            let alpha = graph.constant(0.0);
            graph.ternary(Ternary::Union, a, b, alpha)
        }
    }
}

/// `a x^k + b y^k + c z^k` with positive factors.
fn squares(graph: &mut Graph, noise: &mut Noise) -> NodeId {
    let power = [2, 4, 2, 1, 3][noise.below(5) as usize];
    let offset = if noise.below(4) == 0 { noise.number() / 8.0 } else { 0.0 };
    let mut sum = graph.constant(0.0);
    for axis in AXES {
        let (x, c) = (graph.coordinate(axis), graph.constant(offset));
        let x = graph.binary(Binary::Sub, x, c);
        let size = graph.unary(Unary::Abs, x);
        let term = graph.unary(Unary::Powi(power), size);
        let factor = graph.constant(noise.number().abs());
        let term = graph.binary(Binary::Mul, term, factor);
        sum = graph.binary(Binary::Add, sum, term);
    }
    sum
}

/// A random solid: a number less a part, joined with others.
fn solid(graph: &mut Graph, noise: &mut Noise, depth: u32) -> NodeId {
    if depth > 0 && noise.below(3) > 0 {
        let (a, b) = (solid(graph, noise, depth - 1), solid(graph, noise, depth - 1));
        let alpha = graph.constant([0.0, 1.0, 0.5][noise.below(3) as usize]);
        return match noise.below(5) {
            0 => graph.binary(Binary::Max, a, b),
            1 => graph.binary(Binary::Min, a, b),
            2 => {
                let b = graph.unary(Unary::Neg, b);
                graph.ternary(Ternary::Intersection, a, b, alpha)
            }
            3 => graph.ternary(Ternary::Intersection, a, b, alpha),
            _ => graph.ternary(Ternary::Union, a, b, alpha),
        };
    }
    let first = match noise.below(6) {
        0 => part(graph, noise, 1),
        _ => graph.constant(noise.number()),
    };
    let second = if noise.below(2) == 0 { squares(graph, noise) } else { part(graph, noise, 2) };
    let f = graph.binary(Binary::Sub, first, second);
    match noise.below(8) {
        0 => {
            let more = part(graph, noise, 1);
            graph.binary(Binary::Sub, f, more)
        }
        1 => {
            let moved: Vec<(Coordinate, NodeId)> = AXES.iter().map(|axis| (*axis, linear(graph, noise))).collect();
            graph.map(f, &moved)
        }
        2 => graph.unary(Unary::Neg, f),
        _ => f,
    }
}

/// The gauge of a function about a centre, if it is proved to be a star.
fn gauge(graph: &Graph, root: NodeId, centre: &[f64]) -> Option<Gauge> {
    let limits = Limits::default();
    let mut rays = Rays::new(graph, &AXES, centre, limits.ray_nodes);
    let star = rays.star(root).ok()?;
    let program =
        |node| Arc::new(Program::compile(rays.graph(), node, &AXES, Demand::Value, &limits).expect("a program"));
    let gauge = Gauge {
        centre: centre.to_vec(),
        gauge: program(star.gauge),
        positive: star.positive.map(program),
        single: star.single.map(program),
        finite: star.finite.map(program),
        fixed: Vec::new(),
        parts: None,
    };
    prove(&gauge, &Interrupt::default()).expect("nobody stops it").ok()?;
    Some(gauge)
}

fn at(graph: &Graph, root: NodeId, point: [f64; 3]) -> f64 {
    let point: Vec<(Coordinate, f64)> = AXES.iter().copied().zip(point).collect();
    reference::eval(&mut Reals, graph, root, &point)
}

/// What is proved to be a star is inside up to `1/F` along every ray, and outside beyond it. `YONT_CASES` says how many expressions.
#[test]
fn no_wrong_yes_on_random_expressions() {
    let cases = std::env::var("YONT_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(3_000_u64);
    let mut stars = 0;
    for seed in 0..cases {
        let mut noise = Noise(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
        let mut graph = Graph::new();
        let root = solid(&mut graph, &mut noise, 2);
        let centre = match noise.below(3) {
            0 => [0, 1, 2].map(|_| noise.number() / 8.0),
            _ => [0.0; 3],
        };
        let Some(gauge) = gauge(&graph, root, &centre) else { continue };
        stars += 1;
        for _ in 0..6 {
            let v = [0, 1, 2].map(|_| noise.between(-1.0, 1.0));
            let mut value = [0.0];
            yont::vm::Points::new().eval(&gauge.gauge, &[&[v[0]], &[v[1]], &[v[2]]], &mut value);
            let far = 1.0 / value[0];
            assert!(far > 0.0 && far.is_finite(), "seed {seed}: {far} towards {v:?}");
            for step in 1..=400_u32 {
                let t = far * f64::from(step) / 200.0;
                let near = (t / far - 1.0).abs();
                if near < 1e-6 {
                    continue;
                }
                let value = at(&graph, root, [0, 1, 2].map(|k| centre[k] + t * v[k]));
                // A value that is nothing but rounding has no sign.
                let is_inside = value >= 0.0;
                let is_rounding = value.abs() < 1e-13;
                assert!(
                    is_inside == (t < far) || is_rounding,
                    "seed {seed}: {value} at {t} of {far} towards {v:?} about {centre:?}: {:?}",
                    graph.nodes()
                );
            }
        }
    }
    assert!(stars * 100 > cases, "{stars} stars of {cases}");
}

/// An object of a chain of so many nodes is looked at with that limit, and refused with one less.
#[test]
fn a_form_takes_so_many_nodes() {
    let mut graph = Graph::new();
    let mut sum = graph.constant(1.0);
    for axis in AXES {
        let x = graph.coordinate(axis);
        let square = graph.unary(Unary::Powi(2), x);
        sum = graph.binary(Binary::Sub, sum, square);
    }
    let nodes = graph.len();
    let star = |limit| Rays::new(&graph, &AXES, &[0.0; 3], limit).star(sum).is_ok();
    assert!(star(nodes) && !star(nodes - 1), "{nodes}");
}
