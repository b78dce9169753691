"""A fender as a value: loading L(δ), unloading U(δ) ≤ L(δ), its rated values, and the range of its table.

    E(δ) = ∫₀^δ L dδ,    R ∝ H² and E ∝ H³ at equal strain δ/H (geometrically similar fenders of one grade)

SR179 report (1982), chapter 3.3; a catalogue curve f is used as R = (1 − γ) f(ξ), eq. 3.7.1.11 of this report.
"""

from dataclasses import dataclass, replace

import numpy as np

from .curves import Curve, smooth, straight

RETURN = 0.05  # return length over the height: over this length the reaction falls from loading to unloading


class FenderError(ValueError):
    """A fender cannot be made or evaluated; the message names the fault and the limit."""


@dataclass(frozen=True, eq=False)
class Fender:
    """loading, unloading : `curves.Curve` with common knots, N over m; height : reference length of strains, m

    return_length : deflection over which unloading passes from the loading to the unloading curve, m; see `hysteresis`
    rated, allowable : strains; limit : end of the table, m; overload : stiffness beyond it, N/m, None to refuse
        larger deflections
    """

    name: str
    height: float
    loading: Curve
    unloading: Curve
    return_length: float
    rated: float
    allowable: float
    limit: float
    overload: float | None = None

    def __repr__(self):
        return (
            f"<Fender {self.name}, {self.height:g} m: {self.rated_reaction / 1e3:.4g} kN and "
            f"{self.rated_energy / 1e3:.4g} kJ at {100 * self.own(self.rated * self.height) / self.height:.4g} %>"
        )

    @property
    def rated_reaction(self):
        """Largest reaction up to the rated deflection, N"""
        return float(self.loading(self._grid(self.rated * self.height)).max())

    @property
    def rated_energy(self):
        """J"""
        return float(self.loading.integral(self.rated * self.height))

    def reaction(self, deflection):
        """Reaction on loading, N, at deflections, m, of any shape. Raises FenderError beyond a table without
        overload.
        """
        self._check(deflection)
        return self.loading(deflection)

    def energy(self, deflection):
        """Energy absorbed on loading, J. Raises FenderError as `reaction` does."""
        self._check(deflection)
        return self.loading.integral(deflection)

    def returned(self, deflection):
        """Energy returned from a deflection to zero, J"""
        self._check(deflection)
        peak = float(deflection)
        below = max(peak - self.return_length, 0.0)
        knots = self.loading.knots
        points = np.unique([below, peak, *knots[(knots > below) & (knots < peak)]])
        x, w = np.polynomial.legendre.leggauss(4)
        half, middle = 0.5 * np.diff(points)[:, None], 0.5 * (points[1:] + points[:-1])[:, None]
        at = middle + half * x
        share = 1.0 - (peak - at) / self.return_length
        force = self.unloading(at) + share * (self.loading(at) - self.unloading(at))
        return float(np.sum(half * w * force) + self.unloading.integral(below))

    def deflection_at_energy(self, energy):
        """Deflection, m, at which an energy, J, is absorbed.  Raises FenderError if the table ends before this
        deflection.
        """
        last = np.inf if self.overload else self.limit
        most = self.loading.integral(self.limit)
        if energy > most and np.isfinite(last):
            raise FenderError(
                f"{self.name}: an energy of {energy / 1e3:.4g} kJ is requested, but its table ends at "
                f"{self.limit:.3g} m with {most / 1e3:.4g} kJ; choose a larger fender or give an overload stiffness"
            )
        low, high = 0.0, self.limit
        while self.loading.integral(high) < energy:
            high *= 2
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.loading.integral(middle) < energy else (low, middle)
            if high - low <= 1e-15 * high:
                break
        return 0.5 * (low + high)

    def largest_reaction(self, deflection):
        """Largest reaction, N, on the way to a deflection, m; a buckling fender passes a peak before"""
        self._check(deflection)
        return float(self.loading(self._grid(deflection)).max())

    def own(self, deflection):
        """Fender's part, m, of a deflection, m: with a rigid support the whole deflection"""
        return float(deflection)

    def whole(self, own):
        """Total deflection, m, for a deflection of the fender of `own` m"""
        return float(own)

    @property
    def own_allowable(self):
        """Allowable strain of the fender itself"""
        return self.allowable

    def times(self, factor, name=None):
        """The fender with all reactions times `factor`: a grade, a number of fenders side by side, or 1 − γ"""
        if not 0 < factor < np.inf:
            raise FenderError(f"{self.name}: the factor on its reaction is {factor:g}; allowed: above 0, finite")
        return replace(
            self,
            name=name or self.name,
            loading=self.loading.scaled(1.0, factor),
            unloading=self.unloading.scaled(1.0, factor),
            overload=None if self.overload is None else self.overload * factor,
        )

    def _grid(self, deflection):
        knots = self.loading.knots
        return np.unique(np.concatenate([np.linspace(0.0, deflection, 400), knots[knots < deflection]]))

    def _check(self, deflection):
        most = np.max(deflection)
        if not np.all(np.isfinite(deflection)):
            raise FenderError(f"{self.name}: its deflection is {most:g} m; allowed: finite")
        if self.overload is None and most > self.limit * (1 + 1e-12):
            raise FenderError(
                f"{self.name}: a deflection of {most:.3g} m ({100 * most / self.height:.1f} %) is beyond its table, "
                f"which ends at "
                f"{self.limit:.3g} m ({100 * self.limit / self.height:.1f} %); give an overload stiffness"
            )


