//! Integrals over a closed mesh: volume, area, centroid, inertia, curvature, with error estimates from three resolutions. Checks the mesh first.

use std::fmt;
use std::sync::Arc;

use rayon::prelude::*;

use super::check::{Fault, Topology, check};
use super::curvature::{self, Sum};
use super::estimate::{Bend, Estimate};
use super::grid::Grid;
use super::marching::{Extraction, Report, SurfaceError};
use super::mesh::{Mesh, cross, dot, minus};
use super::sharp::extract_as;
use super::space::reach;
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::reuse::Digest;
use crate::vm::Shape;

/// Accuracy of the bounding box, as a part of the space.
const REACH: f64 = 1e-5;

/// What can be measured of a 3-D solid. Lengths are the units of the space, density is 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measures {
    /// Enclosed volume.
    pub volume: Estimate,
    /// Area of the boundary, caps included.
    pub area: Estimate,
    /// Centre of mass.
    pub centroid: [Estimate; 3],
    /// Inertia tensor about the centre of mass.
    pub inertia: [[Estimate; 3]; 3],
    /// Smallest and largest coordinate along each axis, found by intervals: these errors are bounds. None for an empty object.
    pub bounds: Option<[[Estimate; 2]; 3]>,
    /// Euler characteristic, components, genus.
    pub topology: Topology,
    /// Connected parts of the inside: surfaces but for those of cavities.
    pub parts: usize,
    /// Whether half the resolution gives the same topology.
    pub is_settled: bool,
    /// Mean and Gaussian curvature over the smooth parts; a ball's are one over its radius and the square of that.
    pub curvature: Option<[Bend; 2]>,
    /// What there is to say about the extraction, both resolutions' costs added.
    pub report: Report,
}

/// Why nothing was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeasureError {
    /// There is no mesh.
    Surface(SurfaceError),
    /// The mesh is not closed: nothing can be said of it.
    Fault(Fault),
}

impl fmt::Display for MeasureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Surface(error) => error.fmt(f),
            Self::Fault(fault) => fault.fmt(f),
        }
    }
}

impl std::error::Error for MeasureError {}

impl From<Cancelled> for MeasureError {
    fn from(cancelled: Cancelled) -> Self {
        Self::Surface(cancelled.into())
    }
}

impl From<SurfaceError> for MeasureError {
    fn from(error: SurfaceError) -> Self {
        Self::Surface(error)
    }
}

