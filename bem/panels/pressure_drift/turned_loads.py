"""Mean of products of two first-order quantities, and of loads that turn with a body (`bem.second_order.rotations`).

T_ij = ¼ {αᵢ × F̄ⱼ + ᾱⱼ × Fᵢ},    moments  ¼ {αᵢ × M̄ⱼ + X_cᵢ × F̄ⱼ + conjugates with i and j exchanged}
"""

import numpy as np


def products(one, two, second=np.conj):
    """Transfer function T of the product of two quantities (f, a) and (f, b), ¼(aᵢ b̄ⱼ + āⱼ bᵢ); shape (f, f, a, b)

    second : as in `bem.panels.pressure_drift.mean_drift.pressure_pairs`
    """
    first = np.einsum("ia,jb->ijab", one, second(two))
    return 0.25 * (first + np.einsum("ja,ib->ijab", second(one), two))


def rotated_pairs(load, motion, second=np.conj):
    """Transfer function T of loads (f, 6) that turn with the motions (f, 6); shape (f, f, 6). Loads and motions are
    about the rotation centre"""
    turned = products(motion, load, second)
    force = _cross(turned[..., 3:, :3])
    moment = _cross(turned[..., 3:, 3:]) + _cross(turned[..., :3, :3])
    return np.concatenate([force, moment], axis=-1)


def _cross(ab):
    """Cross product a × b from products (…, 3, 3) of the components; shape (…, 3)"""
    pairs = ((1, 2), (2, 0), (0, 1))
    return np.stack([ab[..., a, b] - ab[..., b, a] for a, b in pairs], axis=-1)
