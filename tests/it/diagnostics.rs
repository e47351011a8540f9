//! Golden texts of messages: of each kind of syntax error, in each rendering; and near names.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

use expect_test::{expect, expect_file};
use yont::diagnostic::near::{Candidate, suggest};
use yont::diagnostic::render::{Colour, human, json, short};
use yont::diagnostic::{Category, Diagnostic};
use yont::host::{Disk, Memory};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::source::{SourceMap, Span};
use yont::syntax::{Mode, parse};

use crate::cli::{folder, run};

/// Each wrong program of `syntax.txt` (set apart by lines of `===`) with the messages that it gets. The file holds the
/// programs and what is said of them; `UPDATE_EXPECT=1` writes the messages anew.
#[test]
fn each_kind_of_syntax_error_leads_to_its_mending() {
    let golden = include_str!("diagnostics/syntax.txt");
    let mut found = String::new();
    for part in golden.split("=== ").skip(1) {
        let (name, rest) = part.split_once('\n').unwrap();
        let program = rest.split("--- messages\n").next().unwrap();
        let mut sources = SourceMap::default();
        let id = sources.add("script", program.trim_end_matches('\n'));
        let parsed = parse(&sources, id, &Limits::default(), Mode::Script);
        found += &format!("=== {name}\n{program}--- messages\n");
        for diagnostic in &parsed.diagnostics {
            assert!(!diagnostic.help.is_empty(), "{name}: a message must say what to do: {diagnostic:?}");
            assert!(diagnostic.labels.iter().any(|l| l.primary), "{name}: a message must have a place");
            found += &human(diagnostic, &sources, Colour::Plain);
        }
        assert!(!parsed.diagnostics.is_empty(), "{name}: nothing was said");
    }
    expect_file!["diagnostics/syntax.txt"].assert_eq(&found);
}

#[allow(clippy::print_stderr)]
fn as_printed() -> Option<String> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/models/as-printed.txt");
    let text = std::fs::read_to_string(path);
    if text.is_err() {
        eprintln!("SKIPPED: {path} is missing");
    }
    text.ok()
}

/// The scripts of a folder of the package, by path, sorted.
pub fn scripts(folder: &str) -> Vec<(String, String)> {
    let entries = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).expect("a folder");
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("an entry").file_name();
    let names: BTreeSet<String> = entries.map(|entry| name(entry).into_string().expect("a plain name")).collect();
    let paths = names.into_iter().map(|name| format!("{folder}/{name}"));
    paths.map(|path| (path.clone(), std::fs::read_to_string(path).expect("a script"))).collect()
}

