"""First-order wave forces, slow drift and elevation at a body that moves slowly, from the components of its sea.

    F(t) = Re Σ aᵢ X(ωᵢ, βᵢ − ψ) exp{i(kᵢ·r + εᵢ − ωᵢt)},    D(t) = |Σ aᵢ √D⁺ᵢ e^{…}|² − |Σ aᵢ √D⁻ᵢ e^{…}|²

in axes that turn with the slow heading ψ. In F, r is the slow position of the origin of the database's axes. In the
drift D, r is the rotation centre of the body, so that wave groups reach several bodies one after another. The drift
is Newman's approximation, with the square root of both diagonal terms (`mooring.response.slow_drift`).
On a current V, the exponent of waves at a fixed place contains ωᵢ + kᵢ·V, and Dᵢ becomes D + B V for each wave
(`mooring.response.wave_drift_damping`). Time is divided into
windows. A slow pose is predicted for the end of each window. Forces change linearly from the pose at the beginning of a
window to the pose at its end, so they are continuous for any motion. Around the instant between two windows,
exp(−iωt) at equal steps is always the same matrix. The waves at the pose of this instant are therefore summed once
for the windows before and after it (`tables.harmonics`). In a sea from one direction, some fifty frequencies are
enough for first-order forces; the waves are distributed over them for the time of a window (`tables.wave_windows`).
Between two steps a force is the polynomial of fifth degree through its values at the six nearest steps.

Each of several bodies has its own slow pose, and the origin of its wave phases moves with the body. The waves that the
other bodies scatter are computed for the positions at rest, which is accurate while the distances change little.
"""

from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from hakobune.bem.database.between_frequencies import BetweenError
from hakobune.bem.kernels.simd import WIDTH
from hakobune.bem.kernels.threads import blas_threads
from hakobune.bem.waves import wavenumber

from ..response.linear import frequencies
from ..response.wave_drift_damping import from_slopes
from .tables.groups import groups_of
from .tables.harmonics import harmonics, zeros_in_lines
from .tables.interpolation import EDGE, lagrange_weights
from .tables.wave_windows import FAR, HEADINGS, NEAR, WaveTable

PHASE = (0.3, 0.6)  # rad of the highest component in a step, of few components and of many: quintics are 4e-6, 2e-4 off
FEW = 40
WINDOW = 6.0  # s; poses are predicted this far ahead
TURN = 0.3  # rad of a wave between two nodes of frequency over a window: interpolation is 4e-6 off
OF_EDGE, MOST_NODES = 1.0, 600  # s, of the steps beyond a window; nodes after which none are made closer
RESOLVED = 2e-4  # error of forces between nodes, over their root mean square
OF_PERIOD = 1.2  # and at most so many mean periods: of a model of 1:70 in waves of 0.6 s hinges were 2.7 % off by 6 s


@dataclass(frozen=True, eq=False)
class WaveForces:
    """Forces and drift of a body over frequencies and over headings around the circle, relative to its axes, for any
    sea.

    omega : (q,) rad/s; force : real and imaginary parts per metre, (q, HEADINGS, 12); drift : (q, HEADINGS, 3) or None
    others : WaveForces of further moving bodies, then of groups of six shapes, at these frequencies
    """

    omega: np.ndarray
    force: np.ndarray
    drift: np.ndarray | None
    others: tuple = ()

    @property
    def each(self):
        """WaveForces of every body and group of shapes"""
        return (self, *self.others)

    @cached_property
    def curves(self):
        """Cubic splines over the frequency, of forces and of drift (None if unknown)"""
        from scipy.interpolate import CubicSpline

        drift = None if self.drift is None else CubicSpline(self.omega, self.drift)
        return CubicSpline(self.omega, self.force), drift

    @cached_property
    def at_nodes(self):
        """Frequencies (M,) rad/s at equal steps over the whole range, and the forces of `each` at them (N + G, M,
            HEADINGS, 12).

        The steps are so small that forces and windows of waves can be interpolated
        """
        step, low, high = TURN / (WINDOW + OF_EDGE), self.omega[0], self.omega[-1]
        while True:
            nodes = np.linspace(low, high, max(NEAR, int(np.ceil((high - low) / step)) + 1))
            middle = 0.5 * (nodes[1:] + nodes[:-1])
            near, share = on_nodes(middle, nodes)
            force = np.array([one.curves[0](nodes) for one in self.each])
            wanted = np.array([one.curves[0](middle) for one in self.each])
            found = sum(share[:, n, None, None] * force[:, near + n] for n in range(NEAR))
            error, size = (np.sqrt(np.mean(part**2, axis=(1, 2))).max(axis=0) for part in (found - wanted, wanted))
            if np.all(error <= RESOLVED * size) or len(nodes) > MOST_NODES:
                return nodes, force
            step *= 0.5


