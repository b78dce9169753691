"""The smallest change that passes: the next sizes of chain or rope, laid and run again in the cases that govern.

Only types with a catalogue name are changed, all of them by one size at a time.  A larger size is heavier, so the way
the lines lie and their stiffness change with it: each size is laid anew, and every criterion is judged again in the
cases that governed one.
"""

from __future__ import annotations

from copy import deepcopy
from typing import NamedTuple

import msgspec

from mooring.criteria.strength import larger_sizes
from mooring.criteria.verdict import judge

from .cases import intact_cases, without_line
from .running import Ran, base_of, factors_of, grouped, judged_case, key_of, repeated

MOST = 8  # sizes that are tried


class Advice(NamedTuple):
    """changed : {type: name of the catalogue}; utilisation : the largest with it; passes : whether all are met then"""

    changed: dict
    utilisation: float
    passes: bool


def advise(read, judged, cases, others, paths, folder, step):
    """Advice where criteria are not met, None where all are or no type has a catalogue name.

    judged : of all criteria; cases : {name: LoadCase} of all that ran; others : quantities of the project
    paths : {level: database}; step : called with the number of the size, how many there may be and its name
    """
    kinds = {name: table["catalogue"] for name, table in read.study.get("types", {}).items() if "catalogue" in table}
    if not kinds or all(one.met is not False for one in judged):
        return None
    governing = [key_of(cases[one.governing.case]) for one in judged if one.governing is not None]
    criteria = [one.criterion for one in judged if one.governing is not None]
    best = None
    for number, names in enumerate(zip(*(larger_sizes(kind, MOST) for kind in kinds.values()), strict=False), 1):
        changed = dict(zip(kinds, names, strict=True))
        step(number, MOST, ", ".join(names))
        try:
            larger = _with_types(read, changed)
            used = _utilisation(larger, criteria, set(governing), others, paths, folder / str(number))
        except ValueError:  # it does not reach, or has no equilibrium: no way out
            continue
        if best is None or used < best.utilisation:
            best = Advice(changed, used, used <= 1)
        if best.passes:
            return best
    return best


def _with_types(read, changed):
    study = deepcopy(read.study)
    for name, kind in changed.items():
        study["types"][name]["catalogue"] = kind
    return msgspec.structs.replace(read, study=study)


def _utilisation(read, criteria, governing, others, paths, folder):
    """The largest of all criteria in the cases of the keys `governing`"""
    folder.mkdir(parents=True, exist_ok=True)
    factors, ran = factors_of(read), []
    for case in intact_cases(read, base_of(read, paths), repeated(read, factors)):
        for lost in {key[-1] for key in governing if key[:-1] == key_of(case)[:-1]}:
            one = without_line(read, case, lost) if lost else case
            path = folder / f"{len(ran)}.h5"
            ran.append(Ran(one, path, *read.kind.run(one.study, paths[one.level], path, factors)))
    found = judge(criteria, [judged_case(read, group, others) for group in grouped(ran).values()])
    return max(one.governing.utilisation for one in found if one.governing is not None)
