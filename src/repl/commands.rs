//! The commands of the prompt: ONE table, from which `:help`, completion and near names derive.

use std::path::Path;

use crate::cli::arguments::{Making, option_names};
use crate::cli::{make, session, status::Status, text};
use crate::host::{Disk, Host};
use crate::model::request::{FORMATS, Kind, Output};
use crate::{builtins, cli};

use super::{Repl, asks, carve};

/// One command.
#[derive(Debug)]
pub struct Command {
    /// Its name, without the colon.
    pub name: &'static str,
    /// Its arguments, as `:help` shows them.
    pub arguments: &'static str,
    /// What it does, in one line.
    pub help: &'static str,
    /// What its argument is, for completion.
    pub completes: Argument,
    action: fn(&mut Repl, &str) -> Flow,
}

/// What an argument names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// Nothing that could be completed.
    None,
    /// A name of the program or of a built-in.
    Name,
    /// A file.
    File,
    /// A name, then a file.
    NameAndFile,
    /// A file, then options with their values.
    FileAndOptions,
    /// An option without its dashes, then its value.
    Option,
    /// A tool for carving.
    Tool,
    /// A command.
    Command,
}

/// Whether the prompt goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// It worked; the session did not change.
    Go,
    /// It worked, and the session changed: the line belongs into the journal.
    Changed,
    /// It failed.
    Failed(Status),
    /// The user leaves.
    Leave,
}

/// All commands, in the order of `:help`.
pub static TABLE: &[Command] = &[
    command("help", "[NAME]", "this list, or what NAME is", Argument::Command, help),
    command("list", "", "every definition in one line", Argument::None, list),
    command("doc", "NAME", "the documentation and the signature of NAME", Argument::Name, doc),
    command("deps", "NAME", "what NAME reads, and what reads NAME", Argument::Name, deps),
    command("show", "[NAME]", "a small picture of an object, here", Argument::Name, asks::show),
    command(
        "explain",
        "NAME",
        "coordinates and types, bounds, route, R-functions in force, facts",
        Argument::Name,
        asks::explain,
    ),
    command(
        "formula",
        "NAME [FILE]",
        "NAME as one expression, without other names; here or in a file",
        Argument::NameAndFile,
        asks::formula,
    ),
    command("undo", "", "take back the last input", Argument::None, undo),
    command("redo", "", "take back the last :undo", Argument::None, redo),
    command("reset", "", "forget all definitions; :undo brings them back", Argument::None, asks::reset),
    command("load", "FILE", "run a program here", Argument::File, load),
    command("save", "FILE", "write all definitions as a program that runs", Argument::File, save),
    command("mesh", "FILE [OPTION...]", "write a mesh: .stl .obj .ply .glb .3mf .pov", Argument::FileAndOptions, mesh),
    command(
        "render",
        "FILE [OPTION...]",
        "write a picture, outlines or an animation: .png .svg .gif .apng",
        Argument::FileAndOptions,
        render,
    ),
    command("measure", "[NAME]", "volume, area, centroid and more of an object", Argument::Name, measure),
    command(
        "set",
        "[OPTION VALUE]",
        "keep an option for what follows, as in :set resolution 64 or :set resolution default; alone, show them",
        Argument::Option,
        set,
    ),
    command("at", "[xN=VALUE]...", "look at a section; without a value, at the whole", Argument::None, at),
    command(
        "carve",
        "NAME [FILE.png] [OPTION...]",
        "take NAME as a workpiece and draw it; each stroke draws it again, into the file or here",
        Argument::NameAndFile,
        carve::carve,
    ),
    command(
        "tool",
        "[NAME [SIZE...] [depth=..] [blend=..] [turn=..]]",
        "take a tool: one of the set, or an object of your own; alone, show the set",
        Argument::Tool,
        carve::tool,
    ),
    command(
        "cut",
        "PLACE...",
        "carve: take away at pixels X,Y, lines of them X,Y..X,Y, or points [x1, x2, x3]",
        Argument::None,
        carve::cut,
    ),
    command("raise", "PLACE...", "chase: add there", Argument::None, carve::raise),
    command(
        "pick",
        "PLACE",
        "the point of the workpiece that a pixel X,Y shows, and its normal",
        Argument::None,
        carve::pick,
    ),
    command("time", "", "how long the last input took, phase by phase", Argument::None, asks::time),
    command("recover", "", "run the inputs of a session that was killed", Argument::None, recover),
    command("quit", "", "leave", Argument::None, |_, _| Flow::Leave),
];

