//! Data as functions: INTERPOLATE reads its file through the host and makes a leaf of it.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustc_hash::FxHashMap;

use crate::builtins::Builtin;
use crate::data::{self, DataError, Interpolation};
use crate::diagnostic::{Category, Diagnostic};
use crate::field::SharedLeaf;
use crate::number::Leaf;
use crate::source::Span;
use crate::syntax::tree::Expr;

use super::super::value::Value;
use super::{Lower, Lowered};

/// The leaves made so far, by file and kind, so that a file is read once in a session.
#[derive(Debug, Default)]
pub struct Files {
    leaves: FxHashMap<(PathBuf, String), Arc<dyn Leaf>>,
}

impl Files {
    /// What was read: the fingerprint of each leaf, its file and its kind of interpolation.
    pub fn known(&self) -> impl Iterator<Item = (u128, PathBuf, String)> {
        self.leaves.iter().map(|((path, kind), leaf)| (leaf.fingerprint(), path.clone(), kind.clone()))
    }

    /// Forgets what was read, so that changed files are read again.
    pub fn clear(&mut self) {
        self.leaves.clear();
    }
}

impl Lower<'_> {
    pub(super) fn interpolate(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let kind = self.text(&arguments[0], "the kind of interpolation")?;
        let file = self.text(&arguments[1], "the file of INTERPOLATE")?;
        let leaf = self.volume(&kind, &file, &arguments[0], &arguments[1])?;
        let given = arguments.len() - 2;
        if leaf.arity() != given {
            let title = format!("`{file}` has {} axes, and {given} coordinates are given", leaf.arity());
            return Err(Diagnostic::error("wrong-axes", title)
                .at(span, "")
                .help(format!("one expression per axis: {}", builtin.signature()))
                .into());
        }
        let mut nodes = Vec::with_capacity(given);
        for e in &arguments[2..] {
            nodes.push(self.scalar(e, "a coordinate of INTERPOLATE")?.node(self.graph));
        }
        let id = self.graph.leaf(SharedLeaf(leaf), &nodes);
        Ok(Value::Scalar(self.wrap(id)))
    }

    fn volume(&mut self, kind: &str, file: &str, kind_at: &Expr, file_at: &Expr) -> Lowered<Arc<dyn Leaf>> {
        let from = self.world.sources.get(file_at.span.source).map(|s| PathBuf::from(&s.name));
        let path = crate::host::resolve(from.as_deref(), Path::new(file));
        let key = (path, kind.to_ascii_lowercase());
        if let Some(leaf) = self.files.leaves.get(&key) {
            return Ok(leaf.clone());
        }
        let bytes = self
            .world
            .host
            .read(&key.0, self.world.limits.data_bytes)
            .map_err(|e| e.diagnostic().at(file_at.span, "").see(kind_at.span, ""))?;
        let leaf = self.decode(&key.1, &key.0, &bytes, kind_at.span, file_at.span)?;
        self.files.leaves.insert(key, leaf.clone());
        Ok(leaf)
    }

    fn decode(&self, kind: &str, path: &Path, bytes: &[u8], kind_at: Span, file_at: Span) -> Lowered<Arc<dyn Leaf>> {
        let Some(kind) = Interpolation::from_name(kind) else {
            let known: Vec<String> = Interpolation::NAMES.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            return Err(Diagnostic::error("interpolation-kind", format!("there is no interpolation \"{kind}\""))
                .at(kind_at, "")
                .help(format!("the kinds are {}", known.join(", ")))
                .into());
        };
        let mut fetch = |file: &str| {
            let beside = crate::host::resolve(Some(path), Path::new(file));
            let read = self.world.host.read(&beside, self.world.limits.data_bytes);
            read.map_err(|e| io::Error::other(e.to_string()))
        };
        let context = data::Context { limits: self.world.limits, interrupt: self.world.interrupt };
        let leaf = data::decode(&path.display().to_string(), bytes, &mut fetch, context)
            .and_then(|volume| Arc::new(volume).leaf(kind));
        leaf.map_err(|error| match error {
            DataError::Cancelled => super::Fault::Cancelled,
            error => Diagnostic::error("bad-data", format!("`{}`: {error}", path.display()))
                .category(Category::File)
                .at(file_at, "")
                .help(error.help())
                .into(),
        })
    }
}
