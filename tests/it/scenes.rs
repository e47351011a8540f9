//! Pictures of solids against closed forms: colours of objects, several in one picture, light, grounds, cuts, cameras.

use std::sync::Arc;

use yont::diagnostic::Severity;
use yont::field::Coordinate;
use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{Background, Cut, Half, Options, View, colours_at};
use yont::model::settings::{self, SETTINGS};
use yont::picture::{Image, Palette};
use yont::syntax::Mode;

use crate::outputs::{make, one, picture};
use crate::session::messages;

const SPACE: &str = "x1min=-2;x1max=2;x2min=-2;x2max=2;x3min=-2;x3max=2;";
const BALL: &str = "gob_a = 1 - x1**2 - x2**2 - x3**2;";

fn loaded(script: &str) -> Session {
    let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
    let outcome = session.input("script.geo", script, Mode::Script);
    assert!(outcome.accepted, "{script}: {}", messages(&outcome));
    session
}

fn colour(session: &mut Session, point: [f64; 3]) -> [f64; 3] {
    let colours = colours_at(session, &View::default(), Palette::Plain, &[point]).expect("colours");
    colours.expect("it has a colour")[0]
}

#[test]
fn a_colour_is_a_formula_of_parameters_and_coordinates() {
    let mut session =
        loaded(&format!("{BALL}{SPACE} k = 0.25; gob_a : COLOR = [k, x1**2, IF x3 > 0 THEN 1 ELSE 0.5];"));
    assert_eq!(colour(&mut session, [0.5, 0.0, 1.0]), [0.25, 0.25, 1.0]);
    assert_eq!(colour(&mut session, [-3.0, 0.0, -1.0]), [0.25, 1.0, 0.5], "what is above 1 counts as 1");
    assert!(session.input("line", "k = 0.75;", Mode::Prompt).accepted);
    assert_eq!(colour(&mut session, [0.0; 3]), [0.75, 0.0, 0.5], "it follows the parameter");
    session.undo();
    assert_eq!(colour(&mut session, [0.0; 3]), [0.25, 0.0, 0.5]);
    let mut scale = loaded(&format!("{BALL}{SPACE} gob_a : COLOUR = x3 IN [1, -1];"));
    for (z, t) in [(1.0, 0.0), (0.0, 0.5), (-1.0, 1.0), (-9.0, 1.0)] {
        let expected = Palette::Spectrum.colour(t).map(|v| f64::from(v) / 255.0);
        assert_eq!(colour(&mut scale, [0.0, 0.0, z]), expected, "x3 = {z}");
    }
    let mut none = loaded(&format!("{BALL}{SPACE}"));
    assert_eq!(colours_at(&mut none, &View::default(), Palette::Plain, &[[0.0; 3]]), Ok(None));
}

#[test]
fn a_colour_stands_beside_levels_and_centre_and_is_saved() {
    let mut session = loaded(&format!(
        "{BALL}{SPACE} gob_a : G = [0, 0.5]; gob_a : CENTER = [0, 0, 0]; gob_a : colour = [1, 0, 0]; gob_a : COLOR = x3 in [0, 2,];"
    ));
    let object = session.object(None).expect("an object");
    assert_eq!((object.levels.len(), object.center, object.colour.is_some()), (2, Some(vec![0.0; 3]), true));
    let saved = session.save();
    assert!(saved.contains("gob_a : COLOR = x3 in [0, 2,]") && !saved.contains("[1, 0, 0]"), "{saved}");
    let mut again = loaded(&saved);
    assert_eq!(colour(&mut again, [0.0, 0.0, 1.0]), colour(&mut session, [0.0, 0.0, 1.0]));
    // The words mean something in their place only.
    loaded("color = 3; colour = color + 1; gob_a = 1 - x1**2;");
}

