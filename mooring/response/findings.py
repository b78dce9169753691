"""Findings on a response: energy beyond the stored waves, and errors between stored waves."""

from typing import NamedTuple

import numpy as np

from hakobune.bem.drift import sum_about_origin
from hakobune.bem.modes import words_of
from hakobune.bem.waves import group_factor, wavenumber

from .drift import TURN
from .linear import over_headings
from .seas import directions, energy_outside

LINES_NAMED = 12  # names listed in one warning; beyond that only their number
MISSED = 0.01  # share of the energy beyond the stored frequencies that is reported
GROWS = 0.5  # the drift per energy grows beyond the stored band, so that half of the limit is aimed at
WAVES_MISSED = 0.05  # share of the far field that sources in the hull do not reproduce
UNSURE = 0.05  # estimated error of a result between stored waves above which a warning is given
LEVER = 0.05  # shortest lever arm of a drift moment that is considered, over the radius of the hull
LARGEST_ROTATION = 15.0  # degrees; there sines leave angles, and restoring its line, by a few per cent
OF_MOTION, OF_MOMENT = 4.0, 1.5  # factors on deviations with which the stated errors cover 95 % of seas
# accepted difference of the sum over bodies and the far-field drift, over the largest drift of a body
EACH = 0.1
ACROSS = 0.02  # current across the waves, over the current, above which its omission is reported
PLACES = 48  # number of frequencies for the estimate


def waves_outside(body, spectrum):
    """Energy of the waves below and above the stored frequencies"""
    for share, words, end in zip(energy_outside(body.omega, spectrum), ("longer", "shorter"), (0, -1), strict=True):
        if share > MISSED:
            yield (
                f"{100 * share:.1f} % of the wave energy is in waves {words} than the stored "
                f"{2 * np.pi / body.omega[end]:.3g} s; limit {100 * MISSED:g} %; "
                f"{_solve_to(spectrum, end, MISSED / 2)}"
            )


def _solve_to(spectrum, end, share):
    """Words on the frequency beyond which no more than a share of the energy lies; end : 0 for long waves, or -1"""
    omega = float(spectrum.quantile(share if end == 0 else 1 - share))
    return f"solve {'from' if end == 0 else 'to'} {omega:.3g} rad/s ({2 * np.pi / omega:.3g} s) too"


def missed_response(body, spectrum, transfer, weights):
    """Variance m₀ of responses to the waves beyond the stored frequencies; transfer functions there equal the last
    stored ones; shape (c,)"""
    ends = over_headings(np.abs(transfer.value[[0, -1]]) ** 2, weights if weights.ndim == 1 else weights[[0, -1]])
    return np.array(energy_outside(body.omega, spectrum)) @ ends * spectrum.moment(0)


def responses_outside(body, spectrum, transfer, weights, m0):
    """Contribution of the waves outside the stored frequencies to responses with m0 (c,)"""
    missed = missed_response(body, spectrum, transfer, weights)
    said = named_shares(transfer.names, np.where(m0 > 0, missed / np.maximum(m0 + missed, 1e-300), 0.0))
    if said:
        yield f"responses do not include energy beyond the stored frequencies: {said}; limit {100 * MISSED:g} %"


def waves_missed(transfer):
    """Share of scattered and radiated waves missing in the waves at points"""
    if transfer.missed is not None and transfer.missed > WAVES_MISSED:
        yield (
            f"the representation of scattered and radiated waves misses up to {100 * transfer.missed:.1f} % of "
            f"the far field; limit {100 * WAVES_MISSED:g} %: the elevation at points is approximate"
        )


def named_shares(names, share):
    """Words on the responses whose share (c,) exceeds MISSED, the largest first; empty if there are none"""
    return some([f"{names[i]} {100 * share[i]:.1f} %" for i in np.argsort(-share) if share[i] > MISSED])


