"""Tests the scripts of paper/discrepancies, paper/scale_invariance, paper/heredity and paper/fractal/trials.py on robots that are made up, so that what
they must find is known.

paper_scales_test.py SOURCES: the folder of the sources. Exit code 77: there is no SciPy or matplotlib.
"""

import csv
import importlib.util
import itertools
import math
import pathlib
import re
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


def options_of(preset):
    """The options of a preset of searches by their dotted names."""
    tables = tomllib.loads((SOURCES / f"paper/presets/{preset}.toml").read_text())
    return {key: value for key, value in tables.items() if not isinstance(value, dict)} | {
        f"{table}.{key}": value for table, keys in tables.items() if isinstance(keys, dict) for key, value in keys.items()}


def write(file, columns, rows):
    file.parent.mkdir(parents=True, exist_ok=True)
    with open(file, "w", newline="", encoding="utf-8") as text:
        out = csv.writer(text)
        out.writerow(columns)
        out.writerows(rows)


def module_of(script):
    spec = importlib.util.spec_from_file_location(pathlib.Path(script).stem, SOURCES / script)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def ranks(values):
    """From 1; equal values share the mean of their ranks."""
    order = sorted(values)
    return [order.index(value) + (order.count(value) + 1) / 2 for value in values]


def spearman_of(first, second):
    first, second = ranks(first), ranks(second)
    mean = (len(first) + 1) / 2
    product = sum((a - mean) * (b - mean) for a, b in zip(first, second))
    return product / math.sqrt(sum((a - mean) ** 2 for a in first) * sum((b - mean) ** 2 for b in second))


