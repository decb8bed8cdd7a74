#!/usr/bin/python3
"""What the proof needs besides menger: studies with their seed and budget, the tables of finished searches, and what follows from them.

proof.py study ARM SEED SIZE.toml OUT.toml    writes the study of a search, with the budget of SIZE.toml and cost.csv
proof.py judge NAME SIZE.toml OUT.toml        writes a study that robots walk by after a search: fine, elements, two_layers or dampings
proof.py number SIZE.toml KEY                 prints a value of SIZE.toml
proof.py level SIZE.toml                      prints the level of its bodies
proof.py missing TABLES SEED SIZE.toml        prints the arms of a seed, of those of SIZE.toml, that the tables lack
proof.py cost RESULTS                         makes cost.csv from two searches in RESULTS: voxels and elements
proof.py champions RESULTS ARM SEED           prints the individuals whose scores on elements progress.csv wants of a search on voxels
proof.py winner RESULTS ARM SEED              prints the individual that counts of a search on finite elements; nothing if none walks
proof.py untried TABLES                       prints, for each search on finite elements whose winner lacks a row in layers.csv or dampings.csv: its
                                              arm, its seed, a generation by whose end the search has met the winner, and the winner
proof.py again RESULTS TABLES ARM SEED        adds such a winner, which walked again, to layers.csv and dampings.csv
proof.py take RESULTS TABLES ARM SEED         adds a finished search to outcomes.csv, progress.csv, walks.csv, and where there are any, to
                                              layers.csv, dampings.csv and screening.csv
proof.py summary TABLES                       makes statistics.csv, first.csv, by_friction.csv, layer_statistics.csv, damping_statistics.csv,
                                              screened.csv and proof.svg

A score is the displacement in a period of the drive, in body lengths, in the worst of three frictions. A robot without a score does not
walk: it counts as 0. Exit codes: 0 done, 2 wrong input.
"""

import contextlib
import itertools
import math
import os
import pathlib
import random
import re
import sqlite3
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "known_walks")]

from chart_of_walks import HEIGHT, INK, WIDTH, Panel, words  # noqa: E402
from multiple_tests import holm  # noqa: E402
from small_tables import InputError, read_table, read_toml, write_table, write_whole  # noqa: E402
from statistics_of_walks import angle_deg, median, quantile  # noqa: E402

ARMS = ("voxels", "elements", "both", "voxels_robust")  # seeds follow from their order: new ones come last
NAMES = {"voxels": "voxels at one friction", "elements": "finite elements", "both": "elements, voxels screen",
         "voxels_robust": "voxels in three frictions"}
SHORT_NAMES = {"voxels": "voxels", "elements": "elements", "both": "both", "voxels_robust": "voxels, 3"}
STYLES = {"voxels": ("#D55E00", "triangle"), "elements": ("#0072B2", "circle"), "both": ("#009E73", "diamond"),
          "voxels_robust": ("#CC79A7", "square")}
JUDGES = ("fine", "elements", "two_layers", "dampings")  # studies that robots walk by after a search
OF_VOXELS = ("voxels", "voxels_robust")  # arms whose scores are not those of finite elements
ON_ELEMENTS = tuple(arm for arm in ARMS if arm not in OF_VOXELS)
# Those that were planned before the searches, and those that were added when robots of voxels turned out to fail at other frictions.
COMPARISONS = ((("elements", "voxels"), ("both", "voxels"), ("both", "elements")),
               (("elements", "voxels_robust"), ("both", "voxels_robust"), ("voxels_robust", "voxels")))
CORES = 2  # of which size.toml speaks
LEAST_SEARCHES = 5  # of an arm that is compared: fewer say nothing
RESAMPLES = 10000
MOST_ARRANGEMENTS = 2_000_000  # that an exact rank-sum test counts; eleven seeds have 705432
GRID = 60  # costs at which lines of progress are drawn
CHAMPIONS = 40  # costs at which the champion of a search on voxels walks on elements: it has more than a thousand

OUTCOMES = ["arm", "seed", "budget_element_steps", "voxel_steps_per_element_step", "cost_element_steps", "generations", "evaluations", "search_body_lengths", "individual",
            "design", "cells", "phenotype", "first_body_lengths", "best_body_lengths", "reason"]
PROGRESS = ["arm", "seed", "generation", "cost_element_steps", "champion", "body_lengths"]


