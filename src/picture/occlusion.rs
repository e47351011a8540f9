//! How much of the sky is seen from points of a scene: what parallel light from many sides reaches, each side found once for the whole
//! picture. The sides are fixed, so that the same scene always looks the same.

use super::raycast::{Space, Style, Thing};
use super::shadow::Shadows;
use crate::interrupt::{Cancelled, Interrupt};
use crate::surface::sampler::Counters;

/// Sides from which light comes, evenly all around.
const SIDES: usize = 40;

/// The part of the light that reaches every place.
const THROWN: f32 = 0.25;

/// The depths that each side sees first.
#[derive(Debug)]
pub(super) struct Occlusion {
    sides: Vec<([f64; 3], Shadows)>,
}

impl Occlusion {
    /// Looks at the opaque objects from all sides, as a part of a task whose progress was begun already. Also what that cost.
    ///
    /// # Errors
    /// [`Cancelled`] soon after the interrupt was set.
    pub(super) fn cast(
        things: &[Thing],
        space: Space,
        style: &Style,
        interrupt: &Interrupt,
    ) -> Result<(Self, Counters), Cancelled> {
        let (mut sides, mut counters) = (Vec::new(), Counters::default());
        for side in (0..SIDES).map(direction) {
            let mut seen: Option<Shadows> = None;
            for thing in things.iter().filter(|thing| thing.is_opaque()) {
                let (depths, cost) = Shadows::cast(&thing.shape, space, side, rays(style), interrupt)?;
                counters.add(cost);
                match &mut seen {
                    Some(seen) => seen.join(&depths),
                    None => seen = Some(depths),
                }
            }
            sides.extend(seen.map(|seen| (side, seen)));
        }
        Ok((Self { sides }, counters))
    }

    /// What casting advances the progress by.
    pub(super) fn steps(things: &[Thing], space: Space, style: &Style) -> u64 {
        if !style.occlusion {
            return 0;
        }
        let opaque = things.iter().filter(|thing| thing.is_opaque()).count() as u64;
        let steps: u64 = (0..SIDES).map(|k| Shadows::scene(space, direction(k), rays(style)).steps()).sum();
        opaque * steps
    }

    /// The part of the light of an even sky that reaches a point of a boundary with that normal, 0 to 1.
    pub(super) fn open(&self, point: [f64; 3], normal: [f64; 3]) -> f32 {
        let (mut reached, mut all) = (0.0_f32, 0.0_f32);
        for (side, depths) in &self.sides {
            let facing: f64 = (0..3).map(|k| side[k] * normal[k]).sum();
            // What grazes the boundary tells more of the grid of rays than of the object.
            if facing > 0.1 {
                all += facing as f32;
                reached += facing as f32 * depths.lit(point, normal, facing);
            }
        }
        // The deepest hollow still gets what the faces about it throw back.
        if all > 0.0 { THROWN + (1.0 - THROWN) * reached / all } else { 1.0 }
    }
}

/// Rays along each side of the square that a side looks through.
fn rays(style: &Style) -> usize {
    (style.size[0].max(style.size[1]) / 3).clamp(96, 320)
}

/// Points spread evenly over the unit sphere along a spiral, by the golden section.
fn direction(k: usize) -> [f64; 3] {
    let height = 1.0 - (2.0 * k as f64 + 1.0) / SIDES as f64;
    let (radius, angle) = ((1.0 - height * height).sqrt(), 2.399_963_229_728_653 * k as f64);
    [radius * libm::cos(angle), radius * libm::sin(angle), height]
}
