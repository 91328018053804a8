#!/usr/bin/env bash
# Tests what lies in integrations/, and builds its demos: each a workspace of its own. `--tests` leaves the demos with a window out,
# which take the most time. Debian packages for those: pkg-config libasound2-dev libudev-dev libx11-dev.
set -euo pipefail
cd "$(dirname "$0")/../integrations"
# Bits of a release, less to compile.
export RUSTFLAGS="${RUSTFLAGS---cfg tiny_physics_quick}"

(
    cd bevy_tiny_physics
    cargo test -p bevy_tiny_physics --no-default-features
    cargo test -p bevy_tiny_physics --features gizmos,doctor,parallel
    [ "${1-}" = --tests ] || cargo build -p demos --bins
)
