#!/usr/bin/python3
"""Keeps the champion of a search in git: its cells, its fitness, what shape it has, and a small picture.

champion.py take EXPORT STUDY.toml SEED TABLE.csv    puts the champion, of the folder that menger export wrote, into a table, and draws
                                                     TABLE_STUDY_SEED.svg beside it
champion.py shape DIGITS                             prints what shape a body of 3 x 3 x 3 cells has

The shape of a body as it rests, from its cells alone:

- A leg is a group of cells of one layer, joined by faces, under which there is nothing. The layer of the highest cells has none.
- Its feet are the legs that reach the ground, the lowest layer. One leg may be shorter.
- Its asymmetry is the share of cells that a mirror across x, or one across y, puts where there is no cell; the smaller one of the two.
  Materials do not count, and diagonal mirrors do not: the paper's single actuator, as menger builds it, has one.
- It is an uneven quadruped if it has four legs, at least three of them feet, and an asymmetry above 0.

Exit codes: 0 done, 2 wrong input.
"""

import pathlib
import sys

sys.dont_write_bytecode = True  # nothing but results is written beside the studies
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from small_tables import InputError, cell, read_table, read_toml, run_script, write_table, write_whole  # noqa: E402

SIDE = 3
MARGIN = 4.0  # of a picture
LEVELS = (1, 2, 3)
PAPER_DURATION_S = 5.0  # of the preset "paper"
COLUMNS = ["study", "seed", "generations", "robot", "cells", "digits", "fitness_per_minute", "level_1_per_minute", "level_2_per_minute", "level_3_per_minute",
           "legs", "feet", "asymmetry", "uneven_quadruped", "picture"]
COLOURS = {"1": ("#9ad4f5", "#56b4e9", "#3a86b3", "#1f4b66"), "2": ("#f5a06a", "#d55e00", "#9c4500", "#5e2900")}  # of the top, two sides, and the bottom


def cells_of(digits):
    """The occupied cells of a body with their materials; x varies fastest, then y, then z."""
    if len(digits) != SIDE**3 or set(digits) - set("012"):
        raise InputError(f"{digits}: must be {SIDE**3} digits 0, 1 or 2")
    cells = {(n % SIDE, n // SIDE % SIDE, n // SIDE**2): digit for n, digit in enumerate(digits) if digit != "0"}
    if not cells:
        raise InputError(f"{digits}: has no cell")
    return cells


def groups(cells):
    """Sets of cells that faces join, by their layers."""
    left, made = set(cells), []
    while left:
        group, found = set(), [left.pop()]
        while found:
            x, y, z = one = found.pop()
            group.add(one)
            near = {(x + 1, y, z), (x - 1, y, z), (x, y + 1, z), (x, y - 1, z)} & left
            left -= near
            found += near
        made.append(group)
    return made


def legs_of(cells):
    lowest, highest = min(z for _, _, z in cells), max(z for _, _, z in cells)
    legs = [group for group in groups(cells) if next(iter(group))[2] < highest and not any((x, y, z - 1) in cells for x, y, z in group)]
    return legs, [leg for leg in legs if next(iter(leg))[2] == lowest]


def asymmetry(cells):
    shares = []
    for axis in (0, 1):
        ends = [one[axis] for one in cells]
        mirrored = [tuple(min(ends) + max(ends) - value if place == axis else value for place, value in enumerate(one)) for one in cells]
        shares.append(sum(one not in cells for one in mirrored) / len(cells))
    return min(shares)


def shape_of(digits):
    cells = cells_of(digits)
    legs, feet = legs_of(cells)
    uneven = asymmetry(cells)
    is_quadruped = len(legs) == 4 and len(feet) >= 3
    return {"legs": len(legs), "feet": len(feet), "asymmetry": uneven, "uneven_quadruped": "yes" if is_quadruped and uneven > 0 else "no"}


def faces_of(cells, edge, left, upwards):
    """The faces of a body that are seen from beyond its largest x and y: from above if `upwards` is 1, from below if it is -1."""

    def seen(x, y, z):
        height = upwards * 0.5 * (x + y) - z + (SIDE if upwards > 0 else 2 * SIDE)
        return f"{left + edge * 0.866 * (y - x + SIDE):.1f},{edge * height + MARGIN:.1f}"

    faces = []
    for (x, y, z), digit in sorted(cells.items(), key=lambda item: item[0][0] + item[0][1] + upwards * item[0][2]):
        top, side_x, side_y, bottom = COLOURS[digit]
        level, flat = (top, 1) if upwards > 0 else (bottom, 0)
        for neighbour, colour, corners in (
            ((x, y, z + upwards), level, ((0, 0, flat), (1, 0, flat), (1, 1, flat), (0, 1, flat))),
            ((x + 1, y, z), side_x, ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1))),
            ((x, y + 1, z), side_y, ((0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1))),
        ):
            if neighbour not in cells:
                points = " ".join(seen(x + dx, y + dy, z + dz) for dx, dy, dz in corners)
                faces.append(f'<polygon points="{points}" fill="{colour}"/>')
    return faces


