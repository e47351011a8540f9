//! Volume files in every spelling that their formats allow, against numbers and places that this page computes by itself.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::io::{self, Read, Write};
use std::sync::Arc;

use proptest::prelude::*;
use yont::data::{self, Context, DataError, Interpolation, Placement, Samples, Volume};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::Leaf;

use crate::data::{gzip, leaf, shared};

/// Decodes a header or file; other files by their names.
fn decode(bytes: &[u8], files: &[(&str, Vec<u8>)]) -> Result<Volume, DataError> {
    let files: BTreeMap<&str, &Vec<u8>> = files.iter().map(|(name, bytes)| (*name, bytes)).collect();
    let mut fetch = |name: &str| files.get(name).map(|b| b.to_vec()).ok_or(io::Error::from(io::ErrorKind::NotFound));
    let (limits, interrupt) = (Limits { data_bytes: 1 << 20, ..Limits::default() }, Interrupt::default());
    data::decode("a.nrrd", bytes, &mut fetch, Context { limits: &limits, interrupt: &interrupt })
}

fn values(volume: &Volume) -> Vec<f64> {
    (0..volume.samples.len()).map(|n| volume.samples.get(n)).collect()
}

/// A number type: its names, its numbers for the test, and their bytes from the most significant one.
type Type = (&'static [&'static str], [f64; 3], fn(f64) -> Vec<u8>);

const TYPES: &[Type] = &[
    (&["signed char", "int8", "int8_t"], [-128.0, -1.0, 127.0], |v| (v as i8).to_be_bytes().to_vec()),
    (&["uchar", "unsigned char", "uint8", "uint8_t"], [0.0, 7.0, 255.0], |v| (v as u8).to_be_bytes().to_vec()),
    (&["short", "short int", "signed short", "signed short int", "int16", "int16_t"], [-32768.0, -2.0, 32767.0], |v| {
        (v as i16).to_be_bytes().to_vec()
    }),
    (&["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"], [0.0, 258.0, 65535.0], |v| {
        (v as u16).to_be_bytes().to_vec()
    }),
    (&["int", "signed int", "int32", "int32_t"], [-2_147_483_648.0, -3.0, 16_777_217.0], |v| {
        (v as i32).to_be_bytes().to_vec()
    }),
    (&["uint", "unsigned int", "uint32", "uint32_t"], [0.0, 16_777_217.0, 4_294_967_295.0], |v| {
        (v as u32).to_be_bytes().to_vec()
    }),
    (
        &["longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"],
        [-9_007_199_254_740_992.0, -4.0, 4_294_967_296.0],
        |v| (v as i64).to_be_bytes().to_vec(),
    ),
    (
        &["ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"],
        [0.0, 5.0, 9_007_199_254_740_992.0],
        |v| (v as u64).to_be_bytes().to_vec(),
    ),
    (&["float"], [-1.5, 0.1_f32 as f64, 3e38_f32 as f64], |v| (v as f32).to_be_bytes().to_vec()),
    (&["double"], [-1.5, 0.1, 1e300], |v| v.to_be_bytes().to_vec()),
];

fn bzip2(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ::bzip2::write::BzEncoder::new(Vec::new(), ::bzip2::Compression::best());
    encoder.write_all(bytes).expect("memory");
    encoder.finish().expect("memory")
}

fn hex(bytes: &[u8]) -> Vec<u8> {
    bytes
        .iter()
        .enumerate()
        .map(|(n, b)| format!("{b:02X}{}", if n % 3 == 0 { "\n" } else { " " }))
        .collect::<String>()
        .into()
}

