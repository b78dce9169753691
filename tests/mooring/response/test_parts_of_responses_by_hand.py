"""Parts of responses by hand: states of a climate, slow forces of pairs, what a database lacks, stations of a beam."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.on_current.waves import Carrier
from hakobune.mooring.response import climate as of_climates
from hakobune.mooring.response import pair_levels, sea_state, slow_drift, viscous
from hakobune.mooring.response import points as of_points
from hakobune.mooring.response.climate import Climate
from hakobune.mooring.response.linear import Moments
from hakobune.mooring.response.points import Transfer

G = 9.81


def a_climate(m0, drift=None):
    """Three sea states of 0.5, 0.3 and 0.2 of the time; heave, sway in m and roll in rad"""
    states = [np.array(part) for part in ([1.0, 2.0, 3.0], [6.0, 7.0, 8.0], [0.0, 0.0, 1.0], [0.5, 0.3, 0.2])]
    return Climate(("heave", "sway", "roll"), ("m", "m", "rad"), *states, np.array(m0), np.array(m0), drift, ())


def test_a_response_is_excited_where_it_is_more_than_rounding_beside_others_of_its_unit():
    """A millionth of the largest standard deviation of its unit, in the worst state; unknown ones count"""
    tiny = of_climates.TINY**2
    found = a_climate([[1.0, 0.5 * tiny, 0.0], [4.0, 3.9 * tiny, 1e-30], [2.0, 0.0, 0.0]])
    assert found.excited.tolist() == [True, False, True]
    assert a_climate([[1.0, 4.1 * tiny, 0.0], [4.0, 0.0, 0.0], [2.0, 0.0, 0.0]]).excited.tolist() == [True, True, False]
    assert a_climate([[1.0, np.nan, 0.0], [4.0, 0.0, 0.0], [2.0, 0.0, 0.0]]).excited.tolist() == [True, True, False]


def test_the_mean_drift_of_a_climate_is_that_of_its_states_by_their_time():
    drift = np.array([[10.0, 0.0, 1.0], [20.0, 1.0, 0.0], [30.0, 0.0, 5.0]])
    one = a_climate(np.ones((3, 3)), drift)
    assert (
        one.mean_drift == pytest.approx([5 + 6 + 6, 0.3, 0.5 + 1.0]) and a_climate(np.ones((3, 3))).mean_drift is None
    )
    assert repr(one) == "<Climate 3 sea states, 3 responses>"
    with pytest.raises(ValueError, match="there is no response named 'yaw'; allowed: heave, sway, roll"):
        one.long_term("yaw")


@pytest.mark.parametrize("knows", [True, False])
def test_transfer_functions_of_a_climate_are_made_once_for_each_heading_and_found_again(monkeypatch, knows):
    """ω + 10 β of a motion and a point, 100 ω + β of drift; headings a turn apart are the same"""
    made, omega = [], np.array([0.5, 0.7, 0.9])

    def transfer_functions(body, omega, headings, points):
        made.append(np.round(headings, 6).tolist())
        value = omega[:, None, None] + 10 * np.asarray(headings)[None, :, None] + np.array([0.0, 1000.0])
        return Transfer(("surge", "rise"), ("m", "m"), omega, np.asarray(headings), value, 0.1 * len(made))

    monkeypatch.setattr(of_climates, "transfer_functions", transfer_functions)
    drift = lambda omega, headings: (  # noqa: E731
        100 * omega[:, None, None] + np.asarray(headings)[None, :, None] + np.zeros(3)
    )
    body = SimpleNamespace(knows_drift=knows, drift=drift, words=["surge"])
    known = of_climates._Known(body, omega, ())
    first, force = known.at(omega[[0, 2]], np.array([0.3, 0.1]))
    assert first.value[:, :, 0] == pytest.approx(np.array([[0.5 + 3, 0.5 + 1], [0.9 + 3, 0.9 + 1]]))
    assert first.omega.tolist() == [0.5, 0.9] and first.heading.tolist() == [0.3, 0.1] and known.knows_drift == knows
    wanted = np.array([[50.3, 50.1], [90.3, 90.1]]) if knows else np.zeros((2, 2))
    assert force == pytest.approx(np.repeat(wanted[:, :, None], 3, axis=2))
    motion = known.motions(omega[1:], np.array([0.1, 0.2, 0.3 + 2 * math.pi]))
    assert motion.shape == (2, 3, 1) and motion[0, :, 0] == pytest.approx([0.7 + 1, 0.7 + 2, 0.7 + 3])
    assert known.drift(omega[:1], np.array([0.2]))[0, 0, 1] == pytest.approx(50.2 if knows else 0.0)
    assert made == [[0.3, 0.1], [0.2]] and known.transfer.missed == pytest.approx(0.2)
    assert known.names == ("surge", "rise") and known.units == ("m", "m")


def test_deviations_of_slow_forces_are_roots_of_their_spectra_up_to_the_last_difference():
    """S = 4 + 2 µ up to 3 rad/s: 21; by level for all six, by Newman's rule for three"""
    difference = np.array([0.0, 1.0, 3.0])
    spectrum = (4 + 2 * difference)[:, None]
    slow = sea_state.SlowForces(np.zeros(3), np.zeros((2, 3)), difference, spectrum * [1.0, 0.0, 4.0], None,
                                of_pairs=spectrum * np.arange(6.0) ** 2)  # fmt: skip
    assert slow.sigma == pytest.approx(math.sqrt(21) * np.array([1.0, 0.0, 2.0]))
    assert slow.sigma_of_pairs == pytest.approx(math.sqrt(21) * np.arange(6.0)) and slow.level == "newman"


