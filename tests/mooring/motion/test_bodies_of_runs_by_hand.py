"""The body of a run, its coefficients, and the runs that judge it: made-up parts whose sums are known."""

import math
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.motion.simulation import body, moored_body, realisation, run
from hakobune.mooring.motion.simulation.failures import SimulationError


def moored(heading=0.0, free=tuple(range(6)), **changes):
    reader = SimpleNamespace(
        rigid=6, modes=(), inertia=np.diag([1.0, 2, 3, 4, 5, 6]), damping=np.diag(np.full(6, 0.25)), depth=20.0,
        gravity=10.0, axes_at_rest=np.array([[0.0, 0, 0, 0, 0, heading]]), stiffness=np.diag([0.0, 0, 7, 8, 9, 0]),
        coefficients=lambda omega: (np.full((1, 6, 6), 0.0) + omega[0] * np.eye(6), np.full((1, 6, 6), 0.5)),
    )  # fmt: skip
    each = [SimpleNamespace(drift="D", omega="ω"), SimpleNamespace(drift=None)]
    given = {"reader": reader, "quadratic": np.arange(6.0), "slow_added_mass": np.diag(np.full(6, 0.5)), "free": free,
             "spring": np.diag([10.0, 20, 0, 0, 0, 0]), "waves": SimpleNamespace(each=each), "drift_slopes": ["B"],
             "damping": np.diag(np.full(6, 0.125)), "memory": SimpleNamespace(added_mass_infinity=9 * np.eye(6),
                                                                             band=(0.2, 3.0))} | changes  # fmt: skip
    return SimpleNamespace(**given)


def asked(monkeypatch, on_hull=None, slow_drift="newman", damping=True, components="waves", munk=False, heading=0.0,
          wave_ramp=None, given=(), **more):  # fmt: skip
    told = {}
    monkeypatch.setattr(body, "pairs", lambda *_: ["pairs"])
    monkeypatch.setattr(body, "half_waves", lambda *_: ["halves"])
    monkeypatch.setattr(body, "sampled", lambda *given: told.update(given=given) or (np.zeros((6, 1)), 1.5))
    monkeypatch.setattr(body, "mean_frequency", lambda components: 0.8)
    monkeypatch.setattr(body, "frequency_of_coefficients", lambda settings, components: 1.0)
    monkeypatch.setattr(body.slow_damping, "drift_damping_ring", lambda *given: (
        told.update(ring=given) or np.full((9, 6), 3.0)))  # fmt: skip
    settings = SimpleNamespace(memory="constant", ramp=60.0, duration=600.0, slow_drift=slow_drift,
                               wave_drift_damping=damping, wave_ramp=wave_ramp)  # fmt: skip
    weather = SimpleNamespace(on_hull=on_hull, forces=("given",))
    return body.body_of(moored(heading, **more), weather, settings, components, 50.0, munk), told


def test_a_body_has_its_mass_with_added_mass_its_damping_and_what_pushes_it(monkeypatch):
    """1/(M + 1) of each; damping of the study, 1/8, of the body, 1/4, and radiated, 1/2; N₂ of yaw with the hull's"""
    found, told = asked(monkeypatch)
    assert found.mass_inverse == pytest.approx(np.diag(1 / (np.arange(1.0, 7.0) + 1.0)))
    assert found.rigid[0] == pytest.approx(np.diag(np.arange(1.0, 7.0))) and found.slow[0] == pytest.approx(
        np.diag(np.full(6, 0.5))
    )
    assert found.stiffness[0] == pytest.approx(np.diag([0.0, 0, 7, 8, 9, 0]))
    assert found.damping == pytest.approx(np.diag(np.full(6, 0.375)) + 0.5)
    assert found.quadratic.tolist() == [0, 1, 2, 3, 4, 55]
    assert told["given"] == (("given", "pairs", "halves"), 60.0, 600.0, 1)
    assert found.filter_rate == pytest.approx(0.25 * 0.8) and (found.ramp, found.munk) == (60.0, 1.0)
    assert found.wave_ramp.tolist() == [0.0, 60.0] and found.given_step == 1.5 and len(found.memory.decay) == 0
    assert told["ring"][:2] == ("ω", "B") and np.all(found.drift_damping == 3.0)


