"""Tests paper/proof/proof.py on searches that are made up, so that what it must find is known.

proof_test.py SOURCES: the folder of the sources.
"""

import contextlib
import csv
import itertools
import pathlib
import random
import re
import sqlite3
import subprocess
import sys
import tempfile
import tomllib
import unittest
import xml.dom.minidom

SOURCES = pathlib.Path(sys.argv.pop()).resolve()
EXPERIMENT = SOURCES / "paper" / "proof"
sys.dont_write_bytecode = True
sys.path.insert(0, str(EXPERIMENT))

import proof  # noqa: E402


def table_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


class Statistics(unittest.TestCase):
    def test_rank_sums_of_known_tables(self):
        # all of one above all of the other: 2 of the 20 arrangements of three and three, 2 of 184756 of ten and ten
        self.assertAlmostEqual(proof.rank_sum_p([4, 5, 6], [1, 2, 3]), 0.1)
        self.assertAlmostEqual(proof.rank_sum_p([1, 2, 3], [4, 5, 6]), 0.1)
        self.assertAlmostEqual(proof.rank_sum_p(list(range(10, 20)), list(range(10))), 2 / 184756)
        # R: wilcox.test(c(1.1, 2.2, 3.3, 0.4), c(1.0, 0.3, 0.2, 0.1), exact = TRUE)
        self.assertAlmostEqual(proof.rank_sum_p([1.1, 2.2, 3.3, 0.4], [1.0, 0.3, 0.2, 0.1]), 4 / 70)
        self.assertIsNone(proof.rank_sum_p([], [1]))

    def test_equal_values_share_their_rank(self):
        self.assertEqual(proof.rank_sum_p([1, 1, 1], [1, 1, 1]), 1.0)
        # ranks 1.5 1.5 3 and 4: the pair with 4 has 5.5 or 7; its mean is 5: {4, 3} and {1.5, 1.5} are as far of 6 pairs
        self.assertAlmostEqual(proof.rank_sum_p([3, 4], [0, 0]), 2 / 6)

    def test_rank_sums_are_right_about_chance(self):
        draw = random.Random(3)
        found = [proof.rank_sum_p([draw.random() for _ in range(5)], [draw.random() for _ in range(5)]) for _ in range(800)]
        self.assertLess(sum(p <= 0.05 for p in found) / len(found), 0.05)
        self.assertGreater(sum(p <= 0.05 for p in found) / len(found), 0.005)

    def test_several_tests_by_holms_method(self):
        # Holm 1979, doi 10.2307/4615733: the least times 3, the next times 2, never falling
        self.assertEqual([round(p, 12) for p in proof.holm([0.01, 0.04, 0.03])], [0.03, 0.06, 0.06])
        self.assertEqual([p and round(p, 12) for p in proof.holm([None, 0.01, 0.04])], [None, 0.03, 0.08], "a test that is still to come counts")
        self.assertEqual(proof.holm([0.5, 0.6]), [1.0, 1.0])

    def test_more_searches_than_an_exact_test_takes_are_refused(self):
        with self.assertRaises(proof.InputError):
            proof.rank_sum_p(list(range(12)), list(range(12)))

    def test_superiority(self):
        self.assertEqual(proof.superiority([2, 3], [0, 1]), 1.0)
        self.assertEqual(proof.superiority([1, 2], [1, 2]), 0.5)
        self.assertEqual(proof.superiority([0], [1, 2]), 0.0)

    def test_intervals_hold_what_they_are_of(self):
        draw = random.Random(5)
        a, b = ([draw.gauss(mean, 1.0) for _ in range(10)] for mean in (2.0, 0.0))
        low, high = proof.interval_of_two(a, b, proof.difference_of_medians)
        self.assertLess(low, proof.difference_of_medians(a, b))
        self.assertGreater(high, proof.difference_of_medians(a, b))
        self.assertGreater(low, 0.0)
        self.assertEqual((low, high), proof.interval_of_two(a, b, proof.difference_of_medians))


