//! Which way leads to an object's boundary: the star route, where the object is proved to be a star about a centre, or the search. Finds the
//! centre, has the proof made, and writes the form; makes no mesh.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::diagnostic::render::excerpt;
use crate::field::folded::{Folded, folded};
use crate::field::rays::{Broken, RayForm, Rays, Why, centres};
use crate::field::{Coordinate, Graph, NodeId};
use crate::interrupt::{Cancelled, Interrupt};
use crate::limits::Limits;
use crate::number::{Algebra, Binary};
use crate::reuse::Digest;
use crate::surface::star::folded::{Operand, Parts};
use crate::surface::star::{Doubt, Fault, Gauge, prove};
use crate::vm::{Demand, Program};

use super::environment::{Axis, Object};
use super::formula::expressions;
use super::session::Session;

/// Forms of a tree that are written out.
const SHOWN: usize = 4;
/// Operands of a fold below which an evaluation anew is as good.
const OPERANDS: usize = 8;
/// Bytes of an equation that are shown.
const LONGEST: usize = 400;

/// What is asked: whether a function is a star.
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// The function.
    pub node: NodeId,
    /// The axes of space, two or three.
    pub axes: &'a [Coordinate],
    /// The other coordinates with their values.
    pub fixed: &'a [(Coordinate, f64)],
    /// The centre that the user gives.
    pub centre: Option<&'a [f64]>,
    /// Another guess at a centre: the middle of the modelling space.
    pub hint: Option<&'a [f64]>,
    /// Whether forms and equations are written: for an object of thousands of parts that takes longer than all else.
    pub told: bool,
}

/// An object that is a star.
#[derive(Clone, Debug)]
pub struct Star {
    /// Its gauge about its centre.
    pub gauge: Gauge,
    /// How many forms it is joined of.
    pub leaves: usize,
    /// The terms of all of them.
    pub terms: usize,
    /// The equations, if they were asked for: a form of each leaf, the gauge, the boundary.
    pub equations: Vec<String>,
}

/// An object that is none, or not known to be one.
#[derive(Clone, Debug)]
pub struct Refusal {
    /// The centre about which it came closest.
    pub centre: Vec<f64>,
    /// What is in the way.
    pub reason: Reason,
    /// Its form, if it was asked for and is short enough to be read.
    pub form: Option<String>,
}

/// What is in the way.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// A part has no ray form, or one without a formula for its root.
    Broken(Broken),
    /// In some direction there is not one root, or nobody knows.
    Doubt(Doubt),
}

impl Reason {
    /// How close it came: the least is the best thing to tell of several.
    fn rank(&self) -> u8 {
        match self {
            Self::Doubt(Doubt { fault: Fault::Endless, .. }) => 0,
            Self::Doubt(Doubt { fault: Fault::Undecided, .. }) => 1,
            Self::Doubt(Doubt { fault: Fault::Several | Fault::Outside, .. }) => 2,
            Self::Doubt(Doubt { fault: Fault::Undefined, .. }) => 3,
            Self::Broken(Broken { why: Why::Roots | Why::Terms, .. }) => 4,
            Self::Broken(_) => 5,
        }
    }
}

