//! Meshes: closed, oriented and 2-manifold for every shape, with the signs of dense sampling, the same bytes for any number of threads.

use std::cell::RefCell;
use std::io::Cursor;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use yont::export::{obj, ply, stl};
use yont::field::{Coordinate, Graph, NodeId};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::{Algebra, Binary, Ternary, Unary};
use yont::surface::boxes::Lattice;
use yont::surface::brick::Bricks;
use yont::surface::check::{Fault, Topology};
use yont::surface::{Extraction, Grid, GridError, Mesh, SurfaceError, check, extract};
use yont::vm::{Demand, Points, Program, Shape};

/// An expression that is written as one.
#[derive(Clone)]
pub struct Ex(Rc<RefCell<Graph>>, NodeId);

impl Ex {
    pub fn constant(&self, value: f64) -> Self {
        let id = self.0.borrow_mut().constant(value);
        Self(Rc::clone(&self.0), id)
    }
    pub fn unary(&self, op: Unary) -> Self {
        let id = self.0.borrow_mut().unary(op, self.1);
        Self(Rc::clone(&self.0), id)
    }
    pub fn binary(&self, op: Binary, other: &Self) -> Self {
        let id = self.0.borrow_mut().binary(op, self.1, other.1);
        Self(Rc::clone(&self.0), id)
    }
    pub fn ternary(&self, op: Ternary, b: &Self, c: f64) -> Self {
        let c = self.constant(c);
        let id = self.0.borrow_mut().ternary(op, self.1, b.1, c.1);
        Self(Rc::clone(&self.0), id)
    }
    pub fn select(&self, then: &Self, otherwise: &Self) -> Self {
        let id = self.0.borrow_mut().ternary(Ternary::Select, self.1, then.1, otherwise.1);
        Self(Rc::clone(&self.0), id)
    }
    pub fn squared(&self) -> Self {
        self.clone() * self.clone()
    }
    pub fn abs(&self) -> Self {
        self.unary(Unary::Abs)
    }
    pub fn sqrt(&self) -> Self {
        self.unary(Unary::Sqrt)
    }
    pub fn sin(&self) -> Self {
        self.unary(Unary::Sin)
    }
    pub fn cos(&self) -> Self {
        self.unary(Unary::Cos)
    }
    pub fn min(&self, other: &Self) -> Self {
        self.binary(Binary::Min, other)
    }
    pub fn max(&self, other: &Self) -> Self {
        self.binary(Binary::Max, other)
    }
}

