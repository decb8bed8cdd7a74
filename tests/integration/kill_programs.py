#!/usr/bin/env python3
"""Kills programs of menger at random moments, starts them again until they are done, and compares what they leave with the results
of an undisturbed run.

Every command runs a study of a few seconds in a folder of its own. SIGKILL comes after a random time, at most as long as the
undisturbed run took; then the same command is given again. When it ends by itself, every file is compared with that of the
undisturbed run: bytes, except wall times (columns, keys and attributes that are called seconds, times and memory in manifests) and
what they decide.
Archives are compared row by row. Files that only the killed runs left, such as temporary ones, count as a difference, too.
"""

import argparse
import csv
import io
import json
import os
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

CUBE_DESIGN = 'name = "cube"\ncell_edge_m = 0.02\nlayers = [["1"]]\n'

CUBE = (
    '[design]\nfile = "cube_design.toml"\nwall_thickness_m = 0.004\n'
    '[material]\nbulk_modulus_Pa = 2.5e6\ndensity_kg_per_m3 = 1070\n'
    'law = {name = "neo_hookean", shear_modulus_Pa = 5e4}\n'
    '[elements]\ndegree = 2\n[supports]\nkind = "ground_held"\n'
)

VOXEL_SEARCH = (
    'preset = "paper"\ngenerations = 6\n[population]\nsurvivors = 6\nmutants = 6\n'
    '[body]\nlevels = [1, 2]\n[time]\nduration_s = 0.3\n'
)

WALKING_SEARCH = (
    'preset = "paper"\ngenerations = 2\n[population]\nsurvivors = 3\nmutants = 3\n'
    '[evaluation]\nmodel = "finite_elements"\nstand = true\nconfirm = 0\n'
    '[body]\nlevels = [1]\ncastable = true\nwall_thickness_m = 0.002\n[time]\nduration_s = {duration_s}\n'
    '[drive]\nmode = "in_phase"\npressure_Pa = [0, 6000]\nfrequency_Hz = 40\n[material]\nsilicone = "dragon_skin_10"\n'
)

LOAD_CASES = (
    'silicone = "dragon_skin_10"\n[body]\ncell_edge_m = 0.01\nwall_thickness_m = 0.002\n'
    '[elements]\ndegree = 1\nlargest_element_m = 0.006\ngrowth = 4\n'
)


def load_case(name, kind, cells, lines):
    digits = '1' * (cells[0] * cells[1] * cells[2])
    return f'[[case]]\nname = "{name}"\nkind = "{kind}"\ncells = {cells}\ndigits = "{digits}"\n{lines}\n'


LOAD_CASE_SET = (
    LOAD_CASES
    + load_case('cell_inflation', 'inflation', [1, 1, 1], 'pressures_Pa = [-3000, 3000, 6000]')
    + load_case('bar_inflation', 'inflation', [3, 1, 1], 'pressures_Pa = [-3000, 3000, 6000]')
    + load_case('bar_stretch', 'stretch', [3, 1, 1], 'pressures_Pa = [0, 3000]\ndisplacement_m = [0.001, 0.002]')
    + load_case('bar_bending', 'bending', [3, 1, 1], 'pressures_Pa = [0]\nangle_rad = [0.1, 0.2]')
)

HELD_OUT_SET = (
    LOAD_CASES
    + load_case('block_inflation', 'inflation', [2, 2, 2], 'pressures_Pa = [-2000, 2000, 4000]')
    + load_case('block_stretch', 'stretch', [2, 2, 2], 'pressures_Pa = [0, 2000]\ndisplacement_m = [0.0005, 0.001]')
)


class Case:
    """A command with its inputs, and the outputs that it leaves."""

    def __init__(self, name, arguments, files=None, needs=(), resumed=None):
        self.name = name
        self.arguments = arguments  # the first is the command
        self.files = files or {}  # content by name
        self.needs = needs  # what other cases make, copied from their undisturbed run
        self.resumed = resumed  # what a run prints that goes on with earlier work; None: it begins anew, or prints nothing of it


