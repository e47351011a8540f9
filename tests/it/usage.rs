//! What people type wrong on the command line, and the file of settings.

use std::fs;

use super::cli::{BALL, folder, run};

/// What is typed, what the message says, the status.
const MISTAKES: &[(&[&str], &[&str], i32)] = &[
    (&["chek", "ball.geo"], &["did you mean `yont check`?"], 2),
    (&["chek"], &["did you mean `yont check`?"], 4),
    (&["render", "ball.geo"], &["-o picture.png"], 2),
    (&["ball"], &["did you mean `ball.geo`?"], 4),
    (&["bal.geo"], &["did you mean `ball.geo`?"], 4),
    (&["ball.geo", "a.stl"], &["-o a.stl"], 2),
    (&["ball.geo", "r=3"], &["-D r=3"], 2),
    (&["ball.geo", "ball.geo"], &["one program at a time"], 2),
    (&["ball.geo", "-o", "a.slt"], &["did you mean `.stl`?"], 2),
    (&["ball.geo", "-o", "a.jpg"], &["a picture is a `.png`"], 2),
    (&["ball.geo", "-o", "a.mp4"], &["`.gif`"], 2),
    (&["ball.geo", "-o", "a"], &["no extension", ".stl .obj"], 2),
    (&["ball.geo", "-o", "a.stl", "-o", "a.stl"], &["given twice"], 2),
    (&["ball.geo", "--size", "640"], &["as in 640x480"], 2),
    (&["ball.geo", "--resolutoin", "3"], &["'--resolution'"], 2),
    (&["ball.geo", "--view", "tpo", "-o", "a.png"], &["'top'"], 2),
    (&["ball.geo", "--at", "z=1", "-o", "a.stl"], &["`z` is not a coordinate"], 2),
    (&["ball.geo", "--object", "ball", "-o", "a.stl"], &["did you mean `gob_ball`?"], 3),
    (&["ball.geo", "-o", "none/a.stl"], &["its folder does not exist"], 4),
    (&["ball.geo", "--size", "9x9"], &["--size has no effect", "-o OUT"], 0),
    (&["ball.geo", "--size", "9x9", "-W"], &["--size has no effect"], 3),
    (&["doc", "sqrtt"], &["did you mean `SQRT`?"], 2),
    (&["doc", "gob_bal", "--file", "ball.geo"], &["did you mean `gob_ball`?"], 2),
    (&["info", "--paths", "ball.geo"], &["cannot be used"], 2),
    (&["fmt", "--chekc", "ball.geo"], &["'--check'"], 2),
    (&["completions", "fihs"], &["'fish'"], 2),
];

#[test]
fn mistakes_lead_to_what_was_meant() {
    for (arguments, words, status) in MISTAKES {
        let folder = folder(&[("ball.geo", BALL.as_bytes())]);
        let ran = run(folder.path(), arguments, "");
        assert_eq!(ran.status, Some(*status), "{arguments:?}: {}", ran.err);
        for words in *words {
            assert!(ran.err.contains(words), "{arguments:?}: no {words:?} in\n{}", ran.err);
        }
        assert!(ran.made.is_empty(), "{arguments:?} left {:?}", ran.made);
    }
}

#[test]
fn options_without_effect_are_told_once() {
    let folder = folder(&[("ball.geo", BALL.as_bytes())]);
    let sizes = ["--resolution", "8", "--size", "16x12", "--fps", "3"];
    for (outputs, told) in [
        (&["-o", "a.stl"][..], &["--size", "--fps"][..]),
        (&["-o", "b.stl", "-o", "b.png"], &["--fps"]),
        (&["-o", "c.png"], &["--fps"]),
        (&["-o", "d.pov"], &["--size", "--fps"]),
    ] {
        // Where the camera stands matters to a picture, and to a scene.
        let view: &[&str] = if outputs[1] == "a.stl" { &[] } else { &["--view", "top"] };
        let ran = run(folder.path(), &[&["ball.geo"], outputs, &sizes, view].concat(), "");
        assert_eq!(ran.status, Some(0), "{outputs:?}: {}", ran.err);
        assert_eq!(ran.err.matches("has no effect").count(), told.len(), "{outputs:?}: {}", ran.err);
        assert!(told.iter().all(|option| ran.err.contains(&format!("{option} has no effect"))), "{}", ran.err);
    }
}

