//! Volumes and meshes from bytes.
