//! The picture of a text with 7,866 operations, read from its own file format: boxes with specialised programs give the same pixels as
//! the dense walk.

use std::path::Path;

use yont::field::{Coordinate, Graph, NodeId};
use yont::limits::Limits;
use yont::model::request;
use yont::number::{Algebra, Binary, Interval, Reals, Unary};
use yont::vm::{Boxes, Demand, Points, Program, reference};

const INPUTS: [Coordinate; 2] = [Coordinate(1), Coordinate(2)];

/// The expression of a `.vm` file: one operation per line, inside where it is negative.
fn read(graph: &mut Graph, text: &str) -> NodeId {
    let mut names = std::collections::HashMap::new();
    let mut last = graph.constant(0.0);
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let operand = |i: usize| names[words[i]];
        last = match words[1] {
            "const" => graph.constant(words[2].parse().expect("a number")),
            "var-x" => graph.coordinate(INPUTS[0]),
            "var-y" => graph.coordinate(INPUTS[1]),
            "neg" => graph.unary(Unary::Neg, operand(2)),
            "sqrt" => graph.unary(Unary::Sqrt, operand(2)),
            "square" => graph.unary(Unary::Powi(2), operand(2)),
            "add" => graph.binary(Binary::Add, operand(2), operand(3)),
            "sub" => graph.binary(Binary::Sub, operand(2), operand(3)),
            "mul" => graph.binary(Binary::Mul, operand(2), operand(3)),
            "min" => graph.binary(Binary::Min, operand(2), operand(3)),
            "max" => graph.binary(Binary::Max, operand(2), operand(3)),
            other => panic!("unknown operation {other}"),
        };
        names.insert(words[0], last);
    }
    graph.unary(Unary::Neg, last)
}

/// The centre of a pixel along one side.
fn centre(pixel: usize, side: usize) -> f64 {
    (pixel as f64 + 0.5) / side as f64 * 2.0 - 1.0
}

/// A square picture by halving tiles: whole tiles where the interval decides, pixels with the shortest program elsewhere.
struct Picture {
    side: usize,
    inside: Vec<bool>,
    boxes: Boxes,
    points: Points<f64>,
    operations: u64,
}

impl Picture {
    fn fill(&mut self, at: [usize; 2], size: usize, on: impl Fn(usize, usize) -> bool) {
        for y in 0..size {
            for x in 0..size {
                self.inside[(at[1] + y) * self.side + at[0] + x] = on(x, y);
            }
        }
    }

    fn tile(&mut self, program: &Program, at: [usize; 2], size: usize) {
        let over = at.map(|p| [Interval::new(centre(p, self.side), centre(p + size - 1, self.side))]);
        let mut range = [Interval::EMPTY];
        self.boxes.eval(program, &[&over[0], &over[1]], &mut range);
        self.operations += program.len() as u64;
        if range[0].is_positive() || range[0].is_negative() {
            return self.fill(at, size, |_, _| range[0].is_positive());
        }
        let special = self.boxes.specialise(program, 0);
        let program = special.as_ref().unwrap_or(program);
        if size > 8 {
            let half = size / 2;
            for [dx, dy] in [[0, 0], [half, 0], [0, half], [half, half]] {
                self.tile(program, [at[0] + dx, at[1] + dy], half);
            }
            return;
        }
        let pixels = |axis: usize| -> Vec<f64> {
            (0..size * size).map(|k| centre(at[axis] + [k % size, k / size][axis], self.side)).collect()
        };
        let (xs, ys) = (pixels(0), pixels(1));
        let mut values = vec![0.0; size * size];
        self.points.eval(program, &[&xs, &ys], &mut values);
        self.operations += (program.len() * values.len()) as u64;
        self.fill(at, size, |x, y| values[y * size + x] >= 0.0);
    }
}

#[test]
fn boxes_give_the_pixels_of_the_dense_walk() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/models/prospero.vm");
    let Ok(text) = std::fs::read_to_string(&path) else {
        eprintln!("SKIPPED: {} is missing", path.display());
        return;
    };
    let mut graph = Graph::new();
    let root = read(&mut graph, &text);
    let side = 256;
    for demand in [Demand::Sign, Demand::Value] {
        let program = Program::compile(&graph, root, &INPUTS, demand, &Limits::default()).expect("7,866 operations");
        let mut picture = Picture {
            side,
            inside: vec![false; side * side],
            boxes: Boxes::new(),
            points: Points::new(),
            operations: 0,
        };
        picture.tile(&program, [0, 0], side);
        // Every 7th pixel of every 5th row against the walk, and all of them against the whole program.
        let (xs, ys): (Vec<f64>, Vec<f64>) =
            (0..side * side).map(|k| (centre(k % side, side), centre(k / side, side))).unzip();
        let mut dense = vec![0.0; side * side];
        Points::<f64>::new().eval(&program, &[&xs, &ys], &mut dense);
        for (k, inside) in picture.inside.iter().enumerate() {
            assert_eq!(*inside, dense[k] >= 0.0, "pixel {k} under {demand:?}");
        }
        for k in (0..side * side).step_by(1777) {
            let value = reference::eval(&mut Reals, &graph, root, &[(INPUTS[0], xs[k]), (INPUTS[1], ys[k])]);
            assert_eq!(picture.inside[k], value >= 0.0, "pixel {k} under {demand:?}");
        }
        let inside = picture.inside.iter().filter(|i| **i).count();
        assert!(inside > 1_000 && inside < side * side / 2, "{inside} pixels of text");
        let all = (program.len() * side * side) as u64;
        assert!(picture.operations * 20 < all, "{} operations of {all}", picture.operations);
    }
}

