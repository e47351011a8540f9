//! 3-D objects in the light: rays cast at each, shaded where they meet it, and averaged over each pixel. Writes no files.

use rayon::prelude::*;

use super::brush::{Brush, Lit};
use super::camera::{Camera, View};
use super::extent::Extent;
use super::image::Image;
use super::occlusion::Occlusion;
use super::paint::Paint;
use super::palette::Palette;
use super::rays::{Aim, Pattern, Scene, Tile, cast_on};
use super::shade::Lights;
use super::shadow::Shadows;
use crate::interrupt::{Cancelled, Interrupt};
use crate::reuse::Digest;
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
    /// Decides the colour of an object that has none of its own.
    pub palette: Palette,
    /// From where the key light shines, as azimuth and elevation of a [`View`] in radians; from above the camera's left shoulder if
    /// nothing is said.
    pub light: Option<[f64; 2]>,
    /// How bright the fill light is, 0 to 1.
    pub fill: f32,
    /// How dark the key light's shadows are: 0 for none (and none are computed), 1 for as dark as its light is bright.
    pub shadow: f32,
    /// Whether hollows and corners get less of the light of the sky.
    pub occlusion: bool,
    /// The colours at the top and at the bottom of the background.
    pub background: [[u8; 3]; 2],
    /// Whether there is no background: a pixel is as opaque as the part of it that the objects cover.
    pub transparent: bool,
    /// The faces of the space that are sections through the object and hatched as such: for each axis the lower and the upper one.
    pub cuts: [[bool; 2]; 3],
}

impl Default for Style {
    fn default() -> Self {
        Self {
            size: [800, 600],
            supersample: 2,
            palette: Palette::Plain,
            light: None,
            fill: 1.0,
            shadow: 0.6,
            occlusion: false,
            background: GROUND,
            transparent: false,
            cuts: [[false; 2]; 3],
        }
    }
}

/// The usual background: a soft light grey, brighter above.
pub const GROUND: [[u8; 3]; 2] = [[0xfb, 0xfc, 0xfd], [0xdf, 0xe4, 0xea]];

impl Style {
    pub(super) fn fine(&self) -> usize {
        self.supersample.clamp(1, 4)
    }
}

/// One of the objects of a picture.
#[derive(Clone, Debug)]
pub struct Thing {
    /// The object, of three axes; a program of [`crate::vm::Demand::Sign`] is enough.
    pub shape: Shape,
    /// Its colour.
    pub paint: Paint,
    /// How much of what lies behind its boundary is hidden where one looks straight at it: 1 for all; below that, more where one looks
    /// along it, as at glass, and all at sections. What lets light through throws its shadow on itself alone.
    pub opacity: f32,
}

impl Thing {
    /// What nothing shows through.
    #[must_use]
    pub fn opaque(shape: Shape, paint: Paint) -> Self {
        Self { shape, paint, opacity: 1.0 }
    }

    fn tell(&self, to: &mut Digest) {
        self.shape.tell(to);
        self.paint.tell(to);
        to.shown(&self.opacity);
    }

    pub(super) fn is_opaque(&self) -> bool {
        self.opacity >= 1.0
    }
}

/// A picture and what it cost.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The picture.
    pub image: Image,
    /// Evaluations, and points where the function was undefined.
    pub counters: Counters,
    /// Rays that met an object: 0 for one that is empty or out of sight.
    pub hits: u64,
}

/// One object in the palette's colour, seen by the camera. The shape has three axes; a program of [`crate::vm::Demand::Sign`] is enough.
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
    let thing = Thing::opaque(shape.clone(), Paint::Plain(style.palette.solid()));
    render(&[thing], space, camera, style, interrupt)
}

/// Objects in one space, seen by the camera: each hides what lies behind it, and throws its shadow on all. Of two that share a piece of
/// boundary the first is seen there.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
///
/// # Panics
/// If a shape has another number of axes than three.
pub fn render(
    things: &[Thing],
    space: Space,
    camera: &Camera,
    style: &Style,
    interrupt: &Interrupt,
) -> Result<Picture, Cancelled> {
    assert!(things.iter().all(|thing| thing.shape.dimension == 3), "rays are cast in a space of three axes");
    let tell = |to: &mut Digest| {
        to.shown(&(space, camera, style));
        things.iter().for_each(|thing| thing.tell(to));
    };
    let bytes = |picture: &Picture| picture.image.rgba.len();
    interrupt.whole("pictures", tell, bytes, || rendered(things, space, camera, style, interrupt))
}

