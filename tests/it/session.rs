//! Inputs as transactions, the history, and what a session saves.

use std::sync::Arc;

use yont::host::Memory;
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::model::{Event, Outcome, Session};
use yont::syntax::Mode;

pub fn session() -> Session {
    Session::new(Arc::new(Memory::default()), Limits::default(), Interrupt::default())
}

/// The messages of an outcome, one a line: code and title.
pub fn messages(outcome: &Outcome) -> String {
    let all: Vec<String> = outcome.diagnostics.iter().map(|d| format!("{}: {}", d.code, d.title)).collect();
    all.join("\n")
}

/// Types lines at the prompt; each must be accepted. Gives what the last one showed.
fn prompt(session: &mut Session, lines: &[&str]) -> String {
    let mut shown = String::new();
    for line in lines {
        let outcome = session.input("<prompt>", line, Mode::Prompt);
        assert!(outcome.accepted, "{line}: {}", messages(&outcome));
        let texts = outcome.events.iter().map(|event| match event {
            Event::Defined(text) | Event::Printed(text) | Event::Value { text, .. } => text.as_str(),
        });
        shown = texts.collect::<Vec<_>>().join("\n");
    }
    shown
}

#[test]
fn a_failed_input_changes_nothing() {
    let mut s = session();
    prompt(&mut s, &["r1 = 4", "gob_a = r1 - x1"]);
    let before = s.save();
    let outcome = s.input("<prompt>", "r1 = 5; q = 1/0; gob_a = 3", Mode::Prompt);
    assert!(!outcome.accepted && outcome.events.is_empty());
    assert_eq!(s.save(), before);
    assert_eq!(prompt(&mut s, &["r1"]), "4");
    assert_eq!(s.undo().as_deref(), Some("gob_a = r1 - x1"));
}

#[test]
fn undo_and_redo_walk_through_inputs() {
    let mut s = session();
    prompt(&mut s, &["r1 = 4", "q = r1*2", "r1 = 5", "PRINT q"]);
    assert_eq!(s.describe("q"), "q = 10");
    assert_eq!(s.undo().as_deref(), Some("r1 = 5"));
    assert_eq!(s.describe("q"), "q = 8");
    assert_eq!(s.undo().as_deref(), Some("q = r1*2"));
    assert_eq!(s.definitions(), ["r1 = 4"]);
    assert_eq!(s.redo().as_deref(), Some("q = r1*2"));
    assert_eq!(s.redo().as_deref(), Some("r1 = 5"));
    assert_eq!(s.redo(), None);
    assert_eq!(s.describe("q"), "q = 10");
    s.undo();
    prompt(&mut s, &["r1 = 7"]);
    assert_eq!(s.redo(), None, "a new input ends the way forward");
    assert_eq!(s.describe("q"), "q = 14");
    while s.undo().is_some() {}
    assert_eq!(s.save(), "");
}

#[test]
fn the_prompt_waits_for_names_and_notes_what_breaks() {
    let mut s = session();
    let outcome = s.input("<prompt>", "gob_a = r1 - x1", Mode::Prompt);
    assert!(outcome.accepted);
    assert_eq!(messages(&outcome), "unknown-name: `r1` is not defined yet");
    let asked = s.input("<prompt>", "gob_a", Mode::Prompt);
    assert!(
        !asked.accepted && messages(&asked).starts_with("unknown-name: `r1` is not defined"),
        "{}",
        messages(&asked)
    );
    assert!(s.object(None).is_err());
    assert_eq!(prompt(&mut s, &["r1 = 4"]), "r1 = 4");
    assert_eq!(s.describe("gob_a"), "gob_a: object of x1");
    prompt(&mut s, &["a = [1, 2, 3]", "t = 0", "FOR i = 1 TO 3 DO t = t + a[i]"]);
    let outcome = s.input("<prompt>", "a = [1]", Mode::Prompt);
    assert!(outcome.accepted);
    assert!(messages(&outcome).starts_with("broken: `t` no longer works"), "{}", messages(&outcome));
    let asked = s.input("<prompt>", "PRINT t", Mode::Prompt);
    assert!(messages(&asked).starts_with("bad-index"), "{}", messages(&asked));
    prompt(&mut s, &["a = [4, 5, 6]"]);
    assert_eq!(s.describe("t"), "t = 15");
}

