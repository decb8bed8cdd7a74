# How far can a walk on finite elements be known, and how well do coarse elements and short walks rank robots?
part searches "20 min" "three short searches on voxels and three on finite elements, and 20 robots of each on the coarsest, six of them its best"
part walks "90 min of one core" "the robots that move, each with one thing changed"
part two_layers "80 min of one core" "some of them with two elements through the wall, for 2 s"
part sensitivity "20 min of one core" "the same robots with large changes of pressure, ground and damping"
part voxels "2 min" "the same robots on voxels"
part tables "1 min" "the tables and the picture of all walks that there are"

# The parts follow each other: all others need the robots of searches, and some of them the walks on standard elements of walks.

# Which robots walk with two elements through the wall, and on fine elements with the ground of standard ones: every fourth.
every_of_some=4

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
searches() {
  local seed
  for seed in 1 2 3; do
    menger evolve "$study/search.toml" --seed $seed --output "$results/search_$seed.sqlite"
  done
  for seed in 4 5 6; do
    menger evolve "$study/search_on_elements.toml" --seed $seed --output "$results/search_$seed.sqlite"
  done
  for seed in 1 2 3 4 5 6; do
    menger reevaluate "$results/search_$seed.sqlite" --top 6 --sample 14 --study "$study/screening.toml" --no-pictures \
      --output "$results/screened_$seed"
  done
  "$study/walks.py" choose "$results" "$study/robots.csv"
  "$study/walks.py" screened "$results" "$study/screened.csv"
}

# One walk of a robot, of the name of the change.
walk() {
  local file
  file=$("$study/walks.py" study "$1" "$2" "$results")
  case $2 in
    voxels*) menger simulate "$file" --no-pictures --output "$results/$1/$2" ;;
    *) menger locomote "$file" --no-pictures --quiet --output "$results/$1/$2" ;;
  esac
}

# Walks of all robots, change by change, so that a table of fewer changes can be made before all are done.
all_walk() {
  local robot change
  for change in "$@"; do
    for robot in $("$study/walks.py" names "$study/robots.csv"); do
      walk "$robot" "$change"
    done
  done
}

walks() {
  local robot
  all_walk standard draft fine half_step stiff_ground friction pressure together
  for robot in $(some_robots); do walk "$robot" fine_same_ground; done
  tables
}

some_robots() { "$study/walks.py" names "$study/robots.csv" | sed -n "1~${every_of_some}p"; }

two_layers() {
  local robot
  for robot in $(some_robots); do walk "$robot" two_layers; done
  tables
}

sensitivity() {
  all_walk draft_0.9_pressure draft_0.75_pressure draft_0.1_ground draft_3_damping
  tables
}

voxels() {
  all_walk voxels voxels_without_drag
  tables
}

tables() {
  "$study/walks.py" gather "$results" "$study/walks.csv"
  "$study/walks.py" gaits "$results" "$study/gaits.csv"
  "$study/known_walks.py" "$study"
}
