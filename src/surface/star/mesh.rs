//! Meshes and outlines of stars: a guide's directions divided by the gauge. As many evaluations as vertices, with the slope of the gauge
//! as the normal. A guide that follows the shape splits its sides where they are long, or far from the surface.

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::guide::{Guide, Solid};
use super::{Gauge, kept};
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::mesh::{Mesh, dot, minus};
use crate::vm::{Gradients, Points};

/// Directions that are evaluated together.
const BATCH: usize = 2048;
/// Sides stay longer than this share of the length that is asked for.
const SHORTEST: f64 = 0.3;
/// How far a side may lie from the surface, as a share of that length.
const FARTHEST: f64 = 0.025;
/// How far a side that is split reaches across the rays, as a share of that length.
const ACROSS: f64 = 1e-3;
/// Rounds of splitting at most.
const ROUNDS: usize = 40;

/// A star's boundary.
#[derive(Clone, Debug)]
pub struct Made<S> {
    /// The mesh, or the outline.
    pub boundary: S,
    /// Directions in which the gauge was evaluated.
    pub points: u64,
    /// The faces of the space that cut the shape: the lower and the upper one of each axis.
    pub cut: [[bool; 2]; 3],
}

/// Why a star has no mesh.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshError {
    /// The work was stopped.
    Cancelled,
    /// More vertices than the memory holds.
    Memory,
    /// The gauge is not positive in a direction, against its proof: it overflows.
    Direction(Vec<f64>),
}

impl From<Cancelled> for MeshError {
    fn from(_: Cancelled) -> Self {
        Self::Cancelled
    }
}

/// The space that a star is cut by.
#[derive(Clone, Debug, PartialEq)]
pub struct Space {
    /// For each axis the lower and the upper end; the centre lies between them.
    pub ranges: Vec<[f64; 2]>,
}

/// Vertices as they are evaluated.
#[derive(Clone, Debug, Default)]
struct Vertices<const N: usize> {
    positions: Vec<[f64; N]>,
    normals: Vec<[f64; N]>,
    cut: [[bool; 2]; 3],
    points: u64,
}

impl<const N: usize> Vertices<N> {
    /// Evaluates the gauge in some directions and appends the vertices there.
    fn extend(
        &mut self,
        gauge: &Gauge,
        space: &Space,
        directions: &[[f64; N]],
        normals: bool,
        interrupt: &Interrupt,
    ) -> Result<(), MeshError> {
        let start = || (Points::<f64>::new(), Gradients::new());
        let parts: Vec<Self> = directions
            .par_chunks(BATCH)
            .map_init(start, |(points, gradients), chunk| {
                interrupt.tick()?;
                batch(gauge, space, chunk, points, normals.then_some(gradients))
            })
            .collect::<Result<_, MeshError>>()?;
        self.positions.reserve(directions.len());
        self.normals.reserve(if normals { directions.len() } else { 0 });
        for part in parts {
            self.positions.extend_from_slice(&part.positions);
            self.normals.extend_from_slice(&part.normals);
            self.points += part.points;
            for (all, own) in self.cut.iter_mut().flatten().zip(part.cut.iter().flatten()) {
                *all |= *own;
            }
        }
        Ok(())
    }

    /// Puts a vertex into each direction in which the gauge has these values; normals, if there are any, are those of the gauge.
    fn place(
        &mut self,
        gauge: &Gauge,
        space: &Space,
        directions: &[[f64; N]],
        values: &[f64],
    ) -> Result<(), MeshError> {
        self.positions.reserve(directions.len());
        for (k, (v, &value)) in directions.iter().zip(values).enumerate() {
            if !(value > 0.0 && value.is_finite()) {
                return Err(MeshError::Direction(v.to_vec()));
            }
            let mut by = value;
            let (d, side, least) = face(gauge, space, v);
            if least > value * (1.0 + 1e-9) {
                by = least;
                self.cut[d][side] = true;
                if let Some(normal) = self.normals.get_mut(k) {
                    *normal = std::array::from_fn(|e| {
                        if e != d {
                            0.0
                        } else if side == 0 {
                            -1.0
                        } else {
                            1.0
                        }
                    });
                }
            }
            self.positions.push(std::array::from_fn(|d| gauge.centre[d] + v[d] / by));
        }
        Ok(())
    }
}

