"""Moving lines at rest: their pull, and their state at the start of a run."""

import numpy as np

from hakobune.bem.kernels.jit import kernel

from ...lines.dynamics.lumped.forces import node_forces
from ...lines.dynamics.lumped.system import State
from ...lines.dynamics.lumped.workspace import read, workspace
from ...lines.dynamics.run import FIRST
from .packed import ROWS, MovingWork, Room
from .polynomial import TERMS


def moving_work(moving, states, samples, lines, sampled, shapes=(0, 0)):
    """`MovingWork` of lines at rest in their `states`, with room for the given number of samples

    lines : total number of lines, including lines in their static shape
    sampled : (number of bodies, number of values stored for each body in a sample); shapes : (number of shapes,
        number of groups)
    """
    count, bodies = len(moving.number), sampled[0]
    kept = [np.stack([np.concatenate([state[i] for state in states])] * 2) for i in range(1, 5)]
    pull = np.array([state_pull(moving, i, state) for i, state in enumerate(states)]).reshape(-1, 3)
    before = np.column_stack([np.full(count, -1.0), pull])
    last = np.zeros((lines, TERMS, 3))
    last[moving.number, 0] = pull
    return MovingWork(
        *kept,
        np.full((2, count), FIRST),
        np.zeros((count, 3, 2, 3)),
        np.zeros((count, ROWS)),
        np.zeros((count, ROWS, 3)),
        np.zeros((count, ROWS, 3)),
        np.zeros(count, np.int64),
        before,
        np.zeros((bodies, 12)),
        last,
        np.ones(1),
        np.zeros(sampled),
        np.zeros(6 * (bodies + shapes[1])),
        np.zeros((2, 2, shapes[0])),
        Room(np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros(6)),
        np.zeros((samples, count)),
        np.zeros(count, np.int64),
        np.full(1, -1),
    )


def state_pull(moving, i, state: State):
    """Pull of line i on its fairlead at rest, N; shape (3,)"""
    pull = np.zeros(3)
    pull_at_rest(moving.systems[i], workspace(moving.systems[i]), *state[1:5], pull)
    return pull


@kernel(counted=False)
def pull_at_rest(s, work, q, v, a, slip, out):
    """Fill out (3,), pull, N, of a line's System at rest with its nodes at q (n, 3) m; work : a new `workspace` of
    the line
    """
    here, held, last = work.kept[0], work.kept[1], q.shape[0] - 1
    read(work.q, q)
    read(work.v, v)
    read(here, a)
    read(held, slip)
    node_forces(s, work, here, held, work.q, 0.0, 0.0)
    for k in range(3):
        out[k] = work.r[k, last]
