//! Intervals, duals and elementary functions.
