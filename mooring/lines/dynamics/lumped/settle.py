"""Static equilibrium of the nodes from a guess: Newton's method made safe by mass.

    (m/τ² + K) δ = F(q), where τ grows while the residual falls: pseudo-transient continuation (Kelley & Keyes 1998)

At small τ the line falls for a moment and is stopped; at large τ the step is Newton's.
"""

import math

import numpy as np

from hakobune.bem.kernels.jit import kernel

from .band import factor_line
from .forces import node_forces
from .stage import correction
from .surroundings import water_at
from .workspace import add, copy, largest_of, read, write

PASSES = 400
LIMIT = 1e-10  # last correction, relative to the largest tension and to the line's length
ROUNDING = 1e-14  # rounding of the distance of two nodes, over the line's length


@kernel(counted=False)
def settle(s, work, water, q, slip):
    """Move the inner nodes of q (n, 3) into equilibrium; returns the number of passes, or −1 if it was not reached.

    s, work : `System` of the line, and its `workspace`, new; water : None for still water
    """
    last, before = q.shape[0] - 1, np.inf
    still, held, at = work.kept[0], work.kept[1], work.kept[2]
    read(held, slip)
    read(at, q)
    length, shortest, longest, stiffest = 0.0, np.inf, 0.0, 0.0
    for e in range(last):
        one = s.length[e]
        length, shortest, longest = length + one, min(shortest, one), max(longest, one)
        stiffest = max(stiffest, s.stiffness[e] / one)
    heaviest = largest_of(s.weight)
    tau, noise, passes = 0.3 * math.sqrt(longest), ROUNDING * length * stiffest, -1
    for count in range(PASSES):
        copy(work.q, at)
        if water is not None:
            water_at(water, at, last + 1, 0.0, work.u, work.du)
        node_forces(s, work, still, held, at, tau * tau, tau)
        factor_line(work.D, work.B, work.bending, work.pivots, last)
        tension, distance = correction(work, last, tau * tau)
        if not (math.isfinite(tension) and math.isfinite(distance)):
            break
        share = min(1.0, 0.5 * shortest / distance) if distance > 0.0 else 1.0
        add(at, share * tau * tau, work.x)
        write(q, at)
        most = max(largest_of(work.T), heaviest)
        size = max(tension / most, distance / length)
        if size <= LIMIT + noise / most and tau >= 1.0:
            passes = count + 1
            break
        tau = min(tau * (3.0 if size < before and share == 1.0 else 0.5), 1e4)
        tau = max(tau, 1e-3)
        before = size
    return passes
