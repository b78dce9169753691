"""Bodies coupled by partial waves: published numbers, the direct solution, laws, the drift of each, what is refused."""

import numpy as np
import pytest
from scipy.special import hankel1, ive, kve

from hakobune.bem.contour.several.bodies import prepare_several
from hakobune.bem.contour.several.exterior import Place
from hakobune.bem.drift import sum_about_origin
from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.modes import Body
from hakobune.bem.transfer.far_bodies import prepare_far
from hakobune.bem.transfer.partial_waves import PartialWaves
from hakobune.bem.waves import wavenumber
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import assembled
from hakobune.meshing.shapes import box, buoy

SHAPES = [("box", (16.0, 8.0, 3.0)), ("buoy", (3.0, 4.0)), ("box", (16.0, 8.0, 3.0))]
PLACES = [Place(1.0, 0.0, 0.0), Place(2.0, 13.0, 0.4), Place(20.0, 6.0, 1.0)]
BODIES = (Body("one", (1.5, 0.0, 0.0), place=(1.0, 0.0)), Body("buoy", (2.0, 12.5, -1.0), 0.4, False, (2.0, 13.0)),
          Body("two", (20.0, 6.0, 0.0), 1.0, True, (20.0, 6.0)))  # fmt: skip
DEPTH, OMEGA, HEADINGS = 10.0, 1.1, [0.3, 2.0]
ANGLES = np.linspace(0, 2 * np.pi, 80, endpoint=False)
CYLINDERS = [Place(-12.5, 0.0, 0.0), Place(12.5, 0.0, 0.0)]


@pytest.fixture(scope="module")
def far():
    """Two boxes and a cylinder, the same shape once, and their quantities"""
    bodies = prepare_far(SHAPES, PLACES, DEPTH, 1e-3)
    return bodies, bodies.first_order(OMEGA, HEADINGS, ANGLES)


@pytest.fixture(scope="module")
def direct():
    """The same by one problem around all three, to 2e-5"""
    bodies = prepare_several(SHAPES, PLACES, DEPTH, 1e-3)
    return bodies, bodies.first_order(OMEGA, HEADINGS, ANGLES)


def outgoing(one, m, a, z):
    """S e^{imθ} at z (complex m) by its definition"""
    r, turn = np.abs(z), (z / np.abs(z)) ** m
    if one.kind == "laplace":
        return np.log(r) + 0j if m == 0 else (a / r) ** abs(m) * turn
    if one.kind == "radiating":
        return hankel1(abs(m), one.k * r) / abs(hankel1(abs(m), one.k * a)) * turn
    return kve(abs(m), one.k * r) * ive(abs(m), one.k * a) * np.exp(one.k * (a - r)) * turn


@pytest.mark.parametrize("kind", ["radiating", "decaying", "laplace"])
def test_what_one_axis_sends_is_the_sum_of_regular_waves_about_another(kind):
    one, a, there_a, there = PartialWaves(kind, 0.4, 24), 2.0, 1.5, 3.0 + 5.0j
    seen = one.seen_from(there, a, there_a)
    near = 1.4 * np.exp(1j * np.array([0.0, 1.1, 2.9, 4.5]))
    R, _ = one.regular(there_a, np.abs(near))
    waves = R[:, np.abs(one.orders)] * np.exp(1j * np.outer(np.angle(near), one.orders))
    for m in (-3, -1, 0, 2, 3):
        found = waves @ seen[:, m + one.last]
        assert found == pytest.approx(outgoing(one, m, a, there + near), abs=1e-9)


@pytest.mark.parametrize("kind", ["radiating", "decaying", "laplace"])
def test_slopes_of_regular_waves_are_their_derivatives(kind):
    one, r, step = PartialWaves(kind, 0.4, 6), np.array([0.7, 1.9]), 1e-5
    slope = (one.regular(2.0, r + step)[0] - one.regular(2.0, r - step)[0]) / (2 * step)
    assert one.regular(2.0, r)[1] == pytest.approx(slope, abs=1e-8)


