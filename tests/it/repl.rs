//! The prompt: piped, and on a terminal of its own.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use expectrl::process::unix::{PtyStream, UnixProcess, WaitStatus};
use expectrl::{ControlCode, Expect, Session};
use tempfile::TempDir;

use super::cli::{BALL, folder, run};

type Words = &'static [&'static str];

/// What is typed, what standard output and standard error say, and the status.
const PIPED: &[(&str, &str, Words, Words, i32)] = &[
    ("a value", "1 + 2*3\n", &["7"], &[], 0),
    ("a definition and its value", "a = 4;\na**2\n", &["16"], &[], 0),
    ("a definition propagates", "b = a + 1;\na = 4;\nb\na = 5;\nb\n", &["5\n", "6\n"], &["not defined yet"], 0),
    ("input that goes on", "a = (1 +\n2)*\n3\na\n", &["9"], &[], 0),
    ("a comment that goes on", "{ one\ntwo }\n7\n", &["7"], &[], 0),
    ("a block that goes on", "i = 1;\nWHILE (i < 10) DO BEGIN\ni = 2*i;\nEND;\ni\n", &["16"], &[], 0),
    ("the last value", "3\n_ + 1\n", &["4"], &[], 0),
    ("an error sets the status and the rest runs", "1 +* 2\n5\n", &["5"], &["error"], 3),
    ("a failed input changes nothing", "a = 1;\na = 2; b = SIN(1, 2);\na\n", &["1"], &["SIN"], 3),
    ("undo", "a = 1;\na = 2;\n:undo\na\n", &["1"], &["took back: a = 2"], 0),
    ("redo", "a = 1;\na = 2;\n:undo\n:redo\na\n", &["2"], &["again: a = 2"], 0),
    ("nothing to undo", ":undo\n", &[], &["nothing"], 2),
    ("help", ":help\n", &[":undo", ":render"], &[], 0),
    ("help of a command", ":help deps\n", &[":deps NAME"], &[], 0),
    ("help of a function", ":help sqrt\n", &["SQRT("], &[], 0),
    ("an unknown command", ":lits\n", &[], &[":list"], 2),
    ("a command without its argument", ":deps\n", &[], &["NAME"], 2),
    ("a command with one too many", ":undo 3\n", &[], &["no argument"], 2),
    ("documentation", "{ how high }\nheight = 3;\nheight?\n", &["how high"], &[], 0),
    ("a definition asked for", "height = 1 + 2;\nheight??\n", &["height = 1 + 2"], &[], 0),
    ("a question about nothing", "heihgt?\n", &[], &["heihgt"], 2),
    ("dependencies", "a = 1; b = a; c = b;\n:deps b\n", &["a", "c"], &[], 0),
    ("a list", "a = 1; gob_b = a - x1**2;\n:list\n", &["a", "gob_b"], &[], 0),
    ("settings", ":set resolution 16\n:set view top\n:set\n", &["resolution 16\nview top\n"], &[], 0),
    ("an impossible setting", ":set resolution no\n", &[], &["whole number"], 2),
    ("leaving", ":quit\n1 +* 2\n", &[], &[], 0),
    ("no end of line", "2 + 2", &["4"], &[], 0),
    ("an end within something open", "a = (1", &[], &["("], 3),
    ("a mesh of the wrong kind", ":mesh a.png\n", &[], &[":render"], 2),
];

#[test]
fn without_a_terminal() {
    for (what, input, out, err, status) in PIPED {
        let folder = folder(&[]);
        let ran = run(folder.path(), &[], input);
        assert_eq!(ran.status, Some(*status), "{what}: {}{}", ran.out, ran.err);
        for words in *out {
            assert!(ran.out.contains(words), "{what}: no {words:?} in\n{}", ran.out);
        }
        for words in *err {
            assert!(ran.err.contains(words), "{what}: no {words:?} in\n{}", ran.err);
        }
        assert_eq!(ran.err.is_empty(), err.is_empty(), "{what}: {}", ran.err);
        assert!(!ran.out.contains("yont>") && !ran.out.contains('\x1b'), "{what}: a prompt off a terminal");
        assert!(ran.made.is_empty(), "{what}: left {:?}", ran.made);
    }
}

