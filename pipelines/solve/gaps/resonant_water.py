"""Water between hulls and in moonpools that oscillates vertically as one mass; it is reported if no damping lid
covers it.

The natural frequency follows from the mass of this water and of the water below that moves with it:

    gap of width b between hulls of draft d and width B in all     ω² = g / (d + b/π (3/2 + ln(B/2b)))     Molin (2001)
    moonpool of area S                                             ω² = g / (d + 0.41 √S)                 Fukuda (1977)

The first formula is for two dimensions and deep water. In water twice as deep as the draft it is 5 % too high, in
shallower water 10 %.
Around this frequency two equal rectangles are solved (`bem.sections.side_by_side`). They give the period, and the
rise of the water between long hulls. At a wall the gap counts twice, because of the image of the hull.

The second formula is for deep water. Over a low gap under the keel it is up to 40 % too high.  Around this frequency
the hull itself is solved (`bem.methods.moonpool`), if it has a draft, few enough panels, and no wall beside it.
"""

import math

import numpy as np

from hakobune.meshing.surface.patches import counter_clockwise, moonpools

NARROW = 1.0  # width over the draft above which a gap does not trap its water
SPREAD = 1.15  # largest ratio of the frequency by the formulas to the true one
SHALLOW = 1.5  # the same of a moonpool, where its hull can be solved
AROUND = np.linspace(0.8, 1.1, 9)  # frequencies over that of the formula in which the peak is looked for
REFINED = np.linspace(-0.9, 0.9, 7)  # of its steps, around the largest


def resonant_water(scene, mesh, gaps=()):
    """Messages on the gaps and moonpools of a scene without damping lids whose resonance is among its waves.

    gaps : [(names of two bodies, m of water between them, draft, m, width of both bodies and the gap, m, whether one
        stands on the bed)]
        If one stands on the bed, draft and width are those of the other body.
    """
    if scene.damping_lids:
        return ()
    g, said = scene.water.gravity, []
    for names, gap, draft, width, wall in gaps:
        if gap <= NARROW * draft:
            clear, whole = (2 * gap, 2 * width + 2 * gap) if wall else (gap, width)
            own = math.sqrt(g / (draft + clear / math.pi * (1.5 + math.log(whole / (2 * clear)))))
            sizes = clear, draft, (whole - clear) / 2
            said.append((f"the water between {names}, {gap:.3g} m wide,", own, sizes))
    found = [_message(water, own, sizes, scene) for water, own, sizes in said if _among(own, scene, SPREAD)]
    hulls = [("", mesh)]
    if mesh.bodies > 1:
        hulls = [(f" in {body.name}", mesh.of_body(i)) for i, body in enumerate(scene.bodies)]
    return (*found, *(text for where, hull in hulls for text in _of_moonpools(where, hull, scene)))


def _among(omega, scene, spread):
    """Whether a frequency that may be too high by a factor `spread`, or too low by `SPREAD`, is among the waves"""
    omegas = scene.omegas()
    return omegas[0] / SPREAD <= omega <= omegas[-1] * spread


def _of_moonpools(where, hull, scene):
    """The messages on the moonpools of a hull; where : words for it among several"""
    for corners in _moonpools(hull):
        x, y = corners[:, 0], corners[:, 1]
        area = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
        own, rise = math.sqrt(scene.water.gravity / (hull.draft + 0.41 * math.sqrt(area))), ""
        found = _piston(corners, hull, scene, own) if _among(own, scene, SHALLOW) else None
        if found is not None:
            own, rise = found.omega, f", with the hull held {'alone ' * bool(where)}{found.rise:.2g} times the wave"
        if _among(own, scene, SPREAD):
            yield _text(f"the water of the moonpool of {area:.3g} m²{where}", own, rise)


def _piston(corners, mesh, scene, near):
    """`bem.methods.moonpool.Piston`, or None where it cannot be solved"""
    from hakobune.bem.methods.moonpool import piston

    if scene.wall is not None or scene.solved_by == "pressure":
        return None
    try:
        polygon = counter_clockwise(corners)
    except ValueError:
        return None
    return piston(mesh, polygon, scene.water.depth, scene.headings(), near, scene.water.gravity)


def _message(water, own, sizes, scene):
    found = peak(*sizes, scene.water.depth, own, scene.water.gravity)
    omega, rise = (own, "") if found is None else (found[0], f", as long hulls {found[1]:.2g} times the wave")
    return _text(water, omega, rise)


def _text(water, omega, rise):
    return (
        f"{water} resonates near T = {2 * math.pi / omega:.3g} s; without losses its elevation and its forces are "
        f"several times too large{rise}; give [[damping_lids]] with damping 0.02 to 0.07 for the loss in eddies"
    )


def peak(gap, draft, width, depth, near, gravity):
    """Frequency, rad/s, and size, m per m, of the largest rise of the water between two equal rectangles, None if they
    cannot be solved

    gap, draft, width, depth : m; near : rad/s, by a formula
    """
    from hakobune.bem.sections.outline import rectangle
    from hakobune.bem.sections.side_by_side import side_by_side

    section, depth = rectangle(width, 2 * draft).wetted(draft), min(depth, 2 * math.pi * gravity / near**2)
    if depth <= draft:
        return None
    pair = [(section, -(width + gap) / 2), (section, (width + gap) / 2)]

    def largest(omegas):
        gains = [side_by_side(pair, depth, w, gravity=gravity, tolerance=1e-2).gains[0] for w in omegas]
        return omegas[int(np.argmax(gains))], max(gains)

    try:
        omega, _ = largest(near * AROUND)
        for step in near * (AROUND[1] - AROUND[0]) * np.array([1.0, 0.3, 0.1]):
            omega, gain = largest(omega + step * REFINED)
    except ValueError:
        return None
    return float(omega), float(gain)


def _moonpools(mesh):
    """Empty for a hull whose waterline is open, which its own findings report"""
    try:
        return moonpools(mesh)
    except ValueError:
        return []
