"""Wind and current of a study: the tables [wind], [current] and [hull], and their loads.

All studies of a hull share these tables. Coefficients are those of a box, given numbers, from a file in the form of
OCIMF's curves, or, for wind, those of a type of ship.  A file is read relative to its study and replaced by its
numbers, so that design states and results contain these numbers.
"""

import math
import zlib
from functools import partial
from pathlib import Path

from ..quantities import StudyError, Table, direction, in_radians, speed, waves_on
from .seas import seas_at

STREAMS = ("wind", "current")
WAYS = ("coefficients", "ship")  # ways to give coefficients of the hull; only one may be used
OF_HULL = (*WAYS, "center_z")  # keys of the hull, independent of the weather
BOXY = 0.95  # block coefficient above which a hull counts as a box
# m/s, mean over ten minutes: the best track of the Japan Meteorological Agency has 140 kn, estimated, and none more; a
# wind above STRONGEST is told.  The strongest gust is 113 m/s (World Meteorological Organization, Barrow Island 1996)
TIP, STRONGEST = 72.0, 85.0
AREAS = ("area_x", "area_y", "area_n", "length")


class SuperstructureTable(Table):
    """Wind area above the deck

    superstructure_front : m², area of superstructures, seen from ahead
    superstructure_side : m², area of superstructures seen from abeam
    superstructure_z : m, height of the middle of these areas above still water; by default they are on deck, spread
        along the hull
    """

    superstructure_front: float = 0.0
    superstructure_side: float = 0.0
    superstructure_z: float | None = None


class Coefficients(Table):
    """Force and moment coefficients of wind or current on a hull

    angles_deg : angles 0 to 90 between stream and x axis, for a box; or directions of flow, from the bow towards
        port, 0 to 180 for a hull symmetric to its centre plane, or 0 to 360
    x : coefficients of the force along x, referred to the frontal area
    y : coefficients of the force along y, referred to the lateral area
    lever : lever of the moment, divided by the length, with angles to 90
    n : coefficients of the moment about z, referred to lateral area times length, with angles to 180 or 360
    area_x : m², reference area of the force along x; by default the frontal area of the hull in the stream
    area_y : m², reference area of the force along y; by default the lateral area of the hull in the stream
    area_n : m², reference area of the moment; by default area_y
    length : m, reference length of the moment; by default the length of the hull
    height : m, height of the force above still water, if it is known
    """

    angles_deg: list[float]
    x: list[float]
    y: list[float]
    lever: list[float] | None = None
    n: list[float] | None = None
    area_x: float | None = None
    area_y: float | None = None
    area_n: float | None = None
    length: float | None = None
    height: float | None = None


class StreamTable(Table):
    """A uniform stream

    speed : m/s, speed of the stream; or give speed_knots
    file : CSV file of coefficients over 0 to 180° or 360° beside this file, in the form of OCIMF's curves
    center_z : m, height of the force above still water; by default the middle of the exposed area
    """

    speed: float | None = None
    speed_knots: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None
    coefficients: Coefficients | None = None
    file: str | None = None
    center_z: float | None = None


class CurrentTable(StreamTable):
    """A uniform current

    ship : "tanker" for generic coefficients of a loaded tanker by its sizes and the depth (UFC 4-159-03, 2005)
    waves : reference of the wave spectrum in this current: "intrinsic", in the moving water, as from wave models;
        "absolute", at a fixed place, as from a moored buoy; or "still", in water without current
    """

    ship: str | None = None
    waves: str = "intrinsic"


class WindTable(StreamTable):
    """Wind at 10 m above the sea

    ship : type of ship whose coefficients are used (Blendermann 1994), such as "tanker, loaded"; for a bulk carrier
        "cargo vessel, loaded"
    gusts : gust spectrum about the mean wind, for simulate: davenport, hino, npd or kaimal
    surface_drag : surface drag coefficient K of the gust spectrum, where it has one
    gust_height : m, height of the gust spectrum, where it has one
    gust_exponent : exponent of the wind profile in the gust spectrum, where it has one
    gust_intensity : turbulence intensity of the gust spectrum, where it has one
    """

    ship: str | None = None
    gusts: str | None = None
    surface_drag: float | None = None
    gust_height: float | None = None
    gust_exponent: float | None = None
    gust_intensity: float | None = None


