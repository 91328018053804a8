#!/usr/bin/env bash
# Packages every crate that is meant for crates.io and builds it from its package, as `cargo publish` would: those that need each other, too.
# Nothing is sent. `--send` publishes, once the repository's address is set. Needs Rust 1.90 or later.
set -euo pipefail
cd "$(dirname "$0")/.."

address=$(sed -n 's/^repository = "\(.*\)"/\1/p' Cargo.toml)
# Other workspaces cannot take it from there.
for manifest in integrations/bevy_tiny_physics/Cargo.toml; do
    grep -qxF "repository = \"$address\"" "$manifest" || { echo "$manifest: the repository is not $address" >&2; exit 1; }
done

# Lists are long; what must be in every one of them is looked for.
for crate in tiny-physics tiny-physics-{doctor,draw,scenes,quality,batch,cli}; do
    list=$(cargo package --list --allow-dirty -p "$crate")
    for file in README.md LICENSE-MIT LICENSE-APACHE CHANGELOG.md; do
        grep -qx "$file" <<<"$list" || { echo "$crate: no $file in the package" >&2; exit 1; }
    done
done

if [ "${1-}" = --send ]; then
    [[ $address != *.invalid* ]] || { echo "set the repository's address in Cargo.toml first" >&2; exit 1; }
    exec cargo publish --workspace
fi
cargo publish --workspace --dry-run --allow-dirty