def number(value):
    return "" if value is None else f"{value:.6g}"


def value(text):
    return float(text) if text else None


def costs():
    return {row["what"]: float(row["value"]) for row in read_table(HERE / "cost.csv")}


def budget_element_steps(size):
    return size["minutes_of_two_cores"] * 60.0 * CORES / (1e-9 * costs()["nanoseconds_per_element_step"])


def text_with_bodies(name, size):
    """The text of a study with the bodies of a size: single modules, unless it has levels and largest_body_cells."""
    text = (HERE / f"{name}.toml").read_text(encoding="utf-8")
    if "levels" not in size:
        return text
    text, count = re.subn(r"^levels = \[1\]$", f"levels = {size['levels']}\nlargest_body_cells = {size['largest_body_cells']}", text,
                          flags=re.MULTILINE)
    if count != 1:
        raise InputError(f"{HERE / name}.toml: has not one line with levels = [1]")
    return text


def study_text(arm, seed, size, folder):
    """The study of an arm with a seed and a budget, for a file in a folder."""
    text = text_with_bodies(arm, size)
    # Seeds of their own: with the same one, the first robots of two arms would be the same, and their outcomes would not be independent.
    values = {"seed": 1000 * ARMS.index(arm) + seed} | {key: size[key] for key in ("generations", "survivors", "mutants") if key in size}
    for key, new in values.items():
        text, count = re.subn(rf"^{key} = \d+$", f"{key} = {new}", text, flags=re.MULTILINE)
        if count != 1:
            raise InputError(f"{HERE / arm}.toml: has not one line with {key}")
    text = re.sub(r'^parameters = "(.*)"$', lambda found: f'parameters = "{os.path.relpath(HERE / found[1], folder)}"', text,
                  flags=re.MULTILINE)
    budget = f"\n[budget]\nelement_steps = {budget_element_steps(size):.6g}\n"
    if "[surrogate]" in text:
        budget += f"voxel_steps_per_element_step = {costs()['voxel_steps_per_element_step']:.4g}\n"
    return text + budget


def cost_rows(results):
    """What a step costs, from the wall times of evaluations of two searches on one thread."""
    nanoseconds = {}
    for arm, steps in (("voxels", "voxel_steps"), ("elements", "element_steps")):
        seconds = sum(float(row["seconds"]) for row in read_table(results / arm / "timings.csv"))
        count = sum(float(row[steps]) for row in read_table(results / arm / "costs.csv"))
        nanoseconds[arm] = 1e9 * seconds / count
    return [{"what": "nanoseconds_per_element_step", "value": number(nanoseconds["elements"])},
            {"what": "nanoseconds_per_voxel_step", "value": number(nanoseconds["voxels"])},
            {"what": "voxel_steps_per_element_step", "value": number(nanoseconds["elements"] / nanoseconds["voxels"])}]


def budget_in(study):
    return read_toml(study)["budget"]


def robots_of(rows):
    """The robots of a table of menger confirm, {rank: rows of its scenarios}."""
    robots = {}
    for row in rows:
        robots.setdefault(int(row["rank"]), []).append(row)
    return robots


def score(rows):
    return value(rows[0]["score_body_lengths"]) or 0.0


def judged_robots(results, arm, seed):
    """The robots of a finished search that walked on fine elements, as robots_of has them."""
    return robots_of(read_table(results / f"{arm}_{seed}.fine.csv"))


def best_of(robots):
    """The rows of the best robot; None without robots."""
    return max(robots.values(), key=score, default=None)


def winner_of(robots):
    """The rows of the best robot if it walks; None otherwise."""
    best = best_of(robots)
    return best if best and score(best) else None


def outcome_of(results, arm, seed):
    """The row of a finished search: its best robot on fine elements, of those that were judged."""
    name = f"{arm}_{seed}"
    budget = budget_in(results / "studies" / f"{name}.toml")
    generations = read_table(results / name / "generations.csv")
    judged = judged_robots(results, arm, seed)
    best = best_of(judged)
    row = {"arm": arm, "seed": seed, "budget_element_steps": number(budget["element_steps"]),
           "voxel_steps_per_element_step": number(budget.get("voxel_steps_per_element_step")),
           "cost_element_steps": number(summed_costs(results / name, budget)[-1]), "generations": len(generations) - 1,
           "evaluations": sum(int(one["evaluations"]) for one in generations), "search_body_lengths": generations[-1]["best_fitness_body_lengths"],
           "first_body_lengths": number(score(judged[1]) if judged else 0.0), "best_body_lengths": number(score(best) if best else 0.0)}
    if best:
        row |= {"individual": best[0]["individual"], "design": best[0]["design"], "cells": best[0]["cells"],
                "phenotype": best[0]["phenotype"], "reason": next((one["reason"] for one in best if one["reason"]), "")}
    return row


