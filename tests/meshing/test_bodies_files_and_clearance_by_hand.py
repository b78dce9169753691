"""Bodies of a mesh, files that are whole on the disk, and the depth of water under panels: by hand."""

import os

import numpy as np
import pytest

from hakobune.meshing import whole_files
from hakobune.meshing.hydrostatics import waterplane_area
from hakobune.meshing.panels import PanelMesh, assembled, joined
from hakobune.meshing.quality.findings import findings
from hakobune.meshing.shapes import box


def test_bodies_of_a_mesh_are_counted_and_taken_apart():
    one = box(4.0, 2.0, 1.0, counts=(1, 1, 1)).whole()
    three = assembled([one, one.moved(dx=10.0), one.moved(dx=20.0)])
    assert three.bodies == 3 and one.bodies == 1
    for number, low in enumerate((-2.0, 8.0, 18.0)):
        own = three.of_body(number)
        assert own.points[:, 0].min() == low and len(own) == len(one) and len(own.points) == len(np.unique(own.corners))
    assert one.of_body(0) is one
    assert PanelMesh(np.zeros((0, 3)), np.zeros((0, 4), int), body=np.zeros(0, int)).bodies == 0


def test_the_waterplane_is_that_of_the_whole_hull_whatever_part_is_meshed():
    for symmetry in ("", "x", "y", "xy"):
        for bottom in (True, False):
            mesh = box(4.0, 2.0, 1.0, counts=(1, 1, 1), symmetry=symmetry, bottom=bottom)
            assert waterplane_area(mesh) == pytest.approx(8.0), (symmetry, bottom)
            assert waterplane_area(mesh.flipped()) < 0 or not bottom


def test_long_panels_of_a_bottom_are_told_with_the_longest_and_the_least_water_under_them():
    """Plates facing down: 6 m long at 2 m over the bed, 9 m at 4 m, 3 m at 5 m; the last is shorter than its water"""

    def plate(x, length, z):
        return PanelMesh([[x, 0, z], [x + length, 0, z], [x + length, 1, z], [x, 1, z]], [[0, 3, 2, 1]])

    hull = joined([plate(0.0, 3.0, -5.0), plate(10.0, 6.0, -8.0), plate(20.0, 9.0, -6.0)])
    (said,) = [one.text for one in findings(hull, 10.0) if "depth of water under" in one.text]
    assert said.startswith("2 of 3 panels on the bottom longer than the depth of water under them: up to 9 m over 2 m;")


def test_a_file_is_on_the_disk_before_it_takes_the_place_of_another(monkeypatch, tmp_path):
    done = []
    real, place = os.replace, tmp_path / "a.txt"
    monkeypatch.setattr(os, "fsync", lambda number: done.append("synced"))
    monkeypatch.setattr(os, "replace", lambda *given: done.append("replaced") or real(*given))
    whole_files.write_whole(place, "text", b" and bytes")
    assert done == ["synced", "replaced"] and place.read_bytes() == b"text and bytes"
    assert [path.name for path in tmp_path.iterdir()] == ["a.txt"]
    with pytest.raises(RuntimeError), whole_files.made_beside(place) as partial:
        partial.write_text("half")
        raise RuntimeError
    assert place.read_bytes() == b"text and bytes" and [path.name for path in tmp_path.iterdir()] == ["a.txt"]


@pytest.mark.parametrize("able", [True, False])
@pytest.mark.parametrize("content", [b"", b"some bytes"])
def test_room_is_kept_where_the_system_can_and_the_content_stays(monkeypatch, tmp_path, able, content):
    path, asked = tmp_path / "a.bin", []
    path.write_bytes(content)
    if able:
        monkeypatch.setattr(os, "posix_fallocate", lambda *given: asked.append(given[1:]), raising=False)
    else:
        monkeypatch.delattr(os, "posix_fallocate", raising=False)
    whole_files.keep_room(path)
    assert path.read_bytes() == content and asked == ([(0, len(content))] if able and content else [])
    whole_files.keep_room(tmp_path / "missing")
    assert not (tmp_path / "missing").exists()
