//! Meshes as binary glTF 2.0. Writes front to back, keeps the model's numbers and never seeks.
//!
//! glTF counts in metres with Y up: one node turns Z up into Y up and takes one unit as one millimetre, so that the vertices
//! stay those of the model. An animation has one mesh for each frame; a node's scale is 1 while its frame shows, else 0.

use super::{Part, fits_together, refuse};
use gltf_json as json;
use json::accessor::{ComponentType, GenericComponentType, Type};
use json::buffer::{Target, View};
use json::validation::Checked::Valid;
use json::validation::USize64;
use json::{Accessor, Index, Root};
use std::io::{self, Write};

/// The columns of the matrix that turns Z up into Y up and millimetres into metres.
const TURN: [f32; 16] = [
    0.001, 0., 0., 0., //
    0., 0., -0.001, 0., //
    0., 0.001, 0., 0., //
    0., 0., 0., 1.,
];

/// Writes meshes that are seen together, each under its own name and with its normals and colours: one object, several, a group of
/// sections, or isosurfaces that show through. `name` is that of the whole.
///
/// # Errors
/// Those of the writer; `InvalidInput` without a part, for an empty mesh, arrays that do not fit together, or more than 4 GiB.
pub fn write(parts: &[Part<'_>], name: &str, out: &mut impl Write) -> io::Result<()> {
    if parts.is_empty() {
        return Err(refuse("there is no mesh to write"));
    }
    let mut file = File::default();
    let nodes = parts.iter().map(|part| file.part(part, part.name, None)).collect::<io::Result<_>>()?;
    file.finish(nodes, name, out)
}

/// Writes frames that follow each other every `delay` seconds, each shown for that long, under their names and numbers. A viewer that
/// does not play shows the first.
///
/// # Errors
/// As [`write()`]; also when there is no frame or `delay` is not above 0.
pub fn write_animation(frames: &[Part<'_>], delay: f64, name: &str, out: &mut impl Write) -> io::Result<()> {
    if frames.is_empty() || !(delay > 0. && delay.is_finite()) {
        return Err(refuse("an animation needs a frame and a time above 0 for each"));
    }
    let mut file = File::default();
    let mut nodes = Vec::with_capacity(frames.len());
    for (i, frame) in frames.iter().enumerate() {
        let scale = if i == 0 { 1. } else { 0. };
        nodes.push(file.part(frame, &format!("{}-{i:03}", frame.name), Some([scale; 3]))?);
    }
    if frames.len() > 1 {
        file.animate(&nodes, delay);
    }
    file.finish(nodes, name, out)
}

/// A piece of the binary chunk, written only once all lengths are known.
enum Piece<'a> {
    Vectors(&'a [[f64; 3]]),
    Colours(&'a [[u8; 3]]),
    Triangles(&'a [[u32; 3]]),
    Floats(Vec<f32>),
}

impl Piece<'_> {
    /// Bytes in the file; all pieces keep the alignment of four.
    fn len(&self) -> u64 {
        match self {
            Piece::Vectors(all) => all.len() as u64 * 12,
            Piece::Colours(all) => all.len() as u64 * 8,
            Piece::Triangles(all) => all.len() as u64 * 12,
            Piece::Floats(all) => all.len() as u64 * 4,
        }
    }

    fn write(&self, out: &mut impl Write) -> io::Result<()> {
        match self {
            Piece::Vectors(all) => {
                all.iter().flatten().try_for_each(|&x| out.write_all(&(x as f32 + 0.).to_le_bytes()))
            }
            Piece::Colours(all) => {
                let linear = linear_table();
                all.iter().try_for_each(|colour| {
                    colour.iter().try_for_each(|&c| out.write_all(&linear[usize::from(c)].to_le_bytes()))?;
                    out.write_all(&u16::MAX.to_le_bytes())
                })
            }
            Piece::Triangles(all) => all.iter().flatten().try_for_each(|i| out.write_all(&i.to_le_bytes())),
            Piece::Floats(all) => all.iter().try_for_each(|x| out.write_all(&x.to_le_bytes())),
        }
    }
}

/// glTF's vertex colours are linear light; the table takes sRGB's bytes there.
fn linear_table() -> [u16; 256] {
    std::array::from_fn(|i| {
        let c = i as f64 / 255.;
        let light = if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) };
        (light * 65535.).round() as u16
    })
}

/// The description and the binary parts as they grow.
#[derive(Default)]
struct File<'a> {
    root: Root,
    pieces: Vec<Piece<'a>>,
    tints: Vec<[u8; 4]>,
    length: u64,
}

