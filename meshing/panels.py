"""Panel mesh: a value with points, corners and mirror planes, from which all other properties are derived.

A panel is a flat quadrilateral given by four point numbers, counter-clockwise seen from the water, so that the normal ½
(p₂−p₀)×(p₃−p₁) points out of the body.  A triangle repeats its last corner.  A quadrilateral that is not flat is
represented by its mean plane. This preserves the vector area, and therefore the sums over a closed surface.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

SYMMETRIES = ("", "x", "y", "xy")
SAME_PLACE = 1e-5  # points closer than this share of the largest radius are one point: files round coordinates
AT_FOOT = 1e-6  # distance below which a point lies at the foot of a hull or on the bed, as a share of the draft
NO_AREA = 1e-9  # area over the square of the longest edge, below which a panel has no area
SAME_SIDE = 1e-9  # points closer to a plane than this share of the hull's size lie in the plane
IN_SURFACE = 2e-7  # of the largest coordinate, two digits of float32: a cut moves points so near into the surface
DRAWN = 2e-3  # the same at most for a file of few decimals: three of a radius of a metre
DECIMALS = 6  # most decimals of a file whose last one is looked for
ROUND = 12  # least number of turns about the vertical that map a mesh to itself for a body of revolution


@dataclass(frozen=True, eq=False)
class PanelMesh:
    """Panels of a wetted hull; if the hull has mirror planes, only a half or a quarter of it is stored.

    points : (m, 3) m
    corners : indices of points, (n, 4)
    symmetry : mirror planes: "" none, "x" the plane x = 0, "y" the plane y = 0, "xy" both planes
    body : number of the body of each panel, (n,); each mirror plane of several bodies is a mirror plane of every
        body. None for one body
    """

    points: np.ndarray
    corners: np.ndarray
    symmetry: str = ""
    name: str = ""
    body: np.ndarray | None = None

    def __post_init__(self):
        object.__setattr__(self, "points", np.array(self.points, float).reshape(-1, 3))
        object.__setattr__(self, "corners", np.array(self.corners, np.int64).reshape(-1, 4))
        if self.symmetry not in SYMMETRIES:
            raise ValueError(f"symmetry is {self.symmetry!r}; allowed: {', '.join(map(repr, SYMMETRIES))}")
        if self.corners.size and (self.corners.min() < 0 or self.corners.max() >= len(self.points)):
            raise ValueError(
                f"a panel names point {self.corners.max()}, but the mesh has points 0 to {len(self.points) - 1}"
            )
        if self.body is not None:
            object.__setattr__(self, "body", np.array(self.body, np.int64))
            if self.body.shape != (len(self.corners),):
                raise ValueError(
                    f"body has shape {self.body.shape}; allowed: ({len(self.corners)},), one for each panel"
                )

    def __len__(self):
        return len(self.corners)

    def __repr__(self):
        return f"<PanelMesh {self.total} panels, {self.copies * self.areas.sum():.6g} m² wetted, {self.volume:.6g} m³>"

    @property
    def bodies(self):
        """Number of bodies"""
        return 1 if self.body is None else int(self.body.max(initial=-1)) + 1

    def of_body(self, number):
        """The panels of one of several bodies, and the points of these panels only"""
        if self.body is None:
            return self
        used, corners = np.unique(self.corners[self.body == number], return_inverse=True)
        return PanelMesh(self.points[used], corners.reshape(-1, 4), self.symmetry, self.name)

    @property
    def copies(self):
        """Number of images that make the whole hull, including the stored part: 1, 2 or 4."""
        return 2 ** len(self.symmetry)

    @property
    def total(self):
        """Number of panels on the whole hull."""
        return self.copies * len(self)

    @cached_property
    def vertices(self):
        """Corners of the panels, m; shape (n, 4, 3)"""
        return self.points[self.corners]

    @cached_property
    def area_vectors(self):
        """Area times outward normal, m²; shape (n, 3)"""
        v = self.vertices
        return 0.5 * np.cross(v[:, 2] - v[:, 0], v[:, 3] - v[:, 1])

    @cached_property
    def areas(self):
        """Areas of the panels, m²; shape (n,)"""
        return np.linalg.norm(self.area_vectors, axis=1)

    @cached_property
    def normals(self):
        """Unit normals, out of the body; shape (n, 3); zero where a panel has no area"""
        return self.area_vectors / np.where(self.areas > 0, self.areas, 1.0)[:, None]

    @cached_property
    def centroids(self):
        """Centres of area of the panels, m; shape (n, 3)"""
        v = self.vertices
        first = np.linalg.norm(np.cross(v[:, 1] - v[:, 0], v[:, 2] - v[:, 0]), axis=1)
        second = np.linalg.norm(np.cross(v[:, 2] - v[:, 0], v[:, 3] - v[:, 0]), axis=1)
        share = (first / np.where(first + second > 0, first + second, 1.0))[:, None]
        return (share * (v[:, 0] + v[:, 1] + v[:, 2]) + (1 - share) * (v[:, 0] + v[:, 2] + v[:, 3])) / 3

    @cached_property
    def flat_vertices(self):
        """Corners of the panels, moved along the normal into the panel's mean plane, m; shape (n, 4, 3)"""
        v = self.vertices
        offset = np.einsum("nij,nj->ni", v - v.mean(axis=1, keepdims=True), self.normals)
        return v - offset[..., None] * self.normals[:, None, :]

    @cached_property
    def edge_lengths(self):
        """Lengths of the four sides of each panel, m; shape (n, 4)"""
        v = self.vertices
        return np.linalg.norm(np.roll(v, -1, axis=1) - v, axis=2)

    @cached_property
    def sizes(self):
        """Longest side of each panel, m; shape (n,)"""
        return self.edge_lengths.max(axis=1)

    @cached_property
    def is_round(self):
        """Whether a rotation by 1/12 of a circle or less about the vertical axis through the origin maps the hull to
        itself, within the decimals of its file"""
        points = self.whole().points if self.symmetry else self.points
        reach = np.hypot(*points[:, :2].T).max(initial=0.0)
        if not reach > 0:
            return False
        rounded = 1.5 * _step(points)  # of two radii, the corners of two squares of the step
        nears = (SAME_PLACE * reach, *([rounded] if SAME_PLACE < rounded / reach <= DRAWN else []))
        return any(_turns_to_itself(points, near) for near in nears)

    @cached_property
    def volume(self):
        """Volume that the whole hull, the plane z = 0 and the `foot` enclose, m³: ∬ x·n dS / 3, where z = 0 adds
        nothing"""
        share = self.copies * float(np.einsum("ni,ni->", self.centroids, self.area_vectors)) / 3
        return share if self.foot is None else share + self.foot.volume

    @cached_property
    def foot(self):
        """PanelMesh that closes walls without a bottom at their foot, normals down; None for a hull with a bottom

        The foot consists of the edges that belong to one panel at the lowest level of the mesh.  The triangles
        between each edge and one common point have the same sum of signed areas as the true bottom, but may overlap:
        use them for integrals and solid angles only.
        """
        level, reach = -self.draft, AT_FOOT * max(self.draft, 0.0)
        if np.any((self.vertices[..., 2] <= level + reach).all(axis=1)):
            return None  # it has a bottom
        welded = self.merged()
        start, end = welded.corners, np.roll(welded.corners, -1, axis=1)
        low = welded.points[:, 2] <= level + reach
        at_foot = low[start] & low[end] & (start != end)
        for axis in self.symmetry:
            on_plane = np.abs(welded.points[:, "xy".index(axis)]) <= reach
            at_foot &= ~(on_plane[start] & on_plane[end])
        a, b = start[at_foot], end[at_foot]
        _, number, uses = np.unique(np.sort([a, b], axis=0), axis=1, return_inverse=True, return_counts=True)
        once = uses[number.reshape(-1)] == 1
        if not once.any():
            return None
        pole = np.full(once.sum(), len(welded.points))
        points = np.concatenate([welded.points, [[0.0, 0.0, level]]])
        return PanelMesh(points, np.stack([b[once], a[once], pole, pole], axis=1), self.symmetry)

    def closed(self):
        """The hull closed by its `foot`"""
        return self if self.foot is None else joined([replace(self, body=None), self.foot])

    @cached_property
    def draft(self):
        """m"""
        return -float(self.points[np.unique(self.corners), 2].min())

    def reflections(self):
        """Signs of x and of y for each mirror image that makes the whole hull; the meshed part itself comes first"""
        x = (1, -1) if "x" in self.symmetry else (1,)
        y = (1, -1) if "y" in self.symmetry else (1,)
        return [(a, b) for b in y for a in x]

    def whole(self):
        """The same hull without mirror planes."""
        images = self.reflections()
        points = np.concatenate([self.points * (sx, sy, 1) for sx, sy in images])
        corners = np.concatenate(
            [self.corners[:, :: sx * sy] + i * len(self.points) for i, (sx, sy) in enumerate(images)]
        )
        body = None if self.body is None else np.tile(self.body, len(images))
        return PanelMesh(points, corners, "", self.name, body).merged()

    def moved(self, dx=0.0, dy=0.0, dz=0.0):
        """A shifted copy. If the shift is across a mirror plane, reflected panels replace this plane."""
        base = self
        if ("x" in self.symmetry and dx) or ("y" in self.symmetry and dy):
            base = self.whole()
        return replace(base, points=base.points + np.array([dx, dy, dz]))

    def rotated(self, angle, axis="z"):
        """A copy rotated about an axis through the origin, x, y or z, by `angle` rad, without mirror planes."""
        c, s = np.cos(angle), np.sin(angle)
        i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        turn = np.eye(3)
        turn[i, i], turn[i, j], turn[j, i], turn[j, j] = c, s, -s, c
        base = self.whole()
        return replace(base, points=base.points @ turn)

    def scaled(self, factor):
        """A copy with its points multiplied by `factor`, a positive number or three numbers, one per axis."""
        return replace(self, points=self.points * np.asarray(factor, float))

    def mirrored(self, axis):
        """A copy completed by its image in the plane x = 0 (axis "x") or y = 0 ("y"); the mesh must lie on one side
        of the plane.

        Raises ValueError for a mesh on both sides of the plane, or if the plane is already a mirror plane of the mesh.
        """
        side = self.vertices[..., "xy".index(axis)]
        reach = SAME_SIDE * np.abs(self.points).max(initial=0.0)
        if axis in self.symmetry or (side.min() < -reach and side.max() > reach):
            raise ValueError(
                f"the hull already lies on both sides of {axis} = 0; only one half of a hull can be mirrored"
            )
        symmetry = "".join(sorted(self.symmetry + axis))
        if side.min() >= -reach:
            return replace(self, symmetry=symmetry)
        turn = np.where(np.arange(3) == "xy".index(axis), -1.0, 1.0)  # the image is the half that is kept
        return replace(self, points=self.points * turn, corners=self.corners[:, ::-1], symmetry=symmetry)

    def clipped(self):
        """The part of the mesh below z = 0: panels cut by the surface end at the surface, as quadrilaterals and
        triangles.

        Raises ValueError if nothing lies below the surface.
        """
        z = self.points[:, 2]
        points = np.where(np.abs(z) <= IN_SURFACE * np.abs(self.points).max(initial=0.0), 0.0, z)
        points = np.column_stack([self.points[:, :2], points])
        wet = points[self.corners, 2].min(axis=1) < 0
        dry = points[self.corners, 2].max(axis=1) > 0
        if not wet.any():
            raise ValueError(
                f"the hull has no part below z = 0; its lowest point is at {z.min():.4g} m; move it down to "
                "its draft (`--move x,y,z`)"
            )
        cut, corners = [], list(self.corners[wet & ~dry])
        for panel in self.corners[wet & dry]:
            ring = _below(points, panel, cut)
            corners += [np.array([ring[0], *ring[i : i + 3]])[[0, 1, 2, -1]] for i in range(1, len(ring) - 1, 2)]
        made = PanelMesh(np.concatenate([points, np.reshape(cut, (-1, 3))]), corners, self.symmetry).merged()
        kept = made.areas > NO_AREA * made.sizes**2  # a cut close to a corner leaves a sliver
        used, corners = np.unique(made.corners[kept], return_inverse=True)
        return replace(self, points=made.points[used], corners=corners.reshape(-1, 4))

    def flipped(self):
        """A copy with the normals reversed."""
        return replace(self, corners=self.corners[:, ::-1])

    def merged(self, tolerance=1e-8):
        """A copy in which points closer than `tolerance` times the hull's size are merged."""
        size = np.ptp(self.points, axis=0).max() if len(self.points) else 1.0
        _, first, back = np.unique(
            np.round(self.points / (tolerance * size or 1.0)).astype(np.int64),
            axis=0,
            return_index=True,
            return_inverse=True,
        )
        return replace(self, points=self.points[first], corners=back.reshape(-1)[self.corners])


