#!/usr/bin/env bash
# Runs an experiment of the paper, or goes on with one: ./run paper builds the programs first.
#   paper/run_experiment.sh                    lists the experiments and their parts, with their costs
#   paper/run_experiment.sh NAME [PART ...]    runs all parts of paper/NAME, or those that are named
#   paper/run_experiment.sh --check NAME [PART ...]    only checks that there are these
#
# An experiment is a folder with a file experiment.sh. Its first line asks the question. It names its parts, before it has functions, with
#   part NAME COST WHAT                               which calls its function NAME, or
#   trials NAME NUMBER COST WHAT FIRST COMMAND ...    for the parts NAME_1 to NAME_NUMBER, each of which calls COMMAND ... SEED: of the
#                                                     first one FIRST is the seed, of each further one the next whole number;
# part_on_request and trials_on_request do the same for parts that run only if they are named. A file and its functions find
#   menger ...            the programs; outcomes that a status names are results, an interrupt ends the experiment
#   $study                the folder of the experiment, with its studies and its small tables, which are in git
#   $results              the folder of its results, build/paper/NAME, which is not; programs go on from what they find there
#   table, gather         paper/tables.py take and gather, which make small tables of results
#   search STUDY          runs a search and makes the table STUDY.csv of its generations
#   search STUDY SEED     the same with another seed, and the table STUDY/SEED.csv
#   search_with_champion STUDY [TABLE]
#                         the same, and keeps its champion with a small picture in champions.csv, or in another table
#   search_at_three_scales STUDY SEED [N]
#                         a long trial, and the table three_scales/SEED.csv; N generations in place of the study's
#   simulate_scenes FOLDER
#                         simulates FOLDER/NAME.toml into FOLDER/NAME, each scene that is not simulated already as it is
#   each_archive PREFIX SUFFIX "EXPERIMENT PART" FUNCTION [WORD ...]
#                         calls FUNCTION WORD... SEED ARCHIVE for the archives PREFIX SEED SUFFIX that there are; where there is none
#                         it says which part makes one, and fails
#   "${generations[@]}"   an option for other calls of menger evolve
# GENERATIONS=N in the environment gives the searches of the paper N generations, whatever their study says:
#   GENERATIONS=325 ./run paper fractal two_scales_1
# A search whose archive is there goes on from it; one whose archive is gone begins anew.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '==> %s\n' "$*"; }

