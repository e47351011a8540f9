//! The texts of `stdlib/`, embedded in the program so that it needs no folder beside it. Names only; nothing is done here.

/// Includes the files, in the order in which they are told.
pub static PRELUDE: &str = include_str!("../../../stdlib/prelude.geo");

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../../stdlib/", $name)))),*]
    };
}

/// Each file of the library: its name as the prelude includes it, and its text.
pub static FILES: &[(&str, &str)] = files![
    "shapes/basics.geo",
    "shapes/solids.geo",
    "shapes/polyhedra.geo",
    "shapes/figures.geo",
    "shapes/lattices.geo",
    "shapes/surfaces.geo",
    "shapes/lp.geo",
    "shapes/star.geo",
    "fields/skeletons.geo",
    "fields/noise.geo",
    "operations/sets.geo",
    "operations/blends.geo",
    "operations/offsets.geo",
    "operations/mappings.geo",
    "operations/deformations.geo",
    "operations/patterns.geo",
    "operations/products.geo",
    "operations/carving.geo",
    "operations/time.geo",
    "operations/textures.geo",
    "relations/relations.geo",
];
