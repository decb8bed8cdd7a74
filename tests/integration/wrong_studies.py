"""Makes wrong studies out of right ones, with the JSON Schema of their program. Each has exactly one fault.

A fault is of one of KINDS. The schema is asked for what a key may hold, so that the fault lies just beyond it.
"""

import copy
import json
import math
import typing

KINDS = ["unknown key", "wrong type", "out of range", "unknown word", "wrong length", "missing key", "two alternatives",
         "no alternative"]


class Wrong(typing.NamedTuple):
    kind: str     # one of KINDS
    what: str     # for messages
    key: str      # the key that a message about the fault must name
    study: dict
    is_new: bool  # whether the right study does not have the key


def number_type(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def has_type(value, name):
    return {"string": isinstance(value, str), "boolean": isinstance(value, bool), "number": number_type(value),
            "integer": number_type(value) and value == int(value), "array": isinstance(value, list),
            "object": isinstance(value, dict)}[name]


# A value of another type, for each type. An integer is a number, too.
OTHER_TYPE = {"string": 7, "boolean": "yes", "number": "many", "integer": 1.5, "array": True, "object": 3}


def branches_of(rules):
    """The schemas of which a value must satisfy one."""
    return rules.get("anyOf", [rules]) if "type" not in rules else [rules]


def wrong_values(rules):
    """Pairs of a kind of fault and a value that the schema of a key must refuse."""
    branches = branches_of(rules)
    types = [branch["type"] for branch in branches]

    def is_of_another(branch, value):
        return not any(has_type(value, other["type"]) for other in branches if other is not branch)

    for branch in branches:
        kind = branch["type"]
        candidates = [("wrong type", OTHER_TYPE[kind])] if kind != "integer" or types == ["integer"] else [("wrong type", True)]
        if kind in ("number", "integer"):
            step = 1 if kind == "integer" else 0.5
            for limit, away in (("minimum", -step), ("maximum", step), ("exclusiveMinimum", 0), ("exclusiveMaximum", 0)):
                if limit in branch:
                    value = branch[limit] + away * max(1.0, abs(branch[limit]) * 1e-9)
                    candidates.append(("out of range", math.floor(value) if kind == "integer" else value))
        if "enum" in branch:
            candidates.append(("unknown word", "no_such_word"))
        if kind == "string" and branch.get("minLength") == 1:
            candidates.append(("wrong length", ""))
        if kind == "array":
            item = right_value(branch["items"])
            for fault, value in wrong_values(branch["items"]):
                candidates.append((fault, [item] * max(0, branch.get("minItems", 1) - 1) + [value]))
            if branch.get("minItems", 0) > 0:
                candidates.append(("wrong length", [item] * (branch["minItems"] - 1)))
            if "maxItems" in branch:
                candidates.append(("wrong length", [item] * (branch["maxItems"] + 1)))
        for fault, value in candidates:
            if is_of_another(branch, value):
                yield fault, value


def right_value(rules):
    """A value that the schema of a key accepts."""
    branch = branches_of(rules)[0]
    kind = branch["type"]
    if kind == "boolean":
        return True
    if kind == "string":
        return branch["enum"][0] if "enum" in branch else "text"
    if kind == "array":
        return [right_value(branch["items"])] * max(1, branch.get("minItems", 0))
    if kind == "object":
        table = {key: right_value(branch["properties"][key]) for key in branch.get("required", [])}
        for demand in branch.get("allOf", []):
            if "anyOf" in demand and not any(option["required"][0] in table for option in demand["anyOf"]):
                key = demand["anyOf"][0]["required"][0]
                table[key] = right_value(branch["properties"][key])
        return table
    lowest = branch.get("minimum", branch.get("exclusiveMinimum", -math.inf))
    highest = branch.get("maximum", branch.get("exclusiveMaximum", math.inf))
    if math.isfinite(lowest) and math.isfinite(highest):
        value = 0.5 * (lowest + highest)
    elif math.isfinite(lowest):
        value = lowest + 1
    else:
        value = highest - 1 if math.isfinite(highest) else 0
    return math.floor(value) if kind == "integer" else value


def tables_of(value, rules, path=()):
    """The tables of a study with their schemas, and the path to each."""
    if isinstance(value, dict) and "properties" in rules:
        yield path, value, rules
        for key, inner in value.items():
            for branch in branches_of(rules["properties"].get(key, {"type": "none"})):
                yield from tables_of(inner, branch, path + (key,))
    elif isinstance(value, list) and value and isinstance(rules.get("items"), dict):
        yield from tables_of(value[0], rules["items"], path + (0,))


def wrong_studies(study, schema):
    """Makes every wrong study that differs from a right one in one key."""
    def changed(path, change):
        wrong = copy.deepcopy(study)
        table = wrong
        for step in path:
            table = table[step]
        change(table)
        return wrong

    for path, table, rules in tables_of(study, schema):
        place = ".".join(str(step) for step in path) or "the top"

        def wrong(kind, what, key, change, path=path, table=table, place=place):
            return Wrong(kind, f"{what} in {place}", key, changed(path, change), key not in table)

        yield wrong("unknown key", "no_such_key", "no_such_key", lambda t: t.update(no_such_key=1))
        for key, of_key in rules["properties"].items():
            for kind, value in wrong_values(of_key):
                yield wrong(kind, f"{key} = {json.dumps(value)}", key, lambda t, k=key, v=value: t.update({k: v}))
        for key in rules.get("required", []):
            yield wrong("missing key", f"no {key}", key, lambda t, k=key: t.pop(k))
        for demand in rules.get("allOf", []):
            keys = demand.get("not", {}).get("required", [])
            given = [key for key in keys if key in table]
            if len(given) == 1:
                other = next(key for key in keys if key != given[0])
                if other not in rules["properties"]:  # a form that only programs use
                    continue
                value = right_value(rules["properties"][other])
                yield wrong("two alternatives", f"{given[0]} and {other}", other, lambda t, k=other, v=value: t.update({k: v}))
            if "anyOf" in demand:
                keys = [option["required"][0] for option in demand["anyOf"]]
                given = next(key for key in keys if key in table)
                yield wrong("no alternative", f"none of {', '.join(keys)}", given, lambda t, k=given: t.pop(k))


def toml_text(value):
    """A value as TOML; tables in it are written in one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, list):
        return "[" + ", ".join(toml_text(entry) for entry in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml_text(entry)}" for key, entry in value.items()) + "}"
    return repr(value)


def toml_file(study):
    return "".join(f"{json.dumps(key)} = {toml_text(value)}\n" for key, value in study.items())
