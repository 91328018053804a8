//! The list of the bodies that are awake: ascending in a step, and quick to change in between.
//!
//! A body that leaves is replaced by the last one, so that taking out a thousand bodies does not go through the list
//! a thousand times. The list is put in order again by the next step.

use super::bodies::{Bodies, NULL};
use crate::codec::bad;
use crate::error::Error;
use crate::work;

/// Going through all bodies takes less time than sorting the list of those that are awake, as long as there are
/// no more than this many bodies for each of them.
const SPARSE: usize = 8;

impl Bodies {
    /// Appends to the awake list a body that is not in it.
    pub(crate) fn push_awake(&mut self, index: u32) {
        self.awake_unsorted |= self.awake.last().is_some_and(|&last| last > index);
        self.awake_places[index as usize] = self.awake.len() as u32;
        self.awake.push(index);
    }

    /// Takes a body out of the awake list, if it is in it.
    pub(crate) fn remove_awake(&mut self, index: u32) {
        let place = core::mem::replace(&mut self.awake_places[index as usize], NULL) as usize;
        if place >= self.awake.len() {
            return;
        }
        self.awake.swap_remove(place);
        if let Some(&moved) = self.awake.get(place) {
            self.awake_places[moved as usize] = place as u32;
            self.awake_unsorted = true;
        }
    }

    /// Takes the bodies that are no longer awake out of the awake list. The others keep their order.
    pub(crate) fn retain_awake(&mut self) {
        let Self { awake, awake_places, infos, .. } = self;
        let mut kept = 0;
        awake.retain(|&index| {
            work::note();
            let stays = infos[index as usize].awake;
            awake_places[index as usize] = if stays { kept } else { NULL };
            kept += u32::from(stays);
            stays
        });
    }

    /// Brings the awake list into ascending order.
    pub(crate) fn sort_awake(&mut self) {
        if !core::mem::take(&mut self.awake_unsorted) {
            return;
        }
        let Self { awake, awake_places, .. } = self;
        if awake.len() < awake_places.len() / SPARSE {
            awake.sort_unstable();
        } else {
            awake.clear();
            let places = (0..).zip(awake_places.iter());
            awake.extend(places.filter(|&(_, &place)| place != NULL).map(|(index, _)| index));
        }
        for (place, &index) in (0..).zip(awake.iter()) {
            awake_places[index as usize] = place;
        }
    }

    /// Does each body know where in the awake list it is? For tests.
    pub(crate) fn knows_awake_places(&self) -> bool {
        let place = |&index: &u32| self.awake_places[index as usize];
        let listed = self.awake.iter().zip(0..).all(|(index, at)| place(index) == at);
        let known = self.awake_places.iter().filter(|&&place| place != NULL).count();
        listed && known == self.awake.len() && self.awake_places.len() == self.infos.len()
    }

    /// Notes where in the awake list each body is, for a list that was read.
    pub(super) fn find_awake_places(&mut self) -> Result<(), Error> {
        self.awake_places.clear();
        self.awake_places.resize(self.infos.len(), NULL);
        for (place, &index) in (0..).zip(&self.awake) {
            match self.awake_places.get_mut(index as usize) {
                Some(at) if *at == NULL => *at = place,
                _ => return Err(bad("the awake bodies are not")),
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::bodies::BodyInfo;
    use super::*;
    use crate::math::Pose;

    /// So many bodies, none awake.
    fn bodies(count: u32) -> Bodies {
        let mut bodies = Bodies::default();
        (0..count).for_each(|_| _ = bodies.insert(BodyInfo::default(), Pose::default()));
        bodies
    }

    fn check(bodies: &Bodies, expected: &[u32]) {
        let mut list = bodies.awake.clone();
        list.sort_unstable();
        assert_eq!(list, expected);
        assert!(bodies.awake_unsorted || bodies.awake.is_sorted());
        assert!(bodies.knows_awake_places());
    }

    #[test]
    fn the_awake_list_agrees_with_a_set() {
        for count in [5, 40, 400] {
            let (mut bodies, mut model) = (bodies(count), std::collections::BTreeSet::new());
            let mut state = 1_u32;
            for step in 0..2000 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let index = 1 + (state >> 16) % count;
                // First many are awake, then few.
                if model.contains(&index) || step > 1000 && state >> 12 & 7 != 0 {
                    bodies.remove_awake(index);
                    model.remove(&index);
                } else {
                    bodies.push_awake(index);
                    model.insert(index);
                }
                if step % 7 == 0 {
                    bodies.sort_awake();
                    assert!(bodies.awake.is_sorted() && !bodies.awake_unsorted);
                }
                check(&bodies, &model.iter().copied().collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn those_that_fell_asleep_leave_and_the_others_keep_their_order() {
        let mut bodies = bodies(6);
        for index in [2, 5, 1, 4] {
            bodies.infos[index as usize].awake = index != 5;
            bodies.push_awake(index);
        }
        bodies.retain_awake();
        assert_eq!(bodies.awake, [2, 1, 4]);
        check(&bodies, &[1, 2, 4]);
        bodies.sort_awake();
        check(&bodies, &[1, 2, 4]);
    }

    #[test]
    fn a_list_that_was_read_may_lie() {
        for (list, is_good) in [(vec![3, 1], true), (vec![3, 3], false), (vec![9], false)] {
            let mut bodies = bodies(4);
            bodies.awake = list;
            assert_eq!(bodies.find_awake_places().is_ok(), is_good);
        }
    }
}
