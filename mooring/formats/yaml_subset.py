"""The part of YAML in which mooring systems are written, read strictly: what is not in it is refused with its line.

Block mappings and sequences by indentation, flow lists [a, b] and mappings {a: b} on one line or several, plain
and quoted scalars, comments.  Not read: anchors and aliases, tags, several documents, multi-line text, tabs.
Numbers are those of YAML 1.2: 1e6 and 1.0e6 alike; everything else that is not true, false or null is text.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from .fault import fault

NUMBER = re.compile(r"[-+]?(\d[\d_]*\.?[\d_]*|\.\d+)([eE][-+]?\d+)?")
WORDS = {"true": True, "false": False, "null": None, "~": None, "": None}
KEY = re.compile(r"""("[^"]*"|'[^']*'|[^\s\[\]{}"'#,&*!|>%@`-][^:#]*?|-[^\s:][^:#]*?)\s*:(\s+|$)""")


class _Line(NamedTuple):
    number: int
    indent: int
    text: str


def parse_yaml(text, path="YAML file"):
    """Dictionaries, lists and scalars of a text; `path` is what errors call it.  Raises FormatError with the line."""
    lines = _lines(text, path)
    if not lines:
        return None
    value, rest = _block(lines, 0, lines[0].indent, path)
    if rest < len(lines):
        raise fault(path, lines[rest].number, None, "is indented differently from what it belongs to")
    return value


def _lines(text, path):
    """Lines that say something, a flow collection over several lines joined to one"""
    made, open_line = [], None
    for number, raw in enumerate(text.splitlines(), 1):
        line = _without_comment(raw).rstrip()
        if not line.strip() or (line.strip() == "---" and not made):
            continue
        indent = len(line) - len(line.lstrip(" "))
        if line[indent] == "\t":
            raise fault(path, number, None, "is indented by a tab; allowed: blanks")
        if open_line:
            open_line = _Line(open_line.number, open_line.indent, f"{open_line.text} {line.strip()}")
        else:
            open_line = _Line(number, indent, line[indent:])
        if _depth(open_line.text) <= 0:
            made.append(open_line)
            open_line = None
    if open_line:
        raise fault(path, open_line.number, None, "a bracket is opened and not closed")
    return made


def _without_comment(line):
    quote = ""
    for i, char in enumerate(line):
        if quote:
            quote = "" if char == quote else quote
        elif char in "\"'" and (i == 0 or line[i - 1] in " [{,:-"):
            quote = char
        elif char == "#" and (i == 0 or line[i - 1] in " \t"):
            return line[:i]
    return line


def _depth(text):
    """How many brackets are open at the end"""
    depth, quote = 0, ""
    for i, char in enumerate(text):
        if quote:
            quote = "" if char == quote else quote
        elif char in "\"'" and (i == 0 or text[i - 1] in " [{,:-"):
            quote = char
        else:
            depth += (char in "[{") - (char in "]}")
    return depth


def _block(lines, i, indent, path):
    if lines[i].text == "-" or lines[i].text.startswith("- "):
        return _sequence(lines, i, indent, path)
    if KEY.match(lines[i].text):
        return _mapping(lines, i, indent, path)
    return _scalar(lines[i].text, lines[i].number, path), i + 1


def _sequence(lines, i, indent, path):
    made = []
    while i < len(lines) and lines[i].indent == indent and (lines[i].text == "-" or lines[i].text.startswith("- ")):
        line = lines[i]
        rest = line.text[1:].lstrip(" ")
        if rest:  # what follows the dash opens a block of its own, as far in as it stands
            inner = indent + len(line.text) - len(rest)
            lines[i] = _Line(line.number, inner, rest)
            value, i = _block(lines, i, inner, path)
        elif i + 1 < len(lines) and lines[i + 1].indent > indent:
            value, i = _block(lines, i + 1, lines[i + 1].indent, path)
        else:
            value, i = None, i + 1
        made.append(value)
    return made, i


def _mapping(lines, i, indent, path):
    made = {}
    while i < len(lines) and lines[i].indent == indent:
        line = lines[i]
        found = KEY.match(line.text)
        if not found:
            raise fault(path, line.number, None, f"{line.text!r} is not a key and its value")
        key, rest = found[1].strip("\"'"), line.text[found.end() :].strip()
        if key in made:
            raise fault(path, line.number, None, f"key {key!r} is there twice; allowed: once")
        if rest:
            made[key], i = _scalar(rest, line.number, path), i + 1
        elif i + 1 < len(lines) and (
            lines[i + 1].indent > indent or (lines[i + 1].indent == indent and lines[i + 1].text.startswith("- "))
        ):
            made[key], i = _block(lines, i + 1, lines[i + 1].indent, path)
        else:
            made[key], i = None, i + 1
    return made, i


def _scalar(text, number, path):
    value, rest = _flow(text, number, path, stops="")
    if rest.strip():
        raise fault(path, number, None, f"{rest.strip()!r} follows a value that is complete")
    return value


def _flow(text, number, path, stops):
    """A flow value at the start of a text, and what is left of the text"""
    text = text.lstrip()
    if text[:1] in "[{" and text:
        return _collection(text, number, path)
    if text[:1] in "\"'" and text:
        end = text.find(text[0], 1)
        if end < 0:
            raise fault(path, number, None, "a quotation mark is opened and not closed")
        return text[1:end], text[end + 1 :]
    if text[:1] in "&*!|>%@`" and text:
        raise fault(path, number, None, f"{text.split()[0]!r} is YAML that is not read here; write the value out")
    end = min([text.find(stop) for stop in stops if stop in text] or [len(text)])
    return _plain(text[:end].strip()), text[end:]


def _collection(text, number, path):
    closing = "]" if text[0] == "[" else "}"
    made, text = ([] if closing == "]" else {}), text[1:].lstrip()
    while not text.startswith(closing):
        if closing == "}":
            found = re.match(r"""("[^"]*"|'[^']*'|[^:,\[\]{}]+?)\s*:\s*""", text)
            if not found:
                raise fault(path, number, None, f"{text!r} is not a key and its value")
            key, text = found[1].strip("\"'"), text[found.end() :]
        value, text = _flow(text, number, path, stops="," + closing)
        if closing == "]":
            made.append(value)
        else:
            made[key] = value
        text = text.lstrip()
        if text.startswith(","):
            text = text[1:].lstrip()
        elif not text.startswith(closing):
            raise fault(path, number, None, f"{text!r}: a comma or {closing!r} is missing")
    return made, text[1:]


def _plain(text):
    if text.lower() in WORDS:
        return WORDS[text.lower()]
    if NUMBER.fullmatch(text):
        plain = text.replace("_", "")
        return int(plain) if plain.lstrip("+-").isdigit() else float(plain)
    return text
