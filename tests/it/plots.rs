//! Plots: what is found on a function, and that it is drawn where it belongs.

use yont::picture::axes::{Axis, number, ticks};
use yont::picture::graph::{Curve, Graph, follow, stack};
use yont::picture::image::Image;

/// Where `YONT_LOOK` names a folder, the pictures of these tests are left there to be looked at.
fn look(image: &Image, name: &str) {
    if let Ok(folder) = std::env::var("YONT_LOOK") {
        let mut bytes = Vec::new();
        yont::export::apng::write(std::slice::from_ref(image), 1., &mut bytes).unwrap();
        std::fs::write(format!("{folder}/{name}.png"), bytes).unwrap();
    }
}

fn curve(lo: f64, hi: f64, f: impl Fn(f64) -> f64) -> Curve {
    follow(lo, hi, 400, &mut |xs, ys| ys.iter_mut().zip(xs).for_each(|(y, &x)| *y = f(x)))
}

#[test]
fn ticks_are_round_and_read_as_they_are() {
    for (lo, hi, most, labels, power) in [
        (0., 1., 6, "0.0 0.2 0.4 0.6 0.8 1.0", 0),
        (-11., 11., 6, "−10 −5 0 5 10", 0),
        (-0.3, 0.3, 4, "−0.2 0.0 0.2", 0),
        (0., 2.5e6, 6, "0.0 0.5 1.0 1.5 2.0 2.5", 6),
        (-3e-7, 1e-7, 5, "−3 −2 −1 0 1", -7),
        (1995., 2003., 5, "1996 1998 2000 2002", 0),
        (-1e300, 1e300, 3, "−1 0 1", 300),
    ] {
        let got = ticks(lo, hi, most);
        assert_eq!((got.labels.join(" ").as_str(), got.power), (labels, power), "{lo} to {hi}");
    }
    assert_eq!(ticks(0., 3e12, 4).factor(), "×10¹²");
    assert_eq!(ticks(0., 3e-12, 4).factor(), "×10⁻¹²");
}

#[test]
fn ticks_of_any_range_lie_in_it_and_are_few() {
    let ends = [
        0.,
        1.,
        -1.,
        3.7,
        1e-300,
        -1e-300,
        1e300,
        f64::MAX,
        f64::MIN,
        f64::NAN,
        f64::INFINITY,
        1. + f64::EPSILON,
        12345.678,
    ];
    for lo in ends {
        for hi in ends {
            let axis = Axis::new("x1", lo, hi);
            assert!(axis.lo < axis.hi && (axis.hi - axis.lo).is_finite(), "{lo} {hi}: {axis:?}");
            for most in [0, 2, 5, 12] {
                let ticks = ticks(lo, hi, most);
                assert!(ticks.values.len() <= most.max(2) + 1, "{lo} {hi} {most}: {ticks:?}");
                let slack = (axis.hi - axis.lo) * 1e-6;
                assert!(
                    ticks.values.iter().all(|&t| (axis.lo - slack..=axis.hi + slack).contains(&t)),
                    "{lo} {hi}: {ticks:?}"
                );
            }
        }
    }
}

#[test]
fn numbers_of_labels_are_short() {
    for (value, text) in [
        (0.5, "0.5"),
        (0.1 + 0.2, "0.3"),
        (-2., "−2"),
        (-0., "0"),
        (1e9, "1e9"),
        (123456.789, "123457"),
        (-1e-9, "−1e-9"),
    ] {
        assert_eq!(number(value), text);
    }
}

#[test]
fn boundaries_are_found_to_the_last_digit() {
    let found = |inside: &[[f64; 2]]| inside.iter().flatten().copied().collect::<Vec<_>>();
    let root = 2_f64.sqrt();
    for (name, curve, expected) in [
        ("parabola", curve(-3., 3., |x| 2. - x * x), vec![-root, root]),
        ("goes on beyond the range", curve(-1., 3., |x| x), vec![0., 3.]),
        ("undefined left of 1", curve(0., 4., |x| (x - 1.).sqrt()), vec![1., 4.]),
        ("ends where it is undefined", curve(0., 4., |x| (2. - x).sqrt()), vec![0., 2.]),
        ("a step", curve(0., 1., |x| if x < 0.3 { 1. } else { -1. }), vec![0., 0.3]),
        ("a step to zero", curve(0., 1., |x| if x < 0.3 { -1. } else { 0. }), vec![0.3, 1.]),
        ("nowhere", curve(0., 1., |_| f64::NAN), vec![]),
        ("negative only", curve(0., 1., |_| -1.), vec![]),
    ] {
        let got = found(&curve.inside);
        assert_eq!(got.len(), expected.len(), "{name}: {got:?}");
        for (g, e) in got.iter().zip(&expected) {
            assert!((g - e).abs() <= 4. * f64::EPSILON * e.abs().max(0.1), "{name}: {got:?}");
        }
    }
}

