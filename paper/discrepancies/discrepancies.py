#!/usr/bin/python3
"""What the paper's text and its released code do differently, on one set of robots: their studies, and what follows from their walks.

discrepancies.py study VARIANT OUT.toml         writes the study of a variant
discrepancies.py take INDIVIDUALS.csv VARIANT   makes walks/VARIANT.csv of what menger export wrote
discrepancies.py summary                        makes statistics.csv, conclusions.csv and discrepancies.svg of the variants that there are

Exit codes: 0 done, 2 wrong input.
"""

import json
import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))

import numpy as np  # noqa: E402
from sample_statistics import bootstrap, rank_correlation, share, spearman  # noqa: E402
from small_tables import InputError, cell, read_table, read_toml, run_script, write_table, write_whole  # noqa: E402
from svg_figure import pyplot_for_svg, write_svg  # noqa: E402

ROBOTS = 500
LEVELS = (1, 2)
CELL_EDGE_M = 0.01
LEAST_BODY_LENGTHS = 0.1  # in 5 s; whoever goes less stands still, and has no way that could change
TEN = 10  # robots of which the best is chosen
GROUPS = 2000  # drawn groups of ten


def variants():
    return read_toml(HERE / "variants.toml")


def variant(name):
    found = variants().get(name)
    if found is None:
        raise InputError(f"{HERE / 'variants.toml'}: there is no variant {name}; there are {', '.join(variants())}")
    return found


def study_text(name):
    """population.toml with the keys of a variant."""
    study = read_toml(HERE / "population.toml")
    for table, keys in variant(name).get("keys", {}).items():
        study.setdefault(table, {}).update(keys)
    lines = [f"# {variant(name)['label']}: population.toml with what variants.toml says"]
    lines += [f"{key} = {json.dumps(value)}" for key, value in study.items() if not isinstance(value, dict)]
    for table, keys in study.items():
        if isinstance(keys, dict):
            lines += ["", f"[{table}]"] + [f"{key} = {json.dumps(value)}" for key, value in keys.items()]
    return "\n".join(lines) + "\n"


def first_of_each_body(rows):
    """The first 500 individuals whose bodies differ."""
    bodies = {}
    for row in rows:
        bodies.setdefault(row["phenotype"], row)
    chosen = list(bodies.values())[:ROBOTS]
    if len(chosen) < ROBOTS:
        raise InputError(f"only {len(chosen)} bodies differ, of {ROBOTS} that are wanted: more survivors in population.toml")
    return chosen


def take(source, name):
    """A table of where the robots of a variant end."""
    variant(name)
    rows = []
    for row in first_of_each_body(read_table(source)):
        ends = []
        for level in LEVELS:
            ends += [cell(float(end), 6) if end else "" for end in (row[f"level_{level}_dx_m"], row[f"level_{level}_dy_m"])]
        rows.append([row["individual"], row["phenotype"], *ends])
    write_table(HERE / "walks" / f"{name}.csv",
                ["individual", "phenotype"] + [f"level_{level}_{axis}_m" for level in LEVELS for axis in ("dx", "dy")], rows)


class Walks:
    """Where the robots of a variant end, in metres, by level; not a number where a walk failed."""

    def __init__(self, name):
        rows = read_table(HERE / "walks" / f"{variant(name).get('walks_of', name)}.csv")
        self.bodies = [row["phenotype"] for row in rows]
        self.ends_m = {level: np.array([[float(row[f"level_{level}_{axis}_m"] or "nan") for axis in ("dx", "dy")] for row in rows])
                       for level in LEVELS}
        self.score_of_level = SCORES[variant(name).get("score", "body_lengths")]

    def distances_m(self, level):
        return np.hypot(*self.ends_m[level].T)

    def body_lengths(self, level):
        return body_lengths(self.distances_m(level), level)

    def fitness(self):
        """The least score of all levels; a robot that fails at one ranks last."""
        scores = np.array([self.score_of_level(self.distances_m(level), level) for level in LEVELS])
        return np.where(np.isnan(scores).any(axis=0), -1.0, np.min(scores, axis=0))


def body_lengths(distance_m, level):
    return distance_m / (CELL_EDGE_M * 3**level)


SCORES = {"body_lengths": body_lengths, "squared_metres": lambda distance_m, level: distance_m**2 / 3**level}


def groups_of_ten(robots):
    draw = np.random.default_rng(1)
    return np.array([draw.choice(robots, TEN, replace=False) for _ in range(GROUPS)])


def share_with_another_best(first, second, groups):
    """In how many groups of robots another one is the best."""
    return float(np.mean(first[groups].argmax(axis=1) != second[groups].argmax(axis=1)))


