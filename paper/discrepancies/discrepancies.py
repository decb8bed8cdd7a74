#!/usr/bin/python3
"""What the paper's text and its released code do differently, on one set of robots: their studies, and what follows from their walks.

discrepancies.py study VARIANT OUT.toml         writes the study of a variant
discrepancies.py take INDIVIDUALS.csv VARIANT   makes walks/VARIANT.csv of what menger export wrote
discrepancies.py summary                        makes the tables and discrepancies.svg of the variants that there are:
                                                population.csv   how many robots there are, and how many of them are unlike
                                                statistics.csv   their fitness against that of the text
                                                released.csv     the text, without what it does not mention, too, against the code
                                                changes.csv      where robots end, by scale
                                                balanced_changes.csv  what a change does with balanced moments of beams, and what
                                                                      it does to the same robots with those of the simulator
                                                failures.csv     which walks failed
                                                conclusions.csv  what the paper concludes, by variant
                                                verdicts.csv     which of these conclusions a variant turns

Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys
from collections import Counter
from dataclasses import dataclass

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "scale_invariance")]

import numpy as np  # noqa: E402
from sample_statistics import OUTCOMES, bootstrap, difference_of_shares, mcnemar, median, rank_correlation, share, signed_rank, spearman, verdict  # noqa: E402
from scale_invariance import DURATION_S, angle_and_factor, by_chance, carries_over, of_all_pairs, same_way  # noqa: E402
from small_tables import InputError, cell, read_table, read_toml, run_script, toml_text, write_table, write_whole  # noqa: E402
from svg_figure import pyplot_for_svg, write_svg  # noqa: E402

ROBOTS = 500
CELL_EDGE_M = 0.01
LEAST_BODY_LENGTHS = 0.1  # in 5 s; whoever goes less stands still, and has no way that could change
TEN = 10  # robots of which the best is chosen
GROUPS = 2000  # drawn groups of ten
SPONGE_CELLS = (16, 19)  # those of a Hausdorff dimension of 2.5 to 2.7, as half of the paper's champions have
# What a variant is, in the order of tables and of the figure.
KINDS = {"difference": "the released code does otherwise", "omission": "the text does not mention it", "physics": "in both, beams spin bodies",
         "sensitivity": "sensitivity"}


def variants():
    return read_toml(HERE / "variants.toml")


def variant(name):
    found = variants().get(name)
    if found is None:
        raise InputError(f"{HERE / 'variants.toml'}: there is no variant {name}; there are {', '.join(variants())}")
    return found


def like(body):
    """A name that a body shares with those that differ from it by mirrors, quarter turns about the vertical, or the exchange of its materials."""
    cells = np.array([int(digit) for digit in body]).reshape(3, 3, 3)  # z, y, x
    turned = [np.rot90(one, quarter, axes=(1, 2)) for one in (cells, cells[:, :, ::-1]) for quarter in range(4)]
    return min("".join(map(str, order[one].ravel())) for one in turned for order in (np.array([0, 1, 2]), np.array([0, 2, 1])))


def duration_s(name):
    return float(variant(name).get("keys", {}).get("time", {}).get("duration_s", DURATION_S))


def cells_per_side(level):
    return 3**level


def study_text(name):
    """population.toml with the keys of a variant."""
    study = read_toml(HERE / "population.toml")
    for table, keys in variant(name).get("keys", {}).items():
        study.setdefault(table, {}).update(keys)
    return f"# {variant(name)['label']}: population.toml with what variants.toml says\n" + toml_text(study)


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
    """A table of where the robots of a variant end, and of how their walks ended, where the source tells."""
    variant(name)
    levels = read_toml(HERE / "population.toml")["body"]["levels"]
    chosen = first_of_each_body(read_table(source))
    columns = ["individual", "phenotype"]
    for level in levels:
        columns += [column for column in (f"level_{level}_status",) if column in chosen[0]] + [f"level_{level}_dx_m", f"level_{level}_dy_m"]
    rows = [{column: cell(float(row[column]), 6) if column.endswith("_m") and row[column] else row[column] for column in columns} for row in chosen]
    write_table(HERE / "walks" / f"{name}.csv", columns, rows)


class Walks:
    """Where the robots of a variant end, in metres, by level; not a number where a walk failed."""

    def __init__(self, name):
        self.file = HERE / "walks" / f"{variant(name).get('walks_of', name)}.csv"
        self.name = name
        rows = read_table(self.file)
        self.bodies = [row["phenotype"] for row in rows]
        self.levels = [int(column.split("_")[1]) for column in rows[0] if column.endswith("_dx_m")]
        self.ends_m = {level: np.array([[float(row[f"level_{level}_{axis}_m"] or "nan") for axis in ("dx", "dy")] for row in rows])
                       for level in self.levels}
        self.statuses = {level: [row.get(f"level_{level}_status") for row in rows] for level in self.levels}
        self.score_of_level = SCORES[variant(name).get("score", "body_lengths")]
        self.duration_s = duration_s(name)

    def distances_m(self, level):
        return np.hypot(*self.ends_m[level].T)

    def body_lengths(self, level):
        return body_lengths(self.distances_m(level), level)

    def moves(self, level):
        """Who goes as fast as a tenth of a body length in 5 s, however long the walk is."""
        return self.body_lengths(level) >= LEAST_BODY_LENGTHS * self.duration_s / DURATION_S

    def ended_at(self, level):
        return ~np.isnan(self.distances_m(level))

    def ended(self):
        """Who ended the walks at all levels."""
        return np.all([self.ended_at(level) for level in self.levels], axis=0)

    def scores(self):
        return np.array([self.score_of_level(self.distances_m(level), level) for level in self.levels])

    def fitness(self):
        """The least score of all levels; a robot that fails at one ranks last."""
        return np.where(self.ended(), np.min(self.scores(), axis=0), -1.0)

    def cells(self):
        return np.array([sum(digit != "0" for digit in body) for body in self.bodies])

    def has_two_materials(self):
        return np.array([{"1", "2"} <= set(body) for body in self.bodies])


def body_lengths(distance_m, level):
    return distance_m / (CELL_EDGE_M * cells_per_side(level))


SCORES = {"body_lengths": body_lengths, "squared_metres": lambda distance_m, level: distance_m**2 / cells_per_side(level)}


def known(value):
    """The number, or None where it is none."""
    return value if value is not None and np.isfinite(value) else None


def groups_of_ten(robots):
    draw = np.random.default_rng(1)
    return np.array([draw.choice(robots, TEN, replace=False) for _ in range(GROUPS)])


def share_with_another_best(first, second, groups):
    """In how many groups of robots another one is the best."""
    return float(np.mean(first[groups].argmax(axis=1) != second[groups].argmax(axis=1)))


def agreement(fitness, changed):
    """How well two fitnesses of the same robots agree."""
    row = spearman(fitness, changed).cells("fitness_spearman")
    if len(fitness) >= TEN:
        groups = groups_of_ten(len(fitness))
        row |= bootstrap(lambda a, b: share_with_another_best(a, b, groups), fitness, changed, paired=True).cells("another_best_of_ten")
    return row


def comparison(text, other):
    """The fitness of a variant against that of the text: of all robots, and of those that ended all walks of both."""
    fitness, changed = text.fitness(), other.fitness()
    ended = text.ended() & other.ended()
    everyone = agreement(fitness, changed)
    of_ended = everyone if ended.all() else agreement(fitness[ended], changed[ended])
    return {"failed": int(np.sum(~other.ended())), "ended": int(ended.sum())} | everyone | {f"ended_{key}": value for key, value in of_ended.items()}


def how_far_ends_move(before, after, level, robots):
    """The distance between two ends of a walk over the distance walked before the change."""
    return np.hypot(*(after.ends_m[level] - before.ends_m[level])[robots].T) / before.distances_m(level)[robots]


def distance_correlation(before, after, level):
    """Spearman's rank correlation of the distances of robots that end both walks, or None where there is none."""
    both = before.ended_at(level) & after.ended_at(level)
    return known(rank_correlation(before.distances_m(level)[both], after.distances_m(level)[both])) if both.sum() > 1 else None


