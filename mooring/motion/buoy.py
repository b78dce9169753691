"""A buoy with mass between its lines and the hawsers of a body, as part of the body's equation of motion, compiled.

    (m + C_a ρ∇) ẇ = (1 + C_a) ρ∇ a + ½ρC_dA |q − w|(q − w) + buoyancy − weight + lines − Σ hawsers
    hawser  T = B (e/(L ε_B))ⁿ + c min(1, e/e_c) ė where it is longer than L, never below 0; 0 where it is shorter
    tilt    ΣT h cos θ = c_θ sin θ,   c_θ = mg (z_B + I/∇ − z_G),   hawsers yield by h sin θ

w is the velocity of the buoy. q and a are the velocity and acceleration of the water (incident waves and current) at
the middle of the buoy's draft. B, ε_B and n are defined in `mooring.lines.ropes`. The vertical equation contains the
added mass, but not the ρ∇ a that belongs to buoyancy.  The damping of a hawser grows with its elongation up to e_c,
the elongation at a tenth of B. The force is then continuous where the hawser becomes taut.  A buoy with hawsers at a
height h above its lines tilts under their pull without delay. Its centre of gravity is at half its height.  For a
small buoy, the movement by tilt exceeds the elongation of the hawsers and reduces their snap loads. Apart from the
tilt, hawsers run from the deck of the body to the axis of the buoy. Lines have their static shape. Waves scattered
by the body are not included. Like wave forces (`wave_loads`), the motion of the water is tabulated for each window,
at the buoy's position at the start of the previous window.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from ..lines.ropes import RopePart
from .line_loads import Lines, LineWork, body_lines, generalized, line_loads, line_work, tables_of
from .tables.harmonics import at_step, harmonics, sum_waves, zeros_in_lines
from .tables.interpolation import EDGE, between_samples
from .tables.wave_windows import WaveTable

WATER = 7  # rows of the water: elevation, velocity, acceleration
DAMPING = 0.05  # damping ratio of a hawser between its ends
FULL = 0.1  # tension over breaking load above which a hawser has its full stiffness and damping
BALANCED = 60  # largest number of steps for the pull under which buoy and hawsers balance


@dataclass(frozen=True)
class BuoyBody:
    """mass : kg; diameter, height : dimensions of an upright cylinder, m; added : C_a sideways and vertically, of
    the displaced volume
    drag : C_d of the side and of the bottom; lever : height of its hawsers over its lines, m, 0 for a buoy that does
        not tilt
    """

    mass: float
    diameter: float
    height: float
    added: tuple[float, float] = (1.0, 1.0)
    drag: tuple[float, float] = (1.0, 1.0)
    lever: float = 0.0

    def draft(self, density):
        """m, floating free of lines"""
        return self.mass / (density * 0.25 * np.pi * self.diameter**2)

    def yields(self, pull, system):
        """Length, m, by which tilt slackens the hawsers at the sum of their pulls, N, in the water of a System"""
        return yielding(self.lever, self.upright(system), pull)[0] if self.lever > 0 else 0.0

    def upright(self, system):
        """c_θ over the lever, N"""
        return self.mass * system.gravity * self.metacentric_height(system.density) / self.lever

    def metacentric_height(self, density):
        """m, floating free of lines"""
        draft = self.draft(density)
        return 0.5 * (draft - self.height) + self.diameter**2 / (16 * draft)


@dataclass(frozen=True, eq=False)
class BuoyOnLines:
    """A buoy, and its connection to a body.

    system : System whose only body is the buoy, at its floating position without lines; its lines run from anchors
        to the buoy
    rope, lengths : RopePart and lengths (k,) m of the hawsers; ends : ends on the body, in its axes, (k, 3) m
    origin : origin of the body's axes at rest, in space, (3,) m
    start : displacement of the buoy from its place in the system, (3,) m; level : height of the hawsers over the
        lines' end, m
    current : (2,) m/s
    """

    body: BuoyBody
    system: object
    rope: RopePart
    lengths: np.ndarray
    ends: np.ndarray
    origin: np.ndarray
    start: np.ndarray
    level: float
    current: np.ndarray

    @cached_property
    def lines(self):
        """`Lines` that hold the buoy"""
        return body_lines(self.system, (), tables_of(self.system, np.array([*self.start, 0.0, 0.0, 0.0])))

    @property
    def stiffness(self):
        """Stiffness of each hawser at FULL of its breaking load, N/m; shape (k,)"""
        strain = self.rope.strain_at(FULL * self.rope.breaking_load)
        return FULL * self.rope.breaking_load * self.rope.exponent / (strain * np.asarray(self.lengths))

    @property
    def damping(self):
        """Damping of each hawser, N s/m, shape (k,): the fraction DAMPING of the critical damping of the buoy on
        this hawser alone
        """
        return 2 * DAMPING * np.sqrt(self.stiffness * self.body.mass)


@in_memory
class Buoy(NamedTuple):
    """inverse : inverse of mass plus added mass, (3,) 1/kg; moved : factors on the acceleration of the water, (3,) kg;
    drag : ½ρC_dA, (3,) kg/m

    lever : m; upright : c_θ over the lever, N; a hawser pull of half this force tilts the buoy by 27°
    weight : N; stiffness : ρgA, N/m; draft, height, depth : draft without lines, height of the cylinder, depth of
        the water, m
    ropes : (k, 6) L, B, ε_B, n, c, N s/m, and e_c; the rest as in `BuoyOnLines`
    """

    inverse: np.ndarray
    moved: np.ndarray
    drag: np.ndarray
    lever: float
    upright: float
    weight: float
    stiffness: float
    draft: float
    height: float
    depth: float
    ropes: np.ndarray
    ends: np.ndarray
    origin: np.ndarray
    level: float
    current: np.ndarray
    lines: Lines


@in_memory
class BuoyWork(NamedTuple):
    """Work arrays, the window of water in use, and the largest pulls since the last sample.

    window : (WATER, m); factor : (c, 2, k) `harmonics`
    rows : (c, 2, WATER); sums : (2, WATER, 2, k), from `sum_waves` at the start and at the end of the window
    place : position predicted for the end of the window, (2,) m
    reach : (k, 5), unit vector, elongation, m, and rate of elongation, m/s, of each hawser
    rope : present pull of the hawsers, (k,) N; pull : present pulls of hawsers and lines, (k + lines,) N
    most : largest pulls since the last sample; kept : largest pulls of each sample, (samples, …)
    """

    lines: LineWork
    window: np.ndarray
    factor: np.ndarray
    rows: np.ndarray
    sums: np.ndarray
    place: np.ndarray
    water: np.ndarray
    weights: np.ndarray
    pose: np.ndarray
    R: np.ndarray
    force: np.ndarray
    part: np.ndarray
    reach: np.ndarray
    rope: np.ndarray
    most: np.ndarray
    kept: np.ndarray


def buoy_arrays(buoy):
    """`Buoy` of a BuoyOnLines.  Raises ValueError for a buoy that would sink."""
    body, system = buoy.body, buoy.system
    density, gravity = system.density, system.gravity
    draft, area = body.draft(density), 0.25 * np.pi * body.diameter**2
    if not draft < body.height:
        raise ValueError(f"a buoy of {body.mass:g} kg floats at {draft:.3g} m; allowed: below its {body.height:g} m")
    righting = body.metacentric_height(density)
    if body.lever != 0 and not (body.lever > 0 and righting > 0):
        raise ValueError(
            f"a buoy whose hawsers are {body.lever:.3g} m above its lines and whose metacentric height is "
            f"{righting:.3g} m does not float upright; allowed: both above 0"
        )
    upright = body.upright(system) if body.lever > 0 else 1.0
    displaced = density * area * draft
    added = displaced * np.array([body.added[0], body.added[0], body.added[1]])
    drag = 0.5 * density * np.array([*[body.drag[0] * body.diameter * draft] * 2, body.drag[1] * area])
    rope = buoy.rope
    ropes = np.empty((len(buoy.lengths), 6))
    ropes[:, 0], ropes[:, 1:4] = buoy.lengths, (rope.breaking_load, rope.strain, rope.exponent)
    ropes[:, 5] = ropes[:, 0] * rope.strain_at(FULL * rope.breaking_load)
    ropes[:, 4] = buoy.damping
    return Buoy(
        1 / (body.mass + added), np.array([displaced, displaced, 0.0]) + added, drag, float(body.lever),
        float(upright), gravity * body.mass, density * gravity * area, draft, float(body.height), float(system.depth),
        ropes, np.asarray(buoy.ends, float).reshape(-1, 3), np.asarray(buoy.origin, float), float(buoy.level),
        np.asarray(buoy.current, float), buoy.lines,
    )  # fmt: skip


def buoy_of(hung, table, samples):
    """(Buoy, BuoyWork) of a BuoyOnLines in the waves of a `WaveTable`; samples : number of samples that BuoyWork can
    hold
    """
    buoy = buoy_arrays(hung)
    factor = harmonics(table.omega, table.step, table.steps - EDGE)
    c, _, steps = factor.shape
    count = len(buoy.ropes) + len(buoy.lines.lost)
    return buoy, BuoyWork(
        line_work(buoy.lines), np.zeros((WATER, table.steps)),
        factor, np.zeros((c, 2, WATER)), zeros_in_lines((2, WATER, 2, steps)), np.zeros(2),
        np.zeros(WATER), np.zeros(6), np.zeros(6), np.zeros((3, 3)), np.zeros(6), np.zeros(6),
        np.zeros((len(buoy.ropes), 5)), np.zeros(len(buoy.ropes)), np.zeros(count), np.zeros((samples, count)),
    )  # fmt: skip


@kernel()
def pull_of_rope(rope, stretch, rate):
    """Pull, N, of a rope (L, B, ε_B, n, c, e_c) at an elongation, m, and its rate, m/s"""
    if stretch <= 0.0:
        return 0.0
    return max(rope[1] * (stretch / (rope[0] * rope[2])) ** rope[3] + rope[4] * min(stretch / rope[5], 1.0) * rate, 0.0)


@kernel()
def yielding(lever, upright, pull):
    """Length, m, by which the buoy's tilt slackens the hawsers at the sum of their pulls, N; and its derivative,
    m/N
    """
    steep = pull / upright  # tan θ
    away = 1.0 + steep * steep
    return lever * steep / np.sqrt(away), lever / (upright * away * np.sqrt(away))


@kernel()
def slope_of_rope(rope, stretch):
    """Stiffness, N/m, of a rope (L, B, ε_B, n, c, e_c) at an elongation, m"""
    return 0.0 if stretch <= 0.0 else rope[3] * rope[1] * (stretch / (rope[0] * rope[2])) ** rope[3] / stretch


@kernel()
def yielded(buoy, work):
    """Length x, m, by which tilt slackens the hawsers of `work.reach`, from S = Σ T(e − x(S)); and dx/dS Σ T′

    The balance has one solution S: the left side rises with S, the right side falls.  Newton's method, with bisection
    outside the bracket.
    """
    most = 0.0
    for i in range(buoy.ropes.shape[0]):
        most += pull_of_rope(buoy.ropes[i], work.reach[i, 3], 0.0)
    if buoy.lever == 0.0 or most == 0.0:
        return 0.0, 0.0
    low, high, pull = 0.0, most, 0.0
    for i in range(buoy.ropes.shape[0]):
        pull += work.rope[i]
    pull = min(pull, most)
    for _ in range(BALANCED):
        shift, soft = yielding(buoy.lever, buoy.upright, pull)
        left, steep = pull, 0.0
        for i in range(buoy.ropes.shape[0]):
            left -= pull_of_rope(buoy.ropes[i], work.reach[i, 3] - shift, 0.0)
            steep += slope_of_rope(buoy.ropes[i], work.reach[i, 3] - shift)
        low, high = (pull, high) if left < 0.0 else (low, pull)
        if abs(left) <= 1e-12 * most:
            break
        following = pull - left / (1.0 + soft * steep)
        pull = following if low < following < high else 0.5 * (low + high)
    return shift, soft * steep


@kernel()
def hawsers(buoy, work, y, place, R):
    """Pull of the hawsers: generalized force on the body in work.part (6,); subtracted from work.force (3,) on the
    buoy

    y : state of the body, (12 or more,); place : displacement and velocity of the buoy, (6,) m and m/s; R : attitude
        of the body
    """
    cos, sin = np.cos(y[5]), np.sin(y[5])
    across, down = np.cos(y[4]), np.sin(y[4])
    ux, uy, uz = cos * y[6] - sin * y[7], sin * y[6] + cos * y[7], y[8]
    wx = cos * across * y[9] - sin * y[10]
    wy = sin * across * y[9] + cos * y[10]
    wz = y[11] - down * y[9]
    at = buoy.lines.place[0]
    work.part[:] = 0.0
    for i in range(buoy.ropes.shape[0]):
        ax, ay, az = turned(R, buoy.ends[i])
        dx = at[0] + place[0] - buoy.origin[0] - y[0] - ax
        dy = at[1] + place[1] - buoy.origin[1] - y[1] - ay
        dz = at[2] + place[2] + buoy.level - buoy.origin[2] - y[2] - az
        distance = np.sqrt(dx * dx + dy * dy + dz * dz)
        work.reach[i, 3] = distance - buoy.ropes[i, 0]
        if distance <= buoy.ropes[i, 0]:
            continue
        dx, dy, dz = dx / distance, dy / distance, dz / distance
        vx, vy, vz = ux + wy * az - wz * ay, uy + wz * ax - wx * az, uz + wx * ay - wy * ax
        work.reach[i, 0], work.reach[i, 1], work.reach[i, 2] = dx, dy, dz
        work.reach[i, 4] = dx * (place[3] - vx) + dy * (place[4] - vy) + dz * (place[5] - vz)
    shift, softer = yielded(buoy, work)
    for i in range(buoy.ropes.shape[0]):
        T = pull_of_rope(buoy.ropes[i], work.reach[i, 3] - shift, work.reach[i, 4] / (1.0 + softer))
        work.rope[i] = T
        if T == 0.0:
            continue
        fx, fy, fz = T * work.reach[i, 0], T * work.reach[i, 1], T * work.reach[i, 2]
        work.force[0] -= fx
        work.force[1] -= fy
        work.force[2] -= fz
        ax, ay, az = turned(R, buoy.ends[i])
        generalized(y, fx, fy, fz, ay * fz - az * fy, az * fx - ax * fz, ax * fy - ay * fx, work.part)


@kernel()
def turned(R, p):
    """A point, m, converted from the body's axes to space; shape (3,)"""
    return (
        R[0, 0] * p[0] + R[0, 1] * p[1] + R[0, 2] * p[2],
        R[1, 0] * p[0] + R[1, 1] * p[1] + R[1, 2] * p[2],
        R[2, 0] * p[0] + R[2, 1] * p[1] + R[2, 2] * p[2],
    )