const fn command(
    name: &'static str,
    arguments: &'static str,
    help: &'static str,
    completes: Argument,
    action: fn(&mut Repl, &str) -> Flow,
) -> Command {
    Command { name, arguments, help, completes, action }
}

/// The command of that name, or the only one that starts so.
#[must_use]
pub fn find(name: &str) -> Option<&'static Command> {
    if let Some(exact) = TABLE.iter().find(|command| command.name == name) {
        return Some(exact);
    }
    let mut starting = TABLE.iter().filter(|command| !name.is_empty() && command.name.starts_with(name));
    starting.next().filter(|_| starting.next().is_none())
}

/// The command that a line calls, if it starts with a colon.
#[must_use]
pub fn called(line: &str) -> Option<&'static Command> {
    find(line.strip_prefix(':')?.split_whitespace().next()?)
}

/// Does what a line that starts with a colon says.
pub fn run(repl: &mut Repl, line: &str) -> Flow {
    let line = line.trim().trim_start_matches(':');
    let (name, argument) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let argument = argument.trim().trim_end_matches(';').trim_end();
    match find(name) {
        Some(command) if command.arguments.is_empty() && !argument.is_empty() => {
            repl.refuse(&format!("`:{}` takes no argument", command.name))
        }
        Some(command)
            if !command.arguments.is_empty() && !command.arguments.starts_with('[') && argument.is_empty() =>
        {
            repl.refuse(&format!("`:{} {}` needs its argument", command.name, command.arguments))
        }
        Some(command) => (command.action)(repl, argument),
        None => repl.refuse(&unknown(name)),
    }
}

/// Words of other programs for what a command does here.
const OTHER_WORDS: [(&str, &str); 16] = [
    ("exit", "quit"),
    ("bye", "quit"),
    ("open", "load"),
    ("run", "load"),
    ("write", "save"),
    ("export", "mesh"),
    ("plot", "show"),
    ("draw", "show"),
    ("view", "show"),
    ("picture", "render"),
    ("ls", "list"),
    ("vars", "list"),
    ("clear", "reset"),
    ("info", "explain"),
    ("type", "explain"),
    ("expand", "formula"),
];

/// The command that was meant by a line without its colon: `help`, `exit()`, `load ball.geo`.
#[must_use]
pub fn without_colon(line: &str) -> Option<String> {
    let plain = line.trim_end_matches([';', ' ']).trim_end_matches("()");
    if plain == "?" {
        return Some(":help".into());
    }
    let (word, rest) = plain.split_once(char::is_whitespace).unwrap_or((plain, ""));
    let name =
        TABLE.iter().map(|command| command.name).chain(["exit", "bye", "ls", "vars", "clear"]).find(|n| *n == word)?;
    let name = OTHER_WORDS.iter().find(|other| other.0 == name).map_or(name, |other| other.1);
    let said = rest.trim_start();
    let words =
        said.is_empty() || said.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '"' | '.' | '/' | '_'));
    words.then(|| format!(":{name} {said}").trim_end().to_owned())
}

fn unknown(name: &str) -> String {
    if let Some((_, meant)) = OTHER_WORDS.iter().find(|(other, _)| *other == name) {
        return format!("there is no command `:{name}`; it is `:{meant}`");
    }
    match text::near(name, TABLE.iter().map(|command| command.name)) {
        Some(other) => format!("there is no command `:{name}`; did you mean `:{other}`?"),
        None => format!("there is no command `:{name}`; `:help` lists them"),
    }
}

fn help(repl: &mut Repl, name: &str) -> Flow {
    let name = name.trim_start_matches(':');
    if name.is_empty() {
        return repl.show(&overview());
    }
    match find(name).filter(|_| !repl.session.is_defined(name)) {
        Some(command) => repl.show(&line(command, 0)),
        None => doc(repl, name),
    }
}

fn overview() -> String {
    let width = TABLE.iter().map(|command| usage(command).len()).max().unwrap_or(0);
    let lines: Vec<String> = TABLE.iter().map(|command| line(command, width)).collect();
    format!(
        "A statement defines, an expression shows its value. `NAME?` explains a name, `NAME??` shows its definition,\n\
         `_` is the last value. Ctrl-C cancels, Ctrl-D leaves.\n\n{}",
        lines.join("\n")
    )
}

