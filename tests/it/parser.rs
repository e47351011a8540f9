//! Text to tree and back.

#[path = "parser/derive.rs"]
mod derive;
#[path = "parser/dump.rs"]
mod dump;
#[path = "parser/generate.rs"]
mod generate;

use std::time::Instant;

use rayon::prelude::*;
use yont::limits::Limits;
use yont::source::SourceMap;
use yont::syntax::tree::{Body, ExprKind, Statement, StatementKind};
use yont::syntax::{Mode, Parsed, parse, print};

use crate::oracle::cases;

/// Fig. 6 of the paper with its printing errors mended.
const FIGURE: &str = include_str!("parser/figure.geo");

fn parsed(text: &str, mode: Mode) -> Parsed {
    let mut sources = SourceMap::default();
    let id = sources.add("case", text);
    parse(&sources, id, &Limits::default(), mode)
}

/// One case a line pair: the text, then its tree (`= ` before it). See `cases.txt`.
#[test]
fn each_form_of_the_language() {
    let golden = include_str!("parser/cases.txt");
    let mut found = String::new();
    for case in golden.split_inclusive("\n\n") {
        let program = case.split("\n= ").next().unwrap().trim_end();
        if program.starts_with("# ") {
            found += case;
            continue;
        }
        let tree = parsed(program, Mode::Script);
        assert!(!tree.diagnostics.iter().any(|d| d.is_error()), "{program}\n{:?}", tree.diagnostics);
        found += &format!("{program}\n= {}\n\n", dump::statements(&tree.statements).replace('\n', "\n= "));
    }
    expect_test::expect_file!["parser/cases.txt"].assert_eq(&found);
}

/// At the prompt the last statement may go without its `;`, and a text that stops too early asks for more.
#[test]
fn the_prompt() {
    let cases = [
        ("r1 = 4", "(def r1 4)", false),
        ("a = 1; a + 1", "(def a 1)\n(a + 1)", false),
        ("IF a THEN b = 1", "(if a {(def b 1)})", false),
        ("IF a THEN 1", "(? a 1)", false),
        ("a = IF b THEN 1; ELSE 2", "(def a (? b 1 2))", false),
        ("", "", false),
        ("// nothing", "", false),
        ("a = (1", "(failed a)", true),
        ("a = [1,", "(failed a)", true),
        ("a = 1 +", "(failed a)", true),
        ("a =", "(failed a)", true),
        ("IF a THEN", "(failed)", true),
        ("WHILE (a)", "(failed)", true),
        ("f(x) = BEGIN f = x;", "(failed f)", true),
        ("f(x) = BEGIN f = x; END", "(def f (x) {(def f x)})", false),
        ("a = 1 { why", "(failed a)", true),
        ("a = 1; { why", "(def a 1)\n(failed)", true),
        ("a = );", "(failed a)", false),
        ("a = 1 +;", "(failed a)", false),
        ("a = (1;", "(failed a)", false),
        ("a = \"text", "(failed a)", false),
    ];
    for (text, tree, incomplete) in cases {
        let found = parsed(text, Mode::Prompt);
        assert_eq!(dump::statements(&found.statements), tree, "{text}");
        assert_eq!(found.incomplete, incomplete, "{text}");
    }
}

/// A failed statement still counts as defining its names.
#[test]
fn what_failed_statements_define() {
    let cases = [
        ("gob_cyl1 = (r1**2) & x) ;", "(failed gob_cyl1)"),
        ("f(x) = BEGIN f = x", "(failed f)"),
        ("a[2] = ;", "(failed a)"),
        ("a = (1\nb = 2;", "(failed a b)"),
        ("WHILE (i < 8) DO BEGIN s = ; i = i + 1; END;", "(failed s i)"),
        ("x1 = 3;", "(failed)"),
        ("a = {", "(failed a)"),
    ];
    for (text, tree) in cases {
        assert_eq!(dump::statements(&parsed(text, Mode::Script).statements), tree, "{text}");
    }
}

