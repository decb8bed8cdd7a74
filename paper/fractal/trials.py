#!/usr/bin/python3
"""What the trials of the paper's main experiment and of its control say: champions.csv, statistics.csv, scales.csv, comparisons.csv,
without_fault.csv, on_the_way.csv, equal_evaluations.csv, trials.svg and variants.svg.

trials.py    reads the tables of trials that there are: two_scales/SEED.csv here and in ../non_fractal, two_scales_in_pieces/SEED.csv,
             two_scales_balanced/SEED.csv, single_cells/SEED.csv, new_mutants/SEED.csv, body_mutants/SEED.csv in ../non_fractal, and
             again/SEED.csv, again_balanced/SEED.csv, random_search/SEED.csv and three_scales/SEED.csv in both folders

Trials of an arm count up to the last generation that all of them have, or that was planned, so that each can go on at another time. Those
that went on stand once more in an arm of their own, such as fractal_longer, up to the last generation that all of these have. Two arms are
compared at the last generation that both have (on_the_way.csv: every twentieth before it; equal_evaluations.csv: after as many walks): by
the rank-sum test, or by the signed-rank test where they have the same seeds and so begin with the same robots. Trials went on after their
test had been looked at. So p_looks is p times the number of looks, one for every twenty generations (Bonferroni), and p_looks decides the
outcome of a comparison, and of dimensions. Those of again/ repeat the comparison with the control with other seeds, and those of
again_balanced/ without the fault of the simulator: fifteen of each kind, of 60 generations, are tested once, and are in no table and no
figure before. without_fault.csv asks whether the fault changes the control's lead: how many times as fit the best robot is without the
fault as that of the same seed with it, fractals against the control. scales.csv has each scale of the best robots by itself. The best robot
of a trial at first and at the end, and a champion at two scales, are pairs, too; the rank-sum test, which the paper used and which takes
them for samples apart, stands beside. The best robot can only rise, so fractal trials are also compared with trials of random search, which
draw as many robots, with trials whose mutants differ in one cell at most and so inherit more, and with trials in which no robot comes
twice. The control is compared with random search among its own robots, and with trials in which every mutant has another body, as mutants
of fractals have.
An outcome is "reproduced" if an interval lies on the paper's side of what there is without an effect, "not reproduced" on the other side,
else "open"; where two arms are compared, the test has to agree (p_looks < 0.05). That scales do not differ is "not reproduced" if the
paper's test, the rank sum, tells them apart (p < 0.05), else "open". Dimensions of champions "differ" if they are spread otherwise than the
paper's over planes, 2.5 to 2.7, and others, by Freeman and Halton's exact test (its p times the looks < 0.05).
trials.svg shows the paper's experiment, its control and random search; variants.svg each arm that changes one thing in one of these, or
in the repetition, against it.
Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys
from dataclasses import dataclass, replace
from itertools import groupby
from textwrap import fill

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance")]

import numpy as np  # noqa: E402
from sample_statistics import OUTCOMES, freeman_halton, geometric_mean, geometric_means_ratio, mean, rank_sum, share, share_of_larger, share_of_larger_pairs, signed_rank, tells_apart, verdict  # noqa: E402
from scale_invariance import LEVELS, PER_MINUTE  # noqa: E402
from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402
from svg_figure import letter_panels, pyplot_for_svg, settle, write_svg  # noqa: E402


@dataclass(frozen=True)
class Plan:
    """With how many trials and generations an arm is tested."""

    trials: int
    generations: int


@dataclass(frozen=True)
class Arm:
    """Where the tables of its trials are, and how it is drawn."""

    folder: pathlib.Path
    label: str
    colour: str
    dashes: str | tuple
    mark: str
    is_fractal: bool = True  # robots of the control are none, and have no dimension
    is_variant: bool = False  # of the paper's experiment or its control: something is changed, if only the seeds
    planned: Plan | None = None  # of arms that are tested once
    changes: str | None = None  # the arm in which it changes something, where that is not the paper's experiment or its control

    def is_complete(self, trials):
        return self.planned is None or (len(trials), len(trials[0].best) - 1) == (self.planned.trials, self.planned.generations)

    def longer(self):
        dashes = {"-": (0, (1, 0.6)), "-.": (0, (5, 1, 1, 1, 1, 1))}.get(self.dashes, (0, (5, 1)))
        return replace(self, planned=None, label=f"{self.label}, longer", dashes=dashes, mark={"o": "x", "s": "+"}.get(self.mark, "*"))


NON_FRACTAL = HERE.parent / "non_fractal"
ARMS = {"fractal": Arm(HERE / "two_scales", "fractal", "#0072B2", "-", "o"),
        "in_pieces": Arm(HERE / "two_scales_in_pieces", "fractal, may fall apart", "#56B4E9", "-", "v", is_variant=True),
        "balanced": Arm(HERE / "two_scales_balanced", "balanced beams", "#E69F00", "-", "P", is_variant=True),
        "single_cells": Arm(HERE / "single_cells", "single cells mutate", "#661100", "-", "h", is_variant=True),
        "new_mutants": Arm(HERE / "new_mutants", "fractal, none twice", "#117733", "-", "*", is_variant=True),
        "random_search": Arm(HERE / "random_search", "random search", "#777777", (0, (1, 1.5)), "X"),
        "non_fractal": Arm(NON_FRACTAL / "two_scales", "control", "#D55E00", "-.", "s", is_fractal=False),
        "non_fractal_random_search": Arm(NON_FRACTAL / "random_search", "control at random", "#AA4499", "-", "p", is_fractal=False, is_variant=True),
        "non_fractal_body_mutants": Arm(NON_FRACTAL / "body_mutants", "control, bodies mutate", "#999933", "-", "d", is_fractal=False, is_variant=True),
        "fractal_again": Arm(HERE / "again", "fractal, again", "#44AA99", "-", "<", is_variant=True, planned=Plan(15, 60)),
        "non_fractal_again": Arm(NON_FRACTAL / "again", "control, again", "#882255", "-", ">", is_fractal=False, is_variant=True, planned=Plan(15, 60)),
        "fractal_again_balanced": Arm(HERE / "again_balanced", "fractal, again, balanced", "#0072B2", "-", "8", is_variant=True, planned=Plan(15, 60), changes="fractal_again"),
        "non_fractal_again_balanced": Arm(NON_FRACTAL / "again_balanced", "control, again, balanced", "#D55E00", "-", "H", is_fractal=False, is_variant=True, planned=Plan(15, 60),
                                          changes="non_fractal_again"),
        "three_scales": Arm(HERE / "three_scales", "fractal, three scales", "#009E73", "--", "D"),
        "non_fractal_three_scales": Arm(NON_FRACTAL / "three_scales", "control, three scales", "#CC79A7", (0, (3, 1, 1, 1, 1, 1)), "^", is_fractal=False)}
LONGER = {f"{name}_longer": arm.longer() for name, arm in ARMS.items()}
DRAWN = ARMS | LONGER
SCALE_STYLES = {1: ("#B79FCB", "-", 3.2), 2: ("#762A83", "--", 1.6), 3: ("#000000", ":", 1.9)}  # no colours of arms; all show where they are on each other
WITH_AND_WITHOUT_FAULT = (("fractal_again", "fractal_again_balanced"), ("non_fractal_again", "non_fractal_again_balanced"))
COMPARISONS = (("fractal", "non_fractal"), ("fractal_again", "non_fractal_again"), ("fractal_again_balanced", "non_fractal_again_balanced"),
               *WITH_AND_WITHOUT_FAULT,
               ("in_pieces", "non_fractal"), ("fractal", "in_pieces"), ("fractal", "balanced"), ("fractal", "random_search"),
               ("single_cells", "fractal"), ("single_cells", "random_search"),
               ("new_mutants", "fractal"), ("new_mutants", "random_search"), ("new_mutants", "non_fractal"),
               ("non_fractal", "non_fractal_random_search"), ("non_fractal_random_search", "random_search"),
               ("non_fractal", "non_fractal_body_mutants"), ("fractal", "non_fractal_body_mutants"),
               ("three_scales", "non_fractal_three_scales"), ("fractal_longer", "non_fractal_longer"))
STRIDE = 20  # generations between comparisons on the way, and between looks at the test
EARLY = 20  # generations
PAPER_DIMENSIONS = (5, 5, 0)  # champions of the paper that are planes, have a dimension of 2.5 to 2.7, or another one


class Trial:
    """The champions of a trial, generation by generation."""

    def __init__(self, seed, rows):
        self.rows = rows
        self.seed = seed
        # Before any robot has a fitness the best is none.
        self.best = self.column("best_fitness_body_lengths", "0") * PER_MINUTE
        self.dimension = self.column("hausdorff_dimension", "nan")
        self.evaluations = self.column("evaluations", "0").cumsum() if "evaluations" in rows[0] else None
        self.cells = int(self.rows[-1]["champion_cells"])
        columns = {level: f"level_{level}_displacement_body_lengths" for level in LEVELS}
        self.speeds = {level: self.column(column, "nan") * PER_MINUTE for level, column in columns.items() if column in self.rows[0]}

    def column(self, name, otherwise):
        return np.array([float(row[name] or otherwise) for row in self.rows])

    def best_after(self, evaluations):
        """The best fitness of the last generation that needed no more evaluations, and this generation."""
        generation = int(np.searchsorted(self.evaluations, evaluations, side="right")) - 1
        return float(self.best[generation]), generation

    def last_speed(self, level):
        return float(self.speeds[level][-1]) if level in self.speeds else None


def arms_of(name, folder, planned=None):
    """The trials of an arm up to the last generation that all of them have, or that was planned, and in an arm of their own those that are
    longer."""
    rows = {int(file.stem): read_table(file) for file in folder.glob("*.csv")}
    for seed, found in rows.items():
        if not found:
            raise InputError(f"{folder}/{seed}.csv: has no generation")
    arms = {}
    while rows and len(arms) < 2:
        shortest = min(map(len, rows.values()))
        if planned is not None and not arms:
            shortest = min(shortest, planned + 1)
        arms[f"{name}_longer" if arms else name] = [Trial(seed, found[:shortest]) for seed, found in sorted(rows.items())]
        rows = {seed: found for seed, found in rows.items() if len(found) > shortest}
    return arms


def champions(arms):
    return [{"arm": arm, "seed": trial.seed, "generations": len(trial.best) - 1, "body_lengths_per_minute": float(trial.best[-1])}
            | {f"level_{level}_per_minute": trial.last_speed(level) for level in LEVELS}
            | {"cells": trial.cells, "dimension": float(trial.dimension[-1]) if np.isfinite(trial.dimension[-1]) else None}
            for arm, trials in arms.items() for trial in trials]


def are_planned(names):
    """Whether these arms are tested once, with the trials and generations that were planned."""
    return bool(names) and all(DRAWN[name].planned for name in names)


def looks(generation, *names):
    """How often a test of these arms was looked at until a generation, whose trials then went on."""
    return 1 if are_planned(names) else max(1, -(-generation // STRIDE))


def times_looks(p, looked):
    """Bonferroni's correction for looks at a test; None where there is no p."""
    return None if p is None else min(1.0, looked * p)


