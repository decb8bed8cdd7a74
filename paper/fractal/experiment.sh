# Do aggregates of aggregates of an evolved body walk as the body does? The paper's main experiment.
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "two_scales_$seed" "3 min of two cores" "20 generations at the scales of 3 and 9 cells"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "in_pieces_$seed" "3 min of two cores" "the same where aggregates may fall apart"
done
part statistics "1 min" "the tests, the intervals and the picture of all trials that there are, those of non_fractal too"
part_on_request three_scales "9 h of two cores" "a trial in single precision: 325 generations at three scales"
part_on_request small "10 s" "three generations of small bodies"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
three_scales() {
  local code=0
  paper/fractal/trial.sh "$study/single_precision.toml" "$results/trial" build/release/bin || code=$?
  [ $code -eq 0 ] || exit $code
  table "$results/trial/generations.csv" "$study/trial.csv"
}

for seed in 1 2 3 4 5 6 7 8 9 10; do
  eval "two_scales_$seed() { search two_scales $seed; }"
  eval "in_pieces_$seed() { search two_scales_in_pieces $seed; }"
done

statistics() { "$study/trials.py"; }
small() { search small; }
