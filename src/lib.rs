//! Yont: solids, surfaces, time-dependent and n-dimensional objects written as real functions, `f(x1, ..., xn) >= 0`.

pub mod builtins;
pub mod cli;
pub mod data;
pub mod diagnostic;
pub mod export;
pub mod field;
pub mod host;
pub mod interrupt;
pub mod limits;
pub mod model;
pub mod number;
pub mod picture;
pub mod repl;
pub mod source;
pub mod surface;
pub mod syntax;
pub mod vm;
