"""Studies of a system at rest: the mooring stiffness of one body, offset curves, the loss of one line.

Free points and other bodies follow a small motion of one body quasi-statically. With e for their degrees of freedom
and b for those of the body, the stiffness is the Schur complement K_bb − K_be K_ee⁻¹ K_eb.
"""

from dataclasses import dataclass

import numpy as np

from ..lines.system.bodies import cross_matrix
from ..lines.system.equilibrium import SystemEquilibrium, held_at, rest
from ..lines.system.parts import EquilibriumError, LineSystemError

FREE, PULLED = 1e-12, 1e-6  # stiffness that counts as zero and residual force of an equilibrium, over the largest


@dataclass(frozen=True)
class OffsetCurve:
    """A body held at offsets from its place at rest.

    offset : (m,) m along `direction`, rad; force : force of the lines on the body, (m, 6), N and N m
    tension : (m, n) N, at the more loaded end of each line; grounded_length : (m, n) m
    utilisation : (m, n) as in LineForces; missed : {offset m: reason for no equilibrium}, where other values are nan
    """

    body: str
    direction: float
    offset: np.ndarray
    force: np.ndarray
    tension: np.ndarray
    grounded_length: np.ndarray
    utilisation: np.ndarray
    missed: dict

    @property
    def restoring(self):
        """Restoring force against the offset, N; shape (m,)"""
        return -self.force[:, 0] * np.cos(self.direction) - self.force[:, 1] * np.sin(self.direction)


def body_number(system, name):
    """Number of a body; LineSystemError for an unknown name."""
    names = [body.name for body in system.bodies]
    if name not in names:
        raise LineSystemError(
            f"body {name!r} is unknown; allowed: {', '.join(names) or 'none, the system has no body'}"
        )
    return names.index(name)


def mooring_stiffness(state: SystemEquilibrium, body, others="free"):
    """Mooring stiffness of one body, without its own hydrostatics; shape (6, 6).

    others : "free" if other bodies follow in their free motions, "held" if they do not move
    raises : LineSystemError if a free point has no stiffness in some direction
    """
    if others not in ("free", "held"):
        raise LineSystemError(f"others is {others!r}; allowed: 'free', 'held'")
    system, i = state.system, body_number(state.system, body)
    own = np.arange(6 * i, 6 * i + 6)
    follows = state.moving.copy()
    follows[own if others == "free" else slice(0, 6 * len(system.bodies))] = False
    K = state.stiffness.copy()
    if system.bodies[i].hydrostatic_stiffness is not None:
        from ..lines.system.hydrostatics import hydrostatic_load

        sinkage = state.pose.place[i, 2] - system.bodies[i].position[2]
        K[np.ix_(own, own)] -= hydrostatic_load(system.bodies[i].hydrostatic_stiffness, sinkage, state.pose.turn[i])[1]
    rest_of = np.flatnonzero(follows)
    if not len(rest_of):
        return K[np.ix_(own, own)]
    inner, away, back = K[np.ix_(rest_of, rest_of)], K[np.ix_(own, rest_of)], K[np.ix_(rest_of, own)]
    return K[np.ix_(own, own)] - away @ _following(inner, back)


def _following(inner, pulled):
    """K_ee⁻¹ K_eb, of least norm where a motion, such as that of a clamp about its line, has neither stiffness nor
    load.

    raises : LineSystemError for a motion with force but without stiffness
    """
    size = np.sqrt(np.abs(np.diag(inner)))
    size[size <= FREE * size.max()] = 1.0  # N/m or N m/rad
    left, held, right = np.linalg.svd(inner / np.outer(size, size))
    good, b = held > FREE * held.max(), left.T @ (pulled / size[:, None])
    if np.abs(b[~good]).max(initial=0.0) > PULLED * np.abs(b).max(initial=0.0):
        raise LineSystemError(
            "a free point or another body is not held in some direction; add a line that holds it, or give it weight"
        )
    return (right[good].T @ (b[good] / held[good, None])) / size[:, None]


def offset_curve(state: SystemEquilibrium, body, direction, offsets, progress=None) -> OffsetCurve:
    """Forces and tensions with a body held at offsets from its place at rest, its attitude unchanged.

    direction : rad; offsets : (m,) m; at each offset everything else comes to rest again, then `progress` is called
    raises : EquilibriumError where no equilibrium is found at any offset
    """
    i = body_number(state.system, body)
    at_rest = state.position[i]
    along = np.array([np.cos(direction), np.sin(direction), 0, 0, 0, 0])
    offsets = np.asarray(offsets, float)
    order = np.argsort(np.abs(offsets), kind="stable")
    found, missed, starts = {}, {}, {1.0: state.pose, -1.0: state.pose}
    for j in order:
        side = 1.0 if offsets[j] >= 0 else -1.0
        held = held_at(state.system, {body: at_rest + offsets[j] * along})
        start = held.pose._replace(free=starts[side].free)
        for k in range(len(held.bodies)):
            if k != i:
                start.place[k], start.turn[k] = starts[side].place[k], starts[side].turn[k]
        try:
            found[int(j)] = rest(held, start)
        except EquilibriumError as error:
            missed[float(offsets[j])] = str(error)
        else:
            starts[side] = found[int(j)].pose
        if progress is not None:
            progress()
    if missed and not found:
        nearest = min(missed, key=abs)
        raise EquilibriumError(f"body {body} at offset {nearest:g} m: {missed[nearest]}")
    count = len(offsets)
    force = np.full((count, 6), np.nan)
    tension, grounded, used = np.full((3, count, len(state.system.lines)), np.nan)
    for j, at in found.items():
        force[j] = at.system.load(at.pose).force[6 * i : 6 * i + 6]
        tension[j], grounded[j], used[j] = at.tension, at.lines.grounded_length, at.lines.utilisation
    return OffsetCurve(body, direction, offsets, force, tension, grounded, used, missed)


def one_line_broken(state: SystemEquilibrium, progress=None):
    """The equilibrium after the loss of each line: {name: SystemEquilibrium, or EquilibriumError without one}.

    The search starts from the intact equilibrium; lines that would hang by only one end are removed too.
    progress : called after each line
    """
    found = {}
    for name in state.system.line_names:
        try:
            left = state.system.without(name)
            kept = [p.name for p in left.free_points]
            chosen = [k for k, p in enumerate(state.system.free_points) if p.name in kept]
            found[name] = rest(left, state.pose._replace(free=state.pose.free[chosen]))
        except (EquilibriumError, LineSystemError) as error:
            found[name] = error
        if progress is not None:
            progress()
    return found


def about_body_axes(stiffness, force, R, center):
    """Stiffness about space axes and the origin, converted to the body's axes and the point `center` in them; shape
    (6, 6).

    force : (3,) N, constant in space, whose lever changes with rotation
    """
    turn = np.kron(np.eye(2), R)
    K = turn.T @ stiffness @ turn
    S = cross_matrix(center)
    shift = np.block([[np.eye(3), S], [np.zeros((3, 3)), np.eye(3)]])
    K = shift.T @ K @ shift
    K[3:, 3:] += cross_matrix(R.T @ force) @ S
    return K