#[test]
fn print_shows_values_as_they_are_at_its_place() {
    let mut s = session();
    let script = "a = 1; PRINT \"a is\", a; a = 2; PRINT a, [a, a/4]; gob_x = a - x1; PRINT gob_x; i = 1; WHILE (i <= 8) DO i = i + 1; i = 5; PRINT i;";
    let outcome = s.input("script", script, Mode::Script);
    let printed: Vec<&str> = outcome
        .events
        .iter()
        .filter_map(|e| match e {
            Event::Printed(text) => Some(text.as_str()),
            _ => None,
        })
        .collect();
    assert_eq!(printed, ["a is 1", "2 [2, 0.5]", "gob_x: object of x1", "5"], "{}", messages(&outcome));
}

#[test]
fn a_saved_script_keeps_docs_order_and_systems() {
    let files: &[(&str, &[u8])] = &[("lib/part.geo", b"r_alpha = 1; { A part } gob_part = x1 | 4;")];
    let mut s = Session::new(Arc::new(Memory::with(files)), Limits::default(), Interrupt::default());
    let script =
        "{ The radius } r1 = 4;\nINCLUDE \"lib/part.geo\";\ngob_b = 3 | r1;\nx4 : T;\nr1 = r1 + 1;\nx4 : CONSTANT = 2;";
    let outcome = s.input("main.geo", script, Mode::Script);
    assert!(outcome.accepted, "{}", messages(&outcome));
    let expected = "{ The radius }\nr1 = 4;\nr_alpha = 1;\n{ A part }\ngob_part = x1 | 4;\nr_alpha = 0;\ngob_b = 3 | r1;\nr1 = r1 + 1;\nx4 : CONSTANT = 2;\n";
    assert_eq!(s.save(), expected);
    assert_eq!(s.doc("r1").as_deref().map(str::trim), Some("The radius"));
    assert_eq!(s.definition("r1").as_deref(), Some("r1 = 4;\nr1 = r1 + 1;"));
    assert_eq!(s.deps("r1").map(|d| d.readers), Some(vec!["gob_b".to_owned()]));
}

#[test]
fn several_errors_of_one_input_come_together_and_have_no_followers() {
    let mut s = session();
    let script = "r1 = 4;\ngob_a = r2 - x1;\nq = 1/0;\nw = q + 1;\nbad = (3;\nu = bad + 1;\nx1min = -1;\nx1min = r1;";
    let outcome = s.input("script", script, Mode::Script);
    let found = messages(&outcome);
    assert_eq!(outcome.diagnostics.iter().filter(|d| d.is_error()).count(), 3, "{found}");
    assert!(found.contains("`r2`") && found.contains("1/0"), "{found}");
    let help: Vec<String> = outcome.diagnostics.iter().flat_map(|d| d.help.clone()).collect();
    assert!(help.iter().any(|h| h.contains("`r1`")), "{help:?}");
}

#[test]
fn a_name_defined_twice_with_a_reader_between_is_warned_about() {
    let mut s = session();
    let outcome = s.input("script", "r1 = 4; gob_a = r1 - x1; r1 = 5; r2 = 1; r2 = 2;", Mode::Script);
    assert!(outcome.accepted);
    assert_eq!(messages(&outcome), "redefined: `r1` is defined twice, and is read in between");
}

#[test]
fn options_set_parameters_before_and_after_the_script() {
    let script = "r1 = 4; r1 = r1 + 1; q = r1*2;";
    let mut after = session();
    assert!(after.input("script", script, Mode::Script).accepted);
    assert!(after.set("r1", "10").accepted);
    assert_eq!(after.describe("q"), "q = 20");
    assert_eq!(messages(&after.set("r9", "1")).lines().next(), Some("unknown-name: `r9` is not defined"));
    let mut before = session();
    assert!(before.set("r1", "10").accepted);
    assert!(before.input("script", "q = r1*2; r1 = 4;", Mode::Script).accepted);
    assert_eq!(before.describe("q"), "q = 20");
}

