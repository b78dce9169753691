"""Runs of one mesh at many frequencies, from those of another of the same body and what differs at some of them.

What two meshes differ by in coefficients, forces and Kochin functions is small and smooth in the frequency.  At the
nodes of a range of frequencies both meshes are solved; at the others the values are those of the other mesh plus the
polynomial in the wavenumber through the differences at the nodes.  These are added one by one, each where the product
of the distances from those before is largest (Leja 1957), until the polynomial through those before has told the
difference at a new one to a share of the tolerance; by what it missed the estimated errors are enlarged.

A range ends where the equations change, as with the first frequency that needs a lid.  Its nodes depend on the list of
frequencies alone, not on which of them is solved first.
"""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..checks import damping_error, largest_error
from ..frequency import TRUSTED
from ..panels.one_frequency import PanelRun
from ..waves import wavenumber
from .questions import question_key

FEWEST = 10  # frequencies, of which each is solved by both meshes if there are no more
SHARE, SHARE_OF_ESTIMATES = 0.1, 0.02  # of the tolerance, where the mesh gives the values and where it gives errors
PROBES = 5  # frequencies that tell which ones ask for the finer mesh
SAME = 1e-9  # relative in omega


class Values(NamedTuple):
    """What is interpolated of a run: as there, or differences of it; None and () where a run has none"""

    radiation: np.ndarray
    diffraction: np.ndarray
    excitation: np.ndarray
    haskind: np.ndarray | None
    kochin: tuple

    @classmethod
    def of(cls, run):
        """Of a `bem.panels.one_frequency.PanelRun`"""
        kochin = tuple(run.kochin) if run.far_field else ()
        return cls(run.radiation, run.diffraction, run.excitation, run.haskind, kochin)

    def plus(self, other, factor=1.0):
        """self + factor × other"""

        def added(a, b):
            return None if a is None or b is None else a + factor * b

        kochin = tuple(added(a, b) for a, b in zip(self.kochin, other.kochin, strict=True))
        return Values(*(added(a, b) for a, b in zip(self[:4], other[:4], strict=True)), kochin)


class Nodes(NamedTuple):
    """Numbers of the frequencies solved by both meshes, their differences, and what was missed at the last of them"""

    numbers: list
    differences: list
    missed: Values


