#!/usr/bin/python3
"""How far evolution is ahead of random search, and how far it would be by what mutants inherit: chance.csv and chance.svg.

chance.py    reads the tables of searches that there are: SEED.csv in three_cells_single, nine_cells and nine_cells_single here, in one_scale in
             ../scale_invariance, in two_scales and single_cells in ../fractal, and in the folders of the random searches that they are
             compared with; inherited.csv of heredity.py, and made_up.csv of made_up.py

chance.csv: after 20, 40 and 140 generations, and after as many walks of one robot at one scale, the mean fitness of both kinds of searches, and
the share of pairs in which the evolved one is ahead. Robots that a search had before are not walked again, and evolution has more of these. So
after as many walks there is also the p of the rank-sum test; and of made-up searches whose mutants inherit as much, and which have no robot twice,
the share that is ahead and the share of mutants that are faster than their parents: between those of made_up.csv straight lines. Searches at
two scales have two numbers of heredity, and no such shares.
chance.svg shows the fitness by walks at each scale alone, and the shares.
Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys
from dataclasses import dataclass

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
FRACTAL = HERE.parent / "fractal"
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance"), str(FRACTAL)]

import numpy as np  # noqa: E402
from made_up import ROBOTS, SURVIVORS, robots_of  # noqa: E402
from sample_statistics import mean, rank_sum, share_of_larger  # noqa: E402
from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402
from svg_figure import letter_panels, pyplot_for_svg, settle, write_svg  # noqa: E402
from trials import arms_of, draw_mean, medians_ratio  # noqa: E402


@dataclass(frozen=True)
class Searches:
    """Where the searches of a kind are, and those at random; how they are drawn."""

    cells: str  # per side
    mutants: str
    evolved: pathlib.Path
    drawn_at_random: pathlib.Path
    colour: str = ""
    mark: str = ""

    @property
    def is_alone(self):
        """Of one scale alone, whose heredity is one number."""
        return "and" not in self.cells


ANY, SINGLE = "as in the paper", "one cell at most"
SEARCHES = {"three_cells": Searches("3", ANY, HERE.parent / "scale_invariance/one_scale", HERE / "three_cells_random", "#D55E00", "s"),
            "three_cells_single": Searches("3", SINGLE, HERE / "three_cells_single", HERE / "three_cells_random", "#CC79A7", "D"),
            "nine_cells": Searches("9", ANY, HERE / "nine_cells", HERE / "nine_cells_random", "#0072B2", "o"),
            "nine_cells_single": Searches("9", SINGLE, HERE / "nine_cells_single", HERE / "nine_cells_random", "#009E73", "v"),
            "two_scales": Searches("3 and 9", ANY, FRACTAL / "two_scales", FRACTAL / "random_search"),
            "two_scales_single": Searches("3 and 9", SINGLE, FRACTAL / "single_cells", FRACTAL / "random_search")}
GENERATIONS = (20, 40, 140)
DASHES = {10: ":", 20: "--", 40: "-"}  # of the lines of made-up searches
STYLES = {ANY: ("-", "evolution"), SINGLE: ("--", "evolution, single cells")}
RANDOM_COLOUR = "#777777"


def made_up_share(made_up, column, generation, spearman):
    """A share of made-up searches whose mutants inherit so much; None beyond those that there are."""
    shares = {}
    for at in {row["generations"] for row in made_up}:
        rows = sorted((float(row["spearman"]), float(row[column])) for row in made_up if row["generations"] == at)
        if rows[0][0] <= spearman <= rows[-1][0]:
            shares[int(at)] = float(np.interp(spearman, *zip(*rows)))
    if not shares or not min(shares) <= generation <= max(shares):
        return None
    return float(np.interp(generation, *zip(*sorted(shares.items()))))


def found_searches():
    """Evolved and random trials of each kind of which there are both."""
    found = {}
    for name, searches in SEARCHES.items():
        both = [arms_of("all", folder).get("all") for folder in (searches.evolved, searches.drawn_at_random)]
        if all(both):
            found[name] = both
    return found


def row_of(name, after, ends):
    """The comparison of the best robots of both kinds of searches."""
    row = {"searches": name, "after": after, "cells_per_side": SEARCHES[name].cells, "mutants": SEARCHES[name].mutants}
    row |= {"trials": len(ends[0]), "other_trials": len(ends[1])} | mean(ends[0]).cells("evolved") | mean(ends[1]).cells("random")
    return row | {"medians_ratio": medians_ratio(ends)} | share_of_larger(*ends).cells("larger")


def chance(found, inherited, made_up):
    """A row for every kind of searches after some generations, and one after as many walks as all of its searches have."""
    heredities = {(row["arm"], row["cells_per_side"]): row for row in inherited}
    for name, both in found.items():
        heredity = heredities.get((name, SEARCHES[name].cells), {})
        last = min(len(trials[0].best) for trials in both) - 1
        inherits = [f"{column}{end}" for column in ("spearman", "faster") for end in ("", "_low", "_high")]
        nothing = dict.fromkeys(("p", "walks", *inherits, "made_up", "made_up_faster"))
        for generation in GENERATIONS:
            if generation <= last:
                yield row_of(name, f"{generation} generations", [[trial.best[generation] for trial in trials] for trials in both]) | nothing
        walks = int(min(trial.evaluations[last] for trials in both for trial in trials))
        ends = [[trial.best_after(walks)[0] for trial in trials] for trials in both]
        row = row_of(name, "as many walks", ends) | {"p": rank_sum(*ends), "walks": walks} | {column: heredity.get(column) for column in inherits}
        for name_of, column in (("made_up", "larger"), ("made_up_faster", "faster")):
            row[name_of] = made_up_share(made_up, column, (walks - SURVIVORS) / ROBOTS, float(heredity["spearman"])) if heredity else None
        yield row


def by_walks(trials, walks):
    """The best fitness after each number of walks."""
    return [[trial.best_after(count)[0] for count in walks] for trial in trials]


def draw_fitness(panel, found, cells):
    """Of the searches at a scale alone, and the random ones that all of them are compared with."""
    of_scale = {name: both for name, both in found.items() if SEARCHES[name].cells == cells}
    drawn_at_random = next(iter(of_scale.values()))[1]
    curves = [(trials[0], SEARCHES[name].colour, *STYLES[SEARCHES[name].mutants]) for name, trials in of_scale.items()]
    for trials, colour, dashes, label in [*curves, (drawn_at_random, RANDOM_COLOUR, (0, (1, 1.5)), "random search")]:
        walks = np.arange(SURVIVORS, int(min(trial.evaluations[-1] for trial in trials + drawn_at_random)) + 1)
        draw_mean(panel, by_walks(trials, walks), colour, dashes, label, walks)
    panel.set(xlabel="walks", xlim=(0, None), ylim=(0, None))
    panel.legend(loc="lower right")


def draw_shares(panel, rows, made_up):
    for generation in sorted({int(row["generations"]) for row in made_up} & set(DASHES)):
        line = [(float(row["spearman"]), 100 * float(row["larger"])) for row in made_up if row["generations"] == str(generation)]
        panel.plot(*zip(*line), linestyle=DASHES[generation], color="#222222", linewidth=1, label=f"made up, {robots_of(generation)} walks")
    for row in rows:
        kind = SEARCHES[row["searches"]]
        if row["spearman"] and row["larger_low"] is not None:
            place = float(row["spearman"])
            across = [float(row[f"spearman_{end}"] or place) for end in ("low", "high")]
            panel.plot([place] * 2, [100 * row["larger_low"], 100 * row["larger_high"]], color=kind.colour, linewidth=1)
            panel.plot(across, [100 * row["larger"]] * 2, color=kind.colour, linewidth=1)
            panel.plot([place], [100 * row["larger"]], kind.mark, color=kind.colour, markersize=4)
    panel.set(xlabel="rank correlation of fitness,\nparents and mutants", ylabel="evolution is ahead (% of pairs)", xlim=(0, 1), ylim=(0, 103))
    panel.legend(loc="upper center", bbox_to_anchor=(0.5, -0.25))


def draw(found, rows, made_up):
    """Readable where it is printed 6.5 inches wide."""
    pyplot = pyplot_for_svg()
    pyplot.rcParams |= {"font.size": 8, "legend.fontsize": 7}
    scales = list(dict.fromkeys(SEARCHES[name].cells for name in found if SEARCHES[name].is_alone))
    figure, (places,) = pyplot.subplots(1, len(scales) + 1, figsize=(6.5, 3.3), layout="constrained", squeeze=False)
    panels = []
    for panel, cells in zip(places, scales):
        draw_fitness(panel, found, cells)
        panels.append((panel, f"{cells} cells per side alone"))
    places[0].set_ylabel("fitness, mean over searches\n(body lengths per minute)")
    draw_shares(places[-1], rows, made_up)
    panels.append((places[-1], "ahead of random search"))
    letter_panels(panels)
    settle(figure)
    write_svg(figure, HERE / "chance.svg")


def main(arguments):
    if arguments:
        raise InputError(__doc__)
    found = found_searches()
    if not found:
        raise InputError(f"{HERE}: has no searches yet: ./run paper heredity nine_cells_1 nine_cells_random_1")
    inherited, made_up = (read_table(file) if file.exists() else [] for file in (HERE / "inherited.csv", HERE / "made_up.csv"))
    rows = list(chance(found, inherited, made_up))
    if rows:
        write_table(HERE / "chance.csv", list(rows[0]), [[cell(value) for value in row.values()] for row in rows])
    draw(found, rows, made_up)


if __name__ == "__main__":
    run_script(main)
