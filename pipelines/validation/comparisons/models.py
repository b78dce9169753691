"""The tank models M3A and M3B by every method: motions, mean drift, natural periods, roll with viscous damping.

Table 2.4.4.1 of the SR179 report (1982): L/B = 1.2 and 2, water 1.2 m deep; regular waves of 13 and 10 cm.
"""

from __future__ import annotations

import numpy as np

from hakobune.bem.database.natural_periods import natural_periods

from ...scene.methods import METHODS
from .cases import MODEL_CHI, MODELS, model_case
from .pictures import Curve, drift_picture, roll_picture, wave_picture
from .report_units import unit_of_added_mass
from .tables import drift_rows, wave_rows, write_table

XI = tuple(sorted({round(0.1 * i, 2) for i in range(3, 31)} | {round(0.05 * i, 2) for i in range(18, 37)}))
MEASURED = {"M3A_Bd10": (2.07, 1.87), "M3A_Bd20": (1.50, 1.68), "M3B_Bd10": (1.78, 1.87)}  # s, roll and pitch
WAVE_HEIGHTS = {"M3A_Bd10": (0.0325, 0.065, 0.13), "M3B_Bd10": (0.025, 0.05, 0.1)}  # m, up to those of the tests
FIGURES = {"M3A_Bd10": "2.4.4.2-3", "M3A_Bd20": "2.4.4.4", "M3B_Bd10": "2.4.4.5-7"}
STYLES = {
    "panel": {"color": "0.1", "linewidth": 2.4, "alpha": 0.35},
    "contour": {"color": "C0"},
    "pressure": {"color": "C2", "linestyle": (0, (1, 1.2))},
    "strip": {"color": "C1", "linestyle": (0, (5, 2))},
    "inverse-strip": {"color": "C3", "linestyle": (0, (5, 1.5, 1, 1.5))},
}
assert set(STYLES) == set(METHODS)


class Models:
    """M3A with B/d = 10 and 20, M3B with B/d = 10, by all methods"""

    name = "models"
    tables = "models_motions.csv", "models_drift.csv", "models_periods.csv", "models_roll.csv"

    def cases(self, xi=None):
        xi = xi or XI
        cases = [model_case(model, method, xi) for model in MODELS for method in STYLES]
        return cases + [model_case(m, "contour", xi, h) for m, heights in WAVE_HEIGHTS.items() for h in heights]

    def write(self, results, folder):
        inviscid = [r for r in results if not r.case.columns["wave_height_m"]]
        motions, drift, periods, roll = (folder / name for name in self.tables)
        yield write_table(motions, "motions", list(wave_rows(results, "motions")))
        yield write_table(drift, "drift", list(drift_rows(results)))
        yield write_table(periods, "periods", [*period_rows(inviscid)])
        yield write_table(roll, "roll", list(roll_rows(results)))
        lines = {model: [_curve(r) for r in inviscid if r.case.columns["model"] == model] for model in MODELS}
        rows = {chi: f"χ = {chi}°" for chi in MODEL_CHI}
        for model in MODELS:
            title = f"{_name(model)}, motions  (figs. {FIGURES[model]}; the pressure method has no surge, sway, yaw)"
            yield wave_picture(folder / f"models_{model}.png", lines[model], "motions", "amplitude", title, rows)
        drifting = {_name(m): [line for line in mine if line.results.drift is not None] for m, mine in lines.items()}
        parts = [(0, 0, "D_x, χ = 0°"), (0, 45, "D_x, χ = 45°"), (1, 45, "D_y, χ = 45°"), (1, 90, "D_y, χ = 90°")]
        title = "Mean drift force over ½ρgLζ_a², positive forward and to port  (figs. 2.4.4.8-11)"
        yield drift_picture(folder / "models_drift.png", drifting, title, parts)
        title = "Roll in beam waves with the viscous damping b_R of Yamashita, which is for deep water"
        yield roll_picture(folder / "models_roll.png", {_name(m): _by_height(results, m) for m in WAVE_HEIGHTS}, title)

    def summary(self, results):
        periods = list(period_rows([r for r in results if not r.case.columns["wave_height_m"]]))
        for model, (measured, _) in MEASURED.items():
            found = {row["method"]: row["T_roll"] for row in periods if row["model"] == model}
            told = ", ".join(f"{method} {period:.3f}" for method, period in found.items() if np.isfinite(period))
            told = told or "none lies within the frequencies computed"
            yield f"{_name(model)}: roll period {measured:.2f} s measured; {told}"
        for row in roll_rows(results):
            told = f"φ_a/kζ_a = {row['X4']:.3g}, {row['roll_deg']:.3g}°" if row["wave_height_m"] else f"{row['X4']:.3g}"
            yield f"{_name(row['model'])}: roll in beam waves, ξ_B {row['xi_B']:.3g}, {_damped(row)}: {told}"


def period_rows(results):
    """One row per model and method: natural periods of roll and pitch, s, beside the measured ones.

    Empty where the period lies outside the frequencies computed.
    """
    return map(_periods, results)


def _periods(results):
    db = results.db
    alone, coupled = natural_periods(db.reader, coupled=False), natural_periods(db.reader)
    row, unit = {key: results.case.columns[key] for key in ("model", "method")}, unit_of_added_mass(db)
    for d, name, measured in ((3, "roll", 0), (4, "pitch", 1)):
        inside = alone.inside[d] and coupled.inside[d]
        period, seen = alone.period[d] if inside else np.nan, MEASURED[row["model"]][measured]
        added = db.reader.held_added_mass(2 * np.pi / period)[0, d, d] / unit[d, d] if inside else np.nan
        row |= {
            f"A{d + 1}{d + 1}": added,
            f"T_{name}": period,
            f"T_{name}_coupled": coupled.period[d] if inside else np.nan,
            f"T_{name}_measured": seen,
            f"T_{name}_difference_percent": 100 * (period / seen - 1),
        }
    return row


def roll_rows(results):
    """One row per model without viscous damping and one for each wave height: roll in beam waves where the former is
    largest"""
    for model in WAVE_HEIGHTS:
        top = None
        for r in _with_and_without_damping(results, model):
            size = np.abs(r.motions[:, r.heading(90), 3])
            top = int(size.argmax()) if top is None else top
            height = r.case.columns["wave_height_m"]
            angle = np.degrees(size[top] * r.k[top] * height / 2) if height else ""
            yield {**r.case.columns, "xi_B": r.xi[top], "X4": size[top], "roll_deg": angle, "X4_largest": size.max()}


def _with_and_without_damping(results, model):
    """The contour results of a model, those without viscous damping first"""
    return [r for r in results if r.case.columns["model"] == model and r.case.columns["method"] == "contour"]


def _curve(results):
    method = results.case.columns["method"]
    return Curve(results, method, STYLES[method])


def _by_height(results, model):
    mine = _with_and_without_damping(results, model)
    colors = ("0.1", "C0", "C1", "C3")
    return [Curve(r, _damped(r.case.columns), {"color": color}) for r, color in zip(mine, colors, strict=True)]


def _damped(columns):
    height = columns["wave_height_m"]
    return f"waves of {100 * height:.3g} cm" if height else "no viscous damping"


def _name(model):
    hull, ratio = model.split("_Bd")
    return f"{hull}, B/d = {ratio}"
