# Does a robot do at the next scale what it does at one, and for which robots does it?
part random "20 min of two cores" "random robots at three scales"
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part "one_scale_$seed" "6 min" "a search at the smallest scale, and its champion at three scales"
done
part_on_request two_scales "8 min" "the champions of ./run paper fractal at two scales, at the third scale"
part_on_request three_scales "a minute each" "the champions of ./run paper fractal three_scales_40, three_scales or full"
part_on_request similar "30 min of one core" "these champions as heavy and as stiff for their size at a scale as at the one before"
part summary "1 min" "the tables and the picture of all robots that there are"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
robots() { "$study/scale_invariance.py" "$@"; }

random() {
  menger evolve "$study/random.toml" --output "$results/random.sqlite"
  menger export "$results/random.sqlite" --output "$results/random" --individuals --levels 1 --no-frames --no-pictures
  robots random "$results/random/individuals.csv"
}

# The champion of an archive, simulated at three levels: group, seed, archive.
walks_of_champion() {
  menger export "$3" --output "$results/$1_$2" --levels 1 2 3 --no-frames --no-pictures
  robots champion "$results/$1_$2" "$1" "$2"
}

# shellcheck disable=SC2154  # $generations is that of run_experiment.sh
one_scale() {
  menger evolve "$study/one_scale.toml" --seed "$1" --output "$results/one_scale_$1.sqlite" "${generations[@]}"
  walks_of_champion one_scale "$1" "$results/one_scale_$1.sqlite"
}

for seed in 1 2 3 4 5 6 7 8 9 10; do
  eval "one_scale_$seed() { one_scale $seed; }"
done

# The champions of the archives of the experiment fractal that there are: group, what comes before a seed, what comes after it, the part
# that makes them.
champions_of() {
  local archive seed found=
  for archive in "$2"*"$3"; do
    [ -e "$archive" ] || continue
    found=yes
    seed=${archive#"$2"}
    walks_of_champion "$1" "${seed%"$3"}" "$archive"
  done
  [ -n "$found" ] || say "scale_invariance: no search yet; make one with ./run paper fractal $4"
}

two_scales() { champions_of two_scales build/paper/fractal/two_scales_ .sqlite two_scales_1; }
three_scales() { champions_of three_scales build/paper/fractal/three_scales_ /trial.sqlite three_scales_40; }

similar() {
  local scene name
  robots similar "$results/similar_scenes"
  for scene in "$results"/similar_scenes/*.toml; do
    name=${scene##*/}
    name=${name%.*}
    [ -e "$results/similar_scenes/$name/result.toml" ] || menger simulate "$scene" --output "$results/similar_scenes/$name"
  done
  robots simulated "$results/similar_scenes"
}

summary() { robots summary; }
