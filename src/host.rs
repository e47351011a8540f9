//! The world outside behind one trait: the disk, or a map in memory for tests. The only file that touches `std::fs`.
//!
//! A file is read whole within a limit, and written whole or not at all. Nothing here knows what the bytes mean, and
//! nothing is read or written that the caller did not name.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fmt;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{SystemTime, UNIX_EPOCH};

use crate::diagnostic::{Category, Diagnostic};

/// What writes the content of a file. It is called once and never seeks.
pub type Content<'a> = &'a mut dyn FnMut(&mut dyn Write) -> io::Result<()>;

/// Where files come from and where they go.
pub trait Host: Send + Sync {
    /// The bytes of a file of at most `limit` bytes.
    ///
    /// # Errors
    /// [`FileError`] when there is no such file, when it is a folder, a pipe or a device, when it may not be read, and
    /// when it is larger than `limit`.
    fn read(&self, path: &Path, limit: usize) -> Result<Vec<u8>, FileError>;

    /// Writes a file whole or not at all: whatever fails, what stood there before stands there still and nothing is
    /// left beside it.
    ///
    /// # Errors
    /// [`FileError`] when the folder is missing or may not be written, when the disk is full, or when `content` fails.
    fn write_whole(&self, path: &Path, content: Content<'_>) -> Result<(), FileError>;

    /// One name for a file that is reached by several paths, so that a circle of INCLUDEs is seen.
    fn identity(&self, path: &Path) -> PathBuf;

    /// The names in a folder, sorted, folders with a final `/`; empty if it cannot be read. For completion only.
    fn list(&self, folder: &Path) -> Vec<String>;
}

/// A path that a text or an option names: absolute ones stay, others lie beside `from` (the file that names them).
#[must_use]
pub fn resolve(from: Option<&Path>, path: &Path) -> PathBuf {
    match from.and_then(Path::parent) {
        Some(folder) if path.is_relative() => folder.join(path),
        _ => path.to_path_buf(),
    }
}

/// A path as a file in `folder` would name it: relative ones are made so, unless they lie on another way down; those that cannot be become
/// absolute. Without a folder it stays what it is.
#[must_use]
pub fn seen_from(host: &dyn Host, folder: Option<&Path>, path: &Path) -> PathBuf {
    let Some(folder) = folder.filter(|folder| !folder.as_os_str().is_empty() && *folder != Path::new(".")) else {
        return path.to_path_buf();
    };
    let (folder, whole) = (host.identity(folder), host.identity(path));
    match whole.strip_prefix(&folder) {
        Ok(inside) => inside.to_path_buf(),
        Err(_) if path.is_absolute() => path.to_path_buf(),
        Err(_) => climb(&folder, &whole).unwrap_or(whole),
    }
}

/// The way from a folder up and down to a file, both absolute.
fn climb(folder: &Path, file: &Path) -> Option<PathBuf> {
    let shared = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let ups = folder.components().count() - shared;
    // Only the root in common: the absolute path is the clearer one.
    (shared > 1).then(|| std::iter::repeat_n(Component::ParentDir, ups).chain(file.components().skip(shared)).collect())
}

/// What was being done to the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Doing {
    /// It was being read.
    Reading,
    /// It was being written.
    Writing,
}

/// Why a file could not be read or written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// There is no such file.
    Missing,
    /// The folder that it should lie in does not exist.
    NoFolder,
    /// It is a folder.
    Folder,
    /// It is a pipe, a socket or a device; the text says which.
    Special(&'static str),
    /// The user may not.
    Forbidden,
    /// It is larger than this many bytes.
    TooLarge(usize),
    /// The disk is full.
    Full,
    /// The bytes are not UTF-8; the offset of the first that is not.
    NotText(usize),
    /// The reader at the other end of a pipe has gone.
    Closed,
    /// Anything else, in the words of the system.
    Other(String),
}

/// A file that could not be read or written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file.
    pub path: PathBuf,
    /// What was being done.
    pub doing: Doing,
    /// Why it failed.
    pub reason: Reason,
}

impl FileError {
    /// A failure to read `path`.
    #[must_use]
    pub fn reading(path: &Path, reason: Reason) -> Self {
        Self { path: path.to_path_buf(), doing: Doing::Reading, reason }
    }

