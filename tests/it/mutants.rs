//! Files and programs damaged by chance, the whole way from the text to a file: each is read or refused, and what is refused leaves no
//! file. `YONT_CASES=10000` runs that many of each; what takes more than a second is shown.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, Options, Output};
use yont::syntax::Mode;

use crate::conformance::Random;
use crate::data::gzip;
use crate::oracle::cases;

/// Numbers that are often forgotten.
const NUMBERS: &[&str] = &[
    "0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e308",
    "1e-320",
    "nan",
    "-inf",
    "65536",
    "4294967296",
    "1000000000000",
    "18446744073709551616",
    "9223372036854775807",
];

/// Damage of one kind or two.
fn damaged(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(2) {
        if bytes.is_empty() {
            return bytes;
        }
        let at = random.below(bytes.len());
        let end = (at + 1 + random.below(24)).min(bytes.len());
        match random.below(7) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = random.below(256) as u8,
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let chunk = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                drop(bytes.splice(to..to, chunk));
            }
            _ => {
                // A number instead of the next one.
                let digit = |b: &u8| b.is_ascii_digit();
                let Some(first) = bytes[at..].iter().position(digit).map(|n| at + n) else { continue };
                let last = bytes[first..].iter().position(|b| !digit(b)).map_or(bytes.len(), |n| first + n);
                let number = NUMBERS[random.below(NUMBERS.len())].bytes();
                drop(bytes.splice(first..last, number));
            }
        }
    }
    bytes
}

/// What is tried: the files there are, the program, and where its result goes.
struct Trial {
    files: Vec<(String, Vec<u8>)>,
    program: String,
    output: &'static str,
}

/// Runs the program; whether it made its file. A refusal says why, and leaves the files as they were.
fn made(trial: &Trial) -> bool {
    let limits = Limits {
        nesting: 200,
        loop_turns: 5_000,
        array_elements: 5_000,
        graph_nodes: 200_000,
        program_operations: 20_000,
        call_depth: 100,
        memory_bytes: 64 << 20,
        data_bytes: 16 << 20,
        frames: 6,
        // A space that nobody gave is sought among all coordinates, with as much work as is allowed.
        search_operations: 3_000_000,
        picture_side: 64,
        ..Limits::default()
    };
    let files: Vec<(&str, &[u8])> = trial.files.iter().map(|(name, bytes)| (name.as_str(), &bytes[..])).collect();
    let host = Arc::new(Memory::with(&files));
    let before = host.names();
    let mut session = Session::new(host.clone(), limits, Interrupt::default());
    let outcome = session.input("examples/a.geo", &trial.program, Mode::Script);
    if !outcome.accepted {
        assert!(outcome.diagnostics.iter().any(|d| d.is_error()), "refused without a word");
        assert_eq!(host.names(), before, "a refused program left a file");
        return false;
    }
    let mut options = Options::default();
    options.view.cells = Cells::Along(6);
    options.picture.size = Some((12, 9));
    let output = Output::parse(trial.output, None).expect("an output");
    match request::write(&mut session, &output, &options, &mut Vec::new()) {
        Ok(written) => {
            assert_eq!(host.names().len(), before.len() + written.files.len());
            true
        }
        Err(told) => {
            assert!(!told.is_empty() && told.iter().all(|d| !d.title.is_empty()), "refused without a word");
            assert_eq!(host.names(), before, "a failed output left a file");
            false
        }
    }
}

