"""The panel method at one frequency for an axisymmetric body, harmonic by harmonic (`bem.panels.axisymmetric`)."""

import time
from functools import cached_property

import numpy as np

from ..green.tables import wave_table
from .axisymmetric import sector_rows, solved_by_harmonics
from .one_frequency import PanelRun


class AxisymmetricRun(PanelRun):
    """A `PanelRun` that needs only the rows of the influence matrices for one sector."""

    def __init__(self, prepared, omega, *arguments, **more):
        super().__init__(prepared, omega, *arguments, **more)
        self.geometry = prepared.axisymmetric_geometry.at(self.omega**2 / prepared.problem.gravity)

    @cached_property
    def force_potentials(self):
        """{class: potentials (columns, n)}; if no other harmonics are needed, only those that exert a force on the
        body"""
        return self.potentials if self.far_field or self.whole_field else self._solved(all_harmonics=False)

    def _solved(self, all_harmonics=True):
        start = time.perf_counter()
        velocities = {cls: self.velocities(cls) for cls in self.columns}
        self._timed("incident", start)
        start, g = time.perf_counter(), self.geometry
        _ = g.rankine_of_sector
        self._timed("rankine", start)
        start = time.perf_counter()
        table = wave_table(self.omega, self.problem.depth, self.problem.gravity, g.reach, g.draft)
        self._timed("table", start)
        start = time.perf_counter()
        S, D = sector_rows(g, 1.0, table, self.depth_values)
        self._timed("assemble", start)
        start = time.perf_counter()
        out, self._residual = solved_by_harmonics(g, S, D, table.K, velocities, all_harmonics)
        if not all(np.all(np.isfinite(phi)) for phi in out.values()):
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: the solution is not finite")
        self._timed("solve", start)
        return out
