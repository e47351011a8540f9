//! What a program means: definitions that depend on each other, lowered to expression graphs; sessions. Bytes come from the host.

pub mod oracle;
pub mod request;
