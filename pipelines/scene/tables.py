"""Tables of a scene with their keys, units and defaults (`scene.Scene` joins them), and the numbers of their lists."""

from __future__ import annotations

import math

import msgspec
import numpy as np

from hakobune.bem.viscous_table import Laws

SHAPES = {
    "box": ("length", "beam", "draft"),
    "buoy": ("radius", "draft"),
    "ship": ("length", "beam", "draft", "block"),
    "mesh": ("file",),
}
FREQUENCY_KEYS = ("omegas", "periods", "xi_B", "band")
MOST = 10_000  # frequencies or headings in one list


class SceneError(ValueError):
    """A scene cannot be used; one line names the key, its value and what is allowed."""


class SceneTable(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """Of keys that are all known, each given by name"""


class Span(SceneTable):
    """Evenly spaced numbers, both ends included"""

    first: float = msgspec.field(name="from")
    last: float = msgspec.field(name="to")
    count: int


class Band(SceneTable):
    """A band of frequencies, as many as the tolerance needs

    from : rad/s
    to : rad/s
    """

    first: float = msgspec.field(name="from")
    last: float = msgspec.field(name="to")


class Water(SceneTable):
    """Water of the place

    depth : m, inf for deep water
    """

    depth: float
    density: float = 1025.0
    gravity: float = 9.80665


class BodyTable(SceneTable):
    """The floating body, or one of several

    shape : box, buoy (vertical cylinder), ship or mesh
    length : m, of a box or ship
    beam : m, of a box or ship
    draft : m, of a box, buoy or ship
    radius : m, of a buoy
    block : coefficient of a ship
    bow : fullness of the waterplane of a ship at this end
    stern : fullness of the waterplane of a ship at this end
    waterplane : waterplane coefficient of a ship, in place of bow and stern
    file : mesh file beside the scene: .gdf .msh .vtu .pnl …
    mass : kg, by default that of the displaced water
    center_of_gravity : m, x, y, z; z above still water
    GM : m, transverse metacentric height, in place of z of the centre of gravity
    gyration : m, [kxx, kyy, kzz] about the centre of gravity; without them no motions
    trimmed : whether the body is held in its drawn trim, though its weight would turn it
    name : name of one of several bodies, a prefix of the names of its motions
    place : m, m, degrees; place of the origin of one of several bodies, and its heading
    rotation_center : m, x, y, z from the origin of one of several bodies, the point of its rotations and moments
    fixed : whether one of several bodies is fixed and scatters waves, as a caisson or a pier
    viscous : damping of one of several bodies; [viscous] of the scene has the wave height
    """

    shape: str = "box"
    length: float | None = None
    beam: float | None = None
    draft: float | None = None
    radius: float | None = None
    block: float | None = None
    bow: float | None = None
    stern: float | None = None
    waterplane: float | None = None
    file: str | None = None
    mass: float | None = None
    center_of_gravity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    GM: float | None = None
    gyration: tuple[float, float, float] | None = None
    trimmed: bool = False
    name: str | None = None
    place: tuple[float, float, float] | None = None
    rotation_center: tuple[float, float, float] | None = None
    fixed: bool = False
    viscous: Laws | None = None


class ModeTable(SceneTable):
    """Shapes in which a body bends or twists: the lowest of a free beam along x, or one from a file

    kind : "vertical bending", "horizontal bending", "torsion" or "file"
    body : name of one of several bodies; by default a shape in a file belongs to all that move
    count : number of shapes of a beam, the lowest first
    EI : N m², of bending
    GJ : N m², of torsion
    length : m, length of the beam about the middle of the hull; by default that of the hull
    mass_per_length : kg/m, by default mass over length
    inertia_per_length : kg m, of torsion, left out: mass times kxx² over length
    axis_height : m, z of the neutral axis, or for torsion of the shear centre
    damping : ratio to critical damping, of each shape in air
    file : rows x, y, z (m, of the body, or of the scene), ux, uy, uz of a unit of the shape, and mass (kg) where known
    name : of the shape in a file
    stiffness : N/m, of the shape in a file
    mass : kg, mass of the shape in a file without masses
    """

    kind: str
    body: str | None = None
    count: int = 4
    EI: float | None = None
    GJ: float | None = None
    length: float | None = None
    mass_per_length: float | None = None
    inertia_per_length: float | None = None
    axis_height: float = 0.0
    damping: float = 0.0
    file: str | None = None
    name: str | None = None
    stiffness: float | None = None
    mass: float | None = None


class DampingLidTable(SceneTable):
    """A lid on the water between hulls or in a moonpool that takes energy, for the loss in eddies

    damping : epsilon of g phi_z = omega^2 (1 + i epsilon) phi; tests with gaps and moonpools give 0.02 to 0.07
    corners : m, [[x, y], …] corners of a convex polygon on the water; by default all moonpools of the bodies
    """

    damping: float
    corners: list[tuple[float, float]] | None = None


class Waves(SceneTable):
    """Frequencies, in one of four ways, and headings

    omegas : rad/s, a list or a span
    periods : s, a list or a span
    xi_B : ω²B/2g, a list or a span
    band : band of frequencies, as many as the tolerance needs
    headings_deg : degrees the waves travel to, 0 → +x, 90 → +y, a list or a span
    """

    omegas: list[float] | Span | None = None
    periods: list[float] | Span | None = None
    xi_B: list[float] | Span | None = None
    band: Band | None = None
    headings_deg: list[float] | Span = msgspec.field(default_factory=lambda: [0.0])


def listed(key, value):
    """The numbers of a list, a Span or, of a Band, its ends.  Raises SceneError."""
    if isinstance(value, Band):
        if not (math.isfinite(value.first) and math.isfinite(value.last) and value.first < value.last):
            raise SceneError(f"{key}: from {value.first} to {value.last}; allowed: finite, from less than to")
        return [value.first, value.last]
    if not isinstance(value, Span):
        return [float(v) for v in value]
    if not 2 <= value.count <= MOST:
        raise SceneError(f"{key}: count is {value.count}; allowed: 2 to {MOST}")
    if not (math.isfinite(value.first) and math.isfinite(value.last) and value.first < value.last):
        raise SceneError(f"{key}: from {value.first} to {value.last}; allowed: finite, from less than to")
    return np.linspace(value.first, value.last, value.count).tolist()