/// Only a comment right above a statement documents it.
#[test]
fn comments_as_documentation() {
    let cases = [
        ("{ radius }\nr1 = 4;", "radius"),
        ("// two\n//lines\nr1 = 4;", "two\nlines"),
        ("{ far }\n\nr1 = 4;", ""),
        ("{ title }\n\n{ radius }\nr1 = 4;", "radius"),
        ("{ same line } r1 = 4;", "radius"),
        ("a = 1; { of a }\nr1 = 4;", ""),
        ("a = 1; // of a\n// of r1\nr1 = 4;", "of r1"),
        ("r1 = { inside } 4;", ""),
        ("{ windows }\r\nr1 = 4;", "windows"),
    ];
    for (text, doc) in cases {
        let found = parsed(text, Mode::Script).statements.pop().unwrap();
        assert_eq!(&*found.doc, if text.contains("same line") { "same line" } else { doc }, "{text}");
    }
}

/// Every place of the tree is right: its text, parsed alone, is the same expression.
#[test]
fn spans_cover_what_they_say() {
    let text = "gob_a = ( -f(x1 , 2 )[1] AT (x3 = 4 )**2 + IF_b ) { c } | g WHERE q = 3 , s = [4] ;";
    let mut sources = SourceMap::default();
    let id = sources.add("case", text);
    let found = parse(&sources, id, &Limits::default(), Mode::Script);
    let StatementKind::Define { name, body: Body::Expression(e), .. } = &found.statements[0].kind else { panic!() };
    let ExprKind::Where { body, bindings } = &e.kind else { panic!() };
    let ExprKind::Chain { first, rest } = &body.kind else { panic!() };
    let spans = [
        found.statements[0].span,
        name.span,
        e.span,
        body.span,
        first.span,
        rest[0].1,
        rest[0].2.span,
        bindings[1].1.span,
    ];
    let texts: Vec<_> = spans.iter().map(|s| sources.text(*s)).collect();
    let expected = [
        text,
        "gob_a",
        "( -f(x1 , 2 )[1] AT (x3 = 4 )**2 + IF_b ) { c } | g WHERE q = 3 , s = [4]",
        "( -f(x1 , 2 )[1] AT (x3 = 4 )**2 + IF_b ) { c } | g",
        "( -f(x1 , 2 )[1] AT (x3 = 4 )**2 + IF_b )",
        "|",
        "g",
        "[4]",
    ];
    assert_eq!(texts, expected);
}

/// A hundred thousand of anything that nests is refused in words; a thousand levels are read.
#[test]
fn nesting_has_a_limit_and_no_stack_overflows() {
    let nests: [(&str, &str, &str); 14] = [
        ("(", "1", ")"),
        ("[", "1", "]"),
        ("f(", "1", ")"),
        ("-", "1", ""),
        ("NOT ", "1", ""),
        ("2**", "1", ""),
        ("a[", "1", "]"),
        ("IF c THEN 1 ELSE ", "2", ""),
        ("IF c THEN ", "2", ""),
        ("(IF c THEN 1; ELSE ", "2", ")"),
        ("~-", "1", ""),
        ("SUM(i = 1 TO 2, ", "i", ")"),
        ("(1 WHERE q = ", "1", ")"),
        ("", "a", "[1]"),
    ];
    let limits = Limits::default();
    for (open, middle, close) in nests {
        for (count, fits) in [(limits.nesting / 2 - 1, true), (100_000, false)] {
            let text = format!("a = {}{middle}{};", open.repeat(count), close.repeat(count));
            let found = parsed(&text, Mode::Script);
            let codes: Vec<_> = found.diagnostics.iter().map(|d| d.code).collect();
            assert_eq!(codes, if fits { vec![] } else { vec!["nested-too-deep"] }, "{open} x {count}");
        }
    }
    for (open, close) in [("WHILE (c) DO BEGIN ", "END; "), ("IF (c) THEN ", ""), ("FOR i = 1 TO 2 DO ", "")] {
        let text = |count| format!("{}a = 1; {}", open.repeat(count), close.repeat(count));
        assert!(parsed(&text(300), Mode::Script).diagnostics.is_empty(), "{open}");
        assert_eq!(parsed(&text(100_000), Mode::Script).diagnostics[0].code, "nested-too-deep", "{open}");
    }
}

