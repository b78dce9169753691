"""A body in a climate: every response in every cell of a table of heights and periods, and long-term extremes.

In one family of spectra σ is proportional to the height. A column of the table therefore needs one integral, over the
same frequencies as in `sea_state`.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_headings import SAME

from ..environment.sea import Sea
from ..environment.spectra import STEEPEST
from ..seas.breaking import largest_height
from .findings import MISSED, missed_response, named_shares, waves_missed
from .linear import frequencies
from .long_term import LongTerm, long_term
from .points import transfer_functions
from .sea_state import TINY, linear_response, mean_drift
from .seas import directions, energy_outside, heading_step

UNIT = 0.01  # m, height of the sea of each column: so low that no sea is too steep


@dataclass(frozen=True, eq=False)
class Climate:
    """Responses (c,) in sea states (s,), each with height, m, period, s, direction, rad, and probability.

    m0, m2 : (s, c); drift : (s, 3) mean drift N, N, N m, or None without drift in the database
    missed : fraction of the waves that is missing at points, as in `points.Transfer.missed`
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    height: np.ndarray
    period: np.ndarray
    direction: np.ndarray
    probability: np.ndarray
    m0: np.ndarray
    m2: np.ndarray
    drift: np.ndarray | None
    warnings: tuple[str, ...]
    points: tuple = ()
    missed: float | None = None

    def __repr__(self):
        return f"<Climate {len(self.height)} sea states, {len(self.names)} responses>"

    def long_term(self, name) -> LongTerm:
        """LongTerm of one response; ValueError for an unknown name, or a response that is zero"""
        if name not in self.names:
            raise ValueError(f"there is no response named {name!r}; allowed: {', '.join(self.names)}")
        i = self.names.index(name)
        return long_term(self.m0[:, i], self.m2[:, i], self.probability)

    @property
    def excited(self):
        """Whether a response exceeds the rounding errors of all other responses; shape (c,); True if unknown"""
        largest = dict.fromkeys(self.units, 0.0)
        for unit, m0 in zip(self.units, self.m0.T, strict=True):
            largest[unit] = np.fmax.reduce(m0, initial=largest[unit])
        return ~(self.m0.max(axis=0) <= TINY**2 * np.array([largest[unit] for unit in self.units]))

    @property
    def mean_drift(self):
        """Mean force over all time, N, N, N m; shape (3,)"""
        return None if self.drift is None else self.probability @ self.drift


class _Column(NamedTuple):
    """Moments (c,), drift (3,) and their parts from waves beyond the stored ones, in a sea of height UNIT"""

    m0: np.ndarray
    m2: np.ndarray
    drift: np.ndarray
    missed: float
    beyond: np.ndarray
    drift_beyond: np.ndarray


def climate(body, scatter, family, directions_and_shares=((0.0, 1.0),), spreading=None, points=(), **shape) -> Climate:
    """A `bem.database.reader.Reader`, `floating`, in all cells of a Scatter.

    family : one of `environment.spectra.FAMILIES`, called with height and period of the kind of the table, and `shape`
    directions_and_shares : pairs (direction of travel, rad, share of time); the table applies to each
    spreading : None, or a function of the spectrum that returns its Spreading
    raises : ValueError for shares that do not sum to 1, BetweenError outside the stored headings
    """
    total = sum(share for _, share in directions_and_shares)
    if any(share < 0 for _, share in directions_and_shares) or abs(total - 1) > 1e-6:
        raise ValueError(f"shares of the directions sum to {total:.6g}; allowed: each at least 0, sum 1")
    spectra = {
        int(j): family(UNIT, **{scatter.period_kind: scatter.periods[j]}, **shape)
        for j in np.flatnonzero(scatter.probability.any(axis=0))
    }
    grids = {j: frequencies(body, spectrum.density) for j, spectrum in spectra.items()}
    known = _Known(body, np.unique(np.concatenate(list(grids.values()))), points)
    states, columns = [], []
    for j, spectrum in spectra.items():
        for beta, share in directions_and_shares:
            column = _column(known, Sea(spectrum, beta, spreading and spreading(spectrum)), grids[j])
            for i in np.flatnonzero(scatter.probability[:, j]):
                states.append((scatter.heights[i], scatter.periods[j], beta, scatter.probability[i, j] * share))
                columns.append(column)
    height, period, direction, probability = np.transpose(states)
    scale = (height[:, None] / UNIT) ** 2
    m0, m2, drift = (scale * np.array([getattr(c, name) for c in columns]) for name in ("m0", "m2", "drift"))
    missed = np.array([c.missed for c in columns])
    drift = drift if body.knows_drift else None
    found = (
        *_energy_beyond(body, probability, missed),
        *_responses_beyond(known.names, probability, m0, scale * np.array([c.beyond for c in columns])),
        *_drift_beyond(body, probability, drift, scale * np.array([c.drift_beyond for c in columns])),
        *_too_high(body, spectra.values(), scatter),
        *waves_missed(known.transfer),
    )
    of_states = height, period, direction, probability, m0, m2, drift
    return Climate(known.names, known.units, *of_states, found, tuple(points), known.transfer.missed)