class Studies(unittest.TestCase):
    def test_all_arms_have_the_same_budget_and_robots(self):
        size = proof.read_toml(EXPERIMENT / "size.toml")
        texts = {arm: tomllib.loads(proof.study_text(arm, 7, size, EXPERIMENT)) for arm in proof.ARMS}
        elements = texts["elements"]
        for arm, study in texts.items():
            self.assertEqual(study["budget"]["element_steps"], elements["budget"]["element_steps"])
            self.assertEqual(study["drive"], elements["drive"])
            self.assertEqual(study["time"], elements["time"])
            for key in ("measure", "measure_periods", "stand"):
                self.assertEqual(study["evaluation"][key], elements["evaluation"][key], arm)
        self.assertEqual(len({study["seed"] for study in texts.values()}), len(proof.ARMS), "arms do not begin with the same robots")
        self.assertEqual(texts["both"]["robust"], elements["robust"])
        self.assertEqual(texts["voxels_robust"]["robust"]["frictions"], elements["robust"]["frictions"])
        self.assertEqual(texts["both"]["elements"], elements["elements"])
        friction = texts["voxels"]["ground"]["static_friction"]
        self.assertEqual(sorted(elements["robust"]["frictions"])[1], friction, "voxels have the middle friction")
        judge = tomllib.loads((EXPERIMENT / "fine.toml").read_text())
        self.assertEqual(judge["robust"], elements["robust"])
        self.assertEqual(judge["elements"], elements["elements"] | {"fidelity": "fine"})
        layers = tomllib.loads((EXPERIMENT / "two_layers.toml").read_text())
        for table in ("evaluation", "body", "time", "drive"):
            self.assertEqual(layers[table], judge[table], table)
        loss = {"loss_factor": judge["robust"]["loss_factors"][0], "loss_frequency_Hz": 30}  # the one that [robust] assumes
        self.assertEqual(layers["material"], judge["material"] | loss)
        self.assertIn(layers["ground"]["static_friction"], judge["robust"]["frictions"])
        dampings = tomllib.loads((EXPERIMENT / "dampings.toml").read_text())
        assumed = judge["robust"]["loss_factors"][0]
        self.assertTrue(min(dampings["robust"]["loss_factors"]) < assumed < max(dampings["robust"]["loss_factors"]))
        self.assertEqual(dampings | {"robust": judge["robust"]}, judge, "all else is as fine.toml has it")
        self.assertEqual(layers["ground"]["static_friction"], layers["ground"]["kinetic_friction"])
        self.assertEqual(layers["elements"], {"kind": "three_field", "elements_through_wall": 2})

    def test_aggregates_are_bounded_and_judged_as_such(self):
        size = proof.read_toml(EXPERIMENT / "modules_size.toml")
        for text in (proof.study_text("voxels", 1, size, EXPERIMENT), proof.study_text("elements", 1, size, EXPERIMENT),
                     *(proof.text_with_bodies(judge, size) for judge in proof.JUDGES)):
            body = tomllib.loads(text)["body"]
            self.assertEqual((body["levels"], body["largest_body_cells"]), ([2], 5))
        with tempfile.TemporaryDirectory() as tables:
            asked = subprocess.run([sys.executable, str(EXPERIMENT / "proof.py"), "missing", tables, "1", str(EXPERIMENT / "modules_size.toml")],
                                   capture_output=True, text=True, check=True)
            self.assertEqual(asked.stdout.split(), ["voxels", "elements"])
            for name, level in (("modules_size", "2"), ("size", "1")):
                asked = subprocess.run([sys.executable, str(EXPERIMENT / "proof.py"), "level", str(EXPERIMENT / f"{name}.toml")],
                                       capture_output=True, text=True, check=True)
                self.assertEqual(asked.stdout.strip(), level)
        self.assertEqual(proof.text_with_bodies("fine", proof.read_toml(EXPERIMENT / "size.toml")), (EXPERIMENT / "fine.toml").read_text())

    def test_the_budget_is_counted_in_steps(self):
        size = proof.read_toml(EXPERIMENT / "size.toml")
        costs = proof.costs()
        steps = tomllib.loads(proof.study_text("elements", 1, size, EXPERIMENT))["budget"]["element_steps"]
        seconds = steps * 1e-9 * costs["nanoseconds_per_element_step"]
        self.assertAlmostEqual(seconds / (120.0 * size["minutes_of_two_cores"]), 1.0, 5)

    def test_parameters_are_found_from_another_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            size = proof.read_toml(EXPERIMENT / "trial_size.toml")
            study = tomllib.loads(proof.study_text("both", 1, size, pathlib.Path(folder)))
            self.assertTrue((pathlib.Path(folder) / study["surrogate"]["parameters"]).exists())