/// The vertices in some directions, with normals if there is something to take slopes with.
fn batch<const N: usize>(
    gauge: &Gauge,
    space: &Space,
    directions: &[[f64; N]],
    points: &mut Points<f64>,
    gradients: Option<&mut Gradients>,
) -> Result<Vertices<N>, MeshError> {
    let count = directions.len();
    let mut columns: Vec<Vec<f64>> = (0..N).map(|d| directions.iter().map(|v| v[d]).collect()).collect();
    columns.extend(gauge.fixed.iter().map(|&value| vec![value; count]));
    let at: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let by: [usize; N] = std::array::from_fn(|d| d);
    let mut values = vec![0.0; count];
    let mut normals = Vec::new();
    if let Some(gradients) = gradients {
        let mut slopes: [Vec<f64>; N] = std::array::from_fn(|_| vec![0.0; count]);
        gradients.eval(&gauge.gauge, &at, &by, &mut values, &mut slopes.each_mut().map(Vec::as_mut_slice));
        normals.extend((0..count).map(|k| length_one(std::array::from_fn(|d| slopes[d][k]))));
    } else {
        points.eval(&gauge.gauge, &at, &mut values);
    }
    let mut made = Vertices { normals, points: count as u64, ..Vertices::default() };
    made.place(gauge, space, directions, &values)?;
    Ok(made)
}

/// Which of the faces of the space a ray meets, and the gauge of the space there; 0 if it meets none.
#[inline]
fn face<const N: usize>(gauge: &Gauge, space: &Space, v: &[f64; N]) -> (usize, usize, f64) {
    let mut most = (0, 0, 0.0);
    for (d, &along) in v.iter().enumerate() {
        let side = usize::from(along > 0.0);
        let value = along / (space.ranges[d][side] - gauge.centre[d]);
        if value > most.2 && value.is_finite() {
            most = (d, side, value);
        }
    }
    most
}

/// The vector at length 1; 0 if it has none.
fn length_one<const N: usize>(v: [f64; N]) -> [f64; N] {
    let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let scaled = v.map(|c| c / largest);
    let length = scaled.iter().map(|c| c * c).sum::<f64>().sqrt();
    let made = scaled.map(|c| c / length);
    if made.iter().all(|c| c.is_finite()) { made } else { [0.0; N] }
}

/// The mesh over a guide, with normals or without.
///
/// # Errors
/// See [`MeshError`].
pub fn over(
    gauge: &Gauge,
    space: &Space,
    guide: &Guide,
    normals: bool,
    interrupt: &Interrupt,
) -> Result<Made<Mesh>, MeshError> {
    let mut vertices = Vertices::default();
    let kept = if normals { None } else { kept::values(gauge, guide, interrupt)? };
    if let Some(values) = kept {
        vertices.place(gauge, space, &guide.directions, &values)?;
    } else {
        vertices.extend(gauge, space, &guide.directions, normals, interrupt)?;
    }
    Ok(finished(vertices, guide.triangles.clone()))
}

fn finished(vertices: Vertices<3>, triangles: Vec<[u32; 3]>) -> Made<Mesh> {
    let mut mesh = Mesh { positions: vertices.positions, normals: vertices.normals, triangles };
    if !mesh.normals.is_empty() {
        crate::surface::marching::mend_normals(&mut mesh);
    }
    Made { boundary: mesh, points: vertices.points, cut: vertices.cut }
}

/// The mesh that follows the shape: sides are at most `length` long, and shorter where the surface bends. At most `most` vertices.
///
/// # Errors
/// See [`MeshError`].
pub fn following(
    gauge: &Gauge,
    space: &Space,
    length: f64,
    most: usize,
    interrupt: &Interrupt,
) -> Result<Made<Mesh>, MeshError> {
    let Guide { directions, mut triangles } = Solid::Sphere.guide(2);
    let mut vertices = Vertices::default();
    vertices.extend(gauge, space, &directions, true, interrupt)?;
    for _ in 0..ROUNDS {
        interrupt.tick()?;
        let middles = split(gauge, &vertices, &triangles, length);
        if middles.is_empty() {
            break;
        }
        if vertices.positions.len() + middles.len() > most {
            return Err(MeshError::Memory);
        }
        let mut edges: Vec<(u32, u32)> = middles.into_iter().collect();
        edges.par_sort_unstable();
        let centre: [f64; 3] = std::array::from_fn(|d| gauge.centre[d]);
        let middle = |&(a, b): &(u32, u32)| {
            let [p, q] = [a, b].map(|v| minus(vertices.positions[v as usize], centre));
            std::array::from_fn(|d| 0.5 * (p[d] + q[d]))
        };
        let directions: Vec<[f64; 3]> = edges.iter().map(middle).collect();
        let first = vertices.positions.len() as u32;
        let numbers: FxHashMap<(u32, u32), u32> = edges.iter().copied().zip(first..).collect();
        vertices.extend(gauge, space, &directions, true, interrupt)?;
        triangles = divided(&vertices, &triangles, &numbers);
    }
    Ok(finished(vertices, triangles))
}

