//! Rays that are cast by a search, whatever the object is: into the whole picture, or into a part of it. Knows no light.

use super::{Aim, Caster, Frustum, Hit, Scene, Tile, Tiles};
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::boxes::{Block, walk_on};
use crate::surface::sampler::Counters;
use crate::vm::Shape;

/// Casts the rays that are wanted by a search, whatever the object is, as a part of a task whose progress was begun already.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn search_on<T: Send>(
    shape: &Shape,
    scene: &Scene,
    aim: Aim<'_>,
    finish: impl Fn(Tile<'_>) -> T + Sync,
    interrupt: &Interrupt,
) -> Result<Tiles<T>, Cancelled> {
    let frustum = Frustum::new(*scene);
    let keeps = interrupt.reuse().is_some();
    let visitor = |block: &Block| Caster::new(&frustum, (shape, aim), block, &finish, keeps);
    let done = walk_on(&frustum, shape, visitor, interrupt)?;
    let tiles = done.visitors.into_iter().filter_map(|caster| Some((caster.from, caster.size, caster.result?)));
    Ok((tiles.collect(), done.counters))
}

/// What is known of the rays through a part of a picture: their hits, row by row, and which of the smallest tiles, row by row, are to be
/// looked at anew.
#[derive(Clone, Copy, Debug)]
pub struct Seed<'a> {
    /// The tiles.
    pub touched: &'a [bool],
    /// The hits of all rays; none at all if nothing is known.
    pub hits: &'a [Option<Hit>],
}

/// Where the rays through a part of the picture meet the object, and their places: from a first column and row, multiples of a tile, to one
/// past the last ones, at most four tiles farther. They are those of the whole picture, to the bit, if the shape is the same there. Nothing
/// of it is kept for another time.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn search_in(
    shape: &Shape,
    scene: &Scene,
    window: [[usize; 2]; 2],
    aim: Aim<'_>,
    seed: Option<Seed<'_>>,
    interrupt: &Interrupt,
) -> Result<(Met, Counters), Cancelled> {
    let frustum = Frustum::new(*scene).within(window);
    let finish = |tile: Tile<'_>| (tile.places.to_vec(), tile.hits.to_vec());
    let visitor = |block: &Block| {
        let mut caster = Caster::new(&frustum, (shape, aim), block, &finish, false);
        caster.seed = seed;
        caster
    };
    let done = walk_on(&frustum, shape, visitor, interrupt)?;
    let met = done.visitors.into_iter().find_map(|caster| caster.result);
    Ok((met.unwrap_or_default(), done.counters))
}

/// The places of rays and what each of them meets; nothing at all if none meets anything.
pub type Met = (Vec<[f64; 2]>, Vec<Option<Hit>>);
