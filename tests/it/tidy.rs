//! The rules of the house, read off the sources: layers, sizes, openings, and words that do not belong.

use std::fs;
use std::path::{Path, PathBuf};

/// Each room and the rooms that it may use. What is not listed is not allowed.
const LAYERS: &[(&str, &[&str])] = &[
    ("source", &[]),
    ("limits", &[]),
    ("reuse", &[]),
    ("interrupt", &["reuse"]),
    ("number", &["limits", "interrupt"]),
    ("diagnostic", &["source", "limits"]),
    ("syntax", &["source", "limits", "interrupt", "diagnostic"]),
    ("builtins", &["number"]),
    ("field", &["limits", "reuse", "interrupt", "number", "builtins"]),
    ("vm", &["limits", "reuse", "interrupt", "number", "field"]),
    ("surface", &["limits", "reuse", "interrupt", "number", "field", "vm"]),
    ("picture", &["limits", "reuse", "interrupt", "number", "field", "vm", "surface"]),
    ("data", &["limits", "interrupt", "number"]),
    ("export", &["interrupt", "surface", "picture"]),
    ("host", &["diagnostic"]),
    (
        "model",
        &[
            "source",
            "limits",
            "reuse",
            "interrupt",
            "number",
            "diagnostic",
            "syntax",
            "builtins",
            "field",
            "vm",
            "surface",
            "picture",
            "data",
            "export",
            "host",
        ],
    ),
    (
        "cli",
        &[
            "source",
            "limits",
            "interrupt",
            "number",
            "diagnostic",
            "syntax",
            "builtins",
            "field",
            "surface",
            "picture",
            "export",
            "host",
            "model",
        ],
    ),
    ("repl", &["source", "limits", "interrupt", "diagnostic", "syntax", "builtins", "host", "model", "cli"]),
];

/// What only the named places may use.
const KEPT_TO: &[(&str, &[&str])] = &[
    ("pest", &["src/syntax/"]),
    ("pest_derive", &["src/syntax/"]),
    ("tobj", &["src/data/"]),
    ("std::fs", &["src/host.rs"]),
    ("std::env", &["src/host.rs", "src/main.rs"]),
    ("SystemTime", &["src/host.rs"]),
    ("clap", &["src/cli/"]),
    ("rustyline", &["src/repl/"]),
    ("unsafe", &[]),
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &str, extensions: &[&str]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.ends_with("target") {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().and_then(|e| e.to_str()).is_some_and(|e| extensions.contains(&e)) {
                found.push((relative(&path), fs::read_to_string(&path).expect("a text")));
            }
        }
    }
    found.sort();
    found
}

fn relative(path: &Path) -> String {
    let path: PathBuf = path.strip_prefix(root()).expect("inside").into();
    path.to_str().expect("a plain name").replace('\\', "/")
}

fn sources() -> Vec<(String, String)> {
    let all = files("src", &["rs"]);
    assert!(all.len() > 20, "the sources are somewhere else");
    all
}

/// The code of a line: without a comment that starts it or follows a blank.
fn code(line: &str) -> &str {
    let line = line.trim_start();
    if line.starts_with("//") { "" } else { line.split(" //").next().unwrap_or(line) }
}

fn word_at(text: &str) -> &str {
    &text[..text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len())]
}

/// The rooms that a text names: `crate::room`, `crate::{room::a, other}`, and `super` chains that climb that high.
fn rooms_named(path: &str, text: &str) -> Vec<String> {
    let code: String = text.lines().map(|line| code(line).to_owned() + "\n").collect();
    let levels = path.trim_start_matches("src/").trim_end_matches(".rs").trim_end_matches("/mod").split('/').count();
    let mut named = Vec::new();
    for climb in ["crate::".to_owned(), "super::".repeat(levels)] {
        for (at, _) in code.match_indices(&climb).filter(|(at, _)| !code[..*at].ends_with("super::")) {
            match code[at + climb.len()..].strip_prefix('{') {
                None => named.push(word_at(&code[at + climb.len()..]).to_owned()),
                Some(group) => named.extend(group_heads(group)),
            }
        }
    }
    named
}

