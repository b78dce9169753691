"""Added mass of a vertical-sided body at zero and at infinite frequency, per unit density, by domain decomposition.

ω → ∞    φ = 0 on the surface:    Zₙ = cos kₙζ,  kₙ = (n − ½)π/h
ω → 0    a rigid lid:             Zₙ = cos kₙζ,  kₙ = nπ/h,  and Z₀ = 1 with Laplace's equation in plan
"""

import numpy as np

from ..modes import class_of
from .matching import loads, solved
from .one_frequency import combined
from .plan.maps import CLASSES


def infinite_frequency(body):
    """Added mass at infinite frequency over density, m³, m⁴, m⁵; shape (6, 6)"""
    out = np.zeros((6, 6))
    for cls in CLASSES:
        r = len(body.profiles.combinations)
        _fill(body, out, cls, -0.5, np.zeros((r, r)), np.zeros((1, 1)))
    return out


def zero_frequency(body):
    """Added mass at zero frequency over density, m³, m⁴, m⁵; shape (6, 6); heave is infinite, because its net flux
    acts like a source in plan"""
    out, draft = np.zeros((6, 6)), body.draft
    rows = body.profiles.combinations @ np.concatenate([body.profiles.gap.mean, [draft, -(draft**2) / 2]])
    degree, top = _degrees(body)
    for cls in CLASSES[1:]:
        own = body.plan.subset(cls, degree, top)
        laplace = body.laplace(top)[cls][0][own[:, None], own]
        _fill(body, out, cls, 0.0, np.multiply.outer(rows, rows) / body.depth, laplace)
    out[2, 2] = np.inf if body.depth > draft else 0.0
    return out


def _degrees(body):
    """Degrees of the functions on the plan and of their tables"""
    return tuple(body.plan.degree(k, body.tolerance) for k in (0.0, body.plan.table_wavenumber(0.0)))


def _fill(body, out, cls, shift, rows, single):
    """Set the added mass of one class in `out`: modes kₙ = (n + shift)π/h and one more with `rows` and map `single`"""
    gap, (degree, top) = body.profiles.gap, _degrees(body)
    wavenumbers = (np.arange(1, body.mode_count(0.0) + 1) + shift) * np.pi / body.depth
    weights = body.contracted(top, gap.outer_rows(wavenumbers), wavenumbers, body.depth / 2, gap.outer_decays)
    maps = body.outer_maps(cls, degree, top)
    size = len(rows) * maps.shape[1]
    outside = combined(weights, maps, rows, np.broadcast_to(single, maps.shape[1:])).reshape(size, size)
    dofs = [d for d in range(6) if class_of(d, "xy") == cls]
    fixed_terms, none = body.fixed_terms(cls, degree, top, tuple(dofs)), np.zeros((size, 0))
    out[np.ix_(dofs, dofs)] = -loads(fixed_terms, outside, solved(fixed_terms, outside, none), none).real
