"""Causes of a dynamic line's motion: its fairlead, the current and the waves, as values.

Time factor exp(−iωt): a displacement is Re[X exp(−iωt)].  The line starts from rest, so each of these may grow from
zero over a ramp.
"""

from dataclasses import dataclass

import numpy as np

from hakobune.bem.kernels.jit import as_python
from hakobune.bem.waves import wavenumber

from .lumped.system import Motion, Water

PARTS_OF_PERIOD = 36  # longest step as a part of the shortest period: work in slow motion is then accurate to 1 %


@dataclass(frozen=True)
class FairleadMotion:
    """Position of the fairlead in time, made by `harmonic`, `table` or `still`.

    mean : (3,) m; omega : (m,) rad/s; amplitude : (m, 3) m, complex; ramp : s
    knots, cubics : piecewise cubics in place of the mean, shapes (k + 1,) s and (k, 4, 3)
    """

    mean: np.ndarray
    omega: np.ndarray
    amplitude: np.ndarray
    ramp: float = 0.0
    knots: np.ndarray | None = None
    cubics: np.ndarray | None = None

    @classmethod
    def still(cls, point):
        """A fairlead that stays at `point` (3,) m."""
        return cls.harmonic(point, np.zeros((1, 3)), [3.0])

    @classmethod
    def harmonic(cls, mean, amplitude, period, ramp=None):
        """mean + Re Σ amplitude exp(−2πit/period), from rest at the mean.

        mean : (3,) m; amplitude : (3,) or (m, 3) m, complex allowed; period : s, one or (m,)
        ramp : s; by default the longest period
        """
        mean, X = _point(mean), np.atleast_2d(np.asarray(amplitude, complex))
        T = np.atleast_1d(np.asarray(period, float))
        if X.shape != (T.size, 3) or not np.all(np.isfinite(X)):
            raise ValueError(f"fairlead amplitude has shape {X.shape}; allowed: {(T.size, 3)}, finite")
        if not np.all((T > 0) & np.isfinite(T)):
            raise ValueError(f"fairlead period is {T.min():g} s; allowed: finite, above 0")
        return cls(mean, 2 * np.pi / T, X, _duration("ramp", T.max() if ramp is None else ramp))

    @classmethod
    def table(cls, time, position, velocity=None):
        """A table of positions, joined by cubics with continuous acceleration, or with the given velocities.

        time : (k,) s, ascending; position, velocity : (k, 3) m and m/s; `simulate` refuses times beyond the table
        """
        from scipy.interpolate import CubicHermiteSpline, CubicSpline

        t, p = np.asarray(time, float), np.asarray(position, float)
        if t.ndim != 1 or t.size < 2 or p.shape != (t.size, 3):
            raise ValueError(f"fairlead table has shapes {t.shape} and {p.shape}; allowed: (k,) and (k, 3), k ≥ 2")
        if not (np.all(np.isfinite(t)) and np.all(np.diff(t) > 0) and np.all(np.isfinite(p))):
            raise ValueError("fairlead table has times that do not rise or values that are not finite")
        curve = CubicSpline(t, p) if velocity is None else CubicHermiteSpline(t, p, np.asarray(velocity, float))
        cubics = np.ascontiguousarray(curve.c[::-1].transpose(1, 0, 2))
        return cls(p[0], np.zeros(0), np.zeros((0, 3), complex), 0.0, t, cubics)

    @property
    def end(self):
        """End of the known motion, s"""
        return np.inf if self.knots is None else self.knots[-1]

    @property
    def begin(self):
        """Start of the known motion, s"""
        return 0.0 if self.knots is None else self.knots[0]

    @as_python()
    def at(self, t):
        """Position, m, velocity, m/s, and acceleration, m/s², at time t; shape (3, 3)"""
        from .lumped.surroundings import fairlead_at

        found = np.zeros((3, 3))
        fairlead_at(self.arrays, float(t), *found)
        return found

    @property
    def longest_step(self):
        """Longest step that resolves the motion, s"""
        if self.knots is not None:
            return 2 * float(np.diff(self.knots).max())
        return 2 * np.pi / self.omega.max() / PARTS_OF_PERIOD

    @property
    def arrays(self):
        """The FairleadMotion as arrays for the kernels."""
        knots, cubics = self.knots, self.cubics
        if knots is None:
            knots, cubics = np.array([0.0, 1.0]), np.zeros((1, 4, 3))
            cubics[0, 0] = self.mean
        real, imag = np.ascontiguousarray(self.amplitude.real), np.ascontiguousarray(self.amplitude.imag)
        return Motion(knots, cubics, self.omega, real, imag, float(self.ramp))


