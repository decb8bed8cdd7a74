#!/usr/bin/python3
"""The numbers of texts come from the small tables of experiments.

tables.py fill [FILE.md ...]    fills the blocks of texts from their tables; all texts of the tree if none is named
tables.py check [FILE.md ...]   changes nothing, and ends with 1 if a block is not what its table gives
tables.py take SOURCE.csv TABLE.csv [COLUMN | NAME=COLUMN ...]
                                makes a table of columns of a result: all but wall times, those that are named, or all by '*'
tables.py gather TABLE.csv KEY,KEY,... NAME=RESULT.toml ...
                                makes a table with a row of these keys for each result

A block of a text. The comment names the table and gives the header and the rows, the lines up to <!-- end --> are generated:

    <!-- table: paper/walkers/walkers.csv
    best robot, body lengths in a period | seed 1
    standard elements | {1:standard:1/elements_body_lengths .2f}
    -->
    | best robot, body lengths in a period | seed 1 |
    | --- | --- |
    | standard elements | 0.33 |
    <!-- end -->

A number in a sentence: <!-- value: TABLE.csv {ROW/COLUMN .2f} -->1.05<!-- end -->

{ROW/COLUMN FORMAT} is a cell; ROW is what stands in the first column of the table, or in its first columns: a:b. A line with {COLUMN FORMAT} is repeated for every
row of the table. COLUMN*1000 gives another unit. FORMAT is one of Python (.2f), 2sig for significant digits, or nothing for the text as it stands in the table.
An empty cell is refused, but for {COLUMN FORMAT ?}: there it is a dash. A column of the text whose numbers are all dashes, such as "– (– to –) %", is one dash.
Tables are named from the folder of the tree.
Exit codes: 0 done, 1 a text is out of date, 2 wrong input.
"""

import argparse
import csv
import math
import pathlib
import re
import sys
import tomllib

sys.dont_write_bytecode = True  # nothing but results is written beside the studies

from small_tables import InputError, write_table, write_whole  # noqa: E402

BLOCK = re.compile(r"<!-- table: (?P<table>[^\n]*)\n(?P<form>.*?)\n-->\n(?P<lines>(?:(?!<!-- ).)*?)<!-- end -->", re.DOTALL)
VALUE = re.compile(r"<!-- value: (?P<table>\S+) (?P<form>\{[^}\n]*\}) -->(?P<text>[^\n]*?)<!-- end -->")
OPENING = re.compile(r"<!-- (table|value): ")
NO_VALUE = "–"
PLACE = re.compile(r"\{([^{}\n]*)\}")
CELL = re.compile(r"(?:(?P<row>[^/]+)/)?(?P<column>[^/*\s]+)(?:\*(?P<scale>[0-9.eE+-]+))?(?: (?P<format>[^\s?]+))?(?P<may_be_empty> \?)?")


class Table:
    """A table of an experiment. Its first column names its rows."""

    def __init__(self, file):
        self.file = file
        try:
            with open(file, newline="", encoding="utf-8") as text:
                rows = list(csv.reader(text))
        except OSError as error:
            raise InputError(f"{file}: cannot be read: {error.strerror}") from error
        if len(rows) < 2:
            raise InputError(f"{file}: holds no row")
        self.columns = rows[0]
        self.rows = [dict(zip(self.columns, row)) for row in rows[1:]]
        if any(len(row) != len(self.columns) for row in rows[1:]):
            raise InputError(f"{file}: a row has not {len(self.columns)} cells")

    def row(self, name):
        parts = name.split(":")
        found = [row for row in self.rows if [row[column] for column in self.columns[: len(parts)]] == parts]
        if len(found) != 1:
            raise InputError(f"{self.file}: {len(found)} rows begin with {name}")
        return found[0]

    def cell(self, row, column):
        if column not in row:
            raise InputError(f"{self.file}: there is no column {column}")
        return row[column]


def shown(text, scale, form):
    """The text of a cell in a format; raises ValueError if it is no number and should be one."""
    if form is None and scale is None:
        return text
    number = float(text) * float(scale or 1)
    if not math.isfinite(number):
        raise ValueError
    digits = re.fullmatch(r"([1-9])sig", form or "6sig")
    if digits is None:
        return format(number, form)
    if number == 0:
        return "0"
    count = int(digits[1])
    # Rounding may add a digit before the point: 9.96 has the two digits 10.
    power = int(f"{abs(number):.{count - 1}e}".split("e")[1])
    return f"{round(number, count - 1 - power):.{max(0, count - 1 - power)}f}"


def filled(line, table, row):
    """A line of a form with its places filled. The row is that of places without one."""

    def cell_at(place):
        found = CELL.fullmatch(place[1])
        if found is None or (found["row"] is None and row is None):
            raise InputError(f"{{{place[1]}}} is no {{ROW/COLUMN FORMAT}}")
        text = table.cell(table.row(found["row"]) if found["row"] else row, found["column"])
        if not text and found["may_be_empty"]:
            return NO_VALUE
        if not text:
            raise InputError(f"{table.file}: {{{place[1]}}} is empty; where that may be, write {{{place[1]} ?}}")
        try:
            return shown(text, found["scale"], found["format"])
        except ValueError as error:
            raise InputError(f"{table.file}: {{{place[1]}}} is \"{text}\", which cannot be shown so") from error

    return PLACE.sub(cell_at, line)


