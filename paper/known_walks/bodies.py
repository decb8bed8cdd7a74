"""What the bodies of robots are like. A body is a text: layers from the ground up, apart by slashes, of rows apart by commas, of cells."""

import itertools

from small_tables import read_table

# Mirrors of the plane that leave a square as it is: of a place in rows and columns, and of a displacement.
MIRRORS = {
    "x": (lambda rows: [row[::-1] for row in rows], lambda way: (-way[0], way[1])),
    "y": (lambda rows: rows[::-1], lambda way: (way[0], -way[1])),
    "diagonal": (lambda rows: list(map("".join, zip(*rows))), lambda way: (way[1], way[0])),
    "other diagonal": (lambda rows: list(map("".join, zip(*[row[::-1] for row in rows[::-1]]))), lambda way: (-way[1], -way[0])),
}


def read_bodies(file):
    """{robot: its body}"""
    return {row["robot"]: row["layers"] for row in read_table(file)}


def form_of(layers):
    """A body whose cells are all of one material: they are driven alike."""
    return layers.replace("2", "1")


def grid_of(layers):
    return [form_of(layer).split(",") for layer in layers.split("/")]


def mirrors_of(layers):
    """The names of the mirrors that a standing body is symmetric about."""
    body = grid_of(layers)
    grown = [row for layer in body for row in layer]
    ys = [n for n in range(len(body[0])) if any("1" in layer[n] for layer in body)]
    xs = [n for n in range(len(grown[0])) if any(row[n] == "1" for row in grown)]
    cut = [[row[min(xs) : max(xs) + 1] for row in layer[min(ys) : max(ys) + 1]] for layer in body]
    return [name for name, (mirrored, _) in MIRRORS.items() if [mirrored(layer) for layer in cut] == cut]


def is_stepped(layers):
    """Whether two cells that follow each other have the same edge that points inwards: a step, an overhang, a wall on a plate. As the kind
    "stepped" of menger simulate; there is no such edge in one layer."""
    cells = {(x, y, z) for z, layer in enumerate(grid_of(layers)) for y, row in enumerate(layer) for x, digit in enumerate(row) if digit == "1"}
    units = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]

    def moved(cell, *ways):
        return tuple(map(sum, zip(cell, *ways)))

    def has_edge(cell, one, other):
        return all(at in cells for at in (cell, moved(cell, one), moved(cell, other))) and moved(cell, one, other) not in cells

    for n, along in enumerate(units):
        one, other = (units[(n + k) % 3] for k in (1, 2))
        for to_one, to_other in itertools.product((1, -1), repeat=2):
            ways = tuple(to_one * c for c in one), tuple(to_other * c for c in other)
            if any(has_edge(cell, *ways) and has_edge(moved(cell, along), *ways) for cell in cells):
                return True
    return False
