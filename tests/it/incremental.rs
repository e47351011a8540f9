//! What a session keeps from one question to the next: never another byte than a fresh session gives, never more than the bound.

use std::sync::Arc;
use std::time::Duration;

use yont::host::Memory;
use yont::interrupt::{Interrupt, Kept};
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, Format, Options, Output, Precision};
use yont::syntax::Mode;

/// Balls, rods, boxes and a shell, each of a definition of its own over two parameters, put together in groups, one of them smoothly.
const PARTS: usize = 12;

/// The values of the parameters, and which parts are taken away instead of added.
#[derive(Clone)]
struct Design {
    radius: [f64; PARTS],
    shift: [f64; PARTS],
    taken: [bool; PARTS],
    alpha: f64,
}

impl Design {
    fn parameter(&self, k: usize) -> String {
        format!("r{k} = {}; s{k} = {};", self.radius[k], self.shift[k])
    }

    fn part(k: usize) -> String {
        let [x, y, z] = [k % 3, k / 3 % 2, k / 6].map(|i| i as f64 * 0.8 - 0.8);
        let (x, y, z) = (format!("(x1 - ({x}) - s{k})"), format!("(x2 - ({y}))"), format!("(x3 - ({z}))"));
        match k % 4 {
            0 => format!("gob_{k} = r{k}**2 - {x}**2 - {y}**2 - {z}**2;"),
            1 => format!("gob_{k} = (r{k}**2 - {x}**2 - {y}**2) & (0.4 - ABS({z}));"),
            2 => format!("gob_{k} = (r{k} - ABS({x})) & (r{k} - ABS({y})) & (r{k} - ABS({z}));"),
            _ => format!("gob_{k} = 0.05 - ABS(SQRT({x}**2 + {y}**2 + {z}**2) - r{k}) - 0.02*x4;"),
        }
    }

    fn whole(&self) -> String {
        let mut all = String::from("gob_all = -9");
        for k in 0..PARTS {
            let op = if self.taken[k] { "\\" } else { "|" };
            all = if k == 5 { format!("{all} | SQRT(0.1 + gob_{k}**2) - 0.32") } else { format!("{all} {op} gob_{k}") };
        }
        all + ";"
    }

    /// All of it as one program.
    fn program(&self) -> String {
        let parts: Vec<String> = (0..PARTS).map(|k| self.parameter(k) + &Self::part(k)).collect();
        let space = "x1min = -1.6; x1max = 1.6; x2min = -1.6; x2max = 1.6; x3min = -1.6; x3max = 1.6; \
                     x4min = 0; x4max = 1; x4 : T;";
        format!("r_alpha = {};\n{}\n{}\n{space}", self.alpha, parts.join("\n"), self.whole())
    }
}

/// The same numbers each time.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % n
    }
}

fn session(limits: Limits, program: &str) -> Session {
    let mut session = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
    take(&mut session, program);
    session
}

fn take(session: &mut Session, text: &str) {
    let outcome = session.input("design.geo", text, Mode::Script);
    assert!(outcome.accepted, "{text}: {:?}", outcome.diagnostics);
}

/// What is asked: a format, or measures.
#[derive(Clone, Copy, Debug)]
struct Question {
    format: Option<&'static str>,
    cells: usize,
    precision: Precision,
}

impl Question {
    fn one(random: &mut Random) -> Self {
        let format = [Some("stl"), Some("stl"), Some("ply"), Some("png"), Some("svg"), None][random.below(6)];
        let precision = if random.below(8) == 0 { Precision::Single } else { Precision::Double };
        Self { format, cells: [40, 64][random.below(2)], precision }
    }

    /// The bytes of the answer, and all that is told with it.
    fn ask(self, session: &mut Session) -> (Vec<u8>, String) {
        let mut options = Options::default();
        options.view.cells = Cells::Along(self.cells);
        options.view.precision = self.precision;
        options.view.at = vec![(request::Coordinate(4), 0.5)];
        options.picture.size = Some((48, 36));
        let Some(format) = self.format else {
            return match request::measure(session, &options.view) {
                Ok(measured) => (measured.json().to_string().into_bytes(), format!("{:?}", measured.notes)),
                Err(told) => (Vec::new(), format!("{told:?}")),
            };
        };
        if format == "svg" {
            options.view.at.push((request::Coordinate(3), 0.1));
        }
        let output = Output::parse("-", Format::by_extension(format)).expect("a format");
        let mut bytes = Vec::new();
        let told = request::write(session, &output, &options, &mut bytes).map(|written| written.notes);
        (bytes, format!("{told:?}"))
    }
}

