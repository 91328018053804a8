//! Which pairs of shapes have a contact record: a hash table of pairs.

/// Maps unordered pairs of shape indices to contact indices. Open addressing with linear probing,
/// deletion by shifting back, so there are no tombstones and the content alone decides look-ups.
/// It is never iterated.
#[derive(Debug, PartialEq, Default)]
pub(crate) struct PairTable {
    /// (key, contact); an empty place has key [`EMPTY`].
    places: Vec<(u64, u32)>,
    len: usize,
}

crate::codec::clone_by_field!(PairTable { places, len });
crate::footprint::footprint!(PairTable { places } none { len });

const EMPTY: u64 = u64::MAX;

impl PairTable {
    /// Without pairs, but with memory for as many.
    pub(crate) fn with_room_for(pairs: usize) -> Self {
        let places = if pairs == 0 { 0 } else { (pairs * 2).next_power_of_two().max(64) };
        Self { places: vec![(EMPTY, 0); places], len: 0 }
    }

    fn key(a: u32, b: u32) -> u64 {
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        u64::from(high) << 32 | u64::from(low)
    }

    /// Where a key would like to be.
    fn home(&self, key: u64) -> usize {
        let hash = key.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (hash ^ hash >> 32) as usize & (self.places.len() - 1)
    }

    /// The place of the key, or the empty place where it would go. The table is not empty.
    fn find(&self, key: u64) -> usize {
        let mask = self.places.len() - 1;
        let mut at = self.home(key);
        while self.places[at].0 != EMPTY && self.places[at].0 != key {
            at = (at + 1) & mask;
        }
        at
    }

    /// The contact of a pair, if it has one.
    pub(crate) fn get(&self, a: u32, b: u32) -> Option<u32> {
        if self.len == 0 {
            return None;
        }
        let (key, contact) = self.places[self.find(Self::key(a, b))];
        (key != EMPTY).then_some(contact)
    }

    /// Notes the contact of a pair; false, and nothing noted, where it has one already.
    pub(crate) fn insert(&mut self, a: u32, b: u32, contact: u32) -> bool {
        if (self.len + 1) * 2 > self.places.len() {
            self.grow();
        }
        let key = Self::key(a, b);
        let at = self.find(key);
        if self.places[at].0 == key {
            return false;
        }
        self.places[at] = (key, contact);
        self.len += 1;
        true
    }

    /// Forgets a pair, if it is there.
    pub(crate) fn remove(&mut self, a: u32, b: u32) {
        if self.len == 0 {
            return;
        }
        let mask = self.places.len() - 1;
        let mut hole = self.find(Self::key(a, b));
        if self.places[hole].0 == EMPTY {
            return;
        }
        self.len -= 1;
        let mut at = hole;
        loop {
            at = (at + 1) & mask;
            let key = self.places[at].0;
            if key == EMPTY {
                break;
            }
            // Move the entry into the hole unless its home lies after the hole.
            let from_home = at.wrapping_sub(self.home(key)) & mask;
            let from_hole = at.wrapping_sub(hole) & mask;
            if from_home >= from_hole {
                self.places[hole] = self.places[at];
                hole = at;
            }
        }
        self.places[hole] = (EMPTY, 0);
    }

    /// Pairs noted.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// Doubles the table in place, so that one that has been this large before needs no new memory.
    ///
    /// Each entry is taken out and put where it belongs now. One that had to step over another that was still
    /// in the way lies behind it and is taken again after it: in the old half, or in the run that goes on behind
    /// its end.
    fn grow(&mut self) {
        let old = self.places.len();
        self.places.resize((old * 2).max(64), (EMPTY, 0));
        let mut at = 0;
        while at < old || self.places[at].0 != EMPTY {
            let (key, contact) = core::mem::replace(&mut self.places[at], (EMPTY, 0));
            if key != EMPTY {
                let place = self.find(key);
                self.places[place] = (key, contact);
            }
            at += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn agrees_with_the_standard_map() {
        let mut table = PairTable::default();
        let mut model: HashMap<(u32, u32), u32> = HashMap::new();
        let mut state = 1_u32;
        for step in 0..20_000 {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let (a, b) = (state >> 24 & 63, 64 + (state >> 16 & 63));
            match model.get(&(a, b)) {
                Some(&contact) => {
                    assert_eq!(table.get(b, a), Some(contact));
                    table.remove(b, a);
                    model.remove(&(a, b));
                }
                None => {
                    assert_eq!(table.get(a, b), None);
                    table.insert(a, b, step);
                    model.insert((a, b), step);
                }
            }
            assert_eq!(table.len(), model.len());
        }
        for (&(a, b), &contact) in &model {
            assert_eq!(table.get(a, b), Some(contact));
        }
    }

    #[test]
    fn notes_a_pair_once() {
        for room in [0, 1, 100] {
            let mut table = PairTable::with_room_for(room);
            let places = table.places.len();
            assert!((0..room as u32).all(|i| table.insert(i, i + 1, i)));
            assert_eq!(table.places.len(), places);
            assert!(table.insert(5000, 7, 1) && !table.insert(7, 5000, 2));
            assert_eq!((table.get(7, 5000), table.len()), (Some(1), room + 1));
        }
    }

    #[test]
    fn growing_loses_nothing_and_finds_nothing_else() {
        for stride in [1, 7, 64, 4096] {
            let mut table = PairTable::default();
            for i in 0..3000 {
                table.insert(i * stride, i * stride + 1, i);
                if i.is_power_of_two() {
                    for k in 0..=i {
                        assert_eq!(table.get(k * stride + 1, k * stride), Some(k), "{k} of {i}");
                    }
                    assert_eq!(table.get(i * stride + 2, i * stride), None);
                }
            }
        }
    }
}
