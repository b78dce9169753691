"""Several bodies by the contour method: published numbers, one body far away from others, laws, and other axes."""

import numpy as np
import pytest
from scipy.special import h1vp

from hakobune.bem.contour.plan.circle import Circle
from hakobune.bem.contour.several.bodies import prepare_several
from hakobune.bem.contour.several.exterior import CLASSES, Exterior, Place
from hakobune.bem.contour.several.senders import sender
from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.near_field import near_field_drift
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.modes import Body
from hakobune.bem.waves import wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import assembled
from hakobune.meshing.shapes import box, buoy

SHAPES = [("box", (16.0, 8.0, 3.0)), ("buoy", (3.0, 4.0))]
PLACES = [Place(0.0, 0.0, 0.0), Place(2.0, 9.0, 0.4)]
DEPTH, OMEGA = 10.0, 1.1
ANGLES = np.linspace(0, 2 * np.pi, 60, endpoint=False)


@pytest.fixture(scope="module")
def pair():
    """A box and a cylinder 2 m apart, and their quantities in two waves"""
    bodies = prepare_several(SHAPES, PLACES, DEPTH, 1e-3)
    return bodies, bodies.first_order(OMEGA, [0.3, 2.0], ANGLES)


def test_two_truncated_cylinders_of_published_coefficients():
    """a = 10, draft 10 in 20 m, at x = ∓12.5 m, ω = 0.8, values to 8 digits by an expansion in eigenfunctions"""
    west, east = Place(-12.5, 0.0, 0.0), Place(12.5, 0.0, 0.0)
    pair = prepare_several([("buoy", (10.0, 10.0))] * 2, [west, east], 20.0, 1e-5)
    found = pair.first_order(0.8, [0.0], (), None, 1000.0, 9.81)
    A, B = found.radiation.real, 0.8 * found.radiation.imag
    force = (found.froude_krylov + found.diffraction)[0]
    assert [A[0, 0], A[0, 6], A[2, 2]] == pytest.approx([2954147.8, -1562178.2, 1812068.2], rel=1e-7)
    assert [A[2, 8], B[2, 2], B[2, 8]] == pytest.approx([-15769.4, 460981.0, 237206.5], rel=3e-6)
    assert abs(force[[0, 6]] - [-2518943 - 1332175j, 2322799 - 1051619j]).max() < 1.5


def test_at_a_tolerance_of_1e_4_each_of_their_coefficients_keeps_it_by_its_own_size():
    """and the stated error of each is that from its published value, or less than a tenth of the tolerance"""
    pair = prepare_several([("buoy", (10.0, 10.0))] * 2, [Place(-12.5, 0, 0), Place(12.5, 0, 0)], 20.0, 1e-4)
    found, finer = (one.first_order(0.8, (), (), None, 1000.0, 9.81).radiation for one in (pair, pair.finer))
    A, B, error = found.real, 0.8 * found.imag, finer - found
    assert [A[0, 0], A[0, 6], A[2, 2]] == pytest.approx([2954147.8, -1562178.2, 1812068.2], rel=1e-5)
    assert [A[2, 8], B[2, 2], B[2, 8]] == pytest.approx([-15769.4, 460981.0, 237206.5], rel=1e-5)
    assert A[2, 8] + error[2, 8].real == pytest.approx(-15769.4, rel=1e-5)


def test_a_third_cylinder_300_m_away_is_not_felt_but_by_its_waves():
    """Close pairs need decaying modes that have fallen by e^(−800) at the third; without waves it is not there"""
    near = [Place(0.0, 0.0, 0.0), Place(24.0, 0.0, 0.0)]
    three = prepare_several([("buoy", (10.0, 10.0))] * 3, [*near, Place(24.0, 300.0, 0.0)], 20.0, 1e-3)
    two = prepare_several([("buoy", (10.0, 10.0))] * 2, near, 20.0, 1e-3)
    Z = three.first_order(0.8).radiation
    assert abs(Z - Z.T).max() < 1e-10 * abs(Z).max()
    high = [bodies.added_mass_limit("infinity")[:12, :12] for bodies in (three, two)]
    assert abs(high[0] - high[1]).max() < 1e-5 * abs(high[1]).max()


def test_their_mean_drift_is_the_published_one():
    bodies = Body("west", (-12.5, 0, 0), place=(-12.5, 0)), Body("east", (12.5, 0, 0), place=(12.5, 0))
    problem = ShapeProblem(method="contour", shapes=(("buoy", (10.0, 10.0)),) * 2, bodies=bodies, depth=20.0,
                           density=1000.0, gravity=9.81, tolerance=1e-4)  # fmt: skip
    found = solve_frequency(problem.prepared(), 0.8, [0.0], {"drift_force_fixed"})
    assert found["drift_force_fixed"][0, 0] == pytest.approx(19895.3, rel=1e-5)


