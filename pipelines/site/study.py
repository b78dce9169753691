"""What is known of a site, as typed TOML, and the values a mooring has to stand there.

    R = 1/(1 − q^(1/T))                       return period from service life T and probability q
    U₁₀ = U(h, 10 min)/C_H(h)                 after the mean over another time became one of 10 minutes
    high = spring tide + surge,  tsunami high, low = spring tide ± tsunami

SR179 report (1982), chapter 4, sections 3.2 to 3.10.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import msgspec

from hakobune.mooring.environment.allowed import positive
from hakobune.mooring.environment.current_profile import CurrentProfile
from hakobune.mooring.environment.tables import column_of, read_table
from hakobune.mooring.environment.wind_profile import TEN_MINUTES, speed_10
from hakobune.mooring.response.return_period import probability_not_exceeded, return_period
from hakobune.mooring.site.extremes import Extreme, extreme
from hakobune.mooring.site.seismic import seismic_coefficient

from ..common.quantities import StudyError, Table, water_depth
from ..common.typed import read_toml, typed
from .states import Climate, climate_of, extreme_state, levels_of, operating_state, profile_of, tsunami_state


class PlaceTable(Table):
    """The place, and how rare a value has to be

    name : for results
    depth : m, at mean water
    service_life : years
    probability : that the extreme state is not exceeded in them; or give return_period
    return_period : years; or give probability
    confidence : of the intervals of return values
    """

    name: str
    depth: float
    service_life: float
    probability: float | None = None
    return_period: float | None = None
    confidence: float = 0.9


class MaximaTable(Table):
    """Yearly maxima

    maxima : one a year; or give file
    file : CSV beside the site; or give maxima
    column : of the file, by default its last
    family : gumbel, weibull or gev
    """

    maxima: list[float] | None = None
    file: str | None = None
    column: str | None = None
    family: str = "gumbel"


class SiteWindTable(MaximaTable, kw_only=True):
    """Wind of the extreme state, from yearly maxima in m/s or given

    speed : m/s at height, in place of maxima
    averaging_s : s, over which maxima or speed are means
    height : m above the sea, where they are measured
    exponent : of the profile; by default the report's table
    heights : m, of the profile that the page shows
    """

    speed: float | None = None
    averaging_s: float = TEN_MINUTES
    height: float = 10.0
    exponent: float | None = None
    heights: list[float] = msgspec.field(default_factory=list)


class SiteWavesTable(MaximaTable, kw_only=True):
    """Waves of the extreme state, from yearly maxima of the significant height in m or given

    height : m, significant, in place of maxima
    period : s, mean, with the extreme height; without, the median of [climate]
    """

    period: float | None = None
    height: float | None = None


class SiteClimateTable(Table):
    """All seas of the place: their joint law, and the contour of the return period

    scatter : CSV file beside the site, as of a response study
    hours : that a sea lasts
    spectrum : by which its kind of period becomes a mean period
    """

    scatter: str
    hours: float = 3.0
    spectrum: str = "issc"


class SiteCurrentTable(Table):
    """Current in the extreme state

    speed : m/s at the surface, of tide and sea
    wind_driven : whether 0.01 of the wind is added
    exponent : of the profile (1 + z/h)^exponent of tide and sea; that of the wind has 1
    draft : m, over which studies have the uniform current of the same pressure; without, that of the surface
    depths : m below the surface, of the profile that the page shows
    """

    speed: float
    wind_driven: bool = False
    exponent: float = 1 / 7
    draft: float | None = None
    depths: list[float] = msgspec.field(default_factory=list)


class LevelsTable(Table):
    """Levels, m above mean water

    spring_high : mean high water of spring tides
    spring_low : mean low water of spring tides
    surge : largest deviation by storms
    tsunami : largest deviation by tsunamis, up and down
    tsunami_period : s; with it a state "tsunami" has the current of a long wave of that deviation
    """

    spring_high: float = 0.0
    spring_low: float = 0.0
    surge: float | None = None
    tsunami: float | None = None
    tsunami_period: float | None = None


class EarthquakeTable(Table):
    """Seismic coefficient of a rule

    rule : A, C, E or F of the report
    factors : {name = value} of the rule
    """

    rule: str
    factors: dict[str, float]


class OperatingTable(Table):
    """Weather in which the place is used

    wind : m/s at 10 m, mean of 10 minutes
    current : m/s
    wave_height : m, significant
    wave_period : s, mean
    """

    wind: float | None = None
    current: float | None = None
    wave_height: float | None = None
    wave_period: float | None = None


class SiteStudy(Table):
    """A site: its measurements, levels and rules"""

    site: PlaceTable
    wind: SiteWindTable | None = None
    waves: SiteWavesTable | None = None
    climate: SiteClimateTable | None = None
    current: SiteCurrentTable | None = None
    levels: LevelsTable | None = None
    earthquake: EarthquakeTable | None = None
    operating: OperatingTable | None = None


class SiteValues(NamedTuple):
    """years : return period; probability : not exceeded in the service life; wind : as measured; waves : height

    climate : Climate, or None; wind_10 : m/s, ten minutes at 10 m; profile : `CurrentProfile` or None
    levels : {name: m}; states : tables by name as studies have them; seismic : coefficient or None
    findings : lines that a reader has to know
    """

    years: float
    probability: float
    wind: Extreme | None
    wind_10: float | None
    waves: Extreme | None
    climate: Climate | None
    profile: CurrentProfile | None
    levels: dict
    states: dict
    seismic: float | None
    findings: tuple[str, ...]


def read_site(path):
    """SiteStudy of a TOML file and its text.  Raises StudyError."""
    raw, text = read_toml(path, "a site", StudyError)
    return typed(raw, SiteStudy, StudyError), text


def site_values(study, folder):
    """SiteValues of a SiteStudy; folder : of its files.  Raises ValueError, one line."""
    own, findings = study.site, []
    water_depth("site.depth", own.depth)
    if (own.probability is None) == (own.return_period is None):
        raise StudyError("site: allowed: one of probability, return_period")
    try:
        years = own.return_period or float(return_period(own.service_life, own.probability))
        probability = float(probability_not_exceeded(own.service_life, years))
    except ValueError as error:
        raise StudyError(f"site: {error}") from None
    quake = study.earthquake
    try:
        seismic = None if quake is None else seismic_coefficient(quake.rule, **quake.factors)
    except ValueError as error:
        raise StudyError(f"earthquake: {error}") from None
    wind = _extreme("wind", study.wind, "speed", years, own.confidence, folder, findings)
    waves = _extreme("waves", study.waves, "height", years, own.confidence, folder, findings)
    own_wind = study.wind
    wind_10 = None if wind is None else speed_10(wind.value, own_wind.averaging_s, own_wind.height, own_wind.exponent)
    climate = None if study.climate is None else climate_of(study.climate, years, folder, findings)
    profile = profile_of(study, wind_10)
    states = {"extreme": extreme_state(study, wind_10, waves, climate, profile)}
    if study.operating is not None:
        states["operating"] = operating_state(study.operating)
    for name, state in states.items():
        if not state:
            raise StudyError(f"the {name} state has no wind, current or waves; allowed: at least one")
    levels = levels_of(study.levels, own.depth)
    if study.levels is not None and study.levels.tsunami_period is not None:
        states["tsunami"] = tsunami_state(study.levels, own.depth)
    return SiteValues(
        years, probability, wind, wind_10, waves, climate, profile, levels, states, seismic, tuple(findings)
    )


def _extreme(where, table, given, years, confidence, folder, findings):
    if table is None:
        return None
    sources = [key for key in (given, "maxima", "file") if getattr(table, key) is not None]
    if len(sources) != 1:
        state = " and ".join(sources) + " are given" if sources else "nothing is given"
        raise StudyError(f"{where}: {state}; allowed: one of {given}, maxima, file")
    if sources == [given]:
        value = positive(f"{where}.{given}", getattr(table, given), "")
        return Extreme(value, value, value, None)
    try:
        found, said = extreme(_maxima(table, folder), table.family, years, confidence)
    except ValueError as error:
        raise StudyError(f"{where}: {error}") from None
    findings.extend(f"{where}: {line}" for line in said)
    return found


def _maxima(table, folder):
    if table.maxima is not None:
        return table.maxima
    names, values = read_table(Path(folder) / table.file)
    column = -1 if table.column is None else column_of(table.file, names, table.column)
    return values[:, column]