    /// A failure to write `path`.
    #[must_use]
    pub fn writing(path: &Path, reason: Reason) -> Self {
        Self { path: path.to_path_buf(), doing: Doing::Writing, reason }
    }

    /// The same as a message for the user, in the category of files.
    #[must_use]
    pub fn diagnostic(&self) -> Diagnostic {
        let code = match self.doing {
            Doing::Reading => "cannot-read",
            Doing::Writing => "cannot-write",
        };
        let diagnostic = Diagnostic::error(code, self.to_string()).category(Category::File);
        match self.help() {
            Some(help) => diagnostic.help(help),
            None => diagnostic,
        }
    }

    fn help(&self) -> Option<&'static str> {
        Some(match (&self.reason, self.doing) {
            (Reason::Missing, _) => {
                "a relative path begins beside the program that names it, or on the command line in the current folder"
            }
            (Reason::NoFolder, _) => "make the folder first, or write to another one",
            (Reason::Folder, _) => "name a file in it",
            (Reason::Special(_), Doing::Reading) => "copy its content into a file, or use `-` for standard input",
            (Reason::Forbidden, Doing::Writing) => "write to a folder of your own",
            (Reason::Full, _) => "make room, or write to another disk; nothing was left behind",
            (Reason::NotText(_), _) => "a program is text; save it as UTF-8",
            _ => return None,
        })
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verb = match self.doing {
            Doing::Reading => "read",
            Doing::Writing => "write",
        };
        write!(f, "cannot {verb} `{}`: ", self.path.display())?;
        match &self.reason {
            Reason::Missing => write!(f, "there is no such file"),
            Reason::NoFolder => write!(f, "its folder does not exist"),
            Reason::Folder => write!(f, "it is a folder"),
            Reason::Special(what) => write!(f, "it is {what}, not a file"),
            Reason::Forbidden => write!(f, "permission denied"),
            Reason::TooLarge(limit) => write!(f, "it is larger than the limit of {limit} bytes"),
            Reason::Full => write!(f, "the disk is full"),
            Reason::NotText(offset) => write!(f, "it is not text: byte {offset} is not UTF-8"),
            Reason::Closed => write!(f, "the pipe was closed at its other end"),
            Reason::Other(words) => write!(f, "{words}"),
        }
    }
}

impl std::error::Error for FileError {}

/// The reason behind an error of the system.
#[must_use]
pub fn reason(error: &io::Error) -> Reason {
    match error.kind() {
        ErrorKind::NotFound => Reason::Missing,
        ErrorKind::IsADirectory => Reason::Folder,
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => Reason::Forbidden,
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => Reason::Full,
        ErrorKind::BrokenPipe => Reason::Closed,
        _ => Reason::Other(error.to_string()),
    }
}

/// All bytes of a stream of at most `limit` bytes; `name` is what messages call it.
///
/// # Errors
/// [`FileError`] when the stream fails or is longer.
pub fn read_stream(name: &Path, stream: &mut dyn Read, limit: usize) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    let most = u64::try_from(limit).unwrap_or(u64::MAX).saturating_add(1);
    stream.take(most).read_to_end(&mut bytes).map_err(|e| FileError::reading(name, reason(&e)))?;
    if bytes.len() > limit {
        return Err(FileError::reading(name, Reason::TooLarge(limit)));
    }
    Ok(bytes)
}

/// A file of any length, to be read line by line; pipes too.
///
/// # Errors
/// [`FileError`] when there is no such file, when it is a folder, and when it may not be read.
pub fn lines(path: &Path) -> Result<Box<dyn io::BufRead>, FileError> {
    let fail = |reason| FileError::reading(path, reason);
    let file = fs::File::open(path).map_err(|e| fail(reason(&e)))?;
    match file.metadata() {
        Ok(metadata) if metadata.is_dir() => Err(fail(Reason::Folder)),
        Ok(_) => Ok(Box::new(io::BufReader::new(file))),
        Err(error) => Err(fail(reason(&error))),
    }
}

