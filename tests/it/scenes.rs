//! Pictures of solids against closed forms: colours of objects, several in one picture, light, grounds, cuts, cameras.

use std::sync::Arc;

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::Session;
use yont::model::request::{View, colours_at};
use yont::picture::Palette;
use yont::syntax::Mode;

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