/// Whether a function is a star, and about which centre.
///
/// # Errors
/// If the work was stopped. The inner result says why it is no star.
pub fn star(
    graph: &Graph,
    question: Question<'_>,
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Result<Star, Refusal>, Cancelled> {
    let _phase = interrupt.phase("rays");
    let candidates = match question.centre {
        Some(centre) => vec![centre.to_vec()],
        None => centres(graph, question.node, question.axes, question.hint, limits.ray_nodes),
    };
    let mut best: Option<Refusal> = None;
    let mut found: Option<Star> = None;
    for centre in candidates {
        match about(graph, question, &centre, limits, interrupt)? {
            // About its own centre a form has fewer terms.
            Ok(star) if found.as_ref().is_none_or(|found| star.terms < found.terms) => {
                if star.terms <= 2 * star.leaves {
                    return Ok(Ok(star));
                }
                found = Some(star);
            }
            Ok(_) => {}
            Err(refusal) if best.as_ref().is_none_or(|best| refusal.reason.rank() < best.reason.rank()) => {
                best = Some(refusal);
            }
            Err(_) => {}
        }
    }
    if let Some(star) = found {
        return Ok(Ok(star));
    }
    let nothing = Broken { node: question.node, why: Why::Size };
    Ok(Err(best.unwrap_or(Refusal { centre: Vec::new(), reason: Reason::Broken(nothing), form: None })))
}

/// Whether it is a star about a centre.
fn about(
    graph: &Graph,
    question: Question<'_>,
    centre: &[f64],
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Result<Star, Refusal>, Cancelled> {
    let mut rays = Rays::new(graph, question.axes, centre, limits.ray_nodes);
    let refused = |rays: &Rays<'_>, reason: Reason, form: Option<&RayForm>| Refusal {
        centre: centre.to_vec(),
        reason,
        form: form.filter(|_| question.told).and_then(|form| written(rays, form, question.axes)),
    };
    let found = match rays.star(question.node) {
        Ok(found) => found,
        Err(broken) => {
            let form = rays.form(question.node).ok();
            return Ok(Err(refused(&rays, Reason::Broken(broken), form.as_ref())));
        }
    };
    let inputs: Vec<Coordinate> = question.axes.iter().copied().chain(question.fixed.iter().map(|f| f.0)).collect();
    let program =
        |node: NodeId| Program::compile(rays.graph(), node, &inputs, Demand::Value, limits).map(Arc::new).ok();
    let gauge = program(found.gauge).map(|gauge| Gauge {
        centre: centre.to_vec(),
        gauge,
        positive: found.positive.and_then(program),
        single: found.single.and_then(program),
        finite: found.finite.and_then(program),
        fixed: question.fixed.iter().map(|f| f.1).collect(),
        parts: parts(&rays, found.gauge, &inputs, limits, interrupt),
    });
    let complete = |gauge: &Gauge| {
        let pairs = [(&gauge.positive, found.positive), (&gauge.single, found.single), (&gauge.finite, found.finite)];
        pairs.into_iter().all(|(program, node)| program.is_some() == node.is_some())
    };
    let Some(gauge) = gauge.filter(complete) else {
        let broken = Broken { node: question.node, why: Why::Size };
        return Ok(Err(refused(&rays, Reason::Broken(broken), None)));
    };
    Ok(match prove(&gauge, interrupt)? {
        Ok(_) => Ok(Star {
            leaves: found.leaves.len(),
            terms: found.leaves.iter().map(|form| form.terms().len()).sum(),
            equations: if question.told { equations(&rays, &found, question.axes) } else { Vec::new() },
            gauge,
        }),
        Err(doubt) => {
            let form = rays.form(question.node).ok();
            Err(refused(&rays, Reason::Doubt(doubt), form.as_ref()))
        }
    })
}

/// The gauge as a fold of many operands, where it is worth while to keep them from one mesh to the next.
fn parts(
    rays: &Rays<'_>,
    gauge: NodeId,
    inputs: &[Coordinate],
    limits: &Limits,
    interrupt: &Interrupt,
) -> Option<Arc<Parts>> {
    interrupt.reuse()?;
    let Folded { how, operands, around: (graph, root), whole } = folded(rays.graph(), gauge, OPERANDS)?;
    let operand = |(graph, node, minus): (Graph, NodeId, bool)| {
        let program = Program::compile(&graph, node, inputs, Demand::Value, limits).ok()?;
        let mut digest = Digest::of("operand");
        program.tell(&[], &mut digest);
        Some(Operand { program: Arc::new(program), minus, key: digest.key() })
    };
    let operands = operands.into_iter().map(operand).collect::<Option<_>>()?;
    let inputs: Vec<Coordinate> = inputs.iter().copied().chain([whole]).collect();
    let around = Arc::new(Program::compile(&graph, root, &inputs, Demand::Value, limits).ok()?);
    Some(Arc::new(Parts { how, operands, around }))
}

/// The forms, the gauge and the boundary of a star as equations.
fn equations(rays: &Rays<'_>, star: &crate::field::rays::Star, axes: &[Coordinate]) -> Vec<String> {
    let mut lines = Vec::new();
    for (k, form) in star.leaves.iter().enumerate().take(SHOWN) {
        let name = if star.leaves.len() == 1 { "f".to_owned() } else { format!("f{}", k + 1) };
        lines.extend(written(rays, form, axes).map(|form| format!("{name}(c + t v) = {form}")));
    }
    if star.leaves.len() > SHOWN {
        lines.push(format!("and {} more parts", star.leaves.len() - SHOWN));
    }
    let place = |(axis, c): (&Coordinate, &f64)| match *c {
        0.0 => format!("{axis} = v{}/F", axis.0),
        c => format!("{axis} = {c} + v{}/F", axis.0),
    };
    let boundary: Vec<String> = axes.iter().zip(rays.centre()).map(place).collect();
    let gauge = match expressions(rays.graph(), &[star.gauge]) {
        Ok((texts, names)) => directions(&shared(texts.concat(), &names), axes),
        Err(_) => String::new(),
    };
    let gauge = if gauge.is_empty() || gauge.len() > LONGEST {
        format!("of {} operations", crate::field::operations(rays.graph(), star.gauge))
    } else {
        format!("= {gauge}")
    };
    lines.push(format!("boundary: {}, F {gauge}", boundary.join(", ")));
    lines
}

/// A form as a sum of powers of t.
fn written(rays: &Rays<'_>, form: &RayForm, axes: &[Coordinate]) -> Option<String> {
    let graph = rays.graph();
    let roots: Vec<NodeId> = form.terms().iter().map(|t| t.coefficient).collect();
    if roots.is_empty() {
        return Some("0".into());
    }
    let (texts, names) = expressions(graph, &roots).ok()?;
    let mut sum = String::new();
    for (term, text) in form.terms().iter().zip(texts) {
        let (sign, text) = match text.strip_prefix('-') {
            Some(rest) => ("-", rest.to_owned()),
            None => ("+", text),
        };
        let power = match (term.degree.of, term.degree.value) {
            (None, 0.0) => String::new(),
            (None, 1.0) => "t".into(),
            (None, value) => format!("t**{}", super::value::number(value)),
            (Some(_), value) => format!("t**({} p(v))", super::value::number(value)),
        };
        let is_sum = text.contains(" + ") || text.contains(" - ");
        let product = match (text.as_str(), power.is_empty()) {
            (_, true) => text.clone(),
            ("1", false) => power,
            (_, false) if is_sum && !is_enclosed(&text) => format!("({text}) {power}"),
            _ => format!("{text} {power}"),
        };
        match (sum.is_empty(), sign) {
            (true, "-") => sum = format!("-{product}"),
            (true, _) => sum = product,
            _ => sum += &format!(" {sign} {product}"),
        }
    }
    let text = directions(&shared(sum, &names), axes);
    (text.len() <= LONGEST).then_some(text)
}

/// Whether the first bracket of a text is closed by its last letter.
fn is_enclosed(text: &str) -> bool {
    let mut depth = 0;
    text.starts_with('(')
        && text.char_indices().all(|(k, letter)| {
            depth += i32::from(letter == '(') - i32::from(letter == ')');
            depth > 0 || k + 1 == text.len()
        })
}

fn shared(text: String, names: &[(String, String)]) -> String {
    let names: Vec<String> = names.iter().map(|(name, text)| format!("{name} = {text}")).collect();
    if names.is_empty() { text } else { format!("{text} WHERE {}", names.join(", ")) }
}

/// With `v1` for each `x1` that is an axis: in the graph of the coefficients it is a component of the direction.
fn directions(text: &str, axes: &[Coordinate]) -> String {
    let mut out = String::with_capacity(text.len());
    let mut word = String::new();
    for letter in text.chars().chain(['\0']) {
        if letter.is_alphanumeric() || letter == '_' {
            word.push(letter);
            continue;
        }
        let axis = axes.iter().find(|axis| axis.to_string() == word);
        match axis {
            Some(axis) => out += &format!("v{}", axis.0),
            None => out += &word,
        }
        word.clear();
        if letter != '\0' {
            out.push(letter);
        }
    }
    out
}

/// A point in brackets.
pub(super) fn point(place: &[f64]) -> String {
    let short = |c: &f64| super::value::number(format!("{c:.6e}").parse().unwrap_or(*c));
    format!("({})", place.iter().map(short).collect::<Vec<_>>().join(", "))
}

/// The way to an object's boundary, and what there is to say of it.
#[derive(Clone, Debug)]
pub struct Told {
    /// The star, or why it is none.
    pub found: Result<Star, Refusal>,
    /// How many axes of space there are.
    pub dimension: usize,
    /// The message about the part that breaks it, with the place underlined.
    pub shown: String,
    /// The part itself, if it stands in the text.
    pub part: Option<String>,
}

impl Told {
    /// `star`, `cubes` or `squares`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match (&self.found, self.dimension) {
            (Ok(_), _) => "star",
            (Err(_), 2) => "squares",
            (Err(_), _) => "cubes",
        }
    }

    /// Why this way.
    #[must_use]
    pub fn reason(&self) -> String {
        match &self.found {
            Ok(star) if star.leaves == 1 => {
                format!("each ray from {} leaves it once, where a formula says", point(&star.gauge.centre))
            }
            Ok(star) => format!(
                "each ray from {} leaves it once, where the formulas of its {} parts say",
                point(&star.gauge.centre),
                star.leaves
            ),
            Err(refusal) => {
                format!("the signs at the corners of cells; it is not known to be a star: {}", refusal.words())
            }
        }
    }

    /// All of it.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![format!("route {}: {}", self.name(), self.reason())];
        match &self.found {
            Ok(star) => lines.extend(star.equations.iter().map(|line| format!("  {line}"))),
            Err(refusal) => {
                lines.extend(refusal.form.iter().map(|form| format!("  f(c + t v) = {form}")));
                lines.extend(self.shown.lines().map(|line| format!("  {line}")));
            }
        }
        lines
    }
}

