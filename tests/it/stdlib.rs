//! The library of `stdlib/`: that every session has it, that users and it do not get into each other's way, and that its comments are
//! true: each example is run.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use expect_test::expect;
use yont::diagnostic::render::{Colour, human};
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::library::{FILES, Library, PRELUDE};
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

fn told(program: &str) -> String {
    let mut s = session();
    let outcome: Outcome = s.input("program.geo", program, Mode::Script);
    outcome.diagnostics.iter().map(|d| human(d, s.sources(), Colour::Plain)).collect()
}

#[test]
fn what_goes_wrong_inside_is_told_at_the_users_call() {
    expect![[r#"
        error[bad-index]: there is no element 3: the array has 2 elements
         --> program.geo:2:9
          |
        2 | gob_a = 1 - tr_shift(pob_sphere(c, 2), [3, 0, 0]);
          |                      ^^^^^^^^^^^^^^^^ in this call of `pob_sphere`
          |
    "#]]
    .assert_eq(
        &told("c = [0, 0];\ngob_a = 1 - tr_shift(pob_sphere(c, 2), [3, 0, 0]);\n")
            .split("::: ")
            .next()
            .map(|t| t.trim_end().to_owned() + "\n")
            .unwrap_or_default(),
    );
    let near = told("gob_a = pob_spere([0, 0, 0], 1);\n");
    assert!(near.contains("did you mean `pob_sphere`?"), "{near}");
}
