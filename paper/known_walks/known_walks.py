#!/usr/bin/python3
"""known_walks.py [FOLDER]: how far walks are known, from walks.csv, robots.csv, screened.csv and gaits.csv of the folder (default:
that of this script).

Writes progress.csv, floor.csv, changes.csv, agreement.csv, voxels.csv, gait_agreement.csv, sensitivity.csv, symmetry.csv, measures.csv,
durations.csv, halves.csv and known_walks.svg there. The same walks give the same bytes.

A displacement is that of the centre of mass in the plane, from the end of the first period of the drive, in which the pressure grows, to
the end of the walk. Exit codes: 0 done, 2 wrong input.
"""

import math
import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from bodies import MIRRORS, is_stepped, mirrors_of, read_bodies
from chart_of_walks import draw
from small_tables import InputError, read_table, write_table
from statistics_of_walks import (AGREEMENT, FEWEST, agreement_cells, angle_deg, interval, median, quantile, rank_correlation, spearman,
                                 within_45_deg)
from voxel_walks import GAIT_AGREEMENT, LARGE, SENSITIVITY, VOXELS, gait_rows, read_gaits, read_screened, sensitivity_rows, voxel_rows

PERIODS = 15
HALF = PERIODS // 2
TWO_LAYERS_PERIODS = 6
SMALL = ("half_step", "stiff_ground", "friction", "pressure")  # changes that nobody could tell from the walk as it was asked for
CEILING = ("half_step", "stiff_ground", "friction")
TOGETHER = "together"  # those of CEILING at once
SHOWN = (*SMALL, TOGETHER, "draft", "fine", "fine_same_ground", "two_layers", "voxels")
MOST_LOSS = 0.03
ENOUGH = 20  # robots that walked on fine elements; with fewer, all are compared with standard elements
DISTANCES_M = (0.0, 0.001, 0.002, 0.005)


def read_walks(file):
    """{robot: {change: places at the ends of the periods, m, or nothing for a walk that failed}}"""
    walks = {}
    for row in read_table(file):
        places = []
        for n in range(1, PERIODS + 1):
            if row[f"x_{n}_um"]:
                places.append((1e-6 * float(row[f"x_{n}_um"]), 1e-6 * float(row[f"y_{n}_um"])))
        walks.setdefault(row["robot"], {})[row["change"]] = places
    return walks


def minus(a, b):
    return a[0] - b[0], a[1] - b[1]


def net(places, periods=PERIODS):
    """The displacement from the end of the first period to that of another; none if the walk did not get there."""
    return minus(places[periods - 1], places[0]) if len(places) >= periods else None


def steps_of(places, periods=PERIODS):
    return [minus(b, a) for a, b in zip(places, places[1:periods])]


def median_step(steps):
    return math.hypot(median([s[0] for s in steps]), median([s[1] for s in steps]))


def slope(places):
    """The length of the velocity of the straight line of least squares, per period."""
    mean = 0.5 * (len(places) - 1)
    over = sum((n - mean) ** 2 for n in range(len(places)))
    return math.hypot(*(sum((n - mean) * place[axis] for n, place in enumerate(places)) / over for axis in (0, 1)))


# Measures of fitness: what a search could rank robots by. All from the end of the first period on.
MEASURES = {
    "net displacement": lambda places: math.hypot(*net(places)),
    "net displacement of the last 10 periods": lambda places: math.hypot(*minus(places[-1], places[-11])),
    "net displacement of the last 5 periods": lambda places: math.hypot(*minus(places[-1], places[-6])),
    "median displacement per period": lambda places: median_step(steps_of(places)),
    "median displacement per period, last 10": lambda places: median_step(steps_of(places)[-10:]),
    "median displacement per period, last 5": lambda places: median_step(steps_of(places)[-5:]),
    "slope of the straight line of least squares": slope,
    "farthest from the start at the end of a period": lambda places: max(math.hypot(*minus(p, places[0])) for p in places[1:]),
    "length of the path from period to period": lambda places: sum(math.hypot(*step) for step in steps_of(places)),
}


def number(value, digits=6):
    return "" if value is None else f"{value:.{digits}g}"


