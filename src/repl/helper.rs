//! What the line editor asks while a line is typed: colours, completions, and whether the input is finished.

use std::borrow::Cow;
use std::path::Path;

use rustyline::completion::{Completer, Pair};
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::Hinter;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Context, Helper};

use crate::builtins;
use crate::cli::arguments::{option_names, option_values};
use crate::host::{Disk, Host};
use crate::limits::Limits;
use crate::model::carving::TOOLS;
use crate::source::SourceMap;
use crate::syntax::scan::RESERVED;
use crate::syntax::{self, Mode};

use super::commands::{self, Argument};
use super::look::{Look, partner, pieces};

/// Inputs beyond this many bytes are not coloured while they are typed, nor searched for their end: a pasted file
/// would be scanned anew with each key.
const MOST: usize = 64 << 10;

/// The helper of the editor.
#[derive(Debug, Default)]
pub struct Assistant {
    /// The user's own names, and those of the library.
    pub names: Vec<String>,
    /// Whether to colour.
    pub colour: bool,
}

impl Helper for Assistant {}

impl Hinter for Assistant {
    type Hint = String;
}

impl Validator for Assistant {
    fn validate(&self, context: &mut ValidationContext) -> rustyline::Result<ValidationResult> {
        let input = context.input();
        Ok(if is_incomplete(input) { ValidationResult::Incomplete } else { ValidationResult::Valid(None) })
    }
}

/// Whether Enter goes on: a bracket, a comment or a block is open.
#[must_use]
pub fn is_incomplete(input: &str) -> bool {
    if input.trim().is_empty() || input.trim_start().starts_with(':') || input.trim_end().ends_with('?') {
        return false;
    }
    let mut sources = SourceMap::default();
    let id = sources.add("", input);
    syntax::parse(&sources, id, &Limits::default(), Mode::Prompt).incomplete
}

impl Highlighter for Assistant {
    fn highlight<'l>(&self, line: &'l str, position: usize) -> Cow<'l, str> {
        if !self.colour || line.len() > MOST {
            return Cow::Borrowed(line);
        }
        let matching = partner(line, position);
        let coloured = |(look, range): (Look, std::ops::Range<usize>)| {
            let colour = if Some(range.start) == matching { "1;7" } else { colour(look) };
            let text = &line[range];
            if colour.is_empty() { text.to_owned() } else { format!("\x1b[{colour}m{text}\x1b[0m") }
        };
        Cow::Owned(pieces(line).into_iter().map(coloured).collect())
    }

    fn highlight_prompt<'b, 's: 'b, 'p: 'b>(&'s self, prompt: &'p str, _default: bool) -> Cow<'b, str> {
        if self.colour { Cow::Owned(format!("\x1b[1;32m{prompt}\x1b[0m")) } else { Cow::Borrowed(prompt) }
    }

    fn highlight_char(&self, line: &str, _position: usize, _kind: CmdKind) -> bool {
        self.colour && line.len() <= MOST
    }
}

fn colour(look: Look) -> &'static str {
    match look {
        Look::Comment => "2",
        Look::Text => "32",
        Look::Number => "36",
        Look::Keyword => "1;35",
        Look::Builtin => "34",
        Look::Coordinate => "33",
        Look::Object => "1",
        Look::Plain => "",
    }
}

impl Completer for Assistant {
    type Candidate = Pair;

    fn complete(&self, line: &str, position: usize, _: &Context<'_>) -> rustyline::Result<(usize, Vec<Pair>)> {
        let before = &line[..position];
        let (start, candidates) = self.candidates(before);
        Ok((start, candidates.into_iter().map(|word| Pair { display: word.clone(), replacement: word }).collect()))
    }
}

impl Assistant {
    /// Where the word at the end of `before` starts, and what it may become.
    #[must_use]
    pub fn candidates(&self, before: &str) -> (usize, Vec<String>) {
        if let Some(quote) = open_quote(before) {
            return files(before, quote + 1);
        }
        if let Some(rest) = before.trim_start().strip_prefix(':') {
            let start = before.len() - rest.len();
            return match rest.find(char::is_whitespace) {
                None => (start, starting(commands::TABLE.iter().map(|command| command.name), rest)),
                Some(end) => self.argument(before, &rest[..end]),
            };
        }
        self.word(before)
    }

