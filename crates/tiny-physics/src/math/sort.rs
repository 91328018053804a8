//! Sorting by numbers, digit by digit: long lists of ids take a fraction of what comparing costs.

/// Shorter lists are compared: counting digits costs as much as their whole sorting.
const FEW: usize = 200;
/// Bits of a digit. At 11 three passes go over 32 bits, and the counts stay in the first cache.
const DIGIT: u32 = 11;

/// Sorts by the number of each item, ascending. Items of one number must be equal: their order is not defined.
/// `spare` is memory that the next call uses again.
///
/// Source: radix sort from the lowest digit up; Knuth, *The Art of Computer Programming* 3, 5.2.5.
pub(crate) fn sort_by_number<T: Copy>(
    list: &mut Vec<T>,
    spare: &mut Vec<T>,
    number: impl Fn(&T) -> u64,
) {
    let Some(first) = list.first().map(&number) else { return };
    if list.len() < FEW {
        return list.sort_unstable_by_key(number);
    }
    spare.clear();
    spare.extend_from_slice(list);
    // Bits in which no two differ need no pass.
    let mut differ = list.iter().fold(0, |all, item| all | (number(item) ^ first));
    while differ != 0 {
        let shift = differ.trailing_zeros();
        sort_by_digit(list, spare, |item| (number(item) >> shift) as usize % (1 << DIGIT));
        core::mem::swap(list, spare);
        differ &= u64::MAX.checked_shl(shift + DIGIT).unwrap_or(0);
    }
}

/// Writes the items of a list in the order of their digits; those of one digit keep theirs.
fn sort_by_digit<T: Copy>(from: &[T], to: &mut [T], digit: impl Fn(&T) -> usize) {
    let mut places = [0_u32; 1 << DIGIT];
    from.iter().for_each(|item| places[digit(item)] += 1);
    let mut sum = 0;
    for place in &mut places {
        (*place, sum) = (sum, sum + *place);
    }
    for item in from {
        let place = &mut places[digit(item)];
        to[*place as usize] = *item;
        *place += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers with many and few bits in which they differ, against the library.
    #[test]
    fn numbers_are_in_order_whatever_their_bits() {
        let (mut state, mut spare) = (1_u64, Vec::new());
        let mut next = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state
        };
        for mask in [0, 1, 0x3ff, 0xffff, 0xffff_0000_ffff, 0xf0f0_0000_0000_0000, u64::MAX] {
            for length in [0, 1, 2, FEW - 1, FEW, FEW + 1, 5000] {
                let mut list: Vec<u64> = (0..length).map(|_| next() & mask | 1 << 40).collect();
                let mut expected = list.clone();
                expected.sort_unstable();
                sort_by_number(&mut list, &mut spare, |&number| number);
                assert_eq!(list, expected, "{length} numbers of {mask:x}");
            }
        }
    }
}