/// Runs so many trials on two threads with deep stacks, as the program has one; tells what was slow, and which one panicked.
#[allow(clippy::print_stderr)]
fn run(what: &str, count: usize, trial: impl Fn(&mut Random) -> Trial + Sync) {
    let (right, slow, panics) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicUsize::new(0));
    let one = |case: usize| {
        let trial = trial(&mut Random((case as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15)));
        let begun = Instant::now();
        let done = catch_unwind(AssertUnwindSafe(|| made(&trial)));
        let seconds = begun.elapsed().as_secs_f64();
        if seconds > 1.0 {
            slow.fetch_add(1, Ordering::Relaxed);
            eprintln!("{what}, case {case}: {seconds:.1} s for {}\n{}", trial.output, trial.program);
        }
        match done {
            Ok(made) => drop(right.fetch_add(usize::from(made), Ordering::Relaxed)),
            Err(_) => {
                panics.fetch_add(1, Ordering::Relaxed);
                eprintln!("{what}, case {case}: {}\n{}", trial.output, trial.program);
            }
        }
    };
    std::thread::scope(|scope| {
        for half in 0..2 {
            let one = &one;
            // A pool for each, so that no trial waits for another's work.
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
            let work = move || (half..count).step_by(2).for_each(|case| pool.install(|| one(case)));
            std::thread::Builder::new().stack_size(256 << 20).spawn_scoped(scope, work).expect("a thread");
        }
    });
    let [right, slow, panics] = [right, slow, panics].map(AtomicUsize::into_inner);
    eprintln!("{what}: {count} mutants, {right} of them right; {slow} took over a second");
    assert_eq!(panics, 0, "{what}: panics");
    assert!(right > 0 && right < count, "{what}: {right} of {count} are right, so nothing is tried");
}

fn volume(random: &mut Random, files: Vec<(String, Vec<u8>)>, name: &str, axes: usize) -> Trial {
    let kind = ["nearest", "trilinear", "tricubic"][random.below(3)];
    let coordinates = ["x1", "x1, x2", "x1, x2, x3"][axes - 1];
    let range: String = (1..=axes).map(|k| format!("x{k}min = -1; x{k}max = 4;")).collect();
    let program = format!("gob_a = INTERPOLATE(\"{kind}\", \"{name}\", {coordinates}) - 1; {range}");
    Trial {
        files,
        program,
        output: [["a.png", "a.nrrd"], ["a.svg", "a.png"], ["a.stl", "a.nrrd"]][axes - 1][random.below(2)],
    }
}

/// Small NRRD files of every kind: header, samples and number of axes.
fn volumes() -> Vec<(String, Vec<u8>, usize)> {
    let samples: Vec<u8> = (0..24).map(|n| n * 7 % 5).collect();
    let doubles: Vec<u8> = samples.iter().flat_map(|&b| f64::from(b).to_be_bytes()).collect();
    let text = samples.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ").into_bytes();
    let head = |fields: &str| format!("NRRD0005\n# made for tests\n{fields}\n");
    vec![
        (
            head("type: uint8\ndimension: 3\nsizes: 2 3 4\nspacings: 1 1.5 0.5\naxis mins: 0 1 nan\nencoding: raw\n"),
            samples.clone(),
            3,
        ),
        (
            head(
                "type: double\ndimension: 3\nspace dimension: 3\nsizes: 4 3 2\nspace directions: (1,0,0.5) (0,1,0) (0,0,2)\nspace origin: (0,0,0)\nkinds: domain domain domain\nendian: big\nencoding: gzip\n",
            ),
            gzip(&doubles),
            3,
        ),
        (head("type: int\ndimension: 2\nsizes: 6 4\nspacings: 0.5 0.5\nendian: little\nencoding: ascii\n"), text, 2),
        (
            head(
                "type: uchar\ndimension: 1\nsizes: 12\ncenters: cell\naxis mins: 0\naxis maxs: 3\nline skip: 1\nbyte skip: 2\nencoding: hex\n",
            ),
            b"a line\n0 01 02 03 04 05 04 03 02 01 00 01 02".to_vec(),
            1,
        ),
        (
            head("type: uint8\ndimension: 3\nsizes: 2 3 4\nencoding: raw\nbyte skip: -1\n"),
            [b"before", &samples[..]].concat(),
            3,
        ),
        (head("type: uint8\ndimension: 3\nsizes: 2 3 4\nencoding: raw\ndata file: part%d.raw 0 3 1\n"), Vec::new(), 3),
    ]
}

#[test]
fn damaged_nrrd_files() {
    let seeds = volumes();
    run("NRRD", cases(400), |random| {
        let (head, samples, axes) = &seeds[random.below(seeds.len())];
        let whole = [head.as_bytes(), samples].concat();
        let part = |n: usize| (format!("examples/part{n}.raw"), vec![0, 1, 2, 3, 2, 1]);
        let mut files: Vec<(String, Vec<u8>)> = (0..4).map(part).collect();
        files.push(("examples/a.nrrd".into(), damaged(random, &whole)));
        volume(random, files, "a.nrrd", *axes)
    });
}