def _turns_to_itself(points, near):
    """Whether a turn of points (n, 3), m, by 1/ROUND of a circle or less about the vertical is within `near` m of them

    The numbers of points on the levels of the rim give the turns that are possible.
    """
    radius = np.hypot(*points[:, :2].T)
    rim = points[radius > radius.max() - near]
    rim = rim[np.argsort(rim[:, 2])]
    levels = [
        _apart(np.arctan2(*level[:, 1::-1].T), 2 * near / radius.max())
        for level in np.split(rim, np.flatnonzero(np.diff(rim[:, 2]) > near) + 1)
    ]
    counts = [n for n in range(max(levels), ROUND - 1, -1) if all(level % n == 0 for level in levels)]
    if not counts:
        return False
    from scipy.spatial import cKDTree

    tree = cKDTree(points)
    for count in counts:
        c, s = np.cos(2 * np.pi / count), np.sin(2 * np.pi / count)
        turned = points @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        if tree.query(turned)[0].max() <= 2 * near:
            return True
    return False


def _step(points):
    """Last decimal of points (n, 3) of a file, m: 0.001 for three decimals; 0 beyond DECIMALS"""
    steps = (10.0**-n for n in range(DECIMALS + 1))
    return next((step for step in steps if np.abs(np.round(points, 9) % step - step / 2).min() > 0.499 * step), 0.0)


