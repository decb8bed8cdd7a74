# Do aggregates of aggregates of an evolved body walk as the body does? The paper's main experiment.
part trial "9 h of two cores" "a trial in single precision: 325 generations at three scales"
part_on_request small "10 s" "three generations of small bodies"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
trial() {
  local code=0
  paper/fractal/trial.sh "$study/single_precision.toml" "$results/trial" build/release/bin || code=$?
  [ $code -eq 0 ] || exit $code
  table "$results/trial/generations.csv" "$study/trial.csv"
}

small() { search small; }
