"""A response study: a body of a database in one sea, or in a climate, as typed TOML.

    [sea]                           or   [climate]
    spectrum = "issc"                    scatter = "scatter.csv"     # beside the study
    height = 4.5                         spectrum = "issc"
    mean_period = 10.0                   years = 50
    incidence_deg = 60.0                 directions = [{ direction_deg = 0, share = 1.0 }]
    spreading = "cosine:4"

    [[sea.swell]]                    # beside the height in [sea]: swell, long waves
    file = "hindcast.sp2"            # SWAN, WAVEWATCH III, ERA5, NDBC, Datawell …, beside the study
    x_axis_compass_deg = 30.0

    [body]
    damping_ratio = { roll = 0.02 }      # of critical, beyond radiation
    viscous = { roll = "Yamashita" }     # or laws as in a scene, linearised in the sea; not in a climate

    [[points]]
    name = "bow"
    position = [50.0, 0.0, 10.0]
    clearance = 8.0                      # m above still water, what has to stay dry

    [keel]
    tide = -0.5                          # m, under-keel clearance at this level of the water
    extra_draft = 0.2                    # m

Directions have either `direction_deg`, travelled to, or `incidence_deg`, the angle χ of the reports, 0 from ahead.
"""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import msgspec
import numpy as np

from hakobune.bem import DOFS
from hakobune.bem.viscous_table import Laws

from ..common.quantities import StudyError, Table, direction, positive, speed, waves_on
from ..common.typed import typed
from ..common.weather import seas as common
from ..common.weather.seas import family_of, seas_at, shape_of, spreading_of
from ..site.link import RESPONSE, SiteLink, read_study_at_site


class SeaTable(common.SystemsTable):
    """A sea of one system of waves, or of several at once

    duration_hours : of the largest motions
    qtf : slow force of pairs of waves: "newman", "bound-wave" (with the long waves bound to them), "body" (all that
    `hakobune qtf` stores but the forcing of the surface), "full" (with it) or "auto" (the cheapest that is enough);
    above "newman" of one system of waves, "bound-wave" of long crests only
    """

    duration_hours: float = 3.0
    qtf: str = "newman"


class DirectionTable(Table):
    """A direction of the climate

    share : of the time with waves of this direction
    """

    share: float
    direction_deg: float | None = None
    incidence_deg: float | None = None


class ClimateTable(Table):
    """All seas of a place and how often they come

    scatter : CSV file beside the study
    years : return period of the extremes
    """

    scatter: str
    directions: list[DirectionTable]
    spectrum: str = "issc"
    gamma: float | None = None
    spreading: str | None = None
    years: float = 50.0


class PointTable(Table):
    """A point of the body whose motion is wanted

    name : for results
    position : m, x, y, z with the body at rest
    clearance : m, above still water, of what has to stay dry
    """

    name: str
    position: tuple[float, float, float]
    clearance: float | None = None


class KeelTable(Table):
    """Water under the bottom

    tide : m, level above that of the database's depth
    extra_draft : m, beyond the hull's
    points : m, [x, y, z], … of the bottom, by default the corners of the hull's deepest part
    """

    tide: float = 0.0
    extra_draft: float = 0.0
    points: list[tuple[float, float, float]] | None = None


class BodyTable(Table):
    """What acts on the body beside the waves

    viscous : damping that grows with the motion, linearised in the sea, in place of that of the database's scene
    damping_ratio : {motion = share of critical}, beyond radiation
    damping : 6 × 6 in SI units, added
    stiffness : 6 × 6 in SI units, added
    """

    viscous: Laws | None = None
    damping_ratio: dict[str, float] = msgspec.field(default_factory=dict)
    damping: list[list[float]] | None = None
    stiffness: list[list[float]] | None = None


class CarryingTable(Table):
    """A uniform current that carries the waves of [sea]; a mooring study has its force on the hull

    speed : m/s; or speed_knots
    waves : as in a mooring study: "intrinsic", "absolute" or "still"
    """

    speed: float | None = None
    speed_knots: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None
    waves: str = "intrinsic"