fn usage(command: &Command) -> String {
    format!(":{} {}", command.name, command.arguments).trim_end().to_owned()
}

fn line(command: &Command, width: usize) -> String {
    format!("{:width$}  {}", usage(command), command.help)
}

/// `:doc NAME`, `NAME?`.
pub fn doc(repl: &mut Repl, name: &str) -> Flow {
    if repl.session.is_defined(name) {
        let doc = repl.session.doc(name).unwrap_or_else(|| "No comment stands right above its definition.".into());
        let doc: Vec<String> = doc.lines().map(|line| format!("    {}", line.trim())).collect();
        return repl.show(&format!("{}\n{}", repl.session.describe(name), doc.join("\n")));
    }
    match text::known(name, repl.session.library()) {
        Some(told) => repl.show(&told),
        None => unknown_name(repl, name),
    }
}

/// `NAME??`.
pub fn definition(repl: &mut Repl, name: &str) -> Flow {
    match repl.session.definition(name) {
        Some(source) => repl.show(&source),
        None => match repl.session.library().and_then(|library| library.definition(name)) {
            Some(source) => repl.show(source),
            None => doc(repl, name),
        },
    }
}

fn unknown_name(repl: &mut Repl, name: &str) -> Flow {
    let names = repl.all_names();
    let candidates = builtins::all().flat_map(builtins::Builtin::names).map(|known: &str| known);
    let near = text::near(name, names.iter().map(String::as_str).chain(candidates))
        .map(|other| format!("; did you mean `{other}`?"))
        .unwrap_or_default();
    repl.refuse(&format!("`{name}` is not defined{near}"))
}

fn list(repl: &mut Repl, _: &str) -> Flow {
    let lines = repl.session.definitions();
    if lines.is_empty() { repl.show("nothing is defined yet") } else { repl.show(&lines.join("\n")) }
}

fn deps(repl: &mut Repl, name: &str) -> Flow {
    let Some(deps) = repl.session.deps(name) else { return unknown_name(repl, name) };
    let words = |names: &[String]| if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
    repl.show(&format!("{name} reads {}\nread by {}", words(&deps.reads), words(&deps.readers)))
}

fn undo(repl: &mut Repl, _: &str) -> Flow {
    match repl.session.undo() {
        Some(text) => repl.changed(&format!("took back: {}", first_line(&text))),
        None => repl.refuse("there is nothing to take back"),
    }
}

fn redo(repl: &mut Repl, _: &str) -> Flow {
    match repl.session.redo() {
        Some(text) => repl.changed(&format!("again: {}", first_line(&text))),
        None => repl.refuse("there is nothing to do again"),
    }
}

fn first_line(text: &str) -> String {
    let mut lines = text.trim().lines();
    let first = lines.next().unwrap_or("").to_owned();
    if lines.next().is_some() { first + " ..." } else { first }
}

fn load(repl: &mut Repl, file: &str) -> Flow {
    match session::read_text(Path::new(unquoted(file))) {
        Ok(text) => repl.feed(unquoted(file), &text, crate::syntax::Mode::Script),
        Err(error) => Flow::Failed(session::unread_program(&repl.console, Path::new(unquoted(file)), &error)),
    }
}

fn save(repl: &mut Repl, file: &str) -> Flow {
    let path = Path::new(unquoted(file));
    let text = repl.session.save_in(path.parent());
    match Disk.write_whole(path, &mut |out| out.write_all(text.as_bytes())) {
        Ok(()) => repl.told(&format!("wrote {}", path.display())),
        Err(error) => Flow::Failed(repl.console.file_error(&error)),
    }
}

/// A file name without the quotes around it.
pub fn unquoted(file: &str) -> &str {
    file.strip_prefix('"').and_then(|file| file.strip_suffix('"')).unwrap_or(file)
}

fn mesh(repl: &mut Repl, argument: &str) -> Flow {
    let wanted = |kind| kind == Kind::Mesh;
    make_file(repl, argument, wanted, &format!(":mesh writes {}; :render writes pictures", extensions(wanted)))
}

fn render(repl: &mut Repl, argument: &str) -> Flow {
    let wanted = |kind| matches!(kind, Kind::Picture | Kind::Animation | Kind::Outlines);
    make_file(repl, argument, wanted, &format!(":render writes {}; :mesh writes meshes", extensions(wanted)))
}

/// The extensions of the formats that hold such things.
fn extensions(wanted: fn(Kind) -> bool) -> String {
    let all = FORMATS.iter().filter(|format| wanted(format.3)).map(|format| format!(".{}", format.1));
    all.collect::<Vec<_>>().join(" ")
}

