"""Row types of the tables of a MoorDyn file, one for each section, with the names of its columns.

MoorDyn 2.7 documentation, "Inputs" (moordyn.readthedocs.io).  Values keep MoorDyn's units.
"""

from typing import NamedTuple

# kinds of attachment of a point, rod or body, in lower case
FIXED = ("fixed", "fix", "anchor")
COUPLED = ("coupled", "cpld", "vessel", "ves", "fairlead")
FREE = ("free", "connect", "con", "point")


def finite_number(word):
    """A finite number, also with Fortran's exponent; None for anything else"""
    try:
        value = float(word.lower().replace("d", "e"))
    except ValueError:
        return None
    return value if abs(value) < float("inf") else None


class LineTypeRow(NamedTuple):
    """diameter : m; mass : kg/m; EA, BA : number, a|b, or the name of a file"""

    name: str
    diameter: float
    mass: float
    EA: str
    BA: str
    EI: str = "0"
    Cd: float = 0.0
    Ca: float = 0.0
    CdAx: float = 0.0
    CaAx: float = 0.0
    Cl: float | None = None
    dF: float | None = None
    cF: float | None = None


class RodTypeRow(NamedTuple):
    name: str
    diameter: float
    mass: float
    Cd: float = 0.0
    Ca: float = 0.0
    CdEnd: float = 0.0
    CaEnd: float = 0.0


class BodyRow(NamedTuple):
    """x0 … yaw0 : m and degrees; mass : kg; CG, inertia, CdA, Ca : number, or numbers joined by |; volume : m³"""

    id: str
    attachment: str
    x0: float
    y0: float
    z0: float
    roll0: float
    pitch0: float
    yaw0: float
    mass: float
    CG: str
    inertia: str
    volume: float
    CdA: str
    Ca: str


def early_body(words):
    """Put entries into the order of BodyRow; they come in the order of draft versions of v2, which MoorPy still writes

    BodyID X0 Y0 Z0 r0 p0 y0 Xcg Ycg Zcg M V IX IY IZ, then CdA and Ca of one or three numbers. The attachment
    follows the body's number, as in 1Coupled; a number alone means a floating body.  Other rows are returned
    unchanged.
    """
    drag = {17: 1, 19: 3, 21: 3}.get(len(words))
    if drag is None:
        return words
    number = words[0].rstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ")
    parts = words[7:10], words[12:15], words[15 : 15 + drag], words[15 + drag :]
    centre, inertia, CdA, Ca = ("|".join(part) for part in parts)
    return [number, words[0][len(number) :] or "Free", *words[1:7], words[10], centre, inertia, words[11], CdA, Ca]


class RodRow(NamedTuple):
    id: str
    type: str
    attachment: str
    xa: float
    ya: float
    za: float
    xb: float
    yb: float
    zb: float
    segments: int
    outputs: str = "-"


class PointRow(NamedTuple):
    """position : m; mass : kg; volume : m³; CdA : m²"""

    id: str
    attachment: str
    x: float
    y: float
    z: float
    mass: float = 0.0
    volume: float = 0.0
    CdA: float = 0.0
    Ca: float = 0.0


class LineRow(NamedTuple):
    """a, b : points (or ends of rods) at the anchor and at the fairlead; length : unstretched length, m"""

    id: str
    type: str
    a: str
    b: str
    length: float
    segments: int
    outputs: str = "-"


class FailureRow(NamedTuple):
    id: str
    point: str
    lines: str
    time: float
    tension: float


class Section(NamedTuple):
    """Heading, row type (None for a section that is not a table), columns as written, {further name of a column:
    field}
    """

    title: str
    words: tuple[str, ...]  # any of these in the heading
    row: type | None
    columns: tuple[tuple[str, str], ...]  # (name, unit) of each column, as written
    aliases: dict[str, str]  # further names of columns, lower case → field


OPTIONAL = ("Cl", "dF", "cF", "outputs")  # columns a row may lack

