//! Bytes that data takes, where that does not depend on what it holds.

use super::Data;

/// That of several in a row.
pub(crate) const fn sum(sizes: &[Option<usize>]) -> Option<usize> {
    let (mut total, mut at) = (0, 0);
    while at < sizes.len() {
        let Some(size) = sizes[at] else { return None };
        total += size;
        at += 1;
    }
    Some(total)
}

/// That of the largest of several.
pub(crate) const fn largest(sizes: &[Option<usize>]) -> Option<usize> {
    let (mut largest, mut at) = (0, 0);
    while at < sizes.len() {
        let Some(size) = sizes[at] else { return None };
        if size > largest {
            largest = size;
        }
        at += 1;
    }
    Some(largest)
}

/// What one of several lacks to the largest.
pub(crate) const fn rest(largest: Option<usize>, own: Option<usize>) -> usize {
    match (largest, own) {
        (Some(largest), Some(own)) => largest - own,
        _ => 0,
    }
}

/// That of a field, named by a function to it.
pub(crate) const fn of_field<S, T: Data>(_: fn(&S) -> Option<&T>) -> Option<usize> {
    T::SIZE
}
