"""A rectangle by potential theory, fixed, free and on taut lines, held to laws and to the tests of 1975."""

import csv
from pathlib import Path

import numpy as np
import pytest

from hakobune.bem.sections.any_section import any_section
from hakobune.bem.sections.coefficients import section
from hakobune.bem.sections.outline import circle
from hakobune.mooring.breakwater.body import TautBody
from hakobune.mooring.breakwater.elastic import elastic_exact
from hakobune.mooring.breakwater.exact import fixed_exact, free_exact, taut_exact
from hakobune.mooring.breakwater.holdings import exact_response, mean_drift
from hakobune.mooring.breakwater.long_waves import line_tensions, long_wave
from hakobune.mooring.breakwater.loss import Keel, with_loss
from hakobune.mooring.breakwater.taut import TautRectangle

# Kihara, Kitatani & Todoroki (1975), section 4.3, in SI; the attachment is taken at the corner, the lines reach the bed
BODY = {
    "half": 0.3, "draft": 0.3, "free_draft": 0.202, "depth": 0.6, "z0": -0.095, "inertia": 0.86 * 9.8,
    "attachment": 0.3, "density": 1000.0, "gravity": 9.8,
}  # fmt: skip
PERIODS = (1.6, 1.72, 1.8, 2.0, 2.2, 2.4, 2.6, 2.7, 2.8, 3.0, 3.2)
PUBLISHED = Path(__file__).parents[2] / "published"


def body_at(degrees):
    angle = np.radians(degrees)
    return TautRectangle(angle=angle, line=0.3 / np.sin(angle), **BODY)


def section_at(period, draft=0.3, tolerance=1e-6):
    return section(0.6, draft, 0.6, 2 * np.pi / period, density=1000.0, gravity=9.8, tolerance=tolerance)


def energy(motion):
    return abs(motion.transmission) ** 2 + abs(motion.reflection) ** 2


@pytest.mark.filterwarnings("ignore:.*unstable")
@pytest.mark.parametrize("period", [1.6, 3.2])
def test_energy_is_kept_however_the_body_is_held(period):
    water, free = section_at(period, tolerance=1e-8), section_at(period, 0.202)
    assert abs(water.transmission) ** 2 + abs(water.reflection) ** 2 == pytest.approx(1, abs=1e-8)
    assert energy(free_exact(body_at(44).afloat, free)) == pytest.approx(1, abs=1e-8)
    impedance = water.added_mass + 1j * water.damping / water.omega
    assert abs(impedance[0, 2] - impedance[2, 0]) < 1e-8 * np.sqrt(abs(impedance[0, 0] * impedance[2, 2]))
    for degrees in (44, 90, 158):
        assert energy(taut_exact(body_at(degrees), water)) == pytest.approx(1, abs=1e-8)


def test_mean_drift_of_the_far_field_is_that_of_the_section():
    waters = [section_at(period) for period in PERIODS]
    made = exact_response("fixed", waters, None)
    drift = mean_drift(made, 2 * np.pi / np.array(PERIODS), 0.6, density=1000.0, gravity=9.8)
    assert drift == pytest.approx([water.drift for water in waters], rel=1e-6)


def published(name):
    with open(PUBLISHED / name, encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if line[0] != "#")
        return [{key: float(value) for key, value in row.items()} for row in rows]


@pytest.mark.filterwarnings("ignore:.*unstable")
@pytest.mark.parametrize("degrees", [44, 158])
def test_transmission_of_the_moored_rectangle_is_that_measured(degrees):
    rows = [row for row in published("breakwater_rectangle.csv") if row["angle_deg"] == degrees]
    misses = []
    for period in PERIODS:
        measured = np.mean([row["transmission"] for row in rows if row["period_s"] == period])
        misses.append(abs(taut_exact(body_at(degrees), section_at(period)).transmission) - measured)
    assert np.sqrt(np.mean(np.square(misses))) < 0.05