#[test]
fn objects_know_their_axes_frames_and_levels() {
    let mut s = session();
    let script = "gob_a = 1 - x1**2 - x2**2 - x4; gob_b = gob_a + x5; gob_a : G = [-1, 0, 1];
        x1min = -2; x1max = 2; x2min = -1; x2max = 1; x4min = 0; x4max = 1; x4_delta = -0.25;";
    let outcome = s.input("script", script, Mode::Script);
    assert!(outcome.accepted, "{}", messages(&outcome));
    let told = s.object(None).expect_err("x5 has no type");
    assert!(told[0].title.contains("`gob_b` uses x5"), "{}", told[0].title);
    let object = s.object(Some("gob_a")).expect("gob_a is complete");
    let ranges: Vec<_> = object.space().iter().map(|axis| axis.range).collect();
    assert_eq!(ranges, [Some((-2.0, 2.0)), Some((-1.0, 1.0))]);
    assert_eq!(object.levels, [-1.0, 0.0, 1.0]);
    let time: Vec<f64> = object.axes.iter().filter(|a| !a.is_space()).flat_map(|a| a.steps(100)).collect();
    assert_eq!(time, [1.0, 0.75, 0.5, 0.25, 0.0]);
    prompt(&mut s, &["x5 : CONSTANT = 2", "x3 : Z"]);
    let object = s.object(None).expect("complete now");
    assert_eq!(&*object.name, "gob_b");
    assert_eq!(object.space().len(), 3);
    assert_eq!(object.space()[2].range, None, "x3 has no range");
    prompt(&mut s, &["x3min = 1", "x3max = 1"]);
    assert!(s.object(None).expect_err("no extent")[0].title.contains("no extent along x3"));
}

#[test]
fn what_is_meant_for_the_environment_is_not_lost_in_silence() {
    let mut s = session();
    let outcome = s.input("script", "gob_ball = 1 - x1**2; x1_min = -2; gob_bal : G = [0, 1];", Mode::Script);
    let found = messages(&outcome);
    assert!(!outcome.accepted, "{found}");
    assert!(found.contains("nearly-setting: `x1_min` bounds nothing: the setting is written `x1min`"), "{found}");
    assert!(found.contains("unknown-name: `gob_bal`"), "{found}");
}

#[test]
fn a_system_that_builds_on_the_one_before_is_saved_with_it() {
    let mut s = session();
    let script = "r_alpha = 0.5;\nr_alpha = r_alpha/2;\nv = 3 | 4;\n";
    assert!(s.input("script", script, Mode::Script).accepted);
    assert_eq!(s.save(), script);
}

#[test]
fn a_circle_of_includes_is_shown() {
    let files: &[(&str, &[u8])] = &[("a.geo", b"INCLUDE \"b.geo\";"), ("b.geo", b"INCLUDE \"a.geo\";")];
    let mut s = Session::new(Arc::new(Memory::with(files)), Limits::default(), Interrupt::default());
    let outcome = s.input("main.geo", "INCLUDE \"a.geo\"; r1 = 1;", Mode::Script);
    assert_eq!(messages(&outcome), "include-circle: INCLUDE goes round in a circle: a.geo -> b.geo -> a.geo");
}

#[test]
fn ctrl_c_stops_a_long_loop_and_changes_nothing() {
    let interrupt = Interrupt::default();
    let mut s = Session::new(Arc::new(Memory::default()), Limits::default(), interrupt.clone());
    prompt(&mut s, &["r1 = 4"]);
    interrupt.cancel();
    let outcome = s.input("<prompt>", "i = 1; WHILE (i > 0) DO i = i + 1", Mode::Prompt);
    assert_eq!(messages(&outcome), "cancelled: cancelled; nothing has changed");
    interrupt.reset();
    assert_eq!(prompt(&mut s, &["r1"]), "4");
}

#[test]
fn recursion_is_limited_by_depth_not_by_the_stack() {
    let mut s = session();
    let simple = "f(n) = IF n <= 0 THEN 0 ELSE f(n - 1) + 1; v = f(999);";
    assert!(s.input("script", simple, Mode::Script).accepted, "a thousand calls within each other");
    let outcome = s.input("script", &simple.replace("999", "1000"), Mode::Script);
    assert!(messages(&outcome).starts_with("too-many-calls"), "{}", messages(&outcome));
    // Each call stands within fifty brackets: the depth of both together is limited as well.
    let deep = format!("f(n) = IF n <= 0 THEN 0 ELSE {}f(n - 1){} + 1; v = f(999);", "(".repeat(50), ")".repeat(50));
    let outcome = s.input("script", &deep, Mode::Script);
    assert!(messages(&outcome).starts_with("too-deep"), "{}", messages(&outcome));
}

