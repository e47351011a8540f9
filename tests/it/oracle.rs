//! The tree oracle against the session's compiled program, on random scripts.
//!
//! The unit of the comparison: the width of the interval that the object's graph has at the point, computed with outward rounding. It
//! holds whatever value the operations give when each of them errs by a unit in the last place, so it grows where rounding
//! errors are magnified, and only there. The oracle, with other functions and other formulas, must agree within [`UNITS`] such widths.

use yont::builtins::{self, Meaning};
use yont::field::{Coordinate, NodeId, Region};
use yont::limits::Limits;
use yont::model::oracle::{Oracle, Value as Plain};
use yont::model::value::Scalar;
use yont::model::{Session, Value};
use yont::number::{Algebra, Binary, Interval, Intervals, Leaf, Ternary, Unary};
use yont::source::SourceMap;
use yont::syntax::{Mode, parse};
use yont::vm::{Demand, Points, Program, reference};

use crate::conformance::Random;
use crate::session::{messages, session};

/// Widths of the interval within which the oracle and the program agree.
const UNITS: f64 = 8.0;

/// How many random cases to run: `YONT_CASES`, or the number for every day.
pub fn cases(ordinary: usize) -> usize {
    std::env::var("YONT_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(ordinary)
}

const INPUTS: [Coordinate; 3] = [Coordinate(1), Coordinate(2), Coordinate(3)];

/// Intervals in which a number that may be a rounded result, being no short one, is known to within four units in its last place.
struct Loose;

impl Algebra for Loose {
    type Number = Interval;
    fn constant(&mut self, value: f64) -> Interval {
        if value.is_nan() || value.to_bits().trailing_zeros() > 30 {
            return Interval::point(value);
        }
        let step = |value, by: fn(f64) -> f64| (0..4).fold(value, |v, _| by(v));
        Interval::new(step(value, f64::next_down), step(value, f64::next_up))
    }
    fn unary(&mut self, op: Unary, a: Interval) -> Interval {
        Intervals.unary(op, a)
    }
    fn binary(&mut self, op: Binary, a: Interval, b: Interval) -> Interval {
        Intervals.binary(op, a, b)
    }
    fn ternary(&mut self, op: Ternary, a: Interval, b: Interval, c: Interval) -> Interval {
        Intervals.ternary(op, a, b, c)
    }
}

impl reference::Meaning for Loose {
    fn leaf(&mut self, leaf: &dyn Leaf, arguments: &[Interval]) -> Interval {
        leaf.bounds(arguments)
    }
    fn region(&mut self, region: &Region, arguments: &[Interval]) -> Vec<Interval> {
        reference::region::over_a_box(region, arguments)
    }
}

/// Writes scripts. Numbers are short and combined exactly; everything rounded depends on a coordinate, so that the session cannot
/// fold it into a constant whose error would be unknown.
struct Writer<'a> {
    random: &'a mut Random,
    script: String,
    /// Names that are numbers.
    numbers: Vec<String>,
    /// Names that depend on coordinates.
    fields: Vec<String>,
    /// Names of arrays of three.
    arrays: Vec<String>,
    /// Names of functions of two arguments.
    functions: Vec<String>,
    made: usize,
}

const ONE: &[&str] = &[
    "SIN", "COS", "ATAN", "TANH", "EXP", "ABS", "CBRT", "ASINH", "FLOOR", "CEIL", "ROUND", "FRAC", "SIGN", "SQR",
    "SQRT", "LOG", "TAN", "ASIN", "ACOS", "SINH", "COSH", "LOG10", "LOG2", "SEC", "TRUNC", "RAD", "DEG", "ACOSH",
    "ATANH", "COT", "CSC",
];

