"""What a scene's method, wall, lids and bodies leave out of the names of a database, and what is said of each."""

from types import SimpleNamespace

import pytest

from hakobune.pipelines.scene.methods import OF_EACH, POWER, names_given

EACH = next(iter(OF_EACH))


def a_scene(method, **more):
    given = dict(solved_by=method, wall=None, damping_lids=("lid",), several=True, modes=(), depth=20.0) | more
    return SimpleNamespace(**given, water=SimpleNamespace(depth=given["depth"]))


@pytest.mark.parametrize(
    ("scene", "name", "words"),
    [
        (a_scene("pressure", wall="y"), "drift_force", "which is not computed beside a wall"),
        (
            a_scene("pressure", wall="y"),
            "added_mass_infinity",
            "pressure does not compute; use method panel or contour",
        ),
        (
            a_scene("strip", several=False),
            "drift_force",
            "method strip does not compute; use method panel or contour or pressure",
        ),
        (a_scene("panel", damping_lids=()), POWER, "which is computed only for a scene with damping_lids;"),
        (a_scene("panel", several=False), EACH, "which is computed only for several bodies;"),
        (a_scene("contour"), EACH, "which method contour does not compute; use method panel or transfer"),
        (a_scene("panel", wall=20.0), EACH, "which is not computed beside a wall"),
    ],
)
def test_a_name_that_is_asked_for_and_not_given_is_refused_by_what_lacks_it(scene, name, words):
    with pytest.raises(ValueError, match=f"want has {name}, .*{words}"):
        names_given(scene, ("added_mass", name), [name])
    assert names_given(scene, ("added_mass", name), []) == ("added_mass",)


def test_nothing_is_left_out_where_all_is_given_and_nothing_kept_is_told():
    assert names_given(a_scene("panel"), ("drift_force", POWER, EACH), ["drift_force"]) == ("drift_force", POWER, EACH)
    with pytest.raises(ValueError, match="want is drift, none of which method strip computes here"):
        names_given(a_scene("strip"), ("drift_force",), ["drift"])
