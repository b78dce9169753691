"""Table 3.5.5.5 of the SR179 report (1982) again: floater A on twelve lines in 20 m, chain, buoy and sinker, in time.

There are four calculations, and a fifth (`printed`) that uses the motions stated in the report:

report    coefficients at the mean frequency, drift by half waves (section 3.5.1.2); T₀₁ = T̄/1.1 as in section 3.7.1.2
one leg   the same with the modulus of 7000 kgf/mm² on the area of one leg of the chain's links, for that of both
short     as one leg, the printed period taken for the significant one, T₀₁ = 0.81 T₁/₃
full      memory of the water, Newman's drift, wave drift damping; both legs, T₀₁ = T̄/1.1
printed   both legs and one leg: the fairleads move with the printed means and σ, phases those of the free body

The report's force is not a largest value but mean + X of eq. 3.5.1.5, as here; the largest of a record is more.
"""

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np

from hakobune.mooring.motion.line_loads import body_lines, line_work, tables_of, tensions_along
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.statistics import record_statistics

from ...common.units import TONF
from ...moor.study import make_study
from ...simulate.study import plan_of
from ..beside import read_rows
from .multi_point_cases import OF_MEAN, STIFFNESS, cases, study

PRINTED = Path(__file__).parent / "multi_point_printed.csv"
STATISTICS = ("T_zero", "T_peak", "epsilon", "mean", "sigma", "largest")
QUANTITIES = ("surge", "sway", "heave", "roll", "pitch", "yaw")
PERIOD, STEP, SPLIT = 10.0, 0.5, 0.2  # s, mean; s; rad/s between slow and wave part
OF_SIGNIFICANT = 0.8101  # T₀₁ over T₁/₃
REPORT = {"memory": "constant", "slow_drift": "half-waves", "wave_drift_damping": False}
CALCULATIONS = {  # T₀₁ over the printed period, EA over that of both legs, settings
    "report": (OF_MEAN, 1.0, REPORT),
    "one leg": (OF_MEAN, 0.5, REPORT),
    "short": (OF_SIGNIFICANT, 0.5, REPORT),
    "full": (OF_MEAN, 1.0, {}),
}
MOVED = {"printed, both legs": 1.0, "printed, one leg": 0.5}
SIGNS = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])  # signs of the printed mean motions: here waves travel to −x, −y


def printed_rows(kind):
    """{quantity: {column: number}} of a kind of line"""
    rows = [row for row in read_rows(PRINTED) if row["line"] == kind]
    return {row["quantity"]: {key: float(row[key]) for key in STATISTICS} for row in rows}


def table_rows(kind, db, hours):
    """[{column: number or text}] of a kind of line in every calculation, as of `_of`; moved as printed, of the force"""
    out, memory = [], None
    for name in (*CALCULATIONS, *MOVED):
        ratio, part, settings = CALCULATIONS.get(name, (OF_MEAN, MOVED.get(name), {}))
        made = _study(kind, part, ratio * PERIOD, hours)
        hull = made.hull_of(db.dimensions)
        system = made.system(hull, db.rotation_center, db.density, db.gravity)
        plan = plan_of(made, db.reader.omega)
        if name in MOVED:
            out.append(_of_force(kind, name, _moved_as_printed(db, kind, system, plan.weather.seas[0])))
            continue
        body = moored(db, system, hull, memory=memory)
        memory = body.memory
        with warnings.catch_warnings(action="ignore"):  # warnings of lines and seas, which `simulate` reports
            run = simulate(body, plan.weather, replace(plan.settings, **settings), 1)
        late = run.time >= 0
        for i, quantity in enumerate(QUANTITIES):
            out.append(_of(kind, quantity, name, run.motion[late][:, i]))
        out.append(_of_force(kind, name, run.tension[late]))
    return out


def _study(kind, part, period, hours):
    """Study of a kind of line with a part of the stiffness of both legs, in waves of T₀₁ s"""
    raw = study(next(case for case in cases() if case.name == f"A-{kind}-T10"), hours, 1)
    raw["types"]["chain"]["axial_stiffness_tonf"] = part * STIFFNESS
    raw["waves"]["period"] = period
    return make_study(raw)


def _moved_as_printed(db, kind, system, sea):
    """Tensions with the body moved as printed, means and σ, N; shape (n, lines); phases of the free body in a Sea"""
    rows = printed_rows(kind)
    mean, sigma = (np.array([rows[q][key] for q in QUANTITIES]) for key in ("mean", "sigma"))
    reader, t = db.reader.floating(), np.arange(0.0, 3600.0, STEP)
    low, high = np.clip(sea.spectrum.quantile((1e-5, 0.999)), *reader.omega[[0, -1]])
    parts = sea.components(400, 1, low=float(low), high=float(high))
    X = reader.motions(parts.omega, [sea.direction])[:, 0]
    amplitude = X * (parts.amplitude * np.exp(1j * parts.phase))[:, None]
    motion = np.real(np.exp(-1j * np.outer(t, parts.omega)) @ amplitude)
    motion = SIGNS * mean + motion * (sigma / motion.std(axis=0))
    lines = body_lines(system, (), tables_of(system, np.zeros(6)))
    tension = np.zeros((len(t), len(system.lines)))
    tensions_along(lines, line_work(lines), t, motion[:, None], tension)
    return tension


def _of(kind, quantity, name, record):
    """{column: number or text}: m, rad or tonf, s; largest : X_1000, beyond the mean; slow : σ below SPLIT"""
    s = record_statistics(record, STEP, SPLIT, duration=1000 * PERIOD)
    ours, printed = (s.T_zero, s.T_peak, s.epsilon, s.mean, s.sigma, s.extreme), printed_rows(kind)[quantity]
    row = {"record": f"{kind} {quantity} {name}", "line": kind, "quantity": quantity, "calculation": name}
    for key, value in zip(STATISTICS, ours, strict=True):
        row |= {key: float(value), f"printed_{key}": printed[key]}
    return row | {"slow": float(s.slow), "sigma_over_printed": row["sigma"] / row["printed_sigma"]}


def _of_force(kind, name, tension):
    """Statistics of the line whose mean + X_1000 is the largest"""
    each = [_of(kind, "force", name, record) for record in tension.T / TONF]
    return max(each, key=lambda one: one["mean"] + one["largest"])


def statements(rows):
    """One line on each calculation: its force, and its motions over the printed ones"""
    for one in rows:
        if one["quantity"] == "force":
            mean, largest, theirs = one["mean"], one["largest"], one["printed_mean"] + one["printed_largest"]
            own = [
                r for r in rows if (r["line"], r["calculation"]) == (one["line"], one["calculation"]) and r is not one
            ]
            moved = ", ".join(f"{r['quantity']} {r['sigma_over_printed']:.2f}" for r in own)
            yield (
                f"table 3.5.5.5, {one['line']}, {one['calculation']}: force {mean:.0f} + {largest:.0f} = "
                f"{mean + largest:.0f} tonf (printed {theirs:.0f}), σ {one['sigma']:.0f} ({one['printed_sigma']:.0f})"
                f"{'; σ of motions over the print: ' * bool(moved)}{moved}"
            )