def summed_costs(folder, budget):
    ratio = budget.get("voxel_steps_per_element_step", 1.0)  # without voxels it does not matter
    return list(itertools.accumulate(float(row["element_steps"]) + float(row["voxel_steps"]) / ratio
                                     for row in read_table(folder / "costs.csv")))


def champions_of(results, arm, seed):
    """(generation, cost by then, individual, fitness) wherever a search has another champion."""
    name = f"{arm}_{seed}"
    cost = summed_costs(results / name, budget_in(results / "studies" / f"{name}.toml"))
    before = ""
    for n, row in enumerate(read_table(results / name / "generations.csv")):
        if row["champion"] and row["champion"] != before:
            before = row["champion"]
            yield n, cost[n], before, row["best_fitness_body_lengths"]


def drawn_champions(champions):
    """Those of the champions that lead a search at CHAMPIONS costs, evenly apart on a logarithmic axis, the first and the last among them."""
    if not champions:
        return []
    least, most = champions[0][1], champions[-1][1]
    wanted = [least * (most / least) ** (n / (CHAMPIONS - 1)) for n in range(CHAMPIONS - 1)] + [most]
    places = {max(k for k, one in enumerate(champions) if one[1] <= cost) for cost in wanted}
    return [champions[k] for k in sorted(places)]


def progress_of(results, arm, seed):
    """Rows where a search has another champion: its score on draft elements, and what the search has cost by then."""
    champions = list(champions_of(results, arm, seed))
    judged, by_fitness = {}, {}
    if arm in OF_VOXELS:  # they have no such score of their own
        champions = drawn_champions(champions)
        for rows in robots_of(read_table(results / f"{arm}_{seed}.champions.csv")).values():
            judged[rows[0]["individual"]] = score(rows)
            by_fitness[rows[0].get("fitness_body_lengths")] = score(rows)
    for n, cost, champion, fitness in champions:
        # Of champions with one body, which have one fitness, the first alone walks on elements.
        found = judged.get(champion, by_fitness.get(fitness)) if arm in OF_VOXELS else float(fitness)
        if found is None:
            raise InputError(f"{results}/{arm}_{seed}.champions.csv: has no row of individual {champion}")
        yield {"arm": arm, "seed": seed, "generation": n, "cost_element_steps": number(cost), "champion": champion, "body_lengths": number(found)}


def is_of(row, arm, seed):
    return row["arm"] == arm and row["seed"] == str(seed)


def sorted_rows(rows):
    return sorted(rows, key=lambda row: (ARMS.index(row["arm"]), int(row["seed"]), int(row.get("generation") or 0)))


def add_rows(file, columns, arm, seed, new):
    old = read_table(file) if file.exists() else []
    kept = [row for row in old if not is_of(row, arm, seed)]
    write_table(file, columns, sorted_rows([*kept, *({key: str(text) for key, text in row.items()} for row in new)]))


def outcomes_by_arm(tables, column="best_body_lengths"):
    """The scores of the searches of each arm: of the best of the robots that were judged, or of the search's own first."""
    rows = read_table(tables / "outcomes.csv")
    # Budgets follow from size.toml and cost.csv: searches from before one of them was changed had another cost.
    for cost in ("budget_element_steps", "voxel_steps_per_element_step"):
        values = {row[cost] for row in rows} - {""}
        if len(values) > 1:
            raise InputError(f"{tables}/outcomes.csv: {cost}: searches of different cost are not compared: {', '.join(sorted(values))}")
    return {arm: [float(row[column]) for row in rows if row["arm"] == arm] for arm in ARMS}


