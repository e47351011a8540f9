//! Integrals over a closed mesh: volume, area, centroid, inertia, with error estimates from two resolutions. Checks the mesh first.

use std::fmt;

use rayon::prelude::*;

use super::check::{Fault, Topology, check};
use super::grid::Grid;
use super::marching::{Report, SurfaceError, extract};
use super::mesh::{Mesh, cross, dot, minus};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::vm::Shape;

/// A measured number and an estimate of its distance from the solid's own.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The value, of the mesh at the resolution that was asked for.
    pub value: f64,
    /// The difference to the mesh with twice as large cells: Roache's grid convergence index for two grids and an error that falls with
    /// the square of the cell, where it is about three times the error. An estimate, not a bound.
    pub error: f64,
}

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
    /// Smallest and largest coordinates; None for an empty object.
    pub bounds: Option<([f64; 3], [f64; 3])>,
    /// Euler characteristic, components, genus.
    pub topology: Topology,
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

/// Measures a 3-D shape on a grid, and on one with twice as large cells for the estimates.
///
/// # Errors
/// See [`MeasureError`].
pub fn measure(shape: &Shape, grid: &Grid, limits: &Limits, interrupt: &Interrupt) -> Result<Measures, MeasureError> {
    let coarse = extract(shape, &grid.halved(), limits, interrupt)?;
    let fine = extract(shape, grid, limits, interrupt)?;
    let topology = check(&fine.mesh)?;
    let [rough, good] = [&coarse.mesh, &fine.mesh].map(Integrals::of);
    let mut report = fine.report;
    report.counters.add(coarse.report.counters);
    // One cell cannot be halved; nothing is known about the error then.
    let is_compared = grid.halved() != *grid;
    let estimate = |of: &dyn Fn(&Integrals) -> f64| {
        let (value, other) = (of(&good), if is_compared { of(&rough) } else { 0.0 });
        Estimate { value, error: (value - other).abs() }
    };
    Ok(Measures {
        volume: estimate(&|i| i.volume),
        area: estimate(&|i| i.area),
        centroid: std::array::from_fn(|d| estimate(&|i| i.centroid[d])),
        inertia: std::array::from_fn(|r| std::array::from_fn(|c| estimate(&|i| i.inertia[r][c]))),
        bounds: fine.mesh.bounds(),
        topology,
        report,
    })
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