def ninth_decile(sample, axis=-1):
    return np.quantile(sample, 0.9, axis=axis)


def change(text, other, level):
    """How far the ends of a variant are from those of the text, over the distance there: of robots that move there and end both walks."""
    both = text.ended_at(level) & other.ended_at(level)
    moving = both & text.moves(level)
    longest_m = np.nanmax(other.distances_m(level)) if other.ended_at(level).any() else None
    row = {"failed": int(np.sum(~other.ended_at(level))), "ended": int(both.sum()),
           "fastest_m_per_s": longest_m / other.duration_s if longest_m is not None else None, "moving": int(moving.sum()),
           "distance_spearman": distance_correlation(text, other, level)}
    if moving.any():
        end = how_far_ends_move(text, other, level, moving)
        factor = other.distances_m(level)[moving] / text.distances_m(level)[moving]
        for name, sample in (("end", end), ("distance", np.abs(factor - 1.0)), ("factor", factor)):
            row |= median(sample).cells(f"{name}_median") | bootstrap(ninth_decile, sample).cells(f"{name}_ninth_decile")
    return row


def failures(text, walks, level):
    """Robots whose walks failed, and the others: what their bodies are, and how far they go as the text says."""
    for outcome, chosen in (("failed", ~walks.ended_at(level)), ("ended", walks.ended_at(level))):
        statuses = Counter(status for status, here in zip(walks.statuses[level], chosen) if here)
        told = "; ".join(f"{count} {status}" for status, count in sorted(statuses.items())) if None not in statuses else "not kept"
        row = {"level": level, "outcome": outcome, "cells_per_side": cells_per_side(level), "robots": int(chosen.sum()), "statuses": told,
               "two_materials": int(np.sum(chosen & walks.has_two_materials()))}
        if chosen.any():
            row["cells_median"] = float(np.median(walks.cells()[chosen]))
            row |= median(text.body_lengths(level)[chosen & text.ended_at(level)]).cells("text_body_lengths")
        yield row