#[test]
fn files_come_and_go() {
    let folder = folder(&[("ball.geo", BALL.as_bytes())]);
    let input = ":load ball.geo\nr = 1;\n:set resolution 12\n:mesh a.stl\n:render a.png --size 16x16\n:measure\n:save saved.geo\n";
    let ran = run(folder.path(), &[], input);
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    assert_eq!(ran.made, ["a.png", "a.stl", "saved.geo"]);
    assert!(ran.out.contains("volume"), "{}", ran.out);
    let again = run(folder.path(), &["saved.geo", "-e", "r"], "");
    assert_eq!((again.status, again.out.lines().last()), (Some(0), Some("1")), "{}", again.err);
    assert_eq!(run(folder.path(), &[], ":load none.geo\n").status, Some(4));
    assert_eq!(run(folder.path(), &[], "1\n:mesh none/a.stl\n").status, Some(3), "nothing is defined");
}

#[test]
fn a_program_is_kept_when_the_prompt_follows() {
    let folder = folder(&[("ball.geo", BALL.as_bytes())]);
    let ran = run(folder.path(), &["ball.geo", "-i", "--resolution", "8"], "r\n:set\n");
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    assert!(ran.out.contains("\n2\n") && ran.out.contains("resolution 8"), "{}", ran.out);
}

pub(crate) type Terminal = Session<UnixProcess, PtyStream>;

/// Waits for an answer and the prompt after it.
pub(crate) fn answer(terminal: &mut Terminal, words: &str) {
    terminal.expect(words).expect(words);
    terminal.expect("yont>").expect("a prompt");
}

/// `yont` on a terminal, with its state in `folder`.
pub(crate) fn terminal(folder: &Path) -> Terminal {
    let mut command = Command::new(env!("CARGO_BIN_EXE_yont"));
    command.current_dir(folder).env("XDG_STATE_HOME", folder.join("state")).env("NO_COLOR", "1").env("TERM", "xterm");
    let mut terminal = Session::spawn(command).expect("a terminal");
    terminal.set_expect_timeout(Some(Duration::from_secs(60)));
    terminal.expect("yont>").expect("a prompt");
    terminal
}

pub(crate) fn state() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

#[test]
fn on_a_terminal() {
    let state = state();
    let mut terminal = terminal(state.path());
    terminal.send_line("gob_ball = (1 - x1**2").expect("typed");
    terminal.send_line("- x2**2);").expect("typed");
    answer(&mut terminal, "object of x1, x2");
    terminal.send("(gob_b\t AT (x1 = 0.5, x2 = 0))*36 + 709\r").expect("typed");
    answer(&mut terminal, "736");
    // A key is sent only once the line editor listens: before, Ctrl-C and Ctrl-D are the terminal's own.
    terminal.send("1 + unfinished").expect("typed");
    terminal.expect("unfinished").expect("the line");
    terminal.send(ControlCode::EndOfText).expect("typed");
    terminal.expect("yont>").expect("Ctrl-C cancels the line");
    terminal.send_line("20 + 22").expect("typed");
    answer(&mut terminal, "42");
    terminal.send_line("nonsense(").expect("typed");
    terminal.expect("nonsense(").expect("the line");
    terminal.send(ControlCode::EndOfText).expect("typed");
    terminal.expect("\x1b[?2004l").expect("the line is left");
    terminal.expect("yont>").expect("a prompt");
    terminal.send_line("100 + 23").expect("typed");
    answer(&mut terminal, "123");
    terminal.send(ControlCode::EndOfTransmission).expect("typed");
    terminal.expect(expectrl::Eof).expect("Ctrl-D leaves");
    assert!(matches!(terminal.get_process().wait(), Ok(WaitStatus::Exited(_, 0))));
    let history = fs::read_to_string(state.path().join("state/yont/history")).expect("a history");
    assert!(history.contains("20 + 22"), "{history}");
}

#[test]
fn failed_inputs_stay_in_the_history() {
    let state = state();
    let mut first = terminal(state.path());
    first.send_line("1 +* 3").expect("typed");
    answer(&mut first, "error");
    first.send(ControlCode::EndOfTransmission).expect("typed");
    first.expect(expectrl::Eof).expect("Ctrl-D leaves");
    let mut second = terminal(state.path());
    second.send("\x1b[A").expect("arrow up");
    second.expect("1 +* 3").expect("the failed line is back");
    second.send(ControlCode::EndOfText).expect("typed");
    second.expect("yont>").expect("an empty line");
    second.send(ControlCode::EndOfTransmission).expect("typed");
    second.expect(expectrl::Eof).expect("Ctrl-D leaves");
}
