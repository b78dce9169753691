"""Choice of the method for a scene: capabilities of each method, and the choice by `auto`."""

import math
from typing import NamedTuple

from hakobune.bem import POWER
from hakobune.bem.database.schema import LIMITS, QUANTITIES
from hakobune.bem.drift import OF_EACH
from hakobune.bem.problem import check_gap

FAR_FIELD = ("kochin_radiation", "kochin_diffraction", "drift_force_fixed", "drift_force")


class Method(NamedTuple):
    """The scenes that a method can represent, and the names in the database that it does not compute: in deep water, or
    whatever the depth.

    fewest, most : bodies
    """

    shapes: tuple
    highest_gap: float = math.inf
    wall: bool = False
    panels: bool = False
    without: tuple = ()
    without_in_deep_water: tuple = ()
    fewest: int = 1
    most: float = 1  # bodies


METHODS = {
    "panel": Method(("box", "buoy", "ship", "mesh"), wall=True, panels=True, most=math.inf),
    # it keeps tolerances up to there, tests/bench/tolerance.py
    "contour": Method(("box", "buoy"), highest_gap=100.0, most=math.inf),
    "transfer": Method(("box", "buoy"), highest_gap=100.0, fewest=2, most=math.inf),
    "pressure": Method(("box", "buoy", "ship", "mesh"), wall=True, panels=True, without=("added_mass_infinity",)),
    "strip": Method(("box",), without=(*FAR_FIELD, "pressure"), without_in_deep_water=LIMITS),
    "inverse-strip": Method(("box",), without=(*FAR_FIELD, "pressure"), without_in_deep_water=LIMITS),
}


def chosen_method(scene):
    """Name of METHODS; `auto` selects contours, transfer matrices or panels.

    Contours are selected if they can represent a scene of one body, transfer matrices if they can represent one of
    several bodies, and panels otherwise, or if a number of panels is given.

    For boxes and vertical cylinders the contour method takes a twentieth of the panel method's time at equal error.
    Over a bed far below the keel it loses digits.
    Several bodies whose circles do not overlap are solved one shape at a time. Jobs with four frequencies and two or
    three bodies took a fifth to a third of the panel method's time, but 1.2 times this time with circles 0.03 of the
    depth apart. A contour around all bodies does not give the drift of each body, which moorings need. It takes
    longer than panels if a gap is a twentieth of the beam.
    """
    if scene.method != "auto":
        return scene.method
    quick = "transfer" if scene.several else "contour"
    return "panel" if scene.panels is not None or _obstacles(scene, METHODS[quick]) else quick


def names_given(scene, names, named):
    """Those `names` of the database that the scene's method and wall support.

    named : individually requested names
    raises : ValueError if one of `named` is not supported
    """
    method = scene.solved_by
    missing = _lacking(scene, METHODS[method])
    refused = [name for name in named if name in missing]
    if refused:
        if scene.wall is not None and refused[0] in (*FAR_FIELD, *OF_EACH):
            raise ValueError(f"want has {refused[0]}, which is not computed beside a wall; leave it out")
        if refused[0] == POWER and not scene.damping_lids:
            raise ValueError(f"want has {POWER}, which is computed only for a scene with damping_lids; leave it out")
        if refused[0] in OF_EACH and not scene.several:
            raise ValueError(f"want has {refused[0]}, which is computed only for several bodies; leave it out")
        able = {name: other for name, other in METHODS.items() if scene.several or other.fewest == 1}
        others = [name for name, other in able.items() if refused[0] not in _lacking(scene, other)]
        raise ValueError(
            f"want has {refused[0]}, which method {method} does not compute; use method {' or '.join(others)}"
        )
    kept = tuple([name for name in names if name not in missing])
    if not kept:
        raise ValueError(f"want is {', '.join(named)}, none of which method {method} computes here; try another method")
    return kept


def check_method(scene):
    """Raises ValueError, with a message of one line, if the scene's method does not exist or does not support the
    scene."""
    for body in scene.bodies:
        if body.shape != "mesh" and not (body.fixed and body.draft == scene.water.depth):
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
    knows_each = method in (METHODS["panel"], METHODS["transfer"])
    alone = () if scene.several and knows_each else tuple(OF_EACH)
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
    if len(scene.bodies) > method.most:
        out.append("supports one body only")
    elif len(scene.bodies) < method.fewest:
        out.append("is for several bodies")
    elif unknown:
        out.append(f"cannot represent a body of shape {unknown[0]!r}")
    elif math.isfinite(method.highest_gap):
        if math.isinf(scene.water.depth):
            out.append("needs a finite water depth")
        elif _relative_gap(scene) > method.highest_gap:
            out.append(
                f"allows water under the keel up to {method.highest_gap:g} times the draft or half width, and here it "
                f"is {_relative_gap(scene):.3g} times"
            )
    if method is METHODS["transfer"] and not out:
        out += _circles(scene)
    if scene.damping_lids and method is not METHODS["panel"]:
        out.append("does not support damping lids")
    if scene.modes and not method.panels:
        out.append("supports only the six rigid motions, not [[modes]]")
    if scene.wall is not None and not method.wall:
        out.append("does not support a wall")
    return out


def _circles(scene):
    """Why the bodies of a scene are too near for transfer matrices, one line or none"""
    from hakobune.bem.transfer.circles import SHARE_OF_DEPTH, too_near

    radii = [one.radius if one.shape == "buoy" else math.hypot(one.length, one.beam) / 2 for one in scene.bodies]
    found = too_near([complex(*one.place[:2]) for one in scene.bodies], radii, scene.water.depth)
    if found is not None:
        names = " and ".join(scene.bodies[i].name for i in found[:2])
        yield (
            f"needs circles around the bodies that are {SHARE_OF_DEPTH * scene.water.depth:.3g} m apart; the circles "
            f"around {names} {found[2]}"
        )


assert all(name in QUANTITIES for method in METHODS.values() for name in method.without)
