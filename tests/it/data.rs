//! Volumes and meshes from bytes.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::Arc;

use proptest::prelude::*;
use yont::data::{self, Context, DataError, Interpolation, Placement, Samples, Volume};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::number::{Interval, Leaf};

fn decode_within(name: &str, bytes: &[u8], limits: &Limits) -> Result<Volume, DataError> {
    let interrupt = Interrupt::default();
    let mut fetch = |file: &str| match shared().map(|folder| folder.join("nrrd_conformance").join(file)) {
        Some(path) => std::fs::read(path),
        None => Err(io::Error::from(io::ErrorKind::NotFound)),
    };
    data::decode(name, bytes, &mut fetch, Context { limits, interrupt: &interrupt })
}

fn decode(name: &str, bytes: &[u8]) -> Result<Volume, DataError> {
    decode_within(name, bytes, &Limits::default())
}

/// The shared files, or a note that a test could not run.
#[allow(clippy::print_stderr)]
pub fn shared() -> Option<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data/volumes");
    if !folder.is_dir() {
        eprintln!("SKIPPED: {} is missing", folder.display());
        return None;
    }
    Some(folder)
}

fn read(name: &str) -> Option<Result<Volume, DataError>> {
    let bytes = std::fs::read(shared()?.join(name)).expect("a shared file");
    Some(decode(name, &bytes))
}

pub fn leaf(volume: Volume, kind: Interpolation) -> Arc<dyn Leaf> {
    Arc::new(volume).leaf(kind).expect("finite samples")
}

/// A 5 x 4 x 3 grid whose sample is x + 10 y + 100 z in indices.
fn ramp(placement: Placement) -> Volume {
    let samples = (0..60).map(|n| (n % 5 + 10 * (n / 5 % 4) + 100 * (n / 20)) as f64).collect();
    Volume::new("ramp", &[5, 4, 3], placement, Samples::Doubles(samples)).expect("a grid")
}

#[test]
fn axes_run_x_first_and_spacings_scale_the_world() {
    for name in ["axis_order_5x4x3_uint8.nrrd", "axis_order_5x4x3_uint8.raw"] {
        let Some(volume) = read(name) else { return };
        let volume = volume.expect(name);
        assert_eq!(volume.size, [5, 4, 3], "{name}");
        let step = if name.ends_with("nrrd") { [1.0, 2.0, 4.0] } else { [1.0; 3] };
        for kind in [Interpolation::Nearest, Interpolation::Trilinear, Interpolation::Tricubic] {
            let leaf = leaf(volume.clone(), kind);
            for n in 0..60_usize {
                let i = [n % 5, n / 5 % 4, n / 20].map(|i| i as f64);
                let at = [i[0] * step[0], i[1] * step[1], i[2] * step[2]];
                assert_eq!(leaf.value(&at), i[0] + 10.0 * i[1] + 100.0 * i[2], "{name} {kind:?} at {at:?}");
            }
        }
    }
}

#[test]
fn conformance_files_decode_to_the_ball_or_are_refused_in_words() {
    let Some(folder) = shared() else { return };
    let reference = std::fs::read(folder.join("nrrd_conformance/BallBinary30x30x30.raw")).expect("a shared file");
    let ball: Vec<f32> = reference.chunks(2).map(|b| f32::from(i16::from_le_bytes([b[0], b[1]]))).collect();
    let refused: &[(&str, &str)] = &[
        ("test_simple4d_raw.nrrd", "4 axes"),
        ("BallBinary30x30x30_byteskip_minus_five.nhdr", "`-5` is not"),
        ("BallBinary30x30x30_nifti.nhdr", "more than the 54000 bytes"),
    ];
    let mut seen = 0;
    for entry in std::fs::read_dir(folder.join("nrrd_conformance")).expect("a folder") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        if !(name.ends_with(".nrrd") || name.ends_with(".nhdr")) {
            continue;
        }
        seen += 1;
        let result = decode(&name, &std::fs::read(&path).expect("a shared file"));
        if let Some((_, words)) = refused.iter().find(|(known, _)| *known == name) {
            let error = result.expect_err(&name);
            assert!(error.to_string().contains(words) && !error.help().is_empty(), "{name}: {error}");
            continue;
        }
        let volume = result.unwrap_or_else(|error| panic!("{name}: {error}"));
        if name.starts_with("Ball") {
            assert_eq!(volume.samples, Samples::Singles(ball.clone()), "{name}");
        } else {
            let counted: Vec<f64> = (0..27).map(|n| f64::from(n) + 1.0).collect();
            let samples: Vec<f64> = (0..27).map(|n| volume.samples.get(n)).collect();
            assert_eq!(samples, counted, "{name}");
        }
    }
    assert_eq!(seen, 14);
}

