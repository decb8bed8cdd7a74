#!/usr/bin/env python3
"""How good the robots are that searches find by generations and in a steady state, at equal counted work: a table for trial.md.

selection.py take RESULTS CSV   gathers the searches of selection.sh: a row for every generation whose best robot is better than all before
selection.py table CSV          prints the table

The work is voxels times steps of all evaluations. In a steady state robots are under way when a generation ends; as much work as the share
of the next generation that they are is counted for them. The fitness at some work is that of the best robot after the last generation that
cost no more. Means are over seeds; intervals are of 95 %, of differences of means, by resampling seeds of both arms (10,000 times).
"""

import csv
import pathlib
import random
import sys
from collections import defaultdict

ROBOTS = {'one_level': 16, 'two_levels': 7}  # of a generation
NAMES = {'one_level': 'one level', 'two_levels': 'two levels'}
RESAMPLES = 10000
COLUMNS = ['study', 'arm', 'seed', 'generation', 'voxel_steps', 'best_fitness_body_lengths']


def rows_of(path):
    with open(path, newline='') as file:
        return list(csv.DictReader(file))


def take(results, file):
    """Writes a row for every improvement, and for the last generation."""
    rows = []
    for folder in sorted(path.parent for path in pathlib.Path(results).glob('*/costs.csv')):
        study, arm, seed = folder.name.split('.')
        under_way = int(arm.split('_')[1]) if arm.startswith('steady') else 0
        costs = [int(row['voxel_steps']) for row in rows_of(folder / 'costs.csv')]
        best = [float(row['best_fitness_body_lengths'] or 0) for row in rows_of(folder / 'generations.csv')]
        paid, so_far = 0, -1.0
        for generation, cost in enumerate(costs[:-1]):
            paid += cost
            is_last = generation == len(costs) - 2
            if best[generation] > so_far or is_last:
                so_far = max(so_far, best[generation])
                rows.append([study, arm, int(seed), generation, round(paid + under_way / ROBOTS[study] * costs[generation + 1]), so_far])
    rows.sort(key=lambda row: row[:4])
    with open(file, 'w', newline='') as out:
        csv.writer(out, lineterminator='\n').writerows([COLUMNS] + rows)


def read(file):
    """Returns {study: {arm: {seed: [(work, fitness)]}}}."""
    runs = defaultdict(lambda: defaultdict(lambda: defaultdict(list)))
    for row in rows_of(file):
        point = (int(row['voxel_steps']), float(row['best_fitness_body_lengths']))
        runs[row['study']][row['arm']][int(row['seed'])].append(point)
    return runs


def fitness_at(run, work):
    return max((fitness for cost, fitness in run if cost <= work), default=0.0)


def mean(values):
    return sum(values) / len(values)


def interval(first, second, resamples=RESAMPLES):
    """Returns an interval of 95 % of mean(second) - mean(first)."""
    stream = random.Random(1)
    differences = sorted(mean(stream.choices(second, k=len(second))) - mean(stream.choices(first, k=len(first)))
                         for _ in range(resamples))
    return differences[round(0.025 * resamples)], differences[round(0.975 * resamples) - 1]


def table(file):
    print('| study | seeds | 1e6 voxel-steps | generations | steady state, one under way | more than generations | a generation under way | more than generations |')
    print('| --- |' + ' --- |' * 7)
    for study, arms in sorted(read(file).items()):
        seeds = sorted(set.intersection(*(set(runs) for runs in arms.values())))
        least = min(runs[seed][-1][0] for runs in arms.values() for seed in seeds)
        names = ['generations'] + sorted((arm for arm in arms if arm != 'generations'), key=lambda arm: int(arm.split('_')[1]))
        for work in (least / 4, least / 2, least):
            first, *others = [[fitness_at(arms[arm][seed], work) for seed in seeds] for arm in names]
            cells = [NAMES[study], str(len(seeds)), f'{work / 1e6:.0f}', f'{mean(first):.3f}']
            for one in others:
                low, high = interval(first, one)
                cells += [f'{mean(one):.3f}', f'{mean(one) - mean(first):+.3f} ({low:+.3f} to {high:+.3f})']
            print('| ' + ' | '.join(cells) + ' |')


def main():
    arguments = sys.argv[1:]
    if len(arguments) == 3 and arguments[0] == 'take':
        take(*arguments[1:])
    elif len(arguments) == 2 and arguments[0] == 'table':
        table(arguments[1])
    else:
        sys.exit(__doc__)


if __name__ == '__main__':
    main()
