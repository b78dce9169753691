"""A moored body in a sea, in the frequency domain: slow motion, wave motion, and both motions together.

    {−Ω²[M + A(Ω)] − iΩ[B_D + B′] + C + K} x(Ω) = F(Ω),    S_x = H S_F H*,    σ² = ∫ S_x dΩ

K is the stiffness of the lines in equilibrium under steady forces, B_D the wave drift damping, B′ the damping given
in the study. F contains slow drift by Newman's approximation with its cross spectra, and gusts in phase over the
hull (`slow_spectrum`). The drag of the hull is linearised as in `long_period`. Static lines have no damping; their
drag is part of B′. In addition there are two estimates for a single mode with stiffness C, damping N and ν =
N/N_critical:

    σ ≈ √(π S_F(ω_n) / 2NC)  a flat spectrum,        x ≈ x_s / 2ν  a force that beats at ω_n, x_s = σ_F/C

The wave motion of the moored body comes from `response.sea_state`.  Slow drift is a quadratic form of the waves and far
from Gaussian: with independent complex normal z_j

    x = Σ_j λ_j |z_j|²,    λ the eigenvalues of  Q_il = H(ω_i − ω_l) √(D_i D_l) 2√(S_i S_l) Δω

(Kac and Siegert 1947, Naess 1986); gusts and waves add a Gaussian part. The characteristic function of the sum gives
its density f; a level x is crossed f(x) σ_ẋ/√2π times a second.  The largest value of slow motion in head seas is a
third above the largest value of a Gaussian process with the same variance. For comparison, DNV-OS-E301 (chapter 2,
section 2) takes the larger of two sums with Gaussian values: significant slow motion plus largest wave motion, or
largest slow motion plus significant wave motion.

Several bodies move together on the stiffness of lines, fenders and hinges. Each body has three slow motions, with its
own mean drift and the phases of the waves at its place.  Damping and stiffness of a mode then belong to the coupled
natural mode named after the motion. The drag of each hull is linearised in its own velocity.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from hakobune.bem.database.natural_periods import natural_periods

from ..response.extremes import EULER, expected_maximum
from ..response.sea_state import TINY, SeaState, sea_state
from ..response.slow_drift import differences
from .slow_spectrum import PLANE, between, drift_of_sea, gust_spectrum

ABOUT = 60  # frequencies on either side of a resonance, up to some widths away
# fewest and most waves of the quadratic form, two within the half width of a resonance if possible
FEWEST_WAVES, MOST_WAVES = 100, 500
REACH, POINTS = 30.0, 8192  # deviations, and points over twice that many, of the density of the motion
SIGNIFICANT = 2.0  # amplitude over deviation, of a narrow spectrum
SLOW = 0.5  # share of the mean frequency of the waves below which modes of several bodies count as slow
TURNS, SETTLED = 40, 1e-3  # iterations on the velocity that the drag of several bodies is linearised in
NEAR = 1.5  # a natural period within this factor of a wave period is reported


class SlowMotion(NamedTuple):
    """Values of surge, sway, yaw (3,), m, m, rad; for several bodies (3N,), one after another.

    Mean offset; standard deviations of slow motion and of wave motion, with mean zero-crossing periods, s
    drift_share : share of drift in the slow variance, the rest is due to gusts; period, s, and damping ratio of each
        mode
    estimates : of the deviation by flat spectrum and by beating force, (3, 2)
    largest, rule : expected largest motion from rest by the sum of all parts, and by DNV's rule

    omega (d,) rad/s; force (d, 3, 3), its part in phase, and spectrum (d, 3) of the slow force and motion; fast :
    `SeaState` of the moored body, with the slow forces on the free body; duration : s
    """

    offset: np.ndarray
    slow: np.ndarray
    slow_period: np.ndarray
    fast_sigma: np.ndarray
    fast_period: np.ndarray
    drift_share: np.ndarray
    period: np.ndarray
    ratio: np.ndarray
    estimates: np.ndarray
    largest: np.ndarray
    rule: np.ndarray
    omega: np.ndarray
    force: np.ndarray
    spectrum: np.ndarray
    fast: SeaState
    duration: float
    warnings: tuple


def slow_motion(free, held, sea, duration, loads=None, points=()) -> SlowMotion:
    """`SlowMotion` of a body in a Sea for `duration` s.

    free : `bem.database.reader.Reader`, `floating`; held : this Reader restrained by lines and damping
    loads : `Loads`, None for waves alone; points : `response.points.Point`s for the wave motion
    raises : ValueError without drift in the database, and for a mode without restoring or damping
    """
    if not free.knows_drift:
        raise ValueError(
            "slow motion needs the mean drift, which the database lacks; repeat the command that made it, "
            "with --only kochin,drift"
        )
    loads, state, of_sea = loads or Loads(), sea_state(free, sea, duration), drift_of_sea(free, sea)
    plane, by_drift = _plane(held.inertia), _drift_damping(of_sea.damping(), len(held.inertia) // 6)
    mass, stiffness = held.inertia + held.held_added_mass(0.0)[0], held.stiffness
    fast = replace(sea_state(held.without_drift(), sea, duration, points), slow=state.slow)
    f0, f2 = (moment[plane] for moment in (fast.moments.m0, fast.moments.m2))
    drag = _water(loads, np.diag(by_drift)[plane], held)
    known, water, m2, unsettled = None, np.inf, 0.0, ()
    for _ in range(TURNS):
        before, water = water, drag(np.sqrt(f2 + m2))
        if np.all(np.abs(water - before) <= SETTLED * np.abs(water)):
            break
        damping = held.damping + by_drift
        damping[plane, plane] += water
        modes = _modes(held, mass, damping)
        omega = _places(held, modes, sea)
        known = of_sea.coarse(omega[-1]) if known is None else known
        drift = between(known, omega)
        gusts = np.zeros_like(drift) if loads.gust is None else gust_spectrum(*loads.gust, omega)
        respond = _response(omega, mass, damping, stiffness, held.free)
        spectra = [np.einsum("dij,djk,dik->di", respond, force, respond.conj()).real for force in (drift, gusts)]
        m0, m2 = (np.trapezoid(omega[:, None] ** n * sum(spectra), omega, axis=0) for n in (0, 2))
    else:
        unsettled = (f"slow motion: the drag of the hulls did not settle in {TURNS} turns; use `hakobune simulate`",)
    forms = _forms_of(of_sea, modes, mass, damping, stiffness, held.free)
    along, yaw = m0.reshape(-1, 3)[:, :2].max(), m0[2::3].max()
    seen = m0 > TINY**2 * np.tile([along, along, yaw], len(m0) // 3)
    m0, m2 = np.where(seen, m0, 0.0), np.where(seen, m2, 0.0)
    by_drift = np.trapezoid(spectra[0], omega, axis=0)
    offset = np.asarray(loads.offset, float)
    return SlowMotion(
        offset,
        np.sqrt(m0),
        _crossing(m0, m2),
        np.sqrt(f0),
        _crossing(f0, f2),
        np.where(m0 > 0, by_drift / np.maximum(m0, 1e-300), 1.0),
        modes.period,
        modes.ratio,
        _estimates((drift + gusts).real, omega, modes),
        np.abs(offset) + _largest_of_forms(forms, np.maximum(m0 - by_drift + f0, 0.0), m2 + f2, seen, duration),
        np.abs(offset) + _rule(np.sqrt(m0), _crossing(m0, m2), np.sqrt(f0), _crossing(f0, f2), duration),
        omega,
        (drift + gusts).real,
        sum(spectra),
        fast,
        float(duration),
        (
            *dict.fromkeys((*state.warnings, *fast.warnings)),
            *unsettled,
            *_flags(modes, sea, [held.words[i] for i in plane]),
        ),
    )


class Loads(NamedTuple):
    """offset : due to the steady forces, (3,), m, m, rad; gust : None, or (GustSpectrum, (3,) mean wind force N, N,
    N m)

    water : damping of surge, sway and yaw by the water, with wave drift damping, as in `long_period`, (3,), N s/m
        and N m s; its part without wave drift is added to the damping of the moored body
    drag : in place of `water`, a function of the velocities' σ (3N,) → linearised drag (3N,), without radiation
    """

    offset: np.ndarray = np.zeros(3)
    gust: tuple | None = None
    water: np.ndarray | float = 0.0
    drag: Callable | None = None


class _Modes(NamedTuple):
    """Modes of surge, sway and yaw (3N,): natural period s, stiffness, damping and its ratio to critical, each alone

    Those of several bodies are the coupled modes named after them; nan where hinges leave none.
    """

    period: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    ratio: np.ndarray


def _modes(held, mass, damping):
    found, rows, words = natural_periods(held), [], dict(zip(held.names, held.words, strict=True))
    loose = [name for name, T in zip(found.names, found.period, strict=True) if not np.isfinite(T)]
    for i in _plane(mass):
        name, word = held.names[i], held.words[i]
        if name not in found.names:
            rows.append(np.full(4, np.nan))
            continue
        j = found.names.index(name)
        own = found.shapes[j] / np.where(held.turning, found.scale, 1.0) if held.bodies else np.eye(len(mass))[i]
        M, N, C = (own @ matrix @ own / own[i] ** 2 for matrix in (mass, damping, held.stiffness))
        if name in loose or not C > 0 or (loose and held.bodies):
            raise ValueError(
                f"{words[(*loose, name)[0]] if held.bodies else word} has no restoring by the lines; slow motion of a "
                "body that drifts away is not defined"
            )
        if not N > 0:
            key = f'"{word}"' if held.bodies else word
            raise ValueError(
                f"slow {word} has damping {N:.3g} (wave drift and study together); allowed: above 0; give "
                f"body.damping_ratio = {{ {key} = 0.05 }} or so for the drag of lines and hull"
            )
        rows.append([found.period[j], C, N, N / (2 * np.sqrt(C * M))])
    return _Modes(*np.transpose(rows))


def _water(loads, by_drift, held):
    """Function of σ of the velocities (3N,) → damping by the water in addition to that by wave drift, (3N,)"""
    if loads.drag is None:
        given = np.maximum(np.asarray(loads.water, float) - by_drift, 0.0)
        return lambda speed: given
    radiated = _radiated(held)
    return lambda speed: np.maximum(loads.drag(speed) + radiated, 0.0)


def _radiated(held):
    """Damping by radiation of the slow motions, each at its natural frequency alone; shape (3N,)"""
    plane = _plane(held.inertia)
    natural = np.sqrt(np.diag(held.stiffness) / np.diag(held.inertia + held.held_added_mass(0.0)[0]))[plane]
    inside = np.clip(natural, *held.between.span)
    own = held.coefficients(inside)[1][np.arange(len(plane)), plane, plane]
    return own * np.minimum(1.0, natural / inside)


def _plane(matrix):
    """Numbers of surge, sway and yaw of each body, of a matrix (6N, 6N); shape (3N,)"""
    return [6 * i + k for i in range(len(matrix) // 6) for k in PLANE]


def _drift_damping(damping, bodies=1):
    """Wave drift damping (3N, 2), placed in the motions of N bodies; shape (6N, 6N); None for none"""
    full = np.zeros((6 * bodies, 6 * bodies))
    for i in range(0 if damping is None else bodies):
        full[np.ix_(np.add(PLANE, 6 * i), [6 * i, 6 * i + 1])] = damping[3 * i : 3 * i + 3]
    return full


def _places(held, modes, sea):
    """Frequencies close enough about each resonance, rad/s; shape (d,)

    Modes of several bodies that fenders hold, as fast as the waves, are not slow.
    """
    natural = 2 * np.pi / modes.period
    slow = natural < (SLOW * 2 * np.pi / sea.spectrum.T01 if held.bodies else np.inf)
    natural, ratio = natural[slow], modes.ratio[slow]
    high = max(differences(held)[-1], 3 * natural.max(initial=0.0))
    steps = np.sinh(np.linspace(0, np.arcsinh(100.0), ABOUT))
    about = [w * (1 + sign * max(nu, 1e-4) * steps) for w, nu in zip(natural, ratio, strict=True) for sign in (-1, 1)]
    omega = np.unique(np.concatenate([np.linspace(0, high, 121), *about]))
    return omega[(omega >= 0) & (omega <= high)]


def _forms_of(drift, modes, mass, damping, stiffness, free=None):
    """Eigenvalues of the quadratic forms of the slow motion; shape (3, n), of several bodies (3N, n)"""
    spectrum, wide, parts = drift.mean_parts()
    finest = np.nanmin(2 * np.pi / modes.period * modes.ratio) / 2
    even = np.linspace(wide[0], wide[-1], int(np.clip(np.ptp(wide) / finest, FEWEST_WAVES, MOST_WAVES)))
    parts = np.stack([np.interp(even, wide, column) for column in parts.reshape(len(wide), -1).T], axis=-1)
    step = even[1] - even[0]
    root = np.sqrt(2 * spectrum.density(even)[:, None] * step * parts).reshape(len(even), 2, -1)
    if len(mass) > 6:
        root = root * drift.main_phases(even)
    respond = _response(step * np.arange(len(even)), mass, damping, stiffness, free)
    return np.array([_eigenvalues(respond[:, mode], root) for mode in range(root.shape[2])])


def _eigenvalues(respond, root):
    """Eigenvalues of the form Σ_b Σ_± ±H_b(ω_i − ω_l) r_ib± r*_lb±; shape (n,); respond (n, 3) at differences, root (n,
    2, 3)"""
    n = len(root)
    apart = np.subtract.outer(np.arange(n), np.arange(n))
    H = np.where((apart >= 0)[..., None], respond[np.abs(apart)], respond[np.abs(apart)].conj())
    signed = np.einsum("s,isb,lsb->ilb", [1.0, -1.0], root, root.conj())
    return np.linalg.eigvalsh(np.sum(H * signed, axis=-1))


def _largest_of_forms(forms, gaussian, speed, seen, duration):
    """Expected largest distance from the mean, on the side where it is larger, of form and Gaussian together; shape
    (3,)

    gaussian : (3,) variance of what is; speed : (3,) variance of the velocity
    """
    forms = np.where(seen[:, None], forms, 0.0)
    return np.array([_expected_largest(*one, duration) for one in zip(forms, gaussian, speed, strict=True)])


def _expected_largest(values, gaussian, speed, duration):
    sigma = np.sqrt(np.sum(values**2) + gaussian)
    if not sigma > 0:
        return 0.0
    width = 2 * np.pi / (2 * REACH * sigma)  # step of the characteristic function
    t = width * np.arange(POINTS // 2 + 1)
    phi = np.exp(
        -0.5 * gaussian * t**2 - np.sum(1j * values * t[:, None] + np.log(1 - 1j * values * t[:, None]), axis=1)
    )
    density = np.fft.irfft(phi.conj(), POINTS) / (2 * REACH * sigma / POINTS)
    x = np.fft.fftfreq(POINTS, 1 / POINTS) * (2 * REACH * sigma / POINTS)
    often = duration * np.sqrt(speed / (2 * np.pi)) * density
    return max(np.abs(x[often > np.exp(-EULER)]).max(initial=0.0), SIGNIFICANT * sigma)


def _response(omega, mass, damping, stiffness, free=None):
    """Motions of surge, sway and yaw by forces along them; shape (d, 3, 3), of several bodies (d, 3N, 3N); the others
    follow

    free : (6N, m) motions that hinges leave free, None without hinges
    """
    w, plane = omega[:, None, None], _plane(mass)
    D = -(w**2) * mass - 1j * w * damping + stiffness
    moved = np.linalg.inv(D) if free is None else free @ np.linalg.inv(free.T @ D @ free) @ free.T
    return moved[:, plane][:, :, plane]


def _estimates(force, omega, modes):
    """Deviations by a flat spectrum, and by a force that beats at the natural period; shape (3, 2)"""
    own = np.array([np.interp(2 * np.pi / T, omega, force[:, i, i]) for i, T in enumerate(modes.period)])
    of_force = np.sqrt([np.trapezoid(force[:, i, i], omega) for i in range(len(modes.period))])
    flat = np.sqrt(np.pi * own / (2 * modes.damping * modes.stiffness))
    return np.stack([flat, of_force / modes.stiffness / (2 * modes.ratio)], axis=1)


def _crossing(m0, m2):
    return np.where(m2 > 0, 2 * np.pi * np.sqrt(m0 / np.where(m2 > 0, m2, 1.0)), np.inf)


def _largest(sigma, period, duration):
    """Expected largest values; shape (3,); of a motion with fewer than three periods in `duration`, its significant
    amplitude"""
    enough = duration / period > np.e
    period = np.where(enough, period, duration / 10)
    return np.where(enough, expected_maximum(sigma, duration, period), SIGNIFICANT * sigma)


def _rule(slow, slow_period, fast, fast_period, duration):
    largest = _largest(slow, slow_period, duration), _largest(fast, fast_period, duration)
    return np.maximum(SIGNIFICANT * slow + largest[1], largest[0] + SIGNIFICANT * fast)


def _flags(modes, sea, names=("surge", "sway", "yaw")):
    """Messages on natural periods near a wave period, and on lightly damped ones"""
    for system in getattr(sea, "systems", (sea,)):
        peak = system.spectrum.Tp
        near = [f"{n} {T:.4g} s" for n, T in zip(names, modes.period, strict=True) if peak / NEAR < T < peak * NEAR]
        if near:
            yield (
                f"natural period of {', '.join(near)} is within a factor of {NEAR:g} of the peak period of the waves, "
                f"{peak:.4g} s; change the stiffness of the lines"
            )
    light = [f"{n} {100 * v:.3g} %" for n, v in zip(names, modes.ratio, strict=True) if v < 0.02]
    if light:
        yield (
            f"slow motion is lightly damped: {', '.join(light)} of critical; give the drag of lines and hull as "
            "body.damping_ratio"
        )
