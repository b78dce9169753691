"""Sectional coefficients of any outline in finite depth, by panels and Green's identity with ln r and its image.

    ½φ(p) = ∫ (φ ∂G/∂n − G ∂φ/∂n) dl,    2πG = ln|τ − p| + ln|τ − p′|,    p′ the image below the bed, n out of the water

with integrals over the body (∂φ/∂n given), the surface on both sides of the body (∂φ/∂n = Kφ), and two verticals one
depth away, where the depth modes are outgoing, ∂φ/∂n = Σ λₙ Zₙ ⟨φ, Zₙ⟩ / ⟨Zₙ, Zₙ⟩, λ₀ = ik, λₙ = −kₙ.
The kernels do not depend on
frequency. The unknowns of the body are eliminated once for a shape, so that each frequency costs one small linear
system.
Green's identity is applied to the water, not to the inside of the body, so there are no irregular frequencies.

An edge at z = 0 between other edges is the water of a gap between two sections, with ∂φ/∂n = K(1 + iε)φ for the
total φ and the damping ε of this water (`bem.panels.damping_lid`).

Towards a corner each panel is four times smaller than the panel before. At the corner φ is like distance^(π/β), with β
the angle of the water. Panels have Gauss points (`product_integration`).
Conventions and `Section` are those of `coefficients`.
"""

from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np

from ..depth_modes.gap import evanescent_wavenumbers
from ..problem import check_gap
from ..waves import depth_factor, depth_factor_slope, group_factor, wavenumber
from .coefficients import Section
from .outline import Edge
from .product_integration import NODES, layers, panels_of

TOLERANCE, FINEST = 1e-5, 1e-7
PER_RADIAN = 4.0  # longest panel times k
WIDEST = np.pi / 3  # widest panel on an arc, rad
MODES = 6  # evanescent depth modes kept; the next decays to e^(−7π) within one depth
MOST_PANELS = 250  # 1.8 s and 0.6 GB


def any_section(wetted, depth, omega, *, density=1025.0, gravity=9.80665, tolerance=TOLERANCE):
    """`Section` of a `Wetted` outline at one frequency.

    depth : m, finite; omega : rad/s; tolerance : relative error
    raises : ValueError if the tolerance cannot be reached
    """
    flow = section_flow(wetted, depth, omega, gravity, tolerance)
    n = float(group_factor(flow.k, depth))
    impedance = -density * flow.forces(flow.potentials[:, :3])
    waves = omega**2 / gravity * flow.waves[:, :3]
    reflection, transmission = flow.scattered(+1)
    return Section(
        wetted.waterline, wetted.draft, depth, omega, density, gravity, flow.k,
        added_mass=impedance.real,
        damping=omega * impedance.imag,
        excitation=-1j * density * omega * (flow.forces(flow.potentials[:, 3]) + flow.incident_forces),
        haskind=-2j * density * gravity * n / flow.k * waves[0],
        radiated=waves[1],
        reflection=reflection,
        transmission=transmission,
        drift=density * gravity * n * abs(reflection) ** 2,
        radiated_back=waves[0],
    )  # fmt: skip


def section_flow(wetted, depth, omega, gravity=9.80665, tolerance=TOLERANCE):
    """`AnyFlow` of a `Wetted` outline.  Raises ValueError."""
    if not 0 < omega < np.inf:
        raise ValueError(f"omega is {omega:g} rad/s; allowed: above 0 and finite")
    if not wetted.draft < depth < np.inf:
        raise ValueError(f"depth is {depth:g} m at draft {wetted.draft:g} m; allowed: above the draft, finite")
    check_gap(wetted.draft, depth)
    if not FINEST <= tolerance < 1:
        raise ValueError(f"tolerance is {tolerance:g}; allowed: {FINEST:g} to below 1")
    longest = PER_RADIAN / float(wavenumber(omega, depth, gravity))
    return AnyFlow(shape(wetted.edges, depth, float(2.0 ** np.floor(np.log2(longest))), tolerance), omega, gravity)


@lru_cache(maxsize=16)
def shape(edges, depth, longest, tolerance):
    """`Shape` of wetted edges with panels up to `longest`, m"""
    return Shape(edges, depth, longest, tolerance)


