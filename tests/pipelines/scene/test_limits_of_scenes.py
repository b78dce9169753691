"""What a scene may say, from both sides of each limit, as a scene file says it."""

import math
import tomllib

import box_scene
import pytest

from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.scene.tables import SceneError

SCENE = box_scene.SCENE.replace("[0.4, 0.8]", "[0.5, 1.0]").replace("[0, 45]", "[0, 90]")
LIMITS = [  # old, good, bad, what is said
    ("depth = 20.0", "depth = 1e6", "depth = 1.1e6", "water.depth is 1100000.0; allowed: 0.001 to 1e+06"),
    ("depth = 20.0", "depth = inf", "depth = 0.0", "water.depth is 0.0; allowed: above 0, or inf"),
    ("depth = 20.0", "depth = 10.5", "depth = 10.0", "bodies[0].draft is 10.0 m in water 10.0 m deep"),
    ("depth = 20.0", "depth = 20.0\ndensity = 1e6", "depth = 20.0\ndensity = 1.1e6", "water.density is 1100000.0"),
    ("depth = 20.0", "depth = 20.0\ngravity = 1e-3", "depth = 20.0\ngravity = 9e-4", "water.gravity is 0.0009"),
    ("length = 100.0", "length = 1e6", "length = 1.1e6", "bodies[0].length is 1100000.0; allowed: 0.001 to 1e+06"),
    ("draft = 10.0", "draft = 10.0\nmass = 1e18", "draft = 10.0\nmass = 1.1e18", "bodies[0].mass is 1.1e+18"),
    ("draft = 10.0", "draft = 10.0\ncenter_of_gravity = [0, 0, 1e6]", "draft = 10.0\ncenter_of_gravity = [0, 0, 1.1e6]",
     "bodies[0].center_of_gravity is [0.0, 0.0, 1100000.0]; allowed: three numbers from -1e+06"),
    ("[15.0, 29.0, 32.0]", "[1e-3, 29.0, 32.0]", "[9e-4, 29.0, 32.0]", "bodies[0].gyration is 0.0009"),
    ("headings_deg = [0, 90]", "headings_deg = [-360, 359]", "headings_deg = [-361]", "headings_deg has -361"),
    ("headings_deg = [0, 90]", "headings_deg = [359, 1]", "headings_deg = [360, 0]",
     "headings_deg has 0 twice, once as 360"),
    ("headings_deg = [0, 90]", "headings_deg = [5, 359.99999999999]", "headings_deg = [0, 359.99999999999]",
     "headings_deg has 0 twice"),
    ("headings_deg = [0, 90]", "headings_deg = { from = -180, to = 165, count = 24 }",
     "headings_deg = { from = -180, to = 180, count = 25 }",
     "once as 180; allowed: each value once, 2e-09 apart; a full turn ends one step earlier: from -180 to 165, 24"
     ),
    ("omegas = [0.5, 1.0]", "omegas = [0.5, 0.50000001]", "omegas = [0.5, 0.5]", "waves.omegas has 0.5 twice"),
    ("omegas = [0.5, 1.0]", "periods = [5.0, 8.0]", "periods = [5.0, 8.0, 8.0]", "waves.periods has 8 twice"),
    ("omegas = [0.5, 1.0]", "periods = [5.0, 6.0]", "omegas = [1.0]\nperiods = [5.0]",
     "[waves] has omegas and periods; give exactly one"),
    ("omegas = [0.5, 1.0]", "xi_B = [0.5]", "", "[waves] has no frequencies; give exactly one of"),
    ("omegas = [0.5, 1.0]", "periods = [1e7]", "periods = [1.1e7]",
     "waves.periods is 11000000.0; allowed: 0.001 to 1e+07"),
    ("tolerance = 0.01", "tolerance = 0.2", "tolerance = 0.21", "tolerance is 0.21; allowed: 1e-5 to 0.2"),
    ("tolerance = 0.01", "tolerance = 1e-5", "tolerance = 9e-6", "tolerance is 9e-06; allowed: 1e-5 to 0.2"),
    ("tolerance = 0.01", "panels = 20", "panels = 0", "panels is 0; allowed: 1 to 100000"),
    ("tolerance = 0.01", "panels = 100000", "panels = 100001", "panels is 100001; allowed: 1 to 100000"),
    ("tolerance = 0.01", 'wall = 25.1\nmethod = "panel"', "wall = 24.9", "more than half its beam, 25"),
    ("tolerance = 0.01", 'wall = -25.1\nmethod = "panel"', 'wall = 1.1e6\nmethod = "panel"',
     "wall is 1.1e+06; allowed"),
    ("tolerance = 0.01", 'method = "panel"', 'method = "boundary"', "method is 'boundary'; allowed: auto, panel"),
    ("tolerance = 0.01", 'method = "contour"', 'method = "contour"\npanels = 100',
     "method contour has no panels: leave"),
    ("tolerance = 0.01", "rotation_center = [0, 0, 1e6]", "rotation_center = [0, 0, 1.1e6]",
     "rotation_center is [0.0, 0.0"),
    ('shape = "box"', 'shape = "box"', 'shape = "boxes"', "bodies[0].shape is 'boxes'; allowed"),
    ("beam = 50.0\n", "beam = 50.0\n", "", "bodies[0].beam is missing; the keys of a box are length, beam, draft"),
    ("beam = 50.0\n", "beam = 50.0\n", "beam = 50.0\nradius = 3.0\n", "bodies[0].radius is 3.0; the keys of a box"),
    ("beam = 50.0\n", "beam = 50.0\n", "beam = 50.0\nbow = 0.8\n", "or a waterplane coefficient; a box has"),
]  # fmt: skip


