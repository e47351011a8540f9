//! Measures of an object: as lines for people and as JSON for programs. Solids have a volume, plane figures an area, objects of one
//! coordinate a length.

use std::fmt;

use serde_json::{Map, Value, json};

use crate::diagnostic::Diagnostic;
use crate::field::Coordinate;
use crate::surface::estimate::{Bend, Estimate};
use crate::surface::figure::Figure;
use crate::surface::line::Line;
use crate::surface::measure::Measures;

/// What was measured of an object.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The object's name.
    pub object: String,
    /// The modelling space: each axis and its range.
    pub bounds: Vec<(Coordinate, [f64; 2])>,
    /// Cells along the longest side.
    pub resolution: usize,
    /// How the boundary was found: `cubes`, `squares`, or `star` and what it took; nothing on a line.
    pub route: String,
    /// The measures.
    pub of: Dimension,
    /// Notes and warnings: where the space cuts it, what is undefined, what was too small.
    pub notes: Vec<Diagnostic>,
}

/// Measures by the number of axes.
#[derive(Clone, Debug)]
pub enum Dimension {
    /// Of a solid, and the triangles of its mesh.
    Solid(Box<Measures>, usize),
    /// Of a plane figure.
    Plane(Box<Figure>),
    /// Of an object of one coordinate.
    Line(Line),
}

impl Measured {
    /// The measures as JSON, with the keys that the manual lists.
    #[must_use]
    pub fn json(&self) -> Value {
        let bounds: Map<String, Value> = self.bounds.iter().map(|(c, range)| (c.to_string(), json!(range))).collect();
        let mut all = json!({ "object": self.object, "bounds": bounds, "resolution": self.resolution });
        if let (Value::Object(all), Some(route)) = (&mut all, self.route.split(',').next().filter(|r| !r.is_empty())) {
            all.insert("route".into(), json!(route));
        }
        let more = match &self.of {
            Dimension::Solid(m, triangles) => json!({
                "volume": estimate(m.volume),
                "area": estimate(m.area),
                "centroid": m.centroid.map(estimate),
                "inertia": m.inertia.map(|row| row.map(estimate)),
                "bounding_box": m.bounds.map(|box_| box_.map(|ends| ends.map(estimate))),
                "mean_curvature": m.curvature.map(|[mean, _]| bend(&mean)),
                "gaussian_curvature": m.curvature.map(|[_, gauss]| bend(&gauss)),
                "euler": m.topology.euler,
                "components": m.topology.components,
                "genus": m.topology.genus,
                "triangles": triangles,
                "closed": true,
            }),
            Dimension::Plane(f) => json!({
                "area": estimate(f.area),
                "perimeter": estimate(f.perimeter),
                "centroid": f.centroid.map(estimate),
                "inertia": f.inertia.map(|row| row.map(estimate)),
                "curvature": f.curvature.map(|curvature| bend(&curvature)),
                "euler": f.components as i64 - f.holes as i64,
                "components": f.components,
                "holes": f.holes,
                "closed": true,
            }),
            Dimension::Line(line) => json!({
                "length": estimate(line.length),
                "intervals": line.intervals,
                "components": line.intervals.len(),
            }),
        };
        if let (Value::Object(all), Value::Object(more)) = (&mut all, more) {
            all.extend(more);
        }
        all
    }
}

fn estimate(e: Estimate) -> Value {
    json!({ "value": e.value, "error": e.error })
}

fn bend(bend: &Bend) -> Value {
    json!({
        "integral": estimate(bend.integral), "average": estimate(bend.average),
        "least": estimate(bend.least), "largest": estimate(bend.largest),
    })
}

/// A value and its error with the digits that the error leaves.
struct Told(Estimate);

