//! Every format of every example, made small, read back by readers that share no code with the writers, and compared with the boundary in
//! memory; the same bytes with one, two and eight threads.

#[path = "readback/files.rs"]
pub mod files;
#[path = "readback/pov.rs"]
pub mod pov;

use std::collections::BTreeSet;

use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, FORMATS, Format, Kind, Options, Output, Route, Sequence, Subject};
use yont::surface::contour::outlines;
use yont::surface::{Mesh, extract};
use yont::syntax::Mode;
use yont::vm::Demand;

use crate::examples::{examples, loaded};
use files::{Read, area, closed, volume};

/// Cells along the longest side, and pixels of a picture: enough for every example to show.
const CELLS: usize = 18;
const SIZE: (usize, usize) = (32, 24);

/// Formats whose numbers are singles keep this much of a volume; the others all of it.
const SINGLE: f64 = 1e-5;

fn options() -> Options {
    let mut options = Options::default();
    options.view.cells = Cells::Along(CELLS);
    options.view.route = Route::Cubes;
    options.picture.size = Some(SIZE);
    options.picture.supersample = 1;
    options
}

/// What became of one format: bytes, or the code of the refusal.
type Made = Result<Vec<u8>, &'static str>;

/// One format of the last object of a session; a solid as outlines is cut into slices.
fn make(session: &mut Session, format: Format, subject: &Subject) -> Made {
    let mut options = options();
    if let (Kind::Outlines, [_, _, z]) = (format.kind(), subject.axes.as_slice()) {
        let [lo, hi] = z.range;
        let values = (1..4).map(|k| lo + (hi - lo) * f64::from(k) / 4.0).collect();
        options.slices = Some(Sequence { coordinate: z.coordinate, values });
    }
    let output = Output::parse("-", Some(format)).expect("a format");
    let mut bytes = Vec::new();
    match request::write(session, &output, &options, &mut bytes) {
        Ok(_) => Ok(bytes),
        Err(told) => {
            assert!(bytes.is_empty() && told.len() == 1 && !told[0].help.is_empty(), "{format:?}: {told:?}");
            Err(told[0].code)
        }
    }
}

/// All formats of an example with so many threads, and what is shown.
fn all(name: &str, text: &str, threads: usize) -> (Vec<(Format, Made)>, Subject, Session) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    pool.install(|| {
        let mut session = loaded(name, text).0;
        let options = options();
        let subject = request::subject(&mut session, &options.view, &options.timing).expect("a subject");
        let made = FORMATS.iter().map(|entry| (entry.0, make(&mut session, entry.0, &subject))).collect();
        (made, subject, session)
    })
}

/// The meshes in memory that a format must hold: one, a group, or all frames.
fn expected(subject: &Subject, session: &Session, format: Format) -> Vec<Mesh> {
    let limits = Limits::default();
    let grid = subject.grid(Cells::Along(CELLS), &limits).expect("a grid");
    let members = subject.members(session.graph(), Demand::Sign, &limits).expect("members");
    let moves = format == Format::Glb && members.len() == 1;
    let moments = if moves { subject.moments() } else { subject.moments()[..1].to_vec() };
    let shapes = members.iter().flat_map(|member| moments.iter().map(|&at| subject.at(&member.shape, at)));
    let meshes = shapes.map(|shape| extract(&shape, &grid, &limits, &Interrupt::default()).expect("a mesh").mesh);
    meshes.filter(|mesh| !mesh.is_empty()).collect()
}

fn compare_meshes(what: &str, read: &Read, expected: &[Mesh], precision: f64) {
    assert_eq!(read.meshes.len(), expected.len(), "{what}: how many meshes");
    for ((name, found), wanted) in read.meshes.iter().zip(expected) {
        assert_eq!(found.triangles.len(), wanted.triangles.len(), "{what}, {name}: triangles");
        closed(found).unwrap_or_else(|fault| panic!("{what}, {name}: {fault}"));
        let ([is, within], [must, _]) = (volume(found), volume(wanted));
        assert!((is - must).abs() <= precision * within, "{what}, {name}: the volume is {is}, not {must}");
        assert!(must > 0.0, "{what}, {name}: inside out");
        for normal in &found.normals {
            let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
            assert!((length - 1.0).abs() < 1e-5, "{what}, {name}: a normal of length {length}");
        }
    }
}