def cases(source):
    parameters = source / 'voxel/parameters/dragon_skin_10_1cm.toml'
    quiet = '--no-pictures'
    return [
        Case('evolve', ['evolve', 'study.toml', '-o', 'run.sqlite', '-t', '2'], {'study.toml': VOXEL_SEARCH}, resumed=r'^resuming '),
        Case('evolve_elements', ['evolve', 'study.toml', '-o', 'run.sqlite', '-t', '2'],
             {'study.toml': WALKING_SEARCH.format(duration_s=0.05)}, resumed=r'^resuming '),
        Case('export', ['export', 'run.sqlite', '-o', 'out', quiet, '--levels', '1', '2'], needs=[('evolve', 'run.sqlite')]),
        Case('inflate', ['inflate', 'study.toml', '-o', 'out', quiet],
             {'cube_design.toml': CUBE_DESIGN, 'study.toml': CUBE + '[path]\npressure_Pa = [0, 2000, 4000, 6000]\n'},
             resumed=r'states resumed from an earlier run'),
        Case('modes', ['modes', 'study.toml', '-o', 'out', quiet, '--count', '6'],
             {'cube_design.toml': CUBE_DESIGN, 'study.toml': CUBE + '[path]\npressure_Pa = [0, 2000]\n'}),
        Case('load-cases', ['load-cases', 'set.toml', '-o', 'out', quiet, '--fields'], {'set.toml': LOAD_CASE_SET},
             resumed=r'from the cache'),
        Case('calibrate', ['calibrate', 'study.toml', '--curves', 'curves', '-o', 'out', quiet],
             {'study.toml': 'silicone = "dragon_skin_10"\n[holds_for]\nsilicone = "Dragon Skin 10"\ncell_edge_m = 0.01\n'
                            'wall_thickness_m = 0.002\n[fit]\ndetails = ["uniform", "stiffness"]\n'},
             needs=[('load-cases', 'out', 'curves')]),
        Case('validate', ['validate', 'study.toml', '-o', 'out', quiet],
             {'study.toml': f"parameters = '{parameters}'\nload_cases = 'held_out.toml'\n", 'held_out.toml': HELD_OUT_SET}),
        Case('tradeoff', ['tradeoff', 'study.toml', '-o', 'out', quiet],
             {'cube_design.toml': CUBE_DESIGN,
              'study.toml': 'pressure_Pa = 3000\n[design]\nfile = "cube_design.toml"\nwall_thickness_m = 0.004\n'
                            '[finite_elements]\ndegrees = [1, 2]\nelements_through_wall = [1]\n'},
             resumed=r'^[0-2] runs made in this call'),
        Case('locomote', ['locomote', 'study.toml', '-o', 'out', quiet],
             {'cube_design.toml': CUBE_DESIGN,
              'study.toml': '[design]\nfile = "cube_design.toml"\nwall_thickness_m = 0.004\n'
                            '[material]\nsilicone = "dragon_skin_10"\nbulk_modulus_ratio = 20\n'
                            '[ground]\nstatic_friction = 1\nkinetic_friction = 0.5\n'
                            '[drive]\nmode = "in_phase"\npressure_Pa = [0, 4000]\nfrequency_Hz = 20\n[time]\nduration_s = 0.4\n'}),
        Case('reevaluate', ['reevaluate', 'run.sqlite', '--top', '3', '--study', 'study.toml', '-o', 'out', quiet],
             {'study.toml': '[elements]\nfidelity = "standard"\n'}, needs=[('evolve_elements', 'run.sqlite')],
             resumed=r'^[0-2] runs of finite elements made in this call'),
        Case('confirm', ['confirm', 'run.sqlite', 'judge.toml', '--top', '4', '-o', 'confirmed.csv', '-t', '1'],
             {'judge.toml': WALKING_SEARCH.format(duration_s=0.1)}, needs=[('evolve_elements', 'run.sqlite')]),
        Case('simulate', ['simulate', 'scene.toml', '-o', 'out', quiet],
             {'scene.toml': '[design]\nname = "sponge"\ncell_edge_m = 0.01\ncells = [3, 3, 3]\n'
                            'digits = "111101222101000202111101222"\nlevel = 2\n[time]\nduration_s = 1.5\nrecord_interval_s = 0.02\n'
                            '[drive]\nmode = "antiphase"\namplitude = 0.14\nfrequency_Hz = 5\n'}),
        Case('stall-map', ['stall-map', 'study.toml', '-o', 'out', quiet],
             {'curve.csv': 'pressure_Pa,volume_m3\n0,5e-6\n1000,6e-6\n5000,9e-6\n',
              'leg.toml': 'name = "leg"\ncell_edge_m = 0.01\nlayers = [["111"], ["100"]]\n',
              'study.toml': "[plenum]\ncurve = 'curve.csv'\ncount = 9\n[piston]\nbore_m = 0.03\ncylinder_length_m = 0.2\n"
                            "[line]\nlength_m = 1\n[map]\nfrequencies_Hz = [1.2, 3]\n"
                            "resistances_Pa_s_per_m3 = {lowest = 1e6, highest = 1e9, count = 3}\n"
                            "strokes_m = {longest = 0.06, count = 4}\nisobars_Pa = [1000]\n"
                            f"[travel]\ndesign = {{file = 'leg.toml'}}\nparameters = '{parameters}'\nperiods = 2\n"
                            "every_resistance = 2\nevery_stroke = 4\n"}),
    ]


