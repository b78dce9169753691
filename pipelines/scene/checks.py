"""Checks of a scene: every fault is one line that names key, value and the allowed values."""

import math
from functools import partial
from pathlib import Path

import numpy as np

from hakobune.meshing.surface.patches import counter_clockwise

from .methods import check_method
from .modes import check_modes
from .tables import FREQUENCY_KEYS, MOST, SHAPES, SceneError, Span, listed
from .viscous_table import viscous_of

CLOSEST = 2e-9  # relative in omega, rad in heading: twice the tolerance for equal values in a database
STANDING = ("box", "buoy")  # shapes that may stand on the bed
EXTENT = 1e-3, 1e6  # m, sizes and places
MOST_BODIES = 100
DAMPING = 1e-6, 10.0  # epsilon of a damping lid
RANGES = {"omegas": (1e-6, 1e4), "periods": (1e-3, 1e7), "xi_B": (1e-9, 1e6), "band": (1e-6, 1e4)}


def stands_on_bed(scene, body):
    """Whether a box or buoy of a scene has no water under it; for a mesh the panels decide this"""
    return body.shape in STANDING and body.fixed and body.draft == scene.water.depth


def check(scene):
    """Raise SceneError for a fault of a `scene.Scene`"""
    _check_water(scene.water)
    _check_bodies(scene)
    _check_waves(scene)
    _check_damping_lids(scene)
    check_modes(scene)
    _check_rest(scene)


def check_depth_given(raw):
    """Raise SceneError without a depth, the only required number that has no default; the message shows how to give
    it.
    """
    water = raw.get("water", {})
    if isinstance(water, dict) and set(water) <= {"density", "gravity"}:
        raise SceneError(
            "water.depth is missing; allowed: above 0 m, or inf; give --depth on the command line, "
            "or depth under [water] in a scene"
        )


def _positive(key, value, infinite=False):
    if not value > 0 or (math.isinf(value) and not infinite):
        raise SceneError(f"{key} is {value}; allowed: above 0" + (", or inf" if infinite else ", finite"))


def _within(key, value, limits):
    """Positive, and of a size whose products and powers do not overflow"""
    _positive(key, value)
    if not limits[0] <= value <= limits[1]:
        raise SceneError(f"{key} is {value}; allowed: {limits[0]:g} to {limits[1]:g}")


def _check_water(water):
    _positive("water.depth", water.depth, infinite=True)
    if math.isfinite(water.depth):
        _within("water.depth", water.depth, EXTENT)
    _within("water.density", water.density, (1e-3, 1e6))
    _within("water.gravity", water.gravity, (1e-3, 1e3))


def _check_bodies(scene):
    if not 1 <= len(scene.bodies) <= MOST_BODIES:
        raise SceneError(f"bodies has {len(scene.bodies)} entries; allowed: 1 to {MOST_BODIES}")
    for number, body in enumerate(scene.bodies):
        check_body(f"bodies[{number}]", body, scene.water.depth)
        if scene.several:
            _check_among_others(f"bodies[{number}]", body)
    if scene.several:
        _check_arrangement(scene)
    else:
        _check_one(scene.body)


def check_body(key, body, depth):
    """Raise SceneError for a `tables.BodyTable` that is impossible in water of a depth, m"""
    if body.shape not in SHAPES:
        raise SceneError(f"{key}.shape is {body.shape!r}; allowed: {', '.join(SHAPES)}")
    _check_sizes(key, body, SHAPES[body.shape])
    if body.shape == "ship":
        _check_ship(key, body)
    if body.shape != "mesh" and body.draft >= depth:
        _check_standing(key, body, depth)
    if body.shape == "mesh" and not Path(body.file).is_file():
        raise SceneError(f"{key}.file is {body.file!r}; there is no such file")
    if body.mass is not None:
        _within(f"{key}.mass", body.mass, (1e-9, 1e18))
    for value in body.gyration or ():
        _within(f"{key}.gyration", value, EXTENT)
    _check_point(f"{key}.center_of_gravity", body.center_of_gravity)
    if body.GM is not None:
        _check_point(f"{key}.GM", (body.GM, 0.0, 0.0))
        if body.center_of_gravity[2]:
            raise SceneError(
                f"{key}.GM is given together with z of center_of_gravity; give one of them, and z = 0 with GM"
            )


