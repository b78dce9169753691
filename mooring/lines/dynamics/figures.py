"""Figures of a run of a dynamic line: tensions, slack, work, energy losses, and the quasi-static tension.

An end is slack if its tension is below a tenth of the tension at rest. The dynamic force then exceeds 0.9 of the
static force, the slack criterion of DNV-RP-H103 (2011), section 4.4.3.  Means are means over time; figures of a
periodic run are taken over full cycles.
"""

from dataclasses import dataclass, field

import numpy as np

SLACK = 0.1  # tension below which a line is slack, over its tension at rest
POSITIONS = 48  # positions of the fairlead for the quasi-static tension
INSTANT = 1e-3  # s, a run whose first row is the line at rest
SMALL_WORK = 1e-2  # work below which no share of it is printed, over the energy lost, gained and stored
NONE = 1e-6  # tension that is rounding and no divisor, relative to the largest tension and to the heaviest node
LOSSES = ("drag", "water_inertia", "structural", "bed", "friction")


@dataclass(frozen=True)
class End:
    """Tension at one end, N, in the window: the largest, at `time` s, the mean and the smallest; rest : tension before
    the motion

    slack : time in the window with a tension below a tenth of the tension at rest, s; nan if the tension at rest is
        zero
    quasi_static : largest tension of the line at rest in every position, N, nan if none has a static shape
    over_quasi_static : largest tension over quasi_static; nan where quasi_static is nan
    """

    largest: float
    time: float
    mean: float
    least: float
    rest: float
    slack: float
    quasi_static: float
    over_quasi_static: float


@dataclass(frozen=True)
class Figures:
    """begin, end : s, the window; cycles : in the window, or None for a motion that is not periodic

    work : work at the ends in the window, J, computed as losses plus stored energy; losses : {name: J}
    stored : change of the stored energy, J
    of_forces : work at the ends as the integral of force times velocity, J; exchanged : energy that went in or out, J
    change : relative change of the largest tension between the last two cycles
    regime : HarmonicTension, or the reason for none
    """

    begin: float
    end: float
    cycles: int | None
    fairlead: End
    anchor: End
    work: float
    losses: dict = field(default_factory=dict)
    stored: float = 0.0
    of_forces: float = 0.0
    exchanged: float = 0.0
    change: float = np.nan
    regime: object = ""

    def share_of_work(self, value):
        """`value`, J, over the work done on the line; nan if this work is zero

        A line whose fairlead hardly moves receives its work from waves and current. The work at its ends is then
        mere rounding error, or a small difference between the energies lost, gained and stored.
        """
        gross = sum(map(abs, (*self.losses.values(), self.stored)))
        told = abs(self.work) > SMALL_WORK * gross and self.exchanged > SMALL_WORK * abs(self.work)
        return value / self.work if told else np.nan

    @property
    def imbalance(self):
        """Work of the forces less losses and stored energy, J: the error of the time steps"""
        return self.of_forces - self.work


def figures(line, course, window, result, current, regime):
    """Figures of a Result.

    window : begin, end (s) and cycles of `Course.window`
    regime : function of the fairlead's displacement (3,) m at the largest quasi-static tension; or a text
        with the reason for none
    """
    begin, end, cycles = window
    statics, places = quasi_static(line, course, window, current)
    tensions = result.tension_fairlead, result.tension_anchor
    none = NONE * max(np.abs(line.system.weight).max(), *(tension.max() for tension in tensions))
    ends = [_end(result.time, T, begin, end, none, static) for T, static in zip(tensions, statics.T, strict=True)]
    E = result.energies
    work, of_forces, stored, *losses = (
        float(np.diff(np.interp([begin, end], result.time, values))[0])
        for values in (E.supplied, E.work, E.stored, *(getattr(E, name) for name in LOSSES))
    )
    inside = (result.time[1:] > begin) & (result.time[1:] <= end)
    exchanged = float(np.abs(np.diff(E.work))[inside].sum())
    change = np.nan
    if cycles is not None and cycles > 1:
        last, before = (
            _end(result.time, tensions[0], end - i * course.cycle, end - (i - 1) * course.cycle, none).largest
            for i in (1, 2)
        )
        change = abs(last / before - 1) if before > none else np.nan
    if not isinstance(regime, str):
        away = places[np.nanargmax(statics[:, 0])] - course.motion.mean
        regime = regime(away) if np.any(np.isfinite(statics)) else "no static shape"
    lost = dict(zip(LOSSES, losses, strict=True))
    return Figures(begin, end, cycles, *ends, work, lost, stored, of_forces, exchanged, change, regime)


def _end(time, tension, begin, end, none, static=(np.nan,)):
    inside = (time > begin) & (time < end)
    t = np.concatenate([[begin], time[inside], [end]])
    T = np.interp(t, time, tension)
    rest, top = float(tension[0]), int(np.argmax(T))
    slack = time_below(t, T, SLACK * rest) if rest > none else np.nan
    known = np.asarray(static)[np.isfinite(static)]
    still = float(known.max()) if known.size else np.nan
    return End(
        float(T[top]),
        float(t[top]),
        float(np.trapezoid(T, t) / (end - begin)),
        float(T.min()),
        rest,
        slack,
        still,
        float(T[top]) / still if still > none else np.nan,
    )


def time_below(t, values, level):
    """Time, s, in which `values` (n,) at times t (n,), joined by straight lines, are below `level`"""
    low, high = np.minimum(values[:-1], values[1:]), np.maximum(values[:-1], values[1:])
    span = np.where(high > low, high - low, 1.0)
    share = np.where(high > low, np.clip((level - low) / span, 0.0, 1.0), low < level)
    return float(share @ np.diff(t))


def quasi_static(line, course, window, current):
    """Tensions at fairlead and anchor, N, of the line at rest in `current` with its fairlead fixed at places (m, 3);
    shape (m, 2)

    The places are those of one cycle, or of the whole window; nan if the line has no static shape.
    """
    from ..catenary.state import LineError
    from .simulation import FairleadMotion, simulate

    begin = window[0] if course.cycle is None else window[1] - course.cycle
    places = np.array([course.motion.at(t)[0] for t in np.linspace(begin, window[1], POSITIONS + 1)])
    found = np.full((len(places), 2), np.nan)
    for row, place in zip(found, places, strict=True):
        try:
            held = simulate(line, FairleadMotion.still(place), INSTANT, current=current, check_mesh=False)
        except LineError:
            continue
        row[:] = held.tension_fairlead[0], held.tension_anchor[0]
    return found, places


def judged_by_regime(line, course, harmonics):
    """Function that gives HarmonicTension or a text for a displacement (3,) m; a text where the method does not
    apply.
    """
    from .regime import regime_of

    if harmonics != 1:
        return "the simplified method is for one harmonic motion"
    period = 2 * np.pi / float(course.motion.omega[0])
    return lambda displacement: regime_of(line, course.motion.mean, displacement, period)
