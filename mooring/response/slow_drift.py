"""Slowly varying drift force in irregular waves: Newman's approximation, and half wave by half wave.

Newman (1974) approximates the transfer function of a pair of waves by the mean drift of each wave, here with the
square root:

    F(t) = Σᵢ Σⱼ aᵢ aⱼ T_ij cos{(ωᵢ − ωⱼ)t − (εᵢ − εⱼ)},    T_ij = sign √(DᵢDⱼ) where Dᵢ and Dⱼ have one sign, else 0
    which is one sum over the components, |Σ aᵢ √Dᵢ exp(iεᵢ − iωᵢt)|², for D > 0, minus one of √−Dᵢ for D < 0. It
    contains
no sum frequencies and its mean is Σ aᵢ² Dᵢ = 2∫SD dω.  Every component has its own direction; this T serves pairs of
one heading and of two headings. Each wave of a pair enters separately, so a force that changes sign over the
headings varies in time although its mean may be zero.  The approximation holds for small ωᵢ − ωⱼ. It neglects the
force of the bound long wave, which increases with the difference and in shallow water.  The body is fixed at its
mean place and heading: wave phases and D do not follow its slow motion (for its effect on damping see
`wave_drift_damping`). Over differences Δω the spectrum of the force is, after Pinkster (1980),

    S_F(Δω) = 8 ∫ S(ω) S(ω + Δω) Σ_a Σ_b w_a w_b T²(ω, β_a; ω + Δω, β_b) dω

with the shares w of the energy per heading.  With D = D⁺ − D⁻ of two non-negative parts T² is D⁺D⁺ + D⁻D⁻, so that the
sum over all pairs is ⟨D⁺⟩⟨D⁺⟩ + ⟨D⁻⟩⟨D⁻⟩ of the means over the headings of each part.

Half wave by half wave (Remery and Hermans 1971, Hsu and Blenkarn 1970; SR179 report (1982), eq. 3.7.1.5): between two
zero crossings Δt apart the force is constant, D(ω) ζ² with ω = π/Δt and ζ the largest elevation between them.  In a
narrow spectrum the mean of this force is 2∫SD dω.  In a broad spectrum the mean differs: ζ² of the extremes is 12 %
more than twice the energy (ISSC; 8 to 10 % for JONSWAP), and the frequencies of half waves differ from those of the
energy. For a box of 100 × 50 × 10 m in 20 m of water, whose drift has a peak at 10 s, the mean deviates from the
integral by +16, +27, +2 % in head seas and by +19, +17, −7 % at 60° (ISSC, T01 8, 10, 12 s), and by +15, +24 %
(JONSWAP, Tp 11 s), means of four records of three hours. `half_waves(…, amplitude="energy")` removes the first of
these two effects.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.database.between_frequencies import BetweenError

from .linear import over_headings

MOST_OUTSIDE = 0.01  # largest share of the energy beyond the stored band for which the drift at its ends is used
FINE = np.deg2rad(5.0)  # step between directions of the drift of short-crested waves, rad
HORIZONTAL = [0, 1, 5]  # surge, sway and yaw of six degrees of freedom
SLOWEST = 0.2, 100.0  # rad/s, upper end of the slow force spectrum, for a hull of that length, m
STEPS = 80
# smallest slope of encounter frequency over wave frequency before blocking, and most frequencies
SLOWEST_SLOPE, MOST_MET = 0.05, 3000
# below; frequencies at which waves of several headings are summed
ROWS = 256  # times or components in one block: 256 × 500 complex numbers fit the cache


class HalfWaves(NamedTuple):
    """Half waves of a record: start (n,) s, frequency (n,) rad/s, amplitude (n,) m; `end` s closes the last one."""

    start: np.ndarray
    omega: np.ndarray
    amplitude: np.ndarray
    end: float


def component_drift(body, components, hold=False):
    """Mean drift D of every wave component at its own frequency and direction, N/m² and N m/m²; shape (n, 3).

    components : omega, amplitude, phase, direction, each (n,)
    hold : whether all components beyond the stored band use the end values; if not, only up to 1 % of the energy may
    raises : BetweenError
    """
    omega, direction = np.asarray(components.omega, float), np.asarray(components.direction, float)
    low, high = body.omega[0], body.omega[-1]
    share = outside_band(body, components)
    if share > MOST_OUTSIDE and not hold:
        raise BetweenError(
            f"{100 * share:.1f} % of the wave energy is outside the database's {low:.4g} to {high:.4g} rad/s; "
            f"allowed: {100 * MOST_OUTSIDE:g} %; add frequencies to the scene, or keep the drift constant beyond the "
            f"ends (hold=True)"
        )
    held = np.clip(omega, low, high)
    if np.ptp(direction) == 0:
        return body.drift(held, direction[:1])[:, 0]
    return np.concatenate([_own(body, held[i : i + ROWS], direction[i : i + ROWS]) for i in range(0, len(held), ROWS)])


def outside_band(body, components):
    """Share of the energy of wave components beyond the stored frequencies."""
    energy = np.asarray(components.amplitude, float) ** 2
    outside = (components.omega < body.omega[0]) | (components.omega > body.omega[-1])
    return float(energy[outside].sum() / energy.sum())


def newman(components, drift, t):
    """Record of the drift force at times t (s,), s, N, N, N m; shape (s, 3).

    components : omega, amplitude, phase (lag), each (n,); drift : (n, 3) from `component_drift`.
    Equally spaced times need two small matrix products in place of n s cosines.
    """
    wave = np.asarray(components.amplitude) * np.exp(1j * np.asarray(components.phase))
    drift = np.asarray(drift, float)
    positive, negative = np.sqrt(np.maximum(drift, 0.0)), np.sqrt(np.maximum(-drift, 0.0))
    rows = wave * np.concatenate([positive, negative], axis=1).T
    used = np.flatnonzero(np.any(rows != 0, axis=1))
    power = np.zeros((len(rows), len(np.atleast_1d(t))))
    power[used] = np.abs(sums(rows[used], np.asarray(components.omega, float), np.atleast_1d(t))) ** 2
    n = drift.shape[1]
    return (power[:n] - power[n:]).T


def differences(body):
    """Difference frequencies of the slow force's spectrum, rad/s; shape (d,).

    They reach 0.2 for a hull of 100 m, and follow Froude's law for any other length. For a single moored body they
    reach three times its natural frequencies of surge, sway and yaw; several bodies, which fenders hold far more
    stiffly to each other, are excepted
    """
    high = SLOWEST[0] * np.sqrt(SLOWEST[1] / body.between.length * body.gravity / 9.80665)
    for mode in (0, 1, 5):
        if body.stiffness[mode, mode] > 0 and not body.bodies:
            mass = body.inertia[mode, mode] + body.held_added_mass(high)[0, mode, mode]
            high = max(high, 3 * np.sqrt(body.stiffness[mode, mode] / mass))
    return np.linspace(0.0, high, STEPS + 1)


def signed_means(drift, weights=(1.0,)):
    """Means over the headings of D where it is positive and of −D where it is negative; shape (q, 2, 3).

    drift : (q, p, 3); weights : (p,) or (q, p) shares of the energy per heading
    """
    return over_headings(signed(drift), weights)


def signed(drift):
    """Positive part of drift (q, p, 3), and minus its negative part; shape (q, p, 2, 3)"""
    return np.stack([np.maximum(sign * drift, 0.0) for sign in (1, -1)], axis=2)


def force_spectrum(spectrum, omega, drift, difference):
    """Spectral density of the slow force over differences (d,), rad/s, N² s/rad, by Pinkster's formula with Newman's T;
    shape (d, 3).

    spectrum : object with `density`; omega : (q,) rising, close enough for D
    drift : (q, 3) for long-crested waves, or `signed_means` (q, 2, 3) for short-crested waves. Waves beyond omega
        are left out.
    """
    omega, drift = np.asarray(omega, float), np.asarray(drift, float)
    parts = signed_means(drift[:, None]) if drift.ndim == 2 else drift
    result = _over_pairs(spectrum, omega, parts.reshape(len(omega), -1), difference)
    return result.reshape(len(result), 2, -1).sum(axis=1)


def signed_pairs(drift):
    """Products √(D_a D_b) of the positive and negative parts of drift (q, p, 3), in the order ++, +−, −+, −−; shape
    (q, p, 4, 3, 3)
    """
    roots = np.moveaxis(np.sqrt(signed(drift)), 2, 0)
    return np.stack([np.einsum("qpa,qpb->qpab", a, b) for a in roots for b in roots], axis=2)


class _Met(NamedTuple):
    """A spectrum restricted to the summed energy"""

    def density(self, omega):
        return np.ones(np.shape(omega))


def slow_parts(body, spectrum, omega, heading, parts, weights):
    """Spectrum, frequencies (g,) and heading means (g, …) of drift parts (q, p, …), for `force_spectrum` and
    `cross_spectrum`.

    On a current two waves beat at the difference of the frequencies at which the body meets them, for any headings.
    Parts are therefore summed, with the energy, over the headings at equal met frequencies.
    """
    carrier = getattr(body, "carrier", None)
    if carrier is None or carrier.absolute:
        return spectrum, *held_beyond(omega, over_headings(parts, weights), spectrum)
    count = len(omega)
    omega, parts = held_beyond(omega, parts, spectrum)
    weights = np.broadcast_to(weights, (count, parts.shape[1]))
    weights = np.concatenate([weights, np.repeat(weights[-1:], len(omega) - count, axis=0)])
    met = carrier.met(omega[:, None], np.atleast_1d(heading)[None], body.depth, body.gravity)
    slope = np.gradient(met, omega, axis=0)
    last = [int(np.argmax(np.append(slope[:, p], -1.0) < SLOWEST_SLOPE)) for p in range(met.shape[1])]
    grid = np.unique(np.concatenate([met[:end, p] for p, end in enumerate(last)]))
    grid = grid[np.unique(np.linspace(0, len(grid) - 1, MOST_MET).astype(int))]
    flat = parts.reshape(*met.shape, -1) * (weights * np.asarray(spectrum.density(omega))[:, None] / slope)[..., None]
    total = np.zeros((len(grid), flat.shape[-1]))
    for p, end in enumerate(last):
        for c in range(flat.shape[-1]):
            total[:, c] += np.interp(grid, met[:end, p], flat[:end, p, c], left=0.0, right=0.0)
    return _Met(), grid, total.reshape(len(grid), *parts.shape[2:])


def cross_spectrum(spectrum, omega, products, difference):
    """Cross spectral densities of slow forces; shape (d, 3, 3); products : `signed_pairs` at omega, mean over headings

    The forces are in phase: by Newman's rule, T_ij of two forces in one pair of waves have no lag. The diagonal is
    `force_spectrum`. Products of n forces at several places are complex, with the phases at these places; shape (d,
    n, n).
    """
    omega, shape = np.asarray(omega, float), products.shape[1:]
    found = _over_pairs(spectrum, omega, products.reshape(len(omega), -1), difference).reshape(-1, *shape)
    return np.einsum("s,dsab->dab", [1.0, -1.0, -1.0, 1.0], found)


def _over_pairs(spectrum, omega, values, difference):
    """Integrals 8 ∫ S(ω) S(ω + Δω) v*(ω) v(ω + Δω) dω of values (q, c); shape (d, c)"""
    first = values.conj() * np.asarray(spectrum.density(omega))[:, None]
    result = np.zeros((len(np.atleast_1d(difference)), first.shape[1]), first.dtype)
    for i, step in enumerate(np.atleast_1d(difference)):
        other = omega + step
        second = np.where(other <= omega[-1], spectrum.density(other), 0.0)[:, None]
        v = np.stack([np.interp(other, omega, column) for column in values.T], axis=-1)
        result[i] = 8 * np.trapezoid(first * second * v, omega, axis=0)
    return result


def force_spectrum_with(bound, spectrum, omega, drift, difference, met=None):
    """Spectral density of the slow force of long-crested waves including bound waves: 8 ∫ S S |T|² dω; shape (d, 6)

    bound : T of bound waves as a function of two frequencies, `bound_wave_drift.BoundWaveForces`
    drift : in surge, sway and yaw, for Newman's part, (q, 3)
    met : function of the wave frequency: frequency at which a body on a current meets waves, whose differences are
        used; None in still water
    """
    omega, drift = np.asarray(omega, float), np.asarray(drift, float)
    density = np.asarray(spectrum.density(omega))
    seen = omega if met is None else np.maximum.accumulate(met(omega))
    wide = 1.0 if met is None else 1 / np.maximum(np.gradient(seen, omega), SLOWEST_SLOPE)
    result = np.zeros((len(np.atleast_1d(difference)), 6))
    for i, step in enumerate(np.atleast_1d(difference)):
        other = omega + step if met is None else np.interp(seen + step, seen, omega, right=2 * omega[-1])
        second = np.where(other <= omega[-1], spectrum.density(other), 0.0)
        if met is not None:
            second = second * np.interp(other, omega, wide)
        D = np.stack([np.interp(other, omega, column) for column in drift.T], axis=-1)
        T = bound(other, omega)
        T[:, HORIZONTAL] += np.where(drift * D > 0, np.sign(D) * np.sqrt(np.abs(drift * D)), 0.0)
        result[i] = 8 * np.trapezoid((density * second)[:, None] * np.abs(T) ** 2, omega, axis=0)
    return result


def held_beyond(omega, drift, spectrum):
    """Arrays omega and drift (q, …), extended to 99.9 % of the energy of the waves; D keeps its last value there."""
    last = float(spectrum.quantile(0.999))
    if last <= omega[-1]:
        return omega, drift
    more = np.linspace(omega[-1], last, 101)[1:]
    return np.concatenate([omega, more]), np.concatenate([drift, np.repeat(drift[-1:], 100, axis=0)])


def half_waves(elevation, step, amplitude="extreme") -> HalfWaves:
    """Half waves of a record of wave elevation (s,) m sampled every `step` s, from its first zero crossing to its last.

    amplitude : "extreme", the largest elevation as in the report; "energy", √2 times the root mean square.
    Crossings are interpolated linearly between samples, extremes by parabolas through three of them. Raises ValueError
    with fewer than 3 crossings, or fewer than 8 samples per half wave on average.
    """
    if amplitude not in ("extreme", "energy"):
        raise ValueError(f"amplitude is {amplitude!r}; allowed: 'extreme', 'energy'")
    y = np.asarray(elevation, float)
    y = y - y.mean()
    before = np.flatnonzero((y[:-1] < 0) != (y[1:] < 0))
    if len(before) < 3:
        raise ValueError(f"the wave record has {len(before)} zero crossings; allowed: at least 3")
    at = before + y[before] / (y[before] - y[before + 1])
    samples = np.diff(at)
    if samples.mean() < 8:
        raise ValueError(
            f"half waves have {samples.mean():.3g} samples on average; allowed: at least 8; give a shorter step"
        )
    inside, starts = slice(0, before[-1] + 1), before[:-1] + 1
    if amplitude == "extreme":
        size = np.maximum.reduceat(_peaks(y)[inside], starts)
    else:
        size = np.sqrt(2 * np.add.reduceat(y[inside] ** 2, starts) / samples)
    return HalfWaves(at[:-1] * step, np.pi / (samples * step), size, float(at[-1] * step))


def half_wave_drift(waves, omega, drift, t):
    """Record of the drift force at times t (s,), s, N, N, N m; shape (s, 3); zero outside the half waves.

    waves : from `half_waves`; omega : (q,) rad/s; drift : mean drift at omega, (q, 3). Beyond omega D keeps its end
        values, because half waves scatter far more in frequency than the spectrum.
    """
    force = np.stack([np.interp(waves.omega, omega, column) for column in np.transpose(drift)], axis=-1)
    force *= waves.amplitude[:, None] ** 2
    t = np.atleast_1d(t)
    place = np.searchsorted(waves.start, t, side="right") - 1
    inside = (place >= 0) & (t < waves.end)
    return np.where(inside[:, None], force[np.maximum(place, 0)], 0.0)


def _own(body, omega, direction):
    """Drift D at pairs of frequency and direction, by a spline over directions at most 5° apart; shape (n, 3)"""
    from scipy.interpolate import CubicSpline

    offset = np.mod(direction - direction[0] + np.pi, 2 * np.pi) - np.pi
    steps = max(4, int(np.ceil(np.ptp(offset) / FINE)))
    grid = np.linspace(offset.min(), offset.max(), steps + 1)
    pairs = np.arange(len(omega))
    return CubicSpline(grid, body.drift(omega, direction[0] + grid), axis=1)(offset)[pairs, pairs]


def sums(rows, omega, t):
    """Sums Σᵢ rowsᵢ exp(−iωᵢt); shape (r, s); for equal steps t = t₁ + t₂ splits every phase into a coarse and a fine
    one"""
    step = np.diff(t)
    if len(t) > 2 * ROWS and np.ptp(step) <= 1e-9 * np.abs(t).max():
        fine = int(np.ceil(np.sqrt(len(t))))
        coarse = np.exp(-1j * np.outer(t[::fine], omega))
        turn = np.exp(-1j * np.outer(omega, (t[1] - t[0]) * np.arange(fine)))
        return np.stack([((row * coarse) @ turn).ravel()[: len(t)] for row in rows]).reshape(len(rows), len(t))
    parts = [rows @ np.exp(-1j * np.outer(omega, t[i : i + ROWS])) for i in range(0, len(t), ROWS)]
    return np.concatenate(parts, axis=1)


def _peaks(y):
    """|y| with every local maximum raised to the top of the parabola through it and its neighbours"""
    size = np.abs(y)
    a, b, c = size[:-2], size[1:-1], size[2:]
    bend = a - 2 * b + c
    top = (b >= a) & (b >= c) & (bend < 0) & (y[:-2] * y[1:-1] > 0) & (y[1:-1] * y[2:] > 0)
    size[1:-1] = np.where(top, b - (a - c) ** 2 / (8 * np.where(top, bend, 1.0)), b)
    return size
