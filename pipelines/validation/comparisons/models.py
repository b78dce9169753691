"""The tank models M3A and M3B by every method: motions, mean drift, natural periods, roll with viscous damping.

Table 2.4.4.1 of the SR179 report (1982): L/B = 1.2 and 2, water 1.2 m deep; regular waves of 13 and 10 cm.
"""

import numpy as np

from hakobune.bem.database.natural_periods import natural_periods

from ...scene.methods import METHODS
from .cases import MODEL_CHI, MODELS, model_case
from .panels import Line, panel, wave_panels
from .report_units import unit_of_added_mass
from .tables import drift_rows, wave_rows

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
assert set(STYLES) == {name for name, method in METHODS.items() if method.fewest == 1}


class Models:
    """M3A with B/d = 10 and 20, M3B with B/d = 10, by all methods"""

    def cases(self, xi=None):
        xi = xi or XI
        cases = [model_case(model, method, xi) for model in MODELS for method in STYLES]
        return cases + [model_case(m, "contour", xi, h) for m, heights in WAVE_HEIGHTS.items() for h in heights]

    def tables(self, results):
        waves, drift = wave_rows(results, "motions"), drift_rows(results)
        return {"wave": waves, "drift": drift, "model": period_rows(_inviscid(results)), "roll": roll_rows(results)}

    def pictures(self, results):
        out, drift, roll = {}, [], []
        for model in MODELS:
            mine = [_line(r) for r in _inviscid(results) if r.case.columns["model"] == model]
            title = f"{_name(model)}, motions  (figs. {FIGURES[model]}; the pressure method has no surge, sway, yaw)"
            out[model] = (title, wave_panels(mine, "motions", False, MODEL_CHI), 6)
            drifting = [line for line in mine if line.results.drift is not None]
            for part, chi, words in ((0, 0, "D_x"), (0, 45, "D_x"), (1, 45, "D_y"), (1, 90, "D_y")):
                title = f"{_name(model)}, {words}, χ = {chi}°"
                drift.append(panel(title, drifting, _drift(part, chi), ylim=(None, None)))
        for model in WAVE_HEIGHTS:
            roll.append(panel(_name(model), _by_height(results, model), _roll, ylabel="φ_a/kζ_a"))
        out["drift"] = ("Mean drift force over ½ρgLζ_a², positive forward and to port  (figs. 2.4.4.8-11)", drift, 4)
        title = "Roll in beam waves with the viscous damping b_R of Yamashita, for deep water"
        out["roll"] = (title, roll, 2, (5, 4), False)
        return out

    def summary(self, results):
        periods = period_rows(_inviscid(results))
        for model, (measured, _) in MEASURED.items():
            found = {row["method"]: row["T_roll_s"] for row in periods if row["model"] == model}
            told = ", ".join(f"{method} {period:.3f}" for method, period in found.items() if np.isfinite(period))
            told = told or "none lies within the frequencies computed"
            yield f"{_name(model)}: roll period {measured:.2f} s measured; {told}"
        for row in roll_rows(results):
            told = f"φ_a/kζ_a = {row['X4']:.3g}, {row['roll_deg']:.3g}°" if row["wave_height_m"] else f"{row['X4']:.3g}"
            yield f"{_name(row['model'])}: roll in beam waves, ξ_B {row['xi_B']:.3g}, {_damped(row)}: {told}"


def period_rows(results):
    """[{column: number or text}] of each model and method: computed and measured natural periods of roll and pitch

    NaN where the period lies outside the frequencies computed.
    """
    return [_periods(r) for r in results]


def _periods(results):
    db = results.db
    alone, coupled = natural_periods(db.reader, coupled=False), natural_periods(db.reader)
    row = {"case": results.case.name, **{key: results.case.columns[key] for key in ("model", "method")}}
    unit = unit_of_added_mass(db)
    for d, name, measured in ((3, "roll", 0), (4, "pitch", 1)):
        inside = alone.inside[d] and coupled.inside[d]
        period, seen = alone.period[d] if inside else np.nan, MEASURED[row["model"]][measured]
        added = db.reader.held_added_mass(2 * np.pi / period)[0, d, d] / unit[d, d] if inside else np.nan
        row |= {
            f"A{d + 1}{d + 1}": added,
            f"T_{name}_s": period,
            f"T_{name}_coupled_s": coupled.period[d] if inside else np.nan,
            f"T_{name}_measured_s": seen,
            f"T_{name}_difference_percent": 100 * (period / seen - 1),
        }
    return row


def roll_rows(results):
    """[{column: number or text}]: for each model a row without viscous damping, and one row for the damping of each
    wave height

    of roll in beam waves where the former is largest
    """
    out = []
    for model in WAVE_HEIGHTS:
        top = None
        for r in _with_and_without_damping(results, model):
            size = np.abs(r.motions[:, r.heading(90), 3])
            top = int(size.argmax()) if top is None else top
            height = r.case.columns["wave_height_m"]
            angle = np.degrees(size[top] * r.k[top] * height / 2) if height else np.nan
            row = {"case": r.case.name, **r.case.columns, "xi_B": r.xi[top], "X4": size[top]}
            out.append(row | {"roll_deg": angle, "X4_largest": size.max()})
    return out


def _with_and_without_damping(results, model):
    """The contour results of a model, those without viscous damping first"""
    return [r for r in results if r.case.columns["model"] == model and r.case.columns["method"] == "contour"]


def _inviscid(results):
    return [r for r in results if not r.case.columns["wave_height_m"]]


def _line(results):
    method = results.case.columns["method"]
    return Line(results, method, STYLES[method])


def _drift(part, chi):
    return lambda r: r.drift[:, r.heading(chi), part]


def _roll(r):
    return np.abs(r.motions[:, r.heading(90), 3])


def _by_height(results, model):
    mine = _with_and_without_damping(results, model)
    colors = ("0.1", "C0", "C1", "C3")
    return [Line(r, _damped(r.case.columns), {"color": color}) for r, color in zip(mine, colors, strict=True)]


def _damped(columns):
    height = columns["wave_height_m"]
    return f"waves of {100 * height:.3g} cm" if height else "no viscous damping"


def _name(model):
    hull, ratio = model.split("_Bd")
    return f"{hull}, B/d = {ratio}"
