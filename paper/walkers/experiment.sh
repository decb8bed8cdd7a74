# Do robots that finite elements chose in a search walk alike on finer elements?
part walkers "10 min of two cores" "three searches of ten generations on draft elements, and the three best of each on standard and fine ones"
part_on_request robust "6 min of two cores" "such a search whose robots walk at three frictions and two dampings"
part_on_request screened "8 min of two cores" "such a search with more children, which voxels screen"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
walkers() {
  local seed
  for seed in 1 2 3; do
    menger evolve "$study/study.toml" --seed $seed --output "$results/search_$seed.sqlite"
    menger reevaluate "$results/search_$seed.sqlite" --top 3 --study "$study/standard.toml" --no-pictures --output "$results/standard_$seed"
    menger reevaluate "$results/search_$seed.sqlite" --top 3 --study "$study/fine.toml" --no-pictures --output "$results/fine_$seed"
  done
  tables
}

robust() {
  menger evolve "$study/robust.toml" --output "$results/robust.sqlite"
  menger export "$results/robust.sqlite" --output "$results/robust" --no-frames --no-pictures
  table "$results/robust.confirmed.csv" "$study/robust.csv" rank fidelity cells fitness_body_lengths score_body_lengths ratio angle_deg reason
}

screened() {
  menger evolve "$study/screened.toml" --output "$results/screened.sqlite"
}

# The robots of all searches in one table.
tables() {
  local seed fidelity part=$results/part.csv
  local columns=(rank cells surrogate_body_lengths elements_status elements_body_lengths distance_ratio angle_deg)
  {
    (IFS=,; echo "seed,fidelity,${columns[*]}")
    for seed in 1 2 3; do
      for fidelity in standard fine; do
        table "$results/${fidelity}_$seed/reevaluation.csv" "$part" "${columns[@]}"
        sed "1d; s/^/$seed,$fidelity,/" "$part"
      done
    done
  } >"$results/walkers.csv"
  table "$results/walkers.csv" "$study/walkers.csv"
}
