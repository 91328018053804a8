//! Random numbers that are the same for the same seed, on every platform, for ever.
//!
//! The bits come from generators that are fixed by their definition; the floats are made from them here,
//! because a library's way from bits to floats may change between its versions.

use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;
use tiny_physics::Vec2;

/// Numbers for the seeded scenes: PCG-XSH-RR 64/32 (O'Neill 2014).
#[derive(Clone, Debug)]
pub struct Random(Pcg32);

impl Random {
    const STREAM: u64 = 0x7069_6c65;

    /// From a seed.
    pub fn new(seed: u64) -> Self {
        Self(Pcg32::new(seed, Self::STREAM))
    }

    /// From `a` up to `b`, in steps of 2^-24 of the range.
    pub fn range(&mut self, a: f32, b: f32) -> f32 {
        a + (b - a) * unit(self.0.next_u32())
    }

    /// From 0 up to but not including `count`.
    pub fn below(&mut self, count: u32) -> u32 {
        ((u64::from(self.0.next_u32()) * u64::from(count)) >> 32) as u32
    }

    /// Heads or tails.
    pub fn coin(&mut self) -> bool {
        self.below(2) == 1
    }
}

/// The generator that some published benchmark scenes use, so that theirs and ours are the same scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lcg(pub(crate) u32);

impl Lcg {
    /// From `a` to `b`.
    pub(crate) fn range(&mut self, a: f32, b: f32) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        a + (b - a) * unit(self.0)
    }

    /// A point of the box from `lower` to `upper`; draws x first.
    pub(crate) fn point(&mut self, lower: Vec2, upper: Vec2) -> Vec2 {
        let x = self.range(lower.x, upper.x);
        Vec2::new(x, self.range(lower.y, upper.y))
    }
}

/// The upper 24 bits as a fraction; exact in `f32`.
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / 16_777_216.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_generators_are_fixed_for_ever() {
        let mut random = Random::new(42);
        let drawn: Vec<u32> = (0..4).map(|_| random.below(1000)).collect();
        assert_eq!(drawn, DRAWN);
        let mut lcg = Lcg(1234);
        assert_eq!(
            lcg.range(0.0, 16_777_216.0),
            11_984_094.0,
            "(1664525*1234 + 1013904223 mod 2^32) / 256"
        );
        assert!((0..100).all(|_| (2.0..3.0).contains(&random.range(2.0, 3.0))));
    }

    const DRAWN: [u32; 4] = [731, 177, 260, 414];
}
