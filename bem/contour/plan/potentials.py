"""Potentials at the nodes of a plan contour and their derivatives along it, for the pressure on a side.

`bem.contour.matching` needs only potentials projected onto the functions ψ of the plan.  The pressure needs κN(κ)ψ
itself, at the nodes of one frequency's contour, for every κ of the body's table. On a circle κN(κ)ψ is ψ times a
number. On a rectangle κN(κ)ψ is a polynomial on each panel of the table, and is interpolated to the panels that
resolve the waves of the frequency.

Slopes ∂/∂s run counterclockwise, along (−n₂, n₁), on the quarter x > 0, y > 0.
"""

from typing import NamedTuple

import numpy as np

from .circle import Circle
from .layers import decaying
from .maps import CLASSES
from .panels import interpolation


class Values(NamedTuple):
    """One symmetry class: m nodes of a contour, n functions, a table of c values of κ.

    maps : κN ψ outside, the last for κ → ∞, (c + 1, m, n); slope : matrix from values to their slopes, 1/m, (m, m)
    """

    maps: np.ndarray
    slope: np.ndarray


def plan_values(freq):
    """{class: `Values`} at the nodes of the contour of a `bem.contour.one_frequency.ContourFrequency`"""
    return (_on_circle if isinstance(freq.body.plan, Circle) else _on_rectangle)(freq)


def _on_circle(freq):
    plan, contour, out = freq.body.plan, freq.contour, {}
    for cls in CLASSES:
        basis = plan.basis(cls, freq.degree, contour)
        maps = basis @ freq.body.outer_maps(cls, freq.degree, freq.top)
        out[cls] = Values(maps, _trigonometric_slope(plan, cls, contour))
    return out


def _trigonometric_slope(plan, cls, contour):
    """Slope along the circle by the m lowest orders of the class, which the nodes distinguish; shape (m, m)"""
    count = len(contour.x)
    m = plan.orders(cls, 2 * count)[:count]
    turn = np.multiply.outer(np.arctan2(contour.y, contour.x), m)
    wave, slope = (np.cos(turn), -np.sin(turn)) if cls[1] == 1 else (np.sin(turn), np.cos(turn))
    return np.linalg.solve(wave.T, (slope * m / plan.radius).T).T


def _on_rectangle(freq):
    plan, contour, degree, top = freq.body.plan, freq.contour, freq.degree, freq.top
    tables, carried = _tables(freq.body, top), _resampling(plan.panels(0.0, top), contour)
    slope = _panel_slope(plan.wave_layout(freq.k, degree).panels)
    out = {}
    for cls in CLASSES:
        values = tables[cls][..., plan.subset(cls, degree, top)]
        out[cls] = Values(np.array([*(carried @ values), -plan.basis(cls, degree, contour)]), slope)
    return out


def _tables(body, degree):
    """{class: (c, q, n) κN ψ at the nodes of the table's panels}, memoised with the body"""
    if ("plan values", degree) not in body.cache:
        plan, kappa = body.plan, body.nodes(degree).kappa
        panels = plan.panels(0.0, degree)
        on_contour, half = plan.layers(panels, 3 / kappa[-1]), np.eye(len(panels.contour.x)) / 2
        bases = {cls: plan.basis(cls, degree, panels.contour) for cls in CLASSES}
        out = {cls: [] for cls in CLASSES}
        for value in kappa:
            for cls, S, D in zip(CLASSES, *on_contour.matrices(decaying(value), CLASSES), strict=True):
                out[cls].append(-np.linalg.solve(half - D, value * S @ bases[cls]))
        body.cache["plan values", degree] = {cls: np.array(maps) for cls, maps in out.items()}
    return body.cache["plan values", degree]


def _resampling(panels, contour):
    """Interpolation from values at the nodes of `panels` to values at the nodes of another contour of the rectangle;
    shape (m, q)"""
    g, out = len(panels.t), np.zeros((len(contour.x), len(panels.contour.x)))
    for end in (True, False):
        here = np.flatnonzero((contour.nx > 0.5) == end)
        own = np.flatnonzero((panels.normal[:, 0] > 0.5) == end)
        r = panels.corner[1] - contour.y[here] if end else panels.corner[0] - contour.x[here]
        panel = own[np.searchsorted(panels.start[own], r, side="right") - 1]
        t = ((r - panels.start[panel]) / panels.length[panel]) ** (1 / panels.power[panel])
        out[here[:, None], g * panel[:, None] + np.arange(g)] = interpolation(panels.t, t)
    return out


def _panel_slope(panels):
    """Slope of polynomials in the t of each panel; shape (q, q)"""
    g, out = len(panels.t), np.zeros((len(panels.contour.x),) * 2)
    along = _differentiation(panels.t)
    # counterclockwise is away from the corner on the side, towards it on the end
    sign = panels.normal[:, 0] * panels.direction[:, 1] - panels.normal[:, 1] * panels.direction[:, 0]
    for p, first in enumerate(range(0, len(out), g)):
        stretch = panels.length[p] * panels.power[p] * panels.t ** (panels.power[p] - 1)
        out[first : first + g, first : first + g] = sign[p] * along / stretch[:, None]
    return out


def _differentiation(t):
    """Matrix of the derivative, at the nodes t, of the polynomial through values there (Berrut and Trefethen 2004);
    shape (g, g)"""
    gaps = np.subtract.outer(t, t) + np.eye(len(t))
    scale = gaps.prod(axis=1)
    out = scale[:, None] / scale / gaps
    np.fill_diagonal(out, 0)
    np.fill_diagonal(out, -out.sum(axis=1))
    return out
