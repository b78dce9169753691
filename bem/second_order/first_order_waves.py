"""First-order waves of one problem, collected frequency by frequency, from which forces of wave pairs are computed."""

from dataclasses import replace

import numpy as np

from ..modes import axes_of
from ..panels.pressure_drift import of_each_body
from ..panels.pressure_drift.hull_flow import HullFlow, disturbed_flow, hull_surfaces, radiated_flow, wave_flow
from ..panels.pressure_drift.mean_drift import check_panels, pressure_pairs
from ..panels.pressure_drift.turned_loads import rotated_pairs
from .body_forces import body_forces
from .kinds import DIFFERENCE, EVEN
from .long_wave_forces import long_wave_forces, lowest
from .rotations import first_order_loads, still_water_pairs
from .surface_waves import SurfaceWaves

MANY = 12  # frequencies of the force above which they share work: the preparation costs as much as some of them


class FirstOrderWaves:
    """Base class of panels and the contour method; a subclass sets `prepared`, `surfaces` and `around`.

    headings : rad, (m,); lines : stiffness in addition to that of the water, (6, 6), or None
    surfaces : `hull_flow.HullSurfaces`; around : `surface_waves.SurfaceWaves` or an object with its methods, or None if
        the forcing of the surface is not wanted
    swayed : motions from another resolution about the rotation centre, (n, m, 6), for which the squares are also
        computed
    kind : `kinds.Kind` of the forces
    """

    def __init__(self, problem, headings, moving, lines=None, swayed=None, kind=DIFFERENCE):
        stiffness = problem.hydrostatic_stiffness if lines is None else problem.hydrostatic_stiffness + lines
        self.problem, self.headings, self.moving, self.kind = problem, headings, moving, kind
        self.held = replace(problem, hydrostatic_stiffness=stiffness)
        self.parts, self.loads, self.rao, self.far = [], [], [], []
        self.swayed, self.in_swayed = swayed, []

    @property
    def least(self):
        """Lowest frequency at which the body is solved, rad/s"""
        return lowest(self.problem)

    @property
    def wanted(self):
        """Quantities of a frequency"""
        wanted = {"excitation_force"} | ({"rao", "added_mass"} if self.moving else set())
        if self.kind is DIFFERENCE:
            wanted.add("drift_force" if self.moving else "drift_force_fixed")
        return wanted

    def take(self, run, flow_of):
        """Add the waves of a run; flow_of : function from motions (m, 6) about the origin to a flow"""
        rao = run.rao if self.moving else np.zeros((len(self.headings), 6), complex)
        motions = rao @ self.problem.transform
        self.parts.append(flow_of(motions))
        if self.kind is DIFFERENCE:
            self.far.append(run.drift_of_two(self.moving))
        self.rao.append(rao)
        self.loads.append(first_order_loads(run, self.problem, rao) if self.moving else 0 * rao)
        if self.swayed is not None:
            other = self.swayed[len(self.in_swayed)]
            loads = first_order_loads(run, self.problem, other)
            self.in_swayed.append((flow_of(other @ self.problem.transform), loads, other))
        return motions

    def joined(self):
        """`HullFlow` of all waves, and T of the squares of first-order quantities, (n, m, n, m, 6)"""
        flow = HullFlow.joined(self.parts)
        return flow, self._squares(flow, self.loads, self.rao)

    def of_moving_hull(self, flow, one, two, made):
        """`body_forces` of pairs about the rotation centre; shape (q, 6); made : flow from `radiated`"""
        return body_forces(self.surfaces, flow, one, two, made, self.problem, self.kind) @ self.problem.transform.T

    def squares_in_swayed(self):
        """Transfer function T of the products of first-order quantities, with the motions `swayed`; shape (n, m, n, m,
        6)"""
        parts, loads, rao = zip(*self.in_swayed, strict=True)
        return self._squares(HullFlow.joined(parts), loads, rao)

    def _squares(self, flow, loads, rao):
        rao, second = np.concatenate(rao), self.kind.second
        squares = pressure_pairs(self.surfaces, flow, self.problem, second) @ self.problem.transform.T
        if self.moving:
            squares += rotated_pairs(np.concatenate(loads), rao, second)
            roll, weight = self.problem.hydrostatic_stiffness[3, 3], self.problem.density * self.problem.gravity
            squares += still_water_pairs(rao, self.surfaces.hull, self.problem.rotation_center, roll, weight, second)
        n, m = len(self.rao), len(self.headings)
        return squares.reshape(n, m, n, m, 6)


