//! Interactive carving and chasing: a workpiece of a session, tools, strokes that are ordinary definitions, and a picture of which each stroke
//! redraws what it touches. Writes no files and shows nothing.
//!
//! A stroke is a statement that continues the workpiece, `gob_a = tr_carve(gob_a, tr_shift(pob_sphere_d([0, 0, 0], 0.1), [0, 0, 1]), 0);`, so that
//! undo, `:save` and everything else know it already. What is kept here can be found again from the definitions at any time: for each stroke
//! a box outside of which it changes nothing, and where that is on the picture. Source: Pasko and Savchenko 1998, section 3.3.

mod aim;
pub(super) mod errors;
mod local;
mod places;
mod stroke;
mod tools;

use std::path::Path;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use crate::diagnostic::{Category, Diagnostic};
use crate::export;
use crate::field::{Coordinate, NodeId};
use crate::limits::Limits;
use crate::number::{Algebra, Binary};
use crate::picture::easel::Easel;
use crate::picture::raycast::{Space, Thing};
use crate::picture::screen::{Reach, Window, meets};
use crate::picture::{Image, Paint};
use crate::surface::space::{Known, Outcome, find};
use crate::syntax::Mode;
use crate::vm::{Demand, Program, Shape};

use super::definition::{Definition, DefinitionId};
use super::request::{Options, Studio, cancelled, studio};
use super::session::Session;
use super::state::Kept;
use super::value::{Scalar, Value};
use local::Local;
use stroke::{Form, Stroke, read};

pub use places::places;
pub use tools::{Spot, TOOLS, Tool, Way};

/// The usual size of a tool, as a part of the longest side of what is shown.
const UNIT: f64 = 1.0 / 16.0;

/// An answer, or the messages that say why there is none.
type Asked<T> = Result<T, Vec<Diagnostic>>;

/// A place where a stroke is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// A pixel, from the top left.
    Pixel([f64; 2]),
    /// A line of strokes from pixel to pixel; where it leaves the workpiece there are none.
    Line([f64; 2], [f64; 2]),
    /// A point of space.
    Point([f64; 3]),
}

/// What became of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawn {
    /// Nothing that it shows has changed.
    Same,
    /// So many of its pixels were drawn anew.
    Part(usize),
    /// All of it was.
    Whole,
}

/// A workpiece that is being carved.
#[derive(Debug)]
pub struct Carving {
    studio: Studio,
    easel: Easel,
    /// The workpiece before the first stroke.
    base: (DefinitionId, NodeId),
    strokes: Vec<Stroke>,
    numbers: FxHashMap<DefinitionId, usize>,
    /// Where tools are about the origin, by their texts and how far beyond their boundaries.
    boxes: FxHashMap<(Arc<str>, u64), Space>,
    /// The widest blend of any stroke.
    widest: f64,
    local: Local,
    tool: Tool,
    /// The picture is not that of the strokes, since the work was stopped.
    torn: bool,
    /// Which graph of the session the nodes are of.
    graphs: u64,
}

impl Carving {
    /// Takes an object as the workpiece and draws it; also what there is to say of it. Its space and its camera stay as they are now.
    ///
    /// # Errors
    /// Messages for the user: an object that is no solid of x1, x2, x3, and those of a picture.
    pub fn begin(session: &mut Session, options: &Options) -> Asked<(Self, Vec<Diagnostic>)> {
        let mut studio = studio(session, options)?;
        let notes = std::mem::take(&mut studio.notes);
        studio.style.occlusion = false;
        let easel = Easel::new(studio.space, &studio.camera, &studio.style);
        let unit = short(UNIT * (0..3).map(|k| studio.space.hi[k] - studio.space.lo[k]).fold(0.0, f64::max));
        let definition = session.state.get(&studio.name).cloned().ok_or_else(|| vec![errors::no_name(&studio.name)])?;
        let mut carving = Self {
            base: (definition.id, studio.node),
            studio,
            easel,
            strokes: Vec::new(),
            numbers: FxHashMap::default(),
            boxes: FxHashMap::default(),
            widest: 0.0,
            local: Local::default(),
            tool: Tool::first(unit),
            torn: false,
            graphs: session.graphs,
        };
        carving.anew(session, &definition)?;
        Ok((carving, notes))
    }

