"""Forces on the nodes of a lumped line for tests, by the kernels that its runs compile."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.jit import kernel
from hakobune.mooring.lines.dynamics.lumped.bending import OF_BENDING
from hakobune.mooring.lines.dynamics.lumped.forces import node_forces, stored_energy
from hakobune.mooring.lines.dynamics.lumped.workspace import to_rows, workspace


class Loads(NamedTuple):
    """As in `lumped.workspace.Work`; energy : (4,) J of `stored_energy`"""

    r: np.ndarray
    D: np.ndarray
    B: np.ndarray
    power: np.ndarray
    bending: np.ndarray
    energy: np.ndarray


def loads(system, q, v=None, a=None, slip=None, since=None, u=None, du=None, cq=0.0, cv=0.0):
    """Loads on nodes of a System at q with velocity v and acceleration a, all (n, 3), none of it moving if not given

    slip, since : of the bed's friction, since : q if not given; u, du : of the water
    """
    given = [q, v, a, slip, q if since is None else since, u, du]
    rows = np.array([to_rows(np.zeros_like(q) if one is None else np.asarray(one, float)) for one in given])
    work, energy = workspace(system), np.zeros(4)
    work.q[:], work.v[:], work.u[:], work.du[:] = rows[0], rows[1], rows[5], rows[6]
    _fill(system, work, rows, cq, cv, energy)
    bending = work.bending if work.bending.size else np.zeros((OF_BENDING, rows.shape[2]))
    return Loads(work.r, work.D, work.B, work.power, bending, energy)


@kernel(counted=False)
def _fill(s, work, rows, cq, cv, energy):
    node_forces(s, work, rows[2], rows[3], rows[4], cq, cv)
    energy[0], energy[1], energy[2], energy[3] = stored_energy(s, work.q, work.v)
