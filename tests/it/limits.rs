//! Every limit at n and at n + 1.
