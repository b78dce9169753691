"""Points under a keel, and what a study of responses asks of a computer, by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.response import effort, places


def test_under_each_point_of_a_keel_is_the_depth_with_the_tide_less_its_own_and_the_extra_draft():
    """20 m of water, 0.5 m of tide, 1 m of extra draft: 9.5 m under a bottom at −10 m, 8.5 m under one at −11 m"""
    table = SimpleNamespace(tide=0.5, extra_draft=1.0, points=[(40.0, 5.0, -10.0), (-40.0, 0.0, -11.0)])
    found = places.keel_points(table, SimpleNamespace(water_depth=20.0, bodies=()))
    assert [(one.position, one.gap) for one in found] == [((40.0, 5.0, -10.0), 9.5), ((-40.0, 0.0, -11.0), 8.5)]
    assert found[0].name == "keel x 40 y 5"
    with pytest.raises(
        StudyError, match=r"under \(0, 0, -19.5\) there is 0 m of water at rest, with depth 20 m, tide 0.5 m and extra"
    ):
        places.keel_points(
            SimpleNamespace(tide=0.5, extra_draft=1.0, points=[(0.0, 0.0, -19.5)]),
            SimpleNamespace(water_depth=20.0, bodies=()),
        )


def test_a_study_asks_for_its_responses_at_its_headings_and_in_the_seas_of_its_climate(monkeypatch):
    """18 responses of a body and 13 of each point; short-crested seas at 36 headings, of which a turn has 360"""
    asked = []
    for name in ("check_memory", "check_seconds"):
        monkeypatch.setattr(effort, name, lambda what, value, way_out: asked.append((what, value)))
    monkeypatch.setattr(effort, "told", lambda what, seconds, memory: asked.append((what, seconds, memory)))
    points, climate = [1, 2], SimpleNamespace(directions=range(3), spreading=None)
    effort.check_effort(SimpleNamespace(points=points, sea=None, climate=climate))
    assert asked == [("44 responses need", 40_000.0 * 44 * 3), ("44 responses take", 0.08),
                     ("44 responses take", 0.08, 40_000.0 * 44 * 3)]  # fmt: skip
    asked.clear()
    # five classes in three columns of periods, of which one is empty
    scatter = SimpleNamespace(probability=np.array([[0.2, 0.0, 0.1], [0.3, 0.0, 0.0], [0.2, 0.0, 0.2]]))
    wide = SimpleNamespace(directions=range(12), spreading=2.0)
    effort.check_effort(SimpleNamespace(points=[], sea=None, climate=wide), scatter)
    assert asked[0] == ("18 responses in 60 sea states need", 40_000.0 * 18 * 360 + 60.0 * 18 * 60)
    assert asked[1] == ("18 responses in 60 sea states take", pytest.approx(18 * (1.5e-4 * 24 + 3e-7 * 60)))
    asked.clear()
    sea = SimpleNamespace(spreading=2.0)
    effort.check_effort(SimpleNamespace(points=[], sea=sea, climate=None))
    assert asked[0] == ("18 responses need", 40_000.0 * 18 * 36)
