"""`hakobune series single-point`: every case solved, run in time, tabulated beside its print and drawn."""

from __future__ import annotations

import csv
import io
import warnings
from typing import NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from hakobune.bem.database import open_database
from hakobune.meshing.whole_files import write_whole
from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.single_point.equilibria import equilibria, preferred
from hakobune.mooring.single_point.scope import length_without_uplift, peak, significant

from ...common.outputs import check_folder, check_output, opening
from ...common.quantities import StudyError
from ...common.units import TONF
from ...common.weather.seas import sea_of
from ...printing.verdict import tell
from ...single_point.running import run
from ...single_point.study import make
from ...single_point.tables import make_study
from .databases import whole_database
from .single_point_cases import FLOATERS, read_cases, scene_of, study_of
from .single_point_charts import draw, statements, trends

MOST_SEEDS = 100
HIGHEST = 3.5  # rad/s of the waves that drift is summed over
COLUMNS = ("heading_deg", "static_ton", "significant_ton", "scope", "hawser_ton")


class Result(NamedTuple):
    """Of a Case, per line in tonf as the report prints: heading_deg, static_ton, significant_ton, scope, hawser_ton

    nan where lines do not hold; apart_m : m of surge head-on from the printed significant tension to the computed one
    settled : s of the heading from 2°; note : why a value is missing
    """

    case: object
    heading_deg: float
    static_ton: float
    significant_ton: float
    scope: float
    hawser_ton: float
    apart_m: float
    settled: float
    note: str


def make_series(folder, cases_path, only, seeds, fresh):
    """Exit status: 0, or 1 with a case that has no static answer.  Raises ValueError, one line."""
    from ...printing.console import new_console

    console = new_console()
    cases = read_cases(cases_path, only)
    if not 1 <= seeds <= MOST_SEEDS:
        raise StudyError(f"--seeds is {seeds}; allowed: 1 to {MOST_SEEDS}")
    path = folder / "single_point.csv"
    check_folder(folder)
    folder.mkdir(parents=True, exist_ok=True)
    check_output(path, "a table of the series", is_table, (".csv",))
    databases = solved(cases, folder, fresh, console)
    results = []
    for case in cases:
        results.append(computed(case, databases[case.database], seeds))
        write_study(case, databases[case.database], folder)
        _tell(console, results[-1])
    write_table(path, results)
    written = [path]
    written += draw(results, folder)
    for line in (*statements(results), *trends(results)):
        console.print(line, highlight=False, soft_wrap=True, markup=False)
    status = tell(
        (fails(f"{one.case.name} has no static answer: {one.note}") for one in results if np.isnan(one.static_ton)),
        console,
    )
    for path in written:
        console.print(f"written: {path}", highlight=False, soft_wrap=True, markup=False)
    return status


def solved(cases, folder, fresh, console):
    """{name: database} of the floaters and depths of cases, each solved where it is not there"""
    made = {}
    for case in cases:
        if case.database not in made:
            path = folder / f"{case.database}.h5"
            made[case.database] = open_database(whole_database(scene_of(case), path, fresh))
            count = len(made[case.database].omega)
            console.print(f"{path}: {count} frequencies", highlight=False, markup=False)
    return made


def computed(case, db, seeds=1) -> Result:
    """Result of a case, its significant tensions averaged over `seeds` records of waves"""
    f, n = FLOATERS[case.floater], case.together
    try:
        study = study_of(case, drift=drift_of(case, db))
        point = make(make_study(study), db).point
        best = lying(equilibria(point))
    except ValueError as error:
        return Result(case, *[np.nan] * 7, " ".join(str(error).split()))
    steady = float(best.lines.tension.max()) / TONF / n
    heading = float(np.degrees(np.mod(best.heading + np.pi, 2 * np.pi) - np.pi))
    found, note, settled = [], "", np.nan
    for seed in range(1, seeds + 1):
        study["slewing"]["seed"] = seed
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                one = run(make_study(study), point, best, db)
        except ValueError as error:
            note = " ".join(str(error).split())
            break
        settled = one.settled
        found.append((significant(one.record.lines, best.lines.tension).max() / TONF / n,
                      significant(np.linalg.norm(one.record.hawser, axis=1), best.pull) / TONF))  # fmt: skip
    if note:
        return Result(case, heading, steady, *[np.nan] * 4, settled, note)
    tension, hawser = np.mean(found, axis=0)
    height = case.values["depth_m"] - f.attached
    weight = case.values["weight_ton_m"]
    scope = float(length_without_uplift(peak(steady, tension), weight, height)) / case.values["depth_m"]
    printed, away = case.printed["significant_ton"], np.nan
    if printed is not None and case.current_deg == 0:
        away = surge_at(point, n * TONF * tension) - surge_at(point, n * TONF * printed)
    return Result(case, heading, steady, float(tension), scope, float(hawser), away, settled, "")