/// The figure as it was printed: each of its errors of syntax, and nothing else, is told at its place.
#[test]
fn the_figure_as_printed() {
    let Some(text) = as_printed() else { return };
    let mut sources = SourceMap::default();
    let id = sources.add("as-printed.txt", text);
    let parsed = parse(&sources, id, &Limits::default(), Mode::Script);
    let lines: Vec<_> =
        parsed.diagnostics.iter().map(|d| short(d, &sources) + "\n  help: " + &d.help.join("; ")).collect();
    expect![[r#"
        as-printed.txt:5:12: error[missing-semicolon]: a `;` is missing at the end of this statement
          help: write `;` before `pob_block_3D`
        as-printed.txt:14:41: error[stray-bracket]: this `)` closes nothing
          help: remove it, or add the `(` that it should close, maybe right behind `gob_cyl1 =`
        as-printed.txt:26:13: error[unclosed-bracket]: this `(` is never closed
          help: add the `)` where it belongs, at the latest before the end of the statement
        as-printed.txt:34:33: error[unclosed-bracket]: this `(` is never closed
          help: add the `)` where it belongs, at the latest before the end of the statement"#]]
    .assert_eq(&lines.join("\n"));
}

/// Each program of `examples/errors` with the messages that it gets; `UPDATE_EXPECT=1` writes them anew.
#[test]
fn each_example_of_an_error_is_told_with_its_place() {
    let mut found = String::new();
    for (path, text) in scripts("examples/errors") {
        let name = path.rsplit('/').next().unwrap();
        let mut session = Session::new(Arc::new(Disk), Limits::default(), Interrupt::default());
        let outcome = session.input(&path, &text, Mode::Script);
        assert!(!outcome.diagnostics.is_empty(), "{name}: nothing was said");
        found += &format!("=== {name}\n{text}--- messages\n");
        for diagnostic in &outcome.diagnostics {
            assert!(diagnostic.labels.iter().any(|l| l.primary), "{name}: a message must have a place");
            found += &human(diagnostic, session.sources(), Colour::Plain);
        }
    }
    expect_file!["diagnostics/errors.txt"].assert_eq(&found);
}

/// The figure as it was printed, as a whole: one run names every one of its errors.
#[test]
fn the_figure_as_printed_is_explained_in_one_run() {
    let Some(text) = as_printed() else { return };
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("as-printed.txt", &text, Mode::Script);
    let told: Vec<_> =
        outcome.diagnostics.iter().map(|d| short(d, session.sources()) + "\n  help: " + &d.help.join("; ")).collect();
    expect_file!["diagnostics/as-printed.txt"].assert_eq(&(told.join("\n") + "\n"));
}

/// Each run of `requests.txt`: a name, the command line, the program on standard input, and what is said on standard error.
/// `UPDATE_EXPECT=1` writes the messages anew.
#[test]
fn each_kind_of_message_about_a_run() {
    let golden = include_str!("diagnostics/requests.txt");
    let mut found = String::new();
    for part in golden.split("=== ").skip(1) {
        let (head, rest) = part.split_once("\n$ yont ").unwrap();
        let (line, rest) = rest.split_once('\n').unwrap();
        let program = rest.split("--- messages\n").next().unwrap();
        let mut arguments: Vec<&str> = line.split_whitespace().collect();
        if !arguments.contains(&"-") {
            arguments.push("-");
        }
        let ran = run(folder(&[("p.tsv", b"1\n")]).path(), &arguments, program);
        assert!(ran.err.contains('['), "{head}: nothing was said: {}", ran.err);
        assert_eq!(ran.err.contains("error["), ran.status != Some(0), "{head}: {ran:?}");
        found += &format!("=== {head}\n$ yont {line}\n{program}--- messages\n{}", ran.err);
    }
    expect_file!["diagnostics/requests.txt"].assert_eq(&found);
}

/// Codes without a golden text, and why.
const WITHOUT: &[(&str, &str)] = &[
    ("broken", "follows another error, and is told only at the prompt"),
    ("excused", "is never shown: its cause is told instead"),
    ("cancelled", "needs a key of the user; tests/it/interrupts.rs"),
    ("settings", "is of a file of the user; tests/it/cli.rs"),
    ("cell-length", "is refused by the command line first"),
    ("view", "is refused by the command line first"),
    ("mesh-fault", "would be a fault of the program"),
    ("no-mesh", "would be a fault of the program"),
    ("not-measured", "would be a fault of the program"),
    ("too-complex", "would be a fault of the parser"),
    ("too-large", "needs a program of millions of operations"),
    ("too-many-nodes", "needs millions of operations; tests/it/limits.rs"),
    ("array-too-large", "needs millions of elements; tests/it/limits.rs"),
    ("source-too-large", "needs a text of megabytes; tests/it/limits.rs"),
    ("nested-too-deep", "needs a thousand brackets; tests/it/limits.rs"),
    ("not-a-text", "needs bytes that no text has"),
    ("more-errors", "needs fifty errors; tests/it/limits.rs"),
    ("too-many-includes", "needs as many files"),
    ("not-an-expression", "answers a request of the prompt"),
    ("coordinate-twice", "behind mapped-twice, which the parser tells first"),
    ("too-many-choices", "needs an array of many thousands"),
    ("too-many-variables", "needs as many derivatives within each other as there are spare coordinates"),
    ("space-guessed", "needs an object that takes all the work of a search; tests/it/limits.rs"),
    ("no-setting", "answers `:set` at the prompt"),
    ("palette", "is refused by the command line first"),
    ("not-written", "needs a disk that fails"),
    ("too-deep", "needs a tree deeper than calls may be; tests/it/limits.rs"),
    ("no-name", "would be a fault of the program"),
];

/// The codes of a source: the text that is the first argument of what makes a diagnostic.
fn codes(source: &str) -> BTreeSet<String> {
    let makers = ["error(", "warning(", "note(", "usage("];
    let behind = |maker: &str| source.match_indices(maker).map(|(at, _)| at + maker.len()).collect::<Vec<_>>();
    let quoted = |at: usize| {
        let text = source[at..].trim_start().strip_prefix('"')?;
        let code = &text[..text.find('"')?];
        let plain = !code.is_empty() && code.chars().all(|c| c == '-' || c.is_ascii_lowercase());
        plain.then(|| code.to_owned())
    };
    makers.iter().flat_map(|maker| behind(maker)).filter_map(quoted).collect()
}

#[test]
fn each_code_has_a_golden_text() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = vec![root.join("src")];
    let mut all = BTreeSet::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                all.append(&mut codes(&std::fs::read_to_string(path).unwrap()));
            }
        }
    }
    assert!(all.len() > 100, "{all:?}");
    let golden = ["syntax", "errors", "geometry", "requests", "carving"]
        .map(|name| std::fs::read_to_string(root.join(format!("tests/it/diagnostics/{name}.txt"))).unwrap())
        .concat();
    let has = |code: &str| golden.contains(&format!("[{code}]"));
    let without: Vec<_> =
        all.iter().filter(|code| !has(code) && WITHOUT.iter().all(|(name, _)| name != code)).collect();
    assert!(without.is_empty(), "no golden text shows {without:?}");
    let stale: Vec<_> = WITHOUT.iter().filter(|(code, _)| has(code) || !all.contains(*code)).collect();
    assert!(stale.is_empty(), "no exceptions any more: {stale:?}");
}

