#!/usr/bin/python3
"""Whether robots do at the next scale what they do at one: tables of robots, and what follows from them.

scale_invariance.py random INDIVIDUALS.csv           puts the random robots into robots.csv, of what menger export wrote
scale_invariance.py champion EXPORT GROUP SEED       adds the champion of a search, which menger export simulated at three levels
scale_invariance.py similar FOLDER                   writes scenes of the champions of two scales at larger scales, each with the weight, the
                                                     stiffness, or both that make it as heavy and as stiff for its size as at the scale before
scale_invariance.py simulated FOLDER                 makes similar.csv of what menger simulate wrote for these scenes
scale_invariance.py summary                          makes statistics.csv, similar_statistics.csv, dimension.csv and scale_invariance.svg

A robot carries over from one level to the next if it goes the same way within 45 degrees, and between half and twice as fast in body
lengths. Robots that stand still at the smaller one do not count. Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import numpy as np  # noqa: E402
from sample_statistics import median, share  # noqa: E402
from small_tables import InputError, cell, read_table, read_toml, run_script, write_table, write_whole  # noqa: E402
from svg_figure import pyplot_for_svg, write_svg  # noqa: E402

LEVELS = (1, 2, 3)
CELL_EDGE_M = 0.01
LARGEST_ANGLE_DEG = 45.0
LARGEST_FACTOR = 2.0
LEAST_BODY_LENGTHS = 0.1  # in 5 s, at the smaller scale; whoever goes less stands still, and has nothing to carry over
RESAMPLES = 2000  # of robots that are paired by chance
GROUPS = {"random": "random robots", "one_scale": "evolved at one scale", "two_scales": "evolved at two scales",
          "three_scales": "evolved at three scales"}
COLUMNS = ["group", "seed", "robot", "cells", "phenotype"] + [f"level_{level}_{axis}_m" for level in LEVELS for axis in ("dx", "dy")]
# A body three times as long that moves as often has three times the accelerations. It is as heavy beside them with three times the
# gravity, and as stiff with nine times the modulus: stress is modulus times strain, and density times acceleration times length.
SIMILAR = {"weight": (3.0, 1.0), "stiffness": (1.0, 9.0), "weight_and_stiffness": (3.0, 9.0)}
SIMILAR_LABELS = {"as_it_is": "as it is", "weight": "gravity x 3", "stiffness": "Young's modulus x 9", "weight_and_stiffness": "both"}
SIMILAR_COLUMNS = ["seed", "phenotype", "level", "change", "dx_m", "dy_m"]
GRAVITY_M_PER_S2 = 9.81
YOUNGS_MODULUS_PA = 1e4
# Random robots at two scales, from another experiment
AT_TWO_SCALES = HERE.parent / "discrepancies" / "walks" / "text.csv"


def robots():
    file = HERE / "robots.csv"
    return read_table(file) if file.exists() else []


def robots_but(group, seed):
    """The rows of robots.csv but those of a search, which are to be made anew."""
    return [row for row in robots() if (row["group"], row["seed"]) != (group, seed)]


def cells_of(phenotype):
    return sum(digit != "0" for digit in phenotype)


def row_of(group, seed, robot, phenotype, ends_m):
    row = {"group": group, "seed": seed, "robot": robot, "cells": cells_of(phenotype), "phenotype": phenotype}
    for level, end_m in ends_m.items():
        for axis, value in zip(("dx", "dy"), end_m):
            row[f"level_{level}_{axis}_m"] = cell(float(value), 6)
    return row


def add(rows, group, seed):
    order = list(GROUPS)
    everything = robots_but(group, seed) + rows
    everything.sort(key=lambda row: (order.index(row["group"]), int(row["seed"]), int(row["robot"])))
    write_table(HERE / "robots.csv", COLUMNS, everything)


def add_random(source):
    """Each body once."""
    bodies = {}
    for row in read_table(source):
        if all(row[f"level_{level}_dx_m"] for level in LEVELS):
            bodies.setdefault(row["phenotype"], row)
    rows = [row_of("random", "2", row["individual"], body, {level: (row[f"level_{level}_dx_m"], row[f"level_{level}_dy_m"]) for level in LEVELS})
            for body, row in bodies.items()]
    add(rows, "random", "2")


def add_champion(folder, group, seed):
    if group not in GROUPS:
        raise InputError(f"{group}: must be one of {', '.join(GROUPS)}")
    ends_m = {}
    for level in LEVELS:
        result = read_toml(folder / f"level_{level}" / "result.toml")
        if "displacement_m" in result:
            ends_m[level] = result["displacement_m"][:2]
    last = read_table(folder / "lineage.csv")[-1]
    add([row_of(group, seed, last["individual"], last["phenotype"], ends_m)], group, seed)


def ends(rows, level):
    return np.array([[float(row.get(f"level_{level}_{axis}_m") or "nan") for axis in ("dx", "dy")] for row in rows])


def angle_and_factor(lower_m, upper_m):
    """Between the ways at two levels, whose body lengths differ threefold: the angle in degrees, and how many times as fast."""
    turn = np.degrees(np.arctan2(lower_m[:, 0] * upper_m[:, 1] - lower_m[:, 1] * upper_m[:, 0], np.sum(lower_m * upper_m, axis=1)))
    return np.abs(turn), np.hypot(*upper_m.T) / np.hypot(*lower_m.T) / 3.0


def moving(rows, lower, upper):
    """The ends at two levels of the robots that move at the lower one and end their walks at both."""
    lower_m, upper_m = ends(rows, lower), ends(rows, upper)
    there = (np.hypot(*lower_m.T) >= LEAST_BODY_LENGTHS * CELL_EDGE_M * 3**lower) & ~np.isnan(upper_m).any(axis=1)
    return lower_m[there], upper_m[there]


def carries_over(angle_deg, factor):
    return (angle_deg <= LARGEST_ANGLE_DEG) & (factor >= 1.0 / LARGEST_FACTOR) & (factor <= LARGEST_FACTOR)


def by_chance(lower_m, upper_m):
    """The share that carries over where each robot is compared with another one of its group."""
    draw = np.random.default_rng(1)
    shares = [np.mean(carries_over(*angle_and_factor(lower_m, upper_m[draw.permutation(len(upper_m))]))) for _ in range(RESAMPLES)]
    return float(np.mean(shares))


def dimension(row):
    return float(np.log(cells_of(row["phenotype"])) / np.log(3.0))


def groups():
    """The robots of each group; random ones at two scales are those of another experiment, and more of them."""
    every = {group: [row for row in robots() if row["group"] == group] for group in GROUPS}
    every = {group: rows for group, rows in every.items() if rows}
    if AT_TWO_SCALES.exists():
        seen = {row["phenotype"] for row in every.get("random", [])}
        every["random"] = every.get("random", []) + [row for row in read_table(AT_TWO_SCALES) if row["phenotype"] not in seen]
    return every


def outcome(lower_m, upper_m):
    """Whether robots carry over, go the same way, and how much faster they are, with intervals."""
    angle, factor = angle_and_factor(lower_m, upper_m)
    carried = share(int(carries_over(angle, factor).sum()), len(angle))
    same_way = share(int((angle <= LARGEST_ANGLE_DEG).sum()), len(angle))
    speed = median(factor)
    return {"robots": len(angle), "carried_over": carried.value, "carried_over_low": carried.low, "carried_over_high": carried.high,
            "same_way": same_way.value, "same_way_low": same_way.low, "same_way_high": same_way.high,
            "speed_factor": speed.value, "speed_factor_low": speed.low, "speed_factor_high": speed.high}


def statistics_of(group, rows, lower, upper):
    lower_m, upper_m = moving(rows, lower, upper)
    if len(lower_m) == 0:
        return None
    row = {"group": group, "label": GROUPS[group], "levels": f"{lower} to {upper}", "cells": f"{3**lower} to {3**upper}"} | outcome(lower_m, upper_m)
    row["by_chance"] = by_chance(lower_m, upper_m) if len(lower_m) > 1 else None
    return {key: cell(value) for key, value in row.items()}


def similar_scenes(folder):
    """Scenes with the physics of the preset "paper" but for weight and stiffness."""
    folder.mkdir(parents=True, exist_ok=True)
    for row in robots():
        if row["group"] != "two_scales":
            continue
        for level in LEVELS[1:]:
            for change, (weight, stiffness) in SIMILAR.items():
                write_whole(folder / f"{row['seed']}_{level}_{change}.toml", f"""[design]
