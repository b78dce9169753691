"""What tests of lines share."""

import numpy as np
import pytest
from node_loads import loads

STEP = 1e-4  # of a central difference


@pytest.fixture
def tangent_fault():
    """How far the tangent of the forces on a moving line's nodes is from their difference, over its largest number

    A function of a System, the place, speed and acceleration of its nodes (n, 3), a direction (n, 3) of accelerations,
    the place of the nodes before and the factors by which accelerations move and speed them.
    """

    def fault(system, place, speed, acceleration, direction, since, cq, cv):
        n = len(place)

        def forces(step):
            moved, faster = place + cq * step * direction, speed + cv * step * direction
            return loads(system, moved, faster, acceleration + step * direction, since=since, cq=cq, cv=cv)

        here, ahead, back = (forces(step) for step in (0.0, STEP, -STEP))
        D, B = here.D[:, :n].reshape(3, 3, -1), here.B[:, 1:n].reshape(3, 3, -1)
        product = np.einsum("ijn,nj->ni", D, direction)
        product[1:] -= np.einsum("ijn,nj->ni", B, direction[:-1])
        product[:-1] -= np.einsum("ijn,nj->ni", B, direction[1:])
        difference = -(ahead.r - back.r)[:, :n].T / (2 * STEP)
        return np.abs(product - difference).max() / np.abs(difference).max()

    return fault
