"""Small tables (CSV) and studies (TOML) that scripts of experiments read and write."""

import csv
import io
import json
import os
import pathlib
import sys
import tomllib


class InputError(Exception):
    """Wrong input: the message names the file."""


def run_script(main):
    """Calls main(arguments) with those of the command line, and ends the script: 0 done, 2 wrong input, with a message."""
    try:
        main(sys.argv[1:])
    except InputError as error:
        print(f"{pathlib.Path(sys.argv[0]).name}: error: {error}", file=sys.stderr)
        sys.exit(2)


def read_table(file):
    """The rows of a table as dictionaries of text."""
    try:
        with open(file, newline="", encoding="utf-8") as text:
            return list(csv.DictReader(text))
    except OSError as error:
        raise InputError(f"{file}: cannot be read: {error.strerror}") from error


def toml_text(study):
    """A study or scene as TOML: {key: value, table: {key: value}}, tables of one level."""
    lines = [f"{key} = {json.dumps(value)}" for key, value in study.items() if not isinstance(value, dict)]
    for table, keys in study.items():
        if isinstance(keys, dict):
            lines += ["", f"[{table}]"] + [f"{key} = {json.dumps(value)}" for key, value in keys.items()]
    return "\n".join(lines).lstrip("\n") + "\n"


def read_toml(file):
    try:
        with open(file, "rb") as text:
            return tomllib.load(text)
    except (OSError, tomllib.TOMLDecodeError) as error:
        raise InputError(f"{file}: cannot be read: {error}") from error


def write_whole(file, text):
    """Writes a file, whole or not at all: an end in between leaves the former one."""
    file.parent.mkdir(parents=True, exist_ok=True)
    temporary = file.with_name(f".{file.name}.{os.getpid()}.partial")
    try:
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(file)
    finally:
        temporary.unlink(missing_ok=True)


def write_table(file, columns, rows):
    """Writes a table of rows: lists of cells, or dictionaries by column. What is None, or not there, is an empty cell."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows([row.get(column, "") for column in columns] if isinstance(row, dict) else row for row in rows)
    write_whole(file, text.getvalue())


def cell(value, digits=4):
    """A number with some significant digits, other values as they are, None as an empty cell."""
    return "" if value is None else f"{value:.{digits}g}" if isinstance(value, float) else value