def test_flow_under_a_slender_body_becomes_uniform_at_first_order():
    """y_B = |K_T / K_R| of long waves, kl = 0.01: what the ends of the gap add is a length of the order of the depth"""
    misses = []
    for half in (2.0, 4.0, 8.0, 16.0):
        omega = 0.01 / half * np.sqrt(9.8)
        water = section(2 * half, 0.9, 1.0, omega, density=1000.0, gravity=9.8)
        exact = abs(water.transmission / water.reflection)
        misses.append(long_wave(half, 0.9, 1.0, omega, 9.8).y_B / exact - 1)
    orders = np.log2(np.divide(misses[:-1], misses[1:]))
    assert np.all(abs(orders - 1) < 0.1), orders


def test_a_section_of_another_draft_is_refused():
    with pytest.raises(ValueError, match="give the section of this body"):
        taut_exact(body_at(44), section_at(2.0, 0.202))


@pytest.mark.parametrize("degrees", [44, 90, 120])
def test_stiffer_lines_come_to_the_constraint_at_first_order(degrees):
    body, water = body_at(degrees), section_at(2.0)
    taut, misses = taut_exact(body, water), []
    for stiffness in (1e8, 2e8, 4e8):
        elastic = elastic_exact(body, water, stiffness)
        assert energy(elastic) == pytest.approx(1, abs=1e-8)
        misses.append([abs(getattr(elastic, name) - getattr(taut, name)) for name in ("transmission", "front", "back")])
    orders = np.log2(np.divide(misses[:-1], misses[1:]))
    assert np.all(abs(orders - 1) < 0.02), orders


def test_lines_that_do_not_carry_the_body_upright_are_refused():
    high = TautRectangle(angle=np.radians(44), line=0.43, **(BODY | {"z0": 0.3, "free_draft": 0.299}))
    with pytest.raises(ValueError, match="upright body is unstable"):
        elastic_exact(high, section_at(2.0), 10.0)


def test_a_circle_on_lines_towards_its_centre_is_held_as_if_it_were_fixed():
    """Waves have no moment about the centre, where the lines meet; the reason for the circle, section 1 of the paper"""
    wet, arm = circle(10.0).wetted(5.0), np.sqrt(12.5)
    body = TautBody(
        mass=2e4, z0=0.0, inertia=2.5e5, area=wet.area, buoyancy_z=wet.center.imag, waterline=10.0, draft=5.0,
        depth=10.0, angle=np.pi / 4, attachment=arm, attachment_z=-arm, line=9.0,
    )  # fmt: skip
    water = any_section(wet, 10.0, 0.9)
    fixed, taut = fixed_exact(water), taut_exact(body, water)
    assert abs(taut.roll) * 5 < 1e-6 and abs(taut.transmission - fixed.transmission) < 1e-6
    held = line_tensions(fixed.horizontal, fixed.vertical, np.pi / 4)
    assert [taut.front, taut.back] == pytest.approx(held, rel=1e-5)


def test_the_energy_that_waves_lose_is_the_head_lost_times_the_discharge():
    C, a, s, keel = 3.0, 0.05, 0.3, Keel(0.3, 0.3, 0.6, 9.8)
    omega = 2 * np.pi / np.array(PERIODS)
    waters = [section_at(T) for T in PERIODS]
    for holding in ("fixed", "taut"):
        free = exact_response(holding, waters, body_at(44))
        lossy = with_loss(free, C, a, omega, keel)
        k = np.array([water.k for water in waters])
        n = 0.5 * (1 + 1.2 * k / np.sinh(1.2 * k))
        f_B = np.sinh(k * s) / (k * s * np.cosh(0.6 * k))
        Q = omega * n / (k * f_B) * a / 2 * (1 - (lossy.reflection - lossy.transmission) * np.exp(0.6j * k))
        lost = 1 - abs(lossy.transmission) ** 2 - abs(lossy.reflection) ** 2
        work = 8 / (3 * np.pi) * C * abs(Q) ** 3 / (2 * 9.8 * s**2)
        assert np.all(lost > 0) and work == pytest.approx(lost * a**2 * n * omega / k, rel=1e-6)
    assert with_loss(free, 0.0, a, omega, keel).transmission == pytest.approx(free.transmission, abs=1e-12)