def _apart(angles, near):
    """Number of different angles, rad, of which those closer than `near` are one"""
    angles = np.sort(angles)
    return int(np.count_nonzero(np.diff(angles, append=angles[0] + 2 * np.pi) > near))


def _below(points, panel, cut):
    """Numbers of the corners of a panel's part below z = 0; `cut` collects the points of its edges in the surface"""
    ring, corners = [], [n for i, n in enumerate(panel) if n != panel[i - 1]]
    for a, b in zip(corners, corners[1:] + corners[:1], strict=True):
        if points[a, 2] <= 0:
            ring.append(a)
        if points[a, 2] * points[b, 2] < 0:
            low, high = sorted((a, b))  # both panels of an edge give the same number
            share = points[low, 2] / (points[low, 2] - points[high, 2])
            ring.append(len(points) + len(cut))
            cut.append([*(points[low] + share * (points[high] - points[low]))[:2], 0.0])
    return ring


def with_symmetry(mesh, symmetry):
    """The same hull with only the mirror planes `symmetry`; images in the other planes become panels"""
    for axis in set(mesh.symmetry) - set(symmetry):
        kept = mesh.symmetry.replace(axis, "")
        mesh = replace(replace(mesh, symmetry=axis).whole(), symmetry=kept)
    return mesh