impl Session {
    /// The way to the boundary of an object of two or three axes of space, at the first moment and section that it shows.
    ///
    /// # Errors
    /// If the work was stopped, or the object's centre makes no sense.
    pub(super) fn route_of(&mut self, object: &Object) -> Result<Told, Vec<Diagnostic>> {
        let space = object.space();
        let axes: Vec<Coordinate> = space.iter().map(|axis| axis.coordinate).collect();
        let value = |axis: &Axis| axis.steps(1).first().copied().or(axis.range.map(|range| range.0)).unwrap_or(0.0);
        let fixed: Vec<(Coordinate, f64)> =
            object.axes.iter().filter(|a| !a.is_space()).map(|a| (a.coordinate, value(a))).collect();
        let middle: Option<Vec<f64>> = space.iter().map(|a| a.range.map(|(lo, hi)| 0.5 * (lo + hi))).collect();
        let node = match object.levels.first() {
            Some(&level) if level != 0.0 => {
                let level = self.graph.constant(level);
                self.graph.binary(Binary::Sub, object.node, level)
            }
            _ => object.node,
        };
        let centre = object.center.as_deref();
        if let Some(told) = wrong_centre(object, axes.len()) {
            return Err(vec![told]);
        }
        let question = Question { node, axes: &axes, fixed: &fixed, centre, hint: middle.as_deref(), told: true };
        let cancelled = |_| vec![super::lower::cancelled()];
        let found = star(&self.graph, question, &self.limits, &self.interrupt).map_err(cancelled)?;
        let (mut shown, mut part) = (String::new(), None);
        if let Some(broken) = found.as_ref().err().and_then(Refusal::node)
            && let Some(span) = self.place_of_node(&object.name, node, broken)
        {
            shown = excerpt(span, &self.sources);
            part = Some(self.sources.text(span).to_owned());
        }
        Ok(Told { found, dimension: axes.len(), shown, part })
    }
}

