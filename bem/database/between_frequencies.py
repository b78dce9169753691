"""Quantities of a database at stored headings and at any frequency between stored frequencies, with estimated errors.

Added mass and damping are fitted as one function, the impedance B − iω [A − A(ω_max)], which is one-sided in time
because echoes arrive after the motion.
The fit of forces and Kochin functions includes the distance ahead of the origin at which the wave meets the hull
(`interpolant`).
At a stored frequency the result is the stored number.  Outside the stored band added mass tends to its stored limits,

    A(ω) = A(0) + [A(ω₁) − A(0)] (ω/ω₁)² below,    A(ω) = A(∞) + [A(ω_n) − A(∞)] (ω_n/ω)² above,

with the leading terms at both ends. The estimated error is the difference from the same formula with the first power.
Entries with an infinite limit, such as heave in finite depth, keep their value at the end of the band, with an
infinite error. Quantities other than added mass are not extrapolated.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..modes import moving
from .interpolant import Joined, abscissa, ringing_of, windows
from .schema import QUANTITIES

RADIATION = ("added_mass", "radiation_damping")
FORCES = ("excitation_force", "Froude_Krylov_force", "diffraction_force")
KOCHIN = ("kochin_radiation", "kochin_diffraction")
DRIFT = ("drift_force_fixed", "drift_force")
SAME = 1e-9  # relative in omega
FEWEST_RINGING = 12  # least number of frequencies for the detection of resonances of the water
FEWEST = 4  # least number of frequencies for interpolation
LEAD = 9  # digits of a lead, in body lengths: leads that are equal by symmetry must be exactly equal
KEPT = 1 << 27  # bytes of values that are kept for repeated calls


class BetweenError(ValueError):
    """A quantity is unknown at a frequency or heading; the message names the quantity, its known range and a remedy."""


@dataclass(frozen=True, eq=False)
class Between:
    """Quantities {name: (n, …)} at rising omega (n,) rad/s, with the axes of `schema.QUANTITIES`.

    headings : stored headings, rad, (m,); theta : angles of the Kochin functions, rad, (t,)
    outline : points of the hull in plan, m, (p, 2)
    outlines : points of each of several moving bodies in plan, m; empty for one body
    shapes : index, among the moving bodies, of the body of each motion that is not rigid
    limits : stored limits of added mass, {"added_mass_zero", "added_mass_infinity": (6, 6)}
    wall : y of a wall along x, m, or None without a wall. Beside a wall, waves also meet the image of the hull in the
        wall
    """

    omega: np.ndarray
    quantities: dict
    depth: float
    gravity: float
    headings: np.ndarray
    theta: np.ndarray
    outline: np.ndarray
    limits: dict = field(default_factory=dict)
    wall: float | None = None
    outlines: tuple = ()
    shapes: tuple = ()

    def value(self, omega, name):
        """A quantity (q, …) at omega (q,) rad/s.  Raises BetweenError outside the known range."""
        omega = np.atleast_1d(np.asarray(omega, float))
        known, values = self._values.get(name, (np.zeros(0), None))
        place = np.searchsorted(known, omega)
        new = np.unique(omega[known[np.minimum(place, len(known) - 1)] != omega] if len(known) else omega)
        if len(new) or values is None:
            made = self._everywhere(new, name, self._fitted)
            if values is None or values.nbytes > KEPT:
                new = np.unique(omega)
                known, values = new, made if len(made) == len(new) else self._everywhere(new, name, self._fitted)
            else:
                order = np.argsort(np.concatenate([known, new]))
                known, values = np.concatenate([known, new])[order], np.concatenate([values, made])[order]
            self._values[name] = known, values
        return values[np.searchsorted(known, omega)]

    def forget(self):
        """Release the values kept for repeated calls, some hundred megabytes; the next call computes them again."""
        for name, one in vars(Between).items():
            if isinstance(one, cached_property):
                vars(self).pop(name, None)

    def error(self, omega, name):
        """Estimated error of `value`, about one standard deviation of the value or, if complex, of its modulus;
        shape (q, …).

        The error covers interpolation and is zero at stored frequencies; the solver's error is stored beside each
        quantity.
        """
        omega = np.atleast_1d(np.asarray(omega, float))
        return self._everywhere(omega, name, self._deviation)

    def largest_error(self, omega, names):
        """Largest estimated error of the quantities `names` at omega (q,), relative to the largest stored value of
        its kind;
        shape (q,)

        A diagonal coefficient is a kind, and a force over all headings is a kind. The error of a coupling ij is
        relative to √(ii · jj).
        """
        return np.max([self._relative(self.error(omega, name), name) for name in names], axis=0)

    @cached_property
    def met_by_waves(self):
        """Points of the hull in plan, and of its image in the wall, m; shape (p, 2)"""
        if self.wall is None:
            return self.outline
        return np.concatenate([self.outline, [0.0, 2 * self.wall] + self.outline * [1, -1]])

    @cached_property
    def length(self):
        """The longer of the hull's extents along x and y, m"""
        return float(np.ptp(self.outline, axis=0).max())

    @property
    def span(self):
        """Lowest and highest frequency between which every stored quantity is known, rad/s"""
        return float(self.omega[0]), float(self.omega[-1])

    def stored(self, omega):
        """Index of the stored frequency equal to each omega (q,), −1 for none; shape (q,)"""
        near = np.abs(self.omega[:, None] - omega).argmin(axis=0)
        return np.where(np.abs(self.omega[near] - omega) <= SAME * np.abs(omega), near, -1)

    def inside(self, omega):
        """omega (q,) as an array.  Raises BetweenError for the first value outside the stored frequencies, or if too
        few are stored."""
        omega, (low, high) = np.atleast_1d(np.asarray(omega, float)), self.span
        outside = ~((omega >= low * (1 - SAME)) & (omega <= high * (1 + SAME)))
        if outside.any():
            w = omega[outside][0]
            raise BetweenError(
                f"omega is {w:.6g} rad/s (period {2 * np.pi / w:.4g} s), outside the stored {low:.6g} to {high:.6g} "
                f"rad/s ({2 * np.pi / high:.4g} to {2 * np.pi / low:.4g} s); add this frequency to the scene and "
                f"solve again"
            )
        unknown = self.stored(omega) < 0
        if len(self.omega) < FEWEST and unknown.any():
            raise BetweenError(
                f"omega is {omega[unknown][0]:.6g} rad/s, which is not stored; interpolation needs at least "
                f"{FEWEST} stored frequencies, and {len(self.omega)} are stored; add frequencies to the scene and "
                "solve again"
            )
        return omega

    def _everywhere(self, omega, name, within):
        """`within` (omega, name) inside the band; beyond the band added mass follows from its limits"""
        self._check(name)
        if name != "added_mass":
            return within(self.inside(omega), name)
        low, high = self.span
        below = (omega < low * (1 - SAME)) & self.has_limit("added_mass_zero") & (omega >= 0)
        above = (omega > high * (1 + SAME)) & self.has_limit("added_mass_infinity")
        out, inside = np.empty((len(omega), *self.quantities[name].shape[1:])), ~(below | above)
        out[inside] = within(self.inside(omega[inside]), name)
        for where, limit, share in (
            (below, "added_mass_zero", lambda w: w / low),
            (above, "added_mass_infinity", lambda w: high / w),
        ):
            if where.any():
                end = self.quantities["added_mass"][0 if limit == "added_mass_zero" else -1]
                out[where] = _towards(self.limits[limit], end, share(omega[where]), within == self._deviation)
        return out

    def has_limit(self, limit):
        """Whether the added mass at the limit is stored and is finite for at least one motion"""
        return limit in self.limits and bool(np.any(np.isfinite(np.diag(self.limits[limit]))))

    def _check(self, name):
        if name not in QUANTITIES or "omega" not in QUANTITIES[name][0]:
            raise BetweenError(f"{name!r} is not a function of frequency")
        if name not in self.quantities:
            raise BetweenError(
                f"{name} is not stored and cannot be computed from {', '.join(self.quantities)}; "
                f"repeat the command that made the database, with --only {name}"
            )

    def _fitted(self, omega, name):
        """Fitted values at omega (q,) within the band; shape (q, …)"""
        known, values = self.stored(omega), self.quantities[name]
        if np.all(known >= 0):
            return values[known]
        if name in RADIATION and set(RADIATION) <= set(self.quantities):
            Z, w = self._both(omega), omega[:, None, None]
            out = Z.real if name == "radiation_damping" else self.quantities["added_mass"][-1] - Z.imag / w
        else:
            out = self._fit(name, omega)
        out[known >= 0] = values[known[known >= 0]]
        return out

    def _deviation(self, omega, name):
        unknown = self.stored(omega) < 0
        out = np.zeros((len(omega), *self.quantities[name].shape[1:]))
        if not unknown.any():
            return out
        omega = omega[unknown]
        both = name in RADIATION and set(RADIATION) <= set(self.quantities)
        fit = self._interpolant("impedance" if both else name)
        deviation = fit.deviation(self._abscissa(omega))[..., None] * self._growth(name, omega, 3)
        error = np.broadcast_to(deviation, (*deviation.shape[:2], fit.lead.shape[1])).reshape(out[unknown].shape)
        if both:
            error = error / np.sqrt(2)  # error of the real or the imaginary part alone
            error = error / omega[:, None, None] if name == "added_mass" else error
        if name == "drift_force":
            error = error + self._unseen(omega, name)
        out[unknown] = error
        return out

    def _unseen(self, omega, name):
        """Half the step of stored frequencies, at its middle: a resonance inside leaves no trace in drift"""
        values = self.quantities[name]
        i = np.clip(np.searchsorted(self.omega, omega) - 1, 0, len(self.omega) - 2)
        share = (omega - self.omega[i]) / (self.omega[i + 1] - self.omega[i])
        return 0.5 * np.abs(values[i + 1] - values[i]) * (4 * share * (1 - share))[:, None, None]

    def _relative(self, error, name):
        stored = np.abs(self.quantities[name])
        if name in RADIATION:
            scale = self._seen(np.sqrt(np.einsum("nii->ni", stored).max(axis=0)))
            scale = np.outer(scale, scale)
        else:
            scale = stored.max(axis=tuple(range(stored.ndim - 1)))
            scale = self._seen(scale) if QUANTITIES[name][0][-1] in ("influenced_dof", "radiating_dof") else scale
        return np.max(error / np.where(scale > 0, scale, np.inf), axis=tuple(range(1, error.ndim)))

    def _seen(self, scale):
        """Scale of each motion; shape (n,); infinite for motions that move no water, as yaw of a buoy, whose
        coefficients are rounding errors"""
        rigid = len(scale) - len(self.shapes)
        kinds = scale[:rigid].reshape(-1, 2, 3)
        largest = np.broadcast_to(kinds.max(axis=(0, 2))[:, None], kinds.shape).ravel()
        return np.append(np.where(scale[:rigid] > 1e-4 * largest, scale[:rigid], np.inf), scale[rigid:])

    def _abscissa(self, omega):
        return abscissa(omega, self.depth, self.gravity, self.length)

    @cached_property
    def over_headings(self):
        """Weighted sums over headings that `between_headings.at_headings` keeps"""
        return {}

    @cached_property
    def _values(self):
        return {}

    @cached_property
    def _fits(self):
        return {}

    @cached_property
    def _windows(self):
        """`interpolant.windows` for complex functions and for real ones"""
        return {real: windows(self._abscissa(self.omega), real, self.ringing) for real in (False, True)}

    @cached_property
    def ringing(self):
        """Poles of the water resonances that body motions excite, in the variable s of `interpolant`; shape (p,)"""
        if len(self.omega) < FEWEST_RINGING or not set(RADIATION) <= set(self.quantities):
            return np.zeros(0, complex)
        own = np.einsum("nii->ni", self._impedance)
        largest = np.abs(own).max(axis=0)
        return ringing_of(self._abscissa(self.omega), own[:, np.isfinite(self._seen(np.sqrt(largest)))])

    def _interpolant(self, name):
        if name not in self._fits:
            values = self._impedance if name == "impedance" else self.quantities[name]
            lead = np.atleast_2d(np.round(self._lead(name) / self.length, LEAD))
            if name not in KOCHIN:
                lead = lead if lead.size == 1 else np.broadcast_to(lead, values.shape[1:]).reshape(-1, 1)
                values = values.reshape(len(values), -1, 1)
            values = (values - self._level(name, values)) / self._growth(name, self.omega, 3)
            self._fits[name] = Joined(
                self._abscissa(self.omega), self._windows[not np.iscomplexobj(values)], values, lead
            )
        return self._fits[name]

    def _fit(self, name, omega):
        shape = (self._impedance if name == "impedance" else self.quantities[name]).shape[1:]
        value = self._interpolant(name).value(self._abscissa(omega)) * self._growth(name, omega, 3)
        value = value.reshape(len(omega), *shape)
        return value + self._level(name, self.quantities[name]) if name == "added_mass" else value

    def _level(self, name, values):
        """Limit that is subtracted from added mass before a fit: far from all frequencies a fit tends to zero"""
        return values[-1] if name == "added_mass" else 0.0

    def _both(self, omega):
        """Impedance (q, n, n); the last result is kept, since calls for damping follow calls for added mass"""
        if self._values.get("impedance", (np.zeros(0),))[0].tobytes() != omega.tobytes():
            self._values["impedance"] = omega, self._fit("impedance", omega)
        return self._values["impedance"][1]

    def _growth(self, name, omega, dimensions):
        """Factor removed before a fit; shape (q, 1, …); Kochin functions grow like k, and a fit assumes one variance"""
        k = self._abscissa(omega).phase if name in KOCHIN else np.ones(len(omega))
        return k.reshape(-1, *[1] * (dimensions - 1))

    @cached_property
    def _impedance(self):
        """B − iω [A − A(ω_max)] (n, …), kg/s …"""
        A, B = (self.quantities[name] for name in RADIATION)
        return B - 1j * self.omega[:, None, None] * (A - A[-1])

    def _lead(self, name):
        """m, distance ahead of the origin, along the wave, at which the hull meets it; per heading, angle or both, and
        of several bodies for the motions of each: waves scattered by other bodies arrive later"""
        towards = np.stack([np.cos(self.headings), np.sin(self.headings)], axis=1)
        away = np.stack([np.cos(self.theta), np.sin(self.theta)], axis=1)
        if name in FORCES and self.outlines:
            return np.array([np.max(-one @ towards.T, axis=0) for one in self.outlines])[self._owners].T
        if name in FORCES or name == "pressure":
            return np.max(-self.outline @ towards.T, axis=0)[:, None]
        if name == "kochin_radiation" and self.outlines:
            return np.array([np.max(one @ away.T, axis=0) for one in self.outlines])[self._owners]
        if name == "kochin_radiation":
            return np.max(self.outline @ away.T, axis=0)
        if name == "kochin_diffraction":
            return np.max(self.outline @ (away.T[:, None] - towards.T[:, :, None]).reshape(2, -1), axis=0).reshape(
                len(towards), -1
            )
        return np.zeros(1)

    @property
    def _owners(self):
        """Number of the body of each motion, among the moving bodies; shape (n,)"""
        return [*np.repeat(range(len(self.outlines)), 6), *self.shapes]


