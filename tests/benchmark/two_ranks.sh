#!/usr/bin/env bash
# How many times as fast is a search with two ranks of a thread as with one? Three pairs in turn, of the times of all generations.
# Nothing else may run on the machine, which has two cores at least.
#   tests/benchmark/two_ranks.sh [folder of the programs]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
programs=$(cd "${1:-$here/../../build/release/bin}" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

seconds() {
  rm -f "$folder"/run.*
  mpirun --oversubscribe --bind-to core -n "$1" "$programs/menger-evolve" "$here/two_ranks.toml" -o "$folder/run.sqlite" -t 1 >/dev/null
  "$programs/menger-export" "$folder/run.sqlite" -o "$folder/out" --timings --levels 1 --no-frames --no-pictures >/dev/null
  awk -F, 'FNR == 1 { for (i = 1; i <= NF; ++i) if ($i == "wall_seconds") at = i; next } $2 == 2 { sum += $at } END { print sum }' "$folder/out/schedule.csv"
}

for pair in 1 2 3; do
  one=$(seconds 1)
  two=$(seconds 2)
  awk -v pair="$pair" -v one="$one" -v two="$two" 'BEGIN { printf "pair %d: %.2f s with one rank, %.2f s with two: %.2f times\n", pair, one, two, one / two }'
done
