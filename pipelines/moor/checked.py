"""Check of a whole mooring study before any work: every name in the study, and the data of the hull that the weather of
the study needs."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_frequencies import DRIFT, KOCHIN, RADIATION, BetweenError
from hakobune.bem.database.between_headings import Ring, ring
from hakobune.mooring.response.seas import check_coverage

from ..common.quantities import StudyError
from .quay import method_of

SYMMETRY = {"box": "xy", "buoy": "xy", "ship": "y"}  # planes of the shapes of a scene


class Body(NamedTuple):
    """Properties of a body that are known before its waves are solved.

    name : of its database or scene, for messages; dimensions : {name: m}, empty for a mesh file
    rotation_center : (3,) m; density : kg/m³; gravity : m/s²; water_depth : m
    omega : (n,) rad/s, the first and last are its band; wall : m, y, or None
    ring : `Ring` of the solved waves, None for a mesh file of unknown symmetry
    stored : names of the solved quantities; has_inertia : whether its radii of gyration are known
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

    @property
    def sizes(self):
        """Dimensions that are known before the hull is meshed, m; they replace `sizes` of a database"""
        return self.dimensions


def body_of_database(db):
    """Body of an open database"""
    water = db.density, db.gravity, db.water_depth
    waves = db.reader.omega, db.wall, db.reader.ring, frozenset(db.reader.between.quantities)
    return Body(db.path, db.dimensions, db.rotation_center, *water, *waves, db.inertia_matrix is not None)


def body_of_scene(name, scene):
    """Body of a Scene.  Raises StudyError for several bodies."""
    if len(scene.bodies) > 1:
        names = ", ".join(body.name for body in scene.bodies)
        raise StudyError(
            f"{name} has {len(scene.bodies)} bodies, {names}; allowed here: one body; hakobune moor, response and "
            "simulate take several"
        )
    water, shape, planes = scene.water, scene.body.shape, SYMMETRY.get(scene.body.shape)
    of_water = water.density, water.gravity, water.depth
    if planes is not None:
        planes = planes if scene.wall is None else planes.replace("y", "")
        planes = ring(scene.headings(), (), planes, shape == "buoy" and scene.wall is None, wall=scene.wall)
    center = np.array(scene.rotation_center)
    waves = scene.omegas(), scene.wall, planes, frozenset(scene.names())
    return Body(name, scene.dimensions, center, *of_water, *waves, scene.motions_known)


def check_stored(body, in_waves):
    """Raises StudyError if the solved quantities do not give the motions of a Body, or the drift of waves"""
    if not body.has_inertia:
        raise StudyError(f"{body.name}: the radii of gyration are missing; give gyration (m) and solve the body again")
    lacking = [name for name in (*RADIATION, "excitation_force") if name not in body.stored]
    if in_waves and DRIFT[1] not in body.stored and not set(KOCHIN) <= body.stored:
        lacking.append(DRIFT[1])
    if lacking:
        raise StudyError(
            f"{body.name}: its want does not include {', '.join(lacking)}; give radiation, diffraction, motions and "
            "drift, or leave out want"
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
    """ExposedBox of a `Study` on a Body.  Raises ValueError for a hull, weather or quay that does not match."""
    study.check_depth(body.water_depth, body.name)
    hull = study.hull_of(body.dimensions)
    study.check_streams(hull, body.density)
    check_stored(body, study.waves is not None)
    check_waves(body, study.conditions())
    if study.quay is not None:
        method_of(study.quay, body.wall, body.name)
    return hull
