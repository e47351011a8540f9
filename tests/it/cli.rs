//! The command line: what goes where, statuses, formats by extension, and that every option does something.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::Duration;

use clap::CommandFactory;
use tempfile::TempDir;
use yont::cli::arguments::Cli;

/// A ball of radius `r` at the origin, small enough for every test.
pub(crate) const BALL: &str = "{ A ball }\ngob_ball = r**2 - x1**2 - x2**2 - x3**2; r = 2;
x1min = -3; x1max = 3; x2min = -3; x2max = 3; x3min = -3; x3max = 3;\n";

/// A ball that grows, over five frames.
pub(crate) const GROWING: &str = "gob_ball = (1 + x4)**2 - x1**2 - x2**2 - x3**2;
x1min = -3; x1max = 3; x2min = -3; x2max = 3; x3min = -3; x3max = 3; x4min = 0; x4max = 1; x4_delta = 0.25;\n";

/// A disc in the plane.
pub(crate) const DISC: &str = "gob_disc = 4 - x1**2 - x2**2; x1 : X; x2 : Y;
x1min = -3; x1max = 3; x2min = -3; x2max = 3;\n";

/// How a run ended.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) status: Option<i32>,
    pub(crate) out: String,
    pub(crate) err: String,
    /// The files that the run left in its folder beside the given ones.
    pub(crate) made: Vec<String>,
}

/// A folder with these files.
pub(crate) fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("room");
    }
    folder
}

pub(crate) fn command(folder: &Path) -> assert_cmd::Command {
    let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_yont"));
    // The guard against a hang, not a measure of speed.
    command.current_dir(folder).timeout(Duration::from_secs(300));
    command.env_remove("NO_COLOR").env("XDG_STATE_HOME", folder.join(".state"));
    command.env("XDG_CONFIG_HOME", folder.join(".config"));
    command
}

pub(crate) fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    entries.filter_map(|entry| entry.file_name().into_string().ok()).collect()
}

/// Runs `yont` in `folder`.
pub(crate) fn run(folder: &Path, arguments: &[&str], input: &str) -> Ran {
    let before = names(folder);
    let output = command(folder).args(arguments).write_stdin(input).output().expect("yont starts");
    let made = names(folder).difference(&before).cloned().collect();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Ran { status: output.status.code(), out: text(&output.stdout), err: text(&output.stderr), made }
}

fn with_ball(arguments: &[&str]) -> Ran {
    let folder = folder(&[
        ("ball.geo", BALL.as_bytes()),
        ("growing.geo", GROWING.as_bytes()),
        ("disc.geo", DISC.as_bytes()),
        ("p.tsv", b"0 0 0\n2 0 0\n"),
    ]);
    run(folder.path(), arguments, "")
}

#[test]
fn statuses_are_those_of_the_manual() {
    let cases: &[(&[&str], i32)] = &[
        (&["ball.geo"], 0),
        (&["--help"], 0),
        (&["--version"], 0),
        (&["check", "ball.geo"], 0),
        (
            &[
                "-e",
                "gob_n = -1 - x1**2 - x2**2 - x3**2; x1min=-1;x1max=1;x2min=-1;x2max=1;x3min=-1;x3max=1;",
                "-o",
                "n.stl",
            ],
            1,
        ),
        (&["ball.geo", "--exit-status", "-e", "0"], 1),
        (&["ball.geo", "--exit-status", "-e", "2 > 1"], 0),
        (&["ball.geo", "-o", "ball.doc"], 2),
        (&["ball.geo", "-o", "ball"], 2),
        (&["ball.geo", "-o", "-"], 2),
        (&["ball.geo", "-o", "a.svg"], 3),
        (&["ball.geo", "-o", "a.svg", "--slices", "x4=0:1:2"], 2),
        (&["ball.geo", "--format", "stl", "-o", "a.stl"], 2),
        (&["ball.geo", "--resolution", "0", "-o", "a.stl"], 2),
        (&["ball.geo", "--bounds", "x1=1:1", "-o", "a.stl"], 2),
        (&["--no-such-option"], 2),
        (&["measure"], 2),
        (&["-o", "a.stl", "measure", "ball.geo"], 2),
        (&["doc", "no_such_function"], 2),
        (&["ball.geo", "--object", "gob_none", "-o", "a.stl"], 3),
        (&["-e", "a = ;"], 3),
        (&["check", "ball.geo", "-q", "disc.geo", "none.geo"], 4),
        (&["none.geo"], 4),
        (&["."], 4),
        (&["ball.geo", "-o", "no/such/folder.stl"], 4),
        (&["ball.geo", "-D", "r=", "-o", "a.stl"], 2),
        (&["ball.geo", "-D", "r=(", "-o", "a.stl"], 3),
    ];
    for (arguments, status) in cases {
        let ran = with_ball(arguments);
        assert_eq!(ran.status, Some(*status), "{arguments:?}: {}", ran.err);
        assert!(ran.made.is_empty(), "{arguments:?} left {:?}", ran.made);
        assert_eq!(
            ran.err.is_empty(),
            *status == 0 || *status == 1 && arguments.contains(&"--exit-status"),
            "{arguments:?}"
        );
    }
}

