"""Forces on the nodes of a lumped line for tests, by the kernels that its runs compile, whose arrays are borrowed."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.borrowed import borrowed
from hakobune.bem.kernels.jit import kernel
from hakobune.mooring.lines.dynamics.lumped.bending import OF_BENDING
from hakobune.mooring.lines.dynamics.lumped.forces import node_forces, stored_energy
from hakobune.mooring.lines.dynamics.lumped.workspace import copy, to_rows, workspace


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
    w = rows.shape[2]
    out = Loads(
        np.zeros((3, w)), np.zeros((9, w)), np.zeros((9, w)), np.zeros(6), np.zeros((OF_BENDING, w)), np.zeros(4)
    )
    _fill(system, rows, cq, cv, *out)
    return out


@kernel()
def _fill(system, rows, cq, cv, r, D, B, power, bending, energy):
    s = borrowed(system)
    room = workspace(s)
    work = borrowed(room)
    q, v, a, slip, since, u, du = borrowed((rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6]))
    copy(work.q, q)
    copy(work.v, v)
    copy(work.u, u)
    copy(work.du, du)
    node_forces(s, work, a, slip, since, cq, cv)
    copy(r, work.r)
    for j in range(D.shape[1]):
        for i in range(9):
            D[i, j], B[i, j] = work.D[i, j], work.B[i, j]
    for i in range(power.size):
        power[i] = work.power[i]
    _keep(bending, work.bending)
    energy[0], energy[1], energy[2], energy[3] = stored_energy(s, work.q, work.v)
    rows[0, 0, 0], room.power[0] = rows[0, 0, 0], 0.0  # kept until here, see `borrowed`


@kernel()
def _keep(out, bending):
    if bending.shape[1] == out.shape[1]:
        for j in range(out.shape[1]):
            for i in range(out.shape[0]):
                out[i, j] = bending[i, j]
