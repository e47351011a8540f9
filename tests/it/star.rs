//! Star solids of half-spaces: as data and as a graph the same, bounds and slopes that hold, messages; and edits against evaluation
//! anew, over many random ones.

use yont::interrupt::Interrupt;
use yont::number::star::{AXES, Exponent, Polyhedron, Row, StarSolid};
use yont::number::{Interval, Leaf};
use yont::surface::edit::{Edit, Refused, Sculpture, difference};
use yont::syntax::Mode;

use crate::conformance::Random;
use crate::session::{messages, session};
use crate::stdlib::worth;

fn direction(random: &mut Random) -> [f64; 3] {
    loop {
        let v: [f64; 3] = std::array::from_fn(|_| random.between(-1.0, 1.0));
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (0.1..=1.0).contains(&length) {
            return v.map(|x| x / length);
        }
    }
}

fn row(random: &mut Random) -> Row {
    let (v, distance) = (direction(random), random.between(0.5, 2.0));
    [v[0] / distance, v[1] / distance, v[2] / distance, 0.0]
}

fn exponent(p: f64) -> Exponent {
    Exponent::new(p).expect("above 0")
}

fn polyhedron(random: &mut Random, rows: usize, p: f64) -> Polyhedron {
    Polyhedron { rows: (0..rows).map(|_| row(random)).collect(), p: exponent(p) }
}

fn solid(random: &mut Random, parts: usize, p: f64) -> StarSolid {
    let parts = (0..parts).map(|_| {
        let rows = 3 + random.below(9);
        polyhedron(random, rows, p)
    });
    StarSolid { arity: 3, parts: parts.collect(), p: exponent(p) }
}

fn at(v: [f64; 3]) -> Row {
    let mut at = [0.0; AXES];
    at[..3].copy_from_slice(&v);
    at
}

#[test]
fn data_and_graph_agree() {
    let cube = "[[[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]], [[0.5,0,0.2],[-0.5,0,0],[0,2,0],[0,-2,0.1],[0,0,2],[0,0,-2]]]";
    for p in ["1", "2.5", "8", "[3, 40]", "INFINITY"] {
        for point in ["0.3, 0.4, -0.2", "-2, 0.1, 1", "1, 1, 1", "0, 0, 0"] {
            // A coefficient that is a function keeps the chain of norms in the graph.
            let data = worth(&mut session(), &format!("STAR({cube}, {p}, 4) AT ({point});"));
            let graph = worth(
                &mut session(),
                &format!("STAR({}, {p}, 4) AT ({point});", cube.replacen("[1,0", "[1 + 0*x1,0", 1)),
            );
            let (data, graph): (f64, f64) = (data.parse().expect("a number"), graph.parse().expect("a number"));
            assert!((data - graph).abs() < 1e-13 * (1.0 + data.abs()), "{p} at {point}: {data} and {graph}");
        }
    }
}

#[test]
fn values_are_ray_linear_and_bounds_hold_them() {
    let mut random = Random(3);
    for p in [0.7, 1.0, 2.0, 8.0, 33.5, 1000.0, f64::INFINITY] {
        let solid = solid(&mut random, 4, p);
        for _ in 0..200 {
            let over: Vec<Interval> = (0..3)
                .map(|_| {
                    let (lo, size) = (random.between(-2.0, 2.0), random.between(0.0, 1.0));
                    Interval::new(lo, lo + size * size)
                })
                .collect();
            let bounds = solid.bounds(&over);
            let x: Vec<f64> = over.iter().map(|i| random.between(i.lo, i.hi).clamp(i.lo, i.hi)).collect();
            let value = solid.value(&x);
            assert!(bounds.contains(value), "p = {p}: {value} is not in {bounds:?}");
            let far: Vec<f64> = x.iter().map(|x| 7.0 * x).collect();
            assert!((solid.value(&far) - 7.0 * value).abs() <= 1e-11 * value.abs());
            let mut slope = [0.0; 3];
            assert_eq!(solid.gradient(&x, &mut slope), value);
            // Euler: the gradient along the ray is the value.
            let along: f64 = slope.iter().zip(&x).map(|(s, x)| s * x).sum();
            assert!((along - value).abs() < 1e-9 * (1.0 + value), "p = {p}: {along} for {value}");
        }
    }
}

