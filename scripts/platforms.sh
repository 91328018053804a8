#!/usr/bin/env bash
# The same bits everywhere: computes the golden hashes of all scenes and quality rows on x86-64 (every SIMD level with
# 1, 2, 3, 4 and 8 threads in a release build, the best level in a debug build), on aarch64 (under qemu-user) and on
# wasm32 with simd128 (in node), and prints one table. Fails where a hash is not the golden one.
#
# Debian 12 packages: rustc-web cargo-web rust-web-src gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user nodejs.
# The standard libraries are built once (about a minute of CPU each) into $TINY_PHYSICS_SYSROOTS, by default
# ~/.cache/tiny-physics-sysroots. Usage: scripts/platforms.sh [x86_64] [aarch64] [wasm32]
set -euo pipefail
cd "$(dirname "$0")/.."
unset RUSTFLAGS
goldens=(crates/scenes/tests/golden.txt crates/quality/tests/golden.txt)
. scripts/sysroot.sh
target_dir=${CARGO_TARGET_DIR:-$PWD/target}

# Puts the platform before lines of `level threads name steps hash`.
label() { sed "s/^/$1 /"; }

hashes_x86_64() {
  cargo build -q --release -p tiny-physics-quality --example hashes
  "$target_dir/release/examples/hashes" 1 2 3 4 8 | label x86_64
  cargo build -q -p tiny-physics-quality --example hashes
  "$target_dir/debug/examples/hashes" --quick 1 2 | label x86_64-debug
}

hashes_aarch64() {
  local target=aarch64-unknown-linux-gnu dir; dir=$(sysroot $target "-Ctarget-feature=+crt-static")
  RUSTC=/usr/bin/rustc CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc \
    CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_RUSTFLAGS="--sysroot $dir -Ctarget-feature=+crt-static" \
    CARGO_TARGET_DIR=$target_dir/platforms \
    cargo build -q --release --target $target -p tiny-physics-quality --example hashes
  qemu-aarch64 "$target_dir/platforms/$target/release/examples/hashes" 1 | label aarch64
  qemu-aarch64 "$target_dir/platforms/$target/release/examples/hashes" --quick 3 | label aarch64
}

hashes_wasm32() {
  local target=wasm32-unknown-unknown dir; dir=$(sysroot $target "-Ctarget-feature=+simd128" optimize_for_size)
  local lld; lld=$(rustc --print sysroot)/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld
  RUSTC=/usr/bin/rustc CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$lld \
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS="--sysroot $dir -Ctarget-feature=+simd128" \
    CARGO_TARGET_DIR=$target_dir/platforms \
    cargo build -q --release --target $target -p tiny-physics-quality --example hashes_wasm
  node scripts/hashes.mjs "$target_dir/platforms/$target/release/examples/hashes_wasm.wasm" "${goldens[@]}" |
    label wasm32
}

# One line a scene: a column a platform and level with one sign a thread count, `=` for the golden hash and `#` for
# another.
print_table() {
  awk '
    FNR == NR { golden[$1] = $3; steps[$1] = $2; names[++count] = $1; next }
    {
      column = $1 " " $2
      if (!(column in seen)) { seen[column] = 1; columns[++width] = column }
      if (index(" " threads[column] " ", " " $3 " ") == 0) threads[column] = threads[column] " " $3
      same = ($4 in golden) && golden[$4] == $6 && steps[$4] == $5
      cell[$4, column] = cell[$4, column] (same ? "=" : "#")
      if (!same) { bad++; other[bad] = $0 }
    }
    END {
      for (c = 1; c <= width; c++) printf "column %d: %s, threads%s\n", c, columns[c], threads[columns[c]]
      printf "\n%-22s %5s  %-16s", "scene", "steps", "hash"
      for (c = 1; c <= width; c++) printf " %-5d", c
      print ""
      for (i = 1; i <= count; i++) {
        printf "%-22s %5d  %s", names[i], steps[names[i]], golden[names[i]]
        for (c = 1; c <= width; c++) printf " %-5s", cell[names[i], columns[c]]
        print ""
      }
      for (i = 1; i <= bad; i++) print "OTHER BITS: " other[i]
      printf "\n%d scenes, %d columns: %s\n", count, width, bad ? bad " hashes differ" : "all hashes are equal"
      exit bad > 0
    }' <(cat "${goldens[@]}") "$1"
}

[ $# -gt 0 ] || set -- x86_64 aarch64 wasm32
lines=$(mktemp)
trap 'rm -f "$lines"' EXIT
for platform in "$@"; do
  start=$SECONDS
  "hashes_$platform" >> "$lines"
  echo "$platform took $((SECONDS - start)) s"
done
print_table "$lines"