# What is not a result: logs of other programs, and what a run goes on from, whose wall times are part of its bytes.
NO_RESULTS = re.compile(r'(^|/)(stdout\.txt|stderr\.txt|out\.txt|err\.txt|load_cases(_errors)?\.txt|run\.toml)$|\.checkpoint$')
WALL_TIMES = {'seconds', 'cpu_seconds', 'peak_memory_MB', 'peak_memory_bytes', 'elements_seconds', 'surrogate_seconds'}
BY_WALL_TIMES = {'role'}  # of a fidelity in a trade-off, whose cost is time


def table_content(text):
    rows = list(csv.reader(io.StringIO(text)))
    if not rows:
        return text
    kept = [n for n, column in enumerate(rows[0]) if column not in WALL_TIMES | BY_WALL_TIMES]
    return [[row[n] for n in kept if n < len(row)] for row in rows]


def archive_content(path):
    with sqlite3.connect(f'file:{path}?mode=ro', uri=True) as database:
        content = {}
        for (table,) in database.execute("SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name"):
            columns = [row[1] for row in database.execute(f'PRAGMA table_info({table})') if row[1] != 'seconds']
            content[table] = (columns, sorted(database.execute(f'SELECT {", ".join(columns)} FROM {table}').fetchall(), key=repr))
        return content


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(part) for key, part in value.items() if 'time' not in key and key not in WALL_TIMES}
    return [without_times(part) for part in value] if isinstance(value, list) else value


def content(path):
    if path.suffix == '.sqlite':
        return archive_content(path)
    data = path.read_bytes()
    if path.suffix == '.json':
        return without_times(json.loads(data))
    if path.suffix == '.csv':
        return table_content(data.decode())
    if path.suffix in {'.toml', '.txt'}:
        lines = data.decode().splitlines()
        return [line for line in lines if not re.match(r'\s*"?(seconds|cpu_seconds|peak_memory\w*)"? *=', line)]
    return data


def results(folder):
    return {str(file.relative_to(folder)): content(file) for file in sorted(folder.rglob('*'))
            if file.is_file() and not NO_RESULTS.search('/' + str(file.relative_to(folder)))}


def differences(whole, killed):
    return [name + (' is missing' if name not in killed else ' is too much' if name not in whole else ' differs')
            for name in sorted(whole.keys() | killed.keys()) if whole.get(name) != killed.get(name)]