class Errors(NamedTuple):
    """Relative estimated errors of results between stored waves

    motions : (n,) relative errors of standard deviations; drift : (2,) relative errors of the mean drift force and
    moment; damping : relative error of wave drift damping.
    Errors of drift are None without drift. The moment counts as at least LEVER times the radius times the force. words
    : (n,) names of the motions
    at : rad/s of the largest error of motions, drift and damping; gap : rad, between the headings around the waves
    """

    motions: np.ndarray
    drift: np.ndarray | None
    damping: float | None
    words: tuple[str, ...] = words_of(())
    at: tuple[float, ...] = ()
    gap: float = 0.0

    def named(self, limit):
        """Words such as "roll 2 %", for errors above `limit`"""
        words = dict(zip(self.words, self.motions, strict=True))
        if self.drift is not None:
            words |= {"mean drift": self.drift[0], "moment of drift": self.drift[1]}
        if self.damping is not None:
            words["wave drift damping"] = self.damping
        return [f"{word} {100 * error:.3g} %" for word, error in words.items() if error > limit]


def errors_between(body, sea, omega, m0, drift, damping):
    """`Errors` from m0 of the motions (n,), mean drift (3,) and wave drift damping (3, 2); drift and damping may be
    None.

    The estimated errors of `Reader.at` are added as if all had one sign. The error of σ is four times ∫|X|δX S dω over
    ∫|X|² S dω. The error of the mean force is 2∫ δD S dω, and the error of its moment is one and a half times as much.
    With factors of three and one, six and seven of a hundred seas on headings 30° apart have larger errors than stated,
    mostly long crests close to an axis of the hull.

    Over a gap γ between headings δD oscillates once. Its slope is δD 2π/γ, and wave drift damping has the error (2 +
    2π/γ) δD
    / C_g.  A round body needs no interpolation between headings: there is no gap, and no slope.
    """
    places = omega[np.unique(np.linspace(0, len(omega) - 1, PLACES).astype(int))]
    heading, weights = directions(sea, places)
    density = sea.spectrum.density(places)[:, None]
    X, wrong = body.at(places, "rao", heading)
    both = [
        np.trapezoid(over_headings(np.abs(X) * part, weights) * density, places, axis=0) for part in (wrong, np.abs(X))
    ]
    motions = np.where(m0 > 0, OF_MOTION * both[0] / np.maximum(both[1], 1e-300), 0.0)
    at = [float(places[(over_headings(wrong, weights) * density)[:, motions.argmax()].argmax()])]
    if drift is None:
        return Errors(motions, None, None, body.words, tuple(at))
    ring = body.ring_of("drift_force")
    gap = np.max(ring.gap(np.add.outer((-TURN, TURN), heading).ravel()))
    aside = heading + np.array([0.0, -gap / 4, gap / 4]) if damping is not None and len(heading) == 1 else heading
    wrong = body.at(places, "drift_force", aside)[1]
    each = over_headings(wrong[:, : len(heading)], weights) * density
    first = 2 * np.trapezoid(each, places, axis=0)
    at.append(float(places[each[:, :2].max(axis=1).argmax()]))
    force = max(np.abs(drift[:2]).max(), 1e-300)
    scale = np.array([force, max(abs(drift[2]), LEVER * body.radius * force)])
    errors = np.array([first[:2].max(), OF_MOMENT * first[2]]) / scale
    if damping is None:
        return Errors(motions, errors, None, body.words, tuple(at), gap)
    widest = wrong.max(axis=1) if len(heading) == 1 else over_headings(wrong, weights)
    k = wavenumber(places, body.depth, body.gravity)
    slow, swing = 1 / (group_factor(k, body.depth) * places / k), 2 * np.pi / gap if gap else 0.0
    turned = 2 * np.trapezoid((2 + swing) * widest[:, :2] * (slow * density[:, 0])[:, None], places, axis=0)
    share = float(turned.max() / max(np.abs(damping[:2]).max(), 1e-300))
    at.append(float(places[(widest[:, :2].max(axis=1) * slow * density[:, 0]).argmax()]))
    return Errors(motions, errors, share, body.words, tuple(at), gap)


