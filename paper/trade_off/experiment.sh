# What does accuracy cost, and does a finer surrogate find better robots?
part body "10 min, on an idle machine" "an inflated inchworm at every fidelity of both models"
part walls "2 min" "what one layer of elements through a wall misses: two cells and an arch at growing pressure, and the edge of a tube"
part searches "20 min of two cores" "twelve searches of equal cost at four fidelities of the voxels"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
body() {
  menger tradeoff "$study/study.toml" --output "$results/body"
  table "$results/body/tradeoff.csv" "$study/body.csv" '*'  # with seconds, which are the question
}

walls() {
  menger load-cases "$study/walls.toml" --output "$results/walls"
  "$study/walls.py" "$results/walls" "$study/walls.csv"
  "$study/corner.py" "$study/corner.csv"
}

searches() {
  menger tradeoff --search "$study/search.toml" --output "$results/searches"
  table "$results/searches/search.csv" "$study/searches.csv"
}