def dimensions_of(arm, trials):
    """How many fractal trials end with nine cells, as a plane has, between 2.5 and 2.7, or with another dimension; nothing for others."""
    names = ("dimension_2", "dimension_2.5_to_2.7", "dimension_other")
    row = {f"{name}{end}": None for name in names for end in ("", "_share", "_low", "_high")} | dict.fromkeys(
        ("dimension_p_paper", "dimension_p_looks", "dimension_outcome", "early_cubes", "early_cubes_outcome"))
    if not DRAWN[arm].is_fractal:
        return row
    ends = [trial.dimension[-1] for trial in trials]
    counts = [sum(abs(end - 2.0) < 1e-9 for end in ends), sum(2.5 < end < 2.7 for end in ends)]
    counts.append(len(ends) - sum(counts))
    for name, count in zip(names, counts):
        found = share(count, len(ends))
        row |= {name: count, f"{name}_share": found.value, f"{name}_low": found.low, f"{name}_high": found.high}
    p = freeman_halton(counts, PAPER_DIMENSIONS)
    p_looks = times_looks(p, looks(len(trials[0].best) - 1, arm))
    cubes = sum(bool(np.any(trial.dimension[:EARLY + 1] > 3.0 - 1e-9)) for trial in trials)  # trials whose best robot was a full cube early
    return row | {"dimension_p_paper": p, "dimension_p_looks": p_looks, "dimension_outcome": "differs" if tells_apart(p_looks) else "open",
                  "early_cubes": cubes, "early_cubes_outcome": "reproduced" if cubes else "open"}


