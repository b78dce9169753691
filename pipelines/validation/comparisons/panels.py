"""Panels of comparisons: curves over ξ_B of cases."""

from typing import NamedTuple

import numpy as np

from hakobune.bem import DOFS

from ...view.plots import heading_colors
from ..picture import Curve, Panel
from .report_units import PAIRS, QUIET, Results, lag

SPAN = 1e2  # ratio of positive values from which on an axis is logarithmic
XI = "ξ_B = ω²B/2g"
UNITS = {"forces": ("F1", "F2", "F3", "F4", "F5", "F6"),
         "motions": ("x_a/ζ_a", "y_a/ζ_a", "z_a/ζ_a", "φ_a/kζ_a", "θ_a/kζ_a", "ψ_a/kζ_a")}  # fmt: skip


class Line(NamedTuple):
    """A case in a picture; style : style of matplotlib's `plot`"""

    results: Results
    label: str
    style: dict


def lines_of(shown, checks=(), strips=()):
    """`Line`s of (results, label): `shown` in colours from dark to light, `checks` as points, `strips` dashed"""
    return [
        *(Line(*one, {"color": color}) for one, color in zip(shown, heading_colors(len(shown)), strict=True)),
        *(Line(*one, {"color": "C3", "marker": "x", "linestyle": ""}) for one in checks),
        *(Line(*one, {"color": "0.2", "linestyle": (0, (4, 2))}) for one in strips),
    ]


def panel(title, lines, value, **axes):
    """`Panel` of value(results), (n,), over ξ_B; lines whose values are all NaN or 0 are omitted"""
    curves = [Curve(line.label, line.results.xi, value(line.results), line.style) for line in lines]
    curves = [curve for curve in curves if np.any(np.nan_to_num(curve.y))]
    values = np.concatenate([curve.y for curve in curves]) if curves else np.ones(1)
    if "ylim" not in axes and np.nanmin(values) > 0:
        wide = np.nanmax(values) > SPAN * np.nanmin(values)
        axes |= {"yscale": "log"} if wide else {"ylim": (0, None)}
    return Panel(title if curves else f"{title}: zero by symmetry", curves, axes={"xlabel": XI, **axes})


def coefficient_panels(lines, letter):
    """Ten coefficients A or B"""
    largest = {p: max(np.abs(line.results.coefficient(letter + p)).max() for line in lines) for p in PAIRS}

    def value(pair):
        def of(r):
            found = r.coefficient(letter + pair)
            return np.where(np.abs(found).max() > QUIET * largest[pair], found, np.nan)

        return of

    return [panel(f"{letter}{pair}", lines, value(pair)) for pair in PAIRS]


def wave_panels(lines, kind, phase, headings):
    """Forces or motions, amplitudes or phases: a row for each χ, a column for each mode"""
    axes = {"ylim": (-190, 190), "yticks": (-180, -90, 0, 90, 180)} if phase else {}

    def value(chi, mode):
        def of(r):
            heading = r.heading(chi)
            values = getattr(r, kind)[:, heading, mode]
            found = _unbroken(lag(values)) if phase else np.abs(values)
            return np.where(r.driven(kind)[heading, mode], found, np.nan)

        return of

    return [
        panel(f"{DOFS[mode]}, {'ε, °' if phase else UNITS[kind][mode]}, χ = {chi}°", lines, value(chi, mode), **axes)
        for chi in headings
        for mode in range(6)
    ]


def _unbroken(degrees):
    """The curve without the vertical strokes where a phase crosses 180°"""
    degrees = degrees.copy()
    degrees[1:][np.abs(np.diff(degrees)) > 180] = np.nan
    return degrees
