//! A picture that stays while its object is worked on: what a change of the object touches is cast anew, all else is kept. The camera, the
//! space and the light stay as they are. Knows no language, and not what was changed: it is told where.

use rayon::prelude::*;

use super::brush::{Brush, Lit, Painted};
use super::camera::Camera;
use super::frustum::Frustum;
use super::image::Image;
use super::raycast::{Air, Space, Style, TOLERANCE, Thing, side};
use super::rays::{Aim, Hit, Pattern, Scene, Tile, search_in};
use super::screen::{PIECE, Reach, Screen, Window};
use super::shade::Lights;
use super::shadow::Shadows;
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::boxes::points;
use crate::surface::sampler::Counters;
use crate::vm::Shape;

/// A kept picture of one object.
#[derive(Debug)]
pub struct Easel {
    space: Space,
    camera: Camera,
    style: Style,
    /// The lights, and what they see.
    air: Air,
    image: Image,
    /// How many rays met the object in each piece, row by row, and the first and last column and row of those.
    met: Vec<(u64, Option<[[usize; 2]; 2]>)>,
}

/// What is painted but not yet on the picture.
struct Patch {
    from: [usize; 2],
    size: [usize; 2],
    painted: Painted,
    /// The first and last column and row that show something.
    seen: Option<[[usize; 2]; 2]>,
}

impl Easel {
    /// An empty picture: everything is still to be drawn. There is no occlusion, which would reach everywhere.
    #[must_use]
    pub fn new(space: Space, camera: &Camera, style: &Style) -> Self {
        let [width, height] = style.size;
        let lights = Lights::new(camera, style.light, style.fill);
        let shadows = (style.shadow > 0.0).then(|| Shadows::dark(space, lights.key(), side(style)));
        let screen = Screen { camera: *camera, size: style.size };
        Self {
            space,
            camera: *camera,
            style: *style,
            air: Air::under(lights, shadows),
            image: Image::new(width, height, [0; 3]),
            met: vec![(0, None); screen.pieces().iter().product()],
        }
    }

