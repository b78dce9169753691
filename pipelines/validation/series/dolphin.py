"""`hakobune series dolphin`: floaters A and B between dolphins with fenders, by the design spectrum method and in time.

SR179 report (1982), section 3.7.5: fenders of 700 tonf/m (C2000H, floater A) and 1200 tonf/m (C3000H, B), ISSC spectra,
waves, wind and current on the beam; strains of at most 10 % under the steady loads and 35 % in all.  Fenders stand on
two dolphins at a quarter of the length from each end, `fenders` on each; the report gives no layout.  With a quay
behind them the rows of the design spectrum method stand before it, by the far field, those of open water beside.
"""

from __future__ import annotations

import csv
import io
import math
from itertools import product
from typing import NamedTuple

import numpy as np

from hakobune.bem.database import open_database
from hakobune.bem.wave_field.before_wall import least_gap
from hakobune.meshing.whole_files import write_whole
from hakobune.mooring.dolphins.design_spectrum import DolphinError, Dolphins, beam_of, limit_height, strains
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.fenders.families import fender_of_family
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Wind
from hakobune.mooring.studies.steady_loads import steady_loads, with_coefficients

from ...common.outputs import check_folder
from ...common.picture import save
from ...common.quantities import StudyError
from ...common.units import KNOT, TONF
from ...moor.quay import REFUSED, by_far_field
from ...scene.scene import make_scene
from . import dolphin_simulated
from .databases import whole_database
from .single_point_cases import FLOATERS

DEPTHS = {"A": (12.0, 14.0, 20.0, 50.0), "B": (40.0, 100.0)}
FENDERS = {"A": (2.0, 700.0), "B": (3.0, 1200.0)}  # height m, tonf/m
GYRATION = {"A": [15.55, 29.44, 32.28], "B": [30.55, 58.59, 64.55]}
COUNTS = (1, 2, 3, 4, 5)
PERIODS, HEIGHTS = (6.0, 8.0, 10.0), (0.5, 1.0, 1.5, 2.0, 3.0)
WEATHER = ((25.0, 1.5), (50.0, 3.0))  # wind m/s, current kn
FREEBOARD = 10.0
FARTHEST = 1000.0  # m, of a quay behind
PRINTED = {("A", 1): 0.35, ("A", 3): 0.9, ("B", 1): 1.5, ("B", 3): 1.05}  # m, in the text; at 10 s, presumably
BEAM = 0.5 * math.pi


class Row(NamedTuple):
    """m, tonf; strains over the height; limit : significant height m; curve : by the equivalent spring of a cell"""

    floater: str
    depth_m: float
    fenders: int
    period_s: float
    wind_m_s: float
    current_kn: float
    height_m: float
    steady_tonf: float
    drift_tonf: float
    static_strain: float
    sigma_m: float
    strain: float
    limit_m: float
    curve_strain: float


def make_series(folder, fresh, gap=None):
    """Exit status 0.  gap : m from the hull to a quay behind its dolphins, or None.  Raises ValueError, one line."""
    from ...printing.console import new_console

    if gap is not None:
        _check_gap(gap)
    console = new_console()
    check_folder(folder)
    folder.mkdir(parents=True, exist_ok=True)
    rows, before_quay, paths = [], [], {}
    for floater, depths in DEPTHS.items():
        for depth in depths:
            wall = None if gap is None else 0.5 * FLOATERS[floater].beam + gap
            path = paths[floater, depth] = folder / f"{floater}_{depth:g}m_beam.h5"
            db = open_database(whole_database(scene_of(floater, depth), path, fresh))
            console.print(f"{path}: {len(db.omega)} frequencies", highlight=False, markup=False)
            rows += rows_of(floater, depth, db)
            if wall is not None:
                body, told = by_far_field(db, wall)
                before_quay += rows_of(floater, depth, db, body)
                console.print(*told, highlight=False, soft_wrap=True, markup=False)
    if gap is None:
        lines, files = _beside_the_report(console, rows, paths, folder)
    else:
        lines, files = _beside_open_water(before_quay, rows, gap, folder)
    for line in (*lines, *(f"written: {path}" for path in files)):
        console.print(line, highlight=False, soft_wrap=True, markup=False)
    return 0