@kernel()
def floats(buoy, work, place, share, waves):
    """Add buoyancy, weight, drag and inertia of water to work.force; waves, share : ramps of the waves and of all
    loads
    """
    w = work.water
    for j in range(3):
        stream = share * buoy.current[j] if j < 2 else 0.0
        relative = waves * w[1 + j] + stream - place[3 + j]
        work.force[j] += buoy.moved[j] * waves * w[4 + j] + buoy.drag[j] * relative * abs(relative)
    immersed = min(max(buoy.draft + waves * w[0] - place[2], 0.0), buoy.height)
    work.force[2] += buoy.stiffness * immersed - buoy.weight


@kernel()
def buoy_rates(buoy, work, y, place, R, at, share, waves, rate):
    """Fill rate (6,), the rates of the buoy's displacement and velocity `place` (6,), and work.part, its force on a
    body of state y.

    R (3, 3) : attitude of the body; at : place in the window, counted in its steps; returns whether all lines have a
    force
    """
    if work.window.shape[1] > 1:
        between_samples(work.window, at, work.weights, work.water)
    work.pose[:3] = place[:3]
    alone = work.pose.reshape(1, 6), work.R.reshape(1, 3, 3), work.force.reshape(1, 6)
    good = line_loads(buoy.lines, work.lines, alone[0], alone[1], alone[2])
    hawsers(buoy, work, y, place, R)
    floats(buoy, work, place, share, waves)
    for j in range(3):
        rate[j] = place[3 + j]
        rate[3 + j] = buoy.inverse[j] * work.force[j]
    return good