    fn argument(&self, before: &str, command: &str) -> (usize, Vec<String>) {
        let start = before.rfind(char::is_whitespace).map_or(0, |i| i + 1);
        let word = &before[start..];
        let words: Vec<&str> = before[..start].split_whitespace().skip(1).collect();
        match commands::find(command).map(|command| command.completes) {
            Some(Argument::File) => files(before, start),
            Some(Argument::Command) => {
                let (from, mut found) = self.word(before);
                if from == start {
                    found.splice(0..0, starting(commands::TABLE.iter().map(|c| c.name), word));
                }
                (from, found)
            }
            Some(Argument::Name) => self.word(before),
            Some(Argument::Tool) => {
                let (from, mut found) = self.word(before);
                if from == start && words.is_empty() {
                    found.splice(0..0, starting(TOOLS.iter().map(|tool| tool.name), word));
                }
                (from, found)
            }
            Some(Argument::NameAndFile) if words.is_empty() => self.word(before),
            Some(Argument::NameAndFile) => files(before, start),
            Some(Argument::FileAndOptions) => match words.last().and_then(|last| last.strip_prefix("--")) {
                _ if word.starts_with('-') => {
                    let typed = word.trim_start_matches('-');
                    let names = options(typed).into_iter().map(|name| format!("--{name}"));
                    (start, names.collect())
                }
                Some(option) => (start, values(option, word)),
                None => files(before, start),
            },
            Some(Argument::Option) => match words[..] {
                [] => (start, options(word)),
                [option] => (start, values(option.trim_start_matches('-'), word)),
                _ => (before.len(), Vec::new()),
            },
            Some(Argument::None) | None => (before.len(), Vec::new()),
        }
    }

    /// The user's names and the library's first, as they are written; keywords and built-ins in any case.
    fn word(&self, before: &str) -> (usize, Vec<String>) {
        let start = before.rfind(|c: char| !c.is_alphanumeric() && c != '_').map_or(0, |i| i + width(&before[i..]));
        let word = &before[start..];
        if word.is_empty() {
            return (start, Vec::new());
        }
        let mut found = starting(self.names.iter().map(String::as_str), word);
        let words =
            RESERVED.into_iter().chain(["PI", "INFINITY"]).chain(builtins::all().flat_map(builtins::Builtin::names));
        found.extend(starting(words, &word.to_ascii_uppercase()));
        found.dedup();
        (start, found)
    }
}

fn width(text: &str) -> usize {
    text.chars().next().map_or(0, char::len_utf8)
}

fn starting<'a>(words: impl Iterator<Item = &'a str>, beginning: &str) -> Vec<String> {
    words.filter(|word| word.starts_with(beginning)).map(str::to_owned).collect()
}

fn options(beginning: &str) -> Vec<String> {
    starting(option_names().iter().map(String::as_str), beginning)
}

fn values(option: &str, beginning: &str) -> Vec<String> {
    starting(option_values(option).iter().map(String::as_str), beginning)
}

/// The place of a `"` that is not closed.
fn open_quote(text: &str) -> Option<usize> {
    let (look, range) = pieces(text).pop()?;
    let piece = &text[range.clone()];
    (look == Look::Text && (piece.len() == 1 || !piece.ends_with('"'))).then_some(range.start)
}

fn files(before: &str, start: usize) -> (usize, Vec<String>) {
    let typed = &before[start..];
    let (folder, beginning) = typed.rfind('/').map_or(("", typed), |i| typed.split_at(i + 1));
    let names = Disk.list(Path::new(folder));
    (start + folder.len(), starting(names.iter().map(String::as_str), beginning))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_commands_and_files_complete() {
        let assistant = Assistant { names: vec!["gob_ball".into(), "height".into()], colour: false };
        for (before, expected) in [
            ("gob_m = 1 + gob_b", "gob_ball"),
            ("hei", "height"),
            ("whi", "WHILE"),
            ("a = sqr", "SQRT"),
            (":he", "help"),
            (":deps gob_", "gob_ball"),
            (":help dep", "deps"),
            (":load src/rep", "repl/"),
            ("INCLUDE \"src/li", "lib.rs"),
            (":set res", "resolution"),
            (":set view to", "top"),
            (":set images ki", "kitty"),
            (":mesh a.stl --res", "--resolution"),
            (":render a.png --palette mo", "mono"),
            (":render src/re", "repl/"),
            (":formula gob_", "gob_ball"),
            (":formula gob_ball src/li", "lib.rs"),
            (":help gob_", "gob_ball"),
        ] {
            let (start, found) = assistant.candidates(before);
            assert!(found.iter().any(|word| word == expected), "{before}: {found:?}");
            assert!(start <= before.len());
        }
        assert!(assistant.candidates("a + ").1.is_empty());
    }

    #[test]
    fn enter_goes_on_while_something_is_open() {
        for (input, open) in [
            ("a = (1 +", true),
            ("{ comment", true),
            ("WHILE (i < 3) DO BEGIN", true),
            ("a = 1", false),
            ("a = )", false),
            (":load (", false),
            ("a?", false),
            ("", false),
        ] {
            assert_eq!(is_incomplete(input), open, "{input}");
        }
    }

    #[test]
    fn colours_change_no_character() {
        let assistant = Assistant { names: Vec::new(), colour: true };
        for line in ["gob_a = (x1 + 1.5) & SIN(é); // ≤", "({\"", ""] {
            let painted = assistant.highlight(line, 8.min(line.len()));
            let plain =
                painted.split('\x1b').map(|p| p.strip_prefix('[').map_or(p, |p| p.split_once('m').map_or("", |s| s.1)));
            assert_eq!(plain.collect::<String>(), line);
        }
    }
}
