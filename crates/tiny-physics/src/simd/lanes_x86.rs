//! The lanes of x86: four, eight (AVX2) and sixteen (AVX-512).

use super::lanes::{Lanes, Native, RowSource, RowsOf, portable_operations};
use crate::threads::SharedRows;
use fearless_simd::{
    Avx2, Avx512, Select, Simd, SimdBase, SimdCombine, SimdFloat, SimdMask, SimdSplit, Sse2, f32x4,
    f32x8, f32x16,
};

/// Half of row `i`, from float `AT` on.
#[inline(always)]
fn half_row<const AT: usize, S: Simd>(token: S, rows: &impl RowsOf, i: usize) -> f32x4<S> {
    f32x4::from_slice(token, &rows.row(i)[AT..AT + 4])
}

/// Halves of rows `i` and `i + 4` side by side.
#[inline(always)]
fn half_rows_8<const AT: usize, S: Simd>(token: S, rows: &impl RowsOf, i: usize) -> f32x8<S> {
    half_row::<AT, S>(token, rows, i).combine(half_row::<AT, S>(token, rows, i + 4))
}

/// Halves of rows `i`, `i + 4`, `i + 8` and `i + 12` side by side.
#[inline(always)]
fn half_rows_16<const AT: usize, S: Simd>(token: S, rows: &impl RowsOf, i: usize) -> f32x16<S> {
    half_rows_8::<AT, S>(token, rows, i).combine(half_rows_8::<AT, S>(token, rows, i + 8))
}

/// Eight lanes: AVX2.
impl Lanes for f32x8<Avx2> {
    type Token = Avx2;
    type Mask = <Self as SimdBase<Avx2>>::Mask;
    type Half = f32x4<Avx2>;
    portable_operations!(8);

    #[inline(always)]
    fn half(token: Avx2) -> Avx2 {
        token
    }

    #[inline(always)]
    fn gather(token: Avx2, rows: impl RowSource, indices: &[u32]) -> [Self; 8] {
        let rows = &rows.at::<8>(indices);
        let [a, b, c, d] = transpose4_in_blocks_avx2(
            token,
            half_rows_8::<0, _>(token, rows, 0),
            half_rows_8::<0, _>(token, rows, 1),
            half_rows_8::<0, _>(token, rows, 2),
            half_rows_8::<0, _>(token, rows, 3),
        );
        let [e, f, g, h] = transpose4_in_blocks_avx2(
            token,
            half_rows_8::<4, _>(token, rows, 0),
            half_rows_8::<4, _>(token, rows, 1),
            half_rows_8::<4, _>(token, rows, 2),
            half_rows_8::<4, _>(token, rows, 3),
        );
        [a, b, c, d, e, f, g, h]
    }

    #[inline(always)]
    fn scatter(values: [Self; 4], rows: SharedRows<'_>, indices: &[u32], write: u32) {
        use fearless_simd::ExtractToken;
        let [a, b, c, d] = values;
        let t = transpose4_in_blocks_avx2(a.token(), a, b, c, d).map(SimdSplit::split);
        let mut halves = [[0.0; 4]; 8];
        for (i, (low, high)) in t.into_iter().enumerate() {
            halves[i] = low.into();
            halves[i + 4] = high.into();
        }
        rows.write_halves(indices, &halves, write);
    }
}

fearless_simd::kernel!(
    /// Transposes the 4 x 4 squares in both halves: eight shuffles, where the portable zips, which
    /// cross the halves, would take sixteen.
    #[inline(always)]
    fn transpose4_in_blocks_avx2(
        token: Avx2,
        a: f32x8<Avx2>,
        b: f32x8<Avx2>,
        c: f32x8<Avx2>,
        d: f32x8<Avx2>,
    ) -> [f32x8<Avx2>; 4] {
        #[cfg(target_arch = "x86")]
        use core::arch::x86::*;
        #[cfg(target_arch = "x86_64")]
        use core::arch::x86_64::*;
        use fearless_simd::SimdInto;
        let (a, b, c, d): (__m256, __m256, __m256, __m256) =
            (a.into(), b.into(), c.into(), d.into());
        let (ab_low, ab_high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (cd_low, cd_high) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0b01_00_01_00>(ab_low, cd_low).simd_into(token),
            _mm256_shuffle_ps::<0b11_10_11_10>(ab_low, cd_low).simd_into(token),
            _mm256_shuffle_ps::<0b01_00_01_00>(ab_high, cd_high).simd_into(token),
            _mm256_shuffle_ps::<0b11_10_11_10>(ab_high, cd_high).simd_into(token),
        ]
    }
);

