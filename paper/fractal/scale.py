#!/usr/bin/env python3
"""How many ranks would share a search, from the tasks of a run: a table for trial.md.

Reads timings.csv of `menger export --timings`. The time of a task is its voxels times its steps over a speed, so that the table is the
same on every machine. Compares

- lazy: generations as the search makes them, batch after batch (see schedule.csv),
- all: `pruning = false`, one batch for a generation, with the evaluations that lazy selection left out; a body of n cells has n^level
  voxels,
- all, in a population P times as large, whose generations have P times as many new designs,
- steady state: whenever a rank is free, the next design is born. Its levels follow one another. No generation ends, so none waits.

Tasks of a batch go to the first free rank, the costliest first; a task is one rank's. Printed are the share of time in which ranks work,
and the hours that as many designs take as a trial has.
"""

import argparse
import csv
import heapq
from collections import defaultdict

TRIAL_GENERATIONS = 325


def read_tasks(path, stretch, speed):
    """Returns the tasks by generation: {generation: [(batch, individual, level, voxels, seconds)]}, and steps by level."""
    tasks = defaultdict(list)
    steps = {}
    with open(path, newline='') as file:
        for row in csv.DictReader(file):
            voxels, level = int(row['voxels']), int(row['level'])
            steps[level] = int(row['steps']) * stretch
            seconds = voxels * steps[level] / speed
            tasks[int(row['generation'])].append((int(row['batch']), int(row['individual']), level, voxels, seconds))
    return tasks, steps


def makespan(seconds, ranks):
    """Returns the time of a list schedule, the costliest first."""
    free = [0.0] * min(ranks, max(1, len(seconds)))
    for one in sorted(seconds, reverse=True):
        heapq.heapreplace(free, free[0] + one)
    return max(free)


def lazily(generation, ranks):
    batches = defaultdict(list)
    for batch, _, _, _, seconds in generation:
        batches[batch].append(seconds)
    return sum(makespan(batch, ranks) for batch in batches.values())


def designs(generation, steps, speed):
    """Returns the times of all levels of every new design, {individual: [seconds]}, those that were left out as well."""
    levels = sorted(steps)
    cells = {individual: voxels for _, individual, level, voxels, _ in generation if level == levels[0]}
    return {individual: [n ** level * steps[level] / speed for level in levels] for individual, n in cells.items()}


def steadily(stream, count, ranks):
    """Returns the time in which so many designs are done, and the time for which ranks work. The stream is begun again at its end.

    A level of a design begins when the one before is known, and the rank that did that is free then: so a design is one rank's.
    """
    free = [0.0] * ranks
    busy = 0.0
    for n in range(count):
        one = sum(stream[n % len(stream)])
        heapq.heapreplace(free, free[0] + one)
        busy += one
    return max(free), busy


def table(path, ranks, stretch, speed, populations):
    tasks, steps = read_tasks(path, stretch, speed)
    later = [tasks[number] for number in sorted(tasks) if number > 0]
    new = [designs(generation, steps, speed) for generation in later]
    stream = [times for generation in new for times in generation.values()]
    each = len(stream) / len(later)  # designs of a generation that are evaluated
    count = round(TRIAL_GENERATIONS * each)
    lazy_work = sum(seconds for generation in later for *_, seconds in generation)
    all_work = sum(sum(times) for times in stream)
    rows = []
    for n in ranks:
        took = sum(lazily(generation, n) for generation in later)
        rows.append((n, 'lazy', lazy_work / (n * took), took / len(later) * TRIAL_GENERATIONS))
        for factor in populations:
            together = [[s for k in range(factor) for times in new[(i + k) % len(new)].values() for s in times]
                        for i in range(len(new))]
            took = sum(makespan(batch, n) for batch in together)
            name = 'all' if factor == 1 else f'all, population x {factor}'
            rows.append((n, name, factor * all_work / (n * took), took / len(new) * TRIAL_GENERATIONS / factor))
        took, busy = steadily(stream, count, n)
        rows.append((n, 'steady state', busy / (n * took), took))
    return rows, each, lazy_work / len(later), all_work / len(later)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('timings', help='timings.csv')
    parser.add_argument('--ranks', type=int, nargs='+', default=[2, 16, 256, 4096])
    parser.add_argument('--populations', type=int, nargs='+', default=[1, 16, 256], help='factors of the population')
    parser.add_argument('--stretch', type=float, default=1.0, help='by how much evaluations of the trial are longer than those of the run')
    parser.add_argument('--speed', type=float, default=48.5e6, help='voxel-steps of a rank a second')
    arguments = parser.parse_args()
    rows, each, lazy_s, all_s = table(arguments.timings, arguments.ranks, arguments.stretch, arguments.speed, arguments.populations)
    print(f'{each:.1f} designs of a generation are evaluated: {lazy_s:.0f} s of work lazily, {all_s:.0f} s with all levels\n')
    names = list(dict.fromkeys(name for _, name, *_ in rows))
    print('| ranks | ' + ' | '.join(names) + ' |')
    print('| --- |' + ' --- |' * len(names))
    for n in arguments.ranks:
        cells = [f'{100 * share:.3g} %, {hours:.3g} h' for ranks, _, share, seconds in rows if ranks == n
                 for hours in [seconds / 3600]]
        print(f'| {n:,} | ' + ' | '.join(cells) + ' |')


if __name__ == '__main__':
    main()
