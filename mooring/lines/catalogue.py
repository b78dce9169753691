"""Chain, wire and fibre rope by name: `line_type("R3 studless 76 mm")` → LineType.

Chain, d in mm, loads in kN:  break = c_b d² (44 − 0.08 d),  proof = c_p d² (44 − 0.08 d)

    grades 1 to 3      IACS UR A1 and W18; grade 3 is NK's of the SR179 report (1982), table 4.2.2.1
    ORQ                API 2F, same table
    R3 to R5           IACS UR W22 and DNV-OS-E302, with studless proof loads at 0.70 of the break load
    mass               0.0219 d² kg/m studlink, 0.0200 d² studless, 0.02288 d² ORQ
    modulus over both bars   5.6e10 N/m² studlink; studless R3 (5.40 − 0.0040 d)e10, R4 (5.45 − 0.0025 d)e10,
                       R5 (6.00 − 0.0033 d)e10, DNV-OS-E301 (2013) ch. 2 sec. 2; R3S has that of R3, R4S that of R4

Wire:  break = K d² R / 1000 kN, mass = W d² / 100 kg/m, EN 12385-4 (2002), 6x24 with its seven fibre cores ISO 2408
(2004) as makers quote it; R is the strength of the wires, 1370 to 1960 N/mm² by class societies, JIS G 3525 E 1320,
G 1470, A 1620, B 1770 N/mm² (its own 6x24 A break with 0.304 d² R, a twelfth more, by a maker's table); modulus over
the nominal circle 7.0e10 N/m² six strands, 1.13e11 spiral strand, DNV-OS-E301. Fibre rope and the loads of spiral
strand: coefficients fitted to makers' catalogues as published with NREL's mooring property library (MoorPy, 2021 to
2024). Stiffness is quasi-static, a multiple of the breaking load.
The submerged weight is the weight of the material less its own
buoyancy; water fills the gaps.

Drag: coefficients on the nominal diameter from DNV-OS-E301 (2013) ch. 2 sec. 2, which gives none along ropes. Added
mass along a chain is 0.5 of its displaced water, as in NREL's library.
"""

import re
from typing import NamedTuple

import numpy as np

from .system.parts import LineDynamics, LineSystemError, LineType

STEEL = 7850.0  # kg/m³
FIBRE_BELOW = 2000.0  # kg/m³; polyester has 1380, steel 7850
KGF = 9.80665e-3  # kN
CHAIN_SIZES = (10.0, 220.0)  # mm, range of the formulas
ROPE_SIZES = (1.0, 500.0)  # mm: no rope is made outside this range


class ChainGrade(NamedTuple):
    """Loads, kN, over d² (44 − 0.08 d) with d in mm; proof loads of studlink and of studless chain, None where not
    made
    """

    breaking: float
    proof_studlink: float
    proof_studless: float | None
    modulus_studless: tuple[float, float] | None  # N/m² and its loss per mm


CHAIN = {
    "1": ChainGrade(1.0 * KGF, 0.7 * KGF, None, None),
    "2": ChainGrade(1.4 * KGF, 1.0 * KGF, None, None),
    "3": ChainGrade(2.0 * KGF, 1.4 * KGF, None, None),
    "orq": ChainGrade(2.153 * KGF, 1.428 * KGF, None, None),
    "r3": ChainGrade(0.0223, 0.0156, 0.0156, (5.40e10, 0.0040e10)),
    "r3s": ChainGrade(0.0249, 0.0180, 0.0174, (5.40e10, 0.0040e10)),
    "r4": ChainGrade(0.0274, 0.0216, 0.0192, (5.45e10, 0.0025e10)),
    "r4s": ChainGrade(0.0304, 0.0240, 0.0213, (5.45e10, 0.0025e10)),
    "r5": ChainGrade(0.0320, 0.0251, 0.0223, (6.00e10, 0.0033e10)),
}
# drag coefficients over the nominal diameter, across and along the line
CHAIN_DRAG = {"studlink": (2.6, 1.4), "studless": (2.4, 1.15)}
STRANDED, SPIRAL, FIBRE_DRAG = 1.8, 1.6, 1.6
WIRE = {  # construction and core: K, W
    ("6x7", "fc"): (0.332, 0.345),
    ("6x7", "iwrc"): (0.359, 0.384),
    ("6x19", "fc"): (0.330, 0.359),
    ("6x19", "iwrc"): (0.356, 0.400),
    ("6x24", "fc"): (0.280, 0.318),
    ("6x36", "fc"): (0.330, 0.367),
    ("6x36", "iwrc"): (0.356, 0.409),
}
WIRE_STRENGTH = (1320, 1370, 1420, 1470, 1570, 1620, 1670, 1770, 1960, 2160)  # N/mm²
JIS = {"e": 1320, "g": 1470, "a": 1620, "b": 1770}  # N/mm², of JIS G 3525


