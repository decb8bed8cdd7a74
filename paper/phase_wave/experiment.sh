# Does a wave of actuation make a body of one material walk? The design that the paper built first.
part trial "about a day of two cores" "a trial: 325 generations at three scales"
part_on_request small "10 s" "three generations of small bodies"

trial() { search study; }
small() { search small; }
