//! Stars: meshes over guide shapes against cubes and closed forms, guides that are refused, and rays that meet set expressions of polynomials
//! by their roots against the search.

use std::sync::Arc;

use yont::field::rays::Rays;
use yont::field::{Coordinate, Graph, NodeId};
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, Choice, Options, Output, Route};
use yont::number::polynomial::roots;
use yont::picture::camera::{Camera, View};
use yont::picture::extent::Extent;
use yont::picture::raycast::Space as Box3;
use yont::picture::rays::{Aim, Pattern, Scene, cast_on, search_on};
use yont::surface::mesh::{cross, dot, minus};
use yont::surface::star::guide::{Guide, GuideError, Solid};
use yont::surface::star::mesh::{Space, following, over};
use yont::surface::star::{Gauge, prove};
use yont::surface::{Grid, Mesh, check, extract};
use yont::syntax::Mode;
use yont::vm::{Demand, Points, Program, Shape};

const AXES: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];

/// The function of the object `gob_a` of a script.
fn function(script: &str) -> (Graph, NodeId) {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("a.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}: {:?}", outcome.diagnostics);
    let object = session.object(Some("gob_a")).expect("an object");
    (session.graph().clone(), object.node)
}

fn program(graph: &Graph, node: NodeId, demand: Demand) -> Program {
    Program::compile(graph, node, &AXES, demand, &Limits::default()).expect("a program")
}

fn gauge(graph: &Graph, node: NodeId, centre: [f64; 3]) -> Gauge {
    let mut rays = Rays::new(graph, &AXES, &centre, 1_000_000);
    let star = rays.star(node).expect("a star");
    let of = |node| Arc::new(program(rays.graph(), node, Demand::Value));
    let gauge = Gauge {
        centre: centre.to_vec(),
        gauge: of(star.gauge),
        positive: star.positive.map(of),
        single: star.single.map(of),
        finite: star.finite.map(of),
        fixed: Vec::new(),
        parts: None,
    };
    prove(&gauge, &Interrupt::default()).expect("nobody stops it").expect("a proof");
    gauge
}

fn values(program: &Program, at: &[[f64; 3]]) -> Vec<f64> {
    let columns: [Vec<f64>; 3] = [0, 1, 2].map(|d| at.iter().map(|p| p[d]).collect());
    let mut out = vec![0.0; at.len()];
    Points::new().eval(program, &[&columns[0], &columns[1], &columns[2]], &mut out);
    out
}

fn volume(mesh: &Mesh) -> f64 {
    let six = |t: &[u32; 3]| {
        let [a, b, c] = mesh.corners(*t);
        dot(cross(a, b), c)
    };
    mesh.triangles.iter().map(six).sum::<f64>() / 6.0
}

/// The first pixel and the size of a tile, and what its rays meet: the distance, and whether from outside.
type Tile = ([usize; 2], [usize; 2], Vec<Option<(f64, bool)>>);

/// Stars with their centres.
const STARS: &[(&str, [f64; 3])] = &[
    ("1 - x1**2 - x2**2 - x3**2", [0.0; 3]),
    ("1 - (x1-0.2)**2 - x2**2/0.5 - (x3+0.1)**2*1.5", [0.2, 0.0, -0.1]),
    ("1 - (x1-0.2)**2 - x2**2 - x3**2", [0.0, 0.1, 0.0]),
    ("1 - (ABS(x1)**4 + ABS(x2)**4 + ABS(x3)**4)**(1/4)", [0.0; 3]),
    ("(1 - x1**2 - x2**2 - x3**2) | (1 - x1**2/1.5 - 3*x2**2 - 3*x3**2)", [0.0; 3]),
    ("(1 - x1**2 - x2**2 - x3**2) & (0.6 - x1) & (0.7 + x3)", [0.0; 3]),
    ("1 - ((x1**2+x2**2+x3**2)**-4 + ((x1/1.2)**2 + 4*x2**2 + 4*x3**2)**-4)**(-1/4)", [0.0; 3]),
];

