"""`hakobune series lines`: tension of a static line over its horizontal distance, charts 1.7.1 to 1.7.6.

SR179 report (1982), section 3.1.7: T/wL over X/√(L² − Z²), Z the height of the fairlead above the anchor.  The
report's curves and many of its parameters are lost. Scope, slopes and the order of the curves follow its text, which
`statements` checks. Assumed values are: friction, hills of steepness 1/10, sinker and buoys at half the length, and
EA/wL of 500 to 4000. Wire rope that breaks at T/wL of 20 to 23 with a strain of 1 to 1.5 % has about 2000.
"""

import numpy as np

from hakobune.mooring.lines.multi_segment.line import Bed, PointLoad, Segment, StaticLine

from ...results.provenance import provenance
from ...results.quantity import Quantity
from ...results.result import Result, labels
from ..picture import Curve, Panel

HEIGHT, WEIGHT, SURFACE = 20.0, 10.0, 22.0  # m, N/m, m above the anchor; every result is over w L
SCOPE = 6.0
NEAR = 0.97  # share at which hills are compared
TIGHT = 0.975  # share from which on a line with a light buoy is all lifted
SHARES = np.unique(np.concatenate([np.linspace(0.80, 0.99, 39), 1.0 - np.geomspace(1e-2, 5e-5, 41)]))
STRONG = 23.0  # largest breaking load of wire rope over its weight
SLOPES = (-1 / 10, -1 / 20, -1 / 50, -1 / 100, 0.0, 1 / 100, 1 / 50, 1 / 20, 1 / 10)
CHARTS = {"1.7.1": "friction, scope 3.26, at the anchor", "1.7.2": "scope", "1.7.3": "slope",
          "1.7.4": "hills and hollows", "1.7.5": "sinker and buoys at L/2", "1.7.6": "elasticity"}  # fmt: skip


def make(folder, fresh=False):
    """The Result: T/wL (curve, share), a curve's name with its chart's number before it"""
    made = charts()
    named = {f"{number} {name}": values for number, curves in made.items() for name, values in curves.items()}
    axes = labels("curve", list(named)) | labels("share", SHARES, "", "X / √(L² − Z²)")
    tension = Quantity(np.array(list(named.values())), ("curve", "share"), "", "T/wL")
    told = provenance(source="SR179 report (1982), section 3.1.7")
    return Result("series lines", {"tension": tension}, axes, notes=tuple(statements(made)), provenance=told)


def charts():
    """{number of the chart: {name of the curve: (n,) T/wL over SHARES}}"""
    hilly = [(n, thing) for thing in ("hill", "hollow") for n in (1, 2, 4, 8)]
    return {
        "1.7.1": {f"μ = {m:g}": curve(3.26, Bed.sloping(0.0, m), anchor=True) for m in (0.0, 0.2, 0.5, 1.0)},
        "1.7.2": {f"L/Z = {n:g}": curve(n) for n in (2, 3, 4, 6, 8, 10)},
        "1.7.3": {_slope(t): curve(bed=Bed.sloping(np.arctan(t))) for t in SLOPES},
        "1.7.4": {"flat": curve()}
        | {f"{n} {thing}{'s' * (n > 1)}": curve(bed=hills(n, thing == "hill")) for n, thing in hilly},
        "1.7.5": {"plain": curve()}
        | {f"sinker {b:g} wL": curve(load=b) for b in (0.25, 0.5)}
        | {f"buoy {b:g} wL": curve(load=-b) for b in (0.1, 0.25, 1.25)},
        "1.7.6": {f"EA/wL = {e:g}": curve(stiffness=e) for e in (500.0, 1000.0, 2000.0, 4000.0, np.inf)},
    }


def curve(scope=SCOPE, bed=None, load=0.0, stiffness=np.inf, anchor=False):
    """Tension T/wL over SHARES at the fairlead or at the anchor, shape (n,); load : at half the length, over wL; EA
    : over wL
    """
    length = scope * HEIGHT
    total = WEIGHT * length
    loads = [PointLoad(0.5 * length, load * total)] if load else []
    line = StaticLine([Segment(length, WEIGHT, stiffness * total)], loads, bed or Bed.sloping(), SURFACE)
    found = line.solve(SHARES * np.sqrt(length**2 - HEIGHT**2), HEIGHT)
    return np.asarray(found.tension_anchor if anchor else found.tension_fairlead) / total


