//! Small pictures on the terminal: which way of drawing it understands, how large they may be. The model makes them.

use std::io::IsTerminal;

use crate::export::terminal::{self, Drawing};
use crate::host::variable;
use crate::model::request;
use crate::model::{Session, settings};
use crate::picture::Image;

use super::arguments::{Images, Making};
use super::console::Console;
use super::make::options;
use super::status::Status;

/// Columns that a picture of half blocks takes at most; rows left for what stands around it.
const COLUMNS: usize = 64;
const ROWS_AROUND: usize = 6;
/// Pixels across and down of a picture that the terminal shows as such.
const PIXELS: [usize; 2] = [480, 360];

/// The way to draw on standard output: the one that was chosen, or one that the environment tells of; none off a terminal.
#[must_use]
pub fn drawing(images: Option<Images>) -> Option<Drawing> {
    match images.unwrap_or_default() {
        Images::Auto if std::io::stdout().is_terminal() => guessed(&variable),
        Images::Auto | Images::Off => None,
        Images::Half => Some(halves(&variable)),
        Images::Kitty => Some(Drawing::Kitty),
        Images::Iterm => Some(Drawing::Iterm),
        Images::Sixel => Some(Drawing::Sixel),
    }
}

type Environment<'a> = &'a dyn Fn(&str) -> Option<String>;

/// What a terminal understands, by what it says of itself. Half blocks are coloured text, so NO_COLOR is heeded.
fn guessed(variable: Environment<'_>) -> Option<Drawing> {
    let term = variable("TERM").unwrap_or_default();
    let program = variable("TERM_PROGRAM").or_else(|| variable("LC_TERMINAL")).unwrap_or_default();
    // A multiplexer stands between, and passes text only.
    let between = variable("TMUX").is_some() || term.starts_with("screen") || term.starts_with("tmux");
    let is = |names: &[&str]| names.iter().any(|name| program == *name);
    match () {
        () if term.is_empty() || term == "dumb" => None,
        () if between => half(variable),
        () if variable("KITTY_WINDOW_ID").is_some() || term == "xterm-kitty" => Some(Drawing::Kitty),
        () if term == "xterm-ghostty" || is(&["ghostty"]) => Some(Drawing::Kitty),
        () if is(&["iTerm.app", "iTerm2", "WezTerm", "mintty"]) => Some(Drawing::Iterm),
        () if term.contains("sixel") || ["foot", "foot-extra", "mlterm", "contour"].contains(&&*term) => {
            Some(Drawing::Sixel)
        }
        () => half(variable),
    }
}

fn half(variable: Environment<'_>) -> Option<Drawing> {
    if variable("NO_COLOR").is_some() { None } else { Some(halves(variable)) }
}

fn halves(variable: Environment<'_>) -> Drawing {
    let says = |name: &str, words: &[&str]| {
        let value = variable(name).unwrap_or_default();
        words.iter().any(|word| value.contains(word))
    };
    let many = says("COLORTERM", &["truecolor", "24bit"]) || says("TERM", &["direct", "kitty"]);
    if many { Drawing::TrueHalves } else { Drawing::Halves }
}

/// Pixels across and down that a picture may have.
fn room(drawing: Drawing) -> [usize; 2] {
    if !matches!(drawing, Drawing::TrueHalves | Drawing::Halves) {
        return PIXELS;
    }
    let (columns, rows) = terminal_size::terminal_size().map_or((80, 24), |(c, r)| (c.0.into(), r.0.into()));
    // Some terminals say that they have no size.
    let columns = if columns == 0 { 80usize } else { columns };
    let rows = if rows == 0 { 24usize } else { rows };
    let width = columns.saturating_sub(1).clamp(8, COLUMNS);
    [width, (2 * rows.saturating_sub(ROWS_AROUND)).clamp(8, width)]
}

/// Draws the object that the options choose.
///
/// # Errors
/// The status of a broken standard output.
pub fn show(console: &Console, session: &mut Session, making: &Making, drawing: Drawing) -> Result<Status, Status> {
    let made = {
        let _progress = console.progress(session.interrupt(), "picture");
        settings::defaults(session)
            .and_then(|defaults| request::preview(session, &options(making, defaults), room(drawing)))
    };
    match made {
        Ok(image) => console.write(|out| terminal::write(&image, drawing, out)).map(|()| Status::Done),
        Err(diagnostics) => Ok(console.report(session.sources(), &diagnostics)),
    }
}

/// Shows a picture that is made already, where the terminal can.
///
/// # Errors
/// The status of a broken standard output.
pub fn image(console: &Console, making: &Making, image: &Image) -> Result<Status, Status> {
    let Some(drawing) = drawing(making.display.images) else { return Ok(Status::Done) };
    let small = request::shrunk(image.clone(), room(drawing));
    console.write(|out| terminal::write(&small, drawing, out)).map(|()| Status::Done)
}

/// Draws an object that nobody asked a picture of, where the terminal can; what cannot be drawn is told in a line.
///
/// # Errors
/// As [`show`]; that of a request to stop.
pub fn glance(console: &Console, session: &mut Session, making: &Making) -> Result<(), Status> {
    let Some(drawing) = drawing(making.display.images) else { return Ok(()) };
    let made = {
        let _progress = console.progress(session.interrupt(), "picture");
        settings::defaults(session)
            .and_then(|defaults| request::preview(session, &options(making, defaults), room(drawing)))
    };
    match made {
        Ok(image) => console.write(|out| terminal::write(&image, drawing, out)),
        Err(told) if Status::of(&told) == Status::Cancelled => Err(console.report(session.sources(), &told)),
        Err(told) => {
            told.iter().take(1).for_each(|told| console.note(&format!("no picture: {}", told.title)));
            Ok(())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_environment_tells_what_a_terminal_understands() {
        use Drawing::{Halves, Iterm, Kitty, Sixel, TrueHalves};
        type Case<'a> = (&'a [(&'a str, &'a str)], Option<Drawing>);
        let cases: &[Case<'_>] = &[
            (&[], None),
            (&[("TERM", "dumb")], None),
            (&[("TERM", "xterm-kitty"), ("KITTY_WINDOW_ID", "1")], Some(Kitty)),
            (&[("TERM", "xterm-ghostty")], Some(Kitty)),
            (&[("TERM", "xterm-256color"), ("TERM_PROGRAM", "iTerm.app")], Some(Iterm)),
            (&[("TERM", "xterm-256color"), ("TERM_PROGRAM", "WezTerm"), ("NO_COLOR", "1")], Some(Iterm)),
            (&[("TERM", "foot"), ("COLORTERM", "truecolor")], Some(Sixel)),
            (&[("TERM", "xterm-256color"), ("COLORTERM", "truecolor")], Some(TrueHalves)),
            (&[("TERM", "xterm-256color")], Some(Halves)),
            (&[("TERM", "xterm-256color"), ("NO_COLOR", "1")], None),
            (&[("TERM", "tmux-256color"), ("TMUX", "x"), ("TERM_PROGRAM", "iTerm.app")], Some(Halves)),
        ];
        for (environment, expected) in cases {
            let variable = |name: &str| environment.iter().find(|pair| pair.0 == name).map(|pair| pair.1.to_owned());
            assert_eq!(guessed(&variable), *expected, "{environment:?}");
        }
    }
}
