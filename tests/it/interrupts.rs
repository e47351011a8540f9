//! Ctrl-C and cancel tokens.
