//! Meshes: closed, oriented and 2-manifold for every shape, with the signs of dense sampling, the same bytes for any number of threads.

use std::io::Cursor;

use yont::export::{Part, obj, ply, stl};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::{Interval, Ternary};
use yont::surface::boxes::{Block, Lattice, Visitor, Walk, walk};
use yont::surface::brick::Bricks;
use yont::surface::check::{Fault, Topology};
use yont::surface::grid::BYTES_PER_VERTEX;
use yont::surface::marching::extract_bare;
use yont::surface::mesh::{cross, dot, minus};
use yont::surface::sampler::{Sampler, span};
use yont::surface::{Extraction, Grid, GridError, Mesh, SurfaceError, check, extract};
use yont::vm::{Demand, Points, Program, Shape};

use crate::solids::{Ex, Field, HARD, KNOWN, ball, block, shape_of, sphere};

fn verify(name: &str, extraction: &Extraction) -> Topology {
    let topology = check(&extraction.mesh).unwrap_or_else(|fault| panic!("{name}: {fault}"));
    for n in &extraction.mesh.normals {
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        assert!((length - 1.0).abs() < 1e-9, "{name}: a normal of length {length}");
    }
    topology
}

#[test]
fn every_mesh_is_closed_oriented_and_two_manifold() {
    for case in KNOWN.iter().chain(HARD) {
        for resolution in [1, 2, 3, 7, 8, 9, 16, 33, 40] {
            verify(&format!("{} at {resolution}", case.name), &case.extract(resolution));
        }
    }
}

#[test]
fn euler_characteristics_are_right() {
    for case in KNOWN.iter().chain(HARD).filter(|case| case.euler.is_some()) {
        let topology = verify(case.name, &case.extract(40));
        assert_eq!(Some(topology.euler), case.euler, "{}", case.name);
    }
}

/// Whole numbers that look random.
fn noise(seed: u64) -> impl FnMut(u64) -> u64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1;
    move |below| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % below
    }
}

/// Spheres and boxes, some with common faces and with faces on sample points, joined at random.
fn random_solid(seed: u64, x: &Ex, y: &Ex, z: &Ex) -> Ex {
    let mut pick = noise(seed);
    let mut whole = sphere([0.0; 3], 0.7, [x, y, z]);
    for _ in 0..8 {
        let at: [f64; 3] = std::array::from_fn(|_| pick(9) as f64 * 0.25 - 1.0);
        let size = pick(3) as f64 * 0.25 + 0.25;
        let part = match pick(2) {
            0 => sphere(at, size, [x, y, z]),
            _ => block([size; 3], x.clone() - at[0], y.clone() - at[1], z.clone() - at[2]),
        };
        whole = match pick(5) {
            0 => whole.ternary(Ternary::Intersection, &-part, 1.0),
            1 => whole.ternary(Ternary::Union, &part, 0.0),
            2 => whole.max(&part),
            3 => whole.min(&-part),
            _ => whole.ternary(Ternary::Union, &part, 1.0),
        };
    }
    whole
}

#[test]
fn random_solids_with_common_faces_are_closed_and_have_the_signs_of_dense_sampling() {
    for seed in 0..40 {
        let field = |x: Ex, y: Ex, z: Ex| random_solid(seed, &x, &y, &z);
        let grid = Grid::new(&[[-1.0, 1.0]; 3], 24).expect("a grid");
        let signs = shape_of(field, 3, Demand::Sign);
        let extraction = extract(&signs, &grid, &Limits::default(), &Interrupt::default()).expect("a mesh");
        verify(&format!("solid {seed}"), &extraction);
        compare_signs(&format!("solid {seed}"), &signs, &shape_of(field, 3, Demand::Value), &grid);
    }
}

#[test]
fn signs_are_those_of_dense_sampling() {
    for case in KNOWN.iter().chain(HARD) {
        compare_signs(case.name, &case.shape(), &shape_of(case.field, 3, Demand::Value), &case.grid(27));
    }
}

