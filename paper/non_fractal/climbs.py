#!/usr/bin/python3
"""How far do the best fractals get by small changes as fractals, and how far with an arrangement of their own, as in the control?

climbs.py robots                          lists the robots to begin with: GROUP SEED. The best fractals of the trials with 140 generations, of the
                                          repetition, and of the repetition with balanced beams; and random fractals, which no search has selected
climbs.py climb FOLDER MENGER GROUP SEED  climbs from one of them in all ways, into FOLDER/GROUP-SEED.csv; MENGER is the program. Walks that are
                                          in FOLDER already are not done again
climbs.py take FOLDER                     makes climbs.csv of the climbs of these robots
climbs.py summary                         makes climbs_statistics.csv, and climbs_on_the_way.csv of what there is after fewer robots

A climb tries robots that differ from the present one in one cell of the body, or in one place of the arrangement (neighbours.py),
in random order. It goes on from the first that is fitter, and tries no robot twice. It ends when all that are nearby were tried, or after as many
as TRIES in all. *as a fractal*: the arrangement is the body, so that a change of the body changes both. *with a free
arrangement*, as in the control: a change of the body keeps the arrangement, and the arrangement changes alone, too. *with the arrangement kept*: a
change of the body keeps it, and it never changes.
All begin with the same robot.
Exit codes: 0 done, 2 wrong input, 130 stopped; others are those of menger.
"""

import math
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance"), str(HERE)]

import numpy as np  # noqa: E402
from changed_walks import champions  # noqa: E402
from neighbours import LARGER, SMALLER, fitness, is_allowed, neighbours, parts_of, way, write  # noqa: E402
from sample_statistics import OUTCOMES, geometric_mean, mean, share, share_of_larger_pairs, signed_rank, tells_apart, verdict  # noqa: E402
from scale_invariance import LEAST_BODY_LENGTHS, body_lengths  # noqa: E402
from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402

WITH_FAULT = ("two_scales", "two_scales_again")  # of the simulator: ../discrepancies/README.md
GROUPS = (*WITH_FAULT, "two_scales_again_balanced", "random")
RANDOM = 25  # robots
SETS = {"with_fault": ("with the fault, all", WITH_FAULT), "two_scales": ("with the fault, after 140 generations", ("two_scales",)),
        "two_scales_again": ("with the fault, of the repetition", ("two_scales_again",)),
        "without_fault": ("without the fault, of the repetition", ("two_scales_again_balanced",)),
        "random": ("random fractals, with the fault", ("random",))}
WAYS = {"fractal": "as fractals", "free": "with a free arrangement", "kept": "with the arrangement kept"}
TRIES = 150  # robots, beside the one that a climb begins with
AFTER = (50, 100, TRIES)  # at which summary looks
COLUMNS = ["group", "seed", "way", "tried", "change", "phenotype", "level_1_body_lengths", "level_2_body_lengths"]
ENDED, STOPPED = (0, 3), 130  # exit codes of menger: a walk that failed ended, too


def random_fractals():
    """The first of the random robots that searches could have drawn, and that move at both scales."""
    found = {}
    for row in champions("random"):
        ends_m = {level: np.array([float(row[f"level_{level}_{axis}_m"] or 0.0) for axis in ("dx", "dy")]) for level in (SMALLER, LARGER)}
        if is_allowed(*parts_of(row)) and all(body_lengths(end_m, level) >= LEAST_BODY_LENGTHS for level, end_m in ends_m.items()):
            found.setdefault(row["phenotype"], row | {"seed": row["robot"]})
    return list(found.values())[:RANDOM]


def starts(*groups):
    return [robot for group in groups for robot in (random_fractals() if group == "random" else champions(group))]


def start_of(group, seed):
    for robot in starts(group):
        if robot["seed"] == seed:
            return robot
    raise InputError(f"{HERE.parent}/scale_invariance/robots.csv: has no robot of {group} with seed {seed}")


