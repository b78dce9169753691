"""`hakobune keys` and `hakobune new`.  Heavy imports happen inside."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def keys(
    kind: Annotated[str | None, Parameter(help="of file, or a command that reads it; without it all kinds")] = None,
    word: Annotated[
        str | None, Parameter(help="only tables and keys whose name has it, as waves or pretension")
    ] = None,
    /,
    *,
    json: Annotated[bool, Parameter(help="as JSON", negative="")] = False,
    markdown: Annotated[bool, Parameter(help="as Markdown", negative="")] = False,
):
    """Every key of a scene or study: unit, default, meaning, example.

    hakobune keys study waves
    """
    from . import shown
    from .reference import reference

    if json and markdown:
        raise ValueError("--json and --markdown are given; allowed: one of the two")
    if kind is None:
        print(shown.kinds_text(json, markdown))
        return 0
    tables = shown.having(reference(kind), word)
    if not tables:
        raise ValueError(f"no table and no key of a {kind} has {word!r} in its name; hakobune keys {kind} has all")
    write = shown.as_json if json else shown.as_markdown if markdown else shown.as_text
    print(write(tables))
    return 0


def new(
    kind: Annotated[str | None, Parameter(help="of file, as hakobune keys lists them")] = None,
    file: Annotated[Path | None, Parameter(help="its name [KIND.toml]")] = None,
    /,
):
    """Write a file to begin with, whose keys are explained, and say which commands run it.

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
