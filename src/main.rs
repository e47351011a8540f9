//! The `yont` program: exit codes only.

fn main() {}
