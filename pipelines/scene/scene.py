"""A scene: water, one floating body, waves and what is wanted, as typed TOML.

Flags of the commands and scene files end in the same `Scene`; every fault is one line that names key, value
and what is allowed.  Angles are degrees here, as everywhere in this package and nowhere below it.
"""

from __future__ import annotations

import math
from functools import cached_property, partial
from pathlib import Path

import msgspec
import numpy as np

from bem.viscous_table import ViscousTable
from bem.waves import wavenumber

from ..common.typed import of_another, read_toml, typed
from . import products
from .methods import approach, check_method, names_given
from .viscous_table import viscous_of

SHAPES = {
    "box": ("length", "beam", "draft"),
    "buoy": ("radius", "draft"),
    "ship": ("length", "beam", "draft", "block"),
    "mesh": ("file",),
}
FREQUENCY_KEYS = ("omegas", "periods", "xi_B", "band")
MOST = 10_000  # frequencies or headings in one list
CLOSEST = 2e-9  # relative in omega, rad in heading: twice of what is one and the same in a database
EXTENT = 1e-3, 1e6  # m, sizes and places
RANGES = {"omegas": (1e-6, 1e4), "periods": (1e-3, 1e7), "xi_B": (1e-9, 1e6), "band": (1e-6, 1e4)}


class SceneError(ValueError):
    """A scene cannot be used; one line names the key, its value and what is allowed."""