/// How the numbers of one piece are to be read.
struct Layout {
    count: usize,
    component: ComponentType,
    kind: Type,
    target: Option<Target>,
    normalized: bool,
    range: Option<(Vec<f32>, Vec<f32>)>,
}

impl Layout {
    fn floats(count: usize, kind: Type) -> Self {
        Layout { count, component: ComponentType::F32, kind, target: None, normalized: false, range: None }
    }

    fn vertices(count: usize, component: ComponentType, kind: Type) -> Self {
        Layout { count, component, kind, target: Some(Target::ArrayBuffer), normalized: false, range: None }
    }
}

impl<'a> File<'a> {
    /// Adds a piece with its view and accessor.
    fn piece(&mut self, piece: Piece<'a>, layout: Layout) -> Index<Accessor> {
        let view = self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64(piece.len()),
            byte_offset: Some(USize64(self.length)),
            byte_stride: None,
            name: None,
            target: layout.target.map(Valid),
            extensions: None,
            extras: Default::default(),
        });
        self.length += piece.len();
        self.pieces.push(piece);
        let (min, max) = layout.range.map(|(lo, hi)| (json::Value::from(lo), json::Value::from(hi))).unzip();
        self.root.push(Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64(layout.count as u64),
            component_type: Valid(GenericComponentType(layout.component)),
            type_: Valid(layout.kind),
            min,
            max,
            name: None,
            normalized: layout.normalized,
            sparse: None,
            extensions: None,
            extras: Default::default(),
        })
    }

    /// Adds a mesh and the node that shows it.
    fn part(&mut self, part: &Part<'a>, name: &str, scale: Option<[f32; 3]>) -> io::Result<Index<json::Node>> {
        let mesh = part.mesh;
        fits_together(part)?;
        let count = mesh.positions.len();
        let mut attributes = std::collections::BTreeMap::new();
        let layout =
            Layout { range: Some(range(&mesh.positions)), ..Layout::vertices(count, ComponentType::F32, Type::Vec3) };
        let positions = self.piece(Piece::Vectors(&mesh.positions), layout);
        attributes.insert(Valid(json::mesh::Semantic::Positions), positions);
        if mesh.normals.len() == count {
            let normals =
                self.piece(Piece::Vectors(&mesh.normals), Layout::vertices(count, ComponentType::F32, Type::Vec3));
            attributes.insert(Valid(json::mesh::Semantic::Normals), normals);
        }
        if let Some(colours) = part.colours {
            let layout = Layout { normalized: true, ..Layout::vertices(count, ComponentType::U16, Type::Vec4) };
            let colours = self.piece(Piece::Colours(colours), layout);
            attributes.insert(Valid(json::mesh::Semantic::Colors(0)), colours);
        }
        let layout = Layout {
            target: Some(Target::ElementArrayBuffer),
            ..Layout::vertices(mesh.triangles.len() * 3, ComponentType::U32, Type::Scalar)
        };
        let indices = self.piece(Piece::Triangles(&mesh.triangles), layout);
        let material = self.material(part.tint);
        let primitive = json::mesh::Primitive {
            attributes,
            indices: Some(indices),
            material: Some(material),
            mode: Valid(json::mesh::Mode::Triangles),
            targets: None,
            extensions: None,
            extras: Default::default(),
        };
        let mesh = self.root.push(json::Mesh {
            name: Some(name.to_owned()),
            primitives: vec![primitive],
            weights: None,
            extensions: None,
            extras: Default::default(),
        });
        Ok(self.root.push(json::Node { mesh: Some(mesh), name: Some(name.to_owned()), scale, ..Default::default() }))
    }

    /// The number of the matt material of a colour, added when it is new.
    fn material(&mut self, colour: [u8; 4]) -> Index<json::Material> {
        use json::material::{AlphaMode, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
        if let Some(known) = self.tints.iter().position(|c| *c == colour) {
            return Index::new(known as u32);
        }
        self.tints.push(colour);
        let linear = linear_table();
        let [r, g, b] = [0, 1, 2].map(|k| f32::from(linear[usize::from(colour[k])]) / 65535.);
        let opaque = colour[3] == 255;
        self.root.push(json::Material {
            alpha_mode: Valid(if opaque { AlphaMode::Opaque } else { AlphaMode::Blend }),
            // Through a translucent surface its far side is seen from within.
            double_sided: !opaque,
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor([r, g, b, f32::from(colour[3]) / 255.]),
                metallic_factor: StrengthFactor(0.),
                roughness_factor: StrengthFactor(0.6),
                ..Default::default()
            },
            ..Default::default()
        })
    }

    /// Gives each node the keys that show it for its own time and hide it otherwise.
    fn animate(&mut self, nodes: &[Index<json::Node>], delay: f64) {
        use json::animation::{Animation, Channel, Interpolation, Property, Sampler, Target};
        let (mut channels, mut samplers) = (Vec::new(), Vec::new());
        for (i, &node) in nodes.iter().enumerate() {
            let (times, scales) = keys(i, nodes.len(), delay);
            let range = Some((vec![times[0]], vec![times[times.len() - 1]]));
            let layout = Layout { range, ..Layout::floats(times.len(), Type::Scalar) };
            let input = self.piece(Piece::Floats(times), layout);
            let output = self.piece(
                Piece::Floats(scales.iter().flat_map(|&s| [s; 3]).collect()),
                Layout::floats(scales.len(), Type::Vec3),
            );
            samplers.push(Sampler {
                input,
                output,
                interpolation: Valid(Interpolation::Step),
                extensions: None,
                extras: Default::default(),
            });
            channels.push(Channel {
                sampler: Index::new(i as u32),
                target: Target { node, path: Valid(Property::Scale), extensions: None, extras: Default::default() },
                extensions: None,
                extras: Default::default(),
            });
        }
        self.root.push(Animation {
            name: Some("T".to_owned()),
            channels,
            samplers,
            extensions: None,
            extras: Default::default(),
        });
    }

    /// Completes the description and writes header, description and binary parts.
    fn finish(mut self, children: Vec<Index<json::Node>>, name: &str, out: &mut impl Write) -> io::Result<()> {
        let turn = json::Node {
            name: Some(format!("{name}, millimetres with Z up")),
            matrix: Some(TURN),
            children: Some(children),
            ..Default::default()
        };
        let turn = self.root.push(turn);
        let scene = json::Scene { name: None, nodes: vec![turn], extensions: None, extras: Default::default() };
        self.root.scene = Some(self.root.push(scene));
        self.root.asset.generator = Some("yont".to_owned());
        self.root.push(json::Buffer {
            byte_length: USize64(self.length),
            name: None,
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
        let mut text = json::serialize::to_vec(&self.root).map_err(io::Error::other)?;
        text.resize(text.len().next_multiple_of(4), b' ');
        let total = u32::try_from(12 + 8 + text.len() as u64 + 8 + self.length)
            .map_err(|_| refuse("a GLB file cannot exceed 4 GiB; lower the resolution"))?;
        let mut out = io::BufWriter::with_capacity(1 << 16, out);
        out.write_all(b"glTF")?;
        for word in [2, total, text.len() as u32] {
            out.write_all(&word.to_le_bytes())?;
        }
        out.write_all(b"JSON")?;
        out.write_all(&text)?;
        out.write_all(&(self.length as u32).to_le_bytes())?;
        out.write_all(b"BIN\0")?;
        self.pieces.iter().try_for_each(|piece| piece.write(&mut out))?;
        out.flush()
    }
}

/// Smallest and largest coordinates as they are written.
fn range(positions: &[[f64; 3]]) -> (Vec<f32>, Vec<f32>) {
    let mut lo = vec![f32::INFINITY; 3];
    let mut hi = vec![f32::NEG_INFINITY; 3];
    for position in positions {
        for (i, &x) in position.iter().enumerate() {
            lo[i] = lo[i].min(x as f32);
            hi[i] = hi[i].max(x as f32);
        }
    }
    (lo, hi)
}

/// Times and scales of frame `i` of `count`: hidden, shown from `i * delay` on, hidden again when the next one comes.
fn keys(i: usize, count: usize, delay: f64) -> (Vec<f32>, Vec<f32>) {
    let at = |i: usize| (i as f64 * delay) as f32;
    let last = i + 1 == count;
    match (i, last) {
        (0, _) => (vec![0., at(1)], vec![1., 0.]),
        (_, false) => (vec![0., at(i), at(i + 1)], vec![0., 1., 0.]),
        (_, true) => (vec![0., at(i), at(i + 1)], vec![0., 1., 1.]),
    }
}