def statistics(arms):
    """Of the scales the largest is compared with the one before it."""
    rows = []
    for arm, trials in arms.items():
        firsts, lasts = ([trial.best[at] for trial in trials] for at in (0, -1))
        first, last, gain = mean(firsts), mean(lasts), mean([one - other for one, other in zip(lasts, firsts)])
        levels = list(trials[0].speeds)
        smaller, larger = ([trial.last_speed(level) for trial in trials] for level in levels[-2:])
        slower = share(sum(one < other for one, other in zip(larger, smaller)), len(trials))
        p_scales = rank_sum(smaller, larger)
        rows.append({"arm": arm, "trials": len(trials), "generations": len(trials[0].best) - 1} | first.cells("first") | last.cells("last") | gain.cells("gain")
                    | {"gain_outcome": OUTCOMES[verdict(gain, 0.0)], "p_first_last": signed_rank(lasts, firsts), "p_first_last_rank_sum": rank_sum(lasts, firsts),
                       "compared_cells": f"{3 ** levels[-1]} and {3 ** levels[-2]}"} | slower.cells("larger_is_slower")
                    | {"larger_is_slower_outcome": OUTCOMES[verdict(slower, 0.5)], "looks": looks(len(trials[0].best) - 1, arm), "p_scales": signed_rank(smaller, larger),
                       "p_scales_rank_sum": p_scales, "no_difference_outcome": "not reproduced" if tells_apart(p_scales) else "open"}
                    | leads_of(trials, levels) | dimensions_of(arm, trials))
    return rows


