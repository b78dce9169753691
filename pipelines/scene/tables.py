"""Tables of a scene with their keys, units and defaults, joined by `scene.Scene`; and the numbers of lists and
ranges.
"""

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
MOST = 10_000  # largest number of frequencies or headings in one list


class SceneError(ValueError):
    """A scene cannot be used; the message names the key, its value and the allowed values."""


class SceneTable(msgspec.Struct, forbid_unknown_fields=True, frozen=True, kw_only=True):
    """A table that refuses unknown keys; every key is given by name"""


class Span(SceneTable):
    """A range of evenly spaced numbers, both ends included"""

    first: float = msgspec.field(name="from")
    last: float = msgspec.field(name="to")
    count: int


class Band(SceneTable):
    """A band of frequencies; the number of frequencies follows from the tolerance

    from : rad/s, lowest frequency
    to : rad/s, highest frequency
    """

    first: float = msgspec.field(name="from")
    last: float = msgspec.field(name="to")


class Water(SceneTable):
    """Water at the place

    depth : m, water depth, inf for deep water
    """

    depth: float
    density: float = 1025.0
    gravity: float = 9.80665


class BodyTable(SceneTable):
    """A floating or fixed body

    shape : shape of the body: box, buoy (vertical cylinder), ship or mesh
    length : m, length of a box or ship
    beam : m, beam of a box or ship
    draft : m, draft of a box, buoy or ship; the water depth for a fixed box or buoy on the bed
    radius : m, radius of a buoy
    block : block coefficient of a ship
    bow : fullness of the waterplane of a ship at the bow
    stern : fullness of the waterplane of a ship at the stern
    waterplane : waterplane coefficient of a ship, in place of bow and stern
    file : mesh file beside the scene: .gdf .msh .vtu .pnl …
    mass : kg, mass of the body; by default the mass of the displaced water
    center_of_gravity : m, x, y, z of the centre of gravity, z up from still water
    GM : m, transverse metacentric height, in place of z of the centre of gravity
    gyration : m, radii of gyration [kxx, kyy, kzz] about the centre of gravity; without them no motions are computed
    trimmed : whether the body is held at the trim of its mesh, although its weight would turn it
    name : name of the body, a prefix of the names of its motions, where there are several
    place : m, m, degrees, x and y of the origin of the body, and its heading, where there are several bodies
    rotation_center : m, x, y, z from the origin of the body of the point about which it rotates and moments are
        taken, where there are several bodies
    fixed : whether the body is fixed and scatters waves, like a caisson, pier or pile; a fixed body may stand on the
        bed
    viscous : viscous damping of the body, where there are several bodies; its wave height is in [viscous] of the scene
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
    """Shapes in which a body bends or twists: the lowest modes of a free beam along x, or a shape from a file

    kind : kind of shape: "vertical bending", "horizontal bending", "torsion" or "file"
    body : name of the body, where there are several; by default a shape in a file belongs to all moving bodies
    count : number of modes of a beam, the lowest first
    EI : N m², bending stiffness
    GJ : N m², torsional stiffness
    length : m, length of the beam about the middle of the hull; by default the length of the hull
    mass_per_length : kg/m, mass of the beam for each metre; by default mass over length
    inertia_per_length : kg m, torsional moment of inertia for each metre; by default mass times kxx² over length
    axis_height : m, z of the neutral axis, or for torsion of the shear centre
    damping : damping ratio of each shape in air
    file : file with rows x, y, z (m, in coordinates of the body or of the scene), the displacements ux, uy, uz for
        one unit of the shape, and mass (kg) if known
    name : name of the shape in a file
    stiffness : N/m, stiffness of the shape in a file
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
    """A damping lid on the water between hulls or in a moonpool, for the energy lost in eddies

    damping : damping ε in g φ_z = ω² (1 + i ε) φ; 0.02 to 0.07 in model tests with gaps and moonpools
    corners : m, corners [[x, y], …] of a convex polygon on the water; by default all moonpools of the bodies
    """

    damping: float
    corners: list[tuple[float, float]] | None = None


class Waves(SceneTable):
    """Frequencies, given in one of four ways, and headings

    omegas : rad/s, wave frequencies, a list, a range, or "auto:from:to", which is a band
    periods : s, wave periods, a list or a range
    xi_B : dimensionless frequencies ω²B/2g, a list or a range
    band : band of frequencies; the number of frequencies follows from the tolerance
    headings_deg : directions that the waves travel to, degrees, 0 → +x, 90 → +y, a list or a range
    """

    omegas: list[float] | Span | str | None = None
    periods: list[float] | Span | None = None
    xi_B: list[float] | Span | None = None
    band: Band | None = None
    headings_deg: list[float] | Span = msgspec.field(default_factory=lambda: [0.0])


def listed(key, value):
    """The numbers of a list or of a Span; for a Band its two ends.  Raises SceneError."""
    if isinstance(value, Band):
        if not (math.isfinite(value.first) and math.isfinite(value.last) and value.first < value.last):
            raise SceneError(
                f"{key} goes from {value.first} to {value.last}; allowed: finite numbers, the first below the last"
            )
        return [value.first, value.last]
    if not isinstance(value, Span):
        return [float(v) for v in value]
    if not 2 <= value.count <= MOST:
        raise SceneError(f"{key}: count is {value.count}; allowed: 2 to {MOST}")
    if not (math.isfinite(value.first) and math.isfinite(value.last) and value.first < value.last):
        raise SceneError(
            f"{key} goes from {value.first} to {value.last}; allowed: finite numbers, the first below the last"
        )
    return np.linspace(value.first, value.last, value.count).tolist()
