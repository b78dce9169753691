"""One line between an anchor and a fairlead: which solver it asks, and the spans of its curve from slack to taut."""

import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines import one_line
from hakobune.mooring.lines.catenary import buoyant, solve
from hakobune.mooring.lines.catenary.solve import LineSolution
from hakobune.mooring.lines.catenary.state import LineError
from hakobune.mooring.lines.multi_segment import span as of_spans
from hakobune.mooring.lines.one_line import NEAR_SHORE, OneLine, _span_over_bed, tension_curve


def made(weight=500.0, EA=1e8, breaking=2e6, length=100.0, height=20.0, slope=0.0):
    kind = SimpleNamespace(weight=weight, axial_stiffness=EA, breaking_load=breaking)
    return OneLine(kind, length, height, 30.0, 0.7, slope)


def test_a_line_asks_the_solver_of_its_bed_or_of_the_surface_it_floats_in(monkeypatch):
    """A heavy one with friction and slope of the bed, a light one with the surface above its anchor"""
    for module, name in ((solve, "solve_lines"), (buoyant, "solve_buoyant_lines"), (solve, "profile"),
                         (buoyant, "buoyant_profile"), (solve, "span_at_tension"), (of_spans, "span_of")):  # fmt: skip
        monkeypatch.setattr(module, name, lambda *given, name=name, **more: [7.0, name, given, more])
    heavy, light = made(slope=0.1), made(weight=-50.0)
    assert heavy.solve(90.0)[1:3] == ["solve_lines", (90.0, 20.0, 100.0, 500.0, 1e8, 0.7, 0.1)]
    assert light.solve(90.0)[1:3] == ["solve_buoyant_lines", (90.0, 20.0, 100.0, -50.0, 1e8, 30.0)]
    assert heavy.shape(90.0, 11)[1:] == ["profile", (90.0, 20.0, 100.0, 500.0, 1e8, 0.7, 0.1), {"points": 11}]
    assert light.shape(90.0, 11)[1:] == ["buoyant_profile", (90.0, 20.0, 100.0, -50.0, 1e8, 30.0), {"points": 11}]
    assert heavy.span_at(3e3) == 7.0
    assert light.span_at(3e3)[1:3] == ["span_of", (light.solve, 3e3, 100.0, 20.0)]
    monkeypatch.setattr(solve, "span_at_tension", lambda *given: [given[0] + given[1]])
    assert heavy.span_at(3e3) == 3020.0
    states = [one.state(SimpleNamespace(status=1)) for one in (heavy, light)]
    assert states == ["partly on the bed", "partly in the sea surface"] and not heavy.floats and light.floats


def curve(monkeypatch, one, span_at=lambda H: H / 1e4, **more):
    asked = []
    monkeypatch.setattr(OneLine, "span_at", lambda self, H: asked.append(H) or span_at(H))
    monkeypatch.setattr(OneLine, "solve", lambda self, spans: ("solved", spans))
    spans, found = tension_curve(one, **more)
    assert found == ("solved", spans) or found[1] is spans
    return spans, asked


def test_a_curve_goes_from_a_thousandth_of_the_weight_to_eight_tenths_of_the_breaking_load(monkeypatch):
    """Half of its points in the last tenth; the weight of its height, or of a hundredth of its length"""
    spans, asked = curve(monkeypatch, made(), points=20)
    assert asked == [1e-3 * 500 * 20, 0.8 * 2e6] and len(spans) == 20
    assert spans[[0, -1]] == pytest.approx([1e-3, 160.0]) and np.sum(spans >= 0.9 * 160.0) == 10
    assert np.ptp(np.diff(spans[:10])) < 1e-9 and np.ptp(np.diff(spans[10:])) < 1e-9
    assert curve(monkeypatch, made(height=-0.5), points=20)[1][0] == pytest.approx(1e-3 * 500 * 1.0)
    assert curve(monkeypatch, made(weight=-50.0, breaking=np.inf), points=20)[1][1] == pytest.approx(20 * 50 * 100)
    longer, _ = curve(monkeypatch, made(), points=21, span=170.0)
    assert longer[-1] == pytest.approx(170.0) and len(longer) == 21
    assert curve(monkeypatch, made(), points=21, span=100.0)[0][-1] == pytest.approx(160.0)


