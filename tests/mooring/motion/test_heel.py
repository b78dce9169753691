"""Wind and current heel a body on springs, in `multi_point` and as the mean of a run, held to forces summed by hand.

Springs, hydrostatics and coefficients are written out here: nothing of what is judged is used to judge it.
"""

from dataclasses import replace

import numpy as np
import pytest

from hakobune.mooring.lines.system.hawser import Hawser, pull_of_points
from hakobune.mooring.lines.system.moored_body import Leg, moored_body
from hakobune.mooring.loads.coefficients import hull_coefficients
from hakobune.mooring.motion.simulation import moored, simulate
from hakobune.mooring.motion.weather import Settings, Weather
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Wind
from hakobune.mooring.studies.multi_point import multi_point

AIR, WATER = 1.226, 1025.0
HULL = ExposedBox(100.0, 50.0, 10.0, 10.0)
K, SLACK = 4e6, 59.0  # N/m and m of each spring, which is 60 m long at rest
ENDS = np.array([[sx * 50.0, sy * 25.0, -4.0] for sx in (1, -1) for sy in (1, -1)])
FAR = ENDS + 60.0 * np.array([[sx * 0.8, sy * 0.6, 0.0] for sx in (1, -1) for sy in (1, -1)])
DEGREES = np.linspace(0.0, 360.0, 41)  # coefficients of no symmetry at all
ROUND = np.radians(DEGREES[:-1])
CX, CY, CN = (np.append(values, values[0]) for values in (
    0.9 * np.cos(ROUND) + 0.1 * np.sin(3 * ROUND) + 0.05, 0.8 * np.sin(ROUND) + 0.1 * np.cos(2 * ROUND),
    0.12 * np.sin(2 * ROUND) + 0.02 * np.cos(ROUND)))  # fmt: skip
AREAS = {"area_x": 700.0, "area_y": 1900.0, "length": 100.0}


def box_at_60():
    """F, M about still water amidships of 40 m/s from 60° off the bow, by the printed table 3.6.1.1; freeboard 10 m"""
    q = 0.5 * AIR * 40.0**2
    x, y = -0.54 * q * 50 * 10, -0.81 * q * 100 * 10  # blown to 240°
    return x, y, 5.0, -0.076 * 100.0 * np.hypot(x, y)


def ship_at_135():
    """The same of 40 m/s to 135° on a ship with 40 coefficients, acting 13 m above the water"""
    i = int(np.flatnonzero(DEGREES == 135.0)[0])
    q = 0.5 * AIR * 40.0**2
    return q * CX[i] * 700.0, q * CY[i] * 1900.0, 13.0, q * CN[i] * 1900.0 * 100.0


SHIP = hull_coefficients(np.radians(DEGREES), CX, CY, CN, **AREAS, height=13.0)
CASES = {
    "box": (Conditions(Wind(40.0, np.radians(240.0))), box_at_60),
    "ship": (Conditions(Wind(40.0, np.radians(135.0), table=SHIP)), ship_at_135),
}


@pytest.fixture(scope="module")
def springs(database):
    kind = pull_of_points("spring", [0.0, 10.0], [0.0, 10 * K])
    legs = [Leg(Hawser(f"spring {i}", kind, SLACK, "", ""), tuple(far), tuple(end))
            for i, (far, end) in enumerate(zip(FAR, ENDS, strict=True))]  # fmt: skip
    return moored_body(legs, database.water_depth, database.rotation_center, database.density, database.gravity)


def turned(roll, pitch, yaw):
    (a, b, c), (d, e, f) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return (np.array([[c, -f, 0], [f, c, 0], [0, 0, 1]]) @ np.array([[b, 0, e], [0, 1, 0], [-e, 0, b]])
            @ np.array([[1, 0, 0], [0, a, -d], [0, d, a]]))  # fmt: skip


def left_over(place, database, load):
    """(6,) N, N m of springs, buoyancy and load about the centre of a body displaced by `place` from rest, by hand"""
    center = np.asarray(database.rotation_center, float)
    force = np.zeros(6)
    for end, far in zip(ENDS, FAR, strict=True):
        arm = turned(*place[3:]) @ (end - center)
        away = far - (center + place[:3] + arm)
        pull = K * (np.linalg.norm(away) - SLACK) * away / np.linalg.norm(away)
        force += [*pull, *np.cross(arm, pull)]
    x, y, height, turn = load
    lever = height - center[2]
    force += [x, y, 0.0, -lever * y, lever * x, turn - center[0] * y + center[1] * x]
    water = np.asarray(database.hydrostatic_stiffness) @ np.array([0, 0, *place[2:5], 0])
    ahead = turned(0.0, 0.0, place[5])  # roll and pitch are about axes that turn with the heading
    return force - [*(ahead @ water[:3]), *(ahead @ water[3:])]


@pytest.mark.parametrize("case", CASES)
def test_offset_and_heel_balance_the_wind(case, database, springs):
    conditions, by_hand = CASES[case]
    result = multi_point(database, springs, HULL, conditions)
    place = (result.equilibrium.position - result.rest.position)[0]
    force, load = left_over(place, database, by_hand()), left_over(np.zeros(6), database, by_hand())
    assert np.all(np.abs(force) <= 1e-3 * np.abs(load) + 1e-5 * np.abs(load).max())
    assert np.all(np.abs(result.heel) > 1e-5)
    assert result.heel[0] * load[1] < 0 < result.heel[1] * load[0]  # leeward side down


@pytest.mark.parametrize("case", CASES)
def test_the_mean_of_a_run_has_the_offset_and_the_heel_of_the_balance(case, database, springs, on_springs):
    """Held at its heading, since in time the wind is that of the heading the body turns to"""
    conditions, by_hand = CASES[case]
    held, damping = np.diag([0, 0, 0, 0, 0, 1e14]), np.diag([2e7, 2e7, 3e7, 3e9, 1e10, 2e10])
    body = moored(database, springs, HULL, memory=on_springs.memory, damping=damping, spring=held)
    settings = Settings(duration=100.0, ramp=400.0, step=1.0, slow_drift="none", tolerance=1e-5)
    mean = simulate(body, Weather(wind=conditions.wind), settings).motion[-50:].mean(axis=0)
    force, load = (left_over(place, database, by_hand())[:5] for place in (mean, np.zeros(6)))
    assert np.all(np.abs(force) <= 1e-3 * np.abs(load) + 1e-5 * np.abs(load).max())


def test_a_current_acts_at_half_draft_and_heels_the_other_way(database, springs):
    """Abeam on a box: C_y = 1.57 at B/d = 5, H/d = 2 is between; only the lever is asked for here"""
    flow = multi_point(database, springs, HULL, Conditions(current=Current(1.0, np.pi / 2))).loads["current"]
    up = float(database.rotation_center[2])
    assert flow[1] > 0 and flow[3] == pytest.approx((up + 5.0) * flow[1], rel=1e-12)
    at_keel = replace(Current(1.0, np.pi / 2), height=-10.0)
    flow = multi_point(database, springs, HULL, Conditions(current=at_keel)).loads["current"]
    assert flow[3] == pytest.approx((up + 10.0) * flow[1], rel=1e-12)
