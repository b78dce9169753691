"""Trial of whether lines of a body may have their static shape: a short run with static lines and one with moving
lines.

A line in its static shape has neither inertia nor drag.  A static line snaps where a real line in water would yield,
and it takes no energy out of slow motion. For example, static chains in shallow water make a symmetric body surge
and yaw in beam waves (Mathieu's instability of a stiffening spring), while the drag of real chains damps this
motion. Both runs therefore contain the whole body, in equal waves and gusts. Both runs start a little off the
equilibrium, since an instability would take hours to grow out of rounding errors. If tensions or slow motion differ
by more than NEGLIGIBLE, all lines are dynamic. If tensions of a first trial of length SHORT already differ by more
than CLEAR, lines are dynamic without a longer trial. Dynamic lines neglect nothing, so a trial that is too short
could cost time but would never be unsafe.

The regimes of the simplified method (`mooring.lines.regimes`) were tried for this decision. Of random chains, wires and
ropes in their quasi-static regime, every second one differed by more than a tenth in a run
(`tests/bench/line_regimes.py`).
"""

import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...lines.system.hawser import Hawser
from ..line_loads import body_lines
from ..moving_lines.prepare import dynamic_line, ends_of
from .failures import SimulationError

LONGEST, SHORT = 600.0, 100.0  # s of a trial, and of the first one
# largest negligible change, over the largest tension or σ of a slow motion.  On chains in 14 and 20 m of water, from
# calm to storm, a trial changed by more wherever an hour changed by more than a fifth; tensions of an hour changed up
# to twice as much
NEGLIGIBLE = 0.05
CLEAR = 4 * NEGLIGIBLE  # change of a tension in a first trial that decides
NUDGE = 2e-3  # initial offset of both trial runs, over the distance to the fairleads
# share of the largest slow motion; smaller motions, and those that remain below their start, are not compared
MINOR = 0.1
PLANE = (0, 1, 5)
FEW = 3  # largest number of names in a message
# behaviour of lines without inertia and drag, by trials of floaters A and three pontoons (tests/bench)
TOO_LARGE = "slow motion and snap loads are too large, snap loads 1.6 to 9 times on chains in 10 to 20 m of water"
TOO_SMALL = (
    "the inertia of bodies on the line is missing too, and tensions are too small: of RM3, with 17 t at 40 m from the "
    "fairlead, σ is 13.0 instead of 3.7 kN; move the fairlead as in the run by hakobune line-dynamics"
)


class Choice(NamedTuple):
    """settings : settings with names in dynamic_lines; words : results of the trial; left_out : lines that cannot be
    dynamic

    pace : computing time per simulated time, for (static, moving) lines; nan without a trial
    """

    settings: object
    words: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    pace: tuple[float, float] = (np.nan, np.nan)


class Difference(NamedTuple):
    """Effect of the motion of lines. share : difference of two values over the larger value; words : the effect in
    numbers
    """

    share: float
    words: str


def chosen(run, moored, weather, settings):
    """`Choice` for the lines of a `Moored` body by a trial; one choice serves every seed.

    run : (moored, weather, settings, seed, progress) → `Realisation`
    raises : SimulationError if neither run is possible
    """
    able, left_out = able_to_move(moored.system, settings)
    still = replace(settings, dynamic_lines=(), lines_lost=(), estimate_error=False)
    still = replace(still, duration=min(settings.duration, LONGEST))
    if not able or not _drives(weather):
        return Choice(replace(settings, dynamic_lines=()), (), left_out)
    for length in sorted({min(SHORT, still.duration), still.duration}):
        found, pace, failed = _both(run, moored, weather, replace(still, duration=length), able)
        if not failed and _of_tension(moored, *found).share > CLEAR:
            break
    if len(failed) == 2:
        raise failed[1]
    static, moving = found
    begin = f'dynamic_lines = "auto": in a trial of {length:g} s'
    if moving is None:
        told = f"left out: the motion of the lines: {failed[0]}"
        return Choice(replace(settings, dynamic_lines=()), (), (told, *left_out), tuple(pace))
    some = f"{len(able)} of {len(moored.system.lines)}"
    if static is None:
        words = f"{begin} a run with static lines fails ({failed[0]}): {some} move"
        return Choice(replace(settings, dynamic_lines=able), (words,), left_out, tuple(pace))
    changes = _of_tension(moored, static, moving), _of_slow_motion(moored, static, moving)
    moves = max(one.share for one in changes) > NEGLIGIBLE
    which = f"{some} lines have a motion of their own" if moves else "lines stay in their static shape"
    words = f"{begin} {changes[0].words}, {changes[1].words}: {which}"
    return Choice(replace(settings, dynamic_lines=able if moves else ()), (words,), left_out, tuple(pace))


