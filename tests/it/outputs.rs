//! What geometric types and options make of an object, through a session: each output is read back and compared with what it must show.

use std::io::{Cursor, Read};
use std::path::Path;
use std::sync::Arc;

use yont::diagnostic::Diagnostic;
use yont::field::Coordinate;
use yont::host::{Host, Memory};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{self, Cells, FORMATS, Kind, Options, Output, Sequence};
use yont::picture::Image;
use yont::picture::axes::INK;
use yont::picture::legend::member_colour;
use yont::syntax::Mode;

use crate::session::messages;

const SPACE: &str = "x1min=-2;x1max=2;x2min=-2;x2max=2;x3min=-2;x3max=2;";
const PLANE: &str = "x1min=-2;x1max=2;x2min=-2;x2max=2; x1 : X; x2 : Y;";
const BALL: &str = "gob_a = 1 - x1**2 - x2**2 - x3**2;";
/// A ball whose radius is 1 + x4.
const GROWING: &str = "gob_a = (1 + x4)**2 - x1**2 - x2**2 - x3**2; x4min = 0; x4max = 0.5; x4_delta = 0.25;";
/// A disc whose radius is x5.
const DISC: &str = "gob_a = x5**2 - x1**2 - x2**2;";

pub type Made = Result<(Vec<Vec<u8>>, Vec<Diagnostic>), Vec<Diagnostic>>;

/// What `-o` writes of a script's last object.
pub fn make(script: &[&str], to: &str, set: impl FnOnce(&mut Options)) -> Made {
    let host = Arc::new(Memory::default());
    let mut session = Session::new(host.clone(), Limits::default(), Interrupt::default());
    let outcome = session.input("script.geo", &script.concat(), Mode::Script);
    assert!(outcome.accepted, "{script:?}: {}", messages(&outcome));
    let mut options = Options::default();
    options.view.cells = Cells::Along(24);
    set(&mut options);
    let output = Output::parse(to, None).expect("an output");
    let written = request::write(&mut session, &output, &options, &mut Vec::new())?;
    let read = |file: &std::path::PathBuf| host.read(Path::new(file), usize::MAX).expect("it was written");
    Ok((written.files.iter().map(read).collect(), written.notes))
}

fn files(script: &[&str], to: &str, set: impl FnOnce(&mut Options)) -> Vec<Vec<u8>> {
    make(script, to, set).unwrap_or_else(|told| panic!("{script:?} -o {to}: {told:?}")).0
}

pub fn one(script: &[&str], to: &str, set: impl FnOnce(&mut Options)) -> Vec<u8> {
    let mut all = files(script, to, set);
    assert_eq!(all.len(), 1);
    all.swap_remove(0)
}

/// The frames of a PNG or APNG.
pub fn frames(bytes: &[u8]) -> Vec<Image> {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().expect("a PNG");
    let count = reader.info().animation_control().map_or(1, |control| control.num_frames);
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let channels = reader.info().color_type.samples();
    (0..count)
        .map(|_| {
            let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
            reader.next_frame(&mut pixels).expect("a frame");
            let rgba = match channels {
                4 => pixels,
                _ => pixels.chunks_exact(channels).flat_map(|p| [p[0], p[1], p[2], 255]).collect(),
            };
            Image { width, height, rgba }
        })
        .collect()
}

pub fn picture(script: &[&str], set: impl FnOnce(&mut Options)) -> Image {
    frames(&one(script, "a.png", set)).swap_remove(0)
}

pub fn sized(width: usize, height: usize) -> impl FnOnce(&mut Options) {
    move |options| options.picture.size = Some((width, height))
}

/// Pixels of exactly that colour.
fn count(image: &Image, colour: [u8; 4]) -> usize {
    image.rgba.as_chunks::<4>().0.iter().filter(|p| **p == colour).count()
}

