"""Checks the JSON Schemas that programs print against all studies of the tree, and against wrong ones made of them.

The schemas must refuse every wrong study; the programs, which read a sample of them, too. What a schema cannot know is in
BEYOND_SCHEMAS: there only the program refuses.

schemas.py PROGRAMS SOURCES SCRATCH: the folders of the programs, of the sources and for files of this test. Ends with 1 and a
list of what is wrong.
"""

import collections
import concurrent.futures
import copy
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

import jsonschema
import wrong_studies

# Which program reads which studies. Every .toml below these folders is named here or in OTHERS.
STUDIES = {
    "evolve": ["paper/demo/study.toml", "paper/demo/silicone.toml", "paper/discrepancies/population.toml", "paper/fractal/*.toml", "paper/heredity/*.toml", "paper/known_walks/search*.toml", "paper/non_fractal/*.toml",
               "paper/phase_wave/*.toml", "paper/proof/both.toml", "paper/proof/dampings.toml", "paper/proof/elements*.toml", "paper/proof/fine.toml",
               "paper/proof/two_layers.toml", "paper/proof/voxels.toml", "paper/proof/voxels_robust.toml", "paper/scale_invariance/*.toml", "paper/silicone/study.toml", "paper/single_actuator/*.toml",
               "paper/trade_off/evolve.toml", "paper/walkers/robust.toml", "paper/walkers/screened.toml",
               "paper/walkers/study.toml"],
    "simulate": ["voxel/scenes/*.toml", "paper/known_walks/voxels.toml"],
    "inflate": ["fem/studies/cube.toml", "fem/studies/quadruped.toml", "fem/studies/reference_cube.toml",
                "paper/pneumatics/module.toml"],
    "modes": ["fem/studies/*_modes.toml"],
    "locomote": ["fem/studies/locomotion.toml", "paper/known_walks/walk.toml", "paper/locomotion/*.toml",
                 "paper/pneumatics/level2.toml", "paper/pneumatics/module_cam.toml"],
    "stall-map": ["paper/pneumatics/stall_map.toml"],
    "load-cases": ["fem/studies/load_cases/*.toml", "paper/demo/check.toml", "paper/demo/load_cases.toml", "paper/silicone/check.toml", "paper/trade_off/walls.toml"],
    "calibrate": ["paper/demo/calibration.toml", "voxel/studies/dragon_skin_*.toml", "voxel/studies/ecoflex_*.toml"],
    "validate": ["voxel/studies/held_out*.toml", "voxel/studies/aggregates.toml", "voxel/studies/stepped*.toml", "paper/silicone/check_validation.toml"],
    "reevaluate": ["paper/demo/reevaluation.toml", "paper/known_walks/screening.toml", "paper/silicone/reevaluation*.toml",
                   "paper/walkers/standard.toml", "paper/walkers/fine.toml"],
    "tradeoff": ["paper/trade_off/study.toml", "paper/trade_off/search.toml"],
}
# Designs, sizes of an experiment, changes of a study, the presets of evolve, and what programs wrote.
OTHERS = ["fem/studies/*_design.toml", "paper/discrepancies/variants.toml", "paper/proof/*size.toml", "paper/proof/voxels.parameters.toml", "paper/trade_off/inchworm.toml", "paper/presets/*.toml"]
FOLDERS = ["fem/studies", "paper", "voxel/scenes", "voxel/studies"]
# Programs whose readers get a sample of the wrong studies. That of menger reevaluate needs the archive of a search.
READS_AT_ONCE = [command for command in STUDIES if command != "reevaluate"]
# Keys that the studies of the tree leave to the command line.
GIVEN = {"validate": {"parameters": "../parameters/dragon_skin_10_1cm.toml"}}

