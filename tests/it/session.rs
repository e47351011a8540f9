//! Inputs as transactions, the history, and what a session saves.

use std::sync::Arc;

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::{Event, Outcome, Session};
use yont::syntax::Mode;

pub fn session() -> Session {
    Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default())
}

/// The messages of an outcome, one a line: code and title.
pub fn messages(outcome: &Outcome) -> String {
    let all: Vec<String> = outcome.diagnostics.iter().map(|d| format!("{}: {}", d.code, d.title)).collect();
    all.join("\n")
}

/// Types lines at the prompt; each must be accepted. Gives what the last one showed.
fn prompt(session: &mut Session, lines: &[&str]) -> String {
    let mut shown = String::new();
    for line in lines {
        let outcome = session.input("<prompt>", line, Mode::Prompt);
        assert!(outcome.accepted, "{line}: {}", messages(&outcome));
        let texts = outcome.events.iter().map(|event| match event {
            Event::Defined(text) | Event::Printed(text) | Event::Value { text, .. } => text.as_str(),
        });
        shown = texts.collect::<Vec<_>>().join("\n");
    }
    shown
}

#[test]
fn a_failed_input_changes_nothing() {
    let mut s = session();
    prompt(&mut s, &["r1 = 4", "gob_a = r1 - x1"]);
    let before = s.save();
    let outcome = s.input("<prompt>", "r1 = 5; q = 1/0; gob_a = 3", Mode::Prompt);
    assert!(!outcome.accepted && outcome.events.is_empty());
    assert_eq!(s.save(), before);
    assert_eq!(prompt(&mut s, &["r1"]), "4");
    assert_eq!(s.undo().as_deref(), Some("gob_a = r1 - x1"));
}