def _both(run, moored, weather, settings, able):
    """Realisations with static and with moving lines, None for one that fails, pace of each, and the errors"""
    body, found, pace, failed = _nudged(moored), [], [], []
    for names in ((), able):
        clock = _Pace(settings)
        try:
            found.append(run(body, weather, replace(settings, dynamic_lines=names), 0, clock))
        except SimulationError as error:
            found.append(None)
            failed.append(error)
        pace.append(clock.seconds)
    return found, pace, failed


def able_to_move(system, settings):
    """Names of the lines of a System, or None, that can be dynamic, and findings on lines that cannot"""
    able, kept, loaded = [], {}, []
    for line in () if system is None else system.lines:
        if isinstance(line, Hawser):  # without weight it has no dynamics
            continue
        try:
            dynamic_line(line, ends_of(line, system)[0].position, system, settings.dynamic_elements)
            able.append(line.name)
        except ValueError as error:
            loaded += [line.name] * bool(getattr(line, "loads", ()))
            why = str(error).removeprefix("dynamic_lines: ").replace(f" of line {line.name}", "")
            kept.setdefault(" ".join(why.split()), []).append(line.name)
    told = [
        f"left out: inertia and drag of {_named(names)} in static shape, so that {TOO_LARGE}: {why}"
        for why, names in kept.items()
    ]
    told += [f"left out: sinkers and buoys of {_named(loaded)}: {TOO_SMALL}"] if loaded else []
    return tuple(able), tuple(told)


def _named(names):
    more = f" and {len(names) - FEW} more" if len(names) > FEW else ""
    return f"line{'s' * (len(names) > 1)} {', '.join(names[:FEW])}{more}"


def _drives(weather):
    """Whether anything in a `Weather` varies in time"""
    return bool(weather.seas or weather.forces) or not (
        weather.regular is None and weather.components is None and weather.gusts is None
    )


def _nudged(moored):
    """A `Moored` body that begins off its place; not at a berth, where half a metre is too much for fenders"""
    if moored.berth.names:
        return moored
    off, start = NUDGE * _arm(moored), moored.start.copy()
    start[: moored.reader.rigid] += np.tile([off, off, 0, 0, 0, NUDGE], moored.reader.rigid // 6)
    return replace(moored, start=start)


def _arm(moored):
    """m, to the fairlead farthest from the axis"""
    return float(np.hypot(*body_lines(moored.system).fairlead[:, :2].T).max())


def _of_tension(moored, static, moving):
    """`Difference` of the line whose largest tension changes most"""
    pulls = [run.tension[run.time >= 0].max(axis=0) for run in (static, moving)]
    most = int(np.argmax(np.abs(pulls[0] - pulls[1])))
    share = abs(pulls[0][most] - pulls[1][most]) / max(pulls[0].max(), pulls[1].max())
    name, (one, other) = moored.system.line_names[most], (1e-3 * pull[most] for pull in pulls)
    return Difference(share, f"{name} pulls up to {one:.4g} kN in its static shape and {other:.4g} kN in motion")


def _of_slow_motion(moored, static, moving):
    """`Difference` of the slow motion whose σ changes most, without those that are relatively small"""
    words = moored.reader.words
    names = [words[i] for i in range(moored.reader.rigid) if i % 6 in PLANE]
    units = ("m", 1.0), ("m", 1.0), ("°", 180 / np.pi)
    sigma = np.array([run.slow[run.time >= 0].std(axis=0) for run in (static, moving)])
    size = (sigma * np.tile([1.0, 1.0, _arm(moored)], len(names) // 3)).max(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        least = max(MINOR * size.max(), NUDGE * _arm(moored))
        share = np.where(size > least, np.abs(sigma[0] - sigma[1]) / sigma.max(axis=0), 0.0)
    most = int(np.argmax(share))
    unit, factor = units[most % 3]
    one, other = factor * sigma[:, most]
    return Difference(
        float(share[most]),
        f"slow {names[most]} has σ {one:.3g} {unit} with static lines and {other:.3g} {unit} with moving lines",
    )


class _Pace:
    """Called with the finished share: seconds per simulated second, without compilation and loading at the start"""

    def __init__(self, settings):
        self.length, self.seen = settings.ramp + settings.duration, []

    def __call__(self, share):
        self.seen.append((share, time.perf_counter()))

    @property
    def seconds(self):
        """Computing time of a run, s; nan for a run with too few steps"""
        if len(self.seen) < 2 or self.seen[-1][0] <= self.seen[0][0]:
            return np.nan
        (first, begun), (last, ended) = self.seen[0], self.seen[-1]
        return (ended - begun) / ((last - first) * self.length)
