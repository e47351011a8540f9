//! Measures of an object: as lines for people and as JSON for programs. Plane figures have an area and a length, solids a volume too.

use std::fmt;

use serde_json::{Map, Value, json};

use crate::field::Coordinate;
use crate::surface::measure::{Estimate, Measures};

/// What was measured of an object.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The object's name.
    pub object: String,
    /// The modelling space: each axis and its range.
    pub bounds: Vec<(Coordinate, [f64; 2])>,
    /// Cells along the longest side.
    pub resolution: usize,
    /// The measures.
    pub of: Dimension,
}

/// Measures by the number of axes.
#[derive(Clone, Debug)]
pub enum Dimension {
    /// Of a solid, and the triangles of its mesh.
    Solid(Box<Measures>, usize),
    /// Of a plane figure.
    Plane {
        /// Enclosed area.
        area: Estimate,
        /// Length of the outlines.
        perimeter: Estimate,
        /// Outer outlines less holes.
        euler: i64,
    },
}

impl Measured {
    /// The measures as JSON, with the keys that the manual lists.
    #[must_use]
    pub fn json(&self) -> Value {
        let bounds: Map<String, Value> = self.bounds.iter().map(|(c, range)| (c.to_string(), json!(range))).collect();
        let mut all = json!({ "object": self.object, "bounds": bounds, "resolution": self.resolution });
        let more = match &self.of {
            Dimension::Solid(m, triangles) => json!({
                "volume": estimate(m.volume),
                "area": estimate(m.area),
                "centroid": m.centroid.map(estimate),
                "inertia": m.inertia.map(|row| row.map(estimate)),
                "bounding_box": m.bounds.map(|(lo, hi)| json!([lo, hi])),
                "euler": m.topology.euler,
                "components": m.topology.components,
                "genus": m.topology.genus,
                "triangles": triangles,
                "closed": true,
            }),
            Dimension::Plane { area, perimeter, euler } => {
                json!({ "area": estimate(*area), "perimeter": estimate(*perimeter), "euler": euler })
            }
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

/// A value and its error with the digits that the error leaves.
struct Told(Estimate);

impl fmt::Display for Told {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Estimate { value, error } = self.0;
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
        writeln!(f, "  space         {}, {} cells", ranges.join(", "), self.resolution)?;
        match &self.of {
            Dimension::Solid(m, triangles) => {
                writeln!(f, "  volume        {}", Told(m.volume))?;
                writeln!(f, "  area          {}", Told(m.area))?;
                writeln!(f, "  centroid      {}", row(&m.centroid))?;
                for (i, line) in m.inertia.iter().enumerate() {
                    writeln!(f, "  {}{}", if i == 0 { "inertia       " } else { "              " }, row(line))?;
                }
                if let Some((lo, hi)) = m.bounds {
                    writeln!(f, "  bounding box  {lo:.6?} to {hi:.6?}")?;
                }
                let t = &m.topology;
                write!(
                    f,
                    "  topology      Euler characteristic {}, components {}, genus {}",
                    t.euler, t.components, t.genus
                )?;
                write!(f, "\n  mesh          {triangles} triangles, closed")
            }
            Dimension::Plane { area, perimeter, euler } => {
                writeln!(f, "  area          {}", Told(*area))?;
                writeln!(f, "  perimeter     {}", Told(*perimeter))?;
                write!(f, "  topology      Euler characteristic {euler}")
            }
        }
    }
}

fn row(estimates: &[Estimate]) -> String {
    estimates.iter().map(|e| Told(*e).to_string()).collect::<Vec<_>>().join("  ")
}
