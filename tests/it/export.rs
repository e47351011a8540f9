//! Every format read back.
