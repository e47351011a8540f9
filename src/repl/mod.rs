//! The prompt. Computes nothing.