#[test]
fn the_extension_decides_what_is_made() {
    /// A file and how it begins.
    type Made = (&'static str, &'static [u8]);
    let cases: &[(&[&str], &[Made])] = &[
        (&["ball.geo", "-o", "a.stl"], &[("a.stl", b"")]),
        (&["ball.geo", "-o", "a.obj", "-o", "b.ply"], &[("a.obj", b""), ("b.ply", b"ply\n")]),
        (&["ball.geo", "-o", "a.png"], &[("a.png", b"\x89PNG")]),
        (&["disc.geo", "-o", "a.png"], &[("a.png", b"\x89PNG")]),
        (&["ball.geo", "-o", "a.nrrd"], &[("a.nrrd", b"NRRD")]),
        (&["growing.geo", "-o", "a.gif", "-o", "b.apng"], &[("a.gif", b"GIF89a"), ("b.apng", b"\x89PNG")]),
        (&["growing.geo", "-o", "a.glb", "-o", "b.3mf"], &[("a.glb", b"glTF"), ("b.3mf", b"PK")]),
        (&["disc.geo", "-o", "a.svg"], &[("a.svg", b"<?xml")]),
        (
            &["ball.geo", "-o", "a.svg", "-o", "b.png", "--slices", "x3=-1:1:5"],
            &[("a.svg", b"<?xml"), ("b.png", b"\x89PNG")],
        ),
        (&["growing.geo", "-o", "f-{n}.png", "--frames", "2"], &[("f-000.png", b"\x89PNG"), ("f-001.png", b"\x89PNG")]),
        (
            &["growing.geo", "-o", "f{n}.STL"],
            &[("f000.STL", b""), ("f001.STL", b""), ("f002.STL", b""), ("f003.STL", b""), ("f004.STL", b"")],
        ),
    ];
    for (arguments, expected) in cases {
        let folder = folder(&[
            ("ball.geo", BALL.as_bytes()),
            ("growing.geo", GROWING.as_bytes()),
            ("disc.geo", DISC.as_bytes()),
        ]);
        let arguments = [*arguments, &["--resolution", "16", "--size", "32x24"]].concat();
        let ran = run(folder.path(), &arguments, "");
        assert_eq!(ran.status, Some(0), "{arguments:?}: {}", ran.err);
        assert_eq!(ran.made, expected.iter().map(|(name, _)| (*name).to_owned()).collect::<Vec<_>>(), "{arguments:?}");
        for (name, magic) in *expected {
            let bytes = fs::read(folder.path().join(name)).expect("it was made");
            assert!(bytes.starts_with(magic) && bytes.len() > 100, "{arguments:?}: {name}");
        }
    }
}

