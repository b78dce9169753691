"""Forces given as tables in time, in the axes that turn with the body.

Between the rows they follow monotone cubics (Fritsch and Carlson 1980; `scipy.interpolate.PchipInterpolator`), which do
not overshoot, or cubic splines where they are smooth.  The first row also acts before its time, and the last row
after its time, so a table of a passage begins and ends with zeros. The ramp applies to given forces as to every load.

Drift by half waves (`mooring.response.slow_drift.half_wave_drift`; SR179 report (1982), eq. 3.7.1.5) is such a force.
"""

from dataclasses import dataclass, replace
from warnings import warn

import numpy as np

from ..environment.logger_files import read_table
from ..environment.tables import TableError, fault_of_steps
from ..environment.wave_records import UNEVEN, real_sum
from ..on_current.body import carrier_of_body
from ..on_current.waves import absolute_frequency
from ..response.sea_state import drift_on_current
from ..response.slow_drift import half_wave_drift, half_waves

COLUMNS = ("t", "Fx", "Fy", "Fz", "Mx", "My", "Mz")
GAP = 10.0  # usual steps of a table, above which a warning is given
FINE = 4  # samples of the shortest interval, between which polynomials of fifth degree have an error of 1e-4
MOST = 2_000_000  # samples
FREQUENCIES = 500  # frequencies of the drift, linear in between
SURFACE_STEP, PASSING = 0.1, 0.2  # s, of the surface; duration of the transition between the drifts of two half waves


@dataclass(frozen=True, eq=False)
class GivenForce:
    """times : (n,) s from the end of the ramp, ascending; force : (n, 6), N and N m about the rotation centre

    body : number of the loaded body among the moving bodies
    smooth : whether rows are so close that cubic splines between them do not overshoot
    """

    times: np.ndarray
    force: np.ndarray
    body: int = 0
    smooth: bool = False

    def __post_init__(self):
        t, force = np.asarray(self.times, float), np.asarray(self.force, float)
        object.__setattr__(self, "times", t)
        object.__setattr__(self, "force", force)
        if t.ndim != 1 or len(t) < 2 or force.shape != (len(t), 6):
            raise ValueError(f"a force has times {t.shape} and forces {force.shape}; allowed: (n,) and (n, 6), n ≥ 2")
        if not (np.all(np.isfinite(t)) and np.all(np.isfinite(force)) and np.all(np.diff(t) > 0)):
            raise ValueError("a force has times that do not increase, or values that are not finite")


def read_force(path):
    """`GivenForce` of a CSV file with a row of names and the columns t (s), Fx, Fy, Fz (N), Mx, My, Mz (N m).

    Steps may have any length; a step of GAP usual steps causes a warning.  raises : TableError with the file and the
    line
    """
    names, values, lines = read_table(path)
    if names is None or sorted(names) != sorted(COLUMNS):
        shown = "no column names in its first row" if names is None else f"the columns {', '.join(names)}"
        raise TableError(f"{path} has {shown}; allowed: {', '.join(COLUMNS)}; rename them")
    values = values[:, [names.index(name) for name in COLUMNS]]
    t, steps = values[:, 0], np.diff(values[:, 0])
    if len(t) < 2:
        raise TableError(f"{path} has one row; allowed: 2 or more")
    if steps.min() <= 0:
        raise fault_of_steps(path, t, UNEVEN, lines)
    i, usual = int(steps.argmax()), float(np.median(steps))
    if steps[i] > GAP * usual:
        warn(
            f"{path}: line {lines[i + 1]}: no force is given from {t[i]:g} to {t[i + 1]:g} s, and the "
            f"step elsewhere is {usual:g} s; the gap is interpolated",
            stacklevel=2,
        )
    return GivenForce(t, values[:, 1:])


