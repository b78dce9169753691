"""Equilibria of a body at a single point: all headings and places of rest, and their stability.

Hawsers transmit no moment about the point p of the body where their lines of pull meet. Headings of rest are therefore
the zeros of one function of the heading alone (SR179 report 1982, eq. 3.6.3),

    g(ψ) = M(ψ) − (p_x F_y − p_y F_x)

with the external force and moment about the centre of mass; all of them are found (`rings.zeros`).  The lines then hold
a given force at one place of the buoy (`System`, Newton's method), and the body lies downstream of the buoy.  With two
hawsers either both are taut, and their pull meets at the apex ahead, or one is taut and the other must be slack.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..lines.system.equilibrium import SystemEquilibrium
from .body import Hold, SinglePoint, SinglePointError
from .criterion import Lateral, Slewing, falling, moored_quartic, slewing
from .rings import zeros
from .slewing import at_rest_state, linearised

SYMMETRIC = 1e-6  # asymmetry of force and mass below which an equilibrium counts as symmetric about the body's plane
LARGE = 0.25  # share of the kinetic energy from which a motion names a mode
STEP = 1e-4  # relative step of derivatives with respect to velocity


class Mode(NamedTuple):
    """A slow motion about an equilibrium: root λ, 1/s; shares (3,) in its kinetic energy of surge along the steady
    pull, sway across it, and yaw"""

    root: complex
    shares: np.ndarray

    @property
    def period(self):
        """s, inf without oscillation"""
        return 2 * np.pi / abs(self.root.imag) if abs(self.root.imag) > 1e-12 * abs(self.root) else np.inf

    @property
    def words(self):
        """Names of its large motions"""
        return " and ".join(name for name, s in zip(("surge", "sway", "yaw"), self.shares, strict=True) if s > LARGE)


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A body at rest.

    heading : rad; place : (2,) m of the centre of mass; buoy : (2,) m
    hawser : (k,) N; for a contact buoy the force on the buoy
    force : (3,) N, N, N m of wind, water and drift in axes of the body; lines : SystemEquilibrium of the buoy
    """

    point: SinglePoint
    heading: float
    place: np.ndarray
    buoy: np.ndarray
    hawser: np.ndarray
    force: np.ndarray
    lines: SystemEquilibrium

    def __repr__(self):
        return f"<Equilibrium heading {np.degrees(self.heading):.2f}°, pull {self.pull:.4g} N>"

    @property
    def pull(self):
        """N, of the steady force"""
        return float(np.hypot(*self.force[:2]))

    @property
    def state(self):
        """State as in `slewing.rates`; shape (6,)"""
        return at_rest_state(self.point, self.place, self.heading)

    @cached_property
    def roots(self):
        """Roots λ of small motions, 1/s, the fastest growing first; shape (6,)"""
        return falling(np.linalg.eigvals(self._small))

    @cached_property
    def _small(self):
        return linearised(self.point, self.state, Hold(-self.force, self.hawser, self.buoy))

    @cached_property
    def modes(self):
        """A Mode for each root or pair of roots, the fastest growing first"""
        roots, vectors = np.linalg.eig(self._small)
        by = np.arctan2(self.force[1], self.force[0])  # from the bow, along the pull
        own = _axes(by + self.heading) @ vectors[:3]
        energy = np.diag(_axes(by) @ self.point.mass @ _axes(by).T)[:, None] * np.abs(own) ** 2
        made = [Mode(complex(root), of / of.sum()) for root, of in zip(roots, energy.T, strict=True) if root.imag >= 0]
        return sorted(made, key=lambda mode: -mode.root.real)

    @property
    def slews(self):
        """Whether sway and yaw have more than half the energy of the fastest growing motion"""
        return bool(self.modes[0].shares[0] < 0.5)

    @cached_property
    def slewing(self) -> Slewing:
        """Growth and period of the fastest growing motion"""
        return slewing(self.roots)

    @cached_property
    def lateral(self) -> Lateral | None:
        """Lateral of the quartic; None if the line does not lie straight ahead, or added mass couples sway and yaw"""
        point, (x, y, turn) = self.point, self.force
        T, p = point.mass, point.apex
        if x > 0 or p[0] <= 0:
            return None
        crooked = max(abs(y), abs(turn) / p[0], abs(p[1] * x / p[0])) > SYMMETRIC * self.pull
        if crooked or abs(T[1, 2]) > SYMMETRIC * np.sqrt(T[1, 1] * T[2, 2]):
            return None
        n = np.array([-np.sin(self.heading), np.cos(self.heading)])
        soft = n @ np.linalg.solve(point.pull(self.buoy).stiffness, n)
        hawser = 0.0 if len(point.ends) == 2 else point.lengths[0]
        pull = self.pull
        derivatives = _derivatives(point, self.heading)
        return Lateral(T[1, 1], T[2, 2], pull, p[0], hawser + pull * soft, *derivatives)

    @cached_property
    def quartic(self):
        """Coefficients of the criterion, shape (5,); None if `lateral` is"""
        return None if self.lateral is None else moored_quartic(self.lateral)


def _axes(angle):
    """Motions along and across a direction, and yaw; shape (3, 3)"""
    cos, sin = np.cos(angle), np.sin(angle)
    return np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])


