#!/usr/bin/env bash
# What the engine weighs: lines, crates, time to build, wasm, compiled kernels. Beside each the budget.
#
# Usage: scripts/budget.sh [--no-builds]
# Times are CPU-seconds of clean builds of the engine alone, its dependencies left out. The wasm module is that of the npm
# package, which scripts/web.sh builds: it says what that needs.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset RUSTFLAGS
engine=tiny-physics

row() { printf '%-58s %10s   %s\n' "$1" "$2" "$3"; }

# CPU-seconds of building the engine, with these options; dependencies are built before.
cpu_seconds() {
  local target=$1
  shift
  cargo build --quiet -p $engine --target-dir "$target" "$@"
  find "$target" \( -name "libtiny_physics*" -o -name "tiny_physics-*" -o -name "tiny-physics-*" \) -prune -exec rm -rf {} +
  TIMEFORMAT='%U %S'
  { time cargo build --quiet -p $engine --target-dir "$target" "$@"; } 2>&1 | awk '{ print int($1 + $2 + 0.5) }'
}

row "what" "now" "budget"
cargo test --quiet -p $engine --test budget -- --nocapture the_engine_is 2>/dev/null | grep -E '^ +[0-9]+  ' | while read -r lines module; do
  case $module in
    together*) row "code lines of the engine" "$lines" 16000 ;;
    *) row "  $module" "$lines" "" ;;
  esac
done
row "crates, the engine's own included" "$(cargo tree -p $engine -e normal --prefix none | sort -u | wc -l)" ""
[ "${1:-}" = --no-builds ] && exit

row "release build, CPU-s" "$(cpu_seconds "$scratch/release" --release)" 35
row "dev build, CPU-s" "$(cpu_seconds "$scratch/dev")" ""
row "dev build with opt-level 3, CPU-s" \
  "$(cpu_seconds "$scratch/dev3" --config 'profile.dev.package.tiny-physics.opt-level=3')" 45
library=$(find "$scratch/release/release" -maxdepth 1 -name 'libtiny_physics.rlib')
row "rlib of the release build, kB" "$(($(stat -c %s "$library") / 1024))" ""
row "compiled kernels" "$(nm -C "$library" 2>/dev/null | grep -c 'fearless_simd.*vectorize' || true)" 50

# "PATH: N bytes, M gzip". Only where its compiler is: installing that is for scripts/web.sh by itself.
if dpkg -s rustc-web >/dev/null 2>&1 && wasm=$(scripts/web.sh npm 2>"$scratch/wasm.log" | grep -E ': [0-9]+ bytes, [0-9]+ gzip'); then
  read -r raw _ gzip _ <<<"${wasm##*: }"
  row "wasm module, whole API, kB" "$((raw / 1000))" ""
  row "wasm module, whole API, gzip, kB" "$((gzip / 1000))" 150
else
  row "wasm module, whole API, gzip, kB" "?" "150 (run scripts/web.sh once: it installs what it needs)"
fi
