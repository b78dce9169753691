"""What a reader of a response has to know: energy beyond the stored waves, and what lies between them."""

from __future__ import annotations

import numpy as np

from bem import DOFS

from .linear import over_headings
from .seas import directions, energy_outside

MISSED = 0.01  # share of the energy beyond the stored frequencies that is named
UNSURE = 0.05  # estimated error of a result between stored waves that is named
LEVER = 0.05  # of the radius of the hull: a moment of the drift force on a shorter arm is none
LARGEST_ROTATION = 15.0  # degrees; there sines leave angles, and restoring its line, by a few per cent
PLACES = 48  # frequencies at which it is estimated


def waves_outside(body, spectrum):
    """Energy of the waves below and above the stored frequencies"""
    for share, words, end in zip(energy_outside(body.omega, spectrum), ("longer", "shorter"), (0, -1), strict=True):
        if share > MISSED:
            yield (
                f"{100 * share:.1f} % of the wave energy is in waves {words} than the stored "
                f"{2 * np.pi / body.omega[end]:.3g} s; limit {100 * MISSED:g} %; add periods to the scene, solve again"
            )


def responses_outside(body, spectrum, transfer, weights, m0):
    """What those waves would add to responses with m0 (c,), transfer functions held at their ends"""
    ends = over_headings(np.abs(transfer.value[[0, -1]]) ** 2, weights if weights.ndim == 1 else weights[[0, -1]])
    missed = np.array(energy_outside(body.omega, spectrum)) @ ends * spectrum.moment(0)
    share = np.where(m0 > 0, missed / np.maximum(m0 + missed, 1e-300), 0.0)
    named = [f"{transfer.names[i]} {100 * share[i]:.1f} %" for i in np.argsort(-share) if share[i] > MISSED]
    if named:
        yield f"responses lack energy beyond the stored frequencies: {_some(named)}; limit {100 * MISSED:g} %"


def between_waves(body, sea, omega, m0, drift):
    """How uncertain the six motions, of m0 (6,), and the mean drift (3,) or None are between stored waves.

    The estimated errors of `Reader.at`, as if all of one sign: ∫|X|δX S dω of ∫|X|² S dω, and 2∫ δD S dω
    """
    places = omega[np.unique(np.linspace(0, len(omega) - 1, PLACES).astype(int))]
    heading, weights = directions(sea, places)
    density = sea.spectrum.density(places)[:, None]
    X, wrong = body.at(places, "rao", heading)
    both = [
        np.trapezoid(over_headings(np.abs(X) * part, weights) * density, places, axis=0) for part in (wrong, np.abs(X))
    ]
    share = np.where(m0 > 0, both[0] / np.maximum(both[1], 1e-300), 0.0)
    words = [name.lower() for name in DOFS]
    named = [f"{words[i]} {100 * share[i]:.0f} %" for i in np.argsort(-share) if share[i] > UNSURE]
    if drift is not None:
        wrong = over_headings(body.at(places, "drift_force", heading)[1], weights)
        wrong, force = 2 * np.trapezoid(wrong * density, places, axis=0), max(np.abs(drift[:2]).max(), 1e-300)
        for word, error, scale in (
            ("mean drift", wrong[:2].max(), force),
            ("moment of drift", wrong[2], max(abs(drift[2]), LEVER * body.radius * force)),
        ):
            named += [f"{word} {100 * error / scale:.0f} %"] if error > UNSURE * scale else []
    if named:
        advice = "" if drift is None or body.rebuilds_drift else " or Kochin functions (--only kochin,drift)"
        yield (
            f"results are uncertain between stored waves: {', '.join(named)}; limit {100 * UNSURE:g} %; "
            f"add frequencies, headings{advice} to the database"
        )


def drift_outside(body, inside, beyond):
    """Part of the mean drift that is from waves beyond the stored band"""
    total = np.abs(inside) + np.abs(beyond).sum(axis=0)
    share = np.abs(beyond).sum(axis=0)[:2].max() / max(total[:2].max(), 1e-300)
    if share > MISSED:
        yield (
            f"{100 * share:.1f} % of the mean drift force is from waves beyond the stored frequencies, with drift held "
            f"at its value at {body.omega[-1]:.3g} rad/s; add frequencies to the scene and solve again"
        )


def _some(named, most=6):
    rest = f" and {len(named) - most} more" if len(named) > most else ""
    return ", ".join(named[:most]) + rest


def large_rotations(degrees):
    """Lines on rotations for which motions are no longer small.  degrees : {name: amplitude}"""
    named = [f"{name.lower()} {value:.3g}°" for name, value in degrees.items() if value > LARGEST_ROTATION]
    if named:
        yield (
            f"{', '.join(named)} of amplitude, linear theory ends at about {LARGEST_ROTATION:g}°: this is no motion to "
            "expect; give viscous damping, or take lower waves"
        )