#[test]
fn every_type_in_every_encoding_and_byte_order() {
    for (names, numbers, bytes) in TYPES {
        for name in *names {
            for big in [false, true] {
                let of = |value: f64| {
                    let mut bytes = bytes(value);
                    if !big {
                        bytes.reverse();
                    }
                    bytes
                };
                let raw: Vec<u8> = numbers.iter().flat_map(|&v| of(v)).collect();
                let text = numbers.map(|v| v.to_string()).join(" ").into_bytes();
                let encodings: [(&[&str], Vec<u8>); 5] = [
                    (&["raw", "RAW"], raw.clone()),
                    (&["gzip", "gz"], gzip(&raw)),
                    (&["bzip2", "bz2"], bzip2(&raw)),
                    (&["text", "txt", "ascii", "ASCII"], text),
                    (&["hex"], hex(&raw)),
                ];
                for (spellings, payload) in encodings {
                    for spelling in spellings {
                        let endian = if big { "big" } else { "little" };
                        let head = format!(
                            "NRRD0004\ntype: {name}\ndimension: 1\nsizes: 3\nendian: {endian}\nencoding: {spelling}\n"
                        );
                        let attached = [head.as_bytes(), b"\n", &payload].concat();
                        let volume = decode(&attached, &[]).unwrap_or_else(|e| panic!("{head}: {e}"));
                        assert_eq!(values(&volume), numbers, "{head}");
                        let detached = format!("{head}data file: there.raw\n");
                        let volume = decode(detached.as_bytes(), &[("there.raw", payload.clone())]);
                        assert_eq!(values(&volume.expect("detached")), numbers, "{detached}");
                    }
                }
            }
        }
    }
}

/// Each header's lines of geometry for samples of the sizes, and the place of the first sample and of the one at index 1 on every axis.
const PLACES: &[(&str, &[f64], &[f64])] = &[
    ("sizes: 3", &[0.0], &[1.0]),
    ("sizes: 3\nspacings: 0.5", &[0.0], &[0.5]),
    ("sizes: 3\nspacings: 0.5\naxis mins: 7", &[7.0], &[7.5]),
    ("sizes: 3\naxismins: 1\naxismaxs: 2", &[1.0], &[1.5]),
    ("sizes: 3\naxis mins: 1\naxis maxs: 2\ncenters: node", &[1.0], &[1.5]),
    ("sizes: 3\naxis mins: 1\naxis maxs: 2.5\ncenters: cell", &[1.25], &[1.75]),
    ("sizes: 3\nspacings: 0.5\naxis mins: 1\ncenterings: cell", &[1.25], &[1.75]),
    ("sizes: 3\nspacings: nan\naxis mins: nan", &[0.0], &[1.0]),
    ("sizes: 3\nspacings: -2\naxis mins: 4", &[4.0], &[2.0]),
    ("sizes: 1\naxis mins: 4\naxis maxs: 4", &[4.0], &[5.0]),
    ("sizes: 2 3\nspacings: 0.5 2", &[0.0, 0.0], &[0.5, 2.0]),
    ("sizes: 2 3\nspacings: 0.5 nan\naxis mins: nan -1\naxis maxs: nan 3", &[0.0, -1.0], &[0.5, 1.0]),
    (
        "space dimension: 2\nsizes: 2 3\nspace directions: (0,2) (3,0)\nspace origin: (10,20)",
        &[10.0, 20.0],
        &[13.0, 22.0],
    ),
    ("space: left-posterior-superior\nsizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1)", &[0.0; 3], &[1.0; 3]),
    (
        "space dimension: 3\nsizes: 2 2 2\nspace directions: (1, 0, 0.5)  (0,-2,0) (0.25,0,3)\nspace origin: ( 1,2 , 3)",
        &[1.0, 2.0, 3.0],
        &[2.25, 0.0, 6.5],
    ),
    (
        "sizes: 2 2 2\nspacings: 1 2 3\nkinds: domain space time\nlabels: \"x\" \"y: z\" \"t\"\nunits: \"mm\" \"\" \"s\"",
        &[0.0; 3],
        &[1.0, 2.0, 3.0],
    ),
    (
        "sizes: 2 2 2\nspacings: 1 2 3\nthicknesses: nan nan 9\nsample units: mm\nold min: 0\noldmax: 5\ncontent: a b: c",
        &[0.0; 3],
        &[1.0, 2.0, 3.0],
    ),
];

