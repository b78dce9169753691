"""Fenders and ropes of a body in time: elastic contact, energy, friction, equilibrium, ropes in series."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from hakobune.bem.time_domain.fast_states import slow_memory
from hakobune.bem.time_domain.memory import MemoryArrays
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.fenders.families import fender_of_family
from hakobune.mooring.fenders.fender import FenderError, fender_of_points
from hakobune.mooring.lines.ropes import RopePart, rope
from hakobune.mooring.lines.system.parts import LineSystemError
from hakobune.mooring.motion.contact_loads import FORCE, contact_loads, contact_work, settle
from hakobune.mooring.motion.contacts import QuayFender, berth_force, berth_of, courses
from hakobune.mooring.motion.simulation import SimulationError, moored, simulate
from hakobune.mooring.motion.simulation.body import FASTEST
from hakobune.mooring.motion.weather import Settings, Weather

Y = np.array([0.0, 1.0, 0.0])
CELL = fender_of_family("cell", 1.7)
MAIN, TAIL = RopePart(1.2e6, 0.10), RopePart(1.5e6, 0.30, 1.5)
ENDS = [((70, 40, 4), (48, 20, 8)), ((0, 30, 4), (20, 25, 8)), ((0, 30, 4), (-20, 25, 8)), ((-70, 40, 4), (-48, 20, 8))]


def at_quay(database, memory, friction=0.2):
    fenders = [
        QuayFender(f"F{i}", CELL, np.array([x, 25.0, 3.0]), Y, 25.0, friction, 2e6) for i, x in enumerate((-30, 30))
    ]
    ropes = [
        rope(f"R{i}", bollard, lead, MAIN, 1.5e5, tail=TAIL, tail_length=8.0) for i, (bollard, lead) in enumerate(ENDS)
    ]
    berth = berth_of(fenders, ropes, database.rotation_center)
    return moored(database, memory=memory, berth=berth, damping=np.diag([1e6, 1e6, 0, 2e8, 0, 1e8]))


@pytest.fixture(scope="module")
def ship(database, on_springs):
    return at_quay(database, on_springs.memory)


def test_elastic_contact_gives_back_what_it_took_to_a_thousandth(on_springs):
    """Two fenders of 1e8 N/m, met with 0.15 m/s by a body without memory: √(m/k) sets force and time"""
    k, speed, gap = 1e8, 0.15, 0.3
    spring, none = fender_of_points("spring", 1.0, [0.0, 1.0], [0.0, k]), np.zeros((6, 0))
    memory = replace(
        on_springs.memory, arrays=MemoryArrays(np.zeros(0), np.zeros(0), none, none),
        added_mass_infinity=np.diag([1e6, 3e7, 3e7, 1e9, 1e9, 1e9]),
    )  # fmt: skip
    omega = np.sqrt(k / (on_springs.reader.inertia[1, 1] + 3e7))
    faces = [("near", 25.0, Y), ("far", -25.0 - gap, -Y)]
    berth = berth_of([QuayFender(n, spring, np.array([0.0, y, 0.0]), m, 25.0) for n, y, m in faces], (), np.zeros(3))
    start = np.array([0.0, speed / omega, 0, 0, 0, 0])
    body = replace(on_springs, memory=memory, berth=berth, start=start, spring=np.zeros((6, 6)))
    calm = Settings(duration=(np.pi + 0.5 * np.pi) / omega + gap / speed, ramp=0.0, slow_drift="none", step=0.01)
    run = simulate(body, Weather(), calm)
    assert run.reaction[:, 1].max() == pytest.approx(speed * k / omega, rel=1e-3)
    met = run.time[np.argmax(run.reaction[:, 1] > 0)]
    assert met == pytest.approx(0.5 * np.pi / omega + gap / speed, abs=0.012)
    assert run.velocity[-1, 1] == pytest.approx(speed, rel=1e-3)
    assert run.work["fenders"] == pytest.approx(0.5 * k * (speed / omega) ** 2, rel=1e-3)


def test_work_of_fenders_and_ropes_closes_the_energy_of_a_ship_at_a_quay(ship):
    weather = Weather((Sea(issc(1.5, mean_period=9.0), 1.2),))
    settings = Settings(duration=100.0, ramp=30.0, tolerance=1e-6, components=40, step=0.02)
    run = simulate(ship, weather, settings, seed=3)
    slow = slow_memory(ship.memory, FASTEST)
    M = ship.reader.inertia + ship.memory.added_mass_infinity + slow.inertia
    nu, eta, C = run.velocity[-1], run.motion[-1], ship.reader.stiffness
    stored = 0.5 * nu @ M @ nu + 0.5 * (eta @ C @ eta - ship.start @ C @ ship.start)
    assert abs(sum(run.work.values()) - stored) <= 1e-6 * max(abs(w) for w in run.work.values())
    assert run.work["fenders"] < 0 and run.deflection.max() > 0.1 and run.pull.max() > 1.6e5
    elongation = courses(ship.berth, run.motion)[0][:, 2:]
    energy = sum(one.pull.energy(np.maximum(e, 0.0)) for one, e in zip(ship.berth.ropes, elongation.T, strict=True))
    assert run.work["ropes"] == pytest.approx(energy[0] - energy[-1], rel=1e-6)


def test_body_rests_where_fenders_ropes_and_water_balance(ship):
    force = berth_force(ship.berth, ship.start)
    assert np.abs(force - ship.reader.stiffness @ ship.start).max() < 1e-5 * np.abs(ship.berth.ropes[0].breaking_load)
    run = simulate(ship, Weather(), Settings(duration=50.0, ramp=0.0, slow_drift="none", tolerance=1e-4))
    assert np.abs(run.motion - ship.start).max() < 1e-6
    assert run.pull[0] == pytest.approx(1.5e5, rel=0.05) and np.all(run.reaction[0] > 0)


def test_friction_sticks_slips_and_takes_energy():
    fender = QuayFender("F", CELL, np.array([0.0, 24.7, 0.0]), Y, 25.0, 0.2, 1e6)
    berth = berth_of([fender], (), np.zeros(3))
    work, R, v, f, taken = contact_work(berth.arrays), np.zeros((1, 3, 3)), np.zeros(3), np.zeros(3), 0.0
    for before, after in pairwise(0.5 * np.sin(np.linspace(0, 4 * np.pi, 400))):
        contact_loads(berth.arrays, work, np.array([[after, 0, 0, 0, 0, 0]]), R, v, f)
        settle(work)
        along, normal = work.parts[0, 0, 0], work.now[0, FORCE]
        assert abs(along) <= 0.2 * normal * (1 + 1e-12) and normal == pytest.approx(float(CELL.reaction(0.3)))
        taken -= along * (after - before)
    assert taken > 0.2 * normal


def test_force_of_fenders_and_ropes_is_the_slope_of_their_energy(ship):
    frictionless = berth_of([replace(one, friction=0.0) for one in ship.berth.fenders], ship.berth.ropes, np.zeros(3))

    def energy(place):
        depth = np.maximum(courses(frictionless, place[None])[0][0], 0.0)
        curves = [*(one.fender for one in frictionless.fenders), *(one.pull for one in frictionless.ropes)]
        return sum(float(curve.energy(x)) for curve, x in zip(curves, depth, strict=True))

    place = np.array([0.1, 0.2, -0.1, 0.02, -0.01, 0.005])
    h = np.array([1e-4] * 3 + [1e-6] * 3)
    slope = [(energy(place + d) - energy(place - d)) / (2 * d.sum()) for d in np.diag(h)]
    # of x, y, z in space and the angles, which forces in heading axes are at a heading of 0 to its first power
    force = berth_force(frictionless, place)
    cos, sin = np.cos(place[5]), np.sin(place[5])
    force[:2] = cos * force[0] - sin * force[1], sin * force[0] + cos * force[1]
    assert -np.array(slope) == pytest.approx(force, rel=1e-5, abs=1e-5 * np.abs(force).max())


def test_parts_of_a_rope_add_their_elongation_and_use_stiffens_it():
    made = rope("R", (0, 0, 0), (50, 0, 0), MAIN, 2e5, tail=TAIL, tail_length=10.0)
    e = 50.0 - made.length
    assert made.pull.loading(e) == pytest.approx(2e5, rel=1e-3)
    parts = (made.length - 10.0) * MAIN.strain_at(2e5) + 10.0 * TAIL.strain_at(2e5)
    assert e == pytest.approx(float(parts), rel=1e-12)
    straight = [rope("R", (0, 0, 0), (50, 0, 0), MAIN, 0.0, hardening=h) for h in (1.0, 3.0)]
    assert straight[1].pull.loading(0.5) == pytest.approx(3 * straight[0].pull.loading(0.5), rel=1e-9)


def test_what_cannot_be_moored_is_told_in_one_line(ship):
    with pytest.raises(LineSystemError, match="pretension is 1300 kN; allowed: below its breaking load of 1200 kN"):
        rope("R", (0, 0, 0), (50, 0, 0), MAIN, 1.3e6)
    with pytest.raises(FenderError, match=r"shear .* both at least 0, and shear above 0 if friction is"):
        QuayFender("F", CELL, np.zeros(3), Y, 25.0, friction=0.2)
    soft = fender_of_points("soft", 1.0, [0.0, 0.2], [0.0, 1e5])
    weak = berth_of([QuayFender("F", soft, np.array([0.0, 25.05, 0.0]), Y, 25.0)], (), np.zeros(3))
    pushed = replace(ship, berth=weak, start=np.zeros(6))
    with pytest.raises(SimulationError, match=r"fender F is compressed by .* m, beyond its table, which ends at 0.2 m"):
        simulate(pushed, Weather((Sea(issc(4.0, mean_period=10.0), 1.5),)), Settings(100.0, 20.0))