class Shape:
    """Data that do not depend on frequency: panels, and the equations of surface and verticals without unknowns of
    the body.

    (A₀ + A₁ ∂/∂n) φ = −A₂ ∂φ/∂n of the body,       φ of the body = B₀ φ + B₁ ∂φ/∂n + B₂ ∂φ/∂n of the body
    """

    def __init__(self, edges, depth, longest, tolerance):
        self.edges, self.depth = edges, depth
        left, right = edges[0].start, edges[-1].end
        outer = Edge(left - depth - 1j * depth, left - depth), Edge(right + depth, right + depth - 1j * depth)
        chain = [outer[0], Edge(left - depth, left), *edges, Edge(right, right + depth), outer[1]]
        parts = _split(chain, depth, longest, tolerance)
        panels = panels_of([panel for part in parts for panel in part])
        owner = np.repeat(np.arange(len(parts)), [NODES * len(part) for part in parts])
        self.points, self.weights = panels.points.reshape(-1), panels.weights.reshape(-1)
        self.normals = (-1j * panels.slopes / panels.speed[:, None]).reshape(-1)  # out of the body, into the water
        between = np.array([edge.bulge == 0 and edge.start.imag == 0 == edge.end.imag for edge in chain])
        between[[1, -2]] = False
        self.body = (owner >= 2) & (owner < len(parts) - 2) & ~between[owner]
        rest = owner[~self.body]
        self.gaps = [np.flatnonzero(rest == place) for place in np.flatnonzero(between)]
        self.surface = ((owner == 1) | (owner == len(parts) - 2))[~self.body]
        self.sides = [np.flatnonzero(owner[~self.body] == place) for place in (0, len(parts) - 1)]
        self.ends = left.real - depth, right.real + depth
        self._eliminate(panels)

    def _eliminate(self, panels):
        own = np.repeat(np.arange(len(panels.middle)), NODES)
        single, double = layers(panels, self.points, own)
        image = layers(panels, self.points.conj() - 2j * self.depth)
        reach = 2 * (self.ends[1] - self.ends[0] + self.depth)  # unit of ln r: no scale is degenerate
        single = (single + image[0] - 2 * np.log(reach) * self.weights) / (2 * np.pi)
        double = np.eye(len(own)) / 2 - (double + image[1]) / (2 * np.pi)
        b, rest = self.body, ~self.body
        eliminated = np.hstack([-double[np.ix_(b, rest)], -single[np.ix_(b, rest)], -single[np.ix_(b, b)]])
        solved = np.linalg.solve(double[np.ix_(b, b)], eliminated)
        count = int(rest.sum())
        self.on_body = np.split(solved, [count, 2 * count], axis=1)
        coupling = double[np.ix_(rest, b)]
        straight = double[np.ix_(rest, rest)], single[np.ix_(rest, rest)], single[np.ix_(rest, b)]
        self.equations = [A + coupling @ B for A, B in zip(straight, self.on_body, strict=True)]

    @cached_property
    def velocities(self):
        """Velocities of sway, heave and roll along the normals of the body, (n, 3)"""
        n, p = self.normals[self.body], self.points[self.body]
        return np.stack([n.real, n.imag, p.real * n.imag - p.imag * n.real], axis=1)


class AnyFlow:
    """The flows at one frequency: those radiated by sway, heave and roll, and those scattered from waves towards +y
    and −y.

    damping : ε of the water in gaps; in_gaps : whole potential of the two waves in each gap, [(s, 2)]
    moved_in_gaps : potential of the motions in each gap, [(s, m)]
    velocities : velocities along the normals of the body of m motions that replace sway, heave and roll, (n, m)
    potentials : potentials on the body, (n, m + 2)
    waves : potential at z = 0 of the outgoing waves towards −y and +y, referred to y = 0, (2, m + 2)
    """

    def __init__(self, shape, omega, gravity, damping=0.0, velocities=None):
        self.velocities = shape.velocities if velocities is None else velocities
        m = self.velocities.shape[1]
        self.shape, self.omega, self.gravity = shape, omega, gravity
        self.k = float(wavenumber(omega, shape.depth, gravity))
        A0, A1, A2 = shape.equations
        leaving, first = self._modes()
        along = [self._incident(sign) for sign in (1, -1)]
        self.incident = np.stack([value for value, _ in along], axis=1)
        gaps = np.concatenate([np.empty(0, int), *shape.gaps])
        taken = np.zeros((int((~shape.body).sum()), m + 2), complex)  # iεKφ_I, of waves alone
        flux = -np.hstack([self.velocities, -np.stack([slope for _, slope in along], axis=1)])  # n out of the water
        K = omega**2 / gravity
        taken[gaps, m:] = 1j * damping * K * self._incident_on(gaps)
        matrix = A0.astype(complex)
        matrix[:, shape.surface] += K * A1[:, shape.surface]
        matrix[:, gaps] += K * (1 + 1j * damping) * A1[:, gaps]
        for side, through in zip(shape.sides, leaving, strict=True):
            matrix[:, side] += A1[:, side] @ through
        phi = np.linalg.solve(matrix, -(A2 @ flux) - A1 @ taken)
        normal = np.where(shape.surface[:, None], K * phi, taken)
        normal[gaps] += K * (1 + 1j * damping) * phi[gaps]
        for side, through in zip(shape.sides, leaving, strict=True):
            normal[side] = through @ phi[side]
        B0, B1, B2 = shape.on_body
        self.potentials = B0 @ phi + B1 @ normal + B2 @ flux
        out = np.exp(-1j * self.k * np.array([-shape.ends[0], shape.ends[1]]))
        self.in_gaps = [phi[gap, m:] + self._incident_on(gap) for gap in shape.gaps]
        self.moved_in_gaps = [phi[gap, :m] for gap in shape.gaps]
        self.waves = np.stack([first[place] @ phi[side] for place, side in enumerate(shape.sides)]) * out[:, None]

    def _modes(self):
        """Of either side: ∂φ/∂n of φ at its nodes, (s, s), and the amplitude of the wave there, (s,)"""
        shape, h = self.shape, self.shape.depth
        kn = evanescent_wavenumbers(self.omega, h, MODES, self.gravity)
        rest = np.flatnonzero(~shape.body)
        made, first = [], []
        for side in shape.sides:
            z, w = shape.points[rest[side]].imag, shape.weights[rest[side]]
            Z = np.vstack([depth_factor(z, self.k, h), np.cos(kn[:, None] * (z + h))])
            projection = Z * w / (Z**2 @ w)[:, None]
            made.append((Z.T * np.append(1j * self.k, -kn)) @ projection)
            first.append(projection[0])
        return made, first

    def _incident_on(self, nodes):
        """φ_I of the unit waves towards +y and −y at nodes of the surface, (s, 2)"""
        along = self.shape.points[~self.shape.body][nodes].real
        return -1j * self.gravity / self.omega * np.exp(1j * self.k * along[:, None] * [1, -1])

    def _incident(self, sign):
        """φ_I of a unit wave towards ±y on the body, and its slope along the normal into the water, (n,)"""
        shape, k, h = self.shape, self.k, self.shape.depth
        p, n = shape.points[shape.body], shape.normals[shape.body]
        wave = -1j * self.gravity / self.omega * np.exp(1j * sign * k * p.real)
        Z, slope = depth_factor(p.imag, k, h), depth_factor_slope(p.imag, k, h)
        return wave * Z, wave * (1j * sign * k * Z * n.real + slope * n.imag)

    def forces(self, potential):
        """∮ φ n dl of potentials (n, …) on the body along each motion; shape (m, …)"""
        shape = self.shape
        return (self.velocities * shape.weights[shape.body, None]).T @ potential

    @property
    def incident_forces(self):
        """∮ φ_I n dl of the wave towards +y along each motion; shape (m,)"""
        return self.forces(self.incident[:, 0])

    def scattered(self, sign):
        """Complex R and T of the fixed body in a wave towards ±y, both referred to y = 0"""
        back, on = self.waves[::sign, -2 if sign > 0 else -1] / (-1j * self.gravity / self.omega)
        return complex(back), complex(1 + on)