def nearby(parts, kind):
    """The changes of a robot that a climb may try: {change: (body, arrangement)}."""
    body, arrangement = parts
    if kind == "fractal":
        return {change: found for change, found in neighbours({"phenotype": body}).items() if change.startswith("body_")}
    kinds = ("body_", "arrangement_") if kind == "free" else ("body_",)
    return {change: found for change, found in neighbours({"phenotype": f"{body}|{arrangement}"}).items() if change.startswith(kinds)}


class Walker:
    """Walks the robots of one climb, each of them once.

    @param walk walk(level, number, parts): how far a robot goes in body lengths, or None if its walk failed"""

    def __init__(self, walk):
        self.walk = walk
        self.of_bodies = {}  # at 3 cells the arrangement does not matter
        self.number = 0

    def speeds(self, parts, least=-math.inf):
        """How far a robot goes at both scales. At 9 cells it does not walk if it is no faster than `least` at 3, so that it cannot be fitter."""
        self.number += 1
        body = parts[0]
        if body not in self.of_bodies:
            self.of_bodies[body] = self.walk(SMALLER, self.number, parts)
        smaller = self.of_bodies[body]
        return smaller, self.walk(LARGER, self.number, parts) if (smaller or 0.0) > least else None


def slower_of(speeds):
    return min(one or 0.0 for one in speeds)


def count(rows, change):
    """How many rows have a change of this kind."""
    return sum(row["change"].startswith(change) for row in rows)


def climb(start, kind, walk, random):
    """The robots of a climb, the first one and each that was fitter, and the last one again with the number of robots tried:
    [(tried, change, parts, speeds at both scales)].

    @param start (body, arrangement)
    @param walk what Walker asks for
    @param random a generator of random numbers, of NumPy"""
    walker, seen, tried = Walker(walk), {start}, 0
    found = [(0, "start", start, walker.speeds(start))]

    def untried():
        changes = [(change, parts) for change, parts in nearby(found[-1][2], kind).items() if parts not in seen]
        return [changes[at] for at in random.permutation(len(changes))]

    waiting = untried()
    while waiting and tried < TRIES:
        change, parts = waiting.pop()
        seen.add(parts)
        tried += 1
        present = slower_of(found[-1][3])
        speeds = walker.speeds(parts, present)
        if slower_of(speeds) > present:
            found.append((tried, change, parts, speeds))
            waiting = untried()
    return [*found, (tried, "end_of_tries" if waiting else "nothing_fitter_nearby", *found[-1][2:])]


def menger_walk(folder, program, robot, kind):
    """What Walker asks for, by menger simulate."""
    def walk(level, number, parts):
        name = f"{kind}_{number}"
        scene = folder / f"{robot['group']}-{robot['seed']}-{level}-{name}.toml"
        walked = folder / scene.stem / "scene.toml"
        write(folder, robot, level, name, parts)
        if not walked.exists() or walked.read_text() != scene.read_text():
            code = subprocess.run([program, "simulate", scene, "--output", walked.parent], stdout=subprocess.DEVNULL, check=False).returncode
            if code == STOPPED:
                raise KeyboardInterrupt
            if code not in ENDED:
                sys.exit(code)
            shutil.copyfile(scene, walked)
        return way(folder, robot, level, name)
    return walk


def climb_from(folder, program, group, seed):
    robot = start_of(group, seed)
    rows = []
    for kind in WAYS:
        random = np.random.default_rng([GROUPS.index(group), int(seed), list(WAYS).index(kind)])
        steps = climb(parts_of(robot), kind, menger_walk(folder, program, robot, kind), random)
        if slower_of(steps[0][3]) <= 0.0:
            raise InputError(f"{folder}: the robot of {group} {seed}, with which climbs begin, does not walk at both scales")
        rows += [[group, seed, kind, tried, change, "|".join(parts), *map(cell, speeds)] for tried, change, parts, speeds in steps]
    write_table(folder / f"{group}-{seed}.csv", COLUMNS, rows)