    /// Draws all of an object, with the same program everywhere.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn draw(&mut self, thing: &Thing, interrupt: &Interrupt) -> Result<Counters, Cancelled> {
        if let Some(light) = self.light() {
            let parts: Vec<_> =
                light.windows(&[None]).into_iter().map(|window| (window, thing.shape.clone())).collect();
            self.relight(&parts, interrupt)?;
        }
        let windows = self.screen().windows(&[None]);
        let parts: Vec<_> = windows.into_iter().map(|window| (window, thing.clone())).collect();
        self.redraw(&parts, interrupt)
    }

    /// The picture.
    #[must_use]
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// Rays that meet the object.
    #[must_use]
    pub fn hits(&self) -> u64 {
        self.met.iter().map(|met| met.0).sum()
    }

    /// The first and the last column and row in which the object is seen; `None` if it is nowhere.
    #[must_use]
    pub fn seen(&self) -> Option<[[usize; 2]; 2]> {
        self.met.iter().filter_map(|met| met.1).reduce(joined)
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

    /// The screen of the picture.
    #[must_use]
    pub fn screen(&self) -> Screen {
        Screen { camera: self.camera, size: self.style.size }
    }

    /// What the key light sees, if there are shadows.
    #[must_use]
    pub fn light(&self) -> Option<Screen> {
        self.air.common().map(Shadows::screen)
    }

    /// Looks again from the key light, at parts of what it sees, each with the object as it is there now. Gives where on the picture the
    /// light is another one than before. If the work was stopped, nothing has changed.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn relight(&mut self, parts: &[(Window, Shape)], interrupt: &Interrupt) -> Result<Vec<Reach>, Cancelled> {
        let Some(shadows) = self.air.common() else { return Ok(Vec::new()) };
        let cast = |(window, shape): &(Window, Shape)| shadows.recast(shape, self.space, *window, interrupt);
        let patches: Vec<_> = parts.par_iter().map(cast).collect::<Result<_, Cancelled>>()?;
        interrupt.tick()?;
        let screen = self.screen();
        let Some(shadows) = self.air.common_mut() else { return Ok(Vec::new()) };
        let hull = |patch| shadows.put(patch, self.space);
        Ok(patches.into_iter().flatten().filter_map(hull).map(|points| screen.hull(&points)).collect())
    }

    /// Draws pieces of the picture anew, each with the object as it is there now. Nothing has changed if the work was stopped.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    ///
    /// # Panics
    /// If a window is none of [`Screen::windows`].
    pub fn redraw(&mut self, parts: &[(Window, Thing)], interrupt: &Interrupt) -> Result<Counters, Cancelled> {
        let steps = |(window, _): &(Window, Thing)| points(&Frustum::new(self.scene()).within(*window));
        interrupt.begin(2 * parts.iter().map(steps).sum::<u64>());
        let mut done: Vec<(Vec<Patch>, Counters)> =
            parts.par_iter().map(|part| self.first(part, interrupt)).collect::<Result<_, Cancelled>>()?;
        if self.style.fine() > 1 {
            let width = self.style.size[0];
            let mut edges = vec![false; width * self.style.size[1]];
            for Patch { from, size, painted, .. } in done.iter().flat_map(|part| &part.0) {
                for (k, pixel) in painted.pixels.iter().enumerate() {
                    edges[(from[1] + k / size[0]) * width + from[0] + k % size[0]] = pixel.edge;
                }
            }
            let finish = |((patches, counters), part): (&mut (Vec<Patch>, Counters), &(Window, Thing))| {
                counters.add(self.second(part, &edges, patches, interrupt)?);
                Ok(())
            };
            done.par_iter_mut().zip(parts).map(finish).collect::<Result<Vec<()>, Cancelled>>()?;
        }
        interrupt.tick()?;
        let mut counters = Counters::default();
        for (patches, cost) in done {
            counters.add(cost);
            patches.iter().for_each(|patch| self.put(patch));
        }
        Ok(counters)
    }

    /// A part of the picture from rays through corners or middles, piece by piece.
    fn first(
        &self,
        (window, thing): &(Window, Thing),
        interrupt: &Interrupt,
    ) -> Result<(Vec<Patch>, Counters), Cancelled> {
        let brush = Brush::new(self.scene(), &self.style, std::slice::from_ref(thing), &self.air);
        let pattern = if brush.fine > 1 { Pattern::Corners } else { Pattern::Middles };
        let aim = Aim { pattern, tolerance: TOLERANCE, normals: true };
        let paint = |tile: Tile<'_>| {
            let lit = brush.lit(0, &tile);
            let across = tile.size[0] + usize::from(brush.fine > 1);
            let places = lit.iter().enumerate().filter(|(_, lit)| lit.is_some()).map(|(k, _)| {
                let place = [tile.from[0] + k % across, tile.from[1] + k / across];
                [0, 1].map(|k| place[k].min(tile.from[k] + tile.size[k] - 1))
            });
            let seen = places.map(|place| [place, place]).reduce(joined);
            (brush.paint(tile.from, tile.size, &[&lit]), seen)
        };
        let (tiles, counters) = search_in(&thing.shape, &self.scene(), *window, aim, paint, interrupt)?;
        let patch = |(from, size, (painted, seen))| Patch { from, size, painted, seen };
        Ok((tiles.into_iter().map(patch).collect(), counters))
    }

    /// The pixels of a part that show edges, from more rays.
    fn second(
        &self,
        (window, thing): &(Window, Thing),
        edges: &[bool],
        patches: &mut [Patch],
        interrupt: &Interrupt,
    ) -> Result<Counters, Cancelled> {
        if patches.iter().all(|patch| patch.painted.pixels.iter().all(|pixel| !pixel.edge)) {
            return Ok(Counters::default());
        }
        let brush = Brush::new(self.scene(), &self.style, std::slice::from_ref(thing), &self.air);
        let aim = Aim { pattern: Pattern::Shares(brush.fine, edges), tolerance: TOLERANCE, normals: true };
        let shares = |tile: Tile<'_>| brush.shares(0, &tile);
        let (tiles, counters) = search_in(&thing.shape, &self.scene(), *window, aim, shares, interrupt)?;
        let nothing: Vec<Lit> = vec![None; brush.fine * brush.fine];
        for Patch { from, size, painted, .. } in &mut *patches {
            for (k, pixel) in painted.pixels.iter_mut().enumerate().filter(|(_, pixel)| pixel.edge) {
                pixel.rgba = brush.touch_up(&[&nothing], 0, from[1] + k / size[0]);
            }
        }
        let width = self.style.size[0];
        for (place, lit) in tiles.into_iter().flat_map(|(.., shares)| shares) {
            let at = [place % width, place / width];
            let holds =
                |patch: &&mut Patch| (0..2).all(|k| (patch.from[k]..patch.from[k] + patch.size[k]).contains(&at[k]));
            let Some(patch) = patches.iter_mut().find(holds) else { continue };
            patch.painted.hits += lit.iter().flatten().count() as u64;
            let k = (at[1] - patch.from[1]) * patch.size[0] + at[0] - patch.from[0];
            patch.painted.pixels[k].rgba = brush.touch_up(&[&lit], 0, at[1]);
        }
        Ok(counters)
    }

    fn put(&mut self, patch: &Patch) {
        let Patch { from, size, painted, seen } = patch;
        let piece = from[1] / PIECE * self.screen().pieces()[0] + from[0] / PIECE;
        self.met[piece] = (painted.hits, *seen);
        for (k, pixel) in painted.pixels.iter().enumerate() {
            let at = (from[1] + k / size[0]) * self.style.size[0] + from[0] + k % size[0];
            self.image.rgba[4 * at..][..4].copy_from_slice(&pixel.rgba);
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
            std::array::from_fn(|k| (start[k] + hit.depth * direction[k]).clamp(self.space.lo[k], self.space.hi[k]))
        };
        Ok(hit.map(|hit| (point(&hit), hit.normal)))
    }
}

/// The hull of two ranges of pixels.
fn joined(a: [[usize; 2]; 2], b: [[usize; 2]; 2]) -> [[usize; 2]; 2] {
    [[0, 1].map(|k| a[0][k].min(b[0][k])), [0, 1].map(|k| a[1][k].max(b[1][k]))]
}