#[test]
fn the_mended_figure_six_is_one_object_of_four_coordinates() {
    let mut s = session();
    let outcome = s.input("figure6.geo", FIGURE_SIX, Mode::Script);
    assert!(outcome.accepted, "{}", messages(&outcome));
    let object = s.object(None).expect("complete");
    assert_eq!(&*object.name, "gob_metamorp");
    assert_eq!(object.axes.iter().map(|a| a.coordinate.0).collect::<Vec<_>>(), [1, 2, 3, 4]);
    assert_eq!(object.axes[3].steps(100).len(), 9);
    let at = |name: &str, point: &[f64]| crate::language::value_at(&s, name, point);
    assert_eq!(at("gob_metamorp", &[0.5, 9.0, 1.0, 0.0]), at("gob_csg", &[0.5, 9.0, 1.0]));
    assert_eq!(at("gob_metamorp", &[0.5, 2.0, 1.0, 3.0]), at("gob_bloby", &[0.5, 2.0, 1.0]));
    // The first blob has its centre at the origin: 1.5 there, and little from the others.
    assert!((at("gob_bloby", &[0.0, 0.0, 0.0]) - 1.43).abs() < 0.01);
    assert!(at("gob_metamorp", &[0.0, 0.0, 0.0, 4.5]).is_nan());
}

/// Fig. 6 of the 1995 paper with its printing errors mended; a ball stands for the voxel object.
const FIGURE_SIX: &str = r#"
{ Metamorphosis }
r_alpha = 1.;
{ Block with one corner at (a0,b0,c0) and the edges a, b, c }
pob_block_3D(a0,b0,c0,a,b,c) = (x1-a0 & a0+a-x1) & (x2-b0 & b0+b-x2) & (x3-c0 & c0+c-x3);
gob_bl1  = pob_block_3D(-9.,-8.,-9.,18.,16.,18.);
gob_cyl1 = ((r1**2-x1**2-x3**2) & 10.5-x2) & x2+10.5;
gob_cyl2 = r2**2-x1**2-x2**2;
gob_bl2  = (x2+d1 & d1-x2) & (x3+d1 & d1-x3);
gob_csg  = ((gob_bl1 | gob_cyl1) \ gob_cyl2) \ gob_bl2;
gob_swept = (r3**2 - (x1-c1*SIN(-1+x2/c2))**2 - (x3-c1*COS(-1+x2/c2))**2) @ (x2+10. & 10.-x2);
gob_vox = 49 - x1**2 - x2**2 - x3**2;
gob_bloby = b;
i = 1;
WHILE (i <= 8) DO BEGIN
  gob_bloby = gob_bloby + a[i]*EXP(-SQRT((x1-px[i])**2 + (x2-py[i])**2 + (x3-pz[i])**2));
  i = i + 1;
END;
gob_metamorp = IF (0 <= x4 <= 1) THEN gob_csg*(1-x4)   + gob_swept*x4
          ELSE IF (1 <  x4 <= 2) THEN gob_swept*(2-x4) + gob_vox*(x4-1)
          ELSE IF (2 <  x4 <= 3) THEN gob_vox*(3-x4)   + gob_bloby*(x4-2)
          ELSE IF (3 <  x4 <= 4) THEN gob_bloby*(4-x4) + gob_csg*(x4-3);
x1 : X;  x2 : Y;  x3 : Z;  x4 : T;
x1min = -11.;  x1max = 11.;  x2min = -11.;  x2max = 11.;  x3min = -11.;  x3max = 11.;
x4min = 0.;    x4max = 4.;   x4_delta = 0.5;
r1 = 4.; r2 = 6.; d1 = 5.; r3 = 3.5; c1 = -8.; c2 = 2.5; b = -0.07;
a  = [1.5, 1., 1., 0.8, 0.5, 0.3, 0.4, 0.35];
px = [0., 6., -4., -5., 5., 6., 5., 8.];
py = [0., 6., -4., 3., -5., -7., -6., -9.];
pz = [0., 6., -4., 7., 5., 9., -3., -4.];
"#;
