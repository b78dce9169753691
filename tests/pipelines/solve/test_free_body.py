"""Another mass, gyration or viscous damping: the free body is made anew, the flow about it is as stored."""

import numpy as np
import pytest

from hakobune.bem.database import open_database, storing
from hakobune.bem.database.schema import BODY
from hakobune.pipelines.executors.choice import Here
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.run import solve

LIGHT = {"gyration": [6.0, 12.0, 13.0]}
HEAVY = {"gyration": [7.0, 11.0, 14.0], "mass": 3.9e6, "center_of_gravity": [0.5, -0.25, 1.5], "trimmed": True}
DRAG = {"wave_height": 0.5, "pitch": {"drag": 1e7}, "heave": {"drag": 1e5}}
WAVES = {"omegas": [0.4, 1.1], "headings_deg": [0.0, 30.0]}


class Killed(BaseException):
    """The run ends here"""


class Counting(Here):
    """Works here and counts what is asked for."""

    asked = 0

    def submit(self, function, *arguments):
        self.asked += 1
        return super().submit(function, *arguments)


def solved(path, body, waves=WAVES, **more):
    """How much was solved for, and the remarks"""
    hull = {"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0, **body}
    raw = {"water": {"depth": 20.0}, "bodies": [hull], "waves": waves, "rotation_center": [1.0, 0.0, 2.0], **more}
    executor = Counting()
    outcome = solve(make_scene(raw), path, executor=executor)
    assert outcome.exit_status == 0
    return executor.asked, outcome.remarks


def assert_equal(one, other):
    """All of two databases, to rounding: the slope of Kochin functions by Fourier series has its own"""
    assert one.complete and other.complete and one.names == other.names
    assert one.attributes["scene_hash"] == other.attributes["scene_hash"]
    for name in (*one.names, *(name for name in BODY if name in other.header.body)):
        size = np.abs(other[name][np.isfinite(other[name])]).max(initial=0.0)
        np.testing.assert_allclose(one[name], other[name], rtol=0, atol=1e-11 * size, err_msg=name)


@pytest.mark.parametrize("more", [{}, {"panels": 40}], ids=["contour", "panel"])
@pytest.mark.parametrize("drag", [{}, {"viscous": DRAG}], ids=["", "viscous"])
def test_another_mass_gives_the_database_of_that_mass_without_solving(more, drag, tmp_path):
    path, other = tmp_path / "box.h5", tmp_path / "other.h5"
    assert solved(path, LIGHT, **more)[0] > 0
    stored = open_database(path)
    flow = {name: stored[name] for name in stored.names if name not in ("rao", "drift_force")}
    asked, remarks = solved(path, HEAVY, **more, **drag)
    assert asked == 0
    assert (
        sum("rao, drift_force are computed again" in line and "center_of_gravity was" in line for line in remarks) == 1
    )
    solved(other, HEAVY, **more, **drag)
    assert_equal(open_database(path), open_database(other))
    assert open_database(path).has_viscous_motions == bool(drag)
    for name, value in flow.items():
        np.testing.assert_array_equal(open_database(path)[name], value)
    assert solved(path, HEAVY, **more, **drag) == (0, tuple(line for line in remarks if "computed again" not in line))


def test_a_body_that_had_no_gyration_gets_its_motions_without_solving(tmp_path):
    assert solved(tmp_path / "box.h5", {})[0] > 0
    assert solved(tmp_path / "box.h5", LIGHT)[0] == 0
    solved(tmp_path / "other.h5", LIGHT)
    assert_equal(open_database(tmp_path / "box.h5"), open_database(tmp_path / "other.h5"))


def test_what_does_not_follow_from_what_is_stored_is_solved_again(tmp_path):
    want = ["radiation", "excitation_force", "drift"]  # no Kochin functions
    solved(tmp_path / "box.h5", LIGHT, want=want)
    assert solved(tmp_path / "box.h5", HEAVY, want=want)[0] == len(WAVES["omegas"])
    solved(tmp_path / "other.h5", HEAVY, want=want)
    assert_equal(open_database(tmp_path / "box.h5"), open_database(tmp_path / "other.h5"))


def test_new_frequencies_of_another_mass_are_the_only_ones_solved(tmp_path):
    more = {**WAVES, "omegas": [0.4, 0.7, 1.1]}
    want = ["radiation", "excitation_force", "kochin", "motions"]
    solved(tmp_path / "box.h5", LIGHT, want=want)
    assert solved(tmp_path / "box.h5", HEAVY, more, want=["motions"])[0] == 1
    solved(tmp_path / "other.h5", HEAVY, more, want=want)
    assert_equal(open_database(tmp_path / "box.h5"), open_database(tmp_path / "other.h5"))


@pytest.mark.parametrize("marks", range(1, 8))
def test_a_run_that_dies_among_the_marks_of_a_frequency_loses_no_estimated_error(marks, tmp_path, monkeypatch):
    want, wave = (
        ["radiation", "excitation_force", "kochin", "motions", "drift"],
        {"omegas": [0.4], "headings_deg": [30]},
    )
    solved(tmp_path / "whole.h5", LIGHT, wave, want=want)
    put, left = storing.put, [marks]

    def dying(dataset, *arguments):
        left[0] -= dataset.name.startswith("/stored/")
        if left[0] < 0:
            raise Killed
        put(dataset, *arguments)

    with monkeypatch.context() as patched, pytest.raises(Killed):
        patched.setattr(storing, "put", dying)
        solved(tmp_path / "box.h5", LIGHT, wave, want=want)
    solved(tmp_path / "box.h5", LIGHT, wave, want=want)
    one, other = (open_database(tmp_path / name) for name in ("box.h5", "whole.h5"))
    for name in ("rao", "drift_force"):
        np.testing.assert_array_equal(one[f"estimated_error/{name}"], other[f"estimated_error/{name}"])
