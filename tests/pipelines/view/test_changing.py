"""`hakobune mesh`: what is cut, scaled, moved and mirrored has the volume that geometry says, and stays closed."""

import numpy as np
import pytest

from hakobune.meshing.files import read_mesh, write_mesh
from hakobune.meshing.hydrostatics import hydrostatics
from hakobune.meshing.panels import PanelMesh
from hakobune.meshing.quality import findings
from hakobune.meshing.shapes import box
from hakobune.pipelines import cli

CUBE = np.array([[x, y, z] for z in (-1.0, 1.0) for y in (-1.0, 1.0) for x in (-1.0, 1.0)])
FACES = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]


def turned(angle, about):
    """A cube of 2 m whose middle is 0.25 m under water, turned about an axis through it"""
    axis = np.array(about) / np.linalg.norm(about)
    S = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    R = np.eye(3) + np.sin(angle) * S + (1 - np.cos(angle)) * S @ S
    return PanelMesh(CUBE @ R.T - [0, 0, 0.25], FACES)


@pytest.mark.parametrize("about", [(1, 0, 0), (1, 1, 0), (2, 1, 0.5)])
@pytest.mark.parametrize("angle", [0.3, 0.8, 1.4])
def test_the_part_below_the_surface_is_closed_by_its_waterplane(angle, about):
    below = turned(angle, about).clipped()
    still = hydrostatics(below)
    assert still.volume_difference <= 1e-12 and below.points[:, 2].max() == 0.0
    above = turned(angle, about)
    above = PanelMesh(above.points * [1, 1, -1], above.corners[:, ::-1]).clipped()
    assert still.volume + hydrostatics(above).volume == pytest.approx(8.0, rel=1e-12)


def test_a_hull_in_millimetres_with_its_deck_becomes_the_box(tmp_path, capsys):
    whole = PanelMesh(CUBE * [50e3, 25e3, 8e3] + [0, 0, 2e3], np.array(FACES)[:, ::-1])
    write_mesh(whole, tmp_path / "mm.vtu")
    words = ["mesh", str(tmp_path / "mm.vtu"), "--scale", "0.001", "--move", "0,0,-4", "--flip", "--clip"]
    assert cli.main([*words, "--output", str(tmp_path / "box.gdf")]) == 0
    made = read_mesh(tmp_path / "box.gdf")
    assert made.volume == pytest.approx(100 * 50 * 10, rel=1e-12) and not [
        f for f in findings(made) if "normal" in f.text
    ]
    assert cli.main(["mesh", str(tmp_path / "box.gdf"), "--output", str(tmp_path / "box.gdf")]) == 2
    assert "is the mesh itself" in capsys.readouterr().err


def test_half_a_hull_is_mirrored_and_a_whole_one_folded(tmp_path, capsys):
    quarter = box(40, 20, 5, panels=60)
    half = PanelMesh(quarter.points, quarter.corners, "x").whole()
    write_mesh(half, tmp_path / "half.vtu")
    assert cli.main(["mesh", str(tmp_path / "half.vtu"), "--mirror", "y", "--output", str(tmp_path / "whole.msh")]) == 0
    assert read_mesh(tmp_path / "whole.msh").volume == pytest.approx(4000.0)
    assert cli.main(["mesh", str(tmp_path / "whole.msh"), "--fold", "--output", str(tmp_path / "part.gdf")]) == 0
    part = read_mesh(tmp_path / "part.gdf")
    assert part.symmetry == "xy" and len(part) == len(quarter)
    for words, said in (
        (["--mirror", "y"], "both sides of y = 0"),
        (["--mirror", "z"], "allowed: x, y, xy"),
        (["--scale", "-1"], "one or three factors"),
        (["--move", "1,2"], "three distances"),
        (["--move", "0,0,9", "--clip"], "the hull has no part below"),
    ):
        assert cli.main(["mesh", str(tmp_path / "whole.msh"), *words, "--output", str(tmp_path / "no.gdf")]) == 2
        assert said in capsys.readouterr().err and not (tmp_path / "no.gdf").exists()
