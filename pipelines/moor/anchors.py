"""Anchors of lines as tables of a study, and their results in quantities and in words.

[[anchors]]                [[anchors]]                 [[anchors]]
kind = "drag"              kind = "sinker"             kind = "pile"
type = "stockless"         friction = 0.5              holding_kN = 1500.0
soil = "sand"              weight_kN = 400.0           uplift_kN = 600.0
mass = 9000.0              lines = ["fore 1"]          safety = 2.0

For an anchor without mass or weight_kN the result has the size that its pull requires.
"""

import msgspec
import numpy as np

from hakobune.mooring.criteria.anchors import KINDS, Anchor, charts, holding_of

from ..common.quantities import StudyError, Table, below, positive
from ..results.quantity import Quantity

TABLE = "anchors at the largest pull"
LARGEST = 10.0  # safety factor
OF_KIND = {
    "drag": {"type", "soil", "mass", "holding_kN"},
    "sinker": {"friction", "weight_kN"},
    "pile": {"holding_kN", "uplift_kN", "girth", "length", "cohesion_kPa"},
}


class AnchorTable(Table):
    """The anchors of lines, of one kind and size

    kind : kind of anchor: "drag", "sinker" or "pile"
    lines : names of the lines with this anchor; by default all lines on the bed that no other table names
    safety : required factor of safety on the pull, above 0
    type : type of a drag anchor in the charts, such as "stockless", "Danforth", "Stevin", "Stevpris Mk6"
    soil : soil of a drag anchor in the charts: "mud", soft clay and silt; "sand", and stiff clay; or "medium clay"
    mass : kg, mass in air of a drag anchor in the charts; by default the size is computed
    holding_kN : horizontal capacity of a pile, or of a drag anchor that is not in the charts
    uplift_kN : uplift capacity of a pile
    friction : coefficient of friction between a sinker and the bed
    weight_kN : submerged weight of a sinker; by default the size is computed
    girth : m, girth of a friction pile, in place of uplift_kN
    length : m, length of a pile in the bed
    cohesion_kPa : cohesion of the soil along a pile
    """

    kind: str
    lines: list[str] = msgspec.field(default_factory=list)
    safety: float = 1.0
    type: str | None = None
    soil: str | None = None
    mass: float | None = None
    holding_kN: float | None = None
    uplift_kN: float | None = None
    friction: float | None = None
    weight_kN: float | None = None
    girth: float | None = None
    length: float | None = None
    cohesion_kPa: float | None = None


def anchors_of(tables, names, bollards=()):
    """[Anchor or None] of each line by name; bollards : names of lines that end at a bollard. Raises StudyError."""
    made = [_anchor(f"anchors[{i}]", table) for i, table in enumerate(tables)]
    found = {}
    for i, (table, one) in enumerate(zip(tables, made, strict=True)):
        for name in table.lines:
            if name not in names or name in bollards or name in found:
                state = "in two tables" if name in found else "on no anchor" if name in bollards else "unknown"
                allowed = ", ".join(other for other in names if other not in (*bollards, *found))
                raise StudyError(f"anchors[{i}].lines: {name!r} is {state}; allowed lines: {allowed or 'none is left'}")
            found[name] = one
    rest = [i for i, table in enumerate(tables) if not table.lines]
    if len(rest) > 1:
        raise StudyError(
            f"anchors[{rest[0]}] and anchors[{rest[1]}] have no lines; only one table may leave out lines, and "
            "it is for all other lines"
        )
    others = made[rest[0]] if rest else None
    return [None if name in bollards else found.get(name, others) for name in names]


