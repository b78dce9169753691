"""Waves on a uniform current, observed from a fixed place.

    ω = σ + k·V,    σ² = gk tanh kh,    C_g + V·k/k > 0

V is the current. σ is the intrinsic frequency, in the moving water; ω is the absolute frequency, at which a buoy or a
moored body at rest meets the waves.
The wave length depends on σ.  Wave models (SWAN, WAVEWATCH III) give spectra over σ, "intrinsic"; a moored buoy or a
record at a place gives them over ω, "absolute". "still" neglects the current. The direction of a wave is that of k,
at right angles to its crests; its energy travels with C_g + V. Waves whose energy would come from downstream of the
body do not exist, because the current blocks them.
"""

from typing import NamedTuple

import numpy as np

from hakobune.bem.waves import group_factor, wavenumber

SPECTRA = ("intrinsic", "absolute", "still")
FIRST_ORDER = 0.25  # |V|/C_g; in deep water ωV/g = 1/8, half of where waves upstream end
BLOCKED = 1e-3, 0.05  # shares of the energy: reported above the first, refused above the second
MOST = 0.1  # share of the energy beyond FIRST_ORDER that is not reported
FINE = 4001  # number of frequencies between which the absolute one is inverted, before Newton's steps


class Carrier(NamedTuple):
    """A current that carries waves.

    velocity : (x, y) m/s; absolute : whether wave frequencies are given for a fixed place; otherwise in the moving
        water
    """

    velocity: tuple[float, float]
    absolute: bool = False

    def along(self, heading):
        """Component of the current along waves towards `heading` rad, m/s"""
        return self.velocity[0] * np.cos(heading) + self.velocity[1] * np.sin(heading)

    def met(self, omega, heading, depth, gravity):
        """Absolute frequency, rad/s, of waves of the given frequency towards `heading`; arrays broadcast"""
        omega, heading = np.broadcast_arrays(np.asarray(omega, float), heading)
        return omega if self.absolute else absolute_frequency(omega, self.along(heading), depth, gravity)

    def own(self, omega, heading, depth, gravity):
        """Intrinsic frequency, rad/s, of waves of the given frequency towards `heading`; arrays broadcast"""
        omega, heading = np.broadcast_arrays(np.asarray(omega, float), heading)
        return intrinsic_frequency(omega, self.along(heading), depth, gravity) if self.absolute else omega


def carrier_of(current):
    """`Carrier` of a `mooring.studies.conditions.Current`; None without current, at speed 0 and for "still" waves"""
    if current is None or current.waves == "still" or current.speed == 0:
        return None
    towards = current.direction
    velocity = float(current.speed * np.cos(towards)), float(current.speed * np.sin(towards))
    return Carrier(velocity, current.waves == "absolute")


def in_water(components, carrier, depth, gravity):
    """Wave components (`environment.sea.Components`) with intrinsic frequencies in place of the given frequencies"""
    if carrier is None or not carrier.absolute:
        return components
    return components._replace(omega=carrier.own(components.omega, components.direction, depth, gravity))


def met_by_a_place(components, carrier, depth, gravity):
    """Frequencies at which a fixed place meets wave components of intrinsic frequencies, rad/s; shape (c,)"""
    if carrier is None:
        return np.asarray(components.omega, float)
    return absolute_frequency(components.omega, carrier.along(components.direction), depth, gravity)


def group_speed(omega, depth, gravity):
    """C_g, m/s, of intrinsic frequencies, rad/s"""
    k = wavenumber(omega, depth, gravity)
    return group_factor(k, depth) * np.asarray(omega, float) / k


def absolute_frequency(omega, along, depth, gravity):
    """ω = σ + kV of intrinsic frequencies, rad/s, and currents along the waves, m/s"""
    return np.asarray(omega, float) + wavenumber(omega, depth, gravity) * along


