//! MESH: values, bounds and gradients against plain loops over the triangles, volumes of meshes made again, broken files of every kind.

use std::f64::consts::TAU;
use std::sync::Arc;

use yont::data::Context;
use yont::data::mesh::{self, MeshError, Noted, Solid};
use yont::data::obj::{self, Surface};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::{Interval, Leaf};

use crate::cli::{folder, run};
use crate::conformance::Random;

type V = [f64; 3];

fn decode(name: &str, bytes: &[u8]) -> Result<(Arc<Solid>, Noted), MeshError> {
    let limits = Limits { memory_bytes: 64 << 20, ..Limits::default() };
    mesh::decode(name, bytes, Context { limits: &limits, interrupt: &Interrupt::default() })
}

fn solid(surface: &Surface) -> (Arc<Solid>, Noted) {
    let context = Context { limits: &Limits::default(), interrupt: &Interrupt::default() };
    mesh::solid("test", surface.clone(), context).unwrap_or_else(|why| panic!("{why}"))
}

/// A closed torus of `n` by `m` quads, bent by noise, so that it is not convex and no two triangles are alike.
fn torus(random: &mut Random, n: u32, m: u32, [at, size]: [f64; 2]) -> Surface {
    let mut surface = Surface::default();
    for i in 0..n {
        for j in 0..m {
            let (a, b) = (TAU * f64::from(i) / f64::from(n), TAU * f64::from(j) / f64::from(m));
            let (r, big) = (0.3 + random.between(-0.02, 0.02), 1.0 + random.between(-0.05, 0.05));
            let p = [(big + r * b.cos()) * a.cos(), (big + r * b.cos()) * a.sin(), r * b.sin()];
            surface.positions.push(p.map(|c| at + size * c));
            let v = |i: u32, j: u32| (i % n) * m + j % m;
            let quad = [v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)];
            surface.triangles.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
        }
    }
    surface
}

fn sub(a: V, b: V) -> V {
    [0, 1, 2].map(|k| a[k] - b[k])
}
fn dot(a: V, b: V) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}
fn cross(a: V, b: V) -> V {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}
fn norm(a: V) -> f64 {
    dot(a, a).sqrt()
}

/// The distance to a triangle by barycentric coordinates, and the solid angle under which the point sees it.
fn sees(p: V, t: [V; 3]) -> (f64, f64) {
    let [a, b, c] = t.map(|v| sub(v, p));
    let angle = 2.0
        * dot(a, cross(b, c))
            .atan2(norm(a) * norm(b) * norm(c) + dot(a, b) * norm(c) + dot(b, c) * norm(a) + dot(c, a) * norm(b));
    let n = cross(sub(b, a), sub(c, a));
    let weights = [dot(n, cross(b, c)), dot(n, cross(c, a)), dot(n, cross(a, b))];
    let segment = |u: V, v: V| {
        let l = sub(v, u);
        let s = (-dot(u, l) / dot(l, l)).clamp(0.0, 1.0);
        norm([0, 1, 2].map(|k| u[k] + s * l[k]))
    };
    let near = segment(a, b).min(segment(b, c)).min(segment(c, a));
    (if weights.iter().all(|w| *w >= 0.0) { near.min((dot(n, a) / norm(n)).abs()) } else { near }, angle)
}

fn value(surface: &Surface, p: V) -> f64 {
    let corners = |t: &[u32; 3]| t.map(|v| surface.positions[v as usize]);
    let (mut far, mut angle) = (f64::INFINITY, 0.0);
    for t in &surface.triangles {
        let (d, a) = sees(p, corners(t));
        far = far.min(d);
        angle += a;
    }
    if (angle / (2.0 * TAU)).round() == 0.0 { -far } else { far }
}

#[test]
fn values_are_the_distance_and_the_winding_number_wherever_the_mesh_is_and_however_large() {
    let mut random = Random(3);
    for [at, size] in [[0.0, 1.0], [100.0, 1e-2], [0.0, 1e-200], [-1e200, 1e199], [3.0, 1e5]] {
        let surface = torus(&mut random, 23, 11, [at, size]);
        let (solid, noted) = solid(&surface);
        assert_eq!(noted, Noted::default());
        for _ in 0..300 {
            let p = [0; 3].map(|_| at + size * random.between(-1.5, 1.5));
            let unit = |p: V| p.map(|c| (c - at) / size);
            let plain = Surface { positions: surface.positions.iter().map(|p| unit(*p)).collect(), ..surface.clone() };
            let (found, right) = (solid.value(&p) / size, value(&plain, unit(p)));
            let room = 1e-12 + 1e-14 * (at / size).abs();
            assert!((found - right).abs() < room, "{p:?}: {found} instead of {right}");
        }
    }
}

