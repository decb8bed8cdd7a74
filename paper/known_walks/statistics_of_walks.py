"""Numbers about pairs of walks: ranks, correlations, angles, and intervals by bootstrap over robots. A pair has two displacements in the plane."""

import math
import random

from small_tables import cell

FEWEST = 5  # pairs of walks; with fewer a row is left out, so that tables can be made before all walks are done
RESAMPLES = 500
SEED = 1


def median(values):
    return quantile(values, 0.5)


def quantile(values, share):
    """A quantile of values, between two of them by a straight line."""
    ordered = sorted(values)
    place = share * (len(ordered) - 1)
    low = math.floor(place)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def mid_ranks(values):
    """The ranks of values, 1 for the smallest; equal values share the mean of their ranks."""
    order = sorted(range(len(values)), key=values.__getitem__)
    ranks = [0.0] * len(values)
    start = 0
    while start < len(order):
        end = start
        while end + 1 < len(order) and values[order[end + 1]] == values[order[start]]:
            end += 1
        for place in order[start : end + 1]:
            ranks[place] = 0.5 * (start + end) + 1.0
        start = end + 1
    return ranks


def spearman(pairs):
    """Spearman's rank correlation of pairs; none for fewer than three, or if one side is all equal."""
    if len(pairs) < 3:
        return None
    x, y = (mid_ranks(side) for side in zip(*pairs))
    mean = 0.5 * (len(pairs) + 1)
    over_x = sum((a - mean) ** 2 for a in x)
    over_y = sum((b - mean) ** 2 for b in y)
    if over_x == 0.0 or over_y == 0.0:
        return None
    return sum((a - mean) * (b - mean) for a, b in zip(x, y)) / math.sqrt(over_x * over_y)


def angle_deg(a, b):
    """The angle between two vectors of the plane, 0 to 180 degrees; none if one has no length."""
    if not math.hypot(*a) or not math.hypot(*b):
        return None
    return abs(math.degrees(math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])))


def interval(items, statistic, resamples=None):
    """The 95 % interval of a statistic by the percentiles of a bootstrap over items. The same items give the same interval.

    Resamples without a value, such as a correlation of equal values, are left out; none if fewer than half of them have one."""
    draw = random.Random(SEED)
    resamples = resamples or RESAMPLES
    found = [value for value in (statistic(draw.choices(items, k=len(items))) for _ in range(resamples)) if value is not None]
    if 2 * len(found) < resamples:
        return None, None
    return quantile(found, 0.025), quantile(found, 0.975)


def share_interval(count, of):
    """Wilson's 95 % interval of a share, which is right near 0 and 1, where a bootstrap is not."""
    if of == 0:
        return None, None
    z = 1.959964
    centre = (count + 0.5 * z * z) / (of + z * z)
    half = z / (of + z * z) * math.sqrt(count * (of - count) / of + 0.25 * z * z)
    return centre - half, centre + half


def lengths(pairs):
    return [(math.hypot(*a), math.hypot(*b)) for a, b in pairs]


def rank_correlation(pairs):
    return spearman(lengths(pairs))


def within_45_deg(pairs):
    """How many of the pairs go the same way, and of how many that go anywhere."""
    angles = [angle for angle in (angle_deg(a, b) for a, b in pairs) if angle is not None]
    return sum(angle <= 45.0 for angle in angles), len(angles)


AGREEMENT = ["robots", "spearman", "spearman_low", "spearman_high", "within_45_deg", "of", "within_45_deg_share", "share_low", "share_high"]


def agreement_cells(pairs):
    """Rank correlation and agreement of directions of pairs, with intervals: the cells of AGREEMENT."""
    count, of = within_45_deg(pairs)
    low, high = interval(lengths(pairs), spearman) if len(pairs) > 3 else (None, None)
    return [len(pairs), *map(cell, (rank_correlation(pairs), low, high)), count, of,
            *map(cell, (count / of if of else None, *share_interval(count, of)))]