fn sample() -> (SourceMap, Diagnostic) {
    let mut sources = SourceMap::default();
    let first = sources.add("a.geo", "r1 = 4.;\ngob_ä = r2 & r1;\n");
    let second = sources.add("b.geo", "r3 = 3;\n");
    let diagnostic = Diagnostic::error("unknown-name", "`r2` is not defined")
        .at(Span::new(first, 18, 20), "unknown")
        .see(Span::new(first, 0, 2), "")
        .see(Span::new(second, 0, 2), "nothing reads this")
        .help("did you mean `r3`?")
        .fact("names tell upper from lower case");
    (sources, diagnostic)
}

#[test]
fn a_message_for_people() {
    let (sources, diagnostic) = sample();
    expect![[r#"
        error[unknown-name]: `r2` is not defined
         --> a.geo:2:9
          |
        1 | r1 = 4.;
          | --
        2 | gob_ä = r2 & r1;
          |         ^^ unknown
          |
         ::: b.geo:1:1
          |
        1 | r3 = 3;
          | -- nothing reads this
          |
          = help: did you mean `r3`?
          = note: names tell upper from lower case
    "#]]
    .assert_eq(&human(&diagnostic, &sources, Colour::Plain));
    assert!(human(&diagnostic, &sources, Colour::Ansi).contains("\u{1b}["), "colours");
}

#[test]
fn a_message_for_editors_and_programs() {
    let (sources, diagnostic) = sample();
    expect!["a.geo:2:9: error[unknown-name]: `r2` is not defined"].assert_eq(&short(&diagnostic, &sources));
    expect![[r#"{"code":"unknown-name","severity":"error","category":"program","title":"`r2` is not defined","file":"a.geo","line":2,"column":9,"end_line":2,"end_column":11,"start":18,"end":20,"labels":[{"text":"unknown","primary":true,"file":"a.geo","line":2,"column":9,"end_line":2,"end_column":11,"start":18,"end":20},{"text":"","primary":false,"file":"a.geo","line":1,"column":1,"end_line":1,"end_column":3,"start":0,"end":2},{"text":"nothing reads this","primary":false,"file":"b.geo","line":1,"column":1,"end_line":1,"end_column":3,"start":0,"end":2}],"help":["did you mean `r3`?"],"notes":["names tell upper from lower case"]}"#]].assert_eq(&json(&diagnostic, &sources));
    let nowhere = Diagnostic::warning("w", "no place").category(Category::File);
    expect!["warning[w]: no place"].assert_eq(&short(&nowhere, &sources));
    expect![[
        r#"{"code":"w","severity":"warning","category":"file","title":"no place","labels":[],"help":[],"notes":[]}"#
    ]]
    .assert_eq(&json(&nowhere, &sources));
}

/// Spans that do not fit the text must not panic: a text may have been cut, a span may be made up.
#[test]
fn spans_beyond_the_text() {
    let (sources, _) = sample();
    for (start, end) in [(14, 16), (5, 900), (900, 900), (27, 27), (0, 27)] {
        let id = sources.get(yont::source::SourceId(0)).map(|_| yont::source::SourceId(0)).unwrap();
        let diagnostic = Diagnostic::note("n", "t").at(Span::new(id, start, end), "x");
        assert!(human(&diagnostic, &sources, Colour::Plain).contains("note[n]: t"), "{start}..{end}");
        assert!(json(&diagnostic, &sources).contains("\"line\""), "{start}..{end}");
    }
}

fn plain<'a>(names: &[&'a str]) -> Vec<Candidate<'a>> {
    names.iter().map(|name| Candidate { name, preferred: false }).collect()
}

#[test]
fn near_names() {
    let cases: [(&str, &[&str], &[&str]); 10] = [
        ("p_block_3D", &["pob_block_3D", "gob_bl1", "pob_sphere"], &["pob_block_3D"]),
        ("gob_cly1", &["gob_cyl1", "gob_cyl2", "gob_csg"], &["gob_cyl1"]),
        ("SIM", &["SIN", "COS", "SUM"], &["SIN", "SUM"]),
        ("R1", &["r1", "R2", "height"], &["r1"]),
        ("sphere", &["pob_sphere", "pob_torus"], &["pob_sphere"]),
        ("metamorp", &["gob_metamorphosis", "gob_swept"], &["gob_metamorphosis"]),
        ("interpolte", &["INTERPOLATE", "INTERSECTION"], &["INTERPOLATE"]),
        ("height", &["width", "radius"], &[]),
        ("q", &["height", "radius"], &[]),
        ("a", &["a"], &[]),
    ];
    for (name, candidates, expected) in cases {
        assert_eq!(suggest(name, plain(candidates)), expected, "{name}");
    }
}

/// `c1` in the figure is defined as `e1`: of all names that differ in one letter, nothing reads that one.
#[test]
fn a_name_that_nothing_reads_wins_ties() {
    let candidates = ["b1", "d1", "r1", "e1", "c3"].map(|name| Candidate { name, preferred: name == "e1" });
    assert_eq!(suggest("c1", candidates)[0], "e1");
    let far = [Candidate { name: "radius", preferred: false }, Candidate { name: "radiates", preferred: true }];
    assert_eq!(suggest("radous", far)[0], "radius", "a clearly better name wins");
}

/// Every single slip (a letter less, doubled, other, or two swapped) in every place of every name of a rich program.
#[test]
fn single_slips_are_recognised() {
    let names = [
        "pob_block_3D",
        "pob_sphere",
        "pob_ellipsoid",
        "pob_cylinder_x",
        "pob_cylinder_y",
        "pob_torus_z",
        "pob_gyroid",
        "tr_bl_uni",
        "tr_bl_int",
        "tr_bl_sub",
        "tr_rotate_x",
        "tr_rotate_y",
        "tr_twist_z",
        "tr_shift",
        "tr_scale",
        "tr_offset",
        "gob_bl1",
        "gob_cyl1",
        "gob_cyl2",
        "gob_csg",
        "gob_swept",
        "gob_metamorp",
        "gob_vox",
        "gob_bloby",
        "INTERPOLATE",
        "INTERSECTION",
        "UNION",
        "PRODUCT",
        "SQRT",
        "SIGN",
        "FLOOR",
        "radius",
        "height",
        "thickness",
        "r_alpha",
        "x4_delta",
        "x1min",
        "x1max",
        "x2min",
        "x2max",
        "depth",
        "period",
        "level",
        "noise",
    ];
    let candidates = plain(&names);
    let (mut right, mut all) = (0, 0);
    for name in names {
        for slip in slips(name) {
            if names.contains(&slip.as_str()) {
                continue;
            }
            all += 1;
            right += usize::from(suggest(&slip, candidates.iter().copied()).first() == Some(&name));
        }
    }
    assert!(right * 100 >= all * 95, "{right} of {all}");
}

fn slips(name: &str) -> Vec<String> {
    let letters: Vec<char> = name.chars().collect();
    let mut slips = Vec::new();
    for at in 0..letters.len() {
        let (before, after) = (&letters[..at], &letters[at + 1..]);
        let join = |middle: &[char]| [before, middle, after].concat().into_iter().collect();
        slips.extend([join(&[]), join(&[letters[at], letters[at]]), join(&['k'])]);
        if let Some(next) = after.first().filter(|n| **n != letters[at]) {
            slips.push([before, &[*next, letters[at]], &after[1..]].concat().into_iter().collect());
        }
    }
    slips
}
