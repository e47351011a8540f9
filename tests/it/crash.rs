//! Nothing is lost when a process dies.
