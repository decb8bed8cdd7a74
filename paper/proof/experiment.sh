# At equal cost, which search finds the better robot: on voxels, on finite elements, or on both?
# A seed is three searches, one of each arm. Their rows are added to the tables as soon as they are there, so that no search is run twice:
# put the tables in git after every seed.
for seed in 1 2 3 4 5 6 7 8 9 10; do
  part_on_request "seed_$seed" "an hour of two cores" "a search of each arm, and its best robots on fine elements"
done
part summary "1 s" "the tests, the effect sizes and the picture of all seeds that there are"
part_on_request cost "1 min of one idle core" "what a step of a voxel and of an element costs: cost.csv, which the budgets rest on"
part_on_request two_layers "30 min of two cores" "the winners with two layers of elements through the wall"
part_on_request trial "3 min" "three seeds of the smallest searches; results and tables in build/paper/proof/trial"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
proof() { "$study/proof.py" "$@"; }

# A search of an arm, and what is wanted of it: arm, seed, size, folder of results, folder of tables.
one_search() {
  local arm=$1 seed=$2 size=$3 folder=$4 tables=$5 name=$1_$2
  say "proof: seed $seed, $arm"
  proof study "$arm" "$seed" "$size" "$folder/studies/$name.toml"
  menger evolve "$folder/studies/$name.toml" --output "$folder/$name.sqlite"
  menger confirm "$folder/$name.sqlite" "$study/fine.toml" --top "$(proof number "$size" robots)" --output "$folder/$name.fine.csv"
  if [ "$arm" = voxels ]; then
    menger confirm "$folder/$name.sqlite" "$study/elements.toml" --champions --output "$folder/$name.champions.csv"
  fi
  menger export "$folder/$name.sqlite" --output "$folder/$name" --levels 1 --no-frames --no-pictures
  proof take "$folder" "$tables" "$arm" "$seed"
}

# The searches of a seed that the tables lack.
searches() {
  local seed=$1 size=$2 folder=$3 tables=$4 arm
  mkdir -p "$folder" "$tables"
  for arm in $(proof missing "$tables" "$seed"); do one_search "$arm" "$seed" "$size" "$folder" "$tables"; done
  proof summary "$tables"
}

for seed in 1 2 3 4 5 6 7 8 9 10; do
  eval "seed_$seed() { searches $seed \"\$study/size.toml\" \"\$results\" \"\$study\"; }"
done

summary() { proof summary "$study"; }

cost() {
  local arm
  for arm in voxels elements; do
    sed 's|"../../voxel|"../../../voxel|; s/^frictions = .*/frictions = [0.8]/' "$study/$arm.toml" >"$results/cost_$arm.toml"
    rm -f "$results/cost_$arm.sqlite"
    menger evolve "$results/cost_$arm.toml" --generations 1 --threads 1 --output "$results/cost_$arm.sqlite"
    menger export "$results/cost_$arm.sqlite" --output "$results/cost/$arm" --timings --levels 1 --no-frames --no-pictures
  done
  proof cost "$results/cost"
}

two_layers() {
  local arm seed individual
  proof winners "$study" >"$results/winners.txt"
  while read -r arm seed individual; do
    menger confirm "$results/${arm}_$seed.sqlite" "$study/two_layers.toml" --individuals "$individual" \
      --output "$results/${arm}_$seed.layers.csv" </dev/null
    proof layers "$results" "$study"
  done <"$results/winners.txt"
}

trial() {
  local seed
  for seed in 1 2 3; do searches $seed "$study/trial_size.toml" "$results/trial" "$results/trial"; done
}
