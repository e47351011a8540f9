//! Boundaries of functions: the box hierarchy, marching cubes, checks, measures. Knows no language and no files.

pub mod mesh;