class ResponseStudy(Table):
    """A body of a database in one sea, or in a climate"""

    site: SiteLink | None = None
    sea: SeaTable | None = None
    climate: ClimateTable | None = None
    current: CarryingTable | None = None
    body: BodyTable = msgspec.field(default_factory=BodyTable)
    points: list[PointTable] = msgspec.field(default_factory=list)
    keel: KeelTable | None = None

    def restrained(self, body):
        """A Body with the damping and stiffness of the study"""
        damping, stiffness = _matrix("damping", self.body.damping), _matrix("stiffness", self.body.stiffness)
        if damping is not None and np.all(np.isfinite(damping)):
            _check_damping(damping)
        body = body.restrained(damping, stiffness)
        if stiffness is not None:
            _check_stable(body.stiffness)
        return body.restrained(damping=damping_of("body", self.body.damping_ratio, body))

    def stream(self):
        """`mooring.studies.conditions.Current` of the study, None for none.  Raises StudyError."""
        from hakobune.mooring.studies.conditions import Current

        if self.current is None:
            return None
        towards = speed("current", self.current), direction("current", self.current)
        return Current(*towards, waves=waves_on(self.current))

    def places(self, db):
        """Points of the study, those of the bottom after the others; db : database"""
        from hakobune.mooring.response.points import Point

        twice = [name for name, count in Counter(point.name for point in self.points).items() if count > 1]
        if twice:
            raise StudyError(f"two points are called {twice[0]!r}; give each a name of its own")
        for i, point in enumerate(self.points):
            if not all(map(math.isfinite, point.position)):
                raise StudyError(f"points[{i}].position is {list(point.position)}; allowed: finite, m")
            if point.clearance is not None:
                positive(f"points[{i}].clearance", point.clearance)
        points = [Point(point.name, point.position, point.clearance) for point in self.points]
        return points + (keel_points(self.keel, db) if self.keel else [])


def viscous_laws(study, db):
    """{degree of freedom: law} of a ResponseStudy, those of the database's scene where it gives none"""
    from hakobune.bem.viscous_table import laws_of
    from hakobune.mooring.response import viscous

    if study.body.viscous is None:
        return viscous.laws_of(db.reader)
    box = db.dimensions if "beam" in db.dimensions else {}
    return laws_of("body.viscous", study.body.viscous, box, db.density, db.gravity)


def viscous_words(body, laws, damping):
    """A line on the viscous damping (6, 6) that each of the laws has in a sea"""
    for dof in laws:
        i = DOFS.index(dof)
        share = damping[i, i] / body.critical_damping(i)
        yield f"viscous damping of {dof.lower()} in this sea: {100 * share:.2g} % of critical"


def keel_points(table, db):
    """`KeelPoint`s of a KeelTable.  Raises StudyError where there is no water under one at rest."""
    from hakobune.mooring.response.points import KeelPoint, corners_of_bottom

    if not math.isfinite(db.water_depth):
        raise StudyError("[keel] is given and the water of the database has no bed; solve it in finite depth")
    for key in ("tide", "extra_draft"):
        if not math.isfinite(getattr(table, key)):
            raise StudyError(f"keel.{key} is {getattr(table, key)}; allowed: finite, m")
    found = corners_of_bottom(db.mesh.whole().points) if table.points is None else table.points
    points = []
    for x, y, z in found:
        gap = db.water_depth + table.tide + z - table.extra_draft
        if not gap > 0:
            raise StudyError(
                f"under ({x:g}, {y:g}, {z:g}) there is {gap:.3g} m of water at rest, depth {db.water_depth:g}, tide "
                f"{table.tide:g}, extra draft {table.extra_draft:g} m; allowed: above 0"
            )
        points.append(KeelPoint(f"keel x {x:.4g} y {y:.4g}", (float(x), float(y), float(z)), gap))
    return points


