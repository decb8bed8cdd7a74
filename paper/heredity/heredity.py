#!/usr/bin/python3
"""How much of its parent's speed a mutant keeps, how often it is no new robot, and whether the control's first robots are faster than
fractals: heredity.csv, inherited.csv, mutants.csv, repeats.csv, first_robots.csv and first_robots_compared.csv.

heredity.py FOLDER    reads FOLDER/ARM-SEED/individuals.csv, which menger export --individuals writes

heredity.csv   for each arm and number of cells that differ, means over trials with bootstrap intervals: Spearman's rank correlation of the speeds
               of parents and mutants at each scale, the share of mutants that keep half of the speed, and the share that are faster
inherited.csv  the same of all mutants, however many cells differ; of the control for each kind of mutants
mutants.csv    of mutants and of robots that are drawn at random: the share whose slowest scale goes 15 body lengths a minute,
               and the share of mutants that are fitter than their parents
repeats.csv    for each arm: the share of mutants that are robots which the search had before, of all of them and of those of the best robot
               so far
first_robots.csv, first_robots_compared.csv
               of robots that are drawn at random, each once: their speeds and the rank correlation of the speeds at both scales, of those
               of the first generations and the fractals of ../discrepancies, which all walk at both; the share that goes 15 body lengths a
               minute at both scales, of all that were drawn; how often one of the control is faster than a fractal. Made only if there are
               trials of all seeds

Mutants of the control, whose larger scale evolves apart, are of two kinds: those that change the body and those that change its arrangement
alone, which go as fast at 3 cells as their parents. inherited.csv tells those of the body apart, too, by whether the arrangement changes. heredity.csv leaves its trials out.
In trials at two scales the larger one walks only where selection needs it: such mutants are fast at the smaller one, be it of their own or
because they kept the body of a fast parent. Only trials with ten such mutants count.
Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance")]

import numpy as np  # noqa: E402
from sample_statistics import fisher, mean, median, rank_correlation, rank_sum, share, share_of_larger, spearman  # noqa: E402
from scale_invariance import AT_TWO_SCALES, PER_MINUTE, body_lengths, ends  # noqa: E402
from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402

LEVELS = (1, 2)
CELLS_CHANGED = ((1, 1), (2, 2), (3, 4), (5, 8), (9, 27))
FEWEST_MUTANTS = 10  # of a trial, fewer of which have no rank correlation to speak of
FAST_PER_MINUTE = 15.0
ARRANGEMENT_ALONE = "mutants of its arrangement alone"  # those of the control that keep the body
ARMS = ("fractal", "in_pieces", "single_cells", "three_cells", "three_cells_single", "nine_cells", "nine_cells_single", "balanced", "new_mutants", "fractal_again", "control", "control_again", "body_mutants")  # in the order of the tables


# Trials at two scales of the same physics and rules, whose first robots are drawn at random and walk at both scales
# (arms of the same seeds, which have the same first robots, together).
FIRST_ROBOTS = {"fractals": (("fractal", "new_mutants"), ("fractal_again",)), "control": (("control", "body_mutants"), ("control_again",))}


def speeds_of(rows, level):
    """Body lengths a minute; not a number where a robot did not walk."""
    return PER_MINUTE * body_lengths(ends(rows, level), level) if rows else np.empty(0)


class Trial:
    """The mutants of a search with their parents, and its random robots."""

    def __init__(self, file):
        rows = read_table(file)
        by_number = {row["individual"]: row for row in rows}
        self.drawn = [row for row in rows if not row["parent"]]
        self.first = [row for row in self.drawn if row["generation"] == "0"]
        self.mutants = [row for row in rows if row["parent"]]
        self.parents = [by_number[row["parent"]] for row in self.mutants]
        # The body, and where the larger scale evolves apart its arrangement
        self.changed = [[sum(one != other for one, other in zip(*parts)) for parts in zip(row["phenotype"].split("|"), parent["phenotype"].split("|"))]
                        for row, parent in zip(self.mutants, self.parents)]
        self.cells_changed = np.array([sum(parts) for parts in self.changed], dtype=int)
        self.is_fractal = all("|" not in row["phenotype"] for row in rows)
        self.speeds = {level: (speeds_of(self.parents, level), speeds_of(self.mutants, level)) for level in LEVELS}
        self.kinds = self.which_mutants()
        self.kinds_that_inherit = self.kinds if self.is_fractal else self.kinds | self.which_of_the_body()
        self.repeats, self.repeats_of_best = self.which_repeat(rows)

    @staticmethod
    def which_repeat(rows):
        """Whether each mutant is a robot that the search had before; the same of the mutants of the best robot of the generations before,
        which is there more than once if mutants repeat it."""
        phenotypes = {row["individual"]: row["phenotype"] for row in rows}
        seen, repeats, of_best = set(), [], []
        best = best_of_generation = (-np.inf, None)  # fitness and phenotype
        generation = "0"
        for row in rows:
            if row["generation"] != generation:
                generation, best = row["generation"], best_of_generation
            if row["parent"]:
                repeats.append(row["phenotype"] in seen)
                if phenotypes[row["parent"]] == best[1]:
                    of_best.append(repeats[-1])
            seen.add(row["phenotype"])
            if row["fitness_body_lengths"] and float(row["fitness_body_lengths"]) > best_of_generation[0]:
                best_of_generation = (float(row["fitness_body_lengths"]), row["phenotype"])
        return repeats, of_best

    def which_mutants(self):
        """The name of each kind of mutants, and which they are."""
        if self.is_fractal:
            return {"mutants": np.full(len(self.mutants), True)}
        of_body = np.array([parts[0] > 0 for parts in self.changed], dtype=bool)
        return {"mutants of the body": of_body, ARRANGEMENT_ALONE: ~of_body & (self.cells_changed > 0)}

    def which_of_the_body(self):
        """Those of the body that keep its arrangement, and those that change both."""
        arrangement_kept = np.array([parts[1] == 0 for parts in self.changed], dtype=bool)
        of_body = self.kinds["mutants of the body"]
        return {"mutants of the body alone": of_body & arrangement_kept, "mutants of both": of_body & ~arrangement_kept}

    def heredity(self, level, which):
        """Of some of the mutants: the correlation, the share that keeps half of the speed and the share that is faster; or nothing where there
        are few mutants."""
        parents, mutants = self.speeds[level]
        there = which & np.isfinite(parents) & np.isfinite(mutants)
        if there.sum() < FEWEST_MUTANTS:
            return None
        parents, mutants = parents[there], mutants[there]
        return int(there.sum()), rank_correlation(parents, mutants), float(np.mean(mutants >= 0.5 * parents)), float(np.mean(mutants > parents))


def kept_speed(trials, level, which):
    """Of the mutants of each trial that which(trial) names: columns of a row, or nothing where there are none."""
    found = [one for trial in trials if (one := trial.heredity(level, which(trial)))]
    if not found:
        return None
    numbers, *samples = zip(*found)
    row = {"trials": len(found), "mutants": sum(numbers)}
    for name, sample in zip(("spearman", "keep_half", "faster"), samples):
        row |= mean(sample).cells(name)
    return row


def heredity(arm, trials):
    for level in LEVELS:
        for low, high in CELLS_CHANGED:
            if row := kept_speed(trials, level, lambda trial: (low <= trial.cells_changed) & (trial.cells_changed <= high)):
                yield {"arm": arm, "cells_per_side": 3**level, "cells_changed": f"{low}" if low == high else f"{low} to {high}"} | row


def inherited(arm, trials):
    for kind in trials[0].kinds_that_inherit:
        for level in LEVELS[1:] if kind == ARRANGEMENT_ALONE else LEVELS:
            if row := kept_speed(trials, level, lambda trial: trial.kinds_that_inherit[kind] & (trial.cells_changed > 0)):
                yield {"arm": arm, "cells_per_side": 3**level, "kind": kind} | row


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


def repeats(arm, trials):
    row = {"arm": arm, "trials": len(trials), "mutants": sum(len(trial.mutants) for trial in trials)}
    for name in ("repeats", "repeats_of_best"):
        row |= mean([float(np.mean(found)) for trial in trials if (found := getattr(trial, name))] or [np.nan]).cells(name)
    yield row


def drawn_robots(arms, part):
    """The speeds at both scales of robots that were drawn at random, each robot once: {kind: array (robots, scales)}; nothing where trials of some
    seeds are not there.

    @param part which rows of a trial: first, which all walk at both scales, or drawn, of whom slow ones may not walk at the larger one"""
    if not all(set(names) & set(arms) for of_kind in FIRST_ROBOTS.values() for names in of_kind):
        return {}
    file = AT_TWO_SCALES["random"]
    rows = {kind: [row for names in of_kind for name in names for trial in arms.get(name, []) for row in getattr(trial, part)] for kind, of_kind in FIRST_ROBOTS.items()}
    rows["fractals"] += read_table(file) if file.exists() else []
    robots = {kind: list({row["phenotype"]: row for row in of_kind}.values()) for kind, of_kind in rows.items()}
    return {kind: np.array([speeds_of(of_kind, level) for level in LEVELS]).T for kind, of_kind in robots.items()}


def by_scale(both):
    """The speeds at each scale, and the fitness."""
    return {f"{3**level} cells": both[:, at] for at, level in enumerate(LEVELS)} | {"fitness": both.min(axis=1)}


def first_robots(first, drawn):
    """Of each kind: medians and the rank correlation of the speeds at both scales, of the first robots; the share of fast ones, of all that were
    drawn; Fisher's exact test of both shares."""
    fast = {kind: (int(np.sum(both.min(axis=1) >= FAST_PER_MINUTE)), len(both)) for kind, both in drawn.items()}
    for kind, both in first.items():
        row = {"kind": kind, "robots": len(both)}
        for name, of_scale in by_scale(both).items():
            row |= median(of_scale).cells(f"{name.replace(' ', '_')}_median")
        yield row | spearman(*both.T).cells("spearman") | {"drawn": fast[kind][1]} | share(*fast[kind]).cells("fast") | {"p_fast": fisher(*fast["control"], *fast["fractals"])}


