"""Which band a memory is fitted to, what is fitted, and what is handed on: each step with made-up numbers around it."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.time_domain import memory as module

BODY = SimpleNamespace(
    words=("surge", "sway", "heave", "roll", "pitch", "yaw"),
    rigid=6,
    omega=np.linspace(0.5, 2.0, 8),
    between=SimpleNamespace(span=(0.5, 2.0), ringing=()),
)


def goal(worst, band=(0.5, 2.0), at=(0.4, 0.6, 1.9, 2.1), **more):
    """A `_Goal` of which one motion deviates and the others agree"""
    deviation = np.zeros((6, 6))
    deviation[2, 2] = worst
    axis = SimpleNamespace(added_mass_infinity=7 * np.eye(6))
    wanted = more.pop("wanted", np.ones((len(at), 6, 6), complex))
    scale = more.pop("scale", np.ones((6, 6)))
    return module._Goal(band, axis, np.array(at), wanted, np.sqrt(np.diag(scale)), scale, deviation, None)


@pytest.fixture
def asked(monkeypatch):
    """What is asked for, by name; each of the others answers with nothing"""
    heard = {}
    monkeypatch.setattr(module, "_check_deviation", lambda *given: heard.update(check=given))
    monkeypatch.setattr(module, "sensitivity", lambda *given: heard.update(felt=given) or np.ones((4, 6)))
    monkeypatch.setattr(module, "_parts", lambda *given: heard.update(parts=given) or "parts")
    monkeypatch.setattr(module, "_joined", lambda *given: heard.update(joined=given) or ("arrays", "stored", "lost"))
    monkeypatch.setattr(module, "_transfer", lambda arrays, at: np.full((4, 6, 6), 1.5 + 0.5j))
    return heard


@pytest.mark.parametrize("whole, shorter, steps", [
    (0.0299, 0.0, []), (0.0301, 0.0299, ["shorter"]), (0.5, 0.0999, ["shorter"]),
    (0.5, 0.1001, ["shorter", "causality"]),
])  # fmt: skip
def test_a_band_is_cut_where_one_motion_deviates_and_the_stored_limit_goes_where_that_does_not_help(
    monkeypatch, asked, whole, shorter, steps
):
    """The largest of all, 3 and 10 %, whatever the rest does; the next step has what the last one found"""
    taken = []
    goals = {"first": goal(whole), "shorter": goal(shorter, (0.5, 1.4)), "causality": goal(0.02, (0.5, 1.7))}

    def begun(body, band, motions):
        assert (body, band, motions) == (BODY, (0.5, 2.0), range(6))
        return goals["first"]

    def step(name, before):
        def taken_up(body, found, motions):
            assert (body, motions) == (BODY, range(6)) and found is goals[before]
            taken.append(name)
            return goals[name]

        return taken_up

    monkeypatch.setattr(module, "_goal", begun)
    monkeypatch.setattr(module, "_shorter", step("shorter", "first"))
    monkeypatch.setattr(module, "_by_causality", step("causality", "shorter"))
    found = module._memory(BODY, 1e-3, module.goal_of_database(BODY))
    last = goals[[*["first"], *steps][-1]]
    assert taken == steps and found.band == last.band and found.deviation is last.deviation
    assert asked["check"] == (last.deviation, last.band, None, last.size, BODY.words, "")


@pytest.mark.parametrize(("off", "strong", "weak", "told_of"), [(0.0299, 1.01e-4, 0.99e-4, 0), (0.06, 0.061, 0.059, 1)])
def test_a_fit_has_its_groups_tolerances_and_answers_and_tells_the_largest_error(
    monkeypatch, asked, recwarn, off, strong, weak, told_of
):
    """Motions are coupled by more than a tenth of the tolerance of √(ii · jj), or by more than numbers that contradict
    each other by 3 % and more do; no answer counts outside the band"""
    scale, wanted = np.outer(np.arange(1, 7.0), np.arange(1, 7.0)), np.zeros((4, 6, 6), complex)
    wanted[2, range(6), range(6)] = np.diag(scale)
    wanted[1, 0, 4] = wanted[1, 4, 0] = strong * scale[0, 4]
    wanted[1, 1, 3] = wanted[1, 3, 1] = weak * scale[1, 3]
    one = goal(off, wanted=wanted, scale=scale)
    found = module._memory(BODY, 1e-3, one)
    groups = ((0, 4), (1,), (2,), (3,), (5,))
    at, given, size, told, near, answered, words = asked["parts"]
    assert told == groups and words is BODY.words and given is wanted and at is one.at and size is one.size
    assert near == pytest.approx([1e-3, 1e-3, max(1e-3, off / 30), 1e-3, 1e-3])  # of heave
    assert answered.tolist() == [[0.0] * 6, [1.0] * 6, [1.0] * 6, [0.0] * 6]
    assert asked["felt"][1:] == (one.at, wanted, one.axis.added_mass_infinity, one.size, 6)
    assert asked["joined"] == ("parts", groups, one.size)
    error = np.abs(1.5 + 0.5j - wanted).max(axis=0) / scale
    if told_of:
        error[1, 3] = error[3, 1] = 0.0
    said = [str(one.message) for one in recwarn]
    assert len(said) == told_of and all("couplings of up to 0.059 of the largest" in one for one in said)
    assert found.error == pytest.approx(error) and found.groups == groups
    assert (found.arrays, found.storage, found.loss) == ("arrays", "stored", "lost")
    assert found.added_mass_infinity is one.axis.added_mass_infinity and found.words is BODY.words


def test_ends_of_the_band_are_inside_it(monkeypatch, asked):
    one = goal(0.0, at=(0.5, 0.6, 1.9, 2.0))
    module._memory(BODY, 1e-3, one)
    assert asked["parts"][5].all()


def test_shorter_bands_are_tried_until_one_agrees_or_the_best_is_taken(monkeypatch):
    """0.9, 0.8 … 0.5 of its width, from its lower end"""
    tried = []

    def made(offs):
        left = iter(offs)

        def one(body, band, motions, stored=True):
            tried.append((round(band[1], 9), stored))
            return goal(next(left), band)

        return one

    monkeypatch.setattr(module, "_goal", made([0.2, 0.0299, 0.0]))
    with pytest.warns(UserWarning, match=r"above 1\.7 rad/s contradict those at lower frequencies by 0\.27 of the "
                                         r"largest, recommended: 0\.03; the memory of the water uses"):  # fmt: skip
        assert module._shorter(BODY, goal(0.27), range(6)).band == pytest.approx((0.5, 1.7))
    assert tried == [(1.85, True), (1.7, True)]
    tried.clear()
    monkeypatch.setattr(module, "_goal", made([0.2, 0.08, 0.031, 0.09, 0.05]))
    with pytest.warns(UserWarning, match=r"above 1\.55 rad/s"):
        assert module._shorter(BODY, goal(0.27), range(6), False).band == pytest.approx((0.5, 1.55))
    assert tried == [(1.85, False), (1.7, False), (1.55, False), (1.4, False), (1.25, False)]


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("whole, parts", [(0.05, 0.06), (0.3, 0.101)])
def test_nothing_is_said_of_a_band_that_stays_or_is_refused(monkeypatch, whole, parts):
    monkeypatch.setattr(module, "_goal", lambda body, band, motions, stored: goal(parts, band))
    found = module._shorter(BODY, goal(whole), range(6))
    assert found.deviation.max() == min(whole, parts)


class Coefficients:
    """A body whose matrices are not quite symmetric, and whose yaw is still"""

    words, bodies = BODY.words, ()
    turning = np.array([False] * 3 + [True] * 3)
    inertia = np.diag([10.0, 10, 10, 40, 40, 1e6])

    def __init__(self):
        self.asked = []

    def coefficients(self, omega, motions):
        self.asked.append((omega, motions))
        A = np.zeros((len(omega), 6, 6))
        A[:, range(6), range(6)] = 5.0 + omega[:, None] * [1, 1, 1, 1, 1, 1e-6]
        A[:, 0, 4] = 2.0
        B = np.zeros((len(omega), 6, 6))
        B[:, range(6), range(6)] = np.array([1, 2, 3, 4, 5, 1e-6])
        B[:, 0, 4], B[:, 4, 0] = 0.2, 0.4
        return A, B


@pytest.mark.parametrize("stored", [True, False])
def test_what_is_fitted_is_symmetric_and_without_motions_that_are_still(monkeypatch, stored):
    """A stored A(∞) of those that are still is the mean over the band; sizes are roots of the largest transform, 0
    below 1e-4 of the largest of their kind"""
    body, heard = Coefficients(), {}
    axis = SimpleNamespace(added_mass_infinity=np.eye(6))
    sizes = np.array([4.0, 0.99e-8 * 9, 9.0, 16.0, 1.01e-8 * 25, 25.0])

    def transform(at):
        return np.multiply.outer(np.where(np.arange(len(at)) == 3, -1.0, 0.5), np.diag(sizes)) + 0j

    axis.transform = transform

    def whole(omega, added_mass, damping, limit, monopole):
        heard.update(omega=omega, A=added_mass, B=damping, limit=limit, monopole=monopole)
        return axis

    monkeypatch.setattr(module, "whole_axis", whole)
    monkeypatch.setattr(module, "ends_of", lambda body, moving: heard.update(moving=moving) or (3 * np.eye(6), "waves"))
    monkeypatch.setattr(module, "_frequencies", lambda axis, band: np.linspace(0.1, 4.0, 7))
    monkeypatch.setattr(module, "_deviation", lambda *given: given)
    found = module._goal(body, (0.5, 2.0), [0, 1, 2, 4, 5], stored)
    omega = np.linspace(0.5, 2.0, 800)
    assert body.asked[0][0] == pytest.approx(omega) and body.asked[0][1] == [0, 1, 2, 4, 5]
    assert heard["moving"] == [0, 1, 2, 4] and heard["monopole"] == "waves" and heard["omega"] == pytest.approx(omega)
    assert heard["A"][:, 0, 4].tolist() == heard["A"][:, 4, 0].tolist() == [1.0] * 800
    B = np.diag([1.0, 2, 3, 4, 5, 0])
    B[0, 4] = B[4, 0] = 0.3
    assert heard["B"] == pytest.approx(np.tile(B, (800, 1, 1)))
    if stored:
        assert heard["limit"] == pytest.approx(np.diag([3, 3, 3, 3, 3, 5 + 1e-6 * 1.25]))
    else:
        assert heard["limit"] is None
    assert found.size == pytest.approx(np.sqrt([4.0, 0, 9.0, 16.0, 1.01e-8 * 25, 0]))
    assert found.scale == pytest.approx(np.outer(found.size, found.size)) and found.band == (0.5, 2.0)
    assert found.transform == pytest.approx(transform(np.arange(7)))
    deviation_of = found.deviation
    assert deviation_of[0] is axis and deviation_of[1] is heard["omega"] and deviation_of[4] is found.scale
    assert np.array_equal(deviation_of[5], body.inertia) and found.damping is deviation_of[3] is heard["B"]
    body.inertia = None
    assert not module._goal(body, (0.5, 2.0), range(6)).deviation[5].any()


@pytest.mark.parametrize("pair, words", [
    ((0, 4), r"\(surge–pitch\); .* damping of surge is 0\.25 of the largest at the lower end and 0\.5 at the upper"),
    ((4, 2), r"\(pitch–heave\); .* damping of pitch is 0\.1 of the largest at the lower end and 0\.2 at the upper"),
    ((5, 2), r"\(yaw–heave\); .* damping of yaw is 0 of the largest at the lower end and 0 at the upper"),
])  # fmt: skip
def test_damping_at_both_ends_is_told_over_the_largest_of_its_own_motion(pair, words):
    size = np.sqrt([4.0, 1, 1, 1, 10, 0])
    damping = np.stack([np.diag([1.0, 1, 1, 1, 1, 3]), np.diag([2.0, 1, 1, 1, 2, 3])])
    deviation = np.zeros((6, 6))
    deviation[pair] = 0.2
    with pytest.raises(ValueError, match=words):
        module._check_deviation(deviation, (0.2, 1.5), damping, size, BODY.words)