def test_two_truncated_cylinders_of_published_coefficients():
    """a = 10, draft 10 in 20 m, ω = 0.8, values to 8 digits by an expansion in eigenfunctions"""
    pair = prepare_far([("buoy", (10.0, 10.0))] * 2, CYLINDERS, 20.0, 1e-4)
    found = pair.first_order(0.8, [0.0], (), None, 1000.0, 9.81)
    A, B = found.radiation.real, 0.8 * found.radiation.imag
    force = (found.froude_krylov + found.diffraction)[0]
    assert [A[0, 0], A[0, 6], A[2, 2]] == pytest.approx([2954147.8, -1562178.2, 1812068.2], rel=1e-6)
    assert [B[2, 2], B[2, 8]] == pytest.approx([460981.0, 237206.5], rel=1e-6)
    assert A[2, 8] == pytest.approx(-15769.4, rel=5e-5)  # a hundredth of A₃₃
    assert abs(force[[0, 6]] - [-2518943 - 1332175j, 2322799 - 1051619j]).max() < 3


def test_the_drift_of_each_cylinder_adds_up_to_the_published_one():
    bodies = tuple(Body(n, (p.x, 0, 0), place=(p.x, 0)) for n, p in zip("ab", CYLINDERS, strict=True))
    problem = ShapeProblem(method="transfer", shapes=(("buoy", (10.0, 10.0)),) * 2, bodies=bodies, depth=20.0,
                           density=1000.0, gravity=9.81, tolerance=1e-4)  # fmt: skip
    names = {"drift_force_fixed", "body_drift_force_fixed"}
    found = solve_frequency(problem.prepared(), 0.8, [0.0], names)
    assert found["drift_force_fixed"][0, 0] == pytest.approx(19895.3, rel=1e-5)
    assert found["body_drift_force_fixed"][0, :, 0].sum() == pytest.approx(19895.3, rel=1e-5)


def test_the_direct_solution_is_the_same(far, direct):
    """Added mass, damping, forces and far field within the tolerance"""
    one, other = far[1], direct[1]
    size = np.sqrt(np.abs(np.diag(other.radiation)))
    size[11] = np.inf  # yaw of a cylinder moves no water
    assert np.abs((one.radiation - other.radiation) / np.outer(size, size)).max() < 1e-3
    forces = [found.froude_krylov + found.diffraction for found in (one, other)]
    assert np.abs(forces[0] - forces[1]).max() < 1e-3 * np.abs(forces[1]).max()
    for name in ("kochin_radiation", "kochin_diffraction"):
        known = getattr(other, name)
        assert np.abs(getattr(one, name) - known).max() < 1e-3 * np.abs(known).max()


def test_limits_of_the_frequency_are_the_same(far, direct):
    for which in ("zero", "infinity"):
        one, other = (found[0].added_mass_limit(which, 1.0) for found in (far, direct))
        finite = np.isfinite(other)
        assert np.array_equal(np.isfinite(one), finite)
        assert np.abs(one[finite] - other[finite]).max() < 1e-3 * np.abs(other[finite]).max()


def test_laws_hold_over_all_motions(far):
    """Z = Zᵀ, forces from what motions send, energy of what is sent"""
    found = far[1]
    Z, force = found.radiation, found.froude_krylov + found.diffraction
    assert np.abs(Z - Z.T).max() < 1e-5 * np.abs(Z).max()
    assert np.abs(found.haskind - force).max() < 1e-5 * np.abs(force).max()
    k, g = float(wavenumber(OMEGA, DEPTH)), 9.80665
    n = 0.5 * (1 + 2 * k * DEPTH / np.sinh(2 * k * DEPTH))
    H = found.kochin_radiation[0]
    damping = 4 * 1025 * g * n / (k * OMEGA) ** 2 * (H @ H.conj().T).real / len(ANGLES)
    assert damping == pytest.approx(Z.imag, abs=1e-5 * np.abs(Z.imag).max())