/// The value of every line of the list at every pixel of some rows, in doubles, line by line; gives whether each pixel is inside.
fn plainly(text: &str, side: usize, rows: std::ops::Range<usize>) -> Vec<bool> {
    let width = rows.len() * side;
    let pixels = || rows.clone().flat_map(|row| (0..side).map(move |column| (column, row)));
    let mut values: Vec<Vec<f64>> = Vec::new();
    let mut places = std::collections::HashMap::new();
    for line in text.lines().filter(|l| !l.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let operand = |i: usize| -> &Vec<f64> { &values[places[words[i]]] };
        let one = |f: fn(f64) -> f64| operand(2).iter().map(|a| f(*a)).collect();
        let two = |f: fn(f64, f64) -> f64| operand(2).iter().zip(operand(3)).map(|(a, b)| f(*a, *b)).collect();
        let result: Vec<f64> = match words[1] {
            "const" => vec![words[2].parse().expect("a number"); width],
            "var-x" => pixels().map(|(column, _)| centre(column, side)).collect(),
            "var-y" => pixels().map(|(_, row)| -centre(row, side)).collect(),
            "neg" => one(|a| -a),
            "sqrt" => one(f64::sqrt),
            "square" => one(|a| a * a),
            "add" => two(|a, b| a + b),
            "sub" => two(|a, b| a - b),
            "mul" => two(|a, b| a * b),
            "min" => two(f64::min),
            "max" => two(f64::max),
            other => panic!("unknown operation {other}"),
        };
        places.insert(words[0], values.len());
        values.push(result);
    }
    values.last().expect("a list").iter().map(|value| *value <= 0.0).collect()
}

/// The script that the converter makes of the list, if the shared tools and Python are there.
fn converted(shared: &Path) -> Option<String> {
    let list = shared.join("data/models/prospero.vm");
    let run = std::process::Command::new("python3").arg(shared.join("tools/vm2geo.py")).arg(list).output();
    let output = run.ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()
}

/// 256 pixels a side, or as many as `YONT_SIDE` says; 1024 takes half a minute in release.
#[test]
fn the_picture_of_the_script_is_right_at_every_pixel() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared");
    let Some(script) = converted(&shared) else {
        eprintln!("SKIPPED: python3 or {}/tools/vm2geo.py is missing", shared.display());
        return;
    };
    let side: usize = std::env::var("YONT_SIDE").ok().and_then(|text| text.parse().ok()).unwrap_or(256);
    let mut session = crate::session::session();
    let begun = std::time::Instant::now();
    let outcome = session.input("prospero.geo", &script, yont::syntax::Mode::Script);
    assert!(outcome.accepted, "{}", crate::session::messages(&outcome));
    let read = begun.elapsed();
    let mut options = request::Options::default();
    options.picture.size = Some((side, side));
    options.picture.palette = "mono".into();
    let output = request::Output::parse("-", Some(request::Format::Png)).expect("a picture");
    let mut bytes = Vec::new();
    let written = request::write(&mut session, &output, &options, &mut bytes).unwrap_or_else(|told| panic!("{told:?}"));
    eprintln!(
        "{} definitions read in {read:?}, all in {:?}; {:?}",
        script.matches(';').count(),
        begun.elapsed(),
        written.lines
    );
    let mut decoder = png::Decoder::new(std::io::Cursor::new(&bytes));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().expect("a picture");
    let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
    let frame = reader.next_frame(&mut pixels).expect("pixels");
    assert_eq!((frame.width as usize, frame.height as usize), (side, side));
    let stride = pixels.len() / (side * side);
    let text = std::fs::read_to_string(shared.join("data/models/prospero.vm")).expect("the converter read it too");
    let (mut inside, step) = (0, (1024 / side).clamp(1, side));
    for first in (0..side).step_by(step) {
        let expected = plainly(&text, side, first..(first + step).min(side));
        for (k, expected) in expected.into_iter().enumerate() {
            let dark = pixels[(first * side + k) * stride] < 128;
            assert_eq!(dark, expected, "pixel {} of row {}", k % side, first + k / side);
            inside += usize::from(expected);
        }
    }
    assert!(inside * 30 > side * side && inside * 2 < side * side, "{inside} pixels of text");
}
