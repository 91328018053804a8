# To be sourced: `sysroot TARGET FLAGS [FEATURES]` builds the standard library for a target with Debian's compiler from
# Debian's source, once (about a minute of CPU), into $TINY_PHYSICS_SYSROOTS (~/.cache/tiny-physics-sysroots), and prints where.
sysroots=${TINY_PHYSICS_SYSROOTS:-$HOME/.cache/tiny-physics-sysroots}
debian_version() { /usr/bin/rustc -vV | sha256sum | cut -c1-16; }

sysroot() {
  local target=$1 flags=$2 features=${3:-} dir; dir=$sysroots/$(debian_version)/$1${3:+-$3}
  if [ ! -e "$dir/done" ]; then
    local work; work=$(mktemp -d)
    local vendor; vendor=$(/usr/bin/rustc --print sysroot)/lib/rustlib/src/rust/library/vendor
    mkdir -p "$work/src" "$work/.cargo" "$dir/lib/rustlib/$target/lib"
    printf '[package]\nname = "empty"\nversion = "0.0.0"\nedition = "2021"\n' > "$work/Cargo.toml"
    echo '#![no_std]' > "$work/src/lib.rs"
    printf '[source.crates-io]\nreplace-with = "vendored"\n[source.vendored]\ndirectory = "%s"\n' "$vendor" \
      > "$work/.cargo/config.toml"
    (cd "$work" && RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_DIR=$work/target \
      RUSTFLAGS="-Cembed-bitcode=yes $flags" /usr/bin/cargo build --offline --release --target "$target" \
      -Zbuild-std=std,panic_abort -Zbuild-std-features="$features" >&2)
    cp "$work/target/$target/release/deps/"*.rlib "$dir/lib/rustlib/$target/lib/"
    rm -rf "$work"
    touch "$dir/done"
  fi
  echo "$dir"
}
