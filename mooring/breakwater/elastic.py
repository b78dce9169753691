"""The moored body of `taut` on elastic lines, by potential theory: sway, heave and roll are free.

    K = Σ Jᵀ {(EA/S) u uᵀ + (P₀/S) (1 − u uᵀ)} J + P₀ u·r e_θ e_θᵀ,      δP = −(EA/S) u · J x

where u is the direction from a line's upper end to its anchor, r the arm from the centre of gravity to the upper
end, and J the motion of this end. The second term is due to P₀ on a line that rotates. The last term of K is due to
the path of the upper end about the centre of gravity. EA/S → ∞ is the constraint of `taut`.
"""

from typing import NamedTuple

import numpy as np

from .exact import ROLL, about_gravity, check_section, far_field, moved_to_origin


class ElasticMotion(NamedTuple):
    """Complex amplitudes per unit wave amplitude.

    transmission, reflection : m/m; motion : sway, heave (m/m) and roll (rad/m) about the centre of gravity, (3,)
    front, back : tensions P_F and P_B, N/m²
    """

    transmission: complex
    reflection: complex
    motion: np.ndarray
    front: complex
    back: complex


def elastic_exact(body, section, axial_stiffness):
    """`ElasticMotion` of a `TautBody` or `TautRectangle`; section : section of its moored draft

    axial_stiffness : EA, N per metre of body

    Raises ValueError for a body that would not float upright on these lines.
    """
    if not 0 < axial_stiffness < np.inf:
        raise ValueError(f"EA is {axial_stiffness:g} N per metre of breakwater; allowed: above 0 and finite")
    check_section(body, section)
    stiffness, stretch = stiffness_of(body, axial_stiffness)
    softest = np.linalg.eigvalsh(stiffness / np.outer([1, 1, body.radius], [1, 1, body.radius]))[0]
    if softest <= 0:
        raise ValueError(
            f"the upright body is unstable: its smallest stiffness is {softest:.3g} N/m²; lower its centre of gravity"
        )
    to_origin = moved_to_origin(body.z0)
    impedance, force = about_gravity(section, to_origin)
    mass = np.diag([body.mass, body.mass, body.inertia])
    motion = np.linalg.solve(stiffness - section.omega**2 * mass + impedance, force)
    return ElasticMotion(*far_field(section, to_origin @ motion), motion, *(stretch @ motion))


def _lines(body):
    """u, r, and J of motions about the centre of gravity, for both lines, front first"""
    s, c, below = np.sin(body.angle), np.cos(body.angle), body.attachment_z - body.z0
    for side in (-1.0, 1.0):
        u, r = np.array([side * c, -s]), np.array([side * body.attachment, below])
        yield u, r, np.array([[1.0, 0.0, -r[1]], [0.0, 1.0, r[0]]])


def stiffness_of(body, axial_stiffness):
    """Stiffness of water and lines about the centre of gravity, (3, 3), and δP of front and back lines per unit
    motion, (2, 3)
    """
    stiffness, stretch = np.diag([0.0, body.heave_stiffness, body.roll_stiffness]), []
    for u, r, moved in _lines(body):
        along, across = u @ moved, np.array([-u[1], u[0]]) @ moved
        stiffness += axial_stiffness / body.line * np.outer(along, along)
        stiffness += body.pretension / body.line * np.outer(across, across)
        stiffness[ROLL, ROLL] += body.pretension * (u @ r)
        stretch.append(-axial_stiffness / body.line * along)
    return stiffness, np.array(stretch)