#[test]
fn both_teapots_are_one() {
    let (Some(nrrd), Some(raw)) = (read("utah_teapot_64x42x34_uint8.nrrd"), read("utah_teapot_64x42x34_uint8.raw"))
    else {
        return;
    };
    assert_eq!(nrrd.expect("nrrd").samples, raw.expect("raw").samples);
}

#[test]
fn trilinear_mixes_and_falls_to_the_smallest_value_over_one_cell() {
    let leaf = leaf(ramp(Placement::aligned([1.0, 2.0, 3.0], [0.5, 1.0, 2.0])), Interpolation::Trilinear);
    let cases = [
        ([1.0, 2.0, 3.0], 0.0),
        ([1.25, 2.5, 4.0], 55.5),
        ([3.0, 5.0, 7.0], 234.0),
        ([3.25, 5.0, 7.0], 117.0),
        ([3.5, 5.0, 7.0], 0.0),
        ([3.25, 5.5, 7.0], 58.5),
        ([3.25, 5.5, 8.0], 29.25),
        ([900.0, 5.0, 7.0], 0.0),
        ([f64::INFINITY, 5.0, 7.0], 0.0),
    ];
    for (at, value) in cases {
        assert_eq!(leaf.value(&at), value, "{at:?}");
    }
    assert!(leaf.value(&[f64::NAN, 0.0, 0.0]).is_nan());
}

#[test]
fn nearest_takes_the_closest_sample() {
    let leaf = leaf(ramp(Placement::default()), Interpolation::Nearest);
    for (at, value) in
        [([0.49, 0.0, 0.0], 0.0), ([0.5, 0.0, 0.0], 1.0), ([2.2, 1.7, 0.6], 122.0), ([4.5, 3.0, 2.0], 117.0)]
    {
        assert_eq!(leaf.value(&at), value, "{at:?}");
    }
}

#[test]
fn oblique_grids_are_turned_back() {
    let (s, c) = 0.5_f64.sin_cos();
    let placement = Placement { origin: [1.0, -2.0, 0.5], directions: [[c, s, 0.0], [-s, c, 0.0], [0.1, 0.2, 2.0]] };
    let volume = ramp(placement.clone());
    let leaf = leaf(volume, Interpolation::Trilinear);
    for index in [[0.0, 0.0, 0.0], [3.25, 1.5, 1.75], [2.0, 2.5, 0.5]] {
        let expected = index[0] + 10.0 * index[1] + 100.0 * index[2];
        assert!((leaf.value(&placement.world(index)) - expected).abs() < 1e-10);
    }
}

#[test]
fn undefined_samples_stay_undefined_and_the_bounds_say_so() {
    let samples = Samples::Singles(vec![1.0, f32::NAN, 3.0, f32::INFINITY]);
    let volume = Volume::new("holes", &[4], Placement::default(), samples).expect("a grid");
    let leaf = leaf(volume, Interpolation::Trilinear);
    assert!(leaf.value(&[0.5]).is_nan() && leaf.value(&[3.0]).is_nan());
    assert_eq!(leaf.value(&[9.0]), 1.0);
    assert!(leaf.bounds(&[Interval::new(0.2, 0.4)]).undefined);
    let none = Volume::new("none", &[2], Placement::default(), Samples::Singles(vec![f32::NAN; 2])).expect("a grid");
    assert_eq!(Arc::new(none).leaf(Interpolation::Nearest).err(), Some(DataError::NoValues));
}

fn any_volume() -> impl Strategy<Value = Volume> {
    let sizes = prop::collection::vec(1_usize..9, 1..4);
    let step = prop_oneof![-2.0..-0.3, 0.3..2.0_f64];
    (sizes, prop::array::uniform3(-3.0..3.0_f64), prop::array::uniform3(step), 0.0..0.4_f64, any::<u64>()).prop_map(
        |(size, origin, spacing, shear, seed)| {
            let mut placement = Placement::aligned(origin, spacing);
            if size.len() > 1 && seed % 2 == 0 {
                placement.directions[0][1] = shear;
            }
            let count: usize = size.iter().product();
            let noise = |n: usize| (seed.wrapping_mul(n as u64 * 2 + 1).rotate_left(17) % 1000) as f64 / 7.0 - 60.0;
            Volume::new("any", &size, placement, Samples::Doubles((0..count).map(noise).collect())).expect("a grid")
        },
    )
}