impl fmt::Display for Told {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Estimate { value, error } = self.0;
        if value != 0.0 && !(1e-4..1e9).contains(&value.abs()) && error < value.abs() {
            let digits = if error > 0.0 { (1.0 + (value.abs() / error).log10()).clamp(0.0, 15.0) as usize } else { 6 };
            return write!(f, "{value:.digits$e} (+- {error:.1e})");
        }
        if error >= 1e9 {
            return write!(f, "{value:.1e} (+- {error:.1e})");
        }
        let digits = if error > 0.0 { (1.0 - error.log10().floor()).clamp(0.0, 12.0) as usize } else { 6 };
        // What rounds to nothing is nothing: no minus before it.
        let value = if value.abs() < 0.5 * 10_f64.powi(-(digits as i32)) { 0.0 } else { value };
        write!(f, "{value:.digits$} (+- {error:.1e})")
    }
}

impl fmt::Display for Measured {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.object)?;
        let ranges: Vec<String> = self.bounds.iter().map(|(c, [lo, hi])| format!("{c} {lo} to {hi}")).collect();
        let cells =
            if matches!(self.of, Dimension::Line(_)) { String::new() } else { format!(", {} cells", self.resolution) };
        writeln!(f, "  space         {}{cells}", ranges.join(", "))?;
        if !self.route.is_empty() {
            writeln!(f, "  route         {}", self.route)?;
        }
        match &self.of {
            Dimension::Solid(m, triangles) => solid(f, m, *triangles),
            Dimension::Plane(figure) => plane(f, figure),
            Dimension::Line(line) => {
                writeln!(f, "  length        {}", Told(line.length))?;
                let shown = line.intervals.iter().take(8).map(|[from, to]| format!("{from} to {to}"));
                let more = if line.intervals.len() > 8 { ", ..." } else { "" };
                write!(f, "  intervals     {}: {}{more}", line.intervals.len(), shown.collect::<Vec<_>>().join(", "))
            }
        }
    }
}

fn solid(f: &mut fmt::Formatter<'_>, m: &Measures, triangles: usize) -> fmt::Result {
    writeln!(f, "  volume        {}", Told(m.volume))?;
    writeln!(f, "  area          {}", Told(m.area))?;
    writeln!(f, "  centroid      {}", row(&m.centroid))?;
    for (i, line) in m.inertia.iter().enumerate() {
        writeln!(f, "  {}{}", if i == 0 { "inertia       " } else { "              " }, row(line))?;
    }
    for (i, [lo, hi]) in m.bounds.iter().flatten().enumerate() {
        let head = if i == 0 { "bounding box  " } else { "              " };
        writeln!(f, "  {head}{} to {}", Told(*lo), Told(*hi))?;
    }
    for (bend, name) in m.curvature.iter().flatten().zip(["mean", "Gaussian"]) {
        curvature(f, name, bend)?;
    }
    let t = &m.topology;
    writeln!(f, "  topology      Euler characteristic {}, components {}, genus {}", t.euler, t.components, t.genus)?;
    write!(f, "  mesh          {triangles} triangles, closed")
}

fn plane(f: &mut fmt::Formatter<'_>, figure: &Figure) -> fmt::Result {
    writeln!(f, "  area          {}", Told(figure.area))?;
    writeln!(f, "  perimeter     {}", Told(figure.perimeter))?;
    writeln!(f, "  centroid      {}", row(&figure.centroid))?;
    for (i, line) in figure.inertia.iter().enumerate() {
        writeln!(f, "  {}{}", if i == 0 { "inertia       " } else { "              " }, row(line))?;
    }
    if let Some(bend) = &figure.curvature {
        curvature(f, "outlines", bend)?;
    }
    write!(f, "  topology      components {}, holes {}", figure.components, figure.holes)
}

fn curvature(f: &mut fmt::Formatter<'_>, name: &str, bend: &Bend) -> fmt::Result {
    let Bend { integral, average, least, largest } = *bend;
    writeln!(f, "  curvature     {name}: average {}, from {} to {}", Told(average), Told(least), Told(largest))?;
    writeln!(f, "                integral {}", Told(integral))
}

fn row(estimates: &[Estimate]) -> String {
    estimates.iter().map(|e| Told(*e).to_string()).collect::<Vec<_>>().join("  ")
}
