"""What a run remarks on its body: what is left out of what was asked for, and numbers in another unit."""

import pytest

from hakobune.meshing.shapes import box
from hakobune.pipelines.scene.scene import make_scene
from hakobune.pipelines.solve.header import make_header
from hakobune.pipelines.solve.hull import MeshedHull
from hakobune.pipelines.solve.remarks import remarks as remarks_on

MESH = box(100, 50, 10, panels=60)


def remarks(want=None, density=1025.0, gyration=None, **more):
    body = {"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}
    raw = {
        "water": {"depth": 20.0, "density": density},
        "bodies": [body if gyration is None else {**body, "gyration": gyration}],
        "waves": {"omegas": [0.5]},
        **more,
    }
    scene = make_scene(raw if want is None else {**raw, "want": want})
    hull = MeshedHull(MESH, None)
    return remarks_on(scene, hull, make_header(scene, hull).body)


@pytest.mark.parametrize(
    ("want", "words"),
    [
        (None, "rao and drift_force are left out: they need"),
        (["drift"], "drift_force is left out: it needs"),
        (["added_mass"], ""),
        (["excitation_force"], ""),
        (["radiation", "diffraction"], ""),
    ],
    ids=str,
)
def test_motions_are_left_out_of_what_was_asked_for_only(want, words):
    said = [line for line in remarks(want) if "gyration" in line]
    assert [words in line for line in said] == ([True] if words else [])


def test_beside_a_wall_only_what_there_would_be_is_left_out():
    (said,) = [line for line in remarks(wall=-60.0) if "gyration" in line]
    assert said.startswith("rao is left out")


@pytest.mark.parametrize(("density", "odd"), [(1.025, True), (899.0, True), (1000.0, False), (1300.0, False)])
def test_a_density_that_is_not_of_water_is_remarked_with_its_unit(density, odd):
    said = [line for line in remarks(["added_mass"], density) if "density" in line]
    assert len(said) == odd
    assert all(f"density {density:g} kg/m³" in line and "900 to 1300 kg/m³" in line for line in said)


@pytest.mark.parametrize(("gravity", "odd"), [(32.2, True), (9.80665, False), (9.78, False)])
def test_a_gravity_in_feet_is_remarked(gravity, odd):
    said = [line for line in remarks(["added_mass"], water={"depth": 20.0, "gravity": gravity}) if "gravity " in line]
    assert len(said) == odd and all("ft/s²" in line for line in said)
