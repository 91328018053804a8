//! Random numbers that are the same everywhere.

use serde::{Deserialize, Serialize};

/// SplitMix64 (G. Steele, D. Lea, C. Flood, *Fast Splittable Pseudorandom Number Generators*, 2014): one word of
/// state, so that each world of a batch can have its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Random(u64);

impl Random {
    /// The generator of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly between two numbers; the upper one does not come.
    pub fn uniform(&mut self, low: f32, high: f32) -> f32 {
        let unit = (self.bits() >> 40) as f32 / (1u64 << 24) as f32;
        low + (high - low) * unit
    }

    /// A whole number from `low` to just below `high`; `low` where there is none.
    pub fn whole(&mut self, low: i64, high: i64) -> i64 {
        let span = high.saturating_sub(low).max(1) as u64;
        low + (self.bits() % span) as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fill_their_range_evenly() {
        let mut random = Random::new(7);
        let (mut sum, mut least, mut most) = (0.0, 9.0f32, -9.0f32);
        for _ in 0..10_000 {
            let x = random.uniform(-2.0, 6.0);
            sum += x;
            least = if x < least { x } else { least };
            most = if x > most { x } else { most };
        }
        assert!((sum / 10_000.0 - 2.0).abs() < 0.1);
        assert!((-2.0..-1.99).contains(&least) && (5.99..6.0).contains(&most));
        let mut counts = [0; 3];
        (0..3000).for_each(|_| counts[(random.whole(4, 7) - 4) as usize] += 1);
        assert!(counts.iter().all(|&count| (900..1100).contains(&count)), "{counts:?}");
        assert_eq!(random.whole(4, 4), 4);
    }
}