fn edge(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// The sides to be split: those that are too long or too far from the surface, and where a side of a triangle is split also its longest one:
/// else triangles would become ever thinner where the surface bends one way alone, or stands up like a cliff.
fn split(
    gauge: &Gauge,
    vertices: &Vertices<3>,
    triangles: &[[u32; 3]],
    length: f64,
) -> rustc_hash::FxHashSet<(u32, u32)> {
    let wrong = |a: u32, b: u32| {
        let [a, b] = [a as usize, b as usize];
        let ends = [a, b];
        too_coarse(&gauge.centre, ends.map(|v| vertices.positions[v]), ends.map(|v| vertices.normals[v]), length)
    };
    let mut marked: rustc_hash::FxHashSet<(u32, u32)> = triangles
        .par_iter()
        .flat_map_iter(|&[a, b, c]| [(a, b), (b, c), (c, a)].into_iter().filter(|&(a, b)| a < b && wrong(a, b)))
        .collect::<Vec<_>>()
        .into_iter()
        .collect();
    let square = |(a, b): (u32, u32)| {
        let side = minus(vertices.positions[a as usize], vertices.positions[b as usize]);
        dot(side, side)
    };
    loop {
        let open: Vec<(u32, u32)> = triangles
            .par_iter()
            .filter_map(|&[a, b, c]| {
                let sides = [edge(a, b), edge(b, c), edge(c, a)];
                let longest = |one: (u32, u32), other: (u32, u32)| {
                    if (square(one), one) < (square(other), other) { other } else { one }
                };
                let longest = longest(longest(sides[0], sides[1]), sides[2]);
                (sides.iter().any(|side| marked.contains(side)) && !marked.contains(&longest)).then_some(longest)
            })
            .collect();
        if open.is_empty() {
            return marked;
        }
        marked.extend(open);
    }
}

/// Whether a side is too long, or its middle too far from a surface with these normals at its ends.
///
/// A side along a ray is never split: it climbs a cliff, is straight, and its middle would be seen at its foot or its top alone.
fn too_coarse<const N: usize>(centre: &[f64], [a, b]: [[f64; N]; 2], [m, n]: [[f64; N]; 2], length: f64) -> bool {
    let side: f64 = (0..N).map(|d| (b[d] - a[d]).powi(2)).sum::<f64>().sqrt();
    if side < SHORTEST * length {
        return false;
    }
    let ray: [f64; N] = std::array::from_fn(|d| a[d] - centre[d]);
    let [far, along] =
        [&ray, &std::array::from_fn(|d| b[d] - a[d])].map(|v| (0..N).map(|d| ray[d] * v[d]).sum::<f64>());
    let across: f64 = (0..N).map(|d| (b[d] - a[d] - along / far * ray[d]).powi(2)).sum::<f64>().sqrt();
    if across < ACROSS * length {
        return false;
    }
    if side > length {
        return true;
    }
    // A surface that turns by an angle over a side stands an eighth of their product away from its middle; the turn along the side is
    // what the normals change along it.
    let turn: f64 = (0..N).map(|d| (n[d] - m[d]) * (b[d] - a[d])).sum::<f64>().abs() / side;
    turn * side / 8.0 > FARTHEST * length
}

/// The triangles with the middles of their split sides: two, or four, for each that has some.
fn divided(vertices: &Vertices<3>, triangles: &[[u32; 3]], numbers: &FxHashMap<(u32, u32), u32>) -> Vec<[u32; 3]> {
    let mut all = Vec::with_capacity(2 * triangles.len());
    for &[a, b, c] in triangles {
        let middle = |a: u32, b: u32| numbers.get(&edge(a, b)).copied();
        match [middle(a, b), middle(b, c), middle(c, a)] {
            [None, None, None] => all.push([a, b, c]),
            [Some(d), Some(e), Some(f)] => all.extend([[a, d, f], [d, b, e], [f, e, c], [d, e, f]]),
            sides => {
                // Turned so that the first side is split.
                let first = sides.iter().position(Option::is_some).unwrap_or(0);
                let corners = [a, b, c];
                let [a, b, c] = std::array::from_fn(|k| corners[(first + k) % 3]);
                let sides: [Option<u32>; 3] = std::array::from_fn(|k| sides[(first + k) % 3]);
                match sides {
                    [Some(d), None, None] => all.extend([[a, d, c], [d, b, c]]),
                    [Some(d), Some(e), None] => quarters(vertices, [a, b, c], d, e, &mut all),
                    [Some(d), None, Some(f)] => quarters(vertices, [c, a, b], f, d, &mut all),
                    _ => all.push([a, b, c]),
                }
            }
        }
    }
    all
}

/// Three triangles of one whose first two sides are split, along the shorter diagonal.
fn quarters(vertices: &Vertices<3>, [a, b, c]: [u32; 3], d: u32, e: u32, all: &mut Vec<[u32; 3]>) {
    let apart = |a: u32, b: u32| {
        let side = minus(vertices.positions[a as usize], vertices.positions[b as usize]);
        dot(side, side)
    };
    all.push([d, b, e]);
    if apart(a, e) <= apart(d, c) {
        all.extend([[a, d, e], [a, e, c]]);
    } else {
        all.extend([[a, d, c], [d, e, c]]);
    }
}

/// The outline over a polygon's directions, counter-clockwise.
///
/// # Errors
/// See [`MeshError`].
pub fn outline(
    gauge: &Gauge,
    space: &Space,
    directions: &[[f64; 2]],
    interrupt: &Interrupt,
) -> Result<Made<Vec<[f64; 2]>>, MeshError> {
    let mut vertices = Vertices::default();
    vertices.extend(gauge, space, directions, false, interrupt)?;
    Ok(Made { boundary: vertices.positions, points: vertices.points, cut: vertices.cut })
}

/// The outline that follows the shape, as [`following`] does.
///
/// # Errors
/// See [`MeshError`].
pub fn outline_following(
    gauge: &Gauge,
    space: &Space,
    length: f64,
    most: usize,
    interrupt: &Interrupt,
) -> Result<Made<Vec<[f64; 2]>>, MeshError> {
    let mut line: Vec<u32> = (0..64).collect();
    let mut vertices = Vertices::default();
    vertices.extend(gauge, space, &circle(64), true, interrupt)?;
    for _ in 0..ROUNDS {
        let ends = |k: usize| [line[k], line[(k + 1) % line.len()]].map(|v| v as usize);
        let coarse: Vec<bool> = (0..line.len())
            .map(|k| {
                let ends = ends(k);
                too_coarse(
                    &gauge.centre,
                    ends.map(|v| vertices.positions[v]),
                    ends.map(|v| vertices.normals[v]),
                    length,
                )
            })
            .collect();
        let split: Vec<usize> = (0..line.len()).filter(|k| coarse[*k]).collect();
        if split.is_empty() {
            break;
        }
        if line.len() + split.len() > most {
            return Err(MeshError::Memory);
        }
        let middle = |k: &usize| {
            let [p, q] = ends(*k).map(|v| vertices.positions[v]);
            std::array::from_fn(|d| 0.5 * (p[d] + q[d]) - gauge.centre[d])
        };
        let directions: Vec<[f64; 2]> = split.iter().map(middle).collect();
        let mut next = vertices.positions.len() as u32;
        vertices.extend(gauge, space, &directions, true, interrupt)?;
        let mut longer = Vec::with_capacity(line.len() + split.len());
        for (k, &v) in line.iter().enumerate() {
            longer.push(v);
            if coarse[k] {
                longer.push(next);
                next += 1;
            }
        }
        line = longer;
    }
    let boundary = line.iter().map(|&v| vertices.positions[v as usize]).collect();
    Ok(Made { boundary, points: vertices.points, cut: vertices.cut })
}

/// The directions of a regular polygon, counter-clockwise.
#[must_use]
pub fn circle(corners: usize) -> Vec<[f64; 2]> {
    let turn = |k: usize| 2.0 * std::f64::consts::PI * k as f64 / corners.max(3) as f64;
    (0..corners.max(3)).map(|k| [libm::cos(turn(k)), libm::sin(turn(k))]).collect()
}
