//! Outlines as SVG: closed paths filled even-odd, one group for each slice. Holds no style beyond stroke and fill.
//!
//! A unit is a millimetre; the view box is in the model's own units. SVG's y points down, so every y is written negated.

use super::refuse;
use std::io::{self, Write};
use svg::node::element::{Element, Group, Path};

/// The outlines of one section.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slice {
    /// What is said of the slice: `x3` and the value at which the section was taken, or `level` and its value.
    pub marks: Vec<(String, f64)>,
    /// Closed loops, the last point joined to the first; even-odd decides what is inside.
    pub loops: Vec<Vec<[f64; 2]>>,
    /// Fill as sRGB.
    pub colour: Option<[u8; 3]>,
}

/// Writes slices over the modelling space `lo` to `hi`, the first lowest in the drawing order.
///
/// # Errors
/// Those of the writer; `InvalidInput` when no slice has an outline, a number is not finite, or the space has no extent.
pub fn write(slices: &[Slice], lo: [f64; 2], hi: [f64; 2], name: &str, out: &mut impl Write) -> io::Result<()> {
    let size = [hi[0] - lo[0], hi[1] - lo[1]];
    if !size.iter().all(|&s| s > 0. && s.is_finite()) {
        return Err(refuse("the modelling space has no extent"));
    }
    if slices.iter().all(|slice| slice.loops.is_empty()) {
        return Err(refuse("no section has an outline"));
    }
    let points = || slices.iter().flat_map(|slice| slice.loops.iter().flatten().flatten());
    if !points().all(|x| x.is_finite()) || !slices.iter().flat_map(|s| &s.marks).all(|mark| mark.1.is_finite()) {
        return Err(refuse("a point of an outline is not finite"));
    }
    let thin = size[0].min(size[1]) / 400.;
    let mut document = svg::Document::new()
        .set("viewBox", (lo[0], -hi[1] + 0., size[0], size[1]))
        .set("width", format!("{}mm", size[0]))
        .set("height", format!("{}mm", size[1]))
        .add(title(name));
    for slice in slices {
        document = document.add(group(slice, thin));
    }
    let mut out = io::BufWriter::with_capacity(1 << 16, out);
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    // The crate's own writer would need the whole text in a second copy; its `Display` goes straight to the writer.
    writeln!(out, "{document}")?;
    out.flush()
}

fn title(name: &str) -> Element {
    let mut title = Element::new("title");
    let clean: String = name.chars().filter(|c| !c.is_control()).collect();
    svg::Node::append(&mut title, svg::node::Text::new(clean));
    title
}

fn group(slice: &Slice, thin: f64) -> Group {
    let [r, g, b] = slice.colour.unwrap_or([0x9e, 0xc5, 0xe8]);
    let group = Group::new()
        .set("fill", format!("#{r:02x}{g:02x}{b:02x}"))
        .set("fill-rule", "evenodd")
        .set("stroke", "#1a1a1a")
        .set("stroke-width", thin)
        .set("stroke-linejoin", "round");
    let group = slice.marks.iter().fold(group, |group, (name, value)| group.set(format!("data-{name}"), *value));
    if slice.loops.is_empty() { group } else { group.add(Path::new().set("d", outline(&slice.loops))) }
}

/// All loops of a slice are one path, since even-odd must see holes and their surroundings together.
fn outline(loops: &[Vec<[f64; 2]>]) -> String {
    use std::fmt::Write as _;
    let mut text = String::new();
    for (i, points) in loops.iter().filter(|points| !points.is_empty()).enumerate() {
        let gap = if i == 0 { "" } else { " " };
        for (j, [x, y]) in points.iter().enumerate() {
            // Adding zero turns -0 into 0. Writing to a string cannot fail.
            let (x, y) = (x + 0., -y + 0.);
            let _ = if j == 0 { write!(text, "{gap}M{x} {y}L") } else { write!(text, "{x} {y} ") };
        }
        text.truncate(text.trim_end_matches([' ', 'L']).len());
        text.push('Z');
    }
    text
}
