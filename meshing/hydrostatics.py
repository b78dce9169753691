"""Volume, buoyancy, waterplane, metacentres, restoring and inertia of a body at rest in still water.

By Gauss's theorem over the wetted surface S, normals into the water,

    V = ∬ x n_x = ∬ y n_y = ∬ z n_z,    V x_B = ½ ∬ x² n_x, …,    ∬_waterplane f(x, y) = −∬ f n_z,

Each integral is exact for polygons. Panels are cut into triangles, so a closed hull remains closed; a quadratic
function is integrated exactly from its values at the midpoints of a triangle's edges.  The sea bed closes walls that
end on it (`PanelMesh.foot`).
Restoring coefficients are those of J. N. Newman, Marine Hydrodynamics (1977), section 6.16; weight and buoyancy may
differ.
"""

from dataclasses import dataclass

import numpy as np

from .panels import AT_FOOT

OPEN_HULL = 0.01  # relative difference of the three volumes above which a hull is not closed


@dataclass(frozen=True, eq=False)
class Hydrostatics:
    """Hydrostatics of a floating hull; positions in the coordinates of the mesh.

    volume : m³, the median of `volumes`
    volumes : volumes by the integrals of x n_x, y n_y and z n_z, m³, (3,)
    volume_difference : largest relative difference between the three volumes
    center_of_buoyancy, center_of_mass : (3,) m
    wetted_area, waterplane_area : m²
    waterplane_center : (2,) m, NaN for a submerged body
    waterplane_moments : (3,) m⁴, ∬ y², ∬ x², ∬ xy about the waterplane centre
    transverse_metacentric_radius, longitudinal_metacentric_radius : m, BM
    transverse_metacentric_height, longitudinal_metacentric_height : m, GM
    mass : kg
    rotation_center : (3,) m
    stiffness : stiffness of water and weight about `rotation_center`, N/m, N, N m/rad, (6, 6)
    """

    volume: float
    volumes: np.ndarray
    volume_difference: float
    center_of_buoyancy: np.ndarray
    center_of_mass: np.ndarray
    wetted_area: float
    waterplane_area: float
    waterplane_center: np.ndarray
    waterplane_moments: np.ndarray
    transverse_metacentric_radius: float
    longitudinal_metacentric_radius: float
    transverse_metacentric_height: float
    longitudinal_metacentric_height: float
    mass: float
    rotation_center: np.ndarray
    stiffness: np.ndarray


def stands(mesh, depth):
    """Whether the walls of a hull end on the bed, `depth` m below the surface, so that no water is under the hull"""
    return np.isfinite(depth) and bool(abs(mesh.draft - depth) <= AT_FOOT * depth) and mesh.foot is not None


def waterplane_area(mesh):
    """Waterplane area of the whole hull or hulls, m²; 0 or less if the hull is submerged or its normals point inward"""
    area = -mesh.copies * mesh.area_vectors[:, 2].sum()
    return area if mesh.foot is None else area - mesh.copies * mesh.foot.area_vectors[:, 2].sum()


def hydrostatics(
    mesh,
    center_of_mass=(0, 0, 0),
    density=1025.0,
    gravity=9.80665,
    mass=None,
    rotation_center=(0, 0, 0),
    depth=np.inf,
):
    """Hydrostatics of a hull.

    mesh : PanelMesh, up to z = 0
    center_of_mass, rotation_center : (3,) m
    density : kg/m³; gravity : m/s²; mass : kg; None: the displaced mass
    depth : depth of water, m; the bed closes a hull whose walls end on it, as if the hull floated there
    returns : Hydrostatics
    Raises ValueError for a hull with inward normals or a hole, which has no volume.
    """
    density, gravity = _positive("density", density), _positive("gravity", gravity)
    com, origin = _vector("center_of_mass", center_of_mass), _vector("rotation_center", rotation_center)
    surface = _Surface(mesh.closed() if stands(mesh, depth) else mesh)
    volume, volumes, difference = _volumes(surface, mesh)
    mass = density * volume if mass is None else _positive("mass", mass)
    cob = surface.integral(lambda p: 0.5 * p**2) / volume
    area, first, second = _waterplane(surface, np.zeros(2))
    center = first / area if area > 0 else np.full(2, np.nan)
    moments = _waterplane(surface, center)[2] if area > 0 else np.zeros(3)
    radii = moments[:2] / volume
    heights = cob[2] + radii - com[2]
    return Hydrostatics(
        volume=volume,
        volumes=volumes,
        volume_difference=difference,
        center_of_buoyancy=cob,
        center_of_mass=com,
        wetted_area=mesh.copies * float(mesh.areas.sum()),
        waterplane_area=area,
        waterplane_center=center,
        waterplane_moments=moments,
        transverse_metacentric_radius=float(radii[0]),
        longitudinal_metacentric_radius=float(radii[1]),
        transverse_metacentric_height=float(heights[0]),
        longitudinal_metacentric_height=float(heights[1]),
        mass=mass,
        rotation_center=origin,
        stiffness=_stiffness(
            density * gravity * np.array([area, *first, *second]),
            origin,
            density * gravity * volume * np.array([1.0, *(cob - origin)]),
            mass * gravity * np.array([1.0, *(com - origin)]),
        ),
    )


