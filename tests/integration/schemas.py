"""Checks the JSON Schemas that programs print against all studies of the tree, and against wrong ones made of them.

schemas.py PROGRAMS SOURCES: the folder of the programs and that of the sources. Ends with 1 and a list of what is wrong.
"""

import copy
import json
import pathlib
import subprocess
import sys
import tomllib

import jsonschema

# Which program reads which studies. Every .toml below these folders is named here or in OTHERS.
STUDIES = {
    "evolve": ["paper/demo/study.toml", "paper/fractal/*.toml", "paper/non_fractal/*.toml", "paper/phase_wave/*.toml",
               "paper/silicone/closing_the_loop.toml", "paper/silicone/study.toml", "paper/single_actuator/*.toml",
               "paper/trade_off/evolve.toml"],
    "simulate": ["voxel/scenes/*.toml"],
    "inflate": ["fem/studies/cube.toml", "fem/studies/quadruped.toml", "fem/studies/reference_cube.toml",
                "paper/pneumatics/module.toml"],
    "modes": ["fem/studies/*_modes.toml"],
    "locomote": ["fem/studies/locomotion.toml", "paper/locomotion/*.toml", "paper/pneumatics/level2.toml",
                 "paper/pneumatics/module_cam.toml"],
    "stall-map": ["paper/pneumatics/stall_map.toml"],
    "load-cases": ["fem/studies/load_cases/*.toml", "paper/silicone/check.toml"],
    "calibrate": ["voxel/studies/dragon_skin_*.toml"],
    "validate": ["voxel/studies/held_out.toml", "paper/silicone/check_validation.toml"],
    "reevaluate": ["paper/silicone/reevaluation*.toml", "paper/silicone/closing_the_loop_reference.toml"],
    "tradeoff": ["paper/trade_off/study.toml", "paper/trade_off/search.toml"],
}
# Designs, the presets of evolve, and what programs wrote.
OTHERS = ["fem/studies/*_design.toml", "paper/trade_off/inchworm.toml", "paper/presets/*.toml"]
FOLDERS = ["fem/studies", "paper", "voxel/scenes", "voxel/studies"]


def files_of(sources, patterns):
    return {file for pattern in patterns for file in sources.glob(pattern)}


def wrong_ones(study, schema):
    """Studies that the schema must refuse: an unknown key, or a value of another kind, in each table of a study."""
    def tables(value, rules, path):
        if isinstance(value, dict) and "properties" in rules:
            yield path, rules
            for key, inner in value.items():
                if key in rules["properties"]:
                    yield from tables(inner, rules["properties"][key], path + [key])
        elif isinstance(value, list) and value and isinstance(rules.get("items"), dict):
            yield from tables(value[0], rules["items"], path + [0])

    def changed(path, key, value):
        wrong = copy.deepcopy(study)
        table = wrong
        for step in path:
            table = table[step]
        table[key] = value
        return wrong

    for path, rules in tables(study, schema, []):
        place = ".".join(str(step) for step in path) or "the top"
        yield f"an unknown key in {place}", changed(path, "no_such_key", 1)
        for key in rules["properties"]:
            yield f"{key} of {place} as an object with an unknown key", changed(path, key, {"no_such_key": []})


def main():
    programs, sources = (pathlib.Path(argument) for argument in sys.argv[1:3])
    faults = []
    known = files_of(sources, OTHERS)
    checked = refused = 0
    for command, patterns in STUDIES.items():
        printed = subprocess.run([programs / f"menger-{command}", "--schema"], capture_output=True, text=True, check=False)
        if printed.returncode != 0:
            faults.append(f"menger-{command} --schema: {printed.stderr}")
            continue
        schema = json.loads(printed.stdout)
        jsonschema.Draft202012Validator.check_schema(schema)
        validator = jsonschema.Draft202012Validator(schema)
        for file in sorted(files_of(sources, patterns)):
            known.add(file)
            study = tomllib.loads(file.read_text())
            for error in validator.iter_errors(study):
                faults.append(f"{file}: refused by menger-{command}: {error.json_path}: {error.message[:200]}")
            checked += 1
            for what, wrong in wrong_ones(study, schema):
                if validator.is_valid(wrong):
                    faults.append(f"{file}: accepted by menger-{command} with {what}")
                refused += 1
    for folder in FOLDERS:
        for file in sorted((sources / folder).rglob("*.toml")):
            if file not in known:
                faults.append(f"{file}: no program is named for it in tests/integration/schemas.py")
    print(f"{checked} studies accepted, {refused} wrong ones refused" if not faults else "\n".join(faults))
    return 1 if faults or checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
