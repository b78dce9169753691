"""Damping of one motion of a body from the decay of this motion, while waves damp it and the other motions are free.

    D(λ) = λ² M + λ Z(λ) + C,      Z(iω) = iω A(ω) + B(ω),      λ = −β₁/2 + i √(Ω² − β₁²/4)
    det(D + z eᵢeᵢᵀ) = 0,          z = −1 / (D⁻¹)ᵢᵢ = λ b + k

A body released in roll also sways, because sway is coupled with roll. It turns about a different axis, and radiates
much less (a barge one third) than in roll about the origin. b and k are the linear damping and the stiffness that
motion i of the database needs, in addition to its waves, to decay as recorded; β₁ = B1/M and Ω are those of `decay`.
Z is continued from the real frequency Ω by the first term of its series, which contains the energy of the waves near
the body (½ω dA/dω).
"""

from typing import NamedTuple

import numpy as np

STEP = 0.01  # relative half step of the derivatives in frequency


class Coupled(NamedTuple):
    """Values of a motion in its decay, SI. mass : mass with added mass; waves : damping by waves; rest : all other
    linear damping

    natural : natural frequency without the stiffness k, rad/s, nan without restoring
    """

    mass: float
    waves: float
    rest: float
    natural: float


def coupled(body, mode, omega, rate):
    """`Coupled` of motion `mode` of a `Reader` with inertia; omega, rate : Ω, rad/s, and β₁, 1/s, of its decay.

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