#[test]
fn samples_lie_where_the_header_says() {
    for (lines, first, next) in PLACES {
        let dimension = first.len();
        let sizes = lines.lines().find_map(|line| line.strip_prefix("sizes: ")).expect("sizes");
        let count: usize = sizes.split(' ').map(|n| n.parse::<usize>().expect("a number")).product();
        let head = format!("NRRD0005\r\n# a comment\r\ntype: uint8\r\ndimension: {dimension}\r\n");
        let head = head + &lines.replace('\n', "\r\n") + "\r\nkey:=value: more\r\nencoding: raw\r\n\r\n";
        let volume =
            decode(&[head.as_bytes(), &vec![1; count]].concat(), &[]).unwrap_or_else(|e| panic!("{lines}: {e}"));
        for (index, place) in [(0.0, first), (1.0, next)] {
            let at = volume.placement.world([index; 3]);
            assert_eq!(at[..dimension], **place, "{lines}\nat index {index}");
        }
        assert_eq!(volume.dimension, dimension);
        assert!(leaf(volume, Interpolation::Trilinear).value(&first[..]) == 1.0, "{lines}");
    }
}

/// Lines and bytes to pass over, the text before the samples, the encoding, and the bytes of the samples 1 to 4.
#[test]
fn what_precedes_the_samples_is_passed_over() {
    let four = b"\x01\x02\x03\x04";
    let cases: Vec<(&str, &str, Vec<u8>)> = vec![
        ("line skip: 2", "raw", [b"one\ntwo\n", &four[..]].concat()),
        ("line skip: 1\nbyte skip: 3", "raw", [b"one\nabc", &four[..]].concat()),
        ("lineskip: 1\nbyteskip: 3", "raw", [b"one\nabc", &four[..]].concat()),
        ("byte skip: -1", "raw", [b"whatever", &four[..]].concat()),
        ("byte skip: -1\nline skip: 1", "raw", [b"\n\n\n", &four[..]].concat()),
        ("line skip: 1", "gzip", [&b"one\n"[..], &gzip(four)].concat()),
        ("byte skip: 5", "gzip", gzip(&[b"12345", &four[..]].concat())),
        ("byte skip: -1", "gzip", gzip(&[b"12345", &four[..]].concat())),
        ("byte skip: -1", "bzip2", bzip2(&[b"12345", &four[..]].concat())),
        ("line skip: 1\nbyte skip: 2", "bzip2", [&b"one\n"[..], &bzip2(&[b"12", &four[..]].concat())].concat()),
        ("line skip: 1", "text", b"a line\n1, 2\n3 4 # four\n".to_vec()),
        ("byte skip: 2", "text", b"ab1\t2 3\r\n4".to_vec()),
        ("byte skip: 1", "hex", b"ff 01 02 0304".to_vec()),
        ("", "gzip", [gzip(&four[..1]), gzip(&four[1..])].concat()),
        ("", "bzip2", [bzip2(&four[..3]), bzip2(&four[3..])].concat()),
    ];
    for (lines, encoding, payload) in cases {
        let gap = if lines.is_empty() { "" } else { "\n" };
        let head = format!("NRRD0004\ntype: uchar\ndimension: 1\nsizes: 4\n{lines}{gap}encoding: {encoding}\n");
        let attached = decode(&[head.as_bytes(), b"\n", &payload].concat(), &[]);
        let detached = decode(format!("{head}data file: d").as_bytes(), &[("d", payload)]);
        for volume in [attached, detached] {
            assert_eq!(
                volume.unwrap_or_else(|e| panic!("{head}: {e}")).samples,
                Samples::Bytes(four.to_vec()),
                "{head}"
            );
        }
    }
}

