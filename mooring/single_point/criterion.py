"""Whether a towed or moored body slews: quartic of small motions, its Routh–Hurwitz conditions and its roots.

    λ⁴ + A λ³ + B λ² + C λ + D = 0

of lateral motion y and yaw ψ on a line of length ℓ that pulls with F at a distance a ahead of the centre of mass,

    M ÿ = Fγ + Y_v ẏ + Y_r ψ̇ + Y_ψ ψ,    I ψ̈ = aFγ + N_v ẏ + N_r ψ̇ + N_ψ ψ,    γ = −(y + aψ)/ℓ − ψ

M and I include added mass; Y and N are in axes of the body. If the far end of the line yields, ℓ is F over the
lateral stiffness at the attachment.  SR179 report (1982), eq. 3.6.17–3.6.23: in 3.6.17 Y_β = −U Y_v, N_β = −U N_v,
and the Y_r printed there contains −MU; all four of A, B, C, D have to be positive (the printed sum is a misprint).
"""

from typing import NamedTuple

import numpy as np


class Lateral(NamedTuple):
    """Lateral motion about an equilibrium in which the line lies straight ahead; numbers or arrays of one shape.

    mass, inertia : with added mass, kg and kg m²; pull : pull of the line, N; arm : from the centre of mass to the
        line's end on the body, m
    length : length of the line, m; Y_v, Y_r, Y_psi, N_v, N_r, N_psi : derivatives of the external force and moment, SI
    """

    mass: float
    inertia: float
    pull: float
    arm: float
    length: float
    Y_v: float = 0.0
    Y_r: float = 0.0
    Y_psi: float = 0.0
    N_v: float = 0.0
    N_r: float = 0.0
    N_psi: float = 0.0


class Slewing(NamedTuple):
    """Stability from the roots λ: the fastest growing or slowest decaying motion.

    stable : whether every motion decays; growth : 1/s, below 0 for a decaying motion; period : s, inf without
        oscillation
    """

    stable: bool
    growth: float
    period: float


def moored_quartic(m: Lateral):
    """Coefficients 1, A, B, C, D of a body moored in a steady stream (eq. after 3.6.18); shape (…, 5)."""
    M, I, F, a, L = m.mass, m.inertia, m.pull, m.arm, m.length
    A = -m.Y_v / M - m.N_r / I
    B = (m.Y_v * m.N_r - m.Y_r * m.N_v) / (M * I) + F / (L * I) * (I / M + a * a + a * L) - m.N_psi / I
    C = F / (M * I) * ((1 + a / L) * (m.N_v - a * m.Y_v) - (m.N_r - a * m.Y_r) / L)
    C = C - (m.Y_psi * m.N_v - m.N_psi * m.Y_v) / (M * I)
    D = F / (M * I * L) * (a * m.Y_psi - m.N_psi)
    return np.stack(np.broadcast_arrays(1.0, A, B, C, D), axis=-1)


def undamped(quartic):
    """Coefficients with A = C = 0, for no damping: the body then oscillates without decay, or slews (3.6.19)"""
    return np.asarray(quartic) * np.array([1.0, 0.0, 1.0, 0.0, 1.0])


def routh_hurwitz(quartic):
    """Whether all roots have negative real parts; shape (…): A, B, C, D > 0 and ABC − C² − A²D > 0 (3.6.18)"""
    _, A, B, C, D = np.moveaxis(np.asarray(quartic, float), -1, 0)
    return (A > 0) & (B > 0) & (C > 0) & (D > 0) & (A * B * C - C * C - A * A * D > 0)


def undamped_stable(quartic):
    """Whether the undamped motion stays bounded; shape (…): B > 0, D > 0, B² − 4D > 0 (3.6.21)"""
    _, _, B, _, D = np.moveaxis(np.asarray(quartic, float), -1, 0)
    return (B > 0) & (D > 0) & (B * B - 4 * D > 0)


def roots(quartic):
    """Roots λ, 1/s, as eigenvalues of the companion matrix, the largest real part first; shape (…, 4)"""
    q = np.asarray(quartic, float)
    companion = np.zeros((*q.shape[:-1], 4, 4))
    companion[..., 0, :] = -q[..., 1:] / q[..., :1]
    companion[..., [1, 2, 3], [0, 1, 2]] = 1.0
    return falling(np.linalg.eigvals(companion))


def falling(values):
    """Complex numbers (…, n) sorted by real part, the largest first; in a conjugate pair the positive imaginary part
    comes first
    """
    order = np.lexsort((-values.imag, -values.real), axis=-1)
    return np.take_along_axis(values, order, axis=-1)


def slewing(values) -> Slewing:
    """Slewing of roots (n,) 1/s"""
    first = falling(np.asarray(values, complex))[0]
    period = 2 * np.pi / abs(first.imag) if abs(first.imag) > 1e-12 * abs(first) else np.inf
    return Slewing(bool(first.real < 0), float(first.real), float(period))


class Proportions(NamedTuple):
    """Dimensionless quantities of the undamped criterion (3.6.22): numbers or arrays of one shape.

    mass : (m + m_y)/(½ρL²d); inertia : (I + J)/(½ρL⁴d); length : ξ = ℓ/L; arm : ζ = a/L; drag : F/(½ρLdV²)
    side, turn : dC_Y/dψ and dC_N/dψ, 1/rad, of the external force over ½ρLdV² and moment over ½ρL²dV²
    """

    mass: float
    inertia: float
    length: float
    arm: float
    drag: float
    side: float
    turn: float


class Discriminant(NamedTuple):
    """B̂ and B̂² − 4D̂ of 3.6.22 and 3.6.23, and the parts listed in table 3.6.4.1: B̂ = i − ii, 4D̂ = iii·iv"""

    i: float
    ii: float
    iii: float
    iv: float
    B: float
    value: float
    stable: bool


def discriminant(p: Proportions) -> Discriminant:
    """Discriminant of the undamped motion; stable where B̂ > 0, D̂ > 0 and the discriminant is positive"""
    i = p.drag * (p.inertia + p.mass * p.arm * (p.arm + p.length))
    ii = p.length * p.mass * p.turn
    iii = 4 * p.length * p.mass * p.inertia
    iv = p.drag * (p.arm * p.side - p.turn)
    B = i - ii
    value = B * B - iii * iv
    return Discriminant(i, ii, iii, iv, B, value, (B > 0) & (iii * iv > 0) & (value > 0))


def proportions(m: Lateral, hull_length, draft, speed, density) -> Proportions:
    """Proportions of a Lateral in a current of `speed`, m/s; hull_length, draft : m; density : kg/m³"""
    L, pressure = hull_length, 0.5 * density * hull_length * draft * speed**2
    half = 0.5 * density * L * L * draft
    derivatives = m.Y_psi / pressure, m.N_psi / (pressure * L)
    return Proportions(m.mass / half, m.inertia / (half * L * L), m.length / L, m.arm / L, m.pull / pressure,
                       *derivatives)  # fmt: skip