def hills(count, rising):
    """Triangular hills, or hollows, of one steepness from the anchor on; the more there are, the lower they are"""
    width = SCOPE * HEIGHT
    x = np.linspace(0.0, width, 2 * count + 1)
    z = np.where(np.arange(x.size) % 2 == 1, 0.1 * width / (2 * count), 0.0)
    return Bed(np.column_stack([x, z if rising else -z]))


def statements(made):
    """The report's statements on the charts, each with whether the computed curves agree"""
    friction, scope, slope, rough, loads, elastic = (list(curves.values()) for curves in made.values())
    named = made["1.7.5"]
    flat, over, through = (np.array([c[_at(NEAR)] for c in part]) for part in (rough[:1], rough[1:5], rough[5:]))
    kept = [[np.interp(T, elastic[-1], c) / T for T in (2.0, 3.0, 10.0, 15.0)] for c in elastic[:-1]]
    tight = SHARES >= TIGHT
    said = [
        ("1.7.1: the anchor holds less the rougher the bed", np.all(np.diff(friction, axis=0) <= 1e-9)),
        ("1.7.2: a longer scope rises later and then more abruptly", _later(scope)),
        ("1.7.3: on a bed that falls away from the anchor tension rises more gently", _later(slope)),
        (
            "1.7.4: one hill is lowest, one hollow highest, and many of either come to the flat bed",
            over[0] == min(over) < flat[0] < through[0] == max(through)
            and np.all(np.abs([over[-1], through[-1]] - flat) < 0.25 * np.abs([over[0], through[0]] - flat)),
        ),
        (
            "1.7.5: a sinker adds nothing while it lies and tension once it is lifted",
            np.isclose(named["sinker 0.25 wL"][0], loads[0][0]) and named["sinker 0.25 wL"][-1] > loads[0][-1],
        ),
        (
            "1.7.5: a buoy lighter than the line makes it lighter where it is lifted, one heavier emerges and pulls",
            np.all(named["buoy 0.1 wL"][tight] < loads[0][tight]) and named["buoy 1.25 wL"][0] > loads[0][0],
        ),
        (
            "1.7.6: stretch of wire rope (EA/wL = 2000) takes 15 % or less at T/wL of 2 to 3, half or more at 10 to 15",
            min(kept[2][:2]) > 0.85 and max(kept[2][2:]) < 0.5 and np.all(np.diff(elastic, axis=0) >= -1e-9),
        ),
    ]
    return [f"{text}: {'so here' if good else 'NOT so here'}" for text, good in said]


def _later(curves):
    """Whether each curve is below the one before at 0.95, and rises by a larger factor from there to 0.9995"""
    early, late = (np.array([c[_at(share)] for c in curves]) for share in (0.95, 0.9995))
    return np.all(np.diff(early) < 0) and np.all(np.diff(late / early) > 0)


def _at(share):
    return int(np.argmin(np.abs(SHARES - share)))


def _slope(tangent):
    return "flat" if tangent == 0 else f"tan β = {'−' if tangent < 0 else ''}1/{abs(round(1 / tangent))}"


def pictures(made):
    """The charts of a Result"""
    panels, of_curve = [], dict(zip(made.labels["curve"].values.tolist(), made["tension"], strict=True))
    for number, title in CHARTS.items():
        own = {name.removeprefix(f"{number} "): T for name, T in of_curve.items() if name.startswith(f"{number} ")}
        curves = [Curve(name, SHARES, values) for name, values in own.items()]
        top, left = (STRONG, 0.98) if number == "1.7.6" else (4.0, SHARES[0])
        axes = {"xlabel": "X / √(L² − Z²)", "ylabel": "T/wL", "ylim": (0, top), "xlim": (left, 1.0)}
        panels.append(Panel(f"{number}  {title}", curves, axes=axes))
    title = "Tension of a static line, SR179 report (1982), charts 1.7.1 to 1.7.6"
    return {"lines.png": (title, panels, 3, (5, 5), False)}
