"""Sensitivity of a moored body to an error of its memory; lightly damped motions have a larger sensitivity.

An error E (6, 6) of the impedance changes a free decay by up to E / (e B) of its initial amplitude, with B the whole
damping at the natural frequency. The effect is proportional to the admittance Y of the body on its springs. With the
restoring forces C of the water, and the small damping that every moored body has in addition to wave radiation,

    Y = [H − iω (M + A∞) + iC/ω + 2ζω (M + A)]⁻¹,        its diagonal times the diagonal of the largest H.

Springs of moorings are unknown here.  Moorings restrain surge, sway and yaw more softly than hydrostatics restrains
heave. Surge, sway and yaw are therefore taken as resonant at every frequency below the natural frequency of heave, if
this gives a larger sensitivity.
"""

import numpy as np

HELD = (0, 1, 5)  # degrees of freedom of each body that are fixed: surge, sway, yaw
SHARES = np.array([0.05, 0.05, 0.01, 0.01, 0.01, 0.05])  # ζ of critical damping
OF_SHAPES = 0.01  # and of bodies that bend
NEAR = 0.05  # relative shift of the natural frequencies of heave, roll and pitch by a mooring


def sensitivity(body, omega, transform, added_mass_infinity, size, rigid=None):
    """Diagonal of Y times size² at omega (q,) rad/s; shape (q, n); 0 for bodies without mass or restoring forces

    transform : H, kg/s …, (q, n, n); size : square root of the largest H of each motion, (n,)
    rigid : number of rigid motions, which come first; if None, all motions are rigid
    """
    count, rigid = len(size), len(size) if rigid is None else rigid
    out = np.zeros((len(omega), count))
    M, C = body.inertia, body.stiffness
    if M is None or C is None or not (np.all(np.isfinite(M)) and np.all(np.isfinite(C))):
        return out
    w = omega[:, None, None]
    total = M + added_mass_infinity - transform.imag / w  # M + A
    own = np.einsum("qii->qi", total)
    shares = np.append(np.tile(SHARES, rigid // 6), np.full(count - rigid, OF_SHAPES))
    damped = transform.real + np.eye(count) * (2 * shares * own * omega[:, None])[:, None]
    held = C + np.zeros_like(total)
    for first in range(0, rigid, 6):
        free = omega**2 * own[:, first + 2] < C[first + 2, first + 2]
        for i in HELD:
            held[free, first + i, first + i] = (omega**2 * own[:, first + i])[free]
    for springs in (C, held):
        Y = np.linalg.inv(damped + 1j * (springs / w - w * total))
        out = np.maximum(out, np.abs(np.einsum("qii->qi", Y)) * size**2)
    near = np.abs(np.log(omega[:, None] / omega)) <= NEAR
    return np.array([out[some].max(axis=0) for some in near])