/// The first words of the members of a `{...}` group whose brace is already taken.
fn group_heads(group: &str) -> Vec<String> {
    let (mut heads, mut depth, mut fresh) = (Vec::new(), 0, true);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => fresh = true,
            c if c.is_alphabetic() && fresh => {
                heads.push(word_at(&group[at..]).to_owned());
                fresh = false;
            }
            _ => {}
        }
    }
    heads
}

fn room(path: &str) -> &str {
    path.trim_start_matches("src/").split('/').next().unwrap_or("").trim_end_matches(".rs")
}

#[test]
fn use_runs_one_way() {
    let mut wrong = Vec::new();
    for (path, text) in sources() {
        let own = room(&path);
        let Some((_, allowed)) = LAYERS.iter().find(|(name, _)| *name == own) else {
            assert!(["main", "lib"].contains(&own), "{path} is in no room of the table");
            continue;
        };
        for named in rooms_named(&path, &text) {
            let is_room = LAYERS.iter().any(|(name, _)| *name == named);
            if is_room && named != own && !allowed.contains(&named.as_str()) {
                wrong.push(format!("{path} uses {named}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn the_table_of_layers_has_no_circle() {
    for (at, (name, uses)) in LAYERS.iter().enumerate() {
        for used in *uses {
            assert!(LAYERS[..at].iter().any(|(below, _)| below == used), "{name} uses {used}, which stands above it");
        }
    }
}

#[test]
fn the_reader_of_paths_reads_them() {
    let cases: [(&str, &str, &[&str]); 4] = [
        ("src/vm/block.rs", "use crate::field::Graph;", &["field"]),
        (
            "src/vm/block.rs",
            "use crate::{limits, number::{op::Unary, Leaf},\n  field};",
            &["limits", "number", "field"],
        ),
        ("src/vm/block.rs", "use super::super::cli; use super::own;", &["cli"]),
        ("src/vm/mod.rs", "use super::cli; // crate::model", &["cli"]),
    ];
    for (path, text, expected) in cases {
        assert_eq!(rooms_named(path, text), expected, "{text}");
    }
}

#[test]
fn some_things_are_used_in_their_place_only() {
    let mut wrong = Vec::new();
    for (path, text) in sources() {
        for (number, line) in text.lines().enumerate() {
            for (word, places) in KEPT_TO {
                if mentions(code(line), word) && !places.iter().any(|place| path.starts_with(place)) {
                    wrong.push(format!("{path}:{}: {word}", number + 1));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Whether `word` stands in the code as a word of its own: a path, or a keyword; not inside a text.
fn mentions(code: &str, word: &str) -> bool {
    let edge = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric() && c != '_' && c != '.');
    code.match_indices(word).any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + word.len()..]);
        let path = word.contains("::") || word.starts_with(char::is_uppercase);
        let used = path || after.starts_with("::") || after.starts_with(' ') || before.ends_with("use ");
        used && edge(before.chars().next_back()) && edge(after.chars().next()) && before.matches('"').count() % 2 == 0
    })
}

#[test]
fn every_file_says_first_what_it_is() {
    for (path, text) in [sources(), files("tests", &["rs"]), files("benches", &["rs"])].concat() {
        let first = text.lines().next().unwrap_or("");
        assert!(first.starts_with("//! ") && first.len() > 10, "{path} opens with {first:?}");
    }
}

#[test]
fn files_and_functions_stay_small() {
    let mut wrong = Vec::new();
    for (path, text) in [sources(), files("tests", &["rs"]), files("benches", &["rs"])].concat() {
        let lines: Vec<&str> = text.lines().collect();
        if lines.len() > 600 {
            wrong.push(format!("{path} has {} lines", lines.len()));
        }
        for (start, length) in functions(&lines) {
            if length > 100 {
                wrong.push(format!("{path}:{}: a function of {length} lines", start + 1));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// First line and length of each function, as the formatter lays them out: it ends with a brace under its first word.
fn functions(lines: &[&str]) -> Vec<(usize, usize)> {
    let is_start = |line: &str| {
        let words = line.trim_start();
        !words.starts_with("//") && (words.starts_with("fn ") || words.contains(" fn ") || words.starts_with("pub fn "))
    };
    let end = |start: usize| {
        let indent = &lines[start][..lines[start].len() - lines[start].trim_start().len()];
        let closing = format!("{indent}}}");
        lines[start..].iter().position(|line| **line == closing).map_or(1, |length| length + 1)
    };
    let has_body = |start: usize| {
        let header = lines[start..].iter().position(|line| line.trim_end().ends_with(['{', ';', '}']));
        header.is_some_and(|at| lines[start + at].trim_end().ends_with('{'))
    };
    (0..lines.len()).filter(|&at| is_start(lines[at]) && has_body(at)).map(|at| (at, end(at))).collect()
}

#[test]
fn the_reader_of_functions_finds_them() {
    let text =
        "pub fn a() {\n    1\n}\nfn b() { 2 }\n    fn c(\n        x: f64,\n    ) {\n        3\n    }\n// fn d() {";
    assert_eq!(functions(&text.lines().collect::<Vec<_>>()), [(0, 3), (4, 5)]);
}

#[test]
fn the_project_speaks_of_itself_alone() {
    // Written in halves, so that this list does not find itself.
    let halves = [
        ("TO", "DO"),
        ("FIX", "ME"),
        ("XX", "X"),
        ("todo", "!("),
        ("place", "holder"),
        ("/wo", "rk/"),
        ("chat", "gpt"),
        ("Cla", "ude"),
        ("Anth", "ropic"),
        ("language ", "model"),
        ("sub", "agent"),
        ("co-", "pilot"),
    ];
    let texts = [
        sources(),
        files("tests", &["rs", "txt", "geo"]),
        files("benches", &["rs"]),
        files("examples", &["geo", "md"]),
        files("stdlib", &["geo"]),
        files("grammar", &["pest"]),
        files("docs", &["md"]),
        top(),
    ];
    let mut wrong = Vec::new();
    for (path, text) in texts.concat() {
        for word in halves.map(|(a, b)| format!("{a}{b}")) {
            if let Some(at) = text.find(&word) {
                wrong.push(format!("{path}:{}: {word}", text[..at].lines().count().max(1)));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

fn top() -> Vec<(String, String)> {
    let names =
        ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md", "Cargo.toml", ".ci/run"];
    names.iter().map(|name| ((*name).to_owned(), fs::read_to_string(root().join(name)).expect(name))).collect()
}

#[test]
fn every_dependency_has_its_line_in_the_architecture() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("Cargo.toml");
    let architecture = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let mut inside = false;
    let mut count = 0;
    for line in manifest.lines() {
        if line.starts_with('[') {
            inside = line.contains("dependencies]");
        } else if let (true, Some((name, _))) = (inside, line.split_once(" = ")) {
            assert!(
                architecture.contains(&format!("`{name}`")),
                "ARCHITECTURE.md does not say what {name} does for us"
            );
            count += 1;
        }
    }
    assert!(count > 10, "the manifest was not read");
}

#[test]
fn the_readme_and_the_gate_run_the_same_tests() {
    let texts = top();
    for name in ["README.md", ".ci/run"] {
        let (_, text) = texts.iter().find(|(path, _)| path == name).expect(name);
        assert!(text.lines().any(|line| line.trim() == "cargo test"), "{name} does not run `cargo test`");
    }
    assert!(texts[0].1.contains("cargo run --release -- examples/04_metamorphosis.geo -o metamorphosis.gif"));
}