def _check_sizes(key, body, own):
    """own : names of the sizes of its shape"""
    for name in dict.fromkeys(name for names in SHAPES.values() for name in names):
        value = getattr(body, name)
        if (name in own) == (value is None):
            said = "missing" if value is None else repr(value)
            raise SceneError(f"{key}.{name} is {said}; the keys of a {body.shape} are {', '.join(own)}")
        if name in own and name not in ("file", "block"):
            _within(f"{key}.{name}", value, EXTENT)
    if body.shape != "ship" and (body.bow, body.stern, body.waterplane) != (None, None, None):
        raise SceneError(
            f"{key} has a fullness of bow or stern, or a waterplane coefficient; a {body.shape} has only "
            f"{', '.join(own)}"
        )


def _check_standing(key, body, depth):
    """Raise SceneError for a body that reaches the bed and does not stand on it"""
    if body.shape in STANDING and body.fixed and body.draft == depth:
        return
    way = ""
    if body.shape in STANDING:
        way = f", or {depth:g} of a body that stands on the bed, which needs fixed = true"
    raise SceneError(f"{key}.draft is {body.draft} m in water {depth} m deep; allowed: below the depth{way}")


def _check_one(body):
    """Checks of keys for one of several bodies"""
    for name in ("place", "rotation_center"):
        if getattr(body, name) is not None:
            way = "give it at the top of the scene" if name == "rotation_center" else "leave it out"
            raise SceneError(f"bodies[0].{name} is {list(getattr(body, name))}, but there is one body; {way}")
    if body.viscous is not None:
        raise SceneError("bodies[0].viscous is given, but there is one body; give its laws under [viscous]")


def _check_among_others(key, body):
    if not body.name or not body.name.isidentifier() or "__" in body.name:
        raise SceneError(
            f"{key}.name is {body.name!r}; allowed: a word of letters, digits and _ for each of several bodies"
        )
    if body.place is None:
        raise SceneError(
            f"{key}.place is missing; each of several bodies needs place = [x, y, heading], in m, m and degrees"
        )
    _check_point(f"{key}.place", (*body.place[:2], 0.0))
    if not -360 <= body.place[2] <= 360:
        raise SceneError(f"{key}.place has the heading {body.place[2]}; allowed: -360 to 360")
    if body.rotation_center is not None:
        _check_point(f"{key}.rotation_center", body.rotation_center)
    if body.viscous is not None and body.fixed:
        raise SceneError(f"{key}.viscous is given, and {body.name} does not move; leave it out")


def _check_arrangement(scene):
    """Names, moving bodies, and keys for single bodies only"""
    names = [body.name for body in scene.bodies]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise SceneError(f"bodies has two bodies named {twice!r}; allowed: each name once")
    if any(scene.rotation_center):
        raise SceneError(
            f"rotation_center is {list(scene.rotation_center)}, but there are several bodies; give it under [[bodies]]"
        )
    damped = [body.name for body in scene.bodies if body.viscous is not None]
    if damped and scene.viscous is None:
        raise SceneError(
            f"{damped[0]} has viscous damping, which needs a wave height; give wave_height under [viscous]"
        )
    files = [body.file for body in scene.bodies if body.shape == "mesh"]
    if scene.panels is not None and files:
        raise SceneError(f"panels is {scene.panels}, but {files[0]} has its own panels; leave the key panels out")


def _check_damping_lids(scene):
    for number, lid in enumerate(scene.damping_lids or ()):
        key = f"damping_lids[{number}]"
        _within(f"{key}.damping", lid.damping, DAMPING)
        for corner in lid.corners or ():
            _check_point(f"{key}.corners", (*corner, 0.0))
        if lid.corners is not None:
            try:
                counter_clockwise(lid.corners)
            except ValueError as error:
                raise SceneError(f"{key}.corners {error}") from None
    if scene.damping_lids and scene.wall is not None:
        raise SceneError("damping_lids and a wall are given; give only one of them")


def _check_ship(key, body):
    from hakobune.meshing.ship import ship

    try:
        ship(body.length, body.beam, body.draft, body.block, bow=body.bow, stern=body.stern,
             waterplane=body.waterplane, counts=(8, 2, 3))  # fmt: skip
    except ValueError as error:
        raise SceneError(f"{key}: {error}") from None


def _check_point(key, point):
    if not all(abs(x) <= EXTENT[1] for x in point):
        raise SceneError(f"{key} is {list(point)}; allowed: three numbers from {-EXTENT[1]:g} to {EXTENT[1]:g}")


