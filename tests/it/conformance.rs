//! One suite for every evaluator: compiled programs, in every form, against the slow walk over the graph. Random expressions from a
//! seeded generator of its own, so that every run is the same.

use std::sync::Arc;

use yont::field::expand::{expand, reachable};
use yont::field::{Coordinate, Graph, NodeId, Region, SharedLeaf};
use yont::limits::Limits;
use yont::number::{Algebra, Binary, Dual, Duals, Interval, Intervals, Leaf, Reals, Ternary, Unary};
use yont::vm::{Boxes, Demand, Gradients, Points, Program, reference};

use crate::number::UNARY;

/// A small generator of random numbers (splitmix64).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    pub fn between(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }
    fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }
}

/// Data for the tests: the product of two arguments.
#[derive(Debug)]
pub struct Product;

impl Leaf for Product {
    fn fingerprint(&self) -> u128 {
        7
    }
    fn name(&self) -> &str {
        "product"
    }
    fn arity(&self) -> usize {
        2
    }
    fn value(&self, at: &[f64]) -> f64 {
        at[0] * at[1]
    }
    fn gradient(&self, at: &[f64], slope: &mut [f64]) -> f64 {
        slope.copy_from_slice(&[at[1], at[0]]);
        at[0] * at[1]
    }
    fn bounds(&self, over: &[Interval]) -> Interval {
        Binary::Mul.interval(over[0], over[1])
    }
}

const NUMBERS: &[f64] = &[0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.0, -0.25, 1e-9, 7.5, f64::NAN, f64::INFINITY];
const INPUTS: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];

/// A random expression of x1, x2, x3 with shared parts, conditions and maps; what comes last is the root.
fn expression(random: &mut Random, graph: &mut Graph, size: usize) -> NodeId {
    let mut nodes: Vec<NodeId> = INPUTS.iter().map(|c| graph.coordinate(*c)).collect();
    for _ in 0..size {
        // The newest nodes are taken more often, so that the expression is deep as well as shared.
        let operand = |random: &mut Random, graph: &mut Graph| match random.below(8) {
            0 => graph.constant(random.pick(NUMBERS)),
            1 | 2 => nodes[random.below(nodes.len())],
            _ => nodes[nodes.len() - 1 - random.below(nodes.len().min(4))],
        };
        let (a, b, c) = (operand(random, graph), operand(random, graph), operand(random, graph));
        let made = match random.below(16) {
            0..=3 => graph.unary(random.pick(&UNARY), a),
            4..=6 => graph.binary(random.pick(Binary::ALL), a, b),
            7..=9 => graph.binary(random.pick(&[Binary::Min, Binary::Max, Binary::Add, Binary::Sub]), a, b),
            10 | 11 => graph.unary(Unary::Neg, a),
            12 if random.below(4) == 0 => graph.leaf(SharedLeaf(Arc::new(Product)), &[a, b]),
            12 => graph.ternary(Ternary::Select, a, b, c),
            13 | 14 => {
                let smooth = random.below(4) == 0;
                let numbers = if smooth { &[0.0, 1.0, 2.0] } else { &[0.0, 0.5, 1.0] };
                let parameter = graph.constant(random.pick(numbers));
                let parameter = if random.below(8) == 0 && !smooth { c } else { parameter };
                graph.ternary(
                    random.pick(if smooth { &Ternary::ALL[3..] } else { &Ternary::ALL[1..3] }),
                    a,
                    b,
                    parameter,
                )
            }
            _ => graph.map(a, &[(random.pick(&INPUTS), b), (random.pick(&INPUTS), c)]),
        };
        nodes.push(made);
    }
    *nodes.last().expect("there are always coordinates")
}

fn compile(graph: &Graph, root: NodeId, demand: Demand) -> Program {
    Program::compile(graph, root, &INPUTS, demand, &Limits::default()).expect("small and of three coordinates")
}

pub fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

fn walk(graph: &Graph, root: NodeId, at: [f64; 3]) -> f64 {
    reference::eval(&mut Reals, graph, root, &INPUTS.map(|c| (c, at[usize::from(c.0) - 1])))
}

