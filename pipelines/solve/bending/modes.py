"""Bending shapes of the bodies of a scene: the modes for `bem`, and their mass, stiffness and damping."""

from functools import partial

import numpy as np

from hakobune.bem.flexible.beams import Beam, second
from hakobune.bem.flexible.coupling import gradients, inertia, of_water, of_weight
from hakobune.bem.flexible.tables import Table
from hakobune.bem.modes import Mode, moving
from hakobune.bem.panels.elements import elements
from hakobune.meshing.panels import with_symmetry

from ...scene.modes import between, names_of, owner, owners, points_of
from ...scene.places import bodies_of
from ...scene.scene import SceneError

ALONG = np.polynomial.legendre.leggauss(200)  # places of mass along a beam
RIGID = 1e-6  # difference of a shape without strain from rigid motions, over its largest displacement


def modes_of(scene, hulls):
    """Return a `bem.modes.Mode` for each mode of a scene; hulls : PanelMesh of each body, in its own coordinates"""
    out = []
    for number, table in enumerate(scene.modes or ()):
        i, where = owner(scene, table), ()
        if between(scene, table):
            where = (0.0, 0.0), 0.0, tuple(owners(scene, table))
        elif scene.several:
            where = tuple(map(float, scene.bodies[i].place[:2])), np.radians(scene.bodies[i].place[2])
        for name, shape in zip(names_of(table), _shapes(f"modes[{number}]", scene, table, hulls[i]), strict=True):
            out.append(Mode(name, shape.turns, shape, i, *where))
    return tuple(out)


def with_planes_of_modes(scene, mesh, hulls):
    """The mesh with only the mirror planes that its bodies' shapes share; hulls : as in `modes_of`"""
    modes = modes_of(scene, hulls)
    signs = [mode.parity(np.concatenate([_of_body(mesh, i).centroids for i in mode.moves])) for mode in modes]
    kept = "".join(axis for axis, own in zip("xy", np.array(signs).reshape(-1, 2).T, strict=True)
                   if axis in mesh.symmetry and np.all(own != 0))  # fmt: skip
    return with_symmetry(mesh, kept) if modes else mesh


def with_modes(known, scene, hulls):
    """`known` properties of bodies with the matrices of their shapes added: water, weight, structure and damping

    raises : SceneError for a shape without strain, and one without mass
    """
    modes, bodies = modes_of(scene, hulls), scene.bodies if scene.several else ()
    if not modes:
        return known
    rigid, own = 6 * len(scene.bodies), moving(bodies, modes)
    size = rigid + len(modes)
    water, mass, held, damping = np.zeros((4, size, size))
    for name, whole in (("hydrostatic_stiffness", water), ("inertia_matrix", mass)):
        if name in known:
            whole[np.ix_(range(rigid), moving(bodies))] = known[name]
    for i in range(len(hulls)):
        of = [j for j, mode in enumerate(modes) if i in mode.moves]
        if of:
            place = [*range(6 * i, 6 * i + 6), *(rigid + j for j in of)]
            for whole, part in zip((water, mass), _matrices(scene, i, hulls, [modes[j] for j in of]), strict=True):
                part[:6, :6] = 0  # rigid motions, whose coefficients are known
                whole[np.ix_(place, place)] += part
    _check_strained(scene, modes, hulls)
    _with_own_mass(scene, modes, mass, rigid)
    for j, (mode, table) in enumerate(zip(modes, _tables(scene), strict=True), rigid):
        modal = mode.shape.mass if isinstance(mode.shape, Beam) else mass[j, j]
        held[j, j] = mode.shape.stiffness if isinstance(mode.shape, Beam) else table.stiffness
        damping[j, j] = 2 * table.damping * np.sqrt(held[j, j] * modal)
    found = {"hydrostatic_stiffness": water, "structural_stiffness": held, "structural_damping": damping}
    if "inertia_matrix" in known:
        found["inertia_matrix"] = mass
    return known | {name: matrix[:, own] for name, matrix in found.items()}


def mode_remarks(scene, hulls):
    """Messages on the accuracy of shapes from files on the hull"""
    for mode, table in zip(modes_of(scene, hulls), _tables(scene), strict=True):
        if isinstance(mode.shape, Table):
            shape = mode.shape
            points = [_in_shape(scene, mode, i, hulls[i].whole().centroids) for i in mode.moves]
            error = 100 * shape.error(np.concatenate(points))
            yield (
                f"{mode.name}: its shape on the hull is uncertain by {error:.2g} % of its largest "
                "displacement, the difference of two splines"
            )
            if shape.dimensions < 3:
                where = "in a plane" if shape.dimensions == 2 else "on a line"
                yield f"{mode.name}: its points lie {where}; across these directions the shape is constant"
            if shape.masses is None and scene.motions_known:
                yield (
                    f"{mode.name}: {table.file} has no masses, so the shape is not coupled to the rigid motions by mass"
                )


def _tables(scene):
    """The `scene.tables.ModeTable` of every shape"""
    return [table for table in scene.modes or () for _ in names_of(table)]


def _of_body(mesh, number):
    return mesh if mesh.body is None else mesh.of_body(number)