def test_a_curve_of_a_line_that_does_not_stretch_ends_before_it_is_straight(monkeypatch):
    """√(100² − 20²) = 97.98 m on a level bed"""
    spans, _ = curve(monkeypatch, made(EA=np.inf), points=40)
    assert 80.0 < spans[-1] < np.sqrt(9600.0) and len(spans) < 40
    assert len(curve(monkeypatch, made(EA=np.inf, slope=-0.1), points=40)[0]) == 40
    assert len(curve(monkeypatch, made(EA=1e9), points=40)[0]) == 40


@pytest.mark.parametrize("slope, span, found", [
    (0.0, 50.0, 50.0), (0.0, -3.0, 0.0), (0.1, 50.0, 50.0), (0.1, 500.0, (1 - NEAR_SHORE) * 200.0),
    (-0.1, 500.0, 500.0), (-0.1, 50.0, (1 + NEAR_SHORE) * 200.0), (0.1, None, (1 - NEAR_SHORE) * 200.0),
    (-0.1, None, (1 + NEAR_SHORE) * 200.0),
])  # fmt: skip
def test_a_span_ends_just_before_the_bed_is_as_high_as_the_fairlead(slope, span, found):
    def span_at(H):
        if span is None:
            raise LineError("out of reach")
        return span

    assert _span_over_bed(SimpleNamespace(slope=slope, span_at=span_at), 1e3, 200.0) == pytest.approx(found)


def test_the_shore_of_a_curve_is_where_its_bed_reaches_the_fairlead(monkeypatch):
    """20 m at 0.1 rad"""
    seen = []
    monkeypatch.setattr(one_line, "_span_over_bed", lambda one, H, shore: seen.append(shore) or H)
    monkeypatch.setattr(OneLine, "solve", lambda self, spans: None)
    tension_curve(made(slope=0.1))
    tension_curve(made())
    assert seen == pytest.approx([20 / np.tan(0.1)] * 2 + [np.inf] * 2)


@pytest.mark.parametrize("weight, EA, height, span", [
    (500.0, 1e8, 20.0, 85.0), (500.0, np.inf, 20.0, 97.9), (500.0, 2e5, 20.0, 130.0), (500.0, 1e8, 0.0, 100.02),
    (-50.0, 1e6, 12.0, 90.0),
])  # fmt: skip
def test_a_line_without_the_compiler_is_the_one_with_it(weight, EA, height, span):
    one, kind = made(weight, EA, height=height), LineSolution._fields
    asked = span, height, 100.0, weight, EA
    compiled = (
        buoyant.solve_buoyant_lines(*asked, one.depth) if one.floats else solve.solve_lines(*asked, one.friction, 0.0)
    )
    for name, found, other in zip(kind, one.solve(span), compiled, strict=True):
        assert found == pytest.approx(other, rel=1e-12), name
    assert one.span_at(float(compiled.horizontal_fairlead)) == pytest.approx(span, rel=1e-9)
    assert one.shape(span, 9)[-1] == pytest.approx([span, height], rel=1e-9, abs=1e-9)


def test_one_line_needs_no_compiler():
    script = "import hakobune, sys; hakobune.line(weight=4e3, length=260.0, depth=20.0, tension=4e5, {}); "
    script += "sys.exit('numba' in sys.modules)"
    for more in ("", "characteristic=True, slope=-0.02, friction=0.5, stiffness=1e9"):
        assert not subprocess.run([sys.executable, "-c", script.format(more)], timeout=120).returncode
