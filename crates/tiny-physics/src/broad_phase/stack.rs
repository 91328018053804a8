//! A stack of node indices that allocates only when a tree is unusually deep.

const INLINE: usize = 64;

/// Last in, first out; the first entries live in place.
pub(super) struct Stack {
    inline: [u32; INLINE],
    count: usize,
    spill: Vec<u32>,
}

impl Stack {
    #[inline]
    pub(super) fn new() -> Self {
        Self { inline: [0; INLINE], count: 0, spill: Vec::new() }
    }

    #[inline]
    pub(super) fn push(&mut self, value: u32) {
        if self.count < INLINE {
            self.inline[self.count] = value;
            self.count += 1;
        } else {
            self.spill.push(value);
        }
    }

    #[inline]
    pub(super) fn pop(&mut self) -> Option<u32> {
        if self.count < INLINE {
            self.count = self.count.checked_sub(1)?;
            return Some(self.inline[self.count]);
        }
        self.spill.pop().or_else(|| {
            self.count -= 1;
            Some(self.inline[self.count])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spills_and_comes_back_in_order() {
        let mut stack = Stack::new();
        for i in 0..1000 {
            stack.push(i);
        }
        for i in (0..1000).rev() {
            assert_eq!(stack.pop(), Some(i));
        }
        assert_eq!(stack.pop(), None);
    }
}
