//! Lists of records whose places are used again.

/// A place for a new record: a free one, else the next of a list of this length.
pub(super) fn claim(free: &mut Vec<u32>, length: usize) -> u32 {
    free.pop().unwrap_or(length as u32)
}

/// Writes an item at a place of a list, or behind its last.
pub(super) fn put<T>(list: &mut Vec<T>, index: u32, item: T) {
    match list.get_mut(index as usize) {
        Some(place) => *place = item,
        None => list.push(item),
    }
}