name = "champion_{row['seed']}"
cell_edge_m = {CELL_EDGE_M}
cells = [3, 3, 3]
digits = "{row['phenotype']}"
level = {level}
[time]
duration_s = 5.0
record_interval_s = 0.2
[output]
frames = false
pictures = false
[loads]
gravity_m_per_s2 = {GRAVITY_M_PER_S2 * weight}
[ground]
stop_rotation = true
[materials]
youngs_modulus_Pa = {YOUNGS_MODULUS_PA * stiffness}
density_kg_per_m3 = 10
""")


def take_similar(folder):
    rows = []
    for robot in robots():
        if robot["group"] != "two_scales":
            continue
        for level in LEVELS[1:]:
            changes = {"as_it_is": [robot[f"level_{level}_{axis}_m"] for axis in ("dx", "dy")]}
            for change in SIMILAR:
                result = folder / f"{robot['seed']}_{level}_{change}" / "result.toml"
                if result.exists() and "displacement_m" in read_toml(result):
                    changes[change] = [cell(value, 6) for value in read_toml(result)["displacement_m"][:2]]
            rows += [dict(zip(SIMILAR_COLUMNS, [robot["seed"], robot["phenotype"], level, change, *ends_m])) for change, ends_m in changes.items()]
    write_table(HERE / "similar.csv", SIMILAR_COLUMNS, rows)


def similar_statistics():
    """Whether the champions carry over to the next scale where weight and stiffness are those of a body of its size."""
    file = HERE / "similar.csv"
    made = []
    if not file.exists():
        return
    at = {(row["seed"], int(row["level"]), row["change"]): [float(row["dx_m"]), float(row["dy_m"])] for row in read_table(file)}
    first = {row["seed"]: ends([row], 1)[0] for row in robots() if row["group"] == "two_scales"}
    for upper in LEVELS[1:]:
        lower_of = {seed: first[seed] if upper == 2 else np.array(at[seed, 2, "as_it_is"]) for seed in first}
        for change, label in SIMILAR_LABELS.items():
            seeds = [seed for seed in first if (seed, upper, change) in at and np.hypot(*lower_of[seed]) >= LEAST_BODY_LENGTHS * CELL_EDGE_M * 3 ** (upper - 1)]
            if not seeds:
                continue
            row = {"levels": f"{upper - 1} to {upper}", "cells": f"{3 ** (upper - 1)} to {3**upper}", "change": change, "label": label}
            row |= outcome(np.array([lower_of[seed] for seed in seeds]), np.array([at[seed, upper, change] for seed in seeds]))
            made.append({key: cell(value) for key, value in row.items()})
    if made:
        write_table(HERE / "similar_statistics.csv", list(made[0]), made)


BINS = ((1.0, 1.8), (1.8, 2.2), (2.2, 2.5), (2.5, 2.8), (2.8, 3.01))


def by_dimension(rows, lower, upper):
    """The same share for random robots of similar Hausdorff dimension."""
    made = []
    for low, high in BINS:
        inside = [row for row in rows if low <= dimension(row) < high]
        found = statistics_of("random", inside, lower, upper) if inside else None
        if found:
            made.append({"dimension_from": f"{low:g}", "dimension_to": f"{min(3.0, high):g}"} | {key: value for key, value in found.items() if key not in ("group", "label")})
    return made


def summary():
    every = groups()
    rows = [found for group, members in every.items() for lower in LEVELS[:-1] if (found := statistics_of(group, members, lower, lower + 1))]
    if not rows:
        raise InputError(f"{HERE / 'robots.csv'}: has no robot with two levels")
    write_table(HERE / "statistics.csv", list(rows[0]), rows)
    similar_statistics()
    dimensions = by_dimension(every.get("random", []), 1, 2) + by_dimension(every.get("random", []), 2, 3)
    if dimensions:
        write_table(HERE / "dimension.csv", list(dimensions[0]), dimensions)
    draw(every, rows, dimensions)


def draw(every, rows, dimensions):
    """Angle and factor of every robot, and the shares by group and by dimension."""
    pyplot = pyplot_for_svg()
    styles = {"random": ("#999999", ".", 12), "one_scale": ("#E69F00", "s", 26), "two_scales": ("#0072B2", "o", 30), "three_scales": ("#D55E00", "D", 30)}
    figure, axes = pyplot.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    for group, members in every.items():
        angle, factor = angle_and_factor(*moving(members, 1, 2))
        colour, mark, size = styles[group]
        axes[0].scatter(angle, np.clip(factor, 0.02, 50.0), c=colour, marker=mark, s=size, label=GROUPS[group])
    axes[0].add_patch(pyplot.Rectangle((0, 1 / LARGEST_FACTOR), LARGEST_ANGLE_DEG, LARGEST_FACTOR - 1 / LARGEST_FACTOR, fill=False, linestyle="--"))
    axes[0].set(yscale="log", ylim=(0.018, 55), xlim=(0, 180), xticks=range(0, 181, 45), xlabel="angle between ways at 3 and 9 cells (degrees)",
                ylabel="speed in body lengths, 9 over 3 cells\n(clipped at 1/50 and 50)")
    axes[0].legend(loc="upper center", fontsize=8, ncols=2, bbox_to_anchor=(0.5, -0.16))
    shown = [(f"{row['label']}\n{row['cells']} cells (n = {row['robots']})", row) for row in rows]
    places = range(len(shown))
    values = [float(row["carried_over"]) for _, row in shown]
    spans = [[value - float(row["carried_over_low"]) for value, (_, row) in zip(values, shown)],
             [float(row["carried_over_high"]) - value for value, (_, row) in zip(values, shown)]]
    axes[1].errorbar(values, places, xerr=spans, fmt="o", color="#0072B2", capsize=3, label="with 95 % interval")
    chance = [(float(row["by_chance"]), place) for place, (_, row) in enumerate(shown) if row["by_chance"]]
    axes[1].scatter(*zip(*chance), marker="x", color="#222222", label="robots paired by chance")
    axes[1].set_yticks(places, [name for name, _ in shown])
    axes[1].set(xlim=(0, 1), xlabel="share that carries over")
    axes[1].legend(loc="upper center", fontsize=8, ncols=2, bbox_to_anchor=(0.4, -0.16))
    for levels, colour, mark in (("1 to 2", "#0072B2", "o"), ("2 to 3", "#D55E00", "D")):
        bins = [row for row in dimensions if row["levels"] == levels]
        middles = [0.5 * (float(row["dimension_from"]) + float(row["dimension_to"])) for row in bins]
        heights = [float(row["carried_over"]) for row in bins]
        spans = [[height - float(row["carried_over_low"]) for height, row in zip(heights, bins)],
                 [float(row["carried_over_high"]) - height for height, row in zip(heights, bins)]]
        if bins:
            axes[2].errorbar(middles, heights, yerr=spans, fmt=mark, color=colour, capsize=3, label=f"{bins[0]['cells']} cells")
    axes[2].set(ylim=(0, 1), xlim=(1, 3), xlabel="Hausdorff dimension of random robots", ylabel="share that carries over")
    axes[2].legend(loc="upper center", fontsize=8, ncols=2, bbox_to_anchor=(0.5, -0.16))
    for panel in axes:
        panel.grid(color="#dddddd")
        panel.set_axisbelow(True)
    write_svg(figure, HERE / "scale_invariance.svg")


def main(arguments):
    match arguments:
        case ["random", source]:
            add_random(pathlib.Path(source))
        case ["champion", folder, group, seed]:
            add_champion(pathlib.Path(folder), group, seed)
        case ["similar", folder]:
            similar_scenes(pathlib.Path(folder))
        case ["simulated", folder]:
            take_similar(pathlib.Path(folder))
        case ["summary"]:
            summary()
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
