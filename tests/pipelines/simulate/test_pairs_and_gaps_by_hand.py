"""Pairs of waves that a simulation may ask for, hulls that come near each other, statistics of runs, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.simulate import run, study, work
from hakobune.pipelines.simulate.file import STATISTICS, SUMMARY


def of(qtf, quay=None):
    return SimpleNamespace(simulation=SimpleNamespace(qtf=qtf), quay=quay)


@pytest.mark.parametrize(
    ("asked", "seas", "drift", "level"),
    [
        (of("auto"), True, "newman", "auto"), (of("auto"), True, "none", "newman"),
        (of("auto", quay=1), True, "newman", "newman"), (of("newman", quay=1), False, "newman", "newman"),
        (of("squares"), True, "newman", "squares"), (of("squares"), True, "none", "squares"),
        (SimpleNamespace(simulation=None, quay=None), False, "newman", "newman"),
    ],
)  # fmt: skip
def test_pairs_are_those_asked_for_and_newmans_where_no_others_are_known(monkeypatch, asked, seas, drift, level):
    monkeypatch.setattr(study, "level_of", lambda key, name: name)
    assert study.level_of_pairs(asked, seas, drift) == level


@pytest.mark.parametrize(
    ("asked", "seas", "says"),
    [
        (of("squares", quay=1), True, "simulation.qtf is 'squares' in front of a quay"),
        (of("squares"), False, "simulation.qtf is 'squares'; allowed: newman, auto, or with irregular waves"),
    ],
)
def test_pairs_need_irregular_waves_and_no_quay(monkeypatch, asked, seas, says):
    monkeypatch.setattr(study, "level_of", lambda key, name: name)
    with pytest.raises(StudyError, match=says):
        study.level_of_pairs(asked, seas, "newman")


@pytest.mark.parametrize(
    ("course", "says"),
    [
        ([10.0, 14.9, 5.1], None),  # half of the gap at rest
        ([10.0, 15.1, 10.0], "varies from 10 to 15.1 m and is 10 m at rest, but the forces of the water between"),
        ([10.0, 10.0, 4.9], "varies from 4.9 to 10 m"),
        ([10.0, 12.0, -0.25], "collide: their hulls overlap by 0.25 m, limit 0; keep them apart by fenders or lines"),
    ],
)
def test_hulls_that_meet_or_go_far_from_where_their_water_is_known_are_told(monkeypatch, course, says):
    sides = [SimpleNamespace(name=name, half=np.array([30.0, half])) for name, half in (("ship", 4.0), ("barge", 3.0))]
    monkeypatch.setattr(work, "pairs_of", lambda sides: [tuple(sides)])
    monkeypatch.setattr(work, "at_rest_of", lambda sides: None)
    monkeypatch.setattr(work, "gaps", lambda pair, poses: np.array([[10.0]]))
    told = [str(line) for line in work._of_gaps(sides, np.array(course)[:, None])]
    assert len(told) == (says is not None) and all("ship and barge " + says in line for line in told)
    sides[1].half[1] = 6.0  # of wide hulls half a beam may pass without a word
    sides[0].half[1] = 5.5
    assert (course[1] != 15.1) or not list(work._of_gaps(sides, np.array(course)[:, None]))


def test_a_summary_of_runs_has_means_extremes_and_the_spread_of_levels(monkeypatch):
    """Of two whole runs of three: levels are means, σ is the root of the mean square, as of one long record"""

    class Group(dict):
        def __getitem__(self, name):
            return {(): super().__getitem__(name)}

    at = {name: i for i, name in enumerate(STATISTICS)}
    rows = np.ones((3, 1, len(STATISTICS)))
    runs = (2.0, 3.0, 9.0, -4.0), (99.0,) * 4, (4.0, 4.0, 8.0, -5.0)
    for i, numbers in enumerate(runs):
        rows[i, 0, [at["mean"], at["sigma"], at["largest"], at["smallest"]]] = numbers
    monkeypatch.setattr(run, "whole_rows", lambda file: np.array([True, False, True]))
    found = dict(zip(SUMMARY, run.summary(Group(statistics=rows))[0], strict=True))
    assert found["mean"] == 3.0 and found["largest"] == 9.0 and found["smallest"] == -5.0
    assert found["sigma"] == pytest.approx(np.sqrt((9 + 16) / 2))
    monkeypatch.setattr(run, "whole_rows", lambda file: np.zeros(3, bool))
    assert np.isnan(run.summary(Group(statistics=rows))).all()


@pytest.mark.parametrize(
    ("seconds", "hours", "asked", "found"),
    [(100.0, None, None, 100.0), (None, 0.5, None, 1800.0), (100.0, None, 30.0, 30.0), (None, None, 30.0, 30.0)],
)
def test_a_run_lasts_as_long_as_is_asked_for_in_place_of_its_study(seconds, hours, asked, found):
    assert study._duration(SimpleNamespace(duration=seconds, duration_hours=hours), asked) == found


@pytest.mark.parametrize(("seconds", "hours", "says"), [(None, None, "neither is given"), (1.0, 1.0, "both are given")])
def test_a_run_has_one_duration(seconds, hours, says):
    with pytest.raises(StudyError, match=says):
        study._duration(SimpleNamespace(duration=seconds, duration_hours=hours), None)
