"""Conversion of a breakwater study to values of `mooring.studies.breakwater`, in SI."""

import math

from hakobune.mooring.studies.breakwater.anchors import Anchors, Holding, Pile, Sinker
from hakobune.mooring.studies.breakwater.breakwater import KN, TONNE, Body, Breakwater, Lines, Section, Water, Waves

from ..common.weather.seas import sea_of
from .study import periods

SIZES = {"kN_per_m3": KN, "t_per_m": TONNE, "kN_per_m": KN, "kPa": KN, "kN": KN}


def breakwater_of(study):
    """The `Breakwater` of a BreakwaterStudy.  Raises ValueError for impossible bodies and lines."""
    sea, waves = study.sea, study.waves
    return Breakwater(
        Water(**_si(study.water)),
        Section(**_si(study.section)),
        Waves(waves.height, periods(study), math.radians(waves.obliquity_deg)),
        None if study.body is None else Body(**_si(study.body)),
        None if study.lines is None else Lines(**_si(study.lines)),
        None if sea is None else sea_of("sea", sea, math.radians(sea.obliquity_deg), study.water.depth),
        0.0 if sea is None else 3600 * sea.duration_hours,
        tuple(study.holdings),
        tuple(study.theories),
        (study.design.holding, study.design.theory),
        None if study.loss is None else study.loss.coefficient,
    )


def anchors_of(study):
    """The `Anchors` of a study"""
    made = {"sinker": Sinker, "common_sinker": Sinker, "pile": Pile, "holding": Holding}
    tables = {key: getattr(study.anchors, key) for key in made}
    return Anchors(**{key: made[key](**_si(table)) for key, table in tables.items() if table is not None})


def ranges_of(asked):
    """{"draft", "width", "angle_deg": (from, to)} of an OptimisationTable"""
    given = {key: getattr(asked, key) for key in ("draft", "width", "angle_deg")}
    return {key: ends for key, ends in given.items() if ends is not None}


def changing(breakwater):
    """Function that gives the `Breakwater` with given values, named as in `ranges_of`"""

    def changed(angle_deg=None, **sizes):
        return breakwater.changed(**sizes, angle=None if angle_deg is None else math.radians(angle_deg))

    return changed


def _si(table):
    """{name without its unit: value in SI} of a table"""
    made = {}
    for key in table.__struct_fields__:
        value, name = getattr(table, key), key
        for unit, size in SIZES.items():
            if name == key and key.endswith(f"_{unit}"):
                name, value = key.removesuffix(f"_{unit}"), None if value is None else value * size
        made[name] = value
    if "angle_deg" in made:
        made["angle"] = math.radians(made.pop("angle_deg"))
    return made
