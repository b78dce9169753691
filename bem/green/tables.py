"""Tables of the wave part of the Green function at one frequency (equations in `bem.green.finite_depth`).

The singular and oscillating parts are subtracted: the deep-water function for R < h/2, and the wave for larger R.
`bem.green.deep_water` gives these functions at every frequency.  The remainder varies over the larger of h/2 and R at
every frequency, so few piecewise polynomials of degree 7 represent it. Pieces in R grow with R until the remainder is
negligible; pieces in the two depth variables have equal size.
"""

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy import special

from ..waves import propagating_factor, wavenumber
from .deep_water import universal
from .exact_forms import InfiniteFrequency, PositiveFrequency, ZeroFrequency
from .piecewise_polynomials import aligned, fit_pieces, pieces_per_distance, sample_points

FINEST, COARSEST = 1e-8, 1e-3  # available accuracies
WHOLE = 5e-10  # accuracy of `whole_table` relative to 1/r, of which G may be a small part
# parts beyond the last zone: nothing in addition to wave and deep water; minus the images, since G without wave is 0;
# NaN
TABLE_ONLY, WITH_IMAGES, NOTHING = 0, 1, 2


class Table(NamedTuple):
    """Data from which kernels compute G at one frequency, with coefficients of `bem.green.piecewise_polynomials`"""

    K: float  # 1/m, ω²/g, the factor of the logarithm; zero for the limits, which have none
    k: float  # 1/m
    C: float  # 1/m, factor of the propagating part; zero for the limits
    per_metre: float  # 1/m, 2/h: where R · per_metre < 1 the deep-water function has been subtracted
    double_depth: float  # m, zero in infinite depth: there are no pieces
    entries: int  # rows of `zones`, one for every h/2 of R
    beyond: int  # part added beyond the last zone: TABLE_ONLY, WITH_IMAGES or NOTHING
    net: float  # 1/m, factor of ln(2h/R) of zero frequency
    mirror: float  # sign of 1/r₁ in G
    pieces: np.ndarray  # (pieces, 8, 8): zone by zone g₁ (Y rows of R columns) and g₂ (V rows of R columns)
    zones: np.ndarray  # (entries, 9): of `_zone`
    deep: np.ndarray  # table of `bem.green.deep_water.universal`
    bessel: np.ndarray


@lru_cache(maxsize=4)  # meshes of one body, solved for the estimated error, have one table
def wave_table(omega, depth, gravity, reach, draft, accuracy=1e-5):
    """Table of frequency `omega` rad/s for horizontal distances up to `reach` and points down to `draft` (m).

    accuracy : largest error, 1e-8 … 1e-3, of G relative to the larger of |G| and 1/r, and of ∇G relative to the
        larger of |∇G| and 1/r²; G includes 1/r and the images.
    Beyond `reach`, G is NaN if `reach` is less than about ten depths.
    raises : ValueError for an accuracy outside this range
    """
    if not FINEST <= accuracy <= COARSEST:
        raise ValueError(f"accuracy is {accuracy:g}; allowed: {FINEST:g} to {COARSEST:g}")
    K, k, C = _wave_numbers(omega, depth, gravity)
    form = None if np.isinf(depth) else PositiveFrequency(K, k, depth, _digits(accuracy))
    return _table(form, K, k, C, depth, reach, draft, accuracy)


@lru_cache(maxsize=16)
def whole_table(omega, depth, gravity):
    """`Table` with the accuracy `WHOLE`, for points at any depth and distance. For R > h/2 the table contains G
    without the wave."""
    K, k, C = _wave_numbers(omega, depth, gravity)
    form = None if np.isinf(depth) else PositiveFrequency(K, k, depth, _digits(1e-4 * WHOLE))
    return _table(form, K, k, C, depth, np.inf, depth, WHOLE, whole=True)


def limit_table(which, depth, reach, draft, accuracy=1e-5):
    """Table of the limit "zero" (rigid lid) or "infinity" (φ = 0 on the surface) of the frequency.

    At zero frequency in finite depth G contains −(2/h) ln R and is determined only up to a constant. The constant has
    no effect on modes without net flux. At infinite frequency G contains −1/r₁, which is not part of g₁.
    """
    form = (
        None if np.isinf(depth) else (ZeroFrequency if which == "zero" else InfiniteFrequency)(depth, _digits(accuracy))
    )
    return _table(form, 0.0, 0.0, 0.0, depth, reach, draft, accuracy)


def _wave_numbers(omega, depth, gravity):
    k = float(wavenumber(omega, depth, gravity))
    return omega * omega / gravity, k, float(propagating_factor(omega, k, depth, gravity))


def _digits(accuracy):
    """−ln of the truncation error, which is a few times smaller than the requested accuracy"""
    return 5.0 - math.log(accuracy)