#[test]
fn results_go_to_standard_output_and_messages_to_standard_error() {
    let folder = folder(&[("ball.geo", BALL.as_bytes())]);
    let told = run(folder.path(), &["ball.geo", "-e", "PRINT \"r is\", r; r + 1"], "");
    assert!(told.out.contains("r is 2") && told.out.contains('3') && told.out.contains("gob_ball"), "{}", told.out);
    assert_eq!(told.err, "");
    let mesh = command(folder.path()).args(["ball.geo", "-o", "-", "--format", "stl", "--resolution", "8"]).output();
    let mesh = mesh.expect("yont starts").stdout;
    let count = u32::from_le_bytes(mesh[80..84].try_into().expect("four bytes"));
    assert_eq!(mesh.len(), 84 + 50 * count as usize, "nothing but the mesh");
    let file = run(folder.path(), &["ball.geo", "-o", "a.stl", "--resolution", "8"], "");
    assert_eq!(file.out, "");
    assert!(file.err.contains("a.stl"), "{}", file.err);
    assert_eq!(fs::read(folder.path().join("a.stl")).expect("made"), mesh, "the same bytes by both ways");
    assert_eq!(run(folder.path(), &["-q", "ball.geo", "-o", "b.stl", "--resolution", "8"], "").err, "");
}

#[test]
fn a_program_comes_from_a_file_an_option_or_standard_input() {
    let folder = folder(&[("ball.geo", BALL.as_bytes())]);
    for (arguments, input) in [
        (["ball.geo", "-e", "r", "-q"].as_slice(), ""),
        (&["-", "-e", "r"], BALL),
        (&["-e", BALL, "-e", "r"], ""),
        (&["run", "ball.geo", "-e", "r"], ""),
        (&["ball.geo", "-D", "r=1+1", "-e", "r"], ""),
    ] {
        let ran = run(folder.path(), arguments, input);
        assert_eq!(ran.status, Some(0), "{arguments:?}: {}", ran.err);
        assert_eq!(ran.out.lines().last(), Some("2"), "{arguments:?}: {}", ran.out);
    }
}

#[test]
fn diagnostics_have_three_forms_and_colours_where_wanted() {
    let run = |arguments: &[&str]| with_ball(&[&["-e", "a = nowhere + 1; PRINT a;"], arguments].concat());
    let human = run(&[]).err;
    assert!(human.contains("nowhere") && human.contains("^^^^^^^"), "{human}");
    assert!(!human.contains('\x1b'), "no colour off a terminal");
    assert!(run(&["--color", "always"]).err.contains('\x1b'));
    let short = run(&["--diagnostics", "short"]).err;
    assert_eq!(short.lines().count(), 1, "{short}");
    assert!(short.contains(":1:5: error["), "{short}");
    for line in run(&["--diagnostics", "json"]).err.lines() {
        let value: serde_json::Value = serde_json::from_str(line).expect("JSON");
        assert_eq!(value["severity"], "error", "{line}");
    }
}

#[test]
fn warnings_count_as_errors_when_asked() {
    let program = "r = 1; q = r; r = 2;";
    let warned = with_ball(&["-e", program]);
    assert_eq!(warned.status, Some(0), "{}", warned.err);
    assert!(warned.err.contains("warning"), "{}", warned.err);
    assert_eq!(with_ball(&["-W", "-e", program]).status, Some(3));
    assert_eq!(with_ball(&["-q", "-e", program]).err, "");
}