#[test]
fn many_at_once_are_the_same_bits_and_bounds_hold_them() {
    let mut random = Random(5);
    let (solid, _) = solid(&torus(&mut random, 40, 20, [0.2, 1.0]));
    for case in 0..300 {
        let wide = 10_f64.powf(random.between(-4.0, 0.5));
        let over: Vec<Interval> = (0..3)
            .map(|_| {
                let lo = random.between(-1.6, 1.6);
                Interval::new(lo, lo + wide * random.between(0.0, 1.0))
            })
            .collect();
        let at: Vec<Vec<f64>> = over.iter().map(|i| (0..64).map(|_| random.between(i.lo, i.hi)).collect()).collect();
        let slices: Vec<&[f64]> = at.iter().map(Vec::as_slice).collect();
        let mut many = vec![0.0; 64];
        solid.values(&slices, &mut many);
        let bounds = solid.bounds(&over);
        for (i, found) in many.iter().enumerate() {
            let p = [at[0][i], at[1][i], at[2][i]];
            assert_eq!(found.to_bits(), solid.value(&p).to_bits());
            assert!(bounds.contains(*found), "case {case}: {found} at {p:?} is not in {bounds:?} over {over:?}");
        }
        // Half a diagonal each way, and no more.
        let reach = norm([0, 1, 2].map(|k| over[k].hi - over[k].lo));
        assert!(bounds.hi - bounds.lo <= reach * 1.001 + 1e-9);
    }
}

#[test]
fn boxes_without_end_and_points_beyond_all_are_outside() {
    let (solid, _) = solid(&torus(&mut Random(1), 12, 8, [0.0, 1.0]));
    let whole = Interval::new(f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        for far in [2.0, 1e12, 1e120, f64::MAX] {
            for up in [true, false] {
                let mut over = [whole; 3];
                over[axis] =
                    if up { Interval::new(far, f64::INFINITY) } else { Interval::new(f64::NEG_INFINITY, -far) };
                let bounds = solid.bounds(&over);
                assert!(bounds.is_negative() && !bounds.undefined && bounds.lo == f64::NEG_INFINITY, "{bounds:?}");
                let mut p = [0.0; 3];
                p[axis] = if up { far } else { -far };
                let value = solid.value(&p);
                assert!(value < 0.0 && (value + far).abs() <= 1.5, "{p:?}: {value}");
                assert!(bounds.contains(value));
            }
        }
    }
    assert_eq!(solid.value(&[0.0, f64::INFINITY, 0.0]), f64::NEG_INFINITY);
    assert!(solid.value(&[0.0, f64::NAN, 0.0]).is_nan());
    assert!(solid.bounds(&[whole; 3]).hi < 1.0);
    assert!(solid.bounds(&[whole, Interval::EMPTY, whole]).is_empty());
}

#[test]
fn gradients_are_those_of_the_distance() {
    let mut random = Random(9);
    let (solid, _) = solid(&torus(&mut random, 20, 10, [0.0, 1.0]));
    let mut checked = 0;
    for _ in 0..400 {
        let p = [0; 3].map(|_| random.between(-1.5, 1.5));
        let mut slope = [0.0; 3];
        let value = solid.gradient(&p, &mut slope);
        assert_eq!(value.to_bits(), solid.value(&p).to_bits());
        assert!((norm(slope) - 1.0).abs() < 1e-9);
        // Along the gradient the value rises by the step, away from places where two triangles are equally near.
        let step = |h: f64| solid.value(&[0, 1, 2].map(|k| p[k] + h * slope[k]));
        let h = 1e-5;
        checked += usize::from(((step(h) - step(-h)) / (2.0 * h) - 1.0).abs() < 1e-6);
    }
    assert!(checked > 380, "{checked} of 400");
    // On a face, an edge and a corner of a cube the normal is one of those around.
    let cube = decode("cube.obj", cube(1.0, false).as_bytes()).expect("a cube").0;
    for p in [[1.0, 0.2, 0.3], [1.0, 1.0, 0.3], [1.0, 1.0, 1.0]] {
        let mut slope = [0.0; 3];
        assert_eq!(cube.gradient(&p, &mut slope), 0.0);
        assert!(dot(slope, p) < -0.5 && norm(slope) == 1.0, "{p:?}: {slope:?}");
    }
}