# A schema knows each value alone. These studies are wrong in ways that only their readers find: command, study, key, what is
# wrong, and the change (the path of a table, and what is put there).
BEYOND_SCHEMAS = [
    ("inflate", "fem/studies/cube.toml", "stations", "a station beyond the last knot", ["path"], {"stations": [0.5, 99.0]}),
    ("inflate", "fem/studies/cube.toml", "first_step", "a first step above the largest", ["path"],
     {"largest_step": 0.1, "first_step": 0.2}),
    ("inflate", "fem/studies/cube.toml", "ground_stiffness_Pa_per_m", "a key of another kind of support", ["supports"],
     {"kind": "ground_held", "ground_stiffness_Pa_per_m": 1e6}),
    ("locomote", "fem/studies/locomotion.toml", "record_interval_s", "an interval longer than the run", ["time"],
     {"record_interval_s": 1e3}),
    ("evolve", "paper/demo/study.toml", "levels", "levels that do not ascend", ["body"], {"levels": [2, 1]}),
    ("simulate", "voxel/scenes/silicone.toml", "pressure_Pa", "a lowest pressure above the highest", ["drive"],
     {"pressure_Pa": [2.0, 1.0]}),
    ("simulate", "voxel/scenes/silicone.toml", "amplitude", "a key of bodies without [surrogate]", ["drive"], {"amplitude": 0.1}),
    ("load-cases", "paper/silicone/check.toml", "wall_thickness_m", "a wall thicker than half a cell", ["body"],
     {"wall_thickness_m": 0.3}),
    ("tradeoff", "paper/trade_off/study.toml", "observables", "a value twice", [], {"observables": ["extent_x", "extent_x"]}),
]
# Studies that schemas and readers accept although a key depends on others.
RIGHT = [
    ("inflate", "fem/studies/cube.toml", "stations between later knots", ["path"],
     {"pressure_Pa": [0, 500, 1000], "stations": [0.5, 1.5]}),
]


def told_top_keys(sources):
    """The keys that programs tell the study of another command by (io/process/study_command.cpp): a set for each command."""
    text = (sources / "io/process/study_command.cpp").read_text()
    rows = re.findall(r'\{"([a-z-]+)",\s*((?:"[^"]*"\s*)+)\}', text)
    return {command: set("".join(re.findall(r'"([^"]*)"', keys)).split()) for command, keys in rows}


def files_of(sources, patterns):
    return {file for pattern in patterns for file in sources.glob(pattern)}


def with_whole_paths(value, folder):
    """A study with whole paths in place of those that count from its folder."""
    if isinstance(value, dict):
        return {key: with_whole_paths(entry, folder) for key, entry in value.items()}
    if isinstance(value, list):
        return [with_whole_paths(entry, folder) for entry in value]
    is_path = isinstance(value, str) and pathlib.Path(value).suffix and (folder / value).exists()
    return str((folder / value).resolve()) if is_path else value


def refusal(command, study, programs, folder):
    """Starts a program on a study. Returns its exit code and what it says without the name of the study file.

    The results would be below a file, so that a program which accepts the study ends there.
    """
    folder.mkdir()
    file = folder / "study.toml"
    file.write_text(wrong_studies.toml_file(study))
    arguments = [programs / f"menger-{command}", file, "-o", file / "results"]
    done = subprocess.run(arguments, capture_output=True, text=True, check=False, cwd=folder, timeout=300)
    return done.returncode, done.stderr.replace(str(file), "STUDY")


def faults_of_readers(samples, programs, scratch):
    """Gives the sampled studies to the readers of their programs. @param samples (command, file, wrong study, is refused)"""
    def fault(number):
        command, file, wrong, is_wrong = samples[number]
        study = with_whole_paths(wrong.study, file.parent)
        code, said = refusal(command, study, programs, scratch / str(number))
        place = f"{file}: {wrong.kind} ({wrong.what}): menger-{command}"
        if is_wrong and (code != 2 or "STUDY" not in said or wrong.key not in said):
            return f"{place} ends with {code} and does not name {wrong.key}: {said}"
        if not is_wrong and "STUDY/results" not in said:
            return f"{place} refuses it: {said}"
        return None

    with concurrent.futures.ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        return [found for found in pool.map(fault, range(len(samples))) if found]


