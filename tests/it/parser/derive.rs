//! Random texts made from `grammar/yont.pest` itself, whatever it has: each choice, option and repetition is taken by chance. What the
//! grammar allows the parser may still refuse, in words.

use std::collections::{BTreeMap, BTreeSet};

use pest_meta::ast::{Expr, Rule, RuleType};
use pest_meta::parser;

use super::generate::Random;

const TEXT: &str = include_str!("../../../grammar/yont.pest");

/// The rules by name, and for each how deep it goes at least.
pub struct Grammar {
    rules: BTreeMap<String, Rule>,
    least: BTreeMap<String, usize>,
    reserved: Vec<String>,
}

/// Parts of the grammar that were used, by their place in memory.
pub type Seen = BTreeSet<usize>;

const ENDLESS: usize = 1 << 20;
/// Rules within rules, after which the shortest way out is taken.
const DEEP: usize = 22;

impl Grammar {
    pub fn read() -> Self {
        let pairs = parser::parse(parser::Rule::grammar_rules, TEXT).expect("a grammar");
        let rules = parser::consume_rules(pairs).expect("rules");
        let rules: BTreeMap<String, Rule> = rules.into_iter().map(|rule| (rule.name.clone(), rule)).collect();
        let mut reserved = Vec::new();
        for part in rules["reserved"].expr.iter_top_down() {
            if let Expr::Insens(word) = part {
                reserved.push(word);
            }
        }
        let mut grammar = Self { least: rules.keys().map(|name| (name.clone(), ENDLESS)).collect(), rules, reserved };
        loop {
            let next: BTreeMap<String, usize> =
                grammar.rules.iter().map(|(name, rule)| (name.clone(), 1 + grammar.cost(&rule.expr))).collect();
            if next == grammar.least {
                return grammar;
            }
            grammar.least = next;
        }
    }

    /// How many rules within rules an expression takes at least.
    fn cost(&self, expr: &Expr) -> usize {
        let cost = match expr {
            Expr::Ident(name) => self.least.get(name).copied().unwrap_or(0),
            Expr::Seq(a, b) => self.cost(a).max(self.cost(b)),
            Expr::Choice(a, b) => self.cost(a).min(self.cost(b)),
            Expr::RepOnce(inner) => self.cost(inner),
            _ => 0,
        };
        cost.min(ENDLESS)
    }

    /// A program of a few statements, in random spelling.
    pub fn program(&self, random: &mut Random, seen: &mut Seen) -> String {
        let deep = DEEP - random.below(14);
        let mut writer = Writer { grammar: self, random, seen, out: String::new(), deep, apart: true };
        for _ in 0..writer.random.below(3) + 1 {
            writer.rule("statement", 0, false);
            writer.gap();
            writer.out.push(';');
            writer.gap();
        }
        writer.out
    }

    /// Everything that texts can be made of: all parts of the rules that a statement leads to, but what is only looked at.
    pub fn parts(&self) -> BTreeMap<usize, String> {
        let mut parts = BTreeMap::new();
        let (mut open, mut known) = (vec!["statement", "COMMENT"], BTreeSet::new());
        while let Some(name) = open.pop() {
            let Some(rule) = self.rules.get(name).filter(|_| known.insert(name)) else { continue };
            let mut exprs = vec![&rule.expr];
            while let Some(expr) = exprs.pop() {
                parts.insert(place(expr), format!("{name}: {expr}"));
                match expr {
                    Expr::Ident(other) => open.push(other),
                    Expr::Seq(a, b) | Expr::Choice(a, b) => exprs.extend([&**a, &**b]),
                    Expr::Opt(inner) | Expr::Rep(inner) | Expr::RepOnce(inner) => exprs.push(inner),
                    Expr::PosPred(_) | Expr::NegPred(_) => drop(parts.remove(&place(expr))),
                    _ => {}
                }
            }
        }
        parts
    }
}

fn place(expr: &Expr) -> usize {
    std::ptr::from_ref(expr) as usize
}

struct Writer<'a> {
    grammar: &'a Grammar,
    random: &'a mut Random,
    seen: &'a mut Seen,
    out: String,
    deep: usize,
    /// Whether the next letters begin a new word.
    apart: bool,
}

