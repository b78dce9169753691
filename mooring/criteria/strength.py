"""Strength of chain and rope: strength after wear, the smallest size for a load, the equipment number.

Chain loses diameter by wear and corrosion; break and proof loads are proportional to d² (44 − 0.08 d) of the
remaining diameter d (`lines.catalogue`).  SR179 report (1982), chapter 4, 2.2 and 3.1; equipment numbers table
4.3.1.  Terminations: TM 5-3810-305-10, table 4, for rope with steel or fibre core. The factor 0.86 for hand splices
holds at 13 mm; thicker rope loses more strength.
"""

import re

from ..lines.catalogue import CHAIN

SIZES = {  # mm, available sizes
    "chain": (*range(20, 100, 2), *range(100, 220, 5)),
    "rope": (*range(16, 64, 4), *range(64, 264, 8)),
}
TERMINATIONS = {  # remaining share of a wire rope's breaking load at its termination, the lower value of each kind
    "socket": 1.0, "swaged socket": 0.95, "sleeve": 0.925, "splice": 0.80, "wedge socket": 0.75, "clips": 0.80,
}  # fmt: skip
SOCIETIES = ("LR", "AB", "NV", "BV", "GL", "NK", "NK semisubmersible")


def chain_factor(diameter):
    """d² (44 − 0.08 d), mm²; breaking and proof loads of chain are multiples of this value"""
    return diameter**2 * (44 - 0.08 * diameter)


def worn_breaking_load(breaking_load, diameter, allowance, years):
    """Breaking load, N, of a chain that has lost `allowance` mm of its diameter (mm) in each of `years` years.

    raises : ValueError if less than half of the diameter remains
    """
    left = diameter - allowance * years
    if not (allowance >= 0 and years >= 0):
        raise ValueError(f"wear is {allowance:g} mm a year for {years:g} years; allowed: at least 0")
    if left < 0.5 * diameter:
        raise ValueError(
            f"wear of {allowance:g} mm a year leaves {left:.3g} mm of {diameter:g} mm after {years:g} years; allowed: "
            "at least half of the diameter"
        )
    return breaking_load * chain_factor(left) / chain_factor(diameter)


def larger_sizes(name, most):
    """Up to `most` catalogue names of the kind of `name`, in the next larger sizes."""
    kind, size = kind_and_size(name)
    made = SIZES["chain" if _is_chain(kind) else "rope"]
    return [f"{kind} {larger:g} mm" for larger in made if larger > size][:most]


def kind_and_size(name):
    """Kind and nominal diameter, mm, of a name of the catalogue: "R3 studless 76 mm" gives ("R3 studless", 76.0)"""
    kind, _, size = name.strip().removesuffix("mm").strip().rpartition(" ")
    return kind, float(size)


def equipment_number(society, displacement, *, height_times_breadth=0.0, front=0.0, side=0.0):
    """Equipment number of a class society for temporary mooring.

    displacement : Δ, t; height_times_breadth : B h, m² (AB, NK)
    front, side : projected areas above water, m², as the society defines them (for BV times their shape factors)
    raises : ValueError for a society without an equipment number
    """
    terms = {
        "LR": 2.5 * front + 0.1 * side,
        "AB": 2.0 * height_times_breadth + 0.1 * side,
        "NV": front,
        "BV": 2.0 * front + 0.1 * side,
        "GL": 2.5 * front,
        "NK": 2.0 * height_times_breadth + 0.1 * side,
        "NK semisubmersible": 2.0 * front + 0.1 * side,
    }
    if society not in terms:
        raise ValueError(f"society is {society!r}; allowed: {', '.join(SOCIETIES)}")
    if not displacement > 0:
        raise ValueError(f"displacement is {displacement:g} t; allowed: above 0")
    return displacement ** (2 / 3) + terms[society]


def equipment_of_box(dimensions, freeboard, mass):
    """[(society, number)] of a box, SR179 (1982), table 4.3.1; [] for other bodies, whose areas are unknown.

    dimensions : {"length", "beam", …}, m; freeboard : m, or None; mass : kg.
    The areas are those of the sides above water. BV's shape factors are taken as 1, the value of a plane below 40 m.
    """
    if freeboard is None or not {"length", "beam"} <= set(dimensions):
        return []
    front, side = dimensions["beam"] * freeboard, dimensions["length"] * freeboard
    areas = {"height_times_breadth": front, "front": front, "side": side}
    return [(society, equipment_number(society, mass / 1000.0, **areas)) for society in SOCIETIES]


def _is_chain(kind):
    words = re.sub(r"\b(grade|chain|studlink|studless)\b", "", kind.lower()).split()
    return len(words) == 1 and words[0] in CHAIN
