"""Equipment numbers of the class societies for a project's body: Table 4.3.1 of SR179 (1982), for temporary mooring."""

from __future__ import annotations

from mooring.criteria.strength import SOCIETIES, equipment_number


def equipment(dimensions, freeboard, mass):
    """[(society, number)] of a box; [] of another body, whose areas are not known.

    dimensions : m, {"length", "beam", …}; freeboard m; mass kg
    The areas are those of its sides above water; the shape factors of BV are those of a plane below 40 m, 1.
    """
    if freeboard is None or not {"length", "beam"} <= set(dimensions):
        return []
    front, side = dimensions["beam"] * freeboard, dimensions["length"] * freeboard
    areas = {"height_times_breadth": front, "front": front, "side": side}
    return [(society, equipment_number(society, mass / 1000.0, **areas)) for society in SOCIETIES]
