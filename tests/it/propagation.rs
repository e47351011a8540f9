//! The definitive principle: after any edit, what the session knows is what a fresh session finds in the saved script, and only
//! what depends on the edit was lowered again.

use yont::field::Coordinate;
use yont::model::value::Scalar;
use yont::model::{Session, Value};
use yont::number::Reals;
use yont::syntax::Mode;
use yont::vm::reference;

use crate::session::{messages, session};

/// A small generator of random numbers, so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).unwrap_or(0) % n
    }

    /// A name out of a dozen; `r1` among them.
    fn name(&mut self) -> String {
        ["r1", "r2", "r3", "p", "q", "s", "gob_a", "gob_b", "gob_c", "gob_d", "u", "v"][self.below(12)].to_owned()
    }

    fn operand(&mut self) -> String {
        match self.below(8) {
            0 => "x1".to_owned(),
            1 => "x2".to_owned(),
            2 => "a[2]".to_owned(),
            3 => "f(x1)".to_owned(),
            4 => format!("{}", self.below(9)),
            _ => self.name(),
        }
    }

    fn formula(&mut self) -> String {
        let (a, b) = (self.operand(), self.operand());
        match self.below(8) {
            0 => format!("({a} | {b})"),
            1 => format!("({a} & {b})"),
            2 => format!("IF {a} > 3 THEN {b} ELSE {}", self.operand()),
            3 => format!("SUM(i = 1 TO 3, {a}*i + {b})"),
            4 => format!("(({a} - {b}) AT (x1 = x2 + 1))"),
            5 => format!("g({a})"),
            _ => format!("{a} - {b}"),
        }
    }

    /// A line at the prompt, and the name that it plainly redefines, if that is all it does.
    fn edit(&mut self) -> (String, Option<String>) {
        let (name, formula) = (self.name(), self.formula());
        match self.below(16) {
            0 => (format!("{name} = {name} + {formula}"), None),
            1 => (format!("a[{}] = {formula}", 1 + self.below(3)), None),
            2 => (format!("a = [1, {formula}, {}]", self.below(5)), Some("a".to_owned())),
            3 => (
                format!(
                    "k = 1; {name} = 0; WHILE (k <= 3) DO BEGIN {name} = {name}*2 + {}; k = k + 1; END",
                    self.operand()
                ),
                None,
            ),
            4 => (format!("FOR j = 1 TO 3 DO {name} = {name} + j*{}", self.operand()), None),
            5 => {
                (format!("IF ({} > 2) THEN {name} = {} ELSE {name} = {name} + 1", self.operand(), self.operand()), None)
            }
            6 => (format!("r_alpha = {}", ["0", "1", "0.5", "r1/(1 + r1**2)"][self.below(4)]), None),
            7 => (format!("f(t) = t*{}", self.name()), Some("f".to_owned())),
            8 => (format!("g(t) = BEGIN w = t + {}; g = w*w; END", self.name()), Some("g".to_owned())),
            9 => (format!("f(t) = t | {}", self.name()), Some("f".to_owned())),
            _ => (format!("{name} = {formula}"), Some(name)),
        }
    }
}

/// Everything that a name is worth: numbers at two points, or the reason why it fails.
fn worth(session: &Session, name: &str) -> String {
    match session.value(name) {
        Some(Ok(value)) => numbers(session, &value),
        Some(Err(told)) => format!("fails: {}", told.title),
        None => "nothing".to_owned(),
    }
}

fn numbers(session: &Session, value: &Value) -> String {
    match value {
        Value::Scalar(Scalar::Number(n)) => format!("{n:e}"),
        Value::Scalar(Scalar::Node(id)) => {
            let at = |x1, x2| {
                let point = [(Coordinate(1), x1), (Coordinate(2), x2)];
                reference::eval(&mut Reals, session.graph(), *id, &point)
            };
            format!("{:e}, {:e}", at(0.75, -2.5), at(3.25, 0.5))
        }
        Value::Array(array) => array.items().iter().map(|v| numbers(session, v)).collect::<Vec<_>>().join("; "),
        other => other.show(session.graph()),
    }
}