experiments() {
  local file
  for file in paper/*/experiment.sh; do basename "$(dirname "$file")"; done
}

# Reads an experiment. on_parts is called with NAME COST WHAT WHEN for each of its parts, and with a fifth word NUMBER for those of trials.
read_experiment() {
  local needed=() one
  study=paper/$1
  results=build/paper/$1
  part() { one_part "" "$@"; }
  part_on_request() { one_part "on request: " "$@"; }
  trials() { named_trials "" "$@"; }
  trials_on_request() { named_trials "on request: " "$@"; }
  # shellcheck disable=SC1090,SC1091  # one file for each experiment
  source "$study/experiment.sh"
  [ ${#needed[@]} -gt 0 ] || wrong "$study/experiment.sh: names no part"
  for one in "${needed[@]}"; do is_function "$one" || wrong "$study/experiment.sh: has no function $one"; done
}

is_function() { [ "$(type -t "$1")" = function ]; }

one_part() {
  [[ " $own_functions " != *" $2 "* ]] || wrong "$study/experiment.sh: there is a function $2 already; give the part another name"
  needed+=("$2")
  on_parts "$2" "$3" "$4" "$1"
}

named_trials() {
  local when=$1 name=$2 number=$3 cost=$4 what=$5 first=$6 command k
  shift 6
  needed+=("$1")
  printf -v command '%q ' "$@"
  for ((k = 1; k <= number; ++k)); do
    eval "${name}_$k() { $command $((first + k - 1)); }"
  done
  on_parts "$name" "$cost" "$what" "$when" "$number"
}

# All experiments, or one.
list() {
  local name
  echo "Experiments and their parts, with rough costs on two idle cores of a Xeon. NAME_{1..10} stands for ten parts, NAME_1 to NAME_10; the cost is that of one."
  echo "GENERATIONS=N before the command gives searches of fractal, non_fractal, heredity, phase_wave, single_actuator and scale_invariance N generations."
  echo
  for name in ${1:-$(experiments)}; do
    printf '%s: %s\n' "$name" "$(sed -n '1s/^# //p' "paper/$name/experiment.sh")"
    (
      on_parts() {
        local name=$1
        [ -z "${5:-}" ] || name+="_{1..$5}"
        printf '  %-27s %-28s %s%s\n' "$name" "$2" "$4" "$3"
      }
      read_experiment "$name"
    )
  done
}

wrong() {
  printf 'run_experiment.sh: error: %s\n' "$1" >&2
  exit 2
}

# An error, and what there is: in all experiments, or in one.
refuse() {
  printf 'run_experiment.sh: error: %s\n\n' "$1" >&2
  list "${@:2}" >&2
  exit 2
}

menger() {
  local code=0
  build/release/bin/menger "$@" || code=$?
  # 3 is an outcome such as a body that diverged; its tables say so.
  if [ $code -ne 0 ] && [ $code -ne 3 ]; then
    [ $code -ne 130 ] || printf '\nrun_experiment.sh: stopped; the same command goes on\n' >&2
    exit $code
  fi
}

# For menger evolve: what GENERATIONS asks for, or else a number that is given, or else nothing.
generations_or() {
  generations=()
  [ -z "${GENERATIONS:-$1}" ] || generations=(--generations "${GENERATIONS:-$1}")
}

# Runs the search of a study, one of several if a seed is given, and keeps the table of its generations.
search() {
  local out=$results/$1${2:+_$2} kept=$study/$1${2:+/$2}.csv
  menger evolve "$study/$1.toml" ${2:+--seed "$2"} --output "$out.sqlite" "${generations[@]}"
  menger export "$out.sqlite" --output "$out" --levels 1 --no-frames --no-pictures
  mkdir -p "$(dirname "$kept")"
  table "$out/generations.csv" "$kept"
}

# The same, and its champion: in a table of the study folder, or in another one that is given.
search_with_champion() {
  search "$1"
  paper/champion.py take "$results/$1" "$study/$1.toml" "$(sed -n 's/^seed = //p' "$study/$1.toml")" "${2:-$study/champions.csv}"
}

search_at_three_scales() {
  local code=0 out=$results/three_scales_$2 generations
  generations_or "${3:-}"
  paper/fractal/trial.sh "$study/$1.toml" "$out" build/release/bin "" --seed "$2" "${generations[@]}" || code=$?
  [ $code -eq 0 ] || exit $code
  mkdir -p "$study/three_scales"
  table "$out/generations.csv" "$study/three_scales/$2.csv"
}

simulate_scenes() {
  local scene name number=0 scenes=("$1"/*.toml)
  for scene in "${scenes[@]}"; do
    number=$((number + 1))
    name=${scene##*/}
    name=${name%.*}
    [ $((number % 20)) -ne 0 ] || say "scene $number of ${#scenes[@]}"
    if ! cmp -s "$scene" "$1/$name/scene.toml"; then
      menger simulate "$scene" --output "$1/$name" >/dev/null
      cp "$scene" "$1/$name/scene.toml"
    fi
  done
}

each_archive() {
  local archive seed found='' prefix=$1 suffix=$2 maker=$3
  shift 3
  for archive in "$prefix"[0-9]*"$suffix"; do
    [ -e "$archive" ] || continue
    found=yes
    seed=${archive#"$prefix"}
    "$@" "${seed%"$suffix"}" "$archive"
  done
  [ -n "$found" ] || {
    say "there is no ${prefix}SEED$suffix yet; make one with ./run paper $maker" >&2
    return 2
  }
}

table() { paper/tables.py take "$@"; }
gather() { paper/tables.py gather "$@"; }

run() {
  local name=$1 one k names wanted=() when_not_named=()
  local -A names_of=()  # the parts that a word of the command means
  shift
  [ -e "paper/$name/experiment.sh" ] || refuse "there is no experiment paper/$name"
  on_parts() {
    local names=("$1")
    if [ -n "${5:-}" ]; then
      names=()
      for ((k = 1; k <= $5; ++k)); do
        names+=("$1_$k")
        names_of[$1_$k]=$1_$k
      done
      names_of["$1_{1..$5}"]=${names[*]}  # from a shell other than bash
    fi
    names_of[$1]=${names[*]}
    [ -n "$4" ] || when_not_named+=("${names[@]}")
  }
  read_experiment "$name"
  for one in "$@"; do
    [ -n "${names_of[$one]:-}" ] || refuse "the experiment $name has no part $one" "$name"
    read -ra names <<<"${names_of[$one]}"
    wanted+=("${names[@]}")
  done
  [ $# -gt 0 ] || wanted=("${when_not_named[@]}")
  [ -z "$only_check" ] || return 0
  mkdir -p "$results"
  for one in "${wanted[@]}"; do
    say "$name: $one (results in $results)"
    "$one"
  done
  paper/tables.py fill
  say "done: small tables are in $study, and the texts say what they say (git diff shows what is new)"
}

own_functions=$(compgen -A function | tr '\n' ' ')
if ! [[ ${GENERATIONS:-0} =~ ^[0-9]+$ ]]; then
  refuse "GENERATIONS=$GENERATIONS: must be a whole number"
fi
generations_or ""

only_check=
if [ "${1:-}" = --check ]; then
  only_check=yes
  shift
fi
if [ $# -eq 0 ]; then
  list
else
  run "$@"
fi