/// Every sample point of the hierarchy against a plain loop over the whole grid with the values' program.
pub fn compare_signs(name: &str, signs: &Shape, values: &Shape, grid: &Grid) {
    let bricks = Bricks::survey(signs, grid, &Limits::default(), &Interrupt::default()).expect("few vertices");
    let [nx, ny, nz] = grid.counts();
    let mut points = Points::<f64>::new();
    let xs: Vec<f64> = (0..nx).map(|i| grid.coordinate(0, i)).collect();
    let mut out = vec![0.0; nx];
    for k in 0..nz {
        for j in 0..ny {
            let (ys, zs) = (vec![grid.coordinate(1, j); nx], vec![grid.coordinate(2, k); nx]);
            points.eval(&values.program, &[&xs, &ys, &zs], &mut out);
            for (i, &value) in out.iter().enumerate() {
                assert_eq!(bricks.is_inside([i, j, k]), value >= 0.0, "{name} at {:?}: {value}", [i, j, k]);
            }
        }
    }
}

fn stl_bytes(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    stl::write(&Part::of("a", mesh), &mut bytes).expect("writing to memory");
    bytes
}

#[test]
fn the_number_of_threads_does_not_change_a_byte() {
    for case in KNOWN.iter().chain(HARD) {
        let of = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let Extraction { mesh, report, .. } = pool.install(|| case.extract(40));
            let mut text = Vec::new();
            obj::write(&[Part::of("a", &mesh)], &mut text).expect("writing to memory");
            (stl_bytes(&mesh), text, report)
        };
        let one = of(1);
        for threads in [2, 8] {
            assert!(of(threads) == one, "{} with {threads} threads", case.name);
        }
    }
}

#[test]
fn stl_reads_back_as_the_same_closed_mesh() {
    for case in KNOWN.iter().chain(HARD) {
        let mesh = case.extract(32).mesh;
        let bytes = stl_bytes(&mesh);
        assert_eq!(bytes.len(), 84 + 50 * mesh.triangles.len());
        let read = stl_io::read_stl(&mut Cursor::new(bytes)).expect("a readable file");
        let again = Mesh {
            positions: read.vertices.iter().map(|v| [v[0], v[1], v[2]].map(f64::from)).collect(),
            normals: vec![[0.0, 0.0, 1.0]; read.vertices.len()],
            triangles: read.faces.iter().map(|f| f.vertices.map(|v| v as u32)).collect(),
        };
        let (ours, theirs) =
            (check(&mesh).expect("closed"), check(&again).unwrap_or_else(|f| panic!("{}: {f}", case.name)));
        assert_eq!(ours, theirs, "{}", case.name);
    }
}

#[test]
fn obj_and_ply_hold_the_whole_mesh() {
    let mesh = KNOWN[0].extract(12).mesh;
    let (mut text, mut binary) = (Vec::new(), Vec::new());
    obj::write(&[Part::of("a", &mesh)], &mut text).expect("writing to memory");
    ply::write(&Part::of("a", &mesh), &mut binary).expect("writing to memory");
    let text = String::from_utf8(text).expect("text");
    let read: Vec<[f64; 3]> = text
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .map(|line| {
            let numbers: Vec<f64> = line.split(' ').map(|c| c.parse().expect("a number")).collect();
            [numbers[0], numbers[1], numbers[2]]
        })
        .collect();
    assert_eq!(read, mesh.positions, "digits that read back the same");
    assert_eq!(text.lines().filter(|line| line.starts_with("f ")).count(), mesh.triangles.len());
    let end = b"end_header\n";
    let header = binary.windows(end.len()).position(|w| w == end).expect("a header") + end.len();
    assert_eq!(binary.len(), header + 24 * mesh.positions.len() + 13 * mesh.triangles.len());
}

