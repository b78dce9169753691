"""The limit cycle of a slewing body: amplitude, period and tensions, independent of the start.

The motion is computed from one largest heading ψ to the next.  A period at the amplitude A changes ψ by Δψ = gA,
where g near the onset of slewing is linear in A² (Hopf). A line through two periods predicts the amplitude for which
g = 0, and the motion about its mean over a period is scaled to this amplitude. A cycle attracts the motion if g
falls with A. Otherwise the motion continues without scaling; after MOST periods the result is the range of the
heading.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.kernels.progress import CYCLE, report_progress

from .body import SinglePointError
from .history import line_tensions
from .slewing import turned_state, until_turn

SETTLED = 1e-4  # convergence of the amplitude of the cycle
ACCURACY = 1e-7  # relative accuracy of the integration
SAMPLES = 128  # samples per period
MOST = 100  # periods that are followed
SCALED = 2.0  # largest change of an amplitude in one step, as a factor
HALVED = 4  # number of halvings of the logarithm of a scaling
LEAST = np.radians(0.05)  # amplitude below which the body is at rest, rad
START = np.radians(2.0)  # initial heading relative to the equilibrium, rad
LATEST = 30.0  # latest time of the turn, over 1/|λ| of the growing root


class LimitCycle(NamedTuple):
    """A slewing cycle, over one period starting at a largest heading; n = SAMPLES + 1.

    period : s; amplitude, middle : rad, of the heading; time : (n,) s; states : (n, 6) of `slewing.rates`
    hawser : (n, k), lines : (n, l) N
    """

    period: float
    amplitude: float
    middle: float
    time: np.ndarray
    states: np.ndarray
    hawser: np.ndarray
    lines: np.ndarray


class _Period(NamedTuple):
    """amplitude : rad; change : g; length : s; samples : function of (n,) s → (n, 6); end : (6,)"""

    amplitude: float
    change: float
    length: float
    samples: object
    end: np.ndarray


def limit_cycle(steady, turn=START) -> LimitCycle:
    """LimitCycle of a body that slews about an `Equilibrium`, starting `turn` rad from its heading.

    raises : SinglePointError if the heading is stable, the body comes to rest elsewhere or does not turn back, or no
        cycle appears within MOST periods
    """
    if steady.slewing.stable:
        raise SinglePointError(
            f"the heading of {np.degrees(steady.heading) % 360:.1f}° is stable, so slewing does not start from it"
        )
    point, longest = steady.point, LATEST / abs(steady.roots[0])
    state = until_turn(point, turned_state(point, steady.state, turn), +1.0, longest, ACCURACY).y[:, -1]
    state = until_turn(point, state, -1.0, longest, ACCURACY).y[:, -1]
    before = None
    for _ in range(MOST):
        now = _period(point, state, longest)
        report_progress(CYCLE, (now.amplitude, now.change))
        if now.amplitude < LEAST:
            raise SinglePointError(f"the slewing dies out at a heading of {np.degrees(now.end[2]) % 360:.1f}°")
        wanted = None if before is None else _foreseen(before, now)
        if wanted is not None and abs(wanted - now.amplitude) < SETTLED * now.amplitude:
            return _sampled(point, now)
        if wanted is None:
            state, before = now.end, now
            continue
        share = min(max(wanted / now.amplitude, 1 / SCALED), SCALED)
        state, before = _scaled(point, now, share, longest), now
    raise SinglePointError(
        f"no cycle within {MOST} periods: the heading still swings {np.degrees(now.amplitude):.3g}° to either side and "
        f"changes by {100 * now.change:.3g} % a period; simulate it in time with [slewing]"
    )


def _foreseen(before, now):
    """rad, amplitude at which a period changes nothing; None if no attractive cycle is predicted"""
    if abs(now.change) < ACCURACY:
        return now.amplitude
    apart = now.amplitude**2 - before.amplitude**2
    slope = (now.change - before.change) / apart if apart else 0.0
    if not slope < 0:
        return None
    square = now.amplitude**2 - now.change / slope
    return np.sqrt(square) if square > 0 else None


def _scaled(point, period, share, longest):
    """State one period after its deviation from the mean was scaled: motions other than slewing have then decayed

    Beyond the reach of the lines the scaling is reduced.
    """
    center = period.samples(np.linspace(0, period.length, SAMPLES, endpoint=False)).mean(axis=0)
    for _ in range(HALVED):
        try:
            return _period(point, center + share * (period.end - center), longest).end
        except SinglePointError:
            share = np.sqrt(share)
    return period.end


def _period(point, state, longest):
    """_Period from a state at a largest heading"""
    down = until_turn(point, state, +1.0, longest, ACCURACY)
    up = until_turn(point, down.y[:, -1], -1.0, longest, ACCURACY)
    half, end = down.t[-1], up.y[:, -1]
    lowest = down.y[2, -1]
    amplitude = 0.5 * (0.5 * (state[2] + end[2]) - lowest)

    def samples(t):
        return np.where(t < half, down.sol(np.minimum(t, half)), up.sol(np.maximum(t - half, 0.0))).T

    change = (end[2] - state[2]) / amplitude if amplitude > 0 else 0.0
    return _Period(amplitude, change, half + up.t[-1], samples, end)


def _sampled(point, period):
    time = np.linspace(0.0, period.length, SAMPLES + 1)
    states = period.samples(time)
    buoy, hawser, near = np.empty((len(time), 2)), np.empty((len(time), len(point.ends))), None
    for i, state in enumerate(states):
        held = point.hold(state[:2], state[2], near)
        buoy[i], hawser[i], near = held.buoy, held.tension, held.buoy
    heading = states[:, 2]
    middle = 0.5 * (heading.max() + heading.min())
    return LimitCycle(period.length, 0.5 * float(np.ptp(heading)), float(middle), time, states, hawser,
                      line_tensions(point, buoy))  # fmt: skip
