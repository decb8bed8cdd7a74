# Do the winners of a search on calibrated voxels walk on finite elements?
part walks "1 h of two cores" "a hundred generations, and 22 of their robots on finite elements"
part_on_request small "10 min of two cores" "thirty generations, and their three best robots on finite elements"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
walks() {
  menger evolve "$study/study.toml" --generations 100 --output "$results/search.sqlite"
  menger reevaluate "$results/search.sqlite" --top 10 --sample 12 --study "$study/reevaluation.toml" --output "$results/reevaluated"
  table "$results/reevaluated/reevaluation.csv" "$study/walks.csv"
  table "$results/reevaluated/ranking.csv" "$study/ranking.csv"
  table "$results/reevaluated/variants.csv" "$study/variants.csv"
}

small() {
  menger evolve "$study/study.toml" --output "$results/small.sqlite"
  menger reevaluate "$results/small.sqlite" --top 3 --study "$study/reevaluation_short.toml" --output "$results/small"
}
