//! What there is to say of a name without searching for a boundary: `:explain`. Gathers facts; decides nothing.

use std::sync::Arc;

use rustc_hash::FxHashSet;

use crate::diagnostic::Diagnostic;
use crate::field::{Coordinate, Node, NodeId, operations};
use crate::number::{Interval, Intervals};
use crate::source::Span;
use crate::vm::reference;

use super::definition::{Definition, SystemInForce};
use super::environment::{Axis, Object, Role};
use super::session::Session;
use super::value::Value;

/// Operations up to which the values over the whole modelling space are bounded: more would take longer than anybody waits.
const BOUNDED: usize = 200_000;
/// Definitions behind a name that are looked through.
const LOOKED_THROUGH: usize = 10_000;
/// Products that are told of one by one.
const PRODUCTS: usize = 8;

impl Session {
    /// Several lines on a name: of an object its coordinates with their types, bounds, route, R-functions in force, shared coordinates
    /// of `@`, operations and the range of its values; of anything else what it is and what it reads.
    ///
    /// # Errors
    /// Messages for the user: an unknown name, or one that fails.
    pub fn explain(&mut self, name: &str) -> Result<String, Vec<Diagnostic>> {
        let Some(definition) = self.state.get(name).cloned() else { return Err(vec![self.unknown(name)]) };
        self.refresh(name);
        let mut lines = vec![format!("{}  ({})", self.describe(name), self.place_of(definition.place()))];
        let doc = self.doc(name).unwrap_or_default();
        lines.extend(doc.lines().map(|line| format!("  {}", line.trim())).filter(|line| !line.trim().is_empty()));
        let scalar = matches!(self.value(name), Some(Ok(Value::Scalar(s))) if !s.coordinates(&self.graph).is_empty());
        if scalar {
            let object = self.object(Some(name))?;
            self.explain_object(&object, &mut lines)?;
        }
        let behind = self.behind(&definition);
        lines.extend(self.systems(&behind));
        lines.extend(self.products(&behind));
        if let Some(deps) = self.deps(name) {
            let words = |names: &[String]| if names.is_empty() { "nothing".into() } else { names.join(", ") };
            lines.push(format!("  reads: {}; read by: {}", words(&deps.reads), words(&deps.readers)));
        }
        Ok(lines.join("\n"))
    }

    fn place_of(&self, span: Span) -> String {
        let file = self.sources.get(span.source).map_or("", |source| &*source.name);
        format!("{file}:{}", self.sources.line_column(span).0)
    }

    fn explain_object(&mut self, object: &Object, lines: &mut Vec<String>) -> Result<(), Vec<Diagnostic>> {
        lines.extend(object.axes.iter().map(axis));
        let space = object.space().len();
        let shown = match space {
            0 => "nothing: it has no axis",
            1 => "a graph",
            2 => "a plane figure",
            _ => "a solid",
        };
        lines.push(format!("  shown as: {shown}{}", levels(&object.levels)));
        match space {
            2 | 3 => lines.extend(self.route_of(object)?.lines().iter().map(|line| format!("  {line}"))),
            _ => lines.push("  route: none; a graph has no boundary to be searched".into()),
        }
        let count = operations(&self.graph, object.node);
        lines.push(format!("  operations: {count}{}", self.data(object.node)));
        if count <= BOUNDED
            && let Some(line) = self.values(object)
        {
            lines.push(line);
        }
        Ok(())
    }

    /// The files that the function stands on.
    fn data(&self, root: NodeId) -> String {
        let reached = crate::field::expand::reachable(&self.graph, root);
        let mut names: Vec<String> = (0..=root.0)
            .map(NodeId)
            .filter(|id| reached[id.index()])
            .filter_map(|id| match self.graph.node(id) {
                Node::Leaf(leaf, _) => Some(leaf.0.name().to_owned()),
                _ => None,
            })
            .collect();
        names.sort();
        names.dedup();
        if names.is_empty() { String::new() } else { format!(", on the data of {}", names.join(", ")) }
    }

