//! From places that are typed to places on the workpiece: rays through pixels, lines of them, points of space. Changes nothing.

use std::sync::Arc;

use crate::diagnostic::Diagnostic;
use crate::model::request::cancelled;
use crate::model::session::Session;
use crate::number::{Algebra, Binary, Unary};
use crate::picture::raycast::{Space, Thing};
use crate::picture::screen::meets;
use crate::surface::sampler::Sampler;
use crate::surface::space::reach;
use crate::vm::{Demand, Program};

use super::stroke::Stroke;
use super::{Asked, Carving, Place, Spot, Way, errors, too_large};

/// From stroke to stroke in a line, as a part of the tool's width.
const STEP: f64 = 0.25;

/// Most strokes of a line.
const MOST_IN_LINE: f64 = 2_000.0;

impl Carving {
    /// What is at a place: the point of the surface that a pixel shows, or a point that is given, with the normal there.
    ///
    /// # Errors
    /// Messages for the user: a pixel that there is not, a ray that misses, a point where the function has no slope.
    pub fn pick(&mut self, session: &mut Session, place: Place) -> Asked<Spot> {
        self.follow(session)?;
        self.spot(session, place).map_err(|told| vec![told])
    }

    pub(super) fn spot(&mut self, session: &Session, place: Place) -> Result<Spot, Diagnostic> {
        match place {
            Place::Pixel(at) | Place::Line(at, _) => self.through(session, at),
            Place::Point(point) => self.at(session, point),
        }
    }

    fn through(&mut self, session: &Session, at: [f64; 2]) -> Result<Spot, Diagnostic> {
        let size = self.easel.style().size;
        let inside = |k: usize| at[k] >= 0.0 && at[k] < size[k] as f64;
        if !(inside(0) && inside(1)) {
            return Err(errors::outside(at, size));
        }
        let pixel = at.map(|v| v as usize);
        let window = [pixel, pixel.map(|v| v + 1)];
        let shape = self.shape(session, |s| meets(&s.seen_near, window))?;
        let thing = Thing::opaque(shape, self.studio.paint.clone());
        let hit = self.easel.pick(&thing, pixel, &session.interrupt)?;
        let Some((point, normal)) = hit else { return Err(errors::missed(self.name(), pixel, self.seen())) };
        Ok(Spot { point, normal, along: None })
    }

    /// A point that is given, with the normal of the level surface through it.
    fn at(&mut self, session: &Session, point: [f64; 3]) -> Result<Spot, Diagnostic> {
        let near = |s: &Stroke| (0..3).all(|k| s.near.lo[k] <= point[k] && point[k] <= s.near.hi[k]);
        let shape = self.shape(session, near)?;
        let mut slopes = [[0.0]; 3];
        let [x, y, z] = &mut slopes;
        let at: Vec<&[f64]> = point.iter().map(std::slice::from_ref).collect();
        Sampler::new(&shape).slopes(&shape.program, &at, &mut [0.0], &mut [x, y, z]);
        let slope = slopes.map(|[v]| v);
        let largest = slope.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if !(largest > 0.0 && largest.is_finite() && slope.iter().all(|v| v.is_finite())) {
            return Err(errors::no_normal(point));
        }
        let scaled = slope.map(|v| v / largest);
        let length = scaled.iter().map(|v| v * v).sum::<f64>().sqrt();
        Ok(Spot { point, normal: scaled.map(|v| -v / length), along: None })
    }