/// Sixteen lanes: AVX-512.
impl Lanes for f32x16<Avx512> {
    type Token = Avx512;
    type Mask = <Self as SimdBase<Avx512>>::Mask;
    type Half = f32x8<Avx2>;
    portable_operations!(16);

    #[inline(always)]
    fn half(token: Avx512) -> Avx2 {
        match token.level().as_avx2() {
            Some(token) => token,
            None => unreachable!("AVX-512 has AVX2"),
        }
    }

    #[inline(always)]
    fn gather(token: Avx512, rows: impl RowSource, indices: &[u32]) -> [Self; 8] {
        let rows = &rows.at::<16>(indices);
        let [a, b, c, d] = transpose4_in_blocks_avx512(
            token,
            half_rows_16::<0, _>(token, rows, 0),
            half_rows_16::<0, _>(token, rows, 1),
            half_rows_16::<0, _>(token, rows, 2),
            half_rows_16::<0, _>(token, rows, 3),
        );
        let [e, f, g, h] = transpose4_in_blocks_avx512(
            token,
            half_rows_16::<4, _>(token, rows, 0),
            half_rows_16::<4, _>(token, rows, 1),
            half_rows_16::<4, _>(token, rows, 2),
            half_rows_16::<4, _>(token, rows, 3),
        );
        [a, b, c, d, e, f, g, h]
    }

    #[inline(always)]
    fn scatter(values: [Self; 4], rows: SharedRows<'_>, indices: &[u32], write: u32) {
        use fearless_simd::ExtractToken;
        let [a, b, c, d] = values;
        let t = transpose4_in_blocks_avx512(a.token(), a, b, c, d).map(|v| {
            let (low, high) = v.split();
            (low.split(), high.split())
        });
        let mut halves = [[0.0; 4]; 16];
        for (i, (low, high)) in t.into_iter().enumerate() {
            halves[i] = low.0.into();
            halves[i + 4] = low.1.into();
            halves[i + 8] = high.0.into();
            halves[i + 12] = high.1.into();
        }
        rows.write_halves(indices, &halves, write);
    }
}

fearless_simd::kernel!(
    /// Transposes the 4 x 4 squares in all four quarters.
    #[inline(always)]
    fn transpose4_in_blocks_avx512(
        token: Avx512,
        a: f32x16<Avx512>,
        b: f32x16<Avx512>,
        c: f32x16<Avx512>,
        d: f32x16<Avx512>,
    ) -> [f32x16<Avx512>; 4] {
        #[cfg(target_arch = "x86")]
        use core::arch::x86::*;
        #[cfg(target_arch = "x86_64")]
        use core::arch::x86_64::*;
        use fearless_simd::SimdInto;
        let (a, b, c, d): (__m512, __m512, __m512, __m512) =
            (a.into(), b.into(), c.into(), d.into());
        let (ab_low, ab_high) = (_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
        let (cd_low, cd_high) = (_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
        [
            _mm512_shuffle_ps::<0b01_00_01_00>(ab_low, cd_low).simd_into(token),
            _mm512_shuffle_ps::<0b11_10_11_10>(ab_low, cd_low).simd_into(token),
            _mm512_shuffle_ps::<0b01_00_01_00>(ab_high, cd_high).simd_into(token),
            _mm512_shuffle_ps::<0b11_10_11_10>(ab_high, cd_high).simd_into(token),
        ]
    }
);

impl Native for Sse2 {
    type Lanes = f32x4<Self>;
}
impl Native for Avx2 {
    type Lanes = f32x8<Self>;
}
impl Native for Avx512 {
    type Lanes = f32x16<Self>;
}