def sample_of(wrongs):
    """One wrong study of each kind, where possible of a key that the right study has."""
    by_kind = collections.defaultdict(list)
    for file, wrong in wrongs:
        by_kind[wrong.kind].append((wrong.is_new and wrong.kind not in ("unknown key", "two alternatives"), file, wrong))
    for kind, all_of_kind in sorted(by_kind.items()):
        present = [entry for entry in all_of_kind if not entry[0]] or all_of_kind
        _, file, wrong = present[len(present) // 2]
        yield file, wrong


def changed_study(sources, file, path, change):
    study = tomllib.loads((sources / file).read_text())
    table = study
    for step in path:
        table = table.setdefault(step, {}) if isinstance(table, dict) else table[step]
    table.update(copy.deepcopy(change))
    return study


def main():
    programs, sources, scratch = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    faults = []
    known = files_of(sources, OTHERS)
    told = told_top_keys(sources)
    told["modes"] = told["inflate"]
    validators = {}
    checked = 0
    refused = collections.Counter()
    samples = []
    for command, patterns in STUDIES.items():
        printed = subprocess.run([programs / f"menger-{command}", "--schema"], capture_output=True, text=True, check=False)
        if printed.returncode != 0:
            faults.append(f"menger-{command} --schema: {printed.stderr}")
            continue
        schema = json.loads(printed.stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        if told.get(command) != set(schema["properties"]):
            faults.append(f"io/process/study_command.cpp has other keys of menger {command}: {sorted(told.get(command, set()) ^ set(schema['properties']))}")
        validator = validators[command] = jsonschema.Draft202012Validator(schema)
        wrongs = []
        for file in sorted(files_of(sources, patterns)):
            known.add(file)
            study = tomllib.loads(file.read_text())
            for error in validator.iter_errors(study):
                faults.append(f"{file}: refused by the schema of menger-{command}: {error.json_path}: {error.message[:200]}")
            checked += 1
            for wrong in wrong_studies.wrong_studies(study | GIVEN.get(command, {}), schema):
                if validator.is_valid(wrong.study):
                    faults.append(f"{file}: accepted by the schema of menger-{command} with {wrong.kind}: {wrong.what}")
                refused[wrong.kind] += 1
                wrongs.append((file, wrong))
        if command in READS_AT_ONCE:
            samples += [(command, file, wrong, True) for file, wrong in sample_of(wrongs)]
    for kind in wrong_studies.KINDS:
        if refused[kind] == 0:
            faults.append(f"no study is wrong by: {kind}")
    for command, file, key, what, path, change in BEYOND_SCHEMAS:
        wrong = wrong_studies.Wrong("beyond the schema", what, key, changed_study(sources, file, path, change), False)
        for error in validators[command].iter_errors(wrong.study):
            faults.append(f"{file} with {what}: refused by the schema of menger-{command}: {error.json_path}: {error.message[:200]}")
        samples.append((command, sources / file, wrong, True))
    for command, file, what, path, change in RIGHT:
        right = wrong_studies.Wrong("right", what, "", changed_study(sources, file, path, change), False)
        for error in validators[command].iter_errors(right.study):
            faults.append(f"{file} with {what}: refused by the schema of menger-{command}: {error.json_path}: {error.message[:200]}")
        samples.append((command, sources / file, right, False))
    with tempfile.TemporaryDirectory(dir=scratch) as folder:
        faults += faults_of_readers(samples, programs, pathlib.Path(folder))
    for folder in FOLDERS:
        for file in sorted((sources / folder).rglob("*.toml")):
            if file not in known:
                faults.append(f"{file}: no program is named for it in tests/integration/schemas.py")
    kinds = ", ".join(f"{refused[kind]} {kind}" for kind in wrong_studies.KINDS)
    print(f"{checked} studies accepted, wrong ones refused by schemas: {kinds}; {len(samples)} given to programs")
    print("\n".join(faults))
    return 1 if faults or checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
