"""Makes the tables of the paper's experiments anew from the tables of single trials and robots in git, and compares them with those in git: a script
that changed, or a table that was edited, shows.

paper_tables_test.py SOURCES: the folder of the sources. Exit code 77: there is no SciPy or matplotlib.
"""

import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv.pop()).resolve()
for package in ("scipy", "matplotlib"):
    if importlib.util.find_spec(package) is None:
        print(f"skipped: there is no python3-{package}")
        sys.exit(77)

# In the order in which they read each other's tables: script, and how many tables it makes at least
SUMMARIES = {"fractal/trials.py": ((), 6), "scale_invariance/scale_invariance.py": (("summary",), 8), "scale_invariance/changed_walks.py": (("summary",), 5),
             "non_fractal/neighbours.py": (("summary",), 1), "non_fractal/climbs.py": (("summary",), 2),
             "discrepancies/discrepancies.py": (("summary",), 5), "heredity/chance.py": ((), 1)}


class Tables(unittest.TestCase):
    def test_they_are_what_their_scripts_make_of_results_in_git(self):
        with tempfile.TemporaryDirectory() as folder:
            tree = pathlib.Path(folder) / "paper"
            shutil.copytree(SOURCES / "paper", tree)
            for script, (words, least) in SUMMARIES.items():
                with self.subTest(script):
                    before = {file: file.stat().st_mtime_ns for file in tree.rglob("*.csv")}
                    done = subprocess.run([sys.executable, "-B", str(tree / script), *words], capture_output=True, text=True, check=False)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    made = [file for file in tree.rglob("*.csv") if before.get(file) != file.stat().st_mtime_ns]
                    self.assertGreaterEqual(len(made), least)
                    for file in made:
                        self.assertEqual(file.read_text(), (SOURCES / "paper" / file.relative_to(tree)).read_text(), f"{file.relative_to(tree)}: run {script} again")


if __name__ == "__main__":
    unittest.main()
