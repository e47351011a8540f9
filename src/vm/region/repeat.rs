//! Loops over blocks: the lanes whose condition holds take another turn, moved together so that none is computed in vain. A lane that
//! takes too many turns is undefined.

use super::super::interval::Ranges;
use super::super::kernels::Kind;
use super::{Body, Pointwise, RegionStore, copy, room};
use crate::number::Interval;
use crate::number::turns::Turns;

/// Runs a loop at the points of the first lanes: the turns that they took together, and how many took too many.
pub(super) fn points<K: Pointwise>(
    body: &Body,
    states: usize,
    limit: usize,
    store: &mut RegionStore<K>,
    lanes: usize,
) -> (u64, u64) {
    begin(body, states, store, lanes);
    let (mut active, mut taken, mut endless) = (lanes, 0, 0);
    for turn in 0.. {
        store.run(&body.program, active);
        let condition = store.inner.of(&body.program, body.roots[0]);
        store.going.clear();
        for i in 0..active {
            let holds = K::number(K::get(condition, i));
            if holds != 0.0 && !holds.is_nan() {
                store.going.push(i);
                continue;
            }
            for state in 0..states {
                let value = K::get(store.inner.of(&body.program, state as u32), i);
                K::set(&mut store.outputs[state], store.places[i], value);
            }
        }
        let cancelled = store.inner.interrupt.is_cancelled();
        if turn == limit || (cancelled && !store.going.is_empty()) {
            endless = if cancelled { 0 } else { store.going.len() as u64 };
            for &i in &store.going {
                for state in 0..states {
                    K::set(&mut store.outputs[state], store.places[i], K::constant(f64::NAN));
                }
            }
            break;
        }
        if store.going.is_empty() {
            break;
        }
        for state in 0..states {
            let next = store.inner.of(&body.program, body.roots[state + 1]);
            for (j, &i) in store.going.iter().enumerate() {
                K::set(&mut store.held[state], j, K::get(next, i));
            }
        }
        active = advance(body, store, states, active);
        taken += active as u64;
    }
    (taken, endless)
}

/// Puts the arguments into the inner inputs.
fn begin<K: Kind>(body: &Body, states: usize, store: &mut RegionStore<K>, lanes: usize) {
    store.inner.reserve(&body.program);
    room::<K>(&mut store.outputs, states);
    room::<K>(&mut store.held, states);
    for input in 0..body.program.inputs().len() {
        copy::<K>(&store.given[input], store.inner.input(input), lanes);
    }
    store.places.clear();
    store.places.extend(0..lanes);
}

/// Moves the lanes that go on to the front, with the next values that are held for them; their number.
fn advance<K: Kind>(body: &Body, store: &mut RegionStore<K>, states: usize, active: usize) -> usize {
    let count = store.going.len();
    for state in 0..states {
        copy::<K>(&store.held[state], store.inner.input(state), count);
    }
    if count < active {
        for input in states..body.program.inputs().len() {
            let block = store.inner.input(input);
            for (j, &i) in store.going.iter().enumerate() {
                let item = K::get(block, i);
                K::set(block, j, item);
            }
        }
        for (j, &i) in store.going.iter().enumerate() {
            store.places[j] = store.places[i];
        }
    }
    count
}

/// Bounds the outputs of a loop over the boxes of the first lanes.
pub(super) fn ranges(
    body: &Body,
    (states, guards): (usize, &[Option<(usize, Interval)>]),
    limit: usize,
    store: &mut RegionStore<Ranges>,
    lanes: usize,
) {
    begin(body, states, store, lanes);
    store.turns.resize_with(lanes.max(store.turns.len()), Turns::default);
    store.turns[..lanes].iter_mut().for_each(|t| t.begin(states));
    let mut active = lanes;
    for turn in 0.. {
        store.run(&body.program, active);
        store.going.clear();
        let cancelled = store.inner.interrupt.is_cancelled();
        let value = |i: usize, root: u32| Ranges::get(store.inner.of(&body.program, root), i);
        for i in 0..active {
            let turns = &mut store.turns[store.places[i]];
            let parts = guards.iter().zip(&body.roots[states + 1..]).map(|(known, root)| (value(i, *root), *known));
            if !turns.goes_on(value(i, body.roots[0]), parts, |state| value(i, state as u32)) {
                continue;
            }
            if turn == limit || cancelled {
                turns.give_up();
                continue;
            }
            let (joins, j) = (turns.joins(), store.going.len());
            let mut moves = !joins;
            for state in 0..states {
                let (old, mut next) = (value(i, state as u32), value(i, body.roots[state + 1]));
                if joins {
                    next = Turns::joined(old, next);
                    moves |= next != old;
                }
                Ranges::set(&mut store.held[state], j, next);
            }
            if moves {
                store.going.push(i);
            } else {
                turns.give_up();
            }
        }
        if store.going.is_empty() {
            break;
        }
        active = advance(body, store, states, active);
    }
    for (lane, turns) in store.turns[..lanes].iter().enumerate() {
        for (output, result) in store.outputs.iter_mut().zip(&turns.result) {
            Ranges::set(output, lane, *result);
        }
    }
}
