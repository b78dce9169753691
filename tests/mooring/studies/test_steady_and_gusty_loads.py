"""Steady loads about another centre and spectra of gusty ones, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.gusts import kaimal
from hakobune.mooring.loads.box_drag import drag_table
from hakobune.mooring.motion.streams import current_stream, stream_force, wind_stream
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Wind
from hakobune.mooring.studies.slow_spectrum import gust_spectrum
from hakobune.mooring.studies.steady_loads import steady_loads

HULL = ExposedBox(100.0, 40.0, 10.0, 6.0)
FLAT = drag_table([0.0, np.pi / 2], [1.2, 0.0], [0.0, 0.9])  # without a lever: the force acts amidships
CENTER = np.array([7.0, -3.0, -2.0])  # that motions are about, from the middle of the hull
AIR, WATER = 1.25, 1025.0


def hand(density, speed, towards, area_x, area_y, z):
    """Force of a stream along an axis, q C A, and its moment about CENTER: r × F, r from there to z m amidships"""
    q, (along, across) = 0.5 * density * speed**2, towards
    force = np.array([q * 1.2 * area_x * along, q * 0.9 * area_y * across, 0.0])
    return np.concatenate([force, np.cross([0.0, 0.0, z] - CENTER, force)])


CASES = [(0.0, (1, 0)), (90.0, (0, 1)), (180.0, (-1, 0)), (270.0, (0, -1))]


@pytest.mark.parametrize("degrees, towards", CASES)
def test_wind_and_current_turn_the_body_about_its_centre_of_rotation(degrees, towards):
    """A beam wind on a hull whose centre of rotation is 7 m forward of the middle turns its bow into the wind

    and heels by the height of what it meets: half the freeboard above still water, half the draft below
    """
    beta = np.radians(degrees)
    conditions = Conditions(Wind(20.0, beta, AIR, FLAT), Current(1.5, beta, FLAT))
    body = SimpleNamespace(rotation_center=CENTER, density=WATER)
    found = steady_loads(body, HULL, conditions, 30.0)
    wind = hand(AIR, 20.0, towards, 40 * 6.0, 100 * 6.0, 3.0)
    current = hand(WATER, 1.5, towards, 40 * 10.0, 100 * 10.0, -5.0)
    assert found["wind"] == pytest.approx(wind, rel=1e-9, abs=1e-6 * np.abs(wind).max())
    assert found["current"] == pytest.approx(current, rel=1e-9, abs=1e-6 * np.abs(current).max())
    # the same forces in time, of a body at rest
    for stream, force in ((wind_stream(conditions.wind, HULL, CENTER), wind),
                          (current_stream(conditions.current, HULL, CENTER, WATER, 30.0), current)):  # fmt: skip
        out = np.zeros(6)
        stream_force(stream, 0, 0.0, 1.0, np.zeros(3), np.zeros(6), out, np.zeros(1))
        assert out == pytest.approx(force, rel=1e-6, abs=1e-6 * np.abs(force).max())


def test_a_gust_moves_the_force_by_twice_its_share_of_the_speed():
    """F ∝ U²: dF = 2 (F/U) u, so that σ_F = 2 F I with I = σ_u/U (Davenport 1961), and forces and moment go together"""
    speed, intensity, force = 25.0, 0.15, np.array([3e5, -1e5, 4e6])
    wind = kaimal(speed, 10.0, intensity)
    omega = np.concatenate([np.linspace(0.0, 0.2, 40001), np.geomspace(0.2, 400.0, 20000)[1:]])
    spectra = gust_spectrum(wind, force, omega)
    found = np.trapezoid(spectra, omega, axis=0)
    assert found == pytest.approx(np.outer(force, force) * (2 * intensity) ** 2, rel=0.012)  # the band ends at 99 %


def test_a_gust_in_time_adds_to_the_wind_before_it_is_squared():
    stream = wind_stream(Wind(20.0, 0.0, AIR, FLAT), HULL, np.zeros(3))
    gusty = stream._replace(gusts=np.full((1, 40), 2.0))
    out, at_rest = np.zeros(6), np.zeros(6)
    stream_force(stream, 0, 4.0, 1.0, np.zeros(3), np.zeros(6), at_rest, np.zeros(1))
    stream_force(gusty, 0, 4.0, 1.0, np.zeros(3), np.zeros(6), out, np.zeros(1))
    assert out[0] / at_rest[0] == pytest.approx((22 / 20) ** 2, rel=1e-9)
    stream_force(gusty, 0, 4.0, 0.5, np.zeros(3), np.zeros(6), out, np.zeros(1))  # half grown, gusts with it
    assert out[0] / at_rest[0] == pytest.approx((11 / 20) ** 2, rel=1e-9)
    stream_force(stream, 0, 4.0, 1.0, np.array([0.0, 5.0, 0.0]), np.zeros(6), out, np.zeros(1))  # going with the wind
    assert out[0] / at_rest[0] == pytest.approx((15 / 20) ** 2, rel=1e-9)
