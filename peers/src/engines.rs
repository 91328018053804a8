//! The engines and configurations, and how each is built.

use std::path::PathBuf;
use std::process::Command;

/// One engine in one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// What `--engines` calls it.
    pub name: &'static str,
    /// The engine.
    pub engine: &'static str,
    /// The configuration.
    pub config: &'static str,
    /// What is passed to the worker at run time.
    pub setting: &'static str,
    package: &'static str,
    features: &'static [&'static str],
    /// Features for more than one thread.
    thread_features: &'static [&'static str],
    rust_flags: &'static str,
    needs_avx2: bool,
    by_default: bool,
}

const OURS: Config = Config {
    name: "ours",
    engine: "tiny-physics",
    config: "default",
    setting: "",
    package: "peer-ours",
    features: &[],
    thread_features: &[],
    rust_flags: "",
    needs_avx2: false,
    by_default: true,
};

const BOX2D: Config =
    Config { name: "box2d-sse2", engine: "Box2D", config: "SSE2", package: "peer-box2d", ..OURS };

const RAPIER: Config = Config {
    name: "rapier",
    engine: "Rapier",
    package: "peer-rapier",
    thread_features: &["parallel"],
    ..OURS
};

/// Everything that can be compared; the first is what ratios refer to where it runs.
const ALL: [Config; 11] = [
    OURS,
    Config { name: "ours-scalar", config: "scalar", setting: "scalar", by_default: false, ..OURS },
    Config { name: "ours-sse2", config: "SSE2", setting: "sse2", by_default: false, ..OURS },
    Config { name: "ours-avx2", config: "AVX2", setting: "avx2", by_default: false, ..OURS },
    Config { name: "ours-avx512", config: "AVX-512", setting: "avx512", by_default: false, ..OURS },
    BOX2D,
    Config { name: "box2d-avx2", config: "AVX2", features: &["avx2"], needs_avx2: true, ..BOX2D },
    RAPIER,
    Config {
        name: "rapier-frames",
        config: "serde",
        features: &["frames"],
        by_default: false,
        ..RAPIER
    },
    Config {
        name: "rapier-v3",
        config: "x86-64-v3",
        rust_flags: "-Ctarget-cpu=x86-64-v3",
        needs_avx2: true,
        by_default: false,
        ..RAPIER
    },
    Config {
        name: "rapier-simd8",
        config: "simd8, x86-64-v3",
        features: &["simd8"],
        rust_flags: "-Ctarget-cpu=x86-64-v3",
        needs_avx2: true,
        ..RAPIER
    },
];

/// The configurations named, or the default ones that this machine can run.
///
/// # Errors
/// A name that is not known.
pub fn select(names: &[String]) -> Result<Vec<Config>, String> {
    if names.is_empty() {
        return Ok(ALL
            .into_iter()
            .filter(|c| c.by_default && (has_avx2() || !c.needs_avx2))
            .collect());
    }
    let find = |name: &String| {
        let found = ALL.iter().find(|config| config.name == name).copied();
        let known = || ALL.map(|config| config.name).join(", ");
        found.ok_or_else(|| format!("no engine {name}; there are: {}", known()))
    };
    names.iter().map(find).collect()
}

fn has_avx2() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("avx2");
    #[cfg(not(target_arch = "x86_64"))]
    return false;
}

impl Config {
    /// Builds the worker program.
    ///
    /// Flags for the C compiler and for rustc come from here alone: `boxdd-sys` by itself compiles
    /// Box2D with assertions and `-O2`, and a user's own `RUSTFLAGS` would make the comparison unfair.
    ///
    /// # Errors
    /// The build fails.
    pub fn build(&self, threads: usize) -> Result<(), String> {
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["build", "--profile", profile(), "--quiet", "--package", self.package]);
        cargo.arg("--manifest-path").arg(home().join("Cargo.toml"));
        cargo.arg("--target-dir").arg(self.folder(threads));
        let features: Vec<_> = self.features.iter().chain(self.extra_features(threads)).collect();
        for feature in features {
            cargo.args(["--features", feature]);
        }
        cargo.env_remove("CARGO_ENCODED_RUSTFLAGS").env_remove("CARGO_BUILD_TARGET");
        let quick = if is_quick() { "--cfg tiny_physics_quick " } else { "" };
        cargo.env("RUSTFLAGS", format!("{quick}{}", self.rust_flags).trim());
        cargo.env("CFLAGS", "-O3 -DNDEBUG");
        match cargo.status() {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => Err(format!("{} does not build: {status}", self.name)),
            Err(error) => Err(format!("cannot start cargo: {error}")),
        }
    }

    /// The worker program.
    pub fn program(&self, threads: usize) -> PathBuf {
        let file = format!("{}{}", self.package, std::env::consts::EXE_SUFFIX);
        self.folder(threads).join(profile()).join(file)
    }

    /// The build folder: one for each set of flags and features, so that none undoes another. Engines share it.
    fn folder(&self, threads: usize) -> PathBuf {
        let mut name = "plain".to_owned();
        for part in self.features.iter().chain(self.extra_features(threads)) {
            name = name + "-" + part;
        }
        if !self.rust_flags.is_empty() {
            name += "-v3";
        }
        home().join("target").join(name)
    }

    fn extra_features(&self, threads: usize) -> &'static [&'static str] {
        if threads > 1 { self.thread_features } else { &[] }
    }
}

/// Is the environment's `PEERS_QUICK` set? Then workers are built sooner and are slower: for what is not timed.
fn is_quick() -> bool {
    std::env::var_os("PEERS_QUICK").is_some()
}

fn profile() -> &'static str {
    if is_quick() { "quick" } else { "release" }
}

/// The folder of this workspace.
fn home() -> PathBuf {
    env!("CARGO_MANIFEST_DIR").into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_build_folders_are_apart() {
        for (i, a) in ALL.iter().enumerate() {
            for b in &ALL[..i] {
                assert_ne!(a.name, b.name);
                let same_build = a.package == b.package
                    && a.features == b.features
                    && a.rust_flags == b.rust_flags;
                assert_eq!(a.program(1) == b.program(1), same_build, "{} {}", a.name, b.name);
            }
        }
        assert_ne!(RAPIER.folder(1), RAPIER.folder(2));
    }

    #[test]
    fn selection_knows_its_names() {
        let names = ["rapier".to_owned(), "box2d-avx2".to_owned()];
        let picked = select(&names).expect("both are known");
        assert_eq!((picked[0].name, picked[1].name), ("rapier", "box2d-avx2"));
        assert!(select(&["bullet".to_owned()]).is_err());
        assert_eq!(select(&[]).expect("defaults")[0].name, "ours");
    }
}
