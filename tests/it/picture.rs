//! Pictures, rays, plots and animations.