def scales(arms):
    """Each scale of the best robots by itself: in how many trials it ends faster than it began, and of all changes from one best robot to the next how
    many make it faster. In how many trials it is the fastest scale at the end, and at least twice as fast as the next one."""
    rows = []
    for arm, trials in arms.items():
        levels = list(trials[0].speeds)
        for level in levels:
            speeds = [found for trial in trials if len(found := trial.speeds[level][np.isfinite(trial.speeds[level])])]
            steps = np.concatenate([np.diff(of_trial) for of_trial in speeds])
            changes = int(np.sum(steps != 0.0))
            if not changes:
                continue
            rises = share(sum(of_trial[-1] > of_trial[0] for of_trial in speeds), len(speeds))
            upwards = share(int(np.sum(steps > 0.0)), changes)
            others = [(trial.last_speed(level), max((trial.last_speed(other) for other in levels if other != level), default=np.inf)) for trial in trials]
            rows.append({"arm": arm, "cells_per_side": 3**level, "trials": len(speeds)} | rises.cells("rises") | {"rises_outcome": OUTCOMES[verdict(rises, 0.5)], "changes": changes}
                        | upwards.cells("upwards") | {"is_fastest": sum(one > other for one, other in others), "is_twice_as_fast": sum(one >= 2.0 * other for one, other in others),
                                                 "found_outcome": "reproduced" if any(one > other for one, other in others) else "open"})
    return rows


