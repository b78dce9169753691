"""Fatigue of the lines over the service life, of the tensions that the load cases have in time.

    D = Σ_cases p t_life / t_record  Σ nᵢ / N(sᵢ)       rainflow cycles of the kept records, Miner's sum

The whole lines alone: a state with `share` of the time has it in equal parts in all its directions and levels.  Asked
is factor · D ≤ 1.  The record is that of the fairlead, in the section of each type with the curve's own reference.
"""

from __future__ import annotations

import numpy as np

from hakobune.mooring.criteria.fatigue import YEAR, curves, miner
from hakobune.mooring.criteria.rules import OWN, Criterion
from hakobune.mooring.criteria.strength import kind_and_size
from hakobune.mooring.criteria.verdict import Judged, Use

QUANTITY = "factor x fatigue damage over the service life"


def fatigue(read, ran):
    """Judged of the damage of the lines of a Read project by its Ran cases; None where no fatigue is asked for"""
    if read.project.fatigue is None:
        return None
    curve, own = curves()[read.project.fatigue.curve], read.project.fatigue
    criterion = Criterion(
        OWN, "", QUANTITY, "at most", 1.0, None, "-", "any", "intact", "dynamic", curve.name, "", 1.0,
        f"rainflow and Miner's sum, curve {curve.name} ({curve.source}), factor {own.factor:g}", "read",
    )  # fmt: skip
    total, parts = 0.0, []
    for state in read.project.states:
        cases = [one for one in ran if one.case.state == state.name and not one.case.lost and one.case.factor == 1]
        for one in cases if state.share else ():
            if one.runs is None:
                return Judged(criterion, (), f"{one.case.name} could not be run")
            damage = own.factor * state.share / len(cases) * _damage(read, one, curve)
            parts.append((one.case.name, damage))
            total = total + damage
    worst = int(np.argmax(total))
    name = max(parts, key=lambda part: part[1][worst])[0]
    return Judged(criterion, (Use(name, one.numbers.names[worst], float(total[worst]), float(total[worst])),))


def _damage(read, one, curve):
    """(n,) of the lines over the service life, had it this weather alone"""
    life = read.project.project.service_life * YEAR
    return life * np.array(
        [
            max(_rate(cycles, read, name, curve, load) for name in types)
            for cycles, types, load in zip(one.runs["cycles"], one.numbers.types, one.numbers.breaking, strict=True)
        ]
    )


def _rate(cycles, read, name, curve, breaking_load):
    """Damage a second of (duration s, Cycles)"""
    duration, found = cycles
    diameter = kind_and_size(read.study["types"][name]["catalogue"])[1]
    return miner(found, curve, diameter, breaking_load) / duration