/// The meshes of a GLB by the names of their nodes, as radii of their vertices about the origin: the least and the greatest.
fn radii(bytes: &[u8]) -> Vec<(String, f32, f32)> {
    let file = gltf::Gltf::from_slice(bytes).expect("a GLB");
    let with_mesh = file.nodes().filter(|node| node.mesh().is_some());
    with_mesh
        .map(|node| {
            let primitive = node.mesh().and_then(|mesh| mesh.primitives().next()).expect("a primitive");
            let reader = primitive.reader(|_| file.blob.as_deref());
            let radius = |p: [f32; 3]| p.iter().map(|x| x * x).sum::<f32>().sqrt();
            let all: Vec<f32> = reader.read_positions().expect("positions").map(radius).collect();
            let (lo, hi) = all.iter().fold((f32::MAX, 0.0_f32), |(lo, hi), &r| (lo.min(r), hi.max(r)));
            (node.name().unwrap_or_default().to_owned(), lo, hi)
        })
        .collect()
}

fn assert_radii(found: &[(String, f32, f32)], expected: &[(&str, f32)]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((name, lo, hi), (wanted, radius)) in found.iter().zip(expected) {
        assert_eq!(name, wanted);
        assert!((lo - radius).abs() < 0.02 && (hi - radius).abs() < 0.02, "{name}: {lo} to {hi}, not {radius}");
    }
}

#[test]
fn a_glb_moves_over_time_and_its_frames_are_the_numbered_files() {
    let bytes = one(&[GROWING, SPACE], "a.glb", |_| {});
    assert_radii(&radii(&bytes), &[("gob_a-000", 1.0), ("gob_a-001", 1.25), ("gob_a-002", 1.5)]);
    assert_eq!(gltf::Gltf::from_slice(&bytes).expect("a GLB").animations().count(), 1);
    let each = files(&[GROWING, SPACE], "a{n}.glb", |_| {});
    let all: Vec<_> = each.iter().flat_map(|file| radii(file)).collect();
    assert_radii(&all, &[("gob_a", 1.0), ("gob_a", 1.25), ("gob_a", 1.5)]);
    assert_radii(&radii(&one(&[BALL, SPACE], "a.glb", |_| {})), &[("gob_a", 1.0)]);
}

#[test]
fn a_glb_holds_sections_and_levels_as_a_group() {
    let levels = one(&[BALL, SPACE, "gob_a : G = [0.75, 0, -1.25];"], "a.glb", |_| {});
    assert_radii(&radii(&levels), &[("\u{2212}1.25", 1.5), ("0", 1.0), ("0.75", 0.5)]);
    let sections = one(&[GROWING, SPACE, "x4 : G = [0.5, 0];"], "a.glb", |_| {});
    assert_radii(&radii(&sections), &[("x4 = 0.5", 1.5), ("x4 = 0", 1.0)]);
    let (_, notes) = make(&[BALL, SPACE, "gob_a : G = [0, 5];"], "a.glb", |_| {}).expect("one of the two is there");
    assert!(notes.iter().any(|note| note.code == "empty-section" && note.title.contains('5')), "{notes:?}");
}

#[test]
fn a_3mf_holds_the_mesh_and_a_picture_of_it() {
    let bytes = one(&[BALL, SPACE], "a.3mf", |_| {});
    let package =
        threemf2::package::ThreemfPackage::from_reader_with_memory_optimized_deserializer(Cursor::new(&bytes), true)
            .expect("a package");
    let mesh = package.root.resources.object[0].get_mesh().expect("a mesh");
    let radius = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let vertices: Vec<f64> =
        mesh.vertices.vertex.iter().map(|v| radius([v.x.value(), v.y.value(), v.z.value()].map(Into::into))).collect();
    assert!(vertices.len() > 200 && vertices.iter().all(|r| (r - 1.0).abs() < 0.01), "{vertices:?}");
    let thumbnail = frames(&package.thumbnails.values().next().expect("a thumbnail").data).swap_remove(0);
    assert_eq!([thumbnail.width, thumbnail.height], [256, 256]);
    assert_ne!(thumbnail.pixel(128, 128), thumbnail.pixel(2, 128), "the ball stands out from its ground");
    assert_eq!(files(&[GROWING, SPACE], "a{n}.3mf", |_| {}).len(), 3);
}

/// The groups of an SVG: the attribute that marks each, and the area of its paths by a renderer, in units of the model.
fn areas(bytes: &[u8], mark: &str) -> Vec<(f64, usize)> {
    let text = std::str::from_utf8(bytes).expect("text");
    let document = resvg::usvg::roxmltree::Document::parse(text).expect("XML");
    let groups = document.descendants().filter(|node| node.has_tag_name("g"));
    groups
        .map(|group| {
            let value = group.attribute(mark).map_or(f64::NAN, |text| text.parse().expect("a number"));
            let loops = group.descendants().filter_map(|n| n.attribute("d")).map(|d| d.matches('M').count()).sum();
            (value, loops)
        })
        .collect()
}

