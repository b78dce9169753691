"""Errors of many frequencies from the differences between two resolutions at a few of these frequencies.

The two resolutions of the contour method increase in steps over the frequency; between steps the difference of their
results is smooth.  Frequencies with the same resolutions form a range.  A range is halved until two conditions hold:
at the middle frequency of the range the difference is close to the straight line between the ends of the range, and
between the ends the phase of a wave along the body changes by less than half an oscillation.
At the other frequencies of the range the difference is taken from the parabola through the values at the ends and the
middle. The bound of this difference is `MARGIN` times the largest of the three values.

The choice of the few frequencies depends only on the list of frequencies, not on the order of solution.
"""

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..checks import damping_scale, excitation_scale, radiation_scale
from ..frequency import DRIFT
from ..waves import wavenumber
from .shape_run import ShapeRun

FEWEST = 4  # least number of frequencies of a range in which some are not solved by both resolutions
APART = 3.0  # k × the length of the body, rad, between the ends of a range
NEAR = 0.5  # largest deviation of the middle value from a straight line, over the largest difference
SMALL = 0.1  # fraction of the tolerance below which differences are not tested
MARGIN = 1.3  # factor on the largest of three estimates
SAME = 1e-9  # relative in omega


class Differences(NamedTuple):
    """Differences of two resolutions at one frequency, as `bem.frequency.FrequencyRun.differences`, and
    `kochin_errors`"""

    radiation: np.ndarray
    excitation: np.ndarray
    kochin: list


class FewEstimates:
    """Runs of a `PreparedShapeProblem` of the contour method for `omegas` (n,) rad/s, ascending."""

    def __init__(self, prepared, omegas):
        self.prepared, self.omegas = prepared, np.asarray(omegas, float)
        self.k = np.array([float(wavenumber(w, prepared.problem.depth, prepared.problem.gravity)) for w in omegas])
        self.ahead, self.differences = {}, {}

    def run(self, omega, *question):
        """The run of one frequency; question : arguments of `bem.frequency.FrequencyRun` after the frequency"""
        i = int(np.argmin(np.abs(self.omegas - omega)))
        own_angles = question[2] is None and bool(set(question[1]) & DRIFT)  # Kochin functions of others are at theirs
        if own_angles or abs(self.omegas[i] - omega) > SAME * omega:
            return ShapeRun(self.prepared, omega, *question)
        key = _key(question)
        near = self._around(i, key, question)
        if near is None:
            run = self.ahead.pop((i, key), None)
            return ShapeRun(self.prepared, omega, *question) if run is None else run
        return BetweenRun(self.prepared, omega, *question, *self._between(i, near, key))

    @cached_property
    def ranges(self):
        """Indices of the first and last frequency in the range of each frequency; shape (n, 2)"""
        solver, gravity = self.prepared.solver, self.prepared.problem.gravity
        kinds = [(solver.resolution(w, gravity), solver.finer.resolution(w, gravity)) for w in self.omegas]
        steps = [i for i in range(1, len(kinds)) if kinds[i] != kinds[i - 1]]
        out = np.empty((len(kinds), 2), int)
        for first, end in zip([0, *steps], [*steps, len(kinds)], strict=True):
            out[first:end] = first, end - 1
        return out

    def _around(self, i, key, question):
        """Indices (first, middle, last) of the range around a frequency; None if it has its own difference"""
        first, last = self.ranges[i]
        while first < i < last and last - first + 1 >= FEWEST:
            middle = (first + last) // 2
            if i == middle:
                return None
            if self._straight(first, middle, last, key, question):
                return first, middle, last
            first, last = (first, middle) if i < middle else (middle, last)
        return None

    def _straight(self, first, middle, last, key, question):
        if (self.k[last] - self.k[first]) * 2 * self.prepared.radius > APART:
            return False
        a, b, c = (self._known(i, key, question)[0] for i in (first, middle, last))
        scales, t = self._known(middle, key, question)[1], self._share(middle, first, last)
        return all(
            np.all(np.abs((1 - t) * one + t * two - there) <= NEAR * np.maximum(_largest(one, there, two), small))
            for one, there, two, small in zip(_parts(a), _parts(b), _parts(c), scales, strict=True)
        )

    def _share(self, i, first, last):
        return (self.omegas[i] - self.omegas[first]) / (self.omegas[last] - self.omegas[first])

    def _known(self, i, key, question):
        """`Differences` of a frequency, and values that are small relative to its coefficients and forces"""
        if (i, key) not in self.differences:
            run = ShapeRun(self.prepared, self.omegas[i], *question)
            drifts = run.want & DRIFT and run.solves
            found = Differences(*run.differences, run.kochin_differences if drifts else [])
            self.ahead[i, key] = run
            self.differences[i, key] = found, _small(run)
        return self.differences[i, key]

    def _between(self, i, near, key):
        """`Differences` from the parabola through three frequencies, and bounds of radiation and excitation"""
        known = [self.differences[j, key][0] for j in near]
        weights = _lagrange(self.omegas[i], self.omegas[list(near)])
        mixed = Differences(*(sum(w * d[j] for w, d in zip(weights, known, strict=True)) for j in range(2)), [])
        kochin = [
            sum(w * part for w, part in zip(weights, parts, strict=True))
            for parts in zip(*(d.kochin for d in known), strict=True)
        ]
        A, B, F = (MARGIN * _largest(*parts) for parts in zip(*map(_parts, known), strict=True))
        return mixed._replace(kochin=kochin), (A + 1j * B, F + 0j)


class BetweenRun(ShapeRun):
    """A frequency whose differences are interpolated from other frequencies.

    near : `Differences`; bounds : bounds of radiation (6, 6), separately for real and imaginary part, and of
        excitation (m, 6)
    """

    interpolated, bounds, margin = True, None, MARGIN

    def __init__(self, prepared, omega, headings, want, theta, dofs, near, bounds):
        super().__init__(prepared, omega, headings, want, theta, dofs)
        self.differences, self.kochin_differences, self.bounds = near[:2], near.kochin, bounds


def _parts(differences):
    """Real arrays of `Differences` for the error test; the modulus of excitation"""
    Z, F = differences[:2]
    return Z.real, Z.imag, F


def _largest(*values):
    return np.max(np.abs(values), axis=0)


def _small(run):
    """`SMALL` times the tolerance for each of `_parts`"""
    share, count = SMALL * run.problem.tolerance, len(run.prepared.displacing)
    A, F = np.zeros((count, count)), np.zeros(count)
    B = A.copy()
    if run.radiates:
        block = np.ix_(run.dofs, run.dofs)
        own = damping_scale(run.radiation[block], run.prepared.displacing[run.dofs])
        A[block], B[block] = (share * np.where(np.isfinite(s), s, 0.0) for s in (radiation_scale(run), own))
    if run.diffracts:
        size = excitation_scale(run)
        F[run.dofs] = share * np.where(np.isfinite(size), size, 0.0)
    return A, B, F


def _lagrange(x, nodes):
    """Weights of values at three nodes in the parabola through them at x"""
    return [np.prod([(x - m) / (n - m) for m in nodes if m != n]) for n in nodes]


def _key(question):
    """Equal for equal questions"""
    headings, want, theta, dofs = question
    parts = (np.asarray(part, float).tobytes() if part is not None else None for part in (headings, theta))
    return (*parts, frozenset(want), tuple(dofs or ()))
