"""Pieces of the memory by hand: which motions have none, sizes of errors, groups, and many systems joined into one."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.time_domain import fewest_states
from hakobune.bem.time_domain import memory as module
from hakobune.bem.time_domain.memory import Memory, memory_of_database, no_memory
from hakobune.bem.time_domain.passive_fit import Passive

RNG = np.random.default_rng(7)


def test_numbers_over_a_scale_are_nothing_where_there_is_none():
    found = module._relative(np.array([[2.0, 3.0]]), np.array([[4.0, 0.0]]))
    assert found.tolist() == [[0.5, 0.0]]


@pytest.mark.parametrize("change, damping, still", [
    (0.9e-3, 0.9e-4, True), (1.1e-3, 0.9e-4, False), (0.9e-3, 1.1e-4, False),
])  # fmt: skip
def test_a_motion_is_still_whose_coefficients_are_nothing_beside_its_inertia(change, damping, still):
    """Added mass changes by less than a thousandth of M + A over the band, B/ω is below a tenth of that"""
    omega = np.array([1.0, 2.0, 4.0])
    A, B = np.zeros((3, 6, 6)), np.zeros((3, 6, 6))
    A[:, range(6), range(6)], B[:, range(6), range(6)] = 100.0, 1.0
    own = 300.0 + 100.0
    A[:, 5, 5] += change * own * np.array([-0.5, 0.0, 0.5])
    B[:, 5, 5] = damping * own * omega * np.array([0.1, 1.0, 0.2])
    body = SimpleNamespace(inertia=np.diag([1.0] * 5 + [300.0]))
    assert module._still(body, omega, A, B).tolist() == [False] * 5 + [still]
    body.inertia[5, 5] = np.nan
    assert not module._still(body, omega, A, B).any()
    assert module._still(SimpleNamespace(inertia=None), omega, A, B).tolist() == [False] * 6


def test_motions_that_are_coupled_through_others_are_one_group():
    coupled = np.eye(6, dtype=bool)
    for i, j in ((0, 4), (4, 2), (1, 3)):
        coupled[i, j] = coupled[j, i] = True
    coupled[5, 5] = False
    assert module._groups(coupled) == ((0, 2, 4), (1, 3))
    assert module._groups(np.zeros((6, 6), bool)) == ()


def test_two_planes_of_a_round_body_have_one_system_but_for_signs(monkeypatch):
    """Surge and pitch, sway and roll: their coupling has opposite signs; another body is fitted in both planes"""
    wanted = RNG.normal(size=(5, 6, 6)) + 1j * RNG.normal(size=(5, 6, 6))
    for i, j, sign in ((1, 1, 1), (1, 3, -1), (3, 1, -1), (3, 3, 1)):
        wanted[:, i, j] = sign * wanted[:, {1: 0, 3: 4}[i], {1: 0, 3: 4}[j]]
    asked = []

    def fitted(omega, own, size, group, *_):
        asked.append(group)
        into, out = np.arange(6.0).reshape(2, 3) + len(asked), np.ones((2, 3))
        return Passive(np.zeros(3), np.zeros(0), into, out, np.eye(3), np.eye(3, 2))

    monkeypatch.setattr(module, "fewest_states", fitted)
    groups, omega, equal = ((0, 4), (1, 3), (2,)), np.arange(5.0), np.ones((5, 6))
    one, other, _ = module._parts(omega, wanted, np.ones(6), groups, [1e-3] * 3, equal, ())
    assert asked == [(0, 4), (2,)]
    assert other.input.tolist() == [one.input[0].tolist(), (-one.input[1]).tolist()]
    assert other.output.tolist() == [[1.0] * 3, [-1.0] * 3] and other.storage is one.storage
    for change in ("transform", "sensitivity"):
        asked.clear()
        unlike, felt = wanted.copy(), equal.copy()
        (unlike[:, 3, 3] if change == "transform" else felt[:, 3])[:] *= 1.001
        module._parts(omega, unlike, np.ones(6), groups, [1e-3] * 3, felt, ())
        assert asked == [(0, 4), (1, 3), (2,)]


def test_motions_are_fitted_as_near_as_their_own_data_agree(monkeypatch):
    """A thirtieth of the largest deviation of a group where that is above the tolerance; other groups keep it"""
    deviation = np.zeros((6, 6))
    deviation[0, 4], deviation[2, 2], deviation[1, 2] = 0.06, 0.003, 0.5
    goal = (
        None,
        SimpleNamespace(added_mass_infinity=None),
        np.ones(5),
        np.ones((5, 6, 6)),
        np.ones(6),
        np.ones((6, 6)),
    )
    goal = module._Goal((0.5, 2.0), *goal[1:], deviation, None)
    asked, body = [], SimpleNamespace(words=(), rigid=(), between=SimpleNamespace(span=(0.5, 2.0)))
    monkeypatch.setattr(module, "_check_deviation", lambda *_: None)
    monkeypatch.setattr(module, "_tell_neglected", lambda *_: None)
    monkeypatch.setattr(module, "_ringing", lambda body: "")
    monkeypatch.setattr(module, "sensitivity", lambda *_: np.ones((5, 6)))
    monkeypatch.setattr(module, "_groups", lambda coupled: ((0, 4), (2,)))
    monkeypatch.setattr(module, "_parts", lambda at, wanted, size, groups, near, *_: asked.extend(near))
    monkeypatch.setattr(module, "_joined", lambda *_: (None, None, None))
    monkeypatch.setattr(module, "_transfer", lambda arrays, at: np.ones((5, 6, 6)))
    module._memory(body, 3e-4, goal)
    assert asked == pytest.approx([0.002, 3e-4])


def test_memory_is_fitted_from_a_thirtieth_of_the_band_to_eight_times_it():
    taken = module._frequencies(SimpleNamespace(between=lambda at: at), (0.3, 2.0))
    assert len(taken) == 19 + 150 + 24 and np.all(np.diff(taken) > 0)
    assert taken[[0, 19, 168, -1]] == pytest.approx([0.01, 0.3, 2.0, 16.0])
    ratio = taken[1:20] / taken[:19]
    assert ratio == pytest.approx(np.full(19, 30 ** (1 / 19)))


def test_deviations_count_by_the_largest_or_by_a_twentieth_of_inertia():
    """|made − B − iω(A∞ − A)| at the middles, over √ of the scales or 0.05 ω √(M + A)(M + A) where that is more"""
    omega = np.linspace(1.0, 3.0, 41)
    A, B = np.ones((41, 2, 2)) * np.array([[4.0, 0], [0, 9.0]]), np.ones((41, 2, 2)) * np.array([[2.0, 0], [0, 3.0]])
    axis = SimpleNamespace(added_mass_infinity=np.diag([5.0, 9.0]))
    axis.transform = lambda at: np.array([[2.0, 0.1], [0.0, 3.0]]) + 1j * at[:, None, None] * np.diag([1.0, 0.0])
    middles = 0.5 * (omega[1:] + omega[:-1])[2:-2:8]
    inertia = np.diag([32.0, 16.0])
    for scale, size in ((100.0, lambda w: np.full(len(w), 100.0)), (0.01, lambda w: 0.05 * w * 6 * 5)):
        found = module._deviation(axis, omega, A, B, np.full((2, 2), scale), inertia)
        assert found[0, 1] == pytest.approx((0.1 / size(middles)).max()) and found[0, 0] == pytest.approx(
            0.0, abs=1e-12
        )
    zero = np.array([[0.01, 0.0], [0.0, 0.0]])
    assert module._deviation(axis, omega, A, B, zero, inertia)[0, 1] == 0.0
    unknown = module._deviation(axis, omega, A, B, np.full((2, 2), 2.0), np.full((2, 2), np.nan))
    assert unknown[0, 1] == pytest.approx(0.05)


def part(real, pairs, motions):
    """A `Passive` of made-up numbers"""
    n = real + 2 * pairs
    return SimpleNamespace(
        decay=RNG.uniform(0.1, 1.0, real).tolist() + np.tile(RNG.uniform(0.1, 1.0, pairs), 2).tolist(),
        turn=RNG.uniform(1, 2, pairs), input=RNG.normal(size=(motions, n)), output=RNG.normal(size=(motions, n)),
        storage=RNG.normal(size=(n, n)), loss=RNG.normal(size=(n, motions)),
    )  # fmt: skip


def joined():
    groups, size = ((0, 4), (1,), (2, 3, 5)), np.array([2.0, 3.0, 5.0, 7.0, 11.0, 13.0])
    parts = [part(1, 2, 2), part(2, 0, 1), part(0, 1, 3)]
    return groups, size, parts, module._joined(parts, groups, size)


def test_systems_of_groups_side_by_side_answer_as_each_by_itself():
    """c (iω − a)⁻¹ b of each in its own units, what is stored and lost added up"""
    groups, size, parts, (arrays, storage, loss) = joined()
    assert len(arrays.decay) == 5 + 2 + 2 and len(arrays.turn) == 3
    none = np.zeros((6, 6))
    whole = Memory(arrays, storage, loss, none, none, none, (0.1, 1.0), groups)
    a, b, c = whole.matrices
    omega = np.array([0.3, 1.2])
    made = np.array([c @ np.linalg.solve(1j * w * np.eye(9) - a, b) for w in omega])
    true = np.zeros((2, 6, 6), complex)
    for one, group in zip(parts, groups, strict=True):
        n, p = len(one.decay), len(one.turn)
        own = -np.diag(one.decay)
        for i in range(p):
            k = n - 2 * p + i
            own[k, k + p], own[k + p, k] = one.turn[i], -one.turn[i]
        units = size[list(group)]
        for w, out in zip(omega, true, strict=True):
            out[np.ix_(group, group)] = (
                units[:, None] * (one.output @ np.linalg.solve(1j * w * np.eye(n) - own, one.input.T)) * units
            )
    assert made == pytest.approx(true) and module._transfer(arrays, omega) == pytest.approx(true)
    assert whole.transform(omega) == pytest.approx(true.conj())
    states = RNG.normal(size=(4, 9))
    assert whole.stored_energy(states) == pytest.approx(0.5 * np.einsum("si,ij,sj->s", states, storage, states))
    assert whole.lost_power(states) == pytest.approx(0.5 * np.sum((states @ loss) ** 2, axis=1))
    assert loss.shape == (9, 6) and np.count_nonzero(loss) == 5 * 2 + 2 * 1 + 2 * 3
    assert np.count_nonzero(storage) == 25 + 4 + 4
    velocity = RNG.normal(size=6)
    assert whole.rate(states[0], velocity) == pytest.approx(a @ states[0] + b @ velocity)
    assert whole.force(states[0]) == pytest.approx(c @ states[0])
    from scipy.linalg import expm

    assert whole.retardation([0.0, 0.7])[1] == pytest.approx(c @ expm(0.7 * a) @ b)
    assert repr(whole).startswith("<Memory 9 states (surge, pitch; sway; heave, roll, yaw), error 0.0e+00>")


def test_states_are_those_that_decay_then_first_and_second_of_pairs():
    _, _, parts, (arrays, *_) = joined()
    alone, pairs = [part.decay[: len(part.decay) - 2 * len(part.turn)] for part in parts], [part.turn for part in parts]
    assert arrays.decay[:3] == pytest.approx(np.concatenate(alone)) and arrays.turn == pytest.approx(
        np.concatenate(pairs)
    )
    assert arrays.decay[3:6] == pytest.approx(arrays.decay[6:])


def test_a_run_at_one_frequency_has_no_states_and_the_added_mass_of_the_highest():
    body = SimpleNamespace(between=SimpleNamespace(span=(0.2, 1.5)), words=tuple("abcdef"),
                           coefficients=lambda omega: (omega[:, None, None] * np.eye(6), None))  # fmt: skip
    found = no_memory(body)
    assert found.states == 0 and found.added_mass_infinity == pytest.approx(1.5 * np.eye(6))
    assert found.band == (0.2, 1.5) and found.force(np.zeros(0)).tolist() == [0.0] * 6
    assert found.transform([1.0]).shape == (1, 6, 6) and not found.transform([1.0]).any()


@pytest.mark.parametrize("tolerance", [0.99e-5, 0.101])
def test_a_tolerance_lies_between_a_hundred_thousandth_and_a_tenth(tolerance):
    with pytest.raises(
        ValueError, match=r"tolerance of the memory of the water \(retardation functions\) is .*; allowed: 1e-5 to 0.1"
    ):
        memory_of_database(None, tolerance)


def test_water_that_rings_is_told_what_helps():
    rings = SimpleNamespace(between=SimpleNamespace(ringing=[1.0]))
    assert module._ringing(rings) == "; give [[damping_lids]] to the moonpool or gap with resonant water"
    assert module._ringing(SimpleNamespace(between=SimpleNamespace(ringing=[]))) == ""


def fit_now(*asked):
    """Fit of a group of motions, not one that is kept"""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(fewest_states, "kept_fit", lambda source, make, *arrays: make())
        return fewest_states.fewest_states(*asked)


def test_a_memory_that_no_system_meets_is_told_with_its_best(monkeypatch):
    """A transform without causality: white noise over the frequencies"""
    monkeypatch.setattr(fewest_states, "POLES", (8,))
    omega = np.linspace(0.1, 2.0, 40)
    wanted = RNG.normal(size=(40, 1, 1)) + 1j * RNG.normal(size=(40, 1, 1))
    with pytest.raises(
        ValueError, match=r"the memory of the water in b has an error of .*, and the tolerance is 1e-05; give a larger"
    ):
        fit_now(omega, wanted, np.ones(1), (1,), 1e-5, np.zeros((40, 1)), ("a", "b"))


def test_the_best_of_what_was_tried_is_told(monkeypatch):
    """Poles that miss, and states of those that do not: 0.2, then 0.15 of a passive fit"""
    offs = iter([0.5, 0.2, 0.3])
    monkeypatch.setattr(fewest_states, "fitted", lambda s, wanted, poles, weight: (None, next(offs)))
    wanted, none = np.ones((4, 1, 1), complex), np.zeros((4, 1))
    with pytest.raises(
        ValueError,
        match=r"the memory of the water in sway has an error of 0\.2 with the best system that was tried, and the",
    ) as one:
        fit_now(np.arange(1.0, 5), wanted, np.ones(1), (1,), 0.01, none, ("surge", "sway"))
    assert str(one.value).startswith("the memory of the water in sway") and str(one.value).endswith(
        "to a smaller tolerance"
    )
    assert one.value.within == pytest.approx(0.2 / 8)  # beyond eight times a tolerance no modes are moved
    offs, many = iter([0.5, 0.2, 0.3]), np.ones((4, 4, 4), complex)
    with pytest.raises(fewest_states.FitError) as one:
        fit_now(np.arange(1.0, 5), many, np.ones(4), (0, 1, 2, 3), 0.01, np.zeros((4, 4)), "abcd")
    assert one.value.within == pytest.approx(0.1)  # of four motions none are moved at all
    tried = []

    class Whole:
        values = np.array([1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.005])

        def reduced(self, states):
            tried.append(states)
            return "a", "b", None

    monkeypatch.setattr(fewest_states, "fitted", lambda s, wanted, poles, weight: (None, 0.001))
    monkeypatch.setattr(fewest_states, "balanced", lambda system: Whole())
    errors = {6: 0.15, 7: 0.3}
    monkeypatch.setattr(fewest_states, "passive_fit", lambda a, b, s, H, most, weight: (most, errors[tried[-1]]))
    monkeypatch.setattr(fewest_states, "POLES", (8,))
    with pytest.raises(ValueError, match=r"an error of 0\.15 with"):
        fit_now(np.arange(1.0, 5), wanted, np.ones(1), (1,), 0.01, none, ("surge", "sway"))
    assert tried == [6, 7]  # as many as values above the tolerance, and more
    errors[7] = 0.01
    assert fit_now(np.arange(1.0, 5), wanted, np.ones(1), (1,), 0.01, none, ("a", "b")) == pytest.approx(0.0099)


def test_more_states_are_not_tried_where_six_fits_in_a_row_came_no_nearer(monkeypatch):
    """Of each number of poles: errors fall for three fits, then stay; outputs without a passive fit do not count"""
    tried, values = [], np.geomspace(1.0, 1e-3, 60)

    class Whole:
        def __init__(self):
            self.values = values

        def reduced(self, states):
            tried.append(states)
            return "a", "b", None

    errors = {30: (None, 0.9), 31: ("made", 0.4), 32: ("made", 0.3), 33: ("made", 0.2)}
    monkeypatch.setattr(fewest_states, "fitted", lambda s, wanted, poles, weight: (None, 1e-3))
    monkeypatch.setattr(fewest_states, "balanced", lambda system: Whole())
    monkeypatch.setattr(fewest_states, "passive_fit", lambda *_: errors.get(tried[-1], ("made", 0.25)))
    monkeypatch.setattr(fewest_states, "POLES", (8, 9))
    wanted = np.ones((4, 1, 1), complex)
    fewest = int(np.sum(values > 0.03))
    assert fewest == 30
    with pytest.raises(fewest_states.FitError, match=r"an error of 0\.2 with the best"):
        fit_now(np.arange(1.0, 5), wanted, np.ones(1), (0,), 0.03, np.zeros((4, 1)), ("surge",))
    assert tried == 2 * list(range(30, 34 + fewest_states.PATIENCE))


def test_what_is_fitted_is_the_conjugate_transform_in_units_of_each_motion(monkeypatch):
    """exp(iωt) of the fit for exp(−iωt) of the database; weights grow with the number of motions and what they answer,
    up to eight times, and for more than three motions not at all"""
    heard = []

    class Done(Exception):
        pass

    def taken(s, wanted, poles, weight):
        heard.append((s, wanted, poles, weight))
        raise Done

    monkeypatch.setattr(fewest_states, "fitted", taken)
    omega, size = np.array([0.5, 1.0]), np.array([2.0, 5.0])
    wanted = np.array([[[1 + 2j, 3j], [3j, 4 - 1j]], [[2.0, 1], [1, 5j]]])
    answered = np.array([[0.1, 1.0], [3.0, 0.3]])
    with pytest.raises(Done):
        fit_now(omega, wanted, size, (0, 1), 0.01, answered, "ab")
    s, given, poles, weight = heard[0]
    assert s == pytest.approx(1j * omega) and poles == 32
    assert given == pytest.approx(wanted.conj() / [[4.0, 10], [10, 25]])
    nearer = np.sqrt(np.clip(2.0 * 2 * answered, 1.0, 8.0))
    assert weight == pytest.approx(nearer[:, :, None] * nearer[:, None])
    with pytest.raises(Done):
        fit_now(omega, np.ones((2, 4, 4)), np.ones(4), (0, 1, 2, 3), 0.01, np.full((2, 4), 9.0), "abcd")
    assert np.array_equal(heard[1][3], np.ones((2, 4, 4)))
    heard.clear()
    monkeypatch.setattr(fewest_states, "fitted", lambda *given: heard.append(given) or (None, 1.0))
    with pytest.raises(fewest_states.FitError):
        fit_now(omega, wanted, size, (0, 1), 0.01, answered, "ab")
    assert [poles for _, _, poles, _ in heard] == [32, 48, 64] * 3
    for one, power in zip(heard[::3], (1.0, 0.5, 0.0), strict=True):  # nearer less and less, and then not at all
        assert one[3] == pytest.approx(weight**power)


def test_each_group_is_fitted_to_its_own_tolerance_with_its_own_part_of_the_transform(monkeypatch):
    wanted, asked = RNG.normal(size=(5, 6, 6)) + 1j * RNG.normal(size=(5, 6, 6)), []
    answered, size, omega = RNG.normal(size=(5, 6)), np.arange(1.0, 7), np.arange(5.0)
    monkeypatch.setattr(module, "fewest_states", lambda *given: asked.append(given))
    groups, near = ((0, 4), (1, 3), (2,)), [1e-3, 2e-3, 3e-3]
    module._parts(omega, wanted, size, groups, near, answered, "words")
    for given, group, tolerance in zip(asked, groups, near, strict=True):
        own = list(group)
        assert given[0] is omega and given[3] == group and given[4] == tolerance and given[6] == "words"
        assert np.array_equal(given[1], wanted[:, own][:, :, own]) and given[2].tolist() == (size[own]).tolist()
        assert np.array_equal(given[5], answered[:, own])


@pytest.mark.parametrize("share, same", [(0.9e-7, True), (1.1e-7, False)])
def test_a_transform_is_another_one_but_for_signs_within_a_ten_millionth_of_its_motions(share, same):
    """√(ii · jj) of the largest of the first; the sign of each motion beside the first"""
    one = np.zeros((3, 2, 2), complex)
    one[:, 0, 0], one[:, 1, 1], one[:, 0, 1] = [1e6, 4e6, 2e6], [3e10, 1e10, 9e10], [1e8j, 2e8, 3e8]
    one[:, 1, 0] = one[:, 0, 1]
    other = one * np.array([[1, -1], [-1, 1]])
    assert module._signs(one, other).tolist() == [[1.0], [-1.0]] and module._signs(one, one).tolist() == [[1.0], [1.0]]
    other[1, 0, 1] += share * np.sqrt(4e6 * 9e10)
    assert (module._signs(one, other) is not None) is same
    assert module._signs(one, other[:, :1, :1]) is None


def test_nothing_to_fit_is_a_memory_without_states():
    arrays, storage, loss = module._joined([], (), np.ones(6))
    assert arrays.decay.shape == (0,) and arrays.turn.shape == (0,) and arrays.input.shape == (6, 0)
    assert storage.shape == (0, 0) and loss.shape == (0, 0)
