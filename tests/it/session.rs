//! Transactions, undo, saving.
