"""Wave elevation around a body of a database in regular waves of 1 m amplitude, on a map and at places."""

import math
from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_frequencies import KOCHIN
from hakobune.bem.wave_field.around import waves_around

from ..criteria.failing import fails
from ..response.viscous import in_regular_waves

SPANS, LENGTHS = 1.5, 1.5  # half the map's width, in lengths of the body or wave lengths, whichever is more
MISSED = 0.02  # share of the far field that the sources may miss without a message


class Map(NamedTuple):
    """x, y : (n,) m; elevation : over y and x, (n, n) complex, m per m, nan in the body; around : `WavesAround`"""

    x: np.ndarray
    y: np.ndarray
    elevation: np.ndarray
    around: object


def frequency(period, omega):
    """Frequency, rad/s, from a period or a frequency, of which one is given. Raises ValueError."""
    if (period is None) == (omega is None):
        raise ValueError("give either period in s or omega in rad/s")
    value = omega if period is None else period
    if not (0 < value < np.inf):
        raise ValueError(f"{'omega' if period is None else 'period'} is {value:g}; allowed: above 0, finite")
    return omega if period is None else 2 * np.pi / period


def around_body(db, omega, beta, fixed, amplitude=None):
    """`WavesAround` of the body of a database, or of all its bodies.  Raises ValueError for waves outside the database.

    amplitude : m, wave amplitude for the viscous damping, None for the amplitude of the scene
    """
    if not math.isfinite(beta):
        raise ValueError("heading is not a number; allowed: an angle")
    fixed = fixed or bool(db.attributes.get("held"))
    db.require(*KOCHIN[fixed:])
    reader = db.bodies_reader
    if amplitude is not None and reader.viscous is not None:
        reader, _ = in_regular_waves(reader, omega, amplitude, beta)
    return waves_around(reader, omega, beta, fixed)


def half_width(around, width):
    """Half width of a map, m: from the given width, or so that the map contains body and waves. Raises ValueError."""
    span = float(np.ptp(around.sources.plan, axis=0).max())
    if width is None:
        return max(SPANS * span, LENGTHS * 2 * np.pi / around.k)
    if not span < width < 1e3 * span:
        raise ValueError(f"width is {width:g} m; allowed: from the body's {span:g} m to a thousand times this width")
    return width / 2


def mapped(around, half, points):
    """`Map` of a square about the body's middle"""
    side = np.linspace(-half, half, points)
    x, y = side + around.middle[0], side + around.middle[1]
    elevation = around.elevation(np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2))
    return Map(x, y, elevation.reshape(points, points), around)


def sides(around):
    """{name: (2,) m}, places half a body length ahead of and behind the body, along the wave direction"""
    way = np.array([math.cos(around.beta), math.sin(around.beta)])
    plan = around.sources.plan
    reach = 0.5 * float(np.ptp(plan, axis=0).max())
    return {
        name: np.round(around.middle + along * (float(np.max(plan @ along)) + reach), 6) + 0.0
        for name, along in {"before it": -way, "behind it": way}.items()
    }


def remarks(around, db, amplitude=None):
    """Remarks on neglected effects, and on assumptions behind the waves; amplitude : as in `around_body`"""
    viscous = db.bodies_reader.viscous
    if around.motion is not None and viscous is not None:
        height = 2 * (viscous.wave_amplitude if amplitude is None else amplitude)
        yield f"the body's motion includes its viscous damping in waves of {height:.3g} m"
    if db.bodies:
        yield (
            "no elevation is computed between the bodies, inside their common outline, where the far field is not valid"
        )
    if around.missed > MISSED:
        yield fails(
            f"the sources in the hull miss {around.missed:.1%} of its far field; allowed: {MISSED:.0%}; the waves "
            "near the hull are uncertain; choose waves of a lower frequency"
        )
    if around.pierces:
        yield (
            "waves that decay within a depth or a wave length of the hull are left out; the elevation may be higher "
            "there"
        )
