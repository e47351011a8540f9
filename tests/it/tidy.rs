//! The layers, sizes and openings of the source files.
