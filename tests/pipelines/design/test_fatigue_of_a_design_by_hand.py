"""Fatigue damage of lines over the service life: shares of states, cases, types, cycles and what cannot be judged, with
Miner's sum replaced by numbers that are made up."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria.fatigue import Cycles as fatigue_cycles
from hakobune.pipelines.design import fatigue

YEAR = fatigue.YEAR


def ran(name, state, damage, squares, lost="", factor=1.0, runs=True):
    case = SimpleNamespace(name=name, state=state, lost=lost, factor=factor)
    found = SimpleNamespace(names=("a", "b"))
    return SimpleNamespace(case=case, runs=(damage, squares) if runs else None, numbers=found)


def state(name, share, method="irregular"):
    return SimpleNamespace(name=name, share=share, waves=None if method is None else SimpleNamespace(method=method))


@pytest.fixture
def judged(monkeypatch):
    monkeypatch.setattr(fatigue, "_damage", lambda read, one, curve: np.array(one.runs, float))
    monkeypatch.setattr(fatigue, "curve_of", lambda own: SimpleNamespace(name="chain", source="rules"))

    def call(states, cases, factor=10.0, study=None, table=True):
        own = SimpleNamespace(factor=factor) if table else None
        own = SimpleNamespace(fatigue=own, states=states, wear=None, project=SimpleNamespace(service_life=20.0))
        read = SimpleNamespace(project=own, study=study or {})
        return fatigue.fatigue(read, cases)

    return call


def test_damage_is_that_of_each_state_by_its_share_evenly_over_its_cases_times_the_factor(judged):
    """Of the first line 10 (0.5 (0.02 + 0.04)/2 + 0.25 · 0.08) = 0.35, of the second 0.3; cases that lost a line, with
    other factors, or of a state without a share do not count"""
    cases = [
        ran("s1", "storm", (0.02, 0.02), (1e-9, 1e-9)), ran("s2", "storm", (0.04, 0.02), (1e-9, 1e-9)),
        ran("s3", "storm", (9, 9), (9, 9), lost="a"), ran("s4", "storm", (9, 9), (9, 9), factor=1.5),
        ran("c", "calm", (0.08, 0.08), (1e-9, 1e-9)), ran("x", "rare", (9, 9), (9, 9)),
    ]  # fmt: skip
    found = judged([state("storm", 0.5), state("calm", 0.25), state("rare", 0.0)], cases)
    (use,) = found.uses
    assert (use.case, use.item) == ("c", "a") and use.value == pytest.approx(0.35) and use.utilisation == use.value
    criterion = found.criterion
    assert (criterion.quantity, criterion.sense, criterion.limit, criterion.lines) == (
        fatigue.QUANTITY,
        "at most",
        1.0,
        "intact",
    )
    assert "curve chain (rules), factor 10" in criterion.source and criterion.rule == "fatigue"
    life = 10.0 * 20.0 / 0.35  # years, without the factor
    assert criterion.source.startswith(f"life {life:.3g} years without the factor; rainflow")
    assert judged([], [], table=False) is None


@pytest.mark.parametrize("cycles, good", [(1.01, True), (0.99, False)])
def test_damage_of_few_cycles_has_no_interval(judged, cycles, good):
    """(Σ d)²/Σ d² of equal cycles is their number; at least as many as an interval needs"""
    number = cycles * fatigue.FEWEST
    found = judged([state("storm", 1.0)], [ran("s", "storm", (0.01, 0.2), (9, 0.04 / number))])
    uses, missing = found.uses, found.missing
    assert len(uses) == good
    if not good:
        assert missing == (
            f"the damage of b is due to only {number:.1f} cycles of the runs; a 90 % interval needs "
            f"{fatigue.FEWEST} cycles; give a longer simulation.duration_hours or more seeds"
        )
    assert judged([state("storm", 1.0)], [ran("s", "storm", (0.0, 0.0), (0, 0))]).uses[0].value == 0.0


def test_regular_waves_and_cases_that_did_not_run_are_not_judged(judged):
    cases = [ran("s", "storm", (0.1, 0.1), (1e-9, 1e-9)), ran("c", "calm", (0, 0), (0, 0), runs=False)]
    found = judged([state("storm", 0.5, "regular_wave"), state("calm", 0.5)], cases)
    assert found.missing == "storm has a regular wave, and its cycles do not represent a sea; give irregular waves"
    found = judged([state("storm", 0.5), state("calm", 0.5)], cases)
    assert found.missing == "c could not be run" and found.uses == ()
    assert judged([state("storm", 0.5), state("calm", 0.0, "regular_wave")], cases).missing == ""


@pytest.mark.parametrize("waves, study, regular", [
    ("regular_wave", {}, True), ("irregular", {"waves": {"method": "regular_wave"}}, False),
    (None, {"waves": {"method": "regular_wave"}}, True), (None, {"waves": {}}, False), (None, {}, False),
])  # fmt: skip
def test_waves_of_a_state_stand_before_those_of_its_study(waves, study, regular):
    assert fatigue._is_regular(SimpleNamespace(study=study), state("s", 1.0, waves)) is regular


def test_each_line_has_the_worst_of_its_types_over_the_service_life(monkeypatch):
    """A year's worth of seconds times the rate, and its square for the sum of squares"""
    rates = {"thick": (1e-10, 1e-21), "thin": (3e-10, 4e-21), "wire": (2e-10, 9e-21)}
    asked = []

    def rate(cycles, read, name, curve, load):
        asked.append((cycles, name, curve, load))
        return rates[name]

    monkeypatch.setattr(fatigue, "_rate", rate)
    read = SimpleNamespace(project=SimpleNamespace(project=SimpleNamespace(service_life=25.0)))
    lines = SimpleNamespace(types=(("thick", "thin"), ("wire",)), breaking=(1e6, 2e6))
    one = SimpleNamespace(runs={"cycles": ["c1", "c2"]}, numbers=lines)
    found = fatigue._damage(read, one, "curve")
    life = 25.0 * YEAR
    assert found == pytest.approx(np.array([[3e-10 * life, 2e-10 * life], [4e-21 * life**2, 9e-21 * life**2]]))
    assert asked == [("c1", "thick", "curve", 1e6), ("c1", "thin", "curve", 1e6), ("c2", "wire", "curve", 2e6)]


