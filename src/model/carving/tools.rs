//! Cutters and dies: the set that there is, tools of the user's own, and a stroke as a statement of the language. Evaluates nothing.

use crate::diagnostic::Diagnostic;

use super::errors;
use super::stroke::Frame;

/// A tool of the set. It stands about the origin; its axis of x3 is to point out of the workpiece.
#[derive(Debug)]
pub struct Kind {
    /// What it is called.
    pub name: &'static str,
    /// What it is, in a few words.
    pub what: &'static str,
    /// Its sizes by their names, each with its length where none is given: as a part of the first one, that one of a usual size.
    pub sizes: &'static [(&'static str, f64)],
    /// Whether it looks the same from all sides.
    round: bool,
    /// How far it reaches below the origin.
    lowest: fn(&[f64]) -> f64,
    text: fn(&[String]) -> String,
}

/// The set of tools.
pub static TOOLS: &[Kind] = &[
    Kind {
        name: "ball",
        what: "a ball",
        sizes: &[("RADIUS", 1.0)],
        round: true,
        lowest: |s| s[0],
        text: |s| format!("pob_sphere_d([0, 0, 0], {})", s[0]),
    },
    Kind {
        name: "ellipsoid",
        what: "an ellipsoid: half its length and width along the surface, and into it",
        sizes: &[("A", 1.0), ("B", 0.5), ("C", 0.5)],
        round: false,
        lowest: |s| s[2],
        text: |s| format!("pob_tool_ellipsoid({}, {}, {})", s[0], s[1], s[2]),
    },
    Kind {
        name: "block",
        what: "a block with those edges",
        sizes: &[("LENGTH", 1.0), ("WIDTH", 1.0), ("HEIGHT", 1.0)],
        round: false,
        lowest: |s| 0.5 * s[2],
        text: |s| format!("pob_box_d([0, 0, 0], [{}, {}, {}])", s[0], s[1], s[2]),
    },
    Kind {
        name: "gouge",
        what: "a rod with round ends, along the surface",
        sizes: &[("RADIUS", 1.0), ("LENGTH", 4.0)],
        round: false,
        lowest: |s| s[0],
        text: |s| format!("pob_capsule([-{l}/2, 0, 0], [{l}/2, 0, 0], {r})", r = s[0], l = s[1]),
    },
    Kind {
        name: "chisel",
        what: "a wedge, its edge along the surface",
        sizes: &[("LENGTH", 1.0), ("WIDTH", 0.4), ("HEIGHT", 0.6)],
        round: false,
        lowest: |s| 0.5 * s[2],
        text: |s| format!("pob_tool_chisel({}, {}, {})", s[0], s[1], s[2]),
    },
    Kind {
        name: "drill",
        what: "a cylinder into the surface",
        sizes: &[("RADIUS", 1.0), ("HEIGHT", 4.0)],
        round: false,
        lowest: |s| 0.5 * s[1],
        text: |s| format!("pob_tool_drill({}, {})", s[0], s[1]),
    },
    Kind {
        name: "cone",
        what: "a cone, its tip into the surface",
        sizes: &[("RADIUS", 1.0), ("HEIGHT", 2.0)],
        round: false,
        lowest: |s| 0.5 * s[1],
        text: |s| format!("pob_tool_cone({}, {})", s[0], s[1]),
    },
    Kind {
        name: "ring",
        what: "a ring that lies on the surface",
        sizes: &[("RADIUS", 1.0), ("TUBE", 0.25)],
        round: false,
        lowest: |s| s[1],
        text: |s| format!("pob_torus_d([0, 0, 0], {}, {})", s[0], s[1]),
    },
];

/// A tool, and how it is used.
#[derive(Clone, Debug)]
pub struct Tool {
    /// What it is about the origin, in the language.
    pub text: String,
    /// What the user calls it.
    pub title: String,
    round: bool,
    /// How far it reaches below the origin; unknown of a tool of the user's own until it is looked at.
    pub lowest: Option<f64>,
    /// How far it goes into the surface, or is raised out of it; half of it if nothing is said.
    depth: Option<f64>,
    /// How far its edge is rounded.
    pub blend: f64,
    /// How it is turned about the normal, in degrees.
    turn: f64,
}