#[test]
fn the_report_says_which_faces_cut() {
    let cut = |field: Field| {
        let shape = shape_of(field, 3, Demand::Sign);
        let grid = Grid::new(&[[-1.0, 1.0]; 3], 16).expect("a grid");
        extract(&shape, &grid, &Limits::default(), &Interrupt::default()).expect("a mesh").report.cut
    };
    let none = [[false; 2]; 3];
    assert_eq!(cut(ball), none, "a ball that touches the faces is not cut");
    assert_eq!(cut(|x, y, z| block([1.0; 3], x, y, z)), none, "a box that fills the space is not cut");
    assert_eq!(cut(|x, y, z| ball(x - 0.5, y, z)), [[false, true], [false; 2], [false; 2]]);
    assert_eq!(cut(|x, _, _| 0.25 - x.abs()), [[false; 2], [true; 2], [true; 2]]);
}

#[test]
fn undefined_points_are_counted_and_one_is_named() {
    let shape = shape_of(|x, y, z| x.sqrt() + ball(x, y, z), 3, Demand::Sign);
    let grid = Grid::new(&[[-1.0, 1.0]; 3], 16).expect("a grid");
    let report = extract(&shape, &grid, &Limits::default(), &Interrupt::default()).expect("a mesh").report;
    assert!(report.counters.undefined > 0);
    let example = report.counters.example.expect("an undefined point");
    assert!(example.len() == 3 && example[0] < 0.0, "{example:?}");
}

#[test]
fn what_cannot_be_meshed_is_refused() {
    let none = Grid::new(&[[0.0, 0.0], [0.0, 1.0], [0.0, 1.0]], 8);
    assert_eq!(none, Err(GridError::Bounds(0)));
    assert_eq!(Grid::new(&[[0.0, 1.0], [0.0, f64::INFINITY], [0.0, 1.0]], 8), Err(GridError::Bounds(1)));
    assert_eq!(Grid::new(&[[0.0, 1.0], [0.0, 1.0], [0.0, f64::NAN]], 8), Err(GridError::Bounds(2)));
    assert_eq!(Grid::new(&[[0.0, 1e-320], [0.0, 1e-320], [0.0, 1e-320]], 8), Err(GridError::TooFine(0)));
    assert_eq!(Grid::new(&[[0.0, 1.0], [1e15, 1e15 + 1.0], [0.0, 1.0]], 8), Err(GridError::TooFine(1)));
    assert_eq!(Grid::new(&[[-1e308, 1e308]; 3], 8), Err(GridError::Bounds(0)));
    assert_eq!(Grid::new(&[[0.0, 1.0]; 3], 0), Err(GridError::Resolution(0)));
    assert_eq!(Grid::new(&[[0.0, 1.0]; 4], 8), Err(GridError::Dimension(4)));
    let (plane, space) = (Grid::new(&[[-1.0, 1.0]; 2], 8).expect("2-D"), Grid::new(&[[-1.0, 1.0]; 3], 8).expect("3-D"));
    let interrupt = Interrupt::default();
    assert_eq!(
        extract(&KNOWN[0].shape(), &plane, &Limits::default(), &interrupt).err(),
        Some(SurfaceError::Dimension(3, 3))
    );
    interrupt.cancel();
    assert_eq!(extract(&KNOWN[0].shape(), &space, &Limits::default(), &interrupt).err(), Some(SurfaceError::Cancelled));
}

