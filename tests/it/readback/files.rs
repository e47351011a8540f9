//! Strict readers of the formats, written from their specifications or by crates that write none of ours.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::io::{Cursor, Read as _};

use yont::surface::Mesh;

/// The meshes of a file under their names, with the colours of their vertices.
#[derive(Debug, Default)]
pub struct Read {
    pub meshes: Vec<(String, Mesh)>,
    pub colours: Vec<Vec<[u8; 3]>>,
}

impl Read {
    fn add(&mut self, name: &str, positions: Vec<[f64; 3]>, normals: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) {
        self.meshes.push((name.to_owned(), Mesh { positions, normals, triangles }));
        self.colours.push(Vec::new());
    }

    fn colour(&mut self, colours: Vec<[u8; 3]>) {
        if let Some(last) = self.colours.last_mut() {
            *last = colours;
        }
    }
}

/// Whether each directed edge is used once and its reverse too, each triangle has three corners, and each vertex is used.
pub fn closed(mesh: &Mesh) -> Result<(), String> {
    let mut edges = HashSet::new();
    let mut used = vec![false; mesh.positions.len()];
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if from == to || !edges.insert((from, to)) {
                return Err(format!("the edge from {from} to {to} is used twice"));
            }
            *used.get_mut(from as usize).ok_or_else(|| format!("there is no vertex {from}"))? = true;
        }
    }
    match edges.iter().find(|(from, to)| !edges.contains(&(*to, *from))) {
        Some(edge) => Err(format!("the edge {edge:?} is open")),
        None if used.contains(&false) => Err("a vertex belongs to no triangle".into()),
        None => Ok(()),
    }
}

/// The volume, and the sum of the sizes of the tetrahedra of which it is the difference.
pub fn volume(mesh: &Mesh) -> [f64; 2] {
    let triple = |[a, b, c]: [[f64; 3]; 3]| {
        (0..3).map(|i| a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3])).sum::<f64>() / 6.0
    };
    let all = mesh.triangles.iter().map(|t| triple(t.map(|v| mesh.positions[v as usize])));
    all.fold([0.0; 2], |[sum, sizes], v| [sum + v, sizes + v.abs()])
}

/// The signed area of a loop.
pub fn area(points: &[[f64; 2]]) -> f64 {
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    pairs.map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>() / 2.0
}