/// Bytes as text; a byte order mark in front is dropped.
///
/// # Errors
/// [`Reason::NotText`] with the first byte that is not UTF-8.
pub fn text(name: &Path, bytes: Vec<u8>) -> Result<String, FileError> {
    let mut text = String::from_utf8(bytes)
        .map_err(|e| FileError::reading(name, Reason::NotText(e.utf8_error().valid_up_to())))?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(text)
}

/// The disk.
#[derive(Clone, Copy, Debug, Default)]
pub struct Disk;

impl Host for Disk {
    fn read(&self, path: &Path, limit: usize) -> Result<Vec<u8>, FileError> {
        let fail = |reason| FileError::reading(path, reason);
        let metadata = fs::metadata(path).map_err(|e| fail(reason(&e)))?;
        if let Some(what) = not_a_file(&metadata) {
            return Err(fail(what));
        }
        // The size is asked first, so that a file beyond the limit costs nothing; the stream is bounded as well, since
        // a file may grow while it is read.
        if metadata.len() > limit as u64 {
            return Err(fail(Reason::TooLarge(limit)));
        }
        let mut file = File::open(path).map_err(|e| fail(reason(&e)))?;
        read_stream(path, &mut file, limit)
    }

    fn write_whole(&self, path: &Path, content: Content<'_>) -> Result<(), FileError> {
        // A link is followed, so that the link stays and the file that it names is the one replaced.
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        let result = match fs::metadata(&target).ok().as_ref().and_then(not_a_file) {
            Some(Reason::Folder) => return Err(FileError::writing(path, Reason::Folder)),
            // A pipe or a device takes the bytes as they come: there is nothing to replace.
            Some(_) => write_through(&target, content),
            None => write_beside(&target, content),
        };
        result.map_err(|e| FileError::writing(path, writing_reason(&target, &e)))
    }

    fn identity(&self, path: &Path) -> PathBuf {
        fs::canonicalize(path).unwrap_or_else(|_| normal(path))
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
        let mut names: Vec<String> = entries.flatten().filter_map(|entry| entry_name(&entry)).collect();
        names.sort();
        names
    }
}

fn entry_name(entry: &fs::DirEntry) -> Option<String> {
    let mut name = entry.file_name().into_string().ok()?;
    if entry.path().is_dir() {
        name.push('/');
    }
    Some(name)
}

fn write_through(path: &Path, content: Content<'_>) -> io::Result<()> {
    let mut out = BufWriter::new(OpenOptions::new().write(true).open(path)?);
    content(&mut out)?;
    out.flush()
}

fn write_beside(path: &Path, content: Content<'_>) -> io::Result<()> {
    // Dropped without commit, the file beside vanishes: on Linux it never had a name.
    let mut out = BufWriter::new(atomic_write_file::AtomicWriteFile::open(path)?);
    content(&mut out)?;
    out.into_inner().map_err(io::IntoInnerError::into_error)?.commit()
}

fn writing_reason(path: &Path, error: &io::Error) -> Reason {
    let folder = path.parent().unwrap_or(Path::new(""));
    match reason(error) {
        Reason::Missing if !folder.as_os_str().is_empty() && !folder.is_dir() => Reason::NoFolder,
        _ if error.kind() == ErrorKind::NotADirectory => Reason::NoFolder,
        other => other,
    }
}

fn not_a_file(metadata: &fs::Metadata) -> Option<Reason> {
    if metadata.is_file() {
        None
    } else if metadata.is_dir() {
        Some(Reason::Folder)
    } else {
        Some(Reason::Special(special(metadata.file_type())))
    }
}

#[cfg(unix)]
fn special(kind: fs::FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    if kind.is_fifo() {
        "a pipe"
    } else if kind.is_socket() {
        "a socket"
    } else {
        "a device"
    }
}

#[cfg(not(unix))]
fn special(_: fs::FileType) -> &'static str {
    "a device"
}

/// A path without `.` and `..`, by its words alone.
fn normal(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if result.file_name().is_some() => {
                result.pop();
            }
            other => result.push(other),
        }
    }
    result
}

/// Files in memory, for tests: nothing reaches the disk.
#[derive(Debug, Default)]
pub struct Memory {
    files: Mutex<BTreeMap<PathBuf, Vec<u8>>>,
    room: Option<usize>,
}

