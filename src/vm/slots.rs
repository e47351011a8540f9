//! Gives each value of a program a slot, used again once the value has been read for the last time. Computes nothing.

use super::program::{Op, Value};

/// Working storage, kept from one program to the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlotScratch {
    last_use: Vec<u32>,
    free: Vec<u32>,
}

/// Never read.
const NEVER: u32 = u32::MAX;

impl SlotScratch {
    /// Fills `slots` with the slot of each value; gives their number. The inputs keep the first slots for ever, so that a block
    /// of points is copied in once. A result may take the slot of an operand that is read there for the last time.
    pub(crate) fn assign(&mut self, inputs: usize, operations: &[Op], roots: &[Value], slots: &mut Vec<u32>) -> u32 {
        self.last_use.clear();
        self.last_use.resize(inputs + operations.len(), NEVER);
        for (at, op) in (0u32..).zip(operations) {
            op.for_each_operand(|v| self.last_use[v as usize] = at);
        }
        roots.iter().for_each(|root| self.last_use[*root as usize] = NEVER);
        self.free.clear();
        slots.clear();
        slots.extend(0..inputs as u32);
        let mut count = inputs as u32;
        for (at, op) in (0u32..).zip(operations) {
            op.for_each_operand(|v| {
                if v as usize >= inputs && self.last_use[v as usize] == at {
                    self.free.push(slots[v as usize]);
                    // An operand that is read twice by one operation is given back once.
                    self.last_use[v as usize] = NEVER;
                }
            });
            slots.push(self.free.pop().unwrap_or_else(|| {
                count += 1;
                count - 1
            }));
        }
        count
    }
}
