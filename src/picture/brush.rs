//! From hits to pixels: the light of each ray, what lies behind what, and the mean over a pixel. Casts no rays.

use std::sync::Arc;

use super::paint::Paint;
use super::palette::{bright, encode, linear};
use super::raycast::{Air, Style, TOLERANCE, Thing};
use super::rays::{Hit, Scene, Tile};
use super::shade::{Light, tinted};

/// How far the colours at the corners of a pixel may lie apart, of 1, before it is looked at more closely.
const CONTRAST: f32 = 0.03;

/// Where a ray meets an object: the depth, the light that leaves it, and how much it hides.
pub(super) type Lit = Option<(f64, Light, f32)>;

/// What a ray sees: light as far as it is hidden by nothing, and the part of the background that it hides. None where it meets nothing.
type Seen = Option<(Light, f32)>;

/// Turns hits into pixels.
pub(super) struct Brush<'a> {
    pub(super) scene: Scene,
    pub(super) fine: usize,
    things: &'a [Thing],
    air: &'a Air,
    style: Style,
    ground: Arc<Ground>,
    /// Depths that differ by less are those of one place.
    same: f64,
}

/// The background's light, row by row, and the pixels of the rows where nothing is hit.
#[derive(Debug)]
pub(super) struct Ground {
    backdrop: Vec<Light>,
    empty: Vec<[u8; 4]>,
}

impl Ground {
    pub(super) fn new(style: &Style) -> Self {
        let backdrop = backdrop(style);
        let empty = |light: &Light| {
            let [r, g, b] = light.map(encode);
            if style.transparent { [0; 4] } else { [r, g, b, 255] }
        };
        let empty = backdrop.iter().map(empty).collect();
        Self { backdrop, empty }
    }
}

/// A tile of pixels, row by row.
pub(super) struct Painted {
    pub(super) pixels: Vec<Pixel>,
    pub(super) hits: u64,
}

pub(super) struct Pixel {
    pub(super) rgba: [u8; 4],
    /// Whether it shows more than its corners tell.
    pub(super) edge: bool,
}

impl<'a> Brush<'a> {
    pub(super) fn new(scene: Scene, style: &Style, things: &'a [Thing], air: &'a Air) -> Self {
        Self::on(&Arc::new(Ground::new(style)), scene, style, things, air)
    }

    /// The same on a ground that is there already.
    pub(super) fn on(ground: &Arc<Ground>, scene: Scene, style: &Style, things: &'a [Thing], air: &'a Air) -> Self {
        let (near, far) = scene.camera.depths(scene.space.lo, scene.space.hi);
        let same = 3.0 * TOLERANCE * (far - near);
        Self { scene, fine: style.fine(), things, air, style: *style, ground: Arc::clone(ground), same }
    }

    /// The light of each ray of a tile that meets object `k`; empty if none does.
    pub(super) fn lit(&self, k: usize, tile: &Tile<'_>) -> Vec<Lit> {
        if tile.hits.iter().all(Option::is_none) {
            return Vec::new();
        }
        let mut points: [Vec<f64>; 3] = Default::default();
        for (hit, &place) in tile.hits.iter().zip(tile.places) {
            if let Some(hit) = hit {
                let point = self.point(hit, place);
                points.iter_mut().zip(point).for_each(|(axis, v)| axis.push(v));
            }
        }
        let mut bodies = match &self.things[k].paint {
            Paint::Plain(colour) => vec![colour.map(linear); points[0].len()],
            paint => paint.at(&[&points[0], &points[1], &points[2]]).into_iter().map(|c| c.map(bright)).collect(),
        }
        .into_iter()
        .enumerate();
        let light = |hit: &Option<Hit>| {
            let hit = hit.as_ref()?;
            let (n, body) = bodies.next()?;
            let point = [points[0][n], points[1][n], points[2][n]];
            Some((hit.depth, self.light(k, hit, point, body), self.opacity(k, hit, point)))
        };
        tile.hits.iter().map(light).collect()
    }

    fn point(&self, hit: &Hit, place: [f64; 2]) -> [f64; 3] {
        let (start, direction) = self.scene.through(place);
        let space = self.scene.space;
        std::array::from_fn(|k| (start[k] + hit.depth * direction[k]).clamp(space.lo[k], space.hi[k]))
    }