def assembled(hulls):
    """One mesh of the hulls of several bodies, numbered in the order of the bodies; all bodies must have the same
    mirror planes."""
    hulls = list(hulls)
    number = np.repeat(np.arange(len(hulls)), [len(hull) for hull in hulls])
    starts = np.cumsum([0] + [len(hull.points) for hull in hulls[:-1]])
    corners = np.concatenate([hull.corners + start for hull, start in zip(hulls, starts, strict=True)])
    points = np.concatenate([hull.points for hull in hulls])
    return PanelMesh(points, corners, _shared_symmetry(hulls), " and ".join(hull.name for hull in hulls), number)


def _shared_symmetry(meshes):
    symmetries = {m.symmetry for m in meshes}
    if len(symmetries) != 1:
        raise ValueError(f"meshes to join have different symmetry {sorted(symmetries)}; use whole() first")
    return symmetries.pop()


def joined(meshes):
    """One mesh of several meshes with the same mirror planes."""
    meshes = list(meshes)
    symmetry = _shared_symmetry(meshes)
    starts = np.cumsum([0] + [len(m.points) for m in meshes[:-1]])
    return PanelMesh(
        np.concatenate([m.points for m in meshes]),
        np.concatenate([m.corners + s for m, s in zip(meshes, starts, strict=True)]),
        symmetry,
        meshes[0].name,
        None if meshes[0].body is None else np.concatenate([m.body for m in meshes]),
    ).merged()


def structured(points):
    """Quadrilaterals of a grid of points (p, q, 3); the normal is ∂p × ∂q, collapsed panels become triangles."""
    points = np.asarray(points, float)
    p, q = points.shape[:2]
    number = np.arange(p * q).reshape(p, q)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    return PanelMesh(points.reshape(-1, 3), np.stack([a, b, c, d], axis=-1).reshape(-1, 4)).merged()