@pytest.mark.parametrize("old, good, bad, says", LIMITS, ids=lambda text: text[-24:])
def test_a_scene_is_taken_up_to_its_limits_and_refused_beyond(old, good, bad, says):
    assert old in SCENE
    make_scene(tomllib.loads(SCENE.replace(old, good)))
    with pytest.raises(SceneError) as refused:
        make_scene(tomllib.loads(SCENE.replace(old, bad)))
    assert says in str(refused.value) and "\n" not in str(refused.value)


@pytest.mark.parametrize("depth, method", [(1009.0, "contour"), (1011.0, "panel")])
def test_the_contour_method_takes_up_to_a_hundred_drafts_under_the_keel(depth, method):
    """(depth − 10)/10, the draft being less than half of the beam"""
    scene = make_scene(tomllib.loads(SCENE.replace("depth = 20.0", f"depth = {depth}").replace("[0.5, 1.0]", "[0.05]")))
    assert scene.solved_by == method


def test_half_the_width_counts_where_it_is_less_than_the_draft():
    """A box 12 m wide and 10 m deep: half of it is 6 m, (depth − 10)/6 up to 100"""
    for depth, method in ((609.0, "contour"), (611.0, "panel")):
        text = SCENE.replace("beam = 50.0", "beam = 12.0").replace("depth = 20.0", f"depth = {depth}")
        assert make_scene(tomllib.loads(text.replace("[0.5, 1.0]", "[0.05]"))).solved_by == method


def test_frequencies_by_period_and_by_number_and_headings_are_sorted_in_si():
    """ω = 2π/T; ξ_B = ω² B/2g"""
    made = make_scene(tomllib.loads(SCENE.replace("omegas = [0.5, 1.0]", "periods = [5.0, 10.0]")))
    assert list(made.omegas()) == pytest.approx([2 * math.pi / 10, 2 * math.pi / 5])
    made = make_scene(tomllib.loads(SCENE.replace("omegas = [0.5, 1.0]", "xi_B = [0.5]")))
    assert made.omegas()[0] == pytest.approx(math.sqrt(2 * 9.80665 * 0.5 / 50.0))
    made = make_scene(tomllib.loads(SCENE.replace("[0, 90]", "[90, 0, -45]")))
    assert list(made.headings()) == pytest.approx([-math.pi / 4, 0.0, math.pi / 2])
    deep = make_scene(tomllib.loads(SCENE.replace("depth = 20.0", "depth = inf")))
    assert deep.shortest_wave == pytest.approx(2 * math.pi * 9.80665 / 1.0**2)
