//! Every example runs and gives what its first comment says, and so does every block of the manual. Nothing is written to the disk.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Parser;
use yont::cli::arguments::{Cli, Command, Making};
use yont::cli::values::Assignment;
use yont::diagnostic::render::{Colour, human};
use yont::export::Part;
use yont::host::{Host, Memory};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::request::measured::Dimension;
use yont::model::request::{self, Cells, Options, Output};
use yont::model::{Event, Session};
use yont::syntax::Mode;
use yont::vm::Demand;

use crate::session::messages;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples")
}

/// The examples, by name, with their text.
pub fn examples() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = fs::read_dir(folder())
        .expect("a folder of examples")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|e| e == "geo"))
        .map(|path| {
            let name = path.file_name().and_then(|n| n.to_str()).expect("a plain name").to_owned();
            (name, fs::read_to_string(&path).expect("a text"))
        })
        .collect();
    all.sort();
    assert!(all.len() >= 6, "the examples are there");
    all
}

fn teapot() -> Vec<u8> {
    fs::read(folder().join("data/teapot.nrrd")).expect("the teapot is there")
}

/// A session that has accepted the script, and where it writes.
pub fn loaded(name: &str, text: &str) -> (Session, Arc<Memory>) {
    let (session, _, host) = defined(name, text, &[]);
    (session, host)
}

/// A disk with what the examples read: data, and each other.
pub fn disk() -> Arc<Memory> {
    let texts: Vec<(String, String)> =
        examples().into_iter().map(|(name, text)| (format!("examples/{name}"), text)).collect();
    let teapot = teapot();
    let texts = texts.iter().map(|(name, text)| (name.as_str(), text.as_bytes()));
    let files: Vec<(&str, &[u8])> = texts.chain([("examples/data/teapot.nrrd", teapot.as_slice())]).collect();
    Arc::new(Memory::with(&files))
}

/// A session that has accepted the script under the definitions of a command line, what it told, and where it writes.
fn defined(name: &str, text: &str, define: &[Assignment]) -> (Session, Vec<Event>, Arc<Memory>) {
    let host = disk();
    let mut session = Session::new(host.clone(), Limits::default(), Interrupt::default());
    for assignment in define {
        session.set(&assignment.name, &assignment.expression);
    }
    let outcome = session.input(&format!("examples/{name}"), text, Mode::Script);
    assert!(outcome.accepted && outcome.diagnostics.is_empty(), "{name}: {}", messages(&outcome));
    (session, outcome.events, host)
}

fn example(name: &str) -> (Session, Arc<Memory>) {
    let (name, text) = examples().into_iter().find(|e| e.0.starts_with(name)).expect("the example");
    loaded(&name, &text)
}

/// What the comment at the top says under `Run:` and under `Expected:`.
fn said(text: &str) -> (&str, &str) {
    let comment = text.split('}').next().expect("a comment at the top");
    let run = comment.split_once("Run:").unwrap_or_else(|| panic!("it says no Run:\n{comment}")).1;
    run.split_once("Expected:").unwrap_or_else(|| panic!("it says no Expected:\n{comment}"))
}

/// The command lines under `Run:`, each as its words. `the same with` repeats the first with more, or with another `-o`; what
/// follows a comma and a blank, or ` for `, is prose; `(n)` stands for an n in braces, which would end the comment.
pub(crate) fn commands(text: &str) -> Vec<Vec<String>> {
    let mut all: Vec<Vec<String>> = Vec::new();
    for line in said(text).0.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let line = [", ", " for "].iter().fold(line, |line, end| line.split(end).next().unwrap_or(line));
        let line = line.replace("(n)", "{n}");
        let words =
            |line: &str| line.split_whitespace().map(|word| word.trim_matches('"').to_owned()).collect::<Vec<_>>();
        match line.strip_prefix("the same with ") {
            None => all.push(words(&line)),
            Some(more) => {
                let (mut first, more) = (all.first().expect("a command before `the same`").clone(), words(more));
                if let Some(at) = first.iter().position(|word| word == "-o" && more.contains(word)) {
                    first.drain(at..at + 2);
                }
                all.push([first, more].concat());
            }
        }
    }
    all
}

/// The number that follows some words.
fn number_after(text: &str, words: &str) -> Option<f64> {
    let rest = text.split_once(words)?.1.trim_start();
    let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).unwrap_or(rest.len());
    rest[..end].trim_end_matches('.').parse().ok()
}

/// The bytes of what `-o` makes of an object.
fn made(session: &mut Session, host: &Memory, to: &str, options: &Options) -> Vec<Vec<u8>> {
    let output = Output::parse(to, None).expect("an output");
    let written =
        request::write(session, &output, options, &mut Vec::new()).unwrap_or_else(|told| panic!("{to}: {told:?}"));
    written.files.iter().map(|file| host.read(file, usize::MAX).expect("written")).collect()
}

