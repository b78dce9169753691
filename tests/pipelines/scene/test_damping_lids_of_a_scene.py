"""Damping lids of a scene: what is refused when the scene is read."""

import pytest

from hakobune.pipelines.scene.scene import SceneError, make_scene

BOX = {"shape": "box", "length": 20.0, "beam": 6.0, "draft": 2.0}


def scene(**lid):
    two = [BOX | {"name": "one", "place": [0, 5, 0]}, BOX | {"name": "two", "place": [0, -5, 0]}]
    waves = {"periods": [6.0], "headings_deg": [0.0]}
    return {"water": {"depth": 12.0}, "bodies": two, "waves": waves, "damping_lids": [{"damping": 0.05} | lid]}


@pytest.mark.parametrize("damping, taken", [(9e-7, False), (1e-6, True), (10.0, True), (10.1, False)])
def test_the_damping_of_a_lid_lies_between_its_limits(damping, taken):
    if taken:
        assert make_scene(scene(damping=damping)).damping_lids[0].damping == damping
    else:
        with pytest.raises(SceneError, match=r"damping_lids\[0\]\.damping is"):
            make_scene(scene(damping=damping))


def test_corners_of_a_lid_go_round_a_convex_polygon():
    with pytest.raises(SceneError, match=r"damping_lids\[0\]\.corners is not a convex polygon"):
        make_scene(scene(corners=[[0, 0], [1, 0]]))


def test_lids_and_a_wall_are_not_given_together():
    with pytest.raises(SceneError, match="damping_lids and a wall are given; give only one of them"):
        make_scene(scene() | {"wall": 20.0, "bodies": [BOX]})
