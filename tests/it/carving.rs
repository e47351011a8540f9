//! Carving and chasing: a picture of which strokes redraw parts against one that is drawn from nothing, what undo brings back, what picking
//! finds, what a saved program means.

use std::sync::Arc;

use expect_test::expect_file;
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::carving::{Carving, Drawn, Place, TOOLS, Way, places};
use yont::model::request::{Coordinate, Options};
use yont::model::{Session, UNNAMED};
use yont::picture::easel::Easel;
use yont::picture::raycast::{Thing, render};
use yont::picture::{Image, Paint};
use yont::surface::sampler::Sampler;
use yont::syntax::Mode;
use yont::vm::{Demand, Program, Shape};

use super::cli::{folder, run};
use super::session::{messages, session};

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }
}

/// Workpieces: distances, squares, R-functions, colours and held coordinates.
const WORKPIECES: &[&str] = &[
    "gob_work = pob_sphere_d([0, 0, 0], 1);",
    "gob_work = pob_box([0, 0, 0], [2, 1.5, 0.4]); x1min = -1.2; x1max = 1.2; x2min = -1; x2max = 1; x3min = -0.5; x3max = 0.5;",
    "gob_work = pob_ellipsoid([0, 0, 0.2], 0.7, 0.8, 1) | pob_torus([0, 0, -0.6], 0.6, 0.25); gob_work : COLOR = [0.8, 0.5 + x3/4, 0.3];",
    "gob_work = 1 - x1**2 - x2**2 - x3**2 - x4/2; x4 : CONSTANT = 0.4;",
];

fn input(session: &mut Session, text: &str) {
    let outcome = session.input("<prompt>", text, Mode::Prompt);
    assert!(outcome.accepted, "{text}: {}", messages(&outcome));
}

fn begin(program: &str, size: (usize, usize)) -> (Session, Carving) {
    let mut session = session();
    input(&mut session, program);
    let mut options = Options::default();
    options.picture.size = Some(size);
    let (carving, _) = Carving::begin(&mut session, &options).unwrap_or_else(|told| panic!("{program}: {told:?}"));
    (session, carving)
}

/// The object as a shape of the session's whole graph.
fn shape(session: &mut Session) -> Shape {
    let object = session.object(Some("gob_work")).expect("an object");
    let held: Vec<(Coordinate, f64)> = object.uses.iter().filter(|c| c.0 > 3).map(|c| (c, 0.4)).collect();
    let inputs: Vec<Coordinate> = [1, 2, 3].map(Coordinate).into_iter().chain(held.iter().map(|h| h.0)).collect();
    let program = Program::compile(session.graph(), object.node, &inputs, Demand::Value, session.limits());
    Shape::new(program.expect("a program"), 3, held.iter().map(|h| h.1).collect())
}

fn values(shape: &Shape, points: &[[f64; 3]]) -> Vec<f64> {
    let column = |k: usize| points.iter().map(|p| p[k]).collect::<Vec<f64>>();
    let (x, y, z) = (column(0), column(1), column(2));
    let mut out = vec![0.0; points.len()];
    Sampler::new(shape).values(&shape.program, &[&x, &y, &z], &mut out);
    out
}

/// The picture of all strokes, drawn from nothing before the same camera: by the same search, and as `:render` would.
fn fresh(session: &mut Session, carving: &Carving) -> [Image; 2] {
    let easel = carving.easel();
    let shape = shape(session);
    let thing = Thing::opaque(shape, carving.paint().clone());
    let (space, camera, style) = (easel.space(), easel.camera(), easel.style());
    let interrupt = Interrupt::default();
    let mut drawn = Easel::new(space, camera, style);
    drawn.draw(&thing, &interrupt).expect("a picture");
    let rendered = render(&[thing], space, camera, style, &interrupt).expect("a picture");
    [drawn.image().clone(), rendered.image]
}

/// How many pixels differ, and by how many levels at most.
fn difference(a: &Image, b: &Image) -> (usize, u8) {
    assert_eq!([a.width, a.height], [b.width, b.height]);
    let pixels = a.rgba.chunks(4).zip(b.rgba.chunks(4));
    let levels = pixels.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0));
    levels.fold((0, 0), |(count, most), level| (count + usize::from(level > 0), most.max(level)))
}

