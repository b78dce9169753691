"""What a database holds, at frequencies between the stored ones, with the estimated error: `interpolant` on its rows.

Added mass and damping are fitted as one function, the impedance B − iω [A − A(ω_max)], which later echoes make
one-sided; forces and Kochin functions with the distance ahead of the origin at which the hull meets the wave.
Responses are not fitted: they follow from fitted coefficients by the equation of motion, and drift from these and
fitted Kochin functions by the far field (`drift`).  That of the fixed body is fitted where no Kochin functions are: of
22 frequencies it is then 1 % off in the mean, and its errors are told too small in places, where the far field is
0.4 % off and tells 0.5.  Drift needs more frequencies than forces, being of second order in them; its error says so.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..drift import about, mean_drift
from ..motions import response
from ..waves import group_factor, wavenumber
from .interpolant import Interpolant, abscissa
from .schema import QUANTITIES

RADIATION = ("added_mass", "radiation_damping")
FORCES = ("excitation_force", "Froude_Krylov_force", "diffraction_force")
KOCHIN = ("kochin_radiation", "kochin_diffraction")
STEP = 1e-3  # of the deviations, with which they are carried through an equation
DRAWS = 8  # by chance; a deviation is known to a quarter


class BetweenError(ValueError):
    """A quantity is not known between the stored frequencies; one line says which and why."""


@dataclass(frozen=True, eq=False)
class Between:
    """Quantities {name: (n, …)} at omega (n,) rad/s rising, axes as in `schema.QUANTITIES`.

    headings : (m,) rad; theta : (t,) rad of the Kochin functions; outline : (p, 2) m, points of the hull in plan
    inertia, stiffness : (6, 6) or None; rotation_center : m; further as in `bem.problem.Problem`
    linear : False if the stored responses have damping that depends on the amplitude
    """

    omega: np.ndarray
    quantities: dict
    depth: float
    gravity: float
    density: float
    headings: np.ndarray
    theta: np.ndarray
    outline: np.ndarray
    rotation_center: np.ndarray
    inertia: np.ndarray | None = None
    stiffness: np.ndarray | None = None
    linear: bool = True

    def at(self, omega, name):
        """A quantity and its estimated error, about one standard deviation, at omega (q,) rad/s.

        returns : value (q, …) as stored, error (q, …) in its unit, of a complex quantity that of the modulus
        raises : BetweenError outside the stored frequencies, for fewer than 4 of them, or for what is not there
        """
        omega = self._inside(omega)
        if name in RADIATION and set(RADIATION) <= set(self.quantities):
            return self._radiation(omega, name)
        if name == "rao":
            return self._carried(omega, (*RADIATION, "excitation_force"), self._rao)
        if name == "drift_force_fixed" and set(KOCHIN) <= set(self.quantities):
            return self._carried(omega, KOCHIN, self._drift_fixed)
        if name == "drift_force":  # of peaks at resonance a fit would see little and know nothing
            return self._carried(omega, (*KOCHIN, *RADIATION, "excitation_force"), self._drift)
        return self._fitted(omega, name)

    def largest_error(self, omega, names):
        """(q,) estimated error at omega (q,), relative to the largest stored of its kind, the largest over `names`.

        Diagonal coefficients, and forces over all headings, are their own kind; couplings have √(ii · jj).
        """
        return np.max([self._relative(self.at(omega, name)[1], name) for name in names], axis=0)

    @cached_property
    def length(self):
        """m, of the hull along x or y, whichever is longer"""
        return float(np.ptp(self.outline, axis=0).max())

    def _relative(self, error, name):
        stored = np.abs(self.quantities[name])
        if name in RADIATION:
            scale = _seen(np.sqrt(np.einsum("nii->ni", stored).max(axis=0)))
            scale = np.outer(scale, scale)
        else:
            scale = stored.max(axis=tuple(range(stored.ndim - 1)))
            scale = _seen(scale) if len(scale) == 6 else scale
        return np.max(error / np.where(scale > 0, scale, np.inf), axis=tuple(range(1, error.ndim)))

    def _inside(self, omega):
        omega, (low, high) = np.atleast_1d(np.asarray(omega, float)), (self.omega[0], self.omega[-1])
        outside = ~((omega >= low * (1 - 1e-9)) & (omega <= high * (1 + 1e-9)))
        if outside.any():
            raise BetweenError(f"omega is {omega[outside][0]:.6g} rad/s; stored: {low:.6g} to {high:.6g}, solve more")
        if len(self.omega) < 4:
            raise BetweenError(f"{len(self.omega)} frequencies are stored; between them needs at least 4, solve more")
        return omega

    def _abscissa(self, omega):
        return abscissa(omega, self.depth, self.gravity, self.length)

    @cached_property
    def _stored_abscissa(self):
        return self._abscissa(self.omega)

    @cached_property
    def _kept(self):
        return {}

    def _interpolant(self, name):
        if name not in self._kept:
            values = self.impedance if name == "impedance" else self.quantities[name]
            values = values / self._growth(name, self.omega, values.ndim)
            lead = np.broadcast_to(self._lead(name), values.shape[1:]).ravel() / self.length
            self._kept[name] = Interpolant(self._stored_abscissa, values.reshape(len(values), -1), lead)
        return self._kept[name]

    def _fitted(self, omega, name):
        if name != "impedance" and (name not in QUANTITIES or "omega" not in QUANTITIES[name][0]):
            raise BetweenError(f"{name!r} is no function of frequency")
        if name != "impedance" and name not in self.quantities:
            raise BetweenError(f"{name} is not stored, and does not follow from what is: {', '.join(self.quantities)}")
        shape = (len(omega), *(self.impedance if name == "impedance" else self.quantities[name]).shape[1:])
        value, error = self._interpolant(name)(self._abscissa(omega))
        growth = self._growth(name, omega, len(shape))
        return value.reshape(shape) * growth, error.reshape(shape) * growth

    def _growth(self, name, omega, dimensions):
        """(q, 1, …) what is taken out before a fit: Kochin functions grow like k, and a fit knows one size only"""
        k = self._abscissa(omega).phase if name in KOCHIN else np.ones(len(omega))
        return k.reshape(-1, *[1] * (dimensions - 1))

    @cached_property
    def impedance(self):
        """B − iω [A − A(ω_max)] (n, 6, 6), kg/s …"""
        A, B = (self.quantities[name] for name in RADIATION)
        return B - 1j * self.omega[:, None, None] * (A - A[-1])

    def _radiation(self, omega, name):
        value, error = self._fitted(omega, "impedance")
        error = error / np.sqrt(2)  # of the real or the imaginary part alone
        if name == "radiation_damping":
            return value.real, error
        return self.quantities["added_mass"][-1] - value.imag / omega[:, None, None], error / omega[:, None, None]

    def _lead(self, name):
        """m, how far ahead of the origin, along the wave, the hull meets it; per heading, angle or both"""
        towards = np.stack([np.cos(self.headings), np.sin(self.headings)], axis=1)
        away = np.stack([np.cos(self.theta), np.sin(self.theta)], axis=1)
        if name in FORCES or name == "pressure":
            return np.max(-self.outline @ towards.T, axis=0)[:, None]
        if name == "kochin_radiation":
            return np.max(self.outline @ away.T, axis=0)
        if name == "kochin_diffraction":
            return np.max(self.outline @ (away.T[:, None] - towards.T[:, :, None]).reshape(2, -1), axis=0).reshape(
                len(towards), -1
            )
        return np.zeros(1)

    def _carried(self, omega, names, equation):
        """An equation of fitted quantities, and its error by carrying the deviation of each through it.

        That of numbers one after the other, as they are; that of functions of the angle by chance (`_scattered`).
        """
        missing = [name for name in names if name not in self.quantities]
        if missing:
            raise BetweenError(
                f"{', '.join(missing)} must be stored for this; run its command again with --only {','.join(names)}"
            )
        fitted = {name: self.at(omega, name) for name in names}
        value = equation(omega, **{name: part for name, (part, _) in fitted.items()})
        if set(KOCHIN) & set(names):
            return value, self._scattered(omega, fitted, equation, value)
        variance = 0.0
        for name, (_, error) in fitted.items():
            moved = {other: part + (STEP * error if other == name else 0) for other, (part, _) in fitted.items()}
            variance = variance + np.abs((equation(omega, **moved) - value) / STEP) ** 2
        return value, np.sqrt(variance)

    def _scattered(self, omega, fitted, equation, value):
        """Deviation of `value` when all quantities deviate by chance, Kochin functions smoothly over the angle.

        Shifted by one number at all angles they would keep their slope, and the moment would seem to be known.  Chance
        is the same at all frequencies, so that an estimate does not depend on what else is asked for.
        """
        generator, variance = np.random.default_rng(0), 0.0
        waves = wavenumber(omega, self.depth, self.gravity) * np.hypot(*self.outline.T).max()
        order = np.fft.fftfreq(len(self.theta), 1 / len(self.theta))
        smooth = (np.abs(order) <= waves[:, None] + 1)[:, None]
        smooth = smooth / np.sqrt(smooth.mean(axis=-1, keepdims=True))
        for _ in range(DRAWS):
            moved = {}
            for name, (part, error) in fitted.items():
                chance = _complex_normal(generator, part.shape[1:])
                if name in KOCHIN:
                    chance = np.fft.ifft(chance * smooth, norm="ortho", axis=-1)
                moved[name] = part + STEP * error * (chance if np.iscomplexobj(part) else np.sqrt(2) * chance.real)
            variance = variance + np.abs((equation(omega, **moved) - value) / STEP) ** 2 / DRAWS
        return np.sqrt(variance)

    def _rao(self, omega, added_mass, radiation_damping, excitation_force):
        if self.inertia is None:
            raise BetweenError("responses need the inertia of the body: give --gyration kxx,kyy,kzz")
        if not self.linear:
            raise BetweenError("responses with viscous damping depend on the wave height; only stored ones are known")
        terms = zip(omega, added_mass, radiation_damping, excitation_force, strict=True)
        return np.array([response(w, A, B, F, self.inertia, self.stiffness) for w, A, B, F in terms])

    def _drift(self, omega, kochin_radiation, kochin_diffraction, **coefficients):
        rao = self._rao(omega, **coefficients)
        return self._drift_fixed(omega, kochin_radiation, kochin_diffraction + rao @ kochin_radiation)

    def _drift_fixed(self, omega, kochin_radiation, kochin_diffraction):
        """By H at equally spaced angles, its slope and its value at β from the Fourier series.

        Energy, −Re H(β) = (1/2π) ∫|H|² dθ, stands for the forward value in the forces, which would else be the small
        difference of what errors do not respect; there is none for the moment.
        """
        t = len(self.theta)
        order = np.fft.fftfreq(t, 1 / t)
        series = np.fft.fft(kochin_diffraction, axis=-1) / t
        slope = np.fft.ifft(1j * order * series * t, axis=-1)
        ahead = 1j * order * np.exp(1j * np.multiply.outer(self.headings - self.theta[0], order))
        forward = -np.mean(np.abs(kochin_diffraction) ** 2, axis=-1)
        forward_slope = np.sum(series * ahead, axis=-1)
        k = wavenumber(omega, self.depth, self.gravity)
        rows = zip(kochin_diffraction, slope, forward, forward_slope, k, group_factor(k, self.depth), strict=True)
        out = [
            mean_drift(H, dH, f, df, self.theta, self.headings, q, n, self.density, self.gravity)
            for H, dH, f, df, q, n in rows
        ]
        return about(np.array(out), self.rotation_center)


def _complex_normal(generator, shape):
    """Of variance one"""
    return (generator.standard_normal(shape) + 1j * generator.standard_normal(shape)) / np.sqrt(2)


def _seen(scale):
    """(6,) infinite for motions that move no water, as yaw of a buoy: what is left of them is rounding"""
    largest = np.repeat([scale[:3].max(), scale[3:].max()], 3)
    return np.where(scale > 1e-4 * largest, scale, np.inf)


def between(db):
    """`Between` of the solved rows of a database."""
    names = [n for n in db.names if "omega" in QUANTITIES[n][0] and n != "rao"]
    return Between(
        db.omega,
        {name: db[name] for name in names},
        db.water_depth,
        db.gravity,
        db.density,
        db.wave_direction,
        db["theta"],
        db.mesh.whole().points[:, :2],
        db.rotation_center,
        db.inertia_matrix,
        db.hydrostatic_stiffness,
        not db.has_viscous_motions,
    )
