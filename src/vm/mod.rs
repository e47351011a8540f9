//! Compiled programs: closures over blocks of points, intervals, gradients, and the slow reference.