fn make_file(repl: &mut Repl, argument: &str, wanted: fn(Kind) -> bool, otherwise: &str) -> Flow {
    let (file, options) =
        argument.split_once(" --").map_or((argument, ""), |(file, _)| (file, &argument[file.len()..]));
    let making = match repl.making.with(options) {
        Ok(making) => making,
        Err(words) => return repl.refuse(&words),
    };
    match Output::parse(unquoted(file.trim()), None) {
        Err(words) => repl.refuse(&words),
        Ok(output) if !wanted(output.format.kind()) => repl.refuse(otherwise),
        Ok(output) => {
            let made = make::make(&repl.console, &mut repl.session, &making, &output);
            repl.ended(made)
        }
    }
}

fn measure(repl: &mut Repl, name: &str) -> Flow {
    let making = repl.looking_at(name);
    let made = cli::inspect::measure_one(&repl.console, &mut repl.session, &making, false);
    repl.ended(made)
}

fn set(repl: &mut Repl, argument: &str) -> Flow {
    if argument.is_empty() {
        return repl.show(&told(&repl.making));
    }
    let option = argument.trim_start_matches('-');
    let (name, value) = option.split_once(['=', ' ']).map_or((option, ""), |(name, value)| (name, value.trim()));
    let set = match value {
        "" => repl.making.with(&format!("--{name}")),
        "default" if option_names().iter().any(|known| known == name) => without(&repl.making, name),
        _ => repl.making.with(&format!("--{name}={value}")),
    };
    match set {
        Ok(making) => {
            repl.making = making;
            Flow::Changed
        }
        Err(words) => repl.refuse(&words),
    }
}

/// The options with one of them as if it had never been set.
fn without(making: &Making, name: &str) -> Result<Making, String> {
    let others = settings(making).into_iter().filter(|(other, _)| *other != name);
    let words =
        others.map(|(other, value)| if value.is_empty() { format!("--{other}") } else { format!("--{other}={value}") });
    Making::default().with(&words.collect::<Vec<_>>().join(" "))
}

fn told(making: &Making) -> String {
    let lines: Vec<String> =
        settings(making).into_iter().map(|(name, value)| format!("{name} {value}").trim_end().to_owned()).collect();
    if lines.is_empty() { "every option has its default".into() } else { lines.join("\n") }
}

/// The options that are set and their values, which read back to the same options.
fn settings(making: &Making) -> Vec<(&'static str, String)> {
    let mut all = Vec::new();
    let mut say = |name, value: Option<String>| all.extend(value.map(|value| (name, value)));
    say("object", (!making.subject.object.is_empty()).then(|| making.subject.object.join(",")));
    say("resolution", making.fineness.resolution.map(|n| n.to_string()));
    say("cell", making.fineness.cell.map(|length| length.to_string()));
    let switch = |switch: cli::arguments::Switch| if switch.is_on() { "on" } else { "off" }.to_owned();
    say("precision", making.fineness.precision.map(|numbers| format!("{numbers:?}").to_lowercase()));
    say("sharp", making.fineness.sharp.map(switch));
    say("route", making.way.along.route.clone());
    say("guide", making.way.guide.as_ref().map(ToString::to_string));
    say("center", making.way.along.center.as_ref().map(ToString::to_string));
    say("size", making.look.size.map(|size| format!("{}x{}", size.width, size.height)));
    say("view", making.look.view.clone());
    say("camera", making.look.camera.as_ref().map(ToString::to_string));
    say("palette", making.look.palette.clone());
    say("supersample", making.look.supersample.map(|n| n.to_string()));
    say("axes", making.look.axes.then(String::new));
    say("projection", making.look.projection.map(|rays| format!("{rays:?}").to_lowercase()));
    say("light", making.look.light.map(|[around, above]| format!("{around},{above}")));
    say("fill", making.look.fill.map(switch));
    say("no-shadow", making.look.no_shadow.then(String::new));
    say("shadow", making.look.shadow.map(switch));
    say("occlusion", making.look.occlusion.map(switch));
    say("background", making.look.background.map(|ground| ground.to_string()));
    say(
        "slices",
        making.look.slices.map(|slices| format!("x{}={}:{}:{}", slices.coordinate, slices.lo, slices.hi, slices.count)),
    );
    say("images", making.display.images.map(|images| format!("{images:?}").to_lowercase()));
    say("frames", making.motion.frames.map(|n| n.to_string()));
    say("fps", making.motion.fps.map(|n| n.to_string()));
    for cut in &making.look.cut {
        say("cut", Some(cut.to_string()));
    }
    for section in &making.subject.at {
        say("at", Some(format!("x{}={}", section.coordinate, section.value)));
    }
    for extent in &making.subject.bounds {
        say("bounds", Some(format!("x{}={}:{}", extent.coordinate, extent.lo, extent.hi)));
    }
    all
}

