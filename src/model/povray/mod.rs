//! An object as functions of POV-Ray, for its isosurfaces: what they are, where they hold, and how steep they are. Writes no file.

mod functions;
mod operations;

use std::collections::BTreeSet;
use std::fmt;

use crate::field::expand::{expand, reachable};
use crate::field::steepness::{Steep, Steepness, steepness};
use crate::field::{Coordinate, Form, Graph, Node, NodeId, operations as count};
use crate::interrupt::Interrupt;
use crate::limits::Limits;
use crate::number::{Algebra, Interval};

use functions::{Unwritten, Writer, declaration};
use operations::{HELPERS, number};

/// An object in its space.
pub struct Place<'a> {
    /// The graph in which it stands.
    pub graph: &'a Graph,
    /// The coordinates that are X, Y and Z.
    pub axes: [Coordinate; 3],
    /// The values of all others that it uses.
    pub fixed: Vec<(Coordinate, f64)>,
}

/// Functions of POV-Ray.
#[derive(Clone, Debug, Default)]
pub struct Functions {
    /// Their declarations, each on lines of its own.
    pub declarations: String,
    /// The functions beside the language's own that they call.
    pub helpers: BTreeSet<&'static str>,
}

/// A function whose boundary POV-Ray can find.
#[derive(Clone, Debug)]
pub struct Isosurface {
    /// What must be declared before.
    pub functions: Functions,
    /// The function's name: of x, y and z, with the object's own values.
    pub name: String,
    /// How steep it is.
    pub steepness: Steepness,
}

/// Why an object is no function of POV-Ray.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// A part of it is data.
    Data(String),
    /// A part of it is a loop or a search at each point.
    Region(&'static str),
    /// It has that many operations, and the limit is the second number.
    TooLong(usize, usize),
    /// It needs more values at a time, or functions within functions, than POV-Ray takes.
    TooDeep,
    /// There is an infinite or undefined number in it.
    NoNumber,
    /// It may be undefined somewhere in its space.
    Undefined,
    /// No bound of its slope is known.
    Unbounded,
    /// Its colours come from a palette.
    Palette,
    /// The work was stopped.
    Cancelled,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Data(name) => write!(f, "its part `{name}` is data, which is no formula"),
            Self::Region(what) => write!(f, "it holds {what}, which POV-Ray's functions cannot express"),
            Self::TooLong(count, limit) => write!(f, "its {count} operations are more than {limit}"),
            Self::TooDeep => {
                write!(f, "it takes more values at a time, or functions within functions, than POV-Ray does")
            }
            Self::NoNumber => write!(f, "a number in it is infinite or undefined"),
            Self::Undefined => write!(f, "its function may be undefined somewhere in the modelling space"),
            Self::Unbounded => write!(f, "no bound was found for the gradient of its function near the boundary"),
            Self::Palette => write!(f, "its colours come from a palette, which is no formula"),
            Self::Cancelled => write!(f, "the work was stopped"),
        }
    }
}

impl From<Unwritten> for Reason {
    fn from(unwritten: Unwritten) -> Self {
        match unwritten {
            Unwritten::TooDeep => Self::TooDeep,
            Unwritten::NoNumber => Self::NoNumber,
        }
    }
}

impl From<Steep> for Reason {
    fn from(steep: Steep) -> Self {
        match steep {
            Steep::Undefined => Self::Undefined,
            Steep::Unbounded => Self::Unbounded,
            Steep::Cancelled => Self::Cancelled,
        }
    }
}

/// The function at a node, from `lo` to `hi`; the names of what is declared begin with `prefix`.
///
/// # Errors
/// The [`Reason`] why it cannot be one.
pub fn isosurface(
    place: &Place<'_>,
    node: NodeId,
    prefix: &str,
    (lo, hi): ([f64; 3], [f64; 3]),
    limits: &Limits,
    interrupt: &Interrupt,
) -> Result<Isosurface, Reason> {
    let (graph, root) = reduced(place, node, limits)?;
    let space = [0, 1, 2].map(|k| Interval::new(lo[k], hi[k]));
    let steepness = steepness(&graph, root, space, interrupt)?;
    let mut writer = Writer::new(&graph, prefix);
    let value = writer.write(root)?;
    let mut functions = Functions { declarations: writer.declarations, helpers: writer.helpers };
    functions.declarations += &declaration(prefix, &format!("(x, y, z) {{ {value} }}"));
    Ok(Isosurface { functions, name: prefix.into(), steepness })
}