@kernel()
def water_rows(table: WaveTable, buoy, place, start, rows):
    """Fill rows (c, 2, WATER), coefficients of `factor` for the water at the middle of the draft of a buoy at (2,) m

    start : start of the window, s
    """
    c, h, z = table.omega.size, buoy.depth, -0.5 * buoy.draft
    for i in range(c):
        kx, ky, w = table.number[0, i], table.number[1, i], table.own[i]  # a current moves water and waves along
        k = np.sqrt(kx * kx + ky * ky)
        turn = kx * place[0] + ky * place[1] + table.phase[i] - table.omega[i] * start
        a, b = table.amplitude[i] * np.cos(turn), table.amplitude[i] * np.sin(turn)
        over = np.exp(k * z) / (1.0 - np.exp(-2.0 * k * h))
        ch, sh = over * (1.0 + np.exp(-2.0 * k * (z + h))), over * (1.0 - np.exp(-2.0 * k * (z + h)))
        p, q = rows[i, 0], rows[i, 1]
        p[0], q[0] = a, b
        for j, unit in ((0, kx / k), (1, ky / k)):
            p[1 + j], q[1 + j] = w * ch * unit * a, w * ch * unit * b
            p[4 + j], q[4 + j] = w * w * ch * unit * b, -w * w * ch * unit * a  # −iω (a + ib)
        p[3], q[3] = w * sh * b, -w * sh * a
        p[6], q[6] = -w * w * sh * a, -w * w * sh * b