def test_a_body_on_a_current_meets_long_crests_at_another_frequency_and_in_still_water_not():
    """σ + σ² V cos β/g of its first heading in deep water"""
    body = SimpleNamespace(carrier=Carrier((0.8, 0.0), False), depth=np.inf, gravity=G)
    met = sea_state._met_of(body, np.array([0.3, 1.0]))
    sigma = np.array([0.6, 0.9])
    assert met(sigma) == pytest.approx(sigma + sigma**2 * 0.8 * math.cos(0.3) / G)
    assert sea_state._met_of(SimpleNamespace(carrier=None), [0.3]) is None


def test_periods_and_significant_values_of_a_sea_state_by_its_moments():
    """T = 2π √(m₀/m₂), √(m₂/m₄); 2 σ of a narrow band; nothing of what does not move"""
    state = object.__new__(sea_state.SeaState)
    moments = Moments(np.array([4.0, 0.0]), np.zeros(2), np.array([1.0, 0.0]), np.array([0.2500001, 0.0]))
    object.__setattr__(state, "moments", moments)
    assert state.sigma.tolist() == [2.0, 0.0]
    assert state.zero_period[0] == pytest.approx(4 * math.pi) and state.peak_period[0] == pytest.approx(4 * math.pi)
    assert np.isnan(state.zero_period[1]) and np.isnan(state.peak_period[1])
    assert state.bandwidth[0] == pytest.approx(0.0, abs=1e-2) and state.bandwidth[1] == 0.0
    assert state.significant[0] == pytest.approx(2 * 2.0, rel=2e-3) and state.significant[1] == 0.0


SEA = Sea(SimpleNamespace(), math.radians(-30.0))


@pytest.mark.parametrize("bodies, spreading, command", [
    ((), None, "'hakobune qtf a.h5 --heading 330 --level full'"), ((), "spread", "'hakobune qtf a.h5 --level full'"),
    (("one", "two"), None, "'hakobune qtf a.h5 --heading 330'"),
])  # fmt: skip
def test_the_command_that_stores_pairs_has_the_heading_of_long_crests_and_the_level_of_one_body(
    bodies, spreading, command
):
    sea = SimpleNamespace(direction=SEA.direction, spreading=spreading)
    assert pair_levels._command(SimpleNamespace(path="a.h5", bodies=bodies), sea) == command


@pytest.mark.parametrize("level, share, begin, end", [
    ("body", 0.06, "left out: the free-surface forcing", "about 6 % of the slow force of wave pairs; 'hakobune qtf"),
    ("body", 0.04, "the free-surface forcing", "about 4 % of the slow force of wave pairs"), ("full", 0.06, None, None),
    ("body", None, None, None),
])  # fmt: skip
def test_the_surface_forcing_is_left_out_with_its_share_and_the_way_out_above_a_twentieth(
    monkeypatch, level, share, begin, end
):
    from hakobune.bem.second_order import stored

    monkeypatch.setattr(stored, "read_forces", lambda db: SimpleNamespace(share=share))
    said = pair_levels._surface_left_out(SimpleNamespace(path="a.h5", bodies=()), SEA, level)
    if begin is None:
        assert said == ()
    else:
        assert len(said) == 1 and said[0].startswith(begin) and end in said[0]
        assert ("adds it" in said[0]) == (share > 0.05)