def inertia_matrix(mass, center_of_mass, gyration, rotation_center=(0, 0, 0)):
    """Inertia matrix of a rigid body about `rotation_center`, in kg, kg m and kg m²; shape (6, 6).

    mass : kg
    gyration : (kxx, kyy, kzz) m, radii of gyration about axes through the centre of mass, assumed to be principal axes
    center_of_mass, rotation_center : (3,) m

        [[m, −m S], [m S, I_G − m S²]],    S a = r × a,    r from the rotation centre to the centre of mass
    """
    mass, radii = _positive("mass", mass), _vector("gyration", gyration)
    if np.any(radii < 0):
        raise ValueError(f"gyration is {gyration} m; allowed: three radii of 0 or more")
    x, y, z = _vector("center_of_mass", center_of_mass) - _vector("rotation_center", rotation_center)
    S = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return mass * np.block([[np.eye(3), -S], [S, np.diag(radii**2) - S @ S]])


class _Surface:
    """Triangles of the whole hull, image by image, with the values that the integrals need."""

    def __init__(self, mesh):
        v = mesh.vertices
        triangles = np.concatenate([v[:, [0, 1, 2]], v[:, [0, 2, 3]]])
        a, b, c = triangles.transpose(1, 0, 2)
        images = [np.array([sx, sy, 1.0]) for sx, sy in mesh.reflections()]
        self.vectors = 0.5 * np.cross(b - a, c - a)
        midpoints = 0.5 * (triangles + np.roll(triangles, -1, axis=1))
        self.parts = [(midpoints * image, self.vectors * image) for image in images]

    def integral(self, f):
        """∬ f n dS, component by component.  f : (…, 3) m to (…, 3) or (…, 1), quadratic at most

        The mirror images are summed one after another, so terms that cancel by symmetry are exactly zero.
        """
        total = 0.0
        for midpoints, vectors in self.parts:
            total = total + (f(midpoints).mean(axis=1) * vectors).sum(axis=0)
        return total


def _volumes(surface, mesh):
    """Volume, its three values by x, y and z, m³, and their relative difference.  Raises ValueError."""
    volumes = surface.integral(lambda p: p)
    volume = float(np.median(volumes))
    if not volume > 0:
        raise ValueError(
            f"hydrostatics: the volume is {volume:.6g} m³; normals point inward (`hakobune mesh --flip`) "
            "or the hull is not closed"
        )
    difference = float(np.ptp(volumes)) / volume
    if difference > OPEN_HULL:
        by = ", ".join(f"{v:.6g}" for v in volumes)
        raise ValueError(
            f"hydrostatics: the volumes by x, y, z are {by} m³, {100 * difference:.3g} % apart; "
            f"allowed: {100 * OPEN_HULL:g} %; {mesh.name or 'the hull'} is not closed, see the mesh findings"
        )
    return volume, volumes, difference


def _waterplane(surface, about):
    """Area, (∬ x, ∬ y) and (∬ y², ∬ x², ∬ xy) of the waterplane about a point"""
    found = np.zeros(6)
    for midpoints, vectors in surface.parts:
        x, y = midpoints[..., 0] - about[0], midpoints[..., 1] - about[1]
        values = np.stack([np.ones_like(x), x, y, y * y, x * x, x * y], axis=-1)
        found += (values.mean(axis=1) * vectors[:, 2:]).sum(axis=0)
    found = -found
    if found[0] <= 1e-12 * np.linalg.norm(surface.vectors, axis=1).sum():  # rounding: the body is submerged
        return 0.0, np.zeros(2), np.zeros(3)
    return float(found[0]), found[1:3], found[3:]


def _stiffness(plane, origin, buoyancy, weight):
    """Restoring about `origin`; shape (6, 6)

    plane : ρg (A, ∬ x, ∬ y, ∬ y², ∬ x², ∬ xy) about x = y = 0
    buoyancy, weight : force N, then force times position relative to `origin`, N m
    """
    a, x0, y0 = plane[0], origin[0], origin[1]
    x, y = plane[1] - a * x0, plane[2] - a * y0
    yy = plane[3] - 2 * y0 * plane[2] + a * y0**2
    xx = plane[4] - 2 * x0 * plane[1] + a * x0**2
    xy = plane[5] - x0 * plane[2] - y0 * plane[1] + a * x0 * y0
    moment = buoyancy - weight
    K = np.zeros((6, 6))
    K[2, 2] = a
    K[2, 3] = K[3, 2] = y
    K[2, 4] = K[4, 2] = -x
    K[3, 3] = yy + moment[3]
    K[4, 4] = xx + moment[3]
    K[3, 4] = K[4, 3] = -xy
    K[3, 5] = -moment[1]  # forces keep their direction, yaw moves their points: not symmetric
    K[4, 5] = -moment[2]
    return K


def _positive(name, value):
    value = float(value)
    if not (np.isfinite(value) and value > 0):
        raise ValueError(f"{name} is {value}; allowed: a positive number")
    return value


def _vector(name, values):
    vector = np.array(values, float)
    if vector.shape != (3,) or not np.all(np.isfinite(vector)):
        raise ValueError(f"{name} is {values}; allowed: three finite numbers")
    return vector
