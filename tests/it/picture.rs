//! Pictures, rays, plots and animations.

use proptest::prelude::*;
use yont::field::{Coordinate, Graph, graph::SharedLeaf};
use yont::interrupt::{Cancelled, Interrupt};
use yont::number::{Algebra, Binary, Ternary};
use yont::picture::animation::Frames;
use yont::picture::extent::Extent;
use yont::picture::plot::{Fill, Window, inside, plot};
use yont::picture::raycast::{Picture, Space, Style, framed, raycast};
use yont::picture::rays::{Hit, Scene, cast, heights};
use yont::picture::{Camera, Image, Palette, Projection, View};
use yont::vm::{Demand, Program, Shape};

use crate::solids::{Ex, HARD, KNOWN, ball, shape_of, sphere};

fn cube(half: f64) -> Space {
    Space { lo: [-half; 3], hi: [half; 3] }
}

fn views() -> Vec<View> {
    let mut views: Vec<_> = View::NAMES.iter().filter_map(|(name, ..)| View::from_name(name)).collect();
    views.push(View::default());
    views.push(View { azimuth: 4.0, elevation: -0.7, projection: Projection::Perspective(1.2) });
    views
}

/// Every ray of a picture with its hit.
fn hits(shape: &Shape, space: Space, camera: &Camera, rays: [usize; 2]) -> Vec<Option<Hit>> {
    let scene = Scene { camera: *camera, space, rays, tile: 8 };
    let (tiles, _) = cast(shape, &scene, |tile| tile.hits.to_vec(), &Interrupt::default()).expect("not cancelled");
    let mut all = vec![None; rays[0] * rays[1]];
    for (from, size, hits) in tiles {
        for (n, hit) in hits.into_iter().enumerate() {
            all[(from[1] + n / size[0]) * rays[0] + from[0] + n % size[0]] = hit;
        }
    }
    all
}

