//! Golden texts of messages.