def read_response_study(path):
    """The ResponseStudy of a TOML file and its text.  Raises StudyError."""
    raw, text = read_study_at_site(Path(path), "a response study", RESPONSE)
    return make_response_study(seas_at(raw, Path(path).parent)[0], path), text


def make_response_study(raw, name="the study"):
    """The ResponseStudy of nested dictionaries; name : of what they are of.  Raises StudyError."""
    study = typed(raw, ResponseStudy, StudyError)
    if (study.sea is None) == (study.climate is None):
        state = "has neither" if study.sea is None else "has both"
        raise StudyError(f"{name} {state} [sea] and [climate]; allowed: one of them")
    return study


def files_of(study, folder):
    """Paths of the files that a ResponseStudy reads"""
    if study.climate is not None:
        return [folder / study.climate.scatter]
    return [Path(one.file) for one in (study.sea, *study.sea.swell) if one.file is not None]


def damping_of(where, ratios, body):
    """(6, 6) SI of ratios {motion: of critical} of a Body.  Raises StudyError."""
    extra = np.zeros((6, 6))
    for mode, ratio in checked_ratios(where, ratios).items():
        extra[mode, mode] = ratio * body.critical_damping(mode)
    return extra


def checked_ratios(where, ratios):
    """{number of a motion: of critical} of ratios by its name.  Raises StudyError."""
    names = [dof.lower() for dof in DOFS]
    for name, ratio in ratios.items():
        if name not in names:
            raise StudyError(f"{where}.damping_ratio.{name} is unknown; allowed: {', '.join(names)}")
        if not 0 <= ratio < 1:
            raise StudyError(f"{where}.damping_ratio.{name} is {ratio:g}; allowed: 0 to 1")
    return {names.index(name): ratio for name, ratio in ratios.items()}


def climate_of(table, beside, depth):
    """Arguments of `mooring.response.climate.climate` after the body; `beside` is the path of the study, depth m."""
    from hakobune.mooring.environment.scatter import read_scatter

    positive("climate.years", table.years)
    named = [(f"climate.directions[{i}]", entry) for i, entry in enumerate(table.directions)]
    spreading = None if table.spreading is None else lambda spectrum: spreading_of("climate", table, spectrum)
    return dict(
        scatter=read_scatter(Path(beside).parent / table.scatter),
        family=family_of("climate", table, depth),
        directions_and_shares=[(direction(where, entry), entry.share) for where, entry in named],
        spreading=spreading,
        **shape_of(table),
    )


def _matrix(name, rows):
    if rows is None:
        return None
    if [len(row) for row in rows] != [6] * 6:
        raise StudyError(f"body.{name} has rows of {[len(row) for row in rows]} numbers; allowed: 6 rows of 6")
    return np.array(rows)


def _check_damping(matrix):
    """Raise StudyError for damping that gives a motion energy: a negative eigenvalue of its symmetric part"""
    least, worst = _least(matrix)
    if not least >= -1e-9:
        value = matrix[worst, worst]
        raise StudyError(f"body.damping gives energy to {DOFS[worst].lower()}, {value:.4g} of it; allowed: at least 0")


def _check_stable(stiffness):
    """Raise StudyError for a body that sinks or capsizes with the stiffness of the study"""
    upright = stiffness[2:5, 2:5]
    least, worst = _least(upright)
    if not least > 0:
        value, name = upright[worst, worst], DOFS[2 + worst].lower()
        raise StudyError(
            f"body.stiffness leaves {value:.4g} of restoring to {name}: the body does not float; allowed: above 0"
        )


def _least(matrix):
    """Least eigenvalue of the symmetric part with each diagonal scaled to one, and the motion most in it"""
    even = 0.5 * (matrix + matrix.T)
    size = np.sqrt(np.where(np.diag(even) == 0, np.abs(even).max() + 1e-300, np.abs(np.diag(even))))
    values, vectors = np.linalg.eigh(even / np.outer(size, size))
    return float(values[0]), int(np.argmax(np.abs(vectors[:, 0])))
