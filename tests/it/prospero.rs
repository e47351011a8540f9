//! A large operation list from text to picture.
