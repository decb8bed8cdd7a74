#!/usr/bin/python3
"""Whether robots do at the next scale what they do at one: tables of robots, and what follows from them.

scale_invariance.py random INDIVIDUALS.csv           puts the random robots into robots.csv, of what menger export wrote
scale_invariance.py random_balanced INDIVIDUALS.csv  the same of random robots with beams whose moments balance their forces
scale_invariance.py champion EXPORT GROUP SEED       adds the champion of a search, which menger export simulated at three levels, of
                                                     the control at two
scale_invariance.py summary                          makes statistics.csv, all_scales.csv, slowest.csv, designs.csv, comparisons.csv,
                                                     thresholds.csv, dimension.csv, dimension_tests.csv, scale_invariance.svg (each robot)
                                                     and carried_over.svg (shares of robots)

changed_walks.py has the walks of champions with something changed.

A robot carries over from one level to the next if it goes the same way within 45 degrees, and between half and twice as fast in body
lengths. Robots that stand still at the smaller one do not count. Selection prefers fast robots, whose speed carries over more often
than that of slow ones, so evolved robots are also compared with the fastest of the random ones: by the slower of their speeds at the
two smallest levels, as selection at two scales sees them. Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys
from itertools import zip_longest

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import numpy as np  # noqa: E402
from sample_statistics import OUTCOMES, difference_of_shares, fisher, median, pairing_p, rank_sum, share, signed_rank, spearman, tells_apart, verdict  # noqa: E402
from small_tables import InputError, cell, read_table, read_toml, run_script, write_table  # noqa: E402
from svg_figure import letter_panels, pyplot_for_svg, settle, write_svg  # noqa: E402

LEVELS = (1, 2, 3)
CELL_EDGE_M = 0.01
LARGEST_ANGLE_DEG = 45.0
LARGEST_FACTOR = 2.0
DURATION_S = 5.0  # of a walk in the paper's text
PER_MINUTE = 60.0 / DURATION_S
LEAST_BODY_LENGTHS = 0.1  # in 5 s, at the smaller scale; whoever goes less stands still, and has nothing to carry over
BALANCED = "with balanced beams"
GROUPS = {"random": "random robots", "one_scale": "evolved at one scale", "two_scales": "evolved at two scales",
          "control_again": "the control, again", "two_scales_again": "evolved at two scales, again",
          "three_scales": "evolved at three scales",
          "random_balanced": f"random robots {BALANCED}", "one_scale_balanced": f"evolved at one scale {BALANCED}",
          "two_scales_balanced": f"evolved at two scales {BALANCED}", "control_again_balanced": f"the control, again {BALANCED}",
          "two_scales_again_balanced": f"evolved at two scales, again {BALANCED}"}
EVOLVED = ("one_scale", "two_scales", "control_again", "two_scales_again", "three_scales")  # by the number of scales that selection sees
EVOLVED_BALANCED = ("one_scale_balanced", "two_scales_balanced", "control_again_balanced", "two_scales_again_balanced")
ALL_EVOLVED = EVOLVED + EVOLVED_BALANCED
LEVELS_OF = dict.fromkeys(("control_again", "control_again_balanced", "two_scales_again_balanced"), (1, 2))  # of groups that have fewer, or walked at fewer
ANGLES_DEG, FACTORS = (30.0, 45.0, 60.0), (1.5, 2.0, 3.0)  # other limits of what carries over, to see what hangs on them
FASTEST = (100, 25)  # of the random robots, groups of their own
COLUMNS = ["group", "seed", "robot", "cells", "phenotype"] + [f"level_{level}_{axis}_m" for level in LEVELS for axis in ("dx", "dy")]
# Random robots, and those that are evolved in the same physics
FAMILIES = {"random": EVOLVED, "random_balanced": EVOLVED_BALANCED}
# More random robots at two scales, from another experiment
AT_TWO_SCALES = {"random": HERE.parent / "discrepancies" / "walks" / "text.csv", "random_balanced": HERE.parent / "discrepancies" / "walks" / "balanced.csv"}


def robots():
    file = HERE / "robots.csv"
    return read_table(file) if file.exists() else []


def robots_but(group, seed):
    """The rows of robots.csv but those of a search, which are to be made anew."""
    return [row for row in robots() if (row["group"], row["seed"]) != (group, seed)]


def cells_of(phenotype):
    """Of the body, which the digits of a robot of the control begin with."""
    return sum(digit != "0" for digit in phenotype.partition("|")[0])


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


def add_random(source, group):
    """Each body once."""
    bodies = {}
    for row in read_table(source):
        if all(row[f"level_{level}_dx_m"] for level in LEVELS):
            bodies.setdefault(row["phenotype"], row)
    rows = [row_of(group, "2", row["individual"], body, {level: (row[f"level_{level}_dx_m"], row[f"level_{level}_dy_m"]) for level in LEVELS})
            for body, row in bodies.items()]
    add(rows, group, "2")


def add_champion(folder, group, seed):
    if group not in ALL_EVOLVED:
        raise InputError(f"{group}: must be one of {', '.join(ALL_EVOLVED)}")
    ends_m = {}
    for level in LEVELS_OF.get(group, LEVELS):
        result = read_toml(folder / f"level_{level}" / "result.toml")
        if "displacement_m" in result:
            ends_m[level] = result["displacement_m"][:2]
    last = read_table(folder / "lineage.csv")[-1]
    add([row_of(group, seed, last["individual"], last["phenotype"], ends_m)], group, seed)


def ends(rows, level):
    return np.array([[float(row.get(f"level_{level}_{axis}_m") or "nan") for axis in ("dx", "dy")] for row in rows])


def angle_and_factor(lower_m, upper_m):
    """Between the ways at two levels, whose body lengths differ threefold: the angle in degrees, and how many times as fast. Who went nowhere
    did not go the same way: the angle is 180 degrees."""
    angle = np.abs(np.degrees(np.arctan2(lower_m[:, 0] * upper_m[:, 1] - lower_m[:, 1] * upper_m[:, 0], np.sum(lower_m * upper_m, axis=1))))
    return np.where((lower_m == 0.0).all(axis=1) | (upper_m == 0.0).all(axis=1), 180.0, angle), np.hypot(*upper_m.T) / np.hypot(*lower_m.T) / 3.0


def that_move(rows, lower, upper):
    """The robots that move at the lower level and end their walks at both."""
    there = (np.hypot(*ends(rows, lower).T) >= LEAST_BODY_LENGTHS * CELL_EDGE_M * 3**lower) & ~np.isnan(ends(rows, upper)).any(axis=1)
    return [row for row, is_there in zip(rows, there) if is_there]


def ended(rows, lower, upper):
    """How many robots end their walks at both levels."""
    return int(np.sum(~np.isnan(np.hstack([ends(rows, level) for level in (lower, upper)])).any(axis=1)))


def moving(rows, lower, upper):
    """Their ends at two levels."""
    there = that_move(rows, lower, upper) if rows else []
    return (ends(there, lower), ends(there, upper)) if there else (np.empty((0, 2)), np.empty((0, 2)))


def same_way(angle_deg, _, largest_deg=LARGEST_ANGLE_DEG):
    return angle_deg <= largest_deg


def like_speed(_, factor, largest=LARGEST_FACTOR):
    return (factor >= 1.0 / largest) & (factor <= largest)


def carries_over(angle_deg, factor, largest_deg=LARGEST_ANGLE_DEG, largest=LARGEST_FACTOR):
    return same_way(angle_deg, factor, largest_deg) & like_speed(angle_deg, factor, largest)


MEASURES = {"carried_over": carries_over, "same_way": same_way, "like_speed": like_speed}


def of_all_pairs(lower_m, upper_m):
    """Each measure of the way of every robot (row) at the lower level with that of every one (column) at the upper one."""
    lower, upper = (index.ravel() for index in np.indices((len(lower_m), len(upper_m))))
    found = angle_and_factor(lower_m[lower], upper_m[upper])
    return {name: measure(*found).reshape(len(lower_m), len(upper_m)) for name, measure in MEASURES.items()}


def by_chance(pairs):
    """The shares where the way of each robot at the lower level is paired with that of every other one at the upper level.

    @param pairs what of_all_pairs gives"""
    return {name: float(np.mean(found[~np.eye(len(found), dtype=bool)])) for name, found in pairs.items()}


def body_lengths(ends_m, level):
    """How far robots get in a walk that ends there."""
    return np.hypot(*ends_m.T) / (CELL_EDGE_M * 3**level)


def fitness(rows):
    """The slower of the speeds at the two smallest levels, in body lengths of a walk: what selection at two scales sees."""
    return np.min([body_lengths(ends(rows, level), level) for level in LEVELS[:2]], axis=0)


def fastest(rows, count):
    """Of robots that walk at both levels, or none where there are not more than that."""
    speeds = fitness(rows)
    order = [number for number in np.argsort(-speeds, kind="stable") if np.isfinite(speeds[number])]
    return [rows[number] for number in order[:count]] if len(order) > count else []


def dimension(row):
    return float(np.log(cells_of(row["phenotype"])) / np.log(3.0))


def random_robots(group):
    """The random robots of this experiment, and those at two scales of another one that are not among them."""
    rows = [row for row in robots() if row["group"] == group]
    seen = {row["phenotype"] for row in rows}
    file = AT_TWO_SCALES[group]
    return rows + [row for row in (read_table(file) if file.exists() else []) if row["phenotype"] not in seen]


def groups():
    """The robots of each group. A random robot that is the champion of a search, too, counts as its champion alone: groups that are
    compared share no robot."""
    every = {group: [row for row in robots() if row["group"] == group] for group in GROUPS}
    for group, evolved in FAMILIES.items():
        champions = {row["phenotype"] for name in evolved for row in every[name]}
        every[group] = [row for row in random_robots(group) if row["phenotype"] not in champions]
    return {group: rows for group, rows in every.items() if rows}


def with_fastest(every):
    """The groups with their labels, and beside the random robots the fastest of them."""
    made = {}
    for group, rows in every.items():
        made[group] = (GROUPS[group], rows)
        if group in FAMILIES:
            made |= {f"{group}_{count}": (f"the fastest {count} {GROUPS[group]}", chosen) for count in FASTEST if (chosen := fastest(rows, count))}
    return made


def outcome(lower_m, upper_m):
    """Whether robots carry over, go the same way, go as fast, and how much faster they are, with intervals."""
    found = angle_and_factor(lower_m, upper_m)
    row = {"robots": len(lower_m)}
    for name, measure in MEASURES.items():
        row |= share(int(measure(*found).sum()), len(lower_m)).cells(name)
    return row | median(found[1]).cells("speed_factor")


def which_is_slower(rows, lower, upper):
    """Of the robots that move at either level: how many are slower at the larger one, and whether the speeds differ. Those that move at the
    smaller one are chosen for being fast there."""
    speeds = np.array([body_lengths(ends(rows, level), level) for level in (lower, upper)])
    small, large = speeds[:, np.isfinite(speeds).all(axis=0) & (np.fmax(*speeds) >= LEAST_BODY_LENGTHS)]
    slower = share(int(np.sum(large < small)), len(small))
    p = rank_sum(small, large)
    return {"moving_at_either": len(small)} | slower.cells("larger_is_slower") | {
            "larger_is_slower_outcome": OUTCOMES[verdict(slower, 0.5)], "p_scales": signed_rank(small, large), "p_scales_rank_sum": p,
            "no_difference_outcome": "not reproduced" if tells_apart(p) else "open",
            "smaller_per_minute": float(np.median(small)) * PER_MINUTE} | median(large * PER_MINUTE).cells("larger_per_minute")


def largest_is_the_slowest(sets):
    """Of the robots of each group that end their walks at all three levels, and move at one of them at least: how many are slowest at the
    largest one."""
    made = []
    for group, (label, rows) in sets.items():
        speeds = np.array([body_lengths(ends(rows, level), level) for level in LEVELS])
        speeds = speeds[:, np.isfinite(speeds).all(axis=0) & (np.fmax.reduce(speeds) >= LEAST_BODY_LENGTHS)]
        if speeds.shape[1]:
            slowest = share(int(np.sum(speeds[-1] < speeds[:-1].min(axis=0))), speeds.shape[1])
            row = {"group": group, "label": label, "robots": speeds.shape[1]} | slowest.cells("largest_is_slowest")
            row["largest_is_slowest_outcome"] = OUTCOMES[verdict(slowest, 0.5)]
            made.append({key: cell(value) for key, value in row.items()})
    return made


def statistics_of(group, label, rows, lower, upper):
    lower_m, upper_m = moving(rows, lower, upper)
    if len(lower_m) == 0:
        return None
    row = {"group": group, "levels": f"{lower} to {upper}", "label": label, "cells": f"{3**lower} to {3**upper}", "ended": ended(rows, lower, upper)} | outcome(lower_m, upper_m)
    pairs = of_all_pairs(lower_m, upper_m)
    chance = by_chance(pairs) if len(lower_m) > 1 else dict.fromkeys(MEASURES)
    speeds = fitness(that_move(rows, lower, upper))
    row["fitness_per_minute"] = float(np.nanmedian(speeds)) * PER_MINUTE if np.isfinite(speeds).any() else None
    row |= {"by_chance": chance["carried_over"], "same_way_by_chance": chance["same_way"], "like_speed_by_chance": chance["like_speed"],
            "p_by_chance": pairing_p(pairs["carried_over"])}
    others = share(len(lower_m) - int(carries_over(*angle_and_factor(lower_m, upper_m)).sum()), len(lower_m))
    row["most_differ_outcome"] = OUTCOMES[verdict(others, 0.5)]  # whether fewer than half carry over
    farther = share(int((3.0 * angle_and_factor(lower_m, upper_m)[1] > 1.0).sum()), len(lower_m))  # in metres
    row |= farther.cells("larger_is_farther") | {"larger_is_farther_outcome": OUTCOMES[verdict(farther, 0.5)]}
    row |= which_is_slower(rows, lower, upper)
    return {key: cell(value) for key, value in row.items()}


def by_chance_twice(first, second):
    """How often three different robots match: the way of one at the lowest level that of the second at the middle one, and that of the second that
    of the third at the highest. None of fewer than three.

    @param first, second what of_all_pairs gives for both steps"""
    others = ~np.eye(len(first), dtype=bool)
    first, second = first & others, second & others
    number = len(first)
    return (first.sum(axis=0) @ second.sum(axis=1) - (first * second.T).sum()) / (number * (number - 1) * (number - 2)) if number > 2 else None


def at_all_scales(sets):
    """Of the robots of each group that move at the two smallest levels and end their walks at all three: how many carry over at both steps, and
    whether more do than by chance."""
    made = []
    for group, (label, rows) in sets.items():
        there = that_move(that_move(rows, *LEVELS[:2]), *LEVELS[1:])
        if there:
            steps = [of_all_pairs(ends(there, lower), ends(there, lower + 1))["carried_over"] for lower in LEVELS[:-1]]
            found = share(int(np.logical_and(*(step.diagonal() for step in steps)).sum()), len(there))
            chance, p = by_chance_twice(*steps), pairing_p(*steps)
            row = {"group": group, "label": label, "robots": len(there)} | found.cells("carried_over") | {"by_chance": chance, "p_by_chance": p}
            row["found_outcome"] = "reproduced" if tells_apart(p) and found.value > chance else "open"
            made.append({key: cell(value) for key, value in row.items()})
    return made


def body_but_for_symmetry(phenotype):
    """The digits of a body, the smallest of those of all its mirror images and rotations about the vertical, which walk alike."""
    cells = np.array(list(phenotype), dtype=int).reshape(3, 3, 3)
    return min("".join(map(str, np.rot90(one, quarter, (1, 2)).flat)) for one in (cells, cells[:, :, ::-1]) for quarter in range(4))


def different_designs(every):
    """How many different bodies the searches of each group end with."""
    made = []
    for group in ALL_EVOLVED:
        bodies = [body_but_for_symmetry(row["phenotype"]) for row in every.get(group, []) if "|" not in row["phenotype"]]
        if len(bodies) > 1:
            made.append({"group": group, "label": GROUPS[group], "robots": str(len(bodies)), "different": str(len(set(bodies))), "outcome": "reproduced" if len(set(bodies)) > 1 else "not reproduced"})
    return made


def comparisons(every):
    """Evolved robots against random ones of the same physics, and against those that were selected at fewer scales: Fisher's exact tests,
    differences of shares, and how many of the others reach the fitness of the slowest. An outcome is open unless test and interval agree."""
    return [row for group, evolved in FAMILIES.items()
            for row in comparisons_within(with_fastest({name: every[name] for name in (group, *evolved) if name in every}), evolved)]


def comparisons_within(sets, evolved):
    rows = []
    for place, group in enumerate(evolved):
        if group not in sets:
            continue
        speeds = fitness(sets[group][1])
        slowest = float(np.nanmin(speeds)) if np.isfinite(speeds).any() else np.inf
        for other in [name for name in sets if name not in evolved[place:]]:
            for lower in LEVELS[:-1]:
                samples = [moving(sets[name][1], lower, lower + 1) for name in (group, other)]
                if not all(len(lower_m) for lower_m, _ in samples):
                    continue
                row = {"groups": f"{group} and {other}", "levels": f"{lower} to {lower + 1}", "robots": len(samples[0][0]), "other_robots": len(samples[1][0])}
                for name, measure in MEASURES.items():
                    counts = [number for sample in samples for number in (int(measure(*angle_and_factor(*sample)).sum()), len(sample[0]))]
                    more = difference_of_shares(*counts)
                    p = fisher(*counts)
                    row |= {f"p_{name}": p} | more.cells(f"more_{name}") | {f"more_{name}_outcome": OUTCOMES[verdict(more, 0.0) if tells_apart(p) else "open"]}
                row["as_fit_as_the_slowest"] = int(np.sum(fitness(sets[other][1]) >= slowest))
                rows.append({key: cell(value) for key, value in row.items()})
    return rows


def thresholds(every):
    """What carries over from 3 to 9 cells where other angles and speeds count as the same: the share of robots that are evolved at two
    scales, that of the fastest random ones, and Fisher's exact test of both."""
    made = []
    for family, evolved in FAMILIES.items():
        sets = with_fastest({family: every[family]}) if family in every else {}
        group, other = evolved[1], f"{family}_{FASTEST[0]}"
        if group not in every or other not in sets:
            continue
        samples = [angle_and_factor(*moving(rows, 1, 2)) for rows in (every[group], sets[other][1])]
        for largest_deg in ANGLES_DEG:
            for largest in FACTORS:
                counts = [(int(carries_over(*sample, largest_deg, largest).sum()), len(sample[0])) for sample in samples]
                shares = [share(*count) for count in counts]
                row = {"groups": f"{group} and {other}", "label": GROUPS[family].removeprefix("random robots").strip() or "the paper's simulator",
                       "angle_deg": largest_deg, "factor": largest, "robots": len(samples[0][0]), "other_robots": len(samples[1][0])}
                row |= shares[0].cells("carried_over") | shares[1].cells("other_carried_over") | {"p": fisher(*counts[0], *counts[1])}
                made.append({key: cell(value) for key, value in row.items()})
    return made