#[test]
fn words_of_the_language_are_explained() {
    let folder = folder(&[("ball.geo", BALL.as_bytes())]);
    for (arguments, words) in [
        (&["doc", "while"][..], "WHILE (c) DO s;"),
        (&["doc", "R_ALPHA"], "r_alpha = 1;"),
        (&["doc", "x2max"], "modelling space along x2"),
        (&["doc", "gob_ball", "--file", "ball.geo"], "object of x1, x2, x3\n    A ball\n"),
        (&["doc", "r", "--file", "ball.geo"], "r = 2\n"),
    ] {
        let ran = run(folder.path(), arguments, "");
        assert_eq!((ran.status, ran.err.as_str()), (Some(0), ""), "{arguments:?}");
        assert!(ran.out.contains(words), "{arguments:?}: {}", ran.out);
    }
}

#[test]
fn the_file_of_settings() {
    type Words<'a> = &'a [&'a str];
    let cases: &[(&str, Words<'_>, Words<'_>, Words<'_>, i32)] = &[
        ("# nothing\n\n", &["ball.geo", "-o", "a.png", "-v"], &[], &["640 x 480"], 0),
        ("size 32x24\n", &["ball.geo", "-o", "a.png", "-v"], &[], &["32 x 24 pixels"], 0),
        ("size = 32x24 # small\n", &["-v", "run", "ball.geo", "-o", "a.png"], &[], &["32 x 24 pixels"], 0),
        ("--size=32x24\n", &["ball.geo", "-o", "a.png", "-v", "--size", "40x30"], &[], &["40 x 30 pixels"], 0),
        ("size 32x24\n", &["ball.geo", "-o", "a.png", "-v", "--no-config"], &[], &["640 x 480"], 0),
        ("view top\n", &["ball.geo", "-o", "a.png", "--camera", "1,2", "--size", "8x8"], &[], &["a.png"], 0),
        ("fps 7\n", &["ball.geo", "-o", "a.png", "--size", "8x8"], &[], &["a.png\n"], 0),
        ("cell 3\n", &["ball.geo", "-o", "a.stl", "--resolution", "8"], &[], &["a.stl"], 0),
        ("verbose\n", &["ball.geo", "-o", "a.stl", "-q", "--resolution", "8"], &[], &[], 0),
        ("resolution 8\n", &["measure", "ball.geo", "--json"], &["\"resolution\":8"], &[], 0),
        ("resolution 8\n", &["check", "ball.geo"], &[], &[], 0),
        ("diagnostics short\nresolution 8\n", &["-e", "a ="], &[], &["-e:1:"], 3),
        ("resolution 8\nview top\n", &[], &["resolution 8\nview top\n"], &[], 0),
        ("resolutoin 8\n", &["ball.geo"], &[], &["config:1:1", "`resolutoin` is no setting", "`resolution`"], 2),
        ("\nresolution much\n", &["ball.geo"], &[], &["config:2:1", "`much` is not a whole number", "--no-config"], 2),
        ("resolution\n", &["ball.geo"], &[], &["`resolution` needs a value"], 2),
        ("axes yes\n", &["ball.geo"], &[], &["takes no value"], 2),
        ("object gob_a\n", &["ball.geo"], &[], &["belongs to one run"], 2),
        ("view top\ncamera 1,2\n", &["ball.geo"], &[], &["cannot be used with"], 2),
    ];
    for (settings, arguments, out, err, status) in cases {
        let folder = folder(&[("ball.geo", BALL.as_bytes())]);
        fs::create_dir_all(folder.path().join(".config/yont")).expect("a folder");
        fs::write(folder.path().join(".config/yont/config"), settings).expect("room");
        let ran = run(folder.path(), arguments, if arguments.is_empty() { ":set\n" } else { "" });
        assert_eq!(ran.status, Some(*status), "{settings:?} {arguments:?}: {}{}", ran.out, ran.err);
        for (text, expected) in [(&ran.out, out), (&ran.err, err)] {
            assert!(
                expected.iter().all(|words| text.contains(words)),
                "{settings:?} {arguments:?}: {expected:?} in\n{text}"
            );
        }
        assert_eq!(ran.err.is_empty(), err.is_empty(), "{settings:?} {arguments:?}: {}", ran.err);
    }
}

#[test]
fn paths_are_told() {
    let folder = folder(&[]);
    let ran = run(folder.path(), &["info", "--paths"], "");
    assert_eq!((ran.status, ran.err.as_str()), (Some(0), ""));
    for words in [".config/yont/config", ".state/yont/history", ".state/yont/sessions"] {
        assert!(ran.out.contains(words), "{words}: {}", ran.out);
    }
    let json = run(folder.path(), &["info", "--paths", "--json"], "").out;
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert!(json["settings"].as_str().is_some_and(|path| path.ends_with("config")), "{json}");
}
