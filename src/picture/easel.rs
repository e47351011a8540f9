//! A picture that stays while its object is worked on: what a change of the object touches is cast anew, all else is kept. The camera, the
//! space and the light stay as they are. Knows no language, and not what was changed: it is told where.

use std::sync::Arc;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::brush::{Brush, Ground, Lit, Painted};
use super::camera::Camera;
use super::frustum::Frustum;
use super::image::Image;
use super::raycast::{Air, Space, Style, Thing, side};
use super::rays::{Aim, Hit, Met, Pattern, Scene, Seed, Tile, search_in};
use super::screen::{PIECE, Reach, Screen, TILE, Window};
use super::shade::Lights;
use super::shadow::Shadows;
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::boxes::points;
use crate::surface::sampler::Counters;
use crate::vm::Shape;

/// A point of the surface, and the normal there.
pub type PointAndNormal = ([f64; 3], [f64; 3]);

/// An object, and as far as which depth it is known.
type Known = (Shape, f64);

/// What an object is in a piece, as far as a depth at least: what is farther away may be left out.
pub type Shapes<'a, E> = dyn Fn(Window, f64) -> Result<Shape, E> + Sync + 'a;

/// A kept picture of one object.
#[derive(Debug)]
pub struct Easel {
    space: Space,
    camera: Camera,
    style: Style,
    /// The lights, and what they see.
    air: Air,
    ground: Arc<Ground>,
    image: Image,
    /// How many rays met the object in each piece, row by row, and the first and last column and row of those.
    met: Vec<(u64, Option<[[usize; 2]; 2]>)>,
    /// What the rays of each piece met, if that is kept.
    kept: Vec<Option<Arc<Kept>>>,
}

/// A piece of the picture that is drawn but not yet put on it.
struct Piece {
    window: Window,
    /// The object there, once it was needed, and as far as which depth.
    shape: Option<Known>,
    /// Which of its tiles are to be looked at anew.
    touched: Vec<bool>,
    /// What was known of it.
    before: Arc<Kept>,
    met: Met,
    shares: FxHashMap<usize, Vec<Option<Hit>>>,
    painted: Painted,
    /// The first and last column and row that show something.
    seen: Option<[[usize; 2]; 2]>,
    counters: Counters,
}

/// Where the rays of a piece met the object: those through corners or middles, and the further ones of its pixels that show edges.
#[derive(Debug, Default)]
struct Kept {
    met: Met,
    shares: FxHashMap<usize, Vec<Option<Hit>>>,
}

/// How exactly depths are found, as a part of their range: so that it does not show which strokes far inside a search has met, and the same
/// strokes always give the same picture, whatever was made and taken back between.
const EXACT: f64 = 1e-12;

/// Pixels of pictures that keep what all rays met; larger ones look at whole pieces.
const MOST_KEPT: usize = 1 << 22;

impl Easel {
    /// An empty picture: everything is still to be drawn. There is no occlusion, which would reach everywhere.
    #[must_use]
    pub fn new(space: Space, camera: &Camera, style: &Style) -> Self {
        let [width, height] = style.size;
        let lights = Lights::new(camera, style.light, style.fill);
        let shadows = (style.shadow > 0.0).then(|| Shadows::dark(space, lights.key(), side(style)));
        let screen = Screen { camera: *camera, size: style.size, piece: PIECE };
        Self {
            space,
            camera: *camera,
            style: *style,
            air: Air::under(lights, shadows),
            ground: Arc::new(Ground::new(style)),
            image: Image::new(width, height, [0; 3]),
            met: vec![(0, None); screen.pieces().iter().product()],
            kept: vec![None; screen.pieces().iter().product()],
        }
    }

