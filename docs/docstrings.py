"""Docstrings of the house for mkdocstrings: `name : text`, `returns : text` and `raises : Error, text` as sections."""

from __future__ import annotations

import re

import griffe

ENTRY = re.compile(r"^(\w+(?:, \w+)*) : (.*)$")


class HouseStyle(griffe.Extension):
    """Rewrites each docstring in the form of Google's, which griffe reads"""

    def on_instance(self, *, obj, **_):
        if obj.docstring:
            obj.docstring.value = sections(obj.docstring.value)


def sections(text):
    """The text with its entries as sections `Args:`, `Returns:` and `Raises:`"""
    plain, found, last = [], {"Args": [], "Returns": [], "Raises": []}, None
    for line in text.splitlines():
        if entry := ENTRY.match(line):
            names, told = entry.groups()
            last = found["Returns" if names == "returns" else "Raises" if names == "raises" else "Args"]
            if names == "raises":
                error, _, why = told.partition(", ")
                told = f"{error.rstrip('.')}: {why or 'as its message says'}"
            last += (
                [f"    {told}"] if names in ("returns", "raises") else [f"    {n}: {told}" for n in names.split(", ")]
            )
        elif line.startswith("    ") and last:
            last[-1] += f" {line.strip()}"
        else:
            plain.append(line)
            last = None
    parts = ["\n".join(plain).strip(), *(f"{head}:\n" + "\n".join(lines) for head, lines in found.items() if lines)]
    return "\n\n".join(parts)
