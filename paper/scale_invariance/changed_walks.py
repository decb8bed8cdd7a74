#!/usr/bin/python3
"""Walks of champions with something changed that may explain why they do not do the same at the next scale, and at a scale beyond.

changed_walks.py similar FOLDER      writes scenes of the champions of two scales at larger scales, each with the weight, the stiffness, or
                                     both that make it as heavy and as stiff for its size as at the scale before
changed_walks.py balanced FOLDER     writes scenes of all champions, those of ../phase_wave and ../single_actuator, too, at the two smallest
                                     scales: as they are, with half the time step, and with beams whose moments balance their forces,
                                     which champions of some searches have already
changed_walks.py fourth FOLDER       writes scenes of the champions of three scales at the third and at a fourth one, 81 cells per side
changed_walks.py take FOLDER TABLE   makes TABLE.csv of what menger simulate wrote for the scenes of a folder
changed_walks.py summary             makes similar_statistics.csv, balanced_statistics.csv, one_material.csv, against_control.csv, fourth_statistics.csv
                                     and against_control.svg of the tables that there are

Exit codes: 0 done, 2 wrong input.
"""

import math
import pathlib
import re
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

import numpy as np  # noqa: E402
from sample_statistics import mcnemar, median, rank_sum, share, share_of_larger, signed_rank, tells_apart  # noqa: E402
from scale_invariance import (ALL_EVOLVED, CELL_EDGE_M, EVOLVED_BALANCED, GROUPS, LEAST_BODY_LENGTHS, LEVELS, PER_MINUTE, angle_and_factor, body_lengths,  # noqa: E402
                              carries_over, outcome, robots, same_way)
from small_tables import InputError, cell, read_table, read_toml, run_script, toml_text, write_table, write_whole  # noqa: E402
from svg_figure import letter_panels, pyplot_for_svg, settle, write_svg  # noqa: E402

COLUMNS = ["group", "seed", "phenotype", "level", "change", "dx_m", "dy_m"]
ONE_MATERIAL = {"phase_wave": "one material, a wave", "single_actuator": "one material, in phase"}  # searches of other experiments at two scales
SEARCH_STUDIES = {"random": HERE.parent / "fractal" / "two_scales.toml",  # as they walk in searches
                  "one_scale": HERE / "one_scale.toml", "two_scales": HERE.parent / "fractal" / "two_scales.toml",
                  "two_scales_again": HERE.parent / "fractal" / "again.toml", "control_again": HERE.parent / "non_fractal" / "again.toml", "three_scales": HERE.parent / "fractal" / "single_precision.toml", "one_scale_balanced": HERE / "one_scale_balanced.toml",
                  "two_scales_balanced": HERE.parent / "fractal" / "two_scales_balanced.toml",
                  "two_scales_again_balanced": HERE.parent / "fractal" / "again_balanced.toml", "control_again_balanced": HERE.parent / "non_fractal" / "again_balanced.toml"} | {name: HERE.parent / name / "two_scales.toml" for name in ONE_MATERIAL}
PHYSICS = ("loads", "ground", "materials", "damping", "drive", "collisions", "limits", "integration")
PRESET = HERE.parent / "presets" / "paper.toml"
# A body three times as long that moves as often has three times the accelerations. It is as heavy beside them with three times the
# gravity, and as stiff with nine times the modulus: stress is modulus times strain, and density times acceleration times length.
SIMILAR = {"as_it_is": (1.0, 1.0), "weight": (3.0, 1.0), "stiffness": (1.0, 9.0), "weight_and_stiffness": (3.0, 9.0)}
SIMILAR_LABELS = {"as_it_is": "as it is", "weight": "gravity x 3", "stiffness": "Young's modulus x 9", "weight_and_stiffness": "both"}
# Champions are the best of many as they are, so that any change makes them slower: half the time step is the change to compare with.
BALANCED = {"as_it_is": {}, "balanced": {"materials": {"beam_moments": "balanced"}}, "half_step": {"integration": {"time_step_fraction": 0.45}}}
BALANCED_LABELS = {"balanced": "balanced moments", "half_step": "half the time step"}
BALANCED_LEVELS = (1, 2)
CONTROL = "control_again"
FRACTALS = {"two_scales_again": "fractals, again", "two_scales": "fractals"}  # of the same rules; the former have as many generations as the control
FOURTH_LEVELS = (3, 4)
LEAST_SHARE = 0.5  # of its speed, which a champion keeps


