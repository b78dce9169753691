"""Whether a database is of a scene: by what the stored text means today, and a mesh file by what is in it."""

import tomllib

import numpy as np
import pytest
from box_scene import SCENE

from hakobune.bem.database.file import Header
from hakobune.meshing.files import read_mesh, write_mesh
from hakobune.meshing.shapes import box
from hakobune.pipelines.common.typed import to_toml
from hakobune.pipelines.scene import identity
from hakobune.pipelines.scene.identity import MESH_FILE, check_same, content, difference, fixed_part, scene_hash
from hakobune.pipelines.scene.scene import Scene, SceneError, make_scene

BEFORE = """\
tolerance = 0.01
rotation_center = [0.0, 0.0, 0.0]

[water]
depth = 20.0
density = 1025.0
gravity = 9.80665

[waves]
omegas = [0.4, 0.8]
headings_deg = [0.0, 45.0]

[[bodies]]
shape = "box"
length = 100.0
beam = 50.0
draft = 10.0
center_of_gravity = [0.0, 0.0, 0.0]
gyration = [15.0, 29.0, 32.0]
"""  # as it was written before scenes were by a library, without what was a default


class Later(Scene, kw_only=True, frozen=True):
    """A scene with a key that no file from before has"""

    ice: float = 0.0


def scene(old="", new="", kind=None):
    assert old in SCENE
    raw = tomllib.loads(SCENE.replace(old, new))
    return (
        make_scene(raw) if kind is None else kind(**{k: getattr(make_scene(raw), k) for k in Scene.__struct_fields__})
    )


def header(text, mesh=None, scene_hash="", **attributes):
    mesh = box(100, 50, 10, panels=40) if mesh is None else mesh
    return Header(mesh, None, 20.0, 1025.0, 9.8, np.zeros(3), np.zeros(0), {}, {}, text, scene_hash, attributes)


def test_lists_of_waves_and_products_do_not_change_what_a_database_is_of():
    of = header(to_toml(scene()))
    for change in (("[0.4, 0.8]", "[0.1]"), ("[0, 45]", "[90]"), ("tolerance", 'want = ["drift"]\ntolerance')):
        check_same(scene(*change), of, "box.h5")
        assert scene_hash(fixed_part(scene(*change))) == scene_hash(fixed_part(scene()))
    for change in (("20.0", "21.0"), ("draft = 10.0", "draft = 11.0"), ("0.01", "0.02")):
        with pytest.raises(SceneError, match=r"box.h5 belongs to another scene: .* was .*, is .*; give --fresh"):
            check_same(scene(*change), of, "box.h5")
        assert scene_hash(fixed_part(scene(*change))) != scene_hash(fixed_part(scene()))


@pytest.mark.parametrize(
    ("new", "words"),
    [
        ("gyration = [16.0, 29.0, 32.0]", "bodies[0].gyration was (15.0, 29.0, 32.0), is (16.0, 29.0, 32.0)"),
        ("gyration = [15.0, 29.0, 32.0]\nmass = 4e7", "bodies[0].mass was not given, is 40000000.0"),
    ],
)
def test_another_mass_changes_the_free_body_alone(new, words):
    one, other = scene(), scene("gyration = [15.0, 29.0, 32.0]", new)
    assert check_same(one, header(to_toml(one)), "box.h5") == ""
    assert check_same(other, header(to_toml(one)), "box.h5") == words
    deeper = make_scene(
        {**tomllib.loads(SCENE.replace("gyration = [15.0, 29.0, 32.0]", new)), "water": {"depth": 21.0}}
    )
    with pytest.raises(SceneError, match=r"water.depth was 20.0, is 21.0; bodies"):
        check_same(deeper, header(to_toml(one)), "box.h5")


def test_motions_that_are_stored_are_not_lost_for_want_of_gyration():
    without = scene("gyration = [15.0, 29.0, 32.0]\n", "")
    check_same(scene(), header(to_toml(without)), "box.h5")
    with pytest.raises(SceneError, match=r"gyration was .*, is not given; give --fresh"):
        check_same(without, header(to_toml(scene())), "box.h5")


def test_the_difference_of_two_scenes_is_named():
    said = difference(fixed_part(scene()), fixed_part(scene("depth = 20.0", "depth = 21.0")))
    assert said == "water.depth was 20.0, is 21.0"


