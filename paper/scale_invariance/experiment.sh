# Does a robot do at the next scale what it does at one, and for which robots does it?
part random "20 min of two cores" "random robots at three scales"
part random_balanced "20 min of two cores" "the same with beams whose moments balance their forces"
trials one_scale 10 "6 min" "a search at the smallest scale, and its champion at three scales" 1 search_at_one_scale one_scale
trials_on_request one_scale_balanced 10 "6 min" "the same with beams whose moments balance their forces" 1 search_at_one_scale one_scale_balanced
part_on_request two_scales "8 min" "the champions of ./run paper fractal at two scales, at the third scale"
part_on_request two_scales_again "12 min" "the champions of ./run paper fractal again, likewise"
part_on_request control_again "1 min" "those of ./run paper non_fractal again, at the two scales that they have"
part_on_request two_scales_balanced "8 min" "those with beams whose moments balance their forces"
part_on_request again_balanced "2 min" "those of again_balanced, of both, at the two scales that they were selected at"
part_on_request three_scales "a minute each" "the champions of ./run paper fractal three_scales_40, three_scales or full"
part_on_request similar "1 h of one core" "these champions as heavy and as stiff for their size at a scale as at the one before"
part_on_request fourth "13 min of one core" "the champion of three scales at a fourth one, 81 cells per side"
part_on_request balanced "2 min" "champions of searches in the simulator as it is, with such beams and with half the time step"
part summary "1 min" "the tables and the picture of all robots that there are"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
robots() { "$study/scale_invariance.py" "$@"; }

# Random robots: the name of their study and of their group.
# shellcheck disable=SC2154  # $results is that of run_experiment.sh
random_robots() {
  menger evolve "$study/$1.toml" --output "$results/$1.sqlite"
  menger export "$results/$1.sqlite" --output "$results/$1" --individuals --levels 1 --no-frames --no-pictures
  robots "$1" "$results/$1/individuals.csv"
}

random() { random_robots random; }
random_balanced() { random_robots random_balanced; }

# The champion of an archive, simulated at some levels: levels, group, seed, archive.
walks_at() {
  local levels
  read -ra levels <<<"$1"
  menger export "$4" --output "$results/$2_$3" --levels "${levels[@]}" --no-frames --no-pictures
  robots champion "$results/$2_$3" "$2" "$3"
}
walks_of_champion() { walks_at "1 2 3" "$@"; }

# shellcheck disable=SC2154  # $generations is that of run_experiment.sh
search_at_one_scale() {
  menger evolve "$study/$1.toml" --seed "$2" --output "$results/$1_$2.sqlite" "${generations[@]}"
  walks_of_champion "$1" "$2" "$results/$1_$2.sqlite"
  mkdir -p "$study/$1"
  table "$results/$1_$2/generations.csv" "$study/$1/$2.csv"
}

# The champions of the experiment fractal.
two_scales() { each_archive build/paper/fractal/two_scales_ .sqlite "fractal two_scales_1" walks_of_champion two_scales; }
two_scales_again() { each_archive build/paper/fractal/again_ .sqlite "fractal again" walks_of_champion two_scales_again; }
control_again() { each_archive build/paper/non_fractal/again_ .sqlite "non_fractal again" walks_at "1 2" control_again; }
two_scales_balanced() { each_archive build/paper/fractal/two_scales_balanced_ .sqlite "fractal balanced_1" walks_of_champion two_scales_balanced; }
again_balanced() {
  each_archive build/paper/fractal/again_balanced_ .sqlite "fractal again_balanced" walks_at "1 2" two_scales_again_balanced
  each_archive build/paper/non_fractal/again_balanced_ .sqlite "non_fractal again_balanced" walks_at "1 2" control_again_balanced
}
three_scales() { each_archive build/paper/fractal/three_scales_ /trial.sqlite "fractal three_scales_40" walks_of_champion three_scales; }

# The scenes of champions with something changed, simulated, and the table of them.
changed() {
  "$study/changed_walks.py" "$1" "$results/$1"
  simulate_scenes "$results/$1"
  "$study/changed_walks.py" take "$results/$1" "$1"
}

similar() { changed similar; }
balanced() { changed balanced; }
fourth() { changed fourth; }

summary() {
  robots summary
  "$study/changed_walks.py" summary
}
