"""A body on a buoy: hawsers between its bow and the buoy, or none, and the lines of a `System` that hold the buoy.

As in the SR179 report (1982), section 3.6.1, hawsers are weightless and inextensible, the buoy has no inertia, and
lines have their static shape. Unlike in eq. 3.6.5, the buoy lies where the forces on it balance in the plane, not on
the line from its place at rest to the bow.  The energy of the lines is a convex function of the buoy's position, so
the buoy has only one position at rest.  Axes of the body: x forward, y to port, from its centre of mass.
"""

from dataclasses import dataclass
from functools import cached_property
from math import atan2, cos, hypot, inf, isfinite, pi, sin
from typing import NamedTuple

import numpy as np

from ..lines.system.equilibrium import rest
from ..lines.system.findings import culprit
from ..lines.system.graph import Pose, System
from ..lines.system.parts import EquilibriumError
from .loads import Loads

SETTLED = 1e-11  # residual over the forces on a buoy
NEAR = 1e-4  # residual over the pull from which one more Newton step has quadratic error
STEPS = 60
NO_POINTS = np.zeros((0, 3))


class SinglePointError(ValueError):
    """An impossible single-point mooring, or one that cannot be followed: the message names the number and the limit"""


class NotFollowedError(SinglePointError):
    """A motion beyond the reach of the lines, or too fast to follow with any time step"""


class Pull(NamedTuple):
    """Force on a buoy by its lines.

    force : (2,) N; stiffness : (2, 2) N/m, with the buoy free to rise and sink; height : height of the attachment, m
    """

    force: np.ndarray
    stiffness: np.ndarray
    height: float


class Hold(NamedTuple):
    """Effect of the mooring on the body.

    force : (3,) N, N, N m in axes of the body; tension : (k,) N of the hawsers; for a contact buoy the contact force
    buoy : (2,) m
    """

    force: np.ndarray
    tension: np.ndarray
    buoy: np.ndarray


