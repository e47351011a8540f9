//! Questions about objects, whose answers are numbers and arrays: do they meet, how large are they, what is nearest. The interpreter asks
//! them; here they are only described.

use super::table::{Arity, Builtin, Meaning, Special, Subject};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Question {
    /// `INTERSECTS(g1, g2)`
    Intersects,
    /// `INCLUDES(g1, g2)`
    Includes,
    /// `WITNESS(g1, g2)`
    Witness,
    /// What is measured of an object
    Measure(Measure),
    /// `DISTANCE(g, p)`
    Distance,
    /// `CLOSEST(g, p)`
    Closest,
    /// `CURVE(g1, g2)`
    Curve,
    /// `UNCERTAINTY(VOLUME(g))`
    Uncertainty,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measure {
    /// `VOLUME(g)`
    Volume,
    /// `AREA(g)`
    Area,
    /// `PERIMETER(g)`
    Perimeter,
    /// `CENTROID(g)`
    Centroid,
    /// `INERTIA(g)`
    Inertia,
    /// `BOUNDS(g)`
    Bounds,
    /// `COMPONENTS(g)`
    Components,
    /// `GENUS(g)`
    Genus,
    /// `MEAN_CURVATURE(g)`
    MeanCurvature,
    /// `GAUSS_CURVATURE(g)`
    GaussCurvature,
}

impl Question {
    /// How many arguments it takes.
    #[must_use]
    pub fn arity(self) -> Arity {
        match self {
            Self::Intersects | Self::Includes | Self::Distance | Self::Closest => Arity::Exactly(2),
            Self::Curve => Arity::Between(2, 3),
            Self::Witness => Arity::Between(1, 2),
            Self::Uncertainty | Self::Measure(Measure::Bounds) => Arity::Exactly(1),
            Self::Measure(_) => Arity::Between(1, 2),
        }
    }
}

/// An entry of something measured with so many cells.
const fn measure(of: Measure, name: &'static str, doc: &'static str, example: (&'static str, f64)) -> Builtin {
    entry(Question::Measure(of), name, &["g", "cells"], doc, example)
}

const fn entry(
    question: Question,
    name: &'static str,
    parameters: &'static [&'static str],
    doc: &'static str,
    example: (&'static str, f64),
) -> Builtin {
    let meaning = Meaning::Special(Special::Question(question));
    Builtin { name, aliases: &[], subject: Subject::Questions, parameters, doc, example, meaning }
}

/// The questions.
pub(super) static TABLE: &[Builtin] = &[
    entry(
        Question::Intersects,
        "INTERSECTS",
        &["g1", "g2"],
        "1 if some point belongs to both objects, 0 if it is proved that none does. Boundaries belong to objects. An error says if it cannot be \
         decided: of objects that only touch, mostly.",
        ("INTERSECTS(1 - x1**2 - x2**2, 1 - (x1 - 2.000001)**2 - x2**2)", 0.0),
    ),
    entry(
        Question::Includes,
        "INCLUDES",
        &["g1", "g2"],
        "1 if it is proved that every point of g2 belongs to g1, 0 if some point does not. An error says if it cannot be decided.",
        ("INCLUDES(4 - x1**2 - x2**2, 1 - (x1 - 0.9)**2 - x2**2)", 1.0),
    ),
    entry(
        Question::Witness,
        "WITNESS",
        &["g1", "g2"],
        "A point that belongs to both objects, or to the one object: the array of its coordinates, up to the highest that is used. An error if \
         there is none: INTERSECTS says so without one. WITNESS(g2, ~g1) shows where g1 does not include g2.",
        ("(1 - x1**2 - x2**2) AT (WITNESS(1 - x1**2 - x2**2, x1 - 0.9)) >= 0", 1.0),
    ),
    measure(
        Measure::Volume,
        "VOLUME",
        "The volume of a solid; of an object of two coordinates its area, of one its length. Cells along the longest side: 128 unless told, as \
         for all that is measured.",
        ("ABS(VOLUME(1 - x1**2 - x2**2 - x3**2) - 4/3*PI) < 1e-5", 1.0),
    ),
    measure(
        Measure::Area,
        "AREA",
        "The area of the boundary of a solid, or of a plane figure.",
        ("ABS(AREA(1 - x1**2 - x2**2 - x3**2) - 4*PI) < 1e-4", 1.0),
    ),
    measure(
        Measure::Perimeter,
        "PERIMETER",
        "The length of the outlines of a plane figure, those of its holes as well.",
        ("ABS(PERIMETER(1 - x1**2 - x2**2) - 2*PI) < 1e-4", 1.0),
    ),
    measure(
        Measure::Centroid,
        "CENTROID",
        "The centre of mass, as a point.",
        ("ABS(CENTROID(1 - (x1 - 3)**2 - x2**2 - x3**2)[1] - 3) < 1e-6", 1.0),
    ),
    measure(
        Measure::Inertia,
        "INERTIA",
        "The inertia tensor about the centre of mass, for density 1: an array of rows, in the coordinates that the object uses.",
        ("ABS(INERTIA(1 - x1**2 - x2**2 - x3**2)[1, 1] - 8/15*PI) < 1e-4", 1.0),
    ),
    entry(
        Question::Measure(Measure::Bounds),
        "BOUNDS",
        &["g"],
        "How far an object of any dimension reaches: for each coordinate up to the highest that it uses the lowest and the highest. Found by \
         intervals, and so sure.",
        ("ABS(BOUNDS(1 - x1**2 - (x2 - 5)**2)[2, 1] - 4) < 1e-6", 1.0),
    ),
    measure(
        Measure::Components,
        "COMPONENTS",
        "The number of connected parts.",
        ("COMPONENTS(1 - x1**2 - x2**2 | 1 - (x1 - 3)**2 - x2**2)", 2.0),
    ),
    measure(
        Measure::Genus,
        "GENUS",
        "The number of handles of the boundary of a solid, which is 1 for a torus; of a plane figure the number of its holes.",
        ("GENUS(0.25 - (SQRT(x1**2 + x2**2) - 2)**2 - x3**2)", 1.0),
    ),
    measure(
        Measure::MeanCurvature,
        "MEAN_CURVATURE",
        "The mean curvature over the smooth parts of the boundary: the least, the average, the largest, and the integral. 1/r on a ball. Of a plane \
         figure the curvature of its outlines.",
        ("ABS(MEAN_CURVATURE(4 - x1**2 - x2**2 - x3**2)[2] - 0.5) < 1e-6", 1.0),
    ),
    measure(
        Measure::GaussCurvature,
        "GAUSS_CURVATURE",
        "The Gaussian curvature over the smooth parts of the boundary of a solid: the least, the average, the largest, and the integral, which is 2 \
         pi times the Euler characteristic of a smooth boundary.",
        ("ABS(GAUSS_CURVATURE(4 - x1**2 - x2**2 - x3**2)[4] - 4*PI) < 1e-4", 1.0),
    ),
    entry(
        Question::Distance,
        "DISTANCE",
        &["g", "p"],
        "The distance of a point from an object: 0 if it belongs to the object. DISTANCE(~g, p) is how deep it lies in g.",
        ("ABS(DISTANCE(1 - x1**2 - x2**2, [3, 4]) - 4) < 1e-12", 1.0),
    ),
    entry(
        Question::Closest,
        "CLOSEST",
        &["g", "p"],
        "The point of an object that is nearest to a point, which is that point itself if it belongs to the object. Coordinates that the object \
         does not use stay as they are.",
        ("ABS(CLOSEST(1 - x1**2 - x2**2, [3, 4])[1] - 0.6) < 1e-12", 1.0),
    ),
    entry(
        Question::Curve,
        "CURVE",
        &["g1", "g2", "cells"],
        "The curves in which the boundaries of two solids meet: an array of polylines, each an array of points, closed ones with the first point \
         again at the end. Of two plane figures the points, each a polyline of its own. What is smaller than a cell, of which 128 lie along the \
         longest side unless told, may be missed.",
        ("LEN(CURVE(4 - x1**2 - x2**2 - x3**2, 1 - x1**2 - x2**2))", 2.0),
    ),
    entry(
        Question::Uncertainty,
        "UNCERTAINTY",
        &["VOLUME(g)"],
        "The estimated error of what is measured, VOLUME or another question with a number that may be off: of the same form as its answer.",
        ("UNCERTAINTY(VOLUME(1 - x1**2 - x2**2 - x3**2)) < 1e-5", 1.0),
    ),
];