def _table(form, K, k, C, depth, reach, draft, accuracy, whole=False):
    constants = universal()
    if form is None:
        none = 0.0, 0.0, 0, TABLE_ONLY, 0.0, 1.0
        return Table(K, k, C, *none, np.zeros((1, 8, 8)), np.zeros((1, 9)), *constants)
    near, draft, digits = 0.5 * depth, min(draft, depth), _digits(1e-4 * accuracy if whole else accuracy)
    modes = form.modes(math.ceil(2 * digits / math.pi) + 1)
    slowest = modes[0][0]
    octaves = max(math.ceil(math.log2(digits / (slowest * near))), 1)  # the remainder beyond them is negligible
    wanted = octaves if reach > near * 2**octaves else max(math.ceil(math.log2(reach / near)), 0)
    # the nearest images in surface and bed that are not subtracted are 2h − draft away from the body
    sharper = 0.05 * accuracy if whole else accuracy  # near the axis ∇G may vanish
    half = min(_wave_piece(k, depth, draft, sharper), (2 * depth - draft) / pieces_per_distance(sharper))
    parts = [_zone(0.0, near, half, draft, form.near)]
    for n in range(wanted):
        start = near * 2**n
        half = start / (pieces_per_distance(accuracy) - 1)
        if whole:  # relative to the remaining part of G there, down to 1e-4 of 1/r
            half = min(half, (accuracy / 1e-5) ** (1 / 7) / slowest * max(1.0, math.exp((slowest * start - 9) / 8)))
        parts.append(_zone(start, 2 * start, half, draft, _Far(form, modes, depth, digits, whole)))
    first, zones = 0, []
    for n, (row, surface, bed) in enumerate(parts):
        row[4:6] = first, first + len(surface)
        first += len(surface) + len(bed)
        zones += [row] * (2 ** (n - 1) if n else 1)
    pieces = aligned(np.concatenate([part for _, *both in parts for part in both]))
    beyond = TABLE_ONLY if whole else (WITH_IMAGES if wanted == octaves else NOTHING)
    layout = 1 / near, 2 * depth, len(zones), beyond, form.net, form.mirror
    return Table(K, k, C, *layout, pieces, np.array(zones), *constants)


def _wave_piece(k, depth, draft, accuracy):
    """Half-width (m) that resolves the waves in the remainder for R < h/2, which decay away from the surface"""
    if k == 0:
        return np.inf
    strength = min(1.0, 4 * math.exp(-k * (2 * depth - draft)))
    return (accuracy / (8e-5 * strength + 1e-300)) ** (1 / 7) / k


def _zone(start, end, half, draft, values):
    """Row of `Table.zones` and pieces of g₁ and g₂ for start < R < end, of half-width at most `half` m.

    values : function (R, Y, V) → g₁ (R, Y), g₂ (R, V).
    The row holds start, columns per metre, rows of g₁ and of g₂ per metre, number of the first piece of each (filled
    in by `_table`), number of the last column, of the last rows of g₁ and of g₂.
    """
    R, Y, V = (
        np.linspace(low, high, max(math.ceil((high - low) / (2 * half)), 1) + 1)
        for low, high in ((start, end), (0.0, max(2.0002 * draft, 1e-3 * end)), (0.0, max(1.0001 * draft, 1e-3 * end)))
    )
    surface, bed = values(sample_points(R), sample_points(Y), sample_points(V))
    scales = [(len(edges) - 1) / (edges[-1] - edges[0]) for edges in (R, Y, V)]
    return (
        [start, scales[0], *scales[1:], 0, 0, *(len(edges) - 2 for edges in (R, Y, V))],
        fit_pieces(surface),
        fit_pieces(bed),
    )


class _Far(NamedTuple):
    """g₁ and g₂ less the wave for R > h/2, by John's series; if `whole`, all of G less the wave."""

    form: object
    modes: tuple
    depth: float
    digits: float
    whole: bool

    def __call__(self, R, Y, V):
        form, h = self.form, self.depth
        count = int(self.digits / (R[0] / h * math.pi)) + 2
        km, factor = (m[:count] for m in self.modes)
        k0 = special.k0(R[:, None] * km) * factor
        surface, bed = k0 @ np.cos(km[:, None] * (2 * h - Y)), k0 @ np.cos(km[:, None] * V)
        if form.net:
            logarithm = form.net * np.log(2 * h / R)[:, None]
            surface, bed = surface + logarithm, bed + logarithm
        if not self.whole:
            square = R[:, None] ** 2
            surface -= (square + (2 * h - Y) ** 2) ** -0.5 + form.mirror * (square + Y * Y) ** -0.5
            bed -= (square + V * V) ** -0.5
        return surface, bed