@dataclass(frozen=True)
class CurrentProfile:
    """Velocity (k, 2) m/s at heights z (k,) m, linear between the heights and constant beyond, without a ramp."""

    z: np.ndarray
    velocity: np.ndarray

    def __post_init__(self):
        z, U = np.atleast_1d(np.asarray(self.z, float)), np.atleast_2d(np.asarray(self.velocity, float))
        if U.shape != (z.size, 2) or not (np.all(np.isfinite(z)) and np.all(np.isfinite(U))):
            raise ValueError(f"current has shapes {z.shape} and {U.shape}; allowed: (k,) and (k, 2), finite")
        if np.any(np.diff(z) <= 0):
            raise ValueError("current levels z do not rise; allowed: from the bed upwards")
        object.__setattr__(self, "z", z)
        object.__setattr__(self, "velocity", np.ascontiguousarray(U))


@dataclass(frozen=True)
class WaveTrain:
    """Regular waves that add up; all fields (w,).

    amplitude : m; period : s; direction : direction of travel, rad; phase : phase lag at the origin, rad
    depth : m, may be inf; ramp : s, by default the longest period
    carried : (2,) m/s, current that carries the waves; periods are then measured in the moving water
    """

    amplitude: np.ndarray
    period: np.ndarray
    direction: np.ndarray
    phase: np.ndarray | float = 0.0
    depth: float = np.inf
    ramp: float | None = None
    carried: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self):
        given = (self.amplitude, self.period, self.direction, self.phase)
        a, T, b, p = np.broadcast_arrays(*(np.atleast_1d(np.asarray(v, float)) for v in given))
        if not all(np.all(np.isfinite(v)) for v in (a, T, b, p)) or a.ndim != 1 or np.any(T <= 0):
            raise ValueError(
                "waves: amplitude, period, direction and phase must be finite arrays of shape (w,), with periods "
                "above 0 s"
            )
        if not self.depth > 0:
            raise ValueError(f"water depth is {self.depth:g} m; allowed: above 0, inf for deep water")
        for name, value in zip(("amplitude", "period", "direction", "phase"), (a, T, b, p), strict=True):
            object.__setattr__(self, name, np.ascontiguousarray(value))
        object.__setattr__(self, "ramp", _duration("ramp", T.max() if self.ramp is None else self.ramp))


def flowing(z, velocity):
    """`Water` without waves, with a current (k, 2) m/s at heights z (k,) m"""
    none, pairs = np.zeros(0), np.zeros((0, 2))
    untabled = 0.0, 0.0, none, none, np.zeros(2), np.zeros((2, 0))
    return Water(z, velocity, none, none, none, pairs, none, np.inf, 0.0, *untabled, none, np.zeros(2))


def water_arrays(current, waves, gravity):
    """Current and waves, either of which may be None, for the kernels; None for still water."""
    if current is None and waves is None:
        return None
    none = np.zeros(0), np.zeros((0, 2))
    water = flowing(*none if current is None else (current.z, current.velocity))
    if waves is None:
        return water
    omega = 2 * np.pi / waves.period
    heading = np.stack([np.cos(waves.direction), np.sin(waves.direction)], axis=-1)
    k = np.asarray(wavenumber(omega, waves.depth, gravity), float)
    carried = np.asarray(waves.carried, float)
    return water._replace(
        amplitude=waves.amplitude, omega=omega, wavenumber=k, heading=heading, phase=waves.phase,
        depth=float(waves.depth), ramp=float(waves.ramp), met=omega + k * (heading @ carried), carried=carried,
    )  # fmt: skip


def _point(value):
    p = np.asarray(value, float)
    if p.shape != (3,) or not np.all(np.isfinite(p)):
        raise ValueError(f"fairlead position is {value}; allowed: three finite numbers in m")
    return p


def _duration(name, value):
    if not (value >= 0 and np.isfinite(value)):
        raise ValueError(f"{name} is {value:g} s; allowed: finite, at least 0")
    return float(value)