def rank_sum_p(a, b):
    """The two-sided p of Wilcoxon's rank-sum test, exact also with equal values: the share of all arrangements of the values in two
    groups of these sizes whose rank sum is at least as far from its mean. None for an empty group."""
    if not a or not b:
        return None
    if math.comb(len(a) + len(b), len(a)) > MOST_ARRANGEMENTS:
        raise InputError(f"{len(a)} and {len(b)} searches: an exact rank-sum test takes eleven of each at most")
    ordered = sorted([*a, *b])
    # twice the mid-ranks, which are whole
    ranks = {x: 2 * ordered.index(x) + ordered.count(x) + 1 for x in set(ordered)}
    everyone = [ranks[x] for x in ordered]
    mean = len(a) * (len(ordered) + 1)
    found = abs(sum(ranks[x] for x in a) - mean)
    far = sum(abs(sum(group) - mean) >= found for group in itertools.combinations(everyone, len(a)))
    return far / math.comb(len(ordered), len(a))


def superiority(a, b):
    """The chance that one of a is larger than one of b; equal ones count half (Vargha and Delaney's A)."""
    return sum((x > y) + 0.5 * (x == y) for x in a for y in b) / (len(a) * len(b))


def interval_of_two(a, b, statistic):
    """The 95 % interval of a statistic of two groups, by a bootstrap over both; (None, None) where all resamples have one value. The
    same values give the same interval."""
    draw = random.Random(1)
    found = [statistic(draw.choices(a, k=len(a)), draw.choices(b, k=len(b))) for _ in range(RESAMPLES)]
    if min(found) == max(found):  # groups apart from each other: resampling does not tell how far the value is known
        return None, None
    return quantile(found, 0.025), quantile(found, 0.975)


def difference_of_medians(a, b):
    return median(a) - median(b)


STATISTICS = ["arm", "than", "searches", "searches_than", "median_body_lengths", "median_than_body_lengths", "difference_body_lengths",
              "difference_low", "difference_high", "superiority", "superiority_low", "superiority_high", "rank_sum_p", "holm_p"]


def statistics_rows(outcomes):
    """The comparisons of arms of which there are searches enough, corrected for those that were planned at once: the first ones, and
    those that were added later."""
    for pairs in COMPARISONS:
        rows = [compared_arms(outcomes, arm, than) for arm, than in pairs]
        for row, p in zip(rows, holm([row and row["rank_sum_p"] for row in rows])):
            if row:
                yield row | {"rank_sum_p": number(row["rank_sum_p"]), "holm_p": number(p)}


def compared_arms(outcomes, arm, than):
    """The row of a comparison, with p as a number; None where an arm has too few searches."""
    a, b = outcomes[arm], outcomes[than]
    if min(len(a), len(b)) < LEAST_SEARCHES:
        return None
    (low, high), (least, most) = (interval_of_two(a, b, statistic) for statistic in (difference_of_medians, superiority))
    return {"arm": arm, "than": than, "searches": len(a), "searches_than": len(b),
            "median_body_lengths": number(median(a)), "median_than_body_lengths": number(median(b)),
            "difference_body_lengths": number(difference_of_medians(a, b)), "difference_low": number(low),
            "difference_high": number(high), "superiority": number(superiority(a, b)), "superiority_low": number(least),
            "superiority_high": number(most), "rank_sum_p": rank_sum_p(a, b)}


def write_comparisons(file, outcomes):
    """A table of the comparisons that there are; none where every arm has too few searches."""
    rows = list(statistics_rows(outcomes))
    if rows:
        write_table(file, STATISTICS, rows)
    else:
        file.unlink(missing_ok=True)


def untried_winners(tables):
    """Of each search on finite elements whose winner has not walked on two layers or at other dampings: arm, seed, generation and
    winner. Individuals are numbered as they are met, so a search that has a champion of the winner's number or a later one has met it."""
    tried = [read_table(tables / name) if (tables / name).exists() else [] for name in ("layers.csv", "dampings.csv")]
    progress = read_table(tables / "progress.csv")
    for row in read_table(tables / "outcomes.csv"):
        if row["arm"] not in ON_ELEMENTS or not row["individual"] or not value(row["best_body_lengths"]):
            continue
        if all(any(is_of(one, row["arm"], row["seed"]) for one in table) for table in tried):
            continue
        of_search = [one for one in progress if is_of(one, row["arm"], row["seed"])]
        generations = [int(one["generation"]) for one in of_search if int(one["champion"]) >= int(row["individual"])]
        yield row["arm"], row["seed"], min(generations) if generations else int(row["generations"]), row["individual"]


