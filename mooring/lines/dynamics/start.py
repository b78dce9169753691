"""The line at rest: nodes on the exact catenary, then moved into the equilibrium of the lumped line itself."""

import numpy as np

from hakobune.bem.kernels.jit import as_python

from ..catenary.solve import profile, solve_lines
from ..catenary.state import LineError, State
from .lumped import system as lumped

LIGHTEST = 1e-6  # least weight of a line in the first guess, as a share of all weights
SOFT = 1e4  # axial stiffness over the weight, in the first guess for Newton's method
LOOSE = 1e3  # m, slip that mobilises friction: friction then acts as a force, not as a spring
MANY = 1000  # elements: of a chain of 315 m in 60 m they come to rest, 2300 do not
LEAST_PACKED = 0.5  # least initial length of slack elements on the bed, over their length


def start(line, fairlead, water):
    """State of a line at rest with its fairlead at (3,) m, in still water or a current.

    Friction acts as on a line pulled out from slack: it is fully mobilised from the touchdown point on. A line with
    bending stiffness starts from its shape without this stiffness, and must behave as a line: see `_check_bending`.
    raises : LineError where no equilibrium was found
    """
    fairlead, slip = np.asarray(fairlead, float), np.zeros((line.elements + 1, 3))
    if line.bends:
        q = start(line.without_bending(), fairlead, water).position
        _check_bending(line, q)
    else:
        q = _guess(line, fairlead)
    q[0], q[-1] = line.anchor, fairlead
    # with its true stiffness, friction would keep the nodes at the positions of the guess
    loose = line.system._replace(bed_slip=LOOSE)
    good = _settled(loose, water, q, slip)
    if good and loose.bed_friction > 0:
        slip = _mobilised(line.system, q)
        good = _settled(loose, water, q, LOOSE / line.system.bed_slip * slip)
    if not good:
        way_out = f"give {'fewer' if line.elements > MANY else 'more'} elements"
        raise LineError(
            f"no static shape found for the {line} with its fairlead at x = {fairlead[0]:.6g}, y = {fairlead[1]:.6g}, "
            f"z = {fairlead[2]:.6g} m; {way_out}, or start where the line hangs freely"
        )
    zero = np.zeros_like(q)
    return lumped.State(0.0, q, zero, zero.copy(), slip, np.inf)


def _check_bending(line, q):
    """Refuse, by a LineError, a line that would hang as a beam at rest at q: its elements carry no compression.

    √(EI/T), over which a line bends at its ends, reaches its middle where 4 EI = T L².
    """
    stiffest = max(line.segments, key=lambda one: one.bending_stiffness)
    tension = float(lumped.elastic_tension(line.system, q).max())
    if 4 * stiffest.bending_stiffness > tension * line.length**2:
        raise LineError(
            f"{line}: the bending stiffness EI of {0.001 * stiffest.bending_stiffness:.4g} kN m² shapes the line "
            f"more than its tension of at most {0.001 * tension:.4g} kN (at rest, without EI) does; allowed: up to "
            f"{0.00025 * tension * line.length**2:.4g} kN m², T L²/4"
        )


def _settled(system, water, q, slip):
    """Whether q is now in equilibrium; a stiff line is stiffened in steps, as its nodes start 1e-4 of ℓ off."""
    from .lumped.settle import settle
    from .lumped.workspace import workspace

    limit = SOFT * np.abs(system.weight).sum()
    while limit < system.stiffness.max():
        soft = system._replace(stiffness=np.minimum(system.stiffness, limit))
        settle(soft, workspace(soft), water, q, slip)
        limit *= 10
    return settle(system, workspace(system), water, q, slip) > 0


def _mobilised(system, q):
    """Slip of nodes at rest at q, m; shape (N + 1, 3): from the highest one on the bed down, as far as there is
    tension."""
    along = np.diff(q, axis=0)
    length = np.linalg.norm(along, axis=1)
    tension = lumped.elastic_tension(system, q)
    h = system.bed_thickness
    p = h - lumped.above_bed(system, q)
    reaction = system.bed_stiffness * np.where(p < h, 0.5 * np.maximum(p, 0.0) ** 2 / h, p - 0.5 * h)
    held, slip = 0.0, np.zeros_like(q)
    for j in range(len(q) - 2, 0, -1):
        most = system.bed_friction * reaction[j]
        if most > 0:
            force = min(max(tension[j - 1] - held, 0.0), most)
            held += force
            slip[j] = system.bed_slip * force / most * along[j - 1] / length[j - 1]
    return slip


@as_python()
def _guess(line, fairlead):
    """Nodes (N + 1, 3) on the catenary of a uniform line of the same weight."""
    away = fairlead - line.anchor
    span = np.hypot(*away[:2])
    heading = away[:2] / span if span > 0 else np.array([1.0, 0.0])
    s, system = line.nodes, line.system
    weight = (system.weight - system.body_buoyancy).sum() / line.length
    EA = line.length / np.sum(system.length / (system.stiffness * system.elongation[system.elongation_rows[:, 0], 2]))
    up = -1.0 if weight < 0 else 1.0  # a floating line is a hanging one, upside down
    slope, friction, bed = _along(line, heading) if up > 0 else (0.0, 0.0, False)
    least = LIGHTEST * np.abs(system.weight).sum() / line.length
    given = (span, up * away[2], line.length, max(up * weight, least), EA, friction, slope)
    uniform = len(line.segments) == 1
    points = profile(*given, bed=bed, points=s.size if uniform else 20 * s.size)
    along = np.linspace(0.0, line.length, len(points))
    x, z = points.T if uniform else (np.interp(s, along, value) for value in points.T)
    if bed:
        found = solve_lines(*given)
        if found.status == State.SLACK:
            x, z = _folded(x, z, s, float(found.grounded_length), span, slope)
    q = line.anchor + np.column_stack([x * heading[0], x * heading[1], up * z])
    if line.bed is not None and line.bed.points:
        q[:, 2] += np.maximum(-lumped.above_bed(system, q), 0.0)
    return q


def _folded(x, z, s, lying, span, slope):
    """A slack line is laid straight out past the anchor and back, where its part on the bed would be a heap."""
    reach = span / np.cos(slope)
    if lying == 0 or reach > LEAST_PACKED * lying:
        return x, z
    on_bed, back = s < lying, 0.5 * (lying - reach)
    along = np.abs(s - back) - back
    return np.where(on_bed, along * np.cos(slope), x), np.where(on_bed, along * np.sin(slope), z)


def _along(line, heading):
    """Slope under the line, friction, and whether the anchor lies on the bed."""
    if line.bed is None or line.bed.below > 0:
        return 0.0, 0.0, False
    up = heading @ [np.cos(line.bed.uphill), np.sin(line.bed.uphill)]
    return float(np.arctan(np.tan(line.bed.slope) * up)), line.bed.friction, True
