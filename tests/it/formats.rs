//! Each format is read back by a reader that shares no code with the writer, and compared with what was written.

use super::readback::files;
use super::solids::{Ex, shape_of};
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use yont::export::{Part, apng, glb, obj, ply, stl, svg, threemf};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::picture::image::Image;
use yont::surface::{Grid, Mesh, check, extract};
use yont::vm::Demand;

/// A ball of triangles: an octahedron, each triangle split in four `times` over, on the sphere about `centre`.
fn ball(times: usize, radius: f64, centre: [f64; 3]) -> Mesh {
    let mut at = vec![[1., 0., 0.], [-1., 0., 0.], [0., 1., 0.], [0., -1., 0.], [0., 0., 1.], [0., 0., -1.]];
    let mut triangles: Vec<[u32; 3]> =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..times {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let sum: [f64; 3] = std::array::from_fn(|i| at[a as usize][i] + at[b as usize][i]);
                let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
                at.push(sum.map(|x| x / length));
                at.len() as u32 - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let (d, e, f) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
            })
            .collect();
    }
    let positions = at.iter().map(|p| std::array::from_fn(|i| centre[i] + radius * p[i])).collect();
    Mesh { positions, normals: at, triangles }
}

fn single(points: &[[f64; 3]]) -> Vec<[f32; 3]> {
    points.iter().map(|p| p.map(|x| x as f32)).collect()
}

/// One colour for each vertex, with repetitions.
fn colours(mesh: &Mesh) -> Vec<[u8; 3]> {
    (0..mesh.positions.len()).map(|i| [(i % 7 * 40) as u8, (i % 3 * 90) as u8, 255 - (i % 5) as u8]).collect()
}

fn coloured<'a>(name: &'a str, mesh: &'a Mesh, colours: &'a [[u8; 3]]) -> Part<'a> {
    Part { colours: Some(colours), ..Part::of(name, mesh) }
}

#[test]
fn glb_holds_the_mesh() {
    let mesh = ball(3, 2.5, [1., -2., 3.]);
    let colours = colours(&mesh);
    let mut bytes = Vec::new();
    glb::write(&[coloured("gob_ball", &mesh, &colours)], "all", &mut bytes).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let scene = file.default_scene().unwrap();
    let turn = scene.nodes().next().unwrap();
    let node = turn.children().next().unwrap();
    assert_eq!(node.name(), Some("gob_ball"));
    let primitive = node.mesh().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|_| file.blob.as_deref());
    let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
    assert_eq!(positions, single(&mesh.positions));
    assert_eq!(reader.read_normals().unwrap().collect::<Vec<_>>(), single(&mesh.normals));
    let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    assert_eq!(indices, mesh.triangles.concat());
    let bounds = primitive.bounding_box();
    assert_eq!((bounds.min, bounds.max), ([-1.5, -4.5, 0.5], [3.5, 0.5, 5.5]));
    for (linear, srgb) in reader.read_colors(0).unwrap().into_rgb_f32().zip(&colours) {
        for (light, &byte) in linear.into_iter().zip(srgb) {
            let back = if light <= 0.0031308 { light * 12.92 } else { 1.055 * light.powf(1. / 2.4) - 0.055 };
            assert_eq!((back * 255.).round() as u8, byte);
        }
    }
    // The viewer's world: up is +Y, in metres.
    let matrix = turn.transform().matrix();
    let up: [f32; 3] = std::array::from_fn(|i| matrix[2][i] * 1000.);
    assert_eq!(up, [0., 1., 0.]);
    let determinant: f32 = (0..3)
        .map(|i| {
            matrix[0][i]
                * (matrix[1][(i + 1) % 3] * matrix[2][(i + 2) % 3] - matrix[1][(i + 2) % 3] * matrix[2][(i + 1) % 3])
        })
        .sum();
    assert!((determinant * 1e9 - 1.).abs() < 1e-6, "mirrored or stretched: {determinant}");
}