#[test]
fn a_closed_pipe_is_no_error() {
    let folder = folder(&[]);
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_yont"))
        .args(["-e", "PRINT ARRAY(i = 1 TO 100000, i);"])
        .current_dir(folder.path())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("yont starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("it ends");
    assert_eq!((output.status.code(), String::from_utf8_lossy(&output.stderr).as_ref()), (Some(0), ""));
}

#[test]
fn values_at_points() {
    let folder = folder(&[("ball.geo", BALL.as_bytes()), ("p.tsv", b"x1 x2 x3\n0 0 0\n1,0,0.5\n")]);
    let sampled =
        |arguments: &[&str], input: &str| run(folder.path(), &[&["sample", "ball.geo"], arguments].concat(), input);
    assert_eq!(sampled(&["--points", "p.tsv"], "").out, "4\n2.75\n");
    assert_eq!(sampled(&[], "2 0 0\n").out, "0\n");
    assert_eq!(
        sampled(&["--gradient"], "1 0 0.5").out.split_whitespace().collect::<Vec<_>>(),
        ["2.75", "-2", "0", "-1"]
    );
    assert_eq!(sampled(&["-D", "r=SQRT(x1)"], "-1 0 0").out, "nan\n");
    let wrong = sampled(&[], "1 2\n");
    assert_eq!(wrong.status, Some(3), "{}", wrong.err);
    assert!(wrong.err.contains('2') && wrong.err.contains('3'), "two numbers for three coordinates: {}", wrong.err);
    assert_eq!(sampled(&["--points", "none.tsv"], "").status, Some(4));
    assert_eq!(sampled(&["-o", "values.txt"], "0 0 0").made, ["values.txt"]);
}

#[test]
fn measures_and_objects_as_json() {
    let measured = with_ball(&["measure", "ball.geo", "--json", "--resolution", "32"]);
    let value: serde_json::Value = serde_json::from_str(&measured.out).expect("JSON");
    let volume = value["volume"]["value"].as_f64().expect("a number");
    assert!((volume / 33.510_321_638 - 1.0).abs() < 0.01, "{volume}");
    assert_eq!((&value["euler"], &value["components"], &value["closed"]), (&2.into(), &1.into(), &true.into()));
    assert!(value["bounds"]["x1"].is_array() && value["area"]["error"].is_number(), "{value}");
    let info = with_ball(&["info", "ball.geo", "--json"]);
    let value: serde_json::Value = serde_json::from_str(&info.out).expect("JSON");
    let object = &value["objects"][0];
    assert_eq!((&object["name"], &object["doc"]), (&"gob_ball".into(), &"A ball".into()), "{value}");
    assert_eq!(object["coordinates"], serde_json::json!(["x1", "x2", "x3"]));
    assert!(object["operations"].as_u64().is_some_and(|count| count > 3), "{value}");
}

#[test]
fn formatting_keeps_the_meaning_and_is_stable() {
    let folder = folder(&[("a.geo", b"a=1+2 ; PRINT  a;\n")]);
    assert_eq!(run(folder.path(), &["fmt", "--check", "a.geo"], "").status, Some(1));
    assert_eq!(run(folder.path(), &["fmt", "a.geo"], "").status, Some(0));
    assert_eq!(run(folder.path(), &["fmt", "--check", "a.geo"], "").status, Some(0));
    let formatted = fs::read_to_string(folder.path().join("a.geo")).expect("a text");
    assert_eq!(run(folder.path(), &["fmt", "-"], &formatted).out, formatted);
    assert_eq!(run(folder.path(), &["a.geo"], "").out.lines().last(), Some("3"));
    fs::write(folder.path().join("b.geo"), "a = (;\n").expect("room");
    assert_eq!(run(folder.path(), &["fmt", "b.geo"], "").status, Some(3));
    assert_eq!(fs::read_to_string(folder.path().join("b.geo")).expect("a text"), "a = (;\n", "not touched");
}

#[test]
fn completions_and_the_manual_page_are_there() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        assert!(with_ball(&["completions", shell]).out.contains("resolution"), "{shell}");
    }
    let man = with_ball(&["man"]).out;
    assert!(man.contains(".TH yont") && man.contains(".SH YONT SAMPLE"), "{man}");
    let sample = man.split(".SH YONT SAMPLE").nth(1).and_then(|rest| rest.split(".SH ").next());
    assert!(sample.is_some_and(|options| options.contains("points")), "{man}");
    assert!(with_ball(&["doc", "sqrt"]).out.contains("SQRT("));
    assert!(with_ball(&["doc", "gob_ball", "--file", "ball.geo"]).out.contains("A ball"));
}

