"""Values of several bodies along the axes of the scene, and of a database as far as it can be carried."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.bem.formats import values as module
from hakobune.bem.formats.values import Values, values_of
from hakobune.bem.modes import Body

BODIES = Body("one", heading=np.pi / 2), Body("two", fixed=True)


def test_what_a_turned_body_says_along_its_own_axes_is_told_along_those_of_the_scene():
    """Its surge is sway of the scene, its sway −surge; what is fixed has forces and no motions"""
    A = np.zeros((1, 12, 6))
    A[0, 0, 0], A[0, 1, 0], A[0, 7, 0] = 5.0, 2.0, 3.0  # along own axes: surge and sway of surge; sway of the other
    X = np.zeros((1, 1, 12), complex)
    X[0, 0, [0, 3, 7]] = 1.0, 2.0, 4.0
    rao = np.stack([np.arange(6.0).reshape(1, 6) + 0j, np.full((1, 6), np.nan)])  # the second is not solved
    limits = {"added_mass_zero": np.full((12, 6), np.inf), "added_mass_infinity": A[0]}
    body = {"inertia_matrix": np.eye(12, 6) * np.arange(1.0, 7.0), "mass": np.array([7.0])}
    quantities = {"added_mass": A, "excitation_force": X, "rao": rao} | limits
    found = module._along_scene(Values(np.ones(1), np.zeros(1), 9.0, 1e3, 10.0, quantities, body, bodies=BODIES))
    assert found.get("added_mass")[0, [1, 0, 7], 1] == pytest.approx([5.0, -2.0, 3.0])
    assert found.get("excitation_force")[0, 0, [1, 4, 7]] == pytest.approx([1.0, 2.0, 4.0])
    assert np.isnan(found.get("rao")[1]).all() and found.get("rao")[0, 0, :2] == pytest.approx([-1.0, 0.0])
    assert found.get("added_mass_zero") is None and found.get("added_mass_infinity")[1, 1] == pytest.approx(5.0)
    assert found.get("inertia_matrix").diagonal() == pytest.approx([2, 1, 3, 5, 4, 6])


class Stored(dict):
    """A database that stores what it is made of"""

    names = ("added_mass", "added_mass_zero", "kochin_radiation", "pressure", "rao")
    bodies, path = (), SimpleNamespace(stem="a")
    omega, wave_direction, complete = [1.0], [0.0], True
    header = SimpleNamespace(water_depth=9.0, density=1e3, gravity=10.0, rotation_center=(1, 2, 3), mesh=None,
                             body={"mass": 3.0, "center_of_mass": None, "inertia_matrix": np.eye(6)})  # fmt: skip

    def require_rigid(self):
        pass

    def require_one_body(self):
        if self.bodies:
            raise ValueError("several")


def test_a_database_is_carried_without_far_field_and_pressure_and_its_limits_when_it_is_complete():
    db = Stored({name: name.encode() for name in Stored.names})
    found = values_of(db)
    assert found.quantities == {name: name.encode() for name in ("added_mass", "added_mass_zero", "rao")}
    assert set(found.body) == {"mass", "inertia_matrix"} and found.name == "a" and found.omega.tolist() == [1.0]
    assert found.rotation_center.tolist() == [1.0, 2.0, 3.0] and (found.density, found.gravity) == (1e3, 10.0)
    db.complete = False
    assert set(values_of(db).quantities) == {"added_mass", "rao"}
    db.bodies = BODIES
    with pytest.raises(ValueError, match="several"):
        values_of(db)
