//! What an edit of a star solid costs against evaluating it anew, for ten to a hundred thousand half-spaces, and how far ten thousand
//! random edits drift; the same for folds of other operands. Times are of one thread's processor.

#![allow(clippy::print_stdout)]

use std::sync::Arc;
use std::time::{Duration, Instant};

use yont::field::folded::How;
use yont::field::{Coordinate, Graph, NodeId};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::star::{AXES, Exponent, Polyhedron, Row, StarSolid};
use yont::number::{Algebra, Binary, Unary};
use yont::reuse::{Digest, Reuse};
use yont::surface::edit::{Edit, Sculpture};
use yont::surface::star::Gauge;
use yont::surface::star::folded::{Operand, Parts};
use yont::surface::star::guide::Guide;
use yont::surface::star::mesh::{Space, over};
use yont::vm::{Demand, Program};

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
    /// A direction, by rejection from the cube.
    fn direction(&mut self) -> [f64; 3] {
        loop {
            let v: [f64; 3] = std::array::from_fn(|_| 2.0 * self.unit() - 1.0);
            let square: f64 = v.iter().map(|x| x * x).sum();
            if (0.01..=1.0).contains(&square) {
                return v.map(|x| x / square.sqrt());
            }
        }
    }
    /// A half-space at a distance from 0.7 to 1.4.
    fn row(&mut self) -> Row {
        let (v, distance) = (self.direction(), 0.7 + 0.7 * self.unit());
        let mut row = [0.0; AXES];
        row.iter_mut().zip(v).for_each(|(out, x)| *out = x / distance);
        row
    }
    fn solid(&mut self, half_spaces: usize, p: f64) -> StarSolid {
        let p = Exponent::new(p).expect("above 0");
        let part = |random: &mut Self| Polyhedron { rows: (0..10).map(|_| random.row()).collect(), p };
        StarSolid { arity: 3, parts: (0..half_spaces / 10).map(|_| part(self)).collect(), p }
    }
    fn edit(&mut self, solid: &StarSolid) -> Edit {
        let part = self.below(solid.parts.len());
        Edit::Move { part, row: self.below(solid.parts[part].rows.len()), to: self.row() }
    }
}

fn at(v: [f64; 3]) -> Row {
    [v[0], v[1], v[2], 0.0]
}

