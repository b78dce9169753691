"""Choice of the method for a scene: capabilities of each method, and the choice by `auto`."""

from __future__ import annotations

import math
from typing import NamedTuple

from hakobune.bem import POWER
from hakobune.bem.database.schema import LIMITS, QUANTITIES
from hakobune.bem.drift import OF_EACH
from hakobune.bem.problem import check_gap

FAR_FIELD = ("kochin_radiation", "kochin_diffraction", "drift_force_fixed", "drift_force")


class Method(NamedTuple):
    """Capabilities of a method, and names of the database that it does not compute, in deep water and in general."""

    shapes: tuple
    highest_gap: float = math.inf
    wall: bool = False
    panels: bool = False
    without: tuple = ()
    without_in_deep_water: tuple = ()


METHODS = {
    "panel": Method(("box", "buoy", "ship", "mesh"), wall=True, panels=True),
    "contour": Method(("box", "buoy"), highest_gap=100.0),  # it keeps tolerances up to there, tests/bench/tolerance.py
    "pressure": Method(("box", "buoy", "ship", "mesh"), wall=True, panels=True, without=("added_mass_infinity",)),
    "strip": Method(("box",), without=(*FAR_FIELD, "pressure"), without_in_deep_water=LIMITS),
    "inverse-strip": Method(("box",), without=(*FAR_FIELD, "pressure"), without_in_deep_water=LIMITS),
}


def chosen_method(scene):
    """Name of METHODS; `auto` selects contour if it can represent the scene of one body and no panels are requested.

    For boxes and vertical cylinders the contour method takes a twentieth of the panel method's time at equal error;
    over a bed far below the keel it loses digits.  For several bodies it lacks the drift of each, which mooring needs.
    """
    if scene.method != "auto":
        return scene.method
    panels = scene.panels is not None or scene.several or _obstacles(scene, METHODS["contour"])
    return "panel" if panels else "contour"


def names_given(scene, names, named):
    """`names` of the database without those that the scene's method or wall does not support.

    named : individually requested names
    raises : ValueError if one of these is among them
    """
    method = scene.solved_by
    missing = _lacking(scene, METHODS[method])
    refused = [name for name in named if name in missing]
    if refused:
        if scene.wall is not None and refused[0] in (*FAR_FIELD, *OF_EACH):
            raise ValueError(f"want has {refused[0]}, which is not computed beside a wall; leave it out")
        if refused[0] == POWER and not scene.damping_lids:
            raise ValueError(f"want has {POWER}, which a scene with damping_lids has; leave it out")
        if refused[0] in OF_EACH and not scene.several:
            raise ValueError(f"want has {refused[0]}, which a scene of several bodies has; leave it out")
        others = [name for name, other in METHODS.items() if refused[0] not in _lacking(scene, other)]
        raise ValueError(
            f"want has {refused[0]}, which method {method} does not give; method {' or '.join(others)} does"
        )
    kept = tuple(name for name in names if name not in missing)
    if not kept:
        raise ValueError(f"want is {', '.join(named)}, none of which method {method} computes here; try another method")
    return kept


def check_method(scene):
    """Raises ValueError, one line, if the scene's method does not exist or does not support the scene."""
    for body in scene.bodies:
        if body.shape != "mesh":
            check_gap(body.draft, scene.water.depth)
    if scene.method != "auto" and scene.method not in METHODS:
        raise ValueError(f"method is {scene.method!r}; allowed: auto, {', '.join(METHODS)}")
    name = scene.solved_by
    obstacles = _obstacles(scene, METHODS[name])
    if scene.panels is not None and not METHODS[name].panels:
        obstacles.append("has no panels: leave panels out, or give a tolerance")
    if obstacles:
        able = [other for other, method in METHODS.items() if not _obstacles(scene, method)]
        way_out = f"; method {' or '.join(able)} can" if able and "leave" not in obstacles[0] else ""
        raise ValueError(f"method {name} {obstacles[0]}{way_out}")


def _lacking(scene, method):
    """Names of the database that a method does not compute for a scene"""
    beside_wall = (*FAR_FIELD, *OF_EACH) if scene.wall is not None else ()
    deep = method.without_in_deep_water if math.isinf(scene.water.depth) else ()
    alone = () if scene.several and method is METHODS["panel"] else tuple(OF_EACH)
    lidless = () if scene.damping_lids else (POWER,)
    return method.without + beside_wall + deep + alone + lidless


def _relative_gap(scene):
    """Water under the keel over the smaller of draft and half the width, of several bodies the largest"""
    each = []
    for body in scene.bodies:
        width = body.radius if body.shape == "buoy" else min(body.length, body.beam) / 2
        each.append((scene.water.depth - body.draft) / min(body.draft, width))
    return max(each)


def _obstacles(scene, method):
    """Why a method cannot represent a scene"""
    out = []
    unknown = [body.shape for body in scene.bodies if body.shape not in method.shapes]
    if scene.several and method not in (METHODS["panel"], METHODS["contour"]):
        out.append("supports one body only")
    elif unknown:
        out.append(f"cannot represent a body of shape {unknown[0]!r}")
    elif math.isfinite(method.highest_gap):
        if math.isinf(scene.water.depth):
            out.append("needs a finite water depth")
        elif _relative_gap(scene) > method.highest_gap:
            out.append(
                f"takes up to {method.highest_gap:g} times the draft or half width of water under the keel, "
                f"not {_relative_gap(scene):.3g}"
            )
    if scene.damping_lids and method is not METHODS["panel"]:
        out.append("does not support damping lids")
    if scene.modes and not method.panels:
        out.append("has the six rigid motions only, not [[modes]]")
    if scene.wall is not None and not method.wall:
        out.append("does not support a wall")
    return out


assert all(name in QUANTITIES for method in METHODS.values() for name in method.without)
