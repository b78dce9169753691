"""A ship that passes a moored ship, as typed TOML.

Bodies are described as in a scene. For a mesh file, the middle of the mesh's length and beam is the ship's middle.

[water]                [moored]               [passing]              [track]
depth = 20.0           shape = "ship"         shape = "ship"         distance = 110.0
                       length = 243.5         length = 185.4         speed = 5.144
                       beam = 39.0            beam = 25.8
                       draft = 15.3           draft = 6.8
                       block = 0.8            block = 0.75
"""

import math
from pathlib import Path

import numpy as np

from hakobune.mooring.passing.passage import Track

from ..common.quantities import StudyError, Table, water_density
from ..common.typed import read_toml, typed
from ..common.weather.water import DepthTable
from ..scene.checks import check_body
from ..scene.tables import BodyTable

SHIPS = "moored", "passing"
METHODS = ("panels", "wang", "kriebel")
PANELS = 12, 2000  # fewest and most panels on each hull
LENGTHS = 0.5, 20.0  # mean lengths of track
FASTEST = 40.0  # m/s


class WaterTable(DepthTable):
    """Water at the place"""

    density: float = 1025.0


class TrackTable(Table):
    """Track of the passing ship, parallel to the moored ship

    distance : m, distance between the centre lines, positive to port of the moored ship
    speed : m/s, speed over the ground
    opposite : whether the ship heads towards the stern of the moored ship
    current : m/s, current along the track, positive towards the bow of the moored ship
    lengths : length of track before and behind the moored ship, in mean ship lengths
    """

    distance: float
    speed: float
    opposite: bool = False
    current: float = 0.0
    lengths: float = 4.0


class PassingStudy(Table):
    """A ship that passes a moored one

    method : "panels", "wang" (slender ships, 1975) or "kriebel" (model tests, 2005)
    panels : number of panels on each hull, for the method panels
    wall : m, y of a vertical quay wall along the moored ship, for the method panels
    quay : whether the moored ship lies at a vertical quay, for the method kriebel
    peaks : coefficients of surge, sway and yaw in deep water for the method kriebel, in place of those of Wang's theory
    """

    water: WaterTable
    moored: BodyTable
    passing: BodyTable
    track: TrackTable
    method: str = "panels"
    panels: int = 300
    wall: float | None = None
    quay: bool = False
    peaks: tuple[float, float, float] | None = None


def read_study(path):
    """PassingStudy of a TOML file, with the mesh files beside that file, and the text of the file.  Raises
    StudyError."""
    raw, text = read_toml(path, "a study of a passing ship", StudyError)
    for body in (raw.get(name) for name in SHIPS):
        if isinstance(body, dict) and isinstance(body.get("file"), str):
            body["file"] = str(Path(path).parent / body["file"])
    return make_study(raw), text


def make_study(raw):
    """The PassingStudy of nested dictionaries.  Raises StudyError."""
    study = typed(raw, PassingStudy, StudyError)
    if not study.water.depth > 0:
        raise StudyError(f"water.depth is {study.water.depth:g} m; allowed: above 0, or inf")
    water_density("water.density", study.water.density)
    for name in SHIPS:
        _check_ship(name, getattr(study, name), study.water.depth)
    if study.method not in METHODS:
        raise StudyError(f"method is {study.method!r}; allowed: {', '.join(METHODS)}")
    if not PANELS[0] <= study.panels <= PANELS[1]:
        raise StudyError(f"panels is {study.panels}; allowed: {PANELS[0]} to {PANELS[1]}, on each hull")
    if not LENGTHS[0] <= study.track.lengths <= LENGTHS[1]:
        raise StudyError(f"track.lengths is {study.track.lengths:g}; allowed: {LENGTHS[0]:g} to {LENGTHS[1]:g}")
    _check_fits(study)
    return study


def _check_fits(study):
    """Raise StudyError for keys of another method"""
    own = {"wall": "panels", "quay": "kriebel", "peaks": "kriebel"}
    for key, method in own.items():
        if getattr(study, key) not in (None, False) and study.method != method:
            raise StudyError(f"{key} is given with method = {study.method!r}; it applies to {method!r} only")
    if study.wall is not None and not math.isfinite(study.wall):
        raise StudyError(f"wall is {study.wall} m; allowed: finite; leave it out for open water")
    if study.peaks is not None and not all(0 < value < 100 for value in study.peaks):
        raise StudyError(f"peaks are {list(study.peaks)}; allowed: above 0, below 100")
    if study.method == "kriebel" and not math.isfinite(study.water.depth):
        raise StudyError(
            'method = "kriebel" is based on tests in shallow water; give a finite depth, or method = "wang"'
        )


def _check_ship(name, body, depth):
    """Raise StudyError for a missing body, or keys that a passage does not use"""
    check_body(name, body, depth)
    if body.rotation_center is not None and name != "moored":
        raise StudyError(f"{name}.rotation_center is given; only the moored ship has one")
    others = {key: getattr(body, key) for key in ("mass", "GM", "gyration", "name", "place", "viscous")}
    others |= {"center_of_gravity": any(body.center_of_gravity) or None, "trimmed": body.trimmed or None,
               "fixed": body.fixed or None}  # fmt: skip
    for key, value in others.items():
        if value is not None:
            raise StudyError(f"{name}.{key} is given; a passage needs the hull only: leave it out")


def track_of(study):
    """`Track` of a study.  Raises StudyError."""
    table = study.track
    if not table.speed <= FASTEST:
        raise StudyError(f"track.speed is {table.speed:g} m/s; allowed: up to {FASTEST:g}")
    try:
        return Track(table.distance, table.speed, table.opposite, table.current)
    except ValueError as error:
        raise StudyError(f"track: {error}") from None


def size(body, hull):
    """Length, beam and draft, m; shape (3,): as given, or taken from a mesh file, which must have both sides of the
    hull
    """
    if body.shape == "mesh":
        length, beam = np.ptp(hull.points[:, :2], axis=0)
        return np.array([length, beam, hull.draft])
    wide = 2 * body.radius if body.shape == "buoy" else None
    return np.array([wide or body.length, wide or body.beam, body.draft])


def check_apart(study, beams):
    """Distance between the sides of the ships, m.  Raises StudyError for ships that touch, or one inside the wall;
    beams : (2,) m
    """
    half = 0.5 * np.asarray(beams)
    distance, wall = study.track.distance, study.wall
    gap = abs(distance) - half.sum()
    if gap <= 0:
        raise StudyError(
            f"track.distance is {distance:g} m, {-gap:.3g} m less than half of both beams; allowed: more than "
            f"{half.sum():.3g} m between the centre lines"
        )
    if wall is None:
        return gap
    beside = [abs(wall) - half[0], abs(wall - distance) - half[1]]
    if min(beside) <= 0 or (wall - distance) * wall < 0:
        raise StudyError(f"wall is at y = {wall:g} m; allowed: beyond the moored ship or beyond the track")
    return gap
