# How close do voxels come to finite elements, where they are fitted and on bodies that no fit has seen?
part fit "3 min of two cores" "the fit of the voxels to cells, bars and joints, whose curves come with menger"
part other_fits "5 min of two cores" "the same of smaller cells, and of another silicone"
part held_out "10 min of two cores" "fifteen other bodies, by the voxels as they are fitted in the tree"
part aggregates "4 min of one core" "fourteen aggregates of 3 to 9 modules, likewise"
part stepped "2 min of one core" "eight bodies with long inner edges, likewise"
part ecoflex "10 min of two cores" "the fifteen bodies of another silicone and size of cells"
part without_elbows "6 min of one core" "a fit in which elbows keep their angle, and the errors of both sets of bodies with it"
part without_plates "6 min of one core" "a fit in which walls of plates follow the same laws as others, and the errors of both sets of bodies with it"
part_on_request extension_classes "4 min of one core" "a fit in which each wall class lengthens by a law of its own, and the errors of both sets of bodies with it"
part_on_request with_aggregates "6 min of one core" "a fit that has seen five aggregates of 3 to 9 modules, and its errors on the other nine and on single bodies"
part_on_request curves "75 min of one core" "the curves that voxels are fitted to, which come with menger (voxel/curves)"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
fit() {
  menger calibrate voxel/studies/dragon_skin_10_1cm.toml --output "$results/calibration"
  table "$results/calibration/details.csv" "$study/details.csv"
  "$study/fit.py" values "$results/calibration/parameters.toml" "$study/fit.csv"
}

other_fits() {
  menger calibrate voxel/studies/dragon_skin_10_0.667cm.toml --output "$results/calibration_0.667cm"
  table "$results/calibration_0.667cm/details.csv" "$study/details_0.667cm.csv"
  menger calibrate voxel/studies/ecoflex_00_30_12mm.toml --output "$results/calibration_ecoflex"
  table "$results/calibration_ecoflex/details.csv" "$study/details_ecoflex.csv"
  "$study/fit.py" values "$results/calibration_ecoflex/parameters.toml" "$study/fit_ecoflex.csv"
}

held_out() {
  menger load-cases fem/studies/load_cases/held_out.toml --output "$results/held_out_curves"
  menger validate voxel/studies/held_out.toml --parameters voxel/parameters/dragon_skin_10_1cm.toml \
    --curves "$results/held_out_curves" --output "$results/held_out"
  table "$results/held_out/summary.csv" "$study/held_out.csv"
  "$study/fit.py" medians "$results/held_out" "$study/medians.csv"
}

aggregates() {
  menger load-cases fem/studies/load_cases/aggregates.toml --output "$results/aggregates_curves"
  menger validate voxel/studies/aggregates.toml --parameters voxel/parameters/dragon_skin_10_1cm.toml \
    --curves "$results/aggregates_curves" --output "$results/aggregates"
  table "$results/aggregates/summary.csv" "$study/aggregates.csv"
}

stepped() {
  menger load-cases fem/studies/load_cases/stepped.toml --output "$results/stepped_curves"
  menger validate voxel/studies/stepped.toml --parameters voxel/parameters/dragon_skin_10_1cm.toml \
    --curves "$results/stepped_curves" --output "$results/stepped"
  table "$results/stepped/summary.csv" "$study/stepped.csv"
}

ecoflex() {
  menger load-cases fem/studies/load_cases/held_out_ecoflex_00_30_12mm.toml --output "$results/held_out_ecoflex_curves"
  menger validate voxel/studies/held_out_ecoflex_00_30_12mm.toml --parameters voxel/parameters/ecoflex_00_30_12mm.toml \
    --curves "$results/held_out_ecoflex_curves" --output "$results/held_out_ecoflex"
  "$study/fit.py" medians "$results/held_out_ecoflex" "$study/ecoflex_medians.csv"
}

# Validates another fit. @param its name, study and name of the set of bodies
validate_fit() {
  menger validate "$2" --parameters "$results/calibration_$1/parameters.toml" --curves "$results/${3}_curves" --output "$results/${3}_$1"
  table "$results/${3}_$1/summary.csv" "$study/${3}_$1.csv"
}

# A fit of other details. @param its name, what sed makes of the study
another_fit() {
  sed "s|^curves = .*|curves = [\"$PWD/voxel/curves/dragon_skin_10_1cm\"]|; $2" voxel/studies/dragon_skin_10_1cm.toml >"$results/$1.toml"
  menger calibrate "$results/$1.toml" --output "$results/calibration_$1"
  validate_fit "$1" voxel/studies/held_out.toml held_out
  validate_fit "$1" voxel/studies/aggregates.toml aggregates
}

without_elbows() {
  another_fit without_elbows 's/, "elbows"//'
  table "$results/held_out_without_elbows/expected_errors.csv" "$study/kinds_without_elbows.csv"
}

extension_classes() {
  another_fit extension_classes 's/"plates", /"plates", "extension_classes", /'
  table "$results/calibration_extension_classes/details.csv" "$study/details_extension_classes.csv"
}

without_plates() {
  another_fit without_plates 's/, "plates"//'
  table "$results/calibration_without_plates/details.csv" "$study/details_without_plates.csv"
  "$study/fit.py" medians "$results/held_out_without_plates" "$study/medians_without_plates.csv"
}

# Validates a fit on the aggregates that with_aggregates leaves out. @param its name, parameters
validate_unseen() {
  menger validate voxel/studies/aggregates.toml --parameters "$2" --curves "$results/aggregates_unseen" --output "$results/unseen_$1"
  "$study/fit.py" medians "$results/unseen_$1" "$study/unseen_aggregates_$1.csv"
}

with_aggregates() {
  local name fitted="$results/aggregates_fitted" unseen="$results/aggregates_unseen"
  [ -e "$results/aggregates_curves/bar.csv" ] || aggregates
  mkdir -p "$fitted" "$unseen"
  for name in bar bench cross cube u; do cp "$results/aggregates_curves/$name".{csv,toml} "$fitted"; done
  for name in arch elbow l plane slab square t tall tripod; do cp "$results/aggregates_curves/$name".{csv,toml} "$unseen"; done
  sed "s|^curves = .*|curves = [\"$PWD/voxel/curves/dragon_skin_10_1cm\", \"$PWD/$fitted\"]|" voxel/studies/dragon_skin_10_1cm.toml >"$results/with_aggregates.toml"
  menger calibrate "$results/with_aggregates.toml" --output "$results/calibration_with_aggregates"
  validate_unseen now voxel/parameters/dragon_skin_10_1cm.toml
  validate_unseen with_aggregates "$results/calibration_with_aggregates/parameters.toml"
  validate_fit with_aggregates voxel/studies/held_out.toml held_out
}

# Computes curves that come with menger, and keeps them without the names of files of this machine. @param study, name of the set
keep_curves() {
  local file kept=voxel/curves/$2
  menger load-cases "$1" --output "$results/curves/$2" --no-pictures
  mkdir -p "$kept"
  cp "$results/curves/$2"/*_*.csv "$kept"
  for file in "$results/curves/$2"/*_*.toml; do sed '/^\[\[inputs\]\]/,/^content_hash/d' "$file" >"$kept/$(basename "$file")"; done
}

curves() {
  keep_curves fem/studies/load_cases/dragon_skin_10_1cm.toml dragon_skin_10_1cm
  keep_curves fem/studies/load_cases/dragon_skin_10_0.667cm.toml dragon_skin_10_0.667cm
  keep_curves fem/studies/load_cases/ecoflex_00_30_12mm.toml ecoflex_00_30_12mm
}
