"""States of weather and levels of a site in the form of studies. The period of waves is the median of the joint
distribution, as a mean period."""

from pathlib import Path
from typing import NamedTuple

import numpy as np

from hakobune.mooring.environment.allowed import positive, within
from hakobune.mooring.environment.current_profile import power_law, wind_drift
from hakobune.mooring.site.water import levels, tsunami_current

from ..common.quantities import StudyError


class Climate(NamedTuple):
    """law : `JointLaw` of the scatter; height, period : (n,) m, s, the contour of the law; top : m, s, the top of the
    contour; hours : duration of a sea"""

    scatter: object
    law: object
    height: object
    period: object
    top: tuple
    hours: float


def climate_of(table, years, folder, findings):
    """Climate of a SiteClimateTable; its findings are added to `findings`.  Raises StudyError."""
    from hakobune.mooring.environment.scatter import read_scatter
    from hakobune.mooring.site.contours import joint_law

    scatter = read_scatter(Path(folder) / table.scatter)
    try:
        law = joint_law(scatter)
        height, period = law.contour(years, positive("climate.hours", table.hours, "h"))
    except ValueError as error:
        raise StudyError(f"climate: {error}") from None
    top = law.top(years, table.hours)
    if top[0] > law.highest:
        findings.append(
            f"the contour of {years:.4g} years reaches {top[0]:.3g} m, the scatter ends at {law.highest:g} m: "
            "above that height the joint distribution is an extrapolation"
        )
    return Climate(scatter, law, height, period, top, table.hours)


def profile_of(study, wind_10):
    """CurrentProfile along x of the current, None for water at rest"""
    if study.current is None:
        return None
    own, depth = study.current, study.site.depth
    profile = power_law(within("current.speed", own.speed, 0.0, 20.0, "m/s"), 0.0, depth, own.exponent)
    if not own.wind_driven:
        return profile
    if wind_10 is None:
        raise StudyError("current.wind_driven is true and there is no [wind]; give [wind], or leave out wind_driven")
    return profile + wind_drift(wind_10, 0.0, depth)


def extreme_state(study, wind_10, waves, climate, profile):
    """Tables of the extreme state in the form of a mooring study.  Raises StudyError."""
    state = {}
    if wind_10 is not None:
        state["wind"] = {"speed": wind_10}
    if profile is not None:
        draft = study.current.draft
        if draft is None:
            state["current"] = {"speed": float(profile.velocity(0.0)[0])}
        else:
            within("current.draft", draft, 0.0, study.site.depth, "m")
            state["current"] = {"speed": profile.over_draft(draft)[0]}
    if waves is not None:
        if study.waves.period is None and climate is None:
            raise StudyError(
                "waves.period is missing; give a mean period in s, or [climate], whose joint "
                "distribution gives the period"
            )
        period = study.waves.period
        period = _mean_period(study, climate, waves.value) if period is None else positive("waves.period", period, "s")
        state["waves"] = {"height": waves.value, "period": period}
    elif climate is not None:
        state["waves"] = {"height": climate.top[0], "period": _mean_period(study, climate, climate.top[0])}
    return state


def _mean_period(study, climate, height):
    """T01 of the median period of the joint law in seas of a height"""
    from ..common.weather.seas import family_of

    family = family_of("climate", _Family(study.climate.spectrum), study.site.depth)
    period = float(np.exp(climate.law.log_period(height)[0]))
    return float(family(height, **{climate.law.period_kind: period}).T01)


class _Family(NamedTuple):
    spectrum: str
    gamma: None = None


def tsunami_state(table, depth):
    """Current a√(g/h) of a long wave whose elevation a is the deviation of a tsunami"""
    if table.tsunami is None:
        raise StudyError("levels.tsunami_period is given without levels.tsunami; give both, or neither")
    period = positive("levels.tsunami_period", table.tsunami_period, "s")
    return {"current": {"speed": tsunami_current(table.tsunami, period, depth)}}


def operating_state(table):
    """Tables of the operating state.  Raises StudyError."""
    state = {}
    for key in ("wind", "current"):
        if getattr(table, key) is not None:
            state[key] = {"speed": positive(f"operating.{key}", getattr(table, key), "m/s")}
    if (table.wave_height is None) != (table.wave_period is None):
        raise StudyError("operating has only one of wave_height and wave_period; give both or neither")
    if table.wave_height is not None:
        height = positive("operating.wave_height", table.wave_height, "m")
        state["waves"] = {"height": height, "period": positive("operating.wave_period", table.wave_period, "s")}
    return state


def levels_of(table, depth):
    """{name: m above mean water} of the tide, storms and tsunamis.  Raises StudyError."""
    if table is None:
        return {}
    return levels(table.spring_high, table.spring_low, table.surge, table.tsunami, depth)