@dataclass(frozen=True, eq=False)
class SinglePoint:
    """loads : Loads; mass : (3, 3) kg, kg m, kg m² of slow surge, sway and yaw, with added mass

    ends : (k, 2) m, attachments of the hawsers to the body; lengths : (k,) m, 0 for the single hawser of a contact buoy
    system : System whose only body is the buoy, with the buoy's own steady loads
    """

    loads: Loads
    mass: np.ndarray
    ends: np.ndarray
    lengths: np.ndarray
    system: System

    def __post_init__(self):
        ends, lengths = np.asarray(self.ends, float).reshape(-1, 2), np.asarray(self.lengths, float).ravel()
        object.__setattr__(self, "ends", ends)
        object.__setattr__(self, "lengths", lengths)
        if not (1 <= len(ends) == len(lengths) <= 2):
            raise SinglePointError(
                f"there are {len(ends)} hawser ends and {len(lengths)} lengths; allowed: one or two of each"
            )
        if len(ends) == 2 and not abs(np.diff(lengths)[0]) < np.hypot(*(ends[1] - ends[0])) < lengths.sum():
            raise SinglePointError(
                f"two hawsers of {lengths[0]:g} and {lengths[1]:g} m do not meet ahead of their ends, which are "
                f"{np.hypot(*(ends[1] - ends[0])):g} m apart; lengthen them"
            )
        if len(self.system.bodies) != 1 or self.system.free_points:
            raise SinglePointError(f"{self.system!r} must contain one body, the buoy, on lines to anchors")

    @cached_property
    def inverse(self):
        """Inverse of the mass matrix; shape (3, 3)"""
        return np.linalg.inv(self.mass)

    @cached_property
    def _turn(self):
        """Attitude of the buoy, of a Pose"""
        return self.system.pose.turn

    @cached_property
    def _floats(self):
        """N/m of buoyancy over the height of a buoy that rises and sinks, 0 for a fixed height"""
        body = self.system.bodies[0]
        return float(body.hydrostatic_stiffness[2, 2]) if "Heave" in body.freedom else 0.0

    @cached_property
    def at_rest(self):
        """SystemEquilibrium of the buoy on its lines without the body"""
        return rest(self.system)

    @cached_property
    def origin(self):
        """Place of the buoy without the body, m; shape (2,)"""
        return self.at_rest.position[0, :2]

    @cached_property
    def apex(self):
        """Point in the body's axes, ahead, where two taut hawsers meet, m; shape (2,); the attachment of a single
        hawser"""
        if len(self.ends) == 1:
            return self.ends[0]
        (p, q), (a, b) = self.ends, self.lengths
        apart = np.hypot(*(q - p))
        along = (q - p) / apart
        x = (apart**2 + a**2 - b**2) / (2 * apart)
        across = np.array([along[1], -along[0]])
        across = across if across[0] > 0 else -across
        return p + x * along + np.sqrt(a * a - x * x) * across

    def pull(self, place, height=None) -> Pull:
        """Pull of the lines with the buoy at (2,) m.  Raises SinglePointError beyond the reach of a line."""
        body = self.system.bodies[0]
        z, floats = body.position[2] if height is None else height, self._floats
        for _ in range(STEPS):
            pose = Pose(np.array([[place[0], place[1], z]]), self._turn, NO_POINTS)
            load = self.system.load(pose)
            F, K = load.force, load.stiffness
            if not isfinite(F[0]):
                a, b = load.points[self.system.arrays.ends].swapaxes(0, 1)
                raise SinglePointError(culprit(self.system, load.rows, a, b, f"with the buoy at {place}"))
            if floats == 0.0:
                return Pull(F[:2], K[:2, :2], z)
            up, stiff = F[2] + body.load[2] - floats * (z - body.position[2]), K[2, 2] + floats
            if abs(up) <= SETTLED * (abs(load.rows[:, 3:5]).sum() + 1.0):
                break
            z += up / stiff
        return Pull(F[:2].copy(), K[:2, :2] - np.outer(K[:2, 2], K[2, :2]) / stiff, float(z))

    def buoy_under(self, force, start: Pose | None = None):
        """SystemEquilibrium of the buoy under the pull (2,) N of a body, sought from a Pose.  Raises
        SinglePointError.
        """
        name = self.system.bodies[0].name
        load = np.array(self.system.bodies[0].load)
        load[:2] += force
        try:
            return rest(self.system.with_loads({name: load}), start)
        except EquilibriumError as error:
            raise SinglePointError(f"the lines do not hold {np.hypot(*force) / 1e3:.4g} kN: {error}") from None

    def hold(self, place, heading, near=None) -> Hold:
        """Hold on the body with its centre of mass at (2,) m; near : guess of the buoy's position, (2,) m"""
        R = _turned(heading)
        if self.lengths[0] == 0.0:
            buoy = place + R @ self.ends[0]
            force = R.T @ self.pull(buoy).force
            return Hold(_with_moment(force, self.ends[0]), np.array([np.hypot(*force)]), buoy)
        if len(self.ends) == 1:
            return self._one(place, R, 0, near)[1]
        found, refused = [], None
        first = int((R.T @ (self.origin - place))[1] * (self.ends[0, 1] - self.ends[1, 1]) < 0)
        for which in (None, first, 1 - first):
            try:
                found.append(self._both(place, R) if which is None else self._one(place, R, which, near))
            except SinglePointError as error:  # line beyond reach: the buoy lies elsewhere
                refused = error
            if found and found[-1][0] == 0.0:
                return found[-1][1]
        if not found:
            raise refused
        return min(found, key=lambda one: one[0])[1]

    def stiffness(self, heading, held: Hold):
        """Stiffness, N/m and N: minus the derivatives of a Hold's force by the body's position and heading; shape
        (3, 3)

        A taut hawser turns about its end on the body until the lines pull along it, so that it yields sideways.
        """
        taut = np.flatnonzero(held.tension)
        if not len(taut):
            return np.zeros((3, 3))
        K, (X, Y) = self.pull(held.buoy).stiffness, held.force[:2]
        R = _turned(heading)
        arm, length = (self.apex, 0.0) if len(taut) == 2 else (self.ends[taut[0]], self.lengths[taut[0]])
        pull = np.hypot(X, Y)
        across = R @ np.array([-Y, X]) / pull
        side = K @ across
        K = K - np.outer(side, side) * (length / (length * (across @ side) + pull))
        out = np.empty((3, 3))
        out[:2] = R.T @ K @ np.column_stack([np.eye(2), R @ np.array([-arm[1], arm[0]])])
        out[:2, 2] += -Y, X
        out[2] = arm[0] * out[1] - arm[1] * out[0]
        return out

    def _both(self, place, R):
        """Hold of two taut hawsers, after 0, or where one would have to push, its share of the force in lengths, m"""
        buoy = place + R @ self.apex
        force = R.T @ self.pull(buoy).force
        tension = np.linalg.solve(((self.apex - self.ends) / self.lengths[:, None]).T, force)
        share = max(0.0, -tension.min()) / max(np.hypot(*force), 1e-300)
        return share * self.lengths.max(), Hold(_with_moment(force, self.apex), tension, buoy)

    def _one(self, place, R, which, near):
        """Distance of the buoy beyond the reach of the other hawser, m, and the Hold of this hawser"""
        end, length = self.ends[which], float(self.lengths[which])
        bow = place + R @ end
        tension, force = np.zeros(len(self.ends)), np.zeros(3)
        buoy = self.origin
        if hypot(*(buoy - bow).tolist()) > length:
            buoy, (X, Y) = self._on_circle(bow, length, near)
            tension[which] = hypot(X, Y)
            force = _with_moment((R[0, 0] * X + R[1, 0] * Y, R[0, 1] * X + R[1, 1] * Y), end)
        if len(self.ends) == 1:
            return 0.0, Hold(force, tension, buoy)
        other = place + R @ self.ends[1 - which]
        return max(0.0, hypot(*(buoy - other)) - self.lengths[1 - which]), Hold(force, tension, buoy)

    def _on_circle(self, bow, length, near):
        """Place of the buoy at the end of a taut hawser where the lines pull along the hawser, and their pull, (2,) N

        Newton's method on the angle, with bisection outside the half circle towards the buoy's place at rest; the pull
        of its last step follows from the stiffness of the lines.
        """
        px, py = bow.tolist()
        x, y = (self.origin if near is None else near).tolist()
        rest_x, rest_y = self.origin.tolist()
        middle = atan2(rest_y - py, rest_x - px)
        angle = middle + min(max((atan2(y - py, x - px) - middle + pi) % (2 * pi) - pi, -1.0), 1.0)
        low, high = middle - 0.5 * pi, middle + 0.5 * pi
        for _ in range(STEPS):
            cx, cy = cos(angle), sin(angle)  # along the hawser; (−cy, cx) across it
            buoy = np.array([px + length * cx, py + length * cy])
            F, K, _ = self.pull(buoy)
            (X, Y), ((a, b), (c, d)) = F.tolist(), K.tolist()
            across, along = cx * Y - cy * X, cx * X + cy * Y
            slope = -length * (cy * cy * a - cx * cy * (b + c) + cx * cx * d) - along
            if abs(across) <= NEAR * along and slope < 0:
                step = -across / slope * length * np.array([-cy, cx])
                return buoy + step, F - K @ step
            if high - low < 1e-15:
                break
            low, high = (angle, high) if across > 0 else (low, angle)
            following = angle - across / slope if slope < 0 else inf
            angle = following if low < following < high else 0.5 * (low + high)
        return buoy, F