def test_a_file_from_before_is_of_the_scene_that_its_text_means():
    check_same(scene(), header(BEFORE, scene_hash="of other keys"), "box.h5")
    with pytest.raises(SceneError, match=r"draft was 10.0, is 12.0; give"):
        check_same(scene("draft = 10.0", "draft = 12.0"), header(BEFORE, scene_hash="of other keys"), "box.h5")


def test_a_key_that_came_later_has_its_default_in_files_from_before(monkeypatch):
    now = scene()
    stored = header(to_toml(now), scene_hash=scene_hash(fixed_part(now)))
    monkeypatch.setattr(identity, "Scene", Later)
    later = scene(kind=Later)
    assert scene_hash(fixed_part(later)) != stored.scene_hash
    check_same(later, stored, "box.h5")
    with pytest.raises(SceneError, match=r"belongs to another scene: ice was 0.0, is 2.0; give --fresh"):
        check_same(Later(**{k: getattr(now, k) for k in Scene.__struct_fields__}, ice=2.0), stored, "box.h5")


@pytest.mark.parametrize(
    ("text", "words"), [("", "water"), ("a = [", "Invalid value"), (BEFORE + "ice = 1.0\n", "ice is unk")]
)
def test_a_stored_scene_that_cannot_be_read_is_refused_with_its_fault(text, words):
    with pytest.raises(SceneError, match=rf"box.h5 belongs to a scene that cannot be read: .*{words}.*; give --fresh"):
        check_same(scene(), header(text), "box.h5")


def of_mesh(file, depth=20.0):
    body = {"shape": "mesh", "file": str(file)}
    return make_scene({"water": {"depth": depth}, "bodies": [body], "waves": {"omegas": [1.0]}})


@pytest.mark.parametrize("stored", ["its hash", "its panels alone"])
def test_a_mesh_file_counts_by_its_content_wherever_it_lies(tmp_path, stored):
    first, moved, changed = (tmp_path / name for name in ("first.gdf", "moved.gdf", "changed.gdf"))
    write_mesh(box(100, 50, 10, panels=40), first)
    moved.write_bytes(first.read_bytes())
    write_mesh(box(100, 50, 11, panels=40), changed)
    attributes = {MESH_FILE: content(first)} if stored == "its hash" else {}
    of = header(to_toml(of_mesh(first)), read_mesh(first).whole(), **attributes)
    first.unlink()
    check_same(of_mesh(moved), of, "hull.h5")
    with pytest.raises(SceneError, match=r"hull.h5 belongs to another scene: the mesh file has changed; give --fresh"):
        check_same(of_mesh(changed), of, "hull.h5")
    with pytest.raises(SceneError, match=r"belongs to another scene: water.depth was 20.0, is 30.0; give --fresh"):
        check_same(of_mesh(moved, depth=30.0), of, "hull.h5")
    with pytest.raises(SceneError, match=r"shape was 'mesh', is 'box'; "):
        check_same(scene(), of, "hull.h5")


def test_every_body_and_every_number_of_a_scene_counts():
    """Of two bodies the second alone is moved, or has another draft; of a list in a table the last number differs"""
    body = {"shape": "box", "length": 40.0, "beam": 20.0, "draft": 5.0}

    def two(**second):
        bodies = [
            body | {"name": "a", "place": [0.0, 0.0, 0.0]},
            body | {"name": "b", "place": [60.0, 0.0, 0.0]} | second,
        ]
        return make_scene({"water": {"depth": 20.0}, "bodies": bodies, "waves": {"omegas": [1.0]}})

    of = header(to_toml(two()))
    check_same(two(), of, "two.h5")
    for change, words in (({"draft": 6.0}, r"bodies\[1\].draft was 5.0, is 6.0"),
                          ({"place": [60.0, 1.0, 0.0]}, r"bodies\[1\].place")):  # fmt: skip
        with pytest.raises(SceneError, match=f"belongs to another scene: {words}"):
            check_same(two(**change), of, "two.h5")
    flat = dict(identity._flat({"a": [1, {"b": [2, 3]}], "c": 4}))
    assert flat == {"a[0]": 1, "a[1].b[0]": 2, "a[1].b[1]": 3, "c": 4}