/// A tool of any kind with any settings.
fn tool(random: &mut Random) -> String {
    let kind = &TOOLS[(random.unit() * TOOLS.len() as f64) as usize];
    let sizes: Vec<String> =
        kind.sizes.iter().map(|size| format!("{:.3}", size.1 * random.within(0.05, 0.2))).collect();
    let mut tool = format!("{} {}", kind.name, sizes.join(" "));
    if random.unit() < 0.5 {
        tool += &format!(" blend={:.3}", random.within(0.01, 0.1));
    }
    if random.unit() < 0.3 {
        tool += &format!(" depth={:.3}", random.within(0.01, 0.1));
    }
    if random.unit() < 0.3 {
        tool += &format!(" turn={:.0}", random.within(-180.0, 180.0));
    }
    tool
}

/// A pixel that shows the workpiece.
fn seen(random: &mut Random, carving: &mut Carving, session: &mut Session) -> [f64; 2] {
    let [from, to] = carving.seen().expect("something is seen");
    loop {
        let pixel = [0, 1].map(|k| random.within(from[k] as f64, to[k] as f64).floor());
        if carving.pick(session, Place::Pixel(pixel)).is_ok() {
            return pixel;
        }
    }
}

#[test]
fn strokes_draw_what_a_fresh_picture_shows() {
    for (n, program) in WORKPIECES.iter().enumerate() {
        let (mut session, mut carving) = begin(program, (200, 150));
        let mut random = Random(n as u64 + 1);
        let first = carving.image().clone();
        let mut all = vec![first];
        for k in 0..24 {
            let tool = tool(&mut random);
            carving.take(&mut session, &tool).unwrap_or_else(|told| panic!("{tool}: {told:?}"));
            let way = if random.unit() < 0.6 { Way::Cut } else { Way::Raise };
            let pixel = seen(&mut random, &mut carving, &mut session);
            let (_, drawn) = carving.strokes(&mut session, way, &[Place::Pixel(pixel)]).expect("a stroke");
            assert!(matches!(drawn, Drawn::Part(_)), "{tool}: {drawn:?}");
            if k % 3 == 0 {
                let [searched, rendered] = fresh(&mut session, &carving);
                let (count, levels) = difference(carving.image(), &searched);
                assert!(count <= 6 && levels <= 1, "{program} {tool}: {count} pixels by {levels}");
                let (count, levels) = difference(carving.image(), &rendered);
                // There the light may find depths by other means, so that the edge of a shadow lies a hair beside.
                assert!(count <= 60 && levels <= 24, "{program} {tool}: {count} pixels by {levels} of a rendered one");
            }
            all.push(carving.image().clone());
        }
        let last = all.pop().expect("a picture");
        for before in all.iter().rev() {
            assert!(session.undo().is_some());
            carving.follow(&mut session).expect("a picture");
            assert_eq!(difference(carving.image(), before), (0, 0), "{program}: undo");
        }
        while session.redo().is_some() {}
        carving.follow(&mut session).expect("a picture");
        assert_eq!(difference(carving.image(), &last), (0, 0), "{program}: redo");
    }
}

#[test]
fn a_saved_program_means_the_same() {
    let mut random = Random(5);
    let (mut session, mut carving) = begin(WORKPIECES[0], (160, 120));
    input(&mut session, "gob_star = 0.1 - NORM([x1, x2, 3*x3]) | pob_box_d([0, 0, 0], [0.3, 0.05, 0.05]);");
    for tool in ["gob_star 0.7 blend=0.05", "pob_torus_d([0, 0, 0], 0.1, 0.03)", "gouge 0.03 0.2 turn=30", "ball 0.1"] {
        carving.take(&mut session, tool).expect(tool);
        let line = places("60,40..90,80 70,90").expect("places");
        carving.strokes(&mut session, Way::Cut, &line).expect(tool);
    }
    let mut again = super::session::session();
    let text = session.save();
    assert!(again.input("saved.geo", &text, Mode::Script).accepted, "{text}");
    let points: Vec<[f64; 3]> = (0..2_000).map(|_| [0; 3].map(|_| random.within(-1.2, 1.2))).collect();
    let bits = |values: Vec<f64>| values.into_iter().map(f64::to_bits).collect::<Vec<u64>>();
    assert_eq!(bits(values(&shape(&mut session), &points)), bits(values(&shape(&mut again), &points)));
    carving.take(&mut session, "ball 0.2").expect("a tool");
    carving.strokes(&mut session, Way::Raise, &[Place::Point([0.0, 0.0, 1.0])]).expect("a point");
    // Strokes of a program are strokes: the next one redraws a part alone.
    let (mut next, _) = Carving::begin(&mut again, &Options::default()).expect("a workpiece");
    assert_eq!(next.count() + 1, carving.count());
    let (_, drawn) = next.strokes(&mut again, Way::Raise, &[Place::Pixel([320.0, 240.0])]).expect("a stroke");
    assert!(matches!(drawn, Drawn::Part(_)), "{drawn:?}");
}

