#!/usr/bin/python3
"""What the trials of the paper's main experiment and of its control say: champions.csv, statistics.csv, comparisons.csv and trials.svg.

trials.py    reads the tables of trials that there are: two_scales/SEED.csv here and in ../non_fractal, two_scales_in_pieces/SEED.csv

Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import numpy as np  # noqa: E402
from sample_statistics import mean, rank_sum, share  # noqa: E402
from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402
from svg_figure import pyplot_for_svg, write_svg  # noqa: E402

ARMS = {"fractal": (HERE / "two_scales", "fractal", "#0072B2", "-"),
        "in_pieces": (HERE / "two_scales_in_pieces", "fractal, aggregates may fall apart", "#56B4E9", "--"),
        "non_fractal": (HERE.parent / "non_fractal" / "two_scales", "arrangement evolved apart", "#D55E00", "-.")}
COMPARISONS = (("fractal", "non_fractal"), ("in_pieces", "non_fractal"), ("fractal", "in_pieces"))
DURATION_S = 5.0
PER_MINUTE = 60.0 / DURATION_S


class Trial:
    """The champions of a trial, generation by generation."""

    def __init__(self, file):
        self.rows = read_table(file)
        if not self.rows:
            raise InputError(f"{file}: has no generation")
        self.seed = int(file.stem)
        # Before any robot has a fitness the best is none.
        self.best = np.array([float(row["best_fitness_body_lengths"] or 0.0) for row in self.rows]) * PER_MINUTE
        self.dimension = np.array([float(row["hausdorff_dimension"] or "nan") for row in self.rows])
        self.cells = int(self.rows[-1]["champion_cells"])
        self.speeds = [float(self.rows[-1][f"level_{level}_displacement_body_lengths"]) * PER_MINUTE for level in (1, 2)]


def trials_of(folder):
    trials = [Trial(file) for file in sorted(folder.glob("*.csv"), key=lambda file: int(file.stem))]
    if len({len(trial.best) for trial in trials}) > 1:
        raise InputError(f"{folder}: its trials have different numbers of generations")
    return trials


def champions(arms):
    return [{"arm": arm, "seed": trial.seed, "body_lengths_per_minute": float(trial.best[-1]), "level_1_per_minute": trial.speeds[0],
             "level_2_per_minute": trial.speeds[1], "cells": trial.cells, "dimension": float(trial.dimension[-1]) if np.isfinite(trial.dimension[-1]) else None}
            for arm, trials in arms.items() for trial in trials]


def statistics(arms):
    rows = []
    for arm, trials in arms.items():
        first, last = mean([trial.best[0] for trial in trials]), mean([trial.best[-1] for trial in trials])
        slower = share(sum(trial.speeds[1] < trial.speeds[0] for trial in trials), len(trials))
        scales = rank_sum([trial.speeds[0] for trial in trials], [trial.speeds[1] for trial in trials])
        rows.append({"arm": arm, "trials": len(trials), "generations": len(trials[0].best) - 1,
                     "first": first.value, "first_low": first.low, "first_high": first.high,
                     "last": last.value, "last_low": last.low, "last_high": last.high,
                     "p_first_last": rank_sum([trial.best[-1] for trial in trials], [trial.best[0] for trial in trials]).p,
                     "larger_is_slower": slower.value, "larger_is_slower_low": slower.low, "larger_is_slower_high": slower.high,
                     "p_scales": scales.p,
                     "plane": sum(trial.cells == 9 and trial.dimension[-1] == 2.0 for trial in trials),
                     "dimension_2.5_to_2.7": sum(2.5 < trial.dimension[-1] < 2.7 for trial in trials)})
    return rows


def comparisons(arms):
    rows = []
    for first, second in COMPARISONS:
        if first not in arms or second not in arms:
            continue
        ends = [[trial.best[-1] for trial in arms[arm]] for arm in (first, second)]
        test = rank_sum(*ends)
        rows.append({"arms": f"{first} and {second}", "trials": len(ends[0]), "other_trials": len(ends[1]), "p": test.p, "larger": test.larger.value,
                     "larger_low": test.larger.low, "larger_high": test.larger.high,
                     "medians_ratio": float(np.median(ends[0]) / np.median(ends[1]))})
    return rows


def draw(arms):
    """Best robots over generations with intervals, those of the ends, and the dimension of fractal champions."""
    pyplot = pyplot_for_svg()
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 4.0), layout="constrained", width_ratios=(1.2, 0.9, 1.2))
    for arm, trials in arms.items():
        _, label, colour, dashes = ARMS[arm]
        best = np.array([trial.best for trial in trials])
        generations = range(best.shape[1])
        axes[0].plot(generations, best.mean(axis=0), dashes, color=colour, label=f"{label} (n = {len(trials)})")
        if len(trials) > 1:
            spans = [mean(column) for column in best.T]
            low, high = ([end if end is not None else span.value for span in spans for end in [getattr(span, side)]] for side in ("low", "high"))
            axes[0].fill_between(generations, low, high, color=colour, alpha=0.15, linewidth=0)
        place = list(arms).index(arm)
        spread = np.linspace(-0.15, 0.15, len(trials)) if len(trials) > 1 else [0.0]
        axes[1].plot(place + np.asarray(spread), best[:, -1], "o", color=colour, markersize=4)
        axes[1].plot([place - 0.25, place + 0.25], [np.median(best[:, -1])] * 2, color=colour)
        if arm == "fractal":
            for trial in trials:
                axes[2].plot(generations, trial.dimension, color=colour, alpha=0.6, linewidth=1)
    axes[0].set(xlabel="generation", ylabel="fitness of the best robot\n(body lengths per minute, mean and 95 % interval)", ylim=(0, None))
    axes[0].legend(loc="upper left", fontsize=8)
    axes[1].set(ylabel="best robot at the end\n(body lengths per minute; line: median)", ylim=(0, None), xlim=(-0.5, len(arms) - 0.5))
    axes[1].set_xticks(range(len(arms)), [ARMS[arm][1].replace(", ", ",\n").replace(" evolved", "\nevolved") for arm in arms])
    axes[2].set(xlabel="generation", ylabel="Hausdorff dimension of the best robot\n(a line for each fractal trial)", ylim=(0.9, 3.1))
    for panel in (axes[0], axes[2]):
        panel.xaxis.get_major_locator().set_params(integer=True)
    for panel in axes:
        panel.grid(color="#dddddd")
        panel.set_axisbelow(True)
    write_svg(figure, HERE / "trials.svg")


def main(arguments):
    if arguments:
        raise InputError(__doc__)
    arms = {arm: trials for arm, (folder, *_) in ARMS.items() if (trials := trials_of(folder))}
    if not arms:
        raise InputError(f"{ARMS['fractal'][0]}: has no trial yet: ./run paper fractal two_scales_1")
    for name, rows in (("champions", champions(arms)), ("statistics", statistics(arms)), ("comparisons", comparisons(arms))):
        if rows:
            write_table(HERE / f"{name}.csv", list(rows[0]), [[cell(value) for value in row.values()] for row in rows])
    draw(arms)


if __name__ == "__main__":
    run_script(main)