/// On the star route every vertex is on the boundary to the last digits, the mesh is closed, and both routes show one shape.
#[test]
fn star_and_cube_routes_agree() {
    let (limits, interrupt) = (Limits::default(), Interrupt::default());
    let space = Space { ranges: vec![[-1.6, 1.6]; 3] };
    for (text, centre) in STARS {
        let (graph, node) = function(&format!("gob_a = {text};"));
        let gauge = gauge(&graph, node, *centre);
        let f = program(&graph, node, Demand::Value);
        let cubes = {
            let grid = Grid::new(&[[-1.6, 1.6]; 3], 64).expect("a grid");
            extract(&Shape::new(program(&graph, node, Demand::Sign), 3, Vec::new()), &grid, &limits, &interrupt)
        };
        let cubes = cubes.expect("a mesh").mesh;
        let meshes = [
            over(&gauge, &space, &Solid::Icosahedron.guide(4), true, &interrupt).expect("a mesh").boundary,
            over(&gauge, &space, &Solid::Cube.guide(5), true, &interrupt).expect("a mesh").boundary,
            following(&gauge, &space, 0.05, 1 << 20, &interrupt).expect("a mesh").boundary,
        ];
        for mesh in &meshes {
            assert_eq!(check(mesh).expect("closed").euler, 2, "{text}");
            let worst = values(&f, &mesh.positions).into_iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            assert!(worst < 1e-12, "{text}: a residual of {worst:e}");
            let (a, b) = (volume(mesh), volume(&cubes));
            assert!((a / b - 1.0).abs() < 0.02, "{text}: volumes {a} and {b}");
            for (n, p) in mesh.normals.iter().zip(&mesh.positions) {
                assert!(
                    (dot(*n, *n) - 1.0).abs() < 1e-9 && dot(*n, minus(*p, *centre)) > 0.0,
                    "{text}: a normal at {p:?}"
                );
            }
        }
        // How far the vertices of the cubes are from the star's boundary, along their rays.
        let away: Vec<[f64; 3]> = cubes.positions.iter().map(|p| minus(*p, *centre)).collect();
        for (v, g) in away.iter().zip(values(&gauge.gauge, &away)) {
            let far = dot(*v, *v).sqrt() * (1.0 - 1.0 / g).abs();
            assert!(far < 1e-5, "{text}: {far} at {v:?}");
        }
    }
}

/// A mesh that follows the shape has about as many vertices as cubes of that length, and comes closer to the volume.
#[test]
fn following_a_ball() {
    let (limits, interrupt) = (Limits::default(), Interrupt::default());
    let (graph, node) = function("gob_a = 1 - x1**2 - x2**2 - x3**2;");
    let gauge = gauge(&graph, node, [0.0; 3]);
    let grid = Grid::new(&[[-1.1, 1.1]; 3], 48).expect("a grid");
    let shape = Shape::new(program(&graph, node, Demand::Sign), 3, Vec::new());
    let cubes = extract(&shape, &grid, &limits, &interrupt).expect("a mesh").mesh;
    let space = Space { ranges: vec![[-1.1, 1.1]; 3] };
    let star = following(&gauge, &space, 1.15 * grid.cell()[0], 1 << 20, &interrupt).expect("a mesh");
    let share = star.boundary.positions.len() as f64 / cubes.positions.len() as f64;
    assert!((0.5..2.0).contains(&share), "{share}");
    assert_eq!(star.cut, [[false; 2]; 3]);
    assert_eq!(star.points as usize, star.boundary.positions.len(), "one evaluation for each vertex");
    let cut = Space { ranges: vec![[-1.1, 1.1], [-1.1, 1.1], [-1.1, 0.5]] };
    let star = over(&gauge, &cut, &Solid::Sphere.guide(4), true, &interrupt).expect("a mesh");
    assert_eq!(star.cut, [[false; 2], [false; 2], [false, true]]);
    assert!(star.boundary.positions.iter().all(|p| p[2] <= 0.5 + 1e-12));
}

#[test]
fn guides_are_closed_and_met_once() {
    for solid in [Solid::Tetrahedron, Solid::Octahedron, Solid::Cube, Solid::Icosahedron, Solid::Sphere] {
        for level in 0..4 {
            let guide = solid.guide(level);
            assert_eq!(guide.directions.len(), solid.vertices(level), "{solid:?} {level}");
            guide.check().unwrap_or_else(|error| panic!("{solid:?} {level}: {error}"));
            assert_eq!(Guide::of_mesh(&guide.directions, &guide.triangles), Ok(guide));
        }
    }
    let cube = Solid::Cube.guide(1);
    let turned: Vec<[u32; 3]> = cube.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
    assert_eq!(Guide::of_mesh(&cube.directions, &turned), Ok(cube.clone()), "turned the right way round");
    let moved: Vec<[f64; 3]> = cube.directions.iter().map(|p| [p[0] + 5.0, p[1], p[2]]).collect();
    assert!(Guide::of_mesh(&moved, &cube.triangles).is_ok(), "about its own middle");
    assert!(matches!(Guide::of_mesh(&cube.directions, &cube.triangles[1..]), Err(GuideError::Fault(_))), "open");
    let mut dented = cube.directions.clone();
    dented[0] = dented[0].map(|c| -1.5 * c);
    assert!(matches!(Guide::of_mesh(&dented, &cube.triangles), Err(GuideError::NotStar(_))), "dented");
    assert_eq!(Guide::of_mesh(&[], &[]), Err(GuideError::Empty));
}

