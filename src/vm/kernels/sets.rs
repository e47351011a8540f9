//! That the bits of results do not depend on the instruction set: the same operations by the portable functions, by those for AVX2 and
//! by the widest that there are. Tests only; a set that the processor lacks falls back to the one before.

use multiversion::multiversion;

use super::super::block::{Doubles, Singles};
use super::super::gradient::Duals;
use super::super::interval::Ranges;
use super::{Code, Kind, Store, run};
use crate::field::{Coordinate, Graph, NodeId};
use crate::limits::Limits;
use crate::number::dual::Dual;
use crate::number::{Algebra, Binary, Interval, Ternary, Unary};
use crate::vm::{Demand, Program};

type Runner<K> = fn(Code<'_>, &mut Store<K>, usize, &mut <K as Kind>::Watch);

/// The functions of one kind for each set.
macro_rules! sets {
    ($kind:ty) => {{
        fn portable(code: Code<'_>, store: &mut Store<$kind>, lanes: usize, watch: &mut <$kind as Kind>::Watch) {
            run::<$kind>(code, store, lanes, watch);
        }
        #[multiversion(targets("x86_64+avx2"))]
        fn avx2<'a>(code: Code<'a>, store: &mut Store<$kind>, lanes: usize, watch: &mut <$kind as Kind>::Watch) {
            run::<$kind>(code, store, lanes, watch);
        }
        #[multiversion(targets("x86_64+avx512f+avx512bw+avx512dq+avx512vl", "x86_64+avx2"))]
        fn widest<'a>(code: Code<'a>, store: &mut Store<$kind>, lanes: usize, watch: &mut <$kind as Kind>::Watch) {
            run::<$kind>(code, store, lanes, watch);
        }
        [portable as Runner<$kind>, avx2, widest]
    }};
}

const POWERS: [i32; 8] = [-3, -2, -1, 0, 2, 3, 4, 11];

/// Every operation on x1, x2, x3, each as the root of a graph of its own.
fn expressions() -> Vec<(String, Graph, NodeId)> {
    let unary = Unary::ALL.iter().copied().chain(POWERS.map(Unary::Powi));
    let mut all = Vec::new();
    let mut add = |name: String, make: &dyn Fn(&mut Graph, [NodeId; 3]) -> NodeId| {
        let mut graph = Graph::new();
        let inputs = INPUTS.map(|c| graph.coordinate(c));
        let root = make(&mut graph, inputs);
        all.push((name, graph, root));
    };
    for op in unary {
        add(format!("{op:?}"), &|graph, [a, ..]| graph.unary(op, a));
    }
    for &op in Binary::ALL {
        add(format!("{op:?}"), &|graph, [a, b, _]| graph.binary(op, a, b));
        add(format!("{op:?} with a number"), &|graph, [a, ..]| {
            let number = graph.constant(1.75);
            graph.binary(op, a, number)
        });
    }
    for &op in Ternary::ALL {
        add(format!("{op:?}"), &|graph, [a, b, c]| graph.ternary(op, a, b, c));
    }
    all
}

const INPUTS: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];

/// Numbers of all magnitudes and signs, with the hard ones among them.
fn numbers(seed: u64, count: usize) -> Vec<f64> {
    const HARD: [f64; 14] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -2.5,
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        5e-324,
        1e-40,
        std::f64::consts::PI,
        -709.5,
    ];
    let mut state = seed;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state >> 11
    };
    let number = |_| {
        let (kind, part) = (next() % 8, next() as f64 / 9_007_199_254_740_992.0);
        match kind {
            0 => HARD[(next() % HARD.len() as u64) as usize],
            1..=4 => 20.0 * part - 10.0,
            5 => (part - 0.5) * 1e4,
            _ => (part - 0.5) * 10.0_f64.powi((next() % 60) as i32 - 30),
        }
    };
    (0..count).map(number).collect()
}

/// Runs every expression by every set on the same numbers; `item` makes a lane, `bits` what must be the same of it.
fn agree<K: Kind>(runners: [Runner<K>; 3], item: impl Fn(f64, usize) -> K::Item, bits: impl Fn(K::Item) -> Vec<u64>) {
    let limits = Limits::default();
    for (name, graph, root) in expressions() {
        let program = Program::compile(&graph, root, &INPUTS, Demand::Value, &limits).expect("one operation");
        for seed in 0..4 {
            let found = runners.map(|runner| {
                let mut store = Store::<K>::new();
                store.reserve(&program);
                for input in 0..INPUTS.len() {
                    let numbers = numbers(seed * 8 + input as u64, K::LANES);
                    let block = store.input(input);
                    numbers.iter().enumerate().for_each(|(lane, v)| K::set(block, lane, item(*v, input)));
                }
                let mut watch = K::Watch::default();
                K::begin(&mut watch, program.len(), K::LANES);
                runner(Code::of(&program), &mut store, K::LANES, &mut watch);
                let result = store.result(&program);
                (0..K::LANES).map(|lane| bits(K::get(result, lane))).collect::<Vec<_>>()
            });
            assert_eq!(found[0], found[1], "{name}: portable and AVX2");
            assert_eq!(found[0], found[2], "{name}: portable and the widest");
        }
    }
}

/// The bits; all that are undefined are one.
fn bits(value: f64) -> u64 {
    if value.is_nan() { u64::MAX } else { value.to_bits() }
}

#[test]
fn doubles_are_the_same_on_every_instruction_set() {
    agree::<Doubles>(sets!(Doubles), |v, _| v, |v| vec![bits(v)]);
}

#[test]
fn singles_are_the_same_on_every_instruction_set() {
    agree::<Singles>(sets!(Singles), |v, _| v as f32, |v| vec![bits(f64::from(v))]);
}

#[test]
fn slopes_are_the_same_on_every_instruction_set() {
    let item = |value, input| {
        let mut slope = [0.25; 3];
        slope[input] = -3.0;
        Dual { value, slope }
    };
    agree::<Duals>(sets!(Duals), item, |v| [v.value, v.slope[0], v.slope[1], v.slope[2]].map(bits).to_vec());
}

#[test]
fn ranges_are_the_same_on_every_instruction_set() {
    let item = |value: f64, input: usize| {
        let width = [0.0, 0.75, 1e3][input];
        let undefined = value.is_nan();
        let value = if undefined { 0.0 } else { value };
        Interval { lo: value, hi: value + width, undefined }
    };
    agree::<Ranges>(sets!(Ranges), item, |v| vec![bits(v.lo), bits(v.hi), u64::from(v.undefined)]);
}