/// A cube from -size to size of quads; with `inward`, seen from within.
fn cube(size: f64, inward: bool) -> String {
    let mut text: String = (0..8)
        .map(|n: i32| {
            let [x, y, z] = [n & 1, n >> 1 & 1, n >> 2 & 1].map(|b| if b == 1 { size } else { -size });
            format!("v {x} {y} {z}\n")
        })
        .collect();
    for face in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
        let face: Vec<String> = face.iter().map(ToString::to_string).collect();
        let face: Vec<String> = if inward { face.into_iter().rev().collect() } else { face };
        text += &format!("f {}\n", face.join(" "));
    }
    text
}

#[test]
fn turned_hollow_and_nearly_closed_meshes_are_what_was_meant() {
    // A cube, one inside out, one with a quad turned, one with a hollow.
    let shift = |text: &str| {
        let shifted = |word: &str| word.parse::<i32>().map_or(word.to_owned(), |n| (n + 8).to_string());
        let line = |line: &str| match line.strip_prefix("f ") {
            Some(rest) => format!("f {}\n", rest.split(' ').map(shifted).collect::<Vec<_>>().join(" ")),
            None => format!("{line}\n"),
        };
        text.lines().map(line).collect::<String>()
    };
    let plain = cube(1.0, false);
    let hollow = plain.clone() + &shift(&cube(0.5, true));
    let turned = plain.replacen("f 1 3 4 2", "f 2 4 3 1", 1);
    let cases = [
        (plain, [1.0, 0.8, 0.0], 0),
        (cube(1.0, true), [1.0, 0.8, 0.0], 0),
        (turned, [1.0, 0.8, 0.0], 2),
        (hollow, [-0.5, -0.3, 0.0], 0),
    ];
    for (text, values, turned) in cases {
        let (solid, noted) = decode("a.obj", text.as_bytes()).unwrap_or_else(|why| panic!("{why}\n{text}"));
        for (x, value) in [0.0, 0.2, 1.0].into_iter().zip(values) {
            assert!(
                (solid.value(&[x, 0.0, 0.0]) - value).abs() < 1e-14,
                "{x}: {} in {text}",
                solid.value(&[x, 0.0, 0.0])
            );
        }
        assert_eq!((solid.value(&[2.0, 0.0, 0.0]), noted.mended.turned), (-1.0, turned));
    }
    // Corners that differ by rounding, and a hole of the size of a triangle in a fine mesh.
    let mut loose = torus(&mut Random(4), 60, 30, [0.0, 1.0]);
    let first = loose.triangles[0];
    let moved = loose.positions[first[0] as usize].map(|c| c + 1e-9);
    loose.positions.push(moved);
    loose.triangles[0][0] = loose.positions.len() as u32 - 1;
    let (_, noted) = solid(&loose);
    assert_eq!((noted.mended.joined, noted.mended.filled), (1, 0));
    let mut holed = torus(&mut Random(4), 200, 100, [0.0, 1.0]);
    holed.triangles.swap_remove(77);
    let (_, noted) = solid(&holed);
    assert_eq!((noted.mended.joined, noted.mended.filled), (0, 1));
    holed.triangles.truncate(30_000);
    let context = Context { limits: &Limits::default(), interrupt: &Interrupt::default() };
    assert!(matches!(mesh::solid("a", holed, context), Err(MeshError::Open { .. })));
}

#[test]
fn faces_of_many_corners_are_cut_within_themselves() {
    // A prism over a comb: a fan from its first corner would leave it.
    let comb = [[0, 0], [9, 0], [9, 5], [8, 5], [8, 1], [5, 1], [5, 5], [4, 5], [4, 1], [1, 1], [1, 5], [0, 5]];
    let mut text = String::new();
    for z in 0..2 {
        comb.iter().for_each(|[x, y]| text += &format!("v {x} {y} {z}\n"));
    }
    let n = comb.len();
    let words = |all: Vec<usize>| all.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ");
    text += &format!("f {}\nf {}\n", words((1..=n).rev().collect()), words((n + 1..=2 * n).collect()));
    (0..n)
        .for_each(|i| text += &format!("f {}\n", words(vec![i + 1, (i + 1) % n + 1, (i + 1) % n + 1 + n, i + 1 + n])));
    let (solid, noted) = decode("comb.obj", text.as_bytes()).expect("a comb");
    assert_eq!(noted, Noted::default());
    assert_eq!(solid.triangles(), 2 * (n - 2) + 2 * n);
    for (p, value) in [([6.5, 3.0, 0.5], -1.5), ([8.5, 3.0, 0.5], 0.5), ([6.5, 3.0, 0.0], -1.5), ([0.5, 4.0, 0.2], 0.2)]
    {
        assert!((solid.value(&p) - value).abs() < 1e-14, "{p:?}: {}", solid.value(&p));
    }
}

