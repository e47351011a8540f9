//! The command line. Computes nothing.
