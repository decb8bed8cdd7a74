"""What voxels, and large changes of one thing, do to walks: the rows of voxels.csv, gait_agreement.csv and sensitivity.csv."""

import math

from bodies import form_of, is_stepped, mirrors_of
from small_tables import cell, read_table
from statistics_of_walks import (AGREEMENT, FEWEST, agreement_cells, interval, lengths, median, rank_correlation, spearman,
                                 within_45_deg)

LARGE = ("draft_0.9_pressure", "draft_0.75_pressure", "draft_3_damping", "draft_0.1_ground")  # changes of a walk on draft elements

VOXELS = ["robots_of", "with", "robots", "spearman", "spearman_low", "spearman_high", "order_share", "order_low", "order_high", "far",
          "stand_still", "within_45_deg", "of", "by_chance", "median_error_share", "median_ratio"]


def read_screened(file):
    """[(model of the search, body, displacement on voxels, displacement on draft elements)], m; each form once."""
    robots = []
    seen = set()
    for row in read_table(file):
        ways = [[row[f"{model}_d{axis}_um"] for axis in "xy"] for model in ("voxels", "draft")]
        if form_of(row["layers"]) in seen or not all(value for way in ways for value in way):
            continue
        seen.add(form_of(row["layers"]))
        robots.append((row["search_on"], row["layers"], *(tuple(1e-6 * float(value) for value in way) for way in ways)))
    return robots


def order_share(pairs, floor_m):
    """How often the robot of two that goes beyond the floor on elements goes further on voxels, too, where the other one does not go beyond
    it: a half by chance. None where all do, or none."""
    far = [math.hypot(*voxels) for elements, voxels in pairs if math.hypot(*elements) > floor_m]
    near = [math.hypot(*voxels) for elements, voxels in pairs if math.hypot(*elements) <= floor_m]
    if not far or not near:
        return None
    return sum((a > b) + 0.5 * (a == b) for a in far for b in near) / (len(far) * len(near))


def voxel_cells(robots, floor_m):
    """@param robots [(body, displacement on elements, displacement on voxels)] @param floor_m over the time of these walks

    Directions are those of robots that go beyond the floor in both models. By chance a half of them agrees for bodies with one mirror, which
    go to and fro along it, and a quarter of the others. Errors and ratios are those of robots beyond the floor on elements."""
    pairs = [pair for _, *pair in robots]
    far = [robot for robot in robots if math.hypot(*robot[1]) > floor_m]
    both = [robot for robot in far if math.hypot(*robot[2]) > floor_m]
    same_way, of = within_45_deg([pair for _, *pair in both])
    by_chance = sum(0.5 if len(mirrors_of(body)) == 1 else 0.25 for body, *_ in both)
    errors = [math.hypot(b[0] - a[0], b[1] - a[1]) / math.hypot(*a) for _, a, b in far]
    ratios = [math.hypot(*b) / math.hypot(*a) for _, a, b in far]
    order = [order_share(pairs, floor_m), *interval(pairs, lambda sample: order_share(sample, floor_m))]
    return [len(pairs), *map(cell, (rank_correlation(pairs), *interval(lengths(pairs), spearman), *order)), len(far), len(far) - len(both),
            same_way, of, cell(by_chance), *(cell(median(values)) if values else "" for values in (errors, ratios))]


def voxel_rows(all_walks, bodies, screened):
    """What voxels tell of walks on finite elements: of all robots that were screened, and of those that go beyond the floor.

    @param bodies {robot: body}"""
    def walked(walk, voxels="voxels", wanted=lambda body: True):
        pairs = {robot: all_walks.pair(robot, voxels, walk) for robot in all_walks.beyond if wanted(bodies[robot])}
        return [(bodies[robot], *pair) for robot, pair in pairs.items() if pair]

    of_searches = [(search_on, (body, elements, voxels)) for search_on, body, voxels, elements in screened]
    groups = [
        ("all that were screened", "draft", [robot for _, robot in of_searches]),
        ("those of searches on voxels", "draft", [robot for search_on, robot in of_searches if search_on == "voxels"]),
        ("those of searches on finite elements", "draft", [robot for search_on, robot in of_searches if search_on == "finite_elements"]),
        ("beyond the floor", "fine", walked("fine")),
        ("beyond the floor, stepped bodies", "fine", walked("fine", wanted=is_stepped)),
        ("beyond the floor, others", "fine", walked("fine", wanted=lambda body: not is_stepped(body))),
        ("beyond the floor, voxels without drag", "fine", walked("fine", "voxels_without_drag")),
        ("beyond the floor, for 2 s", "two_layers", walked("two_layers")),
    ]
    for name, walk, robots in groups:
        if len(robots) >= FEWEST:
            yield [name, walk, *voxel_cells(robots, all_walks.floor_over_m(walk))]


SENSITIVITY = ["change", *AGREEMENT, "median_ratio"]


def sensitivity_rows(all_walks):
    """What large changes of one thing do to a walk on draft elements, with the ratio of the displacements; and what voxels do."""
    for change in (*LARGE, "voxels"):
        pairs = all_walks.pairs(all_walks.beyond, change, "draft")
        if len(pairs) >= FEWEST:
            yield [change, *agreement_cells(pairs), cell(median([b / a for a, b in lengths(pairs) if a > 0.0]))]


GAIT = {
    "rise": "rise and fall of the centre of mass in a period",
    "path": "length of its path over the ground in a period",
    "step": "its displacement in a period",
}
GAIT_AGREEMENT = ["what", "walk", "with", "meaning", "robots", "spearman", "low", "high", "median_ratio", "median_m"]


def read_gaits(file):
    """{(robot, change): {name of GAIT: m}}"""
    return {(row["robot"], row["change"]): {name: 1e-6 * float(row[f"{name}_um"]) for name in GAIT} for row in read_table(file)}


def gait_rows(all_walks, gaits):
    """How bodies move within a period: on draft elements and voxels compared with fine elements, with large changes compared with draft ones.
    The last column is the median of those that are compared with."""
    for change, other in (("draft", "fine"), ("voxels", "fine"), *((change, "draft") for change in LARGE)):
        for name, meaning in GAIT.items():
            keys = [((robot, other), (robot, change)) for robot in all_walks.beyond]
            values = [(gaits[a][name], gaits[b][name]) for a, b in keys if a in gaits and b in gaits]
            if len(values) >= FEWEST:
                ratios = [b / a for a, b in values if a > 0.0]
                yield [name, change, other, meaning, len(values), *map(cell, (spearman(values), *interval(values, spearman), median(ratios),
                                                                                median([a for a, _ in values])))]
