"""Exact potential and flux of a flat quadrilateral with a bilinear density.

In the axes x, y of the panel (origin at the centroid), for m = 1, x, y, xy, these are

    S_m = ∬ m / r dS,    D_m = ∬ m ∂(1/r)/∂n dS = ∬ m (P − Q)·n / r³ dS

S₁ is computed from the edges (Hess & Smith 1967, Newman 1986), and D₁ as the solid angle of two triangles (van
Oosterom & Strackee 1983).
The higher moments follow from Gauss' theorem in the plane: with u, v measured from the projection of P on the plane,
u/r = ∂r/∂u
and u/r³ = −∂(1/r)/∂u, so that only ∫ r dl, ∫ dl/r, ∫ l r dl and ∫ l dl/r along the edges remain. D is zero
(principal value) if P lies in the plane of the panel.
"""

import math

from ..kernels.jit import kernel


@kernel()
def panel_moments(x, y, z, corners, S, D):
    """S_m and D_m of one panel at the point (x, y, z), in the axes of the panel, with z along the normal.

    corners : corners, counter-clockwise, m, (4, 2)
    S, D : arrays to be filled with the moments for 1, x, y, xy, (4,), or for 1 only, (1,)
    """
    flat = abs(z) < 1e-10 * (
        abs(corners[0, 0] - x) + abs(corners[0, 1] - y) + abs(corners[2, 0] - x) + abs(corners[2, 1] - y)
    )
    if flat:
        z = 0.0
    s00 = s10 = s01 = s11 = 0.0
    j10 = j01 = j11 = 0.0
    for i in range(4):
        k = (i + 1) % 4
        u, v = corners[i, 0] - x, corners[i, 1] - y
        eu, ev = corners[k, 0] - corners[i, 0], corners[k, 1] - corners[i, 1]
        length = math.sqrt(eu * eu + ev * ev)
        if length == 0.0:
            continue
        tu, tv = eu / length, ev / length
        nu, nv = tv, -tu
        away = u * nu + v * nv
        start = u * tu + v * tv
        end = start + length
        square = away * away + z * z
        a, b = math.sqrt(square + start * start), math.sqrt(square + end * end)
        total = a + b
        # the logarithm is infinite on the edge itself, where its factor, a distance, is zero
        log = math.log((total + length) / (total - length)) if total - length > 1e-14 * total else 0.0
        s00 += away * log
        if len(S) > 1:
            along = 0.5 * (end * b - start * a + square * log)
            foot_v = away * nv
            j10 -= nu * log
            j01 -= nv * log
            j11 -= nu * (foot_v * log + tv * (b - a))
            s10 += nu * along
            s01 += nv * along
            s11 += nu * (foot_v * along + tv * (b * b * b - a * a * a) / 3.0)
    angle = 0.0 if flat else _solid_angle(x, y, z, corners)
    S[0], D[0] = s00 - z * angle, angle
    if len(S) > 1:
        s00 = S[0]
        S[1], D[1] = s10 + x * s00, z * j10 + x * angle
        S[2], D[2] = s01 + y * s00, z * j01 + y * angle
        S[3] = s11 + x * s01 + y * s10 + x * y * s00
        D[3] = z * (j11 + x * j01 + y * j10) + x * y * angle


@kernel()
def _solid_angle(x, y, z, corners):
    """Solid angle of a quadrilateral seen from (x, y, z), positive for z > 0."""
    ax, ay = corners[0, 0] - x, corners[0, 1] - y
    bx, by = corners[1, 0] - x, corners[1, 1] - y
    cx, cy = corners[2, 0] - x, corners[2, 1] - y
    dx, dy = corners[3, 0] - x, corners[3, 1] - y
    zz = z * z
    a, b = math.sqrt(ax * ax + ay * ay + zz), math.sqrt(bx * bx + by * by + zz)
    c, d = math.sqrt(cx * cx + cy * cy + zz), math.sqrt(dx * dx + dy * dy + zz)
    ab, bc, ac = ax * bx + ay * by + zz, bx * cx + by * cy + zz, ax * cx + ay * cy + zz
    cd, ad = cx * dx + cy * dy + zz, ax * dx + ay * dy + zz
    one = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    two = (cx - ax) * (dy - ay) - (cy - ay) * (dx - ax)
    return 2 * (
        math.atan2(z * one, a * b * c + ab * c + ac * b + bc * a)
        + math.atan2(z * two, a * c * d + ac * d + ad * c + cd * a)
    )