#[test]
fn poles_and_jumps_are_never_joined() {
    let joined = |curve: &Curve, at: f64| curve.runs.iter().any(|run| run[0][0] < at && run[run.len() - 1][0] > at);
    let tangent = curve(0., 4., f64::tan);
    assert!(tangent.pole && !joined(&tangent, std::f64::consts::FRAC_PI_2) && tangent.runs.len() == 2);
    let inverse = curve(-1., 1., |x| 1. / x);
    assert!(inverse.pole && !joined(&inverse, 1e-300) && !joined(&inverse, -1e-300));
    let even = curve(-1., 1., |x| 1. / ((x - 0.0123) * (x - 0.0123)));
    assert!(even.pole, "a pole without change of sign");
    let step = curve(0., 10., |x| x.floor() / 10.);
    assert!(
        !step.pole && step.runs.len() == 10 + usize::from(step.runs.last().unwrap().len() == 1),
        "{}",
        step.runs.len()
    );
    let gap = curve(-2., 2., |x| (x * x - 1.).sqrt());
    assert!(gap.undefined && gap.runs.len() == 2 && !joined(&gap, 0.));
    for (name, smooth) in [
        ("steep", curve(-1., 1., |x| (1e6 * (x - 0.1)).atan())),
        ("a crease", curve(-1., 1., |x| (x - 0.1).abs())),
        ("a root", curve(0., 1., f64::sqrt)),
        ("a peak", curve(-1., 1., |x| (-1e5 * x * x).exp())),
    ] {
        assert!(!smooth.pole && smooth.runs.len() == 1, "{name}: {} runs", smooth.runs.len());
    }
}

/// [P95] Fig. 1: a segment as the intersection of two rays, by three systems of R-functions.
#[test]
fn the_trio_of_fig_1_shows_one_segment() {
    let rays = |x: f64| (x - 1., 3. - x);
    let alpha_1 = curve(0., 4., |x| rays(x).0.min(rays(x).1));
    let alpha_0 = curve(0., 4., |x| {
        let (f, g) = rays(x);
        f + g - (f * f + g * g).sqrt()
    });
    let m_1 = curve(0., 4., |x| {
        let (f, g) = rays(x);
        (f + g - (f * f + g * g).sqrt()) * (f * f + g * g).sqrt()
    });
    let titles = ["(a)  α = 1", "(b)  α = 0", "(c)  m = 1"];
    let graphs: Vec<Graph> = [alpha_1, alpha_0, m_1]
        .into_iter()
        .zip(titles)
        .map(|(curve, title)| Graph { title: title.into(), name: "f".into(), curve, range: None })
        .collect();
    for graph in &graphs {
        let [segment] = graph.curve.inside.as_slice() else { panic!("{}: {:?}", graph.title, graph.curve.inside) };
        assert!((segment[0] - 1.).abs() < 1e-12 && (segment[1] - 3.).abs() < 1e-12, "{segment:?}");
    }
    let image = stack(&graphs, &Axis::new("x1", 0., 4.), 560, 760).unwrap();
    assert_eq!((image.width, image.height), (560, 760));
    look(&image, "trio");
    // The segment's colour spans half of the axis in each of the three plots.
    let red = |j: usize| (0..560).filter(|&i| image.pixel(i, j) == [214, 69, 45, 255]).count();
    let rows: Vec<usize> = (0..760).filter(|&j| red(j) > 180).collect();
    let bands = 1 + rows.windows(2).filter(|pair| pair[1] > pair[0] + 1).count();
    assert_eq!(bands, 3, "{rows:?}");
}

#[test]
fn any_function_can_be_drawn() {
    let cases: [(&str, Curve); 8] = [
        ("tan", curve(-6., 6., f64::tan)),
        ("inverse", curve(-1., 1., |x| 1. / x)),
        ("logarithm", curve(-1., 5., f64::ln)),
        ("nowhere", curve(0., 1., |_| f64::NAN)),
        ("huge", curve(0., 1., |x| 1e300 * (x - 0.5))),
        ("infinite", curve(0., 1., |_| f64::INFINITY)),
        ("wild", curve(-1., 1., |x| (1. / x).sin())),
        ("floor", curve(0., 6., |x| 3. - x.floor())),
    ];
    for (name, curve) in cases {
        let graph = Graph { title: name.into(), name: "gob_f".into(), curve, range: None };
        let image = stack(&[graph], &Axis::new("x1", -1., 1.), 10, 10).unwrap();
        assert_eq!(image.rgba.len(), 400, "{name}");
    }
    let graph = |name: &str, lo: f64, hi: f64, f: fn(f64) -> f64| {
        let graph = Graph { title: name.into(), name: "f".into(), curve: curve(lo, hi, f), range: None };
        look(&stack(&[graph], &Axis::new("x1", lo, hi), 640, 480).unwrap(), name);
    };
    graph("tan", -6., 6., f64::tan);
    graph("logarithm", -1., 5., f64::ln);
    graph("floor", 0., 6., |x| 3. - x.floor());
    graph("wild", -1., 1., |x| (1. / x).sin());
    graph("small", -2e-7, 2e-7, |x| 3e8 * x * x + 1e-6);
}