#[test]
fn a_pixel_picks_the_point_that_it_shows() {
    for program in WORKPIECES {
        let (mut session, mut carving) = begin(program, (160, 120));
        let mut random = Random(9);
        for tool in ["ball 0.2 blend=0.05", "ellipsoid 0.3 0.1 0.1"] {
            carving.take(&mut session, tool).expect(tool);
            let pixel = seen(&mut random, &mut carving, &mut session);
            carving.strokes(&mut session, Way::Cut, &[Place::Pixel(pixel)]).expect(tool);
        }
        let shape = shape(&mut session);
        for _ in 0..60 {
            let pixel = seen(&mut random, &mut carving, &mut session);
            let spot = carving.pick(&mut session, Place::Pixel(pixel)).expect("a point");
            let at = carving.easel().camera().place(spot.point).expect("before the eye");
            let place = [0.5 * (at[0] + 1.0) * 160.0, 0.5 * (1.0 - at[1]) * 120.0];
            let off = (0..2).map(|k| (place[k] - pixel[k] - 0.5).abs()).fold(0.0, f64::max);
            assert!(off < 1e-6, "{program}: {off} pixels beside {pixel:?}");
            let value = values(&shape, &[spot.point])[0];
            assert!(value.abs() < 1e-9, "{program}: {value} at {:?}", spot.point);
            let length: f64 = spot.normal.iter().map(|v| v * v).sum();
            assert!((length - 1.0).abs() < 1e-12);
            let step = |h: f64| std::array::from_fn(|k| spot.point[k] + h * spot.normal[k]);
            let sides = values(&shape, &[step(-1e-5), step(1e-5)]);
            assert!(sides[0] > sides[1], "{program}: the normal points inwards at {:?}", spot.point);
        }
    }
}

/// Outside of its tool, grown by the blend, a stroke changes no sign.
#[test]
fn a_stroke_changes_nothing_outside_of_its_tool() {
    let mut random = Random(11);
    for kind in TOOLS {
        for (way, blend) in [(Way::Cut, 0.0), (Way::Raise, 0.0), (Way::Cut, 0.1), (Way::Raise, 0.1)] {
            let (mut session, mut carving) = begin(WORKPIECES[0], (160, 120));
            carving.take(&mut session, &format!("{} blend={blend}", kind.name)).expect(kind.name);
            let before = shape(&mut session);
            let (spots, _) = carving.strokes(&mut session, way, &[Place::Pixel([80.0, 60.0])]).expect(kind.name);
            let after = shape(&mut session);
            let placed = carving.tool().placed(way, &spots[0], 5);
            input(&mut session, &format!("tr_shift({placed}, [0, 0, 0])"));
            let tool = session.object(Some(UNNAMED)).expect("a tool").node;
            let program =
                Program::compile(session.graph(), tool, &[1, 2, 3].map(Coordinate), Demand::Value, session.limits());
            let tool = Shape::new(program.expect("a program"), 3, Vec::new());
            let points: Vec<[f64; 3]> =
                (0..4_000).map(|_| std::array::from_fn(|k| spots[0].point[k] + random.within(-0.4, 0.4))).collect();
            let (before, after, tool) = (values(&before, &points), values(&after, &points), values(&tool, &points));
            let mut changed = 0;
            for k in 0..points.len() {
                let differs = (before[k] >= 0.0) != (after[k] >= 0.0);
                changed += usize::from(differs);
                assert!(!differs || tool[k] >= -blend, "{} {way:?} {blend}: {:?}", kind.name, points[k]);
                assert!(tool[k] < 0.0 || (after[k] >= 0.0) == (way == Way::Raise), "{}: {:?}", kind.name, points[k]);
            }
            assert!(changed > 0, "{} changes nothing", kind.name);
        }
    }
}

