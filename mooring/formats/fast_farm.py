"""Lines between the turbines of a farm: FAST.Farm's primary file, NAME.fstf, which contains the turbines' positions
and the name of MoorDyn's file.

value   NumTurbines, then WT_X WT_Y WT_Z … in m;   value   SharedMoorFile (OpenFAST documentation, FAST.Farm)
"""

import re
import shlex
from pathlib import Path

from hakobune.meshing.text_files import read_text

from .fault import FormatError
from .moordyn_system import read_moordyn_system


def read_fast_farm(path, depth=None):
    """The System of a farm; depth : m, if MoorDyn's file does not give it.  Raises FormatError."""
    path = Path(path)
    lines = read_text(path, FormatError, errors="replace").splitlines()
    count = _value(lines, "NumTurbines")
    file = _value(lines, r"(?:SharedMoorFile|MoorFile)")
    if count is None or not count.isdecimal() or file is None or not file.strip():
        raise FormatError(f"{path} lacks NumTurbines or SharedMoorFile; allowed: FAST.Farm's primary file with both")
    head = next((k for k, line in enumerate(lines) if re.match(r"\s*WT_X\s+WT_Y", line)), None)
    rows = [] if head is None else [line.split()[:3] for line in lines[head + 2 : head + 2 + int(count)]]
    try:
        places = {number: tuple(map(float, row)) for number, row in enumerate(rows, 1)}
    except ValueError:
        places = {}
    if len(places) != int(count) or any(len(place) != 3 for place in places.values()):
        raise FormatError(
            f"{path}: {count} turbines and {len(places)} rows of WT_X, WT_Y, WT_Z; allowed: the same number"
        )
    return read_moordyn_system(path.parent / file, depth, turbines=places)


def _value(lines, name):
    """The value before a name, None without it"""
    for line in lines:
        if re.search(rf"^\s*\S.*?\s{name}\b", line):
            try:
                return shlex.split(line)[0].replace("\\", "/")
            except ValueError:
                return line.split()[0].strip("\"'")
    return None