def _turned(heading):
    """Vector of two components, turned from the axes of the body into space; shape (2,)"""
    c, s = cos(heading), sin(heading)
    return np.array([[c, -s], [s, c]])


def _with_moment(force, arm):
    """Force and moment of a force (2,) in axes of the body that acts at (2,), m; shape (3,)"""
    return np.array([force[0], force[1], arm[0] * force[1] - arm[1] * force[0]])


def planar_mass(own, length, beam, added, gyration=None):
    """Mass matrix of slow surge, sway and yaw about the centre of mass, kg, kg m²; shape (3, 3).

    own : mass of the body, kg; length, beam : m; added : added mass over the mass, and added inertia over the
        inertia, (3,)
    gyration : radius of gyration in yaw, m, by default of a uniform box
    """
    squared = (length**2 + beam**2) / 12 if gyration is None else gyration**2
    return np.diag(own * (1 + np.asarray(added, float)) * np.array([1, 1, squared]))


def planar_mass_stored(reader):
    """Mass matrix of slow surge, sway and yaw of a `bem.database.reader.Reader`, with added mass, kg, kg m, kg m²;
    shape (3, 3)
    """
    body, plane = reader.floating(), [0, 1, 5]
    return (body.inertia + body.held_added_mass(0.0)[0])[np.ix_(plane, plane)]