def test_the_slope_of_kochin_functions_is_their_derivative(far):
    H, slope = far[1].kochin_diffraction
    order = np.fft.fftfreq(len(ANGLES), 1 / len(ANGLES))
    assert slope == pytest.approx(np.fft.ifft(1j * order * np.fft.fft(H)), abs=1e-9 * np.abs(slope).max())


def test_finer_bodies_show_the_error(far, direct):
    """Of radiation, within a factor of 1.5"""
    one, shown, true = far[1], far[0].finer.first_order(OMEGA, HEADINGS), direct[1]
    size = np.sqrt(np.abs(np.diag(true.radiation)))
    size[11] = np.inf
    left, seen = (np.abs((one.radiation - r.radiation) / np.outer(size, size)).max() for r in (true, shown))
    assert left < 1e-3 and seen / 3 < left < 1.5 * seen


def test_bodies_five_kilometres_apart_are_as_if_alone():
    """Nothing of what decays arrives, waves do as 1/√kR"""
    far = prepare_far([("buoy", (3.0, 4.0))] * 2, [Place(0, 0, 0), Place(5000, 0, 0)], DEPTH, 1e-3)
    alone = far.bodies[0]
    for which in ("zero", "infinity"):
        one, both = (found.added_mass_limit(which, 1.0) for found in (alone, far))
        assert both[:2, :2] == pytest.approx(one[:2, :2], rel=1e-5, abs=1e-6)
    one, both = (found.first_order(OMEGA, [0.3]) for found in (alone, far))
    assert both.radiation[:3, :3] == pytest.approx(one.radiation[:3, :3], abs=1e-3 * abs(one.radiation[0, 0]))


def test_a_large_box_beside_a_small_one_with_circles_that_nearly_touch_is_as_by_contours():
    """Circles 0.64 m apart, of 6.06 and 13.1 m, and a cylinder: high orders that the larger circle sends arrive nearly
    as large as low ones.  The stated error is the true one within a factor of two"""
    shapes = [("buoy", (6.29, 4.93)), ("box", (10.9, 5.29, 15.2)), ("box", (18.7, 18.34, 14.1))]
    places = [Place(0.0, 0.0, 0.0), Place(13.8, 0.0, 2.13), Place(33.6, 1.0, 0.85)]
    far, near = prepare_far(shapes, places, 21.7, 1e-2), prepare_several(shapes, places, 21.7, 1e-3)
    one, finer, other = (bodies.first_order(1.4556, HEADINGS) for bodies in (far, far.finer, near))
    size = np.sqrt(np.abs(np.diag(other.radiation)))
    size[5] = np.inf  # yaw of a cylinder moves no water
    stated, true = (np.abs((one.radiation - found.radiation) / np.outer(size, size)).max() for found in (finer, other))
    assert true < 1e-3 and stated < 1e-3 and true < 2 * stated
    assert np.abs((one.radiation - one.radiation.T) / np.outer(size, size)).max() < 1e-5
    forces = [found.froude_krylov + found.diffraction for found in (one, other)]
    assert np.abs(forces[0] - forces[1]).max() < 1e-4 * np.abs(forces[1]).max()


def test_each_shape_is_solved_once(far):
    assert len(far[0].alone) == 2 and len(far[0].at(OMEGA).alone) == 2