#[test]
fn glb_shows_one_frame_at_a_time() {
    let meshes = [ball(1, 1., [0.; 3]), ball(2, 2., [0.; 3]), ball(0, 3., [0.; 3])];
    let frames: Vec<Vec<Part>> = meshes.iter().map(|mesh| vec![Part::of("gob_a", mesh)]).collect();
    let mut bytes = Vec::new();
    glb::write_animation(&frames, 0.5, "gob_a", &mut bytes).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let animation = file.animations().next().unwrap();
    let mut seen = BTreeMap::new();
    for channel in animation.channels() {
        assert_eq!(channel.sampler().interpolation(), gltf::animation::Interpolation::Step);
        let reader = channel.reader(|_| file.blob.as_deref());
        let times: Vec<f32> = reader.read_inputs().unwrap().collect();
        let gltf::animation::util::ReadOutputs::Scales(scales) = reader.read_outputs().unwrap() else {
            panic!("only scales are keyed")
        };
        let scales: Vec<[f32; 3]> = scales.collect();
        assert_eq!(times.len(), scales.len());
        let node = channel.target().node().index();
        for (moment, at) in [0.1, 0.6, 1.1, 1.4].into_iter().enumerate() {
            let key = times.iter().rposition(|&t| t <= at).unwrap();
            if scales[key] == [1.; 3] {
                seen.entry(moment).or_insert_with(Vec::new).push(node);
            }
        }
    }
    assert_eq!(seen.into_values().collect::<Vec<_>>(), [vec![0], vec![1], vec![2], vec![2]]);
    let shown_at_rest: Vec<_> =
        file.nodes().filter(|n| n.mesh().is_some()).map(|n| n.transform().decomposed().2[0]).collect();
    assert_eq!(shown_at_rest, [1., 0., 0.]);
}

#[test]
fn glb_groups_show_through() {
    let (inner, outer) = (ball(1, 1., [0.; 3]), ball(1, 2., [0.; 3]));
    let glass = Part { tint: [0, 188, 255, 51], ..Part::of("f = 0", &outer) };
    let members = [Part::of("f = 1", &inner), glass, Part { name: "again", ..glass }];
    let mut bytes = Vec::new();
    glb::write(&members, "gob_a", &mut bytes).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let nodes: Vec<_> = file.nodes().filter(|n| n.mesh().is_some()).collect();
    assert_eq!(nodes.iter().map(|n| n.name().unwrap()).collect::<Vec<_>>(), ["f = 1", "f = 0", "again"]);
    let materials: Vec<_> =
        nodes.iter().map(|n| n.mesh().unwrap().primitives().next().unwrap().material().index().unwrap()).collect();
    assert_eq!(materials, [0, 1, 1]);
    let glass = file.materials().nth(1).unwrap();
    assert_eq!((glass.alpha_mode(), glass.double_sided()), (gltf::material::AlphaMode::Blend, true));
    let [r, g, b, a] = glass.pbr_metallic_roughness().base_color_factor();
    assert!(r == 0. && (g - 0.503).abs() < 1e-3 && b == 1. && a == 0.2, "{r} {g} {b} {a}");
    assert_eq!(file.materials().next().unwrap().alpha_mode(), gltf::material::AlphaMode::Opaque);
}

#[test]
fn threemf_holds_the_mesh_its_colours_and_a_thumbnail() {
    let mesh = ball(3, 2.5, [1., -2., 3.]);
    let colours = colours(&mesh);
    let mut picture = Vec::new();
    apng::write(&[Image::new(16, 16, [9, 8, 7])], 1., &mut picture).expect("a picture");
    let mut bytes = Vec::new();
    let name = "a <b> & \"c\"";
    threemf::write(&[coloured(name, &mesh, &colours)], Some(&picture), name, &mut bytes).unwrap();

    let package =
        threemf2::package::ThreemfPackage::from_reader_with_memory_optimized_deserializer(Cursor::new(&bytes), true)
            .unwrap();
    let model = &package.root;
    assert_eq!(model.unit, Some(threemf2::model::domain::model::Unit::Millimeter));
    let object = &model.resources.object[0];
    let read = object.get_mesh().unwrap();
    let positions: Vec<[f32; 3]> =
        read.vertices.vertex.iter().map(|v| [v.x.value(), v.y.value(), v.z.value()].map(|x| x as f32)).collect();
    assert_eq!(positions, single(&mesh.positions));
    let triangles: Vec<[u32; 3]> = read.triangles.triangle.iter().map(|t| [t.v1, t.v2, t.v3]).collect();
    assert_eq!(triangles, mesh.triangles);
    assert_eq!(package.thumbnails.values().next().unwrap().data, picture);

    // The colours, by a reader that knows XML alone.
    let mut text = String::new();
    zip::ZipArchive::new(Cursor::new(&bytes))
        .unwrap()
        .by_name("3D/3dmodel.model")
        .unwrap()
        .read_to_string(&mut text)
        .unwrap();
    let document = resvg::usvg::roxmltree::Document::parse(&text).unwrap();
    let list: Vec<&str> = document.descendants().filter_map(|n| n.attribute("color")).collect();
    let all = document.descendants().filter(|n| n.has_tag_name("triangle"));
    for (element, corners) in all.zip(&mesh.triangles) {
        for (p, &corner) in ["p1", "p2", "p3"].iter().zip(corners) {
            let number: usize = element.attribute(*p).unwrap().parse().unwrap();
            let [r, g, b] = colours[corner as usize];
            assert_eq!(list[number], format!("#{r:02X}{g:02X}{b:02X}"));
        }
    }
    let title = document.descendants().find(|n| n.attribute("name") == Some("Title")).unwrap();
    assert_eq!(title.text(), Some("a <b> & \"c\""));
}

