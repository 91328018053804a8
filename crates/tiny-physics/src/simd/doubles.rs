//! Four doubles at a time: matrices of three by three times vectors of three.
//!
//! As everywhere, each number is the sum and product of the same numbers in the same order on all levels.

use fearless_simd::{Simd, SimdBase, f64x4};

/// Three numbers and a zero.
pub(crate) type Three = [f64; 4];

#[inline(always)]
fn load<S: Simd>(simd: S, source: &Three) -> f64x4<S> {
    f64x4::load_array_ref(simd, source)
}

#[inline(always)]
fn scaled<S: Simd>(simd: S, vector: &Three, factor: f64) -> f64x4<S> {
    load(simd, vector) * f64x4::splat(simd, factor)
}

#[inline(always)]
fn product<S: Simd>(simd: S, [x, y, z]: &[Three; 3], v: &Three) -> f64x4<S> {
    scaled(simd, x, v[0]) + scaled(simd, y, v[1]) + scaled(simd, z, v[2])
}

/// Columns times a vector: a matrix, by its columns, or by rows where it is the transposed one.
#[inline(always)]
pub(crate) fn times<S: Simd>(simd: S, columns: &[Three; 3], v: &Three) -> Three {
    product(simd, columns, v).into()
}

/// Adds columns times a vector.
#[inline(always)]
pub(crate) fn add_product<S: Simd>(simd: S, sum: &mut Three, columns: &[Three; 3], v: &Three) {
    *sum = (load(simd, sum) + product(simd, columns, v)).into();
}

/// Takes columns times a vector away.
#[inline(always)]
pub(crate) fn take_product<S: Simd>(simd: S, sum: &mut Three, columns: &[Three; 3], v: &Three) {
    *sum = (load(simd, sum) - product(simd, columns, v)).into();
}

/// Adds a multiple of a vector.
#[inline(always)]
pub(crate) fn add_times<S: Simd>(simd: S, sum: &mut Three, vector: &Three, factor: f64) {
    *sum = (load(simd, sum) + scaled(simd, vector, factor)).into();
}
