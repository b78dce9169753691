"""The reference of keys as text in the terminal's width, as JSON and as Markdown."""

import json
import shutil
import textwrap

from .kinds import KINDS
from .reference import KeyTable, toml

STEPS = """\
hakobune keys KIND explains the keys of a kind of file
hakobune keys WORD searches the keys of all files
hakobune new KIND  writes an example with every key explained"""


def kinds_text(as_json, as_markdown):
    """All kinds of files, the content of each kind and the commands that read it"""
    if as_json:
        return json.dumps({name: {"meaning": k.meaning, "commands": k.commands} for name, k in KINDS.items()}, indent=1)
    if as_markdown:
        rows = [f"| {name} | {kind.meaning} | {kind.commands} |" for name, kind in KINDS.items()]
        return "\n".join(["| kind | what it is | commands |", "|---|---|---|", *rows])
    lines = [f"{name:<14} {kind.meaning}; read by {kind.commands}" for name, kind in KINDS.items()]
    return "\n".join([*lines, "", STEPS])


def having(tables, word):
    """Tables with a word in the heading, and keys with the word in the name from all other tables.

    If there are none, keys with the word in their meaning
    """
    word, kept = word.strip("[]").lower(), []
    for table in tables:
        if any(word in place.lower().strip("[]").split(".") for place in table.places):
            kept.append(table)
        else:
            kept += _only(table, lambda key: word in key.name.lower())
    return tuple(kept or [one for table in tables for one in _only(table, lambda key: word in key.meaning.lower())])


def _only(table, wanted):
    keys = tuple(filter(wanted, table.keys))
    return [table._replace(keys=keys)] if keys else []


def tables_found(found):
    """`KeyTable`s of the results of a search; keys with the same place in the same set of files share a table"""
    together = {}
    for one in found:
        together.setdefault((one.places, one.kinds), []).append(one.key)
    return tuple(KeyTable(places, f"of {', '.join(kinds)}", tuple(keys)) for (places, kinds), keys in together.items())


def default_of(key):
    """Default of a key, "needed" for a key without one"""
    if key.needed:
        return "needed"
    return "" if key.default is None else toml(key.default)


def explained(key):
    """Meaning of a key, its type unless it is a single number, and an example"""
    kind = f" ({key.type})" if key.type not in ("number", "table", "tables", "text", "table by name") else ""
    example = f"; e.g. {key.example}" if key.example and key.example != default_of(key) else ""
    return f"{key.meaning or key.name.replace('_', ' ')}{kind}{example}"


def as_text(tables):
    width, lines = max(shutil.get_terminal_size((110, 24)).columns, 60), []
    names = max(len(key.name) for table in tables for key in table.keys) + 2
    units = max(len(key.unit) for table in tables for key in table.keys) + 2
    for table in tables:
        head = ", ".join(table.places) if table.places != ("",) else "before any table"
        lines += ["", *textwrap.wrap(f"{head}  {table.meaning}", width, subsequent_indent="  ")]
        for key in table.keys:
            begin = f"  {key.name:<{names}}{key.unit:<{units}}"
            default = default_of(key)
            text = f"{explained(key)}{f' [{default}]' if default else ''}"
            lines += textwrap.wrap(text, width, initial_indent=begin, subsequent_indent=" " * min(len(begin), 40))
    return "\n".join(lines[1:])


def as_json(tables):
    rows = [key._asdict() | {"places": table.places} for table in tables for key in table.keys]
    return json.dumps(rows, ensure_ascii=False, indent=1)


def as_markdown(tables):
    lines = []
    for table in tables:
        head = ", ".join(f"`{place}`" for place in table.places) if table.places != ("",) else "Before any table"
        lines += [f"### {head}", "", f"{table.meaning}.", "", "| key | unit | default | meaning |", "|---|---|---|---|"]
        for key in table.keys:
            text = explained(key).replace("|", "\\|")
            lines.append(f"| `{key.name}` | {key.unit} | {default_of(key)} | {text} |")
        lines.append("")
    return "\n".join(lines).rstrip()
