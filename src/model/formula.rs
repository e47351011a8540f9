//! An object, a number or an array as one definition of the language, with names and parameters substituted: what `:formula` shows.
//! Read again, it defines the same. Evaluates nothing.

mod parts;

use std::path::{Path, PathBuf};

use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::Diagnostic;
use crate::field::expand::reachable;
use crate::field::{Graph, Node, NodeId, SharedLeaf};
use crate::number::Ternary;
use crate::syntax::print::format;

use super::objects::severe;
use super::session::Session;
use super::value::{Scalar, Value};
use parts::{Level, Writer, number};

/// Bytes from which a text is left in one line: breaking it would take longer than anybody reads.
const LONGEST_BROKEN: usize = 64 << 10;

/// A definition that stands on nothing else.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formula {
    /// The definition.
    pub text: String,
    /// Whether some set operations are written out by equations (2) and (5), since the definition holds more than one system of
    /// R-functions: equal but for rounding.
    pub rewritten: bool,
}

/// The system of R-functions of one operation, as far as it is a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum InForce {
    /// `r_alpha` by its bits.
    Alpha(u64),
    /// `r_m` by its bits.
    Smooth(u64),
}

impl Session {
    /// What a name stands for as one definition. Shared parts stand once, behind WHERE. Data files are named as seen from `folder`.
    ///
    /// # Errors
    /// Messages for the user: an unknown name, one that fails, a function with parameters.
    pub fn formula(&mut self, name: &str, folder: Option<&Path>) -> Result<Formula, Vec<Diagnostic>> {
        self.refresh(name);
        let value = match self.value(name) {
            Some(Ok(Value::Function(function))) => {
                let title = format!("`{}` has parameters, so it is no single expression", function.signature());
                let help = format!("give it arguments: `gob_it = {};`, then `:formula gob_it`", function.signature());
                return Err(vec![Diagnostic::error("not-an-expression", title).help(help)]);
            }
            Some(Ok(value)) => value,
            Some(Err(told)) => return Err(vec![severe(&told)]),
            None if self.is_defined(name) => {
                return Err(vec![Diagnostic::error("never-assigned", format!("`{name}` has no value"))]);
            }
            None => return Err(vec![self.unknown(name)]),
        };
        self.written(name, &value, folder).map_err(|told| vec![told])
    }

    fn written(&self, name: &str, value: &Value, folder: Option<&Path>) -> Result<Formula, Diagnostic> {
        let mut roots = Vec::new();
        gather(value, &mut roots);
        let (nodes, uses) = counted(&self.graph, &roots);
        let main = main_system(&self.graph, &nodes);
        let mut writer = Writer::new(&self.graph, uses, main, self.leaves(folder));
        for node in nodes {
            if self.interrupt.tick().is_err() {
                return Err(super::lower::cancelled());
            }
            writer.add(node).map_err(|words| {
                Diagnostic::error("not-an-expression", format!("`{name}` cannot be written as an expression: {words}"))
                    .help("`NAME??` shows its definition, and `:save` writes the whole program")
            })?;
        }
        let mut body = String::new();
        write_value(value, &mut writer, &mut body);
        let (bindings, rewritten) = writer.finish();
        for (k, (q, text)) in bindings.iter().enumerate() {
            body += &format!("{} {q} = {text}", if k == 0 { " WHERE" } else { "," });
        }
        let sets = match main {
            None | Some(InForce::Alpha(0)) => return Ok(broken(format!("{name} = {body};"), rewritten)),
            Some(InForce::Alpha(bits)) => format!("r_alpha = {}", number(f64::from_bits(bits))),
            Some(InForce::Smooth(bits)) => format!("r_m = {}", number(f64::from_bits(bits))),
        };
        Ok(broken(format!("{name} = BEGIN {sets}; {name} = {body}; END;"), rewritten))
    }

    /// The words for each leaf: its call as far as the file.
    fn leaves(&self, folder: Option<&Path>) -> impl Fn(&SharedLeaf) -> Option<String> {
        let known: Vec<(u128, PathBuf, String)> = self.files.known().collect();
        let host = self.host.clone();
        let folder = folder.map(Path::to_path_buf);
        move |leaf| {
            let (_, path, call) = known.iter().find(|(fingerprint, ..)| *fingerprint == leaf.0.fingerprint())?;
            let path = crate::host::seen_from(&*host, folder.as_deref(), path);
            Some(format!("{call}\"{}\"", path.display()))
        }
    }
}

