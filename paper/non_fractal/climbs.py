#!/usr/bin/python3
"""How far do the best fractals get by small changes as fractals, and how far if the arrangement of their bodies may change alone, as in the control?

climbs.py robots                          lists the robots to begin with: GROUP SEED. The best fractals of the trials with 140 generations, of the
                                          repetition, and of the repetition with balanced beams; and random fractals, which no search has selected
climbs.py climb FOLDER MENGER GROUP SEED  climbs from one of them in all ways, into FOLDER/GROUP-SEED.csv; MENGER is the program. Walks that are
                                          in FOLDER already are not done again
climbs.py take FOLDER                     makes climbs.csv of the climbs of these robots
climbs.py summary                         makes climbs_statistics.csv

A climb tries robots that differ from the present one in one cell of the body, or in one place of the arrangement (neighbours.py),
in random order. It goes on from the first that is fitter, and tries no robot twice. It ends when all that are nearby were tried, or after as many
as TRIES in all. *as a fractal*: the arrangement is the body, so that a change of the body changes both. *as in the control*: a change of the body
keeps the arrangement, and the arrangement changes alone, too. *with the arrangement kept*: a change of the body keeps it, and it never changes.
All begin with the same robot.
Exit codes: 0 done, 2 wrong input, 130 stopped; others are those of menger.
"""

import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance"), str(HERE)]

import numpy as np  # noqa: E402
from changed_walks import champions  # noqa: E402
from neighbours import LARGER, SMALLER, is_allowed, neighbours, parts_of, way, write  # noqa: E402
from scale_invariance import LEAST_BODY_LENGTHS, body_lengths  # noqa: E402
from sample_statistics import OUTCOMES, geometric_mean, mean, share, share_of_larger_pairs, signed_rank, tells_apart, verdict  # noqa: E402
from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402

WITH_FAULT = ("two_scales", "two_scales_again")  # of the simulator: ../discrepancies/README.md
GROUPS = (*WITH_FAULT, "two_scales_again_balanced", "random")
RANDOM = 25  # robots
SETS = {"with_fault": ("both kinds below", WITH_FAULT), "two_scales": ("after 140 generations", ("two_scales",)),
        "two_scales_again": ("of the repetition", ("two_scales_again",)),
        "without_fault": ("of the repetition with balanced beams", ("two_scales_again_balanced",)), "random": ("random fractals", ("random",))}
WAYS = {"fractal": "as fractals", "free": "as in the control", "kept": "with the arrangement kept"}
TRIES = 150  # robots, beside the one that a climb begins with
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

    def ways(self, parts, least=-1.0):
        """How far a robot goes at both scales. At 9 cells it does not walk if it is no faster than `least` at 3, so that it cannot be fitter."""
        self.number += 1
        body = parts[0]
        if body not in self.of_bodies:
            self.of_bodies[body] = self.walk(SMALLER, self.number, parts)
        smaller = self.of_bodies[body]
        return smaller, self.walk(LARGER, self.number, parts) if (smaller or 0.0) > least else None


def fitness(ways):
    return min(one or 0.0 for one in ways)


def fitness_of(row):
    return min(float(row[f"level_{level}_body_lengths"]) for level in (SMALLER, LARGER))



def steps(rows, kind):
    """How many rows have a change of this kind."""
    return sum(row["change"].startswith(kind) for row in rows)


def climb(start, kind, walk, random):
    """The robots of a climb, the first one and each that was fitter, and the last one again with the number of robots tried:
    [(tried, change, parts, ways at both scales)].

    @param start (body, arrangement)
    @param walk what Walker asks for
    @param random a generator of random numbers, of NumPy"""
    walker, seen, tried = Walker(walk), {start}, 0
    found = [(0, "start", start, walker.ways(start))]

    def untried():
        changes = [(change, parts) for change, parts in nearby(found[-1][2], kind).items() if parts not in seen]
        return [changes[at] for at in random.permutation(len(changes))]

    waiting = untried()
    while waiting and tried < TRIES:
        change, parts = waiting.pop()
        seen.add(parts)
        tried += 1
        present = fitness(found[-1][3])
        ways = walker.ways(parts, present)
        if fitness(ways) > present:
            found.append((tried, change, parts, ways))
            waiting = untried()
    return [*found, (tried, "end_of_tries" if waiting else "nothing_fitter_nearby", *found[-1][2:])]