fn at(repl: &mut Repl, argument: &str) -> Flow {
    let sections = argument.split([' ', ',']).filter(|word| !word.is_empty()).map(cli::values::section);
    match sections.collect::<Result<Vec<_>, _>>() {
        Ok(sections) => {
            repl.making.subject.at = sections;
            Flow::Changed
        }
        Err(words) => repl.refuse(&words),
    }
}

fn recover(repl: &mut Repl, _: &str) -> Flow {
    let Some(lost) = repl.lost.take() else { return repl.refuse("no session was lost") };
    for input in &lost.inputs {
        repl.take(input);
    }
    let count = lost.inputs.len();
    lost.forget();
    repl.told(&format!("{count} inputs are back"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_is_found_by_its_beginning() {
        let name = |beginning: &str| find(beginning).map(|command| command.name);
        assert_eq!(name("undo"), Some("undo"));
        assert_eq!(name("mes"), Some("mesh"));
        assert_eq!(name("me"), None, "`me` is mesh and measure");
        assert_eq!([name(""), name("nonsense")], [None, None]);
    }

    /// Each option with a value of its own, in an order in which none takes another back.
    const SET: [(&str, &str); 30] = [
        ("object", "gob_a,gob_b"),
        ("at", "x4=0.5"),
        ("bounds", "x1=-1:2.5"),
        ("cell", "0.25"),
        ("resolution", "16"),
        ("precision", "single"),
        ("sharp", "on"),
        ("route", "cubes"),
        ("guide", "cube:3"),
        ("center", "-1,0,0.5"),
        ("size", "32x16"),
        ("view", "top"),
        ("camera", "-35,24"),
        ("projection", "perspective"),
        ("light", "-10,40"),
        ("fill", "off"),
        ("no-shadow", ""),
        ("shadow", "off"),
        ("occlusion", "on"),
        ("background", "white"),
        ("cut", "x1<0.5"),
        ("palette", "viridis"),
        ("supersample", "2"),
        ("axes", ""),
        ("slices", "x3=-1:1:5"),
        ("images", "half"),
        ("frames", "7"),
        ("fps", "12.5"),
        ("palette", "mono"),
        ("cell", "0.5"),
    ];

    #[test]
    fn every_option_that_is_set_is_listed_and_reads_back() {
        for name in option_names() {
            let (_, value) =
                SET.iter().find(|(known, _)| *known == name).unwrap_or_else(|| panic!("no value of {name}"));
            let plain = Making::default();
            let set = plain.with(format!("--{name}={value}").trim_end_matches('=')).expect(&name);
            let listed = settings(&set);
            assert_eq!(listed.len(), 1, "{name}: {listed:?}");
            let (told, value) = &listed[0];
            assert_eq!(
                plain.with(format!("--{told}={value}").trim_end_matches('=')).map(|read| settings(&read)),
                Ok(listed.clone())
            );
            assert_eq!(without(&set, told), Ok(plain), "{name}");
        }
        let together = SET.iter().try_fold(Making::default(), |making, (name, value)| {
            making.with(format!("--{name}={value}").trim_end_matches('='))
        });
        let listed = settings(&together.expect("options"));
        // The view gave way to the camera, the resolution to the cell, the one word about shadows to the other.
        assert_eq!(listed.len(), option_names().len() - 3, "{listed:?}");
    }

    #[test]
    fn options_are_laid_over_each_other() {
        let making = Making::default().with("--resolution 64 --view top").expect("options");
        assert_eq!(making.fineness.resolution, Some(64));
        let making = making.with("--cell 0.5").expect("options");
        assert_eq!((making.fineness.cell, making.fineness.resolution), (Some(0.5), None));
        assert_eq!(told(&making), "cell 0.5\nview top");
        let words = making.with("--resolution much").expect_err("no number");
        assert!(words.contains("`much` is not a whole number"), "{words}");
    }
}