def check_is_winner(results, tables, arm, seed):
    """@throws InputError unless the robot that walked again is the one that the tables have as the winner, and walks alike on fine
    elements."""
    winner = winner_of(judged_robots(results, arm, seed))
    outcome = next((row for row in read_table(tables / "outcomes.csv") if is_of(row, arm, seed)), None)
    found = winner and (winner[0]["individual"], winner[0]["design"], number(score(winner)))
    if outcome is None or found != tuple(outcome[key] for key in ("individual", "design", "best_body_lengths")):
        raise InputError(f"{results}/{arm}_{seed}.fine.csv: its best robot is not the winner in {tables}/outcomes.csv, or walks otherwise")


LAYERS = ["arm", "seed", "individual", "one_body_lengths", "two_body_lengths", "ratio", "angle_deg", "reason"]


def layers_of(results, arm, seed):
    """The winner of a search at the friction of two_layers.toml, on one layer of fine elements and on two layers. Nothing where no robot
    walks. A walk that failed on two layers has no ratio and no angle, and the reason."""
    winner = winner_of(judged_robots(results, arm, seed))
    if not winner:
        return
    file = results / f"{arm}_{seed}.layers.csv"
    two = next((row for row in read_table(file) if row["individual"] == winner[0]["individual"]), None)
    one = next((row for row in winner if two and row["friction"] == two["friction"]), None)
    if one is None:
        raise InputError(f"{file}: has no walk of individual {winner[0]['individual']} at a friction of {arm}_{seed}.fine.csv")
    row = {"arm": arm, "seed": seed, "individual": one["individual"], "one_body_lengths": one["body_lengths"],
           "two_body_lengths": two["body_lengths"], "reason": two["reason"]}
    if not two["reason"]:
        ways = [(float(found["dx_m"]), float(found["dy_m"])) for found in (one, two)]
        row |= {"ratio": number(float(two["body_lengths"]) / float(one["body_lengths"])), "angle_deg": number(angle_deg(*ways))}
    yield row


DAMPINGS = ["arm", "seed", "individual", "loss_factor", "body_lengths"]


def dampings_of(results, arm, seed):
    """The winner of a search in the worst friction at each damping: that of fine.toml, and those of dampings.toml. A walk that ended
    early or fell counts as 0. Nothing where no robot walks."""
    winner = winner_of(judged_robots(results, arm, seed))
    if not winner:
        return
    individual, worst = winner[0]["individual"], {}
    for row in [*winner, *read_table(results / f"{arm}_{seed}.dampings.csv")]:
        if row["individual"] == individual:
            lengths = 0.0 if row["reason"] else float(row["body_lengths"])
            worst[row["loss_factor"]] = min(lengths, worst.get(row["loss_factor"], math.inf))
    if len(worst) < 2:
        raise InputError(f"{results}/{arm}_{seed}.dampings.csv: has no walk of individual {individual}")
    for loss_factor in sorted(worst, key=float):
        yield {"arm": arm, "seed": seed, "individual": individual, "loss_factor": loss_factor, "body_lengths": number(worst[loss_factor])}


DAMPING_STATISTICS = ["arm", "winners", "walking", "smallest_ratio", "median_ratio"]


def damping_statistics_rows(dampings):
    """Of each arm: its winners that were tried at several dampings, those that walk at all of them, and the slowest speed of a winner
    by its fastest: the least, and the median."""
    for arm in ON_ELEMENTS:
        speeds = {}
        for row in dampings:
            if row["arm"] == arm:
                speeds.setdefault(row["seed"], []).append(float(row["body_lengths"]))
        if speeds:
            ratios = [min(of_one) / max(of_one) for of_one in speeds.values()]
            yield {"arm": arm, "winners": len(speeds), "walking": sum(ratio > 0.0 for ratio in ratios), "smallest_ratio": number(min(ratios)),
                   "median_ratio": number(median(ratios))}


LAYER_STATISTICS = ["arm", "winners", "walking", "same_way", "smallest_ratio", "largest_ratio", "speed_ratio", "relative_speed_difference"]
SAME_WAY_DEG = 45.0