#[test]
fn a_colour_that_makes_no_sense_is_told() {
    let cases = [
        (
            "gob_a : COLOR = [1, 0];",
            "bad-colour: COLOR needs red, green and blue, or one value for the palette, not an array of 2",
        ),
        ("gob_a : COLOR = [[1, 0, 0]];", "bad-colour"),
        ("gob_a : COLOR = [255, 0, 0];", "bad-colour: red, green and blue go from 0 to 1, and one of them is 255"),
        ("gob_a : COLOR = [1, 0, 0] IN [0, 1];", "bad-colour: red, green and blue are shown as they are"),
        ("gob_a : COLOR = x3 IN [1, 1];", "empty-range"),
        ("gob_a : COLOR;", "type-without-value"),
        ("x1 : COLOR = [1, 0, 0];", "bad-type: `x1` is a coordinate, and COLOR belongs to an object"),
        ("gob_b : COLOR = [1, 0, 0];", "unknown-name: `gob_b`"),
        ("gob_a : COLOR = [1, q, 0];", "unknown-name: `q`"),
    ];
    for (statement, expected) in cases {
        let mut session = Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default());
        let outcome = session.input("script.geo", &format!("{BALL}{statement}"), Mode::Script);
        assert!(!outcome.accepted && messages(&outcome).contains(expected), "{statement}: {}", messages(&outcome));
    }
    let mut session = loaded(&format!("{BALL}{SPACE} gob_a : COLOR = [x5, 0, 0];"));
    let told = colours_at(&mut session, &View::default(), Palette::Plain, &[[0.0; 3]]).expect_err("no x5");
    assert_eq!((told[0].code, told[0].labels.len()), ("colour-coordinate", 1));
}

/// A picture from the front by parallel rays, `side` x `side`, without ground and shadow.
fn front(side: usize) -> impl Fn(&mut Options) {
    move |options| {
        options.picture.size = Some((side, side));
        options.picture.view = "front".into();
        options.picture.background = Some(Background::Transparent);
        options.picture.shadow = false;
    }
}

/// How many pixels are covered, by the opacities of those that a test holds of.
fn covered(image: &Image, test: impl Fn([u8; 4]) -> bool) -> f64 {
    image.rgba.as_chunks::<4>().0.iter().filter(|p| test(**p)).map(|p| f64::from(p[3]) / 255.0).sum()
}

#[test]
fn a_transparent_ground_lets_the_covered_part_of_each_pixel_stay() {
    let ball = picture(&[BALL, SPACE], front(200));
    let middle: f64 = (0..200).map(|i| f64::from(ball.pixel(i, 100)[3]) / 255.0).sum();
    let area = covered(&ball, |_| true);
    let disc = std::f64::consts::FRAC_PI_4 * middle * middle;
    assert!((area / disc - 1.0).abs() < 0.005, "{area} pixels of a disc of {disc}");
    assert_eq!([ball.pixel(0, 0), ball.pixel(199, 199)], [[0; 4]; 2]);
    let on = |ground| {
        picture(&[BALL, SPACE], |options| {
            front(60)(options);
            options.picture.background = Some(ground);
        })
    };
    assert_eq!(on(Background::Colour([255, 200, 0])).pixel(0, 59), [255, 200, 0, 255]);
    // The same bytes where nothing shines through.
    assert_eq!(on(Background::Colour([0; 3])).pixel(30, 30), on(Background::Transparent).pixel(30, 30));
    let plane = picture(&["gob_a = 1 - x1**2 - x2**2;", "x1min=-2;x1max=2;x2min=-2;x2max=2;"], front(200));
    let area = covered(&plane, |_| true) / 2500.0;
    assert!((area - std::f64::consts::PI).abs() < 0.1, "a plane figure too: {area}");
    let gif = make(&[BALL, SPACE], "a.gif", front(60)).expect_err("no half-transparent pixels");
    assert_eq!(gif[0].code, "no-transparency");
}

#[test]
fn what_is_thin_or_small_is_seen_and_what_is_not_seen_is_not_called_empty() {
    let view = |side: usize, view: &str| {
        let view = view.to_owned();
        move |options: &mut Options| {
            front(side)(options);
            options.picture.view = view;
        }
    };
    // Both ends of all rays through the middle of the plate have the same value.
    let plate = "gob_a = (1 - x1**2) & (1 - x2**2) & (1e-6 - x3**2);";
    let bounds = "x1min=-1.2;x1max=1.2;x2min=-1.2;x2max=1.2;x3min=-0.0015;x3max=0.0015;";
    let seen = picture(&[plate, bounds], view(96, "top"));
    let across = (0..96).filter(|&i| seen.pixel(i, 48)[3] == 255).count();
    assert!(across > 60, "{across} pixels");
    let whole = covered(&seen, |_| true);
    assert!((whole / (across * across) as f64 - 1.0).abs() < 0.05, "{whole} pixels of {across} x {across}");
    let pixel = picture(&[BALL, SPACE], view(1, "front"));
    assert!(pixel.pixel(0, 0)[3] > 0, "a ball in one pixel");
    let far = "gob_a = (1 - x1**2 - x2**2 - x3**2) | (1 - (x1 - 1000)**2 - x2**2 - x3**2);";
    let told = make(&[far], "a.png", view(40, "front")).expect_err("far smaller than a pixel");
    let error = told.iter().find(|told| told.severity == Severity::Error).expect("an error");
    assert_eq!((error.code, &*error.title), ("empty-object", "nothing of `gob_a` is seen in this picture"));
}

