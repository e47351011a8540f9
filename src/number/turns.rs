//! The meaning of a loop for intervals: a box takes its turns as a whole while the condition is decided for all of it; where it
//! is not, what leaves is joined to the result and the rest goes on. Knows no expressions.

use super::Interval;

/// Turns that a box may take undecided before its variables are joined with what they were, and bounds that still move are given up.
const UNDECIDED: usize = 1_000;

/// One box on its way through a loop.
#[derive(Clone, Debug, Default)]
pub struct Turns {
    /// The values of the variables of all points that have left.
    pub result: Vec<Interval>,
    undecided: usize,
}

/// Nothing yet.
const NOTHING: Interval = Interval { lo: f64::INFINITY, hi: f64::NEG_INFINITY, undefined: false };

impl Turns {
    /// Begins anew, with so many variables.
    pub fn begin(&mut self, variables: usize) {
        self.result.clear();
        self.result.resize(variables, NOTHING);
        self.undecided = 0;
    }

    /// Whether some points may take another turn, where the condition and the variables have these ranges.
    pub fn goes_on(&mut self, condition: Interval, variable: impl Fn(usize) -> Interval) -> bool {
        let certain = (condition.lo > 0.0 || condition.hi < 0.0) && !condition.undefined && !condition.is_empty();
        if certain {
            self.undecided += usize::from(self.undecided > 0);
            return true;
        }
        for (i, result) in self.result.iter_mut().enumerate() {
            *result = result.hull(variable(i));
        }
        self.undecided += 1;
        !(condition.is_empty() || (condition.lo == 0.0 && condition.hi == 0.0))
    }

    /// Whether the variables are to be joined from now on: [`Turns::joined`] instead of the next value.
    #[must_use]
    pub fn joins(&self) -> bool {
        self.undecided > UNDECIDED
    }

    /// A variable's old and next value together; a bound that moves is given up. The same as the old one where nothing moves.
    #[must_use]
    pub fn joined(old: Interval, next: Interval) -> Interval {
        let both = old.hull(next);
        Interval {
            lo: if both.lo < old.lo { f64::NEG_INFINITY } else { old.lo },
            hi: if both.hi > old.hi { f64::INFINITY } else { old.hi },
            undefined: both.undefined,
        }
    }

    /// Some points may never leave: they are undefined.
    pub fn give_up(&mut self) {
        self.result.iter_mut().for_each(|r| r.undefined = true);
    }
}