fn boxes(random: &mut Random, count: usize) -> [Vec<Interval>; 3] {
    std::array::from_fn(|_| {
        let one = |_| {
            let centre = random.between(-3.0, 3.0);
            let size = random.pick(&[0.0, 0.01, 0.3, 2.0]);
            Interval::new(centre - size, centre + size)
        };
        (0..count).map(one).collect()
    })
}

/// Points of one box, its corners among them.
fn points_in(random: &mut Random, over: [Interval; 3], count: usize) -> [Vec<f64>; 3] {
    over.map(|i| {
        let one = |k: usize| match (k, random.below(6)) {
            (_, 0) => i.lo,
            (_, 1) => i.hi,
            _ => random.between(i.lo, i.hi).clamp(i.lo, i.hi),
        };
        (0..count).map(one).collect()
    })
}

/// The first operation whose interval does not hold its value, for the message of a failed test.
fn blame(graph: &Graph, root: NodeId, at: [f64; 3], over: [Interval; 3]) -> String {
    let expanded = expand(graph, &[root], 10_000).expect("small");
    let (graph, root) = expanded.as_ref().map_or((graph, root), |(g, r)| (g, r[0]));
    let range =
        |node: NodeId| reference::eval(&mut Intervals, graph, node, &INPUTS.map(|c| (c, over[usize::from(c.0) - 1])));
    let reached = reachable(graph, root);
    for node in (0..=root.index()).filter(|i| reached[*i]).map(|i| NodeId(i as u32)) {
        if !range(node).contains(walk(graph, node, at)) {
            let mut told = format!("{:?} is {:e}, not in {:?};", graph.node(node), walk(graph, node, at), range(node));
            graph.node(node).for_each_operand(|e| told += &format!(" {:e} in {:?}", walk(graph, e, at), range(e)));
            return told;
        }
    }
    "the intervals of the walk hold all values".into()
}

fn values(program: &Program, points: &[Vec<f64>; 3]) -> Vec<f64> {
    let mut out = vec![0.0; points[0].len()];
    Points::<f64>::new().eval(program, &[&points[0], &points[1], &points[2]], &mut out);
    out
}

#[test]
fn compiled_values_equal_the_walk_to_the_bit() {
    let mut random = Random(1);
    let mut evaluator = Points::<f64>::new();
    for case in 0..100_000 {
        let mut graph = Graph::new();
        let size = 1 + random.below(30);
        let root = expression(&mut random, &mut graph, size);
        let program = compile(&graph, root, Demand::Value);
        let points: [Vec<f64>; 3] = std::array::from_fn(|_| (0..3).map(|_| random.between(-3.0, 3.0)).collect());
        let mut out = [0.0; 3];
        evaluator.eval(&program, &[&points[0], &points[1], &points[2]], &mut out);
        for (k, value) in out.iter().enumerate() {
            let expected = walk(&graph, root, [points[0][k], points[1][k], points[2][k]]);
            assert!(same(*value, expected), "case {case}: {value:e} instead of {expected:e} for {program:?}");
        }
    }
}

/// The values on a lattice, after those at its points one by one.
fn on_a_lattice<T: yont::vm::block::Scalar>(program: &Program, axes: &[Vec<T>; 3]) -> (Vec<T>, Vec<T>) {
    let [mut x, mut y, mut z] = [const { Vec::new() }; 3];
    for (&c, &b) in axes[2].iter().flat_map(|c| axes[1].iter().map(move |b| (c, b))) {
        x.extend_from_slice(&axes[0]);
        y.resize(x.len(), b);
        z.resize(x.len(), c);
    }
    let (mut one_by_one, mut together) = (vec![T::default(); x.len()], vec![T::default(); x.len()]);
    let mut evaluator = Points::new();
    evaluator.eval(program, &[&x, &y, &z], &mut one_by_one);
    // The second time everything has been used before.
    for _ in 0..2 {
        evaluator.lattice(program, &[&axes[0], &axes[1], &axes[2]], &mut together);
    }
    (one_by_one, together)
}

