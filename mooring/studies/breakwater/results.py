"""Results of a breakwater: curves over period, the sea behind the breakwater, pretension over the tide, anchors."""

import warnings
from typing import NamedTuple

import numpy as np

from .anchors import Anchors, anchors_needed
from .curves import curves
from .in_sea import SeaBehind, rougher, sea_behind
from .natural import natural
from .tides import Pretension, Snapping, breaking, pretension_of, snapping, tides_of

NONE = Anchors()


class Results(NamedTuple):
    """curves : list of `Curve`; tides : list of Tide, None without lines; anchors : [AnchorRow]; warned : one line each
    front : from `pareto`; lee : from `lee`; natural : [Natural]"""

    curves: list
    tides: list | None
    pretension: Pretension | None
    sea: SeaBehind | None
    anchors: list
    warned: list
    snapping: Snapping | None = None
    front: object = None
    lee: object = None
    natural: tuple = ()


def results(breakwater, anchors=NONE):
    """`Results` of a `Breakwater`; anchors : possible anchors of its lines.  Raises ValueError."""
    period = breakwater.waves.period
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made, left_out = curves(breakwater, 2 * np.pi / period)
        periods = natural(breakwater)
        tides = tides_of(breakwater, period) if breakwater.lines is not None else None
        has_tensions = tides is not None and np.isfinite(tides[0].front)
        held = pretension_of(breakwater, tides) if has_tensions else None
        sea = sea_behind(breakwater, made, tides, held) if breakwater.sea is not None else None
        rows = anchors_needed(breakwater, anchors, held) if held is not None else []
    warned = [
        *breakwater.beside(),
        *breaking(breakwater),
        *left_out,
        *dict.fromkeys(str(w.message) for w in caught),
        *rougher(breakwater, held, sea),
    ]
    if breakwater.lines is not None and not has_tensions:
        warned.append(
            f"for holding {breakwater.design[0]} the tension of these lines is not computed, so neither "
            f"pretension nor anchors are given"
        )
    return Results(made, tides, held, sea, rows, warned, snapping(breakwater, tides, held), natural=periods)
