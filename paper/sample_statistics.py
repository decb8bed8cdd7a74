"""Statistics of samples with 95 % intervals, by SciPy.

Bootstraps have a fixed seed, so that the same sample gives the same interval.
"""

import itertools
import sys
import warnings
from dataclasses import dataclass

try:
    import numpy as np
    from scipy import optimize, stats
except ImportError as error:
    sys.exit(f"{error}: statistics of experiments need SciPy: apt-get install python3-scipy")

RESAMPLES = 2000
PAIRINGS = 99999  # drawn at random where there are more; the least p is 2e-5 then
FEWEST = 5  # members of a sample, of fewer of which resampling makes too narrow an interval: of two it covers every other time
SEED = 1


@dataclass(frozen=True)
class Estimate:
    """A number and its interval; the ends are None where the sample gives none, as if it has few members, or equal ones."""

    value: float
    low: float | None
    high: float | None

    def cells(self, name):
        """Its columns in a table; a number that is none is an empty cell."""
        return {name: self.value if np.isfinite(self.value) else None, f"{name}_low": self.low, f"{name}_high": self.high}


def bootstrap(statistic, *samples, paired=False):
    """The statistic of one or more samples, with the percentiles of a bootstrap. `paired`: their members are drawn together."""
    samples = [np.asarray(sample, dtype=float) for sample in samples]
    value = float(statistic(*samples))
    if min(len(sample) for sample in samples) < FEWEST:
        return Estimate(value, None, None)
    found = stats.bootstrap(samples, statistic, n_resamples=RESAMPLES, paired=paired, method="percentile",
                            random_state=np.random.default_rng(SEED)).confidence_interval
    ends = (float(found.low), float(found.high))
    return Estimate(value, *ends) if np.all(np.isfinite(ends)) else Estimate(value, None, None)


def mean(sample):
    return bootstrap(np.mean, sample)


def exponential(estimate):
    """Of an estimate of a logarithm: that of the number itself."""
    low, high = (None if end is None else float(np.exp(end)) for end in (estimate.low, estimate.high))
    return Estimate(float(np.exp(estimate.value)), low, high)


def geometric_mean(sample):
    return exponential(mean(np.log(sample)))


def geometric_means_ratio(sample, other):
    """How many times as large the geometric mean of a sample is as that of another one."""
    return exponential(bootstrap(lambda one, two: np.mean(one) - np.mean(two), np.log(sample), np.log(other)))


def median(sample):
    return bootstrap(np.median, sample)


def spearman(x, y):
    """Spearman's rank correlation of pairs."""
    return bootstrap(rank_correlation, x, y, paired=True)


def rank_correlation(x, y):
    """Spearman's coefficient; equal values share the mean of their ranks. Not a number if all of one side are equal."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", stats.ConstantInputWarning)
        return stats.spearmanr(x, y).correlation


def share(count, of):
    """A share of independent trials, with Wilson's interval, which holds near 0 and 1, too."""
    ends = stats.binomtest(count, of).proportion_ci(method="wilson")
    return Estimate(count / of, float(ends.low), float(ends.high))


def difference_of_shares(count, of, other_count, of_others):
    """A share less another one, of independent trials, with Newcombe's interval (his method 10): from the ends of Wilson's intervals of both."""
    one, other = share(count, of), share(other_count, of_others)
    low = np.hypot(one.value - one.low, other.high - other.value)
    high = np.hypot(one.high - one.value, other.value - other.low)
    difference = one.value - other.value
    return Estimate(difference, float(difference - low), float(difference + high))


def mcnemar(before, after):
    """p of McNemar's exact test, two-sided: whether a property of the same robots, yes or no, changes one way more often than the other."""
    before, after = np.asarray(before, dtype=bool), np.asarray(after, dtype=bool)
    gained, lost = int(np.sum(~before & after)), int(np.sum(before & ~after))
    return float(stats.binomtest(gained, gained + lost).pvalue) if gained + lost else 1.0


def pairing_p(*steps):
    """The two-sided p of a permutation test: do members match themselves more, or less, often than if they were paired at random? With two tables, at
    both steps. A random pair may be of a member and itself. None if there is one member.

    @param steps square tables, yes or no: whether a side of a member (row) matches the next side of a member (column). Of one step, whether the first
    side matches the second; of two, also whether the second matches the third"""
    steps = [np.asarray(step, dtype=bool) for step in steps]
    if len(steps[0]) < 2:
        return None
    places = np.arange(len(steps[0]))

    def matching(*orders, axis):
        before, found = places, True
        for step, order in zip(steps, orders):
            found, before = found & step[before, order.astype(int)], order.astype(int)
        return found.sum(axis=axis)

    return float(stats.permutation_test((places,) * len(steps), matching, permutation_type="pairings",
                                        vectorized=True, batch=1000, n_resamples=PAIRINGS, random_state=np.random.default_rng(SEED)).pvalue)


