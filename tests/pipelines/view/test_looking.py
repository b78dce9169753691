"""Pictures of meshes and pressures: what is shown, whether all of it, and what is refused."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.database import extend, writing
from hakobune.bem.database.integrity import crc
from hakobune.meshing.files import write_mesh
from hakobune.meshing.lid import lid
from hakobune.meshing.shapes import box, buoy
from hakobune.pipelines.cli import main
from hakobune.pipelines.scene.scene import SceneError
from hakobune.pipelines.view.looking import FIELDS, Picture, _pressure, drawn

BUOY, BOX = buoy(10, 8, panels=60), box(100, 50, 10, panels=60)


class Pressures(SimpleNamespace):
    """As much of a database as a picture of a pressure takes"""

    omega = np.array([0.3, 0.6, 0.9])
    wave_direction = np.radians([0.0, 45.0, 90.0])
    path, mesh, water_depth, inertia_matrix = Path("b.h5"), BOX, 20.0, None

    def __getitem__(self, name):
        i, j = np.ogrid[:3, :3]
        return (10.0 * i + j)[..., None] * np.ones(BOX.total)


def shown(omega, heading):
    """(number of the frequency, number of the heading) in the picture"""
    return divmod(int(_pressure(Pressures(), Path("b.h5"), omega, heading).field[0]), 10)


@pytest.mark.parametrize("heading", [180, 30, -45, 45.001])
def test_a_heading_that_is_not_stored_is_refused_with_those_that_are(heading):
    with pytest.raises(SceneError) as refused:
        shown(0.6, heading)
    line = str(refused.value)
    assert f"--heading is {heading:g}; stored in b.h5: 0, 45, 90 degrees; " in line and "give one of these" in line


def test_a_stored_heading_is_found_whole_turns_away_and_through_its_rounding():
    assert [shown(0.6, heading) for heading in (45, -315, 45 + 1e-7, 360)] == [(1, 1), (1, 1), (1, 1), (1, 0)]


def test_many_stored_headings_are_summed_up():
    db = Pressures(wave_direction=np.radians(np.arange(0.0, 360.0, 5.0)))
    with pytest.raises(SceneError, match=r"0, 5, .*, 55 … 355 \(72 in all\) degrees"):
        _pressure(db, Path("b.h5"), 0.6, 3)


def test_the_nearest_frequency_is_named_where_it_is_another(capsys):
    assert shown(0.62, 0) == (1, 0)
    assert capsys.readouterr().out == "note: omega 0.62 rad/s is not stored; the nearest, 0.6 rad/s, is shown\n"
    assert shown(0.6, 0) == (1, 0)
    assert capsys.readouterr().out == ""


@pytest.mark.parametrize("name", ["empty.h5", "foreign.h5", "text.gdf", "empty.toml"])
def test_a_bad_file_is_named_before_the_display(name, tmp_path, monkeypatch, capsys):
    import h5py

    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    Path(name).write_text("notes\n" if name == "text.gdf" else "")
    if name == "foreign.h5":
        with h5py.File(name, "w") as file:
            file["x"] = 1.0
    assert main(["look", name]) == 2
    said = capsys.readouterr().err
    assert "display" not in said and (name in said or "water.depth is missing" in said), said


def picture_of(picture):
    """(900, 1400, 3) of whole numbers"""
    plotter = drawn(picture)
    image = np.array(plotter.screenshot(return_img=True), int)
    plotter.close()
    return image


@pytest.mark.parametrize("depth", [12.0, 30.0, 100.0, 1000.0, np.inf])
@pytest.mark.parametrize("mesh", [BUOY, BOX], ids=lambda mesh: mesh.name)
@pytest.mark.parametrize("field", [None, "area"])
def test_the_picture_holds_the_whole_body_and_the_whole_bed(mesh, depth, field):
    pytest.importorskip("pyvista")
    values = FIELDS[field][1](mesh) if field else None
    image = picture_of(Picture(mesh, lid(mesh), depth, values, "m²"))
    background = image[:, :1]  # it changes from above to below only
    border = (image[:2] - background[:2], image[-2:] - background[-2:], image[:, -2:] - background)
    assert max(np.abs(part).max() for part in border) <= 1
    assert np.abs(image - background)[300:600].max() > 50  # something is there


def test_a_mesh_turned_inside_out_is_said(tmp_path, capsys):
    path = tmp_path / "inward.gdf"
    write_mesh(box(40, 10, 5, panels=40).flipped(), path)
    assert main(["look", str(path), "--plot", str(tmp_path / "inward.png")]) == 1
    assert "point into the body (volume" in capsys.readouterr().out


@pytest.mark.parametrize("title", [*(name for name, _ in FIELDS.values()), "Pa/m"])
def test_titles_of_colour_bars_end_inside_the_picture(title):
    pytest.importorskip("pyvista")
    image = picture_of(Picture(BOX, field=BOX.areas, field_name=title))
    assert np.abs(image[:, -2:] - image[:, :1]).max() <= 1


def test_a_page_is_whole_or_says_what_it_needs(tmp_path, capsys):
    import importlib.util

    write_mesh(box(40, 10, 5, panels=40), tmp_path / "box.gdf")
    page = tmp_path / "box.html"
    status = main(["look", str(tmp_path / "box.gdf"), "--page", str(page)])
    if importlib.util.find_spec("trame_pyvista"):
        assert status == 0 and "<html" in page.read_text(encoding="utf-8")
    else:
        assert status == 2 and "pip install 'hakobune[page]'" in capsys.readouterr().err and not page.exists()
    assert main(["look", str(tmp_path / "box.gdf"), "--page", str(tmp_path / "box.txt")]) == 2
    assert "allowed: .html" in capsys.readouterr().err


def test_what_a_database_lacks_is_said_of_it_and_a_field_without_a_number_is_refused(tmp_path, capsys):
    pytest.importorskip("pyvista")
    path, picture = tmp_path / "box.h5", tmp_path / "box.png"
    words = (
        "box --length 20 --beam 10 --draft 3 --depth 12 --panels 60 --omega 0.8 --heading 0 --only pressure,added_mass"
    )
    assert main([*words.split(), "--output", str(path)]) == 0
    with writing(path) as file:
        file["pressure"][...] = np.nan  # none is stored by us: a file of another program
        file["stored/pressure"][0, 0] = crc(file["pressure"][0, 0])
    capsys.readouterr()
    look = ["look", str(path), "--plot", str(picture)]
    assert main(look) == 1
    assert "FAILS: " in (said := capsys.readouterr().out) and "pressure is not a number at all frequencies" in said
    assert main([*look, "--field", "pressure", "--omega", "0.8", "--heading", "0"]) == 2
    assert "is not a number on any panel" in capsys.readouterr().err
    extend(path, omega=(1.0,))
    assert main(look) == 1
    assert "1 of 2 frequencies are not solved, 1 rad/s" in capsys.readouterr().out