class _Known:
    """Transfer functions (q, p, c) and drift (q, p, 3) at all frequencies omega (q,), computed once for each heading"""

    def __init__(self, body, omega, points):
        self.body, self.omega, self.points = body, omega, points
        self.places, self.transfer, self.forces = {}, None, None

    @property
    def knows_drift(self):
        return self.body.knows_drift

    @property
    def names(self):
        return self.transfer.names

    @property
    def units(self):
        return self.transfer.units

    def motions(self, omega, heading):
        """As `Reader.motions`; shape (q, p, n)"""
        rows, columns = self._place(omega, heading)
        return self.transfer.value[rows, columns, : len(self.body.words)]

    def drift(self, omega, heading):
        """As `Reader.drift`; shape (q, p, 3)"""
        return self.forces[self._place(omega, heading)]

    def at(self, omega, heading):
        """Transfer functions and drift at omega, some of the stored frequencies; zero where unknown"""
        place = self._place(omega, heading)
        transfer = self.transfer._replace(omega=omega, heading=heading, value=self.transfer.value[place])
        return transfer, self.forces[place]

    def _place(self, omega, heading):
        """Rows (q, 1) of frequencies among all, and columns (1, p) of headings, which are computed when new"""
        keys = [round(beta / SAME) for beta in np.mod(heading, 2 * np.pi)]
        new = {key: beta for key, beta in zip(keys, heading, strict=True) if key not in self.places}
        if new:
            self._extend(list(new.values()))
            self.places |= {key: len(self.places) + i for i, key in enumerate(new)}
        return np.searchsorted(self.omega, omega)[:, None], np.array([self.places[key] for key in keys])[None]

    def _extend(self, heading):
        transfer, drift = transfer_functions(self.body, self.omega, heading, self.points), 0.0
        if self.body.knows_drift:
            drift = self.body.drift(self.omega, heading)
        drift = np.broadcast_to(drift, (len(self.omega), len(heading), 3))
        if self.transfer is not None:
            value = np.concatenate([self.transfer.value, transfer.value], axis=1)
            missed = transfer.missed and max(transfer.missed, self.transfer.missed)
            transfer = transfer._replace(value=value, missed=missed)
            drift = np.concatenate([self.forces, drift], axis=1)
        self.transfer, self.forces = transfer, drift


def _column(known, sea, omega):
    """The result of `sea_state.sea_state` for the same sea"""
    heading, weights = directions(sea, omega, heading_step(known, sea, omega))
    transfer, drift = known.at(omega, heading)
    _, found = linear_response(sea, transfer, weights)
    inside, beyond = mean_drift(known.body, sea, omega, drift, weights)
    outside = sum(energy_outside(known.body.omega, sea.spectrum))
    left_out = missed_response(known.body, sea.spectrum, transfer, weights)
    return _Column(found.m0, found.m2, inside + beyond.sum(axis=0), outside, left_out, np.abs(beyond).sum(axis=0))


def _energy_beyond(body, probability, missed):
    poor = missed > MISSED
    if poor.any():
        low, high = (2 * np.pi / body.omega[i] for i in (-1, 0))
        time = probability[poor].sum() / probability.sum()
        yield (
            f"in {100 * time:.0f} % of the time more than {100 * MISSED:g} % of the wave energy is beyond the stored "
            f"{low:.3g} to {high:.3g} s (in the worst sea {100 * missed.max():.0f} %); add periods to the scene and "
            f"solve again"
        )


def _responses_beyond(names, probability, m0, beyond):
    """What those waves would add to the energy of responses over all time, transfer functions held at their ends"""
    whole, more = probability @ m0, probability @ beyond
    share = np.where(whole > 0, more / np.maximum(whole + more, 1e-300), 0.0)
    said = named_shares(names, share)
    if said:
        yield f"responses do not include energy beyond the stored frequencies: {said}; limit {100 * MISSED:g} %"


def _drift_beyond(body, probability, drift, beyond):
    if drift is not None and np.abs(drift).any():
        share = (probability @ beyond)[:2].max() / max((probability @ np.abs(drift))[:2].max(), 1e-300)
        if share > MISSED:
            yield (
                f"{100 * share:.1f} % of the mean drift force over all time is due to waves beyond the stored "
                f"frequencies, for which the drift at {body.omega[-1]:.3g} rad/s is used; add frequencies and solve "
                f"again"
            )


def _too_high(body, spectra, scatter):
    """Classes of waves too steep, or too high for the depth, with their share of the time"""
    unit = np.array([2 * np.pi / (body.gravity * spectrum.T02**2) for spectrum in spectra])
    highest = np.array([largest_height(spectrum.Tp, body.depth, body.gravity) for spectrum in spectra])
    probability = scatter.probability[:, scatter.probability.any(axis=0)]
    for wrong, words in (
        (
            np.outer(scatter.heights, unit) > STEEPEST,
            f"have 2πH/gT02² above {STEEPEST:g}, where seas break",
        ),
        (scatter.heights[:, None] > highest, f"are higher than is possible in water of {body.depth:g} m"),
    ):
        there = wrong & (probability > 0)
        if there.any():
            i = np.argwhere(there)[-1][0]
            yield (
                f"{there.sum()} classes of the scatter diagram, {100 * probability[there].sum():.3g} % of the time, "
                f"{words}, such as the class of {scatter.heights[i]:g} m; give these classes longer periods or leave "
                f"them out"
            )
