# Does a body walk as well if its larger scales are evolved apart from it? The paper's control.
# Other seeds than those of fractals: with the same ones, both would begin with the same basal bodies.
trials two_scales 15 "11 min of two cores" "140 generations at the scales of 3 and 9 cells" 1001 search two_scales
# Other seeds than those of all other searches, so that no two begin with the same robots.
trials random_search 10 "4 min of two cores" "as many robots as 40 generations of two_scales ask for, but 14, all drawn at random" 3001 search random_search
# The seeds of two_scales, so that both begin with the same robots.
trials body_mutants 15 "3 min of two cores" "40 generations of two_scales, of the same seed, in which every mutant gets another body" 1001 search body_mutants
trials_on_request again 15 "7 min of two cores" "60 generations of other seeds, which repeat the comparison with those of fractal" 1016 search again
trials_on_request again_balanced 15 "7 min of two cores" "the same with beams whose moments balance their forces" 1016 search again_balanced
part_on_request neighbours "20 min of one core" "robots that differ in one cell from the champions of again, of both; ./run paper scale_invariance two_scales_again control_again makes these"
part_on_request climbs "about 6 h of one core" "small changes of the best fractals and of random ones, with the arrangement bound to the body and free; ./run paper scale_invariance two_scales two_scales_again again_balanced makes these"
part_on_request three_scales_40 "about 1 h of two cores" "a trial in single precision: 40 generations at three scales"
part_on_request three_scales "about 9 h of two cores" "the same trial: 325 generations; it goes on from the 40"
part_on_request full "about 6 days of two cores" "fifteen such trials, seeds 1001 to 1015: the paper's control"
part_on_request small "10 s" "three generations of small bodies"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
neighbours() {
  local folder=$results/neighbours scenes
  for scenes in first larger; do
    "$study/neighbours.py" "$scenes" "$folder"
    simulate_scenes "$folder"
  done
  "$study/neighbours.py" take "$folder"
  "$study/neighbours.py" summary
}

climbs() {
  local folder=$results/climbs robots group seed
  robots=$("$study/climbs.py" robots)
  while read -r group seed; do
    say "climbs from $group $seed"
    "$study/climbs.py" climb "$folder" build/release/bin/menger "$group" "$seed" </dev/null
  done <<<"$robots"
  "$study/climbs.py" take "$folder"
  "$study/climbs.py" summary
}

three_scales_40() { search_at_three_scales single_precision 1001 40; }
three_scales() { search_at_three_scales single_precision 1001; }

full() {
  local seed
  for seed in {1001..1015}; do search_at_three_scales single_precision "$seed"; done
}

small() { search small; }