def leads_of(trials, levels):
    """In how many of all generations the best robot is slowest at the largest scale. How many best robots trials had one after another, which
    differ in some speed, and how many of these are slowest there. Of the one that led longest: for how many generations, and by what part of its
    speed at the slowest other scale it is slower at the largest."""
    leads = [(speeds, len(list(generations))) for trial in trials
             for speeds, generations in groupby(zip(*(trial.speeds[level].tolist() for level in levels))) if not np.isnan(speeds).any()]
    behind = [1.0 - speeds[-1] / min(speeds[:-1]) if min(speeds[:-1]) > 0.0 else -np.inf for speeds, _ in leads]
    longest, margin = max(((generations, one) for (_, generations), one in zip(leads, behind)), default=(None, None))
    return {"largest_is_slowest_generations": sum(generations for (_, generations), one in zip(leads, behind) if one > 0.0),
            "all_generations": sum(len(trial.best) for trial in trials), "best_robots": len(leads), "largest_is_slowest_robots": sum(one > 0.0 for one in behind), "longest_lead": longest, "longest_lead_margin": margin}


def tested(one, other, ends):
    """The test of two samples of fitness, pairs where trials have the same seeds; its p; the share of pairs in which the first is larger."""
    if [trial.seed for trial in one] == [trial.seed for trial in other]:
        return "signed rank", signed_rank(*ends), share_of_larger_pairs(*ends)
    return "rank sum", rank_sum(*ends), share_of_larger(*ends)


def medians_ratio(ends):
    return float(np.median(ends[0]) / np.median(ends[1]))


def comparison(names, one, other, generation):
    """Of the best robots at a generation."""
    ends = [[trial.best[generation] for trial in trials] for trials in (one, other)]
    test, p, larger = tested(one, other, ends)
    looked = looks(generation, *names)
    p_looks = times_looks(p, looked)
    return {"arms": " and ".join(names), "trials": len(one), "other_trials": len(other), "generations": generation,
            "test": test, "p": p, "looks": looked, "p_looks": p_looks} | larger.cells("larger") | {
            "larger_outcome": OUTCOMES[verdict(larger, 0.5) if tells_apart(p_looks) else "open"], "medians_ratio": medians_ratio(ends)}


def compared(arms):
    """Which arms are compared: their names, their trials, and the last generation that both have."""
    for names in COMPARISONS:
        if set(names) <= set(arms):
            one, other = (arms[name] for name in names)
            yield names, one, other, min(len(trials[0].best) for trials in (one, other)) - 1


def comparisons(arms):
    return [comparison(names, one, other, last) for names, one, other, last in compared(arms)]


def change_without_fault(arms):
    """Whether the fault of the simulator changes the control's lead: the ratio of fitness without the fault to that with it, of trials of one
    seed, is compared between fractals and the control. No row before all four arms are complete.

    Ratios and leads are geometric means, so that the lead with the fault (lead), divided by the change of fractals over that of the control
    (change_ratio), is the lead without it. The rank-sum test of the ratios decides."""
    if not {name for names in WITH_AND_WITHOUT_FAULT for name in names} <= set(arms):
        return []
    ratios, with_fault = [], []
    for names in WITH_AND_WITHOUT_FAULT:
        before, after = ({trial.seed: trial.best[-1] for trial in arms[name]} for name in names)
        if before.keys() != after.keys():
            raise InputError(f"{DRAWN[names[1]].folder}: must have the seeds of {DRAWN[names[0]].folder}")
        ratios.append([after[seed] / before[seed] for seed in sorted(before)])
        with_fault.append(list(before.values()))
    p, larger = rank_sum(*ratios), share_of_larger(*ratios)
    return [{"arms": "fractal and control", "trials": len(ratios[0]), "other_trials": len(ratios[1])}
            | geometric_mean(ratios[0]).cells("change") | geometric_mean(ratios[1]).cells("other_change")
            | geometric_means_ratio(*ratios).cells("change_ratio") | geometric_means_ratio(*reversed(with_fault)).cells("lead")
            | {"p": p} | larger.cells("larger") | {"larger_outcome": OUTCOMES[verdict(larger, 0.5) if tells_apart(p) else "open"]}]


