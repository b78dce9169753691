"""Mooring systems of others, found under a folder: is each read, and does it come to rest with balanced forces.

    python tests/bench/public_lines.py FOLDER

MoorDyn input of both versions, MoorPy's and RAFT's YAML, OrcaFlex's .yml with lines.  A file that leaves the depth to
its program is read at 200 m.  Right is a System that comes to rest with a tension in every line.
"""

from __future__ import annotations

import re
import sys
import warnings
from collections import Counter
from pathlib import Path

import numpy as np

from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.pipelines.lines.system_file import read_system

DEPTH = 200.0  # m
MOORDYN = re.compile(r"^\s*-{3}.*(LINE TYPES|LINE DICTIONARY)\b", re.IGNORECASE | re.MULTILINE)
FARM = re.compile("SharedMoorFile|MoorFile")
YAML = re.compile(r"^\s*(line_types|LineTypes|Lines|mooring|mooring_line_configs)\s*:", re.MULTILINE)
KINDS = {".txt": MOORDYN, ".dat": MOORDYN, ".inp": MOORDYN, ".fstf": FARM, ".yaml": YAML, ".yml": YAML}


def of_lines(folder):
    """Files that have lines by their headings"""
    for path in sorted(folder.rglob("*")):
        kind = KINDS.get(path.suffix.lower())
        if not kind or not path.is_file() or "MAP" in path.stem:
            continue
        text = path.read_text("utf-8", "replace")
        if kind.search(text) and "$schema" not in text:  # a schema says what files have, and is none
            yield path


def judged(path):
    """("right", "refused" or "wrong", why) of a file of lines"""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            system = read_system(path)
        except ValueError as error:
            if "depth" not in str(error):
                return "refused", str(error).replace(str(path), path.name)
            try:
                system = read_system(path, DEPTH)
            except ValueError as again:
                return "refused", str(again).replace(str(path), path.name)
        try:
            found = rest(system)
        except (ValueError, RuntimeError) as error:
            return "refused", f"read, no rest: {error}"
    largest = max(np.max(found.lines.tension_a), np.max(found.lines.tension_b))
    verdict = "right" if np.isfinite(largest) and largest > 0 else "wrong"
    return verdict, f"{len(system.lines)} lines, {len(system.bodies)} bodies, up to {largest / 1e3:.4g} kN"


def main(folder):
    count = Counter()
    for path in of_lines(folder):
        verdict, why = judged(path)
        count[verdict] += 1
        print(f"{verdict:8} {path.relative_to(folder)}: {' '.join(why.split())[:220]}", flush=True)
    print(dict(count))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
