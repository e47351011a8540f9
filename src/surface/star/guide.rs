//! Guide shapes: closed surfaces about the origin, of which only the directions of the vertices and the triangles count [A92 4]. Each is
//! checked to be met once by every ray from the origin.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::fmt;

use crate::surface::check::{Fault, check};
use crate::surface::mesh::{Mesh, cross, dot, minus, unit};

/// A solid that can be subdivided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solid {
    /// Four triangles.
    Tetrahedron,
    /// Eight triangles.
    Octahedron,
    /// Six squares.
    Cube,
    /// Twenty triangles.
    Icosahedron,
    /// The icosahedron whose new vertices are moved to the sphere.
    Sphere,
}

/// The subdivisions of a solid at most: each makes four triangles of one.
pub const LEVELS: usize = 11;

/// Directions and triangles that turn counter-clockwise seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Guide {
    /// The directions, of any length but 0.
    pub directions: Vec<[f64; 3]>,
    /// Three of them each.
    pub triangles: Vec<[u32; 3]>,
}

/// Why a surface is no guide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GuideError {
    /// It is not closed, or not a surface.
    Fault(Fault),
    /// A ray from the origin meets it more than once, or it is seen from behind: at the triangle with these corners.
    NotStar([[f64; 3]; 3]),
    /// It goes round the origin so many times.
    Winds(i64),
    /// It has no triangle.
    Empty,
}

impl fmt::Display for GuideError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let at = |[x, y, z]: [f64; 3]| format!("({x:.4}, {y:.4}, {z:.4})");
        match self {
            Self::Fault(fault) => write!(f, "it is not closed: {fault}"),
            Self::NotStar([a, b, c]) => write!(
                f,
                "it is not star-shaped: a ray from its middle meets it more than once at the triangle {}, {}, {}",
                at(*a),
                at(*b),
                at(*c)
            ),
            Self::Winds(turns) => write!(f, "it goes round its middle {turns} times instead of once"),
            Self::Empty => write!(f, "it has no triangle"),
        }
    }
}

impl std::error::Error for GuideError {}

impl Solid {
    /// Its name as an option has it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Tetrahedron => "tetrahedron",
            Self::Octahedron => "octahedron",
            Self::Cube => "cube",
            Self::Icosahedron => "icosahedron",
            Self::Sphere => "sphere",
        }
    }

    /// The solid of that name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        let all = [Self::Tetrahedron, Self::Octahedron, Self::Cube, Self::Icosahedron, Self::Sphere];
        all.into_iter().find(|solid| solid.name() == name)
    }

    /// Vertices after so many subdivisions.
    #[must_use]
    pub fn vertices(self, level: usize) -> usize {
        let triangles = match self {
            Self::Tetrahedron => 4,
            Self::Octahedron => 8,
            Self::Cube => 12,
            Self::Icosahedron | Self::Sphere => 20,
        };
        (triangles << (2 * level.min(24))) / 2 + 2
    }

    /// The guide after so many subdivisions: of each triangle four are made, with the middles of its sides.
    #[must_use]
    pub fn guide(self, level: usize) -> Guide {
        let mut guide = self.base();
        for _ in 0..level {
            guide = guide.refined(self == Self::Sphere);
        }
        guide
    }

    fn base(self) -> Guide {
        let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
        let corners: Vec<[f64; 3]> = match self {
            Self::Tetrahedron => vec![[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]],
            Self::Octahedron => (0..6)
                .map(|k| std::array::from_fn(|d| if d == k / 2 { if k % 2 == 0 { 1.0 } else { -1.0 } } else { 0.0 }))
                .collect(),
            Self::Cube => (0..8).map(|k| std::array::from_fn(|d| if k >> d & 1 == 0 { -1.0 } else { 1.0 })).collect(),
            Self::Icosahedron | Self::Sphere => (0..12)
                .map(|k| {
                    let (axis, a, b) = (k / 4, k & 1, k >> 1 & 1);
                    let signed = |bit: usize, v: f64| if bit == 0 { v } else { -v };
                    let mut corner = [0.0; 3];
                    corner[(axis + 1) % 3] = signed(a, 1.0);
                    corner[(axis + 2) % 3] = signed(b, golden);
                    corner
                })
                .collect(),
        };
        if self == Self::Cube {
            return Guide { directions: corners, triangles: cube() };
        }
        // The sides are the shortest distances between corners; any three corners at that distance are a face.
        let apart = |a: usize, b: usize| {
            let d = minus(corners[a], corners[b]);
            dot(d, d)
        };
        let side = (1..corners.len()).map(|k| apart(0, k)).fold(f64::INFINITY, f64::min) * 1.01;
        let mut triangles = Vec::new();
        for a in 0..corners.len() {
            for b in a + 1..corners.len() {
                for c in b + 1..corners.len() {
                    if apart(a, b) < side && apart(b, c) < side && apart(a, c) < side {
                        let outward = dot(cross(corners[a], corners[b]), corners[c]) > 0.0;
                        triangles.push([a, b, c].map(|k| k as u32));
                        if !outward && let Some(last) = triangles.last_mut() {
                            last.swap(1, 2);
                        }
                    }
                }
            }
        }
        Guide { directions: corners, triangles }
    }
}

