"""Reaction of a pneumatic fender by the gas law.

An inextensible skin, compressed between two plates to h = D − δ, has the section of a stadium: its perimeter πD = πh +
2b leaves flats of b = πδ/2.  With x = δ/D the section is (1 − x²) times the round section, and the volume changes by
the same factor:

    p + p_air = (p₀ + p_air) (1 − x²)^−γ,    R = p b [L − D + (π/2) a],    a = ½ √(D² − h²)

where the ends are hemispheres; each is flattened over half an ellipse with the half axes a and b/2.  γ = 1.4 for a
compression in seconds (adiabatic), 1 for a compression in minutes.
"""

import numpy as np

from .fender import FenderError, fender_of_points

AIR = 101_325.0  # Pa
SECONDS = 1.4  # γ for a compression of seconds; 1.0 for minutes
HIGHEST = 500e3  # Pa above the air; ISO 17357-1 (2014) has 50 and 80 kPa, fenders for submarines up to 200
RATED, LIMIT = 0.55, 0.65  # SR179 report (1982), chapter 3.3.2: allowable about 55 % of the diameter


def pneumatic(name, diameter, length, pressure, overload=None, exponent=SECONDS, points=53):
    """`fender.Fender` without hysteresis; diameter, length : overall dimensions, m; pressure : gauge pressure at
    rest, Pa.

    raises : FenderError
    """
    for key, value in (("diameter", diameter), ("pressure", pressure)):
        if not 0 < value < np.inf:
            raise FenderError(f"{name}: its {key} is {value:g}; allowed: above 0, finite")
    if pressure > HIGHEST:
        raise FenderError(
            f"{name}: its pressure is {pressure / 1e3:g} kPa; allowed: up to {HIGHEST / 1e3:g} kPa; usual are 50 and 80"
        )
    if not diameter <= length < np.inf:
        raise FenderError(f"{name}: its length is {length:g} m; allowed: at least its diameter of {diameter:g} m")
    x = np.linspace(0.0, LIMIT, points)
    reaction = gas_reaction(x, diameter, length, pressure, exponent)
    return fender_of_points(name, diameter, x * diameter, reaction, rated=RATED, allowable=RATED, overload=overload)


def gas_reaction(strain, diameter, length, pressure, exponent=SECONDS):
    """Reaction, N, at strains δ/D of any shape, by the module's equations"""
    x = np.asarray(strain, float)
    over = (pressure + AIR) * (1 - x**2) ** -exponent - AIR
    half = 0.5 * diameter * np.sqrt(x * (2 - x))
    return over * (0.5 * np.pi * x * diameter) * (length - diameter + 0.5 * np.pi * half)