def picture(digits):
    """The body from above and from below, where its feet are, as an SVG."""
    cells = cells_of(digits)
    edge = 24.0
    view, height = 2 * 0.866 * SIDE * edge + 2 * MARGIN, 2 * SIDE * edge + 2 * MARGIN
    lines = []
    for left, upwards, words in ((MARGIN, 1, "from above"), (view + MARGIN, -1, "from below")):
        lines += faces_of(cells, edge, left, upwards)
        lines.append(f'<text x="{left + view / 2 - MARGIN:.0f}" y="{height + 12:.0f}" font-family="sans-serif" font-size="12" text-anchor="middle" stroke="none">{words}</text>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * view:.0f}" height="{height + 18:.0f}" stroke="#222222" stroke-linejoin="round">\n'
            + "\n".join(lines) + "\n</svg>\n")


def take(folder, study, seed, table):
    generations = read_table(folder / "generations.csv")
    lineage = read_table(folder / "lineage.csv")
    if not generations or not lineage:
        raise InputError(f"{folder}: has no champion")
    last, champion = generations[-1], lineage[-1]
    if not last["best_fitness_body_lengths"]:
        raise InputError(f"{folder / 'generations.csv'}: no robot of the search has a fitness, so that there is no champion: more generations or survivors")
    per_minute = 60.0 / read_toml(study).get("time", {}).get("duration_s", PAPER_DURATION_S)
    drawn = table.with_name(f"{table.stem}_{study.stem}_{seed}.svg")
    digits = champion["phenotype"]
    row = {"study": study.stem, "seed": seed, "generations": len(generations) - 1, "robot": champion["individual"], "cells": len(cells_of(digits)),
           "digits": digits, "fitness_per_minute": cell(float(last["best_fitness_body_lengths"]) * per_minute), "picture": drawn.name}
    for level in LEVELS:
        if went := last.get(f"level_{level}_displacement_body_lengths"):
            row[f"level_{level}_per_minute"] = cell(float(went) * per_minute)
    row |= {key: cell(value) for key, value in shape_of(digits).items()}
    others = [one for one in (read_table(table) if table.exists() else []) if (one["study"], one["seed"]) != (study.stem, seed)]
    rows = sorted([*others, row], key=lambda one: (one["study"], int(one["seed"])))
    write_whole(drawn, picture(digits))
    write_table(table, COLUMNS, rows)


def main(arguments):
    match arguments:
        case ["take", folder, study, seed, table] if seed.isdigit():
            take(pathlib.Path(folder), pathlib.Path(study), seed, pathlib.Path(table))
        case ["shape", digits]:
            for key, value in shape_of(digits).items():
                print(f"{key}: {cell(value)}")
        case _:
            raise InputError(__doc__)


if __name__ == "__main__":
    run_script(main)