fn any_kind() -> impl Strategy<Value = Interpolation> {
    prop::sample::select(Interpolation::NAMES.map(|(_, kind)| kind).to_vec())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn bounds_hold_every_value(
        volume in any_volume(), kind in any_kind(),
        centre in prop::array::uniform3(-8.0..14.0_f64), side in prop::array::uniform3(0.0..6.0_f64),
        within in prop::collection::vec(prop::array::uniform3(0.0..=1.0_f64), 40),
    ) {
        let dimension = volume.dimension;
        let leaf = leaf(volume, kind);
        let over: Vec<_> = (0..dimension).map(|k| Interval::new(centre[k] - side[k], centre[k] + side[k])).collect();
        let bounds = leaf.bounds(&over);
        for t in within {
            let at: Vec<_> = (0..dimension).map(|k| (over[k].lo + t[k] * (over[k].hi - over[k].lo)).min(over[k].hi)).collect();
            let value = leaf.value(&at);
            prop_assert!(bounds.lo <= value && value <= bounds.hi, "{value} at {at:?} not in {bounds:?}");
        }
        prop_assert!(!bounds.undefined);
    }

    #[test]
    fn gradients_are_the_difference_quotient(
        volume in any_volume(), tricubic in any::<bool>(), at in prop::array::uniform3(-2.0..9.0_f64),
    ) {
        let dimension = volume.dimension;
        let leaf = leaf(volume, if tricubic { Interpolation::Tricubic } else { Interpolation::Trilinear });
        let mut slope = [0.0; 3];
        let value = leaf.gradient(&at[..dimension], &mut slope[..dimension]);
        prop_assert_eq!(value, leaf.value(&at[..dimension]));
        for k in 0..dimension {
            let beside = |h: f64| { let mut at = at; at[k] += h; leaf.value(&at[..dimension]) };
            let (left, right) = ((value - beside(-1e-6)) / 1e-6, (beside(1e-6) - value) / 1e-6);
            // Where the two sides differ the point is at a bend.
            if (left - right).abs() < 1e-2 {
                prop_assert!((0.5 * (left + right) - slope[k]).abs() < 2e-2 * (1.0 + slope[k].abs()));
            }
        }
    }

    #[test]
    fn tricubic_is_smooth_and_keeps_linear_data(at in prop::array::uniform3(0.0..1.0_f64)) {
        let leaf = leaf(ramp(Placement::default()), Interpolation::Tricubic);
        let at = [4.0 * at[0], 3.0 * at[1], 2.0 * at[2]];
        let mut slope = [0.0; 3];
        let value = leaf.gradient(&at, &mut slope);
        prop_assert!((value - (at[0] + 10.0 * at[1] + 100.0 * at[2])).abs() < 1e-9);
        for (slope, expected) in slope.into_iter().zip([1.0, 10.0, 100.0]) {
            prop_assert!((slope - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn no_bytes_panic(
        which in 0..SEEDS.len(), cut in 0_usize..400, flips in prop::collection::vec((0_usize..400, any::<u8>()), 0..8),
    ) {
        let (name, seed) = SEEDS[which];
        let mut bytes = seed.as_bytes().to_vec();
        for (at, byte) in flips {
            let at = at % bytes.len();
            bytes[at] = byte;
        }
        bytes.truncate(bytes.len() - cut % bytes.len().min(40));
        let limits = Limits { data_bytes: 1 << 20, ..Limits::default() };
        if let Err(error) = decode_within(name, &bytes, &limits) {
            prop_assert!(!error.to_string().is_empty() && error.to_string().len() < 300);
        }
    }
}

/// Small right files of every route; their mutants must be read or refused.
const SEEDS: &[(&str, &str)] = &[
    ("a.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nspacings: 1 2 3\nencoding: raw\n\nabcdefgh"),
    (
        "a.nrrd",
        "NRRD0005\ntype: short\ndimension: 2\nsizes: 2 2\nendian: big\naxis mins: 0 1\naxis maxs: 1 2\nencoding: raw\n\nabcdefgh",
    ),
    (
        "a.nrrd",
        "NRRD0005\ntype: double\ndimension: 3\nspace dimension: 3\nsizes: 2 1 2\nspace directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (1,2,3)\nencoding: ascii\n\n1 2\n3 4\n",
    ),
    ("a.nrrd", "NRRD0005\ntype: uchar\ndimension: 1\nsizes: 3\nencoding: hex\nbyte skip: -1\n\n00 01 02 ff"),
    ("a.nrrd", "NRRD0005\ntype: uchar\ndimension: 1\nsizes: 3\nencoding: gzip\nline skip: 1\n\n\x1f\x00"),
    ("a.dat", "# ramp\n2 2 2\nspacing 1 1 1\norigin 0 0 0\n1 2 3 4\n5,6,7,8\n"),
    ("a_2x2_uint16_be.raw", "abcdefgh"),
];

#[test]
fn seeds_of_the_mutants_are_right() {
    for (name, seed) in SEEDS {
        if !seed.contains("gzip") {
            decode(name, seed.as_bytes()).unwrap_or_else(|error| panic!("{seed}: {error}"));
        }
    }
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(bytes).expect("memory");
    encoder.finish().expect("memory")
}

fn nrrd(fields: &str, payload: &[u8]) -> Vec<u8> {
    [b"NRRD0004\n", fields.as_bytes(), b"\n", payload].concat()
}

#[test]
fn lying_files_get_their_error() {
    let limits = Limits { data_bytes: 1 << 20, ..Limits::default() };
    let bomb = gzip(&vec![0; 30 << 20]);
    let head = |sizes: &str, rest: &str| format!("type: uint8\ndimension: 3\nsizes: {sizes}\n{rest}");
    let cases: Vec<(&str, Vec<u8>, &str)> = vec![
        ("a.nrrd", nrrd(&head("9 9 9", "encoding: raw\n"), b"abc"), "promises 729 bytes, but there are only 3"),
        ("a.nrrd", nrrd(&head("1 1 1", "encoding: raw\n"), b"abc"), "more than the 1 bytes"),
        (
            "a.nrrd",
            nrrd(&head("99999 99999 99999", "encoding: raw\n"), b"abc"),
            "999970000299999 bytes; the limit is 1048576",
        ),
        (
            "a.nrrd",
            nrrd(&head("99999999999999999999 99999999999999999999 9", "encoding: raw\n"), b""),
            "more bytes than can be counted",
        ),
        ("a.nrrd", nrrd(&head("0 1 1", "encoding: raw\n"), b""), "axis 1 has no samples"),
        ("a.nrrd", nrrd(&head("9 9", "encoding: raw\n"), b""), "`sizes` has 2 entries for 3 axes"),
        ("a.nrrd", nrrd(&head("9 9 9", "encoding: gzip\n"), &bomb), "more than the 729 bytes"),
        ("a.nrrd", nrrd(&head("9 9 9", "encoding: gzip\nbyte skip: -1\n"), &bomb), "the limit is 1048576"),
        ("a.nrrd", nrrd(&head("9 9 9", "encoding: gzip\n"), b"no gzip at all"), "the gzip data are broken"),
        ("a.nrrd", nrrd(&head("9 9 9", "encoding: gzip\n"), &gzip(&[7; 729])[..12]), "broken"),
        ("a.nrrd", nrrd(&head("9 9 9", "encoding: zstd\n"), b""), "`zstd` is not an encoding that is read"),
        ("a.nrrd", nrrd(&head("1 1 1", ""), b"a"), "the header has no `encoding`"),
        ("a.nrrd", nrrd("dimension: 1\nsizes: 1\nencoding: raw\n", b"a"), "the header has no `type`"),
        ("a.nrrd", nrrd("type: int\ndimension: 1\nsizes: 1\nencoding: raw\n", b"abcd"), "the header has no `endian`"),
        ("a.nrrd", nrrd("type: block\n", b"abcd"), "block"),
        ("a.nrrd", nrrd("what is this\n", b"abcd"), "line 2 of the header: `what is this` is neither"),
        ("a.nrrd", nrrd(&head("1 1 1", "encoding: raw\nspacings: 1 0 1\n"), b"a"), "do not span the space"),
        (
            "a.nrrd",
            nrrd(&head("1 1 1", "encoding: raw\ndata file: nowhere.raw\n"), b""),
            "`nowhere.raw` cannot be read",
        ),
        (
            "a.nrrd",
            nrrd(&head("3 1 1", "encoding: raw\nspace directions: none (1,0,0) (0,1,0)\n"), b"abc"),
            "axis 1 of the grid is no direction",
        ),
        ("a.nrrd", nrrd(&head("2 1 1", "encoding: text\n"), b"1 x"), "line 7: `x` is not a number"),
        ("a.nrrd", nrrd(&head("2 1 1", "encoding: text\n"), b"1 300"), "`300` does not fit an unsigned byte"),
        ("a.nrrd", b"".to_vec(), "the file is empty"),
        ("a.nrrd", b"GIF89a".to_vec(), "starts with `NRRD0005`"),
        ("a.nrrd", b"NRRD0009\n".to_vec(), "is not a version"),
        ("a.raw", b"abc".to_vec(), "does not end with a number type"),
        ("a_uint8.raw", b"abc".to_vec(), "`a` before the type is not a size"),
        ("a_2x2x_uint8.raw", b"abcd".to_vec(), "is not a size"),
        ("a_2x2x2x2_uint8.raw", vec![0; 16], "4 axes"),
        ("a_3x1x1_uint8.raw", b"ab".to_vec(), "promises 3 bytes, but there are only 2"),
        ("a_99999999x99999999x99999999_float64.raw", b"ab".to_vec(), "the limit is 1048576"),
        ("a.dat", b"".to_vec(), "no `size`"),
        ("a.dat", b"# nothing\n\n".to_vec(), "no `size`"),
        ("a.dat", b"2 two\n1 2 3 4".to_vec(), "the first line must be the size"),
        ("a.dat", b"2 2\n1 2 3".to_vec(), "promises 4 numbers, but there are only 3"),
        ("a.dat", b"2 2\n1 2 3 4 5".to_vec(), "more than the 4 numbers"),
        ("a.dat", b"2 2\nspacing 1\n1 2 3 4".to_vec(), "`spacing` needs one number for each of the 2 axes"),
        ("a.dat", b"2 2\norigin 1 inf\n1 2 3 4".to_vec(), "`inf` is not a number"),
        ("a.dat", b"2 2\n1 2\n3 \xff\xfe".to_vec(), "line 3: "),
        ("a.dat", b"2 2 2 2\n1".to_vec(), "4 axes"),
        ("a.jpg", b"abc".to_vec(), "not a volume file"),
    ];
    for (name, bytes, words) in cases {
        let error = decode_within(name, &bytes, &limits).expect_err(words);
        assert!(error.to_string().contains(words), "{words} / {error}");
        assert!(!error.help().is_empty(), "{error}");
    }
}

#[test]
fn the_limit_of_data_is_kept_at_n_and_n_plus_1() {
    let limits = Limits { data_bytes: 24, ..Limits::default() };
    assert!(decode_within("a_24_uint8.raw", &[0; 24], &limits).is_ok());
    let error = decode_within("a_25_uint8.raw", &[0; 25], &limits).expect_err("one too many");
    assert_eq!(error, DataError::TooLarge { bytes: Some(25), limit: 24 });
}

#[test]
fn number_types_and_byte_orders() {
    let cases: &[(&str, &[u8], f64)] = &[
        ("int8", &[0xff], -1.0),
        ("uint16", &[1, 2], 513.0),
        ("int16_be", &[0xff, 0xfe], -2.0),
        ("int16be", &[0xff, 0xfe], -2.0),
        ("uint32le", &[1, 0, 0, 1], 16_777_217.0),
        ("int32_le", &[0xff, 0xff, 0xff, 0xff], -1.0),
        ("uint64_be", &[0, 0, 0, 0, 0, 0, 1, 0], 256.0),
        ("float32_be", &[0x3f, 0xc0, 0, 0], 1.5),
        ("float64", &[0, 0, 0, 0, 0, 0, 0xf8, 0x3f], 1.5),
    ];
    for (kind, bytes, value) in cases {
        let volume = decode(&format!("some_name_1x1x1_{kind}.raw"), bytes).expect(kind);
        assert_eq!(volume.samples.get(0), *value, "{kind}");
    }
}

#[test]
fn fingerprints_tell_volumes_and_kinds_apart() {
    let one = |volume: Volume, kind| leaf(volume, kind).fingerprint();
    let plain = one(ramp(Placement::default()), Interpolation::Trilinear);
    assert_eq!(plain, one(ramp(Placement::default()), Interpolation::Trilinear));
    assert_ne!(plain, one(ramp(Placement::default()), Interpolation::Nearest));
    assert_ne!(plain, one(ramp(Placement::aligned([0.0; 3], [2.0; 3])), Interpolation::Trilinear));
}
