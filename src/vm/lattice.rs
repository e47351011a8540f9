//! Values on a lattice of points: every combination of the numbers on its axes. What depends on some of the axes only is computed once for
//! those, not at every point; the bits are those of [`Points::eval`] at the same points.
//!
//! The first axes are laid out in a block of lanes, as many as fit; the others are walked through. An operation that no walked axis moves
//! runs once for all; one that walked axes alone move runs over those, and enters the others as a number; one that the fastest walked
//! axis does not move runs when a slower one steps; only the rest runs at every step.

mod plan;

use super::block::{Points, Scalar};
use super::kernels::{Code, Kind, Store};
use super::program::Program;
use plan::{Plan, Stage};

/// What evaluation on lattices needs besides the blocks of points.
pub(super) struct Walked<T: Scalar> {
    plan: Plan,
    /// What walked axes alone move, for a block of steps.
    tables: Store<T::Of>,
    /// The points one by one, for programs that are not taken apart.
    columns: Vec<Vec<T>>,
}

impl<T: Scalar> Default for Walked<T> {
    fn default() -> Self {
        Self { plan: Plan::default(), tables: Store::new(), columns: Vec::new() }
    }
}

/// How a lattice is cut: the first `inner` axes lie in the lanes, the last of them in pieces of `piece` numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cut {
    inner: usize,
    piece: usize,
}

impl Cut {
    /// As many whole axes as fit; the first one that does not is cut if that fills the lanes better.
    fn of(axes: &[usize], lanes: usize) -> Self {
        let mut whole = 1;
        for (axis, &length) in axes.iter().enumerate() {
            if whole * length > lanes {
                let piece = lanes / whole;
                // Pieces of one number would only move the axis from the walk into the lanes.
                if piece < 2 {
                    return Self { inner: axis, piece: axes[axis - 1] };
                }
                // Pieces of about the same length.
                return Self { inner: axis + 1, piece: length.div_ceil(length.div_ceil(piece)) };
            }
            whole *= length;
        }
        Self { inner: axes.len(), piece: axes.last().copied().unwrap_or(1) }
    }
}

impl<T: Scalar> Points<T> {
    /// The values on a lattice: `axes` has the numbers of each input of the program, one number for an input that does not move. The
    /// first axis moves fastest in `out`, whose length is the product of those of the axes.
    ///
    /// # Panics
    /// If the number of axes or the length of `out` is another.
    pub fn lattice(&mut self, program: &Program, axes: &[&[T]], out: &mut [T]) {
        assert_eq!(axes.len(), program.inputs().len(), "one axis per input");
        let mut lengths = [1; plan::AXES];
        assert!(axes.len() <= lengths.len(), "no more axes than coordinates");
        lengths.iter_mut().zip(axes).for_each(|(length, axis)| *length = axis.len());
        let lengths = &lengths[..axes.len()];
        assert_eq!(lengths.iter().product::<usize>(), out.len(), "one value per point");
        if out.is_empty() {
            return;
        }
        let cut = Cut::of(lengths, <T::Of as Kind>::LANES);
        let (length, whole) = match cut.inner.checked_sub(1) {
            Some(last) => (lengths[last], lengths[..last].iter().product()),
            None => (1, 1),
        };
        let mut walked = self.walked.take().unwrap_or_default();
        if program.has_regions() || !walked.plan.make(program, lengths, cut.inner, whole * cut.piece) {
            self.expanded(program, &mut walked.columns, axes, out);
        } else {
            self.store.reserve_slots(walked.plan.block_slots());
            walked.tables.reserve_slots(walked.plan.table_slots());
            for from in (0..length).step_by(cut.piece.max(1)) {
                let piece = from..length.min(from + cut.piece.max(1));
                self.piece(program, &mut walked, axes, (cut.inner, piece), out);
            }
        }
        self.walked = Some(walked);
    }

    /// The same by way of all points, for what is better not taken apart.
    fn expanded(&mut self, program: &Program, columns: &mut Vec<Vec<T>>, axes: &[&[T]], out: &mut [T]) {
        /// Points at a time, if the lattice has slices of about so many.
        const SLICE: usize = 4096;
        let last = axes.iter().rposition(|axis| axis.len() > 1).unwrap_or(0);
        let slice = axes.get(last).map_or(1, |axis| out.len() / axis.len());
        if out.len() > SLICE && slice >= SLICE / 64 {
            let mut part = [&[][..]; plan::AXES];
            part.iter_mut().zip(axes).for_each(|(part, axis)| *part = axis);
            for (number, out) in axes[last].chunks(1).zip(out.chunks_mut(slice)) {
                part[last] = number;
                self.expanded(program, columns, &part[..axes.len()], out);
            }
            return;
        }
        columns.resize_with(axes.len().max(columns.len()), Vec::new);
        let mut run = 1;
        for (column, axis) in columns.iter_mut().zip(axes) {
            column.clear();
            while column.len() < out.len() {
                axis.iter().for_each(|&number| column.resize(column.len() + run, number));
            }
            run *= axis.len();
        }
        let mut slices = [&[][..]; plan::AXES];
        slices.iter_mut().zip(&*columns).for_each(|(slice, column)| *slice = column);
        self.eval(program, &slices[..axes.len()], out);
    }