/// Two triangles on each face of the cube, whose corners are numbered by the bits of their signs.
fn cube() -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
        let far = 1 << axis;
        triangles.extend([[far, far | u, far | u | v], [far, far | u | v, far | v]]);
        triangles.extend([[0, u | v, u], [0, v, u | v]]);
    }
    triangles
}

impl Guide {
    /// The guide with four triangles for each; `round`: new directions get the length of 1.
    fn refined(&self, round: bool) -> Self {
        let mut directions = self.directions.clone();
        let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut triangles = Vec::with_capacity(4 * self.triangles.len());
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let [p, q] = [a, b].map(|v| directions[v as usize]);
                let [p, q] = if round { [p, q].map(|p| unit(p).unwrap_or(p)) } else { [p, q] };
                let sum: [f64; 3] = std::array::from_fn(|d| p[d] + q[d]);
                directions.push(if round { unit(sum).unwrap_or(sum) } else { sum.map(|c| 0.5 * c) });
                directions.len() as u32 - 1
            })
        };
        for &[a, b, c] in &self.triangles {
            let (d, e, f) = (middle(a, b), middle(b, c), middle(c, a));
            triangles.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]);
        }
        Self { directions, triangles }
    }

    /// A guide of any closed surface of triangles: about the origin, or about the middle of its vertices if it is no star about the origin.
    /// One whose triangles all turn the other way round is turned.
    ///
    /// # Errors
    /// If it is not closed, or not star-shaped.
    pub fn of_mesh(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, GuideError> {
        if triangles.is_empty() {
            return Err(GuideError::Empty);
        }
        let mesh = Mesh { positions: positions.to_vec(), normals: Vec::new(), triangles: triangles.to_vec() };
        check(&mesh).map_err(GuideError::Fault)?;
        let about = |middle: [f64; 3], turned: bool| {
            let directions = positions.iter().map(|p| minus(*p, middle)).collect();
            let turn = |&[a, b, c]: &[u32; 3]| if turned { [a, c, b] } else { [a, b, c] };
            Self { directions, triangles: triangles.iter().map(turn).collect() }
        };
        let count = positions.len() as f64;
        let sum = positions.iter().fold([0.0; 3], |sum, p| std::array::from_fn(|d| sum[d] + p[d]));
        let tried = [[0.0; 3], sum.map(|c| c / count)];
        let mut last = GuideError::Empty;
        for middle in tried {
            let guide = about(middle, false);
            let guide = if guide.volume() < 0.0 { about(middle, true) } else { guide };
            match guide.check() {
                Ok(()) => return Ok(guide),
                // The triangle is told where it stands in the file.
                Err(GuideError::NotStar(corners)) => {
                    let back = |c: [f64; 3]| std::array::from_fn(|d| c[d] + middle[d]);
                    last = GuideError::NotStar(corners.map(back));
                }
                Err(error) => last = error,
            }
        }
        Err(last)
    }

    fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|v| self.directions[v as usize])
    }

    fn volume(&self) -> f64 {
        self.triangles.iter().map(|&t| determinant(self.corners(t))).sum()
    }

    /// Whether every ray from the origin meets it once; it must be closed.
    ///
    /// # Errors
    /// A triangle that is seen from behind, or the number of turns.
    pub fn check(&self) -> Result<(), GuideError> {
        let mut angle = 0.0;
        for &triangle in &self.triangles {
            let corners = self.corners(triangle);
            let sizes = corners.map(|c| dot(c, c).sqrt());
            let flat = 1e-14 * sizes.iter().product::<f64>();
            let volume = determinant(corners);
            if volume.is_nan() || volume <= flat {
                return Err(GuideError::NotStar(corners));
            }
            let [a, b, c] = corners;
            let [x, y, z] = sizes;
            let below = x * y * z + dot(a, b) * z + dot(b, c) * x + dot(a, c) * y;
            angle += 2.0 * libm::atan2(volume, below);
        }
        let turns = (angle / (4.0 * PI)).round();
        if turns == 1.0 { Ok(()) } else { Err(GuideError::Winds(turns as i64)) }
    }
}

/// Six times the volume of the tetrahedron with the origin.
fn determinant([a, b, c]: [[f64; 3]; 3]) -> f64 {
    dot(cross(a, b), c)
}
