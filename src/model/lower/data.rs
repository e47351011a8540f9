//! Data as functions: INTERPOLATE, MESH and HEIGHT read their files through the host and make leaves of them, SCATTER makes one
//! of numbers.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rustc_hash::FxHashMap;

use crate::builtins::Builtin;
use crate::data::mesh::{self, MeshError};
use crate::data::sheet::height::{self, HeightError};
use crate::data::sheet::scatter::{self, ScatterError};
use crate::data::{self, DataError, Interpolation};
use crate::diagnostic::{Category, Diagnostic};
use crate::field::{Coordinate, SharedLeaf};
use crate::number::Leaf;
use crate::source::Span;
use crate::syntax::tree::Expr;

use super::super::errors;
use super::super::value::{self, Scalar, Value};
use super::{Lower, Lowered};

/// What a file is read as.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum As {
    /// A volume with a kind of interpolation.
    Volume(String),
    Mesh,
    Picture,
}

/// A file as a function, and what there is to tell of it: code, title and help.
#[derive(Clone, Debug)]
struct Read {
    leaf: Arc<dyn Leaf>,
    told: Vec<(&'static str, String, &'static str)>,
}

/// The leaves made so far, by file and kind, so that a file is read once in a session.
#[derive(Debug, Default)]
pub struct Files {
    leaves: FxHashMap<(PathBuf, As), Read>,
    /// What SCATTER made, by all that it was given.
    sheets: FxHashMap<Vec<u64>, Arc<dyn Leaf>>,
}

/// Sheets that are kept at most.
const SHEETS: usize = 8;

impl Files {
    /// What was read: the fingerprint of each leaf, its file, and what stands in front of the file in a call.
    pub fn known(&self) -> impl Iterator<Item = (u128, PathBuf, String)> {
        self.leaves.iter().map(|((path, read_as), read)| {
            let call = match read_as {
                As::Volume(kind) => format!("INTERPOLATE(\"{kind}\", "),
                As::Mesh => "MESH(".to_owned(),
                As::Picture => "HEIGHT(".to_owned(),
            };
            (read.leaf.fingerprint(), path.clone(), call)
        })
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
        let known = interpolation(&kind, arguments[0].span)?;
        let (at, also) = (arguments[1].span, Some(arguments[0].span));
        let leaf = self.read(&file, As::Volume(kind.to_ascii_lowercase()), at, also, |lower, path, bytes| {
            let leaf = lower.decode(known, path, bytes, at)?;
            Ok(Read { leaf, told: Vec::new() })
        })?;
        let given = arguments.len() - 2;
        if leaf.arity() != given {
            let title = format!("`{file}` has {} axes, and {given} coordinates are given", leaf.arity());
            return Err(Diagnostic::error("wrong-axes", title)
                .at(span, "")
                .help(format!("one expression per axis: {}", builtin.signature()))
                .into());
        }
        self.leaf_at(leaf, &arguments[2..], "a coordinate of INTERPOLATE")
    }

    /// A leaf at expressions.
    fn leaf_at(&mut self, leaf: Arc<dyn Leaf>, at: &[Expr], what: &str) -> Lowered<Value> {
        let mut nodes = Vec::with_capacity(at.len());
        for e in at {
            nodes.push(self.scalar(e, what)?.node(self.graph));
        }
        let id = self.graph.leaf(SharedLeaf(leaf), &nodes);
        Ok(Value::Scalar(self.wrap(id)))
    }

    /// `MESH(file)`, `MESH(file, e1, e2, e3)`
    pub(super) fn mesh(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        if ![1, 4].contains(&arguments.len()) {
            return Err(errors::wrong_builtin_count(builtin, arguments.len(), span).into());
        }
        let file = self.text(&arguments[0], "the file of MESH")?;
        let at = arguments[0].span;
        let leaf = self.read(&file, As::Mesh, at, None, |lower, path, bytes| {
            let context = data::Context { limits: lower.world.limits, interrupt: lower.world.interrupt };
            let (leaf, noted) = mesh::decode(&path.display().to_string(), bytes, context).map_err(|e| match e {
                MeshError::Cancelled => super::Fault::Cancelled,
                e => bad_file("bad-mesh", path, &e.to_string(), e.help(), at).into(),
            })?;
            Ok(Read { leaf, told: told(path, &noted) })
        })?;
        if arguments.len() > 1 {
            return self.leaf_at(leaf, &arguments[1..], "a coordinate of MESH");
        }
        let place = [1, 2, 3].map(|c| self.graph.coordinate(Coordinate(c)));
        let id = self.graph.leaf(SharedLeaf(leaf), &place);
        Ok(Value::Scalar(self.wrap(id)))
    }