def test_the_drift_of_each_is_of_panels_alone():
    bodies = Body("box"), Body("buoy", (2.0, 9.0, 0.0), 0.4, False, (2.0, 9.0))
    problem = ShapeProblem(method="contour", shapes=tuple(SHAPES), bodies=bodies, depth=DEPTH)
    run = problem.prepared().run(OMEGA, [0.3], {"drift_force_fixed"}, None, None)
    with pytest.raises(ValueError, match="the contour method computes near-field drift for one body only; use"):
        near_field_drift(run, False)


def test_laws_hold_over_all_motions(pair):
    """Z = Zᵀ, forces of waves from what motions send, energy of what is sent and scattered"""
    _, found = pair
    Z, force = found.radiation, found.froude_krylov + found.diffraction
    assert np.abs(Z - Z.T).max() < 1e-7 * np.abs(Z).max()
    assert np.abs(found.haskind - force).max() < 1e-7 * np.abs(force).max()
    k, g = float(wavenumber(OMEGA, DEPTH)), 9.80665
    n = 0.5 * (1 + 2 * k * DEPTH / np.sinh(2 * k * DEPTH))
    H = found.kochin_radiation[0]
    damping = 4 * 1025 * g * n / (k * OMEGA) ** 2 * (H @ H.conj().T).real / len(ANGLES)
    assert damping == pytest.approx(Z.imag, abs=1e-6 * np.abs(Z.imag).max())


def test_the_slope_of_kochin_functions_is_their_derivative(pair):
    _, found = pair
    H, slope = found.kochin_diffraction
    order = np.fft.fftfreq(len(ANGLES), 1 / len(ANGLES))
    assert slope == pytest.approx(np.fft.ifft(1j * order * np.fft.fft(H)), abs=1e-9 * np.abs(slope).max())


def test_bodies_far_apart_are_as_if_alone():
    """Across 2 km nothing of what decays gets through: at a tolerance of 1e-5 beside each alone at a tenth of it"""
    both = prepare_several(SHAPES, [Place(0.0, 0.0, 0.0), Place(0.0, 2000.0, 0.4)], DEPTH, 1e-5)
    found = both.added_mass_limit("infinity", 1.0)
    alone = prepare_box(16.0, 8.0, 3.0, DEPTH, 1e-6).added_mass_limit("infinity", 1.0)
    assert found[:6, :6] == pytest.approx(alone, rel=1e-5, abs=1e-5)
    alone = prepare_cylinder(3.0, 4.0, DEPTH, 1e-6).added_mass_limit("infinity", 1.0)
    assert found[6:9, 6:9] == pytest.approx(alone[:3, :3], rel=1e-6, abs=1e-6)
    assert np.abs(found[:3, 6:9]).max() < 1e-6


def test_turning_and_moving_everything_changes_phases_alone(pair):
    """A turn of 0.6 rad about the origin and a shift: motions turn with it, forces are times exp(ik·r)"""
    _, found = pair
    turn, shift = 0.6, 3.0 - 2.0j

    def carried(place):
        at = (place.x + 1j * place.y) * np.exp(1j * turn) + shift
        return Place(at.real, at.imag, place.heading + turn)

    moved = prepare_several(SHAPES, [carried(p) for p in PLACES], DEPTH, 1e-3)
    again = moved.first_order(OMEGA, [0.3 + turn, 2.0 + turn])
    c, s = np.cos(turn), np.sin(turn)
    R = np.kron(np.eye(4), [[c, -s, 0], [s, c, 0], [0, 0, 1]])
    to_shifted = np.eye(12)
    for i in (0, 6):
        to_shifted[i + 3 : i + 6, i : i + 3] = [[0, 0, shift.imag], [0, 0, -shift.real], [-shift.imag, shift.real, 0]]
    T = to_shifted @ R
    assert again.radiation == pytest.approx(T @ found.radiation @ T.T, abs=1e-7 * np.abs(again.radiation).max())
    k = float(wavenumber(OMEGA, DEPTH))
    along = np.array([np.cos(b + turn) * shift.real + np.sin(b + turn) * shift.imag for b in (0.3, 2.0)])
    force = (found.froude_krylov + found.diffraction) @ T.T * np.exp(1j * k * along)[:, None]
    assert again.froude_krylov + again.diffraction == pytest.approx(force, abs=1e-7 * np.abs(force).max())