pub fn stl(bytes: &[u8]) -> Read {
    assert!(!bytes.starts_with(b"solid") && bytes.is_ascii() | (bytes.len() > 84), "a binary file");
    assert_eq!(bytes.len(), 84 + 50 * u32::from_le_bytes(bytes[80..84].try_into().expect("four bytes")) as usize);
    let read = stl_io::read_stl(&mut Cursor::new(bytes)).expect("an STL");
    let wide = |v: [f32; 3]| v.map(f64::from);
    let positions: Vec<[f64; 3]> = read.vertices.iter().map(|v| wide([v[0], v[1], v[2]])).collect();
    let triangles: Vec<[u32; 3]> = read.faces.iter().map(|face| face.vertices.map(|v| v as u32)).collect();
    // The normal of a facet is that of its corners, or none for a sliver.
    for (face, corners) in read.faces.iter().zip(&triangles) {
        let [a, b, c] = corners.map(|v| positions[v as usize]);
        let minus = |p: [f64; 3], q: [f64; 3]| [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
        let (u, v) = (minus(b, a), minus(c, a));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let along: f64 = (0..3).map(|k| n[k] * f64::from(face.normal[k])).sum();
        let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
        assert!((along - length).abs() <= 1e-5 * length, "a normal against its triangle");
    }
    let mut file = Read::default();
    file.add("", positions, Vec::new(), triangles);
    file
}

fn numbers<const N: usize>(words: &[&str]) -> [f64; N] {
    assert_eq!(words.len(), N, "{words:?}");
    std::array::from_fn(|k| words[k].parse().expect("a number"))
}

pub fn obj(bytes: &[u8]) -> Read {
    let text = std::str::from_utf8(bytes).expect("text");
    let mut file = Read::default();
    let (mut name, mut positions, mut normals, mut triangles) = (String::new(), vec![], vec![], vec![]);
    let (mut colours, mut before) = (vec![], [1, 1]);
    let mut close =
        |name: &str, p: &mut Vec<[f64; 3]>, n: &mut Vec<[f64; 3]>, t: &mut Vec<[u32; 3]>, c: &mut Vec<_>| {
            if !name.is_empty() {
                let counts = [p.len(), n.len()];
                file.add(name, std::mem::take(p), std::mem::take(n), std::mem::take(t));
                file.colour(std::mem::take(c));
                return counts;
            }
            [0, 0]
        };
    for line in text.lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[0] {
            "#" => {}
            "o" => {
                let counts = close(&name, &mut positions, &mut normals, &mut triangles, &mut colours);
                before = [before[0] + counts[0], before[1] + counts[1]];
                assert_eq!(words.len(), 2, "a name of one word: {line}");
                name = words[1].to_owned();
            }
            "v" => {
                positions.push(numbers(&words[1..4]));
                if words.len() > 4 {
                    colours.push(numbers::<3>(&words[4..]).map(|c| {
                        assert!((0.0..=1.0).contains(&c), "{line}");
                        (c * 255.0).round() as u8
                    }));
                }
            }
            "vn" => normals.push(numbers(&words[1..])),
            "f" => {
                let corner = |word: &&str| {
                    let (v, n) = word.split_once("//").expect("a vertex and a normal");
                    let [v, n] = [v, n].map(|digits| digits.parse::<usize>().expect("a number"));
                    assert_eq!(v - before[0], n - before[1], "{line}");
                    (v - before[0]) as u32
                };
                let corners: Vec<u32> = words[1..].iter().map(corner).collect();
                triangles.push(corners.try_into().expect("a triangle"));
            }
            other => panic!("an unknown line: {other}"),
        }
    }
    close(&name, &mut positions, &mut normals, &mut triangles, &mut colours);
    for (_, mesh) in &file.meshes {
        assert_eq!(mesh.normals.len(), mesh.positions.len());
    }
    file
}

pub fn ply(bytes: &[u8]) -> Read {
    let end = b"end_header\n";
    let at = bytes.windows(end.len()).position(|w| w == end).expect("a header") + end.len();
    let header: Vec<&str> = std::str::from_utf8(&bytes[..at]).expect("text").lines().collect();
    assert_eq!(header[..2], ["ply", "format binary_little_endian 1.0"]);
    let mut properties = Vec::new();
    let mut counts = HashMap::new();
    for line in &header[2..header.len() - 1] {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            ["comment", ..] => {}
            ["element", name, count] => drop(counts.insert(name, count.parse::<usize>().expect("a number"))),
            ["property", kind @ ("float" | "uchar"), name] => properties.push((kind, name)),
            ["property", "list", "uchar", "uint", "vertex_indices"] => assert_eq!(counts.len(), 2, "of the faces"),
            _ => panic!("an unknown line: {line}"),
        }
    }
    let mut rest = &bytes[at..];
    let mut take = |n: usize| {
        let (first, after) = rest.split_at(n);
        rest = after;
        first
    };
    let (mut positions, mut normals, mut colours) = (vec![], vec![], vec![]);
    for _ in 0..counts["vertex"] {
        let mut of: HashMap<&str, f64> = HashMap::new();
        for (kind, name) in &properties {
            let value = match *kind {
                "float" => f64::from(f32::from_le_bytes(take(4).try_into().expect("four bytes"))),
                _ => f64::from(take(1)[0]),
            };
            of.insert(name, value);
        }
        positions.push(["x", "y", "z"].map(|name| of[name]));
        normals.push(["nx", "ny", "nz"].map(|name| of[name]));
        if of.contains_key("red") {
            colours.push(["red", "green", "blue"].map(|name| of[name] as u8));
        }
    }
    let mut triangles = Vec::new();
    for _ in 0..counts["face"] {
        assert_eq!(take(1)[0], 3, "a triangle");
        triangles.push([(); 3].map(|()| u32::from_le_bytes(take(4).try_into().expect("four bytes"))));
    }
    assert!(rest.is_empty(), "{} bytes behind the faces", rest.len());
    let mut file = Read::default();
    file.add("", positions, normals, triangles);
    file.colour(colours);
    file
}

