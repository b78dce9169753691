"""Waves too short to be resolved: corners and walls, circles, geometrical optics, laws, and resolved waves."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import h1vp

from hakobune.bem import DOFS
from hakobune.bem.checks import check, excitation_scale, radiation_scale
from hakobune.bem.contour.accuracy import accuracy, finer, height
from hakobune.bem.contour.one_frequency import ContourFrequency
from hakobune.bem.contour.plan.maps import CLASSES
from hakobune.bem.contour.plan.rectangle import Rectangle
from hakobune.bem.contour.plan.wedge_diffraction import OPEN, asymptotic_map, edge_integral, edge_wave, wall_integral
from hakobune.bem.contour.short_wave_frequency import ShortWaveFrequency
from hakobune.bem.contour.short_waves import MOST_WAVES, neglected, share_below, unresolved, waves_along
from hakobune.bem.contour.solver import prepare_box, prepare_cylinder
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.waves import depth_factor

DENSITY, GRAVITY = 1025.0, 9.80665
HEADINGS = np.radians([0.0, 2.0, 30.0, 45.0, 90.0, 200.0])
WANT = {"added_mass", "radiation_damping", "excitation_force"}


def frequency(k, depth):
    return float(np.sqrt(GRAVITY * k * np.tanh(k * depth)))


def first_order(body, k, solver, headings=HEADINGS):
    return solver(body, frequency(k, body.depth), headings, (), range(6), DENSITY, GRAVITY).result()


def excitation(r):
    return r.froude_krylov + r.diffraction


def run_of(shape, sizes, depth, k, headings=HEADINGS, tolerance=0.01):
    problem = ShapeProblem(method="contour", shape=shape, sizes=sizes, depth=depth, tolerance=tolerance)
    return problem.prepared().run(frequency(k, depth), headings, WANT, None, DOFS)


@pytest.mark.parametrize("degrees", [0.1, 30.0, 89.0, 91.0, 150.0, 179.0])
def test_an_edge_makes_the_whole_field_less_the_wave_and_its_reflection(degrees):
    angle = np.radians(degrees)
    assert edge_integral(angle) == pytest.approx(wall_integral(angle) + 2j / np.cos(angle), rel=1e-9)


@pytest.mark.parametrize("x", [1e2, 1e4])
def test_the_field_on_a_wall_is_continuous_where_the_wave_begins_to_reach_it(x):
    turn = 1e-8
    lit, dark = 2 * np.exp(1j * x * np.cos(turn)) + edge_wave(np.pi - turn, x), edge_wave(np.pi + turn, x)
    assert lit == pytest.approx(dark, abs=1e-4) and abs(dark) == pytest.approx(1, abs=0.1)


def test_a_wave_along_a_wall_is_sent_as_it_is_received():
    """Reciprocity of a corner: from one wall to the other, and back along the first"""
    sent = edge_wave(0.0, 1e6) / edge_wave(OPEN, 1e6)
    assert sent == pytest.approx(wall_integral(OPEN) / wall_integral(0.0), rel=1e-5)


@pytest.mark.parametrize("cls", CLASSES)
def test_the_map_of_waves_is_symmetric(cls):
    weak = asymptotic_map(Rectangle.to_digits(5.0, 2.0, 3), cls, (8, 12), 60.0, HEADINGS).weak
    assert np.abs(weak - weak.T).max() < 1e-2 * np.abs(weak - np.diag(np.diag(weak))).max()


def plane_error(waves):
    """Largest error of forces on walls and of moving walls of a 2 × 1 rectangle, over what a corner gives"""
    plan, degree, k = Rectangle.to_digits(2.0, 1.0, 6), (1, 1), np.pi * waves
    contour, found = plan.contour(k, degree, 1e-5), []
    full = plan.waves(CLASSES, degree, k, contour, HEADINGS)
    for cls, wave in full.items():
        ours = asymptotic_map(plan, cls, degree, k, HEADINGS)
        found.append(np.abs(ours.projected - wave.projected).max() * k)
        found.append(np.abs(ours.weak - wave.weak).max() * k**2)
    return max(found) / (4 * np.sqrt(1 / 2) * abs(wall_integral(0.0)) / 2)


def test_walls_and_corners_answer_as_the_integral_equation_does_but_for_the_first_power_of_the_wave_length():
    waves = np.array([10, 20, 40])
    errors = np.array([plane_error(n) for n in waves])
    assert np.all(errors < 1 / (np.pi * waves)), errors
    assert np.polyfit(np.log(waves), np.log(errors), 1)[0] < -0.8, errors


@pytest.mark.parametrize("waves", [3, 30])
@pytest.mark.parametrize("depth", [5.2, 30.0])
def test_about_a_circle_nothing_is_left_out(waves, depth):
    body, k = prepare_cylinder(10.0, 5.0, depth, 1e-6), 2 * np.pi * waves / 20
    ours, resolved = (first_order(body, k, solver) for solver in (ShortWaveFrequency, ContourFrequency))
    for name in ("radiation", "froude_krylov", "diffraction", "haskind"):
        own, other = getattr(ours, name), getattr(resolved, name)
        assert np.abs(own - other).max() < 1e-6 * np.abs(other).max(), name
    far = first_order(body, k, ShortWaveFrequency).radiated
    assert np.abs(far - ours.radiation.imag).max() < 1e-6 * np.abs(ours.radiation).max()


@pytest.mark.parametrize("waves", [500, 5000])
def test_surge_of_a_short_wave_on_a_buoy_is_that_on_a_cylinder_down_to_the_bed(waves):
    """MacCamy and Fuchs (1954): 4ρg tanh kh / (k² |H₁'(kR)|); waves do not feel the keel, e^(−kd) < 1e-10"""
    k = np.pi * waves / 10
    force = run_of("buoy", (10.0, 8.0), 20.0, k).excitation[0]
    assert abs(force[0]) == pytest.approx(4 * DENSITY * GRAVITY / (k**2 * abs(h1vp(1, k * 10.0))), rel=1e-8)
    assert np.abs(force[[1, 3, 5]]).max() < 1e-9 * abs(force[0])


def test_forces_of_geometrical_optics_are_the_limit_of_head_sea():
    """2ρg B/k on the wall ahead, and a piston's B/ω = 2ρ B/k² on either end; corners are of order 1/kB of these"""
    errors = []
    for waves in (300, 1200):
        k = 2 * np.pi * waves / 100
        run = run_of("box", (100.0, 20.0, 8.0), 20.0, k, np.zeros(1))
        force, damping = run.excitation[0, 0], run.radiation[0, 0].imag
        errors.append([abs(abs(force) * k / (2 * DENSITY * GRAVITY * 20) - 1), damping * k**2 / (4 * DENSITY * 20) - 1])
        assert max(np.abs(errors[-1])) < 2 / (k * 20)
    assert np.abs(errors[1])[1] < 0.5 * np.abs(errors[0])[1]


@pytest.mark.parametrize(("phase", "gap", "sizes"), [
    (1.0, 0.02, (100.0, 40.0)), (1.0, 2.0, (70.0, 100.0)), (2.5, 0.3, (100.0, 100.0)), (4.0, 0.02, (30.0, 100.0)),
    (12.0, 1.0, (100.0, 60.0)),
])  # fmt: skip
def test_resolved_and_unresolved_waves_agree_within_the_sum_of_their_estimates(sizes, phase, gap, monkeypatch):
    k = 2 * np.pi * 30 / 100
    draft = phase / k
    arguments = "box", (*sizes, draft), draft * (1 + gap), k
    resolved = run_of(*arguments)
    known = resolved.result(), resolved.estimated_errors()
    monkeypatch.setitem(MOST_WAVES, "box", 25)
    ours = run_of(*arguments)
    result, errors = ours.result(), ours.estimated_errors()
    Z = radiation_scale(resolved)
    size = {"added_mass": Z, "radiation_damping": Z * resolved.omega, "excitation_force": excitation_scale(resolved)}
    assert ours.first_order.neglected is not None and resolved.first_order.neglected is None
    for name, error in errors.items():
        allowed = error + known[1][name] + 1e-4 * size[name]
        assert np.all(np.abs(result[name] - known[0][name]) <= allowed), name


@pytest.mark.parametrize(("shape", "sizes", "depth"), [
    ("box", (100.0, 20.0, 2.0), 2.1), ("box", (30.0, 100.0, 0.5), 1.0), ("buoy", (50.0, 1.0), 1.01),
])  # fmt: skip
@pytest.mark.parametrize("waves", [450, 3000])
def test_the_laws_hold(shape, sizes, depth, waves):
    run = run_of(shape, sizes, depth, 2 * np.pi * waves / 100)
    run.result()
    laws, estimate = check(run), run.estimated_error()
    assert max(laws["reciprocity"], laws["Haskind"], laws["energy"]) < max(estimate, 1e-8)
    B = run.radiation.imag / np.sqrt(np.outer(*[np.abs(np.diag(run.radiation)) + 1e-300] * 2))
    assert np.linalg.eigvalsh((B + B.T) / 2).min() > -max(estimate, 1e-8)


def test_the_estimate_grows_where_waves_feel_the_keel_and_along_walls():
    def neglected(draft, heading):
        body = prepare_box(100.0, 30.0, draft, 4 * draft, 0.01)
        return first_order(body, 2 * np.pi * 300 / 100, ShortWaveFrequency, np.radians([heading])).neglected[1][0]

    assert np.all(neglected(0.05, 20.0)[:5] > 3 * neglected(0.2, 20.0)[:5])
    assert neglected(0.05, 0.0)[0] > 3 * neglected(0.05, 45.0)[0]


@pytest.mark.parametrize(("k", "draft", "depth"), [(0.1, 5.0, 6.0), (1.0, 5.0, 5.1), (0.5, 2.0, 60.0)])
def test_the_share_of_a_wave_below_the_keel_is_that_of_its_square(k, draft, depth):
    def square(z):
        return depth_factor(z, k, depth) ** 2

    below, beside = quad(square, -depth, -draft)[0], quad(square, -draft, 0)[0]
    assert share_below(k, draft, depth) == pytest.approx(below / (below + beside), rel=1e-9)


def test_waves_are_not_resolved_from_the_border_on_where_they_have_an_answer():
    k = 2 * np.pi / 100 * 201
    assert unresolved((100.0, 20.0, 1.0), k) and not unresolved((100.0, 20.0, 1.0), 0.99 * k)
    assert waves_along((30.0, 100.0, 1.0), k) == pytest.approx(201)
    assert not unresolved((100.0, 1.0, 1.0), k) and not unresolved((100.0, 20.0, 0.01), k)
    assert unresolved((50.0, 0.01), 2 * k) and not unresolved((50.0, 0.01), 1.9 * k)


def test_a_far_field_of_waves_that_are_not_resolved_is_refused_in_one_line():
    body = prepare_box(100.0, 20.0, 2.0, 20.0)
    with pytest.raises(ValueError, match=r"too many waves along the body for a far field; leave out kochin and drift"):
        body.first_order(frequency(20.0, 20.0), [0.0], [0.0])


def test_waves_without_an_answer_of_either_kind_are_those_beyond_what_was_measured():
    """kb of 55 and kd of 0.5 of a box, with 201 waves along it"""
    k = 2 * np.pi * 201 / 100
    for beam, draft, known in ((54.5, 1.0, False), (55.5, 1.0, True), (60.0, 0.49, False), (60.0, 0.51, True)):
        assert unresolved((100.0, beam / k, draft / k), k) == known
        assert unresolved((beam / k, 100.0, draft / k), k) == known
    assert unresolved((100.0, 90.0, 9.0), k * 100_000 / 201.001) and not unresolved(
        (100.0, 90.0, 9.0), k * 100_000 / 200.9
    )


def test_what_is_neglected_is_of_the_corners_and_of_the_waves_under_the_keel():
    """12/kb + 6E, and 12/kb + 6E/√(1 − |cos γ| + 1/ka) of the wall along which the wave runs more"""
    k, a, b, share, beta = 2.0, 50.0, 30.0, 0.01, np.array([0.0, 0.3, np.pi / 2])
    radiation, excitation = neglected(k, (a, b), share, beta)
    assert radiation == pytest.approx(12 / 60 + 0.06)
    along_x = 1 / np.sqrt(1 - np.cos(beta) + 1 / (k * a))
    along_y = 1 / np.sqrt(1 - np.sin(beta) + 1 / (k * b))
    assert excitation == pytest.approx(12 / 60 + 0.06 * np.maximum(along_x, along_y))


def test_parts_of_the_contour_method_are_as_fine_as_its_docstring_says():
    """Each part's error by its formula: with one step less it would not be reached"""
    for digits, draft, gap, scale in ((4.0, 5.0, 3.0, 10.0), (6.0, 5.0, 200.0, 10.0), (2.0, 5.0, 0.1, 20.0)):
        found, r, g = accuracy(digits, draft, gap, scale), gap / min(draft, scale), gap / scale
        high = max(g / 4, 1)
        assert height(gap, scale) == high

        def of_gap(T, r=r):
            return 8 * (1 + r) ** -0.7 + (T - 1) * (0.8 + 1.7 / (1 + r / 4))

        assert of_gap(found.terms) >= digits and (found.terms == 1 or of_gap(found.terms - 1) < digits)
        assert found.modes == pytest.approx(max(10.5, 15 * (digits - 1.5) / 1.2))
        assert found.kappa == pytest.approx(max(1, (digits - 0.8 + np.log10(g**1.45 * high**1.5)) / 1.15))
        assert found.plan == pytest.approx(max(3, (digits - 1.2 + 3.3 * np.log10(high)) / 1.3))
        assert found.extra == max(1, np.ceil(1.5 * (digits - 2.4)))
        assert found.smallest == pytest.approx(max(10 ** (-3 - digits), 1e-8) / high)
        better = finer(found, draft, gap, scale)
        assert better.digits == digits + 1 and better.further == 1 and better.extra == found.extra
        assert better.plan >= found.plan + 1 / 1.3 - 1e-12 and better.kappa >= found.kappa + 1 / 1.15 - 1e-12
        assert found.terms <= better.terms <= found.terms + 2
