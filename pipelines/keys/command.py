"""`hakobune keys` and `hakobune new`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def keys(
    kind: Annotated[
        str | None, Parameter(help="kind of file, a command that reads it, or a word to search for in all files")
    ] = None,
    /,
    *words: Annotated[str, Parameter(help="show only the keys with these words, such as waves or pretension")],
    json: Annotated[bool, Parameter(help="print as JSON", negative="")] = False,
    markdown: Annotated[bool, Parameter(help="print as Markdown", negative="")] = False,
    schema: Annotated[
        Path | None, Parameter(help="write JSON Schemas for an editor: .json of one kind, or a folder of all kinds")
    ] = None,
):
    """Explain the keys of a scene or study: unit, default, meaning, example.  Search them by any word.

    hakobune keys study waves
    hakobune keys pretension
    hakobune keys --schema schemas
    """
    from hakobune.mooring.criteria.rule_lines import rule_lines
    from hakobune.mooring.criteria.rules import read_rules, rule_names

    from . import shown

    if json and markdown:
        raise ValueError("--json and --markdown are given; allowed: one of the two")
    if schema is not None:
        return _schemas(kind, words, schema)
    if kind is None:
        print(shown.kinds_text(json, markdown))
        return 0
    write = shown.as_json if json else shown.as_markdown if markdown else shown.as_text
    try:
        tables = _tables(kind, words)
    except ValueError:
        rules = rule_lines((kind, *words))
        if not rules:
            raise
        print(*rules, sep="\n")
        return 0
    print(write(tables))
    asked = {word.strip("[]").lower() for word in (kind, *words)}
    rule = kind.lower() in (name.lower() for name in rule_names(read_rules()))
    if not (json or markdown) and (rule or asked <= {"design", "rules", "limits"}):
        print("", *rule_lines((kind, *words) if rule else ()), sep="\n")
    if not (json or markdown) and any(key.name == "catalogue" for table in tables for key in table.keys):
        from hakobune.mooring.lines.catalogue import FORMS

        print("\nnames in the catalogue of lines, of any size:", *FORMS, sep="\n  ")
    return 0


def _tables(kind, words):
    """The tables of a kind that contain the words, or the keys of all files that do.  Raises ValueError."""
    from . import shown
    from .kinds import kind_named
    from .reference import reference
    from .search import search

    try:
        kind_named(kind)
    except ValueError as unknown:
        found = shown.tables_found(search((kind, *words)))
        if not found:
            raise ValueError(f"no key of any file contains {' and '.join((kind, *words))!r}, and {unknown}") from None
        return found
    tables = reference(kind)
    for word in words:
        tables = shown.having(tables, word)
    if not tables:
        all_words = " and ".join(words)
        raise ValueError(f"no table and no key of a {kind} contains {all_words!r}; hakobune keys {kind} shows all")
    return tables


def _schemas(kind, words, place):
    from hakobune.bem.database.file import check_place

    from . import schema

    if words:
        raise ValueError(f"{words[0]!r} and --schema are given; a schema has all keys of a kind; leave the words out")
    if kind is None:
        if place.suffix or place.is_file():
            raise ValueError(f"{place} is the name of a single file; give a folder for all kinds, or name one kind")
        print("\n".join(map(str, schema.write_schemas(place))))
        return 0
    if place.suffix != ".json":
        raise ValueError(f"{place} has the suffix {place.suffix!r}; allowed: .json")
    made = schema.as_text(schema.schema(kind))
    check_place(place)
    place.write_text(f"{made}\n", encoding="utf-8")
    print(place)
    return 0


def new(
    kind: Annotated[str | None, Parameter(help="kind of file, as hakobune keys lists them")] = None,
    file: Annotated[Path | None, Parameter(help="name of the file [KIND.toml]")] = None,
    /,
):
    """Write an example of a file with every key explained, and print the commands that run it.

    hakobune new study
    """
    from . import shown
    from .beginning import write

    if kind is None:
        print(shown.kinds_text(False, False))
        return 0
    written, steps = write(kind, file or Path(f"{kind}.toml"))
    print("\n".join([*map(str, written), *(f"    {step}" for step in steps)]))
    return 0