def on_the_way(arms):
    """The same at every twentieth generation before the last one, of arms that were looked at there."""
    rows = [comparison(names, one, other, at) for names, one, other, last in compared(arms) for at in range(STRIDE, last, STRIDE) if not are_planned(names)]
    return [{"arms": row["arms"], "generations": row["generations"]} | row for row in rows]


def at_equal_evaluations(arms):
    """The best robots after as many walks: as many as the trial of both arms that has the fewest at the last generation that both have."""
    rows = []
    for names, one, other, last in compared(arms):
        if any(trial.evaluations is None for trial in one + other) or are_planned(names):
            continue
        evaluations = min(trial.evaluations[last] for trial in one + other)
        reached = [[trial.best_after(evaluations) for trial in trials] for trials in (one, other)]
        ends, generations = zip(*(zip(*trials) for trials in reached))
        test, p, larger = tested(one, other, ends)
        rows.append({"arms": " and ".join(names), "evaluations": int(evaluations), "generations": float(np.mean(generations[0])), "other_generations": float(np.mean(generations[1])),
                     "test": test, "p": p} | larger.cells("larger") | {"medians_ratio": medians_ratio(ends)})
    return rows


def draw_mean(panel, curves, colour, dashes, label, places=None, width=1.5):
    """The mean of curves with its 95 % interval, which one curve has not, at the places that all of them have; or else at their generations."""
    curves = np.array(curves)
    there = np.flatnonzero(~np.isnan(curves).any(axis=0))
    generations = there if places is None else places[there]
    curves = curves[:, there]
    panel.plot(generations, curves.mean(axis=0), linestyle=dashes, linewidth=width, color=colour, label=label)
    if len(curves) > 1:
        spans = [mean(column) for column in curves.T]
        low, high = ([end if end is not None else span.value for span in spans for end in [getattr(span, side)]] for side in ("low", "high"))
        panel.fill_between(generations, low, high, color=colour, alpha=0.2, linewidth=0)


def labelled(name, trials):
    return f"{DRAWN[name].label} (n = {len(trials)})"


def draw_fitness(panel, arms):
    for name, trials in arms.items():
        draw_mean(panel, [trial.best for trial in trials], DRAWN[name].colour, DRAWN[name].dashes, labelled(name, trials))
    panel.set(xlabel="generation", ylabel="fitness, mean over trials\n(body lengths per minute)", ylim=(0, None))
    panel.legend(loc="upper center", bbox_to_anchor=(0.45, -0.28), ncols=2)


def draw_against(panel, arms, name):
    """The fitness of a variant, as long as it goes, and in grey that of the trials in which it changes something."""
    reference = DRAWN[name].changes or ("fractal" if DRAWN[name].is_fractal else "non_fractal")
    if reference in arms:
        draw_mean(panel, [trial.best for trial in arms[reference]], "#777777", "-", labelled(reference, arms[reference]))
        panel.legend(loc="lower right", handlelength=1.2)
    draw_mean(panel, [trial.best for trial in arms[name]], DRAWN[name].colour, "-", None)
    panel.set(xlabel="generation", xlim=(0, max(1, len(arms[name][0].best) - 1)), ylim=(0, None))


