"""A response study: a body of a database in one sea, or in a climate, as typed TOML.

    [sea]                           or   [climate]
    spectrum = "issc"                    scatter = "scatter.csv"     # beside the study
    height = 4.5                         spectrum = "issc"
    mean_period = 10.0                   years = 50
    incidence_deg = 60.0                 directions = [{ direction_deg = 0, share = 1.0 }]
    spreading = "cosine:4"

    [body]
    damping_ratio = { roll = 0.02 }      # of critical, beyond radiation
    viscous = { roll = "Yamashita" }     # or laws as in a scene, linearised in the sea; not in a climate

    [[points]]
    name = "bow"
    position = [50.0, 0.0, 10.0]
    clearance = 8.0                      # m above still water, what has to stay dry

Directions have either `direction_deg`, travelled to, or `incidence_deg`, the angle χ of the reports, 0 from ahead.
"""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

import msgspec
import numpy as np

from bem import DOFS
from bem.viscous_table import Laws

from ..common.quantities import StudyError, Table, direction, positive
from ..common.seas import family_of, shape_of, spreading_of
from ..common.typed import read_toml, typed


class SeaTable(Table):
    """height : m, significant; one period (s); direction_deg travelled to, or incidence_deg; duration_hours of it"""

    height: float
    spectrum: str = "issc"
    mean_period: float | None = None
    zero_crossing_period: float | None = None
    energy_period: float | None = None
    peak_period: float | None = None
    significant_period: float | None = None
    gamma: float | None = None
    direction_deg: float | None = None
    incidence_deg: float | None = None
    spreading: str | None = None
    duration_hours: float = 3.0


class DirectionTable(Table):
    """share of the time with waves of this direction"""

    share: float
    direction_deg: float | None = None
    incidence_deg: float | None = None


class ClimateTable(Table):
    """scatter : CSV file beside the study; years : return period of the extremes"""

    scatter: str
    directions: list[DirectionTable]
    spectrum: str = "issc"
    gamma: float | None = None
    spreading: str | None = None
    years: float = 50.0


class PointTable(Table):
    """position : m, x, y, z; clearance : m above still water of what has to stay dry"""

    name: str
    position: tuple[float, float, float]
    clearance: float | None = None


class BodyTable(Table):
    """damping_ratio : of critical, by motion, beyond radiation; damping, stiffness : 6 × 6 in SI units, added

    viscous : damping that grows with the motion
    """

    viscous: Laws | None = None
    damping_ratio: dict[str, float] = msgspec.field(default_factory=dict)
    damping: list[list[float]] | None = None
    stiffness: list[list[float]] | None = None


class ResponseStudy(Table):
    """Either a sea or a climate"""

    sea: SeaTable | None = None
    climate: ClimateTable | None = None
    body: BodyTable = msgspec.field(default_factory=BodyTable)
    points: list[PointTable] = msgspec.field(default_factory=list)

    def restrained(self, body):
        """A Body with the damping and stiffness of the study"""
        body = body.restrained(_matrix("damping", self.body.damping), _matrix("stiffness", self.body.stiffness))
        return body.restrained(damping=damping_of("body", self.body.damping_ratio, body))

    def places(self):
        """Points of the study"""
        from mooring.response.points import Point

        twice = [name for name, count in Counter(point.name for point in self.points).items() if count > 1]
        if twice:
            raise StudyError(f"two points are called {twice[0]!r}; give each a name of its own")
        for i, point in enumerate(self.points):
            if not all(map(math.isfinite, point.position)):
                raise StudyError(f"points[{i}].position is {list(point.position)}; allowed: finite, m")
            if point.clearance is not None:
                positive(f"points[{i}].clearance", point.clearance)
        return [Point(point.name, point.position, point.clearance) for point in self.points]


def read_response_study(path):
    """The ResponseStudy of a TOML file and its text.  Raises StudyError."""
    raw, text = read_toml(path, "a study", StudyError)
    study = typed(raw, ResponseStudy, StudyError)
    if (study.sea is None) == (study.climate is None):
        state = "has neither" if study.sea is None else "has both"
        raise StudyError(f"{path} {state} [sea] and [climate]; allowed: one of them")
    return study, text


def sea_of(table):
    """The Sea of a SeaTable.  Raises ValueError."""
    from mooring.environment.periods import KINDS
    from mooring.environment.sea import Sea

    periods = {kind: getattr(table, kind) for kind in KINDS if getattr(table, kind) is not None}
    spectrum = family_of("sea", table)(positive("sea.height", table.height), **shape_of(table), **periods)
    return Sea(spectrum, direction("sea", table), spreading_of("sea", table, spectrum))


def damping_of(where, ratios, body):
    """(6, 6) SI of ratios {motion: of critical} of a Body.  Raises StudyError."""
    extra, names = np.zeros((6, 6)), [dof.lower() for dof in DOFS]
    for name, ratio in ratios.items():
        if name not in names:
            raise StudyError(f"{where}.damping_ratio.{name} is unknown; allowed: {', '.join(names)}")
        if not 0 <= ratio < 1:
            raise StudyError(f"{where}.damping_ratio.{name} is {ratio:g}; allowed: 0 to 1")
        mode = names.index(name)
        extra[mode, mode] = ratio * body.critical_damping(mode)
    return extra


def climate_of(table, beside):
    """Arguments of `mooring.response.climate.climate` after the body; `beside` is the path of the study."""
    from mooring.environment.scatter import read_scatter

    positive("climate.years", table.years)
    named = [(f"climate.directions[{i}]", entry) for i, entry in enumerate(table.directions)]
    spreading = None if table.spreading is None else lambda spectrum: spreading_of("climate", table, spectrum)
    return dict(
        scatter=read_scatter(Path(beside).parent / table.scatter),
        family=family_of("climate", table),
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
