//! Ctrl-C: a run ends with 130 and writes nothing; the prompt goes on.

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use expectrl::{ControlCode, Expect};

use super::cli::folder;
use super::crash::kill;
use super::repl::{answer, state, terminal};

/// Programs that keep each kind of work busy far longer than a test waits, each with what is made of it.
const LONG: &[(&str, &str, &[&str])] = &[
    (
        "a mesh",
        "gob_a = SUM(i = 1 TO 3000, SIN(i*x1)*SIN(i*x2)*SIN(i*x3)) - x1**2;",
        &["-o", "a.stl", "--resolution", "400"],
    ),
    (
        "a picture",
        "gob_a = SUM(i = 1 TO 3000, SIN(i*x1)*SIN(i*x2)*SIN(i*x3)) - x1**2;",
        &["-o", "a.png", "--size", "4000x4000"],
    ),
    (
        "samples",
        "gob_a = SUM(i = 1 TO 9000, SIN(i*x1)*SIN(i*x2)*SIN(i*x3)) - x1**2;",
        &["-o", "a.nrrd", "--resolution", "400"],
    ),
    (
        "searches within each other",
        "gob_a = OFFSET_BALL(PROJECT(PROJECT(SIN(x1*x4) + SIN(x2*x5) - x3**2, x4, 0, 9), x5, 0, 9), 0.5);",
        &["-o", "a.stl", "--resolution", "64"],
    ),
    (
        "a highest value over boxes",
        "gob_a = PROJECT(OFFSET_BALL(PROJECT(SIN(x1*x4) + SIN(x2*x5) - x3**2, x4, 0, 9), 0.5), x5, 0, 9);",
        &["-o", "a.png"],
    ),
    (
        "a question",
        "gob_b = SUM(i = 1 TO 3000, SIN(i*x1)*SIN(i*x2)*SIN(i*x3)) - 1000; d = DISTANCE(gob_b, [9, 9, 9]); gob_a = d - x1**2;",
        &["-o", "a.stl"],
    ),
    ("a loop", "n = 0; i = 0; FOR j = 1 TO 9999999 DO i = i + SIN(j); gob_a = i - x1**2;", &["-o", "a.stl"]),
];
const SPACE: &str = "x1min = -4; x1max = 4; x2min = -4; x2max = 4; x3min = -4; x3max = 4;";

#[test]
fn a_run_that_is_cancelled_ends_with_130_and_writes_nothing() {
    for (what, program, arguments) in LONG {
        let text = format!("{program}\n{SPACE}");
        let folder = folder(&[("a.geo", text.as_bytes())]);
        let child = Command::new(env!("CARGO_BIN_EXE_yont"))
            .arg("a.geo")
            .args(*arguments)
            .current_dir(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("yont starts");
        std::thread::sleep(Duration::from_millis(1500));
        kill(i32::try_from(child.id()).expect("a process number"), "INT");
        let told = Instant::now();
        let output = child.wait_with_output().expect("it ends");
        // It takes a fifth of a second at most where nothing else runs; it would go on for minutes.
        assert!(told.elapsed() < Duration::from_secs(10), "{what}: {:?}", told.elapsed());
        let err = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{what}: {err}");
        assert_eq!(super::cli::names(folder.path()).len(), 1, "{what}: something was written");
        assert!(!err.contains("panicked"), "{what}: {err}");
    }
}

#[test]
fn the_prompt_survives_ctrl_c_in_a_computation() {
    let state = state();
    let mut terminal = terminal(state.path());
    terminal.send_line("a = 7;").expect("typed");
    terminal.expect("yont>").expect("an answer");
    for _ in 0..2 {
        terminal.send_line("SUM(i = 1 TO 9000000, SUM(j = 1 TO 9000000, SIN(i*j)))").expect("typed");
        std::thread::sleep(Duration::from_millis(700));
        terminal.send(ControlCode::EndOfText).expect("typed");
        terminal.expect("yont>").expect("the prompt is back");
    }
    terminal.send_line("a*6").expect("typed");
    answer(&mut terminal, "42");
    terminal.send(ControlCode::EndOfTransmission).expect("typed");
    terminal.expect(expectrl::Eof).expect("Ctrl-D leaves");
}