class BetweenMeshes:
    """Runs of the mesh of `prepared` at `omegas` (n,) rad/s, ascending, beside those of `other`.

    Both are `bem.methods.panel_problem.PreparedPanelProblem`.  asking : whether only runs of `other` beyond the
    tolerance ask for this mesh; else all do
    """

    def __init__(self, prepared, other, omegas, asking):
        self.prepared, self.other, self.asking = prepared, other, asking
        self.omegas, problem = np.asarray(omegas, float), prepared.problem
        self.k = np.array([float(wavenumber(w, problem.depth, problem.gravity)) for w in self.omegas])
        self.ahead, self.nodes, self.asked = {}, {}, {}

    def run(self, known):
        """The run of this mesh at the frequency of a run of the other"""
        i = int(np.argmin(np.abs(self.omegas - known.omega))) if len(self.omegas) else 0
        alone = len(self.omegas) < FEWEST or abs(self.omegas[i] - known.omega) > SAME * known.omega
        if alone or (known.far_field and known.own_angles):  # Kochin functions of others are at theirs
            return self._solved(known)
        key = question_key(known.question[1:])
        first, last = self._range(i, key, known)
        if not first <= i <= last or last - first < FEWEST // 2:
            return self._solved(known)
        numbers, differences, missed = self._nodes(first, last, key, known)
        if i in numbers:
            return self.ahead[i, key]
        weights = _lagrange(self.k[i], self.k[numbers])
        change = differences[0].plus(differences[0], weights[0] - 1)
        for weight, difference in zip(weights[1:], differences[1:], strict=True):
            change = change.plus(difference, weight)
        return BetweenRun(self.prepared, known, self._refined(known), Values.of(known).plus(change), missed)

    def _refined(self, known):
        return known if self.asking else None

    def _solved(self, known):
        run = self.prepared.alone(*known.question, **({"refined": known} if self.asking else {}))
        run.own_angles = known.own_angles
        return run

    @cached_property
    def ranges(self):
        """(n, 2) numbers of the first and the last frequency of the range of each"""
        gravity = self.prepared.problem.gravity
        kinds = [(one.kind(w), w**2 / gravity > one.geometry.lid_from) for w in self.omegas for one in self._both]
        kinds = list(zip(kinds[::2], kinds[1::2], strict=True))
        steps = [i for i in range(1, len(kinds)) if kinds[i] != kinds[i - 1]]
        out = np.empty((len(kinds), 2), int)
        for first, end in zip([0, *steps], [*steps, len(kinds)], strict=True):
            out[first:end] = first, end - 1
        return out

    @property
    def _both(self):
        return self.prepared, self.other

    def _range(self, i, key, known):
        """Numbers of the first and the last frequency of the range around one, of those that ask for this mesh"""
        first, last = self.ranges[i]
        if not self.asking:
            return first, last
        low, high = self._asking(key, known)
        return max(first, low), min(last, high)

    def _asking(self, key, known):
        """Numbers of the first and the last of the frequencies beyond the tolerance, found from `PROBES`"""
        if key not in self.asked:
            last = len(self.omegas) - 1
            probes = [int(i) for i in np.unique(np.linspace(0, last, PROBES).astype(int))]
            asks = [self._asks(i, known) for i in probes]
            if not any(asks):
                self.asked[key] = 0, -1
            else:
                a, b = asks.index(True), len(asks) - 1 - asks[::-1].index(True)
                low = 0 if a == 0 else self._border(probes[a], probes[a - 1], known)
                high = last if b == len(asks) - 1 else self._border(probes[b], probes[b + 1], known)
                self.asked[key] = low, high
        return self.asked[key]

    def _border(self, asks, rests, known):
        """The last number from `asks` on towards `rests` whose frequency is beyond the tolerance, by halving"""
        while abs(asks - rests) > 1:
            middle = (asks + rests) // 2
            asks, rests = (middle, rests) if self._asks(middle, known) else (asks, middle)
        return asks

    def _asks(self, i, known):
        return self._known(i, known).tolerances > 1

    def _known(self, i, known):
        """The run of the other mesh at frequency number i, for the question of `known`"""
        if abs(known.omega - self.omegas[i]) <= SAME * known.omega:
            return known
        return self.other.run_ahead(self.omegas[i], *known.question[1:])

    def _nodes(self, first, last, key, known):
        """`Nodes` of a range"""
        if (first, last, key) in self.nodes:
            return self.nodes[first, last, key]
        numbers, differences, missed = [], [], None
        for i in _leja(self.k[first : last + 1]) + first:
            there = self._known(int(i), known)
            run = self._solved(there)
            self.ahead[int(i), key] = run
            difference = Values.of(run).plus(Values.of(there), -1.0)
            if len(numbers) > 1:
                weights = _lagrange(self.k[i], self.k[numbers])
                missed = difference
                for weight, known_difference in zip(weights, differences, strict=True):
                    missed = missed.plus(known_difference, -weight)
            numbers.append(int(i))
            differences.append(difference)
            if missed is not None and _small(missed, run, SHARE if self.asking else SHARE_OF_ESTIMATES):
                break
        found = self.nodes[first, last, key] = Nodes(numbers, differences, missed)
        return found


class BetweenRun(PanelRun):
    """A frequency of one mesh by the run `known` of another and the differences at other frequencies.

    values : `Values`; missed : those that the differences are told to
    """

    def __init__(self, prepared, known, refined, values, missed):
        super().__init__(prepared, *known.question, refined)
        self.known, self.missed, self.own_angles = known, missed, known.own_angles
        self.radiation, self.diffraction, self.haskind = values.radiation, values.diffraction, values.haskind
        self.excitation, self.kochin = values.excitation, values.kochin

    @property
    def froude_krylov(self):
        return self.excitation - self.diffraction

    @property
    def residual(self):
        """Of the other mesh: nothing is solved for on this one"""
        return self.known.residual


def _small(missed, run, share):
    """Whether `Values` are within a share of the tolerance beside those of a run"""
    off = [
        largest_error(run, missed.radiation, missed.excitation),
        damping_error(run, missed.radiation) / TRUSTED,
        *(np.abs(a).max() / np.abs(b).max() for pair in zip(missed.kochin, run.kochin if missed.kochin else (),
          strict=True) for a, b in zip(*pair, strict=True) if b.size and np.any(b)),
    ]  # fmt: skip
    return max(off) <= share * run.problem.tolerance


def _leja(k):
    """Numbers (n,) of all nodes k (n,), the ends first, each the one of the largest product of distances"""
    chosen, left = [0, len(k) - 1], list(range(1, len(k) - 1))
    scale = (k[-1] - k[0]) / 4  # of an interval of this capacity products neither grow nor vanish
    while left:
        product = np.prod(np.abs(k[left, None] - k[chosen]) / scale, axis=1)
        chosen.append(left.pop(int(np.argmax(product))))
    return np.array(chosen)


def _lagrange(x, nodes):
    """(n,) weights of values at nodes (n,) in the polynomial through them at x"""
    return [np.prod([(x - m) / (n - m) for m in nodes if m != n]) for n in nodes]
