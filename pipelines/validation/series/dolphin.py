"""`hakobune series dolphin`: floaters A and B between dolphins with fenders, by the design spectrum method and in time.

SR179 report (1982), section 3.7.5: fenders of 700 tonf/m (C2000H, floater A) and 1200 tonf/m (C3000H, B), ISSC spectra,
waves, wind and current on the beam; strains of at most 10 % under the steady loads and 35 % in total. `fenders`
fenders stand on each of two dolphins, at a quarter of the length from each end; the report gives no layout.  With a
quay behind the dolphins, the rows of the design spectrum method include the quay by its far field. Values for open
water stand beside these rows.
"""

import math
from itertools import product

import numpy as np

from hakobune.bem.wave_field.before_wall import least_gap
from hakobune.mooring.dolphins.design_spectrum import DolphinError, Dolphins, beam_of, limit_height, strains
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.fenders.families import fender_of_family
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Wind
from hakobune.mooring.studies.steady_loads import steady_loads, with_coefficients

from ...common.quantities import StudyError
from ...common.units import KNOT, TONF
from ...moor.quay import REFUSED, by_far_field
from ...scene.scene import make_scene
from ..beside import database, one_by_one, result
from ..picture import Curve, Panel
from . import dolphin_simulated
from .single_point_cases import FLOATERS

DEPTHS = {"A": (12.0, 14.0, 20.0, 50.0), "B": (40.0, 100.0)}
FENDERS = {"A": (2.0, 700.0), "B": (3.0, 1200.0)}  # height m, tonf/m
GYRATION = {"A": [15.55, 29.44, 32.28], "B": [30.55, 58.59, 64.55]}
COUNTS = (1, 2, 3, 4, 5)
PERIODS, HEIGHTS = (6.0, 8.0, 10.0), (0.5, 1.0, 1.5, 2.0, 3.0)
WEATHER = ((25.0, 1.5), (50.0, 3.0))  # wind m/s, current kn
SOURCE = "SR179 report (1982), section 3.7.5"
FREEBOARD = 10.0
FARTHEST = 1000.0  # m, of a quay behind
PRINTED = {("A", 1): 0.35, ("A", 3): 0.9, ("B", 1): 1.5, ("B", 3): 1.05}  # m, in the text; at 10 s, presumably
BEAM = 0.5 * math.pi


def make(folder, quay=None, fresh=False):
    """The Result: rows of the design spectrum method, and Table 3.7.5.2 in time; quay : distance from the hull to a
    quay, m, or None

    raises : StudyError for a quay that is too near or too far
    """
    if quay is not None:
        _check_gap(quay)
    solved = {}
    for floater, depth in one_by_one([(f, d) for f, depths in DEPTHS.items() for d in depths], str):
        path = folder / f"{floater}_{depth:g}m_beam.h5"
        solved[floater, depth] = database(make_scene(scene_of(floater, depth)), path, fresh)
    rows = [row for (floater, depth), db in solved.items() for row in rows_of(floater, depth, db)]
    if quay is None:
        simulated = dolphin_simulated.simulated_rows(solved)
        notes = (*statements(rows), *dolphin_simulated.statements(simulated))
        return result("series dolphin", SOURCE, {"case": rows, "run": simulated}, notes)
    before, told = [], []
    for (floater, depth), db in solved.items():
        body, lines = by_far_field(db, 0.5 * FLOATERS[floater].beam + quay)
        before += rows_of(floater, depth, db, body)
        told += lines
    both = [r | {"open_water_limit_m": o["limit_m"]} for r, o in zip(before, rows, strict=True)]
    return result(
        "series dolphin", f"{SOURCE}, a quay {quay:g} m behind", {"case": both}, (*told, *quay_statements(both))
    )


def _check_gap(gap):
    """Raise StudyError for a quay too near for the far field of any of the floaters, or too far."""
    floating = [(depth, FLOATERS[floater].beam) for floater, depths in DEPTHS.items() for depth in depths]
    least = max(least_gap(REFUSED, *sizes) for sizes in floating)
    if not least <= gap <= FARTHEST:
        raise StudyError(
            f"--quay is {gap:g} m; allowed: {math.ceil(least)} to {FARTHEST:g} m, where only propagating waves cross "
            "the gap behind every floater; for a nearer quay use hakobune simulate with a database solved with --wall"
        )


def scene_of(floater, depth):
    """Raw tables of the scene of a floater in its water, waves on the beam"""
    f = FLOATERS[floater]
    body = {"shape": "box", "length": f.length, "beam": f.beam, "draft": f.draft, "gyration": GYRATION[floater]}
    waves = {"band": {"from": 0.05, "to": 1.6}, "headings_deg": [0, 15, 30, 45, 60, 75, 90]}  # a quay needs as many
    want = ["added_mass", "radiation_damping", "excitation_force", "rao", "drift_force", "kochin"]
    return {"water": {"depth": depth}, "bodies": [body], "waves": waves, "want": want, "tolerance": 0.01}