def _split(chain, depth, longest, tolerance):
    """Panels of every edge of the boundary, in lists"""
    gap = depth + min(edge.at(u).imag for edge in chain[2:-2] for u in (0.0, 0.5, 1.0))
    lengths = [edge.length for edge in chain]
    corners = [(0, 0)] + [_levels(chain, i, tolerance) for i in range(1, len(chain) - 2)] + [(0, 0)]
    parts = []
    for i, edge in enumerate(chain):
        smaller = [min(lengths[j], gap) for j in (i - 1, i + 1) if 0 < j < len(chain) - 1]
        extra = max(0, int(np.ceil(np.log(lengths[i] / min([*smaller, lengths[i]])) / np.log(4) - 0.5)))
        graded = [0, 0]
        if 0 < i < len(chain) - 1:
            graded = [corners[i - 1][0] if i > 1 else 0, corners[i][0] if i < len(chain) - 2 else 0]
            graded = [level + extra if level else 0 for level in graded]
        parts.append(_panels(edge, *graded, longest))
    count = sum(map(len, parts))
    if count > MOST_PANELS:
        raise ValueError(
            f"the section needs {count} panels at this frequency; allowed: {MOST_PANELS}; use a lower frequency, a "
            "larger tolerance or a smaller depth"
        )
    return parts


def _levels(chain, i, tolerance):
    """For the corner between edges i and i + 1 of the boundary: panels that shrink, and the exponent of the flow"""
    before, after = complex(chain[i].slope(1.0)), complex(chain[i + 1].slope(0.0))
    water = np.pi + np.angle(after / before)  # the water is on the right
    if abs(water - np.pi) < 1e-3:
        return 0, 1.0
    exponent = np.pi / water
    return max(1, int(np.ceil(np.log(0.2 / tolerance) / ((1 + exponent) * np.log(4))))), exponent


def _panels(edge, first, last, longest):
    """Panels of an edge, of which `first` and `last` shrink towards its ends"""
    up, down = 4.0 ** -np.arange(first, 0, -1), 1 - 4.0 ** -np.arange(1, last + 1)
    if first and last:
        up, down = up * 2, 1 - (1 - down) * 2
    cuts = np.unique(np.concatenate([[0.0], up, down, [1.0]]))
    most = min(longest, WIDEST * edge.length / abs(edge.angle)) if edge.bulge else longest
    out = []
    for u0, u1 in pairwise(cuts):
        pieces = max(1, int(np.ceil((u1 - u0) * edge.length / most - 1e-9)))
        out += [edge.part(a, b) for a, b in pairwise(np.linspace(u0, u1, pieces + 1))]
    return out