/// Outlines in memory at the sections that the file names, by area.
fn compare_outlines(what: &str, bytes: &[u8], subject: &Subject, session: &Session) {
    let read = files::svg(bytes);
    let limits = Limits::default();
    let plane = match subject.axes.as_slice() {
        [_, _, z] => {
            let [lo, hi] = z.range;
            let values = (1..4).map(|k| lo + (hi - lo) * f64::from(k) / 4.0).collect();
            subject.clone().sliced(&Sequence { coordinate: z.coordinate, values }).expect("an axis")
        }
        _ => subject.clone(),
    };
    let [x, y] = [plane.axes[0].range, plane.axes[1].range];
    assert_eq!(read.view, [x[0], -y[1], x[1] - x[0], y[1] - y[0]], "{what}: the view box");
    assert_eq!(read.millimetres, [x[1] - x[0], y[1] - y[0]], "{what}: a unit is a millimetre");
    let grid = plane.grid(Cells::Along(CELLS), &limits).expect("a grid");
    let members = plane.members(session.graph(), Demand::Sign, &limits).expect("members");
    assert_eq!(read.groups.len(), members.len(), "{what}: a group for each section");
    for (found, member) in read.groups.iter().zip(&members) {
        let shape = plane.at(&member.shape, plane.moments()[0]);
        let wanted = outlines(&shape, &grid, &limits, &Interrupt::default()).expect("outlines");
        assert_eq!(found.loops.len(), wanted.lines.len(), "{what}: loops at {:?}", member.marks);
        for (name, value) in &member.marks {
            assert_eq!(found.marks.get(name), Some(value), "{what}: {name}");
        }
        let is: f64 = found.loops.iter().map(|points| area(points)).sum();
        assert!((is - wanted.area()).abs() < 1e-6 * (1.0 + wanted.area().abs()), "{what}: the area is {is}");
    }
}

/// Each sample against the function, evaluated point by point.
fn compare_samples(what: &str, bytes: &[u8], subject: &Subject, session: &mut Session) {
    let (field, samples) = files::nrrd(bytes);
    let axes = &subject.axes;
    assert_eq!(field.size.len(), axes.len(), "{what}: axes");
    let highest = axes.iter().map(|axis| usize::from(axis.coordinate.0)).max().unwrap_or(0);
    let last: Vec<f64> =
        (0..axes.len()).map(|k| field.origin[k] + (field.size[k] - 1) as f64 * field.step[k]).collect();
    for (k, axis) in axes.iter().enumerate() {
        let room = 1e-9 * (axis.range[1] - axis.range[0]);
        assert!((field.origin[k] - axis.range[0]).abs() < room && (last[k] - axis.range[1]).abs() < room, "{what}");
    }
    let mut options = options();
    options.view.at = subject.fixed.iter().filter(|f| axes.iter().all(|a| a.coordinate != f.0)).copied().collect();
    options.view.at.extend(subject.time.iter().map(|time| (time.coordinate, subject.moments()[0])));
    let place = |mut n: usize| {
        let mut point = vec![0.0; highest];
        for (k, axis) in axes.iter().enumerate() {
            point[usize::from(axis.coordinate.0) - 1] = field.origin[k] + (n % field.size[k]) as f64 * field.step[k];
            n /= field.size[k];
        }
        point
    };
    let every: Vec<usize> = (0..samples.len()).step_by(7).collect();
    let points: Vec<Vec<f64>> = every.iter().map(|&n| place(n)).collect();
    let values = request::sample(session, &options.view, &points, false).expect("values");
    for (&n, wanted) in every.iter().zip(values) {
        let (is, must) = (f64::from(samples[n]), wanted.value);
        let close = (is - must).abs() <= 1e-6 * (1.0 + must.abs()) || is.is_nan() && must.is_nan();
        assert!(close, "{what}: sample {n} is {is}, not {must}");
    }
}

