//! The prompt, with and without a terminal.
