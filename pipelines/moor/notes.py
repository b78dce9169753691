"""Findings and notes on a mooring study, in addition to its tables."""

import numpy as np

from hakobune.bem.database.resonances import resonances
from hakobune.mooring.studies.multi_point_findings import NO_DAMPING

from ..common.resonances import resonance_lines
from ..common.units import KN
from ..printing.number import significant

ROUNDING = 1e-6  # force over the largest force, with moments per metre, below which it counts as zero
SAME = 0.01  # relative difference of forces and motions within which two methods agree


def notes(made):
    """Notes on a MultiPoint: its waves, and the most loaded line"""
    worst = int(np.argmax(made.tension))
    largest = (
        f"largest tension: {significant(made.tension[worst] / KN)} kN in {made.system.line_names[worst]}, "
        f"{_used(made, worst)}"
    )
    if any(NO_DAMPING in line for line in made.warnings):
        largest += "; a motion is at a resonance that only waves damp; viscous damping makes it smaller"
    return (*_waves(made), largest)


def resonant(made, db):
    """Findings on resonances of the free body outside the stored frequencies, for studies with waves"""
    return tuple(resonance_lines(resonances(db.bodies_reader))) if made.conditions.waves else ()


def _used(result, line):
    if np.isinf(result.system.breaking_load[line]):
        return "its utilisation is unknown, since no breaking load is given"
    used = f"{100 * result.utilisation[line]:.0f} % of its breaking load (allowable {100 * result.allowable:.0f} %)"
    found = result.extreme.solutions.get(line)
    if found is None:
        return used
    parts = zip(found.segment_tensions, found.line.segments, strict=True)
    tension, part = max(parts, key=lambda one: one[0] / one[1].breaking_load)
    return (
        f"{used}, in its segment {part.name}, {significant(tension / KN)} of {significant(part.breaking_load / KN)} kN"
    )


def _waves(made):
    """Effect of the current on the drift, and factor on the motions"""
    if not made.waves:
        return
    w, chosen = made.conditions, made.waves[made.conditions.method]
    if chosen.by_current is not None:
        yield _by_current(w.current, chosen)
    if w.motion_factor != 1:
        yield f"the lines follow {w.motion_factor:g} times these motions"


def _by_current(current, effects):
    """Effect of a current that carries the waves on their drift"""
    still, names = effects.drift - effects.by_current, ("Fx", "Fy", "Mz")
    size = np.array([*2 * [np.abs(still[:2]).max()], np.abs(still[2])])
    rounding = ROUNDING * np.abs(effects.drift[:2]).max()
    parts = [
        f"{name} {value / KN:+.4g} {unit}" + (f" ({100 * value / of:+.0f} %)" if abs(of) > SAME * most else "")
        for name, value, of, most, unit in zip(
            names, effects.by_current, still, size, ("kN", "kN", "kN m"), strict=True
        )
        if abs(value) > rounding
    ]
    return (
        f"the current of {current.speed:.3g} m/s changes the mean drift by {', '.join(parts) or 'nothing'} "
        f'relative to still water (current.waves = "still"); the waves are given in {current.waves} frequencies'
    )