impl From<Fault> for MeasureError {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

/// Measures a 3-D shape on a grid, and on two with larger cells for the estimates.
///
/// # Errors
/// See [`MeasureError`].
pub fn measure(shape: &Shape, grid: &Grid, limits: &Limits, interrupt: &Interrupt) -> Result<Measures, MeasureError> {
    measure_as(shape, grid, false, limits, interrupt)
}

/// The same, with the creases and corners in the meshes if they are to be `sharp`.
///
/// # Errors
/// See [`MeasureError`].
pub fn measure_as(
    shape: &Shape,
    grid: &Grid,
    sharp: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Measures, MeasureError> {
    let tell = |to: &mut Digest| {
        shape.tell(to);
        to.shown(&(grid, sharp, limits.memory_bytes, limits.search_operations));
    };
    let measured = || measured(shape, grid, sharp, limits, interrupt);
    interrupt.whole("measures", tell, |_| size_of::<Measures>(), measured)
}

fn measured(
    shape: &Shape,
    grid: &Grid,
    sharp: bool,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Measures, MeasureError> {
    let levels: Vec<Level> =
        grid.coarser().iter().map(|grid| Level::of(shape, grid, sharp, limits, interrupt)).collect::<Result<_, _>>()?;
    let fine = &levels[0];
    let size = (0..3).map(|d| grid.hi[d] - grid.lo[d]).fold(0.0, f64::max);
    let estimate = |part: &dyn Fn(&Integrals) -> f64, scale: f64| {
        let values = [0, 1, 2].map(|level| levels.get(level).map(|level| part(&level.integrals)));
        Estimate::from(values, fine.is_smooth, 2e-10 * scale)
    };
    let Integrals { volume, area, .. } = fine.integrals;
    // Creases may lie alike between the sample points of all three grids, so that the differences do not tell what they lose.
    let [lost_area, lost] = fine.lost;
    let turned = |r: usize, c: usize| lost * size * size * if r == c { 0.5 } else { 0.25 };
    let mut report = fine.report.clone();
    levels[1..].iter().for_each(|level| report.counters.add(level.report.counters.clone()));
    let bends = |which: usize| {
        Bend::from([0, 1, 2].map(|k| levels.get(k).and_then(|l| l.bends.map(|b| b[which]))), fine.is_smooth)
    };
    let shown = |t: &Topology| (t.euler, t.components);
    Ok(Measures {
        volume: estimate(&|i| i.volume, volume).at_least(lost),
        area: estimate(&|i| i.area, area).at_least(lost_area),
        centroid: std::array::from_fn(|d| {
            estimate(&|i| i.centroid[d], size).at_least(if lost > 0.0 { 0.25 * size * lost / volume } else { 0.0 })
        }),
        inertia: std::array::from_fn(|r| {
            std::array::from_fn(|c| estimate(&|i| i.inertia[r][c], volume * size * size).at_least(turned(r, c)))
        }),
        bounds: if volume > 0.0 { bounds(shape, grid, limits, interrupt)? } else { None },
        topology: fine.topology,
        parts: fine.parts,
        is_settled: levels.get(1).is_none_or(|half| shown(&half.topology) == shown(&fine.topology)),
        curvature: bends(0).zip(bends(1)).map(|(mean, gauss)| [mean, gauss]),
        report,
    })
}

/// What one resolution tells.
struct Level {
    integrals: Integrals,
    bends: Option<[Sum; 2]>,
    topology: Topology,
    parts: usize,
    is_smooth: bool,
    /// Area and volume that bevels in the place of creases may lose.
    lost: [f64; 2],
    report: Report,
}

impl Level {
    fn of(
        shape: &Shape,
        grid: &Grid,
        sharp: bool,
        limits: &Limits,
        interrupt: &Interrupt,
    ) -> Result<Self, MeasureError> {
        let Extraction { mesh, own, report } = extract_as(shape, grid, sharp, limits, interrupt)?;
        let topology = check(&mesh)?;
        let bends = curvature::of_mesh(shape, &mesh, own, grid.cell(), interrupt).map_err(SurfaceError::from)?;
        let is_smooth = own == mesh.triangles.len() && !has_creases(&mesh);
        let new = report.sharpened.as_ref().map_or(0, |sharpened| sharpened.vertices);
        let lost = lost(&mesh, own, mesh.positions.len() - new);
        let parts = parts(&mesh);
        Ok(Self { integrals: Integrals::of(&mesh), bends, topology, parts, is_smooth, lost, report })
    }
}

/// The closed surfaces of a mesh that enclose something; those of cavities are turned the other way and enclose less than nothing.
fn parts(mesh: &Mesh) -> usize {
    fn root(parent: &mut [u32], mut v: u32) -> u32 {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    }
    let Some((lo, hi)) = mesh.bounds() else { return 0 };
    let middle = std::array::from_fn(|d| 0.5 * (lo[d] + hi[d]));
    let mut parent: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    for &[a, b, c] in &mesh.triangles {
        let first = root(&mut parent, a);
        for other in [b, c] {
            let other = root(&mut parent, other);
            parent[other as usize] = first;
        }
    }
    let mut enclosed = vec![0.0; mesh.positions.len()];
    for &triangle in &mesh.triangles {
        let [a, b, c] = mesh.corners(triangle).map(|p| minus(p, middle));
        enclosed[root(&mut parent, triangle[0]) as usize] += dot(a, cross(b, c));
    }
    enclosed.iter().filter(|volume| **volume > 0.0).count()
}

/// Whether normals at both ends of some edge differ by more than 40 degrees.
fn has_creases(mesh: &Mesh) -> bool {
    let turns = |a: u32, b: u32| dot(mesh.normals[a as usize], mesh.normals[b as usize]) < 0.766;
    mesh.triangles.par_iter().any(|&[a, b, c]| turns(a, b) || turns(b, c) || turns(c, a))
}

/// What the mesh loses of area and volume where triangles bevel a crease: those whose normals turn by more than 40 degrees. The sides that
/// would meet in the crease are longer than the bevel by one over the cosine of half the turn, and stand as high over it as its tangent says.
/// Triangles at a vertex of a crease, from number `crease` on, lose nothing.
fn lost(mesh: &Mesh, own: usize, crease: usize) -> [f64; 2] {
    // Beyond this turn normals tell little of the sides.
    const SHARPEST: f64 = -0.87;
    // The turn is somewhat larger in places than what the normals at the ends of an edge say.
    const MARGIN: f64 = 1.2;
    let of = |&[a, b, c]: &[u32; 3]| {
        if a.max(b).max(c) as usize >= crease {
            return [0.0; 2];
        }
        let turn = |a: u32, b: u32| dot(mesh.normals[a as usize], mesh.normals[b as usize]);
        let (cosine, from, to) = [(turn(a, b), a, b), (turn(b, c), b, c), (turn(c, a), c, a)]
            .into_iter()
            .fold((1.0, a, b), |sharp, next| if next.0 < sharp.0 { next } else { sharp });
        if cosine >= 0.766 {
            return [0.0; 2];
        }
        let half = (0.5 * (1.0 + cosine.max(SHARPEST))).sqrt();
        let [a, b, c] = mesh.corners([a, b, c]);
        let normal = cross(minus(b, a), minus(c, a));
        let area = 0.5 * dot(normal, normal).sqrt();
        let [from, to] = [from, to].map(|corner| mesh.positions[corner as usize]);
        let across = minus(to, from);
        let height = 0.25 * dot(across, across).sqrt() * (1.0 - half * half).sqrt() / half;
        [area * (1.0 / half - 1.0), area * height].map(|part| MARGIN * part)
    };
    let plus = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
    // Added in a fixed order.
    let parts: Vec<[f64; 2]> =
        mesh.triangles[..own].par_chunks(4096).map(|chunk| chunk.iter().map(of).fold([0.0; 2], plus)).collect();
    parts.into_iter().fold([0.0; 2], plus)
}

/// How far the object reaches: between points of it and what intervals rule out. The mesh does not tell: its vertices are kept apart.
pub(super) fn bounds(
    shape: &Shape,
    grid: &Grid,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Option<[[Estimate; 2]; 3]>, MeasureError> {
    let space = (0..3).map(|d| (grid.lo[d], grid.hi[d]));
    let ranges: Vec<(f64, f64)> = space.chain(shape.fixed.iter().map(|&value| (value, value))).collect();
    let found = reach(Arc::clone(&shape.program), &ranges, REACH, limits.search_operations / 10, interrupt);
    let found = found.map_err(SurfaceError::from)?;
    Ok(found.map(|found| std::array::from_fn(|d| found[d].map(|[one, other]| Estimate::between(one, other)))))
}

/// The integrals over the inside of one closed mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integrals {
    /// Enclosed volume.
    pub volume: f64,
    /// Area of the triangles.
    pub area: f64,
    /// Centre of mass; 0 without volume.
    pub centroid: [f64; 3],
    /// Inertia tensor about the centre of mass, density 1.
    pub inertia: [[f64; 3]; 3],
}

/// Sums over triangles: area, and the moments of the tetrahedra between them and one point.
#[derive(Clone, Copy, Default)]
struct Sums {
    area: f64,
    volume: f64,
    first: [f64; 3],
    second: [[f64; 3]; 3],
}

impl Integrals {
    /// Integrates by the divergence theorem. The mesh must be closed; see [`check`].
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let Some((lo, hi)) = mesh.bounds() else {
            return Self::default();
        };
        // About the middle of the mesh, so that a solid far from the origin loses no digits. Added in a fixed order.
        let middle = std::array::from_fn(|d| 0.5 * (lo[d] + hi[d]));
        let parts: Vec<Sums> = mesh.triangles.par_chunks(4096).map(|chunk| Sums::of(mesh, chunk, middle)).collect();
        parts.iter().fold(Sums::default(), Sums::plus).finish(middle)
    }
}

impl Sums {
    fn of(mesh: &Mesh, triangles: &[[u32; 3]], middle: [f64; 3]) -> Self {
        let mut sums = Self::default();
        for &triangle in triangles {
            let [a, b, c] = mesh.corners(triangle).map(|p| minus(p, middle));
            let normal = cross(minus(b, a), minus(c, a));
            let six = dot(a, normal);
            let sum: [f64; 3] = std::array::from_fn(|d| a[d] + b[d] + c[d]);
            sums.area += 0.5 * dot(normal, normal).sqrt();
            sums.volume += six / 6.0;
            for r in 0..3 {
                sums.first[r] += six / 24.0 * sum[r];
                for s in 0..3 {
                    sums.second[r][s] += six / 120.0 * (a[r] * a[s] + b[r] * b[s] + c[r] * c[s] + sum[r] * sum[s]);
                }
            }
        }
        sums
    }

    fn plus(self, other: &Self) -> Self {
        Self {
            area: self.area + other.area,
            volume: self.volume + other.volume,
            first: std::array::from_fn(|r| self.first[r] + other.first[r]),
            second: std::array::from_fn(|r| std::array::from_fn(|s| self.second[r][s] + other.second[r][s])),
        }
    }

    fn finish(self, middle: [f64; 3]) -> Integrals {
        if self.volume == 0.0 {
            return Integrals { area: self.area, ..Integrals::default() };
        }
        let offset = self.first.map(|m| m / self.volume);
        let spread = |r: usize, s: usize| self.second[r][s] - self.volume * offset[r] * offset[s];
        let trace = spread(0, 0) + spread(1, 1) + spread(2, 2);
        Integrals {
            volume: self.volume,
            area: self.area,
            centroid: std::array::from_fn(|d| middle[d] + offset[d]),
            inertia: std::array::from_fn(|r| {
                std::array::from_fn(|s| if r == s { trace - spread(r, s) } else { -spread(r, s) })
            }),
        }
    }
}
