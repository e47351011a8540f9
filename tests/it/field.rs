//! Graphs: folding, maps, derivatives.
