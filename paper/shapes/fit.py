#!/usr/bin/python3
"""What texts say of a fit of voxels, as tables.

fit.py values PARAMETERS.toml TABLE.csv   writes values of a fit, with their 95 % intervals where the fit has them
fit.py medians RESULTS TABLE.csv          writes median errors of groups of the bodies that menger validate compared, and how many
                                          displacements go the wrong way, from the folder of its results

Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import statistics
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from small_tables import InputError, read_table, read_toml, run_script, write_table  # noqa: E402


def values_of(parameters):
    """Rows of name, value, low, high. Stiffnesses are those of a voxel with all four walls."""
    fit = parameters["fit"]
    for name, value, interval in (
            ("reduced_chi2", fit["reduced_chi2"], None), ("parameters", fit["parameters"], None), ("residuals", fit["residuals"], None),
            ("curves", len(fit["curves"]), None), ("at_bound", len(fit["at_bound"]), None), ("wide", len(fit["wide"]), None),
            ("no_influence", len(fit["no_influence"]), None),
            ("elbow_ratio", parameters["extension"]["elbow_ratio"], "elbow_ratio"),
            ("neck_ratio", parameters["bulge"]["neck_ratio"], "bulge_neck_ratio"),
            *((name, parameters["extension"][name], name) for name in (
                "plate_stretch_ratio", "plate_draw_in", "plate_rise", "plate_draw_in_per_Pa", "plate_edge_share")),
            *((name, parameters["bulge"][name], name) for name in ("plate_arm_ratio", "wide_volume_ratio")),
            ("axial_Pa", parameters["stiffness"]["axial_Pa"][-1], "axial_Pa"),
            ("bending_Pa", parameters["stiffness"]["bending_Pa"][-1], "bending_Pa")):
        found = fit["confidence_95"].get(interval)
        low, high = found if isinstance(found, list) else ("", "")  # else a word: "not determined"
        yield [name, *("" if number == "" else f"{number:.6g}" for number in (value, low, high))]


PLATES_ON_LEGS = ("bench", "diagonal", "table", "tall_table", "three_legs")  # that were added later, for how limbs lean


def medians_of(errors, kinds):
    """Rows of group, displacement, volume: median errors inside the range of validity, of the largest value in a curve. The row
    `outside_too` has those outside as well. The row `all` also counts the displacements that go the wrong way, and those that are
    large enough to be counted."""
    def is_inside(row):
        return row["validity"] == "inside"

    def of(*conditions):
        for kind in ("displacement", "volume"):
            found = [abs(float(row["error"])) for row in errors if row["kind"] == kind and row["error"] and all(holds(row) for holds in conditions)]
            yield f"{statistics.median(found):.6g}" if found else ""

    def is_old(row):
        return row["body"] not in PLATES_ON_LEGS

    def is_foot(row):
        return row["observable"].startswith("foot")

    yield ["all", *of(is_inside), *(sum(int(row[column]) for row in kinds) for column in ("wrong_signs", "signs"))]
    for group, conditions in (
            ("without_plates_on_legs", [is_old]), ("without_feet", [is_old, lambda row: not is_foot(row)]), ("feet", [is_foot]),
            ("plates_on_legs", [lambda row: not is_old(row)])):
        yield [group, *of(is_inside, *conditions), "", ""]
    yield ["outside_too", *of(), "", ""]


def main(arguments):
    match arguments:
        case ["medians", results, table]:
            folder = pathlib.Path(results)
            try:
                rows = list(medians_of(read_table(folder / "errors.csv"), read_table(folder / "expected_errors.csv")))
            except (KeyError, ValueError) as error:
                raise InputError(f"{folder}: {error}: are errors.csv and expected_errors.csv there those of menger validate?") from error
            write_table(pathlib.Path(table), ["group", "displacement", "volume", "wrong_signs", "signs"], rows)
        case ["values", parameters, table]:
            try:
                rows = list(values_of(read_toml(parameters)))
            except KeyError as error:
                raise InputError(f"{parameters}: {error.args[0]} is missing: is it a file of menger calibrate?") from error
            write_table(pathlib.Path(table), ["name", "value", "low", "high"], rows)
        case _:
            raise InputError(f"wrong arguments\n\n{__doc__}")


if __name__ == "__main__":
    run_script(main)
