//! What is compared: pictures, meshes and dense evaluation. Each work checks that both sides found the same before it is timed.

use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

use fidget::eval::{BulkEvaluator, Function, MathFunction};
use fidget::jit::JitFunction;
use fidget::raster::effects::to_rgba_bitmap;
use fidget::raster::pixel;
use fidget::render::ThreadPool;
use fidget::shape::{BoundShape, EzShape, Shape as Form, ShapeBulkEval};
use fidget::vm::VmFunction;
use rayon::prelude::*;
use yont::interrupt::Interrupt;
use yont::picture::plot::{Fill, Window, inside, plot};
use yont::vm::block::Scalar;
use yont::vm::{Demand, Points, Program, Shape};

use crate::meshes::{self, beside_fidget};
use crate::ours::{GYROID, Object, program, spheres};
use crate::peer::Expression;
use crate::pictures;
use crate::table::{Runner, compare};

/// Name and work.
pub const WORKS: &[(&str, fn())] = &[
    ("prospero-1024", || prospero(1024)),
    ("prospero-4096", || prospero(4096)),
    ("spheres-root-section", || section("10,000 spheres, `|`, section 1024", 0, 1024)),
    ("spheres-max-section", || section("10,000 spheres, max, section 1024", 1, 1024)),
    ("spheres-root-heights", || pictures::heights("10,000 spheres, `|`, height map 256", 0)),
    ("spheres-max-heights", || pictures::heights("10,000 spheres, max, height map 256", 1)),
    ("gyroid-picture", pictures::gyroid),
    ("load", pictures::load),
    ("gyroid-128", || beside_fidget("gyroid ball, mesh 128", &Object::of(GYROID), 1.0, 7)),
    ("gyroid-256", || beside_fidget("gyroid ball, mesh 256", &Object::of(GYROID), 1.0, 8)),
    ("bear", || model_mesh("bear", 1.0)),
    ("colonnade", || model_mesh("colonnade", 1.0)),
    ("tanglecube", || model_mesh("tanglecube", 4.5)),
    ("python-gyroid", || meshes::beside_python(256)),
    ("dense-gyroid", || dense("gyroid ball, dense 256", &Object::of(GYROID))),
    ("dense-bear", || {
        if let Some(list) = list("bear") {
            dense("bear, dense 256", &Object::of(&program(&list)));
        }
    }),
];

/// Time for the runs of each side.
pub const BUDGET: Duration = Duration::from_secs(3);

/// Uses a result, so that nobody leaves the work out.
pub fn keep<T>(result: T) {
    drop(black_box(result));
}

pub fn list(name: &str) -> Option<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../../shared/data/models/{name}.vm"));
    let text = std::fs::read_to_string(&path).ok();
    if text.is_none() {
        println!("SKIPPED: {} is missing", path.display());
    }
    text
}

fn prospero(side: usize) {
    let Some(list) = list("prospero") else { return };
    let object = Object::of(&program(&list));
    picture(&format!("prospero {side}"), &object, &Expression::read(&list), side);
}

fn section(name: &str, r_alpha: u8, side: usize) {
    let text = spheres(10_000, r_alpha);
    let solid = Object::of(&text);
    let peer = Expression::of(solid.graph(), solid.root);
    picture(name, &Object::of(&format!("{text}gob_section = gob_s AT (x3 = 0);")), &peer, side);
}

fn picture(name: &str, object: &Object, peer: &Expression, side: usize) {
    let window = Window { lo: [-1.0; 2], hi: [1.0; 2] };
    let paint =
        |shape: &Shape| plot(shape, window, [side; 2], Fill::Mono, &Interrupt::default()).expect("no one stops it");
    let mask = |shape: &Shape| inside(shape, window, [side; 2], &Interrupt::default());
    // Fidget looks at the corners of pixels, Yont at their middles.
    let half = nalgebra::Vector2::repeat(1.0 / side as f32);
    let config = pixel::RenderConfig {
        world_to_model: nalgebra::Matrix3::new_translation(&half),
        ..pixel::RenderConfig::from_size((side as u32).into())
    };
    let seen = config.run(bound::<JitFunction>(peer));
    let ours = paint(&object.shape(2, Demand::Sign));
    let same =
        seen.iter().zip(ours.image.rgba.chunks_exact(4)).filter(|(p, rgba)| p.inside() == (rgba[0] == 0)).count();
    println!("<!-- {name}: {same} of {} pixels are the same -->", side * side);
    assert!(same * 1000 >= side * side * 995, "the pictures agree");
    compare(
        name,
        &mut [
            Runner::new("Yont, double", || object.shape(2, Demand::Sign), |s| keep(paint(s))),
            Runner::new("Yont, double, a byte a pixel", || object.shape(2, Demand::Sign), |s| keep(mask(s))),
            Runner::new("Fidget, VM, single", || bound::<VmFunction>(peer), |b| keep(coloured(config.run(b.clone())))),
            Runner::new(
                "Fidget, JIT, single",
                || bound::<JitFunction>(peer),
                |b| keep(coloured(config.run(b.clone()))),
            ),
            Runner::new(
                "Fidget, VM, single, its own pixels",
                || bound::<VmFunction>(peer),
                |b| keep(config.run(b.clone())),
            ),
            Runner::new(
                "Fidget, JIT, single, its own pixels",
                || bound::<JitFunction>(peer),
                |b| keep(config.run(b.clone())),
            ),
        ],
        5,
        BUDGET,
    );
}

/// What Fidget makes of its pixels for a file: black and white.
fn coloured(seen: pixel::Image) -> fidget::raster::Image<[u8; 4]> {
    to_rgba_bitmap(seen, false, Some(&ThreadPool::Global))
}

