"""Damping of one motion of a body from the decay of this motion, while waves damp it and the other motions are free.

    D(λ) = λ² M + λ Z(λ) + C,      Z(iω) = iω A(ω) + B(ω),      λ = −β₁/2 + i √(Ω² − β₁²/4)
    det(D + z eᵢeᵢᵀ) = 0,          z = −1 / (D⁻¹)ᵢᵢ = λ b + k

A body released in roll turns about an axis of its own, with the sway that its coupling with roll makes, and radiates
much less (a barge: a third) than in roll about the origin.  b is the linear damping, and k the stiffness, that motion i
of the database needs besides its waves to decay as recorded: β₁ = B1/M and Ω are those of `decay`.  Z is continued from
the real frequency Ω by the first term of its series, which holds the energy of the waves near the body (½ω dA/dω).
"""

from typing import NamedTuple

import numpy as np

STEP = 0.01  # relative half step of the derivatives in frequency


class Coupled(NamedTuple):
    """Of a motion in its decay, SI: mass with added mass; waves, their damping of it; rest, all other linear damping;
    natural, rad/s, the natural frequency without the stiffness k, nan without restoring"""

    mass: float
    waves: float
    rest: float
    natural: float


def coupled(body, mode, omega, rate):
    """`Coupled` of motion `mode` of a `Reader` with inertia, that decays with Ω `omega`, rad/s, and β₁ `rate`, 1/s.

    Raises BetweenError for an Ω outside the stored frequencies.
    """
    grows = -rate / 2 + 1j * np.sqrt(complex(omega**2 - rate**2 / 4))
    ends = np.clip(omega * np.array([1 - STEP, 1 + STEP]), *body.between.span)
    A, B = body.coefficients(np.array([omega, *ends]))
    dA, dB = ((part[2] - part[1]) / (ends[1] - ends[0]) for part in (A, B))
    B = B[0] + body.damping
    impedance = 1j * omega * A[0] + B + (grows - 1j * omega) * (A[0] + omega * dA - 1j * dB)
    free = np.eye(len(body.inertia)) if body.free is None else body.free
    D = grows**2 * body.inertia + grows * impedance + body.stiffness
    column = free @ np.linalg.solve(free.T @ D @ free, free[mode])
    needed, shape = -1 / column[mode], column / column[mode]
    rest = needed.imag / grows.imag
    mass = _energy(shape, body.inertia + A[0] + 0.5 * omega * dA)
    restored = omega**2 * mass - (needed - rest * grows).real
    return Coupled(mass, _energy(shape, B), float(rest), float(np.sqrt(restored / mass)) if restored > 0 else np.nan)


def _energy(shape, matrix):
    return float((shape.conj() @ matrix @ shape).real)