/// The chunks of a GLB, checked as its specification has them: lengths, alignment, padding.
fn chunks(bytes: &[u8]) -> (&[u8], &[u8]) {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four bytes")) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let (json, rest) = (word(12), 20 + word(12));
    assert!(json % 4 == 0 && &bytes[16..20] == b"JSON" && &bytes[rest + 4..rest + 8] == b"BIN\0");
    assert!(word(rest) % 4 == 0 && rest + 8 + word(rest) == bytes.len());
    (&bytes[20..rest], &bytes[rest + 8..])
}

pub fn glb(bytes: &[u8]) -> Read {
    let (json, _) = chunks(bytes);
    let json: serde_json::Value = serde_json::from_slice(json).expect("JSON");
    for accessor in json["accessors"].as_array().expect("accessors") {
        let view = &json["bufferViews"][accessor["bufferView"].as_u64().expect("a view") as usize];
        let size = match accessor["componentType"].as_u64() {
            Some(5123) => 2,
            Some(5125 | 5126) => 4,
            other => panic!("components of type {other:?}"),
        };
        let width = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC3") => 3,
            Some("VEC4") => 4,
            other => panic!("elements of type {other:?}"),
        };
        let offset = view["byteOffset"].as_u64().unwrap_or(0);
        assert_eq!((offset % size, size * width % 4), (0, 0), "aligned: {view}");
        assert_eq!(view["byteLength"].as_u64(), Some(size * width * accessor["count"].as_u64().expect("a count")));
    }
    let file = gltf::Gltf::from_slice(bytes).expect("a GLB");
    let mut read = Read::default();
    for node in file.nodes().filter(|node| node.mesh().is_some()) {
        let mesh = node.mesh().expect("a mesh");
        for primitive in mesh.primitives() {
            let reader = primitive.reader(|_| file.blob.as_deref());
            let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
            let bounds = primitive.bounding_box();
            for k in 0..3 {
                let all = positions.iter().map(|p| p[k]);
                let ends = all.fold((f32::MAX, f32::MIN), |(lo, hi), x| (lo.min(x), hi.max(x)));
                assert_eq!(ends, (bounds.min[k], bounds.max[k]), "the bounds of the positions");
            }
            let normals = reader.read_normals().expect("normals").map(|n| n.map(f64::from)).collect();
            let corners: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
            let positions = positions.into_iter().map(|p| p.map(f64::from)).collect();
            read.add(node.name().unwrap_or_default(), positions, normals, corners.as_chunks::<3>().0.to_vec());
            if let Some(colours) = reader.read_colors(0) {
                let byte = |light: f32| {
                    let c = if light <= 0.003_130_8 { light * 12.92 } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
                    (c * 255.0).round() as u8
                };
                read.colour(colours.into_rgb_f32().map(|rgb| rgb.map(byte)).collect());
            }
        }
    }
    read
}

/// A part of a package as text.
fn part(package: &mut zip::ZipArchive<Cursor<&[u8]>>, name: &str) -> String {
    let mut text = String::new();
    package.by_name(name).expect(name).read_to_string(&mut text).expect("text");
    text
}

/// Every part has a type, every relationship a target, the thumbnail is a PNG.
fn package(bytes: &[u8]) {
    let mut package = zip::ZipArchive::new(Cursor::new(bytes)).expect("a package");
    let names: Vec<String> = package.file_names().map(str::to_owned).collect();
    assert_eq!(names[0], "[Content_Types].xml");
    let types = part(&mut package, "[Content_Types].xml");
    let types = resvg::usvg::roxmltree::Document::parse(&types).expect("XML");
    let known: Vec<&str> = types.descendants().filter_map(|n| n.attribute("Extension")).collect();
    for name in &names[1..] {
        let extension = name.rsplit('.').next().expect("an extension");
        assert!(known.contains(&extension), "{name} has no type");
    }
    let relations = part(&mut package, "_rels/.rels");
    let relations = resvg::usvg::roxmltree::Document::parse(&relations).expect("XML");
    let targets: Vec<&str> = relations.descendants().filter_map(|n| n.attribute("Target")).collect();
    assert_eq!(targets, ["/3D/3dmodel.model", "/Metadata/thumbnail.png"]);
    for target in targets {
        assert!(names.iter().any(|name| *name == target[1..]), "{target} is missing");
    }
}

