"""The panel method at one frequency for a body of revolution: each harmonic about its axis alone
(`bem.panels.revolution`).
"""

from __future__ import annotations

import time
from functools import cached_property

import numpy as np

from ..green.tables import wave_table
from .one_frequency import PanelRun
from .revolution import solved_by_harmonics, wedge_rows


class RoundRun(PanelRun):
    """As `PanelRun`, from the rows of a wedge, or of half of one."""

    def __init__(self, prepared, omega, *question):
        super().__init__(prepared, omega, *question)
        self.geometry = prepared.turned.at(self.omega**2 / prepared.setup.gravity)

    @cached_property
    def pressing(self):
        """{class: potentials (columns, n)}, of the harmonics of the modes alone where nobody asks for the others"""
        return self.potentials if self.far_field or self.whole_field else self._solved(whole=False)

    def _solved(self, whole=True):
        start = time.perf_counter()
        velocities = {cls: self.velocities(cls) for cls in self.columns}
        self._timed("incident", start)
        start, g = time.perf_counter(), self.geometry
        _ = g.rankine_of_wedge
        self._timed("rankine", start)
        start = time.perf_counter()
        table = wave_table(self.omega, self.setup.depth, self.setup.gravity, g.reach, g.draft)
        self._timed("table", start)
        start = time.perf_counter()
        S, D = wedge_rows(g, 1.0, table, self.depth_values)
        self._timed("assemble", start)
        start = time.perf_counter()
        out, self._residual = solved_by_harmonics(g, S, D, table.K, velocities, whole)
        if not all(np.all(np.isfinite(phi)) for phi in out.values()):
            raise FloatingPointError(f"ω = {self.omega:.6g} rad/s: the solution is not finite")
        self._timed("solve", start)
        return out