impl<'a> Writer<'a> {
    fn rule(&mut self, name: &str, depth: usize, atomic: bool) {
        let grammar = self.grammar;
        let Some(rule) = grammar.rules.get(name) else { return self.builtin(name) };
        let inner = atomic || rule.ty == RuleType::Atomic;
        if inner && !atomic {
            self.apart = true;
        }
        // Any word would do for the grammar, and hardly one for the parser.
        if name == "kind_words" && self.random.below(8) > 0 {
            let kind = self.random.one(&["gob/pob", "gob", "pob", "real", "array", "text", "function"]);
            return self.emit(kind, inner);
        }
        let start = self.out.len();
        loop {
            self.expr(&rule.expr, depth + 1, inner);
            if name != "name" || !self.is_taken(start) {
                break;
            }
            self.out.truncate(start);
        }
    }

    /// Whether a name is one that the grammar forbids by looking ahead.
    fn is_taken(&self, start: usize) -> bool {
        let name = self.out[start..].trim().to_lowercase();
        let digits = name.strip_prefix('x').is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit()));
        digits || self.grammar.reserved.contains(&name)
    }

    fn builtin(&mut self, name: &str) {
        let letters: &[&str] = match name {
            "ASCII_DIGIT" => &["0", "1", "2", "7"],
            "ASCII_ALPHA" => &["a", "b", "r", "X", "t"],
            "ASCII_ALPHANUMERIC" => &["a", "q", "Z", "1", "9"],
            "ALPHABETIC" => &["é", "ж", "α", "o"],
            "ANY" => &["a", " ", ";", "(", "{", "é", "'", "+", "IF ", "["],
            _ => &[""],
        };
        let letter = self.random.one(letters);
        self.emit(letter, true);
    }

    fn emit(&mut self, text: &str, atomic: bool) {
        let word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
        let meets = self.out.chars().last().is_some_and(word) && text.chars().next().is_some_and(word);
        if meets && (self.apart || !atomic) {
            self.out.push(' ');
        }
        self.apart = false;
        self.out.push_str(text);
    }

    /// White space or a comment, or nothing.
    fn gap(&mut self) {
        let space = self.random.one(&["", "", "", " ", " ", " ", " ", "\n", "\t", "\r\n", "{", "/"]);
        if !matches!(space, "{" | "/") || self.random.below(3) > 0 {
            return self.out.push_str(space.trim_matches(['{', '/']));
        }
        let start = self.out.len();
        self.rule("COMMENT", 0, true);
        if self.out[start..].starts_with("//") {
            self.out.push('\n');
        }
    }

    fn expr(&mut self, expr: &'a Expr, depth: usize, atomic: bool) {
        self.seen.insert(place(expr));
        let shallow = depth + self.grammar.cost(expr) < self.deep;
        match expr {
            Expr::Str(text) => self.emit(text, atomic),
            Expr::Insens(text) => {
                let spelt = if self.random.below(3) == 0 { text.clone() } else { text.to_uppercase() };
                self.emit(&spelt, atomic);
            }
            Expr::Ident(name) => self.rule(name, depth, atomic),
            Expr::Seq(a, b) => {
                self.expr(a, depth, atomic);
                let silent = matches!(**a, Expr::PosPred(_) | Expr::NegPred(_));
                if !atomic && !silent {
                    self.gap();
                }
                self.expr(b, depth, atomic);
            }
            Expr::Choice(..) => {
                let mut ways = Vec::new();
                let mut rest = expr;
                while let Expr::Choice(a, b) = rest {
                    self.seen.insert(place(rest));
                    rest = a;
                    ways.push(&**b);
                }
                ways.push(rest);
                if !shallow {
                    let least = ways.iter().map(|way| self.grammar.cost(way)).min().unwrap_or(0);
                    ways.retain(|way| self.grammar.cost(way) == least);
                }
                let way = ways[self.random.below(ways.len())];
                self.expr(way, depth, atomic);
            }
            Expr::Opt(inner) if shallow && self.random.below(2) == 0 => self.expr(inner, depth, atomic),
            Expr::Rep(inner) | Expr::RepOnce(inner) => {
                let least = usize::from(matches!(expr, Expr::RepOnce(_)));
                let more = if shallow { self.random.below(8) / 3 } else { 0 };
                for turn in 0..least.max(more) {
                    if turn > 0 && !atomic {
                        self.gap();
                    }
                    self.expr(inner, depth, atomic);
                }
            }
            Expr::Opt(_) | Expr::PosPred(_) | Expr::NegPred(_) => {}
            other => panic!("the grammar has a new kind of expression: {other}"),
        }
    }
}
