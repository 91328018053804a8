//! How much memory stores hold: each adds up its own lists.

use core::ops::AddAssign;

/// Bytes of lists.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Hash)]
pub struct MemoryUse {
    /// What is in the lists, places of removed records included: they are used again.
    pub used: usize,
    /// What the lists have room for. As lists grow by doubling, up to twice of what is used.
    pub held: usize,
}

impl AddAssign for MemoryUse {
    fn add_assign(&mut self, other: Self) {
        self.used += other.used;
        self.held += other.held;
    }
}

impl core::iter::Sum for MemoryUse {
    fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
        parts.fold(Self::default(), |mut sum, part| {
            sum += part;
            sum
        })
    }
}

/// Holds memory besides its own size.
pub(crate) trait Footprint {
    fn footprint(&self) -> MemoryUse;
}

/// A list of plain items: they hold nothing themselves. For others there is [`each`].
impl<T> Footprint for Vec<T> {
    fn footprint(&self) -> MemoryUse {
        MemoryUse { used: size_of_val(self.as_slice()), held: self.capacity() * size_of::<T>() }
    }
}

/// An array lies in what it belongs to; what its items hold does not.
impl<T: Footprint, const N: usize> Footprint for [T; N] {
    fn footprint(&self) -> MemoryUse {
        each(self)
    }
}

/// A number holds nothing.
impl Footprint for usize {
    fn footprint(&self) -> MemoryUse {
        MemoryUse::default()
    }
}

/// What the items of a list hold, without the list's own memory.
pub(crate) fn each<'a, T: Footprint + 'a>(items: impl IntoIterator<Item = &'a T>) -> MemoryUse {
    items.into_iter().map(Footprint::footprint).sum()
}

/// Implements [`Footprint`] for a struct: fields that hold memory, then lists (or arrays) whose items hold some, then
/// fields that hold none. A field that is not named does not compile.
macro_rules! footprint {
    (
        $type:ident $(<$generic:ident>)? { $($field:ident),* $(,)? }
        $(each { $($list:ident),* $(,)? })?
        $(none { $($plain:ident),* $(,)? })?
    ) => {
        impl $(<$generic>)? $crate::footprint::Footprint for $type $(<$generic>)? {
            fn footprint(&self) -> $crate::footprint::MemoryUse {
                let Self { $($field,)* $($($list,)*)? $($($plain: _,)*)? } = self;
                #[allow(unused_mut, reason = "a struct of nothing but lists of lists")]
                let mut sum = $crate::footprint::MemoryUse::default();
                $(sum += $crate::footprint::Footprint::footprint($field);)*
                $($(
                    sum += $crate::footprint::Footprint::footprint($list);
                    sum += $crate::footprint::each($list);
                )*)?
                sum
            }
        }
    };
}

pub(crate) use footprint;

#[cfg(test)]
mod tests {
    use super::*;

    struct Store {
        numbers: Vec<u32>,
        rows: Vec<Vec<u64>>,
        count: usize,
    }
    footprint!(Store { numbers } each { rows } none { count });

    #[test]
    fn lists_in_lists_are_counted() {
        let mut numbers = Vec::with_capacity(10);
        numbers.push(7);
        let mut rows = Vec::with_capacity(4);
        rows.push(vec![1; 3]);
        let store = Store { numbers, rows, count: 5 };
        let list = size_of::<Vec<u64>>();
        let expected = MemoryUse { used: 4 + list + 24, held: 40 + 4 * list + 24 };
        assert_eq!((store.footprint(), store.count), (expected, 5));
    }
}
