"""Simulation of a breakwater whose lines go slack in regular waves: one metre of it is a body of `mooring.motion`.

Lines are straight hawsers with T = (EA/S) e, e the elongation, and T = 0 when slack, wherever the body moves. The
fluid memory is that of the section over a band of frequencies. Without lines the body floats Δ = 2P₀ sin α / ρgB_w
above its place, because hydrostatic pressure is linear. Surge, pitch and yaw are not excited. Peaks of tension grow
nearly with the square root of EA. For the four periods with snapping in Table 3.2 of Kihara, Kitatani & Todoroki
(1975), an EA of 1e4 N per metre agrees to 5 %. Chains have a larger EA; the gauges may have yielded
(`tests/bench/breakwater.py snap`).
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_frequencies import Between
from hakobune.bem.database.reader import Reader

from ..lines.system.graph import System
from ..lines.system.hawser import Hawser, pull_of_points
from ..lines.system.parts import Anchor, Fairlead, MooredBody
from ..motion.simulation import moored, simulate
from ..motion.tables.wave_windows import HEADINGS
from ..motion.wave_loads import WaveForces
from ..motion.weather import Settings, Weather
from ..studies.conditions import Waves
from .elastic import stiffness_of
from .exact import about_gravity, moved_to_origin
from .unit import inertia

RAMP, CYCLES, MEASURED = 4, 24, 12  # wave periods
PER_SWING = 30  # samples of a period of the stiffest motion
TOLERANCE = 1e-2  # tolerance of a run; its peaks are within 1e-4 of peaks at a tolerance of 1e-3
IN_PLANE = np.ix_((1, 2, 3), (1, 2, 3))
LOWEST = 0.03  # lowest frequency of sections, over the wave frequency; below it long-wave damping is used
SLOWER = np.geomspace(1e-3, 1.0, 7)[:-1]  # lower frequencies, relative to that lowest one, for the memory of slow heave
SHORT, COUNT = 8.0, 60  # largest K = ω²/g times the smaller of half beam and draft; number of frequencies
UNMOVED = 1e-4  # added mass of roll over that of sway at the radius of gyration, of a section that moves no water
MOST = 0.3  # largest elongation in the table of tensions, over the line length


class Snap(NamedTuple):
    """time : (n,) s, in the last cycles; front, back : tensions, (n,) N/m
    peaks : (front, back), mean of the largest tensions of all cycles, N/m; largest : (front, back), N/m
    slack : (front, back), fraction of time; findings : one line each
    """

    time: np.ndarray
    front: np.ndarray
    back: np.ndarray
    peaks: tuple
    largest: tuple
    slack: tuple
    findings: tuple


def frequencies(body, omega):
    """Frequencies of the sections, rad/s, that `snap` needs in waves of omega, rad/s (included); shape (n,)"""
    most = max(np.sqrt(SHORT * body.gravity / min(body.draft, body.waterline / 2)), 3 * omega)
    return np.union1d(np.linspace(LOWEST * omega, most, COUNT), omega)


def snap(body, sections, axial_stiffness, omega, amplitude, memory="states"):
    """`Snap` of a `TautBody` or `TautRectangle` in regular waves of omega, rad/s, and amplitude, m

    sections : `Section` of the moored draft at `frequencies`; axial_stiffness : EA, N per metre of body
    memory : as in `mooring.motion.weather.Settings`; "constant" means radiation at the frequency of the waves
    raises : ValueError
    """
    if not 0 < axial_stiffness < np.inf or not 0 <= amplitude < np.inf:
        raise ValueError(
            f"EA is {axial_stiffness:g} N per metre of breakwater and the amplitude {amplitude:g} m; allowed: both "
            "above 0, finite"
        )
    if not axial_stiffness > 2 * body.pretension:
        raise ValueError(
            f"EA is {axial_stiffness:g} N and the pretension {body.pretension:.4g} N per metre of breakwater: the "
            "lines would stretch by more than half of their length; give stiffer lines"
        )
    body_in_time, period = one_metre(body, sections, axial_stiffness), 2 * np.pi / omega
    count = int(np.ceil(PER_SWING * _swiftest(body, body_in_time, axial_stiffness) / omega))
    settings = Settings(
        duration=(CYCLES - RAMP) * period, ramp=RAMP * period, step=period / count, tolerance=TOLERANCE,
        slow_drift="none", memory=memory,
    )  # fmt: skip
    run = simulate(body_in_time, Weather(regular=Waves(2 * amplitude, period, np.pi / 2)), settings)
    kept = run.tension[-MEASURED * count :]
    peaks = kept.reshape(MEASURED, count, 2).max(axis=1)
    return Snap(
        run.time[-MEASURED * count :], *kept.T, tuple(peaks.mean(axis=0)), tuple(peaks.max(axis=0)),
        tuple((kept <= 0).mean(axis=0)), run.findings,
    )  # fmt: skip


def one_metre(body, sections, axial_stiffness):
    """`mooring.motion.simulation.Moored` of a metre of a `TautBody` or `TautRectangle` on its lines"""
    rise = 2 * body.pretension * np.sin(body.angle) / body.heave_stiffness
    reader = _reader(body, sections, body.z0 + rise)
    force = reader.between.quantities["excitation_force"]
    force = np.concatenate([force.real, force.imag], axis=2)
    waves = WaveForces(reader.omega, np.repeat(force, HEADINGS, axis=1), None)
    # critically damped springs on surge, pitch and yaw, which no force excites
    along = np.diag([1.0, 0.0, 0.0, 0.0, body.radius**2, body.radius**2])
    spring, damping = along * body.heave_stiffness, along * 2 * np.sqrt(body.heave_stiffness * body.mass)
    return moored(reader, _lines(body, axial_stiffness, rise), spring=spring, damping=damping, waves=waves)


def _reader(body, sections, z):
    """`Reader` of a metre of the body, in waves along the normal, its motions about the centre of gravity, now at z

    Below the sections' frequencies A is constant, and B is that of long waves: for heave, which changes the volume,
    constant (½ρB_w²√(g/h) in the limit), for sway and roll, which are dipoles, proportional to ω².
    """
    found = [about_gravity(section, moved_to_origin(body.z0)) for section in sections]
    known = np.array([section.omega for section in sections])
    slow, n = known[0] * SLOWER, len(SLOWER)
    omega = np.concatenate([slow, known])
    added, damping = np.zeros((2, len(omega), 6, 6))
    force = np.zeros((len(omega), 1, 6), complex)
    for i, (impedance, excitation) in enumerate(found, n):
        added[i][IN_PLANE], damping[i][IN_PLANE] = -impedance.real / omega[i] ** 2, -impedance.imag / omega[i]
        force[i, 0, 1:4] = excitation
    added[:n], force[:n] = added[n], force[n]
    damping[:n] = damping[n] * ((slow / known[0]) ** 2)[:, None, None]
    damping[:n, 2, 2] = damping[n, 2, 2]
    if np.abs(added[:, 3, 3]).max() < UNMOVED * body.radius**2 * np.abs(added[:, 1, 1]).max():  # a circle that turns
        for matrix in (added, damping):
            matrix[:, 3, :] = matrix[:, :, 3] = 0.0
        force[:, :, 3] = 0.0
    quantities = {"added_mass": added, "radiation_damping": damping, "excitation_force": force}
    side = body.waterline / 2
    plan = np.array([[0.5, side], [-0.5, side], [-0.5, -side], [0.5, -side]])
    between = Between(omega, quantities, body.depth, body.gravity, np.array([np.pi / 2]), np.zeros(1), plan)
    C = np.diag([0.0, 0.0, body.heave_stiffness, body.roll_stiffness, body.roll_stiffness, 0.0])
    return Reader(between, body.density, np.array([0.0, 0.0, z]), inertia(body, 1.0, body.z0), C, np.zeros((6, 6)))


def _lines(body, axial_stiffness, rise):
    """`System` of a front and a back line of a metre of the body, which would float `rise` m higher without them"""
    away = body.line * np.array([np.cos(body.angle), -np.sin(body.angle)])
    length = body.line * (1 - body.pretension / axial_stiffness)
    most = MOST * length
    pull = pull_of_points("line", [0.0, most / 2, most], axial_stiffness / body.line * np.array([0.0, most / 2, most]))
    lines, points = [], []
    for name, side in (("front", -1.0), ("back", 1.0)):
        end = np.array([side * body.attachment, body.attachment_z])
        points.append(Anchor(f"anchor {name}", (0.0, *(end + [side * away[0], away[1]]))))
        points.append(Fairlead(f"end {name}", "body", (0.0, end[0], end[1] - body.z0)))
        lines.append(Hawser(name, pull, length, f"anchor {name}", f"end {name}"))
    moving = MooredBody("body", (0.0, 0.0, body.z0 + rise, 0.0, 0.0, 0.0))
    return System(body.depth, lines, points, [moving], body.density, body.gravity)


def _swiftest(body, body_in_time, axial_stiffness):
    """rad/s of the stiffest motion of a `Moored` on its lines while they are taut"""
    mass = (body_in_time.reader.inertia + body_in_time.memory.added_mass_infinity)[IN_PLANE]
    return np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, stiffness_of(body, axial_stiffness)[0])).real.max())
