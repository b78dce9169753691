"""Which method solves a scene: what each can represent, what it gives, and how `auto` chooses."""

from __future__ import annotations

import math
from typing import NamedTuple

from hakobune.bem import POWER
from hakobune.bem.contour.raised_bed import raised_bed
from hakobune.bem.contour.short_waves import MOST_WAVES, unresolved, waves_along
from hakobune.bem.database.schema import LIMITS, QUANTITIES
from hakobune.bem.drift import OF_EACH
from hakobune.bem.problem import check_gap
from hakobune.bem.waves import wavenumber

FAR_FIELD = ("kochin_radiation", "kochin_diffraction", "drift_force_fixed", "drift_force")
FAR_FIELD_GROUPS = ("kochin", "drift")  # of `products`


class Method(NamedTuple):
    """What a method can represent, and the names of the database that it does not give, in deep water and at all."""

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


class Approach(NamedTuple):
    """How a scene is solved.

    method : name, of METHODS; bed : m, over which the contour method works (`bem.contour.raised_bed`), None for the
        one that there is
    highest_resolved : rad/s above which frequencies are answered by `bem.contour.short_wave_frequency`, None where
        none is
    """

    method: str
    bed: float | None
    highest_resolved: float | None


def approach(scene):
    """`Approach` of a scene; `auto` takes contour where it can represent the scene and no panels are asked for.

    Boxes and vertical cylinders take the contour method a twentieth of the panel method's time at equal error; over
    a bed far below the keel it loses digits, unless waves are so short that the bed can be raised.
    """
    bed = _raised_bed(scene)
    method = _chosen(scene, bed) if scene.method == "auto" else scene.method
    return Approach(method, bed, _highest_resolved(scene)) if method == "contour" else Approach(method, None, None)


def _chosen(scene, bed):
    return "panel" if scene.panels is not None or _obstacles(scene, METHODS["contour"], bed) else "contour"


def _raised_bed(scene):
    """m, the bed over which contour answers a scene of short waves alone in deep water, or None"""
    body, water = scene.body, scene.water
    if scene.several or body.shape in ("ship", "mesh") or _relative_gap(scene) <= METHODS["contour"].highest_gap:
        return None
    longest = wavenumber(scene.omegas()[0], water.depth, water.gravity)
    bed = raised_bed(body.shape, tuple(scene.dimensions.values()), scene.accuracy, float(longest))
    return None if bed is None else min(bed, water.depth)


def _highest_resolved(scene):
    if scene.several or scene.body.shape not in MOST_WAVES:
        return None
    sizes, water = tuple(scene.dimensions.values()), scene.water
    highest = wavenumber(scene.omegas()[-1], water.depth, water.gravity)
    if not unresolved(sizes, float(highest)):
        return None
    k = MOST_WAVES[scene.body.shape] / waves_along(sizes, 1.0)
    return math.sqrt(water.gravity * k * math.tanh(k * water.depth))


def names_given(scene, names, named):
    """`names` of the database without those that the scene's method or wall does not give.

    named : words asked for one by one
    raises : ValueError if one of these is among them, or a far field where waves are too many
    """
    method, _, highest = scene.approach
    missing = _lacking(scene, METHODS[method])
    refused = [name for name in named if name in missing]
    far = [word for word in named if word in (*FAR_FIELD, *FAR_FIELD_GROUPS)]
    if far and highest:
        raise ValueError(
            f"want has {far[0]}, which frequencies above {highest:.4g} rad/s, with more than "
            f"{MOST_WAVES[scene.body.shape]} waves along the body, do not have; leave it or them out"
        )
    if refused:
        if scene.wall is not None and refused[0] in FAR_FIELD:
            raise ValueError(f"want has {refused[0]}, which a body beside a wall does not have; leave it out")
        if refused[0] == POWER and not scene.damping_lids:
            raise ValueError(f"want has {POWER}, which a scene with damping_lids has; leave it out")
        if refused[0] in OF_EACH:
            raise ValueError(f"want has {refused[0]}, which a scene of several bodies has; leave it out")
        others = [name for name, other in METHODS.items() if refused[0] not in _lacking(scene, other)]
        raise ValueError(
            f"want has {refused[0]}, which method {method} does not give; method {' or '.join(others)} does"
        )
    kept = tuple(name for name in names if name not in missing)
    if not kept:
        raise ValueError(f"want is {', '.join(named)}, of which method {method} gives nothing here; another method may")
    return kept


def check_method(scene):
    """Raises ValueError, one line, if the scene's method does not exist or cannot represent it."""
    for body in scene.bodies:
        if body.shape != "mesh":
            check_gap(body.draft, scene.water.depth)
    if scene.method != "auto" and scene.method not in METHODS:
        raise ValueError(f"method is {scene.method!r}; allowed: auto, {', '.join(METHODS)}")
    name, bed = scene.approach.method, _raised_bed(scene)
    obstacles = _obstacles(scene, METHODS[name], bed)
    if scene.panels is not None and not METHODS[name].panels:
        obstacles.append("has no panels: leave panels out, or give a tolerance")
    if obstacles:
        able = [other for other, method in METHODS.items() if not _obstacles(scene, method, bed)]
        way_out = f"; method {' or '.join(able)} can" if able and "leave" not in obstacles[0] else ""
        raise ValueError(f"method {name} {obstacles[0]}{way_out}")


def _lacking(scene, method):
    """Names of the database that a method does not give for a scene"""
    beside_wall = FAR_FIELD if scene.wall is not None else ()
    deep = method.without_in_deep_water if math.isinf(scene.water.depth) else ()
    alone = () if scene.several else tuple(OF_EACH)
    lidless = () if scene.damping_lids else (POWER,)
    short = FAR_FIELD if method is METHODS["contour"] and scene.approach.highest_resolved else ()
    return method.without + beside_wall + deep + short + alone + lidless


def _relative_gap(scene):
    """Water under the keel over the smaller of draft and half the width"""
    body = scene.body
    width = body.radius if body.shape == "buoy" else min(body.length, body.beam) / 2
    return (scene.water.depth - body.draft) / min(body.draft, width)


def _obstacles(scene, method, bed):
    """Why a method cannot represent a scene, over the bed (m) that can be raised for it, or None"""
    out = []
    if scene.several and method is not METHODS["panel"]:
        out.append("knows one body alone")
    elif scene.body.shape not in method.shapes:
        out.append(f"cannot represent a body of shape {scene.body.shape!r}")
    elif math.isfinite(method.highest_gap) and bed is None:
        if math.isinf(scene.water.depth):
            out.append("needs a finite water depth")
        elif _relative_gap(scene) > method.highest_gap:
            out.append(
                f"takes up to {method.highest_gap:g} times the draft or half width of water under the keel, "
                f"not {_relative_gap(scene):.3g}"
            )
    if scene.damping_lids and method is not METHODS["panel"]:
        out.append("knows no damping lids")
    if scene.wall is not None and not method.wall:
        out.append("knows no wall")
    return out


assert all(name in QUANTITIES for method in METHODS.values() for name in method.without)
