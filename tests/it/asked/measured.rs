//! What is measured of objects, against closed forms; the uncertainty must hold the error.

use super::{PI, numbers, refused};

const SHAPES: &str = "ball = 1 - (x1 - 3)**2 - (x2 + 2)**2 - x3**2; box = pob_box([1, 2, 3], [2, 1, 0.5]); torus = pob_torus([0, 0, 0], 2, 0.5);
    hollow = pob_sphere([0, 0, 0], 1) \\ pob_sphere([0, 0, 0], 0.5); disc = 1 - (x1 - 1)**2 - (x2 - 2)**2; ring = disc \\ 0.25 - (x1 - 1)**2 - (x2 - 2)**2;
    part = pob_box([0, 0, 0], [6, 2, 1]) \\ (0.2 - (x1 - 2)**2 - x2**2) \\ (0.2 - x1**2 - x2**2) \\ (0.2 - (x1 + 2)**2 - x2**2);
    pieces = 1 - (x1 - 3)**2 | 0.25 - (x1 + 1)**2; upright = 1 - (x1 - 1)**2 - (x3 - 2)**2; nothing = -1 - x1**2 - x2**2 - x3**2;";

/// What is asked, its exact answer, and how far off the answer may be at most.
fn cases() -> Vec<(&'static str, Vec<f64>, f64)> {
    let box_inertia = [1.25 / 12.0, 4.25 / 12.0, 5.0 / 12.0];
    let (mass, big, small) = (2.0 * PI * PI * 2.0 * 0.25, 2.0_f64, 0.5_f64);
    let across = mass * (big * big / 2.0 + 5.0 * small * small / 8.0);
    let along = mass * (big * big + 0.75 * small * small);
    let diagonal = |[a, b, c]: [f64; 3]| vec![a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c];
    vec![
        ("VOLUME(ball)", vec![4.0 / 3.0 * PI], 1e-5),
        ("AREA(ball)", vec![4.0 * PI], 1e-4),
        ("CENTROID(ball)", vec![3.0, -2.0, 0.0], 1e-6),
        ("INERTIA(ball)", diagonal([8.0 / 15.0 * PI; 3]), 1e-4),
        ("BOUNDS(ball)", vec![2.0, 4.0, -3.0, -1.0, -1.0, 1.0], 1e-6),
        ("MEAN_CURVATURE(ball)", vec![1.0, 1.0, 1.0, 4.0 * PI], 1e-3),
        ("GAUSS_CURVATURE(ball)", vec![1.0, 1.0, 1.0, 4.0 * PI], 1e-3),
        ("VOLUME(box)", vec![1.0], 1e-3),
        ("AREA(box)", vec![7.0], 1e-2),
        ("CENTROID(box)", vec![1.0, 2.0, 3.0], 1e-3),
        ("INERTIA(box)", diagonal(box_inertia), 2e-3),
        ("BOUNDS(box)", vec![0.0, 2.0, 1.5, 2.5, 2.75, 3.25], 1e-6),
        ("VOLUME(torus)", vec![mass], 1e-4),
        ("AREA(torus)", vec![4.0 * PI * PI * big * small], 1e-3),
        ("INERTIA(torus)", diagonal([across, across, along]), 3e-3),
        ("GENUS(torus)", vec![1.0], 0.0),
        ("COMPONENTS(torus)", vec![1.0], 0.0),
        // On the inside of the ring and on its outside; the average of the mean curvature of a torus is 1/(2 r).
        ("MEAN_CURVATURE(torus)", vec![1.0 - 1.0 / 3.0, 1.0, 1.2, 2.0 * PI * PI * big], 0.05),
        ("GAUSS_CURVATURE(torus)", vec![-4.0 / 3.0, 0.0, 0.8, 0.0], 0.05),
        ("COMPONENTS(hollow)", vec![1.0], 0.0),
        ("GENUS(hollow)", vec![0.0], 0.0),
        ("COMPONENTS(ball | torus AT (x1 = x1 + 5))", vec![2.0], 0.0),
        ("GENUS(part)", vec![3.0], 0.0),
        ("COMPONENTS(part)", vec![1.0], 0.0),
        ("AREA(disc)", vec![PI], 1e-4),
        ("VOLUME(disc)", vec![PI], 1e-4),
        ("PERIMETER(disc)", vec![2.0 * PI], 1e-4),
        ("CENTROID(disc)", vec![1.0, 2.0], 1e-6),
        ("INERTIA(disc)", vec![PI / 4.0, 0.0, 0.0, PI / 4.0], 1e-4),
        ("MEAN_CURVATURE(disc)", vec![1.0, 1.0, 1.0, 2.0 * PI], 1e-3),
        ("GENUS(ring)", vec![1.0], 0.0),
        ("AREA(ring)", vec![0.75 * PI], 1e-3),
        ("VOLUME(pieces)", vec![3.0], 1e-9),
        ("CENTROID(pieces)", vec![5.0 / 3.0], 1e-9),
        ("COMPONENTS(pieces)", vec![2.0], 0.0),
        ("BOUNDS(pieces)", vec![-1.5, 4.0], 1e-6),
        ("CENTROID(upright)", vec![1.0, 0.0, 2.0], 1e-6),
        ("BOUNDS(upright)", vec![0.0, 2.0, f64::NEG_INFINITY, f64::INFINITY, 1.0, 3.0], 1e-6),
        ("BOUNDS(1 - x1**2 - x2**2 - x3**2 - (x4 - 2)**2)[4]", vec![1.0, 3.0], 1e-5),
        ("VOLUME(nothing)", vec![0.0], 0.0),
        ("COMPONENTS(nothing)", vec![0.0], 0.0),
        ("VOLUME(-x1**2 - x2**2 - x3**2)", vec![0.0], 0.0),
        ("VOLUME((1 - (x1 - x4)**2 - x2**2 - x3**2) AT (x4 = 7), 32)", vec![4.0 / 3.0 * PI], 1e-2),
    ]
}

