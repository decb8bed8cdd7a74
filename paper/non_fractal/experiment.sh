# Does a body walk as well if its larger scales are evolved apart from it? The paper's control.
part trial "about a day of two cores" "a trial: 325 generations at three scales"
part_on_request small "10 s" "three generations of small bodies"

trial() { search study; }
small() { search small; }
