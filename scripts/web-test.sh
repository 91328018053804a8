#!/usr/bin/env bash
# Tests the npm package and the playground: in Node, in Debian's Chromium without a display, as others install it, and
# against the hashes of the native engine. Installs what it needs; `scripts/web.sh` is run first. Pictures to look at are left in
# target/web-pictures.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
unset RUSTFLAGS
dpkg -s chromium >/dev/null 2>&1 || {
  apt-get update -q || true
  apt-get install -y -q --no-install-recommends -o DPkg::Lock::Timeout=300 chromium
}
[ "${1:-}" = --built ] || scripts/web.sh
scripts/web-size.sh

# Bits are those of a release.
native() { RUSTFLAGS="--cfg tiny_physics_quick" cargo build -q --profile quick "$@"; }
native -p tiny-physics-scenes --example state_hashes --example record_scene
hashes=$(mktemp) recording=$(mktemp --suffix .tpr)
trap 'rm -f "$hashes" "$recording"' EXIT
target/quick/examples/state_hashes 300 > "$hashes"
end=$(target/quick/examples/record_scene wrecking_ball 120 "$recording")

(cd web/test && { [ -d node_modules ] || npm install --no-audit --no-fund --silent; })
node --test web/test/package.test.mjs
node web/test/hashes.mjs 300 web/playground/dist/tiny_physics.wasm < "$hashes"
web/test/install.sh
node web/test/page.mjs "$hashes" "$recording" "$end" "$root/target/web-pictures"
