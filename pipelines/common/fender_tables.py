"""A fender as a table of a study file or as flags, with equal names in both."""

import math
from pathlib import Path

import msgspec
import numpy as np

from hakobune.mooring.criteria.failing import fails
from hakobune.mooring.fenders.dolphin import bilinear, in_series
from hakobune.mooring.fenders.families import fender_of_family, fender_of_file
from hakobune.mooring.fenders.inclined import inclined
from hakobune.mooring.fenders.variability import bands, chosen, extremes

from .quantities import StudyError, Table, below, one_of, positive
from .units import TONF

LARGEST = 20.0  # m, a height or diameter
WIDEST = 50.0  # m, largest width under an inclined face
MOST = 1000  # fenders side by side
RATED = {"rated_reaction": 1e3, "rated_reaction_kN": 1e3, "rated_reaction_tonf": TONF}  # N
BATCH = ("manufacture",)  # causes of scatter within a batch: 0.9 to 1.1, Ueda (1981), section 6


class FenderTable(Table):
    """A fender of a generic family or by a maker's table, and the dolphin behind the fender

    family : generic family: cell, v, h, cone, foam, tyre or pneumatic; or give table, as for π and cylindrical fenders
    table : CSV file of the maker beside the study, with deflection and reaction
    height : m, height in the direction of compression; the diameter of a pneumatic fender
    length : m, length along the quay
    rated_reaction : kN, reaction at the rated deflection, in place of the family's rated reaction
    rated_reaction_kN, rated_reaction_tonf : rated reaction with the unit in the name of the key
    pressure : kPa, initial pressure of a pneumatic fender
    overload : kN/m, stiffness beyond the last deflection of the curve
    rated_strain : rated deflection over height, with a maker's table
    allowable_strain : allowable deflection over height, with a maker's table
    return_length : m, deflection over which a fender with a maker's table falls back to its unloading curve
    count : number of fenders side by side, 1 to 1000
    factor : factor on the reaction
    causes : causes of scatter between the softest and the stiffest fender: manufacture, ageing, velocity, repetition,
        temperature; by default all
    angle_deg : inclination of the face that presses the fender, 0 to 45
    width : m, width of the inclined face across the inclination; by default `length`, where it is given
    dolphin : kN/m, stiffness of the dolphin behind the fender; by default rigid
    dolphin_yield : kN, force at which the dolphin yields or the ground softens
    dolphin_beyond : kN/m, stiffness of the dolphin beyond dolphin_yield
    """

    height: float
    family: str | None = None
    table: str | None = None
    length: float | None = None
    rated_reaction: float | None = None
    rated_reaction_kN: float | None = None
    rated_reaction_tonf: float | None = None
    pressure: float | None = None
    overload: float | None = None
    rated_strain: float | None = None
    allowable_strain: float | None = None
    return_length: float | None = None
    count: int = 1
    factor: float = 1.0
    causes: list[str] | None = None
    angle_deg: float = 0.0
    width: float | None = None
    dolphin: float | None = None
    dolphin_yield: float | None = None
    dolphin_beyond: float | None = None


def with_tables_in(raw, folder):
    """Nested dictionaries of a study whose fenders have their tables in a folder, with full paths"""

    def placed(one):
        return one | {"table": str(Path(folder) / one["table"])} if isinstance(one.get("table"), str) else one

    given = raw.get("fender")
    if isinstance(given, dict):
        return raw | {"fender": placed(given)}
    if isinstance(given, list):
        return raw | {"fender": [placed(one) if isinstance(one, dict) else one for one in given]}
    return raw


def fender_of(table, where="fender"):
    """`mooring.fenders.fender.Fender` of a FenderTable without its dolphin.  Raises ValueError, with a message of
    one line."""
    below(f"{where}.height", table.height, LARGEST)
    if (table.family is None) == (table.table is None):
        state = "neither is given" if table.family is None else "both are given"
        raise StudyError(f"{where}: family and table: {state}; give one of them")
    if not 1 <= table.count <= MOST:
        raise StudyError(f"{where}.count is {table.count}; allowed: 1 to {MOST}")
    factor = positive(f"{where}.factor", table.factor) * table.count
    made = _inclined(table, where, _of_family(table, where) if table.family is not None else _of_file(table, where))
    return made.times(factor, f"{table.count} × {made.name}" if table.count > 1 else None)


