"""Numbers of the frequency-domain and static studies by hand: rules of extremes, displacements, findings, stiffness."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem import DOFS
from hakobune.bem.database.natural_periods import NaturalPeriods
from hakobune.mooring.environment.sea import Sea
from hakobune.mooring.environment.spectra import issc
from hakobune.mooring.lines.system.characteristic import characteristic
from hakobune.mooring.lines.system.equilibrium import held_at, rest
from hakobune.mooring.lines.system.graph import System
from hakobune.mooring.lines.system.parts import (
    Anchor,
    EquilibriumError,
    Fairlead,
    FreePoint,
    LineSystemError,
    LineType,
    MooredBody,
    UniformLine,
)
from hakobune.mooring.studies import multi_point_findings as told
from hakobune.mooring.studies.conditions import Conditions, Current, ExposedBox, Waves
from hakobune.mooring.studies.in_air import dry_shares, lines_in_air
from hakobune.mooring.studies.multi_point import MultiPoint, fairlead_displacements, outward_directions
from hakobune.mooring.studies.slow_motion import (
    _crossing,
    _drift_damping,
    _estimates,
    _flags,
    _largest,
    _Modes,
    _modes,
    _places,
    _response,
    _rule,
)
from hakobune.mooring.studies.system_at_rest import about_body_axes, mooring_stiffness, offset_curve, one_line_broken
from hakobune.mooring.studies.wave_effects import _cleared

HOUR = 3600.0


def rayleigh(cycles):
    s = math.sqrt(2 * math.log(cycles))
    return s + 0.5772 / s


def test_the_rule_adds_the_largest_of_one_part_to_the_significant_of_the_other():
    """DNV-OS-E301, ch. 2 sec. 2: the larger of 2σ_slow + largest fast and largest slow + 2σ_fast"""
    slow, fast = np.array([3.0, 0.5, 0.0]), np.array([1.0, 2.0, 0.2])
    T_slow, T_fast = np.array([120.0, 60.0, np.inf]), np.array([9.0, 8.0, 7.0])
    found = _rule(slow, T_slow, fast, T_fast, HOUR)
    first = 3 * rayleigh(30) + 2 * 1.0
    second = 2 * 0.5 + 2.0 * rayleigh(450)
    assert found == pytest.approx([first, second, 0.2 * rayleigh(HOUR / 7)], rel=1e-4)


def test_a_motion_of_fewer_than_three_periods_has_its_significant_amplitude():
    found = _largest(np.ones(3), np.array([HOUR / 2.7, HOUR / 2.8, HOUR / 10]), HOUR)
    assert found == pytest.approx([2.0, rayleigh(2.8), rayleigh(10)], rel=1e-4)


def test_mean_crossing_periods_are_those_of_the_moments():
    """2π √(m₀/m₂); a motion that does not move is never back"""
    assert _crossing(np.array([4.0, 1.0]), np.array([1.0, 0.0])) == pytest.approx([4 * math.pi, math.inf])


def test_estimates_of_a_mode_alone():
    """S = 50 flat over 2 rad/s: √(π S/2NC) and σ_F/(2νC), σ_F = 10, of C = 4, N = 0.5, ν = 0.1"""
    omega = np.linspace(0, 2.0, 401)
    force = np.zeros((401, 3, 3))
    for i in range(3):
        force[:, i, i] = 50.0 * (i + 1)
    modes = _Modes(np.full(3, 10.0), np.full(3, 4.0), np.full(3, 0.5), np.full(3, 0.1))
    found = _estimates(force, omega, modes)
    share = np.sqrt([1.0, 2.0, 3.0])
    assert found[:, 0] == pytest.approx(share * math.sqrt(math.pi * 50 / (2 * 0.5 * 4)), rel=1e-9)
    assert found[:, 1] == pytest.approx(share * 10.0 / 4 / 0.2, rel=1e-9)


def test_wave_drift_damping_stands_in_rows_of_surge_sway_yaw_and_columns_of_surge_and_sway():
    full = _drift_damping(np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]))
    wanted = np.zeros((6, 6))
    wanted[[0, 0, 1, 1, 5, 5], [0, 1, 0, 1, 0, 1]] = [1, 2, 3, 4, 5, 6]
    assert np.array_equal(full, wanted) and not _drift_damping(None).any()


def test_a_response_is_that_of_surge_sway_and_yaw_with_the_others_following():
    """Uncoupled: 1/(C − ω²M − iωB); a roll coupled to sway by the stiffness follows: C_yy − C_yr²/C_rr in the limit"""
    M, B, C = np.diag([2.0, 3, 9, 9, 9, 5]), np.diag([0.3, 0.2, 1, 1, 1, 0.4]), np.diag([7.0, 8, 99, 50, 99, 6])
    w = np.array([0.0, 1.5])
    found = _response(w, M, B, C)
    for i, j in enumerate((0, 1, 5)):
        assert found[:, i, i] == pytest.approx(1 / (C[j, j] - w**2 * M[j, j] - 1j * w * B[j, j]), rel=1e-12)
    C[1, 3] = C[3, 1] = 10.0
    assert _response(np.zeros(1), M, B, C)[0, 1, 1] == pytest.approx(1 / (8 - 100 / 50), rel=1e-12)


def held_body(**changes):
    words = ("surge", "sway", "heave", "roll", "pitch", "yaw")
    values = {"stiffness": np.diag([4.0, 9, 0, 0, 0, 16]), "period": np.array([20.0, 30, 1, 1, 1, 40]), "bodies": (),
              "names": DOFS, "words": words} | changes  # fmt: skip
    return SimpleNamespace(**values)


def test_modes_have_stiffness_damping_and_its_share_of_critical(monkeypatch):
    """ν = N/2√(CM); a mode that nothing holds or damps is refused by name"""
    monkeypatch.setattr(
        "hakobune.mooring.studies.slow_motion.natural_periods",
        lambda held: SimpleNamespace(period=held.period, names=DOFS),
    )
    mass, damping = np.diag([1.0, 4, 0, 0, 0, 25]), np.diag([0.4, 1.2, 0, 0, 0, 8])
    found = _modes(held_body(), mass, damping)
    assert (found.period.tolist(), found.stiffness.tolist(), found.damping.tolist()) == (
        [20, 30, 40],
        [4, 9, 16],
        [0.4, 1.2, 8],
    )
    assert found.ratio == pytest.approx([0.1, 0.1, 0.2])
    with pytest.raises(ValueError, match="sway has no restoring by the lines"):
        _modes(held_body(stiffness=np.diag([4.0, 0, 0, 0, 0, 16])), mass, damping)
    with pytest.raises(ValueError, match="surge has no restoring"):
        _modes(held_body(period=np.array([np.inf, 30, 1, 1, 1, 40])), mass, damping)
    with pytest.raises(ValueError, match=r"slow yaw has damping 0 \(.*; give body.damping_ratio = \{ yaw = 0.05 \}"):
        _modes(held_body(), mass, np.diag([0.4, 1.2, 0, 0, 0, 0]))


def test_places_are_close_about_each_resonance_and_reach_three_times_the_highest(monkeypatch):
    monkeypatch.setattr("hakobune.mooring.studies.slow_motion.differences", lambda held: np.array([0.0, 0.2]))
    modes = _Modes(2 * math.pi / np.array([0.1, 0.2, 0.3]), *3 * [np.ones(3)])._replace(
        ratio=np.array([0.05, 0.1, 1e-6])
    )
    omega = _places(SimpleNamespace(bodies=()), modes, None)
    assert omega[0] == 0 and omega[-1] == pytest.approx(0.9) and np.all(np.diff(omega) > 0)
    for natural, width in ((0.1, 0.005), (0.2, 0.02), (0.3, 3e-5)):
        near = omega[np.abs(omega - natural) < width]
        assert len(near) > 15 and np.diff(near).max() < 0.2 * width


@pytest.mark.parametrize("period, near", [(6.6, False), (6.7, True), (14.9, True), (15.1, False)])
def test_a_natural_period_within_half_of_the_waves_is_told(period, near):
    """10 s over or times 1.5: 6.67 to 15 s"""
    modes = _Modes(np.array([period, 99.0, 99.0]), *2 * [np.ones(3)], np.full(3, 0.0201))
    said = list(_flags(modes, Sea(issc(1.0, peak_period=10.0))))
    assert len(said) == near and (
        not near or said[0].startswith(f"natural period of surge {period:g} s is within a factor of 1.5")
    )


@pytest.mark.parametrize("ratio, light", [(0.0201, False), (0.0199, True)])
def test_a_fiftieth_of_critical_is_light(ratio, light):
    said = list(
        _flags(
            _Modes(np.full(3, 99.0), *2 * [np.ones(3)], np.array([0.5, ratio, 0.5])), Sea(issc(1.0, peak_period=10.0))
        )
    )
    assert len(said) == light and (not light or "lightly damped: sway 1.99 % of critical" in said[0])


def test_what_is_rounding_beside_the_largest_is_cleared():
    assert _cleared(np.array([5.0, 4.9e-9, -5.1e-9])).tolist() == [5.0, 0.0, -5.1e-9]


def place_of(fairleads, anchors):
    """A state of lines from anchors to fairleads of a body at (1, 2, 3)"""
    n = len(fairleads)
    points = np.array([*anchors, *fairleads], float)
    ends = np.stack([np.arange(n), n + np.arange(n)], axis=1)
    return SimpleNamespace(
        points=points,
        system=SimpleNamespace(
            arrays=SimpleNamespace(ends=ends, owner=np.array([-1] * n + [0] * n)),
            bodies=[SimpleNamespace(position=(1.0, 2.0, 3.0, 0.0, 0.0, 0.0))],
        ),
        pose=SimpleNamespace(place=np.array([[1.0, 2, 3]])),
    )


def test_a_fairlead_moves_by_the_sum_of_all_modes_with_their_signs():
    """At (10, 5, −2) from the axes, its line 3:4 outwards: Σ |n·shift| + |n·(axis × arm)| Xⱼ, and the same upwards"""
    state = place_of([(11.0, 7.0, 1.0), (2.0, 3.0, 4.0)], [(5.0, -1.0, -20.0), (2.0, 3.0, -20.0)])
    assert outward_directions(state) == pytest.approx(np.array([[0.6, 0.8], [1.0, 0.0]]))
    X = np.array([1.0, 2.0, 4.0, 0.1, 0.2, 0.3])
    out, up = fairlead_displacements(state, X)
    # roll × arm = (0, 2, 5), pitch × arm = (−2, 0, −10), yaw × arm = (−5, 10, 0)
    assert out[0] == pytest.approx(0.6 + 0.8 * 2 + 0.1 * 0.8 * 2 + 0.2 * 0.6 * 2 + 0.3 * abs(-0.6 * 5 + 0.8 * 10))
    assert up[0] == pytest.approx(4.0 + 0.1 * 5 + 0.2 * 10)
    # the other at (1, 1, 1): n = x; roll × arm = (0, −1, 1), pitch × arm = (1, 0, −1), yaw × arm = (−1, 1, 0)
    assert (out[1], up[1]) == pytest.approx((1.0 + 0.2 + 0.3, 4.0 + 0.1 + 0.2))


# ------------------------------------------------------------------ what is told of a multi-point study


NAMES = ("Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw")
WORDS = tuple(name.lower() for name in NAMES)


def periods(*values, inside=None):
    inside = np.ones(6, bool) if inside is None else inside
    return NaturalPeriods(NAMES, np.array(values, float), np.eye(6), inside, 1.0)


@pytest.mark.parametrize("ratio, near", [(0.69, False), (0.71, True), (1.49, True), (1.51, False)])
def test_a_horizontal_natural_period_near_the_waves_is_told(ratio, near):
    result = SimpleNamespace(at_rest=periods(99, 10 * ratio, 10, 10, 10, 99), at_equilibrium=periods(*6 * [99]))
    said = list(told.resonances(result, 10.0))
    assert len(said) == near and (not near or f"at rest near the wave period 10 s: Sway {10 * ratio:.3g} s" in said[0])


@pytest.mark.parametrize("k, stiff", [(4.9, False), (5.1, True)])
def test_lines_that_add_a_twentieth_to_heave_are_told(k, stiff):
    hydro = np.diag([0, 0, 100.0, 0, 1e9, 0])
    result = SimpleNamespace(equilibrium=SimpleNamespace(stiffness=np.diag([9.0, 9, k, 0, 1, 9])))
    said = [text for text in told._stiff_modes(result, hydro, WORDS) if text.startswith("heave")]
    assert len(said) == stiff and (not stiff or "0.051 of the hydrostatic stiffness, limit 0.05" in said[0])
    assert any(
        text.startswith("roll: the mooring stiffness is inf") for text in told._stiff_modes(result, hydro, WORDS)
    )


def test_periods_outside_the_solved_ones_and_motions_that_are_unstable_are_told():
    (said,) = told._held(periods(80, np.inf, 5, 6, 7, 90, inside=np.array([False, False, True, True, True, False])))
    assert said.endswith("added mass at the nearest good frequency: Surge 80 s, Yaw 90 s")
    result = SimpleNamespace(at_rest=periods(9, 9, 9, np.nan, 9, 9), at_equilibrium=periods(*6 * [9]))
    (said,) = told._unstable(result)
    assert said == "FAILS: the body is unstable at rest, without waves, in: Roll; it needs more restoring"


@pytest.mark.parametrize(
    "turn, depth, method, count",
    [
        (0.099, 20.1, "regular_wave", 0),
        (-0.101, 20.1, "regular_wave", 1),
        (0.0, 20.0, "regular_wave", 1),
        (0.0, 20.0, "irregular", 0),
    ],
)
def test_a_body_turned_by_a_tenth_and_shallow_water_are_outside_the_method(turn, depth, method, count):
    conditions = Conditions(waves=Waves(1.0, 9.0, 0.0), method=method)
    said = list(
        told._outside_the_method(SimpleNamespace(displacement=np.array([0, 0, turn]), conditions=conditions), depth)
    )
    assert len(said) == count


@pytest.mark.parametrize("error, told_of", [(0.049, 0), (0.051, 1)])
def test_a_twentieth_of_a_motion_or_drift_between_stored_waves_is_told(error, told_of):
    """A small motion is judged by a tenth of the largest of its kind"""

    class Body:
        words, rigid = WORDS, 6

        def at(self, omega, name, headings):
            if name == "rao":
                size = np.array([1.0, 0.01, 0.5, 0.2, 1e-3, 0.1])
                wrong = np.array([0.01, 0.1 * error, 0.0, 0.01 * 0.2, 0.02 * error, 0.0])
            else:
                size, wrong = np.array([-100.0, 7.0, 50.0]), np.array([3.0, 100 * error, 50 * error])
            return size[None, None], wrong[None, None]

    said = list(told._uncertain(Body(), Waves(1.0, 9.0, math.radians(-30))))
    assert len(said) == told_of
    if told_of:
        assert "waves of 9 s towards 330° lie between" in said[0]
        assert "estimated errors are sway 5 %, pitch 5 %, drift force 5 %, drift moment 5 %; limit 5 %" in said[0]


@pytest.mark.parametrize(
    "ratio, amplitude, count", [(0.84, 0.1, 0), (0.86, 0.1, 1), (1.14, 0.1, 1), (1.16, 0.1, 0), (1.0, 0.9e-4, 0)]
)
def test_roll_near_the_waves_without_viscous_damping_is_told(monkeypatch, ratio, amplitude, count):
    """Roll always, pitch where waves damp it less than a tenth of critical: here not; 1e-4 rad per metre is rounding"""
    monkeypatch.setattr(told, "known_resonances", lambda reader: [SimpleNamespace(mode=4, damping=0.101)])
    result = SimpleNamespace(at_equilibrium=periods(99, 99, 99, 10 * ratio, 10, 99), amplitudes=np.full(6, amplitude))
    db = SimpleNamespace(bodies_reader=SimpleNamespace(words=WORDS, names=NAMES, rigid=6))
    said = list(told._undamped(result, db, Waves(2.0, 10.0, 0.0)))
    assert len(said) == count
    assert all("natural period of roll" in line and "its amplitude 5.73° has" in line for line in said)
    monkeypatch.setattr(told, "known_resonances", lambda reader: [SimpleNamespace(mode=4, damping=0.099)])
    assert len(list(told._undamped(result, db, Waves(2.0, 10.0, 0.0)))) == count + (amplitude > 1e-3)


def test_slow_drift_is_told_in_kilonewtons():
    result = SimpleNamespace(waves={"irregular": SimpleNamespace(warnings=("w",), slow=np.array([1500.0, 2e5, 3e6]))})
    first, said = told._of_the_sea(result)
    assert first == "w" and "Fx 1.5, Fy 200 kN, Mz 3e+03 kN m" in said


# ------------------------------------------------------------------ systems at rest


K = 2e5  # N, EA of lines of 10 m without slack: 2e4 N/m


def taut(*anchors, body=False, length=10.0):
    """Light lines from anchors to a free point, or to a body held at the origin"""
    kind = LineType("wire", 1e-4, K, 1.0, 0.01, breaking_load=1e6)
    end = Fairlead("p", "ship", (0.0, 0.0, 0.0)) if body else FreePoint("p", (0.0, 0.0, -20.0), 0.0, 0.0)
    names = [f"a{i}" for i in range(len(anchors))]
    lines = [UniformLine(f"l{i}", kind, length, name, "p") for i, name in enumerate(names)]
    points = [Anchor(name, place) for name, place in zip(names, anchors, strict=True)]
    return System(1e3, lines, [*points, end], [MooredBody("ship", (0, 0, -20.0, 0, 0, 0), freedom=())] if body else [])


def test_the_stiffness_of_a_body_on_springs_is_their_sum_and_of_springs_in_series_half():
    """Two of 2e4 N/m along x: 4e4; a point between two of them passes on 1e4"""
    state = rest(taut((10.5, 0.0, -20.0), (-10.5, 0.0, -20.0), body=True))
    found = mooring_stiffness(state, "ship")
    assert found[0, 0] == pytest.approx(2 * K / 10, rel=1e-6)
    assert found[1, 1] == pytest.approx(2 * (K * 0.05) / 10.5, rel=1e-5)  # tension over length, of each
    kind = LineType("wire", 1e-4, K, 1.0, 0.01, breaking_load=1e6)
    lines = [
        UniformLine("far", kind, 10.0, "a", "m"),
        UniformLine("near", kind, 10.0, "m", "p"),
        UniformLine("aft", kind, 10.0, "b", "p"),
    ]
    points = [
        Anchor("a", (21.0, 0, -20.0)),
        Anchor("b", (-10.5, 0, -20.0)),
        FreePoint("m", (10.5, 0, -20.0)),
        Fairlead("p", "ship", (0, 0, 0)),
    ]
    state = rest(System(1e3, lines, points, [MooredBody("ship", (0, 0, -20.0, 0, 0, 0), freedom=())]))
    assert mooring_stiffness(state, "ship")[0, 0] == pytest.approx(1.5 * K / 10, rel=1e-5)
    with pytest.raises(LineSystemError, match="body 'boat' is unknown; allowed: ship"):
        mooring_stiffness(state, "boat")
    with pytest.raises(LineSystemError, match="others is 'loose'; allowed"):
        mooring_stiffness(state, "ship", "loose")


def test_an_offset_curve_is_force_tension_and_share_at_each_offset():
    """Springs of 2e4 N/m with 1 kN in each: at x the forward one has 1 kN − k x; 2.5 % of the breaking load is 25 kN"""
    state = rest(taut((10.05, 0.0, -20.0), (-10.05, 0.0, -20.0), body=True))
    counted = []
    curve = offset_curve(state, "ship", math.pi, [0.02, -0.04, 0.0], lambda: counted.append(1))
    x = np.array([-0.02, 0.04, 0.0])  # along +x
    forward, aft = 1e3 - 2e4 * x, 1e3 + 2e4 * x
    assert curve.tension == pytest.approx(np.stack([forward, aft], axis=1), rel=1e-4)
    assert curve.utilisation == pytest.approx(np.stack([forward, aft], axis=1) / 1e6, rel=1e-4)
    assert curve.force[:, 0] == pytest.approx(forward - aft, abs=1.0)
    assert curve.restoring == pytest.approx(forward - aft, abs=1.0)  # against an offset towards −x
    assert len(counted) == 3 and not curve.missed and not curve.grounded_length.any()
    assert (curve.body, curve.direction) == ("ship", math.pi)


def test_the_loss_of_a_line_leaves_the_others_and_says_where_nothing_holds():
    """Three at 120° hold a point; without one two hold it on the line between their anchors"""
    a = 10.2
    places = [(a, 0.0, -20.0), (-0.5 * a, 0.866 * a, -20.0), (-0.5 * a, -0.866 * a, -20.0)]
    state = rest(taut(*places))
    found = one_line_broken(state)
    assert set(found) == {"l0", "l1", "l2"}
    left = found["l0"]
    assert left.pose.free[0, 0] == pytest.approx(-0.5 * a, abs=2e-2) and list(left.system.line_names) == ["l1", "l2"]
    assert len(left.tension) == 2 and left.pose.free[0, 1] == pytest.approx(0.0, abs=1e-6)
    alone = one_line_broken(rest(taut((10.05, 0.0, -20.0), (-10.05, 0.0, -20.0), body=True)))
    assert alone["l1"].tension == pytest.approx([1e3], rel=1e-3)


def test_stiffness_is_taken_to_the_axes_and_the_centre_of_the_body():
    """A spring k along space x at the height 5 of a body turned by 90°: about a centre 2 above its origin, lever 3

    Along body axes it pulls on −y; a rotation about the centre by the body's x moves its end by ∓3
    """
    k, z = 7.0, 5.0
    along = np.array([1.0, 0, 0, 0, z, 0])  # of its end, per motion of the origin in space
    R = np.array([[0.0, -1.0, 0], [1.0, 0, 0], [0, 0, 1.0]])
    found = about_body_axes(k * np.outer(along, along), np.zeros(3), R, np.array([0.0, 0.0, 2.0]))
    own = np.array(
        [0.0, -1.0, 0, z - 2.0, 0, 0]
    )  # body y is −x of space; turning about body x moves a height h by −h along y
    assert found == pytest.approx(k * np.outer(own, own), abs=1e-12)
    pull = np.array([0.0, 10.0, 0.0])  # along body x: the lever of 2 m turns with the body
    more = about_body_axes(np.zeros((6, 6)), pull, R, np.array([0.0, 0.0, 2.0]))
    wanted = np.zeros((6, 6))
    S = np.array([[0, -2.0, 0], [2.0, 0, 0], [0, 0, 0]])
    F = np.array([[0, 0, 0], [0, 0, -10.0], [0, 10.0, 0]])
    wanted[3:, 3:] = F @ S
    assert more == pytest.approx(wanted, abs=1e-12)


def test_a_characteristic_ends_at_the_breaking_load_and_has_the_pull_of_a_spring():
    """A light line of 10 m, EA 2e5 N, breaks at 1e6 N: beyond five times its length; forces EA (x − L)/L"""
    kind = LineType("wire", 1e-4, K, 1.0, 0.01, breaking_load=3e4)
    made = System(
        1e3,
        [UniformLine("l", kind, 10.0, "a", "p")],
        [Anchor("a", (10.4, 0, -20.0)), Fairlead("p", "s", (0, 0, 0))],
        [MooredBody("s", (0, 0, -20.0, 0, 0, 0), freedom=())],
    )
    found = characteristic(rest(made), "l")
    assert found.rest == pytest.approx(10.4) and found.span[-1] == pytest.approx(10 * (1 + 3e4 / K), rel=1e-6)
    pulled = found.span > 10.05
    assert found.horizontal[pulled] == pytest.approx(K * (found.span[pulled] / 10 - 1), rel=1e-3)
    assert found.utilisation[-1] == pytest.approx(1.0, rel=1e-6) and len(found.span) == 24
    assert found.tension[-1] == pytest.approx(3e4, rel=1e-6)
    free = UniformLine("l", LineType("wire", 1e-4, K, 1.0, 0.01), 10.0, "a", "p")
    state = rest(System(1e3, [free], made.points, made.bodies))
    assert characteristic(state, "l").tension[-1] == pytest.approx(4 * K * 0.04, rel=1e-3)
    with pytest.raises(LineSystemError, match="line 'm' is unknown; allowed: l"):
        characteristic(state, "m")


@pytest.mark.parametrize("up, told_of", [(0.19, 0), (0.21, 1)])
def test_a_hundredth_of_a_line_above_the_water_is_told_where_it_weighs_as_in_it(up, told_of):
    """A taut line of 20 m whose end is `up` above still water: that share of its height"""
    kind = LineType("wire", 5.0, 1e9, 1.0, 0.01)
    line = UniformLine("l", kind, 19.99, "a", "p")
    made = System(
        1e3, [line], [Anchor("a", (0, 0, up - 20.0)), Fairlead("p", "s", (0, 0, up))], [MooredBody("s", freedom=())]
    )
    state = rest(held_at(made, {"s": np.zeros(6)}))
    assert dry_shares(state) == pytest.approx([up / 20], rel=2e-3)
    said = list(lines_in_air(state))
    assert len(said) == told_of and (not told_of or "l over 0.0105 of it; limit 0.01" in said[0])


def test_conditions_are_what_their_words_say():
    assert Waves(2.0, 8.0, 0.1).omega == pytest.approx(math.pi / 4)
    for wrong in (0.0, math.inf):
        with pytest.raises(ValueError, match="wave period is"):
            _ = Waves(2.0, wrong, 0.0).omega
    with pytest.raises(ValueError, match="waves of the current are 'fast'; allowed"):
        Current(1.0, 0.0, waves="fast")
    assert ExposedBox(1, 2, 3, 4).superstructure_z is None and EquilibriumError is not None


def test_a_system_at_rest_says_its_largest_tension_whichever_end_it_is_at():
    """A rope of w N/m that hangs h below: T_top = T_bottom + w h, at end a or at end b"""
    kind = LineType("rope", 50.0, 1e7, 1.0, 0.05, breaking_load=1e6)
    for anchor_below in (True, False):
        z = (-50.0, -20.0) if anchor_below else (-20.0, -50.0)
        body = MooredBody("ship", (0, 0, z[1], 0, 0, 0), freedom=())
        line = UniformLine("l", kind, 60.0, "a", "p")
        state = rest(System(1e3, [line], [Anchor("a", (50.0, 0, z[0])), Fairlead("p", "ship", (0, 0, 0))], [body]))
        low, high = sorted([float(state.lines.tension_a[0]), float(state.lines.tension_b[0])])
        assert high - low == pytest.approx(50.0 * 30, rel=2e-3)
        assert state.tension == pytest.approx([high])
        assert repr(state) == f"<SystemEquilibrium 1 lines, largest tension {high:.5g} N>"


def test_a_body_that_came_round_whole_turns_has_its_yaw_within_half_a_turn():
    """1 rad stays one, 2π + 0.1 and −4π − 0.2 are 0.1 and −0.2"""
    moved = np.zeros((3, 6))
    moved[:, 5], moved[:, 0], moved[:, 3] = [1.0, 2 * np.pi + 0.1, -4 * np.pi - 0.2], [1.0, 2.0, 3.0], [0.1, 0.2, 0.3]
    at = SimpleNamespace(
        equilibrium=SimpleNamespace(position=moved + 7.0), rest=SimpleNamespace(position=np.full((3, 6), 7.0))
    )
    assert MultiPoint._moved.func(at)[:, 5] == pytest.approx([1.0, 0.1, -0.2])
    assert MultiPoint._moved.func(at)[:, 3] == pytest.approx([0.1, 0.2, 0.3])
