//! How often the name that was meant is found: random single slips over everything that has a name.

use yont::builtins::{self, Builtin};
use yont::cli::arguments::{Making, option_names};
use yont::cli::words::WORDS;
use yont::diagnostic::near::{Candidate, suggest};
use yont::repl::commands::TABLE;
use yont::syntax::scan::RESERVED;

/// Numbers that look random, the same each time.
struct Dice(u64);

impl Dice {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit
    }

    /// A letter of the kind that the name has.
    fn letter(&mut self, like: char) -> char {
        let letter = char::from(b'a' + self.below(26) as u8);
        if like.is_ascii_uppercase() { letter.to_ascii_uppercase() } else { letter }
    }

    /// A letter less, more, other, or two that changed places.
    fn slip(&mut self, name: &str) -> String {
        let mut letters: Vec<char> = name.chars().collect();
        let at = self.below(letters.len());
        match self.below(4) {
            0 => drop(letters.remove(at)),
            1 => letters.insert(at, self.letter(letters[at])),
            2 => letters[at] = self.letter(letters[at]),
            _ if at + 1 < letters.len() => letters.swap(at, at + 1),
            _ => drop(letters.remove(at)),
        }
        letters.into_iter().collect()
    }
}

/// Of many slips over names of three letters or more: how many lead back at once, how many lead to a few names with the right one among
/// them, and how many there were.
fn found(names: &[&str], meant: impl Fn(&str) -> Vec<String>) -> [usize; 3] {
    let mut dice = Dice(1995);
    let [mut first, mut among, mut all] = [0; 3];
    for name in names.iter().filter(|name| name.len() >= 3) {
        for _ in 0..40 {
            let slip = dice.slip(name);
            // A slip that gives another name, or the same one, is none that could be told.
            if names.iter().any(|other| other.eq_ignore_ascii_case(&slip)) {
                continue;
            }
            let meant = meant(&slip);
            all += 1;
            first += usize::from(meant.first().is_some_and(|meant| *meant == **name));
            among += usize::from(meant.iter().any(|meant| *meant == **name));
        }
    }
    [first, among, all]
}

#[test]
fn single_slips_lead_back() {
    let mut functions: Vec<&str> = builtins::all().flat_map(Builtin::names).collect();
    functions.extend(RESERVED);
    functions.extend(WORDS.iter().map(|word| word.0));
    functions.sort_unstable();
    functions.dedup();
    let commands: Vec<&str> = TABLE.iter().map(|command| command.name).collect();
    let own = option_names();
    let options: Vec<&str> = own.iter().map(String::as_str).collect();
    let users = [
        "gob_ball",
        "gob_csg",
        "gob_metamorp",
        "gob_swept",
        "pob_block_3D",
        "pob_sphere",
        "tr_bl_uni",
        "tr_twist",
        "rel_inside",
        "radius",
        "height",
        "width",
        "r1",
        "r2",
        "d1",
        "c2",
        "thickness",
        "x1min",
        "x4_delta",
        "offset",
        "count",
        "level",
    ];
    let near = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        move |slip: &str| {
            let all = names.iter().map(|name| Candidate { name, preferred: false });
            suggest(slip, all).into_iter().map(str::to_owned).collect()
        }
    };
    // Of options the message names one.
    let option = |slip: &str| {
        let words = Making::default().with(&format!("--{slip} 1")).expect_err("no such option");
        let meant = words.rsplit_once("'--").and_then(|(_, rest)| rest.split(['\'', ' ']).next());
        meant.map(str::to_owned).into_iter().collect()
    };
    let mut sum = [0, 0];
    for (what, [first, among, all]) in [
        ("functions and words", found(&functions, near(&functions))),
        ("commands", found(&commands, near(&commands))),
        ("options", found(&options, option)),
        ("names of users", found(&users, near(&users))),
    ] {
        println!("{what}: {first} at once, {among} among those named, of {all}");
        assert!(among * 100 >= all * 95, "{what}: {among} of {all}");
        sum = [sum[0] + first, sum[1] + all];
    }
    assert!(sum[0] * 100 >= sum[1] * 90, "{} of {} at once", sum[0], sum[1]);
}
