# At equal cost, which search finds the better robot: on voxels, on finite elements, or on both?
# A seed is four searches, one of each arm. Their rows are added to the tables as soon as they are there, so that no search is run twice:
# put the tables in git after every seed.
# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
trials_on_request seed 10 "2 h of two cores" "a search of each arm, its best robots on fine elements, and the best of these with two layers of elements and at other dampings" 1 searches "$study/size.toml" "$results" "$study"
part_on_request winners "up to 2 h of two cores" "the winners of searches on elements that have not walked on two layers or at other dampings: such a search is made again up to its winner"
part summary "1 s" "the tests, the effect sizes and the picture of all seeds that there are"
part_on_request cost "1 min of one idle core" "what a step of a voxel and of an element costs: cost.csv, which the budgets rest on"
part_on_request short "75 min of two cores" "ten seeds of searches a tenth as long; tables in paper/proof/short"
part_on_request modules "40 min of two cores" "three short searches of aggregates of up to five modules, on voxels and on elements; tables in paper/proof/modules"
part_on_request trial "3 min" "three seeds of the smallest searches; results and tables in build/paper/proof/trial"

# shellcheck disable=SC2154  # $study and $results are those of run_experiment.sh
proof() { "$study/proof.py" "$@"; }

# The winner of a search with two layers of elements and at other dampings: folder of results, search, individual.
winner_again() {
  menger confirm "$1/$2.sqlite" "$1/studies/two_layers.toml" --individuals "$3" --output "$1/$2.layers.csv"
  menger confirm "$1/$2.sqlite" "$1/studies/dampings.toml" --individuals "$3" --output "$1/$2.dampings.csv"
}

# The study of a search, and those that its robots walk by: folder of results, arm, seed, size.
studies() {
  local judge
  proof study "$2" "$3" "$4" "$1/studies/$2_$3.toml"
  for judge in fine elements two_layers dampings; do proof judge $judge "$4" "$1/studies/$judge.toml"; done
}

# A search of an arm, and what is wanted of it: arm, seed, size, folder of results, folder of tables.
one_search() {
  local arm=$1 seed=$2 size=$3 out=$4 tables=$5 name=$1_$2 champions winner
  say "proof: seed $seed, $arm"
  studies "$out" "$arm" "$seed" "$size"
  menger evolve "$out/studies/$name.toml" --output "$out/$name.sqlite"
  menger confirm "$out/$name.sqlite" "$out/studies/fine.toml" --top "$(proof number "$size" robots)" --output "$out/$name.fine.csv"
  menger export "$out/$name.sqlite" --output "$out/$name" --levels "$(proof level "$size")" --no-frames --no-pictures
  if [[ $arm = voxels* ]]; then
    champions=$(proof champions "$out" "$arm" "$seed")
    read -ra champions <<<"$champions"
    if [ ${#champions[@]} -gt 0 ]; then champions=(--individuals "${champions[@]}"); else champions=(--champions); fi  # none: an empty table
    menger confirm "$out/$name.sqlite" "$out/studies/elements.toml" "${champions[@]}" --output "$out/$name.champions.csv"
  elif [ "$(proof number "$size" winners_again)" = True ]; then
    # With the search, not later: archives are not kept in git.
    winner=$(proof winner "$out" "$arm" "$seed")
    [ -z "$winner" ] || winner_again "$out" "$name" "$winner"
  fi
  proof take "$out" "$tables" "$arm" "$seed"
}

# The searches of a seed that the tables lack: size, folder of results, folder of tables, seed.
searches() {
  local size=$1 folder=$2 tables=$3 seed=$4 arm
  mkdir -p "$folder" "$tables"
  for arm in $(proof missing "$tables" "$seed" "$size"); do one_search "$arm" "$seed" "$size" "$folder" "$tables"; done
  proof summary "$tables"
}

# Searches whose archives are gone are made again, with the same seeds, until they have met the winner that the tables name.
# shellcheck disable=SC2154  # $results is that of run_experiment.sh
winners() {
  local untried arm seed generations winner name
  untried=$(proof untried "$study")
  while read -r arm seed generations winner <&3; do
    [ -n "$arm" ] || continue
    name=${arm}_$seed
    say "proof: the winner of $name, individual $winner"
    studies "$results" "$arm" "$seed" "$study/size.toml"
    menger evolve "$results/studies/$name.toml" --generations "$generations" --output "$results/$name.sqlite"
    menger confirm "$results/$name.sqlite" "$results/studies/fine.toml" --individuals "$winner" --output "$results/$name.fine.csv"
    winner_again "$results" "$name" "$winner"
    proof again "$results" "$study" "$arm" "$seed" || say "proof: $name is left out"
  done 3<<<"$untried"
  proof summary "$study"
}

# Of the searches of each size that there are.
summary() {
  local tables
  for tables in "$study" "$study/short"; do
    if [ -e "$tables/outcomes.csv" ]; then proof summary "$tables"; else say "proof: no finished search in $tables"; fi
  done
}

# A short search of an arm on one thread, with the wall times of its walks.
timed_search() {
  cp "$study/voxels.parameters.toml" "$results"  # beside the study that names it
  sed 's/^frictions = .*/frictions = [0.8]/' "$study/$1.toml" >"$results/cost_$1.toml"
  rm -f "$results/cost_$1.sqlite"
  menger evolve "$results/cost_$1.toml" --generations 1 --threads 1 --output "$results/cost_$1.sqlite"
  menger export "$results/cost_$1.sqlite" --output "$results/cost/$1" --timings --levels 1 --no-frames --no-pictures
}

cost() {
  timed_search voxels
  timed_search elements
  proof cost "$results/cost"
}

short() {
  local seed
  for seed in 1 2 3 4 5 6 7 8 9 10; do searches "$study/short_size.toml" "$results/short" "$study/short" $seed; done
}

# Few and short ones, which are reported without a test: there are few such bodies.
modules() {
  local seed
  for seed in 1 2 3; do searches "$study/modules_size.toml" "$results/modules" "$study/modules" $seed; done
}

trial() {
  local seed
  for seed in 1 2 3; do searches "$study/trial_size.toml" "$results/trial" "$results/trial" $seed; done
}
