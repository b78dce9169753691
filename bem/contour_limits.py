"""Added mass of a vertical-sided body at the limits of the frequency, per unit density, by domain decomposition.

ω → ∞    φ = 0 on the surface:    Zₙ = cos kₙζ,  kₙ = (n − ½)π/h
ω → 0    a rigid lid:             Zₙ = cos kₙζ,  kₙ = nπ/h,  and Z₀ = 1 with Laplace's equation in plan
"""

from __future__ import annotations

import numpy as np

from .contour_frequency import combined
from .contour_system import solved
from .modes import class_of
from .plan import CLASSES


def infinite_frequency(body):
    """(6, 6) m³, m⁴, m⁵"""
    out = np.zeros((6, 6))
    for cls in CLASSES:
        r = len(body.profiles.mean_rows)
        _fill(body, out, cls, -0.5, np.zeros((r, r)), lambda n: np.zeros((n, n)))
    return out


def zero_frequency(body):
    """(6, 6) m³, m⁴, m⁵; heave, which moves water through ever wider circles, is infinite"""
    out, draft, degree = np.zeros((6, 6)), body.draft, body.plan.degree(0.0, body.tolerance)
    rows = body.profiles.combinations @ np.concatenate([body.profiles.gap.mean, [draft, -(draft**2) / 2]])
    for cls in CLASSES[1:]:
        laplace = body.laplace(degree)[cls][0]
        _fill(body, out, cls, 0.0, np.multiply.outer(rows, rows) / body.depth, lambda n, map_=laplace: map_)
    out[2, 2] = np.inf
    return out


def _fill(body, out, cls, shift, rows, single):
    """Added mass of one class, kₙ = (n + shift)π/h and a mode of its own with `rows` and map `single`"""
    gap, degree = body.profiles.gap, body.plan.degree(0.0, body.tolerance)
    count = gap.mode_count(0.0, body.accuracy.modes, body.plan.scale)
    wavenumbers = (np.arange(1, count + 1) + shift) * np.pi / body.depth
    weights = body.collapsed(degree, gap.outer_rows(wavenumbers), wavenumbers, body.depth / 2, gap.outer_decays)
    maps = body.maps(degree)[cls][0]
    system = body.system(cls, degree, combined(weights, maps, rows, single(maps.shape[1])))
    dofs = [d for d in range(6) if class_of(d, "xy") == cls]
    none = np.zeros((len(body.profiles.mean), maps.shape[1], 0))
    flow = solved(system, [body.motion(d, degree) for d in dofs], none)
    out[np.ix_(dofs, dofs)] = -body.loads(system, flow, degree, dofs, none[-2:]).real
