//! What there is to say of a boundary besides the boundary itself: that the space cuts it, that the function is undefined somewhere, that
//! details fell between the sample points, that nothing or everything is inside. Makes the messages, and finds nothing out.

use crate::diagnostic::{Category, Diagnostic};
use crate::surface::detail::{Detail, Kind};
use crate::surface::grid::MOST_CELLS;
use crate::surface::marching::Report;
use crate::surface::sampler::Counters;

use super::space::{at, here, plain};
use super::subject::Subject;

/// What to do when a sign may be the wrong way round.
pub(super) const SIGN: &str =
    "inside is where the function is >= 0: if it is written with inside negative, put `-` before it";

/// All that a report gives cause for.
pub(super) fn of_report(subject: &Subject, report: &Report) -> Vec<Diagnostic> {
    let mut told = Vec::new();
    told.extend(undefined(subject, &report.counters));
    if report.full {
        let title = format!("`{}` fills the whole modelling space: its function is nowhere < 0 there", subject.name);
        let all = Diagnostic::warning("fills-space", title).fact(space(subject)).help(SIGN);
        told.push(here(all.help("if the object is larger than the space, widen it with --bounds"), subject));
    } else {
        told.extend(cut(subject, &report.cut));
    }
    told.extend(details(subject, &report.details));
    told
}

/// Points where the function has no value.
pub(super) fn undefined(subject: &Subject, counters: &Counters) -> Option<Diagnostic> {
    if counters.undefined == 0 {
        return None;
    }
    let place: Vec<String> = counters.example.iter().flatten().map(|c| format!("{c:.6}")).collect();
    let title = format!("`{}` is undefined at {} of the evaluated points", subject.name, counters.undefined);
    let fact = format!("one of them is ({}); undefined points count as outside", place.join(", "));
    let mut told = Diagnostic::warning("undefined-points", title).fact(fact);
    if counters.regions.endless > 0 {
        told = told
            .fact(format!("{} times a loop took more turns than it may, and was given up", counters.regions.endless))
            .help("bound its turns: `WHILE (n < 100 AND ...) DO BEGIN ... n = n + 1; END`");
    }
    Some(told)
}

/// The faces of the modelling space beyond which the object goes on.
pub(super) fn cut(subject: &Subject, cut: &[[bool; 2]; 3]) -> Option<Diagnostic> {
    let mut faces = Vec::new();
    for (k, (axis, sides)) in subject.axes.iter().zip(cut).enumerate() {
        for (side, (cut, which)) in sides.iter().zip(["min", "max"]).enumerate() {
            if *cut && !subject.cut[k][side] {
                faces.push(format!("{}{which} = {}", axis.coordinate, axis.range[side]));
            }
        }
    }
    if faces.is_empty() {
        return None;
    }
    let all = faces.len() == 2 * subject.axes.len();
    let title = format!("the modelling space cuts `{}` at {}", subject.name, faces.join(", "));
    let told = Diagnostic::note("cut-by-space", title)
        .help("it is closed there; widen the space if the object was to be whole");
    Some(if all { told.help(SIGN) } else { told })
}

/// What moves is told of at one moment.
pub(super) fn first_moment(subject: &Subject) -> Option<Diagnostic> {
    let time = subject.time.as_ref().filter(|time| time.values.len() > 1)?;
    let (c, first) = (time.coordinate, time.values[0]);
    let title = format!("this is at {c} = {first}, the first of {} frames", time.values.len());
    Some(Diagnostic::note("first-frame", title).help(format!("--at {c}=... chooses another moment")))
}

/// Half the resolution shows other parts, holes or tunnels.
pub(super) fn unsettled(subject: &Subject) -> Diagnostic {
    let title = format!("half the resolution gives `{}` other components, tunnels or holes", subject.name);
    Diagnostic::note("unsettled-topology", title)
        .fact("some of its details are about as small as the cells: the topology may change again with finer ones")
        .help("compare with a larger --resolution")
}

/// What the grid is too coarse to show.
fn details(subject: &Subject, details: &[Detail]) -> Vec<Diagnostic> {
    let first = |sheet: bool| details.iter().find(|d| (d.kind == Kind::Sheet) == sheet);
    let mut told = Vec::new();
    if let Some(detail) = first(false) {
        let what = if detail.kind == Kind::Hole { "a hole" } else { "a part" };
        let title = format!(
            "`{}` has details between the sample points, which are lost: {what} near {}",
            subject.name,
            place(subject, detail)
        );
        told.push(finer(Diagnostic::warning("lost-detail", title), subject, detail));
    }
    if let Some(detail) = first(true) {
        let title = format!("`{}` has no thickness near {}", subject.name, place(subject, detail));
        told.push(
            Diagnostic::warning("no-thickness", title)
                .fact("its function reaches 0 there and no more: what is shown there is as thick as the sampling makes it")
                .help("give it a thickness: add a small number to that part of the function"),
        );
    }
    told
}