fn ray(camera: &Camera, rays: [usize; 2], n: usize) -> ([f64; 3], [f64; 3]) {
    let (i, j) = (n % rays[0], n / rays[0]);
    camera.ray(2.0 * (i as f64 + 0.5) / rays[0] as f64 - 1.0, 1.0 - 2.0 * (j as f64 + 0.5) / rays[1] as f64)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[test]
fn a_ball_is_hit_by_the_rays_and_at_the_depths_of_the_formula() {
    let (shape, rays) = (shape_of(ball, 3, Demand::Sign), [203, 150]);
    for view in views() {
        let camera = Camera::framing(&view, &Extent::whole(cube(1.0)), 203.0 / 150.0);
        let found = hits(&shape, cube(1.3), &camera, rays);
        for (n, hit) in found.iter().enumerate() {
            let (o, d) = ray(&camera, rays, n);
            let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o) - 1.0);
            let discriminant = b * b - a * c;
            // A ray that misses or pierces by less than 1e-10 of the radius is a tie.
            if discriminant.abs() / (a * dot(o, o)) < 1e-10 {
                continue;
            }
            assert_eq!(hit.is_some(), discriminant > 0.0, "{view:?}, ray {n}: {discriminant}");
            if let Some(hit) = hit {
                let depth = (-b - discriminant.sqrt()) / a;
                assert!((hit.depth - depth).abs() < 1e-9 && !hit.cap, "{view:?}: {} for {depth}", hit.depth);
                let point: [f64; 3] = std::array::from_fn(|k| o[k] + hit.depth * d[k]);
                assert!((dot(hit.normal, point) - 1.0).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn a_torus_is_hit_where_a_fine_march_finds_it() {
    let torus = |p: [f64; 3]| 0.09 - ((p[0] * p[0] + p[1] * p[1]).sqrt() - 0.8).powi(2) - p[2] * p[2];
    let case = KNOWN.iter().find(|case| case.name == "torus").expect("a torus");
    let space = Space { lo: case.half.map(|h| -h), hi: case.half };
    let (rays, camera) = ([64, 48], Camera::framing(&View::default(), &Extent::whole(space), 64.0 / 48.0));
    for (n, hit) in hits(&case.shape(), space, &camera, rays).iter().enumerate() {
        let (o, d) = ray(&camera, rays, n);
        let at = |t: f64| torus(std::array::from_fn(|k| o[k] + t * d[k]));
        let (near, far) = camera.depths(space.lo, space.hi);
        let step = (far - near) / 20_000.0;
        let first = (0..20_000).map(|s| near + step * f64::from(s)).find(|&t| at(t) >= 0.0);
        match (first, hit) {
            (Some(t), Some(hit)) => {
                assert!(
                    (t - step..=t).contains(&hit.depth) || at(hit.depth).abs() < 1e-9,
                    "ray {n}: {} {t}",
                    hit.depth
                );
            }
            (None, Some(hit)) => assert!(at(hit.depth).abs() < 1e-6, "ray {n}"),
            (Some(t), None) => panic!("ray {n} misses the torus at {t}"),
            (None, None) => {}
        }
    }
}

#[test]
fn faces_of_the_space_cap_the_object() {
    let rays = [90, 90];
    for view in views() {
        let camera = Camera::framing(&view, &Extent::whole(cube(0.8)), 1.0);
        let found = hits(&shape_of(ball, 3, Demand::Sign), cube(0.8), &camera, rays);
        let mut caps = 0;
        for (n, hit) in found.iter().enumerate().filter_map(|(n, hit)| Some((n, hit.as_ref()?))) {
            let (o, d) = ray(&camera, rays, n);
            let point: [f64; 3] = std::array::from_fn(|k| o[k] + hit.depth * d[k]);
            let face = (0..3).find(|&k| (point[k].abs() - 0.8).abs() < 1e-9);
            if hit.cap {
                caps += 1;
                let k = face.expect("a cap lies on a face");
                assert_eq!(hit.normal[k], point[k].signum());
                assert!(dot(point, point) <= 1.0 + 1e-9);
            } else {
                assert!((dot(point, point) - 1.0).abs() < 1e-9);
            }
        }
        assert!(caps > 1000, "{view:?}: {caps}");
    }
}

#[test]
fn steps_and_undefined_outsides_have_boundaries_without_holes() {
    for name in ["ball behind a function that is undefined beyond it", "ball with a step for a boundary"] {
        let case = KNOWN.iter().find(|case| case.name == name).expect(name);
        let rays = [80, 60];
        let camera = Camera::framing(&View::default(), &Extent::whole(cube(1.0)), 4.0 / 3.0);
        for (n, hit) in hits(&case.shape(), cube(1.2), &camera, rays).iter().enumerate() {
            let (o, d) = ray(&camera, rays, n);
            let discriminant = dot(o, d).powi(2) - dot(d, d) * (dot(o, o) - 1.0);
            // Without a slope outside nothing leads to a ray that grazes the ball for less than a sample's spacing.
            if discriminant.abs() / (dot(d, d) * dot(o, o)) > 1e-3 {
                assert_eq!(hit.is_some(), discriminant > 0.0, "{name}: ray {n}");
            }
            if let Some(hit) = hit {
                let point: [f64; 3] = std::array::from_fn(|k| o[k] + hit.depth * d[k]);
                assert!((dot(point, point) - 1.0).abs() < 1e-8 && (dot(hit.normal, hit.normal) - 1.0).abs() < 1e-9);
            }
        }
    }
}

fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool").install(work)
}

fn shot(shape: &Shape, space: Space, style: &Style) -> Picture {
    let interrupt = Interrupt::default();
    let extent = Extent::of(shape, space, &interrupt).expect("not cancelled");
    raycast(shape, space, &framed(&View::default(), &extent, style), style, &interrupt).expect("not cancelled")
}

#[test]
fn the_bytes_do_not_depend_on_the_threads() {
    for supersample in [1, 3] {
        let style = Style { size: [71, 43], supersample, ..Style::default() };
        for case in KNOWN {
            let space = Space { lo: case.half.map(|h| -h), hi: case.half };
            let [one, four] = [1, 4].map(|n| with_threads(n, || shot(&case.shape(), space, &style).image));
            assert!(one == four, "{}", case.name);
        }
    }
}

#[test]
fn the_background_is_where_nothing_is() {
    let style = Style { size: [40, 30], ..Style::default() };
    let empty = shape_of(|x, y, z| ball(x, y, z) - 2.0, 3, Demand::Sign);
    let picture = shot(&empty, cube(1.0), &style);
    assert_eq!(picture.hits, 0);
    let [top, bottom] = style.background.map(|[r, g, b]| [r, g, b, 255]);
    assert_eq!((picture.image.pixel(0, 0), picture.image.pixel(39, 29)), (top, bottom));
    let ball = shot(&shape_of(ball, 3, Demand::Sign), cube(1.0), &style);
    assert_eq!(ball.image.pixel(0, 0), top);
    assert_ne!(ball.image.pixel(20, 15), picture.image.pixel(20, 15));
}

#[test]
fn every_camera_sees_the_whole_object_and_fills_the_picture() {
    let points = Extent::whole(Space { lo: [-3.0, 1.0, 2.0], hi: [4.0, 3.0, 2.5] });
    for view in views() {
        for aspect in [0.5, 1.0, 2.3] {
            let camera = Camera::framing(&view, &points, aspect);
            let mut widest = 0.0_f64;
            for p in &points {
                let offset: [f64; 3] = std::array::from_fn(|k| p[k] - camera.eye[k]);
                let depth = dot(offset, camera.forward);
                assert!(depth > 0.0, "{view:?}: behind the eye");
                for (axis, k) in [(camera.right, 0), (camera.up, 1)] {
                    let place = dot(offset, axis) / (camera.base[k] + depth * camera.growth[k]);
                    widest = widest.max(place.abs());
                }
            }
            assert!((0.85..=0.95).contains(&widest), "{view:?} {aspect}: {widest}");
        }
    }
}

#[test]
fn views_look_along_their_axes_with_z_up() {
    let axes = |name: &str| View::from_name(name).expect(name).axes();
    assert_eq!(axes("front"), [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]);
    assert_eq!(axes("TOP"), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]);
    assert_eq!(axes("right"), [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]]);
    assert!(axes("iso")[2].iter().all(|v| (v.abs() - 1.0 / 3.0_f64.sqrt()).abs() < 1e-12));
    assert_eq!(View::from_name("90,0").expect("angles").axes()[2], [-1.0, 0.0, 0.0]);
    for wrong in ["sideways", "1", "1,2,3,4", "1,2,inf", "0,91", "nan,0"] {
        assert_eq!(View::from_name(wrong), None, "{wrong}");
    }
}

#[test]
fn extents_hold_the_object_closely() {
    for case in KNOWN {
        let space = Space { lo: case.half.map(|h| -h), hi: case.half };
        let extent = Extent::of(&case.shape(), space, &Interrupt::default()).expect("not cancelled");
        let bounds = extent.bounds().expect("not empty");
        let mesh = case.extract(24).mesh;
        for p in &mesh.positions {
            assert!((0..3).all(|k| bounds.lo[k] <= p[k] && p[k] <= bounds.hi[k]), "{}: {p:?}", case.name);
        }
    }
    let round = Extent::of(&shape_of(ball, 3, Demand::Sign), cube(2.0), &Interrupt::default()).expect("not cancelled");
    assert_eq!(round.bounds(), Some(cube(1.0 + 2.0 / 32.0)));
    let empty = shape_of(|x, y, z| ball(x, y, z) - 2.0, 3, Demand::Sign);
    assert!(Extent::of(&empty, cube(2.0), &Interrupt::default()).expect("not cancelled").is_empty());
}

#[test]
fn a_cancelled_picture_stops() {
    let interrupt = Interrupt::default();
    interrupt.cancel();
    let shape = shape_of(ball, 3, Demand::Sign);
    let camera = Camera::framing(&View::default(), &Extent::whole(cube(1.0)), 1.0);
    let result = raycast(&shape, cube(1.0), &camera, &Style::default(), &interrupt);
    assert_eq!(result.err(), Some(Cancelled));
    let plane = shape_of(|x, y, _| x * y, 2, Demand::Value);
    for fill in [Fill::Mono, Fill::Bands(Palette::Viridis)] {
        let window = Window { lo: [0.0; 2], hi: [1.0; 2] };
        assert_eq!(plot(&plane, window, [64, 64], fill, &interrupt).err(), Some(Cancelled));
    }
}

fn ring(x: Ex, y: Ex, _: Ex) -> Ex {
    let ring = 0.06 - ((x.squared() + y.squared()).sqrt() - 0.7).squared();
    ring.ternary(Ternary::Union, &((0.15 - x.abs()).min(&(0.9 - y.abs()))), 0.0)
}

const WINDOW: Window = Window { lo: [-1.2, -1.0], hi: [1.3, 0.9] };

#[test]
fn mono_plots_are_dense_sampling_at_the_middles_of_the_pixels() {
    // The last size is cut into tasks of another size.
    for size in [[131, 97], [16, 16], [2100, 33]] {
        mono(size);
    }
}

fn mono(size: [usize; 2]) {
    let shape = shape_of(ring, 2, Demand::Sign);
    let [one, three] = [1, 3].map(|n| {
        with_threads(n, || plot(&shape, WINDOW, size, Fill::Mono, &Interrupt::default()).expect("a plot").image)
    });
    assert!(one == three);
    let (signs, _) = inside(&shape, WINDOW, size, &Interrupt::default()).expect("not cancelled");
    let dense = |x: f64, y: f64| {
        let ring = 0.06 - ((x * x + y * y).sqrt() - 0.7).powi(2);
        ring.max((0.15 - x.abs()).min(0.9 - y.abs())) >= 0.0
    };
    for j in 0..size[1] {
        for i in 0..size[0] {
            let x = -1.2 + (i as f64 + 0.5) * 2.5 / size[0] as f64;
            let y = 0.9 - (j as f64 + 0.5) * 1.9 / size[1] as f64;
            assert_eq!(signs[j * size[0] + i], dense(x, y), "({i}, {j})");
            let colour = if dense(x, y) { [0, 0, 0, 255] } else { [255; 4] };
            assert_eq!(one.pixel(i, j), colour, "({i}, {j})");
        }
    }
}

/// The pixel whose middle is nearest to a point.
fn pixel_at(image: &Image, x: f64, y: f64) -> [u8; 4] {
    let part = |v: f64, lo: f64, hi: f64, n: usize| (((v - lo) / (hi - lo) * n as f64) as usize).min(n - 1);
    let i = part(x, WINDOW.lo[0], WINDOW.hi[0], image.width);
    image.pixel(i, image.height - 1 - part(y, WINDOW.lo[1], WINDOW.hi[1], image.height))
}

#[test]
fn coloured_plots_tell_inside_outside_and_boundary_apart() {
    for palette in [Palette::Plain, Palette::Viridis, Palette::Spectrum] {
        let fill = Fill::of(palette);
        let shape = shape_of(ring, 2, if fill.needs_values() { Demand::Value } else { Demand::Sign });
        let image = plot(&shape, WINDOW, [250, 190], fill, &Interrupt::default()).expect("a plot").image;
        let (inside, outside) = (pixel_at(&image, 0.7, 0.0), pixel_at(&image, 0.4, 0.0));
        let edge = pixel_at(&image, 0.7 - 0.06_f64.sqrt(), 0.0);
        let light = |p: [u8; 4]| p[..3].iter().map(|&v| u32::from(v)).sum::<u32>();
        assert!(
            light(outside) > light(inside) && light(inside) > light(edge),
            "{palette:?} {outside:?} {inside:?} {edge:?}"
        );
    }
}

#[test]
fn palettes_have_names_and_ends() {
    for (name, palette) in Palette::NAMES {
        assert_eq!(Palette::from_name(&name.to_uppercase()), Some(palette));
        assert_eq!(palette.colour(-5.0), palette.colour(0.0));
        assert_eq!(palette.colour(7.0), palette.colour(1.0));
        assert_ne!(palette.colour(0.0), palette.colour(1.0));
    }
    assert_eq!(Palette::Grey.colour(0.5), [128; 3]);
    assert_eq!(Palette::from_name("plaid"), None);
}

/// A ball of radius^2 x4 that moves along x1 with x4.
fn moving_ball() -> Shape {
    let mut graph = Graph::new();
    let [x, y, z, t] = [1, 2, 3, 4].map(|k| graph.coordinate(Coordinate(k)));
    let u = graph.binary(Binary::Sub, x, t);
    let mut rest = t;
    for e in [u, y, z] {
        let square = graph.binary(Binary::Mul, e, e);
        rest = graph.binary(Binary::Sub, rest, square);
    }
    let inputs = [1, 2, 3, 4].map(Coordinate);
    let program = Program::compile(&graph, rest, &inputs, Demand::Sign, &Default::default()).expect("compiles");
    Shape::new(program, 3, vec![0.0])
}

#[test]
fn all_frames_share_one_program_and_one_camera() {
    let (shape, interrupt) = (moving_ball(), Interrupt::default());
    let frames = Frames { shape: &shape, input: 0, values: &[-1.0, 0.25, 1.0], space: cube(2.5) };
    let style = Style { size: [60, 45], ..Style::default() };
    let view = View::from_name("front").expect("a view");
    let camera = frames.camera(&view, &style, &interrupt).expect("not cancelled");
    let images = frames.images(&view, &style, &interrupt).expect("not cancelled");
    assert_eq!(images.len(), 3);
    for (frame, image) in images.iter().enumerate() {
        assert!(std::sync::Arc::ptr_eq(&frames.shape(frame).program, &shape.program));
        assert!(frames.picture(frame, &camera, &style, &interrupt).expect("not cancelled").image == *image);
    }
    // The ball is empty at first, small in the middle, and fills the height at last: its disc has four times the area and twice the edge,
    // through which more rays go.
    let met = |frame| frames.picture(frame, &camera, &style, &interrupt).expect("not cancelled").hits;
    assert!(met(0) == 0 && met(1) > 0 && met(2) > 2 * met(1));
}

#[test]
fn volumes_are_seen_with_faces_of_nearest_samples_flat() {
    use std::sync::Arc;
    use yont::data::{Interpolation, Placement, Samples, Volume};
    let samples = (0..27).map(|n| if n == 13 { 1.0 } else { -1.0 }).collect();
    let volume = Volume::new("dot", &[3; 3], Placement::default(), Samples::Doubles(samples)).expect("a grid");
    let mut graph = Graph::new();
    let axes = [1, 2, 3].map(|k| graph.coordinate(Coordinate(k)));
    let leaf = SharedLeaf(Arc::new(volume).leaf(Interpolation::Nearest).expect("finite samples"));
    let root = graph.leaf(leaf, &axes);
    let program = Program::compile(&graph, root, &[1, 2, 3].map(Coordinate), Demand::Sign, &Default::default())
        .expect("compiles");
    let (space, rays) = (Space { lo: [0.0; 3], hi: [2.0; 3] }, [64, 64]);
    let camera = Camera::framing(&View::default(), &Extent::whole(space), 1.0);
    let found: Vec<Hit> =
        hits(&Shape::new(program, 3, Vec::new()), space, &camera, rays).into_iter().flatten().collect();
    let flat = found.iter().filter(|hit| hit.normal.iter().any(|v| v.abs() > 1.0 - 1e-6)).count();
    assert!(found.len() > 200 && flat * 5 > found.len() * 4, "{flat} of {}", found.len());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    /// Thin plates and grazing rays: whatever a dense march along the ray finds is found.
    #[test]
    fn no_ray_misses_a_thin_ellipsoid(a in 0.02..0.9_f64, b in 0.2..0.9_f64, azimuth in 0.0..6.2_f64, elevation in -1.5..1.5_f64) {
        let shape = shape_of(|x, y, z| 1.0 - ((x / a).squared() + (y / b).squared() + z.squared()), 3, Demand::Sign);
        let view = View { azimuth, elevation, ..View::default() };
        let (rays, camera) = ([48, 48], Camera::framing(&view, &Extent::whole(cube(1.0)), 1.0));
        for (n, hit) in hits(&shape, cube(1.1), &camera, rays).iter().enumerate() {
            let (o, d) = ray(&camera, rays, n);
            let scale = |v: [f64; 3]| [v[0] / a, v[1] / b, v[2]];
            let (o, d) = (scale(o), scale(d));
            let discriminant = dot(o, d).powi(2) - dot(d, d) * (dot(o, o) - 1.0);
            if discriminant.abs() / (dot(d, d) * dot(o, o)) > 1e-9 {
                prop_assert_eq!(hit.is_some(), discriminant > 0.0);
            }
        }
    }
}

#[test]
fn sampled_fields_hold_the_function_at_their_corners() {
    use yont::picture::field::sample;
    let shape = shape_of(|x, y, z| x + 10.0 * y + 100.0 * z, 3, Demand::Value);
    let field =
        sample(&shape, &[(-1.0, 3.0), (0.0, 1.0), (2.0, 4.0)], 8, &Interrupt::default()).expect("not cancelled");
    assert_eq!((&field.size[..], &field.spacing[..]), (&[9, 3, 5][..], &[0.5, 0.5, 0.5][..]));
    for (n, value) in field.samples.iter().enumerate() {
        let index = [n % 9, n / 9 % 3, n / 27].map(|i| i as f64 * 0.5);
        assert_eq!(f64::from(*value), (index[0] - 1.0) + 10.0 * index[1] + 100.0 * (index[2] + 2.0));
    }
    let plane = shape_of(|x, y, _| x - y, 2, Demand::Value);
    let field = sample(&plane, &[(0.0, 1.0), (0.0, 0.001)], 4, &Interrupt::default()).expect("not cancelled");
    assert_eq!(field.size, [5, 2]);
}

#[test]
fn shadows_fall_on_what_lies_behind_and_on_nothing_else() {
    use yont::picture::shadow::Shadows;
    // A plate |x|, |y| <= 0.5 at z = 0.5 over a floor at z = -0.5; the light stands straight above.
    let shape = shape_of(
        |x, y, z| {
            let plate = (0.5 - x.abs()).min(&(0.5 - y.abs())).min(&(0.1 - (z.clone() - 0.5).abs()));
            plate.max(&(-0.5 - z))
        },
        3,
        Demand::Sign,
    );
    let (shadows, _) =
        Shadows::cast(&shape, cube(1.0), [0.0, 0.0, 1.0], 128, &Interrupt::default()).expect("not cancelled");
    let up = [0.0, 0.0, 1.0];
    for (x, y) in [(0.0, 0.0), (0.4, -0.4), (0.7, 0.0), (-0.9, 0.9), (0.1, -0.6)] {
        let covered = f64::max(f64::abs(x), f64::abs(y)) < 0.5;
        assert_eq!(shadows.lit([x, y, -0.5], up, 1.0), if covered { 0.0 } else { 1.0 }, "({x}, {y})");
        if covered {
            assert_eq!(shadows.lit([x, y, 0.6], up, 1.0), 1.0, "the plate shades itself at ({x}, {y})");
        }
    }
    let edge = shadows.lit([0.5, 0.0, -0.5], up, 1.0);
    assert!(edge > 0.2 && edge < 0.8, "{edge}");
}

#[test]
fn a_ball_does_not_shade_its_own_front() {
    let style = Style { size: [90, 90], ..Style::default() };
    let [with, without] =
        [0.6, 0.0].map(|shadow| shot(&shape_of(ball, 3, Demand::Sign), cube(1.1), &Style { shadow, ..style }).image);
    let apart = with.rgba.iter().zip(&without.rgba).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(apart <= Some(12), "{apart:?}");
}

/// What pixels are without a choice of rays: the mean light of 2 x 2 pixels of a picture twice as large.
fn halved(image: &Image) -> Vec<[f32; 3]> {
    use yont::picture::palette::linear;
    let share = |i: usize, j: usize| image.pixel(i, j).map(linear);
    let (width, height) = (image.width / 2, image.height / 2);
    let places = (0..width * height).map(|n| (2 * (n % width), 2 * (n / width)));
    let mean = |(i, j): (usize, usize)| {
        let four = [share(i, j), share(i + 1, j), share(i, j + 1), share(i + 1, j + 1)];
        std::array::from_fn(|k| four.iter().map(|light| light[k]).sum::<f32>() / 4.0)
    };
    places.map(mean).collect()
}

#[test]
fn few_rays_show_what_many_rays_show() {
    let names =
        ["ball", "box", "torus", "Steinmetz solid", "twisted bar", "ball cut by all six faces", "gyroid in a ball"];
    for case in names.map(|name| KNOWN.iter().chain(HARD).find(|case| case.name == name).expect(name)) {
        let space = Space { lo: case.half.map(|h| -h), hi: case.half };
        let style = Style { size: [120, 90], shadow: 0.0, ..Style::default() };
        let few = shot(&case.shape(), space, &style);
        let many = shot(&case.shape(), space, &Style { size: [240, 180], supersample: 1, ..style });
        let apart: Vec<f32> = halved(&many.image)
            .iter()
            .enumerate()
            .map(|(n, light)| {
                let pixel = few.image.pixel(n % 120, n / 120).map(yont::picture::palette::linear);
                (0..3).map(|k| (pixel[k] - light[k]).abs()).fold(0.0, f32::max)
            })
            .collect();
        let (mean, off) = (apart.iter().sum::<f32>() / apart.len() as f32, apart.iter().filter(|&&v| v > 0.05).count());
        assert!(mean < 0.003 && off < 108, "{}: {mean} on average, {off} pixels far off", case.name);
        assert!(few.counters.points < many.counters.points, "{}", case.name);
    }
}

#[test]
fn a_transparent_background_leaves_the_object_alone() {
    let style = Style { size: [60, 45], ..Style::default() };
    let shape = shape_of(ball, 3, Demand::Sign);
    let [clear, solid] =
        [true, false].map(|transparent| shot(&shape, cube(1.0), &Style { transparent, ..style }).image);
    let mut edges = 0;
    for (clear, solid) in clear.rgba.chunks(4).zip(solid.rgba.chunks(4)) {
        match clear[3] {
            0 => assert_eq!(clear, [0; 4]),
            255 => assert_eq!(clear, solid),
            _ => edges += 1,
        }
    }
    assert_eq!(clear.pixel(0, 0)[3], 0);
    assert_eq!(clear.pixel(30, 22)[3], 255);
    assert!((50..500).contains(&edges), "{edges}");
}

/// Balls at places without an order, so many that each part of a task gets a program of its own.
#[test]
fn many_balls_are_hit_where_the_nearest_of_them_is() {
    let turn = |i: usize, step: f64| (0.5 + step * i as f64).fract();
    let balls: Vec<([f64; 3], f64)> = (0..200)
        .map(|i| ([0.819_172_5, 0.671_043_6, 0.549_700_5].map(|s| 1.7 * turn(i, s) - 0.85), 0.03 + 0.1 * turn(i, 0.37)))
        .collect();
    let union = |x: Ex, y: Ex, z: Ex| {
        let all = balls.iter().map(|&(at, r)| sphere(at, r, [&x, &y, &z]));
        all.reduce(|a, b| a.ternary(Ternary::Union, &b, 0.0)).expect("balls")
    };
    let shape = shape_of(union, 3, Demand::Sign);
    let rays = [150, 120];
    for name in ["top", "25,-40"] {
        let camera = Camera::framing(&View::from_name(name).expect("a view"), &Extent::whole(cube(1.0)), 1.25);
        let scene = Scene { camera, space: cube(1.0), rays, tile: 8 };
        let [one, three] =
            [1, 3].map(|n| with_threads(n, || heights(&shape, &scene, 1e-9, &Interrupt::default()).expect("hits").0));
        assert_eq!(one, three);
        let mut met = 0;
        for (n, hit) in one.iter().enumerate() {
            let (start, d) = ray(&camera, rays, n);
            // Where the ray enters each ball, and how long it stays in it.
            let enter = |&(at, r): &([f64; 3], f64)| {
                let o: [f64; 3] = std::array::from_fn(|k| start[k] - at[k]);
                let (a, b, c) = (dot(d, d), dot(o, d), dot(o, o) - r * r);
                let root = (b * b - a * c).sqrt();
                (root > 0.0).then(|| ((-b - root) / a, 2.0 * root / a))
            };
            let entered: Vec<(f64, f64)> = balls.iter().filter_map(enter).collect();
            let least = |of: &dyn Fn(f64) -> bool| {
                let depths = entered.iter().filter(|(_, stay)| of(*stay)).map(|(depth, _)| *depth);
                depths.min_by(f64::total_cmp).unwrap_or(f64::INFINITY)
            };
            let depth = hit.map_or(f64::INFINITY, |hit| hit.depth);
            // What is left before a smallest box ends may be stepped over, beside other balls.
            let (first, sure) = (least(&|_| true), least(&|stay| stay > 0.15));
            assert!(first - 1e-6 <= depth && depth <= sure + 1e-6, "{name} {n}: {depth} for {first} to {sure}");
            met += usize::from((depth - first).abs() < 1e-6);
        }
        let hits = one.iter().flatten().count();
        assert!(hits > rays[0] * rays[1] / 8 && met * 1000 > hits * 995, "{name}: {met} of {hits}");
    }
}
