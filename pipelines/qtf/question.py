"""A request for forces of wave pairs: which waves, largest difference, body and parts."""

import math
from dataclasses import dataclass, replace

import numpy as np

from hakobune.bem.second_order.kinds import DIFFERENCE, Kind
from hakobune.bem.second_order.stored import Held

from ..scene.scene import numbers

FREQUENCIES = 41, 48  # default numbers of frequencies over the stored band
SHARE = 0.4  # default largest difference over the mean frequency of the band
EVEN = 1e-6  # largest deviation of a frequency step, over the step
SAME = 1e-9  # rad/s, rad: tolerance for equal frequencies and headings
ENOUGH = 0.05  # largest part of the force that the level "auto" neglects
A_WAVE = 3.0  # panels along the wave of a sum, which is up to four times as short as those of the pair
MOST_WAVES = 1500  # frequencies times headings: their flow on a hull of a thousand panels takes 2 GB


@dataclass(frozen=True, eq=False)
class Question:
    """omega : (n,) rad/s at even steps; headings : (m,) rad; highest : rad/s, largest difference or sum; held : `Held`

    level : body, full or auto; method : panel, contour or auto
    waves_given : whether the user chose the waves; by default the database does
    """

    omega: np.ndarray
    headings: np.ndarray
    highest: float
    held: Held
    level: str
    method: str
    waves_given: bool
    kind: Kind = DIFFERENCE

    @property
    def waves(self):
        """The waves as arguments of `quadratic_forces`"""
        return self.omega, self.headings, self.highest

    def continued(self, stored):
        """The question of an interrupted run's `StoredForces`, if it matches the present question"""
        if stored.asked is None or self.waves_given or stored.held.floats != self.held.floats:
            return self
        forces = stored.forces
        return replace(
            self,
            omega=forces.omega,
            headings=forces.headings,
            highest=stored.asked,
            held=self.held if self.held.name else stored.held,
            level=self.level if forces.surface is None else "full",
            method=stored.method if self.method == "auto" else self.method,
        )

    def answered_by(self, stored):
        """Whether `StoredForces` contain all that the question asks for"""
        forces = stored.forces
        lacks = (
            stored.asked is not None
            or (forces.surface is None and self.adds_surface(stored.share))
            or (self.held.name and stored.held.name != self.held.name)
            or self.method not in ("auto", stored.method)
        )
        if lacks or not (self.waves_given or stored.held.floats != self.held.floats):
            return not lacks
        step, (low, high) = forces.omega[1] - forces.omega[0], forces.omega[[0, -1]]
        return bool(
            stored.held.floats == self.held.floats
            and low <= self.omega[0] + SAME
            and high >= self.omega[-1] - SAME
            and step <= (self.omega[1] - self.omega[0]) * (1 + SAME)
            and forces.frequency[-1] > self.highest - step
            and all(np.abs(np.exp(1j * forces.headings) - np.exp(1j * h)).min() < SAME for h in self.headings)
        )

    def adds_surface(self, share):
        """Whether the question includes the forcing of the surface; share : share of this forcing in the force, or
        unknown"""
        return self.level == "full" or (self.level == "auto" and share is not None and share > ENOUGH)


def waves_and_sums_of(db, omega, heading, highest):
    """Like `waves_of` with the largest sum, by default the highest that panels and depth resolve"""
    frequencies, headings, _ = waves_of(db, omega, heading, None)
    lowest, all_of_them = 2 * frequencies[0], 2 * frequencies[-1]
    if highest is None:
        highest = max(min(all_of_them, carried_by(db.mesh, db.water_depth, db.gravity)), lowest)
    elif not lowest <= highest < math.inf:
        raise ValueError(f"--highest is {highest:g}; allowed: {lowest:.4g} rad/s (twice the lowest frequency) or more")
    return frequencies, headings, float(min(highest, all_of_them))