/// One edit as it is typed, and the design after it.
fn edit(design: &mut Design, random: &mut Random) -> String {
    let k = random.below(PARTS);
    match random.below(8) {
        0 => {
            design.taken[k] = !design.taken[k];
            design.whole()
        }
        1 => {
            design.alpha = [0.0, 0.5, 1.0][random.below(3)];
            design.program()
        }
        2 | 3 => {
            design.shift[k] = random.below(9) as f64 * 0.03 - 0.12;
            format!("s{k} = {};", design.shift[k])
        }
        // A value from before, now and then.
        4 => String::new(),
        _ => {
            design.radius[k] = 0.2 + random.below(12) as f64 * 0.02;
            format!("r{k} = {};", design.radius[k])
        }
    }
}

fn first() -> Design {
    let taken = std::array::from_fn(|k| k % 5 == 4);
    Design { radius: [0.4; PARTS], shift: [0.0; PARTS], taken, alpha: 1.0 }
}

/// Adds up what was kept since the last call.
fn tally(session: &Session, all: &mut [u64; 3]) -> Kept {
    let kept = session.interrupt().costs().kept;
    all[0] += kept.wholes.iter().map(|(_, count)| count).sum::<u64>();
    (all[1], all[2]) = (all[1] + kept.pieces[0], all[2] + kept.pieces[1]);
    session.interrupt().reset();
    kept
}

#[test]
fn edits_of_a_session_give_the_bytes_of_a_fresh_one() {
    // Once with room for everything, once with so little that most is thrown out again.
    for (reuse_bytes, seed, edits) in [(Limits::default().reuse_bytes, 7, 350), (300_000, 8, 150)] {
        let limits = Limits { reuse_bytes, ..Limits::default() };
        let (mut random, mut design, mut all) = (Random(seed), first(), [0; 3]);
        let mut session = session(limits, &design.program());
        for round in 0..edits {
            let typed = edit(&mut design, &mut random);
            take(&mut session, &typed);
            let question = Question::one(&mut random);
            let answer = question.ask(&mut session);
            let fresh = Limits { reuse_bytes: 0, ..Limits::default() };
            let mut fresh = self::session(fresh, &design.program());
            let (bytes, told) = question.ask(&mut fresh);
            assert!(answer.0 == bytes, "round {round}, {question:?} after `{typed}`: other bytes");
            assert_eq!(answer.1, told, "round {round}, {question:?} after `{typed}`");
            assert!(fresh.interrupt().costs().kept.is_nothing(), "nothing is kept without room");
            tally(&session, &mut all);
            let held = session.interrupt().reuse().expect("a session keeps results").bytes();
            assert!(held <= reuse_bytes, "{held} bytes");
        }
        let [wholes, kept, pieces] = all;
        eprintln!("{reuse_bytes} bytes: {wholes} whole results and {kept} of {pieces} pieces kept");
        assert!(wholes > 0 && kept > pieces / 20 && kept < pieces, "{all:?}");
    }
}

#[test]
fn what_did_not_change_is_not_computed_again() {
    let mut session = session(Limits::default(), &first().program());
    let question = Question { format: Some("obj"), cells: 128, precision: Precision::Double };
    let mut all = [0; 3];
    question.ask(&mut session);
    assert!(tally(&session, &mut all).is_nothing(), "nothing is kept from nothing");
    question.ask(&mut session);
    assert_eq!(tally(&session, &mut all).wholes, [("meshes", 1)]);
    take(&mut session, "r0 = 0.3;");
    question.ask(&mut session);
    let kept = tally(&session, &mut all);
    eprintln!("after an edit: {kept}");
    assert!(kept.wholes.is_empty() && 2 * kept.points[0] > kept.points[1], "one of twelve parts changed: {kept:?}");
    // Another file of the same, and back to the first.
    Question { format: Some("ply"), ..question }.ask(&mut session);
    assert_eq!(tally(&session, &mut all).wholes, [("meshes", 1)]);
    session.undo();
    question.ask(&mut session);
    assert_eq!(tally(&session, &mut all).wholes, [("meshes", 1)]);
}

