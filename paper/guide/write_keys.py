#!/usr/bin/env python3
"""Writes keys.md, the reference of every key of every study, from what the programs say of themselves with --keys.

write_keys.py PROGRAMS [FILE]: the folder of the programs, and the file to write (keys.md beside this script).
"""

import os
import pathlib
import re
import subprocess
import sys

# In the order in which a newcomer meets them.
COMMANDS = ["loop", "mesh", "inflate", "modes", "locomote", "stall-map", "load-cases", "calibrate", "validate", "simulate", "evolve",
            "reevaluate", "tradeoff"]
COLUMNS = ["key", "kind", "unit", "default", "values", "meaning"]
HEAD = """# Keys of all studies

Every command that reads a study is listed here with all keys that it knows. This page is made from the code (`paper/guide/write_keys.py`), and a test
compares it with the programs. A program prints the same with `--keys`, a file to begin with with `--template`, and a JSON Schema for editors with `--schema`.

- Instead of a default, "must be given" marks a key that every study needs, and "one of several" one that stands in place of others beside it.
  "none": the key may be left out, and its meaning says what happens then.
- The unit stands at the end of a key: `pressure_Pa`. Numbers are SI.
- Paths count from the folder of the study.
"""


def said(programs, command, option):
    return subprocess.run([programs / f"menger-{command}", option], capture_output=True, text=True, check=True).stdout


def rows_of(table):
    """The rows of a table in columns of fixed width, each as a dictionary. Widths are those of bytes."""
    head, *lines = table.encode().splitlines()
    starts = [re.search(rb"(?<![a-z])" + column.encode() + rb"(?![a-z])", head).start() for column in COLUMNS]
    ends = starts[1:] + [None]
    return [{column: line[start:end].decode().strip() for column, start, end in zip(COLUMNS, starts, ends)} for line in lines]


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def code(text):
    return f"`{text}`" if text else ""


def accepted(row):
    """What a key takes: "number > 0, m", or the words one after the other, since a bar would end a cell."""
    values = row["values"]
    if '"' in values:
        values = ": " + re.sub(r'"[^"]*"', lambda word: code(word[0]), values.replace(" | ", ", "))
    elif values:
        values = (" " if values[0] in "<>" or values.startswith("in ") else ": ") + cell(values)
    return row["kind"] + values + (f", {row['unit']}" if row["unit"] else "")


def title_of(table):
    """"a.b[].c" as TOML writes it: the last part in two brackets if there may be several of it."""
    if not table:
        return "At the top of the file"
    return f"`[[{table[:-2].replace('[]', '')}]]`, any number of times" if table.endswith("[]") else f"`[{table.replace('[]', '')}]`"


def section(programs, command):
    purpose = said(programs, command, "--help").split("\n\n")[0].split("Usage:")[0].replace("\n", " ").strip()
    text = f"\n## menger {command}\n\n{purpose}\n"
    tables = {}
    for row in rows_of(said(programs, command, "--keys")):
        table, _, name = row["key"].rpartition(".")
        tables.setdefault(table, []).append((name, row))
    for table, rows in tables.items():
        text += f"\n### {title_of(table)}\n\n| key | default | accepts | meaning |\n| --- | --- | --- | --- |\n"
        for name, row in rows:
            default = row["default"] if row["default"] in ("must be given", "one of several", "none") else code(row["default"])
            text += f"| {code(name)} | {default} | {accepted(row)} | {cell(row['meaning'])} |\n"
    return text


def main():
    programs = pathlib.Path(sys.argv[1])
    file = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(__file__).parent / "keys.md"
    text = HEAD + "".join(section(programs, command) for command in COMMANDS)
    partial = file.with_name("." + file.name + ".partial")
    partial.write_text(text)
    os.replace(partial, file)


if __name__ == "__main__":
    main()