def layer_statistics_rows(layers):
    """Of each arm: its winners that were tried on two layers, those that walk there, those that go the same way within 45 degrees, and
    of those that walk the least and the largest ratio of both speeds, its median, and the median of its distance from 1."""
    for arm in ON_ELEMENTS:
        of_arm = [row for row in layers if row["arm"] == arm]
        if not of_arm:
            continue
        ratios = [float(row["ratio"]) for row in of_arm if row["ratio"]]
        yield {"arm": arm, "winners": len(of_arm), "walking": len(ratios),
               "same_way": sum(float(row["angle_deg"]) <= SAME_WAY_DEG for row in of_arm if row["angle_deg"]),
               "smallest_ratio": number(min(ratios)) if ratios else "", "largest_ratio": number(max(ratios)) if ratios else "",
               "speed_ratio": number(median(ratios)) if ratios else "",
               "relative_speed_difference": number(median([abs(ratio - 1.0) for ratio in ratios])) if ratios else ""}


SCREENING = ["arm", "seed", "passed", "drawn", "left_out", "passed_and_survive", "drawn_and_survive"]


def screening_of(results, arm, seed):
    """What the voxels of a search did to its new robots after the first generation: how many passed and walked on finite elements, how
    many of the others were drawn and walked all the same, how many were left out; and of those that walked, how many survived the
    generation in which they were new. Nothing where nothing was screened."""
    archive = results / f"{arm}_{seed}.sqlite"
    if arm != "both" or not archive.exists():
        return
    with contextlib.closing(sqlite3.connect(f"file:{archive}?mode=ro", uri=True)) as connection:
        found = {outcome: (robots, survivors) for outcome, robots, survivors in connection.execute(
            "SELECT outcome, COUNT(*), COUNT(survivor_rank) FROM screening JOIN contender USING (id, generation) "
            "WHERE generation > 0 GROUP BY outcome")}
    passed, drawn, left_out = (found.get(outcome, (0, 0)) for outcome in ("passed", "drawn", "left out"))
    yield {"arm": arm, "seed": seed, "passed": passed[0], "drawn": drawn[0], "left_out": left_out[0], "passed_and_survive": passed[1],
           "drawn_and_survive": drawn[1]}


SCREENED = ["arm", "searches", "new_robots", "rejected_share", "rejected_least", "rejected_largest", "left_out_share", "passed",
            "passed_survive_share", "drawn", "drawn_survive_share", "drawn_survive_least", "drawn_survive_largest", "survive_ratio"]


def screened_row(rows):
    """All searches of screening.csv together: the share of new robots that voxels rejected (left out, or drawn and walked all the same)
    and the share that never walked; of those that walked the share that survived the generation in which they were new, of robots that
    passed and of rejected ones that were drawn, and the second by the first. Least and largest are of single searches."""
    counts = [{key: int(row[key]) for key in SCREENING[2:]} for row in rows]
    total = {key: sum(one[key] for one in counts) for key in SCREENING[2:]}

    def new(one):
        return one["passed"] + one["drawn"] + one["left_out"]

    rejected = [(one["drawn"] + one["left_out"]) / new(one) for one in counts]
    row = {"arm": "both", "searches": len(counts), "new_robots": new(total), "rejected_share": number((total["drawn"] + total["left_out"]) / new(total)),
           "rejected_least": number(min(rejected)), "rejected_largest": number(max(rejected)), "left_out_share": number(total["left_out"] / new(total)),
           "passed": total["passed"], "passed_survive_share": number(total["passed_and_survive"] / total["passed"]), "drawn": total["drawn"]}
    drawn = [one["drawn_and_survive"] / one["drawn"] for one in counts if one["drawn"]]
    if drawn:
        share = total["drawn_and_survive"] / total["drawn"]
        row |= {"drawn_survive_share": number(share), "drawn_survive_least": number(min(drawn)), "drawn_survive_largest": number(max(drawn)),
                "survive_ratio": number(share * total["passed"] / total["passed_and_survive"])}
    return row


WALKS = ["arm", "seed", "rank", "individual", "friction", "body_lengths"]


def walks_of(results, arm, seed):
    """The walks on fine elements of the robots of a search that were judged, one row for each friction."""
    for rank, rows in robots_of(read_table(results / f"{arm}_{seed}.fine.csv")).items():
        for row in rows:
            lengths = "0" if row["reason"] else row["body_lengths"]  # it diverged, or fell
            yield {"arm": arm, "seed": seed, "rank": rank, "individual": row["individual"], "friction": row["friction"],
                   "body_lengths": number(float(lengths))}


BY_FRICTION = ["arm", "friction", "searches", "first_body_lengths", "best_body_lengths"]


