"""Checks that the parts of a system are consistent (names, ends, places); the first fault is reported in one line."""

import numpy as np

from .parts import Fairlead, LineSystemError

ON_BED = 1e-6  # m: height above the bed below which a point lies on it


def check_system(system):
    if not 0 < system.depth < np.inf:
        raise LineSystemError(f"depth is {system.depth:g} m; allowed: above 0, finite")
    for name, unit in (("density", "kg/m³"), ("gravity", "m/s²")):
        value = getattr(system, name)
        if not 0 <= value < np.inf:
            raise LineSystemError(f"{name} is {value:g} {unit}; allowed: finite, at least 0")
    _check_names("line", system.lines)
    _check_names("point", system.points)
    _check_names("body", system.bodies)
    if not system.lines:
        raise LineSystemError("the system has no lines; allowed: at least one")
    _check_points(system)
    _check_ends(system)
    _ = system.composites  # raises for impossible lines of segments


def _check_names(what, parts):
    seen = set()
    for part in parts:
        if part.name in seen:
            raise LineSystemError(f"{what} name {part.name!r} is used twice; give each a name of its own")
        seen.add(part.name)


def _check_points(system):
    bodies = {body.name for body in system.bodies}
    for point in system.points:
        if np.shape(point.position) != (3,) or not np.all(np.isfinite(point.position)):
            raise LineSystemError(f"point {point.name}: position is {point.position}; allowed: three finite numbers")
        if isinstance(point, Fairlead):
            if point.body not in bodies:
                known = ", ".join(sorted(bodies)) or "none, the system has no body"
                raise LineSystemError(f"point {point.name}: body {point.body!r} is unknown; allowed: {known}")
        elif point.position[2] < -system.depth - ON_BED:
            raise LineSystemError(
                f"point {point.name}: z is {point.position[2]:g} m; allowed: at or above the bed, {-system.depth:g} m"
            )


def _check_ends(system):
    names = {point.name for point in system.points}
    used = set()
    for line in system.lines:
        for end in (line.a, line.b):
            if end not in names:
                known = ", ".join(sorted(names))
                raise LineSystemError(
                    f"line {line.name}: its end {end!r} is not a point of the system; allowed: {known}"
                )
        if line.a == line.b:
            raise LineSystemError(f"line {line.name}: both ends are at {line.a!r}; allowed: two different points")
        used |= {line.a, line.b}
    loose = [point.name for point in system.free_points if point.name not in used]
    if loose:
        raise LineSystemError(f"point {loose[0]!r} is free, but no line holds it; allowed: at least one line")