    /// Draws all of an object, with the same program everywhere.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub fn draw(&mut self, thing: &Thing, interrupt: &Interrupt) -> Result<Counters, Cancelled> {
        let shape = |_: Window, _: f64| Ok(thing.shape.clone());
        if let Some(light) = self.light() {
            self.relight::<Cancelled>(&light.windows(&[None]), &shape, f64::INFINITY, interrupt)?;
        }
        let windows = self.screen().windows(&[None]);
        self.redraw::<Cancelled>(&windows, (thing, &shape), (&[None], f64::INFINITY), interrupt)
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
        Scene { camera: self.camera, space: self.space, rays: self.style.size, tile: TILE }
    }

    /// The screen of the picture.
    #[must_use]
    pub fn screen(&self) -> Screen {
        Screen { camera: self.camera, size: self.style.size, piece: PIECE }
    }

    /// What the key light sees, if there are shadows.
    #[must_use]
    pub fn light(&self) -> Option<Screen> {
        self.air.common().map(Shadows::screen)
    }

    /// Looks again from the key light, at pieces of what it sees, each with the object as it is there now. Gives where on the picture the
    /// light may be another one than before; what has changed is at most `extent` deep. If the work was stopped, nothing has changed.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set; what `shape` fails with.
    pub fn relight<E: From<Cancelled> + Send>(
        &mut self,
        windows: &[Window],
        shape: &Shapes<'_, E>,
        extent: f64,
        interrupt: &Interrupt,
    ) -> Result<Vec<Reach>, E> {
        let Some(shadows) = self.air.common() else { return Ok(Vec::new()) };
        let cast = |&window: &Window| {
            let mut far = shadows.deepest(window) + extent;
            loop {
                let patch = shadows.recast(&shape(window, far)?, self.space, window, interrupt)?;
                if far == f64::INFINITY || patch.deepest() <= far {
                    return Ok(patch);
                }
                far = f64::INFINITY;
            }
        };
        let patches: Vec<_> = windows.par_iter().map(cast).collect::<Result<_, E>>()?;
        interrupt.tick()?;
        let screen = self.screen();
        let Some(shadows) = self.air.common_mut() else { return Ok(Vec::new()) };
        let hull = |patch| shadows.put(patch, self.space);
        Ok(patches.into_iter().flat_map(hull).map(|points| screen.hull(&points)).collect())
    }

    /// Draws pieces of the picture anew, each with the object as it is there now: rays are cast where the object itself may have changed,
    /// and all of the pieces are lit again. Nothing has changed if the work was stopped. `look` says how it looks, `shape` what it is in a
    /// piece, as far as a depth at least; that is asked only where rays are cast. What has changed is at the places `changed`, and at most so
    /// deep.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set; what `shape` fails with.
    ///
    /// # Panics
    /// If a window is none of [`Screen::windows`].
    pub fn redraw<E: From<Cancelled> + Send>(
        &mut self,
        windows: &[Window],
        (look, shape): (&Thing, &Shapes<'_, E>),
        changed: (&[Reach], f64),
        interrupt: &Interrupt,
    ) -> Result<Counters, E> {
        let steps = |window: &Window| points(&Frustum::new(self.scene()).within(*window));
        interrupt.begin(2 * windows.iter().map(steps).sum::<u64>());
        let first = |&window: &Window| self.first(window, (look, shape), changed, interrupt);
        let mut pieces: Vec<Piece> = windows.par_iter().map(first).collect::<Result<_, E>>()?;
        if self.style.fine() > 1 {
            let width = self.style.size[0];
            let mut wanted = vec![false; width * self.style.size[1]];
            for piece in &pieces {
                piece.wanted().for_each(|[x, y]| wanted[y * width + x] = true);
            }
            let second = |piece: &mut Piece| self.second(piece, (look, shape), &wanted, interrupt);
            pieces.par_iter_mut().map(second).collect::<Result<Vec<()>, E>>()?;
        }
        interrupt.tick()?;
        let mut counters = Counters::default();
        for piece in pieces {
            self.put(piece, &mut counters);
        }
        Ok(counters)
    }

    /// Where a piece is in the lists of all.
    fn number(&self, [[left, top], _]: Window) -> usize {
        top / PIECE * self.screen().pieces()[0] + left / PIECE
    }

    fn brush<'a>(&'a self, thing: &'a Thing) -> Brush<'a> {
        Brush::on(&self.ground, self.scene(), &self.style, std::slice::from_ref(thing), &self.air)
    }

    /// A piece of the picture from rays through corners or middles.
    fn first<E: From<Cancelled>>(
        &self,
        window: Window,
        (look, shape): (&Thing, &Shapes<'_, E>),
        (changed, extent): (&[Reach], f64),
        interrupt: &Interrupt,
    ) -> Result<Piece, E> {
        let brush = self.brush(look);
        let before = self.kept[self.number(window)].clone();
        let is_new = before.is_none();
        let before = before.unwrap_or_default();
        let touched = tiles(window, if is_new { &[None] } else { changed });
        let pattern = if brush.fine > 1 { Pattern::Corners } else { Pattern::Middles };
        let aim = Aim { pattern, tolerance: EXACT, normals: true };
        let mut made = None;
        let (met, counters) = if touched.contains(&true) {
            let seed = Seed { touched: &touched, hits: &before.met.1 };
            let far = deepest(&before.met.1) + extent;
            let (object, met, counters) = self.cast((window, shape), far, (aim, Some(seed)), interrupt)?;
            made = Some(object);
            (met, counters)
        } else {
            (before.met.clone(), Counters::default())
        };
        let size = size(window);
        let lit = brush.lit(0, &Tile { from: window[0], size, hits: &met.1, places: &met.0 });
        let across = size[0] + usize::from(brush.fine > 1);
        let places = (0..lit.len()).filter(|&k| lit[k].is_some()).map(|k| {
            let place = [k % across, k / across];
            [0, 1].map(|k| window[0][k] + place[k].min(size[k] - 1))
        });
        let seen = places.map(|place| [place, place]).reduce(joined);
        let painted = brush.paint(window[0], size, &[&lit]);
        let shares = FxHashMap::default();
        Ok(Piece { window, shape: made, touched, before, met, shares, painted, seen, counters })
    }

    /// Where the rays of a piece meet the object: at first as far as a depth that is likely to be enough. Also the object as it was used.
    fn cast<E: From<Cancelled>>(
        &self,
        (window, shape): (Window, &Shapes<'_, E>),
        mut far: f64,
        (aim, seed): (Aim<'_>, Option<Seed<'_>>),
        interrupt: &Interrupt,
    ) -> Result<(Known, Met, Counters), E> {
        let mut counters = Counters::default();
        loop {
            let object = shape(window, far)?;
            let (met, cost) = search_in(&object, &self.scene(), window, aim, seed, interrupt)?;
            counters.add(cost);
            if far == f64::INFINITY || deepest(&met.1) <= far {
                return Ok(((object, far), met, counters));
            }
            far = f64::INFINITY;
        }
    }

    /// The pixels of a piece that show edges, from more rays: those of `wanted` are cast, the others are known.
    fn second<E: From<Cancelled>>(
        &self,
        piece: &mut Piece,
        (look, shape): (&Thing, &Shapes<'_, E>),
        wanted: &[bool],
        interrupt: &Interrupt,
    ) -> Result<(), E> {
        let edges: Vec<usize> = piece.edges().collect();
        if edges.is_empty() {
            return Ok(());
        }
        let brush = self.brush(look);
        let (rays, size, from) = (brush.fine * brush.fine, size(piece.window), piece.window[0]);
        if piece.wanted().next().is_some() {
            let known = |window: Window, far: f64| match &piece.shape {
                Some((object, known)) if *known >= far => Ok(object.clone()),
                _ => shape(window, far),
            };
            let far = piece.shape.as_ref().map_or_else(|| deepest(&piece.met.1), |(_, far)| *far);
            let aim = Aim { pattern: Pattern::Shares(brush.fine, wanted), tolerance: EXACT, normals: true };
            let (_, met, cost) = self.cast((piece.window, &known), far, (aim, None), interrupt)?;
            piece.counters.add(cost);
            for (places, hits) in met.0.chunks_exact(rays).zip(met.1.chunks_exact(rays)) {
                let [x, y] = [0, 1].map(|k| places[0][k] as usize - from[k]);
                piece.shares.insert(y * size[0] + x, hits.to_vec());
            }
        }
        let is_wanted = |&k: &usize| wanted[(from[1] + k / size[0]) * self.style.size[0] + from[0] + k % size[0]];
        let nothing: Vec<Lit> = vec![None; rays];
        let (mut places, mut hits) = (Vec::new(), Vec::new());
        for &k in &edges {
            if !is_wanted(&k)
                && let Some(known) = piece.before.shares.get(&k)
            {
                piece.shares.insert(k, known.clone());
            }
            let known = piece.shares.entry(k).or_insert_with(|| vec![None; rays]);
            let [x, y] = [from[0] + k % size[0], from[1] + k / size[0]].map(|v| v as f64);
            let part = |s: usize| (s as f64 + 0.5) / brush.fine as f64;
            places.extend((0..rays).map(|s| [x + part(s % brush.fine), y + part(s / brush.fine)]));
            hits.extend_from_slice(known);
            piece.painted.pixels[k].rgba = brush.touch_up(&[&nothing], 0, from[1] + k / size[0]);
        }
        let shares = brush.shares(0, &Tile { from, size, hits: &hits, places: &places });
        for (place, lit) in shares {
            let [x, y] = [place % self.style.size[0], place / self.style.size[0]];
            piece.painted.hits += lit.iter().flatten().count() as u64;
            piece.painted.pixels[(y - from[1]) * size[0] + x - from[0]].rgba = brush.touch_up(&[&lit], 0, y);
        }
        Ok(())
    }

    fn put(&mut self, piece: Piece, counters: &mut Counters) {
        let number = self.number(piece.window);
        let Piece { window: [from, to], painted, seen, met, shares, .. } = piece;
        counters.add(piece.counters);
        self.met[number] = (painted.hits, seen);
        let across = to[0] - from[0];
        for (k, pixel) in painted.pixels.iter().enumerate() {
            let at = (from[1] + k / across) * self.style.size[0] + from[0] + k % across;
            self.image.rgba[4 * at..][..4].copy_from_slice(&pixel.rgba);
        }
        if self.style.size[0] * self.style.size[1] <= MOST_KEPT {
            self.kept[number] = Some(Arc::new(Kept { met, shares }));
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
    ) -> Result<Option<PointAndNormal>, Cancelled> {
        let scene = self.scene();
        let mut marked = vec![false; scene.rays[0] * scene.rays[1]];
        marked[pixel[1] * scene.rays[0] + pixel[0]] = true;
        let from = pixel.map(|v| v / PIECE * PIECE);
        let window = [from, [0, 1].map(|k| (from[k] + PIECE).min(scene.rays[k]))];
        let aim = Aim { pattern: Pattern::Shares(1, &marked), tolerance: EXACT, normals: true };
        let ((_, hits), _) = search_in(&thing.shape, &scene, window, aim, None, interrupt)?;
        interrupt.tick()?;
        let hit: Option<Hit> = hits.into_iter().flatten().next();
        let (start, direction) = scene.through(pixel.map(|v| v as f64 + 0.5));
        let point = |hit: &Hit| {
            std::array::from_fn(|k| (start[k] + hit.depth * direction[k]).clamp(self.space.lo[k], self.space.hi[k]))
        };
        Ok(hit.map(|hit| (point(&hit), hit.normal)))
    }
}

impl Piece {
    /// Its pixels that show edges, row by row.
    fn edges(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.painted.pixels.len()).filter(|&k| self.painted.pixels[k].edge)
    }

    /// The pixels of the picture that are to be looked at with more rays: all that show edges of each tile that was touched, or of which
    /// one was not looked at before.
    fn wanted(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let ([from, _], size) = (self.window, size(self.window));
        let tile = move |k: usize| k / size[0] / TILE * size[0].div_ceil(TILE) + k % size[0] / TILE;
        let mut wanted = self.touched.clone();
        self.edges().filter(|k| !self.before.shares.contains_key(k)).for_each(|k| wanted[tile(k)] = true);
        let edges = self.edges().filter(move |&k| wanted[tile(k)]);
        edges.map(move |k| [from[0] + k % size[0], from[1] + k / size[0]])
    }
}

fn size([from, to]: Window) -> [usize; 2] {
    [to[0] - from[0], to[1] - from[1]]
}

/// Which tiles of a piece some things may reach into, row by row.
fn tiles(window: Window, reaches: &[Reach]) -> Vec<bool> {
    let [columns, rows] = size(window).map(|n| n.div_ceil(TILE));
    let mut touched = vec![reaches.contains(&None); columns * rows];
    for [least, most] in reaches.iter().flatten() {
        let ends = |k: usize, count: usize| {
            let tile = |v: f64| ((v - window[0][k] as f64) / TILE as f64).floor().clamp(-1.0, count as f64) as isize;
            let [first, last] = [tile(least[k] - 1.5), tile(most[k] + 1.5)];
            first.max(0) as usize..(last + 1).clamp(0, count as isize) as usize
        };
        for row in ends(1, rows) {
            ends(0, columns).for_each(|column| touched[row * columns + column] = true);
        }
    }
    touched
}

/// The depth before which all of some rays hit; none is enough if one of them misses.
fn deepest(hits: &[Option<Hit>]) -> f64 {
    let depth = |hit: &Option<Hit>| hit.map_or(f64::INFINITY, |hit| hit.depth);
    if hits.is_empty() { f64::INFINITY } else { hits.iter().map(depth).fold(f64::NEG_INFINITY, f64::max) }
}

/// The hull of two ranges of pixels.
fn joined(a: [[usize; 2]; 2], b: [[usize; 2]; 2]) -> [[usize; 2]; 2] {
    [[0, 1].map(|k| a[0][k].min(b[0][k])), [0, 1].map(|k| a[1][k].max(b[1][k]))]
}
