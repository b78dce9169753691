"""Domain decomposition of boxes and cylinders against the exact cylinder, itself, laws and the panel method."""

from functools import lru_cache

import numpy as np
import pytest
from exact.truncated_cylinder import TruncatedCylinder

from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.drift import energy_defect, mean_drift
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.kochin import angles
from hakobune.bem.methods.panel_problem import PanelProblem, prepare
from hakobune.bem.waves import group_factor, wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box

RHO, G = 1025.0, 9.80665
HEADINGS = np.array([0.0, 0.6, np.pi / 2])


def frequency(kh, depth):
    return np.sqrt(G * kh / depth * np.tanh(kh))


class Solved:
    """One frequency with the quantities that are compared"""

    def __init__(self, body, omega, headings=HEADINGS):
        m, self.omega = len(headings), omega
        self.k = float(wavenumber(omega, body.depth))
        self.n = float(group_factor(self.k, body.depth))
        self.theta = angles(self.k, body.plan.reach)
        r = self.first = body.first_order(omega, headings, np.append(self.theta, headings), range(6), RHO, G)
        self.Z, self.force = r.radiation, r.froude_krylov + r.diffraction
        size = np.sqrt(np.abs(np.diag(self.Z)))
        self.size = np.where(size > 1e-9 * size.max(), size, np.inf)  # yaw of a cylinder moves no water
        self.H, self.slope = (h[:, :-m] for h in r.kochin_diffraction)
        forward = r.kochin_diffraction[:, np.arange(m), np.arange(m) - m]
        self.forward = forward[0]
        self.drift = mean_drift(self.H, self.slope, *forward, self.theta, headings, self.k, self.n, RHO, G)
        self.arms = np.repeat([1.0, body.plan.reach], 3)
        largest = np.abs(self.force / self.arms).max(axis=0)
        self.scale = self.arms * np.maximum(largest, 0.2 * largest.max())

    def error(self, Z, force, drift):
        """Largest relative difference from other results"""
        return max(
            np.max(np.abs(self.Z - Z) / np.outer(self.size, self.size)),
            np.max(np.abs(self.force - force) / self.scale),
            np.max(np.abs(self.drift - drift)[:, :2]) / np.abs(self.drift[:, :2]).max(),
        )

    def defects(self):
        """Largest relative violation of reciprocity, Haskind (twice) and energy (scattered, radiated)"""
        H = self.first.kochin_radiation[0][:, : len(self.theta)]
        power = RHO * G * self.n / (np.pi * self.k**2) * 4 * np.pi * (H @ H.conj().T).real / len(self.theta)
        square = np.outer(self.size, self.size)
        return {
            "reciprocity": np.max(np.abs(self.Z - self.Z.T) / square),
            "Haskind": np.max(np.abs(self.force - self.first.haskind) / self.scale),
            "scattered": np.max(np.abs(energy_defect(self.H, self.forward))),
            "radiated": np.max(np.abs(power / self.omega**2 - self.Z.imag) / square),
        }


@lru_cache
def exact(radius, draft, depth, omega):
    """A + iB/ω, excitation and drift of the fixed cylinder"""
    body = TruncatedCylinder(radius, draft, depth, omega, RHO, G)
    force = np.array([body.excitation(b) for b in HEADINGS])
    drift = np.array([[*body.drift_fixed(b), 0.0] for b in HEADINGS])
    return body.added_mass() + 1j * body.damping() / omega, force, drift


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
@pytest.mark.parametrize(
    "radius, draft, depth", [(10, 10, 10.2), (10, 10, 12), (10, 10, 30), (10, 10, 100), (50, 10, 12), (5, 10, 20)]
)
def test_cylinder_is_exact_to_the_tolerance(radius, draft, depth, tolerance):
    body = prepare_cylinder(radius, draft, depth, tolerance)
    for kh in (0.05, 0.5, 2.0, 20.0):
        omega = frequency(kh, depth)
        ours = Solved(body, omega)
        assert ours.error(*exact(radius, draft, depth, omega)) < tolerance, kh
        assert max(ours.defects().values()) < 1e-8  # they hold whatever the truncation


BOXES = [(100, 50, 10, 12), (100, 50, 10, 20), (100, 50, 10, 100), (50, 50, 10, 20), (400, 50, 10, 20)]


@pytest.mark.parametrize("dimensions", [BOXES[0], BOXES[2], BOXES[4]])
def test_box_converges_as_its_tolerances_say(dimensions):
    """Against a tenth of the finest tolerance"""
    fine = Solved(prepare_box(*dimensions, tolerance=1e-7), 0.7)
    for tolerance in (1e-6, 1e-4, 1e-3):
        ours = Solved(prepare_box(*dimensions, tolerance=tolerance), 0.7)
        assert fine.error(ours.Z, ours.force, ours.drift) < tolerance, tolerance


@pytest.mark.parametrize("dimensions", BOXES)
def test_laws_hold_for_boxes(dimensions):
    body = prepare_box(*dimensions, tolerance=1e-6)
    for omega in (0.1, 0.5, 1.0):
        defects = Solved(body, omega).defects()
        assert max(defects.values()) < 1e-8, defects  # they hold as far as the maps of the plan are right


