"""Draws the picture of known walks as SVG: colours that colour-blind people tell apart (Okabe and Ito), and a mark of its own for each."""

import math

WIDTH, HEIGHT = 1260, 460
TOP, BOTTOM, PANEL, GAP = 50, 130, 340, 80
INK, PALE = "#222222", "#bbbbbb"
STYLES = {
    "half_step": ("#E69F00", "circle", "half the step"),
    "stiff_ground": ("#56B4E9", "square", "ground twice as stiff"),
    "friction": ("#009E73", "triangle", "1 % more friction"),
    "pressure": ("#CC79A7", "diamond", "1 % more pressure"),
    "draft": ("#0072B2", "plus", "draft elements"),
    "fine": ("#D55E00", "cross", "fine elements"),
    "standard": ("#000000", "circle", "standard elements"),
}


def mark(x, y, colour, shape, size=3.6):
    at = f"{x:.1f}", f"{y:.1f}"
    if shape == "circle":
        return f'<circle cx="{at[0]}" cy="{at[1]}" r="{size}" fill="{colour}"/>'
    paths = {
        "square": f"M{-size},{-size}h{2 * size}v{2 * size}h{-2 * size}z",
        "triangle": f"M0,{-1.2 * size}L{1.1 * size},{size}L{-1.1 * size},{size}z",
        "diamond": f"M0,{-1.3 * size}L{1.3 * size},0L0,{1.3 * size}L{-1.3 * size},0z",
        "plus": f"M{-size},0h{2 * size}M0,{-size}v{2 * size}",
        "cross": f"M{-size},{-size}l{2 * size},{2 * size}M{-size},{size}l{2 * size},{-2 * size}",
    }
    paint = f'fill="none" stroke="{colour}" stroke-width="1.6"' if shape in ("plus", "cross") else f'fill="{colour}"'
    return f'<path transform="translate({at[0]},{at[1]})" d="{paths[shape]}" {paint}/>'


def words(x, y, text, anchor="middle", turned=False, size=13):
    turn = f' transform="rotate(-90 {x:.1f} {y:.1f})"' if turned else ""
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}"{turn}>{text}</text>'


