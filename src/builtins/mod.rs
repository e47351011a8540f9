//! The one table of built-in functions.
