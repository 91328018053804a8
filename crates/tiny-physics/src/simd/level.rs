//! Instruction sets and the choice between them.

use super::lanes::{Lanes, Native};
use core::fmt;
use core::str::FromStr;
use fearless_simd::{Level, Simd};

/// The instruction set that the kernels run on. Results are the same on all of them.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
#[non_exhaustive]
pub enum SimdLevel {
    /// One lane, no vector instructions; where every machine has four lanes (64-bit x86), those.
    Scalar,
    /// Four lanes on x86.
    Sse2,
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
    pub const ALL: [Self; 6] =
        [Self::Scalar, Self::Sse2, Self::Avx2, Self::Avx512, Self::Neon, Self::Simd128];

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
            Self::Sse2 | Self::Neon | Self::Simd128 => 4,
            Self::Avx2 => 8,
            Self::Avx512 => 16,
        }
    }

    /// The name used on command lines: `scalar`, `sse2`, `avx2`, `avx512`, `neon`, `simd128`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Sse2 => "sse2",
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
            Level::Sse2(_) | Level::Sse4_2(_) => Self::Sse2,
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => Self::Avx2,
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => Self::Avx512,
            #[cfg(target_arch = "x86")]
            Level::Avx2(_) | Level::Avx512(_) => Self::Sse2,
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => Self::Neon,
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Level::WasmSimd128(_) => Self::Simd128,
            _ => Self::Scalar,
        }
    }

    /// The proof that this machine has the instructions, if it has them.
    #[allow(unreachable_patterns, reason = "each platform has its own part of the levels")]
    fn token(self) -> Option<Level> {
        let best = Level::new();
        match self {
            #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
            Self::Sse2 => best.as_sse2().map(Level::Sse2),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => best.as_avx2().map(Level::Avx2),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => best.as_avx512().map(Level::Avx512),
            #[cfg(target_arch = "aarch64")]
            Self::Neon => best.as_neon().map(Level::Neon),
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            _ => best.as_wasm_simd128().map(Level::WasmSimd128),
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
        // A level of its own once; it gained nothing.
        let name = if name == "sse42" { "sse2" } else { name };
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

/// Runs a kernel on the lanes of `level`, or the widest below it that this machine has.
///
/// Every kernel is built once for each width that it is dispatched to, which is most of the time that the engine takes
/// to build: what gains nothing from more lanes goes through [`dispatch_narrow`] or [`dispatch_baseline`]. Built with
/// `--cfg tiny_physics_quick`, there is one instance, AVX2.
#[inline]
pub(crate) fn dispatch<K: LaneKernel>(level: SimdLevel, kernel: K) -> K::Output {
    #[cfg(all(target_arch = "x86_64", not(tiny_physics_quick)))]
    if let (SimdLevel::Avx512, Some(token)) = (level, Level::new().as_avx512()) {
        return run_native(token, kernel);
    }
    dispatch_narrow(level, kernel)
}

/// The same with at most eight lanes.
#[inline]
pub(crate) fn dispatch_narrow<K: LaneKernel>(level: SimdLevel, kernel: K) -> K::Output {
    #[cfg(all(target_arch = "x86_64", not(tiny_physics_quick)))]
    if let (SimdLevel::Avx2 | SimdLevel::Avx512, Some(token)) = (level, Level::new().as_avx2()) {
        return run_native(token, kernel);
    }
    dispatch_baseline(level, kernel)
}

/// Runs a kernel on the lanes that every machine of this platform has. In wasm that was built with simd128, and on 64-bit
/// x86 but for the engine's own tests, those are four for [`SimdLevel::Scalar`], too.
#[inline]
#[allow(unused_variables, reason = "each platform has its own part of the levels")]
pub(crate) fn dispatch_baseline<K: LaneKernel>(level: SimdLevel, kernel: K) -> K::Output {
    #[cfg(all(target_arch = "x86_64", tiny_physics_quick))]
    match Level::new().as_avx2() {
        Some(token) => run_native(token, kernel),
        None => unreachable!("--cfg tiny_physics_quick is for machines with AVX2"),
    }
    #[cfg(all(target_arch = "x86_64", not(tiny_physics_quick)))]
    match Level::new().as_sse2() {
        #[cfg(test)]
        _ if level == SimdLevel::Scalar => kernel.run::<f32>(()),
        Some(token) => run_native(token, kernel),
        None => unreachable!("64-bit x86 has SSE2"),
    }
    #[cfg(not(target_arch = "x86_64"))]
    match level.token() {
        #[cfg(target_arch = "x86")]
        Some(Level::Sse2(token)) => run_native(token, kernel),
        #[cfg(target_arch = "aarch64")]
        Some(Level::Neon(token)) => run_native(token, kernel),
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        Some(Level::WasmSimd128(token)) => run_native(token, kernel),
        _ => kernel.run::<f32>(()),
    }
}

/// A piece of work on numbers in fours.
pub(crate) trait FourKernel {
    /// Does the work. Implementations must be `#[inline(always)]`.
    fn run<S: Simd>(self, simd: S);
}

/// Runs a kernel with the instructions of `level`, or the best below them that there are for fours.
#[inline]
#[allow(unused_variables, reason = "each platform has its own part of the levels")]
pub(crate) fn dispatch_fours(level: SimdLevel, kernel: impl FourKernel) {
    #[cfg(target_arch = "x86_64")]
    match (Level::new().as_avx2(), Level::new().as_sse2()) {
        (Some(simd), _) if cfg!(tiny_physics_quick) || level.lane_count() > 4 => {
            simd.vectorize(
                #[inline(always)]
                || kernel.run(simd),
            );
        }
        #[cfg(not(tiny_physics_quick))]
        (_, Some(simd)) => kernel.run(simd),
        _ => {
            unreachable!("64-bit x86 has SSE2; --cfg tiny_physics_quick is for machines with AVX2")
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    fearless_simd::dispatch!(Level::new(), simd => kernel.run(simd));
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