    /// The light that leaves a point of object `k`.
    fn light(&self, k: usize, hit: &Hit, point: [f64; 3], body: Light) -> Light {
        let hatch = if hit.cap { self.hatch(k, hit, point) } else { 1.0 };
        let lit = |facing| {
            let Some(shadows) = self.air.shadows(k) else { return 1.0 };
            1.0 - self.style.shadow.min(1.0) * (1.0 - shadows.lit(point, hit.normal, facing))
        };
        let open = self.air.occlusion.as_ref().map_or(1.0, |occlusion| occlusion.open(point, hit.normal));
        let tint = if !hit.cap {
            0.0
        } else if self.section(hit).is_some() {
            SECTION_TINT
        } else {
            SPACE_TINT
        };
        self.air.lights.shade(hit, tinted(body, tint), lit, open).map(|v| v * hatch)
    }

    /// How much object `k` hides at a point: a shell more where one looks along it, a section all.
    fn opacity(&self, k: usize, hit: &Hit, point: [f64; 3]) -> f32 {
        let straight = self.things[k].opacity.clamp(0.0, 1.0);
        if straight >= 1.0 || hit.cap && self.section(hit).is_some() {
            return 1.0;
        }
        let camera = &self.scene.camera;
        let ray: [f64; 3] = match camera.growth {
            [0.0, 0.0] => camera.forward,
            _ => std::array::from_fn(|k| point[k] - camera.eye[k]),
        };
        let along = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
        let facing = (along(ray, hit.normal).abs() / along(ray, ray).sqrt()).min(1.0);
        let edge = (1.0 - facing) as f32;
        straight + (EDGE - straight) * edge * edge
    }

    /// The axis of the section that a cap is, if it is one.
    fn section(&self, hit: &Hit) -> Option<usize> {
        let axis = (0..3).find(|&axis| hit.normal[axis].abs() == 1.0)?;
        self.style.cuts[axis][usize::from(hit.normal[axis] > 0.0)].then_some(axis)
    }

    /// How bright the lines are that mark a face as a section, 1 between them: a dozen pixels apart, to one side or the other.
    fn hatch(&self, k: usize, hit: &Hit, point: [f64; 3]) -> f32 {
        let Some(axis) = self.section(hit) else { return 1.0 };
        let camera = &self.scene.camera;
        let [_, rows] = self.scene.rays;
        // As wide in space everywhere, so that the lines run straight on through the picture.
        let (near, far) = camera.depths(self.scene.space.lo, self.scene.space.hi);
        let of_pixel = |depth: f64| 2.0 * (camera.base[1] + depth * camera.growth[1]) / rows as f64;
        let step = HATCH_STEP * of_pixel(0.5 * (near + far));
        let (a, b) = (point[(axis + 1) % 3], point[(axis + 2) % 3]);
        let along = if k.is_multiple_of(2) { a + b } else { a - b } * std::f64::consts::FRAC_1_SQRT_2;
        let off = (along / step - (along / step).round()).abs() * step;
        let covered = 0.5 + (HATCH_HALF * step - off) / of_pixel(hit.depth);
        1.0 - HATCH_DEPTH * covered.clamp(0.0, 1.0) as f32
    }

    /// The pixels of a tile from the rays of each object through their corners, or through their middles.
    pub(super) fn paint(&self, from: [usize; 2], [columns, rows]: [usize; 2], layers: &[&[Lit]]) -> Painted {
        let (corners, across) = if self.fine > 1 { (1, columns + 1) } else { (0, columns) };
        let hits = layers.iter().copied().flatten().flatten().count() as u64;
        let seen: Vec<Seen> = if hits == 0 {
            Vec::new()
        } else {
            (0..(columns + corners) * (rows + corners)).map(|ray| self.blend(layers, ray)).collect()
        };
        let mut pixels = Vec::with_capacity(columns * rows);
        for j in 0..rows {
            let row = from[1] + j;
            for i in 0..columns {
                let at = |x: usize, y: usize| seen.get((j + y) * across + i + x).copied().flatten();
                let seen = [at(0, 0), at(corners, 0), at(0, corners), at(corners, corners)];
                pixels.push(Pixel { rgba: self.mean(&seen, row), edge: differ(&seen, self.ground.backdrop[row]) });
            }
        }
        Painted { pixels, hits }
    }

    /// The lights of the rays through the cells of a tile that show edges, by their pixel's index in the picture.
    pub(super) fn shares(&self, k: usize, tile: &Tile<'_>) -> Vec<(usize, Vec<Lit>)> {
        let lit = self.lit(k, tile);
        let rays = self.fine * self.fine;
        let pixel = |places: &[[f64; 2]]| places[0][1] as usize * self.style.size[0] + places[0][0] as usize;
        let cells = tile.places.chunks_exact(rays).map(pixel);
        cells.zip(lit.chunks_exact(rays).map(<[Lit]>::to_vec)).collect()
    }

