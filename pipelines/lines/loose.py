"""`hakobune lines` of a MoorDyn file without lines: where its rods and bodies rest by themselves."""

from __future__ import annotations

import numpy as np

from ..common.quantities import StudyError
from .system_file import TOML, YAML


def without_lines(path):
    """The MoorDynFile of a path if it has no lines, else None"""
    if path.suffix.lower() in (*TOML, *YAML):
        return None
    from hakobune.mooring.formats.moordyn import read_moordyn

    file = read_moordyn(path)
    return None if file.lines else file


def check_alone(path, asked):
    """Raise StudyError where more is asked of such a file; asked : {flag: value, None where not given}"""
    given = [flag for flag, value in asked.items() if value is not None and value is not False]
    if given:
        raise StudyError(f"{path} has no lines, and {given[0]} is for these; allowed: --depth")


def rests(file, path, depth):
    """[Loose] of a file.  raises : FormatError; warns of what is left out"""
    from hakobune.mooring.formats.moordyn_loose import rests_of_moordyn
    from hakobune.mooring.formats.moordyn_system import still_water

    return rests_of_moordyn(file, still_water(file, path, depth), path)


def show_loose(console, table, found):
    """A row a part; table : a rich Table of part, state and both ends"""
    for one in found:
        cells = ["–"] * 2 if one.ends is None else [_place(end) for end in one.ends]
        table.add_row(one.name, one.state, *cells, *["–"] * (2 - len(cells)))
    console.print(table)


def _place(end):
    return ", ".join(f"{value:.3f}" for value in np.where(np.abs(end) < 5e-4, 0.0, end))
