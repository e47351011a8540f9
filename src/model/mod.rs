//! The meaning of the language: definitions that propagate, the environment, and the session that every front end works over.
//!
//! A definition is a formula, never a stored value; values are kept beside it and found again when something that they read changes.

pub mod carving;
mod check;
mod definition;
pub mod environment;
mod errors;
mod explain;
mod formula;
mod input;
pub mod library;
mod lower;
mod names;
mod objects;
pub mod oracle;
mod places;
pub mod povray;
mod report;
pub mod request;
pub mod route;
mod session;
pub mod settings;
mod stack;
mod state;
pub mod value;

pub use environment::{Axis, Object, Role};
pub use formula::Formula;
pub use session::{Deps, Event, Outcome, Session, UNNAMED};
pub use value::Value;
