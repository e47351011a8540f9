//! The library of `stdlib/`: that every session has it, that users and it do not get into each other's way, and that its comments are
//! true: each example is run.

mod operations;
mod shapes;
mod volumes;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use yont::diagnostic::render::{Colour, human};
use yont::field::Coordinate;
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::library::{FILES, Library, PRELUDE};
use yont::model::request::{self, Cells, View};
use yont::model::{Event, Outcome, Session};
use yont::source::SourceMap;
use yont::syntax::tree::StatementKind;
use yont::syntax::{Mode, parse};

use crate::session::{messages, session};

/// The text of what the last expression of a program is worth.
pub(crate) fn worth(session: &mut Session, program: &str) -> String {
    let outcome = session.input("program", program, Mode::Code);
    assert!(outcome.accepted, "{program}: {}", messages(&outcome));
    match outcome.events.last() {
        Some(Event::Value { text, .. }) => text.clone(),
        other => panic!("{program}: no value but {other:?}"),
    }
}

fn library() -> &'static Library {
    Library::shared()
}

fn files_in(folder: &Path, found: &mut BTreeSet<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() { files_in(&path, found) } else { assert!(found.insert(path)) }
    }
}

#[test]
fn every_file_of_the_folder_is_in_the_prelude_and_in_the_program() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("stdlib");
    let mut found = BTreeSet::new();
    files_in(&folder, &mut found);
    found.remove(&folder.join("prelude.geo"));
    let embedded: BTreeSet<PathBuf> = FILES.iter().map(|(name, _)| folder.join(name)).collect();
    assert_eq!(found, embedded);
    let lines: Vec<&str> = PRELUDE.lines().filter(|line| !line.starts_with("//")).collect();
    let included: BTreeSet<String> = FILES.iter().map(|(name, _)| format!("INCLUDE \"{name}\";")).collect();
    assert_eq!(lines.len(), included.len(), "a file is included once");
    assert!(lines.iter().all(|line| included.contains(*line)), "{lines:?}");
}

#[test]
fn the_glance_finds_what_the_parser_finds() {
    assert_eq!(library().faults(), [""; 0]);
    let mut parsed = BTreeSet::new();
    for (name, text) in FILES {
        let mut sources = SourceMap::default();
        let id = sources.add(*name, *text);
        for statement in parse(&sources, id, &Limits::default(), Mode::Script).statements {
            match statement.kind {
                StatementKind::Define { name, .. } if &*name.name == "r_alpha" || &*name.name == "r_m" => {}
                StatementKind::Define { name: defined, .. } => {
                    assert!(parsed.insert(defined.name.to_string()), "{name}: `{}` is there twice", defined.name);
                }
                other => panic!("{name}: only definitions stand in the library, not {other:?}"),
            }
        }
        assert!(text.starts_with("// "), "{name}: the first line says the subject");
    }
    assert_eq!(library().names().map(str::to_owned).collect::<BTreeSet<_>>(), parsed);
    for name in library().names() {
        assert!(library().get(name).is_some(), "{name}");
    }
}

#[test]
fn every_entry_says_what_it_is_and_its_example_is_true() {
    for name in library().names() {
        let entry = library().entry(name).expect("an entry");
        assert!(entry.text.ends_with('.'), "{name}: {}", entry.text);
        let (source, value) = &entry.example;
        assert!(source.contains(name), "{name}: the example does not use it: {source}");
        assert_eq!(worth(&mut session(), source), *value, "{source}");
    }
}

#[test]
fn a_users_name_wins_for_the_user_alone() {
    let mut s = session();
    let shift = "gob_a = tr_shift(pob_sphere([0, 0, 0], 2), [3, 0, 0]); gob_a(3, 0, 1);";
    assert_eq!(worth(&mut s, shift), "3");
    // pob_cube stands on pob_halfspaces, and goes on standing on the library's.
    let cube = "pob_cube([0, 0, 0], 1) AT (0.5, 0, 0) > 0;";
    assert_eq!(worth(&mut s, cube), "1");
    let outcome = s.input("own", "pob_halfspaces(n, d) = -1; pob_sphere(c, r) = r - x1;", Mode::Script);
    assert!(outcome.accepted);
    assert_eq!(messages(&outcome), "", "no warning for a name of one's own");
    assert_eq!(worth(&mut s, cube), "1");
    assert_eq!(worth(&mut s, "gob_a(3, 0, 1);"), "2", "the object follows the new definition");
    s.undo();
    assert_eq!(worth(&mut s, "gob_a(3, 0, 1);"), "3", "and goes back to the library's");
    let printed = s.input("late", "PRINT pob_torus(1); pob_torus(r) = r;", Mode::Script);
    assert!(messages(&printed).starts_with("defined-later"), "{}", messages(&printed));
    // What failed to be defined by the user is not taken from the library.
    let failed = s.input("failed", "pob_torus(r) = r +; gob_b = pob_torus(1);", Mode::Script);
    assert_eq!(failed.diagnostics.len(), 1, "{}", messages(&failed));
}