/// Whether a stroke takes away or adds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Takes away what the cutter holds.
    Cut,
    /// Adds what the die holds.
    Raise,
}

/// Where a stroke is: a point, and the unit vector out of the surface there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// The point.
    pub point: [f64; 3],
    /// The normal.
    pub normal: [f64; 3],
    /// Along which direction the tool lies, if it is drawn along.
    pub along: Option<[f64; 3]>,
}

impl Tool {
    /// Reads `ball 0.2 blend=0.05 depth=0.1 turn=30`, or an object of the user's own about the origin in the place of the name. `unit` is
    /// the usual size; `known` says whether a name is defined.
    ///
    /// # Errors
    /// One message.
    pub fn parse(words: &str, unit: f64, known: &dyn Fn(&str) -> bool, names: &[String]) -> Result<Self, Diagnostic> {
        let (head, settings) = split(words);
        let mut tool = Self::of(head, unit, known, names)?;
        for setting in settings {
            let (key, value) = setting.split_once('=').unwrap_or((setting, ""));
            match key {
                "depth" => tool.depth = Some(positive("the depth of a stroke", value, false)?),
                "blend" => tool.blend = positive("a blend", value, true)?,
                "turn" => tool.turn = finite("a turn", value)?,
                _ => return Err(errors::unknown_setting(key)),
            }
        }
        Ok(tool)
    }

    /// The tool that a session begins with.
    #[must_use]
    pub fn first(unit: f64) -> Self {
        Self::of_kind(&TOOLS[0], &[], unit)
    }

    fn of(head: &str, unit: f64, known: &dyn Fn(&str) -> bool, names: &[String]) -> Result<Self, Diagnostic> {
        let mut words = head.split_whitespace();
        let name = words.next().unwrap_or_default();
        if let Some(kind) = TOOLS.iter().find(|kind| kind.name == name) {
            let sizes: Vec<f64> =
                words.map(|word| positive("the size of a tool", word, false)).collect::<Result<_, _>>()?;
            if sizes.len() > kind.sizes.len() {
                return Err(errors::too_many_sizes(kind));
            }
            return Ok(Self::of_kind(kind, &sizes, unit));
        }
        let is_name = !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let rest: Vec<&str> = words.collect();
        if is_name && (rest.is_empty() || rest.iter().all(|word| word.parse::<f64>().is_ok())) {
            if !known(name) {
                let near =
                    errors::near(name, TOOLS.iter().map(|kind| kind.name).chain(names.iter().map(String::as_str)));
                return Err(errors::unknown_tool(name, near));
            }
            return match rest[..] {
                [] => Ok(Self::own(head)),
                [size] => {
                    let size = number(positive("the size of a tool", size, false)?);
                    Ok(Self::own(&format!("{size}*tr_scale({name}, {size})")))
                }
                _ => Err(errors::one_size(name)),
            };
        }
        Ok(Self::own(head))
    }

    fn own(text: &str) -> Self {
        let (text, title) = (text.trim().to_owned(), text.trim().to_owned());
        Self { text, title, round: false, lowest: None, depth: None, blend: 0.0, turn: 0.0 }
    }

    fn of_kind(kind: &Kind, given: &[f64], unit: f64) -> Self {
        let first = given.first().copied().unwrap_or(unit);
        let sizes: Vec<f64> =
            kind.sizes.iter().enumerate().map(|(k, (_, part))| given.get(k).copied().unwrap_or(first * part)).collect();
        let words: Vec<String> = sizes.iter().map(|&size| number(size)).collect();
        let round = kind.round || kind.name == "ellipsoid" && sizes.iter().all(|&size| size == sizes[0]);
        Self {
            text: (kind.text)(&words),
            title: format!("{} {}", kind.name, words.join(" ")),
            round,
            lowest: Some((kind.lowest)(&sizes)),
            depth: None,
            blend: 0.0,
            turn: 0.0,
        }
    }

