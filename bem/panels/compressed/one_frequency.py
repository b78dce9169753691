"""The panel method at one frequency on very many panels, by compressed equations."""

import time
from functools import cached_property

import numpy as np

from ...checks import enlarged, sufficient_accuracy
from ...green.tables import wave_table
from ..frequency_limits import added_mass_of, given_at_limit, unit_depth_values
from ..one_frequency import PanelRun
from .equations import solved

# of the sufficient accuracy, for the blocks: the bound of what they do to weak damping, as in roll, falls with it
OF_SUFFICIENT = 0.1


class CompressedRun(PanelRun):
    """Potentials by `bem.panels.compressed.equations`; the estimated errors include the error of the compression."""

    def _solved(self):
        start = time.perf_counter()
        velocities = {cls: self.velocities(cls) for cls in self.columns}
        self._timed("incident", start)
        start = time.perf_counter()
        g = self.geometry
        table = wave_table(self.omega, self.problem.depth, self.problem.gravity, g.reach, g.draft)
        tolerance = OF_SUFFICIENT * sufficient_accuracy(self.problem.mesh.total)
        found = solved(g, velocities, 1.0, table, self.depth_values, tolerance)
        self._residual, self._compression = found.residual, found.compression
        self._timed("solve", start)
        return {cls: np.ascontiguousarray(phi[:, : g.hull]) for cls, phi in found.potentials.items()}

    @property
    def compression(self):
        """Relative error of the potentials by the compression"""
        _ = self.potentials
        return self._compression

    @cached_property
    def compression_errors(self):
        """Bounds of the error by compression in `radiation` (6, 6) and `excitation` (m, 6)

        |∬ δφ nⱼ dS| ≤ ‖δφ‖ ‖nⱼ‖ with ‖δφ‖ the relative error times ‖φ‖
        """
        areas, density = self.hull[1] * self.geometry.copies, self.problem.density
        of_modes = np.sqrt(areas @ self.prepared.modes**2)
        count = len(of_modes)
        radiation, excitation = np.zeros((count, count)), np.zeros((len(self.headings), count))
        for cls, (moving, waves) in self.columns.items():
            sizes, own = np.sqrt(np.abs(self.potentials[cls]) ** 2 @ areas), self.geometry.members(cls)
            bounds = density * self.compression * np.outer(sizes, of_modes[own])
            radiation[np.ix_(moving, own)] = bounds[: len(moving)]
            excitation[np.ix_(waves, own)] = self.omega * bounds[len(moving) :]
        return np.maximum(radiation, radiation.T), excitation

    def enlarged(self, radiation, excitation):
        """Errors enlarged by the possible effect of the compression"""
        return tuple(enlarged(*both) for both in zip((radiation, excitation), self.compression_errors, strict=True))


def added_mass_limit(prepared, which):
    """Added mass as from `bem.panels.frequency_limits.added_mass_limit`, by compressed equations"""
    g, velocities, table, mirror = given_at_limit(prepared, which)
    of_class = {cls: v.T for cls, v in zip(g.classes, velocities, strict=True)}
    found = solved(g, of_class, mirror, table, unit_depth_values, sufficient_accuracy(g.mesh.total))
    return added_mass_of(prepared, [found.potentials[cls].real for cls in g.classes], which)
