"""Deviations of known quantities, carried through an equation to what follows from them."""

from __future__ import annotations

import numpy as np

STEP = 1e-3  # of the deviations, with which they are carried through an equation
DRAWS = 8  # by chance; a deviation is known to a quarter


def one_by_one(equation, parts, errors):
    """Deviation of equation(parts) when each quantity deviates by its own number, one after the other.

    parts : {name: array}; errors : the same of deviations
    """
    value, variance = equation(parts), 0.0
    for name, error in errors.items():
        moved = {**parts, name: parts[name] + STEP * error}
        variance = variance + np.abs((equation(moved) - value) / STEP) ** 2
    return np.sqrt(variance)


def by_chance(equation, parts, errors, smooth, waves):
    """Deviation of equation(parts) when all quantities (q, …) deviate by chance, those of `smooth` smoothly over θ.

    waves : (q,) k times the radius of the hull, harmonics that a Kochin function has over its last axis
    Shifted by one number at all angles they would keep their slope, and the moment would seem to be known.  Chance is
    the same at all frequencies, so that an estimate does not depend on what else is asked for.
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
    """Of variance one"""
    return (generator.standard_normal(shape) + 1j * generator.standard_normal(shape)) / np.sqrt(2)
