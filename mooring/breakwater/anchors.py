"""Pretension that keeps taut lines taut over the tide, and anchors for their greatest tension.

    ΔP₀ = ρg ΔV / (2 sin α),    P₀ ≥ P_F + ΔP₀,    P_max = P₀ + ΔP₀ + P
    sinker of one line     W = P_max cos α / μ            common sinker     W = max over t of |P_H(t)|/μ + P_U(t)
    pile of one line       Q_a = ψ L_p c / 3,             spacing Q_a / (P_max sin α)

Forces in N/m, weights as submerged.  Kihara, Kitatani & Todoroki (1975), chapter 6, whose 6.7 prints ≤ for ≥ and
whose greatest leeward tension, printed as 24.3, is 14.6 + 3.5 + 7.2 = 25.3 t/m. In the paper a sinker may slide but
is never lifted. For a sinker of one line the vertical part of the tension is therefore neglected, unless `sinker` is
called with `lifted`.
"""

import numpy as np

PILE_SAFETY = 3.0


def pretension_needed(front, tide_part):
    """Smallest pretension P₀, N/m, that keeps the seaward line taut; front : P_F at low tide; tide_part : ΔP₀"""
    return _at_least("tension amplitude", front, 0.0, "N/m") + tide_part


def goes_slack(pretension, tide_part, amplitude):
    """Whether a line with a given pretension goes slack at low tide in waves of a given tension amplitude; arrays
    broadcast
    """
    return np.asarray(pretension) - tide_part < np.asarray(amplitude)


def sinker(tension, angle, friction, lifted=False):
    """Submerged weight W, N/m, that holds one line; lifted : whether it also carries the line's upward pull"""
    weight = tension * np.cos(angle) / _at_least("friction", friction, 1e-3, "")
    return weight + tension * np.sin(angle) if lifted else weight


def common_sinker(horizontal, vertical, friction):
    """Submerged weight W, N/m, shape (…), of one sinker under both lines; P_H, P_U : (…) complex wave forces

    W is the greatest value of ±P_H(t)/μ + P_U(t) over a period; the sum of the two terms is one harmonic.
    """
    pull = np.asarray(horizontal) / _at_least("friction", friction, 1e-3, "")
    return np.maximum(abs(pull + vertical), abs(pull - vertical))


def sinker_height(weight, width, unit_weight):
    """Height of a block, m; weight : submerged weight, N/m; width : m; unit_weight : submerged unit weight, N/m³"""
    return weight / (_at_least("width", width, 1e-3, "m") * _at_least("unit weight", unit_weight, 1e-3, "N/m³"))


def pile_capacity(circumference, length, cohesion, safety=PILE_SAFETY):
    """Q_a, N, of a pile by friction; circumference, length : m; cohesion : N/m²"""
    return circumference * length * cohesion / _at_least("safety", safety, 1.0, "")


def pile_spacing(capacity, tension, angle):
    """Distance between the piles of a row, m, for the vertical part of `tension`, N/m"""
    return capacity / (tension * np.sin(angle))


def _at_least(name, value, low, unit):
    if not np.all(np.asarray(value) >= low):
        raise ValueError(f"{name} is {np.min(value):g} {unit}".rstrip() + f"; allowed: {low:g} or more")
    return value
