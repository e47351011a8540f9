//! What programs mean: one case per rule of the language.