#[test]
fn the_library_keeps_its_own_system() {
    let mut s = session();
    let alpha = "r_alpha = 1; tr_bl_uni(3, 4, 0, 1, 1);";
    assert_eq!(worth(&mut s, alpha), "12", "blends stand on r_alpha = 0, whatever the caller has set");
    assert_eq!(worth(&mut session(), "r_alpha = 0; pob_block_3D(0, 0, 0, 2, 3, 4) AT (1, 1, 1);"), "1");
    assert_eq!(worth(&mut s, "3 | 4;"), "4", "and leave the caller's alone");
}

#[test]
fn lists_are_the_users() {
    let mut s = session();
    let outcome = s.input("a", "gob_a = pob_sphere([0, 0, 0], r); r = 2;", Mode::Script);
    assert!(outcome.accepted);
    assert_eq!(s.names(), ["gob_a", "r"]);
    assert_eq!(s.deps("gob_a").expect("defined").reads, ["r"]);
    assert_eq!(s.save(), "gob_a = pob_sphere([0, 0, 0], r);\nr = 2;\n");
    assert!(!s.is_defined("pob_sphere"));
    let mut again = session();
    assert_eq!(worth(&mut again, &(s.save() + "gob_a(0, 0, 1);")), "3");
}

#[test]
fn without_the_prelude_there_is_nothing() {
    let mut bare = Session::bare(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = bare.input("a", "gob_a = pob_spere([0, 0, 0], 1);", Mode::Script);
    assert_eq!(outcome.diagnostics[0].help, ["define it: `pob_spere = ...;`, above or below"]);
    assert!(bare.library().is_none());
}

/// Names that the cases use.
const PRELIMINARIES: &str = "A = pob_sphere([-0.5, 0, 0], 1); B = pob_sphere([0.5, 0, 0], 1.2);
    C = pob_sphere_d([-0.5, 0, 0], 1); D = pob_sphere_d([0.5, 0, 0], 1.2);
    E = pob_sphere([0.5, 0.3, 0.2], 1); H = pob_sphere([0, 0, 0], 1); along(t) = [2*t - 1, t/2, (1 - t)/2];";

/// Points within 2 of the origin, the same each time.
fn points(count: usize) -> Vec<Vec<f64>> {
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed >> 11) as f64 / (1_u64 << 53) as f64 * 4.0 - 2.0
    };
    (0..count).map(|_| (0..4).map(|_| next()).collect()).collect()
}

fn values(expression: &str, points: &[Vec<f64>]) -> Vec<f64> {
    let mut s = session();
    let outcome = s.input("case", &format!("{PRELIMINARIES} gob_z = {expression};"), Mode::Script);
    assert!(outcome.accepted, "{expression}: {}", messages(&outcome));
    let sampled = request::sample(&mut s, &View::default(), points, false).expect("values");
    sampled.iter().map(|sampled| sampled.value).collect()
}

fn compare(cases: &[shapes::Case], count: usize) {
    let points = points(count);
    for (expression, expected, allowed) in cases {
        for (point, value) in points.iter().zip(values(expression, &points)) {
            let expected = expected([point[0], point[1], point[2], point[3]]);
            let error = (value - expected).abs() / (1.0 + expected.abs());
            assert!(error <= *allowed, "{expression} at {point:?}: {value} instead of {expected}");
        }
    }
}

#[test]
fn values_are_those_of_formulas_that_are_written_anew() {
    for cases in [shapes::SOLIDS, shapes::FIGURES, shapes::FIELDS, operations::OPERATIONS, operations::MAPPINGS] {
        compare(cases, 200);
    }
}

#[test]
fn a_ball_swept_along_a_line_is_the_capsule() {
    let cases: Vec<_> = operations::MAPPINGS.iter().copied().filter(|case| case.0.contains("along, 0, 1")).collect();
    assert_eq!(cases.len(), 1);
    compare(&cases, 10_000);
}

#[test]
fn measures_are_those_of_closed_forms() {
    for (expression, dimensions, half, exact, allowed) in volumes::KNOWN {
        let mut s = session();
        assert!(s.input("case", &format!("gob_z = {expression};"), Mode::Script).accepted, "{expression}");
        let bounds = (1..=*dimensions).map(|d| (Coordinate(d), -half, *half)).collect();
        // A sweep asks for a highest value at each point.
        let cells = Cells::Along(if expression.contains("tr_sweep(") { 30 } else { 96 });
        let view = View { bounds, cells, ..View::default() };
        let measured = request::measure(&mut s, &view).expect("a measure").json();
        let key = if *dimensions == 3 { "volume" } else { "area" };
        let value = measured[key]["value"].as_f64().expect("a number");
        assert!((value / exact() - 1.0).abs() <= *allowed, "{expression}: {value} instead of {}", exact());
    }
}

