# What does the evolution of fractal robots find? The paper's main experiment.
trials two_scales 10 "11 min of two cores" "140 generations at the scales of 3 and 9 cells" 1 search two_scales
trials in_pieces 10 "8 min of two cores" "60 generations where aggregates may fall apart" 1 search two_scales_in_pieces
trials balanced 10 "2 min of two cores" "20 generations with beams whose moments balance their forces" 1 search two_scales_balanced
trials single_cells 10 "2 min of two cores" "40 generations in which a mutant differs from its parent in one cell at most" 1 search single_cells
trials new_mutants 10 "5 min of two cores" "40 generations in which no robot comes twice" 1 search new_mutants
# Other seeds than those of the trials: with the same ones, the robots of their first generations would be among those that are drawn.
trials random_search 10 "9 min of two cores" "as many robots as a trial of two_scales asks for, but 14, all drawn at random" 2001 search random_search
trials_on_request again 15 "7 min of two cores" "60 generations of other seeds, which repeat the comparison with those of non_fractal" 11 search again
trials_on_request again_balanced 15 "7 min of two cores" "the same with beams whose moments balance their forces" 11 search again_balanced
part statistics "1 min" "the tests, the intervals and the picture of all trials that there are, those of non_fractal too"
part_on_request three_scales_40 "1.1 h of two cores" "a trial in single precision: 40 generations at three scales"
part_on_request three_scales "9 h of two cores" "the same trial: 325 generations; it goes on from the 40"
part_on_request full "4 days of two cores" "ten such trials, seeds 1 to 10: the paper's experiment"
part_on_request small "10 s" "three generations of small bodies"

three_scales_40() { search_at_three_scales single_precision 1 40; }
three_scales() { search_at_three_scales single_precision 1; }

full() {
  local seed
  for seed in 1 2 3 4 5 6 7 8 9 10; do search_at_three_scales single_precision "$seed"; done
}

# shellcheck disable=SC2154  # $study is that of run_experiment.sh
statistics() { "$study/trials.py"; }

small() { search small; }
