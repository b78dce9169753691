"""A database body in waves on a current: the body moves at the frequency at which it meets the waves.

    {−ω²[M + A(ω)] − iω[B(ω) + B′] + [C + C′]} X = F(σ),    ω = σ + k·V

The incident wave has the length and the pressure of its intrinsic frequency σ, and F is taken at σ. Water and body
respond at ω.  The effect of the current on F itself, of the order of V/C, is neglected.
"""

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from hakobune.bem.database.between_frequencies import RADIATION
from hakobune.bem.database.reader import Reader
from hakobune.bem.database.resonances import about, resonances

from .waves import Carrier

STEPS = 8  # spline steps of added mass and damping between stored frequencies


@dataclass(frozen=True, eq=False)
class OnCurrent(Reader):
    """A `Reader` whose `motions` are those on the current of a `Carrier`; all other quantities, including drift, are
    in still water.

    The argument omega of its functions is the frequency by which waves are given, absolute or intrinsic
    (`waves.Carrier`). Forces, drift and far field use the intrinsic frequency.
    """

    carrier: Carrier | None = None

    @cached_property
    def still(self):
        """`Reader` of the same body in still water"""
        return Reader(**{one.name: getattr(self, one.name) for one in fields(Reader)})

    def encounter(self, omega, headings=None):
        """Frequencies at which the body meets the waves, rad/s; shape (q, p)"""
        return self.carrier.met(*self._pairs(omega, headings), self.depth, self.gravity)

    def intrinsic(self, omega, headings=None):
        """Frequencies of the waves in the moving water, rad/s; shape (q, p)"""
        return self.carrier.own(*self._pairs(omega, headings), self.depth, self.gravity)

    def motions(self, omega, headings=None):
        """As `Reader.motions`; the motions in still water if the database lacks the coefficients; shape (q, p, n)"""
        if self.lacks_motions:
            return self.still.motions(omega, headings)
        self._check_inertia()
        met, F = self.encounter(omega, headings), self.waves_of("forces", omega, headings)
        A, B = self._coefficients(met.ravel())
        found = self.still.solved(met.ravel(), A, B, F.reshape(-1, 1, F.shape[-1]))
        return found.reshape(*met.shape, -1)

    @property
    def lacks_motions(self):
        """Whether the motions are stored without the coefficients that they are computed from"""
        return not {*RADIATION, "excitation_force"} <= set(self.between.quantities)

    def drift(self, omega, headings=None, fixed=False):
        """Drift in still water for waves of equal length, as `Reader.drift`; shape (q, p, 3)"""
        return self.waves_of("drift", omega, headings, fixed=fixed)

    def waves_of(self, name, omega, headings, **words):
        """Values `forces` or `drift` (q, p, …) in still water for waves of equal length"""
        of = getattr(self.still, name)
        if not self.carrier.absolute:
            return of(omega, headings, **words)
        headings = self.headings if headings is None else np.atleast_1d(headings)
        own = np.clip(self.intrinsic(omega, headings), *self.between.span)
        return np.concatenate([of(own[:, [p]].ravel(), [beta], **words) for p, beta in enumerate(headings)], axis=1)

    def at(self, omega, name, headings=None):
        """Like `Reader.at`; the error is the error in still water"""
        value, error = self.still.at(omega, name, headings)
        return (self.motions(omega, headings) if name == "rao" else value), error

    def resonant(self, headings):
        """The given frequencies, and further frequencies that resolve the body's resonances in waves towards
        headings (p,) rad; rad/s, (q,)
        """
        met = about(self.still, resonances(self.still))
        low, high = self.between.span
        rows = [met]
        if not self.carrier.absolute and len(met):
            back = Carrier(self.carrier.velocity, absolute=True)
            rows = [back.own(met, beta, self.depth, self.gravity) for beta in np.atleast_1d(headings)]
        found = np.unique(np.concatenate(rows))
        return found[(found > low) & (found < high)]

    def _pairs(self, omega, headings):
        headings = self.headings if headings is None else np.atleast_1d(headings)
        return np.asarray(omega, float)[:, None], headings[None]

    @cached_property
    def _splines(self):
        from scipy.interpolate import CubicSpline

        steps = np.arange((len(self.omega) - 1) * STEPS + 1) / STEPS
        omega = np.interp(steps, np.arange(len(self.omega)), self.omega)
        return tuple(CubicSpline(omega, of) for of in self.still.coefficients(omega))

    def _coefficients(self, met):
        """Added mass and damping (q, n, n) at rad/s (q,), constant or by their limits beyond the stored frequencies"""
        inside = np.clip(met, *self.between.span)
        A, B = (spline(inside) for spline in self._splines)
        beyond = inside != met
        if beyond.any():
            A[beyond] = self.held_added_mass(np.maximum(met[beyond], 0.0))
        return A, B


def on_current(body, carrier):
    """A `Reader` on the current of a `Carrier`; without current the given `Reader`"""
    if carrier is None:
        return body
    return OnCurrent(**{one.name: getattr(body, one.name) for one in fields(Reader)}, carrier=carrier)


def carrier_of_body(body):
    """`Carrier` of a body, None in still water"""
    return getattr(body, "carrier", None)
