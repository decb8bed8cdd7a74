# What can a piston behind a tube do to a robot, and would the robot walk?
part module "1 min" "the volume of a module over its pressure"
part stall_map "10 min of two cores" "pressures for strokes and tubes, and walks of calibrated voxels at points of the map"
part_on_request module_cam "1 min" "the module on its share of the cam"
part_on_request level2 "hours" "the aggregate on the cam of the paper"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
module() {
  menger inflate "$study/module.toml" --output "$results/module"
  table "$results/module/curves.csv" "$study/module_curve.csv" pressure_Pa=plenum_0_pressure_Pa volume_m3=plenum_0_volume_m3
}

stall_map() {
  menger stall-map "$study/stall_map.toml" --output "$results/stall_map"
  paper/pneumatics/strokes.py "$results/stall_map" "$study/strokes.csv"
  table "$results/stall_map/travel.csv" "$study/travel.csv"
}

module_cam() { menger locomote "$study/module_cam.toml" --output "$results/module_cam"; }
level2() { menger locomote "$study/level2.toml" --output "$results/level2"; }