impl Writer<'_> {
    fn pick<'s>(&mut self, of: &[&'s str]) -> &'s str {
        // Squared, so that the first ones come more often: the last ones are undefined in most places.
        let n = of.len();
        let place = self.random.below(n * n).isqrt();
        of[n - 1 - place]
    }

    fn any_of(&mut self, list: fn(&Self) -> &Vec<String>) -> Option<String> {
        let n = list(self).len();
        let place = if n == 0 { 0 } else { self.random.below(n) };
        list(self).get(place).cloned()
    }

    fn fresh(&mut self, letter: &str) -> String {
        self.made += 1;
        format!("{letter}{}", self.made)
    }

    /// A number without rounding errors.
    fn number(&mut self, depth: usize) -> String {
        match self.random.below(8) {
            0 if depth > 0 => format!("({} + {})", self.number(depth - 1), self.number(depth - 1)),
            1 if depth > 0 => format!("({} - {})", self.number(depth - 1), self.number(depth - 1)),
            2 | 3 => self.any_of(|w| &w.numbers).unwrap_or_else(|| "2".into()),
            4 => self.any_of(|w| &w.arrays).map_or_else(|| "3".into(), |a| format!("LEN({a})")),
            _ => self.pick(&["1", "2", "0.5", "3", "0.25", "1.5", "4", "0"]).into(),
        }
    }

    fn leaf(&mut self) -> String {
        match self.random.below(2) {
            0 => self.any_of(|w| &w.fields).unwrap_or_else(|| "x1".into()),
            _ => self.pick(&["x1", "x2", "x3"]).into(),
        }
    }

    fn any(&mut self, depth: usize) -> String {
        if self.random.below(3) == 0 { self.number(1) } else { self.field(depth) }
    }

    fn condition(&mut self, depth: usize) -> String {
        let compare = |w: &mut Self| w.pick(&["<", "<=", ">", ">=", "=", "<>"]).to_owned();
        let (a, b) = (self.field(depth), self.any(depth));
        match self.random.below(6) {
            0 => format!("({a} {} {b} {} {})", compare(self), compare(self), self.any(depth)),
            1 => format!("({a} < {b} AND {} > {})", self.field(depth), self.number(1)),
            2 => format!("({a} < {b} OR NOT {} > {})", self.field(depth), self.number(1)),
            _ => format!("({a} {} {b})", compare(self)),
        }
    }

    /// An expression that depends on a coordinate, in brackets where it needs them.
    fn field(&mut self, depth: usize) -> String {
        if depth == 0 {
            return self.leaf();
        }
        let d = depth - 1;
        match self.random.below(24) {
            0..=3 => {
                let op = self.pick(&["-", "+", "*"]);
                if self.random.below(2) == 0 {
                    format!("({} {op} {})", self.field(d), self.any(d))
                } else {
                    format!("({} {op} {})", self.any(d), self.field(d))
                }
            }
            4 => format!("({} / (0.5 + {}**2))", self.any(d), self.field(d)),
            5 => format!("({} / {})", self.field(d), self.field(d)),
            6..=10 => {
                let op = self.pick(&["|", "&", "\\", "@"]);
                format!("({} {op} {})", self.field(d), self.any(d))
            }
            11 => format!("({}{})", self.pick(&["~", "-"]), self.field(d)),
            12 | 13 => format!("{}({})", self.pick(ONE), self.field(d)),
            14 => {
                let name = self.pick(&["MIN", "MAX", "HYPOT", "ATAN2", "MOD", "HEAVISIDE", "POW"]);
                format!("{name}({}, {})", self.field(d), self.field(d))
            }
            15 => match self.random.below(4) {
                0 => format!("CLAMP({}, 0, {})", self.field(d), self.any(d)),
                1 => format!("SMOOTHSTEP({}, 2, {})", self.field(d), self.field(d)),
                2 => format!("MAX({}, {}, {})", self.field(d), self.any(d), self.any(d)),
                _ => format!("LERP({}, {}, {})", self.field(d), self.any(d), self.any(d)),
            },
            16 => format!("{}**{}", self.bracketed(d), self.pick(&["2", "3", "0.5", "-1", "4", "(-2)"])),
            17 => format!("(IF {} THEN {} ELSE {})", self.condition(d), self.field(d), self.field(d)),
            18 => {
                let (body, c) = (self.field(d), self.pick(&["x1", "x2", "x3"]));
                match self.random.below(3) {
                    0 => format!("({body} AT ({c} = {}))", self.field(d)),
                    1 => format!("({body} AT (x3 = {}, x2 = {}))", self.field(d), self.field(d)),
                    _ => format!("({body} AT ({}, {}, {}))", self.field(d), self.field(d), self.field(d)),
                }
            }
            19 => self.fold(d),
            20 => self.vector(d),
            21 => {
                let (q, s) = (self.fresh("q"), self.fresh("q"));
                let first = self.field(d);
                self.fields.push(q.clone());
                let second = self.field(d);
                self.fields.push(s.clone());
                let body = self.field(d);
                self.fields.retain(|n| *n != q && *n != s);
                format!("({body} WHERE {q} = {first}, {s} = {second})")
            }
            22 => match self.any_of(|w| &w.functions) {
                Some(f) => format!("{f}({}, {})", self.field(d), self.field(d)),
                None => self.leaf(),
            },
            _ => self.leaf(),
        }
    }

    fn bracketed(&mut self, depth: usize) -> String {
        format!("({})", self.field(depth))
    }

    fn fold(&mut self, depth: usize) -> String {
        let i = self.fresh("i");
        self.numbers.push(i.clone());
        let body = self.field(depth);
        self.numbers.retain(|n| *n != i);
        let to = 1 + self.random.below(4);
        let name = self.pick(&["SUM", "UNION", "INTERSECTION", "MINIMUM", "MAXIMUM", "PRODUCT"]);
        match self.random.below(4) {
            0 => format!("ARRAY({i} = 1 TO 3, {body})[{}]", 1 + self.random.below(3)),
            1 => format!("{name}(ARRAY({i} = 1 TO {to}, {body}))"),
            _ => format!("{name}({i} = 1 TO {to}, {body})"),
        }
    }

    fn vector(&mut self, depth: usize) -> String {
        let Some(a) = self.any_of(|w| &w.arrays) else { return self.leaf() };
        let b = self.any_of(|w| &w.arrays).unwrap_or_else(|| a.clone());
        match self.random.below(8) {
            0 => format!("(SUM({a}) + x1)"),
            1 => format!("DOT({a}, x2*{b})"),
            2 => format!("NORM({a} - x3)"),
            3 => format!("CROSS({a}, [x1, x2, x3])[{}]", 1 + self.random.below(3)),
            4 => format!("UNION(JOIN({a}*x1, {b} + x2))"),
            5 => format!("(x1*{a}[{}] - {b}[{}])", 1 + self.random.below(3), 1 + self.random.below(3)),
            6 => format!("({a}[ROUND(CLAMP({}, 1, 3))] - x2)", self.field(depth)),
            _ => format!("(SIN(x1)*{a} + {b}*x2)[{}]", 1 + self.random.below(3)),
        }
    }

    fn line(&mut self, text: &str) {
        self.script.push_str(text);
        self.script.push('\n');
    }

    fn statement(&mut self) {
        match self.random.below(14) {
            0 => {
                let (n, value) = (self.fresh("n"), self.number(2));
                self.line(&format!("{n} = {value};"));
                self.numbers.push(n);
            }
            1 => self.setting(),
            2 => {
                let (a, items) = (self.fresh("a"), [self.any(1), self.number(1), self.any(1)]);
                self.line(&format!("{a} = [{}];", items.join(", ")));
                if self.random.below(2) == 0 {
                    let (k, value) = (1 + self.random.below(3), self.any(1));
                    self.line(&format!("{a}[{k}] = {value};"));
                }
                self.arrays.push(a);
            }
            3 | 4 => self.function(),
            5..=7 => self.extended(),
            _ => {
                let (name, value) = (self.fresh("f"), self.field(3));
                self.line(&format!("{name} = {value};"));
                self.fields.push(name);
            }
        }
    }

    fn setting(&mut self) {
        let choice = [
            "r_alpha = 1",
            "r_alpha = 0",
            "r_alpha = 0.5",
            "r_alpha = -0.5",
            "r_alpha = 0.5*SIN(x2)",
            "r_m = 1",
            "r_m = 2",
            "r_m = 3",
        ];
        let setting = choice[self.random.below(choice.len())];
        self.line(&format!("{setting};"));
    }

    fn function(&mut self) {
        let (f, p, q, s) = (self.fresh("g"), self.fresh("p"), self.fresh("p"), self.fresh("s"));
        self.fields.extend([p.clone(), q.clone()]);
        if self.random.below(2) == 0 {
            let value = self.field(2);
            self.line(&format!("{f}({p}, {q}) = {value} + {p}*0.5;"));
        } else {
            let first = self.field(1);
            self.fields.push(s.clone());
            let (n, second, third, last) = (self.number(1), self.field(1), self.field(1), self.field(2));
            self.line(&format!("{f}({p}, {q}) = BEGIN {s} = {first} | {p};"));
            self.line(&format!("  IF ({n} > 1) THEN {s} = {second} ELSE BEGIN r_alpha = 1; {s} = {third} & {s}; END;"));
            self.line(&format!("  FOR k = 1 TO 2 DO {s} = {s} - k*{q};"));
            self.line(&format!("  {f} = {last} + {s}; END;"));
        }
        self.fields.retain(|n| ![&p, &q, &s].contains(&n));
        self.functions.push(f);
    }

    /// A definition and a statement that extends it.
    fn extended(&mut self) {
        let (name, i) = (self.fresh("e"), self.fresh("i"));
        let start = self.field(2);
        self.line(&format!("{name} = {start};"));
        let (op, n, form) = (self.pick(&["+", "-", "|", "&", "\\"]), 1 + self.random.below(3), self.random.below(4));
        if form < 2 {
            self.numbers.push(i.clone());
        }
        let step = self.field(2);
        self.numbers.retain(|n| *n != i);
        match form {
            0 => self.line(&format!("FOR {i} = 1 TO {n} DO {name} = {name} {op} {step};")),
            1 => self.line(&format!(
                "{i} = 1; WHILE ({i} <= {n}) DO BEGIN {name} = {name} {op} {step}; {i} = {i} + 1; END;"
            )),
            2 => {
                let a = self.number(1);
                self.line(&format!("IF ({a} > {n}) THEN {name} = {name} {op} {step} ELSE {name} = {step};"));
            }
            _ => self.line(&format!("{name} = {name} {op} {step};")),
        }
        self.fields.push(name);
    }
}

