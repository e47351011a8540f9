//! Plots: what is found on a function, and that it is drawn where it belongs.

use super::solids::{Ex, shape_of};
use yont::interrupt::Interrupt;
use yont::picture::axes::{Axis, around, number, ticks};
use yont::picture::axes_space::behind;
use yont::picture::contours::{Map, draw, levels};
use yont::picture::extent::Extent;
use yont::picture::graph::{Curve, Graph, follow, stack};
use yont::picture::image::Image;
use yont::picture::isolines::Field;
use yont::picture::legend::{Legend, Telling, beside, member_colour};
use yont::picture::palette::Palette;
use yont::picture::plot::Window;
use yont::picture::raycast::{Space, Style, raycast};
use yont::picture::sheet::{Heading, SheetError, compose};
use yont::picture::{Camera, View};
use yont::picture::{contours, graph};
use yont::vm::Demand;

/// Where `YONT_LOOK` names a folder, the pictures of these tests are left there to be looked at.
fn look(image: &Image, name: &str) {
    if let Ok(folder) = std::env::var("YONT_LOOK") {
        let mut bytes = Vec::new();
        yont::export::apng::write(std::slice::from_ref(image), 1., &mut bytes).expect("memory is enough");
        std::fs::write(format!("{folder}/{name}.png"), bytes).expect("the folder is there");
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
    let show = |name: &str, lo: f64, hi: f64, f: fn(f64) -> f64| {
        let graph = Graph { title: name.into(), name: "f".into(), curve: curve(lo, hi, f), range: None };
        look(&stack(&[graph], &Axis::new("x1", lo, hi), 640, 480).unwrap(), name);
    };
    show("tan", -6., 6., f64::tan);
    show("logarithm", -1., 5., f64::ln);
    show("floor", 0., 6., |x| 3. - x.floor());
    show("wild", -1., 1., |x| (1. / x).sin());
    show("small", -2e-7, 2e-7, |x| 3e8 * x * x + 1e-6);
}

fn window(lo: f64, hi: f64) -> Window {
    Window { lo: [lo, lo], hi: [hi, hi] }
}

fn field(window: Window, n: usize, f: impl Fn(f64, f64) -> f64) -> Field {
    Field::sample(window, n, n, &mut |x, y, out| (0..out.len()).for_each(|i| out[i] = f(x[i], y[i])))
}

/// [P95] Fig. 3: the intersection of two half-planes by the R-function with alpha = 0.
fn corner(x: f64, y: f64) -> f64 {
    x + y - (x * x + y * y).sqrt()
}

#[test]
fn isolines_lie_on_their_level_and_end_only_at_the_edge() {
    let area = window(-2., 2.);
    for (name, f, levels) in [
        ("corner", corner as fn(f64, f64) -> f64, vec![-2., -1., 0., 0.5]),
        ("circles", |x, y| 1.5 - x * x - y * y, vec![-1., 0., 1.]),
        ("saddle", |x, y| x * y, vec![-0.5, 0., 0.5]),
        ("waves", |x: f64, y: f64| (3. * x).sin() * (3. * y).cos(), vec![-0.3, 0.1, 0.6]),
    ] {
        let field = field(area, 161, f);
        for level in levels {
            let lines = field.lines(level);
            assert!(!lines.is_empty(), "{name} {level}");
            for line in lines {
                let worst = line.points.iter().map(|p| (f(p[0], p[1]) - level).abs()).fold(0., f64::max);
                assert!(worst < 4e-3, "{name} {level}: off by {worst}");
                let at_edge = |p: &[f64; 2]| p.iter().any(|c| c.abs() > 2. - 1e-12);
                let ends = [&line.points[0], &line.points[line.points.len() - 1]];
                assert!(line.closed || ends.iter().all(|p| at_edge(p)), "{name} {level}: {ends:?}");
            }
        }
    }
}

#[test]
fn isolines_of_circles_are_one_closed_line_of_the_right_length() {
    let field = field(window(-2., 2.), 201, |x, y| 4. - x * x - y * y);
    for radius in [0.5, 1., 1.7_f64] {
        let lines = field.lines(4. - radius * radius);
        let [circle] = lines.as_slice() else { panic!("{} lines", lines.len()) };
        let next = circle.points.iter().cycle().skip(1);
        let length: f64 = circle.points.iter().zip(next).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).sum();
        assert!(circle.closed && (length / (std::f64::consts::TAU * radius) - 1.).abs() < 1e-3, "{length}");
    }
}

