"""A buoy on a hawser of a body in waves, against nine linear equations in the frequency domain."""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.bem.waves import wavenumber
from hakobune.mooring.lines.ropes import RopePart
from hakobune.mooring.lines.system.bodies import rotation
from hakobune.mooring.lines.system.equilibrium import rest
from hakobune.mooring.lines.system.graph import Pose
from hakobune.mooring.lines.system.moored_body import leg_at_tension, moored_body
from hakobune.mooring.lines.system.parts import LineType, MooredBody, UniformLine
from hakobune.mooring.motion.buoy import FULL, BuoyBody, BuoyOnLines
from hakobune.mooring.motion.given_forces import GivenForce
from hakobune.mooring.motion.simulation import simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Waves

PULL, LENGTH, END = 1.5e5, 30.0, np.array([50.0, 0.0, 4.0])
BUOY, ROPE = BuoyBody(120e3, 8.0, 6.0, drag=(0.0, 0.0)), RopePart(2e7, 1.0)


@pytest.fixture(scope="module")
def held(on_springs):
    """The box on springs with a buoy ahead that its hawser pulls with PULL, and the place of the buoy"""
    reader, kind = on_springs.reader, LineType("chain", 2000.0, 5e8)
    legs = [leg_at_tension(UniformLine(f"line {i}", kind, 200.0, "", ""), (0.0, 0.0, -2.0), np.radians(a), 20.0, 1e5)
            for i, a in enumerate((60, 180, 300))]  # fmt: skip
    made = moored_body(legs, 20.0, (0.0, 0.0, -2.0), reader.density, name="buoy")
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = reader.density * reader.gravity * 0.25 * np.pi * BUOY.diameter**2
    one = MooredBody("buoy", (0.0, 0.0, -2.0, 0, 0, 0), ("Surge", "Sway", "Heave"), stiffness, (-PULL, 0, 0, 0, 0, 0))
    system = replace(made, bodies=(one,))
    place = rest(system).position[0, :3] - [0.0, 0.0, -2.0]
    center = np.asarray(reader.rotation_center)
    bow = np.array([place[0] - LENGTH * (1 + PULL / ROPE.breaking_load), place[1]])
    origin = np.array([*(bow - END[:2]), center[2]])
    level = origin[2] + END[2] - (-2.0 + place[2])
    hung = BuoyOnLines(BUOY, system, ROPE, [LENGTH], END[None], origin, place, level, np.zeros(2))
    return replace(on_springs, buoy=hung, damping=np.diag([2e6, 2e6, 0, 0, 0, 1e9])), place


def of_turned_arm(force, arm, h=1e-3):
    """(3, 3) derivative of the moments of a force that stays, by roll, pitch and yaw that turn its arm: of f · R p"""
    steps = h * np.eye(3)

    def power(angles):
        return force @ rotation(*angles) @ arm

    return np.array([[power(a + b) - power(a - b) - power(b - a) + power(-a - b) for b in steps] for a in steps]) / (
        4 * h * h
    )


def nine(held, place, omega, direction):
    """(9,) motion of body and buoy per metre of waves, phases of waves as the run has them"""
    reader, memory = held.reader, held.memory
    mass = BUOY.mass * (1 + np.array(BUOY.added)[[0, 0, 1]])
    Z = np.zeros((9, 9), complex)
    H = memory.transform(np.array([omega]))[0] + held.damping
    Z[:6, :6] = -(omega**2) * (reader.inertia + memory.added_mass_infinity) - 1j * omega * H
    Z[:6, :6] += reader.stiffness + held.spring
    system = held.buoy.system
    lines = system.load(Pose(np.array([place + [0, 0, -2.0]]), system.pose.turn, np.zeros((0, 3)))).stiffness[:3, :3]
    Z[6:, 6:] = np.diag(-(omega**2) * mass) + lines
    Z[8, 8] += system.bodies[0].hydrostatic_stiffness[2, 2]
    axial, across = ROPE.breaking_load / LENGTH, PULL / (LENGTH * (1 + PULL / ROPE.breaking_load))
    K = np.diag([axial, across, across]) - 1j * omega * np.diag(
        [held.buoy.damping[0] * PULL / (FULL * ROPE.breaking_load), 0, 0]
    )
    x, y, z = END
    arm = np.array([[1, 0, 0, 0, z, -y], [0, 1, 0, -z, 0, x], [0, 0, 1, y, -x, 0]], float)  # motion of the end
    apart = np.hstack([-arm, np.eye(3)])
    Z += apart.T @ K @ apart
    Z[3:6, 3:6] -= of_turned_arm(np.array([PULL, 0.0, 0.0]), END)
    k = float(wavenumber(np.array([omega]), reader.depth, reader.gravity)[0])
    shift = held.buoy.origin - reader.rotation_center  # of the space of the buoy from that of the waves
    at = place[:2] - shift[:2]
    here = np.exp(1j * k * (np.cos(direction) * at[0] + np.sin(direction) * at[1]))
    draft = BUOY.draft(reader.density)
    zc = -0.5 * draft
    flow = omega * np.cosh(k * (zc + reader.depth)) / np.sinh(k * reader.depth)
    rise = -1j * omega * np.sinh(k * (zc + reader.depth)) / np.sinh(k * reader.depth)
    a = -1j * omega * np.array([np.cos(direction) * flow, np.sin(direction) * flow, rise]) * here
    wave = BUOY.mass * np.array([2.0, 2.0, 1.0]) * a
    wave[2] += system.bodies[0].hydrostatic_stiffness[2, 2] * here
    return np.linalg.solve(Z, np.concatenate([reader.forces([omega], [direction])[0, 0], wave]))


@pytest.mark.parametrize(("omega", "degrees"), [(0.45, 160), (1.0, 220)])
def test_in_low_waves_body_and_buoy_move_as_nine_linear_equations(held, omega, degrees):
    body, place = held
    direction, height = np.radians(degrees), 0.002
    against = np.array([-PULL, 0.0, 0.0, 0.0, -END[2] * PULL, 0.0])  # holds the body against its hawser
    force = GivenForce(np.array([0.0, 1e4]), np.tile(against, (2, 1)))
    weather = Weather(regular=Waves(height, 2 * np.pi / omega, direction), forces=(force,))
    settings = Settings(700.0, 0.0, 0.2, 1e-5, slow_drift="none", wave_ramp=(0.0, 400.0))
    run = simulate(body, weather, settings)
    late = run.time > 500.0
    t = run.time[late]
    basis = np.stack([np.cos(omega * t), np.sin(omega * t), np.ones_like(t), t], axis=1)
    own = np.column_stack([run.motion, run.buoy[:, :3]])[late]
    cos, sin = np.linalg.lstsq(basis, own, rcond=None)[0][:2]
    found, wanted = (cos + 1j * sin) / (0.5 * height), nine(body, place, omega, direction)
    kind = np.repeat([np.abs(wanted[:3]).max(), np.abs(wanted[3:6]).max(), np.abs(wanted[6:]).max()], 3)
    assert np.all(np.abs(found - wanted) <= 1e-3 * kind), np.abs(found - wanted) / kind
