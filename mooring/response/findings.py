"""What a reader of a response has to know: energy beyond the stored waves, and what lies between them."""

from __future__ import annotations

import numpy as np

from bem.waves import wavenumber

from . import drift as drifts
from .headings import is_between
from .linear import frequencies, moments, motions, over_headings, response_spectrum
from .seas import directions, energy_outside

MISSED = 0.01  # share of the energy beyond the stored frequencies that is named
UNSETTLED = 0.1  # change of a result when every second stored frequency is left out
TURNED = 0.02  # error of a spline over the headings
FEWEST = 5  # frequencies of which some can be left out


def waves_outside(body, spectrum):
    """Energy of the waves below and above the stored frequencies"""
    for share, words, end in zip(energy_outside(body, spectrum), ("longer", "shorter"), (0, -1), strict=True):
        if share > MISSED:
            yield (
                f"{100 * share:.1f} % of the wave energy is in waves {words} than the stored "
                f"{2 * np.pi / body.omega[end]:.3g} s; limit {100 * MISSED:g} %; add periods to the scene, solve again"
            )


def responses_outside(body, spectrum, transfer, weights, m0):
    """What those waves would add to responses with m0 (c,), transfer functions held at their ends"""
    ends = over_headings(np.abs(transfer.value[[0, -1]]) ** 2, weights if weights.ndim == 1 else weights[[0, -1]])
    missed = np.array(energy_outside(body, spectrum)) @ ends * spectrum.moment(0)
    share = np.where(m0 > 0, missed / np.maximum(m0 + missed, 1e-300), 0.0)
    named = [f"{transfer.names[i]} {100 * share[i]:.1f} %" for i in np.argsort(-share) if share[i] > MISSED]
    if named:
        yield f"responses lack energy beyond the stored frequencies: {_some(named)}; limit {100 * MISSED:g} %"


def between_headings(body, sea):
    """Error of forces in long-crested waves between stored headings, that of a cubic spline through exp(ikR cos β)"""
    stored, _ = body.forces(body.omega[:1])
    if sea.spreading is not None or not is_between(stored, sea.direction)[0]:
        return
    offset = np.mod(stored - sea.direction, 2 * np.pi)
    gap = offset.min() + (2 * np.pi - offset).min()
    k = float(wavenumber(2 * np.pi / sea.spectrum.T01, body.depth, body.gravity))
    error = (k * body.radius * gap) ** 4 / 384
    if error > TURNED:
        yield (
            f"wave direction {np.rad2deg(sea.direction) % 360:.4g}° lies in a gap of {np.rad2deg(gap):.3g}° between "
            f"stored headings: forces may be {100 * error:.0f} % off, limit {100 * TURNED:g} %; add it to the scene"
        )


def between_frequencies(body, sea, m0, drift):
    """How much the six motions, of m0 (6,), and the mean drift (3,) or None change with the step in frequency"""
    if len(body.omega) < FEWEST:
        yield f"the database has {len(body.omega)} frequencies: too few to tell the error between them"
        return
    coarse = body.thinned()
    omega = frequencies(coarse, sea.spectrum.density)
    heading, weights = directions(sea, omega)
    density = sea.spectrum.density(omega)
    other = moments(omega, response_spectrum(motions(coarse, omega, heading), density, weights)).m0
    change = np.where(m0 > 0, np.abs(np.sqrt(other / np.where(m0 > 0, m0, 1.0)) - 1), 0.0)
    words = ("surge", "sway", "heave", "roll", "pitch", "yaw")
    named = [f"{words[i]} {100 * change[i]:.0f} %" for i in np.argsort(-change) if change[i] > UNSETTLED]
    if drift is not None:
        mean = drifts.mean_in_sea(omega, drifts.drift(coarse, omega, heading), density, weights)
        moved = np.abs(mean - drift)[:2].max() / max(np.abs(drift[:2]).max(), 1e-300)
        named += [f"mean drift {100 * moved:.0f} %"] if moved > UNSETTLED else []
    if named:
        advice = "" if drift is None or drifts.can_rebuild(body) else " and Kochin functions (--only kochin,drift)"
        yield (
            f"results change when every second stored frequency is left out: {', '.join(named)}; limit "
            f"{100 * UNSETTLED:g} %; add frequencies{advice} to the database"
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
