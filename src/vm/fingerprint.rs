//! What a program computes, told to a digest: two programs that tell the same give the same bits at every point, over every box and of every
//! slope. Compares nothing and keeps nothing.

use std::hash::{Hash, Hasher};
use std::mem::discriminant;

use super::program::{Op, Program};
use crate::reuse::Digest;

impl Program {
    /// Tells all that its values depend on: the operations in their order, data and regions by their content, and those of the last
    /// inputs, fixed at these numbers, that it reads. Neither the places where it keeps its values nor what was asked of it count: both
    /// change no bit.
    pub fn tell(&self, fixed: &[f64], to: &mut Digest) {
        let inputs = self.inputs.len();
        let mut reads = vec![false; inputs];
        let mut read = |value: u32| {
            if let Some(reads) = reads.get_mut(value as usize) {
                *reads = true;
            }
        };
        read(self.root);
        // Regions by the order in which they first occur: their numbers depend on what else was compiled.
        let mut regions: Vec<u32> = Vec::new();
        to.write_usize(inputs);
        for op in &self.operations {
            op.for_each_operand(&mut read);
            self.tell_operation(op, &mut regions, to);
        }
        to.write_u32(self.root);
        let first = inputs - fixed.len();
        for (input, &value) in (first..).zip(fixed).filter(|(input, _)| reads[*input]) {
            to.write_usize(input);
            to.number(value);
        }
    }

    fn tell_operation(&self, op: &Op, regions: &mut Vec<u32>, to: &mut Digest) {
        discriminant(op).hash(to);
        op.for_each_operand(|value| to.write_u32(value));
        let mut numbered = |region: u32| match regions.iter().position(|known| *known == region) {
            Some(number) => number,
            None => {
                regions.push(region);
                regions.len() - 1
            }
        };
        match *op {
            Op::Constant(value) => to.number(value),
            Op::Unary(op, _) => op.hash(to),
            Op::Binary(op, ..) => op.hash(to),
            Op::WithRight(op, _, number) | Op::WithLeft(op, number, _) => {
                op.hash(to);
                to.number(number);
            }
            Op::Ternary(op, _) => op.hash(to),
            Op::Join(op, _, _, number) => {
                op.hash(to);
                to.number(number);
            }
            Op::Extreme(op, side, ..) => (op, side).hash(to),
            Op::Leaf(leaf, arity, _) => (self.leaves[leaf as usize].0.fingerprint(), arity).hash(to),
            Op::Give(region, place, ..) => (numbered(region), place).hash(to),
            Op::Region(region, _) => (numbered(region), self.regions[region as usize].fingerprint()).hash(to),
            Op::Output(region, output, _) => (numbered(region), output).hash(to),
        }
    }
}