/// Scripts, routes, guides and what becomes of them: the words of the line about the mesh, or of the message.
const ASKED: &[(&str, Route, &str, &str)] = &[
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Auto, "", "points on rays from (0, 0, 0)"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Cubes, "", "boxes evaluated"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Star, "icosahedron:3", "1280 triangles"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Star, "cube:2", "192 triangles"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Star, "guide.obj", "12 triangles"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Star, "open.obj", "`open.obj` is no guide shape: it is not closed"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Star, "bad.obj", "line 1: a vertex needs three numbers"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Star, "polygon:8", "a polygon is a guide shape of a plane figure"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2;", Route::Star, "net:16", "`net` is no guide shape"),
    (
        "net = [COS(2*PI*x1)*SIN(PI*x2), SIN(2*PI*x1)*SIN(PI*x2), COS(PI*x2)]; gob_a = 1 - x1**2 - x2**2 - x3**2;",
        Route::Star,
        "net:16",
        "224 triangles",
    ),
    ("gob_a = 1 - x1**2 - x2**2 - SIN(x3);", Route::Star, "", "a part is a function of what changes along a ray"),
    ("gob_a = 1 - x1**2 - x2**2 - SIN(x3);", Route::Auto, "", "boxes evaluated"),
    ("gob_a = 1 - x1 & 1 + x1;", Route::Star, "", "a ray never leaves it"),
    ("gob_a = 4 - x1**2 - x2**2 - x3**2;", Route::Auto, "", "boxes evaluated"),
    (
        "gob_a = 1 - x1**2 - x2**2 - x3**2; gob_a : CENTER = [1, 0, 0];",
        Route::Star,
        "",
        "lies outside it or on its boundary",
    ),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2; gob_a : CENTER = [1, 0];", Route::Star, "", "the centre has 2 numbers"),
    ("gob_a = 1 - x1**2 - x2**2 - x3**2; gob_a : CENTER = [0.5, 0, 0];", Route::Auto, "", "on rays from (0.5, 0, 0)"),
];

const CUBE: &str = "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n\
                    f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

#[test]
fn routes_and_guides_as_they_are_asked_for() {
    for (script, route, guide, expected) in ASKED {
        let open = CUBE.trim_end().rsplit_once('\n').expect("lines").0;
        let files: [(&str, &[u8]); 3] =
            [("guide.obj", CUBE.as_bytes()), ("open.obj", open.as_bytes()), ("bad.obj", b"v 1 2\n")];
        let host = Arc::new(Memory::with(&files));
        let mut session = Session::new(host, Limits::default(), Interrupt::default());
        let space = "x1min=-1.5;x1max=1.5;x2min=-1.5;x2max=1.5;x3min=-1.5;x3max=1.5;";
        assert!(session.input("a.geo", &format!("{script}\n{space}"), Mode::Script).accepted, "{script}");
        let mut options = Options::default();
        options.view.route = *route;
        options.view.cells = Cells::Along(24);
        if !guide.is_empty() {
            options.view.guide = Choice::read(guide).expect("a guide");
        }
        let output = Output::parse("a.obj", None).expect("a format");
        let told = match request::write(&mut session, &output, &options, &mut Vec::new()) {
            Ok(written) => written.lines.join("\n"),
            Err(told) => told.iter().map(|d| d.title.clone()).collect::<Vec<_>>().join("\n"),
        };
        assert!(told.contains(expected), "{script} {route:?} {guide}: {told}");
    }
    for wrong in ["", "ball:3", "sphere:99", "polygon:2", "sphere:x", "net"] {
        assert!(Choice::read(wrong).is_err(), "{wrong}");
    }
}

/// Polynomials with these roots, and all that are between -1 and 1 found again.
#[test]
fn roots_are_found_again() {
    let mut seed = 1_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / f64::from(1 << 30) - 1.0
    };
    for case in 0..20_000 {
        let degree = case % 5;
        let mut wanted: Vec<f64> = (0..degree).map(|_| 1.5 * next()).collect();
        wanted.sort_by(f64::total_cmp);
        if wanted.windows(2).any(|pair| pair[1] - pair[0] < 0.05) {
            continue;
        }
        let mut c = vec![1.0 + next().abs()];
        for root in &wanted {
            let mut product = vec![0.0; c.len() + 1];
            c.iter().enumerate().for_each(|(k, v)| {
                product[k] -= root * v;
                product[k + 1] += v;
            });
            c = product;
        }
        // Beside it a polynomial turned over, one without roots and one of the first degree.
        let rows: Vec<[f64; 4]> = c.iter().zip([1.0, 0.5, 0.0, 0.0, 0.0]).map(|(&c, k)| [c, -c, 1.0 + k, k]).collect();
        let mut found = [[0.0; 4]; 4];
        let count = roots(&rows, -1.0, 1.0, &mut found);
        let lane = |lane: usize| -> Vec<f64> {
            found[..count].iter().map(|row| row[lane]).filter(|root| root.is_finite()).collect()
        };
        let found = lane(0);
        let wanted: Vec<f64> = wanted.into_iter().filter(|r| (-1.0..1.0).contains(r)).collect();
        assert_eq!(found.len(), wanted.len(), "{c:?}: {wanted:?} and {found:?}");
        assert_eq!(found, lane(1), "{c:?}: turned over");
        for (a, b) in wanted.iter().zip(&found) {
            assert!((a - b).abs() < 1e-9, "{c:?}: {a} and {b}");
        }
    }
}

