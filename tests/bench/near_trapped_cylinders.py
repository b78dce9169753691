"""Four cylinders on the bed in a square, a/d = 0.8: place, width and height of their near-trapped wave, by panels.

    python tests/bench/near_trapped_cylinders.py 40 4

Forces at six wavenumbers about it are (c₀ + c₁x + c₂x²)/(x − p), all with one pole p.  Evans & Porter (1997): the
largest force at ka 4.0848, 54 times that of one cylinder; exact by the multipoles of Linton & Evans (1990).
"""

import sys

import numpy as np
from scipy.special import h1vp, hankel1, jvp

from hakobune.bem.frequency import solve_frequency
from hakobune.bem.methods.panel_problem import PanelProblem
from hakobune.bem.modes import Body
from hakobune.meshing.lid import lid
from hakobune.meshing.panels import PanelMesh, assembled

PLACES = np.array([(1.25, 1.25), (-1.25, 1.25), (-1.25, -1.25), (1.25, -1.25)])  # of axes, radius 1 m
WAVENUMBERS, HEADING, DEPTH, G, RHO = (4.06, 4.075, 4.083, 4.0855, 4.09, 4.105), np.pi / 4, 0.6, 9.81, 1025.0
MOST = 14  # harmonics


def exact(k):
    """(8,) force on each cylinder along x and y over that on one alone"""
    n = np.arange(-MOST, MOST + 1)
    scattered, size = jvp(n, k) / h1vp(n, k), len(n)
    matrix, side = np.eye(4 * size, dtype=complex), np.zeros(4 * size, complex)
    for p, at in enumerate(PLACES):
        rows = slice(p * size, (p + 1) * size)
        for q in (q for q in range(4) if q != p):
            dx, dy = at - PLACES[q]
            m = n[None, :] - n[:, None]
            wave = hankel1(m, k * np.hypot(dx, dy)) * np.exp(1j * m * np.arctan2(dy, dx))
            matrix[rows, q * size : (q + 1) * size] += scattered * wave
        side[rows] = -np.exp(1j * k * at @ (np.cos(HEADING), np.sin(HEADING)) + 1j * n * (np.pi / 2 - HEADING))
    A = np.linalg.solve(matrix, side).reshape(4, size)
    back, ahead = A[:, MOST - 1], A[:, MOST + 1]
    return np.stack([back - ahead, 1j * (back + ahead)], axis=1).ravel() / 2


def cylinder(around, down):
    """PanelMesh of the side, of the plan area of the circle"""
    angle, z = 2 * np.pi * np.arange(around) / around, np.linspace(0, -DEPTH, down + 1)
    radius = np.sqrt(2 * np.pi / around / np.sin(2 * np.pi / around))
    points = np.array([[radius * np.cos(t), radius * np.sin(t), h] for h in z for t in angle])
    first = np.array([[i * around + j, i * around + (j + 1) % around] for i in range(down) for j in range(around)])
    return PanelMesh(points, np.column_stack([first[:, 0], first[:, 0] + around, first[:, 1] + around, first[:, 1]]))


def by_panels(around, down):
    """k → (8,) as `exact`"""
    mesh = assembled([cylinder(around, down).moved(dx=x, dy=y) for x, y in PLACES])
    bodies = tuple(Body(f"c{i}", (*at, 0.0), fixed=i > 0) for i, at in enumerate(PLACES))
    prepared = PanelProblem(mesh, lid(mesh), depth=DEPTH, bodies=bodies, gravity=G, density=RHO).prepared()

    def force(k):
        found = solve_frequency(prepared, np.sqrt(G * k * np.tanh(k * DEPTH)), (HEADING,), {"excitation_force"})
        one = 4 * RHO * G * np.tanh(k * DEPTH) / (k * k * abs(h1vp(1, k)))
        return found["excitation_force"][0].reshape(4, 6)[:, :2].ravel() / one

    return force


def resonance(force):
    """Pole p, and the largest of the forces at its real part"""
    x = np.array(WAVENUMBERS) - 4.0848
    values = np.array([force(k) for k in WAVENUMBERS])
    powers, count = x[:, None] ** np.arange(3), values.shape[1]
    A = np.hstack([np.kron(np.eye(count), powers), values.T.reshape(-1, 1)])
    found = np.linalg.lstsq(A, (values * x[:, None]).T.ravel(), rcond=None)[0]
    pole = found[-1]
    peak = found[:-1].reshape(count, 3) @ pole.real ** np.arange(3) / (pole.real - pole)
    return 4.0848 + pole, np.linalg.norm(peak.reshape(4, 2), axis=1).max()


if __name__ == "__main__":
    for name, force in (("exact", exact), ("panels", by_panels(*map(int, sys.argv[1:3])))):
        pole, largest = resonance(force)
        print(f"{name}: largest force {largest:.4g} at ka {pole.real:.5f}, width {-2 * pole.imag:.4g}", flush=True)