def champions(*groups):
    return [row for row in robots() if row["group"] in groups]


def champions_of_one_material():
    for group in ONE_MATERIAL:
        file = HERE.parent / group / "champions.csv"
        for row in read_table(file) if file.exists() else []:
            if row["study"] == SEARCH_STUDIES[group].stem:
                yield {"group": group, "seed": row["seed"], "phenotype": row["digits"]}


def robots_of_searches():
    return [*champions(*ALL_EVOLVED), *champions_of_one_material()]


def design_of(robot, level):
    """The cells of a robot. At 9 cells per side those of the control are written out: its body in every cell of its arrangement."""
    body, *arrangements = robot["phenotype"].split("|")
    if not arrangements or level == 1:
        return {"cells": [3, 3, 3], "digits": body, "level": level}
    cells, arranged = (np.array(list(digits), dtype=int).reshape(3, 3, 3) for digits in (body, arrangements[0]))
    aggregate = np.kron(arranged > 0, cells)
    return {"cells": list(aggregate.shape), "digits": "".join(map(str, aggregate.flat)), "level": 1}


def scene(robot, level, changes):
    """A scene with the physics of the search but for what is changed.

    @param changes {table: {key: number or word}}"""
    preset, study = read_toml(PRESET), read_toml(SEARCH_STUDIES[robot["group"]])
    tables = {name: preset[name] | study.get(name, {}) | changes.get(name, {}) for name in PHYSICS}
    design = {"name": f"champion_{robot['group']}_{robot['seed']}", "cell_edge_m": CELL_EDGE_M} | design_of(robot, level)
    time = {"duration_s": preset["time"]["duration_s"], "record_interval_s": 0.2}
    return toml_text({"design": design, "time": time, "output": {"frames": False, "pictures": False}} | tables)


def write_scene(folder, robot, level, change, changes):
    folder.mkdir(parents=True, exist_ok=True)
    write_whole(folder / f"{robot['group']}-{robot['seed']}-{level}-{change}.toml", scene(robot, level, changes))


def similar_scenes(folder):
    """Those as they are come from the same program as the changed ones, at the smallest level, too.

    The global damping is a fraction of 2 sqrt(m E L), and acts on velocities that are three times as large beside accelerations that are
    so, too: a body with nine times the modulus has a third of that fraction. The damping of beams, 1 % of their stress at the frequency
    of the drive, is left as it is, and contacts give way in proportion to the modulus."""
    preset = read_toml(PRESET)
    for robot in champions("two_scales"):
        for level in LEVELS:
            for change, (weight, stiffness) in SIMILAR.items():
                if level == LEVELS[0] and change != "as_it_is":
                    continue
                write_scene(folder, robot, level, change, {
                    "loads": {"gravity_m_per_s2": preset["loads"]["gravity_m_per_s2"] * weight},
                    "materials": {"youngs_modulus_Pa": preset["materials"]["youngs_modulus_Pa"] * stiffness},
                    "damping": {"global": preset["damping"]["global"] / math.sqrt(stiffness)}})


def balanced_scenes(folder):
    for robot in robots_of_searches():
        for level in BALANCED_LEVELS:
            for change, changes in BALANCED.items():
                if change == "balanced" and robot["group"] in EVOLVED_BALANCED:
                    continue
                write_scene(folder, robot, level, change, changes)