def test_a_study_s_springs_hold_the_body_along_its_own_axes(monkeypatch):
    """At 90° the spring ahead, 10 N/m, is along y in space"""
    found, _ = asked(monkeypatch, heading=math.pi / 2)
    assert found.spring[0] == pytest.approx(np.diag([20.0, 10, 0, 0, 0, 0]), abs=1e-12)
    assert found.heading.tolist() == [math.pi / 2]


@pytest.mark.parametrize("turning, size", [(True, 0.0), (False, 1.0)])
def test_tests_of_turning_hold_the_inertia_of_the_turn(turning, size, monkeypatch):
    found, _ = asked(monkeypatch, SimpleNamespace(turning=turning), munk=True)
    assert found.rigid[0, 1, 1] == 2.0 * size and found.slow[0, 1, 1] == 0.5 * size and found.munk == 0.0


@pytest.mark.parametrize("more", [{"slow_drift": "none"}, {"damping": False}, {"components": None}])
def test_waves_that_do_not_drift_a_body_do_not_damp_it(more, monkeypatch):
    found, told = asked(monkeypatch, **more)
    assert "ring" not in told and found.drift_damping.shape == (1, 4, 6) and not found.drift_damping.any()
    assert found.filter_rate == pytest.approx(0.25 * (0.4 if more.get("components", 1) is None else 0.8))


def test_motions_that_are_held_have_no_inverse_of_mass(monkeypatch):
    found, _ = asked(monkeypatch, free=(0, 2), wave_ramp=(5.0, 30.0))
    assert np.diag(found.mass_inverse) == pytest.approx([0.5, 0, 0.25, 0, 0, 0])
    assert found.wave_ramp.tolist() == [5.0, 30.0]


@pytest.mark.parametrize("top, fastest", [(3.0, 8.0), (5.0, 10.0)])
def test_states_of_the_memory_beyond_the_band_and_beyond_waves_follow_at_once(top, fastest, monkeypatch):
    """Beyond 8 rad/s and twice the band"""
    told = []
    slow = SimpleNamespace(inertia=2 * np.eye(6), damping=3 * np.eye(6), arrays="states")
    monkeypatch.setattr(body, "slow_memory", lambda memory, rate: told.append(rate) or slow)
    given = moored(memory=SimpleNamespace(added_mass_infinity=9 * np.eye(6), band=(0.2, top)))
    added, damping, arrays = body._coefficients(given, SimpleNamespace(memory="states"), None)
    assert told == [fastest] and arrays == "states"
    assert added == pytest.approx(11 * np.eye(6)) and damping == pytest.approx(3.125 * np.eye(6))


@pytest.mark.parametrize("omega, says", [(None, "there are no waves"), (-1.5, "at -1.5 rad/s are not positive")])
def test_constant_coefficients_are_those_of_a_frequency_at_which_the_mass_is_positive(omega, says, monkeypatch):
    """Mass of surge 1 and added mass −1.5"""
    monkeypatch.setattr(body, "frequency_of_coefficients", lambda settings, components: omega)
    with pytest.raises(SimulationError, match=says):
        body._coefficients(moored(), SimpleNamespace(memory="constant"), None)


# ------------------------------------------------------------------ runs that judge a run


@dataclass
class Asked:
    tolerance: float = 0.01


class Found(SimpleNamespace):
    def _replace(self, **changes):
        return Found(**{**vars(self), **changes})


