"""Tests paper/tables.py, paper/champion.py and paper/run_experiment.sh in trees of their own, with a program that stands for menger.

paper_test.py SOURCES: the folder of the sources.
"""

import os
import pathlib
import re
import runpy
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SOURCES = pathlib.Path(sys.argv.pop()).resolve()

EXPERIMENT = """# Does it walk?
part walk "a minute" "a short walk"
part_on_request long "a night" "a long one"
walk() {
  menger locomote "$study/walk.toml" --output "$results/walk"
  table "$results/walk/sweep.csv" "$study/walk.csv" friction way_m
}
long() { menger wait; }
"""

# A search, its champion, and a trial of a given length after which another search has its own again.
SEARCHES = """# Does it evolve?
part small "a minute" "a search"
part seeded "a minute" "another"
part_on_request forty "an hour" "a trial"
trials few 2 "a day" "some of them" 31 search small
trials_on_request several 3 "a day" "more of them" 41 search small
small() { search_with_champion small; }
seeded() { search small 7; }
forty() { search_at_three_scales small 3 40; search small 8; }
"""

# Writes a table from the number in its study, and ends as that says: an outcome, bad input, or nothing until Ctrl-C.
MENGER = """#!/usr/bin/env bash
case $1 in
  locomote)
    mkdir -p "$4"
    printf 'friction,way_m,seconds\\n0.2,%s,7\\n' "$(sed -n 1p "$2")" >"$4/sweep.csv"
    exit "$(sed -n 2p "$2")" ;;
  evolve) echo "$*" >>calls ;;
  export)
    mkdir -p "$4"
    printf 'generation,best_fitness_body_lengths,level_1_displacement_body_lengths,level_2_displacement_body_lengths\n0,,,\n1,0.5,0.75,0.5\n' >"$4/generations.csv"
    printf 'individual,phenotype\n3,111000000000000000000000000\n9,102000001102000201112111211\n' >"$4/lineage.csv" ;;
  wait) trap 'exit 130' INT; touch waiting; while :; do sleep 0.05; done ;;
esac
"""

TEXT = """Before.

<!-- table: paper/one/walk.csv
friction | way
{friction} | {way_m*1000 2sig} mm
-->
<!-- end -->

It goes <!-- value: paper/one/walk.csv {0.2/way_m .3f} -->?<!-- end --> m.
"""

FILLED = """-->
| friction | way |
| --- | --- |
| 0.2 | 2.3 mm |
<!-- end -->

It goes <!-- value: paper/one/walk.csv {0.2/way_m .3f} -->0.002<!-- end --> m.
"""


class PaperTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.tree = pathlib.Path(self.folder.name)
        for name in ("tables.py", "small_tables.py", "champion.py", "run_experiment.sh"):
            self.put(f"paper/{name}", (SOURCES / "paper" / name).read_text(), executable=True)
        self.put("paper/one/experiment.sh", EXPERIMENT)
        self.put("paper/one/walk.toml", "0.00232\n0\n")
        self.put("paper/one/walk.csv", "friction,way_m\n0.2,0.00232\n")
        self.put("paper/results.md", TEXT)
        self.put("build/release/bin/menger", MENGER, executable=True)

    def put(self, name, text, executable=False):
        file = self.tree / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        if executable:
            file.chmod(0o755)

    def put_searches(self):
        self.put("paper/evolved/experiment.sh", SEARCHES)
        self.put("paper/evolved/small.toml", "seed = 2\n[time]\nduration_s = 2.5\n")
        self.put("paper/fractal/trial.sh", '#!/usr/bin/env bash\necho "trial $*" >>calls\nmkdir -p "$2"\nprintf "generation\\n0\\n" >"$2/generations.csv"\n', executable=True)

    def text(self, name="paper/results.md"):
        return (self.tree / name).read_text()

    def call(self, *words, **variables):
        environment = {name: value for name, value in (os.environ | variables).items() if value is not None and name not in {"GENERATIONS"} - variables.keys()}
        return subprocess.run([str(self.tree / words[0]), *words[1:]], cwd=self.tree, env=environment, capture_output=True, text=True, check=False)

    def tables(self, *words):
        return self.call("paper/tables.py", *words)

    def experiment(self, *words):
        return self.call("paper/run_experiment.sh", *words)


