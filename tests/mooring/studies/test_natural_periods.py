"""Natural periods: exact cases and bounds."""

from dataclasses import dataclass

import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.database.natural_periods import natural_periods
from hakobune.mooring.lines.system.moored_body import corner_legs, moored_body
from hakobune.mooring.lines.system.parts import LineType, UniformLine

OMEGA = np.linspace(0.1, 2.0, 20)


@dataclass
class Floating:
    """What natural periods ask of a `bem.database.reader.Reader`: added mass straight between OMEGA, held outside"""

    added_mass: np.ndarray
    inertia: np.ndarray
    stiffness: np.ndarray
    zero: np.ndarray | None = None
    omega, names, bodies, free, turning = OMEGA, DOFS, (), None, np.arange(6) > 2

    def _known(self):
        if self.zero is None:
            return OMEGA, self.added_mass
        return np.append(0.0, OMEGA), np.concatenate([[self.zero], self.added_mass])

    def held_added_mass(self, omega):
        w, A = self._known()
        return np.moveaxis([[np.interp(omega, w, A[:, i, j]) for j in range(6)] for i in range(6)], 2, 0)

    def knows_added_mass(self, omega):
        w, _ = self._known()
        return (omega >= w[0]) & (omega <= w[-1])


def test_uncoupled_body_has_the_period_of_each_spring():
    inertia = np.diag([1e6, 1e6, 1e6, 1e8, 2e8, 3e8])
    stiffness = np.diag([1e4, 4e4, 5e5, 3e7, 9e7, 1e7])
    added = np.broadcast_to(0.5 * inertia, (20, 6, 6))
    found = natural_periods(Floating(added, inertia, stiffness))
    exact = 2 * np.pi * np.sqrt(1.5 * np.diag(inertia) / np.diag(stiffness))
    assert np.allclose(found.period, exact, rtol=1e-8)
    assert np.allclose(np.abs(found.shapes), np.eye(6), atol=1e-8)


def test_added_mass_is_that_of_the_natural_frequency_itself():
    """A(ω) = a + bω is linear, so interpolation is exact and ω²(M + a + bω) = C is a cubic."""
    inertia = np.diag([1e6] * 3 + [1e8] * 3)
    added = np.array([np.diag([2e5 + 3e5 * w] * 3 + [1e7] * 3) for w in OMEGA])
    stiffness = np.diag([2e5, 4e5, 1e6, 3e7, 3e7, 3e7])
    found = natural_periods(Floating(added, inertia, stiffness))
    for i in range(3):
        w = 2 * np.pi / found.period[i]
        assert np.isclose(w * w * (1.2e6 + 3e5 * w), stiffness[i, i], rtol=1e-7)
    assert found.inside[:3].all()


def test_every_mode_satisfies_the_eigenvalue_problem():
    rng = np.random.default_rng(2)
    scale = np.array([1, 1, 1, 30, 30, 30])
    A, C = (rng.normal(size=(6, 6)) for _ in range(2))
    inertia = 1e6 * np.diag(scale**2)
    base = 3e5 * (A @ A.T + np.eye(6)) * np.outer(scale, scale)
    stiffness = 4e5 * (C @ C.T + 0.5 * np.eye(6)) * np.outer(scale, scale)
    added = np.array([base / (1 + w) for w in OMEGA])
    found = natural_periods(Floating(added, inertia, stiffness))
    for period, shape, inside in zip(found.period, found.shapes, found.inside, strict=True):
        w = 2 * np.pi / period
        at = np.array([[np.interp(w, OMEGA, added[:, i, j]) for j in range(6)] for i in range(6)])
        unit = np.array([1, 1, 1] + [found.scale] * 3)
        q = shape / unit
        left = stiffness @ q - w * w * (inertia + at) @ q
        assert np.abs(left / unit).max() < 1e-6 * np.abs(stiffness @ q / unit).max(), inside
    assert len(set(np.round(found.period, 6))) == 6


def test_body_without_restoring_has_an_infinite_period_and_an_unstable_one_none():
    inertia = np.diag([1e6] * 3 + [1e8] * 3)
    found = natural_periods(Floating(np.zeros((20, 6, 6)), inertia, np.diag([0, 0, 1e6, -1e6, 1e7, 0])))
    assert np.isinf(found.period[[0, 1, 5]]).all()
    assert np.isnan(found.period[3])
    assert np.allclose(found.period[[2, 4]], 2 * np.pi * np.array([1, np.sqrt(10)]), rtol=1e-8)


def test_limit_of_zero_frequency_is_used_below_the_lowest():
    inertia, zero = np.diag([1e6] * 3 + [1e8] * 3), np.diag([1e6] * 3 + [1e8] * 3)
    added = np.zeros((20, 6, 6))
    stiffness = np.diag([1.0, 1e5, 1e6, 1e8, 1e8, 1e8])
    slow = 2 * np.pi / natural_periods(Floating(added, inertia, stiffness, zero)).period[0]
    assert np.isclose(slow**2 * (1e6 + 1e6 * (1 - slow / OMEGA[0])), 1.0, rtol=1e-6)
    held = natural_periods(Floating(added, inertia, stiffness))
    assert np.isclose(2 * np.pi / held.period[0], 1e-3, rtol=1e-8)
    assert not held.inside[0]


def test_model_barge_on_chains_has_nearly_its_measured_surge_period():
    """SR179 report, appendix 1, tables 1.1 to 1.3: M3B on four chains at 45°, measured surge period 16.48 s.

    The rigid mass alone bounds the period of the measured pretension from below and added mass of a fifth from
    above; the measured motions are not small and stiffen the chains, which shortens the period by some per cent.
    """
    weight, tension = 0.871 * 9.80665, 2.78 * 9.80665
    chain = UniformLine("chain", LineType("chain", weight), 7.53, "anchor", "fairlead")
    lines = moored_body(corner_legs(chain, 3.872, 1.936, [np.pi / 4], 1.2, tension - 1.2 * weight), 1.2)
    mass = 1451.0
    inertia = mass * np.diag([1, 1, 1, 0.674**2, 1.12**2, 1.408**2])
    hydrostatic = np.diag([0, 0, 7.35e4, 2e4, 9e4, 0])
    total = hydrostatic + lines.load().stiffness
    low = natural_periods(Floating(np.zeros((20, 6, 6)), inertia, total)).period[0]
    high = natural_periods(Floating(np.broadcast_to(0.2 * inertia, (20, 6, 6)), inertia, total)).period[0]
    assert 0.9 * low < 16.48 < high


def test_the_water_of_a_moonpool_leaves_a_body_its_periods():
    """ω² (M + a + b / (w² − ω²)) = C is a quadratic in ω²; from w to √(w² + b/(M + a)) the mass is below 0"""
    inertia, a, b, w = np.diag([1e6] * 3 + [1e8] * 3), 4e5, 2e5, 1.0

    class Moonpool(Floating):
        def held_added_mass(self, omega):
            out = np.tile(np.diag([a] * 3 + [1e7] * 3), (len(omega), 1, 1))
            out[:, 2, 2] += b / (w * w - np.asarray(omega) ** 2)
            return out

    C = np.diag([1e4, 1e4, 1e6, 3e7, 3e7, 3e7])
    found = natural_periods(Moonpool(np.zeros((20, 6, 6)), inertia, C))
    M, C = 1e6 + a, 1e6
    square = np.roots([-M, M * w * w + b + C, -C * w * w]).min()
    assert np.isclose(found.period[2], 2 * np.pi / np.sqrt(square), rtol=1e-7)
