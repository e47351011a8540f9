//! Meshes are closed, oriented, 2-manifold, and those of dense sampling.