    /// What it is and how it is used, in a line.
    #[must_use]
    pub fn told(&self) -> String {
        let mut told = self.title.clone();
        let mut say = |name: &str, value: Option<f64>| {
            told.extend(value.map(|value| format!(" {name}={}", number(value))));
        };
        say("depth", self.depth);
        say("blend", Some(self.blend).filter(|&blend| blend > 0.0));
        say("turn", Some(self.turn).filter(|&turn| turn != 0.0));
        told
    }

    /// Where its origin is in a stroke, where its axis of x3 points, and by how many degrees it is turned about that.
    fn stand(&self, way: Way, spot: &Spot) -> ([f64; 3], [f64; 3], f64) {
        let lowest = self.lowest.unwrap_or(0.0);
        let off = lowest - self.depth.unwrap_or(lowest);
        // A die works from behind: it points out of the workpiece, as a cutter points into it.
        let sign = if way == Way::Cut { 1.0 } else { -1.0 };
        let at = std::array::from_fn(|k| spot.point[k] + sign * off * spot.normal[k]);
        let out = spot.normal.map(|v| sign * v);
        let drawn = spot.along.and_then(|along| Frame::angle(out, along)).map_or(0.0, f64::to_degrees);
        (at, out, self.turn + (drawn * 100.0).round() / 100.0)
    }

    /// Where it stands in a stroke.
    #[must_use]
    pub fn frame(&self, way: Way, spot: &Spot) -> Frame {
        let (at, out, turn) = self.stand(way, spot);
        let turned = if self.round { None } else { Frame::turned(at, out, turn.to_radians()) };
        turned.unwrap_or_else(|| Frame::upright(at))
    }

    /// The tool where a stroke is made with it: `digits` behind the point are enough for lengths.
    #[must_use]
    pub fn placed(&self, way: Way, spot: &Spot, digits: usize) -> String {
        let (at, out, turn) = self.stand(way, spot);
        let at = vector(at, digits);
        if self.round {
            return format!("tr_shift({}, {at})", self.text);
        }
        let turn = if turn == 0.0 { "0".into() } else { format!("{}*PI/180", number(turn)) };
        format!("tr_place({}, {at}, {}, {turn})", self.text, vector(out, 6))
    }

    /// A stroke with it, as a statement.
    #[must_use]
    pub fn stroke(&self, name: &str, way: Way, spot: &Spot, digits: usize) -> String {
        let verb = if way == Way::Cut { "tr_carve" } else { "tr_chase" };
        format!("{name} = {verb}({name}, {}, {});", self.placed(way, spot, digits), number(self.blend))
    }
}

/// A point in the language.
pub fn vector(v: [f64; 3], digits: usize) -> String {
    let short = |v: f64| {
        let text = format!("{v:.digits$}");
        let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
        if text == "-0" { "0".to_owned() } else { text.to_owned() }
    };
    format!("[{}, {}, {}]", short(v[0]), short(v[1]), short(v[2]))
}

/// A number as it is written in a program.
pub fn number(value: f64) -> String {
    super::super::value::number(value)
}

/// What stands before the settings, and those: the last words that are `name=value`.
fn split(words: &str) -> (&str, Vec<&str>) {
    let mut head = words.trim_end();
    let mut settings = Vec::new();
    loop {
        let start = head.rfind(char::is_whitespace).map_or(0, |i| i + 1);
        let word = &head[start..];
        let is_setting = word
            .split_once('=')
            .is_some_and(|(key, _)| !key.is_empty() && key.chars().all(|c| c.is_ascii_alphabetic()));
        if !is_setting {
            return (head, settings);
        }
        settings.insert(0, word);
        head = head[..start].trim_end();
    }
}

fn finite(what: &str, text: &str) -> Result<f64, Diagnostic> {
    text.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| errors::bad_number(what, text, "a number"))
}

fn positive(what: &str, text: &str, or_zero: bool) -> Result<f64, Diagnostic> {
    let value = text.parse().ok().filter(|v: &f64| v.is_finite() && (*v > 0.0 || or_zero && *v == 0.0));
    value.ok_or_else(|| {
        errors::bad_number(what, text, if or_zero { "a length, 0 for none" } else { "a length above 0" })
    })
}