pub fn threemf(bytes: &[u8]) -> Read {
    package(bytes);
    let read =
        threemf2::package::ThreemfPackage::from_reader_with_memory_optimized_deserializer(Cursor::new(bytes), true)
            .expect("a 3MF");
    let model = &read.root;
    assert_eq!(model.unit, Some(threemf2::model::domain::model::Unit::Millimeter));
    let thumbnail = png(&read.thumbnails.values().next().expect("a thumbnail").data);
    assert_eq!((thumbnail[0].width, thumbnail[0].height), (256, 256));
    let mut xml = zip::ZipArchive::new(Cursor::new(bytes)).expect("a package");
    let text = part(&mut xml, "3D/3dmodel.model");
    let document = resvg::usvg::roxmltree::Document::parse(&text).expect("XML");
    let elements = document.descendants().filter(|n| n.has_tag_name("object"));
    let mut file = Read::default();
    for (object, element) in model.resources.object.iter().zip(elements) {
        let mesh = object.get_mesh().expect("a mesh");
        let single = |x: f64| f64::from(x as f32);
        let positions: Vec<[f64; 3]> =
            mesh.vertices.vertex.iter().map(|v| [v.x.value(), v.y.value(), v.z.value()].map(single)).collect();
        let triangles: Vec<[u32; 3]> = mesh.triangles.triangle.iter().map(|t| [t.v1, t.v2, t.v3]).collect();
        let colours = colours(&document, &element, positions.len(), &triangles);
        file.add(element.attribute("name").expect("a name"), positions, Vec::new(), triangles);
        file.colour(colours);
    }
    let items: Vec<&str> = document.descendants().filter_map(|n| n.attribute("objectid")).collect();
    assert_eq!(items.len(), file.meshes.len(), "each object is built once");
    file
}

/// The colour of each vertex by the corners of the triangles, or that of the object; none without a property.
fn colours(
    document: &resvg::usvg::roxmltree::Document<'_>,
    object: &resvg::usvg::roxmltree::Node<'_, '_>,
    count: usize,
    triangles: &[[u32; 3]],
) -> Vec<[u8; 3]> {
    let Some(id) = object.attribute("pid") else { return Vec::new() };
    let group = document.descendants().find(|n| n.attribute("id") == Some(id)).expect("the property");
    assert!(group.range().start < object.range().start, "a property stands above its use");
    let entries = group.children().filter_map(|n| n.attribute("color").or(n.attribute("displaycolor")));
    let list: Vec<[u8; 3]> = entries
        .map(|hex| [1, 3, 5].map(|at| u8::from_str_radix(&hex[at..at + 2], 16).expect("hexadecimal digits")))
        .collect();
    let number = |text: Option<&str>| text.map(|t| t.parse::<usize>().expect("a number"));
    let whole = list[number(object.attribute("pindex")).expect("an index")];
    let mut all = vec![whole; count];
    let elements = object.descendants().filter(|n| n.has_tag_name("triangle"));
    for (element, corners) in elements.zip(triangles) {
        for (name, &corner) in ["p1", "p2", "p3"].iter().zip(corners) {
            if let Some(index) = number(element.attribute(*name)) {
                all[corner as usize] = list[index];
            }
        }
    }
    all
}

/// One picture of a file.
pub struct Frame {
    pub width: usize,
    pub height: usize,
    pub rgba: Vec<u8>,
}

/// The frames of a PNG or APNG.
pub fn png(bytes: &[u8]) -> Vec<Frame> {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().expect("a PNG");
    let count = reader.info().animation_control().map_or(1, |control| control.num_frames);
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let channels = reader.info().color_type.samples();
    let frames = (0..count).map(|_| {
        let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
        reader.next_frame(&mut pixels).expect("a frame");
        let rgba = match channels {
            4 => pixels,
            _ => pixels.chunks_exact(channels).flat_map(|p| [p[0], p[1], p[2], 255]).collect(),
        };
        Frame { width, height, rgba }
    });
    frames.collect()
}