/// Set expressions of polynomials of degree four at most.
const POLYNOMIAL: &[&str] = &[
    "1 - x1**2 - x2**2 - x3**2",
    "1 - (x1-0.3)**2 - 2*x2**2 + 0.5*x1*x3 - x3**2",
    "0.1 - (SQRT(x1**2 + x2**2) - 0.8)**2 - x3**2",
    "0.4*(x1**2 + x2**2) - (x1**2 + x2**2 + x3**2 + 0.05)**2",
    "x1**2*x2**2 + x2**2*x3**2 - 0.02",
    "(1 - x1**2 - x2**2 - x3**2) \\ (0.3 - x1**2 - x2**2) | (0.05 - (SQRT(x1**2 + x3**2) - 1)**2 - x2**2)",
    "(1 - x1 & 1 + x1 & 1 - x2 & 1 + x2 & 1 - x3 & 1 + x3) & ~(1.3 - x1**2 - x2**2 - x3**2)",
    "1 - x1**4 - x2**4 - x3**4",
    "x3 - x1**3 + x1",
    "x1*x2*x3",
    "1 - (SQRT(x1**2 + x2**2) - 0.4)**2 - x3**2",
    "0.15 - (SQRT(x1**2 + x2**2) - 0.2)**2 - x3**2",
];

/// No ray's depth is apart by more than 1e-6 from that of the search, but where a ray merely touches the object.
#[test]
fn roots_show_what_the_search_shows() {
    let space = Box3 { lo: [-1.2; 3], hi: [1.2; 3] };
    for text in POLYNOMIAL {
        let (graph, node) = function(&format!("gob_a = {text};"));
        let shape = Shape::new(program(&graph, node, Demand::Sign), 3, Vec::new());
        assert!(yont::vm::along::Along::of(&shape.program, &[]).is_some(), "{text}: not seen as polynomials");
        let view = View::from_name("30,20").expect("a view");
        let camera = Camera::framing(&view, &Extent::whole(space), 1.0);
        let scene = Scene { camera, space, rays: [96, 96], tile: 8 };
        let aim = Aim { pattern: Pattern::Middles, tolerance: 1e-9, normals: true };
        let interrupt = Interrupt::default();
        let collect = |tiles: Vec<Tile>| {
            let mut all = vec![None; 96 * 96];
            for (from, size, hits) in tiles {
                for (k, hit) in hits.into_iter().enumerate() {
                    all[(from[1] + k / size[0]) * 96 + from[0] + k % size[0]] = hit;
                }
            }
            all
        };
        let keep = |tile: yont::picture::rays::Tile<'_>| {
            tile.hits.iter().map(|hit| hit.map(|hit| (hit.depth, hit.cap))).collect::<Vec<_>>()
        };
        let by_roots = collect(cast_on(&shape, &scene, aim, keep, &interrupt).expect("not stopped").0);
        let by_search = collect(search_on(&shape, &scene, aim, keep, &interrupt).expect("not stopped").0);
        let hits = by_roots.iter().flatten().count();
        assert!(hits > 200, "{text}: {hits} hits");
        let differing = by_roots.iter().zip(&by_search).filter(|(a, b)| match (a, b) {
            (Some(a), Some(b)) => a.1 != b.1 || (a.0 - b.0).abs() > 1e-6,
            (a, b) => a.is_some() != b.is_some(),
        });
        // The search may pass by what a ray merely grazes, and then meets what lies behind it; roots may not.
        let (count, behind) = differing.fold((0, 0), |(count, behind), (roots, search)| {
            let depth = |hit: &Option<(f64, bool)>| hit.map_or(f64::INFINITY, |hit| hit.0);
            (count + 1, behind + usize::from(depth(roots) > depth(search)))
        });
        assert!(count <= 4 && behind <= 2, "{text}: {count} rays differ, {behind} of them behind those of the search");
    }
    for text in
        ["1 - x1**2 - SIN(x2) - x3**2", "1 - x1**6 - x2**2 - x3**2", "1 - ABS(x1) - x2**2", "1/(x1 + 3) - x2**2"]
    {
        let (graph, node) = function(&format!("gob_a = {text};"));
        assert!(yont::vm::along::Along::of(&program(&graph, node, Demand::Sign), &[]).is_none(), "{text}");
    }
}
