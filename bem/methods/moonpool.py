"""Piston mode of the water in a moonpool: its resonance frequency, and the rise of the water in waves on a held hull.

The mean rise of the water is computed on a damping lid whose damping is zero (`bem.panels.damping_lid`).  Around its
resonance the water rises like a mass on a spring, and 1 / rise is a smooth function of ω². Values of 1 / rise at
three frequencies give a parabola, and its smallest modulus gives the next frequency. For a ring of 1 600 panels with
one node each, the resonance frequency is 0.7 % and the rise 2 % too low. If the gap under the keel is a fifth of the
draft, the frequency is 2 % too low and the rise is exact.
"""

from typing import NamedTuple

import numpy as np

from hakobune.meshing.panels import with_symmetry
from hakobune.meshing.surface.patches import mirrored_in

from ..panels.damping_lid import DampingLid
from .panel_problem import PanelProblem

START = np.array([0.8, 0.95, 1.05])  # first frequencies, over that of a formula
RANGE = 0.5, 1.3  # of the search, likewise
CLOSE, MOST = 2e-3, 8  # relative step that ends the search, and most steps
MOST_NODES = 1500  # of a symmetric part of the hull; a frequency then takes a second
FEW_NODES = 600  # up to which a panel has four


class Piston(NamedTuple):
    """omega : frequency of the largest rise, rad/s
    rise : amplitude of the water over the amplitude of the wave, for the heading with the largest rise"""

    omega: float
    rise: float


def piston(mesh, corners, depth, headings, near, gravity=9.80665):
    """`Piston` of the moonpool with `corners` (k, 2) in a held hull; None for too many panels, or if the rise has no
    peak.

    mesh : PanelMesh of the hull; near : resonance frequency by a formula, rad/s; headings : headings of waves, rad,
        (m,)
    Raises ValueError for a moonpool that is not convex.
    """
    lids = (DampingLid(corners, 0.0),)
    whole = with_symmetry(mesh, mirrored_in([corners], mesh.symmetry))
    if len(whole) > MOST_NODES:
        return None
    nodes = 4 if 4 * len(whole) <= FEW_NODES else 1
    problem = PanelProblem(whole, nodes_per_panel=nodes, damping_lids=lids, depth=depth, gravity=gravity).prepared()

    def rise(omega):
        return problem.run(omega, headings, {"diffraction_force"}, None, ("Heave",)).mean_rise

    found = _largest(rise, near)
    return None if found is None else Piston(*found)


def _largest(rise, near):
    """Frequency, rad/s, and size of the largest rise around `near`, None if there is none

    rise : function of ω, complex, (m,) of some headings
    """
    omegas, values = list(near * START), [rise(omega) for omega in near * START]
    for _ in range(MOST):
        last = omegas[int(np.argmax([np.abs(v).max() for v in values]))]
        omega = _next(omegas, values, near)
        if abs(omega - last) < CLOSE * last:
            break
        omegas.append(omega)
        values.append(rise(omega))
    sizes = [float(np.abs(v).max()) for v in values]
    best = int(np.argmax(sizes))
    inside = RANGE[0] * near < 0.99 * omegas[best] and 1.01 * omegas[best] < RANGE[1] * near
    return (float(omegas[best]), sizes[best]) if inside else None


def _next(omegas, values, near):
    """Where the parabola through 1 / rise at the largest and its two neighbours in size is smallest, rad/s"""
    order = np.argsort([-np.abs(v).max() for v in values])[:3]
    heading = int(np.argmax(np.abs(values[order[0]])))
    s = np.array([omegas[i] for i in order]) ** 2 / near**2
    parabola = np.polyfit(s, [1 / values[i][heading] for i in order], 2)
    fine = np.linspace(*np.square(RANGE), 2001)
    return near * float(np.sqrt(fine[np.argmin(np.abs(np.polyval(parabola, fine)))]))
