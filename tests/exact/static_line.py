"""Whether a solved static line is in equilibrium, found out by quadrature and balances of forces alone.

A line hangs in equilibrium if every part of it does.  Along a free part H is constant, dV/ds = w and

    dx/ds = (1 + ε) H/T,    dz/ds = (1 + ε) V/T,    T = √(H² + V²),    ε = ε(T) of the material,

which Gauss's rule integrates here on intervals that shrink towards V = 0.  Along a part on the bed of slope β, dT/ds
lies between w (sin β − μ cos β) and w (sin β + μ cos β), and T ≥ 0; on a leg that goes back up the slope, towards the
anchor, β is larger by π and cos β stands for |cos β|.  Where parts meet, the pulls, the load and the reaction of the
bed add up to nothing; the reaction points out of the bed, and there is none off it.  Nothing is below the bed; a buoy
is under water, in the surface with a part of its lift, or out of the water without it.

Nothing of the solver is used here but the state at the upper end of each part, which is what it claims.
"""

from __future__ import annotations

import numpy as np

NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)
# of the line's length, and of the largest tension or a thousandth of the weight: what counts as a fault
LENGTH, FORCE = 1e-7, 1e-6


def strain(segment, tension):
    """ε at tensions, N, of a `Segment`"""
    if np.ndim(segment.axial_stiffness) == 0:
        return tension / segment.axial_stiffness
    e, T = np.asarray(segment.axial_stiffness, float).T
    last = (e[-1] - e[-2]) / (T[-1] - T[-2])
    return np.where(tension > T[-1], e[-1] + last * (tension - T[-1]), np.interp(tension, T, e))


def intervals(H, V, down, weight):
    """Ends of intervals in [0, down], from the upper end, that shrink towards the place where V = 0."""
    middle = V / weight
    scale = abs(H) / weight
    steps = np.geomspace(max(scale, 1e-16 * (down + abs(middle))), down + abs(middle) + scale, 48)
    ends = np.concatenate([[0.0, down, middle], middle - steps, middle + steps])
    return np.unique(np.clip(ends, 0.0, down))


def hung(H, V, places, weight, segment):
    """How far a free part reaches, (x, z) m of each, from its upper end to `places` m of unstretched length below."""
    ends = np.union1d(intervals(H, V, np.max(places), weight), places)
    half = 0.5 * np.diff(ends)[:, None]
    s = 0.5 * (ends[1:] + ends[:-1])[:, None] + half * NODES
    v = V - weight * s
    T = np.maximum(np.hypot(H, v), 1e-300)
    factor = half * WEIGHTS * (1 + strain(segment, T)) / T
    at = np.searchsorted(ends, places)
    x, z = np.cumsum(factor.sum(axis=1)) * H, np.cumsum((factor * v).sum(axis=1))
    return np.append(0.0, x)[at], np.append(0.0, z)[at]


def segment_at(line, s):
    ends = np.cumsum([segment.length for segment in line.segments])
    return line.segments[min(int(np.searchsorted(ends, s)), len(line.segments) - 1)]


def bed_height(line, x):
    px, pz = line.bed.points.T
    slope = np.diff(pz) / np.diff(px)
    return np.interp(x, px, pz) + slope[-1] * np.maximum(x - px[-1], 0.0) + slope[0] * np.minimum(x, 0.0)


def slopes_at(line, x, far):
    """Slopes, rad, of the facets that a place belongs to: two at a vertex."""
    px, pz = line.bed.points.T
    left, right = np.append(-np.inf, px[1:-1]), np.append(px[1:-1], np.inf)
    inside = (left - far <= x) & (x <= right + far)
    return np.arctan(np.diff(pz) / np.diff(px))[inside]


def pull(piece, down):
    """(H, V), N, at a place of a part."""
    if piece[0] == 1:
        T = piece[5] - piece[6] * down
        return np.array([T * np.cos(piece[10]), T * np.sin(piece[10])])
    return np.array([piece[5], piece[6] - piece[7] * down])


class Faults(dict):
    """What is wrong with a line: the size of each fault over its limit, where it is above 1."""

    def note(self, name, size):
        if not size <= 1.0:
            self[name] = max(self.get(name, 0.0), float(size))


def faults(found, sliding=True):
    """Faults of a `StaticSolution` of one position.  sliding : whether a line without tension may not lie on a slope
    steeper than friction holds."""
    line, out = found.line, Faults()
    # shorter ones are rounding of s, and a load between two of them would count twice
    pieces = found.pieces[found.pieces[:, 2] > 1e-14 * line.length]
    far = LENGTH * line.length
    ends = np.concatenate([[pull(p, 0.0), pull(p, p[2])] for p in pieces])
    force = FORCE * max(np.hypot(*ends.T).max(), 1e-3 * line.weight)
    fairlead = np.array([found.horizontal_fairlead, found.vertical_fairlead])
    out.note("pull at the fairlead", np.hypot(*(pull(pieces[0], 0.0) - fairlead)) / force)
    out.note("place of the fairlead", np.hypot(pieces[0, 3] - found.x, pieces[0, 4] - found.z) / far)
    out.note("length", abs(pieces[0, 1] - line.length) / far)
    heap = pieces[:, 8] < 1e-200
    # each load at the one place between parts that is nearest to it: an end of a segment may be closer than `far`
    nearest = [int(np.argmin(abs(pieces[1:, 1] - load.position))) if len(pieces) > 1 else -1 for load in line.loads]
    for i, p in enumerate(pieces):
        segment, down = segment_at(line, p[1] - 0.5 * p[2]), p[2]
        out.note("weight", abs(p[7] - segment.weight) * down / force)
        if p[0] == 1:
            place = on_bed(line, p, segment, heap[i], sliding, far, force, out)
        else:
            place = in_water(line, p, segment, far, out)
        if i + 1 < len(pieces):
            below = pieces[i + 1]
            out.note("length", abs(p[1] - down - below[1]) / far)
            aside = 0.0 if heap[i + 1] or heap[i] else abs(place[0] - below[3])
            out.note("broken", max(aside, abs(place[1] - below[4])) / far)
            meet(line, found, p, below, [k for k, place in enumerate(nearest) if place == i], sliding, far, force, out)
    end = pieces[-1]
    out.note("length", abs(end[1] - end[2]) / far if not found.slack else 0.0)
    held = np.array([found.horizontal_anchor, found.vertical_anchor])
    out.note("pull at the anchor", np.hypot(*(pull(end, end[2]) - held)) / force)
    if not (found.slack and end[0] == 1):
        out.note("place of the anchor", np.hypot(0.0 if found.slack else place[0], place[1]) / far)
    return out