def draw_ends(panel, arms):
    for place, (arm, trials) in enumerate(arms.items()):
        drawn = DRAWN[arm]
        ends = [trial.best[-1] for trial in trials]
        panel.plot(ends, place + np.linspace(-0.28, 0.28, len(ends)) if len(ends) > 1 else [place], drawn.mark, color=drawn.colour, markersize=3.5)
        panel.plot([np.median(ends)] * 2, [place - 0.4, place + 0.4], color="#222222", linewidth=1.2)
    highest = max(trial.best[-1] for trials in arms.values() for trial in trials)
    panel.set(xlabel="fitness at the end (body lengths per minute)", xlim=(0, 1.05 * highest), ylim=(len(arms) - 0.4, -0.6))
    panel.set_yticks(range(len(arms)), [f"{DRAWN[arm].label} ({len(trials[0].best) - 1} generations)" for arm, trials in arms.items()])


def draw_scales(panel, trials):
    for level in trials[0].speeds:
        colour, dashes, width = SCALE_STYLES[level]
        draw_mean(panel, [trial.speeds[level] for trial in trials], colour, dashes, f"{3 ** level} cells", width=width)  # per side
    panel.set_xlabel("generation")
    panel.legend(loc="upper center", ncols=3, handlelength=1.6, columnspacing=0.7, borderpad=0.3)


def draw_dimensions(panel, trials):
    """A line of steps for each trial, a hair beside those with the same cells, and a point for each at the end."""
    from matplotlib.ticker import MaxNLocator  # only where a figure is drawn, as pyplot

    panel.axhspan(2.5, 2.7, color="#F0E442", alpha=0.3, linewidth=0)
    panel.axhline(2.0, color="#222222", linestyle="--", linewidth=1)
    last = max(1, len(trials[0].dimension) - 1)
    taken = {}
    for place, trial in enumerate(trials):
        shifted = trial.dimension + 0.005 * (place - (len(trials) - 1) / 2)
        panel.step(range(len(shifted)), shifted, where="post", linewidth=0.9, color="#444444")
        end = round(float(trial.dimension[-1]), 6)
        taken[end] = taken.get(end, 0) + 1
        panel.plot([last * (1.01 + 0.02 * taken[end])], [end], "o", markersize=3.5, color="#444444")
    labels = last * (1.03 + 0.02 * max(taken.values()))
    for height, text in ((2.6, "2.5 to 2.7"), (2.0, "H = 2 (plane)")):
        panel.annotate(text, (labels, height + 0.01), va="bottom" if height == 2.0 else "center")
    # Beyond the last generation are points and words, and no ticks.
    panel.set_xticks([tick for tick in MaxNLocator("auto", steps=(1, 2, 2.5, 5, 10), integer=True).tick_values(0, last) if 0 <= tick <= last])
    lowest = min(np.nanmin(trial.dimension) for trial in trials)
    panel.set(xlabel="generation (at the end a point for each trial)", ylabel="Hausdorff dimension H\nof the best robot", ylim=(min(1.75, lowest - 0.1), 3.08), xlim=(0, labels + 0.21 * last))


def finish(figure, panels, name):
    """Titles the panels, which come with their titles, and writes the figure."""
    letter_panels(panels)
    for panel, _ in panels:
        if panel.get_xlabel() == "generation":
            panel.xaxis.get_major_locator().set_params(integer=True)
    settle(figure)
    write_svg(figure, HERE / f"{name}.svg")


def parts(pyplot, heights):
    """A figure in parts of these heights in inches, one below the other, whose panels need not stand flush."""
    figure = pyplot.figure(figsize=(6.5, sum(heights)), layout="constrained")
    return figure, figure.subfigures(len(heights), 1, height_ratios=heights, squeeze=False)[:, 0]


