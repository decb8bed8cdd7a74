#!/usr/bin/python3
"""Could the best fractals be faster with an arrangement of their own? The robots that differ in one cell from the best robots of the repetition.

neighbours.py first FOLDER      writes scenes of each champion at 3 and 9 cells per side, and at 3 of all bodies that differ from its body in one cell
neighbours.py larger FOLDER     writes those at 9 cells, when the first ones are simulated: of what the bodies that are fast enough at 3 make there,
                                and of all arrangements that differ from the champion's in one place
neighbours.py take FOLDER       makes neighbours.csv of what menger simulate wrote for these scenes
neighbours.py summary           makes neighbours_statistics.csv

A change of the body adds a cell, removes one, or gives it the other material. A fractal arranges its bodies as the body arranges its cells, so
that a change of its body is one of its arrangement, too; in the control the arrangement stays. A change of the arrangement alone adds a body to
it or removes one: fractals cannot do that, the control can. Robots obey the rules of the searches: one piece, three cells or more, nine or more
at 9 cells per side.
A robot that is no faster at 3 cells than its champion's fitness, the slower of its two speeds, cannot be fitter. It does not walk at 9 cells.
The gain is the fitness of the fittest neighbour over that of the champion, and 1 where none is fitter. Where the champion is slower at 3 cells
than at 9, no change of the arrangement alone is a gain: such robots do not walk at 9 cells, and count as not fitter.
Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance")]

import numpy as np  # noqa: E402
from changed_walks import champions, write_scene  # noqa: E402
from sample_statistics import geometric_mean, mean, rank_sum, share, signed_rank  # noqa: E402
from scale_invariance import body_lengths  # noqa: E402
from scipy.ndimage import label as pieces_of  # noqa: E402
from small_tables import InputError, cell, read_table, read_toml, run_script, write_table  # noqa: E402

GROUPS = {"two_scales_again": "fractals", "control_again": "the control"}
CHANGES = {"body": "one cell of the body", "arrangement": "one place of the arrangement alone"}
SMALLER, LARGER = 1, 2  # levels: 3 and 9 cells per side
FEWEST_CELLS = {SMALLER: 3, LARGER: 9}
COLUMNS = ["group", "seed", "change", "phenotype", "level_1_body_lengths", "level_2_body_lengths"]


def cube(digits):
    return np.array([digit != "0" for digit in digits]).reshape(3, 3, 3)


def is_allowed(body, arrangement):
    """Whether a robot obeys the rules of the searches at both scales. Cells are joined by faces."""
    shapes = {SMALLER: cube(body), LARGER: np.kron(cube(arrangement), cube(body))}
    return all(shape.sum() >= FEWEST_CELLS[level] and pieces_of(shape)[1] == 1 for level, shape in shapes.items())


def parts_of(robot):
    """The digits of the body of a champion, and of its arrangement, which is a fractal's body."""
    body, *arrangements = robot["phenotype"].split("|")
    return body, (arrangements or [body])[0]


def neighbours(robot):
    """The champion itself and all robots that differ from it in one cell: {change: (body, arrangement)}."""
    body, arrangement = parts_of(robot)
    is_fractal = "|" not in robot["phenotype"]
    found = {"champion": (body, arrangement)}
    for place in range(27):
        for state in "012":
            if state != body[place]:
                changed = body[:place] + state + body[place + 1:]
                found[f"body_{place}_{state}"] = (changed, changed if is_fractal else arrangement)
        changed = arrangement[:place] + ("1" if arrangement[place] == "0" else "0") + arrangement[place + 1:]
        found[f"arrangement_{place}"] = (body, changed)
    return {change: parts for change, parts in found.items() if change == "champion" or is_allowed(*parts)}


def write(folder, robot, level, change, parts):
    write_scene(folder, robot | {"phenotype": "|".join(parts)}, level, change, {})


def way(folder, robot, level, change):
    """How far a robot went, in body lengths; None if its walk failed, or is not there, or that of another robot."""
    name = f"{robot['group']}-{robot['seed']}-{level}-{change}"
    scene, walked, result = folder / f"{name}.toml", folder / name / "scene.toml", folder / name / "result.toml"
    if not all(file.exists() for file in (scene, walked, result)) or scene.read_text() != walked.read_text():
        return None
    found = read_toml(result)
    return float(body_lengths(np.array(found["displacement_m"][:2]), level)) if found.get("status") == "completed" else None


