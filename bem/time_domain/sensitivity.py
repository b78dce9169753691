"""How far a moored body answers an error of its memory: where motion is damped lightly, memory has to be nearer.

An error E (6, 6) of the impedance moves a free decay by up to E / (e B) of its start, with B all damping at the natural
frequency: by the admittance of the body on its springs.  With the restoring forces C of the water, and a little damping
that every moored body has besides waves,

    Y = [H − iω (M + A∞) + iC/ω + 2ζω (M + A)]⁻¹,        its diagonal times that of the largest H.

Springs of moorings are not known here.  They hold surge, sway and yaw, softer than the water holds heave: below the
natural frequency of heave these count as resonant at every frequency, if that answers more.
"""

from __future__ import annotations

import numpy as np

HELD = (0, 1, 5)
SHARES = np.array([0.05, 0.05, 0.01, 0.01, 0.01, 0.05])  # ζ of critical damping
NEAR = 0.05  # of a frequency, by which a mooring moves the natural ones of heave, roll and pitch


def sensitivity(body, omega, transform, added_mass_infinity, size):
    """(q, 6) diagonal of Y times size² at omega (q,) rad/s, 0 of a body without mass or restoring forces

    transform : (q, 6, 6) kg/s … H; size : (6,) square root of the largest of each motion
    """
    out = np.zeros((len(omega), 6))
    M, C = body.inertia, body.stiffness
    if M is None or C is None or not (np.all(np.isfinite(M)) and np.all(np.isfinite(C))):
        return out
    w = omega[:, None, None]
    total = M + added_mass_infinity - transform.imag / w  # M + A
    own = np.einsum("qii->qi", total)
    damped = transform.real + np.eye(6) * (2 * SHARES * own * omega[:, None])[:, None]
    free = omega**2 * own[:, 2] < C[2, 2]
    held = C + np.zeros_like(total)
    for i in HELD:
        held[free, i, i] = (omega**2 * own[:, i])[free]
    for springs in (C, held):
        Y = np.linalg.inv(damped + 1j * (springs / w - w * total))
        out = np.maximum(out, np.abs(np.einsum("qii->qi", Y)) * size**2)
    near = np.abs(np.log(omega[:, None] / omega)) <= NEAR
    return np.array([out[some].max(axis=0) for some in near])