/// Which entries the tables above compare, by whole names.
#[test]
fn every_entry_is_compared_with_something() {
    let all = [shapes::SOLIDS, shapes::FIGURES, shapes::FIELDS, operations::OPERATIONS, operations::MAPPINGS];
    let cases = all.iter().flat_map(|cases| cases.iter().map(|case| case.0));
    let texts: Vec<&str> = cases.chain(volumes::KNOWN.iter().map(|known| known.0)).chain([BY_ITSELF]).collect();
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let words: BTreeSet<&str> = texts.iter().flat_map(|text| text.split(|c| !is_part(c))).collect();
    // Functions that the others are made of have their examples.
    let missing = library().names().filter(|name| !name.starts_with("fn_") && !words.contains(name));
    assert_eq!(missing.collect::<Vec<_>>(), [""; 0]);
}

/// What has a test of its own: below, and where Lp norms and star solids are tested.
const BY_ITSELF: &str = "tr_offset_radius tr_round_edges pob_lp tr_ricci_union tr_ricci_intersection tr_morph_star";

#[test]
fn offsets_of_constant_radius_are_the_exact_ones() {
    for (offset, exact, count) in [
        ("tr_offset_radius(pob_box([0, 0, 0], [2, 1, 1.5]), 0.4)", "0.4 + pob_box_d([0, 0, 0], [2, 1, 1.5])", 300),
        ("tr_offset_radius(pob_torus([0, 0, 0], 1, 0.3), 0.25)", "pob_torus_d([0, 0, 0], 1, 0.55)", 300),
        ("tr_offset_radius(pob_torus([0, 0, 0], 1, 0.5), -0.25)", "pob_torus_d([0, 0, 0], 1, 0.25)", 300),
        ("tr_round_edges(pob_rectangle([0, 0], [2, 1]), 0.3)", "pob_rectangle_round([0, 0], [2, 1], 0.3)", 30),
    ] {
        let points: Vec<Vec<f64>> = points(count).iter().map(|p| p.iter().map(|x| 0.8 * x).collect()).collect();
        let (mut inside, mut outside) = (0, 0);
        for (point, (value, exact)) in points.iter().zip(values(offset, &points).iter().zip(values(exact, &points))) {
            assert!((*value > 0.0) == (exact > 0.0) || exact.abs() < 1e-6, "{offset} at {point:?}: {value}, {exact}");
            *(if exact > 0.0 { &mut inside } else { &mut outside }) += 1;
        }
        assert!(inside > 2 && outside > 2, "{offset}: {inside} in, {outside} out");
    }
}

#[test]
fn memberships_of_unions_and_intersections_are_the_highest_and_the_lowest() {
    // Points of a lattice, on which both boundaries have some, and points anywhere.
    let steps = (0..33_u32).map(|k| f64::from(k) / 8.0 - 2.0);
    let lattice = |x: f64, y: f64| (-16..=16_i32).map(move |z| vec![x, y, f64::from(z) / 8.0, 0.0]);
    let mut all: Vec<Vec<f64>> = steps.clone().flat_map(|x| steps.clone().flat_map(move |y| lattice(x, y))).collect();
    all.extend(points(100_000 - all.len()));
    let of = |object: &str| values(&format!("rel_membership({object}, [x1, x2, x3])"), &all);
    let (f, g) = (of("A"), of("pob_sphere([0.5, 0, 0], 1)"));
    let (union, both) = (of("(A | pob_sphere([0.5, 0, 0], 1))"), of("(A & pob_sphere([0.5, 0, 0], 1))"));
    for i in 0..all.len() {
        assert_eq!((union[i], both[i]), (f[i].max(g[i]), f[i].min(g[i])), "{:?}", all[i]);
    }
    assert!(f.iter().filter(|s| **s == 1.0).count() >= 6, "some points lie on the boundary");
}

fn told(program: &str) -> String {
    let mut s = session();
    let outcome: Outcome = s.input("program.geo", program, Mode::Script);
    outcome.diagnostics.iter().map(|d| human(d, s.sources(), Colour::Plain)).collect()
}

#[test]
fn what_goes_wrong_inside_is_told_at_the_users_call() {
    let inside = told("c = [0, 0];\ngob_a = 1 - tr_shift(pob_sphere(c, 2), [3, 0, 0]);\n");
    let lines: Vec<&str> = inside.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    assert_eq!(lines[0], "error[bad-index]: there is no element 3: the array has 2 elements");
    assert_eq!(lines[1], "--> program.geo:2:22");
    let call = lines.iter().position(|line| line.ends_with("in this call of `pob_sphere`"));
    let behind = lines.iter().position(|line| line.starts_with("::: stdlib/shapes/solids.geo:"));
    assert!(call.is_some() && call < behind, "{inside}");
    let near = told("gob_a = pob_spere([0, 0, 0], 1);\n");
    assert!(near.contains("did you mean `pob_sphere`?"), "{near}");
}
