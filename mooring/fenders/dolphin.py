"""A dolphin in series with its fender: y = y₁ + y₂, the same force in both.

    R_dolphin(y₁) = R_fender(y₂),    y(y₂) = y₂ + y₁(R_fender(y₂))

The pair is again a fender, in y.  If the fender's reaction falls faster than the dolphin is stiff (dy/dy₂ ≤ 0), the
pair snaps through and has no static characteristic. Such a pair is refused, and the message names the required
stiffness. The pair keeps the fender's unloading, because the dolphin returns all of its energy.
"""

from dataclasses import dataclass, fields

import numpy as np

from .curves import straight
from .fender import Fender, FenderError


@dataclass(frozen=True, eq=False, repr=False)
class OnDolphin(Fender):
    """A fender and its dolphin as one fender. Deflections are deflections of the pair; strains are these deflections
    over the height of the fender.

    strains : (2, n), strains of the pair and of the fender alone, on loading; own_allowable : allowable strain of
        the fender alone
    """

    strains: np.ndarray | None = None
    own_allowable: float = 0.0

    def own(self, deflection):
        """Fender's part, m, of a deflection of the pair, m; piecewise linear, extended beyond the last point"""
        return self.height * led_on(deflection / self.height, *self.strains)

    def whole(self, own):
        """Deflection of the pair, m, for a deflection of the fender of `own` m"""
        return self.height * led_on(own / self.height, *self.strains[::-1])


def led_on(x, knots, values):
    """Straight lines through values at rising knots; the last line is extended"""
    slope = (values[-1] - values[-2]) / (knots[-1] - knots[-2])
    return float(np.interp(x, knots, values) + slope * max(x - knots[-1], 0.0))


def bilinear(stiffness, yield_force=np.inf, stiffness_beyond=None):
    """Deflection y₁(R), m, of a dolphin (or soft ground) as a function.

    stiffness : N/m, up to yield_force, N; stiffness_beyond : N/m, beyond yield_force.  Raises FenderError.
    """
    beyond = stiffness if stiffness_beyond is None else stiffness_beyond
    for key, value in (("stiffness", stiffness), ("stiffness beyond", beyond), ("yield force", yield_force)):
        if not value > 0:
            raise FenderError(f"the dolphin's {key} is {value:g}; allowed: above 0")

    def deflection(force):
        force = np.asarray(force, float)
        return np.minimum(force, yield_force) / stiffness + np.maximum(force - yield_force, 0.0) / beyond

    return deflection


def in_series(fender, deflection_of, points=400):
    """`OnDolphin` of a fender and a dolphin; deflection_of : deflection of the dolphin at a force (`bilinear`).

    The characteristic is linear between `points` and the points of the fender. Raises FenderError if the pair snaps
    through.
    """
    y2 = _grid(fender, points)
    up, down = fender.loading(y2), fender.unloading(y2)
    y, back = (y2 + deflection_of(force) for force in (up, down))
    for path, force in ((y, up), (back, down)):
        falling = np.flatnonzero(np.diff(path) <= 0)
        if len(falling):
            i = falling[0]
            steepest = -np.min(np.diff(force) / np.diff(y2))
            raise FenderError(
                f"{fender.name} on its dolphin becomes unstable at {y2[i]:.3g} m: the fender's reaction falls by up "
                f"to {steepest / 1e3:.4g} kN/m, and the dolphin must be stiffer than that"
            )
    below = np.minimum(np.interp(y, back, down), up)
    stretch = float(fender.limit + deflection_of(fender.loading(fender.limit))) / fender.limit
    rated = fender.rated * fender.height
    rated = (rated + float(deflection_of(fender.loading(rated)))) / fender.height
    made = Fender(
        f"{fender.name} on a dolphin",
        fender.height,
        straight(y, up),
        straight(y, below),
        fender.return_length * stretch,
        rated,
        max(rated, fender.allowable),
        stretch * fender.limit,
        None if fender.overload is None else float(straight(y, up).slope(y[-2])),
    )
    own = np.stack([y, y2]) / fender.height, fender.allowable
    return OnDolphin(*(getattr(made, one.name) for one in fields(made)), *own)


def _grid(fender, points):
    return np.unique(np.concatenate([fender.loading.knots, np.linspace(0.0, fender.loading.end, points)]))
