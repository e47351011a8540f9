//! A picture that stays while its object is worked on: what a change of the object touches is cast anew, all else is kept. The camera, the
//! space and the light stay as they are. Knows no language, and not what was changed: it is told where.

use super::brush::{Brush, Lit, Painted};
use super::camera::Camera;
use super::image::Image;
use super::raycast::{Air, Space, Style, TOLERANCE, Thing};
use super::rays::{Aim, Hit, Pattern, Scene, Tile, search_in};
use super::shade::Lights;
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::boxes::points;
use crate::surface::sampler::Counters;

/// Pixels along each side of the pieces that a picture is redrawn in: those that rays are cast in together.
pub const PIECE: usize = 32;

/// A part of a picture: its first column and row, and one past its last ones.
pub type Window = [[usize; 2]; 2];

/// A kept picture of one object.
#[derive(Debug)]
pub struct Easel {
    space: Space,
    camera: Camera,
    style: Style,
    image: Image,
    edges: Vec<bool>,
    /// Rays that met the object in each piece, row by row.
    met: Vec<u64>,
}

/// What is painted but not yet on the picture.
struct Patch {
    from: [usize; 2],
    size: [usize; 2],
    painted: Painted,
}

impl Easel {
    /// Draws the whole of an object. Where the style asks for shadows or for occlusion, everything depends on everything: such a picture
    /// is to be drawn anew after each change.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn draw(
        thing: &Thing,
        space: Space,
        camera: &Camera,
        style: &Style,
        interrupt: &Interrupt,
    ) -> Result<(Self, Counters), Cancelled> {
        let [width, height] = style.size;
        let pieces = width.div_ceil(PIECE) * height.div_ceil(PIECE);
        let mut easel = Self {
            space,
            camera: *camera,
            style: *style,
            image: Image::new(width, height, [0; 3]),
            edges: vec![false; width * height],
            met: vec![0; pieces],
        };
        let counters = easel.redraw(&[([[0; 2], style.size], thing.clone())], interrupt)?;
        Ok((easel, counters))
    }

    /// The picture.
    #[must_use]
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// Rays that meet the object.
    #[must_use]
    pub fn hits(&self) -> u64 {
        self.met.iter().sum()
    }

    /// The first and the last column and row in which the object is seen, to a piece where it fills one; `None` if it is nowhere.
    #[must_use]
    pub fn seen(&self) -> Option<[[usize; 2]; 2]> {
        let [width, height] = self.style.size;
        let across = width.div_ceil(PIECE);
        let mut seen: Option<[[usize; 2]; 2]> = None;
        for piece in (0..self.met.len()).filter(|&piece| self.met[piece] > 0) {
            let from = [piece % across * PIECE, piece / across * PIECE];
            let to = [(from[0] + PIECE).min(width) - 1, (from[1] + PIECE).min(height) - 1];
            let [a, b] = seen.unwrap_or([from, to]);
            seen = Some([[0, 1].map(|k| a[k].min(from[k])), [0, 1].map(|k| b[k].max(to[k]))]);
        }
        seen
    }

    /// The modelling space.
    #[must_use]
    pub fn space(&self) -> Space {
        self.space
    }

    /// The camera.
    #[must_use]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// How it is drawn.
    #[must_use]
    pub fn style(&self) -> &Style {
        &self.style
    }

    /// What is seen, and in how many pixels.
    #[must_use]
    pub fn scene(&self) -> Scene {
        Scene { camera: self.camera, space: self.space, rays: self.style.size, tile: PIECE / 4 }
    }

    /// Where a box is on the picture: the least and the largest column and row, in pixels from the top left, which may lie outside; `None`
    /// if the eye is not before all of it.
    #[must_use]
    pub fn place(&self, of: Space) -> Option<[[f64; 2]; 2]> {
        let mut seen = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for corner in 0..8_usize {
            let point = std::array::from_fn(|k| if corner >> k & 1 == 1 { of.hi[k] } else { of.lo[k] });
            let at = self.camera.place(point)?;
            let size = self.style.size.map(|n| n as f64);
            let at = [0.5 * (at[0] + 1.0) * size[0], 0.5 * (1.0 - at[1]) * size[1]];
            (0..2).for_each(|k| seen[0][k] = seen[0][k].min(at[k]));
            (0..2).for_each(|k| seen[1][k] = seen[1][k].max(at[k]));
        }
        Some(seen)
    }

    /// The parts of the picture that places on it (of [`Easel::place`]) reach into: whole pieces, no two of them in common. All of it if
    /// one of them is unknown.
    #[must_use]
    pub fn windows(&self, places: &[Option<[[f64; 2]; 2]>]) -> Vec<Window> {
        let [width, height] = self.style.size;
        let counts = [width.div_ceil(PIECE), height.div_ceil(PIECE)];
        let mut marked = vec![false; counts[0] * counts[1]];
        for place in places {
            let Some([from, to]) = place else { return vec![[[0; 2], self.style.size]] };
            // A ray through the common corner of two pixels belongs to both.
            let piece = |v: f64, k: usize| ((v / PIECE as f64).floor().max(-1.0) + 1.0).min(counts[k] as f64 + 1.0) as usize;
            let [i, j] = [0, 1].map(|k| (piece(from[k] - 1.5, k).max(1), piece(to[k] + 1.5, k).min(counts[k])));
            for row in j.0..=j.1 {
                (i.0..=i.1).for_each(|column| marked[(row - 1) * counts[0] + column - 1] = true);
            }
        }
        let mut windows: Vec<Window> = Vec::new();
        for row in 0..counts[1] {
            let mut column = 0;
            while column < counts[0] {
                if !marked[row * counts[0] + column] {
                    column += 1;
                    continue;
                }
                let first = column;
                while column < counts[0] && marked[row * counts[0] + column] {
                    column += 1;
                }
                let [left, right] = [first * PIECE, (column * PIECE).min(width)];
                let [top, bottom] = [row * PIECE, ((row + 1) * PIECE).min(height)];
                // Runs below each other are one part.
                match windows.iter_mut().find(|w| w[0][0] == left && w[1] == [right, top]) {
                    Some(above) => above[1][1] = bottom,
                    None => windows.push([[left, top], [right, bottom]]),
                }
            }
        }
        windows
    }

    /// Draws parts of the picture anew, each with the object as it is there now. Nothing has changed if the work was stopped.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    ///
    /// # Panics
    /// If a window does not begin at a multiple of [`PIECE`] or goes beyond the picture.
    pub fn redraw(&mut self, parts: &[(Window, Thing)], interrupt: &Interrupt) -> Result<Counters, Cancelled> {
        let mut counters = Counters::default();
        let mut patches = Vec::new();
        let lights = Lights::new(&self.camera, self.style.light, self.style.fill);
        let steps = |(window, _): &(Window, Thing)| points(&super::frustum::Frustum::new(self.scene()).within(*window));
        interrupt.begin(2 * parts.iter().map(steps).sum::<u64>());
        for (window, thing) in parts {
            let things = std::slice::from_ref(thing);
            let air = Air::clear(lights);
            let brush = Brush::new(self.scene(), &self.style, things, &air);
            let (painted, cost) = self.part(&brush, thing, *window, interrupt)?;
            counters.add(cost);
            patches.extend(painted);
        }
        interrupt.tick()?;
        patches.into_iter().for_each(|patch| self.put(&patch));
        Ok(counters)
    }

    /// A part of the picture, piece by piece.
    fn part(
        &self,
        brush: &Brush<'_>,
        thing: &Thing,
        window: Window,
        interrupt: &Interrupt,
    ) -> Result<(Vec<Patch>, Counters), Cancelled> {
        let scene = self.scene();
        let pattern = if brush.fine > 1 { Pattern::Corners } else { Pattern::Middles };
        let aim = Aim { pattern, tolerance: TOLERANCE, normals: true };
        let paint = |tile: Tile<'_>| brush.paint(tile.from, tile.size, &[&brush.lit(0, &tile)]);
        let (tiles, mut counters) = search_in(&thing.shape, &scene, window, aim, paint, interrupt)?;
        let mut patches: Vec<Patch> =
            tiles.into_iter().map(|(from, size, painted)| Patch { from, size, painted }).collect();
        if brush.fine > 1 {
            counters.add(self.touch_up(brush, thing, window, &mut patches, interrupt)?);
        }
        Ok((patches, counters))
    }

    /// The pixels of a part that show edges, from more rays.
    fn touch_up(
        &self,
        brush: &Brush<'_>,
        thing: &Thing,
        window: Window,
        patches: &mut [Patch],
        interrupt: &Interrupt,
    ) -> Result<Counters, Cancelled> {
        let width = self.style.size[0];
        let mut edges = vec![false; width * self.style.size[1]];
        for Patch { from, size, painted } in &*patches {
            for (k, pixel) in painted.pixels.iter().enumerate() {
                edges[(from[1] + k / size[0]) * width + from[0] + k % size[0]] = pixel.edge;
            }
        }
        let aim = Aim { pattern: Pattern::Shares(brush.fine, &edges), tolerance: TOLERANCE, normals: true };
        let shares = |tile: Tile<'_>| brush.shares(0, &tile);
        let (tiles, counters) = search_in(&thing.shape, &self.scene(), window, aim, shares, interrupt)?;
        let nothing: Vec<Lit> = vec![None; brush.fine * brush.fine];
        for patch in &mut *patches {
            let Patch { from, size, painted } = patch;
            for (k, pixel) in painted.pixels.iter_mut().enumerate().filter(|(_, pixel)| pixel.edge) {
                pixel.rgba = brush.touch_up(&[&nothing], 0, from[1] + k / size[0]);
            }
        }
        let across = (window[1][0] - window[0][0]).div_ceil(PIECE);
        let mut at = vec![None; across * (window[1][1] - window[0][1]).div_ceil(PIECE)];
        let piece = |[x, y]: [usize; 2]| (y - window[0][1]) / PIECE * across + (x - window[0][0]) / PIECE;
        (0..patches.len()).for_each(|n| at[piece(patches[n].from)] = Some(n));
        for (place, lit) in tiles.into_iter().flat_map(|(.., shares)| shares) {
            let [x, y] = [place % width, place / width];
            let Some(patch) = at[piece([x, y])].and_then(|n| patches.get_mut(n)) else { continue };
            patch.painted.hits += lit.iter().flatten().count() as u64;
            let k = (y - patch.from[1]) * patch.size[0] + x - patch.from[0];
            patch.painted.pixels[k].rgba = brush.touch_up(&[&lit], 0, y);
        }
        Ok(counters)
    }

    fn put(&mut self, patch: &Patch) {
        let Patch { from, size, painted } = patch;
        let across = self.style.size[0].div_ceil(PIECE);
        self.met[from[1] / PIECE * across + from[0] / PIECE] = painted.hits;
        for (k, pixel) in painted.pixels.iter().enumerate() {
            let at = (from[1] + k / size[0]) * self.style.size[0] + from[0] + k % size[0];
            self.image.rgba[4 * at..][..4].copy_from_slice(&pixel.rgba);
            self.edges[at] = pixel.edge;
        }
    }

    /// What the ray through the middle of a pixel meets: the point and the normal there; `None` where it meets nothing.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    ///
    /// # Panics
    /// If the pixel lies outside of the picture.
    pub fn pick(
        &self,
        thing: &Thing,
        pixel: [usize; 2],
        interrupt: &Interrupt,
    ) -> Result<Option<([f64; 3], [f64; 3])>, Cancelled> {
        let scene = self.scene();
        let mut marked = vec![false; scene.rays[0] * scene.rays[1]];
        marked[pixel[1] * scene.rays[0] + pixel[0]] = true;
        let from = pixel.map(|v| v / PIECE * PIECE);
        let window = [from, [0, 1].map(|k| (from[k] + PIECE).min(scene.rays[k]))];
        let aim = Aim { pattern: Pattern::Shares(1, &marked), tolerance: 1e-12, normals: true };
        let first = |tile: Tile<'_>| tile.hits.iter().flatten().next().copied();
        let (tiles, _) = search_in(&thing.shape, &scene, window, aim, first, interrupt)?;
        interrupt.tick()?;
        let hit: Option<Hit> = tiles.into_iter().find_map(|(.., hit)| hit);
        let (start, direction) = scene.through(pixel.map(|v| v as f64 + 0.5));
        let point = |hit: &Hit| {
            std::array::from_fn(|k| {
                (start[k] + hit.depth * direction[k]).clamp(self.space.lo[k], self.space.hi[k])
            })
        };
        Ok(hit.map(|hit| (point(&hit), hit.normal)))
    }
}