def by_friction_rows(walks):
    """Of each arm the medians over its searches: how far the first robot goes at a friction, and the best of three at it. A last row,
    "worst", has the worst of the frictions, by which outcomes.csv counts."""
    for arm in ARMS:
        searches = {}
        for row in walks:
            if row["arm"] == arm:
                robots = searches.setdefault(row["seed"], {})
                robots.setdefault(int(row["rank"]), {})[row["friction"]] = float(row["body_lengths"])
        if not searches:
            continue
        frictions = sorted({row["friction"] for row in walks}, key=float)
        for friction in [*frictions, "worst"]:
            at = (lambda robot: min(robot.values())) if friction == "worst" else (lambda robot, f=friction: robot[f])
            yield {"arm": arm, "friction": friction, "searches": len(searches),
                   "first_body_lengths": number(median([at(robots[min(robots)]) for robots in searches.values()])),
                   "best_body_lengths": number(median([max(map(at, robots.values())) for robots in searches.values()]))}


def at_cost(rows, cost):
    """The score of the champion of a search when it had cost so much; none before its first."""
    found = [float(row["body_lengths"]) for row in rows if float(row["cost_element_steps"]) <= cost]
    return found[-1] if found else None


def ticks(highest):
    """Some round numbers from 0 to above a value."""
    step = 10.0 ** math.floor(math.log10(highest / 2.0)) if highest > 0.0 else 1.0
    step *= next(factor for factor in (1, 2, 5, 10) if highest / (step * factor) <= 6.0)
    return [n * step for n in range(math.ceil(highest / step) + 1)]


def draw(outcomes, progress):
    drawn = [arm for arm in ARMS if outcomes[arm]]
    searches = {arm: {} for arm in ARMS}
    for row in progress:
        searches[row["arm"]].setdefault(row["seed"], []).append(row)
    highest_cost = max(float(row["cost_element_steps"]) for row in progress)
    least_cost = min(float(row["cost_element_steps"]) for row in progress)
    grid = [least_cost * (highest_cost / least_cost) ** (n / (GRID - 1)) for n in range(GRID)]
    costs_axis = ("cost (element-steps)", 10.0 ** math.floor(math.log10(least_cost)), 10.0 ** math.ceil(math.log10(highest_cost)))
    decades = [costs_axis[1] * 10**n for n in range(round(math.log10(costs_axis[2] / costs_axis[1])) + 1)]
    lines = {}
    for arm, by_seed in searches.items():
        for cost in grid:
            # a search that ended a little earlier keeps its last champion
            found = [at_cost(rows, cost) for rows in by_seed.values()]
            if found and None not in found:
                lines.setdefault(arm, []).append((cost, *(quantile(found, share) for share in (0.25, 0.5, 0.75))))
    y_ticks = ticks(max((point[3] for line in lines.values() for point in line), default=1.0))
    first = Panel(0, "The champion of a search, on draft elements", (*costs_axis, decades, True),
                  ("body lengths in a period", 0.0, y_ticks[-1], y_ticks, False))
    for arm, line in lines.items():
        first.add_band([(cost, low, high) for cost, low, _, high in line], STYLES[arm][0])
        first.add_line([(cost, middle) for cost, _, middle, _ in line], STYLES[arm][0])
        first.add_mark(*[(cost, middle) for cost, _, middle, _ in line][-1], STYLES[arm])
    first.add_legend([(STYLES[arm], NAMES[arm]) for arm in drawn])
    best_ticks = ticks(max((x for values in outcomes.values() for x in values), default=1.0))
    second = Panel(1, "The best robot of each search, on fine elements", ("worst of three frictions", 0.5, len(drawn) + 0.5, [], False),
                   ("body lengths in a period", 0.0, best_ticks[-1], best_ticks, False))
    for n, arm in enumerate(drawn, 1):
        values = outcomes[arm]
        for k, x in enumerate(sorted(values)):
            second.add_mark(n + 0.3 * ((k + 0.5) / len(values) - 0.5), x, STYLES[arm])
        second.add_line([(n - 0.25, median(values)), (n + 0.25, median(values))], INK)
        second.parts.append(words(second.place_x(n), HEIGHT - 130 + 18, SHORT_NAMES[arm], size=12))
    parts = [part for panel in (first, second) for part in panel.parts]
    width = WIDTH - 420  # two of three panels
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {HEIGHT}" font-family="sans-serif" fill="{INK}">\n'
            f'<rect width="{width}" height="{HEIGHT}" fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n")