#[test]
fn a_mesh_that_takes_too_much_memory_is_refused() {
    let case = HARD.iter().find(|case| case.name == "gyroid cut by the space").expect("the gyroid");
    let (shape, grid) = (case.shape(), case.grid(48));
    let vertices = case.extract(48).mesh.positions.len();
    let within = |memory_bytes| {
        extract(&shape, &grid, &Limits { memory_bytes, ..Limits::default() }, &Interrupt::default()).map(|_| ())
    };
    let enough = vertices * BYTES_PER_VERTEX;
    assert!(enough as u64 > grid.estimated_bytes(), "the mesh is larger than the estimate");
    assert_eq!(within(enough), Ok(()));
    assert_eq!(within(enough - 1), Err(SurfaceError::Memory(enough - 1)), "known after the caps");
    assert_eq!(within(enough * 3 / 4), Err(SurfaceError::Memory(enough * 3 / 4)), "known while it is sampled");
    let estimate = grid.estimated_bytes() as usize;
    assert_eq!(within(estimate - 1), Err(SurfaceError::Memory(estimate - 1)), "known before it begins");
}

#[test]
fn what_single_precision_cannot_hold_is_a_fault_and_never_a_panic() {
    let mesh_at = |at: f64, size: f64| {
        let shape = shape_of(|x, y, z| sphere([at; 3], 0.7 * size, [&x, &y, &z]), 3, Demand::Sign);
        let grid = Grid::new(&[[at - size, at + size]; 3], 20).expect("a grid");
        extract(&shape, &grid, &Limits::default(), &Interrupt::default()).expect("a mesh").mesh
    };
    assert!(matches!(check(&mesh_at(1e7, 1.0)), Err(Fault::Coincident(..))));
    assert!(matches!(check(&mesh_at(0.0, 1e60)), Err(Fault::NotFinite(_))));
    assert!(matches!(check(&mesh_at(0.0, 1e-44)), Err(Fault::Coincident(..))));
    for (at, size) in [(0.0, 1e-30), (0.0, 1e30), (1000.0, 1.0), (-5e4, 10.0)] {
        assert_eq!(check(&mesh_at(at, size)).map(|t| t.euler), Ok(2), "a ball of size {size} at {at}");
    }
}

#[test]
fn normals_point_out_of_the_solid() {
    for case in KNOWN {
        let mesh = case.extract(40).mesh;
        // At a sharp edge a sliver may stand against the normals of the faces that it joins; by area they are nothing.
        let (mut against, mut whole) = (0.0, 0.0);
        for &triangle in &mesh.triangles {
            let [a, b, c] = mesh.corners(triangle);
            let face = cross(minus(b, a), minus(c, a));
            let area = dot(face, face).sqrt();
            whole += area;
            if triangle.iter().map(|&v| dot(face, mesh.normals[v as usize])).sum::<f64>() < -1e-3 * area {
                against += area;
            }
        }
        assert!(against < 1e-3 * whole, "{}: {against} of {whole} against the normals", case.name);
    }
    let mesh = KNOWN[0].extract(40).mesh;
    for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
        assert!(dot(*p, *n) > 1.0 - 1e-6, "of a unit ball the normal is the position: {p:?}, {n:?}");
    }
}

#[test]
fn vertices_lie_on_the_boundary() {
    for case in KNOWN {
        let Extraction { mesh, report, .. } = case.extract(33);
        let grid = case.grid(33);
        let on_face = |p: &[f64; 3]| (0..3).any(|d| p[d] == grid.lo[d] || p[d] == grid.hi[d]);
        let values = shape_of(case.field, 3, Demand::Value);
        let mut points = Points::<f64>::new();
        // A step along each axis by the margin that keeps vertices off sample points must find another sign, unless the space cuts there.
        let near = 2e-4 * grid.cell().iter().fold(0.0_f64, |a, &b| a.max(b));
        for p in mesh.positions.iter().filter(|p| !on_face(p)) {
            let around: Vec<[f64; 3]> = (0..6)
                .map(|i| {
                    let mut q = *p;
                    q[i / 2] += if i % 2 == 0 { near } else { -near };
                    q
                })
                .collect();
            let columns: [Vec<f64>; 3] = std::array::from_fn(|d| around.iter().map(|q| q[d]).collect());
            let mut out = vec![0.0; around.len()];
            points.eval(&values.program, &[&columns[0], &columns[1], &columns[2]], &mut out);
            let inside = out.iter().filter(|&&v| v >= 0.0).count();
            assert!((1..6).contains(&inside), "{}: {p:?} is not on the boundary: {out:?}", case.name);
        }
        assert!(report.counters.points > 0 && report.counters.boxes > 0);
    }
}

