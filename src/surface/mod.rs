//! Boundaries of functions: the box hierarchy, marching cubes, checks, measures. Knows no language and no files.
//!
//! The way of a mesh: [`grid`] says where the sample points lie, [`boxes`] finds the undecided leaves among them, [`brick`] evaluates a leaf
//! and finds a vertex on each crossed edge ([`guess`], [`roots`]), [`marching`] joins the vertices to triangles ([`table`]), [`cap`] closes the object
//! at the faces of the modelling space. [`check()`] proves the mesh closed, [`measure()`] integrates over it, [`contour`] does the same for
//! 2-D shapes. [`sharp`] puts creases into a mesh that is there. [`space`] finds the modelling space when nobody gave one.

pub mod boxes;
pub mod brick;
pub mod cap;
pub mod check;
pub mod contour;
pub mod curvature;
pub mod detail;
pub mod edit;
pub mod estimate;
pub mod figure;
pub mod grid;
pub mod guess;
pub mod line;
pub mod marching;
pub mod measure;
pub mod memory;
pub mod mesh;
pub mod query;
pub mod roots;
pub mod sampler;
pub mod sharp;
pub mod space;
pub mod star;
pub mod table;

pub use check::{Fault, Topology, check};
pub use grid::{Grid, GridError};
pub use marching::{Extraction, Report, SurfaceError, extract};
pub use measure::{Measures, measure};
pub use mesh::Mesh;
