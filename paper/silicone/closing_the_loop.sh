#!/usr/bin/env bash
# Runs closing_the_loop.toml from three seeds in two ways and compares what they find on finite elements: corrected on the way, and
# on the surrogate alone with as many robots judged at the end. Goes on where it was stopped.
#   paper/silicone/closing_the_loop.sh [folder of the results] [folder of the programs]
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=${1:-closing_the_loop}
programs=${2:-$study/../../build/release/bin}
menger=$(cd "$programs" && pwd)/menger
budget=$(sed -n 's/^budget_element_steps = \([^ ]*\).*/\1/p' "$study/closing_the_loop.toml")
mkdir -p "$out"

# The surrogate alone: the same study without its judge, beside the files that it names.
sed -e '/^# Before every sixth/,$d' -e "s|\"../../|\"$study/../../|" "$study/closing_the_loop.toml" >"$out/surrogate.toml"

searches=()
for seed in 1 2 3; do
  "$menger" evolve "$study/closing_the_loop.toml" --seed $seed -o "$out/corrected_$seed.sqlite"
  "$menger" export "$out/corrected_$seed.sqlite" -o "$out/corrected_$seed" --levels 1 --no-frames --no-pictures
  "$menger" evolve "$out/surrogate.toml" --seed $seed -o "$out/surrogate_$seed.sqlite"
  "$menger" export "$out/surrogate_$seed.sqlite" -o "$out/surrogate_$seed" --levels 1 --no-frames --no-pictures
  # It ends with 3 if no robot completed, which is an outcome.
  "$menger" reevaluate "$out/surrogate_$seed.sqlite" --top 16 --study "$study/closing_the_loop_judge.toml" \
    -o "$out/surrogate_$seed" --no-pictures || [ $? -eq 3 ]
  searches+=("$out/corrected_$seed" "$out/surrogate_$seed")
done
"$menger" compare-searches "${searches[@]}" -o "$out" --budget-element-steps "$budget"
