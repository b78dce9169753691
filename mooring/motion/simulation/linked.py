"""Bodies with hinges between them: stability of their rest, and valid starts of a run."""

import numpy as np

from ..links import rows_at

TOGETHER = 1e-12  # m, rad: apart by less is rounding
TRIES = 50
OUT = 1e-6  # fraction of the stiffest motion; smaller negative restoring is rounding


def check_held(stiffness, body):
    """Raise ValueError for hinged bodies at an unstable rest, by a stiffness (n, n)."""
    scale = 1 / np.sqrt(np.diag(body.inertia))
    free = np.linalg.qr(body.free / scale[:, None])[0]
    K = free.T @ (0.5 * (stiffness + stiffness.T) * np.outer(scale, scale)) @ free
    values, ways = np.linalg.eigh(K)
    if len(values) and values[0] < -OUT * np.abs(values).max():
        worst = int(np.argmax(np.abs(free @ ways[:, 0])))
        names = ", ".join(link.name for link in body.links)
        raise ValueError(
            f"hinges {names}: {body.words[worst]} is unstable at rest, with ω² of {values[0]:.3g} 1/s², "
            "limit 0; lower center_of_gravity, or reduce the compression of the hinges"
        )


def begin_together(links, inverse, poses, speed):
    """Poses and velocities (N, 6) that satisfy the links, nearest to those given; inverse : (6N, 6N) of the mass.

    raises : ValueError without any nearby
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
    raise ValueError(f"the offset leaves hinges {np.abs(gap).max():.3g} m or rad apart; give a smaller offset")
