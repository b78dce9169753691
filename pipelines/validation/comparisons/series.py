"""Series over depth and over length, their sectional limit, and motions: Tables 2.1.5.1-2 and 2.4.1.1."""

from __future__ import annotations

import math

import numpy as np

from .cases import CHI, CLOSE_XI, DEPTH_DRAFT, LENGTH_BEAM, XI, series_case
from .pictures import coefficient_picture, curves, ratio_picture, wave_picture
from .tables import coefficient_rows, wave_rows, write_table

LONG = max(LENGTH_BEAM)
CHECKED = 2.0, 2.0  # L/B and H/d that the panel method solves too
MOTION_LENGTH_BEAM = (1.0, 1.5, 2.0, 4.0)
MOTION_FIGURES = {0: "1-3", 30: "4-9", 45: "10-15", 60: "16-21", 90: "22-24"}
RATIO_MODES = (("Heave", "H", "33", 2), ("Sway", "S", "22", 1), ("Roll", "R", "44", 3))


class DepthSeries:
    """Six depths of water, L/B = 2"""

    name = "depth-series"
    tables = "depth-series_coefficients.csv", "depth-series_excitation.csv"
    figures = "2.1.5.3-12", "2.1.5.13-22", "2.1.5.23-46"  # of added mass, damping, force

    def cases(self, xi=None):
        shown = [series_case(2.0, depth, xi=xi or CLOSE_XI) for depth in DEPTH_DRAFT]
        return [*shown, series_case(*CHECKED, "panel", xi or XI)]

    def write(self, results, folder):
        *shown, check = results
        lines = curves([(r, _depth(r)) for r in shown], [(check, "H/d 2, panel method")])
        yield from _series(self, results, lines, folder, "L/B = 2, B/d = 5")

    def summary(self, results):
        yield _agreement(results[DEPTH_DRAFT.index(CHECKED[1])], results[-1])


class LengthSeries:
    """Five lengths, H/d = 2"""

    name = "length-series"
    tables = "length-series_coefficients.csv", "length-series_excitation.csv"
    figures = "2.1.5.47-56", "2.1.5.57-66", "2.1.5.67-90"

    def cases(self, xi=None):
        shown = [series_case(ratio, 2.0, xi=xi or CLOSE_XI) for ratio in LENGTH_BEAM]
        return [*shown, series_case(*CHECKED, "panel", xi or XI), series_case(LONG, 2.0, "strip", xi or CLOSE_XI)]

    def write(self, results, folder):
        *shown, check, strips = results
        lines = curves(
            [(r, f"L/B {r.case.columns['L_over_B']:g}") for r in shown],
            [(check, "L/B 2, panel method")],
            [(strips, f"L/B {LONG:g}, strips")],
        )
        yield from _series(self, results, lines, folder, "H/d = 2, B/d = 5")

    def summary(self, results):
        yield _agreement(results[LENGTH_BEAM.index(CHECKED[0])], results[-2])


class Sections:
    """Three-dimensional against two-dimensional coefficients, H/d = 2"""

    name = "sections"
    tables = ("sections_ratios.csv",)

    def cases(self, xi=None):
        boxes = [series_case(ratio, 2.0, xi=xi or XI) for ratio in LENGTH_BEAM]
        return [*boxes, series_case(LONG, 2.0, "strip", xi or XI)]

    def write(self, results, folder):
        *boxes, strips = results
        found = ratios(boxes, strips)
        yield write_table(folder / self.tables[0], "ratios", list(self._rows(boxes, found)))
        titles = {f"Fig. 2.1.5.{91 + i}  {name}": values for i, (name, values) in enumerate(_titled(found).items())}
        title = "Three-dimensional over two-dimensional, H/d = 2, B/d = 5, beam waves"
        yield ratio_picture(folder / "sections_ratios.png", strips.xi, LENGTH_BEAM, titles, title)

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

    def _rows(self, boxes, found):
        for i, box in enumerate(boxes):
            for j, xi in enumerate(box.xi):
                yield {**box.case.columns, "xi_B": xi, **{name: values[i, j] for name, values in found.items()}}


class Motions:
    """Motions of four lengths floating freely, H/d = 2"""

    name = "motions"
    tables = ("motions.csv",)

    def cases(self, xi=None):
        return [series_case(ratio, 2.0, xi=xi or CLOSE_XI) for ratio in MOTION_LENGTH_BEAM]

    def write(self, results, folder):
        yield write_table(folder / self.tables[0], "motions", list(wave_rows(results, "motions")))
        lines = curves([(r, f"L/B {r.case.columns['L_over_B']:g}") for r in results])
        rows = {chi: f"χ = {chi}°, figs. 2.4.3.{MOTION_FIGURES[chi]}" for chi in CHI}
        for shown, word in (("logarithm", "amplitude"), ("phase", "phase")):
            title = f"Motions, {word}, H/d = 2, B/d = 5, no viscous damping"
            yield wave_picture(folder / f"motions_{word}.png", lines, "motions", shown, title, rows)

    def summary(self, results):
        for r in results:
            size = np.abs(r.motions[:, r.heading(90), 3])
            yield (
                f"L/B {r.case.columns['L_over_B']:g}: largest roll in beam waves φ_a/kζ_a = {size.max():.3g} "
                f"at ξ_B {r.xi[size.argmax()]:.3g}"
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


def _series(series, results, lines, folder, shape):
    """The files of a series of coefficients and forces"""
    name = series.name
    yield write_table(folder / series.tables[0], "coefficients", list(coefficient_rows(results)))
    yield write_table(folder / series.tables[1], "excitation", list(wave_rows(results, "forces")))
    of_mass, of_damping, of_force = series.figures
    for letter, word, figures in (("A", "added mass", of_mass), ("B", "damping", of_damping)):
        path = folder / f"{name}_{word.replace(' ', '_')}.png"
        yield coefficient_picture(path, lines, letter, f"{word.capitalize()}, {shape}  (figs. {figures})")
    rows = {chi: f"χ = {chi}°" for chi in CHI}
    for shown in ("amplitude", "phase"):
        title = f"Exciting force, {shown}, {shape}  (figs. {of_force})"
        yield wave_picture(folder / f"{name}_force_{shown}.png", lines, "forces", shown, title, rows)


def _spoken(xi):
    """A few values each, of many how many there are"""
    if len(xi) <= 5:
        return ", ".join(f"{x:g}" for x in xi)
    return f"{xi[0]:g} to {xi[-1]:g} ({len(xi)} values)"


def _depth(results):
    depth = results.case.columns["H_over_d"]
    return "H/d ∞, panel method" if math.isinf(depth) else f"H/d {depth:g}"


def _agreement(reference, other):
    """How far two methods are apart, of the largest value of each quantity"""
    same = np.abs(reference.xi[:, None] - other.xi).argmin(axis=0)  # of the close frequencies, those of the other
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
