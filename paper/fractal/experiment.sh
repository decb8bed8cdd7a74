# What does the evolution of fractal robots find? The paper's main experiment.
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "two_scales_$seed" "3 min of two cores" "40 generations at the scales of 3 and 9 cells"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "in_pieces_$seed" "2 min of two cores" "20 generations where aggregates may fall apart"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "balanced_$seed" "2 min of two cores" "20 generations with beams whose moments balance their forces"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "random_search_$seed" "3 min of two cores" "as many robots as two_scales_$seed asks for, all drawn at random"
done
part statistics "1 min" "the tests, the intervals and the picture of all trials that there are, those of non_fractal too"
part_on_request heredity "1 min" "how much of a parent's speed its mutants keep, of the trials here and of non_fractal whose archives are there"
part_on_request three_scales_40 "1.1 h of two cores" "a trial in single precision: 40 generations at three scales"
part_on_request three_scales "9 h of two cores" "the same trial: 325 generations; it goes on from the 40"
part_on_request full "4 days of two cores" "ten such trials, seeds 1 to 10: the paper's experiment"
part_on_request small "10 s" "three generations of small bodies"

three_scales_40() { trial single_precision 1 40; }
three_scales() { trial single_precision 1; }

full() {
  local seed
  for seed in 1 2 3 4 5 6 7 8 9 10; do trial single_precision "$seed"; done
}

for seed in 1 2 3 4 5 6 7 8 9 10; do
  eval "two_scales_$seed() { search two_scales $seed; }"
  eval "in_pieces_$seed() { search two_scales_in_pieces $seed; }"
  eval "balanced_$seed() { search two_scales_balanced $seed; }"
  # Another seed than that of a trial: with the same one, the robots of its first generation would be among those that are drawn.
  eval "random_search_$seed() { search random_search $((2000 + seed)); }"
done

# shellcheck disable=SC2154  # $study is that of run_experiment.sh
statistics() { "$study/trials.py"; }

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
heredity() {
  local arm prefix archive seed
  for arm in fractal balanced control; do
    case $arm in
      fractal) prefix=$results/two_scales_ ;;
      balanced) prefix=$results/two_scales_balanced_ ;;
      control) prefix=build/paper/non_fractal/two_scales_ ;;
    esac
    for archive in "$prefix"[0-9]*.sqlite; do
      [ -e "$archive" ] || continue
      seed=${archive#"$prefix"}
      menger export "$archive" --output "$results/individuals/$arm-${seed%.sqlite}" --individuals --levels 1 --no-frames --no-pictures
    done
  done
  "$study/heredity.py" "$results/individuals"
}

small() { search small; }
