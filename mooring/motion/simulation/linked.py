"""Bodies with hinges between them: where they rest, how stiff they are there, and from where a run may begin."""

from __future__ import annotations

import numpy as np

from ...lines.system.bodies import axes_in_space
from ..contacts import RESTS, STEP
from ..links import fill_rows, link_work

TOGETHER = 1e-12  # m, rad: apart by less is rounding
TRIES = 50
OUT = 1e-6  # of the stiffest motion, below which a negative restoring is rounding


def rows_at(links, poses):
    """(r, 6N) of G and (r,) of what is held to zero, of `links.Links` with the bodies at poses (N, 6)"""
    work, poses = link_work(links), np.ascontiguousarray(poses, float)
    fill_rows(links, work, poses)
    G = np.zeros((len(work.gap), poses.size))
    for k, ends in enumerate(links.ends):
        rows = slice(links.first[k], links.first[k + 1])
        for e, b in enumerate(ends):
            if b >= 0:
                G[rows, 6 * b : 6 * b + 6] = work.rows[rows, 6 * e : 6 * e + 6]
    return G, work.gap.copy()


def rest_together(links, forces, start, unit, headings):
    """(n,) places where forces, a function of the place (n,) in space, and links balance, and (r,) what these hold

    forces : (n,) N, N m along the axes of the bodies; unit : (n,) m, rad; headings : (N,) rad at rest
    raises : ValueError where they do not
    """
    from scipy.optimize import least_squares

    size = max(np.abs(forces(np.asarray(start)) * unit).max(), 1.0)

    def parts(place):
        G, gap = rows_at(links, _poses(place, headings))
        F = forces(place)
        mu = np.linalg.lstsq((G * unit).T, -F * unit, rcond=None)[0]
        return F + G.T @ mu, gap, mu

    def residual(x):
        left, gap, _ = parts(x * unit)
        return np.concatenate([left * unit / size, gap])

    x = np.asarray(start) / unit
    if np.abs(residual(x)).max() > TOGETHER:
        found = least_squares(residual, x, method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
        if not np.abs(found.fun).max() <= RESTS:
            raise ValueError(
                f"the bodies come to no rest with their hinges: {np.abs(found.fun).max():.2g} of the largest force, or "
                "m, is left; look at lines and fenders that pull a hinge apart"
            )
        x = found.x
    return x * unit, parts(x * unit)[2]


def stiffness_together(links, forces, place, mu, headings):
    """(n, n) along the axes of the bodies, of forces as of `rest_together` and of what links hold there, μ (r,)"""
    out, along = np.empty((len(place), len(place))), axes_in_space(headings)

    def total(at):
        return forces(at) + rows_at(links, _poses(at, headings))[0].T @ mu

    for j, h in enumerate(np.tile(STEP, len(place) // 6)):
        out[:, j] = (total(place - h * along[:, j]) - total(place + h * along[:, j])) / (2 * h)
    return out


def check_held(stiffness, body):
    """Raise ValueError for bodies that hinges hold in a place that they leave by themselves, by a stiffness (n, n)."""
    scale = 1 / np.sqrt(np.diag(body.inertia))
    free = np.linalg.qr(body.free / scale[:, None])[0]
    K = free.T @ (0.5 * (stiffness + stiffness.T) * np.outer(scale, scale)) @ free
    values, ways = np.linalg.eigh(K)
    if len(values) and values[0] < -OUT * np.abs(values).max():
        worst = int(np.argmax(np.abs(free @ ways[:, 0])))
        names = ", ".join(link.name for link in body.links)
        raise ValueError(
            f"hinges {names}: {body.words[worst]} leaves its place at rest by itself, with ω² of {values[0]:.3g} 1/s², "
            "limit 0; lower center_of_gravity, or pull the hinges less together"
        )


def begin_together(links, inverse, poses, speed):
    """Poses and velocities (N, 6) that links hold, nearest by mass to those given; inverse : (6N, 6N) of the mass.

    raises : ValueError where there are none near
    """
    poses, speed = np.array(poses, float), np.array(speed, float)
    for _ in range(TRIES):
        G, gap = rows_at(links, poses)
        share = inverse @ G.T
        if np.abs(gap).max() < TOGETHER:
            return poses, speed - (share @ np.linalg.solve(G @ share, G @ speed.ravel())).reshape(-1, 6)
        step = -(share @ np.linalg.solve(G @ share, gap)).reshape(-1, 6)
        step[:, :2] = [[np.cos(c) * x - np.sin(c) * y, np.sin(c) * x + np.cos(c) * y]
                       for c, (x, y) in zip(poses[:, 5], step[:, :2], strict=True)]  # fmt: skip
        poses += step
    raise ValueError(f"the offset leaves hinges {np.abs(gap).max():.3g} m or rad apart; allowed: a smaller one")


def _poses(place, headings):
    """(N, 6) of displacements in space (n,)"""
    poses = np.array(place, float).reshape(-1, 6)
    poses[:, 5] += headings
    return poses
