"""Tests the scripts of paper/discrepancies, paper/scale_invariance and paper/fractal/trials.py on robots that are made up, so that what
they must find is known.

paper_scales_test.py SOURCES: the folder of the sources. Exit code 77: there is no SciPy or matplotlib.
"""

import csv
import importlib.util
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
import xml.dom.minidom

SOURCES = pathlib.Path(sys.argv.pop()).resolve()
for package in ("scipy", "matplotlib"):
    if importlib.util.find_spec(package) is None:
        print(f"skipped: there is no python3-{package}")
        sys.exit(77)


def table_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


def write(file, columns, rows):
    file.parent.mkdir(parents=True, exist_ok=True)
    with open(file, "w", newline="", encoding="utf-8") as text:
        out = csv.writer(text)
        out.writerow(columns)
        out.writerows(rows)


def body(number):
    """Bodies that differ: the digits of a number in base 3, of at least three cells."""
    digits = "111"
    for _ in range(24):
        digits += str(number % 3)
        number //= 3
    return digits


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name)
        for name in ("sample_statistics.py", "small_tables.py", "svg_figure.py", "discrepancies/discrepancies.py", "discrepancies/population.toml",
                     "discrepancies/variants.toml", "scale_invariance/scale_invariance.py", "fractal/trials.py"):
            place = self.tree / "paper" / name
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(SOURCES / "paper" / name, place)

    def call(self, script, *words):
        return subprocess.run([sys.executable, "-B", str(self.tree / "paper" / script), *map(str, words)], capture_output=True, text=True, check=False)

    def done(self, script, *words):
        outcome = self.call(script, *words)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return outcome.stdout

    def refused(self, message, script, *words):
        outcome = self.call(script, *words)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn(message, outcome.stderr)


class Discrepancies(Case):
    script = "discrepancies/discrepancies.py"

    def folder(self):
        return self.tree / "paper/discrepancies"

    def individuals(self, ends):
        """What menger export writes of 520 robots, of which every 26th is the one before again. ends: of a robot's number, by level"""
        rows = []
        for n in range(520):
            rows.append([n, body(n - 1 if n % 26 == 25 else n), *ends(n)])
        file = self.tree / "individuals.csv"
        write(file, ["individual", "phenotype", "level_1_dx_m", "level_1_dy_m", "level_2_dx_m", "level_2_dy_m"], rows)
        return file

    def test_a_study_has_one_thing_changed(self):
        self.done(self.script, "study", "half_step", self.tree / "out/half_step.toml")
        study = tomllib.loads((self.tree / "out/half_step.toml").read_text())
        plain = tomllib.loads((SOURCES / "paper/discrepancies/population.toml").read_text())
        self.assertEqual(study["integration"].pop("time_step_fraction"), 0.45)
        self.assertEqual(study, plain)
        self.refused("there is no variant ham; there are text", self.script, "study", "ham", self.tree / "ham.toml")

    def test_every_variant_with_walks_has_its_part(self):
        experiment = (SOURCES / "paper/discrepancies/experiment.sh").read_text()
        variants = tomllib.loads((SOURCES / "paper/discrepancies/variants.toml").read_text())
        names = [name for name, one in variants.items() if "walks_of" not in one]
        self.assertEqual(names[0], "text")
        self.assertIn("for variant in " + " ".join(names) + ";", experiment)

    def test_finds_what_a_change_does(self):
        far = lambda n: 1e-3 * (n + 1)  # noqa: E731
        same = self.individuals(lambda n: (far(n), 0.0, 0.0, 2.0 * far(n)))
        for name in ("text", "duration"):
            self.done(self.script, "take", same, name)
        # All walk the other way round at level 1, and the shortest are the longest there: level 1 decides in body lengths.
        turned = self.individuals(lambda n: (-far(519 - n), 0.0, 0.0, 600.0))
        self.done(self.script, "take", turned, "no_drag")
        self.done(self.script, "summary")
        self.assertEqual(len(table_of(self.folder() / "walks/text.csv")), 500)
        rows = {row["variant"]: row for row in table_of(self.folder() / "statistics.csv")}
        self.assertEqual(list(rows), ["duration", "score", "no_drag"], "those whose walks are there")
        self.assertEqual((rows["duration"]["fitness_spearman"], rows["duration"]["another_best_of_ten"]), ("1", "0"))
        self.assertEqual(rows["duration"]["level_2_median_change"], "0")
        # Squared metres over 3 and 9 keep the order of robots that go twice as far at level 2.
        self.assertEqual(rows["score"]["fitness_spearman"], "1")
        self.assertAlmostEqual(float(rows["no_drag"]["fitness_spearman"]), -1.0, delta=0.001)
        self.assertEqual(rows["no_drag"]["another_best_of_ten"], "1")
        self.assertEqual(rows["no_drag"]["best_tenth_in_common"], "0")
        concluded = {row["variant"]: row for row in table_of(self.folder() / "conclusions.csv")}
        # Twice the distance is two thirds of the body lengths.
        self.assertEqual(concluded["text"]["larger_is_slower"], "1")
        self.assertAlmostEqual(float(concluded["text"]["speed_factor"]), 2.0 / 3.0, delta=1e-4)
        xml.dom.minidom.parse(str(self.folder() / "discrepancies.svg"))

    def test_says_what_is_missing(self):
        self.refused("text.csv: is not there", self.script, "summary")
        few = self.tree / "few.csv"
        write(few, ["individual", "phenotype"], [[1, body(1)]])
        self.refused("only 1 bodies differ", self.script, "take", few, "text")