def drift_of_half_waves(reader, components, heading, ramp, duration):
    """`GivenForce` of the drift by half waves on a body with a fixed heading, rad.  Raises ValueError without waves.

    reader : `bem.database.reader.Reader` with drift; a current, if any, is in its axes
    components : wave components at intrinsic frequencies, taken to travel in their mean direction; ramp, duration : s
    """
    t = SURFACE_STEP * np.arange(int(np.ceil((ramp + duration) / SURFACE_STEP)) + 2)
    energy, carrier = components.amplitude**2, carrier_of_body(reader)
    towards = np.arctan2(*(energy @ f(components.direction) for f in (np.sin, np.cos)))
    omega = np.linspace(reader.omega[0], reader.omega[-1], FREQUENCIES)
    if carrier is None:
        drift, met = reader.drift(omega, [towards - heading])[:, 0], components.omega
    else:
        drift = drift_on_current(reader, omega, [towards - heading])[0][:, 0]
        own, turned = np.concatenate([components.omega, omega]), components.direction - heading
        along = carrier.along(np.concatenate([turned, np.full(FREQUENCIES, towards - heading)]))
        met, omega = np.split(absolute_frequency(own, along, reader.depth, reader.gravity), [len(turned)])
        last = int(np.argmax(omega)) + 1  # the current blocks the waves beyond it
        drift, omega = drift[:last], omega[:last]
    surface = real_sum(components.amplitude * np.exp(1j * np.asarray(components.phase)), met, t)
    waves = half_waves(surface, SURFACE_STEP)
    ends = np.append(waves.start, waves.end)
    wide = np.minimum(0.25 * np.diff(ends), 0.5 * PASSING)
    times = np.stack([ends[:-1] + wide, ends[1:] - wide], axis=1).ravel()
    force = np.zeros((len(times), 6))
    force[:, [0, 1, 5]] = half_wave_drift(waves, omega, drift, times)
    return GivenForce(np.concatenate([[0.0], times, t[-1:]]) - ramp, force[[0, *range(len(force)), -1]])


def faded(force, time):
    """The GivenForce from 0 s on, with half a cosine of `time` s from zero before it and half a cosine to zero after
    it
    """
    t, own = force.times - force.times[0], force.force
    count = 2 + int(np.ceil(time / np.diff(t).max()))
    share = np.linspace(0.0, 1.0, count)[:-1, None]
    grown = 0.5 - 0.5 * np.cos(np.pi * share)
    times = np.concatenate([time * share[:, 0], time + t, time + t[-1] + time * (1.0 - share[::-1, 0])])
    return replace(force, times=times, force=np.concatenate([grown * own[0], own, grown[::-1] * own[-1]]))


def check_lasts(force, duration):
    """Raises ValueError for a GivenForce that begins after 0 s, or ends before the duration, s, with a force that is
    not zero
    """
    start, end = force.times[[0, -1]]
    if (start > 0 and force.force[0].any()) or (end < duration and force.force[-1].any()):
        raise ValueError(
            f"a force is given from {start:g} to {end:g} s; allowed: from 0 or before to {duration:g} s or later, or a "
            "table that begins and ends with zeros, outside which no force acts"
        )


def sampled(forces, ramp, duration, bodies=1):
    """Sum of GivenForces at equal steps from −ramp to the duration, shape (6N, m), and the step, s; one column without
    forces

    raises : ValueError for a table that does not last
    """
    if not forces:
        return np.zeros((6 * bodies, 1)), 1.0
    from scipy.interpolate import CubicSpline, PchipInterpolator

    for one in forces:
        check_lasts(one, duration)
    step = min(float(np.diff(one.times).min()) for one in forces) / FINE
    step = max(min(step, (ramp + duration) / 8), (ramp + duration) / MOST)
    t = step * np.arange(int(np.ceil((ramp + duration) / step)) + 4) - ramp
    total = np.zeros((6 * bodies, len(t)))
    for one in forces:
        between = (CubicSpline if one.smooth else PchipInterpolator)(one.times, one.force)
        total[6 * one.body : 6 * one.body + 6] += between(np.clip(t, one.times[0], one.times[-1])).T
    return total, step
