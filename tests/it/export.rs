//! Every format read back.

use std::io;

use yont::data::{self, Context, Samples, Volume};
use yont::export::quantise::Histogram;
use yont::export::{gif, nrrd, png};
use yont::interrupt::Interrupt;
use yont::limits::Limits;
use yont::picture::Image;

/// A picture of smooth colours that differ in all channels.
fn gradient(width: usize, height: usize, blue: u8) -> Image {
    let mut image = Image::new(width, height, [0; 3]);
    for j in 0..height {
        for i in 0..width {
            image.set(i, j, [(i * 255 / width) as u8, (j * 255 / height) as u8, blue]);
        }
    }
    image
}

fn written(write: impl FnOnce(&mut Vec<u8>) -> io::Result<()>) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(&mut bytes).expect("memory");
    bytes
}

/// A writer that is full after some bytes.
struct Full(usize);

impl io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let room = self.0.min(bytes.len());
        self.0 -= room;
        if room == 0 { Err(io::ErrorKind::StorageFull.into()) } else { Ok(room) }
    }
    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn png_reads_back_to_the_same_pixels() {
    let mut clear = gradient(37, 21, 9);
    clear.rgba[3] = 100;
    for (image, channels) in [(gradient(37, 21, 200), 3), (clear, 4)] {
        let bytes = written(|out| png::write(&image, out));
        assert_eq!(bytes, written(|out| png::write(&image, out)));
        let mut reader = ::png::Decoder::new(io::Cursor::new(bytes)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a picture");
        assert_eq!((info.width, info.height, info.color_type.samples()), (37, 21, channels));
        let expected: Vec<u8> = image.rgba.chunks(4).flat_map(|p| p[..channels].to_vec()).collect();
        assert_eq!(pixels, expected);
    }
}

/// The frames of a GIF as RGBA, with their delays.
fn frames(bytes: &[u8]) -> (Vec<(Vec<u8>, u16)>, ::gif::Repeat) {
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options.read_info(bytes).expect("a GIF");
    let mut all = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        all.push((frame.buffer.to_vec(), frame.delay));
    }
    (all, decoder.repeat())
}