def comparison(text, other):
    """A variant against the text. How far ends move is over the robots that move at this level as the text says."""
    fitness, changed = text.fitness(), other.fitness()
    ranks = spearman(fitness, changed)
    row = {"fitness_spearman": ranks.value, "fitness_spearman_low": ranks.low, "fitness_spearman_high": ranks.high}
    for level in LEVELS:
        row[f"level_{level}_spearman"] = rank_correlation(text.distances_m(level), other.distances_m(level))
        moves = text.body_lengths(level) >= LEAST_BODY_LENGTHS
        shift = np.hypot(*(other.ends_m[level] - text.ends_m[level])[moves].T) / text.distances_m(level)[moves]
        row[f"level_{level}_median_change"] = float(np.nanmedian(shift))
    groups = groups_of_ten(len(fitness))
    best = bootstrap(lambda a, b: share_with_another_best(a, b, groups), fitness, changed, paired=True)
    row |= {"another_best_of_ten": best.value, "another_best_of_ten_low": best.low, "another_best_of_ten_high": best.high}
    top = len(fitness) // 10
    row["best_tenth_in_common"] = len(set(np.argsort(-fitness)[:top]) & set(np.argsort(-changed)[:top])) / top
    return row


def conclusions(walks):
    """What of the paper's statements can be seen on random robots: which scale is slower, and by how much."""
    small, large = (walks.body_lengths(level) for level in LEVELS)
    best = np.minimum(small, large)
    moves = small >= LEAST_BODY_LENGTHS
    small, large = small[moves], large[moves]
    slower = share(int(np.sum(large < small)), len(small))
    factor = bootstrap(np.median, large / small)
    return {"moving": len(small), "larger_is_slower": slower.value, "larger_is_slower_low": slower.low, "larger_is_slower_high": slower.high,
            "speed_factor": factor.value, "speed_factor_low": factor.low, "speed_factor_high": factor.high,
            "best_body_lengths": float(np.nanmax(best)), "median_body_lengths": float(np.nanmedian(best))}


def summary():
    there = [name for name, one in variants().items() if (HERE / "walks" / f"{one.get('walks_of', name)}.csv").exists()]
    if "text" not in there:
        raise InputError(f"{HERE / 'walks' / 'text.csv'}: is not there: ./run paper discrepancies text")
    text = Walks("text")
    compared, concluded = [], []
    for name in there:
        walks = Walks(name)
        if walks.bodies != text.bodies:
            raise InputError(f"{HERE / 'walks' / name}.csv: has other robots than text.csv")
        about = {"variant": name, "label": variant(name)["label"], "robots": len(text.bodies)}
        concluded.append(about | conclusions(walks))
        if name != "text":
            compared.append(about | comparison(text, walks))
    for file, rows in (("statistics.csv", compared), ("conclusions.csv", concluded)):
        if rows:
            write_table(HERE / file, list(rows[0]), [[cell(value) for value in row.values()] for row in rows])
    if compared:
        draw(compared)


def draw(rows):
    """Points with intervals: how well ranks agree with the text's, and how often another robot is the best of ten."""
    pyplot = pyplot_for_svg()
    rows = sorted(rows, key=lambda row: row["fitness_spearman"])
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 1.0 + 0.4 * len(rows)), sharey=True, layout="constrained")
    places = range(len(rows))
    for panel, column, title, colour in ((axes[0], "fitness_spearman", "rank correlation of fitness with the text's", "#0072B2"),
                                         (axes[1], "another_best_of_ten", "share of tens with another best robot", "#D55E00")):
        values = [row[column] for row in rows]
        ends = [[value - row[column + "_low"] for value, row in zip(values, rows)], [row[column + "_high"] - value for value, row in zip(values, rows)]]
        panel.errorbar(values, places, xerr=ends, fmt="o", color=colour, capsize=3)
        panel.set_xlabel(f"{title}\n(95 % interval, {rows[0]['robots']} robots)")
        panel.set_xlim(min(0.0, *(row[column + "_low"] for row in rows)) - 0.02, 1.02)
        panel.set_ylim(-0.6, len(rows) - 0.4)
        panel.grid(axis="x", color="#dddddd")
    axes[0].set_yticks(places, [row["label"] for row in rows])
    write_svg(figure, HERE / "discrepancies.svg")


def main(arguments):
    match arguments:
        case ["study", name, out]:
            write_whole(pathlib.Path(out), study_text(name))
        case ["take", source, name]:
            take(pathlib.Path(source), name)
        case ["summary"]:
            summary()
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
