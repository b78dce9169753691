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

    [[points]]                       # of several bodies: in the coordinates of one of them
    name = "manifold"
    body = "barge"
    position = [0.0, 6.0, 3.0]

    [[relative]]                     # how far the second of two points moves from the first
    name = "hose"
    points = ["manifold", "quay side"]

    [[hinges]]                       # between two bodies, exact
    name = "hinge"
    bodies = ["fore", "aft"]
    position = [-16.5, 0.0, 1.0]         # m, in the coordinates of the first

    [keel]
    tide = -0.5                          # m, under-keel clearance at this level of the water
    extra_draft = 0.2                    # m

Directions have either `direction_deg`, the direction of travel, or `incidence_deg`, the angle χ of the reports, 0
from ahead.
"""

from pathlib import Path

import msgspec
import numpy as np

from hakobune.bem.modes import words_of
from hakobune.bem.viscous_table import Laws

from ..common.quantities import StudyError, Table, direction, positive, speed, waves_on
from ..common.quay_tables import HingeTable, StationTable
from ..common.typed import typed
from ..common.weather import seas as common
from ..common.weather.seas import family_of, seas_at, shape_of, spreading_of
from ..site.link import RESPONSE, SiteLink, read_study_at_site

ONE_BODY = words_of(())


class SeaTable(common.SystemsTable):
    """A sea with one wave system or several

    duration_hours : duration of the sea whose largest motions are computed
    qtf : method of the slow force of pairs of waves: "newman"; "bound-wave", which adds the bound long waves;
        "body", with all parts that `hakobune qtf` stores except the forcing of the free surface; "full", with this
        forcing too; or "auto", the cheapest method that is accurate enough. All methods but "newman" need one wave
        system, and "bound-wave" needs long crests
    """

    duration_hours: float = 3.0
    qtf: str = "newman"


class DirectionTable(Table):
    """A direction of the climate

    share : fraction of the time with waves in this direction
    """

    share: float
    direction_deg: float | None = None
    incidence_deg: float | None = None


class ClimateTable(Table):
    """Wave scatter of a place and its directions

    scatter : CSV file of the scatter table, beside the study
    years : years, return period of the extremes
    """

    scatter: str
    directions: list[DirectionTable]
    spectrum: str = "issc"
    gamma: float | None = None
    spreading: str | None = None
    years: float = 50.0


class PointTable(Table):
    """A point of the body whose motion is computed

    name : name of the point in results
    position : m, x, y, z of the point with the body at rest
    clearance : m, height above still water of the part that has to stay dry; needed for the air gap
    body : name of the body in whose coordinates the position is given, where there are several bodies
    """

    name: str
    position: tuple[float, float, float]
    clearance: float | None = None
    body: str = ""


class RelativeTable(Table):
    """Relative motion of two points on two bodies: a gangway, a hose, a fender

    name : name of the relative motion in results
    points : names of the two points; the motion of the second is taken relative to the first, in the axes of the
    first's body
    """

    name: str
    points: tuple[str, str]


class KeelTable(Table):
    """Under-keel clearance

    tide : m, water level above that of the database's depth
    extra_draft : m, draft in addition to that of the hull
    points : m, points [x, y, z], … of the bottom; by default the corners of the hull's deepest part
    """

    tide: float = 0.0
    extra_draft: float = 0.0
    points: list[tuple[float, float, float]] | None = None


class BodyTable(Table):
    """Damping and stiffness in addition to those of the database

    viscous : viscous damping that grows with the motion, linearised in the sea; it replaces the viscous damping of
        the database's scene
    damping_ratio : {motion = share of critical damping}, in addition to radiation; with several bodies {"barge roll"
        = share}
    damping : additional damping, a 6 × 6 matrix in SI units; with several bodies six rows for each that moves
    stiffness : additional stiffness, a 6 × 6 matrix in SI units; with several bodies six rows for each that moves
    """

    viscous: Laws | None = None
    damping_ratio: dict[str, float] = msgspec.field(default_factory=dict)
    damping: list[list[float]] | None = None
    stiffness: list[list[float]] | None = None


class CarryingTable(Table):
    """A uniform current that carries the waves of [sea]; its force on the hull is part of a mooring study

    speed : m/s, current speed; or give speed_knots
    waves : reference of the spectrum, as in a mooring study: "intrinsic", "absolute" or "still"
    """

    speed: float | None = None
    speed_knots: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None
    waves: str = "intrinsic"


class ResponseStudy(Table):
    """Response of a solved body in one sea or in a climate"""

    site: SiteLink | None = None
    sea: SeaTable | None = None
    climate: ClimateTable | None = None
    current: CarryingTable | None = None
    body: BodyTable = msgspec.field(default_factory=BodyTable)
    points: list[PointTable] = msgspec.field(default_factory=list)
    relative: list[RelativeTable] = msgspec.field(default_factory=list)
    stations: list[StationTable] = msgspec.field(default_factory=list)
    hinges: list[HingeTable] = msgspec.field(default_factory=list)
    keel: KeelTable | None = None

    def restrained(self, body):
        """A Body with the damping and stiffness of the study"""
        count = len(body.words)
        damping = _matrix("damping", self.body.damping, count)
        stiffness = _matrix("stiffness", self.body.stiffness, count)
        if damping is not None and np.all(np.isfinite(damping)):
            _check_damping(damping, body.words)
        body = body.restrained(damping, stiffness)
        if stiffness is not None:
            _check_stable(body.stiffness, body.words, body.rigid)
        return body.restrained(damping=damping_of("body", self.body.damping_ratio, body))

    def stream(self):
        """`mooring.studies.conditions.Current` of the study, None for none.  Raises StudyError."""
        from hakobune.mooring.studies.conditions import Current

        if self.current is None:
            return None
        towards = speed("current", self.current), direction("current", self.current)
        return Current(*towards, waves=waves_on(self.current))


def viscous_laws(study, db):
    """{degree of freedom: law} of a ResponseStudy, by default the laws in the scene of the database"""
    from hakobune.bem.viscous_table import laws_of
    from hakobune.mooring.response import viscous

    if study.body.viscous is None:
        return viscous.laws_of(db.bodies_reader)
    if db.bodies:
        raise StudyError(
            f"body.viscous is given, but {db.path} contains {len(db.bodies)} bodies; give damping or damping_ratio"
        )
    box = db.dimensions if "beam" in db.dimensions else {}
    return laws_of("body.viscous", study.body.viscous, box, db.density, db.gravity)


def viscous_words(body, laws, damping):
    """Messages on the viscous damping (6, 6) of each law in a sea"""
    for dof in laws:
        i = body.names.index(dof)
        share = damping[i, i] / body.critical_damping(i)
        yield f"viscous damping of {body.words[i]} in this sea is {100 * share:.3g} % of critical"


def read_response_study(path):
    """The ResponseStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_study_at_site(Path(path), "a response study", RESPONSE)
    return make_response_study(seas_at(raw, Path(path).parent)[0], path), text


