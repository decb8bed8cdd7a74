"""Corrections for several tests at once."""


def holm(p_values):
    """The p of several tests at once by Holm's method: the least times their number, the next times one less, and so on, never
    falling and at most 1. None is a test that is planned and not made yet: it counts, as if it came out last, and stays None."""
    order = sorted((n for n, p in enumerate(p_values) if p is not None), key=lambda n: p_values[n])
    adjusted = [None] * len(p_values)
    largest = 0.0
    for place, n in enumerate(order):
        largest = max(largest, min(1.0, (len(p_values) - place) * p_values[n]))
        adjusted[n] = largest
    return adjusted
