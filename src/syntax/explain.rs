//! What to say about a text that is not a program: the messages of the parser and where they point. Reads tokens only;
//! the tree and the grammar are not touched here.

mod form;
mod names;
mod place;
mod shape;
mod stop;

pub(super) use form::*;
pub(super) use names::{defined_names, read_names};
pub(super) use place::statement_in_block;
pub(super) use place::{Place, doc, last_token_end, with_semicolon};
pub(super) use shape::{fault, gather, more_errors, refuse, too_deep};
pub(super) use stop::{Forgotten, forgotten_semicolon, gave_up, missing_last_semicolon, missing_semicolon, unexpected};