def make_response_study(raw, name="the study"):
    """The ResponseStudy of nested dictionaries; name : name of their source in messages.  Raises StudyError."""
    study = typed(raw, ResponseStudy, StudyError)
    if (study.sea is None) == (study.climate is None):
        state = "has neither" if study.sea is None else "has both"
        raise StudyError(f"{name} {state} [sea] and [climate]; give one of them")
    return study


def files_of(study, folder):
    """Paths of the files that a ResponseStudy reads"""
    if study.climate is not None:
        return [folder / study.climate.scatter]
    return [Path(one.file) for one in (study.sea, *study.sea.swell) if one.file is not None]


def damping_of(where, ratios, body):
    """Damping matrix of a Body, SI, shape (n, n), from ratios {motion: share of critical}.  Raises StudyError."""
    extra = np.zeros_like(body.damping)
    for mode, ratio in checked_ratios(where, ratios, body.words).items():
        extra[mode, mode] = ratio * body.critical_damping(mode)
    return extra


def checked_ratios(where, ratios, names=ONE_BODY):
    """{index of a motion: share of critical} from ratios by name.  Raises StudyError."""
    for name, ratio in ratios.items():
        if name not in names:
            raise StudyError(f"{where}.damping_ratio.{name} is unknown; allowed: {', '.join(names)}")
        if not 0 <= ratio < 1:
            raise StudyError(f"{where}.damping_ratio.{name} is {ratio:g}; allowed: 0 to 1")
    return {list(names).index(name): ratio for name, ratio in ratios.items()}


def climate_of(table, beside, depth):
    """Arguments of `mooring.response.climate.climate` after the body; beside : path of the study; depth : m."""
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


def _matrix(name, rows, count):
    if rows is None:
        return None
    if [len(row) for row in rows] != [count] * count:
        raise StudyError(
            f"body.{name} has rows of {[len(row) for row in rows]} numbers; allowed: {count} rows of {count}"
        )
    return np.array(rows)


def _check_damping(matrix, words):
    """Raise StudyError for damping that adds energy to a motion: a negative eigenvalue of its symmetric part"""
    least, worst = _least(matrix)
    if not least >= -1e-9:
        value = matrix[worst, worst]
        raise StudyError(
            f"body.damping would add energy to {words[worst]}: its damping there is {value:.4g}; allowed: at least 0"
        )


def _check_stable(stiffness, words, rigid):
    """Raise StudyError for a body that sinks or capsizes with the stiffness of the study"""
    restored = [d for d in range(rigid) if d % 6 in (2, 3, 4)]
    upright = stiffness[np.ix_(restored, restored)]
    least, worst = _least(upright)
    if not least > 0:
        value, name = upright[worst, worst], words[restored[worst]]
        raise StudyError(
            f"with body.stiffness the restoring of {name} is {value:.4g}, so the body does not float; allowed: above 0"
        )


def _least(matrix):
    """Least eigenvalue of the symmetric part with each diagonal scaled to one, and the dominant motion of its vector"""
    even = 0.5 * (matrix + matrix.T)
    size = np.sqrt(np.where(np.diag(even) == 0, np.abs(even).max() + 1e-300, np.abs(np.diag(even))))
    values, vectors = np.linalg.eigh(even / np.outer(size, size))
    return float(values[0]), int(np.argmax(np.abs(vectors[:, 0])))