fn same_as_fresh(session: &Session, after: &str) {
    let script = session.save();
    let mut fresh = session_again();
    let outcome = fresh.input("saved.geo", &script, Mode::Prompt);
    assert!(outcome.accepted, "after {after}\n{script}\n{}", messages(&outcome));
    let mut names = session.names();
    names.sort();
    let mut found = fresh.names();
    found.sort();
    assert_eq!(names, found, "after {after}\n{script}");
    for name in names {
        assert_eq!(worth(session, &name), worth(&fresh, &name), "{name} after {after}\n{script}");
        assert_eq!(session.deps(&name), fresh.deps(&name), "deps of {name} after {after}\n{script}");
    }
    assert_eq!(fresh.save(), script, "a saved script saves as itself");
}

fn session_again() -> Session {
    session()
}

#[test]
fn a_thousand_random_edits_leave_what_a_fresh_session_finds() {
    let mut random = Random(0x1995);
    let mut session = session();
    let (mut accepted, mut redefined, mut undone) = (0, 0, 0);
    let start = "r1 = 4; r2 = 6; r3 = 3; a = [1, 2, 3]; f(t) = t*2; g(t) = t; gob_a = r1 - x1;";
    assert!(session.input("start", start, Mode::Prompt).accepted);
    for _ in 0..1_000 {
        if random.below(10) == 0 {
            undone += usize::from(session.undo().is_some());
            if random.below(2) == 0 {
                session.redo();
            }
            same_as_fresh(&session, ":undo");
            continue;
        }
        let (line, name) = random.edit();
        let before = session.save();
        let outcome = session.input("<prompt>", &line, Mode::Prompt);
        if !outcome.accepted {
            assert_eq!(session.save(), before, "{line} failed and changed something");
            continue;
        }
        accepted += 1;
        if let Some(name) = name {
            let mut readers = session.deps(&name).map(|d| d.readers).unwrap_or_default();
            readers.retain(|n| *n != name);
            let mut again = session.lowered_again();
            again.retain(|n| *n != name);
            assert_eq!(again, readers, "after {line}\n{}", session.save());
            redefined += usize::from(!readers.is_empty());
        }
        same_as_fresh(&session, &line);
    }
    assert!(accepted > 400 && redefined > 100 && undone > 30, "{accepted} {redefined} {undone}");
}

#[test]
fn only_what_depends_on_a_name_is_lowered_again() {
    let mut session = session();
    let script = "r1 = 4; r2 = 6; gob_a = r1 - x1; gob_b = r2 - x1; gob_c = gob_a | gob_b; k = 3;
        i = 1; s = 0; WHILE (i <= k) DO BEGIN s = s + r1; i = i + 1; END; d = s;";
    assert!(session.input("script", script, Mode::Script).accepted);
    assert!(session.input("<prompt>", "r1 = 5", Mode::Prompt).accepted);
    assert_eq!(session.lowered_again(), ["d", "gob_a", "gob_c", "i", "s"]);
    assert_eq!(session.deps("r1").map(|d| d.readers), Some(session.lowered_again()));
    assert!(session.input("<prompt>", "i = 5", Mode::Prompt).accepted);
    assert_eq!(session.lowered_again(), [""; 0], "a later i does not touch the loop");
    assert_eq!(session.describe("s"), "s = 15");
    assert!(session.input("<prompt>", "k = 4", Mode::Prompt).accepted);
    assert_eq!(session.describe("d"), "d = 20");
    assert_eq!(session.describe("i"), "i = 5");
}

#[test]
fn chains_of_a_hundred_thousand_neither_recurse_nor_overflow() {
    let mut session = session();
    let down: String = (0..100_000).map(|i| format!("n{i} = n{} + 1;\n", i + 1)).collect();
    let outcome = session.input("down", &format!("{down}n100000 = x1;"), Mode::Script);
    assert!(outcome.accepted, "{}", messages(&outcome));
    assert_eq!(crate::language::value_at(&session, "n0", &[0.5]), 100_000.5);
    assert!(session.input("<prompt>", "n100000 = 1", Mode::Prompt).accepted);
    assert_eq!(session.lowered_again().len(), 100_000);
    assert_eq!(session.describe("n0"), "n0 = 100001");
    let mut session = session_again();
    let up = "s = x1;\n".to_owned() + &"s = s + 1;\n".repeat(100_000);
    assert!(session.input("up", &up, Mode::Script).accepted);
    assert_eq!(crate::language::value_at(&session, "s", &[0.5]), 100_000.5);
    drop(session);
}