#[test]
fn a_colour_is_seen_where_it_is() {
    let plain = picture(&[BALL, SPACE, "gob_a : COLOR = [1, 0.4, 0.2];"], front(60));
    let formula = picture(&[BALL, SPACE, "gob_a : COLOR = [1, IF x1 > 9 THEN 0 ELSE 0.4, 0.2];"], front(60));
    assert!(plain == formula, "a formula that is the same everywhere is that colour");
    let halves = picture(&[BALL, SPACE, "gob_a : COLOR = IF x3 > 0 THEN [1, 0, 0] ELSE [0, 0, 1];"], front(60));
    let [above, below] = [20, 40].map(|j| halves.pixel(30, j));
    assert!(
        above[0] > 150 && above[0] > above[2] + 80 && below[2] > 150 && below[2] > below[0] + 80,
        "{above:?} {below:?}"
    );
}

#[test]
fn the_nearer_object_hides_the_farther() {
    let balls = "gob_a = 1 - x1**2 - (x2+0.5)**2 - x3**2; gob_b = 1 - x1**2 - (x2-0.5)**2 - x3**2;
        gob_a : COLOR = [1, 0, 0]; gob_b : COLOR = [0, 0, 1];";
    let seen = |view: &str, first: &str, other: &str| {
        picture(&[balls, SPACE], |options| {
            front(60)(options);
            options.picture.view = view.into();
            options.view.object = Some(first.into());
            options.view.beside = vec![other.into()];
        })
    };
    let red = |p: [u8; 4]| p[3] == 255 && p[0].saturating_sub(p[2]) > 60;
    for (view, hides) in [("front", true), ("back", false)] {
        let both = seen(view, "gob_a", "gob_b");
        assert_eq!(red(both.pixel(30, 30)), hides, "{view}");
        assert!(both == seen(view, "gob_b", "gob_a"), "{view}: whatever is named first");
        let count = covered(&both, red) / covered(&both, |_| true);
        assert!(count > 0.97 && hides || count < 0.03 && !hides, "{view}: {count} is red");
    }
    // From the side each shows what the other does not hide: half of the lens is of each.
    let side = seen("right", "gob_a", "gob_b");
    let part = covered(&side, red) / covered(&side, |_| true);
    assert!((part - 0.5).abs() < 0.02, "{part}");
    let mesh = make(&[balls, SPACE], "a.svg", |options| options.view.beside = vec!["gob_a".into()]);
    assert!(mesh.is_err(), "an outline has three axes too many");
}