def _shapes(key, scene, table, hull):
    if table.kind == "file":
        rows = points_of(key, table.file)
        return [Table(rows[:, :3], rows[:, 3:6], rows[:, 6] if rows.shape[1] == 7 else None)]
    body, x = scene.bodies[owner(scene, table)], hull.whole().points[:, 0]
    length, middle = table.length or float(np.ptp(x)), 0.5 * float(x.min() + x.max())
    mass = body.mass or scene.water.density * hull.volume
    per_length, rigidity = table.mass_per_length or mass / length, table.EI
    if table.kind == "torsion":
        per_length, rigidity = table.inertia_per_length, table.GJ
        if per_length is None:
            if body.gyration is None:
                raise SceneError(f"{key}.inertia_per_length is missing, and no gyration is given; give one of them")
            per_length = mass * body.gyration[0] ** 2 / length
    ends = middle - length / 2, middle + length / 2
    return [Beam(table.kind, n, *ends, table.axis_height, rigidity, per_length) for n in range(1, table.count + 1)]


def _matrices(scene, number, hulls, modes):
    """Restoring of water and weight, and mass, of one body in its own coordinates; shape (6 + m, 6 + m)"""
    hull, water = hulls[number], scene.water
    motions = [_rigid(d, _center(scene, number)) for d in range(6)]
    motions += [partial(mode.in_body, _body(scene, number)) for mode in modes]
    e = elements(hull.whole())
    size = float(np.ptp(e.nodes, axis=0).max())

    def at(points):
        shapes = [mode.shape for mode in modes]
        pairs = second(shapes, points) if isinstance(shapes[0], Beam) else None
        return np.array([m(points) for m in motions]), np.array([gradients(m, points, size) for m in motions]), pairs

    (u, slopes, pairs), areas = at(e.nodes), e.weights[:, None] * e.normals
    restoring = of_water(u, slopes, e.nodes[:, 2], areas, water.density, water.gravity, 6, pairs)
    points, masses = _masses(scene, number, hulls, modes)
    if masses is None:
        return restoring, np.zeros_like(restoring)
    u, slopes, pairs = at(points)
    mass = inertia(u, masses)
    for i, mode in enumerate(modes, 6):
        if mode.turns:  # moments of sections about their own centres of gravity
            mass[i, i] += mode.shape.mass
    return restoring + of_weight(u, slopes, masses, water.gravity, 6, pairs), mass


def _with_own_mass(scene, modes, mass, rigid):
    """Put the mass of shapes without masses on the diagonal of `mass`.  Raises SceneError without one."""
    for j, (mode, table) in enumerate(zip(modes, _tables(scene), strict=True), rigid):
        first = next(one for one in modes if set(one.moves) & set(mode.moves))  # mode with the masses of the body
        if isinstance(mode.shape, Table) and first.shape.masses is None:
            if scene.motions_known and table.mass is None:
                raise SceneError(
                    f"{mode.name} has no mass; give a seventh column of masses in its file, or mass under [[modes]]"
                )
            mass[j, j] += table.mass or 0.0


def _masses(scene, number, hulls, modes):
    """Points (p, 3), m, and masses (p,), kg, of the body: along a beam, or those of the file, for several bodies those
    closest to it"""
    body, first, hull = scene.bodies[number], modes[0].shape, hulls[number]
    if isinstance(first, Table) and (first.masses is None or not modes[0].on):
        return first.points, first.masses
    if isinstance(first, Table):
        from scipy.spatial import KDTree

        reach = [
            KDTree(_in_shape(scene, modes[0], i, hulls[i].whole().centroids)).query(first.points)[0]
            for i in modes[0].moves
        ]
        own = np.argmin(reach, axis=0) == modes[0].moves.index(number)
        there = _body(scene, number)
        return (first.points[own] - (*there.place, 0.0)) @ there.axes, first.masses[own]
    x, weights = 0.5 * first.length * ALONG[0], 0.5 * first.length * ALONG[1]
    _, y, z = body.center_of_gravity
    per_length = next((mode.shape.per_length for mode in modes if not mode.turns), None)
    per_length = per_length or (body.mass or scene.water.density * hull.volume) / first.length
    line = np.stack([0.5 * (first.start + first.end) + x, np.full_like(x, y), np.full_like(x, z)], axis=1)
    return line, per_length * weights


def _check_strained(scene, modes, hulls):
    """Raise SceneError if a shape is a rigid motion of each of its bodies, and motions are wanted"""
    for mode in modes if scene.motions_known else ():
        left, size = 0.0, 0.0
        for i in mode.moves:
            points = elements(hulls[i].whole()).nodes
            rigid = np.array([_rigid(d, _center(scene, i))(points) for d in range(6)]).reshape(6, -1).T
            shape = mode.in_body(_body(scene, i), points).ravel()
            rest = shape - rigid @ np.linalg.lstsq(rigid, shape, rcond=None)[0]
            left, size = max(left, np.abs(rest).max()), max(size, np.abs(shape).max())
        if left <= RIGID * size:
            has, way = "the body has", ""
            if mode.on:
                has, way = "each body has", ", or join bodies by [[hinges]] of a study"
            raise SceneError(
                f"{mode.name} does not deform the body: it is a rigid motion, which {has} already; leave it out{way}"
            )


def _body(scene, number):
    return bodies_of(scene)[number] if scene.several else None


def _in_shape(scene, mode, number, points):
    """Points (n, 3) m of a body in the coordinates of a shape: of the body, or of the scene"""
    return _body(scene, number).in_scene(points) if mode.on else points


def _center(scene, number):
    body = scene.bodies[number]
    return np.asarray((body.rotation_center if scene.several else scene.rotation_center) or (0.0, 0.0, 0.0))


def _rigid(d, center):
    unit = np.eye(3)[d % 3]
    if d < 3:
        return lambda points: np.broadcast_to(unit, points.shape)
    return lambda points: np.cross(unit, points - center)
