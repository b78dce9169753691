"""Lines that rise out of the water: weight in air, no water felt, books of energy, orders of convergence."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from hakobune.mooring.lines.catenary.solve import solve_lines
from hakobune.mooring.lines.dynamics.line import DynamicLine, DynamicSegment
from hakobune.mooring.lines.dynamics.simulation import FairleadMotion, WaveTrain, simulate
from hakobune.mooring.lines.dynamics.start import start
from hakobune.mooring.lines.dynamics.surroundings import water_arrays
from hakobune.mooring.lines.multi_segment import line as static

G, RHO = 9.80665, 1025.0
MASS, DIAMETER, EA = 30.0, 0.14, 5e7
WET = G * (MASS - RHO * np.pi / 4 * DIAMETER**2)
STILL = water_arrays(None, None, G)


def line(anchor, length=120.0, elements=20, surface=True, **changes):
    given = dict(weight=WET, mass=MASS, diameter=DIAMETER, axial_stiffness=EA, added_tangential=0.3) | changes
    return DynamicLine(DynamicSegment(length, elements=elements, **given), anchor, bed=None, surface=surface)


def quiet(line, motion, duration, **options):
    return simulate(line, motion, duration, check_mesh=False, **options)


def heave(amplitude, period, z=20.0):
    return FairleadMotion.harmonic((0, 0, z), (0, 0, 1j * amplitude), period)


def test_a_plumb_line_weighs_as_in_air_above_and_as_in_water_below():
    """However the elements lie to the surface: what each weighs more in air adds up to the length above"""
    for z in (3.0, 7.3, 11.9):
        still = quiet(line((0, 0, z - 60.2), 60.0), FairleadMotion.still((0, 0, z)), 0.1)
        carried = -still.force_fairlead[0, 2] - still.force_anchor[0, 2]
        stretch = 60.2 / 60.0
        assert np.isclose(carried, WET * 60.0 + (G * MASS - WET) * z / stretch, rtol=1e-4)


def test_a_line_in_air_is_the_catenary_of_its_weight_there_and_loses_nothing_to_water():
    hung = line((-100.0, 0, 20.0), elements=40)
    exact = float(solve_lines(100.0, 20.0, 120.0, G * MASS, EA, bed=False).tension_fairlead)
    moved = quiet(hung, heave(1.0, 8.0, 40.0), 16.0, waves=WaveTrain(2.0, 8.0, 0.0))
    assert np.isclose(moved.tension_fairlead[0], exact, rtol=1e-3)
    assert np.all(moved.energies.drag == 0) and np.all(moved.energies.water_inertia == 0)


def test_a_line_far_below_the_surface_does_not_know_of_it():
    deep = line((-100.0, 0, -80.0), surface=False)
    one, other = (quiet(each, heave(1.0, 8.0, -30.0), 8.0) for each in (deep, replace(deep, surface=True)))
    assert np.array_equal(one.tension_fairlead, other.tension_fairlead)


def test_a_line_through_the_surface_rests_as_one_of_two_weights():
    """Oracle: a static line of two segments, the upper one as heavy as in air, joined where it crosses the surface"""
    span, top, below, length = 90.0, 15.0, 40.0, 115.0

    def solved(dry):
        parts = [static.Segment(length - dry, WET, EA), static.Segment(dry, G * MASS, EA)]
        return static.StaticLine(parts, [], None).solve(span, top + below)

    def joint(dry):
        return solved(dry).at(np.array([length - dry]))[0, 1] - below

    exact = solved(brentq(joint, 5.0, 60.0, xtol=1e-10)).tension_fairlead
    errors = []
    for n in (20, 40, 80):
        still = quiet(line((-span, 0, -below), length, n), FairleadMotion.still((0, 0, top)), 0.1)
        errors.append(abs(still.tension_fairlead[0] / exact - 1))
    assert errors[-1] < 1e-4 and np.log2(errors[0] / errors[-1]) > 2 * 1.8, errors


def test_a_light_rope_floats_where_its_wet_share_carries_it():
    light = dict(weight=-30.0, mass=12.0)
    rope = line((-80.0, 0, 0.0), 81.0, 30, axial_stiffness=2e6, **light)
    z = start(rope, (0, 0, 0.0), STILL).position[10:20, 2]
    assert np.abs(z).max() < np.pi / 8 * DIAMETER
    share, ends = G * 12.0 / (G * 12.0 + 30.0), np.pi / 4 * DIAMETER  # wet, and where none and all of it would be
    x = z.mean() / ends
    dry = 0.5 * (1 + x) ** 2 if x < 0 else 1 - 0.5 * (1 - x) ** 2
    assert np.isclose(1 - dry, share, rtol=1e-2)


def test_tangent_of_a_line_through_the_surface_is_the_derivative_of_its_forces(tangent_fault):
    plain = dict(drag_normal=0.0, drag_tangential=0.0, added_normal=0.0, added_tangential=0.0)
    crossing = line((-80.0, 0, -25.0), elements=9, **plain)
    rest, rng = start(crossing, (0, 0, 15.0), STILL), np.random.default_rng(1)
    moved = rest.position + 1e-3 * rng.standard_normal((10, 3))
    speed, a, direction = 0.05 * rng.standard_normal((3, 10, 3))
    assert tangent_fault(crossing.system, moved, speed, a, direction, rest.position, 1e-3, 0.03) < 1e-5
    level = line((-80.0, 0, 0.0), elements=9, weight=-50.0, axial_stiffness=1e4, **plain)
    flat = np.column_stack([np.linspace(-80, 0, 10), np.zeros(10), 0.03 * rng.standard_normal(10)])
    assert tangent_fault(level.system, flat, speed, a, direction, flat, 1e-3, 0.03) < 1e-5


def test_books_of_energy_of_a_line_through_the_surface_close_at_second_order():
    gaps = []
    for step in (0.2, 0.1, 0.05):
        crossing = line((-90.0, 0, -40.0), 115.0, 10, damping_ratio=0.1)
        moved = quiet(crossing, heave(3.0, 12.0, 10.0), 12.0, tolerance=0.1, longest_step=step)
        E = moved.energies
        gaps.append(abs(E.work - E.lost - E.stored)[-1])
    assert np.log2(gaps[0] / gaps[-1]) > 2 * 1.8, gaps


def test_tension_of_a_line_through_the_surface_converges_at_second_order_in_time_and_in_the_elements():
    motion = heave(3.0, 12.0, 10.0)
    crossing = line((-90.0, 0, -40.0), 115.0, 10)
    fine = quiet(crossing, motion, 9.0, tolerance=1e-6)
    errors = [off(quiet(crossing, motion, 9.0, tolerance=0.1, longest_step=h), fine) for h in (0.2, 0.1, 0.05)]
    assert np.log2(errors[0] / errors[-1]) > 2 * 1.8, errors
    runs = [quiet(line((-90.0, 0, -40.0), 115.0, n), motion, 9.0, tolerance=1e-5) for n in (5, 20, 80)]
    errors = [off(run, runs[-1]) for run in runs[:-1]]
    assert np.log2(errors[0] / errors[-1]) > 2 * 1.7, errors


def off(run, fine):
    """N, root mean square difference from a finer run"""
    return np.sqrt(np.mean((run.tension_fairlead - np.interp(run.time, fine.time, fine.tension_fairlead)) ** 2))


def test_a_line_heavier_in_water_than_in_air_is_refused():
    with pytest.raises(ValueError, match="allowed: no more in water than in air"):
        line((0, 0, -20.0), weight=G * MASS + 1)