/// What the command line says of a program holds as what the program says of itself does.
#[test]
fn the_command_line_defines() {
    let range = "r = 2 IN [1, 8]; gob_a = r - x1**2; gob_a(0)";
    let five = "gob_a = 1 - x1**2 - x2**2 - x5;";
    for (arguments, out, err, status) in [
        (&["-e", "a = 4; b = a"][..], "", "", 0),
        (&["-e", "a = 4", "-e", "a"], "4\n", "", 0),
        (&["-e", "PRINT 3"], "3\n", "", 0),
        (&["-e", "a = b"], "", "`b` is not defined", 3),
        (&["-e", range, "-D", "r=3"], "3\n", "", 0),
        (&["-e", range, "-D", "r=-1"], "-1\n", "`r` is -1, outside its range [1, 8]", 0),
        (&["-e", range, "-D", "r=2; q=3"], "", "give -D again", 2),
        (&["measure", "-e", five, "--at", "x5=0.75", "--resolution", "16"], "area          0.7", "", 0),
        (&["info", "-e", "a = 1;"], "", "nothing here is an object", 0),
    ] {
        let ran = with_ball(arguments);
        assert_eq!(ran.status, Some(status), "{arguments:?}: {}{}", ran.out, ran.err);
        assert!(ran.out.contains(out) && ran.err.contains(err), "{arguments:?}: {}{}", ran.out, ran.err);
    }
    let folder = folder(&[]);
    let sampled = run(folder.path(), &["sample", "-e", "gob_a = x5 - x1;"], "1 2 3 4 5\n");
    assert_eq!((sampled.status, &*sampled.out), (Some(0), "4\n"), "{}", sampled.err);
}

