"""Two bodies that do not see each other are each as alone; a gangway between them moves as its ends do."""

import numpy as np
import pytest
from made_up_body import HEADINGS, OMEGA, exact_motion, made_up_body
from two_bodies import ASTERN, BODIES, DEPTH, G, two_bodies

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.database.natural_periods import natural_periods
from hakobune.bem.database.resonances import resonances
from hakobune.bem.drift import sum_about_origin
from hakobune.bem.viscous import Quadratic
from hakobune.bem.waves import wavenumber
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.on_current.body import on_current
from hakobune.mooring.on_current.waves import Carrier
from hakobune.mooring.response.points import KeelPoint, Pair, Point, transfer_functions
from hakobune.mooring.response.sea_state import sea_state
from hakobune.mooring.response.viscous import in_sea

BETWEEN = OMEGA[:-1] + 0.4 * np.diff(OMEGA)
SHIP, BARGE, PIER = Point("s", (5.0, -8.0, 4.0), None, "ship"), Point("b", (3.0, -7.0, 2.0), None, "barge"), Point(
    "p", (0.0, 0.0, 0.0), None, "pier"
)  # fmt: skip


@pytest.fixture(scope="module")
def bodies():
    return two_bodies()


@pytest.fixture(scope="module")
def phases():
    """(q, m) of ship and barge between stored frequencies"""
    k = wavenumber(BETWEEN, DEPTH, G)[:, None]
    return [np.exp(1j * k * (x * np.cos(HEADINGS) + y * np.sin(HEADINGS))) for x, y in ((0, 30), (10, -30))]


def test_each_moves_as_alone_with_the_phase_of_its_place(bodies, phases):
    X = bodies.motions(BETWEEN)
    alone = np.array([[exact_motion(w, beta) for beta in HEADINGS] for w in BETWEEN])
    size = np.abs(alone).max(axis=(0, 1))
    assert np.all(np.abs(X[..., :6] - phases[0][..., None] * alone).max(axis=(0, 1)) < 2e-3 * size)
    assert np.all(np.abs(X[..., 6:] - phases[1][..., None] * alone @ ASTERN).max(axis=(0, 1)) < 2e-3 * size)


def test_names_and_peaks_are_those_of_each(bodies):
    assert bodies.words[:2] == ("ship surge", "ship sway") and bodies.words[-1] == "barge yaw"
    assert bodies.names[6] == "barge__Surge"
    found = natural_periods(bodies)
    assert np.allclose(found.period[:6], found.period[6:], equal_nan=True) and found.names == bodies.names
    peaks = {one.name for one in resonances(bodies)}
    assert {"ship heave", "barge heave", "ship roll", "barge roll"} <= peaks


def test_a_gangway_moves_as_its_ends_do(bodies):
    """By hand: the end on the barge about its rotation centre, 2 m astern of its origin at z = 1, turned by 180°"""
    omega = OMEGA[[4, 9]]
    found = transfer_functions(bodies, omega, HEADINGS, [SHIP, BARGE, Pair("gangway", (SHIP, BARGE))])
    X = found.value[..., :12]
    ship = X[..., :3] + np.cross(X[..., 3:6], [5.0, -8.0, 3.0])
    barge = X[..., 6:9] + np.cross(X[..., 9:12], [5.0, -7.0, 1.0])
    column = found.names.index("gangway relative displacement x")
    apart = found.value[..., column : column + 3]
    assert np.abs(apart - (barge * [-1, -1, 1] - ship)).max() < 1e-12
    speed = found.value[..., column + 3 : column + 6]
    assert np.abs(speed + 1j * omega[:, None, None] * apart).max() < 1e-12
    assert "s relative elevation" not in found.names and BODIES[2].own_center == pytest.approx([-2.0, 0.0, 1.0])


def test_from_a_fixed_body_a_point_moves_as_itself(bodies):
    found = transfer_functions(
        bodies, OMEGA[[4]], HEADINGS, [Pair("hose", (PIER, BARGE)), KeelPoint("k", (0, 0, -5), 3, "barge")]
    )
    barge = found.value[..., 6:9] + np.cross(found.value[..., 9:12], [5.0, -7.0, 1.0])
    assert np.abs(found.value[..., 12:15] - barge * [-1, -1, 1]).max() < 1e-12
    assert np.abs(found.value[..., -1] - (found.value[..., 8] - 2 * found.value[..., 10])).max() < 1e-12
    with pytest.raises(BetweenError, match="no body 'tug'; allowed: ship, pier, barge"):
        bodies.body_named("tug")


def test_drift_of_each_is_the_stored_one_and_adds_up():
    """D of each grows with ω alone: in a sea F = 2 ∫ D S dω; their sum about the origin is that of the whole"""
    stored = np.einsum("w,b,m,d->wmbd", OMEGA**2, [1e3, -2e3, 5e2], np.ones(4), [1.0, 0.5, 3.0])
    whole = sum_about_origin(stored, BODIES)
    bodies = two_bodies(body_drift_force=stored, drift_force=whole)
    sea = Sea(issc(2.0, mean_period=9.0), 0.0)
    found = sea_state(bodies, sea, 3600.0).slow
    w = np.linspace(OMEGA[0], OMEGA[-1], 4001)
    inside = 2 * np.trapezoid(w**2 * sea.spectrum.density(w), w)
    ends = 2 * (
        OMEGA[0] ** 2 * sea.spectrum.moment(0, 0, OMEGA[0]) + OMEGA[-1] ** 2 * sea.spectrum.moment(0, OMEGA[-1], np.inf)
    )
    assert found.of_each == pytest.approx(np.outer([1e3, -2e3, 5e2], [1, 0.5, 3]) * (inside + ends), rel=2e-3)
    assert sum_about_origin(found.of_each, BODIES)[:2] == pytest.approx(found.drift[:2], rel=1e-3)
    assert found.drift[0] == pytest.approx((1e3 - 2e3 - 5e2) * (inside + ends), rel=2e-3)
    held = sea_state(bodies.restrained(damping=1e5 * np.eye(12)).without_drift(), sea, 3600.0)
    assert held.slow is None


def test_viscous_damping_of_one_of_two_is_that_of_it_alone():
    """Two that do not see each other: what a sea makes of a law is the same, and the other has none"""
    law, sea = Quadratic(5e11), Sea(issc(3.0, mean_period=9.0), np.pi / 3)
    _, damping = in_sea(two_bodies(), sea, {"barge__Roll": law})
    turned = Sea(issc(3.0, mean_period=9.0), np.pi / 3)
    _, alone = in_sea(made_up_body(symmetry=""), turned, {"Roll": law})
    assert damping[9, 9] == pytest.approx(alone[3, 3], rel=2e-3) and np.count_nonzero(damping) == 1


def test_on_a_current_that_hardly_runs_all_move_as_in_still_water(bodies):
    still = bodies.motions(BETWEEN, HEADINGS[1:3])
    moved = on_current(bodies, Carrier(np.array([1e-9, 0.0]), absolute=False)).motions(BETWEEN, HEADINGS[1:3])
    assert np.abs(moved - still).max() < 1e-4 * np.abs(still).max() and moved.shape[-1] == 12