#[test]
fn spellings_of_obj_and_stl() {
    let plain = cube(1.0, false);
    let variants = [
        plain.clone(),
        plain.trim_end().to_owned(),
        format!("\u{feff}{plain}"),
        plain.replace('\n', "\r\n"),
        plain.replace("f 1 3 4 2", "f -8/1/1 -6/2/1 \\\n -5//1 -7 # a face"),
        format!("mtllib /dev/zero\no A b\nvt 0 0\nvn 0 0 1\nusemtl \u{e9}\ns off\n{plain}"),
        plain.replace("v 1 1 1", "v 1 1 1 1.0 0.5 0.5 0.5"),
        plain.replace("v 1 1 1", "v 1e0 +1.0 .1e1"),
    ];
    for text in variants {
        let (solid, _) = decode("A.OBJ", text.as_bytes()).unwrap_or_else(|why| panic!("{why}\n{text}"));
        assert_eq!((solid.value(&[0.25, 0.0, 0.0]), solid.triangles()), (0.75, 12), "{text}");
    }
    let surface = obj::read(plain.as_bytes()).expect("a cube");
    for bytes in [
        stl(&surface),
        stl_text(&surface).into_bytes(),
        stl_text(&surface).to_uppercase().replace('\n', "\r\n").into_bytes(),
    ] {
        assert_eq!(decode("a.stl", &bytes).expect("a cube").0.value(&[0.25, 0.0, 0.0]), 0.75);
    }
    // A binary file whose header begins as a text does.
    let mut lying = stl(&surface);
    lying[..12].copy_from_slice(b"solid facet ");
    assert_eq!(decode("a.stl", &lying).expect("a cube").0.triangles(), 12);
}