def on_nodes(omega, nodes):
    """First of the NEAR nodes around each of omega (c,), and its shares on them by Lagrange's polynomials (c, NEAR);
    equal steps
    """
    place = (np.asarray(omega) - nodes[0]) / (nodes[1] - nodes[0])
    near = np.clip(np.floor(place).astype(np.int64) - NEAR // 2 + 1, 0, len(nodes) - NEAR)
    share = np.ones((len(place), NEAR))
    for n in range(NEAR):
        for other in range(NEAR):
            if other != n:
                share[:, n] *= (place - near - other) / (n - other)
    return near, share


def wave_forces(body, turned=False):
    """`WaveForces` of a `bem.database.reader.Reader` at frequencies close enough for every resonance.

    One thread computes them, because several threads would change the order of sums and with it the digits.
    turned : whether a body that turns beyond the stored headings keeps the forces of the nearest stored heading, as
        a round body does; otherwise stored headings must cover the circle
    """
    try:
        with blas_threads(1):
            return _wave_forces(body, turned)
    except BetweenError as error:
        if not (who := _needs_all_round(body)):
            raise
        raise BetweenError(
            f"{who} turns in time, so that forces of waves from all round it are needed, whatever the direction of the "
            f"sea: {error}"
        ) from None


def _wave_forces(body, turned):
    omega, ring = frequencies(body), np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    if body.bodies:
        first, *others = (_of_one(body, one, omega, ring) for one in body.bodies if not one.fixed)
        return replace(first, others=(*others, *_of_shapes(body, omega, ring)))
    force = np.empty((len(omega), HEADINGS, 12))
    drift = np.empty((len(omega), HEADINGS, 3)) if body.knows_drift else None
    for rows in _in_parts(omega):
        forces, drifts = partial(body.forces, omega[rows]), partial(body.drift, omega[rows])
        found = body.ring.turned(forces, ring, "force") if turned else forces(ring)[..., :6]
        force[rows, :, :6], force[rows, :, 6:] = found.real, found.imag
        if drift is not None:
            drift[rows] = body.ring_of("drift_force").turned(drifts, ring, "drift") if turned else drifts(ring)
    return WaveForces(omega, force, drift, _of_shapes(body, omega, ring))


def _needs_all_round(body):
    """Name of a body that turns out of the stored headings, "" if they go all round every one"""
    ring = np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    for one in body.bodies:
        if not one.fixed and not body.ring.reached(ring + one.heading).all():
            return one.name
    return "" if body.bodies or body.ring.reached(ring).all() else "the body"


def _of_shapes(body, omega, ring):
    """`WaveForces` of the groups of shapes of a Reader, without drift, in waves from `ring` about their bodies"""
    groups, found = groups_of(body), []
    for g, owner in enumerate(groups.owner):
        columns = body.rigid + np.flatnonzero(groups.place // 6 == g)
        turned, force = ring + body.axes_at_rest[owner, 5], np.zeros((len(omega), len(ring), 12))
        for rows in _in_parts(omega):
            parts = body.forces(omega[rows], turned)[..., columns]
            force[rows, :, : len(columns)], force[rows, :, 6 : 6 + len(columns)] = parts.real, parts.imag
        found.append(WaveForces(omega, force, None))
    return tuple(found)


def _of_one(body, one, omega, ring):
    """`WaveForces` of one of several bodies, a `bem.modes.Body`, with the drift of each that is stored"""
    at = np.flatnonzero([other is one for other in body.bodies])[0]
    turned, columns = ring + one.heading, body.columns_of(one)
    parts = [body.forces(omega[rows], turned)[..., columns] for rows in _in_parts(omega)]
    force = np.concatenate([np.concatenate([part.real, part.imag], axis=-1) for part in parts])
    if not body.knows_drift_of_each:
        return WaveForces(omega, force, None)
    drift = [body.drift_of_each(omega[rows], turned)[:, :, at] for rows in _in_parts(omega)]
    return WaveForces(omega, force, np.concatenate(drift))


def _in_parts(omega):
    return np.array_split(np.arange(len(omega)), max(1, len(omega) // 64))


def no_wave_forces(body):
    """`WaveForces` of a `bem.database.reader.Reader` in a run without waves, for any solved headings"""
    none = WaveForces(body.omega, np.zeros((len(body.omega), HEADINGS, 12)), None)
    return replace(none, others=(none,) * (len(body.axes_at_rest) - 1 + len(groups_of(body).owner)))


def drift_of(forces, components, heading):
    """Drift of single wave components, in still water, on a body at `heading`, rad, as computed in runs; shape (c,
    3)
    """
    table = forces.curves[1](np.clip(components.omega, forces.omega[0], forces.omega[-1]))
    place = (np.asarray(components.direction) - heading) * (HEADINGS / (2 * np.pi))
    whole, weights, out = np.floor(place), np.empty(6), np.empty((len(place), 3))
    for i, near in enumerate(table):
        lagrange_weights(place[i] - whole[i] + 2.0, 6, weights)
        out[i] = weights @ near[(int(whole[i]) - 2 + np.arange(6)) % HEADINGS]
    return out


def forces_towards(forces, direction):
    """Complex first-order forces per metre on a body at rest, shape (q, 6); direction : direction of travel from
    body axes, rad
    """
    place, weights = direction * (HEADINGS / (2 * np.pi)), np.empty(6)
    whole = np.floor(place)
    lagrange_weights(place - whole + 2.0, 6, weights)
    parts = np.tensordot(forces.force[:, (int(whole) - 2 + np.arange(6)) % HEADINGS], weights, axes=(1, 0))
    return parts[:, :6] + 1j * parts[:, 6:]


def drift_damping(forces, omega, depth, gravity):
    """Drift D (q, HEADINGS, 3) at omega (q,) rad/s, and damping B (q, HEADINGS, 3, 2) for velocities along the
    body's x and y
    """
    drift = forces.curves[1](omega)
    around = np.concatenate([drift[:, -1:], drift, drift[:, :1]], axis=1)
    by_heading = (around[:, 2:] - around[:, :-2]) * (HEADINGS / (4 * np.pi))
    ring, k = np.arange(HEADINGS) * (2 * np.pi / HEADINGS), wavenumber(omega, depth, gravity)
    return drift, from_slopes(omega, ring, k, depth, drift, forces.curves[1](omega, 1), by_heading)


def drift_on_current(forces, omega, direction, velocity, depth, gravity):
    """Drift D + B V of waves omega (q,) rad/s that travel towards `direction` (q,) rad on a current V (2,) m/s, in
    space.

    Shape (q, HEADINGS, 3).

    The HEADINGS are directions of the waves in the body's axes; the current keeps its angle to the waves.
    """
    drift, B = drift_damping(forces, omega, depth, gravity)
    towards = np.arctan2(velocity[1], velocity[0]) - np.asarray(direction)[:, None]
    towards = towards + np.arange(HEADINGS) * (2 * np.pi / HEADINGS)
    return drift + np.hypot(*velocity) * (
        B[..., 0] * np.cos(towards)[..., None] + B[..., 1] * np.sin(towards)[..., None]
    )


def wave_table(forces, components, depth, center, gravity, drift=True, carrier=None, heading=(0.0,)):
    """`WaveTable` of `WaveForces` in wave components (`mooring.environment.sea.Components`).

    Components outside the stored frequencies exert no first-order force; their drift is that of the nearest stored
    frequency.
    center : rotation centre (3,) m, for several bodies (N, 3); heading : headings of the bodies' axes at rest, (N,)
        rad
    drift : whether drift is computed
    carrier : `mooring.on_current.waves.Carrier` of the components, None for still water; frequencies are intrinsic
        for every kind of Carrier
    """
    omega, amplitude, phase, direction = (np.asarray(part, float) for part in components)
    held = np.clip(omega, forces.omega[0], forces.omega[-1])
    drifts = np.zeros((len(forces.each), len(omega), HEADINGS + 6, 4))
    for one, own in zip(forces.each, drifts, strict=True):
        if drift and one.drift is not None and carrier is None:
            own[:, :HEADINGS, :3] = one.curves[1](held)
        elif drift and one.drift is not None:
            own[:, :HEADINGS, :3] = drift_on_current(one, held, direction, carrier.velocity, depth, gravity)
    drifts[:, :, HEADINGS:] = drifts[:, :, :6]
    nodes, towards, near, share, force = _nodes(forces, omega, held, direction)
    velocity = np.zeros(2) if carrier is None else np.asarray(carrier.velocity)

    def numbers(omega, direction):
        return wavenumber(omega, depth, gravity) * np.stack([np.cos(direction), np.sin(direction)])

    number, met = numbers(omega, direction), nodes + velocity @ numbers(nodes, towards)
    own, omega = omega, omega + velocity @ number
    step = PHASE[len(omega) > FEW] / np.abs(omega).max()
    count = max(2, int(np.ceil(_window(omega, amplitude) / step)))
    of_nodes, of_drift = harmonics(met, step, count + 1 + EDGE), harmonics(omega, 2 * step, count // 2 + 1 + FAR)
    middle, turn = np.asarray(center, float).reshape(-1, 3)[:, :2].copy(), np.asarray(heading, float)
    arm = middle * np.cos(turn)[:, None] + middle[:, ::-1] * np.multiply.outer(np.sin(turn), [1.0, -1.0])
    return WaveTable(
        omega, own, number, amplitude, phase, direction, force, drifts, near, share, towards, of_nodes, of_drift,
        middle, arm, step, step * count,
    )  # fmt: skip


def _nodes(forces, omega, held, direction):
    """Frequencies and directions of nodes (M,), the first node (c,) and the shares of each component, and forces at the
    nodes as in a `WaveTable`

    Of a sea from one direction within the stored frequencies nodes in equal steps; where they would be more than half
    as many as the components, the components themselves.
    """
    alone = np.arange(len(omega)), _in_vectors(np.ones((len(omega), 1)))
    if len(omega) > 2 * NEAR and np.all(direction == direction[0]) and np.all(held == omega):
        nodes, stored = forces.at_nodes
        near, share = on_nodes(omega, nodes)
        first, last = near.min(), near.max() + NEAR
        if 2 * (last - first) <= len(omega):
            force = zeros_in_lines((len(forces.each), last - first, HEADINGS, 16))
            force[..., :12] = stored[:, first:last]
            return nodes[first:last], np.full(last - first, direction[0]), near - first, _in_vectors(share), force
    force = zeros_in_lines((len(forces.each), len(omega), HEADINGS, 16))
    for one, own in zip(forces.each, force, strict=True):
        own[:, :, :12] = one.curves[0](held)
        own[held != omega] = 0.0
    return omega, direction, *alone, force


def _in_vectors(share):
    """Shares (c, n) and zeros; shape (c, WIDTH)"""
    return np.pad(share, [(0, 0), (0, WIDTH - share.shape[1])])


def _window(omega, amplitude):
    """s, of components (c,) rad/s, m"""
    energy = amplitude**2
    mean = (energy @ np.abs(omega)) / energy.sum() if energy.any() else 0.0
    return WINDOW if mean == 0.0 else min(WINDOW, OF_PERIOD * 2 * np.pi / mean)


def no_waves(window=WINDOW, bodies=1):
    """A `WaveTable` without components"""
    none, still = np.zeros(0), np.zeros((0, 2, WIDTH))
    count = max(2, int(window))
    force, drift = np.zeros((bodies, 0, HEADINGS, 16)), np.zeros((bodies, 0, HEADINGS + 6, 4))
    place, near = np.zeros((bodies, 2)), np.zeros(0, np.int64)
    return WaveTable(
        none, none, np.zeros((2, 0)), none, none, none, force, drift, near, np.zeros((0, WIDTH)), none, still, still,
        place, place, window / count, float(window),
    )  # fmt: skip
