"""Tables of water and of regular waves that several studies use."""

import math

from ..quantities import StudyError, Table

GRAVITY = 9.80665


class DepthTable(Table):
    """Water at the place

    depth : m, water depth
    """

    depth: float


class WaterTable(DepthTable):
    """Water at the place"""

    density: float = 1025.0
    gravity: float = 9.80665


class WaveTable(Table):
    """A regular wave

    height : m, wave height, crest to trough
    period : s, wave period
    """

    height: float
    period: float
    direction_deg: float | None = None
    incidence_deg: float | None = None


def check_solved_depth(depth, solved, name, period=None):
    """Raise StudyError if waves in `depth` m differ from those in `solved` m, the depth in which a body is solved.

    Deep-water waves are equal in all depths above half their length.
    name : name of the solved body or file; period : mean period of the waves, s, None in still water
    """
    if math.isclose(depth, solved, rel_tol=1e-6):
        return
    if math.isfinite(solved):
        raise StudyError(f"water.depth is {depth:g} m, but {name} is for {solved:g} m; allowed: the same depth")
    felt = 0.0 if period is None else GRAVITY * period**2 / (4 * math.pi)
    if felt > depth:
        raise StudyError(
            f"water.depth is {depth:g} m, but {name} is for deep water, and the bed affects waves of "
            f"{period:.3g} s in depths below {felt:.3g} m; solve the body in {depth:g} m"
        )