/// The part of the picture of an SVG that is painted.
fn painted(bytes: &[u8]) -> f64 {
    let text = std::str::from_utf8(bytes).expect("text");
    let tree = resvg::usvg::Tree::from_str(text, &resvg::usvg::Options::default()).expect("an SVG");
    let mut pixmap = resvg::tiny_skia::Pixmap::new(200, 200).expect("memory");
    let scale = 200.0 / tree.size().width();
    resvg::render(&tree, resvg::tiny_skia::Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    pixmap.pixels().iter().map(|p| f64::from(p.alpha()) / 255.0).sum::<f64>() / 4e4
}

#[test]
fn an_svg_holds_outlines_sections_levels_and_slices() {
    let disc = one(&[DISC, PLANE, "x5 : CONSTANT = 1;"], "a.svg", |_| {});
    assert!((painted(&disc) * 16.0 - std::f64::consts::PI).abs() < 0.1, "{}", painted(&disc));
    let sections = one(&[DISC, PLANE, "x5 : G = [0.5, 1, 1.5];"], "a.svg", |_| {});
    assert_eq!(areas(&sections, "data-x5"), [(0.5, 1), (1.0, 1), (1.5, 1)]);
    let levels = one(&[DISC, PLANE, "x5 : CONSTANT = 1; gob_a : G = [0.75, -1.25];"], "a.svg", |_| {});
    assert_eq!(areas(&levels, "data-level"), [(-1.25, 1), (0.75, 1)]);
    assert!((painted(&levels) * 16.0 - 2.25 * std::f64::consts::PI).abs() < 0.2, "the lowest is the largest");
    let slices = one(&[BALL, SPACE], "a.svg", |options| {
        options.slices = Some(Sequence { coordinate: Coordinate(3), values: vec![-1.5, -0.5, 0.0, 0.5, 1.5] });
    });
    assert_eq!(areas(&slices, "data-x3"), [(-1.5, 0), (-0.5, 1), (0.0, 1), (0.5, 1), (1.5, 0)]);
    assert_eq!(files(&[GROWING, SPACE, "x3 : CONSTANT = 0;"], "a{n}.svg", |_| {}).len(), 3);
}

#[test]
fn an_apng_shows_what_the_numbered_pictures_show() {
    let moving = frames(&one(&[GROWING, SPACE], "a.apng", sized(40, 30)));
    let single = files(&[GROWING, SPACE], "a{n}.png", sized(40, 30));
    assert_eq!((moving.len(), single.len()), (3, 3));
    for (n, (a, b)) in moving.iter().zip(&single).enumerate() {
        assert!(*a == frames(b)[0], "frame {n}");
    }
    assert!(moving[0] != moving[2], "it moves");
}

#[test]
fn one_axis_makes_a_graph_with_the_segment_marked() {
    let image = picture(&["gob_a = (x1 - 1) & (3 - x1); x1min = 0; x1max = 4;"], sized(400, 300));
    assert_eq!([image.width, image.height], [400, 300]);
    // The segment from 1 to 3 is half of the axis: a red line, between a quarter and three quarters of the plot's width.
    let red = |i: &usize| (0..300).any(|j| image.pixel(*i, j) == [214, 69, 45, 255]);
    let columns: Vec<usize> = (0..400).filter(red).collect();
    let width = columns[columns.len() - 1] - columns[0];
    assert!((150..200).contains(&width), "{width}");
    let group = picture(&["gob_a = x2*x1; x1min = -1; x1max = 1; x2 : G = [1, 2, 3];"], sized(400, 300));
    for k in 0..5 {
        assert_eq!(count(&group, member_colour(k)) > 50, k < 3, "curve {k}");
    }
}

#[test]
fn graphs_of_all_frames_share_one_range_of_values() {
    let script = "gob_a = x4*(1 - x1**2); x1min = -1; x1max = 1; x4min = 1; x4max = 2; x4_delta = 1;";
    let pictures: Vec<Image> =
        files(&[script], "a{n}.png", sized(300, 300)).iter().map(|f| frames(f).swap_remove(0)).collect();
    let top = |image: &Image| {
        (0..300).find(|&j| (0..300).any(|i| image.pixel(i, j) == [31, 119, 180, 255])).expect("a curve") as f64
    };
    let zero = (0..300).rev().find(|&j| (0..300).any(|i| pictures[0].pixel(i, j) == [214, 69, 45, 255]));
    let zero = zero.expect("a segment") as f64;
    let ratio = (zero - top(&pictures[1])) / (zero - top(&pictures[0]));
    assert!((ratio - 2.0).abs() < 0.1, "twice as high: {ratio}");
}

#[test]
fn levels_and_sections_of_the_plane_make_maps() {
    let map = picture(&["gob_a = x1; gob_a : G = [-1, 0, 1];", PLANE], sized(320, 240));
    assert_eq!([map.width, map.height], [320, 240]);
    assert!(count(&map, INK) > 100, "lines and letters");
    let filled = picture(&["gob_a = x1; gob_a : G = [-1, 0, 1];", PLANE], |options| {
        options.picture.size = Some((320, 240));
        options.picture.palette = "diverging".into();
    });
    let (cold, warm) = (filled.pixel(90, 120), filled.pixel(190, 120));
    assert!(cold[2] > cold[0] && warm[0] > warm[2], "{cold:?} {warm:?}");
    let sections = picture(&[DISC, PLANE, "x5 : G = [0.5, 1];"], sized(320, 240));
    assert_eq!([0, 1, 2].map(|k| count(&sections, member_colour(k)) > 50), [true, true, false]);
    let colours = picture(&[DISC, PLANE, "x5 : C; x5min = 0.5; x5max = 1.5; x5_delta = 0.5;"], sized(320, 240));
    // The ends of the spectrum are drawn: as outlines and in the legend.
    for end in [[0x5e, 0x2a, 0xa8, 255], [0xdc, 0x2f, 0x20, 255]] {
        assert!(count(&colours, end) > 20, "{end:?}");
    }
}

#[test]
fn columns_and_rows_make_a_sheet() {
    let types = "x5 : V; x5min = 0.5; x5max = 1.5; x5_delta = 0.5;";
    let cell = |at: f64| {
        picture(&[DISC, PLANE, types], |options| {
            options.picture.size = Some((60, 40));
            options.view.at = vec![(Coordinate(5), at)];
        })
    };
    let sheet = picture(&[DISC, PLANE, types], sized(60, 40));
    assert!(sheet.width > 180 && sheet.height > 40 && sheet.height < 120, "{} x {}", sheet.width, sheet.height);
    let holds = |image: &Image| {
        let inner =
            |i: usize, j: usize| (1..39).all(|y| (1..59).all(|x| sheet.pixel(i + x, j + y) == image.pixel(x, y)));
        (0..=sheet.height - 40).find_map(|j| (0..=sheet.width - 60).find(|&i| inner(i, j)).map(|i| [i, j]))
    };
    let places = [0.5, 1.0, 1.5].map(|at| holds(&cell(at)).unwrap_or_else(|| panic!("x5 = {at} is not in the sheet")));
    assert!(places[0][0] < places[1][0] && places[1][0] < places[2][0], "from left to right: {places:?}");
    let both = "gob_a = x5**2 - x1**2 - (x2 - x6)**2; x6 : W; x6min = 0; x6max = 1; x6_delta = 0.5;";
    let table = picture(&[both, PLANE, types], sized(60, 40));
    assert!(table.width > 180 && table.height > 120, "{} x {}", table.width, table.height);
    let mesh = make(&[both, SPACE, types], "a.stl", |_| {}).expect_err("a mesh has no columns");
    assert!(mesh[0].code == "type-not-shown" && mesh[0].title.contains("type V"), "{mesh:?}");
}

#[test]
fn any_coordinate_may_be_space_or_time() {
    let script = "gob_a = x9**2 - x12**2 - x7**2 - x2**2; x12 : X; x7 : Y; x2 : Z; x9 : T;
        x12min=-2;x12max=2;x7min=-2;x7max=2;x2min=-2;x2max=2; x9min=0.5;x9max=1.5;x9_delta=-1;";
    assert_radii(&radii(&one(&[script], "a.glb", |_| {})), &[("gob_a-000", 1.5), ("gob_a-001", 0.5)]);
}

#[test]
fn levels_of_a_solid_show_through_each_other() {
    let both = picture(&[BALL, SPACE, "gob_a : G = [-1.25, 0.75];"], sized(80, 80));
    assert!(both.width > 80 && both.height == 80, "a legend at its right: {}", both.width);
    // Red is within, violet without, light the ground.
    let [within, without, ground] = [[40, 40], [60, 40], [1, 40]].map(|[i, j]| both.pixel(i, j).map(i32::from));
    let warmth = |p: [i32; 4]| p[0] - p[2];
    assert!(warmth(within) > warmth(without) + 20, "the inner one is seen: {within:?} {without:?}");
    assert!(
        warmth(without) < warmth(ground) && ground[1] > without[1] + 20,
        "the outer one too: {without:?} {ground:?}"
    );
    let groups = picture(&[GROWING, SPACE, "x4 : G = [0, 0.5];"], sized(80, 80));
    assert!(groups.width > 80, "a list of the sections at its right");
    let both = picture(&[GROWING, SPACE, "x4 : G = [0, 0.5]; gob_a : G = [0, 0.5];"], sized(80, 80));
    assert!(both.width > groups.width, "with the levels in it");
}

#[test]
fn axes_stand_around_a_picture_and_leave_it_as_it_is() {
    for script in [[DISC, PLANE, "x5 : CONSTANT = 1;"], [BALL, SPACE, ""]] {
        let plain = picture(&script, sized(120, 90));
        assert_eq!([plain.width, plain.height], [120, 90]);
        let axes = picture(&script, |options| {
            options.picture.size = Some((120, 90));
            options.picture.axes = true;
        });
        assert!(axes.width > 120 && axes.height > 90, "{} x {}", axes.width, axes.height);
        // Beside the picture's own colours there is the ink of numbers, on paper: greys that are dark, and white in the corner.
        let grey = |p: &&[u8; 4]| p[0] < 160 && p[0] == p[1] && p[1] == p[2];
        let [numbers, before] = [&axes, &plain].map(|image| image.rgba.as_chunks::<4>().0.iter().filter(grey).count());
        assert!(numbers > before + 50, "{before} dark grey pixels, and {numbers}");
        assert_eq!(axes.pixel(axes.width - 1, 0), [255; 4]);
    }
}

#[test]
fn what_cannot_be_shown_is_said_in_words() {
    let cases: &[(&[&str], &str, &str)] = &[
        (&[BALL, SPACE], "a.svg", "--slices x3="),
        (&[DISC, PLANE, "x5 : V;"], "a.png", "x5min"),
        (&[BALL, SPACE, "gob_a : G = [5, 6];"], "a.png", "levels 5, 6"),
        (&[BALL, SPACE, "gob_a : G = [0, 0.5];"], "a.stl", "CONSTANT"),
        (&["gob_a = x1;", "x1min=0;x1max=1;"], "a.svg", "needs 2 axes"),
    ];
    for (script, to, words) in cases {
        let told = make(script, to, |_| {}).expect_err(to);
        let text = format!("{told:?}");
        assert!(text.contains(words), "{script:?} -o {to}: {text} does not say {words}");
    }
}

#[test]
fn every_format_gives_the_same_bytes_with_any_number_of_threads() {
    for (_, extension, ..) in FORMATS {
        let is_plane = FORMATS.iter().any(|format| format.1 == *extension && format.3 == Kind::Outlines);
        let script: [&str; 2] = if is_plane { ["gob_a = 1 - x1**2 - x2**2;", PLANE] } else { [GROWING, SPACE] };
        let bytes = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            pool.install(|| one(&script, &format!("a.{extension}"), sized(32, 24)))
        };
        assert!(bytes(1) == bytes(3), ".{extension}");
    }
}

#[test]
fn a_packed_file_names_its_object() {
    let bytes = one(&[BALL, SPACE], "a.3mf", |_| {});
    let mut text = String::new();
    let mut package = zip::ZipArchive::new(Cursor::new(bytes)).expect("a package");
    package.by_name("3D/3dmodel.model").expect("the model").read_to_string(&mut text).expect("text");
    assert!(text.contains("gob_a"));
}
