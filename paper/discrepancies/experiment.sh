# What do the differences between the paper's text and its released code do to the ranks of robots?
part text "10 min of two cores" "500 robots at two scales as the text says"
part duration "4 min" "2 s instead of 5 s"
part half_step "20 min" "half the time step"
part no_collisions "8 min" "bodies that go through themselves"
part no_drag "10 min" "no global damping"
part free_rotation "10 min" "standing voxels may turn"
part phases "10 min" "the other material begins"
part released_walks "4 min" "all differences of the released code"
part double "20 min" "double precision"
part summary "1 min" "the tables and the picture of all variants that there are"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
summary() { "$study/discrepancies.py" summary; }

# The walks of a variant, if they are not there already.
walks() {
  "$study/discrepancies.py" study "$1" "$results/$1.toml"
  menger evolve "$results/$1.toml" --output "$results/$1.sqlite"
  menger export "$results/$1.sqlite" --output "$results/$1" --individuals --levels 1 --no-frames --no-pictures
  "$study/discrepancies.py" take "$results/$1/individuals.csv" "$1"
}

for variant in text duration half_step no_collisions no_drag free_rotation phases released_walks double; do
  eval "$variant() { walks $variant; }"
done
