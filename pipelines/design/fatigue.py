"""Fatigue of the lines over the service life, from the tensions of the load cases in time.

    D = Σ_cases p t_life / t_record  Σ nᵢ / N(sᵢ)       rainflow cycles of the kept records, Miner's sum

Lines that wear are computed with half of their wear, which is their mean diameter over time, and with the breaking
load of this diameter. Only cases with intact lines count.  The `share` of the time of a state is divided equally
among its directions and levels.  The criterion is factor · D ≤ 1.  The record is taken at the fairlead, with the
reference strength of the curve for the section of each type.

No 90 % interval is computed if fewer cycles than `mooring.motion.extremes.FEWEST` cause the damage, as in a run with
few slow oscillations; nor for a regular wave, whose cycles are not those of a sea.
"""

import numpy as np

from hakobune.mooring.criteria.fatigue import YEAR, Curve, curves, miner
from hakobune.mooring.criteria.rules import Criterion
from hakobune.mooring.criteria.strength import kind_and_size, worn_breaking_load
from hakobune.mooring.criteria.verdict import Judged, Use
from hakobune.mooring.motion.extremes import FEWEST

from .project import worn_diameters

QUANTITY = "factor x fatigue damage over the service life"


def fatigue(read, ran):
    """Judged line damage of a Read project from its Ran cases; None without [fatigue]"""
    if read.project.fatigue is None:
        return None
    own = read.project.fatigue
    curve = curve_of(own)
    words = f"{wear_words(read)}; the share of a state is divided equally among its directions and levels"
    criterion = Criterion(
        "fatigue", "", QUANTITY, "at most", 1.0, None, "-", "any", "intact", "dynamic", curve.name, "", 1.0,
        f"rainflow and Miner's sum, curve {curve.name} ({curve.source}), factor {own.factor:g}; {words}", "read",
    )  # fmt: skip
    total, squares, parts = 0.0, 0.0, []
    for state in read.project.states:
        if state.share and _is_regular(read, state):
            return Judged(
                criterion,
                (),
                f"{state.name} has a regular wave, and its cycles do not represent a sea; give irregular waves",
            )
        cases = [one for one in ran if one.case.state == state.name and not one.case.lost and one.case.factor == 1]
        for one in cases if state.share else ():
            if one.runs is None:
                return Judged(criterion, (), f"{one.case.name} could not be run")
            each = _damage(read, one, curve)
            damage, square = (own.factor * state.share / len(cases)) ** np.array([[1], [2]]) * each
            parts.append((one.case.name, damage))
            total, squares = total + damage, squares + square
    worst = int(np.argmax(total))
    carrying = total[worst] ** 2 / squares[worst] if squares[worst] > 0 else np.inf
    if carrying < FEWEST * (1 - 1e-9):
        return Judged(
            criterion, (), f"the damage of {one.numbers.names[worst]} is due to only {carrying:.1f} cycles of the "
            f"runs; a 90 % interval needs {FEWEST} cycles; give a longer simulation.duration_hours or "
            f"more seeds",
        )  # fmt: skip
    name = max(parts, key=lambda part: part[1][worst])[0]
    if total[worst] > 0:
        years = own.factor * read.project.project.service_life / total[worst]
        criterion = criterion._replace(source=f"life {years:.3g} years without the factor; {criterion.source}")
    return Judged(criterion, (Use(name, one.numbers.names[worst], float(total[worst]), float(total[worst])),))


def wear_words(read):
    """Words on the diameters with which fatigue is computed"""
    lost = {name: wear_of(read, name) for name in read.study.get("types", {})}
    if not any(lost.values()):
        return "diameters of new lines, as no wear is given"
    sizes = {name: kind_and_size(read.study["types"][name]["catalogue"])[1] for name, loss in lost.items() if loss}
    worn = ", ".join(f"{name} {size - lost[name] / 2:.4g} of {size:g} mm" for name, size in sizes.items())
    return f"diameters less half of the wear, their mean over the service life: {worn}"


def wear_of(read, name):
    """Loss of diameter of a type, mm, by [wear] or by its corrosion_mm; 0 without wear"""
    worn = worn_diameters(read.project, read.study)
    return worn[name][1] if name in worn else read.study["types"][name].get("corrosion_mm") or 0.0


def curve_of(table):
    """The Curve of a FatigueTable: from the table of curves, or as given by the user"""
    if table.curve is not None:
        return curves()[table.curve]
    name = f"{table.constant:.4g} s^−{table.exponent:g}"
    return Curve(name, table.basis, table.exponent, table.constant, chain=table.chain)


def _is_regular(read, state):
    """Whether the waves of a state are one regular wave"""
    method = read.study.get("waves", {}).get("method") if state.waves is None else state.waves.method
    return method == "regular_wave"


def _damage(read, one, curve):
    """Damage of the lines over the service life in this weather alone, and the sum of its squares over cycles; shape
    (2, n)"""
    life = read.project.project.service_life * YEAR
    found = [
        max(_rate(cycles, read, name, curve, load) for name in types)
        for cycles, types, load in zip(one.runs["cycles"], one.numbers.types, one.numbers.breaking, strict=True)
    ]
    return np.array(found).T * [[life], [life**2]]


def _rate(cycles, read, name, curve, breaking_load):
    """Damage per second of (duration s, Cycles), and the sum of its squares over cycles"""
    duration, found = cycles
    diameter, half = kind_and_size(read.study["types"][name]["catalogue"])[1], 0.5 * wear_of(read, name)
    left = worn_breaking_load(breaking_load, diameter, half, 1.0)
    damage, squares = miner(found, curve, diameter - half, left)
    return damage / duration, squares / duration**2