fn furthest(a: &[u8], b: &[u8]) -> u8 {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

#[test]
fn gif_reads_back_close_to_the_frames_and_loops() {
    let images = [gradient(64, 48, 10), gradient(64, 48, 40), gradient(64, 48, 70)];
    let bytes = written(|out| gif::write(&images, 0.25, out));
    assert_eq!(bytes, written(|out| gif::write(&images, 0.25, out)));
    let (all, repeat) = frames(&bytes);
    assert_eq!((all.len(), repeat), (3, ::gif::Repeat::Infinite));
    for ((pixels, delay), image) in all.iter().zip(&images) {
        assert_eq!(*delay, 25);
        let worst = furthest(pixels, &image.rgba);
        assert!(worst <= 40, "{worst}");
    }
}

#[test]
fn few_colours_are_kept_exactly_and_frames_with_their_own_palettes_are_closer() {
    let mut few = Image::new(30, 20, [1, 2, 3]);
    (0..200).for_each(|n| few.set(n % 30, n / 30, [n as u8, 100, 7]));
    let (all, _) = frames(&written(|out| gif::write(&[few.clone()], 0.1, out)));
    assert_eq!(all[0].0, few.rgba);
    let images = [gradient(64, 48, 10), few];
    let bytes = written(|out| {
        let mut encoder = gif::Encoder::new(out, 64, 48, 0.5, None)?;
        encoder.frame(&images[0])?;
        encoder.frame(&images[0])
    });
    let (own, _) = frames(&bytes);
    assert!(furthest(&own[1].0, &images[0].rgba) <= 24);
}

#[test]
fn palettes_of_many_colours_stay_small() {
    let mut histogram = Histogram::default();
    (0..=255).for_each(|blue| histogram.add(&gradient(64, 64, blue)));
    let palette = histogram.palette(256);
    assert!(palette.colours.len() <= 256 && palette.colours.len() > 200);
    let near = palette.colours[palette.nearest([128, 128, 128])];
    assert!(furthest(&near, &[128; 3]) < 40, "{near:?}");
}

#[test]
fn frames_that_do_not_fit_are_refused() {
    let wrong = [gradient(8, 8, 0), gradient(8, 9, 0)];
    let error = gif::write(&wrong, 0.1, &mut Vec::new()).expect_err("two sizes");
    assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
    assert!(gif::write(&[], 0.1, &mut Vec::new()).is_err());
    assert!(gif::write(&[Image::new(70_000, 1, [0; 3])], 0.1, &mut Vec::new()).is_err());
    assert!(png::write(&Image::new(0, 5, [0; 3]), &mut Vec::new()).is_err());
}

#[test]
fn a_full_disk_stays_a_full_disk() {
    let image = gradient(300, 200, 1);
    let singles = vec![1.5; 1 << 16];
    let field = nrrd::Field {
        name: "gob_a",
        size: &[1 << 16],
        origin: &[0.0],
        spacing: &[1.0],
        samples: nrrd::Samples::Singles(&singles),
    };
    let errors = [
        png::write(&image, &mut Full(300)),
        gif::write(&[image], 0.1, &mut Full(1000)),
        nrrd::write(&field, nrrd::Encoding::Raw, &mut Full(1000)),
        nrrd::write(&field, nrrd::Encoding::Gzip, &mut Full(200)),
    ];
    for error in errors {
        assert_eq!(error.expect_err("no room").kind(), io::ErrorKind::StorageFull);
    }
}

fn read(bytes: &[u8]) -> Volume {
    let (limits, interrupt) = (Limits::default(), Interrupt::default());
    let mut none = |_: &str| Err(io::ErrorKind::NotFound.into());
    data::decode("a.nrrd", bytes, &mut none, Context { limits: &limits, interrupt: &interrupt })
        .expect("what was written")
}

#[test]
fn nrrd_reads_back_to_the_same_samples_in_the_same_place() {
    let singles: Vec<f32> = (0..60).map(|n| n as f32 * 0.1 - 1.0).collect();
    let bytes: Vec<u8> = (0..60).collect();
    for encoding in [nrrd::Encoding::Raw, nrrd::Encoding::Gzip] {
        for samples in [nrrd::Samples::Singles(&singles), nrrd::Samples::Bytes(&bytes)] {
            let field = nrrd::Field {
                name: "gob_a",
                size: &[5, 4, 3],
                origin: &[-1.0, 0.1, 2e-9],
                spacing: &[0.25, 1.0 / 3.0, 4.0],
                samples,
            };
            let text = written(|out| nrrd::write(&field, encoding, out));
            assert_eq!(text, written(|out| nrrd::write(&field, encoding, out)));
            let volume = read(&text);
            match samples {
                nrrd::Samples::Singles(_) => assert_eq!(volume.samples, Samples::Singles(singles.clone())),
                nrrd::Samples::Bytes(_) => assert_eq!(volume.samples, Samples::Bytes(bytes.clone())),
            }
            assert_eq!((volume.size, volume.placement.origin), ([5, 4, 3], [-1.0, 0.1, 2e-9]));
            assert_eq!(volume.placement.world([1.0, 1.0, 1.0]), [-0.75, 0.1 + 1.0 / 3.0, 4.000_000_002]);
        }
    }
    let line = nrrd::Field {
        name: "gob_a",
        size: &[3],
        origin: &[1.0],
        spacing: &[2.0],
        samples: nrrd::Samples::Bytes(&[7, 8, 9]),
    };
    assert_eq!(read(&written(|out| nrrd::write(&line, nrrd::Encoding::Raw, out))).extent(), [(1.0, 5.0)]);
    let wrong = nrrd::Field { name: "gob_a", size: &[4], ..line };
    assert!(nrrd::write(&wrong, nrrd::Encoding::Raw, &mut Vec::new()).is_err());
}
