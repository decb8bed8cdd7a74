"""Tests the scripts of paper/known_walks on walks that are made up, so that what they must find is known.

known_walks_test.py SOURCES: the folder of the sources.
"""

import csv
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
import xml.dom.minidom

SOURCES = pathlib.Path(sys.argv.pop()).resolve()
EXPERIMENT = SOURCES / "paper" / "known_walks"
sys.dont_write_bytecode = True
sys.path[:0] = [str(EXPERIMENT), str(EXPERIMENT.parent)]

import bodies  # noqa: E402
import known_walks  # noqa: E402
import statistics_of_walks as statistics  # noqa: E402
import walks  # noqa: E402

SMALL = ("half_step", "stiff_ground", "friction", "pressure")


def table_of(file):
    with open(file, newline="", encoding="utf-8") as text:
        return list(csv.DictReader(text))


def straight(step_m, angle=0.0, periods=15, ramp_m=0.0):
    """A walk with equal steps, after a first period that goes elsewhere."""
    return [(n * step_m * math.cos(angle), ramp_m + n * step_m * math.sin(angle)) for n in range(1, periods + 1)]


class Statistics(unittest.TestCase):
    def test_spearman_of_known_ranks(self):
        self.assertEqual(statistics.spearman([(1, 10), (2, 20), (3, 1000)]), 1.0)
        self.assertEqual(statistics.spearman([(1, 3), (2, 2), (3, 1)]), -1.0)
        # 1 - 6 (1 + 1) / (4 (16 - 1)): two neighbours have changed places
        self.assertAlmostEqual(statistics.spearman([(1, 1), (2, 3), (3, 2), (4, 4)]), 0.8)
        self.assertIsNone(statistics.spearman([(1, 1), (1, 2), (1, 3)]))

    def test_equal_values_share_their_rank(self):
        self.assertEqual(statistics.mid_ranks([5, 1, 5, 0]), [3.5, 2, 3.5, 1])

    def test_quantiles(self):
        self.assertEqual(statistics.median([3, 1, 2]), 2)
        self.assertEqual(statistics.median([4, 1, 2, 3]), 2.5)
        self.assertAlmostEqual(statistics.quantile(list(range(11)), 0.9), 9.0)

    def test_angles(self):
        self.assertAlmostEqual(statistics.angle_deg((1, 0), (0, -2)), 90.0)
        self.assertAlmostEqual(statistics.angle_deg((1, 0), (-1, 0)), 180.0)
        self.assertIsNone(statistics.angle_deg((0, 0), (1, 0)))

    def test_bootstrap_covers_the_mean_as_often_as_it_says(self):
        draw = random.Random(5)
        covered = 0
        for _ in range(200):
            low, high = statistics.interval([draw.gauss(2.0, 1.0) for _ in range(40)], lambda x: sum(x) / len(x), 200)
            covered += low <= 2.0 <= high
        self.assertTrue(0.88 * 200 <= covered <= 0.99 * 200, covered)

    def test_wilson(self):
        low, high = statistics.share_interval(0, 10)
        self.assertAlmostEqual(low, 0.0)
        self.assertAlmostEqual(high, 0.2775, 3)