/// A centre with another number of components than the object has axes.
pub(super) fn wrong_centre(object: &Object, axes: usize) -> Option<Diagnostic> {
    let centre = object.center.as_ref().filter(|centre| centre.len() != axes)?;
    let title = format!("the centre of `{}` has {} components, and the object {axes} axes", object.name, centre.len());
    Some(Diagnostic::error("wrong-centre", title).help("give one number for each axis, in the order X, Y, Z"))
}

impl Refusal {
    /// What is in the way, in a few words.
    #[must_use]
    pub fn words(&self) -> String {
        let about = point(&self.centre);
        match &self.reason {
            Reason::Broken(Broken { why, .. }) => format!("about {about} {}", broken(*why)),
            Reason::Doubt(Doubt { fault, direction }) => {
                let towards = point(direction);
                match fault {
                    Fault::Endless => format!("from {about} towards {towards} a ray never leaves it"),
                    Fault::Outside => {
                        format!("the centre {about} lies outside it or on its boundary, seen towards {towards}")
                    }
                    Fault::Several => format!("from {about} towards {towards} a ray may leave it more than once"),
                    Fault::Undefined => format!("from {about} towards {towards} it is undefined or infinite"),
                    Fault::Undecided => format!("about {about} nothing is proved of the rays near {towards}"),
                }
            }
        }
    }