class Tables(PaperTest):
    def test_fill_what_check_misses(self):
        before = self.tables("check")
        self.assertEqual(before.returncode, 1)
        self.assertIn("results.md:7: ", before.stderr)
        self.assertEqual(self.text(), TEXT, "check changes nothing")
        self.assertEqual(self.tables("fill").returncode, 0)
        self.assertTrue(self.text().endswith(FILLED), self.text())
        self.assertTrue(self.text().startswith(TEXT[: TEXT.index("-->")]))
        self.assertEqual(self.tables("check").returncode, 0)

    def test_check_sees_a_number_that_its_table_does_not_give(self):
        self.tables("fill")
        filled = self.text()
        for right, wrong in (("2.3 mm", "2.4 mm"), ("-->0.002<", "-->0.003<")):
            self.put("paper/results.md", filled.replace(right, wrong))
            self.assertEqual(self.tables("check").returncode, 1, wrong)
        self.put("paper/results.md", filled)
        self.put("paper/one/walk.csv", "friction,way_m\n0.2,0.0035\n")
        self.assertEqual(self.tables("check").returncode, 1)

    def test_what_is_wrong_is_named_and_nothing_is_changed(self):
        for right, wrong, message in (
            ("one/walk.csv\n", "one/walks.csv\n", "walks.csv: cannot be read"),
            ("{friction}", "{frictions}", "there is no column frictions"),
            ("{0.2/way_m", "{0.3/way_m", "0 rows begin with 0.3"),
            ("way_m*1000 2sig", "way_m*1000 2sigs", "cannot be shown so"),
            ("| way", "| way | more", "has not the 3 columns of its header"),
            ("-->\n<!-- end -->", "-->\n<!-- ends -->", "is not closed"),
        ):
            self.put("paper/results.md", TEXT.replace(right, wrong, 1))
            outcome = self.tables("fill")
            self.assertEqual(outcome.returncode, 2, wrong)
            self.assertIn(message, outcome.stderr)
            self.assertIn("results.md:", outcome.stderr)
            self.assertEqual(self.text(), TEXT.replace(right, wrong, 1))

    def test_numbers_of_two_digits(self):
        for text, shown in (("9.96", "10"), ("0.299", "0.30"), ("-31.4", "-31"), ("20718", "21000"), ("0", "0"), ("0.0994", "0.099")):
            self.put("paper/one/walk.csv", f"friction,way_m\n0.2,{text}\n")
            self.put("paper/results.md", "<!-- value: paper/one/walk.csv {0.2/way_m 2sig} --><!-- end -->")
            self.assertEqual(self.tables("fill").returncode, 0)
            self.assertIn(f"-->{shown}<!--", self.text())

    def test_empty_cells_are_dashes_where_that_is_said(self):
        self.put("paper/one/walk.csv", "friction,way_m\n0.2,\n")
        rows = TEXT[: TEXT.index("It goes")]
        for place in ("{way_m*1000 2sig ?}", "{way_m ?}", "{0.2/way_m ?}"):
            self.put("paper/results.md", rows.replace("{way_m*1000 2sig}", place))
            self.assertEqual(self.tables("fill").returncode, 0, place)
            self.assertIn("| 0.2 | – |", self.text())

    def test_empty_cells_are_refused_elsewhere(self):
        self.put("paper/one/walk.csv", "friction,way_m\n0.2,\n")
        rows, sentence = TEXT[: TEXT.index("It goes")], TEXT[TEXT.index("It goes") :]
        for text, place in ((rows, "{way_m*1000 2sig}"), (rows.replace("{way_m*1000 2sig}", "{way_m}"), "{way_m}"), (sentence, "{0.2/way_m .3f}"),
                            (sentence.replace(" .3f", ""), "{0.2/way_m}")):
            self.put("paper/results.md", text)
            outcome = self.tables("fill")
            self.assertEqual(outcome.returncode, 2, text)
            self.assertIn(f"{place} is empty; where that may be, write {place[:-1]} ?}}", outcome.stderr)
            self.assertEqual(self.text(), text)

    def test_a_place_that_may_be_empty_is_a_number_otherwise(self):
        for cell, shown in (("0.00232", "2.3 mm"), ("many", None), ("nan", None), ("inf", None)):
            self.put("paper/one/walk.csv", f"friction,way_m\n0.2,{cell}\n")
            self.put("paper/results.md", TEXT[: TEXT.index("It goes")].replace("2sig}", "2sig ?}"))
            outcome = self.tables("fill")
            if shown:
                self.assertIn(f"| 0.2 | {shown} |", self.text())
            else:
                self.assertEqual(outcome.returncode, 2, cell)
                self.assertIn(f'is "{cell}", which cannot be shown so', outcome.stderr)

    def test_rows_are_found_by_several_columns(self):
        self.put("paper/one/walk.csv", "body,kind,error\nall,volume,1\nall,force,2\n")
        self.put("paper/results.md", "<!-- value: paper/one/walk.csv {all:force/error} --><!-- end -->")
        self.tables("fill")
        self.assertIn("-->2<!--", self.text())
        self.put("paper/results.md", "<!-- value: paper/one/walk.csv {all/error} --><!-- end -->")
        self.assertIn("2 rows begin with all", self.tables("fill").stderr)

    def test_tables_are_made_of_results(self):
        self.put("result.csv", "case,seconds,cpu_seconds,way_m\na,1,2,3\n")
        self.tables("take", "result.csv", "small.csv")
        self.assertEqual(self.text("small.csv"), "case,way_m\na,3\n")
        self.tables("take", "result.csv", "small.csv", "*")
        self.assertEqual(self.text("small.csv"), self.text("result.csv"))
        self.tables("take", "result.csv", "small.csv", "name=case", "way_m")
        self.assertEqual(self.text("small.csv"), "name,way_m\na,3\n")
        self.put("a.toml", 'status = "completed"\nway_m = 0.5\n')
        self.tables("gather", "small.csv", "status,way_m", "first=a.toml")
        self.assertEqual(self.text("small.csv"), "name,status,way_m\nfirst,completed,0.5\n")
        missing = self.tables("gather", "small.csv", "speed", "first=a.toml")
        self.assertEqual(missing.returncode, 2)
        self.assertIn("a.toml: speed is missing", missing.stderr)
        self.assertEqual(self.text("small.csv"), "name,status,way_m\nfirst,completed,0.5\n", "nothing is written over")