pub fn gif(bytes: &[u8]) -> Vec<Frame> {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes).expect("a GIF");
    let (width, height) = (usize::from(decoder.width()), usize::from(decoder.height()));
    let mut all = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        assert_eq!((usize::from(frame.width), usize::from(frame.height)), (width, height));
        all.push(Frame { width, height, rgba: frame.buffer.to_vec() });
    }
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    all
}

/// A group of paths.
#[derive(Debug, Default)]
pub struct Group {
    pub marks: BTreeMap<String, f64>,
    pub loops: Vec<Vec<[f64; 2]>>,
}

pub struct Svg {
    pub view: [f64; 4],
    pub millimetres: [f64; 2],
    pub groups: Vec<Group>,
}

/// The paths of an SVG, y up, after a renderer has accepted the whole.
pub fn svg(bytes: &[u8]) -> Svg {
    let text = std::str::from_utf8(bytes).expect("text");
    resvg::usvg::Tree::from_str(text, &resvg::usvg::Options::default()).expect("an SVG");
    let document = resvg::usvg::roxmltree::Document::parse(text).expect("XML");
    let root = document.root_element();
    let view: Vec<&str> = root.attribute("viewBox").expect("a view box").split(' ').collect();
    let length =
        |name: &str| root.attribute(name).and_then(|t| t.strip_suffix("mm")?.parse().ok()).expect("millimetres");
    let groups = document.descendants().filter(|node| node.has_tag_name("g")).map(|group| {
        let marks = group.attributes().filter_map(|a| Some((a.name().strip_prefix("data-")?.to_owned(), a.value())));
        let marks = marks.filter_map(|(name, value)| Some((name, value.parse().ok()?))).collect();
        let paths = group.descendants().filter_map(|node| node.attribute("d"));
        let loops = paths.flat_map(|d| d.split_terminator('Z').map(points).collect::<Vec<_>>()).collect();
        Group { marks, loops }
    });
    Svg { view: numbers(&view), millimetres: [length("width"), length("height")], groups: groups.collect() }
}

/// `M1 2L3 4 5 6`: the points of one closed loop.
fn points(path: &str) -> Vec<[f64; 2]> {
    let (first, others) = path.trim().strip_prefix('M').and_then(|p| p.split_once('L')).expect("M and L");
    let all: Vec<f64> = first.split(' ').chain(others.split(' ')).map(|t| t.parse().expect("a number")).collect();
    all.as_chunks::<2>().0.iter().map(|[x, y]| [*x, -y]).collect()
}

pub struct Field {
    pub size: Vec<usize>,
    pub origin: Vec<f64>,
    pub step: Vec<f64>,
}

/// An NRRD of singles, little-endian, gzip, along the axes of the world.
pub fn nrrd(bytes: &[u8]) -> (Field, Vec<f32>) {
    let at = bytes.windows(2).position(|w| w == b"\n\n").expect("an empty line") + 2;
    let text = std::str::from_utf8(&bytes[..at]).expect("text");
    let (magic, lines) = text.split_once('\n').expect("lines");
    assert_eq!(magic, "NRRD0004");
    let fields: HashMap<&str, &str> = lines.lines().filter_map(|line| line.split_once(": ")).collect();
    assert_eq!([fields["type"], fields["endian"], fields["encoding"]], ["float", "little", "gzip"]);
    assert!(fields["content"].starts_with("gob_"), "what was sampled");
    let vector = |text: &str| -> Vec<f64> {
        text.trim_matches(['(', ')']).split(',').map(|word| word.parse().expect("a number")).collect()
    };
    let size: Vec<usize> = fields["sizes"].split(' ').map(|n| n.parse().expect("a size")).collect();
    let directions: Vec<Vec<f64>> = fields["space directions"].split(' ').map(vector).collect();
    for (axis, direction) in directions.iter().enumerate() {
        assert!(direction.iter().enumerate().all(|(k, &d)| (d != 0.0) == (k == axis)), "{direction:?}");
    }
    let step = directions.iter().enumerate().map(|(axis, direction)| direction[axis]).collect();
    let mut raw = Vec::new();
    flate2::read::GzDecoder::new(&bytes[at..]).read_to_end(&mut raw).expect("gzip");
    assert_eq!(raw.len(), 4 * size.iter().product::<usize>());
    let samples = raw.as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b)).collect();
    (Field { size, origin: vector(fields["space origin"]), step }, samples)
}
