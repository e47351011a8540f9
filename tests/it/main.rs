//! The one integration binary: each module is a subject.

mod builtins;
mod cli;
mod conformance;
mod crash;
mod data;
mod diagnostics;
mod examples;
mod export;
mod field;
mod formats;
mod hostile;
mod interrupts;
mod language;
mod limits;
mod measure;
mod mesh;
mod number;
mod oracle;
mod parser;
mod picture;
mod plots;
mod propagation;
mod prospero;
mod repl;
mod session;
mod tidy;
