"""A line that rises out of the water: a part above the still level has its weight in air and no water loads.

An element with ends at z₁ and z₂ whose water weighs B when it is wholly wet gains

    E = B b Q(x),   x = z̄/b,   b² = (z₂ − z₁)² + (πD/4)²,   Q = max(x, 0) + y³/6,   y = max(0, 1 − |x|)

when above the water; its dry share is dE/d(B z̄) = Q′.  On a straight line the neighbours of an element lie z₂ − z₁
higher and lower. The dry shares of all elements add up to the length out of the water. A floating line that lies
level has the stiffness of its waterline, ρgD.  Forces on the ends are the derivatives of E. E is C², so the energy
balance closes and steps keep their order.  Drag, added mass and the force of accelerated water decrease with the
wet share 1 − Q′ of each element.
"""

from hakobune.bem.kernels.jit import kernel
from hakobune.bem.kernels.simd import WIDTH, address, choose_less, load_vector, repeated, root, store_vector

from .vectors import largest, more
from .workspace import BUOYANCY, DRAG_NORMAL, OF_WATER, ROUND, WHOLE


@kernel(inline=True, counted=False)
def place_of_surface(known, q, w, e):
    """The numbers x, y, 1/b and (z₂ − z₁)/b of eight elements from node e on"""
    low, high = load_vector(q, 2 * w + e), load_vector(q, 2 * w + e + 1)
    rise, least = high - low, load_vector(known, ROUND * w + e + 1)
    short = 1.0 / root(rise * rise + least * least)
    x = 0.5 * (low + high) * short
    return x, more(1.0 - more(x, -x), repeated(0.0)), short, rise * short


@kernel(inline=True, counted=False)
def dry_share(x, y):
    """Q′"""
    half = 0.5 * y * y
    return choose_less(0.0, x, 1.0 - half, half)


@kernel(counted=False)
def wet(work, elements):
    """Rows of drag, added mass and displaced water of all elements, reduced by their wet shares"""
    w, q, known = work.q.shape[1], address(work.q), address(work.element)
    for e in range(0, elements, WIDTH):
        x, y, _, _ = place_of_surface(known, q, w, e)
        share = 1.0 - dry_share(x, y)
        for i in range(OF_WATER):
            whole = load_vector(known, (WHOLE + i) * w + e + 1)
            store_vector(known, (DRAG_NORMAL + i) * w + e + 1, share * whole)


@kernel(counted=False)
def weigh_dry(work, elements, cq):
    """Add the additional weight of elements out of the water to residual and tangent."""
    w, q, known = work.q.shape[1], address(work.q), address(work.element)
    r, D, B = address(work.r), address(work.D), address(work.B)
    for e in range(0, elements, WIDTH):
        x, y, short, m = place_of_surface(known, q, w, e)
        dry = dry_share(x, y)
        if largest(dry) == 0.0:
            continue
        gain = load_vector(known, BUOYANCY * w + e + 1)
        wider = y * y * (0.5 - y / 3.0)  # dE/db over B
        lower, upper = 0.5 * dry - wider * m, 0.5 * dry + wider * m
        at = 2 * w + e
        store_vector(r, at, load_vector(r, at) - gain * lower)
        store_vector(r, at + 1, load_vector(r, at + 1) - gain * upper)
        K, turning = cq * gain * short, wider * (1.0 - m * m)
        one, two = 0.5 + x * m, 0.5 - x * m
        at = 8 * w + e
        store_vector(D, at, load_vector(D, at) + K * (y * one * one + turning))
        store_vector(D, at + 1, load_vector(D, at + 1) + K * (y * two * two + turning))
        store_vector(B, at + 1, load_vector(B, at + 1) - K * (y * one * two - turning))


@kernel(counted=False)
def energy_dry(s, e, q):
    """Energy gained by element e where it is out of the water, J"""
    low, high = q[2, e], q[2, e + 1]
    b = ((high - low) ** 2 + s.waterline[e] ** 2) ** 0.5
    x = 0.5 * (low + high) / b
    y = max(0.0, 1.0 - abs(x))
    return s.buoyancy[e] * b * (max(x, 0.0) + y * y * y / 6.0)
