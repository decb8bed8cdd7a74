# Do the paper's robots walk on finite elements, and what do friction and damping change?
part friction "2 min" "eighteen cells on grounds of friction 0.2 to 1.2"
part directional_friction "2 min" "the same on a ground that resists more in one direction"
part damping "1 min" "the same with a silicone that loses nothing to twice the usual guess"
part robots "9 min" "the aggregate under its cam, and the uneven quadruped"
part_on_request basal "1 min" "both robots of the basal scale, at 6 kPa and 3 Hz"
part_on_request airline_and_vacuum "hours" "the aggregate between an air line and a vacuum pump; ends as diverged"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
walk() { menger locomote "$study/$1.toml" --output "$results/$1"; }

# A walk for each value of a sweep.
sweep() {
  walk "$1"
  table "$results/$1/sweep.csv" "$study/$1.csv" "$2" status horizontal_displacement_m direction_deg body_lengths_per_minute
}

friction() { sweep friction ground.static_friction; }
directional_friction() { sweep directional_friction ground.directional.backward_factor; }
damping() { sweep damping material.loss_factor; }

robots() {
  walk aggregate
  walk single_actuator_middle
  gather "$study/robots.csv" status,elements,horizontal_displacement_m,body_lengths_per_minute \
    aggregate="$results/aggregate/locomotion.toml" single_actuator_middle="$results/single_actuator_middle/locomotion.toml"
}

basal() {
  walk basal
  walk single_actuator_basal
}

airline_and_vacuum() { walk airline_and_vacuum; }
