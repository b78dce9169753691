"""Which method `auto` takes in deep water, what is said and stored of a raised bed, and how such databases grow."""

import hashlib

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.pipelines.scene.scene import SceneError, make_scene
from hakobune.pipelines.solve.plan import planned
from hakobune.pipelines.solve.run import solve

BUOY = {"shape": "buoy", "radius": 30.0, "draft": 6.0}
SHORT = [1.2, 1.6, 1.9]  # rad/s, two to six waves across
WANT = ["radiation", "excitation_force"]


def scene(omegas=SHORT, body=BUOY, depth=np.inf, **more):
    raw = {"water": {"depth": depth}, "bodies": [body], "waves": {"omegas": list(omegas)}, "want": WANT}
    return make_scene({**raw, **more})


def problem(made):
    return planned(made).problem


def test_short_waves_alone_over_deep_water_take_the_contour_method():
    assert scene().approach.method == "contour" and scene(method="contour").approach.method == "contour"
    assert scene(depth=5000.0).approach.method == "contour"


@pytest.mark.parametrize(
    "changes",
    [
        {"omegas": [0.5, *SHORT]},
        {"panels": 200},
        {"wall": 100.0},
        {"tolerance": 1e-4},
        {"body": {"shape": "buoy", "radius": 30.0, "draft": 0.2}},
        {"method": "panel"},
    ],
    ids=lambda changes: next(iter(changes)),
)
def test_panels_stay_where_a_raised_bed_is_not_for(changes):
    assert scene(**changes).approach.method == "panel"


def test_the_bed_depends_on_body_and_tolerance_alone_and_is_never_below_the_real_one():
    beds = {problem(scene(omegas)).bed for omegas in (SHORT, [1.2], [2.5])}
    assert len(beds) == 1
    (bed,) = beds
    assert problem(scene(depth=2 * bed)).bed == bed
    assert problem(scene(tolerance=0.005)).bed > bed
    flat = {**BUOY, "draft": 3.0}
    bed = 0.9 * problem(scene(body=flat)).bed
    assert problem(scene(depth=bed, body=flat)).bed == bed


def test_up_to_a_hundred_drafts_of_water_under_the_keel_the_contour_method_takes_the_bed_there_is():
    draft = BUOY["draft"]
    for omegas in (SHORT, [0.5, *SHORT]):
        made = scene(omegas, depth=100.9 * draft)
        assert made.approach.method == "contour" and made.approach.bed is None
    assert scene([0.5, *SHORT], depth=101.1 * draft).approach.method == "panel"
    assert scene(SHORT, depth=101.1 * draft).approach.bed is not None


def test_a_problem_keeps_the_depth_of_the_scene_and_has_panels_for_the_limits():
    made = problem(scene(depth=5000.0))
    assert made.depth == 5000.0 and made.panels.depth == 5000.0 and made.bed < 1000.0


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    path = tmp_path_factory.mktemp("short") / "buoy.h5"
    return path, solve(scene(SHORT[:2]), path)


def test_a_database_over_a_raised_bed_states_the_real_water_and_names_the_bed(stored):
    path, outcome = stored
    db = open_database(path)
    assert outcome.exit_status == 0 and db.water_depth == np.inf
    assert db.attributes["method"] == "contour" and db.attributes["raised_bed"] == problem(scene()).bed
    (remark,) = [text for text in outcome.remarks if "bed" in text]
    assert "\n" not in remark and f"{db.attributes['raised_bed']:.4g} m" in remark
    assert not any("bed" in text for text in solve(scene([1.2], depth=60.0), path.with_name("near.h5")).remarks)


def test_the_stored_estimate_holds_at_least_the_effect_of_the_bed(stored):
    db = open_database(stored[0])
    gap = db.attributes["raised_bed"] - BUOY["draft"]
    heave = db.estimated_errors()["added_mass"][:, 2, 2]
    size = np.hypot(db["added_mass"][:, 2, 2], db["radiation_damping"][:, 2, 2] / db.omega)
    aligned = 0.7 * (BUOY["radius"] / gap) ** 2
    assert np.all(heave < 0.01 * size)
    both = np.hypot(heave, db.estimated_errors()["radiation_damping"][:, 2, 2] / db.omega)
    assert np.all(both >= aligned * size * (1 - 1e-9))


def test_a_database_of_short_waves_grows_to_the_numbers_of_one_made_at_once(stored, tmp_path):
    path = tmp_path / "grown.h5"
    path.write_bytes(stored[0].read_bytes())
    assert solve(scene(SHORT), path).solved == 1
    assert solve(scene(SHORT), tmp_path / "whole.h5").exit_status == 0
    grown, whole = open_database(path), open_database(tmp_path / "whole.h5")
    for name in whole.names:
        size = np.abs(whole[name]).max()
        np.testing.assert_allclose(grown[name], whole[name], rtol=1e-9, atol=1e-9 * size, err_msg=name)


def test_a_long_wave_is_refused_by_a_database_of_short_ones_and_leaves_it_as_it_was(stored):
    before = hashlib.sha256(stored[0].read_bytes()).digest()
    with pytest.raises(SceneError, match=r"by method contour so far.*needs a finite water depth; give --fresh"):
        solve(scene([0.3, *SHORT]), stored[0])
    assert hashlib.sha256(stored[0].read_bytes()).digest() == before


def test_short_waves_added_to_a_database_by_panels_stay_with_them(tmp_path):
    body, path = {"shape": "buoy", "radius": 5.0, "draft": 4.0}, tmp_path / "panels.h5"
    assert solve(scene([0.8], body, want=["added_mass"], tolerance=0.1), path).exit_status == 0
    alone = scene([2.6], body, want=["added_mass"], tolerance=0.1)
    assert alone.approach.method == "contour"
    solve(alone, path)
    db = open_database(path)
    assert db.attributes["method"] == "panel" and "raised_bed" not in db.attributes


def test_limits_beside_short_waves_are_those_of_panels_in_the_real_depth(tmp_path):
    want = ["added_mass", "limits"]
    assert solve(scene([1.6], want=want), tmp_path / "short.h5").exit_status == 0
    assert solve(scene([0.3], want=want), tmp_path / "long.h5").exit_status == 0
    short, long = (open_database(tmp_path / name) for name in ("short.h5", "long.h5"))
    assert (short.attributes["method"], long.attributes["method"]) == ("contour", "panel")
    for name in ("added_mass_zero", "added_mass_infinity"):
        size = np.sqrt(np.abs(np.diag(long[name])))
        size[5] = np.inf  # yaw of a round buoy
        assert np.isfinite(short[name]).all()
        np.testing.assert_allclose(short[name] / np.outer(size, size), long[name] / np.outer(size, size), atol=0.01)
