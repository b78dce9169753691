"""Sums of a design over its levels and cases, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.mooring.criteria.fatigue import Cycles
from hakobune.pipelines.design.fatigue import fatigue
from hakobune.pipelines.design.kinds.in_time import cycles_of
from hakobune.pipelines.design.kinds.needs import SCOPE
from hakobune.pipelines.design.running import given_parts

LIFE = 25.0  # years


def project(**more):
    base = {
        "values": [],
        "levels": {},
        "project": SimpleNamespace(service_life=LIFE),
        "fatigue": None,
        "states": [],
        "wear": None,
    }
    return SimpleNamespace(**base | more)


@pytest.mark.parametrize(
    ("levels", "range_of_tide"),
    [({}, 0.0), ({"high": 2.0}, 2.0), ({"low": -1.5}, 1.5), ({"high": 2.0, "low": -1.5}, 3.5)],
)
def test_lines_are_laid_out_over_five_depths_and_the_tide_from_low_to_high_water(levels, range_of_tide):
    """Port facility standard (1979): length at least five depths and the tidal range; the study's depth is the mean"""
    read = SimpleNamespace(project=project(levels=levels), study={"water": {"depth": 30.0}})
    numbers = SimpleNamespace(
        names=("A", "B", "hawser"), hawsers=("hawser",), types=(("chain",), ("chain",), ("nylon",)),
        length=np.array([300.0, 150.0, 40.0]), parts={},
    )  # fmt: skip
    case = SimpleNamespace(kind="storm", lines="intact", apart=False, name="one")
    found = given_parts(read, case, numbers)
    by_hand = {name: length / (5 * 30.0 + range_of_tide) for name, length in (("A", 300.0), ("B", 150.0))}
    assert found[SCOPE] == pytest.approx(by_hand)
    read.study = {}
    assert given_parts(read, case, numbers) == {}  # no water in the study, or no lines but hawsers and ropes
    read.study, numbers.types = {"water": {"depth": 30.0}}, (("rope",), ("rope",), ("nylon",))
    assert given_parts(read, case, numbers) == {}


def test_the_time_of_a_state_is_shared_by_its_directions_and_levels():
    """Miner's sum is linear in time: a state of 20 % of 25 years in four cases has 5 % in each.  Chain of 76 mm, DNV
    studless N = 6e10 s⁻³, cycles of 10 s and one range a case; 60 cycles whose ends count as halves."""
    states = [SimpleNamespace(name=n, share=share, waves=None) for n, share in (("work", 0.2), ("calm", 0.0))]
    own = SimpleNamespace(curve="DNV studless chain", factor=3.0)
    study = {"types": {"chain": {"catalogue": "R3 studless 76 mm"}}}
    read = SimpleNamespace(project=project(states=states, fatigue=own), study=study)
    t, ranges = np.arange(0.0, 600.5, 0.5), (0.8e6, 1.0e6, 1.2e6, 1.4e6)
    ran = []
    for i, size in enumerate((*ranges, 3e6, 3e6)):
        tension = (3e6 + 0.5 * size * np.cos(0.2 * np.pi * t))[None, :, None]
        state, lost = ("work", "") if i < 4 else ("calm", "") if i == 4 else ("work", "a line")
        case = SimpleNamespace(state=state, lost=lost, factor=1, name=f"{state} {i}")
        numbers = SimpleNamespace(names=("one",), types=(("chain",),), breaking=np.array([6e6]))
        ran.append(SimpleNamespace(case=case, numbers=numbers, runs={"cycles": cycles_of(tension, 0.5)}))
    seconds, area = LIFE * 365.25 * 86400, 2 * np.pi / 4 * 76.0**2
    each = [0.2 / 4 * seconds / 10.0 / 6e10 * (size / area) ** 3 for size in ranges]
    found = fatigue(read, ran).governing
    assert found.value == pytest.approx(3.0 * sum(each), rel=1e-6)
    assert found.case == "work 3"  # whose cycles are the largest


@pytest.mark.parametrize(("cycles", "said"), [(3, False), (4, False), (5, True), (40, True)])
def test_damage_that_fewer_than_five_cycles_carry_is_not_said(cycles, said):
    """n equal cycles carry a sum as n; beside them a hundred of a tenth of the range have 1e-3 of the damage each, so
    (n + 0.1)² / (n + 1e-4) cycles carry it: 5 values are the fewest that have an interval of 90 %, 1 − 2^(1−n)"""
    ranges = np.concatenate([np.full(cycles, 1e6), np.full(100, 1e5)])
    ran, read = tired(ranges, None)
    found = fatigue(read, ran)
    assert (found.met is not None) == said
    if not said:
        carry = (cycles + 0.1) ** 2 / (cycles + 1e-4)
        assert f"of one is due to only {carry:.1f} cycles of the runs; a" in found.missing and "seeds" in found.missing


def test_the_cycles_of_a_regular_wave_are_no_fatigue():
    ran, read = tired(np.full(400, 1e6), SimpleNamespace(method="regular_wave"))
    assert fatigue(read, ran).met is None and "work has a regular wave" in fatigue(read, ran).missing
    ran, read = tired(np.full(400, 1e6), SimpleNamespace(method="irregular"))
    assert fatigue(read, ran).met is not None


def tired(ranges, waves):
    """A case with whole cycles of these ranges (n,) N in an hour, and its project"""
    own = SimpleNamespace(curve="DNV studless chain", factor=3.0)
    states = [SimpleNamespace(name="work", share=0.2, waves=waves)]
    study = {"types": {"chain": {"catalogue": "R3 studless 76 mm"}}}
    read = SimpleNamespace(project=project(states=states, fatigue=own), study=study)
    case = SimpleNamespace(state="work", lost="", factor=1, name="work")
    numbers = SimpleNamespace(names=("one",), types=(("chain",),), breaking=np.array([6e6]))
    found = Cycles(ranges, np.full(len(ranges), 2e6), np.ones(len(ranges)))
    return [SimpleNamespace(case=case, numbers=numbers, runs={"cycles": [(3600.0, found)]})], read
