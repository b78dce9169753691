"""Check of a mooring study before any computation: every name in it, and the hull data that its weather needs."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_frequencies import DRIFT, KOCHIN, RADIATION, BetweenError
from hakobune.bem.database.between_headings import Ring, ring
from hakobune.bem.modes import words_of
from hakobune.mooring.response.seas import check_coverage

from ..common.quantities import StudyError
from .quay import method_of

OF_EACH = "body_drift_force"  # mean drift of each of several bodies
SYMMETRY = {"box": "xy", "buoy": "xy", "ship": "y"}  # planes of the shapes of a scene


class Body(NamedTuple):
    """Properties of a body that are known before its waves are solved.

    name : name of its database or scene, for messages; dimensions : {name: m}, empty for a mesh file
    rotation_center : (3,) m; density : kg/m³; gravity : m/s²; water_depth : m
    omega : (n,) rad/s, whose first and last are the band; wall : y of the wall, m, or None
    ring : `Ring` of the solved waves, None for a mesh file of unknown symmetry
    stored : names of the solved quantities; has_inertia : whether its radii of gyration are known
    bodies : `bem.modes.Body` of each of several bodies, () for a single body; boxes : {name: {"length", "beam",
        "draft"} m} of several bodies
    """

    name: str
    dimensions: dict
    rotation_center: np.ndarray
    density: float
    gravity: float
    water_depth: float
    omega: np.ndarray
    wall: float | None
    ring: Ring | None
    stored: frozenset
    has_inertia: bool
    bodies: tuple = ()
    boxes: dict | None = None

    @property
    def sizes(self):
        """Dimensions, m, known before the hull is meshed, in place of `sizes` of a database"""
        return self.dimensions

    @property
    def words(self):
        """Names of the motions, as in a database"""
        return words_of(self.bodies)


def body_of_database(db):
    """Body, or several bodies, of an open database. Raises DatabaseError for a flexible body."""
    from .study import box_of

    db.require_rigid()
    reader = db.bodies_reader
    water = db.density, db.gravity, db.water_depth
    waves = reader.omega, db.wall, reader.ring, frozenset(reader.between.quantities)
    boxes = {one.name: box_of(db, one) for one in db.bodies}
    known = db.inertia_matrix is not None
    return Body(db.path, db.dimensions, db.rotation_center, *water, *waves, known, tuple(db.bodies), boxes)


def body_of_scene(name, scene):
    """Body, or several bodies, of a Scene. Raises StudyError if one of several bodies has unknown dimensions."""
    from ..scene.places import bodies_of

    water, shape = scene.water, scene.body.shape
    planes = None if scene.several else SYMMETRY.get(shape)
    of_water = water.density, water.gravity, water.depth
    if planes is not None:
        planes = planes if scene.wall is None else planes.replace("y", "")
        planes = ring(scene.headings(), (), planes, shape == "buoy" and scene.wall is None, wall=scene.wall)
    center = np.array(scene.rotation_center)
    waves = scene.omegas(), scene.wall, planes, frozenset(scene.names())
    boxes = {one.name: _box(name, one, scene.alone(i).dimensions) for i, one in enumerate(scene.bodies) if one.name}
    known = scene.motions_known
    return Body(name, scene.dimensions, center, *of_water, *waves, known, bodies_of(scene), boxes)


def _box(scene, body, sizes):
    """Dimensions, m, of one of several bodies of a scene with `sizes`, as by `box_of`.  Raises StudyError."""
    if "radius" in sizes:
        return {"length": 2 * sizes["radius"], "beam": 2 * sizes["radius"]} | sizes
    if "length" not in sizes:
        raise StudyError(
            f"{scene}: the size of {body.name} is known once its mesh file is solved; solve the scene first and give "
            "project.database in place of project.scene"
        )
    return {key: sizes[key] for key in ("length", "beam", "draft")}


def check_stored(body, in_waves):
    """Raises StudyError if the solved quantities do not give the motions of a Body, or the drift of waves"""
    if not body.has_inertia:
        raise StudyError(f"{body.name}: the radii of gyration are missing; give gyration (m) and solve the body again")
    lacking = [name for name in (*RADIATION, "excitation_force") if name not in body.stored]
    drift = OF_EACH if body.bodies else DRIFT[1]
    if in_waves and drift not in body.stored and (body.bodies or not set(KOCHIN) <= body.stored):
        lacking.append(drift)
    if lacking:
        raise StudyError(
            f"{body.name}: the key want of its scene does not list {', '.join(lacking)}; list radiation, diffraction, "
            "motions and drift there, or leave the key out"
        )


def check_headings(body, seas):
    """Raises StudyError for waves, each with a direction, for which the body is not solved"""
    if body.ring is None:
        return
    try:
        body.ring.inside([one.direction for one in seas])
    except BetweenError as error:
        raise StudyError(f"{body.name}: {error}") from None


def check_waves(body, conditions):
    """Raises ValueError for waves of `Conditions` for which a Body is not solved"""
    if conditions.waves is None:
        return
    if conditions.method == "regular_wave":
        check_period(conditions.waves, body.omega)
        check_headings(body, [conditions.waves])
        return
    check_coverage(body, conditions.sea.spectrum)
    check_headings(body, getattr(conditions.sea, "systems", (conditions.sea,)))


def check_period(waves, omega):
    """Raises StudyError for a regular wave outside the band of frequencies omega (n,) rad/s"""
    if not omega[0] <= waves.omega <= omega[-1]:
        raise StudyError(
            f"waves of {waves.period:.4g} s lie outside the stored periods, {2 * np.pi / omega[-1]:.4g} to "
            f"{2 * np.pi / omega[0]:.4g} s; solve this period as well"
        )


def check_weather(study, body):
    """ExposedBox of a `Study` on a Body; for several bodies {name: ExposedBox}.  Raises ValueError for a hull, weather
    or quay that does not match."""
    study.check_depth(body.water_depth, body.name)
    hull = study.hulls_of(body) if body.bodies else study.hull_of(body.dimensions)
    for one in hull.values() if body.bodies else (hull,):
        study.check_streams(one, body.density)
    check_stored(body, study.waves is not None)
    check_waves(body, study.conditions())
    if study.quay is not None:
        method_of(study.quay, body.wall, body.name)
    return hull