def test_exciting_force_is_the_radiated_wave_by_haskind():
    """F(β) = 4ρg C_g H(β + π) / (iωk) · (−1), H per unit amplitude of motion, sent against the waves"""
    body, omega, beta = prepare_box(100, 50, 10, 20, 1e-6), 0.7, 0.6
    k = float(wavenumber(omega, 20.0))
    r = body.first_order(omega, [beta], [beta + np.pi])
    group = float(group_factor(k, 20.0)) * omega / k
    force = -4 * RHO * G * group / k * r.kochin_radiation[0][:, 0] / (-1j * omega)
    ours = (r.froude_krylov + r.diffraction)[0]
    np.testing.assert_allclose(ours, force, rtol=1e-7, atol=1e-7 * np.abs(force).max())


def test_kochin_slopes_are_derivatives():
    """H is a trigonometric polynomial in effect: differentiate it by Fourier"""
    ours = Solved(prepare_box(100, 50, 10, 20, 1e-5), 0.6)
    m = np.fft.fftfreq(len(ours.theta), 1 / len(ours.theta))
    fourier = np.fft.ifft(1j * m * np.fft.fft(ours.H, axis=1), axis=1)
    assert np.abs(fourier - ours.slope).max() < 1e-6 * np.abs(ours.slope).max()


def test_a_box_turned_by_a_quarter_does_the_same():
    turn = np.kron(np.eye(2), [[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    along, across = prepare_box(100, 50, 10, 20, 1e-6), prepare_box(50, 100, 10, 20, 1e-6)
    ours, turned = (b.first_order(0.6, [a]) for b, a in ((along, 0.4), (across, 0.4 + np.pi / 2)))
    size = np.sqrt(np.abs(np.diag(ours.radiation)))
    assert np.max(np.abs(turn.T @ turned.radiation @ turn - ours.radiation) / np.outer(size, size)) < 1e-6
    np.testing.assert_allclose(turned.diffraction[0] @ turn, ours.diffraction[0], rtol=1e-6, atol=1.0)


def test_panels_agree_within_their_own_error():
    length, beam, draft, depth, omega = 100, 50, 10, 20.0, 0.6
    mesh, coarse = (box(length, beam, draft, panels=n) for n in (400, 200))
    panels = prepare(PanelProblem(mesh, lid(mesh), coarse=(coarse, lid(coarse)), depth=depth))
    want = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed"}
    theirs = solve_frequency(panels, omega, HEADINGS, want)
    Z = theirs["added_mass"] + 1j * theirs["radiation_damping"] / omega
    ours = Solved(prepare_box(length, beam, draft, depth, 1e-4), omega)
    estimate = theirs["checks"]["estimated_error"]
    assert estimate < 6e-3
    assert ours.error(Z, theirs["excitation_force"], theirs["drift_force_fixed"]) < 3 * estimate


def test_nothing_happens_at_the_resonances_of_the_plan():
    """A smooth sweep through k = π√((1/L)² + (1/B)²): a parabola through the neighbours meets the middle"""
    body = prepare_box(100, 50, 10, 20, 1e-5)
    k = np.pi * np.hypot(1 / 100, 1 / 50)
    middle = np.sqrt(G * k * np.tanh(k * 20))
    for steps in (1e-3, 1e-6):
        Z, force = [], []
        for omega in middle * (1 + steps * np.array([-3, -1, 0, 1, 3])):
            r = body.first_order(omega, HEADINGS)
            Z.append(r.radiation), force.append(r.diffraction)
        for values in (np.array(Z), np.array(force)):
            guess = (9 * (values[1] + values[3]) - values[0] - values[4]) / 16
            assert np.abs(guess - values[2]).max() < 1e-8 * np.abs(values).max()


@pytest.mark.parametrize("body", [prepare_box(100, 50, 10, 20, 1e-5), prepare_cylinder(10, 10, 30, 1e-5)])
def test_added_mass_tends_to_its_limits(body):
    """A(ω) − A(0) and A(ω) − A(∞) fall with ω² ln ω and ω⁻²"""
    used = [0, 1, 3, 4]
    zero, infinity = (np.diag(body.added_mass_limit(w))[used] for w in ("zero", "infinity"))
    low = [np.abs(np.diag(body.first_order(w).radiation.real)[used] / zero - 1).max() for w in (0.02, 0.01, 0.005)]
    high = [np.abs(np.diag(body.first_order(w).radiation.real)[used] / infinity - 1).max() for w in (4.0, 8.0)]
    assert low[2] < low[1] / 3 < low[0] / 9 and low[2] < 1e-3, low
    assert high[1] < high[0] / 3 and high[1] < 0.05, high
    assert np.isinf(body.added_mass_limit("zero")[2, 2])


@pytest.mark.parametrize(
    "dimensions, omega",
    [
        ((100, 50, 10, 10.05), 0.5),  # a gap of half a per cent
        ((1000, 1000, 10, 20), 0.2),
        ((1000, 50, 10, 20), 0.4),
        ((100, 50, 10, 20), 1e-5 * np.sqrt(G / 20)),  # kh = 1e-5
        ((100, 50, 10, 20), frequency(50.0, 20)),
        ((100, 50, 10, 500), 0.5),
    ],
)
def test_extreme_shapes_and_waves_obey_the_laws(dimensions, omega):
    defects = Solved(prepare_box(*dimensions, tolerance=1e-3), omega).defects()
    assert max(defects.values()) < 1e-3, defects
