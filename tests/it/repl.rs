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
    (
        "help of a word",
        ":help while\nr_alpha?\nx1min?\n",
        &["WHILE (c) DO s;", "r_alpha = 1;", "modelling space"],
        &[],
        0,
    ),
    ("documentation that is missing", "a = 1;\na?\n", &["a = 1\n", "No comment stands right above"], &[], 0),
    ("the last value is an object", "gob_b = x1**2;\ngob_b\n_(3)\n", &["9\n"], &[], 0),
    (
        "an object shows itself",
        "gob_b = x1*x2; x1min = 0; x1max = 2;\ngob_b\n",
        &["gob_b: 2-D object of x1, x2; x1 from 0 to 2\n"],
        &[],
        0,
    ),
    ("a formula", "r = 2; gob_b = r*x1 + r;\n:formula gob_b\n", &["gob_b = x1*2 + 2;\n"], &[], 0),
    ("a formula of a function", "f(p) = p;\n:formula f\n", &[], &["`f(p)` has parameters"], 3),
    ("an explanation", "gob_b = x1 @ x2;\n:explain gob_b\n", &["share no coordinate", "r_alpha = 0"], &[], 0),
    ("an explanation of nothing", "gob_b = x1;\n:explain gob_c\n", &[], &["did you mean `gob_b`"], 3),
    ("no pictures off a terminal", "gob_b = x1;\n:show\n", &[], &[":set images half"], 2),
    ("pictures that are off", ":set images off\n:show\n", &[], &["pictures are off"], 2),
    (
        "what was kept",
        "gob_b = 1 - x1**2; x1min = -2; x1max = 2; gob_c = gob_b - x2**2; x2min = -2; x2max = 2;\n:measure\n:measure\n:time\n",
        &["kept from before: whole measures: 1"],
        &[],
        0,
    ),
    ("how long it took", "gob_b = x1;\n:time\n:time\n", &["parse", "lower", "in all"], &[], 0),
    ("a reset", "a = 1; b = 2;\n:reset\na\n", &[], &["forgot 2 definitions", "not defined"], 3),
    ("a reset taken back", "a = 1; b = 2;\n:reset\n:undo\na + b\n", &["3\n"], &["took back: :reset"], 0),
    (
        "a reset done again",
        "r_alpha = 1; a = 1 | 2;\n:reset\n:undo\n:redo\n1 | 1\n",
        &["3.41421356"],
        &["again: :reset"],
        0,
    ),
    (
        "a command without its colon",
        "help\nexit()\nload ball.geo\n",
        &[],
        &["`:help`", "`:quit`", "`:load ball.geo`"],
        2,
    ),
    ("a name that is a command's", "time = 3;\ntime\nlist = [1];\nlist[1]\n", &["3\n", "1\n"], &[], 0),
    ("a command of another program", ":exit\n", &[], &["`:quit`"], 2),
    ("an option that is misspelt", ":set resolutoin 3\n", &[], &["'--resolution'"], 2),
    ("a value that is misspelt", ":set view tpo\n", &[], &["perspective", "'top'"], 2),
    ("words of other languages", "let a = 3\n", &[], &["`a = 3;`"], 3),
    ("a line that goes on with the one before", "a = 1\n  + 2\n- 5;\n3\n  * a\na\n-a\n", &["-6\n-2\n2\n"], &[], 0),
    ("an ELSE on its own line", "IF 0 THEN a = 1;\n\n{ or }\nELSE a = 2;\na\n", &["2\n"], &[], 0),
    ("a WHERE on its own line", "a = q + 1\n  // with\n  WHERE q = 2;\na\n", &["3\n"], &[], 0),
    ("a command goes on with nothing", "a = 1\n:deps a\n", &["a reads nothing"], &[], 0),
    (
        "an object without a name shows itself",
        "gob_a = 1 - x1**2 - x2**2; gob_b = 9 - x1**2 - (x2 - 1)**2;\ngob_a \\ gob_b\ngob_a & gob_b\n_ AT (0, 0)\n",
        &["_: 2-D object of x1, x2; empty", "_: 2-D object of x1, x2; x1, x2 from -1.05"],
        &[],
        0,
    ),
    (
        "a space that was found",
        "gob_a = 1 - x1**2 - x2**2;\ngob_a\n",
        &["x1, x2 from -1.05 to 1.05; route star"],
        &[],
        0,
    ),
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

