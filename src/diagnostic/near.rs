//! Names that are near a name which means nothing: slips of the keyboard, other case, another prefix, a part of a name.

use std::cmp::Ordering;

use strsim::{damerau_levenshtein, jaro_winkler};

/// What a word of other languages is written as here, for people who come from there.
#[must_use]
pub fn foreign(word: &str) -> Option<&'static str> {
    Some(match word {
        "let" | "var" | "const" | "set" | "real" | "float" | "double" | "int" => {
            "a definition needs no word before it: `a = 3;`"
        }
        "def" | "function" | "fn" | "func" | "module" | "lambda" => "a function is defined as `f(p) = ...;`",
        "import" | "use" | "require" | "from" => "`INCLUDE \"file.geo\";` takes the definitions of another file",
        "return" => "the value of a body is what it assigns to its own name",
        "echo" | "display" | "puts" | "println" => "`PRINT e;` shows a value",
        "elif" | "elsif" => "write `ELSE IF`",
        _ => return None,
    })
}

/// A name that may be meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Candidate<'a> {
    /// The name.
    pub name: &'a str,
    /// Whether it is more likely than the others: a defined name that nothing reads.
    pub preferred: bool,
}

/// How many suggestions are worth reading.
const SUGGESTIONS: usize = 3;
/// What being preferred is worth, in slips; under one, so that it decides ties and near ties only.
const PREFERENCE: f64 = 0.75;
/// How far behind the best a suggestion may be.
const BEHIND: f64 = 0.7;
/// The prefixes that say what a name stands for, those of other dialects included.
const PREFIXES: [&str; 9] = ["gob_", "pob_", "tr_", "rel_", "fn_", "p_", "g_", "r_", "t_"];

/// The candidates near `name`, the likeliest first, at most three; none if nothing is near.
///
/// The measure counts slips (a letter more, less, other, or two letters swapped). A difference of case only, or of the
/// prefix only (`p_block` for `pob_block`), counts less than one slip.
#[must_use]
pub fn suggest<'a>(name: &str, candidates: impl IntoIterator<Item = Candidate<'a>>) -> Vec<&'a str> {
    let word = Word::new(name);
    let mut ranked: Vec<_> = candidates
        .into_iter()
        .filter(|c| c.name != name)
        .filter_map(|c| word.slips(c.name).map(|slips| Ranked::new(&word, c, slips)))
        .collect();
    ranked.sort_by(Ranked::order);
    ranked.dedup_by(|a, b| a.name == b.name);
    let limit = ranked.first().map_or(0.0, |best| best.slips + BEHIND);
    ranked.into_iter().filter(|r| r.slips < limit).take(SUGGESTIONS).map(|r| r.name).collect()
}

struct Word {
    lower: String,
    length: usize,
}

struct Ranked<'a> {
    name: &'a str,
    slips: f64,
    likeness: f64,
}

impl<'a> Ranked<'a> {
    fn new(word: &Word, candidate: Candidate<'a>, slips: f64) -> Self {
        let likeness = jaro_winkler(&word.lower, &candidate.name.to_lowercase());
        let slips = if candidate.preferred { slips - PREFERENCE } else { slips };
        Self { name: candidate.name, slips, likeness }
    }

    /// Fewer slips first, then the more alike, then by name, so that the order never depends on the candidates' order.
    fn order(&self, other: &Self) -> Ordering {
        let slips = self.slips.total_cmp(&other.slips);
        slips.then(other.likeness.total_cmp(&self.likeness)).then(self.name.cmp(other.name))
    }
}

impl Word {
    fn new(name: &str) -> Self {
        Self { lower: name.to_lowercase(), length: name.chars().count() }
    }

    /// Slips that a name of this length may have and still be recognised.
    fn allowed(&self) -> usize {
        (self.length / 3).clamp(1, 4)
    }

    /// The slips between this word and a candidate, or `None` if it is not near.
    fn slips(&self, candidate: &str) -> Option<f64> {
        let lower = candidate.to_lowercase();
        if lower == self.lower {
            return Some(0.25);
        }
        if stem(&lower) == stem(&self.lower) {
            return Some(0.5);
        }
        // Every letter is one slip from every other, which says nothing.
        if self.length == 1 {
            return None;
        }
        let difference = lower.chars().count().abs_diff(self.length);
        let slips = if difference <= self.allowed() { damerau_levenshtein(&self.lower, &lower) } else { usize::MAX };
        // Half the length replaced is another name: `a` is no slip of `b` unless names are that short.
        if slips <= self.allowed() && (slips < self.length.min(lower.len()) || self.length <= 2) {
            return Some(slips as f64);
        }
        let part =
            self.length >= 4 && (lower.contains(&self.lower) || (lower.len() >= 4 && self.lower.contains(&lower)));
        part.then_some(self.allowed() as f64 + 1.0)
    }
}

fn stem(lower: &str) -> &str {
    PREFIXES.iter().find_map(|p| lower.strip_prefix(p)).filter(|s| s.len() >= 2).unwrap_or(lower)
}
