# Does a wave of actuation make a body of one material walk? The design that the paper built first.
part two_scales "40 min of two cores" "a trial: 325 generations at the scales of 3 and 9 cells, and its champion"
part_on_request three_scales "about a day of two cores" "a trial: 325 generations at three scales, and its champion"
part_on_request small "10 s" "three generations of small bodies; their champion is no result and stays in build/paper"

# A search and what is kept of it: its generations and its champion.
kept() {
  search "$1"
  champion "$1"
}

two_scales() { kept two_scales; }
three_scales() { kept study; }

# shellcheck disable=SC2154  # $results is that of run_experiment.sh
small() {
  search small
  champion small "$results/champions.csv"
}