class Searches(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.results = pathlib.Path(folder.name) / "results"
        self.tables = pathlib.Path(folder.name) / "tables"
        self.tables.mkdir()

    LAYERS = "rank individual friction dx_m dy_m body_lengths reason"

    def put(self, name, columns, rows):
        file = self.results / name
        file.parent.mkdir(parents=True, exist_ok=True)
        with open(file, "w", newline="", encoding="utf-8") as text:
            csv.writer(text).writerows([columns.split(), *rows])

    def call(self, *words):
        return subprocess.run([sys.executable, str(EXPERIMENT / "proof.py"), *map(str, words)], capture_output=True, text=True, check=False)

    def make(self, arm, seed, best):
        """A search of two generations, each of which has another champion."""
        name = f"{arm}_{seed}"
        study = self.results / "studies" / f"{name}.toml"
        self.assertEqual(self.call("study", arm, seed, EXPERIMENT / "trial_size.toml", study).returncode, 0)
        self.put(f"{name}/generations.csv", "generation champion best_fitness_body_lengths evaluations", [[0, 5, 0.1, 15], [1, 9, 0.2, 16]])
        self.put(f"{name}/costs.csv", "generation voxel_steps element_steps", [[0, 0, 1e6], [1, 0, 2e6]])
        columns = "rank individual design cells phenotype score_body_lengths friction dx_m dy_m body_lengths reason"
        self.put(f"{name}.fine.csv", columns, [[1, 9, "a", 20, "110", "", 0.4, "", "", "", "it fell"], [1, 9, "a", 20, "110", "", 0.8, 0.01, 0, 0.3, ""],
                                               [2, 5, "b", 19, "101", best, 0.4, 0, 0.03, best, ""], [2, 5, "b", 19, "101", best, 0.8, 0, 0.04, 0.5, ""]])
        if arm in proof.ON_ELEMENTS:
            self.put(f"{name}.layers.csv", self.LAYERS, [[1, 5, 0.8, 0.04, 0.04, 0.25, ""]])
        self.put(f"{name}.champions.csv", columns, [[1, 5, "b", 19, "101", 0.03, 0.4, 0, 0, 0.03, ""], [2, 9, "a", 20, "110", "", 0.4, "", "", "", "it fell"]])

    def test_a_finished_search_is_not_missing_any_more(self):
        self.assertEqual(self.call("missing", self.tables, 1, EXPERIMENT / "size.toml").stdout.split(), list(proof.ARMS))
        self.make("elements", 1, 0.07)
        taken = self.call("take", self.results, self.tables, "elements", 1)
        self.assertEqual(taken.returncode, 0, taken.stderr)
        self.assertEqual(self.call("missing", self.tables, 1, EXPERIMENT / "size.toml").stdout.split(), ["voxels", "both", "voxels_robust"])
        self.assertEqual(self.call("missing", self.tables, 2, EXPERIMENT / "size.toml").stdout.split(), list(proof.ARMS))
        row, = table_of(self.tables / "outcomes.csv")
        self.assertEqual(row["best_body_lengths"], "0.07")
        self.assertEqual(row["individual"], "5")
        self.assertEqual(row["phenotype"], "101", "from which the robot can be made without its archive")
        self.assertEqual(row["first_body_lengths"], "0", "a robot without a score does not walk")
        self.assertEqual(float(row["cost_element_steps"]), 3e6)
        self.assertEqual(row["evaluations"], "31")
        again = (self.tables / "outcomes.csv").read_text()
        self.call("take", self.results, self.tables, "elements", 1)
        self.assertEqual((self.tables / "outcomes.csv").read_text(), again, "it is there once")

    def test_what_voxels_cost_is_counted_in_element_steps(self):
        self.make("voxels", 1, 0.01)
        self.put("voxels_1/costs.csv", "generation voxel_steps element_steps", [[0, 1e6, 0], [1, 1e6, 0]])
        self.assertEqual(self.call("take", self.results, self.tables, "voxels", 1).returncode, 0)
        ratio = proof.budget_in(self.results / "studies/voxels_1.toml")["voxel_steps_per_element_step"]
        self.assertAlmostEqual(float(table_of(self.tables / "outcomes.csv")[0]["cost_element_steps"]) * ratio / 2e6, 1.0, 5)
        progress = table_of(self.tables / "progress.csv")
        self.assertEqual([row["body_lengths"] for row in progress], ["0.03", "0"], "as finite elements say, not voxels")

    def test_champions_of_one_body_have_its_score(self):
        self.make("voxels", 1, 0.01)
        self.put("voxels_1/generations.csv", "generation champion best_fitness_body_lengths evaluations", [[0, 5, 0.1, 15], [1, 9, 0.1, 16]])
        self.put("voxels_1.champions.csv", "rank individual design cells fitness_body_lengths score_body_lengths friction", [[1, 5, "b", 19, 0.1, 0.03, 0.4]])
        taken = self.call("take", self.results, self.tables, "voxels", 1)
        self.assertEqual(taken.returncode, 0, taken.stderr)
        self.assertEqual([row["body_lengths"] for row in table_of(self.tables / "progress.csv")], ["0.03", "0.03"])
        self.put("voxels_1/generations.csv", "generation champion best_fitness_body_lengths evaluations", [[0, 5, 0.1, 15], [1, 9, 0.2, 16]])
        self.assertIn("has no row of individual 9", self.call("take", self.results, self.tables, "voxels", 1).stderr)

    def test_few_of_many_champions_walk_on_elements(self):
        champions = [(n, 1e6 * (n + 1), str(n), 0.1) for n in range(5000)]
        drawn = proof.drawn_champions(champions)
        self.assertLessEqual(len(drawn), proof.CHAMPIONS)
        self.assertGreater(len(drawn), proof.CHAMPIONS // 2)
        self.assertEqual([drawn[0], drawn[-1]], [champions[0], champions[-1]])
        factors = [after[1] / before[1] for before, after in itertools.pairwise(drawn[-10:])]
        self.assertLess(max(factors) / min(factors), 1.01, "evenly apart on a logarithmic axis")
        self.assertEqual(proof.drawn_champions(champions[:1]), champions[:1])
        self.assertEqual(proof.drawn_champions([]), [])

    def test_tests_effects_and_picture(self):
        for seed in range(1, 6):
            for arm, best in (("voxels", 0.01 * seed), ("elements", 0.2 + 0.01 * seed), ("both", 0.15 + 0.02 * seed),
                              ("voxels_robust", 0.1 + 0.01 * seed)):
                self.make(arm, seed, best)
                self.assertEqual(self.call("take", self.results, self.tables, arm, seed).returncode, 0)
        summary = self.call("summary", self.tables)
        self.assertEqual(summary.returncode, 0, summary.stderr)
        rows = {(row["arm"], row["than"]): row for row in table_of(self.tables / "statistics.csv")}
        self.assertAlmostEqual(float(rows["elements", "voxels"]["rank_sum_p"]), 2 / 252, 6)
        self.assertAlmostEqual(float(rows["elements", "voxels"]["holm_p"]), 3 * 2 / 252, 6)
        self.assertAlmostEqual(float(rows["elements", "voxels_robust"]["holm_p"]), 3 * 2 / 252, 6, "corrected apart from the planned ones")
        self.assertEqual(float(rows["elements", "voxels"]["superiority"]), 1.0)
        self.assertEqual(rows["elements", "voxels"]["superiority_low"], "", "groups apart have no interval by resampling")
        self.assertNotEqual(rows["both", "elements"]["superiority_low"], "")
        self.assertAlmostEqual(float(rows["elements", "voxels"]["difference_body_lengths"]), 0.2)
        self.assertAlmostEqual(float(rows["both", "elements"]["difference_body_lengths"]), -0.02)
        self.assertLess(float(rows["both", "elements"]["difference_low"]), 0.0)
        first = {(row["arm"], row["than"]): row for row in table_of(self.tables / "first.csv")}
        judged = table_of(self.tables / "outcomes.csv")
        of_elements = sorted(float(row["first_body_lengths"]) for row in judged if row["arm"] == "elements")
        self.assertAlmostEqual(float(first["elements", "voxels"]["median_body_lengths"]), of_elements[2])
        walks = [row for row in table_of(self.tables / "walks.csv") if row["arm"] == "voxels" and row["seed"] == "1"]
        frictions = {row["friction"] for row in walks}
        by_friction = {(row["arm"], row["friction"]): row for row in table_of(self.tables / "by_friction.csv")}
        self.assertEqual({friction for arm, friction in by_friction if arm == "voxels"}, frictions | {"worst"})
        self.assertEqual(by_friction["voxels", "worst"]["searches"], "5")
        for friction in frictions:
            self.assertLessEqual(float(by_friction["voxels", "worst"]["first_body_lengths"]), float(by_friction["voxels", friction]["first_body_lengths"]))
        picture = (self.tables / "proof.svg").read_text()
        xml.dom.minidom.parseString(picture)
        for colour, _ in proof.STYLES.values():
            self.assertIn(colour, picture)
        self.call("summary", self.tables)
        self.assertEqual((self.tables / "proof.svg").read_text(), picture, "the same searches give the same bytes")

    def test_what_screening_did_is_counted(self):
        for seed in (1, 2):
            self.make("both", seed, 0.3)
            with contextlib.closing(sqlite3.connect(self.results / f"both_{seed}.sqlite")) as archive, archive:
                archive.execute("CREATE TABLE screening (id INTEGER, generation INTEGER, outcome TEXT)")
                archive.execute("CREATE TABLE contender (id INTEGER, generation INTEGER, survivor_rank INTEGER)")
                outcomes = ["passed"] * 4 + ["drawn"] * 2 + ["left out"] * (2 * seed)
                archive.executemany("INSERT INTO screening VALUES (?, 1, ?)", enumerate(outcomes))
                # the first three survive, which passed, and the fifth, which was drawn; in the next generation all do
                archive.executemany("INSERT INTO contender VALUES (?, 1, ?)", [(n, n if n in (0, 1, 2, 4) else None) for n in range(len(outcomes))])
                archive.executemany("INSERT INTO contender VALUES (?, 2, 0)", [(n,) for n in range(len(outcomes))])
                archive.execute("INSERT INTO screening VALUES (99, 0, 'passed')")  # of the first generation
                archive.execute("INSERT INTO contender VALUES (99, 0, 0)")
            taken = self.call("take", self.results, self.tables, "both", seed)
            self.assertEqual(taken.returncode, 0, taken.stderr)
        first = table_of(self.tables / "screening.csv")[0]
        self.assertEqual([first[key] for key in proof.SCREENING[2:]], ["4", "2", "2", "3", "1"])
        self.assertEqual(self.call("summary", self.tables).returncode, 0)
        row, = table_of(self.tables / "screened.csv")
        self.assertEqual((row["searches"], row["new_robots"], row["passed"], row["drawn"]), ("2", "18", "8", "4"))
        self.assertAlmostEqual(float(row["left_out_share"]), 6 / 18, 5)
        self.assertAlmostEqual(float(row["rejected_share"]), 10 / 18, 5)
        self.assertEqual([float(row[key]) for key in ("rejected_least", "rejected_largest")], [0.5, 0.6])
        self.assertEqual([float(row[key]) for key in ("drawn_survive_least", "drawn_survive_largest")], [0.5, 0.5])
        self.assertAlmostEqual(float(row["survive_ratio"]), 0.5 / 0.75, 5)
        self.assertEqual((float(row["passed_survive_share"]), float(row["drawn_survive_share"])), (0.75, 0.5))

    def test_few_searches_are_not_compared(self):
        for seed in range(1, 6):
            for arm, best in (("voxels", 0.01 * seed), ("elements", 0.2 + 0.01 * seed)):
                self.make(arm, seed, best)
                self.assertEqual(self.call("take", self.results, self.tables, arm, seed).returncode, 0)
        self.make("both", 1, 0.3)
        self.assertEqual(self.call("take", self.results, self.tables, "both", 1).returncode, 0)
        self.assertEqual(self.call("summary", self.tables).returncode, 0)
        row, = table_of(self.tables / "statistics.csv")
        self.assertEqual((row["arm"], row["than"]), ("elements", "voxels"))
        self.assertAlmostEqual(float(row["holm_p"]), 3 * 2 / 252, 6, "corrected for the planned tests that are still to come")
        self.assertIn(proof.STYLES["both"][0], (self.tables / "proof.svg").read_text(), "shown all the same")

    def test_searches_of_different_cost_are_not_compared(self):
        self.make("elements", 1, 0.07)
        self.make("elements", 2, 0.08)
        study = self.results / "studies" / "elements_2.toml"
        study.write_text(study.read_text().replace("element_steps = ", "element_steps = 1"))
        for seed in (1, 2):
            self.assertEqual(self.call("take", self.results, self.tables, "elements", seed).returncode, 0)
        summary = self.call("summary", self.tables)
        self.assertEqual(summary.returncode, 2)
        self.assertIn("budget_element_steps", summary.stderr)

    def test_the_best_robot_walks_on_two_layers(self):
        self.make("elements", 1, 0.07)
        self.assertEqual(self.call("winner", self.results, "elements", 1).stdout, "5\n")
        self.assertEqual(self.call("take", self.results, self.tables, "elements", 1).returncode, 0)
        row, = table_of(self.tables / "layers.csv")
        self.assertEqual((row["individual"], row["ratio"], row["angle_deg"]), ("5", "0.5", "45"))
        self.make("elements", 2, 0.07)
        self.put("elements_2.layers.csv", self.LAYERS, [[1, 5, 0.8, "", "", 0, "it fell"]])
        self.make("elements", 3, 0.07)
        self.put("elements_3.layers.csv", self.LAYERS, [[1, 5, 0.8, 0, -0.02, 0.4, ""]])
        for seed in (2, 3):
            self.assertEqual(self.call("take", self.results, self.tables, "elements", seed).returncode, 0)
        self.assertEqual(self.call("summary", self.tables).returncode, 0)
        row, = table_of(self.tables / "layer_statistics.csv")
        self.assertEqual((row["winners"], row["walking"], row["same_way"]), ("3", "2", "1"), "one fell, one went the other way")
        self.assertEqual((row["speed_ratio"], row["relative_speed_difference"]), ("0.65", "0.35"))
        self.assertEqual((row["smallest_ratio"], row["largest_ratio"]), ("0.5", "0.8"))

    def test_the_best_robot_walks_at_other_dampings(self):
        columns = "rank individual friction loss_factor body_lengths reason"
        for seed, (slow, fallen) in ((1, (0.1, "")), (2, (0.15, "it fell"))):
            self.make("both", seed, 0.2)
            self.put(f"both_{seed}.fine.csv", "rank individual design cells phenotype score_body_lengths friction loss_factor dx_m dy_m body_lengths reason",
                     [[1, 5, "b", 19, "101", 0.2, 0.4, 0.1, 0, 0.03, 0.2, ""], [1, 5, "b", 19, "101", 0.2, 0.8, 0.1, 0, 0.04, 0.5, ""]])
            self.put(f"both_{seed}.dampings.csv", columns, [[1, 5, 0.4, 0.059, 0.3, ""], [1, 5, 0.8, 0.059, slow, fallen],
                                                            [1, 5, 0.4, 0.146, 0.4, ""], [1, 5, 0.8, 0.146, 0.3, ""]])
            self.put(f"both_{seed}.layers.csv", self.LAYERS, [[1, 5, 0.8, 0, 0.04, 0.5, ""]])
            taken = self.call("take", self.results, self.tables, "both", seed)
            self.assertEqual(taken.returncode, 0, taken.stderr)
        rows = [row for row in table_of(self.tables / "dampings.csv") if row["seed"] == "1"]
        self.assertEqual([(row["loss_factor"], float(row["body_lengths"])) for row in rows], [("0.059", 0.1), ("0.1", 0.2), ("0.146", 0.3)])
        self.assertEqual(self.call("summary", self.tables).returncode, 0)
        row, = table_of(self.tables / "damping_statistics.csv")
        self.assertEqual((row["arm"], row["winners"], row["walking"]), ("both", "2", "1"), "one fell")
        self.assertEqual(float(row["smallest_ratio"]), 0.0)
        self.assertAlmostEqual(float(row["median_ratio"]), 1 / 6, 5)
        self.put("both_1.dampings.csv", columns, [[1, 9, 0.4, 0.059, 0.3, ""]])
        self.assertIn("has no walk of individual 5", self.call("take", self.results, self.tables, "both", 1).stderr)

    def test_a_winner_walks_again_after_its_archive_is_gone(self):
        self.make("both", 1, 0.2)
        walks = "rank individual design cells phenotype score_body_lengths friction loss_factor dx_m dy_m body_lengths reason"
        winner = [[1, 5, "b", 19, "101", 0.2, 0.4, 0.1, 0, 0.03, 0.2, ""], [1, 5, "b", 19, "101", 0.2, 0.8, 0.1, 0, 0.04, 0.5, ""]]
        self.put("both_1.fine.csv", walks, winner)
        (self.results / "both_1.layers.csv").unlink()
        self.make("voxels", 1, 0.1)
        for arm in ("voxels", "both"):
            self.assertEqual(self.call("take", self.results, self.tables, arm, 1).returncode, 0)
        self.assertEqual(self.call("untried", self.tables).stdout, "both 1 0 5\n", "generation 0 has the champion 5")
        for champions, generation in (((3, 9, 11), 1), ((3, 4, 4), 2)):  # a later robot, or none of the winner's number
            name = self.tables / "progress.csv"
            rows = "".join(f"both,1,{n},1,{champion},0.1\n" for n, champion in enumerate(champions))
            name.write_text("arm,seed,generation,cost_element_steps,champion,body_lengths\n" + rows)
            outcomes = self.tables / "outcomes.csv"
            outcomes.write_text(re.sub(r"^(both,1,[^,]*,[^,]*,[^,]*),\d+", r"\1,2", outcomes.read_text(), flags=re.MULTILINE))
            self.assertEqual(self.call("untried", self.tables).stdout, f"both 1 {generation} 5\n", champions)

        self.put("both_1.layers.csv", self.LAYERS, [[1, 5, 0.8, 0, 0.04, 0.4, ""]])
        self.put("both_1.dampings.csv", "rank individual friction loss_factor body_lengths reason", [[1, 5, 0.4, 0.059, 0.1, ""]])
        for column, other in ((1, 9), (2, "c"), (5, 0.3)):  # another robot, another body, another walk
            self.put("both_1.fine.csv", walks, [[other if n == column else cell for n, cell in enumerate(row)] for row in winner])
            refused = self.call("again", self.results, self.tables, "both", 1)
            self.assertEqual(refused.returncode, 2, column)
            self.assertIn("is not the winner", refused.stderr)
            self.assertFalse((self.tables / "layers.csv").exists())
        self.put("both_1.fine.csv", walks, winner)
        again = self.call("again", self.results, self.tables, "both", 1)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual(self.call("untried", self.tables).stdout, "")
        row, = table_of(self.tables / "layers.csv")
        self.assertEqual(row["ratio"], "0.8")
        self.assertEqual([row["loss_factor"] for row in table_of(self.tables / "dampings.csv")], ["0.059", "0.1"])

    def test_winners_that_all_fall_on_two_layers_are_counted(self):
        self.make("both", 1, 0.07)
        self.put("both_1.layers.csv", self.LAYERS, [[1, 5, 0.8, 0.01, 0.0, 0.1, "it fell"]])
        self.assertEqual(self.call("take", self.results, self.tables, "both", 1).returncode, 0)
        (self.tables / "statistics.csv").write_text("of former searches\n")
        self.assertEqual(self.call("summary", self.tables).returncode, 0)
        row, = table_of(self.tables / "layer_statistics.csv")
        self.assertEqual((row["arm"], row["winners"], row["walking"], row["same_way"], row["speed_ratio"]), ("both", "1", "0", "0", ""))
        self.assertFalse((self.tables / "statistics.csv").exists(), "no table without a comparison")

    def test_searches_on_voxels_have_no_winner_on_layers(self):
        self.make("voxels", 1, 0.01)
        self.assertEqual(self.call("take", self.results, self.tables, "voxels", 1).returncode, 0)
        self.assertFalse((self.tables / "layers.csv").exists())
        self.assertEqual(self.call("winner", self.results, "voxels", 1).returncode, 2)

    def test_a_walk_that_is_missing_is_named(self):
        self.make("elements", 1, 0.07)
        for rows in ([], [[1, 9, 0.8, 0.04, 0.04, 0.25, ""]], [[1, 5, 0.7, 0.04, 0.04, 0.25, ""]]):
            self.put("elements_1.layers.csv", self.LAYERS, rows)
            outcome = self.call("take", self.results, self.tables, "elements", 1)
            self.assertEqual(outcome.returncode, 2)
            self.assertIn("elements_1.layers.csv", outcome.stderr)
            self.assertFalse((self.tables / "outcomes.csv").exists(), "such a search is not finished")

    def test_a_search_without_a_walker_has_none_to_try(self):
        self.make("elements", 1, 0)
        (self.results / "elements_1.layers.csv").unlink()
        self.assertEqual(self.call("winner", self.results, "elements", 1).stdout, "")
        taken = self.call("take", self.results, self.tables, "elements", 1)
        self.assertEqual(taken.returncode, 0, taken.stderr)
        self.assertFalse((self.tables / "layers.csv").exists())

    def test_wrong_input_is_named(self):
        for words in (("summary", self.tables), ("take", self.results, self.tables, "elements", 1), ("study", "lava", 1, "a", "b")):
            outcome = self.call(*words)
            self.assertEqual(outcome.returncode, 2, words)
            self.assertTrue(outcome.stderr)


if __name__ == "__main__":
    unittest.main()