def _anchor(where, table):
    if table.kind not in KINDS:
        raise StudyError(f"{where}.kind is {table.kind!r}; allowed: {', '.join(KINDS)}")
    every = set().union(*OF_KIND.values())
    given = [key for key in table.__struct_fields__ if key in every and getattr(table, key) is not None]
    for key in given:
        if key not in OF_KIND[table.kind]:
            own = ", ".join(name for name in table.__struct_fields__ if name in OF_KIND[table.kind])
            raise StudyError(f"{where}.{key} is given with kind = {table.kind!r}; allowed keys: {own}")
        if key not in ("type", "soil"):
            positive(f"{where}.{key}", getattr(table, key))
    return {"drag": _drag, "sinker": _sinker, "pile": _pile}[table.kind](
        where, table, below(f"{where}.safety", table.safety, LARGEST)
    )


def _drag(where, table, safety):
    if table.holding_kN is not None:
        if table.type is not None or table.soil is not None or table.mass is not None:
            raise StudyError(f"{where}: give either holding_kN, or type, soil and mass for a chart")
        return Anchor("drag", 1e3 * table.holding_kN, safety=safety)
    known = {(name.lower(), soil): chart for (name, soil), chart in charts().items()}
    name, soil = (table.type or "").lower(), (table.soil or "").lower()
    if (name, soil) not in known:
        soils = ", ".join(one for other, one in known if other == name)
        allowed = f"soil {soils}" if soils else f"type {', '.join(dict.fromkeys(one for one, _ in charts()))}"
        lacks = " and ".join(key for key in ("type", "soil") if getattr(table, key) is None)
        what = f"without {lacks}" if lacks else f"of type {table.type!r} in soil {table.soil!r}"
        raise StudyError(
            f"{where}: there is no chart for a drag anchor {what}; allowed: {allowed}; or give holding_kN; mud is "
            f"soft clay and silt, and sand stands for stiff clay too"
        )
    chart = known[name, soil]
    holding = np.nan if table.mass is None else holding_of(chart, table.mass)
    return Anchor("drag", holding, chart=chart, safety=safety)


def _sinker(where, table, safety):
    if table.friction is None:
        raise StudyError(
            f"{where}.friction is missing; give the friction coefficient of the sinker on the bed, above 0"
        )
    weight = np.nan if table.weight_kN is None else 1e3 * table.weight_kN
    return Anchor("sinker", weight=weight, friction=table.friction, safety=safety)


def _pile(where, table, safety):
    skin = table.girth, table.length, table.cohesion_kPa
    if table.holding_kN is None:
        raise StudyError(f"{where}.holding_kN is missing; give the horizontal capacity of the pile, kN")
    if (None in skin) == (table.uplift_kN is None) or (table.uplift_kN is not None and any(skin)):
        raise StudyError(f"{where}: give either uplift_kN, or girth, length and cohesion_kPa of the pile")
    uplift = table.uplift_kN if table.uplift_kN is not None else skin[0] * skin[1] * skin[2]
    return Anchor("pile", 1e3 * table.holding_kN, 1e3 * uplift, safety=safety)


def quantities_of_anchors(anchors, along, up):
    """{name: Quantity} over the lines: capacity, utilisation and required size of anchors at pulls (n,) N; {}
    without anchors
    """
    if all(one is None for one in anchors):
        return {}
    rows = list(zip(anchors, along, up, strict=True))
    of_kind = {  # required size or capacity, NaN for other kinds
        kind: np.array([np.nan if one is None or one.kind != kind else one.needed(h, v) for one, h, v in rows], float)
        for kind in KINDS
    }
    columns = {
        "holding": ("N", "horizontal capacity", _of(rows, lambda one, h, v: one.capacity(v))),
        "used": ("", "used", _of(rows, lambda one, h, v: one.used(h, v))),
        "needed_mass": ("kg", "needed, drag anchor", of_kind["drag"]),
        "needed_weight": ("N", "needed, sinker in water", of_kind["sinker"]),
    }
    return {
        f"anchor.{name}": Quantity(values, ("line",), unit, words, TABLE, share=name == "used")
        for name, (unit, words, values) in columns.items()
        if np.any(np.isfinite(values))
    }


def _of(rows, of):
    """Values (n,) of (Anchor, along, up) rows, nan without an anchor"""
    return np.array([np.nan if row[0] is None else of(*row) for row in rows], float)