#[test]
fn answers_are_those_of_closed_forms() {
    for (question, exact, most) in cases() {
        let found = numbers(SHAPES, question);
        assert_eq!(found.len(), exact.len(), "{question}: {found:?}");
        for (found, exact) in found.iter().zip(&exact) {
            assert!(found == exact || (found - exact).abs() <= most, "{question}: {found} instead of {exact}");
        }
    }
}

#[test]
fn the_uncertainty_holds_the_error() {
    for (question, exact, _) in cases() {
        if question.starts_with("BOUNDS") && question.ends_with(']') {
            continue;
        }
        let (found, errors) = (numbers(SHAPES, question), numbers(SHAPES, &format!("UNCERTAINTY({question})")));
        for ((found, exact), error) in found.iter().zip(&exact).zip(errors) {
            // It is an estimate.
            assert!(
                found == exact || (found - exact).abs() <= 1.5 * error + 1e-12,
                "{question}: {found}, {exact}, {error}"
            );
        }
    }
}

#[test]
fn what_has_no_answer_is_refused() {
    for (question, code) in [
        ("VOLUME(1 - x1**2 - x2**2 - x3**2 - x4**2)", "dimension"),
        ("VOLUME(1 - x1**2 - x2**2 + 0*x3)", "endless-object"),
        ("BOUNDS(x1)", "endless-object"),
        ("CENTROID(-1 - x1**2 - x2**2)", "empty-object"),
        ("BOUNDS(-1 - x1**2 - x2**2)", "empty-object"),
        ("GENUS(1 - x1**2)", "not-measured"),
        ("PERIMETER(1 - x1**2 - x2**2 - x3**2)", "not-measured"),
        ("GAUSS_CURVATURE(1 - x1**2 - x2**2)", "not-measured"),
        ("VOLUME(3)", "not-an-object"),
        ("VOLUME([1, 2])", "needs-number"),
        ("VOLUME(1 - x1**2 - x2**2, 0)", "resolution"),
        ("VOLUME(1 - x1**2 - x2**2, 2.5)", "resolution"),
        ("VOLUME(1 - x1**2 - x2**2, x1)", "needs-constant"),
        ("UNCERTAINTY(3)", "no-uncertainty"),
        ("UNCERTAINTY(INTERSECTS(x1, x2))", "no-uncertainty"),
        ("UNCERTAINTY(VOLUME())", "wrong-count"),
    ] {
        assert_eq!(refused(question), code, "{question}");
    }
}
