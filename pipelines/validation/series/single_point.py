"""`hakobune series single-point`: every case solved, run in time, and compared with the printed results."""

import warnings

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.single_point.equilibria import equilibria, preferred
from hakobune.mooring.single_point.scope import length_without_uplift, peak, significant

from ...common.units import TONF
from ...common.weather.seas import sea_of
from ...scene.scene import make_scene
from ...single_point.running import run
from ...single_point.study import make as point_of
from ...single_point.tables import make_study
from ..beside import chosen, database, keep, one_by_one, result
from ..picture import Curve, Panel
from .single_point_cases import FLOATERS, PRINTED, read_cases, scene_of, study_of

HIGHEST = 3.5  # rad/s of the waves that drift is summed over
SOURCE = "SR179 report (1982), tables 3.6.5.3 to 3.6.5.5, tonf per line"
ALLOWED = 0.4  # fraction of the breaking load
OVER = {"depth_m": "depth, m", "wind_m_s": "wind, m/s", "current_deg": "current from, °"}
# cases are one curve over a column where they agree in the others, but for the sea, which grows with the wind
ALIKE = ("lines", "system", "pretension_tonf", "current_kn", "mean_period_s", "depth_m", "wind_m_s", "current_deg")


def make(folder, only=None, seeds=1, fresh=False):
    """The Result: each case compared with its printed values; fails if a case has no static solution"""
    cases, solved, found = chosen(read_cases(), only), {}, []
    for case in one_by_one(cases, lambda case: case.name):
        if case.database not in solved:
            path = folder / f"{case.database}.h5"
            solved[case.database] = database(make_scene(scene_of(case)), path, fresh)
        db = solved[case.database]
        found.append(computed(case, db, seeds))
        keep(folder / f"{case.name}.toml", study_of(case, drift=drift_of(case, db)))
    lost = [
        fails(f"{one['case']} has no static answer: {one['note']}") for one in found if np.isnan(one["static_tonf"])
    ]
    return result("series single-point", SOURCE, {"case": found}, (*statements(found), *trends(found)), lost)


def computed(case, db, seeds=1):
    """{column: number or text} of a case, for each line as in the report, averaged over `seeds` wave records

    nan where lines do not hold; apart_m : head-on surge between the printed and the computed significant tension, m
    settled_s : time until the heading has settled from 2°, s; note : reason of a missing value
    """
    ours = dict.fromkeys((*PRINTED, "apart_m", "settled_s"), np.nan) | {"note": ""}
    try:
        ours |= _computed(case, db, seeds)
    except ValueError as error:
        ours["note"] = " ".join(str(error).split())
    named = {"case": case.name, "floater": case.floater, "system": case.system, "current_deg": case.current_deg}
    printed = {f"printed_{key}": value for key, value in case.printed.items()}
    return named | case.values | ours | printed | {"flag": case.flag}


def _computed(case, db, seeds):
    f, n = FLOATERS[case.floater], case.together
    study = study_of(case, drift=drift_of(case, db))
    point = point_of(make_study(study), db).point
    best = lying(equilibria(point))
    steady, found = float(best.lines.tension.max()) / TONF / n, []
    ours = {"heading_deg": float(np.degrees(np.mod(best.heading + np.pi, 2 * np.pi) - np.pi)), "static_tonf": steady}
    for seed in range(1, seeds + 1):
        study["slewing"]["seed"] = seed
        try:
            with warnings.catch_warnings(action="ignore"):
                one = run(make_study(study), best, db)
        except ValueError as error:
            return ours | {"note": " ".join(str(error).split())}
        ours["settled_s"] = one.settled
        found.append((significant(one.record.lines, best.lines.tension).max() / TONF / n,
                      significant(np.linalg.norm(one.record.hawser, axis=1), best.pull) / TONF))  # fmt: skip
    tension, hawser = np.mean(found, axis=0)
    height, depth = case.values["depth_m"] - f.attached, case.values["depth_m"]
    scope = float(length_without_uplift(peak(steady, tension), case.values["weight_t_m"], height)) / depth
    ours |= {"significant_tonf": float(tension), "scope": scope, "hawser_tonf": float(hawser)}
    printed = case.printed["significant_tonf"]
    if np.isfinite(printed) and case.current_deg == 0:
        ours["apart_m"] = surge_at(point, n * TONF * tension) - surge_at(point, n * TONF * printed)
    return ours


def surge_at(point, tension):
    """Distance, m, by which the buoy has moved straight back when the tension of its leading line has a given value,
    N
    """

    def leading(force):
        return float(point.buoy_under(np.array([-force, 0.0])).tension.max()) - tension

    force = brentq(leading, 1.0, len(point.at_rest.tension) * tension, rtol=1e-6)
    return float(point.origin[0] - point.buoy_under(np.array([-force, 0.0])).position[0, 0])


def drift_of(case, db):
    """Drift over the square of the height, tonf/m²: the value of the head-on rows, scaled by the computed drift at the
    depth and the period"""
    f, sea = FLOATERS[case.floater], make_study(study_of(case)).waves
    omega = np.sort(db.reader.omega)
    stored = db.reader.drift(omega, [np.pi])[:, 0, 0]
    fine = np.linspace(omega[0], HIGHEST, 4000)
    density = sea_of("waves", sea, np.pi, db.water_depth).spectrum.density(fine)
    drift = PchipInterpolator(omega, stored)(np.minimum(fine, omega[-1]))  # beyond: that of the shortest waves
    mean = 2 * float(np.trapezoid(density * drift, fine))
    return f.drift / f.computed * abs(mean) / TONF / sea.height**2


