//! Test solids, written as expressions: known ones with their volume and Euler characteristic, and hard ones.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::rc::Rc;

use yont::field::{Coordinate, Graph, NodeId};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::{Algebra, Binary, Ternary, Unary};
use yont::surface::{Extraction, Grid, extract};
use yont::vm::{Demand, Program, Shape};

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
        extract(&self.shape(), &self.grid(resolution), &Limits::default(), &Interrupt::default()).expect("a mesh")
    }
}

const PI: f64 = std::f64::consts::PI;

pub fn ball(x: Ex, y: Ex, z: Ex) -> Ex {
    1.0 - (x.squared() + y.squared() + z.squared())
}

pub fn sphere(at: [f64; 3], r: f64, [x, y, z]: [&Ex; 3]) -> Ex {
    let d = |e: &Ex, c: f64| (e.clone() - c).squared();
    r * r - (d(x, at[0]) + d(y, at[1]) + d(z, at[2]))
}

pub fn block(half: [f64; 3], x: Ex, y: Ex, z: Ex) -> Ex {
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
pub const HARD: &[Case] = &[
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
            1e-20 - (d(x) + d(y.clone())).min(&(d(y) + d(z)))
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
        name: "signs at random",
        half: [1.0, 0.9, 0.8],
        field: |x, y, z| ((x * 12.9898 + y * 78.233 + z * 37.719) * 43_758.5).sin(),
        euler: None,
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
