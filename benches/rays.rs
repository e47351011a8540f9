//! Star route against cubes for as many vertices, and pictures by roots against the search, each pair alternating in one run. Prints medians
//! and their ratios.

#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use yont::field::rays::Rays;
use yont::field::{Coordinate, Graph, NodeId};
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::picture::camera::{Camera, View};
use yont::picture::extent::Extent;
use yont::picture::raycast;
use yont::picture::rays::{Aim, Pattern, Scene, cast_on, search_on};
use yont::surface::marching::extract_bare;
use yont::surface::star::guide::Solid;
use yont::surface::star::mesh::{Space, over};
use yont::surface::star::{Gauge, prove};
use yont::surface::{Grid, extract};
use yont::syntax::Mode;
use yont::vm::{Demand, Program, Shape};

const AXES: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];
/// Times that each of a pair is run.
const TIMES: usize = 9;

/// The sum of the p-th powers of the sides of a Platonic solid, given by the normals of its faces, on one side of each.
fn platonic(normals: &[[f64; 3]], p: u32) -> String {
    let side = |n: &[f64; 3]| format!("MAX(({})*x1 + ({})*x2 + ({})*x3, 0)**{p}", n[0], n[1], n[2]);
    let sum: Vec<String> = normals.iter().map(side).collect();
    format!("1 - ({})**(1/{p})", sum.join(" + "))
}

fn function(text: &str) -> (Graph, NodeId) {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    assert!(session.input("a.geo", &format!("gob_a = {text};"), Mode::Script).accepted, "{text}");
    let object = session.object(Some("gob_a")).expect("an object");
    (session.graph().clone(), object.node)
}

fn program(graph: &Graph, node: NodeId, demand: Demand) -> Program {
    Program::compile(graph, node, &AXES, demand, &Limits::default()).expect("a program")
}

/// The medians of two kinds of work, in milliseconds, run by turns.
fn medians(mut a: impl FnMut(), mut b: impl FnMut()) -> [f64; 2] {
    let timed = |work: &mut dyn FnMut()| {
        let begun = Instant::now();
        work();
        begun.elapsed().as_secs_f64() * 1e3
    };
    let mut all = [Vec::new(), Vec::new()];
    for _ in 0..TIMES {
        all[0].push(timed(&mut a));
        all[1].push(timed(&mut b));
    }
    all.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[TIMES / 2]
    })
}

