"""What moves a line, by hand: a fairlead in waves and by a table, currents, waves; what a run is refused for."""

import math
import warnings
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.lines.dynamics import simulation
from hakobune.mooring.lines.dynamics.surroundings import CurrentProfile, FairleadMotion, WaveTrain, water_arrays

G = 9.80665


def test_a_fairlead_is_a_mean_and_two_harmonics():
    """Re Σ X exp(−iωt), of which the longest period is the ramp; a step resolves the shortest by 36"""
    X = np.array([[1.0 + 2j, 0.0, 0.5j], [0.2, -0.3j, 0.0]])
    made = FairleadMotion.harmonic((10.0, 20.0, -5.0), X, [8.0, 5.0])
    assert made.ramp == 8.0 and (made.begin, made.end) == (0.0, np.inf)
    assert made.longest_step == pytest.approx(5.0 / 36)
    omega = 2 * np.pi / np.array([8.0, 5.0])
    for t in (9.0, 12.3):
        turn = X * np.exp(-1j * omega * t)[:, None]
        place, speed, push = made.at(t)
        assert place == pytest.approx(np.array([10.0, 20.0, -5.0]) + turn.sum(axis=0).real)
        assert speed == pytest.approx((-1j * omega[:, None] * turn).sum(axis=0).real)
        assert push == pytest.approx((-(omega[:, None] ** 2) * turn).sum(axis=0).real)
    assert np.allclose(made.at(0.0), [[10.0, 20.0, -5.0], [0, 0, 0], [0, 0, 0]])
    assert FairleadMotion.harmonic((0.0, 0.0, 0.0), X[:1], 8.0, ramp=0.0).at(0.0)[0] == pytest.approx([1.0, 0.0, 0.0])
    assert np.allclose(FairleadMotion.still((1.0, 2.0, 3.0)).at(7.0), [[1.0, 2.0, 3.0], [0, 0, 0], [0, 0, 0]])


def test_a_table_of_a_cubic_is_that_cubic_with_its_velocities_or_without():
    """2 + 3 t − t² + 0.5 t³ of each coordinate, at uneven times from 1 to 4 s"""
    c = np.array([2.0, 3.0, -1.0, 0.5])
    place = lambda t: np.outer(np.polynomial.polynomial.polyval(t, c), [1.0, -2.0, 0.5])  # noqa: E731
    speed = lambda t: np.outer(np.polynomial.polynomial.polyval(t, [3.0, -2.0, 1.5]), [1.0, -2.0, 0.5])  # noqa: E731
    t = np.array([1.0, 1.5, 2.7, 4.0])
    for made in (FairleadMotion.table(t, place(t)), FairleadMotion.table(t, place(t), speed(t))):
        assert (made.begin, made.end, made.longest_step) == (1.0, 4.0, pytest.approx(2.6)) and made.ramp == 0.0
        found = made.at(2.0)
        assert found[0] == pytest.approx(place([2.0])[0]) and found[1] == pytest.approx(speed([2.0])[0])
        assert found[2] == pytest.approx(np.array([1.0, -2.0, 0.5]) * (-2 + 3 * 2.0))
        assert np.array_equal(made.mean, place(t)[0])


@pytest.mark.parametrize("make, says", [
    (lambda: FairleadMotion.harmonic((0, 0), [1, 0, 0], 8.0), "fairlead position is"),
    (lambda: FairleadMotion.harmonic((0, 0, np.nan), [1, 0, 0], 8.0), "fairlead position is"),
    (lambda: FairleadMotion.harmonic((0, 0, 0), [[1, 0, 0]] * 2, 8.0), r"shape \(2, 3\); allowed: \(1, 3\)"),
    (lambda: FairleadMotion.harmonic((0, 0, 0), [1, 0, np.inf], 8.0), "finite"),
    (lambda: FairleadMotion.harmonic((0, 0, 0), [1, 0, 0], 0.0), "fairlead period is 0 s"),
    (lambda: FairleadMotion.harmonic((0, 0, 0), [1, 0, 0], 8.0, ramp=-1.0), "ramp is -1 s"),
    (lambda: FairleadMotion.harmonic((0, 0, 0), [1, 0, 0], 8.0, ramp=np.inf), "ramp is inf s"),
    (lambda: FairleadMotion.table([0.0], np.zeros((1, 3))), "k ≥ 2"),
    (lambda: FairleadMotion.table([0.0, 1.0], np.zeros((2, 2))), "allowed"),
    (lambda: FairleadMotion.table([0.0, 0.0], np.zeros((2, 3))), "do not rise"),
    (lambda: FairleadMotion.table([0.0, 1.0], np.full((2, 3), np.nan)), "not finite"),
    (lambda: CurrentProfile([0.0, -1.0], np.zeros((2, 2))), "do not rise"),
    (lambda: CurrentProfile([0.0, 0.0], np.zeros((2, 2))), "do not rise"),
    (lambda: CurrentProfile([0.0, 1.0], np.zeros((1, 2))), "current has shapes"),
    (lambda: CurrentProfile([0.0], [[np.inf, 0.0]]), "finite"),
    (lambda: WaveTrain(1.0, 0.0, 0.0), "periods above 0 s"), (lambda: WaveTrain(np.nan, 8.0, 0.0), "must be finite"),
    (lambda: WaveTrain(1.0, 8.0, 0.0, depth=0.0), "water depth is 0 m"),
])  # fmt: skip
def test_what_moves_nothing_is_refused_in_a_line(make, says):
    with pytest.raises(ValueError, match=says):
        make()


