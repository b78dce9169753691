"""A rectangular section with head loss under the keel: potential flow, without further approximation, with a
resistance across the gap.

    p(0⁻) − p(0⁺) = ½ρC |U| U  →  (4/3π) ρ C |U| U,     U the amplitude of the mean velocity under the keel at y = 0

A flow g, driven by a potential of ±1 on the two halves of the gap, is added to every flow that is odd in y:

    δ = iκU,   κ = (2C/3πω) |U|,      U = U₀ + δ U_g,      φ = φ₀ + δ φ_g,      δ = iκ U₀ / (1 − iκ U_g)

For a resistance κ, in m, the result is a `Section`, which is used like any other section.  The lost power is the
power of the head loss, ½ (4/3π) ρ C |U|³ s.
The symmetric flow (heave) carries no water under the keel from one side to the other.
The loss is linearised as in `mooring.breakwater.loss`, which applies to any section but only to the propagating wave.
"""

from typing import NamedTuple

import numpy as np

from .coefficients import HEAVE, ROLL, SWAY, Section, section, section_flow
from .finite_depth import FIXED, SectionFlow


class KeelFlow(NamedTuple):
    """The flows past a rectangle at one frequency, for sway, heave and roll.

    section : `Section` without loss; moved : U at y = 0 for unit velocities, (3,); scattered : U for a unit wave
    own : U_g, 1/m; force : ∮ φ_g n dl, (3,)
    wave : elevation that g radiates towards +y over the elevation of a unit of φ at z = 0
    """

    section: Section
    moved: np.ndarray
    scattered: complex
    own: complex
    force: np.ndarray
    wave: complex

    def through(self, motion):
        """U₀, m/s per unit wave amplitude, for motions (3,) about the origin"""
        return self.scattered - 1j * self.section.omega * (self.moved @ motion)

    def resisted(self, kappa):
        """`Section` with a resistance κ, m"""
        there, share = self.section, 1j * kappa / (1 - 1j * kappa * self.own)
        rho, omega, g = there.density, there.omega, there.gravity
        impedance = there.added_mass + 1j * there.damping / omega
        impedance = impedance - rho * share * np.outer(self.force, self.moved)
        waves = omega**2 / g * share * self.moved * self.wave
        lost = share * self.scattered * self.wave / (-1j * g / omega)
        R, T = there.reflection - lost, there.transmission + lost
        return there._replace(
            added_mass=impedance.real,
            damping=omega * impedance.imag,
            excitation=there.excitation - 1j * rho * omega * share * self.scattered * self.force,
            radiated=there.radiated + waves,
            radiated_back=there.radiated_back - waves,
            reflection=complex(R),
            transmission=complex(T),
            haskind=np.full(3, np.nan + 0j),  # not defined for a flow with losses
            drift=there.drift * (1 + abs(R) ** 2 - abs(T) ** 2) / (2 * abs(there.reflection) ** 2),
        )


def keel_flow(beam, draft, depth, omega, *, density=1025.0, gravity=9.80665, tolerance=1e-6):
    """`KeelFlow` of a rectangle in finite depth; arguments as in `coefficients.section`.  Raises ValueError."""
    there = section(beam, draft, depth, omega, density=density, gravity=gravity, tolerance=tolerance)
    flow = section_flow(beam, draft, depth, omega, gravity=gravity, tolerance=tolerance)
    gap, profiles, f = flow.shape.gap, flow.shape.profiles, len(flow.shape.gap.mean)
    matrix = profiles @ (flow.shape.beneath[False].matrix - flow.outside[:f, :f]) @ profiles.T
    driven = SectionFlow(-np.linalg.solve(matrix, profiles @ gap.mean) @ profiles, 0.0, FIXED, 0.0)
    mean = gap.mean / gap.height
    moved = np.array([mean @ one.velocity if mode != HEAVE else 0.0 for mode, one in enumerate(flow.radiated)])
    force = np.array([flow.force(driven, SWAY), 0.0, flow.force(driven, ROLL) - (beam / 2) ** 2])
    wave = flow.sent(driven)
    moved[ROLL] += (beam / 2) ** 2 / 2 / gap.height  # velocity at y = 0, of the flux by the hull's bottom to its edge
    return KeelFlow(there, moved, mean @ flow.diffracted[0].velocity, mean @ driven.velocity, force, wave)