/// A random script and the names in it that depend on coordinates.
fn script(random: &mut Random) -> (String, Vec<String>) {
    let mut writer = Writer {
        random,
        script: String::new(),
        numbers: Vec::new(),
        fields: Vec::new(),
        arrays: Vec::new(),
        functions: Vec::new(),
        made: 0,
    };
    for _ in 0..2 + writer.random.below(7) {
        writer.statement();
    }
    let last = writer.field(4);
    writer.line(&format!("v = {last};"));
    writer.fields.push("v".into());
    (writer.script, writer.fields)
}

fn oracle(text: &str) -> Oracle {
    let mut sources = SourceMap::default();
    let id = sources.add("random.geo", text);
    Oracle::new(&parse(&sources, id, &Limits::default(), Mode::Script).statements)
}

/// How comparisons went.
#[derive(Debug, Default)]
struct Tally {
    compared: usize,
    /// To the bit.
    same: usize,
    /// Where the unit was under a millionth of the value, so that agreement says much.
    sharp: usize,
    undefined: usize,
    /// The largest distance in units.
    worst: f64,
    /// What disagreed.
    faults: Vec<String>,
}

impl Tally {
    /// Compares the oracle with the compiled program of a name.
    fn compare(&mut self, session: &Session, oracle: &Oracle, name: &str, points: &[Vec<f64>; 3], script: &str) {
        let computed = match session.value(name) {
            Some(Ok(Value::Scalar(Scalar::Number(value)))) => vec![value; points[0].len()],
            Some(Ok(Value::Scalar(Scalar::Node(id)))) => compiled(session, id, points),
            other => panic!("{name} is {other:?}\n{script}"),
        };
        for (k, value) in computed.into_iter().enumerate() {
            let at = [points[0][k], points[1][k], points[2][k]];
            let plain = match oracle.value(name, &at) {
                Ok(Plain::Number(plain)) => plain,
                other => {
                    self.faults.push(format!("the oracle says of {name}: {other:?}\n{script}"));
                    continue;
                }
            };
            self.compared += 1;
            if value == plain || value.is_nan() && plain.is_nan() {
                self.same += 1;
                self.sharp += 1;
                self.undefined += usize::from(value.is_nan());
                continue;
            }
            let unit = match session.value(name) {
                Some(Ok(Value::Scalar(Scalar::Node(id)))) => {
                    let over = [0, 1, 2].map(|i| (INPUTS[i], Interval::point(at[i])));
                    reference::eval(&mut Loose, session.graph(), id, &over)
                }
                _ => Loose.constant(value),
            };
            let told = || format!("{name} at {at:?}: program {value:e}, oracle {plain:e}, unit {unit:?}\n{script}");
            if value.is_nan() || plain.is_nan() {
                if !unit.undefined || unit.is_empty() {
                    self.faults.push(told());
                }
                continue;
            }
            let width = unit.hi - unit.lo;
            // An infinite value beside a finite one is right only where the interval reaches so far.
            let far = if width.is_infinite() { 0.0 } else { (value - plain).abs() / width };
            if far > UNITS || far.is_nan() {
                self.faults.push(format!("{far} units: {}", told()));
            }
            self.sharp += usize::from(width < 1e-6 * value.abs());
            self.worst = self.worst.max(far);
        }
    }
}