/// What a script means does not hang on how it comes in.
#[test]
fn the_examples_run_when_they_are_piped() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for (name, text) in super::examples::examples() {
        let ran = run(&examples, &[], &text);
        assert!(ran.status == Some(0) && !ran.err.contains("error"), "{name}: {}", ran.err);
        let script = run(&examples, &[&name], "");
        for line in script.out.lines().filter(|line| !line.starts_with("gob_")) {
            assert!(ran.out.contains(line), "{name}: no {line:?} in\n{}", ran.out);
        }
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
fn saved_programs_find_their_data() {
    let volume = b"2 2\n0 1 2 3\n";
    let part =
        b"map(f) = INTERPOLATE(\"trilinear\", f, x1, x2); gob_a = INTERPOLATE(\"trilinear\", \"v.dat\", x1, x2);";
    let folder = folder(&[("main.geo", b"INCLUDE \"lib/part.geo\"; gob_b = map(\"v.dat\") + gob_a; gob_b(1, 1);")]);
    fs::create_dir_all(folder.path().join("lib")).expect("a folder");
    fs::create_dir_all(folder.path().join("out/deep")).expect("a folder");
    fs::write(folder.path().join("lib/part.geo"), part).expect("room");
    fs::write(folder.path().join("lib/v.dat"), volume).expect("room");
    let input = ":load main.geo\n:save out/deep/saved.geo\n:save here.geo\n:formula gob_b out/b.geo\n";
    let ran = run(folder.path(), &[], input);
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    for saved in ["out/deep/saved.geo", "here.geo", "out/b.geo"] {
        let again = run(folder.path(), &[saved, "-e", "gob_b(1, 1)"], "");
        let text = fs::read_to_string(folder.path().join(saved)).expect("saved");
        assert_eq!((again.status, again.out.lines().last()), (Some(0), Some("6")), "{}{text}", again.err);
    }
    let text = fs::read_to_string(folder.path().join("out/deep/saved.geo")).expect("saved");
    assert!(text.contains("\"../../lib/v.dat\""), "{text}");
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
fn pictures_on_a_terminal() {
    let state = state();
    let mut terminal = terminal(state.path());
    let object = "gob_b = 1 - x1**2 - x2**2; x1min = -2; x1max = 2; x2min = -2; x2max = 2";
    terminal.send_line(object).expect("typed");
    answer(&mut terminal, "object of x1, x2");
    for (images, drawn) in
        [("half", "\u{2580}"), ("sixel", "\u{1b}P0;1;0q"), ("iterm", "]1337;File="), ("kitty", "\u{1b}_Ga=T")]
    {
        terminal.send_line(format!(":set images {images}")).expect("typed");
        terminal.expect("yont>").expect("a prompt");
        terminal.send_line("gob_b").expect("typed");
        terminal.expect("2-D object of x1, x2").expect("the line");
        answer(&mut terminal, drawn);
    }
    terminal.send(ControlCode::EndOfTransmission).expect("typed");
    terminal.expect(expectrl::Eof).expect("Ctrl-D leaves");
}

#[test]
fn a_pasted_program_works() {
    let state = state();
    let mut terminal = terminal(state.path());
    let program = "r = 2;\n{ A bead\n  to be pasted }\ngob_ball = r**2\n  - x1**2;\nFOR i = 1 TO 3 DO BEGIN\n  r = r + i;\nEND;\nr + 10\n";
    terminal.send(format!("\x1b[200~{program}\x1b[201~\r")).expect("pasted");
    answer(&mut terminal, "18");
    terminal.send_line("gob_ball?").expect("typed");
    answer(&mut terminal, "to be pasted");
    terminal.send(ControlCode::EndOfTransmission).expect("typed");
    terminal.expect(expectrl::Eof).expect("Ctrl-D leaves");
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
