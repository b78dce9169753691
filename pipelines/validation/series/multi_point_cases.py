"""The cases of the SR179 report's multi-point series (1982), section 3.5.5, as tables of scenes and mooring studies.

Floaters A and B (Table 3.5.5.1) on chain, chain with an intermediate buoy, or chain with an intermediate sinker
(3.5.5.2), with the lengths of 3.5.5.4 and the conditions of 3.5.5.3, all from 60° off the bow.  From a base case one
quantity is changed at a time: 12 cases for each kind of line, 36 in total.

The report's mean period T̄ is the mean zero-crossing period, with T₁/₃ = T̄/0.9 and T̄ = 1.1 T₀₁ (section 3.7.1.2).
Waves of a spectrum therefore have T₀₁ = T̄/1.1; the regular wave of the simplified method has the period T̄.

Lost in the report and assumed: the layout, three lines a corner at 30, 45 and 60° off the x axis, fairleads at still
water; the area that goes with E = 7000 kgf/mm², both legs of the link; pretensions and waves of B, and those of A in
50 m.  24 and 36 lines are, as in the report, 12 of two and three times the weight, stiffness and strength.
"""

import math
from typing import NamedTuple

KINDS = ("chain", "buoy", "sinker")
FREQUENCIES = {"from": 0.06, "to": 2.0, "count": 60}  # rad/s, of a database, close enough for the memory of the water
INCIDENCE = 60.0  # degrees off the bow
KNOTS = 3.0
REPORTED = {"dynamic_lines": "none", "qtf": "newman"}  # how the report simulates: no motion of lines, no pairs of waves
OF_MEAN = 1 / 1.1  # T₀₁ over T̄
HEADINGS = [30, 45, 60]  # degrees off the x axis, of the lines of a corner
WEIGHT, STIFFNESS, STRENGTH = 406.0, 221_700.0, 1700.0  # kg/m in water, tonf, tonf of chain 142 mm
SINKER = 100.0  # t in water
STEEL = 7850.0  # kg/m³: the sinker's volume is that of steel


class Floater(NamedTuple):
    """length, beam, height, draft : m, of a box; gyration : m; buoy : diameter m, height m, mass t"""

    length: float
    beam: float
    height: float
    draft: float
    gyration: tuple[float, float, float]
    buoy: tuple[float, float, float]


FLOATERS = {
    "A": Floater(100.0, 50.0, 20.0, 10.0, (15.55, 29.44, 32.28), (6.0, 4.0, 15.0)),
    "B": Floater(200.0, 100.0, 30.0, 20.0, (30.55, 58.59, 64.55), (7.0, 4.5, 20.0)),
}
LENGTHS = {14: (220, 21, 175, 50, 220), 20: (260, 30, 200, 50, 260), 40: (370, 60, 270, 75, 370),
           50: (420, 75, 285, 50, 420), 100: (570, 150, 360, 75, 570)}  # fmt: skip
# m by depth: chain; buoy: above, below it; sinker: above, below it (Table 3.5.5.4)
PRETENSIONS = {14: 40.0, 20: 40.0, 40: 60.0, 50: 60.0, 100: 60.0}  # tonf, horizontal, by depth


class Case(NamedTuple):
    """One combination; depth, m; height : significant wave height, m; wind : mean speed, m/s; period : mean wave
    period, s

    name : floater, kind of line and changed value, such as A-chain-14m
    """

    name: str
    floater: str
    kind: str
    depth: float
    lines: int
    height: float
    wind: float
    period: float


BASES = {
    "A": Case("A", "A", "chain", 20.0, 12, 4.5, 50.0, 15.0),
    "B": Case("B", "B", "chain", 40.0, 12, 8.0, 50.0, 15.0),
}
CHANGES = {
    "A": {"base": {}, "14m": {"depth": 14.0}, "50m": {"depth": 50.0}, "Hs1.5": {"height": 1.5, "wind": 25.0},
          "Hs3": {"height": 3.0, "wind": 35.0}, "T10": {"period": 10.0}, "T20": {"period": 20.0}, "24": {"lines": 24},
          "36": {"lines": 36}},
    "B": {"base": {}, "100m": {"depth": 100.0}, "Hs6": {"height": 6.0, "wind": 35.0}},
}  # fmt: skip


def cases():
    """All 36 Cases"""
    return [
        BASES[floater]._replace(name=f"{floater}-{kind}-{word}", kind=kind, **change)
        for floater in FLOATERS
        for kind in KINDS
        for word, change in CHANGES[floater].items()
    ]


def scene(case):
    """Raw tables of the scene of a case's database"""
    f = FLOATERS[case.floater]
    body = {"shape": "box", "length": f.length, "beam": f.beam, "draft": f.draft, "center_of_gravity": [0.0, 0.0, 0.0],
            "gyration": list(f.gyration)}  # fmt: skip
    waves = {"omegas": FREQUENCIES, "headings_deg": {"from": 0, "to": 330, "count": 12}}
    return {"tolerance": 0.01, "water": {"depth": case.depth}, "bodies": [body], "waves": waves}


def study(case, hours, seeds):
    """Raw tables of the mooring study of a case; its simulation has a given number of seeds and hours"""
    f, times = FLOATERS[case.floater], case.lines / 12
    kind = {"weight_kg_per_m": WEIGHT * times, "axial_stiffness_tonf": STIFFNESS * times,
            "breaking_load_tonf": STRENGTH * times}  # fmt: skip
    spread = {"corner_headings_deg": HEADINGS, "pretension_tonf": PRETENSIONS[int(case.depth)] * times}
    off = {"incidence_deg": INCIDENCE}
    return {
        "allowable": 0.4,
        "water": {"depth": case.depth},
        "hull": {"length": f.length, "beam": f.beam, "draft": f.draft, "freeboard": f.height - f.draft},
        "types": {"chain": kind},
        "spreads": [spread | _line(case, f, times)],
        "wind": {"speed": case.wind, "gusts": "davenport", "surface_drag": 0.0015} | off,
        "current": {"speed_knots": KNOTS, "waves": "still"} | off,
        "waves": {"height": case.height, "period": OF_MEAN * case.period, "spectrum": "mitsuyasu_bretschneider"} | off,
        "simulation": {"duration_hours": hours, "seeds": seeds, "keep_series": 1, **REPORTED},
    }


def _line(case, floater, times):
    """Words of the line, from the anchor up"""
    chain, above_buoy, below_buoy, above_sinker, below_sinker = map(float, LENGTHS[int(case.depth)])
    if case.kind == "chain":
        return {"type": "chain", "length": chain}
    if case.kind == "buoy":
        diameter, height, mass = floater.buoy
        lengths, body = (below_buoy, above_buoy), (1e3 * mass, 0.25 * math.pi * diameter**2 * height)
    else:
        mass = 1e3 * SINKER / (1 - 1025 / STEEL)
        lengths, body = (below_sinker, above_sinker), (mass, mass / STEEL)
    segments = [{"type": "chain", "length": length} for length in lengths]
    mass, volume = (times * value for value in body)
    return {"segments": segments, "bodies": [{"after_segment": 1, "mass": mass, "volume": volume}]}