def small_panels(part, count, columns):
    """Panels in rows, with one y axis."""
    panels = part.subplots(-(-count // columns), columns, sharey=True, squeeze=False).flat
    for panel in panels[count:]:
        panel.remove()
    return panels[:count]


def ends_of(part, arms):
    """The panel with the last fitness of every trial, and its title."""
    panel = part.subplots()
    draw_ends(panel, arms)
    return panel, "every trial at the end (line: median)"


def height_of_ends(arms):
    return 0.7 + 0.22 * len(arms)


def draw_trials(pyplot, arms):
    """Fitness over generations and at the end, the scales apart, and the dimension."""
    longest = [f"{name}_longer" if f"{name}_longer" in arms else name for name in ARMS if name in arms]
    with_dimension = next((arm for arm in longest if DRAWN[arm].is_fractal), None)
    figure, (fitness, ends, scales, *dimension) = parts(pyplot, [2.3, height_of_ends(arms), 1.55 * -(-len(longest) // 2), *[2.0] * bool(with_dimension)])
    panels = [(fitness.subplots(), "best robot"), ends_of(ends, arms)]
    draw_fitness(panels[0][0], arms)
    for panel, arm in zip(small_panels(scales, len(longest), 2), longest):
        panels.append((panel, labelled(arm, arms[arm])))
        draw_scales(panel, arms[arm])
    panel.set_ylim(0, 1.2 * panel.get_ylim()[1])  # with room for the legend
    scales.supylabel("speed of the best robot\n(body lengths per minute)", fontsize="medium", multialignment="center")
    if with_dimension:
        panels.append((dimension[0].subplots(), f"dimension, {DRAWN[with_dimension].label}"))
        draw_dimensions(panels[-1][0], arms[with_dimension])
    finish(figure, panels, "trials")


def draw_variants(pyplot, arms):
    """A small panel for each variant, and every trial at the end."""
    variants = [name for name in arms if DRAWN[name].is_variant]
    figure, (fitness, ends) = parts(pyplot, [1.75 * -(-len(variants) // 3), height_of_ends(arms)])
    panels = []
    for panel, name in zip(small_panels(fitness, len(variants), 3), variants):
        panels.append((panel, f"{fill(DRAWN[name].label, 24)}\n(n = {len(arms[name])})"))
        draw_against(panel, arms, name)
    fitness.supylabel("fitness, mean over trials\n(body lengths per minute)", fontsize="medium", multialignment="center")
    finish(figure, [*panels, ends_of(ends, arms)], "variants")


def draw(arms):
    """Both figures, readable where they are printed 6.5 inches wide."""
    pyplot = pyplot_for_svg()
    pyplot.rcParams |= {"font.size": 8, "legend.fontsize": 7.5}
    main_arms = {name: arm for name, arm in arms.items() if not DRAWN[name].is_variant}
    if main_arms:
        draw_trials(pyplot, main_arms)
    if len(main_arms) < len(arms):
        draw_variants(pyplot, {name: arm for name, arm in arms.items() if len(arm[0].speeds) == 2})  # without those at three scales


def main(arguments):
    if arguments:
        raise InputError(__doc__)
    found = {}
    for name, arm in ARMS.items():
        found |= arms_of(name, arm.folder, arm.planned.generations if arm.planned else None)
    # Who plans a test does not look before it: arms that are not complete are left out of everything.
    arms = {name: found[name] for name in DRAWN if name in found and DRAWN[name].is_complete(found[name])}
    if not arms:
        raise InputError(f"{ARMS['fractal'].folder}: has no trial yet: ./run paper fractal two_scales_1")
    for name, rows in (("champions", champions(arms)), ("statistics", statistics(arms)), ("scales", scales(arms)), ("comparisons", comparisons(arms)), ("without_fault", change_without_fault(arms)),
                       ("on_the_way", on_the_way(arms)), ("equal_evaluations", at_equal_evaluations(arms))):
        if rows:
            write_table(HERE / f"{name}.csv", list(rows[0]), [[cell(value) for value in row.values()] for row in rows])
    draw(arms)


if __name__ == "__main__":
    run_script(main)
