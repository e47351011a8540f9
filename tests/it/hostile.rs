//! Bad input: each gets its status, words that help, and no file.

use std::os::unix::fs::{PermissionsExt, symlink};

use super::cli::{BALL, folder, run};

/// Bounds for the programs below.
const SPACE: &str = "x1min=-2; x1max=2; x2min=-2; x2max=2; x3min=-2; x3max=2;";

/// A program, what it is about, the status, and words that the message must say.
const PROGRAMS: &[(&str, &str, i32, &[&str])] = &[
    ("unknown name", "gob_a = radius**2 - x1**2; radios = 1;", 3, &["radius", "radios"]),
    ("unknown function", "gob_a = SQTR(x1);", 3, &["SQTR", "SQRT"]),
    ("text for a number", "gob_a = SIN(\"t\") - x1;", 3, &["text"]),
    ("array for an object", "a = [1, 2]; pob_p(f) = f - x1; gob_a = pob_p(a) ;", 3, &["array"]),
    ("too many arguments", "gob_a = SIN(x1, x2);", 3, &["SIN", "1"]),
    ("too few parameters", "pob_p(a, b) = a - b*x1; gob_a = pob_p(1);", 3, &["pob_p", "2"]),
    ("open bracket", "gob_a = (1 - x1**2;", 3, &["("]),
    ("bracket too many", "gob_a = 1 - x1**2);", 3, &[")"]),
    ("open block", "WHILE (i < 3) DO BEGIN i = i + 1;", 3, &["BEGIN"]),
    ("open comment", "gob_a = 1; { and so on", 3, &["{"]),
    ("open text", "PRINT \"abc;", 3, &["\""]),
    ("loop that never ends", "i = 1; WHILE (i > 0) DO i = i + 1; gob_a = i - x1**2;", 3, &["WHILE"]),
    ("loop that cannot end", "i = 1; j = 1; WHILE (i > 0) DO j = j + 1; gob_a = j - x1**2;", 3, &["i"]),
    ("circle", "gob_a = b - x1**2; b = c + 1; c = b - 1;", 3, &["b", "c"]),
    ("endless recursion", "f(n) = f(n + 1); gob_a = f(1) - x1**2;", 3, &["f"]),
    ("index out of range", "a = [1, 2, 3]; gob_a = a[4] - x1**2;", 3, &["4", "3"]),
    ("known to be undefined", "gob_a = SQRT(-1) - x1**2;", 3, &["SQRT"]),
    ("no such coordinate", "gob_a = 1 - x17**2;", 3, &["x17"]),
    (
        "missing volume",
        "gob_a = INTERPOLATE(\"trilinear\", \"none.nrrd\", x1, x2, x3);",
        4,
        &["none.nrrd", "no such file"],
    ),
    ("truncated volume", "gob_a = INTERPOLATE(\"trilinear\", \"short.nrrd\", x1, x2, x3);", 4, &["short.nrrd"]),
    ("lying volume", "gob_a = INTERPOLATE(\"trilinear\", \"lying.nrrd\", x1, x2, x3);", 4, &["lying.nrrd"]),
    ("garbage volume", "gob_a = INTERPOLATE(\"trilinear\", \"garbage.nrrd\", x1, x2, x3);", 4, &["garbage.nrrd"]),
    ("folder as volume", "gob_a = INTERPOLATE(\"trilinear\", \".\", x1, x2, x3);", 4, &["folder"]),
    ("missing include", "INCLUDE \"none.geo\"; gob_a = 1 - x1**2;", 4, &["none.geo"]),
    ("circle of includes", "INCLUDE \"again.geo\"; gob_a = 1 - x1**2;", 3, &["again.geo"]),
    ("empty object", "gob_a = -1 - x1**2 - x2**2 - x3**2;", 1, &["gob_a"]),
    ("nothing to make", "a = 1;", 3, &["gob_"]),
];

#[test]
fn bad_programs_get_a_status_and_a_message_and_make_nothing() {
    for (what, program, status, words) in PROGRAMS {
        let text = format!("{program}\n{SPACE}\n");
        let files: [(&str, &[u8]); 5] = [
            ("a.geo", text.as_bytes()),
            ("again.geo", b"INCLUDE \"again.geo\";"),
            ("short.nrrd", b"NRRD0004\ntype: float\ndimension: 3\nsizes: 4 4 4\nencoding: raw\nendian: little\n\n1234"),
            ("lying.nrrd", b"NRRD0004\ntype: float\ndimension: 3\nsizes: 99999999 99999999 99999999\nencoding: gzip\nendian: little\n\n1234"),
            ("garbage.nrrd", b"\x00\xff\x12\x80garbage"),
        ];
        let folder = folder(&files);
        let ran = run(folder.path(), &["a.geo", "-o", "a.stl", "--resolution", "8"], "");
        assert_eq!(ran.status, Some(*status), "{what}: {}", ran.err);
        assert!(ran.made.is_empty(), "{what}: left {:?}", ran.made);
        assert_eq!(ran.out, "", "{what}");
        for word in *words {
            assert!(ran.err.contains(word), "{what}: does not say {word:?}:\n{}", ran.err);
        }
        assert!(!ran.err.contains("panicked"), "{what}: {}", ran.err);
    }
}

