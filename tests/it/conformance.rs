//! Every evaluator agrees: reference, double and single blocks, gradients, intervals.