def upright(table):
    """The FenderTable of the fender under a face without inclination"""
    return msgspec.structs.replace(table, angle_deg=0.0, width=None)


def _inclined(table, where, fender):
    if table.angle_deg == 0:
        if table.width is not None:
            raise StudyError(
                f"{where}.width is {table.width:g} m but angle_deg is missing; the width applies to an inclined face "
                f"only"
            )
        return fender
    width = table.width if table.width is not None else table.length
    if width is None:
        raise StudyError(
            f"{where}.angle_deg is {table.angle_deg:g} without a width; give the width of the panel, m (for a cell "
            "fender the width of the flange, 1.1 to 1.3 times the height)"
        )
    return inclined(fender, below(f"{where}.width", width, WIDEST), math.radians(table.angle_deg))


def pair_of(table, fender, where="fender"):
    """The fender of a FenderTable in series with its dolphin; without a dolphin the fender alone.  Raises
    ValueError."""
    if table.dolphin is None:
        if table.dolphin_yield is not None or table.dolphin_beyond is not None:
            raise StudyError(
                f"{where}: dolphin_yield or dolphin_beyond is given without dolphin, the stiffness in kN/m"
            )
        return fender
    if (table.dolphin_yield is None) != (table.dolphin_beyond is None):
        raise StudyError(f"{where}: only one of dolphin_yield and dolphin_beyond is given; give both or neither")
    yields = np.inf if table.dolphin_yield is None else 1e3 * table.dolphin_yield
    beyond = None if table.dolphin_beyond is None else 1e3 * table.dolphin_beyond
    return in_series(fender, bilinear(1e3 * positive(f"{where}.dolphin", table.dolphin), yields, beyond))


def causes_of(table):
    """Bands within which the reaction of a fender varies; for pneumatic fenders only ±10 % by manufacture is known
    (SR179, 3.3.2)
    """
    if table.causes is not None:
        if not table.causes:
            raise StudyError(
                f"fender.causes is empty; give one or more of {', '.join(bands())}, or leave causes out for all"
            )
        return table.causes
    return ["manufacture"] if table.family == "pneumatic" else list(bands())


def softest_and_stiffest(table, fender, causes=None):
    """Two fenders at the ends of the bands of `mooring.fenders.variability`, on the dolphin, and their factors

    causes : names of the bands, by default all bands of the fender
    """
    factors = extremes(chosen(causes or causes_of(table)))
    return tuple(pair_of(table, fender.times(factor)) for factor in factors), factors


def on_dolphin(pair):
    """Whether the support of a fender is elastic"""
    return bool(pair.own(pair.limit) < pair.limit)


def beyond_batch(what, energy, table, fender):
    """A message if an energy, J, exceeds the capacity of the softest fender of a batch at its rated strain

    what : name of the energy; fender : the fender from `fender_of`, without its dolphin
    """
    (soft, _), (factor, _) = softest_and_stiffest(table, fender, BATCH)
    if energy > soft.rated_energy * (1 + 1e-9):
        rated = pair_of(table, fender).rated_energy
        yield fails(
            f"{what}: {energy / 1e3:.4g} kJ are {100 * energy / soft.rated_energy:.4g} % of the "
            f"{soft.rated_energy / 1e3:.4g} kJ that the softest fender of a batch absorbs at its rated strain "
            f"({factor:g} times the catalogue's reaction; Ueda 1981, section 6), and {100 * energy / rated:.4g} % of "
            f"the energy in the catalogue; choose a larger fender or more fenders"
        )


def _kilo(value):
    return None if value is None else 1e3 * value


def _of_family(table, where):
    for key in ("rated_strain", "allowable_strain", "return_length"):
        if getattr(table, key) is not None:
            raise StudyError(
                f"{where}.{key} is given with a family, which already defines it; give it only with a table"
            )
    return fender_of_family(
        table.family,
        table.height,
        length=table.length,
        rated_reaction=one_of(where, table, RATED),
        pressure=_kilo(table.pressure),
        overload=_kilo(table.overload),
    )


def _of_file(table, where):
    for key in ("length", *RATED, "pressure"):
        if getattr(table, key) is not None:
            raise StudyError(f"{where}.{key} is given with a table of the manufacturer; this key is for a family")
    return fender_of_file(
        table.table,
        table.height,
        rated=table.rated_strain,
        allowable=table.allowable_strain,
        overload=_kilo(table.overload),
        return_length=table.return_length,
    )
