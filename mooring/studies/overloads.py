"""Lines of a system beyond their breaking load: one message for each state, with the number and its limit."""

import numpy as np

from ..criteria.failing import fails
from ..lines.system.findings import LONGEST_STRAIN, beyond_tables, strains
from ..response.findings import LINES_NAMED, some


def overloads(state, curves=(), losses=None):
    """Failures and remarks on lines at rest, at offsets and after the loss of a line.

    They report tensions above the breaking load, strains above one half, missing equilibria, and elongations beyond
    the table.

    state : SystemEquilibrium; curves : OffsetCurves of it
    losses : {line: SystemEquilibrium without it, or an exception}
    """
    yield from _of_one("at rest", state.system, state.tension, state.lines.utilisation)
    for curve in curves:
        where = (
            f"with the body held at offsets up to {np.abs(curve.offset).max():g} m along "
            f"{np.degrees(curve.direction):g}°"
        )
        yield from _missed(curve)
        largest, used = np.fmax.reduce(curve.tension), np.fmax.reduce(curve.utilisation)
        yield from _of_one(where, state.system, largest, used)
    for lost, left in (losses or {}).items():
        if isinstance(left, Exception):
            yield fails(f"after the loss of {lost} there is no equilibrium: {left}")
        else:
            yield from _of_one(f"after the loss of {lost}", left.system, left.tension, left.lines.utilisation)


def _missed(curve):
    """Offsets without an equilibrium, and the reason at the nearest one"""
    if curve.missed:
        nearest = min(curve.missed, key=abs)
        yield fails(
            f"{curve.body} cannot be held at {len(curve.missed)} of {len(curve.offset)} offsets along "
            f"{np.degrees(curve.direction):g}°; the reason at the nearest, {nearest:g} m: "
            f"{curve.missed[nearest]}; or give a smaller --offset"
        )


def _of_one(where, system, tension, used):
    """tension : (n,) N, the larger of both ends; used : (n,) share of the breaking load"""
    broken = _named(system, used, 1.0)
    if broken:
        yield fails(
            f"{where}, tension in % of the breaking load: {broken}; limit 100 %, at which a line parts; give a "
            "stronger type or a longer line"
        )
    stretched = _named(system, strains(system, tension), LONGEST_STRAIN)
    if stretched:
        yield fails(
            f"{where}, stretched by: {stretched}; limit {100 * LONGEST_STRAIN:g} %, where any rope parts; "
            "give a longer line or a nearer anchor"
        )
    for text in beyond_tables(system, tension):
        yield f"{where}, {text}"


def _named(system, shares, limit):
    """Lines above a limit, with their shares; "" where there are none"""
    above = [(name, share) for name, share in zip(system.line_names, shares, strict=True) if share > limit]
    return some([f"{name} {100 * share:.4g} %" for name, share in above], LINES_NAMED)
