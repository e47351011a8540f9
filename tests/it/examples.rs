//! Every example runs and gives what its first comment says, and so does every block of the manual. Nothing is written to the disk.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

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
    let host = Arc::new(Memory::with(&[("examples/data/teapot.nrrd", &teapot())]));
    let mut session = Session::new(host.clone(), Limits::default(), Interrupt::default());
    let outcome = session.input(&format!("examples/{name}"), text, Mode::Script);
    assert!(outcome.accepted && outcome.diagnostics.is_empty(), "{name}: {}", messages(&outcome));
    (session, host)
}

fn example(name: &str) -> (Session, Arc<Memory>) {
    let (name, text) = examples().into_iter().find(|e| e.0.starts_with(name)).expect("the example");
    loaded(&name, &text)
}

/// The rest of the line of the first comment that begins so.
fn said<'a>(text: &'a str, what: &str) -> &'a str {
    let comment = text.split('}').next().expect("a comment at the top");
    let line = comment.lines().map(str::trim).find_map(|line| line.strip_prefix(what));
    line.unwrap_or_else(|| panic!("the first comment says no {what}\n{comment}")).trim()
}

/// The number that follows some words.
fn number_after(text: &str, words: &str) -> Option<f64> {
    let rest = text.split_once(words)?.1.trim_start();
    let end = rest.find(|c: char| !(c.is_ascii_digit() || "+-.".contains(c))).unwrap_or(rest.len());
    rest[..end].parse().ok()
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

#[test]
fn every_example_runs_as_it_says() {
    for (name, text) in examples() {
        let (mut session, host) = loaded(&name, &text);
        let words: Vec<&str> = said(&text, "Run:").split_whitespace().collect();
        assert_eq!(words[..3], ["yont", &format!("examples/{name}"), "-o"], "{name} is run as itself");
        let files = made(&mut session, &host, words[3], &coarse(32));
        assert!(files.len() == 1 && files[0].len() > 500, "{name}: {} is more than a header", words[3]);
        let expected = said(&text, "Expected:");
        let claims = ["volume", "Euler characteristic"].map(|what| expected.contains(what));
        if claims.contains(&true) {
            let measured = request::measure(&mut session, &coarse(64).view).unwrap_or_else(|e| panic!("{name}: {e:?}"));
            let Dimension::Solid(measures, _) = measured.of else { panic!("{name} is no solid") };
            if claims[0] {
                let volume = number_after(expected, "=").expect("volume ... = number");
                assert!((measures.volume.value / volume - 1.0).abs() < 3e-3, "{name}: {:?}", measures.volume);
            }
            if claims[1] {
                let euler = number_after(expected, "Euler characteristic").expect("a number");
                assert_eq!(measures.topology.euler as f64, euler, "{name}");
            }
        }
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

#[test]
fn every_block_of_the_manual_runs_and_each_value_is_right() {
    let mut compared = 0;
    for (line, block) in blocks("geo") {
        let host = Memory::with(&[("ramp.dat", blocks("dat")[0].1.as_bytes())]);
        let mut session = Session::new(Arc::new(host), Limits::default(), Interrupt::default());
        let outcome = session.input("manual.geo", &block, Mode::Script);
        assert!(outcome.accepted, "line {line} of the manual\n{block}\n{}", messages(&outcome));
        let found: Vec<f64> = outcome
            .events
            .iter()
            .filter_map(|event| match event {
                Event::Value { number, text, .. } => Some(number.unwrap_or_else(|| panic!("line {line}: {text}"))),
                _ => None,
            })
            .collect();
        let value = |row: &str| row.split_once("; ")?.1.trim().strip_prefix("//")?.trim().parse::<f64>().ok();
        let expected: Vec<f64> = block.lines().filter_map(value).collect();
        assert_eq!(found.len(), expected.len(), "line {line}: a value for each bare expression\n{block}\n{found:?}");
        for (found, expected) in found.iter().zip(&expected) {
            assert!(
                (found - expected).abs() <= 1e-12 * expected.abs().max(1.0),
                "line {line}: {found}, not {expected}"
            );
        }
        compared += found.len();
    }
    assert!(compared > 20, "{compared} values");
}
