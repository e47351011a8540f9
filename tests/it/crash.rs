//! What survives a process that is killed: accepted inputs, and the files that it was about to replace.

use std::fs;
use std::process::{Command, Stdio};

use expectrl::process::unix::WaitStatus;
use expectrl::{ControlCode, Expect};

use super::cli::folder;
use super::repl::{answer, state, terminal};

/// A ball with waves: enough work for a mesh to be under way for a while.
const SLOW: &str = "gob_waves = 9 - x1**2 - x2**2 - x3**2 + 0.1*SUM(i = 1 TO 60, SIN(i*x1)*SIN(i*x2)*SIN(i*x3));
x1min = -4; x1max = 4; x2min = -4; x2max = 4; x3min = -4; x3max = 4;\n";

#[test]
fn accepted_inputs_survive_a_kill() {
    let state = state();
    let mut killed = terminal(state.path());
    for input in ["a = 40;", "b = a + 2;", "b = SIN(1, 2);"] {
        killed.send_line(input).expect("typed");
        killed.expect("yont>").expect("an answer");
    }
    kill(killed.get_process().pid().as_raw(), "KILL");
    assert!(matches!(killed.get_process().wait(), Ok(WaitStatus::Signaled(..))));
    let mut next = terminal(state.path());
    next.send_line(":recover").expect("typed");
    answer(&mut next, "2 inputs are back");
    next.send_line("b + 100").expect("typed");
    answer(&mut next, "142");
    next.send(ControlCode::EndOfTransmission).expect("typed");
    next.expect(expectrl::Eof).expect("Ctrl-D leaves");
    let mut last = terminal(state.path());
    last.send_line(":recover").expect("typed");
    last.expect("no session was lost").expect("the one that was left is not offered again");
}

#[test]
fn a_killed_run_leaves_the_old_file_or_the_new_one() {
    let folder = folder(&[("a.geo", SLOW.as_bytes()), ("a.stl", b"precious")]);
    for pause in [50, 200, 800, 1600] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_yont"))
            .args(["a.geo", "-o", "a.stl", "--resolution", "160"])
            .current_dir(folder.path())
            .stderr(Stdio::null())
            .spawn()
            .expect("yont starts");
        std::thread::sleep(std::time::Duration::from_millis(pause));
        // It may have ended before.
        let _ = child.kill();
        child.wait().expect("it ends");
        let bytes = fs::read(folder.path().join("a.stl")).expect("the file stands");
        let whole = bytes.len() > 84 && bytes.len() == 84 + 50 * count(&bytes);
        assert!(bytes == b"precious" || whole, "after {pause} ms: {} bytes", bytes.len());
        assert_eq!(super::cli::names(folder.path()).len(), 2, "something was left beside it");
    }
}

fn count(stl: &[u8]) -> usize {
    u32::from_le_bytes([stl[80], stl[81], stl[82], stl[83]]) as usize
}

/// Sends a signal to a process of this test.
pub(crate) fn kill(process: i32, signal: &str) {
    let sent = Command::new("kill").args([&format!("-{signal}"), &process.to_string()]).status();
    assert!(sent.is_ok_and(|status| status.success()), "kill is part of every Unix");
}