/// The parts of a volume of 2 x 3 samples in files of their own, listed and numbered.
#[test]
fn samples_may_lie_in_several_files() {
    let files = |names: &[&'static str], each: usize| -> Vec<(&'static str, Vec<u8>)> {
        names.iter().enumerate().map(|(n, name)| (*name, (0..each).map(|k| (n * each + k) as u8).collect())).collect()
    };
    let cases = [
        ("data file: LIST\na.raw\nb.raw\nc.raw\n", files(&["a.raw", "b.raw", "c.raw"], 2)),
        ("data file: LIST 2\r\na.raw\r\nb c.raw", files(&["a.raw", "b c.raw"], 3)),
        ("data file: s%03d.raw 9 11 1\n", files(&["s009.raw", "s010.raw", "s011.raw"], 2)),
        ("data file: s%d.raw 4 0 -2\n", files(&["s4.raw", "s2.raw", "s0.raw"], 2)),
        ("datafile: %d 0 5 1 0\n", files(&["0", "1", "2", "3", "4", "5"], 1)),
    ];
    for (lines, files) in cases {
        let head = format!("NRRD0004\ntype: uchar\ndimension: 2\nsizes: 2 3\nencoding: raw\n{lines}");
        let volume = decode(head.as_bytes(), &files).unwrap_or_else(|e| panic!("{head}: {e}"));
        assert_eq!(volume.samples, Samples::Bytes((0..6).collect()), "{head}");
    }
    let head =
        "NRRD0004\ntype: uchar\ndimension: 2\nsizes: 2 3\nencoding: gzip\nbyte skip: 1\ndata file: LIST\na\nb\nc\n";
    let packed = files(&["a", "b", "c"], 2)
        .into_iter()
        .map(|(name, b)| (name, gzip(&[&[9], &b[..]].concat())))
        .collect::<Vec<_>>();
    assert_eq!(
        values(&decode(head.as_bytes(), &packed).expect("each is packed by itself")),
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
    );
}