def _towards(limit, end, share, error):
    """Continuation from the `end` of the band towards the limit, or the error of it; shape (q, n, n); share (q,) runs
    from 0 at the end to 1 at the limit"""
    share, known = share[:, None, None], np.isfinite(limit)
    limit = np.where(known, limit, end)
    if error:
        return np.where(known, np.abs(end - limit) * share * (1 - share), np.inf)
    return limit + (end - limit) * share**2


def between(db):
    """`Between` of the solved rows of a database."""
    names = [name for name in db.names if "omega" in QUANTITIES[name][0]]
    limits = {name: _of_moving(db, name) for name in ("added_mass_zero", "added_mass_infinity") if db.holds(name)}
    points = db.mesh.whole().points[:, :2]
    quantities = {name: _of_moving(db, name) for name in names}
    outlines = tuple(
        db.mesh.of_body(i).whole().points[:, :2] for i, body in enumerate(db.bodies) if not body.fixed
    )  # fmt: skip
    free = [i for i, body in enumerate(db.bodies) if not body.fixed] or [0]
    shapes = tuple(free.index(mode.body) for mode in db.modes)
    return Between(
        db.omega, quantities, db.water_depth, db.gravity, db.wave_direction, db["theta"], points, limits, db.wall,
        outlines, shapes,
    )  # fmt: skip


def _of_moving(db, name):
    """A quantity; with several bodies, forces on the moving ones: the equations are solved only for these"""
    axes = QUANTITIES[name][0]
    if "influenced_dof" not in axes or not db.bodies:
        return db[name]
    return np.take(db[name], moving(db.bodies, db.modes), axis=axes.index("influenced_dof"))