/// The half of the ball beyond a plane: seen through, and as a mesh.
#[test]
fn a_cut_shows_an_exact_section_and_closes_the_mesh() {
    let cut = |value, keep| {
        move |options: &mut Options| {
            front(200)(options);
            options.cuts = vec![Cut { coordinate: Coordinate(2), value, keep }];
        }
    };
    let script = [BALL, SPACE, "gob_a : COLOR = IF x2 < -0.599 THEN [1, 0, 0] ELSE [0, 0, 1];"];
    for keep in [None, Some(Half::Above)] {
        let image = picture(&script, cut(-0.6, keep));
        let red = covered(&image, |p| p[0] > p[2]) / covered(&image, |_| true);
        assert!((red - 0.64).abs() < 0.01, "a disc of radius 0.8 in one of 1: {red}");
    }
    let below = picture(&script, cut(-0.6, Some(Half::Below)));
    assert_eq!(covered(&below, |p| p[2] > p[0]), 0.0, "the other half shows none of it");
    // Away from the eye of the usual camera, which stands at the right, in front and above.
    for (c, volume) in [(1, 0.5), (3, 0.5)] {
        let stl = one(&[BALL, SPACE], "a.stl", |options| {
            options.cuts = vec![Cut { coordinate: Coordinate(c), value: 0.0, keep: None }];
        });
        let triangles = stl[84..].chunks_exact(50).map(|t| {
            let at = |k: usize| f64::from(f32::from_le_bytes([t[k], t[k + 1], t[k + 2], t[k + 3]]));
            let corner = |n: usize| [0, 1, 2].map(|k| at(12 + 12 * n + 4 * k));
            [corner(0), corner(1), corner(2)]
        });
        let (mut found, mut highest) = (0.0, f64::MIN);
        for [a, b, d] in triangles {
            found += (a[0] * (b[1] * d[2] - b[2] * d[1]) - a[1] * (b[0] * d[2] - b[2] * d[0])
                + a[2] * (b[0] * d[1] - b[1] * d[0]))
                / 6.0;
            highest = [a, b, d].iter().fold(highest, |most, p| most.max(p[usize::from(c) - 1]));
        }
        let whole = 4.0 / 3.0 * std::f64::consts::PI;
        assert!((found / whole - volume).abs() < 0.02 && highest.abs() < 1e-6, "x{c}: {found}, up to {highest}");
    }
    let refused = [(2, 5.0, "no-cut"), (4, 0.0, "no-axis")];
    for (c, value, code) in refused {
        let told = make(&[BALL, SPACE], "a.png", |options| {
            options.cuts = vec![Cut { coordinate: Coordinate(c), value, keep: None }];
        });
        assert_eq!(told.expect_err(code)[0].code, code);
    }
}

#[test]
fn an_eye_far_away_sees_what_parallel_rays_see() {
    let script = "gob_a = 1 - x1**2 - (2*x2)**2 - (x3 - 0.3*x1)**2;";
    let from = |view: &str, parallel| {
        picture(&[script, SPACE], |options| {
            front(120)(options);
            options.picture.view = view.into();
            options.picture.parallel = parallel;
        })
    };
    let (far, level) = (from("0,-4000,0", None), from("front", None));
    let differ = far.rgba.iter().zip(&level.rgba).filter(|(a, b)| a.abs_diff(**b) > 24).count();
    assert!(differ < 120, "{differ} bytes differ");
    assert!(from("0,-4000,0", Some(true)) == level, "the rays made parallel");
    assert!(from("front", Some(false)) == from("0,0", None), "the rays made central");
    // A ball of radius 1 fills the picture from any place, 0.94 of its half side, and its outline is a circle.
    let near = picture(&[BALL, SPACE], |options| {
        front(200)(options);
        options.picture.view = "3,-4,5".into();
    });
    let (area, middle) =
        (covered(&near, |_| true), (0..200).map(|i| f64::from(near.pixel(i, 100)[3]) / 255.0).sum::<f64>());
    assert!((area / (std::f64::consts::FRAC_PI_4 * middle * middle) - 1.0).abs() < 0.01, "{area} {middle}");
}

#[test]
fn hollows_are_darker_with_occlusion_and_nothing_is_brighter() {
    let hollow = "gob_a = (1 - x3**2 & 2.25 - x1**2 & 2.25 - x2**2) \\ (0.64 - x1**2 - x2**2 & x3 + 0.8);";
    let seen = |script: &str, occlusion| {
        picture(&[script, SPACE], |options| {
            options.picture.size = Some((80, 80));
            options.picture.view = "top".into();
            options.picture.occlusion = occlusion;
            options.picture.shadow = false;
        })
    };
    let [off, on] = [false, true].map(|occlusion| seen(hollow, occlusion));
    assert!(off.rgba.iter().zip(&on.rgba).all(|(off, on)| on <= off), "light is only taken away");
    let lost = |i: usize, j: usize| off.pixel(i, j)[1] - on.pixel(i, j)[1];
    assert!(lost(40, 40) > 15 && lost(12, 12) < 4, "in the hollow {}, on the top {}", lost(40, 40), lost(12, 12));
    let [off, on] = [false, true].map(|occlusion| seen(BALL, occlusion));
    let most = off.rgba.iter().zip(&on.rgba).map(|(off, on)| off - on).max();
    assert!(most < Some(12), "nothing hides the sky from a ball: {most:?}");
}