class PanelWaves(FirstOrderWaves):
    """First-order waves of a `bem.methods.panel_problem.PanelProblem` on the hull and, with `surface`, on the water
    around

    omega : frequencies of the waves, rad/s, (n,)
    of_force : frequencies of the force, at which the body radiates, rising, rad/s, (d,).
    A frequency that is in `omega` and in `of_force` needs a single run.
    """

    def __init__(
        self, problem, omega, headings, moving, of_force, surface=False, lines=None, swayed=None, kind=DIFFERENCE
    ):
        super().__init__(problem, headings, moving, lines, swayed, kind)
        self.of_force, self.near = of_force, EVEN * np.ptp(of_force) / max(len(of_force) - 1, 1)
        rising = of_force[of_force > 0]
        low = max(self.least, min([omega[0], *rising[:1]]))
        self.prepared = _sharing(self.held, low, max(omega[-1], of_force[-1]), len(omega) + len(of_force))
        check_panels(problem, self.prepared.geometry.mesh)
        self.surfaces = hull_surfaces(self.prepared.geometry)
        around = surface and len(rising) > 0
        self.around = SurfaceWaves(self.prepared, self.surfaces, omega, rising, kind) if around else None
        self.radiating = []

    def solve(self, omega):
        again = np.abs(self.of_force - omega).min() <= self.near
        want = self.wanted | ({"added_mass"} if again else set())
        run = self.prepared.run(omega, self.headings, want, None, self.problem.dofs)
        if again:
            self.radiating.append(run)
        motions = self.take(run, lambda motions: wave_flow(run, self.surfaces, motions))
        if self.around is not None:
            self.around.add(run, self.parts[-1], motions)

    def radiation(self, omega):
        """Run at a frequency of the force"""
        known = [run for run in self.radiating if abs(run.omega - omega) <= self.near]
        dofs = self.problem.dofs
        return known[0] if known else self.prepared.run(max(omega, self.least), [0.0], {"added_mass"}, None, dofs)

    def radiated(self, run):
        """`HullFlow` of the six motions of unit velocity"""
        return radiated_flow(run, self.surfaces)

    def long_waves(self, run, number):
        """Forces of long waves about the origin, by `long_wave_forces`, for wavenumbers (w, 2), rad/m; shape (w, 6)"""
        return long_wave_forces(run, number)


class WavesOfBodies(PanelWaves):
    """First-order waves, as `PanelWaves`, of N bodies. A flow is a list of one `HullFlow` for each body; forces and
    motions are (…, 6N).

    Products of first-order quantities are integrated over each hull separately.  Haskind's relation gives the force
    of the bound wave on a body a. Let ψ_a be the radiation potential of a motion of body a, which exists for a fixed
    body too. Every moving hull b then adds −iρΩ ∬ ψ_a ∂φ₂/∂n dS, an integral over hull b, to the force on body a
    (`body_forces`). The far field gives only the drift of all bodies together, and cannot correct the drift of one
    body.

    raises : ValueError if `surface` is wanted, and if lines hold the bodies
    """

    def __init__(
        self, problem, omega, headings, moving, of_force, surface=False, lines=None, swayed=None, kind=DIFFERENCE
    ):
        if surface:
            raise ValueError("the free-surface forcing is not computed for several bodies; give --level body")
        if lines is not None:
            raise ValueError(
                "wave pairs of several bodies are not computed with lines; allowed: floating freely, or --fixed"
            )
        super().__init__(problem, omega, headings, moving, of_force, swayed=swayed, kind=kind)
        self.each, self.free = (
            of_each_body.surfaces_of_each(self.surfaces, self.prepared.geometry.mesh),
            self._all_free(),
        )
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
        own = of_each_body.own_motions(run, self.moving)
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
        loads.append(of_each_body.first_order_loads(run, own))

    @property
    def _sixes(self):
        """Indices of the motions and forces of each body"""
        return [slice(6 * i, 6 * i + 6) for i in range(len(self.problem.bodies))]

    def joined(self):
        """[`HullFlow`] of all waves, and T of the squares of first-order quantities, (n, m, n, m, 6N)"""
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
        """[[`HullFlow`]] of the six motions of unit velocity of each body, on the hull of every body"""
        each = list(enumerate(self.each))
        return [[radiated_flow(run, surface, a, a == b) for b, surface in each] for a, _ in each]

    def of_moving_hull(self, flow, one, two, made):
        out = np.zeros((len(one), 6 * len(self.each)), complex)
        for b, body in enumerate(self.problem.bodies):
            about = replace(self.problem, bodies=(), rotation_center=tuple(body.rotation_center))
            for a, six in enumerate(self._sixes if not body.fixed else ()):
                out[:, six] += body_forces(self.each[b], flow[b], one, two, made[a][b], about, self.kind)
        return out @ self.problem.transform.T


def _sharing(problem, low, high, count):
    """The problem prepared, its frequencies in a band that shares work where there are many; a round body needs none"""
    problem = replace(problem, coarse=None, finer=None)
    alone = replace(problem, band=None).prepared()
    if count < MANY or problem.damping_lids or alone.axisymmetric_geometry.sectors:
        return alone
    return replace(problem, band=(low, high)).prepared()