class Harness:
    def __init__(self, programs, scratch, rng):
        self.programs = programs
        self.scratch = scratch
        self.rng = rng
        self.whole = {}  # of each case: folder, exit code, seconds, results

    def folder(self, case):
        """Makes a folder with the inputs. Both runs have the same path while they run, which manifests name."""
        folder = self.scratch / case.name / 'run'
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name, text in case.files.items():
            (folder / name).write_text(text)
        for need in case.needs:
            made = self.whole[need[0]][0] / need[1]
            target = folder / need[-1]
            shutil.copytree(made, target) if made.is_dir() else shutil.copy(made, target)
        return folder

    def start(self, case, folder, log):
        program = self.programs / f'menger-{case.arguments[0]}'
        return subprocess.Popen([program, *case.arguments[1:]], cwd=folder, stdin=subprocess.DEVNULL, stdout=log,
                                stderr=subprocess.STDOUT, start_new_session=True)

    def run_whole(self, case):
        if case.name in self.whole:
            return
        folder = self.folder(case)
        log = self.scratch / case.name / 'whole.log'
        start = time.monotonic()
        with open(log, 'wb') as out:
            code = self.start(case, folder, out).wait()
        seconds = time.monotonic() - start
        if code not in (0, 3):
            sys.exit(f'{case.name}: the undisturbed run ends with {code}: {log.read_text()}')
        kept = self.scratch / case.name / 'whole'
        shutil.rmtree(kept, ignore_errors=True)
        folder.rename(kept)
        self.whole[case.name] = (kept, code, seconds, results(kept))

    def run_killed(self, case, kills):
        """Runs a command that is killed so many times. Returns a row of the table."""
        self.run_whole(case)
        kept, whole_code, seconds, expected = self.whole[case.name]
        log = self.scratch / case.name / 'killed.log'
        row = {'command': case.name, 'seconds': seconds, 'kills': 0, 'runs': 0, 'resumed': 0, 'different': []}
        while row['kills'] < kills:
            folder = self.folder(case)
            killed = 0
            while True:
                with open(log, 'wb') as out:
                    process = self.start(case, folder, out)
                    try:
                        # Of later runs less is left, so that some kills come early on purpose.
                        left = seconds * self.rng.random() ** (1 + 0.5 * killed) if row['kills'] < kills and killed < 6 else None
                        code = process.wait(timeout=left)
                        break
                    except subprocess.TimeoutExpired:
                        os.kill(process.pid, signal.SIGKILL)
                        process.wait()
                        time.sleep(0.02)  # children die with it
                        killed += 1
                        row['kills'] += 1
            row['runs'] += 1
            text = log.read_text(errors='replace')
            if killed and case.resumed and re.search(case.resumed, text, re.MULTILINE):
                row['resumed'] += 1
            found = differences(expected, results(folder))
            if code != whole_code:
                found.append(f'exit code {code} instead of {whole_code}: {text.strip()[-300:]}')
            if found:
                row['different'] += found
                shutil.copytree(folder, self.scratch / case.name / f'different_{row["runs"]}', dirs_exist_ok=True)
                shutil.copy(log, self.scratch / case.name / f'different_{row["runs"]}.log')
        return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('programs', type=Path, help='folder of the programs')
    parser.add_argument('source', type=Path, help='root of the source tree')
    parser.add_argument('scratch', type=Path, help='folder of the runs; emptied')
    parser.add_argument('--kills', type=int, default=30, help='kills, shared evenly among the commands')
    parser.add_argument('--seed', type=int, help='of the moments (default: from the clock)')
    parser.add_argument('--only', default='', help='these commands, with commas')
    arguments = parser.parse_args()
    seed = arguments.seed if arguments.seed is not None else time.time_ns() % 1_000_000
    print(f'seed {seed}', flush=True)
    shutil.rmtree(arguments.scratch, ignore_errors=True)
    arguments.scratch.mkdir(parents=True)
    harness = Harness(arguments.programs.resolve(), arguments.scratch.resolve(), random.Random(seed))
    every = cases(arguments.source.resolve())
    chosen = [case for case in every if not arguments.only or case.name in arguments.only.split(',')]
    if not chosen or arguments.kills < 1:
        parser.error('no command to kill')
    needed = {need[0] for case in chosen for need in case.needs}
    for case in every:
        if case.name in needed:
            harness.run_whole(case)
    share, more = divmod(arguments.kills, len(chosen))
    print(f'{"command":16} {"seconds":>8} {"kills":>6} {"ended":>6} {"resumed":>8}  equal', flush=True)
    total = 0
    is_equal = True
    for n, case in enumerate(chosen):
        kills = share + (1 if n < more else 0)
        if kills == 0:
            continue
        row = harness.run_killed(case, kills)
        total += row['kills']
        is_equal = is_equal and not row['different']
        resumed = row['resumed'] if case.resumed else '-'
        print(f'{case.name:16} {row["seconds"]:8.1f} {row["kills"]:6} {row["runs"]:6} {resumed:>8}  '
              f'{"no" if row["different"] else "yes"}', flush=True)
        for line in sorted(set(row['different'])):
            print('    ' + line, flush=True)
    print(f'{total} kills: {"all results are those of undisturbed runs" if is_equal else "results differ"}')
    return 0 if is_equal else 1


if __name__ == '__main__':
    sys.exit(main())
