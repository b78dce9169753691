"""The simplified dynamic tension against its limits, and its stiffness against the static line."""

import numpy as np
import pytest

from mooring.lines.catenary.solve import solve_lines
from mooring.lines.regimes import Regime, catenary_stiffness, centroid_height, harmonic_tension

CHAIN = dict(weight=979.3, mass=114.94, diameter=0.1368)


def test_catenary_stiffness_is_that_of_the_static_line():
    x, z, length, w = 280.0, 50.0, 300.0, 979.3
    line = solve_lines(x, z, length, w)
    H, V = float(line.horizontal_fairlead), float(line.vertical_fairlead)
    C = catenary_stiffness(H, H / w * np.arcsinh(V / H), w)
    assert np.allclose([[C.xx, C.xz], [C.xz, C.zz]], line.stiffness, rtol=1e-7)


def test_centroid_height_is_the_mean_height_of_the_catenary():
    H, w, span = 2e5, 979.3, 160.0
    nodes, weights = np.polynomial.legendre.leggauss(40)
    x = 0.5 * span * (1 + nodes)
    arc = 0.5 * span * weights * np.cosh(w * x / H)
    assert np.isclose(centroid_height(H, span, w), np.sum(arc * H / w * (np.cosh(w * x / H) - 1)) / arc.sum())


def test_slow_motion_gives_the_static_tension_and_is_called_so():
    found = harmonic_tension(285.0, 50.0, 300.0, amplitude=(0.1, 0.02), period=500.0, **CHAIN)
    ahead = solve_lines(285.1, 50.02, 300.0, CHAIN["weight"])
    assert found.regime == Regime.QUASI_STATIC
    step = ahead.vertical_fairlead - found.mean[1]
    # the formula is the tangent; what is left is the curvature, of second order in 0.1 m over 5 m to the taut state
    assert np.isclose(found.cosine[1], step, rtol=0.05)


def test_the_regimes_follow_each_other_as_the_period_falls():
    periods = (200.0, 5.0, 2.5, 1.5, 1.0, 0.7)
    found = [harmonic_tension(280.0, 50.0, 300.0, amplitude=(1.5, 0.0), period=T, **CHAIN) for T in periods]
    regimes = [f.regime for f in found]
    assert regimes == sorted(regimes)
    assert regimes[0] == Regime.QUASI_STATIC and regimes[-1] == Regime.FREE_FALL


def test_at_the_slack_boundary_the_dynamic_force_is_the_submerged_weight():
    found = harmonic_tension(280.0, 50.0, 300.0, amplitude=(1.5, 0.0), period=10.0, **CHAIN)
    # inertia and drag both grow with ω², so the boundary is reached at one period
    T = 10.0 * np.sqrt(found.acceleration / found.slack)
    at = harmonic_tension(280.0, 50.0, 300.0, amplitude=(1.5, 0.0), period=T, **CHAIN)
    still = harmonic_tension(280.0, 50.0, 300.0, amplitude=(1.5, 0.0), period=1e6, **CHAIN)
    force = np.hypot(at.cosine[1] - still.cosine[1], at.sine[1])
    assert np.isclose(force, at.mean[1], rtol=1e-6)


def test_a_line_without_a_part_on_the_bed_is_refused():
    with pytest.raises(ValueError, match=r"z = 50 ± 0 m does not keep a part on the bed"):
        harmonic_tension(295.5, 50.0, 300.0, amplitude=(0.1, 2e-15), period=10.0, **CHAIN)
    with pytest.raises(ValueError, match="period is 0"):
        harmonic_tension(280.0, 50.0, 300.0, amplitude=(0.1, 0.0), period=0.0, **CHAIN)
