"""Breaking loads of a line in motion: each place against that of its own segment."""

import numpy as np
import pytest

from hakobune.mooring.lines.dynamics.simulation import DynamicLine, DynamicSegment, FairleadMotion, simulate
from hakobune.mooring.lines.dynamics.strength import Strength
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.line_dynamics.parts import _elongation
from hakobune.pipelines.line_dynamics.result import line_dynamics
from hakobune.pipelines.line_dynamics.study import DynamicTypeTable

STUDY = """\
anchor = [0.0, 0.0, -60.0]
duration = 16.0
[water]
depth = 60.0
[types.weak]
catalogue = "R3 studless 76 mm"
breaking_load_kN = 100.0
[types.strong]
catalogue = "R3 studless 76 mm"
[[segments]]
type = "weak"
length = 230.0
[[segments]]
type = "strong"
length = 85.0
[fairlead]
position = [292.0, 0.0, -2.0]
[[fairlead.motions]]
period = 8.0
amplitude = [0.5, 0.0, 0.2]
"""


def test_a_weak_part_that_carries_less_is_not_judged_by_what_a_strong_part_carries(tmp_path):
    (tmp_path / "line.toml").write_text(STUDY)
    found = line_dynamics(tmp_path / "line.toml")
    largest = found["tension.largest"] / 1e3
    assert largest[0] > 100.0 > largest[1] and found.status == 0
    window = np.array([largest[0] / 4884, largest[1] / 100])  # of the cycles; what is used is of the whole run
    assert np.all(found["tension.used"] >= window * (1 - 1e-4)) and np.allclose(
        found["tension.used"], window, rtol=0.02
    )
    assert (found["nearest.segment"], found["nearest.type"]) == (1, "weak")


def test_tensions_of_segments_are_those_of_their_elements():
    """Of their largest together the run keeps a history of its own; that of a part without a load counts nowhere."""
    rope = dict(mass=115.5, weight=985.0, diameter=0.137, axial_stiffness=4.6e8)
    parts = DynamicSegment(200.0, elements=16, **rope), DynamicSegment(115.0, elements=9, **rope)
    line = DynamicLine(parts, (0.0, 0.0, -60.0))
    motion = FairleadMotion.harmonic((292.0, 0.0, -2.0), [(2.0, 0.0, 1.0)], [6.0], 6.0)
    strength = Strength((2e5, 1e6), ("chain", "wire"))
    made = simulate(line, motion, 12.0, stations=strength.nodes(line), check_mesh=False)
    elements = [T for _, T in strength._tensions(line, made)][2:]
    assert np.allclose(np.max(elements, axis=0), made.largest_tension, rtol=1e-12)
    assert np.allclose(np.min(elements, axis=0), made.least_tension, rtol=1e-9, atol=1e-9 * made.largest_tension.max())
    top = max(np.max(elements[:16]), made.tension_anchor.max())
    lower = Strength((2e5, np.inf), strength.names).most_used(line, made)
    assert (lower.tension, lower.segment) == (top, 0) and lower.share == top / 2e5
    course = max((made.tension_anchor, *elements[:16]), key=max)
    assert lower.time == made.time[np.argmax(course)]
    assert Strength((np.inf, np.inf), strength.names).most_used(line, made) is None


def test_what_is_used_is_never_less_than_what_was_simulated_in_any_part_of_the_run(tmp_path, capsys, monkeypatch):
    """A pull at the beginning, outside the cycles that the table is of, parts the line as well as a later one"""
    from hakobune.mooring.lines.dynamics import simulation

    def pulled(*given, **named):
        made = run(*given, **named)
        made.tension_fairlead[1] = 0.9 * 4884e3
        return made

    run = simulation.simulate
    monkeypatch.setattr(simulation, "simulate", pulled)
    (tmp_path / "line.toml").write_text(STUDY)
    found = line_dynamics(tmp_path / "line.toml")
    assert found["tension[fairlead].used"] == pytest.approx(0.9, abs=1e-3)


@pytest.mark.parametrize("more, says", [
    ({}, None), ({"tension_tonf": [0.0, 10.0, 40.0], "tension_kN": None}, None),
    ({"axial_stiffness_kN": 1e5}, "t has both an axial stiffness and a table; give one of them"),
    ({"axial_stiffness_tonf": 1e4}, "t has both an axial stiffness and a table; give one of them"),
    ({"tension_kN": [0.0, 100.0]}, "t: elongation_percent has 3 numbers; give the same number in one of tension_t"),
    ({"tension_kN": None}, "t: elongation_percent has 3 numbers; give the same"),
    ({"tension_tonf": [0.0, 10.0, 40.0]}, "t: elongation_percent has 3 numbers; give the same"),
])  # fmt: skip
def test_a_table_of_elongations_has_tensions_of_one_unit_and_no_stiffness_beside_it(more, says):
    kind = DynamicTypeTable(**{"elongation_percent": [0.0, 2.0, 5.0], "tension_kN": [0.0, 100.0, 400.0]} | more)
    if says is None:
        unit = 9806.65 * 10 if "tension_tonf" in more else 1e5
        assert np.array(_elongation("t", kind)) == pytest.approx(np.array([[0, 0], [0.02, unit], [0.05, 4 * unit]]))
        return
    with pytest.raises(StudyError, match=says):
        _elongation("t", kind)