fn meshes() {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let signs = |n: usize| [0, 1, 2].map(|k| if n >> k & 1 == 0 { 1.0 } else { -1.0 });
    let cube: Vec<[f64; 3]> =
        (0..6).map(|k| std::array::from_fn(|d| if d == k / 2 { 1.0 - 2.0 * (k % 2) as f64 } else { 0.0 })).collect();
    let octahedron: Vec<[f64; 3]> = (0..8).map(|n| signs(n).map(|s| s * 0.577)).collect();
    let tetrahedron: Vec<[f64; 3]> = [0, 3, 5, 6].map(|n| signs(n).map(|s| s * 0.577)).to_vec();
    let turned = |a: f64, b: f64| {
        let all = (0..3).flat_map(move |k| {
            (0..4).map(move |s| {
                let mut n = [0.0; 3];
                n[(k + 1) % 3] = if s & 1 == 0 { a } else { -a };
                n[(k + 2) % 3] = if s & 2 == 0 { b } else { -b };
                n
            })
        });
        all.collect::<Vec<_>>()
    };
    let dodecahedron: Vec<[f64; 3]> = turned(1.0, golden).into_iter().map(|n| n.map(|c| c / 1.902)).collect();
    let mut icosahedron: Vec<[f64; 3]> = octahedron.clone();
    icosahedron.extend(turned(golden, 1.0 / golden).into_iter().map(|n| n.map(|c| c * 0.577)));
    println!("star route and cubes, milliseconds for a mesh without and with normals");
    for (name, normals) in [
        ("tetrahedron", tetrahedron),
        ("cube", cube),
        ("octahedron", octahedron),
        ("dodecahedron", dodecahedron),
        ("icosahedron", icosahedron),
    ] {
        for p in [2, 8] {
            let (graph, node) = function(&platonic(&normals, p));
            let mut rays = Rays::new(&graph, &AXES, &[0.0; 3], 1_000_000);
            let star = rays.star(node).expect("a star");
            let of = |node| Arc::new(program(rays.graph(), node, Demand::Value));
            let gauge = Gauge {
                centre: vec![0.0; 3],
                gauge: of(star.gauge),
                positive: None,
                single: None,
                finite: None,
                fixed: Vec::new(),
                parts: None,
            };
            let interrupt = Interrupt::default();
            let proof = prove(&gauge, &interrupt).expect("not stopped").expect("a proof");
            let reach = 1.05 * 3.0_f64.sqrt() / proof.least.max(0.3);
            let space = Space { ranges: vec![[-reach, reach]; 3] };
            let guide = Solid::Icosahedron.guide(6);
            let vertices = guide.directions.len();
            let shape = Shape::new(program(&graph, node, Demand::Sign), 3, Vec::new());
            let limits = Limits::default();
            let cubes = |n: usize, normals: bool| {
                let grid = Grid::new(&[[-reach, reach]; 3], n).expect("a grid");
                let make = if normals { extract } else { extract_bare };
                make(&shape, &grid, &limits, &interrupt).expect("a mesh").mesh.positions.len()
            };
            let few = cubes(64, false);
            let n = (64.0 * (vertices as f64 / few as f64).sqrt()).round() as usize;
            print!("{name:<13} p = {p}: {vertices} vertices, {} of {n} cells", cubes(n, false));
            for (normals, what) in [(false, "without"), (true, "with")] {
                let [star, search] = medians(
                    || drop(black_box(over(&gauge, &space, &guide, normals, &interrupt).expect("a mesh"))),
                    || {
                        black_box(cubes(n, normals));
                    },
                );
                print!("; {what} {star:.2} and {search:.2}: {:.1} times", search / star);
            }
            println!();
        }
    }
}

fn pictures() {
    println!("rays by roots and by the search, milliseconds for 640 x 640 rays with normals");
    let space = raycast::Space { lo: [-1.2; 3], hi: [1.2; 3] };
    for (name, text) in [
        ("ellipsoid", "1 - x1**2 - 2*x2**2 - x3**2 + 0.5*x1*x2"),
        ("torus", "0.1 - (SQRT(x1**2 + x2**2) - 0.8)**2 - x3**2"),
        ("quartic torus", "0.4*(x1**2 + x2**2) - (x1**2 + x2**2 + x3**2 + 0.05)**2"),
        (
            "set of three",
            "(1 - x1**2 - x2**2 - x3**2) \\ (0.3 - x1**2 - x2**2) | (0.05 - (SQRT(x1**2 + x3**2) - 1)**2 - x2**2)",
        ),
    ] {
        let (graph, node) = function(text);
        let shape = Shape::new(program(&graph, node, Demand::Sign), 3, Vec::new());
        let view = View::from_name("30,20").expect("a view");
        let camera = Camera::framing(&view, &Extent::whole(space), 1.0);
        let scene = Scene { camera, space, rays: [640, 640], tile: 8 };
        let aim = Aim { pattern: Pattern::Middles, tolerance: 1e-6, normals: true };
        let interrupt = Interrupt::default();
        let count = |tile: yont::picture::rays::Tile<'_>| tile.hits.iter().flatten().count();
        let [by_roots, by_search] = medians(
            || drop(black_box(cast_on(&shape, &scene, aim, count, &interrupt))),
            || drop(black_box(search_on(&shape, &scene, aim, count, &interrupt))),
        );
        println!("{name:<13}: {by_roots:.1} and {by_search:.1}: {:.1} times", by_search / by_roots);
    }
}

/// `meshes` or `pictures` as an argument runs that alone.
fn main() {
    let only = std::env::args().nth(1).filter(|name| !name.starts_with('-'));
    let wanted = |name: &str| only.as_deref().is_none_or(|only| only == name);
    if wanted("meshes") {
        meshes();
    }
    if wanted("pictures") {
        pictures();
    }
}
