"""Ways that calculations of moorings seldom go: what has no solution, is left out, or is known by rule only."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines.catenary import solve as of_catenary
from hakobune.mooring.lines.catenary.state import BeyondReachError, State
from hakobune.mooring.lines.dynamics import estimates
from hakobune.mooring.lines.dynamics.bed import ElasticBed
from hakobune.mooring.lines.dynamics.run import DynamicLineError, Result
from hakobune.mooring.lines.multi_segment.span import span_of
from hakobune.mooring.lines.system import findings as of_lines
from hakobune.mooring.lines.system import surfacing
from hakobune.mooring.lines.system.equilibrium import EquilibriumError
from hakobune.mooring.lines.system.parts import LineType, UniformLine
from hakobune.mooring.motion import contacts
from hakobune.mooring.motion.simulation import failures, moored_body, trial
from hakobune.mooring.motion.simulation.moored_body import Moored
from hakobune.mooring.on_current.waves import absolute_frequency, intrinsic_frequency
from hakobune.mooring.response import pair_levels, slow_drift, viscous
from hakobune.mooring.response.bound_wave_drift import BoundWaveForces
from hakobune.mooring.seas.swan import numbers_of
from hakobune.mooring.seas.two_peaks import OneSystem
from hakobune.mooring.single_point import limit_cycle
from hakobune.mooring.single_point.body import SinglePoint, SinglePointError
from hakobune.mooring.site.contours import _edges
from hakobune.mooring.studies import system_at_rest, wave_effects, waves_around
from hakobune.mooring.studies.breakwater import curves as of_curves
from hakobune.mooring.studies.breakwater import in_sea
from hakobune.mooring.studies.multi_point import MultiPoint
from hakobune.mooring.studies.multi_point_findings import _broken

KIND = LineType("chain", 900.0, 1e8, 80.0, 0.1, 5e6)

# ------------------------------------------------------------------ lines


def test_a_result_says_its_time_its_steps_and_its_largest_tension():
    made = Result.__new__(Result)
    object.__setattr__(made, "time", np.array([0.0, 50.0]))
    object.__setattr__(made, "steps", 321)
    object.__setattr__(made, "tension_fairlead", np.array([1e5, 2e5]))
    assert repr(made) == "<Result 0 to 50 s in 321 steps, largest tension 200000 N>"
    system = SimpleNamespace(lines=[1, 2], line_names=("a", "b"))
    moored = SimpleNamespace(tension=np.array([1e5, 3e5]), utilisation=np.array([0.25, 0.125]), system=system)
    assert MultiPoint.__repr__(moored) == "<MultiPoint 2 lines, largest tension 3e+05 N in b, 0.25 of breaking load>"


@pytest.mark.parametrize("slip, taken", [(None, True), (1e-9, True), (0.0, False), (-1.0, False)])
def test_a_bed_slips_by_more_than_nothing_before_it_rubs(slip, taken):
    if taken:
        assert ElasticBed(slip=slip).slip == slip
    else:
        with pytest.raises(ValueError, match="bed slip is"):
            ElasticBed(slip=slip)


def test_an_error_by_steps_that_cannot_be_had_is_told_and_is_no_number(monkeypatch):
    case = SimpleNamespace(_replace=lambda coarser: coarser)
    monkeypatch.setattr(estimates, "_plain", lambda case: case)

    def failing(case, state):
        assert case == estimates.COARSER
        raise DynamicLineError("it stopped")

    monkeypatch.setattr(estimates, "run_esdirk", failing)
    with pytest.warns(
        UserWarning,
        match="the error that time steps cause in the largest tensions is not known: the run with longer "
        "steps failed, it st",
    ):
        assert math.isnan(estimates.step_error(case, None, None, 0.01))


@pytest.mark.parametrize("tension", [1e3, 1e6])
def test_a_span_is_found_where_newton_goes_astray(tension):
    """H = 10 (x − 30) N or more beyond 30 m, whose slope is told ten times too small and then not at all"""
    tries = []

    def solve(x):
        tries.append(x)
        slope = 1.0 if len(tries) % 2 else -1.0
        return SimpleNamespace(horizontal_fairlead=10 * max(x - 30, 0.0), stiffness=np.array([[slope]]))

    assert span_of(solve, tension, 100.0, 0.0) == pytest.approx(30 + tension / 10, rel=1e-9)


def test_the_first_line_without_a_solution_is_named_with_what_is_wrong():
    line = UniformLine("one", KIND, 70.0, "a", "b")
    system = SimpleNamespace(lines=[line, line], depth=20.0, composites=[])
    rows, starts = np.zeros((2, 18)), np.zeros((2, 3))
    ends = np.array([[0.0, 0, 0], [30.0, 40.0, 0.0]])
    for status, says in (
        (State.BELOW_BED, "line one has an end below the bed, -20 m, here"),
        (State.BEYOND_REACH, "line one, inextensible and 70 m long, cannot span 50 m, here"),
    ):
        rows[1, 0] = status
        assert of_lines.culprit(system, rows, starts, ends, "here").startswith(says)


@pytest.mark.parametrize(
    "error, status", [(BeyondReachError("x"), State.BEYOND_REACH), (ValueError("x"), State.UNSOLVED)]
)
def test_a_line_out_of_the_water_without_a_solution_has_no_forces_and_says_why(error, status):
    def between(*_):
        raise error

    row = np.zeros(18)
    surfacing.fill_surfacing(row, SimpleNamespace(between=between), np.zeros(3), np.ones(3))
    assert row[0] == status and np.isnan(row[1:]).all()


def test_lines_that_are_missed_are_told_by_how_much(monkeypatch):
    """1e-6 of length or span is allowed"""
    found = np.zeros((2, 11))
    monkeypatch.setattr("hakobune.mooring.lines.catenary.uniform.solve_uniform_lines", lambda lines, bed: found)
    for missed, told in (
        (0.5 * of_catenary.TOLERANCE * 100, False),
        (2 * of_catenary.TOLERANCE * 100, True),
        (np.nan, True),
    ):
        found[1, 10] = missed
        if told:
            with pytest.raises(ValueError, match=f"was missed by {missed:.3g} m"):
                of_catenary.solve_lines([50.0, 60.0], 20.0, 100.0, 500.0)
        else:
            of_catenary.solve_lines([50.0, 60.0], 20.0, 100.0, 500.0)


# ------------------------------------------------------------------ bodies at rest and in time


class Links:
    """A hinge that holds x₀ of two bodies together, or nothing, without springs"""

    def __init__(self, monkeypatch, spring=0.0):
        monkeypatch.setattr(contacts, "springs_at", lambda links, poses: -spring * np.asarray(poses).ravel())
        monkeypatch.setattr(contacts, "rows_at", self.rows)

    def rows(self, links, poses):
        G = np.zeros((1, 12))
        G[0, 0], G[0, 6] = 1.0, -1.0
        return G, np.array([poses[0, 0] - poses[1, 0]])


def test_hinged_bodies_rest_where_forces_and_their_hinge_balance(monkeypatch):
    """10 N on one, springs of 2 and 3 N/m: both at 10/5 m, and the hinge gives 3 · 2 N to the other"""
    Links(monkeypatch)
    stiffness = np.ones(12)
    stiffness[0], stiffness[6] = 2.0, 3.0
    push = np.zeros(12)
    push[0] = 10.0
    place, mu = contacts.rest_together("links", lambda x: push - stiffness * x, np.zeros(12), np.ones(12), np.zeros(2))
    assert place[[0, 6]] == pytest.approx([2.0, 2.0]) and np.abs(np.delete(place, [0, 6])).max() < 1e-9
    assert mu == pytest.approx([-6.0])
    again, held = contacts.rest_together("links", lambda x: push - stiffness * x, place, np.ones(12), np.zeros(2))
    assert np.array_equal(again, place) and held == pytest.approx(mu)
    found = contacts.stiffness_together("links", lambda x: push - stiffness * x, place, mu, np.zeros(2))
    assert found == pytest.approx(np.diag(stiffness), abs=1e-6)
    Links(monkeypatch, 4.0)
    place, _ = contacts.rest_together("links", lambda x: push - stiffness * x, np.zeros(12), np.ones(12), np.zeros(2))
    assert place[[0, 6]] == pytest.approx([10 / 13, 10 / 13])


def test_hinged_bodies_that_are_pulled_apart_have_no_equilibrium(monkeypatch):
    Links(monkeypatch)
    monkeypatch.setattr(contacts, "balanced", lambda residual, x: SimpleNamespace(fun=np.array([0.5]), x=x))
    push = np.zeros(12)
    push[1] = 1.0
    with pytest.raises(
        ValueError, match=r"no equilibrium of the bodies with their hinges was found: 0.5 of the largest"
    ):
        contacts.rest_together("links", lambda x: push, np.zeros(12), np.ones(12), np.zeros(2))


@pytest.mark.parametrize("stiffness, told", [
    ([1.0, 1.0, 1.0], ""), ([1.0, 1e-9, 1.0], "sway is not held at rest"),
    ([-1e-3, 1.0, 1.0], "surge is not held at rest"), ([1.0, 1.0, 1e-9 * 1e4], "yaw is not held at rest"),
])  # fmt: skip
def test_a_way_that_nothing_holds_is_named_by_its_share_of_the_stiffest(stiffness, told):
    """K over the inertia of each motion: 1, 1 and 1e4 for yaw"""
    body = SimpleNamespace(inertia=np.diag([1.0, 1.0, 1.0, 1.0, 1.0, 1e4]),
                           words=("surge", "sway", "heave", "roll", "pitch", "yaw"))  # fmt: skip
    K = np.zeros((6, 6))
    K[[0, 1, 5], [0, 1, 5]] = stiffness[0], stiffness[1], 1e4 * stiffness[2] if stiffness[2] == 1.0 else stiffness[2]
    said = list(moored_body._of_loose(K, body, (0, 1, 5)))
    assert [line[: len(told)] for line in said] == ([told] if told else [])


def test_tables_of_forces_that_are_off_are_told_by_their_line_in_per_cent():
    table = SimpleNamespace(error=0.03, coarse=0.125)
    fine = SimpleNamespace(error=2 * moored_body.TOLERANCE, coarse=0.0)
    system = SimpleNamespace(line_names=("a", "b", "c", "d"))
    (said,) = moored_body._of_tables(system, ((fine, table), np.array([0, -1, 1, 1])))
    assert said == ("line c: the error of its force table is up to 3 % of the tension, required 0.5 %, in 12 % of the "
                    "chords and heights")  # fmt: skip


def test_the_dynamic_stiffness_of_a_moored_body_has_its_lines_and_damping(monkeypatch):
    """K of lines alone, its even part; the damping of the study and what drives the body beside what is stored"""
    made = {}

    class Reader:
        stiffness, damping = np.diag([1.0, 2.0]), np.diag([0.5, 0.5])

        def restrained(self, **more):
            made.update(more)
            return self

        def coefficients(self, omega):
            return "A", "B"

        def dynamic_stiffness(self, omega, *both):
            return omega, both

    monkeypatch.setattr(moored_body, "driven", lambda reader: SimpleNamespace(damping=np.diag([0.75, 0.5])))
    own = SimpleNamespace(reader=Reader(), stiffness=np.array([[4.0, 1.0], [3.0, 5.0]]), damping=np.diag([0.1, 0.2]),
                          waves=SimpleNamespace(omega="ω"))  # fmt: skip
    assert Moored.dynamic_stiffness.func(own) == ("ω", ("A", "B"))
    assert made["stiffness"] == pytest.approx(np.array([[3.0, 2.0], [2.0, 3.0]]))
    assert made["damping"] == pytest.approx(np.diag([0.35, 0.2]))


@pytest.mark.parametrize("state, says", [
    ("NO_LINE", "the buoy is 5 m from its place without the body, where a line cannot reach it"),
    ("TOO_SHORT", "steps below 1e-05 s are required, and a hawser pulls 3e+04 N; use a softer hawser"),
])  # fmt: skip
def test_a_buoy_that_cannot_be_followed_is_told_by_its_place_or_its_pull(state, says):
    y = np.zeros(failures.buoy_at(1) + 6)
    y[failures.buoy_at(1) : failures.buoy_at(1) + 2] = 3.0, 4.0
    clock = SimpleNamespace(scale=np.zeros((1, 12)), y=y)
    work = SimpleNamespace(rope=np.array([1e4, 3e4]))
    assert failures._of_buoy(getattr(failures.integrator, state), clock, work).startswith(says)


def test_a_trial_that_fails_one_way_goes_the_other(monkeypatch):
    """Neither: the fault with moving lines is raised; static alone: lines stay still; moving alone: they move"""
    from dataclasses import dataclass

    @dataclass
    class Asked:
        duration: float = 1e9
        ramp: float = 0.0
        dynamic_lines: object = "auto"
        lines_lost: tuple = ()
        estimate_error: bool = True

    asked = []
    system = SimpleNamespace(lines=[1, 2, 3])
    moored = SimpleNamespace(system=system, reader=SimpleNamespace(modes=()))
    monkeypatch.setattr(trial, "able_to_move", lambda system, settings: (("a", "b"), ("left out: c",)))
    monkeypatch.setattr(trial, "_drives", lambda weather: True)
    monkeypatch.setattr(trial, "_nudged", lambda moored: "nudged")
    monkeypatch.setattr(trial, "_of_tension", lambda *given: SimpleNamespace(share=0.5, words="tension"))
    monkeypatch.setattr(trial, "_of_slow_motion", lambda *given: SimpleNamespace(share=0.0, words="motion"))
    failing = set()

    def run(body, weather, settings, seed, progress):
        asked.append((body, settings.dynamic_lines, settings.duration, seed))
        if settings.dynamic_lines in failing:
            raise trial.SimulationError(f"no way with {settings.dynamic_lines}")
        return settings.dynamic_lines

    def choice():
        return trial.chosen(run, moored, "weather", Asked())

    found = choice()
    assert asked == [("nudged", (), trial.SHORT, 0), ("nudged", ("a", "b"), trial.SHORT, 0)]
    assert found[0].dynamic_lines == ("a", "b") and "2 of 3 lines have a motion of their own" in found[1][0]
    failing.add(("a", "b"))
    found = choice()
    assert found[0].dynamic_lines == () and found[1] == ()
    assert found[2] == ("left out: the motion of the lines: no way with ('a', 'b')", "left out: c")
    failing.clear()
    failing.add(())
    found = choice()
    assert found[0].dynamic_lines == ("a", "b") and found[1][0].endswith("fails (no way with ()): 2 of 3 move")
    failing.add(("a", "b"))
    with pytest.raises(trial.SimulationError, match=r"no way with \('a', 'b'\)"):
        choice()
    failing.clear()
    asked.clear()
    unclear = SimpleNamespace(share=0.99 * trial.CLEAR, words="tension")  # a short trial does not decide it
    monkeypatch.setattr(trial, "_of_tension", lambda *given: unclear)
    assert choice()[0].dynamic_lines == ("a", "b") and "in a trial of 600 s" in choice()[1][0]
    assert [length for _, _, length, _ in asked] == [100.0, 100.0, 600.0, 600.0] * 2


# ------------------------------------------------------------------ seas


@pytest.mark.parametrize("order, low, high", [(4, 0.0, 3.0), (4, 0.5, 1.5), (2, 0.0, 2.0), (3, 0.6, 9.0)])
def test_moments_that_have_no_end_are_integrals_up_to_where_they_are_asked_for(order, low, high):
    """Shape 0.5: a term falls as ω⁻³; against a sum over 200 000 places"""
    one = OneSystem(3.0, 0.8, 0.5)
    omega = np.linspace(max(low, 1e-3), high, 200_001)
    wanted = np.trapezoid(omega**order * one.density(omega), omega)
    assert one.moment(order, low, high) == pytest.approx(wanted, rel=2e-4)
    with pytest.raises(ValueError, match=f"moment of order {order} is infinite at the shape parameter 0.5; give high"):
        one.moment(order)


def test_peaks_of_a_system_lie_within_its_grid():
    one = OneSystem(3.0, 0.8, 2.0)
    assert one._grid()[0] == pytest.approx(0.16) and one._grid()[-1] == pytest.approx(80.0)
    assert numbers_of("1 2.5") == [1.0, 2.5]


@pytest.mark.parametrize("speed", [0.5, 3.0, -0.4])
def test_waves_on_a_current_meet_a_place_at_the_frequency_they_are_found_from(speed):
    omega = np.array([0.2, 0.8, 1.5])
    found = intrinsic_frequency(omega, speed, 30.0, 9.81)
    assert absolute_frequency(found, speed, 30.0, 9.81) == pytest.approx(omega, rel=1e-6)


def test_classes_end_half_way_between_their_middles_and_begin_at_0_or_above():
    assert _edges(np.array([1.0, 2.0, 4.0])).tolist() == [0.5, 1.5, 3.0, 5.0]
    assert _edges(np.array([0.2, 2.0]))[0] == 0.0


# ------------------------------------------------------------------ responses


def test_polynomials_of_bound_wave_forces_are_sums_of_cosines_however_many_pairs_there_are():
    rng = np.random.default_rng(5)
    coefficients = rng.normal(size=(4, 3, 6)) + 1j * rng.normal(size=(4, 3, 6))
    forces = BoundWaveForces(0.0, 0.4, (6.0, 11.0), coefficients, 20.0, 9.81)
    x, y = rng.uniform(-1, 1, (2, 2500))
    a, b = (np.cos(np.outer(np.arange(n), np.arccos(one))) for n, one in ((4, x), (3, y)))
    exact = np.einsum("an,bn,abj->jn", a, b, coefficients)
    for n in (0, 1, 1024, 2500):
        assert forces._polynomials(x[:n], y[:n]) == pytest.approx(exact[:, :n], rel=1e-12, abs=1e-12)
    assert forces(np.zeros((0, 2)), 0.0).shape == (0, 2, 6) and forces(0.7, 0.6).shape == (6,)


def test_the_error_of_bound_wave_forces_is_that_of_their_last_coefficients():
    """Of one force 1 everywhere in 4 by 5 coefficients: two rows of 5 and two columns of 4 of 20"""
    made = BoundWaveForces(0.0, 1.0, (1.0, 2.0), np.zeros((4, 5, 6), complex), 20.0, 9.81)
    made.coefficients[..., 0] = 1j
    made.coefficients[0, 0, 1] = 3.0
    assert made.error.tolist() == [18 / 20, 0.0, 0.0, 0.0, 0.0, 0.0]


@pytest.mark.parametrize("ratio, words", [(None, "their force is unknown without drift and inertia"),
                                         (0.0123, "their force is 1.23 % of Newman's slow force")])  # fmt: skip
def test_bound_waves_that_do_not_count_are_told_in_per_cent(ratio, words, monkeypatch):
    monkeypatch.setattr(pair_levels, "ursell", lambda reader, sea: 0.0)
    monkeypatch.setattr(pair_levels, "bound_to_newman", lambda body, sea: ratio)
    db = SimpleNamespace(reader=SimpleNamespace(floating=lambda: None))
    found, (said,) = pair_levels.beside_newman(db, None, "auto")
    assert found is None and said.endswith(f"bound long waves are left out; {words}")
    assert pair_levels.beside_newman(db, None, "newman") == (None, ())


@pytest.mark.parametrize("ratio, level", [(0.0499, None), (0.0501, "full")])
def test_bound_waves_of_a_twentieth_of_newmans_force_count(ratio, level, monkeypatch):
    monkeypatch.setattr(pair_levels, "ursell", lambda reader, sea: 0.0)
    monkeypatch.setattr(pair_levels, "bound_to_newman", lambda body, sea: ratio)
    monkeypatch.setattr(pair_levels, "stored_pairs", lambda *asked: SimpleNamespace(level="full"))
    monkeypatch.setattr(pair_levels, "_surface_left_out", lambda *asked: ())
    monkeypatch.setattr(pair_levels, "_failed", lambda *asked: ())
    found, (said,) = pair_levels.beside_newman(
        SimpleNamespace(reader=SimpleNamespace(floating=lambda: None)), None, "auto"
    )
    assert getattr(found, "level", None) == level and said.startswith(f'qtf = "auto" uses {level or "newman"}: ')


def test_pairs_of_a_spread_sea_are_of_the_headings_that_it_sends_waves_to(monkeypatch):
    """Shares 0.5, 0 and 0.5 of three headings: four pairs, each with the drift of its own"""
    drift = np.array([[[1.0], [2.0], [3.0]]])
    monkeypatch.setattr(pair_levels, "_drift", lambda db, forces, headings, body: ("ω", drift))
    monkeypatch.setattr(pair_levels, "PairForces", lambda *given: given)
    monkeypatch.setattr(pair_levels, "SpreadPairForces", lambda *given: given)
    monkeypatch.setattr("hakobune.bem.second_order.stored.BetweenPairs", lambda *given: given)
    forces = SimpleNamespace(headings=[0.0, 1.0, 2.0], omega="w", frequency="f")
    values = np.arange(9.0).reshape(1, 1, 3, 3)
    db = SimpleNamespace(path="x.h5")
    sea = SimpleNamespace(directional=lambda headings: np.array([0.5, 0.0, 0.5]))
    pairs, headings, of, level = pair_levels._of_headings(db, sea, forces, values, "full", None)
    assert set(pairs) == {(0, 0), (0, 2), (2, 0), (2, 2)} and (headings, of, level) == (forces.headings, sea, "full")
    between, omega, one, _, two = pairs[0, 2]
    assert between[2].item() == 2.0 and omega == "ω" and (one.item(), two.item()) == (1.0, 3.0)

    def refused(headings):
        raise ValueError("too few")

    sea.directional = refused
    with pytest.raises(ValueError, match=r"pairs in x.h5: too few; 'hakobune qtf x.h5 --heading' computes them"):
        pair_levels._of_headings(db, sea, forces, values, "full", None)


def test_slow_forces_by_pairs_on_a_current_are_of_the_frequencies_that_are_met():
    """With ω_e = 2 ω a difference of 0.1 is one of 0.05 in still water, and its spectrum half as wide: half as high"""
    omega = np.linspace(0.4, 1.6, 401)
    spectrum = SimpleNamespace(density=lambda w: np.exp(-(((np.asarray(w) - 0.9) / 0.1) ** 2)))

    def bound(other, omega):
        T = np.zeros((len(omega), 6), complex)
        T[:, 2] = 1.0 + other - omega
        return T

    drift = np.zeros((401, 3))
    still = slow_drift.force_spectrum_with(bound, spectrum, omega, drift, np.array([0.05]))
    met = slow_drift.force_spectrum_with(bound, spectrum, omega, drift, np.array([0.1]), lambda w: 2 * w)
    assert met[0, 2] == pytest.approx(0.5 * still[0, 2], rel=1e-3) and still[0, 2] > 0
    drift[:] = 4.0
    more = slow_drift.force_spectrum_with(bound, spectrum, omega, drift, np.array([0.05]))
    assert more[0, [0, 1, 5]] == pytest.approx(np.full(3, 16 * still[0, 2] / 1.05**2), rel=1e-6)
    assert more[0, 2] == pytest.approx(still[0, 2])


def test_viscous_damping_in_regular_waves_is_of_their_height(monkeypatch):
    asked = {}
    law = SimpleNamespace()
    monkeypatch.setattr(viscous, "laws_of", lambda reader: {"Roll": law})
    monkeypatch.setattr(viscous, "replace", lambda body, viscous: ("damped", viscous))
    monkeypatch.setattr(viscous, "Viscous", lambda laws, amplitude: (laws, amplitude))
    monkeypatch.setattr(
        viscous,
        "in_regular_waves",
        lambda body, *given: asked.update(body=body, given=given) or ("found", np.diag(6 * [7.0])),
    )

    class Reader:
        names, rebuilds_drift = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"), True
        modes, rigid = (), 6

        def floating(self):
            return self

        def restrained(self, damping):
            asked["held"] = damping
            return self

    waves = SimpleNamespace(height=3.0, omega=0.7, direction=0.2)
    found = viscous.in_time(Reader(), waves, damping=np.diag([1.0, 2, 3, 4, 5, 6]))
    assert asked["given"] == (0.7, 1.5, 0.2) and asked["body"] == ("damped", ({"Roll": law}, 1.5))
    assert np.diag(asked["held"]).tolist() == [0, 0, 3, 4, 5, 0] and found.body == "found"
    assert np.diag(found.damping).tolist() == [8, 9, 10, 11, 12, 13] and found.quadratic.tolist() == [0] * 6


# ------------------------------------------------------------------ single points, breakwaters, studies


def hold(reach, heading=0.0, near=None):
    """Which hawsers were tried of a body with two, of which those in `reach` can hold it, with what they miss"""
    tried, point = [], SimpleNamespace()
    point.lengths, point.origin = np.array([30.0, 30.0]), np.array([0.0, 10.0])
    point.ends = np.array([[5.0, 1.0], [5.0, -1.0]])

    def one(place, R, which, near):
        tried.append(which)
        if which not in reach:
            raise SinglePointError(f"{which} is beyond reach")
        return reach[which], f"hold {which}"

    point._one, point._both = one, lambda place, R: one(place, R, "both", None)
    try:
        return SinglePoint.hold(point, np.zeros(2), heading, near), tried
    except SinglePointError as error:
        return str(error), tried


def test_a_body_hangs_on_both_hawsers_or_the_one_that_is_nearer():
    """The buoy lies to port, where the first hawser is; of none that is exact, the one that misses least"""
    assert hold({"both": 0.0}) == ("hold both", ["both"])
    assert hold({0: 0.0, 1: 0.0}) == ("hold 0", ["both", 0])
    assert hold({0: 0.0, 1: 0.0}, math.pi) == ("hold 1", ["both", 1])
    assert hold({"both": 3.0, 0: 2.0, 1: 1.0}) == ("hold 1", ["both", 0, 1])
    assert hold({"both": 1.0, 0: 2.0, 1: 3.0})[0] == "hold both"
    assert hold({}) == ("1 is beyond reach", ["both", 0, 1])


def test_a_cycle_that_lines_do_not_reach_is_scaled_by_less(monkeypatch):
    """From a mean of 1 by 4, 2, √2 …: the first that lines reach"""
    center, tried = np.array([1.0] * 6), []
    period = SimpleNamespace(samples=lambda t: np.tile(center, (len(t), 1)), length=5.0, end=center + 1.0)

    def run(point, state, longest):
        tried.append(state[0] - 1.0)
        if state[0] > 2.5:
            raise SinglePointError("beyond reach")
        return SimpleNamespace(end="end")

    monkeypatch.setattr(limit_cycle, "_period", run)
    assert limit_cycle._scaled("point", period, 4.0, 0.5) == "end" and tried == pytest.approx([4.0, 2.0, 2**0.5])
    tried.clear()
    period.end = center + 1e9
    assert limit_cycle._scaled("point", period, 4.0, 0.5) is period.end and len(tried) == limit_cycle.HALVED


def test_a_theory_beside_the_first_that_lacks_a_holding_is_left_out_with_a_word(monkeypatch):
    def response(breakwater, holding, theory, rise, omega):
        if holding == "catenary" and theory != lacking:
            return f"{holding} {theory}"
        raise of_curves.BreakwaterError("it has no such lines")

    first, other = of_curves.THEORIES[0], "long waves"
    monkeypatch.setattr(of_curves, "response", response)
    study = SimpleNamespace(theories=(first, other), holdings=("catenary",))
    lacking = other
    made, left_out = of_curves.curves(study, None)
    assert [(one.holding, one.theory) for one in made] == [("catenary", first)]
    assert left_out == ["catenary by long waves is left out: it has no such lines"]
    lacking = first
    with pytest.raises(of_curves.BreakwaterError):
        of_curves.curves(study, None)


def test_waves_at_an_angle_come_along_the_normal_of_a_section_that_is_no_rectangle():
    sea = SimpleNamespace(direction=0.3, spreading=None)
    study = SimpleNamespace(sea=sea, section=SimpleNamespace(shape="circle"))
    omega = np.ones(3)
    with pytest.warns(UserWarning, match="waves at an angle are supported for rectangles"):
        assert not in_sea.ways_of(study, omega).any()
    assert in_sea.ways_of(study, omega, any_section=True).tolist() == [[0.3] * 3]
    study.section.shape = "rectangle"
    assert in_sea.ways_of(study, omega).tolist() == [[0.3] * 3]
    sea.direction, study.section.shape = 0.0, "circle"
    assert in_sea.ways_of(study, omega).tolist() == [[0.0] * 3]


@pytest.mark.parametrize("way, told", [(0.0, False), (0.3, True)])
def test_the_sea_behind_by_a_theory_of_normal_waves_is_left_out_where_they_come_at_an_angle(way, told, monkeypatch):
    """K = 0.5 of all waves: half the height; and nothing of lines without a pretension"""
    import warnings

    omega = np.array([0.8, 1.0])
    sea = SimpleNamespace(omega=omega, height=2.0, deviation=lambda K: 0.5 * K[0])
    monkeypatch.setattr(in_sea, "equal_cells", lambda spectrum, cells: sea)
    monkeypatch.setattr(in_sea, "ways_of", lambda breakwater, omega: np.full((1, 2), way))
    asked = []
    monkeypatch.setattr(in_sea, "response_in_sea", lambda breakwater, holding, theory, rise, omega, amplitude, ways: (
        asked.append((holding, theory, rise, amplitude)) or SimpleNamespace(transmission=np.full(2, 0.5))))  # fmt: skip
    first = in_sea.THEORIES[0]
    curves = [of_curves.Curve("taut", first, None), of_curves.Curve("taut", "long waves", None)]
    study = SimpleNamespace(sea=SimpleNamespace(spectrum=SimpleNamespace(T02=6.0)), duration=3600.0)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = in_sea.sea_behind(study, curves, [], None)
    assert [str(one.message) for one in caught] == [
        "the sea behind taut, long waves is left out: this theory covers waves along the normal only"
    ] * told  # fmt: skip
    assert found.heights == dict.fromkeys(["taut", "taut, long waves"][: 2 - told], 1.0)
    assert asked[0] == ("taut", first, 0.0, in_sea.GAUSSIAN * 0.5) and found.waves == 600.0
    assert found[3:4] == (None,) and found.greatest is None and found.slack is None


def test_lines_beyond_reach_are_counted_and_named(monkeypatch):
    monkeypatch.setattr("hakobune.mooring.studies.multi_point_findings.strains", lambda system, tension: np.zeros(3))
    system = SimpleNamespace(line_names=np.array(["a", "b", "c"]))
    result = SimpleNamespace(system=system, tension=np.ones(3), utilisation=np.zeros(3), allowable=0.5)
    said = next(_broken(result, np.array([True, False, True])))
    assert said.startswith(
        "FAILS: 2 of 3 lines cannot reach the fairlead at the largest displacement,"
    ) and said.endswith(": a, c")


def test_offsets_are_tried_from_the_nearest_on_each_side_from_where_the_others_came_to_rest(monkeypatch):
    """The other body of two stays where it came to rest at the offset before; what is not found is nan, or refused"""
    started, progress = [], []

    class Pose(SimpleNamespace):
        def _replace(self, free):
            return Pose(free=free, place=self.place.copy(), turn=self.turn.copy())

    def pose(free, x):
        return Pose(free=free, place=np.full((2, 3), x), turn=np.full((2, 3, 3), x))

    monkeypatch.setattr(system_at_rest, "body_number", lambda system, body: 0)
    monkeypatch.setattr(system_at_rest, "held_at", lambda system, given: SimpleNamespace(
        at=given["p"][1], pose=pose("own", 0.0), bodies=[0, 1]))  # fmt: skip

    def rest(held, start):
        started.append((held.at, start.free, start.place[1, 0], start.turn[1, 0, 0], start.place[0, 0]))
        if abs(held.at) > limit:
            raise EquilibriumError("too far")
        load = SimpleNamespace(force=np.arange(12.0) + held.at)
        system = SimpleNamespace(load=lambda at: load)
        lines = SimpleNamespace(grounded_length=np.array([held.at]), utilisation=np.array([0.1]))
        return SimpleNamespace(pose=pose(f"at {held.at:g}", held.at), system=system, lines=lines,
                               tension=np.array([10 * held.at]))  # fmt: skip

    monkeypatch.setattr(system_at_rest, "rest", rest)
    state = SimpleNamespace(system=SimpleNamespace(lines=[1]), position=np.zeros((2, 6)), pose=pose("rest", 7.0))
    limit = 2.5
    found = system_at_rest.offset_curve(
        state, "p", math.pi / 2, [-2.0, 1.0, 3.0, 2.0, -1.0], lambda: progress.append(1)
    )
    assert started == [
        (1.0, "rest", 7.0, 7.0, 0.0), (-1.0, "rest", 7.0, 7.0, 0.0), (-2.0, "at -1", -1.0, -1.0, 0.0),
        (2.0, "at 1", 1.0, 1.0, 0.0), (3.0, "at 2", 2.0, 2.0, 0.0),
    ]  # fmt: skip
    assert len(progress) == 5
    values = [value for value in vars(found).values() if isinstance(value, np.ndarray)] if hasattr(
        found, "__dict__") else list(found)  # fmt: skip
    tension = next(value for value in values if np.shape(value) == (5, 1) and np.nanmax(value) == 20.0)
    assert np.isnan(tension[2]).all() and tension[[0, 1, 3, 4], 0].tolist() == [-20.0, 10.0, 20.0, -10.0]
    limit = 0.0
    with pytest.raises(EquilibriumError, match="body p at offset 1 m: too far"):
        system_at_rest.offset_curve(state, "p", math.pi / 2, [-2.0, 1.0])


def test_a_map_of_waves_damps_its_body_in_waves_of_the_height_asked_for(monkeypatch):
    asked = []
    monkeypatch.setattr(waves_around, "in_regular_waves", lambda reader, *given: (f"{reader} {given}", None))
    monkeypatch.setattr(waves_around, "waves_around", lambda reader, *given: (reader, given))

    class Viscous:
        wave_amplitude = 0.75

        def __str__(self):
            return "body"

    reader = SimpleNamespace(viscous=Viscous())
    db = SimpleNamespace(require=lambda *names: asked.append(names), bodies_reader=reader, bodies=[], attributes={})
    found, given = waves_around.around_body(db, 0.8, 0.1, False, 1.5)
    assert found.endswith("(0.8, 1.5, 0.1)") and given == (0.8, 0.1, False)
    assert waves_around.around_body(db, 0.8, 0.1, True)[0] is reader
    around = SimpleNamespace(motion=1, missed=0.0, pierces=False)
    for amplitude, height in ((None, 1.5), (1.0, 2.0)):
        (said,) = waves_around.remarks(around, db, amplitude)
        assert said == f"the body's motion includes its viscous damping in waves of {height:g} m"
    around.motion = None
    assert not list(waves_around.remarks(around, db))
    around.missed, db.bodies = 1.01 * waves_around.MISSED, [1, 2]
    between, missed = waves_around.remarks(around, db)
    assert between.startswith("no elevation is computed between the bodies") and missed.startswith(
        "FAILS: the sources in the hull miss"
    )
    with pytest.raises(ValueError, match="heading is not a number"):
        waves_around.around_body(db, 0.8, math.nan, False)


def test_drift_of_each_of_several_bodies_has_to_be_known_in_irregular_waves():
    reader = SimpleNamespace(knows_drift=True, bodies=[1], knows_drift_of_each=False)
    with pytest.raises(wave_effects.BetweenError, match="body_drift_force must be stored for a study with waves"):
        wave_effects._irregular(reader, SimpleNamespace(sea="sea", waves=None))
    reader.knows_drift = False
    with pytest.raises(wave_effects.BetweenError, match=r"^drift_force must be stored for waves"):
        wave_effects._irregular(reader, SimpleNamespace(sea="sea", waves=None))


def test_elements_pull_by_the_rows_of_their_own_table():
    """EA (T₀ + s (e − e₀)) of the row of its strain: 10 · 0.05; of a table 0, 1 + 3 · 0.02 and 2 + 5 · 0.1"""
    from hakobune.mooring.lines.dynamics.lumped.system import elastic_tension

    table = np.array([[0.0, 0.0, 10.0, 0], [0.0, 0.0, 2.0, 0], [0.1, 1.0, 3.0, 0], [0.2, 2.0, 5.0, 0]])
    system = SimpleNamespace(length=np.array([1.0, 1.0, 2.0, 1.0]), stiffness=np.array([1.0, 10.0, 100.0, 1000.0]),
                             elongation=table, elongation_rows=np.array([[0, 1], [1, 4], [1, 4], [1, 4]]))  # fmt: skip
    q = np.zeros((5, 3))
    q[1:, 0] = np.cumsum([1.05, 0.9, 2 * 1.12, 1.3])
    assert elastic_tension(system, q) == pytest.approx([0.5, 0.0, 100 * 1.06, 1000 * 2.5])


@pytest.mark.parametrize("most, refused", [(0.99, False), (1.02, True)])
def test_the_outermost_way_of_a_spread_sea_travels_85_degrees_to_the_normal_at_most(most, refused):
    """Of twelve ways of equal energy, at shares 1/24, 3/24 …, with a mean of 0.2 rad: one is beyond"""
    outermost = most * np.radians(85)

    def quantile(share, omega):
        assert omega.tolist() == [1.0] * 3
        return np.where(share > 0.95, outermost - 0.2, share - 0.5)

    sea = SimpleNamespace(direction=0.2, spreading=SimpleNamespace(quantile=quantile))
    study = SimpleNamespace(sea=sea, section=SimpleNamespace(shape="rectangle"))
    if refused:
        with pytest.raises(of_curves.BreakwaterError, match=r"up to 86\.7° to the normal; allowed: 85;"):
            in_sea.ways_of(study, np.ones(3))
        return
    ways = in_sea.ways_of(study, np.ones(3))
    assert ways[:-1, 1] == pytest.approx(0.2 + (np.arange(11) + 0.5) / 12 - 0.5) and ways[-1, 0] == outermost
