//! Strokes as they stand in a program: `gob_a = tr_carve(gob_a, tr_place(TOOL, [..], [..], 0), 0.1);` read back, and where they reach.
//! Evaluates nothing.

use std::sync::Arc;

use super::local::Link;
use crate::field::NodeId;
use crate::model::definition::{Definition, DefinitionId};
use crate::model::session::Session;
use crate::picture::raycast::Space;
use crate::picture::screen::Reach;
use crate::syntax::tree::{Body, Expr, ExprKind, PrefixOp, StatementKind};

/// Where a tool stands: its origin and its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    at: [f64; 3],
    axes: [[f64; 3]; 3],
}

/// What a statement says that is a stroke.
#[derive(Clone, Debug)]
pub struct Form {
    /// The tool about the origin, in the language.
    pub tool: Arc<str>,
    /// Where it stands.
    pub frame: Frame,
    /// How far the edge is rounded.
    pub blend: f64,
}

/// A stroke that was made.
#[derive(Clone, Debug)]
pub struct Stroke {
    /// Its definition.
    pub id: DefinitionId,
    /// The object before it and after it.
    pub nodes: (NodeId, NodeId),
    /// What it does with the object before it.
    pub link: Link,
    /// What it says.
    pub form: Form,
    /// Outside of this box it changes no sign.
    pub reach: Space,
    /// Where that is on the picture.
    pub seen: Reach,
    /// Outside of this box it changes no value that matters to another stroke.
    pub near: Space,
    /// Where that is on the picture.
    pub seen_near: Reach,
    /// Where that is in what the light sees.
    pub lit_near: Reach,
}

impl Frame {
    /// A box about the origin as a box where the tool stands.
    #[must_use]
    pub fn place(&self, of: Space) -> Space {
        let mut placed = Space { lo: self.at, hi: self.at };
        for k in 0..3 {
            for axis in 0..3 {
                let ends = [of.lo[axis] * self.axes[axis][k], of.hi[axis] * self.axes[axis][k]];
                placed.lo[k] += ends[0].min(ends[1]);
                placed.hi[k] += ends[0].max(ends[1]);
            }
            // What is computed may be off by a hair.
            let hair = 1e-9 * (placed.hi[k] - placed.lo[k]);
            placed.lo[k] -= hair;
            placed.hi[k] += hair;
        }
        placed
    }

    /// The angle by which a tool that stands on a surface with that normal is turned to lie along a direction.
    pub fn angle(normal: [f64; 3], along: [f64; 3]) -> Option<f64> {
        let [u, w, _] = Self::turned([0.0; 3], normal, 0.0)?.axes;
        let dot = |a: [f64; 3]| (0..3).map(|k| a[k] * along[k]).sum::<f64>();
        let (x, y) = (dot(u), dot(w));
        (x.hypot(y) > 0.0).then(|| libm::atan2(y, x))
    }

    /// As `tr_place` turns it.
    fn turned(at: [f64; 3], normal: [f64; 3], turn: f64) -> Option<Self> {
        let length = normal.iter().map(|v| v * v).sum::<f64>().sqrt();
        if !(length > 0.0 && length.is_finite()) {
            return None;
        }
        let e = normal.map(|v| v / length);
        let level = e[0].hypot(e[1]);
        let u = if level > 1e-9 { [-e[1] / level, e[0] / level, 0.0] } else { [1.0, 0.0, 0.0] };
        let w = [e[1] * u[2] - e[2] * u[1], e[2] * u[0] - e[0] * u[2], e[0] * u[1] - e[1] * u[0]];
        let (s, c) = (libm::sin(turn), libm::cos(turn));
        let along = std::array::from_fn(|k| u[k] * c + w[k] * s);
        let across = std::array::from_fn(|k| w[k] * c - u[k] * s);
        Some(Self { at, axes: [along, across, e] })
    }
}

/// Reads a definition as a stroke on the object of that name, if it is one, with the definition before it.
pub fn read(session: &Session, name: &str, definition: &Definition) -> Option<(Form, Arc<Definition>)> {
    let StatementKind::Define { name: own, parameters: None, body: Body::Expression(value), range: None } =
        &definition.statement.kind
    else {
        return None;
    };
    let (_, before) = definition.bases.iter().find(|(base, _)| **base == *name)?;
    if *own.name != *name || definition.bases.len() != 1 {
        return None;
    }
    let ("tr_carve" | "tr_chase", [of, tool, blend]) = library(session, value)? else { return None };
    matches!(&of.kind, ExprKind::Name(of) if **of == *name).then_some(())?;
    let blend = number(blend).filter(|blend| *blend >= 0.0)?;
    let (tool, frame) = match library(session, tool)? {
        ("tr_shift", [tool, at]) => {
            let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            (tool, Frame { at: vector(at)?, axes })
        }
        ("tr_place", [tool, at, normal, turn]) => (tool, Frame::turned(vector(at)?, vector(normal)?, number(turn)?)?),
        _ => return None,
    };
    let text = session.sources().text(tool.span);
    // A tool that is made of the workpiece itself changes with every stroke.
    if text.is_empty() || text.contains(name) {
        return None;
    }
    Some((Form { tool: text.into(), frame, blend }, before.clone()?))
}

/// A call of a function of the library.
fn library<'e>(session: &Session, e: &'e Expr) -> Option<(&'e str, &'e [Expr])> {
    let ExprKind::Call { callee, arguments } = &bare(e).kind else { return None };
    session.state.is_library(&callee.name).then_some((&*callee.name, arguments))
}

fn bare(e: &Expr) -> &Expr {
    match &e.kind {
        ExprKind::Paren(inner) => bare(inner),
        _ => e,
    }
}

fn vector(e: &Expr) -> Option<[f64; 3]> {
    let ExprKind::Array(elements) = &bare(e).kind else { return None };
    let [x, y, z] = &elements[..] else { return None };
    Some([number(x)?, number(y)?, number(z)?])
}

/// A number that is written out; an angle may be one of degrees, `30*PI/180`.
fn number(e: &Expr) -> Option<f64> {
    use crate::syntax::tree::ChainOp;
    let value = match &bare(e).kind {
        ExprKind::Number(value) => *value,
        ExprKind::Pi => std::f64::consts::PI,
        ExprKind::Prefix { op: PrefixOp::Minus, operand } => -number(operand)?,
        ExprKind::Chain { first, rest } => rest.iter().try_fold(number(first)?, |value, (op, _, e)| match op {
            ChainOp::Mul => Some(value * number(e)?),
            ChainOp::Div => Some(value / number(e)?),
            _ => None,
        })?,
        _ => return None,
    };
    value.is_finite().then_some(value)
}
