# Do the winners of a search on calibrated voxels walk on finite elements, and do finite elements help during the search?
part walks "1 h of two cores" "a hundred generations, and 22 of their robots on finite elements"
part closing_the_loop "1 h of two cores" "searches with and without corrections by finite elements, three seeds each"
part_on_request small "10 min of two cores" "thirty generations, and their three best robots on finite elements"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
walks() {
  menger evolve "$study/study.toml" --generations 100 --output "$results/search.sqlite"
  menger reevaluate "$results/search.sqlite" --top 10 --sample 12 --study "$study/reevaluation.toml" --output "$results/reevaluated"
  table "$results/reevaluated/reevaluation.csv" "$study/walks.csv"
  table "$results/reevaluated/ranking.csv" "$study/ranking.csv"
  table "$results/reevaluated/variants.csv" "$study/variants.csv"
}

# The surrogate alone runs the same study without its table [reference], beside the files that it names.
closing_the_loop() {
  local out=$results/closing_the_loop seed searches=() budget
  budget=$(sed -n 's/^budget_element_steps = \([^ ]*\).*/\1/p' "$study/closing_the_loop.toml")
  mkdir -p "$out"
  sed -e '/^# Before every sixth/,$d' -e "s|\"../../|\"$PWD/|" "$study/closing_the_loop.toml" >"$out/surrogate.toml"
  for seed in 1 2 3; do
    menger evolve "$study/closing_the_loop.toml" --seed $seed --output "$out/corrected_$seed.sqlite"
    menger export "$out/corrected_$seed.sqlite" --output "$out/corrected_$seed" --levels 1 --no-frames --no-pictures
    menger evolve "$out/surrogate.toml" --seed $seed --output "$out/surrogate_$seed.sqlite"
    menger export "$out/surrogate_$seed.sqlite" --output "$out/surrogate_$seed" --levels 1 --no-frames --no-pictures
    menger reevaluate "$out/surrogate_$seed.sqlite" --top 16 --study "$study/closing_the_loop_reference.toml" \
      --output "$out/surrogate_$seed" --no-pictures
    searches+=("$out/corrected_$seed" "$out/surrogate_$seed")
  done
  menger compare-searches "${searches[@]}" --output "$out" --budget-element-steps "$budget"
  table "$out/comparison.csv" "$study/closing_the_loop.csv"
}

small() {
  menger evolve "$study/study.toml" --output "$results/small.sqlite"
  menger reevaluate "$results/small.sqlite" --top 3 --study "$study/reevaluation_short.toml" --output "$results/small"
}