#[test]
fn light_comes_from_where_it_is_put() {
    let lit = |light| {
        picture(&[BALL, SPACE], |options| {
            front(60)(options);
            options.picture.light = Some(light);
            options.picture.fill = false;
        })
    };
    let sum = |image: &Image, left: bool| -> u32 {
        let columns = if left { 0..30 } else { 30..60 };
        columns.flat_map(|i| (0..60).map(move |j| (i, j))).map(|(i, j)| u32::from(image.pixel(i, j)[1])).sum()
    };
    let [left, right] = [[-60.0, 0.0], [60.0, 0.0]].map(lit);
    assert!(sum(&left, true) > sum(&left, false) && sum(&right, true) < sum(&right, false));
    let mirrored = (0..60).all(|j| (0..60).all(|i| left.pixel(i, j)[1].abs_diff(right.pixel(59 - i, j)[1]) <= 2));
    assert!(mirrored, "lights at both sides make pictures that mirror each other");
}

#[test]
fn a_scene_has_the_same_bytes_with_any_number_of_threads() {
    let script = "gob_a = 1 - x1**2 - x2**2 - x3**2; gob_b = 0.5 - (x1-1)**2 - x2**2 - x3**2; gob_c = x5 - x1**2 - x3**2 & 1 - x2**2;
        gob_a : COLOR = x3 IN [-1, 1]; x5 : G = [0.1, 0.2];";
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            one(&[script, SPACE], "a.png", |options| {
                options.picture.size = Some((90, 70));
                options.picture.occlusion = true;
                options.view.beside = vec!["gob_a".into(), "gob_b".into()];
                options.cuts = vec![Cut { coordinate: Coordinate(2), value: 0.1, keep: None }];
            })
        })
    };
    let first = with(1);
    assert!(first == with(2) && first == with(8));
}

#[test]
fn a_script_sets_what_options_set() {
    let mut session = loaded(&format!(
        "{BALL}{SPACE} camera = [-30, 40]; size = [200, 150]; Light = 1; light = [60, 30]; background = [1, 0.5, 0]; palette = \"Viridis\";
         resolution = 20; shadow = 0; fps = 12; projection = \"orthographic\"; axes = 1;"
    ));
    let options = settings::defaults(&session).expect("settings");
    let picture = &options.picture;
    assert_eq!((picture.view.as_str(), picture.size, picture.light), ("-30,40", Some((200, 150)), Some([60.0, 30.0])));
    assert_eq!((picture.background, picture.palette.as_str()), (Some(Background::Colour([255, 128, 0])), "viridis"));
    assert_eq!((picture.shadow, picture.axes, picture.parallel, options.timing.fps), (false, true, Some(true), 12.0));
    assert!(session.input("line", "gob_b = resolution - x1;", Mode::Prompt).accepted);
    assert_eq!(
        settings::defaults(&session).expect("settings").view.cells,
        Options::default().view.cells,
        "it is read: a number"
    );
}

#[test]
fn a_setting_that_cannot_be_is_told_and_another_thing_of_its_name_is_let_be() {
    let told =
        |script: &str| settings::check(&loaded(script)).into_iter().map(|d| (d.code, d.severity)).collect::<Vec<_>>();
    for wrong in [
        "palette = \"blue\";",
        "resolution = 0.5;",
        "camera = [0, 91];",
        "background = [1, 2, 0];",
        "background = \"purple\";",
        "size = [0, 5];",
        "shadow = 2;",
        "view = \"1,2\";",
        "fps = 0;",
        "light = [0, 100];",
    ] {
        assert_eq!(told(wrong), [("bad-setting", Severity::Error)], "{wrong}");
    }
    for other in ["size = 3;", "camera = [1, 2, 3, 4];", "palette = [1, 2];", "view = 2;"] {
        assert_eq!(told(other), [("no-setting", Severity::Warning)], "{other}");
        assert_eq!(settings::defaults(&loaded(other)), Ok(Options::default()), "{other}");
    }
    for own in [
        "size = 3; gob_a = size - x1;",
        "light(p) = p;",
        "view = x1;",
        "axes = 0;",
        "r1 = 4;",
        "palette = 7; gob_a = x1; gob_a : COLOR = [palette/9, 0, 0];",
    ] {
        assert_eq!(told(own), [], "{own}");
    }
}

#[test]
fn the_manual_lists_the_settings() {
    let manual = include_str!("../../docs/manual.md");
    assert!(manual.contains(&settings::table()), "put this into docs/manual.md:\n{}", settings::table());
    for setting in SETTINGS {
        let script = format!("{} = {};", setting.name, setting.form);
        assert!(settings::check(&loaded(&script)).is_empty(), "its own example: {script}");
    }
}