def is_of_every_row(line):
    return any("/" not in place for place in PLACE.findall(line))


def without_lone_dashes(line):
    """The line with columns that have a dash in place of each number, such as "– (– to –) %", as one dash."""
    columns = line.split("|")
    return "|".join(f" {NO_VALUE} " if column.strip().startswith(NO_VALUE) and not re.search(r"[0-9]", column) else column for column in columns).strip()


def lines_of(form, table):
    """The lines of Markdown that a form and a table give."""
    header, *rest = form.split("\n")
    lines = [header]
    for line in rest:
        lines += [filled(line, table, row) for row in table.rows] if is_of_every_row(line) else [filled(line, table, None)]
    lines[1:] = [without_lone_dashes(line) for line in lines[1:]]
    columns = header.count("|")
    for line in lines:
        if line.count("|") != columns:
            raise InputError(f"\"{line}\" has not the {columns + 1} columns of its header")
    lines.insert(1, " | ".join(["---"] * (columns + 1)))
    return "".join(f"| {line} |\n" for line in lines)


def filled_text(text, file, tree):
    """The text with its blocks filled."""
    if len(OPENING.findall(text)) != len(BLOCK.findall(text)) + len(VALUE.findall(text)):
        raise InputError(f"{file}: a block is not closed: <!-- table: FILE, its lines, -->, the table, <!-- end -->")

    def filling(part, made):
        def replaced(found):
            try:
                new = made(found["form"], Table(tree / found["table"].strip()))
            except InputError as error:
                raise InputError(f"{file}:{found.string.count(chr(10), 0, found.start()) + 1}: {error}") from error
            start = found.start()
            return found[0][: found.start(part) - start] + new + found[0][found.end(part) - start :]

        return replaced

    text = VALUE.sub(filling("text", lambda form, table: filled(form, table, None)), text)
    return BLOCK.sub(filling("lines", lines_of), text)


def texts_of(tree):
    """All texts of the tree that have blocks; results and builds are no part of it, and are not looked into: they may change."""
    parts = [part for part in tree.iterdir() if part.name not in ("build", "demo", ".git")]
    files = [file for part in parts for file in ([part] if part.suffix == ".md" else part.rglob("*.md"))]
    return [file for file in sorted(files) if OPENING.search(file.read_text(encoding="utf-8"))]


def first_difference(before, after):
    pairs = zip((before + "\n").split("\n"), (after + "\n").split("\n"))
    return next(number for number, (old, new) in enumerate(pairs, 1) if old != new)


def fill(tree, files, writes):
    code = 0
    made = {}
    for file in files or texts_of(tree):
        before = file.read_text(encoding="utf-8")
        made[file] = (before, filled_text(before, file, tree))
    for file, (before, after) in made.items():
        if before == after:
            continue
        if writes:
            write_whole(file, after)
            print(f"filled {file}")
        else:
            print(f"{file}:{first_difference(before, after)}: is not what its table gives; fill it with: paper/tables.py fill", file=sys.stderr)
            code = 1
    return code


def take(source, file, columns):
    table = Table(source)
    if columns == ["*"]:
        columns = table.columns
    if not columns:
        columns = [column for column in table.columns if column != "seconds" and not column.endswith("_seconds")]
    pairs = [(name, source or name) for name, _, source in (column.partition("=") for column in columns)]
    write_table(file, [name for name, _ in pairs], [[table.cell(row, column) for _, column in pairs] for row in table.rows])


def gather(file, keys, results):
    rows = []
    for result in results:
        name, _, path = result.partition("=")
        try:
            values = tomllib.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        except (OSError, tomllib.TOMLDecodeError) as error:
            raise InputError(f"{path or result}: cannot be read: {error}") from error
        missing = [key for key in keys if key not in values]
        if missing:
            raise InputError(f"{path}: {missing[0]} is missing")
        rows.append([name, *(values[key] for key in keys)])
    write_table(file, ["name", *keys], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tree", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent, help="folder of the tree")
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("fill", "check"):
        commands.add_parser(name).add_argument("files", type=pathlib.Path, nargs="*")
    one = commands.add_parser("take")
    one.add_argument("source", type=pathlib.Path)
    one.add_argument("table", type=pathlib.Path)
    one.add_argument("columns", nargs="*")
    many = commands.add_parser("gather")
    many.add_argument("table", type=pathlib.Path)
    many.add_argument("keys")
    many.add_argument("results", nargs="+")
    given = parser.parse_args()
    try:
        if given.command == "take":
            take(given.source, given.table, given.columns)
        elif given.command == "gather":
            gather(given.table, given.keys.split(","), given.results)
        else:
            return fill(given.tree, given.files, given.command == "fill")
    except (InputError, OSError) as error:
        print(f"tables.py: error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