def menger_walk(folder, program, robot, kind):
    """What Walker asks for, by menger simulate."""
    def walk(level, number, parts):
        change = f"{kind}_{number}"
        scene = folder / f"{robot['group']}-{robot['seed']}-{level}-{change}.toml"
        walked = folder / scene.stem / "scene.toml"
        write(folder, robot, level, change, parts)
        if not walked.exists() or walked.read_text() != scene.read_text():
            code = subprocess.run([program, "simulate", scene, "--output", walked.parent], stdout=subprocess.DEVNULL, check=False).returncode
            if code == STOPPED:
                raise KeyboardInterrupt
            if code not in ENDED:
                sys.exit(code)
            shutil.copyfile(scene, walked)
        return way(folder, robot, level, change)
    return walk


def climb_from(folder, program, group, seed):
    robot = start_of(group, seed)
    rows = []
    for kind in WAYS:
        random = np.random.default_rng([GROUPS.index(group), int(seed), list(WAYS).index(kind)])
        for tried, change, parts, ways in climb(parts_of(robot), kind, menger_walk(folder, program, robot, kind), random):
            rows.append([group, seed, kind, tried, change, "|".join(parts), *map(cell, ways)])
    write_table(folder / f"{group}-{seed}.csv", COLUMNS, rows)


def take(folder):
    rows = []
    for robot in starts(*GROUPS):
        of_robot = read_table(folder / f"{robot['group']}-{robot['seed']}.csv")
        if of_robot[0]["phenotype"] != "|".join(parts_of(robot)):
            raise InputError(f"{folder}/{robot['group']}-{robot['seed']}.csv: begins with another robot than the best of this search; climb again")
        rows += of_robot
    write_table(HERE / "climbs.csv", COLUMNS, rows)


def summary():
    """How much fitter climbs make the robots that they begin with, in each way. What was planned is the signed-rank test of climbs as in the control
    against those as fractals: of all robots with the fault of the simulator; and, when that was known, of those without it."""
    climbs = {}
    for row in read_table(HERE / "climbs.csv"):
        climbs.setdefault((row["group"], row["seed"], row["way"]), []).append(row)
    rows = []
    for name, (label, groups) in SETS.items():
        begun = sorted({(group, seed) for group, seed, _ in climbs if group in groups})
        gains = {way: np.array([fitness_of(climbs[*start, way][-1]) / fitness_of(climbs[*start, way][0]) for start in begun]) for way in WAYS}
        for way, of_way in WAYS.items() if begun else ():
            made = [climbs[*start, way] for start in begun]
            rows.append({"robots": name, "way": way, "label": label, "way_label": of_way, "number": len(made)}
                        | geometric_mean(gains[way]).cells("gain") | mean([int(climb[-1]["tried"]) for climb in made]).cells("tried")
                        | mean([steps(climb, "body_") for climb in made]).cells("steps_of_body")
                        | mean([steps(climb, "arrangement_") for climb in made]).cells("steps_of_arrangement")
                        | share(steps([climb[-1] for climb in made], "nothing_fitter_nearby"), len(made)).cells("nothing_fitter_nearby"))
            if way != "fractal":
                ratio, p = geometric_mean(gains[way] / gains["fractal"]), signed_rank(gains[way], gains["fractal"])
                rows[-1] |= ratio.cells("over_fractal") | share_of_larger_pairs(gains[way], gains["fractal"]).cells("fitter_than_fractal")
                rows[-1] |= {"p": p, "fitter_outcome": OUTCOMES[verdict(ratio, 1.0)] if tells_apart(p) else "open"}
            if way == "free":
                rows[-1] |= geometric_mean(gains[way] / gains["kept"]).cells("over_kept") | {"p_over_kept": signed_rank(gains[way], gains["kept"])}
    write_table(HERE / "climbs_statistics.csv", list(max(rows, key=len)), [{column: cell(value) for column, value in row.items()} for row in rows])


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
