# What does the evolution of fractal robots find? The paper's main experiment.
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "two_scales_$seed" "11 min of two cores" "140 generations at the scales of 3 and 9 cells"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "in_pieces_$seed" "8 min of two cores" "60 generations where aggregates may fall apart"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "balanced_$seed" "2 min of two cores" "20 generations with beams whose moments balance their forces"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "single_cells_$seed" "2 min of two cores" "40 generations in which a mutant differs from its parent in one cell at most"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "new_mutants_$seed" "5 min of two cores" "40 generations in which no robot comes twice"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "random_search_$seed" "9 min of two cores" "as many robots as two_scales_$seed asks for, but 14, all drawn at random"
done
for seed in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
  part_on_request "again_$seed" "4 min of two cores" "60 generations of other seeds, which repeat the comparison with those of non_fractal"
done
part statistics "1 min" "the tests, the intervals and the picture of all trials that there are, those of non_fractal too"
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
  eval "single_cells_$seed() { search single_cells $seed; }"
  eval "new_mutants_$seed() { search new_mutants $seed; }"
  eval "balanced_$seed() { search two_scales_balanced $seed; }"
  # Another seed than that of a trial: with the same one, the robots of its first generation would be among those that are drawn.
  eval "random_search_$seed() { search random_search $((2000 + seed)); }"
done

for seed in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
  eval "again_$seed() { search again $((10 + seed)); }"
done

# shellcheck disable=SC2154  # $study is that of run_experiment.sh
statistics() { "$study/trials.py"; }

small() { search small; }