fn rendered(
    things: &[Thing],
    space: Space,
    camera: &Camera,
    style: &Style,
    interrupt: &Interrupt,
) -> Result<Picture, Cancelled> {
    let [width, height] = style.size;
    let mut picture = Picture { image: Image::new(width, height, [0; 3]), counters: Counters::default(), hits: 0 };
    if width == 0 || height == 0 {
        return Ok(picture);
    }
    let scene = Scene { camera: *camera, space, rays: style.size, tile: 8 };
    let lights = Lights::new(camera, style.light, style.fill);
    let side = side(style);
    let sun = Shadows::scene(space, lights.key(), side).steps();
    let passes = if style.fine() > 1 { 2 } else { 1 };
    let shadows = if style.shadow > 0.0 { sun } else { 0 };
    interrupt.begin(things.len() as u64 * (shadows + passes * scene.steps()) + Occlusion::steps(things, space, style));
    let mut air = Air { lights, ..Air::default() };
    if style.shadow > 0.0 {
        picture.counters.add(air.cast_shadows(things, space, side, interrupt)?);
    }
    if style.occlusion {
        let (occlusion, cost) = Occlusion::cast(things, space, style, interrupt)?;
        picture.counters.add(cost);
        air.occlusion = Some(occlusion);
    }
    let brush = Brush::new(scene, style, things, &air);
    let mut edges = vec![false; width * height];
    first_pass(&brush, things, &mut picture, &mut edges, interrupt)?;
    if picture.hits == 0 || width.min(height) < NARROW {
        // What lies between the corners of so few pixels is seen by more rays alone.
        edges.fill(width * height <= MOST_SMALL);
    }
    if style.fine() > 1 {
        second_pass(&brush, things, &mut picture, &edges, interrupt)?;
    }
    Ok(picture)
}

/// Rays of the key light along each side of what it sees.
pub(super) fn side(style: &Style) -> usize {
    (style.size[0].max(style.size[1]) * 3 / 4).clamp(256, 2048)
}

/// A picture with a shorter side than this takes more rays through all of its pixels, as does a small one in which nothing is seen.
const NARROW: usize = 8;

/// Pixels that may all take more rays.
const MOST_SMALL: usize = 1 << 16;

/// What is between the lights and the objects.
#[derive(Debug, Default)]
pub(super) struct Air {
    pub(super) lights: Lights,
    /// Where the key light reaches past all opaque objects.
    common: Option<Shadows>,
    /// Where it reaches a translucent object past those and the object itself; by the object's number.
    own: Vec<Option<Shadows>>,
    pub(super) occlusion: Option<Occlusion>,
}

impl Air {
    /// The lights, and where the key light reaches.
    pub(super) fn under(lights: Lights, common: Option<Shadows>) -> Self {
        Self { lights, common, ..Self::default() }
    }

    pub(super) fn common(&self) -> Option<&Shadows> {
        self.common.as_ref()
    }

    pub(super) fn common_mut(&mut self) -> Option<&mut Shadows> {
        self.common.as_mut()
    }

    fn cast_shadows(
        &mut self,
        things: &[Thing],
        space: Space,
        side: usize,
        interrupt: &Interrupt,
    ) -> Result<Counters, Cancelled> {
        let mut counters = Counters::default();
        for thing in things {
            let (shadows, cost) = Shadows::cast(&thing.shape, space, self.lights.key(), side, interrupt)?;
            counters.add(cost);
            self.own.push(Some(shadows));
        }
        for (_, own) in things.iter().zip(&mut self.own).filter(|(thing, _)| thing.is_opaque()) {
            match (&mut self.common, own.take()) {
                (Some(common), Some(own)) => common.join(&own),
                (common, own) => *common = own,
            }
        }
        for own in self.own.iter_mut().flatten() {
            if let Some(common) = &self.common {
                own.join(common);
            }
        }
        Ok(counters)
    }

    /// Where the key light reaches an object.
    pub(super) fn shadows(&self, thing: usize) -> Option<&Shadows> {
        self.own.get(thing).and_then(Option::as_ref).or(self.common.as_ref())
    }
}