#[test]
fn damaged_raw_files() {
    let names = ["v_3x2x4_uint8.raw", "v_3x2x4_int16_be.raw", "a_b_6x4_float32.raw", "v_24_uint64le.raw"];
    run("raw", cases(400), |random| {
        let name = names[random.below(names.len())];
        let (axes, width) = match name {
            n if n.contains("float32") => (2, 4),
            n if n.contains("64") => (1, 8),
            n if n.contains("int16") => (3, 2),
            _ => (3, 1),
        };
        let bytes: Vec<u8> = (0..24 * width).map(|n| if n % width == 0 { n as u8 % 5 } else { 0 }).collect();
        // The name is the header: it is damaged too.
        let name = if random.below(2) == 0 { damaged(random, name.as_bytes()) } else { name.as_bytes().to_vec() };
        let name = String::from_utf8_lossy(&name).replace(['"', '\n', '\r', '/', '\\'], "_");
        let bytes = if random.below(2) == 0 { damaged(random, &bytes) } else { bytes };
        volume(random, vec![(format!("examples/{name}"), bytes)], &name, axes)
    });
}

#[test]
fn damaged_meshes() {
    let plain = "# a cube and a corner of it\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0 1\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nusemtl a\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2/1 3/1 7/1 6/1\nf 3//2 4//2 8//2 7//2\nf -8 -4 -1 -5\n";
    let surface = yont::data::obj::read(plain.as_bytes()).expect("a cube");
    let corners: Vec<[f64; 3]> = surface.triangles.iter().flatten().map(|v| surface.positions[*v as usize]).collect();
    let mut text = String::from("solid cube\n");
    let mut binary = [&[0; 80][..], &(corners.len() as u32 / 3).to_le_bytes()].concat();
    for three in corners.chunks(3) {
        text += "facet normal 0 0 0\n outer loop\n";
        binary.extend([0; 12]);
        for [x, y, z] in three {
            text += &format!("  vertex {x} {y} {z}\n");
            [x, y, z].iter().for_each(|c| binary.extend((**c as f32).to_le_bytes()));
        }
        text += " endloop\nendfacet\n";
        binary.extend([0; 2]);
    }
    text += "endsolid cube\n";
    let seeds: [(&str, &[u8]); 3] = [("a.obj", plain.as_bytes()), ("a.stl", text.as_bytes()), ("a.stl", &binary)];
    run("meshes", cases(400), |random| {
        let (name, bytes) = seeds[random.below(3)];
        let program = format!("gob_a = MESH(\"{name}\") | 0.3 - ABS(x1 - 2) - ABS(x2) - ABS(x3);");
        let output = ["a.stl", "a.png", "a.nrrd"][random.below(3)];
        Trial { files: vec![(format!("examples/{name}"), damaged(random, bytes))], program, output }
    });
}

#[test]
fn damaged_programs() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let read = |folder: &Path| -> Vec<String> {
        let mut paths: Vec<_> =
            fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").path()).collect();
        paths.retain(|path| path.extension().is_some_and(|e| e == "geo"));
        paths.sort();
        paths.iter().map(|path| fs::read_to_string(path).expect("a text")).collect()
    };
    let [right, wrong] = [read(&folder), read(&folder.join("errors"))];
    let teapot = fs::read(folder.join("data/teapot.nrrd")).expect("the teapot is there");
    run("programs", cases(300), |random| {
        let seeds = if random.below(3) == 0 { &wrong } else { &right };
        let mut text = seeds[random.below(seeds.len())].clone().into_bytes();
        // The comment at the top would take most of the damage.
        if let Some(end) = text.iter().position(|&b| b == b'}').filter(|_| text.starts_with(b"{")) {
            text.drain(..=end);
        }
        let program = String::from_utf8_lossy(&damaged(random, &text)).into_owned();
        let output = ["a.stl", "a.stl", "a.stl", "a.png", "a.svg", "a.nrrd", "a.glb", "a.gif"][random.below(8)];
        Trial { files: vec![("examples/data/teapot.nrrd".into(), teapot.clone())], program, output }
    });
}
