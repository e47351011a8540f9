//! What a stroke costs on a workpiece that has 10, 1,000 and 5,000 already, from the command to the picture in memory, and what writing the PNG
//! takes besides. The 10 lie where the further strokes are made, as close to each other as the 1,000 that lie all over the workpiece; so do
//! 10 that are strewn over all of it, and 5,000 are five times as close. The rounds go through all of them in turn; medians are printed:
//! `cargo bench --bench carving`; a number after `--` is how many rounds.

#![allow(clippy::print_stdout, clippy::print_stderr)]

use std::fmt::Write as _;
use std::sync::Arc;
use std::time::{Duration, Instant};

use yont::export;
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::carving::{Carving, Drawn, Place, Way};
use yont::model::request::Options;
use yont::picture::View;
use yont::syntax::Mode;

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A ball with so many strokes, each with one of three tools, some with a blend: those of `of` all over it that are nearest to the middle of
/// the picture.
fn program(strokes: usize, of: usize) -> String {
    let mut random = Random(7);
    let eye = View::default().axes()[2].map(|v| -v);
    let mut sites: Vec<[f64; 3]> = (0..of)
        .map(|_| {
            let (z, a) = (2.0 * random.unit() - 1.0, std::f64::consts::TAU * random.unit());
            let r = (1.0 - z * z).sqrt();
            [r * a.cos(), r * a.sin(), z]
        })
        .collect();
    let towards = |p: &[f64; 3]| (0..3).map(|k| p[k] * eye[k]).sum::<f64>();
    sites.sort_by(|p, q| towards(q).total_cmp(&towards(p)));
    let mut text = String::from("gob_work = pob_sphere_d([0, 0, 0], 1);\n");
    for (k, [x, y, z]) in sites.into_iter().take(strokes).enumerate() {
        let at = format!("[{x:.5}, {y:.5}, {z:.5}]");
        let (verb, blend) = (["tr_carve", "tr_chase"][k % 2], [0.0, 0.01, 0.0][k % 3]);
        let tool = match k % 3 {
            0 => format!("tr_shift(pob_sphere_d([0, 0, 0], 0.04), {at})"),
            1 => format!("tr_shift(pob_sphere_d([0, 0, 0], 0.03), {at})"),
            _ => format!("tr_place(pob_tool_ellipsoid(0.06, 0.03, 0.03), {at}, {at}, 0)"),
        };
        let _ = writeln!(text, "gob_work = {verb}(gob_work, {tool}, {blend});");
    }
    text
}

fn median(times: &mut [Duration]) -> f64 {
    times.sort_unstable();
    times[times.len() / 2].as_secs_f64() * 1e3
}

struct Case {
    what: String,
    session: Session,
    carving: Carving,
    times: [Vec<Duration>; 3],
    pixels: usize,
}

impl Case {
    fn new((strokes, of): (usize, usize)) -> Self {
        let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
        assert!(session.input("work.geo", &program(strokes, of), Mode::Script).accepted);
        let begun = Instant::now();
        let mut options = Options::default();
        options.picture.size = Some((640, 480));
        let (mut carving, _) = Carving::begin(&mut session, &options).expect("a workpiece");
        eprintln!("{strokes} strokes: the first picture took {:.0} ms", begun.elapsed().as_secs_f64() * 1e3);
        assert_eq!(carving.count(), strokes);
        carving.take(&mut session, "ball 0.05").expect("a tool");
        let around = if strokes < of { " where they are made" } else { " all over" };
        Self { what: format!("{strokes}{around}"), session, carving, times: Default::default(), pixels: 0 }
    }

    /// A stroke and its undo, and the PNG between them.
    fn round(&mut self, pixel: [f64; 2], way: Way) {
        let begun = Instant::now();
        let (_, drawn) = self.carving.strokes(&mut self.session, way, &[Place::Pixel(pixel)]).expect("a stroke");
        self.times[0].push(begun.elapsed());
        if let Drawn::Part(pixels) = drawn {
            self.pixels += pixels;
        }
        let begun = Instant::now();
        let mut bytes = Vec::new();
        export::png::write(self.carving.image(), &mut bytes).expect("room");
        self.times[2].push(begun.elapsed());
        let begun = Instant::now();
        self.session.undo();
        self.carving.follow(&mut self.session).expect("a picture");
        self.times[1].push(begun.elapsed());
    }
}

fn main() {
    let rounds: usize = std::env::args().find_map(|word| word.parse().ok()).unwrap_or(60);
    let is_test = std::env::args().any(|word| word == "--test");
    let rounds = if is_test { 1 } else { rounds };
    let counts = if is_test {
        [(1, 10), (10, 10), (50, 50), (100, 100)]
    } else {
        [(10, 1_000), (1_000, 1_000), (10, 10), (5_000, 5_000)]
    };
    let mut cases = counts.map(Case::new);
    let mut random = Random(3);
    for round in 0..rounds {
        // Pixels of the middle, about which the first strokes lie.
        let pixel = [300.0 + (40.0 * random.unit()).floor(), 220.0 + (40.0 * random.unit()).floor()];
        for case in &mut cases {
            case.round(pixel, if round % 2 == 0 { Way::Cut } else { Way::Raise });
        }
    }
    println!("| cutters before | stroke, ms | against the first | undo, ms | PNG, ms | pixels redrawn |");
    println!("|---|---|---|---|---|---|");
    let mut first = None;
    for case in &mut cases {
        let [stroke, undo, png] = case.times.each_mut().map(|times| median(times));
        let ratio = stroke / *first.get_or_insert(stroke);
        println!("| {} | {stroke:.2} | {ratio:.2} | {undo:.2} | {png:.2} | {} |", case.what, case.pixels / rounds);
    }
}
