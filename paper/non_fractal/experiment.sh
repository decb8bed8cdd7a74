# Does a body walk as well if its larger scales are evolved apart from it? The paper's control.
for seed in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
  part "two_scales_$seed" "11 min of two cores" "140 generations at the scales of 3 and 9 cells"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "random_search_$seed" "4 min of two cores" "as many robots as 40 generations of two_scales_$seed ask for, but 14, all drawn at random"
done
for seed in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
  part "body_mutants_$seed" "3 min of two cores" "40 generations of two_scales_$seed in which every mutant gets another body"
done
for seed in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
  part_on_request "again_$seed" "4 min of two cores" "60 generations of other seeds, which repeat the comparison with those of fractal"
done
part_on_request three_scales_40 "about 1 h of two cores" "a trial in single precision: 40 generations at three scales"
part_on_request three_scales "about 9 h of two cores" "the same trial: 325 generations; it goes on from the 40"
part_on_request full "about 6 days of two cores" "fifteen such trials, seeds 1001 to 1015: the paper's control"
part_on_request small "10 s" "three generations of small bodies"

for seed in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15; do
  # Another seed than that of a fractal: with the same one, both would begin with the same basal bodies.
  eval "two_scales_$seed() { search two_scales $((1000 + seed)); }"
  # The same seeds, so that both begin with the same robots.
  eval "body_mutants_$seed() { search body_mutants $((1000 + seed)); }"
  eval "again_$seed() { search again $((1015 + seed)); }"
done
for seed in 1 2 3 4 5 6 7 8 9 10; do
  # Other seeds than those of all other searches, so that no two begin with the same robots.
  eval "random_search_$seed() { search random_search $((3000 + seed)); }"
done
three_scales_40() { trial single_precision 1001 40; }
three_scales() { trial single_precision 1001; }

full() {
  local seed
  for seed in {1001..1015}; do trial single_precision "$seed"; done
}

small() { search small; }
