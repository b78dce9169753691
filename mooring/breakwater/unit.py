"""A breakwater of finite length on its lines: the section of `body` extended over the length L, in six degrees of
freedom.

    water   C = ρg {L B_w,  L B_w³/12 + V (z_B − z),  L³ B_w/12 + V (z_B − z)}  of heave, roll, pitch
    lines   K = Σ Jᵀ {(EA/S) u uᵀ + (P₀/S)(1 − u uᵀ)} J  +  P₀ {(u·r) 1 − ½ (u rᵀ + r uᵀ)}  for rotations

J is the motion of a line's upper end at r, and u its direction to the anchor; the sum is over pairs of lines along
the body. In sway, heave and roll, K per metre equals that of `elastic`. Moments are about (0, 0, z) and include the
weight at z₀.  EA/S of taut lines is chosen so that the lines are `STIFF` times as stiff as the water; the relative
error of this constraint is 1/`STIFF`.
"""

import numpy as np

STIFF = 1e6


def inertia(body, length, center):
    """Inertia of a `FloatingBody` over `length`, m, about (0, 0, center), kg, kg m, kg m²; shape (6, 6); the section
    has equal radii of gyration about both of its axes"""
    mass, arm = body.mass * length, body.z0 - center
    matrix = np.diag([mass, mass, mass, 0.0, 0.0, 0.0])
    matrix[1, 3] = matrix[3, 1] = -mass * arm
    matrix[0, 4] = matrix[4, 0] = mass * arm
    across = body.inertia * length / 2  # half of the polar moment of the section for each axis in its plane
    along = mass * length**2 / 12
    matrix[3, 3] = body.inertia * length + mass * arm**2
    matrix[4, 4] = along + across + mass * arm**2
    matrix[5, 5] = along + across
    return matrix


def buoyancy(body, length, center):
    """Hydrostatic stiffness due to water pressure and weight, N/m, N, N m; shape (6, 6)"""
    weight, width = body.density * body.gravity, body.waterline
    righting = weight * body.area * length * (body.buoyancy_z - center)
    righting -= body.mass * length * body.gravity * (body.z0 - center)
    matrix = np.zeros((6, 6))
    matrix[2, 2] = weight * width * length
    matrix[3, 3] = weight * length * width**3 / 12 + righting
    matrix[4, 4] = weight * length**3 * width / 12 + righting
    return matrix


def line_matrix(body, length, center, spacing, axial_stiffness=None):
    """Stiffness of the lines of a `TautBody` over `length`, m, in pairs at distances of about `spacing`, m; shape
    (6, 6)

    axial_stiffness : EA, N per metre of body, None for lines that do not stretch
    """
    spring = springs(body, length, axial_stiffness)
    matrix, (places, share) = np.zeros((6, 6)), pairs(length, spacing)
    for x in places:
        for u, r, moved in ends(body, x, center):
            along = u @ moved
            across = moved.T @ moved - np.outer(along, along)
            matrix += share * (spring * np.outer(along, along) + body.pretension / body.line * across)
            turned = (np.outer(u, r) + np.outer(r, u)) / 2
            matrix[3:, 3:] += share * body.pretension * ((u @ r) * np.eye(3) - turned)
    return matrix


def tensions(body, length, center, spacing, axial_stiffness, motion):
    """Amplitudes δP, N per metre, of front and back lines along the body, (…, 2, pairs), complex

    motion : (…, 6) about (0, 0, center), m and rad
    """
    spring = springs(body, length, axial_stiffness)
    rows = [[u @ moved for u, _, moved in ends(body, x, center)] for x in pairs(length, spacing)[0]]
    return -spring * np.einsum("...i,xei->...ex", motion, np.array(rows))


def springs(body, length, axial_stiffness):
    """EA/S per metre of body, N/m²"""
    if axial_stiffness is not None:
        return axial_stiffness / body.line
    return STIFF * body.heave_stiffness


def pairs(length, spacing):
    """Positions x (n,) m of the pairs of lines along the body, and the length of body for each pair, m"""
    count = max(1, round(length / spacing))
    return (np.arange(count) + 0.5) * length / count - length / 2, length / count


def ends(body, x, center):
    """Ends of the front and the back line at x: u (3,), r (3,) from (0, 0, center), and J (3, 6)"""
    s, c, below = np.sin(body.angle), np.cos(body.angle), body.attachment_z - center
    for side in (-1.0, 1.0):
        u, r = np.array([0.0, side * c, -s]), np.array([x, side * body.attachment, below])
        turn = np.array([[0.0, r[2], -r[1]], [-r[2], 0.0, r[0]], [r[1], -r[0], 0.0]])  # ω × r
        yield u, r, np.hstack([np.eye(3), turn])
