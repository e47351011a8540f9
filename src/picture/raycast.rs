//! A 3-D object in the light, on a soft light background: rays cast, shaded, and averaged over each pixel. Writes no files.

use super::camera::{Camera, View};
use super::extent::Extent;
use super::image::Image;
use super::palette::{Palette, encode, linear};
use super::rays::{Aim, Hit, Pattern, Scene, Tile, cast_on};
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
    /// Rays along each side of a pixel where it shows an edge, 1 to 4; elsewhere a pixel is the mean of its corners. With 1 every pixel is
    /// what one ray through its middle meets.
    pub supersample: usize,
    /// Decides the colour of the object.
    pub palette: Palette,
    /// How dark the key light's shadows are: 0 for none (and none are computed), 1 for as dark as its light is bright.
    pub shadow: f32,
    /// The colours at the top and at the bottom of the background.
    pub background: [[u8; 3]; 2],
    /// Whether there is no background: a pixel is as opaque as the part of it that the object covers.
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

impl Style {
    fn fine(&self) -> usize {
        self.supersample.clamp(1, 4)
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
    let scene = Scene { camera: *camera, space, rays: style.size, tile: 8 };
    let lights = Lights::new(camera, style.solid.unwrap_or(style.palette.solid()));
    let side = (width.max(height) * 3 / 4).clamp(256, 2048);
    let sun = (style.shadow > 0.0).then(|| Shadows::scene(space, lights.key(), side));
    let fine = style.fine();
    let passes = if fine > 1 { 2 } else { 1 };
    interrupt.begin(sun.map_or(0, |sun| sun.steps()) + passes * scene.steps());
    let (shadows, mut counters) = match sun {
        Some(_) => {
            let (shadows, cost) = Shadows::cast(shape, space, lights.key(), side, interrupt)?;
            (Some(shadows), cost)
        }
        None => (None, Counters::default()),
    };
    let brush = Brush::new(scene, style, lights, shadows);
    let mut picture = Picture { image: Image::new(width, height, [0; 3]), counters: Counters::default(), hits: 0 };
    let mut edges = vec![false; width * height];
    let aim = |pattern| Aim { pattern, tolerance: TOLERANCE, normals: true };
    let pattern = if fine > 1 { Pattern::Corners } else { Pattern::Middles };
    let (tiles, cost) = cast_on(shape, &scene, aim(pattern), |tile| brush.paint(&tile), interrupt)?;
    counters.add(cost);
    for (from, size, painted) in tiles {
        picture.hits += painted.hits;
        for (row, pixels) in painted.pixels.chunks_exact(size[0]).enumerate() {
            let at = (from[1] + row) * width + from[0];
            for (i, pixel) in pixels.iter().enumerate() {
                picture.image.rgba[4 * (at + i)..][..4].copy_from_slice(&pixel.rgba);
                edges[at + i] = pixel.edge;
            }
        }
    }
    if fine > 1 {
        let aim = aim(Pattern::Shares(fine, &edges));
        let (tiles, cost) = cast_on(shape, &scene, aim, |tile| brush.touch_up(&tile), interrupt)?;
        counters.add(cost);
        for (at, rgba) in tiles.into_iter().flat_map(|(.., pixels)| pixels) {
            picture.image.rgba[4 * at..][..4].copy_from_slice(&rgba);
        }
    }
    picture.counters = counters;
    Ok(picture)
}

/// How exactly depths are found, as a part of the range of depths: a hundredth of a pixel in a picture of 10,000 of them.
const TOLERANCE: f64 = 1e-6;

/// How far the colours at the corners of a pixel may lie apart, of 1, before it is looked at more closely.
const CONTRAST: f32 = 0.03;

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
    style: Style,
    backdrop: Vec<Light>,
    /// The pixels of the rows where nothing is hit.
    empty: Vec<[u8; 4]>,
    fine: usize,
}

/// A tile of pixels, row by row.
struct Painted {
    pixels: Vec<Pixel>,
    hits: u64,
}

struct Pixel {
    rgba: [u8; 4],
    /// Whether it shows more than its corners tell.
    edge: bool,
}