/// Frames of an animation have in common what does not move.
#[test]
fn frames_share_what_does_not_move() {
    let program = "gob_a = (0.09 - x1**2 - x2**2 - SIN(x3)**2) | (0.04 - (x1 - 1.2)**2 - (x2 - 0.5*x4)**2 - x3**2);
        x1min = -0.5; x1max = 1.6; x2min = -0.5; x2max = 0.8; x3min = -0.5; x3max = 0.5; x4min = 0; x4max = 1; x4 : T;";
    for (format, more) in [("glb", ""), ("gif", ""), ("gif", "gob_b = gob_a AT (x3 = 0.01);")] {
        let animation = |reuse_bytes| {
            let mut session = session(Limits { reuse_bytes, ..Limits::default() }, &format!("{program} {more}"));
            let mut options = Options::default();
            options.timing.frames = Some(4);
            options.view.cells = Cells::Along(96);
            options.picture.size = Some((96, 72));
            let output = Output::parse("-", Format::by_extension(format)).expect("a format");
            let mut bytes = Vec::new();
            request::write(&mut session, &output, &options, &mut bytes).expect("an animation");
            (bytes, session.interrupt().costs().kept)
        };
        let (plain, kept) = (animation(0).0, animation(Limits::default().reuse_bytes));
        eprintln!("{format} {more}: {}", kept.1);
        assert!(kept.0 == plain, "{format}: other bytes");
        // Roots of rays are found anew, so points and boxes count together.
        let [shared, all] = [0, 1].map(|i| kept.1.points[i] + kept.1.boxes[i]);
        assert!(5 * shared > all, "{format}: {:?}", kept.1);
    }
}

/// The bytes that all of one answer takes are enough for it, and one less is not.
#[test]
fn the_bound_of_what_is_kept_holds_to_the_byte() {
    let question = Question { format: Some("png"), cells: 40, precision: Precision::Double };
    let program = first().program();
    let held = |reuse_bytes: usize| {
        let mut session = session(Limits { reuse_bytes, ..Limits::default() }, &program);
        let bytes = question.ask(&mut session).0;
        let held = session.interrupt().reuse().expect("a session keeps results").bytes();
        assert!(held <= reuse_bytes);
        (held, bytes)
    };
    let (all, bytes) = held(Limits::default().reuse_bytes);
    assert!(all > 1000, "{all}");
    for (reuse_bytes, is_enough) in [(all, true), (all - 1, false), (0, false)] {
        let (fits, same) = held(reuse_bytes);
        assert_eq!(fits == all, is_enough, "{fits} of {all} bytes within {reuse_bytes}");
        assert!(same == bytes, "other bytes within {reuse_bytes}");
    }
}

#[test]
fn what_was_broken_off_leaves_nothing_false_behind() {
    let mut design = first();
    let mut session = session(Limits::default(), &design.program());
    let mut random = Random(3);
    for round in 0..24 {
        let typed = edit(&mut design, &mut random);
        take(&mut session, &typed);
        let question = Question { format: Some(["stl", "png"][round % 2]), cells: 64, precision: Precision::Double };
        let interrupt = session.interrupt().clone();
        let wait = Duration::from_micros(200 * round as u64);
        let stopper = std::thread::spawn(move || {
            std::thread::sleep(wait);
            interrupt.cancel();
        });
        let mut options = Options::default();
        options.view.cells = Cells::Along(question.cells);
        options.view.at = vec![(request::Coordinate(4), 0.5)];
        options.picture.size = Some((48, 36));
        let output = Output::parse("-", Format::by_extension(question.format.unwrap_or("stl"))).expect("a format");
        // It may be done before it is stopped.
        let _ = request::write(&mut session, &output, &options, &mut Vec::new());
        stopper.join().expect("it stops");
        session.interrupt().reset();
        let answer = question.ask(&mut session);
        let mut fresh = self::session(Limits { reuse_bytes: 0, ..Limits::default() }, &design.program());
        assert!(answer == question.ask(&mut fresh), "round {round}: another answer after `{typed}`");
    }
}