    /// The points of one piece of the last inner axis.
    fn piece(
        &mut self,
        program: &Program,
        walked: &mut Walked<T>,
        axes: &[&[T]],
        (inner, piece): (usize, std::ops::Range<usize>),
        out: &mut [T],
    ) {
        let size = <T::Of as Kind>::LANES;
        let whole: usize = axes[..inner.max(1) - 1].iter().map(|axis| axis.len()).product();
        let lanes = whole * piece.len();
        // Whole vectors are computed; what the lanes beyond the last point hold is never read.
        let full = lanes.next_multiple_of(64 / size_of::<T>()).min(size);
        self.lay_out(&mut walked.tables, axes, (inner, piece.clone()), lanes);
        let Walked { plan, tables, .. } = walked;
        run::<T>(program, &plan.block, &plan.slots, &mut self.store, full);
        let (stride, first) = (axes[..inner].iter().map(|axis| axis.len()).product::<usize>(), whole * piece.start);
        let outer = &axes[inner..];
        let steps: usize = outer.iter().map(|axis| axis.len()).product();
        let fastest = outer.iter().map(|axis| axis.len()).find(|&n| n > 1).unwrap_or(1);
        for start in (0..steps).step_by(size) {
            let count = size.min(steps - start);
            step_table(tables, axes, inner, start, count);
            run::<T>(program, &plan.table, &plan.table_of, tables, count.next_multiple_of(16));
            for lane in 0..count {
                let step = start + lane;
                if step % fastest == 0 {
                    plan.plane.enter(|slot| tables.slot(slot).as_ref()[lane].double());
                    run::<T>(program, &plan.plane, &plan.slots, &mut self.store, full);
                }
                plan.point.enter(|slot| tables.slot(slot).as_ref()[lane].double());
                run::<T>(program, &plan.point, &plan.slots, &mut self.store, full);
                let out = &mut out[step * stride + first..][..lanes];
                match plan.root {
                    plan::Root::Block(slot) => out.copy_from_slice(&self.store.slot(slot).as_ref()[..lanes]),
                    plan::Root::Table(slot) => out.fill(tables.slot(slot).as_ref()[lane]),
                }
            }
        }
    }

    /// Fills the lanes of the inner inputs, and everywhere those inputs that do not move.
    fn lay_out(
        &mut self,
        tables: &mut Store<T::Of>,
        axes: &[&[T]],
        (inner, piece): (usize, std::ops::Range<usize>),
        lanes: usize,
    ) {
        let mut run = 1;
        for (input, axis) in axes.iter().enumerate() {
            if axis.len() == 1 {
                self.store.input(input).as_mut().fill(axis[0]);
                tables.input(input).as_mut().fill(axis[0]);
            }
            if input < inner {
                let numbers = if input + 1 == inner { &axis[piece.clone()] } else { axis };
                let repeated = numbers.iter().flat_map(|number| std::iter::repeat_n(*number, run)).cycle();
                self.store.input(input).as_mut()[..lanes].iter_mut().zip(repeated).for_each(|(to, from)| *to = from);
                run *= numbers.len();
            }
        }
    }
}

/// The numbers of the walked inputs at `count` steps.
fn step_table<T: Scalar>(tables: &mut Store<T::Of>, axes: &[&[T]], inner: usize, start: usize, count: usize) {
    let mut run = 1;
    for (input, axis) in axes.iter().enumerate().skip(inner).filter(|(_, axis)| axis.len() > 1) {
        let block = &mut tables.input(input).as_mut()[..count];
        block.iter_mut().enumerate().for_each(|(lane, to)| *to = axis[(start + lane) / run % axis.len()]);
        run *= axis.len();
    }
}

fn run<T: Scalar>(program: &Program, stage: &Stage, slots: &[u32], store: &mut Store<T::Of>, lanes: usize) {
    if !stage.operations.is_empty() {
        let code = Code {
            operations: &stage.operations,
            results: &stage.results,
            slots,
            leaves: &program.leaves,
            regions: &program.regions,
        };
        T::Of::run_code(code, store, lanes, &mut ());
    }
}

#[cfg(test)]
mod tests {
    use super::Cut;

    #[test]
    fn lanes_are_filled_with_whole_axes_and_pieces_of_one() {
        for (axes, lanes, inner, piece) in [
            (&[9, 9, 9][..], 128, 2, 9),
            (&[8, 8, 8], 128, 3, 2),
            (&[4, 4, 4], 128, 3, 4),
            (&[256, 256, 256], 256, 1, 256),
            (&[257, 9, 9], 128, 1, 86),
            (&[33, 33, 33], 128, 2, 3),
            (&[100, 50], 128, 1, 100),
            (&[1, 1, 300], 128, 3, 100),
            (&[5], 128, 1, 5),
            (&[], 128, 0, 1),
        ] {
            assert_eq!(Cut::of(axes, lanes), Cut { inner, piece }, "{axes:?}");
        }
    }
}
