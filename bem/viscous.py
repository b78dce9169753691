"""Viscous damping of heave, roll and pitch that depends on the amplitude of the motion.

A law is replaced by the linear damping N that dissipates the same energy per cycle. For a drag N₂ |v| v this is, in
regular motion of amplitude a at frequency ω, and in irregular motion with standard deviation σ,

    N = (8/3π) ω a N₂,      N = √(8/π) σ_v N₂       (equal for a = EQUIVALENT_AMPLITUDE · σ)

The SR179 report (1982), section 2.1.4, adds to the wave damping, in heave and in roll,

    N̂ = b ξ_B,   N̂ = N √(B/2g) / (ρBdL),  roll: N √(B/2g) / (ρBdL (B/2)²),   ξ_B = ω²B/2g    (2.1.4.6, 2.1.4.7)

with b(a) from forced oscillation.  The normalisation of b_R is illegible in print; the normalisation of the roll
coefficients (section 2.1.3) is used.
With Yamashita's b_R the model M3B then has 2.6 % of critical damping at 2°; its roll in
irregular waves (appendix 1) needs 2 %. With B² in place of (B/2)², as in Himeno (1981), it would have 10 %.
"""

from dataclasses import dataclass

import numpy as np

from . import DOFS
from .motions import response

EQUIVALENT_AMPLITUDE = (3 * np.pi / 8) * np.sqrt(8 / np.pi)  # 1.880
LOSS = 8 / (3 * np.pi)

# b_R √ξ_B at a roll amplitude of 1°, theory of Yamashita and Katagiri (1980) for deep water as printed in the SR179
# report (1982), section 2.1.4: b_R 0.031 … 0.0103 at B/d = 5, 0.055 … 0.0185 at 10 for ξ_B = 0.25 … 2.25
YAMASHITA = {5.0: 0.0155, 10.0: 0.0276}


@dataclass(frozen=True)
class Quadratic:
    """Coefficient N₂ of a drag N₂ |v| v: N s²/m², for rotations N m s²."""

    drag: float

    def equivalent(self, omega, amplitude):
        """N s/m, N m s at `amplitude` m or rad"""
        return LOSS * omega * amplitude * self.drag


@dataclass(frozen=True)
class Tabulated:
    """N = scale ω² b(a) from values of b at rising amplitudes (m, rad). b is zero at zero amplitude and constant
    beyond the last amplitude.

    scale : ρBdL √(B/2g) in heave, times (B/2)² in roll
    """

    scale: float
    amplitudes: tuple
    values: tuple

    def __post_init__(self):
        a, b = np.asarray(self.amplitudes, float), np.asarray(self.values, float)
        if a.ndim != 1 or a.shape != b.shape or not (len(a) and a[0] > 0 and np.all(np.diff(a) > 0) and np.all(b >= 0)):
            raise ValueError(
                "viscous damping: amplitudes must increase from above 0, and each amplitude needs one b ≥ 0"
            )

    def equivalent(self, omega, amplitude):
        """N s/m, N m s at `amplitude` m or rad"""
        b = np.interp(amplitude, (0.0, *self.amplitudes), (0.0, *self.values))
        return self.scale * omega**2 * b


@dataclass(frozen=True)
class Viscous:
    """Laws of damping by degree of freedom, about the rotation centre, and the wave amplitude at which they are
    linearised.

    wave_amplitude : amplitude of a regular wave, m; names : names of the motions, (n,), for several bodies
        "barge__Roll" and so on
    """

    laws: dict
    wave_amplitude: float
    names: tuple = DOFS

    def damping(self, omega, amplitudes):
        """Linear damping at motion amplitudes (n,), m or rad; shape (n, n)"""
        out = np.zeros((len(self.names), len(self.names)))
        for dof, law in self.laws.items():
            i = self.names.index(dof)
            out[i, i] = law.equivalent(omega, amplitudes[i])
        return out


def yamashita_roll(length, beam, draft, density):
    """`Quadratic` roll damping of a box in deep water, interpolated linearly for B/d from 5 to 10

    raises : ValueError for other B/d
    """
    ratio = beam / draft
    known = sorted(YAMASHITA)
    if not known[0] * (1 - 1e-9) <= ratio <= known[-1] * (1 + 1e-9):
        raise ValueError(f"B/d = {ratio:.4g} is outside the range of Yamashita's roll damping (5 to 10); give b_R")
    at_one_degree = np.interp(ratio, known, [YAMASHITA[r] for r in known])
    # N = ρ∇ (B/2)² (b_R √ξ_B) ω at 1°, in proportion to the amplitude
    return Quadratic(density * length * beam * draft * (beam / 2) ** 2 * at_one_degree / (LOSS * np.radians(1.0)))


def report_scale(dof, length, beam, draft, density, gravity):
    """`Tabulated.scale` of the report's b for "Heave" or "Roll"; pitch like roll, with length and beam exchanged"""
    if dof == "Pitch":
        length, beam = beam, length
    return density * length * beam * draft * np.sqrt(beam / (2 * gravity)) * (1 if dof == "Heave" else (beam / 2) ** 2)


def linearised_response(omega, added_mass, damping, excitation, inertia, stiffness, viscous, most=200):
    """Motion amplitudes (headings, n) per unit wave amplitude in waves of `viscous.wave_amplitude`, and B' (m, n, n).

    The assumed amplitude and the resulting amplitude change in opposite directions. Their geometric mean is the
    solution where damping alone limits the motion, and the iteration converges elsewhere. raises :
    FloatingPointError if the iteration does not converge
    """
    motions, equivalent = [], []
    size = np.diag(stiffness) + omega**2 * np.diag(inertia + added_mass)
    for force in excitation:
        assumed = viscous.wave_amplitude * np.abs(force) / size
        for _ in range(most):
            extra = viscous.damping(omega, assumed)
            X = response(omega, added_mass, damping + extra, force[None], inertia, stiffness)[0]
            found = viscous.wave_amplitude * np.abs(X)
            if np.all(np.abs(found - assumed) <= 1e-10 * found.max()):
                break
            # a motion without a force of its own starts from the response to coupled motions
            assumed = np.where(assumed > 0, np.sqrt(assumed * found), found)
        else:
            raise FloatingPointError(f"ω = {omega:.6g} rad/s: equivalent viscous damping was not found in {most} steps")
        motions.append(X)
        equivalent.append(extra)
    return np.array(motions), np.array(equivalent)
