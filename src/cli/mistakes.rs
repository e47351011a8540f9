//! What people type by mistake on the command line, and what they probably meant. Only adds words to messages.

use std::ffi::OsString;
use std::path::Path;

use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use crate::host::{Disk, Host};
use crate::model::request::{Format, Kind, Output};

use super::arguments::{Cli, Images, Making, with_near};
use super::text::near;

/// Words of other programs for what a command or an option does here.
const OTHER_WORDS: [(&str, &str); 12] = [
    ("render", "yont FILE -o picture.png"),
    ("mesh", "yont FILE -o mesh.stl"),
    ("export", "yont FILE -o mesh.stl"),
    ("convert", "yont FILE -o mesh.stl"),
    ("build", "yont FILE -o mesh.stl"),
    ("compile", "yont FILE -o mesh.stl"),
    ("show", "yont FILE -o picture.png"),
    ("plot", "yont FILE -o picture.png"),
    ("animate", "yont FILE -o film.gif"),
    ("repl", "yont"),
    ("eval", "yont -e 'CODE'"),
    ("format", "yont fmt FILE"),
];

/// The error with a tip where the mistake is a known one.
#[must_use]
pub fn explained(mut error: clap::Error, arguments: &[OsString]) -> clap::Error {
    let whole = Cli::command();
    let named = arguments.iter().skip(1).filter_map(|word| whole.find_subcommand(word)).next();
    error = with_near(error, named.unwrap_or(&whole));
    if error.kind() != ErrorKind::UnknownArgument {
        return error;
    }
    let Some(ContextValue::String(stray)) = error.get(ContextKind::InvalidArg) else { return error };
    let stray = stray.clone();
    if stray.starts_with('-') {
        return error;
    }
    let first = arguments.get(1).and_then(|word| word.to_str()).unwrap_or_default();
    let extension = Path::new(&stray).extension().and_then(|extension| extension.to_str());
    let tip = match other_command(first) {
        Some(tip) => tip,
        None if extension.and_then(Format::by_extension).is_some() => format!("to write it: -o {stray}"),
        None if stray.contains('=') => format!("to define a name: -D {stray}"),
        None => "one program at a time; a second text of the program is -e 'CODE'".to_owned(),
    };
    error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    error
}

/// What was probably meant by a first word that is neither a command nor a file.
#[must_use]
pub fn other_command(word: &str) -> Option<String> {
    if word.is_empty() || word.starts_with('-') || word.contains(['/', '.']) {
        return None;
    }
    if let Some((_, meant)) = OTHER_WORDS.iter().find(|(other, _)| *other == word) {
        return Some(format!("there is no command `{word}`; it is `{meant}`"));
    }
    let command = Cli::command();
    let name = near(word, command.get_subcommands().map(clap::Command::get_name))?;
    Some(format!("there is no command `{word}`; did you mean `yont {name}`?"))
}

/// A file in the same folder whose name is near that of one that is not there.
#[must_use]
pub fn other_file(file: &Path) -> Option<String> {
    let name = file.file_name()?.to_str()?;
    let folder = file.parent().unwrap_or(Path::new(""));
    let names = Disk.list(folder);
    let programs = names.iter().map(String::as_str).filter(|name| !name.ends_with('/'));
    // `ball` for `ball.geo` is a part of it, and that is what is meant most of all.
    let whole = format!("{name}.geo");
    let found = programs.clone().find(|other| **other == whole).or_else(|| near(name, programs))?;
    Some(folder.join(found).display().to_string())
}

/// Options that change nothing of what is asked for: none of the outputs heeds them.
#[must_use]
pub fn without_effect(making: &Making, outputs: &[Output]) -> Vec<&'static str> {
    let look = &making.look;
    let seen = |output: &Output| {
        matches!(output.format.kind(), Kind::Picture | Kind::Animation) || output.format == Format::ThreeMf
    };
    let viewed = |output: &Output| seen(output) || output.format == Format::Pov;
    let moves = |output: &Output| output.format.kind() == Kind::Animation || output.format == Format::Glb;
    let frames =
        |output: &Output| moves(output) || matches!(output.target, crate::model::request::Target::Series { .. });
    /// An option, whether it was given, and which outputs heed it.
    type Heeded<'a> = (&'static str, bool, &'a dyn Fn(&Output) -> bool);
    let edged = |output: &Output| matches!(output.format.kind(), Kind::Mesh | Kind::Outlines);
    let options: [Heeded<'_>; 8] = [
        ("--sharp", making.fineness.sharp.is_some(), &edged),
        ("--size", look.size.is_some(), &seen),
        ("--camera", look.camera.is_some(), &viewed),
        ("--view", look.view.is_some(), &viewed),
        ("--supersample", look.supersample.is_some(), &seen),
        ("--fps", making.motion.fps.is_some(), &moves),
        ("--frames", making.motion.frames.is_some(), &frames),
        ("--images", making.display.images.is_some_and(|images| images != Images::Off), &|_| false),
    ];
    let idle = |(_, given, heeds): &&Heeded<'_>| *given && !outputs.iter().any(heeds);
    options.iter().filter(idle).map(|(name, ..)| *name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_commands() {
        for (word, expected) in [("chek", "yont check"), ("render", "-o picture.png"), ("mesure", "yont measure")] {
            assert!(other_command(word).is_some_and(|tip| tip.contains(expected)), "{word}");
        }
        assert_eq!(other_command("ball.geo"), None);
        assert_eq!(other_command("zzzzzz"), None);
    }
}
