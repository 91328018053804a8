//! Lanes: one kernel source, run at the width that the machine has.
//!
//! A kernel is a function generic over [`Lanes`], a small vector of `f32`. [`SimdLevel`] names the
//! instruction set, chosen at run time, and [`dispatch`] calls a kernel with the lane type of
//! that level: 1 (scalar), 4 (SSE2, NEON, wasm), 8 (AVX2) or 16 lanes (AVX-512).
//!
//! Every level gives the same bits: operations are the exactly rounded ones of IEEE 754, `min` and
//! `max` are compare-and-select, there is no fused multiply-add and no estimate, and nothing is summed
//! across lanes.
//!
//! Functions over lanes must be `#[inline(always)]` (and hand no closures to `array::map` and its like): only then
//! does the compiler build them with the instruction set of the kernel that they end up in.

mod doubles;
mod lanes;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod lanes_x86;
mod level;

pub(crate) use doubles::{Three, add_product, add_times, take_product, times};
pub(crate) use fearless_simd::Simd;
pub(crate) use lanes::{BLOCK, Lanes, Row, RowSource, RowsOf};
pub use level::SimdLevel;
pub(crate) use level::{
    FourKernel, LaneKernel, dispatch, dispatch_baseline, dispatch_fours, dispatch_narrow,
};
