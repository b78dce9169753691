"""Series over depth and over length, their sectional limit, and motions: Tables 2.1.5.1-2 and 2.4.1.1."""

import math

import numpy as np

from ...view.plots import heading_colors
from ..picture import Curve, Panel
from .cases import CHI, CLOSE_XI, DEPTH_DRAFT, LENGTH_BEAM, XI, series_case
from .panels import coefficient_panels, lines_of, wave_panels
from .tables import coefficient_rows, wave_rows

LONG = max(LENGTH_BEAM)
CHECKED = 2.0, 2.0  # L/B and H/d that the panel method solves too
MOTION_LENGTH_BEAM = (1.0, 1.5, 2.0, 4.0)
RATIO_MODES = (("Heave", "H", "33", 2), ("Sway", "S", "22", 1), ("Roll", "R", "44", 3))


class Series:
    """Coefficients and forces of boxes"""

    def tables(self, results):
        return {"frequency": coefficient_rows(results), "wave": wave_rows(results, "forces")}

    def pictures(self, results):
        lines, words = self.lines(results), f"{self.shape}, B/d = 5  (figs. {self.figures})"
        return {
            "added_mass": (f"Added mass, {words}", coefficient_panels(lines, "A"), 5),
            "damping": (f"Damping, {words}", coefficient_panels(lines, "B"), 5),
            "force_amplitude": (f"Exciting force, {words}", wave_panels(lines, "forces", False, CHI), 6),
            "force_phase": (f"Exciting force, phase, {words}", wave_panels(lines, "forces", True, CHI), 6),
        }


class DepthSeries(Series):
    """Six depths of water, L/B = 2"""

    shape, figures = "L/B = 2", "2.1.5.3-46"

    def cases(self, xi=None):
        shown = [series_case(2.0, depth, xi=xi or CLOSE_XI) for depth in DEPTH_DRAFT]
        return [*shown, series_case(*CHECKED, "panel", xi or XI)]

    def lines(self, results):
        *shown, check = results
        return lines_of([(r, _depth(r)) for r in shown], [(check, "H/d 2, panel method")])

    def summary(self, results):
        yield _agreement(results[DEPTH_DRAFT.index(CHECKED[1])], results[-1])


class LengthSeries(Series):
    """Five lengths, H/d = 2"""

    shape, figures = "H/d = 2", "2.1.5.47-90"

    def cases(self, xi=None):
        shown = [series_case(ratio, 2.0, xi=xi or CLOSE_XI) for ratio in LENGTH_BEAM]
        return [*shown, series_case(*CHECKED, "panel", xi or XI), series_case(LONG, 2.0, "strip", xi or CLOSE_XI)]

    def lines(self, results):
        *shown, check, strips = results
        checks = [(check, "L/B 2, panel method")], [(strips, f"L/B {LONG:g}, strips")]
        return lines_of([(r, _length(r)) for r in shown], *checks)

    def summary(self, results):
        yield _agreement(results[LENGTH_BEAM.index(CHECKED[0])], results[-2])


class Sections:
    """Three-dimensional over two-dimensional coefficients, H/d = 2: M added mass, N damping, F force in beam waves"""

    def cases(self, xi=None):
        boxes = [series_case(ratio, 2.0, xi=xi or XI) for ratio in LENGTH_BEAM]
        return [*boxes, series_case(LONG, 2.0, "strip", xi or XI)]

    def tables(self, results):
        *boxes, strips = results
        found = ratios(boxes, strips)
        rows = [{"frequency": f"{box.case.name} {xi:g}", **box.case.columns, "xi_B": xi,
                 **{name: values[i, j] for name, values in found.items()}}
                for i, box in enumerate(boxes) for j, xi in enumerate(box.xi)]  # fmt: skip
        return {"frequency": rows}

    def pictures(self, results):
        *boxes, strips = results
        colors, panels = heading_colors(len(strips.xi)), []
        for i, (name, values) in enumerate(_titled(ratios(boxes, strips)).items()):
            curves = [Curve(f"ξ_B {xi:g}", LENGTH_BEAM, values[:, j], {"color": colors[j], "marker": "."})
                      for j, xi in enumerate(strips.xi)]  # fmt: skip
            axes = {"xlabel": "L/B", "xscale": "log", "xticks": LENGTH_BEAM}
            panels.append(Panel(f"Fig. 2.1.5.{91 + i}  {name}", curves, (1.0,), axes))
        return {"ratios": ("Three-dimensional over two-dimensional, H/d = 2, B/d = 5, beam waves", panels, 3)}

    def summary(self, results):
        *boxes, strips = results
        found = ratios(boxes, strips)
        chosen = (strips.xi > 0.45) & (strips.xi < 1.6)
        if not chosen.any():
            return
        at = _spoken(strips.xi[chosen])
        for name, values in _titled(found).items():
            off = np.abs(values[:, chosen] - 1).max(axis=1)
            told = ", ".join(f"{100 * o:.0f} %" for o in off)
            yield f"{name}: off 1 by at most {told} at L/B {', '.join(f'{b:g}' for b in LENGTH_BEAM)}, ξ_B {at}"


