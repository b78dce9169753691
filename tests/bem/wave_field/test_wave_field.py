"""Waves around bodies from their Kochin functions: sources found again, cylinders in closed form, energy of a row."""

import subprocess
import sys
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import h1vp, hankel1, jvp

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.kochin import angles
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.wave_field.around import at_waterline, beside_incident, far_field, plan_of, waves_around
from hakobune.bem.wave_field.sources import (
    Sources,
    contour,
    covers,
    directions,
    incident,
    perimeter,
    rectangle,
    regular_inverse,
    shrunk,
    slopes,
    waves,
)
from hakobune.bem.wave_field.units import field, row
from hakobune.bem.waves import wavenumber
from hakobune.meshing.panels import PanelMesh

ORDERS = np.arange(-20, 21)


def test_waves_of_sources_in_a_body_are_found_again_half_a_wave_from_it():
    random, k, half = np.random.default_rng(1), 2 * np.pi / 40, np.array([50.0, 5.0])
    inside = (random.random((6, 2)) * 2 - 1) * 0.85 * half
    strength = random.standard_normal(6) + 1j * random.standard_normal(6)
    theta = angles(k, 51.0)
    H = np.exp(-1j * k * (directions(theta) @ inside.T)) @ strength
    found = Sources(rectangle(half), k, theta)
    made, missed = found.strengths(H)
    assert missed < 1e-3
    for away, allowed in ((10.0, 0.03), (20.0, 0.005), (40.0, 0.001)):
        there = np.stack([np.linspace(-50, 50, 101), np.full(101, 5.0 + away)], axis=1)
        exact = waves(k, there, inside) @ strength
        assert np.linalg.norm(found.elevation(made, there) - exact) < allowed * np.linalg.norm(exact)


@pytest.mark.parametrize("waves_along, waves_across", [(1, 1), (2, 1), (3, 1), (1, 2), (3, 2), (5, 1)])
def test_water_at_a_hull_does_not_resonate_within_its_sources(waves_along, waves_across):
    """Far field of six sources, a thousandth off, at wavenumbers at which waves stand in 95 x 45 m, the first curve"""
    half, random = np.array([50.0, 25.0]), np.random.default_rng(3)
    inside = (random.random((6, 2)) * 2 - 1) * 0.5 * half
    strength = random.standard_normal(6) + 1j * random.standard_normal(6)
    there = np.array([[50.01, 0.0], [50.01, 12.0], [0.0, 25.01], [30.0, 25.01]])
    stands = np.pi * np.hypot(waves_along / 95, waves_across / 45)
    for k in stands * (1 + 1e-3 * np.array([-2, -1, -0.5, 0, 0.5, 1, 2])):
        theta = angles(k, 56.0)
        H = (np.exp(-1j * k * (directions(theta) @ inside.T)) @ strength) * (1 + 1e-3 * np.cos(3 * theta + 1))
        found = Sources(rectangle(half), k, theta)
        exact = waves(k, there, inside) @ strength
        off = np.abs(found.elevation(found.strengths(H)[0], there) - exact).max()
        assert off < 0.03 * np.abs(exact).max()


def of_cylinder(k, a, beta, theta):
    """H (b, t) of a cylinder on the bed"""
    ratio = -jvp(ORDERS, k * a) / h1vp(ORDERS, k * a)
    return np.exp(1j * ORDERS * (theta[None, :, None] - beta[:, None, None])) @ ratio


def of_cylinders(k, a, middles, beta, places):
    """Elevation (p,) about cylinders on the bed, by Graf's theorem (Linton and Evans, J. Fluid Mech. 215, 1990)"""
    Z, count = jvp(ORDERS, k * a) / h1vp(ORDERS, k * a), len(ORDERS)
    arriving = np.exp(1j * k * (middles @ directions(beta)))[:, None] * np.exp(1j * ORDERS * (np.pi / 2 - beta))
    matrix = np.eye(len(middles) * count, dtype=complex)
    for j, one in enumerate(middles):
        for i, other in enumerate(middles):
            if i != j:
                apart, way = np.hypot(*(one - other)), np.arctan2(*(one - other)[::-1])
                n = ORDERS[None] - ORDERS[:, None]  # from order n of i to order m of j
                block = Z[None] * hankel1(n, k * apart) * np.exp(1j * n * way)
                matrix[j * count : (j + 1) * count, i * count : (i + 1) * count] = block
    A = np.linalg.solve(matrix, -arriving.reshape(-1)).reshape(len(middles), count)
    total = np.exp(1j * k * (places @ directions(beta)))
    for middle, own in zip(middles, A, strict=True):
        r, way = np.hypot(*(places - middle).T), np.arctan2(*(places - middle).T[::-1])
        total += (Z * own * hankel1(ORDERS, k * r[:, None]) * np.exp(1j * ORDERS * way[:, None])).sum(axis=1)
    return total


