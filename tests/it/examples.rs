//! Every example runs and gives what its first comment says.
