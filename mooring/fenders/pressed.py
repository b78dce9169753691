"""A linear system that compresses fenders, in time: ż = A z + B R(δ), δ = P z − gap(t), R with its hysteresis.

By Gauss's method with two stages: fourth order, stable for any decay in A, quadratic energies conserved to rounding.
Both stages z_i = F z + G R, with the reactions R at both, are found by iteration.
"""

import numpy as np

from .fender import FenderError
from .hysteresis import advanced_one, contact_table, reaction_of

GAUSS = np.array([[1 / 4, 1 / 4 - np.sqrt(3) / 6], [1 / 4 + np.sqrt(3) / 6, 1 / 4]])
NODES = GAUSS.sum(axis=1)  # Gauss nodes of a step
ITERATIONS = 60


class Pressed:
    """A (m, m), B (m, k), place P (k, m) of the module; fenders : k of `fender.Fender`; h : length of all steps, s"""

    def __init__(self, A, B, place, fenders, h):
        self.A, self.B, self.place, self.h = A, B, place, h
        self.table, self.k = contact_table(fenders), len(fenders)
        resolvent = np.linalg.inv(np.eye(2 * len(A)) - h * np.kron(GAUSS, A))
        self.from_z = resolvent @ np.tile(np.eye(len(A)), (2, 1))
        self.from_force = h * resolvent @ np.kron(GAUSS, B)
        self.both = np.kron(np.eye(2), place)
        self.answer = self.both @ self.from_force

    def rows(self, z, gap, gaps):
        """For each step from z (m,): z, deflection (k,) m (below 0 without contact), state (k,) of `hysteresis`,
            next stages (2, m).

        The fenders are initially free.

            gap : initial gaps, (k,) m; gaps : (3, k) m, at both `NODES` and at the end of every step
            raises : FenderError where the steps are too long
        """
        state, start = [1.0] * self.k, self.place @ z - gap
        for near, far, end in gaps:
            after, stages = self._step(z, state, start, np.concatenate([near, far]))
            yield z, start, state, stages
            z, before, start = after, start, self.place @ after - end
            lengths = self.table.marks[:, 0]
            state = [advanced_one(state[j], before[j], start[j], lengths[j]) for j in range(self.k)]

    def _step(self, z, state, start, gap):
        """z and stages (2, m) of a step"""
        free = self.both @ (self.from_z @ z) - gap
        force = self._reactions(state, start, free)
        for _ in range(ITERATIONS):
            before, force = force, self._reactions(state, start, free + self.answer @ force)
            if np.abs(force - before).max() <= 1e-13 * np.abs(force).max():
                break
        else:
            raise FenderError(f"a step of {self.h:.3g} s is too long for the stiffness of the fender; use more steps")
        stages = (self.from_z @ z + self.from_force @ force).reshape(2, -1)
        both = force.reshape(2, -1)
        return z + 0.5 * self.h * (self.A @ stages.sum(axis=0) + self.B @ both.sum(axis=0)), stages

    def _reactions(self, state, start, deflection):
        """Reactions at deflections (2k,) of both stages, of fenders with `state` at `start` (k,), N; shape (2k,)"""
        out = []
        for i, after in enumerate(deflection):
            j = i % self.k
            s = advanced_one(state[j], start[j], after, self.table.marks[j, 0])
            out.append(reaction_of(self.table, j, after, s))
        return np.array(out)