def fourth_scenes(folder):
    for robot in champions("three_scales"):
        for level in FOURTH_LEVELS:
            write_scene(folder, robot, level, "as_it_is", {})


def take(folder, table):
    """Walks that are not there yet, or were stopped, or of robots that are gone, have no row, and failed ones no ends."""
    champions_now = {(robot["group"], robot["seed"]): robot for robot in robots_of_searches()}
    rows = []
    for file in sorted(folder.glob("*.toml"), key=lambda file: [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", file.stem)]):
        group, seed, level, change = file.stem.split("-")
        result = folder / file.stem / "result.toml"
        robot, design = champions_now.get((group, seed)), read_toml(file)["design"]
        if robot is None or design["digits"] != design_of(robot, int(level))["digits"] or not result.exists() or (found := read_toml(result)).get("status") == "stopped":
            continue
        ends_m = [cell(value, 6) for value in found.get("displacement_m", ["", ""])[:2]]
        rows.append(dict(zip(COLUMNS, [group, seed, robot["phenotype"], level, change, *ends_m])))
    write_table(HERE / f"{table}.csv", COLUMNS, rows)


def walks_of(table, failed_m=None):
    """{(group, seed): {(level, change): end in metres}}, without walks that failed, or with an end that they get in place."""
    file = HERE / f"{table}.csv"
    walks = {}
    for row in read_table(file) if file.exists() else []:
        end_m = np.array([float(row[name]) for name in ("dx_m", "dy_m")]) if row["dx_m"] else failed_m
        if end_m is not None:
            walks.setdefault((row["group"], row["seed"]), {})[int(row["level"]), row["change"]] = end_m
    return walks


def pairs_of(walks, first, second):
    """The ends of two walks, (level, change) each, of all robots that have both and move in the first one: two arrays, or nothing."""
    pairs = [(found[first], found[second]) for found in walks if first in found and second in found]
    pairs = [pair for pair in pairs if body_lengths(pair[0], first[0]) >= LEAST_BODY_LENGTHS]
    return [np.array(side) for side in zip(*pairs)]


def similar_statistics():
    """Whether champions carry over to the next scale where weight and stiffness are those of a body of its size, and whether that differs
    from the same champions as they are there."""
    walks = walks_of("similar")
    rows = []
    for upper in LEVELS[1:]:
        before, plain = (upper - 1, "as_it_is"), (upper, "as_it_is")
        for change, label in SIMILAR_LABELS.items():
            if pairs := pairs_of(walks.values(), before, (upper, change)):
                about = {"levels": f"{upper - 1} to {upper}", "cells": f"{3 ** (upper - 1)} to {3**upper}", "change": change, "label": label}
                with_plain = [found for found in walks.values() if plain in found and (upper, change) in found]
                of_both = [pairs_of(with_plain, before, walk) for walk in (plain, (upper, change))]
                rows.append(about | outcome(*pairs) | (against_plain(*of_both) if change != "as_it_is" and of_both[0] else {"p_carried_over": None, "p_speed": None, "faster_outcome": None}))
    return rows


def against_plain(plain, changed):
    """p of the same robots with a change and without: McNemar's test of who carries over, and the signed rank of how fast they are; whether they are
    faster with it."""
    found = [angle_and_factor(*pairs) for pairs in (plain, changed)]
    (_, before), (_, after) = found
    p = signed_rank(before, after)
    faster = "reproduced" if np.median(after) > np.median(before) else "not reproduced"
    return {"p_carried_over": mcnemar(*(carries_over(*one) for one in found)), "p_speed": p, "faster_outcome": faster if tells_apart(p) else "open"}


def balanced_statistics():
    """What is left of the speed of champions at the same scale where the moments of beams balance their forces, and with half the step."""
    walks = walks_of("balanced", np.zeros(2))  # who fails keeps nothing of its speed
    rows = []
    for group in [*ALL_EVOLVED, *ONE_MATERIAL]:
        of_group = [found for (name, _), found in walks.items() if name == group]
        for level in BALANCED_LEVELS:
            for change, label in BALANCED_LABELS.items():
                if pairs := pairs_of(of_group, (level, "as_it_is"), (level, change)):
                    about = {"group": group, "change": change, "level": level, "cells_per_side": 3**level, "label": (GROUPS | ONE_MATERIAL)[group], "changed": label}
                    rows.append(about | kept(*pairs, level))
    return rows


def one_material():
    """Whether each robot of one material does at 9 cells what it does at 3, as it is and with something changed."""
    rows = []
    for (group, seed), found in walks_of("balanced").items():
        for change in BALANCED if group in ONE_MATERIAL else ():
            ends_m = [found.get((level, change)) for level in BALANCED_LEVELS]
            if all(end_m is not None for end_m in ends_m):
                rows.append({"group": group, "seed": seed, "change": change, "label": ONE_MATERIAL[group], "changed": BALANCED_LABELS.get(change, "as it is")} | next_scale(*ends_m))
    return rows


def next_scale(lower_m, upper_m):
    """Of one robot: the angle between its ways, how many times as fast it is at the larger scale, and whether it carries over."""
    found = angle_and_factor(lower_m[np.newaxis], upper_m[np.newaxis])
    carried_over = bool(carries_over(*found)[0])
    return {"angle_deg": float(found[0][0]), "speed_factor": float(found[1][0]), "carries_over": "yes" if carried_over else "no",
            "outcome": "reproduced" if carried_over else "open"}  # of the paper's claim that there is such a robot


def speeds_with_and_without_fault():
    """The speeds at both scales, in body lengths a minute, of the champions of fractals and of the control that move at both: as they are, and with
    balanced beams. {group: array (2, robots, scales)}."""
    wanted = [[(level, change) for level in BALANCED_LEVELS] for change in ("as_it_is", "balanced")]
    speeds = {group: [] for group in (*FRACTALS, CONTROL)}
    for (group, _), found in walks_of("balanced", np.zeros(2)).items():
        if group in speeds and all(walk in found for change in wanted for walk in change):
            both = [[body_lengths(found[walk], walk[0]) for walk in change] for change in wanted]
            if min(both[0]) >= LEAST_BODY_LENGTHS:
                speeds[group].append(both)
    return {group: PER_MINUTE * np.array(robots).reshape(-1, 2, len(BALANCED_LEVELS)).transpose(1, 0, 2) for group, robots in speeds.items()}


def against_control(speeds):
    """What balanced beams leave of the speed of champions at each scale, and of their fitness, the slower of both speeds: fractals against the
    control.

    @param speeds what speeds_with_and_without_fault gives"""
    control = measures_of(*speeds[CONTROL])
    rows = []
    for group, label in FRACTALS.items():
        for what, fractals in measures_of(*speeds[group]).items():
            if len(fractals) and len(control[what]):
                rows.append({"group": group, "what": what, "label": label, "robots": len(fractals), "controls": len(control[what])}
                            | median(fractals).cells("fractal") | median(control[what]).cells("control")
                            | share_of_larger(fractals, control[what]).cells("fractal_is_larger") | {"p": rank_sum(fractals, control[what])})
    return rows


def measures_of(before, after):
    """Of the speeds (robots, scales) before and after a change: {what it is: an array (robots)}."""
    left = {f"share of the speed that is left at {3**level} cells": (after / before)[:, at] for at, level in enumerate(BALANCED_LEVELS)}
    return left | {"fitness in the paper's simulator": before.min(axis=1), "fitness with balanced beams": after.min(axis=1)}


def draw_against_control(speeds_of):
    """The fitness of each champion in the paper's simulator and with balanced beams, a panel for each kind; readable where it is printed 6.5 inches
    wide.

    @param speeds_of what speeds_with_and_without_fault gives"""
    groups = {label: ("#0072B2", speeds_of[group]) for group, label in FRACTALS.items()}
    groups["control, again"] = ("#D55E00", speeds_of[CONTROL])
    if not all(speeds.size for _, speeds in groups.values()):
        return
    pyplot = pyplot_for_svg()
    pyplot.rcParams |= {"font.size": 8, "legend.fontsize": 7.5}
    figure, axes = pyplot.subplots(1, len(groups), figsize=(6.5, 2.4), layout="constrained", sharey=True)
    letter_panels(zip(axes, (f"{name} (n = {speeds.shape[1]})" for name, (_, speeds) in groups.items())))
    for axis, (colour, speeds) in zip(axes, groups.values()):
        fitness = speeds.min(axis=2)
        lines = axis.plot((0, 1), fitness, "o-", color=colour, markersize=3, linewidth=0.8, alpha=0.7)
        (middle,) = axis.plot((0, 1), np.median(fitness, axis=1), "s-", color="black", markersize=4, linewidth=2)
        axis.set(xticks=(0, 1), xticklabels=("paper's\nsimulator", "balanced\nbeams"), xlim=(-0.3, 1.3))
    axes[-1].legend((lines[0], middle), ("a robot", "median"), loc="upper right")
    axes[0].set(ylabel="fitness\n(body lengths per minute)", ylim=(0, 1.05 * max(speeds.min(axis=2).max() for _, speeds in groups.values())))
    settle(figure)
    write_svg(figure, HERE / "against_control.svg")


def fourth_statistics():
    """Of each champion of three scales, whether it does at the fourth one what it does at the third."""
    rows = []
    for (group, seed), found in walks_of("fourth").items():
        ends_m = [found.get((level, "as_it_is")) for level in FOURTH_LEVELS]
        if any(end_m is None for end_m in ends_m):
            continue
        rows.append({"group": group, "seed": seed} | next_scale(*ends_m) | {f"level_{level}_per_minute": float(body_lengths(end_m, level)) * PER_MINUTE for level, end_m in zip(FOURTH_LEVELS, ends_m)})
    return rows


def kept(before_m, after_m, level):
    """How fast robots are before and after a change, the one that is fastest before it, too; how many keep half of their speed, and how many
    their way."""
    before, after = body_lengths(before_m, level), body_lengths(after_m, level)
    keep = share(int(np.sum(after >= LEAST_SHARE * before)), len(before))
    row = {"robots": len(before), "before_per_minute": float(np.median(before)) * PER_MINUTE, "after_per_minute": float(np.median(after)) * PER_MINUTE,
           "fastest_before_per_minute": float(before.max()) * PER_MINUTE, "fastest_after_per_minute": float(after[before.argmax()]) * PER_MINUTE}
    row |= median(after / before).cells("ratio") | {"p": signed_rank(before, after)} | keep.cells("keep_half")
    return row | share(int(same_way(*angle_and_factor(before_m, after_m)).sum()), len(before)).cells("same_way")


def summary():
    speeds = speeds_with_and_without_fault()
    for name, rows in (("similar_statistics", similar_statistics()), ("balanced_statistics", balanced_statistics()), ("one_material", one_material()),
                       ("against_control", against_control(speeds)), ("fourth_statistics", fourth_statistics())):
        if rows:
            write_table(HERE / f"{name}.csv", list(rows[0]), [{key: cell(value) for key, value in row.items()} for row in rows])
    draw_against_control(speeds)


def main(arguments):
    match arguments:
        case ["similar", folder]:
            similar_scenes(pathlib.Path(folder))
        case ["balanced", folder]:
            balanced_scenes(pathlib.Path(folder))
        case ["fourth", folder]:
            fourth_scenes(pathlib.Path(folder))
        case ["take", folder, ("similar" | "balanced" | "fourth") as table]:
            take(pathlib.Path(folder), table)
        case ["summary"]:
            summary()
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