def of_repetition():
    found = champions(*GROUPS)
    missing = [group for group in GROUPS if group not in {robot["group"] for robot in found}]
    if missing:
        raise InputError(f"{HERE.parent}/scale_invariance/robots.csv: has no robot of {', '.join(missing)}: ./run paper scale_invariance {' '.join(missing)}")
    return found


def walks_at_smaller(change):
    return change == "champion" or change.startswith("body_")


def first_scenes(folder):
    for scene in folder.glob("*.toml"):  # of champions that may be others now; walks that are still asked for stay
        scene.unlink()
    for robot in of_repetition():
        for change, parts in neighbours(robot).items():
            if walks_at_smaller(change):
                write(folder, robot, SMALLER, change, parts)
            if change == "champion":
                write(folder, robot, LARGER, change, parts)


def smaller_way(folder, robot, change):
    """At 3 cells a robot with another arrangement goes as its champion does."""
    return way(folder, robot, SMALLER, change if walks_at_smaller(change) else "champion")


def larger_scenes(folder):
    for robot in of_repetition():
        speeds = [way(folder, robot, level, "champion") for level in (SMALLER, LARGER)]
        if None in speeds:
            raise InputError(f"{folder}: simulate the scenes of its champions first")
        for change, parts in neighbours(robot).items():
            if change != "champion" and (smaller_way(folder, robot, change) or 0.0) > min(speeds):
                write(folder, robot, LARGER, change, parts)


def take(folder):
    rows = []
    for robot in of_repetition():
        for change, parts in neighbours(robot).items():
            ways = [smaller_way(folder, robot, change), way(folder, robot, LARGER, change)]
            rows.append([robot["group"], robot["seed"], change, "|".join(parts), *map(cell, ways)])
    write_table(HERE / "neighbours.csv", COLUMNS, rows)


def fitness(row):
    """The slower of both speeds; 0 of robots that failed or are too slow at 3 cells to be fitter than their champion."""
    return min(float(row[f"level_{level}_body_lengths"] or 0.0) for level in (SMALLER, LARGER))


def summary():
    """For each champion: which share of its neighbours is fitter, and the gain. These are compared between both kinds of change of the same
    champions by the signed-rank test, gains also between fractals and the control by the rank-sum test. What was planned is the test of the
    gains of fractals by both changes."""
    walked = {}
    for row in read_table(HERE / "neighbours.csv"):
        walked.setdefault(row["group"], {}).setdefault(row["seed"], {})[row["change"]] = fitness(row)
    found = {}
    for group, every in walked.items():
        for kind in CHANGES:
            found[group, kind] = [np.array([one for change, one in walks.items() if change.startswith(kind)]) / walks["champion"] for walks in every.values()]
    gains = {key: [float(max(1.0, ratios.max(initial=0.0))) for ratios in each] for key, each in found.items()}
    fitter = {key: [float(np.mean(ratios > 1.0)) for ratios in each] for key, each in found.items()}
    rows = []
    for (group, kind), each in found.items():
        other = next(name for name in GROUPS if name != group)
        rows.append({"group": group, "change": kind, "label": GROUPS[group], "changed": CHANGES[kind], "champions": len(each), "neighbours": sum(map(len, each))}
                    | mean(fitter[group, kind]).cells("fitter") | share(sum(gain > 1.0 for gain in gains[group, kind]), len(each)).cells("with_fitter")
                    | geometric_mean(gains[group, kind]).cells("gain")
                    | {"p_of_changes": signed_rank(gains[group, "arrangement"], gains[group, "body"]),
                       "p_of_shares": signed_rank(fitter[group, "arrangement"], fitter[group, "body"]),
                       "p_of_groups": rank_sum(gains[group, kind], gains[other, kind]) if (other, kind) in gains else None})
    write_table(HERE / "neighbours_statistics.csv", list(rows[0]), [[cell(value) for value in row.values()] for row in rows])


def main(arguments):
    match arguments:
        case ["first", folder]:
            first_scenes(pathlib.Path(folder))
        case ["larger", folder]:
            larger_scenes(pathlib.Path(folder))
        case ["take", folder]:
            take(pathlib.Path(folder))
        case ["summary"]:
            summary()
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
