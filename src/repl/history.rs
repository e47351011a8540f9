//! What was typed: a history that keeps failed inputs too, and a journal from which a killed session comes back.
//!
//! Both are appended to and on the disk before the prompt returns. Only a history that has grown long is written anew, whole,
//! at a start.
//! Without a folder for state, a session goes on without either.

use std::path::{Path, PathBuf};

use crate::host::{Disk, FileError, Host, Journal, append_line, nanoseconds};

/// Inputs that the arrow keys reach.
pub const HISTORY: usize = 10_000;
/// Bytes of a history or journal that are read back.
const MOST: usize = 1 << 30;
/// Bytes of an input from which the history does not keep it; the journal does.
const LONGEST: usize = 16 << 10;

/// The history and the journal of one session.
#[derive(Debug, Default)]
pub struct Memory {
    folder: Option<PathBuf>,
    journal: Option<Journal>,
}

/// An earlier session that ended without being left.
#[derive(Debug)]
pub struct Lost {
    /// What it had accepted, oldest first.
    pub inputs: Vec<String>,
    journal: Journal,
}

impl Lost {
    /// Takes the journal off the disk, once its inputs live in another one.
    pub fn forget(self) {
        self.journal.remove();
    }
}

impl Memory {
    /// The memory in `folder`; the journal appears with the first accepted input.
    #[must_use]
    pub fn in_folder(folder: Option<PathBuf>) -> Self {
        Self { folder, journal: None }
    }

    /// The inputs of earlier sessions, oldest first.
    #[must_use]
    pub fn history(&self) -> Vec<String> {
        let Some(folder) = &self.folder else { return Vec::new() };
        let path = folder.join("history");
        let mut inputs = lines(&path);
        let grown = inputs.len() > 4 * HISTORY;
        inputs.drain(..inputs.len().saturating_sub(HISTORY));
        if grown {
            // A history that cannot be shortened stays long, and is as good.
            let _ = Disk
                .write_whole(&path, &mut |out| inputs.iter().try_for_each(|input| writeln!(out, "{}", encoded(input))));
        }
        inputs
    }

    /// Keeps an input for the arrow keys, whether it succeeded or not.
    ///
    /// # Errors
    /// [`FileError`] when the history cannot be written.
    pub fn typed(&self, input: &str) -> Result<(), FileError> {
        match &self.folder {
            Some(_) if input.len() > LONGEST => Ok(()),
            Some(folder) => append_line(&folder.join("history"), &encoded(input)),
            None => Ok(()),
        }
    }

    /// Keeps an accepted input, so that it survives whatever happens to this process.
    ///
    /// # Errors
    /// [`FileError`] when the journal cannot be written.
    pub fn accepted(&mut self, input: &str) -> Result<(), FileError> {
        let Some(folder) = &self.folder else { return Ok(()) };
        if self.journal.is_none() {
            self.journal = Some(Journal::open(&folder.join("sessions").join(new_name()))?);
        }
        match &mut self.journal {
            Some(journal) => journal.append(&encoded(input)),
            None => Ok(()),
        }
    }

    /// The newest session that ended without being left. One that still runs holds its journal and is not found.
    #[must_use]
    pub fn lost(&self) -> Option<Lost> {
        let folder = self.folder.as_ref()?.join("sessions");
        let names = Disk.list(&folder).into_iter().rev().filter(|name| name.ends_with(".journal"));
        for name in names {
            let path = folder.join(name);
            if let Ok(journal) = Journal::open(&path) {
                let inputs = lines(&path);
                if !inputs.is_empty() {
                    return Some(Lost { inputs, journal });
                }
                journal.remove();
            }
        }
        None
    }

    /// The session was left by its user: its journal is no longer needed.
    pub fn left(self) {
        if let Some(journal) = self.journal {
            journal.remove();
        }
    }
}

fn encoded(input: &str) -> String {
    serde_json::Value::from(input).to_string()
}

/// The inputs in a file; a line that was torn by a process that died is passed over.
fn lines(path: &Path) -> Vec<String> {
    let bytes = Disk.read(path, MOST).unwrap_or_default();
    let text = String::from_utf8_lossy(&bytes);
    text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

/// Sorts by time; the process number keeps two sessions of one instant apart.
fn new_name() -> String {
    let now = nanoseconds();
    format!("{now:024}-{}.journal", std::process::id())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn memory(folder: &tempfile::TempDir) -> Memory {
        Memory::in_folder(Some(folder.path().join("yont")))
    }

    #[test]
    fn a_killed_session_is_found_and_a_running_or_left_one_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut first = memory(&folder);
        first.accepted("r = 1;\n// two lines").expect("room");
        assert!(memory(&folder).lost().is_none(), "it still runs");
        drop(first);
        let lost = memory(&folder).lost().expect("a lost session");
        assert_eq!(lost.inputs, ["r = 1;\n// two lines"]);
        lost.forget();
        assert!(memory(&folder).lost().is_none(), "it was forgotten");
        let mut second = memory(&folder);
        second.accepted("r = 2;").expect("room");
        second.left();
        assert!(memory(&folder).lost().is_none(), "it was left");
    }

    #[test]
    fn a_torn_line_costs_itself_only() {
        let folder = tempfile::tempdir().expect("a folder");
        let memory = memory(&folder);
        memory.typed("a").expect("room");
        let path = folder.path().join("yont/history");
        let torn = [Disk.read(&path, 100).expect("a history"), b"\"b".to_vec()].concat();
        Disk.write_whole(&path, &mut |out| out.write_all(&torn)).expect("room");
        memory.typed("c").expect("room");
        assert_eq!(memory.history(), ["a", "c"]);
    }
}