def wind_of(table):
    """`mooring.studies.conditions.Wind` of a WindTable, None for None.  Raises StudyError."""
    from hakobune.mooring.studies.conditions import Wind

    if table is None:
        return None
    given = {} if (found := wind_table(table)) is None else {"table": found}
    return Wind(speed("wind", table), direction("wind", table), height=_height("wind", table), **given)


def current_of(table):
    """`mooring.studies.conditions.Current` of a CurrentTable, None for None.  Raises StudyError."""
    from hakobune.mooring.studies.conditions import Current

    if table is None:
        return None
    if table.ship not in (None, "tanker"):
        raise StudyError(f"current.ship is {table.ship!r}; allowed: tanker; give current.file for other ships")
    found = coefficients_of("current", table)
    if found is not None and table.ship is not None:
        raise StudyError("current: ship and coefficients are both given; give one of them")
    towards = speed("current", table), direction("current", table)
    return Current(*towards, found, _height("current", table), waves_on(table), table.ship)


def wind_table(table):
    """Coefficients of a WindTable from `coefficients_of`, or from its type of ship. Raises StudyError."""
    from hakobune.mooring.loads.ship_wind import ships

    if table.ship is None:
        return coefficients_of("wind", table)
    if table.coefficients is not None or table.file is not None:
        raise StudyError("wind: ship and coefficients are both given; give one of them")
    if table.ship not in ships():
        raise StudyError(
            f"wind.ship is {table.ship!r}; allowed: {'; '.join(ships())} (Blendermann 1994; he has no bulk "
            "carrier, for which cargo vessel, loaded is the nearest); give other coefficients, such as those of "
            "OCIMF, which are not public, by wind.file"
        )
    return partial(_of_ship, table.ship)


def coefficients_of(where, table):
    """Coefficients of a StreamTable for `mooring.loads.on_hull`, None if none are given.

    raises : StudyError
    """
    import numpy as np

    from hakobune.mooring.loads.box_drag import drag_table

    if table.file is not None:
        raise StudyError(
            f"{where}.file is given in a study that was not read from a file; allowed: in a study file only"
        )
    c = table.coefficients
    if c is None:
        return None
    angles, whole = np.radians(c.angles_deg), len(c.angles_deg) > 0 and max(c.angles_deg) > 90
    wrong = [key for key in ("lever",) if whole and c.lever is not None]
    wrong += [key for key in ("n", *AREAS) if not whole and getattr(c, key) is not None]
    if wrong:
        ends = "180 or 360" if wrong[0] != "lever" else "90"
        raise StudyError(f"{where}.coefficients.{wrong[0]} is given; allowed only with angles_deg up to {ends}")
    try:
        if not whole:
            return drag_table(angles, c.x, c.y, c.lever)
        made = partial(_of_hull, where, c, angles)
        made(None)
        return made
    except ValueError as error:
        raise StudyError(f"{where}.coefficients: {error}") from None


def _of_hull(where, c, angles, hull):
    """HullCoefficients from numbers; hull : `ExposedBox` for missing areas, None to check the others"""
    from hakobune.mooring.loads.coefficients import hull_coefficients

    sizes = {key: getattr(c, key) for key in (*AREAS, "height") if getattr(c, key) is not None}
    if hull is None:
        sizes = {"area_x": 1.0, "area_y": 1.0, "length": 1.0} | sizes
    elif "area_x" not in sizes or "area_y" not in sizes:
        sizes = dict(zip(("area_x", "area_y"), _areas(where, hull), strict=True)) | sizes
    if "length" not in sizes:
        sizes["length"] = hull.length
    return hull_coefficients(angles, c.x, c.y, [0.0] * len(angles) if c.n is None else c.n, **sizes)


def _areas(where, hull):
    """m², areas exposed to the stream from ahead and from abeam"""
    if where == "current":
        return hull.beam * hull.draft, hull.length * hull.draft
    from hakobune.mooring.loads.on_hull import silhouettes

    return tuple(area for area, _ in silhouettes(hull))


def _of_ship(ship, hull):
    from hakobune.mooring.loads.on_hull import silhouettes
    from hakobune.mooring.loads.ship_wind import blendermann

    (front, _), (side, height) = silhouettes(hull)
    return blendermann(ship, hull.length, front, side, height)


def _height(where, table):
    z = table.center_z
    if z is not None and not math.isfinite(z):
        raise StudyError(f"{where}.center_z is {z:g}; allowed: m, finite")
    return z