def intrinsic_frequency(omega, along, depth, gravity):
    """σ of absolute frequencies, rad/s, and currents along the waves, m/s, arrays of one shape

    For waves blocked by the current, σ of the shortest wave that is not blocked.
    """
    omega, along = np.broadcast_arrays(np.atleast_1d(np.asarray(omega, float)), along)
    out = np.empty(omega.shape)
    for speed in np.unique(along):
        one = along == speed
        grid = np.linspace(0.0, 1.0, FINE)[1:] * 4 * omega[one].max()
        there = absolute_frequency(grid, speed, depth, gravity)
        passes = slice(0, int(np.argmax(there)) + 1)
        found = np.interp(omega[one], np.r_[0.0, there[passes]], np.r_[0.0, grid[passes]])
        for _ in range(3):
            slope = 1 + speed / group_speed(np.maximum(found, 1e-12), depth, gravity)
            step = (omega[one] - absolute_frequency(found, speed, depth, gravity)) / np.maximum(slope, 0.05)
            found = np.where((slope > 0.05) & (found > 0), found + step, found)
        out[one] = found
    return out


def check_blocked(carrier, sea, depth, gravity):
    """Messages on waves of a sea that the current blocks, and on waves for which the first-order effect of the
    current is not enough.

    sea : `environment.sea.Sea` or `seas.systems.Systems`, or a regular wave (`studies.conditions.Waves`)
    raises : ValueError where the current blocks more than a twentieth of the energy
    """
    if carrier is None:
        return
    speed = float(np.hypot(*carrier.velocity))
    blocked, steep, slowest = _shares(carrier, sea, depth, gravity, speed)
    if blocked > BLOCKED[1]:
        raise ValueError(
            f"the current of {speed:.3g} m/s blocks {100 * blocked:.3g} % of the wave energy, which cannot travel "
            f'against it; allowed: {100 * BLOCKED[1]:g} %; give longer waves, or current.waves = "still"'
        )
    if blocked > BLOCKED[0]:
        yield (
            f"the current of {speed:.3g} m/s blocks {100 * blocked:.3g} % of the wave energy, which cannot travel "
            "against it; the program includes the blocked waves as if they reached the body; give the spectrum at "
            'the body, or current.waves = "still"'
        )
    if steep > MOST:
        yield (
            "the change of the drift by the current is computed to first order in V/C_g, current over group "
            f"velocity, which is valid up to {FIRST_ORDER:g}; V/C_g is {slowest:.2g} at the mean frequency, and "
            f"above the limit for {100 * steep:.3g} % of the wave energy; treat drift on the current as "
            'approximate, or compare with current.waves = "still"'
        )


def _shares(carrier, sea, depth, gravity, speed):
    """Share of the energy blocked by the current and share beyond FIRST_ORDER, and |V|/C_g at the mean frequency"""
    if hasattr(sea, "period"):
        quantiles, headings = np.array([sea.omega]), np.array([sea.direction])
        places = [(quantiles, float(headings[0]), 1.0)]
    else:
        systems = getattr(sea, "systems", (sea,))
        total = sum(one.spectrum.moment(0) for one in systems)
        places = [
            (one.spectrum.quantile((np.arange(1000) + 0.5) / 1000), one.direction, one.spectrum.moment(0) / total)
            for one in systems
        ]
    blocked = steep = mean = 0.0
    for omega, towards, share in places:
        own = carrier.own(omega, towards, depth, gravity)
        passing = group_speed(own, depth, gravity)
        against = passing + carrier.along(towards)
        gone = against <= 1e-3 * speed if not carrier.absolute else carrier.met(omega, towards, depth, gravity) > (
            absolute_frequency(own, carrier.along(towards), depth, gravity) * (1 + 1e-6)
        )  # fmt: skip
        blocked += share * float(np.mean(gone))
        steep += share * float(np.mean(speed > FIRST_ORDER * passing))
        mean += share * speed / float(group_speed(own.mean(), depth, gravity))
    return blocked, steep, mean
