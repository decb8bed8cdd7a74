#!/usr/bin/python3
"""How much of its parent's speed a mutant keeps, by the number of cells that differ: heredity.csv and mutants.csv.

heredity.py FOLDER    reads FOLDER/ARM-SEED/individuals.csv, which menger export --individuals writes

heredity.csv  for each arm and number of cells, means over trials with bootstrap intervals: Spearman's rank correlation of the speeds of
              parents and mutants at each scale, the share of mutants that keep half of the speed, and the share that are faster
mutants.csv   for each arm, of mutants and of robots that are drawn at random: the share whose slowest scale goes 15 body lengths a minute,
              and the share of mutants that are fitter than their parents. Mutants of the control, whose larger scale evolves apart, are
              those that change the body and those that change its arrangement alone; the control is not in heredity.csv

The larger scale walks only where selection needs it: such mutants are fast at the smaller one. Only trials with ten such mutants count.
Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance")]

import numpy as np  # noqa: E402
from sample_statistics import mean, rank_correlation  # noqa: E402
from scale_invariance import PER_MINUTE, body_lengths, ends  # noqa: E402
from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402

LEVELS = (1, 2)
CELLS_CHANGED = ((1, 1), (2, 2), (3, 4), (5, 8), (9, 27))
FEWEST_MUTANTS = 10  # of a trial, fewer of which have no rank correlation to speak of
FAST_PER_MINUTE = 15.0
ARMS = ("fractal", "single_cells", "balanced", "control")  # in the order of the tables


def speeds_of(rows, level):
    """Body lengths a minute; not a number where a robot did not walk."""
    return PER_MINUTE * body_lengths(ends(rows, level), level) if rows else np.empty(0)


class Trial:
    """The mutants of a search with their parents, and its random robots."""

    def __init__(self, file):
        rows = read_table(file)
        by_number = {row["individual"]: row for row in rows}
        self.drawn = [row for row in rows if not row["parent"]]
        self.mutants = [row for row in rows if row["parent"]]
        self.parents = [by_number[row["parent"]] for row in self.mutants]
        # The body, and where the larger scale evolves apart its arrangement
        self.changed = [[sum(one != other for one, other in zip(*parts)) for parts in zip(row["phenotype"].split("|"), parent["phenotype"].split("|"))]
                        for row, parent in zip(self.mutants, self.parents)]
        self.cells_changed = np.array([sum(parts) for parts in self.changed], dtype=int)
        self.speeds = {level: (speeds_of(self.parents, level), speeds_of(self.mutants, level)) for level in LEVELS}
        self.kinds = self.which_mutants()

    def which_mutants(self):
        """The name of each kind of mutants, and which they are."""
        if self.changed and len(self.changed[0]) == 1:
            return {"mutants": np.full(len(self.mutants), True)}
        of_body = np.array([parts[0] > 0 for parts in self.changed])
        return {"mutants of the body": of_body, "mutants of its arrangement alone": ~of_body & (self.cells_changed > 0)}

    def heredity(self, level, low, high):
        """The correlation, the share that keeps half of the speed and the share that is faster; or nothing where there are few mutants."""
        parents, mutants = self.speeds[level]
        there = (self.cells_changed >= low) & (self.cells_changed <= high) & np.isfinite(parents) & np.isfinite(mutants)
        if there.sum() < FEWEST_MUTANTS:
            return None
        parents, mutants = parents[there], mutants[there]
        return int(there.sum()), rank_correlation(parents, mutants), float(np.mean(mutants >= 0.5 * parents)), float(np.mean(mutants > parents))


def heredity(arm, trials):
    for level in LEVELS:
        for low, high in CELLS_CHANGED:
            found = [one for trial in trials if (one := trial.heredity(level, low, high))]
            if found:
                numbers, *samples = zip(*found)
                row = {"arm": arm, "cells_per_side": 3**level, "cells_changed": f"{low}" if low == high else f"{low} to {high}", "trials": len(found), "mutants": sum(numbers)}
                for name, sample in zip(("spearman", "keep_half", "faster"), samples):
                    row |= mean(sample).cells(name)
                yield row


def fast_share(fitness):
    """The share of fast robots, mean over trials."""
    return mean([float(np.mean(one >= FAST_PER_MINUTE)) for one in fitness]).cells("fast")


def fast_robots(arm, trials):
    """Who did not walk at the larger scale was not needed there, and counts as slow, and as no fitter than its parent."""
    both = [[np.min([trial.speeds[level][side] for level in LEVELS], axis=0) for side in (0, 1)] for trial in trials]  # of parents and of mutants
    for kind in trials[0].kinds:
        parents, mutants = zip(*([side[trial.kinds[kind]] for side in sides] for trial, sides in zip(trials, both)))
        fitter = mean([float(np.mean(one > other)) for one, other in zip(mutants, parents)])
        yield {"arm": arm, "kind": kind, "trials": len(trials), "robots": sum(map(len, mutants))} | fast_share(mutants) | fitter.cells("fitter")
    drawn = [np.min([speeds_of(trial.drawn, level) for level in LEVELS], axis=0) for trial in trials]
    yield {"arm": arm, "kind": "drawn at random", "trials": len(trials), "robots": sum(map(len, drawn))} | fast_share(drawn) | dict.fromkeys(
        ("fitter", "fitter_low", "fitter_high"))


# The rows of each table, and the arms that it has
TABLES = {"heredity": (heredity, ("fractal", "single_cells", "balanced")), "mutants": (fast_robots, ("fractal", "balanced", "control"))}


def main(arguments):
    if len(arguments) != 1:
        raise InputError(__doc__)
    arms = {arm: [Trial(file) for file in sorted(pathlib.Path(arguments[0]).glob(f"{arm}-*/individuals.csv"))] for arm in ARMS}
    arms = {arm: trials for arm, trials in arms.items() if trials}
    if not arms:
        raise InputError(f"{arguments[0]}: has no ARM-SEED/individuals.csv")
    for name, (rows_of, its_arms) in TABLES.items():
        file = HERE / f"{name}.csv"
        made = [row for arm in its_arms if arm in arms for row in rows_of(arm, arms[arm])]
        there = {row["arm"] for row in made}
        kept = [row for row in (read_table(file) if file.exists() else []) if row["arm"] not in there]  # arms whose archives are gone keep their rows
        rows = kept + [{key: cell(value) for key, value in row.items()} for row in made]
        if rows:
            rows.sort(key=lambda row: ARMS.index(row["arm"]))
            write_table(file, list(rows[0]), rows)


if __name__ == "__main__":
    run_script(main)