    /// `HEIGHT(file, e1, e2)`
    pub(super) fn height(&mut self, arguments: &[Expr]) -> Lowered<Value> {
        let file = self.text(&arguments[0], "the file of HEIGHT")?;
        let at = arguments[0].span;
        let leaf = self.read(&file, As::Picture, at, None, |lower, path, bytes| {
            let context = data::Context { limits: lower.world.limits, interrupt: lower.world.interrupt };
            let leaf = height::sheet(&path.display().to_string(), bytes, context).map_err(|e| match e {
                HeightError::Cancelled => super::Fault::Cancelled,
                e => bad_file("bad-picture", path, &e.to_string(), e.help().into(), at).into(),
            })?;
            Ok(Read { leaf, told: Vec::new() })
        })?;
        self.leaf_at(leaf, &arguments[1..], "a coordinate of HEIGHT")
    }

    /// `SCATTER(points, values, smoothness, nx, ny, e1, e2)`
    pub(super) fn scatter(&mut self, builtin: &Builtin, arguments: &[Expr], span: Span) -> Lowered<Value> {
        let [points, values, smoothness, nx, ny, at @ ..] = arguments else { return Ok(Value::number(f64::NAN)) };
        let rows = self.rows(builtin, points)?;
        let places: Option<Vec<[f64; 2]>> = rows.iter().map(|row| row[..].try_into().ok()).collect();
        let Some(places) = places else {
            return Err(errors::wrong_builtin_shape(builtin, "an array of points [x, y]", points.span).into());
        };
        let heights = self.numbers(builtin, values)?;
        if places.len() != heights.len() {
            return Err(errors::lengths_differ(places.len(), heights.len(), points.span, values.span).into());
        }
        let smooth = self.plain_number(smoothness, "the smoothness of SCATTER")?;
        if !(0.0..=1e100).contains(&smooth) {
            let title = format!("the smoothness of SCATTER is {}; it is 0 or more", value::number(smooth));
            let help = "0 follows the values as closely as the elements can, 1 is nearly a plane; try 1e-6";
            return Err(Diagnostic::error("bad-scatter", title).at(smoothness.span, "").help(help).into());
        }
        let mut elements = [0; 2];
        for (to, e) in elements.iter_mut().zip([nx, ny]) {
            let count = self.plain_number(e, "the number of elements of SCATTER")?;
            if !(count.fract() == 0.0 && (1.0..=1e6).contains(&count)) {
                let title = format!(
                    "the number of elements of SCATTER is {}; it is a whole number from 1",
                    value::number(count)
                );
                return Err(Diagnostic::error("bad-scatter", title).at(e.span, "").help("try 30").into());
            }
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let whole = count as usize;
            *to = whole;
        }
        let leaf = self.sheet(&places, &heights, smooth, elements, span)?;
        self.leaf_at(leaf, at, "a coordinate of SCATTER")
    }

    /// The sheet of those values, solved once in a session.
    fn sheet(
        &mut self,
        at: &[[f64; 2]],
        values: &[f64],
        smooth: f64,
        n: [usize; 2],
        span: Span,
    ) -> Lowered<Arc<dyn Leaf>> {
        let mut words: Vec<u64> = at.iter().flatten().chain(values).chain([&smooth]).map(|v| v.to_bits()).collect();
        words.extend(n.map(|n| n as u64));
        if let Some(leaf) = self.files.sheets.get(&words) {
            return Ok(leaf.clone());
        }
        let context = data::Context { limits: self.world.limits, interrupt: self.world.interrupt };
        let leaf = scatter::sheet(at, values, smooth, n, context).map_err(|e| match e {
            ScatterError::Cancelled => super::Fault::Cancelled,
            e => Diagnostic::error("bad-scatter", e.to_string()).at(span, "").help(e.help()).into(),
        })?;
        // A session that moves a slider would keep all that it passed.
        if self.files.sheets.len() >= SHEETS {
            self.files.sheets.clear();
        }
        self.files.sheets.insert(words, leaf.clone());
        Ok(leaf)
    }

