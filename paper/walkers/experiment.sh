# Do robots that finite elements chose in a search walk alike on finer elements?
part walkers "3 min of two cores" "ten generations on draft elements, and the five best on standard and fine ones"
part_on_request screened "8 min of two cores" "the same with more children, which voxels screen"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
walkers() {
  menger evolve "$study/study.toml" --output "$results/search.sqlite"
  menger export "$results/search.sqlite" --output "$results/search" --timings
  table "$results/search/generations.csv" "$study/generations.csv" generation best_fitness_body_lengths mean_fitness_body_lengths evaluations cached
  menger reevaluate "$results/search.sqlite" --top 5 --study "$study/standard.toml" --output "$results/standard"
  menger reevaluate "$results/search.sqlite" --top 5 --study "$study/fine.toml" --output "$results/fine"
  table "$results/standard/reevaluation.csv" "$study/standard.csv" rank cells surrogate_body_lengths elements_status elements_body_lengths distance_ratio angle_deg
  table "$results/fine/reevaluation.csv" "$study/fine.csv" rank cells surrogate_body_lengths elements_status elements_body_lengths distance_ratio angle_deg
}

screened() {
  menger evolve "$study/screened.toml" --output "$results/screened.sqlite"
}