class Walks:
    """The walks of all robots, with how far each goes and how far that is known."""

    def __init__(self, walks):
        self.walks = walks
        self.reference = "fine" if sum(len(changes.get("fine", [])) == PERIODS for changes in walks.values()) >= ENOUGH else "standard"
        self.distance_m = {}  # by the reference
        self.noise_m = {}
        self.small = [change for change in SMALL if sum(len(changes.get(change, [])) == PERIODS for changes in walks.values()) >= FEWEST]
        for robot, changes in walks.items():
            if not all(len(changes.get(change, [])) == PERIODS for change in ("standard", self.reference)):
                continue
            self.distance_m[robot] = math.hypot(*net(changes[self.reference]))
            moved = [self.moved_m(robot, change) for change in self.small]
            if moved and None not in moved:
                self.noise_m[robot] = math.sqrt(sum(m * m for m in moved) / len(moved))
        self.floor_m = median(list(self.noise_m.values())) if self.noise_m else 0.0
        self.beyond = [robot for robot in self.distance_m if self.distance_m[robot] > self.floor_m]

    def floor_over_m(self, walk):
        """The floor over the time of a walk: what goes evenly goes as much less far in a shorter one."""
        return self.floor_m * ((TWO_LAYERS_PERIODS - 1) / (PERIODS - 1) if walk == "two_layers" else 1.0)

    def pair(self, robot, change, other="standard"):
        """The displacements of a robot with a change and of another walk of it, over the time of the shorter one."""
        changes = self.walks[robot]
        periods = TWO_LAYERS_PERIODS if "two_layers" in (change, other) else PERIODS
        both = [net(changes.get(one, []), periods) for one in (other, change)]
        return None if None in both else both

    def moved_m(self, robot, change, other="standard"):
        both = self.pair(robot, change, other)
        return None if both is None else math.hypot(*minus(both[1], both[0]))

    def pairs(self, robots, change, other="standard"):
        found = [self.pair(robot, change, other) for robot in robots]
        return [pair for pair in found if pair is not None]


def difference(a, b):
    return None if a is None or b is None else a - b


def progress_rows(all_walks):
    walked = (change for changes in all_walks.walks.values() for change in changes)
    for change in dict.fromkeys(("draft", "standard", "fine", *SHOWN, *LARGE, *walked)):
        ends = [changes[change] for changes in all_walks.walks.values() if change in changes]
        yield [change, len(ends), sum(not places for places in ends)]


def floor_rows(all_walks, bodies):
    noise = list(all_walks.noise_m.values())
    known = [robot for robot in all_walks.noise_m if all_walks.noise_m[robot] < all_walks.distance_m[robot]]
    rho = [rank_correlation(all_walks.pairs(all_walks.beyond, change)) for change in CEILING if change in all_walks.small]
    ceiling = sum(rho) / len(rho) if rho and None not in rho else None
    on_elements = [places for changes in all_walks.walks.values() for change, places in changes.items() if not change.startswith("voxels")]
    return [
        ["robots", len(all_walks.walks)],
        ["stepped_robots", sum(is_stepped(bodies[robot]) for robot in all_walks.walks)],
        ["robots_of_all_walks", len(noise)],
        ["walks", len(on_elements)],
        ["failed_walks", sum(not places for places in on_elements)],
        ["floor_m", number(all_walks.floor_m)],
        ["floor_low_m", number(interval(noise, median)[0])],
        ["floor_high_m", number(interval(noise, median)[1])],
        ["floor_90_percent_m", number(quantile(noise, 0.9))],
        ["robots_on_fine_elements", sum(len(changes.get("fine", [])) == PERIODS for changes in all_walks.walks.values())],
        ["robots_beyond", len(all_walks.beyond)],
        ["robots_that_go_further_than_their_own_noise", len(known)],
        ["ceiling_spearman", number(ceiling, 4)],
        ["ceiling_of_all_at_once", number(rank_correlation(all_walks.pairs(all_walks.beyond, TOGETHER)), 4)],
        ["ceiling_of_the_mean_walk", number(math.sqrt(ceiling) if ceiling else None, 4)],
    ]


