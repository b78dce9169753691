"""Wind and current on a body in time: steady coefficients times the square of the relative velocity, including gusts.

    F = c(α) |U|²,    U = U∞ (1 + u′/|U∞|) − (u, v) in the body's axes, α its angle

F has six components: forces act at their own height (`loads.on_hull`; SR179 report, 1982, eq. 3.7.1.8).
"""

import warnings
from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.in_memory import in_memory
from hakobune.bem.kernels.jit import kernel

from ..environment.gusts import MissingVariance, gust_components
from ..environment.wave_records import real_sum
from ..loads.on_hull import current_on, wind_on
from .tables.hull_water import drag_share
from .tables.interpolation import between_samples, on_ring, ring_table

RING = 720  # angles of a table of coefficients
GUST_BAND = (2 * np.pi * 1e-4, 2 * np.pi)  # rad/s; the report uses 0.001 to 1 Hz
GUST_STEP, GUSTS = 0.2, 400  # s, number of components


@in_memory
class Stream(NamedTuple):
    """Wind or current in the form that the kernels read.

    table : (bodies, RING + 3, 6), N s²/m² and N s², forces at unit speed at equally spaced angles; velocity : (2,)
        m/s in space
    gusts : (1, n) m/s along the mean velocity, from `first` s on in steps of GUST_STEP; one column without gusts
    still : (bodies,), fraction of the table that applies in water at rest (`loads.on_hull.StreamOnHull.share`)
    """

    table: np.ndarray
    velocity: np.ndarray
    gusts: np.ndarray
    first: float
    still: np.ndarray


def calm(bodies=1):
    """A Stream that exerts no force"""
    return Stream(np.zeros((bodies, RING + 3, 6)), np.zeros(2), np.zeros((1, 1)), 0.0, np.ones(bodies))


def on_all(streams):
    """The Stream of one wind or current on several bodies, from the Streams on each body"""
    return streams[0]._replace(
        table=np.concatenate([one.table for one in streams]), still=np.concatenate([one.still for one in streams])
    )


def wind_stream(wind, hull, center, gusts=None, seed=0, start=0.0, end=0.0):
    """The Stream of a `Wind` on an `ExposedBox`, with gusts of a `GustSpectrum` from `start` to `end` s."""
    unit = wind_on(wind, hull).about(_around(), center)
    return stream_of(unit, wind.speed, wind.direction, gusts, seed, start, end)


def stream_of(unit, speed, direction, gusts=None, seed=0, start=0.0, end=0.0):
    """The Stream of forces (n, 3), N and N m, at unit speed, over the direction of flow, about the centre of the
    motion
    """
    record, first = np.zeros((1, 1)), start
    if gusts is not None:
        first = start - 4 * GUST_STEP
        t = first + GUST_STEP * np.arange(int(np.ceil((end - first) / GUST_STEP)) + 6)
        with warnings.catch_warnings():  # the part above 1 Hz moves no hull
            warnings.simplefilter("ignore", MissingVariance)
            omega, amplitude, phase = gust_components(gusts, seed, *GUST_BAND, GUSTS)
        record = real_sum(amplitude * np.exp(-1j * phase), omega, t)[None]
    return Stream(ring_table(unit)[None], _vector(speed, direction), record, float(first), np.ones(1))


def current_stream(current, hull, center, density, depth):
    """The Stream of a `Current` (None: water at rest) on an `ExposedBox`; raises ValueError without coefficients."""
    water = current_on(current, hull, density, depth)
    velocity = np.zeros(2) if current is None else _vector(current.speed, current.direction)
    table = ring_table(water.about(_around(), center))[None]
    return Stream(table, velocity, np.zeros((1, 1)), 0.0, np.array([water.still]))


def _around():
    """Directions all around, rad; shape (RING,)"""
    return np.arange(RING) * (2 * np.pi / RING)


@kernel(counted=False)
def stream_force(stream, body, t, share, moving, weights, out, value):
    """Fill out (6,), N and N m, the force on a body, in its axes, of a stream that has grown to the fraction `share`
    of its speed.

    moving : (3,), heading of the body, rad, and its velocities along and across this heading, m/s
    weights, value : work arrays (6,) and (1,)
    """
    heading, u, v = moving[0], moving[1], moving[2]
    cos, sin = np.cos(heading), np.sin(heading)
    value[0] = 0.0
    if stream.gusts.shape[1] > 1:
        between_samples(stream.gusts, (t - stream.first) / GUST_STEP, weights, value)
    # roots, since `hypot` takes three times their time
    gust, speed = value[0], np.sqrt(stream.velocity[0] ** 2 + stream.velocity[1] ** 2)
    grown = 1.0 + gust / speed if speed > 0.0 else 1.0
    x, y = share * stream.velocity[0] * grown, share * stream.velocity[1] * grown
    along, across = cos * x + sin * y - u, -sin * x + cos * y - v
    share_left = drag_share(stream.still[body], np.sqrt(x * x + y * y), np.sqrt(u * u + v * v))
    square = (along * along + across * across) * share_left
    on_ring(stream.table[body], np.arctan2(across, along), weights, out)
    for j in range(6):
        out[j] *= square


def gust_at(stream, t):
    """Speed of the gusts at times t (n,), s, m/s; shape (n,)"""
    if stream.gusts.shape[1] == 1:
        return np.zeros(len(t))
    return np.interp(t, stream.first + GUST_STEP * np.arange(stream.gusts.shape[1]), stream.gusts[0])


def _vector(speed, direction):
    return speed * np.array([np.cos(direction), np.sin(direction)])
