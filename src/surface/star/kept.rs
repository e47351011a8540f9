//! Star solids of half-spaces that change from one mesh to the next, as in a session: what a guide's vertices keep is changed by the
//! difference of the old and the new half-spaces, which takes the same time however many there are: \[A96\], edits. Leaves other gauges to
//! [`folded`].

use std::sync::{Arc, Mutex, PoisonError};

use super::guide::Guide;
use super::{Gauge, folded};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::star::{Row, StarSolid};
use crate::reuse::Digest;
use crate::surface::edit::{Refused, Sculpture, difference};

/// Half-spaces below which an evaluation anew is as good.
const FEW: usize = 16;

/// The gauge in each direction of a guide, if it is a star solid of half-spaces or a fold of many operands, and results of earlier work may be
/// kept. Where the one that was asked for last differs by an edit, that edit is made; the values are then those of a fresh evaluation within
/// 1e-9.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub(super) fn values(gauge: &Gauge, guide: &Guide, interrupt: &Interrupt) -> Result<Option<Vec<f64>>, Cancelled> {
    if let Some(parts) = &gauge.parts {
        return folded::values(parts, &gauge.fixed, guide, interrupt);
    }
    let Some(reaches) = reaches(gauge, guide, interrupt)? else { return Ok(None) };
    Ok(Some(reaches.into_iter().map(|reach| 1.0 / reach).collect()))
}

fn reaches(gauge: &Gauge, guide: &Guide, interrupt: &Interrupt) -> Result<Option<Vec<f64>>, Cancelled> {
    let (Some(reuse), Some(solid)) = (interrupt.reuse(), star(gauge)) else { return Ok(None) };
    if solid.half_spaces() < FEW {
        return Ok(None);
    }
    let mut digest = Digest::of("sculptures");
    guide.directions.iter().for_each(|direction| digest.numbers(direction));
    let key = digest.key();
    if let Some(kept) = reuse.find::<Mutex<Sculpture>>(key) {
        let mut sculpture = kept.lock().unwrap_or_else(PoisonError::into_inner);
        if bring(&mut sculpture, solid, guide, interrupt)? {
            interrupt.kept_edit();
        }
        return Ok(Some(sculpture.reaches().collect()));
    }
    let bytes = guide.directions.len() * Sculpture::bytes_per_vertex() + solid.half_spaces() * size_of::<Row>();
    if !reuse.has_room(bytes) {
        return Ok(None);
    }
    let sculpture = Sculpture::new(solid.clone(), &guide.directions, interrupt)?;
    let reaches = sculpture.reaches().collect();
    reuse.keep(key, Arc::new(Mutex::new(sculpture)), bytes);
    Ok(Some(reaches))
}

/// Makes the sculpture one of this solid; whether an edit was enough.
fn bring(
    sculpture: &mut Sculpture,
    solid: &StarSolid,
    guide: &Guide,
    interrupt: &Interrupt,
) -> Result<bool, Cancelled> {
    if sculpture.solid() == solid {
        return Ok(true);
    }
    let edited = match difference(sculpture.solid(), solid).map(|edit| sculpture.edit(edit, interrupt)) {
        Some(Err(Refused::Cancelled)) => return Err(Cancelled),
        Some(Ok(())) => sculpture.solid() == solid,
        Some(Err(_)) | None => false,
    };
    if !edited {
        *sculpture = Sculpture::new(solid.clone(), &guide.directions, interrupt)?;
    }
    Ok(edited)
}

/// The solid of half-spaces that a gauge of three axes is.
fn star(gauge: &Gauge) -> Option<&StarSolid> {
    let (leaf, arguments) = gauge.gauge.sole_leaf()?;
    leaf.star().filter(|solid| solid.arity == 3 && arguments.iter().copied().eq(0..3))
}
