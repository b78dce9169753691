"""Results of a run in time: tensions of the lines, watch circle, whether slewing decays or persists."""

from typing import NamedTuple

import numpy as np

from ..lines.system.graph import Pose
from .body import NO_POINTS, SinglePoint

LAST = 1 / 3  # last part of a run, in which persistence of slewing is tested
STAYS, KEPT = 0.02, 0.8  # rad, amplitude of a slewing that stays, and its share that is left from half to half
SETTLED = np.radians(0.2)  # heading amplitude at rest, rad


class Record(NamedTuple):
    """A body at a single point in time. time : (n,) s; place, heading : slow motion, (n, 2) m and (n,) rad

    wave : additional wave motion along x, y, z, (n, 6), m and rad
    buoy : (n, 2) m; hawser : (n, k) N, and lines : (n, l) N, tensions by slow and wave motion together; wind_speed :
        (n,) m/s
    """

    time: np.ndarray
    place: np.ndarray
    heading: np.ndarray
    wave: np.ndarray
    buoy: np.ndarray
    hawser: np.ndarray
    lines: np.ndarray
    wind_speed: np.ndarray


class Cycle(NamedTuple):
    """Slewing at the end of a run: amplitude : rad of the heading; period : s, nan without oscillation

    growing : amplitude in the second half of this part over that in the first half; stays : whether slewing persists
    """

    amplitude: float
    period: float
    growing: float
    stays: bool


def line_tensions(point: SinglePoint, buoy, height=None):
    """Tension of each line, N, at the more loaded end, with the buoy at (n, 2) m; shape (n, lines).

    height : height of the buoy, (n,) m, None to compute it
    """
    system, turn = point.system, point.system.pose.turn
    z = np.full(len(buoy), system.bodies[0].position[2]) if height is None else np.asarray(height, float)
    if height is None and "Heave" in system.bodies[0].freedom:
        for i, place in enumerate(buoy):
            z[i] = point.pull(place, z[i - 1] if i else None).height
    places = np.column_stack([buoy, z])
    if system.composites or system.hawsers:
        rows = np.array([system.load(Pose(place[None], turn, NO_POINTS)).rows for place in places])
    else:
        rows = _uniform_rows(system, places, turn)
    return np.maximum(np.hypot(rows[..., 1], rows[..., 3]), np.hypot(rows[..., 2], rows[..., 4]))


def _uniform_rows(system, places, turn):
    """Rows of `System.load` with the buoy at (n, 3) m, all at once; shape (n, lines, …)"""
    from ..lines.system.assembly import rows_of

    arrays, n = system.arrays, len(places)
    points = system.load(Pose(places[:1], turn, NO_POINTS)).points
    moved = points + (arrays.owner >= 0)[:, None] * (places - places[0])[:, None]
    ends = arrays.ends + len(points) * np.arange(n)[:, None, None]
    rows = rows_of(moved.reshape(-1, 3), ends.reshape(-1, 2), np.tile(arrays.flipped, n),
                   np.tile(arrays.lines, (n, 1)), arrays.bed)  # fmt: skip
    return rows.reshape(n, len(system.lines), -1)


def cycle(time, heading) -> Cycle:
    """Cycle of the last part of a record: time (n,) s at equal steps, heading (n,) rad"""
    late = time >= time[0] + (1 - LAST) * (time[-1] - time[0])
    t, x = time[late], heading[late] - heading[late].mean()
    first, second = np.array_split(x, 2)
    amplitude = 0.5 * np.ptp(x)
    growing = np.ptp(second) / max(np.ptp(first), 1e-300)
    up = np.flatnonzero((x[:-1] < 0) & (x[1:] >= 0))
    period = np.nan
    if len(up) > 1:
        places = t[up] - x[up] * (t[up + 1] - t[up]) / (x[up + 1] - x[up])
        period = float(np.mean(np.diff(places)))
    stays = bool(amplitude > STAYS and growing > KEPT and np.isfinite(period))
    return Cycle(float(amplitude), period, float(growing), stays)


def wave_deviations(record, after):
    """Standard deviations of wave motion from `after`, s, on: surge, sway, heave, m, roll, pitch, yaw, rad; shape (6,)

    Surge and sway are along and across the hull at its slow heading; nan if the record ends earlier
    """
    late = record.time >= after
    if not late.any():
        return np.full(6, np.nan)
    motion, cos, sin = record.wave[late].copy(), np.cos(record.heading[late]), np.sin(record.heading[late])
    x, y = motion[:, 0].copy(), motion[:, 1].copy()
    motion[:, 0], motion[:, 1] = cos * x + sin * y, cos * y - sin * x
    return motion.std(axis=0)


def moves_in_waves(run):
    """Whether a Run has wave motion"""
    return bool(np.any(wave_deviations(run.record, run.full_waves) > 0))


def settled_after(time, heading, final):
    """Time, s, after which a heading remains within SETTLED, rad, of its final value; nan if it never settles"""
    away = np.abs(heading - final) > SETTLED
    if not away.any():
        return float(time[0])
    last = int(np.flatnonzero(away)[-1])
    return float(time[last + 1]) if last + 1 < len(time) else np.nan


def watch_circle(place, origin):
    """Radius of the watch circle, m: largest distance of positions (n, 2) m from (2,) m"""
    return float(np.hypot(*(place - origin).T).max())
