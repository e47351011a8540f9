//! What work leaves behind for the next time: results under the hash of all that they depend on, within a bound of memory. It knows
//! nothing of what it keeps, and no result depends on it: what is found here would be computed anew to the bit.

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt::{self, Debug, Write};
use std::hash::Hasher;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rustc_hash::FxHashMap;
use siphasher::sip128::{Hasher128, SipHasher13};

/// The name of a result: a hash of all that it depends on, of 128 bits, so that two results never share one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key(u128);

impl Key {
    /// Its bits.
    #[must_use]
    pub fn bits(self) -> u128 {
        self.0
    }
}

/// Gathers what a result depends on into its [`Key`].
#[derive(Clone, Debug)]
pub struct Digest(SipHasher13);

impl Digest {
    /// Of a kind of result.
    #[must_use]
    pub fn of(kind: &str) -> Self {
        let mut digest = Self(SipHasher13::new());
        digest.text(kind);
        digest
    }

    /// Adds a text.
    pub fn text(&mut self, text: &str) {
        self.0.write(text.as_bytes());
        self.0.write_u8(0xff);
    }

    /// Adds a number by its bits.
    pub fn number(&mut self, value: f64) {
        self.0.write_u64(value.to_bits());
    }

    /// Adds some numbers and their count.
    pub fn numbers(&mut self, values: &[f64]) {
        self.0.write_usize(values.len());
        values.iter().for_each(|&value| self.number(value));
    }

    /// Adds a value by all that its `Debug` shows, which must be all of it: so a field that is added later counts by itself.
    pub fn shown(&mut self, value: &dyn Debug) {
        // Writing into a hasher never fails.
        let _ = write!(self, "{value:?}");
        self.0.write_u8(0xff);
    }

    /// The key of what was gathered so far.
    #[must_use]
    pub fn key(&self) -> Key {
        Key(self.0.finish128().as_u128())
    }
}

impl Hasher for Digest {
    fn write(&mut self, bytes: &[u8]) {
        self.0.write(bytes);
    }

    fn finish(&self) -> u64 {
        self.0.finish()
    }
}

impl Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

/// Results of earlier work. Clones share them.
#[derive(Clone, Debug)]
pub struct Reuse {
    most: usize,
    shelf: Arc<Mutex<Shelf>>,
}

/// What is kept, and in which order it was last asked for.
#[derive(Debug, Default)]
struct Shelf {
    items: FxHashMap<Key, Item>,
    order: BTreeMap<Place, Key>,
    bytes: usize,
    turn: u64,
    count: u64,
}

/// The turn in which something was last asked for, and its number within.
type Place = (u64, u64);

#[derive(Debug)]
struct Item {
    what: Arc<dyn Any + Send + Sync>,
    bytes: usize,
    place: Place,
}

/// Bytes that an entry takes beside what it holds, roughly.
const OVERHEAD: usize = 192;

impl Reuse {
    /// Keeps at most so many bytes; nothing if that is 0.
    #[must_use]
    pub fn within(most: usize) -> Self {
        Self { most, shelf: Arc::default() }
    }

    /// Begins another piece of work: what is asked for or kept from now on is not thrown out to make room until the next one.
    pub fn turn(&self) {
        self.lock().turn += 1;
    }

    /// What was kept under a key, if it is a `T`.
    #[must_use]
    pub fn find<T: Send + Sync + 'static>(&self, key: Key) -> Option<Arc<T>> {
        let mut shelf = self.lock();
        let place = shelf.next();
        let item = shelf.items.get_mut(&key)?;
        let before = std::mem::replace(&mut item.place, place);
        let what = item.what.clone();
        shelf.order.remove(&before);
        shelf.order.insert(place, key);
        what.downcast().ok()
    }

    /// Keeps something of so many bytes. What was not asked for since before this turn makes room, the oldest first; where that is not
    /// enough nothing is kept, so that work that is larger than the room still finds a part of itself the next time.
    pub fn keep<T: Send + Sync + 'static>(&self, key: Key, what: Arc<T>, bytes: usize) {
        let bytes = bytes.saturating_add(OVERHEAD);
        let mut shelf = self.lock();
        shelf.remove(key);
        while shelf.bytes.saturating_add(bytes) > self.most {
            match shelf.order.first_key_value() {
                Some((&(turn, _), &oldest)) if turn < shelf.turn => shelf.remove(oldest),
                _ => return,
            }
        }
        let place = shelf.next();
        shelf.bytes += bytes;
        shelf.order.insert(place, key);
        shelf.items.insert(key, Item { what, bytes, place });
    }

    /// Whether so many bytes are worth a copy: a quarter of the room at most, so that no single result throws out all others.
    #[must_use]
    pub fn has_room(&self, bytes: usize) -> bool {
        bytes <= self.most / 4
    }

    /// Bytes that are kept.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.lock().bytes
    }

    /// Forgets everything.
    pub fn clear(&self) {
        *self.lock() = Shelf::default();
    }

    // A thread that panicked while it held the lock leaves a whole shelf behind, or one that forgets an entry.
    fn lock(&self) -> MutexGuard<'_, Shelf> {
        self.shelf.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Shelf {
    fn next(&mut self) -> Place {
        self.count += 1;
        (self.turn, self.count)
    }

    fn remove(&mut self, key: Key) {
        if let Some(item) = self.items.remove(&key) {
            self.order.remove(&item.place);
            self.bytes -= item.bytes;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(n: u64) -> Key {
        let mut digest = Digest::of("test");
        digest.write_u64(n);
        digest.key()
    }

    #[test]
    fn what_was_not_asked_for_makes_room_first() {
        let reuse = Reuse::within(3 * (100 + OVERHEAD));
        (0..3).for_each(|n| reuse.keep(key(n), Arc::new(n), 100));
        reuse.turn();
        assert_eq!(reuse.find::<u64>(key(0)).as_deref(), Some(&0));
        reuse.keep(key(3), Arc::new(3_u64), 100);
        let known = |n| reuse.find::<u64>(key(n)).is_some();
        assert_eq!([0, 1, 2, 3].map(known), [true, false, true, true]);
        // All three were asked for in this turn: nothing makes room.
        reuse.keep(key(4), Arc::new(4_u64), 100);
        assert_eq!([0, 2, 3, 4].map(known), [true, true, true, false]);
        assert_eq!(reuse.bytes(), 3 * (100 + OVERHEAD));
    }

    #[test]
    fn the_bound_holds_to_the_byte() {
        for (most, fits) in [(100 + OVERHEAD, true), (99 + OVERHEAD, false), (0, false)] {
            let reuse = Reuse::within(most);
            reuse.keep(key(0), Arc::new(0_u64), 100);
            assert_eq!(reuse.find::<u64>(key(0)).is_some(), fits, "{most}");
        }
    }

    #[test]
    fn a_key_tells_order_and_lengths() {
        let of = |parts: &[&str]| {
            let mut digest = Digest::of("");
            parts.iter().for_each(|part| digest.text(part));
            digest.key()
        };
        assert_ne!(of(&["ab", "c"]), of(&["a", "bc"]));
        assert_ne!(of(&["a", "b"]), of(&["b", "a"]));
        assert_eq!(of(&["a", "b"]), of(&["a", "b"]));
    }
}