impl Memory {
    /// A host that holds these files.
    #[must_use]
    pub fn with(files: &[(&str, &[u8])]) -> Self {
        let files = files.iter().map(|(path, bytes)| (normal(Path::new(path)), bytes.to_vec())).collect();
        Self { files: Mutex::new(files), room: None }
    }

    /// The same with a disk that is full once a file exceeds `room` bytes.
    #[must_use]
    pub fn room(mut self, room: usize) -> Self {
        self.room = Some(room);
        self
    }

    /// The names of all files, sorted.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.files().keys().map(|path| path.display().to_string()).collect()
    }

    // A test that panicked while it held the lock leaves whole files behind, so the map is good.
    fn files(&self) -> MutexGuard<'_, BTreeMap<PathBuf, Vec<u8>>> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Host for Memory {
    fn read(&self, path: &Path, limit: usize) -> Result<Vec<u8>, FileError> {
        let fail = |reason| Err(FileError::reading(path, reason));
        match self.files().get(&normal(path)) {
            None => fail(Reason::Missing),
            Some(bytes) if bytes.len() > limit => fail(Reason::TooLarge(limit)),
            Some(bytes) => Ok(bytes.clone()),
        }
    }

    fn write_whole(&self, path: &Path, content: Content<'_>) -> Result<(), FileError> {
        let fail = |reason| FileError::writing(path, reason);
        let mut bytes = Vec::new();
        content(&mut bytes).map_err(|e| fail(reason(&e)))?;
        if self.room.is_some_and(|room| bytes.len() > room) {
            return Err(fail(Reason::Full));
        }
        self.files().insert(normal(path), bytes);
        Ok(())
    }

    fn identity(&self, path: &Path) -> PathBuf {
        normal(path)
    }

    fn list(&self, folder: &Path) -> Vec<String> {
        let folder = normal(folder);
        let inside = |path: &PathBuf| path.parent() == Some(folder.as_path());
        let name = |path: &PathBuf| path.file_name().and_then(OsStr::to_str).map(str::to_owned);
        self.files().keys().filter(|path| inside(path)).filter_map(name).collect()
    }
}

/// The folder for history and journals: `$XDG_STATE_HOME/yont`, by default `~/.local/state/yont`.
#[must_use]
pub fn state_folder() -> Option<PathBuf> {
    use etcetera::BaseStrategy;
    etcetera::base_strategy::Xdg::new().ok()?.state_dir().map(|folder| folder.join("yont"))
}

/// The folder for settings: `$XDG_CONFIG_HOME/yont`, by default `~/.config/yont`.
#[must_use]
pub fn settings_folder() -> Option<PathBuf> {
    use etcetera::BaseStrategy;
    Some(etcetera::base_strategy::Xdg::new().ok()?.config_dir().join("yont"))
}

/// The value of a variable of the environment; an empty one counts as none.
#[must_use]
pub fn variable(name: &str) -> Option<String> {
    std::env::var_os(name)?.into_string().ok().filter(|value| !value.is_empty())
}

/// Nanoseconds since 1970, to tell files apart by their names. No result depends on it.
#[must_use]
pub fn nanoseconds() -> u128 {
    SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_nanos())
}

/// A file that only grows, one line at a time, each on the disk before the call returns. While it is open, no other
/// process can open it as a [`Journal`].
#[derive(Debug)]
pub struct Journal {
    file: File,
    path: PathBuf,
}

impl Journal {
    /// Opens or creates the journal, with its folders.
    ///
    /// # Errors
    /// [`FileError`] when it cannot be opened, or when another process holds it.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        let fail = |e: io::Error| FileError::writing(path, reason(&e));
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).map_err(fail)?;
        }
        let file = OpenOptions::new().append(true).create(true).open(path).map_err(fail)?;
        match file.try_lock() {
            Ok(()) => Ok(Self { file, path: path.to_path_buf() }),
            Err(_) => Err(FileError::writing(path, Reason::Other("another session holds it".into()))),
        }
    }

    /// Adds a line, which must not contain a line break, and waits until the disk has it.
    ///
    /// # Errors
    /// [`FileError`] when the disk is full or gone.
    pub fn append(&mut self, line: &str) -> Result<(), FileError> {
        // One write, so that a process that dies leaves the line whole or its tail torn, never two lines mixed.
        let written = self.file.write_all(format!("{line}\n").as_bytes()).and_then(|()| self.file.sync_data());
        written.map_err(|e| FileError::writing(&self.path, reason(&e)))
    }

    /// Ends the journal and takes it off the disk.
    pub fn remove(self) {
        // A journal that cannot be removed is offered again at the next start, which does no harm.
        let _ = fs::remove_file(&self.path);
    }
}