class _Table(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    pass


class Span(_Table):
    """Evenly spaced numbers, both ends included"""

    first: float = msgspec.field(name="from")
    last: float = msgspec.field(name="to")
    count: int


class Band(_Table):
    """A band in which as many frequencies are solved as the tolerance asks for

    from : rad/s
    to : rad/s
    """

    first: float = msgspec.field(name="from")
    last: float = msgspec.field(name="to")


class Water(_Table):
    """Water of the place

    depth : m, inf for deep water
    """

    depth: float
    density: float = 1025.0
    gravity: float = 9.80665


class BodyTable(_Table):
    """The floating body

    shape : box, buoy (vertical cylinder), ship or mesh
    length : m, of a box or ship
    beam : m, of a box or ship
    draft : m, of a box, buoy or ship
    radius : m, of a buoy
    block : coefficient of a ship
    bow : fullness of a ship's waterplane there
    stern : fullness of a ship's waterplane there
    file : of a mesh, beside the scene: .gdf .msh .vtu .pnl …
    mass : kg, left out: that of the displaced water
    center_of_gravity : m, x, y, z; z above still water
    gyration : m, [kxx, kyy, kzz] about the centre of gravity; without them no motions
    trimmed : whether something holds the body as it is drawn, though its weight would turn it
    """

    shape: str = "box"
    length: float | None = None
    beam: float | None = None
    draft: float | None = None
    radius: float | None = None
    block: float | None = None
    bow: float | None = None
    stern: float | None = None
    file: str | None = None
    mass: float | None = None
    center_of_gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    gyration: tuple[float, float, float] | None = None
    trimmed: bool = False


class Waves(_Table):
    """Frequencies, in one of four ways, and headings

    omegas : rad/s, a list or a span
    periods : s, a list or a span
    xi_B : ω²B/2g, a list or a span
    band : in which as many frequencies are solved as the tolerance asks for
    headings_deg : degrees the waves travel to, 0 → +x, 90 → +y, a list or a span
    """

    omegas: list[float] | Span | None = None
    periods: list[float] | Span | None = None
    xi_B: list[float] | Span | None = None
    band: Band | None = None
    headings_deg: list[float] | Span = msgspec.field(default_factory=lambda: [0.0])


class Scene(_Table, dict=True):  # where derived quantities are kept
    """One floating body in water, its waves and what is wanted

    want : names or groups of results, left out: everything
    tolerance : relative error asked for [0.01]; or give panels
    panels : on the whole hull, in place of tolerance
    method : auto, panel, contour, pressure, strip or inverse-strip
    rotation_center : m, x, y, z that rotations and moments are about
    lid : whether there is an interior lid against irregular frequencies
    wall : m, y of a vertical wall along x that reflects all waves
    """

    water: Water
    bodies: list[BodyTable]
    waves: Waves
    want: list[str] | None = None
    tolerance: float | None = None
    panels: int | None = None
    method: str = "auto"
    rotation_center: tuple[float, float, float] = (0.0, 0.0, 0.0)
    lid: bool = True
    wall: float | None = None
    viscous: ViscousTable | None = None

    @property
    def body(self):
        """The body; scenes of several are not solved yet."""
        return self.bodies[0]

    @property
    def accuracy(self):
        """Relative error asked for, by `tolerance` or its default."""
        return 0.01 if self.tolerance is None else self.tolerance

    @property
    def dimensions(self):
        """{name: m} as the shape has them"""
        keys = [key for key in SHAPES[self.body.shape] if key not in ("file", "block")]
        return {key: getattr(self.body, key) for key in keys}

    @property
    def motions_known(self):
        """Whether the inertia of the body is given."""
        return self.body.gyration is not None

    def omegas(self):
        """(n,) rad/s ascending; of a band its ends"""
        return self._omegas

    def headings(self):
        """(m,) rad ascending"""
        return np.radians(np.sort(_listed("waves.headings_deg", self.waves.headings_deg)))

    def names(self):
        """Names of the database that are wanted."""
        return names_given(self, products.expand(self.want, self.motions_known), self.want or ())

    @cached_property
    def approach(self):
        """`pipelines.scene.methods.Approach`: the method that solves the scene, and what it means for it"""
        return approach(self)

    @property
    def raised_bed(self):
        """m, of the bed over which the contour method works if it is above the one that there is, else None"""
        bed = self.approach.bed
        return bed if bed is not None and bed < self.water.depth else None

    @property
    def shortest_wave(self):
        """m, of the highest frequency"""
        return 2 * math.pi / float(wavenumber(self.omegas()[-1], self.water.depth, self.water.gravity))

    @cached_property
    def _omegas(self):
        key = next(key for key in FREQUENCY_KEYS if getattr(self.waves, key) is not None)
        values = np.array(_listed(f"waves.{key}", getattr(self.waves, key)))
        if key == "periods":
            values = 2 * np.pi / values
        elif key == "xi_B":
            values = np.sqrt(2 * self.water.gravity * values / self._beam())
        return np.sort(values)

    def _beam(self):
        return self.body.beam if self.body.beam is not None else 2 * self.body.radius


def read_scene(path):
    """The raw tables of a scene file, mesh file names made relative to here.

    Raises SceneError if the file is not there, not TOML, or a file of another command, which is seen before the tables
    of the command line stand beside it.
    """
    path = Path(path)
    raw, _ = read_toml(path, "a scene", SceneError)
    other = of_another(raw, Scene)
    if other:
        raise SceneError(other)
    bodies = raw.get("bodies")
    for body in bodies if isinstance(bodies, list) else ():
        if isinstance(body, dict) and isinstance(body.get("file"), str):
            body["file"] = str(path.parent / body["file"])
    return raw


def make_scene(raw):
    """A checked Scene of nested dictionaries as TOML gives them.  Raises SceneError."""
    _check_depth_given(raw)
    scene = typed(raw, Scene, SceneError)
    _check_water(scene.water)
    _check_body(scene)
    _check_waves(scene)
    _check_rest(scene)
    return scene


def numbers(key, text):
    """`a,b,c` as a list, `start:stop:count` as the table of a span.  Raises SceneError."""
    try:
        if ":" in text:
            first, last, count = text.split(":")
            return {"from": float(first), "to": float(last), "count": int(count)}
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise SceneError(f"{key} is {text!r}; allowed: a,b,c or start:stop:count") from None


def band(key, text):
    """`auto:from:to` as the table of a band.  Raises SceneError."""
    try:
        word, first, last = text.split(":")
        if word == "auto":
            return {"from": float(first), "to": float(last)}
    except ValueError:
        pass
    raise SceneError(f"{key} is {text!r}; allowed: auto:from:to in rad/s, as auto:0.1:2.0")


def _listed(key, value):
    if isinstance(value, Band):
        if not (math.isfinite(value.first) and math.isfinite(value.last) and value.first < value.last):
            raise SceneError(f"{key}: from {value.first} to {value.last}; allowed: finite, from below to")
        return [value.first, value.last]
    if not isinstance(value, Span):
        return [float(v) for v in value]
    if not 2 <= value.count <= MOST:
        raise SceneError(f"{key}: count is {value.count}; allowed: 2 to {MOST}")
    if not (math.isfinite(value.first) and math.isfinite(value.last) and value.first < value.last):
        raise SceneError(f"{key}: from {value.first} to {value.last}; allowed: finite, from below to")
    return np.linspace(value.first, value.last, value.count).tolist()


def _positive(key, value, infinite=False):
    if not value > 0 or (math.isinf(value) and not infinite):
        raise SceneError(f"{key} is {value}; allowed: above 0" + (", or inf" if infinite else ", finite"))


def _within(key, value, limits):
    """Positive, and of a size that leaves room for products and powers of it"""
    _positive(key, value)
    if not limits[0] <= value <= limits[1]:
        raise SceneError(f"{key} is {value}; allowed: {limits[0]:g} to {limits[1]:g}")


def _check_depth_given(raw):
    """The one number without a default that every body needs: how it is given, to one who gave nothing."""
    water = raw.get("water", {})
    if isinstance(water, dict) and set(water) <= {"density", "gravity"}:
        raise SceneError(
            "water.depth is missing; allowed: above 0 m, or inf; give --depth on the command line, "
            "or depth under [water] in a scene"
        )


def _check_water(water):
    _positive("water.depth", water.depth, infinite=True)
    if math.isfinite(water.depth):
        _within("water.depth", water.depth, EXTENT)
    _within("water.density", water.density, (1e-3, 1e6))
    _within("water.gravity", water.gravity, (1e-3, 1e3))


def _check_body(scene):
    if len(scene.bodies) != 1:
        raise SceneError(f"bodies has {len(scene.bodies)} entries; allowed: one")
    body = scene.body
    if body.shape not in SHAPES:
        raise SceneError(f"bodies[0].shape is {body.shape!r}; allowed: {', '.join(SHAPES)}")
    own = SHAPES[body.shape]
    for key in dict.fromkeys(key for keys in SHAPES.values() for key in keys):
        value = getattr(body, key)
        if key in own and value is None:
            raise SceneError(f"bodies[0].{key} is missing; a {body.shape} has {', '.join(own)}")
        if key not in own and value is not None:
            raise SceneError(f"bodies[0].{key} is {value!r}; a {body.shape} has {', '.join(own)}")
        if key in own and key not in ("file", "block"):
            _within(f"bodies[0].{key}", value, EXTENT)
    if body.shape == "ship":
        _check_ship(body)
    elif body.bow is not None or body.stern is not None:
        raise SceneError(f"bodies[0] has a fullness of bow or stern; a {body.shape} has {', '.join(own)}")
    if body.shape != "mesh" and body.draft >= scene.water.depth:
        raise SceneError(
            f"bodies[0].draft is {body.draft} in water {scene.water.depth} m deep; allowed: below the depth"
        )
    if body.shape == "mesh" and not Path(body.file).is_file():
        raise SceneError(f"bodies[0].file is {body.file!r}; there is no such file")
    if body.mass is not None:
        _within("bodies[0].mass", body.mass, (1e-9, 1e18))
    for value in body.gyration or ():
        _within("bodies[0].gyration", value, EXTENT)
    _check_point("bodies[0].center_of_gravity", body.center_of_gravity)


def _check_ship(body):
    from meshing.ship import ship

    try:
        ship(body.length, body.beam, body.draft, body.block, bow=body.bow, stern=body.stern, counts=(8, 2, 3))
    except ValueError as error:
        raise SceneError(f"bodies[0]: {error}") from None


def _check_point(key, point):
    if not all(abs(x) <= EXTENT[1] for x in point):
        raise SceneError(f"{key} is {list(point)}; allowed: three numbers from {-EXTENT[1]:g} to {EXTENT[1]:g}")


def _check_waves(scene):
    given = [key for key in FREQUENCY_KEYS if getattr(scene.waves, key) is not None]
    if len(given) != 1:
        found = " and ".join(given) or "no frequencies"
        raise SceneError(f"waves has {found}; give one of {', '.join(FREQUENCY_KEYS)}")
    key = given[0]
    if key == "xi_B" and scene.body.shape == "mesh":
        raise SceneError("waves.xi_B needs a beam, a body from a mesh file has none; give omegas or periods")
    _check_list(f"waves.{key}", getattr(scene.waves, key), partial(_within, limits=RANGES[key]))
    _check_list("waves.headings_deg", scene.waves.headings_deg, _check_heading)
    _check_apart("waves.headings_deg", _listed("", scene.waves.headings_deg), scene.headings(), turn=2 * np.pi)
    values = sorted(_listed("", getattr(scene.waves, key)), reverse=key == "periods")
    _check_apart(f"waves.{key}", values, scene.omegas())


def _check_heading(key, value):
    if not -360 <= value <= 360:
        raise SceneError(f"{key} has {value}; allowed: -360 to 360")


def _check_list(key, value, check_one):
    values = _listed(key, value)
    if not 1 <= len(values) <= MOST:
        raise SceneError(f"{key} has {len(values)} values; allowed: 1 to {MOST}")
    for one in values:
        check_one(key, one)


def _check_apart(key, given, values, turn=None):
    """Raise SceneError for two that a database would take for one.

    given : as the scene has them; values : the same, rising, as a database has them; turn : of angles
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
        raise SceneError(f"{key} has {one:.9g} twice{again}; allowed: each value once, {CLOSEST:g} apart")


def _check_rest(scene):
    if scene.tolerance is not None and scene.panels is not None:
        raise SceneError(f"tolerance is {scene.tolerance} and panels is {scene.panels}; allowed: one of the two")
    if not 1e-5 <= scene.accuracy <= 0.2:
        raise SceneError(f"tolerance is {scene.tolerance}; allowed: 1e-5 to 0.2")
    if scene.panels is not None and not 8 <= scene.panels <= 100_000:
        raise SceneError(f"panels is {scene.panels}; allowed: 8 to 100000")
    if scene.panels is not None and scene.body.shape == "mesh":
        raise SceneError(f"panels is {scene.panels}, but {scene.body.file} has its own; leave panels out")
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
    half = 0.0 if scene.body.shape == "mesh" else scene._beam() / 2
    if abs(scene.wall) <= half:
        raise SceneError(
            f"wall is {scene.wall:g} m from the middle of the body; allowed: more than half its beam, {half:g}"
        )