#[test]
fn headers_that_make_no_volume_are_refused_in_words() {
    let grid = "type: uint8\nencoding: raw\n";
    let cases: &[(&str, &str)] = &[
        (
            "dimension: 3\nsizes: 3 2 2\nkinds: RGB-color domain domain",
            "axis 1 of the grid holds the components of a RGB-color",
        ),
        (
            "dimension: 4\nsizes: 3 2 2 2\nkinds: vector domain domain domain",
            "axis 1 of the grid holds the components of a vector",
        ),
        (
            "dimension: 4\nsizes: 3 2 2 2\nspace directions: none (1,0,0) (0,1,0) (0,0,1)",
            "axis 1 of the grid is no direction",
        ),
        ("dimension: 3\nsizes: 2 2 4\nkinds: domain domain list", "axis 3 of the grid holds the components of a list"),
        ("dimension: 4\nsizes: 2 2 2 2", "4 axes"),
        ("dimension: 17\nsizes: 1", "17 axes"),
        ("dimension: 1\nsizes: 1\nkinds: domain domain", "`kinds` has 2 entries for 1 axes"),
        ("dimension: 2\nsizes: 2 2\nspace directions: (1,0) (2,0)", "do not span the space"),
        ("dimension: 2\nsizes: 2 2\nspace directions: (1,0,5) (0,1,0)", "do not span the space"),
        ("dimension: 1\nsizes: 2\naxis mins: 1\naxis maxs: 1", "do not span the space"),
        ("dimension: 1\nsizes: 2\nspacings: inf", "do not span the space"),
        ("dimension: 1\nsizes: 6\ndata file: LIST\n", "lists no file"),
        ("dimension: 1\nsizes: 6\ndata file: LIST\na\nb\nc\nd\n", "6 numbers cannot lie in 4 files"),
        ("dimension: 1\nsizes: 6\ndata file: s%d 1 1000000000000 1", "6 numbers cannot lie in 1000000000000 files"),
        ("dimension: 1\nsizes: 6\ndata file: s%d 1 3 0", "is not a series of files"),
        ("dimension: 1\nsizes: 6\ndata file: s%d 3 1 1", "is not a series of files"),
        ("dimension: 1\nsizes: 6\ndata file: s%s 1 3 1", "is not a series of files"),
        ("dimension: 1\nsizes: 6\ndata file: s%99999999d 1 3 1", "is not a series of files"),
        ("dimension: 1\nsizes: 2\ndata file: LIST\na\nb", "`a` cannot be read"),
    ];
    for (lines, words) in cases {
        let error = decode(format!("NRRD0005\n{grid}{lines}").as_bytes(), &[]).expect_err(words);
        assert!(error.to_string().contains(words) && !error.help().is_empty(), "{lines}\n{error}\n{words}");
    }
    let text = |kind: &str, number: &str| {
        decode(format!("NRRD0004\ntype: {kind}\ndimension: 1\nsizes: 1\nencoding: text\n\n{number}\n").as_bytes(), &[])
    };
    for (kind, good, bad) in [
        ("uchar", "255", "256"),
        ("int8", "-128", "-129"),
        ("short", "32767", "32768"),
        ("ushort", "65535", "-1"),
        ("int", "-2147483648", "1.5"),
        ("uint", "4294967295", "4294967296"),
        ("int64", "1e18", "1e19"),
        ("uint64", "1e19", "nan"),
    ] {
        assert_eq!(values(&text(kind, good).expect(good)), [good.parse::<f64>().expect("a number")]);
        let error = text(kind, bad).expect_err(bad).to_string();
        assert!(error.contains(&format!("line 7: `{bad}` does not fit a")), "{error}");
    }
    assert!(values(&text("float", "nan").expect("undefined"))[0].is_nan());
}