impl Brush {
    fn new(scene: Scene, style: &Style, lights: Lights, shadows: Option<Shadows>) -> Self {
        let backdrop = backdrop(style);
        let empty = |light: &Light| {
            let [r, g, b] = light.map(encode);
            if style.transparent { [0; 4] } else { [r, g, b, 255] }
        };
        let empty = backdrop.iter().map(empty).collect();
        Self { scene, lights, shadows, style: *style, backdrop, empty, fine: style.fine() }
    }

    /// The pixels of a tile from rays through their corners, or through their middles.
    fn paint(&self, tile: &Tile<'_>) -> Painted {
        let [columns, rows] = tile.size;
        let (corners, across) = if self.fine > 1 { (1, columns + 1) } else { (0, columns) };
        let lights = self.lights(tile);
        let mut pixels = Vec::with_capacity(columns * rows);
        for j in 0..rows {
            for i in 0..columns {
                let at = |x: usize, y: usize| lights.get((j + y) * across + i + x).copied().flatten();
                let seen = [at(0, 0), at(corners, 0), at(0, corners), at(corners, corners)];
                pixels.push(Pixel { rgba: self.mean(&seen, tile.from[1] + j), edge: differ(&seen) });
            }
        }
        Painted { pixels, hits: tile.hits.iter().flatten().count() as u64 }
    }

    /// The pixels of a tile that show edges, by their index in the picture.
    fn touch_up(&self, tile: &Tile<'_>) -> Vec<(usize, [u8; 4])> {
        let lights = self.lights(tile);
        let cells = tile.places.chunks_exact(self.fine * self.fine).map(|places| places[0].map(|v| v as usize));
        let pixels = cells.zip(lights.chunks_exact(self.fine * self.fine));
        pixels.map(|([i, j], seen)| (j * self.style.size[0] + i, self.mean(seen, j))).collect()
    }

    /// The light of each ray of a tile; none where it misses.
    fn lights(&self, tile: &Tile<'_>) -> Vec<Option<Light>> {
        tile.hits.iter().zip(tile.places).map(|(hit, &place)| Some(self.light(hit.as_ref()?, place))).collect()
    }

    /// The mean of what the rays of a pixel see. Each light is cut at white first, so that a gleam does not make its edge jagged.
    fn mean(&self, seen: &[Option<Light>], row: usize) -> [u8; 4] {
        if seen.iter().all(Option::is_none) {
            return self.empty[row];
        }
        let (behind, clear) = (self.backdrop[row], self.style.transparent);
        let mut sum = [0.0_f32; 3];
        let mut covered = 0;
        for light in seen {
            covered += usize::from(light.is_some());
            let light = light.unwrap_or(if clear { [0.0; 3] } else { behind });
            (0..3).for_each(|k| sum[k] += light[k].min(1.0));
        }
        let count = if clear { covered.max(1) } else { seen.len() };
        let [r, g, b] = sum.map(|light| encode(light / count as f32));
        let opacity = if clear { (255 * covered + seen.len() / 2) / seen.len() } else { 255 };
        [r, g, b, opacity as u8]
    }

    /// The light of a hit of the ray through a place.
    fn light(&self, hit: &Hit, place: [f64; 2]) -> Light {
        self.lights.shade(hit, |facing| {
            let Some(shadows) = &self.shadows else { return 1.0 };
            let (start, direction) = self.scene.through(place);
            let point = std::array::from_fn(|k| start[k] + hit.depth * direction[k]);
            1.0 - self.style.shadow.min(1.0) * (1.0 - shadows.lit(point, hit.normal, facing))
        })
    }
}

/// Whether some of the rays miss and others do not, or their colours lie far apart.
fn differ(seen: &[Option<Light>; 4]) -> bool {
    // The root is near enough to the code of a colour.
    let colours = seen.map(|light| light.map(|light| light.map(|v| v.clamp(0.0, 1.0).sqrt())));
    let [first, rest @ ..] = &colours;
    rest.iter().any(|other| match (first, other) {
        (Some(a), Some(b)) => a.iter().zip(b).any(|(a, b)| (a - b).abs() > CONTRAST),
        (None, None) => false,
        _ => true,
    })
}
