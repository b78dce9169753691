"""The best designs of a breakwater where tension and height behind are known functions of what varies."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.studies.breakwater import pareto
from hakobune.mooring.studies.breakwater.breakwater import BreakwaterError
from hakobune.pipelines.breakwater import findings


def front(samples=8, limits=3, **ranges):
    return pareto.front(None, ranges, samples, limits)


def known(monkeypatch, of, asked):
    """The `Front` where objectives are `of`; appends (values, few) of every call to asked"""

    def objectives(changed, values, few):
        asked.append((dict(values), few))
        return of(values)

    monkeypatch.setattr(pareto, "objectives", objectives)


def test_the_front_has_what_no_other_design_beats(monkeypatch):
    """Tension rises with draft and with width off 10 m, which gains nothing: every design of the front is 10 m wide"""
    asked = []
    known(monkeypatch, lambda v: (1e3 * v["draft"] * (1 + (v["width"] - 10) ** 2), 1 / v["draft"]), asked)
    found = front(samples=16, limits=4, draft=(4.0, 6.0), width=(8.0, 12.0))
    assert set(found.names) == {"draft", "width"}
    at = {name: found.designs[:, i] for i, name in enumerate(found.names)}
    assert found.tension == pytest.approx(1e3 * at["draft"] * (1 + (at["width"] - 10) ** 2))
    assert found.behind == pytest.approx(1 / at["draft"])
    assert np.all(np.diff(found.tension) > 0) and np.all(np.diff(found.behind) < 0)
    assert np.all((at["draft"] >= 4) & (at["draft"] <= 6)) and np.median(abs(at["width"] - 10)) < 0.1
    tried = {tuple(values.values()) for values, few in asked if few}
    assert found.trials == len(tried) >= 16 and len([1 for _, few in asked if few]) == len(tried)  # each once
    for values in tried:  # nothing that was tried is better in both
        tension, behind = 1e3 * values[0] * (1 + (values[1] - 10) ** 2), 1 / values[0]
        assert not np.any((tension < found.tension * (1 - 1e-9)) & (behind < found.behind * (1 - 1e-9)))
    whole = [values for values, few in asked if not few]
    assert len(whole) >= len(found.designs)


def test_every_sample_is_tried_before_the_best_are_refined(monkeypatch):
    """Sobol's points in one direction: of eight, one in each eighth of the range"""
    asked = []
    known(monkeypatch, lambda v: (v["draft"], 1.0), asked)
    found = front(draft=(4.0, 8.0))
    first = np.sort([values["draft"] for values, _ in asked[:8]])
    assert np.floor((first - 4) / 0.5).tolist() == list(range(8))
    assert len(found.tension) == 1 and found.tension[0] == min(values["draft"] for values, few in asked if few)


def test_designs_that_do_not_hold_are_left_out_and_none_is_refused(monkeypatch):
    known(monkeypatch, lambda v: None if v["draft"] < 6 else (v["draft"], 1 / v["draft"]), [])
    found = front(draft=(4.0, 8.0))
    assert found.designs.min() >= 6 and found.designs.max() == pytest.approx(8.0, abs=0.1)
    known(monkeypatch, lambda v: None, [])
    with pytest.raises(BreakwaterError, match="none of 8 designs keeps its lines taut; give other ranges"):
        front(draft=(4.0, 8.0))


@pytest.mark.parametrize("one, other, better", [
    ((1, 1), (2, 2), True), ((1, 2), (1, 3), True), ((1, 2), (2, 2), True), ((1, 2), (1, 2), False),
    ((1, 3), (2, 2), False), ((2, 1), (1, 1), False),
])  # fmt: skip
def test_a_design_is_better_where_it_is_worse_in_neither(one, other, better):
    assert pareto._better(one, other) is better


@pytest.mark.parametrize("holding, width, draft", [("free", 6.0, 3.0), ("taut", 8.0, 5.0), ("fixed", 8.0, 5.0)])
@pytest.mark.parametrize("given, taken", [(None, 0.75), (0.2, 0.2)])
def test_the_keel_that_loses_head_is_that_of_the_body_as_it_floats(monkeypatch, holding, width, draft, given, taken):
    """Without lines it floats higher and narrower; amplitudes are half the waves' height where none is given"""
    from hakobune.mooring.studies.breakwater import curves

    monkeypatch.setattr(curves, "with_loss", lambda made, *others: (made, *others))
    held, afloat = (SimpleNamespace(waterline=w, draft=d) for w, d in ((8.0, 5.0), (6.0, 3.0)))
    water, waves = SimpleNamespace(gravity=9.8), SimpleNamespace(height=1.5)
    body = SimpleNamespace(water=water, loss=1.5, waves=waves, loses_exactly=False, depth=lambda rise: 10.0 + rise,
                           mirrored=lambda one: one,
                           wetted=lambda rise: held, afloat=lambda rise: (None, afloat))  # fmt: skip
    made, coefficient, amplitude, omega, keel = curves._with_loss(body, "made", holding, 1.0, "omega", given)
    assert (made, coefficient, amplitude, omega) == ("made", 1.5, taken, "omega")
    assert tuple(keel) == (width / 2, draft, 11.0, 9.8)
    body.loses_exactly = True
    assert curves._with_loss(body, "made", holding, 1.0, "omega", given) == "made"
    body.loss, body.loses_exactly = None, False
    assert curves._with_loss(body, "made", holding, 1.0, "omega", given) == "made"


@pytest.mark.parametrize("wanted, says", [
    (0.5, ["for waves of 0.5 or less behind the breakwater, the least tension is 20 kN/m: draft 5.5, width 10"]),
    (0.3, ["for waves of 0.3 or less behind the breakwater, the least tension is 30 kN/m: draft 6, width "
           "12"]), (0.29, []), (None, []),
])  # fmt: skip
def test_the_least_tension_that_leaves_no_more_behind_than_wanted_is_told(wanted, says):
    designs = np.array([[5.0, 8.0], [5.5, 10.0], [6.0, 12.0]])
    found = pareto.Front(("draft", "width"), designs, np.array([1e4, 2e4, 3e4]), np.array([0.9, 0.5, 0.3]), 9)
    assert list(findings.wanted(SimpleNamespace(behind=wanted), found)) == says


def test_every_anchor_that_is_too_small_is_told_and_designs_that_all_leave_too_much():
    """Provided over needed: 100 % is enough, by definition; behind, what is wanted itself is enough"""
    ends = (("front", 1.2e5, 1e5), ("back", 1e5, 1e5), ("all", 1.1e5, 1e5), ("unknown", 5e3, None))
    anchors = [
        SimpleNamespace(name=name, needed=need, provided=got, unit="N", utilisation=None if got is None else need / got)
        for name, need, got in ends
    ]
    front = SimpleNamespace(behind=np.array([0.9, 0.5]))
    found = SimpleNamespace(pretension=None, sea=None, anchors=anchors, front=front)
    for behind, worse in ((0.49, True), (0.5, False)):
        said = list(findings.failures(SimpleNamespace(behind=behind), found))
        assert said[:2] == [
            "FAILS: anchor, front: 120 kN are needed and 100 are provided, 120 % used; give a larger one",
            "FAILS: anchor, all: 110 kN are needed and 100 are provided, 110 % used; give a larger one",
        ]
        assert len(said) == 2 + worse and (
            not worse or "no design transmits 0.49 or less; the best transmits" in said[2]
        )
