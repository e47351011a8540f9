//! One file per format; each takes a writer and never seeks.