class Analysis(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(setattr, statistics, "RESAMPLES", statistics.RESAMPLES)
        statistics.RESAMPLES = 10  # no claim below is about an interval
        self.addCleanup(setattr, known_walks, "ENOUGH", known_walks.ENOUGH)
        known_walks.ENOUGH = 6

    def write(self, robots):
        """robots: {robot: {change: places}}"""
        rows = []
        for robot, changes in robots.items():
            for change, places in changes.items():
                cells = [f"{1e6 * value:.1f}" for place in places for value in place]
                rows.append([robot, change, "completed" if places else "diverged", 1, 1, *cells, *[""] * (30 - len(cells))])
        columns = ["robot", "change", "status", "elements", "steps", *(f"{axis}_{n}_um" for n in range(1, 16) for axis in "xy")]
        known_walks.write_table(self.folder / "walks.csv", columns, rows)
        known_walks.write_table(self.folder / "robots.csv", ["robot", "layers"], [[robot, "111,100,110"] for robot in robots])
        self.write_screened([])
        self.write_gaits([])

    def write_gaits(self, rows):
        known_walks.write_table(self.folder / "gaits.csv", ["robot", "change", "rise_um", "path_um", "step_um"], rows)

    def write_screened(self, rows):
        """rows: (model of the search, body, place on voxels in mm, place on draft elements in mm)"""
        columns = ["search_on", "layers", "voxels_dx_um", "voxels_dy_um", "draft_dx_um", "draft_dy_um"]
        known_walks.write_table(self.folder / "screened.csv", columns,
                                [[model, body, *(1e3 * mm for mm in (*voxels, *draft))] for model, body, voxels, draft in rows])

    def run_it(self):
        return known_walks.main([str(self.folder)])

    def value(self, table, row, column):
        return float(next(one for one in table_of(self.folder / table) if list(one.values())[0] == row)[column])

    def robots(self, shift_m=0.0001):
        """Eight robots that go 14 to 112 mm, with changes that push the end of each walk aside by shift_m."""
        made = {}
        for n in range(1, 9):
            walk = straight(0.001 * n, ramp_m=0.5)
            aside = [*walk[:-1], (walk[-1][0], walk[-1][1] + shift_m)]
            made[f"r{n}"] = {"standard": walk, "draft": straight(0.001 * (9 - n)), "fine": straight(0.001 * n, math.pi / 2),
                             **{change: aside for change in SMALL}}
        return made

    def test_floor_is_what_small_changes_do(self):
        self.write(self.robots())
        self.assertEqual(self.run_it(), 0)
        self.assertAlmostEqual(self.value("floor.csv", "floor_m", "value"), 0.0001, 7)
        self.assertEqual(self.value("floor.csv", "robots_beyond", "value"), 8)
        self.assertEqual(self.value("floor.csv", "failed_walks", "value"), 0)
        self.assertEqual(self.value("floor.csv", "stepped_robots", "value"), 0)

    def test_robots_below_the_floor_are_left_out(self):
        robots = self.robots()
        robots["still"] = {change: straight(1e-9) for change in ("standard", "draft", "fine", *SMALL)}
        robots["still"]["half_step"] = straight(0.0, periods=14) + [(1.0, 0.0)]
        self.write(robots)
        self.run_it()
        self.assertEqual(self.value("floor.csv", "robots_of_all_walks", "value"), 9)
        self.assertEqual(self.value("floor.csv", "robots_beyond", "value"), 8)
        self.assertEqual(self.value("changes.csv", "half_step", "robots"), 8)

    def test_first_period_does_not_count(self):
        self.write(self.robots())
        self.run_it()
        self.assertAlmostEqual(self.value("agreement.csv", "standard", "spearman"), 1.0)
        self.assertAlmostEqual(known_walks.MEASURES["net displacement"](straight(0.002, ramp_m=7.0)), 0.028)

    def test_ranks_and_directions_of_fidelities(self):
        self.write(self.robots())
        self.run_it()
        self.assertEqual(self.value("agreement.csv", "draft", "spearman"), -1.0)
        self.assertEqual([row["with"] for row in table_of(self.folder / "agreement.csv")][0], "fine")
        self.assertEqual(self.value("agreement.csv", "standard", "within_45_deg"), 0)
        self.assertEqual(self.value("changes.csv", "half_step", "within_45_deg"), 8)
        self.assertAlmostEqual(self.value("changes.csv", "fine", "median_share"), math.sqrt(2.0), 3)

    def test_mirrors_of_bodies(self):
        self.assertEqual(bodies.mirrors_of("111,100,110"), [])
        self.assertEqual(bodies.mirrors_of("220,200,120/110,000,110"), ["y"])
        self.assertEqual(bodies.mirrors_of("111,010,010"), ["x"])
        self.assertEqual(bodies.mirrors_of("111,100,100"), ["diagonal"])
        self.assertEqual(bodies.mirrors_of("111,001,001"), ["other diagonal"])
        self.assertEqual(bodies.mirrors_of("000,110,000/000,100,000"), ["y"])
        self.assertEqual(bodies.mirrors_of("000,110,000"), ["x", "y"], "free rows and columns around a body do not count")

    def test_symmetric_bodies_may_turn_to_either_side(self):
        robots = self.robots()
        for n in range(1, 9):
            robots[f"r{n}"].update(dict.fromkeys(("standard", *SMALL), straight(0.001 * n, -math.pi / 3)))
            robots[f"r{n}"]["fine"] = straight(0.001 * n, math.pi / 3)
        self.write(robots)
        known_walks.write_table(self.folder / "robots.csv", ["robot", "layers"],
                                [[f"r{n}", "110,100,110" if n < 4 else "111,100,110"] for n in range(1, 9)])
        self.run_it()
        found = {row["bodies"]: row for row in table_of(self.folder / "symmetry.csv") if (row["walk"], row["with"]) == ("standard", "fine")}
        self.assertEqual(list(found["with a mirror"].values())[3:], ["0", "3", "3"])
        self.assertEqual(list(found["without a mirror"].values())[3:], ["0", "0", "5"])

    def test_standard_is_the_reference_until_enough_robots_walked_on_fine(self):
        robots = self.robots()
        for n in range(4, 9):
            del robots[f"r{n}"]["fine"]
        robots["r1"]["standard"] = straight(0.5)
        self.write(robots)
        self.run_it()
        self.assertEqual(self.value("floor.csv", "robots_beyond", "value"), 8)
        self.assertEqual({row["with"] for row in table_of(self.folder / "agreement.csv")}, {"standard"})
        self.assertIn("distance on standard elements", (self.folder / "known_walks.svg").read_text())

    def test_failed_walks_are_counted_and_left_out(self):
        robots = self.robots()
        robots["r1"]["draft"] = []
        robots["r2"]["fine"] = []
        self.write(robots)
        self.run_it()
        self.assertEqual(self.value("floor.csv", "failed_walks", "value"), 2)
        self.assertEqual((self.value("progress.csv", "draft", "done"), self.value("progress.csv", "draft", "failed")), (8, 1))
        self.assertEqual(self.value("agreement.csv", "draft", "robots"), 6)
        self.assertEqual(self.value("agreement.csv", "standard", "robots"), 7)

    def test_median_of_periods_is_blind_to_one_slip(self):
        walk = straight(0.001)
        slipped = [*walk[:9], *((x + 0.02, y) for x, y in walk[9:])]
        for name, measure in known_walks.MEASURES.items():
            if name.startswith("median"):
                self.assertAlmostEqual(measure(walk), measure(slipped), msg=name)
        self.assertAlmostEqual(known_walks.MEASURES["net displacement"](slipped), 0.034)
        self.assertAlmostEqual(known_walks.MEASURES["slope of the straight line of least squares"](walk), 0.001)

    def test_shortest_duration_is_where_ranks_settle(self):
        robots = self.robots()
        for n in range(1, 9):  # all go alike for ten periods; then they go on as they should
            start = straight(0.001 * (9 - n), periods=10)
            end = 0.001 * n * 14 + start[0][0]
            robots[f"r{n}"]["standard"] = [*start, *((end, 0.0) for _ in range(5))]
        self.write(robots)
        self.run_it()
        self.assertAlmostEqual(self.value("floor.csv", "shortest_standard_s", "value"), 11 / 3, 3)
        halves = {(row["robots_of"], row["walk"]): row for row in table_of(self.folder / "halves.csv")}
        self.assertEqual(halves["all", "standard"]["spearman"], "-1", "the first half goes the other way round")
        self.assertEqual((halves["beyond the floor", "draft"]["spearman"], halves["beyond the floor", "draft"]["robots"]), ("1", "8"))

    def test_a_duration_does_not_count_if_a_longer_one_ranks_worse(self):
        durations = [["fine", 0, time, 0, 0, 0, 0, loss] for time, loss in (("1", "0.2"), ("2", "0.01"), ("3", "0.05"), ("4", "0.03"), ("5", "0"))]
        self.assertEqual(known_walks.shortest_s(durations, "fine"), "4")
        self.assertEqual(known_walks.shortest_s(durations, "draft"), "")

    def test_two_layers_are_compared_over_their_own_time(self):
        robots = self.robots()
        for n in range(1, 9):
            robots[f"r{n}"]["two_layers"] = straight(0.001 * n, periods=6)
        self.write(robots)
        self.run_it()
        self.assertEqual(self.value("changes.csv", "two_layers", "median_m"), 0.0)

    def test_voxels_are_compared_with_elements(self):
        robots = self.robots()
        for n in range(1, 9):  # in the reverse order, straight on where fine elements turn to the left
            robots[f"r{n}"]["voxels"] = straight(0.001 * (9 - n))
            robots[f"r{n}"]["voxels_without_drag"] = straight(0.0)  # stands still
            robots[f"r{n}"]["two_layers"] = straight(0.001 * (9 - n), periods=6)
        self.write(robots)
        # further and further on voxels, which alternately go the way of elements and the opposite one; every body once more in another material
        form = "{:06b}".format
        rows = [("voxels" if n < 30 else "finite_elements", form(n), (n, 0.0), (n if n % 2 else -n, 0.0)) for n in range(1, 60)]
        self.write_screened([*rows, *((model, body.replace("1", "2"), (0.0, 0.0), way) for model, body, _, way in rows),
                             ("voxels", "1111111", (1.0, 0.0), (0.01, 0.0))])
        self.run_it()
        found = {(row["robots_of"], row["with"]): row for row in table_of(self.folder / "voxels.csv")}
        alike = found["all that were screened", "draft"]
        self.assertEqual((alike["robots"], alike["within_45_deg"], alike["of"], alike["stand_still"]), ("60", "30", "59", "0"))
        self.assertAlmostEqual(float(alike["order_share"]), (58 + 0.5) / 59, 3, "one robot that stays behind the floor goes 1 mm on voxels")
        self.assertEqual(found["those of searches on voxels", "draft"]["robots"], "30")
        self.assertEqual(found["those of searches on finite elements", "draft"]["robots"], "30")
        reverse = found["beyond the floor", "fine"]
        self.assertEqual((reverse["robots"], reverse["spearman"], reverse["within_45_deg"], reverse["of"]), ("8", "-1", "0", "8"))
        self.assertEqual(reverse["by_chance"], "2", "none of the bodies has a mirror")
        self.assertEqual((alike["far"], alike["order_low"] != ""), ("59", True))
        self.assertNotIn(("beyond the floor, stepped bodies", "fine"), found, "none is")
        still = found["beyond the floor, voxels without drag", "fine"]
        self.assertEqual((still["stand_still"], still["of"], still["median_ratio"], still["median_error_share"]), ("8", "0", "0", "1"))
        self.assertEqual(found["beyond the floor, for 2 s", "two_layers"]["median_error_share"], "0")

    def test_chance_and_kinds_of_bodies(self):
        robots = self.robots()
        for n in range(1, 9):
            robots[f"r{n}"]["voxels"] = straight(0.001 * n)
        self.write(robots)
        names = ["111,100,110/000,000,000"] * 2 + ["111,111,111/111,000,000"] * 6  # no mirror; one, and a step
        known_walks.write_table(self.folder / "robots.csv", ["robot", "layers"], [[f"r{n}", body] for n, body in enumerate(names, 1)])
        self.run_it()
        found = {row["robots_of"]: row for row in table_of(self.folder / "voxels.csv")}
        self.assertEqual((found["beyond the floor"]["by_chance"], found["beyond the floor"]["of"]), ("3.5", "8"))
        self.assertEqual((found["beyond the floor, stepped bodies"]["robots"], found["beyond the floor, stepped bodies"]["by_chance"]), ("6", "3"))
        self.assertEqual(self.value("floor.csv", "stepped_robots", "value"), 6)

    def test_stepped_bodies_have_an_inner_edge_of_two_cells(self):
        for body in ("010,010/111,111", "222,222,222/111,000,000", "111,111,111/100,100,000", "11,10/11,10"):
            self.assertTrue(bodies.is_stepped(body), body)
        for body in ("111,111,111/100,000,000", "111,111,110", "000,000/111,010", "111,111/222,111"):
            self.assertFalse(bodies.is_stepped(body), body)

    def test_gaits_are_compared(self):
        self.write(self.robots())
        self.write_gaits([row for n in range(1, 9) for row in ([f"r{n}", "fine", n, 10 * n, n], [f"r{n}", "voxels", 2 * n, 90 - 10 * n, 3 * n],
                                                               [f"r{n}", "draft", n, n, n], [f"r{n}", "draft_0.75_pressure", 0.5 * n, n, n])])
        self.run_it()
        found = {(row["what"], row["walk"]): row for row in table_of(self.folder / "gait_agreement.csv")}
        voxels = [found[name, "voxels"] for name in ("rise", "path", "step")]
        self.assertEqual([(row["with"], row["spearman"], row["robots"]) for row in voxels], [("fine", "1", "8"), ("fine", "-1", "8"), ("fine", "1", "8")])
        self.assertEqual((voxels[0]["median_ratio"], voxels[2]["median_ratio"]), ("2", "3"))
        self.assertEqual((found["rise", "draft_0.75_pressure"]["with"], found["rise", "draft_0.75_pressure"]["median_ratio"]), ("draft", "0.5"))

    def test_large_changes_are_compared_with_draft_elements(self):
        robots = self.robots()
        for n in range(1, 9):  # draft ones go 9 - n mm in each period
            robots[f"r{n}"]["draft_0.75_pressure"] = straight(0.0005 * (9 - n), math.pi)
        self.write(robots)
        self.run_it()
        row, = table_of(self.folder / "sensitivity.csv")
        self.assertEqual((row["change"], row["spearman"], row["within_45_deg"], row["median_ratio"]), ("draft_0.75_pressure", "1", "0", "0.5"))

    def test_what_all_changes_at_once_leave_is_a_ceiling(self):
        robots = self.robots()
        for n in range(1, 9):
            robots[f"r{n}"]["together"] = straight(0.001 * (9 - n))
        self.write(robots)
        self.run_it()
        self.assertEqual(self.value("floor.csv", "ceiling_of_all_at_once", "value"), -1.0)
        self.assertAlmostEqual(self.value("floor.csv", "floor_m", "value"), 0.0001, 7, "they are no small change of their own")

    def test_same_walks_give_the_same_bytes_and_the_picture_is_xml(self):
        self.write(self.robots())
        self.run_it()
        before = {file.name: file.read_bytes() for file in self.folder.iterdir()}
        self.run_it()
        self.assertEqual(before, {file.name: file.read_bytes() for file in self.folder.iterdir()})
        xml.dom.minidom.parseString(before["known_walks.svg"])

    def test_a_missing_table_is_named(self):
        outcome = subprocess.run([str(EXPERIMENT / "known_walks.py"), str(self.folder)], capture_output=True, text=True, check=False)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("walks.csv", outcome.stderr)


class Studies(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def command(self, *words):
        outcome = subprocess.run([str(EXPERIMENT / "walks.py"), *map(str, words)], capture_output=True, text=True, check=False)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return outcome.stdout

    def study(self, change):
        return tomllib.loads(pathlib.Path(self.command("study", "stand18", change, self.folder).strip()).read_text())

    def test_each_changes_one_thing(self):
        manifest = self.folder / "stand18" / "standard" / "manifest.json"
        manifest.parent.mkdir(parents=True)
        manifest.write_text('{"parameters": {"ground": {"stiffness_Pa_per_m": 4e7}}}')
        asked = self.study("standard")
        self.assertEqual(asked["design"]["layers"][0], ["101", "000", "101"])
        for change, places in {
            "fine": {("elements", "fidelity"): "fine"},
            "half_step": {("dynamics", "step_safety"): 0.4},
            "stiff_ground": {("ground", "stiffness_Pa_per_m"): 8e7},
            "friction": {("ground", "static_friction"): 1.01, ("ground", "kinetic_friction"): 0.505},
            "pressure": {("drive", "pressure_Pa"): [0, 6060]},
            "together": {("dynamics", "step_safety"): 0.4, ("ground", "stiffness_Pa_per_m"): 8e7,
                         ("ground", "static_friction"): 1.01, ("ground", "kinetic_friction"): 0.505},
            "draft_0.9_pressure": {("elements", "fidelity"): "draft", ("drive", "pressure_Pa"): [0, 5400]},
            "fine_same_ground": {("elements", "fidelity"): "fine", ("ground", "stiffness_Pa_per_m"): 4e7},
            "draft_0.75_pressure": {("elements", "fidelity"): "draft", ("drive", "pressure_Pa"): [0, 4500]},
            "draft_0.1_ground": {("elements", "fidelity"): "draft", ("ground", "stiffness_Pa_per_m"): 4e6},
            "draft_3_damping": {("elements", "fidelity"): "draft", ("material", "loss_factor"): 0.3, ("material", "loss_frequency_Hz"): 30},
        }.items():
            expected = {name: dict(table) for name, table in asked.items()}
            for (table, key), value in places.items():
                expected.setdefault(table, {})[key] = value
            self.assertEqual(self.study(change), expected, change)
        self.assertEqual(self.study("two_layers")["elements"], {"kind": "three_field"})
        voxels = self.study("voxels")
        self.assertEqual(self.study("voxels_without_drag"), {**voxels, "damping": {"global": 0.0}})
        self.assertTrue(pathlib.Path(voxels["surrogate"]["parameters"]).is_file())
        for table in ("ground", "drive", "time"):
            self.assertEqual(voxels[table], asked[table])
        self.assertEqual(voxels["design"]["layers"], asked["design"]["layers"])

    def test_places_are_those_at_the_ends_of_periods(self):
        robot = self.folder / "results" / "stand18" / "standard"
        robot.mkdir(parents=True)
        (robot / "locomotion.toml").write_text('status = "completed"\nelements = 7\nsteps = 9\n')
        lines = ["time_s,centre_of_mass_x_m,centre_of_mass_y_m"]
        lines += [f"{n / 100:.2f},{1.0 + 0.003 * n / 100},{2.0 - 0.006 * n / 100}" for n in range(501)]
        (robot / "trajectory.csv").write_text("\n".join(lines) + "\n")
        self.command("gather", self.folder / "results", self.folder / "walks.csv")
        row, = table_of(self.folder / "walks.csv")
        self.assertEqual((row["robot"], row["change"], row["elements"]), ("stand18", "standard", "7"))
        self.assertEqual([float(row[key]) for key in ("x_1_um", "y_1_um", "x_15_um", "y_15_um")], [1000.0, -2000.0, 15000.0, -30000.0])

    def test_walks_on_voxels_are_gathered_too_and_others_stay(self):
        results, table = self.folder / "results", self.folder / "walks.csv"
        (results / "stand18" / "voxels").mkdir(parents=True)
        (results / "stand18" / "voxels" / "result.toml").write_text('status = "diverged"\nvoxels = 7\nsteps = 9\n')
        (results / "stand18" / "voxels" / "trajectory.csv").write_text("time_s,centre_of_mass_x_m,centre_of_mass_y_m\n0,0,0\n")
        columns = ["robot", "change", "status", "elements", "steps", *(f"{axis}_{n}_um" for n in range(1, 16) for axis in "xy")]
        known_walks.write_table(table, columns, [["stand18", "voxels", "completed", "", 1, *[1] * 30], ["stand18", "draft", "completed", 5, 1, *[2] * 30],
                                                 ["nobody", "draft", "completed", 5, 1, *[2] * 30]])
        self.command("gather", results, table)
        kept, new = table_of(table)
        self.assertEqual((kept["robot"], kept["change"], kept["x_1_um"]), ("stand18", "draft", "2"))
        self.assertEqual((new["change"], new["status"], new["elements"], new["x_1_um"]), ("voxels", "diverged", "", ""))

    def test_gaits_are_those_of_whole_walks(self):
        for change, end in (("fine", 450), ("draft", 400)):
            folder = self.folder / "results" / "stand18" / change
            folder.mkdir(parents=True)
            lines = ["time_s,centre_of_mass_x_m,centre_of_mass_y_m,centre_of_mass_z_m"]
            lines += [f"{n / 90},{0.001 * n / 30},0,{0.002 * (n % 30) / 30}" for n in range(end + 1)]
            (folder / "trajectory.csv").write_text("\n".join(lines) + "\n")
        self.command("gaits", self.folder / "results", self.folder / "gaits.csv")
        row, = table_of(self.folder / "gaits.csv")
        self.assertEqual((row["robot"], row["change"], row["path_um"], row["step_um"]), ("stand18", "fine", "1000.0", "1000.0"))

    def test_gait_of_a_known_motion(self):
        # the height follows a sine of 2 mm, the place goes 1 mm forth along x and 0.4 mm of it back in each period
        points = []
        for n in range(451):
            phase = n / 30 % 1.0
            x = 0.6 * (n // 30) + (2.0 * phase if phase <= 0.5 else 1.0 - 0.8 * (phase - 0.5))
            points.append([n / 90, 1e-3 * x, 0.0, 1e-3 * math.sin(2.0 * math.pi * phase)])
        for value, expected in zip(walks.gait(points), (2.0, 1.4, 0.6)):
            self.assertAlmostEqual(1e3 * value, expected, delta=0.02)

    def screen(self, search, robots):
        """robots: {(rank, layers): (dx in mm, status)}"""
        folder = self.folder / f"screened_{search}"
        (folder / "trajectories").mkdir(parents=True)
        lines = ["rank,cells,elements_status,surrogate_status,body"]
        for (rank, layers), (way_mm, status) in robots.items():
            lines.append(f"{rank},5,{status},completed,{layers}")
            ways_mm = [0.0, 7.0, 7.0 + way_mm]  # the first period is left out
            points = [f"{time},{1e-3 * way},0,{way},0" for time, way in zip((0, 1 / 3, 5), ways_mm)]
            (folder / "trajectories" / f"rank_{rank:04d}.csv").write_text(
                "time_s,elements_dx_m,elements_dy_m,surrogate_dx_m,surrogate_dy_m\n" + "\n".join(points) + "\n")
        (folder / "reevaluation.csv").write_text("\n".join(lines) + "\n")
        model = "voxels" if search == "1" else "finite_elements"
        (self.folder / f"search_{search}.manifest.json").write_text(f'{{"parameters": {{"evaluation": {{"model": "{model}"}}}}}}')

    def test_robots_that_move_are_chosen_once_from_every_search(self):
        self.screen("1", {(9, "111"): (2.0, "completed"), (3, "110"): (-1.5, "completed"), (1, "101"): (0.9, "completed"),
                          (2, "011"): (4.0, "diverged")})
        self.screen("2", {(1, "112"): (3.0, "completed"), (2, "100"): (5.0, "completed")})
        self.command("choose", self.folder, self.folder / "robots.csv")
        chosen = table_of(self.folder / "robots.csv")
        self.assertEqual([row["robot"] for row in chosen], ["search_1_rank_03", "search_1_rank_09", "search_2_rank_02", *walks.SHIPPED])
        self.assertEqual((chosen[1]["layers"], chosen[1]["surrogate_dx_m"]), ("111", "2.0"))

    def test_all_that_were_screened_are_in_a_table(self):
        self.screen("2", {(9, "111"): (2.0, "completed"), (3, "110"): (0.0, "completed"), (2, "011"): (4.0, "diverged")})
        self.command("screened", self.folder, self.folder / "screened.csv")
        rows = table_of(self.folder / "screened.csv")
        self.assertEqual([(row["search_on"], row["rank"], row["layers"]) for row in rows], [("finite_elements", "3", "110"), ("finite_elements", "9", "111")])
        self.assertEqual((rows[1]["draft_dx_um"], rows[1]["voxels_dx_um"], rows[1]["draft_dy_um"]), ("2000.0", "2000000.0", "0.0"))  # as screen() writes them

    def test_walks_stay_with_their_bodies(self):
        self.screen("1", {(9, "111"): (2.0, "completed"), (8, "110"): (3.0, "completed")})
        tables = self.folder / "tables"
        tables.mkdir()
        self.command("choose", self.folder, tables / "robots.csv")
        known_walks.write_table(tables / "walks.csv", ["robot", "change"], [["search_1_rank_08", "fine"], ["search_1_rank_09", "fine"]])
        shutil.rmtree(self.folder / "screened_1")
        self.screen("1", {(9, "111"): (2.5, "completed"), (8, "101"): (3.0, "completed")})  # another displacement; another body
        self.command("choose", self.folder, tables / "robots.csv")
        self.assertEqual([row["robot"] for row in table_of(tables / "walks.csv")], ["search_1_rank_09"])

    def test_a_change_of_the_ground_needs_the_walk_on_standard_elements(self):
        outcome = subprocess.run([str(EXPERIMENT / "walks.py"), "study", "stand18", "draft_0.1_ground", str(self.folder)], capture_output=True, text=True, check=False)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("walks on standard elements come first", outcome.stderr)

    def test_unknown_ones_are_refused(self):
        for words in (["study", "stand18", "twice", "."], ["study", "nobody", "fine", "."], ["jump"]):
            self.assertEqual(subprocess.run([str(EXPERIMENT / "walks.py"), *words], capture_output=True, check=False).returncode, 2, words)


class Tree(unittest.TestCase):
    """The tables and the picture in the tree are those of its walks."""

    def test_tables_follow_from_the_walks(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        shutil.copy(EXPERIMENT / "walks.csv", folder)
        shutil.copy(EXPERIMENT / "robots.csv", folder)
        shutil.copy(EXPERIMENT / "screened.csv", folder)
        shutil.copy(EXPERIMENT / "gaits.csv", folder)
        self.assertEqual(known_walks.main([str(folder)]), 0)
        for file in sorted(folder.iterdir()):
            self.assertEqual(file.read_bytes(), (EXPERIMENT / file.name).read_bytes(), file.name)


if __name__ == "__main__":
    unittest.main()
