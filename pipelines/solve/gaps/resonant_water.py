"""Water between hulls and in moonpools that oscillates vertically as one mass, reported if no damping lid is on it.

Its natural frequency, from the mass of the water and of the water below that moves with it:

    gap of width b between hulls of draft d and width B in all     ω² = g / (d + b/π (3/2 + ln(B/2b)))     Molin (2001)
    moonpool of area S                                             ω² = g / (d + 0.41 √S)                 Fukuda (1977)

The first formula is for two dimensions and deep water; in water twice as deep as the draft it is 5 % too high.
"""

import math

import numpy as np

from hakobune.meshing.surface.patches import moonpools

NARROW = 1.0  # width over the draft above which a gap does not trap its water
SPREAD = 1.15  # largest ratio of the frequency by the formulas to the true one


def resonant_water(scene, mesh, gaps=()):
    """Messages on the gaps and moonpools of a scene without damping lids whose resonance is among its waves.

    gaps : [(names of two bodies, m between them, m of draft, m of width of both and of the gap)]
    """
    if scene.damping_lids:
        return ()
    g, said = scene.water.gravity, []
    for names, gap, draft, width in gaps:
        if gap <= NARROW * draft:
            own = math.sqrt(g / (draft + gap / math.pi * (1.5 + math.log(width / (2 * gap)))))
            said.append((f"the water between {names}, {gap:.3g} m wide,", own))
    for corners in _moonpools(mesh) if mesh.bodies == 1 else ():
        x, y = corners[:, 0], corners[:, 1]
        area = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
        said.append(
            (f"the water of the moonpool of {area:.3g} m²", math.sqrt(g / (mesh.draft + 0.41 * math.sqrt(area))))
        )
    omegas = scene.omegas()
    return tuple(
        f"{water} resonates near T = {2 * math.pi / own:.3g} s; without losses the computed elevation and forces are "
        "several times too large; give [[damping_lids]] with damping 0.02 to 0.07 for the loss in eddies"
        for water, own in said
        if omegas[0] / SPREAD <= own <= omegas[-1] * SPREAD
    )


def _moonpools(mesh):
    """Empty for a hull whose waterline is open, which its own findings report"""
    try:
        return moonpools(mesh)
    except ValueError:
        return []