def test_waves_and_a_current_are_arrays_with_their_numbers_and_what_a_carrier_makes_of_them():
    """Deep water: k = ω²/g; carried by (0.6, −0.8) m/s a line at rest meets ω + k·V"""
    current = CurrentProfile([-50.0, 0.0], [[0.1, 0.2], [0.3, 0.4]])
    waves = WaveTrain([1.0, 2.0], 10.0, [0.0, np.pi / 2], 0.5, carried=(0.6, -0.8))
    found = water_arrays(current, waves, G)
    omega = 2 * np.pi / 10.0
    k = omega**2 / G
    parts = [part.tolist() if isinstance(part, np.ndarray) else part for part in found]
    assert parts[:2] == [[-50.0, 0.0], [[0.1, 0.2], [0.3, 0.4]]] and parts[2] == [1.0, 2.0]
    assert parts[3] == pytest.approx([omega] * 2) and parts[4] == pytest.approx([k] * 2)
    assert np.array(parts[5]) == pytest.approx(np.array([[1.0, 0.0], [0.0, 1.0]]), abs=1e-12) and parts[6] == [0.5, 0.5]
    assert parts[7:9] == [np.inf, 10.0] and parts[-1] == [0.6, -0.8]
    assert parts[-2] == pytest.approx([omega + 0.6 * k, omega - 0.8 * k])
    assert water_arrays(None, None, G) is None
    calm = water_arrays(current, None, G)
    assert all(np.size(part) == 0 for part in calm[2:7]) and calm[7] == np.inf and calm[8] == 0.0
    assert WaveTrain([1.0, 2.0], [8.0, 12.0], 0.0).ramp == 12.0 and WaveTrain(1.0, 8.0, 0.0, ramp=3.0).ramp == 3.0


def checked(**given):
    line = SimpleNamespace(elements=10)
    motion = SimpleNamespace(begin=0.0, end=100.0)
    words = dict(
        line=line, motion=motion, duration=50.0, tolerance=1e-3, longest_step=1.0, frames=0, stations=(), start=None
    )
    simulation._check(**words | given)


START, SHORT = (SimpleNamespace(time=t, position=np.zeros((n, 3))) for t, n in ((50.0, 11), (0.0, 12)))
WINDOW, LATER = SimpleNamespace(begin=50.0, end=100.0), SimpleNamespace(begin=50.1, end=200.0)


@pytest.mark.parametrize("good, bad, says", [
    (dict(duration=100.0), dict(duration=100.1), "end of the run is 100.1; allowed: up to 100 s"),
    (dict(duration=1e-9), dict(duration=0.0), "duration is 0.0"),
    (dict(tolerance=0.1), dict(tolerance=0.11), "tolerance is"),
    (dict(tolerance=1e-9), dict(tolerance=0.0), "tolerance is"),
    (dict(frames=0), dict(frames=-1), "frames is -1"),
    (dict(longest_step=1e-3), dict(longest_step=0.0), "longest_step"),
    (dict(stations=(0, 10)), dict(stations=(11,)), "stations is"),
    (dict(stations=(1,)), dict(stations=(-1,)), "stations is"),
    (dict(start=START), dict(start=START, duration=50.1), "end of the run"),
    (dict(start=START), dict(start=SHORT), "start is another line's"),
    (dict(start=START, motion=WINDOW), dict(start=START, motion=LATER), "start of the run is 50.0; allowed: from 50.1"),
])  # fmt: skip
def test_a_run_is_taken_up_to_its_limits(good, bad, says):
    checked(**good)
    with pytest.raises(ValueError, match=says):
        checked(**bad)


@pytest.mark.parametrize("gap, speed, rest, refused, told", [
    (0.9e-6 * 21, 0.0, True, False, False), (1.1e-6 * 21, 0.0, True, True, False), (0.0, 0.9e-3, True, False, False),
    (0.0, 1.1e-3, True, False, True), (0.0, 5.0, False, False, False),
])  # fmt: skip
def test_a_run_begins_where_the_last_ended_and_from_rest_without_a_jerk(gap, speed, rest, refused, told):
    """A millionth of the largest coordinate and of a metre; a millimetre a second"""
    motion = SimpleNamespace(at=lambda t: (np.array([20.0, 0.0, gap]), np.array([speed, 0.0, 0.0]), None))
    state = SimpleNamespace(time=3.0, position=np.array([[0.0] * 3, [20.0, 0.0, 0.0]]), velocity=np.zeros((2, 3)))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        if refused:
            with pytest.raises(ValueError, match="m from the place where the previous run ended"):
                simulation._check_joint(motion, state, rest)
        else:
            simulation._check_joint(motion, state, rest)
    assert bool(said) == told and (not told or f"starts at {speed:.3g} m/s" in str(said[0].message))


def test_a_fairlead_below_the_bed_is_told_with_how_far(monkeypatch):
    """Lowest half way through a run of 10 s from 5 s"""
    monkeypatch.setattr(simulation, "above_bed", lambda system, places: places[:, 2])
    motion = SimpleNamespace(at=lambda t: (np.array([0.0, 0.0, 2.0 - depth * math.sin(math.pi * (t - 5) / 10)]),))
    line = SimpleNamespace(bed="bed", system=None)
    depth = 1.9
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        simulation._check_above_bed(line, motion, 5.0, 10.0)
    depth = 3.5
    with pytest.warns(UserWarning, match=r"the fairlead goes 1\.5 m below the bed"):
        simulation._check_above_bed(line, motion, 5.0, 10.0)
    simulation._check_above_bed(SimpleNamespace(bed=None), motion, 5.0, 10.0)