class Experiments(PaperTest):
    def test_are_listed_with_parts_and_costs(self):
        outcome = self.experiment()
        self.assertEqual(outcome.returncode, 0)
        for text in ("one: Does it walk?", "a minute", "a night", "on request: a long one"):
            self.assertIn(text, outcome.stdout)

    def test_refresh_tables_and_texts(self):
        self.put("paper/one/walk.toml", "0.00875\n0\n")
        outcome = self.experiment("one")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertEqual(self.text("paper/one/walk.csv"), "friction,way_m\n0.2,0.00875\n")
        self.assertIn("| 0.2 | 8.8 mm |", self.text())
        self.assertTrue((self.tree / "build/paper/one/walk/sweep.csv").exists(), "large results are outside git")

    def test_take_outcomes_for_results_and_end_with_errors(self):
        self.put("paper/one/walk.toml", "0.1\n3\n")
        self.assertEqual(self.experiment("one").returncode, 0)
        self.assertIn("0.1", self.text("paper/one/walk.csv"))
        self.put("paper/one/walk.toml", "0.2\n2\n")
        self.assertEqual(self.experiment("one").returncode, 2)
        self.assertNotIn("0.2,0.2", self.text("paper/one/walk.csv"), "the table of a failed run is not refreshed")

    def test_unknown_ones_are_refused_before_anything_runs(self):
        for words in (["two"], ["one", "walk", "fly"], ["--check", "one", "fly"]):
            outcome = self.experiment(*words)
            self.assertEqual(outcome.returncode, 2, words)
            self.assertIn("error", outcome.stderr)
            self.assertIn("a short walk", outcome.stderr, "what there is")
        self.assertEqual(self.experiment("--check", "one", "long").returncode, 0)
        self.assertFalse((self.tree / "build/paper").exists())

    def test_end_with_an_interrupt(self):
        words = [str(self.tree / "paper/run_experiment.sh"), "one", "long", "walk"]
        with subprocess.Popen(words, cwd=self.tree, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True) as run:
            for _ in range(600):
                if (self.tree / "waiting").exists():
                    break
                time.sleep(0.05)
            os.killpg(run.pid, signal.SIGINT)
            _, err = run.communicate(timeout=60)
        self.assertEqual(run.returncode, 130)
        self.assertIn("the same command goes on", err)
        self.assertFalse((self.tree / "build/paper/one/walk").exists(), "no further part runs")


    def test_searches_take_generations_from_the_environment(self):
        self.put_searches()
        study, out = "paper/evolved/small.toml", "build/paper/evolved"
        for generations, options in ((None, ""), ("55", " --generations 55")):
            (self.tree / "calls").unlink(missing_ok=True)
            outcome = self.call("paper/run_experiment.sh", "evolved", "small", "forty", "seeded", GENERATIONS=generations)
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            self.assertEqual(self.text("calls").splitlines(), [
                f"evolve {study} --output {out}/small.sqlite{options}",
                f"trial {study} {out}/three_scales_3 build/release/bin  --seed 3 --generations {generations or 40}",
                f"evolve {study} --seed 8 --output {out}/small_8.sqlite{options}",
                f"evolve {study} --seed 7 --output {out}/small_7.sqlite{options}"])
        for table in ("small.csv", "small/7.csv", "small/8.csv", "three_scales/3.csv"):
            self.assertTrue((self.tree / "paper/evolved" / table).exists(), table)
        for wrong in ("many", "-3", "2.5"):
            outcome = self.call("paper/run_experiment.sh", "evolved", "small", GENERATIONS=wrong)
            self.assertEqual(outcome.returncode, 2, wrong)
            self.assertIn(f"GENERATIONS={wrong}: must be a whole number", outcome.stderr)


    def test_trials_are_parts_with_seeds_that_follow_each_other(self):
        self.put_searches()
        self.assertRegex(self.experiment().stdout, r"several_\{1\.\.3\} +a day +on request: more of them")
        outcome = self.experiment("evolved", "several_1", "several_3")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        self.assertEqual([line.split()[3] for line in self.text("calls").splitlines()], ["41", "43"])
        for words, seeds in ((["several"], "41 42 43"), (["several_{1..3}", "few_2"], "41 42 43 32"), ([], "2 7 31 32")):
            (self.tree / "calls").unlink()
            self.assertEqual(self.experiment("evolved", *words).returncode, 0)
            made = [re.search("--seed ([0-9]+)", line) for line in self.text("calls").splitlines()]
            self.assertEqual(" ".join(seed[1] if seed else "2" for seed in made), seeds, words)
        for unknown in ("several_0", "several_4", "several_{1..4}", "sever"):
            outcome = self.experiment("--check", "evolved", unknown)
            self.assertEqual(outcome.returncode, 2, unknown)
            self.assertIn("more of them", outcome.stderr, "what the experiment has")
            self.assertNotIn("a short walk", outcome.stderr, "and no other one")

    def test_that_cannot_run_are_refused(self):
        for wrong, message in (("# Nothing?\n", "names no part"),
                               (EXPERIMENT.replace("long()", "short()"), "has no function long"),
                               (EXPERIMENT + 'trials some 2 "a day" "some" 1 serach small\n', "has no function serach"),
                               ('part menger "a day" "one"\n' + EXPERIMENT, "there is a function menger already; give the part another name")):
            self.put("paper/one/experiment.sh", wrong)
            outcome = self.experiment("--check", "one")
            self.assertEqual(outcome.returncode, 2, message)
            self.assertIn(f"paper/one/experiment.sh: {message}", outcome.stderr)

    def test_champions_are_those_of_one_kind_of_search(self):
        self.put("paper/walked/experiment.sh", (SOURCES / "paper/scale_invariance/experiment.sh").read_text())
        self.put("paper/walked/scale_invariance.py", '#!/bin/sh\necho "$*" >>calls\n', executable=True)
        outcome = self.experiment("walked", "three_scales", "summary")
        self.assertEqual(outcome.returncode, 2, outcome.stderr)
        self.assertIn("there is no build/paper/fractal/three_scales_SEED/trial.sqlite yet; make one with ./run paper fractal three_scales_40", outcome.stderr)
        self.assertFalse((self.tree / "calls").exists(), "no summary of what is not there")
        for archive in ("two_scales_1.sqlite", "two_scales_10.sqlite", "two_scales_balanced_2.sqlite", "two_scales_in_pieces_3.sqlite", "three_scales_4/trial.sqlite"):
            self.put(f"build/paper/fractal/{archive}", "")
        for part, seeds in (("two_scales", (1, 10)), ("two_scales_balanced", (2,)), ("three_scales", (4,))):
            outcome = self.experiment("walked", part)
            self.assertEqual(outcome.returncode, 0, outcome.stderr)
            self.assertEqual(self.text("calls").splitlines(), [f"champion build/paper/walked/{part}_{seed} {part} {seed}" for seed in seeds])
            (self.tree / "calls").unlink()

    def test_walks_that_are_there_are_not_made_anew(self):
        self.put("paper/walked/experiment.sh", (SOURCES / "paper/discrepancies/experiment.sh").read_text())
        self.put("paper/walked/variants.toml", (SOURCES / "paper/discrepancies/variants.toml").read_text())
        self.put("paper/walked/discrepancies.py", '#!/bin/sh\necho "$*" >>calls\n', executable=True)
        self.put("paper/walked/walks/text.csv", "individual\n1\n")
        outcome = self.experiment("walked", "text", "half_step", "summary")
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        out = "build/paper/walked"
        walked = [f"study half_step {out}/half_step.toml", f"evolve {out}/half_step.toml --output {out}/half_step.sqlite", f"take {out}/half_step/individuals.csv half_step"]
        self.assertEqual(self.text("calls").splitlines(), [*walked, "summary"])
        self.assertIn("paper/walked/walks/text.csv is there; remove it to make it anew", outcome.stdout)
        (self.tree / "paper/walked/walks/text.csv").unlink()
        (self.tree / "calls").unlink()
        self.assertEqual(self.experiment("walked", "text").returncode, 0)
        self.assertEqual(self.text("calls").splitlines(), [line.replace("half_step", "text") for line in walked])