# What a verdict on something that the paper says means, if yes is its side.
OUTCOMES = {"yes": "reproduced", "no": "not reproduced", "open": "open"}
LARGEST_P = 0.05  # of a test that tells groups apart


def tells_apart(p):
    """Whether a test with this p tells groups apart; None is of a test that could not be made."""
    return p is not None and p < LARGEST_P


def verdict(estimate, against):
    """Whether a number is above another one: yes, no (it is below), or open, as its interval has the other one inside or is not known."""
    if estimate.low is None or estimate.high is None or estimate.low <= against <= estimate.high:
        return "open"
    return "yes" if estimate.low > against else "no"


def fisher(count, of, other_count, of_others):
    """The two-sided p of Fisher's exact test: how often two shares of equal trials differ as much."""
    return float(stats.fisher_exact([[count, of - count], [other_count, of_others - other_count]])[1])


def freeman_halton(counts, others):
    """The p of Freeman and Halton's exact test: whether two groups are spread alike over more than two kinds. It sums the probabilities of
    all tables with the same sums of rows and columns that are at most as probable as this one; with two kinds it is Fisher's test.

    @param counts how many members of the first group are of each kind; others those of the second one
    Source: Freeman and Halton, Biometrika 38 (1951) 141."""
    of_kinds = [one + other for one, other in zip(counts, others)]
    law = stats.multivariate_hypergeom(of_kinds, sum(counts))
    rows = [row for row in itertools.product(*(range(of + 1) for of in of_kinds)) if sum(row) == sum(counts)]
    probabilities = law.pmf(rows)
    return min(1.0, float(probabilities[probabilities <= law.pmf(counts) * (1.0 + 1e-9)].sum()))


def rank_sum(first, second):
    """The two-sided p of Wilcoxon's rank-sum test, also called Mann and Whitney's: how often samples of equal distributions differ as much.
    None where a sample has one member, which says nothing of others like it.

    Exact up to 25 members on a side if no two are equal, else with the normal distribution, corrected for ties."""
    if min(len(first), len(second)) < 2:
        return None
    tied = len(set(first) | set(second)) < len(first) + len(second)
    method = "asymptotic" if tied or max(len(first), len(second)) > 25 else "exact"
    return float(stats.mannwhitneyu(first, second, alternative="two-sided", method=method).pvalue)


def share_of_larger(first, second):
    """How often a member of the first sample is larger than one of the second, of all pairs of the two; ties count half.

    The interval is Newcombe's (his method 5): all shares from which the observed one is at most 1.96 standard errors away, where the error
    is that of Hanley and McNeil at this share, with the mean of both sizes. It holds where no member of one sample is as large as one of
    the other, too.
    Source: Newcombe, Statistics in Medicine 25 (2006) 559."""
    first, second = np.asarray(first, dtype=float), np.asarray(second, dtype=float)
    value = float((np.sign(first[:, None] - second[None, :]) + 1.0).mean() / 2.0)
    if min(len(first), len(second)) < 2:
        return Estimate(value, None, None)
    others = (len(first) + len(second)) / 2.0 - 1.0
    z = stats.norm.ppf(0.975)

    def excess(share):
        variance = share * (1.0 - share) * (1.0 + others * ((1.0 - share) / (2.0 - share) + share / (1.0 + share))) / (len(first) * len(second))
        return (value - share) ** 2 - z**2 * variance

    # Next to the observed share, where there is a root of its own if that is 0 or 1, the error is too large.
    low, high = (end if value == end else optimize.brentq(excess, end, value + 1e-9 * (end - value)) for end in (0.0, 1.0))
    return Estimate(value, float(low), float(high))


def share_of_larger_pairs(first, second):
    """How often a member of the first sample is larger than that at the same place of the second, with Wilson's interval. Equal pairs are
    left out, as in the signed-rank test."""
    difference = np.asarray(first, dtype=float) - np.asarray(second, dtype=float)
    unequal = int(np.sum(difference != 0.0))
    return share(int(np.sum(difference > 0.0)), unequal) if unequal else Estimate(0.5, None, None)


def signed_rank(first, second):
    """The two-sided p of Wilcoxon's signed-rank test of pairs: how often differences as large come from a distribution symmetric about 0.

    None of one pair: whatever it is, p would be 1. Pairs of equal numbers are left out; where all are equal p is 1. Exact up to 50 of the
    others if no two differences are equally large, else with the normal distribution, corrected for ties.
    """
    differences = np.asarray(first, dtype=float) - np.asarray(second, dtype=float)
    if len(differences) < 2:
        return None
    differences = differences[differences != 0.0]
    if len(differences) == 0:
        return 1.0
    is_exact = len(differences) <= 50 and len(set(np.abs(differences))) == len(differences)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Sample size too small")  # the only way with ties
        return float(stats.wilcoxon(differences, method="exact" if is_exact else "approx").pvalue)
