#!/usr/bin/python3
"""Which robots walk how in this experiment, and where they get.

walks.py choose RESULTS ROBOTS.csv        chooses robots that move from the searches that were screened in RESULTS; rows of walks.csv and
                                          gaits.csv beside the table stay if a robot of that name has the same body
walks.py screened RESULTS SCREENED.csv    makes the table of all robots that were screened, with the walks of both models
walks.py names ROBOTS.csv                 prints the names of the robots
walks.py study ROBOT CHANGE RESULTS       writes RESULTS/ROBOT/CHANGE.toml, a study of menger locomote, or of menger simulate for voxels
walks.py gather RESULTS WALKS.csv         makes the table of walks: one row per robot and change
walks.py gaits RESULTS GAITS.csv          makes the table of how bodies move within a period, with some of the changes

Rows of walks that are not in RESULTS stay in WALKS.csv and GAITS.csv if their robot is in robots.csv; how many is said.

CHANGE is one of those below. Exit codes: 0 done, 2 wrong input.
"""

import copy
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
TREE = HERE.parent.parent
sys.path.insert(0, str(HERE.parent))

from bodies import form_of, read_bodies  # noqa: E402
from small_tables import InputError, read_table, read_toml, write_table  # noqa: E402
from statistics_of_walks import median  # noqa: E402
from voxel_walks import LARGE  # noqa: E402

PERIOD_S = 1.0 / 3.0
LEAST_M = 0.001  # a robot that gets no further in five seconds nearly stands still: nobody asks how well its walk is known
SHIPPED = ("stand18", "uneven_quadruped")  # the others of meshes/designs are symmetric, or flat
GAITS = ("fine", "draft", "voxels", *LARGE)
WALK_S = 5.0
FIRST_OF_GAIT = 5  # periods before it are left out: walks settle
TWO_LAYERS_S = 2.0  # two elements through the wall cost minutes a second

# What each change does to the study of a walk. A function, where the change follows from the walk on standard elements.
CHANGES = {
    "standard": {},
    "draft": {"elements.fidelity": "draft"},
    "fine": {"elements.fidelity": "fine"},
    "half_step": {"dynamics.step_safety": 0.4},
    "stiff_ground": lambda ground_Pa_per_m: {"ground.stiffness_Pa_per_m": 2.0 * ground_Pa_per_m},
    "friction": {"ground.static_friction": 1.01, "ground.kinetic_friction": 0.505},
    "pressure": {"drive.pressure_Pa": [0, 6060]},
    "two_layers": {
        "elements": {"kind": "three_field"},
        "design.elements_through_wall": 2,
        "time.duration_s": TWO_LAYERS_S,
    },
    # All that nobody could tell from the walk, but the pressure, at once.
    "together": lambda ground_Pa_per_m: {
        "dynamics.step_safety": 0.4,
        "ground.stiffness_Pa_per_m": 2.0 * ground_Pa_per_m,
        "ground.static_friction": 1.01,
        "ground.kinetic_friction": 0.505,
    },
    # The default stiffness of the ground follows from the shortest edge of an element, so that fine elements stand on harder ground.
    "fine_same_ground": lambda ground_Pa_per_m: {"elements.fidelity": "fine", "ground.stiffness_Pa_per_m": ground_Pa_per_m},
    # Large ones, on the elements that are fastest: what a model would get wrong that knows these things badly.
    "draft_0.9_pressure": {"elements.fidelity": "draft", "drive.pressure_Pa": [0, 5400]},
    "draft_0.75_pressure": {"elements.fidelity": "draft", "drive.pressure_Pa": [0, 4500]},
    "draft_0.1_ground": lambda ground_Pa_per_m: {"elements.fidelity": "draft", "ground.stiffness_Pa_per_m": 0.1 * ground_Pa_per_m},
    "draft_3_damping": {"elements.fidelity": "draft", "material.loss_factor": 0.3, "material.loss_frequency_Hz": 30},
    "voxels": {},
    "voxels_without_drag": {"damping.global": 0.0},
}
STUDIES = {"voxels": "voxels.toml", "voxels_without_drag": "voxels.toml"}  # all others: walk.toml
RESULT_FILES = ("locomotion.toml", "result.toml")  # of menger locomote and menger simulate


def read_json(file):
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{file}: cannot be read: {error.strerror}; walks on standard elements come first") from error


def toml_value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(one) for one in value) + "]"
    return json.dumps(value) if isinstance(value, str) else repr(value)


def toml_text(study):
    lines = []
    for name, table in study.items():
        lines += ["", f"[{name}]", *(f"{key} = {toml_value(value)}" for key, value in table.items())]
    return "\n".join(lines[1:]) + "\n"