    /// The name of the workpiece.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.studio.name
    }

    /// The picture.
    #[must_use]
    pub fn image(&self) -> &Image {
        self.easel.image()
    }

    /// Writes the picture as a PNG through the session's host, whole or not at all.
    ///
    /// # Errors
    /// A message for the user: the file cannot be written.
    pub fn write(&self, session: &Session, file: &Path) -> Result<(), Diagnostic> {
        let _phase = session.interrupt.phase("write");
        let write = &mut |out: &mut dyn std::io::Write| export::png::write(self.image(), &mut { out });
        session.host.write_whole(file, write).map_err(|error| error.diagnostic())
    }

    /// The kept picture.
    #[must_use]
    pub fn easel(&self) -> &Easel {
        &self.easel
    }

    /// The colour of the workpiece.
    #[must_use]
    pub fn paint(&self) -> &Paint {
        &self.studio.paint
    }

    /// The tool in hand.
    #[must_use]
    pub fn tool(&self) -> &Tool {
        &self.tool
    }

    /// Takes a tool that was in the hand before, so that a workpiece that is turned is worked on with the same one.
    pub fn hold(&mut self, tool: Tool) {
        self.tool = tool;
    }

    /// How many strokes the workpiece has.
    #[must_use]
    pub fn count(&self) -> usize {
        self.strokes.len()
    }

    /// How many rays meet the workpiece: 0 if nothing of it is seen.
    #[must_use]
    pub fn hits(&self) -> u64 {
        self.easel.hits()
    }

    /// The columns and rows of the picture that show something of the workpiece; `None` if none does.
    #[must_use]
    pub fn seen(&self) -> Option<[[usize; 2]; 2]> {
        self.easel.seen()
    }

    /// The usual size of a tool.
    fn unit(&self) -> f64 {
        let space = self.studio.space;
        short(UNIT * (0..3).map(|k| space.hi[k] - space.lo[k]).fold(0.0, f64::max))
    }

    /// Digits behind the point that places of strokes are written with: far below a pixel.
    fn digits(&self) -> usize {
        let space = self.studio.space;
        let longest = (0..3).map(|k| space.hi[k] - space.lo[k]).fold(0.0, f64::max);
        (5.0 - longest.log10().floor()).clamp(0.0, 17.0) as usize
    }

    /// Takes another tool into the hand: one of the set, or one of the user's own.
    ///
    /// # Errors
    /// Messages for the user: an unknown name, sizes that make no sense, what is no solid about the origin.
    pub fn take(&mut self, session: &mut Session, words: &str) -> Asked<()> {
        let one = |told: Diagnostic| vec![told];
        let known = |name: &str| session.is_defined(name) || session.library().is_some_and(|library| library.has(name));
        let names = session.objects();
        let mut tool = Tool::parse(words, self.unit(), &known, &names).map_err(one)?;
        let found = self.box_of(session, &tool.text.clone().into(), 0.0)?;
        tool.lowest = tool.lowest.or(Some(-found.lo[2]));
        if tool.lowest.is_none_or(|lowest| lowest <= 0.0) {
            return Err(one(errors::no_tool(&tool.text, "nothing of it is below the origin, where it should work")));
        }
        self.tool = tool;
        Ok(())
    }

    /// Strokes with the tool in hand, one at each place, as one input of the session; then what they touch is drawn anew. Gives where they
    /// were made. Nothing has changed if one of them cannot be made.
    ///
    /// # Errors
    /// Messages for the user: those of [`Carving::pick`], and strokes that would change nothing.
    pub fn strokes(&mut self, session: &mut Session, way: Way, places: &[Place]) -> Asked<(Vec<Spot>, Drawn)> {
        let one = |told: Diagnostic| vec![told];
        self.follow(session)?;
        let (mut spots, mut text) = (Vec::new(), Vec::new());
        for place in places {
            match place {
                Place::Line(from, to) => spots.extend(self.line(session, *from, *to)?),
                Place::Pixel(_) => spots.push(self.spot(session, *place).map_err(one)?),
                Place::Point(_) => {
                    let spot = self.spot(session, *place).map_err(one)?;
                    self.touches(session, way, &spot)?;
                    spots.push(spot);
                }
            }
        }
        for spot in &spots {
            text.push(self.tool.stroke(self.name(), way, spot, self.digits()));
        }
        let outcome = session.input("<stroke>", &text.join("\n"), Mode::Prompt);
        if !outcome.accepted {
            return Err(outcome.diagnostics);
        }
        match self.follow(session) {
            Ok(drawn) => Ok((spots, drawn)),
            Err(told) => {
                // A stroke that could not be drawn was not made.
                session.undo();
                Err(told)
            }
        }
    }

    /// Brings the picture to what the session has now made of the workpiece: after strokes, undo, redo, or any other input.
    ///
    /// # Errors
    /// Messages for the user: the workpiece is gone or has no value, the work was stopped.
    pub fn follow(&mut self, session: &mut Session) -> Asked<Drawn> {
        let name = self.studio.name.clone();
        session.refresh(&name);
        let Some(definition) = session.state.get(&name).cloned() else { return Err(vec![self.gone()]) };
        if let Some(Err(told)) = session.value(&name) {
            return Err(vec![Arc::unwrap_or_clone(told)]);
        }
        let known = |id: DefinitionId| id == self.base.0 || self.numbers.contains_key(&id);
        let (base, forms) = self.behind(session, &definition, known);
        let kept = match self.numbers.get(&base.id) {
            Some(&k) => Some(k + 1),
            None => (base.id == self.base.0).then_some(0),
        };
        let same = |k: usize| match k.checked_sub(1) {
            Some(last) => self.node_of(session, self.strokes[last].id) == Some(self.strokes[last].nodes.1),
            None => true,
        };
        let base_is_same = self.node_of(session, self.base.0) == Some(self.base.1);
        let is_known = !self.torn && self.graphs == session.graphs && base_is_same;
        match kept {
            Some(k) if is_known && same(k) => self.follow_from(session, k, forms),
            _ => self.anew(session, &definition),
        }
    }

    /// The first `kept` strokes are as they were; others follow them.
    fn follow_from(&mut self, session: &mut Session, kept: usize, forms: Vec<(DefinitionId, Form)>) -> Asked<Drawn> {
        if kept == self.strokes.len() && forms.is_empty() {
            return Ok(Drawn::Same);
        }
        let mut touched: Vec<(Space, Reach)> = self.strokes[kept..].iter().map(|s| (s.reach, s.seen)).collect();
        for stroke in self.strokes.drain(kept..) {
            self.numbers.remove(&stroke.id);
        }
        self.torn = true;
        self.add(session, forms)?;
        touched.extend(self.strokes[kept..].iter().map(|s| (s.reach, s.seen)));
        let mut seen: Vec<Reach> = touched.iter().map(|of| of.1).collect();
        let changed = seen.clone();
        if let Some(light) = self.easel.light() {
            let lit: Vec<Reach> = touched.iter().map(|of| light.reach(of.0)).collect();
            seen.extend(self.relight(session, &light.windows(&lit))?);
        }
        let windows = self.easel.screen().windows(&seen);
        let pixels = windows.iter().map(|[from, to]| (to[0] - from[0]) * (to[1] - from[1])).sum();
        self.redraw(session, &windows, &changed)?;
        Ok(if windows.is_empty() { Drawn::Same } else { Drawn::Part(pixels) })
    }

    /// Reads everything again, since the workpiece itself is another one.
    fn anew(&mut self, session: &mut Session, definition: &Arc<Definition>) -> Asked<Drawn> {
        self.strokes.clear();
        self.numbers.clear();
        self.boxes.clear();
        self.local.clear();
        self.torn = true;
        self.graphs = session.graphs;
        let (base, forms) = self.behind(session, definition, |_| false);
        self.base = (base.id, self.node_of(session, base.id).ok_or_else(|| vec![self.gone()])?);
        if session.graph.coordinates(self.base.1).iter().any(|c| !self.studio.inputs.contains(&c)) {
            let told = errors::not_one(self.name(), "it has become an object of further coordinates");
            return Err(vec![told]);
        }
        self.add(session, forms)?;
        if let Some(light) = self.easel.light() {
            self.relight(session, &light.windows(&[None]))?;
        }
        let windows = self.easel.screen().windows(&[None]);
        self.redraw(session, &windows, &[None])?;
        Ok(Drawn::Whole)
    }

    /// Looks again from the light; where on the picture there may be another light then.
    fn relight(&mut self, session: &Session, windows: &[Window]) -> Asked<Vec<Reach>> {
        let base = self.base_here(session).map_err(|told| vec![told])?;
        let _phase = session.interrupt.phase("shadows");
        let Self { easel, local, strokes, studio, .. } = self;
        let near = Near { local, strokes, studio, base, limits: &session.limits };
        let shape = |window: Window| near.shape(|s| meets(&s.lit_near, window));
        easel.relight(windows, &shape, &session.interrupt).map_err(|told| vec![told])
    }

    /// Draws pieces of the picture anew; the workpiece itself may have changed at some places.
    fn redraw(&mut self, session: &Session, windows: &[Window], changed: &[Reach]) -> Asked<()> {
        let base = self.base_here(session).map_err(|told| vec![told])?;
        let look = Thing::opaque(self.shape(session, |_| false).map_err(|told| vec![told])?, self.studio.paint.clone());
        let _phase = session.interrupt.phase("picture");
        let Self { easel, local, strokes, studio, .. } = self;
        let near = Near { local, strokes, studio, base, limits: &session.limits };
        let shape = |window: Window| near.shape(|s| meets(&s.seen_near, window));
        easel.redraw(windows, (&look, &shape), changed, &session.interrupt).map_err(|told| vec![told])?;
        self.torn = false;
        Ok(())
    }

    /// The strokes that end in a definition, oldest first, back to one that is known or to the definition before all of them.
    fn behind(
        &self,
        session: &Session,
        last: &Arc<Definition>,
        known: impl Fn(DefinitionId) -> bool,
    ) -> (Arc<Definition>, Vec<(DefinitionId, Form)>) {
        let (mut at, mut forms) = (last.clone(), Vec::new());
        while !known(at.id)
            && let Some((form, before)) = read(session, &self.studio.name, &at)
        {
            forms.push((at.id, form));
            at = before;
        }
        forms.reverse();
        (at, forms)
    }

    /// Adds strokes to those that are known.
    fn add(&mut self, session: &mut Session, forms: Vec<(DefinitionId, Form)>) -> Asked<()> {
        let (screen, light) = (self.easel.screen(), self.easel.light());
        // The widest blend of those that there are, whatever there was before: the same strokes always give the same picture.
        let widest =
            self.strokes.iter().map(|s| s.form.blend).chain(forms.iter().map(|of| of.1.blend)).fold(0.0, f64::max);
        if widest.to_bits() != self.widest.to_bits() {
            self.widest = widest;
            for k in 0..self.strokes.len() {
                let form = self.strokes[k].form.clone();
                let near = form.frame.place(self.box_of(session, &form.tool, form.blend + 2.0 * widest)?);
                let stroke = &mut self.strokes[k];
                (stroke.near, stroke.seen_near) = (near, screen.reach(near));
                stroke.lit_near = light.and_then(|light| light.reach(near));
            }
        }
        let limit = session.limits.program_operations;
        let name = self.studio.name.clone();
        let too_many = || vec![too_large(&name, &format!("more than {limit} operations"))];
        let mut before = self.strokes.last().map_or(self.base.1, |last| last.nodes.1);
        for (id, form) in forms {
            let after = self.node_of(session, id).ok_or_else(|| vec![self.gone()])?;
            let link = self.local.link(&session.graph, (before, after), limit).ok_or_else(too_many)?;
            let reach = form.frame.place(self.box_of(session, &form.tool, form.blend)?);
            let near = form.frame.place(self.box_of(session, &form.tool, form.blend + 2.0 * widest)?);
            let (seen, seen_near) = (screen.reach(reach), screen.reach(near));
            let lit_near = light.and_then(|light| light.reach(near));
            self.numbers.insert(id, self.strokes.len());
            self.strokes.push(Stroke {
                id,
                nodes: (before, after),
                link,
                form,
                reach,
                seen,
                near,
                seen_near,
                lit_near,
            });
            before = after;
        }
        Ok(())
    }

    /// How far the last strokes reach beyond what the picture shows, if they do.
    #[must_use]
    pub fn beyond(&self, last: usize) -> Option<Diagnostic> {
        let space = self.studio.space;
        let off = |s: &Stroke| {
            (0..3).map(|k| (space.lo[k] - s.reach.lo[k]).max(s.reach.hi[k] - space.hi[k])).fold(0.0, f64::max)
        };
        let most = self.strokes.iter().rev().take(last).map(off).fold(0.0, f64::max);
        (most > 0.0).then(|| errors::beyond(self.name(), short(most)))
    }

    fn node_of(&self, session: &Session, id: DefinitionId) -> Option<NodeId> {
        match session.state.kept(id)? {
            Kept::One(Value::Scalar(Scalar::Node(node))) => Some(*node),
            _ => None,
        }
    }

    fn gone(&self) -> Diagnostic {
        errors::gone(&self.studio.name)
    }

    /// The object with some of the strokes.
    fn shape(&mut self, session: &Session, with: impl Fn(&Stroke) -> bool) -> Result<Shape, Diagnostic> {
        let base = self.base_here(session)?;
        let Self { local, strokes, studio, .. } = self;
        Near { local, strokes, studio, base, limits: &session.limits }.shape(with)
    }

    /// The workpiece in the store.
    fn base_here(&mut self, session: &Session) -> Result<NodeId, Diagnostic> {
        let limit = session.limits.program_operations;
        let base = self.local.take(&session.graph, self.base.1, limit);
        base.ok_or_else(|| too_large(&self.studio.name, &format!("more than {limit} operations")))
    }

    /// Where a tool is about the origin, with what is at most `more` beyond its boundary by its own values.
    fn box_of(&mut self, session: &mut Session, tool: &Arc<str>, more: f64) -> Asked<Space> {
        let key = (tool.clone(), more.to_bits());
        if let Some(found) = self.boxes.get(&key) {
            return Ok(*found);
        }
        let no_tool = |why: &str| vec![errors::no_tool(tool, why)];
        let node = self.evaluated(session, tool)?;
        let others = session.graph.coordinates(node).iter().any(|c| !self.studio.inputs.contains(&c));
        if others {
            return Err(no_tool("it depends on other coordinates than those of the workpiece"));
        }
        let node = if more > 0.0 {
            let more = session.graph.constant(more);
            session.graph.binary(Binary::Add, node, more)
        } else {
            node
        };
        let inputs: &[Coordinate] = &self.studio.inputs;
        let program = Program::compile(&session.graph, node, inputs, Demand::Sign, &session.limits);
        let program = program.map_err(|error| no_tool(&error.to_string()))?;
        let held = self.studio.fixed.iter().map(|&v| Known::Range(v, v));
        let known: Vec<Known> = [Known::Sought(None, None); 3].into_iter().chain(held).collect();
        let found = find(Arc::new(program), &known, session.limits.search_operations / 10, &session.interrupt);
        let found = match found.map_err(|_| vec![cancelled()])? {
            Outcome::Within(ranges, _) => ranges,
            Outcome::Endless(_) => return Err(no_tool("it goes on without end")),
            Outcome::Point(_) | Outcome::Empty(..) => return Err(no_tool("there is nothing of it")),
        };
        let found = Space { lo: [0, 1, 2].map(|k| found[k][0]), hi: [0, 1, 2].map(|k| found[k][1]) };
        self.boxes.insert(key, found);
        Ok(found)
    }

    /// The function that an expression is.
    fn evaluated(&self, session: &mut Session, text: &str) -> Asked<NodeId> {
        let node = session.function_of("<tool>", &format!("tr_shift({text}, [0, 0, 0])"))?;
        node.ok_or_else(|| vec![errors::no_tool(text, "it is no function of the coordinates")])
    }
}

/// What shapes of the object near some place are made of.
struct Near<'a> {
    local: &'a Local,
    strokes: &'a [Stroke],
    studio: &'a Studio,
    base: NodeId,
    limits: &'a Limits,
}

impl Near<'_> {
    /// The object with some of the strokes.
    fn shape(&self, with: impl Fn(&Stroke) -> bool) -> Result<Shape, Diagnostic> {
        let links = self.strokes.iter().filter(|s| with(s)).map(|s| &s.link);
        let (graph, node, _) = self.local.chain(self.base, links, None);
        let program = Program::compile(&graph, node, &self.studio.inputs, Demand::Sign, self.limits);
        let program = program.map_err(|error| too_large(&self.studio.name, &error.to_string()))?;
        Ok(Shape { precision: self.studio.precision, ..Shape::new(program, 3, self.studio.fixed.clone()) })
    }
}

/// Rounded to two digits.
fn short(v: f64) -> f64 {
    format!("{v:.1e}").parse().unwrap_or(v)
}

fn too_large(name: &str, why: &str) -> Diagnostic {
    Diagnostic::error("too-large", format!("`{name}` cannot be drawn: {why}")).category(Category::Program)
}