#[test]
fn isolines_keep_away_from_undefined_samples() {
    let field = field(window(-1., 1.), 41, |x, y| if x > 0.3 { f64::NAN } else { y });
    let lines = field.lines(0.01);
    assert_eq!(lines.len(), 1);
    assert!(!lines[0].closed && lines[0].points.iter().all(|p| p[0] <= 0.3 + 1e-12));
    assert!(field.value([0.5, 0.]).is_nan() && field.value([9., 0.]).is_nan());
    assert!((field.value([-0.513, 0.247]) - 0.247).abs() < 1e-12);
}

fn map(title: &str, levels: Vec<f64>, palette: Option<Palette>) -> Map {
    Map { title: title.into(), names: ["x1".into(), "x2".into()], value: "f".into(), levels, palette, labels: true }
}

#[test]
fn the_map_of_fig_3_has_a_bold_corner_at_the_origin() {
    let field = field(window(-2., 2.), 301, corner);
    let steps = levels(&field, 15);
    assert!(steps.contains(&0.), "{steps:?}");
    let lines = draw(&field, &map("x1 ≥ 0 and x2 ≥ 0, α = 0", steps.clone(), None), 600, 600).unwrap();
    look(&lines, "fig3-lines");
    let filled = draw(&field, &map("x1 ≥ 0 and x2 ≥ 0, α = 0", steps, Some(Palette::Diverging)), 720, 600).unwrap();
    look(&filled, "fig3-map");
    look(&draw(&field, &map("large", levels(&field, 20), Some(Palette::Viridis)), 1600, 1200).unwrap(), "large");
    look(&draw(&field, &map("small", levels(&field, 6), Some(Palette::Diverging)), 240, 180).unwrap(), "tiny");
    assert_eq!([filled.width, filled.height, lines.width, lines.height], [720, 600, 600, 600]);
    // The positive quarter of the map is warm, the rest cold; the lines' picture is dark along the bold corner's two sides.
    let warm = filled.rgba.as_chunks::<4>().0.iter().filter(|p| p[0] > p[2].saturating_add(8)).count();
    let cold = filled.rgba.as_chunks::<4>().0.iter().filter(|p| p[2] > p[0].saturating_add(8)).count();
    assert!(warm > 20_000 && cold > 2 * warm, "{warm} {cold}");
}

#[test]
fn compiled_shapes_give_what_closures_give_with_any_number_of_threads() {
    let alpha_0 = |x: Ex, y: Ex| x.clone() + y.clone() - (x.squared() + y.squared()).sqrt();
    let plane = shape_of(|x, y, _| alpha_0(x, y), 2, Demand::Value);
    let area = window(-2., 2.);
    let by_threads = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| Field::of(&plane, area, 301, 301, &Interrupt::default())).unwrap()
    };
    let (one, cost) = by_threads(1);
    assert_eq!(one, field(area, 301, corner));
    assert_eq!((cost.points, cost.undefined), (301 * 301, 0));
    assert!([2, 8].into_iter().all(|count| by_threads(count) == (one.clone(), cost.clone())));

    let segment = shape_of(|x, _, _| alpha_0(x.clone() - 1., 3. - x), 1, Demand::Value);
    let (compiled, cost) = graph::of(&segment, 0., 4., 400, &Interrupt::default()).unwrap();
    assert_eq!(compiled, curve(0., 4., |x| corner(x - 1., 3. - x)));
    assert!(cost.points > 400);

    let stopped = Interrupt::default();
    stopped.cancel();
    assert!(graph::of(&segment, 0., 4., 400, &stopped).is_err() && Field::of(&plane, area, 9, 9, &stopped).is_err());
}

