#!/usr/bin/python3
"""Which bodies random networks grow into, as the paper's text says and with each thing that the released code does otherwise there.

bodies.py studies FOLDER   writes a study for each; its walks last one thousandth of a second, since only bodies are wanted
bodies.py take FOLDER      makes bodies.csv of what menger export wrote into FOLDER/NAME

Bodies are as they are drawn: valid ones, some of them more than once. Aggregates may fall apart, as in the released code, so that it can
be counted how many do; the text's search has only those of its bodies that do not, a row of their own. Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]

import numpy as np  # noqa: E402
from discrepancies import SPONGE_CELLS  # noqa: E402
from sample_statistics import share  # noqa: E402
from scipy.ndimage import label as pieces_of  # noqa: E402
from small_tables import InputError, cell, read_table, read_toml, run_script, toml_text, write_table, write_whole  # noqa: E402

DRAWN = 2000
NINE_CELLS = 9  # a Hausdorff dimension of 2: planes, and others
LABELS = {"text": "the paper's text", "text_in_one_piece": "those of them whose aggregates are in one piece",
          "activations": "negative activation functions, too", "output_function": "outputs that lose their sigmoid", "expression": "later readers of a node get its sum", "axes": "axes in another order", "all": "these four at once"}


def keys_of(name):
    """What the released code has otherwise in [genome]: all of it, or the key of this name, or nothing."""
    text, code = (read_toml(HERE.parent / "presets" / f"{preset}.toml")["genome"] for preset in ("paper", "released-code"))
    return {key: code[key] for key in text if text[key] != code[key] and name in ("all", key)}


def drawn():
    """The names of studies."""
    return [name for name in LABELS if name != "text_in_one_piece"]


def study(name):
    tables = {"genome": keys_of(name), "body": {"levels": [1], "disconnected": "allow"}, "population": {"survivors": DRAWN, "mutants": 1},
              "time": {"duration_s": 0.001}}
    return toml_text({"preset": "paper", "seed": 1, "generations": 0} | {table: keys for table, keys in tables.items() if keys})


def falls_apart(phenotype):
    """Whether the aggregate of bodies has several pieces: cells are joined by faces."""
    body = np.array([digit != "0" for digit in phenotype]).reshape(3, 3, 3)
    return pieces_of(np.kron(body, body))[1] > 1


def row_of(name, phenotypes):
    cells = np.array([sum(digit != "0" for digit in one) for one in phenotypes])
    row = {"variant": name, "label": LABELS[name], "bodies": len(phenotypes), "unlike": len(set(phenotypes)), "cells_median": float(np.median(cells))}
    for what, found in (("full_cube", cells == 27), ("nine_cells", cells == NINE_CELLS), ("sponge", (cells >= SPONGE_CELLS[0]) & (cells <= SPONGE_CELLS[1])),
                        ("one_material", [not {"1", "2"} <= set(one) for one in phenotypes]), ("falls_apart", [falls_apart(one) for one in phenotypes])):
        row |= share(int(np.sum(found)), len(phenotypes)).cells(what)
    return {key: cell(value) for key, value in row.items()}


def take(folder):
    bodies = {name: [row["phenotype"] for row in read_table(folder / name / "individuals.csv")] for name in drawn()}
    bodies["text_in_one_piece"] = [one for one in bodies["text"] if not falls_apart(one)]
    rows = [row_of(name, bodies[name]) for name in LABELS]
    write_table(HERE / "bodies.csv", list(rows[0]), rows)


def main(arguments):
    match arguments:
        case ["studies", folder]:
            pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
            for name in drawn():
                write_whole(pathlib.Path(folder) / f"{name}.toml", study(name))
        case ["take", folder]:
            take(pathlib.Path(folder))
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
