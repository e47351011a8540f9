//! The options that say which way leads to a boundary. Reads them; decides nothing.

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::model::request::{Choice, Route};

/// Which way leads to a boundary, and over which guide.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct Way {
    /// Which way
    #[command(flatten)]
    pub along: Along,
    /// The guide shape of the star route: following (the default), sphere:5, icosahedron:5, octahedron:5, cube:5, tetrahedron:5,
    /// polygon:64, a file.obj, NAME:64 of an array of three functions of x1 and x2
    #[arg(long, value_name = "SHAPE", value_parser = Choice::read)]
    pub guide: Option<Choice>,
}

/// Which way leads to a boundary.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct Along {
    /// How the boundary of a mesh or outline is found: `star` by a formula along rays from a centre, `cubes` by a search, `auto` by the
    /// formula where it is proved to be right
    #[arg(long, value_name = "WAY", value_parser = PossibleValuesParser::new(Route::NAMES))]
    pub route: Option<String>,
    /// The centre of the rays; by default the program's CENTER, or what the expression tells
    #[arg(long, alias = "centre", value_name = "X,Y,Z", value_parser = centre, allow_hyphen_values = true)]
    pub center: Option<Centre>,
}

/// A point.
#[derive(Clone, Debug, PartialEq)]
pub struct Centre(pub Vec<f64>);

impl std::fmt::Display for Centre {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let all: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&all.join(","))
    }
}

/// Reads `1,2,3` or `1,2`.
fn centre(text: &str) -> Result<Centre, String> {
    let number = |word: &str| word.trim().parse::<f64>().ok().filter(|v| v.is_finite());
    let all: Option<Vec<f64>> = text.split(',').map(number).collect();
    match all {
        Some(all) if all.len() == 2 || all.len() == 3 => Ok(Centre(all)),
        _ => Err(format!("`{text}` is no point: expected X,Y,Z, or X,Y in the plane")),
    }
}