def superstructures(hull):
    """Arguments of an `ExposedBox` from a SuperstructureTable.  Raises StudyError."""
    for key in ("superstructure_front", "superstructure_side"):
        if not 0 <= getattr(hull, key) < math.inf:
            raise StudyError(f"hull.{key} is {getattr(hull, key):g}; allowed: m², at least 0")
    z = hull.superstructure_z
    if z is not None and not 0 < z < math.inf:
        raise StudyError(f"hull.superstructure_z is {z:g}; allowed: m above still water, above 0")
    return {"front_area": hull.superstructure_front, "side_area": hull.superstructure_side, "superstructure_z": z}


def with_hull(table, of_hull):
    """A raw table of wind or current, completed with the study's keys of the hull"""
    own = any(way in table for way in WAYS)
    return {key: value for key, value in of_hull.items() if not (own and key in (*WAYS, "turning"))} | table


def with_files(raw, text, path):
    """Nested dictionaries and text of a study at `path`, with the numbers of its coefficient files for wind and
    current.

    The paths of sea files are completed; the text contains a checksum of each.

    raises : StudyError
    """
    import tomli_w

    raw, seas = seas_at(raw, Path(path).parent)
    found = {}
    for where in STREAMS:
        table = raw.get(where)
        if isinstance(table, dict) and isinstance(table.get("file"), str):
            found[where] = _with_numbers(where, table, Path(path).parent)
    if not found and not seas:
        return raw, text
    named = [", ".join(f"{where} of {raw[where]['file']}" for where in found)] if found else []
    named += [f"{one.name}, checksum {zlib.crc32(one.read_bytes()):08x}" for one in seas if one.is_file()]
    raw, head = {**raw, **found}, "coefficients: " if found else ""
    return raw, f"# {Path(path).name} with {head}{'; '.join(named)}\n{tomli_w.dumps(raw)}"


def _with_numbers(where, table, folder):
    """A raw table with the coefficients of its file instead of the file's name"""
    import numpy as np

    from hakobune.mooring.loads.coefficients import read_hull_coefficients

    other = [way for way in ("coefficients", "ship", "turning") if way in table]
    if other:
        raise StudyError(f"{where}: {other[0]} and file are both given, and each defines the force; give one of them")
    try:
        c = read_hull_coefficients(folder / table["file"])
    except ValueError as error:
        raise StudyError(f"{where}.file: {error}") from None
    numbers = {"angles_deg": np.round(np.degrees(c.angle), 9), "x": c.x, "y": c.y, "n": c.n}
    sizes = {key: getattr(c, key) for key in (*AREAS, "height") if getattr(c, key) is not None}
    coefficients = {key: values.tolist() for key, values in numbers.items()} | sizes
    return {key: value for key, value in table.items() if key != "file"} | {"coefficients": coefficients}


def doubtful_weather(study):
    """Messages on a wind stronger than any measured wind, and on directions that look like radians.

    study : with wind, current and waves, each None or a table
    """
    said = []
    if study.wind is not None and (given := speed("wind", study.wind)) > STRONGEST:
        said.append(
            f"the wind has {given:.4g} m/s, and the strongest known mean over ten minutes is {TIP:g} m/s (typhoon Tip, "
            f"1979); a gust, knots or km/h may be meant"
        )
    for where in (*STREAMS, "waves"):
        for key in ("direction_deg", "incidence_deg"):
            if (given := getattr(getattr(study, where), key, None)) is not None:
                said += in_radians(f"{where}.{key}", [given])
    return said


def no_box(block, hull, study):
    """A message if wind and current treat a hull that is no box as a box; else [].

    block : displacement over length, beam and draft; study : with wind and current
    """
    boxed = [
        where
        for where in STREAMS
        if (table := getattr(study, where)) is not None
        and table.coefficients is None
        and all(getattr(table, way, None) is None for way in ("ship", "turning"))
    ]
    if not boxed or block > BOXY:
        return []
    ways = {"wind": 'wind.ship = "…" or wind.file', "current": 'current.ship = "tanker" or current.file'}
    act, give = "act" if len(boxed) > 1 else "acts", ", and ".join(ways[where] for where in boxed)
    return [
        f"{' and '.join(boxed)} {act} as on a box of {hull.length:g} by {hull.beam:g} m, which the hull is not: it "
        f"fills {100 * block:.3g} % of length, beam and draft; give {give}"
    ]