def on_bed(line, p, segment, heap, sliding, far, force, out):
    """Checks a part on the bed; returns where it ends"""
    _, _, down, x, z, T, rate, weight, _, _, beta = p
    if line.bed is None:
        out.note("on a bed that is not there", np.inf)
        return x, z
    if heap:
        return x, z
    out.note("compressed", -min(T, T - rate * down) / force)
    out.note("bed", abs(z - bed_height(line, x)) / far)
    if sliding or max(T, T - rate * down) > force:
        grip = abs(rate - weight * np.sin(beta)) - weight * line.bed.friction * abs(np.cos(beta))
        out.note("friction", grip * down / force)
    half = 0.5 * down
    moved = half * WEIGHTS @ (1 + strain(segment, np.maximum(T - rate * half * (1 + NODES), 0.0)))
    place = x - moved * np.cos(beta), z - moved * np.sin(beta)
    middle = 0.5 * (x + place[0])
    out.note("bed", np.abs(np.sin(slopes_at(line, middle, 0.0) - beta)).min() * abs(moved) / far)
    if place[0] > -far:
        out.note("bed", abs(place[1] - bed_height(line, max(place[0], 0.0))) / far)
    return place


def in_water(line, p, segment, far, out):
    """Checks a free part; returns where it ends"""
    _, _, down, x, z, H, V, weight, *_ = p
    lowest = np.empty(0)
    if line.bed is not None:
        slopes = np.diff(line.bed.points[:, 1]) / np.diff(line.bed.points[:, 0])
        lowest = (V - H * slopes) / weight
    places = np.clip(np.concatenate([[down], lowest, np.linspace(0.0, down, 12)]), 0.0, down)
    dx, dz = hung(H, V, places, weight, segment)
    if line.bed is not None:
        under = np.where(x - dx > -far, bed_height(line, x - dx) - (z - dz), 0.0)
        out.note("below the bed", under.max() / far)
    return x - dx[0], z - dz[0]


def meet(line, found, above, below, nearest, sliding, far, force, out):
    """Balance where two parts meet; nearest : numbers of the loads of which no other such place is nearer"""
    s, x, z = below[1], below[3], below[4]
    upper, lower = pull(above, above[2]), pull(below, 0.0)
    loads = [i for i in nearest if abs(line.loads[i].position - s) <= far]
    weight = 0.0
    for i in loads:
        load, state = line.loads[i], found.loads[i]
        if load.weight < 0:
            above_sea = z - line.surface if np.isfinite(line.surface) else -np.inf
            high = {"submerged": above_sea, "floating": abs(above_sea), "emerged": -above_sea}[state]
            out.note("buoy", high / far)
        part = {"submerged": load.weight, "emerged": load.weight_in_air, "floating": upper[1] - lower[1]}[state]
        out.note("buoy", (load.weight - part) / force)
        out.note("buoy", (part - max(load.weight, load.weight_in_air)) / force)
        weight += part
    reaction = lower - upper + np.array([0.0, weight])
    size = np.hypot(*reaction)
    if size <= force:
        return
    if line.bed is None or abs(z - bed_height(line, x)) > far:
        out.note("balance", size / force)
        return
    lies = (idle(above, force) and idle(below, force)) or (found.slack and x <= far)
    if lies and not sliding:
        return
    slopes, friction = slopes_at(line, x, far), line.bed.friction
    out.note("out of the cone of friction", outside_cone(reaction, slopes, friction) / force)
    if not loads:
        tensions = np.sort([np.hypot(*upper), np.hypot(*lower)])
        turned = np.arctan2(abs(upper[0] * lower[1] - upper[1] * lower[0]), upper @ lower)
        out.note("capstan", (np.diff(tensions)[0] - np.expm1(friction * turned) * tensions[0]) / force)


def idle(piece, force):
    """Whether a part lies on the bed without tension"""
    return piece[0] == 1 and max(piece[5], piece[5] - piece[6] * piece[2]) <= force


def outside_cone(reaction, slopes, friction):
    """Distance, N, of a reaction from the cone in which the bed can push: normals of its facets, widened by friction"""
    normals = slopes + 0.5 * np.pi
    middle, half = 0.5 * (normals.max() + normals.min()), 0.5 * np.ptp(normals) + np.arctan(friction)
    angle = np.arctan2(*reaction[::-1]) - middle
    beyond = abs((angle + np.pi) % (2 * np.pi) - np.pi) - half
    return np.hypot(*reaction) * np.sin(np.clip(beyond, 0.0, 0.5 * np.pi))