#[test]
fn vertices_are_where_the_sign_changes_along_their_edges() {
    let mut checked = 0;
    for case in KNOWN {
        let (mesh, grid) = (case.extract(33).mesh, case.grid(33));
        let values = shape_of(case.field, 3, Demand::Value);
        let (mut found, mut all) = (0, 0);
        for p in &mesh.positions {
            let cell = grid.cell();
            let place: [f64; 3] = std::array::from_fn(|d| (p[d] - grid.lo[d]) / cell[d]);
            let off = |d: &usize| (place[*d] - place[*d].round()).abs() > 1e-5;
            // Vertices that are kept off the ends of their edges, and those of caps, have no such axis.
            let Some(axis) = (0..3).find(off) else { continue };
            let columns: [Vec<f64>; 3] = std::array::from_fn(|d| {
                let step = if d == axis { 1e-7 * cell[d] } else { 0.0 };
                vec![p[d] - step, p[d] + step]
            });
            let mut out = [0.0; 2];
            Points::<f64>::new().eval(&values.program, &[&columns[0], &columns[1], &columns[2]], &mut out);
            found += usize::from((out[0] >= 0.0) != (out[1] >= 0.0));
            all += 1;
        }
        assert!(found * 1000 >= all * 999, "{}: {found} of {all}", case.name);
        checked += all;
    }
    assert!(checked > 1000, "{checked}");
}

#[test]
fn a_mesh_without_normals_is_otherwise_the_same() {
    for case in KNOWN.iter().chain(HARD) {
        let grid = case.grid(21);
        let bare = extract_bare(&case.shape(), &grid, &Limits::default(), &Interrupt::default()).expect("a mesh").mesh;
        let mesh = case.extract(21).mesh;
        assert!(bare.normals.is_empty() && mesh.normals.len() == mesh.positions.len(), "{}", case.name);
        assert!(bare.positions == mesh.positions && bare.triangles == mesh.triangles, "{}", case.name);
    }
}

#[test]
fn a_file_that_is_written_in_pieces_has_each_triangle_in_its_place() {
    let mesh = KNOWN[0].extract(60).mesh;
    let whole = stl_bytes(&mesh);
    assert!(mesh.triangles.len() > 3 * 4096, "more than some pieces");
    for (n, &triangle) in mesh.triangles.iter().enumerate() {
        let one = Mesh { positions: mesh.corners(triangle).to_vec(), triangles: vec![[0, 1, 2]], ..Mesh::default() };
        let from = 84 + 50 * n;
        assert_eq!(stl_bytes(&one)[84..], whole[from..from + 50], "triangle {n}");
    }
}

/// A lattice of unit steps that reaches from -counts/2 to counts/2, and a visitor that keeps what it sees.
struct Steps {
    counts: [usize; 3],
    leaf: [usize; 3],
    task: [usize; 3],
}

impl Lattice for Steps {
    fn counts(&self) -> [usize; 3] {
        self.counts
    }
    fn leaf(&self) -> [usize; 3] {
        self.leaf
    }
    fn task(&self) -> [usize; 3] {
        self.task
    }
    fn bounds(&self, block: &Block, out: &mut [Interval]) {
        for (d, bounds) in out.iter_mut().enumerate() {
            let at = |i: usize| i as f64 - self.counts[d] as f64 / 2.0;
            *bounds = span(at(block.from[d]), at(block.to[d] - 1));
        }
    }
}

#[derive(Default, PartialEq, Debug)]
struct Seen(Vec<(Block, Option<bool>)>, usize);

