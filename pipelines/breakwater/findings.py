"""Failures of a breakwater, and the wanted design."""

import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.studies.breakwater.breakwater import KN

from ..printing.number import significant

JUMP = 0.25  # of K_T between neighbouring periods, that is told


def jumps(asked, found):
    """A line on each curve whose transmission jumps between neighbouring periods, at a resonance"""
    period = np.asarray(asked.waves.period)
    for curve in found.curves:
        K = np.abs(curve.response.transmission)
        if len(K) > 1 and (steps := np.abs(np.diff(K))).max() > JUMP:
            at = int(steps.argmax())
            low, high = sorted(period[at : at + 2])
            yield (
                f"{curve.name}: K_T goes from {K[at]:.3g} at {period[at]:.4g} s to {K[at + 1]:.3g} at "
                f"{period[at + 1]:.4g} s, a resonance without losses; give more waves.periods between {low:.3g} and "
                f"{high:.3g} s to see its peak; the sea behind has its own frequencies"
            )


def failures(optimisation, found):
    """Failures: lines that go slack, impossible pretensions, anchors that are too small, or no design that meets the
    target"""
    held, sea = found.pretension, found.sea
    if held is not None:
        yield from _of_pretension(held)
    if held is not None and held.given is not None and sea is not None and (sea.least or 0.0) > held.given:
        yield fails(
            f"the pretension of {_kN(held.given)} is less than the {_kN(sea.least)} that the lines need to stay "
            "taut in the sea; give more pretension"
        )
    for one in found.anchors:
        if one.utilisation is not None and one.utilisation > 1:
            size, unit = (1.0, "m apart") if one.unit == "m" else (KN, f"k{one.unit}")
            yield fails(
                f"anchor, {one.name}: {one.needed / size:.4g} {unit} are needed and {one.provided / size:.4g} "
                f"are provided, {100 * one.utilisation:.4g} % used; give a larger one"
            )
    wanted = None if optimisation is None or found.front is None else optimisation.behind
    if wanted is not None and not np.any(found.front.behind <= wanted):
        yield fails(
            f"no design transmits {wanted:g} or less; the best transmits {found.front.behind.min():.4g}; allow "
            "wider or deeper sections"
        )


def _of_pretension(held):
    if held.slack:
        where = ", ".join(f"{end} at {level} water" for level, end in held.slack)
        yield fails(
            f"lines go slack: {where}; linear tensions are not valid there, and lines snap when they become "
            f"taut again; give a pretension above {_kN(held.used)}"
        )
    if held.most is not None and held.most < held.least:
        yield fails(
            f"the least pretension that keeps lines taut, {_kN(held.least)}, exceeds the largest allowed, "
            f"{_kN(held.most)}; give stronger lines, another angle or section"
        )
    elif held.most is not None and held.most < held.used:
        yield fails(
            f"the pretension of {_kN(held.used)} exceeds {_kN(held.most)}, the most that the allowable "
            "tension permits; give less pretension, or stronger lines"
        )


def wanted(optimisation, front):
    """The design with the least tension whose transmitted wave is within the target"""
    wanted = optimisation.behind
    enough = [] if wanted is None else np.flatnonzero(front.behind <= wanted)
    if len(enough):
        i = enough[0]
        sizes = ", ".join(f"{name} {x:.4g}" for name, x in zip(front.names, front.designs[i], strict=True))
        yield (
            f"for waves of {wanted:g} or less behind the breakwater, the least tension is "
            f"{_kN(front.tension[i])}: {sizes}"
        )


def _kN(value):
    return f"{significant(value / KN)} kN/m"