#[test]
fn what_star_refuses() {
    for (program, words) in [
        ("STAR([], 2, 2)", "no polyhedron"),
        ("STAR([[]], 2, 2)", "empty"),
        ("STAR([[[1, 0], [1, 0, 0]]], 2, 2)", "the others have 2"),
        ("STAR([[[1, 0, 0, 0, 0]]], 2, 2)", "1 to 4 are possible"),
        ("STAR([[1, 0, 0]], 2, 2)", "half-space 1 of polyhedron 1 is a number"),
        ("STAR([1, 2], 2, 2)", "polyhedron 1 is a number"),
        ("STAR(1, 2, 2)", "needs an array of polyhedra"),
        ("STAR([[[1, 0]]], 0, 2)", "is above 0"),
        ("STAR([[[1, 0]]], 2, -2)", "is above 0"),
        ("STAR([[[1, 0]]], [2, 3], 2)", "1 polyhedra and 2 local"),
        ("STAR([[[INFINITY, 0]]], 2, 2)", "not finite"),
    ] {
        let outcome = session().input("a", &format!("gob_a = {program};"), Mode::Script);
        assert!(
            messages(&outcome).contains(words) || !outcome.diagnostics.is_empty() && words == "empty",
            "{program}: {}",
            messages(&outcome)
        );
    }
}

/// The largest relative distance of what is kept from new values.
fn drift(sculpture: &Sculpture) -> f64 {
    let pairs = sculpture.guide().zip(sculpture.reaches());
    pairs
        .map(|(v, kept)| {
            let new = sculpture.solid().reach(&at(v));
            if kept == new { 0.0 } else { (kept / new - 1.0).abs() }
        })
        .fold(0.0, f64::max)
}

fn edit(random: &mut Random, solid: &StarSolid, p: f64) -> Edit {
    let part = random.below(solid.parts.len());
    let rows = solid.parts[part].rows.len();
    match random.below(10) {
        0 if rows < 20 => Edit::Add { part, row: row(random) },
        1 if rows > 1 => Edit::Remove { part, row: random.below(rows) },
        2 if solid.parts.len() < 12 => Edit::AddPart(polyhedron(random, rows, p)),
        3 if solid.parts.len() > 1 => Edit::RemovePart(part),
        4 => Edit::Replace { part, with: polyhedron(random, rows, p) },
        _ => Edit::Move { part, row: random.below(rows), to: row(random) },
    }
}

#[test]
fn ten_thousand_edits_do_not_drift() {
    let interrupt = Interrupt::default();
    for p in [0.5, 1.0, 2.0, 7.3, 32.0, 1000.0, f64::INFINITY] {
        let mut random = Random(p.to_bits());
        let guide: Vec<[f64; 3]> = (0..16).map(|_| direction(&mut random)).collect();
        let mut sculpture = Sculpture::new(solid(&mut random, 6, p), &guide, &interrupt).expect("not stopped");
        for i in 0..10_000 {
            let edit = edit(&mut random, sculpture.solid(), p);
            sculpture.edit(edit, &interrupt).expect("possible");
            if i % 1000 == 999 {
                let drift = drift(&sculpture);
                assert!(drift < 1e-9, "p = {p}: {drift:e} after {i} edits");
            }
        }
    }
    assert!(Sculpture::bytes_per_vertex() <= 200);
}

#[test]
fn an_edit_evaluates_as_much_whatever_there_is() {
    let (interrupt, mut random) = (Interrupt::default(), Random(11));
    let guide: Vec<[f64; 3]> = (0..4_000).map(|_| direction(&mut random)).collect();
    for p in [2.0, 8.0, f64::INFINITY] {
        let mut costs = Vec::new();
        for parts in [1, 10, 100, 1_000] {
            let parts = (0..parts).map(|_| polyhedron(&mut random, 10, p)).collect();
            let solid = StarSolid { arity: 3, parts, p: exponent(p) };
            let mut sculpture = Sculpture::new(solid, &guide, &interrupt).expect("not stopped");
            let before = sculpture.evaluated();
            for _ in 0..20 {
                let part = random.below(sculpture.solid().parts.len());
                let to = row(&mut random);
                sculpture.edit(Edit::Move { part, row: random.below(10), to }, &interrupt).expect("possible");
            }
            costs.push((sculpture.evaluated() - before) as f64 / (20 * guide.len()) as f64);
        }
        assert!(
            costs.iter().all(|cost| *cost < 40.0),
            "half-spaces evaluated for a vertex and an edit, p = {p}: {costs:?}"
        );
    }
}

