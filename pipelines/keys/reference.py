"""Every key of a file, from the typed table that reads the key: name, unit, type, default, meaning, example.

The docstring of a table begins with a description; then each line `key, key : unit, meaning` explains keys. `pretension
:` explains pretension_tonf and pretension_kN; keys that a table and its bases do not explain are in `words`. A key
that contains a table has the meaning of this table.
"""

import inspect
import re
import types
import typing
from functools import cache
from typing import NamedTuple

import msgspec

from .kinds import examples_of, struct_of
from .words import COMMON, ENDINGS, UNITS

ENTRY = re.compile(r"(?:^|(?<=; ))(\w+(?:, \w+)*) : ")
PLAIN = {float: "number", int: "whole number", str: "text", bool: "true or false", type(None): ""}
PLURAL = {"number": "numbers", "whole number": "whole numbers", "text": "texts", "list of numbers": "lists of numbers"}


class Key(NamedTuple):
    """One key; default : None without a default; `needed` : whether the key is required; example : TOML, or empty"""

    table: str
    name: str
    unit: str
    type: str
    needed: bool
    default: object
    meaning: str
    example: str


class KeyTable(NamedTuple):
    """A table of a file; places : its headings, such as "[waves]", or "" for keys before the first heading; keys : of
    `Key`"""

    places: tuple[str, ...]
    meaning: str
    keys: tuple[Key, ...]


@cache
def reference(kind):
    """Return a KeyTable for each table of a kind of file, in the order of its keys.  Raises ValueError for an unknown
    kind."""
    found = {}
    _walk(struct_of(kind), "", "", found)
    values = examples_of(kind)
    return tuple(
        KeyTable(tuple(head for head, _ in places), summary(table), _keys(table, places, values))
        for table, places in found.items()
    )


def unit_of(kind, path):
    """Unit of a key, given by its path such as "hawser.length", of a kind of file; empty if there is none or it is
    unknown
    """
    head, _, name = path.rpartition(".")
    found = (key.unit for table in reference(kind) if f"[{head}]" in table.places for key in table.keys
             if key.name == name)  # fmt: skip
    return next(found, "")


def tables_of(kind):
    """Every msgspec.Struct that reads part of a kind of file"""
    found = {}
    _walk(struct_of(kind), "", "", found)
    return tuple(found)


def summary(table):
    """Description of a table: the first paragraph of its docstring"""
    text = inspect.cleandoc(table.__doc__ or "").split("\n\n")[0]
    return "" if ENTRY.match(text) else " ".join(text.split())


def entries(table):
    """{key: text} of the docstring of a table itself, without its bases"""
    found, open_keys = {}, ()
    for line in inspect.cleandoc(table.__dict__.get("__doc__") or "").splitlines():
        marks = list(ENTRY.finditer(line))
        if marks and marks[0].start() == 0:
            ends = [mark.start() for mark in marks[1:]] + [len(line)]
            for mark, end in zip(marks, ends, strict=True):
                open_keys = mark[1].split(", ")
                found |= dict.fromkeys(open_keys, line[mark.end() : end].strip().removesuffix(";"))
        elif line.startswith(" ") and open_keys:
            found |= {key: f"{found[key]} {line.strip()}" for key in open_keys}
        else:
            open_keys = ()
    return found


def text_of(table, name):
    """Explanation of a key in docstrings and common words; None without one"""
    ending = next((end for end in ENDINGS if name.endswith(end)), None)
    found = _own_text(table, name) or COMMON.get(name)
    return found if found or ending is None else _own_text(table, name.removesuffix(ending))


def _own_text(table, name):
    return next((own[name] for own in map(entries, table.__mro__) if name in own), None)


def _walk(table, head, path, found):
    """Collect {Struct: [(heading, path)]} depth first; a path has NAME for a name chosen by the user"""
    found.setdefault(table, []).append((head, path))
    hints = typing.get_type_hints(table)
    for field in msgspec.structs.fields(table):
        for inner, form in _structs(hints[field.name]):
            place = f"{path}.{field.encode_name}".lstrip(".")
            place = f"{place}.NAME" if form == "named" else place
            _walk(inner, f"[[{place}]]" if form == "list" else f"[{place}]", place, found)


def _structs(hint, form="one"):
    if isinstance(hint, type) and issubclass(hint, msgspec.Struct):
        yield hint, form
    inner = {list: "list", dict: "named"}.get(typing.get_origin(hint), form)
    for part in typing.get_args(hint):
        yield from _structs(part, inner)


def _keys(table, places, values):
    hints, keys = typing.get_type_hints(table), []
    for field in msgspec.structs.fields(table):
        inner = next(_structs(hints[field.name]), None)
        name = field.encode_name
        unit, meaning = _unit(name, text_of(table, name) or (summary(inner[0]) if inner else ""))
        default = None if field.default is msgspec.NODEFAULT else field.default
        if field.default_factory not in (msgspec.NODEFAULT, list, dict) and inner is None:
            default = field.default_factory()
        shown = next((values[f"{path}.{name}"] for _, path in places if f"{path}.{name}" in values), None)
        example = "" if inner or shown is None else toml(shown)
        head = places[0][0]
        keys.append(Key(head, name, unit, _type(hints[field.name]), field.required, default, meaning, example))
    return tuple(keys)


def _unit(name, text):
    unit = next((unit for unit in UNITS if re.match(rf"{re.escape(unit)}(?:[,;]|$)", text)), "")
    meaning = text[len(unit) :].lstrip(",; ") if unit else text
    return unit or next((ENDINGS[end] for end in ENDINGS if name.endswith(end)), ""), meaning


def _type(hint):
    if hint in PLAIN:
        return PLAIN[hint]
    origin, parts = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        return " or ".join(word for word in map(_type, parts) if word)
    if origin is list:
        return "tables" if any(_structs(hint)) else f"list of {PLURAL.get(_type(parts[0]), _type(parts[0]))}"
    if origin is tuple:
        return f"{len(parts)} {PLURAL.get(_type(parts[0]), _type(parts[0]))}"
    if origin is dict:
        return "table by name" if any(_structs(hint)) else f"table of {PLURAL[_type(parts[1])]}"
    return "table"


def toml(value):
    """A value as TOML writes it on one line"""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(toml, value))}]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {toml(inner)}" for key, inner in value.items()) + " }" if value else "{}"
    return f'"{value}"' if isinstance(value, str) else str(value)