fn stl(surface: &Surface) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((surface.triangles.len() as u32).to_le_bytes());
    for t in &surface.triangles {
        bytes.extend([0; 12]);
        t.iter().flat_map(|v| surface.positions[*v as usize]).for_each(|c| bytes.extend((c as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl_text(surface: &Surface) -> String {
    let corner = |v: &u32| {
        let [x, y, z] = surface.positions[*v as usize];
        format!("      vertex {x} {y} {z:e}\n")
    };
    let facet = |t: &[u32; 3]| {
        let corners: String = t.iter().map(corner).collect();
        format!("  facet normal nan 0 0\n    outer loop\n{corners}    endloop\n  endfacet\n")
    };
    format!("solid a name of words\n{}endsolid a name", surface.triangles.iter().map(facet).collect::<String>())
}

#[test]
fn broken_files_say_where() {
    let plain = cube(1.0, false);
    let cases: &[(&str, &str, &str)] = &[
        ("index 0", "f 0 3 4 2", "line 9: there is no vertex 0: they count from 1"),
        ("index -9", "f -9 3 4 2", "line 9: there is no vertex -9: 8 precede this face"),
        ("index 2^62", "f 4611686018427387904 3 4 2", "line 9: there is no vertex 4611686018427387904"),
        (
            "index beyond all",
            "f 99999999999999999999999 3 4 2",
            "line 9: there is no vertex 999999999999999999999999".get(..52).unwrap_or(""),
        ),
        ("a word", "f 1 three 4 2", "line 9: `three` is no corner of a face"),
        ("two corners", "f 1 2", "line 9: a face needs three corners"),
        ("nothing", "f", "line 9: a face needs three corners"),
        ("NaN", "v nan 0 0", "line 9: `nan` is not a finite number"),
        ("1e999", "v 0 1e999 0", "line 9: `1e999` is not a finite number"),
        ("two numbers", "v 0 1", "line 9: a vertex needs three numbers"),
        ("NUL", "v 0 \0 0", "line 9: a byte 0x00 stands where text should be"),
        ("open", "", "the mesh is open: 4 of its 17 edges miss a triangle"),
    ];
    for (what, line, message) in cases {
        let text = plain.replacen("f 1 3 4 2", line, 1);
        let told = decode("a.obj", text.as_bytes()).map(|_| ()).expect_err(what).to_string();
        assert!(told.contains(message), "{what}: {told}");
    }
    let surface = obj::read(plain.as_bytes()).expect("a cube");
    let (binary, text) = (stl(&surface), stl_text(&surface));
    let mut nan = binary.clone();
    nan[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    let mut many = binary.clone();
    many[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let cases: Vec<(&str, Vec<u8>, &str)> = vec![
        ("empty", Vec::new(), "ends before the first triangle"),
        ("short", vec![0; 83], "ends before the first triangle"),
        ("no triangle", vec![0; 84], "there is no triangle in it"),
        ("truncated", binary[..300].to_vec(), "promises 12 triangles, and has bytes for 4"),
        ("more", [&binary[..], b"tail"].concat(), "promises 12 triangles, and has bytes behind them"),
        ("lying count", many, "promises 4294967295 triangles, and has bytes for 12"),
        ("NaN", nan, "a corner of triangle 2 is not finite"),
        ("cut text", text.as_bytes()[..text.len() / 2].to_vec(), "line 43: `en` stands where `endfacet` should"),
        ("cut end", text.as_bytes()[..text.len() - 16].to_vec(), "the file ends before `endsolid`"),
        ("a word", text.replacen("vertex 1 ", "vertex one ", 1).into_bytes(), "`one` is not a number"),
        ("1e999", text.replacen("vertex 1 ", "vertex 1e999 ", 1).into_bytes(), "`1e999` is not a finite number"),
        (
            "four corners",
            text.replacen("endloop", "vertex 1 1 1\nendloop", 1).into_bytes(),
            "`vertex` stands where `endloop`",
        ),
        ("solid alone", b"solid".to_vec(), "the file ends before `endsolid`"),
        ("empty solid", b"solid a\nendsolid a\n".to_vec(), "there is no triangle in it"),
    ];
    for (what, bytes, message) in cases {
        let told = decode("a.stl", &bytes).map(|_| ()).expect_err(what).to_string();
        assert!(told.contains(message), "{what}: {told}");
    }
    for (text, message) in [("", "no triangle"), ("v 1 1 1\nf 1 1 1\n", "no triangle"), ("f \\", "ends within a line")]
    {
        let told = decode("a.obj", text.as_bytes()).map(|_| ()).expect_err(text).to_string();
        assert!(told.contains(message), "{text}: {told}");
    }
    assert_eq!(decode("a.ply", b"").map(|_| ()), Err(MeshError::UnknownFormat));
    let limits = Limits { memory_bytes: 1_000, ..Limits::default() };
    let context = Context { limits: &limits, interrupt: &Interrupt::default() };
    assert!(matches!(mesh::decode("a.obj", plain.as_bytes(), context), Err(MeshError::TooLarge { .. })));
    let stopped = Interrupt::default();
    stopped.cancel();
    let context = Context { limits: &Limits::default(), interrupt: &stopped };
    assert!(matches!(mesh::decode("a.obj", plain.as_bytes(), context), Err(MeshError::Cancelled)));
}

#[test]
fn surfaces_without_an_inside_and_those_that_cross() {
    // A Klein bottle's edges: a torus glued the wrong way round.
    let (n, m) = (8, 6);
    let mut klein = torus(&mut Random(2), n, m, [0.0, 1.0]);
    let last = (n - 1) * m;
    for t in &mut klein.triangles[2 * last as usize..] {
        for v in t.iter_mut().filter(|v| **v < m) {
            *v = (m - *v) % m;
        }
    }
    let context = Context { limits: &Limits::default(), interrupt: &Interrupt::default() };
    assert!(matches!(mesh::solid("a", klein, context), Err(MeshError::OneSided { .. })));
    let flat = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n";
    assert_eq!(decode("a.obj", flat.as_bytes()).map(|_| ()), Err(MeshError::NoInside));
    // Two cubes that overlap: inside both is inside.
    let second = cube(1.0, false).replace("v 1", "v 1.5").replace("v -1", "v 0.5");
    let both = cube(1.0, false)
        + &second
            .replace("f 1 3 4 2", "f 9 11 12 10")
            .replace("f 5 6 8 7", "f 13 14 16 15")
            .replace("f 1 2 6 5", "f 9 10 14 13")
            .replace("f 3 7 8 4", "f 11 15 16 12")
            .replace("f 1 5 7 3", "f 9 13 15 11")
            .replace("f 2 4 8 6", "f 10 12 16 14")
            .replace(" -1 -1\n", " -0.5 -0.5\n")
            .replace(" 1 -1\n", " 0.25 -0.5\n")
            .replace(" -1 1\n", " -0.5 0.25\n")
            .replace(" 1 1\n", " 0.25 0.25\n");
    let (solid, noted) = decode("a.obj", both.as_bytes()).unwrap_or_else(|why| panic!("{why}\n{both}"));
    let (count, at) = noted.crossings.expect("they cross");
    assert!(count >= 8 && at.starts_with('('), "{count} {at}");
    for (x, inside) in [(-0.9, true), (0.7, true), (1.2, true), (1.6, false)] {
        assert_eq!(solid.value(&[x, 0.1, 0.1]) > 0.0, inside, "{x}");
    }
}

/// The volume within a mesh in a binary STL.
fn volume(stl: &[u8]) -> f64 {
    let number = |at: usize| f64::from(f32::from_le_bytes([stl[at], stl[at + 1], stl[at + 2], stl[at + 3]]));
    let corner = |at: usize| [number(at), number(at + 4), number(at + 8)];
    let records = (84..stl.len()).step_by(50);
    records.map(|at| dot(corner(at + 12), cross(corner(at + 24), corner(at + 36))) / 6.0).sum()
}

#[test]
#[allow(clippy::print_stderr)]
fn meshes_made_again_hold_what_they_held() {
    let folder_of = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/meshes");
    let cases = [("monkey.stl", 2.14777), ("spot.obj", 0.718259), ("teapot.stl", 526.507)];
    for (name, right) in cases {
        let path = format!("{folder_of}/{name}");
        if !std::path::Path::new(&path).exists() {
            eprintln!("SKIPPED: there is no {path}");
            continue;
        }
        let folder = folder(&[("a.geo", format!("gob_a = MESH(\"{path}\");").as_bytes())]);
        let ran = run(folder.path(), &["a.geo", "-q", "-o", "a.stl", "--resolution", "96"], "");
        assert_eq!(ran.status, Some(0), "{}", ran.err);
        let found = volume(&std::fs::read(folder.path().join("a.stl")).expect("a mesh"));
        assert!((found / right - 1.0).abs() < 0.01, "{name}: {found} instead of {right}");
    }
}

#[test]
fn a_mesh_takes_part_in_any_expression() {
    let program = "gob_cube = MESH(\"cube.obj\");
        gob_part = tr_rotate_z(gob_cube \\ pob_cylinder_x([0, 0, 0], 0.5), 0.3) | pob_torus_z([0, 0, 0], 1.5, 0.2);
        gob_slid = MESH(\"cube.obj\", x1 - x4, x2, x3) AT (x4 = 3);
        PRINT gob_cube(0, 0, 0.5), gob_slid(3.5, 0, 0), DIFF(gob_cube, x1) AT (0.9, 0, 0), gob_part(0, 0, 0) < 0;";
    let folder = folder(&[("a.geo", program.as_bytes()), ("cube.obj", cube(1.0, false).as_bytes())]);
    let ran = run(folder.path(), &["a.geo", "-o", "a.stl", "--object", "gob_part", "--resolution", "48"], "");
    assert_eq!((ran.status, ran.out.as_str()), (Some(0), "0.5 0.5 -1 1\n"), "{}", ran.err);
    let ran = run(folder.path(), &["measure", "a.geo", "--json", "--object", "gob_part", "--resolution", "48"], "");
    assert!(ran.out.contains("\"closed\": true") || ran.out.contains("\"closed\":true"), "{}", ran.out);
}

#[test]
fn folders_pipes_and_devices_are_no_meshes() {
    let folder = folder(&[("a.geo", b"gob_a = MESH(file) AT (x1, x2, x3);"), ("b.obj", b"mtllib c.mtl\n")]);
    let pipe = folder.path().join("pipe.stl");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().is_ok_and(|made| made.success()));
    let link = folder.path().join("zero.obj");
    std::os::unix::fs::symlink("/dev/zero", &link).expect("room");
    let cases = [
        ("pipe.stl", "a pipe"),
        ("zero.obj", "a device"),
        (".", "folder"),
        ("none.obj", "no such file"),
        ("b.obj", "no triangle"),
        ("a.geo", "not a mesh file"),
    ];
    for (name, words) in cases {
        let define = format!("file=\"{name}\"");
        let ran = run(folder.path(), &["a.geo", "-D", &define, "-o", "a.stl"], "");
        assert_eq!(ran.status, Some(4), "{name}: {}", ran.err);
        assert!(ran.err.contains(words) && ran.made.is_empty(), "{name}: {}", ran.err);
    }
}
