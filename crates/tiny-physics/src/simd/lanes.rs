//! The lane vector that kernels are written over, and its instances.

use crate::threads::{RowsAt, SharedRows};
use core::ops::{Add, Div, Mul, Neg, Sub};
use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdMask, f32x4};

/// Lanes in one storage block: the widest level. Narrower levels walk a block in several strides, so
/// the data layout does not depend on the level.
pub(crate) const BLOCK: usize = 16;

/// Eight floats that are gathered and scattered together: the solver's copy of a body.
pub(crate) type Row = [f32; 8];

/// Something rows can be read from by index.
pub(crate) trait RowSource: Copy {
    /// The rows at the first so many of some indices.
    fn at<const N: usize>(self, indices: &[u32]) -> impl RowsOf;
}

/// Rows that are there.
pub(crate) trait RowsOf {
    /// A copy of the `i`th.
    fn row(&self, i: usize) -> Row;
}

impl RowSource for &[Row] {
    #[inline(always)]
    fn at<const N: usize>(self, indices: &[u32]) -> impl RowsOf {
        RowsAt::<N>::of(self, indices)
    }
}

impl RowSource for SharedRows<'_> {
    #[inline(always)]
    fn at<const N: usize>(self, indices: &[u32]) -> impl RowsOf {
        SharedRows::at::<N>(self, indices)
    }
}

impl<const N: usize> RowsOf for RowsAt<'_, N> {
    #[inline(always)]
    fn row(&self, i: usize) -> Row {
        RowsAt::row(self, i)
    }
}

/// A vector of `f32`, one lane per constraint (or pair, or body).
pub(crate) trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Number of lanes; divides [`BLOCK`].
    const WIDTH: usize;
    /// Proof that the machine has the instructions.
    type Token: Copy;
    /// One truth value a lane.
    type Mask: Copy;
    /// Half as many lanes, for what is left over; the same where there are no fewer that are quicker.
    type Half: Lanes;

    /// The proof for half as many.
    fn half(token: Self::Token) -> <Self::Half as Lanes>::Token;
    /// All lanes equal.
    fn splat(token: Self::Token, value: f32) -> Self;
    /// The first `WIDTH` values of `source`.
    fn load(token: Self::Token, source: &[f32]) -> Self;
    /// Into the first `WIDTH` places of `target`.
    fn store(self, target: &mut [f32]);
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// Sign bit cleared.
    fn abs(self) -> Self;
    /// `self < other`; false for NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`; false for NaN.
    fn le(self, other: Self) -> Self::Mask;
    /// `self == other`; false for NaN.
    fn eq(self, other: Self) -> Self::Mask;
    /// `self > other`; false for NaN.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }
    /// `yes` where the mask is set, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Both.
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Either.
    fn or(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// The opposite.
    fn not(a: Self::Mask) -> Self::Mask;
    /// Bit `i` set where lane `i` is.
    fn bits(mask: Self::Mask) -> u32;

    /// The smaller, as `self < other ? self : other`.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }
    /// The larger, as `self > other ? self : other`.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(self.gt(other), self, other)
    }
    /// Not below `low`, not above `high`.
    #[inline(always)]
    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }

    /// Turns rows into lanes: result `k` holds float `k` of the rows at the first `WIDTH` indices.
    fn gather(token: Self::Token, rows: impl RowSource, indices: &[u32]) -> [Self; 8];

    /// Writes the first half of rows back: float `k` of the row at `indices[i]` becomes lane `i` of
    /// `values[k]`, for the lanes whose bit in `write` is set.
    fn scatter(values: [Self; 4], rows: SharedRows<'_>, indices: &[u32], write: u32);
}

/// The lane type of an instruction set.
pub(crate) trait Native: Simd {
    /// Its widest vector that is quick.
    type Lanes: Lanes<Token = Self>;
}

