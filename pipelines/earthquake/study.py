"""An earthquake at dolphins as typed TOML: a body, its fenders, and the data of the ground motion.

motion = "sway"         [fender]            # keys of `hakobune fender`   [spectrum]
                        family = "cell"                                   periods = [0.1, 0.5, 1.0, 5.0]
[body]  # or --database height = 2.0                                      acceleration = [2.0, 5.0, 4.0, 0.5]
mass = 51250.0      # t count = 3           # on each side
added_mass = 40000.0    clearance = 0.0                                   [record]          # and, or
damping = 500.0  # kN s/m                                                 file = "akashi.csv"

[rule]                  # as in a site file
rule = "A"
factors = { coefficient = 0.2 }
"""

import math
from pathlib import Path

import numpy as np

from hakobune.mooring.dolphins.earthquake import UNEVEN, EarthquakeError, Fenders, Floater, ground_of_record
from hakobune.mooring.dolphins.methods import Quake
from hakobune.mooring.site.seismic import seismic_coefficient

from ..common.fender_tables import FenderTable, fender_of, pair_of
from ..common.quantities import StudyError, Table, below, positive
from ..common.typed import typed
from ..results.given import database_of
from ..site.link import EARTHQUAKE, SiteLink, read_study_at_site
from ..site.study import EarthquakeTable

MOTIONS = ("surge", "sway")
COLUMNS = {"acceleration_m_s2": 1.0, "acceleration_gal": 0.01}
STRONGEST, LONGEST, WIDEST = 50.0, 600.0, 5.0  # m/s²; s; m of clearance
LARGEST_COEFFICIENT = 2.0


class BodyTable(Table):
    """Mass, added mass and damping of the body, where no database is given

    mass : t, mass of the body
    added_mass : t, added mass in the direction of motion
    damping : kN s/m, linear damping in the direction of motion
    """

    mass: float
    added_mass: float = 0.0
    damping: float = 0.0


class SideFender(FenderTable, kw_only=True):
    """The fenders on one side of the body; the other side has equal fenders

    count : number of fenders on each side, 1 to 1000
    clearance : m, gap between fender and body at rest
    """

    clearance: float = 0.0


class RecordTable(Table):
    """A record of the ground acceleration; it is corrected so that the ground is at rest at the end

    file : CSV file beside the study with the columns time_s and acceleration_m_s2 or acceleration_gal, equally spaced
        in time
    scale : factor on the accelerations
    after : s, time without ground motion that is simulated after the record
    """

    file: str
    scale: float = 1.0
    after: float = 20.0


class SpectrumTable(Table):
    """A response spectrum

    periods : s, rising periods; the acceleration is linear between them
    acceleration : m/s², spectral acceleration at each period
    damping_ratio : damping ratio of the spectrum
    """

    periods: list[float]
    acceleration: list[float]
    damping_ratio: float = 0.05


class EarthquakeStudy(Table):
    """A floating body between dolphins during an earthquake

    motion : direction of motion: "sway", across the dolphins, or "surge"
    coefficient : seismic coefficient, such as the coefficient that a site study computes; or give rule
    """

    fender: SideFender
    motion: str = "sway"
    body: BodyTable | None = None
    record: RecordTable | None = None
    spectrum: SpectrumTable | None = None
    rule: EarthquakeTable | None = None
    coefficient: float | None = None
    site: SiteLink | None = None


def read_study(path):
    """EarthquakeStudy of a TOML file, with the full path of its record, and the text of the file.  Raises
    StudyError.
    """
    raw, text = read_study_at_site(Path(path), "an earthquake study", EARTHQUAKE)
    record = raw.get("record")
    if isinstance(record, dict) and isinstance(record.get("file"), str):
        raw = raw | {"record": record | {"file": str(Path(path).resolve().parent / record["file"])}}
    return make_study(raw), text


def make_study(raw):
    """The EarthquakeStudy of nested dictionaries.  Raises StudyError."""
    study = typed(raw, EarthquakeStudy, StudyError)
    if study.motion not in MOTIONS:
        raise StudyError(f"motion is {study.motion!r}; allowed: {', '.join(MOTIONS)}")
    if study.rule is not None and study.coefficient is not None:
        raise StudyError("rule and coefficient are both given; give one of them")
    if study.coefficient is not None and not 0 < study.coefficient <= LARGEST_COEFFICIENT:
        raise StudyError(f"coefficient is {study.coefficient:g}; allowed: above 0, at most {LARGEST_COEFFICIENT:g}")
    if all(one is None for one in (study.record, study.spectrum, study.rule, study.coefficient)):
        raise StudyError("the earthquake is not defined; give one or more of [record], [spectrum] and [rule]")
    return study