/// For each option of a run: the arguments without it and with it, which must not give the same.
const OPTIONS: &[(&str, &[&str], &[&str])] = &[
    ("code", &["ball.geo"], &["ball.geo", "-e", "r"]),
    ("define", &["ball.geo", "-o", "-", "--format", "stl"], &["ball.geo", "-o", "-", "--format", "stl", "-D", "r=1"]),
    ("output", &["ball.geo"], &["ball.geo", "-o", "a.stl"]),
    ("route", STL, &["ball.geo", "-o", "-", "--format", "stl", "--route", "cubes"]),
    ("guide", STL, &["ball.geo", "-o", "-", "--format", "stl", "--guide", "sphere:2"]),
    ("center", STL, &["ball.geo", "-o", "-", "--format", "stl", "--center", "0.1,0,0"]),
    ("format", &["ball.geo", "-o", "-", "--format", "stl"], &["ball.geo", "-o", "-", "--format", "obj"]),
    ("interactive", &["ball.geo"], &["ball.geo", "-i"]),
    ("exit_status", &["-e", "0"], &["-e", "0", "--exit-status"]),
    (
        "object",
        &["ball.geo", "-e", "gob_b = 1 - x1**2-x2**2-x3**2;", "-o", "-", "--format", "obj"],
        &["ball.geo", "-e", "gob_b = 1 - x1**2-x2**2-x3**2;", "-o", "-", "--format", "obj", "--object", "gob_ball"],
    ),
    (
        "at",
        &["growing.geo", "-o", "-", "--format", "stl", "--at", "x4=0"],
        &["growing.geo", "-o", "-", "--format", "stl", "--at", "x4=1"],
    ),
    (
        "bounds",
        &["ball.geo", "-o", "-", "--format", "stl"],
        &["ball.geo", "-o", "-", "--format", "stl", "--bounds", "x1=-4:4,x2=-4:4"],
    ),
    (
        "resolution",
        &["ball.geo", "-o", "-", "--format", "stl"],
        &["ball.geo", "-o", "-", "--format", "stl", "--resolution", "9"],
    ),
    ("cell", &["ball.geo", "-o", "-", "--format", "stl"], &["ball.geo", "-o", "-", "--format", "stl", "--cell", "0.7"]),
    (
        "precision",
        &["ball.geo", "-o", "-", "--format", "stl", "--route", "cubes"],
        &["ball.geo", "-o", "-", "--format", "stl", "--route", "cubes", "--precision", "single"],
    ),
    ("sharp", HALF, &["ball.geo", "-e", HALF_BALL, "-o", "-", "--format", "stl", "--sharp"]),
    ("size", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--size", "20x30"]),
    ("camera", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--camera", "120,-10"]),
    ("projection", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--projection", "orthographic"]),
    ("light", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--light", "-60,10"]),
    ("fill", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--fill", "off"]),
    ("shadow", SHADY, &["ball.geo", "-e", PLATE, "-o", "-", "--format", "png", "--shadow", "off"]),
    ("no_shadow", SHADY, &["ball.geo", "-e", PLATE, "-o", "-", "--format", "png", "--no-shadow"]),
    ("occlusion", SHADY, &["ball.geo", "-e", PLATE, "-o", "-", "--format", "png", "--occlusion"]),
    ("background", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--background", "transparent"]),
    ("cut", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--cut", "x1<0.5"]),
    ("view", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--view", "top"]),
    (
        "palette",
        &["disc.geo", "-o", "-", "--format", "png"],
        &["disc.geo", "-o", "-", "--format", "png", "--palette", "mono"],
    ),
    ("supersample", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--supersample", "3"]),
    ("axes", PICTURE, &["ball.geo", "-o", "-", "--format", "png", "--axes"]),
    (
        "slices",
        &["ball.geo", "-o", "-", "--format", "svg", "--slices", "x3=-1:1:3"],
        &["ball.geo", "-o", "-", "--format", "svg", "--slices", "x2=-1:1:4"],
    ),
    ("frames", MOVING, &["growing.geo", "-o", "-", "--format", "gif", "--size", "32x32", "--frames", "3"]),
    ("fps", MOVING, &["growing.geo", "-o", "-", "--format", "gif", "--size", "32x32", "--fps", "10"]),
    ("threads", &["-j", "1", "ball.geo"], &["-j", "0", "ball.geo"]),
    ("timings", &["ball.geo"], &["ball.geo", "--timings"]),
    ("quiet", &["ball.geo", "-o", "a.stl"], &["ball.geo", "-o", "a.stl", "-q"]),
    ("verbose", &["ball.geo", "-o", "a.stl"], &["ball.geo", "-o", "a.stl", "-v"]),
    ("color", &["none.geo"], &["none.geo", "--color", "always"]),
    ("diagnostics", &["none.geo"], &["none.geo", "--diagnostics", "json"]),
    ("images", &["ball.geo"], &["ball.geo", "--images", "half"]),
    ("no_config", MOVING, &["growing.geo", "-o", "-", "--format", "gif", "--size", "32x32", "--no-config"]),
    ("strict", &["-e", "r = 1; q = r; r = 2;"], &["-e", "r = 1; q = r; r = 2;", "-W"]),
    ("no_prelude", &["-e", "rel_inside(x1, [1]);"], &["-e", "rel_inside(x1, [1]);", "--no-prelude"]),
];
const STL: &[&str] = &["ball.geo", "-o", "-", "--format", "stl"];
const PICTURE: &[&str] = &["ball.geo", "-o", "-", "--format", "png"];
/// A ball with an edge.
const HALF_BALL: &str = "gob_half = gob_ball & 0.1 - x1 - 0.3*x2;";
const HALF: &[&str] = &["ball.geo", "-e", HALF_BALL, "-o", "-", "--format", "stl"];
/// A plate below the ball, which throws its shadow on it.
const PLATE: &str = "gob_plate = (x3 + 1.95 & -1.85 - x3) | gob_ball;";
const SHADY: &[&str] = &["ball.geo", "-e", PLATE, "-o", "-", "--format", "png"];
const MOVING: &[&str] = &["growing.geo", "-o", "-", "--format", "gif", "--size", "32x32"];

#[test]
fn every_option_does_something() {
    let folder =
        folder(&[("ball.geo", BALL.as_bytes()), ("growing.geo", GROWING.as_bytes()), ("disc.geo", DISC.as_bytes())]);
    fs::create_dir_all(folder.path().join(".config/yont")).expect("a folder");
    fs::write(folder.path().join(".config/yont/config"), "fps 7\n").expect("room");
    for (name, without, with) in OPTIONS {
        let run = |arguments: &[&str]| {
            command(folder.path()).args(arguments).write_stdin("1\n").output().expect("yont starts")
        };
        assert_ne!(run(without), run(with), "--{name} does nothing");
    }
    for argument in Cli::command().get_arguments().filter(|argument| !argument.is_positional()) {
        let known = OPTIONS.iter().any(|(name, _, _)| argument.get_id() == *name);
        assert!(known, "no case shows what --{} does", argument.get_id());
    }
}