@pytest.mark.parametrize("worst, third", [(0.0033, False), (0.0034, True), (0.01, True), (0.0101, False)])
def test_a_third_run_is_made_where_the_second_shows_a_third_of_the_tolerance(worst, third, monkeypatch):
    """To a tenth, and to a hundredth, of the tolerance of the study; beyond the tolerance it is told at once"""
    made, told = [], []
    monkeypatch.setattr(run, "_again", lambda moored, finer, moving: moving)
    monkeypatch.setattr(run, "_followed", lambda moored, settings, begun, progress: settings.tolerance)
    monkeypatch.setattr(run, "motion_of", lambda course, at_rest: made.append(course) or course)
    monkeypatch.setattr(run, "doubt_of", lambda found, *finer: told.append(finer) or SimpleNamespace(worst=worst))
    monkeypatch.setattr(run, "with_error", lambda *given: given)
    reader = SimpleNamespace(axes_at_rest=None, words="words")
    given = run._judged(SimpleNamespace(reader=reader), Asked(), Found(moving=None), "found", None)
    assert made == pytest.approx([0.001, 0.0001][: 1 + third]) and len(told) == 1 + third
    assert given[0] == "found" and given[2:4] == (0.01, "words") and len(given) == 4 + third


def found_of(motion):
    time = np.arange(-2.0, len(motion) - 2)
    return Found(time=time, motion=np.array(motion, float), findings=("before",), estimated_error=None)


def test_a_doubt_counts_after_the_ramp_and_no_motion_that_is_none():
    """Two rows before 0 s differ by 100; then by 0.1 of a motion of σ = 1, and by 1e-3 of one that stands still"""
    motion = np.array([[9.0, 5], [9, 5], [1, 5], [-1, 5], [1, 5], [-1, 5]])
    finer = motion + np.array([[100.0, 100]] * 2 + [[0.1, 1e-3]] * 4)
    doubt = realisation.doubt_of(found_of(motion), finer)
    assert doubt.error == pytest.approx([0.1, 1e-3]) and doubt.spread == pytest.approx([1.0, 0.0])
    assert doubt.share(doubt.bound) == pytest.approx([0.1, 0.0]) and doubt.worst == pytest.approx(0.1)


@pytest.mark.parametrize("second, wanted", [(0.02, 0.12 + 0.02 * 0.2 / 0.8), (0.05, 0.15 + 0.05 * 0.5 / 0.5)])
def test_errors_of_three_runs_go_on_as_a_geometric_series(second, wanted):
    """d₀₁ = 0.1, d₁₂ = q d₀₁: max(d₀₁, d₀₂) + d₁₂ q/(1 − q)"""
    motion = np.tile([[1.0], [-1.0]], (4, 1))
    doubt = realisation.doubt_of(found_of(motion), motion + 0.1, motion + 0.1 + second)
    assert doubt.error == pytest.approx([0.1 + second])
    assert doubt.bound == pytest.approx([wanted])
    slow = realisation.doubt_of(found_of(motion), motion + 0.1, motion + 0.2)
    q = realisation.SLOWEST
    assert slow.bound == pytest.approx([0.2 + 0.1 * q / (1 - q)])


@pytest.mark.parametrize("error, said", [
    (0.0099, None), (0.02, "the tolerance is 0.01; give a smaller one"), (0.9, "this motion is chaotic"),
])  # fmt: skip
def test_an_error_beyond_the_tolerance_is_told_with_its_motion(error, said):
    doubt = realisation.Doubt(np.array([0.001, 2 * error]), np.array([0.001, 2 * error]), np.array([1.0, 2.0]))
    found = realisation.with_error(found_of([[0.0, 0.0]] * 3), doubt, 0.01, ("surge", "sway"))
    assert found.estimated_error is doubt.error and found.findings[0] == "before"
    assert len(found.findings) == 1 + (said is not None)
    if said:
        begins = f"the error of sway may be {error:.2g} of its standard deviation, as a run to a tenth of the tolerance"
        assert found.findings[1].startswith(begins) and said in found.findings[1]


