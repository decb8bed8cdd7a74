#!/usr/bin/env bash
# Lets the fuzzer of one reader run: fuzz_reader.sh READER SECONDS, as ./run fuzz does. Prints a line with the number of executions; a
# fault ends it with 1, and the file that leads to it stays in build/fuzz/found.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
reader=$1
seconds=$2

work=build/fuzz/work/$reader  # what this and earlier runs found to be different from all others
seeds=build/fuzz/seeds/$reader
found=build/fuzz/found
mkdir -p "$work" "$found"
rm -rf "$seeds"
mkdir -p "$seeds"
for seed in $(sed -n "s/^$reader //p" tests/fuzz/seeds.txt); do  # patterns, which the shell replaces by names
  cp "$seed" "$seeds/${seed//\//_}"
done
folders=("$work" "$seeds")
[ ! -d "tests/fuzz/corpus/$reader" ] || folders+=("tests/fuzz/corpus/$reader")

options=()
[ -z "${MENGER_FUZZ_SEED:-}" ] || options+=("-seed=$MENGER_FUZZ_SEED")
[ ! -w /dev/shm ] || export TMPDIR=/dev/shm  # each execution writes a file
log=$found/$reader.log
if ! build/fuzz/bin/fuzz-readers "$reader" "${folders[@]}" "${options[@]}" -max_total_time="$seconds" -timeout=20 \
  -rss_limit_mb=3000 -print_final_stats=1 -artifact_prefix="$found/$reader-" >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  printf 'fuzz: %s: a fault; the file is in %s, all messages in %s\n' "$reader" "$found" "$log" >&2
  exit 1
fi
printf '%-12s %10s executions\n' "$reader" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")"