def main(arguments):
    try:
        match arguments:
            case ["study", arm, seed, size, out] if arm in ARMS:
                out = pathlib.Path(out).resolve()
                write_whole(out, study_text(arm, int(seed), read_toml(size), out.parent))
            case ["number", size, key]:
                print(read_toml(size)[key])
            case ["judge", name, size, out] if name in JUDGES:
                write_whole(pathlib.Path(out), text_with_bodies(name, read_toml(size)))
            case ["level", size]:
                print(*read_toml(size).get("levels", [1]))
            case ["missing", tables, seed, size]:
                file = pathlib.Path(tables) / "outcomes.csv"
                rows = read_table(file) if file.exists() else []
                print(*(arm for arm in read_toml(size).get("arms", ARMS) if not any(is_of(row, arm, seed) for row in rows)))
            case ["cost", results]:
                write_table(HERE / "cost.csv", ["what", "value"], cost_rows(pathlib.Path(results)))
            case ["champions", results, arm, seed] if arm in ARMS:
                print(*(one[2] for one in drawn_champions(list(champions_of(pathlib.Path(results), arm, seed)))))
            case ["winner", results, arm, seed] if arm in ON_ELEMENTS:
                winner = winner_of(judged_robots(pathlib.Path(results), arm, seed))
                if winner:
                    print(winner[0]["individual"])
            case ["untried", tables]:
                for row in untried_winners(pathlib.Path(tables)):
                    print(*row)
            case ["again", results, tables, arm, seed] if arm in ON_ELEMENTS:
                results, tables = pathlib.Path(results), pathlib.Path(tables)
                check_is_winner(results, tables, arm, seed)
                add_rows(tables / "layers.csv", LAYERS, arm, seed, list(layers_of(results, arm, seed)))
                add_rows(tables / "dampings.csv", DAMPINGS, arm, seed, list(dampings_of(results, arm, seed)))
            case ["take", results, tables, arm, seed] if arm in ARMS:
                results, tables = pathlib.Path(results), pathlib.Path(tables)
                progress = list(progress_of(results, arm, seed))
                outcome = outcome_of(results, arm, seed)
                if (results / f"{arm}_{seed}.layers.csv").exists():  # where the size asks for it
                    add_rows(tables / "layers.csv", LAYERS, arm, seed, list(layers_of(results, arm, seed)))
                if (results / f"{arm}_{seed}.dampings.csv").exists():
                    add_rows(tables / "dampings.csv", DAMPINGS, arm, seed, list(dampings_of(results, arm, seed)))
                screening = list(screening_of(results, arm, seed))
                if screening:
                    add_rows(tables / "screening.csv", SCREENING, arm, seed, screening)
                add_rows(tables / "progress.csv", PROGRESS, arm, seed, progress)
                add_rows(tables / "walks.csv", WALKS, arm, seed, list(walks_of(results, arm, seed)))
                # the last one: a search whose outcome is there is not run again
                add_rows(tables / "outcomes.csv", OUTCOMES, arm, seed, [outcome])
            case ["summary", tables]:
                tables = pathlib.Path(tables)
                outcomes = outcomes_by_arm(tables)
                write_comparisons(tables / "statistics.csv", outcomes)
                if (tables / "walks.csv").exists():
                    write_table(tables / "by_friction.csv", BY_FRICTION, by_friction_rows(read_table(tables / "walks.csv")))
                if (tables / "layers.csv").exists():
                    write_table(tables / "layer_statistics.csv", LAYER_STATISTICS, layer_statistics_rows(read_table(tables / "layers.csv")))
                if (tables / "dampings.csv").exists():
                    write_table(tables / "damping_statistics.csv", DAMPING_STATISTICS, damping_statistics_rows(read_table(tables / "dampings.csv")))
                if (tables / "screening.csv").exists():
                    write_table(tables / "screened.csv", SCREENED, [screened_row(read_table(tables / "screening.csv"))])
                write_comparisons(tables / "first.csv", outcomes_by_arm(tables, "first_body_lengths"))
                (tables / "proof.svg").write_text(draw(outcomes, read_table(tables / "progress.csv")), encoding="utf-8")
            case _:
                raise InputError(f"wrong arguments\n\n{__doc__}")
    except (InputError, KeyError, ValueError) as error:
        print(f"proof.py: error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