@pytest.fixture(scope="module")
def drifting():
    """Names → mean drift of the first two bodies, afloat and held, by partial waves and by pressure on panels"""
    mesh = assembled([box(16.0, 8.0, 3.0, panels=200).whole().moved(dx=1.0),
                      buoy(3.0, 4.0, panels=140).whole().rotated(0.4).moved(dx=2.0, dy=13.0)])  # fmt: skip
    mass, volume = np.zeros((12, 12)), np.array([384.0, np.pi * 36.0])
    stiffness = np.zeros((12, 12))
    for i, (area, roll, pitch) in enumerate([(128.0, 682.7, 2730.7), (9 * np.pi, 63.6, 63.6)]):
        six, d = slice(6 * i, 6 * i + 6), (3.0, 4.0)[i]
        mass[six, six] = 1025 * volume[i] * np.diag([1, 1, 1, 9, 20, 20])
        second = np.array([roll, pitch]) - volume[i] * d / 2
        stiffness[six, six] = 1025 * 9.80665 * np.diag([0, 0, area, *second, 0])
    bodies = Body("box", (1, 0, 0), place=(1, 0)), Body("buoy", (2, 13, 0), 0.4, False, (2, 13))
    more = {"depth": DEPTH, "bodies": bodies, "inertia_matrix": mass, "hydrostatic_stiffness": stiffness}
    names = {"drift_force_fixed", "drift_force", "body_drift_force_fixed", "body_drift_force"}
    waves = ShapeProblem(method="transfer", shapes=tuple(SHAPES[:2]), **more).prepared()
    panels = PanelProblem(mesh, lid(mesh), **more).prepared()
    return bodies, *(solve_frequency(one, OMEGA, HEADINGS, names) for one in (waves, panels))


@pytest.mark.parametrize(("end", "left"), [("_fixed", 0.02), ("", 0.03)])
def test_the_drift_of_each_is_that_by_pressure(drifting, end, left):
    """In axes of each about its own point; 340 panels leave two per cent, afloat three"""
    _, waves, panels = drifting
    one, other = waves["body_drift_force" + end], panels["body_drift_force" + end]
    assert np.abs(one - other)[..., :2].max() < left * np.abs(other[..., :2]).max()
    assert np.abs(one - other)[..., 2].max() < left * np.abs(other[..., 2]).max()


@pytest.mark.parametrize("end", ["_fixed", ""])
def test_the_drift_of_each_adds_up_to_the_far_field(drifting, end):
    bodies, waves, _ = drifting
    whole = waves["drift_force" + end]
    total = sum_about_origin(waves["body_drift_force" + end], bodies)
    assert total == pytest.approx(whole, abs=1e-3 * np.abs(whole).max())


def test_the_near_trapped_wave_between_four_cylinders():
    """On the bed in a square, a/d = 0.8: 54 times the force on one at ka 4.0848 (Evans & Porter 1997); here the gap
    below them is 8e-5 of the draft"""
    k, draft = 4.08482, 0.6
    depth = draft * (1 + 8e-5)
    omega = np.sqrt(9.80665 * k * np.tanh(k * depth))
    places = [Place(1.25 * x, 1.25 * y, 0.0) for x in (-1, 1) for y in (-1, 1)]
    far = prepare_far([("buoy", (1.0, draft))] * 4, places, depth, 1e-3)
    found = far.first_order(omega, [np.pi / 4])
    force = (found.froude_krylov + found.diffraction).reshape(4, 6)
    alone = far.bodies[0].first_order(omega, [0.0])
    one = abs(alone.froude_krylov + alone.diffraction)[0, 0]
    assert np.linalg.norm(np.abs(force[:, :2]), axis=1).max() / one == pytest.approx(54, rel=0.01)


def test_circles_that_overlap_or_nearly_touch_are_refused():
    """Those around two squares of 20 m have a radius of 14.142 m"""
    squares = [("box", (20.0, 20.0, 5.0))] * 2
    with pytest.raises(
        ValueError,
        match=r"circles around bodies 1 and 2 overlap by 0.0843 m; transfer matrices need at least 0.4 m between two",
    ):
        prepare_far(squares, [Place(0, 0, 0), Place(28.2, 0, 0)], 20.0)
    with pytest.raises(ValueError, match=r"are 0\.39 m apart"):
        prepare_far([("buoy", (3.0, 4.0))] * 2, [Place(0, 0, 0), Place(0, 6.39, 0)], 20.0)
    assert prepare_far(squares, [Place(0, 0, 0), Place(28.7, 0, 0)], 20.0).apart.min() == pytest.approx(28.7)
