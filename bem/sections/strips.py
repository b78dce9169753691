"""A box as a row of two-dimensional sections, by the strip method and the inverse strip method.

Ordinary strips are sections B × d in a row along x. Inverse strips are sections L × d in a row along y, for the
motions along the box (SR179 report, 1982, section 2.4.4).  Strips do not interact.  In a frame with x′ along the row
and y′ across it, with a the half length of the row and Zᵢⱼ the sectional impedance per metre (sway, heave, roll), the
impedances of the row are

    sway, roll, their coupling   2a Z₂₂, 2a Z₄₄, 2a Z₂₄        heave  2a Z₃₃
    pitch  ∫x′² Z₃₃ dx′ = ⅔a³ Z₃₃                              yaw    ∫x′² Z₂₂ dx′ = ⅔a³ Z₂₂

Froude–Krylov forces are the exact forces on the whole box.  The diffraction force follows Salvesen, Tuck and Faltinsen,
Transactions of SNAME 78 (1970), at zero speed. Haskind's relation combines the radiated flow of the section with the
oblique wave,

    fⱼ = iρω ∮ φⱼ ∂φ_I/∂n dl,  φ_I = −(ig/ω) Z₀ exp(iky′ sinβ′),    Fⱼ = ∫ fⱼ exp(ikx′ cosβ′) dx′

for sway, heave, roll; the pitch moment follows from heave, −∫x′f₃, and the yaw moment from sway, ∫x′f₂.  Surge along
the row is no sectional motion. Surge is computed as the sway of a row in the other direction, whose sides are the
ends of the body. This surge is not coupled to pitch, because pitch is computed from other sections: with a coupling the
damping matrix might not remain positive.
Waves around the ends are neglected, and therefore also drift and the far field.

In beam waves, with B/d = 5 and water of twice the draft, the exciting force differs from that of a panel method, for
L/B = 2, 4 and 8, by 28, 6 and 4 % in heave, by 5, 2 and 1 % in sway, and by 5, 2 and 1 % in roll.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..first_order import FirstOrder
from ..froude_krylov import box_incident_force, first_moment
from ..waves import wavenumber
from .coefficients import diffraction, radiation, section_flow
from .frequency_limits import added_mass_limit

# rows: surge, sway, heave, roll, pitch, yaw of the box; columns: those of the frame x′ = −y, y′ = x
TURN = np.zeros((6, 6))
TURN[[0, 1, 2, 3, 4, 5], [1, 0, 2, 4, 3, 5]] = 1, -1, 1, 1, -1, 1


@dataclass(frozen=True)
class Strips:
    """A box by the strip method or, with `inverse`, by the inverse strip method, whose strips are in a row across the
    box.

    length, beam, draft, depth : m, depth may be inf; tolerance : relative error of sections, not of the strip method
    """

    length: float
    beam: float
    draft: float
    depth: float
    tolerance: float = 1e-3
    inverse: bool = False

    def first_order(self, omega, headings, theta=None, dofs=range(6), density=1025.0, gravity=9.80665):
        """`FirstOrder` at ω rad/s for waves towards `headings` (m,) rad; no Kochin functions.

        dofs : needed degrees of freedom; results of other degrees of freedom are zero
        raises : ValueError if a section cannot be solved
        """
        headings = np.atleast_1d(np.asarray(headings, float))
        impedance, scattered = np.zeros((6, 6), complex), np.zeros((len(headings), 6), complex)
        for row in self._rows(dofs):
            flow = section_flow(row.beam, self.draft, self.depth, omega, gravity=gravity, tolerance=self.tolerance)
            impedance += row.impedance(radiation(flow, density))
            scattered += row.diffraction(flow, density, headings)
        incident = self.froude_krylov(omega, headings, dofs, density, gravity)
        return FirstOrder(impedance, incident, scattered, None, None, None, np.nan)

    def froude_krylov(self, omega, headings, dofs=range(6), density=1025.0, gravity=9.80665):
        """Force of the undisturbed waves on the whole box, N/m and N m/m; shape (m, 6); arguments as in
        `first_order`"""
        k = float(wavenumber(omega, self.depth, gravity))
        force = box_incident_force(self.length, self.beam, self.draft, self.depth, k, np.asarray(headings, float))
        return density * gravity * np.where(np.isin(np.arange(6), dofs), force, 0)

    def added_mass_limit(self, which, density=1025.0):
        """Added mass (6, 6) about the origin at the frequency `which`, "zero" or "infinity".  Raises ValueError."""
        out = np.zeros((6, 6))
        for row in self._rows(range(6)):
            section = added_mass_limit(
                row.beam, self.draft, self.depth, which, density=density, tolerance=self.tolerance
            )
            out += row.impedance(section)
        return out

    def _rows(self, dofs):
        """The rows of sections needed for the degrees of freedom"""
        ends = 1 if self.inverse else 0
        for across, mine in ((self.inverse, set(range(6)) - {ends}), (not self.inverse, {ends})):
            if mine := sorted(mine & set(dofs)):
                beam, length = (self.length, self.beam) if across else (self.beam, self.length)
                yield Row(beam, length, across, tuple(mine))


class Row(NamedTuple):
    """Sections of `beam` m in a row of `length` m, along x or y, for the degrees of freedom `mine`."""

    beam: float
    length: float
    across: bool
    mine: tuple

    @property
    def turn(self):
        """Matrix from the frame of the row of strips to the frame of the box, zero for motions that do not belong to
        the row; shape (6, 6)"""
        turn = TURN.copy() if self.across else np.eye(6)
        turn[[i for i in range(6) if i not in self.mine]] = 0
        return turn

    def impedance(self, section):
        """Impedance of the box, shape (6, 6), from the impedance per metre of the row, (3, 3)"""
        out = np.zeros((6, 6), section.dtype)
        out[1:4, 1:4] = self.length * section
        out[4, 4], out[5, 5] = self.length**3 / 12 * section[1, 1], self.length**3 / 12 * section[0, 0]
        return self.turn @ out @ self.turn.T

    def diffraction(self, flow, density, headings):
        """Diffraction force on the box; shape (m, 6)"""
        cosine, sine = np.cos(headings), np.sin(headings)
        if self.across:
            cosine, sine = -sine, cosine
        sway, heave, roll = diffraction(flow, density, sine).T
        x = flow.k * self.length / 2 * cosine
        even, odd = self.length * np.sinc(x / np.pi), 0.5j * self.length**2 * first_moment(x)
        forces = [0 * sway, even * sway, even * heave, even * roll, -odd * heave, odd * sway]
        return np.stack(forces, axis=-1) @ self.turn.T
