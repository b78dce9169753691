"""Compiled rate and force of `memory`: each takes 0.1 µs for 60 states, for any number of motions."""

from typing import NamedTuple

import numpy as np

from ..kernels.in_memory import in_memory
from ..kernels.jit import kernel


@in_memory
class MemoryArrays(NamedTuple):
    """Contiguous arrays for the kernels: decay, 1/s, (n,), turn, rad/s, (p,), input and output, (6N, n), of `memory`"""

    decay: np.ndarray
    turn: np.ndarray
    input: np.ndarray
    output: np.ndarray


@kernel(counted=False)
def memory_rate(memory, states, velocity, rate, body=0):
    """Write ẋ into rate (n,), as `Memory.rate`.

    memory : `MemoryArrays`; states : (n,); velocity : velocity of the body with index `body`, m/s and rad/s, (6,)
    """
    n, p, f = len(memory.decay), len(memory.turn), 6 * body
    first, second = n - 2 * p, n - p
    u, v, w, a, b, c = velocity[0], velocity[1], velocity[2], velocity[3], velocity[4], velocity[5]
    into = memory.input
    for k in range(n):
        driven = into[f, k] * u + into[f + 1, k] * v + into[f + 2, k] * w
        driven += into[f + 3, k] * a + into[f + 4, k] * b + into[f + 5, k] * c
        rate[k] = driven + (rate[k] if body > 0 else -memory.decay[k] * states[k])
    for i in range(p if body == 0 else 0):
        rate[first + i] += memory.turn[i] * states[second + i]
        rate[second + i] -= memory.turn[i] * states[first + i]


@kernel(inline=True, counted=False)
def memory_force(memory, states, force, body=0):
    """Write y, N and N m, the force on the body with index `body` against its motion, into force (6,), as
    `Memory.force`.

    memory : `MemoryArrays`; states : (n,)
    """
    x = y = z = a = b = c = 0.0  # six sums side by side: one after the other each would wait for its own last digit
    out = memory.output
    f = 6 * body
    for k in range(len(states)):
        s = states[k]
        x, y, z = x + out[f, k] * s, y + out[f + 1, k] * s, z + out[f + 2, k] * s
        a, b, c = a + out[f + 3, k] * s, b + out[f + 4, k] * s, c + out[f + 5, k] * s
    force[0], force[1], force[2], force[3], force[4], force[5] = x, y, z, a, b, c