class Motions:
    """Motions of four lengths floating freely, H/d = 2"""

    def cases(self, xi=None):
        return [series_case(ratio, 2.0, xi=xi or CLOSE_XI) for ratio in MOTION_LENGTH_BEAM]

    def tables(self, results):
        return {"wave": wave_rows(results, "motions")}

    def pictures(self, results):
        lines = lines_of([(r, _length(r)) for r in results])
        words = "H/d = 2, B/d = 5, no viscous damping  (figs. 2.4.3.1-24)"
        return {"amplitude": (f"Motions, {words}", wave_panels(lines, "motions", False, CHI), 6),
                "phase": (f"Motions, phase, {words}", wave_panels(lines, "motions", True, CHI), 6)}  # fmt: skip

    def summary(self, results):
        for r in results:
            size = np.abs(r.motions[:, r.heading(90), 3])
            yield (
                f"{_length(r)}: largest roll in beam waves φ_a/kζ_a = {size.max():.3g} at ξ_B {r.xi[size.argmax()]:.3g}"
            )


def ratios(boxes, strips):
    """{M_H …, N_H …, F_H …: (boxes, n)} of heave, sway and roll in beam waves, box over strips.

    Coefficients per length are the same for strips of any length.
    """
    beam = strips.heading(90)
    out = {}
    for letter, name in (("A", "M"), ("B", "N")):
        for _, mode, pair, _ in RATIO_MODES:
            rows = [box.coefficient(letter + pair) / strips.coefficient(letter + pair) for box in boxes]
            out[f"{name}_{mode}"] = np.array(rows)
    for _, mode, _, d in RATIO_MODES:
        out[f"F_{mode}"] = np.array([np.abs(b.forces[:, beam, d] / strips.forces[:, beam, d]) for b in boxes])
    return out


def _titled(found):
    words = {mode: word for word, mode, _, _ in RATIO_MODES}
    kinds = {"M": "added mass M/m", "N": "damping N/n", "F": "force F/f"}
    return {f"{words[name[2:]]} {kinds[name[0]]}": values for name, values in found.items()}


def _spoken(xi):
    """A few values each, of many how many there are"""
    if len(xi) <= 5:
        return ", ".join(f"{x:g}" for x in xi)
    return f"{xi[0]:g} to {xi[-1]:g} ({len(xi)} values)"


def _depth(results):
    depth = results.case.columns["H_over_d"]
    return "H/d ∞, panel method" if math.isinf(depth) else f"H/d {depth:g}"


def _length(results):
    return f"L/B {results.case.columns['L_over_B']:g}"


def _agreement(reference, other):
    """Difference of two methods, over the largest value of each quantity"""
    same = np.abs(reference.xi[:, None] - other.xi).argmin(axis=0)  # nearest frequencies of the other set
    pairs = [(reference.added_mass[same], other.added_mass), (reference.damping[same], other.damping)]
    coefficients = max(_apart(a, b, (0,)) for a, b in pairs)
    forces = _apart(reference.forces[same], other.forces, (0, 1))
    return (
        f"{other.case.columns['method']} against {reference.case.columns['method']}, L/B = 2, H/d = 2: at most "
        f"{100 * coefficients:.1f} % of the largest added mass or damping, {100 * forces:.1f} % of the largest force"
    )


def _apart(a, b, axes):
    size = np.abs(a).max(axis=axes)
    apart = np.abs(a - b).max(axis=axes)
    alive = size > 1e-6 * size.max()
    return float((apart[alive] / size[alive]).max())