/// The limits at n and at n + 1.
#[test]
fn limits_of_a_text() {
    let limits = Limits { nesting: 5, source_bytes: 30, errors: 2, ..Limits::default() };
    let codes = |text: &str| {
        let mut sources = SourceMap::default();
        let id = sources.add("case", text);
        parse(&sources, id, &limits, Mode::Script).diagnostics.iter().map(|d| d.code).collect::<Vec<_>>()
    };
    assert_eq!(codes("a = (((((1)))));"), [""; 0]);
    assert_eq!(codes("a = ((((((1))))));"), ["nested-too-deep"]);
    assert_eq!(codes(&format!("a = 1;{}", " ".repeat(24))), [""; 0]);
    assert_eq!(codes(&format!("a = 1;{}", " ".repeat(25))), ["source-too-large"]);
    assert_eq!(codes("a = ;b = ;"), ["missing-expression"; 2]);
    assert_eq!(codes("a = ;b = ;c = ;"), ["missing-expression", "missing-expression", "more-errors"]);
}

/// A sum, a union and a comparison of a million terms are flat: nothing recurses, also when they are dropped.
#[test]
fn long_chains_are_flat() {
    let text = format!("a = 1{};\nb = x1{};", " + 1".repeat(1_000_000), " | x2".repeat(100_000));
    let found = parsed(&text, Mode::Script);
    assert!(found.diagnostics.is_empty());
    let StatementKind::Define { body: Body::Expression(e), .. } = &found.statements[0].kind else { panic!() };
    let ExprKind::Chain { rest, .. } = &e.kind else { panic!() };
    assert_eq!(rest.len(), 1_000_000);
    assert!(print::statement(&found.statements[0]).len() > 4_000_000);
}

/// Whatever is done to a script by a slip or by chance, it is read without a panic and answered with messages that can be
/// shown; what has no error can be printed and read again.
#[test]
fn mutants_never_panic() {
    let script = format!("{}{}", FIGURE, include_str!("parser/cases.txt"));
    let pieces = [
        "(", ")", "[", "]", ";", ",", "=", "IF ", " THEN ", " ELSE ", "BEGIN ", " END", "{", "}", "\"", "//", "\n",
        " AT ", "WHERE ", "x1", "x99", "1.", "..", "**", "ä", "−", "\u{0}", "\u{feff}", "\r", " TO ", "DO ", "FOR ",
        ":", "~", "NOT ",
    ];
    let mut random = generate::Random(42);
    for turn in 0..4_000 {
        let from = boundary(&script, random.below(script.len()));
        let to = boundary(&script, (from + 20 + random.below(300)).min(script.len()));
        let mut text = script[from..to].to_owned();
        for _ in 0..=random.below(3) {
            let at = boundary(&text, random.below(text.len() + 1));
            let end = boundary(&text, (at + random.below(8)).min(text.len()));
            let piece = if random.below(3) == 0 { "" } else { random.one(&pieces) };
            text.replace_range(at..end, piece);
        }
        let mode = if turn % 2 == 0 { Mode::Script } else { Mode::Prompt };
        let mut sources = SourceMap::default();
        let id = sources.add("mutant", text.as_str());
        let found = parse(&sources, id, &Limits::default(), mode);
        for diagnostic in &found.diagnostics {
            assert!(!diagnostic.help.is_empty() || !diagnostic.is_error(), "{diagnostic:?}");
            for label in &diagnostic.labels {
                assert!(text.get(label.span.range()).is_some(), "{label:?} in {text:?}");
            }
            assert!(
                !yont::diagnostic::render::human(diagnostic, &sources, yont::diagnostic::render::Colour::Plain)
                    .is_empty()
            );
        }
        let failed = found.statements.iter().any(|s| matches!(s.kind, StatementKind::Failed { .. }));
        assert!(!failed || found.diagnostics.iter().any(|d| d.is_error()), "a failure without a word: {text:?}");
        if !found.diagnostics.iter().any(|d| d.is_error()) {
            let formatted = formatted(&text);
            let again = parsed(&formatted, Mode::Script);
            same(&dump::statements(&again.statements), &dump::statements(&found.statements), &[&text, &formatted]);
            same(&self::formatted(&formatted), &formatted, &[&text]);
        }
    }
}

