#!/usr/bin/env bash
# Does a search in a steady state find as good robots as one by generations, at the same counted work?
#   paper/fractal/selection.sh RESULTS [PROGRAMS] [SEEDS]
# Searches with small studies, each by generations, and in a steady state with one robot and with as many as a generation under
# way; minutes of one core for a seed. `selection.py` makes a table of RESULTS/selection.csv.
set -euo pipefail
results=$1
bin=${2:-build/release/bin}
seeds=${3:-15}
here=$(dirname "$0")
mkdir -p "$results"

one_level='[body]
levels = [1]
[time]
duration_s = 0.4
[population]
'
two_levels='[body]
levels = [1, 2]
[time]
duration_s = 0.2
[population]
survivors = 6
mutants = 6
'

# search STUDY TEXT ARM GENERATIONS THREADS SEED
search() {
  local name=$results/$1.$3.$6
  printf 'preset = "paper"\n%s' "$2" >"$name.toml"
  "$bin/menger-evolve" "$name.toml" -o "$name.sqlite" -g "$4" -t "$5" --seed "$6"
  "$bin/menger-export" "$name.sqlite" -o "$name" --levels 1 --no-frames --no-pictures
}

steady=$'selection = "steady_state"\n'
for seed in $(seq "$seeds"); do
  search one_level "$one_level" generations 40 1 "$seed"
  search one_level "$one_level$steady" steady_1 32 1 "$seed"
  search one_level "$one_level$steady" steady_16 32 16 "$seed"
  search two_levels "$two_levels" generations 20 1 "$seed"
  search two_levels "$two_levels$steady" steady_1 14 1 "$seed"
  search two_levels "$two_levels$steady" steady_7 14 7 "$seed"
done
"$here/selection.py" take "$results" "$results/selection.csv"
