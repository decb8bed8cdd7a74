# Why is evolution not clearly ahead of random search? What mutants inherit of their parents' speed, and what a search needs of it.
# Searches at random have seeds with which no search begins: with the same ones, its first robots would be among those that are drawn.
trials three_cells_random 10 "1 min" "as many robots as 40 generations of scale_invariance one_scale ask for, but 14, all drawn at random" 2001 search three_cells_random
trials three_cells_single 10 "1 min" "40 generations of one_scale, of the same seed, with mutants that differ from their parents in one cell at most" 1 search three_cells_single
trials nine_cells 10 "3 min of two cores" "a search at the scale of 9 cells alone, 20 generations" 1 search nine_cells
trials nine_cells_random 10 "4 min of two cores" "as many robots, but 14, all drawn at random" 2001 search nine_cells_random
trials_on_request nine_cells_single 10 "3 min of two cores" "nine_cells, of the same seed, with mutants that differ from their parents in one cell at most" 1 search nine_cells_single
part made_up "4 min" "searches of robots that are made up, by what mutants inherit"
part heredity "1 min" "what mutants inherit, of the trials here and of other experiments whose archives are there"
part summary "1 min" "evolution against random search at each scale: the table and the picture of all searches that there are"

# shellcheck disable=SC2154  # $study is that of run_experiment.sh
made_up() { "$study/made_up.py"; }

# The robots of a trial: arm, seed, archive.
# shellcheck disable=SC2154  # $results is that of run_experiment.sh
individuals_of() {
  menger export "$3" --output "$results/individuals/$1-$2" --individuals --levels 1 --no-frames --no-pictures
}

# Of the kinds of trials whose archives are there.
heredity() {
  rm -rf "$results/individuals"
  local name
  for name in three_cells_single nine_cells nine_cells_single; do
    each_archive "$results/${name}_" .sqlite "heredity ${name}_1" individuals_of "$name" || true
  done
  each_archive build/paper/scale_invariance/one_scale_ .sqlite "scale_invariance one_scale_1" individuals_of three_cells || true
  each_archive build/paper/fractal/two_scales_ .sqlite "fractal two_scales_1" individuals_of fractal || true
  each_archive build/paper/fractal/two_scales_in_pieces_ .sqlite "fractal in_pieces_1" individuals_of in_pieces || true
  each_archive build/paper/fractal/single_cells_ .sqlite "fractal single_cells_1" individuals_of single_cells || true
  each_archive build/paper/fractal/two_scales_balanced_ .sqlite "fractal balanced_1" individuals_of balanced || true
  each_archive build/paper/fractal/new_mutants_ .sqlite "fractal new_mutants_1" individuals_of new_mutants || true
  each_archive build/paper/fractal/again_ .sqlite "fractal again_1" individuals_of fractal_again || true
  each_archive build/paper/non_fractal/two_scales_ .sqlite "non_fractal two_scales_1" individuals_of control || true
  each_archive build/paper/non_fractal/again_ .sqlite "non_fractal again_1" individuals_of control_again || true
  each_archive build/paper/non_fractal/body_mutants_ .sqlite "non_fractal body_mutants_1" individuals_of body_mutants || true
  "$study/heredity.py" "$results/individuals"
}

summary() { "$study/chance.py"; }