impl Visitor for Seen {
    fn uniform(&mut self, block: &Block, inside: bool) {
        self.0.push((*block, Some(inside)));
    }
    fn leaf(&mut self, block: &Block, program: &Program, _: &mut Sampler) {
        self.0.push((*block, None));
        self.1 += program.len();
    }
}

#[test]
fn a_walk_covers_each_point_once_in_order_for_any_number_of_threads() {
    let shape = shape_of(|x, y, z| 400.0 - (x.squared() + y.squared() + z.squared()), 3, Demand::Sign);
    let lattices = [
        Steps { counts: [65, 40, 33], leaf: [8; 3], task: [32; 3] },
        Steps { counts: [70, 50, 100], leaf: [4, 4, 8], task: [16, 16, 100] },
        Steps { counts: [5, 5, 5], leaf: [8; 3], task: [32; 3] },
        Steps { counts: [129, 1, 1], leaf: [2, 1, 1], task: [8, 1, 1] },
    ];
    for lattice in lattices {
        let of = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| walk(&lattice, &shape, |_| Seen::default(), &Interrupt::default())).expect("not cancelled")
        };
        let Walk { visitors, counters } = of(1);
        let other = of(8);
        assert_eq!((&visitors, &counters), (&other.visitors, &other.counters));
        let mut seen = vec![0; lattice.counts.iter().product()];
        for Seen(blocks, _) in &visitors {
            for (block, _) in blocks {
                for k in block.from[2]..block.to[2] {
                    for j in block.from[1]..block.to[1] {
                        let row = lattice.counts[0] * (j + lattice.counts[1] * k);
                        seen[row + block.from[0]..row + block.to[0]].iter_mut().for_each(|n| *n += 1);
                    }
                }
            }
            for pair in blocks.windows(2) {
                let is_shared =
                    (0..2).all(|d| pair[0].0.from[d] < pair[1].0.to[d] && pair[1].0.from[d] < pair[0].0.to[d]);
                assert!(!is_shared || pair[0].0.to[2] <= pair[1].0.from[2], "front to back: {pair:?}");
            }
        }
        assert!(seen.iter().all(|&n| n == 1), "each point once");
    }
}

#[test]
fn a_visitor_that_wants_nothing_is_left_alone() {
    struct Idle;
    impl Visitor for Idle {
        fn wants(&mut self, _: &Block) -> bool {
            false
        }
        fn uniform(&mut self, _: &Block, _: bool) {}
        fn leaf(&mut self, block: &Block, _: &Program, _: &mut Sampler) {
            panic!("{block:?} was visited");
        }
    }
    let grid = KNOWN[0].grid(100);
    let interrupt = Interrupt::default();
    let done = walk(&grid, &KNOWN[0].shape(), |_| Idle, &interrupt).expect("not cancelled");
    assert_eq!(done.counters.points, 0);
    assert_eq!(interrupt.progress(), (101 * 101 * 101, 101 * 101 * 101));
}

#[test]
fn programs_get_shorter_on_the_way_down() {
    let field = |x: Ex, y: Ex, z: Ex| {
        let mut all = x.constant(-1.0);
        for i in 0..200 {
            let at = [0, 1, 2].map(|d| f64::from((i * [7, 11, 13][d]) % 41) / 20.0 - 1.0);
            all = all.ternary(Ternary::Union, &sphere(at, 0.1, [&x, &y, &z]), 0.0);
        }
        all
    };
    let shape = shape_of(field, 3, Demand::Sign);
    let grid = Grid::new(&[[-1.2, 1.2]; 3], 128).expect("a grid");
    let done = walk(&grid, &shape, |_| Seen::default(), &Interrupt::default()).expect("not cancelled");
    let leaves = done.visitors.iter().flat_map(|v| &v.0).filter(|(_, decided)| decided.is_none()).count();
    let operations: usize = done.visitors.iter().map(|v| v.1).sum();
    let (mean, whole) = (operations / leaves, shape.program.len());
    assert!(mean * 20 < whole, "{mean} operations in a leaf of {whole}");
}

