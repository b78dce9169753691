"""`hakobune series lines`: the statements of section 3.1.7 of the SR179 report (1982) on charts 1.7.1 to 1.7.6."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.pipelines import cli
from hakobune.pipelines.validation.series.lines import HEIGHT, SHARES, WEIGHT, charts, curve, hills, statements


def test_every_statement_of_the_report_on_its_charts_is_so_here(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["series", "lines", "--output", "made"]) == 0
    told = capsys.readouterr().out.splitlines()
    assert sum(line.endswith(": so here") for line in told) == 7 and not any("NOT" in line for line in told)
    values = [line.split(",")[1:] for line in (tmp_path / "made" / "lines.csv").read_text().splitlines()
              if line.startswith("1.7.")]  # fmt: skip
    values = np.array(values, float)
    assert values.shape == (39, len(SHARES)) and np.all(np.isfinite(values)) and np.all(values >= 0)
    assert (tmp_path / "made" / "lines.png").stat().st_size > 1e4


@pytest.fixture(scope="module")
def made():
    return charts()


def catenary(share, scope, friction=None):
    """T/wL at the fairlead of an inextensible line, or at the anchor after friction: partly on the bed or all lifted"""
    L, Z, w = scope * HEIGHT, HEIGHT, WEIGHT
    X = share * math.sqrt(L**2 - Z**2)
    touch = brentq(lambda H: hung(H, Z, w)[1] + L - hung(H, Z, w)[0] - X, 1e-9, w * (L**2 - Z**2) / 2 / Z)
    if hung(touch, Z, w)[0] < L * (1 - 1e-6):
        if friction is None:
            return (touch + w * Z) / (w * L)
        return max(0.0, touch - friction * w * (L - hung(touch, Z, w)[0])) / (w * L)
    return None


def hung(H, Z, w):
    """Length and span of what hangs between bed and fairlead"""
    s = math.sqrt(Z * (Z + 2 * H / w))
    return s, H / w * math.asinh(w * s / H)


@pytest.mark.parametrize("scope", [3.26, 4, 6, 10])
def test_lines_on_a_flat_bed_are_catenaries_over_their_weight(made, scope):
    checked = 0
    for share in (SHARES[0], SHARES[20], SHARES[38], SHARES[60]):
        i = int(np.argmin(np.abs(SHARES - share)))
        try:
            at_fairlead = catenary(share, scope)
        except ValueError:
            continue  # all of it is lifted
        if at_fairlead is None:
            continue
        checked += 1
        assert curve(scope)[i] == pytest.approx(at_fairlead, rel=1e-6)
        if scope == 3.26:
            for friction in (0.0, 0.2, 1.0):
                held = made["1.7.1"][f"μ = {friction:g}"][i]
                assert held == pytest.approx(catenary(share, scope, friction), rel=1e-6, abs=1e-9)
        else:
            assert made["1.7.2"][f"L/Z = {scope:g}"][i] == pytest.approx(at_fairlead, rel=1e-6)
    assert checked >= (1 if scope == 10 else 2)


def changed(made, number, curves):
    name = f"1.7.{number + 1}"
    return made | {name: made[name] | curves(made[name])}


def swapped(first, second):
    return lambda curves: {first: curves[second], second: curves[first]}


SPOILED = [
    (0, swapped("μ = 0", "μ = 1"), [0]), (1, swapped("L/Z = 2", "L/Z = 10"), [1]),
    (2, swapped("tan β = −1/10", "tan β = 1/10"), [2]), (3, swapped("1 hill", "1 hollow"), [3]),
    (3, swapped("1 hill", "8 hills"), [3]), (3, swapped("8 hollows", "1 hollow"), [3]),
    (4, lambda curves: {"sinker 0.25 wL": 1.01 * curves["sinker 0.25 wL"]}, [4]),
    (4, lambda curves: {"sinker 0.25 wL": curves["plain"]}, [4]),
    (4, lambda curves: {"buoy 0.1 wL": 1.5 * curves["buoy 0.1 wL"]}, [5]),
    (4, lambda curves: {"buoy 1.25 wL": curves["plain"]}, [5]),
    (5, lambda curves: {"EA/wL = 2000": curves["EA/wL = inf"]}, [6]),
    (5, lambda curves: {"EA/wL = 2000": 0.5 * curves["EA/wL = 2000"]}, [6]),
]  # fmt: skip


@pytest.mark.parametrize("number, curves, wrong", SPOILED)
def test_statements_that_are_not_so_are_told(made, number, curves, wrong):
    said = statements(changed(made, number, curves))
    assert [i for i, line in enumerate(said) if line.endswith(": NOT so here")] == wrong
    assert len(said) == 7 and all(line.endswith("so here") for line in said)


def test_hills_and_hollows_fill_the_scope_at_one_steepness():
    """Two hills over 120 m: 3 m high, each 60 m long; slopes of a tenth"""
    points = np.asarray(hills(2, True).points)
    assert points == pytest.approx(np.array([[0, 0], [30, 3], [60, 0], [90, 3], [120, 0]]))
    assert np.asarray(hills(1, False).points) == pytest.approx(np.array([[0, 0], [60, -6], [120, 0]]))