BINS = ((1.0, 1.8), (1.8, 2.2), (2.2, 2.5), (2.5, 2.8), (2.8, 3.01))


def by_dimension(rows, lower, upper):
    """The same share for random robots of similar Hausdorff dimension."""
    made = []
    for low, high in BINS:
        inside = [row for row in rows if low <= dimension(row) < high]
        found = statistics_of("random", GROUPS["random"], inside, lower, upper) if inside else None
        if found:
            made.append({"dimension_from": f"{low:g}", "dimension_to": f"{min(3.0, high):g}"} | {key: value for key, value in found.items() if key not in ("group", "label", "ended")})
    return made


def dimension_tests(rows):
    """Rank correlations of the Hausdorff dimension with the turn and with the change of speed, of all random robots that move."""
    made = []
    for lower in LEVELS[:-1]:
        there = that_move(rows, lower, lower + 1) if rows else []
        if len(there) < 3:
            continue
        angle, factor = angle_and_factor(ends(there, lower), ends(there, lower + 1))
        row = {"levels": f"{lower} to {lower + 1}", "cells": f"{3**lower} to {3 ** (lower + 1)}", "robots": len(there)}
        for name, values in (("angle", angle), ("speed", np.abs(np.log(np.maximum(factor, 1e-9))))):
            row |= spearman([dimension(one) for one in there], values).cells(f"{name}_spearman")
        made.append({key: cell(value) for key, value in row.items()})
    return made


