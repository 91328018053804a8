#!/usr/bin/env bash
# How much of a step is left to one thread, counted by instructions: the same on a noisy machine as on a quiet one.
#
# Usage: scripts/serial-share.sh [--steps N] [--functions] [SCENE...]
# Serial is what the thread that called `World::step` does outside of chunks, on two threads, without the waiting; a stage that is too small
# to share out is serial. Prints the share of all that a step takes on one thread, and how many times as fast 2, 4, 8 and 16 threads can then
# be at best (Amdahl's law; memory, waking and uneven chunks come on top). --functions lists where it goes. Needs valgrind.
set -euo pipefail
cd "$(dirname "$0")/.."
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

command -v valgrind > /dev/null || { echo "valgrind is not installed" >&2; exit 1; }
steps=100
functions=false
scenes=()
while [ $# -gt 0 ]; do
  case $1 in
    --steps) steps=$2; shift ;;
    --functions) functions=true ;;
    -*) echo "unknown option $1" >&2; exit 1 ;;
    *) scenes+=("$1") ;;
  esac
  shift
done
[ ${#scenes[@]} -gt 0 ] || scenes=(large_pyramid many_pyramids joint_grid rain smash spinner tumbler seed_pile_5000 circles_10k)

cargo build --release --quiet
program=target/release/tiny-physics

# collect NAME THREADS OPTION...: instructions of the calling thread in $scratch/NAME-01 (one thread: $scratch/NAME).
collect() {
  local name=$1 threads=$2
  shift 2
  valgrind --tool=callgrind --callgrind-out-file="$scratch/$name" --toggle-collect='*World*try_step*' "$@" \
    "$program" run "$scene" --steps "$steps" --threads "$threads" > /dev/null 2> "$scratch/log" || { cat "$scratch/log" >&2; exit 1; }
}

instructions() {
  sed -n 's/^totals: //p' "$1" | head -n 1
}

printf '%-24s %6s %14s %8s %22s\n' scene steps 'instructions' serial 'at most, 2 4 8 16'
for scene in "${scenes[@]}"; do
  collect whole 1
  collect shared 2 --separate-threads=yes --toggle-collect='*Shared*take_part*' --toggle-collect='*Shared*wait_for_the_others*'
  awk -v scene="$scene" -v steps="$steps" -v whole="$(instructions "$scratch/whole")" -v serial="$(instructions "$scratch/shared-01")" '
    function times(threads) { return 1 / (share + (1 - share) / threads) }
    BEGIN {
      share = serial / whole
      printf "%-24s %6s %12.1f M %6.1f %% %7.2f %4.1f %4.1f %4.1f\n", scene, steps, whole / 1e6, share * 100, times(2), times(4), times(8), times(16)
    }'
  if $functions; then
    callgrind_annotate --threshold=90 "$scratch/shared-01" | grep -E '^ *[0-9,]+ \(' | sed -n 1,30p | sed 's/ \[.*//'
  fi
done
