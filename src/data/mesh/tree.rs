//! A tree of boxes over triangles, four children a node. Built once, the same for the same triangles; knows boxes only.

use std::cmp::Ordering;

use super::error::MeshError;
use super::vector::V;
use crate::interrupt::Interrupt;

/// Triangles at the end of a branch, at most.
const FEW: usize = 4;
/// Places where a box may be cut, along each axis.
const BINS: usize = 12;
/// Levels after which boxes are cut in equal halves, whatever it costs, so that no tree is deep.
const UNEVEN: usize = 24;
/// What a walk may have waiting: three of each level's four children.
pub(super) const WAITING: usize = 160;

/// A child that is a node has its number; one that holds triangles has this bit, their number and the first one.
const LEAF: u32 = 1 << 31;

/// The boxes of four children; those that are missing are empty.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) lo: [[f64; 4]; 3],
    pub(super) hi: [[f64; 4]; 3],
    pub(super) child: [Child; 4],
}

/// What a child is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Child {
    first: u32,
    count: u32,
}

impl Child {
    const NONE: Self = Self { first: 0, count: LEAF };

    /// The first of the triangles that it holds and how many, or the node that it is.
    #[inline(always)]
    pub(super) fn kind(self) -> Result<(u32, u32), usize> {
        if self.count & LEAF == 0 { Err(self.first as usize) } else { Ok((self.first, self.count & !LEAF)) }
    }
}

/// An axis-parallel box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub(super) lo: V,
    pub(super) hi: V,
}

impl Bounds {
    pub(super) const NONE: Self = Self { lo: [f64::INFINITY; 3], hi: [f64::NEG_INFINITY; 3] };

    pub(super) fn add(&mut self, p: V) {
        for ((lo, hi), p) in self.lo.iter_mut().zip(&mut self.hi).zip(p) {
            (*lo, *hi) = (lo.min(p), hi.max(p));
        }
    }

    fn join(&mut self, other: &Self) {
        self.add(other.lo);
        self.add(other.hi);
    }

    fn area(&self) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|k| (self.hi[k] - self.lo[k]).max(0.0));
        x * y + y * z + z * x
    }
}

/// The tree; its root is node 0.
#[derive(Debug)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
}

/// What is known of a triangle while the tree is built.
#[derive(Clone, Copy)]
pub(super) struct Item {
    pub(super) number: u32,
    bounds: Bounds,
    middle: V,
}

impl Tree {
    /// The tree of these triangles, and the order in which it wants them.
    pub(super) fn new(corners: &[[V; 3]], interrupt: &Interrupt) -> Result<(Self, Vec<u32>), MeshError> {
        let item = |(number, t): (u32, &[V; 3])| {
            let mut bounds = Bounds::NONE;
            t.iter().for_each(|p| bounds.add(*p));
            let middle = std::array::from_fn(|k| 0.5 * (bounds.lo[k] + bounds.hi[k]));
            Item { number, bounds, middle }
        };
        let mut items: Vec<Item> = (0u32..).zip(corners).map(item).collect();
        let mut nodes = Vec::new();
        build(&mut items, 0, 0, &mut nodes, interrupt)?;
        Ok((Self { nodes }, items.iter().map(|item| item.number).collect()))
    }
}

fn build(
    items: &mut [Item],
    start: usize,
    depth: usize,
    nodes: &mut Vec<Node>,
    interrupt: &Interrupt,
) -> Result<u32, MeshError> {
    interrupt.tick()?;
    let own = nodes.len();
    nodes.push(Node { lo: [[f64::INFINITY; 4]; 3], hi: [[f64::NEG_INFINITY; 4]; 3], child: [Child::NONE; 4] });
    // Two cuts in two make four parts; a part that is few enough stays whole.
    let even = depth >= UNEVEN;
    let half = if items.len() > FEW { cut(items, even) } else { items.len() };
    let mut parts = Vec::with_capacity(4);
    for (from, to) in [(0, half), (half, items.len())] {
        let quarter = if to - from > FEW { from + cut(&mut items[from..to], even) } else { to };
        parts.extend([(from, quarter), (quarter, to)].into_iter().filter(|(from, to)| from < to));
    }
    for (k, (from, to)) in parts.into_iter().enumerate() {
        let mut bounds = Bounds::NONE;
        items[from..to].iter().for_each(|item| bounds.join(&item.bounds));
        for axis in 0..3 {
            nodes[own].lo[axis][k] = bounds.lo[axis];
            nodes[own].hi[axis][k] = bounds.hi[axis];
        }
        nodes[own].child[k] = if to - from <= FEW {
            Child { first: (start + from) as u32, count: LEAF | (to - from) as u32 }
        } else {
            Child { first: build(&mut items[from..to], start + from, depth + 1, nodes, interrupt)?, count: 0 }
        };
    }
    Ok(own as u32)
}

/// Orders the items so that two parts are near in themselves; where the second begins. Both have at least one item.
fn cut(items: &mut [Item], even: bool) -> usize {
    let mut about = Bounds::NONE;
    items.iter().for_each(|item| about.add(item.middle));
    let wide = |k: usize| about.hi[k] - about.lo[k];
    let axis = (0..3).fold(0, |best, k| if wide(k) > wide(best) { k } else { best });
    if !even && let Some((axis, at)) = cheapest(items, &about) {
        let mut low = 0;
        for i in 0..items.len() {
            if bin(items[i].middle[axis], &about, axis) < at {
                items.swap(i, low);
                low += 1;
            }
        }
        if low > 0 && low < items.len() {
            return low;
        }
    }
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |a, b| a.middle[axis].total_cmp(&b.middle[axis]).then(a.number.cmp(&b.number)));
    half
}

fn bin(at: f64, about: &Bounds, axis: usize) -> usize {
    let part = (at - about.lo[axis]) / (about.hi[axis] - about.lo[axis]);
    ((part * BINS as f64) as usize).min(BINS - 1)
}

/// The axis and the bin at which to cut, so that the areas of the two boxes, each times the triangles in it, are least.
fn cheapest(items: &[Item], about: &Bounds) -> Option<(usize, usize)> {
    let mut best: Option<(f64, usize, usize)> = None;
    for axis in 0..3 {
        if about.hi[axis].partial_cmp(&about.lo[axis]) != Some(Ordering::Greater) {
            continue;
        }
        let mut bins = [(Bounds::NONE, 0usize); BINS];
        for item in items {
            let (bounds, count) = &mut bins[bin(item.middle[axis], about, axis)];
            bounds.join(&item.bounds);
            *count += 1;
        }
        let mut above = [0.0; BINS];
        let (mut bounds, mut count) = (Bounds::NONE, 0);
        for at in (1..BINS).rev() {
            bounds.join(&bins[at].0);
            count += bins[at].1;
            above[at] = if count == 0 { 0.0 } else { bounds.area() * count as f64 };
        }
        (bounds, count) = (Bounds::NONE, 0);
        for at in 1..BINS {
            bounds.join(&bins[at - 1].0);
            count += bins[at - 1].1;
            if count == 0 || count == items.len() {
                continue;
            }
            let cost = bounds.area() * count as f64 + above[at];
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, at));
            }
        }
    }
    best.map(|(_, axis, at)| (axis, at))
}