@pytest.mark.parametrize("heading", [0.0, math.pi / 2, 0.7])
def test_poses_and_motions_along_the_axes_at_rest_are_each_other_turned(heading):
    """2 m ahead and 1 m to the left of a body headed to ψ lies at (2 cos ψ − sin ψ, 2 sin ψ + cos ψ)"""
    at_rest = np.array([[10.0, 20.0, 0.5, 0.0, 0.0, heading], [0.0, 0, 0, 0, 0, 0]])
    motion = np.array([2.0, 1.0, 0.3, 0.01, 0.02, 0.03, 4.0, 5.0, 6.0, 0.1, 0.2, 0.3])
    poses = realisation.poses_of(motion, at_rest)
    c, s = math.cos(heading), math.sin(heading)
    assert poses[0] == pytest.approx([10 + 2 * c - s, 20 + 2 * s + c, 0.8, 0.01, 0.02, heading + 0.03])
    assert poses[1] == pytest.approx(motion[6:])
    away = poses[None] - at_rest * [1, 1, 1, 1, 1, 0]
    assert realisation.along_axes(away, at_rest)[0] == pytest.approx(motion)


@pytest.mark.parametrize("buoy, wanted", [(None, (None, None, None)), (SimpleNamespace(lengths=[1, 2]), None)])
def test_hawsers_of_a_buoy_come_before_its_lines(buoy, wanted):
    course = SimpleNamespace(buoy="places", hung=np.arange(10.0).reshape(2, 5))
    found = realisation._of_buoy(buoy, course)
    if buoy is None:
        assert found == wanted
    else:
        assert found[0] == "places" and found[1].tolist() == [[0, 1], [5, 6]]
        assert found[2].tolist() == [[2, 3, 4], [7, 8, 9]]


def test_waves_pass_the_origin_by_the_sum_of_their_parts():
    table = SimpleNamespace(omega=np.array([0.5, 1.0]), amplitude=np.array([1.0, 2.0]), phase=np.array([0.3, -0.4]))
    t = np.arange(20.0) * 0.5
    wanted = np.cos(0.3 - 0.5 * t) + 2 * np.cos(-0.4 - t)
    assert realisation._elevation(table, t, None) == pytest.approx(wanted, abs=1e-9)
    none = SimpleNamespace(omega=np.zeros(0))
    assert realisation._elevation(none, t, None).tolist() == [0.0] * 20


# ------------------------------------------------------------------ how a moored body is prepared


@pytest.fixture
def prepared(monkeypatch):
    """`moored_body.moored` with stand-ins of what it calls: what it made, and in which order"""
    calls = []

    def stands(name, value):
        monkeypatch.setattr(moored_body, name, lambda *given, **more: (
            calls.append(name), value(*given) if callable(value) else value)[1])  # fmt: skip

    stands("in_time", SimpleNamespace(damping="damping", quadratic="quadratic", body="viscous body"))
    stands("fitted_memory", ("memory", ("fitted",)))
    stands("_of_viscous", ("viscous",))
    stands("_check_place", None)
    stands("_check_upright", None)
    stands("check_bending", None)
    stands("check_held", None)
    stands("body_lines", None)
    stands("_rest", (np.full(6, 2.0), 5 * np.eye(6)))
    stands("tables_of", "tables")
    stands("_of_tables", ("coarse",))
    stands("with_shapes", lambda berth, body: berth)
    stands("but_berth", "others")
    stands("at_rest", lambda berth, others, start, units: start + 1)
    stands("berth_stiffness", lambda berth, start: start[0] * np.eye(6))
    stands("_of_loose", ("loose",))
    stands("rest_bent", lambda body, berth, others, start, units, free: (start + 3, 9 * np.eye(6)))
    stands("_rest_together", lambda *given: (given[-1] + 4, 8 * np.eye(6)))
    stands("units_of", "units")
    stands("wave_forces", "waves")

    def make(modes=(), links=None, each=True, lines=False, fenders=(), **more):
        monkeypatch.setattr(moored_body, "links_of", lambda body: links)
        body = SimpleNamespace(words=range(6), modes=modes, damping=np.zeros((6, 6)), stiffness=7 * np.eye(6), rigid=6,
                               inertia=np.eye(6), between=SimpleNamespace(forget=lambda: calls.append("forget")),
                               held_added_mass=lambda omega: [f"A at {omega:g}"], knows_drift_of_each=each)  # fmt: skip
        berth = SimpleNamespace(names=fenders)
        db = SimpleNamespace(bodies_reader=SimpleNamespace(floating=lambda: body))
        return moored_body.moored(db, "system" if lines else None, "hull", berth=berth, **more), calls

    return make