@pytest.mark.parametrize(("pitch", "allowed"), [(2.2, 2e-2), (3.0, 3e-3)])  # gaps of a twentieth and a quarter wave
def test_cylinders_shelter_each_other_as_the_closed_form_has_it(pitch, allowed):
    a, k, beta = 1.0, 1.5, np.array([np.radians(60)])
    theta, ring = angles(k, np.sqrt(2)), angles(k, np.sqrt(2)) + 0.1
    middles = row(3, pitch)
    made = field(
        rectangle(a), k, theta, of_cylinder(k, a, beta, theta), ring, of_cylinder(k, a, ring, theta), beta, middles
    )
    places = np.stack(np.meshgrid(np.linspace(-6, 6, 25), [2.5, 4.0, 8.0]), axis=-1).reshape(-1, 2)
    exact = of_cylinders(k, a, middles, beta[0], places)
    assert np.linalg.norm(made.elevation(places)[0] - exact) < allowed * np.linalg.norm(exact)


def test_a_row_of_units_keeps_the_energy_of_the_waves():
    """(1/2π) ∫ |H|² dθ = −Re H(β) of all units together, however near they are"""
    omega, half = 1.0, np.array([20.0, 5.0])
    k = float(wavenumber(omega, 10.0, 9.80665))
    body = ShapeProblem(method="contour", shape="box", sizes=(40.0, 10.0, 5.0), depth=10.0, tolerance=1e-3).prepared()
    ring = angles(k, np.hypot(*half))
    found = solve_frequency(body, omega, ring, {"kochin_diffraction"})["kochin_diffraction"]
    theta = np.arange(found.shape[1]) * 2 * np.pi / found.shape[1]
    towards = np.array([7, 11])
    for gap in (12.0, 3.0):
        made = field(rectangle(half), k, theta, found[towards], ring, found, ring[towards], row(3, 40.0 + gap))
        ahead = [
            np.sum(strengths * np.exp(-1j * k * ((made.sources.points + made.middles[:, None]) @ directions(beta))))
            for strengths, beta in zip(made.strengths, made.beta, strict=True)
        ]
        assert np.mean(abs(made.far_field()) ** 2, axis=1) == pytest.approx(-np.real(ahead), rel=3e-3)


class OfCylinder:
    """What `waves_around` asks of a reader, of a cylinder on the bed whose middle is not the origin"""

    depth, gravity = 12.0, 9.80665

    def __init__(self, a, middle, theta, mesh):
        self.a, self.middle, self.between, self.mesh = a, np.array(middle), SimpleNamespace(theta=theta), mesh

    def far_field(self, omega, betas):
        k = float(wavenumber(omega[0], self.depth, self.gravity))  # one frequency at a time
        H = of_cylinder(k, self.a, betas, self.between.theta)
        there = np.exp(1j * k * (directions(betas) @ self.middle))[:, None]
        back = np.exp(-1j * k * (directions(self.between.theta) @ self.middle))
        return np.zeros((1, 6, H.shape[1])), (H * there * back)[None]


def test_waves_around_a_cylinder_are_those_of_the_closed_form_wherever_it_stands():
    a, middle, omega, beta = 10.0, (30.0, -7.0), 0.8, np.radians(50)
    k = float(wavenumber(omega, OfCylinder.depth, OfCylinder.gravity))
    turn = np.linspace(0, 2 * np.pi, 65)[:-1]
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    top, bottom = (np.column_stack([a * ring + middle, np.full(64, z)]) for z in (0.0, -12.0))
    corner = np.arange(64)
    sides = np.column_stack([corner, corner + 64, (corner + 1) % 64 + 64, (corner + 1) % 64])
    mesh = PanelMesh(np.concatenate([top, bottom]), sides)
    around = waves_around(OfCylinder(a, middle, angles(k, 50.0), mesh), omega, beta, fixed=True)
    assert around.pierces and around.missed < 1e-3
    for r, allowed in ((10.2, 5e-3), (15.0, 2e-3), (40.0, 1e-3)):
        places = r * ring + middle
        exact = of_cylinders(k, a, np.array([middle]), beta, places)
        assert np.abs(around.elevation(places) - exact).max() < allowed
    assert np.isnan(around.elevation([middle])).all()
    # the same at points, among them one on deck, which has the water at the nearest point of the waterline
    places = at_waterline(mesh, np.array([[45.0, 5.0], [38.0, -7.0]]))
    assert np.array_equal(places[0], [45.0, 5.0]) and np.hypot(*(places[1] - middle)) == pytest.approx(a, rel=0.01)
    reader = OfCylinder(a, middle, angles(k, 50.0), mesh)
    added, missed = beside_incident(reader, np.array([omega]), np.array([beta]), np.zeros((1, 1, 6)), places)
    exact = of_cylinders(k, a, np.array([middle]), beta, places) - np.exp(1j * k * (places @ directions(beta)))
    assert missed < 1e-3 and np.abs(added[0, 0] - exact).max() < 5e-3


