//! How fast programs are evaluated: per operation and point, per operation and box, per operation specialised.

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use yont::field::{Coordinate, Graph, NodeId};
use yont::limits::Limits;
use yont::number::{Algebra, Binary, Interval, Ternary, Unary};
use yont::vm::{Boxes, Demand, Gradients, Points, Program};

const INPUTS: [Coordinate; 2] = [Coordinate(1), Coordinate(2)];

/// The expression of a `.vm` file; the numbers of operations are those of its lines.
fn prospero(graph: &mut Graph) -> Option<NodeId> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/models/prospero.vm");
    let text = std::fs::read_to_string(path).ok()?;
    let mut names = std::collections::HashMap::new();
    let mut last = None;
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let operand = |i: usize| names[words[i]];
        let node = match words[1] {
            "const" => graph.constant(words[2].parse().ok()?),
            "var-x" => graph.coordinate(INPUTS[0]),
            "var-y" => graph.coordinate(INPUTS[1]),
            "neg" => graph.unary(Unary::Neg, operand(2)),
            "sqrt" => graph.unary(Unary::Sqrt, operand(2)),
            "square" => graph.unary(Unary::Powi(2), operand(2)),
            "add" => graph.binary(Binary::Add, operand(2), operand(3)),
            "sub" => graph.binary(Binary::Sub, operand(2), operand(3)),
            "mul" => graph.binary(Binary::Mul, operand(2), operand(3)),
            "min" => graph.binary(Binary::Min, operand(2), operand(3)),
            _ => graph.binary(Binary::Max, operand(2), operand(3)),
        };
        names.insert(words[0], node);
        last = Some(node);
    }
    last.map(|root| graph.unary(Unary::Neg, root))
}

/// A chain of 200 operations of one kind.
fn chain(op: &dyn Fn(&mut Graph, NodeId, NodeId) -> NodeId) -> Program {
    let mut graph = Graph::new();
    let (x, y) = (graph.coordinate(INPUTS[0]), graph.coordinate(INPUTS[1]));
    let root = (0..200).fold(x, |value, _| op(&mut graph, value, y));
    Program::compile(&graph, root, &INPUTS, Demand::Value, &Limits::default()).expect("200 operations")
}

fn evaluate(c: &mut Criterion, name: &str, program: &Program) {
    let count = 4096;
    let (xs, ys): (Vec<f64>, Vec<f64>) =
        (0..count).map(|k| ((k % 64) as f64 / 32.0 - 1.0, (k / 64) as f64 / 32.0 - 1.0)).unzip();
    let (sx, sy): (Vec<f32>, Vec<f32>) =
        (xs.iter().map(|x| *x as f32).collect(), ys.iter().map(|y| *y as f32).collect());
    let mut group = c.benchmark_group(name);
    group.sample_size(10);
    group.throughput(Throughput::Elements((program.len() * count) as u64));
    let (mut double, mut single, mut gradients) = (Points::<f64>::new(), Points::<f32>::new(), Gradients::new());
    let (mut values, mut roughs) = (vec![0.0; count], vec![0.0f32; count]);
    group.bench_function("double", |b| b.iter(|| double.eval(program, &[&xs, &ys], black_box(&mut values))));
    group.bench_function("single", |b| b.iter(|| single.eval(program, &[&sx, &sy], black_box(&mut roughs))));
    let mut slopes = [vec![0.0; count], vec![0.0; count]];
    group.bench_function("gradient", |b| {
        b.iter(|| {
            let [s, t] = &mut slopes;
            gradients.eval(program, &[&xs, &ys], &[0, 1], &mut values, &mut [&mut s[..], &mut t[..]]);
        });
    });
    let mut boxes = Boxes::new();
    let over = |p: &[f64]| p[..64].iter().map(|x| Interval::new(*x, *x + 0.25)).collect::<Vec<_>>();
    let (bx, by) = (over(&xs), over(&ys));
    let mut ranges = vec![Interval::EMPTY; 64];
    group.throughput(Throughput::Elements((program.len() * 64) as u64));
    group.bench_function("boxes", |b| b.iter(|| boxes.eval(program, &[&bx, &by], black_box(&mut ranges))));
    group.throughput(Throughput::Elements(program.len() as u64));
    group.bench_function("specialise", |b| b.iter(|| boxes.specialise(program, 20)));
    group.finish();
}

fn all(c: &mut Criterion) {
    let mut graph = Graph::new();
    if let Some(root) = prospero(&mut graph) {
        let program =
            Program::compile(&graph, root, &INPUTS, Demand::Sign, &Limits::default()).expect("7,866 operations");
        evaluate(c, "prospero", &program);
    }
    evaluate(c, "add", &chain(&|g, a, b| g.binary(Binary::Add, a, b)));
    evaluate(c, "max", &chain(&|g, a, b| g.binary(Binary::Max, a, b)));
    evaluate(c, "sqrt", &chain(&|g, a, _| g.unary(Unary::Sqrt, a)));
    evaluate(c, "sin", &chain(&|g, a, _| g.unary(Unary::Sin, a)));
    evaluate(
        c,
        "union",
        &chain(&|g, a, b| {
            let alpha = g.constant(0.0);
            let b = g.unary(Unary::Neg, b);
            g.ternary(Ternary::Union, a, b, alpha)
        }),
    );
}

criterion_group!(benches, all);
criterion_main!(benches);
