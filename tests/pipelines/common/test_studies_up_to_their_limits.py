"""What a study may say, from both sides of each limit: shipped examples with one value changed, read and checked.

Every row is (place of the value, the last one that is taken, the first that is refused, what is said); `...` leaves the
value out.  Nothing is solved.
"""

import copy
import math
import tomllib
from pathlib import Path

import pytest

from hakobune.pipelines.berth.study import BerthStudy, approach_of
from hakobune.pipelines.breakwater.study import make_breakwater
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.common.typed import typed
from hakobune.pipelines.moor.study import make_study as moored
from hakobune.pipelines.passing.study import make_study as passage
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.scene.tables import SceneError
from hakobune.pipelines.scene.viscous_table import viscous_of

SCENES = Path(__file__).parents[3] / "pipelines" / "scenes"
LINES = {"angle_deg": 44.0, "attachment": 5.0}
RANGES = {"draft": [4.0, 6.0], "samples": 8, "limits": 1}
ARC = [[-3.0, 0.0], [-3.0, -2.0, 0.1], [3.0, -2.0], [3.0, 0.0]]
SEA = {"spectrum": "bretschneider", "height": 1.0, "significant_period": 6.0}
OUTLINE = {"shape": "outline", "points": ARC, "draft": 2.0}
BOX = {"shape": "box", "length": 40.0, "beam": 12.0, "draft": 2.0, "gyration": [4.0, 11.0, 11.0]}
BENT = {"kind": "vertical bending", "EI": 1e12, "count": 1}
LAW = {"wave_height": 1.0, "roll": "Yamashita"}


def berth(raw):
    return approach_of(typed(raw, BerthStudy, StudyError))


def without_berth(raw):
    return moored(raw).without_berth("hakobune response")


def damped(raw):
    return viscous_of(make_scene({**raw, "viscous": LAW}))


