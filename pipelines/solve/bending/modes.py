"""Shapes that the bodies of a scene bend in: what `bem` solves for, and their mass, stiffness and damping."""

from __future__ import annotations

import numpy as np

from hakobune.bem.flexible.beams import Beam, second
from hakobune.bem.flexible.coupling import gradients, inertia, of_water, of_weight
from hakobune.bem.flexible.tables import Table
from hakobune.bem.modes import Mode, moving
from hakobune.bem.panels.elements import elements
from hakobune.meshing.panels import with_symmetry

from ...scene.modes import names_of, owner, points_of
from ...scene.scene import SceneError

ALONG = np.polynomial.legendre.leggauss(200)  # places of mass along a beam
RIGID = 1e-6  # difference of a shape without strain from rigid motions, over its largest displacement


def modes_of(scene, hulls):
    """(`bem.modes.Mode`, …) of a scene; hulls : PanelMesh of each body, in coordinates of its own"""
    out = []
    for number, table in enumerate(scene.modes or ()):
        i = owner(scene, table)
        where = (
            (tuple(map(float, scene.bodies[i].place[:2])), np.radians(scene.bodies[i].place[2]))
            if scene.several
            else ()
        )
        for name, shape in zip(names_of(table), _shapes(f"modes[{number}]", scene, table, hulls[i]), strict=True):
            out.append(Mode(name, shape.turns, shape, i, *where))
    return tuple(out)


def with_planes_of_modes(scene, mesh, hulls):
    """The mesh with the mirror planes alone that the shapes of its bodies have too; hulls : as of `modes_of`"""
    modes = modes_of(scene, hulls)
    signs = [mode.parity(_of_body(mesh, mode.body).centroids) for mode in modes]
    kept = "".join(axis for axis, own in zip("xy", np.array(signs).reshape(-1, 2).T, strict=True)
                   if axis in mesh.symmetry and np.all(own != 0))  # fmt: skip
    return with_symmetry(mesh, kept) if modes else mesh


def with_modes(known, scene, hulls):
    """`known` properties of bodies with matrices of their shapes too, of water, weight, structure and damping

    raises : SceneError for a shape that strains nothing, and one without mass
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
    for i, hull in enumerate(hulls):
        of = [j for j, mode in enumerate(modes) if mode.body == i]
        if of:
            place = [*range(6 * i, 6 * i + 6), *(rigid + j for j in of)]
            restoring, weight = _matrices(scene, i, hull, [modes[j] for j in of])
            for whole, part in ((water, restoring), (mass, weight)):
                part[:6, :6] = whole[np.ix_(place[:6], place[:6])]
                whole[np.ix_(place, place)] = part
    for j, (mode, table) in enumerate(zip(modes, _tables(scene), strict=True), rigid):
        modal = mode.shape.mass if isinstance(mode.shape, Beam) else mass[j, j]
        held[j, j] = mode.shape.stiffness if isinstance(mode.shape, Beam) else table.stiffness
        damping[j, j] = 2 * table.damping * np.sqrt(held[j, j] * modal)
    found = {"hydrostatic_stiffness": water, "structural_stiffness": held, "structural_damping": damping}
    if "inertia_matrix" in known:
        found["inertia_matrix"] = mass
    return known | {name: matrix[:, own] for name, matrix in found.items()}


def mode_remarks(scene, hulls):
    """Lines on how well shapes from files are known on the hull"""
    for mode, table in zip(modes_of(scene, hulls), _tables(scene), strict=True):
        if isinstance(mode.shape, Table):
            shape, hull = mode.shape, hulls[mode.body].whole()
            error = 100 * shape.error(hull.centroids)
            yield f"{mode.name}: is known on the hull within {error:.2g} % of its largest displacement, by two splines"
            if shape.dimensions < 3:
                where = "in a plane" if shape.dimensions == 2 else "on a line"
                yield f"{mode.name}: its points lie {where}, and it is taken as constant across them"
            if shape.masses is None and scene.motions_known:
                yield f"{mode.name}: {table.file} has no masses: the shape has no mass coupling with the rigid motions"


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


def _matrices(scene, number, hull, modes):
    """(6 + m, 6 + m) restoring of water and weight, and mass, of one body in its own coordinates"""
    body, water = scene.bodies[number], scene.water
    center = np.asarray((body.rotation_center if scene.several else scene.rotation_center) or (0.0, 0.0, 0.0))
    motions = [_rigid(d, center) for d in range(6)] + [mode.shape.displacement for mode in modes]
    e = elements(hull.whole())
    size = float(np.ptp(e.nodes, axis=0).max())

    def at(points):
        shapes = [mode.shape for mode in modes]
        pairs = second(shapes, points) if isinstance(shapes[0], Beam) else None
        return np.array([m(points) for m in motions]), np.array([gradients(m, points, size) for m in motions]), pairs

    (u, slopes, pairs), areas = at(e.nodes), e.weights[:, None] * e.normals
    restoring = of_water(u, slopes, e.nodes[:, 2], areas, water.density, water.gravity, 6, pairs)
    _check_strained(scene, modes, u)
    points, masses = _masses(scene, number, hull, modes)
    if masses is None:
        own = [table.mass for table in scene.modes if owner(scene, table) == number]
        if scene.motions_known and None in own:
            name = modes[own.index(None)].name
            raise SceneError(
                f"{name} has no mass; give a seventh column of masses in its file, or mass under [[modes]]"
            )
        return restoring, np.diag([0.0] * 6 + [mass or 0.0 for mass in own])
    u, slopes, pairs = at(points)
    mass = inertia(u, masses)
    for i, mode in enumerate(modes, 6):
        if mode.turns:  # moments of sections about their own centres of gravity
            mass[i, i] += mode.shape.mass
    return restoring + of_weight(u, slopes, masses, water.gravity, 6, pairs), mass


def _masses(scene, number, hull, modes):
    """(p, 3) m and (p,) kg, of the body: along a beam, or those of the file"""
    body, first = scene.bodies[number], modes[0].shape
    if isinstance(first, Table):
        return first.points, first.masses
    x, weights = 0.5 * first.length * ALONG[0], 0.5 * first.length * ALONG[1]
    _, y, z = body.center_of_gravity
    per_length = next((mode.shape.per_length for mode in modes if not mode.turns), None)
    per_length = per_length or (body.mass or scene.water.density * hull.volume) / first.length
    line = np.stack([0.5 * (first.start + first.end) + x, np.full_like(x, y), np.full_like(x, z)], axis=1)
    return line, per_length * weights


def _check_strained(scene, modes, u):
    """Raise SceneError where a shape is a rigid motion, and motions are wanted"""
    rigid = u[:6].reshape(6, -1).T
    for mode, shape in zip(modes, u[6:].reshape(len(modes), -1), strict=True):
        left = shape - rigid @ np.linalg.lstsq(rigid, shape, rcond=None)[0]
        if scene.motions_known and np.abs(left).max() <= RIGID * np.abs(shape).max():
            raise SceneError(
                f"{mode.name} has no strain: it is a rigid motion, which the body already has; leave it out"
            )


def _rigid(d, center):
    unit = np.eye(3)[d % 3]
    if d < 3:
        return lambda points: np.broadcast_to(unit, points.shape)
    return lambda points: np.cross(unit, points - center)
