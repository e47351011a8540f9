//! Objects of one coordinate: the intervals that they consist of. Splits the range by interval arithmetic, so that nothing is overlooked.

use super::estimate::Estimate;
use super::sampler::{Counters, Sampler};
use crate::interrupt::{Cancelled, Interrupt};
use crate::number::Interval;
use crate::vm::Shape;
use crate::vm::interval::{Boxes, LANES};

/// Times that the range is halved at most.
const DEPTH: u32 = 40;
/// Pieces that may wait to be decided; when there are more, those that are left are decided by a point each.
const MOST: usize = 1 << 16;

/// An object of one coordinate.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// Its intervals, in order.
    pub intervals: Vec<[f64; 2]>,
    /// Their lengths together; the error is a bound, but for intervals in pieces that no point and no interval decided.
    pub length: Estimate,
    /// Whether it goes on beyond the ends of the range.
    pub cut: [bool; 2],
    /// What it cost.
    pub counters: Counters,
}

/// A piece of the range: its ends, and whether it is inside, once that is known.
#[derive(Clone, Copy)]
struct Piece {
    from: f64,
    to: f64,
    inside: Option<bool>,
}

/// Finds the intervals of a 1-D shape in a range.
///
/// # Errors
/// [`Cancelled`] soon after the interrupt was set.
pub fn intervals(shape: &Shape, [lo, hi]: [f64; 2], interrupt: &Interrupt) -> Result<Line, Cancelled> {
    let mut counters = Counters::default();
    let mut pieces = vec![Piece { from: lo, to: hi, inside: None }];
    let mut boxes = Boxes::heeding(interrupt);
    for _ in 0..DEPTH {
        interrupt.tick()?;
        let open = pieces.iter().filter(|piece| piece.inside.is_none()).count();
        if open == 0 || open > MOST {
            break;
        }
        pieces = pieces.iter().flat_map(halves).collect();
        let open: Vec<usize> = (0..pieces.len()).filter(|&i| pieces[i].inside.is_none()).collect();
        for some in open.chunks(LANES) {
            for (&i, value) in some.iter().zip(bounds(shape, &pieces, some, &mut boxes)) {
                pieces[i].inside = match value {
                    value if value.is_empty() || value.is_negative() => Some(false),
                    value if value.is_positive() => Some(true),
                    _ => None,
                };
            }
        }
        counters.boxes += open.len() as u64;
        pieces = merged(&pieces);
    }
    let unknown: f64 = pieces.iter().filter(|p| p.inside.is_none()).map(|p| p.to - p.from).sum();
    decide(shape, &mut pieces, &mut counters, interrupt);
    interrupt.tick()?;
    let inside: Vec<[f64; 2]> =
        merged(&pieces).iter().filter(|p| p.inside == Some(true)).map(|p| [p.from, p.to]).collect();
    let value = inside.iter().map(|[from, to]| to - from).sum();
    let cut = [inside.first().is_some_and(|i| i[0] == lo), inside.last().is_some_and(|i| i[1] == hi)];
    let error = unknown + 4.0 * f64::EPSILON * lo.abs().max(hi.abs());
    Ok(Line { intervals: inside, length: Estimate { value, error }, cut, counters })
}

fn halves(piece: &Piece) -> Vec<Piece> {
    let middle = 0.5 * piece.from + 0.5 * piece.to;
    if piece.inside.is_some() || middle <= piece.from || middle >= piece.to {
        return vec![*piece];
    }
    vec![Piece { to: middle, ..*piece }, Piece { from: middle, ..*piece }]
}

fn bounds(shape: &Shape, pieces: &[Piece], some: &[usize], boxes: &mut Boxes) -> Vec<Interval> {
    let mut inputs = vec![some.iter().map(|&i| Interval::new(pieces[i].from, pieces[i].to)).collect::<Vec<_>>()];
    inputs.extend(shape.fixed.iter().map(|&value| vec![Interval::point(value); some.len()]));
    let slices: Vec<&[Interval]> = inputs.iter().map(Vec::as_slice).collect();
    let mut values = vec![Interval::EMPTY; some.len()];
    boxes.eval(&shape.program, &slices, &mut values);
    values
}

/// Neighbours of one kind as one piece.
fn merged(pieces: &[Piece]) -> Vec<Piece> {
    let mut all: Vec<Piece> = Vec::with_capacity(pieces.len());
    for piece in pieces {
        match all.last_mut() {
            Some(last) if last.inside.is_some() && last.inside == piece.inside => last.to = piece.to,
            _ => all.push(*piece),
        }
    }
    all
}

/// Decides what intervals left open by the middle of each piece.
fn decide(shape: &Shape, pieces: &mut [Piece], counters: &mut Counters, interrupt: &Interrupt) {
    let open: Vec<usize> = (0..pieces.len()).filter(|&i| pieces[i].inside.is_none()).collect();
    let middles: Vec<f64> = open.iter().map(|&i| 0.5 * pieces[i].from + 0.5 * pieces[i].to).collect();
    let mut values = vec![0.0; open.len()];
    let mut sampler = Sampler::new(shape).heeding(interrupt);
    sampler.values(&shape.program, &[&middles], &mut values);
    for (&i, value) in open.iter().zip(values) {
        pieces[i].inside = Some(value >= 0.0);
    }
    counters.add(sampler.take_counters());
}
