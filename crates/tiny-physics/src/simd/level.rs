//! Instruction sets and the choice between them.

use super::lanes::{Lanes, Native};
use core::fmt;
use core::str::FromStr;
use fearless_simd::Level;

/// The instruction set that the kernels run on. Results are the same on all of them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
#[non_exhaustive]
pub enum SimdLevel {
    /// One lane, no vector instructions.
    Scalar,
    /// Four lanes on x86.
    Sse2,
    /// Four lanes on x86 with the shuffles of SSE4.2.
    Sse42,
    /// Eight lanes on x86.
    Avx2,
    /// Sixteen lanes on x86 (Ice Lake and later).
    Avx512,
    /// Four lanes on 64-bit Arm.
    Neon,
    /// Four lanes on WebAssembly.
    Simd128,
}

impl SimdLevel {
    /// Every level there is, on any platform.
    pub const ALL: [Self; 7] = [
        Self::Scalar,
        Self::Sse2,
        Self::Sse42,
        Self::Avx2,
        Self::Avx512,
        Self::Neon,
        Self::Simd128,
    ];

    /// The best level of this machine.
    pub fn detect() -> Self {
        Self::of(Level::new())
    }

    /// The levels that this machine can run, scalar first, best last.
    pub fn available() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|level| level.is_available())
    }

    /// Can this machine run it?
    pub fn is_available(self) -> bool {
        self == Self::Scalar || self.token().is_some()
    }

    /// Number of `f32` lanes.
    pub fn lane_count(self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::Sse2 | Self::Sse42 | Self::Neon | Self::Simd128 => 4,
            Self::Avx2 => 8,
            Self::Avx512 => 16,
        }
    }

    /// The name used on command lines: `scalar`, `sse2`, `sse42`, `avx2`, `avx512`, `neon`, `simd128`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Sse2 => "sse2",
            Self::Sse42 => "sse42",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
            Self::Neon => "neon",
            Self::Simd128 => "simd128",
        }
    }

    /// The level with the fewest lanes, up to those of this one, that takes so many at once: for a few contacts wide
    /// lanes gather and scatter for nothing.
    #[inline]
    pub(crate) fn for_count(self, count: usize) -> Self {
        match self {
            _ if count == 1 => Self::Scalar,
            Self::Avx2 | Self::Avx512 if count <= 4 => Self::Sse2,
            Self::Avx512 if count <= 8 => Self::Avx2,
            _ => self,
        }
    }

    #[allow(unreachable_patterns, reason = "each platform has its own part of the levels")]
    fn of(level: Level) -> Self {
        match level {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse2(_) => Self::Sse2,
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Sse4_2(_) => Self::Sse42,
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx2(_) => Self::Avx2,
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Level::Avx512(_) => Self::Avx512,
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => Self::Neon,
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Level::WasmSimd128(_) => Self::Simd128,
            _ => Self::Scalar,
        }
    }

    /// The proof that this machine has the instructions, if it has them.
    fn token(self) -> Option<Level> {
        let best = Level::new();
        match self {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Sse2 => best.as_sse2().map(Level::Sse2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Sse42 => best.as_sse4_2().map(Level::Sse4_2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Avx2 => best.as_avx2().map(Level::Avx2),
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Avx512 => best.as_avx512().map(Level::Avx512),
            #[cfg(target_arch = "aarch64")]
            Self::Neon => best.as_neon().map(Level::Neon),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Self::Simd128 => best.as_wasm_simd128().map(Level::WasmSimd128),
            _ => None,
        }
    }
}

impl Default for SimdLevel {
    fn default() -> Self {
        Self::detect()
    }
}

impl fmt::Display for SimdLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for SimdLevel {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|level| level.name() == name).ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|level| level.name()).collect();
            format!("no SIMD level is called '{name}'; there are {}", names.join(", "))
        })
    }
}

/// A piece of work written once over lanes. The fields of the implementing type are its arguments.
pub(crate) trait LaneKernel {
    /// What it gives back.
    type Output;
    /// Does the work. Implementations must be `#[inline(always)]`.
    fn run<L: Lanes>(self, token: L::Token) -> Self::Output;
}

/// Runs a kernel on the lanes of `level`; on one lane where the machine lacks the level.
///
/// Built with `--cfg tiny_physics_quick`, there are two instances only, one lane and AVX2: a third of the time to build.
#[inline]
#[allow(unreachable_patterns, reason = "each platform has its own part of the levels")]
pub(crate) fn dispatch<K: LaneKernel>(level: SimdLevel, kernel: K) -> K::Output {
    #[cfg(tiny_physics_quick)]
    if level != SimdLevel::Scalar
        && let Some(token) = Level::new().as_avx2()
    {
        return run_native(token, kernel);
    }
    #[cfg(tiny_physics_quick)]
    return kernel.run::<f32>(());

    #[cfg(not(tiny_physics_quick))]
    match level.token() {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Some(Level::Sse2(token)) => run_native(token, kernel),
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Some(Level::Sse4_2(token)) => run_native(token, kernel),
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Some(Level::Avx2(token)) => run_native(token, kernel),
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        Some(Level::Avx512(token)) => run_native(token, kernel),
        #[cfg(target_arch = "aarch64")]
        Some(Level::Neon(token)) => run_native(token, kernel),
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        Some(Level::WasmSimd128(token)) => run_native(token, kernel),
        _ => kernel.run::<f32>(()),
    }
}

/// Builds the kernel with the instruction set of its token.
#[inline]
fn run_native<S: Native, K: LaneKernel>(simd: S, kernel: K) -> K::Output {
    simd.vectorize(
        #[inline(always)]
        || kernel.run::<S::Lanes>(simd),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip() {
        for level in SimdLevel::ALL {
            assert_eq!(level.name().parse(), Ok(level));
        }
        assert!("mmx".parse::<SimdLevel>().unwrap_err().contains("'mmx'"));
    }

    #[test]
    fn scalar_is_always_there() {
        assert_eq!(SimdLevel::available().next(), Some(SimdLevel::Scalar));
        assert!(SimdLevel::detect().is_available());
    }
}
