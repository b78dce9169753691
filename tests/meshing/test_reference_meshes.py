from pathlib import Path

import numpy as np
import pytest

from hakobune.meshing.files import read_mesh
from hakobune.meshing.quality import findings

FOLDER = Path(__file__).parents[2] / "meshes"


@pytest.mark.parametrize(
    ("name", "panels", "volume"), [("box_100x50x10.gdf", 244, 50000.0), ("buoy_r10_d10.gdf", 240, 1000 * np.pi)]
)
def test_reference_meshes_are_what_their_readme_says(name, panels, volume):
    mesh = read_mesh(FOLDER / name)
    assert mesh.total == panels
    assert mesh.volume == pytest.approx(volume, rel=1e-6)  # digits of the file
    assert not [f for f in findings(mesh, 30.0) if f.severity == "error"]


def test_every_mesh_is_in_the_readme():
    text = (FOLDER / "README.md").read_text()
    assert all(f.name in text for f in FOLDER.iterdir() if f.suffix != ".md")