#[test]
fn values_on_lattices_are_those_of_their_points_to_the_bit() {
    let mut random = Random(11);
    let sides =
        [[9, 9, 9], [1, 9, 4], [9, 1, 9], [2, 3, 1], [1, 1, 1], [300, 3, 2], [3, 300, 2], [2, 1, 300], [40, 5, 3]];
    for case in 0..20_000 {
        let mut graph = Graph::new();
        let size = 1 + random.below(30);
        let root = expression(&mut random, &mut graph, size);
        let program = compile(&graph, root, random.pick(&[Demand::Value, Demand::Sign]));
        let side = sides[if case < 200 { case % sides.len() } else { random.below(5) }];
        let axes = side.map(|n| (0..n).map(|_| f64::from(random.between(-3.0, 3.0) as f32)).collect::<Vec<_>>());
        let (expected, values) = on_a_lattice(&program, &axes);
        for (k, (value, expected)) in values.iter().zip(&expected).enumerate() {
            assert!(same(*value, *expected), "case {case}, {side:?}, {k}: {value:e}, not {expected:e}\n{program:?}");
        }
        let (expected, values) = on_a_lattice(&program, &axes.map(|axis| axis.iter().map(|x| *x as f32).collect()));
        for (value, expected) in values.iter().zip(&expected) {
            assert!(same(f64::from(*value), f64::from(*expected)), "case {case}, {side:?}, single\n{program:?}");
        }
    }
}

#[test]
fn intervals_hold_the_values_and_specialised_programs_give_them() {
    let mut random = Random(2);
    let (mut evaluator, mut lanes) = (Boxes::new(), vec![Interval::EMPTY; 4]);
    let mut shorter = [0, 0];
    for case in 0..100_000 {
        let mut graph = Graph::new();
        let size = 1 + random.below(30);
        let root = expression(&mut random, &mut graph, size);
        let over = boxes(&mut random, lanes.len());
        for demand in [Demand::Value, Demand::Sign] {
            let program = compile(&graph, root, demand);
            evaluator.eval(&program, &[&over[0], &over[1], &over[2]], &mut lanes);
            for (lane, range) in lanes.iter().enumerate() {
                let points = points_in(&mut random, [over[0][lane], over[1][lane], over[2][lane]], 5);
                let expected: Vec<f64> =
                    (0..5).map(|k| walk(&graph, root, [points[0][k], points[1][k], points[2][k]])).collect();
                let special = evaluator.specialise(&program, lane);
                shorter[usize::from(demand == Demand::Sign)] += usize::from(special.is_some());
                for used in [Some(&program), special.as_ref()].into_iter().flatten() {
                    for (k, (value, expected)) in values(used, &points).into_iter().zip(&expected).enumerate() {
                        match demand {
                            Demand::Value => {
                                assert!(same(value, *expected), "case {case}: {value:e}, {expected:e}\n{used:?}");
                                assert!(
                                    range.contains(value),
                                    "case {case}: {value:e} not in {range:?}: {}",
                                    blame(
                                        &graph,
                                        root,
                                        [points[0][k], points[1][k], points[2][k]],
                                        [over[0][lane], over[1][lane], over[2][lane]]
                                    )
                                );
                            }
                            Demand::Sign => {
                                assert_eq!(
                                    value >= 0.0,
                                    *expected >= 0.0,
                                    "case {case}: {value:e}, {expected:e}\n{used:?}\n{program:?}"
                                );
                            }
                        }
                    }
                }
            }
        }
    }
    assert!(shorter[0] > 1_000 && shorter[1] > shorter[0], "specialising does something: {shorter:?}");
}

/// The algebra of single precision, for the walk.
pub struct Singles;

impl Algebra for Singles {
    type Number = f32;
    fn constant(&mut self, value: f64) -> f32 {
        value as f32
    }
    fn unary(&mut self, op: Unary, a: f32) -> f32 {
        op.single(a)
    }
    fn binary(&mut self, op: Binary, a: f32, b: f32) -> f32 {
        op.single(a, b)
    }
    fn ternary(&mut self, op: Ternary, a: f32, b: f32, c: f32) -> f32 {
        op.single(a, b, c)
    }
}