def test_a_body_on_its_own_springs_rests_where_it_is(prepared):
    found, calls = prepared(spring=2 * np.eye(6))
    assert found.stiffness == pytest.approx(9 * np.eye(6)) and found.start.tolist() == [0.0] * 6
    assert (
        found.findings == ("fitted", "viscous") and found.slow_added_mass == "A at 0" and found.free == tuple(range(6))
    )
    assert (found.memory, found.damping, found.quadratic, found.waves) == ("memory", "damping", "quadratic", "waves")
    assert "_check_upright" in calls and not {"_rest", "at_rest", "rest_bent", "check_held", "check_bending"} & {*calls}
    given, calls = prepared(memory="given", waves="theirs", motions=(0, 2))
    assert (given.memory, given.waves, given.free) == ("given", "theirs", (0, 2)) and given.findings == ("viscous",)


@pytest.mark.parametrize("lines, fenders, start, stiffness, said", [
    (True, (), 2.0, 5.0, ("coarse",)), (False, ("f",), 1.0, 7.0 + 1.0, ("loose",)),
    (True, ("f",), 3.0, 5.0 + 3.0, ("coarse", "loose")),
])  # fmt: skip
def test_a_body_on_lines_and_fenders_rests_where_both_hold_it(lines, fenders, start, stiffness, said, prepared):
    found, calls = prepared(lines=lines, fenders=fenders)
    assert found.start.tolist() == [start] * 6 and found.stiffness == pytest.approx(stiffness * np.eye(6))
    assert found.findings == ("fitted", "viscous", *said) and "_check_upright" in calls
    assert {"_check_place", "body_lines"} <= {*calls} if lines else "_check_place" not in calls


@pytest.mark.parametrize("lines, fenders, start, stiffness", [
    (False, (), 0.0, 7.0), (True, (), 5.0, 9.0), (False, ("f",), 3.0, 9.0),
])  # fmt: skip
def test_a_body_that_bends_rests_with_its_shapes_on_lines_or_fenders(lines, fenders, start, stiffness, prepared):
    found, calls = prepared(modes=("shape",), lines=lines, fenders=fenders)
    assert found.start.tolist() == [start] * 6 and found.stiffness == pytest.approx(stiffness * np.eye(6))
    assert {"check_bending", "with_shapes", "_check_upright"} <= {*calls} and "at_rest" not in calls
    assert ("rest_bent" in calls) == bool(lines or fenders)


@pytest.mark.parametrize("each", [True, False])
def test_bodies_with_hinges_rest_together_and_are_held_by_them(each, prepared):
    found, calls = prepared(links="links", each=each, lines=True, fenders=("f",))
    assert found.start.tolist() == [4.0] * 6 and found.stiffness == pytest.approx(8 * np.eye(6))
    assert "check_held" in calls and not {"_rest", "at_rest", "_check_upright", "rest_bent"} & {*calls}
    assert any("mean and slow drift of hinged bodies" in line for line in found.findings) == each


def test_a_moored_body_says_how_many_lines_and_states_it_has(prepared):
    found, _ = prepared()
    assert repr(found) == "<Moored 0 lines, memory>"