def _check_gap(gap):
    """Raise StudyError for a quay too near for the far field of any of the floaters, or too far."""
    floating = [(depth, FLOATERS[floater].beam) for floater, depths in DEPTHS.items() for depth in depths]
    least = max(least_gap(REFUSED, *sizes) for sizes in floating)
    if not least <= gap <= FARTHEST:
        raise StudyError(
            f"--quay is {gap:g} m; allowed: {math.ceil(least)} to {FARTHEST:g} m, where waves alone cross the gap "
            "behind every floater; hakobune simulate takes nearer ones, with a database solved with --wall"
        )


def _beside_the_report(console, rows, paths, folder):
    """Lines to tell and files written of the charts and of Table 3.7.5.2, which is printed"""
    simulated = dolphin_simulated.simulated_rows(paths)
    console.print(dolphin_simulated.table_of(simulated))
    tables = _written(folder / "dolphin.csv", rows), _written(folder / "dolphin_simulated.csv", simulated)
    charts = (_draw(rows, floater, folder / f"dolphin_{floater}.png", "") for floater in DEPTHS)
    return (*statements(rows), *dolphin_simulated.statements(simulated)), (*tables, *charts)


def _beside_open_water(rows, open_rows, gap, folder):
    """The same of rows before a quay; the report's runs in time have none"""
    name, where = f"quay_{gap:g}m", f", a quay {gap:g} m behind"
    charts = (_draw(rows, floater, folder / f"dolphin_{floater}_{name}.png", where) for floater in DEPTHS)
    return quay_statements(rows, open_rows), (_written(folder / f"dolphin_{name}.csv", rows), *charts)


def _written(path, rows):
    """The path of a CSV of named tuples"""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(rows[0]._fields)
    table.writerows([f"{value:.6g}" if isinstance(value, float) else value for value in row] for row in rows)
    write_whole(path, text.getvalue().encode())
    return path


def scene_of(floater, depth):
    """The Scene of a floater in its water, waves on the beam"""
    f = FLOATERS[floater]
    body = {"shape": "box", "length": f.length, "beam": f.beam, "draft": f.draft, "gyration": GYRATION[floater]}
    waves = {"band": {"from": 0.05, "to": 1.6}, "headings_deg": [0, 15, 30, 45, 60, 75, 90]}  # a quay needs as many
    want = ["added_mass", "radiation_damping", "excitation_force", "rao", "drift_force", "kochin"]
    return make_scene({"water": {"depth": depth}, "bodies": [body], "waves": waves, "want": want, "tolerance": 0.01})


def dolphins_of(floater, count, stiffness):
    """`Dolphins` of a floater with `count` fenders on each of two dolphins"""
    f, (height, _) = FLOATERS[floater], FENDERS[floater]
    places = [[side * 0.25 * f.length, 0.5 * f.beam, 0.0] for side in (-1, 1) for _ in range(count)]
    return Dolphins(fender_of_family("cell", height), np.array(places), stiffness)


def rows_of(floater, depth, db, body=None):
    """`Row` of every number of fenders, period, weather and height of waves; body : `Reader` before a quay"""
    f, beam, out = FLOATERS[floater], beam_of((body or db.reader).floating(), BEAM), []
    hull = ExposedBox(f.length, f.beam, f.draft, FREEBOARD)
    stiffness = FENDERS[floater][1] * TONF
    for (wind, current), count, period in product(WEATHER, COUNTS, PERIODS):
        weather = with_coefficients(Conditions(Wind(wind, BEAM), Current(current * KNOT, BEAM)), hull, depth)
        steady = sum(load[1] for load in steady_loads(db, hull, weather, depth).values())
        linear = dolphins_of(floater, count, stiffness)
        limit = limit_height(beam, linear, steady, issc, period)
        for height in HEIGHTS:
            sea = issc(height, mean_period=period)
            s = strains(beam, linear, steady, sea)
            try:
                curve = strains(beam, linear._replace(stiffness=None), steady, sea).strain if height == 1.0 else np.nan
            except DolphinError:
                curve = np.inf
            loads = steady / TONF, s.drift / TONF
            out.append(Row(floater, depth, count, period, wind, current, height, *loads, s.static_strain, s.sigma,
                           s.strain, limit, curve))  # fmt: skip
    return out