impl reference::Meaning for Singles {
    fn leaf(&mut self, leaf: &dyn Leaf, arguments: &[f32]) -> f32 {
        leaf.value(&arguments.iter().map(|a| f64::from(*a)).collect::<Vec<_>>()) as f32
    }
    fn region(&mut self, region: &Region, arguments: &[f32]) -> Vec<f32> {
        reference::region::at_a_point(self, region, arguments, |v| f64::from(*v), |v, _, _| v as f32)
    }
}

/// More points than a block holds, and not a whole number of blocks.
const MANY: usize = 300;

#[test]
fn blocks_of_both_precisions_and_gradients_equal_the_walk() {
    let mut random = Random(3);
    let (mut single, mut double, mut gradients) = (Points::<f32>::new(), Points::<f64>::new(), Gradients::new());
    for case in 0..300 {
        let mut graph = Graph::new();
        let root = expression(&mut random, &mut graph, 25);
        let program = compile(&graph, root, Demand::Value);
        let expanded = expand(&graph, &[root], 10_000).expect("small");
        let points: [Vec<f64>; 3] =
            std::array::from_fn(|_| (0..MANY).map(|_| f64::from(random.between(-3.0, 3.0) as f32)).collect());
        let singles = points.each_ref().map(|p| p.iter().map(|x| *x as f32).collect::<Vec<f32>>());
        let (mut value, mut rough) = ([0.0; MANY], [0.0f32; MANY]);
        double.eval(&program, &[&points[0], &points[1], &points[2]], &mut value);
        single.eval(&program, &[&singles[0], &singles[1], &singles[2]], &mut rough);
        let (mut again, mut slopes) = ([0.0; MANY], [[0.0; MANY]; 4]);
        let mut into: Vec<&mut [f64]> = slopes.iter_mut().map(|s| &mut s[..]).collect();
        gradients.eval(&program, &[&points[0], &points[1], &points[2]], &[2, 0, 1, 2], &mut again, &mut into);
        for k in (0..MANY).step_by(23) {
            let at = [points[0][k], points[1][k], points[2][k]];
            assert!(same(value[k], walk(&graph, root, at)), "case {case}");
            // Numbers that a map brings together are folded in double precision, so the walk takes the expanded graph.
            let (plain, plain_root) = expanded.as_ref().map_or((&graph, root), |(g, r)| (g, r[0]));
            let expected =
                reference::eval(&mut Singles, plain, plain_root, &[0, 1, 2].map(|i| (INPUTS[i], at[i] as f32)));
            assert!(same(f64::from(rough[k]), f64::from(expected)), "case {case}: {} instead of {expected}", rough[k]);
            let variables = [0, 1, 2].map(|i| (INPUTS[i], Dual::<3>::variable(at[i], i)));
            let expected = reference::eval(&mut Duals::<3>, plain, plain_root, &variables);
            assert!(same(again[k], expected.value), "case {case}");
            for (slope, by) in slopes.iter().zip([2, 0, 1, 2]) {
                assert!(same(slope[k], expected.slope[by]), "case {case}: {} instead of {expected:?}", slope[k]);
            }
        }
    }
}