/// All pixels from rays through their corners (or middles), and which of them show edges.
fn first_pass(
    brush: &Brush<'_>,
    things: &[Thing],
    picture: &mut Picture,
    edges: &mut [bool],
    interrupt: &Interrupt,
) -> Result<(), Cancelled> {
    let pattern = if brush.fine > 1 { Pattern::Corners } else { Pattern::Middles };
    let aim = Aim { pattern, tolerance: TOLERANCE, normals: true };
    let [width, height] = [picture.image.width, picture.image.height];
    let mut painted = Vec::new();
    if let [thing] = things {
        let finish = |tile: Tile<'_>| brush.paint(tile.from, tile.size, &[&brush.lit(0, &tile)]);
        let (tiles, cost) = cast_on(&thing.shape, &brush.scene, aim, finish, interrupt)?;
        picture.counters.add(cost);
        painted = tiles;
    } else {
        let more = usize::from(brush.fine > 1);
        let mut layers = Vec::new();
        for (k, thing) in things.iter().enumerate() {
            let (tiles, cost) = cast_on(&thing.shape, &brush.scene, aim, |tile| brush.lit(k, &tile), interrupt)?;
            picture.counters.add(cost);
            layers.push(sheet(tiles, [width, height], more));
        }
        let across = width + more;
        let band = |from: usize| {
            let rows = BAND.min(height - from);
            let part = |layer: &'_ Vec<Lit>| from * across..((from + rows + more) * across).min(layer.len());
            let parts: Vec<&[Lit]> = layers.iter().map(|layer| &layer[part(layer)]).collect();
            interrupt.tick()?;
            Ok(([0, from], [width, rows], brush.paint([0, from], [width, rows], &parts)))
        };
        let bands: Result<Vec<_>, Cancelled> = (0..height).into_par_iter().step_by(BAND).map(band).collect();
        painted.extend(bands?);
    }
    for (from, size, tile) in painted {
        picture.hits += tile.hits;
        for (row, pixels) in tile.pixels.chunks_exact(size[0]).enumerate() {
            let at = (from[1] + row) * width + from[0];
            for (i, pixel) in pixels.iter().enumerate() {
                picture.image.rgba[4 * (at + i)..][..4].copy_from_slice(&pixel.rgba);
                edges[at + i] = pixel.edge;
            }
        }
    }
    Ok(())
}

/// Rows of pixels that are painted together where several objects are shown.
const BAND: usize = 16;

/// The rays of tiles, which differ from object to object, as rows of the whole picture.
fn sheet(tiles: Tiled<Vec<Lit>>, [width, height]: [usize; 2], more: usize) -> Vec<Lit> {
    let across = width + more;
    let mut all = vec![None; across * (height + more)];
    for (from, size, lit) in tiles {
        for (row, lit) in lit.chunks_exact(size[0] + more).enumerate() {
            all[(from[1] + row) * across + from[0]..][..lit.len()].copy_from_slice(lit);
        }
    }
    all
}

type Tiled<T> = Vec<([usize; 2], [usize; 2], T)>;

/// The pixels that show edges, from more rays.
fn second_pass(
    brush: &Brush<'_>,
    things: &[Thing],
    picture: &mut Picture,
    edges: &[bool],
    interrupt: &Interrupt,
) -> Result<(), Cancelled> {
    let aim = Aim { pattern: Pattern::Shares(brush.fine, edges), tolerance: TOLERANCE, normals: true };
    let cells: Vec<usize> = (0..edges.len()).filter(|&at| edges[at]).collect();
    let rays = brush.fine * brush.fine;
    let mut layers = Vec::new();
    for (k, thing) in things.iter().enumerate() {
        let (tiles, cost) = cast_on(&thing.shape, &brush.scene, aim, |tile| brush.shares(k, &tile), interrupt)?;
        picture.counters.add(cost);
        let mut layer: Vec<Lit> = vec![None; cells.len() * rays];
        for (at, lit) in tiles.into_iter().flat_map(|(.., shares)| shares) {
            if let Ok(cell) = cells.binary_search(&at) {
                layer[cell * rays..][..rays].copy_from_slice(&lit);
            }
        }
        layers.push(layer);
    }
    let parts: Vec<&[Lit]> = layers.iter().map(Vec::as_slice).collect();
    let pixels: Vec<[u8; 4]> =
        cells.par_iter().enumerate().map(|(n, &at)| brush.touch_up(&parts, n, at / picture.image.width)).collect();
    picture.hits += layers.iter().flatten().flatten().count() as u64;
    for (at, rgba) in cells.into_iter().zip(pixels) {
        picture.image.rgba[4 * at..][..4].copy_from_slice(&rgba);
    }
    Ok(())
}

/// How exactly depths are found, as a part of the range of depths: a hundredth of a pixel in a picture of 10,000 of them.
pub(super) const TOLERANCE: f64 = 1e-6;

/// The camera of that view which frames the object, in a picture of the style's size.
#[must_use]
pub fn framed(view: &View, extent: &Extent, style: &Style) -> Camera {
    Camera::framing(view, &extent.points(), style.size[0] as f64 / style.size[1].max(1) as f64)
}