def on_walls(places, radius, k, beta):
    """(n, 2) force of a wave on rigid cylinders on the bed over that on one alone, 4/(k|H₁′|): the plane problem"""
    circle = Circle(radius)
    gap = min(np.hypot(p.x - places[0].x, p.y - places[0].y) for p in places[1:]) - 2 * radius
    senders = [sender(circle, circle.degree(k, 1e-6), k, gap, 6, 1 / k) for _ in places]
    exterior = Exterior(senders, places)
    _, wall = exterior.waves(k, np.array([beta]))
    force = np.zeros((len(places), 2), complex)
    for i, (one, own) in enumerate(zip(senders, exterior.own, strict=True)):
        parts = wall[own, 0].reshape(4, -1)
        for axis, (cls, normal) in enumerate((((-1, 1), one.contour.nx), ((1, -1), one.contour.ny))):
            force[i, axis] = 4 * np.sum(one.contour.weights * normal * parts[CLASSES.index(cls)])
    return np.abs(force) * k * abs(h1vp(1, k * radius)) / 4


def test_the_near_trapped_wave_between_four_cylinders():
    """In a square, a/d = 0.8: the largest force is 54 times that of one at ka 4.0848 (Evans & Porter 1997), a third of
    it 6e-4 beside"""
    places = [Place(1.25 * x, 1.25 * y, 0.0) for x in (-1, 1) for y in (-1, 1)]
    before, there, after = (
        np.linalg.norm(on_walls(places, 1.0, ka, np.pi / 4), axis=1).max() for ka in (4.0842, 4.08482, 4.0854)
    )
    assert there == pytest.approx(54, rel=0.01)
    assert before < 0.35 * there and after < 0.35 * there


def test_a_finer_pair_shows_the_error(pair):
    """What a tolerance of 1e-3 leaves, seen with 1e-5, is within twice what the next digit shows and below 1e-3"""
    bodies, found = pair
    fine = prepare_several(SHAPES, PLACES, DEPTH, 1e-5).first_order(OMEGA, [0.3, 2.0])
    shown = bodies.finer.first_order(OMEGA, [0.3, 2.0])
    size = np.sqrt(np.abs(np.diag(fine.radiation)))
    scale = np.outer(size, size)
    scale[11], scale[:, 11] = np.inf, np.inf  # yaw of a cylinder moves no water
    true, seen = (np.abs((other.radiation - found.radiation) / scale).max() for other in (fine, shown))
    assert 0 < true < 1e-3 and true < 2 * seen


def test_panels_find_the_same(pair):
    """Box and buoy of 400 panels in all: added mass, forces and the limits of the frequency within two per cent"""
    hulls = [box(16.0, 8.0, 3.0, panels=240).whole(), buoy(3.0, 4.0, panels=160).whole().rotated(0.4).moved(dx=2, dy=9)]
    bodies = Body("box"), Body("buoy", (2.0, 9.0, 0.0), 0.4, True, (2.0, 9.0))
    mesh = assembled(hulls)
    want = {"added_mass", "radiation_damping", "excitation_force"}
    panels = PanelProblem(mesh, lid(mesh), depth=DEPTH, bodies=bodies).prepared()
    contour = ShapeProblem(method="contour", shapes=tuple(SHAPES), bodies=bodies, depth=DEPTH).prepared()
    one, other = (solve_frequency(p, OMEGA, [0.3], want) for p in (panels, contour))
    for name in want:
        assert other[name].shape == one[name].shape
        assert other[name] == pytest.approx(one[name], abs=0.02 * np.abs(one[name]).max())
    for which in ("zero", "infinity"):
        rough, found = panels.added_mass_limit(which), contour.added_mass_limit(which)
        there = np.isfinite(rough)
        assert np.array_equal(np.isfinite(found), there)
        assert found[there] == pytest.approx(rough[there], abs=0.02 * np.abs(rough[there]).max())


def test_gaps_are_taken_from_five_thousandths_of_half_the_width():
    """Of the box 4 m wide on either side of its middle 0.02 m"""
    boxes = [("box", (16.0, 8.0, 3.0))] * 2
    assert prepare_several(boxes, [Place(0, 0, 0), Place(0, 8.021, 0)], DEPTH, 1e-2).gaps[0] == pytest.approx(0.021)
    with pytest.raises(ValueError, match=r"body 1 is 0.019 m from the next; the contour method needs at least 0.02 m"):
        prepare_several(boxes, [Place(0, 0, 0), Place(0, 8.019, 0)], DEPTH, 1e-2)


def test_bodies_that_meet_are_refused():
    with pytest.raises(ValueError, match="bodies 1 and 2 overlap or touch"):
        prepare_several(SHAPES, [Place(0.0, 0.0, 0.0), Place(2.0, 6.9, 0.4)], DEPTH, 1e-3)
