"""Motion in time of a body at a single point, from near one of its equilibrium headings, by one of three schemes.

`slow_run` computes the slow motion alone. `two_scale_run` adds wave motion in each step at a fixed slow position, as
the report does. `full_run` has slow and wave motion in one equation. Gusts belong to the wind of the loads. Line
tensions are static, with the ends moved by slow and wave motion together.
"""

import warnings
from dataclasses import dataclass

import numpy as np

from ..on_current.waves import in_water
from ..response.seas import outside
from .history import Record, cycle, line_tensions, settled_after, watch_circle
from .in_time import Run, gusty, of_contact
from .one_equation import run_in_one
from .slewing import slew, turned_state
from .two_scale import Steps, two_scale
from .waves import GROWS, mean_frequency, slow_part, split_frequency

SLOW_STEP, FULL_STEP = 1.0, 0.5  # s, step of the record of slow motion, and of one equation
OF_PERIOD = 30  # steps of the record in a mean period of the waves, of two scales
MISSED = 0.05  # share of the energy of the waves


@dataclass(frozen=True)
class Times:
    """Duration and steps of a run.

    duration, step (of the record, None for the scheme's step), slow_step (for two scales), waves_after : s
    offset : rad, initial heading relative to the heading at rest; tolerance : tolerance of place and heading; seed :
    seed of the gusts
    """

    duration: float = 1200.0
    step: float | None = None
    slow_step: float = 10.0
    waves_after: float = 0.0
    offset: float = np.radians(2.0)
    tolerance: float = 1e-4
    seed: int = 1

    def begin(self, steady):
        """Initial state near an Equilibrium; shape (6,)"""
        return turned_state(steady.point, steady.state, self.offset)


def slow_run(steady, times: Times) -> Run:
    """Run of the slow motion alone.  Raises SinglePointError."""
    point, step = steady.point, SLOW_STEP if times.step is None else times.step
    wind = gusty(point, times.duration, times.seed)
    slow = slew(point, times.begin(steady), times.duration, step, tolerance=times.tolerance, wind_speed=wind)
    lines, still = line_tensions(point, slow.buoy), np.zeros((len(slow.time), 6))
    record = Record(slow.time, slow.place, slow.heading, still, slow.buoy, slow.hawser, lines, slow.wind_speed)
    return _run(record, steady)


def two_scale_run(steady, times: Times, body) -> Run:
    """Run with the waves of a `two_scale.WaveBody`, without slow drift.  Raises SinglePointError."""
    point, fast = steady.point, 2 * np.pi / body.mean_omega / OF_PERIOD if times.step is None else times.step
    steps = Steps(times.duration, times.slow_step, fast, times.waves_after)
    record = two_scale(point, times.begin(steady), steps, body, gusty(point, times.duration, times.seed))
    return _run(record, steady, full_waves=times.waves_after + GROWS * 2 * np.pi / body.mean_omega)


def full_run(steady, times: Times, moved, components=None, drift=True, carrier=None) -> Run:
    """Run of slow and wave motion in one equation.

    moved : `one_equation.body_at` the start of the run; components : components of the waves, None in still water
    drift : whether pairs of waves drive slow drift, in place of the mean drift of the loads
    carrier : `mooring.on_current.waves.Carrier` of the waves, None in still water
    """
    point, step, grown = steady.point, FULL_STEP if times.step is None else times.step, None
    if components is not None:
        period = 2 * np.pi / mean_frequency(components.omega, components.amplitude)
        grown = times.waves_after, GROWS * period
    wind = point.loads.wind
    found = run_in_one(steady, moved, times.duration, step, components=components, wave_ramp=grown,
                       gusts=None if wind is None else wind.gusts, tolerance=times.tolerance, seed=times.seed,
                       drift=not drift, carrier=carrier)  # fmt: skip
    center = np.asarray(moved.reader.rotation_center, float)[:2]
    slow, wave = found.motion[:, [0, 1, 5]], found.motion.copy()
    if components is not None:
        slow = slow_part(slow, step, split_frequency(components.omega, components.amplitude))
    wave[:, [0, 1, 5]] -= slow
    if point.lengths[0] == 0.0:
        buoy, hawser, lines = of_contact(point, found, center)
    else:
        buoy, hawser, lines = found.buoy[:, :2] + point.system.bodies[0].position[:2], found.hawser, found.buoy_lines
    record = Record(found.time, slow[:, :2] + center, slow[:, 2], wave, buoy, hawser, lines, found.wind_speed)
    said = tuple(dict.fromkeys((*moved.findings, *found.findings)))
    return _run(record, steady, bool(drift), said, np.inf if grown is None else sum(grown))


def _run(record, steady, drifts=False, findings=(), full_waves=np.inf):
    settled = settled_after(record.time, record.heading, steady.heading)
    radius = watch_circle(record.place, steady.point.origin)
    return Run(record, steady, cycle(record.time, record.heading), settled, radius, drifts, findings, full_waves)


def sea_components(sea, count, seed, reader, carrier=None, gravity=9.80665):
    """Components of a Sea within the frequency range of a database Reader.

    carrier : `mooring.on_current.waves.Carrier` of the waves, None in still water
    raises : ValueError if more than a twentieth of the sea's energy lies outside this range
    """
    missed, band = outside(sea.spectrum, reader.omega, MISSED)
    if missed > MISSED:
        raise ValueError(
            f"{100 * missed:.3g} % of the waves' energy lies outside the stored frequencies; allowed: "
            f"{100 * MISSED:g} %; solve {band} as well"
        )
    low, high = np.clip(sea.spectrum.quantile((1e-4, 1 - 1e-3)), reader.omega[0], reader.omega[-1])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # reported above if it exceeds the omission of the report's own spectrum
        found = sea.components(count, seed, low=float(low), high=float(high))
    return in_water(found, carrier, reader.depth, gravity)