def equilibria(point: SinglePoint):
    """All Equilibrium of a body, by heading; raises SinglePointError without any pull, or if lines do not hold."""
    found = []
    for end, length, which in _supports(point):
        for heading in zeros(lambda psi, end=end: _moment(point, psi, end)):
            force = point.loads.at_rest(np.array([heading]))[0]
            tension = _tensions(point, force, end, length, which)
            if tension is not None:
                start = found[-1].lines.pose if found else None  # loads from one side pull equally at all headings
                found.append(_at(point, heading, force, end, length, tension, start))
    if not found:
        raise SinglePointError(f"no heading is in equilibrium: {_why_none(point)}")
    return sorted(found, key=lambda one: one.heading)


def _why_none(point):
    force = point.loads.at_rest(np.linspace(0.0, 2 * np.pi, 24, endpoint=False))
    if not np.any(force[:, :2]):
        return "wind, current and waves exert no force; give one of them"
    if not np.any(_about(force, point.apex)):
        return (
            "wind, current and waves do not turn the body about its attachment, so every heading is in equilibrium; "
            "move the attachment, or give coefficients with a yaw moment"
        )
    return (
        "at headings without yaw moment, wind, current and waves push the body onto its mooring, or load only one of "
        "its hawsers"
    )


def buoy_periods(one, mass, displaced):
    """Natural periods, s, of the buoy of an Equilibrium on its lines with a slack hawser: twice sideways, longest
    first, and heave; shape (3,)

    mass : kg; displaced : kg of water, which its added mass equals in all directions; undamped
    """
    stiffness, ways = np.linalg.eigh(one.lines.stiffness[:3, :3])
    with np.errstate(invalid="ignore", divide="ignore"):
        periods = 2 * np.pi / np.sqrt(stiffness / (mass + displaced))
    heave = int(np.argmax(np.abs(ways[2])))
    return np.array([*np.delete(periods, heave), periods[heave]])


def headings_of_rest(loads, end):
    """All headings at which loads have zero moment about the point (2,) m of the body, rad; shape (k,)"""
    return zeros(lambda psi: _about(loads.at_rest(psi), end))


def _moment(point, psi, end):
    return _about(point.loads.at_rest(psi), end)


def _about(force, end):
    return force[:, 2] - end[0] * force[:, 1] + end[1] * force[:, 0]


def _supports(point):
    """Return (point of the body, hawser length from it, its number) of each possible carrier of the pull; number −1 of
    both"""
    if len(point.ends) == 2:
        yield point.apex, 0.0, -1
    for i, (end, length) in enumerate(zip(point.ends, point.lengths, strict=True)):
        yield end, length, i


def _tensions(point, force, end, length, which):
    """Tensions of the hawsers under a force (3,) of the loads, N; shape (k,); None in case of compression, or if the
    other is taut"""
    F = np.hypot(*force[:2])
    if not F > 0:
        return None
    if which < 0:
        tension = np.linalg.solve(((point.apex - point.ends) / point.lengths[:, None]).T, -force[:2])
        return tension if np.all(tension >= 0) else None
    tension = np.zeros(len(point.ends))
    tension[which] = F
    if len(point.ends) == 2:
        buoy = end - length * force[:2] / F
        if np.hypot(*(buoy - point.ends[1 - which])) > point.lengths[1 - which]:
            return None
    return tension


def _at(point, heading, force, end, length, tension, start):
    cos, sin = np.cos(heading), np.sin(heading)
    R = np.array([[cos, -sin], [sin, cos]])
    pull = R @ force[:2]
    lines = point.buoy_under(pull, start)
    buoy = lines.position[0, :2]
    bow = buoy + length * pull / np.hypot(*pull)
    return Equilibrium(point, float(heading), bow - R @ end, buoy, tension, force, lines)


def _derivatives(point, heading):
    """Y_v, Y_r, Y_ψ, N_v, N_r, N_ψ of the loads by motion over the ground, SI"""
    loads, (u, v) = point.loads, at_rest_state(point, (0.0, 0.0), heading)[3:5]
    turn = STEP
    side = np.array([8, -8, -1, 1]) @ loads.at_rest(heading + turn * np.array([1, -1, 2, -2]))
    by_psi = side[1:] / (12 * turn)

    def by(step):
        near, far = (loads.moving(heading, (u, v + k * step[0], k * step[1]))
                     - loads.moving(heading, (u, v - k * step[0], -k * step[1])) for k in (1, 2))  # fmt: skip
        return (8 * near - far)[1:] / (12 * step.sum())

    by_v, by_r = by(np.array([1e-4, 0.0])), by(np.array([0.0, 2e-6]))
    inertia = (point.mass[1, 1] - (0.0 if loads.water.turning else point.mass[0, 0])) * u  # for axes that do not turn
    return by_v[0], by_r[0] + inertia, by_psi[0], by_v[1], by_r[1], by_psi[1]


def preferred(found):
    """The stable Equilibrium of fastest decay; without a stable Equilibrium the Equilibrium of slowest growth"""
    return min(found, key=lambda one: one.slewing.growth)


def bow(one):
    """° from +x to the bow of an Equilibrium, 0 up to 360, to a hundredth"""
    return float(np.round(np.degrees(one.heading), 2) % 360) + 0.0