def summary():
    every = groups()
    sets = with_fastest(every)
    rows = [found for group, (label, members) in sets.items() for lower in LEVELS[:-1] if (found := statistics_of(group, label, members, lower, lower + 1))]
    if not rows:
        raise InputError(f"{HERE / 'robots.csv'}: has no robot with two levels")
    write_table(HERE / "statistics.csv", list(rows[0]), rows)
    dimensions = by_dimension(every.get("random", []), 1, 2) + by_dimension(every.get("random", []), 2, 3)
    for name, of_table in (("all_scales", at_all_scales(sets)), ("slowest", largest_is_the_slowest(sets)), ("designs", different_designs(every)), ("comparisons", comparisons(every)),
                           ("thresholds", thresholds(every)), ("dimension_tests", dimension_tests(every.get("random", []))), ("dimension", dimensions)):
        if of_table:
            write_table(HERE / f"{name}.csv", list(of_table[0]), of_table)
    draw(every, rows, dimensions)


FEWEST_OF_GROUP, FEWEST_OF_DIMENSION = 9, 5  # robots, fewer of which tell nothing in a picture of shares
SIMULATORS = {"random": "paper's simulator", "random_balanced": "balanced beams"}  # of the families
STYLES = (("#666666", ".", 12), ("#E69F00", "s", 22), ("#0072B2", "o", 26), ("#CC79A7", "v", 26), ("#56B4E9", "^", 26), ("#D55E00", "D", 26))  # of random robots, then of evolved ones
LOWEST_FACTOR, HIGHEST_FACTOR = 1e-3, 20.0  # who nearly stops at 9 cells is drawn at the lowest; a higher one raises the limit to a power of ten


