#!/usr/bin/env bash
# Measures everything on docs/quality.md anew and writes it there: the others' figures (crates/quality/peers.json), both
# tables, the pictures. It builds Box2D and Rapier and takes minutes. With PEERS_QUICK=1 the workers are built sooner.
set -euo pipefail
cd "$(dirname "$0")/.."
peers() { cargo run --release --quiet --manifest-path peers/Cargo.toml -- "$@"; }

# Puts standard input between the page's lines `<!-- NAME -->` and `<!-- end of NAME -->`.
put() {
  local table
  table=$(mktemp)
  cat > "$table"
  awk -v name="$1" -v table="$table" '
    $0 == "<!-- end of " name " -->" { inside = 0 }
    !inside { print }
    $0 == "<!-- " name " -->" {
      inside = 1
      while ((getline line < table) > 0) print line
    }' docs/quality.md > "$table.page"
  mv "$table.page" docs/quality.md
  rm "$table"
}

peers quality --write > /dev/null
peers quality --markdown | put first
peers quality hard --markdown | put hard
peers plots