def test_the_plan_of_a_hull_does_not_load_scipy_spatial():
    code = (
        "import sys; from hakobune.meshing.shapes import box; from hakobune.bem.wave_field.around import plan_of",
        "assert plan_of(box(20, 10, 3, panels=60))[0].shape == (4, 2)",
        "assert 'scipy.spatial' not in sys.modules",
    )
    subprocess.run([sys.executable, "-c", "\n".join(code)], check=True)


def test_sources_stand_a_tenth_of_the_half_breadth_within_the_plan_eight_in_a_wave_or_twenty_four():
    """Of 40 x 10 m: half a metre inwards, 96 m around; eight of each wave of it, two on each side at least; 2.25 m
    inwards and 82 m around half as many, eight at least"""
    plan = rectangle(np.array([20.0, 5.0])) + [3.0, -2.0]
    inner = shrunk(plan)
    assert inner == pytest.approx(rectangle(np.array([19.5, 4.5])) + [3.0, -2.0])
    assert perimeter(inner) == pytest.approx(96.0)
    few, many = Sources(plan, 0.01, angles(0.01, 21.0)), Sources(plan, 1.0, angles(1.0, 21.0))
    assert len(few.points) == 2 * (10 + 3) + 8  # steps of 4 m: ⌈39/4⌉ and ⌈9/4⌉
    deeper = (few.points[26:] - [3.0, -2.0]) / [17.75, 2.75]
    assert np.abs(deeper).max(axis=1) == pytest.approx(np.ones(8))
    step = 2 * np.pi / 8
    assert len(many.points) == 2 * (int(np.ceil(39 / step)) + int(np.ceil(9 / step))) + 53  # ⌈4 · 82/2π⌉
    along = np.sort(few.points[np.isclose(few.points[:, 1], -2.0 - 4.5), 0])
    assert along == pytest.approx(3.0 - 19.5 + 3.9 * (np.arange(10) + 0.5))
    assert few.sent == pytest.approx(np.exp(-0.01j * (directions(angles(0.01, 21.0)) @ few.points.T)))
    long = contour(rectangle(np.array([50.0, 0.5])), 10)
    assert np.sum(np.isclose(np.abs(long[:, 0]), 50.0)) == 4  # two at each end


def test_combinations_that_send_little_fade_out():
    """s/(s² + ε²) of each singular value s, the largest 1"""
    rng = np.random.default_rng(2)
    left, _ = np.linalg.qr(rng.normal(size=(9, 3)) + 1j * rng.normal(size=(9, 3)))
    right, _ = np.linalg.qr(rng.normal(size=(3, 3)) + 1j * rng.normal(size=(3, 3)))
    for least in (1e-1, 1e-3, 1e-5):
        size = np.array([1.0, 0.5, least])
        found = regular_inverse((2.0 * left * size) @ right.conj().T, 1e-3)
        kept = size / (size**2 + 1e-6) / 2.0
        expected = (right * kept) @ left.conj().T
        assert found == pytest.approx(expected, abs=1e-6 * np.abs(expected).max())


def test_water_at_a_hull_does_not_step_between_frequencies():
    """Of a far field a thousandth off, around a cylinder of 10 m: 0.0013 m/m (0.014 where singular values were cut at
    once), its error at most 0.009 (0.015)
    """
    a, beta, errors = 10.0, 0.3, []
    turn = np.arange(24) * (2 * np.pi / 24)
    plan, places = a * directions(turn), a * directions(turn[::2] + 0.05)
    theta = np.arange(180) * (2 * np.pi / 180)
    noise = 1 + 1e-3 * np.random.default_rng(0).normal(size=180)
    for k in np.linspace(0.3, 0.36, 13):
        sources = Sources(plan, k, theta)
        H = of_cylinder(k, a, np.array([beta]), theta)[0]
        exact = of_cylinders(k, a, np.zeros((1, 2)), beta, places) - incident(k, np.array([beta]), places)[0]
        errors.append(sources.elevation(sources.strengths(H * noise)[0], places) - exact)
    assert np.abs(errors).max() < 0.02
    assert np.abs(np.diff(errors, axis=0)).max() < 2e-3