def symmetry_rows(all_walks, mirrors):
    """Directions of bodies with and without a mirror. What is symmetric may turn to either side: then its mirror image agrees."""
    groups = {"without a mirror": [robot for robot in all_walks.beyond if not mirrors[robot]],
              "with a mirror": [robot for robot in all_walks.beyond if mirrors[robot]]}
    for change, other in (("draft", "standard"), ("draft", "fine"), ("standard", "fine"), ("stiff_ground", "standard")):
        for name, robots in groups.items():
            pairs = {robot: all_walks.pair(robot, change, other) for robot in robots}
            count, of = within_45_deg([pair for pair in pairs.values() if pair])
            either = 0
            for robot, pair in pairs.items():
                if pair:
                    images = [pair[1], *(MIRRORS[mirror][1](pair[1]) for mirror in mirrors[robot])]
                    either += any((angle_deg(pair[0], image) or 0.0) <= 45.0 for image in images)
            yield [name, change, other, count, either, of]


def change_rows(all_walks):
    for change in SHOWN:
        pairs = all_walks.pairs(all_walks.beyond, change)
        if len(pairs) < FEWEST:
            continue
        moved = [math.hypot(*minus(b, a)) for a, b in pairs]
        shares = [m / math.hypot(*a) for m, (a, _) in zip(moved, pairs) if math.hypot(*a) > 0.0]
        low, high = interval(shares, median)
        yield [change, number(median(moved)), number(quantile(moved, 0.9)), number(median(shares), 4), number(low, 4), number(high, 4),
               number(quantile(shares, 0.9), 4), *agreement_cells(pairs)]


def agreement_rows(all_walks):
    limits = [max(least, all_walks.floor_m) for least in DISTANCES_M]
    with_fine = [("draft", "fine"), ("standard", "fine")] if all_walks.reference == "fine" else []
    for change, other in (*with_fine, ("draft", "standard"), *((change, "standard") for change in (*all_walks.small, TOGETHER))):
        for limit in dict.fromkeys(limits):
            robots = [robot for robot in all_walks.beyond if all_walks.distance_m[robot] > limit]
            if not all_walks.pairs(robots, change, other):
                continue
            yield [change, other, "floor" if limit == all_walks.floor_m else f"{1e3 * limit:g} mm", number(limit),
                   *agreement_cells(all_walks.pairs(robots, change, other))]
    for change in ("draft", "standard", "fine"):
        robots = [robot for robot in all_walks.beyond if all_walks.pair(robot, "two_layers")]
        if len(robots) < FEWEST:
            continue
        yield [change, "two_layers", "floor", number(all_walks.floor_m), *agreement_cells(all_walks.pairs(robots, change, "two_layers"))]


def measured(all_walks, change, measure):
    """{robot: measure} of the robots beyond the floor that completed a walk."""
    return {robot: measure(all_walks.walks[robot][change]) for robot in all_walks.beyond
            if len(all_walks.walks[robot].get(change, [])) == PERIODS}


def measure_rows(all_walks):
    """The mean rank correlation with each small change, and that with fine and draft; also as differences to net displacement."""
    first = None
    changes = ("standard", *all_walks.small, "draft", all_walks.reference)
    for name, measure in MEASURES.items():
        of = [measured(all_walks, change, measure) for change in changes]
        robots = [robot for robot in all_walks.beyond if all(robot in values for values in of)]
        values = [tuple(one[robot] for one in of) for robot in robots]
        first = first or values
        items = list(zip(values, first))

        def mean_of_small(sample):
            found = [spearman([(value[0], value[1 + n]) for value in sample]) for n in range(len(all_walks.small))]
            return None if not found or None in found else sum(found) / len(found)

        def gain(sample):
            return difference(*(mean_of_small(side) for side in zip(*sample)))

        def with_reference(sample, which=0):
            return spearman([(value[which], value[-1]) for value in sample])

        low, high = interval(values, mean_of_small)
        gain_low, gain_high = interval(items, gain)
        reference_low, reference_high = interval(values, with_reference)
        yield [name, len(items), *(number(v, 4) for v in (mean_of_small(values), low, high, gain(items), gain_low, gain_high,
                                                          with_reference(values), reference_low, reference_high, with_reference(values, -2)))]


