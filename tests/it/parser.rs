//! Text to tree and back.

#[path = "parser/dump.rs"]
mod dump;
#[path = "parser/generate.rs"]
mod generate;

use yont::limits::Limits;
use yont::source::SourceMap;
use yont::syntax::tree::Statement;
use yont::syntax::{Mode, Parsed, parse, print};

fn parsed(text: &str, mode: Mode) -> Parsed {
    let mut sources = SourceMap::default();
    let id = sources.add("case", text);
    parse(&sources, id, &Limits::default(), mode)
}

#[test]
fn explore() {
    let Ok(path) = std::env::var("EXPLORE") else { return };
    let text = std::fs::read_to_string(path).unwrap();
    let start = std::time::Instant::now();
    let p = parsed(&text, Mode::Script);
    eprintln!("{:?}", start.elapsed());
    let dumped = dump::statements(&p.statements);
    for d in &p.diagnostics {
        let span = d.labels.first().map(|l| l.span);
        let line = span.map_or(0, |s| text[..s.start as usize].matches('\n').count() + 1);
        eprintln!("{line}: [{}] {} / {:?} / {:?}", d.code, d.title, span.map(|s| &text[s.range()]), d.help);
    }
    if dumped.len() < 20000 {
        eprintln!("{dumped}");
    }
}

#[test]
fn random_programs_print_to_the_same_tree() {
    for seed in 1..=10_000 {
        let text = generate::program(&mut generate::Random(u64::wrapping_mul(seed, 0x9E37_79B9_7F4A_7C15)));
        let tree = parsed(&text, Mode::Script);
        assert!(!tree.diagnostics.iter().any(|d| d.is_error()), "seed {seed}: {:?}\n{text}", tree.diagnostics);
        let printed: String = tree.statements.iter().map(|s| print::statement(s) + "\n").collect();
        let again = parsed(&printed, Mode::Script);
        same(&undocumented(&again.statements), &undocumented(&tree.statements), &[&text, &printed]);
        let formatted = formatted(&text);
        let again = parsed(&formatted, Mode::Script);
        same(&dump::statements(&again.statements), &dump::statements(&tree.statements), &[&text, &formatted]);
        same(&self::formatted(&formatted), &formatted, &[&text]);
    }
}

/// Shows only the first line that differs, since trees are long.
fn same(found: &str, expected: &str, texts: &[&str]) {
    if found != expected {
        let differs = found.lines().zip(expected.lines()).find(|(a, b)| a != b);
        panic!("{differs:#?}\n--- {}", texts.join("\n--- "));
    }
}

fn undocumented(statements: &[Statement]) -> String {
    let mut statements = statements.to_vec();
    dump::strip_docs(&mut statements);
    dump::statements(&statements)
}

fn formatted(text: &str) -> String {
    let mut sources = SourceMap::default();
    let id = sources.add("case", text);
    print::format(&sources, id, &Limits::default()).unwrap_or_else(|d| panic!("{d:?}\n{text}"))
}