#[test]
fn a_group_of_sections_is_told_apart_by_its_key() {
    let sections =
        |k: usize| field(window(-2., 2.), 101, move |x, y| 0.4 * (k + 1) as f64 - (x - 0.2 * k as f64).hypot(y));
    let members: Vec<Field> = (0..4).map(sections).collect();
    let telling = Telling::names((0..4).map(|k| format!("x4 = {}", number(0.5 * k as f64))));
    let image = contours::group(&members, &telling, 0., &map("sections", vec![], None), [640, 480]).unwrap();
    look(&image, "sections");
    let curves: Vec<Curve> = (0..3).map(|k| curve(-1., 1., move |x| (k as f64 + 1.) * x + 0.2 * k as f64)).collect();
    let telling = Telling::names((0..3).map(|k| format!("x4 = {k}")));
    let graph = Graph { title: "curves".into(), name: "gob_f".into(), ..Graph::default() };
    let curves = graph::group(&curves, &telling, &graph, &Axis::new("x1", -1., 1.), [640, 480]).unwrap();
    look(&curves, "curves");
    for (picture, count) in [(&image, 4), (&curves, 3)] {
        for k in 0..8 {
            let colour = member_colour(k);
            let drawn = picture.rgba.as_chunks::<4>().0.iter().filter(|p| **p == colour).count();
            assert_eq!(drawn > 100, k < count, "colour {k}: {drawn} pixels");
        }
    }
}

#[test]
fn maps_of_anything_are_drawn() {
    let wild = field(Window { lo: [-3., -1.], hi: [3., 1.] }, 200, |x, y| {
        (x * x + y * y).ln() * (5. * x).sin() + (0.9 - y).sqrt()
    });
    let picture =
        draw(&wild, &map("a wide window with an undefined strip", levels(&wild, 8), Some(Palette::Viridis)), 800, 400);
    look(&picture.unwrap(), "wide");
    let spots = field(window(-3., 3.), 240, |x, y| {
        [(-1., -1., 1.), (1.2, 0.4, 0.7), (-0.5, 1.6, -0.8)]
            .iter()
            .map(|(a, b, h)| h * (-((x - a).powi(2) + (y - b).powi(2))).exp())
            .sum()
    });
    look(&draw(&spots, &map("hills", levels(&spots, 12), Some(Palette::Diverging)), 640, 480).unwrap(), "hills");
    for f in [|_, _| f64::NAN, |_, _| 3., |_, _| f64::INFINITY, |x: f64, y: f64| 1. / (x * y), |x: f64, _| 1e300 * x] {
        let field = field(window(-1., 1.), 9, f);
        for palette in [None, Some(Palette::Diverging)] {
            let image = draw(&field, &map("any", levels(&field, 5), palette), 64, 48).unwrap();
            assert_eq!(image.rgba.len(), 4 * 64 * 48);
        }
    }
}

#[test]
fn a_legend_shows_both_ends_of_its_palette() {
    let picture = Image::new(320, 240, [255, 255, 255]);
    let legend = Legend::new("x6", -1.5, 2.5, Palette::Spectrum);
    let image = beside(&picture, &Telling::values([], legend.clone()), None).unwrap();
    look(&image, "legend");
    let has = |t: f64| {
        let want = Palette::Spectrum.colour(t);
        image.rgba.as_chunks::<4>().0.iter().any(|p| (0..3).all(|k| p[k].abs_diff(want[k]) <= 6))
    };
    assert!(image.width > 320 && image.height == 240 && has(0.) && has(0.5) && has(1.));
    let banded = Legend { levels: vec![0., 1.], ..legend };
    assert_eq!(banded.colour(0.1), banded.colour(0.9));
    assert_ne!(banded.colour(0.9), banded.colour(1.1));
}