def statements(rows):
    """The report's sentences beside what is computed, one line each"""
    for (floater, count), printed in PRINTED.items():
        own = [r for r in rows if (r.floater, r.fenders, r.period_s) == (floater, count, 10.0)]
        limits = ", ".join(
            f"{next(r for r in own if (r.depth_m, r.wind_m_s) == (depth, wind)).limit_m:.2f} "
            f"({depth:g} m, {wind:g} m/s)"
            for wind, _ in WEATHER for depth in DEPTHS[floater]
        )  # fmt: skip
        yield (
            f"floater {floater}, {count} on each dolphin, 10 s: printed {printed:g} m, here {limits}; 0: the steady "
            "loads alone press too far"
        )
    for floater, worst in (("A", 1), ("B", 5)):
        own = [r for r in rows if (r.floater, r.period_s, r.height_m, r.wind_m_s) == (floater, 10.0, 1.0, 50.0)]
        found = {depth: max((r for r in own if r.depth_m == depth), key=lambda r: r.sigma_m).fenders
                 for depth in DEPTHS[floater]}  # fmt: skip
        words = ", ".join(f"{count} ({depth:g} m)" for depth, count in found.items())
        yield f"floater {floater}: motion is largest at 10 s with {worst} fenders in the report, here with {words}"


def quay_statements(rows, open_rows):
    """Limits before a quay and in open water, one line each floater and number of fenders"""
    for floater, count in PRINTED:
        pairs = [(r, o) for r, o in zip(rows, open_rows, strict=True)
                 if (r.floater, r.fenders, r.wind_m_s, r.height_m) == (floater, count, WEATHER[0][0], 1.0)]  # fmt: skip
        words = ", ".join(f"{r.limit_m:.2f} for {o.limit_m:.2f} ({r.depth_m:g} m, {r.period_s:g} s)" for r, o in pairs)
        yield f"floater {floater}, {count} on each dolphin, m before the quay for open water: {words}"


def _draw(rows, floater, path, where):
    """Strain and limit over the number of fenders, a panel for each depth"""
    from matplotlib.figure import Figure

    depths = DEPTHS[floater]
    figure = Figure(figsize=(4.0 * len(depths), 8.0), layout="constrained")
    axes = figure.subplots(2, len(depths), squeeze=False, sharey="row")
    wind, current = WEATHER[-1]
    for column, depth in enumerate(depths):
        for period in PERIODS:
            own = [r for r in rows if (r.floater, r.depth_m, r.period_s, r.wind_m_s) == (floater, depth, period, wind)]
            one = [r for r in own if r.height_m == 1.0]
            counts = [r.fenders for r in one]
            axes[0, column].plot(counts, [100 * r.strain for r in one], "o-", label=f"{period:g} s")
            axes[1, column].plot(counts, [r.limit_m for r in one], "o-", label=f"{period:g} s")
        axes[0, column].axhline(35, color="grey", linewidth=0.8)
        axes[0, column].set_title(f"floater {floater} in {depth:g} m")
        axes[1, column].set_xlabel("fenders on each of two dolphins")
    axes[0, 0].set(ylabel="largest strain in waves of 1 m, %", ylim=(0, None))
    axes[1, 0].set(ylabel="limit of the significant height, m", ylim=(0, None))
    axes[0, 0].legend(title="mean period")
    figure.suptitle(f"wind {wind:g} m/s, current {current:g} kn, waves on the beam{where}")
    save(figure, path, 110)
    return path
