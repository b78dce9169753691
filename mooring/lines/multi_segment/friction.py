"""Kernels for the tension of a line on the bed.

On a facet of slope β, going down: T₋ = T − w (sin β ± μ cos β) Δs, with plus where the line slides towards the
fairlead and minus where it slides towards the anchor. A tension kept from the previous position holds if it lies
between these two. At a bed vertex T changes by exp(∓μ Δβ), the capstan equation, which is the limit of this law on a
rounded bed. A line without tension slides down a facet on which sin β > μ cos β, and pulls. There T continues below
zero while the traversal seeks the tension that holds the line (`on_bed`). SR179 report (1982), section 3.1.1, eq.
3.1.6.
"""

import math

from hakobune.bem.kernels.jit import kernel

from .line_data import HIGH, LENGTH, LOW, PHI, H, S, T, V, X, Z, mix, slides_on

HEAPED = 100.0  # tension of a part laid out in a heap, over the least tension


@kernel()
def kept_tension(line, s):
    """Tension at s kept from the previous position, its slope dT/ds, and the lower s of its range.

    Without history T is −∞: the line slides towards the fairlead.  Where the line was off the bed T is +∞: the line
    slides towards the anchor.
    """
    if line.kept.shape[0] == 0:
        return -math.inf, 0.0, -math.inf
    slack = 1e-12 * line.length
    for j in range(line.kept.shape[0]):
        s0, s1, t0, t1 = line.kept[j, 0], line.kept[j, 1], line.kept[j, 2], line.kept[j, 3]
        if s > s1 + slack:
            return math.inf, 0.0, s1
        if s > s0 + slack:
            slope = (t1 - t0) / (s1 - s0)
            return t1 + slope * (min(s, s1) - s1), slope, s0
    return math.inf, 0.0, -math.inf


@kernel()
def kept_within(line, q, g, low, high):
    """Tension below a concentrated friction force: the kept tension, limited to the range low … high; derivatives go
    to g.
    """
    kept, slope, _ = kept_tension(line, q[S] - 1e-9 * line.length)
    if low <= kept <= high:
        q[T] = kept
        mix(g, T, slope, S, 0.0, T)
        return
    q[T] = max(low if kept < low else high, 0.0)
    mix(g, T, 1.0 if q[T] > 0 else 0.0, LOW if kept < low else HIGH, 0.0, T)


@kernel()
def pass_weight_on_bed(line, q, g, angle, weight):
    """Pass a weight (N) on the bed, whose derivatives are g[LENGTH]."""
    along, across = math.sin(angle), line.friction * abs(math.cos(angle))
    pull, give = along + across, along - across
    if line.held > 1 and pull < 0 and q[X] <= line.bed[0, 0] and math.cos(angle) > 0:  # in the heap at the anchor
        pull, give = 0.0, 0.0
    mix(g, LOW, 1.0, T, -pull, LENGTH)
    mix(g, HIGH, 1.0, T, -give, LENGTH)
    kept_within(line, q, g, q[T] - pull * weight, q[T] - give * weight)


@kernel()
def bend_at_vertex(line, q, g, angle, unknown):
    """Pass a bed vertex: the line bends from the angle φ to `angle`; the tension may change by exp(∓μ Δβ).

    unknown : index of `angle` among the unknowns, below 0 if it is none
    """
    if line.friction > 0:
        capstan = math.exp(-line.friction * (angle - q[PHI]))
        slope = q[T] * line.friction
        mix(g, LOW, capstan, T, capstan * slope, PHI)
        mix(g, HIGH, 1 / capstan, T, -slope / capstan, PHI)
        if unknown >= 0:
            g[LOW, unknown] -= capstan * slope
            g[HIGH, unknown] += slope / capstan
        kept_within(line, q, g, capstan * q[T], q[T] / capstan)
    q[PHI] = angle
    mix(g, PHI, 0.0, T, 0.0, T)
    if unknown >= 0:
        g[PHI, unknown] = 1.0


@kernel()
def slides_down(line, at, facet, tension):
    """Whether the line would slide down the facet without `tension`.

    Always False for parts fixed by `held` (see `line_data`), and on the first facet above the lowest buoy, which may
    lift the line.
    """
    above = at[1] >= line.lowest_buoy
    if not slides_on(line, facet) or (above and (facet == 0 or line.held > 0)):
        return False
    heaped = line.held > 1 and line.lowest_buoy < line.loads.shape[0] and tension <= HEAPED * line.least
    return facet > 0 or not heaped


@kernel()
def friction_rate(line, q, weight, angle):
    """Rate dT/ds on the bed, the length for which it holds, and the kept tension reached at the end (nan if not
    reached).
    """
    along, across = weight * math.sin(angle), weight * line.friction * abs(math.cos(angle))
    kept, slope, until = kept_tension(line, q[S])
    available = q[S] - until
    t = q[T]
    if abs(t - kept) <= 1e-13 * (abs(t) + weight * line.length):
        return slope, available, math.nan
    rate = along + across if t > kept else along - across
    closing = (t - kept) / (rate - slope) if math.isfinite(kept) else math.inf
    if 0 < closing < available:
        return rate, closing, kept - slope * closing
    return rate, available, math.nan


@kernel()
def bed_step(q, g, ds, rate, factor, flexibility, angle):
    """Advance the state down a piece on the bed of length ds, whose derivatives are g[LENGTH]."""
    t = q[T]
    moved = ds * (factor + flexibility * (t - 0.5 * rate * ds))
    cos, sin = math.cos(angle), math.sin(angle)
    q[X] -= moved * cos
    q[Z] -= moved * sin
    q[T] = t - rate * ds
    q[S] -= ds
    stretch = factor + flexibility * q[T]
    for i in range(g.shape[1]):
        slid = stretch * g[LENGTH, i] + flexibility * ds * g[T, i]
        g[X, i] -= slid * cos
        g[Z, i] -= slid * sin
        g[T, i] -= rate * g[LENGTH, i]
        g[S, i] -= g[LENGTH, i]


@kernel()
def leave_bed(line, q, g):
    """H and V from the tension T and the angle φ, where the line leaves the bed.

    T is at least `line.least`, for spans that hang vertically from a buoy.
    """
    if q[T] < line.least:
        q[T] = line.least
        mix(g, T, 0.0, T, 0.0, T)
    cos, sin = math.cos(q[PHI]), math.sin(q[PHI])
    q[H], q[V] = q[T] * cos, q[T] * sin
    mix(g, H, cos, T, -q[V], PHI)
    mix(g, V, sin, T, q[H], PHI)


@kernel()
def place_on_vertex(line, q, g, vertex):
    """Put the line on a bed vertex; T and φ follow from H and V."""
    q[X], q[Z] = line.bed[vertex, 0], line.bed[vertex, 1]
    mix(g, X, 0.0, H, 0.0, H)
    mix(g, Z, 0.0, H, 0.0, H)
    q[T], q[PHI] = math.hypot(q[H], q[V]), math.atan2(q[V], q[H])
    mix(g, T, q[H] / q[T], H, q[V] / q[T], V)
    mix(g, PHI, -q[V] / q[T] ** 2, H, q[H] / q[T] ** 2, V)