/// A regular polygon, counter-clockwise.
fn polygon(corners: usize, radius: f64, centre: [f64; 2]) -> Vec<[f64; 2]> {
    let angle = |i: usize| i as f64 / corners as f64 * std::f64::consts::TAU;
    (0..corners).map(|i| [centre[0] + radius * angle(i).cos(), centre[1] + radius * angle(i).sin()]).collect()
}

#[test]
fn svg_draws_rings_with_their_holes_the_right_way_up() {
    let ring = svg::Slice {
        marks: vec![("x3".into(), 0.25)],
        loops: vec![polygon(90, 1., [0., 1.]), polygon(90, 0.5, [0., 1.])],
        colour: Some([255, 0, 0]),
    };
    let empty = svg::Slice { marks: vec![("x3".into(), 9.)], ..Default::default() };
    let mut bytes = Vec::new();
    svg::write(&[ring, empty], [-2., -2.], [2., 2.], "gob_ring", &mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let document = resvg::usvg::roxmltree::Document::parse(&text).unwrap();
    let heights: Vec<_> = document.descendants().filter_map(|n| n.attribute("data-x3")).collect();
    assert_eq!(heights, ["0.25", "9"]);
    assert_eq!(document.root_element().attribute("viewBox"), Some("-2 -2 4 4"));
    assert_eq!(document.root_element().attribute("width"), Some("4mm"));

    let tree = resvg::usvg::Tree::from_str(&text, &resvg::usvg::Options::default()).unwrap();
    let mut pixmap = resvg::tiny_skia::Pixmap::new(400, 400).unwrap();
    let scale = 400. / tree.size().width();
    resvg::render(&tree, resvg::tiny_skia::Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    let red = |x: f64, y: f64| {
        let pixel = pixmap.pixel((100. * (x + 2.)) as u32, (100. * (2. - y)) as u32).unwrap();
        (pixel.red(), pixel.alpha()) == (255, 255)
    };
    assert!(red(0.75, 1.) && red(0., 1.75) && red(-0.75, 1.), "the ring");
    assert!(!red(0., 1.) && !red(0., -1.) && !red(1.5, 1.), "its hole and its surroundings");
    let area = pixmap.pixels().iter().filter(|p| p.red() > 128).count() as f64 / 1e4;
    assert!((area - 0.75 * std::f64::consts::PI).abs() < 0.06, "{area}");
}

#[test]
fn apng_holds_each_frame_and_its_time() {
    let frames: Vec<Image> = (0..4)
        .map(|k| {
            let mut image = Image::new(31, 17, [k as u8 * 60, 10, 20]);
            image.set(k, k, [255, 255, 255]);
            image
        })
        .collect();
    for delay in [0.1, 0.08, 1. / 24., 1. / 30., 1e-3, 100., 60000.] {
        let mut bytes = Vec::new();
        apng::write(&frames, delay, &mut bytes).unwrap();
        let mut reader = png::Decoder::new(Cursor::new(&bytes)).read_info().unwrap();
        assert_eq!(reader.info().animation_control().unwrap().num_frames, 4);
        let mut buffer = vec![0; reader.output_buffer_size().unwrap()];
        for frame in &frames {
            reader.next_frame(&mut buffer).unwrap();
            assert!(buffer == frame.rgba, "the pixels of a frame");
            let control = reader.info().frame_control().unwrap();
            let got = f64::from(control.delay_num) / f64::from(control.delay_den);
            assert!((got - delay).abs() < 1e-12, "{delay}: {control:?}");
        }
    }
}

/// The mesh of a torus, as it is extracted for export.
fn torus() -> Mesh {
    let ring = |x: Ex, y: Ex, z: Ex| 0.16 - ((x.squared() + y.squared()).sqrt() - 1.).squared() - z.squared();
    let grid = Grid::new(&[[-1.5, 1.5]; 3], 40).expect("a grid");
    extract(&shape_of(ring, 3, Demand::Sign), &grid, &Limits::default(), &Interrupt::default()).expect("a surface").mesh
}

/// The volume inside, by tetrahedra about the origin.
fn volume(mesh: &Mesh) -> f64 {
    let triple = |[a, b, c]: [[f64; 3]; 3]| {
        (0..3).map(|i| a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3])).sum::<f64>() / 6.
    };
    mesh.triangles.iter().map(|t| triple(t.map(|v| mesh.positions[v as usize]))).sum()
}

