"""Steady force of wind or current on a hull of any shape, from its own coefficients.

    F_x = C_x q A_x,   F_y = C_y q A_y,   M_z = C_n q A_n L,   q = ½ρU²

Signs are those of the axes (x forward, y port, M_z turning the bow to port) and of the direction in which the stream
goes. It equals the angle of OCIMF, Mooring Equipment Guidelines (2nd edition, 1997), which is counted anticlockwise
from the stern.  OCIMF writes q as ρ V²/7600 in kN for V in knots, which takes a knot as 0.5130 m/s.
"""

import csv
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hakobune.meshing.text_files import read_text

from .box_drag import check_positive, stream_pressure
from .smooth import smooth

LARGEST = 8  # MB
SIZES = ("area_x", "area_y", "area_n", "length", "height")
OPTIONAL = ("area_n", "height")
COLUMNS = (("angle", "CX", "CY", "CN"), ("angle", "CX", "CYA", "CYF"))


@dataclass(frozen=True, eq=False)
class HullCoefficients:
    """angle : (n,) rad, from 0 to π or 2π; x, y, n : coefficients, (n,); reference areas, m², and length, m.

    With angles up to π, the hull is symmetric port and starboard: C_x even in the angle, C_y and C_n odd.
    height : height of the point of action above still water, m, None if unknown
    notes : on the origin of the numbers, one line each
    """

    angle: np.ndarray
    x: np.ndarray
    y: np.ndarray
    n: np.ndarray
    area_x: float
    area_y: float
    area_n: float
    length: float
    height: float | None = None
    notes: tuple[str, ...] = ()

    @cached_property
    def curve(self):
        """Callable: (…) rad from 0 to 2π → (…, 3) C_x, C_y, C_n; monotone cubics with a continuous slope all round"""
        angle, values = self.angle, np.column_stack([self.x, self.y, self.n])
        if angle[-1] < 1.5 * np.pi:
            angle = np.concatenate([angle, 2 * np.pi - angle[-2::-1]])
            values = np.concatenate([values, (values * (1, -1, -1))[-2::-1]])
        before, after = slice(-4, -1), slice(1, 4)
        angle = np.concatenate([angle[before] - 2 * np.pi, angle, angle[after] + 2 * np.pi])
        return smooth(angle, np.concatenate([values[before], values, values[after]]))


def hull_coefficients(angle, x, y, n, *, area_x, area_y, length, area_n=None, height=None, notes=()):
    """Checked HullCoefficients; area_n, for the moment, is area_y by default.  Raises ValueError."""
    columns = [np.asarray(v, float) for v in (angle, x, y, n)]
    sizes = [v.shape for v in columns]
    if len(set(sizes)) != 1 or len(sizes[0]) != 1 or sizes[0][0] < 4:
        raise ValueError(
            f"hull coefficients have shapes {sizes}; allowed: lists of the same length, at least four values"
        )
    if not np.all(np.isfinite(columns)):
        raise ValueError("hull coefficients are not all finite numbers")
    area_n = area_y if area_n is None else area_n
    check_positive(area_x=area_x, area_y=area_y, area_n=area_n, length=length)
    if height is not None and not np.isfinite(height):
        raise ValueError(f"height is {height:g}; allowed: finite, m above still water")
    columns = [v[np.argsort(columns[0])] for v in columns]
    _check_angles(columns)
    return HullCoefficients(*columns, float(area_x), float(area_y), float(area_n), float(length), height, notes)


def hull_force(coefficients, speed, direction, density):
    """Forces F_x, F_y, N, and moment M_z, N m, amidships; shape (…, 3).

    speed : (…) m/s; direction : direction of flow, (…) rad; density : kg/m³
    """
    pressure = stream_pressure("stream", speed, density)
    c = coefficients
    scale = np.array([c.area_x, c.area_y, c.area_n * c.length])
    return np.asarray(pressure)[..., None] * c.curve(np.mod(direction, 2 * np.pi)) * scale


def shallow_coefficient(deep, draft, depth, exponent=2.0, grounded=3.2):
    """Broadside current coefficient of a ship, referred to L T, in water of `depth` m, from the coefficient in deep
    water.

        C = C₀ + (C₁ − C₀) (T/d)^K    UFC 4-159-03, Design: Moorings (2005), eq. 11

    exponent : K, 2 for most ships and barges; grounded : C₁ at T/d = 1, 3.2 up to a current of 1.5 m/s
    """
    check_positive(deep=deep, draft=draft, exponent=exponent)
    if not draft <= depth:
        raise ValueError(f"depth is {depth:g} m; allowed: at least the draft {draft:g} m")
    if not deep <= grounded:
        raise ValueError(
            f"the coefficient in deep water is {deep:g}; allowed: at most the coefficient at T/d = 1, {grounded:g}"
        )
    return deep + (grounded - deep) * (draft / depth) ** exponent