KINDS = {
    "berth": (berth, "berth_tanker"),
    "breakwater": (make_breakwater, "breakwater_rectangle"),
    "passage": (passage, "passing_tanker"),
    "scene": (make_scene, "bodies_side_by_side"),
    "damped": (damped, "box_barge"),
    "bent": (lambda raw: make_scene({**raw, "waves": {"periods": [6.0], "headings_deg": [0.0]}}), "box_barge"),
    "one": (lambda raw: viscous_of(make_scene(raw)), "box_barge"),
    "moored": (without_berth, "simulate_chain_12"),
}
ROWS = [
    ("berth", "approach.abnormal", 10.0, 10.1, "approach.abnormal is 10.1; allowed: 1 to 10"),
    ("berth", "approach.abnormal", 1.0, 0.99, "approach.abnormal is 0.99; allowed: 1 to 10"),
    ("berth", "approach.angle_deg", 45.0, 45.1, "approach.angle_deg is 45.1; allowed: −45 to 45"),
    ("berth", "approach.angle_deg", -45.0, -45.1, "approach.angle_deg is -45.1; allowed: −45 to 45"),
    ("berth", "approach.virtual_mass", "older", "newer", "approach.virtual_mass is 'newer'; allowed: ueda, "),
    ("berth", "approach.virtual_mass", 1.8, 0.0, "approach.virtual_mass is 0"),
    ("breakwater", "section", OUTLINE, {**OUTLINE, "points": [*ARC[:3], [3.0]]},
     "section.points[3] has 1 numbers; allowed: y, z, or y, z and bulge"),
    ("breakwater", "body", {"free_draft": 3.367, "center_of_gravity": 3.417, "gyration": 4.4}, ...,
     "body is missing; the holding free needs center_of_gravity, gyration and the weight"),
    ("breakwater", "lines", {**LINES, "axial_stiffness_kN": 1e5}, ...,
     "lines is missing; the holding taut needs angle_deg and attachment"),
    ("breakwater", "lines", {**LINES, "axial_stiffness_kN": 1e5}, LINES, "holding elastic needs it"),
    ("breakwater", "theories", ["potential flow"], ["long waves"],
     "holdings has 'free'; the theory of long waves covers fixed and taut only"),
    ("breakwater", "optimisation", RANGES, {**RANGES, "draft": [6.0, 4.0]},
     "optimisation.draft is from 6 to 4; allowed: above 0, rising"),
    ("breakwater", "optimisation", {**RANGES, "draft": [1e-9, 4.0]}, {**RANGES, "draft": [0.0, 4.0]},
     "optimisation.draft is from 0 to 4; allowed: above 0, rising"),
    ("breakwater", "optimisation", {**RANGES, "limits": 100}, {**RANGES, "limits": 101},
     "optimisation.limits is 101; allowed: 1 to 100"),
    ("breakwater", "optimisation", RANGES, {**RANGES, "limits": 0}, "optimisation.limits is 0; allowed: 1 to 100"),
    ("breakwater", "optimisation", {**RANGES, "samples": 4096}, {**RANGES, "samples": 8192}, "from 4 to 4096"),
    ("breakwater", "optimisation", {**RANGES, "samples": 4}, {**RANGES, "samples": 6}, "a power of two from 4"),
    ("breakwater", "sea", {**SEA, "spreading": "cosine:4"}, {**SEA, "spreading": "cos:4"}, "sea.spreading is 'cos:4'"),
    ("breakwater", "sea", {**SEA, "spectrum": "jonswap"}, {**SEA, "spectrum": "jonswp"}, "sea.spectrum is 'jonswp'"),
    ("breakwater", "sea", {**SEA, "duration_hours": 1e-3}, {**SEA, "duration_hours": 0.0}, "sea.duration_hours is 0"),
    ("breakwater", "sea", SEA, {**SEA, "mean_period": 5.0}, "sea"),
    ("breakwater", "waves.height", 1e-3, 0.0, "waves.height is 0"),
    ("breakwater", "waves.obliquity_deg", 85.0, 85.1, "waves.obliquity_deg is 85.1; allowed: -85 to 85"),
    ("breakwater", "sea", {**SEA, "obliquity_deg": -85.0}, {**SEA, "obliquity_deg": -85.1},
     "sea.obliquity_deg is -85.1"),
    ("breakwater", "water.tide", 9.9, 10.0, "water.tide is 10 m; allowed: 0 to below the depth of 10 m"),
    ("breakwater", "lines.angle_deg", 179.0, 180.0, "lines.angle_deg is 180; allowed: above 0 and below 180"),
    ("breakwater", "lines.attachment_height", 0.0, -0.1, "lines.attachment_height is -0.1; allowed: 0 or more, finite"),
    ("breakwater", "waves.periods", [0.05, 1000.0], [0.04], "waves.periods has 0.04 s; allowed: 0.05 to 1000"),
    ("breakwater", "waves.periods", [1.0] * 1000, [1.0] * 1001, "waves.periods has 1001 numbers; allowed: 1 to 1000"),
    ("breakwater", "design.holding", "elastic", "loose", "design.holding is 'loose'; allowed: fixed, free, taut"),
    ("breakwater", "holdings", ["taut", "free"], ["taut", "taut"], "holdings has 'taut'; allowed: each of fixed"),
    ("breakwater", "loss", {"coefficient": 1e4}, {"coefficient": 1.01e4}, "loss.coefficient is 10100; allowed: 0 to"),
    ("breakwater", "map", {"period": 6.0, "units": 1}, {"period": 6.0, "units": 1, "gap": 1.0}, "map.gap is 1 m"),
    ("breakwater", "map", {"units": 30, "gap": 0.1}, {"units": 31, "gap": 0.1},
     "map.units has 31 numbers; allowed: 1 to"),
    ("breakwater", "map", {"x": [-1.0, 1.0]}, {"x": [1.0, 1.0]}, "map.x is from 1 to 1 m; allowed: rising, finite"),
    ("passage", "panels", 12, 11, "panels is 11; allowed: 12 to 2000, on each hull"),
    ("passage", "panels", 2000, 2001, "panels is 2001; allowed: 12 to 2000, on each hull"),
    ("passage", "track.lengths", 0.5, 0.49, "track.lengths is 0.49; allowed: 0.5 to 20"),
    ("passage", "track.lengths", 20.0, 20.1, "track.lengths is 20.1; allowed: 0.5 to 20"),
    ("passage", "water.depth", math.inf, 0.0, "water.depth is 0 m; allowed: above 0, or inf"),
    ("passage", "wall", -40.0, math.inf, "wall is inf m; allowed: finite"),
    ("scene", "bodies", [BOX], {"barge": BOX}, "bodies is {'barge': "),
    ("one", "viscous", LAW, {**LAW, "wave_height": 0.0}, "viscous.wave_height is 0 m; allowed: above 0, finite"),
    ("one", "viscous", LAW, {**LAW, "wave_height": math.inf}, "viscous.wave_height is inf m; allowed: above 0, finite"),
    ("damped", "bodies", [BOX], [{k: v for k, v in BOX.items() if k != "gyration"}],
     "viscous damping needs motions; give gyration (--gyration)"),
    ("one", "want", ["drift"], ["drfit"], "want has 'drfit', which is not a result; allowed: "),
    ("bent", "modes", [BENT], [{**BENT, "axis_height": math.inf}], "modes[0].axis_height is inf; allowed: finite, m"),
    ("bent", "modes", [{**BENT, "damping": 0.99}], [{**BENT, "damping": 1.0}], "modes[0].damping is 1; allowed: 0 to"),
    ("moored", "hinges", [], [{"name": "h", "bodies": ["a", "b"], "position": [0.0, 0.0, 0.0]}],
     "hakobune response does not support [[hinges]]; use hakobune simulate"),
    ("moored", "quay", ..., {"y": 40.0},
     "hakobune response does not support [quay]; use hakobune simulate, or a database solved with --wall"),
    ("moored", "lines_body", "", "barge", "lines_body is 'barge', but lines_file is missing; give both"),
    ("moored", "allowable", 1.0, 1.01, "allowable is 1.01; allowed: above 0, at most 1"),
    ("moored", "allowable", 0.01, 0.0, "allowable is 0; allowed: above 0, at most 1"),
]  # fmt: skip


def changed(raw, path, value):
    raw, (*way, last) = copy.deepcopy(raw), path.split(".")
    at = raw
    for step in way:
        at = at[int(step) if step.isdigit() else step]
    if value is ...:
        at.pop(last, None)
    else:
        at[last] = value
    return raw


@pytest.mark.parametrize("kind, path, good, bad, says", ROWS, ids=lambda value: str(value)[:30])
def test_a_study_is_taken_up_to_its_limits_and_refused_beyond(kind, path, good, bad, says):
    make, name = KINDS[kind]
    raw = tomllib.loads((SCENES / f"{name}.toml").read_text(encoding="utf-8"))
    make(changed(raw, path, good))
    with pytest.raises((StudyError, SceneError, ValueError)) as refused:
        make(changed(raw, path, bad))
    assert says in str(refused.value)
