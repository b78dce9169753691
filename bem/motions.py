"""First-order motions of a body that floats freely or is held by linear restraints.

{−ω²[M + A] − iω[B + B'] + [C + C']} X = F      (SR179 report 1982, section 2.1.2, time factor exp(−iωt))
"""

import numpy as np


def response(omega, added_mass, damping, excitation, inertia, stiffness):
    """Motion amplitudes X (headings, 6) per unit wave amplitude, m/m and rad/m, complex.

    added_mass, damping, inertia, stiffness : (6, 6), excitation : (headings, 6)
    """
    dynamic = -(omega**2) * (inertia + added_mass) - 1j * omega * damping + stiffness
    return np.linalg.solve(dynamic, excitation.T).T