@pytest.mark.parametrize("level", ["newman", "auto", "body"])
def test_pairs_of_several_bodies_are_those_of_each_that_moves(monkeypatch, level):
    asked = []
    bodies = [SimpleNamespace(fixed=fixed) for fixed in (False, True, False)]
    db = SimpleNamespace(path="a.h5", bodies=bodies)
    monkeypatch.setattr(
        pair_levels, "stored_pairs", lambda db, sea, level, spread, body: asked.append((level, spread, body)) or body
    )
    found, said = pair_levels.beside_newman_of_bodies(db, SEA, level)
    if level == "newman":
        assert (found, said, asked) == (None, (), [])
        return
    assert found == (0, 2) and asked == [("body", True, 0), ("body", True, 2)] and "free-surface forcing" in said[0]

    def missing(*_, **__):
        raise ValueError("no pairs")

    monkeypatch.setattr(pair_levels, "stored_pairs", missing)
    monkeypatch.setattr(pair_levels, "_lacks", lambda db, sea, error: f"lacks: {error}")
    if level == "body":
        with pytest.raises(ValueError, match="no pairs"):
            pair_levels.beside_newman_of_bodies(db, SEA, level)
    else:
        found, said = pair_levels.beside_newman_of_bodies(db, SEA, level)
        assert found is None and "uses newman" in said[0] and said[0].endswith("lacks: no pairs")


@pytest.mark.parametrize("there, sea, says", [
    ("pairs", SEA, "no heading"), (None, SEA, "'hakobune qtf a.h5 --heading 330"), (None, "systems", "no heading"),
])  # fmt: skip
def test_pairs_that_a_database_lacks_are_told_with_the_command_or_with_what_is_wrong(monkeypatch, there, sea, says):
    from hakobune.bem.database import widening

    monkeypatch.setattr(widening, "read_group", lambda db, group: there)
    assert says in pair_levels._lacks(SimpleNamespace(path="a.h5", bodies=()), sea, ValueError("no heading"))


@pytest.mark.parametrize("body", [None, 1])
def test_mean_drift_beside_pairs_is_taken_eight_times_as_close_of_all_or_of_one_body(body):
    reader = SimpleNamespace(
        drift=lambda omega, headings: ("all", omega, headings),
        drift_of_each=lambda omega, headings: (
            omega[:, None, None, None] * np.arange(2.0)[None, None, :, None] * np.ones(3)
        ),
    )
    db = SimpleNamespace(bodies_reader=SimpleNamespace(floating=lambda: reader))
    omega, drift = pair_levels._drift(db, SimpleNamespace(omega=np.array([0.4, 0.7, 1.2])), [0.5], body)
    assert omega == pytest.approx(np.linspace(0.4, 1.2, 24))
    if body is None:
        assert drift == ("all", omega, [0.5])
    else:
        assert drift == pytest.approx(omega[:, None, None] * np.ones((24, 1, 3)))


class Shape(of_points.Beam):
    """A beam whose displacement, moment and shear at x are told"""

    def __new__(cls, kind, values):
        made = super().__new__(cls, kind, *[0.0] * 6)
        made.values = values
        return made

    def along(self, x):
        assert x == 12.0
        return self.values[0]

    def loads(self, x):
        return self.values[1:]


def test_loads_at_a_station_are_sums_over_the_shapes_of_its_body_by_their_kind():
    """Two vertical shapes and one horizontal of the second of two bodies, and one that turns it"""
    told = [("vertical bending", (1.0, 2.0, 3.0)), ("horizontal bending", (5.0, 7.0, 11.0)),
            ("vertical bending", (0.1, 0.2, 0.3)), ("torsion", (13.0, 17.0)),
            ("vertical bending", (99.0, 99.0, 99.0))]  # fmt: skip
    owners = [(1,), (1,), (1,), (1,), (0,)]
    modes = [SimpleNamespace(shape=Shape(*one), turns=one[0] == "torsion", moves=own) for one, own in
             zip(told, owners, strict=True)]  # fmt: skip
    modes.append(SimpleNamespace(shape="no beam", turns=False, moves=(1,)))
    body = SimpleNamespace(bodies=[SimpleNamespace(name="a"), SimpleNamespace(name="b")], modes=modes, rigid=2)
    motion = np.array([[[7.0, 7.0, 1.0, 10.0, 100.0, 2.0, 5.0, 6.0]]])
    shapes = of_points.shapes_of(body, motion, "b")
    assert [(mode is modes[d], float(a[0, 0])) for d, (mode, a) in zip((0, 1, 2, 3, 5), shapes, strict=True)] == [
        (True, 1.0), (True, 10.0), (True, 100.0), (True, 2.0), (True, 6.0),
    ]  # fmt: skip
    found = {word: (unit, float(value[0, 0])) for word, unit, value in
             of_points.of_station(body, motion, SimpleNamespace(body="b", x=12.0))}  # fmt: skip
    assert found == {
        "vertical deflection": ("m", 1.0 + 10.0), "vertical bending moment": ("N m", 2.0 + 20.0),
        "vertical shear force": ("N", 3.0 + 30.0), "horizontal deflection": ("m", 50.0),
        "horizontal bending moment": ("N m", 70.0), "horizontal shear force": ("N", 110.0), "twist": ("rad", 26.0),
        "torsional moment": ("N m", 34.0),
    }  # fmt: skip
    alone = SimpleNamespace(bodies=(), modes=modes, rigid=2)
    assert [float(a[0, 0]) for _, a in of_points.shapes_of(alone, motion)] == [5.0]