class Panel:
    """Axes with ticks; places in it from values."""

    def __init__(self, number, title, x, y):
        """x, y: (title, lowest, highest, ticks, logarithmic)"""
        self.left = 70 + number * (PANEL + GAP)
        self.height = HEIGHT - TOP - BOTTOM
        self.x, self.y = x, y
        low, bottom = self.left, TOP + self.height
        self.parts = [words(low + PANEL / 2, TOP - 18, title, size=14)]
        for tick in x[3]:
            place = self.place_x(tick)
            self.parts += [f'<path d="M{place:.1f},{TOP}V{bottom}" stroke="{PALE}" stroke-width="0.5"/>', words(place, bottom + 18, f"{tick:g}")]
        for tick in y[3]:
            place = self.place_y(tick)
            self.parts += [f'<path d="M{low},{place:.1f}h{PANEL}" stroke="{PALE}" stroke-width="0.5"/>', words(low - 6, place + 4, f"{tick:g}", "end")]
        self.parts += [f'<rect x="{low}" y="{TOP}" width="{PANEL}" height="{self.height}" fill="none" stroke="{INK}"/>',
                       words(low + PANEL / 2, bottom + 40, x[0]), words(low - 48, TOP + self.height / 2, y[0], turned=True)]

    @staticmethod
    def share(value, axis):
        low, high = axis[1], axis[2]
        if axis[4]:
            value, low, high = math.log10(max(value, low)), math.log10(low), math.log10(high)
        return min(1.0, max(0.0, (value - low) / (high - low)))

    def place_x(self, value):
        return self.left + PANEL * self.share(value, self.x)

    def place_y(self, value):
        return TOP + self.height * (1.0 - self.share(value, self.y))

    def add_mark(self, x, y, style):
        self.parts.append(mark(self.place_x(x), self.place_y(y), *style[:2]))

    def add_line(self, points, colour, dashes=""):
        path = "M" + "L".join(f"{self.place_x(x):.1f},{self.place_y(y):.1f}" for x, y in points)
        dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
        self.parts.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="1.6"{dashed}/>')

    def add_band(self, points, colour):
        """points: (x, low, high)"""
        there = [(x, low) for x, low, _ in points] + [(x, high) for x, _, high in reversed(points)]
        path = "M" + "L".join(f"{self.place_x(x):.1f},{self.place_y(y):.1f}" for x, y in there)
        self.parts.append(f'<path d="{path}z" fill="{colour}" fill-opacity="0.15"/>')

    def add_legend(self, entries):
        """entries: (style, text) in two columns below the axes; a style without a mark is a dashed line."""
        for n, (style, text) in enumerate(entries):
            x, y = self.left + (n % 2) * PANEL / 2, TOP + self.height + 64 + 19 * (n // 2)
            if style is None:
                self.parts.append(f'<path d="M{x - 8:.1f},{y - 4:.1f}h16" stroke="{INK}" stroke-dasharray="5 4"/>')
            else:
                self.parts.append(mark(x, y - 4, *style[:2]))
            self.parts.append(words(x + 14, y, text, "start", size=12))


def decades(values):
    """Whole decades around values, and their ticks."""
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    high += high == low
    return 10.0**low, 10.0**high, [10.0**n for n in range(low, high + 1)]


def draw(all_walks, durations):
    robots = all_walks.distance_m
    far_mm = {robot: max(1e-3, 1e3 * distance) for robot, distance in robots.items()}
    ways = (f"distance on {all_walks.reference} elements (mm)", *decades(far_mm.values()), True)

    def drawn_mm(robot, change):
        pair = all_walks.pair(robot, change)
        return None if pair is None else (1e3 * math.hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]), 1e3 * math.hypot(*pair[1]))

    changes = ("half_step", "stiff_ground", "friction", "pressure", "draft", "fine")
    moved = {(robot, change): drawn_mm(robot, change) for robot in robots for change in changes}
    changes = [change for change in changes if any(moved[robot, change] for robot in robots)]
    least = 1e-3  # a thousandth of a millimetre is nothing
    shifts = [max(least, value[0]) for value in moved.values() if value]
    first = Panel(0, "What a change does to where a robot gets", ways, ("the end of the walk moves by (mm)", *decades(shifts), True))
    ends = [ways[1], ways[2]]
    first.add_line([(end, end) for end in (max(ends[0], first.y[1]), min(ends[1], first.y[2]))], INK, "5 4")
    for (robot, change), value in moved.items():
        if value:
            first.add_mark(far_mm[robot], max(least, value[0]), STYLES[change])
    first.add_legend([*((STYLES[change], STYLES[change][2]) for change in changes), (None, "as far as it goes")])

    others = {(robot, change): drawn_mm(robot, change) for robot in robots for change in ("draft", "standard")}
    second = Panel(1, "How far it goes on coarser elements", ways,
                   ("distance (mm)", *decades([*far_mm.values(), *(max(least, v[1]) for v in others.values() if v)]), True))
    second.add_line([(end, end) for end in ends], INK, "5 4")
    for (robot, change), value in others.items():
        if value:
            second.add_mark(far_mm[robot], max(least, value[1]), STYLES[change])
    second.add_legend([(STYLES["draft"], STYLES["draft"][2]), (STYLES["standard"], STYLES["standard"][2]), (None, f"as far as on {all_walks.reference} elements")])

    third = Panel(2, "How shorter walks rank the robots", ("simulated time (s)", 0.0, 5.0, [0, 1, 2, 3, 4, 5], False),
                  (f"Spearman, with 5 s on {all_walks.reference} elements", 0.0, 1.0, [0, 0.2, 0.4, 0.6, 0.8, 1], False))
    for change in ("draft", "standard", "fine"):
        rows = [row for row in durations if row[0] == change and row[4] != ""]
        if not rows:
            continue
        if change == "standard":
            third.add_band([(float(row[2]), float(row[5]), float(row[6])) for row in rows if row[5] != ""], STYLES[change][0])
        third.add_line([(float(row[2]), float(row[4])) for row in rows], STYLES[change][0])
        for row in rows:
            third.add_mark(float(row[2]), float(row[4]), STYLES[change])
    third.add_legend([(STYLES[change], STYLES[change][2]) for change in dict.fromkeys(("draft", "standard", all_walks.reference))])

    parts = [part for panel in (first, second, third) for part in panel.parts]
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" fill="{INK}">\n'
            f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n")
