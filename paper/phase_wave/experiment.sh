# Does a wave of actuation make a body of one material walk? The design that the paper built first.
part two_scales "40 min of two cores" "a trial at the scales of 3 and 9 cells"
part_on_request three_scales "about a day of two cores" "a trial: 325 generations at three scales"
part_on_request small "10 s" "three generations of small bodies"

two_scales() { search two_scales; }
three_scales() { search study; }
small() { search small; }
