import numpy as np
import pytest

from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy
from hakobune.meshing.view import scene, show

pytest.importorskip("pyvista")


def test_a_picture_is_written_without_a_display(tmp_path, monkeypatch):
    from matplotlib.image import imread

    monkeypatch.delenv("DISPLAY", raising=False)
    hull = buoy(10, 10, panels=100)
    path = tmp_path / "hull.png"
    plotter = scene(hull, lid(hull), field=hull.areas, field_name="area, m²", depth=30.0, off_screen=True)
    show(plotter, "buoy", path)
    picture = imread(path)
    assert picture.shape[0] > 500
    assert picture.shape[1] > 500
    assert np.ptp(picture[..., :3]) > 0.5  # not an empty frame


def test_the_scene_shows_the_whole_hull():
    hull = box(100, 50, 10, panels=124)
    plotter = scene(hull, off_screen=True)
    low, high = np.reshape(plotter.bounds, (3, 2)).T
    plotter.close()
    assert np.all(low[:2] <= (-50, -25))
    assert np.all(high[:2] >= (50, 25))


def test_a_field_has_one_value_a_panel():
    with pytest.raises(ValueError, match=r"field has shape \(3,\); allowed: \(31,\) or \(124,\)"):
        scene(box(100, 50, 10, panels=124), field=np.zeros(3), off_screen=True)