#[test]
fn tricubic_keeps_products_of_quadratics() {
    // Catmull-Rom through the values of a parabola is the parabola, between any but the outermost samples.
    let of = |x: f64, y: f64, z: f64| (x * x - 3.0 * x) * (2.0 - y * y) + x * y * z * z - z;
    let samples = (0..343).map(|n| of(f64::from(n % 7), f64::from(n / 7 % 7), f64::from(n / 49))).collect();
    let volume = Volume::new("p", &[7, 7, 7], Placement::default(), Samples::Doubles(samples)).expect("a grid");
    let leaf = leaf(volume, Interpolation::Tricubic);
    for n in 0..500_u32 {
        let at = [n % 13, n * 7 % 17, n * 11 % 19]
            .map(|k| 1.0 + f64::from(k % 16) / 4.0 + 0.01 * f64::from(n % 5))
            .map(|c| c.min(5.0));
        let [x, y, z] = at;
        let (value, mut slope) = (leaf.value(&at), [0.0; 3]);
        assert!((value - of(x, y, z)).abs() < 1e-9 * (1.0 + value.abs()), "{at:?}: {value}");
        leaf.gradient(&at, &mut slope);
        let exact = [
            (2.0 * x - 3.0) * (2.0 - y * y) + y * z * z,
            (x * x - 3.0 * x) * -2.0 * y + x * z * z,
            2.0 * x * y * z - 1.0,
        ];
        for (slope, exact) in slope.into_iter().zip(exact) {
            assert!((slope - exact).abs() < 1e-8 * (1.0 + exact.abs()), "{at:?}: {slope}, not {exact}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn tricubic_has_one_slope_on_each_side_of_a_face(
        seed in any::<u64>(), axis in 0..3_usize, face in 1..5_u32, at in prop::array::uniform3(0.0..5.0_f64),
    ) {
        let noise = |n: u64| (seed.wrapping_mul(2 * n + 1).rotate_left(23) % 1000) as f64 / 500.0 - 1.0;
        let samples = Samples::Doubles((0..216).map(noise).collect());
        let volume = Volume::new("noise", &[6, 6, 6], Placement::default(), samples).expect("a grid");
        let leaf = leaf(volume, Interpolation::Tricubic);
        let side = |h: f64| {
            let mut at = at;
            at[axis] = f64::from(face) + h;
            let mut slope = [0.0; 3];
            let value = leaf.gradient(&at, &mut slope);
            [value, slope[0], slope[1], slope[2]]
        };
        for (a, b) in side(-1e-9).into_iter().zip(side(1e-9)) {
            prop_assert!((a - b).abs() < 1e-6, "{a} and {b} beside {face} along axis {axis}");
        }
    }
}

/// The value of the signal of Marschner and Lobb (1994), f = 6, alpha = 0.25.
fn signal([x, y, z]: [f64; 3]) -> f64 {
    let ring = (2.0 * PI * 6.0 * (0.5 * PI * x.hypot(y)).cos()).cos();
    (1.0 - (0.5 * PI * z).sin() + 0.25 * (1.0 + ring)) / 2.5
}

#[test]
fn the_signal_of_marschner_and_lobb_is_read_and_a_cubic_is_closer_than_a_line() {
    let Some(folder) = shared() else { return };
    let bytes = std::fs::read(folder.join("marschner_lobb_41x41x41_float32.nrrd")).expect("a shared file");
    let volume = decode(&bytes, &[]).expect("a volume");
    for n in 0..volume.samples.len() {
        let at = [n % 41, n / 41 % 41, n / 1681].map(|k| k as f64 / 20.0 - 1.0);
        assert!((volume.samples.get(n) - signal(at)).abs() < 1e-6, "{at:?}");
    }
    let error = |kind| {
        let leaf = leaf(volume.clone(), kind);
        let places = (0..4000_u32).map(|n| [n % 37, n * 5 % 41, n * 3 % 29].map(|k| 0.4 + f64::from(k) * 0.03));
        let squares = places.map(|at| (leaf.value(&at) - signal(at.map(|c| c - 1.0))).powi(2));
        (squares.sum::<f64>() / 4000.0).sqrt()
    };
    let [nearest, linear, cubic] =
        [Interpolation::Nearest, Interpolation::Trilinear, Interpolation::Tricubic].map(error);
    assert!(cubic < 0.8 * linear && linear < 0.8 * nearest, "{nearest}, {linear}, {cubic}");
}

#[test]
fn the_scan_of_a_stent_is_what_its_bytes_say() {
    let Some(folder) = shared() else { return };
    let bytes = std::fs::read(folder.join("stent_64x64x128_int16.nrrd")).expect("a shared file");
    let volume = {
        let (limits, interrupt) = (Limits::default(), Interrupt::default());
        let mut none = |_: &str| Err(io::Error::from(io::ErrorKind::NotFound));
        data::decode("stent.nrrd", &bytes, &mut none, Context { limits: &limits, interrupt: &interrupt })
            .expect("a scan")
    };
    let text = String::from_utf8_lossy(&bytes[..400]);
    assert!(text.contains("encoding: gzip") && text.contains("endian: little"), "{text}");
    let start = bytes.windows(2).position(|w| w == b"\n\n").expect("an empty line") + 2;
    let mut raw = Vec::new();
    flate2::read::GzDecoder::new(&bytes[start..]).read_to_end(&mut raw).expect("gzip");
    let expected: Vec<f32> = raw.chunks(2).map(|b| f32::from(i16::from_le_bytes([b[0], b[1]]))).collect();
    assert_eq!(volume.size, [64, 64, 128]);
    assert_eq!(volume.samples, Samples::Singles(expected));
    let leaf: Arc<dyn Leaf> = leaf(volume, Interpolation::Tricubic);
    assert!(leaf.value(&[0.0, 0.0, 0.0]).is_finite());
}
