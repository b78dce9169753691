"""Floating sections side by side in beam waves, free or connected by hinges.

    {−ω²[M + A] − iωB + C} ξ = F + Gᵀμ,    G ξ = 0

with ξ the sway, heave and roll of each section about its centre of gravity, per metre of length.
A row of G requires that the point of a hinge moves equally on both sections or, for a rigid hinge, that both sections
rotate equally. μ is the hinge force.  `bem.hinges` has the equations in three dimensions.  Conventions are those of
`coefficients`.
"""

from typing import NamedTuple

import numpy as np

from .any_section import TOLERANCE
from .outline import Wetted
from .side_by_side import flow_of, in_gaps, taken_of

KINDS = ("hinge", "rigid")


class Floating(NamedTuple):
    """A section at y, m.

    mass : kg/m; if None, the mass of the displaced water; center : z of the centre of gravity, m
    gyration : radius of gyration about the centre of gravity, m; fixed : whether the section is fixed
    """

    wetted: Wetted
    y: float
    mass: float | None = None
    center: float = 0.0
    gyration: float = 0.0
    fixed: bool = False


class Hinge(NamedTuple):
    """A hinge at (y, z), m, between two sections given by their indices; kind : one of KINDS"""

    sections: tuple[int, int]
    y: float
    z: float
    kind: str = "hinge"


class LinkedSections(NamedTuple):
    """Results of one frequency in a wave of 1 m towards +y.

    motions : sway, heave and roll about each centre of gravity, complex, m, m, rad, (n, 3); 0 for fixed sections
    held : forces in sway, heave and roll of the first section on the second, complex, N/m, N/m, N, (hinges, 3)
    gains : amplitude of the mean rise of the water in each gap over the wave amplitude, (gaps,)
    reflection, transmission : complex, both referred to y = 0; taken : share of the wave energy absorbed by the gaps
    """

    omega: float
    motions: np.ndarray
    held: np.ndarray
    gains: np.ndarray
    reflection: complex
    transmission: complex
    taken: float


def linked_sections(
    sections, depth, omega, hinges=(), damping=0.0, *, density=1025.0, gravity=9.80665, tolerance=TOLERANCE
):
    """`LinkedSections` of one frequency.

    sections : [`Floating`] from left to right; depth : m; omega : rad/s; hinges : [`Hinge`]; damping : ε of all gaps
    raises : ValueError for the reasons of `side_by_side.side_by_side`, for a hinge of a section with itself, and for
        motions with neither stiffness nor inertia
    """
    made = [(one.wetted, one.y) for one in sections]
    points = [one.y + one.wetted.center.real + 1j * one.center for one in sections]

    def velocities(p, n, owner):
        arms = [p - q for q in points]
        each = [np.stack([n.real, n.imag, a.real * n.imag - a.imag * n.real], axis=1) for a in arms]
        return np.hstack([part * (owner == i)[:, None] for i, part in enumerate(each)])

    flow = flow_of(made, depth, omega, damping, gravity, tolerance, velocities)
    size = 3 * len(sections)
    water = -density * flow.forces(flow.potentials[:, :size])
    force = -1j * density * omega * (flow.forces(flow.potentials[:, size]) + flow.incident_forces)
    inertia, stiffness = (np.zeros((size, size)) for _ in range(2))
    for i, one in enumerate(sections):
        own = slice(3 * i, 3 * i + 3)
        inertia[own, own], stiffness[own, own] = _at_rest(one, density, gravity)
    dynamic = -(omega**2) * (inertia + water) + stiffness
    rows = np.vstack([np.zeros((0, size)), *(_rows(one, points) for one in hinges)])
    fixed = [d for i, one in enumerate(sections) if one.fixed for d in range(3 * i, 3 * i + 3)]
    free = np.delete(np.arange(size), fixed)
    xi = np.zeros(size, complex)
    basis = _null_space(rows[:, free])
    held = basis.T @ dynamic[np.ix_(free, free)] @ basis
    if basis.shape[1] and np.linalg.cond(held / _scale(held)) > 1e12:
        raise ValueError(
            f"a motion at omega {omega:g} rad/s has neither inertia nor stiffness, so it is not "
            f"determined; give mass and gyration"
        )
    xi[free] = basis @ np.linalg.solve(held, basis.T @ force[free]) if basis.shape[1] else 0.0
    left = (dynamic @ xi - force)[free]
    forces = np.linalg.lstsq(rows[:, free].T, left, rcond=None)[0] if len(rows) else np.zeros(0)
    back, on = -1j * omega * (flow.waves[:, :size] @ xi) / (-1j * gravity / omega)
    R, T = flow.scattered(+1)
    rise = in_gaps(flow, -1j * omega * xi)
    return LinkedSections(
        omega, xi.reshape(-1, 3), _each(hinges, forces), np.abs([mean for mean, _ in rise]), complex(R + back),
        complex(T + on), taken_of(flow, depth, damping, rise),
    )  # fmt: skip


def _at_rest(one, density, gravity):
    """Inertia and stiffness (3, 3) of a section about its centre of gravity, per metre"""
    wetted = one.wetted
    weight = density * wetted.area
    mass = weight if one.mass is None else one.mass
    inertia = np.diag([mass, mass, mass * one.gyration**2])
    middle, arm = 0.5 * (wetted.left + wetted.right), wetted.waterline
    off = middle - wetted.center.real  # m, middle of the waterplane from the centre of gravity
    roll = gravity * (density * (arm**3 / 12 + arm * off**2) + weight * (wetted.center.imag - one.center))
    return inertia, np.array([[0, 0, 0], [0, density * gravity * arm, density * gravity * arm * off],
                              [0, density * gravity * arm * off, roll]])  # fmt: skip


def _rows(hinge, points):
    """Displacement of the second section relative to the first at a hinge; shape (2 or 3, 3n)"""
    a, b = hinge.sections
    if a == b or not (0 <= a < len(points) and 0 <= b < len(points)):
        raise ValueError(
            f"a hinge joins sections {a} and {b}; allowed: two different sections from 0 to {len(points) - 1}"
        )
    out = np.zeros((3, 3 * len(points)))
    for i, sign in ((a, -1.0), (b, 1.0)):
        arm = hinge.y + 1j * hinge.z - points[i]
        out[:, 3 * i : 3 * i + 3] = sign * np.array([[1, 0, -arm.imag], [0, 1, arm.real], [0, 0, 1]])
    return out if hinge.kind == "rigid" else out[:2]


def _null_space(rows):
    """Motions that rows leave free; shape (n, m)"""
    _, sizes, axes = np.linalg.svd(rows)
    return axes[int(np.sum(sizes > 1e-9 * max(sizes, default=1.0))) :].T


def _scale(matrix):
    size = np.sqrt(np.abs(np.diag(matrix))) + 1e-300
    return np.outer(size, size)


def _each(hinges, forces):
    """Forces of all hinges, from their multipliers; shape (hinges, 3)"""
    out, first = np.zeros((len(hinges), 3), complex), 0
    for i, hinge in enumerate(hinges):
        count = 3 if hinge.kind == "rigid" else 2
        out[i, :count] = forces[first : first + count]
        first += count
    return out