class Fibre(NamedTuple):
    """Mass, kg/m, over d²; breaking load, N, over d² and d³ (d in m); EA over the breaking load; density, kg/m³"""

    mass: float
    breaking_2: float
    breaking_3: float
    stiffness: float
    density: float


FIBRE = {
    "polyester": Fibre(679.0, 308e6, 0.0, 14.0, 1380.0),
    "nylon": Fibre(585.0, 207e6, 230e6, 5.0, 1140.0),
    "hmpe": Fibre(496.0, 580e6, 651e6, 56.0, 975.0),
}
FORMS = (
    "R3|R3S|R4|R4S|R5 studlink|studless 76 mm",
    "grade 1|2|3 76 mm",
    "ORQ 76 mm",
    "wire 6x7|6x19|6x24|6x36 FC|IWRC [1370|1470|1570|1770|1960|2160|E|G|A|B] 60 mm",
    "spiral strand 90 mm",
    "polyester|nylon|HMPE 160 mm",
)


def fibre_lines(system):
    """Names of the lines of a System with a part of fibre rope: a material lighter than `FIBRE_BELOW`"""
    for name, line in zip(system.line_names, system.lines, strict=True):
        kinds = [line.type] if hasattr(line, "type") else [one.kind for one in getattr(line, "segments", ())]
        if any(kind and kind.mass and kind.diameter and _material(kind) < FIBRE_BELOW for kind in kinds):
            yield name


def _material(kind):
    return kind.mass / (0.25 * np.pi * kind.diameter**2)


def unread(name):
    """Properties of a catalogue name that were not checked against its standard, '' if all were checked"""
    if not name or "6x24" not in name.lower().split():
        return ""
    return (
        f"{name}: K 0.280 and W 0.318 are quoted by makers from ISO 2408 (2004) and were not checked in the "
        "standard; check there, or give weight and breaking load of the maker's certificate"
    )


def line_type(name, density=1025.0, gravity=9.80665) -> LineType:
    """The LineType of a name such as "R4 studlink 84 mm" or "wire 6x36 IWRC 1960 52 mm".

    density : density of the water for the submerged weight, kg/m³
    raises : LineSystemError with the known names
    """
    found = re.fullmatch(r"(.+?)\s+([0-9.]+)\s*mm", name.strip().lower())
    if not found:
        raise _unknown(name)
    words = found[1].replace("stud link", "studlink").replace("stud less", "studless").replace("chain", "").split()
    try:
        d = float(found[2])
    except ValueError:
        raise _unknown(name) from None
    if words[:1] == ["grade"]:
        words = words[1:]
    if words and words[0] in CHAIN:
        made = _chain(name, words, d)
    elif words[:1] == ["wire"]:
        made = _wire(name, words[1:], d)
    elif words == ["spiral", "strand"]:
        made = _steel(5293e-6 * d**2, 1022.0 * d**2, 1.13e5 * np.pi / 4 * d**2, (SPIRAL,))
    elif len(words) == 1 and words[0] in FIBRE:
        made = _fibre(FIBRE[words[0]], d)
    else:
        raise _unknown(name)
    mass, material, breaking, proof, stiffness, drag = made
    if not ROPE_SIZES[0] <= d <= ROPE_SIZES[1]:
        raise LineSystemError(f"{name}: the size is {d:g} mm; allowed: {ROPE_SIZES[0]:g} to {ROPE_SIZES[1]:g}")
    diameter = float(np.sqrt(4 * mass / (np.pi * material)))
    return LineType(
        name.strip(),
        weight=mass * gravity * (1 - density / material),
        axial_stiffness=stiffness,
        mass=mass,
        diameter=diameter,
        breaking_load=breaking,
        proof_load=proof,
        dynamics=_dynamics(1e-3 * d / diameter, *drag),
        source="hakobune.mooring.lines.catalogue",
    )


