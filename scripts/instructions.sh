#!/usr/bin/env bash
# Instructions of the main kernels, counted by valgrind: the same on a noisy machine as on a quiet one.
#
# Usage: scripts/instructions.sh [--update] [KERNEL...]
# Prints for each kernel the instructions an item, those of crates/tiny-physics/benches/instructions.txt, and the change in per cent.
# A kernel named "solve_X" counts what eight solver iterations more a substep add to "step_X".
# --update writes the new numbers into that file. Needs valgrind; numbers depend a little on the compiler.
set -euo pipefail
cd "$(dirname "$0")/.."
reference=crates/tiny-physics/benches/instructions.txt
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

command -v valgrind > /dev/null || { echo "valgrind is not installed" >&2; exit 1; }
update=false
kernels=()
for argument in "$@"; do
  case $argument in
    --update) update=true ;;
    -*) echo "unknown option $argument" >&2; exit 1 ;;
    *) kernels+=("$argument") ;;
  esac
done

cargo bench --quiet -p tiny-physics --bench instructions --no-run --message-format=json > "$scratch/build"
program=$(grep -o '"executable":"[^"]*"' "$scratch/build" | cut -d'"' -f4 | tail -n 1)
if [ ${#kernels[@]} -eq 0 ]; then
  mapfile -t kernels < <("$program")
fi

# Instructions of a kernel, each counted once; its items in $scratch/KERNEL.items.
count() {
  local out=$scratch/$1
  if [ ! -e "$out" ]; then
    valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='instructions::measured*' \
      "$program" "$1" > "$out.items" 2> "$out.log" || { cat "$out.log" >&2; exit 1; }
    sed -n 's/.*Collected : \([0-9]*\).*/\1/p' "$out.log" > "$out"
  fi
  cat "$out"
}

printf '%-26s %-14s %14s %12s %9s\n' kernel item instructions reference change
for kernel in "${kernels[@]}"; do
  total=$(count "$kernel")
  read -r items item minus < "$scratch/$kernel.items"
  if [ -n "$minus" ]; then
    total=$((total - $(count "$minus")))
  fi
  each=$(awk -v total="$total" -v items="$items" 'BEGIN { printf "%.1f", total / items }')
  before=$(awk -v kernel="$kernel" '$1 == kernel { print $3 }' "$reference" 2> /dev/null || true)
  change=$(awk -v new="$each" -v old="$before" 'BEGIN { if (old > 0) printf "%+.1f %%", (new / old - 1) * 100 }')
  printf '%-26s %-14s %14s %12s %9s\n' "$kernel" "$item" "$each" "${before:--}" "${change:--}"
  printf '%-26s %-14s %s\n' "$kernel" "$item" "$each" >> "$scratch/new"
done

if $update; then
  {
    echo "# Instructions an item, written by scripts/instructions.sh --update with $(rustc -V | cut -d' ' -f1,2)."
    # Kernels that were not counted now keep their numbers.
    [ -e "$reference" ] && awk 'NR == FNR { new[$1] = 1; next } !/^#/ && !($1 in new)' "$scratch/new" "$reference"
    cat "$scratch/new"
  } > "$scratch/table"
  cp "$scratch/table" "$reference"
  echo "written to $reference"
fi
