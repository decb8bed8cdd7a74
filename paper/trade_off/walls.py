#!/usr/bin/python3
"""How far thin walls are from quadratic elements, by pressure.

walls.py CURVES TABLE.csv    CURVES: folder of the load cases of walls.toml, which are named BODY_ELEMENTS
Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from small_tables import InputError, cell, read_table, run_script, write_table  # noqa: E402

REFERENCE = "quadratic"
FIDELITIES = ["draft", "standard", "fine"]
BODIES = {  # what is compared beside the growth of the chamber
    "cell_2mm": "extent_x_m",
    "cell_1mm": "extent_x_m",
    "arch": "foot_1_out_m",
}


def states(folder, name):
    """The states of a curve that are not at rest."""
    rows = read_table(folder / f"{name}.csv")
    return [row for row in rows if float(row["pressure_Pa"]) != 0.0]


def rows_of(folder, body, observable):
    """A row for each fidelity and pressure: relative errors against the quadratic elements."""
    reference = states(folder, f"{body}_{REFERENCE}")
    for fidelity in FIDELITIES:
        found = states(folder, f"{body}_{fidelity}")
        if [row["pressure_Pa"] for row in found] != [row["pressure_Pa"] for row in reference]:
            raise InputError(f"{folder / body}_{fidelity}.csv: has other pressures than the curve of quadratic elements")
        for place, (truth, row) in enumerate(zip(reference, found), 1):
            error = {key: float(row[key]) / float(truth[key]) - 1.0 for key in ("volume_change", observable)}
            yield [body, fidelity, place, row["pressure_Pa"], float(truth["volume_change"]), error["volume_change"], observable,
                   error[observable]]


def main(arguments):
    if len(arguments) != 2:
        raise InputError("give the folder of the curves and the table")
    folder = pathlib.Path(arguments[0])
    rows = [row for body, observable in BODIES.items() for row in rows_of(folder, body, observable)]
    header = ["body", "fidelity", "state", "pressure_Pa", "volume_change", "volume_error", "observable", "error"]
    write_table(pathlib.Path(arguments[1]), header, [[cell(value) for value in row] for row in rows])


run_script(main)
