"""`hakobune.site`: design values of a site, from its measurements and rules."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..common.quantities import StudyError
from ..common.typed import typed
from ..results.given import File, Tables, given
from ..results.provenance import provenance
from ..results.quantity import Quantity
from ..results.result import Result, labels
from .study import SiteStudy, SiteValues, read_site, site_values


class Site(NamedTuple):
    """study : SiteStudy; and the text of the study and its SiteValues"""

    study: SiteStudy
    text: str
    values: SiteValues


def site(study: File | Tables | SiteStudy) -> Result:
    """Return period, extremes, levels and seismic coefficient of a site.

    study : path of a site, its tables as a dictionary, or a `pipelines.site.study.SiteStudy`
    returns : Result, in SI; its `detail` is a Site
    raises : ValueError, with a message of one line
    """
    read, text = given(study, SiteStudy, read_site, lambda raw: typed(raw, SiteStudy, StudyError))
    values = site_values(read, Path(study).parent if isinstance(study, str | os.PathLike) else Path())
    quantities, axes = _quantities(values)
    return Result(
        "site", quantities, axes, values.findings, provenance=provenance(text), detail=Site(read, text, values)
    )


def _quantities(values):
    """Quantities and the labels of their axes"""
    made = {
        "return_period": Quantity(float(values.years), (), "years", "return period", "site"),
        "probability": Quantity(
            values.probability, (), "", "probability not to be exceeded in the service life", "site", share=True
        ),
    }
    if values.seismic is not None:
        made["seismic"] = Quantity(float(values.seismic), (), "", "seismic coefficient", "site")
    for name, unit, one in (("wind", "m/s", values.wind), ("height", "m", values.waves)):
        if one is not None:
            words = "wind as measured" if name == "wind" else "significant height"
            table = "extremes and their interval" if one.fit is not None else ""
            rows = zip(("value", "low", "high"), (words, f"{words}, from", f"{words}, to"), strict=True)
            made |= {
                f"{name}.{part}": Quantity(float(getattr(one, part)), (), unit, said, table) for part, said in rows
            }
    if values.wind_10 is not None:
        made["wind.ten"] = Quantity(float(values.wind_10), (), "m/s", "wind of ten minutes at 10 m", "site")
    for state, tables in values.states.items():
        made |= {
            f"{state}.{table}.{key.removesuffix('_deg')}": _number(
                f"{table} {key.removesuffix('_deg')}", key, value, state
            )
            for table, numbers in tables.items()
            for key, value in numbers.items()
        }
    axes = {}
    if values.levels:
        heights = list(values.levels.values())
        made["level.height"] = Quantity(heights, ("level",), "m", "above still water", "water levels")
        axes |= labels("level", list(values.levels))
    if values.climate is not None:
        title = f"contour of {values.years:.4g} years"
        kind = values.climate.law.period_kind.replace("_", " ")
        made["contour.height"] = Quantity(values.climate.height, ("place",), "m", "significant height")
        made["contour.period"] = Quantity(values.climate.period, ("place",), "s", kind)
        height, period = values.climate.top
        made["contour.highest"] = Quantity(float(height), (), "m", "highest sea", title)
        made["contour.period_at_highest"] = Quantity(float(period), (), "s", f"its {kind}", title)
        axes |= labels("place", np.arange(1, len(values.climate.height) + 1))
    return made, axes


def _number(words, key, value, state):
    """Number of a key of a state: lengths in m, speeds in m/s, periods in s"""
    title = f"state {state}"
    if key.endswith("_deg"):
        return Quantity(np.radians(value), (), "rad", words, title)
    unit = "m/s" if "speed" in key else "s" if "period" in key else "m" if key == "height" else ""
    return Quantity(float(value), (), unit, words, title)
