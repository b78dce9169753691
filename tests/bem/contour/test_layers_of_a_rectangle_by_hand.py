"""Layers on a rectangle's contour at points near and far, as plain Python, against integrals along its four sides."""

import numpy as np
import pytest
from plain import plain
from scipy.special import hankel1, kv

layers, panels, maps = (plain(f"bem.contour.plan.{name}") for name in ("layers", "panels", "maps"))
A, B = 2.0, 1.0  # half length and half beam, m
X, Y = np.array([2.05, 0.7, 9.0, -2.6, 1.2]), np.array([0.3, 1.03, 4.0, -0.4, -1.4])
KINDS = {
    "laplace": (layers.laplace, lambda R: -np.log(R) / (2 * np.pi), lambda R: -1 / (2 * np.pi * R)),
    "decaying": (layers.decaying(0.8), lambda R: kv(0, 0.8 * R) / (2 * np.pi),
                 lambda R: -0.8 * kv(1, 0.8 * R) / (2 * np.pi)),
    "radiating": (layers.radiating(1.3), lambda R: 0.25j * hankel1(0, 1.3 * R),
                  lambda R: -0.25j * 1.3 * hankel1(1, 1.3 * R)),
}  # fmt: skip


def density(x, y):
    """Of the quarter x, y > 0: another one on the end than on the side"""
    return np.where(np.abs(np.abs(x) - A) < 1e-12, 1.0 + y, 0.5 * x - 2.0)


def integral(f, signs, x, y, double):
    """∮ along the sides by Gauss in pieces that grow threefold from the foot of the target, signs as of the class"""
    total, (u, w) = 0.0, np.polynomial.legendre.leggauss(16)
    steps = 0.01 * 3.0 ** np.arange(8)
    for side, (half, extent) in enumerate(((A, B), (B, A))):
        foot = float(np.clip((y, x)[side], -extent, extent))
        ends = np.unique(np.clip([-extent, 0.0, extent, foot, *(foot + steps), *(foot - steps)], -extent, extent))
        s = (ends[:-1, None] + np.diff(ends)[:, None] * (1 + u) / 2).ravel()
        weights = (np.diff(ends)[:, None] * w / 2).ravel()
        for sign in (1, -1):
            at = np.stack([np.full_like(s, sign * half), s][:: 1 if side == 0 else -1])
            d = at - np.array([[x], [y]])
            R = np.hypot(*d)
            factor = np.where(at[0] < 0, signs[0], 1) * np.where(at[1] < 0, signs[1], 1) * density(*np.abs(at))
            total += np.sum(weights * factor * f(R) * (sign * d[side] / R if double else 1.0))
    return total


@pytest.mark.parametrize("name", KINDS)
def test_both_layers_of_every_class_are_integrals_along_the_sides(name):
    kernels, G, slope = KINDS[name]
    own = panels.quarter_panels(A, B, (0.25, 0.25), (0.6, 0.6), 6)
    c = own.contour
    made = layers.layers(own, X, Y, np.full(len(X), -1), 16, 0.02)
    assert len(made.pair) and len(made.near.target)  # of both kinds
    S, D = made.matrices(kernels, maps.CLASSES)
    values = density(c.x, c.y)
    for single, double, signs in zip(S @ values, D @ values, maps.CLASSES, strict=True):
        for i, at in enumerate(zip(X, Y, strict=True)):
            assert single[i] == pytest.approx(integral(G, signs, *at, False), rel=1e-6, abs=1e-7)
            assert double[i] == pytest.approx(integral(slope, signs, *at, True), rel=1e-6, abs=1e-7)
