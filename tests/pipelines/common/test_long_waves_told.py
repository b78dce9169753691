"""Forces of bound long waves on panels: what they take is said first, and the time left at intervals."""

from types import SimpleNamespace

import pytest

from hakobune.bem.panels.band import cost
from hakobune.pipelines.common.bounds import LongWaves


@pytest.mark.parametrize(("seconds", "first"), [(9.0, True), (0.2, False)])
def test_long_work_is_told_before_it_begins_and_short_work_is_not(seconds, first, monkeypatch):
    said = []
    monkeypatch.setattr(cost, "seconds_alone", lambda prepared, omega: seconds)
    monkeypatch.setattr(cost, "memory_alone", lambda prepared: 2.4e9 if first else 1e8)
    prepared, told = SimpleNamespace(problem=SimpleNamespace(mesh=SimpleNamespace(total=2500))), LongWaves(said.append)
    told("waves", 3)
    told("long", (prepared, 0.1, 0, 10))
    told("long", (prepared, 0.1, 1, 10))
    assert said == ["forces of bound long waves, 10 frequencies on 2500 panels: about 1 min 30 s, 2.4 GB"] * first
    monkeypatch.setattr(cost, "seconds_alone", None)
    few = SimpleNamespace(problem=SimpleNamespace(mesh=SimpleNamespace(total=300)))
    monkeypatch.setattr(cost, "memory_alone", lambda prepared: 1e8)
    LongWaves(said.append)("long", (few, 0.1, 0, 10))  # seven seconds at most: not measured
    assert len(said) == first
    told.EVERY = 0.0
    told.started -= 20.0
    told("long", (prepared, 0.1, 2, 10))
    assert said[-1] == "forces of bound long waves: 2 of 10 frequencies, 1 min 20 s left"