/// Each operation by itself, its operands coordinates or numbers, so that every kernel and every form of it runs.
#[test]
fn every_operation_in_every_form_equals_the_walk() {
    let mut random = Random(4);
    let points: [Vec<f64>; 3] = std::array::from_fn(|_| (0..MANY).map(|_| random.between(-2.0, 2.0)).collect());
    let all = |build: &dyn Fn(&mut Graph, [NodeId; 3]) -> NodeId| {
        for form in 0..8 {
            let mut graph = Graph::new();
            let operand = |graph: &mut Graph, i: usize| match form >> i & 1 {
                0 => graph.coordinate(INPUTS[i]),
                _ => graph.constant([0.75, -1.25, 0.5][i]),
            };
            let operands = [operand(&mut graph, 0), operand(&mut graph, 1), operand(&mut graph, 2)];
            let root = build(&mut graph, operands);
            let program = compile(&graph, root, Demand::Value);
            let computed = values(&program, &points);
            let mut ranges = [Interval::EMPTY; 64];
            let boxes =
                points.each_ref().map(|p| p[..64].iter().map(|x| Interval::new(*x, *x + 0.1)).collect::<Vec<_>>());
            Boxes::new().eval(&program, &[&boxes[0], &boxes[1], &boxes[2]], &mut ranges);
            for k in 0..MANY {
                let expected = walk(&graph, root, [points[0][k], points[1][k], points[2][k]]);
                assert!(same(computed[k], expected), "{:?}: {} {expected}", graph.node(root), computed[k]);
                if let Some(range) = ranges.get(k) {
                    assert!(range.contains(expected), "{:?}: {expected} in {range:?}", graph.node(root));
                    let over = [0, 1, 2].map(|i| (INPUTS[i], boxes[i][k]));
                    let walked = reference::eval(&mut Intervals, &graph, root, &over);
                    assert_eq!(*range, walked, "{:?}", graph.node(root));
                }
            }
        }
    };
    for op in UNARY.iter() {
        all(&|graph, [a, ..]| graph.unary(*op, a));
    }
    for op in Binary::ALL {
        all(&|graph, [a, b, _]| graph.binary(*op, a, b));
    }
    for op in Ternary::ALL {
        all(&|graph, [a, b, c]| graph.ternary(*op, a, b, c));
    }
}

/// A chain of `length` operations that leans to one side.
fn chain(graph: &mut Graph, length: usize, op: Binary, left: bool) -> NodeId {
    let x = graph.coordinate(INPUTS[0]);
    (0..length).fold(x, |sum, i| {
        let number = graph.constant(i as f64);
        let term = graph.binary(Binary::Mul, x, number);
        if left { graph.binary(op, sum, term) } else { graph.binary(op, term, sum) }
    })
}

#[test]
fn long_chains_neither_recurse_nor_keep_many_values() {
    for (length, op, left) in [
        (1_000_000, Binary::Add, true),
        (100_000, Binary::Sub, false),
        (100_000, Binary::Max, false),
        (100_000, Binary::Max, true),
    ] {
        let mut graph = Graph::new();
        let root = chain(&mut graph, length, op, left);
        let program = compile(&graph, root, Demand::Value);
        assert!(program.slot_count() <= 6, "{op:?}: {} slots", program.slot_count());
        let at = [[0.5].to_vec(), vec![0.0], vec![0.0]];
        assert!(same(values(&program, &at)[0], walk(&graph, root, [0.5, 0.0, 0.0])));
        let mut out = [Interval::EMPTY];
        let mut boxes = Boxes::new();
        boxes.eval(
            &program,
            &[&[Interval::new(0.5, 0.5 + 1e-9)], &[Interval::new(0.0, 0.0)], &[Interval::new(0.0, 0.0)]],
            &mut out,
        );
        assert!(out[0].contains(values(&program, &at)[0]));
        if op == Binary::Max {
            let special = boxes.specialise(&program, 0).expect("all but a few terms are below the last");
            assert!(special.len() < 10 && same(values(&special, &at)[0], walk(&graph, root, [0.5, 0.0, 0.0])));
        }
    }
}

#[test]
fn a_program_that_is_too_large_or_unbound_is_refused() {
    let mut graph = Graph::new();
    let root = chain(&mut graph, 50, Binary::Add, true);
    let length = compile(&graph, root, Demand::Value).len();
    let with = |operations| {
        let limits = Limits { program_operations: operations, ..Limits::default() };
        Program::compile(&graph, root, &INPUTS, Demand::Value, &limits).map(|p| p.len())
    };
    assert_eq!(with(length), Ok(length));
    assert_eq!(with(length - 1), Err(yont::vm::CompileError::TooLarge(length - 1)));
    let unbound = Program::compile(&graph, root, &INPUTS[1..], Demand::Value, &Limits::default());
    assert_eq!(unbound.err(), Some(yont::vm::CompileError::Unbound(INPUTS[0])));
}