def _dynamics(ratio, across, along=None):
    """LineDynamics of drag coefficients on a nominal diameter, `ratio` times that of the displaced volume

    along : as across, of chain; None for ropes
    """
    if along is None:
        return LineDynamics(drag_normal=across * ratio)
    return LineDynamics(across * ratio, along * ratio / np.pi, added_mass_tangential=0.5)


def _chain(name, words, d):
    grade = CHAIN[words[0]]
    kinds = ("studlink", "studless") if grade.modulus_studless else ("studlink",)
    kind = words[1] if len(words) > 1 else "studlink" if len(kinds) == 1 else ""
    if kind not in kinds or len(words) > 2:
        raise LineSystemError(f"chain {name!r}: after the grade comes {' or '.join(kinds)}, then the size in mm")
    if not CHAIN_SIZES[0] <= d <= CHAIN_SIZES[1]:
        raise LineSystemError(
            f"chain {name!r}: the size is {d:g} mm; allowed: {CHAIN_SIZES[0]:g} to {CHAIN_SIZES[1]:g}"
        )
    size = 1e3 * d * d * (44 - 0.08 * d)  # N per kN coefficient
    proof = grade.proof_studlink if kind == "studlink" else grade.proof_studless
    if kind == "studless":
        modulus = grade.modulus_studless[0] - grade.modulus_studless[1] * d
        mass = 0.0200 * d * d
    else:
        modulus, mass = 5.6e10, (0.02288 if words[0] == "orq" else 0.0219) * d * d
    return mass, STEEL, grade.breaking * size, proof * size, modulus * np.pi / 2 * (1e-3 * d) ** 2, CHAIN_DRAG[kind]


def _wire(name, words, d):
    strength = 1770
    if words and (words[-1].isdigit() or words[-1] in JIS):
        strength, words = JIS.get(words[-1]) or int(words[-1]), words[:-1]
    if tuple(words) not in WIRE or strength not in WIRE_STRENGTH:
        known = ", ".join(sorted({" ".join(key).upper().replace("X", "x") for key in WIRE}))
        raise LineSystemError(
            f"wire {name!r}: allowed: {known}, and a strength of "
            f"{', '.join(map(str, WIRE_STRENGTH))} N/mm², or E, G, A, B"
        )
    K, W = WIRE[tuple(words)]
    return _steel(0.01 * W * d * d, K * d * d * strength, 7.0e4 * np.pi / 4 * d * d, (STRANDED,))


def _steel(mass, breaking, stiffness, drag):
    return mass, STEEL, breaking, None, stiffness, drag


def _fibre(fibre, d):
    m = 1e-3 * d
    breaking = fibre.breaking_2 * m**2 + fibre.breaking_3 * m**3
    return fibre.mass * m**2, fibre.density, breaking, None, fibre.stiffness * breaking, (FIBRE_DRAG,)


def _unknown(name):
    return LineSystemError(f"{name!r} is not in the catalogue; allowed: {'; '.join(FORMS)}")