fn compiled(session: &Session, id: NodeId, points: &[Vec<f64>; 3]) -> Vec<f64> {
    let program = Program::compile(session.graph(), id, &INPUTS, Demand::Value, &Limits::default()).expect("small");
    let mut values = vec![0.0; points[0].len()];
    Points::<f64>::new().eval(&program, &[&points[0], &points[1], &points[2]], &mut values);
    values
}

#[test]
fn random_scripts_mean_the_same_to_the_session_and_the_oracle() {
    let mut random = Random(42);
    let mut tally = Tally::default();
    let (wanted, mut refused) = (cases(2_000), 0);
    for _ in 0..wanted {
        let (text, names) = script(&mut random);
        let mut session = session();
        let outcome = session.input("random.geo", &text, Mode::Script);
        if !outcome.accepted {
            // What can be known to be undefined is an error, and rightly so: SQRT(-1) of some numbers.
            let known = outcome.diagnostics.iter().filter(|d| d.severity == yont::diagnostic::Severity::Error);
            for told in known {
                assert!(EXPECTED.contains(&told.code), "{}\n{text}", messages(&outcome));
            }
            refused += 1;
            continue;
        }
        let oracle = oracle(&text);
        let points: [Vec<f64>; 3] = std::array::from_fn(|_| {
            (0..4)
                .map(|k| if k == 0 { [0.0, 1.0, -0.5, 2.0][random.below(4)] } else { random.between(-3.0, 3.0) })
                .collect()
        });
        for name in names {
            tally.compare(&session, &oracle, &name, &points, &text);
        }
    }
    let faults = std::mem::take(&mut tally.faults);
    eprintln!("{wanted} scripts, {refused} refused: {tally:?}");
    assert!(faults.is_empty(), "{} disagreements, the shortest:\n{}", faults.len(), shortest(faults));
    assert!(refused * 20 < wanted, "{refused} scripts of {wanted} are refused");
    assert!(tally.sharp * 10 > tally.compared * 8 && tally.undefined * 4 < tally.compared, "{tally:?}");
}

/// The three shortest of some texts.
fn shortest(mut texts: Vec<String>) -> String {
    texts.sort_by_key(String::len);
    texts.truncate(3);
    texts.join("\n")
}

/// Codes of errors that a random script may rightly have.
const EXPECTED: &[&str] = &["undefined", "division-by-zero"];

#[test]
fn the_oracle_knows_every_function_of_numbers() {
    for entry in builtins::all().filter(|e| !matches!(e.meaning, Meaning::Special(_))) {
        let (call, value) = entry.example;
        for name in entry.names() {
            let text = format!("v = {};", call.replacen(entry.name, name, 1));
            match oracle(&text).value("v", &[]) {
                Ok(Plain::Number(found)) => {
                    assert!((found - value).abs() <= 1e-15 * value.abs().max(1.0), "{text} {found} instead of {value}");
                }
                other => panic!("{text} {other:?}"),
            }
        }
    }
}
