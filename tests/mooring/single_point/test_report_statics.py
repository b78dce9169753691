"""Statics of the report's single-point series: catenary identities, scope, head-on forces and oblique currents."""

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from boxes import TONF, buoy, floater_A
from scipy.optimize import brentq

from mooring.catenary import solve_lines
from mooring.single_point.body import SinglePoint
from mooring.single_point.equilibria import equilibria
from mooring.single_point.scope import length_without_uplift, peak

SERIES = Path(__file__).parents[3] / "pipelines" / "series" / "single_point.csv"
FLOATERS = {"A": (3.0, (0.02856, 4.988, 20.74), 14.0, 12.0), "B": (6.0, (0.05999, 8.314, 76.40), 40.0, 20.0)}
LEFT = {"A": 1.3, "B": 2.4}  # tonf
LONG = 200  # depths; the report does not tell, and of long lines the direction does not change
OUT_OF_LINE = {"A10", "B25", "B26", "B74"}  # scopes, a tension, and a force 2 % from that of a case of equal load
# lines of ordinary scope carry A's headings; those of the rows whose 12 lines are not halved in print are left out
OBLIQUE = {"A54", "A55", "A56", "A57", "A65", "A66", "A67", "A68"}


def series():
    lines = [line for line in SERIES.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def number(row, name):
    return float(row[name])


def together(row):
    """Lines of the series that stand for one of the six that were computed: 1, 2 or 3"""
    return int(row["lines"]) // 6


def held(row, tension=None):
    """System of the six lines of a row, each as heavy as those that it stands for"""
    n = together(row)
    draft = FLOATERS[row["floater"]][0]
    weight, pretension = (n * number(row, name) * TONF for name in ("weight_ton_m", "pretension_ton"))
    return buoy(depth=number(row, "depth_m"), z=-draft, weight=weight, tension=pretension,
                length=LONG * number(row, "depth_m"))  # fmt: skip


def test_lines_keep_the_report_s_catenary_identities():
    """3.6.14 slack, 3.6.15 tangent and 3.6.16 taut, with a = T_H/w, to 1e-12 of lengths and their squares"""
    rng = np.random.default_rng(1)
    V, w, scope = rng.uniform(5, 100, 500), rng.uniform(50, 5000, 500), rng.uniform(1.5, 20, 500)
    S0 = V * scope
    taut = np.sqrt(S0**2 - V**2)  # the span at which an inextensible line is straight
    H = np.maximum(S0 - V, 0) + rng.uniform(0, 1, 500) * (taut - (S0 - V)) * 0.9999
    found = solve_lines(H, V, S0, w, np.inf)
    a, lies = found.horizontal_fairlead / w, found.grounded_length > 0
    assert 50 < lies.sum() < 495
    arc = np.sqrt(V * (V + 2 * a))
    gap = np.where(lies, a * np.arccosh(1 + V / a) - arc - (H - S0), 0.0)
    assert np.abs(gap / S0).max() < 1e-12
    assert np.abs(np.where(lies, found.vertical_fairlead / (w * arc) - 1, 0)).max() < 1e-12
    S0, V, a, H, w, arc = (v[~lies] for v in (S0, V, a, H, w, arc))
    assert np.abs((S0**2 - V**2 - 4 * a**2 * np.sinh(H / (2 * a)) ** 2) / S0**2).max() < 1e-12
    tangent = length_without_uplift(w * (a + V), w, V)  # of a line that has its vertex at the anchor
    assert np.allclose(tangent, arc, rtol=1e-12)


@pytest.mark.parametrize("floater", ["A", "B"])
def test_scope_without_uplift_is_that_of_the_report_s_tables(floater):
    """To the rounding of the printed scope and tensions"""
    rows = [r for r in series() if r["scope"] and r["floater"] == floater and r["case"] not in OUT_OF_LINE]
    assert len(rows) > 10
    for row in rows:
        depth, weight = number(row, "depth_m"), number(row, "weight_ton_m")
        T = peak(number(row, "static_ton"), number(row, "significant_ton"))
        V = depth - FLOATERS[floater][0]
        scope = length_without_uplift(T, weight, V) / depth
        rounding = length_without_uplift(T + 0.5 / 2 * 3, weight, V) / depth - scope
        assert abs(scope - number(row, "scope")) < 0.05 + rounding, row["case"]


def total_force(row):
    """tonf on the buoy at which its leading line carries the printed static tension"""
    lines = held(row)
    point = SinglePoint(floater_A().loads, np.eye(3), [(0, 0)], [0.0], lines)
    wanted = together(row) * number(row, "static_ton") * TONF

    def leading(force):
        return float(point.buoy_under(np.array([-force, 0.0])).tension.max()) - wanted

    return brentq(leading, 1e3, 5 * wanted, rtol=1e-6) / TONF


@pytest.mark.parametrize("floater", ["A", "B"])
def test_head_on_tensions_of_the_series_follow_one_law_of_force(floater):
    """F = c_w U² + c_d H² + F_c (V/1.5 kn)² whatever the pretension and the number of lines

    To 1.3 t and the rounding of the tension; six lines of B under the largest loads lie up to 3.2 t, 0.8 %, above,
    while twelve under the same load lie 0.7 t below: printed tensions of equal loads differ by more than rounding.
    """
    c_wind, c_drift, c_current = FLOATERS[floater][1]
    depth = FLOATERS[floater][2]
    rows = [r for r in series() if r["floater"] == floater and number(r, "depth_m") == depth and r["static_ton"]
            and r["case"] not in OUT_OF_LINE and (r["current_deg"] in ("", "0"))]  # fmt: skip
    assert len(rows) > 8
    for row in rows:
        law = (c_wind * number(row, "wind_m_s") ** 2 + c_drift * number(row, "height_m") ** 2
               + c_current * (number(row, "current_kn") / 1.5) ** 2)  # fmt: skip
        assert abs(total_force(row) - law) < LEFT[floater] + rounding(row), (row["case"], total_force(row), law)


def rounding(row):
    """tonf that half a ton of the printed tension leaves open on two leading lines at 30°"""
    return 0.5 * together(row) * 2 * np.cos(np.radians(30))


@pytest.mark.parametrize("case", sorted(OBLIQUE))
def test_headings_in_an_oblique_current_are_those_of_the_series(case):
    """Within 5°, tensions within 7 %, as the report has them without a moment of the wind (with it 3 to 8° more)"""
    row = next(r for r in series() if r["case"] == case)
    point = floater_A(number(row, "current_deg"), 25.0 if row["system"] == "buoy" else 0.0)
    point = replace(point, system=held(row), loads=without_wind_moment(point.loads))
    found = [one for one in equilibria(point) if one.slewing.stable]
    assert len(found) == 1
    assert abs(np.degrees(found[0].heading) - number(row, "heading_deg")) < 5
    printed = number(row, "static_ton")
    assert abs(found[0].lines.tension.max() / TONF - printed) < 0.07 * printed + 0.5  # and its rounding


def without_wind_moment(loads):
    return replace(loads, wind=replace(loads.wind, table=loads.wind.table * np.array([1.0, 1.0, 0.0])))