fn place(subject: &Subject, detail: &Detail) -> String {
    at(subject, &detail.place[..subject.axes.len()])
}

/// How wide a detail is, and what shows it.
fn finer(told: Diagnostic, subject: &Subject, detail: &Detail) -> Diagnostic {
    let longest = subject.bounds().iter().map(|[lo, hi]| hi - lo).fold(0.0, f64::max);
    let told = told.fact(format!("it is about {} wide there", plain(rounded(detail.width))));
    // A ball holds a sample point if a cell's diagonal is no longer than its diameter.
    let cells = longest / detail.width * (subject.axes.len() as f64).sqrt();
    let cells = rounded(1.1 * cells).ceil();
    if cells <= MOST_CELLS as f64 {
        told.help(format!("--resolution {cells} shows it, or --bounds about it"))
    } else {
        told.help("--bounds about it shows it")
    }
}

/// Two digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

fn space(subject: &Subject) -> String {
    let space: Vec<String> = subject
        .axes
        .iter()
        .map(|a| format!("{} {} to {}", a.coordinate, plain(a.range[0]), plain(a.range[1])))
        .collect();
    format!("the modelling space is {}", space.join(", "))
}

/// An object that has points, none of which is shown: exit status 1. `found` is how far it reaches along each axis.
pub(super) fn unseen(
    subject: &Subject,
    moment: Option<f64>,
    found: &[[[f64; 2]; 2]],
    report: Option<&Report>,
) -> Diagnostic {
    if report.is_some_and(|report| report.details.iter().any(|d| d.kind == Kind::Part)) {
        return empty(subject, moment, report);
    }
    let name = &subject.name;
    let reaches: Vec<String> = subject
        .axes
        .iter()
        .zip(found)
        .map(|(axis, [[lo, _], [_, hi]])| format!("{} {} to {}", axis.coordinate, plain(*lo), plain(*hi)))
        .collect();
    let told = Diagnostic::error(
        "empty-object",
        match report {
            Some(_) => format!("no sample point is inside `{name}`, which is smaller than a cell"),
            None => format!("nothing of `{name}` is seen in this picture"),
        },
    );
    let told =
        told.category(Category::Result).fact(space(subject)).fact(format!("it lies within {}", reaches.join(", ")));
    here(
        match report {
            Some(_) => told.help("give a larger --resolution, or --bounds about it"),
            None => told.help("give a larger --size or --bounds about it; or another --camera, if it looks past it"),
        },
        subject,
    )
}

/// An object without a point: exit status 1, with what may be the reason.
pub(super) fn empty(subject: &Subject, moment: Option<f64>, report: Option<&Report>) -> Diagnostic {
    let name = &subject.name;
    let when = match (&subject.time, moment) {
        (Some(time), Some(moment)) => format!(" at {} = {moment}", time.coordinate),
        _ => String::new(),
    };
    let hidden = report.and_then(|report| report.details.iter().find(|d| d.kind == Kind::Part));
    let title = match hidden {
        Some(_) => format!("no sample point is inside `{name}`{when}, which is smaller than a cell"),
        None if subject.levels.is_empty() => {
            format!("`{name}` is empty{when}: its function is nowhere >= 0 in the modelling space")
        }
        None => {
            let levels: Vec<String> = subject.levels.iter().map(|level| level.value.to_string()).collect();
            format!("`{name}` has no point of its levels {} in the modelling space{when}", levels.join(", "))
        }
    };
    let mut told = Diagnostic::error("empty-object", title).category(Category::Result).fact(space(subject));
    if let Some(report) = report {
        let Counters { points, boxes, .. } = report.counters;
        told =
            told.fact(format!("{} sample points were decided, by {points} points and {boxes} boxes", report.samples));
        told = undefined(subject, &report.counters).into_iter().fold(told, |told, of| told.fact(of.title));
    }
    told = match hidden {
        Some(detail) => finer(told.fact(format!("a part of it is near {}", place(subject, detail))), subject, detail),
        None => told
            .help(SIGN)
            .help("if the object lies elsewhere or is smaller than a cell, give --bounds or a larger --resolution"),
    };
    here(told, subject)
}