def lying(found):
    """The stable Equilibrium nearest to the wind and waves, which come from 0°; without a stable one the least
    unstable
    """
    stable = [one for one in found if one.slewing.stable]
    return max(stable, key=lambda one: np.cos(one.heading)) if stable else preferred(found)


def pictures(made):
    """Tension of each floater over depth, weather and direction of the current; curves are computed values, crosses
    printed values"""
    out = {}
    for floater, f in FLOATERS.items():
        own = [row for row in made.detail["case"] if row["floater"] == floater]
        panels = [Panel(words, _over(own, column), (ALLOWED * f.breaking,),
                        {"xlabel": words, "ylabel": "line tension, tonf (dashed: static)", "yscale": "log"})
                  for column, words in OVER.items()]  # fmt: skip
        if own:
            title = f"Floater {floater}; crosses: printed; dotted: {ALLOWED:g} of the breaking load"
            out[f"single_point_{floater}.png"] = (title, panels, 3, (5, 5), False)
    return out


def _over(rows, column):
    """[Curve] of groups of rows that differ in one column and agree in those of ALIKE, static and significant"""
    keys = [key for key in ALIKE if key != column]
    groups, curves = {}, []
    for row in rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    shown = {key: sorted(own, key=lambda row: row[column]) for key, own in groups.items()
             if len({row[column] for row in own}) > 1}  # fmt: skip
    for i, (key, own) in enumerate(shown.items()):
        x, color = [row[column] for row in own], f"C{i % 10}"
        words = ", ".join(f"{value:g}" if isinstance(value, float) else value for value in key)
        for name, style, label in (("static_tonf", "--", ""), ("significant_tonf", "-", words)):
            curves.append(Curve(label, x, [row[name] for row in own], {"color": color, "linestyle": style}))
            curves.append(
                Curve("", x, [row[f"printed_{name}"] for row in own], {"color": color, "marker": "x", "ls": ""})
            )
    return curves


def statements(found):
    """Lines on the report's statements of section 3.6.5, each with the computed values; a statement without its cases
    has no line"""
    named = {one["case"]: one for one in found}
    for text, cases, value in STATEMENTS:
        if all(name in named for name in cases):
            yield f"report: {text}; computed: {value(*(named[name] for name in cases))}"


def trends(found):
    """Lines of text: significant over static tension of a contact buoy with six lines, head-on, computed and printed

    Where mooring lines are nearly taut, decimetres of surge decide; each text line gives the difference of surge
    between computed and printed tension.
    """
    groups = {}
    for one in found:
        alike = {"system": "contact", "lines": 6.0, "current_kn": 1.5}
        if alike.items() <= one.items() and np.isfinite(one["apart_m"]):
            key = one["floater"], one["height_m"], one["mean_period_s"], one["depth_m"]
            ratios = (one[f"{kind}significant_tonf"] / one[f"{kind}static_tonf"] for kind in ("", "printed_"))
            groups.setdefault(key, []).append((*ratios, one["apart_m"]))
    for (floater, height, period, depth), rows in groups.items():
        ours, printed, away = map(_ends, np.array(rows).T)
        yield (
            f"{floater}, H {height:g} m, {period:g} s, {depth:g} m: significant tension over static tension is "
            f"{ours}, printed {printed}; {away} m of surge explain the difference"
        )
    away = np.abs([one["apart_m"] for one in found if np.isfinite(one["apart_m"])])
    if len(away) > 1:
        yield (
            f"{len(away)} head-on cases: the difference of computed and printed significant tensions is the effect "
            f"of {np.median(away):.2f} m of surge (median; nine of ten cases: at most "
            f"{np.quantile(away, 0.9):.2f} m), since nearly taut lines turn a small surge into a large tension"
        )


def _ends(values):
    """Smallest and largest as text, once where they are the same"""
    low, high = (f"{v:.2f}" for v in (values.min(), values.max()))
    return low if low == high else f"{low} to {high}"


def _t(*several):
    tensions = (one["significant_tonf"] for one in several)
    return ", ".join("beyond reach" if np.isnan(tension) else f"{tension:.0f} t" for tension in tensions)


def _added(first, *others):
    return f"{100 * (max(one['static_tonf'] for one in others) / first['static_tonf'] - 1):.0f} %"


def _ratios(*several):
    found = [one["significant_tonf"] / one["static_tonf"] for one in several]
    return ", ".join("–" if np.isnan(ratio) else f"{ratio:.2f}" for ratio in found)


STATEMENTS = (
    ("tension of A rises sharply below 15 m, at 20, 14, 12 m", ("A16", "A14", "A12"), _t),
    ("A at 14 m and 1.5 kn stands 35, 40, 45 m/s on 6, 12, 18 lines (breaking load 785 t)", ("A20", "A33", "A35"), _t),
    ("and at 3 kn 32 m/s on 12, 38 m/s on 18 lines, here at 35 and 40 m/s", ("A38", "A41"), _t),
    (
        "an oblique current of 30 to 60° adds 40 % to the static tension of a contact buoy at most",
        ("A53", "A54", "A55"),
        _added,
    ),
    ("dynamic tension of B at 40 m and more is 1.4 times the static or less", ("B26", "B27", "B28"), _ratios),
    ("tension of B rises sharply below 35 m, at 100, 40, 24 m", ("B28", "B26", "B24"), _t),
    ("the worst of B, at 24 m on six and at 40 m on 12 lines, is about 740 t, half of its breaking load",
     ("B25", "B52"), _t),
)  # fmt: skip