/// The nodes that the roots need, operands before what reads them, and how often each is read.
fn counted(graph: &Graph, roots: &[NodeId]) -> (Vec<NodeId>, FxHashMap<NodeId, usize>) {
    let mut needed = FxHashSet::default();
    let mut uses = FxHashMap::default();
    for &root in roots {
        *uses.entry(root).or_insert(0) += 1;
        if !needed.contains(&root) {
            let reached = reachable(graph, root);
            needed.extend((0..=root.0).map(NodeId).filter(|id| reached[id.index()]));
        }
    }
    let mut nodes: Vec<NodeId> = needed.into_iter().collect();
    nodes.sort_unstable();
    for &node in &nodes {
        graph.node(node).for_each_operand(|e| *uses.entry(e).or_insert(0) += 1);
    }
    (nodes, uses)
}

/// The system that most of the set operations have: these are written as operators.
fn main_system(graph: &Graph, nodes: &[NodeId]) -> Option<InForce> {
    let mut counts: FxHashMap<InForce, usize> = FxHashMap::default();
    for node in nodes {
        if let Node::Ternary(op, [_, _, c]) = graph.node(*node)
            && let Some(system) = in_force(*op, graph.number(*c))
        {
            *counts.entry(system).or_default() += 1;
        }
    }
    counts.into_iter().max_by_key(|&(system, count)| (count, std::cmp::Reverse(system))).map(|(system, _)| system)
}

/// A name and the expression that it stands for.
pub(super) type Named = (String, String);

/// Expressions of a graph in the words of the language, and the names of the longer parts that they share.
///
/// # Errors
/// Words that say what the language has no expression for.
pub(super) fn expressions(graph: &Graph, roots: &[NodeId]) -> Result<(Vec<String>, Vec<Named>), String> {
    let (nodes, uses) = counted(graph, roots);
    let main = main_system(graph, &nodes);
    let mut writer = Writer::new(graph, uses, main, |leaf| Some(format!("DATA(\"{}\"", leaf.0.name())));
    nodes.into_iter().try_for_each(|node| writer.add(node))?;
    let texts = roots.iter().map(|root| writer.take(*root, Level::Product)).collect();
    Ok((texts, writer.finish().0))
}

fn in_force(op: Ternary, c: Option<f64>) -> Option<InForce> {
    match op {
        Ternary::Union | Ternary::Intersection => Some(InForce::Alpha(c?.to_bits())),
        Ternary::UnionSmooth | Ternary::IntersectionSmooth => Some(InForce::Smooth(c?.to_bits())),
        Ternary::Select | Ternary::Norm => None,
    }
}

fn gather(value: &Value, roots: &mut Vec<NodeId>) {
    match value {
        Value::Scalar(Scalar::Node(id)) => roots.push(*id),
        Value::Array(array) => array.items().iter().for_each(|item| gather(item, roots)),
        _ => {}
    }
}

fn write_value(value: &Value, writer: &mut Writer<'_>, out: &mut String) {
    match value {
        Value::Scalar(Scalar::Number(value)) => out.push_str(&number(*value)),
        Value::Scalar(Scalar::Node(id)) => out.push_str(&writer.take(*id, Level::If)),
        Value::Array(array) => {
            out.push('[');
            for (k, item) in array.items().iter().enumerate() {
                out.push_str(if k == 0 { "" } else { ", " });
                write_value(item, writer, out);
            }
            out.push(']');
        }
        Value::Text(text) => *out += &format!("\"{text}\""),
        // A name that stands for a function was refused, and an array holds none.
        Value::Function(_) => {}
    }
}

/// The definition in lines as the formatter breaks them.
fn broken(text: String, rewritten: bool) -> Formula {
    let formatted = (text.len() < LONGEST_BROKEN).then(|| {
        let mut sources = crate::source::SourceMap::default();
        let id = sources.add("", text.as_str());
        format(&sources, id, &crate::limits::Limits::default()).ok()
    });
    let text = formatted.flatten().map_or(text, |formatted| formatted.trim_end().to_owned());
    Formula { text, rewritten }
}
