//! Meshes of both sides, how far their vertices are from the surface, and how time and memory grow with the resolution.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::Instant;

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
fn bare(shape: &Shape, grid: &Grid) -> Mesh {
    extract_bare(shape, grid, &Limits::default(), &Interrupt::default()).expect("a mesh").mesh
}

fn shaded(shape: &Shape, grid: &Grid) -> Mesh {
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

/// Time and memory of the gyroid ball by the number of cells along a side, and the exponents of both.
pub fn sizes() {
    let mut all = Vec::new();
    println!("\n| gyroid ball, cells along a side | triangles | ms (median) | checked, ms | peak memory, MiB |");
    println!("|---|---|---|---|---|");
    for cells in [64, 96, 128, 192, 256, 384, 512] {
        let grid = Grid::new(&[[-1.0, 1.0]; 3], cells).expect("a grid");
        let shape = Object::of(GYROID).shape(3, Demand::Sign);
        let mut triangles = 0;
        let time = median(|| {
            triangles = bare(&shape, &grid).triangles.len();
        });
        let mesh = bare(&shape, &grid);
        let checked = median(|| keep(check(&mesh).expect("closed")));
        drop(mesh);
        let memory = peak(cells);
        println!("| {cells} | {triangles} | {:.2} | {:.2} | {memory:.0} |", time * 1e3, checked * 1e3);
        all.push((cells as f64, time, memory));
    }
    let time = exponent(all.iter().map(|&(n, time, _)| (n, time)));
    let memory = exponent(all.iter().map(|&(n, _, memory)| (n, memory)));
    println!("\nTime grows like cells^{time:.2}, memory like cells^{memory:.2}; the surface grows like cells^2.");
}

/// The median of some runs, in seconds.
fn median(mut run: impl FnMut()) -> f64 {
    let mut times = Vec::new();
    while times.len() < 3 || (times.len() < 15 && times.iter().sum::<f64>() < 2.0) {
        let start = Instant::now();
        run();
        times.push(start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The slope of the logarithms.
fn exponent(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let points: Vec<(f64, f64)> = points.map(|(n, t)| (n.ln(), t.ln())).collect();
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let up: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    up / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// MiB that a process of its own takes at most for a mesh with normals, its check and its STL file, which goes nowhere.
fn peak(cells: usize) -> f64 {
    let own = std::env::current_exe().expect("this program");
    let output = Command::new(own).args(["--peak", &cells.to_string()]).output().expect("a process");
    String::from_utf8_lossy(&output.stdout).trim().parse().unwrap_or(f64::NAN)
}

/// What [`peak`] runs: prints MiB.
pub fn print_peak(cells: usize) {
    let grid = Grid::new(&[[-1.0, 1.0]; 3], cells).expect("a grid");
    let mesh = shaded(&Object::of(GYROID).shape(3, Demand::Sign), &grid);
    check(&mesh).expect("closed");
    yont::export::stl::write(&yont::export::Part::of("a", &mesh), &mut std::io::sink()).expect("a sink takes all");
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
    println!("{}", kilobytes.unwrap_or(f64::NAN) / 1024.0);
}
