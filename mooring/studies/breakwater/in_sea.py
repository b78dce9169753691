"""A breakwater in its sea: transmitted waves, and tensions at the worst level."""

import warnings
from typing import NamedTuple

import numpy as np

from ...breakwater.anchors import pretension_needed
from ...breakwater.holdings import Response
from ...breakwater.loss import GAUSSIAN
from ...breakwater.transmission import Cells, equal_cells, greatest_of, slack_share
from .breakwater import KN, THEORIES, BreakwaterError
from .curves import response
from .tides import ENDS

SEA_CELLS = 120  # with this number the height behind a circle is within 2e-4 of that with 2000
WAYS = 12  # directions of a spread sea; the height behind is within 4e-3 of that with 48
MOST_OBLIQUE = np.radians(85)


class SeaBehind(NamedTuple):
    """cells : `Cells`; heights : {curve: 4√m₀ behind, m}; transmission : {curve: (m,) |K_T|}

    deviation : standard deviations (front, back) of tensions by the design curve, N/m, or None; waves : number of
        waves
    greatest : (front, back), expected greatest amplitude; slack : fraction of cycles with a slack line at the worst
        level
    tension : (front, back), expected greatest tension at the worst level, N/m; least : smallest pretension that
        keeps both lines taut
    """

    cells: Cells
    heights: dict
    transmission: dict
    deviation: tuple | None
    waves: float
    greatest: tuple | None
    slack: tuple | None
    tension: tuple | None = None
    least: float | None = None


def sea_behind(breakwater, curves, tides, held):
    """`SeaBehind` for [Curve]; with tensions if a `Pretension` is given for the levels [Tide]"""
    spectrum = breakwater.sea.spectrum
    sea = equal_cells(spectrum, SEA_CELLS)
    amplitude, behind, ways = GAUSSIAN * sea.height / 4, {}, ways_of(breakwater, sea.omega)

    def in_sea(holding, theory, rise):
        return response_in_sea(breakwater, holding, theory, rise, sea.omega, amplitude, ways)

    for curve in curves:
        if curve.theory == THEORIES[0] or not np.any(ways):
            behind[curve.name] = in_sea(curve.holding, curve.theory, 0.0).transmission
        else:
            warnings.warn(
                f"the sea behind {curve.name} is left out: this theory covers waves along the normal only", stacklevel=2
            )
    heights = {name: 4 * float(sea.deviation(K)) for name, K in behind.items()}
    waves = breakwater.duration / spectrum.T02
    if held is None:
        return SeaBehind(sea, heights, behind, None, waves, None, None)
    deviations, shares = [], []
    for one in tides:
        curve = in_sea(*breakwater.design, one.rise)
        both = [float(sea.deviation(P)) for P in (curve.front, curve.back)]
        deviations.append(both)
        shares.append([slack_share(held.used + one.change, deviation) for deviation in both])
    deviation = tuple(np.max(deviations, axis=0))
    greatest = tuple(float(greatest_of(one, waves)) for one in deviation)
    changes, amplitudes = np.array([[one.change] for one in tides]), greatest_of(np.array(deviations), waves)
    tension = tuple(map(float, np.max(held.used + changes + amplitudes, axis=0)))
    least = max(0.0, max(pretension_needed(P.max(), -c) for P, (c,) in zip(amplitudes, changes, strict=True)))
    slack = tuple(np.max(shares, axis=0))
    return SeaBehind(sea, heights, behind, deviation, waves, greatest, slack, tension, float(least))


def response_in_sea(breakwater, holding, theory, rise, omega, amplitude, ways):
    """`Response` (m,) as moduli: root mean squares over the directions (d, m) rad of the sea's waves"""
    over = [response(breakwater, holding, theory, rise, omega, amplitude, way) for way in ways]
    return Response(*(np.sqrt(np.mean(np.abs(part) ** 2, axis=0)) for part in zip(*over, strict=True)))


def ways_of(breakwater, omega, count=WAYS, any_section=False):
    """Angles to the normal, rad, of waves with equal shares of the sea's energy at frequencies (m,) rad/s; shape (d,
    m).

    Raises BreakwaterError.
    """
    mean, spread = breakwater.sea.direction, breakwater.sea.spreading
    if not any_section and breakwater.section.shape != "rectangle" and (mean or spread is not None):
        warnings.warn(
            "waves at an angle are supported for rectangles only: the whole sea is computed along the normal",
            stacklevel=2,
        )
        return np.zeros((1, len(omega)))
    if spread is None:
        return np.full((1, len(omega)), mean)
    shares = (np.arange(count) + 0.5) / count
    ways = mean + np.array([spread.quantile(np.full(len(omega), share), omega) for share in shares])
    if np.any(abs(ways) > MOST_OBLIQUE):
        raise BreakwaterError(
            f"with sea.spreading waves travel at up to {np.degrees(abs(ways).max()):.3g}° to the normal; allowed: "
            f"{np.degrees(MOST_OBLIQUE):g}; give a narrower spreading or a smaller obliquity"
        )
    return ways


def rougher(breakwater, held, sea):
    """Message if lines carry more in the sea than in the regular waves that determine pretension and anchors"""
    if sea is None or sea.tension is None:
        return
    over = [(end, s, w) for end, s, w in zip(ENDS, sea.tension, held.greatest, strict=True) if s > w]
    if over or sea.least > held.used:
        tensions = "; ".join(f"{end} {s / KN:.4g} kN/m for {w / KN:.4g}" for end, s, w in over)
        yield (
            f"the highest of {sea.waves:.0f} waves of the sea loads the lines more than the waves of "
            f"{breakwater.waves.height:g} m, for which pretension and anchors are sized: "
            f"{tensions or 'lines go slack'}; lines that stay taut in this wave need a pretension of "
            f"{sea.least / KN:.4g} kN/m; give the highest wave as waves.height"
        )