def draw_robots(panel, every, family):
    """Angle and factor of every robot of a family from 3 to 9 cells. Returns how many robots each style shows, and the largest factor."""
    counts, highest = [], 0.0
    for group, (colour, mark, size) in zip((family, *FAMILIES[family]), STYLES):
        angle, factor = angle_and_factor(*moving(every.get(group, []), 1, 2))
        panel.scatter(angle, np.maximum(factor, LOWEST_FACTOR), c=colour, marker=mark, s=size, zorder=2 if group == family else 3,
                      edgecolors="none" if group == family else "white", linewidths=0.5, clip_on=False)
        counts.append(len(angle))
        highest = max([highest, *factor])
    low, high = 1.0 / LARGEST_FACTOR, LARGEST_FACTOR
    panel.plot([0, LARGEST_ANGLE_DEG, LARGEST_ANGLE_DEG, 0], [low, low, high, high], "--", color="#222222", linewidth=1.2)
    panel.set(yscale="log", xlim=(-3, 183), xticks=range(0, 181, 45), xlabel="angle between the ways\nat 3 and 9 cells (degrees)")
    return counts, highest


def legend_below(figure, columns, handles, labels):
    """A legend of all panels below them."""
    share_of_height = (0.15 + 0.15 * -(-len(labels) // columns)) / figure.get_figheight()  # in inches: the frame and the rows
    figure.get_layout_engine().set(rect=(0.0, share_of_height, 1.0, 1.0 - share_of_height))
    figure.legend(handles, labels, loc="lower center", ncols=columns)


def draw_all_robots(pyplot, every):
    """A panel for each family, and one legend, which says how many robots of each group the panels show."""
    families = [family for family in FAMILIES if family in every]
    if not families:
        return
    figure, axes = pyplot.subplots(1, len(families), figsize=(6.5, 3.6), layout="constrained", sharey=True, squeeze=False)
    panels = axes[0]
    counts, highest = zip(*(draw_robots(panel, every, family) for panel, family in zip(panels, families)))
    top = max(highest)
    panels[0].set(ylim=(0.8 * LOWEST_FACTOR, HIGHEST_FACTOR if top <= HIGHEST_FACTOR else 10.0 ** np.ceil(np.log10(top))), ylabel="speed in body lengths at 9 cells\nper side over that at 3 (ratio)")
    letter_panels(zip(panels, (SIMULATORS[family] for family in families)))
    entries = [(handle, f"{GROUPS[group]} (n = {' and '.join(map(str, of_group))})")
               for handle, group, of_group in zip(panels[0].collections, ("random", *EVOLVED), zip_longest(*counts, fillvalue=0)) if any(of_group)]
    legend_below(figure, 2, *zip(*entries, (panels[0].lines[0], "in the box: carries over")))
    settle(figure)
    write_svg(figure, HERE / "scale_invariance.svg")


def draw_shares(panel, rows, names):
    """Three shares of each row with intervals, and a black tick behind each for what chance gives."""
    styles = {"carried_over": ("#0072B2", "o", "both: carries over"), "same_way": ("#D55E00", "D", "the same way"), "like_speed": ("#009E73", "s", "half to twice as fast")}
    chance_of = {"carried_over": "by_chance", "same_way": "same_way_by_chance", "like_speed": "like_speed_by_chance"}
    for shift, (name, (colour, mark, label)) in zip((-0.28, 0.0, 0.28), styles.items()):
        values, low, high = (np.array([100.0 * float(row[f"{name}{end}"]) for row in rows]) for end in ("", "_low", "_high"))
        places = np.arange(len(rows)) + shift
        panel.errorbar(values, places, xerr=(values - low, high - values), fmt=mark, color=colour, markersize=3.2, linewidth=1.2, label=label)
        panel.scatter([100.0 * float(row[chance_of[name]]) for row in rows], places, marker="|", s=60, linewidths=1.1, color="black", zorder=1.5,
                      label="by chance" if name == "like_speed" else None)
    for place in range(0, len(rows), 2):
        panel.axhspan(place - 0.5, place + 0.5, color="#f2f2f2", zorder=0)
    panel.set_yticks(range(len(rows)), names)
    panel.set(xlim=(-2, 102), ylim=(len(rows) - 0.5, -0.5))


def draw_all_shares(pyplot, rows, dimensions):
    """Panels of the groups of each family and of the dimensions, with one legend."""
    panels = []
    for family, evolved in FAMILIES.items():
        shown = [row for row in rows if row["group"] in {family, *evolved, *(f"{family}_{count}" for count in FASTEST)} and int(row["robots"]) >= FEWEST_OF_GROUP]
        names = [row["label"].removesuffix(f" {BALANCED}").removeprefix("the ").replace("random robots", "random") for row in shown]
        panels.append((shown, names, f"same at the next scale, {SIMULATORS[family]}"))
    shown = [row for row in dimensions if int(row["robots"]) >= FEWEST_OF_DIMENSION]
    panels.append((shown, [f"H from {row['dimension_from']} to {row['dimension_to']}" for row in shown], f"random robots by H, {SIMULATORS['random']}"))
    panels = [panel for panel in panels if panel[0]]
    if not panels:
        return
    heights = [0.3 + 0.25 * len(shown) for shown, _, _ in panels]
    figure, axes = pyplot.subplots(len(panels), 1, figsize=(6.5, 0.7 + sum(heights)), layout="constrained", height_ratios=heights, sharex=True, squeeze=False)
    axes = axes[:, 0]
    letter_panels(zip(axes, (title for _, _, title in panels)))
    for axis, (shown, names, _) in zip(axes, panels):
        axis.grid(visible=False, axis="y")
        draw_shares(axis, shown, [f"{name}, {row['cells']} cells (n = {row['robots']})" for name, row in zip(names, shown)])
    axes[-1].set_xlabel("share of robots with 95 % interval (%)")
    legend_below(figure, 4, *axes[-1].get_legend_handles_labels())
    settle(figure)
    write_svg(figure, HERE / "carried_over.svg")


def draw(every, rows, dimensions):
    """Angle and factor of every robot, and the shares by group and by dimension; readable where they are printed 6.5 inches wide."""
    pyplot = pyplot_for_svg()
    pyplot.rcParams |= {"font.size": 8, "legend.fontsize": 7.5}
    draw_all_robots(pyplot, every)
    draw_all_shares(pyplot, rows, dimensions)


def main(arguments):
    match arguments:
        case [group, source] if group in FAMILIES:
            add_random(pathlib.Path(source), group)
        case ["champion", folder, group, seed]:
            add_champion(pathlib.Path(folder), group, seed)
        case ["summary"]:
            summary()
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
