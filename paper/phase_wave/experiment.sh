# Does a wave of actuation make a body of one material walk? The design that the paper built first.
part two_scales "40 min of two cores" "a trial: 325 generations at the scales of 3 and 9 cells, and its champion"
part_on_request three_scales "about a day of two cores" "a trial: 325 generations at three scales, and its champion"
part_on_request small "10 s" "three generations of small bodies; their champion is no result and stays in build/paper"

two_scales() { search_with_champion two_scales; }
three_scales() { search_with_champion study; }
# shellcheck disable=SC2154  # $results is that of run_experiment.sh
small() { search_with_champion small "$results/champions.csv"; }
