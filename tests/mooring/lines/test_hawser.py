"""Hawsers, ropes and springs as lines of a system: tangent, slack, tables, words of a study."""

import numpy as np
import pytest

from hakobune.mooring.lines.system.equilibrium import moved
from hakobune.mooring.lines.system.hawser import elongation_at, pull_of_points
from hakobune.mooring.lines.system.parts import LineSystemError
from hakobune.mooring.studies.conditions import ExposedBox
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor.study import make_study

HULL = ExposedBox(100.0, 50.0, 10.0, 10.0)
NYLON = {"elongation_percent": [0, 5, 10, 20], "tension_kN": [0, 100, 300, 1200], "breaking_load_kN": 1500}
TYPES = {"nylon": NYLON, "coil": {"spring_kN_per_m": 200.0}}
LINES = [
    {"name": "fore", "type": "nylon", "fairlead": [50, 0, 5], "bollard": [110, 0, 3], "pretension_kN": 100.0},
    {"name": "aft", "type": "coil", "fairlead": [-50, 0, 5], "bollard": [-110, 5, 3], "pretension_kN": 100.0},
    {"name": "port", "type": "coil", "fairlead": [0, 25, 5], "bollard": [0, 65, 5], "length": 39.0},
    {"name": "starboard", "type": "coil", "fairlead": [0, -25, 5], "bollard": [0, -65, 5], "length": 41.0},
]


def four(**changes):
    first = {k: v for k, v in (LINES[0] | changes).items() if v is not None}
    raw = {"water": {"depth": 20.0}, "hull": {"freeboard": 10.0}, "types": TYPES, "lines": [first, *LINES[1:]]}
    return make_study(raw).system(HULL, (0.0, 0.0, 0.0))


def test_a_hawser_at_its_pretension_pulls_with_it_and_a_slack_one_not():
    system = four()
    tension = system.forces_between(*(system.load().points[system.arrays.ends].swapaxes(0, 1))).tension_b
    assert tension == pytest.approx([1e5, 1e5, 2e5, 0.0], rel=1e-12)
    assert elongation_at(system.lines[0].pull, 1e5) == pytest.approx(0.05 * system.lines[0].length)


def test_stiffness_of_hawsers_is_the_slope_of_their_forces():
    from mooring_systems import fourth_order

    system = four(pretension_kN=80.0)  # away from a knot of the table
    pose = moved(system, system.pose, np.array([0.2, 0.3, -0.1, 0.01, 0.02, -0.01]))
    K = system.total_load(pose).stiffness
    assert np.abs(K - fourth_order(system, pose)).max() < 1e-8 * np.abs(K).max()


def test_a_pull_goes_through_its_table_without_a_jump_of_slope_and_goes_on_straight():
    e, T = np.array([0.0, 3.0, 6.0, 12.0]), np.array([0.0, 1e5, 3e5, 1.2e6])
    pull = pull_of_points("rope", e, T)
    assert pull.loading(e) == pytest.approx(T)
    assert pull.loading.slope(e[1:] - 1e-9) == pytest.approx(pull.loading.slope(e[1:] + 1e-9), rel=1e-6)
    assert pull.loading(14.0) - pull.loading(13.0) == pytest.approx(pull.loading.slope(12.0))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"pretension_kN": None}, "lines\\[0\\].*length"),
        ({"bollard": None, "heading_deg": 0.0, "length": 60.0}, "fore.*bollard"),
        ({"type": "coil", "pretension_kN": 20_000.0}, "spring would be -"),
        ({"type": "wire", "length": 60.0, "pretension_kN": None}, "allowed: nylon, coil"),
    ],
)
def test_a_wrong_word_of_a_hawser_is_named(changes, said):
    with pytest.raises(StudyError, match=said):
        four(**changes)


def test_a_table_that_falls_is_refused():
    with pytest.raises(LineSystemError, match="tension number 3 is 50 N; allowed: rising"):
        pull_of_points("rope", [0, 1, 2], [0, 100, 50])