#[test]
fn meshes_read_back_are_closed_and_measure_the_same() {
    let mesh = torus();
    let wanted = volume(&mesh);
    let mut bytes = Vec::new();
    glb::write(&[Part::of("a", &mesh)], "a", &mut bytes).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let reader = file.meshes().next().unwrap().primitives().next().unwrap();
    let reader = reader.reader(|_| file.blob.as_deref());
    let positions = reader.read_positions().unwrap().map(|p| p.map(f64::from)).collect();
    let corners: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    let normals = mesh.normals.clone();
    let from_glb = Mesh { positions, normals: normals.clone(), triangles: corners.as_chunks::<3>().0.to_vec() };

    let mut bytes = Vec::new();
    threemf::write(&[Part::of("a", &mesh)], None, "a", &mut bytes).unwrap();
    let package =
        threemf2::package::ThreemfPackage::from_reader_with_memory_optimized_deserializer(Cursor::new(&bytes), true)
            .unwrap();
    let read = package.root.resources.object[0].get_mesh().unwrap();
    let positions = read.vertices.vertex.iter().map(|v| [v.x.value(), v.y.value(), v.z.value()]).collect();
    let triangles = read.triangles.triangle.iter().map(|t| [t.v1, t.v2, t.v3]).collect();
    let from_3mf = Mesh { positions, normals, triangles };
    for (name, mesh) in [("GLB", from_glb), ("3MF", from_3mf)] {
        let topology = check(&mesh).unwrap_or_else(|fault| panic!("{name}: {fault:?}"));
        assert_eq!((topology.euler, topology.components), (0, 1), "{name}");
        let got = volume(&mesh);
        assert!((got / wanted - 1.).abs() < 1e-6, "{name}: {got} for {wanted}");
    }
}

#[test]
fn an_apng_has_as_many_frames_as_it_said() {
    let image = Image::new(4, 4, [1, 2, 3]);
    let mut encoder = apng::Encoder::new(Vec::new(), 4, 4, 3, 0.1).unwrap();
    encoder.frame(&image).unwrap();
    assert!(encoder.frame(&Image::new(4, 5, [0; 3])).is_err(), "another size");
    encoder.frame(&image).unwrap();
    assert!(encoder.finish().is_err(), "too few");
    let mut encoder = apng::Encoder::new(Vec::new(), 4, 4, 1, 0.1).unwrap();
    encoder.frame(&image).unwrap();
    assert!(encoder.frame(&image).is_err(), "too many");
}

#[test]
fn writing_twice_gives_the_same_bytes() {
    let mesh = ball(2, 1., [0.; 3]);
    let colours = colours(&mesh);
    let part = coloured("a", &mesh, &colours);
    let all = || {
        let mut bytes: [Vec<u8>; 6] = Default::default();
        glb::write(&[part], "a", &mut bytes[0]).unwrap();
        threemf::write(&[part], Some(b"png"), "a", &mut bytes[1]).unwrap();
        apng::write(&vec![Image::new(8, 8, [1, 2, 3]); 2], 9., &mut bytes[2]).unwrap();
        obj::write(&[part], &mut bytes[3]).unwrap();
        ply::write(&part, &mut bytes[4]).unwrap();
        stl::write(&part, &mut bytes[5]).unwrap();
        bytes
    };
    assert_eq!(all(), all());
}

/// A writer that fails after some bytes, as a full disk does.
struct Full(usize);

impl std::io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if self.0 == 0 {
            return Err(std::io::ErrorKind::StorageFull.into());
        }
        let taken = bytes.len().min(self.0);
        self.0 -= taken;
        Ok(taken)
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_strikes() {
    let mesh = ball(3, 1., [0.; 3]);
    let part = Part::of("a", &mesh);
    let slice = svg::Slice { loops: vec![polygon(50, 1., [0.; 2])], ..Default::default() };
    let full = |result: std::io::Result<()>, what: &str, room: usize| {
        let kind = result.map_err(|error| error.kind());
        assert_eq!(kind, Err(std::io::ErrorKind::StorageFull), "{what}, {room} bytes");
    };
    for room in [0, 1, 11, 40, 300, 1000] {
        full(glb::write(&[part], "a", &mut Full(room)), "GLB", room);
        full(threemf::write(&[part], None, "a", &mut Full(room)), "3MF", room);
        full(obj::write(&[part], &mut Full(room)), "OBJ", room);
        full(ply::write(&part, &mut Full(room)), "PLY", room);
        full(stl::write(&part, &mut Full(room)), "STL", room);
        full(svg::write(std::slice::from_ref(&slice), [-1.; 2], [1.; 2], "a", &mut Full(room)), "SVG", room);
    }
    for room in [0, 1, 40, 90] {
        full(apng::write(&vec![Image::new(8, 8, [0; 3]); 2], 1., &mut Full(room)), "APNG", room);
    }
}

