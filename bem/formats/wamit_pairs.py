"""Forces of pairs in WAMIT's files NAME.12d and NAME.12s (user manual, version 7.4, chapter 12).

    PER₁ PER₂ BETA₁ BETA₂ I Mod Pha Re Im        F(t) = Re Σᵢ Σⱼ Aᵢ Āⱼ ρg F̄_ij exp{+i(ωᵢ − ωⱼ)t}    of .12d
                                                 F(t) = Re Σᵢ Σⱼ Aᵢ Aⱼ ρg F̄_ij exp{+i(ωᵢ + ωⱼ)t}    of .12s

with F̄ multiplied by ULEN for forces and by ULEN² for moments.  Periods are in s, headings in degrees that waves
travel to, phases in degrees; numbers are the conjugates of ours.
The files contain the pairs with PER₁ ≤ PER₂. A pair with PER₁ > PER₂ has the conjugate value in .12d and an equal
value in .12s.  I numbers the forces of N bodies from 1 to 6N.
"""

from pathlib import Path

import numpy as np

from hakobune.meshing.whole_files import made_beside

from ..modes import turned
from ..second_order.kinds import DIFFERENCE, SUM
from ..second_order.quadratic_forces import QuadraticForces
from .values import FormatError, table_of

SUFFIXES = {DIFFERENCE: ".12d", SUM: ".12s"}
EVEN = 1e-3  # relative variation of the frequency step that counts as even; periods are printed with seven digits


def write_pairs(forces, place, weight, bodies=()):
    """Write NAME.12d or .12s of a `QuadraticForces` and return its path

    weight : ρg, N/m³; bodies : `bem.modes.Body` of each of several bodies; forces are turned to the axes of the scene
    """
    path, degrees = Path(place).with_suffix(SUFFIXES[forces.kind]), np.degrees(forces.headings)
    T = forces.total.conj() / weight
    for i, body in enumerate(bodies):
        T[..., 6 * i : 6 * i + 6] = T[..., 6 * i : 6 * i + 6] @ turned(body.heading)
    with made_beside(path) as partial, partial.open("w", encoding="ascii") as file:
        for m in range(len(forces.frequency)):
            for higher, lower in zip(*forces.kind.pairs(m, len(forces.omega)), strict=True):
                one, two = forces.omega[[higher, lower]]
                periods = f"{2 * np.pi / one: .6E} {2 * np.pi / two: .6E}"
                for a, b in np.ndindex(len(degrees), len(degrees)):
                    head = f"{periods} {degrees[a]: .6E} {degrees[b]: .6E}"
                    for i, x in enumerate(T[m, lower, a, b], 1):
                        polar = f"{abs(x): .6E} {np.degrees(np.angle(x)): .6E}"
                        file.write(f"{head}{i:6d} {polar} {x.real: .6E} {x.imag: .6E}\n")
    return path


def read_pairs(place, weight, kind=DIFFERENCE, length=1.0):
    """`QuadraticForces` of NAME.12d or .12s; None if the file does not exist. All forces are stored as squares,
    because the file does not separate the parts

    weight : ρg, N/m³; length : m, ULEN
    raises : FormatError for uneven frequencies, and if pairs of a difference or sum frequency are missing
    """
    path, second = Path(place).with_suffix(SUFFIXES[kind]), kind.second
    if not path.exists():
        return None
    table = table_of(path, (9,))
    one, two, mode = 2 * np.pi / table[:, 0], 2 * np.pi / table[:, 1], table[:, 4].astype(int) - 1
    value = weight * length ** (1 + (mode % 6 > 2)) * (table[:, 7] - 1j * table[:, 8])
    omega, step = _even(path, np.concatenate([one, two]))
    n, l = (np.rint((w - omega[0]) / step).astype(int) for w in (one, two))
    turned = np.round(np.mod(table[:, 2:4] + 180, 360) - 180, 6)  # −180° and 180° are one
    degrees = np.unique(turned)
    a, b = (np.searchsorted(degrees, turned[:, column]) for column in (0, 1))
    swapped = n < l
    value = np.where(swapped, second(value), value)
    n, l, a, b = (np.where(swapped, y, x) for x, y in ((n, l), (l, n), (a, b), (b, a)))
    m = n + kind.sign * l
    shape = m.max() + 1, len(omega), len(degrees), len(degrees), 6 * (mode.max() // 6 + 1)
    out = np.full(shape, np.nan, complex)
    out[m, l, a, b, mode] = value
    alike = (np.arange(len(omega)) * (1 + kind.sign), np.arange(len(omega)))  # pairs of a frequency with itself
    alike = tuple(places[alike[0] < shape[0]] for places in alike)
    own = out[alike]
    out[alike] = np.where(np.isnan(own), second(own.swapaxes(1, 2)), own)
    frequency = kind.of(omega[0], omega[0]) + step * np.arange(shape[0])
    for row, there in enumerate(frequency):
        if np.isnan(out[row, kind.pairs(row, len(omega))[1]]).any():
            apart = f"{there:.4g} rad/s apart" if kind is DIFFERENCE else f"whose sum is {there:.4g} rad/s"
            raise FormatError(
                f"{path} lacks pairs of frequencies {apart}; allowed: all pairs up to the largest {kind.name}"
            )
    zero = np.where(np.isnan(out), np.nan, 0.0 * out)
    return QuadraticForces(omega, frequency, np.radians(degrees), out, zero, zero, kind=kind)


def _even(path, frequencies):
    """Frequencies at equal steps, rad/s, shape (n,), and the step"""
    found = np.sort(frequencies)
    found = found[np.concatenate([[True], np.diff(found) > 1e-5 * found[-1]])]
    step = (found[-1] - found[0]) / max(len(found) - 1, 1)
    even = found[0] + step * np.arange(len(found))
    if len(found) < 2 or np.abs(found - even).max() > EVEN * step:
        raise FormatError(
            f"{path} has periods that are not at equal steps of frequency; allowed: equal steps of frequency"
        )
    return even, step