def changed(study, change):
    """The study with the values of a change: {"table.key": value, "table": a whole table}."""
    result = copy.deepcopy(study)
    for place, value in change.items():
        table, _, key = place.partition(".")
        if key:
            result.setdefault(table, {})[key] = value
        else:
            result[table] = value
    return result


def layers_text(layers):
    return "/".join(",".join(layer) for layer in layers)


def layers_of(text):
    return [layer.split(",") for layer in text.split("/")]


def cells_of(layers):
    return sum(digit != "0" for layer in layers for row in layer for digit in row)


def way_of(points, model):
    """The displacement of a model in the plane, from the end of the first period on."""
    first = next(point for point in points if float(point["time_s"]) >= PERIOD_S - 1e-6)
    return [float(points[-1][f"{model}_d{axis}_m"]) - float(first[f"{model}_d{axis}_m"]) for axis in "xy"]


def screened(folder):
    """The robots of a search that finite elements completed: rows of its table with the displacements in both models."""
    for row in read_table(folder / "reevaluation.csv"):
        if row["elements_status"] != "completed":
            continue
        points = read_table(folder / "trajectories" / f"rank_{int(row['rank']):04d}.csv")
        surrogate = way_of(points, "surrogate") if row["surrogate_status"] == "completed" else ["", ""]
        yield {**row, "way_m": way_of(points, "elements"), "surrogate_way_m": surrogate}


def choose(results, table):
    robots = []
    seen = set()
    for folder in sorted(pathlib.Path(results).glob("screened_*")):
        search = folder.name.removeprefix("screened_")
        for row in sorted(screened(folder), key=lambda one: int(one["rank"])):
            form = form_of(row["body"])
            if math.hypot(*row["way_m"]) < LEAST_M or form in seen:
                continue
            seen.add(form)
            robots.append([f"search_{search}_rank_{int(row['rank']):02d}", search, row["rank"], row["cells"], row["body"],
                           *row["surrogate_way_m"]])
    for name in SHIPPED:
        layers = read_toml(TREE / "meshes" / "designs" / f"{name}.toml")["layers"]
        robots.append([name, "shipped", "", cells_of(layers), layers_text(layers), "", ""])
    before = read_bodies(table) if table.exists() else {}
    write_table(table, ["robot", "search", "rank", "cells", "layers", "surrogate_dx_m", "surrogate_dy_m"], robots)
    same = {robot for robot, body in read_bodies(table).items() if before.get(robot) == body}
    for other in (table.parent / "walks.csv", table.parent / "gaits.csv"):
        rows = read_table(other) if other.exists() else []
        kept = [row for row in rows if row["robot"] in same]
        if len(kept) < len(rows):
            print(f"{other}: {len(rows) - len(kept)} rows are of other bodies and go", file=sys.stderr)
            write_table(other, list(rows[0]), kept)


def model_of_search(results, search):
    manifest = read_json(results / f"search_{search}.manifest.json")
    return manifest["parameters"]["evaluation"]["model"]


def screened_robots(results, table):
    rows = []
    for folder in sorted(pathlib.Path(results).glob("screened_*")):
        search = folder.name.removeprefix("screened_")
        for row in sorted(screened(folder), key=lambda one: int(one["rank"])):
            ways = [*row["surrogate_way_m"], *row["way_m"]]
            cells = ["" if way == "" else f"{1e6 * way:.1f}" for way in ways]
            rows.append([search, model_of_search(results, search), row["rank"], row["cells"], row["body"], *cells])
    write_table(table, ["search", "search_on", "rank", "cells", "layers", "voxels_dx_um", "voxels_dy_um", "draft_dx_um", "draft_dy_um"], rows)


def study_of(robot, change, results):
    found = [row for row in read_table(HERE / "robots.csv") if row["robot"] == robot]
    if len(found) != 1 or change not in CHANGES:
        raise InputError(f"there is no robot {robot} in robots.csv, or no change {change}")
    study = read_toml(HERE / STUDIES.get(change, "walk.toml"))
    if "surrogate" in study:
        study["surrogate"]["parameters"] = str((HERE / study["surrogate"]["parameters"]).resolve())
    study["design"].update(layers=layers_of(found[0]["layers"]), name=robot)
    values = CHANGES[change]
    if callable(values):
        manifest = read_json(results / robot / "standard" / "manifest.json")
        values = values(manifest["parameters"]["ground"]["stiffness_Pa_per_m"])
    file = results / robot / f"{change}.toml"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(toml_text(changed(study, values)), encoding="utf-8")
    print(file)


