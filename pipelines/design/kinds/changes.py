"""Possible changes of a study that fails: sizes of lines and ropes, pretension, number of lines.

Each way is a series of studies, with increasing changes.  Sizes are those of the catalogue; a rope of a berth, given
by its breaking load, is strengthened in steps of a tenth at constant strain. Lines given individually by anchor and
length keep their pretension and their number.
"""

from copy import deepcopy
from typing import NamedTuple

import numpy as np

from hakobune.mooring.criteria.strength import larger_sizes

SIZES = 16  # largest number of sizes tried
STRONGER = tuple(round(1 + 0.1 * i, 1) for i in range(1, 11))  # factors on the breaking load of ropes
SLACKER, TIGHTER = (0.8, 0.65, 0.5, 0.4), (1.25, 1.5, 2.0, 2.5)  # factors on the pretension
MORE = 3  # lines at each corner, or at a buoy
APART = 20.0  # degrees between the first and last line of a corner that had one
BREAKING = {"breaking_load_kN": "kN", "breaking_load_tonf": "tonf"}
TENSIONS = tuple(f"{name}_{unit}" for name in ("pretension", "top_tension") for unit in ("kN", "tonf"))


class Changed(NamedTuple):
    """words : the change and the new value; study : raw tables"""

    words: str
    study: dict


def ways(study):
    """{name of the way: [Changed]}, for the ways that apply to the study"""
    found = {
        "size": list(_sizes(study)) or list(_stronger_ropes(study)),
        "less pretension": list(_tensions(study, SLACKER)),
        "more pretension": list(_tensions(study, TIGHTER)),
        "number": list(_numbers(study)),
    }
    return {name: changes for name, changes in found.items() if changes}


def _sizes(study):
    kinds = {name: table["catalogue"] for name, table in study.get("types", {}).items() if "catalogue" in table}
    for names in zip(*(larger_sizes(kind, SIZES) for kind in kinds.values()), strict=False):
        changed = deepcopy(study)
        for name, size in zip(kinds, names, strict=True):
            changed["types"][name]["catalogue"] = size
        yield Changed(", ".join(f"{size} for {name}" for name, size in zip(kinds, names, strict=True)), changed)


def _stronger_ropes(study):
    loads = sorted(
        {(rope[key], unit) for rope in study.get("rope", ()) for key, unit in BREAKING.items() if key in rope}
    )
    for factor in STRONGER if loads else ():
        changed = deepcopy(study)
        for rope in changed["rope"]:
            for key in {f"{part}{key}" for part in ("", "tail_") for key in BREAKING} & set(rope):
                rope[key] *= factor
        told = ", ".join(
            f"{', '.join(f'{factor * load:.4g}' for load, unit in loads if unit == one)} {one}"
            for one in dict.fromkeys(unit for _, unit in loads)
        )
        yield Changed(f"ropes of {told} breaking load", changed)


def _tensions(study, factors):
    for factor in factors:
        changed, told = deepcopy(study), {}
        for table in _tensioned(changed):
            for key in set(TENSIONS) & set(table):
                table[key] *= factor
                told[f"{table[key]:.4g} {key.rsplit('_', 1)[1]}"] = None
        if told:
            yield Changed(f"a pretension of {', '.join(told)}", changed)


def _tensioned(study):
    """Tables that may have a pretension"""
    mooring = study.get("mooring")
    return [*study.get("spreads", ()), *study.get("lines", ()), *study.get("rope", ()), *([mooring] if mooring else ())]


def _numbers(study):
    yield from (change for more in range(1, MORE + 1) for change in _more_lines(study, more))
    if study.get("rope"):
        changed = deepcopy(study)
        changed["rope"] += [{**rope, "name": f"{rope['name']}, second"} for rope in study["rope"]]
        yield Changed(f"{len(changed['rope'])} ropes, two at each place", changed)


def _more_lines(study, more):
    changed = deepcopy(study)
    if study.get("spreads"):
        for spread in changed["spreads"]:
            headings = spread["corner_headings_deg"]
            middle, half = np.mean(headings), max(np.ptp(headings), APART) / 2
            count = len(headings) + more
            spread["corner_headings_deg"] = [round(float(x), 2) for x in middle + half * np.linspace(-1, 1, count)]
        words = ", ".join(str(len(spread["corner_headings_deg"])) for spread in changed["spreads"])
        yield Changed(f"{words} lines at each corner", changed)
    elif "count" in study.get("mooring", {}):
        changed["mooring"]["count"] += more
        yield Changed(f"{changed['mooring']['count']} lines at the buoy", changed)