/// A shape of Fidget without variables.
pub fn bound<F: MathFunction + Clone>(peer: &Expression) -> BoundShape<'static, F, f32> {
    Form::<F>::new(&peer.context, peer.root).expect("a shape").try_into().ok().expect("no variables")
}

fn model_mesh(name: &str, half: f64) {
    if let Some(list) = list(name) {
        beside_fidget(&format!("{name}, mesh 128"), &Object::of(&program(&list)), half, 7);
    }
}

/// The lattice of a dense evaluation: slab by slab, in pieces of a size that suits the evaluator.
struct Lattice {
    side: usize,
    piece: usize,
}

impl Lattice {
    /// The sum over all points of what `values` makes of each piece: coordinates in, values out.
    fn sum<T, E>(
        &self,
        number: impl Fn(f64) -> T + Sync,
        make: impl Fn() -> E + Sync + Send,
        values: Values<'_, T, E>,
    ) -> f64
    where
        T: Copy + Send + Sync + Into<f64>,
    {
        let side = self.side;
        let at = |k: usize| number((k as f64 + 0.5) / side as f64 * 2.0 - 1.0);
        let slabs: Vec<f64> = (0..side)
            .into_par_iter()
            .map_init(&make, |evaluator, z| {
                let mut sum = 0.0;
                let zs = vec![at(z); self.piece];
                for from in (0..side * side).step_by(self.piece) {
                    let (xs, ys): (Vec<T>, Vec<T>) =
                        (from..from + self.piece).map(|k| (at(k % side), at(k / side))).unzip();
                    sum += values(evaluator, [&xs, &ys, &zs]);
                }
                sum
            })
            .collect();
        slabs.iter().sum()
    }
}

/// Evaluates at points and gives back the sum of the values.
type Values<'a, T, E> = &'a (dyn Fn(&mut E, [&[T]; 3]) -> f64 + Sync);

fn dense_ours<T: Scalar + Into<f64>>(program: &Program, piece: usize, number: impl Fn(f64) -> T + Sync) -> f64 {
    let values = |points: &mut Points<T>, at: [&[T]; 3]| {
        let mut out = vec![number(0.0); at[0].len()];
        points.eval(program, &at, &mut out);
        out.iter().map(|v| (*v).into()).sum()
    };
    Lattice { side: 256, piece }.sum(&number, Points::<T>::new, &values)
}

/// The same slab by slab as a lattice, the form in which a grid of points is given to the evaluator.
fn dense_lattice<T: Scalar + Into<f64>>(program: &Program, number: impl Fn(f64) -> T + Sync) -> f64 {
    let side = 256;
    let axis: Vec<T> = (0..side).map(|k| number((k as f64 + 0.5) / side as f64 * 2.0 - 1.0)).collect();
    let make = || (Points::<T>::new(), vec![number(0.0); side * side]);
    let slabs: Vec<f64> = axis
        .par_chunks(1)
        .map_init(make, |(points, out), z| {
            points.lattice(program, &[&axis, &axis, z], out);
            out.iter().map(|v| (*v).into()).sum()
        })
        .collect();
    slabs.iter().sum()
}

fn dense_peer<F: MathFunction + Function>(form: &Form<F>, piece: usize) -> f64
where
    <F::FloatSliceEval as BulkEvaluator>::Tape: Sync,
{
    let tape = form.ez_float_slice_tape();
    let values = |eval: &mut ShapeBulkEval<F::FloatSliceEval>, [x, y, z]: [&[f32]; 3]| {
        eval.eval(&tape, x, y, z).expect("no variables").iter().map(|v| f64::from(*v)).sum()
    };
    Lattice { side: 256, piece }.sum(|v| v as f32, Form::<F>::new_float_slice_eval, &values)
}

fn dense(name: &str, object: &Object) {
    let peer = Expression::of(object.graph(), object.root);
    let program = || object.shape(3, Demand::Value).program;
    let form = |e: &Expression| Form::<JitFunction>::new(&e.context, e.root).expect("a shape");
    let interpreted = |e: &Expression| Form::<VmFunction>::new(&e.context, e.root).expect("a shape");
    let sums = [dense_ours(&program(), 4096, |v| v as f32), dense_ours(&program(), 4096, |v| v)];
    let lattice = [dense_lattice(&program(), |v| v as f32), dense_lattice(&program(), |v| v)];
    assert!((sums[1] - lattice[1]).abs() <= 1e-9 * sums[1].abs(), "a lattice gives the values of its points");
    let theirs = -dense_peer(&form(&peer), 4096);
    println!("<!-- {name}: sums {sums:?}, {lattice:?} and {theirs} -->");
    assert!((sums[1] - theirs).abs() <= 1e-3 * theirs.abs(), "the values agree");
    let mut runners = vec![
        Runner::new("Yont, single", program, |p| keep(dense_lattice(p, |v| v as f32))),
        Runner::new("Yont, double", program, |p| keep(dense_lattice(p, |v| v))),
        Runner::new("Yont, single, points in any order", program, |p| keep(dense_ours(p, 4096, |v| v as f32))),
        Runner::new("Yont, double, points in any order", program, |p| keep(dense_ours(p, 4096, |v| v))),
    ];
    for piece in [256, 1024, 4096, 16384] {
        let name = |who: &str| format!("Fidget, {who}, single, {piece} at once");
        runners.push(Runner::new(&name("VM"), || interpreted(&peer), move |f| keep(dense_peer(f, piece))));
        runners.push(Runner::new(&name("JIT"), || form(&peer), move |f| keep(dense_peer(f, piece))));
    }
    compare(name, &mut runners, 3, Duration::from_secs(1));
}
