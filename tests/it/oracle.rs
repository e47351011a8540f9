//! The tree oracle against the compiled program.
