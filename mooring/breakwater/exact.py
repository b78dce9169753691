"""A body in waves by potential theory: fixed, free, and on taut lines (`taut`).

    (−ω²(M + A) − iωB + C) x = F,       K_T = T + Σ xⱼ ηⱼ,       K_R = R + Σ xⱼ ηⱼ⁻

A, B, F, R, T, and the waves η, η⁻ radiated to leeward and seaward, come from a `Section`. On taut lines x = m q, and
the equation is projected on m, the mode of `body.OnTautLines`; the remaining force is the pull of the lines.
Without losses |K_T|² + |K_R|² = 1 for any mooring.
"""

from typing import NamedTuple

import numpy as np

from .long_waves import FixedBody
from .taut import TautMotion, warn_if_unstable

SWAY, HEAVE, ROLL = range(3)


class FreeMotion(NamedTuple):
    """transmission, reflection : complex, m/m; motion : (3,) sway, heave, roll about the centre of gravity"""

    transmission: complex
    reflection: complex
    motion: np.ndarray


def fixed_exact(section):
    """`FixedBody` of a `Section`"""
    return FixedBody(section.transmission, section.reflection, section.excitation[SWAY], section.excitation[HEAVE])


def free_exact(body, section):
    """`FreeMotion` of a `FloatingBody`; section : `Section` at its draft. Raises ValueError if the body capsizes."""
    check_section(body, section)
    if body.roll_stiffness <= 0:
        height = body.roll_stiffness / (body.density * body.gravity * body.area)
        raise ValueError(
            f"metacentric height {height:.3g} m without lines: the body capsizes; lower its centre of gravity"
        )
    to_origin = moved_to_origin(body.z0)
    stiffness = np.diag([0.0, body.heave_stiffness, body.roll_stiffness])
    impedance, force = about_gravity(section, to_origin)
    mass = np.diag([body.mass, body.mass, body.inertia])
    motion = np.linalg.solve(stiffness - section.omega**2 * mass + impedance, force)
    return FreeMotion(*far_field(section, to_origin @ motion), motion)


def taut_exact(body, section):
    """`TautMotion` of a `TautBody` or `TautRectangle` at one frequency; section : `Section` of its moored draft"""
    check_section(body, section)
    warn_if_unstable(body)
    to_origin = moved_to_origin(body.z0)
    impedance, force = about_gravity(section, to_origin)
    sway_roll = np.ix_((SWAY, ROLL), (SWAY, ROLL))
    dynamic = impedance[sway_roll] - section.omega**2 * np.diag([body.mass, body.inertia])
    horizontal = force[[SWAY, ROLL]]
    of_lines = dynamic @ body.mode + body.restoring
    q = body.mode @ horizontal / (body.mode @ of_lines)
    difference = body.line_difference(of_lines * q - horizontal)
    both = force[HEAVE] / np.sin(body.angle)
    motion = np.array([body.mode[0], 0.0, body.mode[1]]) * q
    transmitted, reflected = far_field(section, to_origin @ motion)
    front, back = (both - difference) / 2, (both + difference) / 2
    return TautMotion(transmitted, reflected, motion[SWAY], motion[ROLL], front, back)


def about_gravity(section, to_origin):
    """−ω²A − iωB and F for motions about the centre of gravity"""
    impedance = -section.omega * (section.omega * section.added_mass + 1j * section.damping)
    return to_origin.T @ impedance @ to_origin, to_origin.T @ section.excitation


def moved_to_origin(z):
    """Motions of the origin from the motions of a point at z: the origin sways by zθ more than the point"""
    matrix = np.eye(3)
    matrix[SWAY, ROLL] = z
    return matrix


def far_field(section, motion):
    """K_T and K_R, complex, of sway, heave and roll (3,) about the origin per unit wave amplitude"""
    return section.transmission + section.radiated @ motion, section.reflection + section.radiated_back @ motion


def check_section(body, section):
    """Raises ValueError unless a `Section` has the body's width and draft, and its water"""
    there = (section.beam, section.draft, section.depth, section.density, section.gravity)
    asked = (body.waterline, body.draft, body.depth, body.density, body.gravity)
    if not np.allclose(there, asked, rtol=1e-12, atol=0):
        raise ValueError(
            f"the section has beam, draft, depth, density and gravity {there}, but the body has {asked}; give the "
            f"section of this body"
        )
