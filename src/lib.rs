//! Yont: solids, surfaces, time-dependent and n-dimensional objects written as real functions, `f(x1, ..., xn) >= 0`.
//!
//! A [`model::Session`] reads the language; [`model::request`] asks for meshes, pictures, values and measures of its objects. A whole
//! program:
//!
//! ```
//! use std::sync::Arc;
//! use yont::host::Memory;
//! use yont::interrupt::Interrupt;
//! use yont::limits::Limits;
//! use yont::model::Session;
//! use yont::model::request::{self, Options, Output, View};
//! use yont::syntax::Mode;
//!
//! let host = Arc::new(Memory::with(&[]));
//! let mut session = Session::new(host.clone(), Limits::default(), Interrupt::default());
//! let bead = "gob_bead = (4 - x1**2 - x2**2 - x3**2) \\ (r**2 - x1**2 - x2**2);
//!             r = 1;
//!             x1min = -3; x1max = 3; x2min = -3; x2max = 3; x3min = -3; x3max = 3;";
//! assert!(session.input("bead.geo", bead, Mode::Script).accepted);
//!
//! // A ball of radius 2 with a hole of radius 1 through it: 4/3 pi (4 - 1)^(3/2), and one handle.
//! let measured = request::measure(&mut session, &View::default()).expect("a solid").json();
//! let volume = measured["volume"]["value"].as_f64().expect("a number");
//! assert!((volume - 21.7656).abs() < 0.003 * 21.7656);
//! assert_eq!(measured["euler"], 0);
//!
//! // The mesh is checked, then written whole.
//! let output = Output::parse("bead.stl", None).expect("a format");
//! request::write(&mut session, &output, &Options::default(), &mut std::io::sink()).expect("a mesh");
//! assert_eq!(host.names(), ["bead.stl"]);
//! ```

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
pub mod reuse;
pub mod source;
pub mod surface;
pub mod syntax;
pub mod vm;
