"""Tensions over the tidal levels in regular waves, and the required pretension."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import wavenumber

from ...breakwater import anchors
from .curves import response, sections

BREAKING = 0.142  # Miche (1944): H = 0.142 λ tanh kh
ENDS = ("front", "back")


class Tide(NamedTuple):
    """Tensions per metre at one level, N/m; change : ΔP of the pretension
    front, back : greatest amplitudes over the periods; front_at, back_at : periods of these amplitudes, s"""

    level: str
    rise: float
    change: float
    front: float
    back: float
    front_at: float
    back_at: float


class Pretension(NamedTuple):
    """Pretension at mean level, N/m, for the worse line. given : by the study, or None; least : smallest that keeps
    both lines taut
    most : largest within the allowable tension, or None; greatest : (front, back) tension with `used`"""

    given: float | None
    used: float
    least: float
    most: float | None
    greatest: tuple
    slack: list


class Snapping(NamedTuple):
    """Slack lines in time: level, period (s), `mooring.breakwater.snap.Snap`"""

    level: str
    period: float
    found: object


def highest(breakwater, period):
    """Height of the highest unbroken wave at periods (n,), s (Miche), m; shape (n,)"""
    depth = breakwater.depth(0.0)
    k = wavenumber(2 * np.pi / period, depth, breakwater.water.gravity)
    return BREAKING * 2 * np.pi / k * np.tanh(k * depth)


def breaking(breakwater):
    """A message if waves of the study's height break, or nothing"""
    height, period = breakwater.waves.height, breakwater.waves.period
    limit = highest(breakwater, period)
    if np.any(breaks := height > limit):
        longest = period[breaks].max()
        yield (
            f"waves of {height:g} m break at {breaks.sum()} of {len(period)} periods, up to {longest:g} s, where the "
            f"highest possible wave is {limit[breaks].max():.3g} m (Miche); these periods are left out of the tensions"
        )


def unbroken(breakwater, period):
    """The periods among (n,) s at which a wave of the study's height does not break"""
    return period[breakwater.waves.height <= highest(breakwater, period)]


def tides_of(breakwater, period):
    """[Tide] of all levels"""
    height, stands = breakwater.waves.height, unbroken(breakwater, period)
    if not len(stands):
        raise ValueError(f"waves.height is {height:g} m, and such waves break at every period; give lower waves")
    made = []
    for level, rise in breakwater.levels:
        curve = response(breakwater, *breakwater.design, rise, 2 * np.pi / stands)
        tensions = [abs(P) * height / 2 for P in (curve.front, curve.back)]
        worst = [int(np.argmax(P)) for P in tensions]
        front, back = (P[i] for P, i in zip(tensions, worst, strict=True))
        made.append(Tide(level, rise, breakwater.tide_tension(rise), front, back, *stands[worst]))
    return made


def pretension_of(breakwater, tides):
    """`Pretension` required by the [Tide]"""
    lines = breakwater.lines
    least = max(0.0, max(anchors.pretension_needed(max(one.front, one.back), -one.change) for one in tides))
    given = breakwater.pretension(0.0)
    used = least if given is None else given
    greatest = tuple(max(used + one.change + getattr(one, end) for one in tides) for end in ENDS)
    most = None if lines.allowable is None else lines.allowable / lines.spacing - (max(greatest) - used)
    slack = [
        (one.level, end)
        for one in tides
        for end in ENDS
        if given is not None and anchors.goes_slack(given, -one.change, getattr(one, end))
    ]
    return Pretension(given, used, least, most, greatest, slack)


def snapping(breakwater, tides, held):
    """`Snapping` at the first level where a line goes slack, at the period of its largest tension; None if none does"""
    if held is None or not held.slack or breakwater.lines.stretch is None:
        return None
    from ...breakwater.snap import frequencies, snap

    level, end = held.slack[0]
    tide = next(one for one in tides if one.level == level)
    period, body = getattr(tide, f"{end}_at"), breakwater.taut(tide.rise)
    omega = 2 * np.pi / period
    waters = sections(breakwater, breakwater.wetted(tide.rise), tide.rise, frequencies(body, omega))
    found = snap(body, waters, breakwater.lines.stretch, omega, breakwater.waves.height / 2)
    return Snapping(level, period, found)