class ScaleInvariance(Case):
    script = "scale_invariance/scale_invariance.py"

    def test_finds_who_carries_over(self):
        # Of 40 random robots the first 30 go on as they did, three times as far in metres; the others turn by 90 degrees.
        rows = []
        for n in range(40):
            ends = []
            for level in (1, 2, 3):
                far, turn = 0.002 * (n + 1) * 3**level, 0.5 * math.pi * (level - 1) if n >= 30 else 0.0
                ends += [far * math.cos(turn), far * math.sin(turn)]
            rows.append([n, body(n), *ends])
        columns = ["individual", "phenotype"] + [f"level_{level}_d{axis}_m" for level in (1, 2, 3) for axis in "xy"]
        write(self.tree / "individuals.csv", columns, rows + [[40, body(0), *rows[0][2:]], [41, body(99), "", "", "", "", "", ""], [42, body(50), 0.0, 0.0, 0.02, 0.0, 0.06, 0.0]])
        self.done(self.script, "random", self.tree / "individuals.csv")
        folder = self.tree / "paper/scale_invariance"
        self.assertEqual(len(table_of(folder / "robots.csv")), 41, "each body once, and only those that ended their walks")
        # A champion that is three times too fast at level 2, and a failure at level 3.
        for level, moved in ((1, [0.01, 0.0, 0.0]), (2, [0.09, 0.0, 0.0]), (3, None)):
            place = self.tree / f"champion/level_{level}"
            place.mkdir(parents=True)
            (place / "result.toml").write_text(f"displacement_m = {moved}\n" if moved else 'status = "diverged"\n')
        write(self.tree / "champion/lineage.csv", ["individual", "phenotype"], [[3, body(3)], [7, body(7)]])
        for _ in range(2):  # the second takes the place of the first
            self.done(self.script, "champion", self.tree / "champion", "one_scale", "4")
        self.done(self.script, "summary")
        found = {(row["group"], row["levels"]): row for row in table_of(folder / "statistics.csv")}
        self.assertEqual(set(found), {("random", "1 to 2"), ("random", "2 to 3"), ("one_scale", "1 to 2")})
        chance = found["random", "1 to 2"]
        # The last one stands still at level 1, and goes on as it did from level 2.
        self.assertEqual(found["random", "2 to 3"]["robots"], "41")
        self.assertEqual((chance["robots"], chance["carried_over"], chance["same_way"], chance["speed_factor"]), ("40", "0.75", "0.75", "1"))
        self.assertLess(float(chance["by_chance"]), 0.5)
        champion = found["one_scale", "1 to 2"]
        self.assertEqual((champion["robots"], champion["carried_over"], champion["same_way"], champion["speed_factor"]), ("1", "0", "1", "3"))
        self.assertTrue(table_of(folder / "dimension.csv"))
        xml.dom.minidom.parse(str(folder / "scale_invariance.svg"))

    def test_refuses_what_it_does_not_know(self):
        self.refused("ham: must be one of random, one_scale", self.script, "champion", self.tree, "ham", "1")
        self.refused("result.toml: cannot be read", self.script, "champion", self.tree, "one_scale", "1")


class Trials(Case):
    script = "fractal/trials.py"
    columns = ["generation", "best_fitness_body_lengths", "champion_cells", "hausdorff_dimension", "level_1_displacement_body_lengths",
               "level_2_displacement_body_lengths"]

    def trial(self, folder, seed, last, cells=9):
        dimension = math.log(cells) / math.log(3)
        rows = [[0, "", "", "", "", ""], [1, 0.1 + 0.001 * seed, 3, 1.0, 0.2, 0.1], [2, last, cells, dimension, 2.0 * last, last]]
        write(self.tree / "paper" / folder / f"{seed}.csv", self.columns, rows)

    def test_finds_which_arm_is_better(self):
        self.refused("has no trial yet", self.script)
        for seed in range(1, 11):
            self.trial("fractal/two_scales", seed, 1.0 + 0.01 * seed, 9 if seed < 6 else 17)
        for seed in range(1001, 1016):
            self.trial("non_fractal/two_scales", seed, 0.5 + 0.0001 * seed)
        self.done(self.script)
        folder = self.tree / "paper/fractal"
        compared = table_of(folder / "comparisons.csv")
        self.assertEqual([row["arms"] for row in compared], ["fractal and non_fractal"])
        self.assertAlmostEqual(float(compared[0]["p"]), 2 / math.comb(25, 10), delta=1e-9)  # no overlap
        self.assertEqual(compared[0]["larger"], "1")
        found = {row["arm"]: row for row in table_of(folder / "statistics.csv")}
        fractal = found["fractal"]
        self.assertAlmostEqual(float(fractal["last"]), 12 * 1.055, delta=0.01)  # body lengths in 5 s, a minute has 12 of them
        self.assertEqual((fractal["trials"], fractal["first"], fractal["plane"], fractal["dimension_2.5_to_2.7"]), ("10", "0", "5", "5"))
        self.assertEqual(fractal["larger_is_slower"], "1")
        self.assertLess(float(fractal["p_first_last"]), 1e-3)
        self.assertEqual(len(table_of(folder / "champions.csv")), 25)
        xml.dom.minidom.parse(str(folder / "trials.svg"))

    def test_refuses_trials_of_unlike_lengths(self):
        self.trial("fractal/two_scales", 1, 1.0)
        self.trial("fractal/two_scales", 2, 1.0)
        with open(self.tree / "paper/fractal/two_scales/2.csv", "a", encoding="utf-8") as text:
            text.write("3,1,9,2,1,1\n")
        self.refused("have different numbers of generations", self.script)


if __name__ == "__main__":
    unittest.main()
