//! Meshes of both sides, and how far their vertices are from the surface.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use fidget::eval::MathFunction;
use fidget::jit::JitFunction;
use fidget::mesh::{Octree, Settings};
use fidget::render::RenderHints;
use fidget::shape::BoundShape;
use fidget::vm::VmFunction;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::surface::marching::extract_bare;
use yont::surface::{Grid, Mesh, check, extract};
use yont::vm::{Demand, Gradients, Shape};

use crate::ours::{GYROID, Object};
use crate::peer::Expression;
use crate::table::{Runner, compare};
use crate::works::{BUDGET, bound, keep};

/// A mesh without normals, as those of the peers are.
pub fn bare(shape: &Shape, grid: &Grid) -> Mesh {
    extract_bare(shape, grid, &Limits::default(), &Interrupt::default()).expect("a mesh").mesh
}

/// A mesh with normals.
pub fn shaded(shape: &Shape, grid: &Grid) -> Mesh {
    extract(shape, grid, &Limits::default(), &Interrupt::default()).expect("a mesh").mesh
}

/// An object in the cube from `-half` to `half`, two to the power of `depth` cells along each side.
pub fn beside_fidget(name: &str, object: &Object, half: f64, depth: u8) {
    let peer = Expression::of(object.graph(), object.root);
    let grid = Grid::new(&[[-half, half]; 3], 1 << depth).expect("a grid");
    let settings =
        || Settings { depth, world_to_model: nalgebra::Matrix4::new_scaling(half as f32), ..Default::default() };
    let ours = bare(&object.shape(3, Demand::Sign), &grid);
    assert!(check(&ours).is_ok(), "the mesh is closed");
    let theirs = Octree::build(&bound::<VmFunction>(&peer), &settings()).expect("a tree").walk_dual();
    println!("<!-- {name}: {} and {} triangles -->", ours.triangles.len(), theirs.triangles.len());
    let positions: Vec<[f64; 3]> = theirs.vertices.iter().map(|v| [v[0], v[1], v[2]].map(f64::from)).collect();
    let [own, other] =
        [&ours.positions, &positions].map(|positions| distance(object, positions, half) / grid.cell()[0]);
    println!("<!-- {name}: rms distance of the vertices from the surface, in cells: {own:.2e} and {other:.2e} -->");
    fn peers<F: MathFunction + RenderHints + Clone>(b: &BoundShape<'static, F, f32>, s: &Settings) {
        keep(Octree::build(b, s).expect("a tree").walk_dual());
    }
    compare(
        name,
        &mut [
            Runner::new("Yont, double", || object.shape(3, Demand::Sign), |s| keep(bare(s, &grid))),
            Runner::new("Yont, double, with normals", || object.shape(3, Demand::Sign), |s| keep(shaded(s, &grid))),
            Runner::new("Fidget, VM, single", || bound::<VmFunction>(&peer), |b| peers(b, &settings())),
            Runner::new("Fidget, JIT, single", || bound::<JitFunction>(&peer), |b| peers(b, &settings())),
        ],
        3,
        BUDGET,
    );
}

/// The root of the mean of the squares of `|f| / |grad f|` at the vertices within the space that are not on its faces.
fn distance(object: &Object, positions: &[[f64; 3]], half: f64) -> f64 {
    let shape = object.shape(3, Demand::Value);
    let inner: Vec<&[f64; 3]> = positions.iter().filter(|p| p.iter().all(|c| c.abs() < 0.999 * half)).collect();
    let columns: [Vec<f64>; 3] = std::array::from_fn(|d| inner.iter().map(|p| p[d]).collect());
    let mut value = vec![0.0; inner.len()];
    let [mut a, mut b, mut c] = [value.clone(), value.clone(), value.clone()];
    let [x, y, z] = &columns;
    let slopes = &mut [&mut a[..], &mut b, &mut c];
    Gradients::new().eval(&shape.program, &[x, y, z], &[0, 1, 2], &mut value, slopes);
    let squares = (0..inner.len()).map(|i| value[i] * value[i] / (a[i] * a[i] + b[i] * b[i] + c[i] * c[i]));
    let squares: Vec<f64> = squares.filter(|s| s.is_finite()).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// A process that makes meshes when it is asked to.
struct Python {
    child: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Python {
    /// None, said aloud, where there is no interpreter.
    fn start() -> Option<Self> {
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/cubes.py");
        let child = Command::new("python3").arg(script).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let Ok(mut child) = child else {
            println!("SKIPPED: there is no python3");
            return None;
        };
        let (questions, answers) = (child.stdin.take()?, BufReader::new(child.stdout.take()?));
        Some(Self { child, questions, answers })
    }

    /// The number of triangles of the gyroid ball, if that one is installed.
    fn ask(&mut self, who: &str, cells: usize) -> Option<usize> {
        writeln!(self.questions, "{who} {cells}").ok()?;
        self.questions.flush().ok()?;
        let mut line = String::new();
        self.answers.read_line(&mut line).ok()?;
        line.trim().parse().ok()
    }
}

impl Drop for Python {
    fn drop(&mut self) {
        // Only this process started it, and it waits for a question.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The gyroid ball from its text to a mesh, beside marching cubes on what numpy has sampled.
pub fn beside_python(cells: usize) {
    let name = format!("gyroid ball, text to mesh, {} samples along a side", cells + 1);
    let grid = Grid::new(&[[-1.0, 1.0]; 3], cells).expect("a grid");
    let ours = |make: fn(&Shape, &Grid) -> Mesh| make(&Object::of(GYROID).shape(3, Demand::Sign), &grid);
    let own = ours(bare).triangles.len();
    let mut runners = vec![
        Runner::new("Yont, double", || (), |()| keep(ours(bare))),
        Runner::new("Yont, double, with normals", || (), |()| keep(ours(shaded))),
        Runner::new("Yont, double, checked", || (), |()| keep(check(&ours(bare)).expect("closed"))),
    ];
    for (who, numbers) in [("scikit-image", "single"), ("PyMCubes", "double")] {
        let Some(mut python) = Python::start() else { return };
        let Some(count) = python.ask(who, cells) else {
            println!("SKIPPED: {who} is not installed");
            continue;
        };
        println!("<!-- {name}: {own} triangles, {who} {count} -->");
        assert!(count.abs_diff(own) * 20 < own, "the meshes agree");
        runners.push(Runner::new(
            &format!("{who}, {numbers}"),
            || python,
            move |python| {
                keep(python.ask(who, cells).expect("a mesh"));
            },
        ));
    }
    compare(&name, &mut runners, 3, BUDGET);
}
