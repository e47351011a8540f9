//! The commands that look at what is defined and change nothing: `:show`, `:explain`, `:formula`, `:time`; and `:reset`. They ask the
//! model and show its answers.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

use crate::cli::arguments::Images;
use crate::cli::show;
use crate::host::{Disk, Host};

use super::Repl;
use super::commands::{Flow, unquoted};

/// Characters of a formula that are shown; a longer one goes into a file.
const SHOWN: usize = 4_000;

/// `:show [NAME]`
pub fn show(repl: &mut Repl, name: &str) -> Flow {
    let images = repl.making.display.images;
    let Some(drawing) = show::drawing(images) else {
        return match images {
            Some(Images::Off) => repl.refuse("pictures are off: `:set images auto`, or `:render FILE.png`"),
            _ => {
                repl.refuse("this terminal shows no pictures: `:set images half` tries, `:render FILE.png` writes one")
            }
        };
    };
    let making = repl.looking_at(name);
    let shown = show::show(&repl.console, &mut repl.session, &making, drawing);
    repl.ended(shown)
}

/// `:explain NAME`
pub fn explain(repl: &mut Repl, name: &str) -> Flow {
    match repl.session.explain(name) {
        Ok(words) => repl.show(&words),
        Err(told) => Flow::Failed(repl.console.report(repl.session.sources(), &told)),
    }
}

/// `:formula NAME [FILE]`
pub fn formula(repl: &mut Repl, argument: &str) -> Flow {
    let (name, file) = argument.split_once(char::is_whitespace).unwrap_or((argument, ""));
    let file = Some(unquoted(file.trim())).filter(|file| !file.is_empty()).map(Path::new);
    let formula = match repl.session.formula(name, file.and_then(Path::parent)) {
        Ok(formula) => formula,
        Err(told) => return Flow::Failed(repl.console.report(repl.session.sources(), &told)),
    };
    if formula.rewritten {
        repl.console.note("several systems of R-functions: those that differ are written out, equal but for rounding");
    }
    if let Some(file) = file {
        let content = formula.text + "\n";
        return match Disk.write_whole(file, &mut |out| out.write_all(content.as_bytes())) {
            Ok(()) => repl.told(&format!("wrote {}", file.display())),
            Err(error) => Flow::Failed(repl.console.file_error(&error)),
        };
    }
    match formula.text.char_indices().nth(SHOWN) {
        None => repl.show(&formula.text),
        Some((end, _)) => {
            let more = formula.text.len() - end;
            repl.console.note(&format!("{more} more bytes; `:formula {name} FILE` writes it whole"));
            repl.show(&format!("{} ...", &formula.text[..end]))
        }
    }
}

/// `:time`
pub fn time(repl: &mut Repl, _: &str) -> Flow {
    let Some((whole, costs)) = &repl.costs else { return repl.refuse("nothing was typed yet") };
    let mut text = String::new();
    for (name, time) in costs.phases.iter().chain([&("in all", *whole)]) {
        let _ = writeln!(text, "{name:<8} {:>12}", milliseconds(*time));
    }
    let counts: Vec<String> = costs.counts.iter().map(|(name, count)| format!("{count} {name}")).collect();
    if !counts.is_empty() {
        let how = if costs.kept.is_nothing() { "evaluated" } else { "in all, what was kept included" };
        let _ = writeln!(text, "{} {how}", counts.join(", "));
    }
    if !costs.kept.is_nothing() {
        let _ = writeln!(text, "kept from before: {}", costs.kept);
    }
    repl.show(text.trim_end())
}

fn milliseconds(time: Duration) -> String {
    format!("{:.3} ms", time.as_secs_f64() * 1e3)
}

/// `:reset`
pub fn reset(repl: &mut Repl, _: &str) -> Flow {
    let count = repl.session.names().len();
    repl.session.reset();
    repl.last = None;
    repl.comments.clear();
    repl.changed(&format!("forgot {count} definitions; `:undo` brings them back"))
}
