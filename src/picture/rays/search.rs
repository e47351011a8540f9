//! Rays that are cast by a search, whatever the object is: into the whole picture, or into a part of it. Knows no light.

use super::{Aim, Caster, Frustum, Scene, Tile, Tiles};
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::boxes::{Block, walk_on};
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
    search_in(shape, scene, [[0; 2], scene.rays], aim, finish, interrupt)
}

/// The same in a part of the picture alone: from a first column and row, multiples of four tiles, to one past the last ones. Its hits are
/// those of the whole picture, to the bit, if the shape is the same there.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn search_in<T: Send>(
    shape: &Shape,
    scene: &Scene,
    window: [[usize; 2]; 2],
    aim: Aim<'_>,
    finish: impl Fn(Tile<'_>) -> T + Sync,
    interrupt: &Interrupt,
) -> Result<Tiles<T>, Cancelled> {
    let frustum = Frustum::new(*scene).within(window);
    let keeps = interrupt.reuse().is_some();
    let visitor = |block: &Block| Caster::new(&frustum, (shape, aim), block, &finish, keeps);
    let done = walk_on(&frustum, shape, visitor, interrupt)?;
    let tiles = done.visitors.into_iter().filter_map(|caster| Some((caster.from, caster.size, caster.result?)));
    Ok((tiles.collect(), done.counters))
}
