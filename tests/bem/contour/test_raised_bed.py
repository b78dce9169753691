"""Short waves over deep water by a raised bed: what they must not notice, and that the estimate covers what they do."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.checks import check, damping_scale, excitation_scale, radiation_scale
from hakobune.bem.contour.raised_bed import EFFECT, HIGHEST, LEAST_GAP, effect_of_bed, raised_bed
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.methods.shape_problem import ShapeProblem
from hakobune.bem.waves import group_factor, wavenumber
from hakobune.meshing.shapes import box

GRAVITY = 9.80665
WANT = {"added_mass", "radiation_damping", "excitation_force", "drift_force_fixed"}
BODIES = {"box": [(60.0, 40.0, 5.0), (20.0, 2.0, 10.0), (80.0, 10.0, 2.0)], "buoy": [(10.0, 1.0), (2.0, 10.0)]}
ALL = [(shape, sizes) for shape, several in BODIES.items() for sizes in several]


def longest(shape, sizes, tolerance):
    """Smallest k that is answered over a raised bed, rad/m, to a per cent"""
    k = 1e-3 / max(sizes)
    while raised_bed(shape, sizes, tolerance, k) is None:
        k *= 1.01
    return k


def short_waves(shape, sizes, k, tolerance=0.01, times=1.0):
    """The run in endless depth over the bed that is chosen, or over one `times` as far below the keel"""
    bed = sizes[-1] + times * (raised_bed(shape, sizes, 0.01, k) - sizes[-1])
    problem = ShapeProblem(method="contour", shape=shape, sizes=sizes, tolerance=tolerance, bed=bed)
    return problem.prepared().run(np.sqrt(GRAVITY * k), np.radians([0.0, 25.0]), WANT, None, DOFS)


@pytest.mark.parametrize("tolerance", [0.2, 0.01, 3e-3])
@pytest.mark.parametrize(("shape", "sizes"), ALL)
def test_waves_have_the_wavenumber_and_group_velocity_of_endless_depth(shape, sizes, tolerance):
    k = longest(shape, sizes, tolerance)
    bed = raised_bed(shape, sizes, tolerance, k)
    assert wavenumber(np.sqrt(GRAVITY * k), bed, GRAVITY) == pytest.approx(k, rel=1e-10)
    assert group_factor(k, bed) == pytest.approx(0.5, rel=1e-10)


@pytest.mark.parametrize(("shape", "sizes"), ALL)
def test_the_error_against_a_bed_four_times_as_deep_is_below_the_stored_estimate(shape, sizes):
    for factor in (1, 4):
        k = factor * longest(shape, sizes, 0.01)
        ours, deep = short_waves(shape, sizes, k), short_waves(shape, sizes, k, 1e-3, times=4)
        radiation = np.abs(ours.radiation - deep.radiation) / radiation_scale(deep)
        force = np.abs(ours.excitation - deep.excitation) / excitation_scale(deep)
        estimate = ours.estimated_error()
        assert max(radiation.max(), force.max()) < estimate < 0.02
        assert estimate >= effect_of_bed(shape, sizes, ours.problem.bed)


@pytest.mark.parametrize(("shape", "sizes"), ALL)
def test_energy_reciprocity_and_haskind_hold_with_the_waves_of_endless_depth(shape, sizes):
    run = short_waves(shape, sizes, 2 * longest(shape, sizes, 0.01))
    laws = check(run)
    assert run.k == pytest.approx(run.omega**2 / run.problem.gravity, rel=1e-15) and run.group_factor == 0.5
    assert max(laws["energy"], laws["reciprocity"], laws["Haskind"]) < run.estimated_error()


@pytest.mark.parametrize("sizes", [(200.0, 20.0, 10.0), (20.0, 20.0, 10.0)])
def test_the_effect_of_the_bed_falls_at_second_order_or_faster(sizes):
    """A dipole in the still surface and its images below the bed"""
    k = longest("box", sizes, 0.01) * 3
    runs = [short_waves("box", sizes, k, 1e-4, times) for times in (0.3, 0.6, 4.0)]
    scale = radiation_scale(runs[-1])
    near, far = (np.abs(run.radiation - runs[-1].radiation) / scale for run in runs[:2])
    assert np.log2(near[2, 2] / far[2, 2]) > 1.9
    for part, run in ((near, runs[0]), (far, runs[1])):
        assert part.max() < effect_of_bed("box", sizes, run.problem.bed)


def test_estimates_of_what_symmetry_makes_zero_stay_zero():
    problem = ShapeProblem(method="contour", shape="box", sizes=(60.0, 40.0, 5.0), tolerance=0.01, bed=205.0)
    arguments = (1.2, [0.0], WANT, None, DOFS)
    run, bare = (s.prepared().run(*arguments) for s in (problem, replace(problem, depth=205.0)))
    (with_it, force), (without, _) = run.errors, bare.errors
    scale = radiation_scale(run)
    zero = without == 0
    assert zero[0, 2] and np.all(with_it[zero] == 0) and np.all(force[:, [1, 3, 5]] == 0)
    own = damping_scale(run.radiation, run.prepared.displacing)
    for part, size in ((np.real, scale), (np.imag, own)):
        grown = (np.abs(part(with_it)) - np.abs(part(without)))[~zero] / size[~zero]
        np.testing.assert_allclose(grown, 0.7 * (20 / 200) ** 2, rtol=1e-6)


def test_limits_are_those_of_the_real_depth():
    sizes = (60.0, 40.0, 5.0)
    problem = ShapeProblem(
        method="contour", shape="box", sizes=sizes, bed=405.0, panels=PanelProblem(box(*sizes, panels=300))
    )
    zero, infinity = (problem.prepared().added_mass_limit(which) for which in ("zero", "infinity"))
    assert np.isfinite(zero).all()
    over = replace(problem, bed=None, depth=405.0).prepared().added_mass_limit("infinity")
    size = np.sqrt(np.abs(np.diag(over)))
    np.testing.assert_allclose(infinity / np.outer(size, size), over / np.outer(size, size), atol=0.01)
    finite = replace(problem, depth=3000.0, panels=replace(problem.panels, depth=3000.0))
    assert finite.prepared().added_mass_limit("zero")[2, 2] == np.inf


def test_long_waves_and_bodies_too_flat_or_too_slender_have_no_raised_bed():
    assert raised_bed("box", (100.0, 40.0, 12.0), 0.01, 2 * np.pi / 101) is None
    assert raised_bed("box", (1000.0, 4.0, 2.0), 0.01, 2 * np.pi / 900) is None  # kh of 1
    assert raised_bed("buoy", (100.0, 0.9), 0.01, 1.0) is None
    assert raised_bed("buoy", (1.0, 110.0), 0.01, 10.0) is None
    assert raised_bed("buoy", (10.0, 5.0), 1e-4, 1.0) is None
    assert raised_bed("buoy", (10.0, 5.0), 1e-3, 1.0) is not None


@pytest.mark.parametrize("tolerance", [0.1, 0.01, 2e-3])
def test_the_contour_method_takes_the_flattest_and_slenderest_bodies_over_their_bed(tolerance):
    ratio = 0.999 * HIGHEST / max(LEAST_GAP**2, 2 * EFFECT / tolerance)
    for sizes in ((ratio, 1.0), (1.0, ratio)):
        bed = raised_bed("buoy", sizes, tolerance, 100.0)
        assert bed is not None and raised_bed("buoy", tuple(np.array(sizes) ** 1.01), tolerance, 100.0) is None
        problem = ShapeProblem(method="contour", shape="buoy", sizes=sizes, tolerance=tolerance, bed=bed)
        assert problem.prepared().solver.depth == bed


def test_the_bed_lies_as_deep_as_the_tolerance_asks_for_and_ten_times_the_body_at_least():
    """h = d + F c, F = max(10, √(1.4 / tolerance)), c the larger of draft and half the smaller width"""
    k = 2.0
    for shape, sizes, half, draft in (("box", (40.0, 20.0, 5.0), 10.0, 5.0), ("buoy", (10.0, 5.0), 10.0, 5.0),
                                      ("box", (40.0, 6.0, 8.0), 3.0, 8.0)):  # fmt: skip
        for tolerance, factor in ((0.2, 10.0), (0.0141, 10.0), (0.0139, np.sqrt(1.4 / 0.0139)), (2e-3, np.sqrt(700))):
            bed = raised_bed(shape, sizes, tolerance, k)
            assert bed == pytest.approx(draft + factor * max(half, draft))
            effect = 0.7 * (max(half, draft) / (bed - draft)) ** 2
            assert effect_of_bed(shape, sizes, bed) == pytest.approx(effect)
            assert factor == 10.0 or effect == pytest.approx(tolerance / 2)


def test_waves_are_short_from_the_width_of_the_body_and_from_fourteen_radians_of_depth():
    buoy, bed = (10.0, 5.0), 105.0
    assert raised_bed("buoy", buoy, 0.2, 2 * np.pi / 20 * 0.999) is None
    assert raised_bed("buoy", buoy, 0.2, 2 * np.pi / 20 * 1.001) == pytest.approx(bed)
    long = (400.0, 2.0, 1.0)  # 11 m deep: kh of 14 is a wave of 5 m
    assert raised_bed("box", (5.0, 2.0, 1.0), 0.2, 13.9 / 11) is None  # a wave of 4.97 m
    assert raised_bed("box", (5.0, 2.0, 1.0), 0.2, 14.1 / 11) == pytest.approx(11.0)
    assert raised_bed("box", long, 0.2, 14.1 / 11) == pytest.approx(11.0)


def test_flat_and_slender_bodies_lose_digits_beyond_fourteen_thousand():
    """F² max(b, d) / min(b, d), of F = 10: a ratio of 140"""
    for sizes, works in (((139.0, 1.0), True), ((141.0, 1.0), False), ((1.0, 139.0), True), ((1.0, 141.0), False)):
        assert (raised_bed("buoy", sizes, 0.2, 100.0) is not None) == works


def test_a_third_of_the_tolerance_is_left_to_the_contour_method():
    """Which takes half a digit more than it is asked for"""
    problem = ShapeProblem(method="contour", shape="buoy", sizes=(10.0, 5.0), tolerance=0.03, bed=105.0)
    assert problem.prepared().solver.tolerance == pytest.approx(0.01 * 10**-0.5)
    assert replace(problem, bed=None, depth=105.0).prepared().solver.tolerance == pytest.approx(0.03 * 10**-0.5)