class Champion(PaperTest):
    def shape(self, *layers):
        """Layers from the ground up, each of three rows of constant y."""
        outcome = self.call("paper/champion.py", "shape", "".join(layers))
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return [line.partition(": ")[2] for line in outcome.stdout.splitlines()]

    def test_tells_an_uneven_quadruped(self):
        plate, corners, none = "111111111", "101000101", "000000000"
        # One of sixteen cells has no partner: of the four corners of the lowest layer one is empty, and its mirror image is not.
        self.assertEqual(self.shape("102000001", "102000201", "112111211"), ["4", "3", "0.0625", "yes"], "the paper's, with one shorter leg")
        self.assertEqual(self.shape(corners, corners, plate), ["4", "4", "0", "no"], "a table is even")
        self.assertEqual(self.shape(corners, plate, "100000000"), ["4", "4", "0.07143", "yes"], "a table with something in a corner")
        self.assertEqual(self.shape("101000001", plate, none), ["3", "3", "0.08333", "no"], "three legs")
        self.assertEqual(self.shape("100000000", corners, plate), ["4", "1", "0.07143", "no"], "four legs on one foot")
        self.assertEqual(self.shape(none, plate, none), ["0", "0", "0", "no"], "a plane has no legs, wherever it lies")
        self.assertEqual(self.shape(plate, plate, plate), ["1", "1", "0", "no"], "a cube stands on one foot")
        self.assertEqual(self.shape("111000101", plate, none)[:2], ["3", "3"], "cells that faces join are one foot")

    def test_refuses_what_is_no_body(self):
        for digits, message in (("111", "must be 27 digits"), ("3" * 27, "must be 27 digits"), ("0" * 27, "has no cell")):
            outcome = self.call("paper/champion.py", "shape", digits)
            self.assertEqual(outcome.returncode, 2)
            self.assertIn(message, outcome.stderr)

    def test_of_a_small_search_stays_out_of_git(self):
        self.put_searches()
        for name in ("single_actuator", "phase_wave"):
            self.put(f"paper/{name}/experiment.sh", (SOURCES / f"paper/{name}/experiment.sh").read_text())
            for study in ("small", "two_scales"):
                self.put(f"paper/{name}/{study}.toml", "seed = 2\n")
            self.assertEqual(self.experiment(name, "small").returncode, 0)
            self.assertFalse((self.tree / f"paper/{name}/champions.csv").exists())
            self.assertFalse(list((self.tree / f"paper/{name}").glob("*.svg")))
            self.assertIn("small,2,1,9,16,", self.text(f"build/paper/{name}/champions.csv"))
            self.assertEqual(self.experiment(name, "two_scales").returncode, 0)
            self.assertIn("two_scales,2,1,9,16,", self.text(f"paper/{name}/champions.csv"))
            self.assertTrue((self.tree / f"paper/{name}/champions_two_scales_2.svg").exists())

    def test_is_refused_where_no_robot_has_a_fitness(self):
        self.put("found/generations.csv", "generation,best_fitness_body_lengths\n0,\n1,\n")
        self.put("found/lineage.csv", "individual,phenotype\n3,111000000000000000000000000\n")
        self.put("small.toml", "seed = 2\n")
        outcome = self.call("paper/champion.py", "take", "found", "small.toml", "2", "champions.csv")
        self.assertEqual(outcome.returncode, 2, outcome.stderr)
        self.assertIn("generations.csv: no robot of the search has a fitness", outcome.stderr)
        self.assertFalse((self.tree / "champions.csv").exists())

    def test_is_kept_with_its_picture(self):
        self.put_searches()
        for _ in range(2):  # the second takes the place of the first
            self.assertEqual(self.experiment("evolved", "small").returncode, 0)
        # Half a body length in 2.5 s is 12 in a minute.
        header, row, *more = self.text("paper/evolved/champions.csv").splitlines()
        self.assertEqual(more, [])
        self.assertEqual(header.split(",")[:6], ["study", "seed", "generations", "robot", "cells", "digits"])
        self.assertEqual(row, "small,2,1,9,16,102000001102000201112111211,12,18,12,,4,3,0.0625,yes,champions_small_2.svg")
        drawn = self.text("paper/evolved/champions_small_2.svg")
        self.assertEqual(drawn.count("#9ad4f5"), 7, "the tops of material 1 that can be seen")
        # From below: three cells of material 1 on the ground, and those of the layers above with nothing beneath.
        cells = "102000001102000201112111211"
        self.assertEqual(drawn.count("#1f4b66"), sum(cells[n] == "1" and (n < 9 or cells[n - 9] == "0") for n in range(27)))
        self.assertIn(">from below</text>", drawn)
        self.assertLess(len(drawn), 10000)


