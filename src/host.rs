//! The world outside: the disk and the clock behind one trait. The only file that touches `std::fs`.