def dolphins_of(floater, count, stiffness):
    """`Dolphins` of a floater with `count` fenders on each of two dolphins"""
    f, (height, _) = FLOATERS[floater], FENDERS[floater]
    places = [[side * 0.25 * f.length, 0.5 * f.beam, 0.0] for side in (-1, 1) for _ in range(count)]
    return Dolphins(fender_of_family("cell", height), np.array(places), stiffness)


def rows_of(floater, depth, db, body=None):
    """[{column: number}] of every number of fenders, period, weather and height of waves; body : `Reader` before a quay

    strains are deflections over the height of a fender; limit_m : allowable significant height; curve : by a cell's
    equivalent spring
    """
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
            out.append({
                "case": f"{floater} {depth:g} m, {count} fenders, {period:g} s, {wind:g} m/s, {height:g} m",
                "floater": floater, "depth_m": depth, "fenders": count, "period_s": period, "wind_m_s": wind,
                "current_kn": current, "height_m": height, "steady_tonf": steady / TONF, "drift_tonf": s.drift / TONF,
                "static_strain": s.static_strain, "sigma_m": s.sigma, "strain": s.strain, "limit_m": limit,
                "curve_strain": curve,
            })  # fmt: skip
    return out


def statements(rows):
    """The report's sentences with the computed values, one line each"""
    for (floater, count), printed in PRINTED.items():
        own = _of(rows, floater=floater, fenders=count, period_s=10.0, height_m=HEIGHTS[0])
        limits = ", ".join(f"{r['limit_m']:.2f} ({r['depth_m']:g} m, {r['wind_m_s']:g} m/s)"
                           for r in sorted(own, key=lambda r: r["wind_m_s"]))  # fmt: skip
        yield (
            f"floater {floater} with {count} fenders on each dolphin, 10 s: the printed limit is {printed:g} m, "
            f"the computed one {limits}; 0 means that the steady loads alone compress the fenders too far"
        )
    for floater, worst in (("A", 1), ("B", 5)):
        found = [max(_of(rows, floater=floater, depth_m=depth, period_s=10.0, height_m=1.0, wind_m_s=50.0),
                     key=lambda r: r["sigma_m"]) for depth in DEPTHS[floater]]  # fmt: skip
        words = ", ".join(f"{r['fenders']} ({r['depth_m']:g} m)" for r in found)
        yield (
            f"floater {floater}: the motion at 10 s is largest with {worst} fenders in the report, and with "
            f"{words} here"
        )


def quay_statements(rows):
    """Limits in front of a quay and in open water, one row for each floater and number of fenders"""
    for floater, count in PRINTED:
        own = _of(rows, floater=floater, fenders=count, wind_m_s=WEATHER[0][0], height_m=1.0)
        words = ", ".join(f"{r['limit_m']:.2f} for {r['open_water_limit_m']:.2f} ({r['depth_m']:g} m, "
                          f"{r['period_s']:g} s)" for r in own)  # fmt: skip
        yield (
            f"floater {floater} with {count} fenders on each dolphin, limits of wave height in m in front of the "
            f"quay for those in open water: {words}"
        )


def _of(rows, **wanted):
    return [row for row in rows if wanted.items() <= row.items()]


def pictures(made):
    """Strain and limit over the number of fenders, a panel for each floater and depth, in the heavier weather"""
    rows, (wind, current) = made.detail["case"], WEATHER[-1]
    panels = []
    for column, size, level in (("strain", "largest strain in waves of 1 m", (0.35,)),
                                ("limit_m", "limit of the significant height, m", ())):  # fmt: skip
        for floater, depth in ((f, d) for f, depths in DEPTHS.items() for d in depths):
            own = _of(rows, floater=floater, depth_m=depth, wind_m_s=wind, height_m=1.0)
            curves = []
            for period in PERIODS:
                some = _of(own, period_s=period)
                x, y = ([r[key] for r in some] for key in ("fenders", column))
                curves.append(Curve(f"{period:g} s", x, y, {"marker": "o"}))
            axes = {"xlabel": "fenders on each of two dolphins", "ylabel": size}
            panels.append(Panel(f"floater {floater} in {depth:g} m", curves, level, axes))
    title = f"{made.provenance['source']}: wind {wind:g} m/s, current {current:g} kn, waves on the beam, mean periods"
    return {"dolphin.png": (title, panels, len(panels) // 2)}
