"""Estimated errors of a `reader.Reader`: errors of interpolation over frequency and heading, and of derived quantities.

Every deviation is about one standard deviation; for complex quantities it is that of the modulus.
"""

from functools import cache

import numpy as np

from ..waves import wavenumber
from . import far_field_drift
from .between_frequencies import DRIFT, KOCHIN, RADIATION

STEP = 1e-3  # finite-difference step, relative to the deviations that are propagated
DRAWS = 8  # random draws; they estimate a standard deviation to within a quarter


def carried(reader, omega, headings, name, names):
    """Deviation of "rao" or of drift, computed from the deviations of the quantities `names`; shape (q, p, …)"""
    found = reader.where_stored(omega, headings, name)
    if found is not None and found.complete:
        return np.zeros(found.values.shape)
    if not reader.rebuilds_drift and name != "rao":
        return interpolated(reader, omega, headings, name)
    far_field = cache(lambda: reader.far_field(omega, headings))
    parts = {
        "added_mass": lambda: reader.coefficients(omega)[0],
        "radiation_damping": lambda: reader.coefficients(omega)[1],
        "excitation_force": lambda: reader.forces(omega, headings),
        "kochin_radiation": lambda: far_field()[0],
        "kochin_diffraction": lambda: far_field()[1],
    }
    parts = {part: parts[part]() for part in names}
    errors = {part: interpolated(reader, omega, headings, part) for part in names}
    if name == "rao":
        error = one_by_one(lambda p: reader.solved(omega, *p.values()), parts, errors)
    else:
        waves = wavenumber(omega, reader.depth, reader.gravity) * reader.radius

        def equation(p):
            R, D, *others = p.values()
            X = reader.solved(omega, *others) if others else None
            return far_field_drift.of_far_field(reader, omega, headings, R, D, X)

        error = by_chance(equation, parts, errors, KOCHIN, waves)
        if reader.ring_of(name).is_round:  # its own image in the plane of axis and wave: no moment, whatever deviates
            error[..., 2] = 0.0
    return error if found is None else np.where(found.mask[..., None], 0.0, error)


def interpolated(reader, omega, headings, name):
    """Deviation of a quantity at omega (q,) rad/s and headings (p,) rad (None: the stored headings); shape (q, p, …)"""
    error = reader.between.error(omega, name)
    if headings is None or name in (*RADIATION, "kochin_radiation"):
        return error
    values, ring = reader.between.value(omega, name), reader.ring_of(name)
    mirrored = ring.of_drift if name in DRIFT else ring.of_kochin if name == "kochin_diffraction" else ring.of_forces
    values, error = mirrored(values), np.abs(mirrored(error))
    over = reader.to_headings(omega, headings, name)
    independent = len(ring.headings)
    if name != "kochin_diffraction":  # values that are zero by symmetry carry no information
        size = np.abs(values).max(axis=0)
        independent = np.sum(size > 1e-6 * size.max(axis=0), axis=0) / 2 ** len(ring.images)
    if name == "excitation_force" and "kochin_radiation" in reader.between.quantities:
        there = reader.of_haskind(omega, ring.headings)
        values = np.where(np.isnan(there), values, values - there)
    spread = np.sqrt(np.abs(over.weights) ** 2 @ (error**2).reshape(*error.shape[:2], -1))
    spread = spread.reshape(*spread.shape[:2], *error.shape[2:])
    kind = "drift" if name in DRIFT else "kochin" if name == "kochin_diffraction" else "force"
    return over.unfolded_deviation(np.hypot(spread, over.deviation(values, independent)), kind)


def one_by_one(equation, parts, errors):
    """Deviation of equation(parts): each quantity in turn deviates by one random number, and the effects are combined.

    parts : {name: array}; errors : deviations of the parts, {name: array}
    """
    value, variance = equation(parts), 0.0
    for name, error in errors.items():
        moved = {**parts, name: parts[name] + STEP * error}
        variance = variance + np.abs((equation(moved) - value) / STEP) ** 2
    return np.sqrt(variance)


def by_chance(equation, parts, errors, smooth, waves):
    """Deviation of equation(parts) under random deviations of all quantities (q, …), smooth over θ for `smooth`.

    waves : k times the radius of the hull, (q,); a Kochin function has about this number of harmonics over its last
        axis

    If the deviation were the same at all angles, the slope over θ would not change, and the estimated error of the
    moment would be zero.  The random draws are equal at all frequencies, so that an estimate does not depend on other
    frequencies.
    """
    generator, value, variance = np.random.default_rng(0), equation(parts), 0.0
    angles = parts[smooth[0]].shape[-1]
    order = np.fft.fftfreq(angles, 1 / angles)
    kept = (np.abs(order) <= waves[:, None] + 1)[:, None]
    kept = kept / np.sqrt(kept.mean(axis=-1, keepdims=True))
    for _ in range(DRAWS):
        moved = {}
        for name, part in parts.items():
            chance = _complex_normal(generator, part.shape[1:])
            if name in smooth:
                chance = np.fft.ifft(np.fft.fft(chance, norm="ortho", axis=-1) * kept, norm="ortho", axis=-1)
            chance = chance if np.iscomplexobj(part) else np.sqrt(2) * chance.real
            moved[name] = part + STEP * errors[name] * chance
        variance = variance + np.abs((equation(moved) - value) / STEP) ** 2 / DRAWS
    return np.sqrt(variance)


def _complex_normal(generator, shape):
    """Complex normal numbers of variance one"""
    return (generator.standard_normal(shape) + 1j * generator.standard_normal(shape)) / np.sqrt(2)
