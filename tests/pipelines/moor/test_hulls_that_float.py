"""A hull at the surface without a stiffness in heave cannot be moored: the first line says why."""

from types import SimpleNamespace

import numpy as np
import pytest

from hakobune.meshing.shapes import box
from hakobune.pipelines.common.quantities import StudyError
from hakobune.pipelines.moor.study import check_floats

HULL = box(20, 10, 4, panels=60)


def database(heave, up=0.0, bodies=()):
    stiffness = np.diag([0.0, 0.0, heave, 1.0, 1.0, 0.0])
    return SimpleNamespace(bodies=bodies, hydrostatic_stiffness=stiffness, mesh=HULL.moved(dz=up), path="a.h5")


@pytest.mark.parametrize("up", [0.0, 0.5])
def test_a_hull_at_the_surface_has_a_stiffness_in_heave(up):
    check_floats(database(1.0, up))
    for heave in (0.0, -1.0):
        with pytest.raises(
            StudyError,
            match=f"hydrostatics: .* of a.h5 has a stiffness in heave of {heave:g} N/m, .* z = {up:g} m, .* --clip",
        ):
            check_floats(database(heave, up))


def test_a_hull_below_the_surface_and_one_of_several_need_none():
    check_floats(database(0.0, -1.0))
    check_floats(database(0.0, bodies=("a", "b")))
    check_floats(SimpleNamespace(bodies=(), hydrostatic_stiffness=None, mesh=HULL))
    check_floats(SimpleNamespace(bodies=(), hydrostatic_stiffness=np.zeros((6, 6)), mesh=None))