def quake_of(study, folder=".", database=None):
    """`Quake` of a study whose files are in `folder` or have full paths.  Raises StudyError or EarthquakeError."""
    fender = pair_of(study.fender, fender_of(_one(study.fender)))
    if not 0 <= study.fender.clearance <= WIDEST:
        raise StudyError(f"fender.clearance is {study.fender.clearance:g} m; allowed: 0 to {WIDEST:g}")
    fenders = Fenders(fender, study.fender.count, study.fender.clearance)
    floater = _floater(study, database)
    coefficient = study.coefficient
    if study.rule is not None:
        try:
            coefficient = seismic_coefficient(study.rule.rule, **study.rule.factors)
        except ValueError as error:
            raise StudyError(f"rule: {error}") from None
    spectrum = None if study.spectrum is None else _spectrum(study.spectrum)
    ratio = 0.05 if study.spectrum is None else study.spectrum.damping_ratio
    ground = None if study.record is None else _ground(study.record, Path(folder))
    return Quake(study.motion, floater, fenders, ground, spectrum, ratio, coefficient)


def _one(table):
    """The table of one fender"""
    import msgspec

    if not 1 <= table.count <= 1000:
        raise StudyError(f"fender.count is {table.count}; allowed: 1 to 1000 on each side")
    return msgspec.structs.replace(table, count=1)


def _floater(study, database):
    if (study.body is None) == (database is None):
        state = "neither is given" if database is None else "both are given"
        raise StudyError(f"[body] and --database: {state}; give one of them")
    if database is None:
        body = study.body
        for name in ("added_mass", "damping"):
            if not 0 <= getattr(body, name) < math.inf:
                raise StudyError(f"body.{name} is {getattr(body, name):g}; allowed: 0 or more, finite")
        return Floater(1e3 * positive("body.mass", body.mass), 1e3 * body.added_mass, 1e3 * body.damping)
    from hakobune.bem.time_domain.memory import memory_of_database

    db, i = database_of(database), MOTIONS.index(study.motion)
    memory = memory_of_database(db, 3e-3, (i,))
    a, b, c = memory.matrices
    mass = float(db.reader.floating().inertia[i, i])
    return Floater(mass, float(memory.added_mass_infinity[i, i]), 0.0, a, b[:, i], c[i])


def _spectrum(table):
    T, S = np.array(table.periods, float), np.array(table.acceleration, float)
    if len(T) < 2 or T.shape != S.shape:
        raise StudyError(
            f"spectrum has {len(T)} periods and {len(S)} accelerations; allowed: the same number, at least 2"
        )
    if not (np.all(np.isfinite(T)) and T[0] > 0 and np.all(np.diff(T) > 0)):
        raise StudyError("spectrum.periods are not increasing; allowed: s, above 0, increasing")
    if not (np.all(S > 0) and np.all(S <= STRONGEST)):
        wrong = S[np.argmax(~((S > 0) & (S <= STRONGEST)))]
        raise StudyError(f"spectrum.acceleration has {wrong:g}; allowed: above 0, at most {STRONGEST:g} m/s²")
    below("spectrum.damping_ratio", table.damping_ratio, 0.5)

    def at(period):
        if period > T[-1]:
            raise EarthquakeError(
                f"the natural period on the fenders is {period:.3g} s, and the spectrum ends at {T[-1]:g} s; "
                f"extend the spectrum"
            )
        return np.interp(period, T, S)

    return at


def _ground(table, folder):
    from hakobune.mooring.environment.logger_files import read_table
    from hakobune.mooring.environment.tables import TableError, check_even

    path = folder / table.file
    try:
        names, values, lines = read_table(path)
    except TableError as error:
        raise StudyError(str(error)) from None
    names = [name.strip() for name in names or ()]
    known = [name for name in names if name in COLUMNS]
    if "time_s" not in names or len(known) != 1:
        raise StudyError(
            f"{path} has {'the columns ' + ', '.join(names) if names else 'no column names in its first row'}; "
            f"allowed: time_s and one of {', '.join(COLUMNS)}; rename them"
        )
    if not 0 <= table.after <= LONGEST:
        raise StudyError(f"record.after is {table.after:g} s; allowed: 0 to {LONGEST:g}")
    scale = positive("record.scale", table.scale) * COLUMNS[known[0]]
    time, shaken = values[:, names.index("time_s")], scale * values[:, names.index(known[0])]
    try:
        check_even(path, time, UNEVEN, lines)
    except TableError as error:
        raise StudyError(str(error)) from None
    try:
        return ground_of_record(time, shaken, table.after)
    except EarthquakeError as error:
        raise StudyError(f"{path}: {error}") from None