#[test]
fn whatever_happens_to_the_workpiece_is_followed() {
    let (mut session, mut carving) = begin("r = 1; gob_work = pob_sphere_d([0, 0, 0], r);", (160, 120));
    carving.strokes(&mut session, Way::Cut, &[Place::Pixel([80.0, 60.0])]).expect("a stroke");
    let carved = carving.image().clone();
    assert_eq!(carving.follow(&mut session), Ok(Drawn::Same));
    for (text, drawn) in [
        ("a = 3;", Drawn::Same),
        ("r = 0.9;", Drawn::Whole),
        ("gob_work = gob_work & x3 + 0.5;", Drawn::Whole),
        ("gob_work = pob_box_d([0, 0, 0], [1, 1, 1]);", Drawn::Whole),
    ] {
        input(&mut session, text);
        assert_eq!(carving.follow(&mut session), Ok(drawn), "{text}");
        assert_eq!(difference(carving.image(), &fresh(&mut session, &carving)[0]).1, 0, "{text}");
    }
    session.reset();
    assert_eq!(carving.follow(&mut session).expect_err("gone")[0].code, "no-workpiece");
    while session.undo().as_deref() != Some("a = 3;") {}
    carving.follow(&mut session).expect("it is back");
    assert_eq!(difference(carving.image(), &carved), (0, 0));
    // A stroke that is stopped was not made.
    session.interrupt().cancel();
    let stopped = carving.strokes(&mut session, Way::Cut, &[Place::Pixel([70.0, 60.0])]).expect_err("stopped");
    assert_eq!(stopped[0].code, "cancelled");
    session.interrupt().reset();
    carving.follow(&mut session).expect("a picture");
    assert_eq!((carving.count(), difference(carving.image(), &carved)), (1, (0, 0)));
}

/// Each session of `carving.txt`, what is typed and what is said; `UPDATE_EXPECT=1` writes the messages anew.
#[test]
fn each_kind_of_message_about_carving() {
    let golden = include_str!("diagnostics/carving.txt");
    let mut found = String::new();
    for part in golden.split("=== ").skip(1) {
        let (name, rest) = part.split_once('\n').unwrap();
        let typed = rest.split("--- messages\n").next().unwrap();
        let folder = folder(&[]);
        let ran = run(folder.path(), &[], typed);
        assert_ne!(ran.status, Some(0), "{name}: nothing failed");
        found += &format!("=== {name}\n{typed}--- messages\n{}{}", ran.out, ran.err);
    }
    expect_file!["diagnostics/carving.txt"].assert_eq(&found);
}

#[test]
fn a_script_of_strokes_writes_its_picture() {
    let folder = folder(&[]);
    let typed = "gob_work = pob_sphere_d([0, 0, 0], 1);\n:carve gob_work a.png --size 160x120\n:tool ball 0.2\n:cut 80,60 70,50\n\
                 :raise 60,60..100,70\n:undo\n:redo\n:pick 80,60\n:tool\n:save a.geo\n";
    let ran = run(folder.path(), &[], typed);
    assert_eq!(ran.status, Some(0), "{}", ran.err);
    assert_eq!(ran.made, ["a.geo", "a.png"]);
    for (words, text) in [("2 strokes, 2 in all", &ran.err), ("in hand: ball 0.2", &ran.out), ("point [", &ran.out)] {
        assert!(text.contains(words), "no {words:?} in\n{text}");
    }
    let again = run(folder.path(), &["a.geo", "-o", "b.png"], "");
    assert_eq!(again.status, Some(0), "{}", again.err);
}

/// The memory of a session is its own: these are here to be the first to see it change.
#[test]
fn sessions_share_no_strokes() {
    let (mut one, mut first) = begin(WORKPIECES[0], (64, 48));
    let (mut other, mut second) = begin(WORKPIECES[0], (64, 48));
    first.strokes(&mut one, Way::Cut, &[Place::Pixel([32.0, 24.0])]).expect("a stroke");
    assert_eq!(second.follow(&mut other), Ok(Drawn::Same));
    assert_eq!((first.count(), second.count()), (1, 0));
    let limits = Limits { program_operations: 40, ..Limits::default() };
    let mut small = Session::new(Arc::new(Memory::default()), limits, Interrupt::default());
    input(&mut small, "gob_work = pob_sphere_d([0, 0, 0], 1);");
    let (mut carving, _) = Carving::begin(&mut small, &Options::default()).expect("small enough");
    let before = small.save();
    let mut told = None;
    for _ in 0..9 {
        told = carving.strokes(&mut small, Way::Cut, &[Place::Pixel([320.0, 240.0])]).err().or(told);
    }
    assert_eq!(told.expect("too large in the end")[0].code, "too-large");
    assert!(small.save().len() > before.len() && matches!(carving.paint(), Paint::Plain(_)));
}
