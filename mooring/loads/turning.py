"""Force of the water on a box in slow motion with drift angle and yaw rate.

    F_x = −C_x ½ρ L d V² − (M + m_y) v r,   F_y = C_y ½ρ L d V² + (M + m_x) u r,   M_z = C_m ½ρ L² d V²
    u = V cos β,   v = −V sin β,   r' = r L / V

u, v are the velocity of the box relative to the water in its own axes and r its yaw rate.  SR179 report (1982), section
2.3 (eq. 2.3.1, 2.3.2, tables 2.3.4.1–3: tests on a rotating arm) and eq. 3.6.8. The tests contain the inertia of the
turning model, which the terms with M + m subtract.  Signs are those required by this inertia and a yaw damping: A₂ of
C_y is about −2B/L, A₂ of C_m negative.

The polynomials in β are fits for |β| ≤ 60°.  Folding β into ±90°, as section 3.6 of the report does, makes C_x and C_m
discontinuous there.  A box with symmetry fore and aft and port and starboard has

    (C_x, C_y, C_m)(β + 180°, r') = (−C_x, −C_y, C_m)(β, r')
    (C_x, C_y, C_m)(−β, −r') = (C_x, −C_y, −C_m)(β, r')

so that each term A βⁿ r'ᵏ is even or odd about β = 90°.  Up to 60° a term is used as printed. From 60° to 90° a
parabola continues its value and slope so that an odd term is 0 at 90° and an even term has zero slope there. Slopes
are continuous at all angles. For H/d = 1.2, C_x falls to −0.02 near 80°. A₀ of C_y and C_m is 0 for such a box and
is omitted.

Beyond the end of the tests, |r'| = 0.5, force and moment are those at 0.5. This makes a kink in r', but extrapolated
polynomials of r'⁴ would soon drive the box instead of damping it.
"""

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from hakobune.meshing.text_files import packaged_rows

from .box_drag import check_positive
from .smooth import smooth

FITTED = np.deg2rad(60.0)
LARGEST_TURN = 0.5  # L/R of the tests
SAME = 0.025  # relative distance of L/B or B/d within which it counts as a tested proportion
DEEP = 8.0  # H/d above which the tests with other L/B are used


class OutsideTests(ValueError):
    """Error for proportions that the tests do not cover; proportions : those outside, "L/B", "B/d" or "H/d"; limits
    : in words
    """

    def __init__(self, proportions, limits):
        super().__init__(f"{limits}; give a TurningCoefficients of your own")
        self.proportions, self.limits = proportions, limits


class Term(NamedTuple):
    """βⁿ r'ᵏ, and whether its coefficient is even (1) or odd (−1) about β = 90°"""

    n: int
    k: int
    parity: int


# coefficients in the order A0, A1, … of C_x; A1, A2, … of C_y and C_m
_DRAG = ((0, 0), (2, 0), (0, 2), (1, 1), (3, 1), (1, 3), (4, 0), (0, 4))
_LIFT = ((1, 0), (0, 1), (2, 1), (1, 2), (3, 0), (0, 3))
DRAG = tuple(Term(n, k, 1 if k % 2 else -1) for n, k in _DRAG)
LIFT = tuple(Term(n, k, -1 if k % 2 else 1) for n, k in _LIFT)
MOMENT = tuple(Term(n, k, -parity) for n, k, parity in LIFT)


@dataclass(frozen=True, eq=False)
class TurningCoefficients:
    """Coefficients of one box.

    x : (8,) A0 … A7 of C_x; y, m : (6,) A1 … A6 of C_y and C_m
    notes : remarks for users of these numbers, one line each
    """

    x: np.ndarray
    y: np.ndarray
    m: np.ndarray
    notes: tuple[str, ...] = ()

    def C_x(self, beta, turn):
        """Drag over ½ρ L d V² at drift angles `beta`, rad, and turns r' = L/R; shape (…)"""
        return _total(self.x, DRAG, beta, turn)

    def C_y(self, beta, turn):
        """Side force over ½ρ L d V²; shape (…)"""
        return _total(self.y, LIFT, beta, turn)

    def C_m(self, beta, turn):
        """Moment over ½ρ L² d V²; shape (…)"""
        return _total(self.m, MOMENT, beta, turn)

    def powers(self, beta):
        """Coefficients of r'ᵏ, k = 0 … 4, of −C_x, C_y and C_m as polynomials in r', at drift angles `beta`; shape (…,
        5, 3)"""
        beta = np.asarray(beta, float)
        out = np.zeros((*beta.shape, 5, 3))
        for part, (values, terms, sign) in enumerate(((self.x, DRAG, -1), (self.y, LIFT, 1), (self.m, MOMENT, 1))):
            for a, (n, k, parity) in zip(values, terms, strict=True):
                out[..., k, part] += sign * a * _round(beta, n, parity)
        return out

    def tested(self, beta, turn):
        """Whether the tests cover this motion; shape (…): within 60° of straight ahead or astern and |r'| ≤ 0.5"""
        acute = np.abs(np.arctan(np.tan(beta)))
        return (acute <= FITTED * (1 + 1e-9)) & (np.abs(turn) <= LARGEST_TURN)


