//! What waits in a queue by its urgency, in an order without ties, so that a search takes the same way each time. Knows nothing of
//! what waits.

use std::cmp::{Ordering, Reverse};

/// Something that waits: the largest rank first, its numbers compared from the first to the last; of equals the one with the smaller
/// number, which came first.
#[derive(Clone, Debug)]
pub struct Ranked<const N: usize, T> {
    /// How urgent it is.
    pub rank: [f64; N],
    /// When it came.
    pub number: usize,
    /// What waits.
    pub item: T,
}

impl<const N: usize, T> Ord for Ranked<N, T> {
    fn cmp(&self, other: &Self) -> Ordering {
        let pairs = self.rank.iter().zip(&other.rank);
        let by_rank = pairs.fold(Ordering::Equal, |known, (a, b)| known.then(a.total_cmp(b)));
        by_rank.then(Reverse(self.number).cmp(&Reverse(other.number)))
    }
}

impl<const N: usize, T> PartialOrd for Ranked<N, T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<const N: usize, T> PartialEq for Ranked<N, T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<const N: usize, T> Eq for Ranked<N, T> {}

#[cfg(test)]
mod tests {
    use std::collections::BinaryHeap;

    use super::*;

    #[test]
    fn the_largest_comes_first_and_of_equals_the_earliest() {
        let waiting = [[1.0, 0.0], [2.0, -0.0], [2.0, 0.0], [2.0, 0.0], [f64::NEG_INFINITY, 9.0]];
        let mut heap: BinaryHeap<_> =
            waiting.iter().enumerate().map(|(number, &rank)| Ranked { rank, number, item: () }).collect();
        let order: Vec<usize> = std::iter::from_fn(|| heap.pop()).map(|ranked| ranked.number).collect();
        assert_eq!(order, [2, 3, 1, 0, 4]);
    }
}