def fender_of_points(name, height, deflection, loading, unloading=None, **marks):
    """`Fender` of a table.

    height : m; deflection : (n,) m, ascending from 0; loading, unloading : (n,) N, 0 at 0; unloading is None without
        hysteresis
    marks : rated, allowable (strains; by default the end of the table, and the rated strain), overload (N/m),
    return_length (m, by default RETURN of the height), corners (True: straight lines between points)
    raises : FenderError
    """
    x, up = np.asarray(deflection, float), np.asarray(loading, float)
    down = up if unloading is None else np.asarray(unloading, float)
    _check_points(name, height, x, up, down)
    limit, overload = x[-1], marks.get("overload")
    between = straight if marks.get("corners") else smooth
    rising, width = between(x, up), between(x, up - down)
    if overload is not None:
        rising, width = (_continued(curve, slope) for curve, slope in ((rising, overload), (width, 0.0)))
    rated = marks.get("rated") or limit / height
    length = marks.get("return_length") or RETURN * height
    made = Fender(
        name, height, rising, rising.minus(width), length, rated, marks.get("allowable") or rated, limit, overload
    )
    _check_marks(made)
    return made


def _continued(curve, slope):
    """A curve with a straight extension beyond its end"""
    last = [[float(curve(curve.end)), slope, 0.0, 0.0]]
    return Curve(np.append(curve.knots, 2 * curve.end), np.concatenate([curve.coefficients, last]))


def _check_points(name, height, x, up, down):
    if not 0 < height < np.inf:
        raise FenderError(f"{name}: its height is {height:g} m; allowed: above 0, finite")
    if len(x) < 2 or x.shape != up.shape or x.shape != down.shape:
        sizes = f"{len(x)}, {len(up)} and {len(down)}"
        raise FenderError(
            f"{name}: {sizes} deflections, reactions and unloading values; allowed: the same number of each, at least 2"
        )
    if not (np.all(np.isfinite(x)) and np.all(np.isfinite(up)) and np.all(np.isfinite(down))):
        raise FenderError(f"{name}: its table has a value that is not a number; allowed: finite numbers")
    falling = np.flatnonzero(np.diff(x) <= 0)
    if x[0] != 0 or len(falling):
        what = f"begin at {x[0]:g}" if x[0] != 0 else f"go from {x[falling[0]]:g} to {x[falling[0] + 1]:g}"
        raise FenderError(f"{name}: deflections {what}; allowed: increasing from 0")
    if up[0] != 0 or down[0] != 0:
        raise FenderError(
            f"{name}: without deflection its reaction is {up[0]:g} N on the loading and {down[0]:g} N on the "
            "unloading curve; allowed: 0"
        )
    for what, values in (("reaction", up), ("unloading", down)):
        if values.min() < 0:
            raise FenderError(
                f"{name}: its {what} at {x[values.argmin()]:g} m is {values.min():g} N; allowed: 0 or more"
            )
    over = np.flatnonzero(down > up * (1 + 1e-12))
    if len(over):
        i = over[np.argmax((down - up)[over])]
        raise FenderError(
            f"{name}: at {x[i]:g} m it unloads with {down[i] / 1e3:.4g} kN, above the loading curve of "
            f"{up[i] / 1e3:.4g} kN, so the fender would create energy; allowed: unloading at or below loading"
        )


def _check_marks(made):
    grid = made._grid(made.limit)
    lowest = made.unloading(grid)
    if lowest.min() < -1e-9 * made.loading(grid).max():
        raise FenderError(
            f"{made.name}: between its points the interpolated unloading curve falls to {lowest.min() / 1e3:.3g} kN at "
            f"{grid[lowest.argmin()]:.3g} m; allowed: 0 or more; give more points there"
        )
    for key in ("rated", "allowable"):
        value = getattr(made, key)
        if not 0 < value * made.height <= made.limit * (1 + 1e-9):
            raise FenderError(
                f"{made.name}: its {key} strain is {value:g}; allowed: above 0, at most "
                f"{made.limit / made.height:.3g} where its table ends"
            )
    if not 0 < made.return_length < np.inf:
        raise FenderError(
            f"{made.name}: its return length, the deflection between loading and unloading curve, is "
            f"{made.return_length:g} m; allowed: above 0, finite"
        )
    if made.overload is not None and not 0 < made.overload < np.inf:
        raise FenderError(
            f"{made.name}: its overload stiffness, beyond its table, is {made.overload:g} N/m; allowed: above 0, finite"
        )