def between_waves(body, errors):
    """Warnings on the `Errors` that are large enough to matter"""
    named = errors.named(UNSURE)
    if named:
        advice = "" if errors.drift is None or body.rebuilds_drift else ", or Kochin functions (--only kochin,drift)"
        worst = [part.max() if np.ndim(part) else part for part in errors[:3] if part is not None]
        near = f" near {errors.at[int(np.argmax(worst))]:.3g} rad/s" if errors.at else ""
        apart = f", headings closer than {np.degrees(errors.gap):.3g}°" if errors.gap else ", headings"
        yield (
            f"results are uncertain between stored waves: {', '.join(named)}; limit {100 * UNSURE:g} %; "
            f"add frequencies{near}{apart}{advice} to the database"
        )


def drift_outside(body, spectrum, inside, beyond):
    """Part of the mean drift from waves beyond the stored band, with the drift coefficient at the end of the band"""
    total = np.abs(inside) + np.abs(beyond).sum(axis=0)
    share = np.abs(beyond).sum(axis=0)[:2].max() / max(total[:2].max(), 1e-300)
    if share > MISSED:
        end = -int(np.argmax(np.abs(beyond)[:, :2].max(axis=1)))  # 0 or −1, the end with the larger part
        yield (
            f"{100 * share:.1f} % of the mean drift force is due to waves beyond the stored frequencies, for which "
            f"the drift at {body.omega[end]:.3g} rad/s is used; limit {100 * MISSED:g} %; "
            f"{_solve_to(spectrum, end, energy_outside(body.omega, spectrum)[end] * GROWS * MISSED / share)}"
        )


def drift_of_each(body, slow):
    """Difference in `SlowForces` between the sum of the drift of several bodies and the drift of all together by the
    far field"""
    if slow.of_each is None:
        if body.bodies:
            yield "drift of each body is left out: the database has none, or the waves travel on a current"
        return
    if not body.own:
        yield (
            "the drift of each body is the stored drift of free motions; damping, stiffness and hinges of this study "
            "change the motions and therefore the true drift"
        )
        return
    away = np.abs(sum_about_origin(slow.of_each, body.bodies) - slow.drift)[:2].max()
    largest = np.abs(slow.of_each[:, :2]).max()
    if away > EACH * largest:
        yield (
            f"the sum of the drift forces on the bodies differs from the far-field drift by "
            f"{100 * away / max(largest, 1e-300):.3g} % of the largest; limit {100 * EACH:g} %; add frequencies or "
            f"panels to the scene"
        )


def current_along_waves(carrier, heading, weights, damping):
    """A line on a current across the waves, whose effect on drift is unknown if the slope of drift over the headings is
    unknown"""
    if carrier is None or damping is not None:
        return  # `damping` is of the slope over the headings
    share = np.mean(np.atleast_2d(weights), axis=0)
    across = float(share @ np.abs(carrier.velocity[1] * np.cos(heading) - carrier.velocity[0] * np.sin(heading)))
    if across > ACROSS * np.hypot(*carrier.velocity):
        yield (
            f"the current has a component of {across:.2g} m/s across the waves; its effect on the drift is not "
            f"included, since the database lacks headings on both sides of {np.rad2deg(heading[0]):.4g}°; add these "
            "headings to the scene"
        )


def some(named, most=6):
    """`named` as a list in words: at most `most` names, then only the number of further names"""
    rest = f" and {len(named) - most} more" if len(named) > most else ""
    return ", ".join(named[:most]) + rest


def large_rotations(degrees):
    """Lines on rotations for which motions are no longer small.  degrees : {name: amplitude}"""
    named = [f"{name.lower()} {value:.3g}°" for name, value in degrees.items() if value > LARGEST_ROTATION]
    if named:
        yield (
            f"the motion has an amplitude of {', '.join(named)}; linear theory is valid up to about "
            f"{LARGEST_ROTATION:g}°, so this motion is not realistic; give viscous damping ([viscous] of the scene; "
            "simulate also takes simulation.damping_ratio), or use lower waves"
        )
