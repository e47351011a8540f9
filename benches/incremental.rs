//! How much faster an answer is after one parameter of a hundred parts was changed than in a session that keeps nothing. One run
//! alternates both and prints medians: `cargo bench --bench incremental`; a number after `--` is how many rounds.

#![allow(clippy::print_stdout)]

use std::sync::Arc;
use std::time::{Duration, Instant};

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, Coordinate, Format, Options, Output};
use yont::syntax::Mode;

/// A hundred balls, rods and blocks in ten rows, each with a radius of its own.
fn part() -> String {
    let mut text = String::from("r_alpha = 0; x1min = -1; x1max = 1; x2min = -1; x2max = 1; x3min = -1; x3max = 1;\n");
    let mut whole = String::from("gob_part = (0.9 - ABS(x1)) & (0.9 - ABS(x2)) & (0.02 - ABS(x3 + 0.3))");
    for k in 0..100 {
        let [x, y] = [k % 10, k / 10].map(|i| f64::from(i) * 0.18 - 0.81);
        text += &format!("r{k} = 0.06; ");
        text += &match k % 3 {
            0 => format!("gob_{k} = r{k}**2 - (x1 - {x})**2 - (x2 - {y})**2 - (x3 + 0.2)**2;\n"),
            1 => format!("gob_{k} = (r{k}**2 - (x1 - {x})**2 - (x2 - {y})**2) & (0.2 - ABS(x3 + 0.2));\n"),
            _ => format!("gob_{k} = (r{k} - ABS(x1 - {x})) & (r{k} - ABS(x2 - {y})) & (r{k} - ABS(x3 + 0.3));\n"),
        };
        whole += if k % 7 == 6 { " \\ " } else { " | " };
        whole += &format!("gob_{k}");
    }
    text + &whole + ";"
}

fn session(reuse_bytes: usize) -> Session {
    let limits = Limits { reuse_bytes, ..Limits::default() };
    let mut session = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
    assert!(session.input("part.geo", &part(), Mode::Script).accepted);
    session
}

/// A change and the answer that follows it.
fn edit(session: &mut Session, radius: f64, format: &str, cells: usize) -> (Duration, Vec<u8>) {
    let begun = Instant::now();
    assert!(session.input("edit", &format!("r44 = {radius};"), Mode::Prompt).accepted);
    let mut options = Options::default();
    options.view.cells = Cells::Along(cells);
    options.picture.size = Some((800, 600));
    if format == "svg" {
        options.view.at.push((Coordinate(3), -0.25));
    }
    let output = Output::parse("-", Format::by_extension(format)).expect("a format");
    let mut bytes = Vec::new();
    request::write(session, &output, &options, &mut bytes).expect("an answer");
    (begun.elapsed(), bytes)
}

fn median(times: &mut [Duration]) -> f64 {
    times.sort_unstable();
    times[times.len() / 2].as_secs_f64() * 1e3
}

fn main() {
    let rounds = std::env::args().find_map(|word| word.parse().ok()).unwrap_or(15);
    let rounds = if std::env::args().any(|word| word == "--test") { 1 } else { rounds };
    println!("| after one of 100 parts changed | fresh, ms | with what was kept, ms | times faster | kept |");
    println!("|---|---|---|---|---|");
    for (name, format, cells) in [
        ("mesh, 128 cells, to STL", "stl", 128),
        ("mesh, 256 cells, to STL", "stl", 256),
        ("picture 800x600", "png", 128),
        ("outlines, 512 cells, to SVG", "svg", 512),
    ] {
        let (mut fresh, mut kept) = (session(0), session(Limits::default().reuse_bytes));
        edit(&mut kept, 0.06, format, cells);
        let (mut without, mut with, mut words) = (Vec::new(), Vec::new(), String::new());
        for round in 0..rounds {
            // Never the same radius twice: no answer is kept whole.
            let radius = 0.05 + 0.0003 * f64::from(round);
            let (time, bytes) = edit(&mut fresh, radius, format, cells);
            without.push(time);
            kept.interrupt().reset();
            let (time, same) = edit(&mut kept, radius, format, cells);
            with.push(time);
            assert!(bytes == same, "{name}: other bytes");
            words = kept.interrupt().costs().kept.to_string();
        }
        let (without, with) = (median(&mut without), median(&mut with));
        println!("| {name} | {without:.1} | {with:.1} | {:.1} | {words} |", without / with);
    }
}