#[test]
fn work_that_has_begun_can_be_stopped() {
    let interrupt = Interrupt::default();
    let work = {
        let interrupt = interrupt.clone();
        std::thread::spawn(move || {
            let case = &KNOWN[0];
            extract(&case.shape(), &case.grid(1800), &Limits::default(), &interrupt).err()
        })
    };
    while interrupt.progress().0 == 0 {
        std::thread::yield_now();
    }
    interrupt.cancel();
    assert_eq!(work.join().expect("no panic"), Some(SurfaceError::Cancelled));
}

#[test]
fn progress_reaches_its_end() {
    let interrupt = Interrupt::default();
    extract(&KNOWN[0].shape(), &KNOWN[0].grid(40), &Limits::default(), &interrupt).expect("a mesh");
    let (done, total) = interrupt.progress();
    assert_eq!((done, total), (41 * 41 * 41, 41 * 41 * 41));
}

/// A tetrahedron.
fn tetrahedron() -> Mesh {
    Mesh {
        positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        normals: vec![[0.0, 0.0, 1.0]; 4],
        triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    }
}

#[test]
fn the_checker_finds_every_kind_of_fault() {
    let good = check(&tetrahedron()).expect("closed");
    assert_eq!((good.euler, good.components, good.genus, good.edges), (2, 1, 0, 6));
    let fault = |change: &dyn Fn(&mut Mesh)| {
        let mut mesh = tetrahedron();
        change(&mut mesh);
        check(&mesh).expect_err("a fault")
    };
    assert!(matches!(fault(&|m| m.positions[2][1] = f64::NAN), Fault::NotFinite(2)));
    assert!(matches!(fault(&|m| m.positions[2][1] = 1e39), Fault::NotFinite(2)));
    assert!(matches!(fault(&|m| m.triangles[1][0] = 9), Fault::NoSuchVertex(1)));
    assert!(matches!(fault(&|m| m.triangles[1][0] = 1), Fault::Degenerate(1, _)));
    assert!(matches!(fault(&|m| m.positions[1] = [1e-60, 0.0, 0.0]), Fault::Coincident(0, 1, _)));
    assert!(matches!(fault(&|m| m.triangles[3] = [0, 2, 3]), Fault::Repeated(..)));
    assert!(matches!(fault(&|m| m.triangles.truncate(3)), Fault::Open(..)));
    let two = |m: &mut Mesh| {
        m.positions.extend([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
        m.triangles.extend([[0, 4, 5], [0, 6, 4], [4, 6, 5], [5, 6, 0]]);
    };
    assert!(matches!(fault(&two), Fault::Fans(_)), "two tetrahedra that share a vertex");
}

/// Two fans of many triangles, one above the other, about a ring.
fn spindle(count: u32) -> Mesh {
    let turn = |k: u32| f64::from(k) / f64::from(count) * std::f64::consts::TAU;
    let ring = (0..count).map(|k| [turn(k).cos(), turn(k).sin(), 0.0]);
    let next = |k: u32| 2 + (k + 1) % count;
    Mesh {
        positions: [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]].into_iter().chain(ring).collect(),
        normals: Vec::new(),
        triangles: (0..count).flat_map(|k| [[0, 2 + k, next(k)], [1, next(k), 2 + k]]).collect(),
    }
}

#[test]
fn vertices_with_many_triangles_are_checked_too() {
    for count in [3, 31, 32, 33, 1000] {
        let topology = check(&spindle(count)).expect("closed");
        assert_eq!((topology.euler, topology.components), (2, 1), "{count}");
        let mut open = spindle(count);
        open.triangles.pop();
        assert!(matches!(check(&open), Err(Fault::Open(..))), "{count}");
        let mut twice = spindle(count);
        twice.triangles.push(twice.triangles[0]);
        assert!(matches!(check(&twice), Err(Fault::Repeated(..))), "{count}");
    }
}
