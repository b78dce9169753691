"""Planes of an imported hull: one heading gives its images, unless other bodies lie beside."""

import numpy as np
import pytest

from hakobune.bem.database import open_database
from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.formats.values import Values
from hakobune.meshing.shapes import box, buoy
from hakobune.pipelines.exchange import importing

OMEGA = np.array([0.6, 0.8, 1.0])
FORCE = np.array([1.0 + 2j, 0, 3.0 - 1j, 0, 5.0 + 4j, 0])  # of waves towards 180°, which have no sides


def a_set(others=0):
    square = np.tile(np.diag([2.0, 2, 3, 4, 4, 1]), (3, 1, 1))
    forces = np.tile(FORCE, (3, 1, 1))
    return Values(OMEGA, np.array([np.pi]), 30.0, 1025.0, 9.8, {
        "added_mass": square, "radiation_damping": 0.1 * square, "excitation_force": forces,
        "Froude_Krylov_force": forces, "diffraction_force": 0 * forces,
    }, others=others)  # fmt: skip


def stored(tmp_path, hull, others=0):
    importing.store(a_set(others), hull, tmp_path / "a.h5", "wamit: a.1")
    return open_database(tmp_path / "a.h5")


def test_a_box_drawn_whole_in_waves_from_one_end_is_in_waves_from_the_other_too(tmp_path):
    """Mirrored at x = 0: surge and pitch change sign; other headings are in no plane"""
    db = stored(tmp_path, box(10, 6, 3, panels=100).whole())
    assert db.symmetry == "xy" and not db.is_round and db.mesh.total == len(box(10, 6, 3, panels=100).whole())
    found = db.reader.forces([0.8], [0.0])
    assert found[0, 0] == pytest.approx(FORCE * (-1, 1, 1, 1, -1, 1))
    with pytest.raises(BetweenError, match="does not lie between stored headings"):
        db.reader.forces([0.8], [np.pi / 2])


def test_a_round_hull_drawn_with_three_decimals_is_turned_to_any_wave(tmp_path):
    whole = buoy(4.0, 2.0, panels=150).whole()
    db = stored(tmp_path, type(whole)(np.round(whole.points, 3), whole.corners))
    assert db.is_round
    found = db.reader.forces([0.8], [np.pi / 2])[0, 0]
    assert found == pytest.approx([0, -FORCE[0], FORCE[2], FORCE[4], 0, 0])


def test_beside_other_bodies_nothing_is_turned_or_mirrored(tmp_path):
    db = stored(tmp_path, buoy(4.0, 2.0, panels=150).whole(), others=1)
    assert db.symmetry == "" and not db.is_round
    for to in (0.0, np.pi / 2):
        with pytest.raises(BetweenError, match="does not lie between stored headings"):
            db.reader.forces([0.8], [to])
    assert db.reader.forces([0.8], [np.pi])[0, 0] == pytest.approx(FORCE)
