//! Decodes volumes and meshes from bytes into leaves. Knows no disk.
