#!/usr/bin/env bash
# Tests what lies in integrations/, and builds what has a window: each a workspace of its own. `--tests` leaves the windows out, which take
# the most time. Debian packages for those: pkg-config libasound2-dev.
set -euo pipefail
cd "$(dirname "$0")/../integrations"
# Bits of a release, less to compile.
export RUSTFLAGS="${RUSTFLAGS---cfg tiny_physics_quick}"

(
    cd macroquad_game
    cargo test --no-default-features
    [ "${1-}" = --tests ] || cargo build
)
(
    cd bevy_tiny_physics
    cargo test -p bevy_tiny_physics --no-default-features
    cargo test -p bevy_tiny_physics --features gizmos,doctor,parallel
    [ "${1-}" = --tests ] || { cargo build -p demos --bins; cargo test -p demos --doc; }
)
