"""Statistics of samples with 95 % intervals, by SciPy.

Bootstraps have a fixed seed, so that the same sample gives the same interval.
"""

import sys
import warnings
from dataclasses import dataclass

try:
    import numpy as np
    from scipy import stats
except ImportError as error:
    sys.exit(f"{error}: statistics of experiments need SciPy: apt-get install python3-scipy")

RESAMPLES = 2000
SEED = 1


@dataclass(frozen=True)
class Estimate:
    """A number and its interval; the ends are None where the sample gives none, as if all its members are equal."""

    value: float
    low: float | None
    high: float | None


def bootstrap(statistic, *samples, paired=False):
    """The statistic of one or more samples, with the percentiles of a bootstrap. `paired`: their members are drawn together."""
    samples = [np.asarray(sample, dtype=float) for sample in samples]
    value = float(statistic(*samples))
    if min(len(sample) for sample in samples) < 2:
        return Estimate(value, None, None)
    found = stats.bootstrap(samples, statistic, n_resamples=RESAMPLES, paired=paired, method="percentile",
                            random_state=np.random.default_rng(SEED)).confidence_interval
    ends = (float(found.low), float(found.high))
    return Estimate(value, *ends) if np.all(np.isfinite(ends)) else Estimate(value, None, None)


def mean(sample):
    return bootstrap(np.mean, sample)


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


# What a verdict on something that the paper says means, if yes is its side.
OUTCOMES = {"yes": "reproduced", "no": "not reproduced", "open": "open"}
LARGEST_P = 0.05  # with which a test tells groups apart


def verdict(estimate, against):
    """Whether a number is above another one: yes, no (it is below), or open, as its interval has the other one inside or is not known."""
    if estimate.low is None or estimate.high is None or estimate.low <= against <= estimate.high:
        return "open"
    return "yes" if estimate.low > against else "no"


def fisher(count, of, other_count, of_others):
    """The two-sided p of Fisher's exact test: how often two shares of equal trials differ as much."""
    return float(stats.fisher_exact([[count, of - count], [other_count, of_others - other_count]])[1])


@dataclass(frozen=True)
class RankSum:
    """Wilcoxon's rank-sum test of two samples, also called Mann and Whitney's."""

    p: float  # two-sided: how often equal distributions differ as much
    larger: Estimate  # how often a member of the first sample is larger than one of the second, ties counted half


def rank_sum(first, second):
    """The exact test up to 25 members on a side if no two are equal, else with the normal distribution, corrected for ties."""
    tied = len(set(first) | set(second)) < len(first) + len(second)
    method = "asymptotic" if tied or max(len(first), len(second)) > 25 else "exact"
    p = float(stats.mannwhitneyu(first, second, alternative="two-sided", method=method).pvalue)

    def larger(a, b):
        return (np.sign(a[:, None] - b[None, :]) + 1.0).mean() / 2.0

    return RankSum(p, bootstrap(larger, first, second))


def signed_rank(first, second):
    """The two-sided p of Wilcoxon's signed-rank test of pairs: how often differences as large come from a distribution symmetric about 0.

    Pairs of equal numbers are left out; where all are equal p is 1. Exact up to 50 of the others if no two differences are equally
    large, else with the normal distribution, corrected for ties.
    """
    differences = np.asarray(first, dtype=float) - np.asarray(second, dtype=float)
    differences = differences[differences != 0.0]
    if len(differences) == 0:
        return 1.0
    is_exact = len(differences) <= 50 and len(set(np.abs(differences))) == len(differences)
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Sample size too small")  # the only way with ties
        return float(stats.wilcoxon(differences, method="exact" if is_exact else "approx").pvalue)
