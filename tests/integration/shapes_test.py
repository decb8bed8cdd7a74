"""Tests paper/shapes/fit.py on files that are made up, so that what it must find is known.

shapes_test.py SOURCES: the folder of the sources.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv.pop()).resolve()
FIT = SOURCES / "paper" / "shapes" / "fit.py"

PARAMETERS = """
[stiffness]
axial_Pa = [1.0, 2.0]
bending_Pa = [3.0, 4.0]
[extension]
elbow_ratio = 3.25
plate_stretch_ratio = 4.0
plate_draw_in = 0.15
plate_rise = 0.14
plate_draw_in_per_Pa = 4e-4
plate_edge_share = 0.13
[bulge]
neck_ratio = 1.5
plate_arm_ratio = 1.25
wide_volume_ratio = 1.1
[fit]
reduced_chi2 = 2.5
residuals = 100
parameters = 7
wide = ["a", "b"]
at_bound = []
no_influence = ["c"]
[fit.confidence_95]
elbow_ratio = [3.0, 3.5]
plate_arm_ratio = [1.125, 1.5]
bulge_neck_ratio = "not determined"
[[fit.curves]]
name = "one"
[[fit.curves]]
name = "two"
"""


class Fit(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def call(self, *words):
        return subprocess.run([sys.executable, "-B", str(FIT), *map(str, words)], capture_output=True, text=True, check=False)

    def table(self):
        with open(self.folder / "table.csv", newline="", encoding="utf-8") as text:
            return {row[0]: row[1:] for row in csv.reader(text)}

    def test_values_have_their_intervals(self):
        (self.folder / "parameters.toml").write_text(PARAMETERS)
        made = self.call("values", self.folder / "parameters.toml", self.folder / "table.csv")
        self.assertEqual(made.returncode, 0, made.stderr)
        rows = self.table()
        self.assertEqual(rows["elbow_ratio"], ["3.25", "3", "3.5"])
        self.assertEqual(rows["neck_ratio"], ["1.5", "", ""], "one that is not determined has no interval")
        self.assertEqual(rows["plate_arm_ratio"], ["1.25", "1.125", "1.5"])
        self.assertEqual(rows["plate_draw_in"], ["0.15", "", ""])
        self.assertEqual(rows["axial_Pa"], ["2", "", ""], "that of four walls")
        self.assertEqual([rows[name][0] for name in ("curves", "wide", "at_bound", "no_influence")], ["2", "2", "0", "1"])

    def test_other_files_are_refused(self):
        (self.folder / "other.toml").write_text("[fit]\n")
        refused = self.call("values", self.folder / "other.toml", self.folder / "table.csv")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("is missing: is it a file of menger calibrate?", refused.stderr)
        self.assertFalse((self.folder / "table.csv").exists())

    def test_medians_are_of_groups_inside_the_range(self):
        rows = [("u", "displacement", "extent_x_m", 0.1, "inside"), ("u", "displacement", "foot_1_out_m", -0.3, "inside"),
                ("u", "displacement", "extent_x_m", 9.0, "outside"), ("table", "displacement", "extent_x_m", 0.5, "inside"),
                ("table", "displacement", "foot_1_out_m", 0.7, "inside"), ("u", "volume", "volume_change", 0.2, "inside"),
                ("table", "displacement", "extent_y_m", "", "inside")]
        with open(self.folder / "errors.csv", "w", newline="", encoding="utf-8") as text:
            csv.writer(text).writerows([("body", "kind", "observable", "error", "validity"), *rows])
        (self.folder / "expected_errors.csv").write_text("kind,signs,wrong_signs\nlimbs,7,0\nflat_plate,5,2\n")
        made = self.call("medians", self.folder, self.folder / "table.csv")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(self.table(), {
            "group": ["displacement", "volume", "wrong_signs", "signs"], "all": ["0.4", "0.2", "2", "12"],
            "without_plates_on_legs": ["0.2", "0.2", "", ""], "without_feet": ["0.1", "0.2", "", ""], "feet": ["0.5", "", "", ""],
            "plates_on_legs": ["0.6", "", "", ""], "outside_too": ["0.5", "0.2", "", ""]})


if __name__ == "__main__":
    unittest.main()