def read_hull_coefficients(path):
    """HullCoefficients of a CSV file.

    Lines `# name = number` give area_x, area_y, length and, if the moment has another area, area_n, in m² and m; `#
    height = number` is the point of action, m above still water.  Other lines that begin with # are remarks. Then a
    header and rows, the angle in degrees, 0 to 180 or 0 to 360:

        angle,CX,CY,CN          yaw moment on area_n·length; CXY is another name for CN
        angle,CX,CYA,CYF        OCIMF: lateral force at the aft and forward perpendicular, `length` apart

    With OCIMF's current coefficients all areas are length times draft.
    raises : ValueError naming the file, the line or the value
    """
    lines = read_text(path, largest=LARGEST).splitlines()
    try:
        sizes, columns = _sizes(lines), _columns(lines)
        lateral, moment = _lateral(columns, sizes)
        return hull_coefficients(np.deg2rad(columns["angle"]), columns["CX"], lateral, moment, **sizes)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _check_angles(columns):
    """Raises ValueError unless the angles span 180° or 360° and the values at the ends agree."""
    angle, _, y, n = columns
    half, whole = abs(angle[-1] - np.pi) < 1e-9, abs(angle[-1] - 2 * np.pi) < 1e-9
    if not (np.all(np.diff(angle) > 0) and abs(angle[0]) < 1e-9 and (half or whole)):
        first, last = np.rad2deg(angle[[0, -1]])
        raise ValueError(
            f"hull coefficient angles run from {first:g}° to {last:g}°; allowed: rising, 0 to 180° or 360°"
        )
    for name, values in (("y", y), ("n", n)):
        if half and (values[0] != 0 or values[-1] != 0):
            raise ValueError(
                f"hull coefficient {name} is {values[0]:g} at 0°, {values[-1]:g} at 180°; allowed: 0, or angles to 360°"
            )
    if whole and any(abs(v[0] - v[-1]) > 1e-9 for v in columns[1:]):
        raise ValueError("hull coefficients at 0° and 360° differ; allowed: the same")


def _sizes(lines):
    """{name: number} of the lines `# name = number`"""
    sizes = {}
    for number, line in enumerate(lines, 1):
        name, equals, value = (part.strip() for part in line.lstrip("# ").partition("="))
        if line.startswith("#") and equals and name in SIZES:
            sizes[name] = _number(number, value)
    missing = [name for name in SIZES if name not in sizes and name not in OPTIONAL]
    if missing:
        raise ValueError(f"{missing[0]} is not given; allowed: a line `# {missing[0]} = 818.0`, in m² or m")
    return sizes


def _columns(lines):
    """{name: (n,)} of the rows, named as in one of COLUMNS"""
    rows = [(i, line) for i, line in enumerate(lines, 1) if line.strip() and not line.startswith("#")]
    table = [(i, [cell.strip() for cell in next(csv.reader([line]))]) for i, line in rows]
    names = ["CN" if name == "CXY" else name for name in table[0][1]] if table else []
    if sorted(names) not in [sorted(allowed) for allowed in COLUMNS]:
        shown = " or ".join(",".join(allowed) for allowed in COLUMNS)
        raise ValueError(f"columns are {','.join(names) or 'missing'}; allowed: {shown}")
    for i, row in table[1:]:
        if len(row) != len(names):
            raise ValueError(f"line {i} has {len(row)} values; allowed: {len(names)}")
    return {name: np.array([_number(i, row[j]) for i, row in table[1:]]) for j, name in enumerate(names)}


def _number(line, text):
    try:
        return float(text)
    except ValueError:
        raise ValueError(f"line {line}: {text!r} is not a number") from None


def _lateral(columns, sizes):
    """C_y, C_n; from forces at the perpendiculars, half a length from amidships, if these are given"""
    if "CY" in columns:
        return columns["CY"], columns["CN"]
    aft, forward = columns["CYA"], columns["CYF"]
    return forward + aft, 0.5 * (forward - aft) * sizes["area_y"] / sizes.get("area_n", sizes["area_y"])