@kernel()
def open_water(table, buoy, work, place, number, start):
    """Fill the water at the buoy in window `number`, from `start` s on, and the rows at its end; place : present
    position, (2,) m
    """
    if work.window.shape[1] <= 1:
        return
    for j in range(2):  # in the axes of the waves, in which the body at rest lies at the centre of their table
        work.place[j] = buoy.lines.place[0, j] + place[j] - buoy.origin[j] + table.center[0, j]
    for side in range(0 if number == 0 else 1, 2):
        water_rows(table, buoy, work.place, start + side * table.window, work.rows)
        sum_waves(work.rows, work.factor, work.sums[(number + side) % 2])
    work.window[:] = 0.0
    steps = work.window.shape[1] - 1 - 2 * EDGE
    for side in range(2):
        for n in range(work.window.shape[1]):
            later = (n - EDGE) / steps
            share = 1.0 - later if side == 0 else later
            for j in range(WATER):
                work.window[j, n] += share * at_step(work.sums[(number + side) % 2], j, n - EDGE - side * steps)


@kernel()
def keep_pulls(work, first, last):
    """Store the largest pulls after an accepted step with samples `first` to `last` − 1, and restart the search for
    the largest
    """
    k = work.rope.size
    for i in range(k):
        work.most[i] = max(work.most[i], work.rope[i])
    for i in range(work.lines.tension.shape[0]):
        pull = np.sqrt(work.lines.tension[i, 0] ** 2 + work.lines.tension[i, 1] ** 2)
        work.most[k + i] = max(work.most[k + i], pull)
    for row in range(first, last):
        work.kept[row] = work.most
    if last > first:
        for i in range(k):
            work.most[i] = work.rope[i]
        for i in range(work.lines.tension.shape[0]):
            work.most[k + i] = np.sqrt(work.lines.tension[i, 0] ** 2 + work.lines.tension[i, 1] ** 2)