fn coarse(resolution: usize) -> Options {
    let mut options = Options::default();
    options.view.cells = Cells::Along(resolution);
    options.picture.size = Some((48, 36));
    options
}

/// Makes what a command makes, with cells and pixels that a test can wait for.
fn runs_as_said(name: &str, text: &str, words: &[String]) {
    let cli = Cli::try_parse_from(words).unwrap_or_else(|error| panic!("{words:?}: {error}"));
    let (program, making) = (&cli.run.program, &cli.run.making);
    assert_eq!(program.file.as_deref(), Some(Path::new(&format!("examples/{name}"))), "{name} is run as itself");
    let (mut session, _, host) = defined(name, text, &program.define);
    let defaults = yont::model::settings::defaults(&session).expect("settings");
    let mut options = yont::cli::make::options(making, defaults);
    options.view.cells = Cells::Along(32);
    options.picture.size = Some((48, 36));
    for to in &cli.run.output {
        let files = made(&mut session, &host, to, &options);
        assert!(!files.is_empty() && files.iter().all(|file| file.len() > 300), "{words:?}: more than a header");
    }
}

/// The numbers that the comment expects, of the section that its `yont measure` takes, if it has one.
fn measures_as_said(name: &str, text: &str, words: Option<&Vec<String>>) {
    let expected = said(text).1;
    let (volume, euler) = (number_after(expected, "volume ="), number_after(expected, "Euler characteristic"));
    let area = number_after(expected, "the area =");
    if volume.or(euler).or(area).is_none() {
        return;
    }
    let mut making = Making::default();
    let mut define = Vec::new();
    if let Some(words) = words {
        let cli = Cli::try_parse_from(words).unwrap_or_else(|error| panic!("{words:?}: {error}"));
        let Some(Command::Measure(measure)) = cli.command else { panic!("{words:?} does not measure") };
        (making.subject, making.fineness, define) = (measure.subject, measure.fineness, measure.program.define);
    }
    let (mut session, ..) = defined(name, text, &define);
    let defaults = yont::model::settings::defaults(&session).expect("settings");
    let mut view = yont::cli::make::view(&making, &defaults.view);
    view.cells = Cells::Along(making.fineness.resolution.unwrap_or(64));
    let measured = request::measure(&mut session, &view).unwrap_or_else(|e| panic!("{name}: {e:?}"));
    let near = |what: &str, value: f64, error: f64, wanted: f64| {
        let near = (3e-3 * wanted).max(2.0 * error);
        assert!((value - wanted).abs() < near, "{name}: the {what} is {value} (+- {error}), not {wanted}");
    };
    if let (Dimension::Plane(figure), Some(area)) = (&measured.of, area) {
        return near("area", figure.area.value, figure.area.error, area);
    }
    let Dimension::Solid(measures, _) = measured.of else { panic!("{name} is no solid") };
    if let Some(volume) = volume {
        near("volume", measures.volume.value, measures.volume.error, volume);
    }
    if let Some(euler) = euler {
        assert_eq!(measures.topology.euler as f64, euler, "{name}");
    }
}

/// What the comment says is printed, between backquotes.
fn prints_as_said(name: &str, text: &str) {
    let expected: Vec<&str> = said(text).1.split('`').skip(1).step_by(2).collect();
    let (_, events, _) = defined(name, text, &[]);
    let printed: Vec<String> = events
        .into_iter()
        .filter_map(|event| if let Event::Printed(line) = event { Some(line) } else { None })
        .collect();
    assert_eq!(printed, expected, "{name} prints");
}

#[test]
fn every_example_runs_as_it_says() {
    for (name, text) in examples() {
        let commands = commands(&text);
        let is_measure = |words: &&Vec<String>| words[1] == "measure";
        assert_eq!(commands[0][..2], ["yont", &format!("examples/{name}")], "{name} is run as itself");
        for words in commands.iter().filter(|words| !is_measure(words)) {
            runs_as_said(&name, &text, words);
        }
        measures_as_said(&name, &text, commands.iter().find(is_measure));
        prints_as_said(&name, &text);
    }
}

#[test]
fn the_teapot_of_voxels_is_the_sampled_teapot() {
    let (mut session, host) = example("03");
    let files = made(&mut session, &host, "again.nrrd", &coarse(80));
    assert!(files[0] == teapot(), "sampling examples/03_teapot.geo gives other bytes than examples/data/teapot.nrrd");
}