#[test]
fn texts_that_are_none() {
    let deep = "(".repeat(100_000);
    let long_line = "1+".repeat(100_000);
    let prefix = "-".repeat(100_000);
    let arrays = "[".repeat(100_000);
    let blocks = "IF (1) THEN BEGIN ".repeat(100_000);
    let garbage: Vec<u8> = (0..20_000u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    let cases: &[(&str, &[u8], i32)] = &[
        ("100,000 brackets", deep.as_bytes(), 3),
        ("a sum that ends open", long_line.as_bytes(), 3),
        ("100,000 minus signs", prefix.as_bytes(), 3),
        ("100,000 arrays", arrays.as_bytes(), 3),
        ("100,000 blocks", blocks.as_bytes(), 3),
        ("binary garbage", &garbage, 4),
        ("zeros", &[0; 5000], 3),
        ("control characters", b"\x01\x02\x1b[2J\x07;;;", 3),
        ("one quote", b"\"", 3),
    ];
    for (what, text, status) in cases {
        let folder = folder(&[("a.geo", text)]);
        let ran = run(folder.path(), &["a.geo", "-o", "a.stl"], "");
        assert_eq!(ran.status, Some(*status), "{what}: {}", ran.err);
        assert!(ran.made.is_empty(), "{what}");
        assert!(ran.err.len() < 100_000, "{what}: a message of {} bytes", ran.err.len());
        assert!(!ran.err.contains("\x1b[2J"), "{what}: control characters reach the terminal");
    }
}

#[test]
fn spaces_that_cannot_be_filled() {
    let cases: &[(&str, &[&str], &[&str])] = &[
        ("no extent", &["-e", "x1min = 2;"], &["x1"]),
        ("reversed", &["-e", "x1min = 3;"], &["x1"]),
        ("infinite", &["-e", "x1min = -1e308; x1max = 1e308;"], &["x1"]),
        ("no bounds", &["-e", "gob_b = 1 - x5**2;"], &["x5"]),
        ("too many cells", &["--resolution", "100000000"], &["resolution"]),
        ("cells too small", &["--cell", "1e-9"], &["cell"]),
        ("cells of no size", &["--cell", "0"], &["cell"]),
        ("negative cells", &["--cell=-1"], &["cell"]),
    ];
    for (what, arguments, words) in cases {
        let text = format!("gob_a = 1 - x1**2 - x2**2 - x3**2; {SPACE}");
        let folder = folder(&[("a.geo", text.as_bytes())]);
        let ran = run(folder.path(), &[&["a.geo", "-o", "a.stl"], *arguments].concat(), "");
        assert!(matches!(ran.status, Some(2 | 3)), "{what}: {:?} {}", ran.status, ran.err);
        assert!(ran.made.is_empty(), "{what}");
        for word in *words {
            assert!(ran.err.contains(word), "{what}: does not say {word:?}:\n{}", ran.err);
        }
    }
    for size in ["100000x100000", "999999999999x1"] {
        let folder = folder(&[("a.geo", BALL.as_bytes())]);
        let ran = run(folder.path(), &["a.geo", "-o", "a.png", "--size", size], "");
        assert!(matches!(ran.status, Some(2 | 3)) && ran.made.is_empty(), "{size}: {}", ran.err);
    }
}

#[test]
fn places_that_cannot_be_written() {
    let folder = folder(&[("a.geo", BALL.as_bytes())]);
    let locked = folder.path().join("locked");
    std::fs::create_dir(&locked).expect("room");
    std::fs::create_dir(folder.path().join("folder.stl")).expect("room");
    std::fs::set_permissions(&locked, std::fs::Permissions::from_mode(0o555)).expect("own folder");
    symlink("/dev/full", folder.path().join("full.stl")).expect("room");
    let root = std::fs::write(locked.join("probe"), b"").is_ok();
    let mut cases = vec![
        ("no/folder/a.stl", "folder does not exist"),
        ("folder.stl", "it is a folder"),
        ("full.stl", "the disk is full"),
        ("a.geo/a.stl", "folder does not exist"),
        ("/proc/a.stl", ""),
    ];
    if root {
        std::fs::remove_file(locked.join("probe")).expect("own file");
        eprintln!("skipped: this user may write into a locked folder");
    } else {
        cases.push(("locked/a.stl", "permission denied"));
    }
    for (place, words) in cases {
        let ran = run(folder.path(), &["a.geo", "-o", place, "--resolution", "8"], "");
        assert_eq!(ran.status, Some(4), "{place}: {}", ran.err);
        assert!(ran.err.contains(place) && ran.err.contains(words), "{place}: {}", ran.err);
        assert!(ran.made.is_empty(), "{place}: left {:?}", ran.made);
    }
    assert!(std::fs::read_dir(&locked).expect("own folder").next().is_none(), "nothing is left in the locked folder");
}

#[test]
fn a_failed_write_leaves_the_old_file() {
    let folder = folder(&[("a.geo", BALL.as_bytes()), ("a.stl", b"precious")]);
    for arguments in [["--object", "gob_none"], ["-D", "gob_ball=-1-x1**2"], ["--resolution", "100000000"]] {
        let ran = run(folder.path(), &[&["a.geo", "-o", "a.stl"], arguments.as_slice()].concat(), "");
        assert_ne!(ran.status, Some(0), "{arguments:?}");
        assert_eq!(std::fs::read(folder.path().join("a.stl")).expect("it stands"), b"precious", "{arguments:?}");
    }
}

#[test]
fn what_is_no_file_is_not_read() {
    let folder = folder(&[]);
    let pipe = folder.path().join("pipe.geo");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()), "mkfifo is part of every Unix");
    for (file, words) in
        [("pipe.geo", "a pipe"), ("/dev/zero", "a device"), (".", "a folder"), ("none", "no such file")]
    {
        let ran = run(folder.path(), &[file], "");
        assert_eq!(ran.status, Some(4), "{file}: {}", ran.err);
        assert!(ran.err.contains(words), "{file}: {}", ran.err);
    }
}
