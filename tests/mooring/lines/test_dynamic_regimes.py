"""The simplified dynamic tension against its limits, and its stiffness against the static line."""

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.regimes import Regime, catenary_stiffness, centroid_height, harmonic_tension

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
    with pytest.raises(ValueError, match=r"z = 50 ± 0 m does not always have a part on the bed"):
        harmonic_tension(295.5, 50.0, 300.0, amplitude=(0.1, 2e-15), period=10.0, **CHAIN)
    with pytest.raises(ValueError, match="period is 0"):
        harmonic_tension(280.0, 50.0, 300.0, amplitude=(0.1, 0.0), period=0.0, **CHAIN)


def test_the_simplified_tension_is_that_of_the_report_by_hand():
    """SR179 report (1982), eq. 3.2.1 to 3.2.11, of an inextensible catenary built from its horizontal tension:

    F₁ = ω² (m + C_A ρ π D²/4) S₀ Z_m,  F₂ = 4 ρ C_d D S₀ cos³θ_m Z_m² ω² / 3π,  tan θ_m = z / span,
    T_v = V + (C_xz X + C_zz Z − F₁) cos ωt − F₂ sin ωt,  horizontal parts H/V of it,
    Z_m from the height of the centroid, ∫ y ds / S₀, at rest and outermost."""
    w, m, D, rho, cd, ca, T = 979.3, 114.94, 0.1368, 1025.0, 1.2, 1.0, 9.0
    H0, span = 1.6e5, 160.0
    c = H0 / w
    z = c * (np.cosh(span / c) - 1)
    S0 = c * np.sinh(span / c)
    lying = 120.0
    x, length = lying + span, lying + S0
    out, up = 0.9, -0.3

    def hanging(c, z):
        return c * np.arccosh(1 + z / c)  # horizontal length

    def reach(c, z):  # of the whole line at tension w c, touching the bed
        l = hanging(c, z)
        return length - c * np.sinh(l / c) + l

    def centroid(c, z):
        s = np.linspace(0.0, c * np.sinh(hanging(c, z) / c), 20001)
        return np.trapezoid(np.sqrt(c * c + s * s) - c, s) / s[-1]

    far = brentq(lambda c: reach(c, z + up) - x - out, 0.5 * c, 5 * c, xtol=1e-12)
    rise = abs(centroid(far, z + up) - centroid(c, z))
    step = 1e-4
    V = [
        w * k * np.sinh(hanging(k, z + b) / k)
        for a, b in ((step, 0), (-step, 0), (0, step), (0, -step))
        for k in [brentq(lambda c, a=a, b=b: reach(c, z + b) - x - a, 0.5 * c, 5 * c, xtol=1e-13)]
    ]
    static = (V[0] - V[1]) / (2 * step) * out + (V[2] - V[3]) / (2 * step) * up
    omega, water = 2 * np.pi / T, rho * np.pi / 4 * D**2
    F1 = omega**2 * (m + ca * water) * S0 * rise
    cos = span / np.hypot(span, z)
    F2 = 4 * rho * cd * D * S0 * cos**3 * rise**2 * omega**2 / (3 * np.pi)
    found = harmonic_tension(x, z, length, w, m, D, (out, up), T, drag=cd, added_mass=ca, density=rho, gravity=9.81)
    assert found.mean == pytest.approx([H0, w * S0], rel=1e-6)
    assert found.cosine[1] == pytest.approx(static - F1, rel=1e-4)
    assert found.sine[1] == pytest.approx(F2, rel=1e-4)
    assert found.cosine[0] / found.cosine[1] == pytest.approx(H0 / (w * S0), rel=1e-6)
    largest = np.hypot(H0, w * S0) * (1 + np.hypot(static - F1, F2) / (w * S0))
    assert found.largest == pytest.approx(largest, rel=1e-4)
    # α and its boundaries, 3.2.9 and 3.2.10
    assert found.acceleration == pytest.approx(omega**2 * rise / 9.81, rel=1e-4)
    assert found.harmonic == pytest.approx(2 * abs(static) / (9.81 * (m + ca * water) * S0), rel=1e-4)
    alone = np.hypot(1 + ca * water / m, F2 / omega**2 / (m * S0 * rise))
    assert found.slack == pytest.approx(w / (m * 9.81) / alone, rel=1e-4)
