//! Settings by name: definitions of a script that decide how results look, `camera = [30, 20];` say. One table of them. Makes nothing.
//!
//! A name is looked at only if nothing in the program reads it: a user who computes with a `size` of his own means his size.

use crate::diagnostic::{Category, Diagnostic};
use crate::picture::camera::View;
use crate::picture::palette::Palette;

use super::request::{Background, Cells, Choice, Options, Route};
use super::session::Session;
use super::value::{Scalar, Value};

/// A name that a script may define to decide how results look.
#[derive(Debug)]
pub struct Setting {
    /// The name.
    pub name: &'static str,
    /// What it may be, as it is written.
    pub form: &'static str,
    /// What it decides.
    pub doc: &'static str,
    takes: Takes,
}

/// What values a setting takes, and what becomes of them.
#[derive(Clone, Copy, Debug)]
enum Takes {
    Number(fn(f64, &mut Options) -> bool),
    Numbers(&'static [usize], fn(&[f64], &mut Options) -> bool),
    Text(fn(&str, &mut Options) -> bool),
    /// Numbers, so many of them, or a text.
    Either(usize, fn(&[f64], &mut Options) -> bool, fn(&str, &mut Options) -> bool),
}

/// All settings, in the order of the manual.
pub const SETTINGS: &[Setting] = &[
    Setting {
        name: "resolution",
        form: "128",
        doc: "cells along the longest side of the modelling space",
        takes: Takes::Number(|v, o| whole(v, 1e9).map(|n| o.view.cells = Cells::Along(n)).is_some()),
    },
    Setting {
        name: "cell",
        form: "0.05",
        doc: "the length of a cell, instead of a resolution",
        takes: Takes::Number(|v, o| {
            o.view.cells = Cells::Length(v);
            v > 0.0
        }),
    },
    Setting {
        name: "route",
        form: "\"star\"",
        doc: "how a boundary is found: auto, star, cubes",
        takes: Takes::Text(|v, o| Route::from_name(v).map(|route| o.view.route = route).is_some()),
    },
    Setting {
        name: "guide",
        form: "\"sphere:5\"",
        doc: "the guide shape of the star route: following, sphere:5, icosahedron:5, octahedron:5, cube:5, tetrahedron:5, polygon:64, a file.obj",
        takes: Takes::Text(|v, o| Choice::read(v).map(|guide| o.view.guide = guide).is_ok()),
    },
    Setting {
        name: "sharp",
        form: "1",
        doc: "1 or 0: whether meshes and outlines have creases and corners as they are, not beveled",
        takes: Takes::Number(|v, o| switch(v, &mut o.view.sharp)),
    },
    Setting {
        name: "size",
        form: "[640, 480]",
        doc: "width and height of a picture in pixels",
        takes: Takes::Numbers(&[2], |v, o| {
            o.picture.size = whole(v[0], 1e6).zip(whole(v[1], 1e6));
            o.picture.size.is_some()
        }),
    },
    Setting {
        name: "supersample",
        form: "2",
        doc: "rays along each side of a pixel where a picture shows an edge",
        takes: Takes::Number(|v, o| whole(v, 64.0).map(|n| o.picture.supersample = n).is_some()),
    },
    Setting {
        name: "camera",
        form: "[35, 24]",
        doc: "where the camera stands: degrees around the object from its front, and above it; or [x, y, z], the place of the eye",
        takes: Takes::Numbers(&[2, 3], |v, o| {
            o.picture.view = v.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
            View::from_name(&o.picture.view).is_some()
        }),
    },
    Setting {
        name: "view",
        form: "\"front\"",
        doc: "the side that the camera looks from: iso, front, right, back, left, top, bottom, perspective",
        takes: Takes::Text(|v, o| {
            o.picture.view = v.into();
            View::from_name(v).is_some() && !v.contains(',')
        }),
    },
    Setting {
        name: "projection",
        form: "\"orthographic\"",
        doc: "perspective or orthographic: whether what is farther looks smaller",
        takes: Takes::Text(|v, o| {
            o.picture.parallel = match v.to_ascii_lowercase().as_str() {
                "perspective" => Some(false),
                "orthographic" => Some(true),
                _ => None,
            };
            o.picture.parallel.is_some()
        }),
    },
    Setting {
        name: "light",
        form: "[-30, 50]",
        doc: "where the light stands, in degrees around the object from its front, and above it",
        takes: Takes::Numbers(&[2], |v, o| {
            o.picture.light = Some([v[0], v[1]]);
            v[1].abs() <= 90.0
        }),
    },
    Setting {
        name: "fill",
        form: "1",
        doc: "1 or 0: whether there is a second, weaker light",
        takes: Takes::Number(|v, o| switch(v, &mut o.picture.fill)),
    },
    Setting {
        name: "shadow",
        form: "1",
        doc: "1 or 0: whether the light throws shadows",
        takes: Takes::Number(|v, o| switch(v, &mut o.picture.shadow)),
    },
    Setting {
        name: "occlusion",
        form: "1",
        doc: "1 or 0: whether hollows and corners get less light from the sky",
        takes: Takes::Number(|v, o| switch(v, &mut o.picture.occlusion)),
    },
    Setting {
        name: "background",
        form: "[1, 1, 1]",
        doc: "what stands behind the object: red, green and blue from 0 to 1; or \"white\", \"#ffcc00\", \"transparent\"",
        takes: Takes::Either(
            3,
            |v, o| {
                let byte = |k: usize| (v[k] * 255.0).round() as u8;
                o.picture.background = Some(Background::Colour([byte(0), byte(1), byte(2)]));
                v.iter().all(|v| (0.0..=1.0).contains(v))
            },
            |v, o| {
                o.picture.background = Background::from_name(v);
                o.picture.background.is_some()
            },
        ),
    },
    Setting {
        name: "palette",
        form: "\"viridis\"",
        doc: "the colours: plain, mono, spectrum, viridis, embers, diverging, grey",
        takes: Takes::Text(|v, o| {
            o.picture.palette = v.to_ascii_lowercase();
            Palette::from_name(v).is_some()
        }),
    },
    Setting {
        name: "axes",
        form: "1",
        doc: "1 or 0: whether axes with numbers stand around a picture",
        takes: Takes::Number(|v, o| switch(v, &mut o.picture.axes)),
    },
    Setting {
        name: "frames",
        form: "24",
        doc: "frames of an animation, instead of the step of T",
        takes: Takes::Number(|v, o| {
            o.timing.frames = whole(v, 1e6);
            o.timing.frames.is_some()
        }),
    },
    Setting {
        name: "fps",
        form: "12",
        doc: "frames a second in an animation",
        takes: Takes::Number(|v, o| {
            o.timing.fps = v;
            v > 0.0 && v.is_finite()
        }),
    },
];

fn whole(v: f64, most: f64) -> Option<usize> {
    (v >= 1.0 && v <= most && v.fract() == 0.0).then_some(v as usize)
}

fn switch(v: f64, to: &mut bool) -> bool {
    *to = v == 1.0;
    v == 0.0 || v == 1.0
}

/// The defaults of all options as the program sets them.
///
/// # Errors
/// A message for each setting that has the form of one and a value that it cannot have.
pub fn defaults(session: &Session) -> Result<Options, Vec<Diagnostic>> {
    let (mut options, mut told) = (Options::default(), Vec::new());
    for setting in SETTINGS {
        match setting.read(session, &mut options) {
            Some(Reading::Wrong(diagnostic)) => told.push(diagnostic),
            Some(Reading::Other(_)) | None => {}
        }
    }
    if told.is_empty() { Ok(options) } else { Err(told) }
}

/// What is wrong with the settings of a program: errors, and warnings for what has the name of a setting, is read by nothing and has not
/// the form of one.
#[must_use]
pub fn check(session: &Session) -> Vec<Diagnostic> {
    let readings = SETTINGS.iter().filter_map(|setting| setting.read(session, &mut Options::default()));
    readings
        .map(|reading| match reading {
            Reading::Wrong(told) | Reading::Other(told) => told,
        })
        .collect()
}

/// What was found of a setting that is not in order.
enum Reading {
    /// A value that it cannot have.
    Wrong(Diagnostic),
    /// Something else of that name, which is no setting.
    Other(Diagnostic),
}

impl Setting {
    fn read(&self, session: &Session, options: &mut Options) -> Option<Reading> {
        let value = session.value(self.name)?.ok()?;
        if session.state.is_read(self.name) {
            return None;
        }
        let fits = match (&value, self.takes) {
            (Value::Scalar(Scalar::Number(v)), Takes::Number(take)) => take(*v, options),
            (Value::Text(text), Takes::Text(take) | Takes::Either(.., take)) => take(text, options),
            (Value::Array(_), Takes::Numbers(..) | Takes::Either(..)) => {
                let numbers = numbers(&value)?;
                match self.takes {
                    Takes::Numbers(counts, take) if counts.contains(&numbers.len()) => take(&numbers, options),
                    Takes::Either(count, take, _) if count == numbers.len() => take(&numbers, options),
                    _ => return Some(Reading::Other(self.other(session, &value))),
                }
            }
            (Value::Scalar(Scalar::Node(_)) | Value::Function(_), _) => return None,
            _ => return Some(Reading::Other(self.other(session, &value))),
        };
        (!fits).then(|| Reading::Wrong(self.wrong(session, &value)))
    }

