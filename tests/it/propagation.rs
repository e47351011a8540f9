//! Definitions that propagate: edited sessions equal fresh ones.