fn compare(name: &str, format: Format, bytes: &[u8], subject: &Subject, session: &mut Session) {
    let what = format!("{name} as {format:?}");
    let frames = subject.moments().len();
    let read = match format {
        Format::Stl => files::stl(bytes),
        Format::Obj => files::obj(bytes),
        Format::Ply => files::ply(bytes),
        Format::Glb => files::glb(bytes),
        Format::ThreeMf => files::threemf(bytes),
        Format::Pov => {
            let scene = pov::read(bytes);
            compare_functions(&what, &scene, subject, session);
            scene.read
        }
        Format::Svg => return compare_outlines(&what, bytes, subject, session),
        Format::Nrrd => return compare_samples(&what, bytes, subject, session),
        Format::Png => return pictures(&what, files::png(bytes), 1, subject),
        Format::Apng => return pictures(&what, files::png(bytes), frames, subject),
        Format::Gif => return pictures(&what, files::gif(bytes), frames, subject),
    };
    let precision = if format == Format::Obj { 1e-12 } else { SINGLE };
    compare_meshes(&what, &read, &expected(subject, session, format), precision);
}

/// A number from -1 to 1 that comes of two whole ones.
fn shuffled(seed: u64, n: u64) -> f64 {
    let mut x = (seed << 32 | n).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    ((x ^ (x >> 32)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// The functions of a scene of one object against its function, and against the slope that they are said to have.
pub fn compare_functions(what: &str, scene: &pov::Scene, subject: &Subject, session: &mut Session) {
    for (_, isosurface) in &scene.isosurfaces {
        let bounds = subject.bounds();
        assert_eq!([isosurface.lo, isosurface.hi], [0, 1].map(|end| [0, 1, 2].map(|k| bounds[k][end])), "{what}");
        let place = |n: u64| -> [f64; 3] {
            std::array::from_fn(|k| {
                let [lo, hi] = bounds[k];
                0.5 * (lo + hi) + 0.5 * (hi - lo) * shuffled(k as u64, n)
            })
        };
        let places: Vec<[f64; 3]> = (0..400).map(place).collect();
        let mut options = options();
        options.view.at = subject.fixed.clone();
        options.view.at.extend(subject.time.iter().map(|time| (time.coordinate, subject.moments()[0])));
        options.view.object = Some(subject.name.to_string());
        let highest = subject.axes.iter().map(|axis| usize::from(axis.coordinate.0)).max().unwrap_or(0);
        let point = |at: &[f64; 3]| {
            let mut point = vec![0.0; highest];
            subject.axes.iter().zip(at).for_each(|(axis, &c)| point[usize::from(axis.coordinate.0) - 1] = c);
            point
        };
        let points: Vec<Vec<f64>> = places.iter().map(point).collect();
        let values = request::sample(session, &options.view, &points, false).expect("values");
        let size = values.iter().map(|v| v.value.abs()).filter(|v| v.is_finite()).fold(0.0, f64::max);
        let longest = bounds.iter().map(|[lo, hi]| hi - lo).fold(0.0, f64::max);
        let mut cut = None;
        for (n, (at, value)) in places.iter().zip(&values).enumerate() {
            let (is, must) = (scene.value(isosurface, *at), -value.value);
            // What is far from the boundary may be cut off, with its sign, at one value.
            let close = (is - must).abs() <= 1e-12 * size;
            if !close && is.abs() < must.abs() && is * must > 0.0 {
                assert_eq!(*cut.get_or_insert(is.abs()), is.abs(), "{what}: cut off at {at:?}");
            } else {
                assert!(close, "{what}: {is}, not {must} at {at:?}");
            }
            let step: [f64; 3] = std::array::from_fn(|k| 1e-4 * longest * shuffled(3 + k as u64, n as u64));
            let length = step.iter().map(|c| c * c).sum::<f64>().sqrt();
            let other = std::array::from_fn(|k| (at[k] + step[k]).clamp(isosurface.lo[k], isosurface.hi[k]));
            let slope = (scene.value(isosurface, other) - is).abs() / length;
            assert!(slope <= isosurface.max_gradient * (1.0 + 1e-6), "{what}: as steep as {slope} at {at:?}");
        }
    }
}

/// Frames of one size, which is the asked one for one picture without a legend, and none of which is empty.
fn pictures(what: &str, frames: Vec<files::Frame>, count: usize, subject: &Subject) {
    assert_eq!(frames.len(), count, "{what}: frames");
    let sheet = subject.columns.is_some() || subject.rows.is_some();
    for frame in frames {
        let size = (frame.width, frame.height);
        let exact = subject.is_single() && !sheet;
        assert!(if exact { size == SIZE } else { size.0 >= SIZE.0 && size.1 >= SIZE.1 }, "{what}: {size:?}");
        assert_eq!(frame.rgba.len(), 4 * size.0 * size.1, "{what}");
        let colours: BTreeSet<[u8; 4]> = frame.rgba.as_chunks::<4>().0.iter().copied().collect();
        assert!(colours.len() > 1, "{what}: a picture of one colour");
    }
}

/// The refusals that are right: a mesh of what has two axes, and the like.
fn may_refuse(format: Format, code: &str, subject: &Subject) -> bool {
    let axes = subject.axes.len();
    match (format.kind(), code) {
        (Kind::Mesh, "dimension") => axes != 3,
        (Kind::Outlines, "dimension") => axes < 2,
        // Thinner than these cells, or beside the sections.
        (_, "empty-object") => {
            ["gob_shadow", "gob_flame", "gob_ribbon", "gob_table", "gob_block"].contains(&&*subject.name)
        }
        (_, "type-not-shown") => !subject.is_single() || subject.columns.is_some() || subject.rows.is_some(),
        _ => false,
    }
}

#[test]
fn every_format_of_every_example_reads_back_and_does_not_depend_on_threads() {
    let mut seen = BTreeSet::new();
    for (name, text) in examples() {
        let (made, subject, mut session) = all(&name, &text, 1);
        for threads in [2, 8] {
            for ((format, one), (_, other)) in made.iter().zip(all(&name, &text, threads).0) {
                assert!(*one == other, "{name} as {format:?}: other bytes with {threads} threads");
            }
        }
        for (format, made) in made {
            match made {
                Ok(bytes) => {
                    compare(&name, format, &bytes, &subject, &mut session);
                    seen.insert(format.extension());
                }
                Err(code) => assert!(may_refuse(format, code, &subject), "{name} as {format:?}: {code}"),
            }
        }
    }
    assert_eq!(seen.len(), FORMATS.len(), "each format is made of some example: {seen:?}");
}

/// The bytes of each format of meshes that knows colours, and of STL, from a script.
fn coloured(script: &str, format: Format) -> Read {
    let mut session = crate::session::session();
    let outcome = session.input("a.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}: {:?}", outcome.diagnostics);
    let options = options();
    let subject = request::subject(&mut session, &options.view, &options.timing).expect("a subject");
    let bytes = make(&mut session, format, &subject).unwrap_or_else(|code| panic!("{script} as {format:?}: {code}"));
    match format {
        Format::Stl => files::stl(&bytes),
        Format::Obj => files::obj(&bytes),
        Format::Ply => files::ply(&bytes),
        Format::Glb => files::glb(&bytes),
        Format::Pov => pov::read(&bytes).read,
        _ => files::threemf(&bytes),
    }
}

#[test]
fn the_colour_of_an_object_goes_into_every_format_that_knows_colours() {
    let ball = "gob_a = 1 + x4 - x1**2 - x2**2 - x3**2; x1min=-2;x1max=2;x2min=-2;x2max=2;x3min=-2;x3max=2;";
    type Colour = fn([f64; 3], f64) -> [f64; 3];
    let cases: [(&str, Colour); 4] = [
        ("x4 : CONSTANT = 0; gob_a : COLOR = [1, 0.5, 0];", |_, _| [1.0, 0.5, 0.0]),
        ("x4 : CONSTANT = 0; gob_a : COLOR = [0.5 + x1/2, 0.25, ABS(x3)];", |[x, _, z], _| {
            [0.5 + x / 2.0, 0.25, z.abs()]
        }),
        // Beyond 0 and 1 it is cut off.
        ("x4 : CONSTANT = 0; gob_a : COLOR = [3*x1, x1 - 9, 9 + x2];", |[x, ..], _| {
            [(3.0 * x).clamp(0.0, 1.0), 0.0, 1.0]
        }),
        ("x4min = 0; x4max = 0.5; x4_delta = 0.5; gob_a : COLOR = [x4, 1 - x4, x2**2/4];", |[_, y, _], t| {
            [t, 1.0 - t, y * y / 4.0]
        }),
    ];
    for (lines, colour) in cases {
        for format in [Format::Obj, Format::Ply, Format::Glb, Format::ThreeMf] {
            let read = coloured(&format!("{ball} {lines}"), format);
            for (n, ((name, mesh), colours)) in read.meshes.iter().zip(&read.colours).enumerate() {
                assert_eq!(colours.len(), mesh.positions.len(), "{lines} as {format:?}: a colour for each vertex");
                for (place, found) in mesh.positions.iter().zip(colours) {
                    let wanted = colour(*place, 0.5 * n as f64).map(|c| c * 255.0);
                    let close = (0..3).all(|k| (f64::from(found[k]) - wanted[k]).abs() <= 0.52);
                    assert!(close, "{lines} as {format:?}, {name}, at {place:?}: {found:?}, not {wanted:?}");
                }
            }
        }
        assert!(coloured(&format!("{ball} {lines}"), Format::Stl).colours[0].is_empty());
    }
    for format in [Format::Obj, Format::Ply, Format::Glb, Format::ThreeMf] {
        let read = coloured(&format!("{ball} x4 : CONSTANT = 0;"), format);
        assert!(read.colours[0].is_empty(), "{format:?}: colours that nobody gave");
    }
}

#[test]
fn several_objects_are_parts_under_their_names_or_are_refused() {
    let script = "gob_a = 1 - (x1 + 1.5)**2 - x2**2 - x3**2; gob_b = 0.5 + x4 - (x1 - 1.5)**2 - x2**2 - x3**2;
        gob_a : COLOR = [1, 0, 0]; x1min=-3;x1max=3;x2min=-2;x2max=2;x3min=-2;x3max=2; x4min=0; x4max=0.5; x4_delta=0.5;";
    let mut session = crate::session::session();
    assert!(session.input("a.geo", script, Mode::Script).accepted);
    let mut options = options();
    // The smaller ball is four cells across otherwise, too few for its volume.
    options.view.cells = Cells::Along(2 * CELLS);
    (options.view.object, options.view.beside) = (Some("gob_a".into()), vec!["gob_b".into()]);
    let mut made = |format| {
        let output = Output::parse("-", Some(format)).expect("a format");
        let mut bytes = Vec::new();
        request::write(&mut session, &output, &options, &mut bytes).map(|_| bytes)
    };
    for (format, frames) in [(Format::Obj, 1), (Format::Glb, 2), (Format::ThreeMf, 1)] {
        let bytes = made(format).unwrap_or_else(|told| panic!("{format:?}: {told:?}"));
        let read = match format {
            Format::Obj => files::obj(&bytes),
            Format::Glb => files::glb(&bytes),
            _ => files::threemf(&bytes),
        };
        assert_eq!(read.meshes.len(), 2 * frames, "{format:?}");
        for (n, ((name, mesh), colours)) in read.meshes.iter().zip(&read.colours).enumerate() {
            let (is, radius) = if n % 2 == 0 { ("gob_a", 1.0) } else { ("gob_b", (0.5 + 0.5 * (n / 2) as f64).sqrt()) };
            assert!(name.starts_with(is), "{format:?}: {name}");
            closed(mesh).unwrap_or_else(|fault| panic!("{format:?}, {name}: {fault}"));
            let ball = 4.0 / 3.0 * std::f64::consts::PI * f64::powi(radius, 3);
            assert!((volume(mesh)[0] / ball - 1.0).abs() < 0.1, "{format:?}, {name}");
            assert_eq!(colours.first().copied(), (n % 2 == 0).then_some([255, 0, 0]), "{format:?}, {name}");
        }
    }
    for format in [Format::Stl, Format::Ply] {
        let told = made(format).expect_err("one object a file");
        assert!(told[0].code == "several-objects" && told[0].help.iter().any(|h| h.contains(".glb")), "{told:?}");
    }
}