def test_slopes_of_waves_are_their_difference_quotients_and_none_at_a_source():
    points, place, step = np.array([[0.0, 0.0], [3.0, -1.0]]), np.array([[2.0, 1.5]]), 1e-6
    found = slopes(0.7, place, points)[0]
    for axis in (0, 1):
        move = step * np.eye(2)[axis]
        quotient = (waves(0.7, place + move, points) - waves(0.7, place - move, points))[0] / (2 * step)
        assert found[:, axis] == pytest.approx(quotient, rel=1e-7)
    assert not slopes(0.7, points, points)[[0, 1], [0, 1]].any()


def test_plans_are_the_hull_of_the_waterline_of_a_submerged_body_of_all_of_it_and_have_24_corners_at_most():
    from hakobune.meshing.shapes import box, buoy

    flare = box(20, 10, 4, counts=(2, 2, 2), symmetry="")
    flared = PanelMesh(flare.points * (1 + 0.25 * np.outer(-flare.points[:, 2] / 4, [1, 1, 0])), flare.corners)
    plan, pierces = plan_of(flared)
    assert pierces and np.abs(plan).max(axis=0) == pytest.approx([10, 5])
    under, pierces = plan_of(flared.moved(dz=-1.0))
    assert not pierces and np.abs(under).max(axis=0) == pytest.approx([12.5, 6.25])
    round_plan, _ = plan_of(buoy(10, 5, counts=(12, 2, 2)))
    assert len(round_plan) == 24 and len(plan_of(buoy(10, 5, counts=(6, 2, 2)))[0]) == 24
    radius = np.hypot(*round_plan.T)
    assert radius.max() / radius.min() == pytest.approx(1.0, rel=2e-3) and perimeter(round_plan) > 0.99 * 20 * np.pi
    covered = covers(plan, np.array([[9.9, 4.9], [10.1, 0], [0, -5.1], [-9.9, -4.9]]))
    assert covered.tolist() == [True, False, False, True]


def test_units_of_a_row_stand_a_pitch_apart_about_the_origin():
    assert row(3, 5.0) == pytest.approx(np.array([[-5, 0], [0, 0], [5, 0]]))
    assert row(2, 5.0) == pytest.approx(np.array([[-2.5, 0], [2.5, 0]]))


def test_the_waves_of_a_moving_body_are_those_it_scatters_and_those_of_each_motion():
    """H_D + Σ Xⱼ Hⱼ of the `OfCylinder`, whose motions send a dipole each"""
    a, omega, beta = 10.0, 0.8, np.radians(50)
    k = float(wavenumber(omega, OfCylinder.depth, OfCylinder.gravity))

    class Moving(OfCylinder):
        def far_field(self, omega, betas):
            radiated, diffracted = super().far_field(omega, betas)
            radiated = np.zeros((1, 6, radiated.shape[-1]), complex)
            radiated[0, 0], radiated[0, 1] = np.cos(self.between.theta), 1j * np.sin(self.between.theta)
            return radiated, diffracted

        def motions(self, omega, headings):
            return np.array([[[0.3, 0.2j, 0, 0, 0, 0]]])

    reader = Moving(a, (0.0, 0.0), angles(k, 20.0), None)
    found = far_field(reader, reader.motions(None, None)[0, 0], omega, beta)
    theta = reader.between.theta
    still = of_cylinder(k, a, np.array([beta]), theta)[0]
    assert found == pytest.approx(still + 0.3 * np.cos(theta) - 0.2 * np.sin(theta))
    assert far_field(reader, None, omega, beta) == pytest.approx(still)
    both = far_field(reader, reader.motions(None, None)[0], omega, np.array([beta]))
    assert both == pytest.approx(found[None])


def test_a_hull_that_reaches_the_surface_along_a_line_alone_has_no_waterline():
    """A roof under water whose ridge lies in the surface: its plan is that of its eaves"""
    points = np.array([[x, y, -3.0 * (y != 0)] for x in (-10.0, 0.0, 10.0) for y in (-4.0, 0.0, 4.0)])
    roof = PanelMesh(points, np.array([[i, i + 3, i + 4, i + 1] for i in (0, 1, 3, 4)]))
    plan, pierces = plan_of(roof)
    assert not pierces and np.abs(plan).max(axis=0) == pytest.approx([10, 4])
    assert np.sort(plan, axis=0)[:, 0] == pytest.approx([-10, -10, 10, 10])