    /// The node of the part that breaks it, if it is a part.
    #[must_use]
    pub fn node(&self) -> Option<NodeId> {
        match self.reason {
            Reason::Broken(broken) if broken.why != Why::Size => Some(broken.node),
            _ => None,
        }
    }

    /// The message; `place` is where the part stands.
    #[must_use]
    pub fn diagnostic(&self, name: &str, place: Option<crate::source::Span>) -> Diagnostic {
        let title = format!("`{name}` is not known to be a star: {}", self.words());
        let told = Diagnostic::error("no-star", title);
        let told = match place {
            Some(span) => told.at(span, "this part"),
            None => told,
        };
        let told = match &self.form {
            Some(form) => told.fact(format!("its ray form there: f(c + t v) = {form}")),
            None => told,
        };
        match &self.reason {
            Reason::Doubt(Doubt { fault: Fault::Endless, .. }) => {
                told.help("bound it by an intersection, or leave the route to `auto`")
            }
            Reason::Doubt(_) => told.help(format!("name another centre: `{name} : CENTER = [...];` or --center")),
            Reason::Broken(_) => told.help("leave the route to `auto`: it searches where there is no formula"),
        }
    }
}

fn broken(why: Why) -> &'static str {
    match why {
        Why::Data => "a part is data, which has no form along a ray",
        Why::Region => "a part is a loop or a search, which has no form along a ray",
        Why::Function => "a part is a function of what changes along a ray",
        Why::Root => "a part is a root or magnitude of several powers of the distance",
        Why::Power => "a part is a power of several powers of the distance, or one whose exponent changes",
        Why::Quotient => "a part is a quotient by several powers of the distance, or by zero",
        Why::Unlike => "a part joins what grows with different powers of the distance",
        Why::Comparison => "a part is a condition that changes along a ray",
        Why::Terms => "a part has more powers of the distance than are kept, or powers that vary",
        Why::Size => "it has more parts than are looked at",
        Why::Zero => "it is zero everywhere",
        Why::Roots => "a part has so many powers of the distance that no formula gives its root",
    }
}