SECTIONS = {
    "line_types": Section(
        "LINE TYPES",
        ("LINE TYPES", "LINE DICTIONARY", "LINE TYPE"),
        LineTypeRow,
        (
            ("TypeName", "(name)"),
            ("Diam", "(m)"),
            ("Mass/m", "(kg/m)"),
            ("EA", "(N)"),
            ("BA/-zeta", "(N-s/-)"),
            ("EI", "(N-m^2)"),
            ("Cd", "(-)"),
            ("Ca", "(-)"),
            ("CdAx", "(-)"),
            ("CaAx", "(-)"),
            ("Cl", "(-)"),
            ("dF", "(-)"),
            ("cF", "(-)"),
        ),
        {
            "name": "name",
            "linetype": "name",
            "massden": "mass",
            "massdeninair": "mass",
            "ba": "BA",
            "cintdamp": "BA",
            "cdn": "Cd",
            "can": "Ca",
            "cdt": "CdAx",
            "cat": "CaAx",
        },
    ),
    "rod_types": Section(
        "ROD TYPES",
        ("ROD TYPES", "ROD DICTIONARY", "ROD TYPE"),
        RodTypeRow,
        (
            ("TypeName", "(name)"),
            ("Diam", "(m)"),
            ("Mass/m", "(kg/m)"),
            ("Cd", "(-)"),
            ("Ca", "(-)"),
            ("CdEnd", "(-)"),
            ("CaEnd", "(-)"),
        ),
        {"name": "name", "rodtype": "name", "massden": "mass"},
    ),
    "bodies": Section(
        "BODIES",
        ("BODIES", "BODY LIST", "BODY PROPERTIES"),
        BodyRow,
        (
            ("ID", "(#)"),
            ("Attachment", "(-)"),
            ("X0", "(m)"),
            ("Y0", "(m)"),
            ("Z0", "(m)"),
            ("r0", "(deg)"),
            ("p0", "(deg)"),
            ("y0", "(deg)"),
            ("Mass", "(kg)"),
            ("CG*", "(m)"),
            ("I*", "(kg-m^2)"),
            ("Volume", "(m^3)"),
            ("CdA*", "(m^2)"),
            ("Ca*", "(-)"),
        ),
        {},
    ),
    "rods": Section(
        "RODS",
        ("RODS", "ROD LIST", "ROD PROPERTIES"),
        RodRow,
        (
            ("ID", "(#)"),
            ("RodType", "(name)"),
            ("Attachment", "(-)"),
            ("Xa", "(m)"),
            ("Ya", "(m)"),
            ("Za", "(m)"),
            ("Xb", "(m)"),
            ("Yb", "(m)"),
            ("Zb", "(m)"),
            ("NumSegs", "(-)"),
            ("RodOutputs", "(-)"),
        ),
        {},
    ),
    "points": Section(
        "POINTS",
        ("POINTS", "POINT LIST", "POINT PROPERTIES", "CONNECTION PROPERTIES", "CONNECTIONS", "NODE PROPERTIES"),
        PointRow,
        (
            ("ID", "(#)"),
            ("Attachment", "(-)"),
            ("X", "(m)"),
            ("Y", "(m)"),
            ("Z", "(m)"),
            ("Mass", "(kg)"),
            ("Volume", "(m^3)"),
            ("CdA", "(m^2)"),
            ("Ca", "(-)"),
        ),
        {
            "node": "id",
            "point": "id",
            "connection": "id",
            "type": "attachment",
            "attach": "attachment",
            "m": "mass",
            "v": "volume",
            "vol": "volume",
        },
    ),
    "lines": Section(
        "LINES",
        ("LINES", "LINE LIST", "LINE PROPERTIES"),
        LineRow,
        (
            ("ID", "(#)"),
            ("LineType", "(name)"),
            ("AttachA", "(#)"),
            ("AttachB", "(#)"),
            ("UnstrLen", "(m)"),
            ("NumSegs", "(-)"),
            ("LineOutputs", "(-)"),
        ),
        {
            "line": "id",
            "type": "type",
            "nodea": "a",
            "nodeb": "b",
            "nodeanch": "a",
            "nodefair": "b",
            "numnodes": "segments",
            "enda": "a",
            "endb": "b",
            "flags/outputs": "outputs",
            "outputs": "outputs",
            "outs": "outputs",
        },
    ),
    "failures": Section(
        "FAILURE",
        ("FAILURE",),
        FailureRow,
        (("FailureID", "(#)"), ("Point", "(#)"), ("Line(s)", "(#)"), ("FailTime", "(s)"), ("FailTen", "(N)")),
        {},
    ),
    "syrope": Section("SYROPE IC", ("SYROPE",), None, (), {}),
    "control": Section("CONTROL", ("CONTROL",), None, (), {}),
    "external": Section("EXTERNAL LOADS", ("EXTERNAL LOADS",), None, (), {}),
    "options": Section("OPTIONS", ("OPTIONS",), None, (), {}),
    "outputs": Section("OUTPUTS", ("OUTPUTS", "OUTPUT"), None, (), {}),
}