def _check_waves(scene):
    given = [key for key in FREQUENCY_KEYS if getattr(scene.waves, key) is not None]
    if len(given) != 1:
        found = " and ".join(given) or "no frequencies"
        raise SceneError(
            f"[waves] has {found}; give exactly one of {', '.join(FREQUENCY_KEYS)} (of the flags: --omega or --period)"
        )
    key = given[0]
    if key == "xi_B" and scene.several:
        raise SceneError("waves.xi_B needs one body with a beam, but there are several; give omegas or periods")
    if key == "xi_B" and scene.body.shape == "mesh":
        raise SceneError("waves.xi_B needs a beam, which a body from a mesh file does not have; give omegas or periods")
    _check_list(f"waves.{key}", getattr(scene.waves, key), partial(_within, limits=RANGES[key]))
    _check_list("waves.headings_deg", scene.waves.headings_deg, _check_heading)
    given = scene.waves.headings_deg
    _check_apart(
        "waves.headings_deg", listed("", given), scene.headings(), turn=2 * np.pi, way_out=_without_the_last(given)
    )
    values = sorted(listed("", getattr(scene.waves, key)), reverse=key == "periods")
    _check_apart(f"waves.{key}", values, scene.omegas())


def _without_the_last(headings):
    """Way out for a range over a full turn, whose ends are one heading; "" for all others"""
    if not isinstance(headings, Span) or abs(headings.last - headings.first - 360) > 1e-6:
        return ""
    count = headings.count - 1
    return f"; a full turn ends one step earlier: from {headings.first:g} to {headings.last - 360 / count:g}, {count}"


def _check_heading(key, value):
    if not -360 <= value <= 360:
        raise SceneError(f"{key} has {value}; allowed: -360 to 360")


def _check_list(key, value, check_one):
    values = listed(key, value)
    if not 1 <= len(values) <= MOST:
        raise SceneError(f"{key} has {len(values)} values; allowed: 1 to {MOST}")
    for one in values:
        check_one(key, one)


def _check_apart(key, given, values, turn=None, way_out=""):
    """Raise SceneError for two values that a database would treat as equal.

    given : as in the scene; values : the same, rising, as in a database; turn : turn of angles
    way_out : end of the message
    """
    given, values = np.sort(given) if turn else np.array(given), np.asarray(values)
    if turn:
        order = np.argsort(values % turn, kind="stable")
        given, values = given[order], values[order] % turn
        given, values = np.append(given, given[0]), np.append(values, values[0] + turn)
    near = np.flatnonzero(np.diff(values) <= CLOSEST * (1.0 if turn else values[1:]))
    if near.size:
        one, other = sorted(given[[near[0], near[0] + 1]])
        again = "" if f"{one:.9g}" == f"{other:.9g}" else f", once as {other:.9g}"
        raise SceneError(f"{key} has {one:.9g} twice{again}; allowed: each value once, {CLOSEST:g} apart{way_out}")


def _check_rest(scene):
    if not 1e-5 <= scene.accuracy <= 0.2:
        raise SceneError(f"tolerance is {scene.tolerance}; allowed: 1e-5 to 0.2")
    if scene.panels is not None and not 1 <= scene.panels <= 100_000:
        raise SceneError(f"panels is {scene.panels}; allowed: 1 to 100000")
    if scene.panels is not None and scene.body.shape == "mesh":
        raise SceneError(
            f"panels is {scene.panels}, but {scene.body.file} has its own panels; leave the key panels out"
        )
    _check_point("rotation_center", scene.rotation_center)
    _check_wall(scene)
    try:
        check_method(scene)
        viscous_of(scene)
        scene.names()
    except ValueError as error:
        raise SceneError(str(error)) from None


def _check_wall(scene):
    if scene.wall is None:
        return
    if not abs(scene.wall) <= EXTENT[1]:
        raise SceneError(f"wall is {scene.wall:g}; allowed: a number from {-EXTENT[1]:g} to {EXTENT[1]:g}, m")
    if scene.several:  # overlaps of several bodies are found on their panels
        return
    half = 0.0 if scene.body.shape == "mesh" else scene.beam / 2
    if abs(scene.wall) <= half:
        raise SceneError(
            f"wall is {scene.wall:g} m from the middle of the body; allowed: more than half its beam, {half:g}"
        )
