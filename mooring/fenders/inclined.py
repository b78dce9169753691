"""A fender under a face inclined by α: strips across its width w, each compressed separately.

    R_α(δ) = (1/w) ∫₀^w R(δ − s tan α) ds = [E(δ) − E(δ − a)]/a,    a = w tan α,    E(x) = ∫₀^x R,  0 for x < 0

δ is the deflection of the most compressed edge, and the fender's rated strain refers to that edge.  The unloading curve
is also the mean over strips. The strips turn together, so all strips in contact have one state of `hysteresis`. The
formula is exact for many fenders of equal height behind one stiff panel, and for a profile without stiffness along
its length. For a single cell or cone the formula is an estimate. SR179 report (1982), chapter 3.4, requires the
maker's curve of inclined compression where a side force exceeds a tenth of the axial force, but prints no such curve.
"""

import math
from dataclasses import replace

import numpy as np

from .fender import FenderError, fender_of_points

STEEPEST = 45.0  # degrees
# points of a table in addition to the knots; the energy converges at third order, with an error of 6e-5 from a tenth of
# the table on
POINTS = 201


def inclined(fender, width, angle):
    """`fender.Fender` compressed by a face inclined by `angle`, rad, over its `width`, m.  Raises FenderError."""
    if not 0 <= angle <= math.radians(STEEPEST):
        raise FenderError(
            f"{fender.name}: its face is inclined by {math.degrees(angle):g}°; allowed: 0 to {STEEPEST:g}"
        )
    if not 0 < width < np.inf:
        raise FenderError(f"{fender.name}: its width is {width:g} m; allowed: above 0, finite")
    depth = width * math.tan(angle)
    if depth < 1e-9 * fender.limit:
        return fender
    end = fender.limit + (depth if fender.overload is not None else 0.0)
    knots = fender.loading.knots
    x = np.concatenate([np.linspace(0.0, end, POINTS), knots, knots + depth])
    x = np.unique(np.round(x[x <= end], 12))
    up, down = (mean_of_strips(curve, x, depth) for curve in (fender.loading, fender.unloading))
    made = fender_of_points(
        f"{fender.name} inclined by {math.degrees(angle):g}°", fender.height, x, up, np.minimum(down, up),
        rated=fender.rated, allowable=fender.allowable, overload=fender.overload, return_length=fender.return_length,
    )  # fmt: skip
    return replace(made, limit=fender.limit)


def mean_of_strips(curve, deflection, depth):
    """Mean force, N, of a `curves.Curve` R over strips whose deflection falls evenly by up to `depth`, m;
    deflections of any shape
    """
    x = np.asarray(deflection, float)
    return (curve.integral(x) - curve.integral(np.maximum(x - depth, 0.0))) / depth