    fn plain_number(&mut self, e: &Expr, what: &str) -> Lowered<f64> {
        match self.scalar(e, what)? {
            Scalar::Number(value) => Ok(value),
            Scalar::Node(_) => {
                let title = format!("{what} is a number, the same everywhere");
                Err(Diagnostic::error("bad-scatter", title).at(e.span, "").help("use a number or a parameter").into())
            }
        }
    }

    /// The function that a file makes, which `make` makes if it is not known; what there is to tell is told each time.
    fn read(
        &mut self,
        file: &str,
        read_as: As,
        at: Span,
        also: Option<Span>,
        make: impl FnOnce(&Self, &Path, &[u8]) -> Lowered<Read>,
    ) -> Lowered<Arc<dyn Leaf>> {
        let from = self.world.sources.get(at.source).map(|s| PathBuf::from(&s.name));
        let key = (crate::host::resolve(from.as_deref(), Path::new(file)), read_as);
        if !self.files.leaves.contains_key(&key) {
            let bytes = self.world.host.read(&key.0, self.world.limits.data_bytes).map_err(|e| {
                let told = e.diagnostic().at(at, "");
                also.map_or(told.clone(), |span| told.see(span, ""))
            })?;
            let read = make(self, &key.0, &bytes)?;
            self.files.leaves.insert(key.clone(), read);
        }
        let read = &self.files.leaves[&key];
        for (code, title, help) in &read.told {
            self.warnings.push(Diagnostic::warning(code, title).at(at, "").help(*help));
        }
        Ok(read.leaf.clone())
    }

    fn decode(&self, kind: Interpolation, path: &Path, bytes: &[u8], file_at: Span) -> Lowered<Arc<dyn Leaf>> {
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
            error => bad_file("bad-data", path, &error.to_string(), error.help(), file_at).into(),
        })
    }
}

fn bad_file(code: &'static str, path: &Path, what: &str, help: String, at: Span) -> Diagnostic {
    let title = format!("`{}`: {what}", path.display());
    Diagnostic::error(code, title).category(Category::File).at(at, "").help(help)
}

/// What there is to tell of a mesh that is good enough.
fn told(path: &Path, noted: &mesh::Noted) -> Vec<(&'static str, String, &'static str)> {
    let path = path.display();
    let mended = noted.mended;
    let counted = |n: usize, one: &str, many: &str| match n {
        0 => None,
        1 => Some(format!("1 {one}")),
        n => Some(format!("{n} {many}")),
    };
    let parts = [
        counted(mended.joined, "double vertex joined", "double vertices joined"),
        counted(mended.filled, "small hole filled", "small holes filled"),
        counted(mended.turned, "triangle turned round", "triangles turned round"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let mut all = Vec::new();
    if !parts.is_empty() {
        let title = format!("`{path}` was mended to be closed: {}", parts.join(", "));
        all.push(("mended-mesh", title, "if that is not what was meant, mend it in the program that it comes from"));
    }
    if let Some((count, at)) = &noted.crossings {
        let pairs = if *count == 1 {
            "a pair of triangles crosses".into()
        } else {
            format!("{count} pairs of triangles cross")
        };
        let title = format!("`{path}` goes through itself: {pairs}, one near {at}");
        let help = "inside is what the mesh goes round; there, values are the distance to the nearest triangle, also of those within";
        all.push(("crossing-mesh", title, help));
    }
    all
}

fn interpolation(kind: &str, place: Span) -> Lowered<Interpolation> {
    Interpolation::from_name(&kind.to_ascii_lowercase()).ok_or_else(|| {
        let known: Vec<String> = Interpolation::NAMES.iter().map(|(name, _)| format!("\"{name}\"")).collect();
        Diagnostic::error("interpolation-kind", format!("there is no interpolation \"{kind}\""))
            .at(place, "")
            .help(format!("the kinds are {}", known.join(", ")))
            .into()
    })
}
