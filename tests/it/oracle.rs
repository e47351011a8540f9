//! The tree oracle against what the session makes of the same text: a hundred thousand random expressions, each at a random point.

use yont::limits::Limits;
use yont::model::oracle::Oracle;
use yont::source::SourceMap;
use yont::syntax::{self, Mode};

use crate::language::value_at;
use crate::session::{messages, session};

/// A small generator of random numbers, so that a failure can be repeated.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 >> 33).unwrap_or(0) % n
    }

    fn coordinate(&mut self) -> f64 {
        self.below(4_000_001) as f64 / 1e6 - 2.0
    }

    fn pick(&mut self, of: &[&str]) -> String {
        of[self.below(of.len())].to_owned()
    }

    fn leaf(&mut self) -> String {
        match self.below(8) {
            0 => format!("{}", self.below(5)),
            1 => format!("{}.25", self.below(3)),
            2 => self.pick(&["r1", "k", "PI"]),
            _ => self.pick(&["x1", "x2", "x3"]),
        }
    }

    fn expression(&mut self, depth: usize) -> String {
        if depth == 0 || self.below(8) == 0 {
            return self.leaf();
        }
        let (a, b) = (self.expression(depth - 1), self.expression(depth - 1));
        match self.below(26) {
            0..=2 => format!("({a} + {b})"),
            3 | 4 => format!("({a} - {b})"),
            5 | 6 => format!("({a}*{b})"),
            7 => format!("({a}/{b})"),
            8 | 9 => format!("({a} | {b})"),
            10 | 11 => format!("({a} & {b})"),
            12 => format!("({a} \\ {b})"),
            13 => format!("(-{a})**{}", self.below(4)),
            14 => format!("(IF {a} < {b} THEN {a} ELSE {})", self.leaf()),
            15 => format!("(({a}) AT (x1 = {b}, x3 = {}))", self.leaf()),
            16 => format!("(({a}) AT ({b}, x1))"),
            17 => format!("SUM(i = 1 TO 3, i*{a})"),
            18 => format!("f({a}, {b})"),
            19 => format!("(q*{a} WHERE q = {b}, q = q + 1)"),
            20 => format!("{}({a}, {b})", self.pick(&["MIN", "MAX", "HYPOT", "ATAN2"])),
            21 => format!("({a} <= {b} < {} OR NOT {a} > 1)", self.leaf()),
            22 => format!("{}(2 + ABS({a}))", self.pick(&["SQRT", "LOG", "LOG10"])),
            23 => format!("EXP(MIN({a}, 3))"),
            _ => format!(
                "{}({a})",
                self.pick(&["SIN", "COS", "ATAN", "TANH", "ABS", "FLOOR", "ASINH", "CBRT", "SIGN", "SQRT", "TAN"])
            ),
        }
    }
}

/// A script of `n` objects after a few parameters, a function and a choice of the system.
fn script(random: &mut Random, n: usize) -> String {
    let alpha = random.pick(&["", "r_alpha = 1;\n", "r_alpha = 0.5;\n", "r_alpha = -k/4;\n"]);
    let mut text = format!("r1 = 0.75; k = 1;\n{alpha}f(p, q) = (p | q)*k + (p AT (x2 = x1));\n");
    for i in 0..n {
        text += &format!("g{i} = {};\n", random.expression(4));
    }
    text
}

#[test]
fn a_hundred_thousand_expressions_agree_with_the_tree_oracle() {
    let mut random = Random(0x0a92_0a96);
    let (mut compared, mut undecided, mut refused) = (0, 0, 0);
    while compared + undecided < 100_000 {
        let text = script(&mut random, 250);
        let mut sources = SourceMap::default();
        let id = sources.add("oracle", text.clone());
        let parsed = syntax::parse(&sources, id, &Limits::default(), Mode::Script);
        let oracle = Oracle::new(&parsed.statements).expect("only definitions");
        let mut session = session();
        // What is known to be undefined is refused as a whole; those definitions are left out.
        let kept = acceptable(&mut session, &text, &mut refused);
        for i in kept {
            let (name, point) = (format!("g{i}"), [random.coordinate(), random.coordinate(), random.coordinate()]);
            let found = value_at(&session, &name, &point);
            let expected = oracle.value(&name, &point).expect("a known form");
            if !expected.error.is_finite() {
                undecided += 1;
                continue;
            }
            compared += 1;
            let same = found == expected.value || found.is_nan() && expected.value.is_nan();
            let near = (found - expected.value).abs() <= expected.error;
            let source = text.lines().find(|l| l.starts_with(&format!("{name} ="))).unwrap_or("");
            assert!(same || near, "{source}\nat {point:?}: found {found:e}, the oracle says {expected:?}");
        }
    }
    eprintln!("{compared} compared, {undecided} within rounding of a step, {refused} refused as undefined");
    assert!(undecided * 10 < compared, "{undecided} of {compared} undecided");
}

/// Loads the script, first without the lines that have errors of their own; gives the numbers of the objects left.
fn acceptable(session: &mut yont::model::Session, text: &str, refused: &mut usize) -> Vec<usize> {
    let mut lines: Vec<&str> = text.lines().collect();
    loop {
        let outcome = session.input("oracle", &lines.join("\n"), Mode::Script);
        if outcome.accepted {
            let number = |l: &&str| l.strip_prefix('g').and_then(|l| l.split(' ').next()?.parse().ok());
            return lines.iter().filter_map(number).collect();
        }
        let wrong: Vec<usize> = outcome
            .diagnostics
            .iter()
            .filter(|d| d.is_error())
            .flat_map(|d| d.labels.iter().map(|l| session.sources().line_column(l.span).0 - 1))
            .filter(|&line| lines[line].starts_with('g'))
            .collect();
        assert!(!wrong.is_empty(), "{}", messages(&outcome));
        *refused += wrong.len();
        lines = lines.into_iter().enumerate().filter(|(i, _)| !wrong.contains(i)).map(|(_, l)| l).collect();
    }
}
