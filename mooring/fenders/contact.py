"""Fenders met by a body: clearance, several on one panel, friction that sticks and slips, inclined compression.

A panel at a point of the structure, with a unit normal n towards the body, is met by a point of the body that comes
nearer than the clearance c:

    δ = max(0, −n·(x_body − x_panel) − c),    force on the body  N n − T,    N = Σ R(δ + e_k)

e_k are the leads of the fenders behind one panel.  Friction is a spring k_t between the panel and the point that first
touched it, held back where it would exceed μN (return mapping): T = k_t u, |T| ≤ μ N; slip moves the point, and its
work −T·du is never returned.  Where contact is lost u is forgotten; it is 0 then, since N is.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .fender import FenderError
from .hysteresis import advanced, reaction_at

INCLINED = 0.10  # of the axial force: side force from which the curve of inclined compression holds (SR179, 3.4)


@dataclass(frozen=True, eq=False)
class Panel:
    """fenders, leads (m) : of each behind the panel; point, normal : (3,) of the panel; clearance : m

    friction : μ; shear : N/m, k_t of the module
    """

    fenders: tuple
    point: np.ndarray
    normal: np.ndarray
    clearance: float = 0.0
    leads: tuple = (0.0,)
    friction: float = 0.0
    shear: float = 0.0

    def __post_init__(self):
        if len(self.fenders) != len(self.leads):
            raise FenderError(f"{len(self.fenders)} fenders of a panel have {len(self.leads)} leads; allowed: as many")
        if not np.isclose(np.linalg.norm(self.normal), 1.0):
            raise FenderError(f"the normal of a panel has a length of {np.linalg.norm(self.normal):g}; allowed: 1")
        if not (self.friction >= 0 and self.shear >= 0) or (self.friction > 0 and self.shear == 0):
            raise FenderError(
                f"friction {self.friction:g} with shear stiffness {self.shear:g} N/m; allowed: none, or both above 0"
            )


class Touch(NamedTuple):
    """State of a panel: deflection m, states (k,) of `hysteresis`, stretch (3,) m of the spring of friction"""

    deflection: float
    states: tuple
    stretch: np.ndarray


def apart(panel):
    """`Touch` of a panel that is not met"""
    return Touch(0.0, (1.0,) * len(panel.fenders), np.zeros(3))


def met(panel, touch, position, motion):
    """Force (3,) N on the body at its point of contact, the `Touch` there, and whether it slips.

    position : (3,) m of the body's point; motion : (3,) m since `touch`
    """
    n = np.asarray(panel.normal, float)
    deflection = max(0.0, -float(n @ (np.asarray(position) - panel.point)) - panel.clearance)
    normal, states = 0.0, []
    for fender, lead, s in zip(panel.fenders, panel.leads, touch.states, strict=True):
        before, after = (d + lead if d > 0 else 0.0 for d in (touch.deflection, deflection))
        states.append(float(advanced(s, before, after, fender.return_length)))
        normal += float(reaction_at(fender, after, states[-1]))
    if normal <= 0:
        return np.zeros(3), Touch(deflection, tuple(states), np.zeros(3)), False
    motion = np.asarray(motion, float)
    stretch = touch.stretch + motion - n * (n @ motion)
    size, most = panel.shear * np.linalg.norm(stretch), panel.friction * normal
    slips = size > most
    if slips:
        stretch = stretch * (most / size)
    return normal * n - panel.shear * stretch, Touch(deflection, tuple(states), stretch), slips


def reachable(panel, points, reach):
    """m from a panel to the nearest contact point (m, 3) of a body.  Raises FenderError where it is above `reach`."""
    gap = float(np.min((np.asarray(points) - panel.point) @ np.asarray(panel.normal))) + panel.clearance
    if gap > reach:
        names = ", ".join(fender.name for fender in panel.fenders)
        raise FenderError(f"{names}: no body reaches it, the nearest point stays {gap:.3g} m off; allowed: {reach:g} m")
    return gap