fn boundary(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// What backtracks exponentially in a careless grammar stays linear: the call limit of pest would refuse it otherwise.
#[test]
fn nothing_backtracks() {
    let cases = [
        "SUM(i = 1 TO SUM(i = 1 TO 2, i), ".repeat(100) + "1" + &")".repeat(100),
        "f(a = ".repeat(200) + "1" + &")".repeat(200),
        "IF a THEN IF b THEN 1; ELSE ".repeat(100) + "2",
        "a AT (x1 = b AT (".repeat(100) + "1" + &"))".repeat(100),
        "[(a)[".repeat(100) + "1" + &"]]".repeat(100),
        "-(NOT a[".repeat(50) + "1" + &"])".repeat(50),
    ];
    for case in cases {
        let found = parsed(&format!("a = {case};"), Mode::Script);
        assert!(found.diagnostics.is_empty(), "{case}: {:?}", found.diagnostics);
    }
    let blocks = "WHILE (a) DO BEGIN IF b THEN BEGIN f(x) = BEGIN ".repeat(60) + "a = 1" + &" END END END".repeat(60);
    assert!(parsed(&format!("{blocks};"), Mode::Script).diagnostics.is_empty());
}

/// Prints the tree of a text without errors and reads it again, formats it once and twice.
fn round_trip(text: &str, tree: &Parsed) {
    let printed: String = tree.statements.iter().map(|s| print::statement(s) + "\n").collect();
    let again = parsed(&printed, Mode::Script);
    same(&undocumented(&again.statements), &undocumented(&tree.statements), &[text, &printed]);
    let formatted = formatted(text);
    let again = parsed(&formatted, Mode::Script);
    same(&dump::statements(&again.statements), &dump::statements(&tree.statements), &[text, &formatted]);
    same(&self::formatted(&formatted), &formatted, &[text]);
}

/// A seed for each number of a case.
fn random(case: u64) -> generate::Random {
    generate::Random(case.wrapping_mul(0x9E37_79B9_7F4A_7C15))
}

/// Shows a text that took longer than a second; whether that is too long depends on the machine.
#[allow(clippy::print_stderr)]
fn tell_if_slow(begun: Instant, text: &str) {
    let seconds = begun.elapsed().as_secs_f64();
    if seconds > 1.0 {
        eprintln!("{seconds:.1} s for\n{text}\n");
    }
}

#[test]
fn random_programs_print_to_the_same_tree() {
    (1..=cases(10_000) as u64).into_par_iter().for_each(|case| {
        let begun = Instant::now();
        let text = generate::program(&mut random(case));
        let tree = parsed(&text, Mode::Script);
        assert!(!tree.diagnostics.iter().any(|d| d.is_error()), "case {case}: {:?}\n{text}", tree.diagnostics);
        round_trip(&text, &tree);
        tell_if_slow(begun, &text);
    });
}

/// Texts made from every part of the grammar: without a panic they are read to the same tree again, or refused with help.
#[test]
#[allow(clippy::print_stderr)]
fn programs_derived_from_the_grammar_print_to_the_same_tree() {
    let grammar = derive::Grammar::read();
    let count = cases(6_000) as u64;
    let one = |(mut seen, accepted): (derive::Seen, u64), case| {
        let begun = Instant::now();
        let text = grammar.program(&mut random(case), &mut seen);
        let tree = parsed(&text, Mode::Script);
        let mut errors = tree.diagnostics.iter().filter(|d| d.is_error()).peekable();
        let right = errors.peek().is_none();
        assert!(errors.all(|d| !d.help.is_empty()), "case {case}: {:?}\n{text}", tree.diagnostics);
        if right {
            round_trip(&text, &tree);
        }
        tell_if_slow(begun, &text);
        (seen, accepted + u64::from(right))
    };
    let none = || (derive::Seen::new(), 0);
    let (seen, accepted) = (1..=count).into_par_iter().fold(none, one).reduce(none, |mut a, b| {
        a.0.extend(b.0);
        (a.0, a.1 + b.1)
    });
    eprintln!("{accepted} of {count} derived programs are right");
    assert!(20 * accepted > count, "{accepted} of {count} are right: hardly any is tried");
    let unused: Vec<_> =
        grammar.parts().into_iter().filter(|part| !seen.contains(&part.0)).map(|part| part.1).collect();
    assert!(unused.is_empty(), "parts of the grammar that no program used: {unused:#?}");
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

/// A text that is wrong from end to end is refused as fast as it is read: messages do not cost the square of its length.
#[test]
fn wrong_from_end_to_end() {
    for text in [
        "a = 1\n".repeat(20_000),
        ")".repeat(100_000),
        "% ".repeat(100_000),
        "BEGIN ; ".repeat(900),
        "a = ;".repeat(50_000),
    ] {
        let found = parsed(&text, Mode::Script);
        assert!(found.diagnostics.iter().any(|d| d.is_error()));
        assert!(found.diagnostics.len() <= Limits::default().errors + 1, "{}", &text[..8]);
    }
}

/// Statements of a long text are read by several threads: as many trees as statements, in their order, and each error in its place.
#[test]
fn a_long_text_is_read_as_its_statements_are() {
    let line = |i: usize| match i % 700 {
        5 => format!("v_{i} = 1 + ;\n"),
        6 => format!("v_{i} = 2 +* {i};\n"),
        7 => format!("v_{i} = {}1{};\n", "(".repeat(60), ")".repeat(60)),
        8 => format!("v_{i} = {};\n", vec!["x1"; 400].join(" + ")),
        _ => format!("{{ The {i}th. }} v_{i} = SIN(x1 * {i}) - 2;\n"),
    };
    let count = 2_500;
    let lines: Vec<String> = (0..count).map(line).collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    let whole = pool.install(|| parsed(&lines.concat(), Mode::Script));
    assert_eq!(whole.statements.len(), count);
    let mut start = 0;
    let mut told = whole.diagnostics.iter();
    for (line, statement) in lines.iter().zip(&whole.statements) {
        let alone = parsed(line, Mode::Script);
        assert_eq!(alone.statements.len(), 1);
        assert_eq!(statement.span.start, start + alone.statements[0].span.start);
        assert_eq!(undocumented(std::slice::from_ref(statement)), undocumented(&alone.statements), "{line}");
        assert_eq!(statement.doc, alone.statements[0].doc);
        for diagnostic in &alone.diagnostics {
            let same = told.next().expect("as many messages");
            assert_eq!((same.code, &same.title), (diagnostic.code, &diagnostic.title));
            let places = |d: &yont::diagnostic::Diagnostic, base: u32| -> Vec<u32> {
                d.labels.iter().map(|label| label.span.start - base).collect()
            };
            assert_eq!(places(same, start), places(diagnostic, 0), "{line}");
        }
        start += line.len() as u32;
    }
    assert!(told.next().is_none());
}
