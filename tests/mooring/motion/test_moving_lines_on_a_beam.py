"""Two chains with a motion of their own at the ends of a beam that bends: driven by what its shapes do, slow as in
their static shape, and taking from the beam what they are given."""

from dataclasses import replace

import numpy as np
import pytest
from bending_body import bending
from two_bodies import DEPTH

from hakobune.bem.time_domain.memory import no_memory
from hakobune.mooring.lines.catalogue import line_type
from hakobune.mooring.lines.dynamics.simulation import FairleadMotion
from hakobune.mooring.lines.dynamics.simulation import simulate as drive
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.lines.system.moored_body import Leg, moored_body
from hakobune.mooring.lines.system.parts import UniformLine
from hakobune.mooring.motion.given_forces import GivenForce
from hakobune.mooring.motion.moving_lines.prepare import dynamic_line
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.wave_loads import no_wave_forces
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Waves

ENDS = {"fore": np.array([49.0, 15.0, -1.0]), "aft": np.array([-49.0, 15.0, -1.0])}
HOW = Settings(20.0, 20.0, 0.05, memory="constant", slow_drift="none", tolerance=1e-5, constant_period=8.0)


@pytest.fixture(scope="module")
def beam():
    """On the chains, taut enough to pull all the time; two shapes of vertical bending"""
    body, kind = bending(2, kinds=("vertical bending",)), line_type("R3 studless 76 mm")
    legs = [Leg(UniformLine(name, kind, 158.0, "", ""), (4.2 * p[0], p[1], -DEPTH), tuple(p))
            for name, p in ENDS.items()]  # fmt: skip
    lines = moored_body(legs, DEPTH, body.rotation_center, 1025.0, 9.80665)
    return moored(body, lines, memory=no_memory(body), damping=0.05 * body.inertia)


def course(beam, run, name):
    """Place and velocity (n, 3) of a fairlead by hand: r + R (p + Σ ξ u), ṙ by spline"""
    from scipy.interpolate import CubicSpline

    shapes, p = [mode.shape for mode in beam.reader.modes], ENDS[name]
    u = np.array([[-p[2] * one.along(p[0], 1), 0.0, one.along(p[0])] for one in shapes])
    own = p + run.motion[:, 6:] @ u
    place = np.array([eta[:3] + rotation(*eta[3:6]) @ at for eta, at in zip(run.motion, own, strict=True)])
    return place, CubicSpline(run.time, place).derivative()(run.time), (run.motion[:, 6:] - run.motion[0, 6:]) @ u


@pytest.fixture(scope="module")
def in_waves(beam):
    """In a regular wave that grows, with both chains in motion"""
    return simulate(beam, Weather(regular=Waves(1.0, 8.0, 0.5)), replace(HOW, dynamic_lines="all"))


def test_they_pull_as_the_same_lines_driven_by_the_course_of_their_fairleads(beam, in_waves):
    for i, (name, p) in enumerate(ENDS.items()):
        place, velocity, bent = course(beam, in_waves, name)
        line = dynamic_line(beam.system.lines[i], (4.2 * p[0], p[1], -DEPTH), beam.system, HOW.dynamic_elements)
        t = in_waves.time + HOW.ramp
        alone = drive(line, FairleadMotion.table(t, place, velocity), t[-1], tolerance=1e-5, check_mesh=False)
        pull = np.interp(t, alone.time, alone.tension_fairlead)
        off = np.sqrt(np.mean((in_waves.tension[:, i] - pull) ** 2))
        assert np.ptp(bent[:, 2]) > 0.1 * np.ptp(place[:, 2]) and pull.std() > 1e-2 * pull.max()
        assert off < 5e-3 * pull.std(), (name, off / pull.std())


def test_energy_of_the_beam_is_what_lines_and_damping_leave(beam):
    """Bent by 0.3 m and let go 0.2 m too high"""
    body, off = beam.reader, (0.0, 0.0, 0.2, 0.0, 0.0, 0.0, 0.3, 0.0)
    still = replace(beam, waves=no_wave_forces(body))
    run = simulate(still, Weather(), replace(HOW, ramp=0.0, dynamic_lines="all", offset=off))
    (A,) = body.coefficients(np.array([2 * np.pi / 8]))[0]
    total = 0.5 * np.einsum("ti,ij,tj->t", run.velocity, body.inertia + A, run.velocity)
    total += 0.5 * np.einsum("ti,ij,tj->t", run.motion, body.stiffness, run.motion)
    assert abs(run.work["lines"]) > 1e-3 * total[0]
    assert abs(total[-1] - total[0] - run.work["lines"] - run.work["damping"]) < 1e-5 * total[0]


def test_slowly_they_bend_the_beam_as_in_their_static_shape(beam):
    """A force ahead and up that grows and goes within two minutes: 3 % of the motion by their drag and elements"""
    t = np.linspace(0.0, 120.0, 61)
    push = np.outer(np.sin(np.pi * t / 120.0) ** 2, [2e6, 0.0, 2e6, 0.0, 0.0, 0.0])
    slow, runs = Weather(forces=(GivenForce(t, push, smooth=True),)), []
    for names in ("none", "all"):
        how = replace(HOW, dynamic_lines=names, dynamic_elements=40, duration=120.0, ramp=0.0, step=0.5, tolerance=1e-4)
        runs.append(simulate(beam, slow, how))
    for one in ("motion", "tension"):
        still, moving = (getattr(run, one) for run in runs)
        moves = np.ptp(still, axis=0)
        seen = moves > 0.1 * moves[[0, 2]].min() if one == "motion" else moves > 0
        seen[6:] = True
        assert np.all(np.abs(moving - still).max(axis=0)[seen] < 0.03 * moves[seen]), one
    assert np.ptp(runs[0].motion[:, 6]) > 1e-3
