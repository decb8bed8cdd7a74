#!/usr/bin/python3
"""How far evolution gets ahead of random search, and of a control, where mutants inherit a given part of their parents' speed:
made_up.csv and made_up_two_scales.csv.

made_up.py    makes searches of robots that are made up, with the paper's selection: 400 of each kind, in 4 minutes

A robot here is a number, its speed. At random it is drawn from the normal distribution. A mutant of a robot z has h z + sqrt(1 - h^2) e, with e
drawn from the same distribution: h = 0 inherits nothing, h = 1 all, and without selection robots at one scale stay spread as they were. Selection asks who
is fitter and never by how much, so whatever rises with z gives the same searches.

As in the paper 15 robots survive, each has one mutant in every generation, and one robot is drawn at random; age and fitness select survivors
as evolution/search/age_fitness_pareto.h says. A random search draws as many robots.

made_up.csv             for each h and some generations: Spearman's correlation of the speeds of parents and mutants, mean over searches, which
                        is not that of h, as parents are selected; the share of mutants that are faster than their parents; and how often an
                        evolved search is ahead of a random one, exactly for all of these
made_up_two_scales.csv  robots have two numbers, which are correlated as the speeds of random robots at two scales are, and the smaller one is
                        the fitness. Mutants of fractals change both. Of the control's, 38 % change the second one alone, as in its trials
                        (mutants.csv). h are such that correlations are those of trials (inherited.csv), though at the second scale real
                        ones are only of mutants that are fast at the first. How often fractals are ahead of random search, and of the
                        control: where both inherit as in trials in_pieces, or as in single_cells; and where each inherits as in trials
                        fractal_again and control_again, and repeats robots as often (repeats.csv). A repeat is a copy of the parent
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import numpy as np  # noqa: E402
from sample_statistics import mean, rank_correlation, share_of_larger  # noqa: E402
from scipy import stats  # noqa: E402
from scipy.special import log_ndtr  # noqa: E402
from small_tables import InputError, cell, run_script, write_table  # noqa: E402

SURVIVORS = 15
ROBOTS = SURVIVORS + 1  # of a generation: a mutant of each survivor, and one that is drawn at random
SEARCHES = 400
GENERATIONS = (10, 20, 40, 60, 140)  # after which searches are compared
SEED = 1
HEREDITIES = np.arange(9) / 10
SCALES_CORRELATION = 0.37  # of speeds at 3 and 9 cells per side, of the 500 robots of ../discrepancies/walks/text.csv; Spearman's is 0.36
SECOND_ALONE = 0.38  # of the control's mutants


def levels_of(fitness, ages, numbers):
    """How many robots dominate each: they are at least as fit, at most as old, and fitter, younger or newer."""
    no_worse = (fitness[:, None] >= fitness) & (ages[:, None] <= ages)
    return (no_worse & ((fitness[:, None] > fitness) | (ages[:, None] < ages) | (numbers[:, None] > numbers))).sum(axis=0)


def survivors_of(fitness, ages, numbers, wanted, random):
    """Positions of the survivors. Levels are taken whole while they fit; of the next one, of L robots from the fittest on, the first, and
    then those at floor(L^u), with u uniform in [0, 1)."""
    levels = levels_of(fitness, ages, numbers)
    order = np.lexsort((-numbers, ages, -fitness, levels))
    taken = []
    for level in np.unique(levels):
        members = order[levels[order] == level]
        room = wanted - len(taken)
        if room == 0:
            break
        if len(members) > room:
            places = [0]
            while len(places) < room:
                place = min(int(len(members) ** random.random()), len(members) - 1)  # rounding can lift L^u to L
                if place not in places:
                    places.append(place)
            members = members[places]
        taken.extend(members)
    return np.array(taken)


def robots_of(generation):
    """How many robots a search had until a generation."""
    return SURVIVORS + ROBOTS * generation


def inherit(heredity, parents, drawn):
    return heredity * parents + np.sqrt(1.0 - heredity**2) * drawn


class Robots:
    """How robots are drawn, and what their mutants inherit, at one scale or at two."""

    def __init__(self, heredities, second_alone=0.0, heredity_alone=None, repeats=0.0):
        """@param second_alone share of mutants that change the second number alone
        @param heredity_alone what these inherit of it, if not as much as others
        @param repeats share of mutants that are no new robots"""
        self.heredities = np.array(heredities)
        self.second_alone = second_alone
        self.heredity_alone = self.heredities[-1] if heredity_alone is None else heredity_alone
        self.repeats = repeats

    def draw(self, count, random):
        speeds = random.standard_normal((count, len(self.heredities)))
        if len(self.heredities) == 2:
            speeds[:, 1] = SCALES_CORRELATION * speeds[:, 0] + np.sqrt(1.0 - SCALES_CORRELATION**2) * speeds[:, 1]
        return speeds

    def mutants(self, parents, random):
        drawn = self.draw(len(parents), random)
        children = inherit(self.heredities, parents, drawn)
        if self.second_alone:
            alone = random.random(len(parents)) < self.second_alone
            children[alone, 0] = parents[alone, 0]
            children[alone, 1] = inherit(self.heredity_alone, parents[alone, 1], drawn[alone, 1])
        if self.repeats:
            repeats = random.random(len(parents)) < self.repeats
            children[repeats] = parents[repeats]
        return children


def search(robots, generations, random):
    """The best fitness of every generation; of every generation after the first, the speeds of parents and mutants."""
    speeds, ages, numbers = robots.draw(SURVIVORS, random), np.zeros(SURVIVORS), np.arange(SURVIVORS)
    best, parents, mutants = [speeds.min(axis=1).max()], [], []
    for generation in range(1, generations + 1):
        ages = ages + 1
        parents.append(speeds)
        mutants.append(robots.mutants(speeds, random))
        pool = np.concatenate([speeds, mutants[-1], robots.draw(1, random)])
        pool_ages = np.concatenate([ages, ages, [0]])
        pool_numbers = np.concatenate([numbers, robots_of(generation - 1) + np.arange(ROBOTS)])
        chosen = survivors_of(pool.min(axis=1), pool_ages, pool_numbers, SURVIVORS, random)
        speeds, ages, numbers = pool[chosen], pool_ages[chosen], pool_numbers[chosen]
        best.append(speeds.min(axis=1).max())
    return np.array(best), np.array(parents), np.array(mutants)


class Searches:
    """Many searches of the same kind."""

    def __init__(self, robots, searches, generations):
        random = np.random.default_rng(SEED)
        found = [search(robots, generations, random) for _ in range(searches)]
        self.best, self.parents, self.mutants = (np.array(part) for part in zip(*found))

    def spearman(self, generation, scale, alone=False):
        """Of the mutants up to a generation that are no copies, and change the first number, or only the second one; mean over searches."""
        found = []
        for before, after in zip(self.parents[:, :generation], self.mutants[:, :generation]):
            kept = before == after
            which = (kept[..., 0] == alone) & ~kept.all(axis=-1)
            found.append(rank_correlation(before[which][:, scale], after[which][:, scale]))
        return mean(found)

    def faster(self, generation):
        """The share of mutants up to a generation that are faster than their parents, mean over searches."""
        return mean([float(np.mean(after[:generation] > before[:generation])) for before, after in zip(self.parents, self.mutants)])


def ahead_of_chance(best, draws):
    """How often the best of some random robots at one scale is below each of these: Phi(best)^draws."""
    return np.exp(draws * log_ndtr(best))


def ahead_of_chance_at_two_scales(best, draws):
    """The same of robots whose fitness is the smaller of two correlated numbers: (1 - P(both are above))^draws."""
    both_below = stats.multivariate_normal(cov=[[1.0, SCALES_CORRELATION], [SCALES_CORRELATION, 1.0]])
    return (1.0 - np.array([both_below.cdf([-one, -one]) for one in best])) ** draws  # by symmetry as often above as below the negative


def at_one_scale():
    found = {float(heredity): Searches(Robots([heredity]), SEARCHES, max(GENERATIONS)) for heredity in HEREDITIES}
    for generation in GENERATIONS:
        for heredity, of_kind in found.items():
            row = {"generations": generation, "heredity": heredity, "searches": SEARCHES} | of_kind.spearman(generation, 0).cells("spearman")
            row |= of_kind.faster(generation).cells("faster")
            yield row | mean(ahead_of_chance(of_kind.best[:, generation], robots_of(generation))).cells("larger")


# What mutants inherit and how often they repeat robots: of fractals and of the control
TWO_SCALES = {"as in the paper": (Robots((0.25, 0.45)), Robots((0.25, 0.45), SECOND_ALONE)),
              "one cell at most": (Robots((0.4, 0.7)), Robots((0.4, 0.7), SECOND_ALONE)),
              "each as in its trials, without repeats": (Robots((0.24, 0.52)), Robots((0.25, 0.555), SECOND_ALONE, heredity_alone=0.48)),
              "each as in its trials": (Robots((0.24, 0.52), repeats=0.375), Robots((0.25, 0.555), SECOND_ALONE, heredity_alone=0.48, repeats=0.22))}


def at_two_scales():
    for mutants, kinds in TWO_SCALES.items():
        fractals, control = (Searches(robots, SEARCHES, max(GENERATIONS)) for robots in kinds)
        for generation in GENERATIONS:
            row = {"mutants": mutants, "generations": generation, "searches": SEARCHES}
            for scale, name in enumerate(("first", "second")):
                row |= fractals.spearman(generation, scale).cells(f"spearman_{name}") | control.spearman(generation, scale).cells(f"control_spearman_{name}")
            row |= control.spearman(generation, 1, alone=True).cells("control_spearman_alone")
            best = fractals.best[:, generation]
            row |= mean(ahead_of_chance_at_two_scales(best, robots_of(generation))).cells("ahead_of_chance")
            yield row | share_of_larger(best, control.best[:, generation]).cells("fractals_ahead")


def main(arguments):
    if arguments:
        raise InputError(__doc__)
    for name, rows_of in (("made_up", at_one_scale), ("made_up_two_scales", at_two_scales)):
        rows = list(rows_of())
        write_table(HERE / f"{name}.csv", list(rows[0]), [[cell(value) for value in row.values()] for row in rows])


if __name__ == "__main__":
    run_script(main)
