"""First-order waves of several bodies on panels, as forces of pairs on each of them need them.

Squares of first order are integrated over each hull by itself.  The bound wave and the potential that moving hulls make
push a body a as Haskind's relation says, with ψ the radiation potential of a motion of a, over the hulls of all bodies:
each hull b that moves adds −iρΩ ∬ ψ_a ∂φ₂/∂n dS over itself (`body_forces`).  So there is a ψ for bodies that are fixed
too.  The far field knows all bodies together alone and corrects none of them.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..modes import axes_of
from ..panels.pressure_drift.hull_flow import HullFlow, disturbed_flow, radiated_flow
from ..panels.pressure_drift.mean_drift import pressure_pairs
from ..panels.pressure_drift.of_each_body import first_order_loads, own_motions, surfaces_of_each
from ..panels.pressure_drift.turned_loads import rotated_pairs
from .body_forces import body_forces
from .first_order_waves import PanelWaves
from .kinds import DIFFERENCE
from .rotations import still_water_pairs


class WavesOfBodies(PanelWaves):
    """As `PanelWaves` of one body; flows are lists, one `HullFlow` for each body, forces and motions (…, 6N).

    raises : ValueError with `surface`, and for lines that hold the bodies
    """

    def __init__(
        self, problem, omega, headings, moving, of_force, surface=False, lines=None, swayed=None, kind=DIFFERENCE
    ):
        if surface:
            raise ValueError("the forcing of the surface around several bodies; allowed: --level body")
        if lines is not None:
            raise ValueError("wave pairs of several bodies on lines; allowed: floating freely, or --fixed")
        super().__init__(problem, omega, headings, moving, of_force, swayed=swayed, kind=kind)
        self.each, self.free = surfaces_of_each(self.prepared.geometry), self._all_free()
        self.again = [], []  # flows and loads in the motions `swayed`

    def _all_free(self):
        """The prepared problem whose bodies all radiate, also those that are fixed"""
        if not any(body.fixed for body in self.problem.bodies):
            return self.prepared
        bodies = tuple(body._replace(fixed=False) for body in self.problem.bodies)
        unheld = {"inertia_matrix": None, "hydrostatic_stiffness": None, "viscous": None, "band": None}
        return replace(self.prepared, problem=replace(self.prepared.problem, bodies=bodies, **unheld), coarse=None)

    @property
    def wanted(self):
        """Quantities of a frequency"""
        return {"excitation_force", "added_mass"} | ({"rao"} if self.moving else set())

    def solve(self, omega):
        run = self.prepared.run(omega, self.headings, self.wanted, None, self.problem.dofs)
        if self.free is self.prepared and np.abs(self.of_force - omega).min() <= self.near:
            self.radiating.append(run)
        own = own_motions(run, self.moving)
        self.rao.append(own)
        self._add(run, own, self.parts, self.loads)
        if self.swayed is not None:
            self.in_swayed.append(self.swayed[len(self.in_swayed)])
            self._add(run, self.in_swayed[-1], *self.again)

    def _add(self, run, own, parts, loads):
        """Flows and loads of the waves of a run in motions (m, 6N)"""
        motions = own @ self.problem.transform
        sixes = [motions[:, six] for six in self._sixes]
        parts.append(
            [disturbed_flow(run, surface, motions, six) for surface, six in zip(self.each, sixes, strict=True)]
        )
        loads.append(first_order_loads(run, own))

    @property
    def _sixes(self):
        """Of each body the places of its motions and forces"""
        return [slice(6 * i, 6 * i + 6) for i in range(len(self.problem.bodies))]

    def joined(self):
        """[`HullFlow`] of all waves and (n, m, n, m, 6N) T of squares of first order"""
        return self._joined(self.parts, self.loads, self.rao)

    def squares_in_swayed(self):
        return self._joined(*self.again, self.in_swayed)[1]

    def _joined(self, parts, loads, rao):
        flows = [HullFlow.joined(of_one) for of_one in zip(*parts, strict=True)]
        load, motion, second, squares = np.concatenate(loads), np.concatenate(rao), self.kind.second, []
        moving, stiffness = self.problem.moving, self.problem.hydrostatic_stiffness
        weight = self.problem.density * self.problem.gravity
        for body, surface, flow, six in zip(self.problem.bodies, self.each, flows, self._sixes, strict=True):
            found = pressure_pairs(surface, flow, self.problem, second) @ axes_of((body,)).T
            if self.moving and not body.fixed:
                found += rotated_pairs(load[:, six], motion[:, six], second)
                roll = stiffness[six.start + 3, moving.index(six.start + 3)]
                found += still_water_pairs(
                    motion[:, six], surface.hull, body.rotation_center, roll, weight, second, body.axes
                )
            squares.append(found)
        n, m = len(rao), len(self.headings)
        return flows, np.concatenate(squares, axis=-1).reshape(n, m, n, m, -1)

    def radiation(self, omega):
        if self.free is self.prepared:
            return super().radiation(omega)
        return self.free.run(max(omega, self.least), [0.0], {"added_mass"}, None, self.problem.dofs)

    def radiated(self, run):
        """[[`HullFlow`]] of the six motions of unit velocity of each body, on the hull of each"""
        each = list(enumerate(self.each))
        return [[radiated_flow(run, surface, a, a == b) for b, surface in each] for a, _ in each]

    def of_moving_hull(self, flow, one, two, made):
        out = np.zeros((len(one), 6 * len(self.each)), complex)
        for b, body in enumerate(self.problem.bodies):
            about = replace(self.problem, bodies=(), rotation_center=tuple(body.rotation_center))
            for a, six in enumerate(self._sixes if not body.fixed else ()):
                out[:, six] += body_forces(self.each[b], flow[b], one, two, made[a][b], about, self.kind)
        return out @ self.problem.transform.T