/// Appends one line to a file that several processes may share, and waits until the disk has it.
///
/// # Errors
/// [`FileError`] when it cannot be written.
pub fn append_line(path: &Path, line: &str) -> Result<(), FileError> {
    let fail = |e: io::Error| FileError::writing(path, reason(&e));
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(fail)?;
    }
    let mut file = OpenOptions::new().append(true).create(true).open(path).map_err(fail)?;
    // The line break in front keeps this line whole when a process died in the middle of the one before.
    file.write_all(format!("\n{line}\n").as_bytes()).and_then(|()| file.sync_data()).map_err(fail)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failing(out: &mut dyn Write) -> io::Result<()> {
        out.write_all(&[0; 100_000])?;
        Err(io::Error::from(ErrorKind::StorageFull))
    }

    #[test]
    fn a_failed_write_leaves_what_was_there_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.txt");
        for old in [None, Some(b"old".to_vec())] {
            if let Some(bytes) = &old {
                Disk.write_whole(&path, &mut |out| out.write_all(bytes)).expect("room");
            }
            let error = Disk.write_whole(&path, &mut failing).expect_err("no room");
            assert_eq!((error.reason, error.doing), (Reason::Full, Doing::Writing));
            assert_eq!(Disk.read(&path, 10).ok(), old);
            assert_eq!(Disk.list(folder.path()).len(), usize::from(old.is_some()));
        }
    }

    #[test]
    #[cfg(unix)]
    fn a_link_stays_and_its_file_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").expect("room");
        std::os::unix::fs::symlink(&file, &link).expect("room");
        Disk.write_whole(&link, &mut |out| out.write_all(b"new")).expect("room");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
        assert_eq!(fs::read(&file).expect("there"), b"new");
        assert_eq!(Disk.identity(&link), Disk.identity(&file));
    }

    #[test]
    fn both_hosts_read_within_the_limit_and_say_why_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("four");
        fs::write(&path, "1234").expect("room");
        let memory = Memory::with(&[(path.to_str().expect("a plain name"), b"1234")]);
        for host in [&Disk as &dyn Host, &memory] {
            assert_eq!(host.read(&path, 4).as_deref(), Ok(b"1234".as_slice()));
            assert_eq!(host.read(&path, 3).map_err(|e| e.reason), Err(Reason::TooLarge(3)));
            assert_eq!(host.read(&folder.path().join("five"), 3).map_err(|e| e.reason), Err(Reason::Missing));
            assert_eq!(host.list(folder.path()), ["four"]);
        }
        let small = Memory::default().room(3);
        assert!(small.write_whole(&path, &mut |out| out.write_all(b"1234")).is_err_and(|e| e.reason == Reason::Full));
        assert!(small.names().is_empty());
    }

    #[test]
    fn paths_lie_beside_the_file_that_names_them() {
        let from = |from: Option<&str>, path: &str| resolve(from.map(Path::new), Path::new(path));
        assert_eq!(from(Some("d/a.geo"), "b.geo"), Path::new("d/b.geo"));
        assert_eq!(from(Some("a.geo"), "b.geo"), Path::new("b.geo"));
        assert_eq!(from(Some("d/a.geo"), "/b.geo"), Path::new("/b.geo"));
        assert_eq!(from(None, "b.geo"), Path::new("b.geo"));
        assert_eq!(Memory::default().identity(Path::new("./a/../b.geo")), Path::new("b.geo"));
    }

    #[test]
    fn text_is_utf8_without_a_mark() {
        let read = |bytes: &[u8]| text(Path::new("a"), bytes.to_vec());
        assert_eq!(read(b"\xef\xbb\xbfa = 1;"), Ok("a = 1;".into()));
        assert_eq!(read(b"ab\xff").map_err(|e| e.reason), Err(Reason::NotText(2)));
    }
}
