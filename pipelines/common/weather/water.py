"""Tables of water and of regular waves that studies share."""

from __future__ import annotations

from ..quantities import Table


class DepthTable(Table):
    """Water of the place

    depth : m
    """

    depth: float


class WaterTable(DepthTable):
    """Water of the place"""

    density: float = 1025.0
    gravity: float = 9.80665


class WaveTable(Table):
    """One regular wave

    height : m, crest to trough
    period : s
    """

    height: float
    period: float
    direction_deg: float | None = None
    incidence_deg: float | None = None
