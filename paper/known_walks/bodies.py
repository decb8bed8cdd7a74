"""What the bodies of robots are like. A body is a text: layers from the ground up, apart by slashes, of rows apart by commas, of cells."""

# Mirrors of the plane that leave a square as it is: of a place in rows and columns, and of a displacement.
MIRRORS = {
    "x": (lambda rows: [row[::-1] for row in rows], lambda way: (-way[0], way[1])),
    "y": (lambda rows: rows[::-1], lambda way: (way[0], -way[1])),
    "diagonal": (lambda rows: list(map("".join, zip(*rows))), lambda way: (way[1], way[0])),
    "other diagonal": (lambda rows: list(map("".join, zip(*[row[::-1] for row in rows[::-1]]))), lambda way: (-way[1], -way[0])),
}


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


def has_overhang(layers):
    """Whether a cell has nothing below it, although the body has a layer there."""
    body = grid_of(layers)
    return any(above == "1" and below == "0"
               for lower, upper in zip(body, body[1:]) if any("1" in row for row in lower)
               for below_row, above_row in zip(lower, upper) for below, above in zip(below_row, above_row))
