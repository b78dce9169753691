"""Natural periods of a body, free or restrained, with added mass at the frequency of each mode.

    (C + K) q = ω² (M + A(ω)) q

The natural frequency of the j-th smallest eigenvalue λⱼ(ω) is the root of ω² = λⱼ(ω).  λⱼ is continuous, positive and
bounded, so every j has a root, whichever motion dominates the mode at each frequency.
"""

from dataclasses import dataclass

import numpy as np

from .resonances import by_motion, free_modes, positive, zeros

GIVE_GYRATION = "give --gyration kxx,kyy,kzz and solve again; if its files were imported, give it by `hakobune body`"


@dataclass(frozen=True)
class NaturalPeriods:
    """Modes in the order Surge … Yaw, for several bodies one body after another. Each mode is named after the motion
    with most of its kinetic energy.

    names : (n,); period : (n,) s, inf without restoring, nan where the body is unstable
    shapes : mode shapes in rows, (n, n), with largest component 1 after rotations are multiplied by `scale` m
    inside : False for a mode whose added mass is the value at the end of the stored frequencies, and where the water
        of a gap or a moonpool resonates, (n,)
    water : lowest stored frequency at which water in a gap or a moonpool, above its resonance, makes the inertia of
        each motion negative, rad/s, (m,); nan if there is none
    """

    names: tuple[str, ...]
    period: np.ndarray
    shapes: np.ndarray
    inside: np.ndarray
    scale: float
    water: np.ndarray | float = np.nan

    def __repr__(self):
        return (
            "<NaturalPeriods " + ", ".join(f"{n} {t:.4g} s" for n, t in zip(self.names, self.period, strict=True)) + ">"
        )


def natural_periods(body, coupled=True) -> NaturalPeriods:
    """Natural periods of a body with frequency-dependent added mass.

    body : `bem.database.reader.Reader`, `restrained` by its mooring. Outside the stored frequencies its added mass
        keeps the value at their end, and `inside` is False
    coupled : whether the motions are coupled; False: each motion alone
    raises : ValueError where inertia, stiffness or added mass are not stored
    """
    if body.inertia is None or body.stiffness is None:
        raise ValueError(f"natural periods need the inertia of the body; {GIVE_GYRATION}")
    kept = 1 if coupled else np.eye(len(body.inertia))
    scale = float(np.sqrt(body.inertia[5, 5] / body.inertia[0, 0]))
    lengths = np.where(body.turning, scale, 1.0)
    unit, free = np.outer(lengths, lengths), None if body.free is None else lengths[:, None] * body.free
    C = kept * 0.5 * (body.stiffness + body.stiffness.T) / unit

    def modes(w):
        """λ (q, n), eigenvectors in columns (q, n, n) and the mass matrix (q, 6, 6) used"""
        M = kept * (body.inertia + body.held_added_mass(w)) / unit
        M = 0.5 * (M + M.swapaxes(1, 2))
        return *free_modes(free, positive(M), C), M

    M = body.inertia + body.held_added_mass(body.omega)
    gaps = np.linalg.eigvalsh(0.5 * (M + M.swapaxes(1, 2)))[:, 0].min() <= 0
    negative = np.diagonal(M, axis1=1, axis2=2) <= 0
    water = np.where(negative.any(axis=0), body.omega[negative.argmax(axis=0)], np.nan)
    frequencies = _own_frequencies(lambda w: modes(w)[0], body.omega if gaps else ())
    own = np.arange(len(frequencies))
    _, vectors, M = modes(np.abs(frequencies))
    known = body.knows_added_mass(frequencies)
    # at a resonance of the water in a gap or a moonpool, the coupled motion has the same frequency
    known = known & (np.linalg.eigvalsh(M)[:, 0] > 0)
    vectors = vectors[own, :, own]
    energies = np.abs(vectors * np.einsum("mij,mj->mi", M, vectors))
    shapes = vectors / np.take_along_axis(vectors, np.abs(vectors).argmax(axis=1)[:, None], axis=1)
    order = by_motion(energies)
    names = tuple(name for name, mode in zip(body.names, order, strict=True) if mode >= 0)
    order = order[order >= 0]
    frequencies, shapes, known = frequencies[order], shapes[order], known[order]
    # eigenvalues of a mode without restoring are rounding errors relative to the stiffest mode
    free = np.abs(frequencies) <= 1e-6 * np.abs(frequencies).max()
    with np.errstate(divide="ignore"):
        period = np.where(free, np.inf, np.where(frequencies < 0, np.nan, 2 * np.pi / np.abs(frequencies)))
    return NaturalPeriods(names, period, shapes, known, scale, water)


def _own_frequencies(eigenvalues, places=()):
    """Frequencies ω with ω² = λⱼ(ω); shape (n,); −√−λ for an unstable mode

    places : (q,) rad/s, rising, among which the first root is sought, where gap water causes several roots
    """
    start = eigenvalues(np.zeros(1))[0]
    own = np.arange(len(start))

    def excess(w):
        return np.sqrt(np.maximum(eigenvalues(w)[own, own], 0)) - w

    low, above = np.zeros(len(own)), np.sqrt(np.maximum(start, 0))
    high, below = np.where(start > 0, above, 1.0), np.full(len(own), -1.0)
    for _ in range(200):
        below = excess(high)
        if np.all((below < 0) | (start <= 0)):
            break
        short = (below >= 0) & (start > 0)
        low, above = np.where(short, high, low), np.where(short, below, above)
        high = np.where(short, 2 * high, high)
    for place in places[::-1]:
        there = excess(np.full(len(own), place))
        first = (there < 0) & (place < high) & (start > 0)
        high, below = np.where(first, place, high), np.where(first, there, below)
    back = high <= low  # the first root lies below the first guess
    low, above = np.where(back, 0.0, low), np.where(back, np.sqrt(np.maximum(start, 0)), above)
    w = zeros(excess, low, above, high, below)
    return np.where(start > 0, w, -np.sqrt(np.maximum(-start, 0)))