def carried_by(mesh, depth, gravity):
    """Frequency, rad/s, of the wave as long as `A_WAVE` of the largest panels"""
    k = 2 * math.pi / (A_WAVE * float(mesh.sizes.max()))
    return math.sqrt(gravity * k * math.tanh(min(k * depth, 50.0)))


def waves_of(db, omega, heading, difference):
    """Requested frequencies (n,) rad/s, headings (m,) rad and largest difference.  Raises ValueError.

    omega : (n,) rad/s, heading : (m,) rad, difference : rad/s; None for what the database suggests
    """
    if len(db.omega) < 2:
        raise ValueError(f"{db.path} has {len(db.omega)} solved frequencies; allowed: two or more")
    low, high = float(db.omega[0]), float(db.omega[-1])
    frequencies = multiples(low, high) if omega is None else _frequencies(omega, low, high)
    headings = db.wave_direction if heading is None else _headings(heading)
    if difference is not None and not 0 < difference < math.inf:
        raise ValueError(f"--difference is {difference:g}; allowed: above 0, finite, rad/s")
    step = frequencies[1] - frequencies[0]
    if difference is not None and difference < step * (1 - EVEN):
        raise ValueError(
            f"--difference is {difference:g}; allowed: {step:.4g} rad/s (the frequency step) or more; or give "
            "more frequencies with --omega"
        )
    if len(frequencies) * len(headings) > MOST_WAVES:
        raise ValueError(
            f"{len(frequencies)} frequencies and {len(headings)} headings are requested; allowed: {MOST_WAVES} waves "
            "in total; choose fewer with --omega and --heading"
        )
    widest = float(np.ptp(frequencies))
    return frequencies, np.unique(headings), min(difference or SHARE * float(frequencies.mean()), widest)


def listed(flag, text):
    """Numbers of a text, `a,b,c` or `start:stop:count`; shape (n,).  Raises ValueError."""
    found = numbers(flag, text)
    return np.linspace(found["from"], found["to"], found["count"]) if isinstance(found, dict) else np.array(found)


def _frequencies(omega, low, high):
    given = np.asarray(omega, float)
    if len(given) < 2 or not np.all(np.diff(given) > 0) or np.ptp(np.diff(given)) > EVEN * np.diff(given).mean():
        raise ValueError(
            f"--omega is {_said(given)}; allowed: two or more increasing frequencies at equal steps, rad/s"
        )
    if not (np.all(np.isfinite(given)) and given.min() >= low * (1 - 1e-9) and given.max() <= high * (1 + 1e-9)):
        raise ValueError(
            f"--omega is {_said(given)}; allowed: within the stored {low:.4g} to {high:.4g} rad/s; "
            "solve the scene over that band as well"
        )
    return given


def _headings(given):
    headings = np.asarray(given, float)
    if not len(headings) or not np.all(np.isfinite(headings)):
        raise ValueError(f"--heading is {_said(np.degrees(headings))}; allowed: one or more finite angles, degrees")
    turned = np.exp(1j * headings)  # headings that differ by full circles count once
    return headings[[np.abs(turned[:n] - turned[n]).min(initial=1.0) > SAME for n in range(len(headings))]]


def _said(values):
    return ", ".join(f"{value:g}" for value in values) or "of none"


def multiples(low, high):
    """Multiples of a step from closest to `low` up to `high`, rad/s; shape (n,).

    Differences are multiples too, so a frequency that is also a difference is solved only once.
    """

    def first_of(steps):
        return int(np.ceil(low / high * steps * (1 - 1e-12)))

    least, most = (int(count / (1 - low / high)) for count in FREQUENCIES)
    fitting = [steps for steps in range(least, most + 1) if FREQUENCIES[0] <= steps - first_of(steps) + 1]
    steps = min(fitting, key=lambda steps: (round(first_of(steps) / steps - low / high, 9), steps))
    return high / steps * np.arange(first_of(steps), steps + 1)
