"""Largest tensions of lines that whip, whose elements strike taut one by one: right, or said not to be."""

import warnings

import numpy as np
import pytest

from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, ElasticBed, FairleadMotion, simulate

# length, depth, span, diameter in m, way of the fairlead in m, its period in s, friction, damping ratio
ROPES = (
    (433.5, 114.6, 349.2, 0.1675, (0.916, 1.138, 2.646), 13.8, 0.5, 0.3),
    (663.2, 137.6, 605.0, 0.150, (2.385, -2.421, 1.339), 12.9, 0.0, 0.1),
    (1504.0, 246.1, 1392.5, 0.1316, (1.672, 1.845, 1.259), 7.5, 0.5, 1.0),
)


def rope(length, depth, span, diameter, way, period, friction, damping):
    """A polyester rope in 30 elements, the motion of its fairlead, and three cycles of it in s."""
    displaced, mass = 0.88 * diameter, 750.0 * diameter**2
    weight = (mass - 1025.0 * np.pi / 4 * displaced**2) * 9.80665
    more = dict(damping_ratio=damping, drag_normal=1.4, drag_tangential=0.05)
    segment = DynamicSegment(length, mass, weight, displaced, 3e9 * diameter**2, 30, **more)
    line = DynamicLine(segment, (-span, 0.0, -depth), bed=ElasticBed(friction=friction))
    return line, FairleadMotion.harmonic((0, 0, -2.0), 1j * np.array(way), period), 3 * period


def peaks(run):
    return np.array([run.tension_fairlead.max(), run.largest_tension.max()])


@pytest.mark.parametrize("given", ROPES)
def test_what_is_said_of_the_largest_tension_of_a_whipping_rope_covers_its_error(given):
    line, motion, duration = rope(*given)
    with pytest.warns(
        UserWarning, match="an error of .* in the largest tensions, allowed 2.0%; give a tolerance smaller"
    ):
        run = simulate(line, motion, duration)
    fine = simulate(line, motion, duration, tolerance=1e-5, check_mesh=False)
    error = np.abs(peaks(run) / peaks(fine) - 1).max()
    assert 0.5 * error < run.step_error < 1.0


def test_what_is_said_falls_with_the_tolerance():
    line, motion, duration = rope(*ROPES[0])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        told = [simulate(line, motion, duration, tolerance=t).step_error for t in (1e-3, 1e-5)]
    assert told[1] < 0.5 * told[0]


def test_a_line_that_hangs_quietly_is_known_well():
    line, _, _ = rope(*ROPES[0])
    run = simulate(line, FairleadMotion.harmonic((0, 0, -2.0), (0.5j, 0, 0), 40.0), 80.0, mesh_tolerance=1.0)
    assert run.step_error < 5e-3
