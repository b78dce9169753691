"""Resonances of a body in words: period, mode, peak, damping ratio, and the causes of uncertainty of the peak."""

import numpy as np

from ..printing.number import significant

BROAD = 0.1  # damping ratio above which the largest motion lies away from the natural period
VISCOUS = 0.1  # ratio of wave damping; below it viscous damping, 1 to 3 % of critical, lowers a peak by up to a third
UNSURE = 0.05  # estimated error of a peak above which it is reported
SEEN = 0.8  # fraction of a peak that stored frequencies should show


def resonance_lines(found, omega=None, rao=None):
    """A line for each of `found`, of `bem.database.resonances`.

    omega, rao : stored frequencies, (n,) rad/s, and motions, (n, m, 6); None for motions of a different body
    """
    return [f"{_peak(one)}{_stored(one, omega, rao)}{_uncertain(one)}" for one in found]


def underdamped(one):
    """Whether viscous damping is missing that would lower a peak of heave, roll or pitch by a third or more"""
    return not one.viscous and one.mode % 6 in (2, 3, 4) and one.damping < VISCOUS


def _peak(one):
    factor, unit = (180 / np.pi, "°/m") if one.mode % 6 > 2 else (1.0, "m/m")
    damping = f"damping ratio {one.damping:.2g}"
    if not one.viscous:
        damping += " of waves alone"
        damping += ", without viscous damping, which lowers it" * underdamped(one)
    if one.damping > BROAD:
        damping += ": the period of the largest motion, which so much damping moves away from the natural period"
    return (
        f"resonance of {one.name} at {one.period:.4g} s ({one.omega:.5g} rad/s): peak "
        f"{significant(factor * one.peak, 3)} {unit} in waves towards {np.degrees(one.heading):.4g}°, {damping}"
    )


def _stored(one, omega, rao):
    if rao is None:
        return ""
    near = np.abs(omega / one.omega - 1) < max(0.1, 2 * one.damping)
    near[np.argmin(np.abs(omega - one.omega))] = True
    share = np.abs(rao[near][:, :, one.mode]).max() / one.peak
    return f"; stored frequencies near it show {100 * share:.3g} % of the peak" if share < SEEN else ""


def _uncertain(one):
    share = one.error / one.peak
    if share <= UNSURE:
        return ""
    return (
        f"; the peak is uncertain by {100 * share:.3g} %, limit {100 * UNSURE:g} %; add {one.omega:.6g} rad/s to "
        f"the frequencies"
    )