    fn wrong(&self, session: &Session, value: &Value) -> Diagnostic {
        let shown = match value {
            Value::Text(text) => format!("\"{text}\""),
            other => other.show(session.graph()),
        };
        let title = format!("the setting `{}` cannot be {shown}", self.name);
        self.at_place(session, Diagnostic::error("bad-setting", title).category(Category::Program))
    }

    fn other(&self, session: &Session, value: &Value) -> Diagnostic {
        let title = format!("`{}` would be a setting, but {} is none; nothing looks at it", self.name, value.kind());
        self.at_place(session, Diagnostic::warning("no-setting", title))
    }

    fn at_place(&self, session: &Session, told: Diagnostic) -> Diagnostic {
        let told = session.place(self.name).into_iter().fold(told, |told, place| told.at(place, ""));
        told.help(format!("`{} = {};`: {}", self.name, self.form, self.doc))
    }
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    let Value::Array(array) = value else { return None };
    let one = |v: &Value| if let Value::Scalar(Scalar::Number(v)) = v { Some(*v) } else { None };
    array.items().iter().map(one).collect()
}

/// The settings as the manual lists them: a row for each.
#[must_use]
pub fn table() -> String {
    let row = |s: &Setting| format!("| `{} = {};` | {} |\n", s.name, s.form, s.doc);
    let rows: String = SETTINGS.iter().map(row).collect();
    format!("| written | decides |\n|---|---|\n{rows}")
}

/// Whether a name is one of the settings.
#[must_use]
pub fn is_setting(name: &str) -> bool {
    SETTINGS.iter().any(|setting| setting.name == name)
}
