#!/usr/bin/env bash
# Same bits on other architectures: computes the golden hashes on x86-64, on aarch64 (under qemu-user) and on
# wasm32 with simd128 (in node), and compares each with crates/scenes/tests/golden.txt.
#
# Debian 12 packages: rustc-web cargo-web rust-web-src gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user nodejs.
# The standard libraries are built once (about a minute of CPU each) into $TINY_PHYSICS_SYSROOTS, by default
# ~/.cache/tiny-physics-sysroots. Usage: scripts/platforms.sh [x86_64] [aarch64] [wasm32]
set -euo pipefail
cd "$(dirname "$0")/.."
unset RUSTFLAGS
golden=$PWD/crates/scenes/tests/golden.txt
sysroots=${TINY_PHYSICS_SYSROOTS:-$HOME/.cache/tiny-physics-sysroots}
target_dir=${CARGO_TARGET_DIR:-$PWD/target}
version=$(/usr/bin/rustc -vV | sha256sum | cut -c1-16)

# Builds the standard library for a target with Debian's compiler from Debian's source.
sysroot() {
  local target=$1 flags=$2 dir=$sysroots/$version/$1
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
      -Zbuild-std=std,panic_abort -Zbuild-std-features= >&2)
    cp "$work/target/$target/release/deps/"*.rlib "$dir/lib/rustlib/$target/lib/"
    rm -rf "$work"
    touch "$dir/done"
  fi
  echo "$dir"
}

# Compares a table with the golden one.
compare() {
  if diff "$golden" "$2" > /dev/null; then
    echo "$1: all $(wc -l < "$golden") scenes have their golden hashes"
  else
    echo "$1: OTHER BITS"; diff "$golden" "$2" || true; failed=1
  fi
}

hashes_x86_64() {
  cargo build -q --release -p tiny-physics-scenes --example hashes
  "$target_dir/release/examples/hashes"
}

hashes_aarch64() {
  local target=aarch64-unknown-linux-gnu dir; dir=$(sysroot $target "-Ctarget-feature=+crt-static")
  RUSTC=/usr/bin/rustc CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc \
    CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUSTFLAGS="--sysroot $dir -Ctarget-feature=+crt-static" \
    CARGO_TARGET_DIR=$target_dir/platforms \
    cargo build -q --release --target $target -p tiny-physics-scenes --example hashes
  qemu-aarch64 "$target_dir/platforms/$target/release/examples/hashes"
}

hashes_wasm32() {
  local target=wasm32-unknown-unknown dir; dir=$(sysroot $target "-Ctarget-feature=+simd128")
  local lld; lld=$(rustc --print sysroot)/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld
  RUSTC=/usr/bin/rustc CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$lld \
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS="--sysroot $dir -Ctarget-feature=+simd128" \
    CARGO_TARGET_DIR=$target_dir/platforms \
    cargo build -q --release --target $target -p tiny-physics-scenes --example hashes_wasm
  node scripts/hashes.mjs "$target_dir/platforms/$target/release/examples/hashes_wasm.wasm" "$golden"
}

failed=0
[ $# -gt 0 ] || set -- x86_64 aarch64 wasm32
for platform in "$@"; do
  table=$(mktemp)
  "hashes_$platform" > "$table"
  compare "$platform" "$table"
  rm -f "$table"
done
exit $failed