def duration_rows(all_walks):
    """How shorter walks rank the robots as walks of the whole time on the reference do."""
    robots = [robot for robot in all_walks.beyond if len(all_walks.walks[robot].get("draft", [])) == PERIODS]
    for change in dict.fromkeys(("draft", "standard", all_walks.reference)):
        for periods in range(2, PERIODS + 1):
            short, whole, reference = ([net(all_walks.walks[robot][one], n) for robot in robots]
                                  for one, n in ((change, periods), (change, PERIODS), (all_walks.reference, PERIODS)))
            items = list(zip(*([math.hypot(*way) for way in ways] for ways in (short, whole, reference))))

            def ranks(sample, which=0):
                return spearman([(item[which], item[2]) for item in sample])

            def loss(sample):
                return difference(ranks(sample, 1), ranks(sample))

            directions = [angle_deg(*pair) for pair in zip(short, reference)]
            low, high = interval(items, ranks)
            loss_low, loss_high = interval(items, loss)
            yield [change, periods, f"{periods / 3.0:.3f}", len(items),
                   *(number(v, 4) for v in (ranks(items), low, high, loss(items), loss_low, loss_high)),
                   sum(angle is not None and angle <= 45.0 for angle in directions)]


def half_rows(all_walks):
    """How the first half of a walk ranks robots as the whole walk on the same elements does."""
    for name, robots in (("all", list(all_walks.walks)), ("beyond the floor", all_walks.beyond)):
        for change in ("draft", "standard", "fine"):
            ways = [[net(all_walks.walks[robot].get(change, []), periods) for periods in (HALF, PERIODS)] for robot in robots]
            items = [tuple(math.hypot(*way) for way in both) for both in ways if None not in both]
            yield [name, change, HALF, len(items), *(number(v, 4) for v in (spearman(items), *interval(items, spearman)))]


def shortest_s(durations, change):
    """The shortest walk from which on no longer one loses more than 0.03 of the rank correlation of five seconds."""
    shortest = None
    for row in durations:
        if row[0] == change:
            within = row[7] != "" and float(row[7]) <= MOST_LOSS
            shortest = (shortest or row[2]) if within else None
    return shortest or ""


def main(words):
    folder = pathlib.Path(words[0] if words else __file__).resolve()
    folder = folder if folder.is_dir() else folder.parent
    try:
        all_walks = Walks(read_walks(folder / "walks.csv"))
        bodies = read_bodies(folder / "robots.csv")
        screened = read_screened(folder / "screened.csv")
        gaits = read_gaits(folder / "gaits.csv")
        if len(all_walks.noise_m) < 3:
            raise InputError(f"{folder / 'walks.csv'}: fewer than three robots have all walks")
    except (InputError, KeyError, ValueError) as error:
        print(f"known_walks.py: error: {error}", file=sys.stderr)
        return 2
    durations = list(duration_rows(all_walks))
    shortest = [[f"shortest_{change}_s", shortest_s(durations, change)] for change in ("draft", "standard", "fine")]
    write_table(folder / "floor.csv", ["what", "value"], floor_rows(all_walks, bodies) + shortest)
    write_table(folder / "progress.csv", ["change", "done", "failed"], progress_rows(all_walks))
    write_table(folder / "changes.csv", ["change", "median_m", "ninth_decile_m", "median_share", "median_share_low", "median_share_high",
                                         "ninth_decile_share", *AGREEMENT], change_rows(all_walks))
    write_table(folder / "agreement.csv", ["walk", "with", "beyond", "beyond_m", *AGREEMENT], agreement_rows(all_walks))
    write_table(folder / "voxels.csv", VOXELS, voxel_rows(all_walks, bodies, screened))
    write_table(folder / "sensitivity.csv", SENSITIVITY, sensitivity_rows(all_walks))
    write_table(folder / "gait_agreement.csv", GAIT_AGREEMENT, gait_rows(all_walks, gaits))
    write_table(folder / "symmetry.csv", ["bodies", "walk", "with", "within_45_deg", "within_45_deg_or_mirrored", "of"],
                symmetry_rows(all_walks, {robot: mirrors_of(body) for robot, body in bodies.items()}))
    write_table(folder / "measures.csv", ["measure", "robots", "small_changes", "low", "high", "gain", "gain_low", "gain_high",
                                          "reference", "reference_low", "reference_high", "draft_reference"], measure_rows(all_walks))
    write_table(folder / "durations.csv", ["walk", "periods", "duration_s", "robots", "spearman", "low", "high", "loss", "loss_low",
                                           "loss_high", "within_45_deg"], durations)
    write_table(folder / "halves.csv", ["robots_of", "walk", "periods", "robots", "spearman", "low", "high"], half_rows(all_walks))
    (folder / "known_walks.svg").write_text(draw(all_walks, durations), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