/// The largest relative distance of the kept values from new ones, at some of the vertices.
fn drift(sculpture: &Sculpture, step: usize) -> f64 {
    let pairs = sculpture.guide().zip(sculpture.reaches()).step_by(step);
    pairs.map(|(v, kept)| (kept / sculpture.solid().reach(&at(v)) - 1.0).abs()).fold(0.0, f64::max)
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

/// A fold of ellipsoids' gauges.
fn fold(random: &mut Random, how: How, count: usize) -> Parts {
    let program = |graph: &Graph, node: NodeId, inputs: &[Coordinate]| {
        Program::compile(graph, node, inputs, Demand::Value, &Limits::default()).expect("a program")
    };
    let inputs: Vec<Coordinate> = (1..=4).map(Coordinate).collect();
    let mut around = Graph::new();
    let whole = around.coordinate(inputs[3]);
    let operands = (0..count).map(|_| ellipsoid(random, &inputs[..3])).collect();
    Parts { how, operands, around: Arc::new(program(&around, whole, &inputs)) }
}

fn ellipsoid(random: &mut Random, inputs: &[Coordinate]) -> Operand {
    let mut graph = Graph::new();
    let squares: Vec<NodeId> = inputs
        .iter()
        .map(|c| {
            let (x, by) = (graph.coordinate(*c), graph.constant(0.7 + 0.7 * random.unit()));
            let scaled = graph.binary(Binary::Mul, by, x);
            graph.unary(Unary::Powi(2), scaled)
        })
        .collect();
    let sum = graph.binary(Binary::Add, squares[0], squares[1]);
    let sum = graph.binary(Binary::Add, sum, squares[2]);
    let root = graph.unary(Unary::Sqrt, sum);
    let program = Program::compile(&graph, root, inputs, Demand::Value, &Limits::default()).expect("a program");
    let mut digest = Digest::of("operand");
    program.tell(&[], &mut digest);
    Operand { program: Arc::new(program), minus: false, key: digest.key() }
}

/// Edits of folds: one operand of so many is another one.
fn folds(vertices: usize, random: &mut Random) {
    let guide = Guide { directions: (0..vertices).map(|_| random.direction()).collect(), triangles: Vec::new() };
    let space = Space { ranges: vec![[-1e9, 1e9]; 3] };
    println!("{:>8} {:>12} {:>12} {:>12} {:>9}", "N", "fold", "anew", "edit", "ratio");
    for how in [How::Least, How::Sum, How::Norm(8.0), How::Norm(-8.0)] {
        for n in [10, 100, 1_000, 10_000] {
            let interrupt = Interrupt::default().keeping(Reuse::within(1 << 31));
            let mut parts = fold(random, how, n);
            let time = |parts: &Parts| {
                let gauge = Gauge {
                    centre: vec![0.0; 3],
                    gauge: parts.operands[0].program.clone(),
                    positive: None,
                    single: None,
                    finite: None,
                    fixed: Vec::new(),
                    parts: Some(Arc::new(parts.clone())),
                };
                let begun = Instant::now();
                over(&gauge, &space, &guide, false, &interrupt).expect("a mesh");
                begun.elapsed().as_secs_f64() * 1e9 / vertices as f64
            };
            let anew = time(&parts);
            let mut edits: Vec<f64> = (0..15)
                .map(|_| {
                    let place = random.below(n);
                    parts.operands[place] = ellipsoid(random, &[1, 2, 3].map(Coordinate));
                    time(&parts)
                })
                .collect();
            edits.sort_by(f64::total_cmp);
            let edit = edits[edits.len() / 2];
            println!("{n:>8} {:>12} {anew:>9.0} ns {edit:>9.0} ns {:>9.1}", format!("{how:?}"), anew / edit);
            assert_eq!(interrupt.costs().kept.edits, 15);
        }
    }
}

fn main() {
    let vertices: usize = std::env::var("VERTICES").ok().and_then(|v| v.parse().ok()).unwrap_or(20_000);
    let (interrupt, mut random) = (Interrupt::default(), Random(1));
    let guide: Vec<[f64; 3]> = (0..vertices).map(|_| random.direction()).collect();
    println!("{} bytes per vertex, {vertices} vertices; times of a vertex", Sculpture::bytes_per_vertex());
    println!(
        "{:>8} {:>6} {:>12} {:>12} {:>12} {:>9} {:>9}",
        "N", "p", "anew", "other part", "same part", "ratio", "ratio"
    );
    let per = |time: Duration, n: usize| time.as_secs_f64() * 1e9 / n as f64;
    for p in [2.0, 8.0, 2.5, f64::INFINITY] {
        for n in [10, 100, 1_000, 10_000, 100_000] {
            let solid = random.solid(n, p);
            let mut sculpture = Sculpture::new(solid, &guide, &interrupt).expect("not stopped");
            let sample = (2_000_000 / n).clamp(50, vertices);
            let begun = Instant::now();
            let sum: f64 = guide.iter().take(sample).map(|v| sculpture.solid().reach(&at(*v))).sum();
            let anew = per(begun.elapsed(), sample);
            assert!(sum > 0.0);
            let (mut others, mut same) = (Vec::new(), Vec::new());
            for _ in 0..9 {
                let edit = random.edit(sculpture.solid());
                let Edit::Move { part, .. } = edit else { continue };
                let begun = Instant::now();
                sculpture.edit(edit, &interrupt).expect("an edit");
                others.push(begun.elapsed());
                let again = Edit::Move { part, row: random.below(10), to: random.row() };
                let begun = Instant::now();
                sculpture.edit(again, &interrupt).expect("an edit");
                same.push(begun.elapsed());
            }
            let (others, same) = (per(median(others), vertices), per(median(same), vertices));
            println!(
                "{n:>8} {p:>6} {anew:>9.0} ns {others:>9.0} ns {same:>9.0} ns {:>9.0} {:>9.0}",
                anew / others,
                anew / same
            );
        }
    }
    folds(vertices, &mut random);
    for p in [0.5, 2.0, 32.0, 1000.0, f64::INFINITY] {
        for n in [10, 1_000] {
            let mut sculpture =
                Sculpture::new(random.solid(n, p), &guide[..500.min(vertices)], &interrupt).expect("not stopped");
            for _ in 0..10_000 {
                let edit = random.edit(sculpture.solid());
                sculpture.edit(edit, &interrupt).expect("an edit");
            }
            println!("drift after 10,000 edits of {n} half-spaces, p = {p}: {:.1e}", drift(&sculpture, 1));
        }
    }
}