macro_rules! operators {
    ($($of:ident $name:ident),*) => {$(
        impl $of for Ex {
            type Output = Ex;
            fn $name(self, other: Ex) -> Ex {
                self.binary(Binary::$of, &other)
            }
        }
        impl $of<f64> for Ex {
            type Output = Ex;
            fn $name(self, other: f64) -> Ex {
                self.binary(Binary::$of, &self.constant(other))
            }
        }
        impl $of<Ex> for f64 {
            type Output = Ex;
            fn $name(self, other: Ex) -> Ex {
                other.constant(self).binary(Binary::$of, &other)
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Ex {
    type Output = Ex;
    fn neg(self) -> Ex {
        self.unary(Unary::Neg)
    }
}

/// A defining function of x, y, z.
pub type Field = fn(Ex, Ex, Ex) -> Ex;

/// The shape of a function of the first `dimension` coordinates.
pub fn shape_of(field: impl Fn(Ex, Ex, Ex) -> Ex, dimension: u8, demand: Demand) -> Shape {
    let graph = Rc::new(RefCell::new(Graph::new()));
    let [x, y, z] = [1, 2, 3].map(|c| {
        let id = graph.borrow_mut().coordinate(Coordinate(c));
        Ex(Rc::clone(&graph), id)
    });
    let root = field(x, y, z).1;
    let inputs: Vec<Coordinate> = (1..=dimension).map(Coordinate).collect();
    let program = Program::compile(&graph.borrow(), root, &inputs, demand, &Limits::default()).expect("compiles");
    Shape::new(program, usize::from(dimension), Vec::new())
}

/// A test solid.
pub struct Case {
    pub name: &'static str,
    pub half: [f64; 3],
    pub field: Field,
    pub euler: Option<i64>,
    pub volume: Option<f64>,
}

impl Case {
    pub fn shape(&self) -> Shape {
        shape_of(self.field, 3, Demand::Sign)
    }
    pub fn grid(&self, resolution: usize) -> Grid {
        Grid::new(&self.half.map(|h| [-h, h]), resolution).expect("a space with extent")
    }
    pub fn extract(&self, resolution: usize) -> Extraction {
        extract(&self.shape(), &self.grid(resolution), &Interrupt::default()).expect("a mesh")
    }
}

const PI: f64 = std::f64::consts::PI;

pub fn ball(x: Ex, y: Ex, z: Ex) -> Ex {
    1.0 - (x.squared() + y.squared() + z.squared())
}

fn sphere(at: [f64; 3], r: f64, [x, y, z]: [&Ex; 3]) -> Ex {
    let d = |e: &Ex, c: f64| (e.clone() - c).squared();
    r * r - (d(x, at[0]) + d(y, at[1]) + d(z, at[2]))
}

fn block(half: [f64; 3], x: Ex, y: Ex, z: Ex) -> Ex {
    (half[0] - x.abs()).min(&(half[1] - y.abs())).min(&(half[2] - z.abs()))
}

fn gyroid(x: &Ex, y: &Ex, z: &Ex) -> Ex {
    x.sin() * y.cos() + y.sin() * z.cos() + z.sin() * x.cos()
}

/// Solids with a known volume and Euler characteristic.
pub const KNOWN: &[Case] = &[
    Case { name: "ball", half: [1.3; 3], field: ball, euler: Some(2), volume: Some(4.0 / 3.0 * PI) },
    Case {
        name: "box",
        half: [1.0; 3],
        field: |x, y, z| block([0.81, 0.62, 0.53], x, y, z),
        euler: Some(2),
        volume: Some(8.0 * 0.81 * 0.62 * 0.53),
    },
    Case {
        name: "box with its faces on sample points",
        half: [1.0; 3],
        field: |x, y, z| block([0.5, 0.25, 0.75], x, y, z),
        euler: Some(2),
        volume: Some(0.75),
    },
    Case {
        name: "torus",
        half: [1.2, 1.2, 0.4],
        field: |x, y, z| 0.09 - ((x.squared() + y.squared()).sqrt() - 0.8).squared() - z.squared(),
        euler: Some(0),
        volume: Some(2.0 * PI * PI * 0.8 * 0.09),
    },
    Case {
        name: "ellipsoid",
        half: [1.1, 0.9, 0.7],
        field: |x, y, z| 1.0 - (x.squared() + (y / 0.8).squared() + (z / 0.6).squared()),
        euler: Some(2),
        volume: Some(4.0 / 3.0 * PI * 0.8 * 0.6),
    },
    Case {
        name: "Steinmetz solid",
        half: [1.1; 3],
        field: |x, y, z| {
            (1.0 - (x.squared() + y.squared())).ternary(
                Ternary::Intersection,
                &(1.0 - (x.squared() + z.squared())),
                1.0,
            )
        },
        euler: Some(2),
        volume: Some(16.0 / 3.0),
    },
    Case {
        name: "capped cylinder",
        half: [1.0; 3],
        field: |x, y, z| {
            (0.49 - (x.squared() + y.squared())).ternary(Ternary::Intersection, &(0.64 - z.squared()), 0.0)
        },
        euler: Some(2),
        volume: Some(PI * 0.49 * 1.6),
    },
    Case {
        name: "twisted bar",
        half: [0.7, 0.7, 1.0],
        field: |x, y, z| {
            let (c, s) = ((z.clone() * 1.5).cos(), (z.clone() * 1.5).sin());
            let u = x.clone() * c.clone() + y.clone() * s.clone();
            let v = y * c - x * s;
            block([0.5, 0.3, 0.9], u, v, z)
        },
        euler: Some(2),
        volume: Some(8.0 * 0.5 * 0.3 * 0.9),
    },
    Case {
        name: "sheared ball",
        half: [1.4, 1.1, 1.1],
        field: |x, y, z| ball(x - z.clone() * 0.5, y, z),
        euler: Some(2),
        volume: Some(4.0 / 3.0 * PI),
    },
    Case {
        name: "the whole space",
        half: [1.0, 0.5, 2.0],
        field: |x, _, _| x.constant(0.0),
        euler: Some(2),
        volume: Some(8.0),
    },
    Case { name: "half of the space", half: [1.0; 3], field: |_, _, z| z, euler: Some(2), volume: Some(4.0) },
    Case {
        name: "ball cut by all six faces",
        half: [0.8; 3],
        field: ball,
        euler: Some(2),
        volume: Some(4.0 / 3.0 * PI - 6.0 * PI * 0.04 * (1.0 - 0.2 / 3.0)),
    },
    Case {
        name: "ball behind a function that is undefined beyond it",
        half: [1.2; 3],
        field: |x, y, z| ball(x, y, z).sqrt(),
        euler: Some(2),
        volume: Some(4.0 / 3.0 * PI),
    },
    Case {
        name: "ball with a step for a boundary",
        half: [1.2; 3],
        field: |x, y, z| {
            let condition = ball(x, y, z);
            let inside = condition.binary(Binary::Less, &condition.constant(0.0));
            inside.select(&condition.constant(-1.0), &condition.constant(0.0))
        },
        euler: Some(2),
        volume: Some(4.0 / 3.0 * PI),
    },
];

/// Hard ones: exact zeros at sample points, sheets, undefined regions, touching parts.
const HARD: &[Case] = &[
    Case {
        name: "quadrants that touch along a line",
        half: [1.0; 3],
        field: |x, y, _| x * y,
        euler: None,
        volume: None,
    },
    Case {
        name: "octants that touch in a point",
        half: [1.0; 3],
        field: |x, y, z| x * y * z,
        euler: None,
        volume: None,
    },
    Case { name: "a sheet without thickness", half: [1.0; 3], field: |x, _, _| -x.abs(), euler: Some(2), volume: None },
    Case {
        name: "a point",
        half: [1.0; 3],
        field: |x, y, z| -(x.squared() + y.squared() + z.squared()),
        euler: Some(2),
        volume: None,
    },
    Case {
        name: "points and lines of the lattice itself",
        half: [4.0; 3],
        field: |x, y, z| {
            let d = |e: Ex| (e * PI).sin().squared();
            1e-20 - (d(x.clone()) + d(y.clone())).min(&(d(y) + d(z)))
        },
        euler: None,
        volume: None,
    },
    Case {
        name: "gyroid in a ball",
        half: [10.0; 3],
        field: |x, y, z| gyroid(&x, &y, &z).min(&sphere([0.0; 3], 9.0, [&x, &y, &z])),
        euler: None,
        volume: None,
    },
    Case {
        name: "gyroid cut by the space",
        half: [7.0; 3],
        field: |x, y, z| gyroid(&x, &y, &z),
        euler: None,
        volume: None,
    },
    Case {
        name: "undefined in half of the space",
        half: [1.0; 3],
        field: |x, y, z| x.sqrt() + ball(x, y, z),
        euler: None,
        volume: None,
    },
    Case {
        name: "with a pole",
        half: [1.0; 3],
        field: |x, y, z| 1.0 / (x - 0.1) + ball(y, z.clone(), z),
        euler: None,
        volume: None,
    },
    Case {
        name: "far from the origin's scale",
        half: [1e-7; 3],
        field: |x, y, z| sphere([2e-9, 1e-9, 0.0], 0.8e-7, [&x, &y, &z]),
        euler: Some(2),
        volume: None,
    },
    Case {
        name: "thinner than a cell",
        half: [1.0; 3],
        field: |x, y, z| 0.013 - (x.squared() + y.squared() + z.squared() - 0.5).abs(),
        euler: None,
        volume: None,
    },
];

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
        let extraction = extract(&signs, &grid, &Interrupt::default()).expect("a mesh");
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
fn compare_signs(name: &str, signs: &Shape, values: &Shape, grid: &Grid) {
    let bricks = Bricks::survey(signs, grid, &Interrupt::default()).expect("not cancelled").expect("few vertices");
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
    stl::write(mesh, &mut bytes).expect("writing to memory");
    bytes
}

#[test]
fn the_number_of_threads_does_not_change_a_byte() {
    for case in KNOWN.iter().chain(HARD) {
        let of = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let Extraction { mesh, report } = pool.install(|| case.extract(40));
            let mut text = Vec::new();
            obj::write(&mesh, &mut text).expect("writing to memory");
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
    obj::write(&mesh, &mut text).expect("writing to memory");
    ply::write(&mesh, &mut binary).expect("writing to memory");
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
        extract(&shape, &grid, &Interrupt::default()).expect("a mesh").report.cut
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
    let report = extract(&shape, &grid, &Interrupt::default()).expect("a mesh").report;
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
    assert_eq!(Grid::new(&[[0.0, 1.0]; 3], 0), Err(GridError::Resolution(0)));
    assert_eq!(Grid::new(&[[0.0, 1.0]; 4], 8), Err(GridError::Dimension(4)));
    let (plane, space) = (Grid::new(&[[-1.0, 1.0]; 2], 8).expect("2-D"), Grid::new(&[[-1.0, 1.0]; 3], 8).expect("3-D"));
    let interrupt = Interrupt::default();
    assert_eq!(extract(&KNOWN[0].shape(), &plane, &interrupt).err(), Some(SurfaceError::Dimension(3, 3)));
    interrupt.cancel();
    assert_eq!(extract(&KNOWN[0].shape(), &space, &interrupt).err(), Some(SurfaceError::Cancelled));
}

#[test]
fn progress_reaches_its_end() {
    let interrupt = Interrupt::default();
    extract(&KNOWN[0].shape(), &KNOWN[0].grid(40), &interrupt).expect("a mesh");
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
    assert!(matches!(fault(&|m| drop(m.triangles.pop())), Fault::Open(..)));
    let two = |m: &mut Mesh| {
        m.positions.extend([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
        m.triangles.extend([[0, 4, 5], [0, 6, 4], [4, 6, 5], [5, 6, 0]]);
    };
    assert!(matches!(fault(&two), Fault::Fans(_)), "two tetrahedra that share a vertex");
}
