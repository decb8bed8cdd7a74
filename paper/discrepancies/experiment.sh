# What do the differences between the paper's text and its released code do to the ranks of robots?
part text "10 min of two cores" "500 robots at two scales as the text says"
part duration "4 min" "the released code does otherwise: 2 s instead of 5 s"
part phases "10 min" "the released code does otherwise: material 1 lags"
part released_walks "4 min" "the released code does otherwise: 2 s, its score and its phases"
part no_drag "10 min" "the text does not mention it: no global damping"
part free_rotation "10 min" "the text does not mention it: standing voxels may rotate"
part literal_text "10 min" "neither: the text taken literally"
part balanced "10 min" "beams whose moments balance their forces, which in text and code they do not"
part balanced_no_drag "10 min" "balanced, without global damping"
part balanced_no_drag_half_step "20 min" "the same with half the time step"
part balanced_half_step "20 min" "balanced, with half the time step"
part balanced_free_rotation "10 min" "balanced, and standing voxels may rotate"
part half_step "20 min" "sensitivity: half the time step"
part no_collisions "8 min" "sensitivity: bodies that go through themselves"
part_on_request double "20 min" "sensitivity: double precision"
part_on_request no_drag_half_step "20 min" "sensitivity: no global damping, half the time step"
part bodies "10 s" "which bodies random networks grow into, in the text and in the released code"
part summary "1 min" "the tables and the picture of all variants that there are"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
bodies() {
  local file name
  "$study/bodies.py" studies "$results/bodies"
  for file in "$results"/bodies/*.toml; do
    name=${file%.toml}
    rm -f "$name".sqlite*
    menger evolve "$file" --output "$name.sqlite"
    menger export "$name.sqlite" --output "$name" --individuals --levels 1 --no-frames --no-pictures
  done
  "$study/bodies.py" take "$results/bodies"
}

summary() { "$study/discrepancies.py" summary; }

# The walks of a variant, if they are not there already: a clone has those of most. To make them anew, remove walks/NAME.csv.
walks() {
  if [ -e "$study/walks/$1.csv" ]; then
    say "discrepancies: $study/walks/$1.csv is there; remove it to make it anew"
    return
  fi
  "$study/discrepancies.py" study "$1" "$results/$1.toml"
  menger evolve "$results/$1.toml" --output "$results/$1.sqlite"
  menger export "$results/$1.sqlite" --output "$results/$1" --individuals --levels 1 --no-frames --no-pictures
  "$study/discrepancies.py" take "$results/$1/individuals.csv" "$1"
}

for variant in text duration phases released_walks no_drag free_rotation literal_text balanced balanced_no_drag balanced_no_drag_half_step balanced_half_step balanced_free_rotation half_step no_collisions double no_drag_half_step; do
  eval "$variant() { walks $variant; }"
done