/// Every format of meshes refuses the parts; those that hold one, the last of them.
fn refused(parts: &[Part], bytes: &mut Vec<u8>) {
    assert!(glb::write(parts, "a", bytes).is_err());
    assert!(threemf::write(parts, None, "a", bytes).is_err());
    assert!(obj::write(parts, bytes).is_err());
    let last = parts.last().expect("a part");
    assert!(ply::write(last, bytes).is_err() && stl::write(last, bytes).is_err());
}

#[test]
fn what_a_format_cannot_hold_is_refused_before_a_byte_is_written() {
    let good = ball(1, 1., [0.; 3]);
    let bad = [
        Mesh::default(),
        Mesh { triangles: vec![[0, 1, 99]], ..good.clone() },
        Mesh { normals: vec![[0., 0., 1.]], ..good.clone() },
        Mesh { positions: vec![[1e300, 0., 0.]; good.positions.len()], ..good.clone() },
    ];
    for mesh in &bad {
        let mut bytes = Vec::new();
        refused(&[Part::of("a", mesh)], &mut bytes);
        refused(&[Part::of("a", &good), Part::of("b", mesh)], &mut bytes);
        assert!(bytes.is_empty());
    }
    let mut bytes = Vec::new();
    refused(&[coloured("a", &good, &[[0; 3]])], &mut bytes);
    assert!(glb::write(&[], "a", &mut bytes).is_err() && obj::write(&[], &mut bytes).is_err(), "no mesh");
    assert!(threemf::write(&[], None, "a", &mut bytes).is_err(), "no mesh");
    assert!(svg::write(&[svg::Slice::default()], [0.; 2], [1.; 2], "a", &mut bytes).is_err(), "no outline");
    let wild = svg::Slice { loops: vec![vec![[f64::NAN, 0.], [1., 1.]]], ..Default::default() };
    assert!(svg::write(&[wild], [0.; 2], [1.; 2], "a", &mut bytes).is_err(), "not finite");
    assert!(apng::write(&[], 1., &mut bytes).is_err(), "no frame");
    let two = [Image::new(2, 2, [0; 3]), Image::new(2, 3, [0; 3])];
    assert!(apng::write(&two, 1., &mut bytes).is_err(), "two sizes");
    assert!(apng::write(&vec![two[0].clone(); 2], 0., &mut bytes).is_err(), "no time");
    assert!(bytes.is_empty());
}

#[test]
fn several_objects_keep_their_names_and_colours() {
    let (one, two) = (ball(2, 1., [0.; 3]), ball(1, 0.5, [3., 0., 0.]));
    let (red, many) = (vec![[255, 0, 0]; one.positions.len()], colours(&two));
    let parts = [coloured("gob_a", &one, &red), coloured("gob b", &two, &many), Part::of("gob_c", &one)];
    let mut bytes: [Vec<u8>; 3] = Default::default();
    obj::write(&parts, &mut bytes[0]).unwrap();
    glb::write(&parts, "all", &mut bytes[1]).unwrap();
    threemf::write(&parts, Some(&thumbnail()), "all", &mut bytes[2]).unwrap();
    let read = [files::obj(&bytes[0]), files::glb(&bytes[1]), files::threemf(&bytes[2])];
    for (read, second) in read.iter().zip(["gob_b", "gob b", "gob b"]) {
        let names: Vec<&str> = read.meshes.iter().map(|mesh| mesh.0.as_str()).collect();
        assert_eq!(names, ["gob_a", second, "gob_c"]);
        for (n, part) in parts.iter().enumerate() {
            let mesh = &read.meshes[n].1;
            assert_eq!(single(&mesh.positions), single(&part.mesh.positions), "{second}: part {n}");
            assert_eq!(mesh.triangles, part.mesh.triangles, "{second}: part {n}");
            assert_eq!(read.colours[n], part.colours.unwrap_or_default(), "{second}: part {n}");
        }
    }
}

fn thumbnail() -> Vec<u8> {
    let mut picture = Vec::new();
    apng::write(&[Image::new(256, 256, [9, 8, 7])], 1., &mut picture).expect("a picture");
    picture
}