def test_a_rate_is_miners_sum_over_the_time_of_the_runs(monkeypatch):
    asked = []
    monkeypatch.setattr(fatigue, "miner", lambda *of: asked.append(of) or (0.5, 0.25))
    own = SimpleNamespace(wear=None)
    read = SimpleNamespace(study={"types": {"thick": {"catalogue": "R3 studless 84 mm"}}}, project=own)
    assert fatigue._rate((200.0, "cycles"), read, "thick", "curve", 5e6) == (0.5 / 200, 0.25 / 200**2)
    assert asked == [("cycles", "curve", 84.0, 5e6)]
    assert "diameters of new lines, as no wear is given" in fatigue.wear_words(read)


@pytest.mark.parametrize("in_project", [True, False])
def test_a_line_that_wears_tires_at_its_mean_diameter(in_project):
    """A chain of 32 mm that loses 0.2 mm in each of 15 years is 30.5 mm on the mean; by N = 6e10 s⁻³ of the nominal
    area of both legs, damage is 1/d⁶ of it: (32/30.5)⁶ times that of the new chain"""
    chain = {"catalogue": "R3 studless 32 mm"} | ({} if in_project else {"corrosion_mm": 3.0})
    wear = SimpleNamespace(mm_per_year=0.2, years=15.0) if in_project else None
    read = SimpleNamespace(study={"types": {"chain": chain}}, project=SimpleNamespace(wear=wear))
    new = SimpleNamespace(study={"types": {"chain": {"catalogue": "R3 studless 32 mm"}}},
                          project=SimpleNamespace(wear=None))  # fmt: skip
    curve = fatigue.curves()["DNV studless chain"]
    ranges = np.array([5e4, 9e4])
    cycles = 600.0, fatigue_cycles(ranges, 0 * ranges, np.ones(2))
    area = 2 * np.pi / 4 * 30.5**2
    by_hand = sum((ranges / area) ** 3) / 6e10 / 600.0
    assert fatigue._rate(cycles, read, "chain", curve, 9e5)[0] == pytest.approx(by_hand, rel=1e-9)
    assert fatigue._rate(cycles, new, "chain", curve, 9e5)[0] == pytest.approx(by_hand * (30.5 / 32) ** 6, rel=1e-9)
    assert "chain 30.5 of 32 mm" in fatigue.wear_words(read) and "mm" not in fatigue.wear_words(new)


def test_a_curve_is_that_of_the_table_or_of_the_numbers_that_are_given(monkeypatch):
    monkeypatch.setattr(fatigue, "curves", lambda: {"DNV": "stored"})
    assert fatigue.curve_of(SimpleNamespace(curve="DNV")) == "stored"
    own = SimpleNamespace(curve=None, constant=6e10, exponent=3.0, basis="stress", chain=True)
    made = fatigue.curve_of(own)
    assert (made.name, made.basis, made.exponent, made.constant, made.chain) == (
        "6e+10 s^−3",
        "stress",
        3.0,
        6e10,
        True,
    )