def judged(name, estimate, against):
    """The cells of an estimate, with a verdict on whether it is above what it would be by chance."""
    return estimate.cells(name) | {f"{name}_verdict": verdict(estimate, against)}


def from_scale_to_scale(walks, lower, upper):
    """What of the paper's statements random robots show from one scale to the next.

    Which scale is the slower one is asked of robots that move at either of them: those that move at the smaller one were chosen
    because they are fast there, so that by chance alone more than half of them would be slower at the larger one. Of those that move at
    both the share tells whether robots are slower, and not whether more of them stand still.
    """
    small, large = walks.body_lengths(lower), walks.body_lengths(upper)
    ended = walks.ended_at(lower) & walks.ended_at(upper)
    at_either = ended & (walks.moves(lower) | walks.moves(upper))
    moving = ended & walks.moves(lower)
    row = {"ended": int(ended.sum()), "moving_at_either": int(at_either.sum()), "moving": int(moving.sum())}
    if row["moving_at_either"] > 1:
        row |= judged("larger_is_slower", share(int(np.sum((large < small)[at_either])), row["moving_at_either"]), 0.5)
        row["larger_is_slower_outcome"] = OUTCOMES[row["larger_is_slower_verdict"]]
        with np.errstate(divide="ignore", invalid="ignore"):  # who does not move at all at the smaller scale is infinitely faster at the larger one
            row |= median(large[at_either] / small[at_either]).cells("speed_factor")
    at_both = moving & walks.moves(upper)
    row["moving_at_both"] = int(at_both.sum())
    if row["moving_at_both"] > 1:
        row |= share(int(np.sum((large < small)[at_both])), row["moving_at_both"]).cells("larger_is_slower_of_both")
        row |= median(large[at_both] / small[at_both]).cells("speed_factor_of_both")
    if row["moving"] > 1:
        ends_m = walks.ends_m[lower][moving], walks.ends_m[upper][moving]
        chance = by_chance(of_all_pairs(*ends_m))
        row |= {"carried_over_by_chance": chance["carried_over"], "same_way_by_chance": chance["same_way"]}
        changes = angle_and_factor(*ends_m)
        row |= share(int(np.sum(same_way(*changes))), row["moving"]).cells("same_way")
        row |= judged("carried_over", share(int(np.sum(carries_over(*changes))), row["moving"]), row["carried_over_by_chance"])
        row |= judged("scales_spearman", spearman(small[ended], large[ended]), 0.0)
    return row