def read_points(file, axes):
    """[time, place of the centre of mass along each axis], s and m"""
    return [[float(row["time_s"]), *(float(row[f"centre_of_mass_{axis}_m"]) for axis in axes)] for row in read_table(file)]


def at(points, time_s):
    """The place at a time, between two records."""
    for before, after in zip(points, points[1:]):
        if before[0] <= time_s <= after[0]:
            share = (time_s - before[0]) / (after[0] - before[0])
            return [a + share * (b - a) for a, b in zip(before[1:], after[1:])]
    if abs(points[-1][0] - time_s) < 1e-6:  # the last step may end a rounding before the time
        return list(points[-1][1:])
    raise InputError(f"no record at {time_s} s")


def gait(points):
    """Medians over the periods from the sixth on, m: how far the centre of mass rises and falls, the length of its path over the ground,
    and how far apart that path's ends are."""
    heights, paths, steps = [], [], []
    for n in range(FIRST_OF_GAIT, round(points[-1][0] / PERIOD_S)):
        own = [point for point in points if n * PERIOD_S - 1e-3 <= point[0] <= (n + 1) * PERIOD_S + 1e-3]
        heights.append(max(point[3] for point in own) - min(point[3] for point in own))
        paths.append(sum(math.dist(a[1:3], b[1:3]) for a, b in zip(own, own[1:])))
        steps.append(math.dist(own[0][1:3], own[-1][1:3]))
    return [median(values) for values in (heights, paths, steps)]


def write_kept(table, columns, found, changes):
    """Writes rows of robots and changes, with those that the table had of others. @param found {(robot, change): cells after these}"""
    kept = {(row["robot"], row["change"]): [row[column] for column in columns] for row in (read_table(table) if table.exists() else [])}
    names = [row["robot"] for row in read_table(HERE / "robots.csv")]
    former = sum(robot in names and change in changes and (robot, change) not in found for robot, change in kept)
    if former:
        print(f"{table}: {former} rows are kept from before", file=sys.stderr)
    kept |= {key: [*key, *cells] for key, cells in found.items()}
    write_table(table, columns, [kept[robot, change] for robot in names for change in changes if (robot, change) in kept])


def gaits(results, table):
    found = {}
    for robot in read_table(HERE / "robots.csv"):
        for change in GAITS:
            file = results / robot["robot"] / change / "trajectory.csv"
            if not file.exists():
                continue
            points = read_points(file, "xyz")
            if points[-1][0] > WALK_S - 1e-6:
                found[robot["robot"], change] = [f"{1e6 * value:.1f}" for value in gait(points)]
    write_kept(table, ["robot", "change", "rise_um", "path_um", "step_um"], found, GAITS)


def gather(results, table):
    """Places at the ends of the periods, from the start, in micrometres; a walk that failed has none."""
    periods = range(1, 16)
    found = {}
    for robot in read_table(HERE / "robots.csv"):
        for change in CHANGES:
            folder = results / robot["robot"] / change
            files = [folder / name for name in RESULT_FILES if (folder / name).exists()]
            if not files:
                continue
            result = read_toml(files[0])
            if result["status"] == "stopped":
                continue
            points = read_points(folder / "trajectory.csv", "xy")
            places = []
            for n in periods:
                if result["status"] == "completed" and n * PERIOD_S <= points[-1][0] + 1e-6:
                    places += [f"{1e6 * (here - start):.1f}" for here, start in zip(at(points, n * PERIOD_S), points[0][1:])]
                else:
                    places += ["", ""]
            found[robot["robot"], change] = [result["status"], result.get("elements", ""), result["steps"], *places]
    columns = ["robot", "change", "status", "elements", "steps", *(f"{axis}_{n}_um" for n in periods for axis in "xy")]
    write_kept(table, columns, found, CHANGES)


def main(words):
    forms = {"choose": 2, "screened": 2, "gaits": 2, "names": 1, "study": 3, "gather": 2}
    if not words or forms.get(words[0]) != len(words) - 1:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        if words[0] == "choose":
            choose(pathlib.Path(words[1]), pathlib.Path(words[2]))
        elif words[0] == "screened":
            screened_robots(pathlib.Path(words[1]), pathlib.Path(words[2]))
        elif words[0] == "gaits":
            gaits(pathlib.Path(words[1]), pathlib.Path(words[2]))
        elif words[0] == "names":
            print("\n".join(row["robot"] for row in read_table(words[1])))
        elif words[0] == "study":
            study_of(words[1], words[2], pathlib.Path(words[3]))
        else:
            gather(pathlib.Path(words[1]), pathlib.Path(words[2]))
    except InputError as error:
        print(f"walks.py: error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
