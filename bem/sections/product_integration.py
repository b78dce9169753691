"""Logarithms and dipoles integrated over panels, straight or circular arcs, for densities given at Gauss points.

    ∫ f ln|τ − p| |dτ|,        ∫ f ∂/∂n ln|τ − p| |dτ| = −Im ∫ f dτ/(τ − p)

n points to the left of the panel.  For a distant p the Gauss rule is used. For a near p, f is taken as a polynomial
in t, and Legendre's polynomials are integrated against 1/(t₀ − t) and ln(t₀ − t), with t₀ the complex parameter at
which the continued panel meets p:

    ∫ P_k/(t₀ − t) dt = 2Q_k(t₀),      ∫ P_k ln(t₀ − t) dt = 2 (Q_{k+1}(t₀) − Q_{k−1}(t₀)) / (2k + 1),  k ≥ 1

Helsing and Ojala, Journal of Computational Physics 227 (2008), use polynomials in a complex parameter in this way.
"""

from typing import NamedTuple

import numpy as np

NODES = 10
T, W = np.polynomial.legendre.leggauss(NODES)
LEGENDRE = np.polynomial.legendre.legvander(T, NODES - 1).T  # (k, node)
DEGREES = np.arange(NODES)
EXPANSION = (DEGREES + 0.5)[:, None] * W * LEGENDRE  # coefficients of P_k of values at the nodes
NEAR = 2.6  # sum of an ellipse's half axes: Gauss' rule errs by NEAR^(−2 NODES), the recurrence by eps NEAR^(2 NODES)


class Panels(NamedTuple):
    """middle, arm, center : (m,) complex, m, τ = middle + arm t of straight panels, center + (middle − center)
    exp(i t angle/2) of arcs; angle : (m,) rad, 0 where straight; points : (m, NODES) complex, m
    slopes : dτ/dt, complex, m, (m, NODES)
    """

    middle: np.ndarray
    arm: np.ndarray
    center: np.ndarray
    angle: np.ndarray
    points: np.ndarray
    slopes: np.ndarray

    @property
    def speed(self):
        """Speed |dτ/dt| of each panel, m; shape (m,)"""
        return np.abs(self.slopes[:, 0])

    @property
    def weights(self):
        """Weights of Gauss' rule in length, m; shape (m, NODES)"""
        return self.speed[:, None] * W


def panels_of(edges):
    """`Panels`, one for each `Edge`"""
    u = (T + 1) / 2
    points, slopes = (np.array([f(u) for f in (getattr(e, name) for e in edges)]) for name in ("at", "slope"))
    middle = np.array([complex(e.at(0.5)) for e in edges])
    arm = np.array([(e.end - e.start) / 2 for e in edges])
    center = np.array([0j if e.bulge == 0 else e.center for e in edges])
    return Panels(middle, arm, center, np.array([float(e.angle) for e in edges]), points, slopes / 2)


def layers(panels, targets, own=None):
    """Single and double layer (p, m · NODES) of densities at the nodes for targets (p,), complex, m

    own : panel of which each target is a node, (p,); if None, no target lies on a panel
    """
    m = len(panels.middle)
    away = panels.points.reshape(-1) - targets[:, None]
    at_node = np.zeros(away.shape, bool)
    if own is not None:
        at_node[np.arange(len(targets)), np.arange(len(targets))] = True
    away = np.where(at_node, 1.0, away)
    single = np.log(np.abs(away)) * panels.weights.reshape(-1)
    double = -np.imag(panels.slopes.reshape(-1) / away) * np.tile(W, m)
    single, double = (x.reshape(len(targets), m, NODES) for x in (single, double))
    start = _parameter(panels, targets)
    inside = start + np.sqrt(start - 1) * np.sqrt(start + 1)
    near = np.maximum(abs(inside), 1 / np.maximum(abs(inside), 1e-300)) < NEAR
    if own is not None:
        near[np.arange(len(targets)), own] = True
        start[np.arange(len(targets)), own] = np.tile(T, m)
    rows, columns = np.nonzero(near)
    mine = np.zeros(len(rows), bool) if own is None else own[rows] == columns
    _put_near(panels, targets, start[rows, columns], (rows, columns, mine), single, double)
    return single.reshape(len(targets), -1), double.reshape(len(targets), -1)


def _parameter(panels, targets):
    """t₀ (p, m), complex"""
    p = targets[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        straight = (p - panels.middle) / panels.arm
        turn = -1j * np.log((p - panels.center) / (panels.middle - panels.center)) * 2 / panels.angle
    t0 = np.where(panels.angle == 0, straight, turn)
    return np.where(np.isfinite(t0), t0, 1e6)


def _put_near(panels, targets, t0, pairs, single, double):
    rows, columns, mine = pairs
    q, first = _second_kind(t0, mine)
    away, to_t0 = panels.points[columns] - targets[rows, None], T - t0[:, None]
    same = mine[:, None] & (abs(to_t0) < 1e-14)
    slopes, speed = panels.slopes[columns], panels.speed[columns, None]
    ratio = np.where(same, slopes, np.where(same, 1, away) / np.where(same, 1, to_t0))  # (τ − p)/(t − t₀)
    logs = np.empty((len(rows), NODES))
    logs[:, 0] = first
    logs[:, 1:] = (2 * (q[:, 2:] - q[:, : NODES - 1]) / (2 * DEGREES[1:] + 1)).real
    single[rows, columns] = speed * (logs @ EXPANSION + W * np.log(abs(ratio)))
    cauchy = -2 * (q[:, :NODES] @ EXPANSION) * slopes / ratio
    smooth = np.where(panels.angle[columns, None] == 0, 0.0, -panels.angle[columns, None] / 4 * W)
    double[rows, columns] = np.where(mine[:, None], smooth, -cauchy.imag)


def _second_kind(t0, on_cut):
    """Q_k(t₀) (n, NODES + 1), principal values on the cut, and Re ∫ ln(t₀ − t) dt (n,)"""
    up, down = t0 + 1, t0 - 1
    q = np.empty((len(t0), NODES + 1), complex)
    ratio = up / down  # zeros of equal sign where p lies on the straight line of a panel
    q[:, 0] = np.where(on_cut, np.log(abs(ratio)), np.log(ratio)) / 2
    q[:, 1] = t0 * q[:, 0] - 1
    for k in range(1, NODES):
        q[:, k + 1] = ((2 * k + 1) * t0 * q[:, k] - k * q[:, k - 1]) / (k + 1)
    return q, (up * np.log(up) - down * np.log(down)).real - 2