def test_the_next_guess_of_a_damping_is_a_secant_in_logarithms():
    """Where the damping found goes as the guess to the power p the share is 1/(1 − p), of p from −3 to ½: ⅔ of drag"""
    step = np.array([2.0, 2.0, 2.0, 2.0, 1.0, 0.0, 4.0])
    answer = np.array([2**-0.5, 2**-1.0, 2**-5.0, 2**0.9, 3.0, 3.0, 0.0])
    assert viscous._share(step, answer) == pytest.approx([2 / 3, 1 / 2, 1 / 4, 2.0, 2 / 3, 2 / 3, 2 / 3])
    assert viscous._ratio(np.array([6.0, 5.0]), np.array([3.0, 0.0])).tolist() == [2.0, 1.0]


def test_a_column_of_a_climate_has_moments_drift_and_what_lies_beyond_in_sizes(monkeypatch):
    """Drift within and below and above the band add up with their signs; what is beyond counts by its size"""
    beyond = np.array([[1.0, -2.0, 3.0], [-4.0, -5.0, 6.0]])
    told = dict(
        directions=lambda sea, omega, step: (("headings", step), "weights"),
        heading_step=lambda known, sea, omega: "step",
        linear_response=lambda sea, transfer, weights: (None, SimpleNamespace(m0=("m0", transfer), m2="m2")),
        mean_drift=lambda body, sea, omega, drift, weights: (np.array([10.0, 20.0, 30.0]), beyond),
        energy_outside=lambda omega, spectrum: (0.01, 0.02), missed_response=lambda *given: ("left", given[2:]),
    )  # fmt: skip
    for name, stand_in in told.items():
        monkeypatch.setattr(of_climates, name, stand_in)
    known = SimpleNamespace(
        at=lambda omega, heading: (("transfer", heading), "drift"), body=SimpleNamespace(omega="band")
    )
    found = of_climates._column(known, SimpleNamespace(spectrum="spectrum"), "omega")
    transfer = ("transfer", ("headings", "step"))
    assert (found.m0, found.m2) == (("m0", transfer), "m2") and found.drift.tolist() == [7.0, 13.0, 39.0]
    assert found.missed == pytest.approx(0.03) and found.beyond == ("left", (transfer, "weights"))
    assert found.drift_beyond.tolist() == [5.0, 7.0, 9.0]


@pytest.mark.parametrize("sway, yaw, bodies, high", [
    (0.0, 0.0, (), 0.1), (4.0, 0.0, (), 0.3 * math.sqrt(20.0)), (4.0, 45.0, (), 4.5), (45.0, 4.0, (), 4.5),
    (4.0, 45.0, ("one", "two"), 0.1),
])  # fmt: skip
def test_slow_forces_are_sought_to_three_times_the_fastest_of_surge_sway_and_yaw(sway, yaw, bodies, high):
    """A hull of 400 m: 0.2 √(100/400); springs over 15 kg and kg m² and 5 of added mass"""
    K = np.zeros((6, 6))
    K[1, 1], K[5, 5], K[2, 2] = sway, yaw, 1e9
    body = SimpleNamespace(between=SimpleNamespace(length=400.0), gravity=9.80665, stiffness=K, bodies=bodies,
                           inertia=15.0 * np.eye(6), held_added_mass=lambda omega: 5.0 * np.eye(6)[None])  # fmt: skip
    found = slow_drift.differences(body)
    assert found[0] == 0.0 and found[-1] == pytest.approx(high) and len(found) == slow_drift.STEPS + 1
