"""A ship for a tolerance has the added mass of roll of much finer panels, whose bilge is round."""

import numpy as np
import pytest

import hakobune

# kg m², about the waterline, at 0.5 rad/s: meshes of 1 288, 1 564 and 2 024 panels with 3, 6 and 10 on the bilge have
# 5.325e9, 5.412e9 and 5.432e9; with one, from 1 104, it has 4.63e9
ROLL = 5.44e9
SCENE = """
tolerance = 0.1
[water]
depth = 28.0
[[bodies]]
shape = "ship"
length = 230.0
beam = 40.0
draft = 14.0
block = 0.82
GM = 4.0
gyration = [14.0, 57.5, 57.5]
[waves]
omegas = [0.5]
headings_deg = [90]
"""


def test_the_bilge_of_a_ship_is_round_enough_for_its_tolerance(tmp_path):
    """As many panels as a tolerance of 10 % asks for; the stated error is a third of the true one or more"""
    scene = tmp_path / "ship.toml"
    scene.write_text(SCENE)
    db = hakobune.solve(scene, tmp_path / "ship.h5")
    found, stated = (float(np.asarray(db[name])[0, 3, 3]) for name in ("added_mass", "estimated_error/added_mass"))
    print(found, stated)
    assert found == pytest.approx(ROLL, rel=0.03)
    assert abs(found - ROLL) < 3 * stated + 2e-3 * ROLL
