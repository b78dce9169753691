"""Scenes with more waves along the body than are resolved: answered, said, and the far field refused by name."""

import math

import numpy as np
import pytest

from hakobune.bem.contour.short_waves import MOST_UNRESOLVED
from hakobune.bem.database import open_database
from hakobune.pipelines.cli import main
from hakobune.pipelines.scene.methods import FAR_FIELD
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.hull import make_hull
from hakobune.pipelines.solve.plan import planned

BOX = {"shape": "box", "length": 100.0, "beam": 20.0, "draft": 2.0}
BUOY = {"shape": "buoy", "radius": 50.0, "draft": 2.0}


def scene(body=BOX, depth=3.0, omegas=(5.0, 12.0), **more):
    return make_scene({"water": {"depth": depth}, "bodies": [body], "waves": {"omegas": list(omegas)}, **more})


@pytest.mark.parametrize(("body", "depth", "highest"), [(BOX, 3.0, 12.0), (BOX, np.inf, 12.0), (BUOY, 3.0, 20.0)])
def test_short_waves_are_answered_and_said_in_one_line(body, depth, highest):
    checked = scene(body, depth, (7.0, highest))
    border, remarks = checked.approach.highest_resolved, planned(checked).remarks
    assert 7.0 < border < highest
    assert sum(f"above {border:.4g} rad/s more than" in line for line in remarks) == 1
    assert not set(checked.names()) & set(FAR_FIELD) and "excitation_force" in checked.names()


def test_ordinary_waves_keep_their_far_field():
    checked = scene(omegas=[1.0, 2.0])
    assert checked.approach.highest_resolved is None and "drift_force_fixed" in checked.names()


@pytest.mark.parametrize("word", ["drift", "kochin", "drift_force_fixed"])
def test_a_far_field_asked_for_by_name_is_refused_with_its_frequency(word):
    with pytest.raises(SceneError, match=rf"want has {word}, which frequencies above 11\.\d+ rad/s.* do not have"):
        scene(want=["radiation", word])


@pytest.mark.parametrize(("body", "depth", "method"), [
    (BOX, 3.0, "strip"), ({**BOX, "beam": 2.0}, 3.0, "auto"), ({**BOX, "draft": 0.02}, 0.1, "auto"),
])  # fmt: skip
def test_short_waves_without_an_answer_are_refused_in_one_line(body, depth, method):
    checked = scene(body, depth, method=method)
    with pytest.raises(SceneError, match=r"the shortest wave is 0\.\d+ m against a body 100 m across"):
        make_hull(checked)


@pytest.mark.parametrize("body", [BOX, BUOY])
def test_waves_too_short_for_any_answer_are_refused_with_the_shortest_that_has_one(body):
    shortest = 100.0 / MOST_UNRESOLVED
    refused, answered = ([math.sqrt(9.80665 * 2 * math.pi / (f * shortest))] for f in (0.9, 1.1))
    with pytest.raises(SceneError, match=r"against a body 100 m across; allowed: at least 0\.001 m"):
        make_hull(scene(body, omegas=refused))
    make_hull(scene(body, omegas=answered))


def test_a_scene_of_ordinary_and_short_waves_is_stored_with_the_errors_of_both(tmp_path, capsys):
    file = tmp_path / "box.h5"
    words = "box --length 100 --beam 20 --draft 2 --depth 3 --omega 2,14 --heading 0,30 --tolerance 0.05"
    assert main([*words.split(), "--output", str(file)]) == 0
    db = open_database(file)
    error = db.estimated_errors()["excitation_force"]
    assert np.all(np.isfinite(error)) and np.all(error[:, 0, 0] > 0) and np.all(np.isfinite(db["added_mass"]))
    assert "far shorter than its walls" in capsys.readouterr().out
    # a mesh that nothing was computed with is not held against the waves
    assert main(["check", str(file)]) == 0 and "warning" not in capsys.readouterr().out


def test_a_slender_box_is_refused_for_the_waves_between_resolved_and_short():
    """Two metres wide, kb is 55 from 438 waves on: shorter ones have an answer, those of 300 do not"""
    checked = scene({**BOX, "beam": 2.0, "draft": 1.0}, 3.0, (13.6, 25.0))
    with pytest.raises(SceneError, match=r"the 13\.6 rad/s wave is 0\.333 m against a body 100 m across"):
        make_hull(checked)


def test_short_waves_do_not_go_into_a_file_with_a_far_field(tmp_path, capsys):
    file = str(tmp_path / "box.h5")
    words = [
        "box",
        "--length",
        "100",
        "--beam",
        "20",
        "--draft",
        "2",
        "--depth",
        "3",
        "--heading",
        "0",
        "--tolerance",
        "0.05",
    ]
    assert main([*words, "--output", file, "--omega", "2"]) == 0
    assert main([*words, "--output", file, "--omega", "2,14"]) == 2
    assert "which frequencies above" in capsys.readouterr().err and len(open_database(file).rows) == 1