def more_alike(text, walks, lower, upper):
    """Whether a variant changes who does the same at the larger scale, of robots that move at the smaller one in both: shares as the text
    says and with the variant, and McNemar's exact test."""
    both = np.all([one.ended_at(lower) & one.ended_at(upper) & one.moves(lower) for one in (text, walks)], axis=0)
    row = {"moving_in_both": int(both.sum())}
    if both.any():
        found = [angle_and_factor(one.ends_m[lower][both], one.ends_m[upper][both]) for one in (text, walks)]
        for name, measure in (("carried_over", carries_over), ("same_way", same_way)):
            of_text, of_variant = (measure(*one) for one in found)
            row |= share(int(of_text.sum()), len(of_text)).cells(f"in_both_text_{name}") | share(int(of_variant.sum()), len(of_text)).cells(f"in_both_{name}")
            row[f"p_{name}"] = mcnemar(of_text, of_variant)
    return row


def of_fitness(walks):
    """What fitness goes with: the Hausdorff dimension, and the scale that decides it."""
    ended = walks.ended()
    fitness, cells = walks.fitness()[ended], walks.cells()[ended]
    if len(fitness) < 2:
        return {}
    row = judged("dimension_spearman", spearman(np.log(cells) / np.log(3.0), fitness), 0.0)
    sponges = ((cells >= SPONGE_CELLS[0]) & (cells <= SPONGE_CELLS[1]))[np.argsort(-fitness, kind="stable")]
    tenth = max(1, len(fitness) // 10)
    best, others = (int(np.sum(part)) for part in (sponges[:tenth], sponges[tenth:]))
    row |= {"best_tenth_sponges": best / tenth, "other_sponges": others / (len(fitness) - tenth)}
    row |= judged("more_sponges", difference_of_shares(best, tenth, others, len(fitness) - tenth), 0.0)
    scores = walks.scores()[:, ended]
    row |= share(int(np.sum(scores[0] < np.min(scores[1:], axis=0))), len(fitness)).cells("smallest_scale_decides")
    least = np.min([walks.body_lengths(level)[ended] for level in walks.levels], axis=0) * 60.0 / walks.duration_s
    return row | {"best_body_lengths_per_minute": float(np.max(least)), "median_body_lengths_per_minute": float(np.median(least))}


@dataclass(frozen=True)
class Conclusion:
    """A statement that a column of conclusions.csv tests; `of_walks`: a variant of the score alone says nothing new of it."""

    label: str
    of_walks: bool


CONCLUSIONS = {
    "larger_is_slower": Conclusion("of the robots that move at either scale, more than half are slower at the larger one, in body lengths", True),
    "carried_over": Conclusion("more robots carry direction and speed over to the larger scale than by chance", True),
    "scales_spearman": Conclusion("who is fast at the smaller scale is fast at the larger one (rank correlation above 0)", True),
    "dimension_spearman": Conclusion("fitness rises with the Hausdorff dimension (rank correlation above 0)", False),
    "more_sponges": Conclusion("bodies of a dimension of 2.5 to 2.7 are more frequent among the best tenth than among the others (difference of shares)", False),
}


def verdicts(rows):
    """Of each conclusion, in how many variants its verdict is that of the text."""
    made = []
    for name, conclusion in CONCLUSIONS.items():
        # A correlation of numbers that are all equal is none, and has no verdict.
        shown = [row for row in rows if row.get(name) is not None and not (conclusion.of_walks and "walks_of" in variant(row["variant"]))]
        for pair in dict.fromkeys(row["levels"] for row in shown if row["variant"] == "text"):
            here = [row for row in shown if row["levels"] == pair]
            of_text = next(row[f"{name}_verdict"] for row in here if row["variant"] == "text")
            others = [row for row in here if row[f"{name}_verdict"] != of_text]
            sentence = f"{of_text} in all {len(here)} variants" if not others else f"{of_text} in {len(here) - len(others)} of {len(here)} variants"
            for other in dict.fromkeys(row[f"{name}_verdict"] for row in others):
                sentence += f". {other.capitalize()} with: " + "; ".join(row["label"] for row in others if row[f"{name}_verdict"] == other)
            made.append({"conclusion": name, "levels": pair, "label": conclusion.label, "variants": len(here), "text": of_text,
                         "as_text": len(here) - len(others), "lowest": min(row[name] for row in here), "highest": max(row[name] for row in here),
                         "sentence": sentence})
    return made


def write_rows(name, rows):
    """A table of rows, whose columns are those of the longest one; without rows the table goes."""
    if rows:
        columns = list(max(rows, key=len))
        write_table(HERE / name, columns, [[cell(row.get(column)) for column in columns] for row in rows])
    else:
        (HERE / name).unlink(missing_ok=True)


def against_released(there):
    """The fitness as the text says, with and without what it does not mention, against that of the released code."""
    if "released_walks" not in there:
        return []
    released = Walks("released_walks")
    return [{"variant": name, "label": variant(name)["label"], "robots": len(released.bodies)} | comparison(released, Walks(name))
            for name in there if name == "text" or variant(name).get("kind") == "omission"]


def kind_of(name):
    return KINDS.get(variant(name).get("kind"), "")


def with_both_beams(pairs, level):
    """What the same change does with the beams of the simulator and with balanced ones: how far ends move, of robots that move before the
    change and end all walks with both.

    @param pairs the walks before and after the change, with the beams of the simulator and with balanced ones"""
    robots = np.all([walks.ended_at(level) for pair in pairs for walks in pair] + [before.moves(level) for before, _ in pairs], axis=0)
    row = {"moving": int(robots.sum())}
    if robots.any():
        moved = [how_far_ends_move(before, after, level, robots) for before, after in pairs]
        for name, sample in zip(("published_end_median", "balanced_end_median"), moved):
            row |= median(sample).cells(name)
        row["p"] = signed_rank(*moved)
    return row | {f"{name}_spearman": distance_correlation(*pair, level) for name, pair in zip(("published", "balanced"), pairs)}


def of_balanced(name, text, there):
    """The rows of a variant that makes the change of another one to balanced beams."""
    other = variant(name).get("balanced_of")
    if not other or not {other, "balanced"} <= set(there):
        return []
    balanced, walks = Walks("balanced"), Walks(name)
    fitness_agreement = agreement(balanced.fitness(), walks.fitness())
    return [{"variant": name, "level": level, "cells_per_side": cells_per_side(level), "label": variant(other)["label"]}
            | with_both_beams(((text, Walks(other)), (balanced, walks)), level)
            | fitness_agreement for level in walks.levels]


def summary():
    there = [name for name, one in variants().items() if (HERE / "walks" / f"{one.get('walks_of', name)}.csv").exists()]
    if "text" not in there:
        raise InputError(f"{HERE / 'walks' / 'text.csv'}: is not there: ./run paper discrepancies text")
    text = Walks("text")
    compared, changed, balanced_changed, failed, concluded = [], [], [], [], []
    for name in there:
        walks = Walks(name)
        if (walks.bodies, walks.levels) != (text.bodies, text.levels):
            raise InputError(f"{walks.file}: has other robots or levels than text.csv")
        about = {"label": variant(name)["label"], "kind": kind_of(name), "robots": len(text.bodies)}
        for lower, upper in zip(walks.levels, walks.levels[1:]):
            pair = {"levels": f"{lower} to {upper}", "cells_per_side": f"{cells_per_side(lower)} to {cells_per_side(upper)}"}
            concluded.append({"variant": name} | pair | about | from_scale_to_scale(walks, lower, upper) | more_alike(text, walks, lower, upper) | of_fitness(walks))
        own = "walks_of" not in variant(name)
        if own:
            failed += [{"variant": name} | row | {"label": about["label"]} for level in walks.levels if not walks.ended_at(level).all()
                       for row in failures(text, walks, level)]
        if name != "text":
            compared.append({"variant": name} | about | comparison(text, walks))
            if (other := variant(name).get("failures_of")) in there:
                compared[-1]["failed_in_common"] = int(np.sum(~walks.ended() & ~Walks(other).ended()))
            if own:
                changed += [{"variant": name, "level": level, "cells_per_side": cells_per_side(level)} | about | change(text, walks, level)
                            for level in walks.levels]
            balanced_changed += of_balanced(name, text, there)
    unlike = len({like(body) for body in text.bodies})
    # Intervals take all robots as independent. Of as many groups of robots that walk alike they would be wider by the root of their mean size.
    population = [{"population": "all", "robots": len(text.bodies), "unlike": unlike, "wider": np.sqrt(len(text.bodies) / unlike) - 1.0}]
    for file, rows in (("population.csv", population), ("statistics.csv", compared), ("released.csv", against_released(there)), ("changes.csv", changed), ("balanced_changes.csv", balanced_changed),
                       ("failures.csv", failed), ("conclusions.csv", concluded), ("verdicts.csv", verdicts(concluded))):
        write_rows(file, rows)
    if compared:
        draw(compared)


def with_headings(rows):
    """The rows of a figure from the top, with their places, and the headings of their kinds between them."""
    places, headings, place = [], [], 0.0
    for number, row in enumerate(rows):
        if number == 0 or row["kind"] != rows[number - 1]["kind"]:
            place -= 0.35
            headings.append((place, row["kind"]))
            place -= 1.0
        second_line = 0.25 * row["label"].count(", ")  # labels break at commas
        places.append(place - second_line)
        place -= 1.0 + 2.0 * second_line
    return places, headings


def draw(rows):
    """How well fitness agrees with the text's, how often another robot is the best of ten, and how many walks fail."""
    pyplot = pyplot_for_svg()
    pyplot.rcParams.update({"font.size": 8})
    places, headings = with_headings(rows)
    bottom = min(places) - 0.7
    height = 1.15 - 0.2 * bottom  # in inches, as wide as a page is printed: type is 8 points there
    figure, axes = pyplot.subplots(1, 3, figsize=(6.5, height), sharey=True, width_ratios=(1.0, 1.0, 0.6))
    figure.subplots_adjust(left=0.31, right=0.985, bottom=0.82 / height, top=1.0 - 0.25 / height, wspace=0.12)
    for panel, column, title in ((axes[0], "fitness_spearman", "rank correlation of fitness\nwith that of the text"),
                                 (axes[1], "another_best_of_ten", "share of draws of ten\nwith another best robot")):
        for prefix, colour, mark, label, aside in (("", "#0072B2", "o", "all robots, failed ones last", 0.0),
                                                   ("ended_", "#D55E00", "D", "failed ones left out, where there are any", -0.32)):
            shown = [(row, place + aside) for row, place in zip(rows, places) if row.get(prefix + column) is not None and (not prefix or row["failed"])]
            if not shown:
                continue
            values = [row[prefix + column] for row, _ in shown]
            # An interval without ends is drawn as none.
            ends = [[row[f"{prefix}{column}_{end}"] for row, _ in shown] for end in ("low", "high")]
            spans = [[0.0 if end is None else abs(end - value) for end, value in zip(side, values)] for side in ends]
            panel.errorbar(values, [place for _, place in shown], xerr=spans, fmt=mark, color=colour, markersize=4, capsize=2, label=label)
        panel.set_xlabel(title)
        panel.set_xticks((0.0, 0.5, 1.0), ("0", "0.5", "1"))
        panel.set_xlim(min(0.0, *(row.get(f"{column}_low") or 0.0 for row in rows)) - 0.02, 1.02)
    axes[2].barh(places, [row["failed"] for row in rows], height=0.55, color="#666666")
    for row, place in zip(rows, places):
        axes[2].annotate(str(row["failed"]), (row["failed"], place), xytext=(2, 0), textcoords="offset points", va="center")
    axes[2].set_xlabel(f"failed walks\nof {rows[0]['robots']} robots")
    axes[2].set_xlim(0, 1.5 * max(10, *(row["failed"] for row in rows)))
    axes[0].set_ylim(bottom, 0.3)
    axes[0].set_yticks(places, [row["label"].replace(", ", ",\n") for row in rows])
    for place, kind in headings:
        axes[0].annotate(kind, (0, place), xytext=(-4, 0), xycoords=("axes fraction", "data"), textcoords="offset points", ha="right",
                         va="center", fontstyle="italic", annotation_clip=False)
        for panel in axes:
            panel.axhline(place, color="#bbbbbb", linewidth=0.6)
    for panel, letter in zip(axes, "abc"):
        panel.set_title(letter, loc="left", fontweight="bold", fontsize=9)
        panel.grid(axis="x", color="#dddddd")
        panel.set_axisbelow(True)
        panel.tick_params(axis="y", length=0)
    figure.legend(*axes[0].get_legend_handles_labels(), loc="lower center", ncols=2, frameon=False)
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
