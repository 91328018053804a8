#!/usr/bin/env bash
# Builds the npm package web/npm (tiny_physics.wasm) and the playground web/playground/dist with Debian's packages, which
# it installs where they are missing. `scripts/web.sh npm` builds the package alone, `--quick` a larger module in less
# time, for trying things; bits are the same.
set -euo pipefail
cd "$(dirname "$0")/.."
unset RUSTFLAGS
. scripts/sysroot.sh

packages() {
  local missing=() package
  for package in "$@"; do
    dpkg -s "$package" >/dev/null 2>&1 || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  local sudo=; [ "$(id -u)" = 0 ] || sudo=sudo
  $sudo apt-get update -q || true # another may be at it
  $sudo apt-get install -y -q --no-install-recommends -o DPkg::Lock::Timeout=300 "${missing[@]}"
}

# module FEATURES OUTPUT: one wasm file.
module() {
  local features=$1 output=$2 target=wasm32-unknown-unknown dir
  dir=$(sysroot $target "-Ctarget-feature=+simd128" optimize_for_size)
  local lld; lld=$(rustc --print sysroot)/lib/rustlib/x86_64-unknown-linux-gnu/bin/rust-lld
  local target_dir=${CARGO_TARGET_DIR:-$PWD/target/web}
  RUSTC=/usr/bin/rustc CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=$lld \
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS="--sysroot $dir -Ctarget-feature=+simd128" \
    CARGO_TARGET_DIR=$target_dir \
    cargo build -q --manifest-path web/Cargo.toml --lib --profile "$profile" --target $target --features "$features"
  local built=$target_dir/$target/$profile/tiny_physics_web.wasm
  mkdir -p "$(dirname "$output")"
  # What was tried to make it smaller, with figures, is in web/SIZE.md.
  cp "$built" "$output"
  printf '%s: %d bytes, %d gzip\n' "$output" "$(stat -c %s "$output")" "$(gzip -9 -c "$output" | wc -c)"
}

profile=release what=all
for word in "$@"; do
  case $word in
    --quick) profile=quick ;;
    npm | playground) what=$word ;;
    *) echo "usage: scripts/web.sh [--quick] [npm | playground]" >&2; exit 2 ;;
  esac
done

packages rustc-web cargo-web rust-web-src
# Node from elsewhere brings its own npm, beside which Debian's cannot be.
command -v npm >/dev/null || packages nodejs npm
if [ $what != playground ]; then
  module "" web/npm/tiny_physics.wasm
fi
if [ $what != npm ]; then
  module playground web/playground/public/tiny_physics.wasm
  (cd web/playground && { [ -d node_modules ] || npm ci --no-audit --no-fund; } && npm run -s build)
  # From here the program takes them, for `tiny-physics play`.
  git clean -fdxq crates/cli/playground && cp -r web/playground/dist/. crates/cli/playground
fi