def surge_at(point, tension):
    """m that the buoy has moved straight back when its leading line pulls with a tension, N"""

    def leading(force):
        return float(point.buoy_under(np.array([-force, 0.0])).tension.max()) - tension

    force = brentq(leading, 1.0, len(point.at_rest.tension) * tension, rtol=1e-6)
    return float(point.origin[0] - point.buoy_under(np.array([-force, 0.0])).position[0, 0])


def drift_of(case, db):
    """tonf over the square of the height: that of the head-on rows, by what is computed for the depth and the period"""
    f, sea = FLOATERS[case.floater], make_study(study_of(case)).waves
    omega = np.sort(db.reader.omega)
    stored = db.reader.drift(omega, [np.pi])[:, 0, 0]
    fine = np.linspace(omega[0], HIGHEST, 4000)
    density = sea_of("waves", sea, np.pi, db.water_depth).spectrum.density(fine)
    drift = PchipInterpolator(omega, stored)(np.minimum(fine, omega[-1]))  # as in the shortest stored waves beyond
    mean = 2 * float(np.trapezoid(density * drift, fine))
    return f.drift / f.computed * abs(mean) / TONF / sea.height**2


def lying(found):
    """The stable Equilibrium nearest to the wind and the waves, from 0°; the least unstable where none is stable"""
    stable = [one for one in found if one.slewing.stable]
    return max(stable, key=lambda one: np.cos(one.heading)) if stable else preferred(found)


def write_study(case, db, folder):
    """The study of a case, for `hakobune single-point --database`"""
    import tomli_w

    study = tomli_w.dumps(study_of(case, drift=drift_of(case, db)))
    text = f"# Case {case.name} of the SR179 report's single-point series (1982)\n\n{study}"
    write_whole(folder / f"{case.name}.toml", text.encode())


def is_table(path):
    """Whether a file is a table of a series made here"""
    return opening(path)[0].startswith("# hakobune series")


def write_table(path, results):
    """CSV of results, each quantity beside what the report prints"""
    out = io.StringIO()
    out.write("# hakobune series single-point: SR179 report (1982), tables 3.6.5.3-5; tonf per line; printed beside\n")
    table = csv.writer(out, lineterminator="\n")
    names = [name for column in COLUMNS for name in (column, f"printed_{column}")]
    given = ["case", "floater", "system", "current_deg", *results[0].case.values]
    table.writerow([*given, *names, "apart_m", "settled_s", "note", "flag"])
    for one in results:
        values = [v for c in COLUMNS for v in (getattr(one, c), one.case.printed[c])]
        shown = ["" if v is None or np.isnan(v) else f"{v:.5g}" for v in (*values, one.apart_m, one.settled)]
        case = one.case
        table.writerow([case.name, case.floater, case.system, f"{case.current_deg:g}",
                        *(f"{v:g}" for v in case.values.values()), *shown, one.note, case.flag])  # fmt: skip
    write_whole(path, out.getvalue().encode())


def _tell(console, one):
    def beside(name, digits):
        value, printed = getattr(one, name), one.case.printed[name]
        return f"{value:.{digits}f} ({'–' if printed is None else f'{printed:g}'})"

    words = (
        f"heading {beside('heading_deg', 0)}°, static {beside('static_ton', 0)} t",
        f"significant {beside('significant_ton', 0)} t, scope {beside('scope', 1)}",
        f"hawser {beside('hawser_ton', 0)} t",
    )
    doubtful = one.case.flag and not one.case.flag.startswith("= ")  # a row that is another one says so
    words += tuple(text for text in (one.note, doubtful and f"in print: {one.case.flag}") if text)
    console.print(f"{one.case.name:4} {', '.join(words)}", highlight=False, soft_wrap=True, markup=False)
