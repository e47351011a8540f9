//! The table of built-ins: every entry's example runs.
