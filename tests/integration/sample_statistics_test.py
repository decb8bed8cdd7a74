"""Tests paper/sample_statistics.py against examples that are published.

sample_statistics_test.py SOURCES: the folder of the sources. Exit code 77: there is no SciPy.
"""

import collections
import importlib.util
import itertools
import math
import pathlib
import sys
import unittest

SOURCES = pathlib.Path(sys.argv.pop()).resolve()
sys.dont_write_bytecode = True
sys.path.insert(0, str(SOURCES / "paper"))
if importlib.util.find_spec("scipy") is None:
    print("skipped: there is no SciPy (python3-scipy)")
    sys.exit(77)

import sample_statistics as statistics  # noqa: E402


class SampleStatistics(unittest.TestCase):
    def test_changes_of_pairs(self):
        # 8 gained and 1 lost, of 9 that changed: 0, 1, 8 or 9 of 9 fair coins are as far, 2 (1 + 9) of 512. Who keeps it does not count.
        before = [False] * 8 + [True] + [True] * 20
        after = [True] * 8 + [False] + [True] * 20
        self.assertAlmostEqual(statistics.mcnemar(before, after), 20 / 512)
        self.assertEqual(statistics.mcnemar([True, False], [True, False]), 1.0)

    def test_rank_sum_of_membranes(self):
        # Permeability at term and before: Hollander and Wolfe, Nonparametric Statistical Methods (1973), p. 69: one-sided p = 0.1272.
        at_term = [0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46]
        before = [1.15, 0.88, 0.90, 0.74, 1.21]
        self.assertAlmostEqual(statistics.rank_sum(at_term, before), 2 * 0.1272, delta=1e-4)  # the distribution is symmetric
        larger = statistics.share_of_larger(at_term, before)
        self.assertAlmostEqual(larger.value, 35 / 50)  # the statistic W = 35 of 10 times 5 pairs

    def test_rank_sum_of_samples_that_do_not_overlap(self):
        # All 10 of one side are larger: 2 of the C(25, 10) = 3268760 orders are as extreme.
        self.assertAlmostEqual(statistics.rank_sum(range(100, 110), range(15)), 2 / 3268760, delta=1e-12)
        self.assertEqual(statistics.share_of_larger(range(100, 110), range(15)).value, 1.0)

    def test_share_of_larger_counts_ties_half(self):
        self.assertAlmostEqual(statistics.share_of_larger([1, 2, 2], [2, 2, 3]).value, (0 + 0.5 * 4 + 0) / 9)

    def test_share_of_larger_has_an_interval_where_samples_do_not_overlap(self):
        # None of 10 and 10 overlap: (1 - s) / s = 1.96^2 (1 + 9 ((1 - s) / (2 - s) + s / (1 + s))) / 100 at the lower end s = 0.8002.
        found = statistics.share_of_larger(range(100, 110), range(10))
        self.assertEqual((found.value, found.high), (1.0, 1.0))
        s = found.low
        self.assertAlmostEqual(s, 0.8002, delta=1e-4)
        self.assertAlmostEqual((1 - s) / s, 1.959964**2 * (1 + 9 * ((1 - s) / (2 - s) + s / (1 + s))) / 100, delta=1e-6)
        # Of 10 and 5 the mean of both sizes less one, 6.5, is in the error: found on a grid of shares.
        unequal = statistics.share_of_larger([0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46], [1.15, 0.88, 0.90, 0.74, 1.21])
        self.assertAlmostEqual(unequal.low, 0.3893, delta=1e-4)
        self.assertAlmostEqual(unequal.high, 0.8890, delta=1e-4)
        mirrored = statistics.share_of_larger(range(10), range(100, 110))
        self.assertAlmostEqual(mirrored.high, 1 - s)
        self.assertEqual(statistics.share_of_larger([1.0], range(5)).low, None)

    def test_intervals_of_share_of_larger_hold_as_often_as_they_say(self):
        # Of 2000 pairs of normal samples of 10 and 15, whose means differ by 1: a member of the first is larger with probability Phi(1 / sqrt(2)).
        draw = statistics.np.random.default_rng(1)
        truth = statistics.stats.norm.cdf(1 / math.sqrt(2))
        held = sum(found.low <= truth <= found.high for found in (statistics.share_of_larger(draw.normal(1.0, 1.0, 10), draw.normal(0.0, 1.0, 15)) for _ in range(2000)))
        self.assertAlmostEqual(held / 2000, 0.95, delta=0.02)  # four standard deviations of such a count

    def test_share_of_larger_pairs_leaves_out_equal_ones(self):
        found = statistics.share_of_larger_pairs([1, 2, 4, 5], [2, 2, 3, 4])
        self.assertEqual(found, statistics.share(2, 3))
        self.assertEqual(statistics.share_of_larger_pairs([1, 2], [1, 2]), statistics.Estimate(0.5, None, None))

    def test_signed_rank_of_depression(self):
        # Hamilton's depression factor of nine patients before and after a tranquilizer: Hollander and Wolfe (1973), p. 29: the ranks of those
        # that fell sum to 40, one-sided p = 0.0195 (10 of 512 signs are as extreme).
        before = [1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30]
        after = [0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29]
        self.assertAlmostEqual(statistics.signed_rank(before, after), 20 / 512)
        self.assertAlmostEqual(statistics.signed_rank(after, before), 20 / 512)

    def test_signed_rank_sees_pairs_that_the_rank_sum_does_not(self):
        # Each of ten pairs rises by less than pairs differ: 2 of 1024 signs are as extreme, and the samples overlap.
        before = [float(n) for n in range(10)]
        after = [n + 0.5 + 0.01 * n for n in range(10)]
        self.assertAlmostEqual(statistics.signed_rank(after, before), 2 / 1024)
        self.assertGreater(statistics.rank_sum(after, before), 0.4)

    def test_signed_rank_leaves_out_equal_pairs(self):
        self.assertEqual(statistics.signed_rank([1, 2, 3], [1, 2, 3]), 1.0)
        self.assertAlmostEqual(statistics.signed_rank([5, 2, 4, 6], [5, 1, 2, 3]), 2 / 8)
        # Differences 0, 1, 1, -1: ranks 2, 2, 2, sum 4 of falls against a mean of 3 and a variance of 3.5 - (27 - 3) / 48 = 3.
        self.assertAlmostEqual(statistics.signed_rank([5, 2, 3, 3], [5, 1, 2, 4]), math.erfc(1 / math.sqrt(3) / math.sqrt(2)))

    def test_fisher_of_tea(self):
        # A lady tells 3 of 4 cups right on both sides: Fisher, The Design of Experiments (1935), chapter 2: 17 of 70 orders are as extreme
        # on one side.
        self.assertAlmostEqual(statistics.fisher(3, 4, 1, 4), 34 / 70)
        self.assertAlmostEqual(statistics.fisher(4, 4, 0, 4), 2 / 70)

    def test_freeman_halton_with_two_kinds_is_fishers_test(self):
        for counts, others in (((3, 1), (1, 3)), ((4, 0), (0, 4)), ((0, 10), (5, 5)), ((7, 2), (3, 9))):
            self.assertAlmostEqual(statistics.freeman_halton(counts, others), statistics.fisher(counts[0], sum(counts), others[0], sum(others)))

    def test_freeman_halton_counts_tables_that_are_as_improbable(self):
        # Two of two, one, and one: of the six choices two are as improbable as both of the first kind, which is one choice, as is none.
        self.assertAlmostEqual(statistics.freeman_halton((2, 0, 0), (0, 1, 1)), 2 / 6)
        self.assertAlmostEqual(statistics.freeman_halton((1, 1, 0), (1, 0, 1)), 1.0)
        # Ten of twenty, of which five are of the first kind and nine of the second, all choices counted one by one: none of the first and four
        # of the second kind have C(9, 4) C(6, 6) = 126 of them.
        choices = [(sum(n < 5 for n in chosen), sum(5 <= n < 14 for n in chosen)) for chosen in itertools.combinations(range(20), 10)]
        often = collections.Counter(choices)
        self.assertEqual(often[0, 4], 126)
        self.assertAlmostEqual(statistics.freeman_halton((0, 4, 6), (5, 5, 0)), sum(count for count in often.values() if count <= 126) / 184756)

    def test_pairing_counts_permutations(self):
        # Four members that match themselves alone: one of 24 permutations matches as often, and two-sided p is twice that.
        self.assertAlmostEqual(statistics.pairing_p([[row == column for column in range(4)] for row in range(4)]), 2 / 24)
        # All match all: any permutation matches as often.
        self.assertEqual(statistics.pairing_p([[True] * 3] * 3), 1.0)
        self.assertIsNone(statistics.pairing_p([[True]]))
        # Twelve members have too many permutations to list. Each matches itself and the next one: of all permutations only two match
        # everywhere, so that none that is drawn does, and p is the least that there is.
        ring = [[column in (row, (row + 1) % 12) for column in range(12)] for row in range(12)]
        self.assertEqual(statistics.pairing_p(ring), 2 / 100000)
        # Half of the members match all, the others none: whatever the pairs, as many match.
        self.assertEqual(statistics.pairing_p([[row < 6] * 12 for row in range(12)]), 1.0)
        # At two steps the sides are permuted twice: one of 24^2 pairs of permutations leaves all as they are.
        themselves = [[row == column for column in range(4)] for row in range(4)]
        self.assertAlmostEqual(statistics.pairing_p(themselves, themselves), 2 / 24**2)
        # Where all match at the second step, only the first one counts.
        self.assertAlmostEqual(statistics.pairing_p(themselves, [[True] * 4] * 4), 2 / 24)

    def test_geometric_means_are_means_of_logarithms(self):
        doubled = [1.0, 2.0, 4.0, 8.0, 16.0]
        found, logarithms = statistics.geometric_mean(doubled), statistics.mean([0.0, 1.0, 2.0, 3.0, 4.0])
        for end in ("value", "low", "high"):
            self.assertAlmostEqual(getattr(found, end), 2.0 ** getattr(logarithms, end))
        self.assertAlmostEqual(statistics.geometric_means_ratio(doubled, [3.0] * 5).value, 4.0 / 3.0)
        self.assertEqual(statistics.geometric_mean([2.0, 8.0]).low, None, "too few")

    def test_ratios_of_geometric_means_lie_in_their_intervals(self):
        # Two samples of fifteen, whose means are 1.5 times apart: 95 of 100 intervals have it inside, those of a bootstrap some fewer.
        draw = statistics.np.random.default_rng(2)
        found = [statistics.geometric_means_ratio(1.5 * draw.lognormal(0.0, 0.2, 15), draw.lognormal(0.0, 0.2, 15)) for _ in range(100)]
        held = sum(one.low <= 1.5 <= one.high for one in found)
        self.assertGreaterEqual(held, 86)  # of 92 in 100, fewer come once in fifty times
        self.assertLess(held, 100)

    def test_one_member_has_no_p(self):
        self.assertIsNone(statistics.rank_sum([1.0], range(15)))
        self.assertIsNone(statistics.signed_rank([2.0], [1.0]))
        self.assertEqual([statistics.tells_apart(p) for p in (None, 0.049, 0.05)], [False, True, False])

    def test_spearman_of_tuna(self):
        # Hunter's L and panel scores of canned tuna: Hollander and Wolfe (1973), p. 185: the squares of rank differences sum to 48.
        lightness = [44.4, 45.9, 41.9, 53.3, 44.7, 44.1, 50.7, 45.2, 60.1]
        score = [2.6, 3.1, 2.5, 5.0, 3.6, 4.0, 5.2, 2.8, 3.8]
        found = statistics.spearman(lightness, score)
        self.assertAlmostEqual(found.value, 1 - 6 * 48 / (9 * 80))
        self.assertLess(found.low, found.value)
        self.assertGreater(found.high, found.value)

    def test_spearman_of_equal_values_is_none(self):
        self.assertIsNone(statistics.spearman([1, 1, 1, 1], [1, 2, 3, 4]).low)

    def test_shares_by_wilson(self):
        # Newcombe, Statistics in Medicine 17 (1998) 857, table I, method 3
        for count, of, low, high in ((81, 263, 0.2553, 0.3662), (15, 148, 0.0624, 0.1605), (0, 20, 0.0, 0.1611), (1, 29, 0.0061, 0.1718)):
            found = statistics.share(count, of)
            self.assertAlmostEqual(found.low, low, delta=5e-5)
            self.assertAlmostEqual(found.high, high, delta=5e-5)

    def test_differences_of_shares_by_newcombe(self):
        # Newcombe, Statistics in Medicine 17 (1998) 873, table II, method 10
        for count, of, other, of_others, low, high in ((56, 70, 48, 80, 0.0524, 0.3339), (9, 10, 3, 10, 0.1705, 0.8090), (6, 7, 2, 7, 0.0582, 0.8062),
                                                       (5, 56, 0, 29, -0.0381, 0.1926), (0, 10, 0, 20, -0.1611, 0.2775), (10, 10, 0, 20, 0.6791, 1.0)):
            found = statistics.difference_of_shares(count, of, other, of_others)
            self.assertAlmostEqual(found.value, count / of - other / of_others)
            self.assertAlmostEqual(found.low, low, delta=5e-5)
            self.assertAlmostEqual(found.high, high, delta=5e-5)

    def test_a_verdict_is_open_where_the_interval_has_the_number_inside(self):
        for low, high, verdict in ((0.6, 0.9, "yes"), (0.1, 0.4, "no"), (0.49, 0.94, "open"), (0.5, 0.9, "open"), (None, None, "open")):
            self.assertEqual(statistics.verdict(statistics.Estimate(0.5, low, high), 0.5), verdict)

    def test_mean_of_mice(self):
        # Survival of treated mice: Efron and Tibshirani, An Introduction to the Bootstrap (1993), chapter 2: mean 86.86, standard error
        # of the bootstrap 23.36. The interval of a normal distribution of this width is 41 to 133; that of the bootstrap leans to the
        # right as the sample does.
        found = statistics.mean([94, 197, 16, 38, 99, 141, 23])
        self.assertAlmostEqual(found.value, 86.86, delta=0.005)
        self.assertAlmostEqual((found.high - found.low) / (2 * 1.96), 23.36, delta=1.2)  # 5 %: 2000 resamples, and not quite normal
        self.assertEqual(found, statistics.mean([94, 197, 16, 38, 99, 141, 23]), "the same sample gives the same interval")

    def test_one_member_has_no_interval(self):
        self.assertEqual(statistics.mean([3.0]), statistics.Estimate(3.0, None, None))


if __name__ == "__main__":
    unittest.main()