    /// The `n`-th of the pixels that show edges, in that row.
    pub(super) fn touch_up(&self, layers: &[&[Lit]], n: usize, row: usize) -> [u8; 4] {
        let rays = self.fine * self.fine;
        let seen: Vec<Seen> = (n * rays..(n + 1) * rays).map(|ray| self.blend(layers, ray)).collect();
        self.mean(&seen, row)
    }

    /// What a ray sees of all objects: from the nearest on, until one hides the rest.
    fn blend(&self, layers: &[&[Lit]], ray: usize) -> Seen {
        let hit = |k: usize| layers[k].get(ray).copied().flatten();
        if layers.len() == 1 {
            return hit(0).map(|only| behind(&[only]));
        }
        let mut order: Vec<(f64, Light, f32)> = Vec::with_capacity(layers.len());
        for new in (0..layers.len()).filter_map(hit) {
            // What was named first stays before what lies in the same place.
            let place = order.iter().position(|old| new.0 < old.0 - self.same).unwrap_or(order.len());
            order.insert(place, new);
        }
        // Behind the last there is only the ground, which need not be seen well.
        if let Some((.., opacity)) = order.last_mut() {
            *opacity = opacity.max(DEEPEST);
        }
        (!order.is_empty()).then(|| behind(&order))
    }

    /// The mean of what the rays of a pixel see.
    fn mean(&self, seen: &[Seen], row: usize) -> [u8; 4] {
        if seen.iter().all(Option::is_none) {
            return self.ground.empty[row];
        }
        let behind = self.ground.backdrop[row];
        let (mut sum, mut covered) = ([0.0_f32; 3], 0.0_f32);
        for seen in seen {
            let (light, cover) = seen.unwrap_or_default();
            let through = if self.style.transparent { 0.0 } else { 1.0 - cover };
            (0..3).for_each(|k| sum[k] += light[k] + through * behind[k]);
            covered += cover;
        }
        let count = if self.style.transparent { covered.max(f32::MIN_POSITIVE) } else { seen.len() as f32 };
        let [r, g, b] = sum.map(|light| encode(light / count));
        let opacity = if self.style.transparent { (255.0 * covered / seen.len() as f32).round() as u8 } else { 255 };
        [r, g, b, opacity]
    }
}

/// Lays lights behind each other, the first in front.
fn behind(order: &[(f64, Light, f32)]) -> (Light, f32) {
    let (mut sum, mut left) = ([0.0; 3], 1.0_f32);
    for (_, light, opacity) in order {
        // A gleam is cut at white first, so that it does not make its edge jagged.
        (0..3).for_each(|c| sum[c] += left * opacity * light[c].min(1.0));
        left *= 1.0 - opacity;
        if left <= 0.0 {
            break;
        }
    }
    (sum, 1.0 - left)
}

/// How much a translucent shell hides where one looks along it.
const EDGE: f32 = 0.9;

/// How much the deepest of several shells hides at least.
const DEEPEST: f32 = 0.75;

/// Pixels from line to line of a section's hatch.
const HATCH_STEP: f64 = 11.0;
/// Half of the part of it that a line takes.
const HATCH_HALF: f64 = 0.09;
/// How much of its warm tint a face of the modelling space takes that cuts an object, and a section, which its lines mark as well.
const SPACE_TINT: f32 = 0.6;
const SECTION_TINT: f32 = 0.3;
/// How dark a line is.
const HATCH_DEPTH: f32 = 0.45;

/// The background's light, row by row.
fn backdrop(style: &Style) -> Vec<Light> {
    let [top, bottom] = style.background.map(|colour| colour.map(linear));
    let rows = style.size[1];
    let at = |j: usize| j as f32 / (rows.max(2) - 1) as f32;
    (0..rows).map(|j| std::array::from_fn(|k| top[k] + at(j) * (bottom[k] - top[k]))).collect()
}

/// Whether some of the rays miss and others do not, or their colours lie far apart.
fn differ(seen: &[Seen; 4], behind: Light) -> bool {
    // The root is near enough to the code of a colour.
    let colour = |(light, cover): (Light, f32)| -> Light {
        std::array::from_fn(|k| (light[k] + (1.0 - cover) * behind[k]).clamp(0.0, 1.0).sqrt())
    };
    let colours = seen.map(|seen| seen.map(colour));
    let [first, rest @ ..] = &colours;
    rest.iter().any(|other| match (first, other) {
        (Some(a), Some(b)) => a.iter().zip(b).any(|(a, b)| (a - b).abs() > CONTRAST),
        (None, None) => false,
        _ => true,
    })
}
