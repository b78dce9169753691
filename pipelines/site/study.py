"""Measurements of a site, as typed TOML, and the design values of a mooring there.

    R = 1/(1 − q^(1/T))                       return period from service life T and probability q
    U₁₀ = U(h, 10 min)/C_H(h)                 after conversion of the averaging time to 10 minutes
    high = spring tide + surge,  tsunami high, low = spring tide ± tsunami

SR179 report (1982), chapter 4, sections 3.2 to 3.10.
"""

from pathlib import Path
from typing import NamedTuple

import msgspec

from hakobune.mooring.environment.allowed import positive
from hakobune.mooring.environment.current_profile import CurrentProfile
from hakobune.mooring.environment.logger_files import read_table
from hakobune.mooring.environment.tables import column_of
from hakobune.mooring.environment.wind_profile import TEN_MINUTES, speed_10
from hakobune.mooring.response.return_period import probability_not_exceeded, return_period
from hakobune.mooring.seas.breaking import SATURATED
from hakobune.mooring.site.extremes import Extreme, extreme
from hakobune.mooring.site.seismic import seismic_coefficient

from ..common.quantities import StudyError, Table, water_depth
from ..common.typed import read_toml, typed
from .states import Climate, climate_of, extreme_state, levels_of, operating_state, profile_of, tsunami_state


class PlaceTable(Table):
    """The place and the probability or return period of its extreme values

    name : name of the place in results
    depth : m, water depth at mean water
    service_life : years, service life of the structure
    probability : probability that the extreme state is not exceeded during the service life; or give return_period
    return_period : years, return period of the extreme state; or give probability
    confidence : confidence level of the intervals of return values
    """

    name: str
    depth: float
    service_life: float
    probability: float | None = None
    return_period: float | None = None
    confidence: float = 0.9


class MaximaTable(Table):
    """Yearly maxima

    maxima : list of maxima, one for each year; or give file
    file : CSV file of maxima beside the site; or give maxima
    column : name of the column in the file; by default the last
    family : distribution that is fitted: gumbel, weibull or gev
    """

    maxima: list[float] | None = None
    file: str | None = None
    column: str | None = None
    family: str = "gumbel"


class SiteWindTable(MaximaTable, kw_only=True):
    """Wind of the extreme state: given, or computed from yearly maxima in m/s

    speed : m/s, speed at `height`, in place of maxima
    averaging_s : s, averaging time of the maxima or of the speed
    height : m, height above the sea of the maxima or of the speed
    exponent : exponent of the wind profile; by default the table of the SR179 report
    heights : m, heights of the wind profile that is reported
    """

    speed: float | None = None
    averaging_s: float = TEN_MINUTES
    height: float = 10.0
    exponent: float | None = None
    heights: list[float] = msgspec.field(default_factory=list)


class SiteWavesTable(MaximaTable, kw_only=True):
    """Waves of the extreme state: given, or computed from yearly maxima of the significant height in m

    height : m, significant height, in place of maxima
    period : s, mean period at the extreme height; by default the median of [climate]
    """

    period: float | None = None
    height: float | None = None


class SiteClimateTable(Table):
    """Wave scatter of the place, its joint distribution of height and period, and the contour of the return period

    scatter : CSV file of the scatter table beside the site, as in a response study
    hours : h, duration of a sea
    spectrum : spectrum that converts the period of the scatter table to a mean period
    """

    scatter: str
    hours: float = 3.0
    spectrum: str = "issc"


class SiteCurrentTable(Table):
    """Current in the extreme state

    speed : m/s, surface speed of the tidal and ocean current
    wind_driven : whether a current of 0.01 times the wind speed is added
    exponent : exponent of the profile (1 + z/h)^exponent of tidal and ocean current; for the wind-driven current it
        is 1
    draft : m, draft of the hull: studies then use the uniform current with the same force over this draft; by
        default they use the surface speed
    depths : m, depths below the surface of the current profile that is reported
    """

    speed: float
    wind_driven: bool = False
    exponent: float = 1 / 7
    draft: float | None = None
    depths: list[float] = msgspec.field(default_factory=list)


class LevelsTable(Table):
    """Water levels in m above mean water

    spring_high : m, mean high water of spring tides
    spring_low : m, mean low water of spring tides
    surge : m, largest storm surge
    tsunami : m, largest rise and fall of the water level in a tsunami
    tsunami_period : s, period of the tsunami; it adds a state "tsunami", with the current of a long wave of the
        height `tsunami`
    """

    spring_high: float = 0.0
    spring_low: float = 0.0
    surge: float | None = None
    tsunami: float | None = None
    tsunami_period: float | None = None


class EarthquakeTable(Table):
    """Seismic coefficient from a rule of the SR179 report

    rule : letter of the rule: A, C, E or F
    factors : {name = value} of the factors in the rule
    """

    rule: str
    factors: dict[str, float]


class OperatingTable(Table):
    """Weather of the operating state

    wind : m/s, ten-minute mean wind speed at 10 m
    current : m/s, current speed
    wave_height : m, significant wave height
    wave_period : s, mean wave period
    """

    wind: float | None = None
    current: float | None = None
    wave_height: float | None = None
    wave_period: float | None = None


class SiteStudy(Table):
    """Measurements, water levels and rules of a site"""

    site: PlaceTable
    wind: SiteWindTable | None = None
    waves: SiteWavesTable | None = None
    climate: SiteClimateTable | None = None
    current: SiteCurrentTable | None = None
    levels: LevelsTable | None = None
    earthquake: EarthquakeTable | None = None
    operating: OperatingTable | None = None


class SiteValues(NamedTuple):
    """years : return period; probability : that the extreme state is not exceeded in the service life
    wind : wind as measured; waves : wave height
    climate : Climate, or None; wind_10 : ten-minute mean wind speed at 10 m, m/s; profile : `CurrentProfile` or None
    levels : {name: m}; states : {name: tables as in studies}; seismic : seismic coefficient or None
    findings : one line each
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
    """SiteStudy of a TOML file, and the text of the file.  Raises StudyError."""
    raw, text = read_toml(path, "a site", StudyError)
    return typed(raw, SiteStudy, StudyError), text


def site_values(study, folder):
    """SiteValues of a SiteStudy; folder : folder of its files.  Raises ValueError, with a message of one line."""
    own, findings = study.site, []
    water_depth("site.depth", own.depth)
    if (own.probability is None) == (own.return_period is None):
        raise StudyError("site: give one of probability and return_period")
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
    findings.extend(_breaking(states, own.depth + max(levels.get("high", 0.0), 0.0)))
    return SiteValues(
        years, probability, wind, wind_10, waves, climate, profile, levels, states, seismic, tuple(findings)
    )


def _breaking(states, deepest):
    """One line each on states whose waves are higher than water of `deepest` m, at high water, carries"""
    for name, state in states.items():
        height = state["waves"]["height"] if "waves" in state else 0.0
        if height > SATURATED * deepest:
            yield (
                f"{name}: significant height is {height:.4g} m in {deepest:.4g} m of water at high water; "
                f"breaking limits seas to {SATURATED:g} of the depth; give at most {SATURATED * deepest:.3g} m"
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
    names, values, _ = read_table(Path(folder) / table.file)
    column = -1 if table.column is None else column_of(table.file, names, table.column)
    return values[:, column]