def turning_coefficients(length_over_beam, beam_over_draft, depth_over_draft):
    """TurningCoefficients of a box.

    L/B = 2 was tested for B/d = 10 and 20 (linear between them) and H/d = 1.2, 1.5, 3 and 8 (curves over d/H; deeper
    water counts as 8). L/B from 1 to 3 was tested for B/d = 10 in deep water, H/d about 20.
    raises : ValueError outside these tests, where the user must give coefficients
    """
    slender, wide, relative = length_over_beam, beam_over_draft, depth_over_draft
    tested = {"H/d": (relative, 1.2, np.inf)}
    if abs(slender / 2.0 - 1) <= SAME:
        _require(tested | {"B/d": (wide, 10.0 * (1 - SAME), 20.0 * (1 + SAME))})
        share = np.clip((wide - 10.0) / 10.0, 0.0, 1.0)
        x, y, m = ((1 - share) * _over_depth(c, 10.0, relative) + share * _over_depth(c, 20.0, relative) for c in "xym")
        return TurningCoefficients(x, y, m)
    tested = {
        "L/B": (slender, 1.0, 3.0),
        "B/d": (wide, 10.0 * (1 - SAME), 10.0 * (1 + SAME)),
        "H/d": (relative, DEEP, np.inf),
    }
    _require(tested, " of L/B other than 2")
    return TurningCoefficients(*(_over_slenderness(c, slender) for c in "xym"), tuple(_notes(slender)))


def turning_force(coefficients, u, v, r, length, draft, mass_x, mass_y, density=1025.0):
    """Forces F_x, F_y, N, and moment M_z, N m, of the water on the box, about its middle; shape (…, 3).

    u, v : (…) m/s, velocity relative to the water along and across the box; r : (…) rad/s yaw rate
    mass_x, mass_y : mass with added mass in slow surge and sway, kg; the tests include their inertia in the turn
    """
    check_positive(length=length, draft=draft, mass_x=mass_x, mass_y=mass_y, density=density)
    u, v, r = np.broadcast_arrays(*(np.asarray(value, float) for value in (u, v, r)))
    speed, beta = np.hypot(u, v), np.arctan2(-v, u)
    r = np.clip(r, -LARGEST_TURN * speed / length, LARGEST_TURN * speed / length)
    turn = r * length / np.where(speed > 0, speed, 1.0)
    pressure = 0.5 * density * speed**2 * length * draft
    F_x = -coefficients.C_x(beta, turn) * pressure - mass_y * v * r
    F_y = coefficients.C_y(beta, turn) * pressure + mass_x * u * r
    M_z = coefficients.C_m(beta, turn) * pressure * length
    return np.stack([F_x, F_y, M_z], axis=-1)


def _total(coefficients, terms, beta, turn):
    turn = np.clip(turn, -LARGEST_TURN, LARGEST_TURN)
    terms = zip(coefficients, terms, strict=True)
    return sum(a * _round(beta, n, parity) * turn**k for a, (n, k, parity) in terms)


def _round(beta, n, parity):
    """βⁿ up to 60°, continued with the symmetry `parity` about 90°, and from there over the full circle"""
    beta = np.mod(np.asarray(beta, float) + np.pi, 2 * np.pi) - np.pi
    folded = np.abs(beta)
    behind = folded > np.pi / 2
    folded = np.where(behind, np.pi - folded, folded)
    sign = np.where(behind, parity, 1.0) * np.where((beta < 0) & (n % 2 == 1), -1.0, 1.0)
    return sign * _first_quadrant(folded, n, parity)


def _first_quadrant(beta, n, parity):
    s, reach = np.maximum(beta - FITTED, 0.0), np.pi / 2 - FITTED
    value, slope = FITTED**n, n * FITTED ** (n - 1) if n else 0.0
    bend = -slope / (2 * reach) if parity > 0 else -(value + slope * reach) / reach**2
    return np.where(beta <= FITTED, np.minimum(beta, FITTED) ** n, value + slope * s + bend * s**2)


def _require(tested, where=""):
    """Raise OutsideTests with every proportion of {name: (value, lowest, highest)} outside its range"""
    out = [
        (name, f"{name} = {value:.4g} is outside the turning tests{where} ({low:.4g} to {high:.4g})")
        for name, (value, low, high) in tested.items()
        if not low * (1 - 1e-9) <= value <= high * (1 + 1e-9)
    ]
    if out:
        names, limits = zip(*out, strict=True)
        raise OutsideTests(names, ", ".join(limits))


@cache
def _rows(coefficient):
    """{(L/B, B/d, H/d): coefficients in the order of the terms}"""
    size, first = (8, 0) if coefficient == "x" else (7, 1)
    return {
        tuple(float(r[key]) for key in ("length_over_beam", "beam_over_draft", "depth_over_draft")): np.array(
            [float(r[f"A{i}"]) for i in range(first, size)]
        )
        for r in packaged_rows(__package__, "turning_derivatives")
        if r["coefficient"] == f"C_{coefficient}"
    }


def _over_depth(coefficient, wide, relative):
    rows = sorted((1 / h, a) for (slender, b, h), a in _rows(coefficient).items() if slender == 2.0 and b == wide)
    return smooth([x for x, _ in rows], [a for _, a in rows], flat=[0])(max(1 / relative, rows[0][0]))


def _over_slenderness(coefficient, slender):
    rows = sorted((s, a) for (s, b, h), a in _rows(coefficient).items() if b == 10.0 and h >= DEEP)
    return smooth([s for s, _ in rows], [a for _, a in rows])(slender)


def _notes(slender):
    if 1.5 < slender < 3.0:
        yield (
            f"turning coefficients of L/B = {slender:.4g}: in the report C_y of L/B = 2.25 deviates from the "
            "neighbouring values (A4, A5, A6); it is used as printed"
        )
    if slender > 1.0:
        yield (
            f"turning coefficients of L/B = {slender:.4g}: the report's C_y is up to 0.13 at β = r = 0 (A0), where "
            "symmetry requires 0 for a box; this value is not used"
        )