/// One lane, of the constraints that are worked on one by one: those of trees in twice the precision.
macro_rules! one_lane {
    ($($float:ident)*) => {$(
        impl Lanes for $float {
            const WIDTH: usize = 1;
            type Token = ();
            type Mask = bool;
            type Half = Self;

            #[inline(always)]
            fn half((): ()) {}
            #[inline(always)]
            fn splat((): (), value: f32) -> Self {
                value.into()
            }
            #[inline(always)]
            fn load((): (), source: &[f32]) -> Self {
                source[0].into()
            }
            #[inline(always)]
            fn store(self, target: &mut [f32]) {
                target[0] = self as f32;
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $float::sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn eq(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
            #[inline(always)]
            fn and(a: bool, b: bool) -> bool {
                a & b
            }
            #[inline(always)]
            fn or(a: bool, b: bool) -> bool {
                a | b
            }
            #[inline(always)]
            fn not(a: bool) -> bool {
                !a
            }
            #[inline(always)]
            fn bits(mask: bool) -> u32 {
                u32::from(mask)
            }
            #[inline(always)]
            fn gather((): (), rows: impl RowSource, indices: &[u32]) -> [Self; 8] {
                rows.at::<1>(indices).row(0).map(Self::from)
            }
            #[inline(always)]
            fn scatter(values: [Self; 4], rows: SharedRows<'_>, indices: &[u32], write: u32) {
                rows.write_halves(indices, &[values.map(|value| value as f32)], write);
            }
        }
    )*};
}
one_lane!(f32 f64);

/// The operations that all vector instances take from the portable vector type unchanged.
macro_rules! portable_operations {
    ($width:literal) => {
        const WIDTH: usize = $width;

        #[inline(always)]
        fn splat(token: Self::Token, value: f32) -> Self {
            fearless_simd::SimdFrom::simd_from(token, value)
        }
        #[inline(always)]
        fn load(token: Self::Token, source: &[f32]) -> Self {
            Self::from_slice(token, &source[..$width])
        }
        #[inline(always)]
        fn store(self, target: &mut [f32]) {
            self.store_slice(&mut target[..$width]);
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            SimdFloat::sqrt(self)
        }
        #[inline(always)]
        fn abs(self) -> Self {
            SimdBase::abs(self)
        }
        #[inline(always)]
        fn lt(self, other: Self) -> Self::Mask {
            SimdBase::simd_lt(self, other)
        }
        #[inline(always)]
        fn le(self, other: Self) -> Self::Mask {
            SimdBase::simd_le(self, other)
        }
        #[inline(always)]
        fn eq(self, other: Self) -> Self::Mask {
            SimdBase::simd_eq(self, other)
        }
        #[inline(always)]
        fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
            Select::select(mask, yes, no)
        }
        #[inline(always)]
        fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask {
            a & b
        }
        #[inline(always)]
        fn or(a: Self::Mask, b: Self::Mask) -> Self::Mask {
            a | b
        }
        #[inline(always)]
        fn not(a: Self::Mask) -> Self::Mask {
            !a
        }
        #[inline(always)]
        fn bits(mask: Self::Mask) -> u32 {
            mask.to_bitmask() as u32
        }
        // The instructions of x86 do just what is asked for, of NaN and signed zero, too.
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        #[inline(always)]
        fn min(self, other: Self) -> Self {
            SimdBase::min(self, other)
        }
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        #[inline(always)]
        fn max(self, other: Self) -> Self {
            SimdBase::max(self, other)
        }
    };
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
pub(super) use portable_operations;

/// Four lanes: SSE2, NEON, wasm simd128.
impl<S: Simd> Lanes for f32x4<S> {
    type Token = S;
    type Mask = <Self as SimdBase<S>>::Mask;
    type Half = Self;
    portable_operations!(4);

    #[inline(always)]
    fn half(token: S) -> S {
        token
    }

    #[inline(always)]
    fn gather(token: S, rows: impl RowSource, indices: &[u32]) -> [Self; 8] {
        let rows = rows.at::<4>(indices);
        let r = [rows.row(0), rows.row(1), rows.row(2), rows.row(3)];
        let low = transpose4([
            Self::from_slice(token, &r[0][..4]),
            Self::from_slice(token, &r[1][..4]),
            Self::from_slice(token, &r[2][..4]),
            Self::from_slice(token, &r[3][..4]),
        ]);
        let high = transpose4([
            Self::from_slice(token, &r[0][4..]),
            Self::from_slice(token, &r[1][4..]),
            Self::from_slice(token, &r[2][4..]),
            Self::from_slice(token, &r[3][4..]),
        ]);
        [low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]]
    }

    #[inline(always)]
    fn scatter(values: [Self; 4], rows: SharedRows<'_>, indices: &[u32], write: u32) {
        let [a, b, c, d] = transpose4(values);
        rows.write_halves(indices, &[a.into(), b.into(), c.into(), d.into()], write);
    }
}

/// Transposes a 4 x 4 square of floats.
#[inline(always)]
fn transpose4<S: Simd>([a, b, c, d]: [f32x4<S>; 4]) -> [f32x4<S>; 4] {
    let (ac_low, ac_high) = (a.zip_low(c), a.zip_high(c));
    let (bd_low, bd_high) = (b.zip_low(d), b.zip_high(d));
    [
        ac_low.zip_low(bd_low),
        ac_low.zip_high(bd_low),
        ac_high.zip_low(bd_high),
        ac_high.zip_high(bd_high),
    ]
}

#[cfg(target_arch = "aarch64")]
impl Native for fearless_simd::Neon {
    type Lanes = f32x4<Self>;
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
impl Native for fearless_simd::WasmSimd128 {
    type Lanes = f32x4<Self>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::{LaneKernel, SimdLevel, dispatch};

    struct GatherScatter<'a> {
        rows: SharedRows<'a>,
        indices: &'a [u32; BLOCK],
    }

    impl LaneKernel for GatherScatter<'_> {
        type Output = ();

        /// Swaps x and y of every even row, adds column 4 to column 2.
        #[inline(always)]
        fn run<L: Lanes>(self, token: L::Token) {
            for indices in self.indices.chunks_exact(L::WIDTH) {
                let r = L::gather(token, self.rows, indices);
                let even = L::eq(r[6], L::splat(token, 0.0));
                let values =
                    [L::select(even, r[1], r[0]), L::select(even, r[0], r[1]), r[2] + r[4], r[3]];
                L::scatter(
                    values,
                    self.rows,
                    indices,
                    L::bits(L::not(L::lt(r[7], L::splat(token, 1.0)))),
                );
            }
        }
    }

    #[test]
    fn gather_and_scatter_agree_on_every_level() {
        let start: Vec<Row> = (0..40)
            .map(|i| {
                let f = i as f32;
                [f, f + 0.5, f * 2.0, 1.0, f * 0.25, 7.0, (i % 2) as f32, (i % 3) as f32]
            })
            .collect();
        let indices: [u32; BLOCK] = core::array::from_fn(|i| (i as u32 * 7 + 3) % 40);
        let mut expected = start.clone();
        for &i in &indices {
            let r = start[i as usize];
            if r[7] >= 1.0 {
                let (x, y) = if r[6] == 0.0 { (r[1], r[0]) } else { (r[0], r[1]) };
                expected[i as usize][..3].copy_from_slice(&[x, y, r[2] + r[4]]);
            }
        }
        for level in SimdLevel::available() {
            let mut rows = start.clone();
            dispatch(level, GatherScatter { rows: SharedRows::new(&mut rows), indices: &indices });
            assert_eq!(rows, expected, "{level}");
        }
    }

    struct Extremes<'a> {
        a: f32,
        b: f32,
        found: &'a mut [[f32; BLOCK]; 4],
    }

    impl LaneKernel for Extremes<'_> {
        type Output = ();

        #[inline(always)]
        fn run<L: Lanes>(self, token: L::Token) {
            let (a, b) = (L::splat(token, self.a), L::splat(token, self.b));
            a.min(b).store(&mut self.found[0]);
            L::select(a.lt(b), a, b).store(&mut self.found[1]);
            a.max(b).store(&mut self.found[2]);
            L::select(a.gt(b), a, b).store(&mut self.found[3]);
        }
    }

    #[test]
    fn the_smaller_and_the_larger_are_compared_and_selected_on_every_level() {
        let values = [0.0, -0.0, 1.5, -2.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -f32::NAN];
        for (a, b) in values.into_iter().flat_map(|a| values.map(|b| (a, b))) {
            for level in SimdLevel::available() {
                let mut found = [[0.0; BLOCK]; 4];
                dispatch(level, Extremes { a, b, found: &mut found });
                let [min, selected_min, max, selected_max] =
                    found.map(|lanes| lanes.map(f32::to_bits));
                assert_eq!((min, max), (selected_min, selected_max), "{a} and {b}, {level}");
            }
        }
    }
}