#[test]
fn what_changed_is_found_by_comparing() {
    let mut random = Random(2);
    for _ in 0..300 {
        let from = solid(&mut random, 5, 4.0);
        let edit = edit(&mut random, &from, 4.0);
        let mut sculpture = Sculpture::new(from.clone(), &[[1.0, 0.0, 0.0]], &Interrupt::default()).expect("small");
        sculpture.edit(edit.clone(), &Interrupt::default()).expect("possible");
        let to = sculpture.solid();
        let found = difference(&from, to).unwrap_or_else(|| panic!("{edit:?} is not found"));
        let mut again = Sculpture::new(from.clone(), &[[1.0, 0.0, 0.0]], &Interrupt::default()).expect("small");
        again.edit(found, &Interrupt::default()).expect("possible");
        assert_eq!(again.solid(), to);
    }
    let (a, b) = (solid(&mut random, 3, 4.0), solid(&mut random, 3, 4.0));
    assert_eq!(difference(&a, &b), None);
    assert_eq!(difference(&a, &a), None);
}

#[test]
fn edits_that_are_refused_change_nothing() {
    let mut random = Random(9);
    let one = StarSolid { arity: 3, parts: vec![polyhedron(&mut random, 1, 2.0)], p: exponent(2.0) };
    let interrupt = Interrupt::default();
    let mut sculpture = Sculpture::new(one.clone(), &[[0.0, 1.0, 0.0]], &interrupt).expect("small");
    let empty = Polyhedron { rows: Vec::new(), p: exponent(2.0) };
    for (edit, refused) in [
        (Edit::Move { part: 0, row: 1, to: row(&mut random) }, Refused::NoSuch),
        (Edit::Add { part: 1, row: row(&mut random) }, Refused::NoSuch),
        (Edit::Remove { part: 0, row: 0 }, Refused::Last),
        (Edit::RemovePart(0), Refused::Last),
        (Edit::AddPart(empty.clone()), Refused::Last),
        (Edit::Replace { part: 0, with: empty }, Refused::Last),
    ] {
        assert_eq!(sculpture.edit(edit, &interrupt), Err(refused));
    }
    interrupt.cancel();
    assert_eq!(sculpture.edit(Edit::AddPart(polyhedron(&mut random, 3, 2.0)), &interrupt), Err(Refused::Cancelled));
    assert_eq!(*sculpture.solid(), one);
    interrupt.reset();
    sculpture.edit(Edit::Add { part: 0, row: row(&mut random) }, &interrupt).expect("possible");
    assert!(drift(&sculpture) < 1e-12);
}

/// A session's design of so many polyhedra, of which one coefficient of one has a name.
fn design(parts: usize, coefficient: f64) -> String {
    let mut random = Random(7);
    let parts: Vec<String> = (0..parts)
        .map(|part| {
            let rows = (0..6).map(|d| {
                let mut row = [0.0; 3].map(|_: f64| random.between(-0.2, 0.2).to_string());
                row[d / 2] = (if d % 2 == 0 { 1.0 } else { -1.0 } * random.between(0.8, 1.6)).to_string();
                if part == 3 && d == 2 {
                    row[1] = "k".into();
                }
                format!("[{}]", row.join(","))
            });
            format!("[{}]", rows.collect::<Vec<_>>().join(","))
        })
        .collect();
    format!("k = {coefficient}; P = [{}]; gob_a = STAR(P, 6, 12);", parts.join(","))
}

/// Redefining one number is an edit of what the guide's vertices keep, and gives the mesh of a session that begins with it.
#[test]
fn a_session_sees_an_edit() {
    use yont::model::request::{self, Options, Output};
    let write = |session: &mut yont::model::Session| {
        let mut options = Options::default();
        options.view.guide = request::Choice::read("icosahedron:4").expect("a guide");
        let output = Output::parse("-", request::Format::by_extension("stl")).expect("a mesh");
        let mut bytes = Vec::new();
        request::write(session, &output, &options, &mut bytes).expect("a mesh");
        // Corners of triangles: behind the head, normals left out.
        let numbers: Vec<f32> = bytes[84..]
            .chunks_exact(50)
            .flat_map(|facet| (3..12).map(|k| f32::from_le_bytes(facet[4 * k..4 * k + 4].try_into().expect("four"))))
            .collect();
        numbers
    };
    let begun = |coefficient| {
        let mut session = session();
        assert!(session.input("a.geo", &design(20, coefficient), Mode::Script).accepted);
        session
    };
    let mut edited = begun(1.1);
    let before = write(&mut edited);
    assert_eq!(edited.interrupt().costs().kept.edits, 0, "nothing is an edit of nothing");
    assert!(edited.input("a.geo", "k = 0.7;", Mode::Script).accepted);
    let after = write(&mut edited);
    assert_eq!(edited.interrupt().costs().kept.edits, 1, "one number changed");
    let fresh = write(&mut begun(0.7));
    assert!(before != after, "another shape");
    let far = after.iter().zip(&fresh).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(after.len() == fresh.len() && far < 1e-6, "{far} apart");
}
