"""Results of a run in time: records, work of the loads, and errors of its motions."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.hinges import SHOWN

from ...lines.system.findings import beyond_tables
from .. import integrator
from ..contacts import courses
from ..equation import FIRST_WORK, WORKS, blocks
from ..line_loads import line_work, tensions_along
from ..streams import gust_at

MOTIONLESS = 1e-9  # m, rad: deviation of a motion below which it counts as zero
CHAOTIC = 0.1  # error over σ above which a path is chaotic
SLOWEST = 0.9  # largest ratio of errors from one tolerance to the next that counts as convergence


class Realisation(NamedTuple):
    """One run.

    time : (n,) s; motion : (n, 6N + f), m and rad, of the rotation centre of each of N bodies from its position at
        rest, along its axes at rest, with unlimited yaw; then amplitudes of f shapes
    velocity : (n, 6N + f), m/s and rad/s, in axes that turn with the heading; slow : low-passed x, y and yaw, (n, 3N)
    wave : elevation at the origin, (n,) m; wind_speed : (n,) m/s; tension : (n, lines) N, at the body; seed : seed
        of the run
    estimated_error : errors of the motions, from the finest run, (6N + f,), m and rad, nan if not requested; steps :
        number of steps
    deflection, reaction : (n, fenders), m and N; pull : (n, ropes) N
    work : {name: J} done on the bodies from the start of the ramp to the end; findings : one line each
    buoy : displacement from its place in the system, and velocity of the buoy, (n, 6), m and m/s, None without a buoy
    poses : displacements in space and headings of the bodies, (n, N, 6), m and rad
    hawser : (n, k) N, and buoy_lines : (n, l) N, largest tensions since the previous sample
    links : (n, k, SHOWN), forces, N and N m, of the first body of each hinge on the second, in axes of the first,
        including spring and damper; and travel, m or rad
    """

    time: np.ndarray
    motion: np.ndarray
    velocity: np.ndarray
    slow: np.ndarray
    wave: np.ndarray
    wind_speed: np.ndarray
    tension: np.ndarray
    seed: int
    estimated_error: np.ndarray
    steps: int
    work: dict
    findings: tuple[str, ...]
    deflection: np.ndarray
    reaction: np.ndarray
    pull: np.ndarray
    poses: np.ndarray
    buoy: np.ndarray | None = None
    hawser: np.ndarray | None = None
    buoy_lines: np.ndarray | None = None
    links: np.ndarray | None = None


class Course(NamedTuple):
    """Course of all bodies up to the end of a run.

    samples : samples of the states, (n, N, 18); buoy : (n, 6) or (n, 0); clock : `integrator.Clock` at the end
    bent, bending : amplitudes of shapes, and their rates, (n, f)
    pulls : {number: (n,) N} of dynamic lines; hung : tensions of hawsers and lines of a buoy, (n, k + l) N
    held : forces of hinges, (n, 6k), N and N m
    """

    samples: np.ndarray
    buoy: np.ndarray
    clock: object
    pulls: dict
    hung: np.ndarray | None
    held: np.ndarray | None
    bent: np.ndarray
    bending: np.ndarray


def realisation_of(moored, settings, seed, begun, course):
    """`Realisation` of a seed from the start of its run (`run.Begun`) and the Course of its body"""
    samples, clock, lines = course.samples, course.clock, begun.scene.lines
    clocked = settings.step * np.arange(len(samples))
    tension = np.zeros((len(samples), len(lines.lost)))
    poses = np.ascontiguousarray(samples[:, :, :6])
    tensions_along(lines, line_work(lines), clocked, poses, tension, course.bent)
    for number, pull in course.pulls.items():
        tension[:, number] = pull
    findings = begun.findings
    if moored.system is not None:
        findings = (*findings, *beyond_tables(moored.system, tension.max(axis=0)))
    wind, count = begun.scene.wind, len(moored.berth.fenders)
    depth, force = courses(moored.berth, poses, course.bent)
    depth, at_rest = np.maximum(depth, 0.0), moored.reader.axes_at_rest
    works = blocks(clock.y, len(at_rest))[:, FIRST_WORK:].sum(axis=0)
    return Realisation(
        clocked - settings.ramp, motion_of(course, at_rest),
        np.hstack([samples[:, :, 6:12].reshape(len(samples), -1), course.bending]),
        along_axes(samples[:, :, 12:15], at_rest),
        _elevation(begun.waves.table, clocked, moored.reader), np.hypot(*wind.velocity) + gust_at(wind, clocked),
        tension, seed, np.full(len(moored.start), np.nan), int(clock.counts[integrator.STEPS]),
        dict(zip(WORKS, works.tolist(), strict=True)), findings,
        depth[:, :count], force[:, :count], force[:, count:], poses, *_of_buoy(moored.buoy, course),
        None if course.held is None else course.held.reshape(len(samples), -1, SHOWN),
    )  # fmt: skip


def motion_of(course, at_rest):
    """Motions of a Course from the positions at rest (N, 6); shape (n, 6N + f)"""
    return np.hstack([along_axes(course.samples[:, :, :6], at_rest), course.bent])


def along_axes(poses, at_rest):
    """Poses (n, N, k), whose x and y are in space and whose heading comes last, converted to axes at rest; shape (n,
    k N)
    """
    out = np.array(poses)
    for i, heading in enumerate(at_rest[:, 5]):
        if heading != 0.0:
            c, s = np.cos(heading), np.sin(heading)
            x, y = poses[:, i, 0], poses[:, i, 1]
            out[:, i, 0], out[:, i, 1] = c * x + s * y, c * y - s * x
            out[:, i, -1] -= heading
    return out.reshape(len(out), -1)


def poses_of(motion, at_rest):
    """Poses in space, m and rad, from motions (n,) along body axes at rest, from the positions at rest (N, 6); shape
    (N, 6)
    """
    poses = at_rest + np.reshape(motion, (-1, 6))
    for pose, heading, (x, y) in zip(poses, at_rest[:, 5], np.reshape(motion, (-1, 6))[:, :2], strict=True):
        if heading != 0.0:
            c, s = np.cos(heading), np.sin(heading)
            pose[:2] += c * x - s * y - x, s * x + c * y - y
    return poses


def _elevation(table, clocked, reader):
    """Elevation at the origin, of a `WaveTable` at times (n,), s, from its begin, m; shape (n,)"""
    if not len(table.omega):
        return np.zeros(len(clocked))
    from ...environment.wave_records import real_sum

    return real_sum(table.amplitude * np.exp(1j * table.phase), table.omega, clocked)


def _of_buoy(buoy, course):
    """The last three of a `Realisation`"""
    if buoy is None:
        return None, None, None
    count = len(buoy.lengths)
    return course.buoy, course.hung[:, :count], course.hung[:, count:]


class Doubt(NamedTuple):
    """Errors of the motions of a `Realisation`, from runs with smaller tolerances.

    error : root mean square difference from the run with the smallest tolerance, (n,), m and rad
    bound : upper bound of the true error, (n,), m and rad; spread : standard deviations of the motions, (n,)
    """

    error: np.ndarray
    bound: np.ndarray
    spread: np.ndarray

    def share(self, error):
        """Errors over the standard deviations of the motions, 0 for motions that are zero; shape (n,)"""
        return np.where(self.spread > MOTIONLESS, error / np.maximum(self.spread, MOTIONLESS), 0.0)

    @property
    def worst(self):
        """Largest error of a motion, over its standard deviation"""
        return self.share(self.bound).max()


def doubt_of(found, finer, finest=None):
    """`Doubt` of a Realisation from motions (n, 6N) of runs with smaller tolerances, which fall by a constant factor.

    finest : motions of a third run, None if two runs are enough. Lines that jerk or break leave errors that decrease
        slowly, so that the difference d₀₁ from the second run is only a part of the error. With a third run the
        differences are extrapolated as a geometric series,

        error ≤ max(d₀₁, d₀₂) + d₁₂ q/(1 − q),    q = min(d₁₂/d₀₁, SLOWEST).
    """
    late = found.time >= 0

    def difference(one, other):
        return np.sqrt(np.mean((one - other)[late] ** 2, axis=0))

    spread, first = found.motion[late].std(axis=0), difference(found.motion, finer)
    if finest is None:
        return Doubt(first, first, spread)
    whole, second = difference(found.motion, finest), difference(finer, finest)
    ratio = np.minimum(np.divide(second, first, out=np.zeros_like(first), where=first > 0), SLOWEST)
    return Doubt(whole, np.maximum(first, whole) + second * ratio / (1 - ratio), spread)


def with_error(found, doubt, tolerance, words, runs="a run to a tenth of the tolerance"):
    """A Realisation with the errors of a `Doubt`, and a finding if they may exceed the tolerance

    words : (n,) names of the motions; runs : number of runs of the estimate
    """
    share, findings = doubt.share(doubt.bound), found.findings
    worst = int(np.argmax(share))
    if share[worst] > tolerance:
        chaotic = "this motion is chaotic; use statistics over seeds, not a single time series"
        missed = f"the tolerance is {tolerance:g}; give a smaller one for a more accurate time series"
        chance = doubt.share(doubt.error)[worst] > CHAOTIC
        findings = (
            *findings,
            f"the error of {words[worst]} may be {share[worst]:.2g} of its standard deviation, as {runs} show: "
            f"{chaotic if chance else missed}",
        )
    return found._replace(estimated_error=doubt.error, findings=findings)