    /// Bounds of the values over the whole modelling space, and what they tell.
    fn values(&self, object: &Object) -> Option<String> {
        let range = |axis: &Axis| -> Option<(Coordinate, Interval)> {
            let (lo, hi) = match (&axis.role, axis.range) {
                (Role::Constant(value), _) => (*value, *value),
                (Role::Group(values), _) if !values.is_empty() => (
                    values.iter().copied().fold(f64::INFINITY, f64::min),
                    values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                ),
                (_, range) => range?,
            };
            Some((axis.coordinate, Interval::new(lo, hi)))
        };
        let used = object.axes.iter().filter(|axis| object.uses.contains(axis.coordinate));
        let point: Vec<(Coordinate, Interval)> = used.map(range).collect::<Option<_>>()?;
        let bounds = reference::eval(&mut Intervals, &self.graph, object.node, &point);
        let level = object.levels.first().copied().unwrap_or(0.0);
        let tells = match bounds {
            Interval { lo, hi, .. } if lo > hi => return Some("  values: undefined everywhere: it is empty".into()),
            Interval { hi, .. } if hi < level => ": it is empty there",
            Interval { lo, undefined: false, .. } if lo >= level => ": it fills the whole space",
            Interval { undefined: true, .. } => ", perhaps undefined in places",
            _ => "",
        };
        let [lo, hi] = [bounds.lo, bounds.hi].map(rounded);
        Some(format!("  values: bounded by about {lo} and {hi} over the modelling space{tells}"))
    }

    /// A definition, those that it continues, and all that these read, nearest first.
    pub(super) fn behind(&self, definition: &Arc<Definition>) -> Vec<Arc<Definition>> {
        let mut seen = FxHashSet::default();
        let mut all = Vec::new();
        let mut waiting = std::collections::VecDeque::from([definition.clone()]);
        while let Some(next) = waiting.pop_front().filter(|_| all.len() < LOOKED_THROUGH) {
            if seen.insert(next.id) {
                waiting.extend(next.bases.iter().filter_map(|(_, base)| base.clone()));
                waiting.extend(next.reads.iter().filter_map(|(name, _)| self.state.find_for(&next, name).cloned()));
                all.push(next);
            }
        }
        all
    }

    /// The systems of R-functions in force, each with the definitions whose set operations have it.
    fn systems(&self, behind: &[Arc<Definition>]) -> Vec<String> {
        let mut systems: Vec<(String, Vec<String>)> = Vec::new();
        for definition in behind.iter().filter(|d| d.uses_system) {
            let words = match &definition.system {
                SystemInForce::Plain => "r_alpha = 0, as nothing else is set".to_owned(),
                SystemInForce::Set(set) => {
                    let text = self.sources.text(set.statement.span).trim_end_matches(';').trim();
                    format!("{text} ({})", self.place_of(set.statement.span))
                }
            };
            let title = definition.title().trim_matches('`').to_owned();
            match systems.iter_mut().find(|(known, _)| *known == words) {
                Some((_, titles)) if !titles.contains(&title) => titles.push(title),
                Some(_) => {}
                None => systems.push((words, vec![title])),
            }
        }
        systems
            .into_iter()
            .map(|(words, titles)| format!("  set operations of {}: {words}", titles.join(", ")))
            .collect()
    }

    /// Which coordinates the sides of each `@` share.
    fn products(&self, behind: &[Arc<Definition>]) -> Vec<String> {
        let mut lines = Vec::new();
        for definition in behind {
            let title = definition.title().trim_matches('`').to_owned();
            for [a, b] in self.state.products(definition.id) {
                let shared: Vec<String> = a.iter().filter(|c| b.contains(*c)).map(|c| c.to_string()).collect();
                lines.push(match &shared[..] {
                    [] => format!("  @ in {title}: its sides share no coordinate"),
                    some => format!("  @ in {title}: its sides share {}, so it is their intersection", some.join(", ")),
                });
            }
        }
        let more = lines.len().saturating_sub(PRODUCTS);
        lines.truncate(PRODUCTS);
        lines.extend((more > 0).then(|| format!("  and {more} more products")));
        lines
    }
}

fn axis(axis: &Axis) -> String {
    let name = axis.coordinate;
    let how = if axis.declared { "" } else { " by default" };
    let range = match axis.range {
        Some((lo, hi)) => format!(", from {lo} to {hi}"),
        None if matches!(axis.role, Role::Constant(_) | Role::Group(_)) => String::new(),
        None => format!(", without bounds: {name}min and {name}max are not set"),
    };
    let step = axis.delta.map(|delta| format!(" by {delta}")).unwrap_or_default();
    format!("  {name} : {}{how}{range}{step}", super::request::role(&axis.role))
}

/// Four digits: bounds by intervals are wide, and more would feign exactness.
fn rounded(value: f64) -> String {
    super::value::number(format!("{value:.3e}").parse().unwrap_or(value))
}

fn levels(levels: &[f64]) -> String {
    match levels {
        [0.0] => String::new(),
        [one] => format!(", at the level {one}"),
        all => format!(", at the levels {all:?}"),
    }
}