def first_robots_compared(first, _):
    """How often one of the control is faster than a fractal."""
    control = by_scale(first["control"])
    for name, fractals in by_scale(first["fractals"]).items():
        yield {"speed": name} | share_of_larger(control[name], fractals).cells("control_is_faster") | {"p": rank_sum(control[name], fractals)}


# The rows of each table, and the arms that it has
TABLES = {"heredity": (heredity, ("fractal", "single_cells", "balanced")), "inherited": (inherited, ARMS),
          "mutants": (fast_robots, ("fractal", "balanced", "fractal_again", "control", "control_again")), "repeats": (repeats, ARMS)}


def main(arguments):
    if len(arguments) != 1:
        raise InputError(__doc__)
    arms = {arm: [Trial(file) for file in sorted(pathlib.Path(arguments[0]).glob(f"{arm}-*/individuals.csv"))] for arm in ARMS}
    arms = {arm: begun for arm, trials in arms.items() if (begun := [trial for trial in trials if trial.mutants])}
    if not arms:
        raise InputError(f"{arguments[0]}: has no ARM-SEED/individuals.csv with mutants")
    for name, (rows_of, its_arms) in TABLES.items():
        file = HERE / f"{name}.csv"
        made = [row for arm in its_arms if arm in arms for row in rows_of(arm, arms[arm])]
        there = {row["arm"] for row in made}
        kept = [row for row in (read_table(file) if file.exists() else []) if row["arm"] not in there]  # arms whose archives are gone keep their rows
        rows = kept + [{key: cell(value) for key, value in row.items()} for row in made]
        if rows:
            rows.sort(key=lambda row: ARMS.index(row["arm"]))
            write_table(file, list(rows[0]), rows)
    first, drawn = (drawn_robots(arms, part) for part in ("first", "drawn"))
    if first:
        first = {kind: both[np.isfinite(both).all(axis=1)] for kind, both in first.items()}
        for name, rows_of_both in (("first_robots", first_robots), ("first_robots_compared", first_robots_compared)):
            rows = [{key: cell(value) for key, value in row.items()} for row in rows_of_both(first, drawn)]
            write_table(HERE / f"{name}.csv", list(rows[0]), rows)


if __name__ == "__main__":
    run_script(main)