def take(folder):
    rows = []
    for robot in starts(*GROUPS):
        file = folder / f"{robot['group']}-{robot['seed']}.csv"
        of_robot = read_table(file)
        begins = {(row["way"], row["phenotype"]) for row in of_robot if row["change"] == "start"}
        if begins != {(kind, "|".join(parts_of(robot))) for kind in WAYS}:
            raise InputError(f"{file}: does not begin with the robot that is there now, in all ways; climb again")
        rows += of_robot
    write_table(HERE / "climbs.csv", COLUMNS, rows)


def fitness_after(climb, tries):
    """The fitness that a climb has reached when it has tried so many robots."""
    return max(fitness(row) for row in climb if int(row["tried"]) <= tries)


def compared(ratio, first, second, name):
    """How many times as large the first sample is as the second one; how often it is larger, of pairs that differ; and p of the signed-rank test of
    the logarithms.

    @param ratio the geometric mean of first / second"""
    return (ratio.cells(f"over_{name}") | share_of_larger_pairs(first, second).cells(f"larger_than_{name}")
            | {f"p_{name}": signed_rank(np.log(first), np.log(second))})


def summary():
    """How much fitter climbs make the robots that they begin with, in each way, after some robots and at the end.

    Planned were tests of climbs with a free arrangement against those as fractals, at the end: the signed rank of gains (p_gains) of all robots with the
    fault of the simulator, then of those without it; and that of logarithms (p_fractal) of random fractals. Gains are how many times as fit the
    robots become."""
    climbs = {}
    for row in read_table(HERE / "climbs.csv"):
        climbs.setdefault((row["group"], row["seed"], row["way"]), []).append(row)
    rows = []
    for name, (label, groups) in SETS.items():
        begun = sorted({(group, seed) for group, seed, _ in climbs if group in groups})
        if {group for group, _ in begun} != set(groups):
            continue
        for tries in AFTER:
            gains = {kind: np.array([fitness_after(climbs[*start, kind], tries) / fitness(climbs[*start, kind][0]) for start in begun]) for kind in WAYS}
            for kind, of_kind in WAYS.items():
                made = [[row for row in climbs[*start, kind] if int(row["tried"]) <= tries] for start in begun]
                rows.append({"robots": name, "way": kind, "after": tries, "label": label, "way_label": of_kind, "number": len(made)}
                            | geometric_mean(gains[kind]).cells("gain") | mean([min(tries, int(climbs[*start, kind][-1]["tried"])) for start in begun]).cells("tried")
                            | mean([count(climb, "body_") for climb in made]).cells("steps_of_body")
                            | mean([count(climb, "arrangement_") for climb in made]).cells("steps_of_arrangement")
                            | share(count([climb[-1] for climb in made], "nothing_fitter_nearby"), len(made)).cells("nothing_fitter_nearby"))
                if kind != "fractal":
                    p = signed_rank(gains[kind], gains["fractal"])
                    ratio = geometric_mean(gains[kind] / gains["fractal"])
                    rows[-1] |= compared(ratio, gains[kind], gains["fractal"], "fractal") | {"p_gains": p}
                    rows[-1] |= {"fitter_outcome": OUTCOMES[verdict(ratio, 1.0)] if tells_apart(p) else "open"}
                if kind == "free":
                    rows[-1] |= compared(geometric_mean(gains[kind] / gains["kept"]), gains[kind], gains["kept"], "kept")
    for table, tries in (("climbs_statistics", (TRIES,)), ("climbs_on_the_way", AFTER[:-1])):
        made = [{column: cell(value) for column, value in row.items()} for row in rows if row["after"] in tries]
        write_table(HERE / f"{table}.csv", list(max(made, key=len)), made)


def main(arguments):
    match arguments:
        case ["robots"]:
            for robot in starts(*GROUPS):
                print(robot["group"], robot["seed"])
        case ["climb", folder, program, group, seed] if group in GROUPS:
            climb_from(pathlib.Path(folder), program, group, seed)
        case ["take", folder]:
            take(pathlib.Path(folder))
        case ["summary"]:
            summary()
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    try:
        run_script(main)
    except KeyboardInterrupt:
        print("climbs.py: stopped; the same command goes on", file=sys.stderr)
        sys.exit(STOPPED)
