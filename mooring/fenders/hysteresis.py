"""Unloading and reloading of a fender between its loading curve L and its unloading curve U.

    R = U(δ) + s w(δ),    w = L − U ≥ 0,    ds = dδ/ℓ, limited to 0 … 1;    s = 1 without contact

s is a stop operator with the length ℓ. From first contact the reaction follows L. A return leads to U within ℓ; a
reloading leads back to L within ℓ.  With δ = p + ℓ s and Φ = ℓ ∫₀^s σ w(p + ℓσ) dσ

    s w dδ = dΦ + (∫₀^s w(p + ℓσ) dσ) dp,

where p rises only at s = 1 and falls only at s = 0. The last term is therefore never negative, nor is the work of
any closed path, however many loops it has.  Φ is 0 without contact, so that a fender after a separation has no
stored energy.  The state after a straight step is exact, whatever the step.

A simulation uses `ContactTable`: `advanced_one` and `reaction_of` work on numbers alone.  A step of an integration
keeps s from its start, evaluates stages with advanced_one(s, δ of the start, δ of the stage, ℓ), and stores s at its
end.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory


@in_memory
class ContactTable(NamedTuple):
    """Curves of m fenders in few contiguous arrays, because every array argument of a kernel costs time

    first : (m + 1,), number of the first piece of each fender
    pieces : (…, 9), knot; loading, and loading less unloading, as cubics, lowest order first; the last piece of each
        fender is straight and unlimited
    marks : (m, 3), return length, m; limit, m, beyond which a simulation reports; 1 if it stops instead, else 0
    """

    first: np.ndarray
    pieces: np.ndarray
    marks: np.ndarray


def contact_table(fenders):
    """`ContactTable` of a sequence of `fender.Fender`"""
    parts = [_with_tail(fender) for fender in fenders]
    first = np.concatenate([[0], np.cumsum([len(part) for part in parts])]).astype(np.int64)
    marks = [(fender.return_length, fender.limit, fender.overload is None) for fender in fenders]
    return ContactTable(first, np.concatenate([np.zeros((0, 9)), *parts]), np.array(marks, float).reshape(-1, 3))


def _with_tail(fender):
    width = fender.loading.minus(fender.unloading)
    tails = [[[float(c(c.end)), float(c.slope(c.end)), 0.0, 0.0]] for c in (fender.loading, width)]
    tails[1][0][1] = max(tails[1][0][1], 0.0)  # a decreasing width would become negative
    columns = (
        np.concatenate([curve.coefficients, tail]) for curve, tail in zip((fender.loading, width), tails, strict=True)
    )
    return np.column_stack([fender.loading.knots, *columns])


def advanced(state, before, after, length):
    """State s after a monotone step between two deflections, m (numbers or arrays); 1 without contact"""
    turned = (np.maximum(after, 0.0) - np.maximum(before, 0.0)) / length
    return np.where(np.asarray(after) <= 0, 1.0, np.clip(state + turned, 0.0, 1.0))


def advanced_one(state, before, after, length):
    """`advanced` of plain numbers, for kernels"""
    if after <= 0.0:
        return 1.0
    return min(1.0, max(0.0, state + (after - max(before, 0.0)) / length))


def reaction_at(fender, deflection, state):
    """Force, N, at deflections and states of the same shape"""
    down = fender.unloading(deflection)
    return down + state * (fender.loading(deflection) - down)


def followed(fender, deflection):
    """Reactions (n,) N and states (n,) along a path of deflections (n,) m, without contact before the first."""
    states, before, s = [], 0.0, 1.0
    for after in np.asarray(deflection, float):
        s = float(advanced(s, before, after, fender.return_length))
        before = after
        states.append(s)
    return reaction_at(fender, deflection, np.array(states)), np.array(states)


def reaction_of(table, which, deflection, state):
    """Reaction, N, of fender `which` at one deflection and state: plain numbers, for kernels"""
    piece, stop = table.first[which], table.first[which + 1]
    while stop - piece > 1:
        middle = (piece + stop) // 2
        if table.pieces[middle, 0] <= deflection:
            piece = middle
        else:
            stop = middle
    c = table.pieces
    t = deflection - c[piece, 0]
    force = c[piece, 1] + t * (c[piece, 2] + t * (c[piece, 3] + t * c[piece, 4]))
    force += (state - 1.0) * (c[piece, 5] + t * (c[piece, 6] + t * (c[piece, 7] + t * c[piece, 8])))
    return force if deflection > 0.0 else 0.0