class Tree(unittest.TestCase):
    """The experiments of the tree itself."""

    def test_every_study_that_they_name_exists(self):
        for file in sorted(SOURCES.glob("paper/*/experiment.sh")):
            checked = subprocess.run(["bash", "-n", str(file)], check=False)
            self.assertEqual(checked.returncode, 0, file)
            for word in file.read_text().replace('"', " ").split():
                if word.endswith(".toml") and "$results" not in word and "$out" not in word and "$1" not in word:
                    self.assertTrue((SOURCES / word.replace("$study", str(file.parent))).exists(), f"{file}: {word}")

    def test_every_part_has_its_function(self):
        listed = subprocess.run([str(SOURCES / "paper/run_experiment.sh")], capture_output=True, text=True, check=True).stdout
        for file in sorted(SOURCES.glob("paper/*/experiment.sh")):
            self.assertIn(f"{file.parent.name}: {file.read_text().splitlines()[0][2:]}", listed)
            checked = subprocess.run([str(SOURCES / "paper/run_experiment.sh"), "--check", file.parent.name], capture_output=True, text=True, check=False)
            self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_seeds_of_trials_are_those_that_the_texts_promise(self):
        seeds = {}
        for name in ("fractal", "non_fractal", "heredity", "scale_invariance"):
            for line in (SOURCES / f"paper/{name}/experiment.sh").read_text().splitlines():
                if line.startswith("trials"):
                    _, trials, number, _, _, first, *_ = shlex.split(line)
                    seeds[name, trials] = set(range(int(first), int(first) + int(number)))
        self.assertEqual(seeds["fractal", "two_scales"], set(range(1, 11)))
        self.assertEqual(seeds["non_fractal", "two_scales"], set(range(1001, 1016)))
        # Trials that begin with the same robots
        for variant in (("fractal", "in_pieces"), ("fractal", "balanced"), ("fractal", "single_cells"), ("fractal", "new_mutants"), ("heredity", "nine_cells"),
                        ("heredity", "nine_cells_single"), ("heredity", "three_cells_single"), ("scale_invariance", "one_scale"), ("scale_invariance", "one_scale_balanced")):
            self.assertEqual(seeds[variant], seeds["fractal", "two_scales"], variant)
        self.assertEqual(seeds["non_fractal", "body_mutants"], seeds["non_fractal", "two_scales"])
        # Trials of whom no two may begin with the same robots
        apart = [("fractal", "two_scales"), ("fractal", "again"), ("fractal", "random_search"), ("non_fractal", "two_scales"), ("non_fractal", "again"), ("non_fractal", "random_search")]
        self.assertEqual(len(set().union(*(seeds[one] for one in apart))), sum(len(seeds[one]) for one in apart))

    def test_the_table_of_ranks_is_what_its_script_prints(self):
        folder = SOURCES / "paper/fractal"
        printed = subprocess.run([sys.executable, "-B", str(folder / "scale.py"), str(folder / "scale.csv"), "--stretch", "20"],
                                 capture_output=True, text=True, check=True).stdout
        self.assertIn("| 4,096 |", printed)
        self.assertIn(printed, (folder / "trial.md").read_text())

    def test_the_table_of_selections_is_what_its_script_prints(self):
        folder = SOURCES / "paper/fractal"
        printed = subprocess.run([sys.executable, "-B", str(folder / "selection.py"), "table", str(folder / "selection.csv")],
                                 capture_output=True, text=True, check=True).stdout
        self.assertIn("| two levels |", printed)
        self.assertIn(printed, (folder / "trial.md").read_text())

    def test_robots_under_way_count_in_the_table_of_selections(self):
        selection = runpy.run_path(str(SOURCES / "paper/fractal/selection.py"))
        with tempfile.TemporaryDirectory() as name:
            for arm in ("generations", "steady_8"):
                folder = pathlib.Path(name) / f"one_level.{arm}.1"
                folder.mkdir()
                (folder / "costs.csv").write_text("generation,voxel_steps\n0,10\n1,20\n2,40\n3,80\n")
                (folder / "generations.csv").write_text("generation,best_fitness_body_lengths\n0,\n1,3\n2,2\n3,4\n")
            selection["take"](name, pathlib.Path(name) / "selection.csv")
            runs = selection["read"](pathlib.Path(name) / "selection.csv")["one_level"]
        self.assertEqual(runs["generations"][1], [(10, 0.0), (30, 3.0), (70, 3.0)])
        self.assertEqual(runs["steady_8"][1], [(20, 0.0), (50, 3.0), (110, 3.0)])
        self.assertEqual(selection["fitness_at"](runs["steady_8"][1], 49), 0.0)
        low, high = selection["interval"]([1.0, 2.0, 3.0], [11.0, 12.0, 13.0])
        self.assertTrue(8.0 <= low < 10.0 < high <= 12.0)

    def test_levels_of_a_design_follow_one_another_in_the_steady_state(self):
        scale = runpy.run_path(str(SOURCES / "paper/fractal/scale.py"))
        self.assertEqual(scale["steadily"]([[1.0, 3.0]], 1, 2), (4.0, 4.0))
        self.assertEqual(scale["steadily"]([[1.0, 3.0], [2.0]], 3, 2), (6.0, 10.0))

    def test_run_lists_them_and_refuses_others(self):
        listed = subprocess.run([str(SOURCES / "run"), "paper"], capture_output=True, text=True, check=False)
        self.assertEqual(listed.returncode, 0)
        self.assertIn("walkers", listed.stdout)
        refused = subprocess.run([str(SOURCES / "run"), "paper", "no_such"], capture_output=True, text=True, check=False)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("there is no experiment paper/no_such", refused.stderr)


if __name__ == "__main__":
    shutil.which("bash") or sys.exit("bash is missing")
    unittest.main()
