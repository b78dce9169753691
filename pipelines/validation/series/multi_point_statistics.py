"""Table 3.5.5.5 of the SR179 report (1982) again: floater A on twelve lines in 20 m, chain, buoy and sinker, in time.

Four calculations and one that moves the body as the report says it moved:

report    coefficients at the mean frequency, drift by half waves (section 3.5.1.2); T₀₁ = T̄/1.1 as in section 3.7.1.2
one leg   the same with the modulus of 7000 kgf/mm² on the area of one leg of the chain's links, for that of both
short     as one leg, the printed period taken for the significant one, T₀₁ = 0.81 T₁/₃
full      memory of the water, Newman's drift, wave drift damping; both legs, T₀₁ = T̄/1.1
printed   both legs and one leg: the fairleads move with the printed means and σ, phases those of the free body

The report's force is not a largest value but mean + X of eq. 3.5.1.5, as here; the largest of a record is more.
"""

from __future__ import annotations

import csv
import io
import warnings
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.bem.database import open_database
from hakobune.meshing.text_files import read_text
from hakobune.mooring.motion.line_loads import body_lines, line_work, tables_of, tensions_along
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.statistics import record_statistics

from ...common.quantities import StudyError
from ...common.units import TONF
from ...moor.study import make_study
from ...simulate.study import plan_of
from .multi_point_cases import OF_MEAN, STIFFNESS, cases, study

PRINTED = Path(__file__).parent / "multi_point_printed.csv"
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
SIGNS = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])  # of the printed mean motions: here waves go to −x, −y


class Statistics(NamedTuple):
    """Of one quantity in one calculation: m, rad or tonf, s; largest : X_1000, beyond the mean; slow : σ below SPLIT"""

    line: str
    quantity: str
    calculation: str
    T_zero: float
    T_peak: float
    epsilon: float
    mean: float
    sigma: float
    largest: float
    slow: float


def printed_rows(kind):
    """{quantity: {column: number}} of a kind of line"""
    text = read_text(PRINTED, StudyError, largest=1)
    rows = csv.DictReader(io.StringIO("\n".join(line for line in text.splitlines() if line[:1] != "#")))
    return {
        row.pop("quantity"): {key: float(value) for key, value in row.items() if key != "line"}
        for row in rows
        if row["line"] == kind
    }


def table_rows(kind, database, hours=1.0, calculations=(*CALCULATIONS, *MOVED)):
    """`Statistics` of a kind of line in every calculation; where the body is moved as printed, of the force alone"""
    db, out, memory = open_database(database), [], None
    for name in calculations:
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
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of lines and seas, told by `simulate`
            run = simulate(body, plan.weather, replace(plan.settings, **settings), 1)
        late = run.time >= 0
        for i, quantity in enumerate(QUANTITIES):
            out.append(_of(kind, quantity, name, run.motion[late][:, i]))
        out.append(_of_force(kind, name, run.tension[late]))
    return out


def _study(kind, part, period, hours):
    """Study of a kind of line with a part of the stiffness of both legs, in waves of T₀₁ s"""
    raw = study(cases(f"A-{kind}-T10")[0], hours, 1)
    raw["types"]["chain"]["axial_stiffness_tonf"] = part * STIFFNESS
    raw["waves"]["period"] = period
    return make_study(raw)


def _moved_as_printed(db, kind, system, sea):
    """(n, lines) N with the body moved as printed: means, σ; phases of the free body in a Sea"""
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
    tensions_along(lines, line_work(lines), t, motion, tension)
    return tension


def _of(kind, quantity, name, record):
    s = record_statistics(record, STEP, SPLIT, duration=1000 * PERIOD)
    return Statistics(kind, quantity, name, s.T_zero, s.T_peak, s.epsilon, s.mean, s.sigma, s.extreme, s.slow)


def _of_force(kind, name, tension):
    """Of the line whose mean + X_1000 is the largest"""
    each = [_of(kind, "force", name, record) for record in tension.T / TONF]
    return max(each, key=lambda one: one.mean + one.largest)


def table_text(rows, hours):
    """CSV of Statistics beside the printed ones"""
    out = io.StringIO()
    out.write(
        "# hakobune series multi-point: SR179 report (1982), table 3.5.5.5, floater A, 12 lines, 20 m; m, rad, tonf; "
        f"{hours:g} h in time; largest: beyond the mean, expected in 1000 mean periods\n"
    )
    table = csv.writer(out, lineterminator="\n")
    columns = Statistics._fields[3:-1]
    table.writerow([*Statistics._fields[:3], *(f"{c}{end}" for c in columns for end in ("", "_printed")), "slow",
                    "sigma_over_printed", "mean_and_largest", "mean_and_largest_printed"])  # fmt: skip
    for one in rows:
        printed = printed_rows(one.line)[one.quantity]
        pairs = [f"{v:.4g}" for column in columns for v in (getattr(one, column), printed[column])]
        both = one.mean + one.largest, printed["mean"] + printed["largest"]
        table.writerow([*one[:3], *pairs, f"{one.slow:.4g}", f"{one.sigma / printed['sigma']:.3g}",
                        *(f"{v:.4g}" for v in both)])  # fmt: skip
    return out.getvalue()


def statements(rows):
    """One line on the force of each calculation, one on its motions"""
    for one in rows:
        if one.quantity == "force":
            printed = printed_rows(one.line)["force"]
            both, theirs = one.mean + one.largest, printed["mean"] + printed["largest"]
            own = [r for r in rows if (r.line, r.calculation) == (one.line, one.calculation) and r.quantity != "force"]
            moved = [f"{r.quantity} {r.sigma / printed_rows(r.line)[r.quantity]['sigma']:.2f}" for r in own]
            yield (
                f"table 3.5.5.5, {one.line}, {one.calculation}: force {one.mean:.0f} + {one.largest:.0f} = {both:.0f} "
                f"tonf (printed {theirs:.0f}), σ {one.sigma:.0f} ({printed['sigma']:.0f})"
                f"{'; σ of motions over the print: ' * bool(moved)}{', '.join(moved)}"
            )