/// The components of a colour, sRGB, as functions of linear light: the texts of their values at x, y and z.
///
/// # Errors
/// The [`Reason`] why one cannot be one.
pub fn colours(
    place: &Place<'_>,
    nodes: [NodeId; 3],
    prefix: &str,
    limits: &Limits,
) -> Result<(Functions, [String; 3]), Reason> {
    let mut all = Functions::default();
    let mut values = [const { String::new() }; 3];
    for (k, node) in nodes.into_iter().enumerate() {
        let (graph, root) = reduced(place, node, limits)?;
        let name = format!("{prefix}_{}", ["Red", "Green", "Blue"][k]);
        let mut writer = Writer::new(&graph, &name);
        let value = writer.write(root)?;
        writer.need("Yont_Light");
        all.declarations += &writer.declarations;
        all.helpers.extend(writer.helpers);
        all.declarations += &declaration(&name, &format!("(x, y, z) {{ {value} }}"));
        values[k] = format!("Yont_Light({name}(x, y, z))");
    }
    Ok((all, values))
}

/// The declarations of those helpers.
#[must_use]
pub fn helpers(wanted: &BTreeSet<&'static str>) -> String {
    let wanted = HELPERS.iter().filter(|helper| wanted.contains(helper.name));
    wanted.map(|helper| declaration(helper.name, helper.declaration)).collect()
}

/// A number as the language reads it.
#[must_use]
pub fn written(value: f64) -> String {
    number(value)
}

/// The function in a graph of its own, of x1, x2 and x3 alone, without maps, data and regions.
fn reduced(place: &Place<'_>, node: NodeId, limits: &Limits) -> Result<(Graph, NodeId), Reason> {
    let limit = limits.pov_operations;
    let too_long = |count| Reason::TooLong(count, limit);
    refuse_parts(place.graph, node)?;
    let operations = count(place.graph, node);
    if operations > limit {
        return Err(too_long(operations));
    }
    let expanded = expand(place.graph, &[node], 2 * limit).map_err(|_| too_long(2 * limit))?;
    let (graph, root) = expanded.as_ref().map_or((place.graph, node), |(graph, roots)| (graph, roots[0]));
    let reached = reachable(graph, root);
    let mut result = Graph::new();
    let mut made = vec![NodeId(0); reached.len()];
    for id in (0u32..).map(NodeId).take(reached.len()).filter(|id| reached[id.index()]) {
        made[id.index()] = match graph.node(id) {
            Node::Coordinate(c) => {
                let axis = (1u8..).zip(place.axes).find(|(_, axis)| axis == c);
                let fixed = place.fixed.iter().find(|(fixed, _)| fixed == c).map_or(f64::NAN, |fixed| fixed.1);
                match axis {
                    Some((k, _)) => result.coordinate(Coordinate(k)),
                    None => result.constant(fixed),
                }
            }
            other => result.rebuilt(other, |e| made[e.index()]),
        };
    }
    let root = made[root.index()];
    let operations = count(&result, root);
    if operations > limit { Err(too_long(operations)) } else { Ok((result, root)) }
}

/// Refuses what no formula is.
fn refuse_parts(graph: &Graph, root: NodeId) -> Result<(), Reason> {
    let reached = reachable(graph, root);
    for id in (0u32..).map(NodeId).take(reached.len()).filter(|id| reached[id.index()]) {
        match graph.node(id) {
            Node::Leaf(leaf, _) => return Err(Reason::Data(leaf.0.name().into())),
            Node::Region(region, ..) => {
                return Err(Reason::Region(match region.0.form() {
                    Form::Loop { .. } => "a loop that runs at each point",
                    Form::Section { .. } => "a highest value over a section (PROJECT)",
                    Form::Ball { .. } => "a highest value over a ball (OFFSET_BALL)",
                }));
            }
            _ => {}
        }
    }
    Ok(())
}
