"""A body at a single point in one equation with its waves and its buoy (`mooring.motion`): its parts, and a run.

Slow and wave motion are one motion. With a database it has six degrees of freedom and fluid memory; without one it
has three, in the plane. A buoy on a hawser has its own mass, drag and lines; a contact buoy is part of the body, and
the lines end at the body. Loads are those of statics and slow motion (`loads`), from turning tests or coefficients,
for all directions. Drift comes from every pair of waves, or is the mean drift given in a study.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from hakobune.bem.kernels.progress import IN_TIME, report_progress
from hakobune.bem.modes import words_of
from hakobune.bem.time_domain.memory import Memory
from hakobune.bem.time_domain.memory_kernels import MemoryArrays

from ..lines.system.parts import Fairlead
from ..loads.on_hull import heeling
from ..loads.turning import LARGEST_TURN
from ..motion.buoy import BuoyBody, BuoyOnLines, buoy_arrays
from ..motion.line_loads import tables_of
from ..motion.simulation import Moored, SimulationError, moored, simulate
from ..motion.tables.hull_water import OnHull, hull_water
from ..motion.wave_loads import WaveForces
from ..motion.weather import Settings, Weather
from ..studies.conditions import Wind
from .body import Hold, SinglePoint, SinglePointError
from .equilibria import Equilibrium

PLANE = (0, 1, 5)


@dataclass(frozen=True, eq=False)
class PlanarBody:
    """Properties of a body in the plane for a run, in place of a database.

    inertia, stiffness : (6, 6) kg …, stiffness zero; rotation_center : (3,) m
    """

    inertia: np.ndarray
    depth: float
    density: float
    gravity: float
    stiffness: np.ndarray = None
    rotation_center: np.ndarray = None
    knows_drift: bool = False
    words: tuple = words_of(())
    links: tuple = ()
    bodies: tuple = ()
    modes: tuple = ()
    rigid: int = 6
    free: np.ndarray = None

    def __post_init__(self):
        object.__setattr__(self, "stiffness", np.zeros((6, 6)))
        object.__setattr__(self, "rotation_center", np.zeros(3))
        object.__setattr__(self, "damping", np.zeros((6, 6)))
        object.__setattr__(self, "axes_at_rest", np.zeros((1, 6)))


def planar(point: SinglePoint) -> Moored:
    """Moored with the masses of a SinglePoint that moves in the plane, without lines"""
    T = point.mass
    rigid = np.zeros((6, 6))
    own = min(T[0, 0], T[1, 1])  # the division of T into body and water has no effect in the plane
    rigid[range(3), range(3)], rigid[range(3, 6), range(3, 6)] = own, own * T[2, 2] / T[1, 1]
    added = np.zeros((6, 6))
    added[np.ix_(PLANE, PLANE)] = T - rigid[np.ix_(PLANE, PLANE)]
    system, none = point.system, np.zeros((6, 0))
    reader = PlanarBody(rigid, system.depth, system.density, system.gravity)
    zero = np.zeros((6, 6))
    arrays = MemoryArrays(np.zeros(0), np.zeros(0), none, none)
    memory = Memory(arrays, np.zeros((0, 0)), np.zeros((0, 0)), added, zero, zero, (0.0, 1.0), ())
    waves = WaveForces(np.zeros(0), np.zeros((0, 1, 12)), None)
    return Moored(reader, None, None, memory, np.zeros(6), zero, zero, np.zeros(6), zero, added, waves, ((), ()),
                  free=PLANE)  # fmt: skip


def on_hull(point: SinglePoint, slow_added_mass, drift=True, up=0.0) -> OnHull:
    """OnHull of the loads of a SinglePoint; slow_added_mass : (6, 6); drift : whether to include their mean drift

    up : height above still water of the point to which motions refer, m
    """
    loads, water = point.loads, point.loads.water
    mass = point.mass if water.turning else slow_added_mass[np.ix_(PLANE, PLANE)]
    held = loads.drift.table if drift and loads.drift is not None else None
    found = hull_water(water.table, water.length, LARGEST_TURN, water.velocity, water.linear, mass, water.turning, held,
                       up - water.height, water.at_rest)  # fmt: skip
    wind = None if loads.wind is None else heeling(loads.wind.table, loads.wind.height, up)
    return OnHull(wind, found, bool(water.turning), water.quadratic)


def body_at(steady: Equilibrium, state, db=None, *, buoy: BuoyBody | None = None, rope=None, end_z=0.0,
            memory=None, sea=None) -> Moored:  # fmt: skip
    """`Moored` at a state (6,) near an Equilibrium (`slewing.turned_state`), with the hawser stretched by its tension.

    db : open database, None for motion in the plane; memory : fluid memory of the database; sea : sea in which
        viscous damping is linearised
    end_z : height of the attachment above still water, m
    buoy, rope : BuoyBody and RopePart of the hawsers, of a mooring with hawsers
    raises : SinglePointError, ValueError of `moored`
    """
    point = steady.point
    contact = point.lengths[0] == 0.0
    if not contact and (buoy is None or rope is None):
        raise SinglePointError("a hawser needs the buoy's mass and the rope's strength; give buoy and rope")
    if contact and buoy is not None:
        raise SinglePointError(
            "a contact buoy moves with the body, so it has no motion of its own; leave out buoy, or give a hawser"
        )
    body = planar(point) if db is None else moored(db, memory=memory, linearised_in=sea)
    center = np.asarray(body.reader.rotation_center, float)
    out, state = np.zeros(3), np.asarray(state, float)
    if not contact:
        out = _stretch(steady, state, rope, buoy)
    start = np.array([*(state[:2] + out[:2] - center[:2]), 0.0, 0.0, 0.0, state[2]])
    stiffness = body.stiffness.copy()
    held = point.stiffness(steady.heading, Hold(-steady.force, steady.hawser, steady.buoy))
    stiffness[PLANE, PLANE] += np.abs(np.diag(held))  # scale of the errors of steps
    body = replace(body, start=start, stiffness=stiffness)
    ends = np.column_stack([point.ends, np.full(len(point.ends), end_z - center[2] if db is not None else 0.0)])
    if contact:
        system = _at_the_bow(point, center, ends[0], db is not None)
        return replace(body, system=system, tables=tables_of(system, start))
    origin = np.array([*center[:2], center[2] if db is not None else 0.0])
    height = point.pull(steady.buoy).height - point.system.bodies[0].position[2]
    level = ends[0, 2] + origin[2] - point.system.bodies[0].position[2] - height
    place = np.array([*(steady.buoy - point.system.bodies[0].position[:2]), height])
    hung = BuoyOnLines(buoy, point.system, rope, point.lengths, ends, origin, place, level, point.loads.water.velocity)
    try:
        buoy_arrays(hung)
    except ValueError as error:
        raise SinglePointError(str(error)) from None
    return replace(body, buoy=hung)


def run_in_one(steady: Equilibrium, body: Moored, duration, step, *, components=None, wave_ramp=None, gusts=None,
               tolerance=1e-3, seed=0, drift=True, carrier=None):  # fmt: skip
    """`Realisation` of a body from `body_at`, in the wind, current and drift of its SinglePoint.

    duration, step : s; components : wave components; wave_ramp : start and length of their growth, (s, s)
    gusts : GustSpectrum of the wind; drift : True for the mean drift of the loads, False for the drift of the waves
    carrier : `mooring.on_current.waves.Carrier` of the waves, whose frequencies are intrinsic; None in still water
    raises : SinglePointError
    """
    loads = steady.point.loads
    wind = None if loads.wind is None else Wind(loads.wind.speed, loads.wind.direction)
    held = on_hull(steady.point, body.slow_added_mass, drift, body.reader.rotation_center[2])
    weather = Weather(wind=wind, gusts=gusts, on_hull=held, components=components, carrier=carrier)
    kind = "none" if drift else "newman"
    settings = Settings(duration, 0.0, step, tolerance, slow_drift=kind, wave_ramp=wave_ramp)
    try:
        return simulate(body, weather, settings, seed, partial(report_progress, IN_TIME))
    except SimulationError as error:
        raise SinglePointError(str(error)) from None


def _stretch(steady, state, rope, buoy):
    """Additional distance of the body from its buoy when its hawser is stretched by its tension, m; shape (3,)

    and the buoy tilted accordingly
    """
    tension = float(steady.hawser.max())
    away = state[:2] + _turned(state[2]) @ steady.point.apex - steady.buoy
    size = np.hypot(*away)
    if not (tension > 0 and size > 0):
        return np.zeros(3)
    longer = steady.point.lengths.max() * float(rope.strain_at(tension))
    longer += buoy.yields(float(steady.hawser.sum()), steady.point.system)
    return np.array([*(away / size * longer), 0.0])


def _turned(heading):
    c, s = np.cos(heading), np.sin(heading)
    return np.array([[c, -s], [s, c]])


def _at_the_bow(point, center, end, afloat):
    """System in which the lines of a contact buoy end on the body"""
    system = point.system
    z = system.bodies[0].position[2]
    body = replace(system.bodies[0], position=(*center[:2], center[2] if afloat else 0.0, 0.0, 0.0, 0.0))
    at = (end[0], end[1], z - body.position[2])
    points = []
    for one in system.points:
        if isinstance(one, Fairlead):
            own = np.asarray(one.position, float)
            one = replace(one, position=(at[0] + own[0], at[1] + own[1], at[2] + own[2]))
        points.append(one)
    return replace(system, bodies=(body,), points=tuple(points))
