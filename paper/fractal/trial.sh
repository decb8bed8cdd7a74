#!/usr/bin/env bash
# Runs a whole trial of study.toml, or of the study named first, exports its champion and says what it cost. Made for nights: with
# a number of hours it stops then, keeps what is done, and the next call goes on from there.
#   paper/fractal/trial.sh [study.toml] [folder of the results] [folder of the programs] [hours] [options of menger evolve, such as --seed 2]
# Another trial needs another folder.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
study=$here/study.toml
if [[ ${1:-} == *.toml ]]; then
  study=$1
  shift
fi
out=${1:-trial}
programs=${2:-$here/../../build/release/bin}
hours=${3:-}
menger=$(cd "$programs" && pwd)/menger
archive=$out/trial.sqlite
mkdir -p "$out"

search=("$menger" evolve "$study" -o "$archive" "${@:4}")
code=0
if [ -n "$hours" ]; then
  timeout --foreground --signal=INT "${hours}h" "${search[@]}" || code=$?
else
  "${search[@]}" || code=$?
fi
# 124 is the clock's word for a search that was stopped in time, 130 the search's own.
case $code in
  0 | 124 | 130) ;;
  *) exit "$code" ;;
esac
if ! "$menger" export "$archive" -o "$out" --timings --no-frames --no-pictures --levels 1; then
  [ "$code" -eq 0 ] && exit 1
  exit 130  # stopped before there was anything to export; the next call goes on
fi

# What it took so far: evaluations, pruned and cached ones, the time of every generation, and from it that of a trial. A generation
# that was interrupted counts from when it was begun again, so that a night ends with one that is too short.
awk -F, '
  FNR == 1 { ++file; for (i = 1; i <= NF; ++i) at[file, $i] = i; next }
  function value(name) { return $at[file, name] }
  file == 1 { ++generations; made += value("evaluations"); cached += value("cached"); pruned += value("pruned") }
  file == 2 { voxel_steps += value("voxels") * value("steps"); voxels[value("level")] += value("voxels"); ++tasks[value("level")] }
  file == 3 { took[value("generation")] = value("wall_seconds") }
  END {
    asked = made + cached + pruned
    printf "%d generations: %d evaluations made (%.1f %%), %d cached (%.1f %%), %d pruned (%.1f %%)\n", generations, made,
           100 * made / asked, cached, 100 * cached / asked, pruned, 100 * pruned / asked
    for (level = 1; level <= 9; ++level)
      if (tasks[level]) printf "level %d: %d evaluations of %.1f voxels\n", level, tasks[level], voxels[level] / tasks[level]
    for (n = 0; n < generations; ++n) all += took[n]
    printf "%.4g voxel-steps in %.0f s: %.3g million a second\n", voxel_steps, all, voxel_steps / all / 1e6
    if (generations > 1) {
      later = (all - took[0]) / (generations - 1)
      printf "%.1f s a generation after generation 0 (%.1f s); 325 of them take %.1f h\n", later, took[0], (took[0] + 325 * later) / 3600
    }
  }' "$out/generations.csv" "$out/timings.csv" "$out/schedule.csv"
[ "$code" -eq 0 ] || exit 130
