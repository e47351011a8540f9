//! Our side of each work: from a program in the language to what is timed. Uses the public API alone.

use std::fmt::Write;
use std::sync::Arc;

use yont::field::{Coordinate, Graph, NodeId};
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::syntax::Mode;
use yont::vm::{Demand, Program, Shape};

/// An object of a session.
pub struct Object {
    session: Session,
    /// Its function.
    pub root: NodeId,
}

impl Object {
    /// The last object of a program.
    ///
    /// # Panics
    /// If the program has an error.
    pub fn of(text: &str) -> Self {
        let host = Arc::new(Memory::with(&[]));
        let mut session = Session::new(host, Limits::default(), Interrupt::default());
        assert!(session.input("work.geo", text, Mode::Script).accepted, "the program is right");
        let root = session.object(None).expect("an object").node;
        Self { session, root }
    }

    /// The graph that holds it.
    pub fn graph(&self) -> &Graph {
        self.session.graph()
    }

    /// Its program in a space of that dimension.
    ///
    /// # Panics
    /// If it uses other coordinates.
    pub fn shape(&self, dimension: u8, demand: Demand) -> Shape {
        let inputs: Vec<Coordinate> = (1..=dimension).map(Coordinate).collect();
        let program = Program::compile(self.graph(), self.root, &inputs, demand, &Limits::default());
        Shape::new(program.expect("a program"), usize::from(dimension), Vec::new())
    }
}

/// A program of an operation list (negative inside): one definition a line, as `../shared/tools/vm2geo.py` makes it.
pub fn program(list: &str) -> String {
    let mut text = String::new();
    let mut last = "";
    for line in list.lines().filter(|line| !line.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (Some(name), Some(op)) = (words.first(), words.get(1)) else { continue };
        let arguments: Vec<String> = words[2..].iter().map(|a| format!("v{a}")).collect();
        let value = match (*op, arguments.as_slice()) {
            ("const", _) => format!("({})", words[2]),
            ("var-x", _) => "x1".into(),
            ("var-y", _) => "x2".into(),
            ("var-z", _) => "x3".into(),
            ("neg", [a]) => format!("-{a}"),
            ("square", [a]) => format!("{a}**2"),
            ("add", [a, b]) => format!("{a} + {b}"),
            ("sub", [a, b]) => format!("{a} - {b}"),
            ("mul", [a, b]) => format!("{a} * {b}"),
            ("div", [a, b]) => format!("{a} / {b}"),
            (op, all) => format!("{}({})", op.to_uppercase(), all.join(", ")),
        };
        writeln!(text, "v{name} = {value};").expect("a string takes all");
        last = words[0];
    }
    format!("{text}gob_model = -v{last};\n")
}

/// The gyroid of thickness 0.4 in a ball.
pub const GYROID: &str =
    "gob_a = -MAX(SQRT(u**2+v**2+w**2) - 25, ABS(SIN(u)*COS(v) + SIN(v)*COS(w) + SIN(w)*COS(u)) - 0.2)
    WHERE u = 30*x1, v = 30*x2, w = 30*x3;";

/// A union of random spheres in the space from -1 to 1, in the order of their numbers.
pub fn spheres(count: usize, r_alpha: u8) -> String {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1_u64 << 31) as f64
    };
    let mut text = format!("r_alpha = {r_alpha};\n");
    for i in 0..count {
        let [x, y, z] = [next(), next(), next()].map(|v| 1.9 * v - 0.95);
        let r = 0.01 + 0.03 * next();
        let ball = format!("{} - (x1 - ({x}))**2 - (x2 - ({y}))**2 - (x3 - ({z}))**2", r * r);
        writeln!(text, "gob_s = {}{ball};", if i == 0 { "" } else { "gob_s | " }).expect("a string takes all");
    }
    text
}
