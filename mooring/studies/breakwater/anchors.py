"""Anchors required for the greatest tension of a breakwater's lines, compared with the given anchors."""

import warnings
from typing import NamedTuple

import numpy as np

from ...breakwater import anchors as sizes
from .breakwater import KN, BreakwaterError
from .curves import response
from .tides import ENDS, unbroken

HIGH_SINKER = 0.5  # height of a sinker, over the water under the keel, above which it moves the lower line ends


class Sinker(NamedTuple):
    """A block on the bed. friction : coefficient; width : m; unit_weight : N/m³
    weight : submerged weight of a given block, N/m, or None
    lifted : whether the block also carries a line's upward pull
    """

    friction: float
    width: float
    unit_weight: float
    weight: float | None = None
    lifted: bool = False


class Pile(NamedTuple):
    """diameter, length : m; cohesion : N/m²; safety : factor of safety; spacing : distance between given piles, m,
    or None
    """

    diameter: float
    length: float
    cohesion: float
    safety: float = sizes.PILE_SAFETY
    spacing: float | None = None


class Holding(NamedTuple):
    """Anchors of a known capacity, N along the line, every `spacing` m, with a factor of safety"""

    capacity: float
    spacing: float
    safety: float = 2.0


class Anchors(NamedTuple):
    """Anchors of any of these kinds; common_sinker : one sinker under both lines"""

    sinker: Sinker | None = None
    common_sinker: Sinker | None = None
    pile: Pile | None = None
    holding: Holding | None = None


class AnchorRow(NamedTuple):
    """needed, provided : in `unit`; utilisation : needed over provided, None where nothing is provided"""

    name: str
    needed: float
    unit: str
    note: str = ""
    provided: float | None = None
    utilisation: float | None = None


def anchors_needed(breakwater, asked, held):
    """[AnchorRow] of `Anchors` for the greatest tensions of a `Pretension`.  Raises ValueError."""
    angle, rows = breakwater.angle, []
    if angle >= np.pi / 2 and any((asked.sinker, asked.common_sinker, asked.pile)):
        angle = np.pi - angle
    for end, tension in zip(ENDS, held.greatest, strict=True):
        if asked.sinker is not None:
            weight = sizes.sinker(tension, angle, asked.sinker.friction, asked.sinker.lifted)
            _check_not_lifted(weight, tension * np.sin(angle))
            rows.append(_sinker_row(breakwater, f"sinker, {end}", asked.sinker, weight))
        if asked.pile is not None:
            rows.append(_pile_row(end, asked.pile, tension, angle))
        if asked.holding is not None:
            one = asked.holding
            pull, capacity = tension * one.spacing, one.capacity / one.safety
            note = f"every {one.spacing:g} m"
            rows.append(AnchorRow(f"anchor, {end}", pull, "N", note, capacity, pull / capacity))
    if asked.common_sinker is not None:
        rows.append(_common_row(breakwater, asked.common_sinker))
    return rows


def _check_not_lifted(weight, pull):
    if weight < pull:
        raise BreakwaterError(
            f"anchors.sinker: the line pulls up with {pull / KN:.4g} kN/m, more than the weight of {weight / KN:.4g} "
            "kN/m that keeps the sinker from sliding; give lifted = true"
        )


def _sinker_row(breakwater, name, sinker, weight, note=""):
    height = sizes.sinker_height(weight, sinker.width, sinker.unit_weight)
    room = breakwater.depth(0.0) - breakwater.draft(0.0)
    if height > HIGH_SINKER * room:
        wide = sinker.width * height / (HIGH_SINKER * room)
        warnings.warn(
            f"{name} is {height:.3g} m high, but the lines are computed from the bed and there are only {room:.3g} m "
            f"under the keel; allowed: up to {HIGH_SINKER * room:.3g} m; give a width of {wide:.3g} m",
            stacklevel=2,
        )
    note = f"{height:.3g} m high, {sinker.width:g} m wide{note}"
    return AnchorRow(name, weight, "N/m", note, sinker.weight, sinker.weight and weight / sinker.weight)


def _pile_row(end, pile, tension, angle):
    capacity = sizes.pile_capacity(np.pi * pile.diameter, pile.length, pile.cohesion, pile.safety)
    spacing = sizes.pile_spacing(capacity, tension, angle)
    note = f"each holds {capacity / KN:.4g} kN"
    return AnchorRow(f"piles, {end}", spacing, "m", note, pile.spacing, pile.spacing and pile.spacing / spacing)


def _common_row(breakwater, sinker):
    """One sinker under both lines: the greatest weight over periods and levels"""
    omega = 2 * np.pi / unbroken(breakwater, breakwater.waves.period)
    greatest, c, s = 0.0, np.cos(breakwater.angle), np.sin(breakwater.angle)
    for _, rise in breakwater.levels:
        curve = response(breakwater, *breakwater.design, rise, omega)
        across, up = (curve.front - curve.back) * c, (curve.front + curve.back) * s
        weight = sizes.common_sinker(across, up, sinker.friction) * breakwater.waves.height / 2
        buoyancy = 2 * s * (breakwater.pretension(rise) or 0.0)
        greatest = max(greatest, weight.max() + buoyancy)
    note = ", which also hold the body's buoyancy" if breakwater.body is not None else ", without the body's buoyancy"
    return _sinker_row(breakwater, "sinker of both lines", sinker, greatest, note)