#[test]
fn a_sheet_has_each_picture_in_its_row_and_column() {
    let heading = |name: &str, values: &[f64]| Heading { name: name.into(), values: values.to_vec() };
    let (columns, rows) = (heading("x5", &[-1., 0., 0.5, 1.]), heading("x6", &[10., 20., 30.]));
    let colour = |k: usize| [20 * k as u8, 255 - 20 * k as u8, 130];
    let images: Vec<Image> = (0..12).map(|k| Image::new(160, 120, colour(k))).collect();
    let sheet = compose(&images, &columns, &rows, "a sheet").unwrap();
    look(&sheet, "sheet");
    let mut last = (0, 0);
    for (k, image) in images.iter().enumerate() {
        let want = [colour(k)[0], colour(k)[1], 130, 255];
        let at: Vec<usize> = (0..sheet.width * sheet.height).filter(|i| sheet.rgba[4 * i..4 * i + 4] == want).collect();
        assert!(at.len() >= (image.width - 2) * (image.height - 2), "picture {k} is whole");
        let first = (at[0] / sheet.width, at[0] % sheet.width);
        assert!(if k % 4 == 0 { first.0 >= last.0 } else { first.0 == last.0 && first.1 > last.1 }, "picture {k}");
        last = first;
    }
    let none = Heading::default();
    assert_eq!(compose(&images, &none, &none, ""), Err(SheetError::Count { wanted: 1, given: 12 }));
    assert!(compose(&images[..1], &none, &none, "").is_ok());
    let many = heading("x5", &(0..12).map(f64::from).collect::<Vec<_>>());
    let large = vec![Image::new(4000, 1, [0; 3]); 12];
    assert!(matches!(compose(&large, &many, &none, ""), Err(SheetError::TooLarge { .. })));
}

#[test]
fn axes_stand_around_a_picture_pixel_for_pixel() {
    let mut picture = Image::new(300, 200, [200, 220, 240]);
    picture.set(0, 0, [255, 0, 0]);
    picture.set(150, 100, [1, 2, 3]);
    let image = around(&picture, &Axis::new("x1", -3., 3.), &Axis::new("x2", -2., 2.), "around").unwrap();
    look(&image, "around");
    let spot = (0..image.width * image.height).find(|i| image.rgba[4 * i..4 * i + 3] == [1, 2, 3]).unwrap();
    let (column, row) = (spot % image.width - 150, spot / image.width - 100);
    assert!((1..199).all(|j| (1..299).all(|i| image.pixel(column + i, row + j) == picture.pixel(i, j))));
}

/// A solid with the axes of its box: a picture on a transparent ground is made from one on a ground of a colour of its own.
#[test]
fn axes_stand_behind_a_solid() {
    let half = [2., 1.5, 1.];
    let shape = shape_of(|x, y, z| 1. - (x / 2.).squared() - (y / 1.5).squared() - z.squared(), 3, Demand::Sign);
    let space = Space { lo: half.map(|h: f64| -h), hi: half };
    let names = ["x1", "x2", "x3"].map(String::from);
    for (name, view) in [("default", View::default())]
        .into_iter()
        .chain(View::NAMES.map(|(name, ..)| (name, View::from_name(name).unwrap())))
    {
        let style = Style { size: [480, 360], supersample: 2, background: [[255, 0, 255]; 2], ..Style::default() };
        let camera = Camera::framing(&view, &Extent::whole(space), 480. / 360.);
        let mut picture = raycast(&shape, space, &camera, &style, &Interrupt::default()).unwrap().image;
        for pixel in picture.rgba.as_chunks_mut::<4>().0 {
            let ground = pixel[0].min(pixel[2]).saturating_sub(pixel[1]) > 60;
            pixel[3] = if ground { 0 } else { 255 };
        }
        let image = behind(&picture, &camera, space, &names, None).unwrap();
        look(&image, &format!("space-{name}"));
        let margin = (image.width - 480) / 2;
        // The outline's own edges may run along the solid where it touches its box.
        let solid: Vec<_> =
            (0..360 * 480).map(|k| (k % 480, k / 480)).filter(|&(i, j)| picture.pixel(i, j)[3] > 0).collect();
        let lost = solid.iter().filter(|&&(i, j)| image.pixel(i + margin, j + margin) != picture.pixel(i, j)).count();
        assert!(lost * 100 < solid.len(), "{name}: {lost} of {} pixels", solid.len());
        // Frames, marks and numbers are dark; the ground around the picture and the faces are not.
        let dark = |i: usize, j: usize| image.pixel(i, j)[0] < 90;
        let around = |i: usize, j: usize| {
            let inner = i.checked_sub(margin).zip(j.checked_sub(margin)).filter(|&(i, j)| i < 480 && j < 360);
            inner.is_none_or(|(i, j)| picture.pixel(i, j)[3] == 0)
        };
        let drawn = (0..image.height).flat_map(|j| (0..image.width).map(move |i| (i, j)));
        let drawn = drawn.filter(|&(i, j)| dark(i, j) && around(i, j)).count();
        assert!(drawn > 300, "{name}: {drawn} dark pixels");
    }
}