def made_walks(script, cells, small, large, duration_s=5.0):
    """Walks along x of bodies with these numbers of cells; the ways at two levels are in body lengths."""

    class Made(script.Walks):
        def __init__(self):
            self.name, self.levels, self.duration_s = "text", [1, 2], duration_s
            self.bodies = ["1" * count + "0" * (27 - count) for count in cells]
            self.ends_m = {level: script.np.array([[0.01 * 3**level * way, 0.0] for way in ways]) for level, ways in ((1, small), (2, large))}
            self.score_of_level = script.SCORES["body_lengths"]

    return Made()


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
        for name in ("presets/paper.toml", "presets/released-code.toml", "sample_statistics.py", "small_tables.py", "svg_figure.py", "discrepancies/discrepancies.py", "discrepancies/bodies.py", "discrepancies/population.toml",
                     "discrepancies/variants.toml", "discrepancies/in_flight.py", "scale_invariance/scale_invariance.py", "scale_invariance/changed_walks.py", "fractal/trials.py", "heredity/heredity.py", "heredity/made_up.py", "heredity/chance.py", "fractal/two_scales.toml", "fractal/two_scales_balanced.toml", "fractal/single_precision.toml",
                     "non_fractal/again.toml", "scale_invariance/one_scale.toml", "phase_wave/two_scales.toml"):
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

    def individuals(self, ends, columns=("level_1_dx_m", "level_1_dy_m", "level_2_dx_m", "level_2_dy_m")):
        """What menger export writes of 520 robots, of which every 26th is the one before again. ends: of a robot's number, by level"""
        rows = []
        for n in range(520):
            rows.append([n, body(n - 1 if n % 26 == 25 else n), *ends(n)])
        file = self.tree / "individuals.csv"
        write(file, ["individual", "phenotype", *columns], rows)
        return file

    def rows_of(self, table, *keys):
        return {tuple(row[key] for key in keys): row for row in table_of(self.folder() / table)}

    def test_a_study_has_one_thing_changed(self):
        self.done(self.script, "study", "half_step", self.tree / "out/half_step.toml")
        study = tomllib.loads((self.tree / "out/half_step.toml").read_text())
        plain = tomllib.loads((SOURCES / "paper/discrepancies/population.toml").read_text())
        self.assertEqual(study["integration"].pop("time_step_fraction"), 0.45)
        self.assertEqual(study, plain)
        self.done(self.script, "study", "double", self.tree / "out/double.toml")
        study = tomllib.loads((self.tree / "out/double.toml").read_text())
        self.assertEqual((study["integration"].pop("number"), plain["integration"].pop("number")), ("float64", "float32"))
        self.assertEqual(study, plain, "the damping is that of the others")
        self.refused("there is no variant ham; there are text", self.script, "study", "ham", self.tree / "ham.toml")

    def test_every_variant_with_walks_has_its_part(self):
        variants = tomllib.loads((SOURCES / "paper/discrepancies/variants.toml").read_text())
        names = [name for name, one in variants.items() if "walks_of" not in one]
        self.assertEqual(names[0], "text")
        listed = subprocess.run([str(SOURCES / "paper/run_experiment.sh")], capture_output=True, text=True, check=True).stdout
        listed = listed[listed.index("\ndiscrepancies: "):]
        for name in names:
            when = "on request: " if variants[name].get("on_request") else ""
            self.assertRegex(listed, rf"(?m)^  {name} +{variants[name]['cost_min']} min +{when}{re.escape(variants[name]['label'])}$")
        kinds = [one["kind"] for name, one in variants.items() if name != "text"]
        self.assertEqual([kind for kind, _ in itertools.groupby(kinds)], ["difference", "omission", "physics", "sensitivity"], "variants of one kind stand together")

    def test_every_option_that_differs_between_text_and_code_is_compared_or_named_as_not_covered(self):
        text, code = options_of("paper"), options_of("released-code")
        variants = tomllib.loads((SOURCES / "paper/discrepancies/variants.toml").read_text())
        together = variants["released_walks"]
        compared = {f"{table}.{key}": value for table, keys in together["keys"].items() for key, value in keys.items()}
        compared["evaluation.objective"] = {"squared_metres": "squared-metres-per-scale"}[together["score"]]
        apart = {option: [row["text"], row["released_code"]] for row in table_of(SOURCES / "paper/discrepancies/not_covered.csv") for option in [row["option"]]}
        self.assertEqual({option for option in text if text[option] != code[option]}, set(compared) | set(apart))
        self.assertFalse(set(compared) & set(apart))
        for option, value in compared.items():
            self.assertEqual(code[option], value, option)
        for option, values in apart.items():
            self.assertEqual([str(text[option]).lower(), str(code[option]).lower()], values, option)
        # Each of the other differences is one of these alone.
        alone = [one for name, one in variants.items() if one.get("kind") == "difference" and name != "released_walks"]
        self.assertEqual({table: keys for one in alone for table, keys in one.get("keys", {}).items()}, together["keys"])
        self.assertEqual([one["score"] for one in alone if "score" in one], [together["score"]])

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
        self.assertEqual(self.rows_of("changes.csv", "variant", "level")["duration", "2"]["end_median"], "0")
        # Squared metres over 3 and 9 keep the order of robots that go twice as far at level 2.
        self.assertEqual(rows["score"]["fitness_spearman"], "1")
        self.assertAlmostEqual(float(rows["no_drag"]["fitness_spearman"]), -1.0, delta=0.001)
        self.assertEqual(rows["no_drag"]["another_best_of_ten"], "1")
        concluded = {row["variant"]: row for row in table_of(self.folder() / "conclusions.csv")}
        self.assertEqual(rows["no_drag"]["failed"], "0")
        # Where all go equally far there is no correlation, and the cell is empty.
        self.assertEqual(self.rows_of("changes.csv", "variant", "level")["no_drag", "2"]["distance_spearman"], "")
        # Twice the distance is two thirds of the body lengths.
        self.assertEqual(concluded["text"]["larger_is_slower"], "1")
        self.assertAlmostEqual(float(concluded["text"]["speed_factor"]), 2.0 / 3.0, delta=1e-4)
        xml.dom.minidom.parse(str(self.folder() / "discrepancies.svg"))

    def test_the_text_is_compared_with_the_released_code(self):
        far = lambda n: 1e-3 * (n + 1)  # noqa: E731
        straight, turned = (lambda n: (far(n), 0.0, 2.0 * far(n), 0.0)), (lambda n: (far(519 - n), 0.0, 600.0, 0.0))
        for name, ends in (("text", straight), ("duration", straight), ("released_walks", straight), ("free_rotation", turned)):
            self.done(self.script, "take", self.individuals(ends), name)
        self.done(self.script, "summary")
        found = self.rows_of("released.csv", "variant")
        self.assertEqual(list(found), [("text",), ("free_rotation",)], "the text, and what leaves out what it does not mention")
        self.assertEqual([found["text",][name] for name in ("robots", "failed", "fitness_spearman", "another_best_of_ten")], ["500", "0", "1", "0"])
        self.assertAlmostEqual(float(found["free_rotation",]["fitness_spearman"]), -1.0, delta=0.001)

    bodies = "discrepancies/bodies.py"

    def test_bodies_differ_in_what_the_released_code_does_otherwise(self):
        folder = self.tree / "bodies"
        self.done(self.bodies, "studies", folder)
        studies = {file.stem: tomllib.loads(file.read_text()) for file in folder.glob("*.toml")}
        text, code = options_of("paper"), options_of("released-code")
        differ = {key.removeprefix("genome."): code[key] for key in text if key.startswith("genome.") and text[key] != code[key]}
        self.assertEqual({name: study.pop("genome", {}) for name, study in studies.items()}, {"text": {}, "all": differ} | {key: {key: value} for key, value in differ.items()})
        self.assertEqual(len({str(study) for study in studies.values()}), 1, "all else is alike")

    def test_counts_shapes_of_bodies(self):
        # A cube of two materials, an upright plane, three cells around a corner, whose copies do not touch, and a bar of three.
        shapes = ["1" * 26 + "2", "100100100" * 3, "110010000" + "0" * 18, "111" + "0" * 24]
        for name in module_of("paper/discrepancies/bodies.py").drawn():
            write(self.tree / f"bodies/{name}/individuals.csv", ["individual", "phenotype"], [[n, shape] for n, shape in enumerate(shapes + shapes[:1])])
        self.done(self.bodies, "take", self.tree / "bodies")
        row, in_one_piece, *_ = table_of(self.folder() / "bodies.csv")
        self.assertEqual([row[name] for name in ("variant", "bodies", "unlike", "cells_median", "full_cube", "nine_cells", "sponge", "one_material", "falls_apart")],
                         ["text", "5", "4", "9", "0.4", "0.2", "0", "0.6", "0.2"])
        self.assertEqual([in_one_piece[name] for name in ("variant", "bodies", "full_cube", "falls_apart")], ["text_in_one_piece", "4", "0.5", "0"])
        self.refused("individuals.csv", self.bodies, "take", self.tree / "nowhere")

    def test_counts_failed_walks_and_says_how_far_ends_move(self):
        far = lambda n: 1e-3 * (n + 1.5)  # noqa: E731
        columns = [f"level_{level}_{what}" for level in (1, 2) for what in ("status", "dx_m", "dy_m")]
        # As many body lengths at level 2, and a tenth more.
        self.done(self.script, "take", self.individuals(lambda n: (far(n), 0.0, 3.3 * far(n), 0.0), [column for column in columns if "status" not in column]), "text")
        # Every tenth robot fails at level 1, the others walk as before.
        fails = lambda n: n % 10 == 0  # noqa: E731
        self.done(self.script, "take", self.individuals(lambda n: (*(("diverged", "", "") if fails(n) else ("completed", far(n), 0.0)), "completed", 3.3 * far(n), 0.0), columns),
                  "no_drag")
        # A fifth more at level 1, and every fifth robot twice as far; at level 2 as far aside as half the way.
        self.done(self.script, "take", self.individuals(lambda n: ((2.0 if n % 5 == 0 else 1.2) * far(n), 0.0, 3.3 * far(n), 1.65 * far(n)),
                                                        [column for column in columns if "status" not in column]), "half_step")
        self.done(self.script, "summary")
        chosen = [n for n in range(520) if n % 26 != 25]
        failed = [n for n in chosen if fails(n)]
        for table in ("statistics.csv", "changes.csv", "failures.csv", "conclusions.csv", "verdicts.csv"):
            cells = {value.lower() for row in table_of(self.folder() / table) for value in row.values()}
            self.assertFalse(cells & {"nan", "inf", "-inf", "none"}, table)
        statistics = self.rows_of("statistics.csv", "variant")
        drag, step = statistics["no_drag",], statistics["half_step",]
        self.assertEqual((drag["kind"], step["kind"]), ("the text does not mention it", "sensitivity"))
        self.assertEqual((drag["failed"], drag["ended"], drag["ended_fitness_spearman"], drag["ended_another_best_of_ten"]), (str(len(failed)), str(500 - len(failed)), "1", "0"))
        # Failed robots rank last: with m of n moved to the end, as one tie.
        after = [-1.0 if fails(n) else float(n) for n in chosen]
        self.assertAlmostEqual(float(drag["fitness_spearman"]), spearman_of(chosen, after), delta=1e-4)
        self.assertGreater(float(drag["another_best_of_ten"]), 0.05)
        self.assertEqual((step["failed"], step["ended_fitness_spearman"]), ("0", step["fitness_spearman"]))
        failures = self.rows_of("failures.csv", "variant", "level", "outcome")
        self.assertEqual(set(failures), {("no_drag", "1", "failed"), ("no_drag", "1", "ended")})
        lost = failures["no_drag", "1", "failed"]
        self.assertEqual((lost["robots"], lost["statuses"], failures["no_drag", "1", "ended"]["statuses"]),
                         (str(len(failed)), f"{len(failed)} diverged", f"{500 - len(failed)} completed"))
        self.assertEqual(lost["two_materials"], str(sum("2" in body(n) for n in failed)))
        middle = sorted(failed)[len(failed) // 2 - 1:len(failed) // 2 + 1] if len(failed) % 2 == 0 else [sorted(failed)[len(failed) // 2]] * 2
        self.assertAlmostEqual(float(lost["text_body_lengths"]), sum(map(far, middle)) / 2 / 0.03, delta=2e-3)
        changes = self.rows_of("changes.csv", "variant", "level")
        small, large = changes["half_step", "1"], changes["half_step", "2"]
        self.assertEqual((small["moving"], large["moving"]), ("498", "498"), "the two shortest stand still")
        self.assertEqual((small["end_median"], small["end_ninth_decile"], small["distance_median"], small["factor_median"]), ("0.2", "1", "0.2", "1.2"))
        self.assertEqual((large["end_median"], large["end_ninth_decile"]), ("0.5", "0.5"))
        self.assertAlmostEqual(float(large["distance_median"]), math.sqrt(1.25) - 1.0, delta=1e-4)
        self.assertAlmostEqual(float(large["fastest_m_per_s"]), 3.3 * math.sqrt(1.25) * far(518) / 5.0, delta=1e-3)
        self.assertEqual((changes["no_drag", "1"]["failed"], changes["no_drag", "2"]["failed"], changes["no_drag", "1"]["distance_spearman"]), (str(len(failed)), "0", "1"))
        concluded = self.rows_of("conclusions.csv", "variant", "levels")["text", "1 to 2"]
        self.assertEqual((concluded["moving"], concluded["larger_is_slower"], concluded["larger_is_slower_verdict"]), ("498", "0", "no"))
        self.assertEqual((concluded["carried_over"], concluded["carried_over_verdict"], concluded["speed_factor"]), ("1", "yes", "1.1"))
        self.assertEqual((concluded["scales_spearman"], concluded["scales_spearman_verdict"]), ("1", "yes"))
        self.assertEqual(self.rows_of("conclusions.csv", "variant", "levels")["no_drag", "1 to 2"]["ended"], str(500 - len(failed)))
        self.assertEqual(self.rows_of("conclusions.csv", "variant", "levels")["half_step", "1 to 2"]["larger_is_slower_verdict"], "no")
        self.assertEqual(self.rows_of("verdicts.csv", "conclusion", "levels")["larger_is_slower", "1 to 2"]["sentence"], "no in all 3 variants")

    def test_a_change_is_compared_with_both_kinds_of_beams(self):
        # At 3 cells half the step takes robots twice as far with the beams of the simulator, and by a tenth further with balanced ones. The
        # first 100 stand still with the latter, the last 100 fail with both changes: 300 robots tell.
        def ends_of(times, of_last):
            return lambda n: (*(("", "") if of_last is None and n >= 416 else (times * 1e-2 * (n + 1), 0.0)), 1e3, 0.0)

        for name, times, of_last in (("text", 1.0, 1), ("half_step", 2.0, None), ("balanced_half_step", 4.4, 1)):
            self.done(self.script, "take", self.individuals(ends_of(times, of_last)), name)
        self.done(self.script, "take", self.individuals(lambda n: (*((0.0, 0.0) if n < 104 else (0.04 * (n + 1), 0.0)), 1e3, 0.0)), "balanced")
        self.done(self.script, "summary")
        against_text = self.rows_of("changes.csv", "variant", "level")
        self.assertEqual([against_text[name, "1"]["end_median"] for name in ("balanced_half_step", "half_step")], ["3.4", "1"])
        small, large = table_of(self.folder() / "balanced_changes.csv")
        self.assertEqual([small[name] for name in ("variant", "label", "cells_per_side", "moving", "published_end_median", "balanced_end_median")],
                         ["balanced_half_step", "half the time step", "3", "300", "1", "0.1"])
        self.assertLess(float(small["p"]), 1e-10)
        self.assertEqual([large[name] for name in ("cells_per_side", "balanced_end_median", "p")], ["9", "0", "1"])
        self.assertGreater(float(small["fitness_spearman"]), 0.8, "against the balanced ones")

    def test_finds_what_fitness_goes_with(self):
        script = module_of("paper/discrepancies/discrepancies.py")

        cells = [3 + n % 25 for n in range(100)]
        rising = [float(count) for count in cells]
        found = script.of_fitness(made_walks(script, cells, rising, [2.0 * way for way in rising]))
        self.assertAlmostEqual(found["dimension_spearman"], 1.0)
        # Of 100 robots 16 have 16 to 19 cells, none of them among the ten with the most cells.
        self.assertEqual((found["dimension_spearman_verdict"], found["other_sponges"], found["best_tenth_sponges"]), ("yes", 16 / 90, 0.0))
        self.assertEqual((found["more_sponges"], found["more_sponges_verdict"]), (-16 / 90, "open"))
        self.assertEqual(found["smallest_scale_decides"], 1.0)
        self.assertAlmostEqual(found["best_body_lengths_per_minute"], 27 * 12.0)
        self.assertAlmostEqual(found["median_body_lengths_per_minute"], 15 * 12.0)
        found = script.of_fitness(made_walks(script, cells, [30.0 - way for way in rising], [40.0 - way for way in rising], duration_s=2.0))
        self.assertEqual(found["dimension_spearman_verdict"], "no")
        self.assertAlmostEqual(found["best_body_lengths_per_minute"], 27 * 30.0)
        # The best are of 16 to 19 cells; a failed robot has no part in it; at every fourth the larger scale decides.
        small = [10.0 + n / 100 if 16 <= count <= 19 else 1.0 for n, count in enumerate(cells)]
        large = [way * (0.5 if n % 4 == 0 else 2.0) for n, way in enumerate(small)]
        found = script.of_fitness(made_walks(script, cells + [3, 3], small + [math.nan, 5.0], large + [99.0, math.nan]))
        self.assertEqual((found["best_tenth_sponges"], found["more_sponges_verdict"], found["smallest_scale_decides"]), (1.0, "yes", 0.75))
        self.assertAlmostEqual(found["more_sponges"], 1.0 - 6 / 90)
        # A robot of 2 s needs two fifths of the way of one of 5 s.
        self.assertEqual(list(made_walks(script, [3, 3], [0.05, 0.03], [1.0, 1.0], 2.0).moves(1)), [True, False])
        self.assertEqual(list(made_walks(script, [3, 3], [0.05, 0.03], [1.0, 1.0]).moves(1)), [False, False])

    def test_the_best_tenth_is_compared_with_the_others_by_the_interval_of_the_difference(self):
        script = module_of("paper/discrepancies/discrepancies.py")
        # 5 of the 20 best and 20 of the 180 others have 17 cells: 25 % and 11 %. Wilson's interval of the best alone, 11.2 to 46.9 %, leaves
        # out 11.1 %; that of the difference has 0 inside, as the share of the others is not exact.
        cells = [17 if n < 5 or 20 <= n < 40 else 5 for n in range(200)]
        found = script.of_fitness(made_walks(script, cells, *[[200.0 - n for n in range(200)]] * 2))
        self.assertAlmostEqual(found["more_sponges"], 5 / 20 - 20 / 180)
        self.assertGreater(script.share(5, 20).low, found["other_sponges"])
        self.assertLess(found["more_sponges_low"], 0.0)
        self.assertEqual(found["more_sponges_verdict"], "open")

    def test_those_that_move_at_either_scale_say_which_one_is_slower(self):
        script = module_of("paper/discrepancies/discrepancies.py")
        # Of 80 robots half move at the smaller scale only and half at the larger one only: none is usually the slower one. Twenty move at
        # neither, and are slower at the larger one by a hair.
        small = [1.0] * 40 + [0.05] * 40 + [0.02] * 20
        large = [0.05] * 40 + [1.0] * 40 + [0.01] * 20
        found = script.from_scale_to_scale(made_walks(script, [9] * 100, small, large), 1, 2)
        self.assertEqual((found["moving_at_either"], found["moving"]), (80, 40))
        self.assertEqual((found["larger_is_slower"], found["larger_is_slower_verdict"], found["larger_is_slower_outcome"]), (0.5, "open", "open"))
        self.assertAlmostEqual(found["speed_factor"], (0.05 + 20.0) / 2)
        self.assertNotIn("larger_is_slower_of_both", found, "none moves at both")
        # Three of four move at both, and two of these are faster at the larger one.
        found = script.from_scale_to_scale(made_walks(script, [9] * 4, [1.0, 1.0, 1.0, 0.05], [2.0, 3.0, 0.5, 1.0]), 1, 2)
        self.assertEqual([found[name] for name in ("moving_at_either", "larger_is_slower", "moving_at_both", "speed_factor_of_both")], [4, 0.25, 3, 2.0])
        self.assertAlmostEqual(found["larger_is_slower_of_both"], 1 / 3)
        # Who does not move at all at the smaller scale is faster at the larger one.
        found = script.from_scale_to_scale(made_walks(script, [9] * 3, [0.0, 1.0, 1.0], [1.0, 0.5, 0.5]), 1, 2)
        self.assertEqual((found["moving_at_either"], found["larger_is_slower"], found["speed_factor"]), (3, 2 / 3, 0.5))

    def test_a_variant_is_compared_with_the_text_on_the_same_robots(self):
        script = module_of("paper/discrepancies/discrepancies.py")
        # The first stands still with the variant, the second as the text says; of the other three one carries over as the text says, all with it.
        text, other = (made_walks(script, [9] * 5, *ways) for ways in (([1, 0, 1, 1, 1], [1, 1, 1, -1, 9]), ([0, 1, 1, 1, 1], [1, 1, 1, 1, 1])))
        found = script.more_alike(text, other, 1, 2)
        self.assertEqual([found[name] for name in ("moving_in_both", "in_both_carried_over", "p_carried_over", "in_both_same_way")], [3, 1.0, 0.5, 1.0])
        self.assertAlmostEqual(found["in_both_text_carried_over"], 1 / 3)
        self.assertAlmostEqual(found["in_both_text_same_way"], 2 / 3)

    def test_mirror_images_are_alike(self):
        script = module_of("paper/discrepancies/discrepancies.py")
        plain = "100000000" + "220000000" + "000000000"
        for same in ("001000000" + "022000000" + "000000000", "100000000" + "200200000" + "000000000", "000000002" + "000000011" + "000000000", "000000100" + "000200200" + "000000000"):
            self.assertEqual(script.like(same), script.like(plain), "mirrored, turned, with the other material")
        for other in ("220000000" + "100000000" + "000000000", "100000000" + "210000000" + "000000000", "000100000" + "220000000" + "000000000"):
            self.assertNotEqual(script.like(other), script.like(plain), "upside down, with one cell of the other material, with one cell elsewhere")

    def test_chance_pairs_every_robot_with_every_other_one(self):
        script = module_of("paper/discrepancies/discrepancies.py")
        lower = script.np.array([[0.01, 0.0], [0.01, 0.0], [-0.01, 0.0]])
        # Each of the six pairs once, none with itself: only the first two go the same way.
        found = script.by_chance(script.of_all_pairs(lower, 3.0 * lower))
        self.assertEqual((found["carried_over"], found["same_way"], found["like_speed"]), (2 / 6, 2 / 6, 1.0))
        concluded = script.from_scale_to_scale(made_walks(script, [9] * 3, [1.0] * 3, [1.0] * 3), 1, 2)
        self.assertEqual((concluded["carried_over"], concluded["carried_over_by_chance"]), (1.0, 1.0))

    def test_says_which_variants_turn_a_conclusion(self):
        script = module_of("paper/discrepancies/discrepancies.py")
        rows = [{"variant": name, "levels": "1 to 2", "label": label, "larger_is_slower": value, "larger_is_slower_verdict": verdict}
                for name, label, value, verdict in (("text", "the text", 0.9, "yes"), ("duration", "2 s", 0.2, "no"), ("score", "score", 0.9, "yes"),
                                                    ("phases", "phases", 0.5, "open"), ("no_drag", "drag", 0.1, "no"))]
        told = script.verdicts(rows)
        self.assertEqual([row["conclusion"] for row in told], ["larger_is_slower"])
        # That of the score has the walks of the text.
        self.assertEqual((told[0]["variants"], told[0]["as_text"], told[0]["lowest"], told[0]["highest"]), (4, 1, 0.1, 0.9))
        self.assertEqual(told[0]["sentence"], "yes in 1 of 4 variants. No with: 2 s; drag. Open with: phases")
        self.assertEqual(script.verdicts(rows[:1])[0]["sentence"], "yes in all 1 variants")

    def test_says_what_is_missing(self):
        self.refused("text.csv: is not there", self.script, "summary")
        few = self.tree / "few.csv"
        write(few, ["individual", "phenotype"], [[1, body(1)]])
        self.refused("only 1 bodies differ", self.script, "take", few, "text")


class InFlight(Case):
    script = "discrepancies/in_flight.py"

    def flights(self, robots):
        """What menger simulate writes of robots: phenotype, and with the moments of the simulator and with balanced ones the status and the
        energy of motion. It is 1 J in the first half of a second, and the given one from then on."""
        write(self.tree / "paper/discrepancies/walks/text.csv", ["individual", "phenotype"], [[n, robot[0]] for n, robot in enumerate(robots)])
        for n, (_, *both) in enumerate(robots):
            for moments, (status, motion_J) in zip(("published", "balanced"), both):
                folder = self.tree / f"found/{n}-{moments}"
                write(folder / "trajectory.csv", ["time_s", "kinetic_J", "energy_residual_J"], [[0.1 * k, 1.0 if k < 5 else motion_J, 0.25 * motion_J * (k == 10)] for k in range(11)])
                (folder / "result.toml").write_text(f'status = "{status}"\ntime_s = 1.0\n')

    def test_tells_who_spins_up(self):
        two, one = "12" + "0" * 25, "11" + "0" * 25
        self.flights([(two, ("diverged", 8.0), ("completed", 2.0)), (two, ("completed", 4.0), ("completed", 2.0)), (two, ("completed", 3.0), ("completed", 2.0)),
                      (one, ("completed", 2.0), ("completed", 2.0))])
        self.done(self.script, "take", self.tree / "found")
        of_two, of_one = table_of(self.tree / "paper/discrepancies/in_flight_statistics.csv")
        self.assertEqual([of_two[name] for name in ("robots", "spin_up", "published_end_early", "balanced_end_early", "published_unaccounted", "ratio", "ratio_largest")],
                         ["3", f"{2 / 3:.4g}", "1", "0", "0.25", "2", "4"])
        self.assertEqual([of_one[name] for name in ("robots", "spin_up", "ratio")], ["1", "0", "1"])
        first, *others = table_of(self.tree / "paper/discrepancies/in_flight.csv")
        self.assertEqual((first["materials"], first["published_motion_J"], first["published_unaccounted_J"], len(others)), ("2", "8", "2", 3))
        self.assertEqual(len(table_of(self.tree / "paper/discrepancies/in_flight_over_time.csv")), 11)
        xml.dom.minidom.parse(str(self.tree / "paper/discrepancies/in_flight.svg"))

    def test_scenes_have_nothing_that_turns_a_robot(self):
        write(self.tree / "paper/discrepancies/walks/text.csv", ["individual", "phenotype"], [[7, "12" + "0" * 25]])
        self.done(self.script, "scenes", self.tree / "scenes")
        published, balanced = (tomllib.loads((self.tree / f"scenes/7-{moments}.toml").read_text()) for moments in ("published", "balanced"))
        self.assertEqual((published["loads"], published["ground"], published["damping"]["global"]), ({"gravity_m_per_s2": 0.0}, {"present": False}, 0.0))
        self.assertEqual((published["materials"].pop("beam_moments"), balanced["materials"].pop("beam_moments")), ("published", "balanced"))
        self.assertEqual(published, balanced)
        self.refused("has no simulated robot", self.script, "take", self.tree / "scenes")


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
        write(self.tree / "champion/lineage.csv", ["individual", "phenotype"], [[3, body(3)], [7, body(77)]])
        for _ in range(2):  # the second takes the place of the first
            self.done(self.script, "champion", self.tree / "champion", "one_scale", "4")
        self.done(self.script, "champion", self.tree / "champion", "two_scales_balanced", "4")
        self.assertEqual([row["group"] for row in table_of(folder / "robots.csv")][-2:], ["one_scale", "two_scales_balanced"])
        self.done(self.script, "summary")
        found = {(row["group"], row["levels"]): row for row in table_of(folder / "statistics.csv")}
        self.assertEqual(set(found), {(group, levels) for group in ("random", "random_25") for levels in ("1 to 2", "2 to 3")} | {("one_scale", "1 to 2"), ("two_scales_balanced", "1 to 2")})
        chance = found["random", "1 to 2"]
        # The last one stands still at level 1, and goes on as it did from level 2.
        self.assertEqual(found["random", "2 to 3"]["robots"], "41")
        self.assertEqual((chance["robots"], chance["carried_over"], chance["same_way"], chance["speed_factor"]), ("40", "0.75", "0.75", "1"))
        self.assertLess(float(chance["by_chance"]), 0.5)
        self.assertEqual(chance["most_differ_outcome"], "not reproduced", "most of them carry over")
        self.assertEqual((chance["like_speed"], chance["same_way_by_chance"]), ("1", "0.75"), "whichever robot is taken, 30 of 40 did not turn")
        # The fastest are the last 25 of 40, of which 10 turn: a fitness of 0.2 (n + 1) body lengths in 5 s, so that the median is that of n = 27.
        fast = found["random_25", "1 to 2"]
        self.assertEqual((fast["robots"], fast["carried_over"], fast["like_speed"]), ("25", "0.6", "1"))
        self.assertAlmostEqual(float(fast["fitness_per_minute"]), 0.2 * 28 * 12, delta=0.1)
        self.assertLess(float(fast["carried_over_low"]), 0.5)
        tested = {(row["groups"], row["levels"]): row for row in table_of(folder / "comparisons.csv")}
        # The only champion is one of 31 of 41 that go the same way, and the 1 of 41 that goes three times as fast.
        one = tested["one_scale and random", "1 to 2"]
        self.assertEqual((one["robots"], one["other_robots"], one["p_same_way"], one["as_fit_as_the_slowest"]), ("1", "40", "1", "39"))
        self.assertAlmostEqual(float(one["p_like_speed"]), 1 / 41, delta=1e-4)
        # One champion tells nothing: all intervals have 0 inside.
        self.assertEqual([one[f"more_{name}{end}"] for name in ("carried_over", "same_way") for end in ("", "_outcome")], ["-0.75", "open", "0.25", "open"])
        champion = found["one_scale", "1 to 2"]
        self.assertEqual((champion["robots"], champion["carried_over"], champion["same_way"], champion["speed_factor"]), ("1", "0", "1", "3"))
        self.assertTrue(table_of(folder / "dimension.csv"))
        for name in ("scale_invariance", "carried_over"):
            xml.dom.minidom.parse(str(folder / f"{name}.svg"))

    def champions(self, rows):
        """Writes robots.csv: group, seed, phenotype, and ends at levels."""
        columns = ["group", "seed", "robot", "cells", "phenotype"] + [f"level_{level}_d{axis}_m" for level in (1, 2, 3) for axis in "xy"]
        write(self.tree / "paper/scale_invariance/robots.csv", columns, [[group, seed, seed, 3, digits, *ends] for group, seed, digits, *ends in rows])

    def test_evolved_robots_are_compared_by_the_difference_of_shares(self):
        # Of ten evolved robots four carry over, of 100 random ones 24, as found: 16 points more, with 0 inside the interval. Nine of ten would
        # be more: Newcombe's interval is 34 to 77 points.
        def ends_of(does):
            return [0.03, 0.0, *((0.09, 0.0) if does else (0.0, 0.09)), "", ""]

        random = [["random", n, body(n), *ends_of(n < 24)] for n in range(100)]
        for hits, outcome in ((4, "open"), (9, "reproduced"), (0, "open")):
            self.champions(random + [["two_scales", n, body(200 + n), *ends_of(n < hits)] for n in range(10)])
            self.done(self.script, "summary")
            (found,) = [row for row in table_of(self.tree / "paper/scale_invariance/comparisons.csv") if row["groups"] == "two_scales and random"]
            self.assertAlmostEqual(float(found["more_carried_over"]), hits / 10 - 0.24, delta=1e-9)
            self.assertEqual(found["more_carried_over_outcome"], outcome)

    def test_evolved_robots_are_compared_with_those_of_fewer_scales(self):
        ends = {True: [0.03, 0.0, 0.09, 0.0, "", ""], False: [0.03, 0.0, 0.0, 0.09, "", ""]}
        self.champions([[group, n, body(100 * place + n), *ends[n < hits]]
                        for place, (group, hits) in enumerate((("one_scale", 0), ("two_scales", 9), ("three_scales", 9))) for n in range(10)])
        self.done(self.script, "summary")
        found = {row["groups"]: row for row in table_of(self.tree / "paper/scale_invariance/comparisons.csv")}
        self.assertEqual(set(found), {"two_scales and one_scale", "three_scales and one_scale", "three_scales and two_scales"})
        self.assertEqual([found[groups]["more_carried_over"] for groups in ("two_scales and one_scale", "three_scales and two_scales")], ["0.9", "0"])
        self.assertEqual(found["two_scales and one_scale"]["more_carried_over_outcome"], "reproduced")

    def test_finds_what_the_dimension_does(self):
        # The more cells, the more robots turn, and the less their speed changes.
        rows = []
        for cells in range(3, 28):
            turn, factor = math.radians(5 * cells), math.exp(3.0 / cells)
            rows.append(["random", cells, "1" * cells + "0" * (27 - cells), 0.03, 0.0, 0.09 * factor * math.cos(turn), 0.09 * factor * math.sin(turn), "", ""])
        self.champions(rows)
        self.done(self.script, "summary")
        (found,) = table_of(self.tree / "paper/scale_invariance/dimension_tests.csv")
        self.assertEqual((found["levels"], found["robots"]), ("1 to 2", "25"))
        self.assertEqual([found[f"angle_spearman{end}"] for end in ("", "_low", "_high")], ["1", "1", "1"])
        self.assertEqual([found[f"speed_spearman{end}"] for end in ("", "_low", "_high")], ["-1", "-1", "-1"])

    def test_which_scale_is_slower_is_asked_of_robots_that_move_at_either(self):
        # Body lengths, of 30 mm at 3 cells and of 90 mm at 9: 2 and 1, 2 and 0.9, 3 and 2.1, 0.03 and 1; the fifth stands still at both.
        ends = ([0.06, 0.0, 0.09, 0.0, "", ""], [0.06, 0.0, 0.0, 0.081, "", ""], [0.09, 0.0, 0.189, 0.0, "", ""], [0.0009, 0.0, 0.09, 0.0, "", ""],
                [0.002, 0.0, 0.002, 0.0, "", ""])
        self.champions([["random", n, body(n), *walk] for n, walk in enumerate(ends)])
        self.done(self.script, "summary")
        (row,) = [row for row in table_of(self.tree / "paper/scale_invariance/statistics.csv") if row["levels"] == "1 to 2"]
        self.assertEqual([row[name] for name in ("moving_at_either", "larger_is_slower", "larger_is_slower_outcome")], ["4", "0.75", "open"])
        self.assertEqual((float(row["smaller_per_minute"]), float(row["larger_per_minute"])), (24.0, 12.0))
        self.assertEqual(row["no_difference_outcome"], "open")
        # Differences of 1, 1.1, 0.9 and -0.97: rank 2 of 4 is against the others, as far as which are 3 of 16 choices of signs on either side.
        self.assertAlmostEqual(float(row["p_scales"]), 6 / 16, delta=1e-4)

    def test_finds_robots_that_do_the_same_at_all_scales(self):
        # Three of four go on as they did at the second step, two at the first; one does at both. The fifth ends no walk at 27 cells.
        ends = ([0.06, 0, 0.18, 0, 0.54, 0], [0.06, 0, 0.18, 0, 0, 0.54], [0.06, 0, 0, 0.18, 0, 0.54], [0.06, 0, 0, 0.18, 0, 0.54], [0.06, 0, 0.18, 0, "", ""])
        # Five of another group go five ways, 72 degrees apart, each the same at all scales.
        ways = [(0.06 * math.cos(angle), 0.06 * math.sin(angle)) for angle in (0.4 * math.pi * n for n in range(5))]
        self.champions([["two_scales", n, body(n), *walk] for n, walk in enumerate(ends)] +
                       [["two_scales_again", n, body(n), *(scale * end for scale in (1, 3, 9) for end in way)] for n, way in enumerate(ways)])
        self.done(self.script, "summary")
        folder = self.tree / "paper/scale_invariance"
        row, again = table_of(folder / "all_scales.csv")
        self.assertEqual([row[name] for name in ("robots", "carried_over", "found_outcome")], ["4", "0.25", "open"])
        self.assertEqual([again[name] for name in ("robots", "carried_over", "by_chance", "found_outcome")], ["5", "1", "0", "reproduced"])
        self.assertAlmostEqual(float(again["p_by_chance"]), 2 / 120**2, delta=1e-7)
        # All go along x at first, two of them at 9 cells (0 and 1), and at 27 only the first one. Of the 24 triples of different robots those match whose
        # second one is 1, and whose third one is 0: the first one is 2 or 3. And those whose second one is 0 have no third one.
        self.assertEqual(row["by_chance"], f"{2 / 24:.4g}")

    def test_tells_how_many_designs_differ(self):
        # A body, its mirror image, the body turned by a quarter, and another one.
        plain, walk = "110100000" + "0" * 18, [0.06, 0, 0.18, 0, "", ""]
        other = "111100000" + "0" * 18
        self.champions([["two_scales", n, digits, *walk] for n, digits in enumerate([plain, "011001000" + "0" * 18, "000100110" + "0" * 18, other, "120" + "0" * 24])])
        self.done(self.script, "summary")
        (row,) = table_of(self.tree / "paper/scale_invariance/designs.csv")
        self.assertEqual([row[name] for name in ("group", "robots", "different", "outcome")], ["two_scales", "5", "3", "reproduced"])

    def test_the_largest_scale_may_be_the_slowest(self):
        # Body lengths at 3, 9 and 27 cells: 2, 2, 1; 2, 1, 1.5; 0.02, 0.02, 1; one that stands still, one that failed at 27.
        ends = ([0.06, 0, 0.18, 0, 0.27, 0], [0.06, 0, 0.09, 0, 0.405, 0], [0.0006, 0, 0.0018, 0, 0.27, 0], [0.0006] + [0] * 5, [0.06, 0, 0.18, 0, "", ""])
        self.champions([["random", n, body(n), *walk] for n, walk in enumerate(ends)])
        self.done(self.script, "summary")
        (row,) = table_of(self.tree / "paper/scale_invariance/slowest.csv")
        self.assertEqual([row[name] for name in ("group", "robots", "largest_is_slowest")], ["random", "3", "0.3333"])
        self.assertEqual(row["largest_is_slowest_outcome"], "open")

    def test_says_what_hangs_on_the_limits_of_what_carries_over(self):
        # Random robots turn by 50 degrees and become 2.5 times as fast, evolved ones turn by 20 degrees and keep nearly all of their speed.
        def ends_of(angle_deg, factor):
            turn = math.radians(angle_deg)
            return [0.03, 0.0, 0.09 * factor * math.cos(turn), 0.09 * factor * math.sin(turn), "", ""]

        self.champions([["random", n, body(n), *ends_of(50, 2.5)] for n in range(101)] + [["two_scales", n, body(200 + n), *ends_of(20, 1.2)] for n in range(3)])
        self.done(self.script, "summary")
        found = {(row["angle_deg"], row["factor"]): row for row in table_of(self.tree / "paper/scale_invariance/thresholds.csv")}
        self.assertEqual(len(found), 9)
        for limits, row in found.items():
            other = "1" if limits == ("60", "3") else "0"
            self.assertEqual([row[name] for name in ("robots", "other_robots", "carried_over", "other_carried_over")], ["3", "100", "1", other], limits)
        self.assertEqual((found["60", "3"]["p"], found["45", "2"]["p"]), ("1", f"{1 / math.comb(103, 3):.4g}"))

    def test_a_random_robot_that_is_a_champion_counts_once(self):
        walks = [0.03, 0.0, 0.09, 0.0, "", ""]
        self.champions([["random", n, body(n), *walks] for n in range(4)] + [["two_scales", 1, body(2), *walks]])
        self.done(self.script, "summary")
        counts = {row["group"]: row["robots"] for row in table_of(self.tree / "paper/scale_invariance/statistics.csv")}
        self.assertEqual(counts, {"random": "3", "two_scales": "1"})

    def test_robots_are_compared_with_those_of_the_same_physics(self):
        walks = [0.03, 0.0, 0.09, 0.0, "", ""]
        random = [[group, n, body(n), *walks] for group in ("random", "random_balanced") for n in range(4)]
        self.champions(random + [["one_scale", 1, body(2), *walks], ["one_scale_balanced", 1, body(3), *walks], ["two_scales_balanced", 1, body(1), *walks]])
        self.done(self.script, "summary")
        folder = self.tree / "paper/scale_invariance"
        counts = {row["group"]: row["robots"] for row in table_of(folder / "statistics.csv")}
        self.assertEqual((counts["random"], counts["random_balanced"]), ("3", "2"), "champions of the other physics stay")
        self.assertEqual([row["groups"] for row in table_of(folder / "comparisons.csv")], [
            "one_scale and random", "one_scale_balanced and random_balanced", "two_scales_balanced and random_balanced", "two_scales_balanced and one_scale_balanced"])
        xml.dom.minidom.parse(str(folder / "scale_invariance.svg"))
        self.assertFalse((folder / "carried_over.svg").exists(), "shares of so few tell nothing")

    def test_an_outcome_needs_test_and_interval(self):
        # Four of ten against none of ten: Newcombe's interval ends above 0, Fisher's p is 0.087.
        ends = {True: [0.03, 0.0, 0.09, 0.0, "", ""], False: [0.03, 0.0, 0.0, 0.09, "", ""]}
        self.champions([[group, n, body(100 * place + n), *ends[n < hits]]
                        for place, (group, hits) in enumerate((("one_scale", 0), ("two_scales", 4))) for n in range(10)])
        self.done(self.script, "summary")
        (row,) = table_of(self.tree / "paper/scale_invariance/comparisons.csv")
        self.assertGreater(float(row["more_carried_over_low"]), 0.0)
        self.assertAlmostEqual(float(row["p_carried_over"]), 0.0867, delta=1e-4)
        self.assertEqual(row["more_carried_over_outcome"], "open")

    changed = "scale_invariance/changed_walks.py"

    def scenes(self, part):
        self.champions([["two_scales", 1, body(1), 0.03, 0.0, 0.09, 0.0, 0.27, 0.0], ["two_scales", 2, body(2), 0.03, 0.0, 0.09, 0.0, 0.27, 0.0],
                        ["one_scale", 1, body(3), 0.03, 0.0, 0.09, 0.0, 0.27, 0.0],
                        ["two_scales_balanced", 1, body(5), 0.03, 0.0, 0.09, 0.0, 0.27, 0.0], ["random", 3, body(4), 0.03, 0.0, 0.09, 0.0, 0.27, 0.0]])
        folder = self.tree / "scenes"
        self.done(self.changed, part, folder)
        return folder, {file.stem: tomllib.loads(file.read_text()) for file in folder.glob("*.toml")}

    def walked(self, folder, **far_m):
        for name, far in far_m.items():
            (folder / name.replace("__", "-")).mkdir()
            (folder / name.replace("__", "-") / "result.toml").write_text(f"displacement_m = [{far}, 0.0, 0.0]\n" if far else 'status = "diverged"\n')

    def test_similar_scenes_differ_in_weight_stiffness_and_drag_only(self):
        folder, scenes = self.scenes("similar")
        self.assertEqual(len(scenes), 2 * (1 + 2 * 4), "champions of two scales alone")
        preset = tomllib.loads((SOURCES / "paper/presets/paper.toml").read_text())
        study = tomllib.loads((SOURCES / "paper/fractal/two_scales.toml").read_text())
        plain = scenes["two_scales-1-2-as_it_is"]
        for table in ("loads", "ground", "materials", "damping", "drive", "collisions", "limits"):
            self.assertEqual(plain[table], preset[table])
        self.assertEqual(plain["integration"], preset["integration"] | study["integration"])
        changed = scenes["two_scales-1-2-weight_and_stiffness"]
        self.assertAlmostEqual(changed["loads"].pop("gravity_m_per_s2"), 3 * plain["loads"].pop("gravity_m_per_s2"))
        self.assertAlmostEqual(changed["materials"].pop("youngs_modulus_Pa"), 9 * plain["materials"].pop("youngs_modulus_Pa"))
        self.assertAlmostEqual(changed["damping"].pop("global"), plain["damping"].pop("global") / 3)
        self.assertEqual(changed, plain)

        # As it is the first one keeps its speed, with more weight it has half of it, and a third of that is no more like it.
        self.walked(folder, **{f"two_scales__{name}": far_m for name, far_m in (("1__1__as_it_is", 0.02), ("1__2__as_it_is", 0.06), (
            "1__2__weight", 0.03), ("1__2__stiffness", 0.02), ("2__2__weight", 0.03))})
        self.done(self.changed, "take", folder, "similar")
        self.done(self.changed, "summary")
        found = {row["change"]: row for row in table_of(self.tree / "paper/scale_invariance/similar_statistics.csv")}
        self.assertEqual({change: (row["robots"], row["speed_factor"], row["like_speed"]) for change, row in found.items()},
                         {"as_it_is": ("1", "1", "1"), "weight": ("1", "0.5", "1"), "stiffness": ("1", "0.3333", "0")}, "the second one has no baseline")
        self.assertEqual({change: (row["p_carried_over"], row["p_speed"]) for change, row in found.items()},
                         {"as_it_is": ("", ""), "weight": ("1", ""), "stiffness": ("1", "")}, "one pair has no signed rank")

    def test_changes_of_champions_are_tested_on_pairs(self):
        script = module_of("paper/scale_invariance/changed_walks.py")
        # Of six robots that stand at 9 cells all carry over with the change, at speeds that differ: 2 of 2^6 signs are as extreme.
        lower, plain, changed = (script.np.array([[way, 0.0] for way in ways]) for ways in ([0.03] * 6, [0.001] * 6, [0.09 + 0.001 * n for n in range(6)]))
        found = script.against_plain((lower, plain), (lower, changed))
        self.assertEqual((found["p_carried_over"], found["p_speed"], found["faster_outcome"]), (2 / 64, 2 / 64, "reproduced"))
        # A walk that failed went nowhere, and so not the same way.
        self.assertEqual(script.kept(lower, 0.0 * lower, 1)["same_way"], 0.0)
        # The robot that is fastest before a change is not the one that is fastest after it.
        row = script.kept(script.np.array([[0.3, 0.0], [0.03, 0.0]]), script.np.array([[0.003, 0.0], [0.06, 0.0]]), 1)
        self.assertAlmostEqual(row["fastest_after_per_minute"], 12 * 0.1)

    def test_champions_of_one_material_walk_as_in_their_search(self):
        write(self.tree / "paper/phase_wave/champions.csv", ["study", "seed", "digits"], [["two_scales", 1, body(7)], ["study", 1, body(8)]])
        _, scenes = self.scenes("balanced")
        of_wave = {name: scene for name, scene in scenes.items() if name.startswith("phase_wave")}
        self.assertEqual(sorted(of_wave), [f"phase_wave-1-{level}-{change}" for level in (1, 2) for change in ("as_it_is", "balanced", "half_step")])
        self.assertEqual({scene["drive"]["mode"] for scene in of_wave.values()}, {"wave"})
        self.assertEqual(of_wave["phase_wave-1-1-balanced"]["materials"]["beam_moments"], "balanced")
        # As it is it keeps its way and its speed in body lengths, with balanced beams it turns; the walks with half the step are not there.
        folder = self.tree / "scenes"
        for name, way in (("1-as_it_is", [0.06, 0.0]), ("2-as_it_is", [0.18, 0.0]), ("1-balanced", [0.06, 0.0]), ("2-balanced", [0.0, 0.18])):
            (folder / f"phase_wave-1-{name}").mkdir()
            (folder / f"phase_wave-1-{name}/result.toml").write_text(f"displacement_m = [{way[0]}, {way[1]}, 0.0]\n")
        self.done(self.changed, "take", folder, "balanced")
        self.done(self.changed, "summary")
        rows = table_of(self.tree / "paper/scale_invariance/one_material.csv")
        self.assertEqual([[row[name] for name in ("group", "change", "angle_deg", "speed_factor", "carries_over", "outcome")] for row in rows],
                         [["phase_wave", "as_it_is", "0", "1", "yes", "reproduced"], ["phase_wave", "balanced", "90", "1", "no", "open"]])

    def test_robots_of_the_control_have_a_body_and_an_arrangement(self):
        # Two cells side by side along x, and a step of three such bodies: two side by side along x, and one on the second of these.
        digits = "120" + "0" * 24, "110" + "0" * 6 + "010" + "0" * 15, "0" * 13 + "1" + "0" * 13
        for level in (1, 2):
            place = self.tree / f"champion/level_{level}"
            place.mkdir(parents=True)
            (place / "result.toml").write_text(f"displacement_m = [0.0{level}, 0.0, 0.0]\n")
        write(self.tree / "champion/lineage.csv", ["individual", "phenotype"], [[3, "|".join(digits)]])
        self.done(self.script, "champion", self.tree / "champion", "control_again", "1016")
        (robot,) = table_of(self.tree / "paper/scale_invariance/robots.csv")
        self.assertEqual([robot[name] for name in ("cells", "level_2_dx_m", "level_3_dx_m")], ["2", "0.02", ""], "it has two scales")
        folder = self.tree / "scenes"
        self.done(self.changed, "balanced", folder)
        scenes = {file.stem: tomllib.loads(file.read_text()) for file in folder.glob("*.toml")}
        self.assertEqual(len(scenes), 6)
        basal, arranged = (scenes[f"control_again-1016-{level}-as_it_is"]["design"] for level in (1, 2))
        self.assertEqual([basal[name] for name in ("cells", "digits", "level")], [[3, 3, 3], digits[0], 1])
        self.assertEqual([arranged[name] for name in ("cells", "level")], [[9, 9, 9], 1])
        filled = {n: digit for n, digit in enumerate(arranged["digits"]) if digit != "0"}
        self.assertEqual(filled, {0: "1", 1: "2", 3: "1", 4: "2", 243 + 3: "1", 243 + 4: "2"}, "three layers up there are 3 x 81 cells before it")
        self.walked(folder, control_again__1016__2__as_it_is=0.09)
        for robots, rows in (([digits], 1), ([(body(1), *digits[1:])], 0), ([], 0)):
            self.champions([["control_again", 1016, "|".join(parts), 0.01, 0.0, 0.02, 0.0, "", ""] for parts in robots])
            self.done(self.changed, "take", folder, "balanced")
            taken = table_of(self.tree / "paper/scale_invariance/balanced.csv")
            self.assertEqual([row["phenotype"] for row in taken], ["|".join(digits)] * rows, "robots that are gone, or others now, have no row")

    def test_champions_of_three_scales_walk_at_a_fourth_one(self):
        self.champions([[group, 1, body(1), 0.03, 0.0, 0.09, 0.0, 0.27, 0.0] for group in ("two_scales", "three_scales")])
        folder = self.tree / "scenes"
        self.done(self.changed, "fourth", folder)
        self.assertEqual(sorted(file.stem for file in folder.glob("*.toml")), ["three_scales-1-3-as_it_is", "three_scales-1-4-as_it_is"])
        self.assertEqual(tomllib.loads((folder / "three_scales-1-4-as_it_is.toml").read_text())["design"]["level"], 4)
        # One body length of 27 cells in 5 s, and half of one of 81.
        self.walked(folder, three_scales__1__3__as_it_is=0.27, three_scales__1__4__as_it_is=0.405)
        self.done(self.changed, "take", folder, "fourth")
        (folder / "three_scales-1-4-as_it_is/result.toml").write_text('status = "diverged"\n')
        self.done(self.changed, "take", folder, "fourth")
        self.done(self.changed, "summary")
        self.assertFalse((self.tree / "paper/scale_invariance/fourth_statistics.csv").exists(), "a failure is no robot that stands")
        (folder / "three_scales-1-4-as_it_is/result.toml").write_text("displacement_m = [0.405, 0.0, 0.0]\n")
        self.done(self.changed, "take", folder, "fourth")
        self.done(self.changed, "summary")
        (row,) = table_of(self.tree / "paper/scale_invariance/fourth_statistics.csv")
        self.assertEqual([row[name] for name in ("angle_deg", "speed_factor", "carries_over", "level_3_per_minute", "level_4_per_minute")], ["0", "0.5", "yes", "12", "6"])

    def test_balanced_scenes_differ_in_the_moments_of_beams_only(self):
        folder, scenes = self.scenes("balanced")
        self.assertEqual(len(scenes), 3 * 2 * 3 + 2 * 2, "champions of all searches at two scales")
        of_balanced = [scenes[f"two_scales_balanced-1-2-{name}"] for name in ("as_it_is", "half_step")]
        self.assertEqual([one["materials"]["beam_moments"] for one in of_balanced], ["balanced"] * 2, "the beams of their search")
        plain, changed, halved = (scenes[f"one_scale-1-2-{name}"] for name in ("as_it_is", "balanced", "half_step"))
        self.assertEqual((plain["materials"].pop("beam_moments"), changed["materials"].pop("beam_moments")), ("published", "balanced"))
        self.assertEqual(changed, plain)
        self.assertEqual(halved["integration"].pop("time_step_fraction"), plain["integration"].pop("time_step_fraction") / 2)

        # At 3 cells the only one of one scale keeps a quarter; of two champions of two scales one keeps all, and the other one fails.
        self.walked(folder, one_scale__1__1__as_it_is=0.12, one_scale__1__1__balanced=0.03, one_scale__1__1__half_step=0.09,
                    two_scales__1__1__as_it_is=0.06, two_scales__1__1__balanced=0.06, two_scales__2__1__as_it_is=0.06, two_scales__2__1__balanced=None)
        (folder / "two_scales-2-2-balanced").mkdir()
        (folder / "two_scales-2-2-balanced/result.toml").write_text('status = "stopped"\n')
        self.done(self.changed, "take", folder, "balanced")
        self.assertEqual(len(table_of(self.tree / "paper/scale_invariance/balanced.csv")), 7, "the one that was stopped has no row")
        self.done(self.changed, "summary")
        found = {(row["group"], row["change"]): row for row in table_of(self.tree / "paper/scale_invariance/balanced_statistics.csv")}
        one = found["one_scale", "balanced"]
        self.assertEqual([one[name] for name in ("cells_per_side", "before_per_minute", "after_per_minute", "ratio", "keep_half")], ["3", "48", "12", "0.25", "0"])
        self.assertEqual([found["one_scale", "half_step"][name] for name in ("ratio", "keep_half")], ["0.75", "1"])
        self.assertEqual([found["two_scales", "balanced"][name] for name in ("robots", "ratio", "keep_half")], ["2", "0.5", "0.5"])

    def test_champions_of_fractals_and_of_the_control_may_live_on_the_fault(self):
        # Speeds in body lengths of a walk at 3 and 9 cells, as they are and with balanced beams. The last but one of each group stands still at
        # 9 cells, the last one has not walked there.
        speeds = {"two_scales_again": [((2, 2), (2, 1)), ((3, 2), (1.5, 1)), ((2, 0), (2, 2))], "control_again": [((4, 3), (1, 3)), ((4, 2.5), (0, 2.5)), ((2, 0.05), (2, 2))]}
        rows = []
        for group, robots in speeds.items():
            for seed, changes in enumerate(robots):
                rows += [[group, seed, body(seed), level, change, 0.01 * 3**level * far[level - 1], 0.0]
                         for change, far in zip(("as_it_is", "balanced"), changes) for level in (1, 2)]
            rows.append([group, 9, body(9), 1, "as_it_is", 0.3, 0.0])
        folder = self.tree / "paper/scale_invariance"
        columns = ["group", "seed", "phenotype", "level", "change", "dx_m", "dy_m"]
        write(folder / "balanced.csv", columns, rows[:13])
        self.done(self.changed, "summary")
        self.assertFalse((folder / "against_control.csv").exists(), "there is none of the control")
        write(folder / "balanced.csv", columns, rows)
        self.done(self.changed, "summary")
        found = [[row[name] for name in ("what", "robots", "controls", "fractal", "control", "fractal_is_larger")] for row in table_of(folder / "against_control.csv")]
        self.assertEqual(found, [["share of the speed that is left at 3 cells", "2", "2", "0.75", "0.125", "1"], ["share of the speed that is left at 9 cells", "2", "2", "0.5", "1", "0"],
                                 ["fitness in the paper's simulator", "2", "2", "24", "33", "0"], ["fitness with balanced beams", "2", "2", "12", "6", "0.75"]])
        self.assertFalse((folder / "against_control.svg").exists(), "it shows the first trials of fractals, too")
        write(folder / "balanced.csv", columns, rows + [["two_scales", *row[1:]] for row in rows[:8]])
        self.done(self.changed, "summary")
        self.assertEqual({row["group"] for row in table_of(folder / "against_control.csv")}, {"two_scales", "two_scales_again"})
        xml.dom.minidom.parse(str(folder / "against_control.svg"))

    def test_refuses_what_it_does_not_know(self):
        self.refused("ham: must be one of one_scale, two_scales", self.script, "champion", self.tree, "ham", "1")
        self.refused("result.toml: cannot be read", self.script, "champion", self.tree, "one_scale", "1")


class Neighbours(Case):
    script = "non_fractal/neighbours.py"
    plane = "1" * 9 + "0" * 18

    def setUp(self):
        super().setUp()
        for name in (self.script, "fractal/again.toml"):
            shutil.copy(SOURCES / "paper" / name, self.tree / "paper" / name)
        self.scenes = self.tree / "scenes"

    def champions(self, *robots):
        write(self.tree / "paper/scale_invariance/robots.csv", ["group", "seed", "robot", "cells", "phenotype"], [[*robot[:2], 1, 9, robot[2]] for robot in robots])

    def written(self):
        return {file.stem for file in self.scenes.glob("*.toml")}

    def walked(self, ways):
        """What menger simulate writes: the way of a scene, in body lengths, by its name."""
        for name in self.written():
            level = int(name.split("-")[2])
            (self.scenes / name).mkdir(exist_ok=True)
            shutil.copy(self.scenes / f"{name}.toml", self.scenes / name / "scene.toml")
            (self.scenes / name / "result.toml").write_text(f'status = "completed"\ndisplacement_m = [0.0, {0.01 * 3**level * ways(name)}, 0.0]\n')

    def test_neighbours_differ_in_one_cell_and_are_in_one_piece(self):
        # Of a plane of nine cells each may go, or be of the other material. A cell on top lets the fractal fall apart, as the body that it stands
        # for is two cells above the next one; it is a part of the control's body, whose arrangement stays flat. No body can stand on others.
        self.champions(["two_scales_again", 11, self.plane], ["control_again", 1016, f"{self.plane}|{self.plane}|{self.plane}"])
        script = module_of("paper/non_fractal/neighbours.py")
        for robot, on_top in (({"phenotype": self.plane}, 0), ({"phenotype": f"{self.plane}|{self.plane}"}, 2 * 9)):
            found = script.neighbours(robot)
            self.assertEqual(found.pop("champion"), (self.plane, self.plane))
            self.assertEqual(sum(change.startswith("body") for change in found), 2 * 9 + on_top)
            self.assertEqual({change for change in found if change.startswith("arrangement")}, {f"arrangement_{place}" for place in range(9)})
        fractal, control = (script.neighbours({"phenotype": phenotype})["body_4_0"] for phenotype in (self.plane, f"{self.plane}|{self.plane}"))
        ring = "1111011110" + "0" * 17
        self.assertEqual((fractal, control), ((ring, ring), (ring, self.plane)), "a fractal arranges its bodies as its body")
        self.assertFalse(script.is_allowed("11" + "0" * 25, self.plane), "the least is three cells")

    def test_compares_changes_of_the_body_with_those_of_the_arrangement(self):
        self.champions(["two_scales_again", 11, self.plane])
        self.refused("robots.csv: has no robot of control_again", self.script, "first", self.scenes)
        self.champions(*[["two_scales_again", seed, self.plane] for seed in range(11, 17)], *[["control_again", seed, f"{self.plane}|{self.plane}"] for seed in range(1016, 1022)])
        self.done(self.script, "first", self.scenes)
        self.refused("simulate the scenes of its champions first", self.script, "larger", self.scenes)
        first = self.written()
        self.assertEqual(len(first), 6 * (2 + 18) + 6 * (2 + 36))

        # Fractals are slower at 9 cells than at 3, and the control at 3 cells. Bodies of eight cells are slow at 3.
        def ways(name):
            group, _, level, change = name.split("-")
            if group == "control_again":
                return {"1": 1.0, "2": 2.0}[level]
            if level == "1":
                return 1.0 if change.endswith("_0") else 3.0
            return {"champion": 2.0, "arrangement_0": 2.5, "arrangement_1": 4.0}.get(change, 1.5)
        self.walked(ways)
        self.done(self.script, "larger", self.scenes)
        larger = self.written() - first
        self.assertEqual(len(larger), 6 * (9 + 9), "of fractals nine arrangements and nine bodies that are fast at 3 cells; nothing is fitter than a champion that is slower at 3")
        self.assertEqual({name.split("-")[2] for name in larger}, {"2"})
        scene = tomllib.loads((self.scenes / "two_scales_again-11-2-arrangement_0.toml").read_text())["design"]
        self.assertEqual((scene["cells"], scene["digits"].count("1")), ([9, 9, 9], 8 * 9))
        self.walked(ways)
        self.done(self.script, "take", self.scenes)
        self.done(self.script, "summary")
        found = {(row["group"], row["change"]): row for row in table_of(self.tree / "paper/non_fractal/neighbours_statistics.csv")}
        body, arrangement = (found["two_scales_again", change] for change in ("body", "arrangement"))
        self.assertEqual([body[name] for name in ("champions", "neighbours", "fitter", "with_fitter", "gain")], ["6", "108", "0", "0", "1"])
        self.assertEqual([arrangement[name] for name in ("champions", "neighbours", "with_fitter", "gain")], ["6", "54", "1", "1.5"], "as fast at 3 cells as the champion, though 4 at 9")
        self.assertAlmostEqual(float(arrangement["fitter"]), 2 / 9, delta=1e-4)
        # All six gain more: with equal differences the signed rank is normal, (21 - 10.5) / sqrt(6 7 13 / 24 - (6^3 - 6) / 48) from its mean.
        self.assertAlmostEqual(float(arrangement["p_of_changes"]), math.erfc(10.5 / math.sqrt(22.75 - 4.375) / math.sqrt(2)), delta=2e-4)
        self.assertLess(float(arrangement["p_of_groups"]), 0.01)
        self.assertEqual([found["control_again", change][name] for change in ("body", "arrangement") for name in ("with_fitter", "gain")], ["0", "1"] * 2)
        # Walks of scenes that changed since are those of other robots.
        scene = self.scenes / "two_scales_again-11-2-arrangement_1.toml"
        scene.write_text(scene.read_text() + "# another robot\n")
        self.done(self.script, "take", self.scenes)
        (row,) = [row for row in table_of(self.tree / "paper/non_fractal/neighbours.csv") if (row["seed"], row["change"]) == ("11", "arrangement_1")]
        self.assertEqual(row["level_2_body_lengths"], "")


class Climbs(Case):
    script = "non_fractal/climbs.py"
    plane = "1" * 9 + "0" * 18

    def setUp(self):
        super().setUp()
        for name in (self.script, "non_fractal/neighbours.py", "fractal/again.toml"):
            shutil.copy(SOURCES / "paper" / name, self.tree / "paper" / name)
        self.folder = self.tree / "climbs"

    def climb(self, kind, speed):
        """A climb from a plane of nine cells, and all walks that it asked for. speed(level, body, arrangement)"""
        script, walks = module_of("paper/non_fractal/climbs.py"), []

        def walk(level, _, parts):
            walks.append((level, *parts))
            return speed(level, *parts)
        return script.climb((self.plane, self.plane), kind, walk, script.np.random.default_rng(1)), walks

    def test_tries_each_robot_nearby_once_and_stops_where_nothing_is_fitter(self):
        # The plane may lose any cell, or get another material in any: 18 robots. In the control a cell on top is a part of the body, too (18), and
        # the arrangement loses any place by itself (9), and gets none on top, where no body would touch.
        for kind, nearby in (("fractal", 18), ("free", 18 + 18 + 9)):
            found, walks = self.climb(kind, lambda level, body, arrangement: 1.0)
            self.assertEqual([(tried, change) for tried, change, _, _ in found], [(0, "start"), (nearby, "nothing_fitter_nearby")])
            self.assertEqual(len(set(walks)), len(walks))
            self.assertEqual(sum(level == 2 for level, _, _ in walks), 1, "who is no faster at 3 cells cannot be fitter")
            self.assertEqual(sum(level == 1 for level, _, _ in walks), len({body for _, body, _ in walks}), "the arrangement does not matter at 3 cells")

    def test_goes_on_from_the_first_that_is_fitter(self):
        # The fewer places are taken the faster is the aggregate; the body is fast whatever it is. Least are three cells, and nine of the aggregate.
        def speed(level, body, arrangement):
            return 100.0 if level == 1 else 30.0 - sum(digit != "0" for digit in arrangement)
        for kind in ("fractal", "free"):
            found, _ = self.climb(kind, speed)
            gains = [min(ways) for _, _, _, ways in found]
            self.assertEqual(gains, [*sorted(set(gains)), gains[-1]])
            self.assertEqual(gains[0], 21.0)
            self.assertGreaterEqual(gains[-1], 24.0)
            self.assertEqual(found[-1][1], "nothing_fitter_nearby")
            best = sum(digit != "0" for digit in found[-1][2][1])
            for _, arrangement in module_of("paper/non_fractal/climbs.py").nearby(found[-1][2], kind).values():
                self.assertGreaterEqual(sum(digit != "0" for digit in arrangement), best)
            for _, change, (body, arrangement), _ in found:
                self.assertEqual(body == arrangement, kind == "fractal" or change == "start")
                if kind == "free":
                    self.assertEqual(body, self.plane)
                    self.assertIn(change.split("_")[0], ("start", "arrangement", "nothing", "end"))
            self.assertLessEqual(found[-1][0], 150)

    def program(self, text):
        file = self.tree / "menger"
        file.write_text(f"#!/bin/sh\n{text}\n")
        file.chmod(0o755)
        return file

    def test_compares_climbs_of_the_same_robots(self):
        seeds = range(11, 17)
        write(self.tree / "paper/scale_invariance/robots.csv", ["group", "seed", "robot", "cells", "phenotype"], [["two_scales_again", seed, 1, 9, self.plane] for seed in seeds])
        self.assertEqual(self.done(self.script, "robots").split("\n")[0], "two_scales_again 11")
        self.refused("has no robot of two_scales with seed 1", self.script, "climb", self.folder, "menger", "two_scales", 1)
        # 2 body lengths at 3 cells of whatever robot. At 9 cells the whole plane goes one, and robots without a body in its first place go two.
        # Those without the first cell of the next body, too, fail; a fractal can only lack both.
        walks = self.program('''mkdir -p "$4"
digits=$(sed -n 's/^digits = "\\(.*\\)"/\\1/p' "$2")
case $digits in
  ???????????????????????????) way=0.06 ;;
  0000*) echo 'status = "diverged"' > "$4/result.toml"; exit 3 ;;
  000*) way=0.18 ;;
  *) way=0.09 ;;
esac
printf 'status = "completed"\ndisplacement_m = [0.0, %s, 0.0]\n' "$way" > "$4/result.toml"''')
        for seed in seeds:
            self.done(self.script, "climb", self.folder, walks, "two_scales_again", seed)
        self.done(self.script, "take", self.folder)
        self.done(self.script, "summary")
        table = self.tree / "paper/non_fractal/climbs.csv"
        rows, text = table_of(table), table.read_text()
        self.assertEqual({row["change"] for row in rows if row["way"] == "fractal"}, {"start", "nothing_fitter_nearby"})
        self.assertEqual({row["change"] for row in rows if row["way"] == "free"}, {"start", "arrangement_0", "nothing_fitter_nearby"})
        found = {(row["robots"], row["way"]): row for row in table_of(self.tree / "paper/non_fractal/climbs_statistics.csv")}
        fractal, free = (found["two_scales_again", kind] for kind in ("fractal", "free"))
        self.assertEqual([fractal[name] for name in ("number", "gain", "over_fractal", "tried", "nothing_fitter_nearby", "p_gains")], ["6", "1", "", "18", "1", ""])
        self.assertEqual([free[name] for name in ("number", "gain", "over_fractal", "larger_than_fractal", "steps_of_body", "steps_of_arrangement", "fitter_outcome")], ["6", "2", "2", "1", "0", "1", "reproduced"])
        # All six are twice as fit: with equal differences the signed rank is normal, 10.5 / sqrt(6 7 13 / 24 - (6^3 - 6) / 48) from its mean.
        self.assertEqual({robots for robots, _ in found}, {"two_scales_again"}, "the other kind is not there")
        for test in ("p_gains", "p_fractal"):
            self.assertAlmostEqual(float(free[test]), math.erfc(10.5 / math.sqrt(22.75 - 4.375) / math.sqrt(2)), delta=2e-4)
        early = [row for row in table_of(self.tree / "paper/non_fractal/climbs_on_the_way.csv") if row["way"] == "fractal"]
        self.assertEqual([(row["after"], row["tried"]) for row in early], [("50", "18"), ("100", "18")], "there are 18 nearby")
        # Nothing is walked again, and a robot that is another one now has no climb yet.
        for seed in seeds:
            self.done(self.script, "climb", self.folder, self.program("exit 1"), "two_scales_again", seed)
        self.done(self.script, "take", self.folder)
        self.assertEqual(table.read_text(), text)
        write(self.tree / "paper/scale_invariance/robots.csv", ["group", "seed", "robot", "cells", "phenotype"], [["two_scales_again", 11, 1, 8, "0" + self.plane[1:]]])
        self.refused("does not begin with the robot that is there now", self.script, "take", self.folder)

    def test_a_stop_leaves_no_table_and_an_error_of_the_program_is_its_own(self):
        write(self.tree / "paper/scale_invariance/robots.csv", ["group", "seed", "robot", "cells", "phenotype"], [["two_scales_again", 11, 1, 9, self.plane]])
        for code in (130, 2):
            outcome = self.call(self.script, "climb", self.folder, self.program(f"exit {code}"), "two_scales_again", 11)
            self.assertEqual(outcome.returncode, code)
            self.assertEqual("the same command goes on" in outcome.stderr, code == 130)
            self.assertFalse((self.folder / "two_scales_again-11.csv").exists())


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
        self.assertEqual((fractal["trials"], fractal["first"], fractal["dimension_2"], fractal["dimension_2.5_to_2.7"]), ("10", "0", "5", "5"))
        # Wilson's interval of 5 of 10: (p + z^2 / 2n -+ z sqrt(p (1 - p) / n + z^2 / 4n^2)) / (1 + z^2 / n) with z = 1.96
        for name in ("dimension_2", "dimension_2.5_to_2.7"):
            self.assertEqual([fractal[f"{name}_{end}"] for end in ("share", "low", "high")], ["0.5", "0.2366", "0.7634"])
            self.assertEqual([found["non_fractal"][f"{name}{end}"] for end in ("", "_share", "_low", "_high")], [""] * 4, "no fractal has none")
        self.assertEqual((fractal["larger_is_slower"], fractal["compared_cells"], compared[0]["generations"]), ("1", "9 and 3", "2"))
        # All ten rise: 2 of 2^10 signs are as extreme, whichever way; at 9 cells all are slower.
        self.assertEqual((fractal["p_first_last"], fractal["p_scales"], fractal["gain_outcome"]), ("0.001953", "0.001953", "reproduced"))
        self.assertLess(float(fractal["p_first_last_rank_sum"]), 1e-3)
        self.assertEqual((fractal["larger_is_slower_outcome"], compared[0]["larger_outcome"]), ("reproduced", "reproduced"))
        self.assertEqual(fractal["no_difference_outcome"], "not reproduced", "all ends at 3 cells are faster than all at 9")
        self.assertEqual((fractal["dimension_p_paper"], fractal["dimension_outcome"]), ("1", "open"), "five planes and five between 2.5 and 2.7, as in the paper")
        self.assertEqual((found["non_fractal"]["dimension_p_paper"], found["non_fractal"]["dimension_outcome"]), ("", ""))
        self.assertEqual(len(table_of(folder / "champions.csv")), 25)
        # All trials rise at both scales, in one change each, and end twice as fast at 3 cells as at 9. The first robots have three cells.
        at_3, at_9 = [row for row in table_of(folder / "scales.csv") if row["arm"] == "fractal"]
        self.assertEqual([at_3[name] for name in ("cells_per_side", "rises", "rises_outcome", "changes", "upwards", "is_fastest", "is_twice_as_fast")], ["3", "1", "reproduced", "10", "1", "10", "10"])
        self.assertEqual([at_9[name] for name in ("cells_per_side", "rises", "is_fastest", "is_twice_as_fast")], ["9", "1", "0", "0"])
        self.assertEqual((fractal["early_cubes"], fractal["early_cubes_outcome"], found["non_fractal"]["early_cubes"]), ("0", "open", ""))
        xml.dom.minidom.parse(str(folder / "trials.svg"))
        self.assertFalse((folder / "variants.svg").exists(), "there is no variant")

    def test_outcomes_are_open_where_the_interval_has_no_effect_inside(self):
        # Eight of ten are slower at the larger scale: 49 to 94 %. All ten are between 2.5 and 2.7, where five of the paper's ten are planes:
        # p is 2 C(10, 5) / C(20, 5) = 0.0325. None rises at all.
        for seed in range(1, 11):
            slower = 0.001 * seed if seed <= 8 else -0.001 * seed
            rows = [[n, 1.0, 17, 2.5789, 2.0 + slower, 2.0] for n in range(3)]
            write(self.tree / f"paper/fractal/two_scales/{seed}.csv", self.columns, rows)
        for seed in range(1001, 1005):
            self.trial("non_fractal/two_scales", seed, 1.0 + (-0.1) ** (seed - 1000))
        self.done(self.script)
        found = {row["arm"]: row for row in table_of(self.tree / "paper/fractal/statistics.csv")}["fractal"]
        self.assertEqual((found["larger_is_slower"], found["larger_is_slower_outcome"]), ("0.8", "open"))
        # Those that are faster have the largest ranks, 9 and 10: a rank sum of 19 is as extreme as one of 36.
        ways = sum(sum(rank for rank, sign in zip(range(1, 11), signs) if sign) <= 19 for signs in itertools.product((0, 1), repeat=10))
        self.assertAlmostEqual(float(found["p_scales"]), 2 * ways / 1024, delta=1e-4)
        self.assertEqual((found["gain"], found["gain_outcome"], found["p_first_last"]), ("0", "open", "1"))
        self.assertEqual((found["dimension_outcome"], found["dimension_p_paper"]), ("differs", "0.03251"))
        self.assertEqual(table_of(self.tree / "paper/fractal/comparisons.csv")[0]["larger_outcome"], "open")

    def test_counts_best_robots_and_not_their_generations(self):
        script = module_of("paper/fractal/trials.py")
        columns = ["best_fitness_body_lengths", "hausdorff_dimension", "champion_cells", "level_1_displacement_body_lengths", "level_2_displacement_body_lengths"]
        # No robot at first; one that is slower at 9 cells by a tenth, for three generations; one that is slower at 3, for two.
        trial = script.Trial(1, [dict(zip(columns, ["1", "2", "9", *map(str, speeds)])) for speeds in [("", "")] + [(1.0, 0.9)] * 3 + [(0.5, 2.0)] * 2])
        self.assertEqual(script.leads_of([trial], [1, 2]), {"largest_is_slowest_generations": 3, "all_generations": 6, "best_robots": 2, "largest_is_slowest_robots": 1, "longest_lead": 3, "longest_lead_margin": 1.0 - 12.0 * 0.9 / 12.0})

    def test_means_stand_at_their_generations(self):
        script = module_of("paper/fractal/trials.py")
        drawn = {}

        class Panel:
            def plot(self, x, y, **_):
                drawn["line"] = (list(x), list(y))

            def fill_between(self, x, low, high, **_):
                drawn["band"] = (list(x), list(low), list(high))

        nan = math.nan
        script.draw_mean(Panel(), [[nan, 1.0, 2.0, nan, 4.0], [0.0, 1.0, 2.0, 3.0, 6.0]], "k", "-", "")
        self.assertEqual(drawn["line"], ([1, 2, 4], [1.0, 2.0, 5.0]), "generations 0 and 3, which one curve lacks, are left out")
        self.assertEqual(drawn["band"][0], [1, 2, 4])

    def test_ticks_of_the_dimension_end_with_the_trials(self):
        script = module_of("paper/fractal/trials.py")
        pyplot = script.pyplot_for_svg()

        class Made:
            def __init__(self, generations):
                self.dimension = script.np.full(generations + 1, 2.5)

        for generations, ticks in ((20, [0, 5, 10, 15, 20]), (3, [0, 1, 2, 3]), (325, [0, 50, 100, 150, 200, 250, 300]), (0, [0, 1])):
            panel = pyplot.figure().add_subplot()
            script.draw_dimensions(panel, [Made(generations)] * 2)
            self.assertEqual(list(panel.get_xticks()), ticks)

    def test_takes_trials_of_three_scales_and_other_lengths(self):
        for seed in range(1, 5):
            self.trial("fractal/two_scales", seed, 1.0)
        for seed in range(1001, 1005):
            self.trial("non_fractal/two_scales", seed, 3.0)
            with open(self.tree / f"paper/non_fractal/two_scales/{seed}.csv", "a", encoding="utf-8") as text:
                text.write("3,9,9,,9,9\n")
        # The largest is faster than the middle scale in one of four trials, and the smallest decides.
        for seed in range(1, 5):
            largest = 2.0 if seed == 1 else 0.8
            write(self.tree / f"paper/fractal/three_scales/{seed}.csv", self.columns + ["level_3_displacement_body_lengths"],
                  [[0, 0.1, 3, 1.0, 0.1, 0.2, 0.3], [1, 0.5, 17, 2.5789, 0.5, 1.0, largest]])
        self.done(self.script)
        folder = self.tree / "paper/fractal"
        found = {row["arm"]: row for row in table_of(folder / "statistics.csv")}
        self.assertEqual({arm: row["generations"] for arm, row in found.items()}, {"fractal": "2", "non_fractal": "3", "three_scales": "1"})
        three = found["three_scales"]
        self.assertLess(float(three["p_first_last"]), 1.0)
        self.assertEqual((three["compared_cells"], three["larger_is_slower"], three["last"], three["dimension_2.5_to_2.7"]), ("27 and 9", "0.75", "6", "4"))
        self.assertEqual((three["largest_is_slowest_generations"], three["all_generations"]), ("0", "8"))
        self.assertEqual((found["fractal"]["largest_is_slowest_generations"], found["fractal"]["all_generations"]), ("8", "12"), "0.1 of 0.2 and 1 of 2, and at first none")
        (compared,) = table_of(folder / "comparisons.csv")
        # At generation 2, which both have: 1 and 3 body lengths.
        self.assertEqual((compared["generations"], compared["larger"], compared["medians_ratio"]), ("2", "0", "0.3333"))
        champions = {(row["arm"], row["seed"]): row for row in table_of(folder / "champions.csv")}
        self.assertEqual([champions["three_scales", "1"][f"level_{level}_per_minute"] for level in (1, 2, 3)], ["6", "12", "24"])
        self.assertEqual([champions["fractal", "1"][f"level_{level}_per_minute"] for level in (1, 2, 3)], ["24", "12", ""])
        xml.dom.minidom.parse(str(folder / "trials.svg"))

    def test_one_trial_has_no_p(self):
        self.trial("fractal/two_scales", 1, 1.0)
        self.done(self.script)
        (row,) = table_of(self.tree / "paper/fractal/statistics.csv")
        self.assertEqual([row[f"p_{name}{test}"] for name in ("first_last", "scales") for test in ("", "_rank_sum")], [""] * 4)

    def test_studies_of_balanced_beams_differ_in_these_alone(self):
        for name in ("fractal/two_scales", "scale_invariance/one_scale", "scale_invariance/random"):
            plain, balanced = (tomllib.loads((SOURCES / f"paper/{name}{end}.toml").read_text()) for end in ("", "_balanced"))
            self.assertEqual(balanced.pop("materials"), {"beam_moments": "balanced"}, name)
            for study in (plain, balanced):
                study.pop("generations")  # as many as were run so far
            self.assertEqual(balanced, plain, name)

    def test_generations_count_that_all_trials_have(self):
        for seed in (1, 2):
            self.trial("fractal/two_scales", seed, 1.0)
        with open(self.tree / "paper/fractal/two_scales/2.csv", "a", encoding="utf-8") as text:
            text.write("3,9,27,3,9,9\n")
        self.done(self.script)
        row, longer = table_of(self.tree / "paper/fractal/statistics.csv")
        self.assertEqual((row["arm"], row["trials"], row["generations"], row["last"], row["dimension_2"]), ("fractal", "2", "2", "12", "2"))
        self.assertEqual((longer["arm"], longer["trials"], longer["generations"], longer["last"], longer["dimension_2"]), ("fractal_longer", "1", "3", "108", "0"))
        champions = {(row["arm"], row["seed"]): (row["body_lengths_per_minute"], row["cells"]) for row in table_of(self.tree / "paper/fractal/champions.csv")}
        self.assertEqual(champions, {("fractal", "1"): ("12", "9"), ("fractal", "2"): ("12", "9"), ("fractal_longer", "2"): ("108", "27")})

    def test_arms_are_also_compared_on_the_way(self):
        for folder, seeds, speed in (("fractal", (1, 2, 3), 0.02), ("non_fractal", (1001, 1002, 1003), 0.01)):
            for seed in seeds:
                self.trial(f"{folder}/two_scales", seed, 0.0)
                with open(self.tree / f"paper/{folder}/two_scales/{seed}.csv", "a", encoding="utf-8") as text:
                    text.writelines(f"{n},{speed * n},9,2,{speed * n},{speed * n}\n" for n in range(3, 61))
        self.done(self.script)
        rows = table_of(self.tree / "paper/fractal/on_the_way.csv")
        self.assertEqual([(row["arms"], row["generations"], row["larger"], row["medians_ratio"]) for row in rows],
                         [("fractal and non_fractal", at, "1", "2") for at in ("20", "40")])
        self.assertEqual(table_of(self.tree / "paper/fractal/comparisons.csv")[0]["generations"], "60")

    def test_longer_trials_are_compared_as_far_as_all_of_them_go(self):
        for folder, seeds, last in (("fractal", (1, 2, 3), 2.0), ("non_fractal", (1001, 1002, 1003), 1.0)):
            for seed in seeds:
                self.trial(f"{folder}/two_scales", seed, 0.5)
                longer = seed - seeds[0]  # further generations: none, one, two
                with open(self.tree / f"paper/{folder}/two_scales/{seed}.csv", "a", encoding="utf-8") as text:
                    text.writelines(f"{3 + n},{last * (1 + n)},9,2,{last},{last}\n" for n in range(longer))
        self.done(self.script)
        short, longer = table_of(self.tree / "paper/fractal/comparisons.csv")
        self.assertEqual((short["arms"], short["trials"], short["generations"], short["larger"]), ("fractal and non_fractal", "3", "2", "0.5"))
        self.assertEqual([longer[name] for name in ("arms", "trials", "other_trials", "generations", "larger", "medians_ratio")],
                         ["fractal_longer and non_fractal_longer", "2", "2", "3", "1", "2"])
        xml.dom.minidom.parse(str(self.tree / "paper/fractal/trials.svg"))

    def test_arms_with_the_same_seeds_are_pairs(self):
        # One of ten trials is worse where bodies may fall apart, by less than all others are better: 2 of 2^10 signs of the smallest one and
        # 2 without are as extreme. Against random search, whose seeds are others, no pairs: all ten are larger than all three.
        for seed in range(1, 11):
            self.trial("fractal/two_scales", seed, 2.0 + 0.01 * seed)
            self.trial("fractal/two_scales_in_pieces", seed, 2.0 + 0.011 if seed == 1 else 1.0)
        for seed in range(2001, 2004):
            self.trial("fractal/random_search", seed, 0.0005 * seed)
        self.done(self.script)
        for name, shown in (("trials", False), ("variants", True)):
            figure = (self.tree / f"paper/fractal/{name}.svg").read_text()
            self.assertEqual("  fractal, may fall apart -->" in figure, shown, name)
            self.assertIn("<!-- fractal (n = 10) -->", figure)
        pieces, drawn = table_of(self.tree / "paper/fractal/comparisons.csv")
        self.assertEqual((pieces["arms"], pieces["test"], pieces["p"], pieces["larger"]), ("fractal and in_pieces", "signed rank", "0.003906", "0.9"))
        self.assertEqual((pieces["larger_outcome"], float(pieces["larger_low"]) > 0.5), ("reproduced", True))
        self.assertEqual((drawn["arms"], drawn["test"], drawn["larger"], drawn["larger_outcome"]), ("fractal and random_search", "rank sum", "1", "reproduced"))
        self.assertAlmostEqual(float(drawn["p"]), 2 / math.comb(13, 3), delta=1e-5)

    def test_arms_are_compared_after_as_many_evaluations(self):
        # Fractals need 10 evaluations a generation, the control 20 and one trial 19. After the 30 of two more generations fractals are at their
        # last one, and the control at its first: 19 or 20 evaluations fit, 38 or 40 do not.
        columns = self.columns + ["evaluations"]
        for seed in (1, 2, 3):
            write(self.tree / f"paper/fractal/two_scales/{seed}.csv", columns, [[n, 1.0 + n, 9, 2.0, 1.0, 1.0, 10] for n in range(3)])
            write(self.tree / f"paper/non_fractal/two_scales/{1000 + seed}.csv", columns, [[n, 2.0 + n, 9, "", 1.0, 1.0, 19 if seed == 1 else 20] for n in range(3)])
        self.done(self.script)
        (row,) = table_of(self.tree / "paper/fractal/equal_evaluations.csv")
        self.assertEqual([row[name] for name in ("arms", "evaluations", "generations", "other_generations", "test", "larger", "medians_ratio")],
                         ["fractal and non_fractal", "30", "2", "0", "rank sum", "1", "1.5"])

    def test_an_arm_is_better_only_if_its_test_agrees(self):
        # Both of two are larger than all of six: the interval ends just above a half, and 2 of the C(8, 2) = 28 orders are as extreme.
        for seed in (1, 2):
            self.trial("fractal/two_scales", seed, 1.0 + 0.01 * seed)
        for seed in range(2001, 2007):
            self.trial("fractal/random_search", seed, 0.0001 * seed)
        self.done(self.script)
        (drawn,) = table_of(self.tree / "paper/fractal/comparisons.csv")
        self.assertGreater(float(drawn["larger_low"]), 0.5)
        self.assertEqual((drawn["p"], drawn["larger_outcome"]), (f"{2 / 28:.4g}", "open"))

    def test_a_test_that_was_looked_at_often_decides_less(self):
        # All three are larger than all six, 2 of C(9, 3) = 84 orders are as extreme. Three looks make 0.024 more than 0.05.
        for generations, looks, outcome in ((3, "1", "reproduced"), (60, "3", "open")):
            for folder, seeds, best in (("two_scales", range(1, 4), 1.0), ("random_search", range(2001, 2007), 0.1)):
                for seed in seeds:
                    rows = [[n, best + 1e-5 * seed, 9, 2.0, 1.0, 1.0] for n in range(generations + 1)]
                    write(self.tree / f"paper/fractal/{folder}/{seed}.csv", self.columns, rows)
            self.done(self.script)
            (drawn,) = table_of(self.tree / "paper/fractal/comparisons.csv")
            self.assertEqual((drawn["p"], drawn["looks"], drawn["larger_outcome"]), (f"{2 / 84:.4g}", looks, outcome))
            self.assertAlmostEqual(float(drawn["p_looks"]), int(looks) * 2 / 84, delta=1e-4)
        script = module_of("paper/fractal/trials.py")
        self.assertEqual([script.looks(generation) for generation in (0, 20, 21, 140)], [1, 1, 2, 7])
        self.assertEqual((script.times_looks(None, 2), script.times_looks(0.6, 2)), (None, 1.0))

    def test_what_was_planned_is_tested_once(self):
        def put(folder, seed, speed, generations=60):
            write(self.tree / f"paper/{folder}/again/{seed}.csv", self.columns, [[n, (speed + 1e-5 * seed) * n, 9, 2, speed * n, speed * n] for n in range(generations + 1)])

        for folder, seeds, speed in (("fractal", range(11, 26), 0.01), ("non_fractal", range(1016, 1031), 0.02)):
            for seed in seeds:
                if seed == 1030:
                    self.done(self.script)
                    self.assertFalse((self.tree / "paper/fractal/comparisons.csv").exists(), "what was planned is not complete")
                    self.assertEqual({row["arm"] for row in table_of(self.tree / "paper/fractal/champions.csv")}, {"fractal_again"}, "nor looked at")
                put(folder, seed, speed)
        self.done(self.script)
        (row,) = table_of(self.tree / "paper/fractal/comparisons.csv")
        self.assertEqual((row["arms"], row["generations"], row["p"], row["looks"], row["p_looks"]), ("fractal_again and non_fractal_again", "60", row["p_looks"], "1", f"{2 / math.comb(30, 15):.4g}"))
        for name in ("on_the_way", "equal_evaluations"):
            self.assertFalse((self.tree / f"paper/fractal/{name}.csv").exists(), "another test of the same trials")
        self.assertEqual({row["looks"] for row in table_of(self.tree / "paper/fractal/statistics.csv")}, {"1"})
        script = module_of("paper/fractal/trials.py")
        self.assertEqual([script.looks(60, *names) for names in (["fractal_again"], ["fractal", "fractal_again"], ["fractal"], ["fractal_again_longer"])], [1, 3, 3, 3])
        # Who goes on with them leaves the test as it was.
        for seed in range(11, 26):
            put("fractal", seed, 0.01, 70)
        self.done(self.script)
        self.assertEqual(table_of(self.tree / "paper/fractal/comparisons.csv"), [row])
        self.assertEqual({row["arm"]: row["generations"] for row in table_of(self.tree / "paper/fractal/statistics.csv")},
                         {"fractal_again": "60", "fractal_again_longer": "70", "non_fractal_again": "60"})

    def test_says_whether_the_fault_of_the_simulator_changes_the_lead(self):
        # At the end the control is twice as fit as fractals with the fault. Without it fractals keep 0.9 and the control 0.4 of what the trial
        # of the same seed reaches with it, so that fractals lead 1.125 times. Trials differ up to ten times, and until generation 59 all do as well.
        last = None
        for folder, seeds, scale, kept in (("fractal", range(11, 26), 1.0, 0.9), ("non_fractal", range(1016, 1031), 2.0, 0.4)):
            for place, seed in enumerate(seeds):
                for name, share in (("again", 1.0), ("again_balanced", kept)):
                    end = scale * share * (1 + (4 * place) % 15) * (1.0 + 1e-6 * seed)
                    last = (self.tree / f"paper/{folder}/{name}/{seed}.csv", self.columns, [[n, 0.01, 9, 2, 0.01, 0.01] for n in range(60)] + [[60, end, 9, 2, end, end]])
                    if last[0].match("non_fractal/again_balanced/1030.csv"):
                        break
                    write(*last)
        self.done(self.script)
        changes = self.tree / "paper/fractal/without_fault.csv"
        self.assertFalse(changes.exists(), "before all four arms are complete")
        write(*last)
        self.done(self.script)
        (row,) = table_of(changes)
        self.assertEqual((row["arms"], row["trials"], row["other_trials"]), ("fractal and control", "15", "15"))
        for name, value in (("change", 0.9), ("other_change", 0.4), ("change_ratio", 2.25)):
            for end in ("", "_low", "_high"):
                self.assertAlmostEqual(float(row[name + end]), value, delta=1e-3, msg="all pairs of a seed change as much")
        self.assertAlmostEqual(float(row["lead"]), 2.0, delta=0.01)
        self.assertLess(float(row["lead_low"]), 1.5, "trials differ much")
        self.assertEqual((row["larger"], row["larger_outcome"]), ("1", "reproduced"))
        self.assertLess(float(row["p"]), 1e-5)
        found = {row["arms"]: row for row in table_of(self.tree / "paper/fractal/comparisons.csv")}
        for name in ("fractal_again", "non_fractal_again"):
            pairs = found[f"{name} and {name}_balanced"]
            self.assertEqual((pairs["test"], pairs["larger"], pairs["looks"]), ("signed rank", "1", "1"), "trials of the same seed are pairs")
        (self.tree / "paper/fractal/again/25.csv").rename(self.tree / "paper/fractal/again/26.csv")
        self.refused("again_balanced: must have the seeds of", self.script)

    def test_variants_of_a_search_differ_from_it_in_one_thing(self):
        evolution, drawn = (tomllib.loads((SOURCES / f"paper/fractal/{name}.toml").read_text()) for name in ("two_scales", "random_search"))
        self.assertEqual(drawn.pop("population"), {"survivors": 1, "mutants": 0, "newcomers": 16})
        self.assertEqual(drawn, evolution)
        control, drawn = (tomllib.loads((SOURCES / f"paper/non_fractal/{name}.toml").read_text()) for name in ("two_scales", "random_search"))
        self.assertEqual(drawn.pop("population"), {"survivors": 1, "mutants": 0, "newcomers": 16})
        for study in (control, drawn):
            del study["seed"], study["generations"]
        self.assertEqual(drawn, control)
        for folder, plain in (("fractal", evolution), ("non_fractal", control)):
            again = tomllib.loads((SOURCES / f"paper/{folder}/again.toml").read_text())
            self.assertEqual(again | {"generations": None, "seed": None}, plain | {"generations": None, "seed": None})
            balanced = tomllib.loads((SOURCES / f"paper/{folder}/again_balanced.toml").read_text())
            self.assertEqual(balanced.pop("materials"), {"beam_moments": "balanced"})
            self.assertEqual(balanced, again)
        cells = tomllib.loads((SOURCES / "paper/fractal/single_cells.toml").read_text())
        self.assertEqual(cells.pop("genome"), {"most_changed_cells": 1})
        self.assertEqual(cells | {"generations": evolution["generations"]}, evolution)
        new = tomllib.loads((SOURCES / "paper/fractal/new_mutants.toml").read_text())
        self.assertEqual(new.pop("evaluation"), {"duplicates": "redrawn"})
        self.assertEqual(new | {"generations": evolution["generations"]}, evolution)
        mutants = tomllib.loads((SOURCES / "paper/non_fractal/body_mutants.toml").read_text())
        self.assertIs(mutants["genome"].pop("mutants_may_keep_body"), False)
        del mutants["seed"], mutants["generations"]
        self.assertEqual(mutants, control)
        population = options_of("paper")
        self.assertEqual(population["population.mutants"] + population["population.newcomers"], 16, "as many robots are asked for in a generation")

    def test_refuses_a_trial_without_generations(self):
        write(self.tree / "paper/fractal/two_scales/1.csv", self.columns, [])
        self.refused("fractal/two_scales/1.csv: has no generation", self.script)


class Heredity(Case):
    def individuals(self, trial, columns, rows):
        """What menger export writes of a search, of which generation 0 has no parents and all others are of generation 1."""
        write(self.tree / "found" / trial / "individuals.csv", ["generation", *columns, "fitness_body_lengths"], [[int(row[1] != ""), *row, 1.0] for row in rows])

    def test_tells_how_much_speed_mutants_keep(self):
        # Twelve parents that go 1 to 12 body lengths at both scales, with a mutant of two cells each. At 3 cells every other one goes twice as
        # fast, the others 0.4 times. At 9 cells selection needs six of the first trial, too few to tell; of the second one all, in reverse order.
        columns = ["individual", "parent", "phenotype"] + [f"level_{level}_d{axis}_m" for level in (1, 2) for axis in "xy"]
        ways = [n + 1.0 for n in range(12)]
        small = [way * (2.0 if n % 2 == 0 else 0.4) for n, way in enumerate(ways)]
        large = {1: [2.0 * way if n % 2 == 0 else None for n, way in enumerate(ways)], 2: ways[::-1]}
        for seed in (1, 2):
            rows = [[n, "", "111" + "0" * 24, 0.03 * way, 0, 0.09 * way, 0] for n, way in enumerate(ways)]
            rows += [[20 + n, n, "11121" + "0" * 22, 0.03 * small[n], 0, *(("", "") if large[seed][n] is None else (0.09 * large[seed][n], 0))] for n in range(12)]
            self.individuals(f"fractal-{seed}", columns, rows)
        self.done("heredity/heredity.py", self.tree / "found")
        at_3, at_9 = table_of(self.tree / "paper/heredity/heredity.csv")
        self.assertEqual([at_3[name] for name in ("arm", "cells_per_side", "cells_changed", "trials", "mutants", "keep_half", "faster")],
                         ["fractal", "3", "2", "2", "24", "0.5", "0.5"])
        self.assertAlmostEqual(float(at_3["spearman"]), spearman_of(ways, small), delta=1e-3)
        kept = sum(13.0 - way >= 0.5 * way for way in ways)
        self.assertEqual([at_9[name] for name in ("cells_per_side", "trials", "mutants", "spearman", "keep_half", "faster")],
                         ["9", "1", "12", "-1", f"{kept / 12:.4g}", "0.5"])
        # 15 body lengths a minute are 1.25 in 5 s. Of parents eleven go as fast. Mutants of the first trial: the six that walked at 9.
        of_second = sum(min(one, other) >= 1.25 for one, other in zip(small, ways[::-1])) / 12
        mutants, drawn = table_of(self.tree / "paper/heredity/mutants.csv")
        self.assertEqual((mutants["kind"], mutants["robots"], float(mutants["fast"])), ("mutants", "24", float(f"{(6 / 12 + of_second) / 2:.4g}")))
        self.assertEqual((drawn["kind"], drawn["robots"], float(drawn["fast"])), ("drawn at random", "24", float(f"{11 / 12:.4g}")))
        self.refused("has no ARM-SEED/individuals.csv with mutants", "heredity/heredity.py", self.tree)

    def test_mutants_of_the_control_change_the_body_or_its_arrangement(self):
        columns = ["individual", "parent", "phenotype"] + [f"level_{level}_d{axis}_m" for level in (1, 2) for axis in "xy"]
        body_of, arranged = "111" + "0" * 24, "11" + "0" * 25
        rows = [[0, "", f"{body_of}|{arranged}", 0.06, 0, 0.09, 0],  # 2 and 1 body lengths
                [1, 0, f"{body_of}|111{arranged[3:]}", 0.06, 0, 0.135, 0],  # another arrangement, fitter
                [2, 0, f"{body_of}|101{arranged[3:]}", 0.06, 0, "", ""],  # another one, not needed at 9 cells
                [3, 0, f"1111{body_of[4:]}|{arranged}", 0.015, 0, 0.18, 0]]  # another body, slower at 3
        self.individuals("control-1001", columns, rows)
        self.individuals("fractal-1", columns, [[0, "", body_of, 0.06, 0, 0.09, 0]]
                         + [[n, 0, "1111" + "0" * 23, 0.03 * n, 0, 0.135, 0] for n in range(1, 13)])
        self.done("heredity/heredity.py", self.tree / "found")
        self.assertEqual({row["arm"] for row in table_of(self.tree / "paper/heredity/inherited.csv")}, {"fractal"}, "ten mutants of a kind are needed to tell")
        rows = {(row["arm"], row["kind"]): row for row in table_of(self.tree / "paper/heredity/mutants.csv")}
        self.assertEqual({key: (row["robots"], row["fitter"], row["fast"]) for key, row in rows.items() if key[0] == "control"},
                         {("control", "mutants of the body"): ("1", "0", "0"), ("control", "mutants of its arrangement alone"): ("2", "0.5", "0.5"),
                          ("control", "drawn at random"): ("1", "", "0")})
        self.assertEqual(rows["fractal", "mutants"]["fitter"], f"{11 / 12:.4g}", "all but the one that goes as fast")
        self.assertEqual({row["arm"] for row in table_of(self.tree / "paper/heredity/heredity.csv")}, {"fractal"})
        before = [(self.tree / f"paper/heredity/{name}.csv").read_text() for name in ("heredity", "inherited", "mutants", "repeats")]
        shutil.rmtree(self.tree / "found/control-1001")
        self.done("heredity/heredity.py", self.tree / "found")
        self.assertEqual([(self.tree / f"paper/heredity/{name}.csv").read_text() for name in ("heredity", "inherited", "mutants", "repeats")], before, "who is not there keeps its rows")

    def test_tells_what_mutants_of_the_control_inherit(self):
        # Those of another arrangement keep their speed at 9 cells, those of another body go the other way round.
        columns = ["individual", "parent", "phenotype"] + [f"level_{level}_d{axis}_m" for level in (1, 2) for axis in "xy"]
        body_of, arranged = "111" + "0" * 24, "11" + "0" * 25
        ways = [n + 1.0 for n in range(12)]
        rows = [[n, "", f"{body_of}|{arranged}", 0.03 * way, 0, 0.09 * way, 0] for n, way in enumerate(ways)]
        rows += [[20 + n, n, f"{body_of}|111{arranged[3:]}", 0.03 * way, 0, 0.09 * way, 0] for n, way in enumerate(ways)]
        rows += [[40 + n, n, f"1111{body_of[4:]}|{arranged}", 0.03 * way, 0, 0.09 * (13.0 - way), 0] for n, way in enumerate(ways)]
        self.individuals("control_again-1016", columns, rows)
        self.individuals("control_again-1017", columns, rows[:12])  # has no mutants yet
        self.done("heredity/heredity.py", self.tree / "found")
        found = {(row["cells_per_side"], row["kind"]): (row["mutants"], float(row["spearman"])) for row in table_of(self.tree / "paper/heredity/inherited.csv")}
        self.assertEqual(found, {("3", "mutants of the body"): ("12", 1.0), ("9", "mutants of the body"): ("12", -1.0), ("9", "mutants of its arrangement alone"): ("12", 1.0),
                                 ("3", "mutants of the body alone"): ("12", 1.0), ("9", "mutants of the body alone"): ("12", -1.0)}, "none changes both")

    def test_compares_robots_that_are_drawn_at_random(self):
        # Body lengths in 5 s at both scales. Fractals: 1 and 1, 2 and 3, 3 and 2; the control: 2.5 and 4, 4 and 1.5.
        columns = ["generation", "individual", "parent", "phenotype", "fitness_body_lengths"] + [f"level_{level}_d{axis}_m" for level in (1, 2) for axis in "xy"]

        def drawn(number, small, large, rest="", generation=0):
            return [generation, number, "", body(number) + rest, 1.0, 0.03 * small, 0, *((0.09 * large, 0) if large else ("", ""))]

        def search(trial, *rows):
            write(self.tree / "found" / trial / "individuals.csv", columns, [*rows, [1, 99, rows[0][1], body(99) + rows[0][3][27:], "", "", "", "", ""]])

        search("fractal_again-11", drawn(0, 1, 1), drawn(1, 2, 3), drawn(2, 9, None), drawn(3, 9, 9, generation=1))  # who did not walk, or comes later, does not count
        search("new_mutants-1", drawn(1, 2, 3))  # once
        write(self.tree / "paper/discrepancies/walks/text.csv", columns[3:], [drawn(4, 3, 2)[3:]])
        arrangement = "|" + "1" * 27 + "|" + "0" * 13 + "1" + "0" * 13
        search("control_again-1016", drawn(0, 2.5, 4, arrangement))
        self.done("heredity/heredity.py", self.tree / "found")
        self.assertFalse((self.tree / "paper/heredity/first_robots.csv").exists(), "those of the first seeds of the control are missing")
        search("body_mutants-1001", drawn(1, 4, 1.2, arrangement))
        self.done("heredity/heredity.py", self.tree / "found")
        kinds = table_of(self.tree / "paper/heredity/first_robots.csv")
        # 15 body lengths a minute are 1.25 in a walk.
        self.assertEqual([[row[name] for name in ("kind", "robots", "3_cells_median", "9_cells_median", "fitness_median", "spearman")] for row in kinds],
                         [["fractals", "3", "24", "24", "24", "0.5"], ["control", "2", "39", f"{12 * 2.6:.4g}", f"{12 * 1.85:.4g}", "-1"]])
        # Of all that were drawn, who did not walk at 9 cells, or at all, is slow, and the later one of 9 body lengths is fast.
        self.assertEqual([[row[name] for name in ("drawn", "fast", "p_fast")] for row in kinds], [["5", "0.6", "1"], ["2", "0.5", "1"]])
        compared = {row["speed"]: row["control_is_faster"] for row in table_of(self.tree / "paper/heredity/first_robots_compared.csv")}
        self.assertEqual(compared, {"3 cells": f"{5 / 6:.4g}", "9 cells": f"{4 / 6:.4g}", "fitness": f"{4 / 6:.4g}"}, "1.2 and 2.5 against 1, 2 and 2")

    def test_tells_what_all_mutants_inherit_of_whom_both_scales_do_not_walk(self):
        # Searches at 9 cells alone: mutants of one cell keep their speed, those of two go the other way round; one equals its parent and does not count.
        columns = ["individual", "parent", "phenotype", "level_2_dx_m", "level_2_dy_m"]
        ways = [n + 1.0 for n in range(12)]
        rows = [[n, "", "111" + "0" * 24, 0.09 * way, 0] for n, way in enumerate(ways)]
        rows += [[20 + n, n, "1111" + "0" * 23, 0.09 * way, 0] for n, way in enumerate(ways)]
        rows += [[40 + n, n, "11111" + "0" * 22, 0.09 * (13.0 - way), 0] for n, way in enumerate(ways)]
        self.individuals("nine_cells-1", columns, rows + [[60, 0, "111" + "0" * 24, 0.09, 0]])
        self.done("heredity/heredity.py", self.tree / "found")
        (row,) = table_of(self.tree / "paper/heredity/inherited.csv")
        self.assertEqual([row[name] for name in ("arm", "cells_per_side", "trials", "mutants", "faster")], ["nine_cells", "9", "1", "24", "0.25"])
        self.assertAlmostEqual(float(row["spearman"]), spearman_of(ways * 2, ways + ways[::-1]), delta=1e-4)
        self.assertFalse((self.tree / "paper/heredity/heredity.csv").exists(), "steps are told apart in trials at two scales")

    def test_tells_how_often_mutants_are_robots_that_were_there(self):
        columns = ["generation", "individual", "parent", "phenotype", "fitness_body_lengths"]
        shapes = [f"111{number}" + "0" * 23 for number in (0, 1, 2)] + ["1111" + "1" * 23]
        rows = [[0, 0, "", shapes[0], 1.0], [0, 1, "", shapes[1], 2.0],
                [1, 2, 0, shapes[2], ""], [1, 3, 1, shapes[0], 1.0],  # the best robot is 1: its mutant was there
                [1, 4, "", shapes[3], 3.0],  # no mutant, and the best one from the next generation on
                [2, 5, 1, shapes[2], ""], [2, 6, 4, "111" + "0" * 22 + "11", 0.5], [2, 7, 4, "111" + "0" * 21 + "111", 9.0],
                [2, 8, 7, shapes[0], 1.0],  # 7 is of the same generation: not the best one before it
                [2, 9, "", "111" + "0" * 21 + "111", 9.0],  # the same robot as 7
                [3, 10, 9, shapes[1], 1.0], [3, 11, 7, "1" * 26 + "2", 1.0]]  # both are the best one
        write(self.tree / "found/in_pieces-1/individuals.csv", columns, rows)
        self.done("heredity/heredity.py", self.tree / "found")
        (row,) = table_of(self.tree / "paper/heredity/repeats.csv")
        self.assertEqual([row[name] for name in ("arm", "trials", "mutants")], ["in_pieces", "1", "8"])
        self.assertEqual([float(row[name]) for name in ("repeats", "repeats_of_best")], [0.5, 0.4])

    def test_selection_of_made_up_robots_is_that_of_searches(self):
        script = module_of("paper/heredity/made_up.py")
        array = script.np.array
        # Those of tests/unit/evolution/search/age_fitness_pareto_test.cpp
        self.assertEqual(list(script.levels_of(array([3.0, 2.0, 2.0, 1.0]), array([2, 1, 2, 3]), array([1, 2, 3, 4]))), [0, 0, 2, 3])
        self.assertEqual(list(script.levels_of(array([2.0, 2.0]), array([3, 3]), array([1, 2]))), [1, 0], "of equals the newer dominates")
        pool = (array([1.0, 2.0, 0.5, 0.25]), array([0, 1, 2, 3]), array([1, 2, 3, 4]))
        self.assertEqual(list(script.survivors_of(*pool, 3, None)), [1, 0, 2], "whole levels need no draw")

        class Drawn:
            """The index floor(6^u) for each u."""

            def __init__(self, *indices):
                self.indices = iter(indices)

            def random(self):
                return math.log(next(self.indices) + 0.5) / math.log(6)

        ages = array([1, 2, 3, 4, 5, 6])  # none of six dominates another; the fittest is the last
        self.assertEqual(list(script.survivors_of(ages.astype(float), ages, ages, 3, Drawn(4, 4, 2))), [5, 1, 3])

    def test_made_up_mutants_inherit_what_they_are_to(self):
        script = module_of("paper/heredity/made_up.py")
        random = script.np.random.default_rng(5)
        parents = script.Robots([0.3, 0.8]).draw(20000, random)
        children = script.Robots([0.3, 0.8]).mutants(parents, random)
        # A correlation of n pairs has a standard error of 1 / sqrt(n), here 0.007.
        correlations = script.np.corrcoef(parents.T, children.T)
        for (row, column), expected in {(0, 1): script.SCALES_CORRELATION, (2, 3): script.SCALES_CORRELATION * (0.3 * 0.8 + math.sqrt((1 - 0.09) * (1 - 0.64))), (0, 2): 0.3, (1, 3): 0.8}.items():
            self.assertAlmostEqual(correlations[row, column], expected, delta=0.03)
        alone = script.Robots([0.3, 0.8], script.SECOND_ALONE).mutants(parents, random)
        self.assertAlmostEqual(float(script.np.mean(alone[:, 0] == parents[:, 0])), script.SECOND_ALONE, delta=0.015)
        self.assertFalse((alone[:, 1] == parents[:, 1]).any())
        self.assertAlmostEqual(script.np.corrcoef(parents[:, 1], alone[:, 1])[0, 1], 0.8, delta=0.03)
        # What mutants inherit of the second number may depend on whether the first one changes, and some are copies.
        mixed = script.Robots([0.3, 0.8], 0.5, heredity_alone=0.2, repeats=0.4)
        children = mixed.mutants(parents, random)
        copies = (children == parents).all(axis=1)
        self.assertAlmostEqual(float(script.np.mean(copies)), 0.4, delta=0.015)
        kept = (children[:, 0] == parents[:, 0]) & ~copies
        self.assertAlmostEqual(script.np.corrcoef(parents[kept, 1], children[kept, 1])[0, 1], 0.2, delta=0.04)
        self.assertAlmostEqual(script.np.corrcoef(parents[~kept & ~copies, 1], children[~kept & ~copies, 1])[0, 1], 0.8, delta=0.03)
        # The correlation of the speeds of random robots, as the docstring says, and the share of the control's mutants
        walks = table_of(SOURCES / "paper/discrepancies/walks/text.csv")
        speeds = [[math.hypot(float(row[f"level_{level}_dx_m"]), float(row[f"level_{level}_dy_m"])) for row in walks] for level in (1, 2)]
        spearman = spearman_of(*speeds)
        self.assertAlmostEqual(2.0 * math.sin(math.pi / 6.0 * spearman), script.SCALES_CORRELATION, delta=0.005)  # Pearson's of normal ones with the same ranks
        robots = {row["kind"]: int(row["robots"]) for row in table_of(SOURCES / "paper/heredity/mutants.csv") if row["arm"] == "control"}
        alone, of_body = robots["mutants of its arrangement alone"], robots["mutants of the body"]
        self.assertAlmostEqual(alone / (alone + of_body), script.SECOND_ALONE, delta=0.005)

    def test_evolution_that_inherits_nothing_is_chance(self):
        script = module_of("paper/heredity/made_up.py")
        self.assertAlmostEqual(float(script.ahead_of_chance(script.np.array([0.0]), 3)[0]), 0.125)
        found = {}
        for heredity in (0.0, 0.8):
            searches = script.Searches(script.Robots([heredity]), 100, 10)
            found[heredity] = script.mean(script.ahead_of_chance(searches.best[:, 10], 161)).value
            self.assertTrue((script.np.diff(searches.best) >= 0.0).all(), "the best robot survives")
        # All 175 robots of a search are drawn at random, as are the 161 of a random one: the best one is among the 175 in 175 of 336 cases. The
        # share of 100 searches has a standard error of 0.29 / sqrt(100).
        self.assertAlmostEqual(found[0.0], 175 / 336, delta=0.1)
        self.assertGreater(found[0.8], 0.8)

    def test_sets_evolution_against_chance_at_each_scale(self):
        self.refused("has no searches yet", "heredity/chance.py")
        columns = ["generation", "best_fitness_body_lengths", "champion_cells", "hausdorff_dimension", "level_2_displacement_body_lengths", "evaluations"]
        for seed in range(5):
            for folder, speed, walks in (("nine_cells", 0.2, 16), ("nine_cells_random", 0.1, 32)):
                write(self.tree / f"paper/heredity/{folder}/{seed + 1}.csv", columns, [[n, speed * n + 0.01 * seed, 9, 2, speed * n, walks] for n in range(41)])
        self.done("heredity/chance.py")
        rows = table_of(self.tree / "paper/heredity/chance.csv")
        self.assertEqual([(row["searches"], row["after"], row["larger"], row["walks"], row["spearman"], row["made_up"]) for row in rows],
                         [("nine_cells", "20 generations", "1", "", "", ""), ("nine_cells", "40 generations", "1", "", "", ""), ("nine_cells", "as many walks", "1", "656", "", "")])
        self.assertEqual([(row["evolved"], row["random"]) for row in rows],
                         [(f"{12 * 4.02:.4g}", f"{12 * 2.02:.4g}"), (f"{12 * 8.02:.4g}", f"{12 * 4.02:.4g}"), (f"{12 * 8.02:.4g}", f"{12 * 1.92:.4g}")],
                         "32 robots walk in a generation of random search: 656 are those of generations 0 to 19, and half of the next")
        self.assertEqual([row["p"] for row in rows], ["", "", f"{2 / math.comb(10, 5):.4g}"], "one test, and no looks on the way")
        write(self.tree / "paper/heredity/inherited.csv", ["arm", "cells_per_side", *(f"{name}{end}" for name in ("spearman", "faster") for end in ("", "_low", "_high"))],
              [["nine_cells", 9, 0.5, 0.4, 0.6, 0.3, 0.2, 0.4]])
        # 656 walks are 15 of the first generation, and 40.0625 generations of 16.
        made_up = [[generation, 0.4, 0.8 + generation / 1000, 0.2] for generation in (20, 60)] + [[generation, 0.6, 0.9 + generation / 1000, 0.3] for generation in (20, 60)]
        for made, expected in ((made_up, f"{0.85 + 0.0400625:.4g}"), (made_up[:1] + made_up[2:3], ""), (made_up[:2], "")):
            write(self.tree / "paper/heredity/made_up.csv", ["generations", "spearman", "larger", "faster"], made)
            self.done("heredity/chance.py")
            rows = table_of(self.tree / "paper/heredity/chance.csv")
            self.assertEqual([(row["spearman"], row["made_up"]) for row in rows], [("", ""), ("", ""), ("0.5", expected)], "nothing is said beyond the made-up searches")
            self.assertEqual((rows[2]["faster"], rows[2]["made_up_faster"]), ("0.3", "0.25" if expected else ""))
        xml.dom.minidom.parse(str(self.tree / "paper/heredity/chance.svg"))

    def test_studies_differ_in_scale_and_in_evolution_alone(self):
        def study_of(name):
            return tomllib.loads((SOURCES / f"paper/{name}.toml").read_text()) | {"generations": None}  # as many as were run so far

        both = study_of("fractal/two_scales")
        for plain, name, levels in (("scale_invariance/one_scale", "heredity/three_cells", [1]), ("heredity/nine_cells", "heredity/nine_cells", [2])):
            evolution, drawn, single = study_of(plain), study_of(f"{name}_random"), study_of(f"{name}_single")
            self.assertEqual(evolution, both | {"body": {"levels": levels}})
            self.assertEqual(drawn.pop("population"), {"survivors": 1, "mutants": 0, "newcomers": 16})
            self.assertEqual(drawn, evolution)
            self.assertEqual(single.pop("genome"), {"most_changed_cells": 1})
            self.assertEqual(single, evolution)


if __name__ == "__main__":
    unittest.main()
