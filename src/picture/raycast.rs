//! A 3-D object in the light, on a soft light background: rays cast, shaded, and averaged over each pixel. Writes no files.

use super::camera::{Camera, View};
use super::extent::Extent;
use super::image::Image;
use super::palette::{Palette, encode, linear};
use super::rays::{Hit, Scene, Tile, cast};
use super::shade::{Light, Lights};
use super::shadow::Shadows;
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::sampler::Counters;
use crate::vm::Shape;

/// The modelling space: what lies outside is not shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Space {
    /// The smallest coordinates.
    pub lo: [f64; 3],
    /// The largest coordinates.
    pub hi: [f64; 3],
}

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Pixels in a row and in a column.
    pub size: [usize; 2],
    /// Rays along each side of a pixel, 1 to 4.
    pub supersample: usize,
    /// Decides the colour of the object.
    pub palette: Palette,
    /// How dark the key light's shadows are: 0 for none (and none are computed), 1 for as dark as its light is bright.
    pub shadow: f32,
    /// The colours at the top and at the bottom of the background.
    pub background: [[u8; 3]; 2],
    /// Whether there is no background: what the object leaves free is transparent.
    pub transparent: bool,
    /// The colour of the object, instead of the palette's.
    pub solid: Option<[u8; 3]>,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            size: [800, 600],
            supersample: 2,
            palette: Palette::Plain,
            shadow: 0.6,
            background: [[0xfb, 0xfc, 0xfd], [0xdf, 0xe4, 0xea]],
            transparent: false,
            solid: None,
        }
    }
}

/// A picture and what it cost.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The picture.
    pub image: Image,
    /// Evaluations, and points where the function was undefined.
    pub counters: Counters,
    /// Rays that met the object: 0 for one that is empty or out of sight.
    pub hits: u64,
}

/// The object seen by the camera. The shape has three axes; a program of [`crate::vm::Demand::Sign`] is enough.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
///
/// # Panics
/// If the shape has another number of axes.
pub fn raycast(
    shape: &Shape,
    space: Space,
    camera: &Camera,
    style: &Style,
    interrupt: &Interrupt,
) -> Result<Picture, Cancelled> {
    assert_eq!(shape.dimension, 3, "rays are cast in a space of three axes");
    let [width, height] = style.size;
    if width == 0 || height == 0 {
        return Ok(Picture { image: Image::new(width, height, [0; 3]), counters: Counters::default(), hits: 0 });
    }
    let fine = style.supersample.clamp(1, 4);
    // Tiles are whole pixels.
    let tile = if fine == 3 { 6 } else { 8 };
    let scene = Scene { camera: *camera, space, rays: [width * fine, height * fine], tile };
    let lights = Lights::new(camera, style.solid.unwrap_or(style.palette.solid()));
    let (shadows, mut counters) = if style.shadow > 0.0 {
        let side = width.max(height).clamp(256, 2048);
        let (shadows, cost) = Shadows::cast(shape, space, lights.key(), side, interrupt)?;
        (Some(shadows), cost)
    } else {
        (None, Counters::default())
    };
    let brush = Brush {
        scene,
        lights,
        shadows,
        shadow: style.shadow.min(1.0),
        backdrop: backdrop(style),
        fine,
        clear: style.transparent,
    };
    let (tiles, cost) = cast(shape, &scene, |tile| brush.paint(tile), interrupt)?;
    counters.add(cost);
    let mut image = Image::new(width, height, [0; 3]);
    let mut hits = 0;
    for (from, size, (pixels, met)) in tiles {
        hits += met;
        let columns = size[0] / fine;
        for (row, pixels) in pixels.chunks_exact(4 * columns).enumerate() {
            let at = 4 * ((from[1] / fine + row) * width + from[0] / fine);
            image.rgba[at..at + pixels.len()].copy_from_slice(pixels);
        }
    }
    Ok(Picture { image, counters, hits })
}

/// The camera of that view which frames the object, in a picture of the style's size.
#[must_use]
pub fn framed(view: &View, extent: &Extent, style: &Style) -> Camera {
    Camera::framing(view, &extent.points(), style.size[0] as f64 / style.size[1].max(1) as f64)
}

/// The background's light, row by row.
fn backdrop(style: &Style) -> Vec<Light> {
    let [top, bottom] = style.background.map(|colour| colour.map(linear));
    let rows = style.size[1];
    let at = |j: usize| j as f32 / (rows.max(2) - 1) as f32;
    (0..rows).map(|j| std::array::from_fn(|k| top[k] + at(j) * (bottom[k] - top[k]))).collect()
}

/// Turns hits into pixels.
struct Brush {
    scene: Scene,
    lights: Lights,
    shadows: Option<Shadows>,
    shadow: f32,
    backdrop: Vec<Light>,
    fine: usize,
    clear: bool,
}

impl Brush {
    /// The pixels of a tile, four bytes each, and how many of its rays met the object.
    fn paint(&self, tile: Tile<'_>) -> (Vec<u8>, u64) {
        let fine = self.fine;
        let [columns, rows] = tile.size.map(|n| n / fine);
        let mut pixels = Vec::with_capacity(4 * columns * rows);
        for j in 0..rows {
            let behind = self.backdrop[tile.from[1] / fine + j];
            let [r, g, b] = behind.map(encode);
            let empty = if self.clear { [0; 4] } else { [r, g, b, 255] };
            for i in 0..columns {
                pixels.extend(if tile.hits.is_empty() { empty } else { self.pixel(&tile, [i, j], behind) });
            }
        }
        (pixels, tile.hits.iter().flatten().count() as u64)
    }

    /// The mean light of a pixel's rays and its opacity. Each is cut at white first, so that a gleam does not make its edge jagged.
    fn pixel(&self, tile: &Tile<'_>, [i, j]: [usize; 2], behind: Light) -> [u8; 4] {
        let fine = self.fine;
        let (mut sum, mut rays) = ([0.0_f32; 3], 0_u32);
        for y in j * fine..(j + 1) * fine {
            for x in i * fine..(i + 1) * fine {
                let hit = tile.hits[y * tile.size[0] + x];
                if self.clear && hit.is_none() {
                    continue;
                }
                rays += 1;
                let light = hit.map_or(behind, |hit| self.light(&hit, tile.from[0] + x, tile.from[1] + y));
                (0..3).for_each(|k| sum[k] += light[k].min(1.0));
            }
        }
        let [r, g, b] = sum.map(|light| encode(light / rays.max(1) as f32));
        let all = (fine * fine) as f32;
        [r, g, b, (255.0 * rays as f32 / all).round() as u8]
    }

    /// The light of a hit of ray (i, j).
    fn light(&self, hit: &Hit, i: usize, j: usize) -> Light {
        self.lights.shade(hit, |facing| {
            let Some(shadows) = &self.shadows else { return 1.0 };
            let (start, direction) = self.scene.ray(i, j);
            let point = std::array::from_fn(|k| start[k] + hit.depth * direction[k]);
            1.0 - self.shadow * (1.0 - shadows.lit(point, hit.normal, facing))
        })
    }
}