    /// The spots of a line of strokes, so close that they make one groove; none where the rays miss.
    pub(super) fn line(&mut self, session: &mut Session, from: [f64; 2], to: [f64; 2]) -> Asked<Vec<Spot>> {
        let size = self.easel.style().size;
        if let Some(end) = [from, to].into_iter().find(|at| (0..2).any(|k| at[k] < 0.0 || at[k] >= size[k] as f64)) {
            return Err(vec![errors::outside(end, size)]);
        }
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let between = |part: f64| std::array::from_fn(|k| from[k] + part * (to[k] - from[k]));
        let about = self.box_of(session, &self.tool.text.clone().into(), 0.0)?;
        let width = (0..2).map(|k| about.hi[k] - about.lo[k]).fold(f64::INFINITY, f64::min);
        let count = (length / self.spacing(width)).ceil().clamp(1.0, MOST_IN_LINE);
        let mut spots = Vec::new();
        for k in 0..=count as usize {
            session.interrupt.tick().map_err(|_| vec![cancelled()])?;
            match self.through(session, between(k as f64 / count)) {
                Ok(spot) => spots.push(spot),
                Err(told) if told.code == "missed" => {}
                Err(told) => return Err(vec![told]),
            }
        }
        if spots.is_empty() {
            return Err(vec![errors::missed(self.name(), from.map(|v| v as usize), self.seen())]);
        }
        let points: Vec<[f64; 3]> = spots.iter().map(|spot| spot.point).collect();
        for (k, spot) in spots.iter_mut().enumerate() {
            let (before, after) = (points[k.saturating_sub(1)], points[(k + 1).min(points.len() - 1)]);
            spot.along = Some(std::array::from_fn(|k| after[k] - before[k]));
        }
        Ok(spots)
    }

    /// Pixels from stroke to stroke in a line with a tool of that width.
    fn spacing(&self, width: f64) -> f64 {
        let space = self.studio.space;
        let middle: [f64; 3] = std::array::from_fn(|k| 0.5 * (space.lo[k] + space.hi[k]));
        let camera = self.easel.camera();
        let aside = std::array::from_fn(|k| middle[k] + width * camera.right[k]);
        let pixels = match (camera.place(middle), camera.place(aside)) {
            (Some(a), Some(b)) => 0.5 * (b[0] - a[0]).abs() * self.easel.style().size[0] as f64,
            _ => 0.0,
        };
        (STEP * pixels).max(1.0)
    }

    /// Refuses a stroke that would change nothing.
    pub(super) fn touches(&mut self, session: &mut Session, way: Way, spot: &Spot) -> Asked<()> {
        let placed = self.tool.placed(way, spot, self.digits());
        let tool = self.evaluated(session, &placed)?;
        let found = self.tool_space(session, way, spot)?;
        let space = self.studio.space;
        let within = |s: &Stroke| (0..3).all(|k| s.near.lo[k] <= found.hi[k] && found.lo[k] <= s.near.hi[k]);
        let limit = session.limits.program_operations;
        let name = self.studio.name.clone();
        let too_large = || vec![too_large(&name, "too many operations")];
        let base = self.base_here(session).map_err(|told| vec![told])?;
        let tool = self.local.take(&session.graph, tool, limit).ok_or_else(too_large)?;
        let links = self.strokes.iter().filter(|s| within(s)).map(|s| &s.link);
        let (mut graph, object, tool) = self.local.chain(base, links, Some(tool));
        let object = if way == Way::Cut { object } else { graph.unary(Unary::Neg, object) };
        let both = graph.binary(Binary::Min, object, tool.unwrap_or(object));
        let program = Program::compile(&graph, both, &self.studio.inputs, Demand::Sign, &session.limits);
        let program = Arc::new(program.map_err(|_| too_large())?);
        let axis = |k: usize| (found.lo[k].max(space.lo[k]), found.hi[k].min(space.hi[k]));
        let ranges: Vec<(f64, f64)> =
            [0, 1, 2].map(axis).into_iter().chain(self.studio.fixed.iter().map(|&v| (v, v))).collect();
        let is_there = ranges.iter().all(|(lo, hi)| lo <= hi)
            && reach(program, &ranges, 0.5, session.limits.search_operations / 100, &session.interrupt)
                .map_err(|_| vec![cancelled()])?
                .is_some();
        if is_there { Ok(()) } else { Err(vec![errors::nothing_there(self.name(), spot.point, way == Way::Cut)]) }
    }

    /// The box of the tool in hand where it would stand.
    fn tool_space(&mut self, session: &mut Session, way: Way, spot: &Spot) -> Asked<Space> {
        let about = self.box_of(session, &self.tool.text.clone().into(), 0.0)?;
        let reach = (0..3).map(|k| about.lo[k].abs().max(about.hi[k].abs()).powi(2)).sum::<f64>().sqrt();
        let _ = way;
        let off = self.tool.lowest.unwrap_or(0.0) + reach;
        Ok(Space { lo: spot.point.map(|v| v - off - reach), hi: spot.point.map(|v| v + off + reach) })
    }
}