#[test]
fn the_nine_frames_of_the_metamorphosis_are_closed_and_share_one_program() {
    let (mut session, host) = example("04");
    let files = made(&mut session, &host, "frame-{n}.stl", &coarse(32));
    assert_eq!(files.len(), 9, "x4 = 0, 0.5 ... 4");
    assert!(files[0] == files[8], "the last frame is the first");
    let subject = request::subject(&mut session, &coarse(32).view, &Options::default().timing).expect("a subject");
    assert_eq!(subject.moments(), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
    let limits = Limits::default();
    let shape = subject.shape(session.graph(), Demand::Sign, &limits).expect("small");
    let grid = subject.grid(Cells::Along(32), &limits).expect("a grid");
    for (n, moment) in subject.moments().into_iter().enumerate() {
        let frame = subject.at(&shape, moment);
        assert!(Arc::ptr_eq(&frame.program, &shape.program), "the program of frame {n} is the one");
        let mesh = yont::surface::extract(&frame, &grid, &limits, &Interrupt::default()).expect("a mesh").mesh;
        let topology = yont::surface::check::check(&mesh).unwrap_or_else(|fault| panic!("frame {n}: {fault}"));
        assert!(topology.triangles > 500, "frame {n}: {topology:?}");
        let mut bytes = Vec::new();
        yont::export::stl::write(&Part::of("gob_metamorp", &mesh), &mut bytes).expect("memory");
        assert!(bytes == files[n], "frame {n} is what the one program gives");
    }
}

/// The blocks of the manual in a language, each with the line on which it begins.
fn blocks(language: &str) -> Vec<(usize, String)> {
    let manual = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/manual.md");
    let text = fs::read_to_string(manual).expect("the manual is there");
    let mut found: Vec<(usize, String)> = Vec::new();
    let (mut inside, mut wanted) = (false, false);
    for (line, row) in text.lines().enumerate() {
        if let Some(name) = row.strip_prefix("```") {
            inside = !inside;
            wanted = inside && name == language;
            if wanted {
                found.push((line + 1, String::new()));
            }
        } else if wanted && let Some((_, block)) = found.last_mut() {
            block.push_str(row);
            block.push('\n');
        }
    }
    found
}

/// What a block is expected to show: what follows `;` and `//` in a line.
fn expected(block: &str) -> Vec<&str> {
    block.lines().filter_map(|row| Some(row.split_once("; ")?.1.trim().strip_prefix("//")?.trim())).collect()
}

/// Whether a value is the expected one: but for the last digits if it is a number, in its text if it is none.
fn shows(event: &Event, expected: &str) -> Option<bool> {
    match event {
        Event::Value { number: Some(found), .. } if found.is_finite() => Some(
            expected.parse::<f64>().is_ok_and(|expected| (found - expected).abs() <= 1e-12 * expected.abs().max(1.0)),
        ),
        Event::Value { text, .. } | Event::Printed(text) => Some(text == expected),
        Event::Defined(_) => None,
    }
}

fn manual_session() -> Session {
    let host = Memory::with(&[("ramp.dat", blocks("dat")[0].1.as_bytes())]);
    Session::new(Arc::new(host), Limits::default(), Interrupt::default())
}

#[test]
fn every_block_of_the_manual_runs_and_each_value_is_right() {
    let mut compared = 0;
    for (line, block) in blocks("geo") {
        let outcome = manual_session().input("manual.geo", &block, Mode::Script);
        assert!(outcome.accepted, "line {line} of the manual\n{block}\n{}", messages(&outcome));
        let mut expected = expected(&block).into_iter();
        for event in &outcome.events {
            if matches!(event, Event::Defined(_)) {
                continue;
            }
            let value = expected.next().unwrap_or_else(|| panic!("line {line}: nothing is expected of {event:?}"));
            assert_eq!(shows(event, value), Some(true), "line {line}: {event:?}, not {value}");
            compared += 1;
        }
        assert_eq!(expected.next(), None, "line {line}: nothing shows the value");
    }
    assert!(compared > 80, "{compared} values");
}

#[test]
fn what_the_manual_shows_as_wrong_gets_the_messages_that_it_shows() {
    let (wrong, texts) = (blocks("geo wrong"), blocks("text"));
    assert!(!wrong.is_empty() && wrong.len() == texts.len(), "each has its messages");
    for ((line, block), (_, expected)) in wrong.iter().zip(&texts) {
        let mut session = manual_session();
        let outcome = session.input("script.geo", block, Mode::Script);
        let told: String = outcome.diagnostics.iter().map(|d| human(d, session.sources(), Colour::Plain)).collect();
        assert_eq!(told.trim_end(), expected.trim_end(), "line {line} of the manual");
    }
}

#[test]
fn the_prompt_answers_as_the_manual_shows() {
    for (line, block) in blocks("console") {
        let (typed, shown): (Vec<&str>, Vec<&str>) = block.lines().partition(|row| row.starts_with("> "));
        let input: String = typed.iter().map(|row| format!("{}\n", &row[2..])).collect();
        let ran = crate::cli::run(crate::cli::folder(&[]).path(), &[], &input);
        assert_eq!(ran.out.lines().collect::<Vec<_>>(), shown, "line {line} of the manual: {}", ran.err);
    }
}
